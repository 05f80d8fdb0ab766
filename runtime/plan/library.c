#include "runtime/plan/library_data.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/plan/lower.h"
#include "runtime/plan/rules.h"

mpz_t *tn_integers_new(size_t count)
{
    mpz_t *integers = calloc(count + 1, sizeof *integers);
    for (size_t i = 0; integers && i < count; i++)
        mpz_init(integers[i]);
    return integers;
}

void tn_integers_free(mpz_t *integers, size_t count)
{
    for (size_t i = 0; integers && i < count; i++)
        mpz_clear(integers[i]);
    free(integers);
}

#define TRIAL_STATES 2000u /* of a generator that trying each clause on is cheap for */

/* ---- clauses */

static const tn_clause_record *clause_record(const tn_library *library, size_t i)
{
    return &library->schema->module->CLAUSE_records[library->record->clause_first + i];
}

static bool is_prune(const tn_library *library, size_t i)
{
    return clause_record(library, i)->kind == TN_CLAUSE_PRUNE;
}

/* Says in which clause it was that lowering passed a limit. */
static tn_status name_clause(const tn_library *library, size_t i, tn_error *error)
{
    if (!error)
        return TN_LIMIT;
    tn_error inner = *error;
    const char *name = tn_text(library->schema->module, clause_record(library, i)->name);
    tn_fail(error, inner.status, inner.code, "in the clause '%.80s': %.360s", name, inner.message);
    tn_error_help(error, "%s", inner.help);
    error->code_offset = inner.code_offset;
    return inner.status;
}

static tn_status lower_clauses(tn_library *library, tn_error *error)
{
    size_t count = library->record->clause_count;
    uint32_t *functions = calloc(count + 1, sizeof *functions);
    library->clauses = calloc(count + 1, sizeof *library->clauses);
    library->prunes = calloc(count + 1, sizeof *library->prunes);
    if (!functions || !library->clauses || !library->prunes) {
        free(functions);
        return tn_fail_memory(error);
    }
    for (size_t i = 0; i < count; i++) {
        functions[i] = clause_record(library, i)->holds;
        if (is_prune(library, i))
            library->prunes[library->prune_count++] = i;
    }
    tn_lowering *lowering = NULL;
    tn_status status = tn_classes_new(library->schema, functions, count, &library->classes, error);
    if (status == TN_OK)
        status = tn_lowering_new(library->classes, library->max_states, &lowering, error);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        status = tn_lower(lowering, functions[i], &library->clauses[i], error);
        if (status == TN_LIMIT)
            status = name_clause(library, i, error);
    }
    tn_lowering_free(lowering);
    free(functions);
    return status;
}

tn_status tn_library_apply(const tn_library *library, const tn_dfa *clause, tn_dfa_operation operation,
                           tn_sparse **sparse, tn_error *error)
{
    tn_bounds bounds = tn_bounds_make(library->max_joint);
    tn_sparse *product = NULL, *small = NULL;
    tn_status status = tn_sparse_product(*sparse, clause, operation, "library", &bounds, &product, error);
    if (status == TN_OK)
        status = tn_sparse_minimise(product, &small, error);
    tn_sparse_free(product);
    if (status != TN_OK)
        return status;
    tn_sparse_free(*sparse);
    *sparse = small;
    return TN_OK;
}

static tn_status apply_clause(const tn_library *library, size_t i, tn_sparse **sparse, tn_error *error)
{
    const tn_clause_record *record = clause_record(library, i);
    tn_dfa_operation operation = is_prune(library, i) ? TN_DFA_MINUS : TN_DFA_AND;
    tn_status status = tn_library_apply(library, library->clauses[i], operation, sparse, error);
    if (status != TN_LIMIT)
        return status;
    if (error)
        error->code_offset = library->schema->module->FUNCTION_records[record->holds].code_begin;
    return name_clause(library, i, error);
}

/* Everything, to begin with. */
static tn_status everything(const tn_library *library, tn_sparse **out, tn_error *error)
{
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

/* Applies the requirements, those with the fewest states first. */
static tn_status require(tn_library *library, tn_error *error)
{
    size_t all = library->record->clause_count, count = 0;
    size_t *order = malloc((all + 1) * sizeof *order);
    uint32_t *sizes = malloc((all + 1) * sizeof *sizes);
    tn_status status = order && sizes ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < all; i++)
        if (!is_prune(library, i))
            insert(order, sizes, count++, i, library->clauses[i]->states);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        status = apply_clause(library, order[i], &library->generator, error);
    free(order);
    free(sizes);
    return status;
}

/* How large the generator is without what one clause prunes: some clauses multiply states, others hardly add any. A
 * generator too large for so many trials: the clause's own size. */
static tn_status try_prune(const tn_library *library, size_t i, uint32_t *size, tn_error *error)
{
    const tn_dfa *clause = library->clauses[library->prunes[i]];
    *size = clause->states;
    if (library->generator->states > TRIAL_STATES)
        return TN_OK;
    tn_sparse *trial = NULL;
    tn_status status = tn_sparse_minimise(library->generator, &trial, error); /* a copy */
    if (status == TN_OK)
        status = tn_library_apply(library, clause, TN_DFA_MINUS, &trial, error);
    if (status == TN_OK)
        *size = trial->states;
    tn_sparse_free(trial);
    return status == TN_LIMIT ? TN_OK : status;
}

/* Orders the prunes so that those that multiply states come last, when the automaton is as large as it gets anyway. */
static tn_status order_prunes(tn_library *library, tn_error *error)
{
    size_t count = library->prune_count;
    uint32_t *sizes = malloc((count + 1) * sizeof *sizes);
    library->order = malloc((count + 1) * sizeof *library->order);
    tn_status status = sizes && library->order ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        uint32_t size;
        status = try_prune(library, i, &size, error);
        insert(library->order, sizes, i, i, size);
    }
    free(sizes);
    return status;
}

static tn_status combine(tn_library *library, tn_error *error)
{
    tn_status status = everything(library, &library->generator, error);
    if (status == TN_OK)
        status = require(library, error);
    if (status == TN_OK)
        status = order_prunes(library, error);
    if (status == TN_OK)
        status = tn_sparse_minimise(library->generator, &library->live, error); /* a copy */
    for (size_t i = 0; status == TN_OK && i < library->prune_count; i++)
        status = apply_clause(library, library->prunes[library->order[i]], &library->live, error);
    if (status == TN_OK)
        status = tn_sparse_complete(library->live, &library->kept, error);
    return status;
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
    tn_fail(error, TN_LIMIT, 805, "the library's plans have up to %u trays, which passes the limit of %u", library->max,
            most);
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
    tn_status status = set_lengths(library, options, error);
    if (status == TN_OK)
        status = add_late(library, error);
    if (status == TN_OK)
        status = lower_clauses(library, error);
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

static void free_late(tn_library *library)
{
    tn_library_late *late = library->late;
    if (!late)
        return;
    tn_integers_free(late->prunes, library->prune_count);
    tn_integers_free(late->only, library->prune_count);
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
        tn_row_clear(&library->rows[left]);
    tn_sparse_free(library->generator);
    tn_sparse_free(library->live);
    tn_dfa_free(library->kept);
    tn_classes_free(library->classes);
    tn_integers_free(library->generated, (size_t)library->max + 1);
    tn_integers_free(library->before, (size_t)library->max + 2);
    free(library->clauses);
    free(library->prunes);
    free(library->order);
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
    return library->kept->states;
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

uint32_t tn_library_failing(const tn_library *library, const tn_tray *trays, size_t length)
{
    for (size_t i = 0; i < library->record->clause_count; i++)
        if (accepts(library, library->clauses[i], trays, length) == is_prune(library, i))
            return (uint32_t)(library->record->clause_first + i);
    return UINT32_MAX;
}
