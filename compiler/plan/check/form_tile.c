/* Checks the tiles of a form: what stands in a room, and what is kept free there. */
#include <string.h>

#include "compiler/plan/check/form.h"
#include "runtime/base/length.h"
#include "runtime/base/nearest.h"

static void bad_tile(tn_check *check, tn_span span, const char *message, const char *help)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_TILE, span, "%s", message);
    tn_help(check->diagnostics, d, "%s", help);
}

/* wide, deep: from the least to the most */
static void read_range(tn_check *check, const tn_ast_tile_part *part, int64_t range[2])
{
    range[0] = tn_form_length(check, part->low);
    range[1] = tn_form_length(check, part->high);
    if (range[0] >= 0 && range[1] >= 0 && range[0] > range[1])
        bad_tile(check, part->node.span, "no room has such a size: the larger length is first",
                 "write the smaller length first");
}

static void add_against(tn_check *check, const tn_checked_form *form, tn_checked_tile *tile,
                        const tn_ast_tile_part *part)
{
    uint32_t *kinds = TN_NEW_ARRAY(check->arena, uint32_t, part->list.count);
    if (!kinds || tile->against) {
        if (kinds)
            bad_tile(check, part->node.span, "`against` is there twice", "join the kinds by `or`");
        return;
    }
    tile->against = kinds;
    for (TN_EACH(const tn_ast_word, word, part->list)) {
        uint32_t kind = tn_form_kind(check, form, TN_FACE_BESIDE, word);
        if (kind != TN_NONE && tn_form_kind_belongs(form, TN_FACE_BESIDE, kind))
            kinds[tile->against_count++] = kind;
        else if (kind != TN_NONE)
            bad_tile(check, word->node.span, "this is below or above a room, and not at a side of it",
                     "a tile stands against `wall`, `party`, `open` or an opening");
    }
}

/* ---- boxes */

static int axis_of(tn_box_side side)
{
    return side <= TN_BOX_RIGHT ? 0 : side <= TN_BOX_FRONT ? 1 : 2;
}

static bool is_far(tn_box_side side)
{
    return side == TN_BOX_RIGHT || side == TN_BOX_FRONT;
}

static const char *const side_words[] = {
    [TN_BOX_LEFT] = "left",   [TN_BOX_RIGHT] = "right", [TN_BOX_BACK] = "back",
    [TN_BOX_FRONT] = "front", [TN_BOX_UP] = "up",
};

/* The stretch that is meant has the same two ends in the other order; at two equal lengths no order is good. */
static void report_turned(tn_check *check, const tn_ast_reach *reach, int64_t low, int64_t high)
{
    static const char *const sizes[] = {"width", "depth", "height"};
    tn_span span = reach->node.span;
    if (reach->from == reach->to && low == high) {
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_BAD_TILE, span, "this box has no %s", sizes[axis_of(reach->from)]);
        tn_help(check->diagnostics, d, "write two lengths that differ, the %s one first",
                is_far(reach->from) ? "larger" : "smaller");
        return;
    }
    tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_TILE, span, "this box is turned inside out at every size");
    bool side_again = reach->from != reach->to || is_far(reach->from);
    tn_advise(check->diagnostics, d, "%s %s .. %s%s%s", side_words[reach->to], reach->high->text,
              side_again ? side_words[reach->from] : "", side_again ? " " : "", reach->low->text);
}

static void set_reach(const tn_ast_reach *reach, int64_t low, int64_t high, tn_tile_box_record *box)
{
    bool far = is_far(reach->from), to_far = is_far(reach->to);
    int axis = axis_of(reach->from);
    if (axis == 2) {
        box->up_low = low;
        box->up_high = high;
    } else if (axis == 1) {
        box->y_from = low;
        box->y_to = high;
        box->flags |= (far ? TN_TILE_Y_FROM_FRONT : 0) | (to_far ? TN_TILE_Y_TO_FRONT : 0);
    } else {
        box->x_from = low;
        box->x_to = high;
        box->flags |= (far ? TN_TILE_X_FROM_RIGHT : 0) | (to_far ? TN_TILE_X_TO_RIGHT : 0);
    }
}

/* One stretch; a box has at most one across, one into the room, one up. */
static void read_reach(tn_check *check, const tn_checked_form *form, const tn_ast_reach *reach, bool said[3],
                       tn_tile_box_record *box)
{
    int axis = axis_of(reach->from), other = axis_of(reach->to);
    int64_t low = tn_form_length(check, reach->low), high = tn_form_length(check, reach->high);
    if (axis != other || said[axis]) {
        bad_tile(check, reach->node.span,
                 axis != other ? "these two sides are not opposite each other"
                               : "this box has two stretches in the same direction",
                 tn_form_in_unit(form, "write `left 0 .. right 0, back 0 .. 2', up 0 .. 3'`",
                                 "write `left 0 .. right 0, back 0 .. 600mm, up 0 .. 900mm`"));
        return;
    }
    said[axis] = true;
    bool opposite = reach->from != reach->to, far = is_far(reach->from);
    bool turned = opposite ? far : far ? low <= high : low >= high;
    if (turned && low >= 0 && high >= 0)
        report_turned(check, reach, low, high);
    set_reach(reach, low, high, box);
}

/* ---- what plans show an item as */

/* One end of a line: at one length across and one into the item, in any order. false: reported. */
static bool read_end(tn_check *check, const tn_checked_form *form, const tn_ast_symbol_line *ast, int end,
                     int64_t at[2], bool far[2])
{
    int first = axis_of(ast->sides[end][0]), second = axis_of(ast->sides[end][1]);
    if (first + second != 1) {
        bad_tile(check, ast->node.span, "an end of this line is not a place in the plan of the item",
                 tn_form_in_unit(form, "write `line left 2\", back 0 .. right 2\", front 0`",
                                 "write `line left 50mm, back 0 .. right 50mm, front 0`"));
        return false;
    }
    for (int k = 0; k < 2; k++) {
        at[axis_of(ast->sides[end][k])] = tn_form_length(check, ast->lengths[end][k]);
        far[axis_of(ast->sides[end][k])] = is_far(ast->sides[end][k]);
    }
    return at[0] >= 0 && at[1] >= 0;
}

static void add_line(tn_check *check, const tn_checked_form *form, tn_checked_tile *tile, const tn_ast_symbol_line *ast)
{
    int64_t from[2], to[2];
    bool from_far[2], to_far[2];
    if (!read_end(check, form, ast, 0, from, from_far) || !read_end(check, form, ast, 1, to, to_far))
        return;
    tile->lines[tile->line_count++] =
        (tn_symbol_line_record){.sides = (from_far[0] ? TN_LINE_X0_RIGHT : 0) | (from_far[1] ? TN_LINE_Y0_FRONT : 0) |
                                         (to_far[0] ? TN_LINE_X1_RIGHT : 0) | (to_far[1] ? TN_LINE_Y1_FRONT : 0),
                                .x0 = from[0],
                                .y0 = from[1],
                                .x1 = to[0],
                                .y1 = to[1]};
}

static void report_symbol(tn_check *check, const tn_ast_word *word)
{
    char all[400];
    const char *const *names = tn_names_SYMBOL + 1;
    tn_word_list(names, TN_SYMBOL_COUNT - 1, all, sizeof all);
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_BAD_TILE, word->node.span, "there is no symbol `%s`", word->text);
    const char *near = tn_nearest(word->text, names, TN_SYMBOL_COUNT - 1);
    if (near)
        tn_suggest(check->diagnostics, d, "%s", near);
    else
        tn_help(check->diagnostics, d, "symbols are %s; others are drawn by lines: `symbol { line ... }`", all);
}

static void read_symbol(tn_check *check, const tn_checked_form *form, tn_checked_tile *tile,
                        const tn_ast_tile_part *part, tn_tile_box_record *box)
{
    box->line_first = tile->line_count;
    if (part->part == TN_TILE_KEEPS && (part->symbol || part->lines.count)) {
        bad_tile(check, part->node.span, "what is kept free is not drawn, and has a symbol", "leave `symbol` out");
        return;
    }
    for (uint32_t i = 1; part->symbol && i < TN_SYMBOL_COUNT; i++)
        if (tn_word_is(part->symbol, tn_names_SYMBOL[i]))
            box->symbol = i;
    if (part->symbol && box->symbol == TN_SYMBOL_NONE)
        report_symbol(check, part->symbol);
    if (!tn_check_room(check, part->lines.count, TN_SYMBOL_LINES_MAX + 1, "line of a symbol", part->node.span,
                       "draw it by fewer lines"))
        return;
    for (TN_EACH(const tn_ast_symbol_line, line, part->lines))
        add_line(check, form, tile, line);
    box->line_count = tile->line_count - box->line_first;
}

static void add_box(tn_check *check, const tn_checked_form *form, tn_checked_tile *tile, const tn_ast_tile_part *part)
{
    bool said[3] = {false};
    tn_tile_box_record box = {.flags = part->part == TN_TILE_KEEPS ? TN_TILE_KEEP : 0};
    for (TN_EACH(const tn_ast_reach, reach, part->list))
        read_reach(check, form, reach, said, &box);
    box.flags |= (said[0] ? 0 : TN_TILE_X_TO_RIGHT) | (said[1] ? 0 : TN_TILE_Y_TO_FRONT);
    if (!tn_name_fits(check->diagnostics, part->name->text, part->name->node.span) ||
        !tn_check_room(check, tile->box_count, TN_TILE_BOXES_MAX, "item", part->node.span, "make two tiles of it"))
        return;
    read_symbol(check, form, tile, part, &box);
    tile->box_ast[tile->box_count] = part;
    tile->boxes[tile->box_count++] = box;
}

/* ---- boxes in the largest room that a tile allows */

/* The tile's line `wide` or `deep`, which may stand behind its boxes; NULL where there is none. The last one counts. */
static const tn_ast_tile_part *find_range(const tn_checked_tile *tile, tn_tile_part which)
{
    const tn_ast_tile_part *found = NULL;
    for (TN_EACH(const tn_ast_tile_part, part, tile->ast->parts))
        if (part->part == which)
            found = part;
    return found;
}

/* A stretch from the left to the right, or from the back to the front, must leave something between its ends. */
static void check_between(tn_check *check, const tn_checked_tile *tile, const tn_ast_reach *reach)
{
    bool across = reach->from == TN_BOX_LEFT && reach->to == TN_BOX_RIGHT;
    bool into = reach->from == TN_BOX_BACK && reach->to == TN_BOX_FRONT;
    const tn_ast_tile_part *limit = across ? find_range(tile, TN_TILE_WIDE)
                                    : into ? find_range(tile, TN_TILE_DEEP)
                                           : NULL;
    const int64_t *range = across ? tile->wide : tile->deep;
    if (!limit || range[0] < 0 || range[1] < range[0] || reach->low->value + reach->high->value < range[1])
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_TILE, reach->node.span,
                                 "this box is turned inside out at every size that the tile allows");
    tn_note(check->diagnostics, d, &limit->node.span, "its rooms are at most %s %s", limit->high->text,
            across ? "wide" : "deep");
    tn_help(check->diagnostics, d, "make `%s %s` and `%s %s` come to less than %s, or the room larger",
            side_words[reach->from], reach->low->text, side_words[reach->to], reach->high->text, limit->high->text);
}

static void check_boxes(tn_check *check, const tn_checked_tile *tile)
{
    for (uint32_t i = 0; i < tile->box_count; i++)
        for (TN_EACH(const tn_ast_reach, reach, tile->box_ast[i]->list))
            check_between(check, tile, reach);
}

/* ---- tiles */

static void read_purposes(tn_check *check, const tn_checked_form *form, tn_checked_tile *tile)
{
    const char *names[TN_CELL_RULES_MAX];
    for (uint32_t i = 0; i < form->function_count; i++)
        names[i] = form->rules[i].ast->name->text;
    for (TN_EACH(const tn_ast_word, word, tile->ast->list)) {
        uint32_t function = tn_form_function(form, word->text);
        if (function == TN_NONE)
            tn_form_unknown(check, form, word, "function", names, form->function_count);
        else
            tile->purposes[tile->purpose_count++] = function;
    }
}

static bool tile_is_new(tn_check *check, const tn_checked_form *form, const tn_ast_word *name)
{
    for (uint32_t i = 0; i < form->tile_count; i++) {
        if (strcmp(form->tiles[i].ast->name->text, name->text) != 0)
            continue;
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_PART_TWICE, name->node.span, "there is a tile `%s` already", name->text);
        tn_note(check->diagnostics, d, &form->tiles[i].ast->name->node.span, "it is here");
        tn_help(check->diagnostics, d, "choose another name");
        return false;
    }
    return tn_name_fits(check->diagnostics, name->text, name->node.span);
}

void tn_check_tile(tn_check *check, tn_checked_form *form, const tn_ast_form_clause *ast)
{
    tn_checked_tile tile = {.ast = ast, .wide = {0, TN_HOUSE_LENGTH_MAX}, .deep = {0, TN_HOUSE_LENGTH_MAX}};
    tile.purposes = TN_NEW_ARRAY(check->arena, uint32_t, ast->list.count);
    tile.boxes = TN_NEW_ARRAY(check->arena, tn_tile_box_record, ast->parts.count);
    tile.box_ast = TN_NEW_ARRAY(check->arena, const tn_ast_tile_part *, ast->parts.count);
    size_t lines = 0;
    for (TN_EACH(const tn_ast_tile_part, part, ast->parts))
        lines += part->lines.count;
    tile.lines = TN_NEW_ARRAY(check->arena, tn_symbol_line_record, lines + 1);
    if (!tile.purposes || !tile.lines || !tile.boxes || !tile.box_ast || !tile_is_new(check, form, ast->name) ||
        !tn_check_room(check, form->tile_count, TN_TILES_MAX, "tile", ast->node.span, "leave some of them out"))
        return;
    read_purposes(check, form, &tile);
    for (TN_EACH(const tn_ast_tile_part, part, ast->parts)) {
        if (part->part == TN_TILE_AGAINST)
            add_against(check, form, &tile, part);
        else if (part->part <= TN_TILE_DEEP)
            read_range(check, part, part->part == TN_TILE_WIDE ? tile.wide : tile.deep);
        else
            add_box(check, form, &tile, part);
    }
    check_boxes(check, &tile);
    form->tiles[form->tile_count++] = tile;
}
