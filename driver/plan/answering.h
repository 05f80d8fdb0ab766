/* What is said of each plan of a file: which rules it matches, or that a library keeps it.
 *
 * A tn_answering borrows all that it points to, and does not change: threads may share it.
 */
#ifndef TARTAN_DRIVER_PLAN_ANSWERING_H
#define TARTAN_DRIVER_PLAN_ANSWERING_H

#include "driver/plan/library.h"
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

/* Which plans a library keeps, and what drops the others: what `tartan prune` says. */

typedef struct tn_pruned {
    const tn_module *module;       /* borrowed */
    const tn_ready_library *ready; /* borrowed: its schema and record */
    tn_answer_format format;       /* TN_ANSWER_LINES or TN_ANSWER_JSON */
    uint32_t trays_min, trays_max;
    int dropped; /* the text that dropped plans go to, with their reasons; negative: none */
    tn_rules *rules;
} tn_pruned;

/* Makes the clauses of the library ready. The options' lengths, where they override it, are those of the plans that are
 * kept. Clear it in any case. Errors as of tn_clause_rules_new. */
tn_status tn_pruned_new(const tn_module *module, const tn_ready_library *ready, const tn_library_options *lengths,
                        const tn_rules_options *options, tn_answer_format format, tn_pruned *pruned, tn_error *error);
void tn_pruned_clear(tn_pruned *pruned);

/* Borrows it. */
tn_answering tn_pruned_answering(const tn_pruned *pruned);

/* Which rules each plan matches: what `tartan match` says. */

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
