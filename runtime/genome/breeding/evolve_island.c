/* Islands: parts of a population within which parents are chosen and members replaced; and the order of merit. */
#include <stdlib.h>
#include <string.h>

#include "runtime/genome/breeding/evolve_state.h"

size_t tn_island_size(const tn_evolution *e)
{
    return e->settings.population / e->island_count;
}

bool tn_islands_make(tn_evolution *e)
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

void tn_islands_free(tn_evolution *e)
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

void tn_islands_migrate(tn_evolution *e)
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
