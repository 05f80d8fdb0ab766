/* What replaces each edge: numbers of its pieces, vertices and branches, its frame, the new vertices' positions and the
 * pieces' states. New edges are numbered: kept ones in their order, then pieces in the order of replacement. */
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/map/pass.h"
#include "runtime/map/share.h"

#define AHEAD 12u /* edges */

/* How many of each, so far or in a chunk. */
typedef struct tally_counts {
    uint64_t records, kept, pieces, vertices, branches;
} tally_counts;

/* U is the sum of the unit normals of the edge's faces made normal to H; where they cancel or are along H, the left
 * face's, z, then x. */
static tn_vector up_of(tn_vector both, tn_vector left, tn_vector heading)
{
    tn_vector candidates[] = {both, left, {0, 0, 1}, {1, 0, 0}};
    for (int i = 0; i < 4; i++) {
        tn_vector up = tn_along(candidates[i], heading, -tn_dot(candidates[i], heading));
        double length2 = tn_dot(up, up);
        if (length2 > 1e-18)
            return tn_scale(up, 1 / sqrt(length2));
    }
    return (tn_vector){0, 0, 1};
}

static inline tn_vector make_frame(const tn_pass *pass, tn_edge_side from, tn_edge_side to, tn_vector *heading,
                                   tn_vector *up, double *length)
{
    tn_vector a = tn_vector_at(pass->old->positions + 3 * (size_t)from.origin);
    tn_vector h = tn_sub(tn_vector_at(pass->old->positions + 3 * (size_t)to.origin), a);
    *length = tn_norm(h);
    h = *length > 1e-300 ? tn_scale(h, 1 / *length) : (tn_vector){1, 0, 0};
    tn_vector left = tn_vector_at(pass->normal + 3 * (size_t)from.face);
    *heading = h;
    *up = up_of(tn_add(left, tn_vector_at(pass->normal + 3 * (size_t)to.face)), left, h);
    return a;
}

tn_vector tn_pass_frame(const tn_pass *pass, uint32_t first, uint32_t last, tn_vector *heading, tn_vector *up,
                        double *length)
{
    return make_frame(pass, pass->sides[2 * (size_t)first], pass->sides[2 * (size_t)last + 1], heading, up, length);
}

static tn_quad rounded(tn_vector a)
{
    typedef double four __attribute__((vector_size(32)));
    return __builtin_convertvector(((four){a.x, a.y, a.z, 0}), tn_quad);
}

/* Frame and new vertices of what replaces the edges first .. last. False where a coordinate leaves its range. */
static inline bool place(const tn_pass *pass, uint32_t first, uint32_t last, const tn_template *template,
                         const tn_record *record, tn_frame *frame)
{
    const tn_growth *growth = pass->growth;
    tn_edge_side from = pass->sides[2 * (size_t)first], to = pass->sides[2 * (size_t)last + 1];
    tn_vector h, u;
    double length;
    tn_vector a = make_frame(pass, from, to, &h, &u, &length), l = tn_cross(u, h);
    *frame = (tn_frame){rounded(h), rounded(l),     rounded(u),       from.face,
                        to.face,    record->branch, record->template, record->age};
    double *at = pass->new->positions + 3 * (size_t)record->vertex;
    double wild = 0; /* what is no finite number stays none when subtracted from itself */
    for (uint32_t j = 0; j + 1 < template->segment_count; j++) {
        const double *c = template->segments[j].end;
        tn_vector p = tn_along(a, tn_along(tn_along(tn_scale(h, c[0]), l, c[1]), u, c[2]), length);
        if (growth->hard)
            p = tn_environment_place(growth->environment, p, a, tn_along(a, h, length));
        tn_vector_put(at + 3 * (size_t)j, p);
        double sum = p.x + p.y + p.z;
        wild += sum - sum;
    }
    return wild == 0;
}

/* Replaces the edges first .. last; `at` holds the numbers that come next. False where an age or a coordinate leaves
 * its range. */
static bool replace(tn_pass *pass, uint32_t first, uint32_t last, uint16_t chosen, tally_counts *at)
{
    const tn_template *template = &pass->growth->system->templates[chosen];
    int32_t age = tn_state_age(pass->old->states[first]);
    tn_record record = {(uint32_t)at->pieces, (uint32_t)at->vertices, (uint32_t)at->branches, chosen, (int16_t)age};
    pass->records[at->records] = record;
    if (pass->runs)
        pass->runs[at->records] = (tn_run){first, last};
    if (!place(pass, first, last, template, &record, &pass->frames[at->records]))
        return false;
    bool fresh = !pass->joins_last;
    for (uint32_t j = 0; j < template->segment_count; j++) {
        int32_t now = tn_changed_age(template->segments[j].age, age);
        if (now > TN_AGE_MAX || now < -TN_AGE_MAX)
            return false;
        pass->new->states[at->pieces + j] = tn_state(template->segments[j].label, now, fresh);
    }
    at->records++;
    at->pieces += template->segment_count;
    at->vertices += template->segment_count - 1;
    at->branches += template->branch_count;
    return true;
}

static void count(const tn_pass *pass, uint16_t chosen, tally_counts *so_far)
{
    const tn_template *template = &pass->growth->system->templates[chosen];
    so_far->records++;
    so_far->pieces += template->segment_count;
    so_far->vertices += template->segment_count - 1;
    so_far->branches += template->branch_count;
}

/* Memory for what the counts say, and the first numbers of each kind. */
static tn_status make_room(tn_pass *pass, const tally_counts *total, tn_error *error)
{
    tn_growth *growth = pass->growth;
    const tn_map *old = pass->old;
    uint64_t edges = total->kept + total->pieces;
    uint64_t limit = growth->options.edge_limit && growth->options.edge_limit < TN_EDGES_MAX
                         ? growth->options.edge_limit
                         : TN_EDGES_MAX;
    if (edges > limit || total->branches > TN_EDGES_MAX) {
        tn_fail(error, TN_LIMIT, 840, "step %u would make more than %llu edges", growth->steps + 1,
                (unsigned long long)limit);
        tn_error_help(error, "take fewer steps, or raise the limit with --edge-limit (at most %u)", TN_EDGES_MAX);
        return TN_LIMIT;
    }
    uint64_t vertices = (uint64_t)old->vertex_count + total->vertices;
    uint64_t most = edges + (total->branches + growth->pending.count) / 2;
    uint64_t bytes = 3 * sizeof(double) * vertices + (sizeof(tn_edge_state) + 4 * sizeof(uint32_t)) * most +
                     (sizeof(tn_record) + sizeof(tn_frame)) * total->records + sizeof(uint32_t) * total->branches +
                     40 * (uint64_t)old->edge_count;
    if (growth->options.memory_limit && bytes > growth->options.memory_limit) {
        tn_fail(error, TN_LIMIT, 841, "step %u would need about %llu MB of memory; the limit is %llu MB",
                growth->steps + 1, (unsigned long long)(bytes >> 20),
                (unsigned long long)(growth->options.memory_limit >> 20));
        tn_error_help(error, "take fewer steps, or raise the limit with --memory-limit");
        return TN_LIMIT;
    }
    pass->vertices = (uint32_t)vertices;
    pass->edges = (uint32_t)edges;
    pass->record_count = (uint32_t)total->records;
    pass->branch_count = (uint32_t)total->branches;
    tn_workspace *space = &growth->space;
    if (!tn_pages_reserve(&space->positions, 3 * (size_t)vertices * sizeof(double)) ||
        !tn_pages_reserve(&space->states[!space->current], (size_t)most * sizeof(tn_edge_state)) ||
        !tn_pages_reserve(&space->records, (size_t)total->records * sizeof *pass->records) ||
        !tn_pages_reserve(&space->darts[!space->current], (size_t)total->records * sizeof *pass->frames) ||
        !tn_pages_reserve(&space->slots, (size_t)old->edge_count * sizeof *pass->slot))
        return tn_fail_memory(error);
    growth->map.positions = space->positions.data; /* vertices stay where they are; new ones follow them */
    pass->new->positions = space->positions.data;
    pass->new->states = space->states[!space->current].data;
    pass->records = space->records.data;
    pass->frames = space->darts[!space->current].data;
    pass->slot = space->slots.data;
    return TN_OK;
}

static void keep(tn_pass *pass, uint32_t edge, uint32_t number)
{
    pass->slot[edge] = TN_KEPT | number;
    tn_edge_state state = pass->old->states[edge];
    pass->new->states[number] = pass->joins_last ? state & ~TN_STATE_FRESH : state;
}

/* ---- each edge on its own */

static uint32_t group_at(const tn_pass *pass, uint32_t edge)
{
    return pass->growth->group_of[tn_state_label(pass->old->states[edge])] - pass->group_first;
}

static void count_chunk(const tn_pass *pass, uint32_t begin, uint32_t end, tally_counts *by_group)
{
    for (uint32_t e = begin; e < end; e++) {
        if (pass->choice[e] == TN_NO_TEMPLATE)
            by_group[0].kept++;
        else
            count(pass, pass->choice[e], &by_group[group_at(pass, e)]);
    }
}

/* What an edge's frame needs lies all over memory: asked for some edges ahead, it is there in time. */
static inline __attribute__((always_inline)) void prefetch(const tn_pass *pass, uint32_t edge)
{
    for (size_t side = 2 * (size_t)edge; side < 2 * (size_t)edge + 2; side++) {
        __builtin_prefetch(pass->old->positions + 3 * (size_t)pass->sides[side].origin);
        __builtin_prefetch(pass->normal + 3 * (size_t)pass->sides[side].face);
    }
}

static bool rewrite_chunk(tn_pass *pass, uint32_t begin, uint32_t end, tally_counts *by_group)
{
    bool fine = true;
    for (uint32_t e = begin; e < end && fine; e++) {
        if (e + AHEAD < end && pass->choice[e + AHEAD] != TN_NO_TEMPLATE)
            prefetch(pass, e + AHEAD);
        if (pass->choice[e] == TN_NO_TEMPLATE) {
            keep(pass, e, (uint32_t)by_group[0].kept++);
            continue;
        }
        tally_counts *at = &by_group[group_at(pass, e)];
        pass->slot[e] = (uint32_t)at->records;
        fine = replace(pass, e, e, pass->choice[e], at);
    }
    return fine;
}

/* Counts become first numbers: groups in order, chunks of edges in order within each. Returns the totals. */
static tally_counts number(tn_pass *pass, tally_counts *counts, uint32_t chunks, uint32_t groups)
{
    tally_counts next = {0};
    for (uint32_t g = 0; g < groups; g++) {
        for (uint32_t c = 0; c < chunks; c++) {
            tally_counts *one = &counts[(size_t)c * groups + g], here = *one;
            *one = next;
            next.records += here.records;
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
    tally_counts *counts; /* by chunk, then group */
    atomic_bool out_of_range;
} single_rewrite;

static uint32_t chunk_end(const tn_pass *pass, uint32_t chunk)
{
    uint32_t edges = pass->old->edge_count, begin = chunk * TN_CHUNK_EDGES;
    return edges - begin < TN_CHUNK_EDGES ? edges : begin + TN_CHUNK_EDGES;
}

static tally_counts *counts_of(const single_rewrite *r, uint32_t chunk)
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
    tn_share(pass->threads, chunks, TN_SHARE_EVENLY, count_piece, &r);
    tally_counts total = number(pass, r.counts, chunks, groups);
    tn_status status = make_room(pass, &total, error);
    if (status == TN_OK)
        tn_share(pass->threads, chunks, TN_SHARE_EVENLY, rewrite_piece, &r);
    pass->out_of_range = r.out_of_range;
    free(r.counts);
    return status;
}

/* ---- chains */

static tn_status rewrite_list(tn_pass *pass, tn_error *error)
{
    tally_counts total = {0};
    uint32_t edges = pass->old->edge_count, replaced = 0;
    for (size_t i = 0; i < pass->list_count; i++) {
        count(pass, pass->list[i].template, &total);
        replaced += pass->list[i].length;
    }
    total.kept = edges - replaced;
    tn_status status = make_room(pass, &total, error);
    if (status != TN_OK)
        return status;
    pass->runs = malloc((total.records ? total.records : 1) * sizeof *pass->runs);
    if (!pass->runs)
        return tn_fail_memory(error);
    memset(pass->slot, 0xff, edges * sizeof *pass->slot);
    tally_counts at = {.pieces = total.kept, .vertices = pass->old->vertex_count, .branches = pass->branch_first};
    for (size_t i = 0; i < pass->list_count; i++) {
        const tn_replacement *one = &pass->list[i];
        uint32_t d = pass->dart[2 * (size_t)one->first], f = pass->sides[2 * (size_t)one->first].face;
        uint32_t first = pass->old->face_first[f], size = tn_face_size(pass->old, f);
        for (uint32_t j = 0; j < one->length; j++)
            pass->slot[pass->old->side[first + (d - first + j) % size] / 2] = (uint32_t)at.records;
        if (!replace(pass, one->first, one->last, one->template, &at)) {
            pass->out_of_range = true;
            return TN_OK;
        }
    }
    uint32_t kept = 0;
    for (uint32_t e = 0; e < edges; e++)
        if (pass->slot[e] == TN_NONE)
            keep(pass, e, kept++);
    return TN_OK;
}

tn_status tn_pass_rewrite(tn_pass *pass, tn_error *error)
{
    tn_status status = pass->list ? rewrite_list(pass, error) : rewrite_singly(pass, error);
    if (status != TN_OK)
        return status;
    if (pass->out_of_range) {
        tn_fail(error, TN_LIMIT, 843,
                "in step %u an edge's age leaves the range of -%d to %d, or a coordinate that of numbers",
                pass->growth->steps + 1, TN_AGE_MAX, TN_AGE_MAX);
        return TN_LIMIT;
    }
    pass->growth->counts.rewrites += pass->record_count;
    return TN_OK;
}
