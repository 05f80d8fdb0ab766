/* Answers `tartan diff` about libraries of houses. */
#include <stdlib.h>

#include "cli/house/compared.h"

static void write_compared(tn_job *job, const tn_compared_houses *c, bool json)
{
    tn_buffer text = {0};
    tn_error error;
    tn_output out;
    if (tn_compared_write(c, json, &text, &error) != TN_OK) {
        tn_job_fail(job, &error);
    } else if (tn_job_output(job, NULL, &out)) {
        fwrite(text.data, 1, text.size, out.stream);
        tn_job_commit(job, &out);
    }
    free(text.data);
}

void tn_jobs_compare_houses(tn_job jobs[2], const char *const *paths, const tn_house_settings *settings,
                            const tn_house_comparing *comparing)
{
    const tn_compared_options options = {.shown = comparing->shown,
                                         .seed = comparing->seed,
                                         .one_by_one =
                                             comparing->one_by_one ? comparing->one_by_one : TN_COMPARED_ONE_BY_ONE};
    tn_compared_houses c = {.sides = {{.path = paths[0]}, {.path = paths[1]}}};
    tn_error error;
    if (tn_job_numbered(&jobs[0], &c.sides[0].n, settings) && tn_job_numbered(&jobs[1], &c.sides[1].n, settings)) {
        if (tn_houses_compare(&c, &options, &error) == TN_OK)
            write_compared(&jobs[1], &c, comparing->json);
        else
            tn_job_fail(&jobs[1], &error);
    }
    tn_houses_compare_clear(&c);
    tn_numbered_close(&c.sides[0].n);
    tn_numbered_close(&c.sides[1].n);
}
