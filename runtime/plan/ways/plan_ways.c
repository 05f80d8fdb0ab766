/* A chart: for each node of a derivation, in how many ways each stretch of the plan is one, the shorter stretches
 * first.
 *
 * What is on the plan turned round is a chart of its own, in which places are counted from the plan's end.
 */
#include "runtime/plan/ways/plan_ways.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/plan/match/relation.h"

/* Numbers of one node on one side. A neighbour of n parts has n tables, one for each number of its first parts; a
 * repeat one for each number of times, and then the sum. The last table is the node's. */
typedef struct table {
    uint64_t *bits; /* of a fact */
    mpz_t *numbers; /* [tables][cells] */
    uint32_t tables;
} table;

typedef struct chart {
    const tn_derivation *derivation;
    tn_plan_vm *vm;
    size_t length, cells, words;
    uint8_t *needed; /* [rules][TN_SIDES] */
    table *tables;   /* [nodes][TN_SIDES] */
    mpz_t none, one, sum;
} chart;

static size_t cell(const chart *c, size_t i, size_t j)
{
    return i * (2 * c->length + 3 - i) / 2 + (j - i);
}

static table *table_of(const chart *c, uint32_t node, uint32_t side)
{
    return &c->tables[(size_t)node * TN_SIDES + side];
}

static mpz_ptr number(const chart *c, const table *t, uint32_t which, size_t i, size_t j)
{
    return t->numbers[which * c->cells + cell(c, i, j)];
}

/* In how many ways [i, j) is derived by the node, as far as that is known. */
static mpz_srcptr ways(const chart *c, uint32_t node, uint32_t side, size_t i, size_t j)
{
    const tn_derived *at = &c->derivation->nodes[node];
    while (at->kind == TN_DERIVED_CALL) { /* also a root may be a call */
        node = c->derivation->rules[at->rule].first;
        at = &c->derivation->nodes[node];
    }
    const table *t = table_of(c, node, side);
    if (at->kind == TN_DERIVED_FACT)
        return tn_relation_row_has(t->bits + i * c->words, j) ? c->one : c->none;
    return number(c, t, t->tables - 1, i, j);
}

/* ---- room */

/* A repeat is never of more stretches than there are trays. */
static uint32_t times(const chart *c, const tn_derived *node)
{
    uint32_t most = node->most == 0 ? node->least : node->most;
    return most < c->length ? most : (uint32_t)c->length;
}

static uint32_t tables_of(const chart *c, const tn_derived *node)
{
    switch (node->kind) {
    case TN_DERIVED_NEIGHBOUR:
        return node->count;
    case TN_DERIVED_REPEAT:
        return times(c, node) + 1;
    case TN_DERIVED_FACT:
    case TN_DERIVED_CALL:
        return 0;
    default:
        return 1;
    }
}

static tn_status too_much(const chart *c, tn_code code, const char *what, uint64_t limit, tn_error *error)
{
    tn_fail(error, TN_LIMIT, code, "counting the ways of a plan of %zu trays takes more than the limit of %llu %s",
            c->length, (unsigned long long)limit, what);
    tn_error_help(error, "leave out --ways, or ask about shorter plans");
    return TN_LIMIT;
}

static tn_status check_room(const chart *c, tn_error *error)
{
    uint64_t tables = 0, n = c->length + 1;
    for (uint32_t r = 0; r < c->derivation->rule_count; r++)
        for (uint32_t node = c->derivation->rules[r].first; node < c->derivation->rules[r].end; node++)
            for (uint32_t side = 0; side < TN_SIDES; side++)
                tables += c->needed[r * TN_SIDES + side] ? tables_of(c, &c->derivation->nodes[node]) : 0;
    if (tables > 0 && c->cells > TN_WAYS_MEMORY / sizeof(mpz_t) / tables)
        return too_much(c, E_MATCHING_MEMORY, "bytes", TN_WAYS_MEMORY, error);
    if (tables > 0 && n * n * n / 6 > TN_WAYS_WORK / tables)
        return too_much(c, E_MATCHING_WORK, "steps", TN_WAYS_WORK, error);
    return TN_OK;
}

static tn_status make_fact(const chart *c, const tn_derived *node, table *t, uint32_t side, tn_error *error)
{
    const uint64_t *relation = NULL;
    size_t words = 0;
    tn_status status =
        tn_plan_vm_term(c->vm, node->code_begin, node->code_end, side == TN_SIDE_TURNED, &relation, &words, error);
    if (status != TN_OK)
        return status;
    size_t size = (c->length + 1) * words;
    t->bits = malloc(size * sizeof *t->bits);
    if (!t->bits)
        return tn_fail_memory(error);
    memcpy(t->bits, relation, size * sizeof *t->bits);
    return TN_OK;
}

static tn_status make_table(chart *c, uint32_t node, uint32_t side, tn_error *error)
{
    const tn_derived *at = &c->derivation->nodes[node];
    table *t = table_of(c, node, side);
    if (at->kind == TN_DERIVED_FACT)
        return make_fact(c, at, t, side, error);
    uint32_t tables = tables_of(c, at);
    if (tables == 0)
        return TN_OK;
    t->numbers = tn_array_new((uint64_t)tables * c->cells, sizeof(mpz_t));
    if (!t->numbers)
        return tn_fail_memory(error);
    t->tables = tables;
    for (size_t i = 0; i < tables * c->cells; i++)
        mpz_init(t->numbers[i]);
    return TN_OK;
}

/* ---- one stretch */

/* The first parts up to this one make [i, j): the last of them alone, and what came before it. */
static void join_part(chart *c, const table *t, uint32_t which, uint32_t part, uint32_t side, size_t i, size_t j)
{
    const tn_derived *node = &c->derivation->nodes[part];
    if (which == 0) {
        mpz_set(c->sum, i < j ? ways(c, part, side, i, j) : c->none);
        if (node->optional && i == j)
            mpz_set_ui(c->sum, 1);
        return;
    }
    mpz_set_ui(c->sum, 0);
    if (node->optional)
        mpz_set(c->sum, number(c, t, which - 1, i, j));
    for (size_t cut = i; cut < j; cut++) {
        mpz_srcptr before = number(c, t, which - 1, i, cut);
        if (mpz_sgn(before) != 0)
            mpz_addmul(c->sum, before, ways(c, part, side, cut, j));
    }
}

/* Puts the sum into a table; has it changed? */
static bool put(const chart *c, const table *t, uint32_t which, size_t i, size_t j)
{
    mpz_ptr to = number(c, t, which, i, j);
    bool changed = mpz_cmp(to, c->sum) != 0;
    if (changed)
        mpz_set(to, c->sum);
    return changed;
}

static bool count_neighbour(chart *c, const tn_derived *node, const table *t, uint32_t side, size_t i, size_t j)
{
    bool changed = false;
    uint32_t which = 0;
    for (uint32_t part = node->first; part != TN_NOT_DERIVED; part = c->derivation->nodes[part].next, which++) {
        join_part(c, t, which, part, side, i, j);
        if (which + 1 == t->tables && ((node->beginning && i > 0) || (node->end && j < c->length)))
            mpz_set_ui(c->sum, 0);
        changed |= put(c, t, which, i, j);
    }
    return changed;
}

/* Adds the cuts of which the last part is one stretch, and what comes before it is in a table. */
static void add_cuts(chart *c, const table *t, uint32_t which, uint32_t part, uint32_t side, size_t i, size_t j)
{
    for (size_t cut = i + 1; cut < j; cut++) {
        mpz_srcptr before = number(c, t, which, i, cut);
        if (mpz_sgn(before) != 0)
            mpz_addmul(c->sum, before, ways(c, part, side, cut, j));
    }
}

static bool count_repeat(chart *c, const tn_derived *node, const table *t, uint32_t side, size_t i, size_t j)
{
    uint32_t last = t->tables - 1;
    bool changed = false;
    if (i == j || node->least > c->length)
        return false;
    for (uint32_t n = 0; n < last; n++) {
        mpz_set_ui(c->sum, 0);
        if (n == 0)
            mpz_set(c->sum, ways(c, node->first, side, i, j));
        else
            add_cuts(c, t, n - 1, node->first, side, i, j);
        changed |= put(c, t, n, i, j);
    }
    mpz_set_ui(c->sum, 0);
    for (uint32_t n = node->least - 1; n < last; n++)
        mpz_add(c->sum, c->sum, number(c, t, n, i, j));
    if (node->most == 0)
        add_cuts(c, t, last, node->first, side, i, j);
    return put(c, t, last, i, j) || changed;
}

static bool count_node(chart *c, uint32_t index, uint32_t side, size_t i, size_t j)
{
    const tn_derived *node = &c->derivation->nodes[index];
    const table *t = table_of(c, index, side);
    uint32_t root;
    switch (node->kind) {
    case TN_DERIVED_NEIGHBOUR:
        return count_neighbour(c, node, t, side, i, j);
    case TN_DERIVED_REPEAT:
        return count_repeat(c, node, t, side, i, j);
    case TN_DERIVED_SYMMETRIC:
        root = c->derivation->rules[node->rule].first;
        mpz_add(c->sum, ways(c, root, side, i, j), ways(c, root, !side, c->length - j, c->length - i));
        return put(c, t, 0, i, j);
    case TN_DERIVED_OR:
    case TN_DERIVED_AND:
        mpz_set_ui(c->sum, node->kind == TN_DERIVED_AND);
        for (uint32_t part = node->first; part != TN_NOT_DERIVED; part = c->derivation->nodes[part].next)
            (node->kind == TN_DERIVED_AND ? mpz_mul : mpz_add)(c->sum, c->sum, ways(c, part, side, i, j));
        return put(c, t, 0, i, j);
    default:
        return false;
    }
}

/* ---- all stretches */

static bool is_needed(const chart *c, uint32_t rule, uint32_t side)
{
    return c->needed[rule * TN_SIDES + side];
}

/* Each node of the rules on one stretch, children first; true if a number changed that another of them may ask for. */
static bool count_stretch(chart *c, const tn_derived_rule *rules, uint32_t side, size_t i, size_t j)
{
    bool changed = false;
    for (uint32_t r = rules->circle_first; r < rules->circle_end; r++)
        for (uint32_t n = c->derivation->rules[r].end; is_needed(c, r, side) && n-- > c->derivation->rules[r].first;)
            changed |= count_node(c, n, side, i, j);
    return changed && rules->circle;
}

static tn_status count_circle(chart *c, uint32_t rule, uint32_t side, tn_error *error)
{
    const tn_derived_rule *rules = &c->derivation->rules[rule];
    tn_status status = TN_OK;
    uint32_t size = rules->circle_end - rules->circle_first;
    for (uint32_t r = rules->circle_first; status == TN_OK && r < rules->circle_end; r++)
        for (uint32_t n = c->derivation->rules[r].first;
             status == TN_OK && is_needed(c, r, side) && n < c->derivation->rules[r].end; n++)
            status = make_table(c, n, side, error);
    for (size_t trays = 0; status == TN_OK && trays <= c->length; trays++) {
        for (size_t i = 0; status == TN_OK && i + trays <= c->length; i++) {
            uint32_t rounds = 0; /* in each of which the rules that take the same stretch as another one get on */
            while (rounds <= size + 1 && count_stretch(c, rules, side, i, i + trays))
                rounds++;
            if (rounds > size + 1)
                status = tn_fail(error, TN_INVALID, E_REFUSED_MODULE, "a rule uses itself, and no tray lies between");
        }
        if (status == TN_OK)
            status = tn_watch_check(c->derivation->module->watch, error);
    }
    return status;
}

static tn_status count_all(chart *c, tn_error *error)
{
    const tn_derivation *d = c->derivation;
    tn_status status = TN_OK;
    for (uint32_t r = 0; status == TN_OK && r < d->rule_count; r++)
        for (uint32_t side = 0; status == TN_OK && side < TN_SIDES; side++) {
            bool needed = false;
            for (uint32_t k = d->rules[r].circle_first; k < d->rules[r].circle_end; k++)
                needed |= is_needed(c, k, side);
            if (needed && r == d->rules[r].circle_first)
                status = count_circle(c, r, side, error);
        }
    return status;
}

static void clear(chart *c)
{
    for (size_t i = 0; c->tables && i < (size_t)c->derivation->node_count * TN_SIDES; i++) {
        for (size_t k = 0; c->tables[i].numbers && k < c->tables[i].tables * c->cells; k++)
            mpz_clear(c->tables[i].numbers[k]);
        free(c->tables[i].numbers);
        free(c->tables[i].bits);
    }
    free(c->tables);
    free(c->needed);
    mpz_clears(c->none, c->one, c->sum, NULL);
}

tn_status tn_plan_ways(const tn_derivation *derivation, tn_plan_vm *vm, const tn_tray *trays, size_t length,
                       mpz_t found, tn_error *error)
{
    tn_status status = tn_plan_vm_plan(vm, trays, length, error);
    if (status != TN_OK)
        return status;
    chart c = {.derivation = derivation,
               .vm = vm,
               .length = length,
               .cells = (length + 1) * (length + 2) / 2,
               .words = length / 64 + 1,
               .needed = calloc((size_t)derivation->rule_count * TN_SIDES + 1, 1),
               .tables = calloc((size_t)derivation->node_count * TN_SIDES + 1, sizeof(table))};
    mpz_inits(c.none, c.one, c.sum, NULL);
    mpz_set_ui(c.one, 1);
    if (!c.needed || !c.tables)
        status = tn_fail_memory(error);
    if (status == TN_OK) {
        tn_derivation_needed(derivation, c.needed);
        status = check_room(&c, error);
    }
    if (status == TN_OK)
        status = count_all(&c, error);
    if (status == TN_OK)
        mpz_set(found, ways(&c, derivation->rules[derivation->root].first, TN_SIDE_WRITTEN, 0, length));
    clear(&c);
    return status;
}
