/* Times deriving models alone: derive MODULE RUNS [vm]. Processor time of this thread, the median of RUNS, of the
 * module's first model or its connection grammar; without compiling, loading or writing. */
#include "bench/bench.h"

#include <string.h>

#include "runtime/place/grow.h"

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double derive_once(const tn_place_rules *rules, bool interpret, size_t *parts)
{
    const tn_place_options options = {.interpret = interpret};
    tn_placed_model model;
    tn_place_fault fault;
    tn_error error;
    double begun = seconds(CLOCK_THREAD_CPUTIME_ID);
    if (tn_place_derive(rules, &options, &model, &fault, &error) != TN_OK)
        stop(error.message);
    double taken = seconds(CLOCK_THREAD_CPUTIME_ID) - begun;
    *parts = model.count;
    tn_placed_model_clear(&model);
    return taken;
}

int main(int argc, char **argv)
{
    int runs = argc > 2 ? atoi(argv[2]) : 0;
    bool interpret = argc > 3 && strcmp(argv[3], "vm") == 0;
    if (runs < 1)
        stop("usage: derive MODULE RUNS [vm]");
    tn_module *module = load_module(argv[1]);
    double *times = malloc((size_t)runs * sizeof *times);
    tn_place_rules rules;
    tn_error error;
    size_t parts = 0;
    if (!times)
        stop("out of memory");
    tn_status status = module->KIT_MODEL_count > 0 ? tn_place_rules_of_model(module, 0, &rules, &error)
                                                   : tn_place_rules_make(module, &rules, &error);
    if (status != TN_OK)
        stop(error.message);
    for (int i = 0; i < runs; i++)
        times[i] = derive_once(&rules, interpret, &parts);
    qsort(times, (size_t)runs, sizeof *times, compare);
    double median = times[runs / 2];
    printf("derived %zu parts in %.4f ms, %.3f us a part\n", parts, median * 1e3,
           median * 1e6 / (double)(parts ? parts : 1));
    tn_place_rules_clear(&rules);
    tn_module_free(module);
    free(times);
    return 0;
}
