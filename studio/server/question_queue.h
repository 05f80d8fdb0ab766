/* What waits for the desk of a window: questions (tartan/NAME) and changes of texts, worked on in the order that they
 * came. A newer question of the same name, text and subject ends the older one, waiting or at work; so does
 * `$/cancelRequest`. What is ended is answered with an error, once.
 *
 * No threads: whoever shares a queue locks it. The queue owns the messages in it. */
#ifndef TARTAN_STUDIO_SERVER_QUESTION_QUEUE_H
#define TARTAN_STUDIO_SERVER_QUESTION_QUEUE_H

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>

enum { TN_CANCELLED = -32800 }; /* as in the Language Server Protocol */

typedef struct tn_question_queue tn_question_queue;

/* NULL: out of memory. */
tn_question_queue *tn_question_queue_new(void);
void tn_question_queue_free(tn_question_queue *queue);

/* Takes over a message of so many bytes. False: out of memory, and the message is gone. */
bool tn_question_queue_put(tn_question_queue *queue, json_t *message, size_t size);

/* The next message, which is at work from now on, until tn_question_queue_done. Borrowed until then. NULL: none
 * waits. */
const json_t *tn_question_queue_next(tn_question_queue *queue);

/* Is nobody waiting for the answer of the one at work any more? */
bool tn_question_queue_unwanted(const tn_question_queue *queue);

/* The one at work has come to its end. If nobody waits for its answer any more: what is said instead, the caller's. */
json_t *tn_question_queue_done(tn_question_queue *queue);

/* The next answer to a question that was ended while it waited. The caller's; NULL: no more. */
json_t *tn_question_queue_ended(tn_question_queue *queue);

/* Bytes of the messages that wait. */
size_t tn_question_queue_size(const tn_question_queue *queue);

#endif
