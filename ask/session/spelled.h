/* A plan as a person writes it, in any of its spellings:
 *
 *   4' single - - | 8' double great     a plan line: every value of each tray
 *   {"trays": [...]}                    the same as JSON
 *   [4' | 8' great]                     in brackets, as tests have it: what is not written has its first value
 *   8' great | ? | ...                  an open plan: what is not written may have any
 *
 * A line is read as one even where it could be an open plan, too; brackets around what only an open plan can say (`?`,
 * `...`, `or`), or the word `plan` before them, make it one, as in rules. Lines and JSON are read from the module at
 * hand. For the other two the file is compiled once more with the text (tn_questions), so that their words mean what
 * they mean in a rule file; the module of a file that was compiled before has no such words. */
#ifndef TARTAN_ASK_SESSION_SPELLED_H
#define TARTAN_ASK_SESSION_SPELLED_H

#include "ask/session/session.h"

typedef struct tn_spelled {
    bool one;                  /* it is `plan`; else an open plan */
    bool in_brackets;          /* one, whose left out values are the first ones */
    tn_plan plan;              /* that one */
    size_t count;              /* of an open plan's parts */
    const uint32_t *functions; /* [count]: of M, in the module of `schema`; TN_NO_RECORD: any number of trays */
    bool *fits;                /* [count][trays]: may a tray of the schema stand there? */
    tn_schema *schema;         /* the same trays as those of the session's schema */
    tn_opened opened;          /* the module of `schema`, if there is one */
} tn_spelled;

/* Reads it. What is wrong is said of `name`, which is what the text is called; open_first: as of an open plan where it
 * is not clear what was meant. Clear it in any case. */
tn_status tn_spelled_read(tn_session *session, const tn_schema *schema, const char *text, const char *name,
                          size_t max_length, bool open_first, tn_spelled *spelled);

/* Makes an open plan of one plan, too, for which alone it stands. */
tn_status tn_spelled_open(tn_session *session, const tn_schema *schema, const char *name, tn_spelled *spelled);

void tn_spelled_clear(tn_spelled *spelled);

/* Where an open plan stands for several plans, or for none, says so and returns TN_INVALID; else makes it the one plan
 * that it stands for. */
tn_status tn_spelled_settle(tn_session *session, const tn_schema *schema, const char *text, const char *name,
                            tn_spelled *spelled);

/* Reads the plan that a request is about, in any spelling (spelled.h). The caller frees its trays, also after a
 * failure, which is said. */
tn_status tn_session_plan(tn_session *session, const tn_schema *schema, const char *text, size_t max_length,
                          tn_plan *plan);

#endif
