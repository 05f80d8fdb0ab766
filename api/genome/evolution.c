/* The C interface to evolution: generations bred by the caller's own fitness. */
#include "api/genome/evolution.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

enum { BATCH = 64 };

_Static_assert((int)TARTAN_SCORE_LIMITED == (int)TN_SCORE_LIMIT, "states of scores are the same numbers");
_Static_assert(sizeof((tartan_score *)0)->message == sizeof((tn_individual *)0)->message, "messages fit");
_Static_assert(TARTAN_NO_PARENT == TN_NO_PARENT, "one number for no parent");

/* ---- scoring */

static void take_score(const tartan_score *given, tn_individual *individual)
{
    tn_score *score = &individual->score;
    memcpy(score->objectives, given->objectives, sizeof score->objectives);
    score->state = given->state == TARTAN_SCORED          ? TN_SCORED
                   : given->state == TARTAN_SCORE_LIMITED ? TN_SCORE_LIMIT
                                                          : TN_SCORE_FAILED;
    memcpy(individual->message, given->message, sizeof individual->message);
    individual->message[sizeof individual->message - 1] = '\0';
}

/* What the callback says is wrong, as the engine's error. */
static tn_status callback_failed(tartan_status status, const tartan_error *said, tn_error *error)
{
    if ((unsigned)status > TARTAN_STOPPED)
        status = TARTAN_INTERNAL;
    tn_fail(error, (tn_status)status, TN_CODE_NONE, "%.479s",
            said->message[0] ? said->message : "the function that evaluates failed");
    if (said->help[0])
        tn_error_help(error, "%.319s", said->help);
    return (tn_status)status;
}

static tn_status evaluate(tartan_evolution *e, unsigned thread, tn_individual *const *individuals, size_t count,
                          tartan_sentence *sentences, tartan_score *scores, tn_error *error)
{
    tartan_error said = {0};
    for (size_t i = 0; i < count; i++)
        sentences[i] = (tartan_sentence){individuals[i]->sentence, individuals[i]->sentence_size};
    tartan_status status = e->evaluate(e->context, thread, sentences, count, scores, &said);
    if (status != TARTAN_OK)
        return callback_failed(status, &said, error);
    for (size_t i = 0; i < count; i++)
        take_score(&scores[i], individuals[i]);
    return TN_OK;
}

static tn_status evaluate_many(void *context, unsigned thread, tn_individual *const *individuals, size_t count,
                               tn_error *error)
{
    tartan_evolution *e = context;
    if (e->watch && pthread_equal(e->watch->caller, pthread_self()))
        tn_watch_tell(e->watch, (double)e->evaluated, 0);
    if (e->failed || tn_watch_check(e->watch, error) != TN_OK)
        return TN_STOPPED;
    tartan_sentence *sentences = calloc(count + 1, sizeof *sentences);
    tartan_score *scores = calloc(count + 1, sizeof *scores);
    tn_status status =
        sentences && scores ? evaluate(e, thread, individuals, count, sentences, scores, error) : tn_fail_memory(error);
    free(sentences);
    free(scores);
    e->evaluated += count;
    if (status != TN_OK && !atomic_exchange(&e->failed, true))
        e->failure = *error;
    return status;
}

static tn_status evaluate_cases(void *context, unsigned thread, const char *sentence, size_t size, double *errors,
                                tn_error *error)
{
    tartan_evolution *e = context;
    tartan_error said = {0};
    if (tn_watch_check(e->watch, error) != TN_OK)
        return TN_STOPPED;
    tartan_status status = e->evaluate_cases(e->context, thread, &(tartan_sentence){sentence, size}, errors, &said);
    for (size_t i = 0; i < e->evaluator.cases && status == TARTAN_OK; i++)
        errors[i] = isnan(errors[i]) ? HUGE_VAL : errors[i];
    return status == TARTAN_OK ? TN_OK : callback_failed(status, &said, error);
}

/* ---- making and freeing */

static tartan_status make(const tartan_module *module, const tartan_evolution_options *given,
                          tartan_evolution *evolution, tartan_error *error)
{
    tartan_evolution_options options;
    tn_error found;
    if (!module)
        return tn_api_missing(error, "module");
    tartan_status status = TN_API_TAKE(tartan_evolution_options, &options, given, error);
    if (status != TARTAN_OK)
        return status;
    if (tn_grammar_new(module->module, 0, &evolution->grammar, &found) != TN_OK)
        return tn_api_fail(&found, error);
    status = tn_api_evolution_settings(module->module, &options, evolution, error);
    evolution->evaluator = (tn_evaluator){.context = evolution,
                                          .objectives = options.objectives ? options.objectives : 1,
                                          .evaluate_many = evaluate_many,
                                          .batch = options.batch ? options.batch : BATCH,
                                          .cases = options.cases,
                                          .evaluate_cases = options.evaluate_cases ? evaluate_cases : NULL};
    return status;
}

tartan_status tn_api_evolution_make(const tartan_module *module, const tartan_evolution_options *options,
                                    tartan_evolution **evolution, tartan_error *error)
{
    tartan_evolution *made = calloc(1, sizeof *made);
    if (!made)
        return tn_api_memory(error);
    tartan_status status = make(module, options, made, error);
    if (status == TARTAN_OK)
        *evolution = made;
    else
        tartan_evolution_free(made);
    return status;
}

tartan_status tartan_evolution_new(const tartan_module *module, const tartan_evolution_options *options,
                                   tartan_evolution **evolution, tartan_error *error)
{
    tartan_evolution *made = NULL;
    tartan_status status = tn_api_evolution_make(module, options, &made, error);
    if (status != TARTAN_OK)
        return status;
    status = tn_api_evolution_replay(made, error);
    if (status == TARTAN_OK)
        *evolution = made;
    else
        tartan_evolution_free(made);
    return status;
}

void tartan_evolution_free(tartan_evolution *evolution)
{
    if (!evolution)
        return;
    tn_evolution_free(evolution->engine);
    tn_grammar_free(evolution->grammar);
    for (size_t i = 0; i < evolution->settings.seed_count; i++)
        tn_genome_clear(&evolution->seeds[i]);
    for (size_t i = 0; i < evolution->choice_count; i++)
        free(evolution->choices[i].places);
    free(evolution->seeds);
    free(evolution->choices);
    free(evolution->births);
    free(evolution);
}

/* ---- what a run is made again from */

bool tn_api_evolution_reserve(tartan_evolution *e, size_t generations)
{
    return tn_array_reserve_from(&e->births, &e->room, 8, 0, generations, e->settings.population * sizeof *e->births);
}

bool tn_api_evolution_add_choice(tartan_evolution *e, uint32_t generation, uint32_t *places, size_t count)
{
    if (!tn_array_resize(&e->choices, e->choice_count + 1, sizeof *e->choices)) {
        free(places);
        return false;
    }
    e->choices[e->choice_count++] = (tn_api_choice){generation, places, count};
    return true;
}

static void keep_births(tartan_evolution *e)
{
    size_t count;
    const tn_individual *const *born = tn_evolution_born(e->engine, &count);
    tn_api_birth *of = e->births + (size_t)e->done * e->settings.population;
    memset(of, 0, e->settings.population * sizeof *of);
    for (size_t i = 0; i < count; i++)
        of[i] = (tn_api_birth){born[i]->score, {born[i]->parents[0], born[i]->parents[1]}};
}

typedef struct recalling {
    const tartan_evolution *evolution;
    bool missing; /* the engine asked for a birth that the run has not had */
} recalling;

static bool recall(void *context, uint64_t id, tn_score *score)
{
    recalling *r = context;
    r->missing |= id >= (uint64_t)r->evolution->done * r->evolution->settings.population;
    *score = r->missing ? (tn_score){0} : r->evolution->births[id].score;
    return true;
}

static bool recall_parents(void *context, uint64_t id, uint64_t parents[2])
{
    const recalling *r = context;
    if (id >= (uint64_t)r->evolution->done * r->evolution->settings.population)
        return false;
    memcpy(parents, r->evolution->births[id].parents, sizeof r->evolution->births[id].parents);
    return true;
}

static tn_status choose(tn_evolution *engine, const uint32_t *places, size_t count, tn_error *error)
{
    tn_chosen *chosen = calloc(count + 1, sizeof *chosen);
    for (size_t i = 0; chosen && i < count; i++)
        chosen[i] = (tn_chosen){.number = places[i], .weight = 1};
    tn_status status = chosen ? tn_evolution_choose(engine, chosen, count, error) : tn_fail_memory(error);
    free(chosen);
    return status;
}

static tn_status replay(tartan_evolution *e, tn_error *error)
{
    recalling r = {.evolution = e};
    tn_status status = tn_evolution_new(e->grammar, &e->settings, &e->evaluator, &e->engine, error);
    if (status != TN_OK)
        return status;
    tn_evolution_recall(e->engine, recall, &r);
    tn_evolution_recall_parents(e->engine, recall_parents);
    for (uint32_t g = 0, at = 0; g < e->done && status == TN_OK; g++) {
        for (; at < e->choice_count && e->choices[at].generation == g && status == TN_OK; at++)
            status = choose(e->engine, e->choices[at].places, e->choices[at].count, error);
        if (status == TN_OK)
            status = tn_evolution_step(e->engine, error);
    }
    tn_evolution_recall(e->engine, NULL, NULL);
    tn_evolution_recall_parents(e->engine, NULL);
    if (status == TN_OK && r.missing)
        status = tn_fail(error, TN_INVALID, TN_CODE_NONE, "the scores are those of another run");
    if (status == TN_OK && e->chosen)
        status =
            choose(e->engine, e->choices[e->choice_count - 1].places, e->choices[e->choice_count - 1].count, error);
    return status;
}

tartan_status tn_api_evolution_replay(tartan_evolution *e, tartan_error *error)
{
    tn_error found;
    tn_evolution_free(e->engine);
    e->engine = NULL;
    if (replay(e, &found) == TN_OK)
        return TARTAN_OK;
    tn_evolution_free(e->engine);
    e->engine = NULL;
    return tn_api_fail(&found, error);
}

/* ---- going on */

static tartan_status usable(const tartan_evolution *e, tartan_error *error)
{
    if (!e)
        return tn_api_missing(error, "evolution");
    return e->engine ? TARTAN_OK
                     : tn_api_refuse(error, TARTAN_INVALID, "the evolution broke when memory ran out: restore it");
}

tartan_status tartan_evolution_step(tartan_evolution *e, const tartan_watch *given, tartan_error *error)
{
    tn_watch watch;
    tn_error found;
    tartan_status status = usable(e, error);
    if (status == TARTAN_OK)
        status = tn_api_watch(given, &watch, error);
    if (status != TARTAN_OK)
        return status;
    if (!tn_api_evolution_reserve(e, (size_t)e->done + 1))
        return tn_api_memory(error);
    e->watch = &watch;
    e->evaluated = 0;
    e->failed = false;
    tn_status stepped = tn_watch_check(&watch, &found);
    bool begun = stepped == TN_OK;
    if (begun)
        stepped = tn_evolution_step(e->engine, &found);
    e->watch = NULL;
    if (e->failed)
        found = e->failure; /* rather than that other batches were not asked any more */
    if (stepped == TN_OK) {
        keep_births(e);
        e->done++;
        e->chosen = false;
        return TARTAN_OK;
    }
    if (begun)
        tn_api_evolution_replay(e, NULL); /* where that fails, it is broken, and says so from now on */
    return tn_api_fail(&found, error);
}

uint32_t tartan_evolution_done(const tartan_evolution *evolution)
{
    return evolution->done;
}

tartan_status tartan_evolution_choose(tartan_evolution *e, const uint32_t *places, size_t count, tartan_error *error)
{
    tn_error found;
    tartan_status status = usable(e, error);
    if (status != TARTAN_OK)
        return status;
    if (count == 0 || !places || e->done == 0)
        return tn_api_refuse(error, TARTAN_INVALID, e->done ? "nobody was chosen" : "there are no members yet");
    if (choose(e->engine, places, count, &found) != TN_OK)
        return tn_api_fail(&found, error);
    if (e->chosen) /* instead of what was chosen before */
        free(e->choices[--e->choice_count].places);
    e->chosen = false;
    uint32_t *own = malloc(count * sizeof *own);
    if (own)
        memcpy(own, places, count * sizeof *own);
    if (!own || !tn_api_evolution_add_choice(e, e->done, own, count)) {
        tn_api_evolution_replay(e, NULL);
        return tn_api_memory(error);
    }
    e->chosen = true;
    return TARTAN_OK;
}

/* ---- looking at it */

size_t tartan_evolution_members(const tartan_evolution *e)
{
    size_t count = 0;
    if (e->engine)
        tn_evolution_members(e->engine, &count);
    return count;
}

size_t tartan_evolution_front(const tartan_evolution *e)
{
    return e->engine ? tn_evolution_front(e->engine) : 0;
}

tartan_status tartan_evolution_member(const tartan_evolution *e, size_t place, tartan_individual *individual,
                                      tartan_error *error)
{
    size_t count;
    tartan_status status = usable(e, error);
    if (status != TARTAN_OK)
        return status;
    const tn_individual *const *members = tn_evolution_members(e->engine, &count);
    if (place >= count)
        return tn_api_refuse(error, TARTAN_INVALID, "there is no member %zu; there are %zu", place, count);
    const tn_individual *m = members[place];
    tartan_individual own = {.id = m->id,
                             .parents = {m->parents[0], m->parents[1]},
                             .codons = m->genome.codons,
                             .codon_count = m->genome.count,
                             .sentence = m->sentence ? m->sentence : "",
                             .sentence_size = m->sentence_size,
                             .used = m->used,
                             .depth = m->depth,
                             .reason = (tartan_map_reason)m->reason,
                             .state = (tartan_score_state)m->score.state};
    memcpy(own.objectives, m->score.objectives, sizeof own.objectives);
    return TN_API_GIVE(tartan_individual, individual, &own, error);
}

tartan_generation tn_api_generation(const tn_generation_stats *s)
{
    tartan_generation own = {.size = sizeof own,
                             .number = s->generation,
                             .mean = s->mean,
                             .scored = s->scored,
                             .no_sentence = s->no_sentence,
                             .failed = s->failed,
                             .limited = s->limited,
                             .distinct = s->distinct,
                             .evaluations = s->evaluations,
                             .births = s->births,
                             .mean_codons = s->mean_codons,
                             .mean_depth = s->mean_depth};
    memcpy(own.best, s->best, sizeof own.best);
    return own;
}

tartan_status tartan_evolution_generation(const tartan_evolution *e, tartan_generation *generation, tartan_error *error)
{
    tartan_status status = usable(e, error);
    if (status != TARTAN_OK)
        return status;
    if (e->done == 0)
        return tn_api_refuse(error, TARTAN_INVALID, "no generation has been made yet");
    tn_generation_stats s = tn_evolution_stats(e->engine);
    tartan_generation own = tn_api_generation(&s);
    return TN_API_GIVE(tartan_generation, generation, &own, error);
}
