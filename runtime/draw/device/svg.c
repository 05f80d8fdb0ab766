/* Writes pictures as SVG. */
#include "runtime/draw/device/svg.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/utf8.h"
#include "runtime/math/elementary.h"

#define THOUSAND 1000.0
#define LARGEST 1e9 /* of a coordinate, in points: far beyond any page */
#define WHOLE 6.283185307179586

enum { STYLE_ROOM = 256 };

/* A growing text. */
typedef struct text {
    char *bytes; /* owned */
    size_t size, capacity;
} text;

/* What is defined once and used by its number: clips, patterns. */
typedef struct definition {
    uint64_t hash;
    char *text; /* owned */
} definition;

typedef struct definitions {
    definition *items; /* owned */
    size_t count, capacity;
} definitions;

/* A point of the page, in thousandths of a point. */
typedef struct grid_point {
    int64_t x, y;
} grid_point;

typedef struct svg {
    tn_device device;
    FILE *out;
    text path;              /* of the element that is being made */
    grid_point at, start;   /* where it is, and where its subpath began */
    bool open;              /* a stroke that others may still go on */
    char style[STYLE_ROOM]; /* of that stroke */
    definitions clips, patterns;
    char prefix[16]; /* of ids */
} svg;

/* ---- numbers: thousandths, whatever the locale */

static int64_t grid_of(double points)
{
    if (!(fabs(points) <= LARGEST))
        points = points > 0 ? LARGEST : points < 0 ? -LARGEST : 0; /* what is no number is nothing */
    return llround(points * THOUSAND);
}

/* "1.25", ".5", "-3": without zeros that say nothing. Returns its length. */
static size_t write_number(int64_t thousandths, char to[32])
{
    uint64_t size = (uint64_t)(thousandths < 0 ? -thousandths : thousandths), whole = size / 1000, part = size % 1000;
    int used = snprintf(to, 32, "%s", thousandths < 0 ? "-" : "");
    if (whole || !part)
        used += snprintf(to + used, 32 - (size_t)used, "%" PRIu64, whole);
    if (part) {
        used += snprintf(to + used, 32 - (size_t)used, ".%03" PRIu64, part);
        while (to[used - 1] == '0')
            used--;
    }
    to[used] = '\0';
    return (size_t)used;
}

static void put_number(FILE *out, const char *before, double points)
{
    char number[32];
    write_number(grid_of(points), number);
    fprintf(out, "%s%s", before, number);
}

/* ---- paths */

static bool append(text *to, const char *bytes, size_t size)
{
    if (!tn_array_reserve(&to->bytes, &to->capacity, to->size, size + 1, 1))
        return false;
    memcpy(to->bytes + to->size, bytes, size);
    to->size += size;
    to->bytes[to->size] = '\0';
    return true;
}

/* A letter and its numbers; a blank only between two digits that would run together. */
static bool append_step(text *to, char letter, const int64_t *numbers, size_t count)
{
    char step[256];
    size_t used = 0;
    step[used++] = letter;
    for (size_t i = 0; i < count; i++) {
        char number[32];
        size_t size = write_number(numbers[i], number);
        if (i > 0 && number[0] != '-')
            step[used++] = ' ';
        memcpy(step + used, number, size);
        used += size;
    }
    return append(to, step, used);
}

/* Paths begin at a place of the page and go on from point to point, each relative to the rounded one before it: short,
 * and no error adds up. */
static bool move_to(svg *s, grid_point to)
{
    bool first = s->path.size == 0;
    int64_t numbers[] = {first ? to.x : to.x - s->at.x, first ? to.y : to.y - s->at.y};
    s->at = s->start = to;
    return append_step(&s->path, first ? 'M' : 'm', numbers, 2);
}

static bool line_to(svg *s, grid_point to)
{
    int64_t numbers[] = {to.x - s->at.x, to.y - s->at.y};
    s->at = to;
    if (numbers[1] == 0)
        return append_step(&s->path, 'h', numbers, 1);
    if (numbers[0] == 0)
        return append_step(&s->path, 'v', numbers + 1, 1);
    return append_step(&s->path, 'l', numbers, 2);
}

static bool arc_part(svg *s, const tn_drawn_step *arc, double from, double to)
{
    grid_point end = {grid_of(arc->x + arc->radius * tn_cos(to)), grid_of(arc->y + arc->radius * tn_sin(to))};
    int64_t radius = grid_of(arc->radius);
    int64_t numbers[] = {
        radius,          radius,         0, fabs(to - from) > WHOLE / 2 ? 1000 : 0, to > from ? 1000 : 0,
        end.x - s->at.x, end.y - s->at.y};
    s->at = end;
    return append_step(&s->path, 'a', numbers, sizeof numbers / sizeof *numbers);
}

/* A whole circle ends where it begins, which an arc of SVG cannot: it is two halves. */
static bool arc_to(svg *s, const tn_drawn_step *arc)
{
    if (fabs(arc->to - arc->from) < WHOLE * 0.999)
        return arc_part(s, arc, arc->from, arc->to);
    double middle = (arc->from + arc->to) / 2;
    return arc_part(s, arc, arc->from, middle) && arc_part(s, arc, middle, arc->to);
}

static bool append_path(svg *s, const tn_drawn_path *path)
{
    bool fine = append(&s->path, "", 0);
    for (size_t i = 0; fine && i < path->count; i++) {
        const tn_drawn_step *step = &path->steps[i];
        grid_point to = {grid_of(step->x), grid_of(step->y)};
        if (step->kind == TN_DRAWN_MOVE) {
            fine = move_to(s, to);
        } else if (step->kind == TN_DRAWN_LINE) {
            fine = line_to(s, to);
        } else if (step->kind == TN_DRAWN_ARC) {
            fine = arc_to(s, step);
        } else {
            fine = append(&s->path, "z", 1);
            s->at = s->start;
        }
    }
    return fine;
}

/* ---- elements */

/* A stroke that is not gone on with is written. */
static void close_stroke(svg *s)
{
    if (s->open)
        fprintf(s->out, "<path fill=\"none\"%s d=\"%s\"/>\n", s->style, s->path.bytes);
    s->open = false;
    s->path.size = 0;
}

static long byte_of(double part)
{
    return lround(fmin(fmax(part, 0), 1) * 255);
}

/* ` fill="#abc"`; #aabbcc has the same three letters. */
static int write_ink(char *to, size_t room, const char *property, const tn_ink *ink)
{
    long parts[3] = {byte_of(ink->red), byte_of(ink->green), byte_of(ink->blue)};
    bool brief = true;
    char opacity[32];
    for (int i = 0; i < 3; i++)
        brief = brief && parts[i] % 17 == 0;
    int used = brief ? snprintf(to, room, " %s=\"#%lx%lx%lx\"", property, parts[0] / 17, parts[1] / 17, parts[2] / 17)
                     : snprintf(to, room, " %s=\"#%02lx%02lx%02lx\"", property, parts[0], parts[1], parts[2]);
    if (ink->opacity < 1) {
        write_number(grid_of(ink->opacity), opacity);
        used += snprintf(to + used, room - (size_t)used, " %s-opacity=\"%s\"", property, opacity);
    }
    return used;
}

/* Black is what is filled without a word. */
static void put_fill(FILE *out, const tn_ink *ink)
{
    char words[STYLE_ROOM];
    if (byte_of(ink->red) + byte_of(ink->green) + byte_of(ink->blue) == 0 && ink->opacity >= 1)
        return;
    write_ink(words, sizeof words, "fill", ink);
    fputs(words, out);
}

static tn_status fill(tn_device *device, const tn_drawn_path *path, const tn_ink *ink)
{
    svg *s = (svg *)device;
    close_stroke(s);
    if (!append_path(s, path))
        return TN_MEMORY;
    fputs("<path", s->out);
    put_fill(s->out, ink);
    fprintf(s->out, "%s d=\"%s\"/>\n", path->even_odd ? " fill-rule=\"evenodd\"" : "", s->path.bytes);
    s->path.size = 0;
    return TN_OK;
}

static void write_pen(char style[STYLE_ROOM], const tn_pen *pen, const tn_ink *ink)
{
    char number[32];
    int used = write_ink(style, STYLE_ROOM, "stroke", ink);
    write_number(grid_of(pen->width), number);
    if (grid_of(pen->width) != 1000)
        used += snprintf(style + used, STYLE_ROOM - (size_t)used, " stroke-width=\"%s\"", number);
    if (pen->cap == TN_CAP_ROUND)
        used += snprintf(style + used, STYLE_ROOM - (size_t)used, " stroke-linecap=\"round\"");
    if (pen->join == TN_JOIN_ROUND)
        used += snprintf(style + used, STYLE_ROOM - (size_t)used, " stroke-linejoin=\"round\"");
    for (uint32_t i = 0; i < pen->dash_count; i++) {
        write_number(grid_of(pen->dashes[i]), number);
        used += snprintf(style + used, STYLE_ROOM - (size_t)used, "%s%s", i ? " " : " stroke-dasharray=\"", number);
    }
    if (pen->dash_count)
        used += snprintf(style + used, STYLE_ROOM - (size_t)used, "\"");
    if (pen->dash_count && grid_of(pen->dash_offset) != 0) {
        write_number(grid_of(pen->dash_offset), number);
        snprintf(style + used, STYLE_ROOM - (size_t)used, " stroke-dashoffset=\"%s\"", number);
    }
}

/* Strokes that can be seen through are darker where they cross, so that two are not one. */
static tn_status stroke(tn_device *device, const tn_drawn_path *path, const tn_pen *pen, const tn_ink *ink)
{
    svg *s = (svg *)device;
    char style[STYLE_ROOM];
    write_pen(style, pen, ink);
    if (!s->open || strcmp(style, s->style) != 0 || ink->opacity < 1)
        close_stroke(s);
    memcpy(s->style, style, sizeof style);
    s->open = append_path(s, path);
    return s->open ? TN_OK : TN_MEMORY;
}

/* ---- lettering */

/* What XML cannot hold, escaped or not, is shown as a question mark. */
static void put_character(FILE *out, uint32_t character, const char *bytes, size_t size)
{
    bool held = character >= 0x20 && (character & 0xFFFE) != 0xFFFE && !(character == TN_REPLACEMENT && size == 1);
    if (character == '&')
        fputs("&amp;", out);
    else if (character == '<')
        fputs("&lt;", out);
    else if (character == '>')
        fputs("&gt;", out);
    else if (held)
        fwrite(bytes, 1, size, out);
    else
        fputc(character == '\t' || character == '\n' || character == '\r' ? ' ' : '?', out);
}

static void put_text(FILE *out, const char *words)
{
    size_t left = strlen(words);
    for (size_t size; left > 0; words += size, left -= size) {
        uint32_t character = tn_utf8_read(words, left, &size);
        put_character(out, character, words, size);
    }
}

/* Blanks at the ends and more than one in a row would be taken for one or none. */
static bool has_blanks(const char *words)
{
    return words[0] == ' ' || strstr(words, "  ") || (words[0] && words[strlen(words) - 1] == ' ');
}

static tn_status write_lettering(tn_device *device, const tn_lettering *l, const tn_ink *ink)
{
    static const char *const anchors[] = {"", " text-anchor=\"middle\"", " text-anchor=\"end\""};
    svg *s = (svg *)device;
    close_stroke(s);
    put_number(s->out, "<text x=\"", l->x);
    put_number(s->out, "\" y=\"", l->y);
    put_number(s->out, "\" font-size=\"", l->size);
    fprintf(s->out, "\"%s%s%s", l->bold ? " font-weight=\"bold\"" : "", anchors[l->align],
            has_blanks(l->text) ? " xml:space=\"preserve\"" : "");
    put_fill(s->out, ink);
    if (grid_of(l->angle) != 0) {
        put_number(s->out, " transform=\"rotate(", l->angle * 360 / WHOLE);
        put_number(s->out, " ", l->x);
        put_number(s->out, " ", l->y);
        fputs(")\"", s->out);
    }
    fputc('>', s->out);
    put_text(s->out, l->text);
    fputs("</text>\n", s->out);
    return TN_OK;
}

/* Nobody asks for that: what shows pixels is a picture of pixels itself. */
static tn_status refuse_pixels(tn_device *device, const tn_pixels *pixels)
{
    (void)device, (void)pixels;
    return TN_INTERNAL;
}

/* ---- what is defined once */

static uint64_t hash_of(const char *bytes)
{
    uint64_t hash = UINT64_C(14695981039346656037); /* FNV-1a */
    for (; *bytes; bytes++)
        hash = (hash ^ (unsigned char)*bytes) * UINT64_C(1099511628211);
    return hash;
}

/* The number of what has this text, the next one if it is new. */
static tn_status find_or_add(definitions *among, const char *words, size_t *number, bool *is_new)
{
    uint64_t hash = hash_of(words);
    size_t i = 0;
    while (i < among->count && (among->items[i].hash != hash || strcmp(among->items[i].text, words) != 0))
        i++;
    *number = i;
    *is_new = i == among->count;
    if (!*is_new)
        return TN_OK;
    if (!tn_array_reserve(&among->items, &among->capacity, i, 1, sizeof *among->items))
        return TN_MEMORY;
    char *copy = strdup(words);
    if (!copy)
        return TN_MEMORY;
    among->items[among->count++] = (definition){hash, copy};
    return TN_OK;
}

static void free_definitions(definitions *all)
{
    for (size_t i = 0; i < all->count; i++)
        free(all->items[i].text);
    free(all->items);
}

/* ---- clips */

static tn_status begin_clip(tn_device *device, const tn_drawn_path *path)
{
    svg *s = (svg *)device;
    size_t number;
    bool is_new;
    close_stroke(s);
    const char *rule = path->even_odd ? "\" clip-rule=\"evenodd" : "";
    if (!append_path(s, path) || !append(&s->path, rule, strlen(rule)))
        return TN_MEMORY;
    tn_status status = find_or_add(&s->clips, s->path.bytes, &number, &is_new);
    if (status == TN_OK && is_new)
        fprintf(s->out, "<clipPath id=\"%sc%zu\"><path d=\"%s\"/></clipPath>\n", s->prefix, number, s->path.bytes);
    s->path.size = 0;
    fprintf(s->out, "<g clip-path=\"url(#%sc%zu)\">\n", s->prefix, number);
    return status;
}

static tn_status end_group(tn_device *device)
{
    close_stroke((svg *)device);
    fputs("</g>\n", ((svg *)device)->out);
    return TN_OK;
}

/* ---- hatches: a pattern for each direction of lines */

#define PATTERN_WIDE 60.0 /* of lines without dashes: few places where two pieces of a line meet */

/* A tile has its lines at half of how far they are apart; two where dashes are staggered, which are half a period then.
 * Its corner stands so that the first line, which is the lowest, goes through the pattern's point. */
static tn_status write_pattern(svg *s, const tn_hatched *h, const tn_hatch_lines *lines, const tn_pen *pen,
                               const tn_ink *ink, size_t *number)
{
    char number_of[8][32], style[STYLE_ROOM], words[1024];
    double period = lines->dashes[0] + lines->dashes[1], wide = period > 0 ? period : PATTERN_WIDE,
           apart = lines->apart, angle = h->angle - lines->angle * WHOLE / 360,
           turn[2] = {tn_cos(h->angle), tn_sin(h->angle)};
    int rows = lines->shift > 0 ? 2 : 1;
    double first = (rows - 0.5) * apart, x = turn[0] * lines->x - turn[1] * lines->y + first * tn_sin(angle),
           y = turn[1] * lines->x + turn[0] * lines->y - first * tn_cos(angle);
    const double values[] = {wide * h->scale,
                             rows * apart * h->scale,
                             h->x + h->scale * x,
                             h->y + h->scale * y,
                             angle * 360 / WHOLE,
                             first * h->scale,
                             (period > 0 ? lines->dashes[0] : wide) * h->scale,
                             (first - apart) * h->scale};
    bool is_new;
    for (int i = 0; i < 8; i++)
        write_number(grid_of(values[i]), number_of[i]);
    write_pen(style, pen, ink);
    int used = snprintf(words, sizeof words,
                        " width=\"%s\" height=\"%s\" patternUnits=\"userSpaceOnUse\" "
                        "patternTransform=\"translate(%s %s)rotate(%s)\"><path%s d=\"M0 %sh%s",
                        number_of[0], number_of[1], number_of[2], number_of[3], number_of[4], style, number_of[5],
                        number_of[6]);
    if (rows > 1)
        snprintf(words + used, sizeof words - (size_t)used, "M%s %sh%s", number_of[6], number_of[7], number_of[6]);
    tn_status status = find_or_add(&s->patterns, words, number, &is_new);
    if (status == TN_OK && is_new)
        fprintf(s->out, "<pattern id=\"%sh%zu\"%s\"/></pattern>\n", s->prefix, *number, words);
    return status;
}

static tn_status hatch(tn_device *device, const tn_drawn_path *path, const tn_hatched *hatched, const tn_pen *pen,
                       const tn_ink *ink)
{
    svg *s = (svg *)device;
    size_t count;
    const tn_hatch_lines *lines = tn_hatch_made_of(hatched->hatch, &count);
    close_stroke(s);
    if (!append_path(s, path))
        return TN_MEMORY;
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        size_t number;
        status = write_pattern(s, hatched, &lines[i], pen, ink, &number);
        if (status == TN_OK)
            fprintf(s->out, "<path fill=\"url(#%sh%zu)\"%s d=\"%s\"/>\n", s->prefix, number,
                    path->even_odd ? " fill-rule=\"evenodd\"" : "", s->path.bytes);
    }
    s->path.size = 0;
    return status;
}

/* ---- symbols */

static tn_status begin_symbol(tn_device *device, size_t number, const char *name)
{
    svg *s = (svg *)device;
    close_stroke(s);
    fprintf(s->out, "<defs><g id=\"%ss%zu\" data-name=\"", s->prefix, number);
    put_text(s->out, name);
    fputs("\">\n", s->out);
    return TN_OK;
}

static tn_status end_symbol(tn_device *device)
{
    close_stroke((svg *)device);
    fputs("</g></defs>\n", ((svg *)device)->out);
    return TN_OK;
}

static tn_status use_symbol(tn_device *device, size_t number, const tn_symbol_place *place)
{
    svg *s = (svg *)device;
    bool turned = grid_of(place->angle) != 0 || place->mirrored;
    close_stroke(s);
    fprintf(s->out, "<use href=\"#%ss%zu\"", s->prefix, number);
    put_number(s->out, turned ? " transform=\"translate(" : " x=\"", place->x);
    put_number(s->out, turned ? " " : "\" y=\"", place->y);
    if (turned && grid_of(place->angle) != 0)
        put_number(s->out, ")rotate(", place->angle * 360 / WHOLE);
    fputs(!turned ? "\"/>\n" : place->mirrored ? ")scale(-1 1)\"/>\n" : ")\"/>\n", s->out);
    return TN_OK;
}

/* ---- groups */

static tn_status begin_group(tn_device *device, const char *name, size_t number)
{
    close_stroke((svg *)device);
    fprintf(((svg *)device)->out, "<g data-%s=\"%zu\">\n", name, number);
    return TN_OK;
}

static tn_status write_target(tn_device *device, double x, double y, double width, double height)
{
    FILE *out = ((svg *)device)->out;
    close_stroke((svg *)device);
    put_number(out, "<rect x=\"", x);
    put_number(out, "\" y=\"", y);
    put_number(out, "\" width=\"", width);
    put_number(out, "\" height=\"", height);
    fputs("\" fill-opacity=\"0\"/>\n", out);
    return TN_OK;
}

/* ---- the picture */

static tn_status finish(tn_device *device, tn_watch *watch, tn_error *error)
{
    (void)watch, (void)error;
    close_stroke((svg *)device);
    fputs("</svg>\n", ((svg *)device)->out);
    return TN_OK;
}

static void free_svg(tn_device *device)
{
    svg *s = (svg *)device;
    free_definitions(&s->clips);
    free_definitions(&s->patterns);
    free(s->path.bytes);
    free(s);
}

static void write_head(FILE *out, const tn_svg_options *options)
{
    if (!options->element)
        fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n", out);
    put_number(out, "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"", options->width);
    put_number(out, "pt\" height=\"", options->height);
    put_number(out, "pt\" viewBox=\"0 0 ", options->width);
    put_number(out, " ", options->height);
    fprintf(out,
            "\" font-family=\"DejaVu Sans,Verdana,sans-serif\" stroke-miterlimit=\"%.0f\">\n"
            "<rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n",
            TN_MITRE_LIMIT);
}

tn_status tn_svg_new(FILE *out, const tn_svg_options *options, tn_device **device, tn_error *error)
{
    static const tn_device_operations operations = {
        .fill = fill,
        .stroke = stroke,
        .text = write_lettering,
        .pixels = refuse_pixels,
        .begin_clip = begin_clip,
        .end_clip = end_group,
        .hatch = hatch,
        .begin_symbol = begin_symbol,
        .end_symbol = end_symbol,
        .use_symbol = use_symbol,
        .begin_group = begin_group,
        .end_group = end_group,
        .target = write_target,
        .finish = finish,
        .free = free_svg,
    };
    svg *made = calloc(1, sizeof *made);
    if (!made)
        return tn_fail_memory(error);
    made->device.operations = &operations;
    made->out = out;
    if (options->element)
        snprintf(made->prefix, sizeof made->prefix, "p%u-", options->number);
    write_head(out, options);
    *device = &made->device;
    return TN_OK;
}
