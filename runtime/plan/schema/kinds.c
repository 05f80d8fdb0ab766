/* Splits the trays of a schema into kinds, as decision diagrams. */
#include "runtime/plan/schema/kinds.h"

#include "runtime/base/watch.h"

static tn_status fail(const tn_schema *schema, tn_status status, tn_error *error)
{
    if (status != TN_LIMIT)
        return tn_fail_memory(error);
    tn_fail(error, TN_LIMIT, E_TOO_MANY_TRAYS,
            "telling the %u trays of schema %s apart as rules and measures do is too much", schema->tray_count,
            tn_text(schema->module, schema->record->name));
    tn_error_help(error, "ask about fewer rules at once, or let them compare fewer fields");
    return TN_LIMIT;
}

tn_status tn_kinds_by_kinds(tn_kinds *kinds, const tn_labelling *others, const uint32_t *numbers, tn_error *error)
{
    tn_labelling *joined;
    tn_status status = tn_watch_check(kinds->schema->module->watch, error);
    if (status != TN_OK)
        return status;
    status = tn_labelling_join(tn_kinds_of(kinds), others, numbers, &joined);
    if (status != TN_OK)
        return fail(kinds->schema, status, error);
    tn_labelling_free(kinds->made);
    kinds->made = joined;
    return TN_OK;
}

/* Splits by a test, which was made or failed, and frees it. */
static tn_status split(tn_kinds *kinds, tn_status made, tn_labelling *test, tn_error *error)
{
    if (made != TN_OK)
        return fail(kinds->schema, made, error);
    tn_status status = tn_kinds_by_kinds(kinds, test, NULL, error);
    tn_labelling_free(test);
    return status;
}

tn_status tn_kinds_by_spec(tn_kinds *kinds, uint32_t spec, tn_error *error)
{
    enum { WORDS_MAX = TN_FIELDS_MAX * TN_FIELD_VALUES_MAX / 64 };
    const tn_schema *schema = kinds->schema;
    uint64_t mask[WORDS_MAX];
    tn_labelling *test;
    for (uint32_t word = 0; word < schema->mask_words; word++)
        mask[word] = tn_spec_word(schema->module, spec, word);
    tn_status status = tn_labelling_of_box(schema->legal->values, schema->legal->fields, mask, &test);
    return split(kinds, status, test, error);
}

static tn_status by_field(tn_kinds *kinds, uint32_t field, const uint32_t *letters, tn_error *error)
{
    const tn_labelling *legal = kinds->schema->legal;
    tn_labelling *test;
    tn_status status = tn_labelling_of_field(legal->values, legal->fields, field, letters, &test);
    return split(kinds, status, test, error);
}

tn_status tn_kinds_by_lengths(tn_kinds *kinds, uint32_t field, tn_error *error)
{
    const tn_schema *schema = kinds->schema;
    const tn_value_record *values = &schema->values[schema->value_start[field]];
    uint32_t letters[TN_FIELD_VALUES_MAX];
    for (uint32_t v = 0; v < schema->fields[field].value_count; v++)
        for (letters[v] = 0; values[letters[v]].length != values[v].length;) /* the first that is as long */
            letters[v]++;
    return by_field(kinds, field, letters, error);
}

tn_status tn_kinds_by_values(tn_kinds *kinds, uint32_t field, tn_error *error)
{
    uint32_t letters[TN_FIELD_VALUES_MAX];
    for (uint32_t v = 0; v < kinds->schema->fields[field].value_count; v++)
        letters[v] = v;
    return by_field(kinds, field, letters, error);
}
