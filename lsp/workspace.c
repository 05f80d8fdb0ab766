/* Keeps the texts that an editor has open. */
#include "lsp/workspace.h"

#include <dirent.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "compiler/common/lexical.h"
#include "compiler/compile.h"
#include "driver/open/census.h"
#include "driver/open/open.h"
#include "lsp/facts.h"
#include "runtime/base/array.h"

/* ---- rule files in the folders that an editor has open */

static void add(tn_rule_files *files, const char *path)
{
    if (!tn_array_reserve(&files->paths, &files->capacity, files->count, 1, sizeof *files->paths)) {
        files->failed = true;
        return;
    }
    char *real = realpath(path, NULL);
    if (real)
        files->paths[files->count++] = real;
}

static bool passed_over(const char *name)
{
    return name[0] == '.' || strcmp(name, "node_modules") == 0;
}

/* Not every file system says in its entries what they are. */
static bool is_folder(const struct dirent *entry, const char *path)
{
    struct stat status;
    if (entry->d_type != DT_UNKNOWN)
        return entry->d_type == DT_DIR;
    return lstat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

static void look_at(tn_rule_files *files, const char *folder, const struct dirent *entry, unsigned depth)
{
    bool rules = tn_notation_of(entry->d_name, "", 0) == TN_NOTATION(plan);
    bool maybe_folder = depth > 0 && (entry->d_type == DT_DIR || entry->d_type == DT_UNKNOWN);
    char *path = NULL;
    if (!rules && !maybe_folder)
        return;
    if (asprintf(&path, "%s/%s", folder, entry->d_name) < 0) {
        files->failed = true;
        return;
    }
    if (!is_folder(entry, path)) {
        if (rules)
            add(files, path);
    } else if (depth > 0) {
        tn_rule_files_find(files, path, depth - 1);
    }
    free(path);
}

void tn_rule_files_find(tn_rule_files *files, const char *folder, unsigned depth)
{
    DIR *directory = opendir(folder);
    for (const struct dirent *entry; directory && !files->cut_off && (entry = readdir(directory));) {
        files->cut_off = files->entries++ >= TN_FOLDER_ENTRIES_MAX;
        if (!files->cut_off && !passed_over(entry->d_name))
            look_at(files, folder, entry, depth);
    }
    if (directory)
        closedir(directory);
}

void tn_rule_files_clear(tn_rule_files *files)
{
    for (size_t i = 0; i < files->count; i++)
        free(files->paths[i]);
    free(files->paths);
    *files = (tn_rule_files){0};
}

static char *uri_path(const char *uri);

/* ---- places of the protocol as JSON */

json_t *tn_lines_position(const tn_lines *lines, size_t offset)
{
    size_t line, character;
    tn_lines_place(lines, offset, &line, &character);
    return json_pack("{s:I,s:I}", "line", (json_int_t)line, "character", (json_int_t)character);
}

json_t *tn_lines_range(const tn_lines *lines, size_t begin, size_t end)
{
    return json_pack("{s:o,s:o}", "start", tn_lines_position(lines, begin), "end", tn_lines_position(lines, end));
}

bool tn_lines_read(const tn_lines *lines, const json_t *position, size_t *offset)
{
    const json_t *line = json_object_get(position, "line"), *character = json_object_get(position, "character");
    if (!json_is_integer(line) || !json_is_integer(character) || json_integer_value(line) < 0 ||
        json_integer_value(character) < 0)
        return false;
    *offset = tn_lines_offset(lines, (size_t)json_integer_value(line), (size_t)json_integer_value(character));
    return true;
}

/* ---- compiles a text and indexes it for the questions of an editor */

void tn_analysis_free(tn_file_analysis *analysis)
{
    if (!analysis)
        return;
    for (size_t i = 0; analysis->lines && i < analysis->compilation.sources.count; i++)
        tn_lines_clear(&analysis->lines[i]);
    free(analysis->lines);
    tn_compilation_clear(&analysis->compilation);
    free(analysis);
}

/* The compilation has read the tokens and forgotten them. */
static void read_tokens(tn_file_analysis *analysis)
{
    tn_compilation *c = &analysis->compilation;
    tn_diagnostics scratch;
    tn_reading reading;
    tn_diagnostics_init(&scratch, &c->sources);
    if (tn_text_check(&scratch, 0) && tn_read(c->arena, &scratch, c->notation, 0, &reading))
        analysis->tokens = reading.tokens;
    tn_diagnostics_clear(&scratch);
}

static tn_status compile_input(tn_file_analysis *analysis, const tn_input *input, const tn_compile_options *options)
{
    return tn_compile_text(tn_notation_or_first(input->name, input->text, input->size), input, options,
                           &analysis->compilation);
}

static tn_status compile_served(tn_file_analysis *analysis, const tn_input *input, const tn_analysis_texts *texts)
{
    tn_served_files files;
    tn_served_begin(&files, texts->served, texts->overlay, texts->context);
    const tn_compile_options options = {.resolver = tn_served_resolver(&files),
                                        .census = tn_plan_census,
                                        .attachments = tn_served_attachments(&files),
                                        .partial = true};
    tn_status status = compile_input(analysis, input, &options);
    tn_served_clear(&files);
    return status;
}

static tn_status compile_file(tn_file_analysis *analysis, const tn_input *input, const tn_analysis_texts *texts)
{
    tn_files files;
    tn_files_begin(&files, texts->stdlib);
    files.kept.overlay = texts->overlay;
    files.kept.overlay_context = texts->context;
    const tn_compile_options options = {.resolver = tn_files_resolver(&files),
                                        .census = tn_plan_census,
                                        .attachments = tn_file_attachments,
                                        .partial = true};
    tn_status status = compile_input(analysis, input, &options);
    tn_files_clear(&files);
    return status;
}

tn_file_analysis *tn_analysis_new(const char *path, const char *text, size_t size, const tn_analysis_texts *texts)
{
    tn_file_analysis *analysis = calloc(1, sizeof *analysis);
    if (!analysis)
        return NULL;
    const tn_input input = {.text = text, .size = size, .name = path};
    tn_status status = texts->served ? compile_served(analysis, &input, texts) : compile_file(analysis, &input, texts);
    analysis->lines = calloc(analysis->compilation.sources.count + 1, sizeof *analysis->lines);
    if (analysis->compilation.sources.count > 0 && analysis->compilation.arena) {
        read_tokens(analysis);
        if (analysis->compilation.imports)
            tn_index_build(&analysis->index, &analysis->compilation);
    }
    if (analysis->lines && status != TN_MEMORY)
        return analysis;
    tn_analysis_free(analysis);
    return NULL;
}

const tn_lines *tn_analysis_lines(tn_file_analysis *analysis, uint32_t file)
{
    if (file >= analysis->compilation.sources.count)
        return NULL;
    tn_lines *lines = &analysis->lines[file];
    const tn_source *source = &analysis->compilation.sources.files[file];
    if (!lines->starts && !tn_lines_make(lines, source->text, source->size))
        return NULL;
    return lines;
}

json_t *tn_analysis_range(tn_file_analysis *analysis, tn_span span)
{
    const tn_lines *lines = tn_analysis_lines(analysis, span.file);
    return lines ? tn_lines_range(lines, span.begin, span.end) : json_null();
}

/* ---- keeps the texts that an editor has open */

/* What texts of the standard library are called if they are built in. */
static const char recorded_folder[] = "<stdlib>/";

tn_status tn_workspace_open(const tn_served *served, tn_workspace *workspace, tn_error *error)
{
    *workspace =
        (tn_workspace){.served = served, .memory = tn_plan_memory_new(0)}; /* without it all is only found again */
    if (served)
        return TN_OK;
    return tn_stdlib_dirs_find(&workspace->stdlib, error);
}

static void forget_analysis(tn_document *document)
{
    tn_analysis_free(document->analysis);
    document->analysis = NULL;
}

static void free_document(tn_document *document)
{
    forget_analysis(document);
    tn_facts_free(document->facts);
    free(document->uri);
    free(document->path);
    free(document->text);
    free(document);
}

void tn_workspace_clear(tn_workspace *workspace)
{
    for (tn_document *document = workspace->documents, *next; document; document = next) {
        next = document->next;
        free_document(document);
    }
    workspace->documents = NULL;
    for (size_t i = 0; i < workspace->root_count; i++)
        free(workspace->roots[i]);
    free(workspace->roots);
    workspace->roots = NULL;
    workspace->root_count = 0;
    tn_stdlib_dirs_clear(&workspace->stdlib);
    tn_plan_memory_free(workspace->memory);
    workspace->memory = NULL;
}

tn_document *tn_workspace_find(const tn_workspace *workspace, const char *uri)
{
    tn_document *document = workspace->documents;
    while (document && strcmp(document->uri, uri) != 0)
        document = document->next;
    return document;
}

bool tn_workspace_add_root(tn_workspace *workspace, const char *uri)
{
    char *path = uri_path(uri);
    if (!path || !tn_array_resize(&workspace->roots, workspace->root_count + 1, sizeof *workspace->roots)) {
        free(path);
        return false;
    }
    workspace->roots[workspace->root_count++] = path;
    return true;
}

bool tn_workspace_is_stdlib(const tn_workspace *workspace, const char *path)
{
    if (strncmp(path, recorded_folder, sizeof recorded_folder - 1) == 0)
        return true;
    for (size_t i = 0; i < workspace->stdlib.count; i++) {
        const char *dir = workspace->stdlib.dirs[i];
        char real[PATH_MAX];
        size_t size = strlen(dir);
        if (strncmp(path, dir, size) == 0)
            return true;
        if (realpath(dir, real) && strncmp(path, real, strlen(real)) == 0 && path[strlen(real)] == '/')
            return true;
    }
    return false;
}

/* Does the analysis rest on the text of the file? Where a name leads to nothing yet, it may from now on. */
static bool rests_on(const tn_file_analysis *analysis, const char *path)
{
    const tn_imports *imports = analysis->compilation.imports;
    if (!imports || imports->count == 0 || imports->units[imports->count - 1]->incomplete)
        return true;
    for (size_t i = 0; i < imports->count; i++)
        if (strcmp(imports->units[i]->identity, path) == 0)
            return true;
    return false;
}

static void text_changed(tn_workspace *workspace, const char *path)
{
    for (tn_document *document = workspace->documents; document; document = document->next) {
        bool own = strcmp(document->path, path) == 0;
        if (!own && document->analysis && !rests_on(document->analysis, path))
            continue;
        forget_analysis(document);
        document->dirty = document->due = true;
    }
}

/* The file's real path, or what would be: ends so that it says the notation. */
static char *path_of_uri(const tn_workspace *workspace, const char *uri, const char *language)
{
    char *path = uri_path(uri), *longer = NULL;
    char *real = path && !workspace->served ? realpath(path, NULL) : NULL;
    char *found = real ? real : path;
    if (real)
        free(path);
    if (!found || tn_notation_of(found, "", 0))
        return found;
    const tn_notation *notation = language ? tn_notation_of_language(language, "", 0) : NULL;
    if (asprintf(&longer, "%s%s", found, (notation ? notation : &tn_notations[0])->extension) < 0)
        longer = NULL;
    free(found);
    return longer;
}

static tn_document *new_document(tn_workspace *workspace, const char *uri, const char *language)
{
    tn_document *document = calloc(1, sizeof *document);
    if (!document)
        return NULL;
    document->uri = strdup(uri);
    document->path = path_of_uri(workspace, uri, language);
    if (!document->uri || !document->path) {
        free_document(document);
        return NULL;
    }
    document->next = workspace->documents;
    workspace->documents = document;
    return document;
}

bool tn_workspace_put(tn_workspace *workspace, const char *uri, const char *language, const char *text,
                      json_int_t version)
{
    char *copy = strdup(text);
    tn_document *document = copy ? tn_workspace_find(workspace, uri) : NULL;
    if (copy && !document)
        document = new_document(workspace, uri, language);
    if (!document) {
        free(copy);
        return false;
    }
    free(document->text);
    document->text = copy;
    document->size = strlen(copy);
    document->version = version;
    text_changed(workspace, document->path);
    return true;
}

void tn_workspace_remove(tn_workspace *workspace, const char *uri)
{
    for (tn_document **place = &workspace->documents; *place; place = &(*place)->next) {
        tn_document *document = *place;
        if (strcmp(document->uri, uri) != 0)
            continue;
        *place = document->next;
        text_changed(workspace, document->path);
        free_document(document);
        return;
    }
}

void tn_workspace_file_changed(tn_workspace *workspace, const char *uri)
{
    char *path = path_of_uri(workspace, uri, NULL);
    if (path)
        text_changed(workspace, path);
    free(path);
}

/* ---- changes */

static bool apply_change(tn_document *document, const json_t *change)
{
    const char *added = json_string_value(json_object_get(change, "text"));
    const json_t *range = json_object_get(change, "range");
    size_t begin = 0, end = document->size;
    if (!added)
        return false;
    if (json_is_object(range)) {
        tn_lines lines;
        if (!tn_lines_make(&lines, document->text, document->size))
            return false;
        bool good = tn_lines_read(&lines, json_object_get(range, "start"), &begin) &&
                    tn_lines_read(&lines, json_object_get(range, "end"), &end) && begin <= end;
        tn_lines_clear(&lines);
        if (!good)
            return false;
    }
    size_t added_size = strlen(added), size = document->size - (end - begin) + added_size;
    char *text = malloc(size + 1);
    if (!text)
        return false;
    memcpy(text, document->text, begin);
    memcpy(text + begin, added, added_size);
    memcpy(text + begin + added_size, document->text + end, document->size - end + 1);
    free(document->text);
    document->text = text;
    document->size = size;
    return true;
}

bool tn_workspace_change(tn_workspace *workspace, tn_document *document, const json_t *changes, json_int_t version)
{
    size_t i;
    const json_t *change;
    bool good = json_is_array(changes);
    json_array_foreach(changes, i, change)
    {
        good = good && apply_change(document, change);
    }
    document->version = version;
    text_changed(workspace, document->path);
    return good;
}

/* ---- analysing */

bool tn_workspace_text(void *context, const char *real_path, const char **text, size_t *size)
{
    const tn_workspace *workspace = context;
    for (const tn_document *document = workspace->documents; document; document = document->next) {
        if (strcmp(document->path, real_path) != 0)
            continue;
        *text = document->text;
        *size = document->size;
        return true;
    }
    return false;
}

tn_file_analysis *tn_workspace_analyse(tn_workspace *workspace, tn_document *document)
{
    if (!document->analysis)
        document->analysis =
            tn_analysis_new(document->path, document->text, document->size,
                            &(tn_analysis_texts){workspace->served, &workspace->stdlib, tn_workspace_text, workspace});
    return document->analysis;
}

/* A file's real path, or its path among those that are served. */
static const char *identity_of(const tn_file_analysis *analysis, uint32_t file, const char *path)
{
    const tn_imports *imports = analysis->compilation.imports;
    for (size_t i = 0; imports && i < imports->count; i++)
        if (imports->units[i]->file == file)
            return imports->units[i]->identity;
    return path;
}

static char *library_uri(const char *name)
{
    char *uri;
    return asprintf(&uri, "stdlib:/%s", name) < 0 ? NULL : uri;
}

char *tn_document_source_uri(const tn_document *document, uint32_t file)
{
    const char *path = document->analysis->compilation.sources.files[file].path;
    if (file == 0)
        return strdup(document->uri);
    if (strncmp(path, recorded_folder, sizeof recorded_folder - 1) == 0)
        return library_uri(path + sizeof recorded_folder - 1);
    return tn_path_uri(identity_of(document->analysis, file, path));
}

json_t *tn_analysis_location(const tn_document *document, tn_span span)
{
    if (span.file >= document->analysis->compilation.sources.count)
        return json_null();
    char *uri = tn_document_source_uri(document, span.file);
    json_t *location =
        json_pack("{s:s,s:o}", "uri", uri ? uri : "", "range", tn_analysis_range(document->analysis, span));
    free(uri);
    return location;
}

/* ---- URIs */

static int hex_digit(char c)
{
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

/* A path from a `file:` URI, and back; other URIs stay as they are, and a text of the built-in standard library is at
 * `stdlib:/NAME`. The caller frees them. */
static char *uri_path(const char *uri)
{
    static const char scheme[] = "file://";
    if (strncmp(uri, scheme, sizeof scheme - 1) != 0)
        return strdup(uri);
    const char *from = strchr(uri + sizeof scheme - 1, '/'); /* after the host, which is mostly empty */
    char *path = from ? malloc(strlen(from) + 1) : strdup(uri);
    char *to = path;
    if (!from || !path)
        return path;
    while (*from) {
        int high = *from == '%' ? hex_digit(from[1]) : -1, low = high >= 0 ? hex_digit(from[2]) : -1;
        bool coded = low >= 0 && (high || low);
        *to++ = coded ? (char)(high * 16 + low) : *from;
        from += coded ? 3 : 1;
    }
    *to = '\0';
    return path;
}

char *tn_path_uri(const char *path)
{
    static const char plain[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
    if (path[0] != '/')
        return strdup(path);
    char *uri = malloc(sizeof "file://" + 3 * strlen(path));
    if (!uri)
        return NULL;
    char *to = stpcpy(uri, "file://");
    for (; *path; path++) {
        if (strchr(plain, *path))
            *to++ = *path;
        else
            to += sprintf(to, "%%%02X", (unsigned char)*path);
    }
    *to = '\0';
    return uri;
}
