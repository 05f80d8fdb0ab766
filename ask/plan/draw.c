/* draw: plans, rules, houses or a form in space as a picture. */
#include "ask/plan/draw.h"

#include "ask/form/form.h"
#include "ask/session/questions.h"
#include "driver/house/judge.h"
#include "runtime/plan/picture/draw.h"

/* ---- what goes together */

static bool is_sampled(const tn_draw_request *request)
{
    return request->has_sample || request->has_per_length;
}

static bool of_houses(const tn_session *session, const tn_draw_request *r)
{
    return r->plan ||
           (r->subject.library && tn_house_library_find(session->opened->module, r->subject.library) != TN_NO_RECORD);
}

static tn_status check_best(tn_session *session, const tn_draw_request *r)
{
    size_t most = r->has_max_plans ? (size_t)r->max_plans : TN_DRAW_PLANS_DEFAULT;
    if (r->has_best && (is_sampled(r) || r->rules.count || r->from))
        return tn_session_refuse(
            session, NULL,
            "--best draws the best plans of a library: give it without --sample, --rule and a file of plans");
    if (r->has_best && r->best > most && !of_houses(session, r))
        return tn_session_refuse(session, "ask for fewer, or raise the limit with --max-plans",
                                 "a picture shows at most %zu plans", most);
    if (r->front && (r->has_best || is_sampled(r) || r->rules.count || r->from))
        return tn_session_refuse(session, NULL, "the front is drawn alone, without a sample, the best and rules");
    if (r->plan && !r->has_best && !r->front)
        return tn_session_refuse(session, NULL, "`plan` says which houses are best: give `best` or `front` too");
    if (!r->has_best && !r->front && (r->by.count || r->mirror))
        return tn_session_refuse(session, NULL,
                                 "--least, --most and --mirror say which plans are best: give --best N too");
    return TN_OK;
}

static tn_status check_plans(tn_session *session, const tn_draw_request *r)
{
    if (r->rules.count && (is_sampled(r) || r->from))
        return tn_session_refuse(session, NULL, "draw either rules or plans, not both");
    if (is_sampled(r) && r->from)
        return tn_session_refuse(session, NULL, "draw either a file of plans or a --sample, not both");
    if (!is_sampled(r) && (r->has_seed || r->has_length || r->diverse))
        return tn_session_refuse(session, NULL,
                                 "--seed, --length and --diverse say what is sampled: give --sample N too");
    if (!is_sampled(r) && !r->has_best && !r->front && r->subject.has_trays)
        return tn_session_refuse(
            session, NULL, "--trays says which plans are taken from the library: give --sample N or --best N too");
    return check_best(session, r);
}

/* What says something about one or two of the subjects only. */
static tn_status check_uses(tn_session *session, const tn_draw_request *r)
{
    bool houses = of_houses(session, r);
    const tn_asked_use uses[] = {
        {r->rules.count > 0, TN_OF_PLANS, "rule"},
        {r->subject.library != NULL, TN_OF_PLANS, "library"},
        {r->has_sample, TN_OF_PLANS, "sample"},
        {r->has_best, TN_OF_PLANS, "best"},
        {r->has_per_length, TN_OF_PLANS, "per-length"},
        {r->paper != NULL, TN_OF_PLANS, "paper"},
        {r->has_scale, TN_OF_PLANS, "scale"},
        {r->has_max_plans, TN_OF_PLANS, "max-plans"},
        {r->has_columns, TN_OF_PLANS | TN_OF_SOLIDS, "columns"},
        {r->solid.solid != NULL, TN_OF_SOLIDS, "solid"},
        {r->show == TN_DRAW_SHEET, TN_OF_SOLIDS, "sheet"},
        {r->show == TN_DRAW_BEFORE, TN_OF_SOLIDS, "before"},
        {r->show == TN_DRAW_EXPLODED, TN_OF_SOLIDS, "exploded"},
        {r->show == TN_DRAW_HISTORY, TN_OF_SOLIDS, "show"},
        {r->solid.has_max_boxes, TN_OF_SOLIDS, "max-boxes"},
        {r->has_azimuth && !houses, TN_OF_SOLIDS | TN_OF_FIELDS, "azimuth"},
        {r->has_elevation && !houses, TN_OF_SOLIDS | TN_OF_FIELDS, "elevation"},
        {r->has_width, TN_OF_SOLIDS | TN_OF_FIELDS, "width"},
        {r->surface != NULL, TN_OF_FIELDS, "surface"},
        {r->has_grid, TN_OF_FIELDS, "grid"},
        {r->sharp, TN_OF_FIELDS, "sharp"},
        {r->open, TN_OF_FIELDS, "open"},
    };
    return tn_session_check_uses(session, uses, sizeof uses / sizeof *uses);
}

tn_status tn_draw_check(tn_session *session, const tn_draw_request *request)
{
    tn_status status = check_plans(session, request);
    return status == TN_OK ? check_uses(session, request) : status;
}

/* ---- asked */

static tn_status draw(tn_session *session, const tn_draw_request *request, tn_drawn_picture *made)
{
    switch (tn_subject_of(session->opened->module)) {
    case TN_SUBJECT_SOLID:
    case TN_SUBJECT_FIELD:
        return tn_draw_form(session, request, made);
    default:
        return of_houses(session, request) ? tn_draw_houses(session, request, made)
               : request->rules.count      ? tn_draw_rules(session, request, made)
                                           : tn_draw_plans(session, request, made);
    }
}

tn_status tn_ask_draw(tn_session *session, const tn_draw_request *request, tn_reply *answer)
{
    tn_error error;
    *answer = (tn_reply){0};
    tn_status status = tn_draw_check(session, request);
    if (status != TN_OK)
        return status;
    if (tn_reply_new(&tn_message_drawn_picture, answer, &error) != TN_OK)
        return tn_session_fail(session, &error);
    return draw(session, request, answer->value);
}
