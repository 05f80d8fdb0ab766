/* What is said of each plan of a file: which rules it matches, or that a library keeps it.
 *
 * A tn_answering borrows all that it points to, and does not change: threads may share it.
 */
#ifndef TARTAN_DRIVER_PLAN_ANSWERING_H
#define TARTAN_DRIVER_PLAN_ANSWERING_H

#include "driver/plan/sift.h"

typedef enum tn_answer_format {
    TN_ANSWER_NAMES, /* the names of the rules that match */
    TN_ANSWER_JSON,  /* an object a line */
    TN_ANSWER_BITS,  /* a 0 or 1 a rule */
    TN_ANSWER_ANY,   /* 1 where any rule matches, else 0 */
    TN_ANSWER_LINES, /* the plan as a plan line */
    TN_ANSWER_FORMAT_COUNT
} tn_answer_format;

typedef struct tn_answering {
    const tn_schema *schema; /* to read plans with */
    const tn_rules *rules;
    bool numbered; /* the lines of plans are part of what is said */
    bool any;      /* as in tn_sift_calls, as is the next */
    bool (*plan)(const void *context, const tn_sifted *plan, tn_buffer texts[TN_RELAY_TEXTS]);
    const char *(*rule_name)(const void *context, size_t i); /* of rule i of `rules` */
    const void *context;
} tn_answering;

#endif
