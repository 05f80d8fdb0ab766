/* The language server without streams or threads of its own: messages of the Language Server Protocol (version
 * 3.17) go in and come out. Whoever serves it decides what carries them: a pair of streams (serve.h), a socket, a
 * worker of a browser.
 *
 * Messages are answered in order, as they are taken. What was typed is compiled when an answer needs it or when
 * tn_exchange_work is called, which is when no message waits: so a burst of keystrokes costs one compilation. What
 * takes longer than a keystroke may is a review (review.h) that the caller lets run. Texts that editors have open stand
 * in for files, also where another file uses them. Nothing that a client sends ends an exchange but `exit`.
 *
 * An exchange belongs to one thread at a time; a review may run on another. */
#ifndef TARTAN_LSP_EXCHANGE_H
#define TARTAN_LSP_EXCHANGE_H

#include "lsp/review.h"

typedef struct tn_exchange tn_exchange;

/* `served` (borrowed, to stay) says whose files there are besides the open texts; NULL: those of the file system. */
tn_status tn_exchange_new(const tn_served *served, tn_exchange **exchange, tn_error *error);

/* No review may be at work. NULL is fine. */
void tn_exchange_free(tn_exchange *exchange);

/* Takes a message, which stays the caller's. */
void tn_exchange_take(tn_exchange *exchange, const json_t *message);

/* Instead of a message, something came that is none: says so. */
void tn_exchange_malformed(tn_exchange *exchange, const char *why);

/* The next message for the client, which the caller releases; NULL: there is none now. */
json_t *tn_exchange_next(tn_exchange *exchange);

/* No message waits: finds out what is wrong with the texts that changed. */
void tn_exchange_work(tn_exchange *exchange);

/* In how many milliseconds tn_exchange_work and tn_exchange_review are to be called if no message comes before; -1: not
 * before the next message. */
int tn_exchange_patience(const tn_exchange *exchange);

/* If typing has paused: what is to be reviewed now. It is the caller's to run, on any thread (the exchange may cancel
 * it meanwhile), and to give back to tn_exchange_reviewed. NULL: nothing now; always while another is at work. */
tn_review *tn_exchange_review(tn_exchange *exchange);

/* Takes over what was found, and frees the review, which has run or was cancelled. */
void tn_exchange_reviewed(tn_exchange *exchange, tn_review *review);

/* Cancels the review that is at work, if there is one. */
void tn_exchange_cancel(tn_exchange *exchange);

/* Did the client say `exit`? Had it said `shutdown` before? Was there no memory for an answer? */
bool tn_exchange_ended(const tn_exchange *exchange);
bool tn_exchange_shut_down(const tn_exchange *exchange);
bool tn_exchange_failed(const tn_exchange *exchange);

#endif
