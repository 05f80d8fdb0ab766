/* Opens rule files and modules: compiles the ones, loads the others. */
#include "driver/open/open.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "compiler/common/import.h"
#include "driver/open/attached.h"
#include "driver/open/files.h"
#include "driver/open/stdlib_dirs.h"
#include "driver/open/stdlib_find.h"
#include "driver/open/suggest_file.h"
#include "runtime/base/file.h"
#include "runtime/load.h"
#include "runtime/mesh/openmesh.h"

static void start(const char *path, tn_opened *opened)
{
    *opened = (tn_opened){.path = path};
    tn_diagnostics_init(&opened->compilation.diagnostics, &opened->compilation.sources);
}

static tn_status refuse(tn_opened *opened, const tn_error *error)
{
    tn_report_error(&opened->compilation.diagnostics, error, opened->path, NULL, 0);
    return error->status;
}

static tn_status compile(const tn_notation *notation, const tn_input *input, const tn_compile_options *options,
                         tn_opened *opened)
{
    tn_error error;
    tn_diagnostics_clear(&opened->compilation.diagnostics);
    tn_status status = tn_compile_text(notation, input, options, &opened->compilation);
    if (status != TN_OK)
        return status;
    opened->compiled = true;
    status = tn_module_load(opened->compilation.module, opened->compilation.module_size, NULL, &opened->module, &error);
    return status == TN_OK ? TN_OK : refuse(opened, &error);
}

/* What is compiled beside a file's text, and how. */
typedef struct asked {
    bool warnings_are_errors;
    const tn_questions *questions; /* NULL: none */
    tn_param_values params;
    const tn_input *more; /* further texts of the same compilation */
    size_t more_count;
} asked;

/* What is wrong with a file of another kind is said in the words of plans: it says why. */
static void note_what_it_is_read_as(tn_opened *opened)
{
    tn_diagnostics *list = &opened->compilation.diagnostics;
    const char *extension = tn_path_extension(opened->path);
    char endings[200] = "";
    if (list->count == 0 || !*extension || tn_notation_of(opened->path, "", 0))
        return;
    for (size_t i = 0; i < tn_notation_count; i++) {
        size_t size = strlen(endings);
        if (tn_notation_is_main(&tn_notations[i]))
            snprintf(endings + size, sizeof endings - size, "%s%s", size ? ", " : "", tn_notations[i].extension);
    }
    tn_note(list, &list->items[0], NULL,
            "no notation has the ending %.20s: the file is read as rules of plans; there are %s", extension, endings);
}

/* Compiles what lies in a file, or would: that it uses files itself is to be expected. */
static tn_status compile_file(tn_opened *opened, const char *text, size_t size, const asked *how)
{
    tn_stdlib_dirs dirs;
    tn_files files;
    tn_error error;
    char *identity = tn_file_identity(opened->path);
    tn_status status = tn_stdlib_dirs_find(&dirs, &error);
    tn_files_begin(&files, &dirs);
    if (status == TN_OK && identity) {
        tn_input input = {text, size, opened->path, identity, NULL};
        tn_compile_options options = {.resolver = tn_files_resolver(&files),
                                      .attachments = tn_file_attachments,
                                      .warnings_are_errors = how->warnings_are_errors,
                                      .questions = how->questions,
                                      .params = how->params,
                                      .more = how->more,
                                      .more_count = how->more_count};
        status = compile(tn_notation_or_first(opened->path, text, size), &input, &options, opened);
        if (status == TN_INVALID)
            note_what_it_is_read_as(opened);
    } else {
        tn_fail_memory(&error);
        status = refuse(opened, &error);
    }
    tn_files_clear(&files);
    tn_stdlib_dirs_clear(&dirs);
    free(identity);
    return status;
}

tn_status tn_open_text(const tn_notation *notation, const tn_input *input, const tn_compile_options *options,
                       tn_opened *opened)
{
    start(input->name, opened);
    return compile(notation, input, options, opened);
}

/* A module brings its sources along: findings then show the same lines as when it was compiled. */
static tn_status load(tn_opened *opened, const uint8_t *bytes, size_t size)
{
    tn_error error;
    tn_status status = tn_module_load(bytes, size, NULL, &opened->module, &error);
    const tn_module *module = opened->module;
    for (size_t i = 0; status == TN_OK && i < module->SOURCE_count; i++) {
        const char *text = tn_text(module, module->SOURCE_records[i].text);
        uint32_t file;
        status = tn_sources_add(&opened->compilation.sources, tn_text(module, module->SOURCE_records[i].path), text,
                                strlen(text), &file, &error);
    }
    return status == TN_OK ? TN_OK : refuse(opened, &error);
}

/* A module was compiled already: nothing more can be asked in its words. */
static tn_status refuse_questions(tn_opened *opened)
{
    tn_diagnostics *list = &opened->compilation.diagnostics;
    tn_diagnostic *d =
        tn_report_bare(list, TN_ERROR, E_USAGE, "%s is a module, and --where needs the rule file", opened->path);
    tn_help(list, d, "name the rule file that it was built from");
    return TN_INVALID;
}

/* The states of its automata depend on its params. */
static tn_status refuse_params(tn_opened *opened)
{
    tn_diagnostics *list = &opened->compilation.diagnostics;
    tn_diagnostic *d = tn_report_bare(
        list, TN_ERROR, E_USAGE, "%s is a module, and its params keep the values that it was built with", opened->path);
    tn_help(list, d, "give --set to `tartan build`, or name the rule file that it was built from");
    return TN_INVALID;
}

static tn_status open_bytes(const char *path, const uint8_t *bytes, size_t size, const asked *how, tn_opened *opened)
{
    tn_error error = {0};
    start(path, opened);
    if (tn_refuse_python_grammar(path, &error) != TN_OK)
        return refuse(opened, &error);
    if (!tn_module_has_magic(bytes, size))
        return compile_file(opened, (const char *)bytes, size, how);
    if (how->params.count > 0)
        return refuse_params(opened);
    return how->questions ? refuse_questions(opened) : load(opened, bytes, size);
}

tn_status tn_open_bytes(const char *path, const uint8_t *bytes, size_t size, bool warnings_are_errors,
                        tn_opened *opened)
{
    return open_bytes(path, bytes, size, &(asked){.warnings_are_errors = warnings_are_errors}, opened);
}

tn_status tn_open_source(const char *path, const char *text, size_t size, const tn_questions *questions,
                         tn_param_values params, tn_opened *opened)
{
    start(path, opened);
    return compile_file(opened, text, size, &(asked){.questions = questions, .params = params});
}

/* ---- files */

/* Reads the file that the path names, or the one of the standard library. */
static tn_status read_named(const char *path, tn_stdlib_file *found, uint8_t **bytes, size_t *size, tn_error *error)
{
    *found = (tn_stdlib_file){0};
    bool name = tn_stdlib_may_mean(path);
    tn_status status = name ? tn_stdlib_find(path, found, error) : TN_OK;
    if (status != TN_OK)
        return status;
    status = tn_file_read(found->path ? found->path : path, tn_module_limits_default().bytes, bytes, size, error);
    if (status == TN_IO && !found->path && access(path, F_OK) != 0 && !tn_suggest_file(path, error))
        tn_stdlib_suggest(path, error);
    return status;
}

tn_status tn_open(const char *path, bool warnings_are_errors, tn_opened *opened)
{
    return tn_open_asking(path, warnings_are_errors, NULL, (tn_param_values){0}, opened);
}

tn_status tn_open_asking(const char *path, bool warnings_are_errors, const tn_questions *questions,
                         tn_param_values params, tn_opened *opened)
{
    const asked how = {.warnings_are_errors = warnings_are_errors, .questions = questions, .params = params};
    uint8_t *bytes = NULL;
    size_t size;
    tn_error error;
    tn_stdlib_file found;
    tn_status status = read_named(path, &found, &bytes, &size, &error);
    if (status == TN_OK) {
        status = open_bytes(found.path ? found.recorded : path, bytes, size, &how, opened);
        opened->path = path; /* the recorded path ends here */
    } else {
        start(path, opened);
        status = refuse(opened, &error);
    }
    tn_stdlib_file_clear(&found);
    free(bytes);
    return status;
}

/* ---- several files */

/* A file that is one of several. */
typedef struct joined_file {
    tn_stdlib_file found;
    uint8_t *bytes;
    size_t size;
} joined_file;

bool tn_path_joins(const char *path)
{
    const tn_notation *notation = tn_notation_of(path, "", 0);
    return notation && notation->front->joins;
}

static tn_status read_joined(const char *path, joined_file *file, tn_error *error)
{
    tn_status status = read_named(path, &file->found, &file->bytes, &file->size, error);
    if (status != TN_OK)
        return status;
    const char *name = file->found.path ? file->found.recorded : path;
    if (tn_path_joins(name) && !tn_module_has_magic(file->bytes, file->size))
        return TN_OK;
    tn_fail(error, TN_INVALID, E_NOT_PLACING, "%.200s is not a connection grammar, and cannot be joined to other files",
            path);
    tn_error_help(error, "name .pcfg files, or one file alone");
    return TN_INVALID;
}

/* Compiles files that have been read. */
static tn_status compile_joined(const char *const *paths, const joined_file *files, size_t count,
                                bool warnings_are_errors, tn_param_values params, tn_opened *opened)
{
    tn_input *more = calloc(count, sizeof *more);
    tn_error error;
    if (!more) {
        tn_fail_memory(&error);
        return refuse(opened, &error);
    }
    for (size_t i = 0; i < count; i++)
        more[i] = (tn_input){.text = (const char *)files[i].bytes,
                             .size = files[i].size,
                             .name = files[i].found.path ? files[i].found.recorded : paths[i]};
    opened->path = more[0].name;
    const asked how = {
        .warnings_are_errors = warnings_are_errors, .params = params, .more = more + 1, .more_count = count - 1};
    tn_status status = compile_file(opened, more[0].text, more[0].size, &how);
    opened->path = paths[0];
    free(more);
    return status;
}

tn_status tn_open_joined(const char *const *paths, size_t count, bool warnings_are_errors, tn_param_values params,
                         tn_opened *opened)
{
    if (count == 1)
        return tn_open_asking(paths[0], warnings_are_errors, NULL, params, opened);
    start(paths[0], opened);
    tn_error error;
    tn_status status = TN_OK;
    joined_file *files = calloc(count, sizeof *files);
    if (!files)
        status = tn_fail_memory(&error);
    for (size_t i = 0; i < count && status == TN_OK; i++)
        status = read_joined(paths[i], &files[i], &error);
    status = status == TN_OK ? compile_joined(paths, files, count, warnings_are_errors, params, opened)
                             : refuse(opened, &error);
    for (size_t i = 0; files && i < count; i++) {
        tn_stdlib_file_clear(&files[i].found);
        free(files[i].bytes);
    }
    free(files);
    return status;
}

tn_help_text tn_opened_help(const tn_opened *opened, const char *otherwise)
{
    const tn_notation *notation = tn_notation_of_module(opened->module);
    tn_help_text help;
    if (!notation || notation == &tn_notations[0])
        snprintf(help.text, sizeof help.text, "%s", otherwise);
    else
        tn_notation_help(notation, help.text, sizeof help.text);
    return help;
}

const char *tn_first_error(const tn_opened *opened)
{
    const tn_diagnostics *list = &opened->compilation.diagnostics;
    for (size_t i = 0; i < list->count; i++)
        if (list->items[i].severity == TN_ERROR)
            return list->items[i].message;
    return "it does not compile";
}

tn_status tn_open_error(const tn_opened *opened, tn_status status, tn_error *error)
{
    return status == TN_MEMORY ? tn_fail_memory(error)
                               : tn_fail(error, status, TN_CODE_NONE, "%.400s", tn_first_error(opened));
}

const struct tn_mesh_reader *tn_opened_meshes(const tn_opened *opened)
{
    return opened->meshes ? opened->meshes : &tn_openmesh_reader;
}

void tn_close(tn_opened *opened)
{
    tn_module_free(opened->module);
    tn_compilation_clear(&opened->compilation);
    *opened = (tn_opened){0};
}
