/* A run of evolution as bytes: what it was started with, the scores and parents of all births, and what a person chose.
 *
 *   "TARTANEV", then little-endian numbers of 64 bits: format, grammar's hash, settings' hash, members' hash,
 *   population, objectives, generations, choices, whether the last one is yet to be used
 *   a birth: its state, its parents' ids, then its objectives as IEEE 754 bits (of a birth that did not take place:
 * zeros) a choice: generation, number of places, places the XXH3 hash of all before it
 */
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "api/genome/evolution.h"
#include "runtime/base/bytes.h"

#define MAGIC "TARTANEV"
enum { FORMAT = 2, HEADER = 9, BIRTH = 3, WORD = 8 };

/* The settings that decide what a run does. */
static uint64_t settings_hash(const tartan_evolution *e)
{
    const tn_evolution_settings *s = &e->settings;
    const uint64_t numbers[] = {s->seed,
                                s->population,
                                s->initialisation,
                                s->codons,
                                s->depth_low,
                                s->depth_high,
                                tn_bits_of(s->tail),
                                s->select.selection,
                                s->select.tournament,
                                tn_bits_of(s->select.truncation),
                                s->vary.crossover,
                                tn_bits_of(s->vary.crossover_rate),
                                s->vary.mutation,
                                tn_bits_of(s->vary.mutation_rate),
                                s->vary.within_used,
                                s->vary.codon_limit,
                                s->vary.max_codons,
                                s->vary.tree_depth,
                                s->elites,
                                s->keeps_copies,
                                s->islands,
                                s->migrants,
                                s->every,
                                s->replacement,
                                s->mapping.wraps,
                                s->mapping.max_depth,
                                s->mapping.max_steps,
                                s->mapping.repair,
                                s->mapping.position_independent,
                                e->evaluator.cases,
                                s->seed_count};
    unsigned char bytes[sizeof numbers];
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        tn_put_u64(bytes + i * WORD, numbers[i]);
    uint64_t hash = XXH3_64bits(bytes, sizeof bytes);
    for (size_t i = 0; i < s->seed_count; i++)
        hash = XXH3_64bits_withSeed(s->seeds[i].codons, s->seeds[i].count * sizeof *s->seeds[i].codons, hash);
    return hash;
}

/* Who is in the newest generation, in their order. */
static uint64_t members_hash(const tartan_evolution *e)
{
    size_t count = 0;
    uint64_t hash = 0;
    const tn_individual *const *members = tn_evolution_members(e->engine, &count);
    for (size_t i = 0; i < count; i++) {
        unsigned char id[WORD];
        tn_put_u64(id, members[i]->id);
        hash = XXH3_64bits_withSeed(id, sizeof id, hash);
        hash = XXH3_64bits_withSeed(members[i]->sentence, members[i]->sentence_size, hash);
    }
    return hash;
}

static size_t births(const tartan_evolution *e)
{
    return (size_t)e->done * e->settings.population;
}

/* ---- saving */

static unsigned char *put(unsigned char *at, uint64_t number)
{
    tn_put_u64(at, number);
    return at + WORD;
}

static unsigned char *put_births(const tartan_evolution *e, unsigned char *at)
{
    for (size_t i = 0; i < births(e); i++) {
        const tn_api_birth *birth = &e->births[i];
        at = put(put(put(at, birth->score.state), birth->parents[0]), birth->parents[1]);
        for (size_t k = 0; k < e->evaluator.objectives; k++)
            at = put(at, tn_bits_of(birth->score.objectives[k]));
    }
    return at;
}

tartan_status tartan_evolution_save(const tartan_evolution *e, void **bytes, size_t *size, tartan_error *error)
{
    if (!e || !bytes || !size)
        return tn_api_missing(error, e ? "room for the state" : "evolution");
    if (!e->engine)
        return tn_api_refuse(error, TARTAN_INVALID, "the evolution broke when memory ran out");
    size_t words = HEADER + births(e) * (BIRTH + e->evaluator.objectives) + 1;
    for (size_t i = 0; i < e->choice_count; i++)
        words += 2 + e->choices[i].count;
    unsigned char *made = malloc(sizeof MAGIC - 1 + words * WORD), *at = made;
    if (!made)
        return tn_api_memory(error);
    memcpy(at, MAGIC, sizeof MAGIC - 1);
    at += sizeof MAGIC - 1;
    const uint64_t header[HEADER] = {FORMAT,          e->grammar->hash,       settings_hash(e),
                                     members_hash(e), e->settings.population, e->evaluator.objectives,
                                     e->done,         e->choice_count,        e->chosen};
    for (size_t i = 0; i < HEADER; i++)
        at = put(at, header[i]);
    at = put_births(e, at);
    for (size_t i = 0; i < e->choice_count; i++) {
        at = put(put(at, e->choices[i].generation), e->choices[i].count);
        for (size_t k = 0; k < e->choices[i].count; k++)
            at = put(at, e->choices[i].places[k]);
    }
    at = put(at, XXH3_64bits(made, (size_t)(at - made)));
    *bytes = made;
    *size = (size_t)(at - made);
    return TARTAN_OK;
}

/* ---- restoring */

/* Numbers still to be read; what is past the end is zero and remembered. */
typedef struct reader {
    const unsigned char *at;
    size_t left; /* numbers */
    bool failed;
} reader;

static uint64_t get(reader *r)
{
    if (r->left == 0) {
        r->failed = true;
        return 0;
    }
    uint64_t number = tn_get_u64(r->at);
    r->at += WORD;
    r->left--;
    return number;
}

static bool read_births(reader *r, tartan_evolution *e)
{
    if (births(e) > r->left / (BIRTH + e->evaluator.objectives))
        return false;
    if (!tn_api_evolution_reserve(e, e->done))
        return false;
    for (size_t i = 0; i < births(e); i++) {
        uint64_t state = get(r);
        tn_api_birth *birth = &e->births[i];
        *birth = (tn_api_birth){.score.state = state < TN_SCORE_STATE_COUNT ? (tn_score_state)state : TN_SCORE_FAILED};
        birth->parents[0] = get(r);
        birth->parents[1] = get(r);
        for (size_t k = 0; k < e->evaluator.objectives; k++)
            birth->score.objectives[k] = tn_double_of(get(r));
    }
    return true;
}

static bool read_choice(reader *r, tartan_evolution *e)
{
    uint64_t generation = get(r), count = get(r);
    uint32_t *places = count <= r->left ? calloc((size_t)count + 1, sizeof *places) : NULL;
    if (!places)
        return false;
    for (size_t i = 0; i < count; i++)
        places[i] = (uint32_t)get(r);
    return tn_api_evolution_add_choice(e, (uint32_t)generation, places, (size_t)count);
}

static tartan_status damaged(tartan_error *error)
{
    return tn_api_refuse(error, TARTAN_INVALID, "these bytes are no saved evolution, or damaged");
}

static tartan_status check_header(const uint64_t *header, const tartan_evolution *e, tartan_error *error)
{
    if (header[0] != FORMAT)
        return tn_api_refuse(error, TARTAN_INVALID, "the evolution was saved by another version of Tartan");
    if (header[1] != e->grammar->hash)
        return tn_api_refuse(error, TARTAN_INVALID, "the evolution was started with another grammar");
    if (header[2] != settings_hash(e) || header[4] != e->settings.population || header[5] != e->evaluator.objectives)
        return tn_api_refuse(error, TARTAN_INVALID, "the evolution was started with other options");
    return header[6] < UINT32_MAX / 2 ? TARTAN_OK : damaged(error);
}

static tartan_status restore(tartan_evolution *e, const unsigned char *bytes, size_t size, tartan_error *error)
{
    size_t magic = sizeof MAGIC - 1;
    uint64_t header[HEADER];
    if (size < magic + (HEADER + 1) * WORD || (size - magic) % WORD || memcmp(bytes, MAGIC, magic) != 0 ||
        tn_get_u64(bytes + size - WORD) != XXH3_64bits(bytes, size - WORD))
        return damaged(error);
    reader r = {bytes + magic, (size - magic) / WORD - 1, false};
    for (size_t i = 0; i < HEADER; i++)
        header[i] = get(&r);
    tartan_status status = check_header(header, e, error);
    if (status != TARTAN_OK)
        return status;
    e->done = (uint32_t)header[6];
    bool good = read_births(&r, e);
    for (uint64_t i = 0; i < header[7] && good; i++)
        good = read_choice(&r, e);
    e->chosen = header[8] && e->choice_count;
    if (!good || r.failed || r.left)
        return damaged(error);
    status = tn_api_evolution_replay(e, error);
    if (status == TARTAN_OK && members_hash(e) != header[3])
        status = tn_api_refuse(error, TARTAN_INVALID, "the evolution cannot be made again: it is another version's");
    return status;
}

tartan_status tartan_evolution_restore(const tartan_module *module, const tartan_evolution_options *options,
                                       const void *bytes, size_t size, tartan_evolution **evolution,
                                       tartan_error *error)
{
    tartan_evolution *made = NULL;
    if (!bytes)
        return tn_api_missing(error, "saved state");
    tartan_status status = tn_api_evolution_make(module, options, &made, error);
    if (status != TARTAN_OK)
        return status;
    status = restore(made, bytes, size, error);
    if (status == TARTAN_OK)
        *evolution = made;
    else
        tartan_evolution_free(made);
    return status;
}
