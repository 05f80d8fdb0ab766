/* Times matching in memory: bench_plan MODULE PLANS FOLDER
 *
 * Makes PLANS random plans of 4 to 10 trays, and prints, a line each, what was done (all: which of the rules match;
 * any: whether one does), how, and the median seconds a plan of several runs in one thread. All ways must decide the
 * same. Leaves in FOLDER, for the peers: trays.txt (the spelling of each tray), plans.bin (a byte a tray, 33 + its
 * number, a newline after each plan), plans.pl (Prolog facts), plans.txt (plan lines) and mask.txt (each plan's bits,
 * in decimal).
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "bench/bench.h"
#include "runtime/base/random.h"
#include "runtime/plan/match/lower.h"
#include "runtime/plan/match/rules.h"
#include "runtime/plan/text/text.h"

enum { TRAYS_LOW = 4, TRAYS_HIGH = 10, RUNS = 15, BYTE_FIRST = 33 };

typedef struct plans {
    tn_tray *trays; /* one plan after another */
    size_t *ends;
    size_t count;
} plans;

/* Of this thread's own: what else runs on the machine takes time, and is no part of this. */
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

static double median(double *times)
{
    qsort(times, RUNS, sizeof *times, by_value);
    return times[RUNS / 2];
}

static void print_time(const char *work, const char *how, double time, size_t count)
{
    printf("%s %s %.12f\n", work, how, time / (double)count);
}

/* ---- ours */

/* The same, each plan in a call of its own. */
static void time_one_by_one(tn_matcher *matcher, const plans *all, uint64_t *bits)
{
    tn_error error;
    double times[RUNS];
    for (size_t run = 0; run < RUNS; run++) {
        double start = seconds(CLOCK_THREAD_CPUTIME_ID);
        for (size_t i = 0; i < all->count; i++) {
            size_t begin = i ? all->ends[i - 1] : 0;
            if (tn_match(matcher, all->trays + begin, all->ends[i] - begin, &bits[i], &error) != TN_OK)
                stop(error.message);
        }
        times[run] = seconds(CLOCK_THREAD_CPUTIME_ID) - start;
    }
    print_time("all", "single", median(times), all->count);
}

/* All rules, and then whether any, by the engine and instruction set given. */
static void time_engine(const char *how, const tn_schema *schema, const uint32_t *functions, size_t rules_count,
                        const tn_rules_options *options, const plans *all, size_t count, uint64_t *bits)
{
    tn_error error;
    tn_rules *rules;
    tn_matcher *matcher;
    size_t done;
    uint8_t *matches = malloc(count);
    tn_plan_array plan_array = {all->trays, 0, all->ends, count};
    if (tn_rules_new(schema, functions, rules_count, options, &rules, &error) != TN_OK ||
        tn_matcher_new(rules, &matcher, &error) != TN_OK)
        stop(error.message);
    double times[RUNS], any_times[RUNS];
    for (size_t run = 0; run < RUNS; run++) {
        double start = seconds(CLOCK_THREAD_CPUTIME_ID);
        if (!matches || tn_match_all(matcher, &plan_array, bits, &done, &error) != TN_OK)
            stop(error.message);
        times[run] = seconds(CLOCK_THREAD_CPUTIME_ID) - start;
        start = seconds(CLOCK_THREAD_CPUTIME_ID);
        if (tn_match_any(matcher, &plan_array, matches, &done, &error) != TN_OK)
            stop(error.message);
        any_times[run] = seconds(CLOCK_THREAD_CPUTIME_ID) - start;
    }
    for (size_t i = 0; i < count; i++)
        if (matches[i] != (bits[i] != 0))
            stop("whether any rule matches is not what all of them say");
    print_time("all", how, median(times), count);
    print_time("any", how, median(any_times), count);
    if (options->engine == TN_ENGINE_AUTO && options->simd == TN_SIMD_BEST)
        time_one_by_one(matcher, all, bits);
    tn_matcher_free(matcher);
    tn_rules_free(rules);
    free(matches);
}

/* ---- the plain loop: a table a rule, a plan after another, what a program would do that did not care */

typedef struct table {
    uint32_t *next; /* [state][class] */
    uint8_t *accept;
    uint32_t sink; /* the accepting one, or TN_NO_STATE */
} table;

typedef struct plain {
    uint32_t classes;
    uint32_t *class_of; /* [trays] */
    table rules[64];
    table any; /* of their union */
} plain;

static void table_make(table *made, const tn_dfa *dfa, uint32_t classes)
{
    made->next = malloc((size_t)dfa->states * classes * sizeof *made->next);
    made->accept = malloc(dfa->states);
    if (!made->next || !made->accept)
        stop("out of memory");
    made->sink = tn_dfa_sink(dfa, 1);
    memcpy(made->accept, dfa->accept, dfa->states);
    for (uint32_t s = 0; s < dfa->states; s++)
        for (uint32_t c = 0; c < classes; c++)
            made->next[(size_t)s * classes + c] = tn_dfa_read(dfa, s, c);
}

static void table_clear(table *made)
{
    free(made->next);
    free(made->accept);
}

/* *all := what it accepts or the other does. */
static void unite(tn_dfa **all, const tn_dfa *other)
{
    tn_error error;
    tn_dfa *both;
    tn_bounds bounds = tn_bounds_make(1000000);
    if (tn_dfa_product(*all, other, TN_DFA_OR, "union", &bounds, &both, &error) != TN_OK)
        stop(error.message);
    tn_dfa_free(*all);
    *all = both;
}

static void plain_make(plain *p, const tn_schema *schema, const uint32_t *functions, size_t rules)
{
    tn_classes *classes;
    tn_lowering *lowering;
    tn_dfa *all;
    tn_error error;
    if (tn_classes_new(schema, functions, rules, &classes, &error) != TN_OK ||
        tn_lowering_new(classes, 0, &lowering, &error) != TN_OK ||
        tn_dfa_constant(classes->count, false, &all, &error) != TN_OK)
        stop(error.message);
    p->classes = classes->count;
    p->class_of = malloc(schema->tray_count * sizeof *p->class_of);
    if (!p->class_of)
        stop("out of memory");
    for (uint32_t t = 0; t < schema->tray_count; t++)
        p->class_of[t] = classes->of_tray[t];
    for (size_t i = 0; i < rules; i++) {
        tn_dfa *dfa;
        if (tn_lower(lowering, functions[i], &dfa, &error) != TN_OK)
            stop(error.message);
        table_make(&p->rules[i], dfa, p->classes);
        unite(&all, dfa);
        tn_dfa_free(dfa);
    }
    table_make(&p->any, all, p->classes);
    tn_dfa_free(all);
    tn_lowering_free(lowering);
    tn_classes_free(classes);
}

static void walk_rules(const plain *p, size_t rules, const plans *all, uint64_t *bits)
{
    for (size_t i = 0; i < all->count; i++) {
        bits[i] = 0;
        for (size_t r = 0; r < rules; r++) {
            uint32_t state = 0;
            for (size_t k = i ? all->ends[i - 1] : 0; k < all->ends[i]; k++)
                state = p->rules[r].next[(size_t)state * p->classes + p->class_of[all->trays[k]]];
            bits[i] |= (uint64_t)p->rules[r].accept[state] << r;
        }
    }
}

/* Whether any rule matches, by their union, as far as it takes to know. */
static void walk_union(const plain *p, const plans *all, uint8_t *matches)
{
    for (size_t i = 0; i < all->count; i++) {
        uint32_t state = 0;
        for (size_t k = i ? all->ends[i - 1] : 0; k < all->ends[i] && state != p->any.sink; k++)
            state = p->any.next[(size_t)state * p->classes + p->class_of[all->trays[k]]];
        matches[i] = p->any.accept[state];
    }
}

static void time_plain(const tn_schema *schema, const uint32_t *functions, size_t rules, const plans *all,
                       uint64_t *bits)
{
    plain p;
    double times[RUNS], any_times[RUNS];
    uint8_t *matches = malloc(all->count);
    if (!matches)
        stop("out of memory");
    plain_make(&p, schema, functions, rules);
    for (size_t run = 0; run < RUNS; run++) {
        double start = seconds(CLOCK_THREAD_CPUTIME_ID);
        walk_rules(&p, rules, all, bits);
        times[run] = seconds(CLOCK_THREAD_CPUTIME_ID) - start;
        start = seconds(CLOCK_THREAD_CPUTIME_ID);
        walk_union(&p, all, matches);
        any_times[run] = seconds(CLOCK_THREAD_CPUTIME_ID) - start;
    }
    for (size_t i = 0; i < all->count; i++)
        if (matches[i] != (bits[i] != 0))
            stop("the union is not what all rules say");
    print_time("all", "plain", median(times), all->count);
    print_time("any", "plain", median(any_times), all->count);
    for (size_t r = 0; r < rules; r++)
        table_clear(&p.rules[r]);
    table_clear(&p.any);
    free(p.class_of);
    free(matches);
}

/* ---- what the peers read */

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
         *masks = create(folder, "mask.txt"), *prolog = create(folder, "plans.pl"),
         *lines = create(folder, "plans.txt");
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
        tn_buffer line = {0};
        if (!tn_plan_write_line(schema, all->trays + begin, all->ends[i] - begin, &line))
            stop("out of memory");
        fprintf(lines, "%s\n", line.data);
        free(line.data);
        fprintf(masks, "%" PRIu64 "\n", bits[i]);
        if (i < facts)
            write_fact(schema, all->trays + begin, all->ends[i] - begin, prolog);
    }
    if (fclose(trays) | fclose(bytes) | fclose(masks) | fclose(prolog) | fclose(lines))
        stop("cannot write to the folder");
}

int main(int argc, char **argv)
{
    if (argc != 4)
        stop("usage: bench_plan MODULE PLANS FOLDER");
    size_t count = strtoul(argv[2], NULL, 10), few = count / 20;
    tn_error error;
    tn_module *module = load_module(argv[1]);
    tn_schema *schema;
    if (tn_schema_new(module, 0, 0, &schema, &error) != TN_OK)
        stop(error.message);
    uint32_t functions[64];
    size_t rules = module->RULE_count;
    if (rules > 64 || schema->tray_count > 255 - BYTE_FIRST || few == 0)
        stop("at most 64 rules and 222 trays, at least 20 plans");
    for (size_t i = 0; i < rules; i++)
        functions[i] = module->RULE_records[i].holds;
    plans all = make(schema, count);
    uint64_t *bits = calloc(count, sizeof *bits), *other = calloc(count, sizeof *other);
    if (!bits || !other)
        stop("out of memory");
    static const struct {
        const char *how;
        tn_rules_options options;
    } engines[] = {{"portable", {.simd = TN_SIMD_NONE, .any = true}},
                   {"avx2", {.simd = TN_SIMD_AVX2, .any = true}},
                   {"tartan", {.any = true}},
                   {"vm", {.engine = TN_ENGINE_VM}}};
    time_plain(schema, functions, rules, &all, bits);
    for (size_t e = 0; e < sizeof engines / sizeof *engines; e++) {
        size_t compared = engines[e].options.engine == TN_ENGINE_VM ? few : count;
        time_engine(engines[e].how, schema, functions, rules, &engines[e].options, &all, compared, other);
        if (memcmp(bits, other, compared * sizeof *bits) != 0)
            stop("the engines decide differently");
    }
    write_files(schema, &all, bits, count / 100, argv[3]);
    free(bits);
    free(other);
    free(all.trays);
    free(all.ends);
    tn_schema_free(schema);
    tn_module_free(module);
    return 0;
}
