/* The table of questions: what requests.def lists, and its description for others. */
#include "ask/questions.h"

#include <inttypes.h>
#include <string.h>

#include "ask/session/questions.h"
#include "ask/session/requests.h"
#include "runtime/base/nearest.h"

/* ---- described */

/* Calls `use` with each message that the question may be answered with. */
static void each_answer(const tn_request_kind *kind, void (*use)(const tn_message *message, bool first, void *context),
                        void *context)
{
    const char *at = kind->answers;
    for (bool first = true; *at; first = false) {
        char name[60];
        size_t size = strcspn(at, " ");
        snprintf(name, sizeof name, "%.*s", (int)size, at);
        use(tn_message_named(name), first, context);
        at += size + (at[size] == ' ');
    }
}

static bool is_said(const tn_message_member *m)
{
    return m->presence != TN_UNSAID;
}

/* Is a member without which the message would be wrong? What is null stands there, too. */
static bool is_required(const tn_message_member *m)
{
    return m->presence == TN_PRESENT || m->presence == TN_NULLABLE;
}

/* Do its members stand among those of the message that has it? */
static bool is_inlined(const tn_message_member *m)
{
    return m->kind == TN_MESSAGE_PART || (m->kind == TN_MESSAGE_WRITTEN && m->of->form != TN_MESSAGE_LISTING);
}

/* What a map goes to. */
static const tn_message_member *valued(const tn_message_member *map)
{
    return &map->of->members[1];
}

/* Does some message have a member of this kind that is of this one? */
static bool is_used_as(const tn_message *message, tn_message_kind kind)
{
    for (size_t i = 0; i < tn_message_count; i++)
        for (size_t k = 0; k < tn_messages[i]->member_count; k++)
            if (tn_messages[i]->members[k].of == message && tn_messages[i]->members[k].kind == kind)
                return true;
    return false;
}

static bool is_asked_with(const tn_message *message)
{
    for (size_t i = 0; i < tn_request_kind_count; i++)
        if (tn_request_kinds[i].request == message)
            return true;
    return false;
}

/* Is it written as a whole, and not only as part of others? */
static bool is_whole(const tn_message *message)
{
    return is_asked_with(message) || is_used_as(message, TN_MESSAGE_NESTED) || is_used_as(message, TN_MESSAGE_LIST) ||
           message->form == TN_MESSAGE_LISTING ||
           (!is_used_as(message, TN_MESSAGE_PART) && !is_used_as(message, TN_MESSAGE_WRITTEN) &&
            !is_used_as(message, TN_MESSAGE_MAP));
}

/* ---- JSON Schema */

static void write_reference(tn_json *json, const char *key, const tn_message *message)
{
    char place[80];
    snprintf(place, sizeof place, "#/$defs/%s", message->name);
    if (key)
        tn_json_object(json, key);
    tn_json_string(json, "$ref", place);
    if (key)
        tn_json_object_end(json);
}

static void write_pattern(tn_json *json, const char *pattern)
{
    tn_json_string(json, "type", "string");
    tn_json_string(json, "pattern", pattern);
}

static void write_number(tn_json *json, const tn_message_member *m)
{
    tn_json_string(json, "type", "integer");
    if (m->kind == TN_MESSAGE_COUNT)
        tn_json_count(json, "minimum", m->least);
    if (m->most)
        tn_json_count(json, "maximum", m->most);
}

static void write_words(tn_json *json, const char *words)
{
    const char *word;
    size_t size;
    tn_json_string(json, "type", "string");
    tn_json_list(json, "enum");
    while ((word = tn_message_word(&words, &size)) != NULL)
        tn_json_bytes(json, NULL, word, size);
    tn_json_list_end(json);
}

static void write_items(tn_json *json, const char *pattern)
{
    tn_json_string(json, "type", "array");
    tn_json_object(json, "items");
    if (pattern)
        write_pattern(json, pattern);
    else
        tn_json_string(json, "type", "string");
    tn_json_object_end(json);
}

#define DIGITS "^[0-9]+$"
#define FRACTION "^-?[0-9]+(/[0-9]+)?$"

/* Members of the schema that is open. */
static void write_kind(tn_json *json, const tn_message_member *m)
{
    switch (m->kind) {
    case TN_MESSAGE_TEXT:
    case TN_MESSAGE_OWNED:
        tn_json_string(json, "type", "string");
        break;
    case TN_MESSAGE_TEXTS:
    case TN_MESSAGE_OWNEDS:
        write_items(json, NULL);
        break;
    case TN_MESSAGE_CHOICE:
        write_words(json, m->words);
        break;
    case TN_MESSAGE_BYTES:
        tn_json_string(json, "type", "string");
        tn_json_string(json, "contentEncoding", "base64");
        break;
    case TN_MESSAGE_FLAG:
        tn_json_string(json, "type", "boolean");
        break;
    case TN_MESSAGE_COUNT:
    case TN_MESSAGE_WHOLE:
        write_number(json, m);
        break;
    case TN_MESSAGE_REAL:
        tn_json_string(json, "type", "number");
        break;
    case TN_MESSAGE_BIG:
        write_pattern(json, DIGITS);
        break;
    case TN_MESSAGE_EXACT:
        write_pattern(json, FRACTION);
        break;
    case TN_MESSAGE_EXACTS:
        write_items(json, FRACTION);
        break;
    case TN_MESSAGE_NESTED:
        write_reference(json, NULL, m->of);
        break;
    case TN_MESSAGE_LIST:
        tn_json_string(json, "type", "array");
        write_reference(json, "items", m->of);
        break;
    case TN_MESSAGE_MAP:
        tn_json_string(json, "type", "object");
        tn_json_object(json, "additionalProperties");
        write_kind(json, valued(m));
        tn_json_object_end(json);
        break;
    case TN_MESSAGE_TRAYS:
        tn_json_string(json, "type", "array");
        tn_json_object(json, "items");
        tn_json_string(json, "type", "object");
        tn_json_object_end(json);
        break;
    case TN_MESSAGE_COUNTS:
        tn_json_string(json, "type", "array");
        tn_json_object(json, "items");
        tn_json_string(json, "type", "integer");
        tn_json_count(json, "minimum", 0);
        tn_json_object_end(json);
        break;
    case TN_MESSAGE_WRITTEN: /* of a listing */
        write_reference(json, NULL, m->of);
        break;
    case TN_MESSAGE_PART:
    case TN_MESSAGE_BOXED:
        break;
    }
}

static void write_member(tn_json *json, const char *key, const tn_message_member *m)
{
    bool nullable = m->presence == TN_NULLABLE || m->presence == TN_SOMETIMES;
    tn_json_object(json, key);
    tn_json_string(json, "description", m->doc);
    if (nullable) {
        tn_json_list(json, "anyOf");
        tn_json_object(json, NULL);
    }
    write_kind(json, m);
    if (nullable) {
        tn_json_object_end(json);
        tn_json_object(json, NULL);
        tn_json_string(json, "type", "null");
        tn_json_object_end(json);
        tn_json_list_end(json);
    }
    tn_json_object_end(json);
}

static void write_members(tn_json *json, const tn_message *message)
{
    for (size_t i = 0; i < message->member_count; i++) {
        const tn_message_member *m = &message->members[i];
        if (is_inlined(m))
            write_members(json, m->of);
        else if (is_said(m))
            write_member(json, message->form == TN_MESSAGE_TUPLE ? NULL : m->name, m);
    }
}

static void write_required(tn_json *json, const tn_message *message)
{
    for (size_t i = 0; i < message->member_count; i++) {
        const tn_message_member *m = &message->members[i];
        if (is_inlined(m))
            write_required(json, m->of);
        else if (is_said(m) && is_required(m))
            tn_json_string(json, NULL, m->name);
    }
}

/* Members of the schema that is open. */
static void write_tuple(tn_json *json, const tn_message *message)
{
    tn_json_string(json, "type", "array");
    tn_json_list(json, "prefixItems");
    write_members(json, message);
    tn_json_list_end(json);
    tn_json_bool(json, "items", false);
    tn_json_count(json, "minItems", message->member_count);
}

static void write_object(tn_json *json, const tn_message *message)
{
    tn_json_string(json, "type", "object");
    tn_json_object(json, "properties");
    write_members(json, message);
    tn_json_object_end(json);
    tn_json_list(json, "required");
    write_required(json, message);
    tn_json_list_end(json);
    tn_json_bool(json, "additionalProperties", false);
}

static void write_definition(tn_json *json, const tn_message *message)
{
    tn_json_object(json, message->name);
    tn_json_string(json, "description", message->doc);
    switch (message->form) {
    case TN_MESSAGE_OBJECT:
        write_object(json, message);
        break;
    case TN_MESSAGE_TUPLE:
        write_tuple(json, message);
        break;
    case TN_MESSAGE_LISTING:
        write_kind(json, &message->members[0]);
        break;
    }
    tn_json_object_end(json);
}

static void write_answer(const tn_message *message, bool first, void *context)
{
    tn_json *json = context;
    (void)first;
    tn_json_object(json, NULL);
    write_reference(json, NULL, message);
    tn_json_object_end(json);
}

static void write_questions(tn_json *json, bool requests)
{
    tn_json_object(json, requests ? "requests" : "answers");
    for (size_t i = 0; i < tn_request_kind_count; i++) {
        const tn_request_kind *kind = &tn_request_kinds[i];
        if (requests) {
            write_reference(json, kind->name, kind->request);
            continue;
        }
        tn_json_object(json, kind->name);
        tn_json_list(json, "anyOf");
        each_answer(kind, write_answer, json);
        tn_json_list_end(json);
        tn_json_object_end(json);
    }
    tn_json_object_end(json);
}

void tn_describe_schema(FILE *out)
{
    tn_json json = tn_json_file(out, TN_JSON_LINES);
    tn_json_object(&json, NULL);
    tn_json_string(&json, "$schema", "https://json-schema.org/draft/2020-12/schema");
    tn_json_string(&json, "title", "Questions that Tartan answers");
    write_questions(&json, true);
    write_questions(&json, false);
    tn_json_object(&json, "$defs");
    for (size_t i = 0; i < tn_message_count; i++)
        if (is_whole(tn_messages[i]))
            write_definition(&json, tn_messages[i]);
    tn_json_object_end(&json);
    tn_json_object_end(&json);
    tn_json_end_line(&json);
}

/* ---- TypeScript */

/* counted_plans as CountedPlans. */
static void write_type_name(const char *name, FILE *out)
{
    for (bool upper = true; *name; name++) {
        if (*name != '_')
            fputc(upper && *name >= 'a' && *name <= 'z' ? *name - 'a' + 'A' : *name, out);
        upper = *name == '_';
    }
}

/* "a" | "b" */
static void write_word_types(const char *words, FILE *out)
{
    const char *word, *between = "";
    size_t size;
    for (; (word = tn_message_word(&words, &size)) != NULL; between = " | ")
        fprintf(out, "%s\"%.*s\"", between, (int)size, word);
}

static void write_type(const tn_message_member *m, FILE *out)
{
    switch (m->kind) {
    case TN_MESSAGE_CHOICE:
        write_word_types(m->words, out);
        break;
    case TN_MESSAGE_FLAG:
        fputs("boolean", out);
        break;
    case TN_MESSAGE_COUNT:
    case TN_MESSAGE_WHOLE:
    case TN_MESSAGE_REAL:
        fputs("number", out);
        break;
    case TN_MESSAGE_COUNTS:
        fputs("number[]", out);
        break;
    case TN_MESSAGE_TEXTS:
    case TN_MESSAGE_OWNEDS:
    case TN_MESSAGE_EXACTS:
        fputs("string[]", out);
        break;
    case TN_MESSAGE_NESTED:
    case TN_MESSAGE_WRITTEN:
    case TN_MESSAGE_LIST:
        write_type_name(m->of->name, out);
        fputs(m->kind == TN_MESSAGE_LIST ? "[]" : "", out);
        break;
    case TN_MESSAGE_TRAYS:
        fputs("Record<string, string | boolean | { fill: string; depth?: string }>[]", out);
        break;
    case TN_MESSAGE_MAP:
        fputs("Record<string, ", out);
        write_type(valued(m), out);
        fputc('>', out);
        break;
    default:
        fputs("string", out);
    }
}

static void write_property(const tn_message_member *m, FILE *out)
{
    if (!is_said(m))
        return;
    fprintf(out, "  /** %s%s%s%s */\n  %s%s: ", m->doc, *m->unit ? " (" : "", m->unit, *m->unit ? ")" : "", m->name,
            is_required(m) ? "" : "?");
    write_type(m, out);
    fputs(m->presence == TN_NULLABLE || m->presence == TN_SOMETIMES ? " | null;\n" : ";\n", out);
}

static void write_listing_type(const tn_message *message, FILE *out)
{
    fprintf(out, "/** %s */\nexport type ", message->doc);
    write_type_name(message->name, out);
    fputs(" = ", out);
    write_type(&message->members[0], out);
    fputs(";\n\n", out);
}

static void write_tuple_type(const tn_message *message, FILE *out)
{
    fprintf(out, "/** %s */\nexport type ", message->doc);
    write_type_name(message->name, out);
    for (size_t i = 0; i < message->member_count; i++) {
        fprintf(out, "%s%s: ", i ? ", " : " = [", message->members[i].name);
        write_type(&message->members[i], out);
    }
    fputs("];\n\n", out);
}

static void write_interface(const tn_message *message, FILE *out)
{
    const char *extends = " extends ";
    fprintf(out, "/** %s */\nexport interface ", message->doc);
    write_type_name(message->name, out);
    for (size_t i = 0; i < message->member_count; i++) {
        if (!is_inlined(&message->members[i]))
            continue;
        fputs(extends, out);
        write_type_name(message->members[i].of->name, out);
        extends = ", ";
    }
    fputs(" {\n", out);
    for (size_t i = 0; i < message->member_count; i++)
        if (!is_inlined(&message->members[i]))
            write_property(&message->members[i], out);
    fputs("}\n\n", out);
}

static void write_alternative(const tn_message *message, bool first, void *context)
{
    fputs(first ? "" : " | ", context);
    write_type_name(message->name, context);
}

void tn_describe_types(FILE *out)
{
    fputs("// Requests and answers of Tartan. Counts are strings of digits, and exact values strings such as "
          "\"7/2\".\n\n",
          out);
    for (size_t i = 0; i < tn_message_count; i++)
        if (tn_messages[i]->form == TN_MESSAGE_LISTING)
            write_listing_type(tn_messages[i], out);
        else if (tn_messages[i]->form == TN_MESSAGE_TUPLE)
            write_tuple_type(tn_messages[i], out);
        else if (!is_used_as(tn_messages[i], TN_MESSAGE_MAP)) /* which is written as a Record */
            write_interface(tn_messages[i], out);
    fputs("/** What each question is asked with, and answered with. */\nexport interface Questions {\n", out);
    for (size_t i = 0; i < tn_request_kind_count; i++) {
        const tn_request_kind *kind = &tn_request_kinds[i];
        fprintf(out, "  /** %s */\n  %s: { request: ", kind->doc, kind->name);
        write_type_name(kind->request->name, out);
        fputs("; answer: ", out);
        each_answer(kind, write_alternative, out);
        fputs(" };\n", out);
    }
    fputs("}\n", out);
}

/* ---- the page */

static void write_link(const tn_message *message, FILE *out)
{
    fprintf(out, "[`%s`](#%s)", message->name, message->name);
}

static void write_listed(const tn_message *message, bool first, void *context)
{
    fputs(first ? "" : ", ", context);
    write_link(message, context);
}

/* What the column "is" says. */
static void write_row_kind(const tn_message_member *m, FILE *out)
{
    static const char *const words[] = {
        [TN_MESSAGE_TEXT] = "text",
        [TN_MESSAGE_OWNED] = "text",
        [TN_MESSAGE_TEXTS] = "texts",
        [TN_MESSAGE_OWNEDS] = "texts",
        [TN_MESSAGE_TRAYS] = "list of objects",
        [TN_MESSAGE_FLAG] = "true or false",
        [TN_MESSAGE_CHOICE] = "one of",
        [TN_MESSAGE_BYTES] = "bytes in base64",
        [TN_MESSAGE_COUNT] = "number",
        [TN_MESSAGE_COUNTS] = "numbers",
        [TN_MESSAGE_WHOLE] = "number",
        [TN_MESSAGE_REAL] = "decimal number",
        [TN_MESSAGE_BIG] = "digits",
        [TN_MESSAGE_EXACT] = "fraction",
        [TN_MESSAGE_EXACTS] = "fractions",
        [TN_MESSAGE_NESTED] = "",
        [TN_MESSAGE_WRITTEN] = "",
        [TN_MESSAGE_LIST] = "list of ",
        [TN_MESSAGE_MAP] = "names, each with ",
    };
    fputs(words[m->kind], out);
    if (m->kind == TN_MESSAGE_COUNT && m->most)
        fprintf(out, ", %" PRIu64 " to %" PRIu64, m->least, m->most);
    const char *choices = m->words ? m->words : "", *word;
    size_t size;
    for (const char *between = " "; (word = tn_message_word(&choices, &size)) != NULL; between = ", ")
        fprintf(out, "%s`%.*s`", between, (int)size, word);
    if (m->kind == TN_MESSAGE_MAP)
        write_row_kind(valued(m), out);
    else if (m->of)
        write_link(m->of, out);
    if (m->presence == TN_NULLABLE || m->presence == TN_SOMETIMES)
        fputs(", or null", out);
}

static void write_rows(const tn_message *message, FILE *out)
{
    for (size_t i = 0; i < message->member_count; i++) {
        const tn_message_member *m = &message->members[i];
        if (is_inlined(m)) {
            write_rows(m->of, out);
        } else if (is_said(m)) {
            fprintf(out, "| `%s`%s | ", m->name, is_required(m) ? "" : " (may be left out)");
            write_row_kind(m, out);
            fprintf(out, " | %s | %s |\n", m->unit, m->doc);
        }
    }
}

static void write_table(const tn_message *message, FILE *out)
{
    fprintf(out, "\n### %s\n\n%c%s%s.\n\n| member | is | of | |\n| --- | --- | --- | --- |\n", message->name,
            message->doc[0] - 'a' + 'A', message->doc + 1,
            message->form == TN_MESSAGE_TUPLE     ? "; a list of these"
            : message->form == TN_MESSAGE_LISTING ? "; this list"
                                                  : "");
    write_rows(message, out);
}

void tn_describe_page(FILE *out)
{
    fputs(
        "# Questions and answers as JSON\n\n"
        "What commands write with `--json` is what a program gets that asks the same of the [C "
        "interface](c-interface.md): "
        "`tartan_ask(session, \"count\", request, ...)`. This page lists the questions. "
        "`tartan help --requests schema` prints it as a JSON Schema, and `tartan help --requests types` as types of "
        "TypeScript; both are installed.\n\n"
        "*Digits* are a whole number as a string, since readers of JSON round large numbers. A *fraction* is a string "
        "such as `7/2`. Pictures, meshes, drawings and pages are *files* of an answer, each with its text or, in "
        "base64, its "
        "bytes.\n\n"
        "| question | asked with | answered with | |\n| --- | --- | --- | --- |\n",
        out);
    for (size_t i = 0; i < tn_request_kind_count; i++) {
        const tn_request_kind *kind = &tn_request_kinds[i];
        fprintf(out, "| `%s` | ", kind->name);
        write_link(kind->request, out);
        fputs(" | ", out);
        each_answer(kind, write_listed, out);
        fprintf(out, " | %s |\n", kind->doc);
    }
    for (size_t i = 0; i < tn_message_count; i++)
        if (is_whole(tn_messages[i]))
            write_table(tn_messages[i], out);
}

/* ---- the table */

#define TN_QUESTION(NAME, REQUEST, ANSWERS, DOC)                                                                       \
    static tn_status ask_##NAME(tn_session *session, const void *request, tn_reply *answer)                            \
    {                                                                                                                  \
        return tn_ask_##NAME(session, request, answer);                                                                \
    }
#include "ask/session/requests.def"

const tn_request_kind tn_request_kinds[] = {
#define KIND(NAME, REQUEST, ANSWERS, DOC, RUNS) {#NAME, &tn_message_##REQUEST, ANSWERS, DOC, RUNS, ask_##NAME},
#define TN_QUESTION(NAME, REQUEST, ANSWERS, DOC) KIND(NAME, REQUEST, ANSWERS, DOC, false)
#define TN_RUN_QUESTION(NAME, REQUEST, ANSWERS, DOC) KIND(NAME, REQUEST, ANSWERS, DOC, true)
#include "ask/session/requests.def"
};
const size_t tn_request_kind_count = sizeof tn_request_kinds / sizeof *tn_request_kinds;

tn_status tn_request_kind_named(const char *name, const tn_request_kind **question, tn_error *error)
{
    const char *names[sizeof tn_request_kinds / sizeof *tn_request_kinds];
    for (size_t i = 0; i < tn_request_kind_count; i++) {
        names[i] = tn_request_kinds[i].name;
        *question = &tn_request_kinds[i];
        if (strcmp(names[i], name) == 0)
            return TN_OK;
    }
    const char *near = tn_nearest(name, names, tn_request_kind_count);
    tn_fail(error, TN_INVALID, E_USAGE, "there is no question `%.80s`", name);
    if (near)
        tn_error_help(error, "did you mean `%s`?", near);
    return TN_INVALID;
}
