/* Opens a plan library. */
#include "runtime/plan/library/library.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/plan/library/library_data.h"
#include "runtime/plan/library/others.h"
#include "runtime/plan/match/lower.h"

/* ---- clauses */

static tn_status lower_clauses(tn_library *library, const tn_library_options *options, tn_error *error)
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
        library->applied_count += !tn_library_prunes(library, i) || !options->all_generated;
    }
    tn_lowering *lowering = NULL;
    tn_status status = tn_classes_new(library->schema, functions, count, &library->classes, error);
    if (status == TN_OK && options->classes)
        status = tn_classes_refine(library->classes, options->classes, error);
    if (status == TN_OK)
        status = tn_lowering_new(library->classes, library->max_states, &lowering, error);
    if (status == TN_OK)
        tn_lowering_within(lowering, library->max);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        status = tn_lower(lowering, functions[i], &library->clauses[i], error);
        if (status == TN_LIMIT)
            status = tn_library_name_clause(library, i, error);
    }
    tn_lowering_free(lowering);
    free(functions);
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
    library->apart = SIZE_MAX;
    tn_status status = set_lengths(library, options, error);
    if (status == TN_OK)
        status = add_late(library, error);
    if (status == TN_OK)
        status = lower_clauses(library, options, error);
    if (status == TN_OK)
        status = tn_library_combine(library, options->only_counted, error);
    if (status == TN_OK)
        status = tn_library_tables(library, error);
    if (status == TN_OK)
        status = tn_library_hash_leanings(library, error);
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
    library->apart = SIZE_MAX;
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
    tn_sparse_free(library->generator);
    tn_sparse_free(library->live);
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

size_t tn_library_apart(const tn_library *library)
{
    return library->apart;
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
        state = tn_dfa_read(dfa, state, tn_class_of(library->classes, trays[i]));
    return dfa->accept[state];
}

/* Asks clause by clause, for a library that leaves one of them out of its automaton. */
static bool all_keep(const tn_library *library, const tn_tray *trays, size_t length)
{
    for (size_t k = 0; k < library->applied_count; k++) {
        size_t i = library->applied[k];
        if (accepts(library, library->clauses[i], trays, length) == tn_library_prunes(library, i))
            return false;
    }
    return true;
}

bool tn_library_has(const tn_library *library, const tn_tray *trays, size_t length)
{
    if (length < library->min || length > library->max)
        return false;
    return library->kept ? accepts(library, library->kept, trays, length) : all_keep(library, trays, length);
}
