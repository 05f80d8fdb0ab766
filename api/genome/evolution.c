/* The C interface to evolution: generations bred by the caller's own fitness. */
#include "api/genome/evolution.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/genome/settings.h"

/* ---- how an evolution of the C interface breeds */

_Static_assert((int)TARTAN_INITIALISE_PI_GROW == (int)TN_INITIALISE_PI_GROW + 1 &&
                   (int)TARTAN_SELECT_NSGA2 == (int)TN_SELECT_NSGA2 + 1 &&
                   (int)TARTAN_SELECT_EPSILON_LEXICASE == (int)TN_SELECT_EPSILON_LEXICASE + 1 &&
                   (int)TARTAN_CROSS_SUBTREE == (int)TN_CROSS_SUBTREE + 1 &&
                   (int)TARTAN_MUTATE_SUBTREE == (int)TN_MUTATE_SUBTREE + 1,
               "choices are the engine's numbers, and one more for the default");
_Static_assert(TARTAN_OBJECTIVES_MAX == TN_OBJECTIVES_MAX && TARTAN_POPULATION_MAX == TN_POPULATION_MAX,
               "limits are the engine's");

/* ---- of a module */

static uint32_t whole(const tn_evolution_study *s, tn_setting setting)
{
    return (uint32_t)s->of[setting].first;
}

static void fill_selection(const tn_setting_value *selection, tartan_evolution_options *o)
{
    o->selection = (tartan_selection)(selection->choice + 1);
    if (selection->written == 2 && o->selection == TARTAN_SELECT_TRUNCATION)
        o->truncation = selection->second;
    else if (selection->written == 2)
        o->tournament = (uint32_t)selection->second;
}

/* A rate of 0 means never, which options say by a negative number; a negative one is the operator's own. */
static double rate(double said)
{
    return said == 0 ? -1 : said < 0 ? 0 : said;
}

static void fill(const tn_evolution_study *s, tartan_evolution_options *o)
{
    o->seed = tn_setting_whole64(&s->of[TN_SET_SEED]);
    o->population = whole(s, TN_SET_POPULATION);
    o->initialisation = (tartan_initialisation)(s->of[TN_SET_INITIALISE].choice + 1);
    o->codons = whole(s, TN_SET_CODONS);
    o->depth_low = whole(s, TN_SET_DEPTH);
    o->depth_high = (uint32_t)s->of[TN_SET_DEPTH].second;
    o->tail = rate(s->of[TN_SET_TAIL].first);
    fill_selection(&s->of[TN_SET_SELECTION], o);
    o->crossover = (tartan_crossover)(s->of[TN_SET_CROSSOVER].choice + 1);
    o->crossover_rate = rate(s->of[TN_SET_CROSSOVER].second);
    o->mutation = (tartan_mutation)(s->of[TN_SET_MUTATION].choice + 1);
    o->mutation_rate = rate(s->of[TN_SET_MUTATION].second);
    o->points_anywhere = s->of[TN_SET_POINTS].choice != 0;
    o->codon_limit = (uint64_t)s->of[TN_SET_CODON_LIMIT].first;
    o->max_codons = whole(s, TN_SET_MAX_CODONS);
    o->tree_depth = s->of[TN_SET_TREE_DEPTH].written ? whole(s, TN_SET_TREE_DEPTH) : 0;
    o->elites = whole(s, TN_SET_ELITES);
    o->no_elites = o->elites == 0;
    o->keep_copies = s->of[TN_SET_COPIES].choice == 1;
    o->islands = whole(s, TN_SET_ISLANDS);
    o->migrants = whole(s, TN_SET_MIGRATE);
    o->migrate_every = (uint32_t)s->of[TN_SET_MIGRATE].second;
    o->steady_state = s->of[TN_SET_REPLACEMENT].choice == TN_REPLACE_STEADY;
}

tartan_status tartan_evolution_options_of(const tartan_module *module, tartan_evolution_options *options,
                                          tartan_error *error)
{
    tartan_evolution_options own;
    tn_evolution_study study;
    if (!module || !options)
        return tn_api_missing(error, module ? "options" : "module");
    tartan_status status = TN_API_TAKE(tartan_evolution_options, &own, options, error);
    if (status != TARTAN_OK)
        return status;
    if (!tn_evolution_study_of(module->module, &study))
        return tn_api_refuse(error, TARTAN_INVALID, "the module has no evolution block");
    fill(&study, &own);
    return TN_API_GIVE(tartan_evolution_options, options, &own, error);
}

/* ---- of a caller */

static tartan_status check_cases(const tartan_evolution_options *o, tartan_error *error)
{
    bool by_cases = o->selection == TARTAN_SELECT_LEXICASE || o->selection == TARTAN_SELECT_EPSILON_LEXICASE;
    if (by_cases && !o->evaluate_cases)
        return tn_api_missing(error, "function that gives errors in single cases");
    if (by_cases && o->cases == 0)
        return tn_api_refuse(error, TARTAN_INVALID, "there is no case to select by");
    if (by_cases && o->steady_state)
        return tn_api_refuse(error, TARTAN_INVALID, "lexicase selection looks at a whole generation: no steady state");
    if (!by_cases && (o->evaluate_cases || o->cases))
        return tn_api_refuse(error, TARTAN_INVALID, "only lexicase selection looks at single cases");
    return TARTAN_OK;
}

static tartan_status check_choices(const tartan_evolution_options *o, tartan_error *error)
{
    if ((unsigned)o->initialisation > TARTAN_INITIALISE_PI_GROW ||
        (unsigned)o->selection > TARTAN_SELECT_EPSILON_LEXICASE || (unsigned)o->crossover > TARTAN_CROSS_SUBTREE ||
        (unsigned)o->mutation > TARTAN_MUTATE_SUBTREE)
        return tn_api_refuse(error, TARTAN_INVALID, "an option's choice is not a value of its enumeration");
    if (!(o->truncation >= 0 && o->truncation <= 1) || !(o->crossover_rate <= 1) || !(o->tail <= 100) ||
        !(o->mutation_rate <= 1000000))
        return tn_api_refuse(error, TARTAN_INVALID, "a share or rate of the options is out of its range");
    if (o->depth_low && o->depth_high && o->depth_low > o->depth_high)
        return tn_api_refuse(error, TARTAN_INVALID, "first trees cannot be between %u and %u deep",
                             (unsigned)o->depth_low, (unsigned)o->depth_high);
    if (o->depth_low > TN_FIRST_DEPTH_MAX || o->depth_high > TN_FIRST_DEPTH_MAX)
        return tn_api_refuse(error, TARTAN_INVALID, "first trees can be %u deep, not %u", TN_FIRST_DEPTH_MAX,
                             (unsigned)(o->depth_high ? o->depth_high : o->depth_low));
    if (o->objectives > 1 && o->selection != TARTAN_SELECT_DEFAULT && o->selection != TARTAN_SELECT_NSGA2)
        return tn_api_refuse(error, TARTAN_INVALID, "several objectives are weighed by TARTAN_SELECT_NSGA2 only");
    if (o->seed_count && !o->seeds)
        return tn_api_missing(error, "array of first genomes");
    return check_cases(o, error);
}

static void set(uint32_t given, uint32_t *setting)
{
    if (given)
        *setting = given;
}

/* Zero: the setting stays; negative: never. */
static void set_rate(double given, double *setting)
{
    if (given != 0)
        *setting = given < 0 ? 0 : given;
}

static void translate(const tartan_evolution_options *o, tn_evolution_settings *s)
{
    *s = tn_evolution_settings_default();
    s->seed = o->seed;
    set(o->population, &s->population);
    if (o->initialisation)
        s->initialisation = (tn_initialisation)(o->initialisation - 1);
    set(o->codons, &s->codons);
    set(o->depth_low, &s->depth_low);
    set(o->depth_high, &s->depth_high);
    set_rate(o->tail, &s->tail);
    if (o->selection)
        s->select.selection = (tn_selection)(o->selection - 1);
    else if (o->objectives > 1)
        s->select.selection = TN_SELECT_NSGA2;
    set(o->tournament, &s->select.tournament);
    set_rate(o->truncation, &s->select.truncation);
    if (o->crossover)
        s->vary.crossover = (tn_crossover)(o->crossover - 1);
    set_rate(o->crossover_rate, &s->vary.crossover_rate);
    if (o->mutation)
        s->vary.mutation = (tn_mutation)(o->mutation - 1);
    set_rate(o->mutation_rate, &s->vary.mutation_rate);
    s->vary.within_used = !o->points_anywhere;
    if (o->codon_limit)
        s->vary.codon_limit = o->codon_limit;
    if (o->max_codons)
        s->vary.max_codons = o->max_codons;
    s->vary.tree_depth = o->tree_depth ? o->tree_depth : s->depth_high;
    set(o->elites, &s->elites);
    if (o->no_elites)
        s->elites = 0;
    s->keeps_copies = o->keep_copies;
    s->islands = o->islands ? o->islands : 1;
    s->migrants = o->migrants ? o->migrants : 1;
    s->every = o->migrate_every ? o->migrate_every : 10;
    s->replacement = o->steady_state ? TN_REPLACE_STEADY : TN_REPLACE_GENERATION;
    s->threads = o->threads > TARTAN_THREADS_MAX ? TARTAN_THREADS_MAX : o->threads;
}

/* The caller's codons, which the engine only reads. */
static tartan_status take_seeds(const tartan_evolution_options *o, tartan_evolution *evolution, tartan_error *error)
{
    size_t count = o->seed_count < evolution->settings.population ? o->seed_count : evolution->settings.population;
    evolution->seeds = calloc(count + 1, sizeof *evolution->seeds);
    if (!evolution->seeds)
        return tn_api_memory(error);
    for (size_t i = 0; i < count; i++) {
        const tartan_genome *seed = &o->seeds[i];
        if (seed->count && !seed->codons)
            return tn_api_missing(error, "array of codons");
        if (!tn_genome_reserve(&evolution->seeds[i], seed->count + 1))
            return tn_api_memory(error);
        for (size_t c = 0; c < seed->count; c++)
            evolution->seeds[i].codons[c] = seed->codons[c];
        evolution->seeds[i].count = seed->count;
        evolution->settings.seed_count = i + 1;
    }
    evolution->settings.seeds = evolution->seeds;
    return TARTAN_OK;
}

/* What a study says of mapping is not among the options: it holds where these say nothing. */
static void follow_study(const tn_module *module, tn_mapping_options *mapping)
{
    tn_evolution_study study;
    if (!tn_evolution_study_of(module, &study))
        return;
    const tn_setting_value *of = study.of;
    if (of[TN_SET_MAX_DEPTH].written)
        mapping->max_depth = whole(&study, TN_SET_MAX_DEPTH);
    if (of[TN_SET_WRAPS].written)
        mapping->wraps = whole(&study, TN_SET_WRAPS);
    if (of[TN_SET_MAPPING].written)
        mapping->position_independent = of[TN_SET_MAPPING].choice == 1;
    mapping->max_steps = (uint64_t)of[TN_SET_MAX_STEPS].first;
}

/* The caller's options as the engine's, checked; `evolution` has its grammar. */
static tartan_status api_evolution_settings(const tn_module *module, const tartan_evolution_options *o,
                                            tartan_evolution *evolution, tartan_error *error)
{
    if (!o->evaluate)
        return tn_api_missing(error, "function that evaluates");
    if (o->objectives > TN_OBJECTIVES_MAX)
        return tn_api_refuse(error, TARTAN_INVALID, "there are 1 to %u objectives, not %u", TN_OBJECTIVES_MAX,
                             (unsigned)o->objectives);
    tartan_status status = check_choices(o, error);
    if (status != TARTAN_OK)
        return status;
    translate(o, &evolution->settings);
    evolution->evaluate = o->evaluate;
    evolution->evaluate_cases = o->evaluate_cases;
    evolution->context = o->context;
    status = tn_api_map_options(evolution->grammar, o->mapping, &evolution->settings.mapping, error);
    if (!o->mapping)
        follow_study(module, &evolution->settings.mapping);
    evolution->settings.mapping.record = false;
    return status == TARTAN_OK ? take_seeds(o, evolution, error) : status;
}

/* ---- evolution */

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
    status = api_evolution_settings(module->module, &options, evolution, error);
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
