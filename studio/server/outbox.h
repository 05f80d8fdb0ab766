/* What waits to be read by a page: messages, which the network sends piece by piece. Threads that answer wait while a
 * page leaves too much unread; a page that reads nothing for a while then is given up. */
#ifndef TARTAN_STUDIO_SERVER_OUTBOX_H
#define TARTAN_STUDIO_SERVER_OUTBOX_H

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    TN_UNREAD_MAX = 8 << 20,   /* bytes that wait; then threads wait, too */
    TN_PIECE_MAX = 32 << 10,   /* bytes that are sent at once */
    TN_UNREAD_SECONDS_MAX = 5, /* without a byte read, while so much waits */
};

typedef struct tn_outbox tn_outbox;

/* `woken` is called, by any thread, when there is something to be sent. NULL: out of memory. */
tn_outbox *tn_outbox_new(void (*woken)(void *context), void *context);
void tn_outbox_free(tn_outbox *outbox);

/* Takes over a message (NULL: nothing); waits while too much is unread. False: the page is gone, or out of memory. */
bool tn_outbox_put(tn_outbox *outbox, json_t *message);

/* The same of a text that was allocated (NULL: nothing), and of bytes, which go as a binary message. */
bool tn_outbox_put_text(tn_outbox *outbox, char *text);
bool tn_outbox_put_bytes(tn_outbox *outbox, uint8_t *bytes, size_t size);

/* The first from the network's thread, which does not wait: false also if too much is unread. */
bool tn_outbox_put_now(tn_outbox *outbox, json_t *message);

/* Calls `woken`, for another reason. */
void tn_outbox_wake(tn_outbox *outbox);

/* Nothing is taken any more, and nobody waits; nor is anybody woken. */
void tn_outbox_close(tn_outbox *outbox);

typedef struct tn_outbox_piece {
    size_t size;
    bool first, last; /* of its message */
    bool binary;
} tn_outbox_piece;

/* Copies the next piece to `bytes`, which has room for TN_PIECE_MAX; size 0: there is none. It counts as read. */
tn_outbox_piece tn_outbox_take(tn_outbox *outbox, unsigned char *bytes);

/* Is there more? */
bool tn_outbox_waits(tn_outbox *outbox);

/* Has a page that left too much unread read nothing for too long? */
bool tn_outbox_stuck(tn_outbox *outbox);

#endif
