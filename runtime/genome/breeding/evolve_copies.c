/* Copies: a child whose sentence another of its generation has is bred again, of the same parents.
 *
 * Children are looked at in their order, after all have been made, and drawn again with draws of their own, so that the
 * result does not depend on threads. Parents stay the same: those that were selected by single cases are recalled. */
#include <stdlib.h>
#include <string.h>

#include "runtime/genome/breeding/evolve_state.h"

/* The sentences of a generation so far: a hash table, at most half full. No sentence has the hash 0, 0. */
typedef struct sentences {
    uint64_t (*hashes)[2];
    size_t mask;
} sentences;

static bool make_room(sentences *s, size_t count)
{
    size_t size = 16;
    while (size < 2 * count)
        size *= 2;
    s->hashes = calloc(size, sizeof *s->hashes);
    s->mask = size - 1;
    return s->hashes != NULL;
}

/* Is the sentence new? Then it is known from here on. */
static bool enter(sentences *s, const uint64_t hash[2])
{
    size_t at = (size_t)hash[0] & s->mask;
    for (; s->hashes[at][0] || s->hashes[at][1]; at = (at + 1) & s->mask)
        if (s->hashes[at][0] == hash[0] && s->hashes[at][1] == hash[1])
            return false;
    s->hashes[at][0] = hash[0];
    s->hashes[at][1] = hash[1];
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
        status = tn_evolution_first_genome(e, 0, number, attempt + 1, &trials[0], error);
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
        status = tn_evolution_breed_pair(e, 0, pair, attempt + 1, children, error);
        for (size_t i = 0; i < place.count && status == TN_OK; i++)
            if (!found[i])
                status = try_one(e, known, e->born[place.first + i], &trials[i], &found[i], error);
    }
    return status;
}

tn_status tn_evolution_breed_copies_again(tn_evolution *e, bool first, size_t begin, size_t end, size_t staying,
                                          tn_error *error)
{
    sentences known;
    tn_individual trials[2] = {0};
    if (e->settings.keeps_copies)
        return TN_OK;
    tn_status status = make_room(&known, staying + e->born_count) ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; i < staying && status == TN_OK; i++)
        is_new(&known, e->pool[i]);
    for (size_t i = begin; i < end && status == TN_OK; i++)
        status = first ? first_again(e, i, &known, trials, error) : pair_again(e, i, &known, trials, error);
    for (int i = 0; i < 2; i++) {
        tn_genome_clear(&trials[i].genome);
        free(trials[i].sentence);
    }
    free(known.hashes);
    return status;
}
