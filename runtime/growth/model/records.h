/* How much a module's growth sections may hold beyond what records.def says of each field. */
#ifndef TARTAN_GROWTH_RECORDS_H
#define TARTAN_GROWTH_RECORDS_H

#include "runtime/module/values.h"

#define TN_NO_LABEL TN_NO_RECORD
#define TN_LABELS_MAX 32767u       /* labels of one system: a label is 15 bits of an edge's state */
#define TN_TEMPLATES_MAX 65000u    /* successors of one system: 16 bits of what replaces an edge */
#define TN_AXIOM_MAX 100000u       /* edges of a seed */
#define TN_SURROUNDINGS_MAX 10000u /* forces, and boundaries, of one environment */

#define TN_EXPRESSIONS_MAX 64u /* named fitness expressions of one study */

#endif
