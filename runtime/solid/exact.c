/* Reads decimals, and turns doubles into whole numbers and back. */
#include "runtime/solid/exact.h"

#include <string.h>

#include "runtime/base/buffer.h"

#define FRACTION_BITS 64 /* of a unit */
#define DOUBLE_BITS 53
/* Below 2^(53 - 140) a coordinate is 0 units, which are at least 10^-15. */
#define SMALLEST 140
/* Powers of ten that a double holds exactly are those up to 22; whole numbers those below 2^53. */
#define EXACT_POWER_MAX 22
#define EXACT_WHOLE_MAX 0x1p53

tn_int128 tn_power_of_ten(int exponent)
{
    tn_int128 power = 1;
    while (exponent-- > 0)
        power *= 10;
    return power;
}

/* ---- decimals */

bool tn_exact_read(const char *text, size_t size, tn_exact *number)
{
    size_t i = 0;
    int digits = 0, exponent = 0;
    bool point = false, below = false;
    *number = (tn_exact){0};
    for (; i < size && (text[i] == '.' || (text[i] >= '0' && text[i] <= '9')); i++) {
        if (text[i] == '.') {
            point = true;
            continue;
        }
        number->digits = 10 * number->digits + (text[i] - '0');
        digits += number->digits != 0;
        number->places += point;
        if (digits > TN_DECIMAL_DIGITS_MAX)
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

/* Numbers of few places, which most are, without a text: both sides of the division are exact, so that its result is
 * the double that the decimal is rounded to. */
static bool has_few_places(double size, tn_exact *number)
{
    double power = 1;
    for (int places = 0; places <= EXACT_POWER_MAX; places++, power *= 10) {
        double whole = nearbyint(size * power);
        if (!(whole < EXACT_WHOLE_MAX))
            return false;
        if (whole / power == size) {
            *number = (tn_exact){(tn_int128)whole, places};
            return true;
        }
    }
    return false;
}

tn_exact tn_exact_of(double value)
{
    char text[TN_NUMBER_TEXT_SIZE];
    tn_exact number;
    if (!has_few_places(fabs(value), &number)) {
        tn_number_text(fabs(value), text);
        tn_exact_read(text, strlen(text), &number); /* 17 digits at most */
    }
    if (value < 0)
        number.digits = -number.digits;
    return number;
}

/* ---- whole numbers */

static tn_wide scaled(tn_int128 units)
{
    tn_wide size = tn_wide_shifted(tn_wide_of(units < 0 ? -units : units), FRACTION_BITS);
    return units < 0 ? tn_wide_negate(size) : size;
}

static tn_wide decimal_units(double value)
{
    tn_exact number = tn_exact_of(value);
    for (; number.places > TN_DECIMAL_DIGITS_MAX; number.places--)
        number.digits /= 10;
    return tn_wide_multiply(scaled(number.digits), tn_wide_of(tn_power_of_ten(TN_DECIMAL_DIGITS_MAX - number.places)));
}

/* A face on a grid is the double nearest to a whole number of its units; that number is what is looked for. */
static tn_wide grid_units(const tn_face_unit *unit, double value)
{
    int exponent;
    double fraction = frexp(fabs(value), &exponent);
    exponent -= DOUBLE_BITS; /* the value is a whole number of 53 bits times this power of two, which is below 1 */
    if (fraction == 0 || exponent < -SMALLEST)
        return tn_wide_of(0);
    tn_wide twice = tn_wide_product(2 * (tn_int128)ldexp(fraction, DOUBLE_BITS), unit->bottom);
    tn_wide step = tn_wide_shifted(tn_wide_of(unit->top), (unsigned)-exponent);
    bool exact;
    tn_int128 units = tn_wide_quotient(tn_wide_add(twice, step), tn_wide_shifted(step, 1), &exact);
    return scaled(value < 0 ? -units : units);
}

tn_wide tn_face_units(const tn_face_unit *unit, double value)
{
    return unit->top > 0 && unit->bottom > 0 ? grid_units(unit, value) : decimal_units(value);
}

double tn_face_value(const tn_face_unit *unit, tn_wide coordinate)
{
    bool grid = unit->top > 0 && unit->bottom > 0;
    tn_wide top = tn_wide_of(grid ? unit->top : 1);
    tn_wide bottom = tn_wide_of(grid ? unit->bottom : tn_power_of_ten(TN_DECIMAL_DIGITS_MAX));
    return ldexp(tn_wide_ratio(tn_wide_multiply(coordinate, top), bottom), -FRACTION_BITS);
}
