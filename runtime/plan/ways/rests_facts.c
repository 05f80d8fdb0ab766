/* The facts of derivations as automata, and how few trays can be derived. */
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/plan/ways/rests_data.h"

/* Does what lies before a stretch matter? */
static bool looks_ahead(const tn_dfa *dfa, uint32_t letters)
{
    for (uint32_t l = 0; l < letters; l++)
        if (tn_dfa_read(dfa, 0, l) != 0)
            return true;
    return false;
}

/* From each state between the markers: how many letters, one or more, to where the second marker may be. */
static void find_least(fact *f)
{
    const tn_dfa *dfa = f->dfa;
    bool changed = true;
    for (uint32_t s = 0; s < dfa->states; s++)
        f->least[s] = NEVER;
    while (changed) {
        changed = false;
        for (uint32_t s = 0; s < dfa->states; s++)
            for (uint32_t c = 0; f->of.phase[s] == 1 && c < dfa->columns; c++) {
                uint32_t next = tn_operand_read(&f->of, s, c);
                if (c == f->of.marker || next == f->of.dead)
                    continue;
                bool ends = tn_operand_mark(&f->of, next) != f->of.dead;
                uint32_t least = ends ? 1 : f->least[next] + 1;
                if (least < f->least[s]) {
                    f->least[s] = least;
                    changed = true;
                }
            }
    }
}

static tn_status add_fact(tn_rests *r, tn_dfa *dfa, uint32_t letters, uint32_t *number, tn_error *error)
{
    for (*number = 0; *number < r->fact_count; ++*number)
        if (tn_dfa_equal(r->facts[*number].dfa, dfa)) {
            tn_dfa_free(dfa);
            return TN_OK;
        }
    if (!tn_array_reserve(&r->facts, &r->fact_room, r->fact_count, 1, sizeof *r->facts)) {
        tn_dfa_free(dfa);
        return tn_fail_memory(error);
    }
    fact *made = &r->facts[r->fact_count++];
    *made = (fact){.dfa = dfa, .ahead = UINT32_MAX, .least = malloc(((size_t)dfa->states + 1) * sizeof *made->least)};
    tn_status status = made->least ? tn_operand_make(&made->of, dfa, error) : tn_fail_memory(error);
    if (status != TN_OK)
        return status;
    if (looks_ahead(dfa, letters))
        made->ahead = r->ahead_count++;
    find_least(made);
    return TN_OK;
}

/* The facts of a rule, on one side. */
static tn_status rule_facts(tn_rests *r, tn_lowering *lowering, uint32_t rule, uint32_t side, tn_error *error)
{
    const tn_derived_rule *of = &r->derivation->rules[rule];
    tn_status status = TN_OK;
    for (uint32_t n = of->first; status == TN_OK && n < of->end; n++) {
        const tn_derived *node = &r->derivation->nodes[n];
        tn_dfa *dfa = NULL;
        if (node->kind != TN_DERIVED_FACT)
            continue;
        status = tn_lower_term(lowering, of->function, node->code_begin, node->code_end, side == TN_SIDE_TURNED, &dfa,
                               error);
        if (status == TN_OK)
            status = add_fact(r, dfa, tn_lowering_classes(lowering)->count, &r->fact_of[n * TN_SIDES + side], error);
    }
    return status;
}

/* ---- how few trays */

static uint32_t add(uint32_t a, uint32_t b)
{
    return a + b < NEVER ? a + b : NEVER;
}

/* Of the fact on the sides on which it is asked, and wherever it stands. */
static uint32_t least_of_fact(const tn_rests *r, uint32_t node)
{
    uint32_t least = NEVER;
    for (uint32_t side = 0; side < TN_SIDES; side++) {
        uint32_t number = r->fact_of[node * TN_SIDES + side];
        if (number == UINT32_MAX)
            continue;
        const fact *f = &r->facts[number];
        uint32_t first = f->ahead == UINT32_MAX ? f->least[tn_operand_mark(&f->of, 0)] : 1;
        least = first < least ? first : least;
    }
    return least;
}

static uint32_t least_of_node(const tn_rests *r, uint32_t index)
{
    const tn_derivation *d = r->derivation;
    const tn_derived *node = &d->nodes[index];
    uint32_t sum = 0, low = NEVER, high = 0;
    if (node->kind == TN_DERIVED_FACT)
        return least_of_fact(r, index);
    if (node->kind == TN_DERIVED_CALL || node->kind == TN_DERIVED_SYMMETRIC)
        return r->least[d->rules[node->rule].first];
    for (uint32_t part = node->first; part != TN_NOT_DERIVED; part = d->nodes[part].next) {
        uint32_t least = r->least[part];
        low = least < low ? least : low;
        high = least > high ? least : high;
        sum = d->nodes[part].optional ? sum : add(sum, least);
    }
    if (node->kind == TN_DERIVED_AND)
        return high;
    if (node->kind == TN_DERIVED_REPEAT)
        return (uint64_t)low * node->least < NEVER ? low * node->least : NEVER;
    return node->kind == TN_DERIVED_NEIGHBOUR && sum > 0 ? sum : low;
}

static void find_least_trays(const tn_rests *r)
{
    bool changed = true;
    for (uint32_t n = 0; n < r->derivation->node_count; n++)
        r->least[n] = NEVER;
    while (changed) {
        changed = false;
        for (uint32_t n = r->derivation->node_count; n-- > 0;) {
            uint32_t least = least_of_node(r, n);
            changed |= least < r->least[n];
            r->least[n] = least < r->least[n] ? least : r->least[n];
        }
    }
}

tn_status tn_rests_facts(tn_rests *r, tn_lowering *lowering, tn_error *error)
{
    const tn_derivation *d = r->derivation;
    uint8_t *needed = calloc((size_t)d->rule_count * TN_SIDES + 1, 1);
    r->fact_of = malloc(((size_t)d->node_count * TN_SIDES + 1) * sizeof *r->fact_of);
    r->least = malloc(((size_t)d->node_count + 1) * sizeof *r->least);
    tn_status status = needed && r->fact_of && r->least ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < (size_t)d->node_count * TN_SIDES; i++)
        r->fact_of[i] = UINT32_MAX;
    if (status == TN_OK)
        tn_derivation_needed(d, needed);
    for (uint32_t rule = 0; status == TN_OK && rule < d->rule_count; rule++)
        for (uint32_t side = 0; status == TN_OK && side < TN_SIDES; side++)
            if (needed[rule * TN_SIDES + side])
                status = rule_facts(r, lowering, rule, side, error);
    if (status == TN_OK)
        find_least_trays(r);
    free(needed);
    return status;
}
