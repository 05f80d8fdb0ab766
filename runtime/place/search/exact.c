/* Looks at every model that the rules allow, each once: at each open connector everything that fits, and also nothing.
 * Where nothing is put though something fits, it has to be in the way of all of that in the end, and nothing that comes
 * later may join there: that model is looked at where it is put here. Where the objective never falls as parts are
 * added, plans that have reached the best are not gone on with. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/place/search/run.h"

enum { FITTING_MAX = 4096, ASK_EVERY = 256 };

/* A connector where it is being tried what to put: back to `before` comes the next of its choices. */
typedef struct decision {
    tn_open_site site;
    uint32_t next, count;          /* of its choices in `fitting`; at `count` nothing is put */
    size_t fitting;                /* the first of them */
    size_t puts, left;             /* that were there before */
    size_t open_first, open_count; /* the open connectors then, in `open` */
} decision;

typedef struct exact {
    tn_place_search_run *run;
    decision *decisions;
    uint32_t *fitting;
    tn_open_site *open; /* saved for the decisions, one after the other */
    tn_open_site *left; /* connectors where nothing was put though something fitted */
    size_t decision_count, decision_capacity, fitting_count, fitting_capacity, open_count, open_capacity, left_count,
        left_capacity;
    uint64_t looked_at, given_up, steps;
} exact;

static tn_status keep_open(exact *e, decision *d)
{
    const tn_standing *plan = &e->run->worlds[0].plan;
    if (!tn_array_reserve(&e->open, &e->open_capacity, e->open_count, plan->open_count, sizeof *e->open))
        return tn_fail_memory(e->run->error);
    d->open_first = e->open_count;
    d->open_count = plan->open_count;
    if (plan->open_count)
        memcpy(&e->open[e->open_count], plan->open + plan->open_first, plan->open_count * sizeof *e->open);
    e->open_count += plan->open_count;
    return TN_OK;
}

/* Goes on to the next connector where something fits; *none: there is no more. */
static tn_status next_decision(exact *e, bool *none)
{
    tn_world *world = &e->run->worlds[0];
    uint32_t fitting[FITTING_MAX];
    *none = true;
    while (world->plan.open_count > 0) {
        tn_open_site site = tn_world_next(world);
        size_t count = tn_world_choices(world, &site, true, fitting, FITTING_MAX);
        if (count == 0)
            continue;
        decision d = {.site = site,
                      .count = (uint32_t)count,
                      .fitting = e->fitting_count,
                      .puts = world->plan.put_count,
                      .left = e->left_count};
        if (!tn_array_reserve(&e->decisions, &e->decision_capacity, e->decision_count, 1, sizeof *e->decisions) ||
            !tn_array_reserve(&e->fitting, &e->fitting_capacity, e->fitting_count, count, sizeof *e->fitting))
            return tn_fail_memory(e->run->error);
        memcpy(&e->fitting[e->fitting_count], fitting, count * sizeof *fitting);
        e->fitting_count += count;
        *none = false;
        tn_status status = keep_open(e, &d);
        e->decisions[e->decision_count++] = d;
        return status;
    }
    return tn_cells_status(world->cells, e->run->error);
}

/* Would what was put last join at a connector where it was decided to put nothing? */
static bool joins_left(const exact *e)
{
    const tn_world *world = &e->run->worlds[0];
    const tn_put *put = &world->plan.puts[world->plan.put_count - 1];
    for (size_t i = 0; i < e->left_count; i++)
        if (tn_choice_may_stand(world->choices, &e->left[i], &world->choices->choices[put->choice], &put->at))
            return true;
    return false;
}

/* Is there no room at the connectors where nothing was put? */
static bool is_complete(exact *e)
{
    tn_world *world = &e->run->worlds[0];
    uint32_t one;
    for (size_t i = 0; i < e->left_count; i++)
        if (!world->choices->symbols[e->left[i].symbol].may_stay_open &&
            tn_world_choices(world, &e->left[i], true, &one, 1) > 0)
            return false;
    return true;
}

static tn_status look_at(exact *e)
{
    tn_place_search_run *run = e->run;
    tn_world *world = &run->worlds[0];
    tn_model_score score;
    if (!is_complete(e)) {
        e->given_up++;
        return TN_OK;
    }
    e->looked_at++;
    tn_status status = tn_score_world(&run->scorers[0], world, &run->best_score, &score, run->error);
    return status == TN_OK ? tn_place_search_keep(run, &world->plan, &score) : status;
}

/* Can what stands still become better than the best? */
static bool may_improve(exact *e)
{
    tn_scorer *scorer = &e->run->scorers[0];
    if (!scorer->rises || e->run->best_score.violation > 0)
        return true;
    return tn_score_value(scorer, &e->run->worlds[0]) < e->run->best_score.value;
}

/* Goes back to a decision. */
static void go_back(exact *e, const decision *d)
{
    tn_world *world = &e->run->worlds[0];
    while (world->plan.put_count > d->puts)
        tn_world_take_last(world);
    if (d->open_count)
        memcpy(world->plan.open, &e->open[d->open_first], d->open_count * sizeof *e->open);
    world->plan.open_first = 0;
    world->plan.open_count = d->open_count;
    e->left_count = d->left;
}

/* Decides otherwise at the last connector; *pursue: that may lead to something. The last way out is to put nothing. */
static tn_status decide(exact *e, bool *pursue)
{
    decision *d = &e->decisions[e->decision_count - 1];
    tn_error *error = e->run->error;
    go_back(e, d);
    *pursue = false;
    if (d->next > d->count) {
        e->fitting_count = d->fitting;
        e->open_count = d->open_first;
        e->decision_count--;
        return TN_OK;
    }
    uint32_t next = d->next++;
    if (next < d->count) {
        tn_status status = tn_world_put(&e->run->worlds[0], e->fitting[d->fitting + next], &d->site.frame, error);
        *pursue = status == TN_OK && !joins_left(e) && may_improve(e);
        e->given_up += !*pursue;
        return status;
    }
    if (!tn_array_reserve(&e->left, &e->left_capacity, e->left_count, 1, sizeof *e->left))
        return tn_fail_memory(error);
    e->left[e->left_count++] = d->site;
    *pursue = true;
    return TN_OK;
}

static tn_status explore(exact *e)
{
    bool pursue = true, none;
    tn_status status = tn_world_start(&e->run->worlds[0], e->run->error);
    while (status == TN_OK && (pursue || e->decision_count > 0)) {
        if (pursue) {
            status = next_decision(e, &none);
            if (status == TN_OK && none)
                status = look_at(e);
            pursue = false;
        } else {
            status = decide(e, &pursue);
        }
        if (status == TN_OK && ++e->steps % ASK_EVERY == 0)
            status = tn_place_search_check(e->run, e->looked_at + e->given_up, (double)e->looked_at, 0);
    }
    e->run->proved = status == TN_OK;
    return status;
}

tn_status tn_place_search_exact(tn_place_search_run *run)
{
    exact e = {.run = run};
    tn_status status = explore(&e);
    run->looked_at = e.looked_at ? e.looked_at : 1; /* the greedy one */
    free(e.decisions);
    free(e.fitting);
    free(e.open);
    free(e.left);
    return status;
}
