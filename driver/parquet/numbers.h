/* A column of numbers of which few differ: their dictionary, and the numbers of a page as places in it. A column with
 * more than 65,536 different numbers in a row group has those of its later pages as they are. */
#ifndef TARTAN_DRIVER_PARQUET_NUMBERS_H
#define TARTAN_DRIVER_PARQUET_NUMBERS_H

#include "driver/parquet/page.h"
#include "runtime/base/hash_table.h"

typedef struct tn_numbers {
    unsigned bytes;   /* of a number: 4 or 8 */
    uint16_t *places; /* in the dictionary, of the page's numbers, while it has room */
    tn_buffer plain;  /* the page's numbers as they are, where it has none */
    size_t count;     /* of the page */
    int64_t *dictionary;
    size_t known, known_room;
    tn_hash_table index; /* places in the dictionary */
    bool full;           /* a number had no room there: from now on none is looked up */
    bool mixed;          /* some page of the row group has numbers as they are */
    int64_t least, most; /* of the row group */
} tn_numbers;

/* Room for pages of so many numbers. TN_MEMORY. Free it in any case. */
tn_status tn_numbers_new(tn_numbers *numbers, unsigned bytes, size_t page, tn_error *error);
void tn_numbers_free(tn_numbers *numbers);

/* False where out of memory. */
bool tn_numbers_add(tn_numbers *numbers, int64_t value);

/* Appends the page's numbers to `body`, and begins another. How they are encoded. */
enum tn_parquet_encoding tn_numbers_page(tn_numbers *numbers, tn_buffer *body);

/* Appends the dictionary. */
void tn_numbers_dictionary(const tn_numbers *numbers, tn_buffer *body);

/* Begins a row group. */
void tn_numbers_clear(tn_numbers *numbers);

/* Appends a number of 4 or 8 bytes, the lowest first. */
void tn_plain_write(tn_buffer *out, int64_t value, unsigned bytes);

#endif
