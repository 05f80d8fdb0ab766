/* Makes the automaton of a plan library, and counts its plans. */
#include "runtime/plan/library/library_data.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/plan/library/others.h"
#include "runtime/plan/match/lower.h"
#include "runtime/plan/match/rules.h"

#define TRANSITIONS_PER_STATE 64u /* that an automaton may have on average, before states are not its size any more */
#define WORK_PER_STATE 300u
#define FEW_TRAYS 32u      /* of plans: so many automata of one length each are about as large as one of any length */
#define TRIAL_STATES 2000u /* of a generator that trying each clause on is cheap for */

/* ---- clauses */

/* Says in which clause it was that lowering passed a limit. */
static tn_status name_clause(const tn_library *library, size_t i, tn_error *error)
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

static tn_status lower_clauses(tn_library *library, bool all_generated, tn_error *error)
{
    size_t count = library->record->clause_count;
    uint32_t *functions = calloc(count + 1, sizeof *functions);
    library->clauses = calloc(count + 1, sizeof *library->clauses);
    library->applied = calloc(count + 1, sizeof *library->applied);
    if (!functions || !library->clauses || !library->applied) {
        free(functions);
        return tn_fail_memory(error);
    }
    for (size_t i = 0; i < count; i++) {
        functions[i] = tn_library_clause(library, i)->holds;
        library->required_count += !tn_library_prunes(library, i);
        library->applied_count += !tn_library_prunes(library, i) || !all_generated;
    }
    tn_lowering *lowering = NULL;
    tn_status status = tn_classes_new(library->schema, functions, count, &library->classes, error);
    if (status == TN_OK)
        status = tn_lowering_new(library->classes, library->max_states, &lowering, error);
    if (status == TN_OK)
        tn_lowering_within(lowering, library->max);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        status = tn_lower(lowering, functions[i], &library->clauses[i], error);
        if (status == TN_LIMIT)
            status = name_clause(library, i, error);
    }
    tn_lowering_free(lowering);
    free(functions);
    return status;
}

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
    if (status == TN_OK)
        library->growth[i] = (*sparse)->states * UINT64_C(1000) / (before + 1);
    if (status != TN_LIMIT)
        return status;
    if (error)
        error->code_offset = library->schema->module->FUNCTION_records[record->holds].code_begin;
    name_clause(library, i, error);
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

tn_status tn_library_order(const tn_library *library, const tn_sparse *base, size_t *clauses, size_t count,
                           tn_error *error)
{
    uint32_t *sizes = malloc((count + 1) * sizeof *sizes);
    tn_status status = sizes ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        uint32_t size;
        status = try_clause(library, base, clauses[i], &size, error);
        if (status == TN_OK)
            insert(clauses, sizes, i, clauses[i], size);
    }
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

/* Combines the clauses, within the library's lengths or not, in at most `work` steps. */
static tn_status try_combine(tn_library *library, bool within, uint64_t work, tn_error *error)
{
    forget_combined(library);
    library->within = within;
    library->bounds = tn_library_bounds(library);
    if (work < library->bounds.max_work)
        library->bounds.max_work = work;
    memset(library->growth, 0, library->record->clause_count * sizeof *library->growth);
    size_t required = library->required_count;
    list_clauses(library, false);
    list_clauses(library, true);
    tn_status status = tn_library_everything(library, within, &library->generator, error);
    if (status == TN_OK)
        status = tn_library_order(library, NULL, library->applied, required, error);
    for (size_t i = 0; status == TN_OK && i < required; i++)
        status = apply_clause(library, library->applied[i], &library->generator, error);
    if (status == TN_OK)
        status = tn_library_order(library, library->generator, library->applied + required,
                                  library->applied_count - required, error);
    if (status == TN_OK)
        status = tn_sparse_copy(library->generator, &library->live, error);
    for (size_t i = required; status == TN_OK && i < library->applied_count; i++) {
        tn_watch_tell(library->schema->module->watch, (double)i, (double)library->applied_count);
        status = apply_clause(library, library->applied[i], &library->live, error);
    }
    tn_watch_tell(library->schema->module->watch, 0, 0);
    return status;
}

/* Plans of any length make the smallest automaton where rules remember little, and the largest where they remember
 * much. Which way is taken depends on counted work, so it is the same everywhere. */
static tn_status combine(tn_library *library, tn_error *error)
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
    if (status != TN_OK)
        return status;
    return tn_sparse_fill(library->live, &library->kept, error);
}

/* ---- opening */

static tn_status set_lengths(tn_library *library, const tn_library_options *options, tn_error *error)
{
    library->min = options->override_trays ? options->trays_min : library->record->trays_min;
    library->max = options->override_trays ? options->trays_max : library->record->trays_max;
    uint32_t most = options->max_length ? options->max_length : TN_LIBRARY_LENGTH_DEFAULT;
    if (library->min > library->max) {
        library->min = 1;
        library->max = 0;
    }
    if (library->max <= most)
        return TN_OK;
    tn_fail(error, TN_LIMIT, E_PLAN_TOO_LONG, "the library's plans have up to %u trays, which passes the limit of %u",
            library->max, most);
    tn_error_help(error, "give fewer with --trays, or raise the limit with --max-length");
    return TN_LIMIT;
}

static tn_status add_late(tn_library *library, tn_error *error)
{
    tn_library_late *late = calloc(1, sizeof *late);
    if (!late || pthread_mutex_init(&late->lock, NULL) != 0) {
        free(late);
        return tn_fail_memory(error);
    }
    library->late = late;
    return TN_OK;
}

tn_status tn_library_new(const tn_schema *schema, uint32_t index, const tn_library_options *options, tn_library **out,
                         tn_error *error)
{
    static const tn_library_options defaults = {0};
    tn_library *library = calloc(1, sizeof *library);
    if (!library)
        return tn_fail_memory(error);
    options = options ? options : &defaults;
    library->schema = schema;
    library->record = &schema->module->LIBRARY_records[index];
    library->max_states = options->max_states ? options->max_states : TN_STATES_DEFAULT;
    library->max_joint = options->max_states ? options->max_states : TN_LIBRARY_STATES_DEFAULT;
    library->max_table = options->max_table ? options->max_table : TN_LIBRARY_TABLE_DEFAULT;
    library->threads = options->threads;
    library->max_eager = options->max_eager ? options->max_eager : TN_LIBRARY_EAGER_DEFAULT;
    library->memory = options->memory;
    tn_status status = set_lengths(library, options, error);
    if (status == TN_OK)
        status = add_late(library, error);
    if (status == TN_OK)
        status = lower_clauses(library, options->all_generated, error);
    if (status == TN_OK)
        status = combine(library, error);
    if (status == TN_OK)
        status = tn_library_tables(library, error);
    if (status != TN_OK) {
        tn_library_free(library);
        return status;
    }
    *out = library;
    return TN_OK;
}

tn_status tn_library_of(tn_classes *classes, const tn_sparse *sparse, uint32_t min, uint32_t max, uint64_t max_table,
                        tn_library **out, tn_error *error)
{
    tn_library *library = calloc(1, sizeof *library);
    if (!library) {
        tn_classes_free(classes);
        return tn_fail_memory(error);
    }
    library->schema = classes->schema;
    library->classes = classes;
    library->max_table = max_table;
    library->min = min;
    library->max = max;
    tn_status status = add_late(library, error);
    if (status == TN_OK)
        status = tn_sparse_copy(sparse, &library->generator, error);
    if (status == TN_OK)
        status = tn_sparse_copy(sparse, &library->live, error);
    if (status == TN_OK)
        status = tn_sparse_fill(library->live, &library->kept, error);
    if (status == TN_OK)
        status = tn_library_tables(library, error);
    if (status != TN_OK) {
        tn_library_free(library);
        return status;
    }
    *out = library;
    return TN_OK;
}

static void free_late(tn_library *library)
{
    tn_library_late *late = library->late;
    if (!late)
        return;
    size_t clauses = library->record ? library->record->clause_count : 0;
    tn_effects_free(late->effects, clauses);
    for (size_t i = 0; late->alone && i < clauses; i++)
        tn_sparse_free(late->alone[i]);
    free(late->alone);
    tn_sparse_free(late->asked);
    tn_others_free(late->others[0].others);
    tn_others_free(late->others[1].others);
    tn_integers_free(late->mirror, (size_t)library->max + 1);
    pthread_mutex_destroy(&late->lock);
    free(late);
}

void tn_library_free(tn_library *library)
{
    if (!library)
        return;
    free_late(library);
    for (size_t i = 0; library->clauses && i < library->record->clause_count; i++)
        tn_dfa_free(library->clauses[i]);
    for (size_t left = 0; library->rows && left <= library->max; left++)
        tn_count_row_clear(&library->rows[left]);
    forget_combined(library);
    tn_dfa_free(library->kept);
    tn_classes_free(library->classes);
    tn_integers_free(library->generated, (size_t)library->max + 1);
    tn_integers_free(library->before, (size_t)library->max + 2);
    free(library->clauses);
    free(library->applied);
    free(library->growth);
    free(library->hash_room);
    free(library->rows);
    free(library->nearly);
    free(library->alive);
    free(library->tray_column);
    free(library->run_end);
    free(library->passed);
    free(library);
}

/* ---- what it is */

uint32_t tn_library_states(const tn_library *library)
{
    const tn_sparse *live = library->live;
    bool dead = live->first[live->states] < (size_t)live->states * live->columns;
    return live->states + (dead || live->states == 0);
}

const tn_library_record *tn_library_record_of(const tn_library *library)
{
    return library->record;
}

bool tn_library_within(const tn_library *library)
{
    return library->within;
}

uint32_t tn_library_min(const tn_library *library)
{
    return library->min;
}

uint32_t tn_library_max(const tn_library *library)
{
    return library->max;
}

const tn_schema *tn_library_schema(const tn_library *library)
{
    return library->schema;
}

static bool accepts(const tn_library *library, const tn_dfa *dfa, const tn_tray *trays, size_t length)
{
    uint32_t state = 0;
    for (size_t i = 0; i < length; i++)
        state = tn_dfa_read(dfa, state, library->classes->of_tray[trays[i]]);
    return dfa->accept[state];
}

bool tn_library_has(const tn_library *library, const tn_tray *trays, size_t length)
{
    return length >= library->min && length <= library->max && accepts(library, library->kept, trays, length);
}
