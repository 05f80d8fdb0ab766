/* Puts what several threads write into order. */
#include "driver/plan/relay.h"

#include <stdlib.h>

struct tn_relay_slot {
    tn_buffer texts[TN_RELAY_TEXTS];
    uint64_t items;
    bool finished;
    bool is_counted;
    uint64_t lines;  /* in the chunk */
    uint64_t before; /* and before it, once it and those before it are counted */
};

tn_status tn_relay_start(tn_relay *relay, size_t room, size_t waiting_max, tn_relay_write *write, void *context,
                         tn_error *error)
{
    *relay = (tn_relay){.write = write, .context = context, .room = room, .waiting_max = waiting_max};
    pthread_mutex_init(&relay->lock, NULL);
    pthread_cond_init(&relay->moved, NULL);
    relay->slots = calloc(room, sizeof *relay->slots);
    return relay->slots ? TN_OK : tn_fail_memory(error);
}

void tn_relay_clear(tn_relay *relay)
{
    free(relay->slots);
    pthread_cond_destroy(&relay->moved);
    pthread_mutex_destroy(&relay->lock);
}

static tn_relay_slot *slot_of(const tn_relay *relay, uint64_t chunk)
{
    return &relay->slots[chunk % relay->room];
}

bool tn_relay_admit(tn_relay *relay, uint64_t chunk)
{
    pthread_mutex_lock(&relay->lock);
    while (!relay->stopped && chunk != relay->turn &&
           (chunk - relay->turn >= relay->room || relay->waiting >= relay->waiting_max))
        pthread_cond_wait(&relay->moved, &relay->lock);
    bool admitted = !relay->stopped;
    pthread_mutex_unlock(&relay->lock);
    return admitted;
}

void tn_relay_count(tn_relay *relay, uint64_t chunk, uint64_t lines)
{
    pthread_mutex_lock(&relay->lock);
    slot_of(relay, chunk)->lines = lines;
    slot_of(relay, chunk)->is_counted = true;
    for (tn_relay_slot *slot; (slot = slot_of(relay, relay->counted))->is_counted; relay->counted++) {
        slot->is_counted = false;
        slot->before = relay->lines;
        relay->lines += slot->lines;
    }
    pthread_cond_broadcast(&relay->moved);
    pthread_mutex_unlock(&relay->lock);
}

uint64_t tn_relay_lines_before(tn_relay *relay, uint64_t chunk)
{
    pthread_mutex_lock(&relay->lock);
    while (relay->counted <= chunk)
        pthread_cond_wait(&relay->moved, &relay->lock);
    uint64_t before = slot_of(relay, chunk)->before;
    pthread_mutex_unlock(&relay->lock);
    return before;
}

void tn_relay_wait(tn_relay *relay, uint64_t chunk)
{
    pthread_mutex_lock(&relay->lock);
    while (relay->turn != chunk)
        pthread_cond_wait(&relay->moved, &relay->lock);
    pthread_mutex_unlock(&relay->lock);
}

void tn_relay_now(tn_relay *relay, uint64_t items, tn_buffer texts[TN_RELAY_TEXTS])
{
    if (!tn_relay_stopped(relay) && !relay->write(relay->context, items, texts))
        tn_relay_stop(relay);
    for (size_t t = 0; t < TN_RELAY_TEXTS; t++)
        texts[t].size = 0;
}

void tn_relay_stop(tn_relay *relay)
{
    pthread_mutex_lock(&relay->lock);
    relay->stopped = true;
    pthread_cond_broadcast(&relay->moved);
    pthread_mutex_unlock(&relay->lock);
}

bool tn_relay_stopped(tn_relay *relay)
{
    pthread_mutex_lock(&relay->lock);
    bool stopped = relay->stopped;
    pthread_mutex_unlock(&relay->lock);
    return stopped;
}

/* Bytes of the texts of a chunk. */
static size_t size_of(const tn_relay_slot *slot)
{
    size_t size = 0;
    for (size_t t = 0; t < TN_RELAY_TEXTS; t++)
        size += slot->texts[t].size;
    return size;
}

/* Another has the turn: leaves the texts to it. */
static void leave(tn_relay *relay, tn_relay_slot *slot, uint64_t items, tn_buffer texts[TN_RELAY_TEXTS])
{
    slot->items = items;
    for (size_t t = 0; t < TN_RELAY_TEXTS; t++) {
        slot->texts[t] = texts[t];
        texts[t] = (tn_buffer){0};
    }
    slot->finished = true;
    relay->waiting += size_of(slot);
}

static void next_turn(tn_relay *relay)
{
    relay->turn++;
    pthread_cond_broadcast(&relay->moved);
}

/* Hands on the chunk whose turn it is, which is finished. The lock is held before and after. */
static void hand_on(tn_relay *relay, tn_relay_slot *slot)
{
    size_t size = size_of(slot);
    pthread_mutex_unlock(&relay->lock);
    tn_relay_now(relay, slot->items, slot->texts);
    for (size_t t = 0; t < TN_RELAY_TEXTS; t++)
        free(slot->texts[t].data);
    pthread_mutex_lock(&relay->lock);
    slot->finished = false;
    relay->waiting -= size;
    next_turn(relay);
}

void tn_relay_pass(tn_relay *relay, uint64_t chunk, uint64_t items, tn_buffer texts[TN_RELAY_TEXTS])
{
    pthread_mutex_lock(&relay->lock);
    if (relay->turn != chunk) {
        leave(relay, slot_of(relay, chunk), items, texts);
        pthread_mutex_unlock(&relay->lock);
        return;
    }
    pthread_mutex_unlock(&relay->lock);
    tn_relay_now(relay, items, texts);
    pthread_mutex_lock(&relay->lock);
    next_turn(relay);
    for (tn_relay_slot *slot; (slot = slot_of(relay, relay->turn))->finished;)
        hand_on(relay, slot);
    pthread_mutex_unlock(&relay->lock);
}
