/* How many plans each clause of a library keeps out, and how many only it keeps out (others.h). The clauses are
 * independent of one another and go over the threads.
 */
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/automata/shortest.h"
#include "runtime/base/crew.h"
#include "runtime/plan/library/alone.h"
#include "runtime/plan/library/others.h"

static tn_dfa_operation dropping(const tn_library *library, size_t clause)
{
    return tn_library_prunes(library, clause) ? TN_DFA_AND : TN_DFA_MINUS;
}

/* How many plans of the library's lengths `base` accepts and the clause matches (TN_DFA_AND) or does not. */
static tn_status count_with(const tn_library *library, const tn_sparse *base, const tn_dfa *clause,
                            tn_dfa_operation operation, mpz_t count, tn_error *error)
{
    tn_bounds bounds = tn_library_bounds(library);
    return tn_count_both(base, clause, operation, library->classes->size, library->min, library->max, "library",
                         &bounds, count, error);
}

/* Where, and what to do about it. */
static void show_limit(const tn_library *library, size_t clause, tn_error *error)
{
    if (error && error->code_offset == TN_NO_OFFSET)
        error->code_offset =
            library->schema->module->FUNCTION_records[tn_library_clause(library, clause)->holds].code_begin;
    tn_error_help(error, "give fewer trays with --trays, or raise the limit with --max-states");
}

static bool is_counted(const tn_library *library, const tn_effect *effects)
{
    for (size_t i = 0; i < library->applied_count; i++)
        if (effects[library->applied[i]].status == TN_LIMIT)
            return false;
    return true;
}

/* Counting what is not counted yet. */
typedef struct tn_counting_rest {
    const tn_library *library;
    tn_effect *effects;
    const tn_others *others;
    tn_status started; /* TN_OK, or why no clause can be counted */
    tn_error failure;
    bool keeping;
    pthread_mutex_t lock; /* held while an automaton is kept */
    atomic_uint done;
} tn_counting_rest;

/* Counts from the automaton, and keeps that. */
static tn_status count_kept(tn_counting_rest *rest, size_t number, tn_effect *effect, tn_error *error)
{
    const tn_library *library = rest->library;
    tn_sparse *plans = NULL;
    tn_status status = tn_others_alone(rest->others, number, &plans, error);
    if (status == TN_OK)
        status = tn_count_range(plans, library->classes->size, library->min, library->max, effect->only,
                                library->schema->module->watch, error);
    if (status == TN_OK)
        status = tn_sparse_shortest(plans, library->min, library->max, &effect->shortest, &effect->looked, error);
    effect->looked = status == TN_OK;
    if (status == TN_OK) {
        pthread_mutex_lock(&rest->lock);
        if (tn_library_keep_alone(library, rest->others->order[number], plans))
            plans = NULL;
        pthread_mutex_unlock(&rest->lock);
    }
    tn_sparse_free(plans);
    return status;
}

static void count_clause(void *context, uint32_t i)
{
    tn_counting_rest *rest = context;
    const tn_library *library = rest->library;
    size_t clause = rest->started == TN_OK ? rest->others->order[i] : library->applied[i];
    tn_effect *effect = &rest->effects[clause];
    if (effect->status == TN_LIMIT && rest->started != TN_OK) {
        effect->status = rest->started;
        effect->error = rest->failure;
    } else if (effect->status == TN_LIMIT) {
        effect->status = rest->keeping ? count_kept(rest, i, effect, &effect->error)
                                       : tn_others_count_alone(rest->others, i, effect->only, &effect->error);
    }
    if (effect->status == TN_LIMIT)
        show_limit(library, clause, &effect->error);
    tn_watch_tell(library->schema->module->watch, atomic_fetch_add(&rest->done, 1) + 1, (double)library->applied_count);
}

static tn_status try_only(const tn_library *library, bool within, bool keeping, tn_effect *effects, tn_error *error)
{
    tn_counting_rest rest = {.library = library, .effects = effects, .keeping = keeping};
    if (is_counted(library, effects))
        return TN_OK;
    tn_crew *crew = tn_crew_new(library->threads, library->schema->module->watch);
    if (!crew || pthread_mutex_init(&rest.lock, NULL) != 0) {
        tn_crew_free(crew);
        return tn_fail_memory(error);
    }
    rest.started = tn_others_make(library, within, &rest.others, &rest.failure);
    tn_status status = tn_crew_share(crew, (uint32_t)library->applied_count, count_clause, &rest, error);
    tn_crew_free(crew);
    pthread_mutex_destroy(&rest.lock);
    for (size_t i = 0; status == TN_OK && i < library->applied_count; i++) {
        const tn_effect *effect = &effects[library->applied[i]];
        if (effect->status == TN_OK || effect->status == TN_LIMIT)
            continue;
        status = effect->status;
        if (error)
            *error = effect->error;
    }
    return status;
}

/* How many plans clause i keeps out: a prune, of those generated; a requirement, of all. */
static tn_status count_out(const tn_library *library, const tn_sparse *everything, size_t i, tn_effect *effect,
                           tn_error *error)
{
    const tn_sparse *base = tn_library_prunes(library, i) ? library->generator : everything;
    tn_status status =
        count_with(library, base, library->clauses[i], dropping(library, i), effect->out, &effect->error);
    if (status == TN_LIMIT) {
        mpz_set_si(effect->out, -1);
        show_limit(library, i, &effect->error);
        return TN_OK;
    }
    if (status != TN_OK && error)
        *error = effect->error;
    return status;
}

/* What the other clauses leave is one automaton only for the clause that it leaves out. */
static tn_status count_apart(const tn_library *library, tn_effect *effects, tn_error *error)
{
    tn_effect *apart = &effects[library->apart];
    for (size_t i = 0; i < library->applied_count; i++) {
        tn_effect *effect = &effects[library->applied[i]];
        tn_fail(&effect->error, TN_LIMIT, E_TOO_MANY_STATES,
                "the automaton of this library, of its lengths alone, passes the limit of %u states",
                library->max_joint);
        show_limit(library, library->applied[i], &effect->error);
    }
    apart->status = tn_count_range(library->live, library->classes->size, library->min, library->max, apart->only,
                                   library->schema->module->watch, error);
    mpz_sub(apart->only, apart->only, library->before[library->max + 1]);
    return apart->status;
}

static tn_status find_effects(const tn_library *library, bool keeping, tn_effect *effects, tn_error *error)
{
    tn_sparse *everything = NULL;
    tn_status status = tn_library_everything(library, library->within, &everything, error);
    for (size_t i = 0; status == TN_OK && i < library->applied_count; i++)
        status = count_out(library, everything, library->applied[i], &effects[library->applied[i]], error);
    tn_sparse_free(everything);
    if (status == TN_OK && library->apart != SIZE_MAX)
        return count_apart(library, effects, error);
    if (status == TN_OK && !tn_others_bounded(library))
        status = try_only(library, false, keeping, effects, error);
    return status == TN_OK ? try_only(library, true, keeping, effects, error) : status;
}

/* ---- counts kept from before */

#define NUMBER_BYTES 64u /* of a count that is kept */

/* What is kept of a library's clauses: of each, two counts. */
typedef struct tn_kept_counts {
    uint8_t out[NUMBER_BYTES], only[NUMBER_BYTES]; /* the lowest byte first */
} tn_kept_counts;

/* All that the counts depend on. */
static tn_status make_key(const tn_library *library, tn_memory_key *key, tn_error *error)
{
    enum { NUMBERS = 6 };
    const tn_classes *classes = library->classes;
    size_t count = library->applied_count, numbers = NUMBERS + classes->count;
    uint64_t *subject = malloc(numbers * sizeof *subject);
    tn_memory_part *parts = malloc((count + 1) * sizeof *parts);
    if (subject && parts) {
        const uint64_t first[NUMBERS] = {
            'e', library->min, library->max, library->max_joint, library->max_eager, library->max_states};
        memcpy(subject, first, sizeof first);
        for (uint32_t c = 0; c < classes->count; c++)
            subject[NUMBERS + c] = classes->size[c];
        for (size_t i = 0; i < count; i++)
            parts[i] = (tn_memory_part){library->clauses[library->applied[i]],
                                        (uint32_t)tn_library_clause(library, library->applied[i])->kind};
        *key = tn_memory_key_make(subject, numbers, parts, count);
    }
    bool made = subject && parts;
    free(subject);
    free(parts);
    return made ? TN_OK : tn_fail_memory(error);
}

static bool write_number(const mpz_t number, uint8_t *bytes)
{
    if (mpz_sgn(number) < 0 || mpz_sizeinbase(number, 2) > (size_t)8 * NUMBER_BYTES)
        return false;
    mpz_export(bytes, NULL, -1, 1, 0, 0, number);
    return true;
}

/* Keeps the counts, where all clauses are counted. */
static void keep_counts(const tn_library *library, tn_memory_key key, const tn_effect *effects)
{
    size_t count = library->applied_count;
    tn_kept_counts *kept = calloc(count + 1, sizeof *kept);
    bool all = kept != NULL;
    for (size_t i = 0; all && i < count; i++) {
        const tn_effect *effect = &effects[library->applied[i]];
        all = effect->status == TN_OK && write_number(effect->out, kept[i].out) &&
              write_number(effect->only, kept[i].only);
    }
    if (all)
        tn_plan_memory_keep(library->memory, key, kept, count * sizeof *kept);
    free(kept);
}

/* Fills in counts that were kept; *found: were they? */
static tn_status recall_counts(const tn_library *library, tn_memory_key key, tn_effect *effects, bool *found,
                               tn_error *error)
{
    size_t count = library->applied_count;
    tn_kept_counts *kept = malloc((count + 1) * sizeof *kept);
    if (!kept)
        return tn_fail_memory(error);
    *found = tn_plan_memory_find(library->memory, key, kept, count * sizeof *kept);
    for (size_t i = 0; *found && i < count; i++) {
        tn_effect *effect = &effects[library->applied[i]];
        mpz_import(effect->out, NUMBER_BYTES, -1, 1, 0, 0, kept[i].out);
        mpz_import(effect->only, NUMBER_BYTES, -1, 1, 0, 0, kept[i].only);
        effect->status = TN_OK;
    }
    free(kept);
    return TN_OK;
}

static tn_status recall_or_find(const tn_library *library, bool keeping, tn_effect *effects, tn_error *error)
{
    tn_memory_key key;
    bool found = false;
    if (!library->memory || keeping)
        return find_effects(library, keeping, effects, error);
    tn_status status = make_key(library, &key, error);
    if (status == TN_OK)
        status = recall_counts(library, key, effects, &found, error);
    if (status != TN_OK || found)
        return status;
    status = find_effects(library, false, effects, error);
    if (status == TN_OK)
        keep_counts(library, key, effects);
    return status;
}

/* keeping: keep also the automata of what clauses alone keep out. */
static tn_status add_effects(const tn_library *library, bool keeping, tn_error *error)
{
    size_t count = library->record->clause_count;
    tn_effect *effects = calloc(count + 1, sizeof *effects);
    if (!effects)
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++) {
        mpz_inits(effects[i].out, effects[i].only, NULL);
        effects[i].status = TN_LIMIT; /* not counted yet */
    }
    tn_status status = recall_or_find(library, keeping, effects, error);
    if (status == TN_OK)
        library->late->effects = effects;
    else
        tn_effects_free(effects, count);
    return status;
}

void tn_effects_free(tn_effect *effects, size_t count)
{
    for (size_t i = 0; effects && i < count; i++) {
        mpz_clears(effects[i].out, effects[i].only, NULL);
        free(effects[i].shortest.data);
    }
    free(effects);
}

static tn_status ready_effects(const tn_library *library, bool keeping, tn_error *error)
{
    pthread_mutex_lock(&library->late->lock);
    tn_status status = library->late->effects ? TN_OK : add_effects(library, keeping, error);
    pthread_mutex_unlock(&library->late->lock);
    return status;
}

tn_status tn_library_find_alone(const tn_library *library, tn_error *error)
{
    return ready_effects(library, true, error);
}

tn_status tn_library_effect(const tn_library *library, uint32_t i, mpz_t out, mpz_t only, uint32_t *states,
                            tn_error *error)
{
    tn_status status = ready_effects(library, false, error);
    if (status != TN_OK)
        return status;
    const tn_effect *effect = &library->late->effects[i];
    *states = library->clauses[i]->states;
    mpz_set(out, effect->out);
    mpz_set(only, effect->only);
    if (effect->status == TN_LIMIT)
        mpz_set_si(only, -1);
    if (effect->status == TN_OK && mpz_sgn(out) >= 0)
        return TN_OK;
    if (error)
        *error = effect->error;
    return TN_LIMIT;
}
