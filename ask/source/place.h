/* Where something stands in a text, as answers say it. */
#ifndef TARTAN_ASK_SOURCE_PLACE_H
#define TARTAN_ASK_SOURCE_PLACE_H

#include "ask/session/requests.h"
#include "compiler/common/source.h"

/* Fills the place, which starts as zeros; without a span it stays so. False where out of memory. */
bool tn_text_place_of(tn_sources *sources, bool has_span, tn_span span, tn_text_place *to);

#endif
