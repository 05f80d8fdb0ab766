/* Kits as connection grammars, for programs that read only those. */
#ifndef TARTAN_DRIVER_PLACE_EXPORT_H
#define TARTAN_DRIVER_PLACE_EXPORT_H

#include "runtime/place/write.h"

/* Writes the rules of a kit's model as a .pcfg file, which places the same parts in the same order. E1333 for what
 * connection grammars cannot say: draws among those that fit, boxes and gaps of an odd number of cells, names of parts
 * that would lose a letter; TN_LIMIT (E1313) for a space of more than 2^26 cells. */
tn_status tn_kit_export(const tn_place_rules *rules, FILE *out, tn_error *error);

#endif
