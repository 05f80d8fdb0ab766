/* Writes models of kits, and models that were drawn, as rules. */
#include "ask/place/export.h"

#include <stdlib.h>
#include <string.h>

#include "ask/session/made.h"
#include "driver/open/files.h"
#include "driver/place/export.h"
#include "driver/place/kit.h"
#include "runtime/base/file.h"

/* ---- finds the text of a model that was drawn, and reads it */

bool tn_drawn_given(const tn_drawn_asked *asked)
{
    return asked->ldraw || asked->path;
}

/* Reads the file, unless the text was given; free its bytes after TN_OK. Errors as of tn_file_read. */
static tn_status drawn_find(const tn_session *session, const tn_drawn_asked *asked, tn_drawn_text *drawn,
                            tn_error *error)
{
    *drawn = (tn_drawn_text){.name = asked->path ? asked->path : "the drawn model",
                             .text = asked->ldraw,
                             .size = asked->ldraw ? strlen(asked->ldraw) : 0};
    if (asked->ldraw)
        return TN_OK;
    tn_status status = session->reads
                           ? session->reads(session->reads_context, asked->path, &drawn->bytes, &drawn->size, error)
                           : tn_file_read(asked->path, TN_DRAWN_BYTES, &drawn->bytes, &drawn->size, error);
    drawn->text = (const char *)drawn->bytes;
    return status;
}

tn_status tn_drawn_model(const tn_session *session, const tn_drawn_asked *asked, tn_ldraw *ldraw, tn_error *error)
{
    tn_drawn_text drawn;
    *ldraw = (tn_ldraw){0};
    tn_status status = drawn_find(session, asked, &drawn, error);
    if (status != TN_OK)
        return status;
    const char *beside = session->reads ? NULL : asked->path;
    status = tn_drawn_read_text(drawn.text, drawn.size, drawn.name, beside, session->opened->module, ldraw, error);
    free(drawn.bytes);
    return status;
}

/* ---- writes models of kits, and models that were drawn, as rules */

tn_status tn_export_give(tn_session *session, tn_file_format format, const char *text, size_t size, tn_reply *answer)
{
    tn_making making;
    tn_error error;
    tn_made_file *file = NULL;
    tn_status status = tn_reply_new(&tn_message_exported, answer, &error);
    if (status == TN_OK) {
        file = TN_ADD(made_file, ((tn_exported *)answer->value)->files, &error);
        status = file ? tn_making_begin(&making, session, format, NULL, file, &error) : TN_MEMORY;
    }
    if (status == TN_OK) {
        fwrite(text, 1, size, making.stream); /* what fails shows when the file is closed */
        status = tn_making_end(&making, TN_OK, &error);
    }
    return status == TN_OK ? TN_OK : tn_session_fail(session, &error);
}

/* ---- kits */

static tn_status write_kit(const tn_module *module, uint32_t model, tn_buffer *text, tn_error *error)
{
    tn_place_rules rules;
    tn_status status = tn_place_rules_of_model(module, model, &rules, error);
    FILE *out = status == TN_OK ? open_memstream(&text->data, &text->size) : NULL;
    if (status == TN_OK)
        status = out ? tn_kit_export(&rules, out, error) : tn_fail_memory(error);
    if (out && fclose(out) != 0 && status == TN_OK)
        status = tn_fail_memory(error);
    tn_place_rules_clear(&rules);
    return status;
}

tn_status tn_export_kit(tn_session *session, const tn_export_request *request, tn_reply *answer)
{
    tn_opened *opened = session->opened;
    tn_buffer text = {0};
    tn_error error;
    uint32_t model;
    if (opened->module->KIT_count == 0)
        return tn_session_refuse(session, NULL, "--pcfg is about a kit, and %.200s is none", opened->path);
    tn_status status = tn_kit_choose(opened, request->model, &model);
    if (status != TN_OK)
        return status;
    status = write_kit(opened->module, model, &text, &error);
    status = status == TN_OK ? tn_export_give(session, TN_FILE_PCFG, text.data, text.size, answer)
                             : tn_session_fail(session, &error);
    free(text.data);
    return status;
}

/* ---- what is said of drawn models */

static void warn(tn_session *session, size_t count, tn_code code, const char *what, const char *help)
{
    if (count == 0)
        return;
    tn_diagnostics *list = &session->opened->compilation.diagnostics;
    tn_help(list, tn_report_bare(list, TN_WARNING, code, "%s: %zu part%s", what, count, count == 1 ? "" : "s"), "%s",
            help);
}

static void warn_left_out(tn_session *session, size_t count, const char *first, const char *why)
{
    char what[200];
    snprintf(what, sizeof what, "left out, the first a %.60s: %s", first ? first : "", why);
    warn(session, count, W_DRAWN_LOST, what, "`tartan inspect` says more of the model");
}

static void warn_of_turns(tn_session *session, uint32_t turns)
{
    tn_diagnostics *list = &session->opened->compilation.diagnostics;
    if (turns)
        tn_help(list,
                tn_report_bare(list, TN_WARNING, W_DRAWN_MOVED, "the whole model is turned by %u quarter turn%s", turns,
                               turns == 1 ? "" : "s"),
                "a rule begins with a part that is not turned, and the model has none");
}

static void warn_of_changes(tn_session *session, const tn_drawn_changes *changes, bool kit)
{
    warn(session, changes->moved, W_DRAWN_MOVED, "moved to the cells of connection grammars, 10 x 8 x 10 LDU",
         "a kit may have smaller cells: --kit");
    warn(session, changes->turned, W_DRAWN_MOVED, "turned otherwise than in the file",
         "connection grammars turn by quarters about the vertical, which the file writes as whole numbers: 0, 1, -1");
    warn(session, changes->renamed, W_DRAWN_LOST, "each r is left out of the name", "--kit keeps it");
    warn_of_turns(session, changes->turns);
    warn(session, changes->tilted, W_DRAWN_LOST, "left out, not turned about the vertical alone",
         "parts in braces are turned about the vertical");
    warn_left_out(session, changes->left_out, changes->first,
                  kit ? "not in the kit" : "not a name that a terminal can hold");
}

/* ---- drawn models */

bool tn_export_is_drawn(const tn_export_request *request)
{
    return tn_drawn_given(&request->drawn);
}

static tn_status write_pcfg(const tn_session *session, const tn_export_request *r, tn_buffer *text,
                            tn_drawn_changes *changes, tn_error *error)
{
    tn_drawn_text drawn;
    tn_status status = drawn_find(session, &r->drawn, &drawn, error);
    if (status != TN_OK)
        return status;
    FILE *out = open_memstream(&text->data, &text->size);
    status = out ? tn_drawn_pcfg(drawn.text, drawn.size, r->init, out, changes, error) : tn_fail_memory(error);
    if (out && fclose(out) != 0 && status == TN_OK)
        status = tn_fail_memory(error);
    free(drawn.bytes);
    if (status == TN_INVALID) {
        tn_error found = *error;
        tn_fail(error, status, found.code, "%.200s: %s", drawn.name, found.message);
        tn_error_help(error, "%s",
                      found.help[0] ? found.help : "a part is written `1 COLOUR X Y Z A B C D E F G H I NAME.dat`");
    }
    return status;
}

static tn_status export_pcfg(tn_session *session, const tn_export_request *request, tn_reply *answer)
{
    tn_drawn_changes changes;
    tn_buffer text = {0};
    tn_error error;
    tn_status status = write_pcfg(session, request, &text, &changes, &error);
    if (status == TN_OK) {
        warn_of_changes(session, &changes, false);
        status = tn_export_give(session, TN_FILE_PCFG, text.data, text.size, answer);
    } else {
        tn_session_fail(session, &error);
    }
    free(text.data);
    return status;
}

/* The kit as a file elsewhere names it: one of the standard library by its name, a file by its whole path. */
static char *name_of_kit(const char *kit)
{
    return strpbrk(kit, "/.") ? tn_file_identity(kit) : strdup(kit);
}

static tn_status export_to_kit(tn_session *session, const tn_export_request *r, tn_reply *answer)
{
    const tn_module *module = session->opened->module;
    tn_drawn_changes changes = {0};
    tn_ldraw ldraw = {0};
    tn_error error;
    char *text = NULL, *use = name_of_kit(session->opened->path);
    tn_status status = use ? tn_drawn_model(session, &r->drawn, &ldraw, &error) : tn_fail_memory(&error);
    if (status == TN_OK)
        status = tn_drawn_kit(module, &ldraw.model, use, r->at ? r->at : "drawn.kit", session->opener, &text, &changes,
                              &error);
    if (status == TN_OK) {
        warn_of_changes(session, &changes, true);
        warn_left_out(session, ldraw.tilted, ldraw.first_tilted, "not turned about the vertical alone");
        warn_left_out(session, ldraw.beside, ldraw.first_beside, "beside the kit's cells");
        status = tn_export_give(session, TN_FILE_KIT, text, strlen(text), answer);
    } else {
        tn_session_fail(session, &error);
    }
    tn_ldraw_clear(&ldraw);
    free(text);
    free(use);
    return status;
}

tn_status tn_export_drawn(tn_session *session, const tn_export_request *request, tn_reply *answer)
{
    if (request->as == TN_EXPORT_PCFG)
        return export_pcfg(session, request, answer);
    if (session->opened->module->KIT_count == 0)
        return tn_session_refuse(session, NULL, "%.200s is no kit", session->opened->path);
    return export_to_kit(session, request, answer);
}
