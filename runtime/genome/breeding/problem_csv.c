/* Data to fit, from a CSV text. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/genome/breeding/problem.h"

#define COLUMNS_MAX 1000u

typedef struct table {
    char *names[COLUMNS_MAX];
    double *columns[COLUMNS_MAX];
    size_t width, points, capacity;
} table;

static void table_clear(table *t)
{
    for (size_t i = 0; i < t->width; i++) {
        free(t->names[i]);
        free(t->columns[i]);
    }
    free(t);
}

static tn_status bad_field(tn_error *error, size_t line, size_t begin, size_t end, const char *what)
{
    tn_fail(error, TN_INVALID, E_DATA, "%s", what);
    tn_error_place(error, line, begin + 1, end + 1);
    return TN_INVALID;
}

static bool keep_number(table *t, size_t column, double value)
{
    if (column == 0 && t->points == t->capacity) {
        size_t capacity = tn_array_larger(t->capacity, 0, 256);
        for (size_t i = 0; i < t->width; i++)
            if (!tn_array_resize(&t->columns[i], capacity, sizeof *t->columns[i]))
                return false;
        t->capacity = capacity;
    }
    t->columns[column][t->points] = value;
    return true;
}

static tn_status read_field(table *t, const char *line, size_t begin, size_t end, size_t column, size_t number,
                            tn_error *error)
{
    while (begin < end && line[begin] == ' ')
        begin++;
    while (end > begin && (line[end - 1] == ' ' || line[end - 1] == '\r'))
        end--;
    if (number == 1) {
        if (column == COLUMNS_MAX || begin == end)
            return bad_field(error, number, begin, end, "the first line names the columns, at most 1000 of them");
        t->names[column] = strndup(line + begin, end - begin);
        t->width = column + 1;
        return t->names[column] ? TN_OK : tn_fail_memory(error);
    }
    char digits[64], *stop;
    if (column >= t->width)
        return bad_field(error, number, begin, end, "the line has more fields than the first");
    if (end - begin >= sizeof digits)
        return bad_field(error, number, begin, end, "the number is too long");
    memcpy(digits, line + begin, end - begin);
    digits[end - begin] = '\0';
    double value = strtod(digits, &stop);
    if (stop == digits || *stop || !isfinite(value))
        return bad_field(error, number, begin, end, "this is not a number");
    return keep_number(t, column, value) ? TN_OK : tn_fail_memory(error);
}

static tn_status read_line(table *t, const char *line, size_t length, size_t number, tn_error *error)
{
    size_t column = 0;
    for (size_t begin = 0;; column++) {
        size_t end = begin;
        while (end < length && line[end] != ',')
            end++;
        tn_status status = read_field(t, line, begin, end, column, number, error);
        if (status != TN_OK)
            return status;
        if (end == length)
            break;
        begin = end + 1;
    }
    if (column + 1 < t->width)
        return bad_field(error, number, length, length, "the line has fewer fields than the first");
    t->points += number > 1;
    return TN_OK;
}

tn_status tn_problem_fit_csv(const char *text, size_t size, unsigned threads, tn_problem **problem, tn_error *error)
{
    *problem = NULL;
    table *t = calloc(1, sizeof *t);
    tn_status status = t ? TN_OK : tn_fail_memory(error);
    size_t number = 0;
    for (size_t at = 0; status == TN_OK && at < size; at++) {
        const char *end = memchr(text + at, '\n', size - at);
        size_t length = end ? (size_t)(end - text) - at : size - at;
        number++;
        if (length && !(length == 1 && text[at] == '\r'))
            status = read_line(t, text + at, length, number, error);
        at += length;
    }
    if (status == TN_OK && (t->width < 2 || t->points == 0))
        status =
            tn_fail(error, TN_INVALID, E_DATA, "data to fit have two columns or more, and a line of numbers or more");
    if (status == TN_OK)
        status = tn_problem_fit((const char *const *)t->names, (const double *const *)t->columns, t->width - 1,
                                t->points, threads, problem, error);
    if (t)
        table_clear(t);
    return status;
}
