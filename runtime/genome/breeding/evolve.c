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

bool tn_evolution_allocate(tn_evolution *e)
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
    return e->all && e->members && e->born && e->pool && e->merits && e->scratch && e->todo && e->hashes && e->scores &&
           tn_islands_make(e);
}

void tn_evolution_free_arrays(tn_evolution *e)
{
    for (size_t i = 0; e->all && i < 2 * (size_t)e->settings.population; i++) {
        tn_genome_clear(&e->all[i].genome);
        free(e->all[i].sentence);
    }
    tn_islands_free(e);
    free(e->all);
    free(e->members);
    free(e->born);
    free(e->pool);
    free(e->merits);
    free(e->scratch);
    free(e->todo);
    free(e->hashes);
    free(e->scores);
}

static bool allocate(tn_evolution *e)
{
    e->workplaces = calloc(e->threads, sizeof *e->workplaces);
    e->crew = tn_crew_new(e->threads, e->settings.watch);
    if (!e->workplaces || !e->crew || !tn_evolution_allocate(e))
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
    uint32_t islands = settings->islands ? settings->islands : 1;
    if (settings->population % islands != 0 || settings->population / islands < 2 ||
        (settings->every && settings->migrants >= settings->population / islands))
        return tn_fail(
            error, TN_INVALID, E_POPULATION,
            "a population of %u individuals does not make %u equal islands of at least two, of which %u move",
            settings->population, islands, settings->migrants);
    if (evaluator->objectives < 1 || evaluator->objectives > TN_OBJECTIVES_MAX)
        return tn_fail(error, TN_INVALID, E_POPULATION, "there are 1 to %u objectives, not %zu", TN_OBJECTIVES_MAX,
                       evaluator->objectives);
    bool by_cases =
        settings->select.selection == TN_SELECT_LEXICASE || settings->select.selection == TN_SELECT_EPSILON_LEXICASE;
    if (tn_evaluator_numbers(evaluator) > TN_SCORE_NUMBERS_MAX)
        return tn_fail(error, TN_INVALID, E_POPULATION, "a score holds at most %u numbers, not %zu",
                       TN_SCORE_NUMBERS_MAX, tn_evaluator_numbers(evaluator));
    if (by_cases && (!evaluator->cases || settings->replacement == TN_REPLACE_STEADY))
        return tn_fail(error, TN_INVALID, E_POPULATION,
                       evaluator->cases ? "lexicase selection looks at a whole generation, and this run has none"
                                        : "lexicase selection needs errors in single cases, which are not given");
    if (by_cases && islands > 1)
        return tn_fail(error, TN_INVALID, E_POPULATION,
                       "lexicase selection chooses among the whole population, and this run has islands");
    tn_evolution *e = calloc(1, sizeof *e);
    if (!e)
        return tn_fail_memory(error);
    e->settings = *settings;
    e->evaluator = *evaluator;
    e->threads = settings->threads ? settings->threads : tn_crew_default();
    if (e->settings.elites > settings->population / islands)
        e->settings.elites = settings->population / islands;
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
    tn_evolution_free_arrays(e);
    for (size_t i = 0; i < e->guest_count; i++) {
        tn_genome_clear(&e->guests[i]->genome);
        free(e->guests[i]->sentence);
        free(e->guests[i]);
    }
    for (unsigned t = 0; e->workplaces && t < e->threads; t++)
        e->kind->workplace_free(e->workplaces[t]);
    for (size_t i = 0; i < e->album_count; i++)
        tn_genome_clear(&e->album[i]);
    tn_crew_free(e->crew);
    tn_codon_kind_free(&e->own);
    tn_score_cache_clear(&e->cache);
    tn_lexicase_clear(&e->lexicase);
    free(e->guests);
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

/* ---- generations */

/* The chosen parents stay, and their children take all other places. */
static tn_status replace_chosen(tn_evolution *e, tn_status status, tn_error *error)
{
    size_t stay = 0;
    if (status == TN_OK)
        status = tn_evolution_bring_back(e, &stay, error);
    status = tn_evolution_score(e, status, e->pool, stay, error);
    if (status != TN_OK)
        return status;
    tn_evolution_take_places(e, e->settings.population - stay);
    status = tn_evolution_make(e, false, stay, error);
    status = tn_evolution_score(e, status, e->born, e->born_count, error);
    if (status != TN_OK)
        return status;
    for (size_t i = 0; i < e->member_count; i++)
        e->members[i]->member = false;
    memcpy(e->pool + stay, e->born, e->born_count * sizeof *e->pool);
    tn_island_keep_best(e, e->islands, e->pool, stay + e->born_count, stay + e->born_count);
    return TN_OK;
}

/* Those born on an island, and of its members the elites or all, compete for its places. */
static void replace_on_island(tn_evolution *e, size_t number, bool survivors)
{
    tn_island *island = &e->islands[number];
    size_t count = 0, size = tn_island_size(e);
    for (size_t i = 0; i < island->count; i++) {
        tn_individual *member = island->members[island->merits[i].index];
        if (survivors || i < e->settings.elites)
            e->pool[count++] = member;
        else
            member->member = false;
    }
    for (size_t i = 0; i < e->births_each; i++)
        e->pool[count++] = e->born[number * e->births_each + i];
    tn_island_keep_best(e, island, e->pool, count, size < count ? size : count);
}

/* Puts those into the pool that stay, whatever is born: the elites of each island, or where parents compete with their
 * children, all. */
static size_t pool_staying(tn_evolution *e, bool survivors)
{
    size_t count = 0;
    for (size_t number = 0; number < e->island_count; number++) {
        const tn_island *island = &e->islands[number];
        for (size_t i = 0; i < island->count && (survivors || i < e->settings.elites); i++)
            e->pool[count++] = island->members[island->merits[i].index];
    }
    return count;
}

static tn_status replace_generation(tn_evolution *e, tn_status status, tn_error *error)
{
    size_t n = e->settings.population;
    bool survivors = e->settings.select.selection == TN_SELECT_NSGA2; /* parents compete with their children */
    size_t elites = survivors ? 0 : e->settings.elites;
    tn_evolution_take_places(e, n - elites * e->island_count);
    status = tn_evolution_find_cases(e, status, error);
    if (status == TN_OK)
        status = tn_evolution_make(e, false, pool_staying(e, survivors), error);
    status = tn_evolution_score(e, status, e->born, e->born_count, error);
    for (size_t i = 0; status == TN_OK && i < e->island_count; i++)
        replace_on_island(e, i, survivors);
    return status;
}

/* Each child takes the place of the worst member, if it is better. */
static tn_status replace_steady(tn_evolution *e, tn_status status, tn_error *error)
{
    tn_evolution_take_places(e, e->settings.population);
    for (size_t number = 0; number < tn_evolution_pairs(e); number++) {
        const tn_brood pair = tn_evolution_pair(e, number);
        tn_island *island = &e->islands[pair.island];
        memcpy(e->pool, island->members, island->count * sizeof *e->pool);
        if (status == TN_OK)
            status = tn_evolution_make_pair(e, number, island->count, error);
        status = tn_evolution_score(e, status, e->born + pair.first, pair.count, error);
        if (status != TN_OK)
            return status;
        memcpy(e->pool + island->count, e->born + pair.first, pair.count * sizeof *e->pool);
        size_t count = island->count + pair.count, size = tn_island_size(e);
        tn_island_keep_best(e, island, e->pool, count, size < count ? size : count);
    }
    e->births += e->settings.population;
    return tn_ranks_agree(e->settings.ranks, tn_evolution_keep_born(e, error), error);
}

static tn_status first_generation(tn_evolution *e, tn_status status, tn_error *error)
{
    tn_evolution_take_places(e, e->settings.population);
    if (status == TN_OK)
        status = tn_evolution_make(e, true, 0, error);
    status = tn_evolution_score(e, status, e->born, e->born_count, error);
    for (size_t i = 0; status == TN_OK && i < e->island_count; i++) {
        memcpy(e->pool, e->born + i * e->births_each, e->births_each * sizeof *e->pool);
        tn_island_keep_best(e, &e->islands[i], e->pool, e->births_each, e->births_each);
    }
    if (status == TN_OK)
        tn_islands_order(e);
    return status;
}

tn_status tn_evolution_step(tn_evolution *e, tn_error *error)
{
    return tn_evolution_step_after(e, TN_OK, error);
}

tn_status tn_evolution_step_after(tn_evolution *e, tn_status status, tn_error *error)
{
    if (e->member_count == 0)
        return first_generation(e, status, error);
    tn_evolution_part_from_guests(e);
    e->generation++;
    bool steady = e->settings.replacement == TN_REPLACE_STEADY && !e->chosen, stay = e->chosen && e->kind->parents_stay;
    status = stay     ? replace_chosen(e, status, error)
             : steady ? replace_steady(e, status, error)
                      : replace_generation(e, status, error);
    free(e->chosen);
    e->chosen = NULL;
    if (status != TN_OK)
        return status;
    if (e->island_count > 1 && e->settings.every && e->generation % e->settings.every == 0)
        tn_islands_migrate(e);
    tn_islands_order(e);
    return TN_OK;
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
    tn_status status = tn_evolution_score(e, TN_OK, e->members, e->member_count, error);
    if (status != TN_OK)
        return status;
    for (size_t i = 0; i < e->island_count; i++) {
        tn_island *island = &e->islands[i];
        memcpy(e->pool, island->members, island->count * sizeof *e->pool);
        tn_island_keep_best(e, island, e->pool, island->count, island->count);
    }
    tn_islands_order(e);
    return TN_OK;
}
