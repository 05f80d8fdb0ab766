/* What relating is made of. */
#ifndef TARTAN_ASK_RELATIONS_H
#define TARTAN_ASK_RELATIONS_H

#include "ask/session/requests.h"
#include "ask/session/session.h"
#include "runtime/plan/analysis/analysis.h"

/* The states of a pair of clauses about houses, unless a request gives another limit: some seconds. */
#define TN_RELATED_STATES 100000u

/* "equal" and so on. */
const char *tn_relation_word(tn_rule_relation relation);

/* Relates the clauses of a library of houses, whatever they do with what they match, by counting the houses that match
 * each of them and each two. A pair that passes the limit of states is TN_RULES_UNKNOWN, and a note says so. */
tn_status tn_relate_houses(tn_session *session, const tn_relations_request *request,
                           const tn_house_library_record *library, tn_related *related);

#endif
