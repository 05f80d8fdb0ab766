/* Plan lines: trays separated by `|`, the values of a tray in schema order, separated by blanks. */
#include <string.h>

#include "runtime/plan/text/scanner.h"

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

/* The stretch [begin, end) of a line without the blanks at its ends. */
static tn_word trimmed(const char *line, size_t begin, size_t end)
{
    while (begin < end && is_blank(line[begin]))
        begin++;
    while (end > begin && is_blank(line[end - 1]))
        end--;
    return (tn_word){.text = line + begin, .size = end - begin, .column = begin + 1, .extent = end - begin};
}

/* Takes the first word off a trimmed text. */
static tn_word next_word(tn_word *rest)
{
    tn_word word = *rest;
    word.size = 0;
    while (word.size < rest->size && !is_blank(rest->text[word.size]))
        word.size++;
    word.extent = word.size;
    size_t skip = word.size;
    while (skip < rest->size && is_blank(rest->text[skip]))
        skip++;
    rest->text += skip;
    rest->size -= skip;
    rest->column += skip;
    return word;
}

static tn_status too_few(const tn_schema *schema, const tn_word *tray, uint32_t found, tn_error *error)
{
    char fields[200];
    tn_fail(error, TN_INVALID, E_PLAN_SYNTAX,
            "a tray has %u values, and this one ends after %u: there is none for %.60s", (unsigned)schema->field_count,
            (unsigned)found, tn_text(schema->module, schema->fields[found].name));
    tn_value_fields(schema, fields, sizeof fields);
    if (schema->fields[found].kind == TN_FIELD_FLAG)
        tn_error_help(error, "write - where a tray is not %.60s; the values in the schema's order: %s",
                      tn_text(schema->module, schema->fields[found].name), fields);
    else
        tn_error_help(error, "write the values in the schema's order: %s", fields);
    return tn_word_refuse(tray, error);
}

static tn_status too_many(const tn_schema *schema, const tn_word *word, tn_error *error)
{
    char fields[160], shown[TN_WORD_SHOWN];
    tn_fail(error, TN_INVALID, E_PLAN_SYNTAX, "a tray has %u values, and `%s` is one more",
            (unsigned)schema->field_count, tn_word_show(word, shown));
    tn_error_help(error, "separate trays with | ; the values of a tray are: %s",
                  tn_value_fields(schema, fields, sizeof fields));
    return tn_word_refuse(word, error);
}

/* The plan of a test was taken over as it is written there. */
static tn_status in_brackets(const tn_schema *schema, const tn_word *word, tn_error *error)
{
    char fields[200];
    tn_fail(error, TN_INVALID, E_PLAN_SYNTAX,
            "a plan line has no brackets: those are of plans in a rule file's tests, and of single plans on a command "
            "line");
    tn_error_help(error, "write every value of each tray, in the schema's order: %s",
                  tn_value_fields(schema, fields, sizeof fields));
    return tn_word_refuse(word, error);
}

static tn_status read_tray(tn_plan_scanner *scanner, const tn_word *text, tn_tray *tray, tn_error *error)
{
    const tn_schema *schema = scanner->schema;
    tn_word rest = *text;
    uint32_t field = 0;
    while (rest.size > 0) {
        tn_word word = next_word(&rest);
        if (field == schema->field_count)
            return too_many(schema, &word, error);
        uint32_t value = tn_value_find(schema, field, &word);
        if (value == TN_NO_VALUE && word.text[0] == '[')
            return in_brackets(schema, &word, error);
        if (value == TN_NO_VALUE)
            return tn_value_unknown(schema, field, &word, error);
        scanner->values[field++] = (uint8_t)value;
    }
    if (field < schema->field_count)
        return too_few(schema, text, field, error);
    return tn_value_tray(schema, scanner->values, text, tray, error);
}

static tn_status add_tray(tn_plan_scanner *scanner, const tn_word *text, size_t max_trays, tn_plan *plan,
                          tn_error *error)
{
    uint64_t hash;
    tn_tray tray = tn_scanner_recall(scanner, text->text, text->size, &hash);
    if (tray == TN_NO_TRAY) {
        tn_status status = read_tray(scanner, text, &tray, error);
        if (status != TN_OK)
            return status;
        tn_scanner_learn(scanner, text->text, text->size, hash, tray);
    }
    return tn_scanner_add(plan, tray, max_trays, text, error);
}

static tn_status no_tray(size_t column, tn_error *error)
{
    tn_fail(error, TN_INVALID, E_PLAN_SYNTAX, "there is no tray here");
    tn_error_help(error, "a | stands between two trays; take it away, or write the tray");
    return tn_word_refuse(&(tn_word){.column = column, .extent = 1}, error);
}

tn_status tn_scanner_line(tn_plan_scanner *scanner, const char *line, size_t length, size_t max_trays, tn_plan *plan,
                          tn_error *error)
{
    plan->length = 0;
    tn_word all = trimmed(line, 0, length);
    if (all.size == 0)
        return TN_OK;
    for (size_t begin = 0, end; begin <= length; begin = end + 1) {
        const char *bar = begin < length ? memchr(line + begin, '|', length - begin) : NULL;
        end = bar ? (size_t)(bar - line) : length;
        tn_word text = trimmed(line, begin, end);
        if (text.size == 0 && scanner->schema->field_count > 0)
            return no_tray(end < length ? end + 1 : begin, error);
        tn_status status = add_tray(scanner, &text, max_trays, plan, error);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}
