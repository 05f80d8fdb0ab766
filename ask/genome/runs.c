/* runs, individual, change_run: runs of evolution that were made, each a folder with its database. */
#include <stdlib.h>
#include <string.h>

#include "ask/genome/evolve.h"
#include "ask/session/questions.h"
#include "driver/breed/evolve.h"

/* ---- what a run's database says of it */

static tn_status put_generations(tn_run_store *store, tn_run_told *told, tn_error *error)
{
    tn_generation_stats *stats = NULL;
    size_t count = 0;
    tn_status status = tn_run_store_stats(store, &stats, &count, error);
    if (status == TN_OK)
        status = TN_NEW_LIST(run_generation, told->generations, count, error);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        tn_generation_put(&stats[i], &told->generations.items[i]);
    told->has_best_first_at = status == TN_OK && count > 0;
    size_t first = 0;
    while (told->has_best_first_at && first + 1 < count && stats[first].best[0] > stats[count - 1].best[0])
        first++;
    if (told->has_best_first_at)
        told->best_first_at = stats[first].generation;
    free(stats);
    return status;
}

/* Takes the texts of the events. */
static tn_status put_events(tn_run_store *store, tn_run_told *told, tn_error *error)
{
    tn_run_event *events = NULL;
    size_t count = 0;
    tn_status status = tn_run_store_events(store, &events, &count, error);
    if (status == TN_OK)
        status = TN_NEW_LIST(told_event, told->events, count, error);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        told->events.items[i] = (tn_told_event){events[i].generation, events[i].kind, events[i].text};
        events[i].kind = events[i].text = NULL;
    }
    tn_run_events_free(events, count);
    return status;
}

static tn_status tell_run(const char *dir, tn_run_told *told, tn_error *error)
{
    tn_run_store *store = NULL;
    char *path = tn_run_database(dir);
    told->run = dir;
    tn_status status = path ? tn_run_store_open(path, false, true, &store, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_run_store_get_meta(store, "identity", &told->settings, error);
    told->has_settings = told->settings != NULL;
    if (status == TN_OK)
        status = put_generations(store, told, error);
    if (status == TN_OK)
        status = put_events(store, told, error);
    tn_run_store_free(store);
    free(path);
    return status;
}

tn_status tn_ask_runs(tn_session *session, const tn_runs_request *request, tn_reply *answer)
{
    tn_error error;
    *answer = (tn_reply){0};
    tn_status status = tn_reply_new(&tn_message_runs_told, answer, &error);
    tn_runs_told *told = answer->value;
    if (status == TN_OK)
        status = TN_NEW_LIST(run_told, told->runs, request->runs.count, &error);
    for (size_t i = 0; status == TN_OK && i < request->runs.count; i++)
        status = tell_run(request->runs.items[i], &told->runs.items[i], &error);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

/* ---- an individual */

tn_status tn_ask_individual(tn_session *session, const tn_individual_request *request, tn_reply *answer)
{
    tn_evolution_job evolved = {0};
    tn_run run = {0};
    tn_opened opened = {0};
    const tn_individual *individual;
    tn_error error = {0};
    *answer = (tn_reply){0};
    tn_status status = tn_run_replay(request->run, request->individual, &opened, &evolved, &run, &individual, &error);
    if (status == TN_OK)
        status = tn_reply_new(&tn_message_individual_told, answer, &error);
    if (status == TN_OK)
        status = tn_individual_put(individual, answer->value, &error);
    if (status != TN_OK)
        tn_session_fail(session, &error);
    tn_run_clear(&run);
    tn_evolution_job_clear(&evolved);
    tn_close(&opened);
    return status;
}

/* ---- what is left for a run that goes on later */

static tn_status leave(tn_session *session, const tn_change_run_request *request, tn_run_event *left)
{
    tn_evolution_job evolved = {0};
    tn_run run = {0};
    tn_opened opened = {0};
    tn_error error = {0};
    char *sentence = NULL;
    const char *kind = request->has_remove ? "remove" : request->has_in_place_of ? "edit" : "insert";
    uint64_t member = request->has_remove        ? request->remove
                      : request->has_in_place_of ? request->in_place_of
                                                 : TN_NO_PARENT;
    tn_status status = tn_run_leave(request->run, kind, request->has_remove ? NULL : request->sentence, member, &opened,
                                    &evolved, &run, left, &sentence, &error);
    if (status != TN_OK && sentence && error.line)
        tn_report_error(&session->opened->compilation.diagnostics, &error, request->file ? request->file : "sentence",
                        sentence, strlen(sentence));
    else if (status != TN_OK)
        tn_session_fail(session, &error);
    free(sentence);
    tn_run_clear(&run);
    tn_evolution_job_clear(&evolved);
    tn_close(&opened);
    return status;
}

tn_status tn_ask_change_run(tn_session *session, const tn_change_run_request *request, tn_reply *answer)
{
    tn_run_event left = {0};
    tn_error error;
    *answer = (tn_reply){0};
    if ((request->sentence != NULL) == request->has_remove || (request->has_in_place_of && request->has_remove))
        return tn_session_refuse(session, NULL,
                                 "say what is changed: a sentence that is inserted, or a member that is taken out");
    if (tn_reply_new(&tn_message_told_event, answer, &error) != TN_OK)
        return tn_session_fail(session, &error);
    tn_status status = leave(session, request, &left);
    *(tn_told_event *)answer->value = (tn_told_event){left.generation, left.kind, left.text};
    return status;
}
