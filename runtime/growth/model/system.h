/* A HEMLS rewrite system, ready to grow: rules whose successors are constant templates.
 *
 * A module holds it as code: the moves of a turtle for each successor, a guard for each rule. Reading it runs the
 * turtle once through each successor: the path's points and the branches' directions become coordinates in
 * the frame of the edge that is replaced (H along the edge, L to its left, U out of the surface), with the edge from
 * (0,0,0) to (1,0,0). Growing moves no turtle after that, unless the interpreter is asked for.
 *
 * The arrays of a tn_growth_system belong to whoever made it (tn_growth_system_read's are freed with
 * tn_growth_system_free). It is immutable and may be shared between threads.
 *
 * Source: "Genr8" paper, sections 4.3 to 4.6; docs/growth.md for the readings where it is silent.
 */
#ifndef TARTAN_GROWTH_SYSTEM_H
#define TARTAN_GROWTH_SYSTEM_H

#include "runtime/base/error.h"
#include "runtime/geometry/vector.h"
#include "runtime/module/code.h"
#include "runtime/module/module.h"
#include "runtime/module/values.h"

/* How much a module's growth sections may hold beyond what records.def says of each field. */

#define TN_NO_LABEL TN_NO_RECORD
#define TN_LABELS_MAX 32767u       /* labels of one system: a label is 15 bits of an edge's state */
#define TN_TEMPLATES_MAX 65000u    /* successors of one system: 16 bits of what replaces an edge */
#define TN_AXIOM_MAX 100000u       /* edges of a seed */
#define TN_SURROUNDINGS_MAX 10000u /* forces, and boundaries, of one environment */

#define TN_EXPRESSIONS_MAX 64u /* named fitness expressions of one study */

typedef struct tn_template_segment {
    uint32_t label; /* index into the system's labels */
    uint8_t age;    /* tn_age_change */
    bool reversed;  /* runs against the path ('~') */
    double end[3];  /* the path's point after it; the last is (1,0,0) */
} tn_template_segment;

typedef struct tn_template_branch {
    uint32_t at; /* the path's point it leaves from: 0 .. segments */
    uint32_t label;
    uint8_t age;
    uint8_t side;  /* tn_side; TN_SIDE_NONE leaves along the path or straight out of the surface, and is dropped */
    bool reversed; /* '~': incoming */
    double turn;   /* angle from the path's outgoing direction, counter-clockwise, in [0, 2 pi): orders a corner */
    double direction[3]; /* unit vector */
} tn_template_branch;

typedef struct tn_template {
    const tn_template_segment *segments;
    const tn_template_branch *branches; /* in the order of the successor's text: this numbers branches */
    uint32_t segment_count;
    uint32_t branch_count;
} tn_template;

typedef struct tn_alternative {
    uint32_t template;   /* index into the system's templates */
    uint32_t comparison; /* tn_comparison of the edge's age with `bound` */
    double bound;
    double weight;
} tn_alternative;

typedef struct tn_growth_rule {
    uint32_t left, right; /* labels of the context at the edge's start and end, or TN_NO_LABEL */
    const tn_alternative *alternatives;
    uint32_t alternative_count;
    bool conditional; /* the first alternative that holds is taken; otherwise one by weight */
    double total;     /* of the weights; 0: the rule never applies */
    uint32_t guard;   /* its function */
} tn_growth_rule;

/* Rules of one predecessor, most specific context first, then in the file's order. */
typedef struct tn_growth_group {
    const uint32_t *labels; /* the predecessor: one label, or several for a chain of edges */
    uint32_t label_count;
    const tn_growth_rule *rules;
    uint32_t rule_count;
} tn_growth_group;

typedef struct tn_growth_label {
    uint32_t number;  /* the N of EdgeN */
    const char *name; /* as the file writes it: "Edge0" or "A" */
} tn_growth_label;

typedef struct tn_axiom_edge {
    uint32_t label;
    bool reversed;
} tn_axiom_edge;

typedef struct tn_growth_system {
    const char *name;
    const tn_growth_label *labels; /* ascending numbers */
    uint32_t label_count;
    const tn_axiom_edge *axiom; /* at least three */
    uint32_t axiom_count;
    const tn_growth_group *groups; /* in the order in which their predecessors first appear */
    uint32_t group_count;
    const tn_template *templates;
    uint32_t template_count;
    const uint32_t *successors; /* [template] its function, ascending */
    uint32_t level_count;       /* brackets that are open at once, at most */
    const tn_module *module;    /* whose code this is */
    double branch_angle;        /* degrees */
    bool sync;                  /* join once, after all groups */
    bool even;                  /* no join is decided by the order of branches */
} tn_growth_system;

/* The growth system of a verified module, in memory of its own that borrows the module's strings and code. TN_INVALID
 * if the module has none. The module has to outlive it. */
tn_status tn_growth_system_read(const tn_module *module, tn_growth_system **system, tn_error *error);
void tn_growth_system_free(tn_growth_system *system);

/* The template that a successor's function became. */
uint32_t tn_growth_template_of(const tn_growth_system *system, uint32_t successor);

/* The turtle that draws successors ("Genr8", 4.4; docs/growth.md): it carries out the moves of a seed's or successor's
 * code one by one, says what is wrong with them, and notes what it draws.
 *
 * The compiler checks a successor with it, the verifier a module's code, a system is made by it once (tn_turtle_draw),
 * and the interpreter lets it draw again for every edge. A turtle borrows all its memory from its caller. */

typedef struct tn_turtle_frame {
    tn_vector heading, left, up;
} tn_turtle_frame;

/* What an open bracket keeps. */
typedef struct tn_turtle_level {
    tn_turtle_frame frame;
    uint32_t flip; /* one that waited when it opened: it counts inside and after */
    bool drew;     /* an edge of its own */
    bool holds;    /* a bracket that draws one */
} tn_turtle_level;

/* What can be wrong with a move: a set of these. */
#define TN_TURTLE_FULL 1u      /* the branch has drawn its edge already */
#define TN_TURTLE_UNOPENED 2u  /* there is no bracket to close */
#define TN_TURTLE_EMPTY 4u     /* the bracket that closes draws no edge */
#define TN_TURTLE_UNFLIPPED 8u /* no edge follows a flip */
#define TN_TURTLE_UNCLOSED 16u /* the path ends within a bracket */
#define TN_TURTLE_NO_PATH 32u  /* no edge outside the brackets */
#define TN_TURTLE_ASTRAY 64u   /* it does not end in the direction in which it started */
#define TN_TURTLE_CROWDED 128u /* more than TN_TEMPLATE_ITEMS_MAX edges, or brackets */
#define TN_TURTLE_NO_MOVE 256u /* an instruction that is no move */

typedef struct tn_turtle {
    tn_turtle_frame frame;
    tn_vector at;                 /* end of the path so far */
    uint32_t flip, flips;         /* the number of the flip that waits for its edge, or 0; how many there were */
    uint32_t depth;               /* open brackets */
    uint32_t edge_count;          /* edges of the path, */
    uint32_t branch_count;        /* of branches, */
    uint32_t brackets;            /* and brackets opened so far */
    double degrees, cosine, sine; /* of the last turn: most turn by the same angle */
    tn_turtle_level *levels;
    tn_template_segment *segments; /* where it draws; NULL: it only checks */
    tn_template_branch *branches;
} tn_turtle;

/* At the origin, heading along x, up along z. `levels` has room for as many brackets as will be open at once. */
void tn_turtle_start(tn_turtle *turtle, tn_turtle_level *levels);

/* Carries out a move. 0, or what is wrong with it; then it may not move on. */
unsigned tn_turtle_move(tn_turtle *turtle, const tn_instruction *move);

/* Runs a verified successor, draws into `segments` and `branches`, which have room for its edges, and fits the path to
 * lead from (0,0,0) to (1,0,0). */
tn_template tn_turtle_draw(const tn_module *module, uint32_t successor, tn_turtle_level *levels,
                           tn_template_segment *segments, tn_template_branch *branches);

#endif
