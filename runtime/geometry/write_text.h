/* A buffer of text on its way to a file, and numbers written into it quickly and the same everywhere. */
#ifndef TARTAN_GEOMETRY_WRITE_TEXT_H
#define TARTAN_GEOMETRY_WRITE_TEXT_H

#include <stdbool.h>
#include <stdio.h>

#include "runtime/base/error.h"

#define TN_TEXT_ROOM 512 /* a line's worth: what may be added between two calls of tn_text_flush */

typedef struct tn_text_out {
    FILE *stream;
    bool failed; /* the stream takes no more: what is left need not be written */
    size_t used;
    double scale; /* 10 to the power of the decimals */
    int decimals;
    char bytes[1 << 16];
} tn_text_out;

/* Decimals so that numbers up to `largest` have twelve digits. */
void tn_text_begin(tn_text_out *out, FILE *stream, double largest);

void tn_text_add(tn_text_out *out, const char *text);

/* With `_` for blanks, of which a word of such files has none. */
void tn_text_word(tn_text_out *out, const char *text);
void tn_text_whole(tn_text_out *out, uint64_t number);
void tn_text_decimal(tn_text_out *out, double number);

/* With the fewest digits that read back as the same finite number; both zeros are "0". */
void tn_text_number(tn_text_out *out, double number);

/* Writes where little room is left, or (all) everything. */
void tn_text_flush(tn_text_out *out, bool all);

#endif
