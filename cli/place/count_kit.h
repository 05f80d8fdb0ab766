/* What `tartan count` does with a kit: how many buildings can be made of so many of its parts. */
#ifndef TARTAN_CLI_PLACE_COUNT_KIT_H
#define TARTAN_CLI_PLACE_COUNT_KIT_H

#include "cli/common/job.h"
#include "runtime/place/model/rules.h"

typedef struct tn_count_kit_options {
    tn_option_number parts;
    tn_option_list kinds; /* parts by name; none: all of the kit */
    unsigned threads;     /* 0: all processors */
    const char *inside;   /* a model of the kit, or NULL */
    bool fixed, json;
} tn_count_kit_options;

/* Rows for commands that embed tn_count_kit_options as `kit`. verb: what is done with the buildings. */
#define OPTIONS_KIT(verb)                                                                                              \
    NUMBER("parts", 0, "N", kit.parts, 1, 32, "of a kit: " verb " the buildings of N parts"),                          \
        LIST("part", 0, "NAME", kit.kinds, "of a kit: only of these parts; may be repeated (default: all)"),           \
        TEXT("inside", 0, "MODEL", kit.inside,                                                                         \
             "of a kit: " verb " those inside of the space of this model, each where it stands"),                      \
        FLAG("fixed", 0, kit.fixed, "of a kit: tell apart buildings that differ by a turn")

/* Is something asked that only kits answer? Then that is told. */
bool tn_job_asks_kit(tn_job *job, const tn_count_kit_options *options);

/* Checks what is asked of a kit and finds which of its parts are wanted: *wanted is [part of the kit], or NULL for all;
 * the caller frees it. False where something is wrong, which is told. */
bool tn_job_kit_parts(tn_job *job, const tn_count_kit_options *options, bool **wanted);

/* The rules of the model whose space --inside names, to be cleared. False where the kit has none such, which is told.
 */
bool tn_job_kit_space(tn_job *job, const char *name, tn_place_rules *rules);

/* Counts, and writes the counts to `path` (NULL: standard output). */
void tn_job_count_kit(tn_job *job, const tn_count_kit_options *options, const char *path);

#endif
