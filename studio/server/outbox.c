#include "studio/server/outbox.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/watch.h"

typedef struct letter {
    struct letter *next;
    void *bytes;
    size_t size, sent;
    bool binary;
} letter;

struct tn_outbox {
    pthread_mutex_t lock;
    pthread_cond_t changed; /* something was read, or the page is gone */
    letter *first, **last;
    size_t unread;
    double moved; /* when something was read, or the first came */
    bool closed;
    void (*woken)(void *context);
    void *context;
};

tn_outbox *tn_outbox_new(void (*woken)(void *context), void *context)
{
    tn_outbox *outbox = calloc(1, sizeof *outbox);
    if (!outbox)
        return NULL;
    pthread_mutex_init(&outbox->lock, NULL);
    pthread_cond_init(&outbox->changed, NULL);
    outbox->last = &outbox->first;
    outbox->woken = woken;
    outbox->context = context;
    return outbox;
}

static void free_letter(letter *l)
{
    free(l->bytes);
    free(l);
}

void tn_outbox_free(tn_outbox *outbox)
{
    if (!outbox)
        return;
    while (outbox->first) {
        letter *next = outbox->first->next;
        free_letter(outbox->first);
        outbox->first = next;
    }
    pthread_mutex_destroy(&outbox->lock);
    pthread_cond_destroy(&outbox->changed);
    free(outbox);
}

static bool put(tn_outbox *outbox, letter given, bool waits)
{
    letter *made = malloc(sizeof *made);
    if (!made) {
        free(given.bytes);
        return false;
    }
    *made = given;
    pthread_mutex_lock(&outbox->lock);
    while (waits && !outbox->closed && outbox->unread > TN_UNREAD_MAX)
        pthread_cond_wait(&outbox->changed, &outbox->lock);
    bool taken = !outbox->closed && outbox->unread <= TN_UNREAD_MAX;
    if (taken) {
        if (outbox->unread == 0)
            outbox->moved = tn_seconds();
        outbox->unread += made->size;
        *outbox->last = made;
        outbox->last = &made->next;
    }
    if (taken)
        outbox->woken(outbox->context);
    pthread_mutex_unlock(&outbox->lock);
    if (!taken)
        free_letter(made);
    return taken;
}

void tn_outbox_wake(tn_outbox *outbox)
{
    pthread_mutex_lock(&outbox->lock);
    if (!outbox->closed)
        outbox->woken(outbox->context);
    pthread_mutex_unlock(&outbox->lock);
}

static letter text_letter(char *text)
{
    return (letter){.bytes = text, .size = strlen(text)};
}

static bool put_message(tn_outbox *outbox, json_t *message, bool waits)
{
    char *text = message ? json_dumps(message, JSON_COMPACT) : NULL;
    bool good = !message || (text && put(outbox, text_letter(text), waits));
    json_decref(message);
    return good;
}

bool tn_outbox_put(tn_outbox *outbox, json_t *message)
{
    return put_message(outbox, message, true);
}

bool tn_outbox_put_text(tn_outbox *outbox, char *text)
{
    return !text || put(outbox, text_letter(text), true);
}

bool tn_outbox_put_bytes(tn_outbox *outbox, uint8_t *bytes, size_t size)
{
    return put(outbox, (letter){.bytes = bytes, .size = size, .binary = true}, true);
}

bool tn_outbox_put_now(tn_outbox *outbox, json_t *message)
{
    return put_message(outbox, message, false);
}

void tn_outbox_close(tn_outbox *outbox)
{
    pthread_mutex_lock(&outbox->lock);
    outbox->closed = true;
    pthread_cond_broadcast(&outbox->changed);
    pthread_mutex_unlock(&outbox->lock);
}

tn_outbox_piece tn_outbox_take(tn_outbox *outbox, unsigned char *bytes)
{
    tn_outbox_piece piece = {0};
    pthread_mutex_lock(&outbox->lock);
    letter *l = outbox->first;
    if (l) {
        size_t left = l->size - l->sent;
        piece.size = left < TN_PIECE_MAX ? left : TN_PIECE_MAX;
        piece.first = l->sent == 0;
        piece.last = piece.size == left;
        piece.binary = l->binary;
        memcpy(bytes, (const char *)l->bytes + l->sent, piece.size);
        l->sent += piece.size;
        outbox->unread -= piece.size;
        outbox->moved = tn_seconds();
        pthread_cond_broadcast(&outbox->changed);
    }
    if (piece.last) {
        outbox->first = l->next;
        if (!outbox->first)
            outbox->last = &outbox->first;
        free_letter(l);
    }
    pthread_mutex_unlock(&outbox->lock);
    return piece;
}

bool tn_outbox_waits(tn_outbox *outbox)
{
    pthread_mutex_lock(&outbox->lock);
    bool waits = outbox->first != NULL;
    pthread_mutex_unlock(&outbox->lock);
    return waits;
}

bool tn_outbox_stuck(tn_outbox *outbox)
{
    pthread_mutex_lock(&outbox->lock);
    bool stuck = outbox->unread > TN_UNREAD_MAX && tn_seconds() - outbox->moved > TN_UNREAD_SECONDS_MAX;
    pthread_mutex_unlock(&outbox->lock);
    return stuck;
}
