/* Checks the materials of a form: their colours and prices, what they are for and where. */
#include <stdio.h>
#include <string.h>

#include "compiler/plan/check/form.h"
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

/* Where the form's items are called so: the first box of that name, counted among all boxes of its tiles. */
static uint32_t find_item(const tn_checked_form *form, const char *name)
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

static uint32_t find_part(const tn_checked_form *form, const char *name)
{
    for (uint32_t i = 0; i < TN_OF_COUNT; i++)
        if (strcmp(tn_names_OF[i], name) == 0)
            return i;
    for (uint32_t i = 0; i < form->opening_count; i++)
        if (strcmp(form->openings[i].ast->name->text, name) == 0)
            return TN_OF_COUNT + i;
    uint32_t item = find_item(form, name);
    return item == TN_NONE ? TN_NONE : TN_OF_COUNT + form->opening_count + item;
}

static void unknown_part(tn_check *check, const tn_checked_form *form, const tn_ast_word *word)
{
    const char *names[TN_OF_COUNT + TN_OPENINGS_MAX + 64];
    size_t count = 0, room = sizeof names / sizeof *names;
    for (; count < TN_OF_COUNT; count++)
        names[count] = tn_names_OF[count];
    for (uint32_t i = 0; i < form->opening_count; i++)
        names[count++] = form->openings[i].ast->name->text;
    for (uint32_t t = 0; t < form->tile_count; t++)
        for (uint32_t b = 0; b < form->tiles[t].box_count && count < room; b++)
            if (!(form->tiles[t].boxes[b].flags & TN_TILE_KEEP))
                names[count++] = form->tiles[t].box_ast[b]->name->text;
    tn_form_unknown(check, form, word, "part or item", names, count);
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
        uint32_t part = find_part(form, word->text);
        known &= part != TN_NONE;
        if (part == TN_NONE)
            unknown_part(check, form, word);
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
