/* Scores: each sentence is evaluated once, by all threads, or recalled. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "runtime/genome/breeding/evolve_state.h"

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
        tn_status status = tn_score_cache_enter(&e->cache, individual->hash, &is_new, error);
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
        tn_score_cache_put(&e->cache, individuals[e->todo[i]]->hash, &individuals[e->todo[i]]->score);
    for (size_t i = 0; i < count; i++)
        if (individuals[i]->reason == TN_MAPPING_VALID)
            tn_score_cache_get(&e->cache, individuals[i]->hash, &individuals[i]->score);
    return TN_OK;
}
