/* Schemas made from others: what they are made from, whose words a text has, and what of the older ones is carried
 * over.
 *
 * A rule or clause that was written for an older schema is written out again for the newer one, with its words read as
 * the older schema's (expand.c). So it takes in new values, leaves new fields free, and stays as clear as it was.
 */
#include <string.h>

#include "compiler/plan/check/check.h"
#include "runtime/base/nearest.h"

enum { UNSEEN, OPEN, DONE };

void tn_check_base(tn_check *check, tn_checked_schema *schema)
{
    const tn_ast_word *from = schema->ast->from;
    if (!from)
        return;
    check->extends = true;
    tn_checked_schema *base = tn_check_schema_for(check, schema->unit, from, from->node.span);
    if (base && base->state == OPEN) {
        tn_diagnostic *d =
            tn_report(check->diagnostics, E_SCHEMA_CYCLE, from->node.span, "schema `%s` is made from itself%s",
                      schema->name, base == schema ? "" : ", by way of others");
        tn_note(check->diagnostics, d, &base->ast->name->node.span, "schema `%s` is here", base->name);
        tn_help(check->diagnostics, d, "leave `from %s` out, and write the fields", from->text);
        base = NULL;
    }
    if (base && base->state == UNSEEN)
        tn_check_schema(check, base);
    schema->base = base;
    schema->broken |= !base || base->broken;
}

bool tn_schema_extends(const tn_checked_schema *schema, const tn_checked_schema *older)
{
    const tn_checked_schema *base = schema ? schema->base : NULL;
    while (base && base != older)
        base = base->base;
    return base != NULL;
}

const tn_checked_schema *tn_schema_of_word(const tn_checked_schema *schema, const tn_checked_schema *older,
                                           const char *word)
{
    for (uint32_t f = 0; older && f < older->field_count; f++)
        if (strcmp(older->fields[f].name, word) == 0 || tn_field_has(&older->fields[f], word))
            return older;
    return schema;
}

/* `wide = ... | 16'` where the older schema has no field `wide`, or there is no older schema. */
static void report_no_older(tn_check *check, tn_checked_schema *schema, const tn_ast_field *field)
{
    const tn_checked_schema *base = schema->base;
    schema->broken = true;
    const char *name = field->name->text;
    if (!schema->ast->from) {
        tn_diagnostic *d = tn_report(check->diagnostics, E_OLDER_VALUES, field->name->node.span,
                                     "`...` stands for older values of `%s`, and there are none", name);
        tn_help(check->diagnostics, d, "a schema is made from another by `schema %s from SCHEMA { ... }`",
                schema->name);
        return;
    }
    const char **names = base && !base->broken ? TN_NEW_ARRAY(check->arena, const char *, base->field_count) : NULL;
    if (!names)
        return;
    for (uint32_t f = 0; f < base->field_count; f++)
        names[f] = base->fields[f].name;
    tn_diagnostic *d = tn_report(check->diagnostics, E_OLDER_VALUES, field->name->node.span,
                                 "schema `%s` has no field `%s` to add values to", base->name, name);
    tn_note(check->diagnostics, d, &base->ast->name->node.span, "schema `%s` is here", base->name);
    const char *near = tn_nearest(name, names, base->field_count);
    if (near)
        tn_suggest(check->diagnostics, d, "%s", near);
    else
        tn_help(check->diagnostics, d, "for a new field, write its values without `...`");
}

void tn_check_older_fields(tn_check *check, tn_checked_schema *schema)
{
    for (TN_EACH(const tn_ast_field, field, schema->ast->body.fields))
        if (field->extends && (!schema->base || tn_field_find(schema->base, field->name->text) == TN_NONE))
            report_no_older(check, schema, field);
}

/* The command line names measures: a newer schema has a record of each that it takes over. */
void tn_check_older_measures(tn_check *check)
{
    tn_checked *result = check->result;
    size_t rules = result->rule_count;
    for (size_t s = 0; check->extends && s < result->schema_count; s++) {
        tn_checked_schema *schema = result->schemas[s];
        for (size_t i = 0; i < rules && !schema->broken; i++) {
            tn_checked_rule *measure = result->rules[i];
            if (!measure->is_measure || measure->form || !tn_schema_extends(schema, measure->schema) ||
                !tn_import_reaches(check->imports, schema->unit, measure->unit))
                continue;
            check->schema = schema;
            check->unit = measure->unit;
            tn_checked_rule *made = tn_expand_older_measure(check, measure);
            if (made)
                made->listed = true;
        }
    }
}
