/* complete: what may still be chosen in an open plan. */
#include <stdlib.h>
#include <string.h>

#include "ask/plan/best.h"
#include "ask/session/made.h"
#include "ask/session/questions.h"
#include "driver/open/digits.h"

static void free_choices(void *made)
{
    tn_open_choices *choices = made;
    if (!choices)
        return;
    tn_completions_clear(&choices->found);
    tn_weighed_free(choices->weighed);
    tn_spelled_clear(&choices->spelled);
    free(choices->trays);
    tn_schema_free(choices->own);
    mpq_clear(choices->step);
    free(choices->why);
    free(choices);
}

/* ---- the answer */

static void set_count(const tn_open_choices *c, bool *has_plans, mpz_t plans, bool *has_houses, mpz_t houses,
                      const mpz_t count)
{
    *has_houses = c->own != NULL;
    *has_plans = !c->own;
    mpz_set(c->own ? houses : plans, count);
}

static char *spelling(const tn_open_choices *c, uint32_t field, uint32_t value)
{
    return strdup(tn_text(c->schema->module, c->schema->values[c->schema->value_start[field] + value].spelling));
}

static char *name_of(const tn_open_choices *c, uint32_t field)
{
    return strdup(tn_text(c->schema->module, c->schema->fields[field].name));
}

static tn_status count_field(const tn_open_choices *c, uint32_t tray, uint32_t field, tn_named_bigs *to,
                             tn_error *error)
{
    uint32_t count = c->schema->fields[field].value_count;
    tn_status status = TN_NEW_LIST(named_big, to->values, count, error);
    to->name = name_of(c, field);
    for (uint32_t v = 0; status == TN_OK && v < count; v++) {
        mpz_set(to->values.items[v].value, c->found.counts[tn_open_choice_at(c, tray, field, v)]);
        to->values.items[v].name = spelling(c, field, v);
        status = to->name && to->values.items[v].name ? TN_OK : tn_fail_memory(error);
    }
    return status;
}

static tn_status count_tray(const tn_open_choices *c, uint32_t tray, tn_tray_choices *to, tn_error *error)
{
    uint32_t count = c->schema->field_count;
    tn_status status = TN_NEW_LIST(named_bigs, to->fields, count, error);
    for (uint32_t f = 0; status == TN_OK && f < count; f++)
        status = count_field(c, tray, f, &to->fields.items[f], error);
    return status;
}

/* Hands over why nothing completes it. */
static void give_why(tn_open_choices *c, bool *has_why, char **why)
{
    *has_why = c->why != NULL;
    *why = c->why;
    c->why = NULL;
}

static tn_status give_counts(tn_open_choices *c, tn_completed *to, tn_error *error)
{
    give_why(c, &to->has_why_none, &to->why_none);
    set_count(c, &to->has_plans, to->plans, &to->has_houses, to->houses, c->found.plans);
    tn_status status = TN_NEW_LIST(tray_choices, to->trays, c->found.trays, error);
    for (uint32_t t = 0; status == TN_OK && t < c->found.trays; t++)
        status = count_tray(c, t, &to->trays.items[t], error);
    return status;
}

/* ---- with a measure */

static void weigh_choice(const tn_open_choices *c, size_t at, tn_open_choice *to)
{
    set_count(c, &to->has_plans, to->plans, &to->has_houses, to->houses, c->found.counts[at]);
    to->has_best = c->found.best[at] != TN_NO_BEST;
    if (!to->has_best)
        return;
    mpq_set_si(to->best, c->found.best[at], 1);
    mpq_mul(to->best, to->best, c->step);
    tn_amount_convert(c->wishes.units[0], to->best);
}

static tn_status weigh_field(const tn_open_choices *c, uint32_t tray, uint32_t field, tn_named_choices *to,
                             tn_error *error)
{
    uint32_t count = c->schema->fields[field].value_count;
    tn_status status = TN_NEW_LIST(named_choice, to->values, count, error);
    to->name = name_of(c, field);
    for (uint32_t v = 0; status == TN_OK && v < count; v++) {
        weigh_choice(c, tn_open_choice_at(c, tray, field, v), &to->values.items[v].choice);
        to->values.items[v].name = spelling(c, field, v);
        status = to->name && to->values.items[v].name ? TN_OK : tn_fail_memory(error);
    }
    return status;
}

static tn_status weigh_tray(const tn_open_choices *c, uint32_t tray, tn_tray_weighed *to, tn_error *error)
{
    uint32_t count = c->schema->field_count;
    tn_status status = TN_NEW_LIST(named_choices, to->fields, count, error);
    for (uint32_t f = 0; status == TN_OK && f < count; f++)
        status = weigh_field(c, tray, f, &to->fields.items[f], error);
    return status;
}

static tn_status give_weighed(tn_open_choices *c, tn_completed_by *to, tn_error *error)
{
    give_why(c, &to->has_why_none, &to->why_none);
    set_count(c, &to->has_plans, to->plans, &to->has_houses, to->houses, c->found.plans);
    tn_status status = TN_NEW_LIST(tray_weighed, to->trays, c->found.trays, error);
    for (uint32_t t = 0; status == TN_OK && t < c->found.trays; t++)
        status = weigh_tray(c, t, &to->trays.items[t], error);
    return status;
}

/* Takes over the choices in any case. */
static tn_status give(tn_open_choices *c, tn_reply *answer, tn_error *error)
{
    bool weighed = c->wishes.count > 0;
    tn_status status = tn_reply_new(weighed ? &tn_message_completed_by : &tn_message_completed, answer, error);
    if (status != TN_OK) {
        free_choices(c);
        return status;
    }
    if (weighed) {
        tn_completed_by *to = answer->value;
        to->shown = (tn_boxed){c, free_choices};
        return give_weighed(c, to, error);
    }
    tn_completed *to = answer->value;
    to->shown = (tn_boxed){c, free_choices};
    return give_counts(c, to, error);
}

/* ---- asked */

static tn_open_choices *new_choices(const char *what)
{
    tn_open_choices *c = calloc(1, sizeof *c);
    if (!c)
        return NULL;
    c->what = what;
    mpq_init(c->step);
    return c;
}

/* What is left out of a plan in brackets has its first value, and may be anything in an open plan. */
static void note_brackets(tn_session *session, const tn_open_choices *c)
{
    tn_buffer line = {0};
    if (tn_plan_write_line(c->schema, c->spelled.plan.trays, c->spelled.plan.length, &line))
        tn_session_note(session,
                        "in brackets this is the one plan `%s`; without them, what is not written may have any value",
                        line.data ? line.data : "");
    free(line.data);
}

/* The trays that may stand at each place of the open plan that is asked about; c has its schema. */
static tn_status read_open(tn_session *session, const tn_complete_request *request, tn_open_choices *c)
{
    static const char name[] = "PATTERN";
    tn_spelled *w = &c->spelled;
    tn_error error;
    tn_status status =
        tn_spelled_read(session, c->schema, request->pattern, name, tn_asked_length(&request->subject), true, w);
    if (status == TN_OK && w->in_brackets)
        note_brackets(session, c);
    if (status == TN_OK)
        status = tn_spelled_open(session, c->schema, name, w);
    if (status != TN_OK)
        return status;
    c->trays = calloc(w->count + 1, sizeof *c->trays);
    if (!c->trays) {
        tn_fail_memory(&error);
        return tn_session_fail(session, &error);
    }
    for (size_t i = 0; i < w->count; i++)
        c->trays[i] =
            (tn_open_tray){.fits = w->fits + i * c->schema->tray_count, .gap = w->functions[i] == TN_NO_RECORD};
    c->open = (tn_open_plan){.trays = c->trays, .count = w->count};
    return TN_OK;
}

/* The trays of plans that complete it, by a measure or none. */
static tn_status find_plans(tn_open_choices *c, const tn_ready_library *ready, tn_error *error)
{
    const tn_library *library = ready->library;
    tn_buffer why = {0};
    tn_status status = c->wishes.count ? tn_weighed_new(library, c->wishes.measures, 1, &c->weighed, error) : TN_OK;
    if (status != TN_OK)
        return status;
    c->open.weighed = c->weighed;
    c->open.most = c->wishes.most[0];
    if (c->weighed)
        mpq_set(c->step, tn_weighed_unit(c->weighed, 0));
    status = tn_complete(&c->found, library, &c->open, error);
    if (status == TN_OK && mpz_sgn(c->found.plans) == 0)
        status = tn_open_why_none(ready, &c->open, &why, error);
    c->why = why.data;
    return status;
}

static tn_status complete_plans(tn_session *session, const tn_complete_request *request, tn_reply *answer)
{
    const tn_module *module = session->opened->module;
    const tn_ready_library *ready;
    tn_wishes wishes;
    tn_error error;
    tn_status status = tn_session_library(session, &request->subject, &ready);
    if (status == TN_OK)
        status = tn_wishes_of_plans(session, ready, request->by.items, request->by.count, 0, &wishes);
    if (status != TN_OK)
        return status;
    tn_open_choices *c = new_choices("plans");
    if (!c) {
        tn_fail_memory(&error);
        return tn_session_fail(session, &error);
    }
    c->schema = ready->schema;
    c->title = tn_text(module, ready->record->name);
    c->doc = tn_text(module, ready->record->doc);
    c->wishes = wishes;
    status = read_open(session, request, c);
    if (status != TN_OK) {
        free_choices(c);
        return status;
    }
    status = find_plans(c, ready, &error);
    if (status == TN_OK)
        status = give(c, answer, &error);
    else
        free_choices(c);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

/* A schema of its own: that of houses does not stay. */
static tn_status make_schema(tn_session *session, const char *library, tn_open_choices *c)
{
    const tn_module *module = session->opened->module;
    const tn_house_library_record *record = &module->HOUSE_LIBRARY_records[tn_house_library_find(module, library)];
    tn_error error;
    tn_status status = tn_schema_new(module, module->FORM_records[record->form].schema, 0, &c->own, &error);
    c->schema = c->own;
    c->title = tn_text(module, record->name);
    c->doc = tn_text(module, record->doc);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

/* Takes over the choices in any case. */
static tn_status give_houses(const tn_houses_search *search, tn_open_choices *c, tn_reply *answer)
{
    tn_error error;
    c->wishes = search->found;
    c->open.most = c->wishes.most[0];
    if (c->wishes.count)
        mpq_set(c->step, search->weights[0]->shown);
    tn_status status = tn_houses_complete(search->houses, &c->open, &c->found, &error);
    if (status == TN_OK)
        status = give(c, answer, &error);
    else
        free_choices(c);
    return status == TN_OK ? TN_OK : tn_session_fail(search->n.session, &error);
}

static tn_status search_houses(tn_session *session, const tn_complete_request *request, tn_open_choices *c,
                               tn_reply *answer)
{
    const tn_house_asked asked = {.subject = &request->subject,
                                  .aim = TN_HOUSES_COMPLETE,
                                  .by = request->by.items,
                                  .by_count = request->by.count};
    tn_houses_search search;
    tn_status status = tn_houses_search_begin(&search, session, &asked);
    if (status == TN_OK)
        status = give_houses(&search, c, answer);
    else
        free_choices(c);
    tn_houses_search_end(&search);
    return status;
}

static tn_status complete_houses(tn_session *session, const tn_complete_request *request, tn_reply *answer)
{
    tn_error error;
    tn_open_choices *c = new_choices("houses");
    if (!c) {
        tn_fail_memory(&error);
        return tn_session_fail(session, &error);
    }
    tn_status status = make_schema(session, request->subject.library, c);
    if (status == TN_OK)
        status = read_open(session, request, c);
    if (status == TN_OK)
        return search_houses(session, request, c, answer);
    free_choices(c);
    return status;
}

static tn_status draw(tn_session *session, const tn_answer_picture *asked, const tn_reply *answer)
{
    tn_completed *counted = TN_REPLY(completed, answer);
    tn_completed_by *weighed = TN_REPLY(completed_by, answer);
    tn_picture to = tn_answer_picture_begin(asked);
    tn_error error;
    tn_status status = tn_open_choices_draw(counted ? counted->shown.value : weighed->shown.value, &to, &error);
    return tn_answer_picture_give(session, asked, &to, status, &error,
                                  counted ? (tn_list *)&counted->files : (tn_list *)&weighed->files,
                                  counted ? &counted->has_files : &weighed->has_files);
}

tn_status tn_ask_complete(tn_session *session, const tn_complete_request *request, tn_reply *answer)
{
    *answer = (tn_reply){0};
    if (request->by.count > 1)
        return tn_session_refuse(session, NULL, "complete looks at one measure: give one --least or --most");
    bool houses = tn_session_of_houses(session, &request->subject);
    tn_status status = (houses ? complete_houses : complete_plans)(session, request, answer);
    return status == TN_OK && tn_answer_has_picture(&request->drawn) ? draw(session, &request->drawn, answer) : status;
}
