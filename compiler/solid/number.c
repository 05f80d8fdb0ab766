/* Works out numbers of designs exactly, in tenths and their tenths, and rounds each result once: what is written to
 * touch does touch. */
#include <string.h>

#include "compiler/common/lexical.h"
#include "compiler/solid/solid.h"

/* Shifts the one with fewer places so that both have as many. False where that passes what is held. */
static bool align(tn_exact *number, int places)
{
    while (number->places < places) {
        if (number->digits > tn_power_of_ten(TN_DECIMAL_DIGITS_MAX) ||
            number->digits < -tn_power_of_ten(TN_DECIMAL_DIGITS_MAX))
            return false;
        number->digits *= 10;
        number->places++;
    }
    return true;
}

static bool rounded(tn_exact number, double *value)
{
    if (!align(&number, 0) || number.places > TN_DECIMAL_DIGITS_MAX)
        return false;
    *value = tn_ratio(number.digits, tn_power_of_ten(number.places));
    return *value <= TN_SOLID_COORDINATE_MAX && *value >= -TN_SOLID_COORDINATE_MAX;
}

static void wrong(tn_solid_check *check, tn_span span, const char *help)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_SOLID_NUMBER, span, "this number cannot be held exactly");
    tn_help(check->diagnostics, d, "%s", help);
    check->solid->wrong = true;
}

static bool read_length(tn_solid_check *check, const tn_solid_number *number, tn_exact *value)
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
    *value = (tn_exact){number->nanometres, places[check->solid->model]};
    return true;
}

static bool read(tn_solid_check *check, const tn_solid_number *number, tn_exact *value)
{
    const tn_source *source = &check->diagnostics->sources->files[number->digits.file];
    if (number->is_length) {
        if (!read_length(check, number, value))
            return false;
    } else if (!tn_exact_read(source->text + number->digits.begin, number->digits.end - number->digits.begin, value)) {
        wrong(check, number->span, "write at most 36 digits");
        return false;
    }
    if (number->negative)
        value->digits = -value->digits;
    return true;
}

/* The nearest whole number of units; of two the one above. The number has places, not powers of ten. */
static double on_grid(tn_exact number, const tn_face_unit *unit)
{
    bool negative = number.digits < 0, exact;
    tn_wide steps = tn_wide_product(negative ? -number.digits : number.digits, 2 * (tn_int128)unit->bottom);
    tn_wide step = tn_wide_product(tn_power_of_ten(number.places), unit->top);
    /* the whole part of number / unit + 1/2, of which steps / (2 step) is the first; below 0, halves go up as well */
    tn_int128 units = tn_wide_quotient(tn_wide_add(steps, step), tn_wide_shifted(step, 1), &exact);
    if (negative)
        units = exact ? 1 - units : -units;
    return tn_ratio(units * unit->top, unit->bottom);
}

static bool place(const tn_checked_solid *solid, tn_exact number, tn_solid_place *face)
{
    if (!rounded(number, &face->written))
        return false;
    face->at = face->written;
    if (solid->unit.top && align(&number, 0))
        face->at = on_grid(number, &solid->unit);
    return face->at <= TN_SOLID_COORDINATE_MAX && face->at >= -TN_SOLID_COORDINATE_MAX;
}

static const char too_far[] = "numbers reach up to 1,000,000,000, and have at most 36 digits behind the point";

void tn_solid_corner(tn_solid_check *check, const tn_solid_number *number, tn_solid_place *face)
{
    tn_exact value;
    *face = (tn_solid_place){0};
    if (read(check, number, &value) && !place(check->solid, value, face))
        wrong(check, number->span, too_far);
}

double tn_solid_value(tn_solid_check *check, const tn_solid_number *number)
{
    tn_exact value;
    double result;
    if (!read(check, number, &value))
        return 0;
    if (rounded(value, &result))
        return result;
    wrong(check, number->span, too_far);
    return 0;
}

/* Whole numbers that divide each other as two numbers do. False where one has more than 15 digits. */
static bool divide(tn_exact a, tn_exact b, tn_face_unit *unit)
{
    int places = a.places > b.places ? a.places : b.places;
    if (!align(&a, places) || !align(&b, places) || a.digits <= 0 || b.digits <= 0)
        return false;
    tn_int128 divisor = a.digits, rest = b.digits;
    while (rest) {
        tn_int128 next = divisor % rest;
        divisor = rest;
        rest = next;
    }
    a.digits /= divisor;
    b.digits /= divisor;
    if (a.digits > TN_SOLID_UNIT_MAX || b.digits > TN_SOLID_UNIT_MAX)
        return false;
    *unit = (tn_face_unit){(int64_t)a.digits, (int64_t)b.digits};
    return true;
}

void tn_solid_take_unit(tn_solid_check *check, const tn_solid_item *item)
{
    tn_exact a, b;
    if (!read(check, &item->number[0], &a) || !read(check, &item->number[1], &b))
        return;
    if (a.digits > 0 && b.digits > 0 && divide(a, b, &check->solid->unit))
        return;
    bool above = a.digits > 0 && b.digits > 0;
    tn_diagnostic *d = tn_report(check->diagnostics, E_SOLID_NUMBER, item->span, "%s",
                                 above ? "this unit has too many digits" : "a unit is above 0");
    tn_help(check->diagnostics, d,
            above ? "write it as a fraction of whole numbers of at most 15 digits: `unit 1/1024;`"
                  : "write `unit 1/1024;`");
    check->solid->wrong = true;
}

bool tn_solid_face(tn_solid_check *check, const tn_solid_number *a, const tn_solid_number *b, int weight,
                   tn_solid_place *face)
{
    tn_exact at = {0}, size = {0};
    *face = (tn_solid_place){0};
    if ((a && !read(check, a, &at)) || (b && !read(check, b, &size)))
        return false;
    int places = at.places > size.places ? at.places : size.places;
    if (!align(&at, places) || !align(&size, places) || !align(&at, places + 1) ||
        size.digits > tn_power_of_ten(TN_DECIMAL_DIGITS_MAX) || size.digits < -tn_power_of_ten(TN_DECIMAL_DIGITS_MAX) ||
        !place(check->solid, (tn_exact){at.digits + 5 * weight * size.digits, places + 1}, face)) {
        wrong(check, a ? a->span : b->span, "place and size together have too many digits");
        return false;
    }
    return true;
}
