/* Items of specifiers that compare sums, `tray(width > 2 * body depth)`: which these are, what they say, and the trays
 * that meet them.
 *
 * The words of an item are read here and not by the parser: whether `a < b` compares two numbers or asks for a value is
 * a matter of the schema. */
#include <string.h>

#include "compiler/plan/check/amount.h"

enum { COMBINATIONS_MAX = 1 << 18 }; /* of values that one comparison goes through: a second or less */

/* ---- which items these are */

static bool is_constant_word(const tn_ast_word *word)
{
    return word->kind == TN_WORD_NUMBER || word->kind == TN_WORD_LENGTH || word->kind == TN_WORD_DECIMAL ||
           word->kind == TN_WORD_AREA;
}

static bool is_number(const tn_checked_schema *schema, const char *name)
{
    for (uint32_t n = 0; n < schema->number_count; n++)
        if (strcmp(schema->numbers[n].name, name) == 0)
            return true;
    return false;
}

/* Is the word a number that a tray has: a length, a depth, a place in an order, a `number`? */
static bool is_figure(const tn_checked_schema *schema, const tn_ast_word *word)
{
    uint32_t f = word->kind == TN_WORD_NAME ? tn_field_find(schema, word->text) : TN_NONE;
    if (f == TN_NONE)
        return word->kind == TN_WORD_NAME && is_number(schema, word->text);
    const tn_checked_field *field = &schema->fields[f];
    return field->kind == TN_FIELD_LENGTH || field->kind == TN_FIELD_ZONE || field->ordered;
}

/* The field whose values have an order and that alone has this one; TN_NONE: there is no such, or there are several. */
static uint32_t order_of(const tn_checked_schema *schema, const char *value)
{
    uint32_t found = TN_NONE;
    for (uint32_t f = 0; f < schema->field_count; f++)
        if (tn_field_has(&schema->fields[f], value)) {
            if (found != TN_NONE || !schema->fields[f].ordered)
                return TN_NONE;
            found = f;
        }
    return found;
}

static bool has_sign(const tn_ast_item *item)
{
    for (TN_EACH(const tn_ast_alternative, alternative, item->alternatives))
        for (TN_EACH(const tn_ast_word, word, alternative->words))
            if (word->kind == TN_WORD_SIGN || (word->group && has_sign(word->group)))
                return true;
    return false;
}

static const tn_ast_word *after_nots(const tn_ast_alternative *alternative, bool *negated)
{
    const tn_ast_word *word = (const tn_ast_word *)alternative->words.first;
    for (*negated = false; word && word->kind == TN_WORD_NOT; word = (const tn_ast_word *)word->node.next)
        *negated = !*negated;
    return word;
}

static bool compares_sums(const tn_checked_schema *schema, const tn_ast_alternative *alternative, bool rule)
{
    bool negated;
    const tn_ast_word *left = after_nots(alternative, &negated), *op = left;
    if (!left || left->kind == TN_WORD_OPERATOR)
        return false;
    uint32_t f = left->kind == TN_WORD_NAME ? tn_field_find(schema, left->text) : TN_NONE;
    bool number = left->kind == TN_WORD_NAME && f == TN_NONE && is_number(schema, left->text);
    if (number && !rule)
        return true;
    while (op && op->kind != TN_WORD_OPERATOR)
        op = (const tn_ast_word *)op->node.next;
    const tn_ast_word *right = op ? (const tn_ast_word *)op->node.next : NULL;
    if (!right)
        return false;
    if (left->kind != TN_WORD_NAME)
        return is_constant_word(left) || left->kind == TN_WORD_GROUP;
    if (right->kind == TN_WORD_NUMBER)
        return f != TN_NONE && schema->fields[f].ordered;
    if (right->kind != TN_WORD_NAME || (f != TN_NONE && tn_field_has(&schema->fields[f], right->text)))
        return false;
    bool compared = number || is_figure(schema, left);
    return compared && (is_figure(schema, right) || order_of(schema, right->text) != TN_NONE);
}

bool tn_is_sum_item(const tn_checked_schema *schema, const tn_ast_item *item, bool rule)
{
    if (has_sign(item))
        return true;
    for (TN_EACH(const tn_ast_alternative, alternative, item->alternatives))
        if (compares_sums(schema, alternative, rule))
            return true;
    return false;
}

/* ---- reading */

typedef struct sum_reader {
    tn_check *check;
    const tn_checked_schema *schema;
    const tn_ast_word *word; /* the next; NULL at the end */
    tn_span span;            /* of all words */
    bool made;               /* some words are bound ones, which stand for values */
} sum_reader;

static tn_ast_expr *bad_sum(sum_reader *r, tn_span span, const char *message)
{
    tn_diagnostic *d = tn_report(r->check->diagnostics, E_BAD_ITEM, span, "%s", message);
    tn_help(r->check->diagnostics, d,
            "numbers of a tray are compared as in `width > 2 * depth + 1m`: fields of lengths, zones, places in an "
            "order, numbers of the schema, constants, and + - * / between them");
    return NULL;
}

static const tn_ast_word *take(sum_reader *r)
{
    const tn_ast_word *word = r->word;
    r->word = word ? (const tn_ast_word *)word->node.next : NULL;
    return word;
}

static bool at_sign(const sum_reader *r, const char *signs)
{
    return r->word && r->word->kind == TN_WORD_SIGN && strchr(signs, r->word->text[0]);
}

static tn_ast_expr *node(sum_reader *r, tn_expr_kind kind, tn_span span)
{
    tn_ast_expr *expr = TN_NEW(r->check->arena, tn_ast_expr);
    if (expr)
        *expr = (tn_ast_expr){.node.span = span, .kind = kind, .depth = 1};
    return expr;
}

static tn_ast_expr *joined(sum_reader *r, tn_expr_kind kind, tn_ast_expr *left, tn_ast_expr *right)
{
    tn_ast_expr *expr = left && right ? node(r, kind, tn_span_join(left->node.span, right->node.span)) : NULL;
    if (expr)
        expr->parts = tn_ast_append(tn_ast_one(left), right);
    return expr;
}

static tn_ast_expr *read_sum(sum_reader *r);

/* What a value stands for that a quantifier or an argument put there: its place in the order, or its depth. NULL: it is
 * none. */
static tn_ast_expr *bound_value(sum_reader *r, const tn_ast_word *word)
{
    uint32_t f = order_of(r->schema, word->text);
    tn_ast_word *constant = TN_NEW(r->check->arena, tn_ast_word);
    if (!constant)
        return NULL;
    *constant = (tn_ast_word){.node.span = word->node.span, .kind = TN_WORD_NUMBER, .text = word->text, .exact = "0"};
    if (f != TN_NONE) {
        uint32_t v = 0;
        while (strcmp(r->schema->fields[f].values[v].name, word->text) != 0)
            v++;
        char place[16];
        snprintf(place, sizeof place, "%u", (unsigned)v + 1);
        constant->exact = tn_arena_copy(r->check->arena, place, strlen(place));
    } else if (r->made && r->word && r->word->kind == TN_WORD_LENGTH) {
        *constant = *take(r);
        constant->node.next = NULL;
    } else {
        bool fill = false;
        for (uint32_t z = 0; z < r->schema->field_count; z++)
            fill |= r->schema->fields[z].kind == TN_FIELD_ZONE && tn_field_has(&r->schema->fields[z], word->text);
        if (!r->made || !fill)
            return NULL;
        constant->power = 1;
    }
    tn_ast_expr *expr = node(r, TN_EXPR_NUMBER, word->node.span);
    if (expr)
        expr->name = constant;
    return expr;
}

/* NAME or NAME depth, a constant, a sum in parentheses */
static tn_ast_expr *read_atom(sum_reader *r)
{
    const tn_ast_word *word = take(r);
    if (!word)
        return bad_sum(r, r->span, "a number is missing at the end of this comparison");
    if (is_constant_word(word)) {
        tn_ast_expr *expr = node(r, TN_EXPR_NUMBER, word->node.span);
        if (expr)
            expr->name = word;
        return expr;
    }
    if (word->kind == TN_WORD_GROUP && word->group->alternatives.count == 1) {
        const tn_ast_alternative *inside = (const tn_ast_alternative *)word->group->alternatives.first;
        sum_reader inner = *r;
        inner.word = (const tn_ast_word *)inside->words.first;
        inner.span = inside->node.span;
        tn_ast_expr *expr = read_sum(&inner);
        return expr && inner.word ? bad_sum(r, inner.word->node.span, "this does not belong to the sum") : expr;
    }
    if (word->kind != TN_WORD_NAME)
        return bad_sum(r, word->node.span, "a number has to stand here");
    tn_ast_expr *value = is_figure(r->schema, word) ? NULL : bound_value(r, word);
    if (value)
        return value;
    tn_ast_expr *expr = node(r, TN_EXPR_FIGURE, word->node.span);
    if (expr && r->word && r->word->kind == TN_WORD_NAME)
        expr->detail = take(r);
    if (expr)
        expr->name = word;
    return expr;
}

static tn_ast_expr *read_signed(sum_reader *r)
{
    tn_span span = r->word ? r->word->node.span : r->span;
    bool negative = false;
    for (; at_sign(r, "-"); take(r))
        negative = !negative;
    tn_ast_expr *part = read_atom(r);
    tn_ast_expr *expr = negative && part ? node(r, TN_EXPR_NEGATIVE, tn_span_join(span, part->node.span)) : NULL;
    if (expr)
        expr->parts = tn_ast_one(part);
    return negative ? expr : part;
}

static tn_ast_expr *read_term(sum_reader *r)
{
    tn_ast_expr *left = read_signed(r);
    while (left && at_sign(r, "*/")) {
        tn_expr_kind kind = take(r)->text[0] == '*' ? TN_EXPR_TIMES : TN_EXPR_OVER;
        left = joined(r, kind, left, read_signed(r));
    }
    return left;
}

static tn_ast_expr *read_sum(sum_reader *r)
{
    tn_ast_expr *left = read_term(r);
    while (left && at_sign(r, "+-")) {
        tn_expr_kind kind = take(r)->text[0] == '+' ? TN_EXPR_PLUS : TN_EXPR_MINUS;
        left = joined(r, kind, left, read_term(r));
    }
    return left;
}

/* ---- what a tray comes to */

static bool meets_any(const tn_checked_schema *schema, const tn_checked_trays *trays, const uint8_t *values)
{
    for (size_t i = 0; i < trays->count; i++)
        if (tn_check_meets(schema, trays->boxes[i], values))
            return true;
    return false;
}

static tn_figure_value compute_number(const tn_checked_schema *schema, const tn_checked_number *number,
                                      const size_t *cases, const uint8_t *values, mpq_t out)
{
    size_t i = 0, wanted = cases ? cases[number - schema->numbers] : TN_NONE;
    for (TN_EACH(const tn_ast_number_case, c, number->ast->cases)) {
        bool counts = wanted != TN_NONE ? i == wanted : meets_any(schema, &number->cases[i], values);
        i++;
        if (counts)
            return tn_figure_compute(schema, c->sum, cases, values, out);
    }
    return TN_FIGURE_NONE;
}

static tn_figure_value compute_two(const tn_checked_schema *schema, const tn_ast_expr *figure, const size_t *cases,
                                   const uint8_t *values, mpq_t out)
{
    mpq_t right;
    mpq_init(right);
    tn_figure_value outcome = tn_figure_compute(schema, (const tn_ast_expr *)figure->parts.first, cases, values, out);
    if (outcome == TN_FIGURE_SAYS)
        outcome = tn_figure_compute(schema, (const tn_ast_expr *)figure->parts.last, cases, values, right);
    bool good = outcome == TN_FIGURE_SAYS;
    if (good && figure->kind == TN_EXPR_OVER && mpq_sgn(right) == 0)
        outcome = TN_FIGURE_OVER_ZERO;
    else if (good && figure->kind == TN_EXPR_PLUS)
        mpq_add(out, out, right);
    else if (good && figure->kind == TN_EXPR_MINUS)
        mpq_sub(out, out, right);
    else if (good && figure->kind == TN_EXPR_TIMES)
        mpq_mul(out, out, right);
    else if (good && figure->kind == TN_EXPR_OVER)
        mpq_div(out, out, right);
    else if (good && (mpq_cmp(right, out) < 0) == (figure->kind == TN_EXPR_LEAST))
        mpq_set(out, right);
    mpq_clear(right);
    return outcome;
}

tn_figure_value tn_figure_compute(const tn_checked_schema *schema, const tn_ast_expr *figure, const size_t *cases,
                                  const uint8_t *values, mpq_t out)
{
    switch (figure->kind) {
    case TN_EXPR_NUMBER:
        mpq_set_str(out, figure->constant, 10);
        return TN_FIGURE_SAYS;
    case TN_EXPR_FIGURE:
        if (figure->number)
            return compute_number(schema, figure->number, cases, values, out);
        mpq_set_si(out,
                   figure->place ? values[figure->field] + 1
                                 : schema->fields[figure->field].values[values[figure->field]].length,
                   1);
        return TN_FIGURE_SAYS;
    case TN_EXPR_NEGATIVE: {
        tn_figure_value outcome =
            tn_figure_compute(schema, (const tn_ast_expr *)figure->parts.first, cases, values, out);
        mpq_neg(out, out);
        return outcome;
    }
    default:
        return compute_two(schema, figure, cases, values, out);
    }
}

/* The fields that say which case of a number a tray meets. */
static void fields_of_trays(const tn_checked_schema *schema, const tn_checked_trays *trays, bool *depends)
{
    for (size_t i = 0; i < trays->count; i++)
        for (uint32_t f = 0; f < schema->field_count; f++)
            for (uint32_t v = 0; v < schema->fields[f].value_count; v++) {
                uint32_t bit = schema->fields[f].first_bit + v;
                depends[f] |= !(trays->boxes[i]->mask[bit / 64] >> (bit % 64) & 1);
            }
}

void tn_figure_fields(const tn_checked_schema *schema, const tn_ast_expr *figure, const size_t *cases, bool *depends)
{
    for (TN_EACH(const tn_ast_expr, part, figure->parts))
        tn_figure_fields(schema, part, cases, depends);
    if (figure->kind != TN_EXPR_FIGURE)
        return;
    if (!figure->number) {
        depends[figure->field] = true;
        return;
    }
    size_t i = 0, wanted = cases ? cases[figure->number - schema->numbers] : TN_NONE;
    for (TN_EACH(const tn_ast_number_case, c, figure->number->ast->cases)) {
        if (wanted == TN_NONE)
            fields_of_trays(schema, &figure->number->cases[i], depends);
        if (wanted == TN_NONE || wanted == i)
            tn_figure_fields(schema, c->sum, cases, depends);
        i++;
    }
}

/* ---- the trays that meet a comparison */

typedef struct comparison {
    tn_check *check;
    tn_checked_schema *schema;
    tn_choice_diagram *choices;
    const tn_ast_expr *left, *right;
    tn_operator op;
    tn_span span;
    size_t cases[TN_FIELDS_MAX]; /* of each number of the schema: the case that counts; TN_NONE: not chosen yet */
    bool depends[TN_FIELDS_MAX];
    uint8_t values[TN_FIELDS_MAX];
    mpq_t a, b;
    bool lost; /* reported */
} comparison;

static bool holds(tn_operator op, int order)
{
    switch (op) {
    case TN_LESS:
        return order < 0;
    case TN_AT_MOST:
        return order <= 0;
    case TN_EQUAL:
        return order == 0;
    case TN_UNEQUAL:
        return order != 0;
    case TN_AT_LEAST:
        return order >= 0;
    default:
        return order > 0;
    }
}

static tn_tray_set of_values(comparison *c)
{
    tn_figure_value left = tn_figure_compute(c->schema, c->left, c->cases, c->values, c->a);
    tn_figure_value right =
        left == TN_FIGURE_SAYS ? tn_figure_compute(c->schema, c->right, c->cases, c->values, c->b) : left;
    if (right == TN_FIGURE_OVER_ZERO)
        return (tn_tray_set){TN_CHOICE_NONE, TN_CHOICE_NONE};
    bool met = right == TN_FIGURE_SAYS && holds(c->op, mpq_cmp(c->a, c->b));
    return (tn_tray_set){met ? TN_CHOICE_ALL : TN_CHOICE_NONE, met ? TN_CHOICE_NONE : TN_CHOICE_ALL};
}

/* Goes through the values of the fields that matter, from one field on. */
static tn_tray_set of_fields(comparison *c, uint32_t from)
{
    uint32_t f = from;
    while (f < c->schema->field_count && !c->depends[f])
        f++;
    if (f == c->schema->field_count)
        return of_values(c);
    tn_choice_set yes[TN_VALUES_MAX], no[TN_VALUES_MAX];
    for (uint32_t v = 0; v < c->schema->fields[f].value_count; v++) {
        c->values[f] = (uint8_t)v;
        tn_tray_set follow = of_fields(c, f + 1);
        yes[v] = follow.yes;
        no[v] = follow.no;
    }
    return (tn_tray_set){tn_choices_node(c->choices, f, yes), tn_choices_node(c->choices, f, no)};
}

static bool is_short(comparison *c)
{
    uint64_t combinations = 1;
    memset(c->depends, 0, sizeof c->depends);
    tn_figure_fields(c->schema, c->left, c->cases, c->depends);
    tn_figure_fields(c->schema, c->right, c->cases, c->depends);
    for (uint32_t f = 0; f < c->schema->field_count && combinations <= COMBINATIONS_MAX; f++)
        combinations *= c->depends[f] ? c->schema->fields[f].value_count : 1;
    if (combinations <= COMBINATIONS_MAX)
        return true;
    if (!c->lost) {
        tn_diagnostic *d = tn_report(c->check->diagnostics, E_TOO_MANY, c->span,
                                     "this compares more than %d combinations of values", COMBINATIONS_MAX);
        tn_help(c->check->diagnostics, d, "compare fewer fields at once, or fields of fewer values");
    }
    c->lost = true;
    return false;
}

/* A number in it whose case is not chosen yet; NULL: there is none. */
static const tn_checked_number *open_number(const comparison *c, const tn_ast_expr *figure)
{
    const tn_checked_number *number = figure->kind == TN_EXPR_FIGURE ? figure->number : NULL;
    if (number && c->cases[number - c->schema->numbers] == TN_NONE)
        return number;
    for (TN_EACH(const tn_ast_expr, part, figure->parts)) {
        number = open_number(c, part);
        if (number)
            return number;
    }
    return NULL;
}

static tn_choice_set of_boxes(comparison *c, const tn_checked_trays *trays)
{
    tn_choice_set all = TN_CHOICE_NONE;
    for (size_t i = 0; i < trays->count; i++)
        all = tn_choices_or(c->choices, all, tn_choices_box(c->choices, trays->boxes[i]->mask));
    return all;
}

/* The trays that meet a case of a number are looked at apart, with what the case says: so the fields that tell the
 * cases apart are not gone through with all others. As many numbers are chosen one inside another as it has. */
static tn_tray_set compare(comparison *c)
{
    const tn_checked_number *number = open_number(c, c->left);
    number = number ? number : open_number(c, c->right);
    if (!number)
        return is_short(c) ? of_fields(c, 0) : (tn_tray_set){TN_CHOICE_LOST, TN_CHOICE_LOST};
    tn_choice_set rest = TN_CHOICE_ALL;
    tn_tray_set all = {TN_CHOICE_NONE, TN_CHOICE_NONE};
    size_t *chosen = &c->cases[number - c->schema->numbers];
    for (size_t i = 0; i < number->ast->cases.count && !c->lost; i++) {
        tn_choice_set met = of_boxes(c, &number->cases[i]), these = tn_choices_and(c->choices, rest, met);
        *chosen = i;
        tn_tray_set here = compare(c);
        all.yes = tn_choices_or(c->choices, all.yes, tn_choices_and(c->choices, these, here.yes));
        all.no = tn_choices_or(c->choices, all.no, tn_choices_and(c->choices, these, here.no));
        rest = tn_choices_and(c->choices, rest, tn_choices_not(c->choices, met));
    }
    *chosen = TN_NONE;
    all.no = tn_choices_or(c->choices, all.no, rest);
    return all;
}

static bool check_sides(comparison *c, tn_ast_expr *left, tn_ast_expr *right)
{
    tn_sum_amount a, b, both;
    bool good = tn_check_figure(c->check, c->schema, left, &a);
    good &= tn_check_figure(c->check, c->schema, right, &b);
    if (!good || !tn_same_power(c->check, a, left->node.span, b, right->node.span, "compared with", &both))
        return false;
    return true;
}

static bool compare_sides(tn_check *check, tn_checked_schema *schema, tn_ast_expr *left, tn_operator op,
                          tn_ast_expr *right, tn_tray_set *set)
{
    comparison c = {.check = check,
                    .schema = schema,
                    .choices = tn_schema_choices(check, schema),
                    .left = left,
                    .right = right,
                    .op = op,
                    .span = tn_span_join(left->node.span, right->node.span)};
    if (!c.choices || !check_sides(&c, left, right))
        return false;
    for (uint32_t n = 0; n < schema->number_count; n++)
        c.cases[n] = TN_NONE;
    mpq_inits(c.a, c.b, NULL);
    *set = compare(&c);
    mpq_clears(c.a, c.b, NULL);
    return !c.lost;
}

/* ---- items */

/* SUM low..high */
static bool read_within(sum_reader *r, tn_checked_schema *schema, tn_ast_expr *sum, tn_tray_set *set)
{
    const tn_ast_word *range = take(r);
    tn_tray_set low, high;
    if (r->word) {
        bad_sum(r, r->word->node.span, "this does not belong to the range");
        return false;
    }
    tn_ast_expr *from = node(r, TN_EXPR_NUMBER, range->low->node.span),
                *to = node(r, TN_EXPR_NUMBER, range->high->node.span);
    if (!from || !to)
        return false;
    from->name = range->low;
    to->name = range->high;
    if (!is_constant_word(range->low) || !is_constant_word(range->high)) {
        bad_sum(r, range->node.span, "a range of numbers is missing");
        return false;
    }
    if (!compare_sides(r->check, schema, sum, TN_AT_LEAST, from, &low) ||
        !compare_sides(r->check, schema, sum, TN_AT_MOST, to, &high))
        return false;
    tn_choice_diagram *choices = schema->choices;
    *set = (tn_tray_set){tn_choices_and(choices, low.yes, high.yes), tn_choices_or(choices, low.no, high.no)};
    return true;
}

static bool read_comparison(sum_reader *r, tn_checked_schema *schema, tn_tray_set *set)
{
    tn_ast_expr *left = read_sum(r);
    if (!left)
        return false;
    if (r->word && r->word->kind == TN_WORD_RANGE)
        return read_within(r, schema, left, set);
    if (!r->word || r->word->kind != TN_WORD_OPERATOR) {
        bad_sum(r, r->word ? r->word->node.span : r->span, "nothing is compared here");
        return false;
    }
    tn_operator op = take(r)->op;
    tn_ast_expr *right = read_sum(r);
    if (!right)
        return false;
    if (r->word) {
        bad_sum(r, r->word->node.span,
                r->word->kind == TN_WORD_OPERATOR ? "one comparison is enough" : "this does not belong to the sum");
        return false;
    }
    return compare_sides(r->check, schema, left, op, right, set);
}

bool tn_check_sum_item(tn_check *check, tn_checked_schema *schema, const tn_ast_item *item, tn_tray_set *set)
{
    *set = (tn_tray_set){TN_CHOICE_NONE, TN_CHOICE_ALL};
    for (TN_EACH(const tn_ast_alternative, alternative, item->alternatives)) {
        bool negated;
        tn_tray_set one;
        sum_reader r = {.check = check,
                        .schema = schema,
                        .word = after_nots(alternative, &negated),
                        .span = alternative->node.span,
                        .made = item->made};
        if (!read_comparison(&r, schema, &one))
            return false;
        if (negated)
            one = (tn_tray_set){one.no, one.yes};
        set->yes = tn_choices_or(schema->choices, set->yes, one.yes);
        set->no = tn_choices_and(schema->choices, set->no, one.no);
    }
    return true;
}
