/* The names of what house.h defines, for headers that hold pointers to houses and no more: what a house is made of can
 * then change without them. */
#ifndef TARTAN_HOUSE_HOUSE_NAMES_H
#define TARTAN_HOUSE_HOUSE_NAMES_H

#include "runtime/house/form/form.h"

typedef struct tn_house tn_house;
typedef struct tn_cell tn_cell;
typedef struct tn_face tn_face;

/* Calls back with a house, which is borrowed for the call, until *stop. */
typedef tn_status tn_house_each(void *context, const tn_house *house, bool *stop, tn_error *error);

#endif
