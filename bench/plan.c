/* Times matching in memory: bench_plan MODULE PLANS FOLDER
 *
 * Makes PLANS random plans of 4 to 10 trays, matches every rule against each with both engines in one thread, and
 * prints the median time of several runs. Both must decide the same. Leaves in FOLDER, for the peers: trays.txt (the
 * spelling of each tray), plans.bin (a byte a tray, 33 + its number, a newline after each plan), plans.pl (Prolog
 * facts) and mask.txt (each plan's bits, in decimal).
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "runtime/plan/rules.h"
#include "runtime/plan/text.h"
#include "runtime/vm/random.h"

enum { TRAYS_LOW = 4, TRAYS_HIGH = 10, RUNS = 7, BYTE_FIRST = 33 };

typedef struct plans {
    tn_tray *trays; /* one plan after another */
    size_t *ends;
    size_t count;
} plans;

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

static void stop(const char *what)
{
    fprintf(stderr, "bench_plan: %s\n", what);
    exit(1);
}

static plans make(const tn_schema *schema, size_t count)
{
    plans made = {malloc(count * TRAYS_HIGH * sizeof *made.trays), malloc(count * sizeof *made.ends), count};
    if (!made.trays || !made.ends)
        stop("out of memory");
    size_t at = 0;
    for (size_t i = 0; i < count; i++) {
        size_t length = TRAYS_LOW + tn_random64(1, 0, i) % (TRAYS_HIGH - TRAYS_LOW + 1);
        for (size_t k = 0; k < length; k++)
            made.trays[at++] = (tn_tray)(tn_random64(1, i + 1, k) % schema->tray_count);
        made.ends[i] = at;
    }
    return made;
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* One run over the first `count` plans: all in one call, or each in its own. */
static void match(tn_matcher *matcher, const plans *all, size_t count, bool together, uint64_t *bits)
{
    tn_error error;
    size_t done;
    tn_plan_array array = {all->trays, 0, all->ends, count};
    if (together && tn_match_all(matcher, &array, bits, &done, &error) != TN_OK)
        stop(error.message);
    for (size_t i = 0; !together && i < count; i++) {
        size_t begin = i ? all->ends[i - 1] : 0;
        if (tn_match(matcher, all->trays + begin, all->ends[i] - begin, &bits[i], &error) != TN_OK)
            stop(error.message);
    }
}

/* Median seconds of matching the first `count` plans. */
static double time_engine(const tn_schema *schema, const uint32_t *functions, size_t rules_count, tn_engine engine,
                          const plans *all, size_t count, bool together, uint64_t *bits)
{
    tn_error error;
    tn_rules *rules;
    tn_matcher *matcher;
    if (tn_rules_new(schema, functions, rules_count, &(tn_rules_options){.engine = engine}, &rules, &error) != TN_OK ||
        tn_matcher_new(rules, &matcher, &error) != TN_OK)
        stop(error.message);
    double times[RUNS];
    for (size_t run = 0; run < RUNS; run++) {
        double start = seconds();
        match(matcher, all, count, together, bits);
        times[run] = seconds() - start;
    }
    tn_matcher_free(matcher);
    tn_rules_free(rules);
    qsort(times, RUNS, sizeof *times, by_value);
    return times[RUNS / 2];
}

static FILE *create(const char *folder, const char *name)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "wb");
    if (!file)
        stop("cannot write to the folder");
    return file;
}

/* A plan as a Prolog fact: plan([tray('4\'',single,...),...]). */
static void write_fact(const tn_schema *schema, const tn_tray *trays, size_t length, FILE *out)
{
    for (size_t i = 0; i < length; i++) {
        fputs(i ? ",tray(" : "plan([tray(", out);
        for (uint32_t field = 0; field < schema->field_count; field++) {
            fputs(field ? ",'" : "'", out);
            for (const char *c = tn_text(schema->module, tn_tray_value_record(schema, trays[i], field)->spelling); *c;
                 c++)
                fprintf(out, *c == '\'' ? "\\'" : "%c", *c);
            fputc('\'', out);
        }
        fputc(')', out);
    }
    fputs("]).\n", out);
}

static void write_files(const tn_schema *schema, const plans *all, const uint64_t *bits, size_t facts,
                        const char *folder)
{
    FILE *trays = create(folder, "trays.txt"), *bytes = create(folder, "plans.bin"),
         *masks = create(folder, "mask.txt"), *prolog = create(folder, "plans.pl");
    for (tn_tray tray = 0; tray < schema->tray_count; tray++) {
        tn_buffer line = {0};
        if (!tn_plan_write_line(schema, &tray, 1, &line))
            stop("out of memory");
        fprintf(trays, "%s\n", line.data);
        free(line.data);
    }
    for (size_t i = 0; i < all->count; i++) {
        size_t begin = i ? all->ends[i - 1] : 0;
        for (size_t k = begin; k < all->ends[i]; k++)
            fputc(BYTE_FIRST + (int)all->trays[k], bytes);
        fputc('\n', bytes);
        fprintf(masks, "%" PRIu64 "\n", bits[i]);
        if (i < facts)
            write_fact(schema, all->trays + begin, all->ends[i] - begin, prolog);
    }
    if (fclose(trays) | fclose(bytes) | fclose(masks) | fclose(prolog))
        stop("cannot write to the folder");
}

int main(int argc, char **argv)
{
    if (argc != 4)
        stop("usage: bench_plan MODULE PLANS FOLDER");
    size_t count = strtoul(argv[2], NULL, 10), few = count / 20;
    tn_error error;
    tn_module *module;
    tn_schema *schema;
    if (tn_module_load_file(argv[1], NULL, &module, &error) != TN_OK ||
        tn_schema_new(module, 0, 0, &schema, &error) != TN_OK)
        stop(error.message);
    uint32_t functions[64];
    size_t rules = module->RULE_count;
    if (rules > 64 || schema->tray_count > 255 - BYTE_FIRST || few == 0)
        stop("at most 64 rules and 222 trays, at least 20 plans");
    for (size_t i = 0; i < rules; i++)
        functions[i] = module->RULE_records[i].holds;
    plans all = make(schema, count);
    uint64_t *dfa = calloc(count, sizeof *dfa), *one = calloc(count, sizeof *one), *vm = calloc(few, sizeof *vm);
    if (!dfa || !one || !vm)
        stop("out of memory");
    double all_time = time_engine(schema, functions, rules, TN_ENGINE_DFA, &all, count, true, dfa);
    double one_time = time_engine(schema, functions, rules, TN_ENGINE_DFA, &all, count, false, one);
    double vm_time = time_engine(schema, functions, rules, TN_ENGINE_VM, &all, few, false, vm);
    if (memcmp(dfa, one, count * sizeof *dfa) != 0 || memcmp(dfa, vm, few * sizeof *dfa) != 0)
        stop("the engines decide differently");
    printf("dfa %.12f %zu\none %.12f %zu\nvm %.12f %zu\n", all_time / (double)count, count, one_time / (double)count,
           count, vm_time / (double)few, few);
    write_files(schema, &all, dfa, count / 100, argv[3]);
    free(dfa);
    free(one);
    free(vm);
    free(all.trays);
    free(all.ends);
    tn_schema_free(schema);
    tn_module_free(module);
    return 0;
}
