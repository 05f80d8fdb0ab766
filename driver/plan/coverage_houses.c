/* Measures the parts of rules about houses, and forms. */
#include <stdlib.h>

#include "driver/plan/coverage_parts.h"

/* ---- counting */

/* The library opened for counting; one whose plans pass a limit stays closed. */
static tn_status open_library(tn_covering *m, uint32_t index, tn_error *error)
{
    tn_measured_houses *houses = &m->libraries[index];
    if (houses->dependents || houses->unknown)
        return houses->dependents ? TN_OK : TN_LIMIT;
    return tn_dependents_new(m->module, index, m->options->max_states, &houses->dependents, error);
}

static tn_status count_houses(tn_covering *m, uint32_t index, const uint32_t *offsets, size_t count,
                              tn_covered_part *made, tn_error *error)
{
    tn_measured_houses *houses = &m->libraries[index];
    tn_status status = open_library(m, index, error);
    houses->asked++;
    if (status == TN_OK)
        status = tn_dependents_count(houses->dependents, offsets, count, made->flips, error);
    made->counted = status == TN_OK;
    if (status != TN_LIMIT)
        return status;
    if (houses->unknown++ == 0)
        houses->limit = *error;
    return TN_OK;
}

tn_status tn_measure_dependents(tn_covering *m, const tn_covered_subject *s, const uint32_t *offsets, size_t count,
                                tn_covered_part *made, tn_error *error)
{
    tn_status status = tn_house_cases_notice(&m->houses, offsets, count, &made->noticed, error);
    bool counts = m->options->houses && s->library != TN_NO_RECORD;
    return status == TN_OK && counts ? count_houses(m, s->library, offsets, count, made, error) : status;
}

/* The first library of houses of the file itself that uses a rule; TN_NO_RECORD: none does. */
static tn_status find_library(const tn_covering *m, uint32_t holds, uint32_t *library, tn_error *error)
{
    tn_status status = TN_OK;
    bool concern = false;
    *library = TN_NO_RECORD;
    for (uint32_t i = 0; status == TN_OK && !concern && i < m->module->HOUSE_LIBRARY_count; i++) {
        if (m->module->HOUSE_LIBRARY_records[i].flags & TN_IMPORTED)
            continue;
        status = tn_dependents_concern(m->module, i, holds, &concern, error);
        *library = concern ? i : TN_NO_RECORD;
    }
    return status;
}

/* ---- rules and clauses */

static tn_status measure_house_rules(tn_covering *m, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < m->module->HOUSE_RULE_count; i++) {
        const tn_house_rule_record *rule = &m->module->HOUSE_RULE_records[i];
        tn_covered_subject subject = {
            .function = rule->holds, .whole = rule->whole, .name = tn_text(m->module, rule->name), .of_houses = true};
        if (rule->flags & TN_IMPORTED)
            continue;
        status = find_library(m, rule->holds, &subject.library, error);
        if (status == TN_OK)
            status = tn_measure_subject(m, subject, error);
    }
    return status;
}

static bool is_house_rule(const tn_module *module, uint32_t function)
{
    for (uint32_t i = 0; i < module->HOUSE_RULE_count; i++)
        if (module->HOUSE_RULE_records[i].holds == function || module->HOUSE_RULE_records[i].whole == function)
            return true;
    return tn_function_rule(module, function) != UINT32_MAX;
}

/* Of the file's libraries of houses, the clauses that are more than a rule's name. */
static tn_status measure_house_clauses(tn_covering *m, uint32_t index, tn_error *error)
{
    const tn_house_library_record *library = &m->module->HOUSE_LIBRARY_records[index];
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < library->clause_count; i++) {
        const tn_house_clause_record *clause = &m->module->HOUSE_CLAUSE_records[library->clause_first + i];
        if (!is_house_rule(m->module, clause->holds))
            status = tn_measure_subject(m,
                                        (tn_covered_subject){.function = clause->holds,
                                                             .whole = UINT32_MAX,
                                                             .name = tn_text(m->module, clause->name),
                                                             .of_houses = true,
                                                             .library = index},
                                        error);
    }
    return status;
}

static bool has_case(const tn_covering *m, uint32_t form)
{
    for (size_t i = 0; i < m->houses.count; i++)
        if (m->houses.items[i].form == form)
            return true;
    return false;
}

static tn_status measure_forms(tn_covering *m, tn_error *error)
{
    tn_covered *covered = m->covered;
    tn_status status = TN_OK;
    covered->forms = calloc(m->module->FORM_count + 1, sizeof *covered->forms);
    if (!covered->forms)
        return tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i < m->module->FORM_count; i++)
        if (!(m->module->FORM_records[i].flags & TN_IMPORTED) || has_case(m, i))
            status = tn_form_covered(&m->houses, i, &covered->forms[covered->form_count++], error);
    return status;
}

static tn_status measure_all(tn_covering *m, tn_error *error)
{
    tn_status status = tn_house_cases_read(m->opened, &m->houses, error);
    if (status == TN_OK)
        status = measure_house_rules(m, error);
    for (uint32_t i = 0; status == TN_OK && i < m->module->HOUSE_LIBRARY_count; i++)
        if (!(m->module->HOUSE_LIBRARY_records[i].flags & TN_IMPORTED))
            status = measure_house_clauses(m, i, error);
    return status == TN_OK ? measure_forms(m, error) : status;
}

/* The limit that the first part passed. */
static void say_unknown(tn_covering *m, uint32_t library)
{
    const tn_house_library_record *record = &m->module->HOUSE_LIBRARY_records[library];
    tn_measured_houses *houses = &m->libraries[library];
    tn_span place = {record->file, record->begin, record->end};
    tn_diagnostic *d = tn_finding_limit(m->opened, &houses->limit, &place);
    tn_note(&m->opened->compilation.diagnostics, d, NULL,
            "so how many houses of `%s` depend on a part is not known for %zu of %zu parts",
            tn_text(m->module, record->name), houses->unknown, houses->asked);
}

tn_status tn_measure_houses(tn_covering *m, tn_error *error)
{
    m->libraries = calloc((size_t)m->module->HOUSE_LIBRARY_count + 1, sizeof *m->libraries);
    tn_status status = m->libraries ? measure_all(m, error) : tn_fail_memory(error);
    for (uint32_t i = 0; m->libraries && i < m->module->HOUSE_LIBRARY_count; i++) {
        if (status == TN_OK && m->libraries[i].unknown)
            say_unknown(m, i);
        tn_dependents_free(m->libraries[i].dependents);
    }
    free(m->libraries);
    m->libraries = NULL;
    tn_house_cases_clear(&m->houses);
    return status;
}
