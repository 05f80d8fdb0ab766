/* Lengths in the unit that an author uses. */
#ifndef TARTAN_BASE_LENGTH_STYLE_H
#define TARTAN_BASE_LENGTH_STYLE_H

#include "runtime/base/length.h"

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
