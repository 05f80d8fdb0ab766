/* Being born: first genomes, children of pairs, and their sentences. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "runtime/base/array.h"
#include "runtime/genome/breeding/evolve_state.h"

static tn_status evolution_first_genome(tn_evolution *evolution, unsigned thread, size_t number, unsigned attempt,
                                        tn_individual *individual, tn_error *error);
static tn_status evolution_breed_pair(tn_evolution *evolution, unsigned thread, size_t pair, unsigned attempt,
                                      tn_individual *const children[2], tn_error *error);

/* ==== parents that a person chose: members, or, where genomes are remembered, anybody who was ever born */

/* ---- remembering */

void tn_evolution_remember(tn_evolution *e)
{
    e->settings.remembers = true;
}

bool tn_genome_take(tn_genome *to, const tn_genome *from)
{
    if (!tn_genome_reserve(to, from->count))
        return false;
    if (from->count)
        memcpy(to->codons, from->codons, from->count * sizeof *to->codons);
    to->count = from->count;
    return true;
}

static tn_status make_album(tn_evolution *e, tn_error *error)
{
    size_t end = (size_t)e->next_id;
    if (end <= e->album_count)
        return TN_OK;
    if (!tn_array_resize(&e->album, end, sizeof *e->album))
        return tn_fail_memory(error);
    memset(e->album + e->album_count, 0, (end - e->album_count) * sizeof *e->album);
    e->album_count = end;
    return TN_OK;
}

tn_status tn_evolution_keep_genome(tn_evolution *e, const tn_individual *individual, tn_error *error)
{
    if (!e->settings.remembers)
        return TN_OK;
    tn_status status = make_album(e, error);
    if (status == TN_OK && !tn_genome_take(&e->album[individual->id], &individual->genome))
        status = tn_fail_memory(error);
    return status;
}

tn_status tn_evolution_keep_born(tn_evolution *e, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; i < e->born_count && status == TN_OK; i++)
        status = tn_evolution_keep_genome(e, e->born[i], error);
    return status;
}

/* ---- choosing */

static tn_individual *member_of(const tn_evolution *e, uint64_t id)
{
    for (size_t i = 0; i < e->member_count; i++)
        if (e->members[i]->id == id)
            return e->members[i];
    return NULL;
}

static tn_status find_chosen(const tn_evolution *e, const tn_chosen *chosen, tn_chosen_parent *parent, tn_error *error)
{
    uint64_t number = chosen->number;
    if (!chosen->by_id && number >= e->member_count)
        return tn_fail(error, TN_INVALID, E_NO_INDIVIDUAL,
                       "there is no individual %" PRIu64 "; they are numbered from 1 to %zu", number + 1,
                       e->member_count);
    if (chosen->weight != 1 && !e->kind->weighs)
        return tn_fail(error, TN_INVALID, E_NO_INDIVIDUAL,
                       "this run does not weigh its parents; 3*2 lets one count twice instead of @%.6g",
                       chosen->weight);
    tn_individual *member = chosen->by_id ? member_of(e, number) : e->members[number];
    if (!member && (number >= e->album_count || e->album[number].count == 0))
        return tn_fail(error, TN_INVALID, E_NO_INDIVIDUAL, "nobody with the id %" PRIu64 " was born so far", number);
    *parent = (tn_chosen_parent){member ? member->id : number, chosen->weight, member};
    return TN_OK;
}

tn_status tn_evolution_choose(tn_evolution *e, const tn_chosen *chosen, size_t count, tn_error *error)
{
    if (e->island_count > 1)
        return tn_fail(error, TN_INVALID, E_EVOLUTION_VALUE,
                       "a person chooses parents from one population, not from islands");
    tn_chosen_parent *parents = malloc((count ? count : 1) * sizeof *parents);
    tn_status status = parents ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; i < count && status == TN_OK; i++)
        status = find_chosen(e, &chosen[i], &parents[i], error);
    if (status != TN_OK) {
        free(parents);
        return status;
    }
    free(e->chosen);
    e->chosen = parents;
    e->chosen_count = count;
    return TN_OK;
}

/* The genome of a chosen parent. */
static const tn_genome *evolution_chosen_genome(const tn_evolution *e, const tn_chosen_parent *parent)
{
    return parent->member ? &parent->member->genome : &e->album[parent->id];
}

/* ---- staying */

static tn_individual *free_place(tn_evolution *e)
{
    for (size_t i = 0; i < 2 * (size_t)e->settings.population; i++)
        if (!e->all[i].member)
            return &e->all[i];
    return NULL;
}

/* Who is no member any more is born again, with the same id. */
static tn_status bring_back(tn_evolution *e, const tn_chosen_parent *parent, tn_individual **back, tn_error *error)
{
    tn_individual *individual = free_place(e);
    if (!tn_genome_take(&individual->genome, &e->album[parent->id]))
        return tn_fail_memory(error);
    individual->id = parent->id;
    individual->kind = TN_BIRTH_CLONE;
    individual->parents[0] = individual->parents[1] = TN_NO_PARENT;
    individual->member = true; /* its place is taken */
    *back = individual;
    return tn_evolution_write(e, 0, individual, error);
}

static bool is_among(tn_individual *const *individuals, size_t count, uint64_t id)
{
    for (size_t i = 0; i < count; i++)
        if (individuals[i]->id == id)
            return true;
    return false;
}

tn_status tn_evolution_bring_back(tn_evolution *e, size_t *count, tn_error *error)
{
    tn_status status = TN_OK;
    *count = 0;
    for (size_t i = 0; i < e->chosen_count && *count < e->settings.population / 2 && status == TN_OK; i++) {
        tn_individual *stays = e->chosen[i].member;
        if (is_among(e->pool, *count, e->chosen[i].id))
            continue;
        if (!stays)
            status = bring_back(e, &e->chosen[i], &stays, error);
        stays->stayed = true;
        e->pool[(*count)++] = stays;
    }
    return status;
}

/* ==== Copies: a child whose sentence another of its generation has is bred again, of the same parents. Children are
 * looked at in their order, after all have been made, and drawn again with draws of their own, so that the result does
 * not depend on threads. Parents stay the same: those that were selected by single cases are recalled
 */

/* The sentences of a generation so far, by 128 bits of their hashes. There is room for all. */
typedef struct sentences {
    uint64_t (*hashes)[2];
    size_t count;
    tn_hash_table index;
} sentences;

static tn_status make_room(sentences *s, size_t count, tn_error *error)
{
    *s = (sentences){.hashes = calloc(count + 1, sizeof *s->hashes)};
    return s->hashes ? tn_hash_reserve(&s->index, count, error) : tn_fail_memory(error);
}

static void clear_sentences(sentences *s)
{
    free(s->hashes);
    tn_hash_clear(&s->index);
}

typedef struct wanted_sentence {
    const sentences *of;
    const uint64_t *hash;
} wanted_sentence;

static bool is_sentence(const void *context, uint32_t number)
{
    const wanted_sentence *w = context;
    return memcmp(w->of->hashes[number], w->hash, sizeof w->of->hashes[number]) == 0;
}

/* Is the sentence new? Then it is known from here on. */
static bool enter(sentences *s, const uint64_t hash[2])
{
    uint32_t number = (uint32_t)s->count;
    wanted_sentence wanted = {s, hash};
    (void)tn_hash_enter(&s->index, hash[0], is_sentence, &wanted, &number, NULL); /* there is room */
    if (number < s->count)
        return false;
    memcpy(s->hashes[s->count++], hash, sizeof *s->hashes);
    return true;
}

static bool is_new(sentences *s, const tn_individual *individual)
{
    return individual->reason != TN_MAPPING_VALID || enter(s, individual->hash);
}

/* What a genome makes of an individual changes places with the other's; who it is stays. */
static void exchange(tn_individual *a, tn_individual *b)
{
    tn_individual other = *a;
    a->genome = b->genome;
    a->sentence = b->sentence;
    a->sentence_size = b->sentence_size;
    a->sentence_capacity = b->sentence_capacity;
    memcpy(a->hash, b->hash, sizeof a->hash);
    a->used = b->used;
    a->depth = b->depth;
    a->reason = b->reason;
    a->kind = b->kind;
    memcpy(a->parents, b->parents, sizeof a->parents);
    *b = other;
}

/* Puts the trial into the child's place if it has a sentence that is new. */
static tn_status try_one(tn_evolution *e, sentences *known, tn_individual *child, tn_individual *trial, bool *found,
                         tn_error *error)
{
    tn_status status = tn_evolution_write(e, 0, trial, error);
    *found = status == TN_OK && trial->reason == TN_MAPPING_VALID && enter(known, trial->hash);
    if (*found)
        exchange(child, trial);
    return status;
}

static tn_status first_again(tn_evolution *e, size_t number, sentences *known, tn_individual trials[2], tn_error *error)
{
    bool found = is_new(known, e->born[number]) || number < e->settings.seed_count; /* what is given stays */
    tn_status status = TN_OK;
    for (unsigned attempt = 0; attempt < TN_ATTEMPTS_MAX && !found && status == TN_OK; attempt++) {
        status = evolution_first_genome(e, 0, number, attempt + 1, &trials[0], error);
        if (status == TN_OK)
            status = try_one(e, known, e->born[number], &trials[0], &found, error);
    }
    return status;
}

static tn_status pair_again(tn_evolution *e, size_t pair, sentences *known, tn_individual trials[2], tn_error *error)
{
    const tn_brood place = tn_evolution_pair(e, pair);
    bool found[2] = {true, true};
    tn_status status = TN_OK;
    for (size_t i = 0; i < place.count; i++)
        found[i] = is_new(known, e->born[place.first + i]);
    for (unsigned attempt = 0; attempt < TN_ATTEMPTS_MAX && !(found[0] && found[1]) && status == TN_OK; attempt++) {
        tn_individual *children[2] = {&trials[0], &trials[1]};
        status = evolution_breed_pair(e, 0, pair, attempt + 1, children, error);
        for (size_t i = 0; i < place.count && status == TN_OK; i++)
            if (!found[i])
                status = try_one(e, known, e->born[place.first + i], &trials[i], &found[i], error);
    }
    return status;
}

/* Of the pairs [begin, end), or of the first generation's individuals: breeds those again that have the sentence of
 * another before them, or of the first `staying` of the pool. Who has none in a few attempts that is new is a copy. */
static tn_status evolution_breed_copies_again(tn_evolution *e, bool first, size_t begin, size_t end, size_t staying,
                                              tn_error *error)
{
    sentences known = {0};
    tn_individual trials[2] = {0};
    if (e->settings.keeps_copies)
        return TN_OK;
    tn_status status = make_room(&known, staying + e->born_count, error);
    for (size_t i = 0; i < staying && status == TN_OK; i++)
        is_new(&known, e->pool[i]);
    for (size_t i = begin; i < end && status == TN_OK; i++)
        status = first ? first_again(e, i, &known, trials, error) : pair_again(e, i, &known, trials, error);
    for (int i = 0; i < 2; i++) {
        tn_genome_clear(&trials[i].genome);
        free(trials[i].sentence);
    }
    clear_sentences(&known);
    return status;
}

void tn_evolution_take_places(tn_evolution *e, size_t count)
{
    size_t taken = 0;
    for (size_t i = 0; i < 2 * (size_t)e->settings.population && taken < count; i++)
        if (!e->all[i].member)
            e->born[taken++] = &e->all[i];
    e->born_count = count;
    e->births_each = count / e->island_count;
    for (size_t i = 0; i < count; i++) {
        e->born[i]->id = e->next_id + i;
        e->born[i]->stayed = false;
    }
    e->next_id += e->settings.population;
}

static size_t pairs_each(const tn_evolution *e)
{
    return (e->births_each + 1) / 2;
}

size_t tn_evolution_pairs(const tn_evolution *e)
{
    return e->island_count * pairs_each(e);
}

tn_brood tn_evolution_pair(const tn_evolution *e, size_t pair)
{
    size_t island = pair / pairs_each(e), child = 2 * (pair % pairs_each(e));
    return (tn_brood){island, island * e->births_each + child, child + 1 == e->births_each ? 1 : 2};
}

/* ---- sentences */

static bool keep_sentence(tn_individual *individual, const char *text, size_t size)
{
    if (!tn_array_reserve(&individual->sentence, &individual->sentence_capacity, 0, size + 1, 1))
        return false;
    memcpy(individual->sentence, text, size);
    individual->sentence[size] = '\0';
    individual->sentence_size = size;
    return true;
}

tn_status tn_evolution_write(tn_evolution *e, unsigned thread, tn_individual *individual, tn_error *error)
{
    tn_written written;
    tn_status status = e->kind->write(e->workplaces[thread], &individual->genome, &written, error);
    if (status != TN_OK)
        return status;
    if (!keep_sentence(individual, written.sentence, written.size))
        return tn_fail_memory(error);
    XXH128_hash_t hash = XXH3_128bits(written.sentence, written.size);
    individual->hash[0] = hash.low64;
    individual->hash[1] = hash.high64;
    individual->used = written.used;
    individual->depth = written.depth;
    individual->reason = written.reason;
    individual->message[0] = '\0';
    return TN_OK;
}

/* ---- genomes */

static tn_status seed_genome(const tn_genome *seed, tn_genome *genome, tn_error *error)
{
    if (!tn_genome_reserve(genome, seed->count))
        return tn_fail_memory(error);
    memcpy(genome->codons, seed->codons, seed->count * sizeof *seed->codons);
    genome->count = seed->count;
    return TN_OK;
}

/* One genome of the first generation, and the children of one pair of parents (the second child may be NULL), without
 * sentences. The parents are the same in each attempt, the other draws are not. */
static tn_status evolution_first_genome(tn_evolution *e, unsigned thread, size_t i, unsigned attempt,
                                        tn_individual *individual, tn_error *error)
{
    const tn_evolution_settings *s = &e->settings;
    tn_chance chance = tn_chance_again(s->seed, TN_PURPOSE_INITIALISE, 0, i, attempt);
    tn_birth birth = {TN_BIRTH_SEED, {TN_NO_PARENT, TN_NO_PARENT}};
    tn_status status = i < s->seed_count
                           ? seed_genome(&s->seeds[i], &individual->genome, error)
                           : e->kind->first(e->workplaces[thread], i, &chance, &individual->genome, &birth, error);
    individual->kind = birth.kind;
    memcpy(individual->parents, birth.parents, sizeof birth.parents);
    return status;
}

/* Where parents are recalled, `known` is the id of one. */
static size_t place_of_parent(const tn_evolution *e, const tn_island *island, unsigned thread, tn_chance *chance,
                              uint64_t known)
{
    if (e->chosen)
        return (size_t)tn_chance_below(chance, island->count);
    for (size_t i = 0; known != TN_NO_PARENT && i < island->count; i++)
        if (island->members[i]->id == known)
            return i;
    if (e->lexicase.members)
        return tn_lexicase_select(&e->lexicase, thread, chance); /* then there is one island */
    return island->merits[tn_select(&e->settings.select, chance, island->merits, island->count)].index;
}

static tn_chosen_parent draw_parent(const tn_evolution *e, const tn_island *island, unsigned thread, tn_chance *chance,
                                    uint64_t known)
{
    if (e->chosen && e->chosen_count)
        return e->chosen[tn_chance_below(chance, e->chosen_count)];
    size_t place = place_of_parent(e, island, thread, chance, known);
    return (tn_chosen_parent){island->members[place]->id, 1, island->members[place]};
}

static bool selects_by_cases(const tn_evolution *e)
{
    return e->settings.select.selection == TN_SELECT_LEXICASE ||
           e->settings.select.selection == TN_SELECT_EPSILON_LEXICASE;
}

static tn_status evolution_breed_pair(tn_evolution *e, unsigned thread, size_t pair, unsigned attempt,
                                      tn_individual *const children[2], tn_error *error)
{
    const tn_brood place = tn_evolution_pair(e, pair);
    tn_chance selecting = tn_chance_for(e->settings.seed, TN_PURPOSE_SELECT, e->generation, pair);
    tn_chance breeding = tn_chance_again(e->settings.seed, TN_PURPOSE_BIRTH, e->generation, pair, attempt);
    uint64_t known[2] = {TN_NO_PARENT, TN_NO_PARENT};
    tn_chosen_parent from[2];
    tn_parent parents[2];
    if (selects_by_cases(e) && e->recall_parents)
        e->recall_parents(e->recall_context, e->born[place.first]->id, known);
    for (int i = 0; i < 2; i++) {
        from[i] = draw_parent(e, &e->islands[place.island], thread, &selecting, known[i]);
        parents[i] = (tn_parent){evolution_chosen_genome(e, &from[i]), from[i].member ? from[i].member->used : 0,
                                 from[i].weight};
    }
    tn_genome spare = {0};
    tn_genome *genomes[2] = {&children[0]->genome, children[1] ? &children[1]->genome : &spare};
    uint8_t kinds[2];
    tn_status status = e->kind->breed(e->workplaces[thread], &breeding, parents, genomes, kinds, error);
    for (size_t i = 0; i < 2 && children[i]; i++) {
        children[i]->kind = kinds[i];
        children[i]->parents[0] = from[i].id;
        children[i]->parents[1] = from[1 - i].id;
    }
    tn_genome_clear(&spare);
    return status;
}

static tn_status make(tn_evolution *e, unsigned thread, bool first, size_t pair, tn_error *error)
{
    const tn_brood place = tn_evolution_pair(e, pair);
    tn_individual *children[2] = {e->born[place.first], place.count == 1 ? NULL : e->born[place.first + 1]};
    tn_status status = first ? TN_OK : evolution_breed_pair(e, thread, pair, 0, children, error);
    for (size_t i = place.first; i < place.first + place.count && status == TN_OK; i++) {
        if (first)
            status = evolution_first_genome(e, thread, i, 0, e->born[i], error);
        if (status == TN_OK)
            status = tn_evolution_write(e, thread, e->born[i], error);
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

tn_status tn_evolution_make(tn_evolution *e, bool first, size_t staying, tn_error *error)
{
    size_t pairs = tn_evolution_pairs(e);
    e->births += e->born_count;
    tn_status status = tn_crew_run(e->crew, pairs, 8, first ? first_item : next_item, e, error);
    if (status == TN_OK)
        status = evolution_breed_copies_again(e, first, 0, first ? e->born_count : pairs, staying, error);
    return status == TN_OK ? tn_evolution_keep_born(e, error) : status;
}

tn_status tn_evolution_make_pair(tn_evolution *e, size_t pair, size_t staying, tn_error *error)
{
    tn_status status = make(e, 0, false, pair, error);
    return status == TN_OK ? evolution_breed_copies_again(e, false, pair, pair + 1, staying, error) : status;
}
