/* A rule file that is asked questions, one after another.
 *
 * A session borrows the file that is open. What is wrong, and what there is to know besides an answer, goes to the
 * diagnostics of that file; every question returns the status of what it says there. What does not change between
 * questions is kept: the automaton of the library that was asked about last, and what plans were explained with. A
 * session belongs to one thread. */
#ifndef TARTAN_ASK_SESSION_SESSION_H
#define TARTAN_ASK_SESSION_SESSION_H

#include "ask/session/requests.h"
#include "driver/plan/library.h"
#include "runtime/plan/text/text.h"

/* Whoever asks is told what goes on; each function may be NULL. */
typedef struct tn_session_listener {
    void (*begins)(void *context, const char *work); /* work that may take long: "counting houses" */
    void (*ends)(void *context);                     /* that work */
    void *context;
    void (*shows)(void *context); /* what is said so far may be shown: it is about what follows, which takes long */
} tn_session_listener;

typedef struct tn_session {
    tn_opened *opened; /* borrowed */
    tn_session_listener listener;

    /* Called with an answer whose first part stands, before the rest of it is worked out, perhaps several times; NULL:
     * nobody waits for it. */
    void (*so_far)(void *context, const tn_reply *answer);
    void *so_far_context;

    /* Gives the session in which another file that a request names is open, as this one was opened. NULL: it cannot. */
    tn_status (*other)(void *context, const char *path, struct tn_session **other);
    void *other_context;

    /* Gives what is in a file that a request names, which whoever asks frees. NULL: files are read. */
    tn_status (*reads)(void *context, const char *path, uint8_t **bytes, size_t *size, tn_error *error);
    void *reads_context;

    /* Opens a text that is made of an answer as the session's file was opened. NULL: as files are. */
    const tn_text_opener *opener;

    /* The processes that do what is asked together (runtime/ranks/ranks.h); NULL: this one alone. */
    const struct tn_ranks *ranks;

    /* Takes the plans or houses that are found (found.h); NULL: they are put into the answer. */
    const struct tn_taker *taker;

    /* Takes the buildings of a kit that are found (ask/place/kit.h); NULL: they are put into the answer. */
    const struct tn_building_taker *buildings;

    /* Takes the files that are made (made.h); NULL: they are put into the answer, */
    const struct tn_file_taker *files;
    /* but for those that are no text, if this takes them (made.h). Or NULL. */
    const struct tn_bytes_taker *bytes;

    tn_ready_library library; /* made ready last, if library.library is not NULL */
    tn_library_options options;
    bool only_one; /* it was asked for without a name */

    tn_boxed explainer; /* of the plan that was explained last */
    tn_boxed grammar;   /* that genomes are mapped through */
    tn_boxed breeding;  /* the run that is bred by hand */
} tn_session;

/* Frees what is kept, which is before the file is closed. The session can be used again. */
void tn_session_forget(tn_session *session);

/* Says that the question failed so, and returns the status. The code E_USAGE: what is asked makes no sense. */
tn_status tn_session_fail(tn_session *session, const tn_error *error);

/* The same for a text of the request, in which the error has its place; `name` is what the text is called. */
tn_status tn_session_bad_text(tn_session *session, tn_error *error, const char *name, const char *text);

/* TN_INVALID with E_USAGE: what is asked makes no sense. `help` (may be NULL) says what does. */
tn_status tn_session_refuse(tn_session *session, const char *help, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Says that the library has no plan of that rank, and how many it has. Returns TN_INVALID. */
tn_status tn_session_no_rank(tn_session *session, const tn_library *library, const tn_library_record *record,
                             const char *rank);

/* The same of so many others; what: one of them, and several. */
tn_status tn_session_no_rank_of(tn_session *session, const tn_library_record *record, const mpz_t kept,
                                const char *const what[2], const char *rank);

/* Opens a text in the place of the session's file, which is a rule file, as that was opened. TN_INVALID: something is
 * wrong with it, which `opened` says; all else that can happen is said by the session. Close it in any case. */
tn_status tn_session_open_text(tn_session *session, const char *text, size_t size, const tn_questions *questions,
                               tn_opened *opened);

/* Adds a note to what is said. */
void tn_session_note(tn_session *session, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Tells the listener. */
void tn_session_begins(const tn_session *session, const char *work);
void tn_session_ends(const tn_session *session);
void tn_session_shows(const tn_session *session);

/* The library of plans that is asked about, ready. It is the session's. */
tn_status tn_session_library(tn_session *session, const tn_library_asked *asked, const tn_ready_library **ready);
/* The same for who can search its plans, perhaps all that are generated: see tn_library_ready_or_searched. */
tn_status tn_session_searched(tn_session *session, const tn_library_asked *asked, bool all_generated,
                              const tn_ready_library **ready, tn_error *limit);
/* The same for counting its plans, all or those before one: it may leave a clause out of its automaton
 * (tn_library_apart). */
tn_status tn_session_counted(tn_session *session, const tn_library_asked *asked, const tn_ready_library **ready);
/* The same without its pruning: its plans are all that it generates. */
tn_status tn_session_generated(tn_session *session, const tn_library_asked *asked, const tn_ready_library **ready);

/* Is the library that is asked about by name one of houses? */
bool tn_session_of_houses(const tn_session *session, const tn_library_asked *asked);

/* The same of one of many plans, as files of plans have them: a plan line or JSON. */
tn_status tn_session_plan_line(tn_session *session, const tn_schema *schema, const char *text, size_t max_length,
                               tn_plan *plan);

/* What a request says of a library's plans and of the work that it may take; how many threads may do it, and the
 * longest plan that it accepts. */
tn_library_options tn_asked_options(const tn_library_asked *asked);
unsigned tn_asked_threads(const tn_library_asked *asked);
size_t tn_asked_length(const tn_library_asked *asked);

#endif
