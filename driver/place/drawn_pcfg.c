/* Writes LDraw models as connection grammars, line by line. What the published program does to places and rotations is
 * done here too, and counted where the result is another. */
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "driver/place/drawn.h"

enum {
    WORDS = 13,
    PLACE = 1,
    ROTATION = 4,
    ROOM_AROUND = 16,
    ONE = 0,
    TWO = 1,
    PLAIN = 2
}; /* of a line, behind its 1 */
static const double units[3] = {10, 8, 10};
static const char *const symbols[] = {"B1x1NoCheck", "B1x2NoCheck"}, *const bricks[] = {"3005", "3004"};

/* A line of type 1. */
typedef struct drawn_part {
    int32_t at[3];
    uint32_t heading;
    long colour;
    char *name; /* of the text */
    int kind;   /* ONE, TWO or PLAIN */
} drawn_part;

typedef struct converting {
    char *text; /* the lines, each ended */
    size_t size;
    const char *init;
    FILE *out;
    tn_drawn_changes *changes; /* NULL: they were counted */
    tn_error *error;
} converting;

static tn_status wrong_line(converting *c, size_t line, const char *what)
{
    return tn_fail(c->error, TN_INVALID, E_LDRAW_LINE, "line %zu: %s", line, what);
}

/* ---- reading */

/* Ends each of the first words of a line; what is left is the last. False where there are fewer. */
static bool split(char *line, char *words[WORDS + 1])
{
    for (int i = 0; i < WORDS; i++) {
        line += strspn(line, " \t");
        words[i] = line;
        line += strcspn(line, " \t");
        if (!*line)
            return false;
        *line++ = '\0';
    }
    words[WORDS] = line + strspn(line, " \t");
    return *words[WORDS] != '\0';
}

/* Rounded to whole LDU, then divided towards zero. */
static bool cells_of(const char *word, double unit, int32_t *cells, bool *exact)
{
    char *end;
    double value = strtod(word, &end);
    if (end == word || *end || !(fabs(value) < unit * (1 << 26)))
        return false;
    double whole = trunc(value + (value < 0 ? -0.5 : 0.5));
    *cells = (int32_t)(whole / unit);
    *exact &= value == *cells * unit;
    return true;
}

/* As the program tells rotations: by how the numbers are written. */
static uint32_t heading_of(char *const words[WORDS + 1])
{
    const char *r11 = words[ROTATION], *r13 = words[ROTATION + 2];
    return strcmp(r13, "-1") == 0 ? 1 : strcmp(r11, "-1") == 0 ? 2 : strcmp(r13, "1") == 0 ? 3 : 0;
}

static bool is_turned_so(char *const words[WORDS + 1], uint32_t heading)
{
    static const double rotations[4][9] = {{1, 0, 0, 0, 1, 0, 0, 0, 1},
                                           {0, 0, -1, 0, 1, 0, 1, 0, 0},
                                           {-1, 0, 0, 0, 1, 0, 0, 0, -1},
                                           {0, 0, 1, 0, 1, 0, -1, 0, 0}};
    bool same = true;
    for (int i = 0; i < 9; i++)
        same &= fabs(strtod(words[ROTATION + i], NULL) - rotations[heading][i]) < 1e-6;
    return same;
}

static int kind_of(const char *name)
{
    return strcmp(name, bricks[ONE]) == 0 ? ONE : strcmp(name, bricks[TWO]) == 0 ? TWO : PLAIN;
}

/* The name up to its first point, without blanks at its end. */
static void cut_name(char *name)
{
    name[strcspn(name, ".\r")] = '\0';
    for (size_t size = strlen(name); size > 0 && isspace((unsigned char)name[size - 1]);)
        name[--size] = '\0';
}

static void count_changes(converting *c, const drawn_part *part, bool exact, bool turned)
{
    if (!c->changes)
        return;
    c->changes->moved += !exact;
    c->changes->turned += !turned;
    c->changes->renamed += part->kind == PLAIN && strchr(part->name, 'r') != NULL;
}

/* A name that cannot stand in a terminal. */
static bool leave_out(converting *c, const char *name)
{
    if (*name && !strpbrk(name, "'\"()"))
        return false;
    if (c->changes && c->changes->left_out++ == 0)
        snprintf(c->changes->first, sizeof c->changes->first, "%s", name);
    return true;
}

/* Reads a line; *is_part: it is one that can be placed. */
static tn_status read_part(converting *c, char *line, size_t number, drawn_part *part, bool *is_part)
{
    char *words[WORDS + 1], *end;
    bool exact = true;
    *is_part = false;
    line += strspn(line, " \t");
    if (line[0] != '1' || (line[1] != ' ' && line[1] != '\t'))
        return TN_OK;
    if (!split(line + 1, words))
        return wrong_line(c, number, "12 numbers and a name stand behind the colour");
    part->colour = strtol(words[0], &end, 0);
    if (*end || part->colour < 0 || part->colour > TN_PLACE_COLOUR_MAX)
        return wrong_line(c, number, "the colour is no number");
    for (int k = 0; k < 3; k++)
        if (!cells_of(words[PLACE + k], units[k], &part->at[k], &exact))
            return wrong_line(c, number, "a place is no number, or too far");
    part->heading = heading_of(words);
    part->name = words[WORDS];
    cut_name(part->name);
    part->kind = kind_of(part->name);
    if (leave_out(c, part->name))
        return TN_OK;
    count_changes(c, part, exact, is_turned_so(words, part->heading));
    *is_part = true;
    return TN_OK;
}

/* ---- writing */

typedef tn_status part_writer(converting *c, const drawn_part *part);

static void write_place(converting *c, const drawn_part *part, bool coloured)
{
    fprintf(c->out, " '(' 'Move(%d,%d,%d)'", part->at[0], part->at[1], part->at[2]);
    if (coloured)
        fprintf(c->out, " 'SetColor(%ld)'", part->colour);
    if (part->heading)
        fprintf(c->out, " 'Rotate(%u)'", 90 * part->heading);
}

/* Room is taken for the bricks that grow on, before any of them does. */
static tn_status write_room(converting *c, const drawn_part *part)
{
    if (part->kind == PLAIN)
        return TN_OK;
    write_place(c, part, false);
    fprintf(c->out, " 'FillRectNoCheck(%d,3,2)' ')'", part->kind == ONE ? 2 : 4);
    return TN_OK;
}

static tn_status write_part(converting *c, const drawn_part *part)
{
    write_place(c, part, true);
    if (part->kind == PLAIN)
        fprintf(c->out, " 'Place(%s)' ')'", part->name);
    else
        fprintf(c->out, " %s ')'", symbols[part->kind]);
    return TN_OK;
}

/* What all parts need together. */
typedef struct extent {
    int32_t half[3];
    size_t count;
    bool has[2];
} extent;

/* Every line is split anew: words end in place. */
static tn_status each_part(converting *c, const char *text, part_writer *write, extent *all)
{
    tn_status status = TN_OK;
    size_t line = 1, files = 0;
    memcpy(c->text, text, c->size);
    c->text[c->size] = '\0';
    for (char *at = c->text; at && status == TN_OK; line++) {
        drawn_part part;
        bool is_part;
        char *next = strchr(at, '\n');
        if (next)
            *next++ = '\0';
        files += strncmp(at + strspn(at, " \t"), "0 FILE ", 7) == 0;
        if (files > 1) {
            tn_fail(c->error, TN_INVALID, E_DRAWN, "line %zu: the model has sub-files, and a grammar has none", line);
            tn_error_help(c->error, "`tartan export MODEL.mpd --kit bricks` puts them in their places");
            return TN_INVALID;
        }
        status = read_part(c, at, line, &part, &is_part);
        for (int k = 0; k < 3 && status == TN_OK && is_part && all; k++)
            all->half[k] = abs(part.at[k]) > all->half[k] ? abs(part.at[k]) : all->half[k];
        if (status == TN_OK && is_part && all) {
            all->count++;
            if (part.kind != PLAIN)
                all->has[part.kind] = true;
        }
        if (status == TN_OK && is_part && write)
            status = write(c, &part);
        at = next;
    }
    return status;
}

static void begin(converting *c, const extent *all)
{
    fputs("Init ->", c->out);
    if (c->init && *c->init) {
        fprintf(c->out, " %s", c->init);
        return;
    }
    int32_t half[3];
    for (int k = 0; k < 3; k++)
        half[k] = all->half[k] < TN_PLACE_SIZE_MAX - ROOM_AROUND ? all->half[k] + ROOM_AROUND : TN_PLACE_SIZE_MAX;
    if (!c->init)
        fprintf(c->out, " 'PlaceBoundingBox(%d,%d,%d)'", half[0], half[1], half[2]);
}

static void end(converting *c, const extent *all)
{
    fputs(" 'SetColor(71)'\n", c->out);
    for (int kind = ONE; kind <= TWO && !c->init; kind++)
        if (all->has[kind])
            fprintf(c->out, "%s -> 'Place(%s)'\n", symbols[kind], bricks[kind]);
}

static tn_status convert(converting *c, const char *text)
{
    extent all = {.count = 0};
    tn_status status = each_part(c, text, NULL, &all);
    c->changes = NULL;
    if (status != TN_OK)
        return status;
    if (all.count == 0) {
        tn_fail(c->error, TN_INVALID, E_PLACE_NOTHING, "the model has no parts");
        tn_error_help(c->error, "a part is written `1 COLOUR X Y Z A B C D E F G H I NAME.dat`");
        return TN_INVALID;
    }
    begin(c, &all);
    status = each_part(c, text, write_room, NULL);
    if (status == TN_OK)
        status = each_part(c, text, write_part, NULL);
    end(c, &all);
    return status;
}

tn_status tn_drawn_pcfg(const char *text, size_t size, const char *init, FILE *out, tn_drawn_changes *changes,
                        tn_error *error)
{
    *changes = (tn_drawn_changes){0};
    converting c = {
        .text = malloc(size + 1), .size = size, .init = init, .out = out, .changes = changes, .error = error};
    tn_status status = c.text ? convert(&c, text) : tn_fail_memory(error);
    free(c.text);
    return status;
}
