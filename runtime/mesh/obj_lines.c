/* Checks the lines of OBJ files. */
#include "runtime/mesh/obj_lines.h"

#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* The first face that names a vertex that had not come before it: it may follow. */
typedef struct later {
    long vertex;
    size_t line;
} later;

typedef struct checking {
    const char *path;
    size_t line;
    long vertices;
    later later;
    tn_error *error;
} checking;

static tn_status refuse(const checking *c, size_t line, const char *what)
{
    tn_fail(c->error, TN_INVALID, E_CANNOT_READ, "line %zu of %.200s %s", line, c->path, what);
    tn_error_help(c->error, "a vertex is written `v 1 0.5 0`, and a face by the numbers of its vertices, `f 1 2 3`");
    return TN_INVALID;
}

static const char *next_word(const char *text)
{
    text += strcspn(text, " \t\r");
    return text + strspn(text, " \t\r");
}

static tn_status check_vertex(checking *c, const char *numbers)
{
    c->vertices++;
    for (int k = 0; k < 3; k++) {
        char *end;
        double number = strtod(numbers, &end);
        if (end == numbers || !strchr(" \t\r", *end) || !isfinite(number))
            return refuse(c, c->line, "has a vertex without three numbers");
        numbers = next_word(numbers);
    }
    return TN_OK;
}

/* Corners are `7`, `7/2`, `7//4` or `7/2/4`; below 0 they count back from the last vertex. */
static tn_status check_face(checking *c, const char *corner)
{
    for (; *corner && *corner != '#'; corner = next_word(corner)) {
        char *end, what[100];
        long vertex = strtol(corner, &end, 10);
        bool number = end > corner && strchr("/ \t\r", *end);
        if (!number || vertex == 0 || vertex < -c->vertices) {
            snprintf(what, sizeof what, "has a face with the corner `%.*s`, which is no vertex",
                     (int)strcspn(corner, " \t\r"), corner);
            return refuse(c, c->line, what);
        }
        if (vertex > c->vertices && vertex > c->later.vertex)
            c->later = (later){vertex, c->line};
    }
    return TN_OK;
}

static tn_status check_line(checking *c, char *line)
{
    line += strspn(line, " \t");
    bool vertex = line[0] == 'v', face = line[0] == 'f';
    if ((!vertex && !face) || !strchr(" \t", line[1]) || !line[1])
        return TN_OK;
    return vertex ? check_vertex(c, next_word(line)) : check_face(c, next_word(line));
}

static tn_status check_lines(checking *c, FILE *file)
{
    char *line = NULL;
    size_t capacity = 0;
    bool continued = false; /* such a line is left to the reader */
    ssize_t length;
    tn_status status = TN_OK;
    for (c->line = 1; status == TN_OK && (length = getline(&line, &capacity, file)) >= 0; c->line++) {
        while (length > 0 && strchr("\r\n", line[length - 1]))
            line[--length] = '\0';
        bool goes_on = length > 0 && line[length - 1] == '\\';
        if (!goes_on && !continued)
            status = check_line(c, line);
        continued = goes_on;
    }
    free(line);
    return status;
}

/* NULL of what can be read only once, or not at all. */
static FILE *open_file(const char *path)
{
    struct stat state;
    int descriptor = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    FILE *file =
        descriptor >= 0 && fstat(descriptor, &state) == 0 && S_ISREG(state.st_mode) ? fdopen(descriptor, "r") : NULL;
    if (!file && descriptor >= 0)
        close(descriptor);
    return file;
}

tn_status tn_obj_check(const char *path, tn_error *error)
{
    checking c = {.path = path, .error = error};
    FILE *file = open_file(path);
    if (!file)
        return TN_OK;
    tn_status status = check_lines(&c, file);
    fclose(file);
    if (status != TN_OK || c.later.vertex <= c.vertices)
        return status;
    char what[100];
    snprintf(what, sizeof what, "has a face with vertex %ld, and the file has %ld", c.later.vertex, c.vertices);
    return refuse(&c, c.later.line, what);
}
