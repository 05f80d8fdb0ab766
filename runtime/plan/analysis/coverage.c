/* Counts what would be decided otherwise if a part of a rule never matched. */
#include "runtime/plan/analysis/coverage.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/module/code.h"
#include "runtime/plan/library/sequence.h"
#include "runtime/plan/match/lower.h"
#include "runtime/plan/schema/classes.h"

#define JOINT_STATES 1000000u /* of the automata of several clauses together, unless more are asked for */

#define DIFFERENCES_KEPT 64u

/* How many plans of the base a difference of decisions is about: many parts of a rule make the same difference. */
typedef struct tn_difference {
    tn_dfa *plans;
    mpz_t count;
} tn_difference;

struct tn_coverage {
    const tn_schema *schema;
    tn_classes *classes;
    tn_coverage_clause *clauses;
    size_t count;
    uint32_t min, max, max_states;
    uint8_t **reaches; /* [count][FUNCTION records]: what a clause's function calls, directly or not, and itself */
    tn_dfa **with, **without;                    /* [count] */
    bool *changed;                               /* [count]: is the clause another one without the part? */
    bool *base_of;                               /* [count]: the clauses that the base leaves out */
    tn_sparse *base;                             /* of all other clauses; NULL: not made */
    tn_difference differences[DIFFERENCES_KEPT]; /* of this base */
    size_t difference_count;
    tn_sequence sequence; /* of all clauses, requirements first */
    size_t *place;        /* [count]: of each clause in the sequence */
    bool sequenced;       /* is it made? */
};

static bool compares_sums(tn_opcode opcode)
{
    return opcode == TN_OP_BELOW || opcode == TN_OP_ZERO || opcode == TN_OP_ABOVE;
}

/* Marks what the terms of a sum count. */
static void mark_terms(const tn_module *module, uint32_t sum, uint8_t *reached)
{
    const tn_sum_record *record = &module->SUM_records[sum];
    for (uint32_t i = 0; i < record->term_count; i++)
        reached[module->TERM_records[record->term_first + i].part] = 1;
}

/* Marks in `reached` the function and what it calls. Callees have lower numbers: one pass downwards finds them all. */
static void mark_reached(const tn_module *module, uint32_t function, uint8_t *reached)
{
    reached[function] = 1;
    for (uint32_t f = function + 1; f-- > 0;) {
        const tn_function_record *record = &module->FUNCTION_records[f];
        for (uint32_t offset = record->code_begin; reached[f] && offset < record->code_end;) {
            tn_instruction code = tn_code_read(module->code, offset);
            if (code.opcode == TN_OP_CALL || code.opcode == TN_OP_MIRROR)
                reached[code.first] = 1;
            else if (compares_sums(code.opcode))
                mark_terms(module, (uint32_t)code.first, reached);
            offset += code.length;
        }
    }
}

/* Is one of the instructions in what clause i calls? */
static bool is_concerned(const tn_coverage *c, size_t i, const uint32_t *offsets, size_t count)
{
    const tn_module *module = c->schema->module;
    for (uint32_t f = 0; f < module->FUNCTION_count; f++)
        for (size_t k = 0; c->reaches[i][f] && k < count; k++)
            if (offsets[k] >= module->FUNCTION_records[f].code_begin &&
                offsets[k] < module->FUNCTION_records[f].code_end)
                return true;
    return false;
}

static tn_status lower_all(tn_coverage *c, tn_error *error)
{
    tn_lowering *lowering = NULL;
    tn_status status = tn_lowering_new(c->classes, c->max_states, &lowering, error);
    if (status == TN_OK)
        tn_lowering_within(lowering, c->max);
    for (size_t i = 0; status == TN_OK && i < c->count; i++)
        status = tn_lower(lowering, c->clauses[i].function, &c->with[i], error);
    tn_lowering_free(lowering);
    return status;
}

tn_status tn_coverage_new(const tn_schema *schema, const tn_coverage_clause *clauses, size_t count, uint32_t min,
                          uint32_t max, uint32_t max_states, tn_coverage **coverage, tn_error *error)
{
    tn_coverage *c = calloc(1, sizeof *c);
    uint32_t *functions = malloc((count + 1) * sizeof *functions);
    if (!c || !functions) {
        free(c);
        free(functions);
        return tn_fail_memory(error);
    }
    *c = (tn_coverage){.schema = schema, .count = count, .min = min, .max = max, .max_states = max_states};
    c->clauses = malloc((count + 1) * sizeof *c->clauses);
    c->with = calloc(count + 1, sizeof *c->with);
    c->without = calloc(count + 1, sizeof *c->without);
    c->changed = calloc(count + 1, sizeof *c->changed);
    c->base_of = calloc(count + 1, sizeof *c->base_of);
    c->reaches = calloc(count + 1, sizeof *c->reaches);
    c->place = calloc(count + 1, sizeof *c->place);
    bool ok = c->clauses && c->with && c->without && c->changed && c->base_of && c->reaches && c->place;
    for (size_t i = 0; ok && i < count; i++) {
        c->reaches[i] = calloc(schema->module->FUNCTION_count + 1, 1);
        ok = c->reaches[i] != NULL;
        if (ok)
            mark_reached(schema->module, clauses[i].function, c->reaches[i]);
        c->clauses[i] = clauses[i];
        functions[i] = clauses[i].function;
    }
    tn_status status = ok ? tn_classes_new(schema, functions, count, &c->classes, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = lower_all(c, error);
    free(functions);
    if (status == TN_OK)
        *coverage = c;
    else
        tn_coverage_free(c);
    return status;
}

static void forget_differences(tn_coverage *c)
{
    while (c->difference_count > 0) {
        tn_difference *last = &c->differences[--c->difference_count];
        tn_dfa_free(last->plans);
        mpz_clear(last->count);
    }
}

void tn_coverage_free(tn_coverage *c)
{
    if (!c)
        return;
    for (size_t i = 0; i < c->count; i++) {
        if (c->with)
            tn_dfa_free(c->with[i]);
        if (c->without)
            tn_dfa_free(c->without[i]);
        if (c->reaches)
            free(c->reaches[i]);
    }
    forget_differences(c);
    tn_sequence_clear(&c->sequence);
    free(c->reaches);
    free(c->place);
    tn_sparse_free(c->base);
    tn_classes_free(c->classes);
    free(c->clauses);
    free(c->with);
    free(c->without);
    free(c->changed);
    free(c->base_of);
    free(c);
}

/* Only the clauses that the instructions are part of are lowered again. */
tn_status tn_coverage_without(tn_coverage *c, const uint32_t *offsets, size_t count, tn_error *error)
{
    tn_lowering *lowering = NULL;
    tn_status status = tn_lowering_new(c->classes, c->max_states, &lowering, error);
    if (status == TN_OK)
        tn_lowering_disable(lowering, offsets, count);
    if (status == TN_OK)
        tn_lowering_within(lowering, c->max);
    for (size_t i = 0; status == TN_OK && i < c->count; i++) {
        tn_dfa_free(c->without[i]);
        c->without[i] = NULL;
        if (is_concerned(c, i, offsets, count))
            status = tn_lower(lowering, c->clauses[i].function, &c->without[i], error);
        else
            c->without[i] = tn_dfa_share(c->with[i]);
        c->changed[i] = status == TN_OK && !tn_dfa_equal(c->with[i], c->without[i]);
    }
    tn_lowering_free(lowering);
    return status;
}

static tn_bounds joint_bounds(const tn_coverage *c)
{
    return tn_bounds_make(c->max_states > JOINT_STATES ? c->max_states : JOINT_STATES);
}

/* Puts the clauses in a row, requirements first, and keeps of their automata what many bases begin with. */
static tn_status make_sequence(tn_coverage *c, tn_error *error)
{
    tn_dfa *all = NULL;
    tn_sparse *plans = NULL;
    tn_bounds bounds = joint_bounds(c);
    size_t next = 0;
    tn_status status = tn_dfa_constant(c->classes->count, true, &all, error);
    if (status == TN_OK)
        status = tn_sparse_make(all, 0, &plans, error);
    tn_dfa_free(all);
    if (status == TN_OK)
        status = tn_sequence_make(&c->sequence, c->count, plans, "library", error);
    for (int prunes = 0; status == TN_OK && prunes < 2; prunes++)
        for (size_t i = 0; i < c->count; i++) {
            if (c->clauses[i].requires == prunes)
                continue;
            c->sequence.clauses[next] = (tn_sequence_clause){c->with[i], prunes ? TN_DFA_MINUS : TN_DFA_AND};
            c->place[i] = next++;
        }
    c->sequenced = status == TN_OK;
    return status == TN_OK ? tn_sequence_make_runs(&c->sequence, &bounds, error) : status;
}

/* *base := what all clauses keep but the changed ones. */
static tn_status apply_unchanged(tn_coverage *c, tn_error *error)
{
    size_t first = c->count, last = 0;
    tn_status status = TN_OK;
    bool *skipped = calloc(c->count + 1, sizeof *skipped);
    if (!skipped)
        return tn_fail_memory(error);
    for (size_t i = 0; i < c->count; i++) {
        if (!c->changed[i])
            continue;
        skipped[c->place[i]] = true;
        first = c->place[i] < first ? c->place[i] : first;
        last = c->place[i] > last ? c->place[i] : last;
    }
    tn_bounds bounds = joint_bounds(c);
    status = tn_sequence_save(&c->sequence, first, &bounds, error);
    if (status == TN_OK)
        status = tn_sequence_before(&c->sequence, first, &bounds, &c->base, error);
    for (size_t i = first; status == TN_OK && i <= last; i++) {
        const tn_sequence_clause *clause = &c->sequence.clauses[i];
        tn_bounds own = joint_bounds(c);
        if (!skipped[i])
            status = tn_sparse_apply(&c->base, clause->dfa, clause->keeping, "library", &own, error);
    }
    tn_bounds rest = joint_bounds(c);
    if (status == TN_OK)
        status = tn_sequence_apply(&c->sequence, last + 1, &rest, &c->base, error);
    free(skipped);
    return status;
}

/* The plans that the unchanged clauses leave; kept for the next part of the same rule. */
static tn_status make_base(tn_coverage *c, tn_error *error)
{
    if (c->base && memcmp(c->base_of, c->changed, c->count * sizeof *c->changed) == 0)
        return TN_OK;
    forget_differences(c);
    tn_sparse_free(c->base);
    c->base = NULL;
    tn_status status = c->sequenced ? TN_OK : make_sequence(c, error);
    if (status == TN_OK)
        status = apply_unchanged(c, error);
    memcpy(c->base_of, c->changed, c->count * sizeof *c->changed);
    if (status != TN_OK) {
        tn_sparse_free(c->base);
        c->base = NULL;
    }
    return status;
}

/* *into := *into and (or less) another. */
static tn_status join(const tn_coverage *c, tn_dfa **into, const tn_dfa *other, tn_dfa_operation operation,
                      tn_error *error)
{
    tn_bounds bounds = joint_bounds(c);
    tn_dfa *joined = NULL;
    tn_status status = tn_dfa_product(*into, other, operation, "difference", &bounds, &joined, error);
    if (status != TN_OK)
        return status;
    tn_dfa_free(*into);
    *into = joined;
    return TN_OK;
}

/* What the changed clauses keep (or, `required` alone, require), as `automata` have them. */
static tn_status keep(const tn_coverage *c, tn_dfa *const *automata, bool required, tn_dfa **kept, tn_error *error)
{
    tn_status status = tn_dfa_constant(c->classes->count, true, kept, error);
    for (size_t i = 0; status == TN_OK && i < c->count; i++)
        if (c->changed[i] && (c->clauses[i].requires || !required))
            status = join(c, kept, automata[i], c->clauses[i].requires ? TN_DFA_AND : TN_DFA_MINUS, error);
    return status;
}

/* How many plans of the base `plans` accepts. */
static tn_status count_of_base(tn_coverage *c, tn_dfa *plans, mpz_t count, tn_error *error)
{
    tn_bounds bounds = joint_bounds(c);
    for (size_t i = 0; i < c->difference_count; i++)
        if (tn_dfa_equal(c->differences[i].plans, plans)) {
            mpz_set(count, c->differences[i].count);
            return TN_OK;
        }
    tn_status status = tn_count_both(c->base, plans, TN_DFA_AND, c->classes->size, c->min, c->max, "difference",
                                     &bounds, count, error);
    if (status == TN_OK && c->difference_count < DIFFERENCES_KEPT) {
        tn_difference *kept = &c->differences[c->difference_count++];
        kept->plans = tn_dfa_share(plans);
        mpz_init_set(kept->count, count);
    }
    return status;
}

/* flips += plans of the base that are in `a` and not in `b`. */
static tn_status count_less(tn_coverage *c, tn_dfa *a, const tn_dfa *b, mpz_t flips, tn_error *error)
{
    tn_dfa *less = tn_dfa_share(a);
    mpz_t count;
    mpz_init(count);
    tn_status status = join(c, &less, b, TN_DFA_MINUS, error);
    if (status == TN_OK)
        status = count_of_base(c, less, count, error);
    if (status == TN_OK)
        mpz_add(flips, flips, count);
    tn_dfa_free(less);
    mpz_clear(count);
    return status;
}

tn_status tn_coverage_flips(tn_coverage *c, mpz_t flips, tn_error *error)
{
    tn_dfa *with = NULL, *without = NULL, *required = NULL;
    bool any = false;
    for (size_t i = 0; i < c->count; i++)
        any = any || c->changed[i];
    mpz_set_ui(flips, 0);
    if (!any)
        return TN_OK;
    tn_status status = make_base(c, error);
    if (status == TN_OK)
        status = keep(c, c->with, false, &with, error);
    if (status == TN_OK)
        status = keep(c, c->without, false, &without, error);
    if (status == TN_OK)
        status = keep(c, c->with, true, &required, error);
    if (status == TN_OK)
        status = join(c, &without, required, TN_DFA_AND, error); /* only generated plans count */
    if (status == TN_OK)
        status = count_less(c, with, without, flips, error);
    if (status == TN_OK)
        status = count_less(c, without, with, flips, error);
    tn_dfa_free(with);
    tn_dfa_free(without);
    tn_dfa_free(required);
    if (status == TN_LIMIT && error && !error->help[0])
        tn_error_help(error, "raise it with --max-states, or give fewer trays");
    return status;
}

bool tn_coverage_holds(const tn_coverage *c, size_t i, bool without, const tn_tray *trays, size_t length)
{
    const tn_dfa *dfa = without ? c->without[i] : c->with[i];
    uint32_t state = 0;
    for (size_t k = 0; k < length; k++)
        state = tn_dfa_read(dfa, state, c->classes->of_tray[trays[k]]);
    return dfa->accept[state];
}
