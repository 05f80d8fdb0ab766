/* Works out numbers of designs exactly, in tenths and their tenths, and rounds each result once: what is written to
 * touch does touch. */
#include <string.h>

#include "compiler/common/lexical.h"
#include "compiler/solid/solid.h"
#include "runtime/geometry/union/wide.h"

enum { DIGITS_MAX = 36, POWER_MAX = 36 };

/* digits * 10^-places */
typedef struct exact {
    tn_int128 digits;
    int places;
} exact;

static tn_int128 power_of_ten(int exponent)
{
    tn_int128 power = 1;
    while (exponent-- > 0)
        power *= 10;
    return power;
}

/* False where it has more digits than are held. */
static bool read_decimal(const char *text, size_t size, exact *number)
{
    size_t i = 0;
    int digits = 0, exponent = 0;
    bool point = false, below = false;
    *number = (exact){0};
    for (; i < size && (text[i] == '.' || (text[i] >= '0' && text[i] <= '9')); i++) {
        if (text[i] == '.') {
            point = true;
            continue;
        }
        number->digits = 10 * number->digits + (text[i] - '0');
        digits += number->digits != 0;
        number->places += point;
        if (digits > DIGITS_MAX)
            return false;
    }
    if (i < size) { /* e */
        i++;
        below = i < size && text[i] == '-';
        i += i < size && (text[i] == '-' || text[i] == '+');
    }
    for (; i < size && exponent < 10000; i++)
        exponent = 10 * exponent + (text[i] - '0');
    number->places += below ? exponent : -exponent;
    for (; number->places > 0 && number->digits % 10 == 0; number->places--)
        number->digits /= 10; /* 2.50 is 2.5, and 0e-300 is 0 */
    if (number->digits == 0)
        number->places = 0;
    return true;
}

/* Shifts the one with fewer places so that both have as many. False where that passes what is held. */
static bool align(exact *number, int places)
{
    while (number->places < places) {
        if (number->digits > power_of_ten(DIGITS_MAX) || number->digits < -power_of_ten(DIGITS_MAX))
            return false;
        number->digits *= 10;
        number->places++;
    }
    return true;
}

static bool rounded(exact number, double *value)
{
    if (!align(&number, 0) || number.places > POWER_MAX)
        return false;
    *value = tn_ratio(number.digits, power_of_ten(number.places));
    return *value <= TN_SOLID_COORDINATE_MAX && *value >= -TN_SOLID_COORDINATE_MAX;
}

static void wrong(tn_solid_check *check, tn_span span, const char *help)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_SOLID_NUMBER, span, "this number cannot be held exactly");
    tn_help(check->diagnostics, d, "%s", help);
    check->solid->wrong = true;
}

static bool read_length(tn_solid_check *check, const tn_solid_number *number, exact *value)
{
    static const int places[TN_SOLID_MODEL_COUNT] = {
        [TN_MODEL_MILLIMETRES] = 6, [TN_MODEL_CENTIMETRES] = 7, [TN_MODEL_METRES] = 9};
    if (check->solid->model == TN_MODEL_NONE) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_SOLID_LENGTH, number->span,
                                     "this is a length, and the design does not say what its unit is");
        tn_help(check->diagnostics, d, "write `model mm;` at its start, or leave out the unit here");
        check->solid->wrong = true;
        return false;
    }
    *value = (exact){number->nanometres, places[check->solid->model]};
    return true;
}

static bool read(tn_solid_check *check, const tn_solid_number *number, exact *value)
{
    const tn_source *source = &check->diagnostics->sources->files[number->digits.file];
    if (number->is_length) {
        if (!read_length(check, number, value))
            return false;
    } else if (!read_decimal(source->text + number->digits.begin, number->digits.end - number->digits.begin, value)) {
        wrong(check, number->span, "write at most 36 digits");
        return false;
    }
    if (number->negative)
        value->digits = -value->digits;
    return true;
}

double tn_solid_value(tn_solid_check *check, const tn_solid_number *number)
{
    exact value;
    double result;
    if (!read(check, number, &value))
        return 0;
    if (rounded(value, &result))
        return result;
    wrong(check, number->span, "numbers reach up to 1,000,000,000, and have at most 36 digits behind the point");
    return 0;
}

bool tn_solid_face(tn_solid_check *check, const tn_solid_number *a, const tn_solid_number *b, int weight, double *face)
{
    exact at, size;
    *face = 0;
    if (!read(check, a, &at) || !read(check, b, &size))
        return false;
    int places = at.places > size.places ? at.places : size.places;
    if (!align(&at, places) || !align(&size, places) || !align(&at, places + 1) ||
        size.digits > power_of_ten(DIGITS_MAX) || size.digits < -power_of_ten(DIGITS_MAX) ||
        !rounded((exact){at.digits + 5 * weight * size.digits, places + 1}, face)) {
        wrong(check, a->span, "place and size together have too many digits");
        return false;
    }
    return true;
}
