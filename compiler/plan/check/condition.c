/* Conditions on a number: from comparisons to the steps that a condition function takes. */
#include <stdlib.h>
#include <string.h>

#include "compiler/common/limits.h"
#include "compiler/plan/check/amount.h"
#include "compiler/plan/check/check.h"
#include "runtime/base/length.h"

/* ---- conditions that are always or never true
 *
 * Between two constants of its comparisons a condition depends on remainders only, so that trying each constant, its
 * neighbours, and one period after each decides it. Where that would take too long nothing is said. */

enum { WORK_MAX = 1000000 }; /* steps taken in all: a few milliseconds */

static bool holds(const tn_checked_condition *condition, int64_t n)
{
    bool stack[TN_NESTING_MAX + 2];
    size_t top = 0;
    for (size_t i = 0; i < condition->count; i++) {
        const tn_condition_step *step = &condition->steps[i];
        switch (step->opcode) {
        case TN_OP_LESS:
            stack[top++] = n < step->first;
            break;
        case TN_OP_EQUAL:
            stack[top++] = n == step->first;
            break;
        case TN_OP_GREATER:
            stack[top++] = n > step->first;
            break;
        case TN_OP_WITHIN:
            stack[top++] = step->first <= n && n <= step->second;
            break;
        case TN_OP_REMAINDER:
            stack[top++] = n % step->first == step->second;
            break;
        case TN_OP_BOTH:
            top--;
            stack[top - 1] = stack[top - 1] && stack[top];
            break;
        case TN_OP_EITHER:
            top--;
            stack[top - 1] = stack[top - 1] || stack[top];
            break;
        default:
            stack[top - 1] = !stack[top - 1];
            break;
        }
    }
    return stack[0];
}

static int64_t divisor(int64_t a, int64_t b)
{
    while (b != 0) {
        int64_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

/* What sums are multiples of: the greatest common divisor of the field's lengths; 1 for counts, 0 where all are 0. */
static int64_t unit_of(const tn_checked_schema *schema, uint32_t field)
{
    if (field == TN_NONE)
        return 1;
    int64_t unit = 0;
    for (uint32_t v = 0; v < schema->fields[field].value_count; v++)
        unit = divisor(unit, schema->fields[field].values[v].length);
    return unit;
}

/* The number of units after which all remainders repeat; 0 where it is more than WORK_MAX. */
static int64_t period_of(const tn_checked_condition *condition, int64_t unit)
{
    int64_t period = 1;
    for (size_t i = 0; i < condition->count; i++) {
        if (condition->steps[i].opcode != TN_OP_REMAINDER)
            continue;
        int64_t modulus = condition->steps[i].first / divisor(condition->steps[i].first, unit);
        modulus /= divisor(modulus, period);
        if (modulus > WORK_MAX / period)
            return 0;
        period *= modulus;
    }
    return period;
}

typedef struct tn_trial {
    const tn_checked_condition *condition;
    int64_t unit, period;
    bool seen[2]; /* false, true */
} tn_trial;

/* Tries one period of multiples of the unit from around `constant`; and one from 0. */
static void try_around(tn_trial *trial, int64_t constant)
{
    int64_t start = constant / trial->unit - 1;
    if (start < 0)
        start = 0;
    for (int64_t k = start; k <= start + trial->period + 2 && !(trial->seen[0] && trial->seen[1]); k++) {
        int64_t n;
        if (__builtin_mul_overflow(k, trial->unit, &n))
            return;
        trial->seen[holds(trial->condition, n)] = true;
    }
}

static void check_truth(tn_check *check, const tn_checked_condition *condition, const char *variable, uint32_t field)
{
    tn_trial trial = {.condition = condition,
                      .unit = check->schema && !check->schema->broken ? unit_of(check->schema, field) : 0};
    if (trial.unit == 0)
        return;
    trial.period = period_of(condition, trial.unit);
    if (trial.period == 0 || (int64_t)condition->count > WORK_MAX / (int64_t)condition->count / (trial.period + 3))
        return;
    try_around(&trial, 0);
    for (size_t i = 0; i < condition->count; i++) {
        const tn_condition_step *step = &condition->steps[i];
        if (step->opcode == TN_OP_LESS || step->opcode == TN_OP_EQUAL || step->opcode == TN_OP_GREATER ||
            step->opcode == TN_OP_WITHIN)
            try_around(&trial, step->first);
        if (step->opcode == TN_OP_WITHIN)
            try_around(&trial, step->second);
    }
    if (trial.seen[0] && trial.seen[1])
        return;
    tn_code code = trial.seen[1] ? W_ALWAYS_TRUE : W_NEVER_TRUE;
    if (!tn_check_wanted(check, code))
        return;
    tn_diagnostic *d =
        tn_report(check->diagnostics, code, condition->span, "this is %s true", trial.seen[1] ? "always" : "never");
    if (field == TN_NONE)
        tn_help(check->diagnostics, d, "`%s` is a whole number, 0 or more: compare it with another one", variable);
    else {
        char text[400];
        tn_say_values(&check->schema->fields[field], NULL, text, sizeof text);
        tn_help(check->diagnostics, d, "`%s` adds values of `%s`: %s", variable, check->schema->fields[field].name,
                text);
    }
}

typedef struct tn_condition_builder {
    tn_check *check;
    tn_checked_condition *condition;
    uint32_t field;              /* whose lengths are added, or TN_NONE */
    const tn_ast_word *variable; /* as first written */
    bool warned;                 /* about a remainder: nothing more is said about the whole */
    const tn_ast_expr *of_house; /* whose cells or rooms are counted, or NULL */
} tn_condition_builder;

/* ---- steps */

static void step(tn_condition_builder *b, tn_opcode opcode, int64_t first, int64_t second, tn_span span)
{
    tn_checked_condition *condition = b->condition;
    if (condition->count == condition->capacity) {
        size_t capacity = condition->capacity ? condition->capacity * 2 : 4;
        tn_condition_step *steps = TN_NEW_ARRAY(b->check->arena, tn_condition_step, capacity);
        if (!steps)
            return;
        if (condition->count > 0)
            memcpy(steps, condition->steps, condition->count * sizeof *steps);
        condition->steps = steps;
        condition->capacity = capacity;
    }
    condition->steps[condition->count++] = (tn_condition_step){opcode, first, second, span};
}

static void opposite(tn_condition_builder *b, tn_span span)
{
    step(b, TN_OP_NEITHER, 0, 0, span);
}

static void compare(tn_condition_builder *b, tn_operator op, int64_t value, tn_span span)
{
    static const tn_opcode opcodes[] = {
        [TN_LESS] = TN_OP_LESS,     [TN_AT_MOST] = TN_OP_GREATER, [TN_EQUAL] = TN_OP_EQUAL,
        [TN_UNEQUAL] = TN_OP_EQUAL, [TN_AT_LEAST] = TN_OP_LESS,   [TN_GREATER] = TN_OP_GREATER,
    };
    step(b, opcodes[op], value, 0, span);
    if (op == TN_AT_MOST || op == TN_UNEQUAL || op == TN_AT_LEAST)
        opposite(b, span);
}

/* ---- what may stand where */

static bool fail(tn_condition_builder *b)
{
    b->condition->broken = true;
    return false;
}

/* A number that is neither a count nor a length. */
static void report_constant(tn_check *check, const tn_ast_word *word, bool lengths)
{
    size_t digits = strspn(word->text, "0123456789.");
    if (word->kind == TN_WORD_DECIMAL && word->text[digits] == '\0') {
        tn_diagnostic *d = tn_report(check->diagnostics, E_NO_UNIT, word->node.span, "`%s` has no unit", word->text);
        tn_help(check->diagnostics, d, "write a length with its unit, such as `%s'` or `%sm`; counts are whole numbers",
                word->text, word->text);
        return;
    }
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_CONDITION_UNIT, word->node.span, "%s, and `%s` is not one",
                  lengths ? "a sum of one field is a length" : "trays are counted in whole numbers", word->text);
    tn_help(check->diagnostics, d,
            "compare sums with sums: `sum(FIELD * FIELD) > 90m2`, `quantity(a) >= 25%% * trays`");
}

/* The text of a file, for words of the author in help. */
static const char *text_at(tn_check *check, tn_span span)
{
    const char *copy = tn_arena_copy(check->arena, check->diagnostics->sources->files[span.file].text + span.begin,
                                     span.end - span.begin);
    return copy ? copy : "";
}

/* An area beside a number of cells or rooms: what asks for areas. compared: the comparison that it stands in */
static void help_area(tn_condition_builder *b, tn_diagnostic *d, const tn_ast_word *word, tn_span compared)
{
    tn_check *check = b->check;
    const char *of = text_at(check, b->of_house->node.span), *comparison = text_at(check, compared);
    const char *variable = b->variable ? b->variable->text : "n";
    const char *sign = comparison + strcspn(comparison, "<>=!");
    bool first = sign > comparison && *sign; /* `n > 90sf`, not `90sf < n` or `n in 1sf..2sf` */
    first = first && strncmp(comparison, variable, strlen(variable)) == 0;
    if (b->of_house->kind == TN_EXPR_CELL)
        tn_help(check->diagnostics, d,
                "write a whole number, such as `%s > 2`; areas are added up by `sum(area of %s, %s)`", variable, of,
                comparison);
    else
        tn_help(check->diagnostics, d,
                "write a whole number, such as `%s > 2`; the area of each room is asked for in its parentheses: "
                "`%.*s%sarea %s%s)`",
                variable, (int)strlen(of) - 1, of, b->of_house->items.first ? ", " : "", first ? "" : "> ",
                first ? sign : word->text);
}

/* Cells or rooms of houses are compared with what is no whole number. */
static bool check_count(tn_condition_builder *b, const tn_ast_word *word, tn_span compared)
{
    if (word->broken || word->kind == TN_WORD_NUMBER)
        return !word->broken;
    tn_diagnostic *d = tn_report(b->check->diagnostics, E_CONDITION_UNIT, word->node.span,
                                 "%s are counted in whole numbers, and `%s` is not one",
                                 b->of_house->kind == TN_EXPR_CELL ? "cells" : "rooms", word->text);
    if (word->kind == TN_WORD_AREA)
        help_area(b, d, word, compared);
    else
        tn_help(b->check->diagnostics, d, "write a whole number, such as `%s > 2`",
                b->variable ? b->variable->text : "n");
    return false;
}

/* A constant with a unit where lengths are added, a plain number where trays are counted. 0 has no need of a unit. */
static bool check_unit(tn_check *check, const tn_ast_word *word, bool lengths)
{
    if (word->broken)
        return false;
    if (word->kind == TN_WORD_DECIMAL || word->kind == TN_WORD_AREA) {
        report_constant(check, word, lengths);
        return false;
    }
    if ((word->kind == TN_WORD_LENGTH) == lengths || (lengths && word->value == 0))
        return true;
    tn_diagnostic *d;
    if (lengths) {
        d = tn_report(check->diagnostics, E_CONDITION_UNIT, word->node.span, "a sum is a length, and `%s` has no unit",
                      word->text);
        tn_help(check->diagnostics, d, "write it with its unit, such as `%s'` or `%sm`", word->text, word->text);
    } else {
        d = tn_report(check->diagnostics, E_CONDITION_UNIT, word->node.span, "trays are counted, and `%s` is a length",
                      word->text);
        tn_help(check->diagnostics, d, "write a plain number; lengths are added up by `sum(FIELD, w > %s)` or `total`",
                word->text);
    }
    return false;
}

/* Areas are compared in halves of a square micrometre. */
static bool check_area(tn_check *check, const tn_ast_word *word)
{
    if (word->broken)
        return false;
    if (word->kind == TN_WORD_AREA || (word->kind != TN_WORD_DECIMAL && word->value == 0))
        return true;
    tn_diagnostic *d = tn_report(check->diagnostics, E_CONDITION_UNIT, word->node.span,
                                 "areas are added here, and `%s` is not one", word->text);
    tn_help(check->diagnostics, d, "write an area, such as `90sf` or `8.5m2`");
    return false;
}

/* What a constant counts in the condition's steps. */
static int64_t counted(tn_condition_builder *b, const tn_ast_word *word)
{
    int64_t square_micrometres;
    if (b->field != TN_AREAS || word->kind != TN_WORD_AREA)
        return word->value;
    if (!tn_amount_read_cell(b->check, word, &square_micrometres)) {
        fail(b);
        return 0;
    }
    return square_micrometres > INT64_MAX / 2 ? INT64_MAX : 2 * square_micrometres;
}

/* compared: the comparison that it stands in */
static bool check_constant(tn_condition_builder *b, const tn_ast_word *word, tn_span compared)
{
    bool good = false;
    if (word->kind != TN_WORD_NAME)
        good = b->of_house            ? check_count(b, word, compared)
               : b->field == TN_AREAS ? check_area(b->check, word)
                                      : check_unit(b->check, word, b->field != TN_NONE);
    else if (!word->broken) {
        tn_diagnostic *d = tn_report(b->check->diagnostics, E_TWO_VARIABLES, word->node.span,
                                     "a number must stand here, and `%s` is not one", word->text);
        tn_help(b->check->diagnostics, d, "a condition compares its one variable with numbers");
    }
    return good || fail(b);
}

static bool check_variable(tn_condition_builder *b, const tn_ast_word *word)
{
    if (word->kind != TN_WORD_NAME) {
        if (!word->broken) {
            tn_diagnostic *d = tn_report(b->check->diagnostics, E_NO_VARIABLE, word->node.span,
                                         "a variable has to stand here, such as `n`");
            tn_help(b->check->diagnostics, d, "a condition says something about a number that you name: `n > 1`");
        }
        return fail(b);
    }
    if (!b->variable)
        b->variable = word;
    if (strcmp(b->variable->text, word->text) == 0)
        return true;
    tn_diagnostic *d =
        tn_report(b->check->diagnostics, E_TWO_VARIABLES, word->node.span,
                  "a condition has one variable, and this one has `%s` and `%s`", b->variable->text, word->text);
    tn_note(b->check->diagnostics, d, &b->variable->node.span, "`%s` is here", b->variable->text);
    tn_help(b->check->diagnostics, d, "use the same name for both, or join two rules by `and`");
    return fail(b);
}

static bool is_metric(const tn_ast_word *length)
{
    return tn_length_style_of(length->text) != TN_STYLE_FEET;
}

/* `20'..50m`: it has a meaning, but hardly that of its author. */
static void warn_of_units(tn_check *check, const tn_ast_range *range)
{
    if (range->low == range->high || is_metric(range->low) == is_metric(range->high) ||
        !tn_check_wanted(check, W_MIXED_UNITS))
        return;
    tn_diagnostic *d =
        tn_report(check->diagnostics, W_MIXED_UNITS, range->span, "this range begins in %s and ends in %s",
                  is_metric(range->low) ? "metres" : "feet", is_metric(range->high) ? "metres" : "feet");
    tn_help(check->diagnostics, d, "write both ends in one unit");
}

bool tn_check_range(tn_check *check, const tn_ast_range *range, bool lengths)
{
    bool good = check_unit(check, range->low, lengths);
    if (range->high != range->low)
        good &= check_unit(check, range->high, lengths);
    if (good && lengths)
        warn_of_units(check, range);
    if (!good || range->low->value <= range->high->value)
        return good;
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_RANGE_BACKWARDS, range->span, "this range ends before it starts");
    tn_advise(check->diagnostics, d, "%s..%s", range->high->text, range->low->text);
    return false;
}

/* ---- the kinds of comparison */

static tn_operator turned(tn_operator op)
{
    static const tn_operator table[] = {
        [TN_LESS] = TN_GREATER,    [TN_AT_MOST] = TN_AT_LEAST, [TN_EQUAL] = TN_EQUAL,
        [TN_UNEQUAL] = TN_UNEQUAL, [TN_AT_LEAST] = TN_AT_MOST, [TN_GREATER] = TN_LESS,
    };
    return table[op];
}

static void add_compare(tn_condition_builder *b, const tn_ast_cond *cond)
{
    const tn_ast_word *left = cond->left, *right = cond->right;
    if (left->kind != TN_WORD_NAME && right->kind != TN_WORD_NAME) {
        if (!left->broken && !right->broken) {
            tn_diagnostic *d = tn_report(b->check->diagnostics, E_NO_VARIABLE, cond->node.span,
                                         "this compares two numbers, and no variable");
            tn_help(b->check->diagnostics, d, "write a name of your choice for the number that is counted: `n > 1`");
        }
        fail(b);
        return;
    }
    bool constant_left = left->kind != TN_WORD_NAME;
    const tn_ast_word *variable = constant_left ? right : left, *constant = constant_left ? left : right;
    if (check_variable(b, variable) && check_constant(b, constant, cond->node.span))
        compare(b, constant_left ? turned(cond->op) : cond->op, counted(b, constant), cond->node.span);
}

static void add_areas_within(tn_condition_builder *b, const tn_ast_cond *cond)
{
    const tn_ast_range *range = &cond->range;
    if (!check_area(b->check, range->low) || !check_area(b->check, range->high)) {
        fail(b);
        return;
    }
    int64_t low = counted(b, range->low), high = counted(b, range->high);
    step(b, TN_OP_WITHIN, low, high, cond->node.span);
    if (low <= high || b->condition->broken)
        return;
    tn_diagnostic *d =
        tn_report(b->check->diagnostics, E_RANGE_BACKWARDS, range->span, "this range ends before it starts");
    tn_advise(b->check->diagnostics, d, "%s..%s", range->high->text, range->low->text);
    fail(b);
}

static void add_within(tn_condition_builder *b, const tn_ast_cond *cond)
{
    if (!check_variable(b, cond->left))
        return;
    const tn_ast_range *range = &cond->range;
    if (b->field == TN_AREAS)
        add_areas_within(b, cond);
    else if (b->of_house && !(check_count(b, range->low, cond->node.span) &&
                              (range->low == range->high || check_count(b, range->high, cond->node.span))))
        fail(b);
    else if (tn_check_range(b->check, &cond->range, b->field != TN_NONE))
        step(b, TN_OP_WITHIN, cond->range.low->value, cond->range.high->value, cond->node.span);
    else
        fail(b);
}

static bool warn_remainder(tn_condition_builder *b, const tn_ast_cond *cond)
{
    if (!tn_check_wanted(b->check, W_REMAINDER_NEVER))
        return false;
    tn_diagnostic *d = tn_report(b->check->diagnostics, W_REMAINDER_NEVER, cond->node.span,
                                 "a remainder by %s is never %s", cond->modulus->text, cond->right->text);
    if (cond->modulus->kind == TN_WORD_NUMBER)
        tn_help(b->check->diagnostics, d, "it can be 0 to %lld", (long long)cond->modulus->value - 1);
    else
        tn_help(b->check->diagnostics, d, "it is at least 0 and less than %s", cond->modulus->text);
    return true;
}

static void add_remainder(tn_condition_builder *b, const tn_ast_cond *cond)
{
    if (!check_variable(b, cond->left) || !check_constant(b, cond->modulus, cond->node.span) ||
        !check_constant(b, cond->right, cond->node.span))
        return;
    if (b->field == TN_AREAS) {
        tn_diagnostic *d =
            tn_report(b->check->diagnostics, E_BAD_REMAINDER, cond->node.span, "areas have no remainders");
        tn_help(b->check->diagnostics, d, "compare the area with another: `a > 90sf`");
        fail(b);
        return;
    }
    int64_t modulus = cond->modulus->value, remainder = cond->right->value;
    if (modulus <= 0) {
        tn_diagnostic *d = tn_report(b->check->diagnostics, E_BAD_REMAINDER, cond->modulus->node.span,
                                     "there is no remainder by %s", cond->modulus->text);
        tn_help(b->check->diagnostics, d, "write a number above 0: `%s mod 2 = 0` means even", cond->left->text);
        fail(b);
        return;
    }
    if (cond->op != TN_EQUAL && cond->op != TN_UNEQUAL) {
        tn_diagnostic *d = tn_report(b->check->diagnostics, E_BAD_REMAINDER, cond->node.span,
                                     "a remainder is compared by `=` or `!=` only");
        tn_help(b->check->diagnostics, d, "join several by `or`: `%s mod %s = 0 or %s mod %s = 1`", cond->left->text,
                cond->modulus->text, cond->left->text, cond->modulus->text);
        fail(b);
        return;
    }
    if (remainder < 0 || remainder >= modulus)
        b->warned = warn_remainder(b, cond);
    if (remainder < 0)
        step(b, TN_OP_LESS, 0, 0, cond->node.span); /* never: the number is not below 0 */
    else
        step(b, TN_OP_REMAINDER, modulus, remainder, cond->node.span);
    if (cond->op == TN_UNEQUAL)
        opposite(b, cond->node.span);
}

static void add(tn_condition_builder *b, const tn_ast_cond *cond)
{
    switch (cond->kind) {
    case TN_COND_COMPARE:
        add_compare(b, cond);
        break;
    case TN_COND_WITHIN:
        add_within(b, cond);
        break;
    case TN_COND_REMAINDER:
        add_remainder(b, cond);
        break;
    case TN_COND_NOT:
        add(b, (const tn_ast_cond *)cond->parts.first);
        opposite(b, cond->node.span);
        break;
    case TN_COND_AND:
    case TN_COND_OR:
        for (TN_EACH(const tn_ast_cond, part, cond->parts)) {
            add(b, part);
            if ((const tn_ast_node *)part != cond->parts.first)
                step(b, cond->kind == TN_COND_AND ? TN_OP_BOTH : TN_OP_EITHER, 0, 0, cond->node.span);
        }
        break;
    }
}

/* ---- sharing */

/* Equal conditions are one function. */
static tn_checked_condition *share(tn_check *check, tn_checked_condition *condition)
{
    enum { STEP = 48 };
    char *key = tn_arena_alloc(check->arena, STEP * condition->count + 1);
    size_t used = 0;
    if (!key)
        return NULL;
    for (size_t i = 0; i < condition->count; i++)
        used += (size_t)snprintf(key + used, STEP, "%d %llx %llx;", (int)condition->steps[i].opcode,
                                 (unsigned long long)condition->steps[i].first,
                                 (unsigned long long)condition->steps[i].second);
    tn_checked_condition *same = tn_names_get(&check->conditions, key);
    if (same)
        return same;
    tn_names_put(&check->conditions, key, condition);
    return condition;
}

static tn_checked_condition *checked(tn_check *check, const tn_ast_cond *cond, uint32_t field,
                                     const tn_ast_expr *of_house)
{
    tn_checked_condition *condition = TN_NEW(check->arena, tn_checked_condition);
    if (!condition)
        return NULL;
    *condition = (tn_checked_condition){.span = cond->node.span};
    tn_condition_builder b = {.check = check, .condition = condition, .field = field, .of_house = of_house};
    add(&b, cond);
    if (condition->broken || tn_arena_failed(check->arena))
        return condition;
    if (!b.warned && field != TN_AREAS)
        check_truth(check, condition, b.variable->text, field);
    return share(check, condition);
}

tn_checked_condition *tn_check_condition(tn_check *check, const tn_ast_cond *cond, uint32_t field)
{
    return checked(check, cond, field, NULL);
}

tn_checked_condition *tn_check_count(tn_check *check, const tn_ast_expr *quantity)
{
    return checked(check, quantity->condition, TN_NONE, tn_counts_house(quantity));
}

tn_checked_condition *tn_check_total(tn_check *check, const tn_ast_clause *clause, uint32_t field)
{
    tn_checked_condition *condition = TN_NEW(check->arena, tn_checked_condition);
    if (!condition)
        return NULL;
    *condition = (tn_checked_condition){.span = clause->node.span};
    tn_condition_builder b = {.check = check, .condition = condition, .field = field};
    if (clause->form == TN_FORM_TOTAL_COMPARE && check_constant(&b, clause->word, clause->node.span))
        compare(&b, clause->op, clause->word->value, clause->node.span);
    if (clause->form == TN_FORM_TOTAL_RANGE) {
        if (tn_check_range(check, &clause->range, true))
            step(&b, TN_OP_WITHIN, clause->range.low->value, clause->range.high->value, clause->node.span);
        else
            fail(&b);
    }
    if (condition->broken || tn_arena_failed(check->arena))
        return condition;
    check_truth(check, condition, "the total", field);
    return share(check, condition);
}
