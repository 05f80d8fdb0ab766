/* Sifting: reading plans, matching them against rules by several threads, and writing what is to be said of them in the
 * order they came. */
#ifndef TARTAN_DRIVER_PLAN_SIFT_H
#define TARTAN_DRIVER_PLAN_SIFT_H

#include <pthread.h>

#include "runtime/plan/match/rules.h"
#include "runtime/plan/text/stream.h"
#include "runtime/plan/text/text.h"

/* Results that threads make side by side, handed on in order.
 *
 * The work comes in chunks, numbered from 0. A thread that finishes a chunk leaves its texts here and goes on with
 * another; whoever finishes the chunk whose turn it is hands on that one and all finished ones behind it. So nobody
 * waits for a turn, but for two cases: where so many chunks are under way, or so much text waits, that nobody may get
 * further ahead (that bounds memory), and where a thread asks for its turn itself, because its text has grown large or
 * there is something to report.
 */

#define TN_RELAY_TEXTS 2 /* a chunk has so many: what goes to one output, and to another */

typedef struct tn_relay_slot tn_relay_slot;

/* Hands texts on, which are about so many items: called by one thread at a time, in order. false ends it all: later
 * texts are dropped. */
typedef bool tn_relay_write(void *context, uint64_t items, const tn_buffer texts[TN_RELAY_TEXTS]);

typedef struct tn_relay {
    tn_relay_write *write;
    void *context;
    pthread_mutex_t lock; /* holds what follows */
    pthread_cond_t moved;
    tn_relay_slot *slots; /* of chunk k: slots[k % room] */
    size_t room;
    size_t waiting, waiting_max; /* bytes of text of finished chunks */
    uint64_t turn;               /* the chunk to be handed on next */
    bool stopped;
    uint64_t counted, lines; /* of so many chunks the lines are counted, and these are so many */
} tn_relay;

/* At most `room` chunks are under way, and about waiting_max bytes of text wait. TN_MEMORY. Clear it in any case. */
tn_status tn_relay_start(tn_relay *relay, size_t room, size_t waiting_max, tn_relay_write *write, void *context,
                         tn_error *error);
void tn_relay_clear(tn_relay *relay);

/* Waits until the chunk may be begun; false where it all has been stopped. To be asked for chunks in order, and every
 * chunk that was begun is to be passed. */
bool tn_relay_admit(tn_relay *relay, uint64_t chunk);

/* Says how many lines a chunk has; every chunk is to be counted, soon after it was begun, or none. */
void tn_relay_count(tn_relay *relay, uint64_t chunk, uint64_t lines);

/* The lines of all chunks before this one: waits until this and the ones before it are counted. */
uint64_t tn_relay_lines_before(tn_relay *relay, uint64_t chunk);

/* Waits until it is this chunk's turn. Then its thread, and no other, may hand texts on with tn_relay_now and stop it
 * all. */
void tn_relay_wait(tn_relay *relay, uint64_t chunk);
void tn_relay_now(tn_relay *relay, uint64_t items, tn_buffer texts[TN_RELAY_TEXTS]);
void tn_relay_stop(tn_relay *relay);

/* Ends a chunk. Its texts are empty then. */
void tn_relay_pass(tn_relay *relay, uint64_t chunk, uint64_t items, tn_buffer texts[TN_RELAY_TEXTS]);

typedef struct tn_sifted {
    const tn_tray *trays;
    size_t length;
    uint64_t line;        /* in the input, where the calls ask for that */
    const uint64_t *bits; /* which rules match; where only `any` is asked for, 1 or 0 */
} tn_sifted;

/* What to do with the plans. */
typedef struct tn_sift_calls {
    void *context;
    bool numbered; /* lines are needed; that is more work */
    bool any;      /* only whether any rule matches is asked for; that is less work */
    /* Appends to the texts what is to be written of a plan. Called by several threads at once; false where out of
     * memory. */
    bool (*plan)(const void *context, const tn_sifted *plan, tn_buffer texts[TN_RELAY_TEXTS]);
    /* Writes such texts, of so many plans. This and the next are called by one thread at a time, though not always by
     * the same one, and in the order of the input. Both return false to end early. */
    tn_relay_write *write;
    /* A plan that cannot be read or matched; the error has its line. `text` may be NULL. */
    bool (*bad)(void *context, const tn_error *error, const char *text, size_t size);
    uint64_t *lines; /* or NULL: set to the number of lines (plans, where the format has none) that were read */
} tn_sift_calls;

/* Reads to the end. TN_OK also where a call ended it. Memory is bounded by the number of threads: a batch for each, and
 * for each a few chunks' texts that wait to be written. */
tn_status tn_sift(tn_plan_reader *reader, const tn_rules *rules, int threads, const tn_sift_calls *calls,
                  tn_error *error);

#endif
