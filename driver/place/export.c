/* Writes a kit's model as a connection grammar: the space as boxes that are filled, then the rules. */
#include "driver/place/export.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/place/search/search.h"
#include "runtime/place/space.h"

enum { CELLS_MAX = 1 << 26 };

/* ---- what cannot be said */

static tn_status refuse(tn_error *error, const char *what, const char *name, const char *help)
{
    tn_fail(error, TN_INVALID, E_KIT_EXPORT, "%s: %.100s", what, name);
    tn_error_help(error, "%s", help);
    return TN_INVALID;
}

static tn_status check_step(const tn_step *step, const char *symbol, tn_error *error)
{
    if (step->kind == TN_STEP_BLOCK && ((step->b[0] - step->a[0]) % 2 || (step->b[2] - step->a[2]) % 2))
        return refuse(error, "connection grammars fill an even number of cells across", symbol,
                      "make the part an even number of cells wide and deep");
    if (step->kind == TN_STEP_PART && strpbrk(step->text, "r'\"()"))
        return refuse(error, "connection grammars cannot name this part", step->text,
                      "leave r, quotes and parentheses out of its name");
    return TN_OK;
}

static tn_status check_rules(const tn_place_rules *rules, tn_error *error)
{
    tn_status status = TN_OK;
    double unit[3];
    tn_place_unit(rules->module, unit);
    if (tn_place_turns(rules->module) > TN_UPRIGHT_TURNS)
        return refuse(error, "connection grammars turn parts about the vertical only",
                      tn_text(rules->module, rules->space->name), "leave `turns 24` out of the kit's unit");
    if (unit[0] != 10 || unit[1] != 8)
        return refuse(error, "a cell of connection grammars is 10 x 8 x 10 LDU",
                      tn_text(rules->module, rules->space->name), "write `unit 10 x 8 x 10;` in the kit");
    if (tn_place_needs_search(rules))
        return refuse(error, "connection grammars have no search, images, stock or order",
                      tn_text(rules->module, rules->space->name),
                      "leave `search`, `symmetry`, `stock` and `order breadth` out of the model, or write an .ldr file "
                      "by `tartan place`");
    for (uint32_t s = 0; s < rules->symbol_count && status == TN_OK; s++) {
        const tn_place_symbol *symbol = &rules->symbols[s];
        for (uint32_t a = 0; a < symbol->count && status == TN_OK; a++) {
            const tn_place_alternative *alternative = &rules->alternatives[symbol->first + a];
            if (alternative->member)
                return refuse(error, "connection grammars do not draw among those that fit", symbol->name,
                              "write the alternatives of the rule without ( ) and weights");
            for (uint32_t i = 0; i < alternative->count && status == TN_OK; i++)
                status = check_step(&rules->steps[alternative->first + i], symbol->name, error);
        }
    }
    return status;
}

/* ---- the space */

/* The cells within half[k] of the origin: 0 inside of the space, 1 outside, 2 outside and written already. */
typedef struct grid {
    int32_t half[3];
    uint8_t *cells;
} grid;

static uint8_t *cell_at(const grid *g, int32_t x, int32_t y, int32_t z)
{
    int32_t at[3] = {x, y, z};
    size_t index = 0;
    for (int k = 0; k < 3; k++)
        index = index * (size_t)(2 * g->half[k]) + (size_t)(at[k] + g->half[k]);
    return &g->cells[index];
}

static tn_cell_box within_grid(const grid *g, const tn_cell_box *box)
{
    tn_cell_box cut = *box;
    for (int k = 0; k < 3; k++) {
        cut.low[k] = cut.low[k] < -g->half[k] ? -g->half[k] : cut.low[k];
        cut.high[k] = cut.high[k] > g->half[k] ? g->half[k] : cut.high[k];
    }
    return cut;
}

/* Nothing comes to what lies beyond the bound: it may be filled. */
static bool is_blocked(const grid *g, const tn_cell_box *given)
{
    tn_cell_box box = within_grid(g, given);
    for (int32_t x = box.low[0]; x < box.high[0]; x++)
        for (int32_t y = box.low[1]; y < box.high[1]; y++)
            for (int32_t z = box.low[2]; z < box.high[2]; z++)
                if (!*cell_at(g, x, y, z))
                    return false;
    return true;
}

/* Makes the box longer along an axis for as long as what is added is blocked. */
static void stretch(const grid *g, tn_cell_box *box, int axis, int32_t by)
{
    while (box->high[axis] < g->half[axis]) {
        tn_cell_box more = *box;
        more.low[axis] = box->high[axis];
        more.high[axis] = box->high[axis] + by;
        if (!is_blocked(g, &more))
            return;
        box->high[axis] = more.high[axis];
    }
}

/* A box of an even number of cells across that has this cell, all of it blocked. */
static bool cover(const grid *g, int32_t x, int32_t y, int32_t z, tn_cell_box *box)
{
    for (int way = 0; way < 4; way++) {
        int32_t low_x = x - (way & 1), low_z = z - (way >> 1);
        *box = (tn_cell_box){{low_x, y, low_z}, {low_x + 2, y + 1, low_z + 2}};
        if (!is_blocked(g, box))
            continue;
        stretch(g, box, 0, 2);
        stretch(g, box, 2, 2);
        stretch(g, box, 1, 1);
        return true;
    }
    return false;
}

static void write_box(const grid *g, const tn_cell_box *box, FILE *out)
{
    fprintf(out, " '(' 'Move(%d,%d,%d)' 'FillRectNoCheck(%d,%d,%d)' ')'", (box->low[0] + box->high[0]) / 2, box->low[1],
            (box->low[2] + box->high[2]) / 2, box->high[0] - box->low[0], box->high[1] - box->low[1],
            box->high[2] - box->low[2]);
    tn_cell_box cut = within_grid(g, box);
    for (int32_t x = cut.low[0]; x < cut.high[0]; x++)
        for (int32_t y = cut.low[1]; y < cut.high[1]; y++)
            for (int32_t z = cut.low[2]; z < cut.high[2]; z++)
                *cell_at(g, x, y, z) = 2;
}

static tn_status write_blocked(const grid *g, FILE *out, tn_error *error)
{
    for (int32_t y = -g->half[1]; y < g->half[1]; y++) {
        for (int32_t z = -g->half[2]; z < g->half[2]; z++) {
            for (int32_t x = -g->half[0]; x < g->half[0]; x++) {
                tn_cell_box box;
                if (*cell_at(g, x, y, z) != 1)
                    continue;
                if (!cover(g, x, y, z, &box))
                    return refuse(error, "connection grammars fill an even number of cells across",
                                  "a gap of the space is one cell wide", "make it wider");
                write_box(g, &box, out);
            }
        }
    }
    return TN_OK;
}

static tn_status look_at_space(const tn_place_rules *rules, grid *g, tn_error *error)
{
    tn_space *space;
    tn_cells *cells = tn_cells_new(NULL);
    tn_status status = cells ? tn_space_new(rules, &space, error) : tn_fail_memory(error);
    if (status != TN_OK) {
        tn_cells_free(cells);
        return status;
    }
    tn_cells_bound(cells, tn_space_cells(space));
    for (int32_t x = -g->half[0]; x < g->half[0]; x++) {
        for (int32_t y = -g->half[1]; y < g->half[1]; y++) {
            for (int32_t z = -g->half[2]; z < g->half[2]; z++) {
                tn_cell_box one = {{x, y, z}, {x + 1, y + 1, z + 1}};
                *cell_at(g, x, y, z) = tn_cells_any(cells, &one);
            }
        }
    }
    status = tn_cells_status(cells, error);
    tn_cells_free(cells);
    tn_space_free(space);
    return status;
}

/* The first bound lies about the origin: any step before it would be followed by a bound of its own. */
static tn_status write_space(const tn_place_rules *rules, FILE *out, tn_error *error)
{
    const tn_kit_model_record *m = rules->space;
    const int64_t low[3] = {m->low_x, m->low_y, m->low_z}, high[3] = {m->high_x, m->high_y, m->high_z};
    grid g = {.cells = NULL};
    double count = 1;
    for (int k = 0; k < 3; k++) {
        int64_t half = -low[k] > high[k] ? -low[k] : high[k];
        g.half[k] = (int32_t)(half < 1 ? 1 : half);
        count *= 2 * (double)g.half[k];
    }
    if (count > CELLS_MAX)
        return tn_fail(error, TN_LIMIT, E_PLACE_LIMIT,
                       "the space and what lies between it and the origin have more than %d cells", CELLS_MAX);
    g.cells = malloc((size_t)count);
    if (!g.cells)
        return tn_fail_memory(error);
    tn_status status = look_at_space(rules, &g, error);
    fprintf(out, "'PlaceBoundingBox(%d,%d,%d)'", g.half[0], g.half[1], g.half[2]);
    if (status == TN_OK)
        status = write_blocked(&g, out, error);
    free(g.cells);
    return status;
}

/* ---- rules */

static void write_name(const tn_place_rules *rules, uint32_t symbol, FILE *out)
{
    for (const char *c = rules->symbols[symbol].name; *c; c++)
        if (isalnum((unsigned char)*c) && (unsigned char)*c < 128)
            fputc(*c, out);
        else if (c[1])
            fputc('_', out);
    fprintf(out, "_%u", symbol);
}

/* A terminal for each step; those of a box come out together, between blanks. */
static void write_steps(const tn_place_rules *rules, const tn_place_alternative *alternative, FILE *out)
{
    for (uint32_t i = 0; i < alternative->count; i++) {
        const tn_step *step = &rules->steps[alternative->first + i];
        fputc(' ', out);
        if (step->kind == TN_STEP_EXPAND) {
            write_name(rules, step->index, out);
        } else if (step->kind == TN_STEP_BLOCK) {
            const int32_t *a = step->a, *b = step->b;
            fprintf(out, "'(' 'Move(%d,%d,%d)' 'FillRect(%d,%d,%d)' ')'", (a[0] + b[0]) / 2, a[1], (a[2] + b[2]) / 2,
                    b[0] - a[0], b[1] - a[1], b[2] - a[2]);
        } else {
            fputc('\'', out);
            tn_step_write(step, out);
            fputc('\'', out);
        }
    }
    fputc('\n', out);
}

static void write_symbol(const tn_place_rules *rules, uint32_t s, FILE *out)
{
    const tn_place_symbol *symbol = &rules->symbols[s];
    fputc('\n', out);
    for (uint32_t a = 0; a < symbol->count; a++) {
        write_name(rules, s, out);
        fputs(" ->", out);
        write_steps(rules, &rules->alternatives[symbol->first + a], out);
    }
}

/* Which symbols the start leads to. */
static bool *find_reached(const tn_place_rules *rules)
{
    bool *reached = calloc(rules->symbol_count, sizeof *reached), changed = reached != NULL;
    if (reached)
        reached[rules->start] = true;
    while (changed) {
        changed = false;
        for (uint32_t s = 0; s < rules->symbol_count; s++) {
            const tn_place_symbol *symbol = &rules->symbols[s];
            const tn_place_alternative *last = &rules->alternatives[symbol->first + symbol->count - 1];
            uint32_t i = rules->alternatives[symbol->first].first;
            for (; reached[s] && i < last->first + last->count; i++) {
                const tn_step *step = &rules->steps[i];
                changed |= step->kind == TN_STEP_EXPAND && !reached[step->index];
                if (step->kind == TN_STEP_EXPAND)
                    reached[step->index] = true;
            }
        }
    }
    return reached;
}

tn_status tn_kit_export(const tn_place_rules *rules, FILE *out, tn_error *error)
{
    tn_status status = check_rules(rules, error);
    if (status != TN_OK)
        return status;
    bool *reached = find_reached(rules);
    if (!reached)
        return tn_fail_memory(error);
    fprintf(out, "# %s, a model of a kit, as a connection grammar\n\nModel -> ",
            tn_text(rules->module, rules->space->name));
    status = write_space(rules, out, error);
    write_steps(rules, &rules->alternatives[rules->symbols[rules->start].first], out);
    for (uint32_t s = 0; s < rules->symbol_count && status == TN_OK; s++)
        if (s != rules->start && reached[s])
            write_symbol(rules, s, out);
    free(reached);
    return status;
}
