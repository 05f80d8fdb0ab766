/* The C interface to what rules and libraries mean, and to what an edit does to a library. */
#include <stdlib.h>

#include "api/plan/plan.h"
#include "runtime/module/code.h"
#include "runtime/plan/analysis/analysis.h"
#include "runtime/plan/library/diff.h"

/* ---- what an edit does to a library */

_Static_assert((int)TARTAN_REMOVED == (int)TN_CLAUSE_REMOVED, "changes are the same numbers");

typedef struct clause_texts {
    char *removes, *adds;
} clause_texts;

struct tartan_diff {
    tn_library_diff *diff;
    const tn_module *modules[2];
    tartan_library parts[TN_DIFF_PARTS];
    clause_texts *texts; /* [clauses] */
};

static tartan_status count_text(const mpz_t number, char **text, tartan_error *error)
{
    if (mpz_sgn(number) >= 0)
        return tn_api_decimal(number, text, error);
    *text = calloc(2, 1); /* past a limit */
    if (!*text)
        return tn_api_memory(error);
    **text = '-';
    return TARTAN_OK;
}

static tartan_status write_texts(tartan_diff *d, tartan_error *error)
{
    size_t count = tn_library_diff_clauses(d->diff);
    tartan_status status = TARTAN_OK;
    d->texts = calloc(count + 1, sizeof *d->texts);
    if (!d->texts)
        return tn_api_memory(error);
    for (size_t i = 0; i < count && status == TARTAN_OK; i++) {
        const tn_changed_clause *c = tn_library_diff_clause(d->diff, i);
        status = count_text(c->removes, &d->texts[i].removes, error);
        if (status == TARTAN_OK)
            status = count_text(c->adds, &d->texts[i].adds, error);
    }
    return status;
}

static tartan_status compare(const tartan_library *before, const tartan_library *after, const tartan_watch *given,
                             tartan_diff *d, tartan_error *error)
{
    tn_watch watch;
    tn_error found;
    if (!before || !after)
        return tn_api_missing(error, "library");
    if (!before->owned || !after->owned)
        return tn_api_refuse(error, TARTAN_INVALID, "a part of a diff has no clauses to be compared");
    tartan_status status = tn_api_watch(given, &watch, error);
    if (status != TARTAN_OK)
        return status;
    if (tn_library_diff_new(before->library, after->library, 0, &watch, &d->diff, &found) != TN_OK)
        return tn_api_fail(&found, error);
    d->modules[0] = &before->plans.module;
    d->modules[1] = &after->plans.module;
    for (int part = 0; part < TN_DIFF_PARTS; part++)
        d->parts[part] =
            (tartan_library){.schema = before->schema, .library = tn_library_diff_part(d->diff, (tn_diff_part)part)};
    return write_texts(d, error);
}

tartan_status tartan_diff_new(const tartan_library *before, const tartan_library *after, const tartan_watch *watch,
                              tartan_diff **diff, tartan_error *error)
{
    tartan_diff *made = calloc(1, sizeof *made);
    if (!made)
        return tn_api_memory(error);
    tartan_status status = compare(before, after, watch, made, error);
    if (status == TARTAN_OK)
        *diff = made;
    else
        tartan_diff_free(made);
    return status;
}

void tartan_diff_free(tartan_diff *diff)
{
    if (!diff)
        return;
    for (size_t i = 0; diff->texts && i < tn_library_diff_clauses(diff->diff); i++) {
        free(diff->texts[i].removes);
        free(diff->texts[i].adds);
    }
    free(diff->texts);
    tn_library_diff_free(diff->diff);
    free(diff);
}

const tartan_library *tartan_diff_removed(const tartan_diff *diff)
{
    return &diff->parts[TN_DIFF_REMOVED];
}

const tartan_library *tartan_diff_added(const tartan_diff *diff)
{
    return &diff->parts[TN_DIFF_ADDED];
}

const tartan_library *tartan_diff_kept(const tartan_diff *diff)
{
    return &diff->parts[TN_DIFF_KEPT];
}

size_t tartan_diff_clause_count(const tartan_diff *diff)
{
    return tn_library_diff_clauses(diff->diff);
}

tartan_status tartan_diff_clause(const tartan_diff *diff, size_t i, tartan_changed_clause *clause, tartan_error *error)
{
    if (!diff || i >= tn_library_diff_clauses(diff->diff))
        return diff ? tn_api_refuse(error, TARTAN_INVALID, "there is no changed clause %zu", i)
                    : tn_api_missing(error, "diff");
    const tn_changed_clause *c = tn_library_diff_clause(diff->diff, i);
    int side = c->before == UINT32_MAX;
    uint32_t record = side ? c->after : c->before;
    tartan_changed_clause own = {
        .change = (tartan_change)c->change, .removes = diff->texts[i].removes, .adds = diff->texts[i].adds};
    if (!c->lengths && record < diff->modules[side]->CLAUSE_count)
        own.name = tn_text(diff->modules[side], diff->modules[side]->CLAUSE_records[record].name);
    return TN_API_GIVE(tartan_changed_clause, clause, &own, error);
}

_Static_assert((int)TARTAN_FOUND_NOT_ANALYSED == (int)TN_FOUND_NOT_ANALYSED, "findings are the same numbers");
_Static_assert((int)TARTAN_RULES_OVERLAP == (int)TN_RULES_OVERLAP, "relations are the same numbers");

/* ---- what rules and libraries mean */

struct tartan_analysis {
    tn_api_plans plans;
    tn_plan_analysis *analysis;
};

/* The schema that the file's own rules and libraries are about. */
static tartan_status find_schema(const tn_module *m, uint32_t *schema, tartan_error *error)
{
    *schema = UINT32_MAX;
    bool several = false;
    for (size_t i = 0; i < m->RULE_count + m->LIBRARY_count; i++) {
        const tn_rule_record *rule = i < m->RULE_count ? &m->RULE_records[i] : NULL;
        const tn_library_record *library = rule ? NULL : &m->LIBRARY_records[i - m->RULE_count];
        uint32_t of = rule ? rule->schema : library->schema;
        if ((rule ? rule->flags : library->flags) & TN_IMPORTED)
            continue;
        several |= *schema != UINT32_MAX && *schema != of;
        *schema = of;
    }
    if (*schema == UINT32_MAX)
        return tn_api_refuse(error, TARTAN_INVALID, "the module has no rules or libraries of its own");
    return several ? tn_api_refuse(error, TARTAN_INVALID, "the module's rules and libraries are of several schemas")
                   : TARTAN_OK;
}

tartan_status tartan_analysis_new(const tartan_module *module, uint32_t max_states, const tartan_watch *watch,
                                  tartan_analysis **analysis, tartan_error *error)
{
    uint32_t schema;
    tn_error found;
    tn_plan_analysis_options options = {.max_states = max_states};
    tartan_analysis *made = calloc(1, sizeof *made);
    if (!made)
        return tn_api_memory(error);
    tartan_status status = tn_api_plans_begin(module, watch, &made->plans, error);
    if (status == TARTAN_OK)
        status = find_schema(&made->plans.module, &schema, error);
    if (status == TARTAN_OK && (tn_schema_new(&made->plans.module, schema, 0, &made->plans.schema, &found) != TN_OK ||
                                tn_plan_analysis_new(made->plans.schema, &options, &made->analysis, &found) != TN_OK))
        status = tn_api_fail(&found, error);
    if (status != TARTAN_OK) {
        tartan_analysis_free(made);
        return status;
    }
    tn_api_plans_made(&made->plans);
    *analysis = made;
    return TARTAN_OK;
}

void tartan_analysis_free(tartan_analysis *analysis)
{
    if (!analysis)
        return;
    tn_plan_analysis_free(analysis->analysis);
    tn_api_plans_clear(&analysis->plans);
    free(analysis);
}

const tartan_schema *tartan_analysis_schema(const tartan_analysis *analysis)
{
    return tn_api_public_schema(analysis->plans.schema);
}

/* ---- findings */

static const char *rule_name(const tn_module *m, uint32_t rule)
{
    return rule < m->RULE_count ? tn_text(m, m->RULE_records[rule].name) : NULL;
}

/* A place in the source. */
typedef struct place {
    uint32_t file, begin, end;
} place;

/* Where it is written: the part that it is about, or else the clause, the library or the rule. */
static place place_of(const tn_module *m, const tn_plan_analysis_finding *f)
{
    const tn_source_map_record *part =
        f->found == TN_FOUND_VACUOUS || f->found == TN_FOUND_NO_TRAY ? tn_module_place(m, f->offset) : NULL;
    if (part)
        return (place){part->file, part->begin, part->end};
    if (f->clause < m->CLAUSE_count) {
        const tn_clause_record *c = &m->CLAUSE_records[f->clause];
        return (place){c->file, c->begin, c->end};
    }
    if (f->library < m->LIBRARY_count) {
        const tn_library_record *l = &m->LIBRARY_records[f->library];
        return (place){l->file, l->begin, l->end};
    }
    if (f->rule < m->RULE_count) {
        const tn_rule_record *r = &m->RULE_records[f->rule];
        return (place){r->file, r->begin, r->end};
    }
    return (place){UINT32_MAX, 0, 0};
}

size_t tartan_analysis_count(const tartan_analysis *analysis)
{
    return tn_plan_analysis_count(analysis->analysis);
}

tartan_status tartan_analysis_finding(const tartan_analysis *analysis, size_t i, tartan_finding *finding,
                                      tartan_error *error)
{
    if (!analysis || i >= tn_plan_analysis_count(analysis->analysis))
        return analysis ? tn_api_refuse(error, TARTAN_INVALID, "there is no finding %zu", i)
                        : tn_api_missing(error, "analysis");
    const tn_module *m = &analysis->plans.module;
    const tn_plan_analysis_finding *f = tn_plan_analysis_get(analysis->analysis, i);
    tartan_finding own = {.kind = (tartan_finding_kind)f->found,
                          .rule = rule_name(m, f->rule),
                          .other = rule_name(m, f->other),
                          .message = f->why ? f->why->message : NULL};
    if (f->library < m->LIBRARY_count)
        own.library = tn_text(m, m->LIBRARY_records[f->library].name);
    if (f->clause < m->CLAUSE_count)
        own.clause = tn_text(m, m->CLAUSE_records[f->clause].name);
    place at = place_of(m, f);
    if (at.file < m->SOURCE_count) {
        own.path = tn_text(m, m->SOURCE_records[at.file].path);
        own.source_begin = at.begin;
        own.source_end = at.end;
    }
    if (f->plan_count && f->plans[0].shown) {
        own.trays = f->plans[0].trays;
        own.tray_count = f->plans[0].length;
    }
    return TN_API_GIVE(tartan_finding, finding, &own, error);
}

/* ---- relations */

size_t tartan_analysis_rule_count(const tartan_analysis *analysis)
{
    return tn_plan_analysis_rule_count(analysis->analysis);
}

const char *tartan_analysis_rule_name(const tartan_analysis *analysis, size_t i)
{
    if (i >= tn_plan_analysis_rule_count(analysis->analysis))
        return NULL;
    return rule_name(&analysis->plans.module, tn_plan_analysis_rule(analysis->analysis, i));
}

tartan_relation tartan_analysis_relation(const tartan_analysis *analysis, size_t i, size_t j)
{
    size_t count = tn_plan_analysis_rule_count(analysis->analysis);
    return i < count && j < count ? (tartan_relation)tn_plan_analysis_relation(analysis->analysis, i, j)
                                  : TARTAN_RULES_UNKNOWN;
}
