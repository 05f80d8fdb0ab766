/* Reads part files: goes into sub-files with a matrix, and widens the box by the corners of what they draw. */
#include "runtime/place/part_file.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

enum { DEPTH_MAX = 32, STUDS_MAX = 4096, LINES_MAX = 1000000, NAME_SIZE = 256, NUMBERS = 12 };
static const double near_axis = 0.01, stud_height = 4;

/* A file that was read once. */
typedef struct known_file {
    struct known_file *next;
    char name[NAME_SIZE];
    char *text;
} known_file;

/* A file that is gone through, and the one that it is in. */
typedef struct place {
    const struct place *outer;
    const char *name;
    double at[NUMBERS]; /* a place, then the rows of a matrix */
    int depth;
} place;

typedef struct reader {
    const tn_part_library *library;
    tn_part_file *part;
    known_file *files;
    size_t lines;
    tn_error *error;
} reader;

/* ---- files */

static tn_status get(reader *r, const char *name, const known_file **found)
{
    uint8_t *bytes = NULL;
    size_t size = 0;
    for (*found = r->files; *found; *found = (*found)->next)
        if (strcmp((*found)->name, name) == 0)
            return TN_OK;
    tn_status status = r->library->read(r->library->context, name, &bytes, &size, r->error);
    if (status != TN_OK)
        return status;
    known_file *file = calloc(1, sizeof *file);
    char *text = file ? malloc(size + 1) : NULL;
    if (text) {
        memcpy(text, bytes, size);
        text[size] = '\0';
        snprintf(file->name, sizeof file->name, "%s", name);
        file->text = text;
        file->next = r->files;
        *found = r->files = file;
    } else {
        free(file);
    }
    free(bytes);
    return text ? TN_OK : tn_fail_memory(r->error);
}

static bool take_name(const char *text, size_t size, char name[NAME_SIZE])
{
    while (size > 0 && isspace((unsigned char)text[size - 1]))
        size--;
    if (size == 0 || size >= NAME_SIZE)
        return false;
    for (size_t i = 0; i < size; i++)
        name[i] = text[i] == '\\' ? '/' : (char)tolower((unsigned char)text[i]);
    name[size] = '\0';
    return true;
}

/* ---- geometry */

static void move(const double at[NUMBERS], const double from[3], double to[3])
{
    for (int row = 0; row < 3; row++)
        to[row] = at[row] + at[3 + 3 * row] * from[0] + at[4 + 3 * row] * from[1] + at[5 + 3 * row] * from[2];
}

static void compose(const double outer[NUMBERS], const double inner[NUMBERS], double result[NUMBERS])
{
    move(outer, inner, result);
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++) {
            double sum = 0;
            for (int k = 0; k < 3; k++)
                sum += outer[3 + 3 * row + k] * inner[3 + 3 * k + column];
            result[3 + 3 * row + column] = sum;
        }
}

/* The axis along which something points, or TN_AXIS_COUNT. */
static tn_axis axis_of(const double along[3])
{
    static const tn_axis axes[3][2] = {
        {TN_AXIS_LEFT, TN_AXIS_RIGHT}, {TN_AXIS_UP, TN_AXIS_DOWN}, {TN_AXIS_FRONT, TN_AXIS_BACK}};
    double length = sqrt(along[0] * along[0] + along[1] * along[1] + along[2] * along[2]);
    for (int k = 0; k < 3 && length > 0; k++)
        if (fabs(fabs(along[k]) / length - 1) < near_axis * near_axis)
            return axes[k][along[k] > 0];
    return TN_AXIS_COUNT;
}

/* The kind of a stud, by the first line of its file: "Stud Tube Open", "Stud Tube Solid", or a stud. */
static tn_part_stud_kind kind_of(const char *text)
{
    const char *end = strchr(text, '\n'), *tube = strstr(text, "Tube"), *solid = strstr(text, "Solid");
    if (!tube || (end && tube > end))
        return TN_PART_STUD;
    return solid && (!end || solid < end) ? TN_PART_PIN : TN_PART_TUBE;
}

static tn_status add_stud(reader *r, const double at[NUMBERS], tn_part_stud_kind kind)
{
    tn_part_file *part = r->part;
    const double top[3] = {0, -stud_height, 0}, foot[3] = {0, 0, 0};
    double end[3], begin[3], along[3];
    move(at, top, end);
    move(at, foot, begin);
    for (int k = 0; k < 3; k++)
        along[k] = end[k] - begin[k];
    tn_part_stud stud = {.axis = axis_of(along), .kind = kind};
    if (stud.axis == TN_AXIS_COUNT) {
        part->tilted++;
        return TN_OK;
    }
    if (part->stud_count == STUDS_MAX)
        return tn_fail(r->error, TN_LIMIT, TN_CODE_NONE, "it has more than %d studs", STUDS_MAX);
    memcpy(stud.at, kind == TN_PART_STUD ? begin : end, sizeof stud.at);
    if (!tn_array_reserve(&part->studs, &part->stud_capacity, part->stud_count, 1, sizeof stud))
        return tn_fail_memory(r->error);
    part->studs[part->stud_count++] = stud;
    return TN_OK;
}

/* ---- lines */

static tn_status wrong_line(const reader *r, const place *at, size_t line, const char *what)
{
    return tn_fail(r->error, TN_INVALID, TN_CODE_NONE, "%.120s, line %zu: %s", at->name, line, what);
}

/* So many numbers from *text on, which moves behind them. */
static bool read_numbers(const char **text, const char *end, double *numbers, int count)
{
    for (int i = 0; i < count; i++) {
        char *behind;
        while (*text < end && (**text == ' ' || **text == '\t'))
            (*text)++;
        if (*text >= end)
            return false;
        numbers[i] = strtod(*text, &behind);
        if (behind == *text || behind > end || !isfinite(numbers[i]))
            return false;
        *text = behind;
    }
    return true;
}

static tn_status go_through(reader *r, const place *at);

static tn_status go_into(reader *r, const place *outer, const char *text, const char *end, size_t line)
{
    char name[NAME_SIZE];
    place inner = {.outer = outer, .name = name, .depth = outer->depth + 1};
    double colour, own[NUMBERS];
    const known_file *file;
    if (!read_numbers(&text, end, &colour, 1) || !read_numbers(&text, end, own, NUMBERS))
        return wrong_line(r, outer, line, "a colour and 12 numbers come before the name of a sub-file");
    while (text < end && isspace((unsigned char)*text))
        text++;
    if (!take_name(text, (size_t)(end - text), name))
        return wrong_line(r, outer, line, "the sub-file has no name, or a long one");
    for (const place *above = outer; above; above = above->outer)
        if (strcmp(above->name, name) == 0)
            return wrong_line(r, outer, line, "this sub-file contains itself");
    if (inner.depth > DEPTH_MAX)
        return tn_fail(r->error, TN_LIMIT, TN_CODE_NONE, "sub-files nest deeper than %d", DEPTH_MAX);
    compose(outer->at, own, inner.at);
    const char *base = strrchr(name, '/');
    if (strncmp(base ? base + 1 : name, "stud", 4) != 0)
        return go_through(r, &inner);
    tn_status status = get(r, name, &file);
    return status == TN_OK ? add_stud(r, inner.at, kind_of(file->text)) : status;
}

/* Lines 2 to 5 draw: 2, 3 and 4 corners; of 5 the first two are drawn. */
static tn_status widen(reader *r, const place *at, const char *text, const char *end, size_t line)
{
    int corners = *text == '5' ? 2 : *text - '0';
    double colour, from[3], to[3];
    text++;
    if (!read_numbers(&text, end, &colour, 1))
        return wrong_line(r, at, line, "the colour is no number");
    for (int i = 0; i < corners; i++) {
        if (!read_numbers(&text, end, from, 3))
            return wrong_line(r, at, line, "a corner is three numbers");
        move(at->at, from, to);
        for (int k = 0; k < 3; k++) {
            r->part->low[k] = fmin(r->part->low[k], to[k]);
            r->part->high[k] = fmax(r->part->high[k], to[k]);
        }
    }
    return TN_OK;
}

/* Recursion is as deep as files nest, which is checked. */
static tn_status go_through(reader *r, const place *at)
{
    const known_file *file;
    tn_status status = get(r, at->name, &file);
    const char *text = status == TN_OK ? file->text : NULL;
    for (size_t line = 1; status == TN_OK && text && *text; line++) {
        const char *end = strchr(text, '\n'), *next = end ? end + 1 : NULL;
        end = end ? end : text + strlen(text);
        while (text < end && (*text == ' ' || *text == '\t'))
            text++;
        bool typed = end - text > 1 && (text[1] == ' ' || text[1] == '\t');
        if (++r->lines > LINES_MAX)
            return tn_fail(r->error, TN_LIMIT, TN_CODE_NONE, "its files have more than %d lines together", LINES_MAX);
        if (typed && *text == '1')
            status = go_into(r, at, text + 1, end, line);
        else if (typed && *text >= '2' && *text <= '5')
            status = widen(r, at, text, end, line);
        text = next;
    }
    return status;
}

tn_status tn_part_file_read(const tn_part_library *library, const char *name, tn_part_file *part, tn_error *error)
{
    reader r = {.library = library, .part = part, .error = error};
    char own[NAME_SIZE];
    place first = {.name = own, .at = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}};
    *part = (tn_part_file){.low = {INFINITY, INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY, -INFINITY}};
    tn_status status = take_name(name, strlen(name), own)
                           ? go_through(&r, &first)
                           : tn_fail(error, TN_INVALID, TN_CODE_NONE, "the file has no name, or a long one");
    for (known_file *file = r.files, *next; file; file = next) {
        next = file->next;
        free(file->text);
        free(file);
    }
    return status;
}

void tn_part_file_clear(tn_part_file *part)
{
    free(part->studs);
    *part = (tn_part_file){0};
}
