/* What `tartan studio` is told, which tartan-studio (studio/main.c) reads by the same table. */
#ifndef TARTAN_CLI_STUDIO_STUDIO_H
#define TARTAN_CLI_STUDIO_STUDIO_H

#include "cli/common/options.h"

typedef struct tn_studio_settings {
    tn_settings common;
    tn_option_number port;
    bool no_open, read_only;
} tn_studio_settings;

#endif
