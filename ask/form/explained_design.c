/* explain, of a design of boxes: how its boxes were squashed, pair by pair, in order. */
#include <string.h>

#include "ask/form/form.h"
#include "driver/solid/solid.h"

static tn_status take_text(const char *text, char **to, tn_error *error)
{
    *to = strdup(text);
    return *to ? TN_OK : tn_fail_memory(error);
}

static tn_status set_squash(const tn_module *module, uint32_t solid, const tn_squash *s, tn_squashed_box *to,
                            tn_error *error)
{
    static const char *const axes[] = {"x", "y", "z"};
    to->axis = axes[s->axis];
    to->side = s->high ? "high" : "low";
    to->before = s->before;
    to->after = s->after;
    to->left = !s->whole;
    tn_status status = take_text(tn_box_named(module, solid, s->box, 0).text, &to->box, error);
    if (status == TN_OK)
        status = take_text(tn_box_named(module, solid, s->by, s->image).text, &to->by, error);
    return status == TN_OK ? take_text(tn_squash_told(module, solid, s).text, &to->told, error) : status;
}

static tn_status set_squashes(const tn_module *module, uint32_t solid, const tn_history *history, tn_reply *answer,
                              tn_error *error)
{
    tn_status status = tn_reply_new(&tn_message_explained_design, answer, error);
    tn_explained_design *design = answer->value;
    if (status == TN_OK)
        status = TN_NEW_LIST(squashed_box, design->squashes, history->count, error);
    for (size_t i = 0; i < history->count && status == TN_OK; i++)
        status = set_squash(module, solid, &history->items[i], &design->squashes.items[i], error);
    return status;
}

/* Each of these is about plans. */
static tn_status check_request(tn_session *session, const tn_explain_request *r)
{
    const tn_asked_use uses[] = {
        {r->subject.library != NULL, TN_OF_PLANS, "library"},
        {r->subject.where.count > 0, TN_OF_PLANS, "where"},
        {r->subject.has_trays, TN_OF_PLANS, "trays"},
        {r->subject.has_max_length, TN_OF_PLANS, "max-length"},
        {r->subject.has_max_states, TN_OF_PLANS, "max-states"},
        {r->rules.count > 0, TN_OF_PLANS, "rule"},
        {r->has_nearest, TN_OF_PLANS, "nearest"},
    };
    return tn_session_check_uses(session, uses, sizeof uses / sizeof *uses);
}

tn_status tn_explain_design(tn_session *session, const tn_explain_request *request, tn_reply *answer)
{
    tn_opened *opened = session->opened;
    tn_built built = {0};
    tn_error error, failed;
    uint32_t solid;
    tn_status status = check_request(session, request);
    if (status == TN_OK)
        status = tn_solid_choose(opened, request->solid.solid, &solid);
    if (status != TN_OK)
        return status;
    status = tn_built_make(opened->module, solid, (uint32_t)request->solid.max_boxes, &built, &error);
    if (status == TN_OK || status == TN_INVALID) { /* nothing is left: there is a history */
        tn_status set = set_squashes(opened->module, solid, &built.history, answer, &failed);
        if (set != TN_OK) {
            status = set;
            error = failed;
        }
    }
    tn_built_clear(&built);
    return status == TN_OK ? TN_OK : tn_solid_fail(opened, solid, &error);
}
