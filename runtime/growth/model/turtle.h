/* The turtle that draws successors ("Genr8", 4.4; docs/growth.md): it carries out the moves of a seed's or successor's
 * code one by one, says what is wrong with them, and notes what it draws.
 *
 * The compiler checks a successor with it, the verifier a module's code, a system is made by it once (tn_turtle_draw),
 * and the interpreter lets it draw again for every edge. A turtle borrows all its memory from its caller.
 */
#ifndef TARTAN_GROWTH_TURTLE_H
#define TARTAN_GROWTH_TURTLE_H

#include "runtime/geometry/vector.h"
#include "runtime/growth/model/system.h"
#include "runtime/module/code.h"

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
