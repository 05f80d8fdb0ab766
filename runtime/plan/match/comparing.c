/* BELOW, ZERO and ABOVE: stretches on which a sum compares so with 0, as automata; MULTIPLE: on which it is a multiple.
 *
 * A state is that of the sum's machine and the sum so far: past what the trays to come can undo, how far past does not
 * matter; of multiples, what is left after dividing is enough.
 */
#include <stdlib.h>

#include "runtime/automata/explore.h"
#include "runtime/plan/match/summing.h"

typedef struct tn_comparing {
    tn_summing summing;
    tn_opcode opcode;
    int64_t low, high; /* past these the outcome is certain */
    int64_t modulus;   /* of multiples, in steps; else 0 */
    uint64_t effort;
} tn_comparing;

/* A key is {sum so far, in two words}, then the machine's; the empty key is where a third marker leads. */
enum { LOW, HIGH, MACHINE };

static int64_t total_of(const uint32_t *key)
{
    return (int64_t)((uint64_t)key[HIGH] << 32 | key[LOW]);
}

/* The total in the form in which states keep it. */
static int64_t kept(const tn_comparing *comparing, int64_t total)
{
    if (comparing->modulus > 0) {
        total %= comparing->modulus;
        return total < 0 ? total + comparing->modulus : total;
    }
    return total > comparing->high ? comparing->high + 1 : total < comparing->low ? comparing->low - 1 : total;
}

static bool comparing_step(void *context, const uint32_t *key, size_t size, uint32_t column, tn_key *next)
{
    tn_comparing *comparing = context;
    bool marker = column == comparing->summing.marker;
    if (size == 0 || (marker && key[MACHINE] == 2))
        return true;
    int64_t total = total_of(key), gain;
    if (!tn_key_push(next, 0) || !tn_key_push(next, 0) ||
        !tn_summing_step(&comparing->summing, key + MACHINE, size - MACHINE, column, next, &gain))
        return false;
    if (total >= comparing->low && total <= comparing->high)
        total = kept(comparing, total + gain);
    if (comparing->modulus == 0 && next->data[MACHINE] == 2 && !comparing->summing.behind &&
        !tn_summing_waits(&comparing->summing, next->size - MACHINE)) /* only the outcome is left */
        total = (total > 0) - (total < 0);
    next->data[LOW] = (uint32_t)(uint64_t)total;
    next->data[HIGH] = (uint32_t)((uint64_t)total >> 32);
    comparing->effort = comparing->summing.effort;
    return true;
}

static bool comparing_accepts(void *context, const uint32_t *key, size_t size)
{
    const tn_comparing *comparing = context;
    if (size == 0 || key[MACHINE] != 2)
        return false;
    int64_t total = total_of(key);
    if (tn_summing_waits(&comparing->summing, size - MACHINE) && total >= comparing->low && total <= comparing->high)
        total += tn_summing_rest(&comparing->summing, key + MACHINE, size - MACHINE);
    if (comparing->modulus > 0)
        return total % comparing->modulus == 0;
    return comparing->opcode == TN_OP_BELOW ? total < 0 : comparing->opcode == TN_OP_ZERO ? total == 0 : total > 0;
}

static tn_status find_bounds(tn_comparing *comparing, uint32_t max_trays, tn_error *error)
{
    const tn_summing *summing = &comparing->summing;
    const int64_t most = INT64_MAX / 4;
    comparing->low = -most;
    comparing->high = most;
    if (comparing->modulus > 0)
        return TN_OK;
    if (max_trays == 0 && summing->most_up > 0 && summing->most_down > 0) {
        tn_fail(
            error, TN_LIMIT, E_TOO_MANY_STATES,
            "a sum that rises and falls has as many states as plans have trays, and it is not known how many that is");
        tn_error_help(error,
                      "prune or require the rule in a library: there it is looked at within the library's lengths");
        return TN_LIMIT;
    }
    comparing->high = summing->most_down == 0 ? 0 : max_trays == 0 ? most : summing->most_down * (int64_t)max_trays;
    comparing->low = summing->most_up == 0 ? 0 : max_trays == 0 ? -most : -summing->most_up * (int64_t)max_trays;
    return TN_OK;
}

/* Before everything the sum is its constant. */
static bool push_start(const tn_comparing *comparing, int64_t constant, tn_key *start)
{
    uint64_t total = (uint64_t)kept(comparing, constant);
    return tn_key_push(start, (uint32_t)total) && tn_key_push(start, (uint32_t)(total >> 32)) &&
           tn_summing_start(&comparing->summing, start);
}

tn_status tn_relate_sum(const tn_marked *marked, const tn_classes *classes, const tn_sum *sum, tn_dfa *const *parts,
                        bool reversed, const tn_instruction *compare, uint32_t max_trays, tn_dfa **out, tn_error *error)
{
    tn_comparing comparing = {.opcode = compare->opcode};
    if (compare->opcode == TN_OP_MULTIPLE)
        comparing.modulus = tn_sum_modulus(sum, compare->second);
    tn_key start = {0};
    tn_status status = tn_summing_make(&comparing.summing, sum, marked, classes, parts, reversed, error);
    if (status == TN_OK)
        status = find_bounds(&comparing, max_trays, error);
    if (status == TN_OK && !push_start(&comparing, sum->constant, &start))
        status = tn_fail_memory(error);
    if (status == TN_OK) {
        tn_construction construction = {"comparison", &comparing.summing.join, &comparing, comparing_step,
                                        comparing_accepts};
        status = tn_explore(&construction, &start, &comparing.effort, marked->bounds, out, error);
    }
    free(start.data);
    tn_summing_clear(&comparing.summing);
    return status;
}
