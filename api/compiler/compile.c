/* The C interface to compiling rule files. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/base/api.h"
#include "compiler/compile.h"
#include "driver/open/files.h"
#include "runtime/base/file.h"
#include "runtime/load.h"

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

/* The module of a compilation. */
static tartan_status load(tn_compilation *compilation, tartan_module **module, tartan_error *error)
{
    tn_module *loaded;
    tn_error found;
    if (tn_module_load(compilation->module, compilation->module_size, NULL, &loaded, &found) != TN_OK)
        return tn_api_fail(&found, error);
    uint8_t *bytes = compilation->module;
    compilation->module = NULL;
    return tn_api_module(loaded, bytes, compilation->module_size, module, error);
}

/* ---- where what is used comes from */

/* Asks the caller. */
static tn_status resolve(void *context, const tn_request *request, tn_input *found, char *meant, tn_error *error)
{
    const tartan_compile_options *options = context;
    const tartan_use use = {request->path, request->extension, request->user};
    tartan_text text = {.name = request->path};
    tartan_error said = {.status = TARTAN_OK};
    (void)meant;
    tartan_status status = options->resolve(options->resolve_context, &use, &text, &said);
    if (status == TARTAN_MEMORY)
        return tn_fail_memory(error);
    if (status == TARTAN_OK && (text.text || text.size == 0)) {
        *found = (tn_input){
            .text = text.text ? text.text : "", .size = text.size, .name = text.name ? text.name : request->path};
        return TN_OK;
    }
    tn_fail(error, TN_INVALID, E_IMPORT_NOT_FOUND, "%.479s", said.message[0] ? said.message : "there is no such text");
    if (said.help[0])
        tn_error_help(error, "%.319s", said.help);
    return TN_INVALID;
}

/* Compiles with files that lie beside the text, and in the caller's folders. */
static tn_status compile_with_files(const tn_notation *notation, tn_input *input, const tartan_compile_options *options,
                                    tn_compilation *compilation)
{
    tn_files files;
    char *identity = tn_file_identity(input->name);
    char **folders = calloc(options->folder_count + 1, sizeof *folders);
    bool copied = folders && identity;
    for (size_t i = 0; copied && i < options->folder_count; i++)
        copied = (folders[i] = strdup(options->folders[i])) != NULL;
    tn_stdlib_dirs dirs = {folders, options->folder_count};
    tn_files_begin(&files, &dirs);
    input->identity = identity;
    const tn_compile_options own = {.resolver = tn_files_resolver(&files),
                                    .warnings_are_errors = options->warnings_are_errors};
    tn_status status = copied ? tn_compile_text(notation, input, &own, compilation) : TN_MEMORY;
    tn_files_clear(&files);
    for (size_t i = 0; folders && i < options->folder_count; i++)
        free(folders[i]);
    free(folders);
    free(identity);
    return status;
}

static tartan_status compile(const char *path, const char *text, size_t size, tartan_compile_options *options,
                             tartan_module **module, tartan_error *error)
{
    tn_compilation compilation = {0};
    tn_input input = {.text = text, .size = size, .name = path};
    const tn_notation *notation = tn_notation_or_first(path, text, size);
    const tn_compile_options own = {.resolver = {resolve, options},
                                    .warnings_are_errors = options->warnings_are_errors};
    tn_diagnostics_init(&compilation.diagnostics, &compilation.sources);
    tn_status compiled = options->resolve ? tn_compile_text(notation, &input, &own, &compilation)
                                          : compile_with_files(notation, &input, options, &compilation);
    if (compiled == TN_MEMORY && !compilation.arena) {
        tn_compilation_clear(&compilation);
        return tn_api_memory(error);
    }
    show_all(&compilation, options->report, options->report_context);
    tartan_status status =
        compiled == TN_OK ? load(&compilation, module, error) : failed(&compilation.diagnostics, compiled, error);
    tn_compilation_clear(&compilation);
    return status;
}

static tartan_status take(const char *path, const tartan_compile_options *given, tartan_compile_options *options,
                          tartan_error *error)
{
    if (!path)
        return tn_api_missing(error, "path");
    tartan_status status = TN_API_TAKE(tartan_compile_options, options, given, error);
    if (status == TARTAN_OK && options->folder_count && !options->folders)
        status = tn_api_missing(error, "array of folders");
    for (size_t i = 0; status == TARTAN_OK && i < options->folder_count; i++)
        if (!options->folders[i])
            status = tn_api_missing(error, "folder");
    return status;
}

tartan_status tartan_compile_text(const char *path, const char *text, size_t size, const tartan_compile_options *given,
                                  tartan_module **module, tartan_error *error)
{
    tartan_compile_options options;
    tartan_status status = take(path, given, &options, error);
    if (status != TARTAN_OK)
        return status;
    if (size && !text)
        return tn_api_missing(error, "text");
    if (tn_module_has_magic(text, size))
        return tn_api_refuse(error, TARTAN_INVALID, "%.200s is a module, not a rule file", path);
    return compile(path, size ? text : "", size, &options, module, error);
}

tartan_status tartan_compile_file(const char *path, const tartan_compile_options *given, tartan_module **module,
                                  tartan_error *error)
{
    tartan_compile_options options;
    uint8_t *bytes;
    size_t size;
    tn_error found;
    tartan_status status = take(path, given, &options, error);
    if (status != TARTAN_OK)
        return status;
    if (tn_file_read(path, TN_SOURCE_BYTES_MAX, &bytes, &size, &found) != TN_OK)
        return tn_api_fail(&found, error);
    status = tartan_compile_text(path, (const char *)bytes, size, given, module, error);
    free(bytes);
    return status;
}
