/* Writes whole numbers of any size. */
#include "runtime/base/integers.h"

#include <string.h>

bool tn_buffer_integer(tn_buffer *buffer, const mpz_t number)
{
    if (!tn_buffer_reserve(buffer, mpz_sizeinbase(number, 10) + 1)) /* and the sign */
        return false;
    mpz_get_str(buffer->data + buffer->size, 10, number);
    buffer->size += strlen(buffer->data + buffer->size);
    return true;
}
