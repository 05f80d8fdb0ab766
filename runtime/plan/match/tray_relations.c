/* Makes the automata that look at trays: which classes meet a specifier, and how much the trays of a class count. */
#include "runtime/plan/match/tray_relations.h"

#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/plan/match/condition.h"

tn_status tn_relate_tray(const tn_marked *marked, const tn_classes *classes, uint32_t spec, tn_dfa **out,
                         tn_error *error)
{
    uint8_t *chosen = malloc((size_t)classes->count + 1);
    if (!chosen)
        return tn_fail_memory(error);
    for (uint32_t c = 0; c < classes->count; c++)
        chosen[c] = tn_spec_meets(classes->schema, spec, classes->representative[c]);
    tn_status status = tn_marked_letter(marked, chosen, out, error);
    free(chosen);
    return status;
}

/* The numbers that meet a condition, in steps of `unit`. The caller frees *holds, which the set borrows. */
static tn_status meeting(const tn_module *module, uint32_t condition, int64_t unit, uint64_t limit,
                         tn_periodic_set *set, uint8_t **holds, tn_error *error)
{
    tn_status status = tn_condition_period(module, condition, unit, limit, &set->threshold, &set->period, error);
    if (status != TN_OK)
        return status;
    uint64_t size = set->threshold + set->period;
    *holds = tn_array_new(size, 1);
    if (!*holds)
        return tn_fail_memory(error);
    for (uint64_t n = 0; n < size; n++)
        (*holds)[n] = tn_condition_holds(module, condition, (int64_t)n * unit);
    set->holds = *holds;
    return TN_OK;
}

/* How many units long the trays of each class are in a field. NULL where out of memory. */
static uint64_t *lengths(const tn_classes *classes, uint32_t field, int64_t unit)
{
    uint64_t *counts = malloc(((size_t)classes->count + 1) * sizeof *counts);
    for (uint32_t c = 0; counts && c < classes->count; c++)
        counts[c] = (uint64_t)(tn_tray_value_record(classes->schema, classes->representative[c], field)->length / unit);
    return counts;
}

tn_status tn_relate_count(const tn_marked *marked, const tn_classes *classes, const tn_dfa *a, tn_tally tally,
                          uint32_t condition, uint32_t field, tn_dfa **out, tn_error *error)
{
    int64_t unit = field == TN_NO_FIELD ? 1 : tn_schema_length_unit(classes->schema, field);
    uint64_t limit = (uint64_t)marked->bounds->max_states * 4 + 64, *counts = NULL;
    uint8_t *holds = NULL;
    tn_periodic_set set;
    tn_status status = meeting(classes->schema->module, condition, unit, limit, &set, &holds, error);
    if (status == TN_OK && field != TN_NO_FIELD && !(counts = lengths(classes, field, unit)))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_marked_count(marked, a, tally, &set, counts, out, error);
    free(counts);
    free(holds);
    return status;
}

tn_status tn_relate_numbers(const tn_marked *marked, const tn_module *module, const tn_dfa *a, uint32_t condition,
                            const uint64_t *counts, tn_dfa **out, tn_error *error)
{
    uint8_t *holds = NULL;
    tn_periodic_set set;
    tn_status status =
        meeting(module, condition, 1, (uint64_t)marked->bounds->max_states * 4 + 64, &set, &holds, error);
    if (status == TN_OK)
        status = tn_marked_count(marked, a, TN_TALLY_SINGLES, &set, counts, out, error);
    free(holds);
    return status;
}

tn_status tn_relate_mirrored(const tn_marked *marked, const tn_classes *classes, uint32_t field, uint32_t max_trays,
                             tn_dfa **out, tn_error *error)
{
    if (max_trays == 0) {
        tn_fail(error, TN_LIMIT, E_TOO_MANY_STATES,
                "`mirrored` has more states the more trays plans have, and it is not known how many that is");
        tn_error_help(error,
                      "prune or require the rule in a library: there it is looked at within the library's lengths");
        return TN_LIMIT;
    }
    uint32_t *values = calloc((size_t)classes->count + 1, sizeof *values);
    if (!values)
        return tn_fail_memory(error);
    for (uint32_t c = 0; c < classes->count; c++)
        values[c] = tn_tray_value(classes->schema, classes->representative[c], field);
    tn_status status = tn_marked_mirrored(marked, values, max_trays, out, error);
    free(values);
    return status;
}
