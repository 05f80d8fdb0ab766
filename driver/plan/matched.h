/* Which rules each plan matches: what `tartan match` says. */
#ifndef TARTAN_DRIVER_PLAN_MATCHED_H
#define TARTAN_DRIVER_PLAN_MATCHED_H

#include "driver/plan/answering.h"

/* The first member of an answer in JSON, and what the answer so begins with; the number of the plan's line follows. */
#define TN_MATCHED_KEY "line"
#define TN_MATCHED_LINE "{\"" TN_MATCHED_KEY "\":"

typedef struct tn_matched {
    const tn_module *module; /* borrowed */
    const uint32_t *indices; /* RULE records, borrowed */
    size_t count;
    tn_answer_format format; /* not TN_ANSWER_LINES */
    tn_schema *schema;
    tn_rules *rules;
} tn_matched;

/* Compiles `count` rules about the schema; `format` says how they are told. Clear it in any case. Errors as of
 * tn_schema_new and tn_rules_new. */
tn_status tn_matched_new(const tn_module *module, const uint32_t *indices, size_t count, uint32_t schema,
                         const tn_rules_options *options, tn_answer_format format, tn_matched *matched,
                         tn_error *error);
void tn_matched_clear(tn_matched *matched);

/* Borrows it. */
tn_answering tn_matched_answering(const tn_matched *matched);

#endif
