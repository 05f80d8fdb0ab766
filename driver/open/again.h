/* Opens a file once more, from the texts that were opened before, with something changed in its syntax trees: what it
 * would mean if it were written otherwise. Nothing is read from a disk.
 */
#ifndef TARTAN_DRIVER_OPEN_AGAIN_H
#define TARTAN_DRIVER_OPEN_AGAIN_H

#include "driver/open/open.h"

/* Called for the tree of each text, those that others use first; main: it is the file itself. What is added to a tree
 * lives in the arena. */
typedef void tn_change_tree(void *context, tn_arena *arena, void *tree, bool main);

/* Of a .plan file that was compiled; its params keep their values. `change` may be NULL. test: the params have the
 * values that the file's test of this number, from 1, says; 0: none. Close it in any case, and before the other one. */
tn_status tn_open_again(const tn_opened *opened, tn_change_tree *change, void *context, size_t test, tn_opened *again);

/* The values that the params of a .plan file or module were given, which borrow its sources. Free the items. TN_MEMORY,
 * else TN_OK. */
tn_status tn_opened_params(const tn_opened *opened, tn_param_values *params);

/* The same in words, "lot=9m, side=right"; empty where there are none, and cut off where there is no room. */
#define TN_PARAMS_TEXT_MAX 1000u
void tn_opened_params_text(const tn_opened *opened, char *text, size_t size);

#endif
