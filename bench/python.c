/* The C side of bench/python: opens a library, samples plans of it, and matches a rule on them; prints the seconds of
 * the two on a line: bench_python FILE LIBRARY RULE COUNT */
#include "include/tartan/tartan.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static size_t take_all(tartan_plans *plans, size_t count, size_t longest, uint32_t **trays, size_t **ends)
{
    *trays = malloc(count * longest * sizeof **trays);
    *ends = malloc(count * sizeof **ends);
    return *trays && *ends ? tartan_plans_take(plans, count, *trays, count * longest, *ends) : 0;
}

int main(int argc, char **argv)
{
    tartan_error error = {.message = "usage: bench_python FILE LIBRARY RULE COUNT"};
    tartan_module *module = NULL;
    tartan_library *library = NULL;
    tartan_rules *rules = NULL;
    tartan_plans *plans = NULL;
    tartan_library_options options = tartan_library_options_init();
    uint32_t *trays = NULL;
    size_t *ends = NULL, count = argc == 5 ? strtoul(argv[4], NULL, 10) : 0, taken = 0;
    uint8_t *matches = count ? malloc(count) : NULL;
    if (argc == 5)
        options.name = argv[2];
    tartan_status status = matches ? tartan_compile_file(argv[1], NULL, &module, &error) : TARTAN_INVALID;
    if (status == TARTAN_OK)
        status = tartan_library_open(module, &options, NULL, &library, &error);
    if (status == TARTAN_OK)
        status = tartan_rules_new(module, (const char *[]){argv[3]}, 1, NULL, &rules, &error);
    double began = now();
    if (status == TARTAN_OK)
        status = tartan_library_sample(library, 1, TARTAN_ANY_LENGTH, count, &plans, &error);
    if (status == TARTAN_OK)
        taken = take_all(plans, count, tartan_library_max_trays(library), &trays, &ends);
    double sampled = now();
    if (status == TARTAN_OK)
        status = tartan_match_any(rules, trays, ends, taken, 0, matches, NULL, &error);
    double matched = now();
    if (status == TARTAN_OK)
        printf("%zu %f %f\n", taken, sampled - began, matched - sampled);
    else
        fprintf(stderr, "%s\n", error.message);
    free(matches);
    free(trays);
    free(ends);
    tartan_plans_free(plans);
    tartan_rules_free(rules);
    tartan_library_free(library);
    tartan_module_free(module);
    return status != TARTAN_OK;
}
