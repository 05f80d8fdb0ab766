/* Options about the buildings of a kit, for commands that ask the same of libraries. */
#ifndef TARTAN_CLI_PLACE_KIT_OPTIONS_H
#define TARTAN_CLI_PLACE_KIT_OPTIONS_H

#include "cli/common/options.h"
#include "runtime/place/count/count.h"

typedef struct tn_kit_options {
    tn_option_number parts;
    tn_option_list kinds; /* parts by name; none: all of the kit */
    const char *inside;   /* a model of the kit, or NULL */
    bool fixed;
} tn_kit_options;

/* Rows for commands that embed tn_kit_options as `kit`. verb: what is done with the buildings. */
#define OPTIONS_KIT(verb)                                                                                              \
    NUMBER("parts", 0, "N", kit.parts, 1, TN_COUNT_PARTS_MAX, "of a kit: " verb " the buildings of N parts"),          \
        LIST("part", 0, "NAME", kit.kinds, "of a kit: only of these parts; may be repeated (default: all)"),           \
        TEXT("inside", 0, "MODEL", kit.inside,                                                                         \
             "of a kit: " verb " those inside of the space of this model, each where it stands"),                      \
        FLAG("fixed", 0, kit.fixed, "of a kit: tell apart buildings that differ by a turn")

/* The same as part of a request. */
static inline tn_kit_asked tn_kit_options_asked(const tn_kit_options *options)
{
    return (tn_kit_asked){.has_parts = options->parts.given,
                          .parts = options->parts.value,
                          .part = {options->kinds.items, options->kinds.count},
                          .inside = options->inside,
                          .fixed = options->fixed};
}

#endif
