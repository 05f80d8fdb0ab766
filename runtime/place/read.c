/* Reads LDraw files line by line. A line `0 FILE NAME` begins a sub-file; the first is the model. */
#include "runtime/place/read.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "runtime/base/array.h"

enum { DEPTH_MAX = 32, PARTS_MAX = 1000000, VISITS_MAX = 10000000, NUMBERS = 12 };

/* A reference of a line of type 1. */
typedef struct reference {
    size_t line;
    int32_t colour;
    double at[NUMBERS]; /* place, then the rows of the matrix */
    char *name;         /* of our own text */
    uint32_t file;      /* the sub-file of this name; 0, which is the model: none, a part */
} reference;

typedef struct subfile {
    char *name;          /* NULL: the model has none */
    const char *beside;  /* the file beside the text that it is in; NULL: it is in the text */
    size_t first, count; /* references */
    bool whole;          /* it is a text of its own, which may begin with a line 0 FILE */
    bool open;           /* it is being put in place */
} subfile;

typedef struct reader {
    tn_ldraw *ldraw;
    const double *unit;
    uint32_t turns; /* that parts may have */
    reference *references;
    size_t reference_count, reference_capacity;
    subfile *files;
    size_t file_count, file_capacity;
    const char *beside; /* the file that is being read, as in subfiles */
    size_t visited;     /* references, each as often as its file is put in place */
    tn_error *error;
} reader;

/* ---- lines */

static tn_status wrong_line(reader *r, size_t line, const char *what)
{
    return tn_fail(r->error, TN_INVALID, E_LDRAW_LINE, "%.200s%sline %zu: %s", r->beside ? r->beside : "",
                   r->beside ? ", " : "", line, what);
}

static char *skip_blanks(char *text)
{
    while (*text == ' ' || *text == '\t')
        text++;
    return text;
}

/* The rest of a line, with / for \, without blanks at its end. */
static char *take_name(char *text)
{
    size_t size = strlen(text);
    while (size > 0 && isspace((unsigned char)text[size - 1]))
        text[--size] = '\0';
    for (char *c = text; *c; c++)
        *c = *c == '\\' ? '/' : *c;
    return text;
}

static tn_status read_reference(reader *r, char *text, size_t line)
{
    char *end;
    long colour = strtol(text, &end, 0); /* direct colours are 0x2RRGGBB */
    reference made = {.line = line, .colour = (int32_t)colour};
    if (end == text || colour < 0 || colour > TN_PLACE_COLOUR_MAX)
        return wrong_line(r, line, "the colour is no number");
    for (int i = 0; i < NUMBERS; i++) {
        text = end;
        made.at[i] = strtod(text, &end);
        if (end == text || !isfinite(made.at[i]) || (*end && !isspace((unsigned char)*end)))
            return wrong_line(r, line, "12 numbers stand behind the colour");
    }
    made.name = take_name(skip_blanks(end));
    if (!*made.name)
        return wrong_line(r, line, "the part has no name");
    if (!tn_array_reserve(&r->references, &r->reference_capacity, r->reference_count, 1, sizeof made))
        return tn_fail_memory(r->error);
    r->references[r->reference_count++] = made;
    r->files[r->file_count - 1].count++;
    return TN_OK;
}

static tn_status begin_file(reader *r, char *name)
{
    if (!tn_array_reserve(&r->files, &r->file_capacity, r->file_count, 1, sizeof *r->files))
        return tn_fail_memory(r->error);
    r->files[r->file_count++] = (subfile){.name = name, .beside = r->beside, .first = r->reference_count};
    return TN_OK;
}

static tn_status read_line(reader *r, char *text, size_t line)
{
    text = skip_blanks(text);
    if (strncmp(text, "0 FILE ", 7) == 0) {
        subfile *last = &r->files[r->file_count - 1];
        char *name = take_name(skip_blanks(text + 7));
        bool first = last->whole && last->count == 0;
        last->whole &= !first;
        if (!first)
            return begin_file(r, name);
        last->name = last->name ? last->name : name;
        return TN_OK;
    }
    if (text[0] == '1' && (text[1] == ' ' || text[1] == '\t'))
        return read_reference(r, text + 1, line);
    return TN_OK;
}

/* name: of the sub-file that the text is; NULL: it is the model. */
static tn_status read_lines(reader *r, char *text, char *name)
{
    tn_status status = begin_file(r, name);
    if (status == TN_OK)
        r->files[r->file_count - 1].whole = true;
    for (size_t line = 1; text && status == TN_OK; line++) {
        char *next = strchr(text, '\n');
        if (next)
            *next++ = '\0';
        status = read_line(r, text, line);
        text = next;
    }
    return status;
}

/* ---- placing */

static const double near_turn = 0.01, near_cell = 0.1;

/* How far a matrix is from a turn: the largest difference of two numbers. */
static double off_turn(const double m[9], uint32_t turn)
{
    static const tn_axis columns[3] = {TN_AXIS_RIGHT, TN_AXIS_DOWN, TN_AXIS_BACK};
    double off = 0;
    for (int column = 0; column < 3; column++) {
        tn_axis to = tn_axis_turn(columns[column], turn);
        for (int row = 0; row < 3; row++) {
            double value = to == columns[row] ? 1 : to == tn_axis_opposite(columns[row]) ? -1 : 0;
            off = fmax(off, fabs(m[3 * row + column] - value));
        }
    }
    return off;
}

/* The turn that a matrix is, or nearly is; -1: it is none of the first so many. */
static int heading_of(const double m[9], uint32_t turns, bool *exact)
{
    for (uint32_t turn = 0; turn < turns; turn++) {
        double off = off_turn(m, turn);
        if (off > near_turn)
            continue;
        *exact &= off == 0;
        return (int)turn;
    }
    return -1;
}

static bool cells_of(const reader *r, const double at[3], int32_t cells[3], bool *exact)
{
    for (int k = 0; k < 3; k++) {
        double value = at[k] / r->unit[k], whole = floor(value + 0.5);
        if (fabs(value - whole) > near_cell || fabs(whole) > TN_PLACE_FAR)
            return false;
        *exact &= fabs(value - whole) < 1e-6;
        cells[k] = (int32_t)whole;
    }
    return true;
}

static tn_status add_part(reader *r, const reference *from, const double at[NUMBERS], int32_t colour)
{
    tn_placed_model *model = &r->ldraw->model;
    tn_placed_part part = {.frame.colour = colour, .name = from->name};
    bool exact = true;
    int heading = heading_of(at + 3, r->turns, &exact);
    if (heading < 0) {
        r->ldraw->tilted++;
        r->ldraw->first_tilted = r->ldraw->first_tilted ? r->ldraw->first_tilted : from->name;
        return TN_OK;
    }
    if (!cells_of(r, at, part.frame.at, &exact)) {
        r->ldraw->beside++;
        r->ldraw->first_beside = r->ldraw->first_beside ? r->ldraw->first_beside : from->name;
        return TN_OK;
    }
    part.frame.heading = (uint32_t)heading;
    r->ldraw->snapped += !exact;
    if (model->count == PARTS_MAX)
        return tn_fail(r->error, TN_LIMIT, E_PLACE_LIMIT, "the model has more than %d parts", PARTS_MAX);
    if (!tn_array_reserve(&model->parts, &model->capacity, model->count, 1, sizeof part))
        return tn_fail_memory(r->error);
    model->parts[model->count++] = part;
    return TN_OK;
}

/* outer after inner: a place and a matrix each. */
static void compose(const double outer[NUMBERS], const double inner[NUMBERS], double result[NUMBERS])
{
    for (int row = 0; row < 3; row++) {
        const double *m = outer + 3 + 3 * row;
        result[row] = outer[row] + m[0] * inner[0] + m[1] * inner[1] + m[2] * inner[2];
        for (int column = 0; column < 3; column++)
            result[3 + 3 * row + column] =
                m[0] * inner[3 + column] + m[1] * inner[6 + column] + m[2] * inner[9 + column];
    }
}

static tn_status wrong_reference(reader *r, const subfile *file, size_t line, const char *what)
{
    r->beside = file->beside;
    return wrong_line(r, line, what);
}

/* Recursion is as deep as sub-files nest, at most DEPTH_MAX. */
static tn_status place_file(reader *r, subfile *file, const double at[NUMBERS], int32_t colour, int depth)
{
    enum { OUTER_COLOUR = 16 };
    tn_status status = TN_OK;
    file->open = true;
    for (size_t i = 0; i < file->count && status == TN_OK; i++) {
        const reference *from = &r->references[file->first + i];
        subfile *sub = from->file ? &r->files[from->file] : NULL;
        double placed[NUMBERS];
        int32_t own = from->colour == OUTER_COLOUR ? colour : from->colour;
        if (++r->visited > VISITS_MAX)
            return tn_fail(r->error, TN_LIMIT, E_PLACE_LIMIT, "the sub-files have more than %d lines together",
                           VISITS_MAX);
        compose(at, from->at, placed);
        if (!sub)
            status = add_part(r, from, placed, own);
        else if (sub->open || depth == DEPTH_MAX)
            status = wrong_reference(r, file, from->line,
                                     "this sub-file contains itself, or too many others in one another");
        else
            status = place_file(r, sub, placed, own, depth + 1);
    }
    file->open = false;
    return status;
}

/* ---- names */

static bool ends_in(const char *name, const char *ending)
{
    size_t size = strlen(name), length = strlen(ending);
    return size > length && strcasecmp(name + size - length, ending) == 0;
}

/* In small letters, without .dat. */
static void make_plain(char *name)
{
    if (!name)
        return;
    if (ends_in(name, ".dat"))
        name[strlen(name) - 4] = '\0';
    for (char *c = name; *c; c++)
        *c = (char)tolower((unsigned char)*c);
}

static int by_name(const void *a, const void *b)
{
    const reference *const *one = a, *const *other = b;
    return strcasecmp((*one)->name, (*other)->name);
}

/* References from `first` on, by their names. NULL if out of memory. */
static reference **sort_references(const reader *r, size_t first)
{
    size_t count = r->reference_count - first;
    reference **sorted = malloc((count + 1) * sizeof *sorted);
    for (size_t i = 0; sorted && i < count; i++)
        sorted[i] = &r->references[first + i];
    if (sorted)
        qsort(sorted, count, sizeof *sorted, by_name);
    return sorted;
}

/* Equal names become one text: parts are counted by it. */
static tn_status share_names(reader *r)
{
    for (size_t i = 0; i < r->file_count; i++)
        make_plain(r->files[i].name);
    for (size_t i = 0; i < r->reference_count; i++)
        make_plain(r->references[i].name);
    reference **sorted = sort_references(r, 0);
    if (!sorted)
        return tn_fail_memory(r->error);
    for (size_t i = 1; i < r->reference_count; i++)
        if (strcmp(sorted[i]->name, sorted[i - 1]->name) == 0)
            sorted[i]->name = sorted[i - 1]->name;
    free(sorted);
    return TN_OK;
}

/* Of files of one name the first counts. */
static int by_file_name(const void *a, const void *b)
{
    const subfile *const *one = a, *const *other = b;
    int order = strcasecmp((*one)->name, (*other)->name);
    return order != 0 ? order : (*one > *other) - (*one < *other);
}

/* The sub-files by their names: all but the model, which cannot be one. NULL if out of memory. */
static subfile **sort_files(const reader *r)
{
    subfile **sorted = malloc(r->file_count * sizeof *sorted);
    for (size_t i = 1; sorted && i < r->file_count; i++)
        sorted[i - 1] = &r->files[i];
    if (sorted)
        qsort(sorted, r->file_count - 1, sizeof *sorted, by_file_name);
    return sorted;
}

/* The first of sorted files with a name; 0: there is none. */
static uint32_t find_file(const reader *r, subfile *const *sorted, size_t count, const char *name)
{
    size_t low = 0, high = count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (strcasecmp(sorted[middle]->name, name) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low < count && strcasecmp(sorted[low]->name, name) == 0 ? (uint32_t)(sorted[low] - r->files) : 0;
}

/* Which sub-file each reference names. */
static tn_status find_files(reader *r)
{
    subfile **sorted = sort_files(r);
    if (!sorted)
        return tn_fail_memory(r->error);
    for (size_t i = 0; i < r->reference_count; i++)
        r->references[i].file = find_file(r, sorted, r->file_count - 1, r->references[i].name);
    free(sorted);
    return TN_OK;
}

/* ---- texts */

/* Reads a copy of a text; name: of the sub-file that it is, in a text that was read before. */
static tn_status read_text(reader *r, const char *text, size_t size, char *name)
{
    tn_ldraw *ldraw = r->ldraw;
    char *copy = tn_array_resize(&ldraw->texts, ldraw->text_count + 1, sizeof *ldraw->texts) ? malloc(size + 1) : NULL;
    if (!copy)
        return tn_fail_memory(r->error);
    ldraw->texts[ldraw->text_count++] = copy;
    memcpy(copy, text, size);
    copy[size] = '\0';
    r->beside = name;
    return read_lines(r, copy, name);
}

/* Parts are .dat files, and an empty folder name leads out of where the text lies. */
static bool may_lie_beside(const char *name)
{
    return (ends_in(name, ".ldr") || ends_in(name, ".mpd")) && name[0] != '/' && !strstr(name, "..");
}

static tn_status read_beside(reader *r, const tn_ldraw_files *beside, char *name)
{
    uint8_t *bytes = NULL;
    size_t size = 0;
    tn_status status = beside->find(beside->context, name, &bytes, &size, r->error);
    if (status == TN_OK && bytes)
        status = read_text(r, (const char *)bytes, size, name);
    free(bytes);
    return status;
}

/* Reads the files that references from *done on name, each once. */
static tn_status read_named(reader *r, const tn_ldraw_files *beside, size_t *done)
{
    size_t count = r->reference_count - *done, known = r->file_count - 1;
    reference **references = sort_references(r, *done);
    subfile **files = sort_files(r);
    char **names = malloc((count + 1) * sizeof *names); /* references move while files are read */
    size_t name_count = 0;
    tn_status status = references && files && names ? TN_OK : tn_fail_memory(r->error);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        char *name = references[i]->name;
        bool again = i > 0 && strcasecmp(references[i - 1]->name, name) == 0;
        if (!again && may_lie_beside(name) && !find_file(r, files, known, name))
            names[name_count++] = name;
    }
    *done = r->reference_count;
    for (size_t i = 0; status == TN_OK && i < name_count; i++)
        status = read_beside(r, beside, names[i]);
    free(references);
    free(files);
    free(names);
    return status;
}

tn_status tn_ldraw_read(const char *text, size_t size, const double unit[3], uint32_t turns,
                        const tn_ldraw_files *beside, tn_ldraw *ldraw, tn_error *error)
{
    static const double here[NUMBERS] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    reader r = {.ldraw = ldraw, .unit = unit, .turns = turns, .error = error};
    size_t done = 0;
    *ldraw = (tn_ldraw){0};
    tn_status status = read_text(&r, text, size, NULL);
    while (status == TN_OK && beside && done < r.reference_count)
        status = read_named(&r, beside, &done);
    if (status == TN_OK)
        status = share_names(&r);
    if (status == TN_OK)
        status = find_files(&r);
    if (status == TN_OK)
        status = place_file(&r, &r.files[0], here, 1, 0);
    free(r.references);
    free(r.files);
    return status;
}

void tn_ldraw_clear(tn_ldraw *ldraw)
{
    tn_placed_model_clear(&ldraw->model);
    for (size_t i = 0; i < ldraw->text_count; i++)
        free(ldraw->texts[i]);
    free(ldraw->texts);
    *ldraw = (tn_ldraw){0};
}
