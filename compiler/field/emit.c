/* From checked fields to a module: a function and a record for each surface, and the meshes that distances are of. */
#include <math.h>
#include <string.h>

#include "compiler/common/diagnostic.h"
#include "compiler/common/import.h"
#include "compiler/field/field.h"
#include "runtime/module/code.h"
#include "runtime/number/interval.h"
#include "runtime/number/run.h"

#define DEFAULT_GRID 50
#define DEFAULT_REACH 7.0 /* the box of Jacob's experiments: -7 to 7 */
#define INLINE_MAX 64u    /* numbers that a part may hold at once before it is kept instead */

typedef struct emit {
    tn_builder *builder;
    tn_arena *arena;
    tn_diagnostics *diagnostics;
    const tn_checked_fields *checked;
    tn_field_nodes nodes;
    double low[3], high[3];
    uint32_t grid, unit;
    bool wrong;
} emit;

/* ---- what all surfaces share */

static uint32_t arity_of(const tn_field_node *node)
{
    return node->op == TN_OP_NUMBER || node->op == TN_OP_COORDINATE ? 0 : tn_code_effect((uint8_t)node->op).pops;
}

/* What a node is made of stands before it. */
static bool has_coordinate(const emit *e, uint32_t node)
{
    bool *used = TN_NEW_ARRAY(e->arena, bool, (size_t)node + 1);
    if (!used)
        return false;
    used[node] = true;
    for (uint32_t i = node + 1; i-- > 0;) {
        const tn_field_node *it = &e->nodes.items[i];
        if (used[i] && (it->op == TN_OP_COORDINATE || it->op == TN_OP_MESH_DISTANCE))
            return true;
        for (uint32_t k = 0; used[i] && k < arity_of(it); k++)
            used[it->in[k]] = true;
    }
    return false;
}

static double constant(emit *e, const tn_expression *of, const char *what, const char *help)
{
    uint32_t node = tn_field_expand(&e->nodes, of);
    bool known = e->nodes.fits == TN_FIELD_FITS && e->nodes.count > node && e->nodes.items[node].op == TN_OP_NUMBER;
    if (known)
        return e->nodes.items[node].number;
    bool fits = e->nodes.fits == TN_FIELD_FITS && e->nodes.count > node;
    bool none = fits && !has_coordinate(e, node);
    tn_diagnostic *d = tn_report(e->diagnostics, E_FIELD_CONSTANT, of->span, "%s is a number, but this %s", what,
                                 none ? "has no value: a part of it is not defined, or is too large"
                                      : "depends on the point where it is computed");
    if (!none)
        tn_help(e->diagnostics, d, "%s", help);
    e->wrong = true;
    return 0;
}

static void check_constants(emit *e)
{
    for (uint32_t i = 0; i < e->checked->definition_count; i++)
        if (e->checked->definitions[i]->kind == TN_FIELD_LET)
            constant(e, e->checked->definitions[i]->body, "what `let` names",
                     "write `surface` for `let`: other formulas may use a surface by its name");
}

static void refuse_box(emit *e, tn_span span, const char *what, const char *help)
{
    tn_diagnostic *d = tn_report(e->diagnostics, E_FIELD_BOX, span, "%s", what);
    tn_help(e->diagnostics, d, "%s", help);
    e->wrong = true;
}

static void take_corner(emit *e, const tn_expression *corner, double out[3])
{
    int axis = 0;
    if (corner->operand_count != 3) {
        refuse_box(e, corner->span, "a corner has three coordinates", "write `box (-7, -7, -7)..(7, 7, 7)`");
        return;
    }
    for (const tn_expression *number = corner->first; number; number = number->next)
        out[axis++] =
            constant(e, number, "a corner's coordinate", "write numbers, or names that `let` gave to numbers");
}

static void take_box(emit *e, const tn_field_setting *box)
{
    for (int axis = 0; axis < 3; axis++) {
        e->low[axis] = -DEFAULT_REACH;
        e->high[axis] = DEFAULT_REACH;
    }
    if (!box || !box->corners || !box->corners->first)
        return;
    bool before = e->wrong;
    e->wrong = false;
    take_corner(e, box->corners->first, e->low);
    take_corner(e, box->corners->last, e->high);
    for (int axis = 0; axis < 3 && !e->wrong; axis++) {
        if (!(fabs(e->low[axis]) <= TN_COORDINATE_MAX && fabs(e->high[axis]) <= TN_COORDINATE_MAX))
            refuse_box(e, box->span, "this box is too large", "coordinates go up to 1000000000000");
        else if (!(e->low[axis] < e->high[axis]))
            refuse_box(e, box->span, "this box has no inside",
                       "write the low corner first, and the high one behind `..`, each coordinate larger");
    }
    e->wrong = e->wrong || before;
}

static void take_grid(emit *e, const tn_field_setting *grid)
{
    e->grid = DEFAULT_GRID;
    if (!grid)
        return;
    double n = grid->number.value;
    tn_range_note(e->diagnostics, grid->number.span, 2, TN_GRID_MAX);
    if (n == floor(n) && n >= 2 && n <= TN_GRID_MAX) {
        e->grid = (uint32_t)n;
        return;
    }
    tn_diagnostic *d = tn_report(e->diagnostics, E_FIELD_GRID, grid->number.span,
                                 "a grid is a whole number of samples, from 2 to %u", TN_GRID_MAX);
    tn_help(e->diagnostics, d, "50 is a sketch, 256 is fine");
    e->wrong = true;
}

static void take_unit(emit *e, const tn_field_setting *unit)
{
    static const char *const names[TN_UNIT_COUNT] = {"", "mm", "cm", "m", "in", "ft"};
    for (e->unit = TN_UNIT_NONE; unit && e->unit < TN_UNIT_COUNT; e->unit++)
        if (strcmp(names[e->unit], unit->word.text) == 0)
            return;
    if (!unit)
        return;
    tn_diagnostic *d = tn_report(e->diagnostics, E_FIELD_UNIT, unit->word.span, "`%.40s` is no unit", unit->word.text);
    tn_help(e->diagnostics, d, "there are mm, cm, m, in and ft");
    e->wrong = true;
}

/* ---- meshes */

static void gather_meshes(emit *e, tn_expression *of, const char **paths)
{
    if (of->op == TN_OP_MESH_DISTANCE) {
        uint32_t root = e->checked->file->first ? e->checked->file->first->span.file : 0, i = 0;
        of->name = tn_emit_path(e->arena, e->diagnostics->sources, of->name_span.file, of->name, root);
        while (i < e->nodes.mesh_count && strcmp(paths[i], of->name) != 0)
            i++;
        if (i == e->nodes.mesh_count) {
            paths[e->nodes.mesh_count++] = of->name;
            tn_builder_add_DISTANCE_MESH(e->builder,
                                         &(tn_distance_mesh_record){.path = tn_builder_string(e->builder, of->name),
                                                                    .file = of->name_span.file,
                                                                    .begin = of->name_span.begin,
                                                                    .end = of->name_span.end});
        }
    }
    for (tn_expression *operand = of->first; operand; operand = operand->next)
        gather_meshes(e, operand, paths);
}

static uint32_t count_meshes(const tn_expression *of)
{
    uint32_t count = of->op == TN_OP_MESH_DISTANCE;
    for (const tn_expression *operand = of->first; operand; operand = operand->next)
        count += count_meshes(operand);
    return count;
}

static void take_meshes(emit *e)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < e->checked->definition_count; i++)
        count += count_meshes(e->checked->definitions[i]->body);
    const char **paths = TN_NEW_ARRAY(e->arena, const char *, count + 1);
    for (uint32_t i = 0; paths && i < e->checked->definition_count; i++)
        gather_meshes(e, e->checked->definitions[i]->body, paths);
    e->nodes.mesh_paths = paths;
}

/* ---- a surface's code */

typedef struct code {
    const tn_field_nodes *nodes;
    tn_formula *formula;
    uint32_t *uses, *height, *local; /* of each node; local: one more than its number, where it is kept */
    uint32_t local_count;
} code;

/* Recursion is as deep as a part that is not kept: INLINE_MAX. */
static void add_node(code *c, uint32_t index, bool whole)
{
    const tn_field_node *node = &c->nodes->items[index];
    if (c->local[index] && !whole) {
        tn_formula_kept(c->formula, c->local[index] - 1);
        return;
    }
    uint32_t arity = arity_of(node);
    for (uint32_t i = 0; i < arity; i++)
        add_node(c, node->in[i], false);
    if (node->op == TN_OP_NUMBER)
        tn_formula_number(c->formula, node->number);
    else if (node->op == TN_OP_COORDINATE)
        tn_formula_coordinate(c->formula, node->index);
    else if (node->op == TN_OP_MESH_DISTANCE)
        tn_formula_mesh_distance(c->formula, node->index);
    else
        tn_formula_operation(c->formula, node->op, arity);
}

/* How deep the tree of what is not kept is; what is used twice, or is deeper than that, is kept. */
static bool is_kept(code *c, uint32_t index)
{
    const tn_field_node *node = &c->nodes->items[index];
    uint32_t arity = arity_of(node), height = 1;
    for (uint32_t i = 0; i < arity; i++) {
        uint32_t below = c->local[node->in[i]] ? 1 : c->height[node->in[i]];
        height = below + 1 > height ? below + 1 : height;
    }
    c->height[index] = height;
    return arity > 0 && (c->uses[index] > 1 || height > INLINE_MAX);
}

static bool add_code(code *c, tn_arena *arena, uint32_t root)
{
    size_t count = c->nodes->count;
    c->uses = TN_NEW_ARRAY(arena, uint32_t, count);
    c->height = TN_NEW_ARRAY(arena, uint32_t, count);
    c->local = TN_NEW_ARRAY(arena, uint32_t, count);
    if (!c->uses || !c->height || !c->local)
        return false;
    c->uses[root] = 1;
    for (uint32_t i = root + 1; i-- > 0;)
        for (uint32_t k = 0; c->uses[i] && k < arity_of(&c->nodes->items[i]); k++)
            c->uses[c->nodes->items[i].in[k]]++;
    tn_formula_begin(c->formula);
    for (uint32_t i = 0; i < root; i++) {
        if (!c->uses[i] || !is_kept(c, i))
            continue;
        add_node(c, i, true);
        tn_formula_keep(c->formula, c->local_count);
        c->local[i] = ++c->local_count;
    }
    add_node(c, root, true);
    return true;
}

/* ---- what intervals prove */

static tn_interval bounds_of(emit *e, uint32_t root)
{
    tn_interval *bounds = TN_NEW_ARRAY(e->arena, tn_interval, e->nodes.count);
    for (uint32_t i = 0; bounds && i <= root; i++) {
        const tn_field_node *node = &e->nodes.items[i];
        const tn_interval *in[TN_ARITY_MAX] = {&bounds[node->in[0]], &bounds[node->in[1]], &bounds[node->in[2]]};
        bounds[i] = node->op == TN_OP_NUMBER          ? tn_interval_of(node->number)
                    : node->op == TN_OP_COORDINATE    ? (tn_interval){e->low[node->index], e->high[node->index], false}
                    : node->op == TN_OP_MESH_DISTANCE ? (tn_interval){-INFINITY, INFINITY, false}
                                                      : tn_operation_bounds(node->op, in);
    }
    return bounds ? bounds[root] : (tn_interval){-INFINITY, INFINITY, true};
}

static void warn_of_bounds(emit *e, const tn_field_definition *of, uint32_t root)
{
    tn_interval bounds = bounds_of(e, root);
    tn_diagnostic *d;
    if (tn_interval_is_none(bounds)) {
        d = tn_report(e->diagnostics, W_FIELD_NO_VALUE, of->name.span, "`%s` has no value anywhere in its box",
                      of->name.text);
        tn_help(e->diagnostics, d, "roots and logarithms of negative numbers have none, and that is outside");
    } else if (bounds.low >= 0) {
        d = tn_report(e->diagnostics, W_FIELD_EMPTY, of->name.span, "`%s` has nothing inside in its box",
                      of->name.text);
        tn_help(e->diagnostics, d, "inside is where it is below 0; it is at least %.4g", bounds.low);
    } else if (bounds.high < 0 && !bounds.fails) {
        d = tn_report(e->diagnostics, W_FIELD_FULL, of->name.span, "all of its box is inside `%s`", of->name.text);
        tn_help(e->diagnostics, d, "inside is where it is below 0; it is at most %.4g", bounds.high);
    }
}

/* ---- surfaces */

static void refuse_size(emit *e, const tn_field_definition *of)
{
    tn_diagnostic *d;
    if (e->nodes.fits == TN_FIELD_TOO_DEEP)
        d = tn_report(e->diagnostics, E_TOO_DEEP, of->name.span,
                      "`%s` nests more than %u deep with its functions put in, which is the limit", of->name.text,
                      TN_FIELD_EXPAND_MAX);
    else
        d = tn_report(e->diagnostics, E_FIELD_SIZE, of->name.span,
                      "`%s` becomes more than %u different parts, or %u in all, which are the limits", of->name.text,
                      TN_FIELD_NODES_MAX, TN_FIELD_STEPS_MAX);
    tn_help(e->diagnostics, d, "functions and surfaces are put in where they are used; use fewer inside one another");
    e->wrong = true;
}

static tn_status emit_surface(emit *e, const tn_field_definition *of, tn_formula *formula, tn_error *error)
{
    e->nodes.count = 0; /* its table is made again as it fills */
    e->nodes.capacity = 0;
    e->nodes.steps = 0;
    e->nodes.fits = TN_FIELD_FITS;
    uint32_t root = tn_field_expand(&e->nodes, of->body);
    if (tn_arena_failed(e->arena))
        return tn_fail_memory(error);
    if (e->nodes.fits != TN_FIELD_FITS) {
        refuse_size(e, of);
        return TN_INVALID;
    }
    warn_of_bounds(e, of, root);
    code c = {.nodes = &e->nodes, .formula = formula};
    if (!add_code(&c, e->arena, root))
        return tn_fail_memory(error);
    tn_status status = tn_formula_end(formula, error);
    if (status != TN_OK)
        return status;
    uint32_t function = tn_formula_emit(e->builder, TN_FUNCTION_FIELD, of->name.text, formula);
    tn_builder_add_SURFACE(e->builder, &(tn_surface_record){.name = tn_builder_string(e->builder, of->name.text),
                                                            .doc = tn_builder_string(e->builder, of->doc),
                                                            .function = function,
                                                            .low_x = e->low[0],
                                                            .low_y = e->low[1],
                                                            .low_z = e->low[2],
                                                            .high_x = e->high[0],
                                                            .high_y = e->high[1],
                                                            .high_z = e->high[2],
                                                            .grid = e->grid,
                                                            .unit = e->unit,
                                                            .file = of->span.file,
                                                            .begin = of->span.begin,
                                                            .end = of->span.end});
    return TN_OK;
}

tn_status tn_emit_field(tn_builder *builder, tn_arena *arena, tn_diagnostics *diagnostics,
                        const tn_checked_fields *checked, tn_error *error)
{
    emit e = {.builder = builder,
              .arena = arena,
              .diagnostics = diagnostics,
              .checked = checked,
              .nodes = {.arena = arena, .checked = checked}};
    tn_formula formula = {0};
    tn_status status = TN_OK;
    take_meshes(&e);
    check_constants(&e);
    take_box(&e, checked->file->settings[TN_FIELD_BOX]);
    take_grid(&e, checked->file->settings[TN_FIELD_GRID]);
    take_unit(&e, checked->file->settings[TN_FIELD_UNIT]);
    if (tn_arena_failed(arena))
        return tn_fail_memory(error);
    if (e.wrong)
        return TN_INVALID;
    for (const tn_field_definition *d = checked->file->first; d && status != TN_MEMORY; d = d->next)
        if (d->kind == TN_FIELD_SURFACE)
            status = emit_surface(&e, d, &formula, error);
    tn_formula_clear(&formula);
    return status == TN_OK && e.wrong ? TN_INVALID : status;
}
