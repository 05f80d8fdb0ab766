/* rule_edit: an edit of a rule as a picture of it has them, as changes of the text. */
#include "compiler/plan/edit/rule_edit.h"

#include <stdlib.h>
#include <string.h>

#include "ask/rule/rule.h"
#include "ask/session/questions.h"
#include "compiler/common/source.h"
#include "driver/rule/tray_fields.h"
#include "runtime/base/nearest.h"

/* In the order of the request's words. */
typedef enum asked_operation {
    ASKED_STEP,
    ASKED_SET,
    ASKED_CLEAR,
    ASKED_ADD,
    ASKED_WRAP,
    ASKED_UNWRAP,
    ASKED_JOIN,
    ASKED_INSERT,
    ASKED_MOVE,
    ASKED_REMOVE,
    ASKED_CONDITION,
    ASKED_TEXT,
    ASKED_NEW,
    ASKED_OPERATIONS
} asked_operation;

static const tn_rule_operation operations[ASKED_OPERATIONS] = {
    [ASKED_SET] = TN_RULE_SET,       [ASKED_CLEAR] = TN_RULE_CLEAR,         [ASKED_ADD] = TN_RULE_ADD,
    [ASKED_WRAP] = TN_RULE_WRAP,     [ASKED_UNWRAP] = TN_RULE_UNWRAP,       [ASKED_JOIN] = TN_RULE_JOIN,
    [ASKED_INSERT] = TN_RULE_INSERT, [ASKED_MOVE] = TN_RULE_INSERT,         [ASKED_REMOVE] = TN_RULE_REMOVE,
    [ASKED_TEXT] = TN_RULE_TEXT,     [ASKED_CONDITION] = TN_RULE_CONDITION,
};

/* ---- what goes together */

static bool takes_text(asked_operation operation)
{
    return operation == ASKED_SET || operation == ASKED_ADD || operation == ASKED_JOIN || operation == ASKED_INSERT ||
           operation == ASKED_CONDITION || operation == ASKED_TEXT;
}

static tn_status check_request(tn_session *session, const tn_rule_edit_request *r)
{
    asked_operation operation = (asked_operation)r->operation;
    const struct {
        bool given, taken;
        const char *name;
    } uses[] = {
        {r->has_part, operation != ASKED_NEW, "part"},
        {r->has_item, operation == ASKED_SET || operation == ASKED_CLEAR || operation == ASKED_ADD, "item"},
        {r->field != NULL, operation == ASKED_STEP, "field"},
        {r->depth, operation == ASKED_STEP, "depth"},
        {r->by != NULL, operation == ASKED_WRAP || operation == ASKED_JOIN, "by"},
        {r->text != NULL, takes_text(operation), "text"},
        {r->has_from, operation == ASKED_MOVE || operation == ASKED_JOIN, "from"},
        {r->has_at,
         operation == ASKED_INSERT || operation == ASKED_MOVE || operation == ASKED_UNWRAP || operation == ASKED_NEW,
         "at"},
        {r->before, operation == ASKED_JOIN, "before"},
    };
    for (size_t i = 0; i < sizeof uses / sizeof *uses; i++)
        if (uses[i].given && !uses[i].taken)
            return tn_session_refuse(session, NULL, "this operation does not take `%s`", uses[i].name);
    bool put = operation == ASKED_JOIN || operation == ASKED_INSERT || operation == ASKED_MOVE;
    if (operation == ASKED_STEP && !r->field)
        return tn_session_refuse(session, NULL, "say which field's sign it is: `field`");
    if (operation == ASKED_MOVE && !r->has_from)
        return tn_session_refuse(session, NULL, "say which part is moved: `from`");
    if ((operation == ASKED_WRAP || operation == ASKED_JOIN) && !r->by)
        return tn_session_refuse(session, NULL, "say which box, or how parts are joined: `by`");
    if (takes_text(operation) && !r->text && !r->has_from)
        return tn_session_refuse(session, NULL, "say what is put there: `text`");
    if (put && r->text && r->has_from)
        return tn_session_refuse(session, NULL, "either `text` or `from` is put there, not both");
    return TN_OK;
}

/* ---- the edit */

/* Says that the trays have no such field, and which they have. */
static tn_status refuse_field(tn_session *session, const tn_schema *schema, const char *field)
{
    const char **names = calloc((size_t)schema->field_count + 1, sizeof *names);
    char all[400] = "", help[440];
    for (uint32_t i = 0; names && i < schema->field_count; i++)
        names[i] = tn_text(schema->module, schema->fields[i].name);
    if (names)
        tn_word_list(names, schema->field_count, all, sizeof all);
    snprintf(help, sizeof help, "their fields are %s", all);
    free(names);
    return tn_session_refuse(session, *all ? help : NULL, "the trays have no field `%.100s`", field);
}

/* A click on a sign becomes the edit that it means. */
static tn_status take_step(tn_session *session, const tn_rule_edit_request *r, tn_rule_edit *edit, char **text,
                           char why[TN_WHY_MAX])
{
    tn_asked_rule asked;
    tn_error error;
    tn_status status = tn_asked_rule_find(session, r->rule, 0, &asked);
    uint32_t field = status == TN_OK ? tn_schema_field(asked.schema, r->field) : UINT32_MAX;
    if (status == TN_OK && field == UINT32_MAX)
        status = refuse_field(session, asked.schema, r->field);
    else if (status == TN_OK && r->part >= asked.tree.count)
        snprintf(why, TN_WHY_MAX, "the rule has the parts 0 to %u", asked.tree.count - 1);
    else if (status == TN_OK) {
        uint32_t part = (uint32_t)r->part,
                 spec = tn_tray_field_spec(asked.schema, field, 0, asked.tree.parts[part].own);
        status = tn_tray_step(asked.schema, &asked.tree, part, spec, field, r->depth ? TN_SIGN_DEPTH : TN_SIGN_VALUE,
                              edit, text, why, &error);
        if (status != TN_OK)
            tn_session_fail(session, &error);
    }
    tn_asked_rule_clear(&asked);
    return status;
}

static tn_rule_edit edit_of(const tn_rule_edit_request *r)
{
    return (tn_rule_edit){.operation = operations[r->operation],
                          .part = (uint32_t)r->part,
                          .item = r->has_item                 ? (uint32_t)r->item
                                  : r->operation == ASKED_ADD ? UINT32_MAX
                                                              : 0,
                          .at = r->has_at ? (uint32_t)r->at : TN_NO_RULE_PART,
                          .from = r->has_from ? (uint32_t)r->from : TN_NO_RULE_PART,
                          .text = r->text,
                          .by = r->by,
                          .before = r->before};
}

static tn_status make_edit(tn_session *session, const tn_rule_edit_request *r, const tn_asked_rule *asked,
                           tn_rule_edited *made)
{
    const tn_rule_text *text = &asked->text;
    tn_rule_edit edit = edit_of(r);
    char *step = NULL;
    tn_error error;
    tn_status status = TN_OK;
    if (r->operation == ASKED_NEW) {
        size_t at = r->has_at ? tn_text_byte(text, r->at) : text->size;
        status = tn_rule_new_make(text->text, text->size, r->rule, at, made, &error);
        return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
    }
    if (r->operation == ASKED_STEP)
        status = take_step(session, r, &edit, &step, made->why);
    if (status == TN_OK && !*made->why) {
        status = tn_rule_edit_make(text->text, text->size, r->rule, &edit, made, &error);
        if (status != TN_OK)
            tn_session_fail(session, &error);
    }
    free(step);
    return status;
}

/* ---- does what it makes compile? */

/* The first error, and, if it is not in the rule that was edited, where. */
static tn_status say_error(tn_opened *opened, const char *rule, const tn_rule_edited *made, char *why, tn_error *error)
{
    const tn_diagnostics *list = &opened->compilation.diagnostics;
    const tn_diagnostic *first = NULL;
    tn_rule_text read = {0};
    for (size_t i = 0; i < list->count && !first; i++)
        if (list->items[i].severity == TN_ERROR)
            first = &list->items[i];
    tn_status status = tn_rule_text_read(made->text, made->size, &read, error);
    const tn_ast_rule *edited = status == TN_OK ? tn_rule_text_find(&read, rule) : NULL;
    bool elsewhere = first && first->has_span && first->span.file == 0 && edited &&
                     (first->span.begin < edited->top.node.span.begin || first->span.end > edited->top.node.span.end);
    if (elsewhere)
        snprintf(why, TN_WHY_MAX, "line %zu would be wrong then: %.300s",
                 tn_sources_place(&opened->compilation.sources, first->span).line, first->message);
    else
        snprintf(why, TN_WHY_MAX, "the rule would be wrong then: %.300s", tn_first_error(opened));
    tn_rule_text_clear(&read);
    return status;
}

/* The file compiled before; so the first error is the edit's. */
static tn_status compile(tn_session *session, const char *rule, tn_rule_edited *made)
{
    tn_opened opened;
    tn_error error;
    tn_status status = tn_session_open_text(session, made->text, made->size, NULL, &opened);
    if (status == TN_INVALID) {
        status = say_error(&opened, rule, made, made->why, &error);
        if (status != TN_OK)
            tn_session_fail(session, &error);
    }
    tn_close(&opened);
    return status;
}

/* ---- the answer */

/* A byte order mark is no part of the text. */
static void position_of(const tn_lines *lines, size_t mark, uint32_t offset, tn_text_position *to)
{
    size_t line, character;
    tn_lines_place(lines, offset > mark ? offset - mark : 0, &line, &character);
    to->line = line;
    to->character = character;
}

static tn_status give_edit(const tn_rule_text *text, const tn_rule_edited *made, tn_changed_rule *to, tn_error *error)
{
    if (made->changed.begin == made->changed.end && !*made->insert)
        return TN_OK;
    size_t mark = tn_text_mark(text->text, text->size);
    tn_text_edit *edit = TN_ADD(text_edit, to->edits, error);
    tn_lines lines;
    if (!edit || !tn_lines_make(&lines, text->text + mark, text->size - mark))
        return tn_fail_memory(error);
    edit->newText = strdup(made->insert);
    position_of(&lines, mark, made->changed.begin, &edit->range.start);
    position_of(&lines, mark, made->changed.end, &edit->range.end);
    tn_lines_clear(&lines);
    return edit->newText ? TN_OK : tn_fail_memory(error);
}

static tn_status give(const tn_rule_text *text, const tn_rule_edited *made, tn_changed_rule *to, tn_error *error)
{
    if (*made->why) {
        to->has_why_not = true;
        to->why_not = strdup(made->why);
        return to->why_not ? TN_OK : tn_fail_memory(error);
    }
    to->has_part = true;
    to->part = made->part;
    return give_edit(text, made, to, error);
}

tn_status tn_ask_rule_edit(tn_session *session, const tn_rule_edit_request *request, tn_reply *answer)
{
    tn_asked_rule asked;
    tn_rule_edited made = {0};
    tn_error error;
    *answer = (tn_reply){0};
    tn_status status = check_request(session, request);
    if (status != TN_OK)
        return status;
    status = tn_asked_rule_read(session, &asked);
    if (status == TN_OK)
        status = make_edit(session, request, &asked, &made);
    if (status == TN_OK && !*made.why)
        status = compile(session, request->rule, &made);
    if (status == TN_OK) {
        status = tn_reply_new(&tn_message_changed_rule, answer, &error);
        if (status == TN_OK)
            status = give(&asked.text, &made, answer->value, &error);
        if (status != TN_OK)
            tn_session_fail(session, &error);
    }
    tn_rule_edited_clear(&made);
    tn_asked_rule_clear(&asked);
    return status;
}
