/* What rules and libraries mean, as data: why a rule matches a plan, which rules say the same or never matter, and what
 * an edit does to a library. Decided on automata, so exactly. */
#ifndef TARTAN_ANALYSIS_H
#define TARTAN_ANALYSIS_H

#include "plan.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- why */

typedef struct tartan_explanation tartan_explanation;

/* Explains what rules say of a plan (names and count as in tartan_rules_new), or what the clauses of a library say
 * (name NULL: the only one of the file). A plan of more than 1,000 trays is TARTAN_LIMIT. `watch` may be NULL. */
TARTAN_API tartan_status tartan_explain_rules(const tartan_module *module, const char *const *names, size_t count,
                                              const uint32_t *trays, size_t length, const tartan_watch *watch,
                                              tartan_explanation **explanation, tartan_error *error);
TARTAN_API tartan_status tartan_explain_library(const tartan_module *module, const char *name, const uint32_t *trays,
                                                size_t length, const tartan_watch *watch,
                                                tartan_explanation **explanation, tartan_error *error);
TARTAN_API void tartan_explanation_free(tartan_explanation *explanation);

/* Does the library keep the plan? false for rules by themselves. */
TARTAN_API bool tartan_explanation_kept(const tartan_explanation *explanation);

/* Is the plan too short or too long for the library? */
TARTAN_API bool tartan_explanation_length_drops(const tartan_explanation *explanation);

/* A rule or a clause, explained. */
typedef struct tartan_verdict {
    size_t size;
    const char *name, *doc;
    bool matches;
    bool drops;  /* a clause that keeps the plan out of its library */
    bool prunes; /* a clause that prunes, rather than requires */
    size_t part_count;
} tartan_verdict;
TARTAN_SIZED(tartan_verdict)

/* Its rules or clauses: how many, and what is said of the i-th. */
TARTAN_API size_t tartan_explanation_count(const tartan_explanation *explanation);
TARTAN_API tartan_status tartan_explanation_verdict(const tartan_explanation *explanation, size_t i,
                                                    tartan_verdict *verdict, tartan_error *error);

/* Trays [begin, end) of the plan, from 0. */
typedef struct tartan_stretch {
    uint32_t begin, end;
} tartan_stretch;

#define TARTAN_NO_PART UINT32_MAX
#define TARTAN_NO_NUMBER INT64_MIN

/* One part of a rule, asked of a region of the plan. */
typedef struct tartan_part {
    size_t size;
    const char *kind; /* "neighbour", "tray", "and" */
    const char *text; /* as its author wrote it, cut off where it is long */
    const char *path; /* of the file that it stands in, or NULL; its bytes there: */
    uint32_t source_begin, source_end;
    bool matched;
    bool mirrored; /* read from the other end of the plan: the second half of a symmetric */
    bool whole;    /* asked of the region as a whole, not somewhere in it */
    bool absent;   /* an optional part that was left out */
    bool cut;      /* its own parts are not shown: there are too many */
    tartan_stretch region;
    const tartan_stretch *stretches; /* where it matched: the shortest stretches; of what is counted, what counts */
    size_t stretch_count;
    int64_t number;   /* what a quantity or occurrences counts, what a sum adds up to in nanometres; or
                         TARTAN_NO_NUMBER */
    uint32_t closest; /* a tray that was not there: the tray of the plan with the fewest wrong fields; or UINT32_MAX */
    uint32_t parent, first, next; /* parts, or TARTAN_NO_PART */
} tartan_part;
TARTAN_SIZED(tartan_part)

/* Part `part` of rule or clause i; part 0 is the whole. */
TARTAN_API tartan_status tartan_explanation_part(const tartan_explanation *explanation, size_t i, size_t part,
                                                 tartan_part *found, tartan_error *error);

/* ---- the nearest plans */

typedef struct tartan_near tartan_near;

/* The first `most` of the plans that a library keeps nearest to a plan: a changed field costs 1, a tray added or left
 * out as many as it has fields. TARTAN_LIMIT where finding them takes too much. */
TARTAN_API tartan_status tartan_near_find(const tartan_module *module, const char *name, const uint32_t *trays,
                                          size_t length, size_t most, const tartan_watch *watch, tartan_near **near,
                                          tartan_error *error);
TARTAN_API void tartan_near_free(tartan_near *near);
TARTAN_API size_t tartan_near_count(const tartan_near *near);
TARTAN_API uint32_t tartan_near_cost(const tartan_near *near); /* of each */
TARTAN_API bool tartan_near_more(const tartan_near *near);     /* there are others as near */
TARTAN_API const uint32_t *tartan_near_plan(const tartan_near *near, size_t i, size_t *length); /* NULL past the end */

/* ---- what rules mean */

typedef struct tartan_analysis tartan_analysis;

/* Analyses the rules and libraries of the compiled file itself, which must be of one schema (that of its first rule or
 * library). max_states 0: the default, 20,000. Where a rule or library passes it, a finding says so. */
TARTAN_API tartan_status tartan_analysis_new(const tartan_module *module, uint32_t max_states,
                                             const tartan_watch *watch, tartan_analysis **analysis,
                                             tartan_error *error);
TARTAN_API void tartan_analysis_free(tartan_analysis *analysis);
TARTAN_API const tartan_schema *tartan_analysis_schema(const tartan_analysis *analysis);

typedef enum tartan_finding_kind {
    TARTAN_FOUND_NEVER,        /* `rule` matches no plan */
    TARTAN_FOUND_ALWAYS,       /* `rule` matches every plan */
    TARTAN_FOUND_SUBSUMED,     /* `other` matches whatever `rule` matches; plan: only `other` matches it */
    TARTAN_FOUND_EQUIVALENT,   /* `rule` and `other` match the same plans; plan: one of them */
    TARTAN_FOUND_IDLE_PRUNE,   /* pruning by `clause` leaves nothing out that other clauses do not; plan: one that both
                                  drop, where there is one */
    TARTAN_FOUND_IDLE_REQUIRE, /* leaving out the requirement `clause` changes nothing */
    TARTAN_FOUND_EMPTY,        /* `library` holds no plan */
    TARTAN_FOUND_VACUOUS,      /* a distance holds only where there is no destination; plan: one where it does */
    TARTAN_FOUND_NO_TRAY,      /* no legal tray meets a specifier */
    TARTAN_FOUND_NOT_ANALYSED, /* `message` says what is in the way of `rule` or `library` */
} tartan_finding_kind;

typedef struct tartan_finding {
    size_t size;
    tartan_finding_kind kind;
    const char *rule, *other, *library, *clause; /* names, or NULL where it is about none */
    const char *path;                            /* of the file, or NULL; its bytes there: */
    uint32_t source_begin, source_end;
    const uint32_t *trays; /* of the shortest plan that shows it, or NULL */
    size_t tray_count;
    const char *message; /* or NULL */
} tartan_finding;
TARTAN_SIZED(tartan_finding)

/* What was found: how many findings, and the i-th. */
TARTAN_API size_t tartan_analysis_count(const tartan_analysis *analysis);
TARTAN_API tartan_status tartan_analysis_finding(const tartan_analysis *analysis, size_t i, tartan_finding *finding,
                                                 tartan_error *error);

typedef enum tartan_relation {
    TARTAN_RULES_UNKNOWN, /* one of them is not analysed */
    TARTAN_RULES_EQUAL,
    TARTAN_RULES_APART,    /* no plan matches both */
    TARTAN_RULES_INSIDE,   /* what the first matches, the second matches too */
    TARTAN_RULES_CONTAINS, /* the other way round */
    TARTAN_RULES_OVERLAP,
} tartan_relation;

/* How the rules relate, two by two: those of the compiled file itself, then those that its libraries name. */
TARTAN_API size_t tartan_analysis_rule_count(const tartan_analysis *analysis);
TARTAN_API const char *tartan_analysis_rule_name(const tartan_analysis *analysis, size_t i); /* NULL past the end */
TARTAN_API tartan_relation tartan_analysis_relation(const tartan_analysis *analysis, size_t i, size_t j);

/* ---- what an edit does */

typedef struct tartan_diff tartan_diff;

/* Compares two libraries, perhaps of two modules, that have the same trays (TARTAN_INVALID where not). It borrows
 * both. */
TARTAN_API tartan_status tartan_diff_new(const tartan_library *before, const tartan_library *after,
                                         const tartan_watch *watch, tartan_diff **diff, tartan_error *error);
TARTAN_API void tartan_diff_free(tartan_diff *diff);

/* The plans that only the first holds, only the second, and both: libraries themselves, to be counted, ranked and
 * sampled, borrowed from the diff, with the first library's trays. They have no clauses. */
TARTAN_API const tartan_library *tartan_diff_removed(const tartan_diff *diff);
TARTAN_API const tartan_library *tartan_diff_added(const tartan_diff *diff);
TARTAN_API const tartan_library *tartan_diff_kept(const tartan_diff *diff);

typedef enum tartan_change { TARTAN_CHANGED, TARTAN_ADDED, TARTAN_REMOVED } tartan_change;

typedef struct tartan_changed_clause {
    size_t size;
    tartan_change change;
    const char *name;    /* NULL: how many trays there are */
    const char *removes; /* removed plans that the new clause keeps out, in decimal; "-" where that is not known */
    const char *adds;    /* added plans that the old clause kept out, likewise */
} tartan_changed_clause;
TARTAN_SIZED(tartan_changed_clause)

/* The clauses in which the libraries differ: how many, and the i-th. */
TARTAN_API size_t tartan_diff_clause_count(const tartan_diff *diff);
TARTAN_API tartan_status tartan_diff_clause(const tartan_diff *diff, size_t i, tartan_changed_clause *clause,
                                            tartan_error *error);

#ifdef __cplusplus
}
#endif

#endif
