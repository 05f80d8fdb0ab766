/* Counts the words that two automata agree about, where the first has no cycle and holds words of the lengths asked
 * about only: its states are taken once each, in their order, in which edges only lead forward. So there is one number
 * for each pair of states, whatever the length of the words that lead there, and no pair is looked up. */
#include <stdlib.h>
#include <string.h>

#include "runtime/automata/count_pairs.h"

#include "runtime/base/array.h"

#define CHECK_EVERY 1024u /* states between two looks at the bounds */

/* Where symbols lead from the state in hand, told apart by what the second automaton tells apart. */
typedef struct tn_count_step {
    uint32_t target, column;
    uint64_t weight;
} tn_count_step;

typedef struct tn_count_sweep {
    const tn_agreement *of;
    const uint32_t *longest, *away;
    mp_limb_t *value;     /* [states of a][states of b][limbs]: words that lead there */
    uint8_t *reached;     /* [states of a][states of b]: are there any? */
    tn_count_step *steps; /* of the state in hand */
} tn_count_sweep;

void tn_sweep_measure(const tn_sparse *a, uint32_t *shortest, uint32_t *longest)
{
    for (uint32_t s = a->states; s-- > 0;) {
        shortest[s] = a->accept[s] ? 0 : UINT32_MAX;
        longest[s] = 0;
        for (size_t e = a->first[s]; e < a->first[s + 1]; e++) {
            uint32_t target = a->target[e];
            shortest[s] = shortest[target] + 1 < shortest[s] ? shortest[target] + 1 : shortest[s];
            longest[s] = longest[target] + 1 > longest[s] ? longest[target] + 1 : longest[s];
        }
    }
}

/* Gathers the steps of a state. What leads to one place by one column mostly lies side by side. */
static uint32_t gather(const tn_count_sweep *sweep, uint32_t state)
{
    const tn_agreement *of = sweep->of;
    const tn_sparse *a = of->a;
    uint32_t count = 0;
    for (size_t e = a->first[state]; e < a->first[state + 1]; e++)
        for (size_t i = of->splits.first[a->label[e]]; i < of->splits.first[a->label[e] + 1]; i++) {
            tn_count_step next = {a->target[e], of->splits.splits[i].other, of->weights[of->splits.splits[i].label]};
            uint32_t same = count;
            for (uint32_t k = count; k > 0 && count - k < TN_BOTH_NEAR && same == count; k--)
                if (sweep->steps[k - 1].target == next.target && sweep->steps[k - 1].column == next.column)
                    same = k - 1;
            if (same < count)
                sweep->steps[same].weight += next.weight;
            else if (next.weight > 0)
                sweep->steps[count++] = next;
        }
    return count;
}

/* Moves the words of one pair on by a symbol. */
static void move_on(const tn_count_sweep *sweep, uint32_t p, uint32_t q, uint32_t count)
{
    const tn_agreement *of = sweep->of;
    size_t states = of->b->states, limbs = of->limbs;
    const uint32_t *row = of->b->delta + (size_t)q * of->b->columns;
    const mp_limb_t *value = sweep->value + ((size_t)p * states + q) * limbs;
    for (uint32_t i = 0; i < count; i++) {
        const tn_count_step *step = &sweep->steps[i];
        uint32_t to = row[step->column];
        if (sweep->away[to] > sweep->longest[step->target])
            continue;
        size_t pair = (size_t)step->target * states + to;
        sweep->reached[pair] = 1;
        tn_limbs_add(sweep->value + pair * limbs, value, limbs, step->weight);
    }
}

/* Takes one state; returns the steps that took. */
static uint64_t take_state(const tn_count_sweep *sweep, uint32_t p, mpz_t count)
{
    const tn_agreement *of = sweep->of;
    uint32_t states = of->b->states, steps = 0;
    uint64_t work = 0;
    for (uint32_t q = 0; q < states; q++) {
        size_t pair = (size_t)p * states + q;
        if (!sweep->reached[pair])
            continue;
        if (work == 0)
            steps = gather(sweep, p);
        move_on(sweep, p, q, steps);
        work += steps + 1;
        if (!of->a->accept[p] || sweep->away[q] != 0)
            continue;
        mpz_t value;
        mpz_roinit_n(value, sweep->value + pair * of->limbs, (mp_size_t)of->limbs);
        mpz_add(count, count, value);
    }
    return work;
}

static tn_status take_states(const tn_count_sweep *sweep, const char *what, tn_bounds *bounds, mpz_t count,
                             tn_error *error)
{
    uint64_t work = 0;
    for (uint32_t p = 0; p < sweep->of->a->states; p++) {
        work += take_state(sweep, p, count);
        if (p % CHECK_EVERY != 0 && p + 1 < sweep->of->a->states)
            continue;
        tn_status status = tn_bounds_check(bounds, what, 1, 1, work, error);
        if (status != TN_OK)
            return status;
        work = 0;
    }
    return TN_OK;
}

tn_status tn_sweep_count(const tn_agreement *of, const uint32_t *longest, const uint32_t *away, const char *what,
                         tn_bounds *bounds, mpz_t count, tn_error *error)
{
    size_t pairs = (size_t)of->a->states * of->b->states;
    tn_count_sweep sweep = {.of = of,
                            .longest = longest,
                            .away = away,
                            .value = calloc(tn_size_of(pairs, of->limbs) + 1, sizeof *sweep.value),
                            .reached = calloc(pairs + 1, 1),
                            .steps = malloc(((size_t)of->splits.columns + 1) * sizeof *sweep.steps)};
    tn_status status = sweep.value && sweep.reached && sweep.steps ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK && of->a->states > 0 && away[0] <= longest[0]) {
        sweep.value[0] = 1;
        sweep.reached[0] = 1;
        status = take_states(&sweep, what, bounds, count, error);
    }
    free(sweep.value);
    free(sweep.reached);
    free(sweep.steps);
    return status;
}
