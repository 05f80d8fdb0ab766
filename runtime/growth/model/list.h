/* The growth sections of a listing. */
#ifndef TARTAN_GROWTH_LIST_H
#define TARTAN_GROWTH_LIST_H

#include "runtime/module/lister.h"

/* The rewrite system: labels, seed, each rule with its successors as the constant templates that they are, and the
 * study with its surroundings and goals. */
void tn_growth_list(tn_lister *lister);

#endif
