/* Explaining a plan in the words of its rules: which clause of a library drops it and why, or why rules match it or do
 * not, and which kept plans are nearest.
 *
 * A tn_explained owns its memory; it borrows the opened file, the schema and the library.
 */
#ifndef TARTAN_DRIVER_PLAN_EXPLAIN_H
#define TARTAN_DRIVER_PLAN_EXPLAIN_H

#include "driver/plan/library.h"
#include "runtime/base/picture.h"
#include "runtime/plan/analysis/explain.h"
#include "runtime/plan/analysis/generated.h"
#include "runtime/plan/library/near.h"
#include "runtime/plan/search/search.h"
#include "runtime/plan/text/text.h"

/* A rule or clause, explained. */
typedef struct tn_explained_rule {
    const char *name, *doc;
    const tn_clause_record *clause; /* NULL for a rule by itself */
    bool holds;
    bool drops; /* a clause that keeps the plan out of its library */
    tn_explanation why;
    tn_generated_beginning beginning; /* of a clause that says what plans are made of, if this one is not */
    char *ways;            /* and if it is: in how many ways, in digits; NULL if that passes a limit. Owned */
    const char *projected; /* of a projection: the library whose plans are projected; else NULL */
    char *above;           /* and the line of its first plan that is above this one, if there is one */
} tn_explained_rule;

/* A preference of a library, explained. */
typedef struct tn_preference_reason {
    const char *name, *doc;
    const char *worth; /* "p/q" */
    bool met;
    tn_explanation why;
} tn_preference_reason;

typedef struct tn_explained {
    const tn_opened *opened;
    const tn_schema *schema;
    const tn_library_record *library; /* or NULL: rules by themselves */
    const tn_tray *trays;             /* borrowed */
    size_t length;
    bool kept;         /* the library keeps the plan */
    bool length_drops; /* the plan has too few or too many trays */
    tn_explained_rule *rules;
    size_t count;
    tn_preference_reason *preferences; /* of the library */
    size_t preference_count;
    const tn_library *automaton; /* borrowed; NULL: ranks are not known */
    bool near_known;
    tn_near near;
} tn_explained;

/* Explains the clauses of a library (`library` given) or the rules of a list. max_length as in tn_explain. Clear in any
 * case. */
tn_status tn_explained_make(tn_explained *explained, const tn_opened *opened, const tn_schema *schema,
                            const tn_library_record *library, const uint32_t *rules, size_t rule_count,
                            const tn_tray *trays, size_t length, size_t max_length, tn_error *error);
void tn_explained_clear(tn_explained *explained);

/* What the preferences that the plan meets are worth together, and what all are. Both are initialised. */
void tn_explained_preferred(const tn_explained *explained, mpq_t met, mpq_t all);

/* Finds the nearest kept plans of a plan that is dropped, `most` of them. */
tn_status tn_explained_near(tn_explained *explained, tn_near_finder *finder, size_t most, tn_error *error);

/* The same by search, which is used up: for libraries whose automata pass a limit. */
tn_status tn_explained_search_near(tn_explained *explained, tn_plan_search *search, size_t most, tn_error *error);

/* As text: short, or with every clause and part. false where out of memory. */
bool tn_explained_text(const tn_explained *explained, bool full, tn_buffer *out);

/* One rule's part of the text, indented: for the failures of tests. */
bool tn_explained_rule_text(const tn_explained *explained, const tn_explained_rule *rule, bool full, tn_buffer *out);

/* As a picture: the plan, and under it a row for each part with the trays that it matched in green, those that it
 * lacked in red. Errors as in tn_canvas_begin. */
tn_status tn_explained_draw(const tn_explained *explained, bool full, tn_picture *to, tn_error *error);

/* The nodes that are shown, each before what is below it: all, or those that matter. Clear in any case. */
typedef struct tn_explain_rows {
    uint32_t *nodes;
    unsigned *depths;
    uint32_t count;
} tn_explain_rows;

/* ---- pieces that the text and whoever makes a message of it share */

/* What a side of a comparison came to, as people read it: "12 m", "56.25 %". false: out of memory. */
bool tn_words_side(const tn_explanation *why, const tn_sides *sides, const mpq_t value, tn_buffer *out);

/* What there is to say about a node beside its text: where it matched, what it counted, what was closest. */
void tn_words_evidence(const tn_explanation *why, const tn_why *node, tn_buffer *out);

/* "width 8', body open:8'": a tray's values that do not meet a specifier. */
void tn_words_wrong(const tn_explanation *why, const tn_why *node, tn_buffer *out);

/* How far the plan goes along with those that are generated: "`4' hall | 8' room` is how some generated plan begins;
 * then may come `4' stair` or the end". */
bool tn_words_beginning(const tn_explained *explained, const tn_generated_beginning *beginning, tn_buffer *out);

/* How a near plan differs: "tray 2: width 8' for 4'; tray 3 left out". */
bool tn_words_changes(const tn_explained *explained, const tn_near_plan *plan, tn_buffer *out);

#endif
