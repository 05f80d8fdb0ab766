/* Reads and writes numbers of any size as text. */
#include "driver/open/digits.h"

#include <stdlib.h>
#include <string.h>

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
