/* How houses are compared: together, or one by one. Internal to compared*.c. */
#ifndef TARTAN_CLI_HOUSE_COMPARED_PARTS_H
#define TARTAN_CLI_HOUSE_COMPARED_PARTS_H

#include "cli/house/compared.h"

/* Are there plans that only one of the libraries has? */
bool tn_compared_other_plans(const tn_compared_houses *c);

/* Keeps an example of what the edit removes (0) or adds (1). */
tn_status tn_edit_example(tn_house_edit *edit, int which, const tn_house *house, tn_error *error);

/* Finds the edit of that name without a clause: "plans" or "form"; NULL where nothing about it is another. */
tn_house_edit *tn_compared_edit(const tn_compared_houses *c, const char *name);

/* Examples of an edit from a library of the houses that it removes or adds: the first and some at random. */
tn_status tn_edit_sample(tn_house_edit *edit, int which, tn_numbered *from, const tn_compared_options *options,
                         tn_error *error);

/* Counts the houses of a side on the plans that only it has, with examples. The trays have the same numbers in both. */
tn_status tn_compared_own_plans(const tn_compared_houses *c, int which, tn_house_edit *edit,
                                const tn_compared_options *options, tn_error *error);

tn_status tn_compare_together(tn_compared_houses *c, int strict, const tn_compared_options *options, tn_error *error);
tn_status tn_compare_each(tn_compared_houses *c, const tn_compared_options *options, tn_error *error);

#endif
