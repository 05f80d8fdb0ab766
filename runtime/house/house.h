/* One house: a plan that stands up in a form, with a value for each choice of its section, a function for each cell,
 * something in each face, and a tile in each cell whose function has tiles.
 *
 * Coordinates are integer nanometres: x along the row, y to the front, 0 at the back of the spine. A tn_house owns its
 * arrays and borrows the form; free them with tn_house_clear.
 */
#ifndef TARTAN_HOUSE_HOUSE_H
#define TARTAN_HOUSE_HOUSE_H

#include "runtime/base/int128.h"
#include "runtime/base/length.h"
#include "runtime/house/floor/rectangle.h"
#include "runtime/house/form/form.h"
#include "runtime/house/house_names.h"
#include "runtime/module/code.h"
#include "runtime/plan/text/text.h"

#define TN_NO_CELL UINT32_MAX
#define TN_HOUSE_TRAYS_DEFAULT 4096u /* the longest plan that is read, where nobody says another limit */
#define TN_NO_FUNCTION UINT32_MAX
#define TN_FACE_KINDS_MAX (TN_FACE_KIND_COUNT + TN_OPENINGS_MAX)

typedef struct tn_box {
    int64_t x0, x1, y0, y1, z0, z1;
} tn_box;

/* open: it has no floor, and belongs to the cell below. variant: which of the tiles that fit (tn_tile_variants). */
typedef struct tn_cell {
    uint32_t tray, zone, storey; /* zone: a field of the schema */
    tn_rectangle at;
    bool open;
    uint32_t function;
    size_t variant;
} tn_cell;

/* A face of two cells (BESIDE; UNDER: first is below second), or of one and the OUTSIDE, which is on a side of it. */
typedef struct tn_face {
    uint32_t first, second; /* cells; second: TN_NO_CELL outside */
    tn_face_relation relation;
    tn_house_side side; /* of the first cell; TN_HOUSE_ANY_SIDE: above it */
    tn_rectangle at;    /* without width or depth where it stands */
    uint32_t storey;
    uint32_t kind; /* what is in it: a tn_face_kind or an opening */
} tn_face;

/* What functions of kind CELL have decided on the cells of one house in one section, for each function that a cell may
 * have; those that ask for a cell's function alone, on all cells of all houses. A house that is looked at many times
 * borrows it. Owns its arrays. */
#define TN_KNOWN_ANSWERS_MAX ((size_t)1 << 20)
typedef struct tn_house_known {
    uint32_t *place; /* [functions of the module] of an answer; TN_NO_RECORD: its answers are not kept */
    bool *alone;     /* the same: they are among those of all cells */
    size_t decisions, functions, alones;
    uint8_t *answers;     /* [cells][functions, and none][decisions]: 0 where it is not known yet */
    uint8_t *of_function; /* [functions, and none][alones]: the same */
    size_t room;
} tn_house_known;

typedef struct tn_face_view tn_face_view; /* runtime/house/ways.h */

/* views: of a house that is a part of another, so that cells beside its own are not there: what its faces lead to
 * ([faces], borrowed), or NULL. ways_unknown: what is beside cells is not known, so that nothing is asked about ways,
 * and flights stand where there is room. */
typedef struct tn_house {
    const tn_house_form *form;
    tn_tray *trays;
    size_t length;
    uint32_t shapes[TN_CHOICES_MAX]; /* the section: a value for each choice, counted within it */
    tn_cell *cells;                  /* by tray, zone, storey */
    size_t cell_count, cell_room;
    uint32_t *tray_first; /* [length + 1] a tray's first cell */
    tn_face *faces;       /* by first cell; then left, back, front, right, above; then y */
    size_t face_count, face_room;
    tn_house_known *known; /* or NULL */
    const tn_face_view *views;
    bool ways_unknown;
    bool tiles_left_out; /* by the line that it was read from: each cell has the first that fits */
} tn_house;

/* Stands a plan up: its cells and faces, without functions and with walls everywhere. The trays are copied. */
tn_status tn_house_stand(const tn_house_form *form, const tn_tray *trays, size_t length, const uint32_t *shapes,
                         tn_house *house, tn_error *error);
void tn_house_clear(tn_house *house);

/* The same house again, without what is known of it; empty after a failure. TN_MEMORY. */
tn_status tn_house_copy(const tn_house *house, tn_house *copy, tn_error *error);

/* The same for a house that is zero or has stood before, whose memory is used again. shapes: not the house's own. */
tn_status tn_house_stand_again(const tn_house_form *form, const tn_tray *trays, size_t length, const uint32_t *shapes,
                               tn_house *house, tn_error *error);

/* Nothing but the section is known of such a house: it has no trays, cells and faces. */
void tn_house_take_section(const tn_house_form *form, const uint32_t *shapes, tn_house *house);

/* The x of the plane at the left of a tray, or, of `length`, at the right of the last one: it is there also if no cell
 * stands at it. */
int64_t tn_house_plane_x(const tn_house *house, size_t tray);

/* The lowest cell of a zone (a field) of a tray that its section has and a line `no` takes away, at x = y = 0; false
 * where all are there. */
bool tn_house_ends(const tn_house *house, uint32_t tray, uint32_t zone, tn_cell *end);

/* The value of a zone's choice of that kind: a SHAPE record, or NULL where the form has none. */
const tn_shape_record *tn_house_shape(const tn_house *house, uint32_t zone, tn_choice_kind kind);

/* What a function of kind CELL decides on a cell, or of kind SECTION on the house (cell NULL). */
bool tn_house_decide(const tn_house *house, uint32_t function, const tn_cell *cell);

/* Begins to keep answers for houses of a form. Clear it in any case. */
tn_status tn_house_known_begin(const tn_house_form *form, tn_house_known *known, tn_error *error);
void tn_house_known_clear(tn_house_known *known);

/* Forgets the answers, and keeps those for this house from now on; not where they are more than TN_KNOWN_ANSWERS_MAX.
 * Until the next one its plan, its section and its cells must stay as they are, but for their functions. */
tn_status tn_house_known_use(tn_house_known *known, tn_house *house, tn_error *error);

/* Runs such a function, asking what each instruction says that has no inputs. */
typedef bool tn_decision_ask(const void *context, const tn_instruction *instruction);
bool tn_decision_run(const tn_module *module, uint32_t function, tn_decision_ask *ask, const void *context);

/* Does an area in square nanometres compare so (a tn_area_test) with another? */
bool tn_area_compares(tn_int128 area, int64_t test, int64_t square_micrometres);

/* Between the planes of its walls, in square nanometres. */
static inline tn_int128 tn_cell_area(const tn_cell *cell)
{
    return (tn_int128)(cell->at.x1 - cell->at.x0) * (cell->at.y1 - cell->at.y0);
}

/* Does the house have anything in the storey? */
static inline bool tn_house_has_storey(const tn_house *house, uint32_t storey)
{
    for (size_t i = 0; i < house->cell_count; i++)
        if (house->cells[i].storey == storey)
            return true;
    return false;
}

/* Does the section have this value (a SHAPE record)? */
bool tn_house_chosen(const tn_house *house, int64_t shape);

/* Is the section one that the form does not forbid? */
bool tn_house_section_stands(const tn_house *house);

/* May the cell have the function? (An open cell has none.) */
bool tn_cell_may(const tn_house *house, const tn_cell *cell, uint32_t function);

/* What may be in a face, when all functions are given: at least one kind. Returns how many. */
size_t tn_face_options(const tn_house *house, const tn_face *face, uint32_t kinds[TN_FACE_KINDS_MAX]);

/* The same, and which of the form's lines of faces decides it: the first that is about the face and has a kind that
 * fits, counted within the form; TN_NO_RECORD where none does. */
size_t tn_face_decided(const tn_house *house, const tn_face *face, uint32_t kinds[TN_FACE_KINDS_MAX], uint32_t *line);

/* Is the cell in the open? A void is if the cell below it is. */
bool tn_cell_is_outdoor(const tn_house *house, uint32_t cell);

/* Does the weather come to the face: is it outside, or a cell in the open at one side of it? What stands there is an
 * outside wall. Functions alone decide it. */
bool tn_face_is_outer(const tn_house *house, const tn_face *face);

/* The cell whose outside wall the face is: of a face between a cell in the open and another one the other; of one
 * outside its cell. TN_NO_CELL: of none. */
uint32_t tn_face_sheltered(const tn_house *house, const tn_face *face);

/* Is nothing in it that keeps the weather out? Posts stand at its ends then. */
static inline bool tn_face_is_open_side(const tn_house *house, const tn_face *face)
{
    return face->kind == TN_FACE_OPEN && tn_face_is_outer(house, face);
}

/* The thickness of the wall that stands in a face; 0 where none does. */
int64_t tn_face_thickness(const tn_house *house, const tn_face *face);

/* ---- house_line.c */

/* Reads a house line: `plan ; options ; functions ; faces ; tiles`. Parts at the end that leave no choice may be left
 * out. E1611 with its columns where it is no house of the form; errors of the plan as tn_plan_parse_line has them. A
 * line that begins with a brace is a JSON object, and its member "house" the house line: other members are not read. */
tn_status tn_house_read(const tn_house_form *form, const char *line, size_t size, size_t max_trays, tn_house *house,
                        tn_error *error);

/* The same where the tiles may be left out, whatever choice they leave: few rules ask for them. Each cell then has the
 * first that fits, if any does, and house->tiles_left_out is set. */
tn_status tn_house_read_open(const tn_house_form *form, const char *line, size_t size, size_t max_trays,
                             tn_house *house, tn_error *error);

/* What the section has for a choice of the form: "gable(9:12)". */
const char *tn_house_option(const tn_house *house, uint32_t choice);

/* Appends the house's line. TN_MEMORY. */
tn_status tn_house_write(const tn_house *house, tn_buffer *out, tn_error *error);

/* Writes the same choices as members of the object that is open: "section": {CHOICE: VALUE, ...},
 * "functions": [[FUNCTION, ...] of each tray, ...], "faces": [KIND, ...], "tiles": [TILE, ...]. TN_MEMORY; a
 * text that lacks memory itself says so (`failed`). */
tn_status tn_house_write_members(const tn_house *house, tn_json *json, tn_error *error);

/* ---- tiles.c */

/* A tile as it stands in a cell. item_first: of its items in tn_variants. */
typedef struct tn_tile_variant {
    uint32_t tile; /* a TILE record */
    tn_house_side side;
    bool mirrored;
    size_t item_first, item_count;
} tn_tile_variant;

typedef struct tn_standing_item {
    uint32_t box; /* a TILE_BOX record */
    tn_box at;    /* z from the floor of the storey */
} tn_standing_item;

/* All tiles that fit in a cell, when all faces are known. Owns its arrays. */
typedef struct tn_variants {
    bool wanted; /* has the cell's function tiles at all? */
    tn_tile_variant *variants;
    size_t count, room;
    tn_standing_item *items;
    size_t item_count, item_room;
} tn_variants;

tn_status tn_tile_variants(const tn_house *house, uint32_t cell, tn_variants *variants, tn_error *error);
void tn_variants_clear(tn_variants *variants);

/* How many tiles fit in a cell, when all faces are known. Of a cell without tiles 1, or 0 if the form asks for ways and
 * it does not fit; a stack of cells that flights join has its answer at the lowest. */
tn_status tn_cell_fillings(const tn_house *house, uint32_t cell, size_t *count, tn_error *error);

/* Why a tile does not stand: of its sides, turned and mirrored, the one where most of its boxes stand,
 * then the one that is later in this order. */
typedef enum tn_tile_obstacle {
    TN_TILE_STANDS,
    TN_TILE_NO_SIDE, /* no side that it may stand against */
    TN_TILE_SIZE,    /* the clear room is not as wide or deep as it asks for */
    TN_TILE_BEYOND,  /* a box is not inside the room */
    TN_TILE_MEETS_BOX,
    TN_TILE_MEETS_POST,
    TN_TILE_MEETS_CLEAR, /* what an opening needs clear */
    TN_TILE_SHUTS,       /* nobody can stand in a passage */
    TN_TILE_CUTS,        /* no way leads to a passage */
    TN_TILE_CLOSES_KEEP, /* nor to what is kept free */
    TN_TILE_MEETS_LEAF   /* the leaf of a door has no room */
} tn_tile_obstacle;

/* box, other: TILE_BOX records. wide, deep, high: of the clear room, as the tile is turned. kind, at: what is in the
 * face of the passage or leaf, and at which side of the cell. */
typedef struct tn_tile_failure {
    tn_tile_obstacle obstacle;
    uint32_t box, other;
    int64_t wide, deep, high;
    tn_house_side side; /* where its back is */
    bool mirrored;
    uint32_t kind;
    tn_house_side at;
} tn_tile_failure;

bool tn_tile_is_for(const tn_house *house, uint32_t cell, uint32_t tile);

/* TN_TILE_STANDS where it does. TN_MEMORY. */
tn_status tn_tile_fails(const tn_house *house, uint32_t cell, uint32_t tile, tn_tile_failure *failure, tn_error *error);

/* The same in an empty room of this clear size, whose sides are of any kind; of ways it is asked whether one can go
 * from each space to keep to each other, wherever one comes in. */
tn_status tn_tile_fails_in(const tn_house_form *form, int64_t wide, int64_t deep, int64_t height, uint32_t tile,
                           tn_tile_failure *failure, tn_error *error);

/* Does it stand so, plain, with its back at the back of that room? */
tn_status tn_tile_turned_in(const tn_house_form *form, int64_t wide, int64_t deep, int64_t height, uint32_t tile,
                            bool *stands, tn_error *error);

/* All ways in which it stands in that room. Clear in any case. */
tn_status tn_tile_variants_in(const tn_house_form *form, int64_t wide, int64_t deep, int64_t height, uint32_t tile,
                              tn_variants *variants, tn_error *error);

/* Why a tile (a TILE record) does not stand, as the end of a sentence: "`bed` is not inside the room, which is 12' wide
 * and 9' deep". */
void tn_tile_failure_text(const tn_house_form *form, uint32_t tile, const tn_tile_failure *failure,
                          tn_length_style style, char *text, size_t size);

/* A variant's name: `bed.left.m`. */
#define TN_VARIANT_TEXT (TN_NAME_MAX + 16)
void tn_variant_text(const tn_house_form *form, const tn_tile_variant *variant, char text[TN_VARIANT_TEXT]);

/* The side of the cell that a face is on; TN_HOUSE_ANY_SIDE where it is none of its walls. */
tn_house_side tn_face_side(const tn_face *face, uint32_t cell);

/* The clear rectangle of a cell: each side back by half of its thickest wall; an open side as if a wall stood there. */
tn_rectangle tn_cell_clear(const tn_house *house, uint32_t cell);

/* ---- posts.c */

/* Where walls of a storey end: the thickest that runs in y there (thick_x, measured in x), and the thickest that runs
 * in x. Where there are both it is a post, and the walls end at it. */
typedef struct tn_post {
    int64_t x, y, thick_x, thick_y;
} tn_post;

typedef struct tn_posts {
    tn_post *items; /* by x, then y */
    size_t count;
} tn_posts;

/* The posts of a storey; near: those in a rectangle and on its edges, or NULL for all. The caller frees posts->items,
 * also after a failure. */
tn_status tn_house_posts(const tn_house *house, uint32_t storey, const tn_rectangle *near, tn_posts *posts,
                         tn_error *error);

/* The one at a point, where a wall ends. */
const tn_post *tn_posts_find(const tn_posts *posts, int64_t x, int64_t y);

static inline tn_rectangle tn_post_at(const tn_post *post)
{
    return (tn_rectangle){post->x - post->thick_x / 2, post->x + post->thick_x / 2, post->y - post->thick_y / 2,
                          post->y + post->thick_y / 2};
}

/* Where an opening begins whose wall's ends add up to `ends`: in the middle, rounded down to a nanometre. */
static inline int64_t tn_opening_from(int64_t ends, int64_t wide)
{
    int64_t twice = ends - wide;
    return twice >= 0 || twice % 2 == 0 ? twice / 2 : twice / 2 - 1;
}

/* Where an opening begins along its face: in the middle, unless it says how far from an end. */
static inline int64_t tn_opening_begins(const tn_face *face, const tn_opening_record *opening)
{
    bool in_y = face->at.x0 == face->at.x1;
    int64_t low = in_y ? face->at.y0 : face->at.x0, high = in_y ? face->at.y1 : face->at.x1;
    int64_t near = in_y ? opening->at_y : opening->at_x;
    switch ((tn_house_side)(in_y ? opening->near_y : opening->near_x)) {
    case TN_HOUSE_BACK:
    case TN_HOUSE_LEFT:
        return low + near;
    case TN_HOUSE_FRONT:
    case TN_HOUSE_RIGHT:
        return high - near - opening->wide;
    default:
        return tn_opening_from(low + high, opening->wide);
    }
}

/* How long a face has to be for an opening in a wall that runs in x (or in y): with half a wall at either end, or with
 * what it is away from one of them. */
static inline int64_t tn_opening_needs(const tn_house_form *form, const tn_opening_record *opening, bool in_x)
{
    bool near = (in_x ? opening->near_x : opening->near_y) != TN_HOUSE_ANY_SIDE;
    int64_t half = form->record->wall / 2;
    return (near ? in_x ? opening->at_x : opening->at_y : half) + opening->wide + half;
}

/* ---- flight.c */

#define TN_FLIGHT_STEPS_MAX 1000u
#define TN_FLIGHT_PATH_MAX 4u

/* A step that is no box: upright over a triangle or a quadrilateral, whose corners go counter-clockwise seen from above.
 * It goes from levels[0] to levels[2], above the lower floor; the step before it ends at levels[1]. */
typedef struct tn_wedge {
    int64_t at[4][2];
    size_t count;
    int64_t levels[3];
} tn_wedge;

/* Around a wedge; z from the lower floor. */
tn_box tn_wedge_box(const tn_wedge *wedge);

/* A flight of stairs as it stands, from one floor to the next. face: it is in; holes: what it takes of the floor above.
 * treads: by height, with landings among them; wedges: those that are no boxes. path: how one walks up it. If the form
 * asks for ways: foot, head: where one stands before it and behind it; last: where the last steps are, before the head;
 * drops: what of its holes one may fall far into; low: what of it one cannot walk under; length: how far one walks from
 * the middle of the foot to that of the head. Owns its arrays: clear it in any case. */
typedef struct tn_flight {
    uint32_t face;
    tn_rectangle *holes;
    size_t hole_count;
    tn_rectangle *drops;
    size_t drop_count;
    tn_rectangle *low;
    size_t low_count;
    int64_t length;
    tn_rectangle foot, head, last;
    tn_box *treads; /* z from the lower floor */
    size_t tread_count;
    tn_wedge *wedges;
    size_t wedge_count;
    int64_t path[TN_FLIGHT_PATH_MAX][2];
    size_t path_count;
} tn_flight;

/* How many steps a flight has in a storey, and how much room it takes between walls: as it is climbed at first, and
 * across that. steps: 0 where the storey is no whole number of them. turns: by a right angle; it takes less one way and
 * more the other, too. */
typedef struct tn_flight_size {
    int64_t steps, deep, wide;
    bool turns;
} tn_flight_size;

/* How many treads it has where it turns: a landing is one. */
static inline int64_t tn_flight_corners(const tn_opening_record *flight)
{
    bool half = flight->turn == TN_TURN_HALF;
    return flight->winders ? (half ? 2 : 1) * (int64_t)flight->winders : 1;
}

tn_flight_size tn_flight_size_in(const tn_house_form *form, uint32_t storey, const tn_opening_record *flight);

/* Does a flight fit between the two cells of a face? Their functions have no tiles, there is room for its steps, for
 * landings and, at either end, for standing before it, and the storey is a whole number of steps. */
bool tn_flight_fits(const tn_house *house, const tn_face *face, const tn_opening_record *flight);

/* Stands up the flight in a face, where it has one: at a side from which one can come, if it fits so; or, if the form
 * asks for ways, in the first place with which all cells of its stack fit. */
tn_status tn_flight_stand(const tn_house *house, const tn_face *face, tn_flight *flight, tn_error *error);
void tn_flight_clear(tn_flight *flight);

/* All flights of a house, by their faces. Owns them. */
typedef struct tn_flights {
    tn_flight *items;
    size_t count;
} tn_flights;

/* Clear it in any case. TN_MEMORY. */
tn_status tn_flights_stand(const tn_house *house, tn_flights *flights, tn_error *error);
void tn_flights_clear(tn_flights *flights);

/* ---- bearing.c */

/* A stretch of outside and party walls, above the lowest storey, over nothing that is as thick: along a plane across x
 * (in_y) or across y. held: does each of its ends rest on a wall as thick or a post below? beam: the form's beam that
 * bears it, with its box; TN_NO_RECORD: none does. */
typedef struct tn_unborne {
    uint32_t storey; /* of the walls */
    bool in_y, held;
    int64_t plane, from, to;
    uint32_t beam;
    tn_box at;
} tn_unborne;

/* All of them, in the order of faces. Owns them. */
typedef struct tn_bearing {
    tn_unborne *items;
    size_t count, room;
} tn_bearing;

/* Clear it in any case. TN_MEMORY. */
tn_status tn_house_bearing(const tn_house *house, const tn_flights *flights, tn_bearing *bearing, tn_error *error);
void tn_bearing_clear(tn_bearing *bearing);

/* Does a wall stand there over nothing that is as thick, nor a beam? from, to: along the face, the longest stretch
 * without, the first of equal ones; *of: what it is a part of, if not NULL. */
bool tn_face_hangs(const tn_bearing *bearing, const tn_face *face, int64_t *from, int64_t *to,
                   const tn_unborne **of);

/* ---- rooms.c */

/* The room of each cell, as the lowest cell of it: cells of one function joined by open faces, and the voids above. The
 * caller frees *rooms. */
tn_status tn_house_rooms(const tn_house *house, uint32_t **rooms, tn_error *error);

/* The areas of a room (its lowest cell) between the planes of its walls, and between the walls, in square nanometres;
 * voids do not count. Returns how many cells do. */
uint32_t tn_room_areas(const tn_house *house, const uint32_t *rooms, uint32_t room, tn_int128 *gross, tn_int128 *net);

/* The area of the glazed openings in the outside faces of a room (its lowest cell), in square nanometres. */
tn_int128 tn_face_glazing(const tn_house *house, const tn_face *face); /* of one face: that of its sheltered cell */
tn_int128 tn_room_glazing(const tn_house *house, const uint32_t *rooms, uint32_t room);

#endif
