/* Analyses the rules of a file and words what is found. */
#include "driver/plan/analysis.h"

#include <stdlib.h>
#include <string.h>

#include "compiler/plan/syntax/program.h"
#include "driver/house/survey.h"
#include "driver/open/findings.h"
#include "runtime/module/code.h"
#include "runtime/plan/measure/never.h"
#include "runtime/plan/schema/sum.h"
#include "runtime/plan/search/search.h"
#include "runtime/plan/text/text.h"

/* One finding being reported. */
typedef struct teller {
    tn_finder finder;
    tn_opened *opened;
    const tn_module *module;
    const tn_schema *schema;
    const tn_plan_analysis_finding *finding;
    const tn_plan_analysis *analysis; /* it is number `index` of these */
    uint32_t index;
} teller;

/* ---- names and places */

static const char *rule_name(const teller *t, uint32_t rule)
{
    return tn_text(t->module, t->module->RULE_records[rule].name);
}

static const char *clause_name(const teller *t, uint32_t clause)
{
    return tn_text(t->module, t->module->CLAUSE_records[clause].name);
}

static const char *library_name(const teller *t)
{
    return tn_text(t->module, t->module->LIBRARY_records[t->finding->library].name);
}

static tn_span rule_span(const teller *t, uint32_t index)
{
    const tn_rule_record *rule = &t->module->RULE_records[index];
    return tn_finding_name_span(&t->finder, (tn_span){rule->file, rule->begin, rule->end}, "rule",
                                tn_text(t->module, rule->name));
}

static tn_span library_span(const teller *t)
{
    const tn_library_record *library = &t->module->LIBRARY_records[t->finding->library];
    return tn_finding_name_span(&t->finder, (tn_span){library->file, library->begin, library->end}, "library",
                                library_name(t));
}

static tn_span clause_span(const teller *t, uint32_t index)
{
    const tn_clause_record *clause = &t->module->CLAUSE_records[index];
    return (tn_span){clause->file, clause->begin, clause->end};
}

static tn_found_item rule_item(const teller *t, uint32_t rule)
{
    return (tn_found_item){rule_name(t, rule), rule_span(t, rule), t->module->RULE_records[rule].flags & TN_IMPORTED};
}

static tn_found_item clause_item(const teller *t, uint32_t clause)
{
    return (tn_found_item){clause_name(t, clause), clause_span(t, clause), false};
}

static tn_found_item library_item(const teller *t)
{
    return (tn_found_item){library_name(t), library_span(t), false};
}

/* ---- telling */

static tn_diagnostics *list_of(const teller *t)
{
    return &t->opened->compilation.diagnostics;
}

/* The plan as a line, if there is one to show; the caller frees it. */
static tn_status plan_text(const teller *t, const tn_shown_plan *plan, tn_buffer *text)
{
    *text = (tn_buffer){0};
    if (!plan->shown)
        return TN_OK;
    bool ok = plan->length ? tn_plan_write_line(t->schema, plan->trays, plan->length, text)
                           : tn_buffer_printf(text, "the plan without trays");
    return ok ? TN_OK : tn_fail_memory(NULL);
}

static bool is_allowed(const teller *t, tn_code code, tn_span span)
{
    return tn_finding_allowed(&t->finder, code, span);
}

static tn_status tell_extreme(const teller *t)
{
    const tn_found_item rule = rule_item(t, t->finding->rule);
    const tn_rule_record *record = &t->module->RULE_records[t->finding->rule];
    if (!tn_finding_explained(&t->finder, (tn_span){record->file, record->begin, record->end}))
        tn_report_extreme(&t->finder, &rule, t->finding->found == TN_FOUND_NEVER);
    return TN_OK;
}

static tn_status tell_subsumed(const teller *t)
{
    const tn_plan_analysis_finding *f = t->finding;
    tn_span span = rule_span(t, f->rule), other = rule_span(t, f->other);
    if (is_allowed(t, W_SUBSUMED, span) || is_allowed(t, W_SUBSUMED, other))
        return TN_OK;
    const char *name = rule_name(t, f->rule), *wider = rule_name(t, f->other);
    tn_buffer plan;
    tn_diagnostic *d =
        tn_report(list_of(t), W_SUBSUMED, span, "`%s` matches every plan that `%s` matches", wider, name);
    tn_note(list_of(t), d, &other, "`%s` is here", wider);
    tn_help(list_of(t), d,
            "where both prune, `%s` is enough; if `%s` is for something else, write `allow W003` before its `=`", wider,
            name);
    tn_status status = plan_text(t, f->plans, &plan);
    if (status == TN_OK && plan.data)
        tn_note(list_of(t), d, NULL, "only `%s` matches: %s", wider, plan.data);
    free(plan.data);
    return status;
}

static tn_status tell_equivalent(const teller *t)
{
    const tn_found_item rule = rule_item(t, t->finding->rule), other = rule_item(t, t->finding->other);
    tn_buffer plan;
    tn_status status = plan_text(t, t->finding->plans, &plan);
    if (status == TN_OK)
        tn_report_equivalent(&t->finder, &rule, &other, plan.data);
    free(plan.data);
    return status;
}

/* The clauses that are reasons; the caller frees them. */
static tn_found_item *reason_items(const teller *t)
{
    tn_found_item *items = malloc((t->finding->reason_count + 1) * sizeof *items);
    for (size_t i = 0; items && i < t->finding->reason_count; i++)
        items[i] = clause_item(t, t->finding->reasons[i]);
    return items;
}

static tn_status tell_idle_prune(const teller *t)
{
    const tn_found_item library = library_item(t), clause = clause_item(t, t->finding->clause);
    tn_found_item *reasons = reason_items(t);
    tn_buffer plan;
    tn_status status = plan_text(t, t->finding->plans, &plan);
    if (!reasons)
        status = tn_fail_memory(NULL);
    if (status == TN_OK)
        tn_report_idle_prune(&t->finder, &library, &clause, reasons, t->finding->reason_count, plan.data);
    free(reasons);
    free(plan.data);
    return status;
}

static tn_status tell_idle_requirement(const teller *t)
{
    const tn_found_item own = library_item(t), clause = clause_item(t, t->finding->clause);
    const tn_library_record *library = &t->module->LIBRARY_records[t->finding->library];
    bool settable = false;
    for (uint32_t i = 0; i < library->clause_count; i++)
        settable |= tn_program_settable(t->opened->compilation.program, clause_span(t, library->clause_first + i));
    bool projects = t->module->CLAUSE_records[t->finding->clause].kind == TN_CLAUSE_ONTO; /* which makes the library */
    if (!settable && !projects)
        tn_report_idle_requirement(&t->finder, &own, &clause);
    return TN_OK;
}

static tn_status tell_empty(const teller *t)
{
    const tn_plan_analysis_finding *f = t->finding;
    const tn_found_item library = library_item(t);
    tn_found_item *reasons = reason_items(t);
    tn_buffer *plans = calloc(f->reason_count + 1, sizeof *plans);
    const char **examples = calloc(f->reason_count + 1, sizeof *examples);
    tn_status status = reasons && plans && examples ? TN_OK : tn_fail_memory(NULL);
    for (size_t i = 0; status == TN_OK && i < f->reason_count; i++) {
        status = plan_text(t, &f->plans[i], &plans[i]);
        examples[i] = plans[i].data;
    }
    const tn_library_record *record = &t->module->LIBRARY_records[f->library];
    const tn_found_empty empty = {reasons,
                                  examples,
                                  f->reason_count,
                                  f->with_lengths,
                                  record->trays_min,
                                  record->trays_max,
                                  f->why ? f->why->message : NULL};
    if (status == TN_OK)
        tn_report_empty(&t->finder, &library, &empty);
    for (size_t i = 0; plans && i < f->reason_count; i++)
        free(plans[i].data);
    free(plans);
    free(examples);
    free(reasons);
    return status;
}

static tn_status tell_vacuous(const teller *t)
{
    tn_span span;
    if (!tn_code_span(t->opened, t->finding->offset, &span) || is_allowed(t, W_VACUOUS_DISTANCE, span))
        return TN_OK;
    tn_diagnostic *d = tn_report(list_of(t), W_VACUOUS_DISTANCE, span,
                                 "this holds only in plans where there is no destination at all");
    tn_help(list_of(t), d,
            "a distance holds where there is nothing to be away from; to ask for a destination, add `and` and the "
            "destination");
    tn_buffer plan;
    tn_status status = plan_text(t, t->finding->plans, &plan);
    if (status == TN_OK && plan.data)
        tn_note(list_of(t), d, NULL, "the shortest plan where it holds: %s", plan.data);
    free(plan.data);
    return status;
}

/* The field of which the specifier lets in no value at all; NULL where it is the schema's `forbid`s that leave none. */
static const char *contradicted(const teller *t)
{
    tn_instruction code = tn_code_read(t->module->code, t->finding->offset);
    for (uint32_t f = 0; code.opcode == TN_OP_TRAY && f < t->schema->field_count; f++) {
        bool any = false;
        for (uint32_t v = 0; v < t->schema->fields[f].value_count; v++) {
            uint32_t bit = t->schema->value_start[f] + v;
            any |= tn_spec_word(t->module, (uint32_t)code.first, bit / 64) >> bit % 64 & 1;
        }
        if (!any)
            return tn_text(t->module, t->schema->fields[f].name);
    }
    return NULL;
}

static tn_status tell_no_tray(const teller *t)
{
    tn_span span;
    if (!tn_code_span(t->opened, t->finding->offset, &span) || is_allowed(t, W_NO_LEGAL_TRAY, span))
        return TN_OK;
    const char *schema = tn_text(t->module, t->schema->record->name);
    const char *field = contradicted(t);
    if (field) {
        tn_diagnostic *d =
            tn_report(list_of(t), W_NO_LEGAL_TRAY, span,
                      "no tray is like this: all items have to hold, and those about `%s` exclude each other", field);
        tn_help(list_of(t), d, "alternatives are joined by `or`: `tray(%s a or b)`", field);
        return TN_OK;
    }
    tn_diagnostic *d =
        tn_report(list_of(t), W_NO_LEGAL_TRAY, span, "no legal tray is like this: schema `%s` forbids them", schema);
    tn_span place = {t->schema->record->file, t->schema->record->begin, t->schema->record->end};
    place = tn_finding_name_span(&t->finder, place, "schema", schema);
    tn_note(list_of(t), d, &place, "`%s` is here", schema);
    tn_help(list_of(t), d, "name fewer values, or change a `forbid` of the schema");
    return TN_OK;
}

static bool has_cause_of(const tn_plan_analysis_finding *a, const tn_plan_analysis_finding *b)
{
    return a->found == TN_FOUND_NOT_ANALYSED && b->found == TN_FOUND_NOT_ANALYSED &&
           a->why->code_offset == b->why->code_offset && strcmp(a->why->message, b->why->message) == 0;
}

static const char *subject_name(const teller *t, const tn_plan_analysis_finding *f)
{
    teller other = *t;
    other.finding = f;
    return f->rule != TN_NO_RECORD ? rule_name(t, f->rule) : library_name(&other);
}

/* Rules that call one which is past a limit are past it for the same reason: one note tells of all of them. */
enum { NAMES_SHOWN = 3 };

/* Writes "`a` is", "`a` and `b` are" or "`a`, `b`, `c` and 12 more are"; false where an earlier finding has told it. */
static bool name_subjects(const teller *t, char *names, size_t size)
{
    uint32_t same[NAMES_SHOWN], count = 0;
    for (uint32_t i = 0; i < tn_plan_analysis_count(t->analysis); i++) {
        if (!has_cause_of(tn_plan_analysis_get(t->analysis, i), t->finding))
            continue;
        if (count == 0 && i != t->index)
            return false;
        if (count < NAMES_SHOWN)
            same[count] = i;
        count++;
    }
    size_t at = 0;
    uint32_t shown = count < NAMES_SHOWN ? count : NAMES_SHOWN;
    for (uint32_t i = 0; i < shown && at < size; i++)
        at += (size_t)snprintf(names + at, size - at, "%s`%s`",
                               i == 0           ? ""
                               : i + 1 == count ? " and "
                                                : ", ",
                               subject_name(t, tn_plan_analysis_get(t->analysis, same[i])));
    if (at < size && count > shown)
        at += (size_t)snprintf(names + at, size - at, " and %u more", count - shown);
    if (at < size)
        snprintf(names + at, size - at, count == 1 ? " is" : " are");
    return true;
}

/* What the search for a plan of a library that is not analysed may take, so that checking stays quick. */
enum { SEARCHED_CONFLICTS = 10000, SEARCHED_GATES = 1 << 18 };

static tn_status tell_conflict(const teller *t, const tn_search_conflict *conflict)
{
    const tn_library_record *record = &t->module->LIBRARY_records[t->finding->library];
    tn_plan_analysis_finding found = {.found = TN_FOUND_EMPTY,
                                      .rule = TN_NO_RECORD,
                                      .library = t->finding->library,
                                      .reason_count = conflict->count,
                                      .with_lengths = true};
    found.reasons = malloc((conflict->count + 1) * sizeof *found.reasons);
    found.plans = malloc((conflict->count + 1) * sizeof *found.plans);
    tn_status status = found.reasons && found.plans ? TN_OK : tn_fail_memory(NULL);
    for (size_t i = 0; status == TN_OK && i < conflict->count; i++) {
        const tn_searched_plan *plan = &conflict->plans.items[i];
        found.reasons[i] = record->clause_first + conflict->clauses[i];
        found.plans[i] = (tn_shown_plan){.trays = plan->trays, .length = plan->length, .shown = true};
    }
    teller other = *t;
    other.finding = &found;
    if (status == TN_OK)
        status = tell_empty(&other);
    free(found.reasons);
    free(found.plans);
    return status;
}

/* A library whose automaton passes a limit: if it is proven to be empty by search, that is told. */
static tn_status tell_searched(const teller *t)
{
    const tn_search_options options = {.max_gates = SEARCHED_GATES, .max_conflicts = SEARCHED_CONFLICTS};
    tn_search_conflict conflict = {0};
    tn_plan_search *search;
    tn_status status = tn_plan_search_new(t->schema, t->finding->library, &options, &search, NULL);
    if (status == TN_OK) {
        status = tn_plan_search_conflict(search, &conflict, NULL);
        tn_plan_search_free(search);
    }
    if (status == TN_OK && conflict.empty)
        status = tell_conflict(t, &conflict);
    tn_search_conflict_clear(&conflict);
    return status == TN_LIMIT ? TN_OK : status;
}

static tn_status tell_not_analysed(const teller *t)
{
    const tn_plan_analysis_finding *f = t->finding;
    char names[512];
    bool library = f->rule == TN_NO_RECORD && f->why->code == E_TOO_MANY_STATES;
    tn_status status = library && tn_plan_search_is_there() ? tell_searched(t) : TN_OK;
    if (status != TN_OK)
        return status;
    if (!name_subjects(t, names, sizeof names))
        return TN_OK;
    tn_diagnostic *d = tn_report_bare(list_of(t), TN_NOTE, TN_CODE_NONE, "%s not analysed: %s", names, f->why->message);
    d->limit = true;
    d->has_span = tn_code_span(t->opened, f->why->code_offset, &d->span);
    if (!d->has_span) {
        d->span = f->rule != TN_NO_RECORD ? rule_span(t, f->rule) : library_span(t);
        d->has_span = true;
    }
    if (f->why->help[0])
        tn_help(list_of(t), d, "%s", f->why->help);
    return TN_OK;
}

static tn_status tell(const teller *t)
{
    static tn_status (*const tellers[])(const teller *) = {
        [TN_FOUND_NEVER] = tell_extreme,         [TN_FOUND_ALWAYS] = tell_extreme,
        [TN_FOUND_SUBSUMED] = tell_subsumed,     [TN_FOUND_EQUIVALENT] = tell_equivalent,
        [TN_FOUND_IDLE_PRUNE] = tell_idle_prune, [TN_FOUND_IDLE_REQUIRE] = tell_idle_requirement,
        [TN_FOUND_EMPTY] = tell_empty,           [TN_FOUND_VACUOUS] = tell_vacuous,
        [TN_FOUND_NO_TRAY] = tell_no_tray,       [TN_FOUND_NOT_ANALYSED] = tell_not_analysed,
    };
    return tellers[t->finding->found](t);
}

/* ---- analysing */

static bool is_concerned(const tn_module *module, uint32_t schema)
{
    for (size_t r = 0; r < module->RULE_count; r++)
        if (module->RULE_records[r].schema == schema && !(module->RULE_records[r].flags & TN_IMPORTED))
            return true;
    for (size_t m = 0; m < module->MEASURE_count; m++)
        if (module->MEASURE_records[m].schema == schema && !(module->MEASURE_records[m].flags & TN_IMPORTED))
            return true;
    for (size_t l = 0; l < module->LIBRARY_count; l++)
        if (module->LIBRARY_records[l].schema == schema && !(module->LIBRARY_records[l].flags & TN_IMPORTED))
            return true;
    return false;
}

/* The sums of the schema can be made: no tray that they count divides by zero, and their numbers have a step. */
static tn_status check_sums(const tn_schema *schema, tn_error *error)
{
    const tn_module *module = schema->module;
    for (uint32_t i = 0; i < module->SUM_count; i++) {
        tn_sum *sum;
        if (&module->SCHEMA_records[module->SUM_records[i].schema] != schema->record)
            continue;
        tn_status status = tn_sum_new(schema, i, &sum, error);
        if (status != TN_OK)
            return status;
        tn_sum_free(sum);
    }
    return TN_OK;
}

/* A quotient has a value for some plan. */
static void check_quotients(tn_opened *opened, const tn_schema *schema)
{
    const tn_module *module = schema->module;
    for (uint32_t i = 0; i < module->MEASURE_count; i++) {
        const tn_measure_record *measure = &module->MEASURE_records[i];
        if (&module->SCHEMA_records[measure->schema] != schema->record || measure->flags & TN_IMPORTED ||
            measure->over == TN_NO_RECORD || !tn_measure_never(schema, i))
            continue;
        tn_span place = {measure->file, measure->begin, measure->end};
        tn_diagnostic *d =
            tn_report(&opened->compilation.diagnostics, E_DIVIDED_BY_ZERO, place, "this divides by 0 for every plan");
        tn_help(&opened->compilation.diagnostics, d, "divide by what some plans have: `/ trays`, `/ sum(FIELD)`");
    }
}

static tn_status analyse_schema(tn_opened *opened, uint32_t index, const tn_plan_analysis_options *options,
                                tn_plan_analyses *analyses, tn_error *error)
{
    size_t at = analyses->count;
    tn_status status = tn_schema_new(opened->module, index, 0, &analyses->schemas[at], error);
    if (status != TN_OK)
        return status;
    analyses->count++;
    status = check_sums(analyses->schemas[at], error);
    if (status != TN_OK)
        return status;
    if (opened->compiled)
        check_quotients(opened, analyses->schemas[at]);
    status = tn_plan_analysis_new(analyses->schemas[at], options, &analyses->items[at], error);
    for (size_t i = 0; status == TN_OK && opened->compiled && i < tn_plan_analysis_count(analyses->items[at]); i++) {
        teller t = {{opened, "plan", "plans", ""},
                    opened,
                    opened->module,
                    analyses->schemas[at],
                    tn_plan_analysis_get(analyses->items[at], i),
                    analyses->items[at],
                    (uint32_t)i};
        status = tell(&t);
        if (status == TN_MEMORY)
            tn_fail_memory(error);
    }
    return status;
}

tn_status tn_plan_analyse(tn_opened *opened, const tn_plan_analysis_options *options, tn_plan_analyses *analyses)
{
    const tn_module *module = opened->module;
    tn_error error;
    *analyses = (tn_plan_analyses){.schemas = calloc(module->SCHEMA_count + 1, sizeof *analyses->schemas),
                                   .items = calloc(module->SCHEMA_count + 1, sizeof *analyses->items)};
    tn_status status = analyses->schemas && analyses->items ? TN_OK : tn_fail_memory(&error);
    for (uint32_t s = 0; status == TN_OK && s < module->SCHEMA_count; s++)
        if (is_concerned(module, s))
            status = analyse_schema(opened, s, options, analyses, &error);
    if (status == TN_OK)
        status = tn_house_survey(opened, &error);
    if (status != TN_OK)
        tn_finding_error(opened, &error);
    return status;
}

void tn_plan_analyses_free(tn_plan_analyses *analyses)
{
    for (size_t i = 0; i < analyses->count; i++) {
        tn_plan_analysis_free(analyses->items[i]);
        tn_schema_free(analyses->schemas[i]);
    }
    free(analyses->items);
    free(analyses->schemas);
    *analyses = (tn_plan_analyses){0};
}
