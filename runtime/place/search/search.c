/* Makes a search ready, runs it, and gives the model that it found: by a beam, or by looking at every model. */
#include "runtime/place/search/search.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/random.h"
#include "runtime/place/search/run.h"

/* ==== A beam: at each step every plan that is kept is gone on with by each choice that fits at its next open
 * connector. Each of these is completed by first choices and scored as it then is; the best go on. The plan of first
 * choices is always kept, so that a beam of width 1 is greedy, and a wider one is never worse than greedy */

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

static tn_status place_search_beam(tn_place_search_run *run)
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

/* ==== looks at every model that the rules allow, each once: at each open connector everything that fits, and also
 * nothing. Where nothing is put though something fits, it has to be in the way of all of that in the end, and nothing
 * that comes later may join there: that model is looked at where it is put here. Where the objective never falls as
 * parts are added, plans that have reached the best are not gone on with */

enum { ASK_EVERY = 256 };

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

static tn_status place_search_exact(tn_place_search_run *run)
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

/* ==== makes a search ready, runs it, and gives the model that it found */

tn_status tn_place_search_keep(tn_place_search_run *run, const tn_standing *plan, const tn_model_score *score)
{
    if (run->has_best && tn_score_compare(score, &run->best_score) >= 0)
        return TN_OK;
    run->has_best = true;
    run->best_score = *score;
    return tn_standing_copy(&run->best, plan, run->error);
}

tn_status tn_place_search_check(tn_place_search_run *run, uint64_t looked_at, double done, double total)
{
    run->looked_at = looked_at;
    tn_watch_tell(run->options->watch, done, total);
    if (looked_at > run->model_limit) {
        tn_fail(run->error, TN_LIMIT, E_PLACE_LIMIT, "the search passes the limit of %llu models looked at",
                (unsigned long long)run->model_limit);
        tn_error_help(run->error, "raise the limit with --search-limit, or ask for a smaller search");
        return TN_LIMIT;
    }
    return tn_watch_check(run->options->watch, run->error);
}

/* The first choice that fits, at every connector. */
static tn_status search_greedy(tn_place_search_run *run)
{
    tn_model_score score;
    tn_status status = tn_world_start(&run->worlds[0], run->error);
    if (status == TN_OK)
        status = tn_world_grow(&run->worlds[0], run->error);
    if (status == TN_OK)
        status = tn_score_world(&run->scorers[0], &run->worlds[0], NULL, &score, run->error);
    run->looked_at = 1;
    return status == TN_OK ? tn_place_search_keep(run, &run->worlds[0].plan, &score) : status;
}

static tn_status make_worlds(tn_place_search_run *run)
{
    unsigned threads = tn_crew_threads(run->crew);
    tn_watch *watch = run->options->watch;
    tn_space *space;
    uint64_t inside = 0;
    run->worlds = calloc(threads, sizeof *run->worlds);
    run->scorers = calloc(threads, sizeof *run->scorers);
    if (!run->worlds || !run->scorers)
        return tn_fail_memory(run->error);
    tn_status status = tn_space_new(run->choices->rules, &space, run->error);
    if (status == TN_OK)
        status = tn_space_count(space, watch, &inside, run->error);
    tn_space_free(space);
    for (unsigned i = 0; i < threads && status == TN_OK; i++) {
        status = tn_world_make(run->choices, run->options, &run->worlds[i], run->error);
        if (status == TN_OK)
            status = tn_scorer_make(run->choices, inside, watch, &run->scorers[i], run->error);
    }
    return status;
}

static void clear(tn_place_search_run *run)
{
    for (unsigned i = 0; run->crew && i < tn_crew_threads(run->crew); i++) {
        if (run->worlds)
            tn_world_clear(&run->worlds[i]);
        if (run->scorers)
            tn_scorer_clear(&run->scorers[i]);
    }
    free(run->worlds);
    free(run->scorers);
    tn_standing_clear(&run->best);
    tn_crew_free(run->crew);
}

/* Symmetry has to find images of all parts that are placed. */
static tn_status check_images(const tn_site_choices *choices, tn_error *error)
{
    uint32_t symmetry = choices->rules->space->symmetry;
    for (size_t i = 0; i < choices->part_count && symmetry >= TN_SYMMETRY_MIRROR_X; i++) {
        const tn_kind_of_part *kind = &choices->kinds[choices->parts[i].kind];
        if (kind->mirrored[symmetry == TN_SYMMETRY_MIRROR_Z] < TN_TURNS)
            continue;
        tn_fail(error, TN_INVALID, E_KIT_SEARCH, "part %.100s is not its own mirror image, however it is turned",
                tn_text(choices->rules->module, kind->record->name));
        tn_error_help(error, "leave it out of the model's rules, or ask for `symmetry turn 2`");
        return TN_INVALID;
    }
    return TN_OK;
}

static void take_stock(const tn_site_choices *choices)
{
    const tn_module *module = choices->rules->module;
    const tn_kit_model_record *model = choices->rules->space;
    for (uint32_t i = 0; i < model->stock_count; i++) {
        const tn_kit_stock_record *stock = &module->KIT_STOCK_records[model->stock_first + i];
        choices->kinds[stock->part].most = stock->most;
    }
}

static tn_status run_search(tn_place_search_run *run)
{
    static tn_status (*const searches[TN_SEARCH_COUNT])(tn_place_search_run *) = {
        [TN_SEARCH_BEAM] = place_search_beam,
        [TN_SEARCH_ANNEAL] = tn_place_search_anneal,
        [TN_SEARCH_EXACT] = place_search_exact,
    };
    run->crew = tn_crew_new(run->options->threads, run->options->watch);
    tn_status status = run->crew ? make_worlds(run) : tn_fail_memory(run->error);
    if (status == TN_OK)
        status = search_greedy(run); /* there is always something to show */
    if (status != TN_OK || !searches[run->model->search])
        return status;
    tn_standing none = {0};
    status = tn_world_load(&run->worlds[0], &none, run->error);
    return status == TN_OK ? searches[run->model->search](run) : status;
}

tn_status tn_place_search(const tn_place_rules *rules, const tn_place_options *options, tn_placed_model *model,
                          tn_error *error)
{
    tn_site_choices choices;
    tn_error ignored;
    *model = (tn_placed_model){0};
    tn_status status = tn_site_choices_make(rules, &choices, error);
    if (status == TN_OK)
        status = check_images(&choices, error);
    if (status == TN_OK) {
        tn_place_search_run run = {.choices = &choices,
                                   .model = rules->space,
                                   .options = options,
                                   .model_limit = options->search_limit ? options->search_limit : 10000000,
                                   .error = error};
        take_stock(&choices);
        status = run_search(&run);
        tn_status made = status;
        if (run.has_best && (status == TN_OK || status == TN_LIMIT || status == TN_STOPPED))
            made = tn_standing_model(&choices, &run.best, model, status == TN_OK ? error : &ignored);
        status = status == TN_OK ? made : status;
        model->counts = (tn_place_counts){.parts = model->count, .looked_at = run.looked_at, .proved = run.proved};
        clear(&run);
    }
    tn_site_choices_clear(&choices);
    return status;
}

/* ---- with and without a search */

static tn_status fail_nothing(const tn_place_rules *rules, tn_error *error)
{
    tn_fail(error, TN_INVALID, E_PLACE_NOTHING, "%s comes to its end without placing a part",
            rules->space ? "the model" : "the grammar");
    tn_error_help(error, "%s%s",
                  rules->space ? "a part needs room inside of the space where the model starts"
                               : "a part is placed by 'Place(3001)'",
                  tn_place_needs_search(rules) ? "" : "; --trace shows which alternatives did not fit");
    return TN_INVALID;
}

tn_status tn_place_run(const tn_place_rules *rules, const tn_place_options *options, tn_placed_model *model,
                       tn_place_fault *fault, tn_error *error)
{
    *fault = (tn_place_fault){0};
    tn_status status = tn_place_needs_search(rules) ? tn_place_search(rules, options, model, error)
                                                    : tn_place_derive(rules, options, model, fault, error);
    return status == TN_OK && model->count == 0 ? fail_nothing(rules, error) : status;
}
