/* Scores: each sentence is evaluated once, by all threads, or recalled. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

#include "runtime/genome/breeding/evolve_state.h"

/* ==== remembers the scores of sentences */

void tn_score_cache_clear(tn_score_cache *cache)
{
    free(cache->entries);
    tn_hash_clear(&cache->index);
    *cache = (tn_score_cache){0};
}

typedef struct wanted_score {
    const tn_score_cache *cache;
    const uint64_t *hash;
} wanted_score;

static bool is_wanted(const void *context, uint32_t number)
{
    const wanted_score *w = context;
    const tn_cached_score *entry = &w->cache->entries[number];
    return entry->hash[0] == w->hash[0] && entry->hash[1] == w->hash[1];
}

/* Makes a place for the sentence; *is_new where it was not there. */
static tn_status score_cache_enter(tn_score_cache *cache, const uint64_t hash[2], bool *is_new, tn_error *error)
{
    *is_new = false;
    if (!tn_array_reserve(&cache->entries, &cache->capacity, cache->count, 1, sizeof *cache->entries))
        return tn_fail_memory(error);
    uint32_t number = (uint32_t)cache->count;
    wanted_score wanted = {cache, hash};
    tn_status status = tn_hash_enter(&cache->index, hash[0], is_wanted, &wanted, &number, error);
    *is_new = status == TN_OK && number == cache->count;
    if (*is_new)
        cache->entries[cache->count++] = (tn_cached_score){.hash = {hash[0], hash[1]}};
    return status;
}

/* The score of a sentence that was entered. */
static tn_score *score_of(const tn_score_cache *cache, const uint64_t hash[2])
{
    wanted_score wanted = {cache, hash};
    return &cache->entries[tn_hash_find(&cache->index, hash[0], is_wanted, &wanted)].score;
}

/* ==== the errors of a generation's members in single cases. A run that is made again recalls who the parents were, and
 * finds the errors only of the members that it goes on with: those that no score holds are not stored */

static tn_status find_errors(void *context, unsigned thread, size_t item, tn_error *error)
{
    tn_evolution *e = context;
    const tn_individual *member = e->members[item];
    double *errors = malloc(e->evaluator.cases * sizeof *errors);
    if (!errors)
        return tn_fail_memory(error);
    tn_status status = TN_OK;
    for (size_t i = 0; i < e->evaluator.cases; i++)
        errors[i] = HUGE_VAL;
    bool scored = member->score.state == TN_SCORED, held = !e->evaluator.evaluate_cases;
    for (size_t i = 0; scored && held && i < e->evaluator.cases; i++)
        errors[i] = member->score.objectives[e->evaluator.objectives + i];
    if (scored && !held)
        status = e->evaluator.evaluate_cases(e->evaluator.context, thread, member->sentence, member->sentence_size,
                                             errors, error);
    if (status == TN_OK)
        tn_lexicase_put(&e->lexicase, item, errors);
    free(errors);
    return status;
}

/* ---- with other ranks: of each member its number, then its errors */

static size_t errors_size(const void *context, size_t item)
{
    const tn_evolution *e = context;
    (void)item;
    return sizeof item + e->evaluator.cases * sizeof(double);
}

static uint8_t *write_errors(const void *context, size_t item, uint8_t *end)
{
    const tn_lexicase *lexicase = &((const tn_evolution *)context)->lexicase;
    memcpy(end, &item, sizeof item);
    end += sizeof item;
    for (size_t i = 0; i < lexicase->cases; i++, end += sizeof(double))
        memcpy(end, &lexicase->errors[i * lexicase->members + item], sizeof(double));
    return end;
}

static const uint8_t *read_errors(void *context, const uint8_t *bytes)
{
    tn_lexicase *lexicase = &((tn_evolution *)context)->lexicase;
    size_t item;
    memcpy(&item, bytes, sizeof item);
    bytes += sizeof item;
    for (size_t i = 0; i < lexicase->cases; i++, bytes += sizeof(double))
        memcpy(&lexicase->errors[i * lexicase->members + item], bytes, sizeof(double));
    return bytes;
}

static tn_status find_all(tn_evolution *e, tn_status status, tn_error *error)
{
    const tn_shared_work work = {.context = e,
                                 .items = e->member_count,
                                 .work = find_errors,
                                 .size = errors_size,
                                 .write = write_errors,
                                 .read = read_errors};
    if (tn_ranks_several(e->settings.ranks))
        return tn_evolution_share(e, status, &work, error);
    if (status == TN_OK)
        status = tn_crew_run(e->crew, e->member_count, 8, find_errors, e, error);
    return status;
}

tn_status tn_evolution_find_cases(tn_evolution *e, tn_status status, tn_error *error)
{
    uint64_t parents[2];
    tn_selection selection = e->settings.select.selection;
    tn_lexicase_clear(&e->lexicase);
    if ((selection != TN_SELECT_LEXICASE && selection != TN_SELECT_EPSILON_LEXICASE) || e->chosen)
        return status;
    if (e->recall_parents && e->recall_parents(e->recall_context, e->born[0]->id, parents))
        return status;
    if (status == TN_OK)
        status = tn_lexicase_new(e->member_count, e->evaluator.cases, e->threads, &e->lexicase, error);
    status = find_all(e, status, error);
    if (status == TN_OK && selection == TN_SELECT_EPSILON_LEXICASE)
        status = tn_lexicase_find_epsilons(&e->lexicase, error);
    return status;
}

tn_status tn_score_refuse(tn_status status, const tn_error *why, tn_score *score, char message[200], tn_error *error)
{
    if (status == TN_MEMORY || status == TN_INTERNAL) {
        *error = *why;
        return status;
    }
    score->state = status == TN_LIMIT ? TN_SCORE_LIMIT : TN_SCORE_FAILED;
    snprintf(message, 200, "%.199s", why->message);
    return TN_OK;
}

static void worst_score(tn_score *score, tn_score_state state)
{
    for (size_t i = 0; i < TN_SCORE_NUMBERS_MAX; i++)
        score->objectives[i] = HUGE_VAL;
    score->violation = HUGE_VAL;
    score->state = state;
}

/* Something that is not a number would compare with nothing. */
static void tidy_score(const tn_evolution *e, tn_score *score)
{
    bool bad = isnan(score->violation);
    size_t numbers = tn_evaluator_numbers(&e->evaluator);
    for (size_t i = 0; i < numbers; i++)
        bad |= isnan(score->objectives[i]);
    if (score->state == TN_SCORED && bad)
        score->state = TN_SCORE_FAILED;
    if (score->state != TN_SCORED)
        worst_score(score, score->state);
    for (size_t i = numbers; i < TN_SCORE_NUMBERS_MAX; i++)
        score->objectives[i] = 0;
}

static tn_status evaluate(tn_evolution *e, unsigned thread, tn_individual *individual, tn_error *error)
{
    individual->score = (tn_score){0};
    tn_status status = e->evaluator.evaluate(e->evaluator.context, thread, individual->sentence,
                                             individual->sentence_size, &individual->score, individual->message, error);
    tidy_score(e, &individual->score);
    return status;
}

/* Those whose sentence is not known yet are listed in e->todo, each sentence once. */
static tn_status list_unknown(tn_evolution *e, tn_individual **individuals, size_t count, size_t *todo, tn_error *error)
{
    *todo = 0;
    if (e->cache.count > TN_CACHE_MAX)
        tn_score_cache_clear(&e->cache);
    for (size_t i = 0; i < count; i++) {
        tn_individual *individual = individuals[i];
        if (individual->reason != TN_MAPPING_VALID) {
            worst_score(&individual->score, TN_SCORE_NO_SENTENCE);
            continue;
        }
        bool is_new;
        tn_status status = score_cache_enter(&e->cache, individual->hash, &is_new, error);
        if (status != TN_OK)
            return status;
        if (is_new)
            e->todo[(*todo)++] = (uint32_t)i;
    }
    return TN_OK;
}

/* Many at once, by an evaluator that can. */
static tn_status evaluate_batch(const tn_scoring *s, unsigned thread, size_t begin, size_t count, tn_error *error)
{
    const tn_evaluator *evaluator = &s->evolution->evaluator;
    tn_individual **batch = calloc(count + 1, sizeof *batch);
    if (!batch)
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++) {
        batch[i] = s->individuals[s->evolution->todo[begin + i]];
        batch[i]->score = (tn_score){0};
    }
    tn_status status = evaluator->evaluate_many(evaluator->context, thread, batch, count, error);
    for (size_t i = 0; i < count; i++)
        tidy_score(s->evolution, &batch[i]->score);
    free(batch);
    return status;
}

tn_status tn_scoring_item(void *scoring, unsigned thread, size_t item, tn_error *error)
{
    const tn_scoring *s = scoring;
    size_t begin = item * s->batch, left = s->todo - begin;
    if (!s->evolution->evaluator.evaluate_many)
        return evaluate(s->evolution, thread, s->individuals[s->evolution->todo[begin]], error);
    return evaluate_batch(s, thread, begin, left < s->batch ? left : s->batch, error);
}

static tn_status evaluate_all(tn_evolution *e, tn_status status, tn_individual **individuals, size_t todo,
                              tn_error *error)
{
    tn_scoring s = {e, individuals, todo, e->evaluator.evaluate_many ? e->evaluator.batch : 1};
    if (tn_ranks_several(e->settings.ranks))
        return tn_scoring_share(&s, status, error);
    if (status == TN_OK)
        status = tn_crew_run(e->crew, (todo + s.batch - 1) / s.batch, 1, tn_scoring_item, &s, error);
    return status;
}

/* Scores that were stored, where all of them were. */
static bool recall_all(tn_evolution *e, tn_individual **individuals, size_t todo)
{
    bool recalled = true;
    for (size_t i = 0; i < todo && recalled; i++) {
        tn_individual *individual = individuals[e->todo[i]];
        recalled = e->recall(e->recall_context, individual->id, &individual->score);
        if (recalled)
            tidy_score(e, &individual->score);
    }
    return recalled;
}

static tn_status score_new(tn_evolution *e, tn_status status, tn_individual **individuals, size_t todo, tn_error *error)
{
    if (e->recall) { /* then whether there is anything to share depends on what they have */
        status = tn_ranks_agree(e->settings.ranks, status, error);
        if (status != TN_OK)
            return status;
    }
    if (status == TN_OK)
        e->evaluations += todo;
    if (e->recall && recall_all(e, individuals, todo))
        return TN_OK;
    return evaluate_all(e, status, individuals, todo, error);
}

tn_status tn_evolution_score(tn_evolution *e, tn_status status, tn_individual **individuals, size_t count,
                             tn_error *error)
{
    size_t todo = 0;
    if (status == TN_OK)
        status = list_unknown(e, individuals, count, &todo, error);
    status = score_new(e, status, individuals, todo, error);
    if (status != TN_OK)
        return status;
    for (size_t i = 0; i < todo; i++)
        *score_of(&e->cache, individuals[e->todo[i]]->hash) = individuals[e->todo[i]]->score;
    for (size_t i = 0; i < count; i++)
        if (individuals[i]->reason == TN_MAPPING_VALID)
            individuals[i]->score = *score_of(&e->cache, individuals[i]->hash);
    return TN_OK;
}
