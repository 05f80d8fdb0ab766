/* Warns about what of a form comes to nothing. */
#include <stdlib.h>

#include "driver/house/survey_parts.h"
#include "runtime/house/count/houses.h"
#include "runtime/house/solids.h"
#include "runtime/house/ways.h"
#include "runtime/plan/library/library.h"

static void warn_functions(const tn_survey *s)
{
    for (uint32_t f = 0; f < tn_form_functions(&s->form); f++) {
        const tn_cell_rule_record *rule = tn_form_rule(&s->form, f);
        if (s->functions[f] || tn_survey_allows(s, W_FUNCTION_NEVER, TN_SURVEY_SPAN(rule)))
            continue;
        tn_diagnostic *d = tn_report(tn_survey_list(s), W_FUNCTION_NEVER, TN_SURVEY_SPAN(rule),
                                     "no cell may have the function `%s`", tn_text(s->form.module, rule->name));
        tn_help(tn_survey_list(s), d,
                "no one cell, in a storey that some house has, meets all items after `at` and is kept by every "
                "`void` and `no`");
    }
}

/* Functions whose cells are in the open, but stand beside none that is not: no wall of the house is outside there. */
static void warn_outdoor(const tn_survey *s)
{
    for (uint32_t f = 0; s->met && f < tn_form_functions(&s->form); f++) {
        const tn_cell_rule_record *rule = tn_form_rule(&s->form, f);
        const char *name = tn_text(s->form.module, rule->name);
        if (!tn_form_is_outdoor(&s->form, f) || !s->functions[f] || tn_survey_has(s->shelters, f) ||
            tn_survey_allows(s, W_OUTDOOR_ALONE, TN_SURVEY_SPAN(rule)))
            continue;
        tn_diagnostic *d = tn_report(tn_survey_list(s), W_OUTDOOR_ALONE, TN_SURVEY_SPAN(rule),
                                     "`%s` is outdoor, but no cell that is indoors stands beside it", name);
        tn_help(
            tn_survey_list(s), d,
            "walls between outdoor cells and others are outside walls: write `function %s at` without `outdoor`, or "
            "let a cell of its storey have a function that is not outdoor",
            name);
    }
}

/* Does a line outside that says what its cells are leave those of the function open? */
static bool is_left_open(const tn_survey *s, uint32_t function)
{
    const tn_module *module = s->form.module;
    bool open = false;
    for (uint32_t i = 0; !open && i < s->form.record->face_count; i++) {
        const tn_face_line_record *line = &module->FACE_LINE_records[s->form.record->face_first + i];
        for (uint32_t k = 0; line->relation == TN_FACE_OUTSIDE && k < line->kind_count; k++)
            if (module->HOUSE_ITEM_records[line->kind_first + k].number == TN_FACE_OPEN)
                open |= tn_form_line_names(&s->form, line, function);
    }
    return open;
}

/* Functions of porches whose walls to the rooms are walls between rooms. */
static void warn_open(const tn_survey *s)
{
    for (uint32_t f = 0; f < tn_form_functions(&s->form); f++) {
        const tn_cell_rule_record *rule = tn_form_rule(&s->form, f);
        const char *name = tn_text(s->form.module, rule->name);
        if (tn_form_is_outdoor(&s->form, f) || !is_left_open(s, f) ||
            tn_survey_allows(s, W_NOT_OUTDOOR, TN_SURVEY_SPAN(rule)))
            continue;
        tn_diagnostic *d = tn_report(
            tn_survey_list(s), W_NOT_OUTDOOR, TN_SURVEY_SPAN(rule),
            "a cell of `%s` may be open to the outside, but its walls to rooms are walls between rooms", name);
        tn_help(tn_survey_list(s), d, "write `function %s outdoor at`: then they are outside walls", name);
    }
}

/* Those that meet cells of the lowest storey alone; what meets no cell at all is said elsewhere. */
static void warn_voids(const tn_survey *s)
{
    const tn_module *module = s->form.module;
    for (uint32_t i = s->form.kinds_end[TN_CELL_VOID - 1]; i < s->form.kinds_end[TN_CELL_VOID]; i++) {
        const tn_cell_rule_record *rule = tn_form_rule(&s->form, i);
        if (s->voids[i] != TN_VOID_LOWEST || tn_survey_allows(s, W_VOID_NEVER, TN_SURVEY_SPAN(rule)))
            continue;
        tn_diagnostic *d = tn_report(tn_survey_list(s), W_VOID_NEVER, TN_SURVEY_SPAN(rule),
                                     "this void means nothing: it is about cells of the lowest storey alone");
        tn_help(tn_survey_list(s), d,
                "a void is open to the cell below it, so it needs a storey above `%s`; cells that are not there are "
                "`no cell(...)`",
                tn_text(module, module->STOREY_records[s->form.record->storey_first].name));
    }
}

static tn_status warn_bare(const tn_survey *s, tn_error *error)
{
    const tn_form_record *form = s->form.record;
    tn_buffer line = {0};
    if (!s->bare || tn_form_functions(&s->form) == 0 || tn_survey_allows(s, W_NO_FUNCTION, TN_SURVEY_SPAN(form)))
        return TN_OK;
    bool ok = tn_plan_write_line(s->schema, &s->bare_tray, 1, &line);
    tn_diagnostic *d = tn_report(
        tn_survey_list(s), W_NO_FUNCTION, TN_SURVEY_SPAN(form),
        "form `%s`: no function may take the %s in storey `%s` of some trays", tn_text(s->form.module, form->name),
        tn_text(s->form.module, s->schema->fields[s->bare_cell.zone].name),
        tn_text(s->form.module, s->form.module->STOREY_records[form->storey_first + s->bare_cell.storey].name));
    tn_note(tn_survey_list(s), d, NULL, "this plan has no house: %s", ok ? line.data : "");
    tn_help(tn_survey_list(s), d, "add a function for such cells; or say that they are not there: `no cell(...)`");
    free(line.data);
    return ok ? TN_OK : tn_fail_memory(error);
}

static void say_in_way(const tn_survey *s, uint32_t tile, const tn_tile_failure *further, tn_diagnostic *d)
{
    char why[4 * TN_NAME_MAX];
    if (further->obstacle == TN_TILE_STANDS) {
        tn_note(tn_survey_list(s), d, NULL, "no cell may have a function that it is for");
        tn_help(tn_survey_list(s), d, "let a cell have such a function, or name another one after `for`");
        return;
    }
    tn_tile_failure_text(&s->form, tile, further, tn_house_length_style(&s->house), why, sizeof why);
    bool stops = tn_tile_failure_stops(further);
    tn_note(tn_survey_list(s), d, NULL, stops ? "%s" : "where it comes furthest, %s", why);
    if (stops)
        tn_help(tn_survey_list(s), d,
                "leave a gap between its items that is as wide as the `way`, or keep free what can be reached");
    else if (further->obstacle == TN_TILE_MEETS_BOX)
        tn_help(tn_survey_list(s), d, "items of a tile may not overlap, nor be in what it keeps free");
    else
        tn_help(tn_survey_list(s), d,
                "make its boxes, or its `wide` and `deep`, smaller: they must fit between the walls, the floor and the "
                "ceiling of a room, beside each other");
}

static tn_status warn_tile(const tn_survey *s, uint32_t number, tn_error *error)
{
    const tn_tile_record *tile = &s->form.module->TILE_records[s->form.record->tile_first + number];
    tn_tile_failure further;
    bool fits;
    if (tn_survey_allows(s, W_TILE_NEVER, TN_SURVEY_SPAN(tile)))
        return TN_OK;
    tn_status status = tn_survey_tile_anywhere(s, number, &fits, &further, error);
    if (status != TN_OK || fits)
        return status;
    tn_diagnostic *d = tn_report(tn_survey_list(s), W_TILE_NEVER, TN_SURVEY_SPAN(tile), "tile `%s` fits into no cell",
                                 tn_text(s->form.module, tile->name));
    say_in_way(s, s->form.record->tile_first + number, &further, d);
    return TN_OK;
}

bool tn_survey_names(const tn_survey *s, uint32_t kind)
{
    const tn_module *module = s->form.module;
    for (uint32_t i = 0; i < s->form.record->face_count; i++) {
        const tn_face_line_record *line = &module->FACE_LINE_records[s->form.record->face_first + i];
        for (uint32_t k = 0; k < line->kind_count; k++)
            if (module->HOUSE_ITEM_records[line->kind_first + k].number == kind)
                return true;
    }
    return false;
}

static void warn_opening(const tn_survey *s, uint32_t number)
{
    const tn_opening_record *opening = &s->form.module->OPENING_records[s->form.record->opening_first + number];
    const char *name = tn_text(s->form.module, opening->name);
    bool flight = tn_form_flight(&s->form, TN_FACE_KIND_COUNT + number);
    bool named = tn_survey_names(s, TN_FACE_KIND_COUNT + number);
    int64_t in_x = tn_opening_needs(&s->form, opening, true), in_y = tn_opening_needs(&s->form, opening, false);
    bool wider = (in_x < in_y ? in_x : in_y) > s->widest;
    if ((named && !wider && s->uses[TN_FACE_KIND_COUNT + number].used) ||
        tn_survey_allows(s, W_OPENING_NEVER, TN_SURVEY_SPAN(opening)))
        return;
    tn_diagnostic *d = tn_report(tn_survey_list(s), W_OPENING_NEVER, TN_SURVEY_SPAN(opening),
                                 !named   ? "no face has the opening `%s`"
                                 : flight ? "no face can have the flight `%s`"
                                 : wider  ? "opening `%s` is wider than every face"
                                          : "no face can have the opening `%s`",
                                 name);
    if (!named)
        tn_help(tn_survey_list(s), d, "name it in a line such as `face cell(any) %s = %s`",
                flight ? "under cell(any)" : "outside", name);
    else if (!wider && !s->uses[TN_FACE_KIND_COUNT + number].used)
        tn_survey_say_misfit(s, d, &s->uses[TN_FACE_KIND_COUNT + number].nearest, TN_FACE_KIND_COUNT + number);
    if (named && flight)
        tn_help(tn_survey_list(s), d, TN_FLIGHT_NEEDS);
    else if (named)
        tn_help(tn_survey_list(s), d,
                wider ? "a face has to be as wide as the opening and a `wall` added"
                      : "the faces of the lines that name it are narrower than it and a `wall` added, or lower, or "
                        "lines before these decide them");
}

/* ---- forms */

static tn_status warn(const tn_survey *s, tn_error *error)
{
    warn_functions(s);
    warn_voids(s);
    warn_outdoor(s);
    warn_open(s);
    tn_survey_stairs(s);
    for (uint32_t i = 0; i < s->form.record->opening_count; i++)
        warn_opening(s, i);
    tn_status status = warn_bare(s, error);
    if (status == TN_OK)
        status = tn_survey_reach(s, error);
    for (uint32_t i = 0; status == TN_OK && i < s->form.record->tile_count; i++) {
        status = warn_tile(s, i, error);
        if (status == TN_OK && tn_watch_stopped(s->form.module->watch))
            status = tn_fail_stopped(s->form.module->watch, error);
    }
    return status;
}

/* Of a form of another file only what this file asks of it is warned about. */
static tn_status survey(tn_opened *opened, uint32_t form, tn_error *error)
{
    bool own = !(opened->module->FORM_records[form].flags & TN_IMPORTED);
    bool asked = true;
    tn_survey *s;
    tn_status status = own ? TN_OK : tn_survey_asks_walks(opened, form, &asked, error);
    if (status != TN_OK || !asked)
        return status;
    status = tn_survey_begin(opened->module, form, own ? opened : NULL, &s, error);
    if (status == TN_LIMIT)
        return TN_OK; /* said of the schema */
    if (status == TN_OK)
        status = tn_survey_ends(s, opened, error);
    if (status == TN_OK)
        status = tn_survey_trays(s, error);
    if (status == TN_OK && s->complete && own)
        status = warn(s, error);
    if (status == TN_OK && s->complete)
        status = tn_survey_warn_walks(s, opened, error);
    tn_survey_free(s);
    return status;
}

tn_status tn_house_survey(tn_opened *opened, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && opened->compiled && i < opened->module->FORM_count; i++)
        status = survey(opened, i, error);
    return status;
}
