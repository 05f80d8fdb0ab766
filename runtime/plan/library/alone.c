/* Answers what single clauses of a library do as automata, counts and shortest plans. */
#include "runtime/plan/library/alone.h"

#include <stdlib.h>

#include "runtime/automata/shortest.h"
#include "runtime/plan/library/others.h"

#define ALONE_EDGES (UINT64_C(1) << 25) /* of the automata kept: 256 MB */

const tn_classes *tn_library_classes(const tn_library *library)
{
    return library->classes;
}

tn_dfa *tn_library_automaton(const tn_library *library, uint32_t i)
{
    return library->clauses[i];
}

uint32_t tn_library_max_states(const tn_library *library)
{
    return library->max_states;
}

bool tn_library_keep_alone(const tn_library *library, size_t i, tn_sparse *plans)
{
    tn_library_late *late = library->late;
    uint64_t edges = plans->first[plans->states] + plans->states;
    if (!late->alone)
        late->alone = calloc((size_t)library->record->clause_count + 1, sizeof *late->alone);
    if (!late->alone || late->alone[i] || late->alone_edges + edges > ALONE_EDGES)
        return false;
    late->alone[i] = plans;
    late->alone_edges += edges;
    return true;
}

/* What asks the clauses in a row, of plans of any length or within the library's. */
typedef tn_status ask(const tn_others *others, const void *what, void *answer, tn_error *error);

/* Asks of plans of any length first, where the library is such, and then within its lengths. */
static tn_status ask_others(const tn_library *library, ask *question, const void *what, void *answer, tn_error *error)
{
    tn_status status = TN_LIMIT;
    for (int within = tn_others_bounded(library); status == TN_LIMIT && within < 2; within++) {
        const tn_others *others;
        status = tn_others_make(library, within, &others, error);
        if (status == TN_OK)
            status = question(others, what, answer, error);
    }
    if (status == TN_LIMIT && error)
        tn_error_help(error, "give fewer trays with --trays, or raise the limit with --max-states");
    return status;
}

static tn_status ask_alone(const tn_others *others, const void *what, void *answer, tn_error *error)
{
    return tn_others_alone(others, others->place[*(const uint32_t *)what], (tn_sparse **)answer, error);
}

tn_status tn_library_alone(const tn_library *library, uint32_t i, const tn_sparse **plans, tn_error *error)
{
    tn_library_late *late = library->late;
    tn_sparse *made = NULL;
    if (late->alone && late->alone[i]) {
        *plans = late->alone[i];
        return TN_OK;
    }
    if (late->asked && late->asked_of == i) {
        *plans = late->asked;
        return TN_OK;
    }
    if (late->effects && late->effects[i].status == TN_LIMIT) {
        if (error)
            *error = late->effects[i].error;
        return TN_LIMIT;
    }
    tn_status status = ask_others(library, ask_alone, &i, &made, error);
    if (status != TN_OK)
        return status;
    *plans = made;
    if (tn_library_keep_alone(library, i, made))
        return TN_OK;
    tn_sparse_free(late->asked);
    late->asked = made;
    late->asked_of = i;
    return TN_OK;
}

static tn_status ask_count_alone(const tn_others *others, const void *what, void *answer, tn_error *error)
{
    return tn_others_count_alone(others, others->place[*(const uint32_t *)what], (mpz_ptr)answer, error);
}

tn_status tn_library_alone_any(const tn_library *library, uint32_t i, bool *any, tn_error *error)
{
    const tn_effect *effect = library->late->effects ? &library->late->effects[i] : NULL;
    if (effect && effect->status == TN_OK) {
        *any = mpz_sgn(effect->only) > 0;
        return TN_OK;
    }
    mpz_t count;
    mpz_init(count);
    tn_status status = ask_others(library, ask_count_alone, &i, count, error);
    *any = status == TN_OK && mpz_sgn(count) > 0;
    mpz_clear(count);
    return status;
}

/* What is asked of the clauses that are not skipped. */
typedef struct question_without {
    const bool *skipped;
    const tn_dfa *plans;
} question_without;

static tn_status ask_count(const tn_others *others, const void *what, void *answer, tn_error *error)
{
    const question_without *question = what;
    return tn_others_count(others, question->skipped, question->plans, (mpz_ptr)answer, error);
}

tn_status tn_library_count_without(const tn_library *library, const bool *skipped, const tn_dfa *plans, mpz_t count,
                                   tn_error *error)
{
    const question_without question = {skipped, plans};
    return ask_others(library, ask_count, &question, count, error);
}

static tn_status count_both(const tn_library *library, const tn_sparse *plans, const tn_dfa *dfa,
                            tn_dfa_operation operation, mpz_t count, tn_error *error)
{
    tn_bounds bounds = tn_library_bounds(library);
    return tn_count_both(plans, dfa, operation, library->classes->size, library->min, library->max, "library", &bounds,
                         count, error);
}

tn_status tn_library_count_kept(const tn_library *library, const tn_dfa *plans, mpz_t count, tn_error *error)
{
    return count_both(library, library->live, plans, TN_DFA_AND, count, error);
}

tn_status tn_library_count_alone_less(const tn_library *library, uint32_t i, const tn_dfa *plans, mpz_t count,
                                      tn_error *error)
{
    const tn_effect *effect = library->late->effects ? &library->late->effects[i] : NULL;
    const tn_sparse *alone;
    if (plans->states == 1 && !plans->accept[0] && effect && effect->status == TN_OK) {
        mpz_set(count, effect->only);
        return TN_OK;
    }
    tn_status status = tn_library_alone(library, i, &alone, error);
    return status == TN_OK ? count_both(library, alone, plans, TN_DFA_MINUS, count, error) : status;
}

/* ---- shortest plans */

static tn_status read_trays(const tn_library *library, const tn_key *word, tn_tray **trays, size_t *length,
                            tn_error *error)
{
    *length = word->size;
    *trays = malloc((word->size + 1) * sizeof **trays);
    for (size_t i = 0; *trays && i < word->size; i++)
        (*trays)[i] = library->classes->representative[word->data[i]];
    return *trays ? TN_OK : tn_fail_memory(error);
}

static tn_status shortest(const tn_library *library, const tn_sparse *plans, tn_tray **trays, size_t *length,
                          bool *found, tn_error *error)
{
    tn_key word = {0};
    *trays = NULL;
    tn_status status = tn_sparse_shortest(plans, library->min, library->max, &word, found, error);
    if (status == TN_OK && *found)
        status = read_trays(library, &word, trays, length, error);
    free(word.data);
    return status;
}

tn_status tn_library_alone_shortest(const tn_library *library, uint32_t i, tn_tray **trays, size_t *length, bool *found,
                                    tn_error *error)
{
    const tn_effect *effect = library->late->effects ? &library->late->effects[i] : NULL;
    const tn_sparse *plans;
    if (effect && effect->looked) {
        *trays = NULL;
        *found = mpz_sgn(effect->only) > 0;
        return *found ? read_trays(library, &effect->shortest, trays, length, error) : TN_OK;
    }
    tn_status status = tn_library_alone(library, i, &plans, error);
    return status == TN_OK ? shortest(library, plans, trays, length, found, error) : status;
}

static tn_status combined_shortest(const tn_library *library, const tn_sparse *from, const tn_dfa *with,
                                   tn_tray **trays, size_t *length, bool *found, tn_error *error)
{
    tn_bounds bounds = tn_library_bounds(library);
    tn_sparse *plans = NULL;
    *trays = NULL;
    tn_status status = tn_sparse_combine(from, with, TN_DFA_AND, "library", &bounds, &plans, error);
    if (status == TN_OK)
        status = shortest(library, plans, trays, length, found, error);
    tn_sparse_free(plans);
    return status;
}

tn_status tn_library_pruned_shortest(const tn_library *library, uint32_t i, tn_tray **trays, size_t *length,
                                     bool *found, tn_error *error)
{
    return combined_shortest(library, library->generator, library->clauses[i], trays, length, found, error);
}

tn_status tn_library_kept_shortest(const tn_library *library, const tn_dfa *plans, tn_tray **trays, size_t *length,
                                   bool *found, tn_error *error)
{
    return combined_shortest(library, library->live, plans, trays, length, found, error);
}

static tn_status ask_left(const tn_others *others, const void *what, void *answer, tn_error *error)
{
    const question_without *question = what;
    return tn_others_left(others, question->skipped, question->plans, (tn_sparse **)answer, error);
}

tn_status tn_library_shortest_without(const tn_library *library, const bool *skipped, const tn_dfa *plans,
                                      tn_tray **trays, size_t *length, bool *found, tn_error *error)
{
    const question_without question = {skipped, plans};
    tn_sparse *left = NULL;
    *trays = NULL;
    tn_status status = ask_others(library, ask_left, &question, &left, error);
    if (status == TN_OK)
        status = shortest(library, left, trays, length, found, error);
    tn_sparse_free(left);
    return status;
}
