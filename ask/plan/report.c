/* report: a library of plans or of houses, or a kit, as an HTML page. */
#include <stdlib.h>

#include "ask/house/reported.h"
#include "ask/session/made.h"
#include "ask/session/questions.h"
#include "driver/house/analysis.h"
#include "driver/house/judge.h"
#include "driver/report/kit_report.h"
#include "driver/report/report.h"
#include "runtime/base/array.h"
#include "runtime/plan/library/alone.h"

#define SAMPLES_DEFAULT 24
#define HOUSES_DEFAULT 6

typedef struct reporting {
    tn_session *session;
    const tn_report_request *request;
    tn_made_report *made;
    tn_buffer page;
} reporting;

/* Makes the page and writes it. The file is begun before the work, so that what it lacks is told first. */
static tn_status write_page(reporting *r, tn_status (*make)(reporting *r))
{
    tn_making making;
    tn_error error;
    tn_made_file *file = TN_ADD(made_file, r->made->files, &error);
    if (!file || tn_making_begin(&making, r->session, TN_FILE_HTML, NULL, file, &error) != TN_OK)
        return tn_session_fail(r->session, &error);
    tn_status status = make(r);
    if (status == TN_OK)
        fwrite(r->page.data, 1, r->page.size, making.stream);
    tn_status ended = tn_making_end(&making, status, &error);
    return status == TN_OK && ended != TN_OK ? tn_session_fail(r->session, &error) : status;
}

/* ---- plans */

static tn_status report_plans(reporting *r, const tn_ready_library *ready, const tn_plan_analyses *analyses)
{
    tn_opened *opened = r->session->opened;
    uint32_t max_states = (uint32_t)r->request->subject.max_states;
    const tn_report_options options = {.seed = r->request->seed,
                                       .samples = r->request->has_sample ? (size_t)r->request->sample : SAMPLES_DEFAULT,
                                       .max_states = max_states};
    const tn_coverage_options coverage = {.library = tn_text(opened->module, ready->record->name),
                                          .max_states = max_states,
                                          .automaton = ready->library,
                                          .imported = true};
    tn_covered covered = {0};
    tn_error error;
    tn_status status = tn_coverage_measure(opened, &coverage, &covered);
    if (status == TN_OK && tn_report_page(opened, ready, analyses, &covered, &options, &r->page, &error) != TN_OK)
        status = tn_session_fail(r->session, &error);
    tn_covered_clear(&covered);
    return status;
}

static tn_status find_alone(reporting *r, const tn_ready_library *ready)
{
    tn_error error;
    return tn_library_find_alone(ready->library, &error) == TN_OK ? TN_OK : tn_session_fail(r->session, &error);
}

/* The library is ready: that was found out before the file was begun. */
static tn_status make_plans(reporting *r)
{
    const tn_library_asked *asked = &r->request->subject;
    const tn_ready_library *ready;
    tn_plan_analyses analyses = {0};
    tn_status status = tn_session_library(r->session, asked, &ready);
    if (status != TN_OK)
        return status;
    const tn_plan_analysis_options options = {
        .max_states = (uint32_t)asked->max_states, .library = ready->library, .threads = tn_asked_threads(asked)};
    tn_session_begins(r->session, "clauses and rules measured"); /* as one: what it warns of has to be on the page */
    status = find_alone(r, ready);
    if (status == TN_OK)
        status = tn_plan_analyse(r->session->opened, &options, &analyses);
    if (status == TN_OK)
        status = report_plans(r, ready, &analyses);
    tn_session_ends(r->session);
    tn_plan_analyses_free(&analyses);
    return status;
}

/* ---- houses */

static tn_status make_houses(reporting *r)
{
    const tn_library_asked *asked = &r->request->subject;
    const tn_plan_analysis_options options = {.max_states = (uint32_t)asked->max_states,
                                              .threads = tn_asked_threads(asked)};
    const tn_reported wanted = {.sample = r->request->has_sample ? r->request->sample : HOUSES_DEFAULT,
                                .seed = r->request->seed};
    tn_plan_analyses analyses = {0};
    tn_status status = tn_plan_analyse(r->session->opened, &options, &analyses); /* its warnings are on the page */
    if (status == TN_OK)
        status = tn_house_analyse(r->session->opened, options.max_states);
    if (status == TN_OK)
        status = tn_report_houses(r->session, asked, &wanted, &r->page);
    tn_plan_analyses_free(&analyses);
    return status;
}

static tn_status make_given(reporting *r)
{
    return tn_report_given_houses(r->session, &r->request->subject, r->request->houses.items, r->request->houses.count,
                                  &r->page);
}

/* Is the library that is named one of houses; or, where none is, is all that the file itself has one of these? */
static bool is_about_houses(const reporting *r)
{
    const tn_module *module = r->session->opened->module;
    const char *name = r->request->subject.library;
    bool plans = false;
    for (uint32_t i = 0; i < module->LIBRARY_count; i++)
        plans = plans || !(module->LIBRARY_records[i].flags & TN_IMPORTED);
    return (name || !plans) && tn_house_library_find(module, name) != TN_NO_RECORD;
}

static tn_status report_library(reporting *r)
{
    const tn_ready_library *ready;
    size_t given = r->request->houses.count;
    if (given > TN_REPORTED_HOUSES_MAX)
        return tn_session_refuse(r->session, NULL, "a report shows at most %u houses side by side, not %zu",
                                 TN_REPORTED_HOUSES_MAX, given);
    if (given > 0 && r->request->has_sample)
        return tn_session_refuse(r->session, "leave out one of them",
                                 "--sample draws houses for a report, and it is to show those that are given");
    if (given > 0)
        return write_page(r, make_given);
    if (is_about_houses(r))
        return write_page(r, make_houses);
    tn_status status = tn_session_library(r->session, &r->request->subject, &ready);
    return status == TN_OK ? write_page(r, make_plans) : status;
}

/* ---- kits */

static void note_models(const reporting *r, const tn_kit_report_tally *tally)
{
    if (tally->unplaced)
        tn_session_note(r->session, "%zu of %zu model%s could not be placed to the end: the page says why",
                        tally->unplaced, tally->models, tally->models == 1 ? "" : "s");
    if (tally->unmet)
        tn_session_note(r->session, "%zu requirement%s of models do%s not hold: the page says which", tally->unmet,
                        tally->unmet == 1 ? "" : "s", tally->unmet == 1 ? "es" : "");
}

static tn_status make_kit(reporting *r)
{
    const tn_report_request *request = r->request;
    const tn_kit_report_options options = {.seed = (uint32_t)request->seed,
                                           .pictures = tn_as_size(request->pictures),
                                           .part_limit = request->part_limit,
                                           .step_limit = request->step_limit,
                                           .search_limit = request->search_limit,
                                           .watch = r->session->opened->module->watch};
    tn_kit_report_tally tally;
    tn_error error;
    tn_status status = tn_kit_report_page(r->session->opened, &options, &r->page, &tally, &error);
    if (status != TN_OK)
        return tn_session_fail(r->session, &error);
    r->made->has_models = r->made->has_unplaced = r->made->has_unmet = true;
    r->made->models = tally.models;
    r->made->unplaced = tally.unplaced;
    r->made->unmet = tally.unmet;
    note_models(r, &tally);
    return TN_OK;
}

static tn_status report_kit(reporting *r)
{
    if (r->request->seed > UINT32_MAX)
        return tn_session_refuse(r->session, NULL, "the --seed of a kit is at most %u", (unsigned)UINT32_MAX);
    return write_page(r, make_kit);
}

/* ---- asked */

/* The first that is asked for and about a kit, or about anything else. */
static const char *asked_for(const tn_report_request *request, bool of_kit)
{
    const tn_library_asked *subject = &request->subject;
    const struct {
        const char *name;
        bool given, of_kit;
    } all[] = {{"library", subject->library != NULL, false},   {"where", subject->where.count > 0, false},
               {"trays", subject->has_trays, false},           {"max-length", subject->has_max_length, false},
               {"sample", request->has_sample, false},         {"houses", request->houses.count > 0, false},
               {"max-states", subject->has_max_states, false}, {"threads", subject->has_threads, false},
               {"pictures", request->has_pictures, true},      {"part-limit", request->has_part_limit, true},
               {"step-limit", request->has_step_limit, true},  {"search-limit", request->has_search_limit, true}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (all[i].given && all[i].of_kit == of_kit)
            return all[i].name;
    return NULL;
}

/* Refuses a file with neither a library nor a kit, nor anything that could have become one, and what is asked for that
 * is not about the file. */
static tn_status check(tn_session *session, const tn_report_request *request)
{
    const tn_opened *opened = session->opened;
    const tn_module *module = opened->module;
    bool kit = module->KIT_count > 0;
    const char *name = asked_for(request, !kit);
    tn_error error;
    if (!kit && !module->LIBRARY_count && !module->SCHEMA_count) {
        tn_fail(&error, TN_INVALID, E_NOT_IN_FILE, "%.200s has neither a library nor a kit to show", opened->path);
        tn_error_help(&error, "report takes .plan files with a library, and .kit files; %s",
                      tn_opened_help(opened, "this file holds neither").text);
        return tn_session_fail(session, &error);
    }
    return name ? tn_session_refuse(session, NULL, "--%s is about %s, and %.200s is %s", name,
                                    kit ? "a library of plans" : "a kit", opened->path, kit ? "a kit" : "none")
                : TN_OK;
}

tn_status tn_ask_report(tn_session *session, const tn_report_request *request, tn_reply *answer)
{
    tn_error error;
    *answer = (tn_reply){0};
    tn_status status = check(session, request);
    if (status != TN_OK)
        return status;
    if (tn_reply_new(&tn_message_made_report, answer, &error) != TN_OK)
        return tn_session_fail(session, &error);
    reporting r = {.session = session, .request = request, .made = answer->value};
    status = session->opened->module->KIT_count ? report_kit(&r) : report_library(&r);
    free(r.page.data);
    return status;
}
