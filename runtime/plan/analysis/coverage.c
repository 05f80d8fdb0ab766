/* Counts what would be decided otherwise if a part of a rule never matched. */
#include "runtime/plan/analysis/coverage.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/module/code.h"
#include "runtime/plan/automata/count.h"
#include "runtime/plan/library/alone.h"
#include "runtime/plan/match/lower.h"

#define JOINT_STATES 1000000u /* of the automata of several functions together, unless more are asked for */

#define DIFFERENCES_KEPT 64u

/* How many plans that an automaton accepts count: many parts of a rule make the same difference. */
typedef struct tn_difference {
    tn_dfa *plans;
    mpz_t count;
} tn_difference;

typedef struct tn_differences {
    tn_difference items[DIFFERENCES_KEPT];
    size_t count;
} tn_differences;

struct tn_coverage {
    const tn_schema *schema;
    const tn_library *library; /* or NULL: functions by themselves */
    tn_classes *own_classes;   /* then */
    const tn_classes *classes;
    uint32_t *functions; /* [count] */
    size_t count;
    uint32_t min, max, max_states;
    uint8_t **reaches;        /* [count][FUNCTION records]: what a function calls, directly or not, and itself */
    tn_dfa **with, **without; /* [count] */
    bool *changed;            /* [count]: is the function another one without the part? */
    bool *asked_of;           /* [count]: the `changed` that `gained` is of */
    tn_differences lost;      /* of the kept plans */
    tn_differences gained;    /* of the plans that the unchanged clauses keep */
};

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
            else if (tn_code_compares(code.opcode))
                mark_terms(module, (uint32_t)code.first, reached);
            offset += code.length;
        }
    }
}

/* Is one of the instructions in what function i calls? */
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

/* ---- making */

static tn_status lower_all(tn_coverage *c, tn_error *error)
{
    tn_lowering *lowering = NULL;
    tn_status status = tn_lowering_new(c->classes, c->max_states, &lowering, error);
    if (status == TN_OK)
        tn_lowering_within(lowering, c->max);
    for (size_t i = 0; status == TN_OK && i < c->count; i++)
        status = tn_lower(lowering, c->functions[i], &c->with[i], error);
    tn_lowering_free(lowering);
    return status;
}

/* Room for so many functions, and what each calls. */
static tn_status add_functions(tn_coverage *c, const uint32_t *functions, size_t count, tn_error *error)
{
    const tn_module *module = c->schema->module;
    c->count = count;
    c->functions = malloc((count + 1) * sizeof *c->functions);
    c->with = calloc(count + 1, sizeof *c->with);
    c->without = calloc(count + 1, sizeof *c->without);
    c->changed = calloc(count + 1, sizeof *c->changed);
    c->asked_of = calloc(count + 1, sizeof *c->asked_of);
    c->reaches = calloc(count + 1, sizeof *c->reaches);
    bool ok = c->functions && c->with && c->without && c->changed && c->asked_of && c->reaches;
    for (size_t i = 0; ok && i < count; i++) {
        c->functions[i] = functions[i];
        c->reaches[i] = calloc(module->FUNCTION_count + 1, 1);
        ok = c->reaches[i] != NULL;
        if (ok)
            mark_reached(module, functions[i], c->reaches[i]);
    }
    return ok ? TN_OK : tn_fail_memory(error);
}

tn_status tn_coverage_new(const tn_schema *schema, const uint32_t *functions, size_t count, uint32_t min, uint32_t max,
                          uint32_t max_states, tn_coverage **coverage, tn_error *error)
{
    tn_coverage *c = calloc(1, sizeof *c);
    if (!c)
        return tn_fail_memory(error);
    *c = (tn_coverage){.schema = schema, .min = min, .max = max, .max_states = max_states};
    tn_status status = add_functions(c, functions, count, error);
    if (status == TN_OK)
        status = tn_classes_new(schema, functions, count, &c->own_classes, error);
    c->classes = c->own_classes;
    if (status == TN_OK)
        status = lower_all(c, error);
    if (status == TN_OK)
        *coverage = c;
    else
        tn_coverage_free(c);
    return status;
}

tn_status tn_coverage_of_library(const tn_library *library, tn_coverage **coverage, tn_error *error)
{
    const tn_schema *schema = tn_library_schema(library);
    const tn_library_record *record = tn_library_record_of(library);
    size_t count = record->clause_count;
    tn_coverage *c = calloc(1, sizeof *c);
    uint32_t *functions = calloc(count + 1, sizeof *functions);
    if (!c || !functions) {
        free(c);
        free(functions);
        return tn_fail_memory(error);
    }
    *c = (tn_coverage){.schema = schema,
                       .library = library,
                       .classes = tn_library_classes(library),
                       .min = tn_library_min(library),
                       .max = tn_library_max(library),
                       .max_states = tn_library_max_states(library)};
    for (size_t i = 0; i < count; i++)
        functions[i] = schema->module->CLAUSE_records[record->clause_first + i].holds;
    tn_status status = add_functions(c, functions, count, error);
    for (uint32_t i = 0; status == TN_OK && i < count; i++)
        c->with[i] = tn_dfa_share(tn_library_automaton(library, i));
    free(functions);
    if (status == TN_OK)
        *coverage = c;
    else
        tn_coverage_free(c);
    return status;
}

static void forget(tn_differences *differences)
{
    while (differences->count > 0) {
        tn_difference *last = &differences->items[--differences->count];
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
    forget(&c->lost);
    forget(&c->gained);
    free(c->reaches);
    tn_classes_free(c->own_classes);
    free(c->functions);
    free(c->with);
    free(c->without);
    free(c->changed);
    free(c->asked_of);
    free(c);
}

/* Only the functions that the instructions are part of are lowered again. */
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
            status = tn_lower(lowering, c->functions[i], &c->without[i], error);
        else
            c->without[i] = tn_dfa_share(c->with[i]);
        c->changed[i] = status == TN_OK && !tn_dfa_equal(c->with[i], c->without[i]);
    }
    tn_lowering_free(lowering);
    return status;
}

/* ---- what the changed clauses say */

static bool prunes(const tn_coverage *c, size_t i)
{
    const tn_library_record *record = tn_library_record_of(c->library);
    return c->schema->module->CLAUSE_records[record->clause_first + i].kind == TN_CLAUSE_PRUNE;
}

/* *into := *into and (less, or) another. */
static tn_status join(const tn_coverage *c, tn_dfa **into, const tn_dfa *other, tn_dfa_operation operation,
                      tn_error *error)
{
    tn_bounds bounds = tn_bounds_make(c->max_states > JOINT_STATES ? c->max_states : JOINT_STATES);
    tn_dfa *joined = NULL;
    tn_status status = tn_dfa_product(*into, other, operation, "difference", &bounds, &joined, error);
    if (status != TN_OK)
        return status;
    tn_dfa_free(*into);
    *into = joined;
    return TN_OK;
}

/* What the changed clauses keep, or (`required`) what those of them require that are requirements. */
static tn_status keep(const tn_coverage *c, tn_dfa *const *automata, bool required, tn_dfa **kept, tn_error *error)
{
    tn_status status = tn_dfa_constant(c->classes->count, true, kept, error);
    for (size_t i = 0; status == TN_OK && i < c->count; i++)
        if (c->changed[i] && !(required && prunes(c, i)))
            status = join(c, kept, automata[i], prunes(c, i) ? TN_DFA_MINUS : TN_DFA_AND, error);
    return status;
}

static bool accepts_nothing(const tn_dfa *dfa)
{
    return dfa->states == 1 && !dfa->accept[0];
}

/* The changed clause, where it is the only one; or SIZE_MAX. */
static size_t only_changed(const tn_coverage *c)
{
    size_t found = SIZE_MAX;
    for (size_t i = 0; i < c->count; i++) {
        if (!c->changed[i])
            continue;
        if (found != SIZE_MAX)
            return SIZE_MAX;
        found = i;
    }
    return found;
}

/* ---- counting */

typedef tn_status count_plans(tn_coverage *c, const tn_dfa *plans, mpz_t count, tn_error *error);

/* Kept with the part. */
static tn_status count_lost(tn_coverage *c, const tn_dfa *plans, mpz_t count, tn_error *error)
{
    return tn_library_count_kept(c->library, plans, count, error);
}

/* Not kept with the part, and kept by all unchanged clauses. What one clause keeps out and no other does is an
 * automaton of its own, and `plans` is all of it that the clause keeps without the part. */
static tn_status count_gained(tn_coverage *c, const tn_dfa *plans, mpz_t count, tn_error *error)
{
    size_t one = only_changed(c);
    tn_status status = TN_LIMIT;
    if (one != SIZE_MAX)
        status = tn_library_count_alone_less(c->library, (uint32_t)one, c->without[one], count, error);
    if (status == TN_LIMIT) /* or there are several, or the automaton is too large: counting makes a smaller one */
        status = tn_library_count_without(c->library, c->changed, plans, count, error);
    return status;
}

/* flips += how many plans of a difference count. */
static tn_status add_difference(tn_coverage *c, tn_dfa *plans, tn_differences *kept, count_plans *how, mpz_t flips,
                                tn_error *error)
{
    mpz_t count;
    if (accepts_nothing(plans))
        return TN_OK;
    for (size_t i = 0; i < kept->count; i++)
        if (tn_dfa_equal(kept->items[i].plans, plans)) {
            mpz_add(flips, flips, kept->items[i].count);
            return TN_OK;
        }
    mpz_init(count);
    tn_status status = how(c, plans, count, error);
    if (status == TN_OK)
        mpz_add(flips, flips, count);
    if (status == TN_OK && kept->count < DIFFERENCES_KEPT) {
        tn_difference *next = &kept->items[kept->count++];
        next->plans = tn_dfa_share(plans);
        mpz_init_set(next->count, count);
    }
    mpz_clear(count);
    return status;
}

/* Of a library: plans that are kept only with the part, and generated ones that are kept only without it. */
static tn_status count_flips(tn_coverage *c, mpz_t flips, tn_error *error)
{
    tn_dfa *with = NULL, *lost = NULL, *gained = NULL, *required = NULL;
    tn_status status = keep(c, c->with, false, &with, error);
    if (status == TN_OK)
        status = keep(c, c->without, false, &gained, error);
    if (status == TN_OK)
        lost = tn_dfa_share(with);
    if (status == TN_OK)
        status = join(c, &lost, gained, TN_DFA_MINUS, error);
    if (status == TN_OK)
        status = add_difference(c, lost, &c->lost, count_lost, flips, error);
    if (status == TN_OK)
        status = join(c, &gained, with, TN_DFA_MINUS, error);
    if (status == TN_OK)
        status = keep(c, c->with, true, &required, error);
    if (status == TN_OK)
        status = join(c, &gained, required, TN_DFA_AND, error); /* only generated plans count */
    if (memcmp(c->asked_of, c->changed, c->count * sizeof *c->changed) != 0)
        forget(&c->gained);
    memcpy(c->asked_of, c->changed, c->count * sizeof *c->changed);
    if (status == TN_OK)
        status = add_difference(c, gained, &c->gained, count_gained, flips, error);
    tn_dfa_free(with);
    tn_dfa_free(lost);
    tn_dfa_free(gained);
    tn_dfa_free(required);
    return status;
}

/* Of functions by themselves: plans of which some says otherwise. */
static tn_status count_otherwise(tn_coverage *c, mpz_t flips, tn_error *error)
{
    tn_bounds bounds = tn_bounds_make(JOINT_STATES);
    tn_dfa *otherwise = NULL;
    tn_sparse *plans = NULL;
    tn_status status = tn_dfa_constant(c->classes->count, false, &otherwise, error);
    for (size_t i = 0; status == TN_OK && i < c->count; i++) {
        if (!c->changed[i])
            continue;
        tn_dfa *lost = tn_dfa_share(c->with[i]), *gained = tn_dfa_share(c->without[i]);
        status = join(c, &lost, c->without[i], TN_DFA_MINUS, error);
        if (status == TN_OK)
            status = join(c, &gained, c->with[i], TN_DFA_MINUS, error);
        if (status == TN_OK)
            status = join(c, &otherwise, lost, TN_DFA_OR, error);
        if (status == TN_OK)
            status = join(c, &otherwise, gained, TN_DFA_OR, error);
        tn_dfa_free(lost);
        tn_dfa_free(gained);
    }
    if (status == TN_OK)
        status = tn_sparse_words(c->classes->count, c->min, c->max, &plans, error);
    if (status == TN_OK)
        status = tn_count_both(plans, otherwise, TN_DFA_AND, c->classes->size, c->min, c->max, "difference", &bounds,
                               flips, error);
    tn_sparse_free(plans);
    tn_dfa_free(otherwise);
    return status;
}

tn_status tn_coverage_flips(tn_coverage *c, mpz_t flips, tn_error *error)
{
    bool any = false;
    for (size_t i = 0; i < c->count; i++)
        any = any || c->changed[i];
    mpz_set_ui(flips, 0);
    if (!any)
        return TN_OK;
    tn_status status = c->library ? count_flips(c, flips, error) : count_otherwise(c, flips, error);
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
