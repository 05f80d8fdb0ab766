/* Searches the plans of a library: one length after another, in the order of their ranks. */
#include "runtime/plan/search/search.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/plan/search/search_data.h"

bool tn_plan_search_is_there(void)
{
    return tn_solver_cadical(NULL) != NULL;
}

/* ---- plans of one length */

static uint32_t digits_of(const tn_plan_search *search)
{
    return search->at.trays * search->schema->field_count;
}

void tn_search_close(tn_plan_search *search)
{
    tn_search_length *at = &search->at;
    if (search->without)
        tn_search_close(search->without->search);
    tn_unrolled_free(at->unrolled);
    tn_letters_clear(&at->letters);
    if (!at->borrowed)
        tn_circuit_free(at->circuit);
    free(at->keeps);
    free(at->judged);
    free(at->assumed);
    free(at->differs);
    *at = (tn_search_length){0};
}

static bool applies(const tn_plan_search *search, uint32_t clause)
{
    return !search->options.all_generated || tn_search_clause(search, clause)->kind != TN_CLAUSE_PRUNE;
}

/* What is too large for gates is left to the interpreter. */
static tn_status unroll_clauses(tn_plan_search *search, tn_error *error)
{
    tn_search_length *at = &search->at;
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < search->record->clause_count; i++) {
        const tn_clause_record *clause = tn_search_clause(search, i);
        tn_signal holds = TN_SIGNAL_TRUE;
        at->keeps[i] = TN_SIGNAL_TRUE;
        if (!applies(search, i))
            continue;
        status = tn_unrolled_holds(at->unrolled, clause->holds, &holds, error);
        at->judged[i] = status == TN_LIMIT;
        if (status == TN_OK)
            at->keeps[i] = clause->kind == TN_CLAUSE_PRUNE ? tn_signal_not(holds) : holds;
        else if (status == TN_LIMIT)
            status = TN_OK;
    }
    return status;
}

/* Room for plans of so many trays. */
static tn_status begin_length(tn_plan_search *search, uint32_t trays, tn_error *error)
{
    tn_search_length *at = &search->at;
    uint32_t clauses = search->record->clause_count;
    uint64_t digits = (uint64_t)trays * search->schema->field_count;
    tn_search_close(search);
    at->trays = trays;
    at->open = true;
    at->keeps = calloc((size_t)clauses + 1, sizeof *at->keeps);
    at->judged = calloc((size_t)clauses + 1, sizeof *at->judged);
    at->assumed = tn_array_new(digits + clauses + TN_SEARCH_FIXED_MAX + 2, sizeof *at->assumed);
    at->differs = tn_array_new(digits + 1, sizeof *at->differs);
    return at->keeps && at->judged && at->assumed && at->differs ? TN_OK : tn_fail_memory(error);
}

static tn_status unroll(tn_plan_search *search, tn_error *error)
{
    tn_status status = tn_unrolled_new(&search->at.letters, &search->at.unrolled, error);
    return status == TN_OK ? unroll_clauses(search, error) : status;
}

/* The gates of the search's plans, whose trays are another's letters, on the circuit of these. */
static tn_status open_on(tn_plan_search *search, const tn_letters *letters, const tn_search_other *map, tn_error *error)
{
    tn_search_length *at = &search->at;
    tn_status status = begin_length(search, letters->length, error);
    at->circuit = letters->circuit;
    at->borrowed = true;
    if (status == TN_OK)
        status = tn_letters_map(&at->letters, letters, search->schema, map->fields, map->values, error);
    if (status == TN_OK)
        status = unroll(search, error);
    if (status != TN_OK)
        tn_search_close(search);
    return status;
}

/* That the other library does not keep the plan, by the gates of both over the same trays, as circuits are held to be
 * equivalent (Brand: Verification of large synthesized designs, 1993); true if its gates cannot say that. */
static tn_status keeps_not(tn_plan_search *search, const tn_search_other *other, tn_signal *gate, tn_error *error)
{
    tn_plan_search *from = other->search;
    uint32_t clauses = from->record->clause_count, trays = search->at.trays;
    *gate = TN_SIGNAL_TRUE;
    if (trays < from->options.trays_min || trays > from->options.trays_max)
        return TN_OK;
    tn_circuit_go_on(search->at.circuit);
    tn_status status = open_on(from, &search->at.letters, other, error);
    if (status != TN_OK)
        return status;
    bool judged = false;
    for (uint32_t i = 0; i < clauses; i++)
        judged |= from->at.judged[i];
    if (!judged)
        *gate = tn_signal_not(tn_circuit_all(search->at.circuit, from->at.keeps, clauses)); /* sorts them */
    return tn_circuit_status(search->at.circuit, error);
}

static tn_status assert_narrow(tn_plan_search *search, tn_error *error)
{
    tn_circuit *circuit = search->at.circuit;
    tn_signal gate = TN_SIGNAL_TRUE;
    tn_status status = TN_OK;
    if (search->within) {
        tn_signal *begins = malloc((search->within->count + 1) * sizeof *begins);
        status = begins ? tn_search_within(search, search->within, begins, &gate, error) : tn_fail_memory(error);
        tn_circuit_assert(circuit, gate);
        free(begins);
    }
    if (status == TN_OK && search->around) {
        status = tn_search_around_gate(search, search->around, &gate, error);
        tn_circuit_assert(circuit, gate);
    }
    if (status == TN_OK && search->without) {
        status = keeps_not(search, search->without, &gate, error);
        tn_circuit_assert(circuit, gate);
    }
    return status;
}

tn_status tn_search_open(tn_plan_search *search, uint32_t trays, bool keep, tn_error *error)
{
    tn_search_length *at = &search->at;
    tn_status status = begin_length(search, trays, error);
    if (status == TN_OK)
        status = tn_circuit_new(search->options.max_gates, &at->circuit, error);
    if (status == TN_OK)
        status = tn_letters_make(&at->letters, at->circuit, search->schema, trays, error);
    if (status == TN_OK)
        status = unroll(search, error);
    for (uint32_t i = 0; status == TN_OK && keep && i < search->record->clause_count; i++)
        tn_circuit_assert(at->circuit, at->keeps[i]);
    if (status == TN_OK && keep)
        status = assert_narrow(search, error);
    if (status != TN_OK)
        tn_search_close(search);
    return status;
}

tn_status tn_search_solve(tn_plan_search *search, size_t count, bool *found, tn_error *error)
{
    const tn_search_length *at = &search->at;
    tn_solver_answer answer = TN_SOLVER_UNDECIDED;
    *found = false;
    tn_status status = tn_circuit_solve(at->circuit, at->assumed, count, search->options.max_conflicts,
                                        search->schema->module->watch, &answer, error);
    if (status != TN_OK || answer != TN_SOLVER_UNDECIDED) {
        *found = answer == TN_SOLVER_YES;
        return status;
    }
    return tn_search_undecided(search, error);
}

tn_status tn_search_undecided(const tn_plan_search *search, tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_SEARCH_UNDECIDED,
            "searching the plans of %u trays takes more than the limit of %llu conflicts", (unsigned)search->at.trays,
            (unsigned long long)search->options.max_conflicts);
    tn_error_help(error, "give fewer trays with --trays, or raise the limit with --max-conflicts");
    return TN_LIMIT;
}

/* ---- values of a plan, one after another: fields of one tray after another */

static uint32_t value_of(const tn_plan_search *search, const tn_tray *trays, uint32_t digit)
{
    uint32_t fields = search->schema->field_count;
    return tn_tray_value(search->schema, trays[digit / fields], digit % fields);
}

static tn_signal is_value(const tn_plan_search *search, uint32_t digit, uint32_t value)
{
    uint32_t fields = search->schema->field_count;
    return tn_letters_is(&search->at.letters, digit / fields, digit % fields, value);
}

static tn_signal up_to_value(const tn_plan_search *search, uint32_t digit, uint32_t value)
{
    uint32_t fields = search->schema->field_count;
    return tn_letters_up_to(&search->at.letters, digit / fields, digit % fields, value);
}

void tn_search_exclude(tn_plan_search *search, const tn_tray *trays)
{
    tn_signal *differs = search->at.differs;
    for (uint32_t d = 0; d < digits_of(search); d++)
        differs[d] = tn_signal_not(is_value(search, d, value_of(search, trays, d)));
    tn_circuit_assert_any(search->at.circuit, differs, digits_of(search));
}

static void assume_value(tn_plan_search *search, uint32_t digit)
{
    search->at.assumed[search->at.fixed + digit] = is_value(search, digit, value_of(search, search->plan, digit));
}

/* The values before `digit` are those of the plan: makes the others the least there may be. */
static tn_status lower_values(tn_plan_search *search, uint32_t digit, tn_error *error)
{
    tn_status status = TN_OK;
    for (; status == TN_OK && digit < digits_of(search); digit++) {
        uint32_t value;
        bool lower = true;
        while (status == TN_OK && lower && (value = value_of(search, search->plan, digit)) > 0) {
            search->at.assumed[search->at.fixed + digit] = up_to_value(search, digit, value - 1);
            status = tn_search_solve(search, search->at.fixed + digit + 1, &lower, error);
            if (lower)
                tn_letters_read(&search->at.letters, search->plan);
        }
        assume_value(search, digit);
    }
    return status;
}

/* The last of the first `digits` values that the solver used to show that there is no plan with these, and one; 0:
 * none. */
static uint32_t last_failed(const tn_plan_search *search, uint32_t digits)
{
    while (digits > 0 && !tn_circuit_failed(search->at.circuit, search->at.assumed[search->at.fixed + digits - 1]))
        digits--;
    return digits;
}

/* The plan that was found last is excluded, and there is none before it: finds the longest beginning that another has
 * in common with it, and of those plans the first. Beginnings that the proof did not use are passed over. */
static tn_status find_after(tn_plan_search *search, bool *found, tn_error *error)
{
    uint32_t begin = digits_of(search);
    for (uint32_t d = 0; d < begin; d++)
        assume_value(search, d);
    for (;;) {
        tn_status status = tn_search_solve(search, search->at.fixed + begin, found, error);
        if (status != TN_OK)
            return status;
        if (*found)
            break;
        begin = last_failed(search, begin);
        if (begin == 0)
            return TN_OK;
        begin--;
    }
    tn_letters_read(&search->at.letters, search->plan);
    return lower_values(search, begin, error);
}

static tn_status find_first(tn_plan_search *search, bool *found, tn_error *error)
{
    tn_status status = tn_search_solve(search, search->at.fixed, found, error);
    if (status != TN_OK || !*found)
        return status;
    tn_letters_read(&search->at.letters, search->plan);
    return lower_values(search, 0, error);
}

/* ---- judged by the interpreter */

static tn_status judge_clause(tn_plan_search *search, uint32_t i, bool *keeps, tn_error *error)
{
    const tn_clause_record *clause = tn_search_clause(search, i);
    bool holds = false;
    *keeps = true;
    if (!applies(search, i))
        return TN_OK;
    tn_status status = tn_plan_vm_holds(search->vm, clause->holds, &holds, error);
    *keeps = holds != (clause->kind == TN_CLAUSE_PRUNE);
    return status;
}

#define REJECTED_MAX (1u << 18) /* plans in a row */

static tn_status count_rejected(tn_plan_search *search, bool keeps, tn_error *error)
{
    search->rejected = keeps ? 0 : search->rejected + 1;
    if (search->rejected < REJECTED_MAX)
        return TN_OK;
    tn_fail(
        error, TN_LIMIT, E_SEARCH_UNDECIDED,
        "%u plans of %u trays were found one after another that clauses which are too large to search by do not keep",
        search->rejected, (unsigned)search->at.trays);
    tn_error_help(error, "give fewer trays with --trays, or raise the limit with --max-gates");
    return TN_LIMIT;
}

/* Does the other library keep the search's plan? By the interpreter. */
static tn_status other_keeps(tn_plan_search *search, const tn_search_other *other, bool *keeps, tn_error *error)
{
    uint32_t trays = search->at.trays;
    tn_tray *mapped = tn_array_new((uint64_t)trays + 1, sizeof *mapped);
    if (!mapped)
        return tn_fail_memory(error);
    for (uint32_t k = 0; k < trays; k++)
        mapped[k] = other->trays ? other->trays[search->plan[k]] : search->plan[k];
    tn_status status = tn_plan_search_keeps(other->search, mapped, trays, keeps, error);
    free(mapped);
    return status;
}

tn_status tn_search_judge(tn_plan_search *search, const tn_tray *trays, bool *keeps, tn_error *error)
{
    tn_status status = tn_plan_vm_plan(search->vm, trays, search->at.trays, error);
    *keeps = true;
    for (uint32_t i = 0; status == TN_OK && *keeps && i < search->record->clause_count; i++) {
        status = judge_clause(search, i, keeps, error);
        if (status == TN_OK && !*keeps && !search->at.judged[i])
            return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a plan was found that the clause `%.80s` does not keep",
                           tn_text(search->schema->module, tn_search_clause(search, i)->name));
    }
    if (status == TN_OK && *keeps && search->without) {
        status = other_keeps(search, search->without, keeps, error);
        *keeps = !*keeps;
    }
    return status == TN_OK ? count_rejected(search, *keeps, error) : status;
}

tn_status tn_search_find(tn_plan_search *search, size_t count, bool *found, tn_error *error)
{
    tn_status status = TN_OK;
    bool kept = false;
    for (*found = true; status == TN_OK && *found && !kept;) {
        status = tn_search_solve(search, count, found, error);
        if (status != TN_OK || !*found)
            break;
        tn_letters_read(&search->at.letters, search->plan);
        status = tn_search_judge(search, search->plan, &kept, error);
        if (status == TN_OK && !kept)
            tn_search_exclude(search, search->plan);
    }
    *found = status == TN_OK && *found;
    return status;
}

tn_status tn_plan_search_keeps(tn_plan_search *search, const tn_tray *trays, uint32_t length, bool *keeps,
                               tn_error *error)
{
    *keeps = length >= search->options.trays_min && length <= search->options.trays_max;
    tn_status status = *keeps ? tn_plan_vm_plan(search->vm, trays, length, error) : TN_OK;
    for (uint32_t i = 0; status == TN_OK && *keeps && i < search->record->clause_count; i++)
        status = judge_clause(search, i, keeps, error);
    return status;
}

tn_status tn_search_unless_undecided(tn_status status, const tn_error *found, bool *undecided, tn_error *error)
{
    *undecided = status == TN_LIMIT && found->code == E_SEARCH_UNDECIDED;
    if (status != TN_OK && !*undecided && error)
        *error = *found;
    return *undecided ? TN_OK : status;
}

/* ---- asked */

void tn_plan_search_narrow(tn_plan_search *search, const tn_open_plan *open)
{
    search->within = open;
}

void tn_plan_search_leave_out(tn_plan_search *search, const tn_search_other *other)
{
    search->without = other;
}

void tn_plan_search_lengths(const tn_plan_search *search, uint32_t *least, uint32_t *most)
{
    *least = search->options.trays_min;
    *most = search->options.trays_max;
}

tn_status tn_plan_search_new(const tn_schema *schema, uint32_t index, const tn_search_options *options,
                             tn_plan_search **out, tn_error *error)
{
    static const tn_search_options defaults = {0};
    tn_plan_search *search = calloc(1, sizeof *search);
    if (!search)
        return tn_fail_memory(error);
    search->schema = schema;
    search->record = &schema->module->LIBRARY_records[index];
    search->options = options ? *options : defaults;
    tn_search_options *o = &search->options;
    if (!o->override_trays) {
        o->trays_min = search->record->trays_min;
        o->trays_max = search->record->trays_max;
    }
    o->max_gates = o->max_gates ? o->max_gates : TN_SEARCH_GATES_DEFAULT;
    o->max_conflicts = o->max_conflicts ? o->max_conflicts : TN_SEARCH_CONFLICTS_DEFAULT;
    search->next_trays = o->trays_min;
    search->plan = tn_array_new((uint64_t)o->trays_max + 1, sizeof *search->plan);
    tn_status status =
        search->plan ? tn_plan_vm_new(schema, (size_t)o->trays_max + 1, &search->vm, error) : tn_fail_memory(error);
    if (status != TN_OK) {
        tn_plan_search_free(search);
        return status;
    }
    *out = search;
    return TN_OK;
}

void tn_plan_search_free(tn_plan_search *search)
{
    if (!search)
        return;
    tn_search_close(search);
    tn_plan_vm_free(search->vm);
    free(search->plan);
    free(search);
}

tn_status tn_search_next_of_length(tn_plan_search *search, bool *found, tn_error *error)
{
    tn_status status = TN_OK;
    bool kept = false;
    for (*found = true; status == TN_OK && *found && !kept;) {
        status = (search->has_plan ? find_after : find_first)(search, found, error);
        search->has_plan = status == TN_OK && *found;
        if (!search->has_plan)
            break;
        status = tn_search_judge(search, search->plan, &kept, error);
        if (status == TN_OK)
            tn_search_exclude(search, search->plan);
    }
    return status;
}

tn_status tn_plan_search_next(tn_plan_search *search, const tn_tray **trays, uint32_t *length, tn_error *error)
{
    tn_status status = TN_OK;
    bool found = false;
    *trays = NULL;
    while (status == TN_OK && !found && (search->at.open || search->next_trays <= search->options.trays_max)) {
        if (!search->at.open)
            status = tn_search_open(search, search->next_trays++, true, error);
        if (status == TN_OK)
            status = tn_search_next_of_length(search, &found, error);
        if (status == TN_OK && !found)
            tn_search_close(search);
    }
    if (status != TN_OK || !found)
        return status;
    *trays = search->plan;
    *length = search->at.trays;
    return TN_OK;
}
