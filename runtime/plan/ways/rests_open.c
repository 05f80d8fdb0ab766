/* What each symbol begins with, in all its ways. No way leads through the same symbol again without a tray. */
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/plan/ways/rests_data.h"

enum { OPEN_DEEP = 20000 }; /* symbols that begin with one another */

typedef struct opening {
    tn_rests *r;
    uint32_t ahead;
    bool start;
    tn_rest_list *to;
} opening;

/* A prefix with symbols behind it. */
static tn_status append(tn_rests *r, uint32_t prefix, const uint32_t *symbols, size_t count, uint32_t *out,
                        tn_error *error)
{
    tn_key key = {0};
    size_t size;
    const uint32_t *words = tn_interned(&r->prefixes, prefix, &size);
    bool ok = tn_key_copy(&key, words, size);
    for (size_t i = 0; ok && i < count; i++)
        ok = tn_key_push(&key, symbols[i]);
    tn_status status = ok ? tn_rests_number(r, &r->prefixes, key.data, key.size, out, error) : tn_fail_memory(error);
    free(key.data);
    return status;
}

/* Adds all that a list has, so often, with symbols behind each. */
static tn_status add_behind(opening *o, const tn_rest_list *list, const uint32_t *symbols, size_t count,
                            const mpz_t times, tn_error *error)
{
    tn_status status = TN_OK;
    mpz_t ways;
    mpz_init(ways);
    for (uint32_t i = 0; status == TN_OK && i < list->count; i++) {
        uint32_t prefix;
        status = append(o->r, list->rests[i], symbols, count, &prefix, error);
        mpz_mul(ways, list->ways[i], times);
        if (status == TN_OK)
            status = tn_rest_list_add(o->to, prefix, ways, error);
    }
    mpz_clear(ways);
    return status;
}

static tn_status add_with(opening *o, const tn_rest_list *list, const symbol *behind, tn_error *error)
{
    uint32_t number = 0;
    mpz_t one;
    tn_status status = behind ? tn_rests_symbol(o->r, *behind, &number, error) : TN_OK;
    mpz_init_set_ui(one, 1);
    if (status == TN_OK)
        status = add_behind(o, list, &number, behind != NULL, one, error);
    mpz_clear(one);
    return status;
}

static tn_status open_symbol(opening *o, symbol of, const tn_rest_list **list, tn_error *error)
{
    return tn_rests_open(o->r, of, o->ahead, o->start, list, error);
}

static tn_status open_node(opening *o, uint32_t node, uint32_t side, const tn_rest_list **list, tn_error *error)
{
    return open_symbol(o, (symbol){SYMBOL_NODE, node, side, 0, 0}, list, error);
}

static tn_status add_node(opening *o, uint32_t node, uint32_t side, tn_error *error)
{
    const tn_rest_list *list;
    tn_status status = open_node(o, node, side, &list, error);
    return status == TN_OK ? add_with(o, list, NULL, error) : status;
}

/* ---- facts and pairs */

static tn_status add_one(opening *o, symbol only, tn_error *error)
{
    uint32_t number, prefix;
    mpz_t one;
    mpz_init_set_ui(one, 1);
    tn_status status = tn_rests_symbol(o->r, only, &number, error);
    if (status == TN_OK)
        status = tn_rests_number(o->r, &o->r->prefixes, &number, 1, &prefix, error);
    if (status == TN_OK)
        status = tn_rest_list_add(o->to, prefix, one, error);
    mpz_clear(one);
    return status;
}

static tn_status open_fact(opening *o, uint32_t node, uint32_t side, tn_error *error)
{
    tn_rests *r = o->r;
    size_t size;
    uint32_t number = r->fact_of[node * TN_SIDES + side];
    const fact *f = &r->facts[number];
    uint32_t before = f->ahead == UINT32_MAX ? 0 : tn_interned(&r->aheads, o->ahead, &size)[f->ahead];
    uint32_t state = tn_operand_mark(&f->of, before);
    if (state == f->of.dead || f->least[state] >= NEVER)
        return TN_OK;
    return add_one(o, (symbol){SYMBOL_FACT, number, state, 0, 0}, error);
}

/* A prefix as a stack of its own. */
static tn_status stack_of(tn_rests *r, uint32_t prefix, uint32_t *stack, tn_error *error)
{
    size_t size;
    tn_interned(&r->prefixes, prefix, &size);
    tn_status status = TN_OK;
    *stack = 0;
    for (size_t i = size; status == TN_OK && i-- > 0;)
        status = tn_rests_push(r, tn_interned(&r->prefixes, prefix, &size)[i], *stack, stack, error);
    return status;
}

/* The pairs of what two lists have. */
static tn_status pair_lists(tn_rests *r, const tn_rest_list *a, const tn_rest_list *b, tn_rest_list *out,
                            tn_error *error)
{
    tn_status status = TN_OK;
    mpz_t ways;
    mpz_init(ways);
    for (uint32_t i = 0; status == TN_OK && i < a->count; i++)
        for (uint32_t k = 0; status == TN_OK && k < b->count; k++) {
            uint32_t first, second, number, prefix;
            status = stack_of(r, a->rests[i], &first, error);
            if (status == TN_OK)
                status = stack_of(r, b->rests[k], &second, error);
            if (status == TN_OK)
                status = tn_rests_symbol(r, (symbol){SYMBOL_PAIR, first, second, 0, 0}, &number, error);
            if (status == TN_OK)
                status = tn_rests_number(r, &r->prefixes, &number, 1, &prefix, error);
            mpz_mul(ways, a->ways[i], b->ways[k]);
            if (status == TN_OK)
                status = tn_rest_list_add(out, prefix, ways, error);
        }
    mpz_clear(ways);
    return status;
}

static tn_status open_and(opening *o, const tn_derived *node, uint32_t side, tn_error *error)
{
    tn_rest_list all = {0};
    const tn_rest_list *list;
    tn_status status = open_node(o, node->first, side, &list, error);
    for (uint32_t part = o->r->derivation->nodes[node->first].next; status == TN_OK && part != TN_NOT_DERIVED;
         part = o->r->derivation->nodes[part].next) {
        const tn_rest_list *next;
        tn_rest_list both = {0};
        status = open_node(o, part, side, &next, error);
        if (status == TN_OK)
            status = pair_lists(o->r, list, next, &both, error);
        tn_rest_list_clear(&all);
        all = both;
        list = &all;
    }
    if (status == TN_OK)
        status = add_with(o, list, NULL, error);
    tn_rest_list_clear(&all);
    return status;
}

/* ---- neighbours and repeats */

static tn_status open_more(opening *o, uint32_t index, uint32_t side, uint32_t from, tn_error *error)
{
    const tn_derivation *d = o->r->derivation;
    const tn_derived *node = &d->nodes[index];
    const symbol tied = {.kind = SYMBOL_TIED};
    tn_status status = TN_OK;
    for (uint32_t k = from; status == TN_OK && k < node->count; k++) {
        uint32_t part = tn_rests_part(o->r, index, side, k);
        const symbol more = {SYMBOL_MORE, index, side, k + 1, 0};
        const tn_rest_list *list;
        status = open_node(o, part, side, &list, error);
        if (status == TN_OK && k + 1 < node->count)
            status = add_with(o, list, &more, error);
        if (status == TN_OK && tn_rests_may_end(o->r, index, side, k + 1))
            status = add_with(o, list, tn_tied_end(node, side) ? &tied : NULL, error);
        if (!d->nodes[part].optional)
            break;
    }
    return status;
}

static tn_status open_times(opening *o, uint32_t index, uint32_t side, uint32_t done, tn_error *error)
{
    const tn_derived *node = &o->r->derivation->nodes[index];
    const tn_rest_list *list;
    uint32_t after = node->most == 0 && done >= node->least ? done : done + 1;
    const symbol more = {SYMBOL_TIMES, index, side, after, 0};
    tn_status status = open_node(o, node->first, side, &list, error);
    if (status == TN_OK && (node->most == 0 || after < node->most))
        status = add_with(o, list, &more, error);
    if (status == TN_OK && after >= node->least)
        status = add_with(o, list, NULL, error);
    return status;
}

/* ---- rules that use themselves at their left end */

static const side_of_rule *side_of(const tn_rests *r, uint32_t rule, uint32_t side)
{
    return &r->rules[rule * TN_SIDES + side];
}

static bool is_tied(const tn_rests *r, const corner *c)
{
    return c->count > 0 && tn_rests_symbol_of(r, r->behind[c->first]).kind == SYMBOL_TIED;
}

/* The rules of a group, one after another. */
static uint32_t next_of_group(const tn_rests *r, uint32_t rule, uint32_t side, uint32_t group)
{
    while (rule < r->derivation->rule_count && side_of(r, rule, side)->group != group)
        rule++;
    return rule;
}

/* In how many ways a rule that is there is its goal as it stands, by rules that take no tray more; tied: at the plan's
 * end. */
static tn_status count_stops(const tn_rests *r, const symbol *have, uint32_t deep, mpz_t plain, mpz_t tied,
                             tn_error *error)
{
    uint32_t group = side_of(r, have->k, have->side)->group;
    tn_status status = TN_OK;
    mpz_t more, more_tied;
    if (deep > r->derivation->rule_count)
        return tn_fail(error, TN_INVALID, E_REFUSED_MODULE, "a rule uses itself, and no tray lies between");
    mpz_inits(more, more_tied, NULL);
    mpz_set_ui(plain, have->of == have->k);
    mpz_set_ui(tied, 0);
    for (uint32_t rule = next_of_group(r, 0, have->side, group); rule < r->derivation->rule_count;
         rule = next_of_group(r, rule + 1, have->side, group))
        for (uint32_t i = 0; status == TN_OK && i < side_of(r, rule, have->side)->count; i++) {
            const corner *c = &side_of(r, rule, have->side)->corners[i];
            if (c->rule != have->of || (c->start && !have->start) || (c->count > 0 && !is_tied(r, c)))
                continue;
            const symbol next = {SYMBOL_HAVE, rule, have->side, have->k, have->start};
            bool only_tied = c->count > 0;
            for (uint32_t k = 0; k < c->count; k++)
                only_tied &= tn_rests_symbol_of(r, r->behind[c->first + k]).kind == SYMBOL_TIED;
            if (c->count > 0 && !only_tied) /* what has to take trays behind the plan's end */
                continue;
            status = count_stops(r, &next, deep + 1, more, more_tied, error);
            mpz_add(only_tied ? tied : plain, only_tied ? tied : plain, more);
            mpz_add(tied, tied, more_tied);
        }
    mpz_clears(more, more_tied, NULL);
    return status;
}

/* Adds what a list has, with symbols behind it, and then what can be done if the rule is there: stop, or go on. */
static tn_status add_having(opening *o, const tn_rest_list *list, const uint32_t *symbols, size_t count,
                            const symbol *have, tn_error *error)
{
    mpz_t plain, tied;
    mpz_inits(plain, tied, NULL);
    uint32_t *all = malloc((count + 1) * sizeof *all);
    for (size_t i = 0; all && i < count; i++)
        all[i] = symbols[i];
    tn_status status = all ? count_stops(o->r, have, 0, plain, tied, error) : tn_fail_memory(error);
    if (status == TN_OK && mpz_sgn(plain) > 0)
        status = add_behind(o, list, all, count, plain, error);
    if (status == TN_OK && mpz_sgn(tied) > 0) {
        status = tn_rests_symbol(o->r, (symbol){.kind = SYMBOL_TIED}, &all[count], error);
        if (status == TN_OK)
            status = add_behind(o, list, all, count + 1, tied, error);
    }
    mpz_set_ui(plain, 1);
    if (status == TN_OK)
        status = tn_rests_symbol(o->r, *have, &all[count], error);
    if (status == TN_OK)
        status = add_behind(o, list, all, count + 1, plain, error);
    free(all);
    mpz_clears(plain, tied, NULL);
    return status;
}

/* A rule that uses itself at its left end: what stands there at last, and then the rules around it, from the inside
 * out. */
static tn_status open_goal(opening *o, uint32_t goal, uint32_t side, tn_error *error)
{
    tn_rests *r = o->r;
    uint32_t group = side_of(r, goal, side)->group;
    tn_status status = TN_OK;
    for (uint32_t rule = next_of_group(r, 0, side, group); rule < r->derivation->rule_count;
         rule = next_of_group(r, rule + 1, side, group))
        for (uint32_t i = 0; status == TN_OK && i < side_of(r, rule, side)->count; i++) {
            const corner *c = &side_of(r, rule, side)->corners[i];
            const symbol have = {SYMBOL_HAVE, rule, side, goal, o->start};
            const tn_rest_list *list;
            if (c->rule != TN_NOT_DERIVED || (c->start && !o->start))
                continue;
            status = open_node(o, c->node, side, &list, error);
            if (status == TN_OK)
                status = add_having(o, list, r->behind + c->first, c->count, &have, error);
        }
    return status;
}

/* What stands behind a rule that is there, in the rules at whose left end it stands. */
static tn_status open_have(opening *o, const symbol *have, tn_error *error)
{
    tn_rests *r = o->r;
    uint32_t group = side_of(r, have->k, have->side)->group;
    tn_status status = TN_OK;
    for (uint32_t rule = next_of_group(r, 0, have->side, group); rule < r->derivation->rule_count;
         rule = next_of_group(r, rule + 1, have->side, group))
        for (uint32_t i = 0; status == TN_OK && i < side_of(r, rule, have->side)->count; i++) {
            const corner *c = &side_of(r, rule, have->side)->corners[i];
            const symbol next = {SYMBOL_HAVE, rule, have->side, have->k, have->start};
            const tn_rest_list *list;
            if (c->rule != have->of || (c->start && !have->start) || is_tied(r, c))
                continue;
            status = open_symbol(o, c->count > 0 ? tn_rests_symbol_of(r, r->behind[c->first]) : next, &list, error);
            if (status == TN_OK && c->count == 0)
                status = add_with(o, list, NULL, error);
            else if (status == TN_OK)
                status = add_having(o, list, r->behind + c->first + 1, c->count - 1, &next, error);
        }
    return status;
}

/* ---- all symbols */

static tn_status open_rule(opening *o, uint32_t rule, uint32_t side, tn_error *error)
{
    if (side_of(o->r, rule, side)->group > 0)
        return open_goal(o, rule, side, error);
    return add_node(o, o->r->derivation->rules[rule].first, side, error);
}

static tn_status open_derived(opening *o, uint32_t index, uint32_t side, tn_error *error)
{
    const tn_derivation *d = o->r->derivation;
    const tn_derived *node = &d->nodes[index];
    tn_status status = TN_OK;
    switch (node->kind) {
    case TN_DERIVED_FACT:
        return open_fact(o, index, side, error);
    case TN_DERIVED_CALL:
        return open_rule(o, node->rule, side, error);
    case TN_DERIVED_OR:
        for (uint32_t part = node->first; status == TN_OK && part != TN_NOT_DERIVED; part = d->nodes[part].next)
            status = add_node(o, part, side, error);
        return status;
    case TN_DERIVED_AND:
        return open_and(o, node, side, error);
    case TN_DERIVED_NEIGHBOUR:
        return tn_tied_start(node, side) && !o->start ? TN_OK : open_more(o, index, side, 0, error);
    case TN_DERIVED_REPEAT:
        return open_times(o, index, side, 0, error);
    default: /* symmetric */
        status = open_rule(o, node->rule, side, error);
        return status == TN_OK ? open_rule(o, node->rule, !side, error) : status;
    }
}

static tn_status open_it(opening *o, const symbol *of, tn_error *error)
{
    switch (of->kind) {
    case SYMBOL_NODE:
        return open_derived(o, of->of, of->side, error);
    case SYMBOL_MORE:
        return open_more(o, of->of, of->side, of->k, error);
    case SYMBOL_TIMES:
        return open_times(o, of->of, of->side, of->k, error);
    case SYMBOL_HAVE:
        return open_have(o, of, error);
    default:
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a symbol that is open already");
    }
}

/* What is being opened is not opened inside: that would be without a tray. */
static tn_status make(tn_rests *r, const symbol *of, uint32_t ahead, bool start, opened *made, tn_error *error)
{
    opening o = {r, ahead, start, &made->list};
    if (r->deep >= OPEN_DEEP)
        return tn_fail(error, TN_LIMIT, E_TOO_MANY_STATES, "rules name each other more than %d deep", (int)OPEN_DEEP);
    r->deep++;
    tn_status status = open_it(&o, of, error);
    r->deep--;
    made->made = status == TN_OK;
    return status;
}

tn_status tn_rests_open(tn_rests *r, symbol of, uint32_t ahead, bool start, const tn_rest_list **list, tn_error *error)
{
    start = start && r->tied;
    const uint32_t words[] = {(uint32_t)of.kind, of.of, of.side, of.k, of.start, ahead, start};
    uint32_t number;
    tn_status status = tn_rests_number(r, &r->asked, words, sizeof words / sizeof *words, &number, error);
    if (status != TN_OK)
        return status;
    if (number == r->opened_count) {
        if (!tn_array_reserve(&r->opened, &r->opened_room, number, 1, sizeof *r->opened))
            return tn_fail_memory(error);
        r->opened[number] = calloc(1, sizeof(opened));
        r->opened_count++;
        if (!r->opened[number])
            return tn_fail_memory(error);
        opened *made = r->opened[number];
        status = make(r, &of, ahead, start, made, error);
    } else if (!r->opened[number]->made) {
        return tn_fail(error, TN_INVALID, E_REFUSED_MODULE, "a rule uses itself, and no tray lies between");
    }
    *list = &r->opened[number]->list;
    return status;
}
