/* What a tn_plan_analysis is made of, for the files that implement analysis.h. */
#ifndef TARTAN_PLAN_ANALYSIS_ANALYSIS_DATA_H
#define TARTAN_PLAN_ANALYSIS_ANALYSIS_DATA_H

#include "runtime/automata/search.h"
#include "runtime/base/crew.h"
#include "runtime/plan/analysis/analysis.h"
#include "runtime/plan/match/lower.h"
#include "runtime/plan/schema/classes.h"

typedef struct tn_plan_vm tn_plan_vm; /* runtime/plan/match/vm.h */

/* A rule being analysed. */
typedef struct tn_plan_analysed_rule {
    uint32_t record;
    bool own;             /* of the named file */
    bool named;           /* in a library of the named file */
    tn_dfa *dfa;          /* NULL: past the limit */
    tn_error *why;        /* then: what is in the way */
    tn_key match, reject; /* shortest plans, as letters; empty: there is none */
    uint64_t *uses;       /* bit r: rule r's functions are reached from this one's */
} tn_plan_analysed_rule;

struct tn_plan_analysis {
    const tn_schema *schema;
    uint32_t schema_index;
    uint32_t asked_states;     /* of the options: 0 for the defaults */
    unsigned threads;          /* likewise */
    uint32_t max_states;       /* of a rule's automata */
    uint32_t max_joint;        /* tuples of a search over the clauses of a library */
    const tn_library *library; /* as in tn_plan_analysis_options, while the analysis is made */
    tn_plan_memory *memory;
    tn_crew *crew; /* the same */
    tn_classes *classes;
    tn_lowering *lowering;
    tn_plan_vm *vm;
    tn_plan_analysed_rule *rules; /* own ones first */
    size_t rule_count, own_count;
    size_t *shown; /* [shown_count]: the rules of the relations */
    size_t shown_count;
    uint8_t *relations; /* [rule_count][rule_count]: tn_rule_relation */
    tn_plan_analysis_finding *findings;
    size_t count, room;
};

/* Adds a finding, with room for `plans` plans; NULL where out of memory. Valid until the next is added. */
tn_plan_analysis_finding *tn_plan_analysis_add(tn_plan_analysis *analysis, tn_found found, size_t plans);

/* The shortest plan of min..max trays that each of the parts answers as wanted; max_work as in tn_search. */
tn_status tn_plan_analysis_search(const tn_plan_analysis *analysis, const tn_search_part *parts, size_t count,
                                  uint32_t min, uint32_t max, const char *what, uint64_t max_work, tn_key *word,
                                  bool *found, tn_error *error);

/* Of parts (those that are `in`) that together leave no plan of min..max trays: takes out of `in` what that does not
 * take. What is left is irreducible, and earlier parts are left rather than later ones. max UINT32_MAX: any number. */
tn_status tn_plan_analysis_reduce(const tn_plan_analysis *analysis, const tn_search_part *parts, size_t count,
                                  uint32_t min, uint32_t max, bool *in, tn_error *error);

/* Is there a plan of min..max trays that part i alone does not answer as wanted? TN_LIMIT (E0802) past max_work steps. */
tn_status tn_plan_analysis_keeps_out(const tn_plan_analysis *analysis, const tn_search_part *parts, size_t count,
                                     size_t i, uint32_t min, uint32_t max, uint64_t max_work, bool *alone,
                                     tn_error *error);

/* alone[i], of the parts asked about: is there a plan of min..max trays that part i alone does not answer as wanted? */
tn_status tn_plan_analysis_needed(const tn_plan_analysis *analysis, const tn_search_part *parts, size_t count,
                                  uint32_t min, uint32_t max, const bool *asked, bool *alone, tn_error *error);

/* Makes a word of letters a plan to be shown. */
tn_status tn_plan_analysis_show(const tn_plan_analysis *analysis, const tn_key *word, tn_shown_plan *plan,
                                tn_error *error);

/* Has the reference engine say whether the function holds of the plan as expected: TN_INTERNAL where not. Where that
 * takes too much, the plan is not shown. */
tn_status tn_plan_analysis_confirm(const tn_plan_analysis *analysis, tn_shown_plan *plan, uint32_t function,
                                   bool expected, tn_error *error);

/* Notes that the automata of a rule or library (the other TN_NO_RECORD) pass a limit. */
tn_status tn_plan_analysis_give_up(tn_plan_analysis *analysis, uint32_t rule, uint32_t library, const tn_error *why,
                                   tn_error *error);

/* Of the functions from `first` to before `end` marks those that the marked ones call, directly or not. */
void tn_plan_analysis_mark_called(const tn_module *module, uint8_t *reached, uint32_t first, uint32_t end);

/* *needs: does the function, or one that it calls, compare sums, ask what is mirrored or use itself? Its automaton may
 * then need the library's lengths. */
tn_status tn_plan_analysis_needs_length(const tn_module *module, uint32_t function, bool *needs, tn_error *error);

/* The parts of the analysis, each in a file of its own. */
tn_status tn_plan_analysis_rules(tn_plan_analysis *analysis, tn_error *error);     /* never, always, and relations */
tn_status tn_plan_analysis_parts(tn_plan_analysis *analysis, tn_error *error);     /* distances and specifiers */
tn_status tn_plan_analysis_libraries(tn_plan_analysis *analysis, tn_error *error); /* clauses */

#endif
