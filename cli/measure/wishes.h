/* What `best` and `pareto` are told to make small or great: measures in their order. */
#ifndef TARTAN_CLI_MEASURE_WISHES_H
#define TARTAN_CLI_MEASURE_WISHES_H

#include "cli/house/best.h"
#include "cli/plan/library_job.h"
#include "runtime/plan/measure/amount.h"
#include "runtime/plan/measure/weighed.h"

typedef struct tn_wishes {
    uint32_t count;
    const char *names[TN_WEIGHED_MAX];
    uint32_t measures[TN_WEIGHED_MAX]; /* MEASURE records */
    bool most[TN_WEIGHED_MAX];
    tn_amount_unit unit[TN_WEIGHED_MAX];
} tn_wishes;

/* Reads the options, which have added to `list`; `least` of them are needed. false where one is wrong: then reported.
 */
bool tn_wishes_read(tn_job *job, const tn_ready_library *ready, const tn_option_list *list, uint32_t least,
                    tn_wishes *wishes);

/* The same, but only the names, and what is better; and these for houses. */
bool tn_wishes_names(tn_job *job, const tn_option_list *list, uint32_t least, tn_wishes *wishes);
tn_house_wishes tn_wishes_of_houses(const tn_wishes *wishes);

/* Appends the value of measure k: "p/q" in its unit, or for people. */
bool tn_wishes_exact(const tn_wishes *wishes, const tn_weighed *weighed, uint32_t k, int64_t steps, tn_buffer *out);
bool tn_wishes_text(const tn_wishes *wishes, const tn_weighed *weighed, uint32_t k, int64_t steps, tn_buffer *out);

#endif
