/* Being born: first genomes, children of pairs, and their sentences. */
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "runtime/base/array.h"
#include "runtime/genome/breeding/evolve_state.h"

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

tn_status tn_evolution_first_genome(tn_evolution *e, unsigned thread, size_t i, unsigned attempt,
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

tn_status tn_evolution_breed_pair(tn_evolution *e, unsigned thread, size_t pair, unsigned attempt,
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
        parents[i] = (tn_parent){tn_evolution_chosen_genome(e, &from[i]), from[i].member ? from[i].member->used : 0,
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
    tn_status status = first ? TN_OK : tn_evolution_breed_pair(e, thread, pair, 0, children, error);
    for (size_t i = place.first; i < place.first + place.count && status == TN_OK; i++) {
        if (first)
            status = tn_evolution_first_genome(e, thread, i, 0, e->born[i], error);
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
        status = tn_evolution_breed_copies_again(e, first, 0, first ? e->born_count : pairs, staying, error);
    return status == TN_OK ? tn_evolution_keep_born(e, error) : status;
}

tn_status tn_evolution_make_pair(tn_evolution *e, size_t pair, size_t staying, tn_error *error)
{
    tn_status status = make(e, 0, false, pair, error);
    return status == TN_OK ? tn_evolution_breed_copies_again(e, false, pair, pair + 1, staying, error) : status;
}
