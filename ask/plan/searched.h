/* Plans of a library whose automaton passes a limit: found by search (runtime/plan/search/search.h), and said to be. */
#ifndef TARTAN_ASK_PLAN_SEARCHED_H
#define TARTAN_ASK_PLAN_SEARCHED_H

#include "ask/session/session.h"
#include "runtime/plan/search/search.h"

/* What searching may take, and the lengths that are asked about. */
tn_search_options tn_asked_search(const tn_library_asked *asked, const tn_search_asked *search);

/* Notes that the library is searched, since its automaton passes the limit. */
void tn_searched_note(tn_session *session, const tn_error *limit);

/* One of each mirror pair: is the plan of the library's, and its mirror image not, or of no lower rank? */
tn_status tn_searched_mirror_first(tn_plan_search *search, const tn_tray *trays, uint32_t length, bool *first,
                                   tn_error *error);

#endif
