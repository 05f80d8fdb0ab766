/* Writes JSON. A comma and a line end are written before the item that they separate from the last. */
#include "runtime/base/json.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/utf8.h"

tn_json tn_json_file(FILE *file, tn_json_layout layout)
{
    return (tn_json){.file = file, .layout = layout};
}

tn_json tn_json_text(tn_buffer *text, tn_json_layout layout)
{
    return (tn_json){.text = text, .layout = layout};
}

static void put(tn_json *json, const char *bytes, size_t size)
{
    if (json->file)
        fwrite(bytes, 1, size, json->file);
    else
        tn_buffer_append(json->text, bytes, size);
}

static void put_text(tn_json *json, const char *text)
{
    put(json, text, strlen(text));
}

/* ---- strings */

/* Goes into a string as it is, and is of ASCII. A slash is looked at, for what is before it. */
static bool is_plain(char c)
{
    return c >= ' ' && c < 0x7F && c != '"' && c != '\\' && c != '/';
}

/* The character at `at` of the text, if it is not as it is: how it is written. NULL: as it is. */
static const char *escaped(const char *text, size_t at, uint32_t character, bool broken, char escape[8])
{
    static const char named[] = "\"\\\b\f\n\r\t", letters[] = "\"\\bfnrt";
    const char *name = character && character < 0x80 ? strchr(named, (int)character) : NULL;
    if (name)
        snprintf(escape, 8, "\\%c", letters[name - named]);
    else if (character == '/' && at > 0 && text[at - 1] == '<')
        return "\\/";
    else if (broken)
        return "\xEF\xBF\xBD";
    else if (tn_character_hidden(character))
        snprintf(escape, 8, "\\u%04x", (unsigned)character & 0xFFFF);
    else
        return NULL;
    return escape;
}

/* Most strings are as they are; in a text they cost one step. */
static bool put_plain(tn_json *json, const char *text, size_t size)
{
    tn_buffer *to = json->text;
    for (size_t i = 0; to && i < size; i++)
        if (!is_plain(text[i]))
            return false;
    if (!to || !tn_buffer_reserve(to, size + 2))
        return false;
    to->data[to->size] = '"';
    memcpy(to->data + to->size + 1, text, size);
    memcpy(to->data + to->size + 1 + size, "\"", 2); /* with the zero byte that ends the text */
    to->size += size + 2;
    return true;
}

static void put_string(tn_json *json, const char *text, size_t size)
{
    size_t written = 0, step;
    if (put_plain(json, text, size))
        return;
    put(json, "\"", 1);
    for (size_t at = 0; at < size; at += step) {
        char escape[8];
        step = 1;
        if (is_plain(text[at]))
            continue;
        uint32_t character = tn_utf8_read(text + at, size - at, &step);
        const char *written_as = escaped(text, at, character, character == TN_REPLACEMENT && step == 1, escape);
        if (!written_as)
            continue;
        put(json, text + written, at - written);
        put_text(json, written_as);
        written = at + step;
    }
    put(json, text + written, size - written);
    put(json, "\"", 1);
}

/* ---- between values */

static void new_line(tn_json *json, unsigned depth)
{
    put(json, "\n", 1);
    for (unsigned i = 0; i < depth * json->layout.indent; i++)
        put(json, " ", 1);
}

/* Does each item of what is open have a line? */
static bool has_lines(const tn_json *json)
{
    return json->depth > 0 && json->depth <= json->layout.lines;
}

static void put_comma(tn_json *json)
{
    if (json->filled)
        put(json, ", ", json->layout.spaced && !has_lines(json) ? 2 : 1);
}

/* Whatever stands before a value. */
static void next(tn_json *json, const char *key)
{
    put_comma(json);
    if (has_lines(json))
        new_line(json, json->depth);
    json->filled = true;
    if (key) {
        put_string(json, key, strlen(key));
        put(json, ": ", json->layout.spaced ? 2 : 1);
    }
}

static void begin(tn_json *json, const char *key, const char *bracket)
{
    next(json, key);
    put(json, bracket, 1);
    json->depth++;
    json->filled = false;
}

static void end(tn_json *json, const char *bracket)
{
    bool lines = json->filled && has_lines(json);
    json->depth--;
    if (lines)
        new_line(json, json->depth);
    put(json, bracket, 1);
    json->filled = true;
}

void tn_json_object(tn_json *json, const char *key)
{
    begin(json, key, "{");
}

void tn_json_object_end(tn_json *json)
{
    end(json, "}");
}

void tn_json_list(tn_json *json, const char *key)
{
    begin(json, key, "[");
}

void tn_json_list_end(tn_json *json)
{
    end(json, "]");
}

void tn_json_end_line(tn_json *json)
{
    put(json, "\n", 1);
    json->filled = false;
}

/* ---- values */

void tn_json_bytes(tn_json *json, const char *key, const char *value, size_t size)
{
    next(json, key);
    put_string(json, size ? value : "", size);
}

void tn_json_string(tn_json *json, const char *key, const char *value)
{
    if (value)
        tn_json_bytes(json, key, value, strlen(value));
    else
        tn_json_null(json, key);
}

/* Three bytes in four letters; what is missing of the last three is said by `=`. */
void tn_json_base64(tn_json *json, const char *key, const uint8_t *bytes, size_t size)
{
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    next(json, key);
    put(json, "\"", 1);
    for (size_t i = 0; i < size; i += 3) {
        uint32_t three = (uint32_t)bytes[i] << 16 | (i + 1 < size ? (uint32_t)bytes[i + 1] << 8 : 0) |
                         (i + 2 < size ? bytes[i + 2] : 0);
        char four[4];
        for (size_t k = 0; k < 4; k++)
            four[k] = i + k > size ? '=' : letters[three >> (18 - 6 * k) & 63];
        put(json, four, 4);
    }
    put(json, "\"", 1);
}

void tn_json_bool(tn_json *json, const char *key, bool value)
{
    next(json, key);
    put_text(json, value ? "true" : "false");
}

void tn_json_null(tn_json *json, const char *key)
{
    next(json, key);
    put_text(json, "null");
}

void tn_json_whole(tn_json *json, const char *key, int64_t value)
{
    char digits[24];
    next(json, key);
    put(json, digits, (size_t)snprintf(digits, sizeof digits, "%" PRId64, value));
}

void tn_json_count(tn_json *json, const char *key, uint64_t value)
{
    char digits[24];
    next(json, key);
    put(json, digits, (size_t)snprintf(digits, sizeof digits, "%" PRIu64, value));
}

void tn_json_number(tn_json *json, const char *key, double value)
{
    char text[TN_NUMBER_TEXT_SIZE];
    next(json, key);
    put_text(json, isfinite(value) ? tn_number_text(value, text) : "null");
}

void tn_json_rounded(tn_json *json, const char *key, double value, int digits)
{
    char text[TN_NUMBER_TEXT_SIZE] = "null";
    next(json, key);
    if (isfinite(value))
        snprintf(text, sizeof text, "%.*g", digits, value);
    put_text(json, text);
}

void tn_json_numbers(tn_json *json, const char *key, const double *values, size_t count)
{
    tn_json_list(json, key);
    for (size_t i = 0; i < count; i++)
        tn_json_number(json, NULL, values[i]);
    tn_json_list_end(json);
}

void tn_json_digits(tn_json *json, const char *key, mpz_srcptr value)
{
    char *digits = mpz_get_str(NULL, 10, value);
    tn_json_string(json, key, digits);
    free(digits);
}

/* ---- places, and what is written already */

static void put_known(tn_json *json, const char *key, size_t number)
{
    if (number > 0)
        tn_json_count(json, key, number);
    else
        tn_json_null(json, key);
}

void tn_json_place_begin(tn_json *json, const tn_json_place *place)
{
    tn_json_string(json, "file", place->file);
    put_known(json, "line", place->line);
    put_known(json, "column", place->column);
}

void tn_json_place_whole(tn_json *json, const tn_json_place *place)
{
    tn_json_place_begin(json, place);
    put_known(json, "end_line", place->end_line);
    put_known(json, "end_column", place->end_column);
}

void tn_json_written(tn_json *json, const char *text, size_t size)
{
    if (size == 0)
        return;
    put_comma(json);
    put(json, text, size);
    json->filled = true;
}

void tn_json_written_value(tn_json *json, const char *key, const char *text)
{
    next(json, key);
    put_text(json, text ? text : "null");
}
