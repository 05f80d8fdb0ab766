#include <math.h>
#include <stdlib.h>
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "runtime/gene/evolve_state.h"

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
    e->breeders = calloc(e->threads, sizeof *e->breeders);
    e->crew = tn_crew_new(e->threads);
    if (!e->all || !e->members || !e->born || !e->pool || !e->merits || !e->scratch || !e->todo || !e->breeders ||
        !e->crew)
        return false;
    for (unsigned t = 0; t < e->threads; t++)
        if (!(e->breeders[t] = tn_breeder_new(e->grammar, &e->analysis, &e->settings.mapping)))
            return false;
    return true;
}

tn_status tn_evolution_new(const tn_grammar *grammar, const tn_evolution_settings *settings,
                           const tn_evaluator *evaluator, tn_evolution **evolution, tn_error *error)
{
    *evolution = NULL;
    if (settings->population < 2 || settings->population > TN_POPULATION_MAX)
        return tn_fail(error, TN_INVALID, 1240, "a population has 2 to %u individuals, not %u", TN_POPULATION_MAX,
                       settings->population);
    if (evaluator->objectives < 1 || evaluator->objectives > TN_OBJECTIVES_MAX)
        return tn_fail(error, TN_INVALID, 1240, "there are 1 to %u objectives, not %zu", TN_OBJECTIVES_MAX,
                       evaluator->objectives);
    tn_evolution *e = calloc(1, sizeof *e);
    if (!e)
        return tn_fail_memory(error);
    e->grammar = grammar;
    e->settings = *settings;
    e->evaluator = *evaluator;
    e->threads = settings->threads ? settings->threads : tn_crew_default();
    if (e->settings.elites > settings->population)
        e->settings.elites = settings->population;
    tn_status status = tn_analyse(grammar, &e->analysis, error);
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
    for (unsigned t = 0; e->breeders && t < e->threads; t++)
        tn_breeder_free(e->breeders[t]);
    tn_crew_free(e->crew);
    tn_analysis_clear(&e->analysis);
    tn_score_cache_clear(&e->cache);
    free(e->all);
    free(e->members);
    free(e->born);
    free(e->pool);
    free(e->merits);
    free(e->scratch);
    free(e->todo);
    free(e->breeders);
    free(e->chosen);
    free(e);
}

void tn_evolution_recall(tn_evolution *e, tn_recall *recall, void *context)
{
    e->recall = recall;
    e->recall_context = context;
}

tn_status tn_evolution_choose(tn_evolution *e, const uint32_t *places, size_t count, tn_error *error)
{
    for (size_t i = 0; i < count; i++)
        if (places[i] >= e->member_count)
            return tn_fail(error, TN_INVALID, 1241, "there is no individual %u; they are numbered from 1 to %zu",
                           places[i] + 1, e->member_count);
    uint32_t *chosen = malloc((count ? count : 1) * sizeof *chosen);
    if (!chosen)
        return tn_fail_memory(error);
    if (count)
        memcpy(chosen, places, count * sizeof *chosen);
    free(e->chosen);
    e->chosen = chosen;
    e->chosen_count = count;
    return TN_OK;
}

/* ---- mapping */

static bool keep_sentence(tn_individual *individual, const char *text, size_t size)
{
    if (size + 1 > individual->sentence_capacity) {
        size_t capacity = (size + 1) * 2;
        char *memory = realloc(individual->sentence, capacity);
        if (!memory)
            return false;
        individual->sentence = memory;
        individual->sentence_capacity = capacity;
    }
    memcpy(individual->sentence, text, size);
    individual->sentence[size] = '\0';
    individual->sentence_size = size;
    return true;
}

static tn_status map_individual(tn_evolution *e, unsigned thread, tn_individual *individual, tn_error *error)
{
    tn_mapping mapping;
    tn_status status = tn_map_genome(tn_breeder_mapper(e->breeders[thread]), individual->genome.codons,
                                     individual->genome.count, &e->settings.mapping, &mapping, error);
    if (status != TN_OK)
        return status;
    size_t size = 0;
    const char *sentence = mapping.valid ? tn_mapping_sentence(&mapping, &size) : "";
    if (!keep_sentence(individual, sentence, size))
        return tn_fail_memory(error);
    XXH128_hash_t hash = XXH3_128bits(sentence, size);
    individual->hash[0] = hash.low64;
    individual->hash[1] = hash.high64;
    individual->used = mapping.has_phenotype ? mapping.used : 0;
    individual->depth = mapping.has_phenotype ? mapping.depth : 0;
    individual->reason = mapping.reason;
    individual->message[0] = '\0';
    return TN_OK;
}

/* ---- scoring */

static void worst_score(tn_score *score, tn_score_state state)
{
    for (size_t i = 0; i < TN_OBJECTIVES_MAX; i++)
        score->objectives[i] = HUGE_VAL;
    score->state = state;
}

/* Something that is not a number would compare with nothing. */
static void tidy_score(const tn_evolution *e, tn_score *score)
{
    bool bad = false;
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
        if (individual->reason != TN_MAP_VALID) {
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
} scoring;

static tn_status score_item(void *context, unsigned thread, size_t item, tn_error *error)
{
    const scoring *s = context;
    return evaluate(s->evolution, thread, s->individuals[s->evolution->todo[item]], error);
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
    scoring s = {e, individuals};
    return recalled ? TN_OK : tn_crew_run(e->crew, todo, 1, score_item, &s, error);
}

/* Gives scores to individuals that are mapped. */
static tn_status score(tn_evolution *e, tn_individual **individuals, size_t count, tn_error *error)
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
        if (individuals[i]->reason == TN_MAP_VALID)
            tn_score_cache_get(&e->cache, individuals[i]->hash, &individuals[i]->score);
    return TN_OK;
}

/* ---- the order of merit */

static void rank(tn_evolution *e, tn_individual **individuals, size_t count)
{
    for (size_t i = 0; i < count; i++)
        e->merits[i] = (tn_merit){.objectives = individuals[i]->score.objectives, .index = (uint32_t)i};
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

/* ---- being born */

/* Takes places for the next `count` to be born. */
static void take_places(tn_evolution *e, size_t count)
{
    size_t taken = 0;
    for (size_t i = 0; i < 2 * (size_t)e->settings.population && taken < count; i++)
        if (!e->all[i].member)
            e->born[taken++] = &e->all[i];
    e->born_count = count;
    for (size_t i = 0; i < count; i++)
        e->born[i]->id = (uint64_t)e->generation * e->settings.population + i;
}

static tn_status first_genome(tn_evolution *e, size_t i, tn_individual *individual, tn_error *error)
{
    const tn_evolution_settings *s = &e->settings;
    tn_chance chance = tn_chance_for(s->seed, TN_PURPOSE_INITIALISE, 0, i);
    individual->parents[0] = individual->parents[1] = TN_NO_PARENT;
    if (i < s->seed_count) {
        individual->kind = TN_BIRTH_SEED;
        if (!tn_genome_reserve(&individual->genome, s->seeds[i].count))
            return tn_fail_memory(error);
        memcpy(individual->genome.codons, s->seeds[i].codons, s->seeds[i].count * sizeof(uint64_t));
        individual->genome.count = s->seeds[i].count;
        return TN_OK;
    }
    if (s->initialisation == TN_INITIALISE_RANDOM) {
        individual->kind = TN_BIRTH_RANDOM;
        if (!tn_genome_reserve(&individual->genome, s->codons))
            return tn_fail_memory(error);
        individual->genome.count = s->codons;
        tn_random_codons(&chance, s->vary.codon_limit, individual->genome.codons, s->codons);
        return TN_OK;
    }
    /* ramped half and half: depths from low to high in turn, each both full and grown */
    uint32_t steps = s->depth_high >= s->depth_low ? s->depth_high - s->depth_low + 1 : 1;
    bool ramped = s->initialisation == TN_INITIALISE_RAMPED;
    tn_tree_options tree = {
        .method = s->initialisation == TN_INITIALISE_PI_GROW ? TN_TREE_PI_GROW
                  : ramped && i % 2 == 0                     ? TN_TREE_FULL
                                                             : TN_TREE_GROW,
        .depth = ramped ? s->depth_low + (uint32_t)(i / 2 % steps) : s->depth_high,
        .max_depth = s->mapping.max_depth,
        .codon_limit = s->vary.codon_limit,
        .tail = s->tail,
        .max_codons = s->vary.max_codons,
    };
    individual->kind = TN_BIRTH_TREE;
    return tn_random_tree(e->grammar, &e->analysis, 0, 1, &tree, &chance, &individual->genome, error);
}

static size_t draw_parent(const tn_evolution *e, tn_chance *chance)
{
    if (e->chosen)
        return e->chosen_count ? e->chosen[tn_chance_below(chance, e->chosen_count)]
                               : (size_t)tn_chance_below(chance, e->member_count);
    return e->merits[tn_select(&e->settings.select, chance, e->merits, e->member_count)].index;
}

/* The children of one pair of parents; the last child of an odd number goes without its sibling. */
static tn_status breed_pair(tn_evolution *e, unsigned thread, size_t pair, tn_error *error)
{
    tn_chance selecting = tn_chance_for(e->settings.seed, TN_PURPOSE_SELECT, e->generation, pair);
    tn_chance breeding = tn_chance_for(e->settings.seed, TN_PURPOSE_BIRTH, e->generation, pair);
    const tn_individual *from[2];
    tn_parent parents[2];
    for (int i = 0; i < 2; i++) {
        from[i] = e->members[draw_parent(e, &selecting)];
        parents[i] = (tn_parent){&from[i]->genome, from[i]->used};
    }
    tn_genome spare = {0};
    bool alone = 2 * pair + 1 == e->born_count;
    tn_genome *children[2] = {&e->born[2 * pair]->genome, alone ? &spare : &e->born[2 * pair + 1]->genome};
    uint8_t kinds[2];
    tn_status status = tn_breed(e->breeders[thread], &e->settings.vary, &breeding, parents, children, kinds, error);
    for (int i = 0; i < (alone ? 1 : 2); i++) {
        tn_individual *child = e->born[2 * pair + (size_t)i];
        child->kind = kinds[i];
        child->parents[0] = from[i]->id;
        child->parents[1] = from[1 - i]->id;
    }
    tn_genome_clear(&spare);
    return status;
}

static tn_status make(tn_evolution *e, unsigned thread, bool first, size_t pair, tn_error *error)
{
    tn_status status = first ? TN_OK : breed_pair(e, thread, pair, error);
    for (size_t i = 2 * pair; i < 2 * pair + 2 && i < e->born_count && status == TN_OK; i++) {
        if (first)
            status = first_genome(e, i, e->born[i], error);
        if (status == TN_OK)
            status = map_individual(e, thread, e->born[i], error);
    }
    return status;
}

static tn_status first_item(void *context, unsigned thread, size_t item, tn_error *error)
{
    return make(context, thread, true, item, error);
}

static tn_status next_item(void *context, unsigned thread, size_t item, tn_error *error)
{
    return make(context, thread, false, item, error);
}

/* Makes and maps all to be born, in pairs, by all threads. */
static tn_status make_all(tn_evolution *e, bool first, tn_error *error)
{
    e->births += e->born_count;
    return tn_crew_run(e->crew, (e->born_count + 1) / 2, 8, first ? first_item : next_item, e, error);
}

/* ---- generations */

static tn_status replace_generation(tn_evolution *e, tn_error *error)
{
    size_t n = e->settings.population;
    bool survivors = e->settings.select.selection == TN_SELECT_NSGA2; /* parents compete with their children */
    size_t elites = survivors ? 0 : e->settings.elites;
    take_places(e, n - elites);
    tn_status status = make_all(e, false, error);
    if (status == TN_OK)
        status = score(e, e->born, e->born_count, error);
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
    take_places(e, n);
    for (size_t pair = 0; pair < (n + 1) / 2; pair++) {
        size_t count = 2 * pair + 1 < n ? 2 : 1;
        tn_status status = make(e, 0, false, pair, error);
        if (status == TN_OK)
            status = score(e, e->born + 2 * pair, count, error);
        if (status != TN_OK)
            return status;
        memcpy(e->pool, e->members, n * sizeof *e->pool);
        for (size_t i = 0; i < count; i++)
            e->pool[n + i] = e->born[2 * pair + i];
        keep_best(e, e->pool, n + count, n);
    }
    e->births += n;
    return TN_OK;
}

tn_status tn_evolution_step(tn_evolution *e, tn_error *error)
{
    tn_status status;
    if (e->member_count == 0) {
        take_places(e, e->settings.population);
        status = make_all(e, true, error);
        if (status == TN_OK)
            status = score(e, e->born, e->born_count, error);
        if (status == TN_OK) {
            memcpy(e->pool, e->born, e->born_count * sizeof *e->pool);
            keep_best(e, e->pool, e->born_count, e->born_count);
        }
        return status;
    }
    e->generation++;
    bool steady = e->settings.replacement == TN_REPLACE_STEADY && !e->chosen;
    status = steady ? replace_steady(e, error) : replace_generation(e, error);
    free(e->chosen);
    e->chosen = NULL;
    return status;
}

tn_status tn_evolution_rescore(tn_evolution *e, tn_error *error)
{
    tn_score_cache_clear(&e->cache);
    tn_status status = score(e, e->members, e->member_count, error);
    if (status != TN_OK)
        return status;
    memcpy(e->pool, e->members, e->member_count * sizeof *e->pool);
    keep_best(e, e->pool, e->member_count, e->member_count);
    return TN_OK;
}
