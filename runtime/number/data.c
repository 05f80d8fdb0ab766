/* Reads columns of numbers from a text. */
#include "runtime/number/data.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

void tn_data_clear(tn_data *t)
{
    for (size_t i = 0; i < t->width; i++) {
        free(t->names[i]);
        free(t->columns[i]);
    }
    *t = (tn_data){0};
}

static tn_status bad_field(tn_error *error, size_t line, size_t begin, size_t end, const char *what)
{
    tn_fail(error, TN_INVALID, E_DATA, "%s", what);
    tn_error_place(error, line, begin + 1, end + 1);
    return TN_INVALID;
}

static bool keep_number(tn_data *t, size_t column, double value)
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

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

static tn_status read_field(tn_data *t, const char *line, size_t begin, size_t end, size_t column, size_t number,
                            tn_error *error)
{
    while (begin < end && is_blank(line[begin]))
        begin++;
    while (end > begin && is_blank(line[end - 1]))
        end--;
    if (t->points == 0 && column == t->width) {
        if (column == TN_DATA_COLUMNS_MAX || begin == end)
            return bad_field(error, number, begin, end, "the first line names the columns, at most 1000 of them");
        t->names[column] = strndup(line + begin, end - begin);
        t->width = column + 1;
        return t->names[column] ? TN_OK : tn_fail_memory(error);
    }
    char digits[64], *stop;
    if (end - begin >= sizeof digits)
        return bad_field(error, number, begin, end, "the number is too long");
    memcpy(digits, line + begin, end - begin);
    digits[end - begin] = '\0';
    double value = strtod(digits, &stop);
    if (stop == digits || *stop || !isfinite(value))
        return bad_field(error, number, begin, end, "this is not a number");
    return keep_number(t, column, value) ? TN_OK : tn_fail_memory(error);
}

/* Where the field that begins at `begin` ends: blanks separate as many as there are together. */
static size_t end_of_field(const char *line, size_t begin, size_t length, char separator)
{
    while (begin < length && (separator == ' ' ? !is_blank(line[begin]) : line[begin] != separator))
        begin++;
    return begin;
}

static size_t begin_of_next(const char *line, size_t end, size_t length, char separator)
{
    if (separator != ' ')
        return end + 1;
    while (end < length && is_blank(line[end]))
        end++;
    return end;
}

static tn_status read_line(tn_data *t, const char *line, size_t length, size_t number, char separator, bool names,
                           tn_error *error)
{
    size_t column = 0, begin = 0;
    if (names)
        begin += length > 0 && line[0] == '#';
    if (separator == ' ') {
        begin = begin_of_next(line, begin, length, separator);
        while (length > begin && is_blank(line[length - 1]))
            length--;
    }
    for (;; column++) {
        size_t end = end_of_field(line, begin, length, separator);
        if (!names && column >= t->width)
            return bad_field(error, number, begin, end, "the line has more fields than the first");
        tn_status status = read_field(t, line, begin, end, column, number, error);
        if (status != TN_OK)
            return status;
        if (end == length)
            break;
        begin = begin_of_next(line, end, length, separator);
    }
    if (column + 1 < t->width)
        return bad_field(error, number, length, length, "the line has fewer fields than the first");
    t->points += !names;
    return TN_OK;
}

tn_status tn_data_read(const char *text, size_t size, tn_data *t, tn_error *error)
{
    tn_status status = TN_OK;
    size_t number = 0;
    char separator = ' ';
    bool names = true;
    *t = (tn_data){0};
    for (size_t at = 0; status == TN_OK && at < size; at++) {
        const char *end = memchr(text + at, '\n', size - at);
        size_t length = end ? (size_t)(end - text) - at : size - at;
        number++;
        if (names)
            separator = memchr(text + at, ',', length) ? ',' : memchr(text + at, ';', length) ? ';' : ' ';
        if (length && !(length == 1 && text[at] == '\r')) {
            status = read_line(t, text + at, length, number, separator, names, error);
            names = false;
        }
        at += length;
    }
    if (status == TN_OK && (t->width < 2 || t->points == 0))
        status =
            tn_fail(error, TN_INVALID, E_DATA, "data to fit have two columns or more, and a line of numbers or more");
    return status;
}

static int compare_numbers(const void *left, const void *right)
{
    const double *a = left, *b = right;
    return *a < *b ? -1 : *a > *b;
}

tn_status tn_data_distinct(const tn_data *t, size_t first, size_t last, size_t *count, tn_error *error)
{
    size_t all = 0;
    double *sorted = malloc(((last - first) * t->points + 1) * sizeof *sorted);
    *count = 0;
    if (!sorted)
        return tn_fail_memory(error);
    for (size_t column = first; column < last; column++)
        for (size_t i = 0; i < t->points; i++)
            sorted[all++] = t->columns[column][i];
    qsort(sorted, all, sizeof *sorted, compare_numbers);
    for (size_t i = 0; i < all; i++)
        *count += i == 0 || sorted[i] != sorted[i - 1];
    free(sorted);
    return TN_OK;
}
