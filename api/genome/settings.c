/* How an evolution of the C interface breeds: the caller's options and a module's study as the engine's settings. */
#include <math.h>
#include <stdlib.h>

#include "api/genome/evolution.h"
#include "runtime/genome/settings.h"

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

tartan_status tn_api_evolution_settings(const tn_module *module, const tartan_evolution_options *o,
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
