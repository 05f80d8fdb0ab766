/* Annealing: a model is changed again and again, and a change is kept unless it is much worse. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/hash_table.h"
#include "runtime/base/random.h"
#include "runtime/place/search/run.h"
#include "runtime/place/search/world.h"

/* A connector of what is put. */
typedef struct hang_socket {
    int32_t at[3];
    uint32_t put; /* its index */
} hang_socket;

typedef struct hanging {
    hang_socket *sockets;
    size_t socket_count, socket_capacity;
    tn_hash_table socket_index; /* by place: several may have one */
    uint32_t *order;
    bool *held;
    size_t capacity;
    tn_open_site *sites; /* of the held ones, in order */
    size_t site_count, site_capacity;
} hanging;

/* ---- goes from the connectors at which the model starts to what stands there, and on from the connectors of that.
 * What has a connector at a place is found by a hash table */

static uint64_t hash_place(const int32_t at[3])
{
    uint64_t hash = tn_mix64((uint64_t)(uint32_t)at[0] << 32 | (uint32_t)at[1]);
    return tn_mix64(hash ^ (uint32_t)at[2]);
}

/* For sockets that are entered: each is new. */
static bool is_none(const void *wanted, uint32_t number)
{
    (void)wanted;
    (void)number;
    return false;
}

static void add_sockets(hanging *h, const tn_site_choices *c, const tn_put *put, uint32_t index)
{
    const tn_module *module = c->rules->module;
    const tn_chosen_part *part = &c->parts[c->choices[put->choice].part_first]; /* that joins where it is put */
    if (put->choice == c->standing)
        return;
    const tn_kit_part_record *record = c->kinds[part->kind].record;
    tn_frame frame = tn_frame_from(&put->at, &part->frame);
    for (uint32_t i = 0; i < record->connector_count; i++) {
        const tn_part_connector_record *from = &module->PART_CONNECTOR_records[record->connector_first + i];
        const tn_frame relative = {.at = {(int32_t)from->x, (int32_t)from->y, (int32_t)from->z}};
        tn_frame at = tn_frame_from(&frame, &relative);
        uint32_t number = (uint32_t)h->socket_count++;
        memcpy(h->sockets[number].at, at.at, sizeof at.at);
        h->sockets[number].put = index;
        (void)tn_hash_enter(&h->socket_index, hash_place(at.at), is_none, NULL, &number, NULL); /* there is room */
    }
}

static bool make_sockets(hanging *h, const tn_site_choices *c, const tn_standing *plan)
{
    size_t count = 0;
    for (size_t i = 0; i < plan->put_count; i++)
        count += c->kinds[c->parts[c->choices[plan->puts[i].choice].part_first].kind].record->connector_count;
    tn_hash_forget(&h->socket_index);
    h->socket_count = 0;
    if (!tn_array_reserve(&h->sockets, &h->socket_capacity, 0, count, sizeof *h->sockets) ||
        tn_hash_reserve(&h->socket_index, count, NULL) != TN_OK)
        return false;
    for (size_t i = 0; i < plan->put_count; i++)
        add_sockets(h, c, &plan->puts[i], (uint32_t)i);
    return true;
}

/* Room for so many puts. */
static bool make_room(hanging *h, size_t puts)
{
    if (puts <= h->capacity)
        return true;
    if (!tn_array_resize(&h->order, puts, sizeof *h->order) || !tn_array_resize(&h->held, puts, sizeof *h->held))
        return false;
    h->capacity = puts;
    return true;
}

static tn_status add_sites(hanging *h, const tn_open_site *sites, size_t count, const tn_frame *base, tn_error *error)
{
    if (!tn_array_reserve(&h->sites, &h->site_capacity, h->site_count, count, sizeof *h->sites))
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++)
        h->sites[h->site_count++] = (tn_open_site){sites[i].symbol, tn_frame_from(base, &sites[i].frame)};
    return TN_OK;
}

typedef struct wanted_put {
    const hanging *hanging;
    const tn_site_choices *choices;
    const tn_standing *plan;
    const tn_open_site *site;
} wanted_put;

static bool may_hold(const void *context, uint32_t number)
{
    const wanted_put *w = context;
    const hang_socket *socket = &w->hanging->sockets[number];
    if (w->hanging->held[socket->put] || memcmp(socket->at, w->site->frame.at, sizeof socket->at) != 0)
        return false;
    const tn_put *put = &w->plan->puts[socket->put];
    return tn_choice_may_stand(w->choices, w->site, &w->choices->choices[put->choice], &put->at);
}

/* The put that stands at a site by its rule, and was not reached before; UINT32_MAX: none. */
static uint32_t find_put(const hanging *h, const tn_site_choices *c, const tn_standing *plan, const tn_open_site *site)
{
    wanted_put wanted = {h, c, plan, site};
    uint32_t number = tn_hash_find(&h->socket_index, hash_place(site->frame.at), may_hold, &wanted);
    return number == TN_HASH_NONE ? UINT32_MAX : h->sockets[number].put;
}

static tn_status reach(hanging *h, const tn_site_choices *c, const tn_standing *plan, size_t *count, tn_error *error)
{
    h->site_count = *count = 0;
    tn_status status =
        add_sites(h, &c->sites[c->start_first], c->site_count - c->start_first, &(tn_frame){.heading = 0}, error);
    if (c->standing != TN_NONE_STANDS) { /* it hangs on nothing, and is the first */
        h->held[0] = true;
        h->order[(*count)++] = 0;
    }
    for (size_t next = 0; next < h->site_count && status == TN_OK; next++) {
        uint32_t index = find_put(h, c, plan, &h->sites[next]);
        if (index == UINT32_MAX)
            continue;
        const tn_put *put = &plan->puts[index];
        const tn_site_choice *choice = &c->choices[put->choice];
        h->held[index] = true;
        h->order[(*count)++] = index;
        status = add_sites(h, &c->sites[choice->site_first], choice->site_count, &put->at, error);
    }
    return status;
}

/* Opens the connectors where something may come that needs cells of the region; all of them where images or a stock
 * have effects elsewhere. */
static tn_status open_near(hanging *h, const tn_site_choices *c, tn_standing *plan, const tn_cell_box *region,
                           tn_error *error)
{
    const tn_kit_model_record *model = c->rules->space;
    bool anywhere = model->symmetry != TN_SYMMETRY_NONE || model->stock_count > 0;
    plan->open_count = 0;
    for (size_t i = 0; i < h->site_count; i++) {
        const tn_open_site *site = &h->sites[i];
        tn_cell_box turned = tn_cell_box_of(c->symbols[site->symbol].around, site->frame.heading);
        tn_cell_box around = tn_box_from(&turned, site->frame.at);
        bool near = c->symbols[site->symbol].count > 0;
        for (int k = 0; k < 3 && near && !anywhere; k++)
            near = around.low[k] < region->high[k] && region->low[k] < around.high[k];
        if (!near)
            continue;
        if (!tn_array_reserve(&plan->open, &plan->open_capacity, plan->open_count, 1, sizeof *plan->open))
            return tn_fail_memory(error);
        plan->open[plan->open_count++] = *site;
    }
    return TN_OK;
}

/* Keeps those puts of the plan that are held, each behind one that it hangs on, and opens the connectors that are near
 * the region: what was taken away lay there. The region grows by what falls. */
static tn_status hang_keep(hanging *h, const tn_site_choices *c, tn_standing *plan, tn_cell_box *region,
                           tn_error *error)
{
    size_t count, old = plan->put_count;
    if (!make_sockets(h, c, plan) || !make_room(h, old + 1))
        return tn_fail_memory(error);
    memset(h->held, 0, (old + 1) * sizeof *h->held);
    tn_status status = reach(h, c, plan, &count, error);
    if (status != TN_OK)
        return status;
    for (size_t i = 0; i < old; i++) {
        tn_cell_box turned = tn_cell_box_of(c->choices[plan->puts[i].choice].around, plan->puts[i].at.heading);
        tn_cell_box box = tn_box_from(&turned, plan->puts[i].at.at);
        if (!h->held[i])
            tn_cell_box_widen(region, &box);
    }
    if (!tn_array_reserve(&plan->puts, &plan->put_capacity, old, count, sizeof *plan->puts))
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++)
        plan->puts[old + i] = plan->puts[h->order[i]];
    memmove(plan->puts, &plan->puts[old], count * sizeof *plan->puts);
    plan->put_count = count;
    return open_near(h, c, plan, region, error);
}

static void hang_clear(hanging *h)
{
    free(h->sockets);
    tn_hash_clear(&h->socket_index);
    free(h->order);
    free(h->held);
    free(h->sites);
    *h = (hanging){0};
}

/* ---- Annealing: again and again some neighbouring parts are taken away, with all that hangs on them alone, and the
 * model is grown again there, at random. The new model is kept unless it is worse than the one of some rounds before
 * (late acceptance hill climbing: Burke and Bykov, 2017), so that no temperature has to be found. A few chains go their
 * ways at once, each with random numbers of its own; their number does not depend on that of the threads */

enum { CHAINS = 4, HISTORY = 64, PIECE = 256, FITTING_MAX = 1024 };

typedef struct chain {
    tn_standing plan, kept, best; /* plan: what is tried; kept: what is gone on from */
    hanging hang;
    tn_model_score score, best_score;
    tn_model_score history[HISTORY];
    uint64_t stream, drawn, round;
    bool begun;
} chain;

typedef struct annealing {
    tn_place_search_run *run;
    chain chains[CHAINS];
    uint64_t until; /* the round to stop at, for now */
} annealing;

/* A number below `below`. */
static uint64_t draw(chain *c, const tn_world *world, uint64_t below)
{
    return tn_random64(world->seed, c->stream, c->drawn++) % below;
}

static tn_cell_box box_of(const tn_site_choices *choices, const tn_put *put)
{
    tn_cell_box turned = tn_cell_box_of(choices->choices[put->choice].around, put->at.heading);
    return tn_box_from(&turned, put->at.at);
}

static bool meet(const tn_cell_box *a, const tn_cell_box *b)
{
    for (int k = 0; k < 3; k++)
        if (a->low[k] >= b->high[k] || b->low[k] >= a->high[k])
            return false;
    return true;
}

/* The cells of a random part of what stands from the start on. */
static tn_cell_box standing_box(chain *c, const tn_world *world)
{
    const tn_site_choices *all = world->choices;
    const tn_site_choice *choice = &all->choices[all->standing];
    const tn_chosen_part *part = &all->parts[choice->part_first + draw(c, world, choice->part_count)];
    tn_cell_box turned = tn_kind_all(&all->kinds[part->kind], part->frame.heading);
    return tn_box_from(&turned, part->frame.at);
}

/* A box about a random part: its own cells, and those beside it as far as a random number says. Now and then also those
 * above and below. What is beside and what is above is seen from the first connector of the start, so that a world that
 * is turned gives the same model turned. */
static tn_cell_box choose_region(chain *c, const tn_world *world)
{
    const tn_put *put = &c->kept.puts[draw(c, world, c->kept.put_count)];
    tn_cell_box region = put->choice == world->choices->standing ? standing_box(c, world) : box_of(world->choices, put);
    const tn_site_choices *all = world->choices;
    const uint32_t seen_from = all->start_first < all->site_count ? all->sites[all->start_first].frame.heading : 0;
    int32_t beyond[3];
    beyond[0] = (int32_t)(1 + draw(c, world, 6));
    beyond[2] = (int32_t)(1 + draw(c, world, 6));
    beyond[1] = draw(c, world, 4) == 0;
    tn_turn_place(seen_from, beyond, beyond);
    for (int k = 0; k < 3; k++) {
        region.low[k] -= abs(beyond[k]);
        region.high[k] += abs(beyond[k]);
    }
    return region;
}

/* The plan without what lies in the region, and without what hangs on nothing then. */
static tn_status take_away(chain *c, const tn_world *world, tn_cell_box *region, tn_error *error)
{
    c->plan.put_count = 0;
    if (!tn_array_reserve(&c->plan.puts, &c->plan.put_capacity, 0, c->kept.put_count, sizeof *c->plan.puts))
        return tn_fail_memory(error);
    tn_cell_box taken = *region;
    for (size_t i = 0; i < c->kept.put_count; i++) {
        tn_cell_box box = box_of(world->choices, &c->kept.puts[i]);
        if (c->kept.puts[i].choice == world->choices->standing || !meet(&box, region))
            c->plan.puts[c->plan.put_count++] = c->kept.puts[i];
        else
            tn_cell_box_widen(&taken, &box);
    }
    *region = taken;
    return hang_keep(&c->hang, world->choices, &c->plan, region, error);
}

/* One of what fits at a site: mostly of the first alternative that does, in a random position. */
static uint32_t choose(chain *c, const tn_world *world, const uint32_t *fitting, size_t count)
{
    const tn_site_choice *choices = world->choices->choices;
    if (draw(c, world, 4) == 0)
        return fitting[draw(c, world, count)];
    size_t alike = 1;
    while (alike < count && choices[fitting[alike]].body == choices[fitting[0]].body)
        alike++;
    return fitting[draw(c, world, alike)];
}

/* Puts something at random open connectors until nothing fits at any. */
static tn_status grow_again(chain *c, tn_world *world, tn_error *error)
{
    uint32_t fitting[FITTING_MAX];
    tn_standing *plan = &world->plan;
    tn_status status = TN_OK;
    while (plan->open_count > 0 && status == TN_OK) {
        size_t i = (size_t)draw(c, world, plan->open_count);
        tn_open_site site = plan->open[i];
        plan->open[i] = plan->open[--plan->open_count];
        size_t count = tn_world_choices(world, &site, false, fitting, FITTING_MAX);
        if (count == 0 || (world->choices->symbols[site.symbol].may_stay_open && draw(c, world, count + 1) == count))
            continue;
        status = tn_world_put(world, choose(c, world, fitting, count), &site.frame, error);
    }
    return status == TN_OK ? tn_cells_status(world->cells, error) : status;
}

static tn_status begin_chain(annealing *a, chain *c, tn_error *error)
{
    c->begun = true;
    c->score = c->best_score = a->run->best_score;
    for (size_t i = 0; i < HISTORY; i++)
        c->history[i] = c->score;
    tn_status status = tn_standing_copy(&c->kept, &a->run->best, error);
    return status == TN_OK ? tn_standing_copy(&c->best, &c->kept, error) : status;
}

/* Goes on from the new model, or stays with the old one. */
static tn_status settle(chain *c, const tn_world *world, const tn_model_score *score, tn_error *error)
{
    tn_model_score *before = &c->history[c->round % HISTORY];
    tn_status status = TN_OK;
    if (tn_score_compare(score, before) <= 0 || tn_score_compare(score, &c->score) <= 0) {
        status = tn_standing_copy(&c->kept, &world->plan, error);
        c->score = *score;
    }
    if (status == TN_OK && tn_score_compare(score, &c->best_score) < 0) {
        status = tn_standing_copy(&c->best, &world->plan, error);
        c->best_score = *score;
    }
    if (tn_score_compare(&c->score, before) < 0)
        *before = c->score;
    return status;
}

static tn_status run_round(annealing *a, chain *c, unsigned thread, tn_error *error)
{
    tn_world *world = &a->run->worlds[thread];
    const tn_model_score *before = &c->history[c->round % HISTORY];
    const tn_model_score bar = tn_score_compare(before, &c->score) > 0 ? *before : c->score;
    tn_model_score score;
    tn_cell_box region = choose_region(c, world);
    c->plan.draws = tn_random64(world->seed, c->stream, c->drawn++);
    tn_status status = take_away(c, world, &region, error);
    if (status == TN_OK)
        status = tn_world_load(world, &c->plan, error);
    if (status == TN_OK)
        status = grow_again(c, world, error);
    if (status == TN_OK)
        status = tn_score_world(&a->run->scorers[thread], world, &bar, &score, error);
    if (status == TN_OK)
        status = settle(c, world, &score, error);
    c->round++;
    return status;
}

static tn_status run_chain(void *context, unsigned thread, size_t item, tn_error *error)
{
    annealing *a = context;
    chain *c = &a->chains[item];
    tn_status status = c->begun ? TN_OK : begin_chain(a, c, error);
    while (status == TN_OK && c->round < a->until && c->kept.put_count > 0)
        status = run_round(a, c, thread, error);
    return status;
}

/* The best of all chains; of equals that of the first. */
static tn_status collect(annealing *a)
{
    tn_status status = TN_OK;
    for (size_t i = 0; i < CHAINS && status == TN_OK; i++)
        if (a->chains[i].begun)
            status = tn_place_search_keep(a->run, &a->chains[i].best, &a->chains[i].best_score);
    return status;
}

tn_status tn_place_search_anneal(tn_place_search_run *run)
{
    annealing a = {.run = run};
    uint64_t rounds = run->model->search_amount;
    tn_status status = TN_OK;
    for (size_t i = 0; i < CHAINS; i++)
        a.chains[i].stream = i + 1;
    while (status == TN_OK && a.until < rounds) {
        a.until = rounds - a.until < PIECE ? rounds : a.until + PIECE;
        status = tn_place_search_check(run, CHAINS * a.until, (double)a.until, (double)rounds);
        if (status == TN_OK)
            status = tn_crew_run(run->crew, CHAINS, 1, run_chain, &a, run->error);
        tn_status collected = status == TN_OK || status == TN_STOPPED ? collect(&a) : status;
        status = status == TN_OK ? collected : status;
    }
    for (size_t i = 0; i < CHAINS; i++) {
        tn_standing_clear(&a.chains[i].plan);
        tn_standing_clear(&a.chains[i].kept);
        tn_standing_clear(&a.chains[i].best);
        hang_clear(&a.chains[i].hang);
    }
    return status;
}
