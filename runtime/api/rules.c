#include "runtime/plan/rules.h"

#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/api/api.h"

struct tartan_rules {
    const tn_module *module;
    tn_schema *schema;
    tn_rules *rules;
    uint32_t *records; /* per rule: its RULE record */
    size_t count;
};

struct tartan_matcher {
    const tartan_rules *rules;
    tn_matcher *matcher;
};

static tartan_status out_of_memory(tartan_error *error)
{
    tn_error found;
    tn_fail_memory(&found);
    return tn_api_fail(&found, error);
}

static bool find(const tn_module *module, const char *name, uint32_t *record)
{
    for (size_t i = 0; i < module->RULE_count; i++) {
        if (strcmp(tn_text(module, module->RULE_records[i].name), name) == 0) {
            *record = (uint32_t)i;
            return true;
        }
    }
    return false;
}

/* Fills records with the rules asked for. */
static tartan_status choose(tartan_rules *rules, const char *const *names, size_t count, tartan_error *error)
{
    const tn_module *module = rules->module;
    rules->records = calloc((count > module->RULE_count ? count : module->RULE_count) + 1, sizeof *rules->records);
    if (!rules->records)
        return out_of_memory(error);
    for (size_t i = 0; i < count; i++)
        if (!find(module, names[i], &rules->records[rules->count++]))
            return tn_api_refuse(error, TARTAN_INVALID, "the module has no rule `%s`", names[i]);
    for (size_t i = 0; count == 0 && i < module->RULE_count; i++)
        if (!(module->RULE_records[i].flags & TN_IMPORTED))
            rules->records[rules->count++] = (uint32_t)i;
    if (rules->count == 0)
        return tn_api_refuse(error, TARTAN_INVALID, "the module has no rules");
    return TARTAN_OK;
}

static tartan_status prepare(tartan_rules *rules, tartan_error *error)
{
    const tn_rule_record *records = rules->module->RULE_records;
    const tn_rule_record *first = &records[rules->records[0]];
    const tn_rules_options options = {.any = true};
    uint32_t *functions = malloc(rules->count * sizeof *functions);
    if (!functions)
        return out_of_memory(error);
    for (size_t i = 0; i < rules->count; i++) {
        const tn_rule_record *rule = &records[rules->records[i]];
        functions[i] = rule->holds;
        if (rule->schema != first->schema) {
            free(functions);
            return tn_api_refuse(error, TARTAN_INVALID, "rules `%s` and `%s` are of different schemas",
                                 tn_text(rules->module, first->name), tn_text(rules->module, rule->name));
        }
    }
    tn_error found;
    tn_status status = tn_schema_new(rules->module, first->schema, 0, &rules->schema, &found);
    if (status == TN_OK)
        status = tn_rules_new(rules->schema, functions, rules->count, &options, &rules->rules, &found);
    free(functions);
    return status == TN_OK ? TARTAN_OK : tn_api_fail(&found, error);
}

tartan_status tartan_rules_new(const tartan_module *module, const char *const *names, size_t count,
                               tartan_rules **rules, tartan_error *error)
{
    tartan_rules *made = calloc(1, sizeof *made);
    if (!made)
        return out_of_memory(error);
    made->module = module->module;
    tartan_status status = choose(made, names, count, error);
    if (status == TARTAN_OK)
        status = prepare(made, error);
    if (status != TARTAN_OK) {
        tartan_rules_free(made);
        return status;
    }
    *rules = made;
    return TARTAN_OK;
}

void tartan_rules_free(tartan_rules *rules)
{
    if (!rules)
        return;
    tn_rules_free(rules->rules);
    tn_schema_free(rules->schema);
    free(rules->records);
    free(rules);
}

size_t tartan_rules_count(const tartan_rules *rules)
{
    return rules->count;
}

const char *tartan_rules_name(const tartan_rules *rules, size_t i)
{
    return i < rules->count ? tn_text(rules->module, rules->module->RULE_records[rules->records[i]].name) : NULL;
}

const tartan_schema *tartan_rules_schema(const tartan_rules *rules)
{
    return tn_api_public_schema(rules->schema);
}

size_t tartan_rules_words(const tartan_rules *rules)
{
    return (rules->count + 63) / 64;
}

tartan_status tartan_matcher_new(const tartan_rules *rules, tartan_matcher **matcher, tartan_error *error)
{
    tartan_matcher *made = malloc(sizeof *made);
    if (!made)
        return out_of_memory(error);
    *made = (tartan_matcher){.rules = rules};
    tn_error found;
    if (tn_matcher_new(rules->rules, &made->matcher, &found) != TN_OK) {
        free(made);
        return tn_api_fail(&found, error);
    }
    *matcher = made;
    return TARTAN_OK;
}

void tartan_matcher_free(tartan_matcher *matcher)
{
    if (!matcher)
        return;
    tn_matcher_free(matcher->matcher);
    free(matcher);
}

tartan_status tartan_match(tartan_matcher *matcher, const uint32_t *trays, size_t length, uint64_t *bits,
                           tartan_error *error)
{
    tn_error found;
    tartan_status status = tn_api_trays(matcher->rules->schema, trays, length, error);
    if (status != TARTAN_OK)
        return status;
    return tn_match(matcher->matcher, trays, length, bits, &found) == TN_OK ? TARTAN_OK : tn_api_fail(&found, error);
}

/* Says which plan an error is about. */
static void name_plan(size_t plan, tartan_error *error)
{
    char message[sizeof error->message];
    memcpy(message, error->message, sizeof message);
    snprintf(error->message, sizeof error->message, "plan %zu: %s", plan + 1, message);
}

/* Many plans to be matched. */
typedef struct request {
    const tartan_rules *rules;
    const uint32_t *trays;
    const size_t *ends;
    uint64_t *bits;   /* which rules; NULL: asked whether any does */
    uint8_t *matches; /* whether any does */
} request;

static tn_status match_array(tn_matcher *matcher, const request *asked, size_t begin, const tn_plan_array *plans,
                             size_t *done, tn_error *error)
{
    if (asked->bits)
        return tn_match_all(matcher, plans, asked->bits + begin * tartan_rules_words(asked->rules), done, error);
    return tn_match_any(matcher, plans, asked->matches + begin, done, error);
}

/* The plans [begin, end), in one thread; fills `error` where one fails. */
static void match_some(const request *asked, size_t begin, size_t end, tartan_error *error)
{
    const size_t *ends = asked->ends;
    const tn_plan_array plans = {asked->trays, begin ? ends[begin - 1] : 0, ends + begin, end - begin};
    for (size_t i = begin, start = plans.begin; i < end; start = ends[i++]) {
        if (tn_api_trays(asked->rules->schema, asked->trays + start, ends[i] - start, error) != TARTAN_OK) {
            name_plan(i, error);
            return;
        }
    }
    tn_matcher *matcher;
    tn_error found;
    size_t done = 0;
    if (tn_matcher_new(asked->rules->rules, &matcher, &found) != TN_OK) {
        tn_api_fail(&found, error);
        return;
    }
    if (match_array(matcher, asked, begin, &plans, &done, &found) != TN_OK) {
        tn_api_fail(&found, error);
        name_plan(begin + done, error);
    }
    tn_matcher_free(matcher);
}

static tartan_status match_plans(const request *asked, size_t count, unsigned threads, tartan_error *error)
{
    for (size_t i = 1; i < count; i++)
        if (asked->ends[i] < asked->ends[i - 1])
            return tn_api_refuse(error, TARTAN_INVALID, "plan %zu ends before it begins", i + 1);
    size_t workers = threads ? threads : (size_t)omp_get_num_procs();
    if (workers > count)
        workers = count ? count : 1;
    tartan_error *errors = calloc(workers, sizeof *errors); /* each share's own */
    if (!errors)
        return out_of_memory(error);
#pragma omp parallel for num_threads((int)workers) schedule(static, 1)
    for (size_t share = 0; share < workers; share++)
        match_some(asked, count * share / workers, count * (share + 1) / workers, &errors[share]);
    /* the first that failed: the same error however many threads there are */
    size_t failed = 0;
    while (failed < workers && errors[failed].status == TARTAN_OK)
        failed++;
    tartan_status result = failed < workers ? errors[failed].status : TARTAN_OK;
    if (error && failed < workers)
        *error = errors[failed];
    free(errors);
    return result;
}

tartan_status tartan_match_all(const tartan_rules *rules, const uint32_t *trays, const size_t *ends, size_t count,
                               unsigned threads, uint64_t *bits, tartan_error *error)
{
    const request asked = {.rules = rules, .trays = trays, .ends = ends, .bits = bits};
    return match_plans(&asked, count, threads, error);
}

tartan_status tartan_match_any(const tartan_rules *rules, const uint32_t *trays, const size_t *ends, size_t count,
                               unsigned threads, uint8_t *matches, tartan_error *error)
{
    const request asked = {.rules = rules, .trays = trays, .ends = ends, .matches = matches};
    return match_plans(&asked, count, threads, error);
}
