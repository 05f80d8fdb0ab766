/* Puts choices and takes them away again. */
#include "runtime/place/search/world.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/random.h"
#include "runtime/place/search/choices.h"

enum { DRAWN_MAX = 64, PARTS_MAX = 1000000 };

tn_status tn_world_make(const tn_site_choices *choices, const tn_place_options *options, tn_world *world,
                        tn_error *error)
{
    *world = (tn_world){
        .choices = choices, .seed = options->seed, .part_limit = options->part_limit ? options->part_limit : PARTS_MAX};
    world->cells = tn_cells_new(options->watch);
    world->used = calloc((size_t)choices->kind_count + 1, sizeof *world->used);
    if (!world->cells || !world->used)
        return tn_fail_memory(error);
    tn_status status = tn_space_new(choices->rules, &world->space, error);
    if (status == TN_OK)
        tn_cells_bound(world->cells, tn_space_cells(world->space));
    return status;
}

void tn_world_clear(tn_world *world)
{
    tn_cells_free(world->cells);
    tn_space_free(world->space);
    free(world->used);
    tn_standing_clear(&world->plan);
    *world = (tn_world){0};
}

/* ---- images */

static tn_frame turned(const tn_frame *frame, uint32_t turns)
{
    return tn_frame_from(&(tn_frame){.heading = turns}, frame);
}

static bool looks_the_same(const tn_kind_of_part *kind, const tn_frame *a, const tn_frame *b)
{
    const tn_cell_box one = tn_kind_all(kind, a->heading), other = tn_kind_all(kind, b->heading);
    for (int k = 0; k < 3; k++)
        if (a->at[k] + one.low[k] != b->at[k] + other.low[k])
            return false;
    return kind->shape[a->heading] == kind->shape[b->heading];
}

size_t tn_part_images(const tn_site_choices *choices, uint32_t kind, const tn_frame *frame,
                      tn_frame images[TN_IMAGES_MAX])
{
    const tn_kind_of_part *k = &choices->kinds[kind];
    uint32_t symmetry = choices->rules->space->symmetry;
    size_t count = 1;
    images[0] = *frame;
    if (symmetry == TN_SYMMETRY_NONE)
        return 1;
    uint32_t images_wanted = symmetry == TN_SYMMETRY_TURN_4 ? 4 : 2;
    for (uint32_t i = 1; i < images_wanted; i++) {
        tn_frame image = symmetry == TN_SYMMETRY_TURN_4   ? turned(frame, i)
                         : symmetry == TN_SYMMETRY_TURN_2 ? turned(frame, 2)
                                                          : tn_kind_mirror(k, frame, symmetry == TN_SYMMETRY_MIRROR_Z);
        bool known = false;
        for (size_t j = 0; j < count; j++)
            known |= looks_the_same(k, &images[j], &image);
        if (!known)
            images[count++] = image;
    }
    return count;
}

/* ---- room */

static bool boxes_free(tn_world *world, const tn_kind_of_part *kind, const tn_frame *frame)
{
    for (uint32_t b = 0; b < kind->record->box_count; b++) {
        tn_cell_box turned = tn_kind_box(kind, frame->heading, b), box = tn_box_from(&turned, frame->at);
        if (tn_cells_any(world->cells, &box))
            return false;
    }
    return true;
}

/* Do the boxes of a kind at two frames share a cell? */
static bool overlap(const tn_kind_of_part *kind, const tn_frame *a, const tn_kind_of_part *other, const tn_frame *b)
{
    for (uint32_t i = 0; i < kind->record->box_count; i++) {
        tn_cell_box turned = tn_kind_box(kind, a->heading, i), one = tn_box_from(&turned, a->at);
        for (uint32_t j = 0; j < other->record->box_count; j++) {
            tn_cell_box second = tn_kind_box(other, b->heading, j), two = tn_box_from(&second, b->at);
            bool apart = false;
            for (int k = 0; k < 3; k++)
                apart |= one.low[k] >= two.high[k] || two.low[k] >= one.high[k];
            if (!apart)
                return true;
        }
    }
    return false;
}

/* Parts and their images may not stand in each other's way. */
static bool images_apart(const tn_site_choices *c, const tn_site_choice *choice, const tn_frame *at)
{
    tn_frame images[TN_IMAGES_MAX], others[TN_IMAGES_MAX];
    for (uint32_t i = 0; i < choice->part_count; i++) {
        const tn_chosen_part *part = &c->parts[choice->part_first + i];
        tn_frame frame = tn_frame_from(at, &part->frame);
        size_t count = tn_part_images(c, part->kind, &frame, images);
        for (uint32_t j = 0; j <= i; j++) {
            const tn_chosen_part *other = &c->parts[choice->part_first + j];
            tn_frame second = tn_frame_from(at, &other->frame);
            size_t other_count = tn_part_images(c, other->kind, &second, others);
            for (size_t a = 0; a < count; a++)
                for (size_t b = j == i ? a + 1 : 0; b < other_count; b++)
                    if (overlap(&c->kinds[part->kind], &images[a], &c->kinds[other->kind], &others[b]))
                        return false;
        }
    }
    return true;
}

/* A choice asks for several parts of a kind: they are counted as if they stood. */
static bool stock_has(tn_world *world, const tn_site_choice *choice, const tn_frame *at)
{
    const tn_site_choices *c = world->choices;
    tn_frame images[TN_IMAGES_MAX];
    bool enough = true;
    for (uint32_t i = 0; i < choice->part_count; i++) {
        const tn_chosen_part *part = &c->parts[choice->part_first + i];
        tn_frame frame = tn_frame_from(at, &part->frame);
        world->used[part->kind] += tn_part_images(c, part->kind, &frame, images);
        enough &= world->used[part->kind] <= c->kinds[part->kind].most;
    }
    for (uint32_t i = 0; i < choice->part_count; i++) {
        const tn_chosen_part *part = &c->parts[choice->part_first + i];
        tn_frame frame = tn_frame_from(at, &part->frame);
        world->used[part->kind] -= tn_part_images(c, part->kind, &frame, images);
    }
    return enough;
}

bool tn_world_fits(tn_world *world, uint32_t index, const tn_frame *at)
{
    const tn_site_choices *c = world->choices;
    const tn_site_choice *choice = &c->choices[index];
    bool alone = c->rules->space->symmetry == TN_SYMMETRY_NONE;
    tn_frame images[TN_IMAGES_MAX];
    for (uint32_t i = 0; i < choice->part_count; i++) {
        const tn_chosen_part *part = &c->parts[choice->part_first + i];
        tn_frame frame = tn_frame_from(at, &part->frame);
        size_t count = tn_part_images(c, part->kind, &frame, images);
        for (size_t k = 0; k < count; k++)
            if (!boxes_free(world, &c->kinds[part->kind], &images[k]))
                return false;
    }
    return (alone || images_apart(c, choice, at)) &&
           (c->rules->space->stock_count == 0 || stock_has(world, choice, at));
}

/* ---- choosing */

/* Of the members of a draw that fit, each by its first choice that does, one by weight: keyed by the seed and by how
 * many were drawn before, as deriving does it (grow.c). */
static size_t draw(tn_world *world, const tn_open_site *site, size_t *next, size_t end, uint32_t *drawn)
{
    const tn_site_choice *all = world->choices->choices;
    uint32_t fits[DRAWN_MAX], count = 0, taken = 0, before = 0;
    double share[DRAWN_MAX];
    for (; *next < end && all[*next].member > 0 && all[*next].member >= before; ++*next) {
        before = all[*next].member;
        if (before == taken || count == DRAWN_MAX || !tn_world_fits(world, (uint32_t)*next, &site->frame))
            continue;
        taken = before;
        share[count] = all[*next].weight + (count ? share[count - 1] : 0);
        fits[count++] = (uint32_t)*next;
    }
    if (count == 0)
        return 0;
    double u = (double)(tn_random64(world->seed, 0, world->plan.draws) >> 11) * 0x1p-53;
    uint32_t chosen = 0;
    while (chosen + 1 < count && !(share[chosen] > u * share[count - 1]))
        chosen++;
    *drawn = fits[chosen];
    return 1;
}

size_t tn_world_choices(tn_world *world, const tn_open_site *site, bool all, uint32_t *fitting, size_t most)
{
    const tn_choice_symbol *symbol = &world->choices->symbols[site->symbol];
    const tn_site_choice *choices = world->choices->choices;
    tn_cell_box turned = tn_cell_box_of(symbol->common, site->frame.heading);
    tn_cell_box common = tn_box_from(&turned, site->frame.at);
    size_t count = 0, end = symbol->first + (size_t)symbol->count;
    if (tn_cells_any(world->cells, &common))
        return 0;
    for (size_t next = symbol->first; next < end && count < most;) {
        if (choices[next].member > 0 && !all) {
            count += draw(world, site, &next, end, &fitting[count]);
            continue;
        }
        if (tn_world_fits(world, (uint32_t)next, &site->frame))
            fitting[count++] = (uint32_t)next;
        next++;
    }
    return count;
}

/* ---- putting and taking away */

static bool in_breadth(const tn_world *world)
{
    return world->choices->rules->space->flags & TN_KIT_BREADTH;
}

tn_open_site tn_world_next(tn_world *world)
{
    tn_standing *plan = &world->plan;
    plan->open_count--;
    return in_breadth(world) ? plan->open[plan->open_first++] : plan->open[plan->open_count];
}

/* Room for more open connectors behind those there are. Those of a queue go to the front once the room there is as long
 * as they: each is moved for one that was taken. */
static bool make_room(tn_standing *plan, size_t more)
{
    if (plan->open_first > plan->open_count) {
        memmove(plan->open, plan->open + plan->open_first, plan->open_count * sizeof *plan->open);
        plan->open_first = 0;
    }
    return tn_array_reserve(&plan->open, &plan->open_capacity, plan->open_first + plan->open_count, more,
                            sizeof *plan->open);
}

/* The first of them comes first: in breadth behind all that are open, else before them. */
static tn_status open_sites(tn_world *world, const tn_open_site *sites, size_t count, const tn_frame *base,
                            tn_error *error)
{
    tn_standing *plan = &world->plan;
    if (!make_room(plan, count))
        return tn_fail_memory(error);
    tn_open_site *to = &plan->open[plan->open_first + plan->open_count];
    for (size_t i = 0; i < count; i++) {
        const tn_open_site *from = &sites[in_breadth(world) ? i : count - 1 - i];
        to[i] = (tn_open_site){from->symbol, tn_frame_from(base, &from->frame)};
    }
    plan->open_count += count;
    return TN_OK;
}

/* Fills the cells of what is put, or empties them. */
static tn_status change_cells(tn_world *world, const tn_put *put, bool fill, tn_error *error)
{
    const tn_site_choices *c = world->choices;
    const tn_site_choice *choice = &c->choices[put->choice];
    tn_frame images[TN_IMAGES_MAX];
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < choice->part_count; i++) {
        const tn_chosen_part *part = &c->parts[choice->part_first + i];
        const tn_kind_of_part *kind = &c->kinds[part->kind];
        tn_frame frame = tn_frame_from(&put->at, &part->frame);
        size_t count = tn_part_images(c, part->kind, &frame, images);
        world->used[part->kind] += fill ? count : -count;
        world->part_count += fill ? count : -count;
        for (size_t k = 0; k < count * kind->record->box_count && status == TN_OK; k++) {
            const tn_frame *image = &images[k / kind->record->box_count];
            tn_cell_box turned = tn_kind_box(kind, image->heading, (uint32_t)(k % kind->record->box_count));
            tn_cell_box box = tn_box_from(&turned, image->at);
            if (fill && put->choice == c->standing)
                world->stands_over |= tn_cells_any(world->cells, &box);
            if (fill)
                status = tn_cells_fill(world->cells, &box, error);
            else
                tn_cells_empty(world->cells, &box);
        }
    }
    return status;
}

static tn_status stand(tn_world *world, const tn_put *put, tn_error *error)
{
    tn_standing *plan = &world->plan;
    if (!tn_array_reserve(&plan->puts, &plan->put_capacity, plan->put_count, 1, sizeof *plan->puts))
        return tn_fail_memory(error);
    plan->puts[plan->put_count++] = *put;
    tn_status status = change_cells(world, put, true, error);
    if (status != TN_OK || world->part_count <= world->part_limit)
        return status;
    tn_fail(error, TN_LIMIT, E_PLACE_LIMIT, "the search passes the limit of %llu parts",
            (unsigned long long)world->part_limit);
    tn_error_help(error, "raise the limit with --part-limit, or make the space smaller");
    return TN_LIMIT;
}

tn_status tn_world_start(tn_world *world, tn_error *error)
{
    const tn_site_choices *c = world->choices;
    const tn_put put = {.choice = c->standing};
    tn_status status = TN_OK;
    bool room = c->standing == TN_NONE_STANDS || tn_world_fits(world, c->standing, &put.at);
    if (room && c->standing != TN_NONE_STANDS)
        status = stand(world, &put, error);
    if (status != TN_OK)
        return status;
    if (!room || world->stands_over) {
        status = tn_cells_status(world->cells, error);
        if (status != TN_OK)
            return status;
        tn_fail(error, TN_INVALID, E_KIT_STANDS, "the parts with which the model starts have no room");
        tn_error_help(error,
                      "they lie inside of its space, which can have `or model(...)`, do not overlap, and keep to "
                      "its stock");
        return TN_INVALID;
    }
    return open_sites(world, &c->sites[c->start_first], c->site_count - c->start_first, &put.at, error);
}

tn_status tn_world_put(tn_world *world, uint32_t choice, const tn_frame *at, tn_error *error)
{
    const tn_site_choice *c = &world->choices->choices[choice];
    const tn_put put = {choice, *at};
    tn_status status = stand(world, &put, error);
    world->plan.draws += c->member > 0;
    return status == TN_OK ? open_sites(world, &world->choices->sites[c->site_first], c->site_count, &put.at, error)
                           : status;
}

void tn_world_take_last(tn_world *world)
{
    change_cells(world, &world->plan.puts[--world->plan.put_count], false, NULL);
}

static bool same_put(const tn_put *a, const tn_put *b)
{
    return a->choice == b->choice && memcmp(&a->at, &b->at, sizeof a->at) == 0;
}

static tn_status copy_open(tn_standing *to, const tn_standing *from, tn_error *error)
{
    to->open_first = to->open_count = 0;
    if (!tn_array_reserve(&to->open, &to->open_capacity, 0, from->open_count, sizeof *to->open))
        return tn_fail_memory(error);
    if (from->open_count)
        memcpy(to->open, from->open + from->open_first, from->open_count * sizeof *to->open);
    to->open_count = from->open_count;
    return TN_OK;
}

/* What both begin with stays. */
tn_status tn_world_load(tn_world *world, const tn_standing *plan, tn_error *error)
{
    tn_standing *own = &world->plan;
    size_t same = 0;
    tn_status status = TN_OK;
    while (same < own->put_count && same < plan->put_count && same_put(&own->puts[same], &plan->puts[same]))
        same++;
    while (own->put_count > same)
        tn_world_take_last(world);
    for (size_t i = same; i < plan->put_count && status == TN_OK; i++)
        status = stand(world, &plan->puts[i], error);
    if (status != TN_OK)
        return status;
    own->draws = plan->draws;
    return copy_open(own, plan, error);
}

tn_status tn_world_grow(tn_world *world, tn_error *error)
{
    tn_standing *plan = &world->plan;
    tn_status status = TN_OK;
    while (plan->open_count > 0 && status == TN_OK) {
        tn_open_site site = tn_world_next(world);
        uint32_t chosen;
        if (tn_world_choices(world, &site, false, &chosen, 1) > 0)
            status = tn_world_put(world, chosen, &site.frame, error);
    }
    return status == TN_OK ? tn_cells_status(world->cells, error) : status;
}

/* ---- plans */

tn_status tn_standing_copy(tn_standing *to, const tn_standing *from, tn_error *error)
{
    if (!tn_array_reserve(&to->puts, &to->put_capacity, 0, from->put_count, sizeof *to->puts))
        return tn_fail_memory(error);
    if (from->put_count)
        memcpy(to->puts, from->puts, from->put_count * sizeof *to->puts);
    to->put_count = from->put_count;
    to->draws = from->draws;
    return copy_open(to, from, error);
}

void tn_standing_clear(tn_standing *plan)
{
    free(plan->puts);
    free(plan->open);
    *plan = (tn_standing){0};
}

tn_status tn_standing_model(const tn_site_choices *choices, const tn_standing *plan, tn_placed_model *model,
                            tn_error *error)
{
    const tn_module *module = choices->rules->module;
    model->count = 0;
    for (size_t p = 0; p < plan->put_count; p++) {
        const tn_site_choice *choice = &choices->choices[plan->puts[p].choice];
        for (uint32_t i = 0; i < choice->part_count; i++) {
            const tn_chosen_part *part = &choices->parts[choice->part_first + i];
            tn_frame frame = tn_frame_from(&plan->puts[p].at, &part->frame), images[TN_IMAGES_MAX];
            const char *name = tn_text(module, choices->kinds[part->kind].record->name);
            size_t count = tn_part_images(choices, part->kind, &frame, images);
            if (!tn_array_reserve(&model->parts, &model->capacity, model->count, count, sizeof *model->parts))
                return tn_fail_memory(error);
            for (size_t k = 0; k < count; k++) {
                images[k].colour = frame.colour;
                model->parts[model->count++] = (tn_placed_part){images[k], name};
            }
        }
    }
    return TN_OK;
}
