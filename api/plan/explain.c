/* The C interface to why rules match a plan or do not, and to the plans that a library keeps nearest to it. */
#include <stdlib.h>
#include <string.h>

#include "api/plan/plan.h"
#include "runtime/module/code.h"
#include "runtime/plan/analysis/explain.h"
#include "runtime/plan/library/near.h"

_Static_assert(TARTAN_NO_PART == TN_NO_WHY && TARTAN_NO_NUMBER == TN_NO_NUMBER, "the same numbers for none");
_Static_assert(sizeof(tartan_stretch) == sizeof(tn_stretch) &&
                   offsetof(tartan_stretch, end) == offsetof(tn_stretch, end),
               "stretches are the same");

/* A rule or a clause. */
typedef struct verdict {
    const char *name, *doc;
    const tn_clause_record *clause; /* NULL for a rule */
    tn_explanation why;
    char **texts; /* [node] */
} verdict;

struct tartan_explanation {
    tn_api_plans plans;
    uint32_t *trays;
    size_t length;
    const tn_library_record *library; /* or NULL */
    verdict *verdicts;
    size_t count;
};

void tartan_explanation_free(tartan_explanation *e)
{
    if (!e)
        return;
    for (size_t i = 0; i < e->count; i++) {
        verdict *v = &e->verdicts[i];
        for (uint32_t n = 0; v->texts && n < v->why.node_count; n++)
            free(v->texts[n]);
        free(v->texts);
        tn_explanation_clear(&v->why);
    }
    free(e->verdicts);
    free(e->trays);
    tn_api_plans_clear(&e->plans);
    free(e);
}

/* The parts as their author wrote them. */
static tn_status write_texts(verdict *v, tn_error *error)
{
    char text[TN_PART_TEXT_MAX];
    v->texts = calloc((size_t)v->why.node_count + 1, sizeof *v->texts);
    for (uint32_t n = 0; v->texts && n < v->why.node_count; n++) {
        const tn_why *node = &v->why.nodes[n];
        tn_part_text(&v->why.trees[node->tree], node->part, text, sizeof text);
        if (!(v->texts[n] = strdup(text)))
            return tn_fail_memory(error);
    }
    return v->texts ? TN_OK : tn_fail_memory(error);
}

static tn_status explain(tartan_explanation *e, uint32_t function, verdict added, tn_error *error)
{
    verdict *v = &e->verdicts[e->count++];
    *v = added;
    tn_status status = tn_explain(e->plans.schema, function, e->trays, e->length, 0, &v->why, error);
    return status == TN_OK ? write_texts(v, error) : status;
}

static tn_status explain_clauses(tartan_explanation *e, tn_error *error)
{
    const tn_module *module = &e->plans.module;
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < e->library->clause_count && status == TN_OK; i++) {
        const tn_clause_record *clause = &module->CLAUSE_records[e->library->clause_first + i];
        uint32_t rule = tn_function_rule(module, clause->holds);
        const char *doc = tn_text(module, clause->doc);
        if (!*doc && rule != UINT32_MAX)
            doc = tn_text(module, module->RULE_records[rule].doc);
        status = explain(e, clause->holds,
                         (verdict){.name = tn_text(module, clause->name), .doc = doc, .clause = clause}, error);
    }
    return status;
}

static tn_status explain_rules(tartan_explanation *e, const uint32_t *records, size_t count, tn_error *error)
{
    const tn_module *module = &e->plans.module;
    tn_status status = TN_OK;
    for (size_t i = 0; i < count && status == TN_OK; i++) {
        const tn_rule_record *rule = &module->RULE_records[records[i]];
        status = explain(e, rule->holds,
                         (verdict){.name = tn_text(module, rule->name), .doc = tn_text(module, rule->doc)}, error);
    }
    return status;
}

/* All but the verdicts; `schema` is a SCHEMA record. */
static tn_status prepare(tartan_explanation *e, uint32_t schema, const uint32_t *trays, size_t length, size_t verdicts,
                         tn_error *error)
{
    tn_status status = tn_schema_new(&e->plans.module, schema, 0, &e->plans.schema, error);
    if (status == TN_OK)
        status = tn_api_trays(e->plans.schema, trays, length, error);
    if (status != TN_OK)
        return status;
    e->trays = malloc((length + 1) * sizeof *e->trays);
    e->verdicts = calloc(verdicts + 1, sizeof *e->verdicts);
    if (!e->trays || !e->verdicts)
        return tn_fail_memory(error);
    if (length)
        memcpy(e->trays, trays, length * sizeof *trays);
    e->length = length;
    return TN_OK;
}

static tartan_status begin(const tartan_module *module, const uint32_t *trays, size_t length, const tartan_watch *watch,
                           tartan_explanation **explanation, tartan_error *error)
{
    if (length && !trays)
        return tn_api_missing(error, "plan");
    tartan_explanation *made = calloc(1, sizeof *made);
    if (!made)
        return tn_api_memory(error);
    tartan_status status = tn_api_plans_begin(module, watch, &made->plans, error);
    if (status == TARTAN_OK)
        *explanation = made;
    else
        tartan_explanation_free(made);
    return status;
}

static tartan_status finish(tartan_explanation *made, tartan_status status, tartan_explanation **explanation)
{
    tn_api_plans_made(&made->plans);
    if (status == TARTAN_OK)
        *explanation = made;
    else
        tartan_explanation_free(made);
    return status;
}

tartan_status tartan_explain_rules(const tartan_module *module, const char *const *names, size_t count,
                                   const uint32_t *trays, size_t length, const tartan_watch *watch,
                                   tartan_explanation **explanation, tartan_error *error)
{
    tartan_explanation *made = NULL;
    uint32_t *records = NULL;
    size_t found_count;
    tn_error found;
    tartan_status status = begin(module, trays, length, watch, &made, error);
    if (status != TARTAN_OK)
        return status;
    status = tn_api_rules_find(&made->plans.module, names, count, &records, &found_count, error);
    if (status != TARTAN_OK)
        return finish(made, status, explanation);
    uint32_t schema = made->plans.module.RULE_records[records[0]].schema;
    tn_status explained = prepare(made, schema, trays, length, found_count, &found);
    if (explained == TN_OK)
        explained = explain_rules(made, records, found_count, &found);
    free(records);
    return finish(made, explained == TN_OK ? TARTAN_OK : tn_api_fail(&found, error), explanation);
}

tartan_status tartan_explain_library(const tartan_module *module, const char *name, const uint32_t *trays,
                                     size_t length, const tartan_watch *watch, tartan_explanation **explanation,
                                     tartan_error *error)
{
    tartan_explanation *made = NULL;
    uint32_t index;
    tn_error found;
    tartan_status status = begin(module, trays, length, watch, &made, error);
    if (status != TARTAN_OK)
        return status;
    status = tn_api_library_find(&made->plans.module, name, &index, error);
    if (status != TARTAN_OK)
        return finish(made, status, explanation);
    made->library = &made->plans.module.LIBRARY_records[index];
    tn_status explained = prepare(made, made->library->schema, trays, length, made->library->clause_count, &found);
    if (explained == TN_OK)
        explained = explain_clauses(made, &found);
    return finish(made, explained == TN_OK ? TARTAN_OK : tn_api_fail(&found, error), explanation);
}

/* ---- looking at it */

static bool matches(const verdict *v)
{
    return v->why.nodes[0].matched;
}

static bool drops(const verdict *v)
{
    return v->clause && matches(v) == (v->clause->kind == TN_CLAUSE_PRUNE);
}

bool tartan_explanation_length_drops(const tartan_explanation *e)
{
    return e->library && (e->length < e->library->trays_min || e->length > e->library->trays_max);
}

bool tartan_explanation_kept(const tartan_explanation *e)
{
    bool kept = e->library && !tartan_explanation_length_drops(e);
    for (size_t i = 0; i < e->count && kept; i++)
        kept = !drops(&e->verdicts[i]);
    return kept;
}

size_t tartan_explanation_count(const tartan_explanation *e)
{
    return e->count;
}

tartan_status tartan_explanation_verdict(const tartan_explanation *e, size_t i, tartan_verdict *result,
                                         tartan_error *error)
{
    if (!e || i >= e->count)
        return e ? tn_api_refuse(error, TARTAN_INVALID, "there is no rule or clause %zu", i)
                 : tn_api_missing(error, "explanation");
    const verdict *v = &e->verdicts[i];
    const tartan_verdict own = {.name = v->name,
                                .doc = v->doc,
                                .matches = matches(v),
                                .drops = drops(v),
                                .prunes = v->clause && v->clause->kind == TN_CLAUSE_PRUNE,
                                .part_count = v->why.node_count};
    return TN_API_GIVE(tartan_verdict, result, &own, error);
}

tartan_status tartan_explanation_part(const tartan_explanation *e, size_t i, size_t part, tartan_part *result,
                                      tartan_error *error)
{
    if (!e || i >= e->count || part >= e->verdicts[i].why.node_count)
        return e ? tn_api_refuse(error, TARTAN_INVALID, "there is no part %zu of rule or clause %zu", part, i)
                 : tn_api_missing(error, "explanation");
    const verdict *v = &e->verdicts[i];
    const tn_why *node = &v->why.nodes[part];
    const tn_part *of = tn_why_part(&v->why, node);
    const tn_module *module = &e->plans.module;
    const tn_source_map_record *place = tn_module_place(module, of->root);
    tartan_part own = {.kind = tn_part_word(of->kind),
                       .text = v->texts[part],
                       .matched = node->matched,
                       .mirrored = node->mirrored,
                       .whole = node->whole,
                       .absent = node->absent,
                       .cut = node->cut,
                       .region = {node->region.begin, node->region.end},
                       .stretches = (const tartan_stretch *)(const void *)(v->why.stretches + node->stretch_first),
                       .stretch_count = node->stretch_count,
                       .number = node->number,
                       .closest = node->closest,
                       .parent = node->parent,
                       .first = node->first,
                       .next = node->next};
    if (place && place->file < module->SOURCE_count) {
        own.path = tn_text(module, module->SOURCE_records[place->file].path);
        own.source_begin = place->begin;
        own.source_end = place->end;
    }
    return TN_API_GIVE(tartan_part, result, &own, error);
}

/* ---- the nearest plans */

struct tartan_near {
    tn_near near;
};

static tn_status find_near(tn_api_plans *plans, uint32_t index, const uint32_t *trays, size_t length, size_t most,
                           tn_near *near, tn_error *error)
{
    tn_near_finder *finder = NULL;
    const tn_near_options options = {0};
    tn_status status =
        tn_schema_new(&plans->module, plans->module.LIBRARY_records[index].schema, 0, &plans->schema, error);
    if (status == TN_OK)
        status = tn_api_trays(plans->schema, trays, length, error);
    if (status == TN_OK)
        status = tn_near_finder_new(plans->schema, index, &options, &finder, error);
    if (status == TN_OK)
        status = tn_near_find(finder, trays, length, most, near, error);
    tn_near_finder_free(finder);
    return status;
}

tartan_status tartan_near_find(const tartan_module *module, const char *name, const uint32_t *trays, size_t length,
                               size_t most, const tartan_watch *watch, tartan_near **near, tartan_error *error)
{
    tn_api_plans plans = {0};
    uint32_t index;
    tn_error found;
    if (length && !trays)
        return tn_api_missing(error, "plan");
    tartan_near *made = calloc(1, sizeof *made);
    if (!made)
        return tn_api_memory(error);
    tartan_status status = tn_api_plans_begin(module, watch, &plans, error);
    if (status == TARTAN_OK)
        status = tn_api_library_find(&plans.module, name, &index, error);
    if (status == TARTAN_OK && find_near(&plans, index, trays, length, most, &made->near, &found) != TN_OK)
        status = tn_api_fail(&found, error);
    tn_api_plans_clear(&plans);
    if (status == TARTAN_OK)
        *near = made;
    else
        tartan_near_free(made);
    return status;
}

void tartan_near_free(tartan_near *near)
{
    if (!near)
        return;
    tn_near_clear(&near->near);
    free(near);
}

size_t tartan_near_count(const tartan_near *near)
{
    return near->near.count;
}

uint32_t tartan_near_cost(const tartan_near *near)
{
    return near->near.cost;
}

bool tartan_near_more(const tartan_near *near)
{
    return near->near.more;
}

const uint32_t *tartan_near_plan(const tartan_near *near, size_t i, size_t *length)
{
    if (i >= near->near.count)
        return NULL;
    *length = near->near.plans[i].length;
    return near->near.plans[i].trays;
}
