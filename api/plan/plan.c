/* The C interface to matching rules. */
#include "api/plan/plan.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/crew.h"
#include "runtime/plan/match/rules.h"

/* ---- matching rules */

struct tartan_rules {
    tn_api_plans plans;
    tn_rules *rules;
    uint32_t *records; /* per rule: its RULE record */
    size_t count;
};

struct tartan_matcher {
    const tartan_rules *rules;
    tn_matcher *matcher;
};

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

static tartan_status unknown(const tn_module *module, const char *name, tartan_error *error)
{
    const char **names = malloc((module->RULE_count + 1) * sizeof *names);
    for (size_t i = 0; names && i < module->RULE_count; i++)
        names[i] = tn_text(module, module->RULE_records[i].name);
    return tn_api_unknown(error, "rule", name, names, module->RULE_count);
}

static tartan_status choose(const tn_module *module, const char *const *names, size_t count, uint32_t *records,
                            size_t *found, tartan_error *error)
{
    *found = 0;
    for (size_t i = 0; i < count; i++) {
        if (!names || !names[i])
            return tn_api_missing(error, "rule's name");
        if (!find(module, names[i], &records[(*found)++]))
            return unknown(module, names[i], error);
    }
    for (size_t i = 0; count == 0 && i < module->RULE_count; i++)
        if (!(module->RULE_records[i].flags & TN_IMPORTED))
            records[(*found)++] = (uint32_t)i;
    if (*found == 0)
        return tn_api_refuse(error, TARTAN_INVALID, "the module has no rules of its own");
    const tn_rule_record *first = &module->RULE_records[records[0]];
    for (size_t i = 1; i < *found; i++)
        if (module->RULE_records[records[i]].schema != first->schema)
            return tn_api_refuse(error, TARTAN_INVALID, "rules `%s` and `%s` are of different schemas",
                                 tn_text(module, first->name), tn_text(module, module->RULE_records[records[i]].name));
    return TARTAN_OK;
}

tartan_status tn_api_rules_find(const tn_module *module, const char *const *names, size_t count, uint32_t **records,
                                size_t *found, tartan_error *error)
{
    uint32_t *made = calloc((count > module->RULE_count ? count : module->RULE_count) + 1, sizeof *made);
    if (!made)
        return tn_api_memory(error);
    tartan_status status = choose(module, names, count, made, found, error);
    if (status == TARTAN_OK)
        *records = made;
    else
        free(made);
    return status;
}

static tartan_status prepare(tartan_rules *rules, tartan_error *error)
{
    const tn_rule_record *records = rules->plans.module.RULE_records;
    const tn_rules_options options = {.any = true};
    uint32_t *functions = malloc(rules->count * sizeof *functions);
    if (!functions)
        return tn_api_memory(error);
    for (size_t i = 0; i < rules->count; i++)
        functions[i] = records[rules->records[i]].holds;
    tn_error found;
    tn_status status =
        tn_schema_new(&rules->plans.module, records[rules->records[0]].schema, 0, &rules->plans.schema, &found);
    if (status == TN_OK)
        status = tn_rules_new(rules->plans.schema, functions, rules->count, &options, &rules->rules, &found);
    free(functions);
    return status == TN_OK ? TARTAN_OK : tn_api_fail(&found, error);
}

tartan_status tartan_rules_new(const tartan_module *module, const char *const *names, size_t count,
                               const tartan_watch *watch, tartan_rules **rules, tartan_error *error)
{
    tartan_rules *made = calloc(1, sizeof *made);
    if (!made)
        return tn_api_memory(error);
    tartan_status status = tn_api_plans_begin(module, watch, &made->plans, error);
    if (status == TARTAN_OK)
        status = tn_api_rules_find(&made->plans.module, names, count, &made->records, &made->count, error);
    if (status == TARTAN_OK)
        status = prepare(made, error);
    if (status != TARTAN_OK) {
        tartan_rules_free(made);
        return status;
    }
    tn_api_plans_made(&made->plans);
    *rules = made;
    return TARTAN_OK;
}

uint32_t tn_api_rules_record(const tartan_rules *rules, size_t i)
{
    return rules->records[i];
}

const tn_schema *tn_api_rules_schema(const tartan_rules *rules)
{
    return rules->plans.schema;
}

void tartan_rules_free(tartan_rules *rules)
{
    if (!rules)
        return;
    tn_rules_free(rules->rules);
    tn_api_plans_clear(&rules->plans);
    free(rules->records);
    free(rules);
}

size_t tartan_rules_count(const tartan_rules *rules)
{
    return rules->count;
}

const char *tartan_rules_name(const tartan_rules *rules, size_t i)
{
    return i < rules->count ? tn_text(&rules->plans.module, rules->plans.module.RULE_records[rules->records[i]].name)
                            : NULL;
}

const tartan_schema *tartan_rules_schema(const tartan_rules *rules)
{
    return tn_api_public_schema(rules->plans.schema);
}

size_t tartan_rules_words(const tartan_rules *rules)
{
    return (rules->count + 63) / 64;
}

tartan_status tartan_matcher_new(const tartan_rules *rules, tartan_matcher **matcher, tartan_error *error)
{
    if (!rules)
        return tn_api_missing(error, "rules object");
    tartan_matcher *made = malloc(sizeof *made);
    if (!made)
        return tn_api_memory(error);
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
    if (!matcher || (length && !trays) || !bits)
        return tn_api_missing(error, !matcher ? "matcher" : !bits ? "room for bits" : "plan");
    tn_error found;
    tn_status status = tn_api_trays(matcher->rules->plans.schema, trays, length, &found);
    if (status == TN_OK)
        status = tn_match(matcher->matcher, trays, length, bits, &found);
    return status == TN_OK ? TARTAN_OK : tn_api_fail(&found, error);
}

/* Plans that a thread takes at a time, so that it decides for some tens of microseconds. What comes of a share is the
 * same whoever takes it. */
enum { SHARE = 4096 };

/* Many plans to be matched. */
typedef struct request {
    const tartan_rules *rules;
    const uint32_t *trays;
    const size_t *ends;
    size_t count;
    tn_matcher **matchers; /* of each thread, once it has something to do */
    uint64_t *bits;        /* which rules; NULL: asked whether any does */
    uint8_t *matches;      /* whether any does */
    tn_watch *watch;
    atomic_size_t done; /* plans */
} request;

/* Says which plan an error is about. */
static void name_plan(size_t plan, tn_error *error)
{
    char message[sizeof error->message];
    memcpy(message, error->message, sizeof message);
    snprintf(error->message, sizeof error->message, "plan %zu: %s", plan + 1, message);
}

/* How many of the plans have trays of the schema, up to the first that has not, which is the error's. */
static size_t valid_plans(const tn_schema *schema, const tn_plan_array *plans, tn_error *error)
{
    size_t start = plans->begin;
    for (size_t i = 0; i < plans->count; start = plans->ends[i++])
        if (tn_api_trays(schema, plans->trays + start, plans->ends[i] - start, error) != TN_OK)
            return i;
    return plans->count;
}

static tn_status match_share(void *context, unsigned thread, size_t share, tn_error *error)
{
    request *asked = context;
    if (pthread_equal(asked->watch->caller, pthread_self()))
        tn_watch_tell(asked->watch, (double)asked->done, (double)asked->count);
    if (tn_watch_check(asked->watch, error) != TN_OK)
        return TN_STOPPED;
    size_t begin = share * SHARE, left = asked->count - begin, done = 0;
    tn_plan_array plans = {asked->trays, begin ? asked->ends[begin - 1] : 0, asked->ends + begin,
                           left < SHARE ? left : SHARE};
    tn_matcher **matcher = &asked->matchers[thread];
    tn_status status = *matcher ? TN_OK : tn_matcher_new(asked->rules->rules, matcher, error);
    if (status != TN_OK)
        return status;
    size_t asked_count = plans.count;
    plans.count = valid_plans(asked->rules->plans.schema, &plans, error);
    status = plans.count < asked_count ? TN_INVALID : TN_OK;
    tn_error found;
    tn_status matched =
        asked->bits
            ? tn_match_all(*matcher, &plans, asked->bits + begin * tartan_rules_words(asked->rules), &done, &found)
            : tn_match_any(*matcher, &plans, asked->matches + begin, &done, &found);
    if (matched != TN_OK)
        *error = found;
    asked->done += asked_count;
    if (matched != TN_OK || status != TN_OK)
        name_plan(begin + done, error);
    return matched != TN_OK ? matched : status;
}

static tn_status match_shares(request *asked, unsigned threads, tn_error *error)
{
    size_t shares = asked->count / SHARE + (asked->count % SHARE > 0);
    unsigned workers = threads ? threads : tn_crew_default();
    if (workers > TARTAN_THREADS_MAX)
        workers = TARTAN_THREADS_MAX;
    if (workers > shares)
        workers = shares ? (unsigned)shares : 1;
    asked->matchers = calloc(workers, sizeof *asked->matchers);
    tn_crew *crew = asked->matchers ? tn_crew_new(workers, NULL) : NULL;
    tn_status status = crew ? tn_crew_run(crew, shares, 1, match_share, asked, error) : tn_fail_memory(error);
    tn_crew_free(crew);
    for (unsigned i = 0; asked->matchers && i < workers; i++)
        tn_matcher_free(asked->matchers[i]);
    free(asked->matchers);
    return status;
}

tartan_status tn_api_plan_array(const uint32_t *trays, const size_t *ends, size_t count, tartan_error *error)
{
    for (size_t i = 1; i < count; i++)
        if (ends[i] < ends[i - 1])
            return tn_api_refuse(error, TARTAN_INVALID, "plan %zu ends before it begins", i + 1);
    if (count && ends[count - 1] && !trays)
        return tn_api_missing(error, "array of trays");
    return TARTAN_OK;
}

static tartan_status match_plans(request *asked, unsigned threads, const tartan_watch *given, tartan_error *error)
{
    tn_watch watch;
    tn_error found;
    if (!asked->rules || (asked->count && (!asked->ends || (!asked->bits && !asked->matches))))
        return tn_api_missing(error, asked->rules ? "room for results" : "rules object");
    tartan_status status = tn_api_plan_array(asked->trays, asked->ends, asked->count, error);
    if (status != TARTAN_OK)
        return status;
    asked->watch = &watch;
    status = tn_api_watch(given, &watch, error);
    if (status != TARTAN_OK)
        return status;
    return match_shares(asked, threads, &found) == TN_OK ? TARTAN_OK : tn_api_fail(&found, error);
}

tartan_status tartan_match_all(const tartan_rules *rules, const uint32_t *trays, const size_t *ends, size_t count,
                               unsigned threads, uint64_t *bits, const tartan_watch *watch, tartan_error *error)
{
    request asked = {.rules = rules, .trays = trays, .ends = ends, .count = count, .bits = bits};
    return match_plans(&asked, threads, watch, error);
}

tartan_status tartan_match_any(const tartan_rules *rules, const uint32_t *trays, const size_t *ends, size_t count,
                               unsigned threads, uint8_t *matches, const tartan_watch *watch, tartan_error *error)
{
    request asked = {.rules = rules, .trays = trays, .ends = ends, .count = count, .matches = matches};
    return match_plans(&asked, threads, watch, error);
}

/* ---- what objects are made over */

tartan_status tn_api_plans_begin(const tartan_module *module, const tartan_watch *watch, tn_api_plans *plans,
                                 tartan_error *error)
{
    if (!module)
        return tn_api_missing(error, "module");
    plans->module = *module->module;
    plans->module.watch = &plans->watch;
    return tn_api_watch(watch, &plans->watch, error);
}

void tn_api_plans_made(tn_api_plans *plans)
{
    plans->watch.go_on = NULL;
}

void tn_api_plans_clear(tn_api_plans *plans)
{
    tn_schema_free(plans->schema);
    plans->schema = NULL;
}
