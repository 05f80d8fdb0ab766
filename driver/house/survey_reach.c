/* Finds the functions, and the storeys, that nobody comes to from outside in any house of a form.
 *
 * Cells that lines of faces do not tell apart are a class (survey.h). Two classes are linked if some face between cells
 * of them may have what people go through; a class is an entrance if some outside wall of it in the lowest storey may,
 * or may be open. What is linked with no entrance, directly or by way of others, is reached in no house. Links are
 * taken for more than there are, so that what is said holds; it is not all of the kind.
 */
#include <stdlib.h>

#include "driver/house/survey_parts.h"
#include "runtime/base/array.h"
#include "runtime/house/solids.h"

int64_t tn_survey_passes(const tn_survey *s, const tn_survey_meeting *m, uint32_t kind)
{
    const tn_opening_record *opening = tn_form_opening(&s->form, kind);
    if (m->relation == TN_FACE_UNDER)
        return kind == TN_FACE_STAIR || tn_form_flight(&s->form, kind) ? INT64_MAX : 0;
    if (opening)
        return opening->flags & TN_PASSAGE && (m->b || m->a->storey == 0) ? opening->wide : 0;
    return kind == TN_FACE_OPEN && (m->b || m->a->storey == 0) ? INT64_MAX : 0;
}

tn_status tn_survey_link(tn_survey *s, const tn_survey_meeting *m, int64_t wide, tn_error *error)
{
    if (!tn_array_reserve_from(&s->links, &s->link_room, 64, s->link_count, 1, sizeof *s->links))
        return tn_fail_memory(error);
    s->links[s->link_count++] = (tn_passed){m->a, m->b, wide};
    return TN_OK;
}

/* ---- what is reached */

/* Functions by storey: [storey][words]. */
typedef struct reaching {
    const tn_survey *survey;
    uint64_t *there, *reached; /* some cell may have it; that is reached in some house */
    bool *climbed;             /* [storey] some flight or stair may lead there from below */
} reaching;

static uint64_t *of_storey(const reaching *r, uint64_t *set, uint32_t storey)
{
    return set + (size_t)storey * r->survey->words;
}

/* Does a person who needs its cells' way pass through what is so wide? */
static bool passes(const tn_survey *s, uint32_t function, int64_t wide)
{
    const tn_form_record *form = s->form.record;
    int64_t own = tn_form_rule(&s->form, function)->way;
    return form->way == 0 || wide >= (own > 0 ? own : form->way);
}

static bool touches(const reaching *r, const tn_cell_class *c, int64_t wide)
{
    const uint64_t *reached = of_storey(r, r->reached, c->storey);
    for (uint32_t f = 0; f < tn_form_functions(&r->survey->form); f++)
        if (tn_survey_has(c->functions, f) && tn_survey_has(reached, f) && passes(r->survey, f, wide))
            return true;
    return false;
}

/* Returns whether that is new of any. */
static bool reach(const reaching *r, const tn_cell_class *c, int64_t wide)
{
    uint64_t *reached = of_storey(r, r->reached, c->storey);
    bool any = false;
    for (uint32_t f = 0; f < tn_form_functions(&r->survey->form); f++) {
        if (!tn_survey_has(c->functions, f) || tn_survey_has(reached, f) || !passes(r->survey, f, wide))
            continue;
        reached[f / 64] |= UINT64_C(1) << f % 64;
        any = true;
    }
    return any;
}

static void follow_links(const reaching *r)
{
    const tn_survey *s = r->survey;
    for (bool more = true; more;) {
        more = false;
        for (size_t i = 0; i < s->link_count; i++) {
            const tn_passed *link = &s->links[i];
            if (!link->b || touches(r, link->a, link->wide))
                more |= reach(r, link->b ? link->b : link->a, link->wide);
            if (link->b && touches(r, link->b, link->wide))
                more |= reach(r, link->a, link->wide);
        }
    }
}

static void see_classes(const reaching *r)
{
    const tn_survey *s = r->survey;
    for (size_t i = 0; i < s->class_count; i++)
        for (size_t w = 0; w < s->words; w++)
            of_storey(r, r->there, s->classes[i].storey)[w] |= s->classes[i].functions[w];
    for (size_t i = 0; i < s->link_count; i++)
        if (s->links[i].b && s->links[i].a->storey != s->links[i].b->storey)
            r->climbed[s->links[i].b->storey] = true;
}

/* ---- what is said */

static bool is_empty(const tn_survey *s, const uint64_t *set)
{
    for (size_t w = 0; w < s->words; w++)
        if (set[w])
            return false;
    return true;
}

static const tn_storey_record *storey_record(const tn_survey *s, uint32_t storey)
{
    return &s->form.module->STOREY_records[s->form.record->storey_first + storey];
}

/* Is there anything that leads in? If not, that is said once. */
static bool has_entrance(const tn_survey *s)
{
    bool any = false;
    for (size_t i = 0; i < s->link_count; i++)
        any |= !s->links[i].b;
    return any;
}

static void warn_shut(const tn_survey *s)
{
    const tn_form_record *form = s->form.record;
    if (tn_survey_allows(s, W_FUNCTION_UNREACHED, TN_SURVEY_SPAN(form)))
        return;
    tn_diagnostic *d =
        tn_report(tn_survey_list(s), W_FUNCTION_UNREACHED, TN_SURVEY_SPAN(form),
                  "nobody comes into houses of form `%s` from outside", tn_text(s->form.module, form->name));
    tn_help(tn_survey_list(s), d,
            "no outside wall in storey `%s` can have an opening with `passage`, or be open: add a line such as `face "
            "cell(any) outside = door`",
            tn_text(s->form.module, storey_record(s, 0)->name));
}

/* The lowest storey, but for the ground, in which nobody comes to any cell: those above it are not reached either.
 * UINT32_MAX: none. */
static uint32_t lowest_unreached(const reaching *r)
{
    for (uint32_t storey = 1; storey < r->survey->form.record->storey_count; storey++)
        if (!is_empty(r->survey, of_storey(r, r->there, storey)) &&
            is_empty(r->survey, of_storey(r, r->reached, storey)))
            return storey;
    return UINT32_MAX;
}

/* The first flight that the form declares; NULL: none. */
static const char *first_flight(const tn_survey *s)
{
    for (uint32_t i = 0; i < s->form.record->opening_count; i++)
        if (tn_form_flight(&s->form, TN_FACE_KIND_COUNT + i))
            return tn_form_kind_text(&s->form, TN_FACE_KIND_COUNT + i);
    return NULL;
}

/* What would lead there. */
static void help_up(const tn_survey *s, tn_diagnostic *d, uint32_t storey)
{
    const char *below = tn_text(s->form.module, storey_record(s, storey - 1)->name), *flight = first_flight(s);
    if (flight)
        tn_help(tn_survey_list(s), d,
                "let some cells below it have the flight `%s`: `face cell(FUNCTION, %s) under cell(any) = %s`", flight,
                below, flight);
    else
        tn_help(
            tn_survey_list(s), d,
            "declare a flight, such as `flight steps wide %s going %s turn half`, and let some cells below have it: "
            "`face cell(FUNCTION, %s) under cell(any) = steps`",
            tn_house_length_style(&s->house) == TN_STYLE_FEET ? "3' rise 6\"..8\"" : "900mm rise 160mm..200mm",
            tn_house_length_style(&s->house) == TN_STYLE_FEET ? "10\"" : "250mm", below);
}

static void warn_storey(const reaching *r, uint32_t storey)
{
    const tn_survey *s = r->survey;
    const tn_storey_record *record = storey_record(s, storey);
    const char *name = tn_text(s->form.module, record->name);
    if (tn_survey_allows(s, W_STOREY_UNREACHED, TN_SURVEY_SPAN(record)))
        return;
    tn_diagnostic *d =
        tn_report(tn_survey_list(s), W_STOREY_UNREACHED, TN_SURVEY_SPAN(record),
                  r->climbed[storey] ? "nobody comes to storey `%s`: the cells below its stairs are not reached"
                                     : "nobody comes to storey `%s`: no flight of stairs leads there",
                  name);
    if (r->climbed[storey])
        tn_help(tn_survey_list(s), d, "let a door or an open side lead to the cells from which the stairs climb");
    else
        help_up(s, d, storey);
}

/* Cells with the function are in storeys that are not said to be unreached, and nobody comes to any. */
static bool is_unreached(const reaching *r, uint32_t function, uint32_t storeys)
{
    bool there = false, reached = false;
    for (uint32_t storey = 0; storey < storeys; storey++) {
        there |= tn_survey_has(of_storey(r, r->there, storey), function);
        reached |= tn_survey_has(of_storey(r, r->reached, storey), function);
    }
    return there && !reached;
}

static void warn_function(const tn_survey *s, uint32_t function)
{
    const tn_cell_rule_record *rule = tn_form_rule(&s->form, function);
    if (tn_survey_allows(s, W_FUNCTION_UNREACHED, TN_SURVEY_SPAN(rule)))
        return;
    tn_diagnostic *d =
        tn_report(tn_survey_list(s), W_FUNCTION_UNREACHED, TN_SURVEY_SPAN(rule),
                  "nobody comes to a cell with the function `%s` from outside", tn_text(s->form.module, rule->name));
    tn_help(
        tn_survey_list(s), d,
        s->form.record->way > 0
            ? "let a face of such cells have an opening with `passage` that is as wide as their `way`, an open side, "
              "or stairs, beside cells that are reached"
            : "let a face of such cells have an opening with `passage`, an open side, or stairs, beside cells that "
              "are reached");
}

static void warn(const reaching *r)
{
    const tn_survey *s = r->survey;
    uint32_t unreached = lowest_unreached(r);
    if (unreached != UINT32_MAX)
        warn_storey(r, unreached);
    for (uint32_t f = 0; f < tn_form_functions(&s->form); f++)
        if (is_unreached(r, f, unreached < s->form.record->storey_count ? unreached : s->form.record->storey_count))
            warn_function(s, f);
}

/* A form without passages says nothing of how people go about. */
static bool has_passages(const tn_survey *s)
{
    for (uint32_t i = 0; i < s->form.record->opening_count; i++)
        if (s->form.module->OPENING_records[s->form.record->opening_first + i].flags & TN_PASSAGE)
            return true;
    return false;
}

tn_status tn_survey_reach(const tn_survey *s, tn_error *error)
{
    size_t storeys = s->form.record->storey_count;
    if (!s->met || tn_form_functions(&s->form) == 0 || !has_passages(s))
        return TN_OK;
    if (!has_entrance(s)) {
        warn_shut(s);
        return TN_OK;
    }
    const reaching r = {.survey = s,
                        .there = calloc(storeys * s->words, sizeof *r.there),
                        .reached = calloc(storeys * s->words, sizeof *r.reached),
                        .climbed = calloc(storeys, sizeof *r.climbed)};
    tn_status status = r.there && r.reached && r.climbed ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK) {
        see_classes(&r);
        follow_links(&r);
        warn(&r);
    }
    free(r.there);
    free(r.reached);
    free(r.climbed);
    return status;
}
