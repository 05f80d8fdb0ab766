/* Writes numbers as text, quickly and the same everywhere. */
#include "runtime/geometry/write_text.h"

#include <math.h>
#include <string.h>

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
    size_t size = strlen(text), room = sizeof out->bytes - out->used;
    size = size < room ? size : room;
    memcpy(out->bytes + out->used, text, size);
    out->used += size;
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

void tn_text_decimal(tn_text_out *out, double number)
{
    double scaled = fabs(number) * out->scale + 0.5;
    if (!(scaled < 9e15)) { /* larger than was announced, or no number */
        out->used += (size_t)snprintf(out->bytes + out->used, 40, "%.17g", number);
        return;
    }
    uint64_t whole = (uint64_t)scaled;
    char buffer[40], *end = buffer + sizeof buffer;
    int decimals = out->decimals;
    while (decimals > 0 && whole > 0 && whole % 10 == 0) {
        whole /= 10;
        decimals--;
    }
    if (whole == 0)
        decimals = 0;
    char *begin = digits_before(end, whole);
    while (end - begin <= decimals)
        *--begin = '0';
    size_t integer = (size_t)(end - begin) - (size_t)decimals;
    char *to = out->bytes + out->used;
    if (number < 0 && whole > 0)
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
