/* One rewriting pass over a map (internal to the growth engine).
 *
 * A step is one pass for all groups of rules (Sync) or one for each group. A pass reads the old map and writes a new
 * one:
 *
 *   survey   each edge side's vertex and face, each face's normal                            (match.c)
 *   match    which template, if any, replaces each edge                                      (match.c)
 *   rewrite  numbers and states of what replaces each edge, its vertices, its branches' aims  (rewrite.c)
 *   decide   which branches of each face join, and into which loops the face is cut           (decide.c)
 *   number   joined edges, by their lower branch; faces, by the order of their making         (rewrite.c, decide.c)
 *   stamp    every dart of the new map written once, in its place                             (stamp.c)
 *
 * Matching and rewriting have a plain way too, which interprets the rules' code for every edge (interpret.c).
 * Deciding one face is the work of join.c; pattern.c keeps what it found, and knows it again if another face has the
 * same edges replaced by the same templates.
 */
#ifndef TARTAN_GROWTH_PASS_PASS_H
#define TARTAN_GROWTH_PASS_PASS_H

#include "runtime/base/crew.h"
#include "runtime/geometry/vector.h"
#include "runtime/growth/environment/environment.h"
#include "runtime/growth/model/map.h"
#include "runtime/growth/model/options.h"
#include "runtime/growth/pass/pages.h"

#define TN_NONE UINT32_MAX
#define TN_NO_TEMPLATE UINT16_MAX
#define TN_CHUNK_EDGES 8192u /* work is cut in chunks of fixed size, so that results do not depend on threads */
#define TN_CHUNK_FACES 1024u
#define TN_CHUNK_VERTICES 4096u

/* A template as walked along one side: pieces and branches in the order in which a face's loop meets them. */
typedef struct tn_walk {
    uint16_t index; /* of the segment or of the branch */
    bool branch;
    bool reversed; /* segment: runs against the path */
    uint16_t at;   /* the path's point: where the dart starts, or the branch leaves */
} tn_walk;

/* A segment's state from that of the edge it replaces: (old & kept) + added. */
typedef struct tn_piece {
    tn_edge_state kept, added;
} tn_piece;

typedef struct tn_shape {
    const tn_template *template;
    tn_piece *pieces;      /* [segment] */
    tn_walk *left, *right; /* left: along the path; right: back */
    uint32_t left_count, right_count;
    uint32_t left_branches, right_branches;
    bool end_branches; /* some branch leaves from an end of the path, a vertex that was there before */
} tn_shape;

/* What becomes of an edge: the numbers that writing it needs. The edges of a chain that is replaced as one have the
 * same.
 */
typedef struct tn_record {
    uint32_t side;     /* first new edge's, along it; of a kept edge, its own */
    uint32_t vertex;   /* first new vertex, at the path's point 1; kept: 0 */
    uint32_t branch;   /* first branch; kept: the first of all, so that asking ahead for it needs no condition */
    uint16_t template; /* TN_NO_TEMPLATE: it is kept */
    int16_t age;       /* of the replaced edge */
} tn_record;

/* All that most faces need to know of a branch to join it. The direction is rounded; where that could decide anything,
 * tn_pass_frame works it out again. */
typedef struct tn_aim {
    float direction[3];
    uint32_t beyond; /* the old map's face on the other side of the edge that it leaves */
} tn_aim;

/* One side of an edge. */
typedef struct tn_edge_side {
    uint32_t origin; /* the vertex it starts at */
    uint32_t face;   /* that it is on */
} tn_edge_side;

typedef struct tn_edge_run {
    uint32_t first, last; /* edges of a chain */
} tn_edge_run;

/* A branch that did not join yet. */
typedef struct tn_pending {
    double direction[3];
    uint32_t dart;       /* it lies in the corner before this dart (while faces are decided: of its face's cut) */
    uint32_t face, loop; /* while faces are decided: the face, and which loop of its cut */
    uint32_t id;
    uint32_t label;
    int32_t age;
    bool reversed;
} tn_pending;

typedef struct tn_pending_list {
    tn_pending *items; /* by face; within a face in the order of its loop */
    size_t count;
    uint32_t *face_first; /* [face_count + 1] */
} tn_pending_list;

/* Memory that steps use again and again. Of what is read and written anew, two each: `current` says which is the map's.
 */
typedef struct tn_growth_workspace {
    tn_pages positions, states[2], darts[2], faces[2];
    tn_pages survey, choices, chunks, records, joints, cut_of, made;
    int current;
    struct tn_decider *deciders; /* [decider_count] one for each thread */
    int decider_count;
} tn_growth_workspace;

struct tn_growth {
    const tn_growth_system *system;
    const tn_environment *environment;
    tn_growth_options options;
    double branch_cosine;  /* -cos(branch angle) + 1e-9: joined directions' product is at most this */
    tn_shape *shapes;      /* [template] */
    tn_walk *walks;        /* storage of the shapes, */
    tn_piece *pieces;      /* and this */
    uint32_t *group_of;    /* [label] the group whose whole predecessor it is, or TN_NONE */
    uint16_t *template_of; /* [label] of a pass */
    bool weighted;         /* some choice is random */
    bool ranked;           /* faces have ranks (see tn_growth_step) */
    bool waited;           /* some face has had to wait for others: they are needed */
    bool needs_ranks;      /* one has to, and faces have no ranks any more */
    bool hard;             /* some boundary moves vertices */
    tn_growth_workspace space;
    tn_crew *crew; /* of options.threads; its watch is that of the options */
    tn_map map;
    uint32_t steps;
    double length;  /* start_length times the mean scale to the power of the steps */
    uint64_t draws; /* random numbers used */
    tn_pending_list pending;
    uint32_t branches; /* numbers given in this step */
    tn_growth_counts counts;
    bool moved; /* did any vertex move in the last step */
    bool at_rest;
    uint64_t fingerprint; /* of the map after the last step, where it kept its size */
    bool has_fingerprint;
};

typedef struct tn_pass {
    tn_growth *growth;
    const tn_map *old;
    tn_map *new;
    uint32_t group_first, group_last; /* groups [first, last) */
    bool joins_last;                  /* what does not join now is dropped */
    /* survey */
    tn_edge_side *sides; /* [2 edge + against]; lie where the new map's darts will be: gone once faces are decided */
    double *normal;      /* [face][3] */
    uint32_t *dart;      /* [2 edge + against]; only where `walks_vertices` */
    bool walks_vertices; /* joining may ask who is around a vertex */
    /* match */
    const uint16_t *template_of;      /* [label] template or TN_NO_TEMPLATE, if labels alone decide; otherwise NULL */
    uint16_t *choice;                 /* [edge] the same, where they do not and no chains are replaced */
    struct tn_edge_replacement *list; /* where chains are replaced: all replacements, in order; otherwise NULL */
    size_t list_count;
    /* rewrite */
    tn_record *records;       /* [edge] */
    tn_aim *aims;             /* [branch - branch_first]; behind the sides */
    tn_edge_run *runs;        /* [edge] the chain that it was in; only where chains are replaced */
    uint32_t vertices, edges; /* of the new map, without joined edges */
    uint64_t rewrites;
    uint32_t branch_first, branch_count; /* numbers of this pass's branches: [first, first + count) */
    bool out_of_range;
    /* decide */
    uint32_t *joints; /* [branch] where it is a joined pair's lower one: the edge's state, then its number; others:
                         TN_NONE */
    uint32_t *cut_of; /* [face] how it is cut (pattern.h) */
    uint32_t *made;   /* [rank of a face] its joins, then the rank of the first face that they make; NULL: no ranks */
    struct tn_face_chunk *chunks;
    uint32_t chunk_count;
    /* stamp */
    bool has_lanes; /* the processor has them (stamp.h) */
} tn_pass;

/* Who works on a pass. */
static inline tn_crew *tn_pass_crew(const tn_pass *pass)
{
    return pass->growth->crew;
}

/* The template that replaces an edge, or TN_NO_TEMPLATE, if no chains are replaced. */
static inline uint16_t tn_choice(const tn_pass *pass, uint32_t edge)
{
    if (!pass->template_of)
        return pass->choice[edge];
    tn_edge_state state = pass->old->states[edge];
    return state & TN_STATE_FRESH ? TN_NO_TEMPLATE : pass->template_of[tn_state_label(state)];
}

static inline bool tn_is_kept(const tn_record *record)
{
    return record->template == TN_NO_TEMPLATE;
}

/* The age of what a successor draws, by the mark it has there (tn_age_change), from the age of what it replaces. */
static inline int32_t tn_changed_age(uint8_t change, int32_t age)
{
    return change == TN_AGE_KEEP ? age : change == TN_AGE_MORE ? age + 1 : change == TN_AGE_LESS ? age - 1 : 0;
}

typedef struct tn_edge_replacement {
    uint32_t first, last, length; /* edges of the chain */
    uint16_t template;
} tn_edge_replacement;

tn_status tn_pass_survey(tn_pass *pass, tn_error *error);

/* Room for the aims of this many branches behind the sides, which may move. False: out of memory. */
bool tn_pass_reserve_aims(tn_pass *pass, uint64_t count);

tn_status tn_pass_match(tn_pass *pass, tn_error *error);
tn_status tn_pass_rewrite(tn_pass *pass, tn_error *error);

/* The frame of what replaces the edges first .. last, unit vectors, and the length between their ends. Returns where it
 * begins. */
tn_vector tn_pass_frame(const tn_pass *pass, uint32_t first, uint32_t last, tn_vector *heading, tn_vector *up,
                        double *length);

tn_status tn_pass_decide(tn_pass *pass, tn_error *error);
tn_status tn_pass_stamp(tn_pass *pass, tn_error *error);
tn_status tn_pass_faces(tn_pass *pass, tn_error *error);
tn_status tn_pass_number_joints(const tn_pass *pass, tn_error *error);

/* TN_LIMIT if a step makes more edges than the options allow. */
tn_status tn_growth_check_edges(const tn_growth *growth, uint64_t edges, tn_error *error);
tn_status tn_growth_displace(tn_growth *growth, tn_error *error);

/* What both ways of rewriting share: counting, room and numbers for what replaces edges (internal to the growth
 * engine). */

/* How many of each, so far or in a chunk. */
typedef struct tn_rewrite_tally {
    uint64_t rewrites, kept, pieces, vertices, branches;
} tn_rewrite_tally;

/* Memory for what the counts say, and the first numbers of each kind. */
tn_status tn_rewrite_make_room(tn_pass *pass, const tn_rewrite_tally *total, tn_error *error);

/* An edge that is not replaced gets this number. */
static inline void tn_rewrite_keep(tn_pass *pass, uint32_t edge, uint32_t number)
{
    pass->records[edge] = (tn_record){2 * number, 0, pass->branch_first, TN_NO_TEMPLATE, 0};
    tn_edge_state state = pass->old->states[edge];
    pass->new->states[number] = pass->joins_last ? state & ~TN_STATE_FRESH : state;
}

/* The record of a chain's first edge becomes that of all. */
void tn_rewrite_along(tn_pass *pass, const tn_edge_replacement *chain);

/* TN_LIMIT: an age or a coordinate left its range. */
tn_status tn_rewrite_out_of_range(const tn_pass *pass, tn_error *error);

/* The plain way of a pass, which the fast one is held against: every edge asks the guards' code for its successor, and
 * the turtle runs the successor's code for every edge that is replaced (internal to the growth engine).
 *
 * It has no table of templates by label, no bits of contexts, no chunks and no rows. Joining and all that follows is
 * the same for both ways. */

/* As tn_pass_match: all replacements, in order, in the pass's list. */
tn_status tn_interpret_match(tn_pass *pass, tn_error *error);

/* As tn_pass_rewrite, of that list. */
tn_status tn_interpret_rewrite(tn_pass *pass, tn_error *error);

#endif
