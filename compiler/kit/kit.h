/* What .kit files mean: connectors, parts as boxes of cells, spaces as conditions on a place, rules as placements.
 *
 * Checking fills a tn_kit, emitting writes it. Both live in the compilation's arena. Lengths are millionths of an LDU,
 * heights upwards; boxes and places are cells, y downwards, as the head has them. */
#ifndef TARTAN_COMPILER_KIT_KIT_H
#define TARTAN_COMPILER_KIT_KIT_H

#include "compiler/common/expression.h"
#include "compiler/common/import.h"
#include "compiler/common/names.h"
#include "compiler/common/parsing.h"
#include "compiler/common/token.h"
#include "compiler/common/words.h"
#include "runtime/place/model/frame.h"
#include "runtime/place/model/terms.h"
#include "runtime/place/part_file.h"

/* The syntax tree of .kit files: parts with connectors, and what is placed of them (docs/kit-language.md).
 *
 * Everything that a kit says is a node; which of a node's members say something, its kind tells. Nodes live in the
 * compilation's arena, which remembers where memory ran out. */

typedef struct tn_kit_text {
    const char *text; /* NULL: none */
    tn_span span;
} tn_kit_text;

/* A number with the name of what it counts: `4 studs`. */
typedef struct tn_kit_length {
    tn_span digits; /* without the sign */
    tn_span span;
    bool negative;
    tn_kit_text unit; /* LDU where there is none */
} tn_kit_length;

typedef struct tn_kit_vector {
    tn_kit_length at[3];
    tn_span span;
    bool given;
} tn_kit_vector;

typedef enum tn_kit_kind {
    /* of a file */
    TN_KIT_UNIT,      /* size, count[0]: turns */
    TN_KIT_LENGTH,    /* name, size[0] */
    TN_KIT_CONNECTOR, /* name, other: what it joins, count[0]: turns, size[0]: distance in a grid */
    TN_KIT_PART,      /* name, doc, inner: FILL, HAS, MASS, PRICE; outer: `from ldraw`, other: a file, or none */
    TN_KIT_SPACE,     /* name, inner: one of a space */
    TN_KIT_RULE,      /* name, outer: NAMED connectors, inner: PLACES and DRAWN */
    TN_KIT_MODEL,     /* name, doc, inner: INSIDE, START, COLOUR, REQUIRES and what follows these */
    TN_KIT_TEST,      /* name: of a model, inner: CONDITION */
    /* of a part */
    TN_KIT_FILL,  /* size, at; of a slope doc: the word, name, other: the sides between which it is */
    TN_KIT_HAS,   /* name: of a connector, other: its axis, count: of a grid, at */
    TN_KIT_MASS,  /* count[0] */
    TN_KIT_PRICE, /* count[0] */
    /* of a space */
    TN_KIT_SHAPE, /* name, inner: LENGTH */
    TN_KIT_FILED, /* name, doc: a file, other: the axis that is up; inner: LENGTH, perhaps none */
    TN_KIT_NAMED, /* name */
    TN_KIT_BOTH,
    TN_KIT_EITHER,
    TN_KIT_NOT,
    TN_KIT_MOVED,    /* inner: one, at */
    TN_KIT_TURNED,   /* inner: one, count[0] */
    TN_KIT_REPEATED, /* inner: one, count[0], at */
    /* of a rule */
    TN_KIT_DRAWN,  /* inner: PLACES with weights */
    TN_KIT_PLACES, /* inner: PLACED, perhaps none; count[0]: weight */
    TN_KIT_PLACED, /* name: of a part; count[0]: colour; outer: NAMED rules to go on with; stops; at; count[1]: turns */
    /* of a model */
    TN_KIT_INSIDE,    /* inner: one of a space */
    TN_KIT_START,     /* name: of a connector, doc: its axis, at, count[0]: turns, other: a rule */
    TN_KIT_STANDS,    /* doc: a file, other: a rule */
    TN_KIT_COLOUR,    /* count[0] */
    TN_KIT_REQUIRES,  /* inner: CONDITION */
    TN_KIT_MINIMIZES, /* inner: one CONDITION, which is a number */
    TN_KIT_MAXIMIZES,
    TN_KIT_SEARCHES, /* name, count[0] */
    TN_KIT_REPEATS,  /* count[0]: turns; or name: mirror, other: an axis */
    TN_KIT_ORDERS,   /* name */
    TN_KIT_STEPS,    /* name, or count[0] */
    TN_KIT_STOCKS,   /* inner: STOCKED */
    TN_KIT_STOCKED,  /* name: of a part, count[0] */
    TN_KIT_CONDITION /* expression */
} tn_kit_kind;

typedef struct tn_kit_node tn_kit_node;

typedef struct tn_kit_nodes {
    tn_kit_node *first, *last;
} tn_kit_nodes;

struct tn_kit_node {
    tn_kit_kind kind;
    tn_span span;
    tn_kit_text name, doc, other;
    tn_kit_length size[3];
    tn_kit_length count[2]; /* plain numbers; not given where their span is empty */
    tn_kit_vector at;
    bool stops;
    uint32_t depth; /* of what it is in a space */
    tn_kit_nodes inner, outer;
    tn_expression *expression;
    tn_kit_node *next;
};

typedef struct tn_kit_use {
    tn_kit_text path;
    struct tn_kit_use *next;
} tn_kit_use;

typedef struct tn_kit_file {
    tn_kit_node *first, *last;
    struct {
        tn_kit_use *first, *last;
    } uses;
    bool damaged; /* something is missing because of errors already reported */
} tn_kit_file;

/* Parses the source as a .kit file. NULL if out of memory; errors are in the diagnostics. Its tokens go to `tokens`
 * where that is not NULL. */
tn_kit_file *tn_parse_kit(tn_arena *arena, tn_diagnostics *diagnostics, uint32_t file, tn_tokens *tokens);

/* The same for conditions alone, which become a test without a name. */
tn_kit_file *tn_parse_kit_conditions(tn_arena *arena, tn_diagnostics *diagnostics, uint32_t file);

void *tn_kit_lexer_new(tn_parsing *parse);
void tn_kit_lexer_free(void *scanner);

/* Constructors. */
tn_kit_node *tn_kit_node_new(tn_parsing *parse, tn_kit_kind kind, tn_span span, tn_kit_text name);
tn_kit_nodes tn_kit_nodes_add(tn_kit_nodes list, tn_kit_node *node);
tn_kit_node *tn_kit_space_of(tn_parsing *parse, tn_kit_kind kind, tn_span span, tn_kit_node *a, tn_kit_node *b);
void tn_kit_add(tn_parsing *parse, tn_kit_node *node);
void tn_kit_add_use(tn_parsing *parse, tn_kit_text path);

static inline bool tn_kit_given(const tn_kit_length *length)
{
    return length->span.end > length->span.begin;
}

/* ---- words: sets of the places of words.def, as TN_KIT_AT(RULE) | TN_KIT_AT(SPACE) */

enum tn_kit_place {
#define PLACE(ID, BLOCK, HEADS, WHERE) TN_KIT_PLACE_##ID,
#include "compiler/kit/words.def"
    TN_KIT_PLACE_COUNT
};
_Static_assert(TN_KIT_PLACE_COUNT < 64, "a set of places has a bit for each");
#define TN_KIT_AT(ID) (UINT64_C(1) << TN_KIT_PLACE_##ID)

extern const tn_vocabulary tn_kit_words;

enum { TN_KIT_PARTS_MAX = 10000, TN_KIT_GRID_MAX = 32, TN_KIT_ALTERNATIVES_MAX = 100000, TN_KIT_SLOPE_STEPS_MAX = 256 };

/* A connector of a part: 'up', 'down' or aside. */
typedef enum tn_kit_side { TN_KIT_UPWARD, TN_KIT_DOWNWARD, TN_KIT_ASIDE, TN_KIT_SIDE_COUNT } tn_kit_side;

typedef struct tn_kit_type {
    const tn_kit_node *node;
    struct tn_kit_type *joins;
    uint32_t turns, index;
    int64_t every; /* 0: not given */
    struct tn_kit_type *next;
} tn_kit_type;

typedef struct tn_kit_box {
    int32_t low[3], high[3];
    uint32_t fill; /* the number of its `fill` in the part, from 1 */
} tn_kit_box;

/* A box of which a corner is cut off, between two sides that meet; boxes `first` and following of its part are what is
 * left of its cells. */
typedef struct tn_kit_slope {
    tn_kit_box whole;
    tn_axis sides[2];
    uint32_t first, count;
} tn_kit_slope;

typedef struct tn_kit_joint {
    tn_kit_type *type;
    tn_axis axis;
    int32_t at[3];
} tn_kit_joint;

typedef struct tn_kit_part {
    const tn_kit_node *node;
    double mass, price;
    tn_kit_box *boxes;
    tn_kit_joint *joints;
    tn_kit_slope *slopes;
    uint32_t box_count, joint_count, slope_count, index;
    bool wrong; /* errors in it were reported: connectors may be missing */
    struct tn_kit_part *next;
} tn_kit_part;

typedef struct tn_kit_space {
    const tn_kit_node *node;
    bool open; /* its meaning is being worked out */
    struct tn_kit_space *next;
} tn_kit_space;

typedef struct tn_kit_rule {
    const tn_kit_node *node;
    struct tn_kit_rule *next;
    struct tn_kit_rule *next_used; /* in the list of those that models use */
    bool used;                     /* is in it */
} tn_kit_rule;

/* A space at hand: a condition on x, y and z, and a box that holds it. */
typedef struct tn_kit_region {
    tn_expression *inside; /* NULL: it was complained of */
    bool endless;
    double low[3], high[3]; /* LDU, y upwards; not of endless ones */
} tn_kit_region;

/* Where a space is, in LDU, and by how many quarter turns about the vertical it is turned. */
typedef struct tn_space_placement {
    double at[3];
    uint32_t turns;
} tn_space_placement;

/* Cells that a file gave: x fastest, then z, then y, as the head has them. One file at two placements has two. */
typedef struct tn_kit_voxels {
    const tn_kit_node *node; /* that names the file */
    tn_space_placement placement;
    bool wrong; /* it was complained of */
    int32_t low[3];
    uint32_t size[3], index;
    uint64_t *bits;
    size_t words;
    struct tn_kit_voxels *next;
} tn_kit_voxels;

/* The parts of a model that a file has; what was complained of has none. */
typedef struct tn_kit_parts {
    const tn_kit_node *node; /* that names the file */
    struct tn_kit_stands *first, *last;
    struct tn_kit_parts *next;
} tn_kit_parts;

typedef struct tn_kit_stands {
    const tn_kit_part *part;
    int32_t at[3];
    uint32_t heading;
    int32_t colour;
    struct tn_kit_stands *next;
} tn_kit_stands;

typedef struct tn_kit_model {
    const tn_kit_node *node, *inside;
    tn_kit_region region;
    int64_t colour, amount; /* amount: of the search */
    tn_kit_search search;
    tn_symmetry symmetry;
    const tn_kit_node *objective, *searches, *repeats, *stocks, *orders, *divides; /* or NULL */
    bool breadth;
    tn_kit_steps steps;
    int64_t step_parts;
    struct tn_kit_model *next;
} tn_kit_model;

typedef struct tn_kit {
    tn_arena *arena;
    tn_diagnostics *diagnostics;
    tn_names lengths, types, parts, spaces, rules, models; /* by name */
    struct {
        tn_kit_type *first, *last;
    } type_list;
    struct {
        tn_kit_part *first, *last;
    } part_list;
    struct {
        tn_kit_rule *first, *last;
    } rule_list;
    struct {
        tn_kit_model *first, *last;
    } model_list;
    struct {
        tn_kit_voxels *first, *last;
    } voxels_list;
    struct {
        tn_kit_parts *first, *last;
    } file_list;
    const tn_attachments *attachments;
    const tn_kit_node *unit_node;
    int64_t unit[3];
    uint32_t turns; /* that parts have: 4 or 24 */
    uint32_t part_count;
    const char *counted[TN_KIT_COUNTED_MAX];
    size_t voxel_words;
    uint32_t voxels_count, voxels_placed;    /* those that models have come first */
    uint32_t counted_count, shapes;          /* shapes: of the space at hand, each as often as it is named */
    bool damaged, names_lost, out_of_memory; /* names_lost: some may be missing because of errors that were reported */
} tn_kit;

/* Checks the files of all units. False if there were errors. */
bool tn_check_kit(tn_kit *kit, const tn_imports *imports);

/* ---- lengths (length.c). Each reports what is wrong, and is 0 then. */

/* A length, in millionths of an LDU. */
bool tn_kit_measure(tn_kit *kit, const tn_kit_length *length, int64_t *value);

/* A length along an axis in cells; `halves` of it (1 or 2): `what` is told where it is no whole number. */
bool tn_kit_cells(tn_kit *kit, tn_span span, int64_t length, int axis, int halves, const char *what, int32_t *cells);

/* A plain number; a whole one from low to high. */
double tn_kit_number(const tn_kit *kit, const tn_kit_length *number);
bool tn_kit_whole(tn_kit *kit, const tn_kit_length *number, int64_t low, int64_t high, const char *what,
                  int64_t *value);

/* Says that there is no such part, rule, space, ..., with the nearest name of the table, or `otherwise`. Where
   statements of the file were lost to errors that were said, it may be one of those, and nothing is said. */
void tn_kit_unknown(tn_kit *kit, const tn_names *names, const char *kind, tn_span span, const char *wrong,
                    const char *otherwise);

/* "did you mean" among the names of a table, or `otherwise`. */
void tn_kit_suggest(tn_kit *kit, tn_diagnostic *d, const tn_names *names, const char *wrong, const char *otherwise);

/* ---- parts (part.c), spaces (space.c), rules (rule.c), models (model.c) */
void tn_kit_check_part(tn_kit *kit, tn_kit_part *part);

bool tn_kit_axis(tn_kit *kit, const tn_kit_text *word, tn_axis *axis);
tn_kit_region tn_kit_check_space(tn_kit *kit, const tn_kit_node *node);

/* The space that a file gives at a placement (voxels.c), and the parts of a model that it has (model.c): never NULL
 * but where out of memory. */
tn_kit_region tn_kit_region_of_file(tn_kit *kit, const tn_kit_node *node, const tn_space_placement *placement);
const tn_kit_parts *tn_kit_parts_of_file(tn_kit *kit, const tn_kit_node *node);

/* The lengths that a shape takes, in their order: a file may write their names before them. */
typedef struct tn_kit_extents {
    const char *names[3];
    uint32_t count;
    const char *example;
} tn_kit_extents;

/* As many sizes in LDU as a shape takes; or says what is wrong (E1326), with an example of the shape. */
bool tn_kit_sizes(tn_kit *kit, const tn_kit_node *node, const tn_kit_extents *wanted, double size[3]);

/* A box of a part that stands, in cells. */
tn_cell_box tn_kit_box_of(const tn_kit_stands *one, uint32_t index);

/* Says that the file that a node names is of no use; `error` says why. TN_MEMORY is the arena's to remember. */
void tn_kit_file_failed(tn_kit *kit, const tn_kit_node *node, tn_status status, const tn_error *error);
tn_request tn_kit_request(const tn_kit *kit, const tn_kit_node *node);
void tn_kit_check_rule(tn_kit *kit, const tn_kit_rule *rule);
void tn_kit_check_model(tn_kit *kit, tn_kit_model *model);
bool tn_kit_start_turn(tn_kit *kit, const tn_kit_node *start, uint32_t *turns);
void tn_kit_check_conditions(tn_kit *kit, const tn_kit_node *node);
void tn_kit_check_test(tn_kit *kit, const tn_kit_node *test);
extern const tn_expression_scope tn_kit_scope;

/* ---- placements */

/* How a connector is looked at. Where parts stay upright, one that points aside is turned so that it points right;
 * where they have all turns, any is turned so that it points up. */
static inline tn_kit_side tn_kit_side_of(const tn_kit *kit, tn_axis axis)
{
    return kit->turns == TN_TURNS ? TN_KIT_UPWARD
           : axis == TN_AXIS_UP   ? TN_KIT_UPWARD
           : axis == TN_AXIS_DOWN ? TN_KIT_DOWNWARD
                                  : TN_KIT_ASIDE;
}

/* The turn that leads to a connector: the other way round it is looked at as tn_kit_side_of says. */
static inline uint32_t tn_kit_bearing(const tn_kit *kit, tn_axis axis)
{
    static const uint32_t bearings[TN_AXIS_COUNT] = {
        [TN_AXIS_RIGHT] = 0, [TN_AXIS_BACK] = 1, [TN_AXIS_LEFT] = 2, [TN_AXIS_FRONT] = 3};
    return kit->turns == TN_TURNS ? tn_turn_to(axis) : bearings[axis];
}

/* How an alternative's first part is put at a connector: from the head's place and heading there. */
typedef struct tn_kit_placement {
    int32_t move[3];
    uint32_t turns;
} tn_kit_placement;

/* All different placements of an alternative at a connector of this type and side, in their order; *count of them.
 * NULL if out of memory. The alternative was checked. */
tn_kit_placement *tn_kit_placements(tn_kit *kit, const tn_kit_node *places, const tn_kit_type *type, tn_kit_side side,
                                    uint32_t *count);

/* Where a part of an alternative stands from the first: place and heading. */
bool tn_kit_offset(tn_kit *kit, const tn_kit_node *placed, int32_t at[3], uint32_t *turns);

/* Has the rule this connector after `at`? */
bool tn_kit_rule_takes(const tn_kit_rule *rule, const tn_kit_type *type);

/* TN_OK or TN_MEMORY. */
tn_status tn_emit_kit(tn_builder *builder, tn_kit *kit, const tn_kit_file *file, const char *name, size_t length,
                      tn_error *error);

/* Conditions alone: a kit without parts and models, and a function for each, whose place is that of its code. */
tn_status tn_emit_kit_conditions(tn_builder *builder, tn_kit *kit, const tn_kit_node *conditions, tn_error *error);

#endif
