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
    for (size_t i = 0; i < TN_OBJECTIVES_MAX; i++)
        score->objectives[i] = HUGE_VAL;
    score->violation = HUGE_VAL;
    score->state = state;
}

/* Something that is not a number would compare with nothing. */
static void tidy_score(const tn_evolution *e, tn_score *score)
{
    bool bad = isnan(score->violation);
    for (size_t i = 0; i < e->evaluator.objectives; i++)
        bad |= isnan(score->objectives[i]);
    if (score->state == TN_SCORED && bad)
        score->state = TN_SCORE_FAILED;
    if (score->state != TN_SCORED)
        worst_score(score, score->state);
    for (size_t i = e->evaluator.objectives; i < TN_OBJECTIVES_MAX; i++)
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

typedef struct scoring {
    tn_evolution *evolution;
    tn_individual **individuals;
    size_t todo;
} scoring;

static tn_status score_item(void *context, unsigned thread, size_t item, tn_error *error)
{
    const scoring *s = context;
    return evaluate(s->evolution, thread, s->individuals[s->evolution->todo[item]], error);
}

/* One of the batches that those to do are cut into. */
static tn_status score_batch(void *context, unsigned thread, size_t item, tn_error *error)
{
    const scoring *s = context;
    const tn_evaluator *evaluator = &s->evolution->evaluator;
    size_t begin = item * evaluator->batch, left = s->todo - begin;
    size_t count = left < evaluator->batch ? left : evaluator->batch;
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

static tn_status evaluate_all(tn_evolution *e, tn_individual **individuals, size_t todo, tn_error *error)
{
    scoring s = {e, individuals, todo};
    size_t batch = e->evaluator.evaluate_many ? e->evaluator.batch : 1;
    tn_crew_work *work = e->evaluator.evaluate_many ? score_batch : score_item;
    return tn_crew_run(e->crew, (todo + batch - 1) / batch, 1, work, &s, error);
}

static tn_status score_new(tn_evolution *e, tn_individual **individuals, size_t todo, tn_error *error)
{
    bool recalled = e->recall != NULL;
    for (size_t i = 0; i < todo && recalled; i++) {
        tn_individual *individual = individuals[e->todo[i]];
        recalled = e->recall(e->recall_context, individual->id, &individual->score);
        if (recalled)
            tidy_score(e, &individual->score);
    }
    e->evaluations += todo;
    return recalled ? TN_OK : evaluate_all(e, individuals, todo, error);
}

tn_status tn_evolution_score(tn_evolution *e, tn_individual **individuals, size_t count, tn_error *error)
{
    size_t todo;
    tn_status status = list_unknown(e, individuals, count, &todo, error);
    if (status == TN_OK)
        status = score_new(e, individuals, todo, error);
    if (status != TN_OK)
        return status;
    for (size_t i = 0; i < todo; i++)
        tn_score_cache_put(&e->cache, individuals[e->todo[i]]->hash, &individuals[e->todo[i]]->score);
    for (size_t i = 0; i < count; i++)
        if (individuals[i]->reason == TN_MAPPING_VALID)
            tn_score_cache_get(&e->cache, individuals[i]->hash, &individuals[i]->score);
    return TN_OK;
}
