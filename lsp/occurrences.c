/* Finds the places where a name is used. */
#include "lsp/occurrences.h"

#include <stdlib.h>
#include <string.h>

#include "compiler/common/limits.h"
#include "lsp/folders.h"
#include "runtime/base/file.h"

bool tn_same_file(const char *a, const char *b)
{
    if (strcmp(a, b) == 0)
        return true;
    char *real_a = realpath(a, NULL), *real_b = realpath(b, NULL);
    bool same = real_a && real_b && strcmp(real_a, real_b) == 0;
    free(real_a);
    free(real_b);
    return same;
}

/* The symbol of another document's analysis that is defined at the same place. */
static const tn_symbol *same_symbol(const tn_file_analysis *analysis, const tn_symbol *symbol,
                                    const tn_file_analysis *other)
{
    if (other == analysis)
        return symbol;
    for (const tn_symbol *s = other->index.first; s; s = s->next)
        if (s->kind == symbol->kind && s->name_span.begin == symbol->name_span.begin &&
            strcmp(s->name, symbol->name) == 0 &&
            tn_same_file(tn_analysis_path(analysis, symbol->name_span.file),
                         tn_analysis_path(other, s->name_span.file)))
            return s;
    return NULL;
}

/* Is the file of an occurrence open as a document? Then that document's own analysis has it. */
static bool is_open(const tn_workspace *workspace, const char *path)
{
    for (const tn_document *document = workspace->documents; document; document = document->next)
        if (tn_same_file(document->path, path))
            return true;
    return false;
}

/* Those in the document itself, and for the asked one also those in files that are not open. */
static bool visit_document(tn_workspace *workspace, tn_document *asked, const tn_symbol *symbol, tn_document *document,
                           tn_visit_occurrence *visit, void *context)
{
    tn_file_analysis *other = tn_workspace_analyse(workspace, document);
    const tn_symbol *same = other ? same_symbol(asked->analysis, symbol, other) : NULL;
    for (size_t i = 0; same && i < other->index.count; i++) {
        const tn_occurrence *occurrence = &other->index.occurrences[i];
        bool own = occurrence->span.file == 0;
        if (occurrence->symbol != same || (!own && document != asked))
            continue;
        if (!own && is_open(workspace, tn_analysis_path(other, occurrence->span.file)))
            continue;
        if (!visit(context, document, occurrence->span))
            return false;
    }
    return true;
}

/* ---- files that are not open */

static bool is_used(const tn_file_analysis *analysis, const char *path)
{
    const tn_imports *imports = analysis->compilation.imports;
    for (size_t i = 0; imports && i < imports->count; i++)
        if (strcmp(imports->units[i]->identity, path) == 0)
            return true;
    return false;
}

static tn_status read_file(const tn_workspace *workspace, const char *path, uint8_t **bytes, size_t *size,
                           tn_error *error)
{
    const tn_served *served = workspace->served;
    return served ? served->read(served->context, path, bytes, size, error)
                  : tn_file_read(path, TN_SOURCE_BYTES_MAX, bytes, size, error);
}

/* Most files do not have the name at all: those are not compiled. */
static bool visit_file(tn_workspace *workspace, tn_document *asked, const tn_symbol *symbol, const char *path,
                       tn_visit_occurrence *visit, void *context)
{
    tn_error error;
    uint8_t *bytes = NULL;
    size_t size = 0;
    bool good = true;
    if (is_open(workspace, path) || is_used(asked->analysis, path) ||
        read_file(workspace, path, &bytes, &size, &error) != TN_OK)
        return true;
    if (memmem(bytes, size, symbol->name, strlen(symbol->name))) {
        tn_document document = {.uri = tn_path_uri(path), .path = strdup(path), .text = (char *)bytes, .size = size};
        good = document.uri && document.path && visit_document(workspace, asked, symbol, &document, visit, context);
        tn_analysis_free(document.analysis);
        free(document.uri);
        free(document.path);
    }
    free(bytes);
    return good;
}

static int compare_paths(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

static void list_served(const tn_served *served, tn_rule_files *files)
{
    tn_error error;
    if (served->read && served->list)
        files->failed =
            served->list(served->context, &files->paths, &files->count, &files->cut_off, &error) == TN_MEMORY;
}

/* If the editor has no folder open: what is beside the file that defines the name. */
static void find_files_on_disk(const tn_workspace *workspace, const tn_file_analysis *analysis, const tn_symbol *symbol,
                               tn_rule_files *files)
{
    for (size_t i = 0; i < workspace->root_count; i++)
        tn_rule_files_find(files, workspace->roots[i], TN_FOLDER_DEPTH_MAX);
    char *path = workspace->root_count ? NULL : realpath(tn_analysis_path(analysis, symbol->name_span.file), NULL);
    char *slash = path ? strrchr(path, '/') : NULL;
    if (slash) {
        slash[slash == path] = '\0';
        tn_rule_files_find(files, path, 0);
    }
    free(path);
}

static void find_files(const tn_workspace *workspace, const tn_file_analysis *analysis, const tn_symbol *symbol,
                       tn_rule_files *files)
{
    if (workspace->served)
        list_served(workspace->served, files);
    else
        find_files_on_disk(workspace, analysis, symbol, files);
    if (files->count)
        qsort(files->paths, files->count, sizeof *files->paths, compare_paths);
}

static tn_visited visit_closed(tn_workspace *workspace, tn_document *asked, const tn_symbol *symbol,
                               tn_visit_occurrence *visit, void *context)
{
    tn_rule_files files = {0};
    find_files(workspace, asked->analysis, symbol, &files);
    bool good = !files.failed;
    for (size_t i = 0; good && i < files.count; i++)
        if (i == 0 || strcmp(files.paths[i], files.paths[i - 1]) != 0)
            good = visit_file(workspace, asked, symbol, files.paths[i], visit, context);
    tn_visited visited = !good ? TN_VISITED_STOPPED : files.cut_off ? TN_VISITED_CUT_OFF : TN_VISITED_ALL;
    tn_rule_files_clear(&files);
    return visited;
}

tn_visited tn_each_occurrence(tn_workspace *workspace, tn_document *asked, const tn_symbol *symbol,
                              tn_visit_occurrence *visit, void *context)
{
    for (tn_document *document = workspace->documents; document; document = document->next)
        if (!visit_document(workspace, asked, symbol, document, visit, context))
            return TN_VISITED_STOPPED;
    return visit_closed(workspace, asked, symbol, visit, context);
}
