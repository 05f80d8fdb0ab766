/* Reads and writes numbers of any size as text. */
#include "driver/open/digits.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/integers.h"

char *tn_digits(const mpz_t number, bool grouped)
{
    char *plain = mpz_get_str(NULL, 10, number);
    if (!plain || !grouped)
        return plain;
    size_t length = strlen(plain), used = 0;
    char *text = malloc(length + length / 3 + 1);
    for (size_t i = 0; text && i < length; i++) {
        if (i > 0 && (length - i) % 3 == 0 && plain[i - 1] != '-')
            text[used++] = ',';
        text[used++] = plain[i];
    }
    if (text)
        text[used] = '\0';
    free(plain);
    return text;
}

int tn_digits_width(const mpz_t largest, const char *heading)
{
    size_t digits = tn_decimal_digits(largest), wide = digits + (digits - 1) / 3, least = strlen(heading);
    return (int)(wide > least ? wide : least);
}
