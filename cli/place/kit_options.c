/* Options about the buildings of a kit. */
#include "cli/place/kit_options.h"

bool tn_job_asks_kit(tn_job *job, const tn_kit_options *options)
{
    const char *option = options->parts.given   ? "parts"
                         : options->fixed       ? "fixed"
                         : options->inside      ? "inside"
                         : options->kinds.count ? "part"
                                                : NULL;
    if (option)
        tn_job_usage(job, "--%s is about a kit, and %.200s is none", option, job->settings->operands.items[0]);
    return option != NULL;
}
