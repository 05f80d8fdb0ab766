/* Fields and values by name, and in words. */
#include <string.h>
#include <strings.h>

#include "compiler/plan/check/check.h"
#include "runtime/base/nearest.h"

uint32_t tn_field_find(const tn_checked_schema *schema, const char *name)
{
    for (uint32_t i = 0; i < schema->field_count; i++)
        if (strcmp(schema->fields[i].name, name) == 0)
            return i;
    return TN_NONE;
}

bool tn_field_has(const tn_checked_field *field, const char *name)
{
    if (field->kind != TN_FIELD_CHOICE && field->kind != TN_FIELD_ZONE)
        return false;
    for (uint32_t i = 0; i < field->value_count; i++)
        if (strcmp(field->values[i].name, name) == 0)
            return true;
    return false;
}

bool tn_word_is(const tn_ast_word *word, const char *text)
{
    return word->kind == TN_WORD_NAME && strcasecmp(word->text, text) == 0;
}

/* Appends to a text of limited size; what does not fit is left out. */
__attribute__((format(printf, 3, 4))) static void append(char *text, size_t size, const char *format, ...)
{
    size_t used = strlen(text);
    va_list args;
    va_start(args, format);
    vsnprintf(text + used, size - used, format, args);
    va_end(args);
}

void tn_say_values(const tn_checked_field *field, const char *fill, char *text, size_t size)
{
    enum { SHOWN = 12 };
    uint32_t matching = 0, said = 0;
    text[0] = '\0';
    for (uint32_t i = 0; i < field->value_count; i++)
        matching += !fill || strcmp(field->values[i].name, fill) == 0;
    for (uint32_t i = 0; i < field->value_count && said < SHOWN; i++) {
        const tn_checked_value *value = &field->values[i];
        if (fill && strcmp(value->name, fill) != 0)
            continue;
        append(text, size, "%s", said == 0 ? "" : said + 1 == matching ? " or " : ", ");
        if (fill)
            append(text, size, "%s", value->measure[0] ? value->measure : "without a depth");
        else
            append(text, size, "%s%s%s", value->name, value->measure[0] ? " " : "", value->measure);
        said++;
    }
    if (matching > SHOWN)
        append(text, size, " and %u more", (unsigned)(matching - SHOWN));
}

static const char *nearest_word(tn_check *check, const tn_checked_schema *schema, const char *word)
{
    const char **names = TN_NEW_ARRAY(check->arena, const char *, schema->field_count + schema->value_count);
    size_t count = 0;
    for (uint32_t f = 0; names && f < schema->field_count; f++) {
        const tn_checked_field *field = &schema->fields[f];
        names[count++] = field->name;
        for (uint32_t v = 0; v < field->value_count; v++)
            if (tn_field_has(field, field->values[v].name))
                names[count++] = field->values[v].name;
    }
    return names ? tn_nearest(word, names, count) : NULL;
}

static void report_unknown_word(tn_check *check, const tn_checked_schema *schema, const tn_ast_word *word)
{
    tn_diagnostic *d = tn_report(check->diagnostics, E_UNKNOWN_WORD, word->node.span,
                                 "`%s` is neither a field nor a value of schema `%s`", word->text, schema->name);
    tn_note(check->diagnostics, d, &schema->ast->name->node.span, "schema `%s` is here", schema->name);
    const char *near = nearest_word(check, schema, word->text);
    char fields[300] = "";
    for (uint32_t f = 0; f < schema->field_count; f++)
        append(fields, sizeof fields, "%s%s", f == 0 ? "" : ", ", schema->fields[f].name);
    if (near)
        tn_suggest(check->diagnostics, d, "%s", near);
    else
        tn_help(check->diagnostics, d, "the fields are %s", fields);
}

uint32_t tn_value_field(tn_check *check, const tn_checked_schema *schema, const tn_ast_word *word)
{
    uint32_t found = TN_NONE, count = 0;
    char list[300] = "";
    for (uint32_t f = 0; f < schema->field_count; f++) {
        if (!tn_field_has(&schema->fields[f], word->text))
            continue;
        append(list, sizeof list, "%s`%s %s`", count == 0 ? "" : " or ", schema->fields[f].name, word->text);
        found = f;
        count++;
    }
    if (count == 1)
        return found;
    if (schema->broken || word->broken)
        return TN_NONE;
    if (count == 0) {
        report_unknown_word(check, schema, word);
        return TN_NONE;
    }
    tn_diagnostic *d = tn_report(check->diagnostics, E_AMBIGUOUS_VALUE, word->node.span, "%u fields have a value `%s`",
                                 (unsigned)count, word->text);
    tn_help(check->diagnostics, d, "say which: write %s", list);
    return TN_NONE;
}

void tn_report_unit(tn_check *check, const tn_ast_word *number)
{
    if (number->broken)
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, E_NO_UNIT, number->node.span, "`%s` has no unit", number->text);
    tn_help(check->diagnostics, d, "write a length with its unit, such as `%s'` or `%sm`", number->text, number->text);
}

/* Another field of lengths that does have the value. */
static const char *other_field(const tn_checked_schema *schema, uint32_t field, int64_t length)
{
    for (uint32_t f = 0; f < schema->field_count; f++) {
        const tn_checked_field *other = &schema->fields[f];
        if (f == field || (other->kind != TN_FIELD_LENGTH && other->kind != TN_FIELD_ZONE))
            continue;
        for (uint32_t v = 0; v < other->value_count; v++)
            if (other->values[v].length == length && (other->kind == TN_FIELD_LENGTH || other->values[v].has_depth))
                return other->name;
    }
    return NULL;
}

static const char *nearest_value(tn_check *check, const tn_checked_field *field, const char *word)
{
    const char **names = TN_NEW_ARRAY(check->arena, const char *, field->value_count + 1);
    if (!names)
        return NULL;
    for (uint32_t v = 0; v < field->value_count; v++)
        names[v] = field->values[v].name;
    return tn_nearest(word, names, field->value_count);
}

void tn_report_value(tn_check *check, const tn_checked_schema *schema, uint32_t field, const tn_ast_word *word)
{
    if (schema->broken || word->broken)
        return;
    const tn_checked_field *f = &schema->fields[field];
    char legal[400];
    tn_say_values(f, NULL, legal, sizeof legal);
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_ILLEGAL_VALUE, word->node.span, "`%s` cannot be %s", f->name, word->text);
    tn_note(check->diagnostics, d, &f->ast->name->node.span, "`%s` is declared here", f->name);
    const char *other = word->kind == TN_WORD_LENGTH ? other_field(schema, field, word->value) : NULL;
    const char *near = word->kind == TN_WORD_LENGTH ? NULL : nearest_value(check, f, word->text);
    if (other) {
        tn_help(check->diagnostics, d, "it can be %s; did you mean `%s %s`?", legal, other, word->text);
    } else if (near) {
        tn_help(check->diagnostics, d, "it can be %s; did you mean `%s`?", legal, near);
        tn_replace_with(check->diagnostics, d, "%s", near);
    } else {
        tn_help(check->diagnostics, d, "it can be %s", legal);
    }
}
