/* rule_tree, rule_draw: a rule as the tree of parts that its picture shows, and as that picture. */
#include "ask/rule/rule.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ask/session/made.h"
#include "ask/session/questions.h"
#include "ask/source/check.h"
#include "compiler/compile.h"
#include "compiler/plan/edit/rule_edit.h"
#include "compiler/plan/syntax/program.h"
#include "driver/rule/tray_fields.h"
#include "driver/rule/tree_boxes.h"
#include "runtime/base/nearest.h"
#include "runtime/plan/picture/draw_rule.h"

/* ---- reading */

tn_status tn_asked_rule_read(tn_session *session, tn_asked_rule *asked)
{
    const tn_opened *opened = session->opened;
    tn_error error;
    *asked = (tn_asked_rule){.rule = TN_NO_RECORD};
    if (!opened->compiled)
        return tn_session_refuse(session, "name the rule file that it was built from",
                                 "%.200s is a module, and only the text of a rule file has rules that are edited",
                                 opened->path);
    if (opened->compilation.notation != TN_NOTATION(plan))
        return tn_session_refuse(session, NULL, "%.200s is not a .plan file, and only those have rules with pictures",
                                 opened->path);
    asked->sources = &session->opened->compilation.sources;
    const tn_source *source = &asked->sources->files[0];
    tn_status status = tn_rule_text_read(source->text, source->size, &asked->text, &error);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

/* The RULE record of a rule that stands in the file's own text. */
static uint32_t record_of(const tn_module *module, const char *name)
{
    for (uint32_t i = 0; i < module->RULE_count; i++)
        if (!(module->RULE_records[i].flags & TN_IMPORTED) &&
            strcmp(tn_text(module, module->RULE_records[i].name), name) == 0)
            return i;
    return TN_NO_RECORD;
}

/* The schema of a rule without a record: the one that it names, or the last that was declared. */
static uint32_t schema_named(const tn_module *module, const tn_ast_rule *rule)
{
    for (uint32_t i = 0; rule->using && i < module->SCHEMA_count; i++)
        if (strcmp(tn_text(module, module->SCHEMA_records[i].name), rule->using->text) == 0)
            return i;
    return (uint32_t)module->SCHEMA_count - 1;
}

static tn_status take_rule(tn_session *session, const tn_ast_rule *rule, tn_asked_rule *asked)
{
    const tn_module *module = session->opened->module;
    tn_error error;
    asked->rule = record_of(module, rule->name->text);
    uint32_t schema =
        asked->rule != TN_NO_RECORD ? module->RULE_records[asked->rule].schema : schema_named(module, rule);
    tn_status status = tn_rule_tree_make(&asked->text, rule, &asked->tree, &error);
    if (status == TN_OK && module->SCHEMA_count == 0)
        return tn_session_refuse(session, NULL, "%.200s has no trays", session->opened->path);
    if (status == TN_OK)
        status = tn_schema_new(module, schema, 0, &asked->schema, &error);
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

/* Says that there is no such rule, and which may be meant. */
static tn_status refuse_name(tn_session *session, const tn_rule_text *text, const char *name)
{
    const char **names = calloc(text->tree->items.count + 1, sizeof *names);
    size_t count = 0;
    char help[TN_NAME_MAX + 40];
    for (TN_EACH(const tn_ast_top, item, text->tree->items))
        if (names && item->kind == TN_ITEM_RULE)
            names[count++] = ((const tn_ast_rule *)item)->name->text;
    const char *near = names ? tn_nearest(name, names, count) : NULL;
    snprintf(help, sizeof help, "did you mean `%s`?", near ? near : "");
    tn_status status = tn_session_refuse(session, near ? help : NULL, "there is no rule `%.100s` in the text of %.200s",
                                         name, session->opened->path);
    free(names);
    return status;
}

tn_status tn_asked_rule_find(tn_session *session, const char *name, uint64_t at, tn_asked_rule *asked)
{
    tn_status status = tn_asked_rule_read(session, asked);
    if (status != TN_OK)
        return status;
    const tn_ast_rule *rule =
        name ? tn_rule_text_find(&asked->text, name) : tn_rule_text_at(&asked->text, tn_text_byte(&asked->text, at));
    if (!rule && name)
        return refuse_name(session, &asked->text, name);
    if (!rule)
        return tn_session_refuse(session, NULL, "no rule stands there");
    return take_rule(session, rule, asked);
}

void tn_asked_rule_clear(tn_asked_rule *asked)
{
    tn_rule_tree_clear(&asked->tree);
    tn_schema_free(asked->schema);
    if (asked->text.arena)
        tn_rule_text_clear(&asked->text);
}

/* ---- places and names */

size_t tn_text_byte(const tn_rule_text *text, uint64_t utf16)
{
    size_t at = tn_text_mark(text->text, text->size);
    while (at < text->size && utf16 > 0) {
        size_t size = tn_character_size(text->text + at, text->size - at);
        uint64_t units = size == 4 ? 2 : 1;
        utf16 -= units < utf16 ? units : utf16;
        at += size;
    }
    return at;
}

static bool is_among(tn_ast_list words, const char *name)
{
    for (TN_EACH(const tn_ast_word, word, words))
        if (strcmp(word->text, name) == 0)
            return true;
    return false;
}

static bool is_bound(const tn_rule_tree *tree, uint32_t part, const char *name)
{
    for (; part != TN_NO_RULE_PART; part = tree->parts[part].parent) {
        const tn_rule_part *it = &tree->parts[part];
        bool binds = it->kind == TN_RULE_PART_SOME || it->kind == TN_RULE_PART_EACH;
        if (binds && is_among(it->expr->names, name))
            return true;
    }
    return is_among(tree->rule->params, name);
}

/* Is it a rule with parameters of the text? */
static bool is_rule(const tn_rule_text *text, const char *name)
{
    const tn_ast_rule *rule = tn_rule_text_find(text, name);
    return rule != NULL;
}

/* A name in the rule at a part: "rule", "let", "param", "bound". */
static const char *asked_rule_means(const tn_session *session, const tn_asked_rule *asked, uint32_t part,
                                    const char *name)
{
    const tn_module *module = session->opened->module;
    const tn_program *program = session->opened->compilation.program;
    if (is_bound(&asked->tree, part, name))
        return "bound";
    for (uint32_t i = 0; i < module->RULE_count; i++)
        if (strcmp(tn_text(module, module->RULE_records[i].name), name) == 0)
            return "rule";
    for (size_t i = 0; i < program->param_count; i++)
        if (strcmp(program->params[i].name, name) == 0)
            return "param";
    return is_rule(&asked->text, name) ? "rule" : "let";
}

/* ---- rule_tree */

/* A tree on its way into the answer. Memory that is not there makes it fail in the end. */
typedef struct showing {
    tn_session *session;
    const tn_asked_rule *asked;
    tn_rule_shown *to;
    bool failed;
} showing;

static char *copy(showing *s, uint32_t begin, uint32_t end)
{
    char *text = strndup(s->asked->text.text + begin, end - begin);
    s->failed |= !text;
    return text;
}

static void place(showing *s, uint32_t begin, uint32_t end, tn_text_place *to)
{
    s->failed |= !tn_text_place_of(s->asked->sources, true, (tn_span){0, begin, end}, to);
}

static void add_owned(showing *s, tn_owneds *to, char *text)
{
    tn_error error;
    s->failed |= tn_owneds_add(to, text, &error) != TN_OK;
}

/* ---- parts */

static void add_item(showing *s, const tn_ast_item *item, tn_rule_part_shown *part)
{
    tn_error error;
    const tn_schema *schema = s->asked->schema;
    tn_tray_item *to = TN_ADD(tray_item, part->items, &error);
    s->failed |= !to;
    if (!to)
        return;
    uint32_t field = tn_item_field(schema, item);
    tn_span span = item->node.span;
    to->text = copy(s, span.begin, span.end);
    to->has_field = field != UINT32_MAX;
    to->field = to->has_field ? tn_text(schema->module, schema->fields[field].name) : NULL;
    to->denied = tn_item_denies(item);
    place(s, span.begin, span.end, &to->place);
}

static void name_part(showing *s, uint32_t number, const tn_ast_word *name, tn_rule_part_shown *to)
{
    const tn_rule_part *part = &s->asked->tree.parts[number];
    bool field = part->kind == TN_RULE_PART_SOME || part->kind == TN_RULE_PART_EACH || part->kind == TN_RULE_PART_SUM;
    to->has_name = to->has_name_place = to->has_means = true;
    to->name = strdup(name->text);
    s->failed |= !to->name;
    place(s, name->node.span.begin, name->node.span.end, &to->name_place);
    to->means = field ? "field" : asked_rule_means(s->session, s->asked, part->parent, name->text);
}

/* The words between the two parts of a relation: "within 12m of". */
static void relate_part(showing *s, const tn_rule_part *part, tn_rule_part_shown *to)
{
    const tn_rule_part *parts = s->asked->tree.parts;
    uint32_t begin = parts[part->first].outer.end, end = parts[part->last].outer.begin;
    const char *text = s->asked->text.text;
    while (begin < end && strchr(" \t\r\n", text[begin]))
        begin++;
    while (end > begin && strchr(" \t\r\n", text[end - 1]))
        end--;
    to->has_relation = true;
    to->relation = copy(s, begin, end);
}

static void bind_part(showing *s, const tn_rule_part *part, tn_rule_part_shown *to)
{
    to->has_binds = true;
    for (TN_EACH(const tn_ast_word, word, part->expr->names))
        add_owned(s, &to->binds, strdup(word->text));
}

static const char *form_of(tn_rule_part_kind kind)
{
    static const char *const words[] = {
        [TN_RULE_PART_LEAF] = "leaf", [TN_RULE_PART_ROW] = "row", [TN_RULE_PART_PLACES] = "places"};
    return words[tn_rule_part_form_of(kind)];
}

static void describe_part(showing *s, uint32_t number, tn_rule_part_shown *to)
{
    const tn_rule_part *part = &s->asked->tree.parts[number];
    const tn_ast_expr *expr = part->expr;
    if (expr->name && part->kind != TN_RULE_PART_TEXT)
        name_part(s, number, expr->name, to);
    tn_text_stretch condition = tn_rule_part_condition(&s->asked->tree, number);
    if (condition.end > 0) {
        to->has_condition = to->has_condition_place = true;
        to->condition = copy(s, condition.begin, condition.end);
        place(s, condition.begin, condition.end, &to->condition_place);
    }
    if (part->kind == TN_RULE_PART_NEAR || part->kind == TN_RULE_PART_EVERY_NEAR)
        relate_part(s, part, to);
    if (part->kind == TN_RULE_PART_SOME || part->kind == TN_RULE_PART_EACH)
        bind_part(s, part, to);
    if (part->kind == TN_RULE_PART_TRAY)
        for (TN_EACH(const tn_ast_item, item, expr->items))
            add_item(s, item, to);
}

static void add_part(showing *s, uint32_t number)
{
    tn_error error;
    const tn_rule_part *part = &s->asked->tree.parts[number];
    tn_rule_part_shown *to = TN_ADD(rule_part_shown, s->to->parts, &error);
    s->failed |= !to;
    if (!to)
        return;
    to->number = number;
    to->has_parent = part->parent != TN_NO_RULE_PART;
    to->parent = part->parent;
    to->kind = tn_rule_part_word(part->kind);
    to->form = form_of(part->kind);
    to->text = copy(s, part->own.begin, part->own.end);
    to->made = part->kind == TN_RULE_PART_GAP;
    place(s, part->own.begin, part->own.end, &to->place);
    place(s, part->outer.begin, part->outer.end, &to->around);
    describe_part(s, number, to);
}

/* ---- what may be put into it */

/* Each value; of a zone, each fill before its depths; of a flag, what it is before what it is not. */
static void add_items(showing *s, uint32_t field, tn_tray_field *to)
{
    const tn_schema *schema = s->asked->schema;
    const tn_field_record *record = &schema->fields[field];
    bool zone = record->kind == TN_FIELD_ZONE;
    const char *last = NULL;
    for (uint32_t v = 0; v < record->value_count; v++) {
        uint32_t value = record->kind == TN_FIELD_FLAG ? record->value_count - 1 - v : v;
        const tn_value_record *it = &schema->values[schema->value_start[field] + value];
        const char *fill = tn_text(schema->module, it->name);
        if (zone && (!last || strcmp(last, fill) != 0))
            add_owned(s, &to->items, tn_item_text(schema, field, value, true));
        if (!zone || *tn_text(schema->module, it->measure))
            add_owned(s, &to->items, tn_item_text(schema, field, value, false));
        last = fill;
    }
}

static void add_fields(showing *s)
{
    const tn_schema *schema = s->asked->schema;
    tn_error error;
    for (uint32_t f = 0; f < schema->field_count; f++) {
        tn_tray_field *to = TN_ADD(tray_field, s->to->fields, &error);
        s->failed |= !to;
        if (!to)
            return;
        to->name = tn_text(schema->module, schema->fields[f].name);
        to->doc = tn_text(schema->module, schema->fields[f].doc);
        to->zone = schema->fields[f].kind == TN_FIELD_ZONE;
        add_items(s, f, to);
    }
}

static void add_name(showing *s, const char *name, const char *means)
{
    tn_error error;
    tn_usable_name *to = TN_ADD(usable_name, s->to->names, &error);
    s->failed |= !to;
    if (!to)
        return;
    to->name = strdup(name);
    to->means = means;
    s->failed |= !to->name;
}

/* Rules about the same trays but itself, params, the text's own constants, and the rule's own words. */
static void add_names(showing *s)
{
    const tn_module *module = s->session->opened->module;
    const tn_program *program = s->session->opened->compilation.program;
    const tn_schema_record *schema = s->asked->schema->record;
    for (uint32_t i = 0; i < module->RULE_count; i++)
        if (i != s->asked->rule && &module->SCHEMA_records[module->RULE_records[i].schema] == schema)
            add_name(s, tn_text(module, module->RULE_records[i].name), "rule");
    for (size_t i = 0; i < program->param_count; i++)
        add_name(s, program->params[i].name, "param");
    for (TN_EACH(const tn_ast_top, item, s->asked->text.tree->items))
        if (item->kind == TN_ITEM_LET)
            add_name(s, ((const tn_ast_rule *)item)->name->text, "let");
    for (TN_EACH(const tn_ast_word, word, s->asked->tree.rule->params))
        add_name(s, word->text, "bound");
}

static tn_status add_boxes(tn_texts *to, tn_error *error)
{
    size_t count = 0;
    while (tn_rule_wraps[count])
        count++;
    to->items = calloc(count + 1, sizeof *to->items);
    if (!to->items)
        return tn_fail_memory(error);
    for (; to->count < count; to->count++)
        to->items[to->count] = tn_rule_wraps[to->count];
    return TN_OK;
}

/* ---- asked */

static tn_status show(showing *s, tn_error *error)
{
    const tn_ast_rule *rule = s->asked->tree.rule;
    tn_span span = rule->top.node.span;
    s->to->rule = strdup(rule->name->text);
    s->to->doc = strdup(rule->doc ? rule->doc->text : "");
    s->failed |= !s->to->rule || !s->to->doc;
    place(s, span.begin, span.end, &s->to->place);
    for (uint32_t part = 0; part < s->asked->tree.count; part++)
        add_part(s, part);
    add_fields(s);
    add_names(s);
    if (add_boxes(&s->to->boxes, error) != TN_OK || s->failed)
        return tn_fail_memory(error);
    return TN_OK;
}

tn_status tn_ask_rule_tree(tn_session *session, const tn_rule_tree_request *request, tn_reply *answer)
{
    tn_asked_rule asked;
    tn_error error;
    *answer = (tn_reply){0};
    if (!request->rule && !request->has_at)
        return tn_session_refuse(session, NULL, "say which rule: `rule`, its name, or `at`, a place");
    tn_status status = tn_asked_rule_find(session, request->rule, request->at, &asked);
    if (status == TN_OK) {
        status = tn_reply_new(&tn_message_rule_shown, answer, &error);
        showing s = {.session = session, .asked = &asked, .to = answer->value};
        if (status == TN_OK)
            status = show(&s, &error);
        if (status != TN_OK)
            tn_session_fail(session, &error);
    }
    tn_asked_rule_clear(&asked);
    return status;
}

/* ---- rule_draw */

static tn_status draw(const tn_asked_rule *asked, const tn_module *module, tn_picture *to, tn_error *error)
{
    const tn_ast_rule *rule = asked->tree.rule;
    tn_rule_boxes boxes;
    tn_status status = tn_tree_boxes(&asked->tree, module, 0, &boxes, error);
    const tn_drawn_boxes drawn = {
        .name = rule->name->text, .doc = rule->doc ? rule->doc->text : "", .boxes = &boxes, .signs = true};
    if (status == TN_OK)
        status = tn_rule_boxes_draw(asked->schema, &drawn, to, error);
    tn_rule_boxes_clear(&boxes);
    return status;
}

static tn_status give(tn_session *session, const tn_rule_draw_request *request, const tn_asked_rule *asked,
                      tn_drawn_picture *made)
{
    static const tn_file_format formats[] = {TN_FILE_SVG, TN_FILE_PNG, TN_FILE_PDF};
    tn_file_format format = formats[request->format];
    tn_picture to = tn_picture_asked(format);
    tn_error error;
    to.dpi = (uint32_t)request->dpi;
    tn_status status = draw(asked, session->opened->module, &to, &error);
    return tn_picture_give(session, format, &to, status, &error, (tn_list *)&made->files);
}

tn_status tn_ask_rule_draw(tn_session *session, const tn_rule_draw_request *request, tn_reply *answer)
{
    tn_asked_rule asked;
    tn_error error;
    *answer = (tn_reply){0};
    tn_status status = tn_asked_rule_find(session, request->rule, 0, &asked);
    if (status == TN_OK && tn_reply_new(&tn_message_drawn_picture, answer, &error) != TN_OK)
        status = tn_session_fail(session, &error);
    else if (status == TN_OK)
        status = give(session, request, &asked, answer->value);
    tn_asked_rule_clear(&asked);
    return status;
}
