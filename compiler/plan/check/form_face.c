/* Checks the openings of a form, the lines that say what is in its faces, and what it asks about ways. */
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
                "`sill` and `high` added must be less than the height between a floor and the ceiling above it");
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
            : tn_word_is(ast->detail, "spiral")  ? TN_TURN_SPIRAL
                                                 : TN_TURN_NONE;
    if (*turn != TN_TURN_NONE)
        return true;
    bad_flight(check, ast, "has a `turn` that the language does not know",
               "write `turn quarter`, `turn half` or `turn spiral`, or leave `turn` out");
    return false;
}

/* Wedges stand where it turns: two or three for each right angle. */
static void read_winders(tn_check *check, const tn_ast_form_clause *ast, tn_checked_opening *flight)
{
    bool turns = flight->turn == TN_TURN_HALF || flight->turn == TN_TURN_QUARTER;
    if (!ast->winders || ast->winders->broken)
        return;
    int64_t wedges = ast->winders->kind == TN_WORD_NUMBER ? ast->winders->value : 0;
    if (!turns)
        bad_flight(check, ast, "has `winders`, and turns by no right angle", "write `turn half` or `turn quarter` too");
    else if (wedges != 2 && wedges != 3)
        bad_flight(check, ast, "has another number of `winders` than two or three",
                   "write `winders 2` or `winders 3`");
    else
        flight->winders = (uint32_t)wedges;
}

/* A spiral has its steps around its middle; others say how deep they are. */
static int64_t read_going(tn_check *check, const tn_checked_form *form, const tn_ast_form_clause *ast, tn_turn turn)
{
    if (ast->going)
        return tn_form_length(check, ast->going);
    if (turn == TN_TURN_SPIRAL)
        return 0;
    bad_flight(check, ast, "does not say how deep its steps are",
               tn_form_in_unit(form, "add `going 10\"` behind `rise`", "add `going 250mm` behind `rise`"));
    return -1;
}

/* Does a whole number of equal steps lead up a storey? Four or more: there is one on either side of a landing. Wedges
 * take the places of others. */
static bool climbs(const tn_checked_opening *flight, int64_t height)
{
    int64_t risers = (height + flight->rise_most - 1) / flight->rise_most,
            wedges = (flight->turn == TN_TURN_HALF ? 2 : 1) * (int64_t)flight->winders;
    return risers >= 4 && risers > wedges && risers * flight->rise_least <= height;
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
    bool turns = read_turn(check, ast, &flight.turn);
    if (!turns)
        flight.turn = TN_TURN_STRAIGHT; /* a flight all the same */
    flight.going = read_going(check, form, ast, flight.turn);
    read_winders(check, ast, &flight);
    flight.high = 1;
    bool goes = flight.going > 0 || flight.turn == TN_TURN_SPIRAL, known = flight.wide >= 0 && flight.rise_least >= 0 && flight.rise_most >= 0 && flight.going >= 0;
    bool sized = flight.wide > 0 && flight.rise_least > 0 && flight.rise_most > 0 && goes, fits = false;
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

/* ==== ways */

static const tn_ast_form_clause *find(const tn_checked_form *form, tn_form_part part, bool named)
{
    for (TN_EACH(const tn_ast_form_clause, clause, form->ast->clauses))
        if (clause->part == part && (clause->list.count > 0) == named)
            return clause;
    return NULL;
}

/* Above 0, and, of a square, with a half that is whole. 0 where it is not so: reported. */
static int64_t read_length(tn_check *check, const tn_ast_form_clause *ast, const char *what, bool halved)
{
    int64_t length = tn_form_length(check, ast->length);
    if (length > 0 && !(halved && length % 2))
        return length;
    if (length < 0)
        return 0;
    tn_diagnostic *d = tn_report(
        check->diagnostics, E_BAD_WAY, ast->length->node.span,
        length == 0 ? "a `%s` of 0 asks for nothing" : "half of this `%s` is not a whole number of nanometres", what);
    if (length == 0)
        tn_help(check->diagnostics, d, "write a length above 0, or leave the line out");
    else
        tn_form_help_half(check, d, "people turn about their middle", length, ast->length->text);
    return 0;
}

/* ---- way */

static void read_for(tn_check *check, tn_checked_form *form, const tn_ast_form_clause *ast)
{
    const char *names[TN_CELL_RULES_MAX];
    int64_t length = read_length(check, ast, "way", true);
    for (uint32_t i = 0; i < form->function_count; i++)
        names[i] = form->rules[i].ast->name->text;
    for (TN_EACH(const tn_ast_word, word, ast->list)) {
        uint32_t function = tn_form_function(form, word->text);
        if (function == TN_NONE)
            tn_form_unknown(check, form, word, "function", names, form->function_count);
        else if (form->ways[function].ast)
            tn_form_twice(check, &ast->node.span, &form->ways[function].ast->node.span, "way for ", word->text);
        else
            form->ways[function] = (tn_checked_way){ast, length};
    }
}

/* A line that a form has once. */
static void read_once(tn_check *check, const tn_ast_form_clause *clause, const char *what,
                      const tn_ast_form_clause **ast, int64_t *length)
{
    if (*ast) {
        tn_form_twice(check, &clause->node.span, &(*ast)->node.span, what, "");
        return;
    }
    *ast = clause;
    *length = read_length(check, clause, what, clause->part == TN_PART_WAY);
}

static void read_ways(tn_check *check, tn_checked_form *form)
{
    for (TN_EACH(const tn_ast_form_clause, clause, form->ast->clauses)) {
        if (clause->part == TN_PART_WAY && clause->list.count > 0)
            read_for(check, form, clause);
        else if (clause->part == TN_PART_WAY)
            read_once(check, clause, "way", &form->way_ast, &form->way);
        else if (clause->part == TN_PART_HEADROOM)
            read_once(check, clause, "headroom", &form->headroom_ast, &form->headroom);
        else if (clause->part == TN_PART_GUARD)
            read_once(check, clause, "guard", &form->guard_ast, &form->guard);
    }
}

/* What is not said: a door of 800 mm, or of 2'8", a person of 2 m, or of 6'8", and guards of 1 m, or of 3'. */
static void fill_in(tn_checked_form *form)
{
    bool feet = form->storey_count > 0 && tn_length_style_of(form->storeys[0].ast->length->text) == TN_STYLE_FEET;
    if (form->way == 0)
        form->way = feet ? 32 * TN_INCH_NM : INT64_C(800000000);
    if (form->headroom == 0)
        form->headroom = feet ? 80 * TN_INCH_NM : INT64_C(2000000000);
    if (form->guard == 0)
        form->guard = feet ? 36 * TN_INCH_NM : INT64_C(1000000000);
}

/* ---- what cannot be there with it */

static const char *written(int64_t length, const char *like, char text[64])
{
    tn_length_write_style(length, tn_length_style_of(like), text, 64);
    return text;
}

/* Nobody comes into such cells if each opening that one walks through is narrower. */
static void check_width(tn_check *check, const tn_checked_form *form, const tn_ast_form_clause *ast, int64_t way)
{
    const tn_checked_opening *widest = NULL;
    char shown[64];
    for (uint32_t i = 0; i < form->opening_count; i++) {
        const tn_checked_opening *opening = &form->openings[i];
        if (opening->turn == TN_TURN_NONE && opening->passage && opening->wide > 0 &&
            (!widest || opening->wide > widest->wide))
            widest = opening;
    }
    if (way == 0 || !widest || widest->wide >= way)
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_WAY, ast->length->node.span,
                                 "this `way` is wider than every opening that one walks through");
    tn_note(check->diagnostics, d, &widest->ast->length->node.span, "the widest is `%.80s`", widest->ast->name->text);
    tn_help(check->diagnostics, d, "write %s or less, or make an opening wider",
            written(widest->wide, ast->length->text, shown));
}

/* What is usual, in nanometres, by no law: so steep a step is climbed with ease, and two people pass each other. */
#define USUAL_RISE INT64_C(200000000)
#define USUAL_GOING INT64_C(250000000)
#define USUAL_STEP_LEAST INT64_C(550000000) /* two rises and a going */
#define USUAL_STEP_MOST INT64_C(700000000)
#define USUAL_WIDTH INT64_C(860000000)

/* What is unusual about a step so high; NULL: nothing. *length: by this; *usual: what would do. */
static const char *unusual_step(const tn_checked_opening *flight, int64_t rise, int64_t *length, const char **usual)
{
    int64_t step = 2 * rise + flight->going;
    bool steep = rise > USUAL_RISE, shallow = flight->going < USUAL_GOING;
    *length = steep ? rise : shallow ? flight->going : step;
    *usual = steep                     ? "at most 200 mm is usual"
             : shallow                 ? "at least 250 mm is usual"
             : step < USUAL_STEP_LEAST ? "at least 550 mm is usual"
                                       : "at most 700 mm is usual";
    return steep                                               ? "has steps that rise"
           : shallow                                           ? "has steps with a going of"
           : step < USUAL_STEP_LEAST || step > USUAL_STEP_MOST ? "has steps of which two rises and a going make"
                                                               : NULL;
}

static void warn_spiral(tn_check *check, const tn_checked_opening *flight)
{
    tn_diagnostic *d = tn_report(check->diagnostics, W_UNUSUAL_FLIGHT, flight->ast->node.span,
                                 "flight `%.80s` is a spiral", flight->ast->name->text);
    tn_help(check->diagnostics, d, "its steps are narrow at the middle, and nothing large is carried up; who means it so "
                                   "writes `allow W212`");
}

static void warn_unusual(tn_check *check, const tn_checked_opening *flight, const char *what, int64_t length,
                         const char *usual)
{
    char shown[64];
    tn_diagnostic *d = tn_report(check->diagnostics, W_UNUSUAL_FLIGHT, flight->ast->node.span, "flight `%.80s` %s %s",
                                 flight->ast->name->text, what, written(length, flight->ast->length->text, shown));
    tn_help(check->diagnostics, d, "%s; who means it so writes `allow W212`", usual);
}

/* Common practice is no law: it is said, once for each flight, and not asked for. */
static void check_usual(tn_check *check, const tn_checked_form *form, const tn_checked_opening *flight)
{
    int64_t length;
    const char *usual, *what = NULL;
    if (flight->turn == TN_TURN_SPIRAL) {
        warn_spiral(check, flight);
        return;
    }
    for (uint32_t k = 0; !what && k + 1 < form->storey_count; k++) {
        int64_t height = form->storeys[k].height;
        if (height <= 0 || !climbs(flight, height))
            continue;
        int64_t risers = (height + flight->rise_most - 1) / flight->rise_most;
        what = unusual_step(flight, height / risers, &length, &usual);
    }
    if (what)
        warn_unusual(check, flight, what, length, usual);
    else if (flight->wide < USUAL_WIDTH)
        warn_unusual(check, flight, "has a width of", flight->wide, "at least 860 mm is usual");
}

static void check_flights(tn_check *check, const tn_checked_form *form)
{
    char shown[64];
    bool own = form->unit + 1 == check->imports->count; /* of forms that are used, their own files are told */
    for (uint32_t i = 0; i < form->opening_count; i++) {
        const tn_checked_opening *flight = &form->openings[i];
        bool sized = flight->turn != TN_TURN_NONE && flight->wide > 0 && flight->rise_least > 0 &&
                     flight->rise_most > 0 && (flight->going > 0 || flight->turn == TN_TURN_SPIRAL);
        bool spiral = flight->turn == TN_TURN_SPIRAL; /* one climbs it in half of its width */
        int64_t needed = spiral ? 2 * form->way : form->way;
        if (sized && own && flight->wide >= needed && tn_check_wanted(check, W_UNUSUAL_FLIGHT))
            check_usual(check, form, flight);
        if (!sized || flight->wide >= needed)
            continue;
        tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_FLIGHT, flight->ast->length->node.span,
                                     "flight `%.80s` is narrower than %sthe `way` that people need",
                                     flight->ast->name->text, spiral ? "twice " : "");
        tn_help(check->diagnostics, d, "make it %s wide or more", written(needed, flight->ast->length->text, shown));
    }
}

/* Flights that stand only where ways are left for them. */
static void check_unplaced(tn_check *check, const tn_checked_form *form)
{
    for (uint32_t i = 0; i < form->opening_count; i++) {
        const tn_checked_opening *flight = &form->openings[i];
        if (flight->winders > 0 || flight->turn == TN_TURN_SPIRAL)
            bad_flight(check, flight->ast,
                       flight->winders > 0 ? "has `winders` in a form without `way`" : "is a spiral in a form without `way`",
                       tn_form_in_unit(form, "add a line such as `way 2'8\"`", "add a line such as `way 800mm`"));
    }
}

/* A stair that takes the whole cell leaves no way. */
static void check_stairs(tn_check *check, const tn_checked_form *form)
{
    for (uint32_t i = 0; i < form->face_count; i++)
        for (TN_EACH(const tn_ast_word, word, form->faces[i].ast->list)) {
            if (strcmp(word->text, tn_names_FACE_KIND[TN_FACE_STAIR]) != 0)
                continue;
            tn_diagnostic *d = tn_report(check->diagnostics, E_BAD_WAY, word->node.span,
                                         "a `stair` takes its whole cell, and leaves no way");
            tn_help(check->diagnostics, d, "name a flight there, such as `%s`",
                    tn_form_in_unit(form, "flight dogleg wide 3' rise 6\"..7 3/4\" going 10\" turn half",
                                    "flight dogleg wide 900mm rise 150mm..195mm going 250mm turn half"));
        }
}

/* Lines about people in a form that asks nothing about them. */
static void check_idle(tn_check *check, const tn_checked_form *form, const tn_ast_form_clause *ast, const char *what)
{
    if (!ast)
        return;
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_BAD_WAY, ast->node.span, "`%s` without `way` asks for nothing", what);
    tn_help(check->diagnostics, d, "add a line such as `way %s`", tn_form_in_unit(form, "2'8\"", "800mm"));
}

void tn_check_ways(tn_check *check, tn_checked_form *form)
{
    read_ways(check, form);
    const tn_ast_form_clause *any = form->way_ast ? form->way_ast : find(form, TN_PART_WAY, true);
    if (!any) {
        check_idle(check, form, form->headroom_ast, "headroom");
        check_idle(check, form, form->guard_ast, "guard");
        check_unplaced(check, form);
        form->headroom = form->guard = 0;
        return;
    }
    fill_in(form);
    check_width(check, form, any, form->way_ast ? form->way : 0);
    for (uint32_t i = 0; i < form->function_count; i++)
        if (form->ways[i].ast && (i == 0 || form->ways[i].ast != form->ways[i - 1].ast))
            check_width(check, form, form->ways[i].ast, form->ways[i].length);
    check_flights(check, form);
    check_stairs(check, form);
}
