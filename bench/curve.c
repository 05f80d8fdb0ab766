/* One point of a curve: bench_curve MODULE PLANS SHORTEST LONGEST THREADS
 *
 * Matches all rules of the module against PLANS random plans of SHORTEST to LONGEST trays in THREADS threads, and
 * prints the seconds a plan of the fastest of many runs, as what else the machine does can only add to them.
 * bench_curve MODULE states prints how many states the first rule has (0: it is interpreted).
 */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "bench/bench.h"
#include "runtime/base/crew.h"
#include "runtime/base/random.h"
#include "runtime/plan/match/rules.h"

enum { RUNS = 61, RULES_MAX = 1000 };

/* Random plans in `trays` and `ends`, which have room for the longest. */
static void make(const tn_schema *schema, size_t count, size_t shortest, size_t longest, tn_tray *trays, size_t *ends)
{
    size_t at = 0;
    for (size_t i = 0; i < count; i++) {
        size_t length = shortest + tn_random64(2, 0, i) % (longest - shortest + 1);
        for (size_t k = 0; k < length; k++)
            trays[at++] = (tn_tray)(tn_random64(2, i + 1, k) % schema->tray_count);
        ends[i] = at;
    }
}

typedef struct matching {
    const tn_rules *rules;
    const tn_plan_array *plans;
    size_t shares;
    uint64_t *bits;
} matching;

static void match_share(void *context, uint32_t t)
{
    const matching *m = context;
    const tn_plan_array *plans = m->plans;
    size_t words = (tn_rules_count(m->rules) + 63) / 64;
    size_t first = plans->count * t / m->shares, last = plans->count * (t + 1) / m->shares, done;
    tn_plan_array share = {plans->trays, first ? plans->ends[first - 1] : 0, plans->ends + first, last - first};
    tn_matcher *matcher;
    tn_error error;
    if (tn_matcher_new(m->rules, &matcher, &error) != TN_OK ||
        tn_match_all(matcher, &share, m->bits + first * words, &done, &error) != TN_OK)
        stop(error.message);
    tn_matcher_free(matcher);
}

/* The fastest seconds a plan; every thread has its share of the plans. */
static double fastest(const tn_rules *rules, const tn_plan_array *plans, unsigned threads)
{
    matching m = {rules, plans, threads, calloc(plans->count, (tn_rules_count(rules) + 63) / 64 * sizeof *m.bits)};
    tn_crew *crew = tn_crew_new(threads, NULL);
    if (!m.bits || !crew)
        stop("out of memory");
    double best = 1e9;
    for (size_t run = 0; run <= RUNS; run++) { /* the first warms up */
        double start = seconds(CLOCK_MONOTONIC);
        tn_crew_share(crew, threads, match_share, &m, NULL);
        double time = seconds(CLOCK_MONOTONIC) - start;
        best = run > 0 && time < best ? time : best;
    }
    tn_crew_free(crew);
    free(m.bits);
    return best / (double)plans->count;
}

int main(int argc, char **argv)
{
    if (argc != 6 && argc != 3)
        stop("usage: bench_curve MODULE PLANS SHORTEST LONGEST THREADS, or bench_curve MODULE states");
    tn_error error;
    tn_module *module = load_module(argv[1]);
    tn_schema *schema;
    tn_rules *rules;
    if (tn_schema_new(module, 0, 0, &schema, &error) != TN_OK)
        stop(error.message);
    static uint32_t functions[RULES_MAX];
    if (module->RULE_count > RULES_MAX)
        stop("too many rules");
    for (size_t i = 0; i < module->RULE_count; i++)
        functions[i] = module->RULE_records[i].holds;
    tn_rules_options options = {.engine = TN_ENGINE_AUTO};
    if (tn_rules_new(schema, functions, module->RULE_count, &options, &rules, &error) != TN_OK)
        stop(error.message);
    if (argc == 3) {
        printf("%u\n", tn_rules_states(rules, 0));
    } else {
        size_t count = strtoul(argv[2], NULL, 10), longest = strtoul(argv[4], NULL, 10);
        tn_tray *trays = malloc(count * longest * sizeof *trays);
        size_t *ends = malloc(count * sizeof *ends);
        if (!trays || !ends)
            stop("out of memory");
        make(schema, count, strtoul(argv[3], NULL, 10), longest, trays, ends);
        printf("%.12f\n",
               fastest(rules, &(tn_plan_array){trays, 0, ends, count}, (unsigned)strtoul(argv[5], NULL, 10)));
        free(trays);
        free(ends);
    }
    tn_rules_free(rules);
    tn_schema_free(schema);
    tn_module_free(module);
    return 0;
}
