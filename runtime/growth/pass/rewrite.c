/* What replaces each edge: numbers of its pieces, vertices and branches, its frame, the new vertices' positions and the
 * pieces' states. New edges are numbered: kept ones in their order, then pieces in the order of replacement. */
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/watch.h"
#include "runtime/growth/pass/pass.h"
#include "runtime/growth/pass/rows.h"

/* ==== the numbers of joined edges: behind all others, in the order of their lower branches' numbers */

typedef struct numbering {
    const tn_pass *pass;
    uint32_t *first; /* [chunk] its first joined edge */
} numbering;

static uint32_t joints_end(const tn_pass *pass, uint32_t chunk)
{
    uint32_t numbers = pass->branch_first + pass->branch_count, begin = chunk * TN_CHUNK_EDGES;
    return numbers - begin < TN_CHUNK_EDGES ? numbers : begin + TN_CHUNK_EDGES;
}

static void count_joints(void *context, uint32_t chunk)
{
    const numbering *n = context;
    uint32_t count = 0;
    for (uint32_t b = chunk * TN_CHUNK_EDGES, end = joints_end(n->pass, chunk); b < end; b++)
        count += n->pass->joints[b] != TN_NONE;
    n->first[chunk + 1] = count;
}

static void number_chunk(void *context, uint32_t chunk)
{
    const numbering *n = context;
    uint32_t *joints = n->pass->joints, edge = n->first[chunk];
    for (uint32_t b = chunk * TN_CHUNK_EDGES, end = joints_end(n->pass, chunk); b < end; b++) {
        if (joints[b] == TN_NONE)
            continue;
        n->pass->new->states[edge] = joints[b];
        joints[b] = edge++;
    }
}

tn_status tn_pass_number_joints(const tn_pass *pass, tn_error *error)
{
    uint32_t numbers = pass->branch_first + pass->branch_count;
    uint32_t chunks = (numbers + TN_CHUNK_EDGES - 1) / TN_CHUNK_EDGES;
    numbering n = {pass, calloc(chunks + 1, sizeof *n.first)};
    if (!n.first)
        return tn_fail_memory(error);
    tn_status status = tn_crew_share(tn_pass_crew(pass), chunks, count_joints, &n, error);
    n.first[0] = pass->edges;
    for (uint32_t c = 0; c < chunks && status == TN_OK; c++)
        n.first[c + 1] += n.first[c];
    if (status == TN_OK)
        status = tn_crew_share(tn_pass_crew(pass), chunks, number_chunk, &n, error);
    free(n.first);
    return status;
}

static inline const double *position(const tn_pass *pass, tn_edge_side side)
{
    return pass->old->positions + 3 * (size_t)side.origin;
}

static inline const double *normal(const tn_pass *pass, tn_edge_side side)
{
    return pass->normal + 3 * (size_t)side.face;
}

tn_vector tn_pass_frame(const tn_pass *pass, uint32_t first, uint32_t last, tn_vector *heading, tn_vector *up,
                        double *length)
{
    tn_edge_side from = pass->sides[2 * (size_t)first], to = pass->sides[2 * (size_t)last + 1];
    tn_vector start = tn_vector_at(position(pass, from)), end = tn_vector_at(position(pass, to));
    tn_axes axes = tn_axes_of(start, end, tn_vector_at(normal(pass, from)), tn_vector_at(normal(pass, to)),
                              tn_vector_at(pass->growth->options.start));
    *heading = axes.heading;
    *up = axes.up;
    *length = axes.length;
    return start;
}

/* ---- new vertices and branches, of some edges at once */

/* Edges that wait until they are many, all replaced by one template. */
typedef struct waiting {
    const tn_template *template;
    uint32_t count;
    uint32_t from[TN_ROW], to[TN_ROW];       /* vertices */
    uint32_t left[TN_ROW], right[TN_ROW];    /* faces */
    uint32_t vertex[TN_ROW], branch[TN_ROW]; /* the first new ones */
} waiting;

#define WAITING 4u

typedef struct placing {
    waiting waiting[WAITING]; /* by the template's number, as long as no other template needs the place */
    tn_axes_rows axes;        /* of those that are placed */
    tn_row turned[3];
    bool failed; /* a coordinate left its range */
} placing;

/* Not set to zeros as a whole: small surfaces need little of it. */
static void start_placing(placing *some)
{
    for (uint32_t w = 0; w < WAITING; w++) {
        some->waiting[w].template = NULL;
        some->waiting[w].count = 0;
    }
    some->failed = false;
}

static void gather(const tn_pass *pass, const waiting *edges, tn_axes_rows *axes)
{
    const double *positions = pass->old->positions, *normals = pass->normal;
    for (uint32_t i = 0; i < edges->count; i++) {
        tn_rows_put(axes->from, i, tn_vector_at(positions + 3 * (size_t)edges->from[i]));
        tn_rows_put(axes->to, i, tn_vector_at(positions + 3 * (size_t)edges->to[i]));
        tn_rows_put(axes->left_normal, i, tn_vector_at(normals + 3 * (size_t)edges->left[i]));
        tn_rows_put(axes->right_normal, i, tn_vector_at(normals + 3 * (size_t)edges->right[i]));
    }
}

static tn_vector keep_inside(const tn_pass *pass, tn_axes_rows *axes, uint32_t i, tn_vector place)
{
    tn_vector from = tn_rows_at(axes->from, i);
    tn_vector to = tn_along(from, tn_rows_at(axes->heading, i), axes->length[i]);
    return tn_environment_place(pass->growth->environment, place, from, to);
}

/* The vertex at the path's point j + 1 of each. */
static void place_vertices(const tn_pass *pass, const waiting *edges, uint32_t j, placing *some)
{
    bool hard = pass->growth->hard;
    double wild = 0; /* what is no finite number stays none when subtracted from itself */
    tn_axes_place(&some->axes, edges->count, edges->template->segments[j].end, some->turned);
    for (uint32_t i = 0; i < edges->count; i++) {
        tn_vector p = tn_rows_at(some->turned, i);
        if (hard)
            p = keep_inside(pass, &some->axes, i, p);
        tn_vector_put(pass->new->positions + 3 * ((size_t)edges->vertex[i] + j), p);
        double sum = p.x + p.y + p.z;
        wild += sum - sum;
    }
    some->failed |= wild != 0;
}

static void aim_branches(const tn_pass *pass, const waiting *edges, uint32_t b, placing *some)
{
    const tn_template_branch *branch = &edges->template->branches[b];
    const uint32_t *beyond = branch->side == TN_SIDE_LEFT ? edges->right : edges->left;
    tn_axes_turn(&some->axes, edges->count, branch->direction, some->turned);
    for (uint32_t i = 0; i < edges->count; i++) {
        tn_vector d = tn_rows_at(some->turned, i);
        pass->aims[edges->branch[i] - pass->branch_first + b] =
            (tn_aim){{(float)d.x, (float)d.y, (float)d.z}, beyond[i]};
    }
}

static void place(const tn_pass *pass, waiting *edges, placing *some)
{
    if (edges->count == 0)
        return;
    gather(pass, edges, &some->axes);
    tn_axes_of_rows(&some->axes, edges->count, tn_vector_at(pass->growth->options.start));
    for (uint32_t j = 0; j + 1 < edges->template->segment_count; j++)
        place_vertices(pass, edges, j, some);
    for (uint32_t b = 0; b < edges->template->branch_count; b++)
        aim_branches(pass, edges, b, some);
    edges->count = 0;
}

/* False if a coordinate left its range. */
static bool place_all(const tn_pass *pass, placing *some)
{
    for (uint32_t w = 0; w < WAITING; w++)
        place(pass, &some->waiting[w], some);
    return !some->failed;
}

/* What placing an edge needs lies all over memory: asked for when the edge is added, it is there in time. Always
 * inlined: a call that only asks is taken for one without effect. */
static inline __attribute__((always_inline)) void ask_for(const tn_pass *pass, tn_edge_side side)
{
    __builtin_prefetch(pass->old->positions + 3 * (size_t)side.origin);
    __builtin_prefetch(pass->normal + 3 * (size_t)side.face);
}

/* The edges first .. last are replaced as this record says. */
static inline void add_to_place(const tn_pass *pass, placing *some, uint32_t first, uint32_t last,
                                const tn_record *record)
{
    const tn_template *template = &pass->growth->system->templates[record->template];
    waiting *edges = &some->waiting[record->template % WAITING];
    tn_edge_side from = pass->sides[2 * (size_t)first], to = pass->sides[2 * (size_t)last + 1];
    if (edges->template != template) {
        place(pass, edges, some);
        edges->template = template;
    }
    ask_for(pass, from);
    ask_for(pass, to);
    edges->from[edges->count] = from.origin;
    edges->to[edges->count] = to.origin;
    edges->left[edges->count] = from.face;
    edges->right[edges->count] = to.face;
    edges->vertex[edges->count] = record->vertex;
    edges->branch[edges->count] = record->branch;
    if (++edges->count == TN_ROW)
        place(pass, edges, some);
}

/* ---- what replaces an edge */

static bool ages_stay_in_range(const tn_template *template, int32_t age)
{
    int32_t least = 0, most = 0;
    for (uint32_t j = 0; j < template->segment_count; j++) {
        int32_t now = tn_changed_age(template->segments[j].age, age);
        least = now < least ? now : least;
        most = now > most ? now : most;
    }
    return least >= -TN_AGE_MAX && most <= TN_AGE_MAX;
}

/* Replaces the edges first .. last, of which `first` gets the record; `at` holds the numbers that come next. False
 * if an age leaves its range. */
static inline bool replace(tn_pass *pass, uint32_t first, uint32_t last, uint16_t chosen, tn_rewrite_tally *at,
                           placing *some)
{
    const tn_shape *shape = &pass->growth->shapes[chosen];
    const tn_template *template = shape->template;
    tn_edge_state old = pass->old->states[first] & ~TN_STATE_FRESH, fresh = pass->joins_last ? 0 : TN_STATE_FRESH;
    tn_edge_state *states = pass->new->states + at->pieces;
    int32_t age = tn_state_age(old);
    if ((age == TN_AGE_MAX || age == -TN_AGE_MAX) && !ages_stay_in_range(template, age))
        return false;
    tn_record record = {2 * (uint32_t)at->pieces, (uint32_t)at->vertices, (uint32_t)at->branches, chosen, (int16_t)age};
    pass->records[first] = record;
    for (uint32_t j = 0; j < template->segment_count; j++)
        states[j] = ((old & shape->pieces[j].kept) + shape->pieces[j].added) | fresh;
    at->rewrites++;
    at->pieces += template->segment_count;
    at->vertices += template->segment_count - 1;
    at->branches += template->branch_count;
    add_to_place(pass, some, first, last, &record);
    return true;
}

static void count(const tn_pass *pass, uint16_t chosen, uint64_t times, tn_rewrite_tally *so_far)
{
    const tn_template *template = &pass->growth->system->templates[chosen];
    so_far->rewrites += times;
    so_far->pieces += times * template->segment_count;
    so_far->vertices += times * (template->segment_count - 1);
    so_far->branches += times * template->branch_count;
}

static uint64_t lacking(const tn_pages *pages, uint64_t bytes)
{
    return bytes > pages->capacity ? bytes - pages->capacity : 0;
}

/* What the step needs beyond what the growth holds: the new map, and what it is made with. */
static tn_status check_memory(const tn_growth *growth, const tn_rewrite_tally *total, uint64_t vertices, uint64_t edges,
                              tn_error *error)
{
    const tn_growth_workspace *space = &growth->space;
    const tn_pages *darts = &space->darts[!space->current];
    uint64_t old = growth->map.edge_count;
    uint64_t marks = lacking(&space->records, sizeof(tn_record) * old) +
                     lacking(&space->joints, sizeof(uint32_t) * total->branches) +
                     lacking(darts, 2 * sizeof(tn_edge_side) * old + sizeof(tn_aim) * total->branches);
    uint64_t map = lacking(&space->positions, 3 * sizeof(double) * vertices) +
                   lacking(&space->states[!space->current], sizeof(tn_edge_state) * edges) +
                   lacking(darts, 4 * sizeof(uint32_t) * edges);
    char what[32];
    snprintf(what, sizeof what, "step %u", growth->steps + 1);
    tn_status status = tn_watch_room(growth->options.watch, marks + map, what, error);
    if (status == TN_LIMIT)
        tn_error_help(error, "take fewer steps, or raise the limit with --memory-limit");
    return status;
}

tn_status tn_rewrite_make_room(tn_pass *pass, const tn_rewrite_tally *total, tn_error *error)
{
    tn_growth *growth = pass->growth;
    const tn_map *old = pass->old;
    uint64_t edges = total->kept + total->pieces;
    uint64_t limit = growth->options.edge_limit && growth->options.edge_limit < TN_EDGES_MAX
                         ? growth->options.edge_limit
                         : TN_EDGES_MAX;
    if (edges > limit || total->branches > TN_EDGES_MAX) {
        tn_fail(error, TN_LIMIT, E_GROWTH_EDGES, "step %u would make more than %llu edges", growth->steps + 1,
                (unsigned long long)limit);
        tn_error_help(error, "take fewer steps, or raise the limit with --edge-limit (at most %u)", TN_EDGES_MAX);
        return TN_LIMIT;
    }
    uint64_t vertices = (uint64_t)old->vertex_count + total->vertices;
    uint64_t most = edges + (total->branches + growth->pending.count) / 2;
    tn_status status = check_memory(growth, total, vertices, most, error);
    if (status != TN_OK)
        return status;
    pass->vertices = (uint32_t)vertices;
    pass->edges = (uint32_t)edges;
    pass->branch_count = (uint32_t)total->branches;
    pass->rewrites = total->rewrites;
    tn_growth_workspace *space = &growth->space;
    if (!tn_pages_reserve(&space->positions, 3 * vertices * sizeof(double)) ||
        !tn_pages_reserve(&space->states[!space->current], most * sizeof(tn_edge_state)) ||
        !tn_pages_reserve(&space->records, (uint64_t)old->edge_count * sizeof *pass->records) ||
        !tn_pass_reserve_aims(pass, total->branches))
        return tn_fail_memory(error);
    growth->map.positions = space->positions.data; /* vertices stay where they are; new ones follow them */
    pass->new->positions = space->positions.data;
    pass->new->states = space->states[!space->current].data;
    pass->records = space->records.data;
    return TN_OK;
}

/* ---- each edge on its own */

static uint32_t group_at(const tn_pass *pass, uint32_t edge)
{
    if (pass->group_last - pass->group_first == 1)
        return 0;
    return pass->growth->group_of[tn_state_label(pass->old->states[edge])] - pass->group_first;
}

/* Counted by runs of edges replaced alike: one after another, each would wait for the sums of the last. */
static void count_chunk(const tn_pass *pass, uint32_t begin, uint32_t end, tn_rewrite_tally *by_group)
{
    for (uint32_t e = begin, next; e < end; e = next) {
        uint16_t chosen = tn_choice(pass, e);
        uint32_t group = chosen == TN_NO_TEMPLATE ? 0 : group_at(pass, e);
        for (next = e + 1; next < end && tn_choice(pass, next) == chosen; next++)
            if (chosen != TN_NO_TEMPLATE && group_at(pass, next) != group)
                break;
        if (chosen == TN_NO_TEMPLATE)
            by_group[0].kept += next - e;
        else
            count(pass, chosen, next - e, &by_group[group]);
    }
}

static bool rewrite_chunk(tn_pass *pass, uint32_t begin, uint32_t end, tn_rewrite_tally *by_group)
{
    placing some;
    start_placing(&some);
    bool fine = true;
    for (uint32_t e = begin; e < end && fine; e++) {
        uint16_t chosen = tn_choice(pass, e);
        if (chosen == TN_NO_TEMPLATE) {
            tn_rewrite_keep(pass, e, (uint32_t)by_group[0].kept++);
            continue;
        }
        fine = replace(pass, e, e, chosen, &by_group[group_at(pass, e)], &some);
    }
    return fine && place_all(pass, &some);
}

/* Counts become first numbers: groups in order, chunks of edges in order within each. Returns the totals. */
static tn_rewrite_tally number(tn_pass *pass, tn_rewrite_tally *counts, uint32_t chunks, uint32_t groups)
{
    tn_rewrite_tally next = {0};
    for (uint32_t g = 0; g < groups; g++) {
        for (uint32_t c = 0; c < chunks; c++) {
            tn_rewrite_tally *one = &counts[(size_t)c * groups + g], here = *one;
            *one = next;
            next.rewrites += here.rewrites;
            next.kept += here.kept;
            next.pieces += here.pieces;
            next.vertices += here.vertices;
            next.branches += here.branches;
        }
    }
    for (size_t i = 0; i < (size_t)chunks * groups; i++) {
        counts[i].pieces += next.kept;
        counts[i].vertices += pass->old->vertex_count;
        counts[i].branches += pass->branch_first;
    }
    return next;
}

typedef struct single_rewrite {
    tn_pass *pass;
    tn_rewrite_tally *counts; /* by chunk, then group */
    atomic_bool out_of_range;
} single_rewrite;

static uint32_t chunk_end(const tn_pass *pass, uint32_t chunk)
{
    uint32_t edges = pass->old->edge_count, begin = chunk * TN_CHUNK_EDGES;
    return edges - begin < TN_CHUNK_EDGES ? edges : begin + TN_CHUNK_EDGES;
}

static tn_rewrite_tally *counts_of(const single_rewrite *r, uint32_t chunk)
{
    return r->counts + (size_t)chunk * (r->pass->group_last - r->pass->group_first);
}

static void count_piece(void *context, uint32_t chunk)
{
    const single_rewrite *r = context;
    count_chunk(r->pass, chunk * TN_CHUNK_EDGES, chunk_end(r->pass, chunk), counts_of(r, chunk));
}

static void rewrite_piece(void *context, uint32_t chunk)
{
    single_rewrite *r = context;
    if (!rewrite_chunk(r->pass, chunk * TN_CHUNK_EDGES, chunk_end(r->pass, chunk), counts_of(r, chunk)))
        atomic_store(&r->out_of_range, true);
}

static tn_status rewrite_singly(tn_pass *pass, tn_error *error)
{
    uint32_t edges = pass->old->edge_count, chunks = (edges + TN_CHUNK_EDGES - 1) / TN_CHUNK_EDGES;
    uint32_t groups = pass->group_last - pass->group_first;
    single_rewrite r = {.pass = pass, .counts = calloc((size_t)chunks * groups, sizeof *r.counts)};
    if (!r.counts)
        return tn_fail_memory(error);
    tn_status status = tn_crew_share(tn_pass_crew(pass), chunks, count_piece, &r, error);
    if (status == TN_OK) {
        tn_rewrite_tally total = number(pass, r.counts, chunks, groups);
        status = tn_rewrite_make_room(pass, &total, error);
    }
    if (status == TN_OK)
        status = tn_crew_share(tn_pass_crew(pass), chunks, rewrite_piece, &r, error);
    pass->out_of_range = r.out_of_range;
    free(r.counts);
    return status;
}

/* ---- chains */

void tn_rewrite_along(tn_pass *pass, const tn_edge_replacement *chain)
{
    uint32_t d = pass->dart[2 * (size_t)chain->first], f = pass->sides[2 * (size_t)chain->first].face;
    uint32_t first = pass->old->face_first[f], size = tn_face_size(pass->old, f);
    for (uint32_t j = 0; j < chain->length; j++) {
        uint32_t edge = pass->old->side[first + (d - first + j) % size] / 2;
        pass->records[edge] = pass->records[chain->first];
        pass->runs[edge] = (tn_edge_run){chain->first, chain->last};
    }
}

static tn_status rewrite_list(tn_pass *pass, tn_error *error)
{
    tn_rewrite_tally total = {0};
    uint32_t edges = pass->old->edge_count, replaced = 0;
    for (size_t i = 0; i < pass->list_count; i++) {
        count(pass, pass->list[i].template, 1, &total);
        replaced += pass->list[i].length;
    }
    total.kept = edges - replaced;
    tn_status status = tn_rewrite_make_room(pass, &total, error);
    if (status != TN_OK)
        return status;
    pass->runs = malloc((edges ? edges : 1) * sizeof *pass->runs);
    if (!pass->runs)
        return tn_fail_memory(error);
    memset(pass->runs, 0xff, edges * sizeof *pass->runs);
    tn_rewrite_tally at = {.pieces = total.kept, .vertices = pass->old->vertex_count, .branches = pass->branch_first};
    placing some;
    start_placing(&some);
    bool fine = true;
    for (size_t i = 0; i < pass->list_count && fine; i++) {
        const tn_edge_replacement *one = &pass->list[i];
        fine = replace(pass, one->first, one->last, one->template, &at, &some);
        tn_rewrite_along(pass, one);
    }
    pass->out_of_range = !fine || !place_all(pass, &some);
    uint32_t kept = 0;
    for (uint32_t e = 0; e < edges; e++)
        if (pass->runs[e].first == TN_NONE)
            tn_rewrite_keep(pass, e, kept++);
    return TN_OK;
}

tn_status tn_rewrite_out_of_range(const tn_pass *pass, tn_error *error)
{
    return tn_fail(error, TN_LIMIT, E_GROWTH_AGE,
                   "in step %u an edge's age leaves the range of -%d to %d, or a coordinate that of numbers",
                   pass->growth->steps + 1, TN_AGE_MAX, TN_AGE_MAX);
}

tn_status tn_pass_rewrite(tn_pass *pass, tn_error *error)
{
    tn_status status = pass->list ? rewrite_list(pass, error) : rewrite_singly(pass, error);
    if (status != TN_OK)
        return status;
    if (pass->out_of_range)
        return tn_rewrite_out_of_range(pass, error);
    pass->growth->counts.rewrites += pass->rewrites;
    return TN_OK;
}

tn_status tn_growth_check_edges(const tn_growth *growth, uint64_t edges, tn_error *error)
{
    uint64_t limit = growth->options.edge_limit && growth->options.edge_limit < TN_EDGES_MAX
                         ? growth->options.edge_limit
                         : TN_EDGES_MAX;
    if (edges <= limit)
        return TN_OK;
    tn_fail(error, TN_LIMIT, E_GROWTH_EDGES, "step %u makes %llu edges; the limit is %llu", growth->steps + 1,
            (unsigned long long)edges, (unsigned long long)limit);
    tn_error_help(error, "take fewer steps, or raise the limit with --edge-limit (at most %u)", TN_EDGES_MAX);
    return TN_LIMIT;
}
