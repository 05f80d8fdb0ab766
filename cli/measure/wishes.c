/* Measures that commands are told to make small or great. */
#include "cli/measure/wishes.h"

#include <string.h>

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
