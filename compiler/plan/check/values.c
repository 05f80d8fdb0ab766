/* Fields and values by name, and in words. */
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "compiler/plan/check/form.h"
#include "compiler/plan/syntax/slip.h"
#include "runtime/base/length.h"
#include "runtime/base/nearest.h"

uint32_t tn_field_find(const tn_checked_schema *schema, const char *name)
{
    for (uint32_t i = 0; i < schema->field_count; i++)
        if (strcmp(schema->fields[i].name, name) == 0)
            return i;
    return TN_NONE;
}

tn_checked_number *tn_schema_number(const tn_checked_schema *schema, const char *name)
{
    for (uint32_t i = 0; i < schema->number_count; i++)
        if (strcmp(schema->numbers[i].name, name) == 0)
            return &schema->numbers[i];
    return NULL;
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

bool tn_schema_says(const tn_checked_schema *schema, const char *word)
{
    for (uint32_t f = 0; f < schema->field_count; f++)
        if (strcmp(schema->fields[f].name, word) == 0 || tn_field_has(&schema->fields[f], word))
            return true;
    return false;
}

/* A word of the schema that begins with the same five letters: `isolated` for `isolation`. */
static const char *same_stem(const tn_checked_schema *schema, const char *word)
{
    enum { STEM = 5 };
    if (strlen(word) < STEM)
        return NULL;
    for (uint32_t f = 0; f < schema->field_count; f++) {
        const tn_checked_field *field = &schema->fields[f];
        if (strncmp(field->name, word, STEM) == 0)
            return field->name;
        for (uint32_t v = 0; v < field->value_count; v++)
            if (tn_field_has(field, field->values[v].name) && strncmp(field->values[v].name, word, STEM) == 0)
                return field->values[v].name;
    }
    return NULL;
}

/* `four bed` for `four-bed`; false where the two words are none together. */
static bool join_words(const tn_checked_schema *schema, const tn_ast_word *word, char *joined, size_t size)
{
    const tn_ast_word *next = (const tn_ast_word *)word->node.next;
    if (!next || next->kind != TN_WORD_NAME)
        return false;
    snprintf(joined, size, "%s-%s", word->text, next->text);
    return tn_schema_says(schema, joined);
}

/* `non-smoking`, `inaccessible`: the word whose opposite it is, or NULL. */
static const char *opposite_of(const tn_checked_schema *schema, const char *word)
{
    static const char *const beginnings[] = {"non-", "not-", "no-", "non", "un", "in", "im", "dis"};
    for (size_t i = 0; i < sizeof beginnings / sizeof *beginnings; i++) {
        size_t size = strlen(beginnings[i]);
        if (strncmp(word, beginnings[i], size) == 0 && tn_schema_says(schema, word + size))
            return word + size;
    }
    return NULL;
}

bool tn_value_guessed(tn_check *check, const tn_checked_schema *schema, const tn_ast_word *word)
{
    char joined[80];
    return nearest_word(check, schema, word->text) || same_stem(schema, word->text) ||
           opposite_of(schema, word->text) || join_words(schema, word, joined, sizeof joined) ||
           tn_slip_find(TN_SLIP_TRAY, word->text, strlen(word->text));
}

/* The trays of a plan have no functions: the cells of a house do. */
static bool help_function(tn_check *check, const tn_checked_schema *schema, const tn_ast_word *word, tn_diagnostic *d)
{
    for (size_t i = 0; i < check->result->form_count; i++) {
        const tn_checked_form *form = check->result->forms[i];
        if (form->schema != schema || tn_form_function(form, word->text) == TN_NONE)
            continue;
        tn_help(check->diagnostics, d, "`%s` is a function of form `%s`, and no tray has one: write `cell(%s)`",
                word->text, form->name, word->text);
        return true;
    }
    return false;
}

static void report_unknown_word(tn_check *check, const tn_checked_schema *schema, const tn_ast_word *word)
{
    if (tn_refuse_param(check, schema, word))
        return;
    tn_diagnostic *d = tn_report(check->diagnostics, E_UNKNOWN_WORD, word->node.span,
                                 "`%s` is neither a field nor a value of schema `%s`", word->text, schema->name);
    tn_note(check->diagnostics, d, &schema->ast->name->node.span, "schema `%s` is here", schema->name);
    const char *near = nearest_word(check, schema, word->text);
    if (!near)
        near = same_stem(schema, word->text);
    char joined[80], fields[300] = "";
    for (uint32_t f = 0; f < schema->field_count; f++)
        append(fields, sizeof fields, "%s%s", f == 0 ? "" : ", ", schema->fields[f].name);
    const tn_slip *slip = tn_slip_find(TN_SLIP_TRAY, word->text, strlen(word->text));
    const char *opposite = opposite_of(schema, word->text);
    if (slip) {
        tn_help(check->diagnostics, d, "%s", slip->help);
        if (slip->instead)
            tn_replace_with(check->diagnostics, d, "%s", slip->instead);
    } else if (opposite) {
        tn_suggest(check->diagnostics, d, "not %s", opposite);
    } else if (near) {
        tn_suggest(check->diagnostics, d, "%s", near);
    } else if (join_words(schema, word, joined, sizeof joined)) {
        tn_help(check->diagnostics, d, "a name of several words is joined by `-`: `%s`", joined);
    } else if (!help_function(check, schema, word, d)) {
        tn_help(check->diagnostics, d, "the fields are %s", fields);
    }
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

void tn_say_items(const tn_checked_schema *schema, char *text, size_t size)
{
    enum { SHOWN = 3 };
    text[0] = '\0';
    for (uint32_t f = 0; f < schema->field_count && f < SHOWN; f++) {
        const tn_checked_field *field = &schema->fields[f];
        const tn_checked_value *value = field->value_count ? &field->values[0] : NULL;
        const char *comma = f == 0 ? "" : ", ";
        if (field->kind == TN_FIELD_FLAG)
            append(text, size, "%s`%s`, `not %s`", comma, field->name, field->name);
        else if (field->kind == TN_FIELD_LENGTH && value)
            append(text, size, "%s`%s >= %s`", comma, field->name, value->name);
        else if (value)
            append(text, size, "%s`%s %s`", comma, field->name, value->name);
    }
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

/* The first spelling of `number` with a unit that is a value of the schema: "2400mm"; false where there is none. */
static bool find_unit(const tn_checked_schema *schema, const char *number, char *text, size_t size)
{
    static const char *const units[] = {"'", "m", "mm", "cm", "\""};
    for (size_t u = 0; u < sizeof units / sizeof *units; u++) {
        int64_t length;
        snprintf(text, size, "%s%s", number, units[u]);
        if (tn_length_read(text, strlen(text), false, &length, NULL) == strlen(text) &&
            other_field(schema, TN_NONE, length))
            return true;
    }
    return false;
}

/* Does the schema measure in metres? */
static bool is_metric(const tn_checked_schema *schema)
{
    for (uint32_t f = 0; schema && f < schema->field_count; f++)
        for (uint32_t v = 0; v < schema->fields[f].value_count; v++) {
            const tn_checked_value *value = &schema->fields[f].values[v];
            const char *length = schema->fields[f].kind == TN_FIELD_LENGTH ? value->spelling : value->measure;
            if (length && *length)
                return length[strlen(length) - 1] == 'm';
        }
    return false;
}

/* `5 m`: the unit stands apart. */
static const tn_ast_word *unit_apart(const tn_ast_word *number)
{
    static const char *const units[] = {"m", "mm", "cm", "ft", "in"};
    const tn_ast_word *next = (const tn_ast_word *)number->node.next;
    for (size_t u = 0; next && next->kind == TN_WORD_NAME && u < sizeof units / sizeof *units; u++)
        if (strcmp(next->text, units[u]) == 0)
            return next;
    return NULL;
}

const tn_checked_field *tn_field_of_numbers(const tn_checked_schema *schema)
{
    for (uint32_t f = 0; schema && f < schema->field_count; f++)
        if (schema->fields[f].measured && schema->fields[f].power == 0)
            return &schema->fields[f];
    return NULL;
}

static void help_unit(tn_check *check, tn_diagnostic *d, const tn_checked_schema *schema, const char *number)
{
    const tn_checked_field *numbers = tn_field_of_numbers(schema);
    if (numbers) {
        tn_help(check->diagnostics, d, "a number stands behind the name of its field: `%s %s`; a length has a unit",
                numbers->name, number);
        return;
    }
    if (schema && schema->value_count > 0)
        tn_help(check->diagnostics, d, "write a length with its unit, such as `%s%s`", number,
                is_metric(schema) ? "m" : "'");
    else
        tn_help(check->diagnostics, d, "write a length with its unit, such as `%s'` or `%sm`", number, number);
}

void tn_report_unit(tn_check *check, const tn_checked_schema *schema, const tn_ast_word *number)
{
    if (number->broken)
        return;
    const tn_ast_word *apart = unit_apart(number);
    char meant[64];
    tn_span span = apart ? tn_span_join(number->node.span, apart->node.span) : number->node.span;
    tn_diagnostic *d = tn_report(check->diagnostics, E_NO_UNIT, span, "`%s` has no unit", number->text);
    const tn_ast_word *next = (const tn_ast_word *)number->node.next;
    uint32_t named =
        !apart && schema && next && next->kind == TN_WORD_NAME ? tn_field_find(schema, next->text) : TN_NONE;
    if (named != TN_NONE && schema->fields[named].kind != TN_FIELD_FLAG) { /* 2 floors */
        char legal[400];
        tn_say_values(&schema->fields[named], NULL, legal, sizeof legal);
        tn_help(check->diagnostics, d, "a field comes before its value, and `%s` can be %s", next->text, legal);
    } else if (apart) {
        const char *unit = strcmp(apart->text, "ft") == 0 ? "'" : strcmp(apart->text, "in") == 0 ? "\"" : apart->text;
        tn_help(check->diagnostics, d, "a unit follows its number directly: `%s%s`", number->text, unit);
        tn_replace_with(check->diagnostics, d, "%s%s", number->text, unit);
    } else if (schema && find_unit(schema, number->text, meant, sizeof meant)) {
        tn_suggest(check->diagnostics, d, "%s", meant);
    } else {
        help_unit(check, d, schema, number->text);
    }
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

/* `14' 6`: with the inches that follow without their sign, is it one of the field's? */
static bool with_inches(const tn_checked_field *field, const tn_ast_word *word, char *text, size_t size)
{
    const tn_ast_word *next = (const tn_ast_word *)word->node.next;
    int64_t length;
    if (!next || next->kind != TN_WORD_NUMBER)
        return false;
    snprintf(text, size, "%s-%s\"", word->text, next->text);
    if (tn_length_read(text, strlen(text), false, &length, NULL) != strlen(text))
        return false;
    for (uint32_t v = 0; v < field->value_count; v++)
        if (field->values[v].length == length)
            return true;
    return false;
}

void tn_report_value(tn_check *check, const tn_checked_schema *schema, uint32_t field, const tn_ast_word *word)
{
    if (schema->broken || word->broken || tn_refuse_param(check, schema, word))
        return;
    const tn_checked_field *f = &schema->fields[field];
    char legal[400];
    tn_say_values(f, NULL, legal, sizeof legal);
    tn_diagnostic *d =
        tn_report(check->diagnostics, E_ILLEGAL_VALUE, word->node.span, "`%s` cannot be %s", f->name, word->text);
    tn_note(check->diagnostics, d, &f->ast->name->node.span, "`%s` is declared here", f->name);
    const char *other = word->kind == TN_WORD_LENGTH ? other_field(schema, field, word->value) : NULL;
    char meant[64];
    if (word->kind == TN_WORD_LENGTH && with_inches(f, word, meant, sizeof meant)) {
        tn_help(check->diagnostics, d, "it can be %s; inches have a sign of their own: `%s`", legal, meant);
        return;
    }
    if (tn_word_is(word, "in") && f->kind == TN_FIELD_CHOICE && f->value_count > 1) {
        tn_help(check->diagnostics, d, "values are joined by `or`: `%s %s or %s`", f->name, f->values[0].name,
                f->values[1].name);
        return;
    }
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
