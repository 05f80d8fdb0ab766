/* Constants of sums and their dimensions, and arithmetic over one tray. */
#include <string.h>

#include "compiler/plan/check/amount.h"
#include "runtime/base/length.h"
#include "runtime/base/nearest.h"
#include "runtime/number/rational.h"

enum { POWER_MAX = 6 }; /* of a part of a sum, either sign */

static const char *keep(tn_check *check, const mpq_t number)
{
    if (!tn_rational_fits(number))
        return NULL;
    size_t size = mpz_sizeinbase(mpq_numref(number), 10) + mpz_sizeinbase(mpq_denref(number), 10) + 3;
    char *text = tn_arena_alloc(check->arena, size);
    return text ? mpq_get_str(text, 10, number) : NULL;
}

static void report_digits(tn_check *check, tn_span span)
{
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_TOO_FINE, span, "this number has more digits than sums are made with");
    tn_help(check->diagnostics, d, "use rounder numbers");
}

/* ---- reading */

static const struct {
    const char *text;
    int power;
    bool metric;
} units[] = {
    {"m2", 2, true},   {"m\xc2\xb2", 2, true},   {"m3", 3, true},  {"m\xc2\xb3", 3, true},
    {"ft2", 2, false}, {"ft\xc2\xb2", 2, false}, {"sf", 2, false}, {"sqft", 2, false},
    {"ft3", 3, false}, {"ft\xc2\xb3", 3, false}, {"cf", 3, false},
};

/* number *= what a square or cube of metres or feet is in nanometres; its power, or 0. */
static int read_unit(const char *unit, mpq_t number)
{
    for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
        if (strcmp(units[i].text, unit) != 0)
            continue;
        mpq_t length;
        mpq_init(length);
        mpq_set_si(length, units[i].metric ? 1000000000 : TN_FOOT_NM, 1);
        tn_rational_power(length, length, units[i].power);
        mpq_mul(number, number, length);
        mpq_clear(length);
        return units[i].power;
    }
    return 0;
}

/* Of a value in a plan: "1/3". */
static bool read_fraction(const char *text, size_t size, mpq_t number)
{
    char digits[64];
    snprintf(digits, sizeof digits, "%.*s", (int)size, text);
    bool good = size < sizeof digits && mpq_set_str(number, digits, 10) == 0 && mpz_sgn(mpq_denref(number)) != 0;
    if (good)
        mpq_canonicalize(number);
    else
        mpq_set_ui(number, 0, 1);
    return good;
}

tn_sum_amount tn_amount_read(tn_check *check, const tn_ast_word *word)
{
    tn_sum_amount amount = {0};
    if (word->broken)
        return amount;
    if (word->exact)
        return (tn_sum_amount){.value = word->exact, .power = word->power};
    mpq_t number;
    mpq_init(number);
    size_t digits = strspn(word->text, "0123456789."), over = word->text[digits] == '/';
    over = over ? 1 + strspn(word->text + digits + 1, "0123456789") : 0;
    bool good = true;
    if (word->kind == TN_WORD_NUMBER || word->kind == TN_WORD_LENGTH) {
        mpq_set_si(number, word->value, 1);
        amount.power = word->kind == TN_WORD_LENGTH;
        amount.any = word->kind == TN_WORD_NUMBER && word->value == 0;
    } else {
        good = over ? read_fraction(word->text, digits + over, number) : tn_decimal_read(word->text, digits, number);
        digits += over;
        amount.power = read_unit(word->text + digits, number);
        if (word->text[digits] == '%')
            mpz_mul_ui(mpq_denref(number), mpq_denref(number), 100);
        mpq_canonicalize(number);
    }
    amount.value = good ? keep(check, number) : NULL;
    mpq_clear(number);
    if (!amount.value)
        report_digits(check, word->node.span);
    return amount;
}

static bool refuse_cell(tn_check *check, tn_span span, tn_code code, const char *message)
{
    tn_diagnostic *d = tn_report(check->diagnostics, code, span, "%s", message);
    tn_help(check->diagnostics, d, "areas are whole square micrometres, up to 4 square kilometres");
    return false;
}

bool tn_amount_read_cell(tn_check *check, const tn_ast_word *word, int64_t *square_micrometres)
{
    const int64_t largest = INT64_C(1) << 62;
    tn_sum_amount amount = tn_amount_read(check, word);
    if (!amount.value)
        return false;
    if (amount.power != 2) {
        tn_report(check->diagnostics, E_BAD_CELL, word->node.span, "`%s` is no area", word->text);
        return false;
    }
    mpq_t area;
    mpq_init(area);
    mpq_set_str(area, amount.value, 10);
    mpz_mul_ui(mpq_denref(area), mpq_denref(area), 1000000);
    mpq_canonicalize(area);
    bool exact = mpz_cmp_ui(mpq_denref(area), 1) == 0, small = mpq_cmp_si(area, largest, 1) <= 0;
    *square_micrometres = exact && small ? mpz_get_si(mpq_numref(area)) : 0;
    mpq_clear(area);
    if (!small)
        return refuse_cell(check, word->node.span, E_NUMBER_TOO_LARGE, "this area is too large");
    return exact || refuse_cell(check, word->node.span, E_LENGTH_NOT_EXACT, "this area has too many decimals");
}

/* ---- arithmetic */

static void apply(mpq_t left, tn_expr_kind kind, const mpq_t right)
{
    if (kind == TN_EXPR_PLUS)
        mpq_add(left, left, right);
    else if (kind == TN_EXPR_MINUS)
        mpq_sub(left, left, right);
    else if (kind == TN_EXPR_TIMES)
        mpq_mul(left, left, right);
    else if (kind == TN_EXPR_OVER)
        mpq_div(left, left, right);
    else if ((mpq_cmp(right, left) < 0) == (kind == TN_EXPR_LEAST))
        mpq_set(left, right);
}

const char *tn_amount_apply(tn_check *check, tn_expr_kind kind, const char *left, const char *right)
{
    if (!left || !right)
        return NULL;
    mpq_t a, b;
    mpq_inits(a, b, NULL);
    mpq_set_str(a, left, 10);
    mpq_set_str(b, right, 10);
    apply(a, kind, b);
    const char *text = keep(check, a);
    mpq_clears(a, b, NULL);
    return text;
}

bool tn_amount_is_zero(const char *value)
{
    return strcmp(value, "0") == 0;
}

const char *tn_power_name(int power, char *text, size_t size)
{
    static const char *const names[] = {"a plain number", "a length", "an area", "a volume"};
    if (power >= 0 && power <= 3)
        snprintf(text, size, "%s", names[power]);
    else
        snprintf(text, size, "a length to the power of %d", power);
    return text;
}

/* Is the operand a share that stands alone, `40%`? */
static bool is_share(const tn_check *check, tn_span span)
{
    const char *text = check->diagnostics->sources->files[span.file].text + span.begin;
    size_t size = span.end - span.begin, digits = strspn(text, "0123456789.");
    return size > 1 && digits == size - 1 && text[digits] == '%';
}

bool tn_same_power(tn_check *check, tn_sum_amount left, tn_span left_span, tn_sum_amount right, tn_span right_span,
                   const char *verb, tn_sum_amount *both)
{
    *both = left.any ? right : left;
    if (left.any || right.any || left.power == right.power)
        return true;
    char one[48], other[48];
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_DIMENSIONS, right_span, "%s cannot be %s %s",
                  tn_power_name(right.power, other, sizeof other), verb, tn_power_name(left.power, one, sizeof one));
    tn_note(check->diagnostics, d, &left_span, "this is %s", one);
    const char *text = check->diagnostics->sources->files[right_span.file].text + right_span.begin;
    int size = (int)(right_span.end - right_span.begin);
    if (left.power > 0 && is_share(check, right_span))
        tn_help(check->diagnostics, d, "a share is one of a sum: `%.*s * sum(...)`", size, text);
    else if (left.power == 0 && right.power == 2)
        tn_help(check->diagnostics, d,
                "write this without a unit; divided by `1m2` or `1sf` an area is a plain number");
    else if (left.power == 2 || right.power == 2)
        tn_help(check->diagnostics, d,
                "areas are written `120m2` or `96ft2`; divide by `1m2` or `1sf` for a plain number");
    else
        tn_help(check->diagnostics, d,
                left.power == 0 ? "write this without a unit; divided by `1m` or `1'` a length is a plain number"
                                : "lengths have a unit: `12m`, `12'`; divided by `1m` or `1'` one is a plain number");
    return false;
}

/* ---- arithmetic over one tray */

/* The fields and numbers that can be added up, or the one that was likely meant. */
static void help_figure(tn_check *check, const tn_checked_schema *schema, tn_diagnostic *d, const char *word)
{
    const char **names = TN_NEW_ARRAY(check->arena, const char *, schema->field_count + schema->number_count);
    char list[300] = "";
    size_t count = 0;
    for (uint32_t f = 0; names && f < schema->field_count; f++)
        if (schema->fields[f].kind == TN_FIELD_LENGTH || schema->fields[f].kind == TN_FIELD_ZONE)
            names[count++] = schema->fields[f].name;
    for (uint32_t n = 0; names && n < schema->number_count; n++)
        names[count++] = schema->numbers[n].name;
    for (size_t i = 0; i < count; i++)
        snprintf(list + strlen(list), sizeof list - strlen(list), "%s%s", i ? ", " : "", names[i]);
    const char *near = tn_nearest(word, names, count);
    const tn_checked_name *measure = tn_names_get(&check->names, word);
    if (measure && measure->rule && measure->rule->is_measure)
        tn_help(check->diagnostics, d, "`%s` is a measure, and so a number already: write it without `sum(...)`", word);
    else if (measure && measure->rule && !measure->rule->is_let)
        tn_help(check->diagnostics, d, "`%s` is a rule: say which numbers of its trays are meant, `FIELD of %s`", word,
                word);
    else if (tn_means_cost(check, word))
        tn_help(check->diagnostics, d, "what a whole house costs is `sum(cost)`");
    else if (tn_help_height(check, d, word))
        return;
    else if (strcmp(word, "area") == 0)
        tn_help(check->diagnostics, d, "areas of cells of a house are added up by `sum(area of cell(...))`");
    else if (near)
        tn_suggest(check->diagnostics, d, "%s", near);
    else if (count)
        tn_help(check->diagnostics, d, "what can be added up is %s", list);
    else
        tn_help(check->diagnostics, d, "count trays with `quantity(...)`, or give the schema a `number`");
}

static bool check_name(tn_check *check, const tn_checked_schema *schema, tn_ast_expr *figure, tn_sum_amount *amount)
{
    const char *name = figure->name->text;
    figure->field = tn_field_find(schema, name);
    const tn_checked_field *field = figure->field == TN_NONE ? NULL : &schema->fields[figure->field];
    *amount = (tn_sum_amount){.power = 1};
    if (field && field->ast->form == TN_FORM_MEASURE && !tn_schema_census(schema)) /* nobody knows what it is */
        return false;
    if (field && (field->kind == TN_FIELD_LENGTH || field->kind == TN_FIELD_ZONE))
        return tn_check_detail(check, field, figure->detail);
    if (field && field->ordered) { /* the place of the tray's value, or what a measure says */
        amount->power = field->power;
        figure->place = true;
        return tn_check_detail(check, field, figure->detail);
    }
    figure->number = field ? NULL : tn_schema_number(schema, name);
    if (figure->number) {
        amount->power = figure->number->power;
        return !figure->number->broken;
    }
    if (schema->broken || figure->name->broken || tn_refuse_param(check, schema, figure->name))
        return false;
    tn_diagnostic *d = field ? tn_report(check->diagnostics, E_NOT_A_LENGTH, figure->name->node.span,
                                         "`%s` has no lengths to add up", name)
                             : tn_report(check->diagnostics, E_NOT_A_LENGTH, figure->name->node.span,
                                         "there is no field `%s` to add up", name);
    tn_note(check->diagnostics, d, &schema->ast->name->node.span, "schema `%s` is here", schema->name);
    if (field)
        tn_help(check->diagnostics, d,
                "fields of lengths and the depths of zones can be added up; to count trays write "
                "`quantity(tray(%s ...), n > 1)`",
                name);
    else
        help_figure(check, schema, d, name);
    return false;
}

static bool power_fits(tn_check *check, const tn_ast_expr *expr, int power)
{
    if (power >= -POWER_MAX && power <= POWER_MAX)
        return true;
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_DIMENSIONS, expr->node.span, "this is a length to the power of %d", power);
    tn_help(check->diagnostics, d, "powers go from -%d to %d; a measure is a number, a length, an area or a volume",
            POWER_MAX, POWER_MAX);
    return false;
}

static bool check_two(tn_check *check, const tn_checked_schema *schema, tn_ast_expr *figure, tn_sum_amount *amount)
{
    tn_ast_expr *left = (tn_ast_expr *)figure->parts.first, *right = (tn_ast_expr *)figure->parts.last;
    tn_sum_amount a, b;
    bool good = tn_check_figure(check, schema, left, &a);
    good &= tn_check_figure(check, schema, right, &b);
    if (!good)
        return false;
    if (figure->kind == TN_EXPR_TIMES || figure->kind == TN_EXPR_OVER)
        *amount = (tn_sum_amount){.power = figure->kind == TN_EXPR_TIMES ? a.power + b.power : a.power - b.power};
    else if (!tn_same_power(check, a, left->node.span, b, right->node.span,
                            figure->kind == TN_EXPR_MINUS  ? "taken from"
                            : figure->kind == TN_EXPR_PLUS ? "added to"
                                                           : "compared with",
                            amount))
        return false;
    if (figure->kind == TN_EXPR_OVER && b.value && tn_amount_is_zero(b.value)) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_DIVIDED_BY_ZERO, right->node.span, "this divides by 0");
        tn_help(check->diagnostics, d, "divide by another number");
        return false;
    }
    amount->any = false;
    amount->value = a.value && b.value ? tn_amount_apply(check, figure->kind, a.value, b.value) : NULL;
    return power_fits(check, figure, amount->power);
}

bool tn_check_figure(tn_check *check, const tn_checked_schema *schema, tn_ast_expr *figure, tn_sum_amount *amount)
{
    *amount = (tn_sum_amount){0};
    switch (figure->kind) {
    case TN_EXPR_NUMBER:
        *amount = tn_amount_read(check, figure->name);
        figure->constant = amount->value;
        return amount->value != NULL;
    case TN_EXPR_FIGURE:
        return check_name(check, schema, figure, amount);
    case TN_EXPR_NEGATIVE: {
        bool good = tn_check_figure(check, schema, (tn_ast_expr *)figure->parts.first, amount);
        amount->value = amount->value ? tn_amount_apply(check, TN_EXPR_MINUS, "0", amount->value) : NULL;
        return good;
    }
    case TN_EXPR_PLUS:
    case TN_EXPR_MINUS:
    case TN_EXPR_TIMES:
    case TN_EXPR_OVER:
    case TN_EXPR_LEAST:
    case TN_EXPR_MOST:
        return check_two(check, schema, figure, amount);
    default:
        return false; /* already reported */
    }
}
