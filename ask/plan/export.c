/* export: rules and models in other notations. */
#include "ask/plan/export.h"

#include <stdlib.h>
#include <string.h>

#include "ask/place/export.h"
#include "ask/session/questions.h"
#include "driver/open/open.h"
#include "driver/plan/library.h"
#include "runtime/plan/match/lower.h"
#include "runtime/plan/match/parts.h"
#include "runtime/plan/text/export_prolog.h"
#include "runtime/plan/text/export_regex.h"

typedef struct exporting {
    const tn_export_request *request;
    const tn_module *module;
    tn_schema *schema;
    uint32_t rule, library; /* of a program: TN_NO_RECORD where several are meant */
    tn_buffer text;
} exporting;

/* ---- patterns */

/* A rule alone has no lengths that would bound its sums. */
static void help_comparison(const exporting *e, uint32_t function, tn_error *error)
{
    tn_parts parts;
    bool compares = false;
    if (tn_parts_read(e->module, function, &parts, NULL) == TN_OK)
        for (uint32_t i = 0; i < parts.count; i++)
            compares |= parts.parts[i].kind == TN_PART_COMPARISON;
    if (compares)
        tn_error_help(error, "a pattern is made of a rule without a library, whose sums may only rise: "
                             "`quantity(a) <= 3`, `sum(width) < 12m`");
    tn_parts_clear(&parts);
}

static tn_status export_regex(exporting *e, tn_error *error)
{
    uint32_t function = e->module->RULE_records[e->rule].holds;
    tn_classes *classes = NULL;
    tn_lowering *lowering = NULL;
    tn_dfa *dfa = NULL;
    tn_status status = tn_classes_new(e->schema, &function, 1, &classes, error);
    if (status == TN_OK)
        status = tn_lowering_new(classes, (uint32_t)e->request->subject.max_states, &lowering, error);
    if (status == TN_OK)
        status = tn_lower(lowering, function, &dfa, error);
    if (status == TN_LIMIT)
        help_comparison(e, function, error);
    tn_buffer pattern = {0};
    if (status == TN_OK)
        status = tn_export_regex(dfa, &pattern, error);
    if (status == TN_OK && !tn_buffer_printf(&e->text, "# %s, a letter for each tray:\n",
                                             tn_text(e->module, e->module->RULE_records[e->rule].name)))
        status = tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_regex_legend(dfa, classes, &e->text, error);
    if (status == TN_OK && !tn_buffer_printf(&e->text, "%s\n", pattern.size ? pattern.data : "# matches no plan"))
        status = tn_fail_memory(error);
    free(pattern.data);
    tn_dfa_free(dfa);
    tn_lowering_free(lowering);
    tn_classes_free(classes);
    return status;
}

/* ---- rules */

/* The rule asked for, and the schema: the rule's, the library's, or the only one. */
static tn_status choose(tn_session *session, exporting *e, uint32_t *schema)
{
    if (e->request->as == TN_EXPORT_PROLOG)
        return tn_schema_choose(session->opened, e->request->subject.library, schema, &e->library);
    tn_status status = tn_rule_choose(session->opened, e->request->rule, &e->rule);
    if (status == TN_OK)
        *schema = e->module->RULE_records[e->rule].schema;
    return status;
}

static tn_status export_prolog(exporting *e, tn_error *error)
{
    tn_prolog_options options = {.fetch = e->request->fetch};
    if (e->library < e->module->LIBRARY_count)
        options.library = tn_text(e->module, e->module->LIBRARY_records[e->library].name);
    return tn_export_prolog(e->schema, &options, &e->text, error);
}

/* A program says the values with which it is one. */
static bool put_params(const tn_opened *opened, tn_buffer *text)
{
    char params[TN_PARAMS_TEXT_MAX];
    tn_opened_params_text(opened, params, sizeof params);
    return !params[0] || tn_buffer_printf(text, "%% Params: %s.\n", params);
}

static tn_status export_rules(tn_session *session, const tn_export_request *request, tn_reply *answer)
{
    exporting e = {.request = request, .module = session->opened->module, .library = TN_NO_RECORD};
    bool prolog = request->as == TN_EXPORT_PROLOG;
    uint32_t schema;
    tn_error error;
    tn_status status = choose(session, &e, &schema);
    if (status != TN_OK)
        return status;
    status = tn_schema_new(e.module, schema, 0, &e.schema, &error);
    if (status == TN_OK && prolog && !put_params(session->opened, &e.text))
        status = tn_fail_memory(&error);
    if (status == TN_OK)
        status = prolog ? export_prolog(&e, &error) : export_regex(&e, &error);
    status = status == TN_OK
                 ? tn_export_give(session, prolog ? TN_FILE_PROLOG : TN_FILE_OTHER, e.text.data, e.text.size, answer)
                 : tn_session_fail(session, &error);
    free(e.text.data);
    tn_schema_free(e.schema);
    return status;
}

/* ---- asked */

static tn_status check_drawn(tn_session *session, const tn_export_request *r)
{
    bool pcfg = r->as == TN_EXPORT_PCFG;
    if (r->model || !(pcfg || r->as == TN_EXPORT_KIT))
        return tn_session_refuse(
            session, NULL, "a model that was drawn is written as a connection grammar, --pcfg, or as a kit, --kit KIT");
    if (r->init && !pcfg)
        return tn_session_refuse(session, NULL, "--init is how a connection grammar begins: it goes with --pcfg");
    return r->init && strpbrk(r->init, "\r\n") ? tn_session_refuse(session, NULL, "--init is of one line") : TN_OK;
}

static tn_status check_rules(tn_session *session, const tn_export_request *r, const char *path)
{
    if (r->as == TN_EXPORT_KIT || r->init)
        return tn_session_refuse(session, NULL, "--%s is about an LDraw file, .ldr or .mpd, and %.200s is none",
                                 r->as == TN_EXPORT_KIT ? "kit" : "init", path);
    if (r->model && r->as != TN_EXPORT_PCFG)
        return tn_session_refuse(session, NULL, "--model is for --pcfg");
    if (r->fetch && r->as != TN_EXPORT_PROLOG)
        return tn_session_refuse(session, NULL, "--fetch is for --prolog");
    if (r->as == TN_EXPORT_REGEX && !r->rule)
        return tn_session_refuse(session, NULL, "a pattern is of one rule: --rule NAME");
    if (r->as == TN_EXPORT_PROLOG && r->rule)
        return tn_session_refuse(session, NULL, "--prolog writes all rules; --rule is for --regex");
    return TN_OK;
}

tn_status tn_export_check(tn_session *session, const tn_export_request *request, const char *path)
{
    const tn_library_asked *subject = &request->subject;
    const char *needless = subject->has_trays        ? "trays"
                           : subject->has_max_length ? "max-length"
                           : subject->has_threads    ? "threads"
                                                     : NULL;
    if (needless)
        return tn_session_refuse(session, NULL, "--%s says nothing about what is exported", needless);
    return tn_export_is_drawn(request) ? check_drawn(session, request) : check_rules(session, request, path);
}

tn_status tn_ask_export(tn_session *session, const tn_export_request *request, tn_reply *answer)
{
    *answer = (tn_reply){0};
    tn_status status = tn_export_check(session, request, session->opened->path);
    if (status != TN_OK)
        return status;
    if (tn_export_is_drawn(request))
        return tn_export_drawn(session, request, answer);
    return (request->as == TN_EXPORT_PCFG ? tn_export_kit : export_rules)(session, request, answer);
}
