/* Measures the parts of rules about houses, and forms. */
#include <stdlib.h>

#include <string.h>

#include "driver/coverage/coverage_parts.h"

/* The rule or clause at hand, in the code of both its judgements. */
typedef struct subject {
    uint32_t function; /* HOLDS */
    uint32_t whole;    /* UINT32_MAX: a clause has none */
    const char *name;
    uint32_t library; /* the HOUSE_LIBRARY in which houses are counted; TN_NO_RECORD: none uses it */
    tn_parts trees[2];
} subject;

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

/* Of a part: do tests notice, and how many houses depend on it? */
static tn_status measure_dependents(tn_covering *m, const subject *s, const uint32_t *offsets, size_t count,
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

/* ---- parts */

/* The same part in the other judgement of the rule, and what else was compiled from that place: their instructions. */
static size_t find_offsets(const tn_parts *trees, const tn_part *part, uint32_t *offsets)
{
    const tn_source_map_record *place = tn_module_place(trees[0].module, part->root);
    size_t count = 0;
    for (int t = 0; t < 2; t++)
        for (uint32_t i = 0; i < trees[t].count; i++) {
            const tn_part *other = &trees[t].parts[i];
            const tn_source_map_record *its = tn_module_place(trees[t].module, other->root);
            bool same =
                other->root == part->root || (place && its && other->kind == part->kind && place->file == its->file &&
                                              place->begin == its->begin && place->end == its->end);
            if (same)
                offsets[count++] = other->root;
        }
    return count;
}

static tn_status measure_part(tn_covering *m, const subject *s, uint32_t index, unsigned depth, uint32_t *offsets,
                              tn_error *error)
{
    const tn_part *part = &s->trees[0].parts[index];
    char text[TN_PART_TEXT_MAX];
    tn_covered_part *made = tn_covered_add(m->covered);
    if (!made)
        return tn_fail_memory(error);
    tn_part_text(&s->trees[0], index, text, sizeof text);
    made->function = s->function;
    made->name = s->name;
    made->depth = depth;
    made->kind = tn_part_word(part->kind);
    made->text = strdup(text);
    made->of_houses = true;
    if (!tn_code_span(m->opened, part->root, &made->place))
        made->place.file = UINT32_MAX;
    size_t count = find_offsets(s->trees, part, offsets);
    tn_status status = made->text ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK)
        status = measure_dependents(m, s, offsets, count, made, error);
    made->fate = made->noticed               ? TN_FATE_NOTICED
                 : !made->counted            ? TN_FATE_UNKNOWN
                 : mpz_sgn(made->flips) == 0 ? TN_FATE_EQUAL
                                             : TN_FATE_SURVIVES;
    m->covered->noticed += made->noticed;
    return status;
}

static tn_status measure_parts(tn_covering *m, const subject *s, tn_error *error)
{
    uint32_t at = 0;
    uint32_t *offsets = malloc(((size_t)s->trees[0].count + s->trees[1].count + 1) * sizeof *offsets);
    const tn_parts *tree = &s->trees[0];
    const tn_part *parts = tree->parts;
    unsigned depth = 0;
    tn_status status = offsets ? TN_OK : tn_fail_memory(error);
    while (status == TN_OK) {
        if (!tn_part_is_step(tree, at))
            status = measure_part(m, s, at, depth, offsets, error);
        if (parts[at].first != TN_NO_PART) {
            depth += !tn_part_is_step(tree, at);
            at = parts[at].first;
            continue;
        }
        while (at != 0 && parts[at].next == TN_NO_PART) {
            at = parts[at].parent;
            depth -= !tn_part_is_step(tree, at);
        }
        if (at == 0)
            break;
        at = parts[at].next;
    }
    free(offsets);
    return status;
}

/* All parts of a rule or clause. */
static tn_status try_subject(tn_covering *m, subject *s, tn_error *error)
{
    tn_status status = tn_parts_read_house(m->module, s->function, &s->trees[0], error);
    if (status == TN_OK && s->whole != UINT32_MAX)
        status = tn_parts_read_house(m->module, s->whole, &s->trees[1], error);
    if (status == TN_OK)
        status = measure_parts(m, s, error);
    tn_parts_clear(&s->trees[0]);
    tn_parts_clear(&s->trees[1]);
    return status;
}

/* One that passes a limit is left out, and that is said. */
static tn_status measure_subject(tn_covering *m, subject s, tn_error *error)
{
    size_t before = m->covered->count;
    tn_status status = try_subject(m, &s, error);
    if (status != TN_LIMIT)
        return status;
    tn_covered_drop(m->covered, before);
    if (error->code_offset == TN_NO_OFFSET)
        error->code_offset = m->module->FUNCTION_records[s.function].code_begin;
    tn_diagnostic *note = tn_finding_limit(m->opened, error, NULL);
    tn_note(&m->opened->compilation.diagnostics, note, NULL, "`%s` is not analysed", s.name);
    return TN_OK;
}

/* ---- rules and clauses */

static tn_status measure_house_rules(tn_covering *m, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < m->module->HOUSE_RULE_count; i++) {
        const tn_house_rule_record *rule = &m->module->HOUSE_RULE_records[i];
        subject s = {.function = rule->holds, .whole = rule->whole, .name = tn_text(m->module, rule->name)};
        if (rule->flags & TN_IMPORTED)
            continue;
        status = find_library(m, rule->holds, &s.library, error);
        if (status == TN_OK)
            status = measure_subject(m, s, error);
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
            status = measure_subject(m,
                                     (subject){.function = clause->holds,
                                               .whole = UINT32_MAX,
                                               .name = tn_text(m->module, clause->name),
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
