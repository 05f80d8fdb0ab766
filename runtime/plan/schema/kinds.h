/* Kinds of trays, of a schema whose trays are not listed: trays that some tests do not tell apart are of one kind, and
 * the kinds are the labels of a labelling. Begun with schema->legal, of which all trays are of one kind, kinds are
 * split by one test after the other. */
#ifndef TARTAN_PLAN_SCHEMA_KINDS_H
#define TARTAN_PLAN_SCHEMA_KINDS_H

#include "runtime/plan/schema/schema.h"

/* Kinds split so far: `made`, which its owner frees, or, as long as that is NULL, schema->legal. */
typedef struct tn_kinds {
    const tn_schema *schema;
    tn_labelling *made;
} tn_kinds;

static inline const tn_labelling *tn_kinds_of(const tn_kinds *kinds)
{
    return kinds->made ? kinds->made : kinds->schema->legal;
}

/* The kind of a tray. */
static inline uint32_t tn_kind_of_tray(const tn_kinds *kinds, tn_tray tray)
{
    return tn_labelling_at(tn_kinds_of(kinds), tray, NULL);
}

/* Split by whether trays meet a specifier; by the lengths, or the values, that they have in a field (index within the
 * schema); by other kinds, of which so many that are given one number stay together (numbers NULL: none). E0803
 * (TN_LIMIT) where the diagram becomes too large. */
tn_status tn_kinds_by_spec(tn_kinds *kinds, uint32_t spec, tn_error *error);
tn_status tn_kinds_by_lengths(tn_kinds *kinds, uint32_t field, tn_error *error);
tn_status tn_kinds_by_values(tn_kinds *kinds, uint32_t field, tn_error *error);
tn_status tn_kinds_by_kinds(tn_kinds *kinds, const tn_labelling *others, const uint32_t *numbers, tn_error *error);

#endif
