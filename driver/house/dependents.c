/* Counts the houses that depend on a part of a rule. */
#include "driver/house/dependents.h"

#include <stdlib.h>
#include <string.h>

#include "driver/house/counter.h"
#include "runtime/module/code.h"

struct tn_dependents {
    tn_house_counter counter;
    bool known; /* `kept` is */
    mpz_t kept; /* houses of the library */
};

tn_status tn_dependents_new(const tn_module *module, uint32_t library, uint32_t max_states, tn_dependents **dependents,
                            tn_error *error)
{
    tn_dependents *d = *dependents = calloc(1, sizeof *d);
    if (!d)
        return tn_fail_memory(error);
    mpz_init(d->kept);
    tn_status status = tn_house_counter_open(module, library, max_states,
                                             max_states ? max_states : TN_DEPENDENTS_STATES, &d->counter, error);
    if (status != TN_OK) {
        tn_dependents_free(d);
        *dependents = NULL;
    }
    return status;
}

void tn_dependents_free(tn_dependents *d)
{
    if (!d)
        return;
    mpz_clear(d->kept);
    tn_house_counter_close(&d->counter);
    free(d);
}

/* ---- which clauses a part is in */

static bool is_inside(const tn_function_record *function, const uint32_t *offsets, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (offsets[i] >= function->code_begin && offsets[i] < function->code_end)
            return true;
    return false;
}

/* *more: a function above this one was reached, in a circle. */
static void mark_callees(const tn_module *module, uint32_t function, bool *reached, bool *more)
{
    const tn_function_record *record = &module->FUNCTION_records[function];
    for (uint32_t at = record->code_begin; at < record->code_end;) {
        tn_instruction op = tn_code_read(module->code, at);
        if (tn_code_calls(op.opcode)) {
            *more |= !reached[op.first] && op.first > function;
            reached[op.first] = true;
        }
        at += op.length;
    }
}

/* Is one of the instructions in the function, or in one that it calls? Callees have lower numbers: one pass downwards
 * finds them all, and another is needed where a circle leads up. (A comparison of sums is one part: nothing in it is a
 * part of its own.) reached: room for all. */
static bool concerns(const tn_module *module, uint32_t function, const uint32_t *offsets, size_t count, bool *reached)
{
    bool more = true;
    memset(reached, 0, (size_t)module->FUNCTION_count * sizeof *reached);
    reached[function] = true;
    while (more) {
        more = false;
        for (uint32_t f = function + 1; f-- > 0;) {
            if (!reached[f])
                continue;
            if (is_inside(&module->FUNCTION_records[f], offsets, count))
                return true;
            mark_callees(module, f, reached, &more);
        }
    }
    return false;
}

/* ---- counting */

/* The library's clauses, with those that the part is in behind the others, and how many these are. */
typedef struct sorted_clauses {
    tn_house_clause_record *clauses; /* [clauses, and room for as many more] */
    uint32_t count, concerned;
} sorted_clauses;

static tn_status sort_clauses(const tn_module *module, const tn_house_library_record *record, const uint32_t *offsets,
                              size_t count, sorted_clauses *sorted, tn_error *error)
{
    const tn_house_clause_record *all = module->HOUSE_CLAUSE_records + record->clause_first;
    bool *reached = malloc((size_t)module->FUNCTION_count + 1);
    uint32_t others = 0;
    *sorted = (sorted_clauses){.clauses = calloc(2 * (size_t)record->clause_count + 1, sizeof *sorted->clauses),
                               .count = record->clause_count};
    if (!reached || !sorted->clauses) {
        free(reached);
        return tn_fail_memory(error);
    }
    for (uint32_t i = 0; i < sorted->count; i++) {
        if (concerns(module, all[i].holds, offsets, count, reached))
            sorted->clauses[sorted->count - ++sorted->concerned] = all[i];
        else
            sorted->clauses[others++] = all[i];
    }
    free(reached);
    return TN_OK;
}

/* Of several clauses: those kept as it is, and those kept without the part, less twice what both keep. */
static tn_status count_several(tn_dependents *d, const sorted_clauses *sorted, tn_frontier_without *without,
                               mpz_t houses, tn_error *error)
{
    tn_status status = TN_OK;
    mpz_t other;
    mpz_init(other);
    if (!d->known)
        status = tn_house_counter_count(&d->counter, sorted->clauses, sorted->count, NULL, d->kept, error);
    d->known = status == TN_OK;
    without->first = sorted->count - sorted->concerned;
    if (status == TN_OK)
        status = tn_house_counter_count(&d->counter, sorted->clauses, sorted->count, without, houses, error);
    memcpy(sorted->clauses + sorted->count, sorted->clauses + without->first,
           sorted->concerned * sizeof *sorted->clauses);
    without->first = sorted->count;
    if (status == TN_OK)
        status = tn_house_counter_count(&d->counter, sorted->clauses, sorted->count + sorted->concerned, without, other,
                                        error);
    mpz_add(houses, houses, d->kept);
    mpz_submul_ui(houses, other, 2);
    mpz_clear(other);
    return status;
}

tn_status tn_dependents_count(tn_dependents *d, const uint32_t *offsets, size_t count, mpz_t houses, tn_error *error)
{
    sorted_clauses sorted;
    tn_frontier_without without = {.offsets = offsets, .count = count};
    tn_status status = sort_clauses(d->counter.module, d->counter.library, offsets, count, &sorted, error);
    mpz_set_ui(houses, 0);
    if (status == TN_OK && sorted.concerned == 1) {
        without.first = sorted.count - 1;
        without.differs = true;
        status = tn_house_counter_count(&d->counter, sorted.clauses, sorted.count, &without, houses, error);
    } else if (status == TN_OK && sorted.concerned > 1) {
        status = count_several(d, &sorted, &without, houses, error);
    }
    free(sorted.clauses);
    return status;
}

tn_status tn_dependents_concern(const tn_module *module, uint32_t library, uint32_t function, bool *concern,
                                tn_error *error)
{
    const uint32_t offset = module->FUNCTION_records[function].code_begin;
    sorted_clauses sorted;
    tn_status status = sort_clauses(module, &module->HOUSE_LIBRARY_records[library], &offset, 1, &sorted, error);
    *concern = status == TN_OK && sorted.concerned > 0;
    free(sorted.clauses);
    return status;
}
