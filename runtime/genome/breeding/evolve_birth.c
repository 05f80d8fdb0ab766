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
    for (size_t i = 0; i < count; i++)
        e->born[i]->id = (uint64_t)e->generation * e->settings.population + i;
}

/* ---- mapping */

static bool keep_sentence(tn_individual *individual, const char *text, size_t size)
{
    if (!tn_array_reserve(&individual->sentence, &individual->sentence_capacity, 0, size + 1, 1))
        return false;
    memcpy(individual->sentence, text, size);
    individual->sentence[size] = '\0';
    individual->sentence_size = size;
    return true;
}

static tn_status map_individual(tn_evolution *e, unsigned thread, tn_individual *individual, tn_error *error)
{
    tn_mapping mapping;
    tn_status status = tn_mapper_derive(tn_breeder_mapper(e->breeders[thread]), individual->genome.codons,
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

/* ---- genomes */

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

tn_status tn_evolution_make(tn_evolution *e, bool first, tn_error *error)
{
    e->births += e->born_count;
    return tn_crew_run(e->crew, (e->born_count + 1) / 2, 8, first ? first_item : next_item, e, error);
}

tn_status tn_evolution_make_pair(tn_evolution *e, size_t pair, tn_error *error)
{
    return make(e, 0, false, pair, error);
}
