/* Lengths with units, held exactly as integer nanometres (1/64 inch is 396,875 nm). */
#ifndef TARTAN_BASE_LENGTH_H
#define TARTAN_BASE_LENGTH_H

#include "runtime/base/error.h"

#define TN_INCH_NM INT64_C(25400000)
#define TN_FOOT_NM (12 * TN_INCH_NM)
#define TN_LENGTH_MAX (INT64_C(1) << 50) /* nanometres: about 1,100 km, so that sums of a plan stay in 64 bits */

/* Reads a length at the start of text: 12'  2'6"  7'-9"  5' 6 1/2"  6-1/2"  3/4"  3.6m  900mm  45cm, with ' and " also
 * in their typographic forms. `spaced` allows blanks between feet, inches and fraction (rules do, plan lines do not).
 * Returns the number of bytes read, or 0: where text does not start with a length error->status is TN_OK; where it is
 * one that cannot be held it is TN_INVALID (E0005 too large, E0006 not whole nanometres), and error->column_end - 1 is
 * the length's bytes. */
size_t tn_length_read(const char *text, size_t size, bool spaced, int64_t *nanometres, tn_error *error);

/* Writes a length in feet and inches where it is whole 64ths of an inch (5'6-1/2", without blanks, as plan lines need
 * it), in millimetres otherwise; a buffer of 64 holds any. */
void tn_length_write(int64_t nanometres, char *text, size_t size);

/* Lengths in the unit that an author uses. */

typedef enum tn_length_style {
    TN_STYLE_FEET,
    TN_STYLE_METRES,
    TN_STYLE_CENTIMETRES,
    TN_STYLE_MILLIMETRES
} tn_length_style;

/* The unit that a length is spelt in: by its last letters. */
tn_length_style tn_length_style_of(const char *spelling);

/* Writes a length (not negative) in that unit: 18' 7'6" 5.4m 540cm 5400mm. */
void tn_length_write_style(int64_t nanometres, tn_length_style style, char *text, size_t size);

#endif
