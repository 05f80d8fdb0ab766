/* What the declarations of a form come to, found by going through all trays of its schema and all of its sections: for
 * warnings (W201 to W208: functions that no cell may have, tiles and openings that never fit, lines of faces that never
 * apply, values that no section has, materials that none uses, walks between cells that none is), and for editors,
 * which show it.
 *
 * It goes by cells one by one, not by plans, so what it says that may be is what no cell rules out. A tn_survey borrows
 * the module; free it with tn_survey_free.
 */
#ifndef TARTAN_DRIVER_HOUSE_SURVEY_H
#define TARTAN_DRIVER_HOUSE_SURVEY_H

#include "driver/open/open.h"
#include "runtime/house/house.h"

/* Cells of a zone (a field) and a storey that are as large and may have the same functions. */
typedef struct tn_survey_place {
    uint32_t zone, storey;
    int64_t wide, deep; /* between the planes of its walls: along the row, and from back to front */
    bool open;          /* open to the cell below: it has no function */
    uint64_t *may;      /* a bit for each function */
    uint64_t cells;     /* so many trays have one */
    size_t next;        /* the next place of the zone and storey, or TN_NO_PLACE */
} tn_survey_place;

#define TN_NO_PLACE SIZE_MAX

/* Cells that no line of faces tells apart. met: a bit for each line's first cells, and one for its second ones. */
typedef struct tn_cell_class {
    uint32_t zone, storey;
    bool open, outdoor; /* outdoor: in the open */
    int64_t wide, deep; /* the most that one of them has */
    uint64_t *met, *functions;
} tn_cell_class;

/* Two cells that may meet, or one and the outside: more than really do, so that what is said holds. */
typedef struct tn_survey_meeting {
    const tn_cell_class *a, *b; /* along: a is left of b; under: a is below b; outside: b is NULL */
    tn_face_relation relation;  /* ALONG, ACROSS, UNDER or OUTSIDE */
    tn_house_side side;
} tn_survey_meeting;

/* Cells of two classes, or of one and the outside (b: NULL), between which people may pass, through what is so wide. */
typedef struct tn_passed {
    const tn_cell_class *a, *b;
    int64_t wide;
} tn_passed;

/* Which faces may have an opening or a flight, as far as the lines of faces and the largest cells say. */
typedef struct tn_kind_use {
    bool used;
    uint64_t outside, between, under;             /* a bit for each storey: outside walls, walls of two cells, floors */
    uint32_t sides;                               /* of outside walls: a bit for each tn_house_side */
    uint64_t *outside_of, *between_of, *under_of; /* a bit for each function of one of the cells */
    tn_survey_meeting nearest;                    /* a face where it does not fit (a: NULL, none), nearest to it */
} tn_kind_use;

/* The cells at an end of a walk that the file asks for, or by way of which it leads. met: some cell is so. */
typedef enum tn_walk_part {
    TN_WALK_BEGINS,
    TN_WALK_ENDS,
    TN_WALK_THROUGH,
    TN_WAYS_BEGIN,
    TN_APART_CELLS,
    TN_APART_FROM,
    TN_APART_THROUGH
} tn_walk_part;
typedef struct tn_walk_end {
    uint32_t function;
    tn_walk_part part;
    tn_span span;
    bool met;
} tn_walk_end;

/* A void meets cells on the ground, which are none; cells above others. */
enum { TN_VOID_LOWEST = 1, TN_VOID_ABOVE = 2 };

typedef struct tn_survey {
    tn_opened *opened; /* where warnings go; NULL: none are given */
    tn_house house;    /* of one tray, without cells: what decides on a cell needs no more */
    tn_tray tray;
    tn_schema *schema;
    tn_house_form form;
    bool counted;              /* the sections are few enough to go through: */
    uint64_t sections, stands; /* all of them, and those that the form does not forbid */
    uint64_t *with;            /* [shapes of the module] of those: so many have the value */
    bool complete;             /* the trays were few enough to go through; if not, nothing below is known */
    uint64_t cells;            /* of all trays: zones in storeys that some section has */
    size_t words;              /* of a set of functions */
    tn_survey_place *places;   /* complete only where they are at most TN_SURVEY_PLACES_MAX */
    size_t place_count, place_room;
    size_t *first_places;     /* [zone field][storey] */
    uint64_t *may;            /* of the cell at hand */
    uint64_t *shelters;       /* of those in the open: a cell with it may stand beside one that is not */
    bool *functions;          /* [function] a cell may have it */
    uint8_t *voids;           /* [rule] which cells a void meets: TN_VOID_... */
    uint64_t *bare_functions; /* those without tiles */
    tn_kind_use *uses;        /* [kind of face] */
    bool met;       /* the classes were few enough to ask all lines of faces; if not, every kind counts as used */
    int64_t widest; /* the longest that a face can be */
    bool bare;      /* a cell was found that no function may take: */
    tn_cell bare_cell;
    tn_tray bare_tray;
    size_t met_words; /* of a class's bits */
    tn_cell_class *classes;
    size_t class_count, class_room;
    tn_passed *links;
    size_t link_count, link_room;
    tn_walk_end *ends; /* of what the opened file itself asks: survey_walks.c; none where no warnings are given */
    size_t end_count, end_room;
} tn_survey;

#define TN_SURVEY_PLACES_MAX 10000u

/* Goes through a form (a FORM record), without warnings. TN_LIMIT where its schema has too many trays. TN_STOPPED as
 * the module's watch says. */
tn_status tn_survey_new(const tn_module *module, uint32_t form, tn_survey **survey, tn_error *error);
void tn_survey_free(tn_survey *survey);

static inline bool tn_survey_has(const uint64_t *set, uint32_t number)
{
    return set[number / 64] >> number % 64 & 1;
}

/* Of the sections that stand: in how many has the zone (a field) a storey? */
uint64_t tn_survey_sections_with(const tn_survey *survey, uint32_t zone, uint32_t storey);

/* ---- survey_tiles.c */

/* Is a tile for a function? Both are counted within the form. */
bool tn_survey_serves(const tn_survey *survey, uint32_t tile, uint32_t function);

typedef enum tn_tile_fit {
    TN_FITS_NOWHERE,
    TN_FITS_OPEN,  /* only where a side of the cell has no wall */
    TN_FITS_THIN,  /* with walls all round, if some of them are partitions */
    TN_FITS_WALLED /* with any walls all round */
} tn_tile_fit;

/* May a cell of the place have a function that the tile is for? */
bool tn_survey_is_for(const tn_survey *survey, const tn_survey_place *place, uint32_t tile);

/* How a tile fits into the cells of a place. */
typedef struct tn_tile_fits {
    tn_tile_fit fit;
    bool straight, turned;   /* with walls all round: its back is a back or front; is a left or right side */
    size_t layouts;          /* different ones there, at most */
    tn_tile_failure failure; /* where it fits nowhere: in the largest such room, */
    tn_tile_failure further; /* and in the room, with or without walls, where it comes furthest */
} tn_tile_fits;

tn_status tn_survey_tile(const tn_survey *survey, const tn_survey_place *place, uint32_t tile, tn_tile_fits *fits,
                         tn_error *error);

/* Is the place large enough for a flight (an opening of the form), with a function that has no tiles? */
bool tn_survey_climbs(const tn_survey *survey, const tn_survey_place *place, uint32_t opening);

/* The clear rooms that a tile fits into, seen with its back behind. */
typedef struct tn_tile_rooms {
    bool known;                               /* its edges are few enough to ask for */
    bool any;                                 /* it fits into some of a height that a storey has: */
    int64_t wide, wide_most, deep, deep_most; /* the least and the most that one has, to a nanometre */
} tn_tile_rooms;

tn_status tn_tile_rooms_find(const tn_house_form *form, uint32_t tile, tn_tile_rooms *rooms, tn_error *error);

/* ---- survey_warn.c */

/* Warns about the forms of the opened file itself, not of those that it uses. A form whose trays and lines are too many
 * to go through (a hundred million decisions) is left out without a word. TN_MEMORY. */
tn_status tn_house_survey(tn_opened *opened, tn_error *error);

#endif
