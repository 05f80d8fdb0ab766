/* Breeds a population: the first generation, each next one, and what a caller recalls or chooses. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/genome/breeding/evolve_state.h"

/* ==== the members of a generation, its first front, and its statistics */

const tn_individual *const *tn_evolution_members(const tn_evolution *e, size_t *count)
{
    *count = e->member_count;
    return (const tn_individual *const *)e->members;
}

const tn_individual *const *tn_evolution_born(const tn_evolution *e, size_t *count)
{
    *count = e->born_count;
    return (const tn_individual *const *)e->born;
}

size_t tn_evolution_known(const tn_evolution *e)
{
    return e->cache.count;
}

uint32_t tn_evolution_generation(const tn_evolution *e)
{
    return e->generation;
}

size_t tn_evolution_front(const tn_evolution *e)
{
    size_t count = 0;
    while (count < e->member_count && e->merits[count].front == 0 && e->evaluator.objectives > 1)
        count++;
    return e->evaluator.objectives > 1 ? count : e->member_count > 0;
}

static int compare_hashes(const void *left, const void *right)
{
    const uint64_t *a = left, *b = right;
    return *a < *b ? -1 : *a > *b;
}

static uint32_t count_distinct(const tn_evolution *e)
{
    uint64_t *hashes = e->hashes;
    size_t count = 0;
    uint32_t distinct = 0;
    for (size_t i = 0; i < e->member_count; i++)
        if (e->members[i]->reason == TN_MAPPING_VALID)
            hashes[count++] = e->members[i]->hash[0];
    qsort(hashes, count, sizeof *hashes, compare_hashes);
    for (size_t i = 0; i < count; i++)
        distinct += i == 0 || hashes[i] != hashes[i - 1];
    return distinct;
}

static int compare_scores(const void *left, const void *right)
{
    const double *a = left, *b = right;
    return *a < *b ? -1 : *a > *b;
}

/* Each is the score at its share of the order, between two neighbours where it falls between them. */
static void find_quartiles(const tn_evolution *e, tn_generation_stats *s)
{
    double *scores = e->scores;
    size_t count = 0;
    for (size_t i = 0; i < e->member_count; i++)
        if (e->members[i]->score.state == TN_SCORED)
            scores[count++] = e->members[i]->score.objectives[0];
    qsort(scores, count, sizeof *scores, compare_scores);
    for (size_t q = 0; q < 3 && count; q++) {
        double place = (double)(count - 1) * (double)(q + 1) / 4, low = floor(place);
        double below = scores[(size_t)low], share = place - low;
        s->quartiles[q] = share > 0 ? below + share * (scores[(size_t)low + 1] - below) : below;
        if (s->quartiles[q] != s->quartiles[q])
            s->quartiles[q] = below; /* between infinite ones */
    }
}

tn_generation_stats tn_evolution_stats(const tn_evolution *e)
{
    tn_generation_stats s = {.generation = e->generation, .evaluations = e->evaluations, .births = e->births};
    for (size_t o = 0; o < TN_OBJECTIVES_MAX; o++)
        s.best[o] = o < e->evaluator.objectives ? HUGE_VAL : 0;
    double sum = 0, codons = 0, depths = 0;
    for (size_t i = 0; i < e->member_count; i++) {
        const tn_individual *m = e->members[i];
        s.no_sentence += m->score.state == TN_SCORE_NO_SENTENCE;
        s.failed += m->score.state == TN_SCORE_FAILED;
        s.limited += m->score.state == TN_SCORE_LIMIT;
        if (m->reason == TN_MAPPING_VALID) {
            codons += (double)m->used;
            depths += m->depth;
        }
        if (m->score.state != TN_SCORED)
            continue;
        s.scored++;
        sum += m->score.objectives[0];
        for (size_t o = 0; o < e->evaluator.objectives; o++)
            if (m->score.objectives[o] < s.best[o])
                s.best[o] = m->score.objectives[o];
    }
    find_quartiles(e, &s);
    uint32_t sentences = (uint32_t)e->member_count - s.no_sentence;
    s.mean = s.scored ? sum / s.scored : 0;
    s.mean_codons = sentences ? codons / sentences : 0;
    s.mean_depth = sentences ? depths / sentences : 0;
    s.distinct = count_distinct(e);
    return s;
}

/* ==== work that several processes do together: each takes items from a counter that all share, and tells the others
 * what it found. All have the same items, in the same order. Scores of sentences are found so. Ranks meet here alone
 * while they breed: one begins as soon as it can, and hears at the end of the work that another failed before it. Where
 * a rank has something else to do, as the one that stores the run, the others work meanwhile */

/* A thread takes a part of what is left: this many times as many takes as there are threads, were they all equal. So
 * few takes do for many items, and the last ones are single items, which nobody waits for long. What is left is
 * guessed: since a thread's last take, the others have each taken as much. */
#define SPREAD 4

typedef struct sharing {
    tn_evolution *evolution;
    const tn_shared_work *work;
    const tn_ranks *ranks;
    size_t workers; /* threads of all ranks */
    bool *mine;     /* [items]: done here */
} sharing;

/* Nobody begins any more: one that failed makes the others wait for nothing. It may not know how many items they have.
 */
static void take_the_rest(const sharing *s)
{
    s->ranks->take(s->ranks->context, TN_POPULATION_MAX);
}

static tn_status do_items(sharing *s, unsigned thread, uint64_t from, uint64_t to, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint64_t item = from; status == TN_OK && item < to; item++) {
        status = tn_watch_check(s->evolution->settings.watch, error);
        if (status == TN_OK)
            status = s->work->work(s->work->context, thread, (size_t)item, error);
        s->mine[item] = status == TN_OK;
    }
    return status;
}

/* One thread's part. */
static tn_status take_part(void *context, unsigned thread, size_t place, tn_error *error)
{
    (void)place;
    sharing *s = context;
    uint64_t items = s->work->items, next = 0; /* those before have been taken, as far as is known */
    tn_status status = TN_OK;
    while (status == TN_OK && !s->ranks->spare) {
        uint64_t left = next < items ? items - next : 0, amount = left / (s->workers * SPREAD) + 1;
        uint64_t from = s->ranks->take(s->ranks->context, amount);
        if (from >= items)
            return TN_OK;
        next = from + amount * s->workers;
        status = do_items(s, thread, from, from + amount < items ? from + amount : items, error);
    }
    if (status != TN_OK)
        take_the_rest(s);
    return status;
}

/* ---- what ranks tell each other */

/* The first byte of what a rank tells. */
enum { FOUND, FAILED };

/* What was found here. NULL: out of memory. */
static uint8_t *write_mine(const sharing *s, size_t *size)
{
    const tn_shared_work *work = s->work;
    size_t room = 1;
    for (size_t item = 0; item < work->items; item++)
        room += s->mine[item] ? work->size(work->context, item) : 0;
    uint8_t *bytes = malloc(room), *end = bytes;
    if (bytes)
        *end++ = FOUND;
    for (size_t item = 0; bytes && item < work->items; item++)
        if (s->mine[item])
            end = work->write(work->context, item, end);
    *size = bytes ? (size_t)(end - bytes) : 0;
    return bytes;
}

typedef struct failure {
    uint8_t kind; /* FAILED */
    tn_error error;
} failure;

/* Together: everybody's findings or failures. */
static void tell(const sharing *s, tn_status status, const tn_error *error, tn_gathered *all)
{
    const tn_ranks *ranks = s->ranks;
    size_t size = 0;
    uint8_t *bytes = status == TN_OK ? write_mine(s, &size) : NULL;
    if (bytes) {
        ranks->gather(ranks->context, bytes, size, all);
        free(bytes);
        return;
    }
    failure f;
    memset(&f, 0, sizeof f);
    f.kind = FAILED;
    if (status == TN_OK)
        status = tn_fail_memory(&f.error);
    else
        f.error = *error;
    f.error.status = status;
    ranks->gather(ranks->context, &f, sizeof f, all);
}

/* The failure of the first rank that has one. */
static tn_status hear_failure(const sharing *s, const tn_gathered *all, tn_error *error)
{
    failure f;
    for (unsigned r = 0; r < s->ranks->count; r++) {
        const uint8_t *told = all->bytes + all->begins[r];
        if (*told != FAILED)
            continue;
        memcpy(&f, told, sizeof f);
        *error = f.error;
        return f.error.status;
    }
    return TN_OK;
}

static tn_status exchange(const sharing *s, tn_status status, tn_error *error)
{
    tn_gathered all;
    tell(s, status, error, &all);
    status = hear_failure(s, &all, error);
    for (unsigned r = 0; status == TN_OK && r < s->ranks->count; r++) {
        const uint8_t *bytes = all.bytes + all.begins[r] + 1, *end = all.bytes + all.begins[r + 1];
        while (r != s->ranks->rank && bytes < end)
            bytes = s->work->read(s->work->context, bytes);
    }
    tn_gathered_clear(&all);
    return status;
}

tn_status tn_evolution_share(tn_evolution *e, tn_status status, const tn_shared_work *work, tn_error *error)
{
    const tn_ranks *ranks = e->settings.ranks;
    sharing s = {.evolution = e,
                 .work = work,
                 .ranks = ranks,
                 .workers = (size_t)ranks->count * e->threads,
                 .mine = status == TN_OK ? calloc(work->items + 1, sizeof *s.mine) : NULL};
    ranks->restart(ranks->context);
    if (status == TN_OK && !s.mine)
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_crew_run(e->crew, e->threads, 1, take_part, &s, error);
    if (status != TN_OK)
        take_the_rest(&s);
    status = exchange(&s, status, error);
    free(s.mine);
    return status;
}

/* ---- scores: of each individual its place, score and message */

typedef struct entry {
    uint32_t place; /* among those to do */
    uint32_t message_size;
    tn_score score;
} entry;

static tn_individual *individual_at(const tn_scoring *scoring, size_t place)
{
    return scoring->individuals[scoring->evolution->todo[place]];
}

static size_t batch_of(const tn_scoring *scoring, size_t item)
{
    size_t left = scoring->todo - item * scoring->batch;
    return left < scoring->batch ? left : scoring->batch;
}

static size_t scores_size(const void *context, size_t item)
{
    const tn_scoring *scoring = context;
    return batch_of(scoring, item) * (sizeof(entry) + sizeof individual_at(scoring, 0)->message);
}

static uint8_t *write_scores(const void *context, size_t item, uint8_t *end)
{
    const tn_scoring *scoring = context;
    for (size_t i = 0; i < batch_of(scoring, item); i++) {
        size_t place = item * scoring->batch + i;
        const tn_individual *individual = individual_at(scoring, place);
        entry e;
        memset(&e, 0, sizeof e);
        e.place = (uint32_t)place;
        e.message_size = (uint32_t)strlen(individual->message);
        e.score = individual->score;
        memcpy(end, &e, sizeof e);
        memcpy(end + sizeof e, individual->message, e.message_size);
        end += sizeof e + e.message_size;
    }
    return end;
}

static const uint8_t *read_score(void *context, const uint8_t *bytes)
{
    const tn_scoring *scoring = context;
    entry e;
    memcpy(&e, bytes, sizeof e);
    tn_individual *individual = individual_at(scoring, e.place);
    individual->score = e.score;
    memcpy(individual->message, bytes + sizeof e, e.message_size);
    individual->message[e.message_size] = '\0';
    return bytes + sizeof e + e.message_size;
}

tn_status tn_scoring_share(tn_scoring *scoring, tn_status status, tn_error *error)
{
    const tn_shared_work work = {.context = scoring,
                                 .items = (scoring->todo + scoring->batch - 1) / scoring->batch,
                                 .work = tn_scoring_item,
                                 .size = scores_size,
                                 .write = write_scores,
                                 .read = read_score};
    return tn_evolution_share(scoring->evolution, status, &work, error);
}

/* ==== Islands: parts of a population within which parents are chosen and members replaced; and the order of merit */

size_t tn_island_size(const tn_evolution *e)
{
    return e->settings.population / e->island_count;
}

/* NULL: out of memory. Frees with islands_free. */
static bool islands_make(tn_evolution *e)
{
    size_t n = e->settings.population;
    e->island_count = e->settings.islands ? e->settings.islands : 1;
    e->islands = calloc(e->island_count, sizeof *e->islands);
    bool several = e->island_count > 1;
    e->residents = several ? calloc(n, sizeof *e->residents) : e->members;
    e->resident_merits = several ? calloc(n, sizeof *e->resident_merits) : e->merits;
    if (!e->islands || !e->residents || !e->resident_merits)
        return false;
    for (size_t i = 0; i < e->island_count; i++)
        e->islands[i] = (tn_island){.members = e->residents + i * tn_island_size(e),
                                    .merits = e->resident_merits + i * tn_island_size(e)};
    return true;
}

static void islands_free(tn_evolution *e)
{
    if (e->island_count > 1) {
        free(e->residents);
        free(e->resident_merits);
    }
    free(e->islands);
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

/* Puts individuals into the order of their merits, which begin with them. */
static void put_in_order(tn_evolution *e, tn_individual **individuals, size_t count, tn_merit *merits)
{
    rank(e, individuals, count);
    memcpy(e->pool, individuals, count * sizeof *e->pool);
    for (size_t i = 0; i < count; i++) {
        individuals[i] = e->pool[e->merits[i].index];
        merits[i] = e->merits[i];
        merits[i].index = (uint32_t)i;
    }
}

void tn_island_keep_best(tn_evolution *e, tn_island *island, tn_individual **from, size_t count, size_t keep)
{
    rank(e, from, count);
    for (size_t i = 0; i < count; i++)
        from[i]->member = false;
    for (size_t i = 0; i < keep; i++) {
        island->members[i] = from[e->merits[i].index];
        island->members[i]->member = true;
        island->merits[i] = e->merits[i];
        island->merits[i].index = (uint32_t)i;
    }
    island->count = keep;
    if (e->evaluator.objectives > 1) /* with one, the order holds without the others */
        put_in_order(e, island->members, keep, island->merits);
}

void tn_islands_order(tn_evolution *e)
{
    e->member_count = 0;
    for (size_t i = 0; i < e->island_count; i++)
        e->member_count += e->islands[i].count;
    if (e->island_count == 1)
        return; /* the island's order is that of all */
    memcpy(e->members, e->residents, e->member_count * sizeof *e->members);
    put_in_order(e, e->members, e->member_count, e->merits);
}

/* ---- migrating */

/* The best of each island move to the next one, and those of the last to the first. */
static void islands_migrate(tn_evolution *e)
{
    size_t size = tn_island_size(e), moving = e->settings.migrants;
    for (size_t i = 0; i < e->island_count; i++) {
        const tn_island *before = &e->islands[(i + e->island_count - 1) % e->island_count];
        memcpy(e->pool + i * size, before->members, moving * sizeof *e->pool);
        memcpy(e->pool + i * size + moving, e->islands[i].members + moving, (size - moving) * sizeof *e->pool);
    }
    tn_individual **all = e->pool + e->settings.population; /* the pool's first half is needed for the order */
    memcpy(all, e->pool, e->settings.population * sizeof *all);
    for (size_t i = 0; i < e->island_count; i++)
        tn_island_keep_best(e, &e->islands[i], all + i * size, size, size);
}

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
           islands_make(e);
}

void tn_evolution_free_arrays(tn_evolution *e)
{
    for (size_t i = 0; e->all && i < 2 * (size_t)e->settings.population; i++) {
        tn_genome_clear(&e->all[i].genome);
        free(e->all[i].sentence);
    }
    islands_free(e);
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
        islands_migrate(e);
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
