/* The weights of a library for people. */
#ifndef TARTAN_ASK_PLAN_WEIGHTS_H
#define TARTAN_ASK_PLAN_WEIGHTS_H

#include "ask/session/session.h"

/* The number of a weight, or of several together (malloc): "0.5", or a fraction. NULL: out of memory. */
char *tn_weight_text(const mpq_t weight);

/* Appends the first few weights of a library with their numbers: "`busy` 7, `weight@12` 0.5 and 3 more". False: out of
 * memory. */
bool tn_weights_say(const tn_ready_library *ready, tn_buffer *text);

#endif
