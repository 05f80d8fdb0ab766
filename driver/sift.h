/* Sifting: reading plans, matching them against rules by several threads, and handing them on in the order they came.
 */
#ifndef TARTAN_DRIVER_SIFT_H
#define TARTAN_DRIVER_SIFT_H

#include "runtime/plan/rules.h"
#include "runtime/plan/stream.h"

typedef struct tn_sifted {
    const tn_tray *trays;
    size_t length;
    uint64_t line;        /* in the input */
    const uint64_t *bits; /* which rules match */
} tn_sifted;

/* What to do with the plans. Both return false to end early. Called by one thread at a time, though not always by the
 * same one. */
typedef struct tn_sift_calls {
    void *context;
    bool (*plan)(void *context, const tn_sifted *plan);
    /* A plan that cannot be read or matched; the error has its line. `text` may be NULL. */
    bool (*bad)(void *context, const tn_error *error, const char *text, size_t size);
} tn_sift_calls;

/* Reads to the end, in batches; memory is bounded by the batch. TN_OK also where a call ended it. */
tn_status tn_sift(tn_plan_reader *reader, const tn_rules *rules, int threads, const tn_sift_calls *calls,
                  tn_error *error);

#endif
