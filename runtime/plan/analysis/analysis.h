/* What the rules and libraries of a module mean, and which of them interact: decided on their automata, so exactly.
 *
 * "Never" and "always" are over non-empty plans of legal trays. What a library's clauses do is over the plans of its
 * lengths. A rule or library whose automata pass the state limit is said to be not analysed, never to be fine.
 *
 * Findings are about the named file (not about what it uses); they name records of the module and offsets into its
 * code, and bear the shortest plans that show them, which the reference engine has confirmed. A tn_plan_analysis owns
 * its findings and borrows the schema; it is immutable once made.
 */
#ifndef TARTAN_PLAN_ANALYSIS_ANALYSIS_H
#define TARTAN_PLAN_ANALYSIS_ANALYSIS_H

#include "runtime/plan/library/library.h"

typedef enum tn_found {
    TN_FOUND_NEVER,      /* `rule` matches no plan */
    TN_FOUND_ALWAYS,     /* `rule` matches every plan */
    TN_FOUND_SUBSUMED,   /* `other` matches whatever `rule` matches; plan: only `other` matches it */
    TN_FOUND_EQUIVALENT, /* `rule` and `other` match the same plans; plan: one of them */
    TN_FOUND_IDLE_PRUNE, /* pruning by `clause` leaves nothing out that the others do not; plan: one that it and others
                            (`reasons`) drop, or none where no plan that the library generates matches it */
    TN_FOUND_IDLE_REQUIRE, /* leaving out the requirement `clause` changes nothing */
    TN_FOUND_EMPTY,   /* `library` holds no plan: `reasons` is an irreducible set of clauses that sees to it; plan i:
                         what it would hold without clause i of them */
    TN_FOUND_VACUOUS, /* the distance at `offset` holds only where there is no destination; plan: one where it does */
    TN_FOUND_NO_TRAY, /* no legal tray meets the specifier at `offset` */
    TN_FOUND_NOT_ANALYSED /* `why` says what is in the way of `rule` or `library` */
} tn_found;

#define TN_NO_RECORD UINT32_MAX

typedef struct tn_shown_plan {
    tn_tray *trays;
    size_t length;
    bool shown; /* false: there is none, or confirming it takes too much */
} tn_shown_plan;

typedef struct tn_plan_analysis_finding {
    tn_found found;
    uint32_t rule, other;     /* RULE records */
    uint32_t library, clause; /* LIBRARY and CLAUSE records */
    uint32_t offset;          /* into the code */
    tn_shown_plan *plans;     /* one, but for TN_FOUND_EMPTY */
    size_t plan_count;
    uint32_t *reasons; /* CLAUSE records */
    size_t reason_count;
    bool with_lengths; /* TN_FOUND_EMPTY: only together with how many trays there are */
    tn_error *why;
} tn_plan_analysis_finding;

typedef struct tn_plan_analysis tn_plan_analysis;

typedef struct tn_plan_analysis_options {
    uint32_t max_states;       /* of any intermediate automaton, and tuples of a search; 0: TN_STATES_DEFAULT, and a
                                  million where a search is about a whole library */
    const tn_library *library; /* one of the module with its own lengths that is being counted anyway: which of its
                                  clauses are needed is then taken from the counts; or NULL */
    tn_plan_memory *memory;    /* where answers are found and kept; or NULL */
    unsigned threads;          /* that may work on it, which changes nothing; 0: as many as there are processors */
} tn_plan_analysis_options;

/* Analyses the rules and libraries of one schema of a module. options: NULL are the defaults; borrowed until the
 * analysis is made. */
tn_status tn_plan_analysis_new(const tn_schema *schema, const tn_plan_analysis_options *options,
                               tn_plan_analysis **analysis, tn_error *error);
void tn_plan_analysis_free(tn_plan_analysis *analysis);

size_t tn_plan_analysis_count(const tn_plan_analysis *analysis);
const tn_plan_analysis_finding *tn_plan_analysis_get(const tn_plan_analysis *analysis, size_t i);

/* The shortest plan of the library's lengths that clause i of it keeps out and no other clause does; not shown where
 * there is none. The library is of the analysis's schema. TN_LIMIT as in tn_library_effect. Free with
 * tn_shown_plan_clear. */
tn_status tn_plan_analysis_alone(const tn_plan_analysis *analysis, const tn_library *library, uint32_t i,
                                 tn_shown_plan *plan, tn_error *error);

/* ---- relations of rules */

typedef enum tn_rule_relation {
    TN_RULES_UNKNOWN, /* one of them is not analysed */
    TN_RULES_EQUAL,
    TN_RULES_APART,    /* no plan matches both */
    TN_RULES_INSIDE,   /* what the first matches, the second matches too */
    TN_RULES_CONTAINS, /* the other way round */
    TN_RULES_OVERLAP,
} tn_rule_relation;

/* The rules compared: those of the named file, in file order, then those that it uses and names in a library. */
size_t tn_plan_analysis_rule_count(const tn_plan_analysis *analysis);
uint32_t tn_plan_analysis_rule(const tn_plan_analysis *analysis, size_t i); /* its RULE record */
tn_rule_relation tn_plan_analysis_relation(const tn_plan_analysis *analysis, size_t i, size_t j);

/* The shortest plans that both rules match, only the first, only the second; free with tn_shown_plan_clear. */
tn_status tn_plan_analysis_examples(const tn_plan_analysis *analysis, size_t i, size_t j, tn_shown_plan examples[3],
                                    tn_error *error);
void tn_shown_plan_clear(tn_shown_plan *plan);

#endif
