/* Keeps the texts that an editor has open. */
#include "lsp/workspace.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lsp/facts.h"
#include "runtime/base/array.h"

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
    char *path = tn_uri_path(uri);
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
    char *path = tn_uri_path(uri), *longer = NULL;
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
