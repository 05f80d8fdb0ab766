/* Listing tray specifiers and sums. */
#ifndef TARTAN_PLAN_SCHEMA_LIST_H
#define TARTAN_PLAN_SCHEMA_LIST_H

#include "runtime/module/lister.h"

/* "width 4'|8', public": what a specifier asks of a tray. */
void tn_list_spec(tn_lister *lister, uint32_t spec);

/* Of a SUM record: its constant and its terms. */
void tn_list_sum(tn_lister *lister, uint32_t sum);

#endif
