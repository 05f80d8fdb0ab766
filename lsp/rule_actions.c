/* Edits of rules as pictures have them, as actions of the editor: what can be done with the part at the cursor. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compiler/plan/edit/rule_edit.h"
#include "driver/rule/tray_fields.h"
#include "lsp/features.h"
#include "runtime/load.h"

enum { SHOWN_MAX = 40 }; /* bytes of a part in a title */

/* The actions for one part. */
typedef struct offering {
    tn_document *document;
    tn_file_analysis *analysis;
    const tn_rule_tree *tree;
    uint32_t part;
    bool whole;
    json_t *list;
} offering;

/* ---- an edit as data of an action */

static const char *const operations[TN_RULE_OPERATIONS] = {
    [TN_RULE_SET] = "set",       [TN_RULE_CLEAR] = "clear",   [TN_RULE_ADD] = "add",
    [TN_RULE_WRAP] = "wrap",     [TN_RULE_UNWRAP] = "unwrap", [TN_RULE_JOIN] = "join",
    [TN_RULE_INSERT] = "insert", [TN_RULE_REMOVE] = "remove", [TN_RULE_CONDITION] = "condition",
    [TN_RULE_TEXT] = "text",
};

static json_t *write_edit(const offering *o, const tn_rule_edit *edit)
{
    json_t *data = json_pack("{s:s,s:I,s:s,s:s,s:i}", "uri", o->document->uri, "version", o->document->version, "rule",
                             o->tree->rule->name->text, "operation", operations[edit->operation], "part", edit->part);
    if (edit->at != TN_NO_RULE_PART)
        json_object_set_new(data, "at", json_integer(edit->at));
    if (edit->operation == TN_RULE_SET || edit->operation == TN_RULE_CLEAR)
        json_object_set_new(data, "item", json_integer(edit->item));
    if (edit->by)
        json_object_set_new(data, "by", json_string(edit->by));
    if (edit->text)
        json_object_set_new(data, "text", json_string(edit->text));
    return data;
}

static uint32_t number_of(const json_t *data, const char *key, uint32_t otherwise)
{
    const json_t *number = json_object_get(data, key);
    json_int_t value = json_integer_value(number);
    return json_is_integer(number) && value >= 0 && value < UINT32_MAX ? (uint32_t)value : otherwise;
}

/* False if the data are not an edit's. Texts are borrowed. */
static bool read_edit(const json_t *data, tn_rule_edit *edit)
{
    const char *operation = json_string_value(json_object_get(data, "operation"));
    *edit = (tn_rule_edit){.part = number_of(data, "part", TN_NO_RULE_PART),
                           .item = number_of(data, "item", 0),
                           .at = number_of(data, "at", TN_NO_RULE_PART),
                           .from = TN_NO_RULE_PART,
                           .text = json_string_value(json_object_get(data, "text")),
                           .by = json_string_value(json_object_get(data, "by"))};
    while (operation && edit->operation < TN_RULE_OPERATIONS && strcmp(operations[edit->operation], operation) != 0)
        edit->operation++;
    bool by = edit->operation == TN_RULE_WRAP || edit->operation == TN_RULE_JOIN;
    return operation && edit->operation < TN_RULE_OPERATIONS && (!by || edit->by);
}

/* ---- what an edit makes */

static json_t *workspace_edit(tn_document *document, tn_file_analysis *analysis, const tn_rule_edited *made)
{
    json_t *range = tn_analysis_range(analysis, (tn_span){0, made->changed.begin, made->changed.end});
    json_t *edits = json_pack("[{s:o,s:s}]", "range", range, "newText", made->insert), *changes = json_object();
    json_object_set_new(changes, document->uri, edits);
    return json_pack("{s:o}", "changes", changes);
}

/* The edit that the data mean, or NULL: out of memory, or `why` says why not. */
static json_t *make(tn_document *document, tn_file_analysis *analysis, const json_t *data, char why[TN_WHY_MAX])
{
    const char *rule = json_string_value(json_object_get(data, "rule"));
    tn_rule_edited made = {0};
    tn_rule_edit edit;
    tn_error error;
    json_t *result = NULL;
    *why = '\0';
    if (!rule || !read_edit(data, &edit)) {
        snprintf(why, TN_WHY_MAX, "this is no action of a rule");
        return NULL;
    }
    tn_status status = tn_rule_edit_make(document->text, document->size, rule, &edit, &made, &error);
    if (status == TN_OK && *made.why)
        snprintf(why, TN_WHY_MAX, "%s", made.why);
    else if (status == TN_OK)
        result = workspace_edit(document, analysis, &made);
    tn_rule_edited_clear(&made);
    return result;
}

/* ---- titles */

/* The part as it is written, blanks and line ends as one blank each, cut off if it is long. */
static void show(const offering *o, uint32_t part, char text[SHOWN_MAX + 4])
{
    tn_text_stretch own = o->tree->parts[part].own;
    size_t size = 0;
    for (uint32_t i = own.begin; i < own.end; i++) {
        char c = o->tree->text->text[i];
        bool blank = strchr(" \t\r\n", c) != NULL;
        if (blank && (size == 0 || text[size - 1] == ' '))
            continue;
        if (size >= SHOWN_MAX && ((unsigned char)c & 0xC0) != 0x80) {
            snprintf(text + size, 4, "...");
            return;
        }
        if (size < SHOWN_MAX)
            text[size++] = blank ? ' ' : c;
    }
    text[size] = '\0';
}

__attribute__((format(printf, 3, 4))) static void offer(const offering *o, tn_rule_edit edit, const char *format, ...)
{
    char title[300], why[TN_WHY_MAX];
    va_list args;
    va_start(args, format);
    vsnprintf(title, sizeof title, format, args);
    va_end(args);
    edit.part = o->part;
    edit.from = TN_NO_RULE_PART;
    json_t *data = write_edit(o, &edit);
    json_t *made = o->whole ? make(o->document, o->analysis, data, why) : NULL;
    json_t *action = json_pack("{s:s,s:s,s:o}", "title", title, "kind", "refactor.rewrite", "data", data);
    if (made)
        json_object_set_new(action, "edit", made);
    if (!o->whole || made)
        json_array_append_new(o->list, action);
    else
        json_decref(action);
}

/* ---- what is offered */

static void offer_boxes(const offering *o)
{
    tn_rule_part_kind kind = o->tree->parts[o->part].kind;
    char shown[SHOWN_MAX + 4];
    show(o, o->part, shown);
    if (kind == TN_RULE_PART_BEGINNING || kind == TN_RULE_PART_END || kind == TN_RULE_PART_GAP)
        return;
    for (size_t i = 0; tn_rule_wraps[i]; i++)
        offer(o, (tn_rule_edit){.operation = TN_RULE_WRAP, .by = tn_rule_wraps[i], .at = TN_NO_RULE_PART},
              "Put `%s` around `%s`", tn_rule_wraps[i], shown);
    static const char *const joints[] = {"and", "or"};
    for (size_t i = 0; i < 2; i++)
        offer(o, (tn_rule_edit){.operation = TN_RULE_JOIN, .by = joints[i], .text = "any", .at = TN_NO_RULE_PART},
              "Join `%s any` to `%s`", joints[i], shown);
}

static void offer_unwrapping(const offering *o)
{
    const tn_rule_part *part = &o->tree->parts[o->part];
    char shown[SHOWN_MAX + 4];
    for (uint32_t i = 0; i < part->count; i++) {
        show(o, tn_rule_part_child(o->tree, o->part, i), shown);
        offer(o, (tn_rule_edit){.operation = TN_RULE_UNWRAP, .at = i}, "Leave `%s` of `%s`", shown,
              tn_rule_part_word(part->kind));
    }
}

static void offer_removal(const offering *o)
{
    char shown[SHOWN_MAX + 4];
    show(o, o->part, shown);
    if (o->tree->parts[o->part].kind != TN_RULE_PART_ANY)
        offer(o, (tn_rule_edit){.operation = TN_RULE_REMOVE, .at = TN_NO_RULE_PART}, "Take `%s` away", shown);
}

/* Each other value of the field that an item is about, in its place. */
static void offer_values(const offering *o, const tn_schema *schema, const tn_ast_item *item, uint32_t index)
{
    uint32_t field = tn_item_field(schema, item);
    tn_span span = item->node.span;
    const char *old = o->tree->text->text + span.begin;
    if (field == UINT32_MAX)
        return;
    for (uint32_t v = 0; v < schema->fields[field].value_count; v++) {
        char *text = tn_item_text(schema, field, v, false);
        bool same = text && strlen(text) == span.end - span.begin && memcmp(text, old, span.end - span.begin) == 0;
        if (text && !same)
            offer(o, (tn_rule_edit){.operation = TN_RULE_SET, .item = index, .text = text, .at = TN_NO_RULE_PART},
                  "Ask for `%s` instead of `%.*s`", text, (int)(span.end - span.begin), old);
        free(text);
    }
}

static void offer_item(const offering *o, const tn_module *module, const tn_ast_item *item, uint32_t index)
{
    tn_span span = item->node.span;
    offer(o, (tn_rule_edit){.operation = TN_RULE_CLEAR, .item = index, .at = TN_NO_RULE_PART}, "Leave `%.*s` out",
          (int)(span.end - span.begin), o->tree->text->text + span.begin);
    for (uint32_t i = 0; module && i < module->RULE_count; i++) {
        const tn_rule_record *record = &module->RULE_records[i];
        tn_schema *schema = NULL;
        tn_error error;
        if (strcmp(tn_text(module, record->name), o->tree->rule->name->text) != 0)
            continue;
        if (tn_schema_new(module, record->schema, 0, &schema, &error) == TN_OK)
            offer_values(o, schema, item, index);
        tn_schema_free(schema);
        return;
    }
}

/* The item that the place is in, if the part is a tray. */
static void offer_items(const offering *o, size_t begin, size_t end)
{
    const tn_compilation *compiled = &o->analysis->compilation;
    uint32_t index = 0;
    tn_error error;
    for (TN_EACH(const tn_ast_item, item, o->tree->parts[o->part].expr->items)) {
        if (item->node.span.begin <= begin && end <= item->node.span.end) {
            tn_module *module = NULL;
            if (compiled->module)
                tn_module_load(compiled->module, compiled->module_size, NULL, &module, &error);
            offer_item(o, module, item, index);
            tn_module_free(module);
            return;
        }
        index++;
    }
}

static void offer_all(offering *o, size_t begin, size_t end)
{
    tn_text_stretch place = {(uint32_t)begin, (uint32_t)(end > begin ? end : begin)};
    o->part = tn_rule_part_around(o->tree, place);
    if (o->part == TN_NO_RULE_PART)
        return;
    if (o->tree->parts[o->part].kind == TN_RULE_PART_TRAY)
        offer_items(o, begin, end);
    offer_boxes(o);
    offer_unwrapping(o);
    offer_removal(o);
}

bool tn_lsp_rule_actions(tn_document *document, tn_file_analysis *analysis, size_t begin, size_t end, bool whole,
                         json_t *list)
{
    tn_rule_text text = {0};
    tn_rule_tree tree = {0};
    tn_error error;
    if (analysis->compilation.notation != TN_NOTATION(plan))
        return true;
    tn_status status = tn_rule_text_read(document->text, document->size, &text, &error);
    const tn_ast_rule *rule = status == TN_OK && text.parses ? tn_rule_text_at(&text, begin) : NULL;
    if (rule)
        status = tn_rule_tree_make(&text, rule, &tree, &error);
    offering o = {.document = document, .analysis = analysis, .tree = &tree, .whole = whole, .list = list};
    if (rule && status == TN_OK)
        offer_all(&o, begin, end);
    tn_rule_tree_clear(&tree);
    tn_rule_text_clear(&text);
    return status != TN_MEMORY;
}

/* ---- chosen */

tn_document *tn_lsp_action_document(const tn_workspace *workspace, const json_t *action)
{
    const json_t *data = json_object_get(action, "data");
    const char *uri = json_string_value(json_object_get(data, "uri"));
    tn_document *document = uri ? tn_workspace_find(workspace, uri) : NULL;
    bool same = document && json_integer_value(json_object_get(data, "version")) == document->version;
    return same ? document : NULL;
}

json_t *tn_lsp_resolve(tn_document *document, tn_file_analysis *analysis, const json_t *action, char reason[400])
{
    json_t *edit = make(document, analysis, json_object_get(action, "data"), reason);
    json_t *resolved = edit ? json_deep_copy(action) : NULL;
    if (resolved)
        json_object_set(resolved, "edit", edit);
    json_decref(edit);
    return resolved;
}
