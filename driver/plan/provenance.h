/* How a file of plans says that it was made: by which rules, from which library, by which command.
 *
 * A tn_provenance borrows the opened file, the library and the two texts.
 */
#ifndef TARTAN_DRIVER_PLAN_PROVENANCE_H
#define TARTAN_DRIVER_PLAN_PROVENANCE_H

#include "driver/open/open.h"
#include "driver/plan/library.h"
#include "runtime/plan/text/stream.h"

typedef struct tn_provenance {
    char library_hash[56], rules_hash[20];
    char params[TN_PARAMS_TEXT_MAX];
    tn_plan_metadata metadata; /* points into this: never copy it */
} tn_provenance;

/* Of a library that is searched, the hash is that of the rule files. `rules_path`: as the command line named it. `command`: what was asked for, in words that decide the result. */
void tn_provenance_describe(const tn_opened *opened, const tn_ready_library *ready, const char *rules_path,
                            const char *command, tn_provenance *provenance);

/* The same of a library of houses on the plans of another one. Its hash is of these plans, and of the rule files. */
void tn_provenance_describe_houses(const tn_opened *opened, const tn_library *plans, const char *name,
                                   const char *rules_path, const char *command, tn_provenance *provenance);

/* What decides the result of `tartan enumerate`. */
typedef struct tn_enumerated {
    const char *from, *to; /* ranks; NULL where they were not given */
    bool mirror;
    bool trays_given;
    uint64_t trays_min, trays_max;
    const char *plan;          /* whose houses they are, or NULL */
    const char *const *wheres; /* further requirements of houses: the hash of a library does not show them */
    size_t where_count;
} tn_enumerated;

/* The command in words: "enumerate --from 0 --to 10". The caller frees it; NULL where out of memory. */
char *tn_enumerated_words(const tn_enumerated *asked);

#endif
