/* Finds the cells of a plan that keep all houses off it, one cell at a time. */
#include "runtime/house/bare.h"

#include <stdlib.h>

#include "runtime/base/array.h"
#include "runtime/house/form/form.h"

enum {
    WALLS_MAX = 64,      /* of one cell; one with more is taken for furnished */
    CASES_MAX = 4096,    /* ways in which its walls can be; likewise */
    STEPS_MAX = 1000000, /* tiles that are tried */
};

/* The walls around a cell with its function, each with the kinds that it may have. */
typedef struct tn_walls {
    tn_house *house;
    uint32_t cell, count;
    uint32_t faces[WALLS_MAX], at[WALLS_MAX], kind_count[WALLS_MAX];
    uint32_t kinds[WALLS_MAX][TN_FACE_KINDS_MAX];
    bool too_many;
} tn_walls;

/* ---- walls */

static void add_kinds(tn_walls *w, const tn_face *face)
{
    uint32_t options[TN_FACE_KINDS_MAX], wall = w->count, known = w->kind_count[wall];
    size_t count = tn_face_options(w->house, face, options);
    for (size_t i = 0; i < count; i++) {
        uint32_t k = 0;
        while (k < known && w->kinds[wall][k] != options[i])
            k++;
        if (k == known)
            w->kinds[wall][known++] = options[i];
    }
    w->kind_count[wall] = known;
}

/* With each function that the cell on the other side may have. */
static void add_wall(tn_walls *w, uint32_t number)
{
    tn_face *face = &w->house->faces[number];
    uint32_t other = face->first == w->cell ? face->second : face->first, before = TN_NO_FUNCTION;
    w->too_many |= w->count == WALLS_MAX;
    if (w->too_many)
        return;
    w->faces[w->count] = number;
    w->kind_count[w->count] = w->at[w->count] = 0;
    for (uint32_t f = 0; other != TN_NO_CELL && f < tn_form_functions(w->house->form); f++) {
        if (!tn_cell_may(w->house, &w->house->cells[other], f))
            continue;
        before = w->house->cells[other].function;
        w->house->cells[other].function = f;
        add_kinds(w, face);
        w->house->cells[other].function = before;
    }
    if (w->kind_count[w->count] == 0)
        add_kinds(w, face);
    face->kind = w->kinds[w->count++][0];
}

/* All other walls are open: then they are in no tile's way. */
static void gather_walls(tn_house *house, uint32_t cell, tn_walls *w)
{
    uint64_t cases = 1;
    w->house = house;
    w->cell = cell;
    w->count = 0;
    w->too_many = false;
    for (uint32_t i = 0; i < house->face_count; i++)
        if (house->faces[i].relation != TN_FACE_UNDER)
            house->faces[i].kind = TN_FACE_OPEN;
    for (uint32_t i = 0; i < house->face_count; i++)
        if (house->faces[i].relation != TN_FACE_UNDER &&
            (house->faces[i].first == cell || house->faces[i].second == cell))
            add_wall(w, i);
    for (uint32_t i = 0; i < w->count && cases <= CASES_MAX; i++)
        cases *= w->kind_count[i];
    w->too_many |= cases > CASES_MAX;
}

/* The next case; false after the last. */
static bool turn(tn_walls *w)
{
    for (uint32_t i = w->count; i-- > 0;) {
        w->at[i] = w->at[i] + 1 < w->kind_count[i] ? w->at[i] + 1 : 0;
        w->house->faces[w->faces[i]].kind = w->kinds[i][w->at[i]];
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

/* Does some tile of the cell's function stand, with some walls around it? */
static tn_status may_stand(tn_house *house, uint32_t cell, tn_walls *w, uint32_t *steps, bool *stands, tn_error *error)
{
    tn_status status = TN_OK;
    *stands = !has_tiles(house, cell);
    if (*stands)
        return TN_OK;
    gather_walls(house, cell, w);
    *stands = w->too_many;
    do {
        tn_variants tiles = {0};
        if (++*steps > STEPS_MAX)
            return too_long(error);
        if (!*stands)
            status = tn_tile_variants(house, cell, &tiles, error);
        *stands |= tiles.count > 0;
        tn_variants_clear(&tiles);
    } while (status == TN_OK && !*stands && turn(w));
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
    tn_walls *walls = malloc(sizeof *walls);
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
        house.ways_unknown = true; /* what cells beside it are is not known */
        status = see_section(&house, walls, &steps, first, bare, error);
        first = false;
    } while (status == TN_OK && (first || bare->count > 0) && tn_form_next_section(form, shapes));
    free(walls);
    return status;
}

void tn_bare_clear(tn_bare_cells *bare)
{
    tn_house_clear(&bare->house);
    free(bare->cells);
    *bare = (tn_bare_cells){0};
}

/* ---- why */

tn_status tn_bare_why(tn_bare_cells *bare, uint32_t cell, uint32_t function, uint32_t tile, tn_tile_failure *failure,
                      tn_error *error)
{
    tn_house *house = &bare->house;
    tn_walls *walls = malloc(sizeof *walls);
    tn_status status = walls ? TN_OK : tn_fail_memory(error);
    *failure = (tn_tile_failure){.obstacle = TN_TILE_NO_SIDE};
    if (status == TN_OK) {
        house->cells[cell].function = function;
        gather_walls(house, cell, walls);
    }
    while (status == TN_OK) {
        tn_tile_failure one;
        status = tn_tile_fails(house, cell, tile, &one, error);
        if (status == TN_OK && one.obstacle > failure->obstacle)
            *failure = one;
        if (!turn(walls))
            break;
    }
    house->cells[cell].function = TN_NO_FUNCTION;
    free(walls);
    return status;
}
