/* The trays of a plan that is searched, as gates: for each place and field the order encoding of its value (Crawford
 * and Baker: Experimental results on the application of satisfiability algorithms to scheduling problems, 1994):
 * whether it is at most this or that one. A value is then one gate, a specifier a gate of these, and a `forbid` a
 * clause of each place.
 *
 * A tn_letters owns its gates' numbers and borrows circuit and schema. */
#ifndef TARTAN_PLAN_SEARCH_LETTERS_H
#define TARTAN_PLAN_SEARCH_LETTERS_H

#include "runtime/plan/schema/schema.h"
#include "runtime/plan/search/circuit.h"

typedef struct tn_letters {
    tn_circuit *circuit;
    const tn_schema *schema;
    uint32_t length;  /* places */
    tn_signal *up_to; /* [places][the schema's values]: the field's value is that one, or one before it */
    tn_signal *is;    /* likewise: it is that one */
} tn_letters;

/* Plans of so many trays; only legal ones, from now on. Clear it in any case. */
tn_status tn_letters_make(tn_letters *letters, tn_circuit *circuit, const tn_schema *schema, uint32_t length,
                          tn_error *error);
/* The same trays in another schema, on the same circuit: field f of the first is fields[f] of this one, and its value
 * v, in its schema's order, is that field's values[v]. Clear it in any case. */
tn_status tn_letters_map(tn_letters *letters, const tn_letters *of, const tn_schema *schema, const uint32_t *fields,
                         const uint8_t *values, tn_error *error);
void tn_letters_clear(tn_letters *letters);

/* The gate of a field's value, by its place among the field's. */
static inline tn_signal tn_letters_is(const tn_letters *letters, uint32_t place, uint32_t field, uint32_t value)
{
    const tn_schema *schema = letters->schema;
    return letters->is[(size_t)place * schema->value_count + schema->value_start[field] + value];
}

/* At most that value, in the schema's order. */
static inline tn_signal tn_letters_up_to(const tn_letters *letters, uint32_t place, uint32_t field, uint32_t value)
{
    const tn_schema *schema = letters->schema;
    return letters->up_to[(size_t)place * schema->value_count + schema->value_start[field] + value];
}

/* The tray there meets the specifier. */
tn_signal tn_letters_meet(const tn_letters *letters, uint32_t place, uint32_t spec);

/* The trays at two places have the same value of a field. */
tn_signal tn_letters_alike(const tn_letters *letters, uint32_t a, uint32_t b, uint32_t field);

/* The plan that the solver found, of letters->length trays. */
void tn_letters_read(const tn_letters *letters, tn_tray *trays);

/* ---- what trays count
 *
 * A function of trays as a decision diagram over their fields, in which those that do not matter have no node; trays
 * that are not legal may count anything. */

typedef struct tn_tray_counts {
    int64_t *counts; /* [count]: the different ones, ascending */
    uint32_t count;
    uint32_t *nodes; /* a node's field, and what its values lead to: below `count` the count, else a node, TN_NO_TRAY:
                        no tray */
    size_t *first;   /* [node_count + 1]: a node's words in `nodes`; what it leads to comes before it */
    uint32_t node_count;
    uint32_t root;
} tn_tray_counts;

/* of_tray: what each tray counts. Clear it in any case. */
tn_status tn_tray_counts_make(tn_tray_counts *counts, const tn_schema *schema, const int64_t *of_tray, tn_error *error);
void tn_tray_counts_clear(tn_tray_counts *counts);

/* Of each count the gate that the tray there has it: gates has room for counts->count. TN_MEMORY. */
tn_status tn_letters_count(const tn_letters *letters, uint32_t place, const tn_tray_counts *counts, tn_signal *gates,
                           tn_error *error);

#endif
