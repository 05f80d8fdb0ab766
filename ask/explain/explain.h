/* What explaining is made of: each kind of thing that is explained has a file of its own. */
#ifndef TARTAN_ASK_EXPLAIN_EXPLAIN_H
#define TARTAN_ASK_EXPLAIN_EXPLAIN_H

#include "ask/session/requests.h"
#include "ask/session/session.h"
#include "driver/house/judge.h"
#include "driver/plan/explain.h"

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

/* Adds the openings that lower roofs keep out of faces to a list of tn_covered_opening. */
tn_status tn_explain_covered(tn_house_explaining *e, tn_list *covered, tn_error *error);

/* Kept houses that differ from this one by as few choices as were found. */
tn_status tn_explain_nearest(tn_house_explaining *e, tn_explained_house *explained, tn_error *error);

#endif
