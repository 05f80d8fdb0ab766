/* Writes a number with as few digits as tell it from all others: 17 always do, 15 often. */
#include "runtime/base/number_text.h"

#include <stdio.h>
#include <stdlib.h>

const char *tn_number_text(double number, char text[TN_NUMBER_TEXT_SIZE])
{
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, TN_NUMBER_TEXT_SIZE, "%.*g", digits, number);
        if (strtod(text, NULL) == number)
            break;
    }
    return text;
}
