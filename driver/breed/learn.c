/* Scores bred pruning rules by examples of good and bad plans. */
#include "driver/breed/learn.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "driver/open/files.h"
#include "driver/open/open.h"
#include "runtime/base/array.h"
#include "runtime/plan/match/rules.h"
#include "runtime/plan/picture/draw_rule.h"
#include "runtime/plan/store/sqlite.h"
#include "runtime/plan/text/stream.h"

#define EXAMPLES_MAX 1000000u
#define STATES_MAX 2000u /* of a rule's automaton: what needs more is no rule that a person would keep */

static const char sentence_name[] = "the sentence";

typedef struct example {
    size_t first; /* tray */
    size_t length;
    bool drop;
} example;

struct tn_learner {
    example *examples;
    size_t count, capacity;
    tn_stdlib_dirs dirs;
    tn_files files;   /* what sentences use, each read once */
    tn_opened opened; /* what declares the schema */
    char *user;       /* the path of the file that names it */
    tn_schema *schema;
    tn_tray *trays;
    size_t tray_count, tray_capacity;
    double length_weight;
    bool separately;
};

void tn_learner_free(tn_learner *l)
{
    if (!l)
        return;
    free(l->examples);
    free(l->trays);
    tn_schema_free(l->schema);
    tn_close(&l->opened);
    tn_files_clear(&l->files);
    tn_stdlib_dirs_clear(&l->dirs);
    free(l->user);
    free(l);
}

static tn_status add_example(tn_learner *l, const tn_plan *plan, bool drop, tn_error *error)
{
    if (l->count == EXAMPLES_MAX)
        return tn_fail(error, TN_LIMIT, E_EXAMPLES, "there are more than %u examples, the limit", EXAMPLES_MAX);
    if (!tn_array_reserve_from(&l->examples, &l->capacity, 256, l->count, 1, sizeof *l->examples) ||
        !tn_array_reserve(&l->trays, &l->tray_capacity, l->tray_count, plan->length, sizeof *l->trays))
        return tn_fail_memory(error);
    l->examples[l->count++] = (example){l->tray_count, plan->length, drop};
    if (plan->length)
        memcpy(l->trays + l->tray_count, plan->trays, plan->length * sizeof *plan->trays);
    l->tray_count += plan->length;
    return TN_OK;
}

static tn_status read_examples(tn_learner *l, const tn_schema *schema, const char *path, bool drop, tn_error *error)
{
    tn_reader_options options = {.sqlite = tn_plan_sqlite()};
    tn_plan_reader *reader = NULL;
    const tn_plan *plan;
    tn_status status = tn_plan_reader_open(schema, path, &options, &reader, error);
    if (status != TN_OK)
        return status;
    while ((status = tn_plan_reader_next(reader, &plan, error)) == TN_OK && plan)
        if ((status = add_example(l, plan, drop, error)) != TN_OK)
            break;
    tn_plan_reader_free(reader);
    return status;
}

/* Compiles a text of rules; `name` is where what it uses is looked for. */
static tn_status open_rule(tn_files *files, const char *name, const char *text, size_t size, tn_opened *opened)
{
    tn_compile_options options = {.resolver = tn_files_resolver(files)};
    return tn_open_text(TN_NOTATION(plan), &(tn_input){.text = text, .size = size, .name = name}, &options, opened);
}

/* Compiles a rule that only serves to have the schema. */
static tn_status find_schema(tn_learner *l, const char *name, const char *user, tn_error *error)
{
    char text[320];
    snprintf(text, sizeof text, "use \"%.200s\"\nrule learned = any\n", name);
    l->user = strdup(user);
    if (!l->user)
        return tn_fail_memory(error);
    tn_status status = open_rule(&l->files, l->user, text, strlen(text), &l->opened);
    if (status != TN_OK) {
        status = tn_fail(error, TN_INVALID, E_EXAMPLES, "the schema `%.200s` of the examples cannot be used", name);
        tn_error_help(error, "name a .plan file that declares it, or one of the standard library, as \"lahave\"");
    } else {
        const tn_module *module = l->opened.module;
        status = tn_schema_new(module, module->RULE_records[module->RULE_count - 1].schema, 0, &l->schema, error);
    }
    return status;
}

const tn_module *tn_learner_schema(const tn_learner *l)
{
    return l->opened.module;
}

tn_status tn_learner_new(const char *schema, const char *user, double length_weight, bool separately,
                         tn_learner **learner, tn_error *error)
{
    tn_learner *l = calloc(1, sizeof *l);
    *learner = l;
    if (!l)
        return tn_fail_memory(error);
    l->length_weight = length_weight;
    l->separately = separately;
    tn_status status = tn_stdlib_dirs_find(&l->dirs, error);
    tn_files_begin(&l->files, &l->dirs);
    if (status == TN_OK)
        status = find_schema(l, schema, user, error);
    if (status != TN_OK) {
        tn_learner_free(l);
        *learner = NULL;
    }
    return status;
}

tn_status tn_learner_read(tn_learner *learner, const char *path, bool drop, tn_error *error)
{
    size_t before = learner->count;
    tn_status status = read_examples(learner, learner->schema, path, drop, error);
    if (status != TN_OK || learner->count > before)
        return status;
    tn_fail(error, TN_INVALID, E_EXAMPLES, "%.200s holds no plans to learn from", path);
    tn_error_help(error, "one plan a line, as `tartan sample` writes them");
    return TN_INVALID;
}

/* ---- scoring a rule */

static tn_status count_wrong(const tn_learner *l, const tn_rules *rules, uint64_t *wrong, tn_error *error)
{
    tn_matcher *matcher = NULL;
    tn_status status = tn_matcher_new(rules, &matcher, error);
    *wrong = 0;
    for (size_t i = 0; i < l->count && status == TN_OK; i++) {
        uint64_t bits = 0;
        status = tn_match(matcher, l->trays + l->examples[i].first, l->examples[i].length, &bits, error);
        *wrong += (bits & 1) != l->examples[i].drop;
    }
    tn_matcher_free(matcher);
    return status;
}

static tn_status judge(const tn_learner *l, const tn_module *module, uint64_t *wrong, tn_error *error)
{
    if (module->RULE_count == 0)
        return tn_fail(error, TN_INVALID, TN_CODE_NONE, "the sentence holds no rule");
    const tn_rule_record *rule = &module->RULE_records[module->RULE_count - 1];
    tn_rules_options options = {.engine = TN_ENGINE_DFA, .max_states = STATES_MAX};
    tn_schema *schema = NULL;
    tn_rules *rules = NULL;
    tn_status status = tn_schema_new(module, rule->schema, 0, &schema, error);
    if (status == TN_OK && schema->tray_count != l->schema->tray_count)
        status = tn_fail(error, TN_INVALID, TN_CODE_NONE, "the rule is of another schema than the examples");
    if (status == TN_OK)
        status = tn_rules_new(schema, &rule->holds, 1, &options, &rules, error);
    if (status == TN_OK)
        status = count_wrong(l, rules, wrong, error);
    tn_rules_free(rules);
    tn_schema_free(schema);
    return status;
}

static tn_status score_rule(void *context, unsigned thread, const char *sentence, size_t size, tn_score *score,
                            char message[200], tn_error *error)
{
    tn_learner *l = context;
    tn_opened opened;
    tn_error own = {0};
    uint64_t wrong = 0;
    (void)thread;
    tn_status status = open_rule(&l->files, sentence_name, sentence, size, &opened);
    if (status != TN_OK)
        tn_open_error(&opened, status, &own);
    else
        status = judge(l, opened.module, &wrong, &own);
    tn_close(&opened);
    if (status != TN_OK)
        return tn_score_refuse(status, &own, score, message, error);
    score->objectives[0] = (double)wrong + (l->separately ? 0 : l->length_weight * (double)size);
    score->objectives[1] = (double)size;
    return TN_OK;
}

/* "length-weight 0.01" */
static tn_status adjust(void *context, const char *change, tn_error *error)
{
    tn_learner *l = context;
    static const char name[] = "length-weight ";
    char *end = NULL;
    double weight = strncmp(change, name, sizeof name - 1) == 0 ? strtod(change + sizeof name - 1, &end) : -1;
    if (!end || end == change + sizeof name - 1 || *end || !(weight >= 0 && weight <= 1000)) {
        tn_fail(error, TN_INVALID, E_EVOLUTION_VALUE, "`%.100s` changes nothing that this run has", change);
        tn_error_help(error, "a run that learns a rule has `length-weight X`, from 0 to 1000");
        return TN_INVALID;
    }
    l->length_weight = weight;
    return TN_OK;
}

tn_evaluator tn_learner_evaluator(tn_learner *learner)
{
    return (tn_evaluator){
        .context = learner, .objectives = learner->separately ? 2 : 1, .evaluate = score_rule, .adjust = adjust};
}

/* ---- pictures */

tn_status tn_learner_draw(tn_learner *l, const char *sentence, tn_picture *to, tn_error *error)
{
    tn_opened opened;
    tn_schema *schema = NULL;
    tn_status status = open_rule(&l->files, sentence_name, sentence, strlen(sentence), &opened);
    const tn_module *module = opened.module;
    if (status != TN_OK || module->RULE_count == 0) {
        status = tn_fail(error, TN_INVALID, TN_CODE_NONE, "the sentence holds no rule");
    } else {
        uint32_t rule = (uint32_t)module->RULE_count - 1;
        tn_drawn_rule drawn = tn_drawn_rule_of(module, rule);
        status = tn_schema_new(module, module->RULE_records[rule].schema, 0, &schema, error);
        if (status == TN_OK)
            status = tn_rules_draw(schema, &drawn, 1, to, error);
    }
    tn_schema_free(schema);
    tn_close(&opened);
    return status;
}
