/* Finds the values of fields in the words of an input text. */
#include "runtime/plan/schema/value.h"

#include <stdio.h>
#include <string.h>

#include "runtime/base/length.h"
#include "runtime/base/nearest.h"

static const char *text_of(const tn_schema *schema, tn_string string)
{
    return tn_text(schema->module, string);
}

static bool word_is(const tn_word *word, const char *text)
{
    return strlen(text) == word->size && memcmp(text, word->text, word->size) == 0;
}

/* Cuts at a whole character: bytes 10xxxxxx continue one. */
const char *tn_word_show(const tn_word *word, char shown[TN_WORD_SHOWN])
{
    size_t size = word->size;
    bool cut = size > TN_WORD_SHOWN - 4;
    if (cut) {
        size = TN_WORD_SHOWN - 4;
        while (size > 0 && ((unsigned char)word->text[size] & 0xc0) == 0x80)
            size--;
    }
    for (size_t i = 0; i < size; i++) {
        unsigned char c = (unsigned char)word->text[i];
        shown[i] = c < 0x20 || c == 0x7f ? '?' : (char)c;
    }
    strcpy(shown + size, cut ? "..." : "");
    return shown;
}

tn_status tn_word_refuse(const tn_word *word, tn_error *error)
{
    tn_error_place(error, 0, word->column, word->column + word->extent);
    return TN_INVALID;
}

/* ---- finding values */

static bool read_length(const tn_word *word, int64_t *length)
{
    return word->size > 0 && tn_length_read(word->text, word->size, false, length, NULL) == word->size;
}

uint32_t tn_value_find_zone(const tn_schema *schema, uint32_t field, const tn_word *fill, const tn_word *depth)
{
    int64_t length = 0;
    bool has_length = depth && read_length(depth, &length);
    for (uint32_t v = 0; v < schema->fields[field].value_count; v++) {
        const tn_value_record *value = &schema->values[schema->value_start[field] + v];
        if (!word_is(fill, text_of(schema, value->name)))
            continue;
        const char *measure = text_of(schema, value->measure);
        if (!depth || (*measure && (word_is(depth, measure) || (has_length && value->length == length))))
            return v;
    }
    return TN_NO_VALUE;
}

static uint32_t find_length(const tn_schema *schema, uint32_t field, const tn_word *word)
{
    int64_t length;
    if (!read_length(word, &length))
        return TN_NO_VALUE;
    for (uint32_t v = 0; v < schema->fields[field].value_count; v++) {
        if (schema->values[schema->value_start[field] + v].length == length)
            return v;
    }
    return TN_NO_VALUE;
}

uint32_t tn_value_find(const tn_schema *schema, uint32_t field, const tn_word *word)
{
    for (uint32_t v = 0; v < schema->fields[field].value_count; v++) {
        if (word_is(word, text_of(schema, schema->values[schema->value_start[field] + v].spelling)))
            return v;
    }
    if (schema->fields[field].kind == TN_FIELD_LENGTH)
        return find_length(schema, field, word);
    if (schema->fields[field].kind != TN_FIELD_ZONE)
        return TN_NO_VALUE;
    const char *colon = memchr(word->text, ':', word->size);
    if (!colon)
        return tn_value_find_zone(schema, field, word, NULL);
    tn_word fill = {.text = word->text, .size = (size_t)(colon - word->text)};
    tn_word depth = {.text = colon + 1, .size = word->size - fill.size - 1};
    return tn_value_find_zone(schema, field, &fill, &depth);
}

/* ---- messages */

/* Appends as far as there is room; what does not fit is left out whole, and "..." stands for it. */
static void append(char *text, size_t size, const char *more)
{
    size_t used = strlen(text);
    if (used >= 3 && strcmp(text + used - 3, "...") == 0)
        return;
    if (used + strlen(more) + 4 < size)
        strcpy(text + used, more);
    else
        strcpy(text + used, "...");
}

static void list_values(const tn_schema *schema, uint32_t field, char *text, size_t size)
{
    text[0] = '\0';
    uint32_t count = schema->fields[field].value_count;
    for (uint32_t v = 0; v < count; v++) {
        if (v > 0)
            append(text, size, v + 1 == count ? " or " : ", ");
        append(text, size, text_of(schema, schema->values[schema->value_start[field] + v].spelling));
    }
}

const char *tn_value_fields(const tn_schema *schema, char *text, size_t size)
{
    text[0] = '\0';
    for (uint32_t field = 0; field < schema->field_count; field++) {
        if (field > 0)
            append(text, size, " ");
        append(text, size, text_of(schema, schema->fields[field].name));
    }
    return text;
}

static uint32_t field_with_value(const tn_schema *schema, const tn_word *word)
{
    for (uint32_t field = 0; field < schema->field_count; field++) {
        if (tn_value_find(schema, field, word) != TN_NO_VALUE)
            return field;
    }
    return UINT32_MAX;
}

/* What was likely meant, into the error's help. */
static void help_value(const tn_schema *schema, uint32_t field, const tn_word *word, const char *shown, tn_error *error)
{
    const char *candidates[TN_FIELD_VALUES_MAX];
    uint32_t count = schema->fields[field].value_count;
    for (uint32_t v = 0; v < count; v++)
        candidates[v] = text_of(schema, schema->values[schema->value_start[field] + v].spelling);
    const char *near = tn_nearest(shown, candidates, count);
    tn_word before = *word; /* the comma */
    bool comma = word->size > 1 && word->text[word->size - 1] == ',';
    before.size -= comma;
    if (comma && tn_value_find(schema, field, &before) != TN_NO_VALUE) {
        tn_error_help(error, "trays are separated by a bar, ` | `, and not by a comma");
        return;
    }
    uint32_t other = field_with_value(schema, word);
    char fields[160];
    int64_t length;
    if (other != UINT32_MAX)
        tn_error_help(error, "`%s` is a value of %s; the values of a tray stand in the schema's order: %s", shown,
                      text_of(schema, schema->fields[other].name), tn_value_fields(schema, fields, sizeof fields));
    else if (near && !read_length(word, &length)) /* another length is no slip of the pen */
        tn_error_help(error, "did you mean %s?", near);
}

tn_status tn_value_unknown(const tn_schema *schema, uint32_t field, const tn_word *word, tn_error *error)
{
    char shown[TN_WORD_SHOWN], values[240];
    list_values(schema, field, values, sizeof values);
    tn_word_show(word, shown);
    tn_fail(error, TN_INVALID, E_PLAN_VALUE, "`%s` is not a value of %.60s, which can be %s", shown,
            text_of(schema, schema->fields[field].name), values);
    help_value(schema, field, word, shown, error);
    return tn_word_refuse(word, error);
}

/* The text of a specifier in the rule file, as far as it fits. */
static void spec_text(const tn_module *module, uint32_t spec, char *text, size_t size)
{
    const tn_spec_record *record = &module->SPEC_records[spec];
    text[0] = '\0';
    if (record->file >= module->SOURCE_count)
        return;
    const char *source = tn_text(module, module->SOURCE_records[record->file].text);
    size_t length = strlen(source);
    if (record->begin >= record->end || record->end > length)
        return;
    tn_word word = {.text = source + record->begin, .size = record->end - record->begin};
    bool cut = word.size > size - 4;
    snprintf(text, size, "%.*s%s", (int)(cut ? size - 4 : word.size), word.text, cut ? "..." : "");
    for (char *c = text; *c; c++)
        *c = *c == '\n' || *c == '\t' || *c == '\r' ? ' ' : *c;
}

tn_status tn_value_tray(const tn_schema *schema, const uint8_t *values, const tn_word *place, tn_tray *tray,
                        tn_error *error)
{
    *tray = tn_schema_tray(schema, values);
    if (*tray != TN_NO_TRAY)
        return TN_OK;
    char text[160] = "";
    uint32_t spec = tn_schema_forbidden_by(schema, values);
    if (spec != UINT32_MAX)
        spec_text(schema->module, spec, text, sizeof text);
    tn_fail(error, TN_INVALID, E_PLAN_FORBIDDEN, "schema %.60s has no such tray: %s",
            text_of(schema, schema->record->name), text);
    tn_error_help(error, "change one of the values that the `forbid` names");
    return tn_word_refuse(place, error);
}
