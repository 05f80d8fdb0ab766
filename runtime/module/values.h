/* What the numbers in a module's records mean, and how large they may be: the enumerations (values.def), flags and
 * bounds that the rows of records.def name. */
#ifndef TARTAN_MODULE_VALUES_H
#define TARTAN_MODULE_VALUES_H

#include <stdint.h>

/* A reference to nothing. */
#define TN_NO_RECORD UINT32_MAX

/* Bounds that every module keeps; the compiler reports what passes them in a source (E0811, E0812). */
#define TN_FIELDS_MAX 64u        /* fields of a schema */
#define TN_VALUES_MAX 255u       /* values of a field: engines number them in a byte */
#define TN_PROJECTIONS_MAX 16u   /* libraries above one another, each projected onto the next: this bounds recursion */
#define TN_TRAYS_MAX 1000000000u /* of a library's plans; engines have their own, lower limits */
#define TN_NAME_MAX 255u         /* bytes of a name */
#define TN_SPELLING_MAX 511u     /* bytes of what is made of names: "fill:depth", a clause's "rule.2" */

/* ---- enumerations: values.def */

/* What floors were called as a part that materials are for: it is what they are called still if something of the author's
 * has the name that they have now (TN_OF_DECK). */
#define TN_FLOOR_BEFORE "deck"

/* As many bytes as the highest number and one. */
#define VALUE(ID, NUMBER, WORD) char of_##ID[(NUMBER) + 1];
#define ENUMERATION(NAME, TYPE, VALUES)                                                                                \
    union TYPE##_bytes {                                                                                               \
        VALUES                                                                                                         \
    };
#include "runtime/module/values.def"

#define VALUE(ID, NUMBER, WORD) ID = (NUMBER),
#define ENUMERATION(NAME, TYPE, VALUES)                                                                                \
    typedef enum TYPE { VALUES TN_##NAME##_COUNT = sizeof(union TYPE##_bytes) } TYPE;
#include "runtime/module/values.def"

#define VALUE(ID, NUMBER, WORD) +1
#define ENUMERATION(NAME, TYPE, VALUES)                                                                                \
    _Static_assert((0 VALUES) == TN_##NAME##_COUNT, "the numbers of " #NAME " leave none out");
#include "runtime/module/values.def"

/* The word of each value of an enumeration, by its number: tn_names_FIELD_KIND and so on. */
#define ENUMERATION(NAME, TYPE, VALUES) extern const char *const tn_names_##NAME[TN_##NAME##_COUNT];
#include "runtime/module/values.def"

/* Modules number other things from here on: measured numbers beside the fitness terms, and the expression of a goal;
 * openings of a form. So nothing can be added to what stands before. */
#define TN_FITNESS_TERM_COUNT 6
_Static_assert(TN_MEASURED_VERTICES == TN_FITNESS_TERM_COUNT, "what is measured follows the fitness terms");
_Static_assert(TN_FACE_KIND_COUNT == 5, "modules number the openings that are in faces from 5 on");
_Static_assert(TN_OF_COUNT == 6, "modules number layers and openings that have a material from 6 on");

/* ---- plans */

#define TN_TALLY_STACK_MAX 64u          /* values on the stack of a function of kind TALLY */
#define TN_PREFERENCE_NAME "preference" /* the measure of libraries that prefer */
#define TN_RATIONAL_MAX 4096u           /* bytes of an exact number */

/* Flags of rules, libraries and measures. */
#define TN_IMPORTED 1u /* from a file that the named file uses, not from the named file itself */

/* ---- growth */

#define TN_TEMPLATE_ITEMS_MAX 4096u /* edges, branches among them, of one successor; and its brackets */
#define TN_CHAIN_MAX 64u            /* edges of a predecessor */
#define TN_STEPS_MAX 100000u
#define TN_COORDINATE_MAX 1e12 /* of anything in a rewrite system or an environment */

typedef enum tn_side { TN_SIDE_NONE, TN_SIDE_LEFT, TN_SIDE_RIGHT, TN_SIDE_COUNT } tn_side;

/* When an alternative applies: always, or where the age is below, above or equal to its bound. */
typedef enum tn_comparison { TN_ALWAYS, TN_AGE_BELOW, TN_AGE_ABOVE, TN_AGE_EQUALS, TN_COMPARISON_COUNT } tn_comparison;

/* Flags of a rewrite system. */
#define TN_GROWTH_SYNC 1u
#define TN_GROWTH_EVEN 2u
#define TN_GROWTH_FLAGS 3u

/* Flags of a study. */
#define TN_STUDY_FIXED_CENTRE 1u
#define TN_STUDY_FIXED_PERIMETER 2u
#define TN_STUDY_FACING 4u
#define TN_STUDY_MIRROR 8u
#define TN_STUDY_RAW_FITNESS 16u
#define TN_STUDY_SHARES 32u /* requirements are shares of their bounds, which weigh more than goals do */
#define TN_STUDY_FLAGS 63u

/* ---- houses (docs/houses.md) */

#define TN_HOUSE_LENGTH_MAX (INT64_C(1) << 40) /* nanometres, 1.1 km: so that exact products stay in 128 bits */
#define TN_STOREYS_MAX 64u
#define TN_CHOICES_MAX 64u
#define TN_CELL_RULES_MAX 1000u
#define TN_OPENINGS_MAX 200u
#define TN_WINDERS_MAX 3u
#define TN_FACE_LINES_MAX 1000u
#define TN_TILES_MAX 10000u
#define TN_TILE_BOXES_MAX 1000u
#define TN_MATERIALS_MAX 1000u
#define TN_LAYERS_MAX 200u
#define TN_BEAMS_MAX 64u
#define TN_CLASSIFICATIONS_MAX 16u
#define TN_CLASSES_MAX 1000u /* of one classification */
#define TN_PRICE_MAX INT64_C(1000000000000000) /* millionths: a thousand million */
#define TN_RATIO_MAX 1000u                     /* either number of the glazing of a room to its floor */
#define TN_SLOPE_MAX 1000u                     /* either number of a slope */
#define TN_AREA_MAX (INT64_C(1) << 62)         /* square micrometres: about 4.6 square kilometres */

/* open: no deck below it; across: its ridge goes across the row. */
enum { TN_ROOF_OPEN = 1, TN_ROOF_ACROSS = 2 };

/* Flags of openings and of the boxes of tiles. */
#define TN_PASSAGE 1u
#define TN_GLAZED 2u
#define TN_LEAFLESS 4u /* nothing stands in it */
#define TN_SLIDING 8u  /* its leaf slides along the wall */

/* Of a function: */
#define TN_OUTDOOR 1u /* its cells are in the open */
#define TN_TILE_KEEP 1u
#define TN_TILE_X_FROM_RIGHT 2u
#define TN_TILE_X_TO_RIGHT 4u
#define TN_TILE_Y_FROM_FRONT 8u
#define TN_TILE_Y_TO_FRONT 16u
#define TN_TILE_BOX_FLAGS 31u

/* Of a line of an item's symbol: from which sides of the item its ends are measured, if not from left and back. */
#define TN_LINE_X0_RIGHT 1u
#define TN_LINE_Y0_FRONT 2u
#define TN_LINE_X1_RIGHT 4u
#define TN_LINE_Y1_FRONT 8u
#define TN_LINE_SIDES 15u
#define TN_SYMBOL_LINES_MAX 1000u /* of an item */

/* ---- grammars that genomes are mapped through */

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

#define TN_STEP_PARTS_MAX 1000000u
#define TN_SEARCH_MAX 1000000000u /* plans of a beam, rounds of annealing */
#define TN_BEAM_MAX 10000u

/* ---- solids */

#define TN_SOLID_COORDINATE_MAX 1e9        /* of a box's faces and sizes */
#define TN_SOLID_UNIT_MAX 1000000000000000 /* of the two numbers whose quotient is a design's unit */
#define TN_SOLID_BOXES_MAX 10000000u       /* of one design, as it is written */

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

/* Flags of grammars. */
#define TN_SKIP_SINGLE 1u          /* a rule with one alternative reads no codon */
#define TN_POSITION_INDEPENDENT 2u /* codons say which non-terminal is replaced next; not together with the other */
#define TN_GRAMMAR_FLAGS 3u

/* ---- fields */

#define TN_GRID_MAX 8192u /* samples on the longest side of a box */

#endif
