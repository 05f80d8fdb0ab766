/* A schema made ready to use: its legal trays, numbered in schema order.
 *
 * A tray is a number below tray_count: the legal combinations of field values in
 * order, the first field most significant, values in the order written in the schema (a flag
 * unset first). Combinations that meet a `forbid` specifier are not legal and have no number.
 *
 * Up to a limit, trays are listed in tables; more trays are kept as a decision diagram (`legal`), and what goes
 * through trays one by one refuses such a schema (tn_schema_listed).
 *
 * A schema is immutable and may be shared between threads. It borrows the module, which must
 * outlive it.
 */
#ifndef TARTAN_PLAN_SCHEMA_SCHEMA_H
#define TARTAN_PLAN_SCHEMA_SCHEMA_H

#include "runtime/choices/labelling.h"
#include "runtime/module/module.h"

typedef uint32_t tn_tray;
#define TN_NO_TRAY UINT32_MAX

typedef struct tn_schema {
    const tn_module *module;
    const tn_schema_record *record;
    const tn_field_record *fields; /* record->field_count of them */
    const tn_value_record *values; /* the schema's first value; all of its values follow */
    uint32_t field_count;
    uint32_t value_count;   /* over all fields */
    uint32_t mask_words;    /* words of a specifier of this schema */
    uint32_t *value_start;  /* per field (and one past the last): index of its first value in `values` */
    uint32_t tray_count;    /* legal trays */
    tn_labelling *legal;    /* the legal trays, where they are not listed; else NULL, and the tables below are made */
    uint8_t *tray_values;   /* [tray][field]: index of the value within its field */
    uint64_t *tray_masks;   /* [tray][mask word]: one bit per value that the tray has, as in a specifier */
    uint32_t *tray_of_code; /* all combinations in order -> tray, or TN_NO_TRAY; NULL: they are too many */
    uint64_t code_count;    /* combinations, legal or not; UINT64_MAX: that or more */
    uint32_t *tray_plans; /* [trays]: the record that says for how many plans a tray stands; NULL: it stands for none */
} tn_schema;

/* Makes a schema ready; index: of the SCHEMA record. max_listed: so many legal trays are listed at most (0:
 * TN_SCHEMA_TRAYS_DEFAULT); the memory of their tables is bounded, too. More are kept as a diagram, and there may be
 * any number of combinations. E0803 past TN_SCHEMA_TRAYS_MAX legal trays, and where the diagram takes too long. E0207
 * where every tray is forbidden; E0703 where a module's tables are not as a schema needs them. The caller frees *schema
 * with tn_schema_free. */
#define TN_SCHEMA_TRAYS_DEFAULT (1u << 20)
#define TN_SCHEMA_TRAYS_MAX TN_LABELLED_MAX
#define TN_FIELD_VALUES_MAX 256u                 /* a value's index is held in a byte */
#define TN_SCHEMA_BYTES_MAX (UINT64_C(1) << 28)  /* of the tables of trays */
#define TN_SCHEMA_CHECKS_MAX (UINT64_C(1) << 31) /* combinations held against `forbid`s, in mask words */
tn_status tn_schema_new(const tn_module *module, uint32_t index, uint64_t max_listed, tn_schema **schema,
                        tn_error *error);
void tn_schema_free(tn_schema *schema);

/* For what goes through the trays one by one: E0803 if they are not listed. `what` is a clause's subject and verb, such
 * as "an open plan goes". */
tn_status tn_schema_listed(const tn_schema *schema, const char *what, tn_error *error);

/* The same as tn_tray_value, where trays are not listed. */
uint32_t tn_tray_value_below(const tn_schema *schema, tn_tray tray, uint32_t field);

/* The value (index within the field) that a tray has in a field. */
static inline uint32_t tn_tray_value(const tn_schema *schema, tn_tray tray, uint32_t field)
{
    return schema->tray_values ? schema->tray_values[(size_t)tray * schema->field_count + field]
                               : tn_tray_value_below(schema, tray, field);
}

/* The words of a tray's values: mask_words of them, in the order of a specifier's. Of trays that are listed. */
static inline const uint64_t *tn_tray_mask(const tn_schema *schema, tn_tray tray)
{
    return schema->tray_masks + (size_t)tray * schema->mask_words;
}

/* The record of that value. */
static inline const tn_value_record *tn_tray_value_record(const tn_schema *schema, tn_tray tray, uint32_t field)
{
    return &schema->values[schema->value_start[field] + tn_tray_value(schema, tray, field)];
}

/* The tray with these values (one per field), or TN_NO_TRAY where it is forbidden. */
tn_tray tn_schema_tray(const tn_schema *schema, const uint8_t *values);

/* Index of the `forbid` specifier (in the module's SPEC records) that forbids these values, or UINT32_MAX. */
uint32_t tn_schema_forbidden_by(const tn_schema *schema, const uint8_t *values);

/* Does a tray meet a specifier (an index into the module's SPEC records, of this schema)? */
bool tn_spec_meets(const tn_schema *schema, uint32_t spec, tn_tray tray);

/* Do its trays stand for plans of a library? */
static inline bool tn_schema_of_plans(const tn_schema *schema)
{
    return schema->tray_plans != NULL;
}

/* For how many plans of a library a tray stands, a decimal number: of a schema of a library. */
static inline const char *tn_tray_plans(const tn_schema *schema, tn_tray tray)
{
    return tn_text(schema->module, schema->module->TRAY_PLANS_records[schema->tray_plans[tray]].plans);
}

/* The field named so, or UINT32_MAX. */
uint32_t tn_schema_field(const tn_schema *schema, const char *name);

/* Word `word` of a specifier (an index into the module's SPEC records). */
static inline uint64_t tn_spec_word(const tn_module *module, uint32_t spec, uint32_t word)
{
    return (uint64_t)module->MASK_records[module->SPEC_records[spec].mask_first + word].bits;
}

/* The first field of kind TN_FIELD_LENGTH (what `total` adds), or UINT32_MAX. */
uint32_t tn_schema_length_field(const tn_schema *schema);

/* The greatest common divisor of a field's lengths (a zone's depths), at least 1 nm. */
int64_t tn_schema_length_unit(const tn_schema *schema, uint32_t field);

#endif
