/* What a person does to a population by hand: inserts individuals, takes some out, makes it larger or smaller. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/genome/breeding/evolve_state.h"

const tn_individual *const *tn_evolution_inserted(const tn_evolution *e, size_t *count)
{
    *count = e->shown_guests;
    return (const tn_individual *const *)(e->guests + (e->guest_count - e->new_guests - e->shown_guests));
}

uint64_t tn_evolution_next_id(const tn_evolution *e)
{
    return e->next_id;
}

uint64_t tn_evolution_worst(const tn_evolution *e)
{
    return e->member_count < e->settings.population ? TN_NO_PARENT : e->members[e->member_count - 1]->id;
}

/* ---- guests */

static void forget_guest(tn_individual *guest)
{
    tn_genome_clear(&guest->genome);
    free(guest->sentence);
    free(guest);
}

void tn_evolution_part_from_guests(tn_evolution *e)
{
    size_t kept = 0, old = e->guest_count - e->new_guests;
    for (size_t i = 0; i < e->guest_count; i++) {
        if (i < old && !e->guests[i]->member)
            forget_guest(e->guests[i]);
        else
            e->guests[kept++] = e->guests[i];
    }
    e->guest_count = kept;
    e->shown_guests = e->new_guests;
    e->new_guests = 0;
}

static tn_status make_guest(tn_evolution *e, const tn_genome *genome, uint64_t parent, tn_individual **made,
                            tn_error *error)
{
    tn_individual *guest = calloc(1, sizeof *guest);
    *made = guest;
    if (!guest || !tn_array_resize(&e->guests, e->guest_count + 1, sizeof(tn_individual *)) ||
        !tn_genome_take(&guest->genome, genome)) {
        if (guest)
            forget_guest(guest);
        return tn_fail_memory(error);
    }
    e->guests[e->guest_count++] = guest;
    e->new_guests++;
    e->births++;
    guest->id = e->next_id++;
    guest->kind = TN_BIRTH_INSERTED;
    guest->parents[0] = guest->parents[1] = parent;
    tn_status status = tn_evolution_keep_genome(e, guest, error);
    return status == TN_OK ? tn_evolution_write(e, 0, guest, error) : status;
}

/* ---- places */

static tn_status no_member(uint64_t id, tn_error *error)
{
    tn_fail(error, TN_INVALID, E_NO_INDIVIDUAL, "there is no member with the id %" PRIu64 " now", id);
    tn_error_help(error, "the members are those on the newest sheet; `tartan runs replay` writes anybody else");
    return TN_INVALID;
}

/* The island that the member `id` is on, or that has room (TN_NO_PARENT). */
static tn_island *island_of(const tn_evolution *e, uint64_t id, size_t *place)
{
    for (size_t i = 0; i < e->island_count; i++) {
        tn_island *island = &e->islands[i];
        for (*place = 0; *place < island->count; ++*place)
            if (island->members[*place]->id == id)
                return island;
        if (id == TN_NO_PARENT && island->count < tn_island_size(e))
            return island;
    }
    return NULL;
}

/* The island's members are those of the pool from now on. */
static void settle(tn_evolution *e, tn_island *island, size_t count)
{
    tn_island_keep_best(e, island, e->pool, count, count);
    tn_islands_order(e);
}

tn_status tn_evolution_insert(tn_evolution *e, const tn_genome *genome, uint64_t out, uint64_t parent, tn_error *error)
{
    size_t place;
    tn_individual *guest;
    tn_island *island = island_of(e, out, &place);
    if (!island)
        return tn_ranks_agree(e->settings.ranks, no_member(out, error), error);
    tn_status status = make_guest(e, genome, parent, &guest, error);
    status = tn_ranks_agree(e->settings.ranks, status, error);
    if (status == TN_OK)
        status = tn_evolution_score(e, TN_OK, &guest, 1, error);
    if (status != TN_OK)
        return status;
    size_t count = island->count;
    memcpy(e->pool, island->members, count * sizeof *e->pool);
    if (place < count)
        e->pool[place]->member = false;
    e->pool[place] = guest;
    settle(e, island, place < count ? count : count + 1);
    return TN_OK;
}

tn_status tn_evolution_remove(tn_evolution *e, uint64_t id, tn_error *error)
{
    size_t place, count = 0, least = e->settings.elites > 2 ? e->settings.elites : 2;
    tn_island *island = id == TN_NO_PARENT ? NULL : island_of(e, id, &place);
    if (!island)
        return no_member(id, error);
    if (island->count <= least) {
        tn_fail(error, TN_INVALID, E_NO_INDIVIDUAL, "%zu members are the fewest that can breed here", least);
        tn_error_help(error, "insert another in its place instead");
        return TN_INVALID;
    }
    for (size_t i = 0; i < island->count; i++)
        if (i != place)
            e->pool[count++] = island->members[i];
    island->members[place]->member = false;
    settle(e, island, count);
    return TN_OK;
}

/* ---- another size */

static tn_status check_size(const tn_evolution *e, uint32_t population, tn_error *error)
{
    size_t islands = e->island_count, each = population / islands;
    bool fits = population <= TN_POPULATION_MAX && population % islands == 0 && each >= 2 &&
                each >= e->settings.elites && !(e->settings.every && e->settings.migrants >= each);
    if (fits)
        return TN_OK;
    tn_fail(error, TN_INVALID, E_POPULATION, "this run cannot have a population of %u", population);
    tn_error_help(error, "it has at least 2 individuals on each of %zu island%s, no fewer than its elites, at most %u",
                  islands, islands == 1 ? "" : "s", TN_POPULATION_MAX);
    return TN_INVALID;
}

/* Moves a member to a place in other arrays; guests have places of their own. */
static tn_individual *move_member(tn_evolution *from, tn_individual *member, tn_individual *place)
{
    if (member < from->all || member >= from->all + 2 * (size_t)from->settings.population)
        return member;
    *place = *member;
    *member = (tn_individual){0};
    return place;
}

static int compare_ids(const void *left, const void *right)
{
    const uint64_t *a = left, *b = right;
    return *a < *b ? -1 : *a > *b;
}

/* Those that leave come behind the others, whose order stays. */
static void put_last(tn_evolution *e, tn_island *island, const uint64_t *left, size_t left_count)
{
    size_t kept = 0, last = 0;
    for (size_t i = 0; i < island->count; i++) {
        tn_individual *member = island->members[i];
        if (bsearch(&member->id, left, left_count, sizeof *left, compare_ids))
            e->pool[last++] = member;
        else
            island->members[kept++] = member;
    }
    memcpy(island->members + kept, e->pool, last * sizeof *e->pool);
}

tn_status tn_evolution_resize(tn_evolution *e, uint32_t population, const uint64_t *left, size_t left_count,
                              tn_error *error)
{
    tn_status status = check_size(e, population, error);
    if (status != TN_OK)
        return status;
    for (size_t i = 0; i < e->island_count && left_count; i++)
        put_last(e, &e->islands[i], left, left_count);
    tn_evolution before = *e;
    e->settings.population = population;
    if (!tn_evolution_allocate(e)) {
        tn_evolution_free_arrays(e);
        *e = before;
        return tn_fail_memory(error);
    }
    size_t moved = 0;
    for (size_t i = 0; i < e->island_count; i++) {
        tn_island *old = &before.islands[i], *island = &e->islands[i];
        island->count = old->count < tn_island_size(e) ? old->count : tn_island_size(e);
        for (size_t k = 0; k < old->count; k++) {
            if (k < island->count)
                island->members[k] = move_member(&before, old->members[k], &e->all[moved++]);
            else
                old->members[k]->member = false;
        }
    }
    e->born_count = 0;
    tn_evolution_free_arrays(&before);
    for (size_t i = 0; i < e->island_count; i++) {
        memcpy(e->pool, e->islands[i].members, e->islands[i].count * sizeof *e->pool);
        tn_island_keep_best(e, &e->islands[i], e->pool, e->islands[i].count, e->islands[i].count);
    }
    tn_islands_order(e);
    return TN_OK;
}
