/* What rules and libraries say of one house: a form of an opened file made ready, and its interpreter.
 *
 * What is wrong with names goes to the diagnostics of the opened file. Close a judge before the file it is from.
 */
#ifndef TARTAN_DRIVER_HOUSE_JUDGE_H
#define TARTAN_DRIVER_HOUSE_JUDGE_H

#include "driver/open/open.h"
#include "runtime/house/rule/asked.h"

typedef struct tn_house_judge {
    const tn_module *module;
    tn_schema *schema;
    tn_house_form form;
    tn_house_rules *rules;
} tn_house_judge;

/* max_length as of tn_house_rules_new. */
tn_status tn_house_judge_open(const tn_module *module, uint32_t form, size_t max_length, tn_house_judge *judge,
                              tn_error *error);
void tn_house_judge_close(tn_house_judge *judge);

/* A clause about a house: of its library, or of the library that its plan is from. */
typedef struct tn_house_clause {
    const char *name, *doc;
    tn_clause_kind kind;
    bool of_plans; /* of the library of plans */
    bool trays;    /* the number of trays, which is no clause of its own */
    bool holds, drops;
    uint32_t function; /* of kind HOLDS, of a clause about houses; else TN_NO_RECORD */
    uint32_t file, begin, end;
} tn_house_clause;

/* What each clause says of the house: those about its plan first. The caller frees *clauses, also after a failure. */
tn_status tn_house_judge_clauses(tn_house_judge *judge, const tn_house_library_record *library, const tn_house *house,
                                 tn_house_clause **clauses, size_t *count, tn_error *error);

/* The HOUSE_LIBRARY record named so; for NULL the only one of the file itself, or the only one that it uses.
 * TN_NO_RECORD where there is none so called, or none at all: nothing is reported. */
uint32_t tn_house_library_find(const tn_module *module, const char *name);

/* The HOUSE_RULE record named so, or TN_NO_RECORD. */
uint32_t tn_house_rule_find(const tn_module *module, const char *name);

#endif
