/* The relations that look at trays, as automata of marked words (marked.h) over tray classes. */
#ifndef TARTAN_PLAN_MATCH_TRAY_RELATIONS_H
#define TARTAN_PLAN_MATCH_TRAY_RELATIONS_H

#include "runtime/automata/marked.h"
#include "runtime/plan/schema/classes.h"

#define TN_NO_FIELD UINT32_MAX

/* TRAY: stretches of one tray that meets the specifier. */
tn_status tn_relate_tray(const tn_marked *marked, const tn_classes *classes, uint32_t spec, tn_dfa **out,
                         tn_error *error);

/* QUANTITY, SUM and OCCURRENCES: stretches whose tally meets a condition function. A field (index within the schema)
 * other than TN_NO_FIELD: each tray counts as much as its length in that field. */
tn_status tn_relate_count(const tn_marked *marked, const tn_classes *classes, const tn_dfa *a, tn_tally tally,
                          uint32_t condition, uint32_t field, tn_dfa **out, tn_error *error);

/* Stretches that count a number that meets a condition: counts[letter] for each letter of a single of `a`. */
tn_status tn_relate_numbers(const tn_marked *marked, const tn_module *module, const tn_dfa *a, uint32_t condition,
                            const uint64_t *counts, tn_dfa **out, tn_error *error);

/* MIRRORED: stretches whose values of a field (index within the schema) are mirrored. max_trays: of the plans that will
 * be asked about; 0: not known, which is E0802. */
tn_status tn_relate_mirrored(const tn_marked *marked, const tn_classes *classes, uint32_t field, uint32_t max_trays,
                             tn_dfa **out, tn_error *error);

#endif
