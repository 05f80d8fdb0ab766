/* The compiling half of the C interface (include/tartan/tartan.h). */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/runtime/api.h"
#include "driver/open/open.h"

_Static_assert((int)TARTAN_NOTE == (int)TN_NOTE && (int)TARTAN_ERROR == (int)TN_ERROR,
               "severities are the same numbers");

static void show(tn_sources *sources, const tn_diagnostic *item, tartan_report *report, void *context)
{
    char code[8] = "";
    if (item->code != TN_CODE_NONE)
        tn_code_name(item->code, code);
    tartan_diagnostic shown = {(tartan_severity)item->severity, code, item->message, item->help, NULL, 0, 0, 0, 0};
    if (item->has_span) {
        tn_place place = tn_sources_place(sources, item->span);
        shown.path = place.path;
        shown.line = place.line;
        shown.column = place.column;
        shown.end_line = place.end_line;
        shown.end_column = place.end_column;
    } else if (item->input_path) {
        shown.path = item->input_path;
        shown.line = (size_t)item->input_line;
        shown.column = item->input_column;
        shown.end_line = shown.line;
        shown.end_column = item->input_column_end;
    }
    report(context, &shown);
}

static void show_all(tn_compilation *compilation, tartan_report *report, void *context)
{
    tn_diagnostics_sort(&compilation->diagnostics);
    for (size_t i = 0; report && i < compilation->diagnostics.count; i++)
        show(&compilation->sources, &compilation->diagnostics.items[i], report, context);
}

/* What made opening fail, in one sentence: the first error. */
static tartan_status failed(const tn_diagnostics *diagnostics, tn_status status, tartan_error *error)
{
    for (size_t i = 0; i < diagnostics->count; i++) {
        const tn_diagnostic *item = &diagnostics->items[i];
        if (item->severity != TN_ERROR || !item->message)
            continue;
        tn_api_refuse(error, (tartan_status)status, "%s", item->message);
        if (error) {
            error->code = item->code;
            snprintf(error->help, sizeof error->help, "%s", item->help ? item->help : "");
        }
        return (tartan_status)status;
    }
    return tn_api_refuse(error, (tartan_status)status, "the rules could not be compiled");
}

static tartan_status finish(tn_opened *opened, tn_status status, tartan_report *report, void *context,
                            tartan_module **module, tartan_error *error)
{
    show_all(&opened->compilation, report, context);
    tartan_status result;
    if (status != TN_OK) {
        result = failed(&opened->compilation.diagnostics, status, error);
    } else if (!opened->compiled) {
        result = tn_api_refuse(error, TARTAN_INVALID, "%s is a module, not a rule file", opened->path);
    } else {
        result =
            tn_api_module(opened->module, opened->compilation.module, opened->compilation.module_size, module, error);
        opened->module = NULL;
        opened->compilation.module = NULL;
    }
    tn_close(opened);
    return result;
}

tartan_status tartan_compile_file(const char *path, tartan_report *report, void *context, tartan_module **module,
                                  tartan_error *error)
{
    tn_opened opened;
    tn_status status = tn_open(path, false, &opened);
    return finish(&opened, status, report, context, module, error);
}

tartan_status tartan_compile_text(const char *path, const char *text, size_t size, tartan_report *report, void *context,
                                  tartan_module **module, tartan_error *error)
{
    tn_opened opened;
    tn_status status = tn_open_bytes(path, (const uint8_t *)text, size, false, &opened);
    return finish(&opened, status, report, context, module, error);
}
