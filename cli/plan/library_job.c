/* Opens the library that a command line names, within the limits of its options. */
#include "cli/plan/library_job.h"

#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "cli/common/progress.h"
#include "driver/house/judge.h"
#include "driver/open/digits.h"

/* ---- measures to make small or great */

bool tn_job_wishes(tn_job *job, const tn_option_list *list, uint32_t least, tn_wished *wished)
{
    tn_diagnostics *diagnostics = tn_job_diagnostics(job);
    *wished = (tn_wished){0};
    if (list->count / 2 < least || list->count / 2 > TN_WEIGHED_MAX) {
        tn_help(diagnostics,
                tn_job_usage(job, "%s measures to go by: %u to %d are needed",
                             list->count / 2 < least ? "too few" : "too many", least, TN_WEIGHED_MAX),
                "name them with --least MEASURE or --most MEASURE");
        return false;
    }
    for (size_t i = 0; i + 1 < list->count; i += 2) {
        bool then = strncmp(list->items[i], "then-", 5) == 0;
        if (then != (i > 0 && least == 1)) {
            tn_help(diagnostics, tn_job_usage(job, then ? "--%s is first" : "--%s is not the first", list->items[i]),
                    "the first measure is told by --least or --most, the next by --then-least or --then-most");
            return false;
        }
        wished->items[wished->count++] =
            (tn_wish){.measure = list->items[i + 1], .most = strstr(list->items[i], "most") != NULL};
    }
    return true;
}

/* ---- the library */

unsigned tn_job_threads(const tn_plan_settings *plans)
{
    const tn_library_asked asked = tn_job_asked(plans);
    return tn_asked_threads(&asked);
}

size_t tn_job_max_length(const tn_plan_settings *plans)
{
    const tn_library_asked asked = tn_job_asked(plans);
    return tn_asked_length(&asked);
}

bool tn_job_open_plans(tn_job *job, const char *path, const tn_plan_settings *plans)
{
    const tn_questions questions = {
        .library = plans->library, .wheres = plans->wheres.items, .where_count = plans->wheres.count};
    return tn_job_open_asking(job, path, questions.where_count > 0 ? &questions : NULL);
}

static bool ready_library(tn_job *job, const tn_plan_settings *plans, const tn_library_options *options,
                          tn_ready_library *ready)
{
    tn_progress progress;
    tn_progress_watch(&progress, "clauses combined", tn_interrupt_waiting());
    tn_status status = tn_library_ready(&job->opened, plans->library, options, ready);
    tn_progress_unwatch(&progress, tn_interrupt_waiting());
    tn_job_status(job, status);
    return status == TN_OK;
}

bool tn_job_library(tn_job *job, const char *path, const tn_plan_settings *plans, tn_ready_library *ready)
{
    *ready = (tn_ready_library){0};
    return tn_job_open_plans(job, path, plans) && tn_job_opened_library(job, plans, ready);
}

tn_library_options tn_job_library_options(const tn_plan_settings *plans)
{
    const tn_library_asked asked = tn_job_asked(plans);
    return tn_asked_options(&asked);
}

tn_library_asked tn_job_asked(const tn_plan_settings *plans)
{
    return (tn_library_asked){.library = plans->library,
                              .where = {plans->wheres.items, plans->wheres.count},
                              .has_trays = plans->trays.given,
                              .trays = {plans->trays.low, plans->trays.high},
                              .has_max_length = plans->max_length.given,
                              .max_length = plans->max_length.value,
                              .has_max_states = plans->max_states.given,
                              .max_states = plans->max_states.value,
                              .has_max_houses = plans->max_houses.given,
                              .max_houses = plans->max_houses.value,
                              .has_threads = plans->threads.given,
                              .threads = plans->threads.value};
}

bool tn_job_of_houses(const tn_job *job, const tn_plan_settings *plans)
{
    return plans->library && tn_house_library_find(job->opened.module, plans->library) != TN_NO_RECORD;
}

bool tn_job_opened_library(tn_job *job, const tn_plan_settings *plans, tn_ready_library *ready)
{
    const tn_library_options options = tn_job_library_options(plans);
    return ready_library(job, plans, &options, ready);
}

bool tn_job_library_schema(tn_job *job, const char *path, const tn_plan_settings *plans, tn_ready_library *ready)
{
    *ready = (tn_ready_library){0};
    return tn_job_open_plans(job, path, plans) && ready_library(job, plans, NULL, ready);
}
