/* A HEMLS rewrite system, ready to grow: rules whose successors are constant templates.
 *
 * A module holds it as code: the moves of a turtle for each successor, a guard for each rule. Reading it runs the
 * turtle once through each successor (turtle.h): the path's points and the branches' directions become coordinates in
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

#endif
