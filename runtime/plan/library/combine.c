/* Combines the clauses of a library to one automaton. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/crew.h"
#include "runtime/plan/library/library_data.h"
#include "runtime/plan/library/sequence.h"

#define TRANSITIONS_PER_STATE 64u /* that an automaton may have on average, before states are not its size any more */
#define WORK_PER_STATE 300u
#define FEW_TRAYS 32u      /* of plans: so many automata of one length each are about as large as one of any length */
#define TRIAL_STATES 2000u /* of a generator that trying each clause on is cheap for */

tn_bounds tn_library_bounds(const tn_library *library)
{
    uint64_t states = library->max_joint;
    if (states < TN_LIBRARY_STATES_DEFAULT)
        states = TN_LIBRARY_STATES_DEFAULT;
    return (tn_bounds){.max_states = library->max_joint,
                       .max_transitions = TRANSITIONS_PER_STATE * states,
                       .max_words = TRANSITIONS_PER_STATE * states,
                       .max_work = WORK_PER_STATE * states,
                       .watch = library->schema->module->watch};
}

tn_status tn_library_apply(const tn_library *library, const tn_dfa *clause, tn_dfa_operation operation,
                           tn_bounds *bounds, tn_sparse **sparse, tn_error *error)
{
    const char *what = library->within ? "library, of its lengths alone," : "library";
    return tn_sparse_apply(sparse, clause, operation, what, bounds, error);
}

tn_status tn_library_name_clause(const tn_library *library, size_t i, tn_error *error)
{
    if (!error)
        return TN_LIMIT;
    tn_error inner = *error;
    const char *name = tn_text(library->schema->module, tn_library_clause(library, i)->name);
    tn_fail(error, inner.status, inner.code, "in the clause `%.80s`: %.360s", name, inner.message);
    tn_error_help(error, "%s", inner.help);
    error->code_offset = inner.code_offset;
    return inner.status;
}

/* Which clauses of an automaton that passed a limit to leave out: `worst` and the two that multiplied it most. */
static void blame(const tn_library *library, size_t worst, tn_error *error)
{
    size_t most[2] = {worst, worst};
    if (!error)
        return;
    for (size_t i = 0; i < library->record->clause_count; i++) {
        uint64_t growth = i == worst ? 0 : library->growth[i];
        if (growth > 1000 && (most[0] == worst || growth > library->growth[most[0]])) {
            most[1] = most[0];
            most[0] = i;
        } else if (growth > 1000 && (most[1] == worst || growth > library->growth[most[1]])) {
            most[1] = i;
        }
    }
    const tn_module *module = library->schema->module;
    char others[200] = "";
    if (most[1] != worst)
        snprintf(others, sizeof others, ", `%.60s` or `%.60s`, which multiply the states most",
                 tn_text(module, tn_library_clause(library, most[0])->name),
                 tn_text(module, tn_library_clause(library, most[1])->name));
    tn_error_help(error, "leave out `%.60s`%s, give fewer trays with --trays, or raise the limit with --max-states",
                  tn_text(module, tn_library_clause(library, worst)->name), others);
}

static tn_status apply_clause(tn_library *library, size_t i, tn_sparse **sparse, tn_error *error)
{
    const tn_clause_record *record = tn_library_clause(library, i);
    uint64_t before = (*sparse)->states;
    tn_status status =
        tn_library_apply(library, library->clauses[i], tn_library_keeping(library, i), &library->bounds, sparse, error);
    uint64_t after = status == TN_OK ? (*sparse)->states : library->bounds.max_states; /* or more */
    library->growth[i] = after * UINT64_C(1000) / (before + 1);
    if (status != TN_LIMIT)
        return status;
    if (error)
        error->code_offset = library->schema->module->FUNCTION_records[record->holds].code_begin;
    tn_library_name_clause(library, i, error);
    blame(library, i, error);
    return TN_LIMIT;
}

tn_status tn_library_everything(const tn_library *library, bool within, tn_sparse **out, tn_error *error)
{
    if (within)
        return tn_sparse_words(library->classes->count, library->min, library->max, out, error);
    tn_dfa *all = NULL;
    tn_status status = tn_dfa_constant(library->classes->count, true, &all, error);
    if (status == TN_OK)
        status = tn_sparse_make(all, 0, out, error);
    tn_dfa_free(all);
    return status;
}

/* Inserts what has this size into an order that is ascending by size. */
static void insert(size_t *order, uint32_t *sizes, size_t count, size_t what, uint32_t size)
{
    size_t i = count;
    for (; i > 0 && sizes[i - 1] > size; i--) {
        order[i] = order[i - 1];
        sizes[i] = sizes[i - 1];
    }
    order[i] = what;
    sizes[i] = size;
}

/* How large an automaton is with one clause applied: some clauses multiply states, others hardly add any. One too large
 * for so many trials: the clause's own size. */
static tn_status try_clause(const tn_library *library, const tn_sparse *base, size_t clause, uint32_t *size,
                            tn_error *error)
{
    *size = library->clauses[clause]->states;
    if (!base || base->states > TRIAL_STATES)
        return TN_OK;
    tn_bounds bounds = tn_library_bounds(library);
    tn_sparse *trial = NULL;
    tn_status status = tn_sparse_copy(base, &trial, error);
    if (status == TN_OK)
        status = tn_library_apply(library, library->clauses[clause], tn_library_keeping(library, clause), &bounds,
                                  &trial, error);
    if (status == TN_OK)
        *size = trial->states;
    tn_sparse_free(trial);
    return status == TN_LIMIT ? TN_OK : status;
}

typedef struct trials {
    const tn_library *library;
    const tn_sparse *base;
    const size_t *clauses;
    uint32_t *sizes; /* [clauses] */
} trials;

static tn_status try_one(void *context, unsigned thread, size_t i, tn_error *error)
{
    const trials *t = context;
    (void)thread;
    return try_clause(t->library, t->base, t->clauses[i], &t->sizes[i], error);
}

/* The trials do not depend on one another, and go over the threads. */
static tn_status try_all(trials *t, size_t count, tn_error *error)
{
    unsigned threads = t->base && t->base->states <= TRIAL_STATES ? t->library->threads : 1;
    tn_crew *crew = tn_crew_new(threads, t->library->schema->module->watch);
    tn_status status = crew ? tn_crew_run(crew, count, 1, try_one, t, error) : tn_fail_memory(error);
    tn_crew_free(crew);
    return status;
}

tn_status tn_library_order(const tn_library *library, const tn_sparse *base, size_t *clauses, size_t count,
                           tn_error *error)
{
    uint32_t *tried = malloc((count + 1) * sizeof *tried), *sizes = malloc((count + 1) * sizeof *sizes);
    trials t = {library, base, clauses, tried};
    tn_status status = tried && sizes ? try_all(&t, count, error) : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        insert(clauses, sizes, i, clauses[i], tried[i]);
    free(tried);
    free(sizes);
    return status;
}

/* The requirements, or the prunes, to be applied, in file order. */
static void list_clauses(tn_library *library, bool prunes)
{
    size_t next = prunes ? library->required_count : 0, end = prunes ? library->applied_count : library->required_count;
    for (size_t i = 0; next < end; i++)
        if (tn_library_prunes(library, i) == prunes)
            library->applied[next++] = i;
}

static void forget_combined(tn_library *library)
{
    tn_sparse_free(library->generator);
    tn_sparse_free(library->live);
    library->generator = library->live = NULL;
}

/* Applies some of the clauses in runs: a few passes over what may be large, in place of one for each. */
static tn_status apply_runs(tn_library *library, size_t from, size_t to, tn_sparse **plans, tn_error *error)
{
    tn_sequence sequence = {0};
    tn_sparse *all = NULL;
    const char *what = library->within ? "library, of its lengths alone," : "library";
    tn_status status = tn_sparse_copy(*plans, &all, error);
    if (status == TN_OK)
        status = tn_sequence_make(&sequence, to - from, all, what, error);
    for (size_t i = from; status == TN_OK && i < to; i++) {
        size_t clause = library->applied[i];
        sequence.clauses[i - from] =
            (tn_sequence_clause){library->clauses[clause], tn_library_keeping(library, clause)};
    }
    const tn_bounds bounds = tn_library_bounds(library);
    if (status == TN_OK)
        status = tn_sequence_make_runs(&sequence, &bounds, error);
    if (status == TN_OK)
        status = tn_sequence_apply(&sequence, 0, &library->bounds, plans, error);
    tn_sequence_clear(&sequence);
    return status;
}

/* Applies them one by one, so that it is known what each of them does to the number of states. */
static tn_status apply_each(tn_library *library, size_t from, size_t to, tn_sparse **plans, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = from; status == TN_OK && i < to; i++) {
        tn_watch_tell(library->schema->module->watch, (double)i, (double)library->applied_count);
        status = apply_clause(library, library->applied[i], plans, error);
    }
    tn_watch_tell(library->schema->module->watch, 0, 0);
    return status;
}

typedef tn_status apply_clauses(tn_library *library, size_t from, size_t to, tn_sparse **plans, tn_error *error);

/* Puts the clause last of those from..to, if it is one of them: where these end without it. */
static size_t put_last(tn_library *library, size_t from, size_t to, size_t clause)
{
    size_t at = from;
    while (at < to && library->applied[at] != clause)
        at++;
    if (at == to)
        return to;
    memmove(library->applied + at, library->applied + at + 1, (to - at - 1) * sizeof *library->applied);
    library->applied[to - 1] = clause;
    return to - 1;
}

/* Makes the generator of the requirements. If one of them is left out, `live` begins with what the others leave. */
static tn_status combine_requirements(tn_library *library, apply_clauses *apply, tn_error *error)
{
    size_t required = library->required_count;
    list_clauses(library, false);
    tn_status status = tn_library_order(library, NULL, library->applied, required, error);
    size_t others = put_last(library, 0, required, library->apart);
    if (status == TN_OK)
        status = apply(library, 0, others, &library->generator, error);
    if (status == TN_OK && others < required)
        status = tn_sparse_copy(library->generator, &library->live, error);
    return status == TN_OK ? apply(library, others, required, &library->generator, error) : status;
}

static tn_status combine_prunes(tn_library *library, apply_clauses *apply, tn_error *error)
{
    size_t required = library->required_count, count = library->applied_count;
    list_clauses(library, true);
    tn_status status =
        tn_library_order(library, library->generator, library->applied + required, count - required, error);
    size_t others = put_last(library, required, count, library->apart);
    if (status == TN_OK && !library->live)
        status = tn_sparse_copy(library->generator, &library->live, error);
    return status == TN_OK ? apply(library, required, others, &library->live, error) : status;
}

/* Combines the clauses, within the library's lengths or not, in at most `work` steps. */
static tn_status combine_by(tn_library *library, apply_clauses *apply, bool within, uint64_t work, tn_error *error)
{
    forget_combined(library);
    library->within = within;
    library->bounds = tn_library_bounds(library);
    if (work < library->bounds.max_work)
        library->bounds.max_work = work;
    memset(library->growth, 0, library->record->clause_count * sizeof *library->growth);
    tn_status status = tn_library_everything(library, within, &library->generator, error);
    if (status == TN_OK)
        status = combine_requirements(library, apply, error);
    return status == TN_OK ? combine_prunes(library, apply, error) : status;
}

/* In runs, and where these pass a limit clause by clause: that can need less, and tells which clause it is. */
static tn_status try_combine(tn_library *library, bool within, uint64_t work, tn_error *error)
{
    tn_error ignored;
    tn_status status = combine_by(library, apply_runs, within, work, &ignored);
    if (status == TN_LIMIT)
        return combine_by(library, apply_each, within, work, error);
    if (status != TN_OK && error)
        *error = ignored;
    return status;
}

/* ---- leaving a clause out
 *
 * A clause that counts, or compares sums, can multiply the states of all others together. The plans that all clauses
 * keep are then still counted, from the automaton of the others and that of the clause side by side. */

#define APART_STATES 512u /* of the clause: so many numbers go with each state of the others */
#define APART_TRIALS 4u

/* Of the clauses after which `before` (SIZE_MAX: none) was the one that multiplied the states most, that which did so
 * most; SIZE_MAX: there is none that counts side by side with the others. */
static size_t next_apart(const tn_library *library, size_t before)
{
    size_t most = SIZE_MAX;
    for (size_t k = 0; k < library->applied_count; k++) {
        size_t i = library->applied[k];
        bool later = before == SIZE_MAX || library->growth[i] < library->growth[before] ||
                     (library->growth[i] == library->growth[before] && i > before);
        bool more = most == SIZE_MAX || library->growth[i] > library->growth[most] ||
                    (library->growth[i] == library->growth[most] && i < most);
        if (later && more && library->growth[i] > 1000 && library->clauses[i]->states <= APART_STATES)
            most = i;
    }
    return most;
}

/* After the clauses one by one have passed a limit. */
static tn_status combine_apart(tn_library *library, tn_error *error)
{
    size_t tried[APART_TRIALS], count = 0;
    for (size_t i = next_apart(library, SIZE_MAX); i != SIZE_MAX && count < APART_TRIALS; i = next_apart(library, i))
        tried[count++] = i;
    tn_status status = TN_LIMIT;
    for (size_t k = 0; status == TN_LIMIT && k < count; k++) {
        library->apart = tried[k];
        status = combine_by(library, apply_runs, true, UINT64_MAX, error);
    }
    return status;
}

/* Plans of any length make the smallest automaton where rules remember little, and the largest where they remember
 * much. Which way is taken depends on counted work, so it is the same everywhere. */
tn_status tn_library_combine(tn_library *library, bool only_counted, tn_error *error)
{
    tn_error ignored;
    library->growth = calloc((size_t)library->record->clause_count + 1, sizeof *library->growth);
    if (!library->growth)
        return tn_fail_memory(error);
    tn_status status = try_combine(library, false, library->max_eager, error);
    if (status == TN_LIMIT)
        status = try_combine(library, true, UINT64_MAX, error);
    if (status == TN_LIMIT && library->max > FEW_TRAYS && try_combine(library, false, UINT64_MAX, &ignored) == TN_OK)
        status = TN_OK;
    if (status == TN_LIMIT && only_counted) {
        status = combine_apart(library, &ignored);
        if (status != TN_OK && status != TN_LIMIT && error)
            *error = ignored;
    }
    if (status != TN_OK || library->apart != SIZE_MAX)
        return status;
    return tn_sparse_fill(library->live, &library->kept, error);
}
