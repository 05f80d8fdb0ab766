/* Do parts of two modules mean the same? Docs, places and what people call functions and clauses do not matter, nor
 * where in its module something is; but for values of choices, which are told apart by their number alone.
 */
#ifndef TARTAN_MODULE_SAME_H
#define TARTAN_MODULE_SAME_H

#include "runtime/module/module.h"

/* Two records of a section, with all that they refer to: code by its instructions, references by what they are to. Both
 * modules are verified. False also where it is not clear. */
bool tn_records_same(const tn_module *first, uint32_t of_first, const tn_module *second, uint32_t of_second,
                     tn_section section);

#endif
