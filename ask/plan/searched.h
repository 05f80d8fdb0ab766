/* Plans of a library whose automaton passes a limit: found by search (runtime/plan/search/search.h), and said to be. */
#ifndef TARTAN_ASK_PLAN_SEARCHED_H
#define TARTAN_ASK_PLAN_SEARCHED_H

#include "ask/plan/found.h"
#include "runtime/plan/search/search.h"

/* What searching may take, and the lengths that are asked about. */
tn_search_options tn_asked_search(const tn_library_asked *asked, const tn_search_asked *search);

/* Makes a search of the library ready, which the caller frees; what is wrong is said. */
tn_status tn_searched_new(tn_session *session, const tn_ready_library *ready, const tn_library_asked *asked,
                          const tn_search_asked *search, tn_plan_search **made);

/* If the library that was asked for passes the limit of states, which is said: adds what can be asked of it instead.
 * Returns the status. */
tn_status tn_searched_instead(tn_session *session, tn_status status, const char *instead);

/* Notes that the library is searched, since its automaton passes the limit. */
void tn_searched_note(tn_session *session, const tn_error *limit);

/* Lines of plans that are found one after another. */
typedef struct tn_searched_lines {
    const tn_schema *schema;
    tn_owneds *lines; /* to which they are added, */
    size_t most;      /* so many at most */
    bool notes_limit; /* a limit that is passed before the first of them is noted, too, and no error */
    bool more;        /* there are others, or it is not known that there are none */
} tn_searched_lines;

/* Finds the first plans of a search, in the order of their ranks. A limit that is passed after the first of them is
 * noted, and no error. */
tn_status tn_searched_list(tn_session *session, tn_plan_search *search, tn_searched_lines *to, tn_error *error);

/* One of each mirror pair: is the plan of the library's, and its mirror image not, or of no lower rank? */
tn_status tn_searched_mirror_first(tn_plan_search *search, const tn_tray *trays, uint32_t length, bool *first,
                                   tn_error *error);

#endif
