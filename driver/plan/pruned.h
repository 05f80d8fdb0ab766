/* Which plans a library keeps, and what drops the others: what `tartan prune` says. */
#ifndef TARTAN_DRIVER_PLAN_PRUNED_H
#define TARTAN_DRIVER_PLAN_PRUNED_H

#include "driver/plan/answering.h"
#include "driver/plan/library.h"

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

#endif
