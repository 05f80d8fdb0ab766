/* Grows a surface step by step. */
#include "runtime/growth/growth.h"

#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "runtime/growth/join/decide.h"
#include "runtime/growth/pass/pass.h"
#include "runtime/math/elementary.h"

#define SMALL 4096u /* faces, up to which keeping their order costs less than it may save */

tn_growth_options tn_growth_options_default(void)
{
    return (tn_growth_options){
        .scale = {1.5, 1.5, 1.5}, .start_length = 1, .branch_angle = -1, .branch_length = -1, .seed = 1};
}

static bool all_finite(const double *values, int count)
{
    for (int i = 0; i < count; i++)
        if (!isfinite(values[i]))
            return false;
    return true;
}

static tn_status check_options(const tn_growth_options *options, tn_error *error)
{
    if (!all_finite(options->scale, 3) || !all_finite(options->start, 3) || !isfinite(options->start_length) ||
        !isfinite(options->branch_angle) || !isfinite(options->branch_length))
        return tn_fail(error, TN_INVALID, TN_CODE_NONE, "a growth option is not a finite number");
    for (int k = 0; k < 3; k++)
        if (options->scale[k] <= 0)
            return tn_fail(error, TN_INVALID, TN_CODE_NONE, "the scale is %g; it must be above 0", options->scale[k]);
    if (options->start_length <= 0)
        return tn_fail(error, TN_INVALID, TN_CODE_NONE, "the start length is %g; it must be above 0",
                       options->start_length);
    if (options->branch_angle > 360)
        return tn_fail(error, TN_INVALID, TN_CODE_NONE, "the branch angle is %g degrees; it lies between 0 and 360",
                       options->branch_angle);
    return TN_OK;
}

/* ---- shapes: templates as each side's loop meets them */

/* Clockwise about the corner, as a loop with its face on the left meets them: turns descending; equal ones against the
 * text's order (which is counter-clockwise's). */
static bool met_before(const tn_template_branch *a, const tn_template_branch *b)
{
    return a->turn > b->turn || (a->turn == b->turn && a > b);
}

static uint32_t walk_corner(const tn_template *template, uint32_t at, uint8_t side, tn_walk *walk)
{
    uint32_t count = 0;
    for (uint32_t b = 0; b < template->branch_count; b++) {
        const tn_template_branch *branch = &template->branches[b];
        if (branch->at != at || branch->side != side)
            continue;
        uint32_t i = count++;
        for (; i > 0 && met_before(branch, &template->branches[walk[i - 1].index]); i--)
            walk[i] = walk[i - 1];
        walk[i] = (tn_walk){(uint16_t)b, true, false, (uint16_t)at};
    }
    return count;
}

static void make_pieces(const tn_template *template, tn_piece *pieces)
{
    for (uint32_t j = 0; j < template->segment_count; j++) {
        const tn_template_segment *segment = &template->segments[j];
        bool keeps = segment->age != TN_AGE_ZERO; /* or counts from it */
        pieces[j] = (tn_piece){keeps ? tn_state(0, -1, false) : 0,
                               tn_state(segment->label, tn_changed_age(segment->age, 0), false)};
    }
}

static tn_walk *make_shape(tn_shape *shape, const tn_template *template, tn_walk *walk)
{
    uint32_t points = template->segment_count;
    shape->template = template;
    make_pieces(template, shape->pieces);
    shape->left = walk;
    for (uint32_t j = 0; j <= points; j++) {
        walk += walk_corner(template, j, TN_SIDE_LEFT, walk);
        if (j < points)
            *walk++ = (tn_walk){(uint16_t)j, false, template->segments[j].reversed, (uint16_t)j};
    }
    shape->left_count = (uint32_t)(walk - shape->left);
    shape->right = walk;
    for (uint32_t j = points + 1; j-- > 0;) {
        walk += walk_corner(template, j, TN_SIDE_RIGHT, walk);
        if (j > 0)
            *walk++ = (tn_walk){(uint16_t)(j - 1), false, template->segments[j - 1].reversed, (uint16_t)j};
    }
    shape->right_count = (uint32_t)(walk - shape->right);
    for (uint32_t b = 0; b < template->branch_count; b++) {
        shape->left_branches += template->branches[b].side == TN_SIDE_LEFT;
        shape->right_branches += template->branches[b].side == TN_SIDE_RIGHT;
        shape->end_branches |= template->branches[b].at == 0 || template->branches[b].at == points;
    }
    return walk;
}

static tn_status make_shapes(tn_growth *growth, tn_error *error)
{
    const tn_growth_system *system = growth->system;
    size_t items = 0, pieces = 0;
    for (uint32_t t = 0; t < system->template_count; t++) {
        pieces += system->templates[t].segment_count;
        items += 2 * (size_t)system->templates[t].segment_count + system->templates[t].branch_count;
    }
    growth->shapes = calloc(system->template_count ? system->template_count : 1, sizeof *growth->shapes);
    growth->walks = malloc((items ? items : 1) * sizeof *growth->walks);
    growth->pieces = malloc((pieces ? pieces : 1) * sizeof *growth->pieces);
    growth->group_of = malloc(system->label_count * sizeof *growth->group_of);
    growth->template_of = malloc(system->label_count * sizeof *growth->template_of);
    if (!growth->shapes || !growth->walks || !growth->pieces || !growth->group_of || !growth->template_of)
        return tn_fail_memory(error);
    tn_walk *walk = growth->walks;
    tn_piece *piece = growth->pieces;
    for (uint32_t t = 0; t < system->template_count; t++) {
        growth->shapes[t].pieces = piece;
        walk = make_shape(&growth->shapes[t], &system->templates[t], walk);
        piece += system->templates[t].segment_count;
    }
    memset(growth->group_of, 0xff, system->label_count * sizeof *growth->group_of);
    for (uint32_t g = 0; g < system->group_count; g++) {
        const tn_growth_group *group = &system->groups[g];
        if (group->label_count == 1)
            growth->group_of[group->labels[0]] = g;
        for (uint32_t r = 0; r < group->rule_count; r++)
            growth->weighted |= !group->rules[r].conditional && group->rules[r].alternative_count > 1;
    }
    return TN_OK;
}

/* ---- the seed: a regular polygon about the start, its first side along x ("Genr8", 5.2; docs/growth.md) */

static tn_vector seed_corner(const tn_growth *growth, uint32_t i)
{
    uint32_t n = growth->system->axiom_count;
    double side = growth->options.start_length, x, y;
    if (n == 4) { /* exact */
        x = (i == 1 || i == 2 ? 0.5 : -0.5) * side;
        y = (i >= 2 ? 0.5 : -0.5) * side;
    } else {
        double half = 180.0 / n, radius = side / (2 * tn_sin_degrees(half));
        double turn = -90 - half + 2 * half * i;
        x = radius * tn_cos_degrees(turn);
        y = radius * tn_sin_degrees(turn);
    }
    tn_vector p = {x, growth->options.mirror ? -y : y, 0};
    p = tn_add(p, tn_vector_at(growth->options.start));
    return growth->hard ? tn_environment_project(growth->environment, p) : p;
}

static tn_status plant(tn_growth *growth, tn_error *error)
{
    uint32_t n = growth->system->axiom_count;
    tn_map *map = &growth->map;
    tn_growth_workspace *space = &growth->space;
    int here = space->current;
    if (!tn_pages_reserve(&space->positions, 3 * (uint64_t)n * sizeof(double)) ||
        !tn_pages_reserve(&space->states[here], (uint64_t)n * sizeof(tn_edge_state)) ||
        !tn_pages_reserve(&space->darts[here], 4 * (uint64_t)n * sizeof(uint32_t)) ||
        !tn_pages_reserve(&space->faces[here], 5 * sizeof(uint32_t)))
        return tn_fail_memory(error);
    *map = (tn_map){.vertex_count = n,
                    .edge_count = n,
                    .face_count = 2,
                    .positions = space->positions.data,
                    .states = space->states[here].data,
                    .origin = space->darts[here].data,
                    .face_first = space->faces[here].data};
    map->side = map->origin + 2 * (size_t)n;
    map->face_rank = map->face_first + 3;
    growth->ranked = true;
    for (uint32_t i = 0; i < n; i++) {
        const tn_axiom_edge *edge = &growth->system->axiom[i];
        uint32_t back = n - 1 - i, along = n + i; /* the outer face runs the other way */
        tn_vector_put(map->positions + 3 * (size_t)i, seed_corner(growth, i));
        map->states[i] = tn_state(edge->label, 0, false);
        map->origin[along] = i;
        map->side[along] = 2 * i + edge->reversed;
        map->origin[back] = i + 1 == n ? 0 : i + 1;
        map->side[back] = 2 * i + !edge->reversed;
    }
    for (uint32_t f = 0; f <= 2; f++)
        map->face_first[f] = f * n;
    for (uint32_t f = 0; f < 2; f++)
        map->face_rank[f] = f;
    growth->steps = 0;
    growth->draws = 0;
    growth->length = growth->options.start_length;
    growth->counts = (tn_growth_counts){0};
    growth->at_rest = growth->has_fingerprint = false;
    return TN_OK;
}

static void clear_pending(tn_growth *growth)
{
    free(growth->pending.items);
    free(growth->pending.face_first);
    growth->pending = (tn_pending_list){0};
}

static void clear_shapes(tn_growth *growth)
{
    clear_pending(growth);
    free(growth->shapes);
    free(growth->walks);
    free(growth->pieces);
    free(growth->group_of);
    free(growth->template_of);
}

/* The crew that worked before, where it is of the right size. */
static tn_status find_crew(tn_growth *growth, tn_error *error)
{
    unsigned threads = growth->options.threads > 0 ? (unsigned)growth->options.threads : tn_crew_default();
    if (growth->crew && tn_crew_threads(growth->crew) != threads) {
        tn_crew_free(growth->crew);
        growth->crew = NULL;
    }
    if (!growth->crew)
        growth->crew = tn_crew_new(threads, NULL);
    if (!growth->crew)
        return tn_fail_memory(error);
    tn_crew_watch(growth->crew, growth->options.watch);
    return TN_OK;
}

tn_status tn_growth_renew(tn_growth *growth, const tn_growth_system *system, const tn_environment *environment,
                          const tn_growth_options *options, tn_error *error)
{
    clear_shapes(growth);
    tn_deciders_forget(&growth->space);
    *growth = (tn_growth){.system = system,
                          .environment = environment,
                          .options = *options,
                          .hard = tn_environment_has_hard(environment),
                          .space = growth->space,
                          .crew = growth->crew};
    tn_status status = check_options(options, error);
    if (status == TN_OK)
        status = find_crew(growth, error);
    if (status != TN_OK)
        return status;
    double angle = options->branch_angle >= 0 ? options->branch_angle : system->branch_angle;
    growth->branch_cosine = -tn_cos_degrees(angle) + 1e-9;
    status = make_shapes(growth, error);
    return status == TN_OK ? plant(growth, error) : status;
}

tn_status tn_growth_new(const tn_growth_system *system, const tn_environment *environment,
                        const tn_growth_options *options, tn_growth **result, tn_error *error)
{
    tn_growth *growth = calloc(1, sizeof *growth);
    *result = NULL;
    if (!growth)
        return tn_fail_memory(error);
    tn_status status = tn_growth_renew(growth, system, environment, options, error);
    if (status != TN_OK) {
        tn_growth_free(growth);
        return status;
    }
    *result = growth;
    return TN_OK;
}

void tn_growth_free(tn_growth *growth)
{
    if (!growth)
        return;
    tn_growth_workspace *space = &growth->space;
    tn_pages *all[] = {&space->positions, &space->states[0], &space->states[1], &space->darts[0], &space->darts[1],
                       &space->faces[0],  &space->faces[1],  &space->survey,    &space->choices,  &space->chunks,
                       &space->records,   &space->joints,    &space->cut_of,    &space->made};
    tn_deciders_clear(space);
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        tn_pages_release(all[i]);
    clear_shapes(growth);
    tn_crew_free(growth->crew);
    free(growth);
}

/* ---- a pass */

static bool anything_to_do(const tn_pass *pass)
{
    if (pass->list)
        return pass->list_count > 0;
    for (uint32_t e = 0; e < pass->old->edge_count; e++)
        if (tn_choice(pass, e) != TN_NO_TEMPLATE)
            return true;
    return false;
}

/* Branches that no face takes: without a side, or outside. */
static void explain_outside(tn_pass *pass)
{
    uint64_t *failures = pass->growth->counts.failures;
    for (uint32_t e = 0; e < pass->old->edge_count; e++) {
        const tn_record *record = &pass->records[e];
        if (tn_is_kept(record) || (pass->runs && pass->runs[e].first != e))
            continue;
        uint32_t last = pass->runs ? pass->runs[e].last : e;
        uint32_t left = pass->sides[2 * (size_t)e].face, right = pass->sides[2 * (size_t)last + 1].face;
        const tn_template *template = &pass->growth->system->templates[record->template];
        for (uint32_t b = 0; b < template->branch_count; b++) {
            uint8_t side = template->branches[b].side;
            if (side == TN_SIDE_NONE)
                failures[TN_FAIL_SIDE]++;
            else if ((side == TN_SIDE_LEFT ? left : right) == TN_OUTER_FACE)
                failures[TN_FAIL_OUTER]++;
        }
    }
}

/* Vertices that chains left behind: the others move up, in order. */
static tn_status drop_vertices(tn_map *map, tn_error *error)
{
    uint32_t *number = calloc(map->vertex_count, sizeof *number);
    if (!number)
        return tn_fail_memory(error);
    size_t darts = 2 * (size_t)map->edge_count;
    for (size_t d = 0; d < darts; d++)
        number[map->origin[d]] = 1;
    uint32_t kept = 0;
    for (uint32_t v = 0; v < map->vertex_count; v++) {
        if (!number[v])
            continue;
        memmove(map->positions + 3 * (size_t)kept, map->positions + 3 * (size_t)v, 3 * sizeof(double));
        number[v] = kept++;
    }
    for (size_t d = 0; d < darts; d++)
        map->origin[d] = number[map->origin[d]];
    map->vertex_count = kept;
    free(number);
    return TN_OK;
}

static tn_status finish_pass(tn_pass *pass, tn_error *error)
{
    tn_growth *growth = pass->growth;
    growth->map = *pass->new;
    growth->space.current = !growth->space.current;
    growth->branches = growth->pending.count ? pass->branch_first + pass->branch_count : 0;
    return pass->runs ? drop_vertices(&growth->map, error) : TN_OK;
}

static bool walks_vertices(const tn_growth *growth, uint32_t first, uint32_t last)
{
    if (growth->pending.count || growth->options.interpret)
        return true;
    for (uint32_t g = first; g < last; g++) {
        const tn_growth_group *group = &growth->system->groups[g];
        if (group->label_count > 1)
            return true;
        for (uint32_t r = 0; r < group->rule_count; r++)
            for (uint32_t a = 0; a < group->rules[r].alternative_count; a++)
                if (growth->shapes[group->rules[r].alternatives[a].template].end_branches)
                    return true;
    }
    return false;
}

static tn_status run_pass(tn_growth *growth, uint32_t first, uint32_t last, tn_error *error)
{
    tn_map new = {0};
    tn_pass pass = {.growth = growth,
                    .old = &growth->map,
                    .new = &new,
                    .group_first = first,
                    .group_last = last,
                    .joins_last = last == growth->system->group_count,
                    .walks_vertices = walks_vertices(growth, first, last),
                    .branch_first = growth->branches};
    tn_watch *watch = growth->options.watch;
    tn_status status = tn_pass_survey(&pass, error);
    if (status == TN_OK)
        status = tn_watch_check(watch, error);
    if (status == TN_OK)
        status = growth->options.interpret ? tn_interpret_match(&pass, error) : tn_pass_match(&pass, error);
    if (status == TN_OK)
        status = tn_watch_check(watch, error);
    bool explaining = growth->options.explain && pass.joins_last && growth->pending.count;
    if (status == TN_OK && (anything_to_do(&pass) || explaining)) {
        status = growth->options.interpret ? tn_interpret_rewrite(&pass, error) : tn_pass_rewrite(&pass, error);
        if (status == TN_OK) {
            if (growth->options.explain)
                explain_outside(&pass);
            status = tn_watch_check(watch, error);
            if (status == TN_OK)
                status = tn_pass_faces(&pass, error);
        }
        if (status == TN_OK && !growth->needs_ranks)
            status = finish_pass(&pass, error);
    } else if (status == TN_OK && pass.joins_last)
        for (uint32_t e = 0; e < growth->map.edge_count; e++) /* nothing is fresh between steps */
            growth->map.states[e] &= ~TN_STATE_FRESH;
    free(pass.list);
    free(pass.runs);
    return status;
}

/* ---- a step */

/* Nothing changes any more where nothing is random, nothing moved, and the map is the one before. Maps are compared by
 * their hash, and only once a step has left all counts as they were. */
static void look_for_rest(tn_growth *growth, uint32_t vertices, uint32_t edges, uint32_t faces)
{
    const tn_map *map = &growth->map;
    bool same_size = map->vertex_count == vertices && map->edge_count == edges && map->face_count == faces;
    if (growth->weighted || !same_size) {
        growth->has_fingerprint = false;
        return;
    }
    XXH64_hash_t hash = XXH3_64bits(map->states, map->edge_count * sizeof *map->states);
    hash = XXH3_64bits_withSeed(map->positions, 3 * (size_t)map->vertex_count * sizeof *map->positions, hash);
    growth->at_rest = growth->has_fingerprint && hash == growth->fingerprint && !growth->moved;
    growth->fingerprint = hash;
    growth->has_fingerprint = true;
}

static tn_status take_step(tn_growth *growth, tn_error *error)
{
    tn_map *map = &growth->map;
    uint32_t vertices = map->vertex_count, edges = map->edge_count, faces = map->face_count;
    uint32_t groups = growth->system->group_count, together = growth->system->sync ? groups : 1;
    growth->counts = (tn_growth_counts){0};
    growth->branches = 0;
    growth->length *= (growth->options.scale[0] + growth->options.scale[1] + growth->options.scale[2]) / 3;
    tn_status status = tn_growth_displace(growth, error);
    for (uint32_t g = 0; g < groups && status == TN_OK && !growth->needs_ranks; g += together)
        status = run_pass(growth, g, g + together, error);
    clear_pending(growth);
    if (status != TN_OK || growth->needs_ranks)
        return status;
    growth->steps++;
    look_for_rest(growth, vertices, edges, faces);
#ifdef TARTAN_CHECK_MAPS
    return tn_map_validate(map, error);
#else
    return TN_OK;
#endif
}

/* The order in which faces were made matters only once a face has to wait for another, which few systems ever need, and
 * those mostly soon. So it is kept of small surfaces; of larger ones only once that has happened. Where it first
 * happens to one, the surface is grown again to where it was, and then further. */
tn_status tn_growth_step(tn_growth *growth, tn_error *error)
{
    if (growth->map.face_count > SMALL && !growth->waited) {
        growth->ranked = false;
        growth->map.face_rank = NULL;
    }
    tn_status status = take_step(growth, error);
    if (status != TN_OK || !growth->needs_ranks)
        return status;
    growth->needs_ranks = false;
    status = tn_growth_regrow(growth, growth->steps, error);
    return status == TN_OK ? take_step(growth, error) : status;
}

tn_status tn_growth_regrow(tn_growth *growth, uint32_t steps, tn_error *error)
{
    tn_status status = plant(growth, error);
    for (uint32_t i = 0; i < steps && status == TN_OK; i++)
        status = tn_growth_step(growth, error);
    return status;
}

/* ---- looking at it */

void tn_growth_watch(tn_growth *growth, tn_watch *watch)
{
    growth->options.watch = watch;
    tn_crew_watch(growth->crew, watch);
}

const tn_map *tn_growth_map(const tn_growth *growth)
{
    return &growth->map;
}

uint32_t tn_growth_steps(const tn_growth *growth)
{
    return growth->steps;
}

const tn_growth_system *tn_growth_rules(const tn_growth *growth)
{
    return growth->system;
}

const tn_environment *tn_growth_surroundings(const tn_growth *growth)
{
    return growth->environment;
}

const tn_growth_options *tn_growth_settings(const tn_growth *growth)
{
    return &growth->options;
}

tn_growth_counts tn_growth_last_counts(const tn_growth *growth)
{
    return growth->counts;
}

bool tn_growth_at_rest(const tn_growth *growth)
{
    return growth->at_rest;
}
