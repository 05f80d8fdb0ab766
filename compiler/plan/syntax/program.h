/* What remains of a compilation beside the module: the test blocks, with their plans resolved to tray numbers, for
 * `tartan test`. */
#ifndef TARTAN_COMPILER_PLAN_SYNTAX_PROGRAM_H
#define TARTAN_COMPILER_PLAN_SYNTAX_PROGRAM_H

#include "compiler/common/source.h"

typedef enum tn_expectation {
    TN_EXPECT_MATCH,
    TN_EXPECT_REJECT,
    TN_EXPECT_KEEP,
    TN_EXPECT_DROP,
    TN_EXPECT_VALUE
} tn_expectation;

typedef struct tn_test_case {
    tn_expectation expectation;
    const uint8_t *values; /* [tray][field]: index of the value within its field */
    size_t length;         /* trays */
    const char *house;     /* instead: the line of a house, or NULL */
    tn_span house_place;
    bool plan_alone;       /* the line ends behind the plan: the house is the only one on it */
    const char *doc;       /* or NULL */
    const char *const *by; /* drop ... by NAME, NAME: clause names; all must be among the reasons */
    size_t by_count;
    const char *value; /* of a measure: what it has to be, "p/q" in nanometres to its power */
    bool todo;         /* expected to fail */
    tn_span span;
} tn_test_case;

typedef struct tn_test_block {
    const char *subject; /* name of the rule, library or measure */
    bool is_library, is_measure;
    bool of_houses;
    uint32_t index;  /* of its RULE, LIBRARY or MEASURE record; of houses: HOUSE_RULE or HOUSE_LIBRARY */
    uint32_t schema; /* of its SCHEMA record */
    bool imported;
    size_t with;      /* the number of the test in its file, from 1, if it gives params values; else 0 */
    tn_span settings; /* these */
    const tn_test_case *cases;
    size_t case_count;
    tn_span span;
} tn_test_block;

/* A warning that an item's author has allowed there: nothing is to be said about it in that stretch. */
typedef struct tn_allowance {
    tn_span item;
    uint32_t code; /* a tn_code */
} tn_allowance;

/* A param, in its author's words. */
typedef struct tn_program_param {
    const char *name, *doc;   /* doc: or NULL */
    const char *value;        /* that it has here: its default, or what it was given */
    tn_span place;            /* of its default, or of all its words, where it is declared */
    const char *least, *most; /* its range, or NULL */
    const char **words;       /* which it is one of, or NULL: a constant */
    size_t word_count;
    bool imported;
} tn_program_param;

typedef struct tn_program {
    const tn_test_block *tests;
    size_t test_count;
    const tn_allowance *allowances;
    size_t allowance_count;
    const tn_span
        *settable; /* rules and clauses that depend on params: what is always so may be otherwise with others */
    size_t settable_count;
    tn_program_param *params; /* in the order of the files and of the text */
    size_t param_count;
    uint32_t *pattern; /* an open plan's trays: the function (of M) of each; TN_NO_RECORD: any number of trays */
    size_t pattern_count;
    const uint8_t *plan; /* a plan in brackets, [tray][field] as in tn_test_case; NULL: none was asked about */
    size_t plan_length;
} tn_program;

/* Does `allow` silence the warning at that place? For the warnings of the analysis, which runs after compiling. */
static inline bool tn_program_allows(const tn_program *program, uint32_t code, tn_span place)
{
    for (size_t i = 0; i < program->allowance_count; i++) {
        const tn_allowance *a = &program->allowances[i];
        if (a->code == code && a->item.file == place.file && a->item.begin <= place.begin && place.end <= a->item.end)
            return true;
    }
    return false;
}

/* Does what stands there depend on a param? */
static inline bool tn_program_settable(const tn_program *program, tn_span place)
{
    for (size_t i = 0; i < program->settable_count; i++) {
        const tn_span *item = &program->settable[i];
        if (item->file == place.file && item->begin <= place.begin && place.end <= item->end)
            return true;
    }
    return false;
}

#endif
