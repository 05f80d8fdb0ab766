/* Writes findings as a SARIF 2.1.0 log. */
#include "cli/source/sarif.h"

#include <ctype.h>
#include <string.h>

#define SCHEMA_URI "https://json.schemastore.org/sarif-2.1.0.json"

static const struct {
    uint32_t code;
    const char *summary;
} summaries[] = {
#define ERROR(NUMBER, NAME, SUMMARY) {NUMBER, SUMMARY},
#define WARNING(NUMBER, NAME, SUMMARY) {10000 + NUMBER, SUMMARY},
#include "runtime/base/codes.def"
#undef ERROR
#undef WARNING
};

/* Text that may hold bytes which are no UTF-8: those become a question mark. */
static json_t *text_of(const char *text)
{
    json_t *string = json_string(text ? text : "");
    if (string)
        return string;
    char *copy = strdup(text);
    for (char *c = copy; c && *c; c++)
        if ((unsigned char)*c >= 0x80)
            *c = '?';
    string = json_string(copy ? copy : "");
    free(copy);
    return string;
}

/* A path as a URI reference: bytes that a URI cannot have are written %41. */
static json_t *uri_of(const char *path)
{
    char uri[3 * 4096 + 16];
    size_t used = (size_t)snprintf(uri, sizeof uri, "%s", path[0] == '/' ? "file://" : "");
    for (const unsigned char *c = (const unsigned char *)path; *c && used + 4 < sizeof uri; c++) {
        if (isalnum(*c) || strchr("-._~/", *c))
            uri[used++] = (char)*c;
        else
            used += (size_t)snprintf(uri + used, sizeof uri - used, "%%%02X", *c);
    }
    uri[used] = '\0';
    return json_stringn(uri, used);
}

/* The column, in characters: columns are counted in bytes elsewhere. */
static size_t characters(const char *line, size_t size, size_t column)
{
    size_t count = 1;
    for (size_t i = 0; i + 1 < column && i < size; i++)
        count += ((unsigned char)line[i] & 0xC0) != 0x80;
    return count;
}

static json_t *region_of(tn_sources *sources, tn_span span)
{
    tn_place place = tn_sources_place(sources, span);
    tn_place end = tn_sources_place(sources, (tn_span){span.file, span.end, span.end});
    return json_pack("{s:I,s:I,s:I,s:I}", "startLine", (json_int_t)place.line, "startColumn",
                     (json_int_t)characters(place.line_text, place.line_size, place.column), "endLine",
                     (json_int_t)end.line, "endColumn",
                     (json_int_t)characters(end.line_text, end.line_size, end.column));
}

static json_t *location_of(tn_sources *sources, tn_span span)
{
    return json_pack("{s:{s:{s:o},s:o}}", "physicalLocation", "artifactLocation", "uri",
                     uri_of(sources->files[span.file].path), "region", region_of(sources, span));
}

/* Where the code's description is among the rules; it is added where it is new. */
static json_int_t rule_index(tn_sarif *sarif, const tn_diagnostic *item, const char *name)
{
    size_t i;
    json_t *rule;
    json_array_foreach(sarif->rules, i, rule) if (strcmp(json_string_value(json_object_get(rule, "id")), name) ==
                                                  0) return (json_int_t)i;
    const char *summary = "";
    for (size_t k = 0; k < sizeof summaries / sizeof *summaries; k++)
        if (summaries[k].code == item->code)
            summary = summaries[k].summary;
    json_array_append_new(sarif->rules,
                          json_pack("{s:s,s:{s:s},s:{s:s}}", "id", name, "shortDescription", "text", summary,
                                    "defaultConfiguration", "level", item->code >= 10000 ? "warning" : "error"));
    return (json_int_t)json_array_size(sarif->rules) - 1;
}

static json_t *related(const tn_diagnostics *list, const tn_diagnostic *item)
{
    json_t *notes = json_array();
    for (size_t i = 0; i < item->note_count; i++) {
        const tn_diagnostic_note *note = &item->notes[i];
        if (!note->has_span || note->span.file >= list->sources->count)
            continue;
        json_t *place = location_of(list->sources, note->span);
        json_object_set_new(place, "message", json_pack("{s:o}", "text", text_of(note->text)));
        json_array_append_new(notes, place);
    }
    return notes;
}

static json_t *fixes(const tn_diagnostics *list, const tn_diagnostic *item)
{
    return json_pack("[{s:{s:o},s:[{s:{s:o},s:[{s:o,s:{s:o}}]}]}]", "description", "text", text_of(item->help),
                     "artifactChanges", "artifactLocation", "uri", uri_of(list->sources->files[item->span.file].path),
                     "replacements", "deletedRegion", region_of(list->sources, item->span), "insertedContent", "text",
                     text_of(item->replacement));
}

/* What a person reads below each other: the message, notes without a place, the help. */
static json_t *message_of(const tn_diagnostic *item)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return text_of(item->message);
    fputs(item->message ? item->message : "", out);
    for (size_t i = 0; i < item->note_count; i++)
        if (!item->notes[i].has_span)
            fprintf(out, "\nnote: %s", item->notes[i].text ? item->notes[i].text : "");
    if (item->help)
        fprintf(out, "\nhelp: %s", item->help);
    fclose(out);
    json_t *message = text_of(text);
    free(text);
    return message;
}

static void add(tn_sarif *sarif, const tn_diagnostics *list, const tn_diagnostic *item)
{
    static const char *const levels[] = {[TN_NOTE] = "note", [TN_WARNING] = "warning", [TN_ERROR] = "error"};
    char name[8];
    tn_code_name(item->code, name);
    bool placed = item->has_span && item->span.file < list->sources->count;
    json_t *result = json_pack("{s:s,s:I,s:s,s:{s:o}}", "ruleId", name, "ruleIndex", rule_index(sarif, item, name),
                               "level", levels[item->severity], "message", "text", message_of(item));
    if (placed)
        json_object_set_new(result, "locations", json_pack("[o]", location_of(list->sources, item->span)));
    json_t *notes = related(list, item);
    if (json_array_size(notes) > 0)
        json_object_set(result, "relatedLocations", notes);
    json_decref(notes);
    if (placed && item->replacement)
        json_object_set_new(result, "fixes", fixes(list, item));
    json_array_append_new(sarif->results, result);
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
    *sarif = (tn_sarif){.listener.listen = listen, .results = json_array(), .rules = json_array()};
}

void tn_sarif_clear(tn_sarif *sarif)
{
    json_decref(sarif->results);
    json_decref(sarif->rules);
    *sarif = (tn_sarif){0};
}

tn_status tn_sarif_write(const tn_sarif *sarif, const char *path, tn_error *error)
{
    json_t *log = json_pack("{s:s,s:s,s:[{s:{s:{s:s,s:s,s:O}},s:s,s:O}]}", "$schema", SCHEMA_URI, "version", "2.1.0",
                            "runs", "tool", "driver", "name", "tartan", "version", TARTAN_VERSION, "rules",
                            sarif->rules, "columnKind", "unicodeCodePoints", "results", sarif->results);
    tn_output output;
    tn_status status = log ? tn_output_open(path, &output, error) : tn_fail_memory(error);
    if (status == TN_OK) {
        json_dumpf(log, output.stream, JSON_INDENT(2));
        fputc('\n', output.stream);
        status = tn_output_commit(&output, error);
    }
    json_decref(log);
    return status;
}
