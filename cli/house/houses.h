/* What commands do with libraries of houses. */
#ifndef TARTAN_CLI_HOUSE_HOUSES_H
#define TARTAN_CLI_HOUSE_HOUSES_H

#include "ask/house/numbered.h"
#include "ask/session/requests.h"
#include "cli/common/job.h"
#include "runtime/house/model/aspect.h"

/* Opens a library of houses for a command; close it in any case. False: what was wrong is recorded. */
static inline bool tn_job_numbered(tn_job *job, tn_numbered *n, const tn_house_settings *settings)
{
    return tn_job_answered(job, tn_numbered_open(n, &job->session, settings));
}

/* The command that opened it. */
static inline tn_job *tn_numbered_job(const tn_numbered *n)
{
    return n->session->listener.context;
}

/* The most houses of a page. */
#define TN_HOUSES_DRAWN_MAX 200u

/* Small pictures of houses: the best by measures, the first of each of the best trade-offs, or so many drawn at random
 * with a seed. Their names, areas and costs, or their values, stand below. */
typedef struct tn_house_sheet {
    size_t wanted, columns;         /* columns: 0 for as many as look well */
    const tn_best_request *best;    /* or NULL */
    const tn_pareto_request *front; /* the best trade-offs, all of them; or NULL */
    uint64_t seed;
    tn_camera camera;
    const char *title; /* NULL: what the form says of itself */
    const char *output;
    uint32_t dpi;
} tn_house_sheet;

/* An error of usage where more than TN_HOUSES_DRAWN_MAX are wanted. */
void tn_job_draw_houses(tn_job *job, const tn_house_settings *settings, const tn_house_sheet *sheet);

#endif
