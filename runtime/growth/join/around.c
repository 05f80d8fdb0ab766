/* Finds what lies around a vertex of the old map. */
#include "runtime/growth/join/around.h"

/* A dart on its way round a vertex of the old map. Hubs have very many faces, and faces very many vertices: of two ways
 * round that answer a question, both are gone side by side until the shorter one is over. */
typedef struct walker {
    uint32_t start, dart, face;
} walker;

static walker walk_around(uint32_t face, const tn_loop_branch *branch)
{
    return (walker){branch->corner, branch->corner, face};
}

/* To the next dart of the vertex; false where that is the first. */
static bool turn(const tn_pass *pass, walker *at)
{
    const tn_map *old = pass->old;
    bool first = at->dart == old->face_first[at->face];
    uint32_t arriving = (first ? old->face_first[at->face + 1] : at->dart) - 1, side = old->side[arriving] ^ 1;
    at->dart = pass->dart[side];
    at->face = pass->sides[side].face;
    return at->dart != at->start;
}

/* The vertex at the other end of the first piece of what a dart's edge became. */
static uint32_t neighbour(const tn_pass *pass, uint32_t side)
{
    const tn_record *record = &pass->records[side / 2];
    if (tn_is_kept(record))
        return pass->sides[side ^ 1].origin;
    uint32_t pieces = pass->growth->shapes[record->template].template->segment_count;
    bool against = side & 1;
    if (pieces > 1)
        return against ? record->vertex + pieces - 2 : record->vertex;
    uint32_t far = side / 2;
    if (pass->runs)
        far = against ? pass->runs[far].first : pass->runs[far].last;
    return pass->sides[2 * (size_t)far + (against ? 0 : 1)].origin;
}

static bool old_vertices_linked(const tn_pass *pass, uint32_t face, const tn_loop_branch *a, uint32_t u,
                                const tn_loop_branch *b, uint32_t v)
{
    walker at_u = walk_around(face, a), at_v = walk_around(face, b);
    do {
        if (neighbour(pass, pass->old->side[at_u.dart]) == v || neighbour(pass, pass->old->side[at_v.dart]) == u)
            return true;
    } while (turn(pass, &at_u) && turn(pass, &at_v));
    return false;
}

/* Is a new vertex the first on its edge, from an old one? */
static bool next_to(const tn_pass *pass, const tn_loop_branch *new, uint32_t old_vertex)
{
    uint32_t edge = pass->old->side[new->corner] / 2;
    tn_edge_run run = pass->runs ? pass->runs[edge] : (tn_edge_run){edge, edge};
    uint32_t pieces = pass->growth->shapes[pass->records[edge].template].template->segment_count;
    return (new->point == 1 && pass->sides[2 * (size_t)run.first].origin == old_vertex) ||
           (new->point + 1 == pieces && pass->sides[2 * (size_t)run.last + 1].origin == old_vertex);
}

bool tn_linked_before(const tn_loop *loop, const tn_pass *pass, uint32_t face, const tn_loop_branch *a,
                      const tn_loop_branch *b)
{
    uint32_t u = loop->items[a->item].vertex, v = loop->items[b->item].vertex;
    bool a_new = a->beyond != TN_NONE, b_new = b->beyond != TN_NONE;
    if (a_new && b_new)
        return a->edge == b->edge && (a->point + 1 == b->point || b->point + 1 == a->point);
    if (a_new || b_new)
        return a_new ? next_to(pass, a, v) : next_to(pass, b, u);
    return old_vertices_linked(pass, face, a, u, b, v);
}

/* Is a vertex, in a dart of which a walk begins, on a face? */
static bool touches(const tn_pass *pass, walker at, uint32_t vertex, uint32_t face)
{
    const tn_map *old = pass->old;
    for (uint32_t d = old->face_first[face]; d < old->face_first[face + 1]; d++) {
        if (at.face == face || old->origin[d] == vertex)
            return true;
        if (!turn(pass, &at))
            return false;
    }
    return false;
}

bool tn_share_another_face(const tn_loop *loop, const tn_pass *pass, uint32_t face, const tn_loop_branch *a,
                           const tn_loop_branch *b)
{
    bool a_new = a->beyond != TN_NONE, b_new = b->beyond != TN_NONE;
    if (a_new && b_new)
        return a->beyond == b->beyond && a->beyond != TN_OUTER_FACE;
    uint32_t u = loop->items[a->item].vertex, v = loop->items[b->item].vertex;
    if (a_new)
        return a->beyond != TN_OUTER_FACE && touches(pass, walk_around(face, b), v, a->beyond);
    if (b_new)
        return b->beyond != TN_OUTER_FACE && touches(pass, walk_around(face, a), u, b->beyond);
    walker at_u = walk_around(face, a), at_v = walk_around(face, b);
    do {
        if ((at_u.face != face && at_u.face != TN_OUTER_FACE && touches(pass, walk_around(face, b), v, at_u.face)) ||
            (at_v.face != face && at_v.face != TN_OUTER_FACE && touches(pass, walk_around(face, a), u, at_v.face)))
            return true;
    } while (turn(pass, &at_u) && turn(pass, &at_v));
    return false;
}
