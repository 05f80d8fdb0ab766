/* Rules as Prolog clauses, for engines that are written in it.
 *
 * A program of ISO Prolog that stands alone: a plan is a list of trays, a tray a term tray(V1, ..., Vn) of the values
 * in schema order as a plan line writes them ('4''', single, '-', 'dense:4'''). For each rule a predicate of its name
 * that holds of the plans that it matches (but where that is a built-in one), and match_plan(Rule, Trays); for each
 * library keep_plan(Library, Trays) and prune_plan(Library, Clause, Trays).
 */
#ifndef TARTAN_PLAN_TEXT_EXPORT_PROLOG_H
#define TARTAN_PLAN_TEXT_EXPORT_PROLOG_H

#include "runtime/plan/text/text.h"

typedef struct tn_prolog_options {
    /* Also fetch(Tray, Field, Value) and prune_plan(Trays), of what the library does not keep: as the rules of the
     * paper are written (A. Rau-Chaplin, T. J. Smedley: A Graphical Language for Generating Architectural Forms,
     * Fig. 5). */
    bool fetch;
    const char *library; /* its name; NULL: whichever */
} tn_prolog_options;

/* Appends the program of all rules and libraries of the schema's module that are about this schema. What the program
 * has no words for is left out, and a comment says so. E_NO_PARTS where a library's clause is such. Other errors as in
 * tn_parts_read and tn_sum_new. */
tn_status tn_export_prolog(const tn_schema *schema, const tn_prolog_options *options, tn_buffer *out, tn_error *error);

#endif
