/* Writes lengths in the unit that an author uses. */
#include "runtime/base/length_style.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

tn_length_style tn_length_style_of(const char *spelling)
{
    size_t length = strlen(spelling);
    if (length < 2 || spelling[length - 1] != 'm')
        return TN_STYLE_FEET;
    return spelling[length - 2] == 'm'   ? TN_STYLE_MILLIMETRES
           : spelling[length - 2] == 'c' ? TN_STYLE_CENTIMETRES
                                         : TN_STYLE_METRES;
}

/* A decimal number of `unit` nanometres, without trailing zeros. */
static void write_decimal(int64_t nanometres, int64_t unit, const char *name, char *text, size_t size)
{
    char fraction[24];
    int digits = snprintf(fraction, sizeof fraction, "%" PRId64, unit + nanometres % unit) - 1;
    while (digits > 0 && fraction[digits] == '0')
        digits--;
    snprintf(text, size, "%" PRId64 "%s%.*s%s", nanometres / unit, digits ? "." : "", digits, fraction + 1, name);
}

void tn_length_write_style(int64_t nanometres, tn_length_style style, char *text, size_t size)
{
    switch (style) {
    case TN_STYLE_FEET:
        tn_length_write(nanometres, text, size);
        break;
    case TN_STYLE_METRES:
        write_decimal(nanometres, INT64_C(1000000000), "m", text, size);
        break;
    case TN_STYLE_CENTIMETRES:
        write_decimal(nanometres, 10000000, "cm", text, size);
        break;
    case TN_STYLE_MILLIMETRES:
        write_decimal(nanometres, 1000000, "mm", text, size);
        break;
    }
}
