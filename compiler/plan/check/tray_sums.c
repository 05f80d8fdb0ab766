/* Items of specifiers that compare sums, `tray(width > 2 * body depth)`: which these are, what they say, and the trays
 * that meet them.
 *
 * The words of an item are read here and not by the parser: whether `a < b` compares two numbers or asks for a value is
 * a matter of the schema. */
#include <stdlib.h>
#include <string.h>

#include "compiler/plan/check/amount.h"
#include "runtime/base/array.h"
#include "runtime/choices/sums.h"

enum {
    COMBINATIONS_MAX = 1 << 18, /* of values that one comparison goes through: a second or less */
    NUMBER_MAX = 1 << 10        /* of values that tell a number: then it is a term, whatever its cases */
};

/* ---- which items these are */

static bool is_constant_word(const tn_ast_word *word)
{
    return word->kind == TN_WORD_NUMBER || word->kind == TN_WORD_LENGTH || word->kind == TN_WORD_DECIMAL ||
           word->kind == TN_WORD_AREA;
}

/* Is the word a number that a tray has: a length, a depth, a place in an order, a `number`? */
static bool is_figure(const tn_checked_schema *schema, const tn_ast_word *word)
{
    uint32_t f = word->kind == TN_WORD_NAME ? tn_field_find(schema, word->text) : TN_NONE;
    if (f == TN_NONE)
        return word->kind == TN_WORD_NAME && tn_schema_number(schema, word->text);
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
    bool number = left->kind == TN_WORD_NAME && f == TN_NONE && tn_schema_number(schema, left->text);
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
        return f != TN_NONE && schema->fields[f].ordered && !schema->fields[f].measured;
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
        constant->exact = r->schema->fields[f].values[v].number;
        constant->power = r->schema->fields[f].power;
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
        if (figure->place)
            mpq_set_str(out, schema->fields[figure->field].values[values[figure->field]].number, 10);
        else
            mpq_set_si(out, schema->fields[figure->field].values[values[figure->field]].length, 1);
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

/* ---- the trays that meet a comparison
 *
 * The difference of the sides is cut into terms of a few fields each: where `a + 2 * b <= c` is compared, what counts
 * of `a` and `b` is only what they add up to (runtime/choices/sums.h). */

typedef struct comparison {
    tn_check *check;
    tn_checked_schema *schema;
    tn_choice_diagram *choices;
    const tn_ast_expr *left, *right;
    tn_operator op;
    tn_span span;
    size_t cases[TN_FIELDS_MAX]; /* of each number of the schema: the case that counts; TN_NONE: not chosen yet */
    bool lost;                   /* reported */
} comparison;

/* ---- its terms */

typedef struct term {
    uint32_t fields[TN_FIELDS_MAX];
    tn_choice_term made;
    mpq_t *exact; /* its numbers, before all terms have one denominator */
} term;

typedef struct terms {
    comparison *c;
    term **items;
    size_t count, capacity, combinations; /* of all of them together */
    bool longer, no_memory;
} terms;

static bool next_values(const terms *all, const term *t, uint8_t *values)
{
    for (uint32_t i = t->made.field_count; i-- > 0;) {
        uint32_t f = t->fields[i];
        if (++values[f] < all->c->schema->fields[f].value_count)
            return true;
        values[f] = 0;
    }
    return false;
}

static bool size_term(terms *all, term *t, const tn_ast_expr *figure)
{
    bool depends[TN_FIELDS_MAX] = {0};
    size_t size = 1;
    tn_figure_fields(all->c->schema, figure, all->c->cases, depends);
    for (uint32_t f = 0; f < all->c->schema->field_count; f++) {
        if (!depends[f])
            continue;
        t->fields[t->made.field_count++] = f;
        size *= all->c->schema->fields[f].value_count;
        all->longer |= size > COMBINATIONS_MAX - all->combinations;
        if (all->longer)
            return false;
    }
    t->made.fields = t->fields;
    t->made.count = size;
    all->combinations += size;
    return true;
}

/* Its numbers are made one by one, so that what is cleared is what was made. */
static void fill_term(terms *all, term *t, const tn_ast_expr *figure, const mpq_t factor)
{
    static const tn_choice_outcome outcomes[] = {[TN_FIGURE_NONE] = TN_CHOICE_SILENT,
                                                 [TN_FIGURE_OVER_ZERO] = TN_CHOICE_UNDEFINED,
                                                 [TN_FIGURE_SAYS] = TN_CHOICE_SAYS};
    uint8_t values[TN_FIELDS_MAX] = {0};
    for (size_t i = 0; i < t->made.count; i++, next_values(all, t, values)) {
        mpq_init(t->exact[i]);
        mpz_init(t->made.values[i]);
        tn_figure_value value = tn_figure_compute(all->c->schema, figure, all->c->cases, values, t->exact[i]);
        t->made.outcomes[i] = (uint8_t)outcomes[value];
        if (value == TN_FIGURE_SAYS)
            mpq_mul(t->exact[i], t->exact[i], factor);
        else
            mpq_set_si(t->exact[i], 0, 1);
    }
}

static void clear_term(term *t)
{
    for (size_t i = 0; t && t->exact && t->made.values && t->made.outcomes && i < t->made.count; i++) {
        mpq_clear(t->exact[i]);
        mpz_clear(t->made.values[i]);
    }
    if (t) {
        free(t->exact);
        free(t->made.values);
        free(t->made.outcomes);
    }
    free(t);
}

static void add_term(terms *all, const tn_ast_expr *figure, const mpq_t factor)
{
    term *t = all->longer || all->no_memory ? NULL : calloc(1, sizeof *t);
    bool good = t && size_term(all, t, figure);
    if (good) {
        t->exact = malloc(t->made.count * sizeof *t->exact);
        t->made.values = malloc(t->made.count * sizeof *t->made.values);
        t->made.outcomes = malloc(t->made.count);
        good = t->exact && t->made.values && t->made.outcomes &&
               tn_array_reserve(&all->items, &all->capacity, all->count, 1, sizeof *all->items);
        if (!good)
            t->made.count = 0;
    }
    all->no_memory |= !good && !all->longer;
    if (!good) {
        clear_term(t);
        return;
    }
    fill_term(all, t, figure, factor);
    all->items[all->count++] = t;
}

/* What the figure comes to whatever the tray is. false: it depends on the tray, or has no number. */
static bool is_constant(const terms *all, const tn_ast_expr *figure, mpq_t number)
{
    bool depends[TN_FIELDS_MAX] = {0};
    const uint8_t none[TN_FIELDS_MAX] = {0};
    tn_figure_fields(all->c->schema, figure, all->c->cases, depends);
    for (uint32_t f = 0; f < all->c->schema->field_count; f++)
        if (depends[f])
            return false;
    return tn_figure_compute(all->c->schema, figure, all->c->cases, none, number) == TN_FIGURE_SAYS;
}

static void add_terms(terms *all, const tn_ast_expr *figure, const mpq_t factor);

/* A product with a constant, or a quotient by one: what the other factor has terms of. false: neither. */
static bool add_scaled(terms *all, const tn_ast_expr *figure, const mpq_t factor)
{
    const tn_ast_expr *left = (const tn_ast_expr *)figure->parts.first,
                      *right = (const tn_ast_expr *)figure->parts.last;
    bool over = figure->kind == TN_EXPR_OVER, found = true;
    mpq_t constant;
    mpq_init(constant);
    if (is_constant(all, right, constant) && !(over && mpq_sgn(constant) == 0)) {
        (over ? mpq_div : mpq_mul)(constant, factor, constant);
        add_terms(all, left, constant);
    } else if (!over && is_constant(all, left, constant)) {
        mpq_mul(constant, factor, constant);
        add_terms(all, right, constant);
    } else {
        found = false;
    }
    mpq_clear(constant);
    return found;
}

/* The number's case that was chosen; NULL: the figure is none, or it is open which counts. */
static const tn_ast_expr *chosen_case(const terms *all, const tn_ast_expr *figure)
{
    size_t i = 0, wanted = figure->number ? all->c->cases[figure->number - all->c->schema->numbers] : TN_NONE;
    for (TN_EACH(const tn_ast_number_case, one, figure->number ? figure->number->ast->cases : tn_ast_empty()))
        if (i++ == wanted)
            return one->sum;
    return NULL;
}

/* Adds the figure times the factor. Recursion is as deep as the parser lets sums nest, and numbers be made of others.
 */
static void add_terms(terms *all, const tn_ast_expr *figure, const mpq_t factor)
{
    bool minus = figure->kind == TN_EXPR_MINUS || figure->kind == TN_EXPR_NEGATIVE;
    const tn_ast_expr *of_case = figure->kind == TN_EXPR_FIGURE ? chosen_case(all, figure) : NULL;
    if (of_case) {
        add_terms(all, of_case, factor);
    } else if (figure->kind == TN_EXPR_PLUS || minus) {
        mpq_t last;
        mpq_init(last);
        (minus ? mpq_neg : mpq_set)(last, factor);
        if (figure->kind != TN_EXPR_NEGATIVE)
            add_terms(all, (const tn_ast_expr *)figure->parts.first, factor);
        add_terms(all, (const tn_ast_expr *)figure->parts.last, last);
        mpq_clear(last);
    } else if ((figure->kind != TN_EXPR_TIMES && figure->kind != TN_EXPR_OVER) || !add_scaled(all, figure, factor)) {
        add_term(all, figure, factor);
    }
}

/* Gives all numbers one denominator, and so makes them whole. */
static void make_whole(terms *all)
{
    mpz_t common, factor;
    mpz_init_set_ui(common, 1);
    mpz_init(factor);
    for (size_t t = 0; t < all->count; t++)
        for (size_t i = 0; i < all->items[t]->made.count; i++)
            mpz_lcm(common, common, mpq_denref(all->items[t]->exact[i]));
    for (size_t t = 0; t < all->count; t++)
        for (size_t i = 0; i < all->items[t]->made.count; i++) {
            mpq_t *exact = &all->items[t]->exact[i];
            mpz_divexact(factor, common, mpq_denref(*exact));
            mpz_mul(all->items[t]->made.values[i], mpq_numref(*exact), factor);
        }
    mpz_clears(common, factor, NULL);
}

/* ---- its trays */

static unsigned signs_of(tn_operator op)
{
    switch (op) {
    case TN_LESS:
        return TN_CHOICE_BELOW;
    case TN_AT_MOST:
        return TN_CHOICE_BELOW | TN_CHOICE_ZERO;
    case TN_EQUAL:
        return TN_CHOICE_ZERO;
    case TN_UNEQUAL:
        return TN_CHOICE_BELOW | TN_CHOICE_ABOVE;
    case TN_AT_LEAST:
        return TN_CHOICE_ZERO | TN_CHOICE_ABOVE;
    default:
        return TN_CHOICE_ABOVE;
    }
}

static void report_long(comparison *c)
{
    if (!c->lost) {
        tn_diagnostic *d =
            tn_report(c->check->diagnostics, E_TOO_MANY, c->span,
                      "this compares more than %d combinations of values that add up differently", COMBINATIONS_MAX);
        tn_help(c->check->diagnostics, d, "compare fewer fields at once, or fields of fewer values");
    }
    c->lost = true;
}

/* Of the terms, the sets. */
static tn_tray_set of_terms(terms *all)
{
    tn_tray_set set = {TN_CHOICE_LOST, TN_CHOICE_LOST};
    tn_choice_term *made = tn_array_new(all->count + 1, sizeof *made);
    all->no_memory |= !made;
    for (size_t t = 0; made && t < all->count; t++)
        made[t] = all->items[t]->made;
    if (made)
        tn_choices_by_sum(all->c->choices, made, all->count, signs_of(all->c->op), COMBINATIONS_MAX, &set.yes, &set.no,
                          &all->longer);
    free(made);
    return set;
}

/* All numbers of the schema that the sides name are small, or have the case that counts. */
static tn_tray_set compare_chosen(comparison *c)
{
    terms all = {.c = c};
    tn_tray_set set = {TN_CHOICE_LOST, TN_CHOICE_LOST};
    mpq_t one;
    mpq_init(one);
    mpq_set_si(one, 1, 1);
    add_terms(&all, c->left, one);
    mpq_neg(one, one);
    add_terms(&all, c->right, one);
    if (!all.longer && !all.no_memory) {
        make_whole(&all);
        set = of_terms(&all);
    }
    if (all.longer)
        report_long(c);
    c->check->out_of_memory |= all.no_memory;
    c->lost |= all.no_memory;
    for (size_t t = 0; t < all.count; t++)
        clear_term(all.items[t]);
    free(all.items);
    mpq_clear(one);
    return set;
}

/* Do so few values tell the number that all of them can be gone through? */
static bool is_few(const comparison *c, const tn_ast_expr *figure)
{
    bool depends[TN_FIELDS_MAX] = {0};
    size_t size = 1;
    tn_figure_fields(c->schema, figure, c->cases, depends);
    for (uint32_t f = 0; f < c->schema->field_count && size <= NUMBER_MAX; f++)
        size *= depends[f] ? c->schema->fields[f].value_count : 1;
    return size <= NUMBER_MAX;
}

/* A number in it that many values tell, and whose case is not chosen yet; NULL: there is none. */
static const tn_checked_number *open_number(const comparison *c, const tn_ast_expr *figure)
{
    const tn_checked_number *number = figure->kind == TN_EXPR_FIGURE ? figure->number : NULL;
    if (number && c->cases[number - c->schema->numbers] == TN_NONE)
        return is_few(c, figure) ? NULL : number;
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

/* The trays that meet a case of such a number are looked at apart, with what the case says: so the fields that tell the
 * cases apart are not gone through with all others. As many numbers are chosen one inside another as it has. */
static tn_tray_set compare(comparison *c)
{
    const tn_checked_number *number = open_number(c, c->left);
    number = number ? number : open_number(c, c->right);
    if (!number)
        return compare_chosen(c);
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
    *set = compare(&c);
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
    bool equal = r->word && is_constant_word(r->word) && !r->word->node.next && left->kind == TN_EXPR_FIGURE &&
                 tn_schema_number(schema, left->name->text); /* `load 3` */
    if (!equal && (!r->word || r->word->kind != TN_WORD_OPERATOR)) {
        bad_sum(r, r->word ? r->word->node.span : r->span, "nothing is compared here");
        return false;
    }
    tn_operator op = equal ? TN_EQUAL : take(r)->op;
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
