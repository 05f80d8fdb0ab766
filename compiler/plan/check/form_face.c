/* Checks the openings of a form, and the lines that say what is in its faces. */
#include <string.h>

#include "compiler/plan/check/form.h"
#include "runtime/base/length.h"

/* ---- openings */

static bool opening_is_new(tn_check *check, const tn_checked_form *form, const tn_ast_word *name)
{
    const char *what = NULL;
    for (size_t i = 0; i < TN_FACE_KIND_COUNT; i++)
        if (strcmp(tn_names_FACE_KIND[i], name->text) == 0)
            what = "a kind of face";
    for (uint32_t i = 0; i < form->opening_count; i++)
        if (strcmp(form->openings[i].ast->name->text, name->text) == 0)
            what = "another opening";
    if (!what)
        return tn_name_fits(check->diagnostics, name->text, name->node.span);
    tn_diagnostic *d = tn_report(check->diagnostics, E_PART_TWICE, name->node.span,
                                 "the name `%s` is that of %s already", name->text, what);
    tn_help(check->diagnostics, d, "choose another name");
    return false;
}

/* `near SIDE LENGTH`: once in walls that run in x, once in those that run in y. Half a wall stands at the end. */
static void read_near(tn_check *check, const tn_checked_form *form, const tn_ast_opening_part *part,
                      tn_checked_opening *opening)
{
    int64_t length = tn_form_length(check, part->length), least = form->thickness[0] / 2;
    bool in_x = part->side->value == TN_HOUSE_LEFT || part->side->value == TN_HOUSE_RIGHT;
    const tn_ast_opening_part **near = in_x ? &opening->near_x : &opening->near_y;
    if (*near) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_PART_TWICE, part->node.span,
                                     "where `%s` begins in a wall at the %s is said twice", opening->ast->name->text,
                                     in_x ? "back or front" : "left or right");
        tn_note(check->diagnostics, d, &(*near)->node.span, "the first time is here");
        tn_help(check->diagnostics, d, "leave one of the two out");
    } else if (length >= 0 && length < least) {
        char shown[64];
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_BAD_OPENING, part->node.span,
                      "opening `%s` would begin in the wall at the end of its face", opening->ast->name->text);
        tn_length_write_style(least, tn_length_style_of(part->length->text), shown, sizeof shown);
        tn_help(check->diagnostics, d, "half of a `wall` stands there: write `near %s %s`, or more", part->side->text,
                shown);
    }
    *near = part;
}

/* The sizes of an opening; false where one of them is wrong: then reported. */
static bool read_opening(tn_check *check, const tn_checked_form *form, tn_checked_opening *opening)
{
    const tn_ast_form_clause *ast = opening->ast;
    opening->wide = tn_form_length(check, ast->length);
    opening->high = tn_form_length(check, ast->high);
    for (TN_EACH(const tn_ast_opening_part, part, ast->parts)) {
        if (part->part == TN_OPENING_SILL)
            opening->sill = tn_form_length(check, part->length);
        else if (part->part == TN_OPENING_CLEAR)
            opening->clear = tn_form_length(check, part->length);
        else if (part->part == TN_OPENING_NEAR)
            read_near(check, form, part, opening);
        opening->passage |= part->part == TN_OPENING_PASSAGE;
        opening->glazed |= part->part == TN_OPENING_GLAZED;
        opening->leafless |= part->part == TN_OPENING_LEAFLESS;
        opening->sliding |= part->part == TN_OPENING_SLIDING;
    }
    if (opening->wide != 0 && opening->high != 0)
        return opening->wide > 0 && opening->high > 0 && opening->sill >= 0 && opening->clear >= 0;
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_BAD_OPENING, ast->node.span, "opening `%s` has no size", ast->name->text);
    tn_help(check->diagnostics, d, "write `wide` and `high` with lengths above 0");
    return false;
}

void tn_check_opening(tn_check *check, tn_checked_form *form, const tn_ast_form_clause *ast)
{
    tn_checked_opening opening = {.ast = ast};
    if (!opening_is_new(check, form, ast->name) || !tn_check_room(check, form->opening_count, TN_OPENINGS_MAX,
                                                                  "opening", ast->node.span, "leave some of them out"))
        return;
    bool good = read_opening(check, form, &opening), fits = false;
    for (uint32_t i = 0; i < form->storey_count; i++)
        fits |= form->storeys[i].height < 0 || /* no length: that was said */
                opening.sill + opening.high <= form->storeys[i].height - form->thickness[2];
    if (good && !fits && form->storey_count > 0) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_OPENING, ast->high->node.span,
                                     "opening `%s` is higher than every storey", ast->name->text);
        tn_help(check->diagnostics, d,
                "`sill` and `high` added must be less than the height between a floor and the deck above it");
    }
    form->openings[form->opening_count++] = opening;
}

/* ---- flights of stairs */

static void bad_flight(tn_check *check, const tn_ast_form_clause *ast, const char *what, const char *help)
{
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_BAD_FLIGHT, ast->node.span, "flight `%s` %s", ast->name->text, what);
    tn_help(check->diagnostics, d, "%s", help);
}

static bool read_turn(tn_check *check, const tn_ast_form_clause *ast, tn_turn *turn)
{
    *turn = !ast->detail                         ? TN_TURN_STRAIGHT
            : tn_word_is(ast->detail, "quarter") ? TN_TURN_QUARTER
            : tn_word_is(ast->detail, "half")    ? TN_TURN_HALF
                                                 : TN_TURN_NONE;
    if (*turn != TN_TURN_NONE)
        return true;
    bad_flight(check, ast, "has a `turn` that the language does not know",
               "write `turn quarter` or `turn half`, or leave `turn` out");
    return false;
}

/* Does a whole number of equal steps lead up a storey? Four or more: there is one on either side of a landing. */
static bool climbs(const tn_checked_opening *flight, int64_t height)
{
    int64_t risers = (height + flight->rise_most - 1) / flight->rise_most;
    return risers >= 4 && risers * flight->rise_least <= height;
}

void tn_check_flight(tn_check *check, tn_checked_form *form, const tn_ast_form_clause *ast)
{
    tn_checked_opening flight = {.ast = ast, .passage = true};
    if (!opening_is_new(check, form, ast->name) || !tn_check_room(check, form->opening_count, TN_OPENINGS_MAX,
                                                                  "opening", ast->node.span, "leave some of them out"))
        return;
    flight.wide = tn_form_length(check, ast->length);
    flight.rise_least = tn_form_length(check, ast->low);
    flight.rise_most = tn_form_length(check, ast->high);
    flight.going = tn_form_length(check, ast->going);
    flight.high = 1;
    bool known = flight.wide >= 0 && flight.rise_least >= 0 && flight.rise_most >= 0 && flight.going >= 0;
    bool sized = flight.wide > 0 && flight.rise_least > 0 && flight.rise_most > 0 && flight.going > 0, fits = false;
    bool turns = read_turn(check, ast, &flight.turn);
    if (!turns)
        flight.turn = TN_TURN_STRAIGHT; /* a flight all the same */
    for (uint32_t i = 0; sized && i < form->storey_count; i++)
        fits |= form->storeys[i].height < 0 || climbs(&flight, form->storeys[i].height);
    if (known && !sized)
        bad_flight(check, ast, "has no size", "write lengths above 0");
    else if (sized && flight.rise_least > flight.rise_most)
        bad_flight(check, ast, "has a `rise` whose larger length is first",
                   tn_form_in_unit(form, "write them as `rise 6\"..7 3/4\"`", "write them as `rise 150mm..190mm`"));
    else if (sized && turns && !fits && form->storey_count > 0)
        bad_flight(
            check, ast, "climbs no storey in equal steps of such a rise",
            "a storey is a whole number of steps, four or more: let `rise` go from a smaller length to a larger one");
    form->openings[form->opening_count++] = flight;
}

/* ---- faces */

bool tn_form_kind_belongs(const tn_checked_form *form, tn_face_relation relation, uint32_t kind)
{
    if (kind >= TN_FACE_KIND_COUNT)
        return (form->openings[kind - TN_FACE_KIND_COUNT].turn != TN_TURN_NONE) == (relation == TN_FACE_UNDER);
    if (relation == TN_FACE_UNDER)
        return kind == TN_FACE_FLOOR || kind == TN_FACE_STAIR || kind == TN_FACE_OPEN;
    return kind != TN_FACE_FLOOR && kind != TN_FACE_STAIR;
}

uint32_t tn_form_kind(tn_check *check, const tn_checked_form *form, tn_face_relation relation, const tn_ast_word *word)
{
    const char *names[TN_FACE_KIND_COUNT + TN_OPENINGS_MAX];
    size_t count = 0;
    for (uint32_t i = 0; i < TN_FACE_KIND_COUNT + form->opening_count; i++) {
        const char *name =
            i < TN_FACE_KIND_COUNT ? tn_names_FACE_KIND[i] : form->openings[i - TN_FACE_KIND_COUNT].ast->name->text;
        if (strcmp(name, word->text) == 0)
            return i;
        if (relation == TN_FACE_RELATION_COUNT || tn_form_kind_belongs(form, relation, i))
            names[count++] = name;
    }
    tn_form_unknown(check, form, word, "opening or kind of face", names, count);
    return TN_NONE;
}

static void add_kind(tn_check *check, const tn_checked_form *form, tn_checked_face *face, const tn_ast_word *word)
{
    uint32_t kind = tn_form_kind(check, form, face->ast->relation, word);
    if (kind == TN_NONE)
        return;
    for (uint32_t i = 0; i < face->kind_count; i++)
        if (face->kinds[i] == kind) {
            tn_diagnostic *d =
                tn_report(check->diagnostics, E_PART_TWICE, word->node.span, "`%s` is there twice", word->text);
            tn_help(check->diagnostics, d, "leave one of the two out");
            return;
        }
    if (!tn_form_kind_belongs(form, face->ast->relation, kind)) {
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_UNKNOWN_PART, word->node.span, "`%s` cannot be in such a face", word->text);
        tn_help(check->diagnostics, d,
                face->ast->relation == TN_FACE_UNDER ? "between storeys there is `floor`, `stair`, `open` or a flight"
                : face->ast->relation == TN_FACE_OUTSIDE
                    ? "outside there is `wall`, `party`, `open` or an opening"
                    : "between rooms there is `wall`, `party`, `open` or an opening");
        return;
    }
    face->kinds[face->kind_count++] = kind;
}

void tn_check_face(tn_check *check, tn_checked_form *form, const tn_ast_form_clause *ast)
{
    if (!tn_check_room(check, form->face_count, TN_FACE_LINES_MAX, "line of faces", ast->node.span,
                       "join some of them by `or`"))
        return;
    tn_checked_face *face = &form->faces[form->face_count++];
    *face = (tn_checked_face){.ast = ast, .kinds = TN_NEW_ARRAY(check->arena, uint32_t, ast->list.count)};
    if (!face->kinds)
        return;
    tn_form_cell(check, form, ast->first, true, &face->first);
    if (ast->relation != TN_FACE_OUTSIDE)
        tn_form_cell(check, form, ast->second, true, &face->second);
    for (TN_EACH(const tn_ast_word, word, ast->list))
        add_kind(check, form, face, word);
}
