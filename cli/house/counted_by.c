/* count --by of houses: how those of a library, or on one plan, are spread over the values of a measure. */
#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "cli/common/progress.h"
#include "cli/house/numbered_parts.h"
#include "driver/plan/library.h"

static tn_status make_spread(const tn_numbered *n, const tn_plan *plan, tn_house_measured measure, tn_spread *spread,
                             tn_error *error)
{
    tn_house_weights *weights = NULL;
    tn_houses *houses = NULL;
    tn_status status = tn_house_weights_new(&n->form, measure, &weights, error);
    tn_house_measures measures = {.count = 1, .of = {weights}};
    tn_houses_what what = {.measures = &measures};
    if (plan) {
        what.only = plan->trays;
        what.length = (uint32_t)plan->length;
    }
    if (status == TN_OK)
        status = tn_houses_of(&n->form, n->record, n->plans, &what, n->max_states, &houses, error);
    if (status == TN_OK)
        status = tn_houses_spread(houses, &spread->d, error);
    if (status == TN_OK)
        status = tn_spread_finish(spread, error);
    tn_houses_free(houses);
    tn_house_weights_free(weights);
    return status;
}

static void show(tn_job *job, const tn_numbered *n, const tn_plan *plan, const tn_house_counting *counting,
                 uint32_t measure)
{
    const tn_module *module = n->form.module;
    tn_house_measured of = tn_house_measured_of(module, measure);
    tn_spread spread;
    tn_error error = {0};
    tn_progress progress;
    tn_spread_begin(&spread, n->schema, module->SUM_records[of.sum].power);
    spread.library = tn_text(module, n->record->name);
    spread.name = tn_text(module, of.name);
    spread.doc = tn_text(module, of.doc);
    spread.of = "house";
    tn_progress_watch(&progress, "counting by the measure", tn_interrupt_waiting());
    tn_status status = make_spread(n, plan, of, &spread, &error);
    tn_progress_unwatch(&progress, tn_interrupt_waiting());
    if (status != TN_OK)
        tn_job_fail(job, &error);
    else
        counting->show(job, &spread, counting->context);
    tn_spread_clear(&spread);
}

void tn_numbered_count_by(tn_numbered *n, const tn_house_settings *settings, const tn_house_counting *counting)
{
    tn_job *job = n->job;
    tn_plan plan = {0};
    tn_error error = {0};
    uint32_t measure;
    if (counting->json && !tn_job_takes_text(job, counting->output))
        return;
    tn_status status = tn_house_measure_choose(&job->opened, counting->by, n->record->form, &measure);
    tn_job_status(job, status);
    if (status != TN_OK)
        return;
    if (counting->plan)
        status = tn_numbered_plan(n, counting->plan, settings->max_length, &plan, &error);
    if (status != TN_OK)
        tn_numbered_bad_text(job, &error, "PLAN", counting->plan);
    else
        show(job, n, counting->plan ? &plan : NULL, counting, measure);
    free(plan.trays);
}
