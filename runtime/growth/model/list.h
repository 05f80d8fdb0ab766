/* The growth sections of a listing. */
#ifndef TARTAN_GROWTH_LIST_H
#define TARTAN_GROWTH_LIST_H

#include "runtime/module/lister.h"

/* The rewrite system: labels, the functions that are its seed and the guards of each predecessor, and the study with
 * its surroundings and goals. */
void tn_growth_list(tn_lister *lister);

#endif
