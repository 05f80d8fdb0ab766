/* Faces alike: the same edges replaced by the same templates, one after another round the face.
 *
 * What joins in such faces, and how they are then cut, depends only on how the branches lie: which pairs are opposed
 * and which are nearer. So the first face of each pattern and order of pairs is worked out by join.c, and
 * what they find is kept as a cut of references; of every other face only the directions (and where pairs compete or
 * make several faces, the distances) are worked out. A regular surface of millions of faces has a handful of patterns.
 *
 * A face is no pattern's, and is worked out by itself, where it is long or has many branches, has branches that wait
 * from an earlier pass or at old vertices, or where another face might join the same vertices.
 *
 * Each thread has its own patterns. They depend on the system alone and are kept from step to step.
 */
#ifndef TARTAN_GROWTH_JOIN_PATTERN_H
#define TARTAN_GROWTH_JOIN_PATTERN_H

#include <string.h>

#include "runtime/base/hash_table.h"
#include "runtime/growth/join/join.h"

/* How faces are cut: the loops that each falls into where its branches joined (internal to the growth engine).
 *
 * A cut lists the new loops' darts one after another. The cut of a single face holds their vertices and sides as they
 * are. A pattern's cut (pattern.h) serves many faces and holds them as references: an entry of the face's table of
 * bases, plus something. The cuts that a tn_cuts holds are its own; a cut is named by its index. */

#define TN_CUT_PLAIN TN_NONE          /* no branches: one loop, each edge's pieces in place of it */
#define TN_CUT_OF_PATTERN 0x80000000u /* the rest is the index of a pattern's cut */

typedef struct tn_cut_loop {
    uint32_t end;    /* of its darts in the cut; they begin where the last loop ends */
    uint32_t region; /* 0: it keeps the face's rank; n: it is the face that the n-th join made */
} tn_cut_loop;

typedef struct tn_cut_join {
    uint32_t one, other;           /* branches: numbers, or references */
    uint32_t one_dart, other_dart; /* the new edge's two darts in the cut */
    bool directed;                 /* it runs from one to the other; else from the lower to the higher number */
    bool aged;                     /* references: its age depends on those of the edges that its branches left */
    tn_edge_state state;           /* references: the new edge's, unless it is aged */
} tn_cut_join;

/* A branch that did not join. */
typedef struct tn_cut_waiting {
    uint32_t branch; /* of the loop that was cut, or a reference */
    uint32_t loop;
    uint32_t dart; /* it lies in the corner before this dart of the cut */
} tn_cut_waiting;

typedef struct tn_cut {
    size_t dart_first, loop_first, join_first, waiting_first;
    uint32_t dart_count, loop_count, join_count, waiting_count;
} tn_cut;

typedef struct tn_cuts {
    tn_cut *items;
    uint32_t *origins, *sides; /* [dart]; a joined edge's side: TN_NONE, or anything where they are references */
    tn_cut_loop *loops;
    tn_cut_join *joins;
    tn_cut_waiting *waiting;
    size_t count, dart_count, loop_count, join_count, waiting_count;
    size_t room, dart_room, loop_room, join_room, waiting_room;
} tn_cuts;

void tn_cuts_clear(tn_cuts *cuts);

/* No cuts any more; keeps its memory. */
void tn_cuts_empty(tn_cuts *cuts);

/* Adds the cut of a face whose branches joined (tn_loop_join_branches). `waiting`: with those that did not. False: out
 * of memory. */
bool tn_cuts_add(tn_cuts *cuts, tn_loop *loop, bool waiting);

/* ---- references: which entry of the table of bases, and how far from it */

enum { TN_BASE_SIDE, TN_BASE_VERTEX, TN_BASE_BRANCH, TN_BASE_ORIGIN, TN_BASES }; /* for each dart of the face */

static inline uint32_t tn_refer(uint32_t dart, uint32_t base, uint32_t more)
{
    return (dart * TN_BASES + base) << 16 | more;
}

static inline uint32_t tn_referred(const uint32_t *bases, uint32_t reference)
{
    return bases[reference >> 16] + (reference & 0xffff);
}

static inline uint32_t tn_reference_dart(uint32_t reference)
{
    return (reference >> 16) / TN_BASES;
}

/* Writes the sides of a joined edge into a cut's darts, where its branches' numbers are known. */
static inline void tn_write_joint(const tn_pass *pass, const tn_cut_join *join, uint32_t one, uint32_t other,
                                  uint32_t *sides)
{
    uint32_t later = other < one, edge = pass->joints[later ? other : one], turned = later & !join->directed;
    sides[join->one_dart] = 2 * edge + turned;
    sides[join->other_dart] = 2 * edge + !turned;
}

/* What a dart of a face became: the first numbers of its pieces' sides, its new vertices and its branches (all 0 but
 * the side where the edge is kept), and the vertex that it leaves. */
static inline void tn_dart_bases(const tn_pass *pass, uint32_t dart, uint32_t bases[TN_BASES])
{
    uint32_t side = pass->old->side[dart];
    const tn_record *record = &pass->records[side / 2];
    memcpy(bases, record, 3 * sizeof *bases); /* side, vertex and branch */
    bases[TN_BASE_SIDE] += side & tn_is_kept(record);
    bases[TN_BASE_ORIGIN] = pass->old->origin[dart];
}

#define TN_PATTERN_DARTS 16u

typedef struct tn_patterns {
    struct tn_pattern *items;
    struct tn_variant *variants;
    size_t count, room, variant_count, variant_room;
    tn_hash_table table; /* of patterns */
    tn_cuts cuts;
} tn_patterns;

void tn_patterns_clear(tn_patterns *patterns);

/* No patterns any more; keeps their memory. */
void tn_patterns_forget(tn_patterns *patterns);

/* How an interior face is cut: the index of one of patterns->cuts, its branches that joined noted in pass->joints;
 * TN_NONE if the face has to be worked out by itself. `loop` is used in between. False: out of memory. */
bool tn_patterns_decide(tn_patterns *patterns, const tn_pass *pass, uint32_t face, tn_loop *loop, uint32_t *cut);

#endif
