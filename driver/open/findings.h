/* What analyses find of rules and libraries, as warnings: in the same words of plans and of houses. What the author
 * allows is left out, and so is what other values of params may change. */
#ifndef TARTAN_DRIVER_OPEN_FINDINGS_H
#define TARTAN_DRIVER_OPEN_FINDINGS_H

#include "driver/open/open.h"

/* What they are about. among: what is said behind it of which ones these are, with a blank before it; or "". */
typedef struct tn_finder {
    tn_opened *opened;
    const char *one, *many; /* "plan", "plans" */
    const char *among;
} tn_finder;

/* A rule, a library or a clause as it stands in the file. */
typedef struct tn_found_item {
    const char *name;
    tn_span span;
    bool imported; /* from a file that is used */
} tn_found_item;

/* Does the author allow that warning there, or may it be otherwise with other values of params? */
bool tn_finding_allowed(const tn_finder *finder, tn_code code, tn_span span);

/* Was a warning given about a part of the rule that is always or never so? That explains what the rule matches. */
bool tn_finding_explained(const tn_finder *finder, tn_span rule);

/* The name alone if it stands behind the first word of an item, or else the whole item. */
tn_span tn_finding_name_span(const tn_finder *finder, tn_span item, const char *word, const char *name);

/* Examples are lines; NULL: there is none to show. */
void tn_report_extreme(const tn_finder *finder, const tn_found_item *rule, bool never);
void tn_report_equivalent(const tn_finder *finder, const tn_found_item *rule, const tn_found_item *other,
                          const char *example);

/* reasons: other prunes that keep the example out; none: the clause matches nothing at all. */
void tn_report_idle_prune(const tn_finder *finder, const tn_found_item *library, const tn_found_item *clause,
                          const tn_found_item *reasons, size_t reason_count, const char *example);
void tn_report_idle_requirement(const tn_finder *finder, const tn_found_item *library, const tn_found_item *clause);

/* A library holds nothing: clauses that see to that, and what the others of them leave without each. with_lengths: they
 * do so with these numbers of trays alone. why: NULL, or why perhaps not all of them are needed. */
typedef struct tn_found_empty {
    const tn_found_item *reasons;
    const char *const *examples;
    size_t reason_count;
    bool with_lengths;
    uint32_t trays_min, trays_max;
    const char *why;
} tn_found_empty;
void tn_report_empty(const tn_finder *finder, const tn_found_item *library, const tn_found_empty *empty);

#endif
