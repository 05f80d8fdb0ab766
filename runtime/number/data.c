/* Reads columns of numbers from a text. */
#include "runtime/number/data.h"

#include <math.h>
#include <stdio.h>
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

static void trim(const char *line, size_t *begin, size_t *end)
{
    while (*begin < *end && is_blank(line[*begin]))
        ++*begin;
    while (*end > *begin && is_blank(line[*end - 1]))
        --*end;
}

static bool read_number(const char *line, size_t begin, size_t end, double *value)
{
    char digits[64], *stop;
    if (end - begin >= sizeof digits)
        return false;
    memcpy(digits, line + begin, end - begin);
    digits[end - begin] = '\0';
    *value = strtod(digits, &stop);
    return stop != digits && !*stop && isfinite(*value);
}

static tn_status name_column(tn_data *t, const char *name, size_t size, tn_error *error)
{
    t->names[t->width] = strndup(name, size);
    return t->names[t->width++] ? TN_OK : tn_fail_memory(error);
}

static tn_status not_a_number(const tn_data *t, const char *line, size_t begin, size_t end, size_t column,
                              size_t number, tn_error *error)
{
    char what[160];
    if (begin == end)
        snprintf(what, sizeof what, "the column `%.60s` has no number here", t->names[column]);
    else
        snprintf(what, sizeof what, "`%.*s` in the column `%.60s` is not a number",
                 (int)(end - begin < 40 ? end - begin : 40), line + begin, t->names[column]);
    bad_field(error, number, begin, end, what);
    if (memchr(line + begin, ',', end - begin))
        tn_error_help(error, "numbers have a point, as 1.5");
    return TN_INVALID;
}

static tn_status read_field(tn_data *t, const char *line, size_t begin, size_t end, size_t column, size_t number,
                            bool names, tn_error *error)
{
    double value;
    trim(line, &begin, &end);
    if (names && (column == TN_DATA_COLUMNS_MAX || begin == end))
        return bad_field(error, number, begin, end, "the first line names the columns, at most 1000 of them");
    if (names)
        return name_column(t, line + begin, end - begin, error);
    if (!read_number(line, begin, end, &value))
        return not_a_number(t, line, begin, end, column, number, error);
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
        tn_status status = read_field(t, line, begin, end, column, number, names, error);
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

static char separator_of(const char *line, size_t length)
{
    return memchr(line, ',', length) ? ',' : memchr(line, ';', length) ? ';' : ' ';
}

/* How many fields a line of numbers has; 0 if something else is in it. */
static size_t count_numbers(const char *line, size_t length, char separator)
{
    size_t count = 0, begin = separator == ' ' ? begin_of_next(line, 0, length, separator) : 0;
    while (separator == ' ' && length > begin && is_blank(line[length - 1]))
        length--;
    for (size_t end;; begin = begin_of_next(line, end, length, separator)) {
        double value;
        end = end_of_field(line, begin, length, separator);
        size_t from = begin, to = end;
        trim(line, &from, &to);
        if (!read_number(line, from, to, &value))
            return 0;
        count++;
        if (end == length)
            return count;
    }
}

static tn_status call_columns(tn_data *t, size_t count, tn_error *error)
{
    tn_status status = TN_OK;
    t->unnamed = true;
    for (size_t i = 0; i < count && status == TN_OK; i++) {
        char name[24];
        int size = i + 1 < count ? snprintf(name, sizeof name, "x%zu", i) : snprintf(name, sizeof name, "y");
        status = name_column(t, name, (size_t)size, error);
    }
    return status;
}

/* The first line that is not empty: names, or the first numbers, which are read as any then. */
static tn_status begin_table(tn_data *t, const char *line, size_t length, size_t number, bool *names, tn_error *error)
{
    char separator = separator_of(line, length);
    size_t numbers = line[0] == '#' ? 0 : count_numbers(line, length, separator);
    *names = numbers == 0;
    if (numbers > TN_DATA_COLUMNS_MAX)
        return bad_field(error, number, 0, length, "there are more than 1000 columns");
    return numbers ? call_columns(t, numbers, error) : read_line(t, line, length, number, separator, true, error);
}

tn_status tn_data_read(const char *text, size_t size, tn_data *t, tn_error *error)
{
    tn_status status = TN_OK;
    size_t number = 0;
    char separator = 0, of_names = ' '; /* separator: of the numbers, once there are some */
    *t = (tn_data){0};
    for (size_t at = 0; status == TN_OK && at < size; at++) {
        const char *line = text + at, *end = memchr(line, '\n', size - at);
        size_t length = end ? (size_t)(end - line) : size - at;
        bool names = false;
        number++;
        at += length;
        if (length == 0 || (length == 1 && line[0] == '\r'))
            continue;
        if (t->width == 0) {
            of_names = separator_of(line, length);
            status = begin_table(t, line, length, number, &names, error);
        }
        if (!separator && !names)
            separator = of_names != ' ' && memchr(line, of_names, length) ? of_names : separator_of(line, length);
        if (status == TN_OK && !names)
            status = read_line(t, line, length, number, separator, false, error);
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
    double *sorted = tn_array_new(tn_size_of(last - first, t->points) + 1, sizeof *sorted);
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
