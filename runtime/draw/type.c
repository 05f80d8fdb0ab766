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

/* Copies what can be shown, what is hidden as escapes: a device wants UTF-8. false if there is no room for all of
 * it. */
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

void tn_type_veil(tn_paint *paint, double x, double y, double width, double height, double opacity)
{
    tn_paint_rectangle(paint, x, y, width, height);
    tn_paint_translucent(paint, 1, 1, 1, opacity);
    tn_paint_fill(paint);
    tn_paint_colour(paint, 0, 0, 0);
}

double tn_type_width(const tn_paint *paint, const char *text)
{
    char cleaned[TEXT_ROOM];
    clean(text, cleaned);
    return tn_paint_text_width(paint, cleaned);
}

void tn_type_line(tn_paint *paint, double x, double baseline, tn_align align, const char *text)
{
    char cleaned[TEXT_ROOM];
    clean(text, cleaned);
    tn_paint_text(paint, x, baseline, align, cleaned);
}

/* Shortens a cleaned text until it and an ellipsis are at most `width`. `room`: of the buffer. */
static void cut_off(const tn_paint *paint, char cleaned[TEXT_ROOM], double width)
{
    size_t length = strlen(cleaned);
    while (length > 0) {
        do
            length--;
        while (length > 0 && ((unsigned char)cleaned[length] & 0xc0) == 0x80);
        while (length > 0 && cleaned[length - 1] == ' ')
            length--;
        strcpy(cleaned + length, ELLIPSIS);
        if (tn_paint_text_width(paint, cleaned) <= width)
            return;
    }
    cleaned[0] = '\0';
}

void tn_type_fit(tn_paint *paint, double x, double baseline, tn_align align, double width, const char *text)
{
    char cleaned[TEXT_ROOM];
    clean(text, cleaned);
    if (tn_paint_text_width(paint, cleaned) > width)
        cut_off(paint, cleaned, width);
    tn_paint_text(paint, x, baseline, align, cleaned);
}

/* How many bytes of a cleaned text fit on one line: whole words, at least one. */
static size_t line_bytes(const tn_paint *paint, const char *text, double width)
{
    char line[PARAGRAPH_ROOM];
    size_t fits = 0, length = strlen(text);
    while (fits < length) {
        size_t end = fits + (text[fits] == ' ');
        end += strcspn(text + end, " ");
        snprintf(line, sizeof line, "%.*s", (int)end, text);
        if (fits && tn_paint_text_width(paint, line) > width)
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
static void last_line(const tn_paint *paint, const char *text, double width, char line[PARAGRAPH_ROOM])
{
    bool all = tn_paint_text_width(paint, text) <= width;
    size_t bytes = all ? strlen(text) : line_bytes(paint, text, width - tn_paint_text_width(paint, " " ELLIPSIS));
    snprintf(line, PARAGRAPH_ROOM, "%.*s%s", (int)bytes, text, all ? "" : " " ELLIPSIS);
}

unsigned tn_type_paragraph(tn_paint *paint, double x, double baseline, double width, double leading, unsigned max_lines,
                           const char *text)
{
    char cleaned[PARAGRAPH_ROOM], line[PARAGRAPH_ROOM];
    clean_paragraph(text, cleaned);
    const char *at = cleaned;
    unsigned lines = 0;
    while (*at && lines < max_lines) {
        size_t bytes = line_bytes(paint, at, width);
        if (lines + 1 == max_lines)
            last_line(paint, at, width, line);
        else
            snprintf(line, sizeof line, "%.*s", (int)bytes, at);
        if (tn_paint_text_width(paint, line) <= width)
            tn_paint_text(paint, x, baseline + lines * leading, TN_ALIGN_LEFT, line);
        else /* one word that is too long */
            tn_type_fit(paint, x, baseline + lines * leading, TN_ALIGN_LEFT, width, line);
        at += bytes + (at[bytes] == ' ');
        lines++;
    }
    return lines;
}

/* Sets the groups from x on and returns where they end; only measures where `show` is false. */
static double set_digits(tn_paint *paint, double x, double baseline, const char *digits, bool show)
{
    size_t length = strlen(digits);
    for (size_t i = 0; i < length;) {
        char group[4];
        size_t size = (length - i) % 3 ? (length - i) % 3 : 3;
        snprintf(group, sizeof group, "%.*s", (int)size, digits + i);
        if (show)
            tn_type_line(paint, x, baseline, TN_ALIGN_LEFT, group);
        x += tn_type_width(paint, group) + tn_paint_line_height(paint) * 0.12;
        i += size;
    }
    return x;
}

void tn_type_digits(tn_paint *paint, double x, double baseline, double width, const char *digits)
{
    double natural = set_digits(paint, 0, 0, digits, false);
    tn_paint_save(paint);
    tn_paint_translate(paint, x, baseline);
    if (natural > width && width > 0)
        tn_paint_scale(paint, width / natural);
    set_digits(paint, 0, 0, digits, true);
    tn_paint_restore(paint);
}
