/* Measures whether the tests of a file notice mistakes in its rules. */
#include "driver/coverage/coverage.h"

#include <stdlib.h>
#include <string.h>

#include "driver/coverage/coverage_parts.h"
#include "driver/plan/library.h"
#include "runtime/base/array.h"

tn_covered_part *tn_covered_add(tn_covered *covered)
{
    if (!tn_array_reserve(&covered->parts, &covered->capacity, covered->count, 1, sizeof *covered->parts))
        return NULL;
    tn_covered_part *part = &covered->parts[covered->count++];
    *part = (tn_covered_part){.function = UINT32_MAX};
    mpz_init(part->flips);
    return part;
}

void tn_covered_drop(tn_covered *covered, size_t count)
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
        status = tn_measure_houses(&m, &error);
    if (status != TN_OK)
        tn_finding_error(opened, &error);
    return status;
}

void tn_covered_clear(tn_covered *covered)
{
    tn_covered_drop(covered, 0);
    for (size_t i = 0; i < covered->form_count; i++)
        tn_form_coverage_clear(&covered->forms[i]);
    tn_changes_clear(&covered->changes);
    tn_schema_free(covered->schema);
    free(covered->forms);
    free(covered->parts);
    *covered = (tn_covered){0};
}
