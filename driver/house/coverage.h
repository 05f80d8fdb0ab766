/* Coverage of forms: which lines of a form the houses of tests have.
 *
 * A tn_form_coverage owns its parts and borrows the opened file.
 */
#ifndef TARTAN_DRIVER_HOUSE_COVERAGE_H
#define TARTAN_DRIVER_HOUSE_COVERAGE_H

#include "driver/house/cases.h"

/* A line of a form, or (deeper) one of the kinds of a line of faces. */
typedef struct tn_form_line {
    unsigned depth;
    const char *kind; /* "function" */
    char *text;       /* "function living"; as its author wrote it where the line has no name */
    tn_span place;
    size_t houses; /* of how many tests */
} tn_form_line;

typedef struct tn_form_coverage {
    const char *name; /* of the form */
    tn_span place;
    bool imported;
    size_t tests; /* whose houses stand in the form */
    tn_form_line *parts;
    size_t count, capacity;
    size_t reached; /* parts that some house has */
} tn_form_coverage;

/* What the houses of the cases have of a form (a FORM record): storeys, values that the section chooses among,
 * functions, lines `void` and `no`, openings and flights, lines of faces by which a face is decided, with the kinds
 * that are in it, and tiles that stand in a cell or could stand there instead. Clear in any case. */
tn_status tn_form_covered(const tn_house_cases *cases, uint32_t form, tn_form_coverage *coverage, tn_error *error);
void tn_form_coverage_clear(tn_form_coverage *coverage);

#endif
