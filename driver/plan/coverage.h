/* Coverage of rules: for each part of each rule, how many plans' decisions would be others if the part never matched,
 * and whether some test case would notice. Of rules about houses, how many houses of the library that uses it are
 * decided otherwise, where that can be counted. Of forms: what the houses of tests have.
 */
#ifndef TARTAN_DRIVER_PLAN_COVERAGE_H
#define TARTAN_DRIVER_PLAN_COVERAGE_H

#include <gmp.h>

#include "driver/house/coverage.h"
#include "runtime/plan/library/library.h"
#include "runtime/plan/text/text.h"

/* Without a library, plans are all of 1 to so many trays. */
#define TN_COVERAGE_TRAYS 4u

/* A part of a rule or of a clause that is written out in its library. */
typedef struct tn_covered_part {
    uint32_t function; /* HOLDS, of the rule or clause */
    const char *name;  /* of the rule or clause; the module's */
    unsigned depth;    /* 0: the whole */
    const char *kind;  /* "neighbour" */
    char *text;        /* as its author wrote it, cut off where it is long */
    uint32_t root;     /* its place: an offset into the code */
    bool of_houses;    /* of a rule or clause about houses */
    bool counted;      /* of these: how many houses it decides is known */
    mpz_t flips;       /* plans, or houses of a library, that would be decided otherwise */
    bool noticed;      /* a test case comes out otherwise */
} tn_covered_part;

/* Owns its parts; borrows the opened file. */
typedef struct tn_covered {
    const tn_opened *opened;
    const tn_library_record *library; /* whose generated plans are counted, or NULL */
    tn_covered_part *parts;           /* those of a rule in a row, each before what is below it */
    size_t count, capacity;
    size_t noticed;
    tn_form_coverage *forms; /* of the file itself, and those that its tests are about */
    size_t form_count;
} tn_covered;

typedef struct tn_coverage_options {
    const char *library; /* NULL: the only one of the file, if it has one */
    uint32_t max_states; /* 0: the default */
    /* The library made ready, with its own lengths; NULL: measuring makes its own. */
    const tn_library *automaton;
    bool imported; /* also rules of used files that the library's clauses name */
    bool houses;   /* also count the houses that depend on parts: some seconds for a large library */
} tn_coverage_options;

/* Measures the rules of the file itself, the clauses written out in its library and in its libraries of houses, and
 * forms. What passes the state limit is
 * reported (a note) and left out. A module, which holds no tests, has no coverage. Failures are reported too. Clear in
 * any case. */
tn_status tn_coverage_measure(tn_opened *opened, const tn_coverage_options *options, tn_covered *covered);
void tn_covered_clear(tn_covered *covered);

/* Appends it as a table. False: out of memory. */
bool tn_covered_text(const tn_covered *covered, tn_buffer *out);

/* The place of a line of a form. */
tn_place tn_covered_place(const tn_covered *covered, tn_span span);

#endif
