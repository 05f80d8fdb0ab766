/* What the numbers in a module's records mean, and how large they may be: the enumerations, flags and bounds that the
 * rows of records.def name. */
#ifndef TARTAN_MODULE_VALUES_H
#define TARTAN_MODULE_VALUES_H

#include <stdint.h>

/* A reference to nothing. */
#define TN_NO_RECORD UINT32_MAX

/* Bounds that every module keeps; the compiler reports what passes them in a source (E0811, E0812). */
#define TN_FIELDS_MAX 64u        /* fields of a schema */
#define TN_VALUES_MAX 255u       /* values of a field: engines number them in a byte */
#define TN_TRAYS_MAX 1000000000u /* of a library's plans; engines have their own, lower limits */
#define TN_NAME_MAX 255u         /* bytes of a name */
#define TN_SPELLING_MAX 511u     /* bytes of what is made of names: "fill:depth", a clause's "rule.2" */

/* ---- plans */

typedef enum tn_field_kind {
    TN_FIELD_LENGTH, /* alternatives, each a length */
    TN_FIELD_CHOICE, /* alternatives, each a name */
    TN_FIELD_FLAG,   /* two values: unset, then set */
    TN_FIELD_ZONE,   /* alternatives, each a fill with a depth (or none) */
    TN_FIELD_KIND_COUNT
} tn_field_kind;

/* What a field means to a drawing; nothing else looks at it. */
typedef enum tn_field_role {
    TN_ROLE_NONE,
    TN_ROLE_LENGTH, /* the tray's extent along the row */
    TN_ROLE_LEVEL,  /* the n-th value has n levels */
    TN_ROLE_PUBLIC_END,
    TN_ROLE_GREAT_HALL,
    TN_ROLE_BAND,  /* a zone drawn as a band; bands lie in schema order, top to bottom */
    TN_ROLE_TEXT,  /* written large in the tray: what it is for */
    TN_ROLE_TONE,  /* each value colours the tray in a tone of its own */
    TN_ROLE_HATCH, /* each value but the first hatches it in a way of its own */
    TN_FIELD_ROLE_COUNT
} tn_field_role;

typedef enum tn_fill_role {
    TN_FILL_NONE,
    TN_FILL_SOLID,
    TN_FILL_VOID,
    TN_FILL_ABSENT,
    TN_FILL_ROLE_COUNT
} tn_fill_role;

typedef enum tn_clause_kind {
    TN_CLAUSE_REQUIRE,
    TN_CLAUSE_TOTAL,
    TN_CLAUSE_PRUNE,
    TN_CLAUSE_KIND_COUNT
} tn_clause_kind;

/* What a term of a sum counts, on a stretch. */
typedef enum tn_sum_kind {
    TN_SUM_SINGLES, /* single trays that are in the part's relation, each with its tally */
    TN_SUM_STARTS,  /* places where the part's relation starts, and ends within the stretch */
    TN_SUM_MATCHES, /* 1 where the part holds of the whole plan */
    TN_SUM_KIND_COUNT
} tn_sum_kind;

#define TN_TALLY_STACK_MAX 64u /* values on the stack of a function of kind TALLY */
#define TN_RATIONAL_MAX 4096u  /* bytes of an exact number */

/* Flags of rules, libraries and measures. */
#define TN_IMPORTED 1u /* from a file that the named file uses, not from the named file itself */

/* ---- growth */

#define TN_TEMPLATE_ITEMS_MAX 4096u /* edges, branches among them, of one successor; and its brackets */
#define TN_CHAIN_MAX 64u            /* edges of a predecessor */
#define TN_STEPS_MAX 100000u
#define TN_COORDINATE_MAX 1e12 /* of anything in a rewrite system or an environment */

/* What becomes of the age i of the replaced edge: Edge0, Edge0_i, Edge0_i+1, Edge0_i-1. */
typedef enum tn_age_change { TN_AGE_ZERO, TN_AGE_KEEP, TN_AGE_MORE, TN_AGE_LESS, TN_AGE_CHANGE_COUNT } tn_age_change;

typedef enum tn_side { TN_SIDE_NONE, TN_SIDE_LEFT, TN_SIDE_RIGHT, TN_SIDE_COUNT } tn_side;

/* When an alternative applies: always, or where the age is below, above or equal to its bound. */
typedef enum tn_comparison { TN_ALWAYS, TN_AGE_BELOW, TN_AGE_ABOVE, TN_AGE_EQUALS, TN_COMPARISON_COUNT } tn_comparison;

/* Flags of a rewrite system. */
#define TN_GROWTH_SYNC 1u
#define TN_GROWTH_EVEN 2u
#define TN_GROWTH_FLAGS 3u

/* What terms of goals are measured with. */
typedef enum tn_measuring_kind { TN_MEASURING_SUN, TN_MEASURING_MESH, TN_MEASURING_KIND_COUNT } tn_measuring_kind;

/* Flags of a study. */
#define TN_STUDY_FIXED_CENTRE 1u
#define TN_STUDY_FIXED_PERIMETER 2u
#define TN_STUDY_FACING 4u
#define TN_STUDY_MIRROR 8u
#define TN_STUDY_RAW_FITNESS 16u
#define TN_STUDY_FLAGS 31u

typedef enum tn_force_kind { TN_ATTRACTOR, TN_REPELLER, TN_GRAVITY, TN_FORCE_KIND_COUNT } tn_force_kind;

typedef enum tn_boundary_kind {
    TN_BOUNDARY_PLANE,
    TN_BOUNDARY_BOX,
    TN_BOUNDARY_SPHERE,
    TN_BOUNDARY_MESH,
    TN_BOUNDARY_KIND_COUNT
} tn_boundary_kind;

/* What becomes of a vertex that meets a boundary. */
typedef enum tn_boundary_mode {
    TN_SLIDE, /* it goes on along the boundary */
    TN_STOP,  /* it stays where it met it */
    TN_SOFT,  /* it passes, and counts in the fitness term of soft boundaries */
    TN_BOUNDARY_MODE_COUNT
} tn_boundary_mode;

typedef enum tn_fitness_term {
    TN_TERM_SIZE,
    TN_TERM_SMOOTHNESS,
    TN_TERM_SOFT_BOUNDARY,
    TN_TERM_SUBDIVISIONS,
    TN_TERM_SYMMETRY,
    TN_TERM_UNDULATION,
    TN_FITNESS_TERM_COUNT
} tn_fitness_term;

/* ---- houses (docs/houses.md) */

#define TN_HOUSE_LENGTH_MAX (INT64_C(1) << 40) /* nanometres, 1.1 km: so that exact products stay in 128 bits */
#define TN_STOREYS_MAX 64u
#define TN_CHOICES_MAX 64u
#define TN_CELL_RULES_MAX 1000u
#define TN_OPENINGS_MAX 200u
#define TN_FACE_LINES_MAX 1000u
#define TN_TILES_MAX 10000u
#define TN_TILE_BOXES_MAX 1000u
#define TN_MATERIALS_MAX 1000u
#define TN_PRICE_MAX INT64_C(1000000000000000) /* millionths: a thousand million */
#define TN_RATIO_MAX 1000u                     /* either number of the glazing of a room to its floor */
#define TN_SLOPE_MAX 1000u                     /* either number of a slope */
#define TN_AREA_MAX (INT64_C(1) << 62)         /* square micrometres: about 4.6 square kilometres */

typedef enum tn_choice_kind { TN_CHOICE_PLAIN, TN_CHOICE_STOREYS, TN_CHOICE_ROOF, TN_CHOICE_KIND_COUNT } tn_choice_kind;

/* Which way a shed falls: it is low at the back, or at the front. */
typedef enum tn_roof_kind {
    TN_ROOF_NONE,
    TN_ROOF_FLAT,
    TN_ROOF_SHED_BACK,
    TN_ROOF_SHED_FRONT,
    TN_ROOF_GABLE,
    TN_ROOF_VAULT,
    TN_ROOF_KIND_COUNT
} tn_roof_kind;

/* open: no deck below it; across: its ridge goes across the row. */
enum { TN_ROOF_OPEN = 1, TN_ROOF_ACROSS = 2 };

typedef enum tn_cell_rule_kind {
    TN_CELL_FUNCTION,
    TN_CELL_VOID,
    TN_CELL_NO,
    TN_CELL_FORBID, /* of sections */
    TN_CELL_RULE_KIND_COUNT
} tn_cell_rule_kind;

/* What is in a face; the openings of the form follow. */
typedef enum tn_face_kind {
    TN_FACE_WALL,
    TN_FACE_PARTY,
    TN_FACE_OPEN,
    TN_FACE_FLOOR,
    TN_FACE_STAIR,
    TN_FACE_KIND_COUNT
} tn_face_kind;

/* How a flight of stairs goes: straight on, or with a landing where it turns. */
typedef enum tn_turn { TN_TURN_NONE, TN_TURN_STRAIGHT, TN_TURN_QUARTER, TN_TURN_HALF, TN_TURN_COUNT } tn_turn;

/* Which faces a line is about: of neighbouring trays or one tray, one of the two, one over another, or the outside. */
typedef enum tn_face_relation {
    TN_FACE_BESIDE,
    TN_FACE_ALONG,
    TN_FACE_ACROSS,
    TN_FACE_UNDER,
    TN_FACE_OUTSIDE,
    TN_FACE_RELATION_COUNT
} tn_face_relation;

typedef enum tn_house_side {
    TN_HOUSE_ANY_SIDE,
    TN_HOUSE_BACK,
    TN_HOUSE_FRONT,
    TN_HOUSE_LEFT,
    TN_HOUSE_RIGHT,
    TN_HOUSE_SIDE_COUNT
} tn_house_side;

/* How an area is compared. */
typedef enum tn_area_test {
    TN_AREA_LESS,
    TN_AREA_AT_MOST,
    TN_AREA_EQUAL,
    TN_AREA_UNEQUAL,
    TN_AREA_AT_LEAST,
    TN_AREA_GREATER,
    TN_AREA_TEST_COUNT
} tn_area_test;

/* What a material may be for; the openings of the form follow, then what stands in rooms, by its first TILE_BOX. */
typedef enum tn_material_part {
    TN_OF_WALL,
    TN_OF_PARTY,
    TN_OF_PARTITION,
    TN_OF_POST,
    TN_OF_DECK,
    TN_OF_ROOF,
    TN_OF_COUNT
} tn_material_part;

/* What a term of a measure of houses adds up: cells, their areas, rooms, the cost. */
typedef enum tn_house_term_kind {
    TN_HOUSE_CELLS,
    TN_HOUSE_AREAS,
    TN_HOUSE_ROOMS,
    TN_HOUSE_COST,
    TN_HOUSE_TERM_COUNT
} tn_house_term_kind;

/* What a price is for: each part, or so much of its face or of its volume. */
typedef enum tn_price_unit {
    TN_PER_EACH,
    TN_PER_SQUARE_FOOT,
    TN_PER_SQUARE_METRE,
    TN_PER_CUBIC_FOOT,
    TN_PER_CUBIC_METRE,
    TN_PRICE_UNIT_COUNT
} tn_price_unit;

/* Flags of openings and of the boxes of tiles. */
#define TN_PASSAGE 1u
#define TN_GLAZED 2u
#define TN_LEAFLESS 4u /* nothing stands in it */
#define TN_TILE_KEEP 1u
#define TN_TILE_X_FROM_RIGHT 2u
#define TN_TILE_X_TO_RIGHT 4u
#define TN_TILE_Y_FROM_FRONT 8u
#define TN_TILE_Y_TO_FRONT 16u
#define TN_TILE_BOX_FLAGS 31u

/* ---- grammars that genomes are mapped through */

/* How a .bnf file is read and its genomes mapped (docs/genome-language.md); or a connection grammar (docs/placing.md).
 */
typedef enum tn_dialect { TN_DIALECT_GE, TN_DIALECT_GENR8, TN_DIALECT_PLACE, TN_DIALECT_COUNT } tn_dialect;

/* What becomes of edge types that a genr8 sentence leaves without a rule. */
typedef enum tn_repair { TN_REPAIR_GENOME, TN_REPAIR_IDENTITY, TN_REPAIR_OFF, TN_REPAIR_COUNT } tn_repair;

#define TN_EDGE_LETTERS 3u /* EdgeX, EdgeY, EdgeZ */
#define TN_GROUP_DEPTH 64u /* how deep { } and [ ] may nest in a production */

/* ---- connection grammars */

#define TN_PLACE_FAR (1 << 26)      /* a head may not go farther from the origin, in cells */
#define TN_PLACE_SIZE_MAX (1 << 20) /* of a box or a ball, in cells */
#define TN_PLACE_COLOUR_MAX INT32_MAX

#define TN_KIT_LENGTH_MAX INT64_C(1000000000000) /* millionths of an LDU */
#define TN_KIT_COUNTED_MAX 32u
#define TN_KIT_MASKS_MAX 64u
#define TN_MASK_CELLS_MAX (1 << 26)
#define TN_MASK_WORDS_MAX 1000000
#define TN_KIT_STANDS_MAX 100000
#define TN_CONDITION_TEST 1u /* of a test, not a requirement */
#define TN_KIT_MAXIMIZE 1u   /* the objective is to be large */
#define TN_KIT_BREADTH 2u    /* what was opened first comes next */

/* How a placed model is divided into the steps in which it is built. */
typedef enum tn_kit_steps { TN_STEPS_PLACED, TN_STEPS_PARTS, TN_STEPS_LAYERS, TN_STEPS_COUNT } tn_kit_steps;
#define TN_STEP_PARTS_MAX 1000000u

/* How the model of a kit is searched for, and how it repeats itself about the origin. */
#define TN_SEARCH_MAX 1000000000u /* plans of a beam, rounds of annealing */
#define TN_BEAM_MAX 10000u
typedef enum tn_kit_search {
    TN_SEARCH_GREEDY,
    TN_SEARCH_BEAM,
    TN_SEARCH_ANNEAL,
    TN_SEARCH_EXACT,
    TN_SEARCH_COUNT
} tn_kit_search;
typedef enum tn_symmetry {
    TN_SYMMETRY_NONE,
    TN_SYMMETRY_TURN_2,
    TN_SYMMETRY_TURN_4,
    TN_SYMMETRY_MIRROR_X,
    TN_SYMMETRY_MIRROR_Z,
    TN_SYMMETRY_COUNT
} tn_symmetry;

typedef enum tn_axis {
    TN_AXIS_UP,
    TN_AXIS_DOWN,
    TN_AXIS_LEFT,
    TN_AXIS_RIGHT,
    TN_AXIS_FRONT,
    TN_AXIS_BACK,
    TN_AXIS_COUNT
} tn_axis;

/* ---- solids */

#define TN_SOLID_COORDINATE_MAX 1e9  /* of a box's faces and sizes */
#define TN_SOLID_BOXES_MAX 10000000u /* of one design, as it is written */

/* Flags of a design. */
#define TN_SOLID_SYMMETRY_X 1u
#define TN_SOLID_SYMMETRY_Y 2u
#define TN_SOLID_SYMMETRY_Z 4u
#define TN_SOLID_SYMMETRY 7u
#define TN_SOLID_FLAT 8u
#define TN_SOLID_NOCLIP 16u
#define TN_SOLID_PENETRATION 32u
#define TN_SOLID_IMPORTED 64u
#define TN_SOLID_FLAGS 127u

/* Flags of a box. */
#define TN_BOX_RIGID 1u
#define TN_BOX_CLIPPED 2u
#define TN_BOX_FLAGS 3u

typedef enum tn_solid_model {
    TN_MODEL_NONE,
    TN_MODEL_MILLIMETRES,
    TN_MODEL_CENTIMETRES,
    TN_MODEL_METRES,
    TN_SOLID_MODEL_COUNT
} tn_solid_model;

/* Flags of grammars. */
#define TN_SKIP_SINGLE 1u          /* a rule with one alternative reads no codon */
#define TN_POSITION_INDEPENDENT 2u /* codons say which non-terminal is replaced next; not together with the other */
#define TN_GRAMMAR_FLAGS 3u

/* ---- fields */

#define TN_GRID_MAX 8192u /* samples on the longest side of a box */

typedef enum tn_unit_word {
    TN_UNIT_NONE,
    TN_UNIT_MM,
    TN_UNIT_CM,
    TN_UNIT_M,
    TN_UNIT_IN,
    TN_UNIT_FT,
    TN_UNIT_COUNT
} tn_unit_word;

#endif
