/* Measures whether the tests of a file notice mistakes in its rules. */
#include "driver/coverage/coverage.h"

#include <stdlib.h>
#include <string.h>

#include "driver/coverage/coverage_changes.h"
#include "driver/open/open.h"
#include "driver/plan/library.h"
#include "runtime/base/array.h"

/* ---- what is covered */

tn_covered_part *tn_covered_add(tn_covered *covered)
{
    if (!tn_array_reserve(&covered->parts, &covered->capacity, covered->count, 1, sizeof *covered->parts))
        return NULL;
    tn_covered_part *part = &covered->parts[covered->count++];
    *part = (tn_covered_part){.function = UINT32_MAX};
    mpz_init(part->flips);
    return part;
}

/* Forgets the parts from `count` on. */
static void drop_parts(tn_covered *covered, size_t count)
{
    while (covered->count > count) {
        tn_covered_part *part = &covered->parts[--covered->count];
        covered->noticed -= part->noticed;
        free(part->text);
        free(part->around);
        free(part->telling.trays);
        mpz_clear(part->flips);
    }
}

/* ---- test cases that tell the changes which no test does */

const char *tn_covered_subject_name(const tn_covered *covered, const tn_covered_part *part)
{
    const tn_module *module = covered->opened->module;
    return part->telling.of_library ? tn_text(module, covered->library->name)
                                    : tn_text(module, module->RULE_records[part->telling.rule].name);
}

/* ---- plans as tests have them: what is not written takes its first value */

/* Is a word a value of one field alone, and no field? */
static bool is_clear(const tn_schema *schema, const char *name)
{
    size_t owners = 0;
    for (uint32_t f = 0; f < schema->field_count; f++) {
        bool named = schema->fields[f].kind == TN_FIELD_CHOICE || schema->fields[f].kind == TN_FIELD_ZONE, has = false;
        for (uint32_t v = schema->value_start[f]; named && v < schema->value_start[f + 1]; v++)
            has = has || strcmp(tn_text(schema->module, schema->values[v].name), name) == 0;
        owners += has;
    }
    return owners == 1 && tn_schema_field(schema, name) == UINT32_MAX;
}

static bool write_value(const tn_schema *schema, uint32_t field, const tn_value_record *value, tn_buffer *out)
{
    const tn_module *module = schema->module;
    const char *name = tn_text(module, value->name), *of = tn_text(module, schema->fields[field].name);
    const char *depth = tn_text(module, value->measure);
    switch (schema->fields[field].kind) {
    case TN_FIELD_FLAG:
        return tn_buffer_printf(out, "%s", of);
    case TN_FIELD_LENGTH:
        return field == tn_schema_length_field(schema) ? tn_buffer_printf(out, "%s", name)
                                                       : tn_buffer_printf(out, "%s %s", of, name);
    case TN_FIELD_ZONE:
        return tn_buffer_printf(out, "%s %s%s%s", of, name, *depth ? " " : "", depth);
    default:
        return is_clear(schema, name) ? tn_buffer_printf(out, "%s", name) : tn_buffer_printf(out, "%s %s", of, name);
    }
}

/* The length in any case, so that no tray is empty, or else the first field that can be written. */
static bool is_written(const tn_schema *schema, uint32_t field, uint32_t value)
{
    uint32_t length = tn_schema_length_field(schema);
    if (value > 0 || field == length)
        return true;
    return length == UINT32_MAX && field == 0;
}

static bool write_tray(const tn_schema *schema, tn_tray tray, tn_buffer *out)
{
    bool ok = true, first = true;
    for (uint32_t f = 0; ok && f < schema->field_count; f++) {
        uint32_t value = tn_tray_value(schema, tray, f);
        if (!is_written(schema, f, value))
            continue;
        ok = (first || tn_buffer_printf(out, " "));
        if (ok && value == 0 && schema->fields[f].kind == TN_FIELD_FLAG)
            ok = tn_buffer_printf(out, "not ");
        ok = ok && write_value(schema, f, tn_tray_value_record(schema, tray, f), out);
        first = false;
    }
    return ok;
}

bool tn_covered_case(const tn_covered *covered, const tn_covered_part *part, tn_buffer *out)
{
    const tn_telling *telling = &part->telling;
    const char *expected = telling->of_library ? (telling->now ? "keep" : "drop") : telling->now ? "match" : "reject";
    bool ok = tn_buffer_printf(out, "%s [", expected);
    for (size_t i = 0; ok && i < telling->length; i++)
        ok = (i == 0 || tn_buffer_printf(out, " | ")) && write_tray(covered->schema, telling->trays[i], out);
    return ok && tn_buffer_printf(out, "]") && (!telling->by || tn_buffer_printf(out, " by %s", telling->by));
}

/* ---- blocks */

static bool is_told(const tn_covered *covered, size_t i)
{
    return covered->parts[i].telling.found && covered->parts[i].telling.same_as == i;
}

static bool same_subject(const tn_covered *covered, size_t a, size_t b)
{
    const tn_telling *x = &covered->parts[a].telling, *y = &covered->parts[b].telling;
    return x->of_library == y->of_library && (x->of_library || x->rule == y->rule);
}

/* "# 12:5: `8'` of `tray(8')` changed to `12'`" for each change that the plan tells. */
static bool write_reasons(const tn_covered *covered, size_t told, tn_buffer *out)
{
    bool ok = true;
    for (size_t i = told; ok && i < covered->count; i++) {
        const tn_covered_part *part = &covered->parts[i];
        if (!part->telling.found || part->telling.same_as != told)
            continue;
        tn_place place = tn_covered_place(covered, part->place);
        ok = tn_buffer_printf(out, "  # %zu:%zu: `%s`%s%s%s ", place.line, place.column, part->text,
                              part->around ? " of `" : "", part->around ? part->around : "", part->around ? "`" : "") &&
             tn_covered_change(part, out) && tn_buffer_printf(out, "\n");
    }
    return ok;
}

static bool is_first(const tn_covered *covered, size_t i)
{
    for (size_t k = 0; k < i; k++)
        if (is_told(covered, k) && same_subject(covered, k, i))
            return false;
    return true;
}

/* The values of params with which the rules decide so: " with lot = 9m, side = right". */
static bool write_params(const tn_covered *covered, tn_buffer *out)
{
    tn_param_values params;
    bool ok = tn_opened_params(covered->opened, &params) == TN_OK;
    for (size_t i = 0; ok && i < params.count; i++) {
        const char *text = params.items[i], *equal = strchr(text, '=');
        ok = equal && tn_buffer_printf(out, "%s%.*s = %s", i == 0 ? " with " : ", ", (int)(equal - text), text,
                                       equal + 1 + strspn(equal + 1, " "));
    }
    free((void *)(uintptr_t)params.items);
    return ok;
}

static bool write_block(const tn_covered *covered, size_t first, tn_buffer *out)
{
    bool ok = tn_buffer_printf(out, "\ntest %s", tn_covered_subject_name(covered, &covered->parts[first])) &&
              write_params(covered, out) && tn_buffer_printf(out, " {\n");
    for (size_t i = first; ok && i < covered->count; i++)
        if (is_told(covered, i) && same_subject(covered, first, i))
            ok = write_reasons(covered, i, out) && tn_buffer_printf(out, "  ") &&
                 tn_covered_case(covered, &covered->parts[i], out) && tn_buffer_printf(out, "\n");
    return ok && tn_buffer_printf(out, "}\n");
}

bool tn_covered_tests(const tn_covered *covered, tn_buffer *out)
{
    size_t told = 0, untold = 0;
    bool ok = true;
    for (size_t i = 0; i < covered->count; i++) {
        told += is_told(covered, i);
        untold += !covered->parts[i].of_houses && !covered->parts[i].telling.found &&
                  (covered->parts[i].fate == TN_FATE_SURVIVES || covered->parts[i].fate == TN_FATE_UNKNOWN);
    }
    if (told == 0 && untold == 0)
        return tn_buffer_printf(out,
                                "# Every change of the rules that decides some plan otherwise makes a test fail.\n");
    if (told > 0)
        ok = tn_buffer_printf(out,
                              "# What the rules decide now. No test tells them from rules with the changes that are "
                              "named.\n# Keep a case if it is right; if it is wrong, mend the rule.\n");
    for (size_t i = 0; ok && i < covered->count; i++)
        if (is_told(covered, i) && is_first(covered, i))
            ok = write_block(covered, i, out);
    if (ok && untold > 0)
        ok = tn_buffer_printf(out, "# For %zu more changes no plan was found within the limits.\n", untold);
    return ok;
}

/* ---- the parts of rules about houses, and forms */

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
    drop_parts(m->covered, before);
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

/* The rules and clauses about houses, and the forms. */
static tn_status measure_houses(tn_covering *m, tn_error *error)
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

/* ---- all of it */

size_t tn_covered_count(const tn_covered *covered, bool of_houses, int fate)
{
    size_t count = 0;
    for (size_t i = 0; i < covered->count; i++)
        count +=
            covered->parts[i].of_houses == of_houses && (fate == TN_FATE_COUNT || (int)covered->parts[i].fate == fate);
    return count;
}

size_t tn_covered_rule_end(const tn_covered *covered, size_t first)
{
    const tn_covered_part *parts = covered->parts;
    size_t end = first + 1;
    while (end < covered->count && parts[end].of_houses == parts[first].of_houses &&
           parts[end].function == parts[first].function && strcmp(parts[end].name, parts[first].name) == 0)
        end++;
    return end;
}

static bool has_own_library(const tn_module *module)
{
    for (size_t i = 0; i < module->LIBRARY_count; i++)
        if (!(module->LIBRARY_records[i].flags & TN_IMPORTED))
            return true;
    return false;
}

static tn_status choose(tn_covering *m, const char *name)
{
    uint32_t library;
    if (name || has_own_library(m->module)) {
        tn_status status = tn_library_choose(m->opened, name, &library);
        if (status != TN_OK)
            return status;
        m->library = &m->module->LIBRARY_records[library];
        m->schema_index = m->library->schema;
        return TN_OK;
    }
    for (size_t i = 0; i < m->module->RULE_count; i++)
        if (!(m->module->RULE_records[i].flags & TN_IMPORTED))
            m->schema_index = m->module->RULE_records[i].schema;
    return TN_OK;
}

static void set_lengths(tn_covering *m)
{
    const tn_library *ready = m->options->automaton;
    m->covered->min = m->library ? m->library->trays_min : 1;
    m->covered->max = m->library ? m->library->trays_max : TN_COVERAGE_TRAYS;
    if (ready) {
        m->covered->min = tn_library_min(ready);
        m->covered->max = tn_library_max(ready);
    }
}

tn_status tn_coverage_measure(tn_opened *opened, const tn_coverage_options *options, tn_covered *covered)
{
    tn_covering m = {.opened = opened, .module = opened->module, .options = options, .covered = covered};
    tn_error error;
    *covered = (tn_covered){.opened = opened};
    tn_status status = choose(&m, options->library);
    if (status != TN_OK || !opened->compiled || m.module->SCHEMA_count == 0)
        return status;
    covered->library = m.library;
    set_lengths(&m);
    status = tn_schema_new(m.module, m.schema_index, 0, &covered->schema, &error);
    if (status == TN_OK)
        status = tn_measure_changes(&m, &error);
    if (status == TN_OK && m.module->FORM_count)
        status = measure_houses(&m, &error);
    if (status != TN_OK)
        tn_finding_error(opened, &error);
    return status;
}

void tn_covered_clear(tn_covered *covered)
{
    drop_parts(covered, 0);
    for (size_t i = 0; i < covered->form_count; i++)
        tn_form_coverage_clear(&covered->forms[i]);
    tn_changes_clear(&covered->changes);
    tn_schema_free(covered->schema);
    free(covered->forms);
    free(covered->parts);
    *covered = (tn_covered){0};
}
