/* How many plans each clause of a library keeps out, and how many only it keeps out.
 *
 * Only clause i, applied as number i, keeps out what the clauses before it keep, it does not, and those after it keep.
 * So each count starts from an automaton that is needed anyway, and goes on with other plans than the library's: an
 * automaton of its own a clause. Most are soon smaller, and of hundreds of prunes most run empty early. What the
 * clauses after it keep is combined beforehand where that is small (sequence.h), and the last of it is met in a walk
 * that counts and makes nothing. The clauses are independent of one another and go over the threads.
 */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/crew.h"
#include "runtime/plan/library/library_data.h"
#include "runtime/plan/library/sequence.h"

typedef struct tn_counting_alone {
    const tn_library *library;
    size_t *order;        /* [applied_count]: the clauses as they are applied here */
    tn_bounds bounds;     /* of each automaton's making */
    tn_sequence sequence; /* of the clauses in that order */
    tn_effect *effects;
} tn_counting_alone;

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

static tn_status save(tn_counting_alone *counting, size_t to, tn_bounds *bounds, tn_error *error)
{
    const tn_library *library = counting->library;
    for (size_t i = 0; i < library->applied_count; i++) {
        size_t clause = counting->order[i];
        counting->sequence.clauses[i] =
            (tn_sequence_clause){library->clauses[clause], tn_library_keeping(library, clause)};
    }
    return tn_sequence_save(&counting->sequence, to, bounds, error);
}

/* Totals come first, since they bound the plans; what they leave tells how the other requirements are ordered. Prunes
 * are applied as the library does. */
static tn_status begin(tn_counting_alone *counting, bool within, tn_error *error)
{
    const tn_library *library = counting->library;
    tn_sequence *sequence = &counting->sequence;
    size_t count = library->applied_count, required = library->required_count, totals = 0, next = 0;
    tn_bounds bounds = counting->bounds;
    tn_sparse *all = NULL;
    counting->order = malloc((count + 1) * sizeof *counting->order);
    if (!counting->order)
        return tn_fail_memory(error);
    for (size_t i = 0; i < required; i++)
        if (tn_library_clause(library, library->applied[i])->kind == TN_CLAUSE_TOTAL)
            counting->order[totals++] = library->applied[i];
    next = totals;
    for (size_t i = 0; i < count; i++)
        if (tn_library_clause(library, library->applied[i])->kind != TN_CLAUSE_TOTAL)
            counting->order[next++] = library->applied[i];
    tn_status status = tn_library_everything(library, within, &all, error);
    if (status == TN_OK)
        status = tn_sequence_make(sequence, count, all, library->within ? "library, of its lengths alone," : "library",
                                  error);
    if (status == TN_OK && count)
        status = save(counting, totals < count ? totals : count - 1, &bounds, error);
    if (status == TN_OK)
        status = tn_library_order(library, sequence->after[sequence->saved], counting->order + totals,
                                  required - totals, error);
    if (status == TN_OK && count)
        status = save(counting, count - 1, &bounds, error);
    return status == TN_OK ? tn_sequence_make_runs(sequence, &counting->bounds, error) : status;
}

/* Of the clause applied as this number. */
static tn_status count_only(const tn_counting_alone *counting, size_t number, mpz_t only, tn_error *error)
{
    const tn_library *library = counting->library;
    const tn_sequence *sequence = &counting->sequence;
    const tn_dfa *clause = sequence->clauses[number].dfa;
    tn_dfa_operation operation = dropping(library, counting->order[number]);
    tn_bounds bounds = counting->bounds, last = tn_library_bounds(library);
    tn_sparse *base = NULL;
    tn_status status = tn_sequence_before(sequence, number, &bounds, &base, error);
    if (status == TN_OK && number + 1 == sequence->count)
        status = count_with(library, base, clause, operation, only, error);
    else if (status == TN_OK)
        status = tn_sparse_apply(&base, clause, operation, sequence->what, &bounds, error);
    if (status == TN_OK && number + 1 < sequence->count)
        status = tn_sequence_count(sequence, number + 1, library->classes->size, library->min, library->max, &bounds,
                                   &last, &base, only, error);
    tn_sparse_free(base);
    return status;
}

/* Where, and what to do about it. */
static void show_limit(const tn_library *library, size_t clause, tn_error *error)
{
    if (error->code_offset == TN_NO_OFFSET)
        error->code_offset =
            library->schema->module->FUNCTION_records[tn_library_clause(library, clause)->holds].code_begin;
    tn_error_help(error, "give fewer trays with --trays, or raise the limit with --max-states");
}

typedef struct resting {
    tn_counting_alone *counting;
    tn_status started; /* TN_OK, or why no clause can be counted */
    tn_error failure;
} resting;

static void count_clause(void *context, uint32_t i)
{
    const resting *r = context;
    const tn_library *library = r->counting->library;
    size_t clause = r->started == TN_OK ? r->counting->order[i] : library->applied[i];
    tn_effect *effect = &r->counting->effects[clause];
    if (effect->status != TN_LIMIT)
        return;
    effect->status = r->started;
    if (r->started == TN_OK)
        effect->status = count_only(r->counting, i, effect->only, &effect->error);
    else
        effect->error = r->failure;
    if (effect->status == TN_LIMIT)
        show_limit(library, clause, &effect->error);
}

/* What is not counted yet, in at most so many steps a clause as the bounds have. */
static tn_status count_rest(tn_counting_alone *counting, bool within, tn_error *error)
{
    const tn_library *library = counting->library;
    resting r = {.counting = counting};
    tn_crew *crew = tn_crew_new(library->threads, library->schema->module->watch);
    if (!crew)
        return tn_fail_memory(error);
    r.started = begin(counting, within, &r.failure);
    tn_status status = tn_crew_share(crew, (uint32_t)library->applied_count, count_clause, &r, error);
    tn_crew_free(crew);
    for (size_t i = 0; status == TN_OK && i < library->applied_count; i++) {
        const tn_effect *effect = &counting->effects[library->applied[i]];
        if (effect->status == TN_OK || effect->status == TN_LIMIT)
            continue;
        status = effect->status;
        if (error)
            *error = effect->error;
    }
    return status;
}

static bool is_counted(const tn_library *library, const tn_effect *effects)
{
    for (size_t i = 0; i < library->applied_count; i++)
        if (effects[library->applied[i]].status == TN_LIMIT)
            return false;
    return true;
}

static tn_status try_only(const tn_library *library, bool within, uint64_t work, tn_effect *effects, tn_error *error)
{
    tn_counting_alone counting = {.library = library, .bounds = tn_library_bounds(library), .effects = effects};
    if (is_counted(library, effects))
        return TN_OK;
    if (work < counting.bounds.max_work)
        counting.bounds.max_work = work;
    tn_status status = count_rest(&counting, within, error);
    tn_sequence_clear(&counting.sequence);
    free(counting.order);
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

static tn_status find_effects(const tn_library *library, tn_effect *effects, tn_error *error)
{
    tn_sparse *everything = NULL;
    tn_status status = tn_library_everything(library, library->within, &everything, error);
    for (size_t i = 0; status == TN_OK && i < library->applied_count; i++)
        status = count_out(library, everything, library->applied[i], &effects[library->applied[i]], error);
    tn_sparse_free(everything);
    if (status == TN_OK && !library->within)
        status = try_only(library, false, library->max_eager, effects, error);
    return status == TN_OK ? try_only(library, true, UINT64_MAX, effects, error) : status;
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

static tn_status recall_or_find(const tn_library *library, tn_effect *effects, tn_error *error)
{
    tn_memory_key key;
    bool found = false;
    if (!library->memory)
        return find_effects(library, effects, error);
    tn_status status = make_key(library, &key, error);
    if (status == TN_OK)
        status = recall_counts(library, key, effects, &found, error);
    if (status != TN_OK || found)
        return status;
    status = find_effects(library, effects, error);
    if (status == TN_OK)
        keep_counts(library, key, effects);
    return status;
}

static tn_status add_effects(const tn_library *library, tn_error *error)
{
    size_t count = library->record->clause_count;
    tn_effect *effects = calloc(count + 1, sizeof *effects);
    if (!effects)
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++) {
        mpz_inits(effects[i].out, effects[i].only, NULL);
        effects[i].status = TN_LIMIT; /* not counted yet */
    }
    tn_status status = recall_or_find(library, effects, error);
    if (status == TN_OK)
        library->late->effects = effects;
    else
        tn_effects_free(effects, count);
    return status;
}

void tn_effects_free(tn_effect *effects, size_t count)
{
    for (size_t i = 0; effects && i < count; i++)
        mpz_clears(effects[i].out, effects[i].only, NULL);
    free(effects);
}

tn_status tn_library_effect(const tn_library *library, uint32_t i, mpz_t out, mpz_t only, uint32_t *states,
                            tn_error *error)
{
    pthread_mutex_lock(&library->late->lock);
    tn_status status = library->late->effects ? TN_OK : add_effects(library, error);
    pthread_mutex_unlock(&library->late->lock);
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
