#include "lsp/workspace.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "compiler/ast.h"
#include "compiler/parse.h"
#include "lsp/counts.h"

tn_status tn_workspace_open(tn_workspace *workspace, tn_error *error)
{
    *workspace = (tn_workspace){0};
    return tn_stdlib_dirs_find(&workspace->stdlib, error);
}

static void forget_analysis(tn_document *document)
{
    tn_analysis *analysis = document->analysis;
    if (!analysis)
        return;
    for (size_t i = 0; analysis->lines && i < analysis->compilation.sources.count; i++)
        tn_lines_clear(&analysis->lines[i]);
    free(analysis->lines);
    tn_compilation_clear(&analysis->compilation);
    free(analysis);
    document->analysis = NULL;
}

static void free_document(tn_document *document)
{
    forget_analysis(document);
    tn_counts_free(document->counts);
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
    tn_stdlib_dirs_clear(&workspace->stdlib);
}

tn_document *tn_workspace_find(const tn_workspace *workspace, const char *uri)
{
    tn_document *document = workspace->documents;
    while (document && strcmp(document->uri, uri) != 0)
        document = document->next;
    return document;
}

bool tn_workspace_is_stdlib(const tn_workspace *workspace, const char *path)
{
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

bool tn_is_plan(const char *path)
{
    const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash : path, '.');
    return !dot || strcmp(dot, ".plan") == 0;
}

/* Every analysis may rest on the text that changed. */
static void text_changed(tn_workspace *workspace)
{
    for (tn_document *document = workspace->documents; document; document = document->next) {
        forget_analysis(document);
        document->dirty = true;
    }
}

static char *real_path(const char *uri)
{
    char *path = tn_uri_path(uri), *real = path ? realpath(path, NULL) : NULL;
    if (!real)
        return path;
    free(path);
    return real;
}

bool tn_workspace_put(tn_workspace *workspace, const char *uri, const char *text, json_int_t version)
{
    char *copy = strdup(text);
    tn_document *document = tn_workspace_find(workspace, uri);
    if (copy && !document) {
        document = calloc(1, sizeof *document);
        if (document) {
            document->uri = strdup(uri);
            document->path = real_path(uri);
        }
        if (document && document->uri && document->path) {
            document->next = workspace->documents;
            workspace->documents = document;
        } else if (document) {
            free_document(document);
            document = NULL;
        }
    }
    if (!copy || !document) {
        free(copy);
        return false;
    }
    free(document->text);
    document->text = copy;
    document->size = strlen(copy);
    document->version = version;
    text_changed(workspace);
    return true;
}

void tn_workspace_remove(tn_workspace *workspace, const char *uri)
{
    for (tn_document **place = &workspace->documents; *place; place = &(*place)->next) {
        tn_document *document = *place;
        if (strcmp(document->uri, uri) != 0)
            continue;
        *place = document->next;
        free_document(document);
        text_changed(workspace);
        return;
    }
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
    text_changed(workspace);
    return good;
}

/* ---- analysing */

static bool open_text(void *context, const char *real_path, const char **text, size_t *size)
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

/* The compilation has read the tokens and forgotten them. */
static void read_tokens(tn_analysis *analysis)
{
    tn_diagnostics scratch;
    analysis->tokens = (tn_tokens){.arena = analysis->compilation.arena};
    tn_diagnostics_init(&scratch, &analysis->compilation.sources);
    tn_parse_plan(analysis->compilation.arena, &scratch, 0, &analysis->tokens);
    tn_diagnostics_clear(&scratch);
}

tn_analysis *tn_workspace_analyse(tn_workspace *workspace, tn_document *document)
{
    if (document->analysis)
        return document->analysis;
    tn_analysis *analysis = calloc(1, sizeof *analysis);
    if (!analysis)
        return NULL;
    tn_compile_options options = {.stdlib_dirs = (const char *const *)workspace->stdlib.dirs,
                                  .stdlib_dir_count = workspace->stdlib.count,
                                  .overlay = open_text,
                                  .overlay_context = workspace};
    tn_status status =
        tn_compile_text(document->path, document->text, document->size, &options, &analysis->compilation);
    document->analysis = analysis;
    analysis->lines = calloc(analysis->compilation.sources.count + 1, sizeof *analysis->lines);
    bool read = analysis->compilation.sources.count > 0 && analysis->compilation.arena;
    if (read && tn_is_plan(document->path)) {
        read_tokens(analysis);
        tn_index_build(&analysis->index, &analysis->compilation);
    }
    if (analysis->lines && status != TN_MEMORY)
        return analysis;
    forget_analysis(document);
    return NULL;
}

const tn_lines *tn_analysis_lines(tn_analysis *analysis, uint32_t file)
{
    if (file >= analysis->compilation.sources.count)
        return NULL;
    tn_lines *lines = &analysis->lines[file];
    const tn_source *source = &analysis->compilation.sources.files[file];
    if (!lines->starts && !tn_lines_make(lines, source->text, source->size))
        return NULL;
    return lines;
}

json_t *tn_analysis_range(tn_analysis *analysis, tn_span span)
{
    const tn_lines *lines = tn_analysis_lines(analysis, span.file);
    return lines ? tn_lines_range(lines, span.begin, span.end) : json_null();
}

char *tn_document_source_uri(const tn_document *document, uint32_t file)
{
    const char *path = document->analysis->compilation.sources.files[file].path;
    if (file == 0)
        return strdup(document->uri);
    char *real = realpath(path, NULL), *uri = tn_path_uri(real ? real : path);
    free(real);
    return uri;
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

char *tn_uri_path(const char *uri)
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
