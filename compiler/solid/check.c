/* Checks what a .solid file means: names once, settings once, expressions over what is measured. */
#include <math.h>
#include <string.h>
#include <strings.h>

#include "compiler/common/diagnostic.h"
#include "compiler/common/lexical.h"
#include "compiler/common/names.h"
#include "compiler/solid/solid.h"
#include "runtime/number/interval.h"
#include "runtime/solid/measured.h"

/* ==== works out numbers of designs exactly, in tenths and their tenths, and rounds each result once: what is written
 * to touch does touch */

/* Shifts the one with fewer places so that both have as many. False if that passes what is held. */
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

/* Whole numbers that divide each other as two numbers do. False if one has more than 15 digits. */
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

/* Takes `unit a/b`; wrong ones are reported. */
static void solid_take_unit(tn_solid_check *check, const tn_solid_item *item)
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

/* ==== tells whether a requirement always or never holds, whatever the design: by the values that measures can have */

/* The weakest contact has no value where nothing touches. */
static tn_interval bounds_of_measure(uint32_t term)
{
    switch ((tn_solid_measured)term) {
    case TN_SOLID_CENTRE_X_MEASURED:
    case TN_SOLID_CENTRE_Y_MEASURED:
    case TN_SOLID_CENTRE_Z_MEASURED:
    case TN_SOLID_STABLE_MEASURED:
        return (tn_interval){-INFINITY, INFINITY, false};
    case TN_SOLID_SUPPORT_MEASURED:
        return (tn_interval){0, 1, false};
    case TN_SOLID_WEAKEST_MEASURED:
        return (tn_interval){0, INFINITY, true};
    default:
        return (tn_interval){0, INFINITY, false};
    }
}

/* Expressions nest no deeper than the parser allows. */
static tn_interval bounds_of(const tn_expression *e)
{
    tn_interval values[TN_ARITY_MAX];
    const tn_interval *operands[TN_ARITY_MAX];
    size_t count = 0;
    if (e->op == TN_OP_NUMBER)
        return tn_interval_of(e->number);
    if (e->op == TN_OP_TERM)
        return bounds_of_measure(e->term);
    for (const tn_expression *operand = e->first; operand && count < TN_ARITY_MAX; operand = operand->next) {
        values[count] = bounds_of(operand);
        operands[count] = &values[count];
        count++;
    }
    return tn_operation_bounds(e->op, operands);
}

static tn_solid_answer opposite(tn_solid_answer answer)
{
    return answer == TN_SOLID_ALWAYS ? TN_SOLID_NEVER : answer == TN_SOLID_NEVER ? TN_SOLID_ALWAYS : TN_SOLID_DEPENDS;
}

static tn_solid_answer both(tn_solid_answer a, tn_solid_answer b)
{
    if (a == TN_SOLID_NEVER || b == TN_SOLID_NEVER)
        return TN_SOLID_NEVER;
    return a == TN_SOLID_ALWAYS && b == TN_SOLID_ALWAYS ? TN_SOLID_ALWAYS : TN_SOLID_DEPENDS;
}

static tn_solid_answer answer_of(bool always, bool never)
{
    return always ? TN_SOLID_ALWAYS : never ? TN_SOLID_NEVER : TN_SOLID_DEPENDS;
}

/* What may have no value does not hold there. */
static tn_solid_answer is_at_most(tn_interval a, tn_interval b)
{
    return answer_of(a.high <= b.low && !a.fails && !b.fails, a.low > b.high);
}

static tn_solid_answer is_below(tn_interval a, tn_interval b)
{
    return answer_of(a.high < b.low && !a.fails && !b.fails, a.low >= b.high);
}

static tn_solid_answer is_equal(tn_interval a, tn_interval b)
{
    bool one = a.low == a.high && b.low == b.high && a.low == b.low;
    return answer_of(one && !a.fails && !b.fails, a.high < b.low || b.high < a.low);
}

static tn_solid_answer compare(const tn_expression *e)
{
    tn_interval a = bounds_of(e->first), b = bounds_of(e->first->next);
    switch ((int)e->op) {
    case TN_OP_IS_BELOW:
        return is_below(a, b);
    case TN_OP_IS_AT_MOST:
        return is_at_most(a, b);
    case TN_OP_IS_ABOVE:
        return is_below(b, a);
    case TN_OP_IS_AT_LEAST:
        return is_at_most(b, a);
    case TN_OP_IS_EQUAL:
        return is_equal(a, b);
    case TN_OP_IS_UNEQUAL:
        return a.fails || b.fails ? TN_SOLID_DEPENDS : opposite(is_equal(a, b));
    default: /* between */
        return both(is_at_most(b, a), is_at_most(a, bounds_of(e->last)));
    }
}

static tn_solid_answer is_not_zero(tn_interval value)
{
    bool always = !value.fails && (value.low > 0 || value.high < 0);
    return answer_of(always, value.low == 0 && value.high == 0);
}

static tn_solid_answer solid_requirement_answer(const tn_expression *e)
{
    switch ((int)e->op) {
    case TN_OP_IS_BELOW:
    case TN_OP_IS_AT_MOST:
    case TN_OP_IS_EQUAL:
    case TN_OP_IS_UNEQUAL:
    case TN_OP_IS_AT_LEAST:
    case TN_OP_IS_ABOVE:
    case TN_OP_IS_BETWEEN:
        return compare(e);
    case TN_OP_IS_BOTH:
        return both(solid_requirement_answer(e->first), solid_requirement_answer(e->last));
    case TN_OP_IS_EITHER:
        return opposite(
            both(opposite(solid_requirement_answer(e->first)), opposite(solid_requirement_answer(e->last))));
    case TN_OP_IS_NOT:
        return opposite(solid_requirement_answer(e->first));
    default:
        return is_not_zero(bounds_of(e));
    }
}

const tn_expression_scope tn_solid_scope = {
    .names = tn_solid_measured_names,
    .count = TN_SOLID_MEASURED_COUNT,
    .words = TN_WORDS_PLAIN,
    .what = "measure",
    .examples = {"volume", "width, height", "width, height, depth"},
    .split = "write several: they are joined by a comma",
    .unknown = E_UNKNOWN_SOLID_MEASURE,
    .wrong = E_SOLID_EXPRESSION,
    .vocabulary = &tn_solid_words,
    .places = TN_SOLID_AT(MEASURED),
};

static const char *const setting_names[TN_SOLID_SETTING_COUNT] = {"symmetry", "flat", "noclip",
                                                                  "correct",  "unit", "model"};

static void twice(tn_solid_check *check, tn_span span, tn_span first, const char *what, const char *name,
                  const char *help)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_SOLID_TWICE, span, "%s `%s` is there twice", what, name);
    tn_note(check->diagnostics, d, &first, "the first is here");
    tn_help(check->diagnostics, d, "%s", help);
    check->solid->wrong = true;
}

/* ---- settings */

static void take_symmetry(tn_solid_check *check, const tn_solid_item *item)
{
    uint32_t last = 0;
    bool ordered = true;
    for (const tn_solid_entry *entry = item->entries.first; entry; entry = entry->next) {
        uint32_t flag = entry->axis < 3 ? 1u << entry->axis : 0;
        if (check->solid->flags & flag) {
            tn_diagnostic *d =
                tn_report(check->diagnostics, E_SOLID_TWICE, entry->span, "this plane of symmetry is given twice");
            tn_help(check->diagnostics, d, "leave one of them out");
            check->solid->wrong = true;
        }
        ordered = ordered && flag >= last;
        last = flag;
        check->solid->flags |= flag;
    }
    if (ordered)
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, W_SYMMETRY_ORDER, item->span,
                                 "planes of symmetry are applied in the order x, y, z, whatever the order here");
    tn_help(check->diagnostics, d, "write them in that order");
}

static void take_model(tn_solid_check *check, const tn_solid_item *item)
{
    static const char *const units[TN_SOLID_MODEL_COUNT] = {"", "mm", "cm", "m"};
    for (uint32_t i = 1; i < TN_SOLID_MODEL_COUNT; i++)
        if (item->name.text && strcmp(item->name.text, units[i]) == 0)
            check->solid->model = i;
    if (check->solid->model != TN_MODEL_NONE)
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, E_SOLID_LENGTH, item->name.span,
                                 "`%.40s` is not a unit of a design", item->name.text ? item->name.text : "");
    tn_help(check->diagnostics, d, "write `model mm;`, `model cm;` or `model m;`");
    check->solid->wrong = true;
}

static void take_flat(tn_solid_check *check, const tn_solid_item *item)
{
    check->solid->flags |= TN_SOLID_FLAT;
    check->solid->depth = tn_solid_value(check, &item->number[0]);
    if (check->solid->wrong || check->solid->depth > 0)
        return;
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_SOLID_SIZE, item->number[0].span, "the depth of a flat design is above 0");
    tn_help(check->diagnostics, d, "write `flat 0.5;`");
    check->solid->wrong = true;
}

static void apply_setting(tn_solid_check *check, const tn_solid_item *item)
{
    switch (item->kind) {
    case TN_SOLID_SETS_SYMMETRY:
        take_symmetry(check, item);
        break;
    case TN_SOLID_SETS_FLAT:
        take_flat(check, item);
        break;
    case TN_SOLID_SETS_NOCLIP:
        check->solid->flags |= TN_SOLID_NOCLIP;
        break;
    case TN_SOLID_SETS_PENETRATION:
        check->solid->flags |= TN_SOLID_PENETRATION;
        break;
    case TN_SOLID_SETS_UNIT:
        solid_take_unit(check, item);
        break;
    case TN_SOLID_SETS_MODEL:
        take_model(check, item);
        break;
    default:
        break;
    }
}

/* `model` says what numbers are, so that it is looked at before the others. */
static void take_settings(tn_solid_check *check)
{
    const tn_solid_item **settings = check->solid->settings;
    for (const tn_solid_item *item = check->solid->design->first; item; item = item->next) {
        if (item->kind >= TN_SOLID_SETTING_COUNT)
            continue;
        if (settings[item->kind])
            twice(check, item->span, settings[item->kind]->span, "the statement", setting_names[item->kind],
                  check->solid->base ? "a design that is made `from` another takes its settings over"
                                     : "leave one of them out");
        settings[item->kind] = item;
    }
    const tn_checked_solid *base = check->solid->base;
    if (!base || !base->settings[TN_SOLID_SETS_MODEL])
        if (settings[TN_SOLID_SETS_MODEL])
            apply_setting(check, settings[TN_SOLID_SETS_MODEL]);
    for (int kind = 0; kind < TN_SOLID_SETTING_COUNT; kind++)
        if (settings[kind] && kind != TN_SOLID_SETS_MODEL && !(base && base->settings[kind] == settings[kind]))
            apply_setting(check, settings[kind]);
    const tn_solid_item *symmetry = settings[TN_SOLID_SETS_SYMMETRY];
    if ((check->solid->flags & TN_SOLID_FLAT) && (check->solid->flags & TN_SOLID_SYMMETRY_Z)) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_SOLID_FLAT, symmetry->span,
                                     "a flat design has no symmetry in z: each box would be halved and joined again");
        tn_help(check->diagnostics, d, "leave z out");
        check->solid->wrong = true;
    }
}

/* ---- expressions */

static bool names_measure(const tn_expression *e)
{
    bool names = e->op == TN_OP_TERM;
    for (const tn_expression *operand = e->first; operand; operand = operand->next)
        names = names || names_measure(operand);
    return names;
}

static void warn_of_answer(tn_solid_check *check, const tn_solid_entry *entry)
{
    tn_solid_answer answer = solid_requirement_answer(entry->expression);
    if (answer == TN_SOLID_DEPENDS)
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, W_REQUIREMENT_CONSTANT, entry->span, "this requirement %s holds",
                                 answer == TN_SOLID_ALWAYS ? "always" : "never");
    if (names_measure(entry->expression))
        tn_help(check->diagnostics, d,
                "whatever the design: sizes and counts are never below 0, and `support` is never above 1");
    else
        tn_help(check->diagnostics, d, "it is not about the design: name a measure, as in `parts = 1`");
}

static void check_expressions(tn_solid_check *check, const tn_solid_item *item)
{
    for (const tn_solid_entry *entry = item->entries.first; entry; entry = entry->next) {
        size_t errors = check->diagnostics->error_count;
        tn_expression_check(check->diagnostics, &tn_solid_scope, entry->expression);
        if (check->diagnostics->error_count > errors) {
            check->solid->wrong = true;
        } else if (item->kind == TN_SOLID_REQUIRES) {
            warn_of_answer(check, entry);
        }
    }
}

/* Which goal of the design, or of what it is made from, has this name already? */
static const tn_solid_item *goal_before(const tn_checked_solid *solid, const tn_solid_item *goal)
{
    for (; solid; solid = solid->base)
        for (const tn_solid_item *item = solid->design->first; item && item != goal; item = item->next)
            if (item->kind == TN_SOLID_AIMS && item->name.text && strcmp(item->name.text, goal->name.text) == 0)
                return item;
    return NULL;
}

/* A goal's target (0) or weight (1). Both are plain numbers, read as what the module holds (emit.c). */
static void check_goal_number(tn_solid_check *check, const tn_solid_item *item, int which)
{
    double value = tn_solid_goal_number(check->diagnostics->sources, item, which, 0);
    bool below = which == 1 && value < 0;
    tn_range_note(check->diagnostics, item->given[which], which == 1 ? 0 : -TN_COORDINATE_MAX, TN_COORDINATE_MAX);
    if (!below && fabs(value) <= TN_COORDINATE_MAX)
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, E_SETTING_RANGE, item->given[which],
                                 below        ? "a weight is not below 0"
                                 : which == 1 ? "this weight is too large"
                                              : "this target is too far from 0");
    if (below)
        tn_help(check->diagnostics, d, "a larger weight makes a goal count for more");
    else
        tn_help(check->diagnostics, d, "write a number from %.0f to %.0f", which == 1 ? 0 : -TN_COORDINATE_MAX,
                TN_COORDINATE_MAX);
    check->solid->wrong = true;
}

static void check_goal(tn_solid_check *check, const tn_solid_item *item)
{
    const tn_solid_item *before = item->name.text ? goal_before(check->solid, item) : NULL;
    check_expressions(check, item);
    if (before)
        twice(check, item->name.span, before->name.span, "the goal", item->name.text, "give one of them another name");
    if (item->name.text && !tn_name_fits(check->diagnostics, item->name.text, item->name.span))
        check->solid->wrong = true;
    check_goal_number(check, item, 0);
    check_goal_number(check, item, 1);
}

/* ---- boxes */

static const tn_checked_box *box_before(const tn_checked_solid *solid, const char *name)
{
    for (; solid; solid = solid->anew ? NULL : solid->base)
        for (const tn_checked_box *box = solid->first; box; box = box->next)
            if (box->item->name.text && strcmp(box->item->name.text, name) == 0)
                return box;
    return NULL;
}

static void take_box(tn_solid_check *check, const tn_solid_item *item)
{
    const tn_checked_box *before = item->name.text ? box_before(check->solid, item->name.text) : NULL;
    if (before)
        twice(check, item->name.span, before->item->name.span, "the box", item->name.text,
              "give one of them another name");
    if (item->name.text && !tn_name_fits(check->diagnostics, item->name.text, item->name.span))
        check->solid->wrong = true;
    tn_check_box(check, item);
}

static void take_items(tn_solid_check *check)
{
    for (const tn_solid_item *item = check->solid->design->first; item; item = item->next) {
        if (item->kind == TN_SOLID_BOX)
            take_box(check, item);
        else if (item->kind == TN_SOLID_GENES)
            tn_check_genes(check, item);
        else if (item->kind == TN_SOLID_AIMS)
            check_goal(check, item);
        else if (item->kind == TN_SOLID_ASKS || item->kind == TN_SOLID_REQUIRES)
            check_expressions(check, item);
    }
}

static bool sets(const tn_checked_solid *solid, int kind)
{
    return solid->settings[kind] && solid->settings[kind] != solid->base->settings[kind];
}

/* The boxes of a base as the design's own settings have them. */
static void take_boxes_anew(tn_solid_check *check, const tn_checked_solid *base)
{
    tn_diagnostics *list = check->diagnostics;
    if (base->base)
        take_boxes_anew(check, base->base);
    for (const tn_solid_item *item = base->design->first; item; item = item->next) {
        size_t errors = list->error_count;
        if (item->kind == TN_SOLID_BOX)
            tn_check_box(check, item);
        else if (item->kind == TN_SOLID_GENES)
            tn_check_genes(check, item);
        if (list->error_count > errors && list->count > 0)
            tn_note(list, &list->items[list->count - 1], &check->solid->design->name.span, "`%.100s` is made from this",
                    check->solid->design->name.text);
    }
}

/* What `flat` and `unit` do to boxes they do to those of the base, too. */
static void take_base_boxes(tn_solid_check *check)
{
    tn_checked_solid *solid = check->solid;
    if (!solid->base || solid->wrong || (!sets(solid, TN_SOLID_SETS_FLAT) && !sets(solid, TN_SOLID_SETS_UNIT)))
        return;
    solid->anew = true;
    take_boxes_anew(check, solid->base);
}

static void count_boxes(tn_solid_check *check)
{
    tn_checked_solid *solid = check->solid;
    solid->box_count = solid->base && !solid->anew ? solid->base->box_count : 0;
    for (const tn_checked_box *box = solid->first; box; box = box->next)
        solid->box_count++;
    if (solid->wrong || check->damaged)
        return;
    if (solid->box_count == 0) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_SOLID_EMPTY, solid->design->name.span,
                                     "the design `%.100s` has no box", solid->design->name.text);
        tn_help(check->diagnostics, d, "write one: `box slab from (0, 0, 0) to (4, 1, 2);`");
    } else if (solid->box_count > TN_SOLID_BOXES_MAX) {
        tn_report(check->diagnostics, E_SOLID_TOO_MANY, solid->design->name.span,
                  "this design has %u boxes; a module holds %u", solid->box_count, TN_SOLID_BOXES_MAX);
    }
}

/* ---- designs */

static tn_checked_solid *find(const tn_checked_solids *solids, const char *name)
{
    for (tn_checked_solid *solid = solids->first; solid; solid = solid->next)
        if (solid->design->name.text && strcmp(solid->design->name.text, name) == 0)
            return solid;
    return NULL;
}

static void take_base(tn_solid_check *check, const tn_checked_solids *solids)
{
    const tn_solid_text *base = &check->solid->design->base;
    if (!base->text)
        return;
    tn_checked_solid *found = find(solids, base->text);
    check->solid->base = found;
    if (found) {
        check->solid->flags = found->flags;
        check->solid->model = found->model;
        check->solid->depth = found->depth;
        check->solid->unit = found->unit;
        memcpy(check->solid->settings, found->settings, sizeof found->settings);
        check->solid->wrong |= found->wrong;
        return;
    }
    tn_diagnostic *d = tn_report(check->diagnostics, E_UNKNOWN_SOLID, base->span,
                                 "no design `%.100s` comes before this one", base->text);
    tn_help(check->diagnostics, d, "a design that others are made from stands above them, or in a file that is used");
    check->solid->wrong = true;
}

static void take_design(tn_solid_check *check, tn_checked_solids *solids, const tn_solid_design *design, bool imported)
{
    tn_checked_solid *solid = TN_NEW(check->arena, tn_checked_solid);
    if (!solid || !design->name.text)
        return;
    const tn_checked_solid *before = find(solids, design->name.text);
    solid->design = design;
    solid->imported = imported;
    check->solid = solid;
    tn_name_fits(check->diagnostics, design->name.text, design->name.span);
    if (before)
        twice(check, design->name.span, before->design->name.span, "the design", design->name.text,
              "give one of them another name");
    take_base(check, solids);
    take_settings(check);
    take_base_boxes(check);
    take_items(check);
    count_boxes(check);
    TN_CHAIN(solids, solid);
}

bool tn_check_solids(tn_arena *arena, tn_diagnostics *diagnostics, const tn_imports *imports, tn_checked_solids *solids)
{
    tn_solid_check check = {.arena = arena, .diagnostics = diagnostics};
    size_t errors = diagnostics->error_count;
    bool damaged = false;
    *solids = (tn_checked_solids){0};
    for (size_t u = 0; u < imports->count; u++) {
        const tn_solid_file *file = imports->units[u]->tree;
        damaged |= file->damaged;
        check.damaged = damaged;
        for (const tn_solid_design *design = file->first; design; design = design->next)
            take_design(&check, solids, design, u + 1 < imports->count);
    }
    if (!solids->first && !damaged && diagnostics->error_count == errors) {
        tn_span whole = {imports->units[imports->count - 1]->file, 0, 0};
        tn_diagnostic *d = tn_report(diagnostics, E_SOLID_EMPTY, whole, "this file has no design");
        tn_help(diagnostics, d, "write one: `solid slab { box all from (0, 0, 0) to (4, 1, 2); }`");
    }
    return !damaged && diagnostics->error_count == errors && !tn_arena_failed(arena);
}
