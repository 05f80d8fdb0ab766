/* Sifting: reading plans, matching them against rules by several threads, and writing what is to be said of them in the
 * order they came. */
#ifndef TARTAN_DRIVER_PLAN_SIFT_H
#define TARTAN_DRIVER_PLAN_SIFT_H

#include "driver/plan/relay.h"
#include "runtime/plan/match/rules.h"
#include "runtime/plan/text/stream.h"

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
