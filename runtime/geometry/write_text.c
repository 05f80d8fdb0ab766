/* Writes numbers as text, quickly and the same everywhere. */
#include "runtime/geometry/write_text.h"

#include <math.h>
#include <string.h>

#include "runtime/base/buffer.h"
#include "runtime/base/int128.h"

static const char pairs[] =
    "0001020304050607080910111213141516171819202122232425262728293031323334353637383940414243444546474849"
    "5051525354555657585960616263646566676869707172737475767778798081828384858687888990919293949596979899";

void tn_text_begin(tn_text_out *out, FILE *stream, double largest)
{
    out->stream = stream;
    out->failed = false;
    out->used = 0;
    out->decimals = 12;
    out->scale = 1e12;
    while (out->decimals > 0 && !(largest * out->scale < 1e12)) {
        out->decimals--;
        out->scale /= 10;
    }
    out->scale = rint(out->scale);
}

void tn_text_flush(tn_text_out *out, bool all)
{
    if (!all && out->used + TN_TEXT_ROOM < sizeof out->bytes)
        return;
    out->failed |= fwrite(out->bytes, 1, out->used, out->stream) != out->used; /* the caller looks at the stream */
    out->used = 0;
}

void tn_text_add(tn_text_out *out, const char *text)
{
    size_t size = strlen(text);
    for (size_t room; size > (room = sizeof out->bytes - out->used); text += room, size -= room) {
        memcpy(out->bytes + out->used, text, room);
        out->used += room;
        tn_text_flush(out, true);
    }
    memcpy(out->bytes + out->used, text, size);
    out->used += size;
}

void tn_text_word(tn_text_out *out, const char *text)
{
    for (const char *c = text; *c; c++) {
        if (out->used == sizeof out->bytes)
            tn_text_flush(out, true);
        out->bytes[out->used++] = (char)((unsigned char)*c <= ' ' ? '_' : *c);
    }
}

/* The digits of a number, the last at end[-1]; where they begin. */
static char *digits_before(char *end, uint64_t number)
{
    while (number >= 100) {
        end -= 2;
        memcpy(end, pairs + 2 * (number % 100), 2);
        number /= 100;
    }
    if (number >= 10) {
        end -= 2;
        memcpy(end, pairs + 2 * number, 2);
    } else {
        *--end = (char)('0' + number);
    }
    return end;
}

void tn_text_whole(tn_text_out *out, uint64_t number)
{
    char buffer[24], *end = buffer + sizeof buffer, *begin = digits_before(end, number);
    memcpy(out->bytes + out->used, begin, (size_t)(end - begin));
    out->used += (size_t)(end - begin);
}

static void add_digits(tn_text_out *out, bool negative, uint64_t digits, int decimals)
{
    char buffer[48], *end = buffer + sizeof buffer;
    for (; decimals > 0 && digits % 10 == 0; decimals--)
        digits /= 10;
    char *begin = digits_before(end, digits);
    while (end - begin <= decimals)
        *--begin = '0';
    size_t integer = (size_t)(end - begin) - (size_t)decimals;
    char *to = out->bytes + out->used;
    if (negative)
        *to++ = '-';
    memcpy(to, begin, integer);
    to += integer;
    if (decimals > 0) {
        *to++ = '.';
        memcpy(to, begin + integer, (size_t)decimals);
        to += decimals;
    }
    out->used = (size_t)(to - out->bytes);
}

void tn_text_decimal(tn_text_out *out, double number)
{
    double scaled = fabs(number) * out->scale + 0.5;
    if (!(scaled < 9e15)) { /* larger than was announced, or no number */
        out->used += (size_t)snprintf(out->bytes + out->used, 40, "%.17g", number);
        return;
    }
    uint64_t whole = (uint64_t)scaled;
    add_digits(out, number < 0 && whole > 0, whole, whole ? out->decimals : 0);
}

/* ---- the fewest digits */

static const uint64_t small_powers[20] = {UINT64_C(1),
                                          UINT64_C(10),
                                          UINT64_C(100),
                                          UINT64_C(1000),
                                          UINT64_C(10000),
                                          UINT64_C(100000),
                                          UINT64_C(1000000),
                                          UINT64_C(10000000),
                                          UINT64_C(100000000),
                                          UINT64_C(1000000000),
                                          UINT64_C(10000000000),
                                          UINT64_C(100000000000),
                                          UINT64_C(1000000000000),
                                          UINT64_C(10000000000000),
                                          UINT64_C(100000000000000),
                                          UINT64_C(1000000000000000),
                                          UINT64_C(10000000000000000),
                                          UINT64_C(100000000000000000),
                                          UINT64_C(1000000000000000000),
                                          UINT64_C(10000000000000000000)};

/* 10 to the power 0 to 22: with 53 bits of a mantissa that fits into 127. */
static tn_uint128 power_of_ten(int exponent)
{
    return exponent < 20 ? small_powers[exponent] : (tn_uint128)small_powers[exponent - 19] * small_powers[19];
}

/* The whole number nearest to mantissa / 2^shift * 10^decimals, if it, over 10^decimals, reads back as the number that
 * this is of: it is nearer than half a step of the mantissa (a quarter is always near enough, also below a power of 2).
 */
static bool digits_suffice(uint64_t mantissa, int shift, int decimals, uint64_t *digits)
{
    tn_uint128 power = power_of_ten(decimals), exact = mantissa * power, half = (tn_uint128)1 << (shift - 1);
    tn_uint128 whole = (exact + half) >> shift, back = whole << shift;
    tn_uint128 off = back > exact ? back - exact : exact - back;
    bool lowest = mantissa == UINT64_C(1) << 52;
    *digits = (uint64_t)whole;
    return (lowest ? 4 : 2) * off < power;
}

/* Digits and decimals of a number from 1e-5 to below 2^52; false for others. */
static bool few_digits(double number, uint64_t *digits, int *decimals)
{
    int exponent;
    if (!(number >= 1e-5 && number < 4503599627370496.0))
        return false;
    uint64_t mantissa = (uint64_t)ldexp(frexp(number, &exponent), 53);
    int integer = number < 1 ? -4 : 1; /* digits before the point; below 0: zeros behind it */
    for (double bound = number < 1 ? 1e-4 : 10; number >= bound && integer < 16; bound *= 10)
        integer++;
    for (int count = integer > 15 ? integer : 15; count <= 17; count++) {
        *decimals = count - integer;
        if (digits_suffice(mantissa, 53 - exponent, *decimals, digits))
            return true;
    }
    return false;
}

void tn_text_number(tn_text_out *out, double number)
{
    char text[TN_NUMBER_TEXT_SIZE];
    uint64_t digits;
    int decimals;
    if (number == 0)
        tn_text_add(out, "0");
    else if (few_digits(fabs(number), &digits, &decimals))
        add_digits(out, number < 0, digits, decimals);
    else
        tn_text_add(out, tn_number_text(number, text));
}
