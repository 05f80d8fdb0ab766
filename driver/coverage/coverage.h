/* Coverage of rules: do the tests notice a mistake? Of rules about plans each small change (changes.h) is made, and it
 * is found out exactly how many plans are decided otherwise then, and whether some test case comes out otherwise. Of
 * rules about houses, each part is taken to never match: how many houses of the library that uses it are decided
 * otherwise, where that can be counted. Of forms: what the houses of tests have.
 */
#ifndef TARTAN_DRIVER_COVERAGE_COVERAGE_H
#define TARTAN_DRIVER_COVERAGE_COVERAGE_H

#include <gmp.h>

#include "driver/coverage/changes.h"
#include "driver/house/coverage.h"
#include "runtime/plan/library/library.h"
#include "runtime/plan/text/text.h"

/* Without a library, plans are all of 1 to so many trays. */
#define TN_COVERAGE_TRAYS 4u

/* Changes that are tried in one file; further ones are counted. */
#define TN_COVERAGE_CHANGES 5000u

/* What became of a change, or of a part of a rule about houses. */
typedef enum tn_covered_fate {
    TN_FATE_NOTICED,  /* a test case comes out otherwise */
    TN_FATE_SURVIVES, /* every test comes out as before */
    TN_FATE_EQUAL,    /* and no plan of these lengths is decided otherwise, so that no test could tell */
    TN_FATE_UNKNOWN,  /* every test comes out as before, and counting plans passes a limit */
} tn_covered_fate;

/* A test case that tells a change: what is decided of a plan as the rules are. */
typedef struct tn_telling {
    bool found;
    bool of_library; /* the library is tested, and not the rule of this RULE record */
    uint32_t rule;
    bool now;       /* it matches the plan, or keeps it */
    tn_tray *trays; /* owned */
    size_t length;
    const char *by; /* the clause that alone drops it, or NULL; the module's */
    size_t same_as; /* the part whose telling plan tells this change too; its own number: none before it does */
} tn_telling;

/* A change of a rule or of a clause; or a part of a rule or clause about houses. */
typedef struct tn_covered_part {
    uint32_t function; /* HOLDS, of the rule or clause; UINT32_MAX: it is in neither */
    const char *name;  /* of the rule or clause */
    unsigned depth;    /* 0: the whole */
    const char *kind;  /* what is changed: "neighbour", "item" */
    char *text;        /* as its author wrote it, cut off where it is long; owned */
    tn_span place;     /* of it; of houses no place is known where its file is UINT32_MAX */
    bool of_houses;    /* of a rule or clause about houses: it never matches */
    bool counted;      /* how many plans or houses it decides is known */
    bool alone;        /* flips: of plans by their rules alone; the library keeps the same plans */
    mpz_t flips;       /* plans, or houses of a library, that would be decided otherwise */
    bool noticed;      /* a test case comes out otherwise */
    tn_covered_fate fate;
    const tn_change *change; /* NULL: of houses */
    char *around;            /* the specifier or neighbour that it is part of; owned; NULL: none */
    tn_telling telling;      /* where it survives and that was asked for */
} tn_covered_part;

/* Owns its parts; borrows the opened file. */
typedef struct tn_covered {
    const tn_opened *opened;
    const tn_library_record *library; /* whose plans are counted, or NULL */
    uint32_t min, max;                /* trays of the plans */
    tn_schema *schema;                /* owned; of the plans */
    tn_covered_part *parts;           /* those of a rule in a row, each before what is below it */
    size_t count, capacity;
    size_t noticed;
    tn_changes changes;
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
    bool tell;     /* also find the shortest plan that tells each change which survives */
} tn_coverage_options;

/* Measures the rules of the file itself, the clauses of its library and of its libraries of houses, and forms. What
 * passes the state limit is reported (a note). A module, which holds no tests, has no coverage. Failures are reported
 * too. Clear in any case. */
tn_status tn_coverage_measure(tn_opened *opened, const tn_coverage_options *options, tn_covered *covered);
void tn_covered_clear(tn_covered *covered);

/* How many parts of plans, or of houses, have a fate; of TN_FATE_COUNT any. */
#define TN_FATE_COUNT 4
size_t tn_covered_count(const tn_covered *covered, bool of_houses, int fate);

/* The number of the part behind those of the same rule or clause as part `first`. */
size_t tn_covered_rule_end(const tn_covered *covered, size_t first);

/* "changed to", "never matches": what the change makes of the text; and the same with what it is changed to. */
const char *tn_covered_change_words(const tn_covered_part *part);
bool tn_covered_change(const tn_covered_part *part, tn_buffer *out);

/* Appends it as a table. False: out of memory. */
bool tn_covered_text(const tn_covered *covered, tn_buffer *out);

/* Appends test blocks: for each change that survives the plan that tells it, with what the rules decide of it now. */
bool tn_covered_tests(const tn_covered *covered, tn_buffer *out);

/* Appends the case of one: `reject [12' | 8']`. */
bool tn_covered_case(const tn_covered *covered, const tn_covered_part *part, tn_buffer *out);

/* The name of the rule or library that its case tests. */
const char *tn_covered_subject_name(const tn_covered *covered, const tn_covered_part *part);

/* The place of a line of a form, or of a part. */
tn_place tn_covered_place(const tn_covered *covered, tn_span span);

#endif
