/* Finds the cells of a plan that keep all houses off it, one cell at a time. */
#include "runtime/house/bare.h"

#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/house/form/form.h"
#include "runtime/house/ways.h"

enum {
    WALLS_MAX = 64,      /* of one cell; one with more is taken for furnished */
    CHOICES_MAX = 64,    /* for one of them; likewise */
    CASES_MAX = 4096,    /* ways in which its walls can be; likewise */
    STEPS_MAX = 1000000, /* tiles that are tried */
};

/* What may be in a wall, with a function of the cell beyond it, since that decides how thick the wall is; if the form
 * asks for ways, with what is beyond it then. */
typedef struct tn_wall_choice {
    uint32_t kind, beyond;
    tn_face_view view;
} tn_wall_choice;

/* The walls around a cell with its function, each with what may be in it. views: [faces] of the case at hand, owned. */
typedef struct tn_walls {
    tn_house *house;
    uint32_t cell, count;
    uint32_t faces[WALLS_MAX], at[WALLS_MAX], choice_count[WALLS_MAX];
    tn_wall_choice choices[WALLS_MAX][CHOICES_MAX];
    tn_face_view *views;
    size_t view_room;
    bool too_many;
} tn_walls;

/* ---- walls */

static uint32_t beyond(const tn_walls *w, uint32_t number)
{
    const tn_face *face = &w->house->faces[number];
    return face->first == w->cell ? face->second : face->first;
}

static bool is_outdoor(const tn_walls *w, uint32_t function)
{
    return function != TN_NO_FUNCTION && tn_form_is_outdoor(w->house->form, function);
}

static void add_choice(tn_walls *w, uint32_t number, uint32_t kind)
{
    uint32_t other = beyond(w, number),
             function = other == TN_NO_CELL ? TN_NO_FUNCTION : w->house->cells[other].function;
    tn_wall_choice choice = {.kind = kind, .beyond = function}, *known = w->choices[w->count];
    w->house->faces[number].kind = kind;
    if (!w->house->ways_unknown)
        choice.view = tn_face_seen(w->house, number, w->cell);
    for (uint32_t i = 0; i < w->choice_count[w->count]; i++)
        if (known[i].kind == kind && known[i].view.beyond == choice.view.beyond &&
            known[i].view.leaf == choice.view.leaf && is_outdoor(w, known[i].beyond) == is_outdoor(w, function))
            return;
    w->too_many |= w->choice_count[w->count] == CHOICES_MAX;
    if (!w->too_many)
        known[w->choice_count[w->count]++] = choice;
}

static void add_kinds(tn_walls *w, uint32_t number)
{
    uint32_t options[TN_FACE_KINDS_MAX];
    size_t count = tn_face_options(w->house, &w->house->faces[number], options);
    for (size_t i = 0; i < count; i++)
        add_choice(w, number, options[i]);
}

static void take(tn_walls *w, uint32_t wall, uint32_t choice)
{
    uint32_t other = beyond(w, w->faces[wall]);
    w->at[wall] = choice;
    if (other != TN_NO_CELL)
        w->house->cells[other].function = w->choices[wall][choice].beyond;
    w->house->faces[w->faces[wall]].kind = w->choices[wall][choice].kind;
    w->views[w->faces[wall]] = w->choices[wall][choice].view;
}

/* With each function that the cell on the other side may have. */
static void add_wall(tn_walls *w, uint32_t number)
{
    uint32_t other = beyond(w, number), before = TN_NO_FUNCTION;
    w->too_many |= w->count == WALLS_MAX;
    if (w->too_many)
        return;
    w->faces[w->count] = number;
    w->choice_count[w->count] = 0;
    for (uint32_t f = 0; other != TN_NO_CELL && f < tn_form_functions(w->house->form); f++) {
        if (!tn_cell_may(w->house, &w->house->cells[other], f))
            continue;
        before = w->house->cells[other].function;
        w->house->cells[other].function = f;
        add_kinds(w, number);
        w->house->cells[other].function = before;
    }
    if (w->choice_count[w->count] == 0)
        add_kinds(w, number);
    w->count++;
}

/* All other walls are open: then they are in no tile's way. Leave it with leave_walls. */
static tn_status gather_walls(tn_house *house, uint32_t cell, tn_walls *w, tn_error *error)
{
    uint64_t cases = 1;
    w->house = house;
    w->cell = cell;
    w->count = 0;
    w->too_many = false;
    if (!tn_array_reserve(&w->views, &w->view_room, 0, (size_t)house->face_count + 1, sizeof *w->views))
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < house->face_count; i++)
        if (house->faces[i].relation != TN_FACE_UNDER)
            house->faces[i].kind = TN_FACE_OPEN;
    for (uint32_t i = 0; i < house->face_count; i++)
        if (house->faces[i].relation != TN_FACE_UNDER &&
            (house->faces[i].first == cell || house->faces[i].second == cell))
            add_wall(w, i);
    for (uint32_t i = 0; i < w->count && cases <= CASES_MAX; i++)
        cases *= w->choice_count[i];
    w->too_many |= cases > CASES_MAX;
    for (uint32_t i = 0; i < w->count; i++)
        take(w, i, 0);
    house->views = w->views;
    return TN_OK;
}

/* The cells around have no functions again. */
static void leave_walls(tn_walls *w)
{
    for (uint32_t i = 0; i < w->count; i++)
        if (beyond(w, w->faces[i]) != TN_NO_CELL)
            w->house->cells[beyond(w, w->faces[i])].function = TN_NO_FUNCTION;
    w->house->views = NULL;
}

static void free_walls(tn_walls *w)
{
    if (w)
        free(w->views);
    free(w);
}

/* The next case; false after the last. */
static bool turn(tn_walls *w)
{
    for (uint32_t i = w->count; i-- > 0;) {
        take(w, i, w->at[i] + 1 < w->choice_count[i] ? w->at[i] + 1 : 0);
        if (w->at[i] > 0)
            return true;
    }
    return false;
}

/* ---- cells */

static tn_status too_long(tn_error *error)
{
    tn_status status =
        tn_fail(error, TN_LIMIT, E_VARIANTS,
                "finding the cells of this plan that can have no tile takes more than %d steps", STEPS_MAX);
    tn_error_help(error, "take a shorter plan, or a form with fewer choices");
    return status;
}

static bool has_tiles(const tn_house *house, uint32_t cell)
{
    const tn_form_record *form = house->form->record;
    for (uint32_t t = 0; t < form->tile_count; t++)
        if (tn_tile_is_for(house, cell, form->tile_first + t))
            return true;
    return false;
}

/* Is there anything to ask? Of a function without tiles, ways; but of flights of stairs the whole stack. */
static bool is_asked(const tn_house *house, uint32_t cell)
{
    return has_tiles(house, cell) ||
           (!house->ways_unknown && tn_form_is_bare(house->form, house->cells[cell].function));
}

/* Does some tile of the cell's function stand, and can one go about, with some walls around it? */
static tn_status may_stand(tn_house *house, uint32_t cell, tn_walls *w, uint32_t *steps, bool *stands, tn_error *error)
{
    *stands = !is_asked(house, cell);
    if (*stands)
        return TN_OK;
    tn_status status = gather_walls(house, cell, w, error);
    *stands = w->too_many;
    while (status == TN_OK && !*stands) {
        size_t fillings = 0;
        status = ++*steps > STEPS_MAX ? too_long(error) : tn_cell_fillings(house, cell, &fillings, error);
        *stands = fillings > 0;
        if (!turn(w))
            break;
    }
    leave_walls(w);
    return status;
}

/* The cell is without a function then, as before. */
static tn_status is_bare(tn_house *house, uint32_t cell, tn_walls *w, uint32_t *steps, bool *bare, tn_error *error)
{
    tn_cell *c = &house->cells[cell];
    tn_status status = TN_OK;
    *bare = !c->open;
    for (uint32_t f = 0; status == TN_OK && *bare && f < tn_form_functions(house->form); f++) {
        bool stands = false;
        if (!tn_cell_may(house, c, f))
            continue;
        c->function = f;
        status = may_stand(house, cell, w, steps, &stands, error);
        c->function = TN_NO_FUNCTION;
        *bare = !stands;
    }
    return status;
}

/* ---- sections */

/* Keeps the section if fewer cells are bare in it than in those before. */
static tn_status see_section(tn_house *house, tn_walls *w, uint32_t *steps, bool first, tn_bare_cells *found,
                             tn_error *error)
{
    uint32_t *cells = malloc((house->cell_count + 1) * sizeof *cells);
    size_t count = 0;
    tn_status status = cells ? TN_OK : tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i < house->cell_count && (first || count < found->count); i++) {
        bool bare = false;
        status = is_bare(house, i, w, steps, &bare, error);
        if (bare)
            cells[count++] = i;
    }
    if (status != TN_OK || !(first || count < found->count)) {
        free(cells);
        tn_house_clear(house);
        return status;
    }
    tn_bare_clear(found);
    *found = (tn_bare_cells){*house, cells, count};
    return TN_OK;
}

tn_status tn_bare_find(const tn_house_form *form, const tn_tray *trays, size_t length, tn_bare_cells *bare,
                       tn_error *error)
{
    uint32_t shapes[TN_CHOICES_MAX] = {0}, steps = 0;
    bool first = true;
    tn_walls *walls = calloc(1, sizeof *walls);
    tn_status status = walls ? TN_OK : tn_fail_memory(error);
    *bare = (tn_bare_cells){0};
    do {
        tn_house house = {0};
        if (status == TN_OK)
            status = tn_house_stand(form, trays, length, shapes, &house, error);
        if (status != TN_OK || !tn_house_section_stands(&house)) {
            tn_house_clear(&house);
            continue;
        }
        house.ways_unknown = !tn_form_asks_ways(form);
        status = see_section(&house, walls, &steps, first, bare, error);
        first = false;
    } while (status == TN_OK && (first || bare->count > 0) && tn_form_next_section(form, shapes));
    free_walls(walls);
    return status;
}

void tn_bare_clear(tn_bare_cells *bare)
{
    tn_house_clear(&bare->house);
    free(bare->cells);
    *bare = (tn_bare_cells){0};
}

/* ---- why */

/* What is found with the walls of a case: comes it further than what was found before? */
typedef tn_status see_case(void *context, const tn_house *house, uint32_t cell, tn_error *error);

static tn_status each_case(tn_house *house, uint32_t cell, uint32_t function, see_case *see, void *context,
                           tn_error *error)
{
    tn_walls *walls = calloc(1, sizeof *walls);
    tn_status status = walls ? TN_OK : tn_fail_memory(error);
    house->cells[cell].function = function;
    if (status == TN_OK)
        status = gather_walls(house, cell, walls, error);
    while (status == TN_OK) {
        status = see(context, house, cell, error);
        if (!turn(walls))
            break;
    }
    if (walls)
        leave_walls(walls);
    house->cells[cell].function = TN_NO_FUNCTION;
    free_walls(walls);
    return status;
}

typedef struct tile_seen {
    uint32_t tile;
    tn_tile_failure *failure;
} tile_seen;

static tn_status see_tile(void *context, const tn_house *house, uint32_t cell, tn_error *error)
{
    const tile_seen *seen = context;
    tn_tile_failure one;
    tn_status status = tn_tile_fails(house, cell, seen->tile, &one, error);
    if (status == TN_OK && one.obstacle > seen->failure->obstacle)
        *seen->failure = one;
    return status;
}

tn_status tn_bare_why(tn_bare_cells *bare, uint32_t cell, uint32_t function, uint32_t tile, tn_tile_failure *failure,
                      tn_error *error)
{
    tile_seen seen = {tile, failure};
    *failure = (tn_tile_failure){.obstacle = TN_TILE_NO_SIDE};
    return each_case(&bare->house, cell, function, see_tile, &seen, error);
}

static tn_status see_fault(void *context, const tn_house *house, uint32_t cell, tn_error *error)
{
    tn_way_fault *fault = context, one;
    tn_status status = tn_cell_ways(house, cell, &one, error);
    if (status == TN_OK && one.fault > fault->fault)
        *fault = one;
    return status;
}

tn_status tn_bare_fault(tn_bare_cells *bare, uint32_t cell, uint32_t function, tn_way_fault *fault, tn_error *error)
{
    *fault = (tn_way_fault){0};
    return each_case(&bare->house, cell, function, see_fault, fault, error);
}
