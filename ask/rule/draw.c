/* rule_draw: a rule as a picture whose parts say which they are. */
#include "runtime/plan/picture/draw_rule.h"

#include "ask/rule/rule.h"
#include "ask/session/made.h"
#include "ask/session/questions.h"
#include "driver/rule/tree_boxes.h"

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
