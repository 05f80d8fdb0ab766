/* One rewriting pass over a map (internal to the growth engine).
 *
 * A step is one pass for all groups of rules (Sync) or one for each group. A pass reads the old map and writes a new
 * one:
 *
 *   survey   each edge's ends and faces, each face's normal               (survey.c)
 *   match    which template, if any, replaces each edge                   (match.c)
 *   rewrite  numbers, states and new vertices of what replaces each edge  (rewrite.c)
 *   faces    each face's loop with its pieces and branches; branches      (faces.c, join.c)
 *            joined; the loops that result written out
 *   number   joined edges numbered by their lower branch                  (number.c)
 */
#ifndef TARTAN_MAP_PASS_H
#define TARTAN_MAP_PASS_H

#include "runtime/map/growth.h"
#include "runtime/map/pages.h"

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

typedef struct tn_shape {
    const tn_template *template;
    tn_walk *left, *right; /* left: along the path; right: back */
    uint32_t left_count, right_count;
    uint32_t left_branches, right_branches;
    bool end_branches; /* some branch leaves from an end of the path, a vertex that was there before */
} tn_shape;

/* What replaces an edge (or a chain of edges). */
typedef struct tn_record {
    double heading[3], up[3]; /* frame of the edge */
    uint32_t child;           /* first new edge */
    uint32_t vertex;          /* first new vertex, at the path's point 1 */
    uint32_t branch;          /* first branch */
    uint32_t left, right;     /* faces of the old map */
    uint16_t template;
    int16_t age; /* of the replaced edge */
} tn_record;

typedef struct tn_run {
    uint32_t first, last; /* edges of a chain */
} tn_run;

/* A branch that did not join yet. */
typedef struct tn_pending {
    double direction[3];
    uint32_t dart; /* it lies in the corner before this dart */
    uint32_t id;
    uint32_t label;
    int32_t age;
    bool reversed;
} tn_pending;

typedef struct tn_pending_list {
    tn_pending *items; /* by face; within a face in the order of its loop */
    size_t count, capacity;
    uint32_t *face_first; /* [face_count + 1] */
} tn_pending_list;

/* Memory that steps use again and again. Of what is read and written anew, two each: `current` says which is the map's.
 */
typedef struct tn_workspace {
    tn_pages positions, states[2], darts[2], faces[2];
    tn_pages ends, slots, records, joints, made;
    struct tn_chunk *chunks; /* of faces being worked out */
    uint32_t chunk_count;
    int current;
} tn_workspace;

struct tn_growth {
    const tn_growth_system *system;
    const tn_environment *environment;
    tn_growth_options options;
    double branch_cosine; /* -cos(branch angle) + 1e-9: joined directions' product is at most this */
    tn_shape *shapes;     /* [template] */
    tn_walk *walks;       /* storage of the shapes */
    uint32_t *group_of;   /* [label] the group whose whole predecessor it is, or TN_NONE */
    bool weighted;        /* some choice is random */
    bool hard;            /* some boundary moves vertices */
    tn_workspace space;
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
    int threads;
    /* survey */
    uint32_t *end;       /* [2 edge + against] the vertex that side starts at */
    uint32_t *face;      /* [2 edge + against] its face */
    double *normal;      /* [face][3] */
    uint32_t *dart;      /* [2 edge + against]; only where old vertices have branches */
    bool walks_vertices; /* `dart` is needed, and `end` and `face` are kept */
    /* match */
    uint16_t *choice;            /* [edge] template or TN_NO_TEMPLATE */
    struct tn_replacement *list; /* where chains are replaced: all replacements, in order; otherwise NULL */
    size_t list_count;
    /* rewrite */
    uint32_t *slot; /* [edge] its record, or TN_KEPT | its new number */
    tn_record *records;
    uint32_t record_count;
    tn_run *runs;                        /* [record]; only where chains are replaced */
    uint32_t vertices, edges;            /* of the new map, without joined edges */
    uint32_t branch_first, branch_count; /* numbers of this pass's branches: [first, first + count) */
    bool out_of_range;
    /* faces */
    uint32_t *joints;        /* [branch number] of the lower branch: the joined edge's first dart; TN_NONE: none */
    uint32_t *made_first;    /* [old face's rank] the number of its first join, in the order of storage */
    uint32_t *made_count;    /* [old face's rank] its joins; then the rank of the first face that they made */
    uint32_t *pending_first; /* [new face] where its waiting branches begin; only where joins are tried again */
} tn_pass;

#define TN_KEPT 0x80000000u

typedef struct tn_replacement {
    uint32_t first, last, length; /* edges of the chain */
    uint16_t template;
} tn_replacement;

tn_status tn_pass_survey(tn_pass *pass, tn_error *error);
tn_status tn_pass_match(tn_pass *pass, tn_error *error);
tn_status tn_pass_rewrite(tn_pass *pass, tn_error *error);
tn_status tn_pass_faces(tn_pass *pass, tn_error *error);
tn_status tn_pass_number_joints(tn_pass *pass, tn_error *error);
void tn_chunks_free(struct tn_chunk *chunks, uint32_t count);
tn_status tn_growth_displace(tn_growth *growth, tn_error *error);

#endif
