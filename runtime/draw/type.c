/* Sets lettering. */
#include "runtime/draw/type.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/utf8.h"

enum { TEXT_ROOM = 1024, PARAGRAPH_ROOM = 8192 };

#define ELLIPSIS "\xe2\x80\xa6"

/* Copies what can be shown, what is hidden as escapes: cairo stops drawing for good at a text that is not UTF-8. false
 * where there is no room for all of it. */
static bool clean_into(const char *text, char *out, size_t room)
{
    size_t used = 0, left = strlen(text);
    for (size_t size; left > 0 && used + 8 < room; text += size, left -= size) {
        uint32_t character = tn_utf8_read(text, left, &size);
        if (character == '\t' || character == '\n' || character == '\r') {
            out[used++] = ' ';
        } else if (tn_character_hidden(character)) {
            tn_character_escape(character, out + used);
            used += strlen(out + used);
        } else if (character == TN_REPLACEMENT && size == 1) {
            out[used++] = '?';
        } else {
            memcpy(out + used, text, size);
            used += size;
        }
    }
    out[used] = '\0';
    return left == 0;
}

static void clean(const char *text, char out[TEXT_ROOM])
{
    clean_into(text, out, TEXT_ROOM);
}

void tn_type_face(cairo_t *context, double size, bool bold)
{
    cairo_font_options_t *options = cairo_font_options_create();
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    cairo_set_font_options(context, options);
    cairo_font_options_destroy(options);
    cairo_select_font_face(context, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context, size);
}

static double clean_width(cairo_t *context, const char *cleaned)
{
    cairo_text_extents_t extents;
    cairo_text_extents(context, cleaned, &extents);
    return extents.x_advance;
}

/* ---- lettering as text */

/* Its address is what a context keeps the stream under. */
static const cairo_user_data_key_t letters_key;

bool tn_type_as_text(cairo_t *context, FILE *letters)
{
    return cairo_set_user_data(context, &letters_key, letters, NULL) == CAIRO_STATUS_SUCCESS;
}

/* Hundredths, whatever the locale. */
static void write_number(FILE *out, const char *name, double number)
{
    long hundredths = lround(number * 100);
    fprintf(out, "%s%s%ld", name, hundredths < 0 ? "-" : "", labs(hundredths) / 100);
    if (hundredths % 100)
        fprintf(out, ".%02ld", labs(hundredths) % 100);
}

static void write_escaped(FILE *out, const char *text)
{
    for (; *text; text++)
        if (*text == '&' || *text == '<')
            fputs(*text == '&' ? "&amp;" : "&lt;", out);
        else
            fputc(*text, out);
}

static void write_colour(FILE *out, cairo_t *context)
{
    double part[4] = {0};
    cairo_pattern_get_rgba(cairo_get_source(context), &part[0], &part[1], &part[2], &part[3]);
    if (part[0] + part[1] + part[2] > 0)
        fprintf(out, " fill=\"#%02lx%02lx%02lx\"", lround(part[0] * 255), lround(part[1] * 255), lround(part[2] * 255));
}

static void write_transform(FILE *out, const cairo_matrix_t *m)
{
    const double numbers[] = {m->xx, m->yx, m->xy, m->yy, m->x0, m->y0};
    fputs(" transform=\"matrix(", out);
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        write_number(out, i ? " " : "", numbers[i]);
    fputs(")\"", out);
}

static void write_letters(FILE *out, cairo_t *context, double x, double baseline, tn_align align, const char *cleaned)
{
    static const char *const anchors[] = {"", " text-anchor=\"middle\"", " text-anchor=\"end\""};
    cairo_matrix_t at, font;
    cairo_get_matrix(context, &at);
    cairo_get_font_matrix(context, &font);
    bool upright = at.xy == 0 && at.yx == 0 && at.xx == at.yy;
    bool bold = cairo_toy_font_face_get_weight(cairo_get_font_face(context)) == CAIRO_FONT_WEIGHT_BOLD;
    write_number(out, "<text x=\"", upright ? at.xx * x + at.x0 : x);
    write_number(out, "\" y=\"", upright ? at.yy * baseline + at.y0 : baseline);
    write_number(out, "\" font-size=\"", upright ? at.yy * font.yy : font.yy);
    fprintf(out, "\"%s%s", bold ? " font-weight=\"bold\"" : "", anchors[align]);
    write_colour(out, context);
    if (!upright)
        write_transform(out, &at);
    fputc('>', out);
    write_escaped(out, cleaned);
    fputs("</text>\n", out);
}

/* Lettering as text lies above all that is drawn, so that a veil over both lies there too. */
void tn_type_veil(cairo_t *context, double x, double y, double width, double height, double opacity)
{
    FILE *letters = cairo_get_user_data(context, &letters_key);
    if (letters) {
        write_number(letters, "<rect x=\"", x);
        write_number(letters, "\" y=\"", y);
        write_number(letters, "\" width=\"", width);
        write_number(letters, "\" height=\"", height);
        write_number(letters, "\" fill=\"#fff\" fill-opacity=\"", opacity);
        fputs("\"/>\n", letters);
        return;
    }
    cairo_rectangle(context, x, y, width, height);
    cairo_set_source_rgba(context, 1, 1, 1, opacity);
    cairo_fill(context);
    cairo_set_source_rgb(context, 0, 0, 0);
}

/* ---- setting */

static void set_clean(cairo_t *context, double x, double baseline, tn_align align, const char *cleaned)
{
    if (!*cleaned)
        return;
    FILE *letters = cairo_get_user_data(context, &letters_key);
    if (letters) {
        write_letters(letters, context, x, baseline, align, cleaned);
        return;
    }
    double shift = align == TN_ALIGN_LEFT ? 0 : clean_width(context, cleaned) * (align == TN_ALIGN_RIGHT ? 1 : 0.5);
    cairo_move_to(context, x - shift, baseline);
    cairo_show_text(context, cleaned);
    cairo_new_path(context);
}

double tn_type_width(cairo_t *context, const char *text)
{
    char cleaned[TEXT_ROOM];
    clean(text, cleaned);
    return clean_width(context, cleaned);
}

void tn_type_line(cairo_t *context, double x, double baseline, tn_align align, const char *text)
{
    char cleaned[TEXT_ROOM];
    clean(text, cleaned);
    set_clean(context, x, baseline, align, cleaned);
}

/* Shortens a cleaned text until it and an ellipsis are at most `width`. `room`: of the buffer. */
static void cut_off(cairo_t *context, char cleaned[TEXT_ROOM], double width)
{
    size_t length = strlen(cleaned);
    while (length > 0) {
        do
            length--;
        while (length > 0 && ((unsigned char)cleaned[length] & 0xc0) == 0x80);
        while (length > 0 && cleaned[length - 1] == ' ')
            length--;
        strcpy(cleaned + length, ELLIPSIS);
        if (clean_width(context, cleaned) <= width)
            return;
    }
    cleaned[0] = '\0';
}

void tn_type_fit(cairo_t *context, double x, double baseline, tn_align align, double width, const char *text)
{
    char cleaned[TEXT_ROOM];
    clean(text, cleaned);
    if (clean_width(context, cleaned) > width)
        cut_off(context, cleaned, width);
    set_clean(context, x, baseline, align, cleaned);
}

/* How many bytes of a cleaned text fit on one line: whole words, at least one. */
static size_t line_bytes(cairo_t *context, const char *text, double width)
{
    char line[PARAGRAPH_ROOM];
    size_t fits = 0, length = strlen(text);
    while (fits < length) {
        size_t end = fits + (text[fits] == ' ');
        end += strcspn(text + end, " ");
        snprintf(line, sizeof line, "%.*s", (int)end, text);
        if (fits && clean_width(context, line) > width)
            break;
        fits = end;
    }
    return fits;
}

/* Copies a paragraph; where there is no room for all of it, up to the last whole word, with an ellipsis. */
static void clean_paragraph(const char *text, char out[PARAGRAPH_ROOM])
{
    if (clean_into(text, out, PARAGRAPH_ROOM - sizeof ELLIPSIS))
        return;
    char *blank = strrchr(out, ' ');
    strcpy(blank ? blank + 1 : out + strlen(out), ELLIPSIS);
}

/* The last line of a paragraph: all of the text, or as many whole words as fit before an ellipsis. */
static void last_line(cairo_t *context, const char *text, double width, char line[PARAGRAPH_ROOM])
{
    bool all = clean_width(context, text) <= width;
    size_t bytes = all ? strlen(text) : line_bytes(context, text, width - clean_width(context, " " ELLIPSIS));
    snprintf(line, PARAGRAPH_ROOM, "%.*s%s", (int)bytes, text, all ? "" : " " ELLIPSIS);
}

unsigned tn_type_paragraph(cairo_t *context, double x, double baseline, double width, double leading,
                           unsigned max_lines, const char *text)
{
    char cleaned[PARAGRAPH_ROOM], line[PARAGRAPH_ROOM];
    clean_paragraph(text, cleaned);
    const char *at = cleaned;
    unsigned lines = 0;
    while (*at && lines < max_lines) {
        size_t bytes = line_bytes(context, at, width);
        if (lines + 1 == max_lines)
            last_line(context, at, width, line);
        else
            snprintf(line, sizeof line, "%.*s", (int)bytes, at);
        if (clean_width(context, line) <= width)
            set_clean(context, x, baseline + lines * leading, TN_ALIGN_LEFT, line);
        else /* one word that is too long */
            tn_type_fit(context, x, baseline + lines * leading, TN_ALIGN_LEFT, width, line);
        at += bytes + (at[bytes] == ' ');
        lines++;
    }
    return lines;
}

/* Sets the groups from x on and returns where they end; only measures where `show` is false. */
static double set_digits(cairo_t *context, double x, double baseline, const char *digits, bool show)
{
    cairo_font_extents_t font;
    cairo_font_extents(context, &font);
    size_t length = strlen(digits);
    for (size_t i = 0; i < length;) {
        char group[4];
        size_t size = (length - i) % 3 ? (length - i) % 3 : 3;
        snprintf(group, sizeof group, "%.*s", (int)size, digits + i);
        if (show)
            tn_type_line(context, x, baseline, TN_ALIGN_LEFT, group);
        x += tn_type_width(context, group) + font.height * 0.12;
        i += size;
    }
    return x;
}

void tn_type_digits(cairo_t *context, double x, double baseline, double width, const char *digits)
{
    double natural = set_digits(context, 0, 0, digits, false);
    cairo_save(context);
    cairo_translate(context, x, baseline);
    if (natural > width && width > 0)
        cairo_scale(context, width / natural, width / natural);
    set_digits(context, 0, 0, digits, true);
    cairo_restore(context);
}
