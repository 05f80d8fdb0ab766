/* A beam: at each step every plan that is kept is gone on with by each choice that fits at its next open connector.
 * Each of these is completed by first choices and scored as it then is; the best go on. The plan of first choices is
 * always kept, so that a beam of width 1 is greedy, and a wider one is never worse than greedy. */
#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/base/random.h"
#include "runtime/place/search/run.h"

enum { FITTING_MAX = 4096 };

/* A plan gone on with by one choice. */
typedef struct branch {
    uint32_t plan; /* among those kept */
    uint32_t choice;
    tn_open_site site;
    tn_model_score score;
    uint64_t key; /* of what stands: equal ones are kept once */
} branch;

typedef struct beam {
    tn_place_search_run *run;
    tn_standing *plans, *next; /* the kept ones, and those kept next: `width` of each */
    size_t width, count;
    bool first; /* the first of them is that of first choices */
    branch *branches;
    size_t branch_count, branch_capacity;
    uint64_t looked_at;
} beam;

/* The next open connector of a plan where something fits, and what does: the branches of the plan. */
static tn_status list_branches(beam *b, uint32_t plan)
{
    tn_place_search_run *run = b->run;
    tn_world *world = &run->worlds[0];
    uint32_t fitting[FITTING_MAX];
    tn_status status = tn_world_load(world, &b->plans[plan], run->error);
    while (status == TN_OK && world->plan.open_count > 0) {
        tn_open_site site = tn_world_next(world);
        size_t count = tn_world_choices(world, &site, false, fitting, b->width == 1 ? 1 : FITTING_MAX);
        if (count == 0)
            continue;
        if (!tn_array_reserve(&b->branches, &b->branch_capacity, b->branch_count, count, sizeof *b->branches))
            return tn_fail_memory(run->error);
        for (size_t i = 0; i < count; i++)
            b->branches[b->branch_count++] = (branch){.plan = plan, .choice = fitting[i], .site = site};
        break;
    }
    if (status == TN_OK)
        status = tn_cells_status(world->cells, run->error);
    return status == TN_OK ? tn_standing_copy(&b->plans[plan], &world->plan, run->error) : status;
}

static uint64_t key_of(const tn_world *world)
{
    static const int32_t origin[3] = {0};
    uint64_t key = 0;
    for (size_t i = 0; i < world->plan.put_count; i++) {
        const tn_put *put = &world->plan.puts[i];
        key += tn_choice_key(world->choices, &world->choices->choices[put->choice], &put->at, origin);
    }
    return key;
}

/* Takes a branch, completes it, and scores what stands then. */
static tn_status try_branch(void *context, unsigned thread, size_t item, tn_error *error)
{
    beam *b = context;
    branch *one = &b->branches[item];
    tn_world *world = &b->run->worlds[thread];
    tn_status status = tn_world_load(world, &b->plans[one->plan], error);
    if (status == TN_OK)
        status = tn_world_put(world, one->choice, &one->site.frame, error);
    if (status != TN_OK)
        return status;
    one->key = key_of(world);
    status = tn_world_grow(world, error);
    return status == TN_OK ? tn_score_world(&b->run->scorers[thread], world, NULL, &one->score, error) : status;
}

/* Best first; of equals the one that was listed first. */
static int by_score(const void *a, const void *b)
{
    const branch *one = a, *other = b;
    int order = tn_score_compare(&one->score, &other->score);
    if (order == 0)
        order = (one->plan > other->plan) - (one->plan < other->plan);
    return order ? order : (one->choice > other->choice) - (one->choice < other->choice);
}

static bool is_kept(const branch *kept, size_t count, uint64_t key)
{
    for (size_t i = 0; i < count; i++)
        if (kept[i].key == key)
            return true;
    return false;
}

/* Puts the branches that go on first: that of first choices while there is one, then the best that differ. */
static size_t choose_branches(beam *b)
{
    size_t kept = b->first && b->branch_count > 0;
    if (b->branch_count == 0)
        return 0;
    qsort(b->branches + kept, b->branch_count - kept, sizeof *b->branches, by_score);
    for (size_t i = kept; i < b->branch_count && kept < b->width; i++) {
        branch one = b->branches[i];
        if (!is_kept(b->branches, kept, one.key))
            b->branches[kept++] = one;
    }
    return kept;
}

/* The model that a branch leads to. */
static tn_status keep_best(beam *b, const branch *one)
{
    tn_place_search_run *run = b->run;
    if (run->has_best && tn_score_compare(&one->score, &run->best_score) >= 0)
        return TN_OK;
    tn_world *world = &run->worlds[0];
    tn_status status = tn_world_load(world, &b->plans[one->plan], run->error);
    if (status == TN_OK)
        status = tn_world_put(world, one->choice, &one->site.frame, run->error);
    if (status == TN_OK)
        status = tn_world_grow(world, run->error);
    return status == TN_OK ? tn_place_search_keep(run, &world->plan, &one->score) : status;
}

static tn_status go_on(beam *b)
{
    tn_place_search_run *run = b->run;
    tn_world *world = &run->worlds[0];
    size_t kept = choose_branches(b);
    tn_status status = TN_OK;
    for (size_t i = 0; i < kept && status == TN_OK; i++) {
        const branch *one = &b->branches[i];
        status = tn_world_load(world, &b->plans[one->plan], run->error);
        if (status == TN_OK)
            status = tn_world_put(world, one->choice, &one->site.frame, run->error);
        if (status == TN_OK)
            status = tn_standing_copy(&b->next[i], &world->plan, run->error);
    }
    tn_standing *plans = b->plans;
    b->plans = b->next;
    b->next = plans;
    b->count = kept;
    return status;
}

/* One step of all plans. */
static tn_status step(beam *b)
{
    tn_place_search_run *run = b->run;
    tn_status status = TN_OK;
    b->branch_count = 0;
    for (uint32_t i = 0; i < b->count && status == TN_OK; i++) {
        status = list_branches(b, i);
        b->first &= i > 0 || b->branch_count > 0;
    }
    if (status == TN_OK)
        status = tn_place_search_check(run, b->looked_at += b->branch_count, (double)b->plans[0].put_count, 0);
    if (status == TN_OK)
        status = tn_crew_run(run->crew, b->branch_count, 1, try_branch, b, run->error);
    for (size_t i = 0; i < b->branch_count && status == TN_OK; i++)
        status = keep_best(b, &b->branches[i]);
    return status == TN_OK ? go_on(b) : status;
}

tn_status tn_place_search_beam(tn_place_search_run *run)
{
    beam b = {.run = run, .width = run->model->search_amount, .count = 1, .first = true};
    b.plans = calloc(b.width, sizeof *b.plans);
    b.next = calloc(b.width, sizeof *b.next);
    tn_status status = b.plans && b.next ? tn_world_start(&run->worlds[0], run->error) : tn_fail_memory(run->error);
    if (status == TN_OK)
        status = tn_standing_copy(&b.plans[0], &run->worlds[0].plan, run->error);
    while (status == TN_OK && b.count > 0)
        status = step(&b);
    for (size_t i = 0; i < b.width; i++) {
        if (b.plans)
            tn_standing_clear(&b.plans[i]);
        if (b.next)
            tn_standing_clear(&b.next[i]);
    }
    free(b.plans);
    free(b.next);
    free(b.branches);
    return status;
}
