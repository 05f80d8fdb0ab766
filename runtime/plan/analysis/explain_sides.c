/* What the two sides of a comparison of sums come to. A comparison is compiled to sums that are compared with 0, so its
 * sides are put together again: from the sums' terms, and from where its text has the operator. */
#include <string.h>

#include "runtime/module/code.h"
#include "runtime/plan/analysis/explain.h"
#include "runtime/plan/match/vm.h"

enum { SUMS_MAX = 8 };

/* The comparison, as it is in the code. */
typedef struct compared {
    const tn_module *module;
    tn_plan_vm *vm;
    uint32_t sums[SUMS_MAX]; /* SUM records, each once */
    uint32_t count;
    const char *text, *operator; /* as it is written; and its operator, in it */
    tn_error *error;
} compared;

static const tn_sum_record *sum_of(const compared *c, uint32_t i)
{
    return &c->module->SUM_records[c->sums[i]];
}

static const tn_term_record *term_of(const compared *c, const tn_sum_record *sum, uint32_t i)
{
    return &c->module->TERM_records[sum->term_first + i];
}

/* ---- the code */

/* Its sums; false if there is more to it than comparing them. */
static bool read_code(compared *c, const tn_part *part)
{
    for (uint32_t offset = part->code_begin; offset < part->code_end;) {
        tn_instruction op = tn_code_read(c->module->code, offset);
        bool compares = op.opcode == TN_OP_BELOW || op.opcode == TN_OP_ZERO || op.opcode == TN_OP_ABOVE;
        bool joins = op.opcode == TN_OP_NOT || op.opcode == TN_OP_AND || op.opcode == TN_OP_OR ||
                     op.opcode == TN_OP_SOMEWHERE || op.opcode == TN_OP_ONCE;
        uint32_t known = 0;
        if (!compares && !joins)
            return false;
        while (compares && known < c->count && c->sums[known] != (uint32_t)op.first)
            known++;
        if (compares && known == c->count) {
            if (c->count == SUMS_MAX)
                return false;
            c->sums[c->count++] = (uint32_t)op.first;
        }
        offset += op.length;
    }
    return c->count > 0;
}

static bool counts_alike(const tn_term_record *a, const tn_term_record *b)
{
    return a->kind == b->kind && a->part == b->part && a->tally == b->tally && a->other == b->other;
}

/* Do two sums differ in their constants only? */
static bool same_terms(const compared *c, const tn_sum_record *a, const tn_sum_record *b)
{
    bool same = a->term_count == b->term_count && a->power == b->power;
    for (uint32_t i = 0; same && i < a->term_count; i++)
        same = counts_alike(term_of(c, a, i), term_of(c, b, i)) &&
               strcmp(tn_text(c->module, term_of(c, a, i)->factor), tn_text(c->module, term_of(c, b, i)->factor)) == 0;
    return same;
}

/* ---- the text */

/* The operator outside parentheses; NULL: none is found. */
static const char *find_operator(const char *text)
{
    int open = 0;
    for (const char *at = text; *at; at++) {
        open += *at == '(';
        open -= *at == ')';
        if (open == 0 &&
            (*at == '<' || *at == '>' || *at == '=' || (*at == '!' && at[1] == '=') || strncmp(at, " in ", 4) == 0))
            return at;
    }
    return NULL;
}

static bool has_outside(const char *from, const char *to, const char *what)
{
    int open = 0;
    size_t size = strlen(what);
    for (const char *at = from; at < to; at++) {
        open += *at == '(';
        open -= *at == ')';
        if (open == 0 && strncmp(at, what, size) == 0)
            return true;
    }
    return false;
}

static bool is_word(char c)
{
    return c == '-' || c == '_' || (unsigned char)c >= 0x80 || (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') ||
           (c >= 'a' && c <= 'z');
}

/* Does a side count something: a call like `sum(...)`, `trays`, or a measure by its name? */
static bool counts(const compared *c, const char *from, const char *to)
{
    for (const char *at = from; at < to; at++) {
        size_t size = 0;
        if (*at == '(')
            return true;
        if (at > from && is_word(at[-1]))
            continue;
        while (at + size < to && is_word(at[size]))
            size++;
        if (size == 5 && strncmp(at, "trays", 5) == 0)
            return true;
        for (uint32_t i = 0; size > 0 && i < c->module->MEASURE_count; i++) {
            const char *name = tn_text(c->module, c->module->MEASURE_records[i].name);
            if (strlen(name) == size && strncmp(name, at, size) == 0)
                return true;
        }
    }
    return false;
}

/* Has a side numbers and their units alone, and no names? */
static bool is_plain(const char *from, const char *to)
{
    for (const char *at = from; at < to; at++)
        if (is_word(*at) && (*at < '0' || *at > '9') && *at != '-' && (at == from || !is_word(at[-1])))
            return false;
    return true;
}

/* Is a number added on that side, or taken away: one that is no factor? Then the sums have it on the other side, too.
 */
static bool has_constant(const char *from, const char *to)
{
    int open = 0;
    for (const char *at = from; at < to; at++) {
        const char *before = at, *behind = at;
        open += *at == '(';
        open -= *at == ')';
        if (open > 0 || *at < '0' || *at > '9' || (at > from && (is_word(at[-1]) || at[-1] == '.')))
            continue;
        while (before > from && before[-1] == ' ')
            before--;
        while (behind < to && (is_word(*behind) || *behind == '.'))
            behind++;
        while (behind < to && *behind == ' ')
            behind++;
        bool factor = (before > from && (before[-1] == '*' || before[-1] == '/')) || (behind < to && *behind == '*');
        if (!factor)
            return true;
    }
    return false;
}

/* ---- numbers */

static tn_status value_of(const compared *c, uint32_t i, mpq_t value, bool *has)
{
    return tn_plan_vm_value(c->vm, c->sums[i], value, has, c->error);
}

static void read_rational(const compared *c, tn_string text, mpq_t value)
{
    mpq_set_str(value, tn_text(c->module, text), 10);
    mpq_canonicalize(value);
}

/* The factor by which a sum has the terms of another, with its sign turned: `a - k * b` has k of b; false: it has not.
 */
static bool has_divisor(const compared *c, const tn_sum_record *sum, const tn_sum_record *divisor, mpq_t k)
{
    mpq_t one, other;
    bool good = divisor->term_count > 0 && sum->term_count > 0;
    mpq_inits(one, other, NULL);
    for (uint32_t d = 0; good && d < divisor->term_count; d++) {
        uint32_t s = 0;
        while (s < sum->term_count && !counts_alike(term_of(c, sum, s), term_of(c, divisor, d)))
            s++;
        good = s < sum->term_count;
        if (!good)
            break;
        read_rational(c, term_of(c, sum, s)->factor, one);
        read_rational(c, term_of(c, divisor, d)->factor, other);
        good = mpq_sgn(other) != 0;
        if (!good)
            break;
        mpq_div(one, one, other);
        mpq_neg(one, one);
        good = d == 0 || mpq_equal(one, k);
        mpq_set(k, one);
    }
    mpq_clears(one, other, NULL);
    return good;
}

static void add_right(tn_sides *sides, const mpq_t value)
{
    for (uint32_t i = 0; i < sides->right_count; i++)
        if (mpq_equal(sides->right[i], value))
            return;
    if (sides->right_count < TN_SIDES_MAX)
        mpq_set(sides->right[sides->right_count++], value);
}

/* `a / b >= k`: b by itself, and a - k * b. */
static tn_status find_share(const compared *c, tn_sides *sides)
{
    mpq_t k, dividend, divisor;
    bool has = true;
    tn_status status = TN_OK;
    mpq_inits(k, dividend, divisor, NULL);
    for (uint32_t d = 0; status == TN_OK && d < c->count && sides->right_count == 0; d++)
        for (uint32_t s = 0; status == TN_OK && s < c->count; s++) {
            if (s == d || same_terms(c, sum_of(c, s), sum_of(c, d)) || !has_divisor(c, sum_of(c, s), sum_of(c, d), k))
                continue;
            status = value_of(c, d, divisor, &has);
            if (status == TN_OK && has)
                status = value_of(c, s, dividend, &has);
            if (status != TN_OK || !has || mpq_sgn(divisor) == 0)
                continue;
            mpq_div(sides->left, dividend, divisor);
            mpq_add(sides->left, sides->left, k);
            sides->power = (int)sum_of(c, s)->power - (int)sum_of(c, d)->power;
            add_right(sides, k);
        }
    mpq_clears(k, dividend, divisor, NULL);
    return status;
}

/* `k <= a / b`: b, and k * b - a. */
static tn_status find_turned_share(const compared *c, tn_sides *sides)
{
    tn_status status = find_share(c, sides);
    if (status == TN_OK && sides->right_count == 1) {
        mpq_swap(sides->left, sides->right[0]);
        if (mpq_sgn(sides->left) < 0) {
            mpq_neg(sides->left, sides->left);
            mpq_neg(sides->right[0], sides->right[0]);
        }
    }
    return status;
}

/* Terms with a minus sign stand on the right, if both sides count something and neither takes anything away. */
static tn_status split_terms(const compared *c, tn_sides *sides, const mpq_t constant)
{
    const tn_sum_record *sum = sum_of(c, 0);
    bool has = true;
    tn_status status = tn_plan_vm_added(c->vm, c->sums[0], sides->left, sides->right[0], &has, c->error);
    if (status != TN_OK || !has)
        return status;
    mpq_neg(sides->right[0], sides->right[0]);
    if (mpq_sgn(constant) > 0)
        mpq_add(sides->left, sides->left, constant);
    else
        mpq_sub(sides->right[0], sides->right[0], constant);
    sides->power = (int)sum->power;
    sides->right_count = 1;
    return TN_OK;
}

/* A constant on one side: the left side is what is counted, or the other way round. */
static void split_constants(const compared *c, tn_sides *sides, const mpq_t value, bool left_counts)
{
    mpq_t constant;
    mpq_init(constant);
    for (uint32_t i = 0; i < c->count; i++) {
        read_rational(c, sum_of(c, i)->constant, constant);
        if (i == 0 && left_counts)
            mpq_sub(sides->left, value, constant);
        else if (i == 0)
            mpq_set(sides->left, constant);
        if (left_counts)
            mpq_neg(constant, constant);
        else
            mpq_sub(constant, constant, value);
        add_right(sides, constant);
    }
    mpq_clear(constant);
}

/* Where the right side begins. */
static const char *behind_operator(const compared *c)
{
    return c->operator+(*c->operator== ' ' ? strlen(" in ") : strspn(c->operator, "<>=!"));
}

/* Is a side a percentage alone? `50% * trays` is a number of trays. */
static bool is_percentage(const char *from, const char *to)
{
    return is_plain(from, to) && memchr(from, '%', (size_t)(to - from)) && !memchr(from, '*', (size_t)(to - from));
}

/* Where the sides cannot be told apart, how much more the left one is. */
static tn_status find_sums(const compared *c, tn_sides *sides)
{
    const char *end = c->text + strlen(c->text), *behind = behind_operator(c);
    bool left = counts(c, c->text, c->operator), right = counts(c, behind, end), has = true;
    bool added[] = {has_constant(c->text, c->operator), has_constant(c->operator, end)};
    bool plain[] = {is_plain(c->text, c->operator), is_plain(behind, end)};
    mpq_t value, constant;
    if (!left && !right && plain[0] != plain[1]) { /* a name that is known to the author alone counts */
        left = plain[1];
        right = plain[0];
    }
    for (uint32_t i = 1; i < c->count; i++)
        if (!same_terms(c, sum_of(c, 0), sum_of(c, i)))
            return TN_OK;
    mpq_inits(value, constant, NULL);
    read_rational(c, sum_of(c, 0)->constant, constant);
    tn_status status = value_of(c, 0, value, &has);
    sides->power = (int)sum_of(c, 0)->power;
    if (status == TN_OK && has && left && right && c->count == 1 && !has_outside(c->text, end, " - ") &&
        !(added[0] && added[1])) {
        status = split_terms(c, sides, constant);
    } else if (status == TN_OK && has && left != right && !added[left ? 0 : 1]) {
        split_constants(c, sides, value, left);
    } else if (status == TN_OK && has && c->count == 1) {
        mpq_set(sides->left, value);
        sides->difference = true;
    }
    mpq_clears(value, constant, NULL);
    return status;
}

tn_status tn_explain_sides(tn_plan_vm *vm, const tn_parts *parts, uint32_t part, tn_sides *sides, tn_error *error)
{
    char text[TN_PART_TEXT_MAX];
    compared c = {.module = parts->module, .vm = vm, .text = text, .error = error};
    tn_part_text(parts, part, text, sizeof text);
    c.operator= find_operator(text);
    if (!c.operator|| !read_code(&c, &parts->parts[part]))
        return TN_OK;
    const char *behind = behind_operator(&c), *end = text + strlen(text);
    sides->percent = is_percentage(text, c.operator) || is_percentage(behind, end);
    if (c.count > 1 && has_outside(text, c.operator, "/"))
        return find_share(&c, sides);
    if (c.count > 1 && has_outside(behind, end, "/"))
        return find_turned_share(&c, sides);
    return find_sums(&c, sides);
}

void tn_sides_init(tn_sides *sides)
{
    *sides = (tn_sides){0};
    mpq_init(sides->left);
    for (uint32_t i = 0; i < TN_SIDES_MAX; i++)
        mpq_init(sides->right[i]);
}

void tn_sides_clear(tn_sides *sides)
{
    mpq_clear(sides->left);
    for (uint32_t i = 0; i < TN_SIDES_MAX; i++)
        mpq_clear(sides->right[i]);
}
