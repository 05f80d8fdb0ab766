/* Values of measures as text. */
#include "runtime/plan/measure/amount.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/integers.h"
#include "runtime/base/length.h"
#include "runtime/number/rational.h"

enum { DIGITS = 12 }; /* significant, of a decimal */

tn_amount_unit tn_amount_unit_of(const tn_schema *schema, int power)
{
    uint32_t field = tn_schema_length_field(schema);
    bool feet = false;
    for (uint32_t f = 0; f < schema->field_count && field == UINT32_MAX; f++)
        if (schema->fields[f].kind == TN_FIELD_ZONE)
            field = f;
    for (uint32_t v = 0; field != UINT32_MAX && v < schema->fields[field].value_count; v++) {
        const tn_value_record *value = &schema->values[schema->value_start[field] + v];
        const char *text =
            tn_text(schema->module, schema->fields[field].kind == TN_FIELD_ZONE ? value->measure : value->name);
        if (!*text)
            continue;
        feet = !strchr(text, 'm');
        break;
    }
    return (tn_amount_unit){feet, power, false};
}

const char *tn_amount_unit_name(tn_amount_unit unit)
{
    enum { MOST = 3 };
    static const char *const names[2][2][2 * MOST + 1] = {
        {{"/m3", "/m2", "/m", "", "m", "m2", "m3"}, {"/ft3", "/ft2", "/ft", "", "ft", "ft2", "ft3"}},
        {{"/m\xc2\xb3", "/m\xc2\xb2", "/m", "", "m", "m\xc2\xb2", "m\xc2\xb3"},
         {"/cf", "/sf", "/ft", "", "ft", "sf", "cf"}}};
    return abs(unit.power) <= MOST ? names[unit.shown][unit.feet][MOST + unit.power] : "";
}

tn_amount_unit tn_amount_unit_shown(tn_amount_unit unit)
{
    unit.shown = true;
    return unit;
}

void tn_amount_convert(tn_amount_unit unit, mpq_t value)
{
    mpq_t length;
    mpq_init(length);
    mpq_set_si(length, unit.feet ? TN_FOOT_NM : 1000000000, 1);
    tn_rational_power(length, length, unit.power);
    mpq_div(value, value, length);
    mpq_clear(length);
}

static bool put_rational(const mpq_t value, tn_buffer *out)
{
    char *text = mpq_get_str(NULL, 10, value);
    bool ok = text && tn_buffer_append(out, text, strlen(text));
    free(text);
    return ok;
}

bool tn_amount_write_exact(tn_amount_unit unit, const mpq_t value, tn_buffer *out)
{
    mpq_t converted;
    mpq_init(converted);
    mpq_set(converted, value);
    tn_amount_convert(unit, converted);
    bool ok = put_rational(converted, out);
    mpq_clear(converted);
    return ok;
}

/* A whole number, perhaps with its thousands apart. */
static bool put_digits(const mpz_t number, bool apart, tn_buffer *out)
{
    char *text = mpz_get_str(NULL, 10, number);
    bool ok = text != NULL;
    size_t size = ok ? strlen(text) : 0;
    for (size_t i = 0; ok && i < size; i++) {
        bool sign = text[i] == '-';
        ok = tn_buffer_append(out, text + i, 1);
        if (ok && apart && !sign && size - 1 - i > 0 && (size - 1 - i) % 3 == 0)
            ok = tn_buffer_append(out, ",", 1);
    }
    free(text);
    return ok;
}

/* How many decimals the value ends within; -1 where it does not within so many. */
static int decimals_of(const mpq_t value)
{
    mpz_t rest;
    mpz_init(rest);
    int found = -1;
    for (int decimals = 0; decimals <= DIGITS && found < 0; decimals++) {
        mpz_ui_pow_ui(rest, 10, (unsigned)decimals);
        if (mpz_divisible_p(rest, mpq_denref(value)))
            found = decimals;
    }
    mpz_clear(rest);
    return found;
}

/* Writes scaled / 10^decimals. */
static bool put_decimal(const mpz_t scaled, int decimals, bool apart, tn_buffer *out)
{
    mpz_t whole, part, power;
    mpz_inits(whole, part, power, NULL);
    mpz_ui_pow_ui(power, 10, (unsigned)decimals);
    mpz_tdiv_qr(whole, part, scaled, power);
    mpz_abs(part, part);
    bool ok = mpz_sgn(scaled) >= 0 || mpz_sgn(whole) != 0 || tn_buffer_append(out, "-", 1);
    ok = ok && put_digits(whole, apart, out);
    char *digits = decimals ? mpz_get_str(NULL, 10, part) : NULL;
    if (digits) {
        ok = ok && tn_buffer_append(out, ".", 1);
        for (size_t size = strlen(digits); ok && size < (size_t)decimals; size++)
            ok = tn_buffer_append(out, "0", 1);
        ok = ok && tn_buffer_append(out, digits, strlen(digits));
    }
    free(digits);
    mpz_clears(whole, part, power, NULL);
    return ok;
}

/* A decimal if it ends soon, else a fraction; apart: thousands. */
static bool write_number(tn_amount_unit unit, const mpq_t value, bool apart, tn_buffer *out)
{
    mpq_t converted;
    mpz_t scaled;
    mpq_init(converted);
    mpz_init(scaled);
    mpq_set(converted, value);
    tn_amount_convert(unit, converted);
    int decimals = decimals_of(converted);
    bool ok = true;
    if (decimals >= 0) {
        mpz_ui_pow_ui(scaled, 10, (unsigned)decimals);
        mpz_mul(scaled, scaled, mpq_numref(converted));
        mpz_divexact(scaled, scaled, mpq_denref(converted));
    }
    if (decimals >= 0 && (decimals == 0 || tn_decimal_digits(scaled) <= DIGITS))
        ok = put_decimal(scaled, decimals, apart, out);
    else
        ok = put_rational(converted, out);
    mpq_clear(converted);
    mpz_clear(scaled);
    return ok;
}

bool tn_amount_write(tn_amount_unit unit, const mpq_t value, tn_buffer *out)
{
    const char *name = tn_amount_unit_name(unit);
    return write_number(unit, value, true, out) && (!*name || tn_buffer_printf(out, " %s", name));
}

bool tn_amount_write_word(tn_amount_unit unit, const mpq_t value, tn_buffer *out)
{
    const char *name = tn_amount_unit_name(unit);
    return write_number(unit, value, false, out) && tn_buffer_append(out, name, strlen(name));
}

bool tn_amount_write_about(tn_amount_unit unit, const mpq_t converted, tn_buffer *out)
{
    enum { SIGNIFICANT = 6 };
    mpz_t scaled, whole;
    mpz_inits(scaled, whole, NULL);
    mpz_tdiv_q(whole, mpq_numref(converted), mpq_denref(converted));
    int size = mpz_sgn(whole) ? (int)tn_decimal_digits(whole) : 0,
        decimals = size < SIGNIFICANT ? SIGNIFICANT - size : 0;
    mpz_ui_pow_ui(scaled, 10, (unsigned)decimals);
    mpz_mul(scaled, scaled, mpq_numref(converted));
    mpz_mul_2exp(scaled, scaled, 1);
    mpz_add(scaled, scaled, mpq_denref(converted)); /* halves are rounded up */
    mpz_mul_2exp(whole, mpq_denref(converted), 1);
    mpz_fdiv_q(scaled, scaled, whole);
    for (; decimals > 0 && mpz_divisible_ui_p(scaled, 10); decimals--)
        mpz_divexact_ui(scaled, scaled, 10);
    const char *name = tn_amount_unit_name(unit);
    bool ok = put_decimal(scaled, decimals, true, out) && (!*name || tn_buffer_printf(out, " %s", name));
    mpz_clears(scaled, whole, NULL);
    return ok;
}

bool tn_amount_write_root(tn_amount_unit unit, const mpq_t square, tn_buffer *out)
{
    mpq_t converted;
    mpz_t scaled;
    mpq_init(converted);
    mpz_init(scaled);
    mpq_set(converted, square);
    tn_amount_convert(unit, converted);
    tn_amount_convert(unit, converted);
    int decimals = DIGITS;
    for (;; decimals++) { /* as many as leave 12 significant digits of the root */
        mpz_ui_pow_ui(scaled, 10, (unsigned)(2 * decimals));
        mpz_mul(scaled, scaled, mpq_numref(converted));
        mpz_fdiv_q(scaled, scaled, mpq_denref(converted));
        mpz_sqrt(scaled, scaled);
        if (mpq_sgn(square) == 0 || tn_decimal_digits(scaled) > DIGITS || decimals > 200)
            break;
    }
    while (decimals > 0 && (tn_decimal_digits(scaled) > DIGITS || mpz_divisible_ui_p(scaled, 10))) {
        unsigned digit = (unsigned)mpz_fdiv_ui(scaled, 10);
        mpz_fdiv_q_ui(scaled, scaled, 10);
        if (tn_decimal_digits(scaled) == DIGITS && digit >= 5)
            mpz_add_ui(scaled, scaled, 1);
        decimals--;
    }
    bool ok = put_decimal(scaled, decimals, false, out);
    mpq_clear(converted);
    mpz_clear(scaled);
    return ok;
}
