/* Checks what the parts of a form are made of: the layers of walls, partitions, decks and roofs, beams, and
 * materials, their colours and prices, what they are for and where; and which codes parts have in classifications. */
#include <stdio.h>
#include <string.h>

#include "compiler/plan/check/form.h"
#include "runtime/base/length.h"
#include "runtime/base/nearest.h"

static void bad_material(tn_check *check, tn_span span, const char *message, const char *help)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_MATERIAL, span, "%s", message);
    tn_help(check->diagnostics, d, "%s", help);
}

/* ---- colours and prices */

static int hex_digit(char c)
{
    const char *digits = "0123456789abcdef", *at = strchr(digits, c >= 'A' && c <= 'F' ? c - 'A' + 'a' : c);
    return c && at ? (int)(at - digits) : -1;
}

/* "#b5523b", or without the sign */
static void read_colour(tn_check *check, tn_checked_material *material)
{
    const tn_ast_word *word = material->ast->doc;
    const char *text = word->text + (word->text[0] == '#');
    bool good = strlen(text) == 6;
    for (size_t i = 0; good && i < 6; i++) {
        good = hex_digit(text[i]) >= 0;
        material->colour = material->colour << 4 | (uint32_t)(good ? hex_digit(text[i]) : 0);
    }
    if (!good && !word->broken)
        bad_material(check, word->node.span, "this is no colour",
                     "a colour is six hexadecimal digits for red, green and blue, such as \"#b5523b\"");
    material->colour = good ? material->colour : 0;
}

/* Millionths, from a number as it is written; false where it has more than six decimals or is too large. */
static bool read_millionths(const char *text, int64_t *price)
{
    int decimals = -1;
    int64_t value = 0;
    for (; *text; text++) {
        if (*text == '.') {
            decimals = 0;
            continue;
        }
        if (*text < '0' || *text > '9' || value > TN_PRICE_MAX || decimals == 6)
            return false;
        value = value * 10 + (*text - '0');
        decimals += decimals >= 0;
    }
    for (int i = decimals < 0 ? 0 : decimals; i < 6 && value <= TN_PRICE_MAX; i++)
        value *= 10;
    *price = value;
    return value <= TN_PRICE_MAX;
}

static void read_price(tn_check *check, const tn_checked_form *form, tn_checked_material *material)
{
    const tn_ast_word *price = material->ast->length, *per = material->ast->detail;
    if (!price)
        return;
    if (!price->broken && !read_millionths(price->text, &material->price))
        bad_material(check, price->node.span, "this price cannot be held exactly",
                     "a price has at most six decimals, and is at most 1000000000");
    for (uint32_t i = 0; per && i < TN_PRICE_UNIT_COUNT; i++)
        if (tn_word_is(per, tn_names_PRICE_UNIT[i])) {
            material->unit = (tn_price_unit)i;
            return;
        }
    if (per)
        tn_form_unknown(check, form, per, "unit of prices", tn_names_PRICE_UNIT, TN_PRICE_UNIT_COUNT);
}

/* ---- parts */

uint32_t tn_form_item_named(const tn_checked_form *form, const char *name)
{
    uint32_t before = 0;
    for (uint32_t t = 0; t < form->tile_count; t++) {
        const tn_checked_tile *tile = &form->tiles[t];
        for (uint32_t b = 0; b < tile->box_count; b++)
            if (!(tile->boxes[b].flags & TN_TILE_KEEP) && strcmp(tile->box_ast[b]->name->text, name) == 0)
                return before + b;
        before += tile->box_count;
    }
    return TN_NONE;
}

static uint32_t count_boxes(const tn_checked_form *form)
{
    uint32_t boxes = 0;
    for (uint32_t t = 0; t < form->tile_count; t++)
        boxes += form->tiles[t].box_count;
    return boxes;
}

/* How many numbers of parts there are, functions left out. */
static uint32_t count_parts(const tn_checked_form *form)
{
    return TN_OF_COUNT + form->layer_count + form->opening_count + count_boxes(form) + 1 + form->beam_count;
}

/* Floors were called decks: if a layer, an opening or an item of the form is called `floor`, that is what the name means,
 * as it did. */
static bool has_own_floor(const tn_checked_form *form)
{
    const char *name = tn_names_OF[TN_OF_DECK];
    return tn_form_layer_named(form, name) != TN_NONE || tn_form_opening_named(form, name) != TN_NONE ||
           tn_form_item_named(form, name) != TN_NONE || tn_form_beam_named(form, name) != TN_NONE;
}

uint32_t tn_form_part_named(const tn_checked_form *form, const char *name)
{
    if (strcmp(name, TN_FLOOR_BEFORE) == 0)
        return TN_OF_DECK;
    for (uint32_t i = 0; i < TN_OF_COUNT; i++)
        if (strcmp(tn_names_OF[i], name) == 0 && !(i == TN_OF_DECK && has_own_floor(form)))
            return i;
    uint32_t layer = tn_form_layer_named(form, name), openings = TN_OF_COUNT + form->layer_count;
    if (layer != TN_NONE)
        return TN_OF_COUNT + layer;
    uint32_t opening = tn_form_opening_named(form, name);
    if (opening != TN_NONE)
        return openings + opening;
    uint32_t item = tn_form_item_named(form, name), items = openings + form->opening_count;
    uint32_t guard = items + count_boxes(form), beam = tn_form_beam_named(form, name);
    if (item == TN_NONE && strcmp(name, "guard") == 0)
        return guard;
    if (item == TN_NONE && beam != TN_NONE)
        return guard + 1 + beam;
    return item == TN_NONE ? TN_NONE : items + item;
}

/* Appends a name, if there is room. */
static void offer(const char **names, size_t *count, size_t room, const tn_ast_word *name)
{
    if (*count < room)
        names[(*count)++] = name->text;
}

/* E1602: there is no such part; `functions`: nor such a function. */
static void unknown_part(tn_check *check, const tn_checked_form *form, const tn_ast_word *word, bool functions)
{
    const char *names[TN_OF_COUNT + 1 + TN_LAYERS_MAX + TN_BEAMS_MAX + TN_OPENINGS_MAX + 128];
    size_t count = 0, room = sizeof names / sizeof *names;
    for (; count < TN_OF_COUNT; count++)
        names[count] = tn_names_OF[count];
    if (form->guard > 0)
        names[count++] = "guard";
    for (uint32_t i = 0; i < form->layer_count && !functions; i++)
        offer(names, &count, room, form->layers[i].ast->name);
    for (uint32_t i = 0; i < form->beam_count; i++)
        offer(names, &count, room, form->beams[i].ast->name);
    for (uint32_t i = 0; i < form->opening_count; i++)
        offer(names, &count, room, form->openings[i].ast->name);
    for (uint32_t i = 0; i < form->function_count && functions; i++)
        if (tn_form_part_named(form, form->rules[i].ast->name->text) == TN_NONE)
            offer(names, &count, room, form->rules[i].ast->name);
    for (uint32_t t = 0; t < form->tile_count; t++)
        for (uint32_t b = 0; b < form->tiles[t].box_count; b++)
            if (!(form->tiles[t].boxes[b].flags & TN_TILE_KEEP))
                offer(names, &count, room, form->tiles[t].box_ast[b]->name);
    tn_form_unknown(check, form, word, functions ? "part, item or function" : "part or item", names, count);
}

/* Is the part made of an earlier material in every house? */
static const tn_checked_material *taken_by(const tn_checked_form *form, uint32_t part)
{
    for (uint32_t i = 0; i < form->material_count; i++) {
        const tn_checked_material *other = &form->materials[i];
        for (uint32_t p = 0; p < other->part_count && !other->has_where; p++)
            if (other->parts[p] == part)
                return other;
    }
    return NULL;
}

/* A part that an earlier line has already: the material is for nothing where all of its parts are so. */
static void warn_for_nothing(tn_check *check, const tn_checked_form *form, const tn_checked_material *material)
{
    const tn_checked_material *other = NULL;
    for (uint32_t p = 0; p < material->part_count; p++) {
        other = taken_by(form, material->parts[p]);
        if (!other)
            return;
    }
    if (!other || !tn_check_wanted(check, W_MATERIAL_FOR_NOTHING))
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, W_MATERIAL_FOR_NOTHING, material->ast->name->node.span,
                                 "nothing is ever made of `%s`", material->ast->name->text);
    tn_note(check->diagnostics, d, &other->ast->name->node.span, "`%s` is used first, in every house",
            other->ast->name->text);
    tn_help(check->diagnostics, d, "put the line that says `where` first, or leave one of the two out");
}

void tn_check_material(tn_check *check, tn_checked_form *form, const tn_ast_form_clause *ast)
{
    tn_checked_material material = {.ast = ast, .parts = TN_NEW_ARRAY(check->arena, uint32_t, ast->list.count)};
    if (!material.parts || !ast->name || !ast->doc ||
        !tn_check_room(check, form->material_count, TN_MATERIALS_MAX, "material", ast->node.span,
                       "leave some of them out") ||
        !tn_name_fits(check->diagnostics, ast->name->text, ast->name->node.span))
        return;
    read_colour(check, &material);
    read_price(check, form, &material);
    bool known = true;
    for (TN_EACH(const tn_ast_word, word, ast->list)) {
        uint32_t part = tn_form_part_named(form, word->text);
        known &= part != TN_NONE;
        if (part == TN_NONE)
            unknown_part(check, form, word, false);
        else
            material.parts[material.part_count++] = part;
    }
    material.has_where = ast->first != NULL;
    if (ast->first)
        tn_form_section(check, form, ast->first, &material.where);
    if (known)
        warn_for_nothing(check, form, &material);
    form->materials[form->material_count++] = material;
}

/* ---- layers */

uint32_t tn_form_layer_named(const tn_checked_form *form, const char *name)
{
    for (uint32_t i = 0; i < form->layer_count; i++)
        if (strcmp(form->layers[i].ast->name->text, name) == 0)
            return i;
    return TN_NONE;
}

static bool has_layers(const tn_ast_form_clause *ast)
{
    return ast && ast->layered.end > ast->layered.begin;
}

/* In the unit in which the line says its thickness; in metres what is no 1/64". */
static const char *shown(const tn_ast_form_clause *ast, int64_t length, char text[64])
{
    tn_length_style style = tn_length_style_of(ast->length->text);
    bool whole = style != TN_STYLE_FEET || length % (TN_INCH_NM / 64) == 0;
    tn_length_write_style(length, whole ? style : TN_STYLE_METRES, text, 64);
    return text;
}

void tn_check_part_name(tn_check *check, const tn_checked_form *form, const tn_ast_word *name)
{
    const char *what = tn_form_opening_named(form, name->text) != TN_NONE ? "an opening"
                       : tn_form_item_named(form, name->text) != TN_NONE  ? "an item"
                                                                          : NULL;
    for (uint32_t i = 0; i < TN_OF_COUNT; i++)
        what = strcmp(i == TN_OF_DECK ? TN_FLOOR_BEFORE : tn_names_OF[i], name->text) == 0 ? "a part of every form"
                                                                                           : what;
    if (strcmp(name->text, "guard") == 0)
        what = "what keeps people from falling";
    if (!what) {
        tn_name_fits(check->diagnostics, name->text, name->node.span);
        return;
    }
    tn_diagnostic *d = tn_report(check->diagnostics, E_PART_TWICE, name->node.span,
                                 "the name `%.80s` is that of %s already", name->text, what);
    tn_help(check->diagnostics, d, "choose another name, so that it is clear what materials are for");
}

static bool may_be_thick(const tn_checked_form *form, const tn_ast_form_clause *ast, int64_t length)
{
    bool may = !(tn_form_is_halved(ast) && length % 2);
    for (uint32_t i = 0; ast->part == TN_PART_DECK && i < form->storey_count; i++)
        may = may && length < form->storeys[i].height;
    return may;
}

static void misfit(tn_check *check, const tn_checked_form *form, const tn_ast_form_clause *ast,
                   const tn_ast_layer *thickest, int64_t sum)
{
    char together[64], missing[64], instead[64];
    int64_t thick = form->thickness[ast->part - TN_PART_WALL], over = sum - thick,
            mended = thickest->length->value - over;
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_BAD_THICKNESS, ast->length->node.span,
                  "the layers of `%s` are %s thick together, %s %s than it", tn_form_thickness_words(ast),
                  shown(ast, sum, together), shown(ast, over < 0 ? -over : over, missing), over < 0 ? "less" : "more");
    tn_note(check->diagnostics, d, &thickest->node.span, "the thickest layer is here");
    bool other = may_be_thick(form, ast, sum);
    if (mended > 0)
        tn_help(check->diagnostics, d, "write `%s %s`%s%s%s%s%s", thickest->name->text, shown(ast, mended, instead),
                other ? ", or `" : "", other ? tn_form_thickness_words(ast) : "", other ? " " : "",
                other ? together : "", other ? "`" : "");
    else if (other)
        tn_help(check->diagnostics, d, "write `%s %s`", tn_form_thickness_words(ast), together);
    else
        tn_help(check->diagnostics, d, "take %s off the layers", missing);
}

static void no_layers(tn_check *check, const tn_checked_form *form, const tn_ast_form_clause *ast)
{
    char length[64];
    tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_THICKNESS, ast->layered, "`%s` has no layers",
                                 tn_form_thickness_words(ast));
    tn_help(check->diagnostics, d, "write its layers, such as `{ boards %s }`, or leave the braces out",
            shown(ast, form->thickness[ast->part - TN_PART_WALL], length));
}

/* Is each layer a length above 0? *sum: of them; *thickest: the first of these. */
static bool read_layers(tn_check *check, const tn_ast_form_clause *ast, int64_t *sum, const tn_ast_layer **thickest)
{
    bool good = true;
    *sum = 0;
    *thickest = NULL;
    for (TN_EACH(const tn_ast_layer, layer, ast->parts)) {
        int64_t thick = tn_form_length(check, layer->length);
        good = good && thick > 0;
        *sum += thick;
        if (thick > 0 && (!*thickest || thick > (*thickest)->length->value))
            *thickest = layer;
        if (thick != 0)
            continue;
        tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_THICKNESS, layer->length->node.span,
                                     "layer `%s` is 0 thick", layer->name->text);
        tn_help(check->diagnostics, d, "write a length above 0, or leave the layer out");
    }
    return good;
}

/* What is wrong with the layers of a line. */
static void check_line(tn_check *check, const tn_checked_form *form, const tn_ast_form_clause *ast)
{
    int64_t sum;
    const tn_ast_layer *thickest;
    if (ast->parts.count == 0) {
        no_layers(check, form, ast);
        return;
    }
    for (TN_EACH(const tn_ast_layer, layer, ast->parts))
        tn_check_part_name(check, form, layer->name);
    if (read_layers(check, ast, &sum, &thickest) && sum != form->thickness[ast->part - TN_PART_WALL])
        misfit(check, form, ast, thickest, sum);
}

static bool add_layers(tn_check *check, tn_checked_form *form, const tn_ast_form_clause *ast, tn_layered of)
{
    for (TN_EACH(const tn_ast_layer, layer, ast->parts)) {
        if (!tn_check_room(check, form->layer_count, TN_LAYERS_MAX, "layer", layer->node.span, "join some of them"))
            return false;
        form->layers[form->layer_count++] = (tn_checked_layer){layer, of, layer->length->value};
    }
    return true;
}

void tn_check_layers(tn_check *check, tn_checked_form *form)
{
    form->layers = TN_NEW_ARRAY(check->arena, tn_checked_layer, TN_LAYERS_MAX);
    bool room = form->layers != NULL;
    for (int of = 0; room && of < TN_LAYERED_COUNT; of++)
        if (has_layers(form->thickness_ast[of]))
            room = add_layers(check, form, form->thickness_ast[of], (tn_layered)of);
    for (int of = 0; room && of < TN_LAYERED_COUNT; of++) {
        const tn_ast_form_clause *ast = form->thickness_ast[of];
        bool again = of == TN_LAYERED_PARTY && ast == form->thickness_ast[TN_LAYERED_OUTSIDE];
        if (has_layers(ast) && !again)
            check_line(check, form, ast);
    }
}

/* ---- beams: their names, their sizes, and whether a house can have them */

uint32_t tn_form_beam_named(const tn_checked_form *form, const char *name)
{
    for (uint32_t i = 0; i < form->beam_count; i++)
        if (strcmp(form->beams[i].ast->name->text, name) == 0)
            return i;
    return TN_NONE;
}

/* It lies in the plane of a wall, and takes all of the thickness of a partition below. */
static bool is_as_wide_as_walls(tn_check *check, const tn_checked_form *form, const tn_checked_beam *beam)
{
    const tn_ast_word *wide = beam->ast->length;
    int64_t wall = form->thickness[0], partition = form->thickness[1];
    char most[64];
    if (beam->wide % 2) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_THICKNESS, wide->node.span,
                                     "half of this beam is not a whole number of nanometres");
        tn_form_help_half(check, d, "half of it goes to each side of a plane", beam->wide, wide->text);
        return false;
    }
    if (beam->wide >= partition && beam->wide <= wall)
        return true;
    bool narrow = beam->wide < partition;
    tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_BEAM, wide->node.span, "beam `%.80s` is %s",
                                 beam->ast->name->text, narrow ? "narrower than a partition" : "wider than a wall");
    tn_help(check->diagnostics, d, "write `wide %s`: beams are at least as wide as `partition`, and at most as `wall`",
            shown(beam->ast, narrow ? partition : wall, most));
    return false;
}

/* Something is left between it and the floor in each storey that has one above. */
static bool leaves_room(tn_check *check, const tn_checked_form *form, const tn_checked_beam *beam)
{
    const tn_checked_storey *lowest = NULL;
    char high[64];
    for (uint32_t i = 0; i + 1 < form->storey_count; i++)
        if (!lowest || form->storeys[i].height < lowest->height)
            lowest = &form->storeys[i];
    if (!lowest || beam->high < lowest->height - form->thickness[2])
        return true;
    tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_BEAM, beam->ast->high->node.span,
                                 "beam `%.80s` is as high as the rooms of storey `%.80s`", beam->ast->name->text,
                                 lowest->ast->name->text);
    tn_help(check->diagnostics, d, "write less than %s, the height from its floor to the ceiling",
            shown(beam->ast, lowest->height - form->thickness[2], high));
    return false;
}

static bool is_there(tn_check *check, const tn_checked_beam *beam)
{
    const tn_ast_word *zero = beam->wide == 0   ? beam->ast->length
                              : beam->high == 0 ? beam->ast->high
                              : beam->span == 0 ? beam->ast->going
                                                : NULL;
    if (zero) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_BEAM, zero->node.span, "beam `%.80s` has no size",
                                     beam->ast->name->text);
        tn_help(check->diagnostics, d, "write a length above 0");
    }
    return beam->wide > 0 && beam->high > 0 && beam->span > 0;
}

/* The first fits wherever a later one does that is as wide and as high or more, and spans no more. */
static void check_taken(tn_check *check, const tn_checked_form *form, const tn_checked_beam *beam)
{
    for (uint32_t i = 0; i < form->beam_count; i++) {
        const tn_checked_beam *first = &form->beams[i];
        if (first->span < beam->span || first->wide > beam->wide || first->high > beam->high)
            continue;
        tn_diagnostic *d = tn_report(check->diagnostics, W_IDLE_BEAM, beam->ast->node.span, "no house has beam `%.80s`",
                                     beam->ast->name->text);
        tn_note(check->diagnostics, d, &first->ast->node.span, "this one comes first, and fits wherever it does");
        tn_help(check->diagnostics, d, "write beams with shorter spans before those with longer ones");
        return;
    }
    if (form->storey_count > 1)
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, W_IDLE_BEAM, beam->ast->node.span, "no house has beam `%.80s`",
                                 beam->ast->name->text);
    tn_help(check->diagnostics, d, "beams bear the walls of upper storeys, and the form has one storey");
}

static bool is_new(tn_check *check, const tn_checked_form *form, const tn_ast_form_clause *ast)
{
    uint32_t first = tn_form_beam_named(form, ast->name->text);
    if (first != TN_NONE) {
        tn_form_twice(check, &ast->name->node.span, &form->beams[first].ast->name->node.span, "beam ", ast->name->text);
        return false;
    }
    tn_check_part_name(check, form, ast->name);
    return true;
}

void tn_check_beams(tn_check *check, tn_checked_form *form)
{
    form->beams = TN_NEW_ARRAY(check->arena, tn_checked_beam, TN_BEAMS_MAX);
    for (TN_EACH(const tn_ast_form_clause, ast, form->ast->clauses)) {
        if (!form->beams || ast->part != TN_PART_BEAM || !is_new(check, form, ast))
            continue;
        if (!tn_check_room(check, form->beam_count, TN_BEAMS_MAX, "beam", ast->node.span, "leave some of them out"))
            return;
        tn_checked_beam beam = {ast, tn_form_length(check, ast->length), tn_form_length(check, ast->high),
                                tn_form_length(check, ast->going)};
        if (!is_there(check, &beam) || !is_as_wide_as_walls(check, form, &beam) || !leaves_room(check, form, &beam))
            continue;
        check_taken(check, form, &beam);
        form->beams[form->beam_count++] = beam;
    }
}

/* ---- prices of layers */

/* A material that is for the part: the first with a price, or else the first; NULL where there is none. */
static const tn_checked_material *material_for(const tn_checked_form *form, uint32_t part)
{
    const tn_checked_material *found = NULL;
    for (uint32_t i = 0; i < form->material_count; i++) {
        const tn_checked_material *material = &form->materials[i];
        for (uint32_t p = 0; p < material->part_count; p++)
            if (material->parts[p] == part && (!found || (!found->ast->length && material->ast->length)))
                found = material;
    }
    return found;
}

void tn_check_layer_prices(tn_check *check, const tn_checked_form *form)
{
    bool priced = false;
    for (uint32_t i = 0; i < form->material_count; i++)
        priced = priced || form->materials[i].ast->length;
    for (uint32_t i = 0; priced && i < form->layer_count; i++) {
        const tn_ast_word *name = form->layers[i].ast->name;
        const tn_checked_material *material = material_for(form, TN_OF_COUNT + i);
        if (tn_form_layer_named(form, name->text) != i || (material && material->ast->length) ||
            !tn_check_wanted(check, W_NO_PRICE))
            continue;
        const char *unit = tn_form_in_unit(form, "cf", "m3");
        tn_diagnostic *d =
            tn_report(check->diagnostics, W_NO_PRICE, name->node.span, "layer `%s` costs nothing", name->text);
        if (material)
            tn_note(check->diagnostics, d, &material->ast->node.span, "its material has no price");
        if (material)
            tn_help(check->diagnostics, d, "write `price NUMBER per %s` behind the colour of `%s`", unit,
                    material->ast->name->text);
        else
            tn_help(check->diagnostics, d, "add a line such as `material %s \"#c8a878\" price 1 per %s for %s`",
                    name->text, unit, name->text);
    }
}

/* ---- codes */

/* E1674: `before`, the name of a part and `after` say what is wrong. */
static void bad_class(tn_check *check, const tn_ast_word *at, const tn_ast_word *name, const char *before,
                      const char *after, const char *help)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_CLASS, at->node.span, "%s`%.80s` %s", before, name->text,
                                 after);
    tn_help(check->diagnostics, d, "%s", help);
}

/* The number of what has a code; TN_NONE: reported. */
static uint32_t part_of(tn_check *check, const tn_checked_form *form, const tn_ast_word *name)
{
    uint32_t part = tn_form_part_named(form, name->text), function = tn_form_function(form, name->text);
    bool layer = part != TN_NONE && part >= TN_OF_COUNT && part - TN_OF_COUNT < form->layer_count;
    if (layer)
        bad_class(check, name, name, "layer ", "has no code of its own",
                  "give the code to what it is a layer of, such as `wall`");
    else if (part != TN_NONE && function != TN_NONE)
        bad_class(check, name, name, "", "is both a function and something that is built",
                  "call one of the two otherwise, so that it is clear what has the code");
    else if (part == TN_NONE && function == TN_NONE)
        unknown_part(check, form, name, true);
    else
        return part != TN_NONE ? part : count_parts(form) + function;
    return TN_NONE;
}

static bool is_first(tn_check *check, const tn_checked_classification *classification, const tn_checked_class *next)
{
    for (uint32_t i = 0; i < classification->class_count; i++) {
        const tn_ast_word *first = classification->classes[i].ast->name;
        if (classification->classes[i].part != next->part)
            continue;
        tn_form_twice(check, &next->ast->name->node.span, &first->node.span, "", next->ast->name->text);
        return false;
    }
    return true;
}

/* Takes a class to its place in the order of parts. */
static void take(tn_checked_classification *classification, tn_checked_class next)
{
    uint32_t i = classification->class_count++;
    for (; i > 0 && classification->classes[i - 1].part > next.part; i--)
        classification->classes[i] = classification->classes[i - 1];
    classification->classes[i] = next;
}

static void check_class(tn_check *check, const tn_checked_form *form, tn_checked_classification *classification,
                        const tn_ast_class *ast)
{
    tn_checked_class next = {ast, part_of(check, form, ast->name)};
    if (next.part == TN_NONE || !is_first(check, classification, &next))
        return;
    if (ast->code->text[0] == '\0')
        bad_class(check, ast->code, ast->name, "the code of ", "is empty", "write the code, or leave the part out");
    else if (tn_name_fits(check->diagnostics, ast->code->text, ast->code->node.span))
        take(classification, next);
}

static bool has_name(tn_check *check, const tn_checked_form *form, const tn_ast_word *name)
{
    if (name->text[0] == '\0') {
        tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_CLASS, name->node.span, "a classification has no name");
        tn_help(check->diagnostics, d, "write what the system is called, such as \"Uniclass 2015\"");
        return false;
    }
    for (uint32_t i = 0; i < form->classification_count; i++) {
        const tn_ast_word *first = form->classifications[i].ast->doc;
        if (strcmp(first->text, name->text) != 0)
            continue;
        tn_form_twice(check, &name->node.span, &first->node.span, "classification ", name->text);
        return false;
    }
    return tn_name_fits(check->diagnostics, name->text, name->node.span);
}

void tn_check_classification(tn_check *check, tn_checked_form *form, const tn_ast_form_clause *ast)
{
    tn_checked_classification classification = {
        .ast = ast, .classes = TN_NEW_ARRAY(check->arena, tn_checked_class, ast->parts.count)};
    if (!classification.classes || !ast->doc || !has_name(check, form, ast->doc) ||
        !tn_check_room(check, form->classification_count, TN_CLASSIFICATIONS_MAX, "classification", ast->node.span,
                       "leave some of them out"))
        return;
    for (TN_EACH(const tn_ast_class, next, ast->parts)) {
        if (!tn_check_room(check, classification.class_count, TN_CLASSES_MAX, "code", next->node.span,
                           "leave some of them out"))
            break;
        check_class(check, form, &classification, next);
    }
    if (classification.class_count > 0)
        form->classifications[form->classification_count++] = classification;
}
