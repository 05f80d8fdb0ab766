/* Lengths with units, held exactly as integer nanometres (1/64 inch is 396,875 nm). */
#ifndef TARTAN_VM_LENGTH_H
#define TARTAN_VM_LENGTH_H

#include "runtime/vm/error.h"

#define TN_INCH_NM INT64_C(25400000)
#define TN_FOOT_NM (12 * TN_INCH_NM)
#define TN_LENGTH_MAX (INT64_C(1) << 50) /* nanometres: about 1,100 km, so that sums of a plan stay in 64 bits */

/* Reads a length at the start of text: 12'  2'6"  7'-9"  5' 6 1/2"  6 1/2"  3.6m  900mm  45cm. `spaced` allows blanks between feet,
 * inches and fraction (rules do, plan lines do not). Also the typographic signs for feet and inches. Returns the number of bytes read, or 0 where text does not
 * start with a length or (error filled) where it is one that cannot be held. */
size_t tn_length_read(const char *text, size_t size, bool spaced, int64_t *nanometres, tn_error *error);

/* Writes a length in feet and inches where it is whole 64ths of an inch, in millimetres otherwise. */
void tn_length_write(int64_t nanometres, char *text, size_t size);

#endif
