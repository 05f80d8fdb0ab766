/* What `tartan place` and `tartan inspect` print of a model: how many parts there are of which kind. */
#ifndef TARTAN_CLI_PLACE_PLACE_H
#define TARTAN_CLI_PLACE_PLACE_H

#include <stdio.h>

#include "ask/session/requests.h"

void tn_parts_text(const tn_placed_kind *kinds, size_t count, FILE *out);

#endif
