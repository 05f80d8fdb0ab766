/* Tray classes: the trays that no specifier (and, for sums, no field) of the rules considered tells apart are one
 * class. Classes are numbered by their first trays. Immutable once made; owns its arrays and borrows the schema. */
#ifndef TARTAN_PLAN_SCHEMA_CLASSES_H
#define TARTAN_PLAN_SCHEMA_CLASSES_H

#include "runtime/plan/schema/kinds.h"
#include "runtime/plan/schema/projection.h"

typedef struct tn_classes {
    const tn_schema *schema;
    uint32_t count;
    uint32_t *of_tray;        /* [trays]; NULL where the schema's trays are not listed: */
    tn_kinds kinds;           /* the classes as kinds */
    uint32_t *representative; /* [count]: a class's first tray */
    uint32_t *size;           /* [count]: trays in the class */
} tn_classes;

#define TN_CLASS_LOOKS_MAX (UINT64_C(1) << 33) /* comparisons of a tray, or a word of a diagram: half a minute */

static inline uint32_t tn_class_of(const tn_classes *classes, tn_tray tray)
{
    return classes->of_tray ? classes->of_tray[tray] : tn_kind_of_tray(&classes->kinds, tray);
}

/* The classes that the functions given, and those that they call, need. Free with tn_classes_free.
 * TN_LIMIT (E0803) where trays, or words of their diagram, times specifiers pass TN_CLASS_LOOKS_MAX. */
tn_status tn_classes_new(const tn_schema *schema, const uint32_t *functions, size_t count, tn_classes **classes,
                         tn_error *error);
/* The same where trays also differ by what they count in SUM records, and by their parts. */
tn_status tn_classes_with_sums(const tn_schema *schema, const uint32_t *functions, size_t count, const uint32_t *sums,
                               size_t sum_count, tn_classes **classes, tn_error *error);
/* Of the newer trays of a projection: what the clauses of its library tell apart. */
tn_status tn_classes_above(const tn_projection *projection, tn_classes **classes, tn_error *error);
/* Splits the classes further, so that no class holds trays of two of the other ones: of the same schema, or of the same
 * trays in another module. */
tn_status tn_classes_refine(tn_classes *classes, const tn_classes *other, tn_error *error);
void tn_classes_free(tn_classes *classes);

#endif
