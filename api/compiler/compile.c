/* The C interface to compiling rule files. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/compiler/compile.h"
#include "compiler/format.h"
#include "driver/open/files.h"
#include "driver/open/open.h"
#include "driver/open/stdlib.h"
#include "runtime/base/file.h"

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

void tn_api_report(tn_diagnostics *diagnostics, tartan_report *report, void *context)
{
    tn_diagnostics_sort(diagnostics);
    for (size_t i = 0; report && i < diagnostics->count; i++)
        show(diagnostics->sources, &diagnostics->items[i], report, context);
}

/* The first error, in one sentence. */
tartan_status tn_api_first_error(const tn_diagnostics *diagnostics, tn_status status, const tn_watch *watch,
                                 tartan_error *error)
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
    tn_error found;
    if (status == TN_STOPPED) {
        tn_fail_stopped(watch, &found);
        return tn_api_fail(&found, error);
    }
    return status == TN_MEMORY ? tn_api_memory(error)
                               : tn_api_refuse(error, (tartan_status)status, "the rules could not be compiled");
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

/* A text that another one uses, in front of where all else comes from. */
typedef struct stand_in {
    const tn_input *user, *used; /* NULL: there is none */
    tn_resolver rest;
} stand_in;

static tn_status resolve_used(void *context, const tn_request *request, tn_input *found, char *meant, tn_error *error)
{
    const stand_in *in = context;
    if (strcmp(request->path, in->used->name) != 0 || strcmp(request->user, in->user->name) != 0)
        return in->rest.resolve(in->rest.context, request, found, meant, error);
    *found = *in->used;
    return TN_OK;
}

static tn_status open_input(const tn_notation *notation, const tn_input *input, tn_compile_options *own,
                            const tn_input *used, tn_opened *opened)
{
    stand_in in = {input, used, own->resolver};
    if (used)
        own->resolver = (tn_resolver){resolve_used, &in};
    return tn_open_text(notation, input, own, opened);
}

/* Compiles with files that lie beside the text, and in the caller's folders; without such, with the standard library
 * that is in here. */
static tn_status open_with_files(const tn_notation *notation, tn_input *input, const tartan_compile_options *options,
                                 tn_compile_options *own, const tn_input *used, tn_opened *opened)
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
    tn_stdlib_resolver standard = {tn_files_resolver(&files)};
    own->resolver = options->folder_count ? standard.rest : tn_stdlib_resolver_of(&standard);
    own->attachments = tn_file_attachments;
    tn_status status = copied ? open_input(notation, input, own, used, opened) : TN_MEMORY;
    tn_files_clear(&files);
    for (size_t i = 0; folders && i < options->folder_count; i++)
        free(folders[i]);
    free(folders);
    free(identity);
    return status;
}

/* used: what it uses, or NULL. */
static tartan_status open_text(const tn_notation *notation, tn_input input, tartan_compile_options *options,
                               const tn_questions *asking, const tn_input *used, tn_opened *opened, tartan_error *error)
{
    tn_watch watch;
    tn_compile_options own = {.resolver = {resolve, options},
                              .questions = asking,
                              .warnings_are_errors = options->warnings_are_errors,
                              .params = {options->params, options->param_count},
                              .watch = &watch};
    tartan_status status = tn_api_watch(options->watch, &watch, error);
    if (status != TARTAN_OK)
        return status;
    tn_status compiled = options->resolve ? open_input(notation, &input, &own, used, opened)
                                          : open_with_files(notation, &input, options, &own, used, opened);
    if (compiled == TN_MEMORY && !opened->compilation.arena)
        return tn_api_memory(error);
    tn_api_report(&opened->compilation.diagnostics, options->report, options->report_context);
    return compiled == TN_OK ? TARTAN_OK
                             : tn_api_first_error(&opened->compilation.diagnostics, compiled, &watch, error);
}

static tartan_status check_texts(const char *const *texts, size_t count, const char *all, const char *one,
                                 tartan_error *error)
{
    if (count && !texts)
        return tn_api_missing(error, all);
    for (size_t i = 0; i < count; i++)
        if (!texts[i])
            return tn_api_missing(error, one);
    return TARTAN_OK;
}

tartan_status tn_api_compile_texts(const tartan_compile_options *options, tartan_error *error)
{
    tartan_status status = check_texts(options->folders, options->folder_count, "array of folders", "folder", error);
    return status == TARTAN_OK ? check_texts(options->params, options->param_count, "array of values of params",
                                             "value of a param", error)
                               : status;
}

static tartan_status take(const char *path, const tartan_compile_options *given, tartan_compile_options *options,
                          tartan_error *error)
{
    if (!path)
        return tn_api_missing(error, "path");
    tartan_status status = TN_API_TAKE(tartan_compile_options, options, given, error);
    if (status == TARTAN_OK)
        status = tn_api_compile_texts(options, error);
    return status;
}

tartan_status tn_api_open(const char *path, const char *text, size_t size, const tartan_compile_options *given,
                          const tn_questions *asking, tn_opened *opened, tartan_error *error)
{
    tartan_compile_options options;
    tartan_status status = take(path, given, &options, error);
    *opened = (tn_opened){.path = path};
    tn_diagnostics_init(&opened->compilation.diagnostics, &opened->compilation.sources);
    if (status != TARTAN_OK)
        return status;
    if (size && !text)
        return tn_api_missing(error, "text");
    if (tn_module_has_magic(text, size))
        return tn_api_refuse(error, TARTAN_INVALID, "%.200s is a module, not a rule file", path);
    text = size ? text : "";
    return open_text(tn_notation_or_first(path, text, size), (tn_input){.text = text, .size = size, .name = path},
                     &options, asking, NULL, opened, error);
}

tartan_status tn_api_open_study(const char *name, const char *text, size_t size, const tartan_compile_options *given,
                                const tn_input *used, tn_opened *opened, tartan_error *error)
{
    tartan_compile_options options;
    tartan_status status = take(name, given, &options, error);
    *opened = (tn_opened){.path = name};
    tn_diagnostics_init(&opened->compilation.diagnostics, &opened->compilation.sources);
    return status == TARTAN_OK ? open_text(TN_NOTATION(study), (tn_input){.text = text, .size = size, .name = name},
                                           &options, NULL, used, opened, error)
                               : status;
}

tartan_status tn_api_open_file(const char *path, const tartan_compile_options *given, const tn_questions *asking,
                               tn_opened *opened, tartan_error *error)
{
    tartan_compile_options options;
    uint8_t *bytes;
    size_t size;
    tn_error found;
    *opened = (tn_opened){.path = path};
    tartan_status status = take(path, given, &options, error);
    if (status != TARTAN_OK)
        return status;
    if (tn_file_read(path, TN_SOURCE_BYTES_MAX, &bytes, &size, &found) != TN_OK)
        return tn_api_fail(&found, error);
    status = tn_api_open(path, (const char *)bytes, size, given, asking, opened, error);
    free(bytes);
    return status;
}

/* The module of what was opened, which ends here. */
static tartan_status keep_module(tartan_status status, tn_opened *opened, tartan_module **module, tartan_error *error)
{
    if (status == TARTAN_OK) {
        status =
            tn_api_module(opened->module, opened->compilation.module, opened->compilation.module_size, module, error);
        opened->module = NULL;
        opened->compilation.module = NULL;
    }
    tn_close(opened);
    return status;
}

tartan_status tartan_compile_text(const char *path, const char *text, size_t size,
                                  const tartan_compile_options *options, tartan_module **module, tartan_error *error)
{
    tn_opened opened;
    return keep_module(tn_api_open(path, text, size, options, NULL, &opened, error), &opened, module, error);
}

tartan_status tartan_compile_file(const char *path, const tartan_compile_options *options, tartan_module **module,
                                  tartan_error *error)
{
    tn_opened opened;
    return keep_module(tn_api_open_file(path, options, NULL, &opened, error), &opened, module, error);
}

tartan_status tartan_compile_where(const char *path, const char *text, size_t size,
                                   const tartan_compile_options *options, const char *library,
                                   const char *const *wheres, size_t count, tartan_module **module, tartan_error *error)
{
    tn_opened opened;
    tartan_status status = check_texts(wheres, count, "array of requirements", "requirement", error);
    if (status != TARTAN_OK)
        return status;
    const tn_questions asking = {.library = library, .wheres = wheres, .where_count = count};
    status = text ? tn_api_open(path, text, size, options, &asking, &opened, error)
                  : tn_api_open_file(path, options, &asking, &opened, error);
    return keep_module(status, &opened, module, error);
}

/* ---- layout */

tartan_status tartan_format_text(const char *path, const char *text, size_t size, tartan_report *report,
                                 void *report_context, char **formatted, size_t *formatted_size, tartan_error *error)
{
    tn_sources sources = {0};
    tn_diagnostics diagnostics;
    char *made = NULL;
    size_t made_size = 0;
    if (!path || (size && !text) || !formatted || !formatted_size)
        return tn_api_missing(error, !path ? "path" : size && !text ? "text" : "room for the text");
    text = size ? text : "";
    tn_diagnostics_init(&diagnostics, &sources);
    tn_status status =
        tn_format_text(&diagnostics, tn_notation_or_first(path, text, size), path, text, size, &made, &made_size);
    tn_api_report(&diagnostics, report, report_context);
    tartan_status result = TARTAN_OK;
    if (status == TN_OK) {
        *formatted = made;
        *formatted_size = made_size;
    } else {
        result = tn_api_first_error(&diagnostics, status, NULL, error);
    }
    tn_diagnostics_clear(&diagnostics);
    tn_sources_clear(&sources);
    return result;
}

/* ---- the standard library */

size_t tartan_stdlib_count(void)
{
    return tn_stdlib_text_count;
}

const char *tartan_stdlib_name(size_t index)
{
    return index < tn_stdlib_text_count ? tn_stdlib_texts[index].name : NULL;
}

const char *tartan_stdlib_text(const char *name, size_t *size)
{
    const tn_stdlib_text *found = name ? tn_stdlib_text_named(name) : NULL;
    if (size)
        *size = found ? found->size : 0;
    return found ? found->text : NULL;
}
