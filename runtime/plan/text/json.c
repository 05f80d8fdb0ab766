/* JSON lines: {"trays": [{"width": "12'", "public": true, "machine": {"fill": "dense", "depth": "4'"}}, ...]}. */
#include <stdlib.h>
#include <string.h>

#include "runtime/plan/text/scanner.h"

#define JSON_DEPTH_MAX 64 /* of members that are skipped */

typedef struct tn_json_reading {
    tn_plan_scanner *scanner;
    const char *text;
    size_t size, at;
    size_t max_trays;
    tn_plan *plan;
    tn_error *error;
} tn_json_reading;

static void skip_blanks(tn_json_reading *json)
{
    while (json->at < json->size && strchr(" \t\r\n", json->text[json->at]) && json->text[json->at])
        json->at++;
}

/* The next character after blanks, or 0 at the end. */
static char peek(tn_json_reading *json)
{
    skip_blanks(json);
    return json->at < json->size ? json->text[json->at] : '\0';
}

static bool accept(tn_json_reading *json, char c)
{
    if (peek(json) != c || json->at >= json->size)
        return false;
    json->at++;
    return true;
}

static tn_status refuse_at(tn_json_reading *json, size_t begin, size_t end, const char *message)
{
    tn_fail(json->error, TN_INVALID, E_PLAN_SYNTAX, "%s", message);
    tn_error_place(json->error, 0, begin + 1, end + 1);
    return TN_INVALID;
}

static tn_status refuse(tn_json_reading *json, const char *message)
{
    skip_blanks(json);
    return refuse_at(json, json->at, json->at + (json->at < json->size), message);
}

/* ---- strings */

static int hex_digit(char c)
{
    if (c >= '0' && c <= '9')
        return c - '0';
    c = (char)(c | 0x20);
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/* Four hexadecimal digits at `at`, or -1. */
static long hex4(const tn_json_reading *json, size_t at)
{
    long code = 0;
    for (size_t i = at; i < at + 4; i++) {
        int digit = i < json->size ? hex_digit(json->text[i]) : -1;
        if (digit < 0)
            return -1;
        code = code * 16 + digit;
    }
    return code;
}

static bool append_utf8(tn_buffer *out, long code)
{
    char bytes[4];
    size_t size;
    if (code < 0x80) {
        bytes[0] = (char)code;
        size = 1;
    } else if (code < 0x800) {
        bytes[0] = (char)(0xc0 | code >> 6);
        size = 2;
    } else if (code < 0x10000) {
        bytes[0] = (char)(0xe0 | code >> 12);
        size = 3;
    } else {
        bytes[0] = (char)(0xf0 | code >> 18);
        size = 4;
    }
    for (size_t i = 1; i < size; i++)
        bytes[i] = (char)(0x80 | (code >> 6 * (size - 1 - i) & 0x3f));
    return tn_buffer_append(out, bytes, size);
}

/* \uXXXX, at the u; a pair of surrogates is one character. */
static tn_status read_unicode(tn_json_reading *json, tn_buffer *out)
{
    size_t begin = json->at - 1;
    long code = hex4(json, json->at + 1);
    json->at += 5;
    if (code >= 0xd800 && code < 0xdc00 && json->at + 1 < json->size && json->text[json->at] == '\\' &&
        json->text[json->at + 1] == 'u') {
        long low = hex4(json, json->at + 2);
        code = low >= 0xdc00 && low < 0xe000 ? 0x10000 + (code - 0xd800) * 0x400 + (low - 0xdc00) : -1;
        json->at += 6;
    }
    if (code <= 0 || (code >= 0xd800 && code < 0xe000))
        return refuse_at(json, begin, begin + 6, "this is not a character: \\u needs four hexadecimal digits");
    return append_utf8(out, code) ? TN_OK : tn_fail_memory(json->error);
}

static tn_status read_escape(tn_json_reading *json, tn_buffer *out)
{
    static const char names[] = "\"\\/bfnrt", meanings[] = "\"\\/\b\f\n\r\t";
    char c = ++json->at < json->size ? json->text[json->at] : '\0';
    if (c == 'u')
        return read_unicode(json, out);
    const char *name = c ? strchr(names, c) : NULL;
    if (!name)
        return refuse_at(json, json->at - 1, json->at + 1, "a backslash that JSON does not know");
    json->at++;
    return tn_buffer_append(out, &meanings[name - names], 1) ? TN_OK : tn_fail_memory(json->error);
}

/* A string into `word`, which points into the text, or, where there are escapes, into the scanner's buffer `slot`. */
static tn_status read_string(tn_json_reading *json, int slot, tn_word *word)
{
    if (peek(json) != '"')
        return refuse(json, "expected a text in double quotes here");
    size_t begin = json->at++;
    size_t start = json->at;
    tn_buffer *out = NULL;
    while (json->at < json->size && json->text[json->at] != '"') {
        if ((unsigned char)json->text[json->at] < 0x20)
            return refuse_at(json, json->at, json->at + 1, "a text may not hold control characters");
        if (json->text[json->at] != '\\' && !out) {
            json->at++;
            continue;
        }
        if (!out) {
            out = &json->scanner->unescaped[slot];
            out->size = 0;
            if (!tn_buffer_append(out, json->text + start, json->at - start))
                return tn_fail_memory(json->error);
        }
        if (json->text[json->at] == '\\') {
            tn_status status = read_escape(json, out);
            if (status != TN_OK)
                return status;
        } else if (!tn_buffer_append(out, &json->text[json->at++], 1)) {
            return tn_fail_memory(json->error);
        }
    }
    if (json->at >= json->size)
        return refuse_at(json, begin, json->size, "a text has no closing quote");
    *word = (tn_word){.text = out ? out->data : json->text + start,
                      .size = out ? out->size : json->at - start,
                      .column = begin + 1,
                      .extent = json->at + 1 - begin};
    json->at++;
    return TN_OK;
}

static bool word_is(const tn_word *word, const char *text)
{
    return word->size == strlen(text) && memcmp(word->text, text, word->size) == 0;
}

/* ---- members that mean nothing to us */

/* One string, number, true, false, null, or bracket (brackets are matched by depth alone). */
static tn_status skip_token(tn_json_reading *json, size_t *depth)
{
    char c = peek(json);
    if (c == '"') {
        tn_word word;
        return read_string(json, 0, &word);
    }
    if (c == '{' || c == '[') {
        json->at++;
        return ++*depth > JSON_DEPTH_MAX ? refuse(json, "brackets are nested too deep") : TN_OK;
    }
    if (*depth > 0 && (c == '}' || c == ']' || c == ',' || c == ':')) {
        json->at++;
        *depth -= c == '}' || c == ']';
        return TN_OK;
    }
    size_t begin = json->at;
    while (json->at < json->size && json->text[json->at] && !strchr("{}[],:\" \t\r\n", json->text[json->at]))
        json->at++;
    return json->at > begin ? TN_OK : refuse(json, "expected a value here");
}

static tn_status skip_value(tn_json_reading *json)
{
    size_t depth = 0;
    do {
        tn_status status = skip_token(json, &depth);
        if (status != TN_OK)
            return status;
    } while (depth > 0);
    return TN_OK;
}

/* ---- objects */

typedef tn_status tn_json_member(tn_json_reading *json, const tn_word *key, void *context);

/* An object, each member's value read by `member`. The key is in slot 0, for `member` to use first. */
static tn_status read_object(tn_json_reading *json, tn_json_member *member, void *context)
{
    if (!accept(json, '{'))
        return refuse(json, "expected an object in braces here");
    for (bool first = true; !accept(json, '}'); first = false) {
        tn_word key;
        if (!first && !accept(json, ','))
            return refuse(json, "expected a comma or } here");
        tn_status status = read_string(json, 0, &key);
        if (status == TN_OK && !accept(json, ':'))
            status = refuse(json, "expected a colon here");
        if (status == TN_OK)
            status = member(json, &key, context);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

static tn_status refuse_key(tn_json_reading *json, const tn_word *key, const char *message)
{
    return refuse_at(json, key->column - 1, key->column - 1 + key->extent, message);
}

static bool accept_word(tn_json_reading *json, const char *word)
{
    skip_blanks(json);
    size_t size = strlen(word);
    if (json->size - json->at < size || memcmp(json->text + json->at, word, size) != 0)
        return false;
    json->at += size;
    return true;
}

/* {"fill": "dense", "depth": "4'"} */
typedef struct tn_json_zone {
    tn_word fill, depth;
    bool has_fill, has_depth, depth_given;
} tn_json_zone;

static tn_status read_zone_member(tn_json_reading *json, const tn_word *key, void *context)
{
    tn_json_zone *zone = context;
    if (word_is(key, "fill") && !zone->has_fill) {
        zone->has_fill = true;
        return read_string(json, 1, &zone->fill);
    }
    if (!word_is(key, "depth") || zone->depth_given)
        return refuse_key(json, key, "a zone has one \"fill\" and one \"depth\"");
    zone->depth_given = true;
    if (accept_word(json, "null"))
        return TN_OK;
    zone->has_depth = true;
    return read_string(json, 2, &zone->depth);
}

static tn_status read_zone(tn_json_reading *json, uint32_t field, uint32_t *value)
{
    tn_json_zone zone = {.has_fill = false};
    size_t begin = json->at;
    tn_status status = read_object(json, read_zone_member, &zone);
    if (status != TN_OK)
        return status;
    if (!zone.has_fill)
        return refuse_at(json, begin, json->at, "a zone needs a \"fill\"");
    *value = tn_value_find_zone(json->scanner->schema, field, &zone.fill, zone.has_depth ? &zone.depth : NULL);
    if (*value != TN_NO_VALUE)
        return TN_OK;
    tn_word shown = zone.has_depth ? zone.depth : zone.fill;
    shown.column = begin + 1;
    shown.extent = json->at - begin;
    return tn_value_unknown(json->scanner->schema, field, &shown, json->error);
}

static tn_status read_value(tn_json_reading *json, uint32_t field, uint32_t *value)
{
    const tn_schema *schema = json->scanner->schema;
    tn_field_kind kind = (tn_field_kind)schema->fields[field].kind;
    char c = peek(json);
    if (kind == TN_FIELD_ZONE && c == '{')
        return read_zone(json, field, value);
    if (kind == TN_FIELD_FLAG && (c == 't' || c == 'f')) {
        *value = c == 't';
        return accept_word(json, c == 't' ? "true" : "false") ? TN_OK : refuse(json, "expected true or false here");
    }
    if (c != '"')
        return refuse(json, kind == TN_FIELD_FLAG   ? "expected true or false here"
                            : kind == TN_FIELD_ZONE ? "expected a fill, or an object with \"fill\" and \"depth\", here"
                                                    : "expected a value in double quotes here");
    tn_word word;
    tn_status status = read_string(json, 1, &word);
    if (status != TN_OK)
        return status;
    *value = tn_value_find(schema, field, &word);
    return *value == TN_NO_VALUE ? tn_value_unknown(schema, field, &word, json->error) : TN_OK;
}

/* ---- trays */

static uint32_t find_field(const tn_schema *schema, const tn_word *key)
{
    for (uint32_t field = 0; field < schema->field_count; field++) {
        if (word_is(key, tn_text(schema->module, schema->fields[field].name)))
            return field;
    }
    return UINT32_MAX;
}

static tn_status no_such_field(tn_json_reading *json, const tn_word *key)
{
    char shown[TN_WORD_SHOWN], fields[200];
    const tn_schema *schema = json->scanner->schema;
    tn_fail(json->error, TN_INVALID, E_PLAN_SYNTAX, "`%s` is not a field of schema %.60s", tn_word_show(key, shown),
            tn_text(schema->module, schema->record->name));
    tn_error_help(json->error, "its fields are: %s", tn_value_fields(schema, fields, sizeof fields));
    return tn_word_refuse(key, json->error);
}

static tn_status read_tray_member(tn_json_reading *json, const tn_word *key, void *context)
{
    (void)context;
    tn_plan_scanner *scanner = json->scanner;
    uint32_t field = find_field(scanner->schema, key);
    if (field == UINT32_MAX)
        return no_such_field(json, key);
    if (scanner->given[field])
        return refuse_key(json, key, "a tray's field is given twice");
    scanner->given[field] = true;
    uint32_t value = 0;
    tn_status status = read_value(json, field, &value);
    if (status == TN_OK)
        scanner->values[field] = (uint8_t)value;
    return status;
}

/* The bytes of the object that starts here, braces included; 0 where it does not end. */
static size_t object_extent(const tn_json_reading *json)
{
    size_t depth = 0;
    for (size_t at = json->at; at < json->size; at++) {
        char c = json->text[at];
        if (c == '{') {
            depth++;
        } else if (c == '}' && --depth == 0) {
            return at + 1 - json->at;
        } else if (c == '"') {
            for (at++; at < json->size && json->text[at] != '"'; at++)
                at += json->text[at] == '\\';
        }
    }
    return 0;
}

static tn_status read_tray(tn_json_reading *json)
{
    tn_plan_scanner *scanner = json->scanner;
    if (peek(json) != '{')
        return refuse(json, "a tray is an object in braces");
    tn_word place = {.text = json->text + json->at, .column = json->at + 1};
    place.size = place.extent = object_extent(json);
    uint64_t hash;
    tn_tray tray = tn_scanner_recall(scanner, place.text, place.size, &hash);
    if (tray != TN_NO_TRAY) {
        json->at += place.size;
        return tn_scanner_add(json->plan, tray, json->max_trays, &place, json->error);
    }
    memset(scanner->values, 0, scanner->schema->field_count);
    memset(scanner->given, 0, scanner->schema->field_count * sizeof *scanner->given);
    tn_status status = read_object(json, read_tray_member, NULL);
    place.extent = json->at + 1 - place.column;
    if (status == TN_OK)
        status = tn_value_tray(scanner->schema, scanner->values, &place, &tray, json->error);
    if (status != TN_OK)
        return status;
    if (place.extent == place.size)
        tn_scanner_learn(scanner, place.text, place.size, hash, tray);
    return tn_scanner_add(json->plan, tray, json->max_trays, &place, json->error);
}

static tn_status read_trays(tn_json_reading *json)
{
    if (!accept(json, '['))
        return refuse(json, "the trays are a list in [ ]");
    for (bool first = true; !accept(json, ']'); first = false) {
        if (!first && !accept(json, ','))
            return refuse(json, "expected a comma or ] here");
        tn_status status = read_tray(json);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

/* ---- plans */

static tn_status read_rank(tn_json_reading *json)
{
    tn_word word;
    tn_buffer *rank = &json->scanner->rank;
    tn_status status = read_string(json, 1, &word);
    rank->size = 0;
    if (status == TN_OK && !tn_buffer_append(rank, word.text, word.size))
        status = tn_fail_memory(json->error);
    return status;
}

static tn_status read_plan_member(tn_json_reading *json, const tn_word *key, void *context)
{
    bool *found = context;
    if (word_is(key, "rank") && peek(json) == '"')
        return read_rank(json);
    if (!word_is(key, "trays"))
        return skip_value(json);
    if (*found)
        return refuse_key(json, key, "the plan has \"trays\" twice");
    *found = true;
    return read_trays(json);
}

tn_status tn_scanner_json(tn_plan_scanner *scanner, const char *text, size_t length, size_t max_trays, tn_plan *plan,
                          tn_error *error)
{
    tn_json_reading json = {
        .scanner = scanner, .text = text, .size = length, .max_trays = max_trays, .plan = plan, .error = error};
    plan->length = 0;
    scanner->rank.size = 0;
    bool found = false;
    tn_status status = read_object(&json, read_plan_member, &found);
    if (status != TN_OK)
        return status;
    if (!found)
        return refuse_at(&json, 0, E_UNEXPECTED, "the object has no \"trays\"");
    return peek(&json) || json.at < json.size ? refuse(&json, "one plan a line: nothing may follow it") : TN_OK;
}

/* ---- one member of an object */

typedef struct tn_json_wanted {
    const char *name;
    tn_buffer *out;
    tn_word *place;
    bool found;
} tn_json_wanted;

static tn_status read_wanted(tn_json_reading *json, const tn_word *key, void *context)
{
    tn_json_wanted *wanted = context;
    if (!word_is(key, wanted->name))
        return skip_value(json);
    if (wanted->found)
        return refuse_key(json, key, "the object has this member twice");
    wanted->found = true;
    tn_status status = read_string(json, 1, wanted->place);
    if (status == TN_OK && !tn_buffer_append(wanted->out, wanted->place->text, wanted->place->size))
        status = tn_fail_memory(json->error);
    return status;
}

tn_status tn_json_read_text(const char *text, size_t length, const char *name, tn_buffer *out, size_t *column,
                            tn_error *error)
{
    tn_plan_scanner scanner = {0};
    tn_word place = {0};
    tn_json_reading json = {.scanner = &scanner, .text = text, .size = length, .error = error};
    tn_json_wanted wanted = {.name = name, .out = out, .place = &place};
    tn_status status = read_object(&json, read_wanted, &wanted);
    if (status == TN_OK && (peek(&json) || json.at < json.size))
        status = refuse(&json, "nothing may follow the object");
    if (status == TN_OK && !wanted.found) {
        status = tn_fail(error, TN_INVALID, E_PLAN_SYNTAX, "the object has no \"%s\"", name);
        tn_error_place(error, 0, 1, length + 1);
    }
    *column = place.column + 1;
    for (size_t i = 0; i < sizeof scanner.unescaped / sizeof *scanner.unescaped; i++)
        free(scanner.unescaped[i].data);
    return status;
}

size_t tn_json_read_column(const char *text, size_t length, size_t begin, size_t column)
{
    size_t at = begin - 1;
    for (size_t read = 1; read < column && at < length && text[at] != '"'; read++)
        at += text[at] != '\\' ? 1 : at + 1 < length && text[at + 1] == 'u' ? 6 : 2;
    return at + 1;
}
