/* Opens rule files and modules: compiles the ones, loads the others. */
#include "driver/open/open.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "compiler/common/compilation.h"
#include "compiler/common/import.h"
#include "driver/open/census.h"
#include "driver/open/files.h"
#include "driver/open/missing.h"
#include "driver/open/stdlib.h"
#include "runtime/base/file.h"
#include "runtime/load.h"
#include "runtime/mesh/openmesh.h"
#include "runtime/module/code.h"

/* ---- findings of engines, at their places */

bool tn_code_span(const tn_opened *opened, uint32_t offset, tn_span *span)
{
    const tn_source_map_record *map =
        opened->module && offset != TN_NO_OFFSET ? tn_module_place(opened->module, offset) : NULL;
    if (!map || map->file >= opened->compilation.sources.count)
        return false;
    *span = (tn_span){map->file, map->begin, map->end};
    return true;
}

bool tn_code_place(const tn_opened *opened, uint32_t offset, tn_place *where)
{
    tn_span span;
    if (!tn_code_span(opened, offset, &span))
        return false;
    tn_sources *sources = (tn_sources *)(uintptr_t)&opened->compilation.sources; /* finds its lines late */
    *where = tn_sources_place(sources, span);
    return true;
}

static void place(const tn_opened *opened, const tn_error *error, tn_diagnostic *diagnostic)
{
    diagnostic->has_span = tn_code_span(opened, error->code_offset, &diagnostic->span);
}

tn_diagnostic *tn_finding_error(tn_opened *opened, const tn_error *error)
{
    tn_diagnostic *diagnostic = tn_report_error(&opened->compilation.diagnostics, error, NULL, NULL, 0);
    place(opened, error, diagnostic);
    return diagnostic;
}

tn_diagnostic *tn_finding_note(tn_opened *opened, const tn_error *error)
{
    tn_diagnostics *list = &opened->compilation.diagnostics;
    tn_diagnostic *diagnostic = tn_report_bare(list, TN_NOTE, TN_CODE_NONE, "%s", error->message);
    place(opened, error, diagnostic);
    if (error->help[0])
        tn_help(list, diagnostic, "%s", error->help);
    return diagnostic;
}

tn_diagnostic *tn_finding_limit(tn_opened *opened, const tn_error *error, const tn_span *otherwise)
{
    tn_diagnostics *list = &opened->compilation.diagnostics;
    tn_span span;
    bool has_span = tn_code_span(opened, error->code_offset, &span);
    if (!has_span && otherwise) {
        span = *otherwise;
        has_span = true;
    }
    for (size_t i = 0; i < list->count; i++) {
        tn_diagnostic *known = &list->items[i];
        if (known->limit && known->message && strcmp(known->message, error->message) == 0 &&
            known->has_span == has_span && (!has_span || memcmp(&known->span, &span, sizeof span) == 0))
            return known;
    }
    tn_diagnostic *note = tn_finding_note(opened, error);
    note->limit = true;
    note->has_span = has_span;
    if (has_span)
        note->span = span;
    return note;
}

tn_diagnostic *tn_finding_uncounted(tn_opened *opened, const char *clause, const tn_error *error)
{
    tn_error note;
    tn_fail(&note, error->status, error->code, "what only `%.80s` keeps out is not counted: %.360s", clause,
            error->message);
    tn_error_help(&note, "%s", error->help);
    note.code_offset = error->code_offset;
    return tn_finding_limit(opened, &note, NULL);
}

/* ---- what lies beside a rule file */

enum { BYTES_MAX = 1 << 30 };

/* Where the file is; the caller frees it. */
static tn_status find(const tn_request *request, char **path, tn_error *error)
{
    *path = tn_path_beside(request->user, request->path, "");
    if (!*path)
        return tn_fail_memory(error);
    if (tn_path_exists(*path))
        return TN_OK;
    tn_fail(error, TN_IO, E_CANNOT_READ, "there is no file %.300s", *path);
    if (!tn_suggest_file(*path, error))
        tn_error_help(error, "a path starts at the folder of the file that names it");
    return TN_IO;
}

/* ---- the LDraw library */

/* Reads FOLDER/INNER/NAME; TN_OK with *there false where there is no such file. */
static tn_status read_there(const char *folder, const char *inner, const char *name, uint8_t **bytes, size_t *size,
                            bool *there, tn_error *error)
{
    char *path;
    *there = false;
    if (asprintf(&path, "%s/%s/%s", folder, inner, name) < 0)
        return tn_fail_memory(error);
    tn_status status = TN_OK;
    if (tn_path_exists(path)) {
        *there = true;
        status = tn_file_read(path, BYTES_MAX, bytes, size, error);
    }
    free(path);
    return status;
}

/* The nearest name among the library's parts, where there is a library. */
static void suggest_part(const char *folder, const char *name, tn_error *error)
{
    char *path;
    if (asprintf(&path, "%s/parts/%s", folder, name) < 0)
        return;
    if (tn_suggest_file(path, error)) {
        const char *near = strrchr(error->help, '/');
        if (near) {
            char named[256];
            snprintf(named, sizeof named, "%s", near + 1);
            tn_error_help(error, "did you mean `%s", named);
        }
    }
    free(path);
}

static tn_status read_part(const char *name, uint8_t **bytes, size_t *size, tn_error *error)
{
    static const char *const inner[] = {"parts", "p", "PARTS", "P"};
    const char *own = getenv("LDRAWDIR"), *folder = own && *own ? own : "/usr/share/ldraw";
    tn_status status = TN_OK;
    bool there = false;
    for (size_t i = 0; i < sizeof inner / sizeof *inner && status == TN_OK && !there; i++)
        status = read_there(folder, inner[i], name, bytes, size, &there, error);
    if (status != TN_OK || there)
        return status;
    tn_fail(error, TN_IO, E_CANNOT_READ, "there is no %.120s in the LDraw library %.200s", name, folder);
    tn_error_help(
        error,
        "name the folder of the library, which has the folders parts and p, by --ldraw or by the variable LDRAWDIR");
    suggest_part(folder, name, error);
    return TN_IO;
}

/* ---- what a kit names */

static tn_status read_bytes(void *context, const tn_request *request, uint8_t **bytes, size_t *size, tn_error *error)
{
    char *path;
    (void)context;
    if (strcmp(request->extension, TN_LDRAW_LIBRARY) == 0)
        return read_part(request->path, bytes, size, error);
    tn_status status = find(request, &path, error);
    if (status == TN_OK)
        status = tn_file_read(path, BYTES_MAX, bytes, size, error);
    free(path);
    return status;
}

static tn_status read_mesh(void *context, const tn_request *request, tn_mesh *mesh, tn_error *error)
{
    char *path;
    (void)context;
    tn_status status = find(request, &path, error);
    if (status == TN_OK)
        status = tn_openmesh_read(path, mesh, error);
    free(path);
    return status;
}

const tn_attachments tn_file_attachments = {.bytes = read_bytes, .mesh = read_mesh};

/* ---- opens a file once more, from the texts that were opened before */

/* What is changed, and who finds the texts. */
typedef struct changing {
    tn_change_tree *change;
    void *context;
} changing;

static void change_trees(void *context, tn_arena *arena, const struct tn_imports *imports)
{
    const changing *c = context;
    for (size_t i = 0; i < imports->count; i++)
        c->change(c->context, arena, imports->units[i]->tree, i + 1 == imports->count);
}

static const tn_unit *unit_named(const tn_compilation *compilation, const char *name)
{
    for (size_t i = 0; i < compilation->imports->count; i++) {
        const tn_unit *unit = compilation->imports->units[i];
        if (strcmp(compilation->sources.files[unit->file].path, name) == 0)
            return unit;
    }
    return NULL;
}

static tn_input input_of(const tn_compilation *compilation, const tn_unit *unit)
{
    const tn_source *source = &compilation->sources.files[unit->file];
    return (tn_input){source->text, source->size, source->path, unit->identity, unit->recorded};
}

/* What a `use` led to before. */
static tn_status resolve(void *context, const tn_request *request, tn_input *found, char *meant, tn_error *error)
{
    const tn_compilation *compilation = context;
    const tn_unit *user = unit_named(compilation, request->user);
    (void)meant;
    for (size_t i = 0; user && i < user->use_count; i++)
        if (user->uses[i].unit && strcmp(user->uses[i].path, request->path) == 0) {
            *found = input_of(compilation, user->uses[i].unit);
            return TN_OK;
        }
    return tn_fail(error, TN_INVALID, E_IMPORT_NOT_FOUND, "`%.200s` was not used before", request->path);
}

tn_status tn_opened_params(const tn_opened *opened, tn_param_values *params)
{
    const tn_sources *sources = &opened->compilation.sources;
    const char **items = calloc(sources->count + 1, sizeof *items);
    *params = (tn_param_values){.items = items};
    for (size_t i = 0; items && i < sources->count; i++)
        if (strcmp(sources->files[i].path, TN_SETTING_SOURCE) == 0)
            items[params->count++] = sources->files[i].text;
    return items ? TN_OK : TN_MEMORY;
}

void tn_opened_params_text(const tn_opened *opened, char *text, size_t size)
{
    const tn_sources *sources = &opened->compilation.sources;
    size_t used = 0;
    text[0] = '\0';
    for (size_t i = 0; i < sources->count && used < size; i++)
        if (strcmp(sources->files[i].path, TN_SETTING_SOURCE) == 0)
            used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "", sources->files[i].text);
}

tn_status tn_open_again(const tn_opened *opened, tn_change_tree *change, void *context, size_t test, tn_opened *again)
{
    const tn_compilation *before = &opened->compilation;
    const tn_input input = input_of(before, before->imports->units[before->imports->count - 1]);
    changing c = {change, context};
    tn_compile_options options = {.resolver = {resolve, (void *)(uintptr_t)before},
                                  .watch = opened->module->watch,
                                  .change = change ? change_trees : NULL,
                                  .change_context = &c,
                                  .test = test};
    *again = (tn_opened){.path = input.name};
    tn_status status = tn_opened_params(opened, &options.params);
    if (status == TN_OK)
        status = tn_open_text(before->notation, &input, &options, again);
    free((void *)(uintptr_t)options.params.items);
    return status;
}

/* ---- opens rule files and modules */

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
    tn_compile_options own = *options;
    own.census = tn_plan_census;
    tn_diagnostics_clear(&opened->compilation.diagnostics);
    tn_status status = tn_compile_text(notation, input, &own, &opened->compilation);
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
