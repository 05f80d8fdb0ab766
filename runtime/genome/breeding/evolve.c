/* Breeds a population: the first generation, each next one, and what a caller recalls or chooses. */
#include <stdlib.h>
#include <string.h>

#include "runtime/genome/breeding/evolve_state.h"

tn_evolution_settings tn_evolution_settings_default(void)
{
    return (tn_evolution_settings){
        .population = 500,
        .initialisation = TN_INITIALISE_RAMPED,
        .codons = 200,
        .depth_low = 2,
        .depth_high = 10,
        .tail = 0.5,
        .select = {.selection = TN_SELECT_TOURNAMENT, .tournament = 2, .truncation = 0.5},
        .vary = {.crossover = TN_CROSS_ONE_POINT,
                 .crossover_rate = 0.75,
                 .mutation = TN_MUTATE_CODONS,
                 .mutation_rate = -1,
                 .within_used = true,
                 .codon_limit = 100000,
                 .max_codons = 5000,
                 .tree_depth = 10},
        .elites = 1,
    };
}

/* ---- making and freeing */

static bool allocate(tn_evolution *e)
{
    size_t n = e->settings.population;
    e->all = calloc(2 * n, sizeof *e->all);
    e->members = calloc(n, sizeof *e->members);
    e->born = calloc(n, sizeof *e->born);
    e->pool = calloc(2 * n, sizeof *e->pool);
    e->merits = calloc(2 * n, sizeof *e->merits);
    e->scratch = calloc(6 * n, sizeof *e->scratch);
    e->todo = calloc(n, sizeof *e->todo);
    e->hashes = calloc(n, sizeof *e->hashes);
    e->scores = calloc(n, sizeof *e->scores);
    e->workplaces = calloc(e->threads, sizeof *e->workplaces);
    e->crew = tn_crew_new(e->threads, e->settings.watch);
    if (!e->all || !e->members || !e->born || !e->pool || !e->merits || !e->scratch || !e->todo || !e->hashes ||
        !e->scores || !e->workplaces || !e->crew)
        return false;
    for (unsigned t = 0; t < e->threads; t++)
        if (!(e->workplaces[t] = e->kind->workplace_new(e->kind->context)))
            return false;
    return true;
}

tn_status tn_evolution_new(const tn_grammar *grammar, const tn_evolution_settings *settings,
                           const tn_evaluator *evaluator, tn_evolution **evolution, tn_error *error)
{
    *evolution = NULL;
    if (settings->population < 2 || settings->population > TN_POPULATION_MAX)
        return tn_fail(error, TN_INVALID, E_POPULATION, "a population has 2 to %u individuals, not %u",
                       TN_POPULATION_MAX, settings->population);
    if (evaluator->objectives < 1 || evaluator->objectives > TN_OBJECTIVES_MAX)
        return tn_fail(error, TN_INVALID, E_POPULATION, "there are 1 to %u objectives, not %zu", TN_OBJECTIVES_MAX,
                       evaluator->objectives);
    bool by_cases =
        settings->select.selection == TN_SELECT_LEXICASE || settings->select.selection == TN_SELECT_EPSILON_LEXICASE;
    if (by_cases && (!evaluator->evaluate_cases || settings->replacement == TN_REPLACE_STEADY))
        return tn_fail(error, TN_INVALID, E_POPULATION,
                       evaluator->evaluate_cases
                           ? "lexicase selection looks at a whole generation, and this run has none"
                           : "lexicase selection needs errors in single cases, which are not given");
    tn_evolution *e = calloc(1, sizeof *e);
    if (!e)
        return tn_fail_memory(error);
    e->settings = *settings;
    e->evaluator = *evaluator;
    e->threads = settings->threads ? settings->threads : tn_crew_default();
    if (e->settings.elites > settings->population)
        e->settings.elites = settings->population;
    e->kind = settings->kind ? settings->kind : &e->own;
    tn_status status = settings->kind ? TN_OK : tn_codon_kind_new(grammar, settings, &e->own, error);
    if (status == TN_OK && !allocate(e))
        status = tn_fail_memory(error);
    if (status != TN_OK) {
        tn_evolution_free(e);
        return status;
    }
    *evolution = e;
    return TN_OK;
}

void tn_evolution_free(tn_evolution *e)
{
    if (!e)
        return;
    for (size_t i = 0; e->all && i < 2 * (size_t)e->settings.population; i++) {
        tn_genome_clear(&e->all[i].genome);
        free(e->all[i].sentence);
    }
    for (unsigned t = 0; e->workplaces && t < e->threads; t++)
        e->kind->workplace_free(e->workplaces[t]);
    for (size_t i = 0; i < e->album_count; i++)
        tn_genome_clear(&e->album[i]);
    tn_crew_free(e->crew);
    tn_codon_kind_free(&e->own);
    tn_score_cache_clear(&e->cache);
    tn_lexicase_clear(&e->lexicase);
    free(e->all);
    free(e->members);
    free(e->born);
    free(e->pool);
    free(e->merits);
    free(e->scratch);
    free(e->todo);
    free(e->hashes);
    free(e->scores);
    free(e->workplaces);
    free(e->chosen);
    free(e->album);
    free(e);
}

void tn_evolution_recall(tn_evolution *e, tn_recall *recall, void *context)
{
    e->recall = recall;
    e->recall_context = context;
}

void tn_evolution_recall_parents(tn_evolution *e, tn_recall_parents *recall)
{
    e->recall_parents = recall;
}

/* ---- the order of merit */

static void rank(tn_evolution *e, tn_individual **individuals, size_t count)
{
    for (size_t i = 0; i < count; i++)
        e->merits[i] = (tn_merit){.objectives = individuals[i]->score.objectives,
                                  .violation = individuals[i]->score.violation,
                                  .index = (uint32_t)i};
    if (e->evaluator.objectives > 1)
        tn_nsga2(e->merits, count, e->evaluator.objectives, e->scratch);
    tn_merit_sort(e->merits, count);
}

/* The best `keep` of `count` individuals become the members, the best first. `from` is not the members' own array. */
static void keep_best(tn_evolution *e, tn_individual **from, size_t count, size_t keep)
{
    rank(e, from, count);
    for (size_t i = 0; i < count; i++)
        from[i]->member = false;
    for (size_t i = 0; i < keep; i++) {
        e->members[i] = from[e->merits[i].index];
        e->members[i]->member = true;
        e->merits[i].index = (uint32_t)i;
    }
    e->member_count = keep;
    if (e->evaluator.objectives == 1)
        return; /* the order holds without the others, and e->merits starts with it */
    rank(e, e->members, keep);
    memcpy(e->pool, e->members, keep * sizeof *e->pool);
    for (size_t i = 0; i < keep; i++) {
        e->members[i] = e->pool[e->merits[i].index];
        e->merits[i].index = (uint32_t)i;
    }
}

/* ---- generations */

/* The chosen parents stay, and their children take all other places. */
static tn_status replace_chosen(tn_evolution *e, tn_error *error)
{
    size_t stay;
    tn_status status = tn_evolution_bring_back(e, &stay, error);
    status = tn_ranks_agree(e->settings.ranks, status, error);
    if (status == TN_OK)
        status = tn_evolution_score(e, e->pool, stay, error);
    if (status != TN_OK)
        return status;
    tn_evolution_take_places(e, e->settings.population - stay);
    status = tn_evolution_make(e, false, error);
    if (status == TN_OK)
        status = tn_evolution_score(e, e->born, e->born_count, error);
    if (status != TN_OK)
        return status;
    for (size_t i = 0; i < e->member_count; i++)
        e->members[i]->member = false;
    memcpy(e->pool + stay, e->born, e->born_count * sizeof *e->pool);
    keep_best(e, e->pool, stay + e->born_count, stay + e->born_count);
    return TN_OK;
}

static tn_status replace_generation(tn_evolution *e, tn_error *error)
{
    size_t n = e->settings.population;
    bool survivors = e->settings.select.selection == TN_SELECT_NSGA2; /* parents compete with their children */
    size_t elites = survivors ? 0 : e->settings.elites;
    tn_evolution_take_places(e, n - elites);
    tn_status status = tn_evolution_find_cases(e, error);
    if (status == TN_OK)
        status = tn_evolution_make(e, false, error);
    if (status == TN_OK)
        status = tn_evolution_score(e, e->born, e->born_count, error);
    if (status != TN_OK)
        return status;
    size_t count = 0;
    for (size_t i = 0; i < e->member_count; i++) {
        if (survivors || i < elites)
            e->pool[count++] = e->members[e->merits[i].index];
        else
            e->members[e->merits[i].index]->member = false;
    }
    for (size_t i = 0; i < e->born_count; i++)
        e->pool[count++] = e->born[i];
    keep_best(e, e->pool, count, n);
    return TN_OK;
}

/* Each child takes the place of the worst member, if it is better. */
static tn_status replace_steady(tn_evolution *e, tn_error *error)
{
    size_t n = e->settings.population;
    tn_evolution_take_places(e, n);
    for (size_t pair = 0; pair < (n + 1) / 2; pair++) {
        size_t count = 2 * pair + 1 < n ? 2 : 1;
        tn_status status = tn_evolution_make_pair(e, pair, error);
        if (status == TN_OK)
            status = tn_evolution_score(e, e->born + 2 * pair, count, error);
        if (status != TN_OK)
            return status;
        memcpy(e->pool, e->members, n * sizeof *e->pool);
        for (size_t i = 0; i < count; i++)
            e->pool[n + i] = e->born[2 * pair + i];
        keep_best(e, e->pool, n + count, n);
    }
    e->births += n;
    return tn_evolution_keep_born(e, error);
}

tn_status tn_evolution_step(tn_evolution *e, tn_error *error)
{
    tn_status status;
    if (e->member_count == 0) {
        tn_evolution_take_places(e, e->settings.population);
        status = tn_evolution_make(e, true, error);
        if (status == TN_OK)
            status = tn_evolution_score(e, e->born, e->born_count, error);
        if (status == TN_OK) {
            memcpy(e->pool, e->born, e->born_count * sizeof *e->pool);
            keep_best(e, e->pool, e->born_count, e->born_count);
        }
        return status;
    }
    e->generation++;
    bool steady = e->settings.replacement == TN_REPLACE_STEADY && !e->chosen, stay = e->chosen && e->kind->parents_stay;
    status = stay ? replace_chosen(e, error) : steady ? replace_steady(e, error) : replace_generation(e, error);
    free(e->chosen);
    e->chosen = NULL;
    return status;
}

const tn_vary_options *tn_evolution_varies(const tn_evolution *e)
{
    return e->kind == &e->own ? &e->settings.vary : NULL;
}

void tn_evolution_vary(tn_evolution *e, const tn_vary_options *vary)
{
    if (e->kind != &e->own)
        return;
    e->settings.vary = *vary;
    tn_codon_kind_vary(&e->own, vary);
}

tn_status tn_evolution_rescore(tn_evolution *e, tn_error *error)
{
    tn_score_cache_clear(&e->cache);
    tn_status status = tn_evolution_score(e, e->members, e->member_count, error);
    if (status != TN_OK)
        return status;
    memcpy(e->pool, e->members, e->member_count * sizeof *e->pool);
    keep_best(e, e->pool, e->member_count, e->member_count);
    return TN_OK;
}
