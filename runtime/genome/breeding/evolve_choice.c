/* Parents that a person chose: members, or, where genomes are remembered, anybody who was ever born. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/genome/breeding/evolve_state.h"

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

const tn_genome *tn_evolution_chosen_genome(const tn_evolution *e, const tn_chosen_parent *parent)
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
