/* Writes findings as a SARIF 2.1.0 log. */
#include "cli/source/sarif.h"

#include <ctype.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include <xxhash.h>

#include "cli/source/codes.h"
#include "runtime/base/array.h"

#define SCHEMA_URI "https://json.schemastore.org/sarif-2.1.0.json"

/* Results are a list in a run, in the list of runs, in the log. */
enum { RESULTS_DEPTH = 4 };

/* A path as a URI reference: bytes that a URI cannot have are written %41. */
static void uri_json(tn_json *json, const char *path)
{
    char uri[3 * 4096 + 16];
    size_t used = (size_t)snprintf(uri, sizeof uri, "%s", path[0] == '/' ? "file://" : "");
    for (const unsigned char *c = (const unsigned char *)path; *c && used + 4 < sizeof uri; c++) {
        if (isalnum(*c) || strchr("-._~/", *c))
            uri[used++] = (char)*c;
        else
            used += (size_t)snprintf(uri + used, sizeof uri - used, "%%%02X", *c);
    }
    tn_json_object(json, "artifactLocation");
    tn_json_bytes(json, "uri", uri, used);
    tn_json_object_end(json);
}

static void text_json(tn_json *json, const char *key, const char *text)
{
    tn_json_object(json, key);
    tn_json_string(json, "text", text ? text : "");
    tn_json_object_end(json);
}

/* The column, in characters: columns are counted in bytes elsewhere. */
static size_t characters(const char *line, size_t size, size_t column)
{
    size_t count = 1;
    for (size_t i = 0; i + 1 < column && i < size; i++)
        count += ((unsigned char)line[i] & 0xC0) != 0x80;
    return count;
}

static void region_json(tn_json *json, const char *key, tn_sources *sources, tn_span span)
{
    tn_place place = tn_sources_place(sources, span);
    tn_place end = tn_sources_place(sources, (tn_span){span.file, span.end, span.end});
    tn_json_object(json, key);
    tn_json_count(json, "startLine", place.line);
    tn_json_count(json, "startColumn", characters(place.line_text, place.line_size, place.column));
    tn_json_count(json, "endLine", end.line);
    tn_json_count(json, "endColumn", characters(end.line_text, end.line_size, end.column));
    tn_json_object_end(json);
}

/* With a message, where there is one to say of it. */
static void location_json(tn_json *json, tn_sources *sources, tn_span span, const char *message)
{
    tn_json_object(json, NULL);
    tn_json_object(json, "physicalLocation");
    uri_json(json, sources->files[span.file].path);
    region_json(json, "region", sources, span);
    tn_json_object_end(json);
    if (message)
        text_json(json, "message", message);
    tn_json_object_end(json);
}

/* Where the code is among the rules; it is added where it is new. */
static size_t rule_index(tn_sarif *sarif, uint32_t code)
{
    for (size_t i = 0; i < sarif->rule_count; i++)
        if (sarif->rules[i] == code)
            return i;
    if (tn_array_reserve(&sarif->rules, &sarif->rule_capacity, sarif->rule_count, 1, sizeof *sarif->rules))
        sarif->rules[sarif->rule_count++] = code;
    else
        sarif->results.failed = true;
    return sarif->rule_count - 1;
}

static bool is_related(const tn_diagnostics *list, const tn_diagnostic_note *note)
{
    return note->has_span && note->span.file < list->sources->count;
}

static void related_json(tn_json *json, const tn_diagnostics *list, const tn_diagnostic *item)
{
    size_t count = 0;
    for (size_t i = 0; i < item->note_count; i++)
        count += is_related(list, &item->notes[i]);
    if (count == 0)
        return;
    tn_json_list(json, "relatedLocations");
    for (size_t i = 0; i < item->note_count; i++) {
        const tn_diagnostic_note *note = &item->notes[i];
        if (is_related(list, note))
            location_json(json, list->sources, note->span, note->text ? note->text : "");
    }
    tn_json_list_end(json);
}

/* One fix, of one file, in one place. */
static void fixes_json(tn_json *json, const tn_diagnostics *list, const tn_diagnostic *item)
{
    tn_json_list(json, "fixes");
    tn_json_object(json, NULL);
    text_json(json, "description", item->help);
    tn_json_list(json, "artifactChanges");
    tn_json_object(json, NULL);
    uri_json(json, list->sources->files[item->span.file].path);
    tn_json_list(json, "replacements");
    tn_json_object(json, NULL);
    region_json(json, "deletedRegion", list->sources, item->span);
    text_json(json, "insertedContent", item->replacement);
    tn_json_object_end(json);
    tn_json_list_end(json);
    tn_json_object_end(json);
    tn_json_list_end(json);
    tn_json_object_end(json);
    tn_json_list_end(json);
}

/* What a person reads below each other: the message, notes without a place, the help. */
static void message_json(tn_json *json, const tn_diagnostic *item)
{
    tn_buffer text = {0};
    tn_buffer_printf(&text, "%s", item->message ? item->message : "");
    for (size_t i = 0; i < item->note_count; i++)
        if (!item->notes[i].has_span)
            tn_buffer_printf(&text, "\nnote: %s", item->notes[i].text ? item->notes[i].text : "");
    if (item->help)
        tn_buffer_printf(&text, "\nhelp: %s", item->help);
    json->text->failed |= text.failed;
    text_json(json, "message", text.data);
    free(text.data);
}

/* What a finding is known again by after an edit elsewhere in its file: its code, the text of its line, and how many
 * such findings came before. */
static void fingerprint_json(tn_sarif *sarif, const tn_diagnostics *list, const tn_diagnostic *item)
{
    tn_json *json = &sarif->json;
    tn_place place = tn_sources_place(list->sources, item->span);
    const char *text = place.line_text;
    size_t size = place.line_size, before = 0;
    for (; size > 0 && isspace((unsigned char)*text); size--)
        text++;
    while (size > 0 && isspace((unsigned char)text[size - 1]))
        size--;
    uint64_t line = XXH3_64bits_withSeed(text, size, item->code);
    for (size_t i = 0; i < sarif->line_count; i++)
        before += sarif->lines[i] == line;
    if (tn_array_reserve(&sarif->lines, &sarif->line_capacity, sarif->line_count, 1, sizeof *sarif->lines))
        sarif->lines[sarif->line_count++] = line;
    else
        sarif->results.failed = true;
    char written[48];
    snprintf(written, sizeof written, "%016" PRIx64 ":%zu", line, before + 1);
    tn_json_object(json, "partialFingerprints");
    tn_json_string(json, "tartanLine/v1", written);
    tn_json_object_end(json);
}

static void add(tn_sarif *sarif, const tn_diagnostics *list, const tn_diagnostic *item)
{
    static const char *const levels[] = {[TN_NOTE] = "note", [TN_WARNING] = "warning", [TN_ERROR] = "error"};
    tn_json *json = &sarif->json;
    char name[8];
    tn_code_name(item->code, name);
    bool placed = item->has_span && item->span.file < list->sources->count;
    tn_json_object(json, NULL);
    tn_json_string(json, "ruleId", name);
    tn_json_count(json, "ruleIndex", rule_index(sarif, item->code));
    tn_json_string(json, "level", levels[item->severity]);
    message_json(json, item);
    if (placed) {
        tn_json_list(json, "locations");
        location_json(json, list->sources, item->span, NULL);
        tn_json_list_end(json);
        fingerprint_json(sarif, list, item);
    }
    related_json(json, list, item);
    if (placed && item->replacement)
        fixes_json(json, list, item);
    tn_json_object_end(json);
}

static void listen(tn_listener *listener, const tn_diagnostics *list)
{
    tn_sarif *sarif = (tn_sarif *)listener;
    for (size_t i = 0; i < list->count; i++)
        if (list->items[i].code != TN_CODE_NONE)
            add(sarif, list, &list->items[i]);
}

void tn_sarif_begin(tn_sarif *sarif)
{
    *sarif = (tn_sarif){.listener.listen = listen, .json = tn_json_text(&sarif->results, TN_JSON_LINES)};
    sarif->json.depth = RESULTS_DEPTH;
}

void tn_sarif_clear(tn_sarif *sarif)
{
    free(sarif->results.data);
    free(sarif->rules);
    free(sarif->lines);
    *sarif = (tn_sarif){0};
}

/* ---- the log */

/* False: out of memory. */
static bool rule_json(tn_json *json, uint32_t code)
{
    const tn_code_row *row = tn_code_row_of(code);
    tn_buffer help = {0};
    char name[8];
    tn_code_name(code, name);
    if (row)
        tn_code_explain(row, &help);
    tn_json_object(json, NULL);
    tn_json_string(json, "id", name);
    text_json(json, "shortDescription", row ? row->summary : "");
    text_json(json, "help", help.data);
    free(help.data);
    tn_json_object(json, "defaultConfiguration");
    tn_json_string(json, "level", code >= 10000 ? "warning" : "error");
    tn_json_object_end(json);
    tn_json_object_end(json);
    return !help.failed;
}

static bool tool_json(tn_json *json, const tn_sarif *sarif)
{
    bool good = true;
    tn_json_object(json, "tool");
    tn_json_object(json, "driver");
    tn_json_string(json, "name", "tartan");
    tn_json_string(json, "version", TARTAN_VERSION);
    tn_json_list(json, "rules");
    for (size_t i = 0; i < sarif->rule_count; i++)
        good = rule_json(json, sarif->rules[i]) && good;
    tn_json_list_end(json);
    tn_json_object_end(json);
    tn_json_object_end(json);
    return good;
}

static bool log_json(tn_json *json, const tn_sarif *sarif)
{
    tn_json_object(json, NULL);
    tn_json_string(json, "$schema", SCHEMA_URI);
    tn_json_string(json, "version", "2.1.0");
    tn_json_list(json, "runs");
    tn_json_object(json, NULL);
    bool good = tool_json(json, sarif);
    tn_json_string(json, "columnKind", "unicodeCodePoints");
    tn_json_list(json, "results");
    tn_json_written(json, sarif->results.data, sarif->results.size);
    tn_json_list_end(json);
    tn_json_object_end(json);
    tn_json_list_end(json);
    tn_json_object_end(json);
    tn_json_end_line(json);
    return good;
}

tn_status tn_sarif_write(const tn_sarif *sarif, const char *path, tn_error *error)
{
    tn_output output;
    tn_status status = sarif->results.failed ? tn_fail_memory(error) : tn_output_open(path, &output, error);
    if (status != TN_OK)
        return status;
    tn_json json = tn_json_file(output.stream, TN_JSON_LINES);
    if (log_json(&json, sarif))
        return tn_output_commit(&output, error);
    tn_output_discard(&output);
    return tn_fail_memory(error);
}
