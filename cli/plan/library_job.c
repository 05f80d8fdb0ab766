/* Opens the library that a command line names, within the limits of its options. */
#include "cli/plan/library_job.h"

#include <stdlib.h>

#include "cli/common/interrupt.h"
#include "cli/common/progress.h"
#include "driver/house/judge.h"
#include "driver/open/digits.h"

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

void tn_job_rank(const char *text, const mpz_t otherwise, mpz_t number)
{
    if (!text || !*text || mpz_set_str(number, text, 10) != 0)
        mpz_set(number, otherwise);
}

static void refuse_range(tn_job *job, const char *from, const char *to)
{
    tn_diagnostic *d = tn_job_usage(job, "no rank is from %.60s on and before %.60s", from, to);
    tn_help(tn_job_diagnostics(job), d, "write the smaller rank after --from");
}

static void note_end(tn_job *job, const mpz_t kept, const char *from)
{
    char *digits = tn_digits(kept, false);
    tn_job_note(job, "the library holds %.400s plans, none of them from rank %.40s on", digits ? digits : "?", from);
    free(digits);
}

bool tn_job_range(tn_job *job, const tn_library *library, const char *from, const char *to, mpz_t begin, mpz_t end)
{
    mpz_t kept, zero;
    mpz_inits(kept, zero, NULL);
    tn_library_kept(library, TN_ALL_LENGTHS, kept);
    tn_job_rank(from, zero, begin);
    tn_job_rank(to, kept, end);
    bool backwards = to && mpz_cmp(begin, end) > 0;
    if (backwards)
        refuse_range(job, from, to);
    else if (mpz_sgn(kept) > 0 && mpz_cmp(begin, kept) >= 0)
        note_end(job, kept, from);
    if (mpz_cmp(end, kept) > 0)
        mpz_set(end, kept);
    if (mpz_cmp(begin, end) > 0)
        mpz_set(begin, end);
    mpz_clears(kept, zero, NULL);
    return !backwards;
}

bool tn_job_open_plan(tn_job *job, const char *path, const tn_plan_settings *plans, const char *pattern)
{
    const tn_questions questions = {.library = plans->library,
                                    .wheres = plans->wheres.items,
                                    .where_count = plans->wheres.count,
                                    .pattern = pattern};
    bool asks = questions.where_count > 0 || pattern;
    return tn_job_open_asking(job, path, asks ? &questions : NULL);
}

bool tn_job_open_plans(tn_job *job, const char *path, const tn_plan_settings *plans)
{
    return tn_job_open_plan(job, path, plans, NULL);
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
                              .has_threads = plans->threads.given,
                              .threads = plans->threads.value};
}

bool tn_job_of_houses(const tn_job *job, const tn_plan_settings *plans)
{
    return plans->library && tn_house_library_find(job->opened.module, plans->library) != TN_NO_RECORD;
}

tn_house_settings tn_job_houses(const tn_plan_settings *plans)
{
    const tn_library_asked asked = tn_job_asked(plans);
    return tn_asked_houses(&asked);
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
