/* Data: columns of numbers with names, read from a text. */
#ifndef TARTAN_NUMBER_DATA_H
#define TARTAN_NUMBER_DATA_H

#include <stdbool.h>
#include <stddef.h>

#include "runtime/base/error.h"

#define TN_DATA_COLUMNS_MAX 1000u

/* Clear it in any case. */
typedef struct tn_data {
    char *names[TN_DATA_COLUMNS_MAX];     /* owned */
    double *columns[TN_DATA_COLUMNS_MAX]; /* owned: [column][point] */
    size_t width, points, capacity;
    bool unnamed; /* there was no line of names: the columns are called x0, x1 and so on, the last one y */
} tn_data;

/* Reads a first line of names, then lines of numbers. Fields are separated by commas; where a line has none, by
 * semicolons or else by blanks; the lines of numbers as the first of them, or as the names where that has what
 * separates those. A `#` before the names is left out. A first line of numbers without it is no line of names. E1243
 * with the place. */
tn_status tn_data_read(const char *text, size_t size, tn_data *table, tn_error *error);
void tn_data_clear(tn_data *table);

/* How many different numbers there are in the columns from `first` on and before `last`, in *count. TN_MEMORY, or
 * TN_OK. */
tn_status tn_data_distinct(const tn_data *table, size_t first, size_t last, size_t *count, tn_error *error);

#endif
