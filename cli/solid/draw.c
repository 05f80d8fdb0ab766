/* What `tartan draw` and `tartan explain -o` do with designs of boxes. */
#include "cli/solid/solid.h"

void tn_job_draw_solid(tn_job *job, const char *name, const tn_solid_drawing *drawing, const char *output)
{
    uint32_t solid;
    tn_status status = tn_solid_choose(&job->opened, name, &solid);
    if (status == TN_OK)
        status = tn_solid_draw(&job->opened, solid, drawing, &(tn_picture){.path = output, .dpi = drawing->dpi});
    tn_job_status(job, status);
}
