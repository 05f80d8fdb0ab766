/* What explaining is made of: each kind of thing that is explained has a file of its own. */
#ifndef TARTAN_ASK_EXPLAIN_EXPLAIN_H
#define TARTAN_ASK_EXPLAIN_EXPLAIN_H

#include "ask/session/requests.h"
#include "ask/session/session.h"
#include "driver/house/judge.h"
#include "driver/plan/explain.h"
#include "runtime/house/bare.h"

/* A plan explained, as its text and its picture need it (the answer's `reasons`). It borrows the file and what the
 * session keeps. */
typedef struct tn_plan_reasons {
    tn_explained explained;
    tn_plan plan; /* owned */
} tn_plan_reasons;

/* The schema by which the plans of such a request are read. It is the session's. */
tn_status tn_explain_schema(tn_session *session, const tn_explain_request *request, const tn_schema **schema);

/* Why a library keeps a house, or why rules match it. */
tn_status tn_explain_house(tn_session *session, const tn_explain_request *request, tn_reply *answer);

/* What keeps all houses of a library off a plan. */
tn_status tn_explain_cells(tn_session *session, const tn_explain_request *request, tn_reply *answer);

/* ---- houses */

/* A house that is explained. */
typedef struct tn_house_explaining {
    tn_session *session;
    tn_house_judge judge;
    const tn_house_library_record *library; /* NULL: rules by themselves */
    tn_house house;
} tn_house_explaining;

/* A list that a message has of what the questions of a clause or rule find: tn_explained_house_clause.why and the like.
 */
#define TN_WHY(LIST) ((tn_list *)&(LIST))

/* Adds what the questions of a function (of kind HOLDS) find to a list of tn_asked_of_house. */
tn_status tn_explain_found(tn_house_explaining *e, uint32_t function, tn_list *why, tn_error *error);

/* Adds the cells in which no tile stands to a list of tn_bare_cell. */
tn_status tn_explain_bare(tn_house_explaining *e, tn_list *bare, tn_error *error);

/* Adds the walls that stand over nothing thicker than a partition to a list of tn_hanging_wall. */
tn_status tn_explain_hanging(tn_house_explaining *e, tn_list *hanging, tn_error *error);

/* Adds the openings that lower roofs keep out of faces to a list of tn_covered_opening. */
tn_status tn_explain_covered(tn_house_explaining *e, tn_list *covered, tn_error *error);

/* ---- the same in words, as texts and pictures have it */

void tn_explained_clause_said(const tn_explained_house_clause *clause, tn_buffer *out);
void tn_explained_rule_said(const tn_explained_house_rule *rule, tn_buffer *out);
void tn_explained_question_said(const tn_asked_of_house *question, tn_buffer *out);
void tn_explained_covered_said(const tn_covered_opening *covered, tn_buffer *out);

/* Of a house that is explained, or of a plan without one; and of a tile in such a cell. */
void tn_explained_bare_said(const tn_bare_cell *cell, bool of_house, tn_buffer *out);
void tn_explained_tile_said(const tn_failing_tile *tile, tn_buffer *out);

/* What keeps houses off a plan, as a whole. */
void tn_explained_cells_said(const tn_explained_cells *explained, tn_buffer *out);

/* ---- pictures: into the files of the answer */

/* Of a house, once the answer says why: full: every clause, not only those that drop it. */
tn_status tn_explain_house_draw(tn_house_explaining *e, const tn_explain_request *request, tn_reply *answer);

/* Of a plan in a section; the cells of `bare` are those of the answer. */
tn_status tn_explain_cells_draw(tn_session *session, const tn_explain_request *request, const tn_bare_cells *bare,
                                tn_reply *answer);

/* ---- */

/* Kept houses that differ from this one by as few choices as were found. */
tn_status tn_explain_nearest(tn_house_explaining *e, tn_explained_house *explained, tn_error *error);

#endif
