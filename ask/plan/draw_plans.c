/* Draws sheets of plans, those of a request or of a library, and pictures of rules. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "ask/plan/best.h"
#include "ask/plan/draw.h"
#include "ask/plan/sheet.h"
#include "ask/session/questions.h"
#include "driver/measure/front.h"
#include "driver/open/digits.h"
#include "runtime/plan/picture/draw_rule.h"

enum { NOTE_COUNT = 3, NOTE_SIZE = 256 };

/* A sheet being made. */
typedef struct sheet {
    tn_session *session;
    const tn_draw_request *request;
    tn_drawn_picture *made;
    const tn_schema *schema;
    const tn_library_record *library; /* or NULL */
    const tn_ready_library *ready;    /* of plans that it was asked for */
    tn_wishes wishes;                 /* of the best ones */
    tn_plan_sheet drawn;
    tn_status taken; /* what taking a plan came to, with its error */
    tn_error error;
    bool ranked; /* numbers are ranks, not lines */
    char notes[NOTE_COUNT][NOTE_SIZE];
    size_t note_count;
} sheet;

static tn_status draw_sheet(sheet *s)
{
    const tn_draw_request *request = s->request;
    const tn_module *module = s->session->opened->module;
    const char *notes[NOTE_COUNT];
    tn_picture to = tn_picture_asked(tn_draw_format(request));
    tn_error error;
    tn_sheet_note_rules(s->session->opened, s->notes[s->note_count++], NOTE_SIZE);
    for (size_t i = 0; i < s->note_count; i++)
        notes[i] = s->notes[i];
    tn_string name = s->library ? s->library->name : s->schema->record->name,
              doc = s->library ? s->library->doc : s->schema->record->doc;
    const tn_draw_options options = {.title = request->title ? request->title : tn_text(module, name),
                                     .doc = doc ? tn_text(module, doc) : NULL,
                                     .number_name = s->ranked ? "rank" : "line",
                                     .notes = notes,
                                     .note_count = s->note_count,
                                     .paper = request->paper,
                                     .scale = (uint32_t)request->scale,
                                     .columns = (uint32_t)request->columns,
                                     .dpi = (uint32_t)request->dpi,
                                     .max_plans =
                                         request->has_max_plans ? (size_t)request->max_plans : TN_DRAW_PLANS_DEFAULT};
    tn_status status = tn_plans_draw(s->schema, s->drawn.plans, s->drawn.count, &options, &to, &error);
    return tn_draw_give(s->session, request, &to, status, &error, s->made);
}

/* ---- plans that the request has */

static tn_status add_given(sheet *s, size_t i)
{
    const tn_given_plan *given = &s->request->plans.items[i];
    char place[24];
    tn_plan plan = {0};
    tn_error error;
    tn_status status =
        tn_session_plan_line(s->session, s->schema, given->plan, tn_asked_length(&s->request->subject), &plan);
    snprintf(place, sizeof place, "%zu", i + 1);
    if (status == TN_OK && tn_sheet_add(&s->drawn, plan.trays, plan.length,
                                        strdup(given->number ? given->number : place), NULL, NULL, &error) != TN_OK)
        status = tn_session_fail(s->session, &error);
    free(plan.trays);
    return status;
}

static tn_status draw_given(sheet *s)
{
    const tn_draw_request *request = s->request;
    size_t count = request->plans.count;
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < count; i++)
        status = add_given(s, i);
    snprintf(s->notes[s->note_count++], NOTE_SIZE, "%zu plan%s%s%s", count, count == 1 ? "" : "s",
             request->from ? " from " : "", request->from ? request->from : "");
    s->ranked = request->ranked;
    return status == TN_OK ? draw_sheet(s) : status;
}

static tn_status choose_given(sheet *s)
{
    const tn_module *module = s->session->opened->module;
    tn_schema *schema;
    uint32_t index, library = UINT32_MAX;
    tn_error error;
    tn_status status = tn_schema_choose(s->session->opened, s->request->subject.library, &index, &library);
    if (status != TN_OK)
        return status;
    if (tn_schema_new(module, index, 0, &schema, &error) != TN_OK)
        return tn_session_fail(s->session, &error);
    s->schema = schema;
    s->library = library != UINT32_MAX ? &module->LIBRARY_records[library] : NULL;
    status = draw_given(s);
    tn_schema_free(schema);
    return status;
}

/* ---- plans that the library is asked for */

static bool begins(void *context, tn_found_of *of)
{
    sheet *s = context;
    s->ready = of->plans;
    s->schema = of->plans->schema;
    s->library = of->plans->record;
    s->ranked = true;
    if (of->wishes)
        s->wishes = *of->wishes;
    return true;
}

/* "3.  cost 87,880, area 304 ft2"; NULL: out of memory. */
static char *caption_of(const sheet *s, const tn_found_one *found)
{
    tn_buffer caption = {0};
    bool ok = tn_buffer_printf(&caption, "%zu.  ", s->drawn.count + 1);
    for (uint32_t k = 0; ok && k < s->wishes.count; k++)
        ok = tn_buffer_printf(&caption, "%s%s ", k ? ", " : "", s->wishes.names[k]) &&
             tn_amount_write(s->wishes.units[k], found->values[k], &caption);
    if (ok)
        return caption.data;
    free(caption.data);
    return NULL;
}

static bool takes(void *context, const tn_found_one *found)
{
    sheet *s = context;
    char *caption = s->wishes.count ? caption_of(s, found) : NULL;
    if (s->wishes.count && !caption)
        s->taken = tn_fail_memory(&s->error);
    else
        s->taken = tn_sheet_add(&s->drawn, found->trays, found->length, mpz_get_str(NULL, 10, found->rank), NULL,
                                caption, &s->error);
    return s->taken == TN_OK;
}

/* How many plans the library keeps (malloc); NULL: out of memory. */
static char *kept_digits(const sheet *s)
{
    mpz_t kept;
    mpz_init(kept);
    tn_library_kept(s->ready->library, TN_ALL_LENGTHS, kept);
    char *digits = tn_digits(kept, true);
    mpz_clear(kept);
    return digits;
}

static void note_library(sheet *s)
{
    char hash[33];
    tn_library_hash(s->ready->library, hash);
    snprintf(s->notes[s->note_count++], NOTE_SIZE, "library %s", hash);
}

static tn_status find_sample(sheet *s, tn_reply *found)
{
    const tn_draw_request *r = s->request;
    const tn_sample_request request = {.subject = r->subject,
                                       .has_count = r->has_sample,
                                       .count = r->sample,
                                       .seed = r->seed,
                                       .has_length = r->has_length,
                                       .length = r->length,
                                       .has_per_length = r->has_per_length,
                                       .per_length = r->per_length,
                                       .diverse = r->diverse,
                                       .uniform = true};
    return tn_ask_sample(s->session, &request, found);
}

static tn_status find_best(sheet *s, tn_reply *found)
{
    const tn_draw_request *r = s->request;
    const tn_best_request request = {.subject = r->subject,
                                     .by = {r->by.items, r->by.count},
                                     .has_count = true,
                                     .count = r->best,
                                     .mirror = r->mirror};
    return tn_ask_best(s->session, &request, found);
}

/* "24 of 5,000 plans, drawn with seed 0"; "the 10 of 5,000 plans with the least cost, then the most area" */
static tn_status note_found(sheet *s)
{
    const tn_wishes *wishes = &s->wishes;
    char *digits = kept_digits(s);
    tn_buffer text = {0};
    bool best = s->request->has_best, ok = digits != NULL;
    if (ok)
        ok = best ? tn_buffer_printf(&text, "the %zu of %s plans with the ", s->drawn.count, digits)
                  : tn_buffer_printf(&text, "%zu of %s plans, drawn with seed %" PRIu64, s->drawn.count, digits,
                                     s->request->seed);
    for (uint32_t k = 0; ok && best && k < wishes->count; k++)
        ok = tn_buffer_printf(&text, "%s%s %s", k ? ", then the " : "", wishes->most[k] ? "most" : "least",
                              wishes->names[k]);
    if (ok)
        snprintf(s->notes[s->note_count++], NOTE_SIZE, "%s", text.data);
    free(text.data);
    free(digits);
    return ok ? TN_OK : tn_fail_memory(&s->error);
}

static tn_status draw_library(sheet *s)
{
    const tn_taker taker = {begins, takes, s}, *before = s->session->taker;
    tn_reply found;
    s->session->taker = &taker;
    tn_status status = s->request->has_best ? find_best(s, &found) : find_sample(s, &found);
    s->session->taker = before;
    tn_reply_clear(&found);
    if (status != TN_OK || !s->ready)
        return status;
    status = s->taken == TN_OK ? note_found(s) : s->taken;
    if (status != TN_OK)
        return tn_session_fail(s->session, &s->error);
    note_library(s);
    return draw_sheet(s);
}

/* ---- the best trade-offs */

static tn_status draw_front(tn_session *session, const tn_draw_request *request, tn_drawn_picture *made)
{
    const tn_pareto_request asked = {.subject = request->subject, .by = {request->by.items, request->by.count}};
    tn_picture to = tn_picture_asked(tn_draw_format(request));
    tn_reply found;
    tn_error error;
    tn_status status = tn_ask_pareto(session, &asked, &found);
    if (status == TN_OK) {
        const tn_plan_front *f = ((tn_found_front *)found.value)->shown.value;
        const tn_shown_front shown = {f->ready,       f->wishes.count, f->wishes.measures,
                                      f->wishes.most, f->weighed,      &f->front};
        to.dpi = (uint32_t)request->dpi;
        status = tn_draw_give(session, request, &to, tn_front_picture(&shown, &to, &error), &error, made);
    }
    tn_reply_clear(&found);
    return status;
}

/* ---- asked */

tn_status tn_draw_plans(tn_session *session, const tn_draw_request *request, tn_drawn_picture *made)
{
    sheet s = {.session = session, .request = request, .made = made};
    bool from_library = request->has_sample || request->has_per_length || request->has_best;
    if (request->front)
        return draw_front(session, request, made);
    if (!from_library && !request->from && request->plans.count == 0)
        return tn_session_refuse(session, NULL, "say what is drawn: plans, rules, a sample or the best");
    tn_status status = from_library ? draw_library(&s) : choose_given(&s);
    tn_sheet_clear(&s.drawn);
    return status;
}

/* ---- rules */

/* Finds the rules, and the schema that they are about. */
static tn_status find_rules(tn_session *session, const tn_texts *names, tn_drawn_rule *rules, uint32_t *trays)
{
    const tn_module *module = session->opened->module;
    for (size_t i = 0; i < names->count; i++) {
        uint32_t rule;
        tn_status status = tn_rule_choose(session->opened, names->items[i], &rule);
        if (status != TN_OK)
            return status;
        rules[i] = tn_drawn_rule_of(module, rule);
        if (i > 0 && module->RULE_records[rule].schema != *trays)
            return tn_session_refuse(session, NULL, "the rules of one picture are about the same trays");
        *trays = module->RULE_records[rule].schema;
    }
    return TN_OK;
}

static tn_status draw_rules(tn_session *session, const tn_draw_request *request, const tn_drawn_rule *rules,
                            uint32_t trays, tn_drawn_picture *made)
{
    tn_picture to = tn_picture_asked(tn_draw_format(request));
    tn_schema *schema = NULL;
    tn_error error;
    to.dpi = (uint32_t)request->dpi;
    tn_status status = tn_schema_new(session->opened->module, trays, 0, &schema, &error);
    if (status == TN_OK)
        status = tn_rules_draw(schema, rules, request->rules.count, &to, &error);
    tn_schema_free(schema);
    return tn_draw_give(session, request, &to, status, &error, made);
}

tn_status tn_draw_rules(tn_session *session, const tn_draw_request *request, tn_drawn_picture *made)
{
    tn_drawn_rule *rules = malloc(sizeof *rules * (request->rules.count + 1));
    uint32_t trays = 0;
    tn_error error;
    if (!rules) {
        tn_fail_memory(&error);
        return tn_session_fail(session, &error);
    }
    tn_status status = find_rules(session, &request->rules, rules, &trays);
    if (status == TN_OK)
        status = draw_rules(session, request, rules, trays, made);
    free(rules);
    return status;
}
