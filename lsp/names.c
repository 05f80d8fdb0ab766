/* Definition, references, highlights and renaming: what the index knows. */
#include <stdlib.h>
#include <string.h>

#include "compiler/common/limits.h"
#include "compiler/plan/syntax/parse.h"
#include "lsp/features.h"
#include "lsp/workspace.h"
#include "runtime/base/file.h"

/* `document` is open, or was read for this: it is gone after the call. False ends the visit. */
typedef bool visit_occurrence(void *context, tn_document *document, tn_span span);

typedef enum tn_visited {
    TN_VISITED_ALL,
    TN_VISITED_CUT_OFF, /* the folders have more files than are looked at */
    TN_VISITED_STOPPED, /* by the visitor, or out of memory */
} tn_visited;

static inline const char *analysis_path(const tn_file_analysis *analysis, uint32_t file)
{
    return analysis->compilation.sources.files[file].path;
}

/* ---- where a name occurs: in the documents that are open, in what they use, and in the rule files of the editor's
 * folders that use the same file */

/* Are two paths those of one file? */
static bool same_file(const char *a, const char *b)
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
            same_file(analysis_path(analysis, symbol->name_span.file), analysis_path(other, s->name_span.file)))
            return s;
    return NULL;
}

/* Is the file of an occurrence open as a document? Then that document's own analysis has it. */
static bool is_open(const tn_workspace *workspace, const char *path)
{
    for (const tn_document *document = workspace->documents; document; document = document->next)
        if (same_file(document->path, path))
            return true;
    return false;
}

/* Those in the document itself, and for the asked one also those in files that are not open. */
static bool visit_document(tn_workspace *workspace, tn_document *asked, const tn_symbol *symbol, tn_document *document,
                           visit_occurrence *visit, void *context)
{
    tn_file_analysis *other = tn_workspace_analyse(workspace, document);
    const tn_symbol *same = other ? same_symbol(asked->analysis, symbol, other) : NULL;
    for (size_t i = 0; same && i < other->index.count; i++) {
        const tn_occurrence *occurrence = &other->index.occurrences[i];
        bool own = occurrence->span.file == 0;
        if (occurrence->symbol != same || (!own && document != asked))
            continue;
        if (!own && is_open(workspace, analysis_path(other, occurrence->span.file)))
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
                       visit_occurrence *visit, void *context)
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
    char *path = workspace->root_count ? NULL : realpath(analysis_path(analysis, symbol->name_span.file), NULL);
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
                               visit_occurrence *visit, void *context)
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

/* Visits every occurrence of a symbol of the asked document's analysis once. */
static tn_visited each_occurrence(tn_workspace *workspace, tn_document *asked, const tn_symbol *symbol,
                                  visit_occurrence *visit, void *context)
{
    for (tn_document *document = workspace->documents; document; document = document->next)
        if (!visit_document(workspace, asked, symbol, document, visit, context))
            return TN_VISITED_STOPPED;
    return visit_closed(workspace, asked, symbol, visit, context);
}

/* ---- definition, references, highlights and renaming */

json_t *tn_lsp_definition(tn_document *document, tn_file_analysis *analysis, size_t offset)
{
    const tn_occurrence *found = tn_index_at(&analysis->index, 0, offset);
    if (found)
        return tn_analysis_location(document, found->symbol->name_span);
    const tn_imports *imports = analysis->compilation.imports;
    const tn_ast_file *tree = imports && imports->count ? imports->units[imports->count - 1]->tree : NULL;
    if (!tree)
        return json_null();
    size_t used = 0; /* a file that is used comes before; the n-th `use` need not be the n-th file: names tell */
    for (TN_EACH(const tn_ast_top, item, tree->items)) {
        const tn_ast_use *use = (const tn_ast_use *)item;
        if (item->kind != TN_ITEM_USE || offset < item->node.span.begin || offset > item->node.span.end)
            continue;
        for (used = 0; used + 1 < imports->count; used++) {
            uint32_t file = imports->units[used]->file;
            const char *path = analysis->compilation.sources.files[file].path;
            const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
            const char *last = strrchr(use->path->text, '/'), *wanted = last ? last + 1 : use->path->text;
            size_t size = strlen(wanted);
            if (strncmp(name, wanted, size) == 0 && (name[size] == '\0' || name[size] == '.'))
                return tn_analysis_location(document, (tn_span){file, 0, 0});
        }
    }
    return json_null();
}

/* ---- references */

typedef struct collected {
    json_t *list;
    const tn_document *asked;
    tn_span skip; /* the definition, where it is not wanted */
    bool skips;
} collected;

static bool collect(void *context, tn_document *document, tn_span span)
{
    collected *c = context;
    bool definition =
        span.begin == c->skip.begin && span.end == c->skip.end &&
        same_file(analysis_path(document->analysis, span.file), analysis_path(c->asked->analysis, c->skip.file));
    if (!c->skips || !definition)
        json_array_append_new(c->list, tn_analysis_location(document, span));
    return true;
}

json_t *tn_lsp_references(tn_workspace *workspace, tn_document *document, tn_file_analysis *analysis, size_t offset,
                          bool declaration)
{
    const tn_occurrence *found = tn_index_at(&analysis->index, 0, offset);
    collected c = {.list = json_array(), .asked = document, .skips = !declaration};
    if (!found)
        return c.list;
    c.skip = found->symbol->name_span;
    each_occurrence(workspace, document, found->symbol, collect, &c);
    return c.list;
}

json_t *tn_lsp_highlight(tn_document *document, tn_file_analysis *analysis, size_t offset)
{
    (void)document;
    const tn_occurrence *found = tn_index_at(&analysis->index, 0, offset);
    json_t *list = json_array();
    for (size_t i = 0; found && i < analysis->index.count; i++) {
        const tn_occurrence *occurrence = &analysis->index.occurrences[i];
        if (occurrence->symbol == found->symbol && occurrence->span.file == 0)
            json_array_append_new(list, json_pack("{s:o}", "range", tn_analysis_range(analysis, occurrence->span)));
    }
    return list;
}

/* ---- renaming */

/* A zone's choice is called by two words, of which `storeys` and `roof` are the language's. */
static bool is_of_zone(const tn_symbol *symbol)
{
    return symbol->kind == TN_SYMBOL_CHOICE && strchr(symbol->name, ' ') != NULL;
}

json_t *tn_lsp_prepare_rename(tn_workspace *workspace, tn_document *document, tn_file_analysis *analysis, size_t offset)
{
    (void)document;
    const tn_occurrence *found = tn_index_at(&analysis->index, 0, offset);
    if (!found || is_of_zone(found->symbol) ||
        tn_workspace_is_stdlib(workspace, analysis_path(analysis, found->symbol->name_span.file)))
        return json_null();
    return tn_analysis_range(analysis, found->span);
}

/* Would the lexer read the text as a name, where a rule's stands? */
static bool is_name(const char *text)
{
    tn_sources sources = {0};
    tn_diagnostics diagnostics;
    tn_error error;
    uint32_t file;
    char line[300];
    int size = snprintf(line, sizeof line, "rule %s = any", text);
    bool good = false;
    tn_arena *arena = tn_arena_new();
    tn_diagnostics_init(&diagnostics, &sources);
    if (arena && size > 0 && (size_t)size < sizeof line && *text &&
        tn_sources_add(&sources, "name", line, (size_t)size, &file, &error) == TN_OK) {
        tn_tokens tokens = {.arena = arena};
        tn_parse_plan(arena, &diagnostics, file, &tokens);
        good = diagnostics.error_count == 0 && tokens.count == 4 && tokens.items[1].kind == TN_TOKEN_NAME &&
               tokens.items[1].span.end - tokens.items[1].span.begin == strlen(text);
    }
    tn_diagnostics_clear(&diagnostics);
    tn_sources_clear(&sources);
    tn_arena_free(arena);
    return good;
}

/* Rules, measures and libraries share their names. */
static bool is_named(const tn_symbol *symbol)
{
    return symbol->kind == TN_SYMBOL_RULE || symbol->kind == TN_SYMBOL_MEASURE || symbol->kind == TN_SYMBOL_PARAM ||
           symbol->kind == TN_SYMBOL_LIBRARY;
}

/* Another one than `but`. */
static bool is_name_of_another(const tn_index *index, const tn_symbol *but, const char *name)
{
    for (const tn_symbol *s = index->first; s; s = s->next)
        if (is_named(s) && s != but && strcmp(s->name, name) == 0)
            return true;
    return false;
}

/* Has something of the same kind that name already? */
static bool is_taken(const tn_index *index, const tn_symbol *symbol, const char *name)
{
    if (is_named(symbol))
        return is_name_of_another(index, symbol, name);
    for (const tn_symbol *s = index->first; s; s = s->next)
        if (s->kind == symbol->kind && s->parent == symbol->parent && s != symbol && strcmp(s->name, name) == 0)
            return true;
    return false;
}

typedef struct renaming {
    json_t *changes;
    const tn_symbol *symbol;
    const char *name;
    const char *reason; /* why it cannot be; or NULL */
} renaming;

static bool add_edit(void *context, tn_document *document, tn_span span)
{
    renaming *r = context;
    bool named = is_named(r->symbol);
    if (named && strcmp(r->name, r->symbol->name) != 0 &&
        is_name_of_another(&document->analysis->index, NULL, r->name)) {
        r->reason = "a file that uses this one has something else of this name";
        return false;
    }
    char *uri = tn_document_source_uri(document, span.file);
    if (!uri)
        return false;
    json_t *edits = json_object_get(r->changes, uri);
    if (!edits) {
        edits = json_array();
        json_object_set_new(r->changes, uri, edits);
    }
    json_array_append_new(
        edits, json_pack("{s:o,s:s}", "range", tn_analysis_range(document->analysis, span), "newText", r->name));
    free(uri);
    return true;
}

json_t *tn_lsp_rename(tn_workspace *workspace, tn_document *document, tn_file_analysis *analysis, size_t offset,
                      const char *name, const char **reason)
{
    const tn_occurrence *found = tn_index_at(&analysis->index, 0, offset);
    *reason = NULL;
    if (!found)
        *reason = "there is no name here";
    else if (tn_workspace_is_stdlib(workspace, analysis_path(analysis, found->symbol->name_span.file)))
        *reason = "the name is the standard library's";
    else if (is_of_zone(found->symbol))
        *reason = "a choice that a zone has keeps its name";
    else if (!is_name(name))
        *reason = "a name is letters, digits, _ and, inside, -, and no word of the language";
    else if (is_taken(&analysis->index, found->symbol, name))
        *reason = "something else has this name already";
    if (*reason)
        return NULL;
    renaming r = {json_object(), found->symbol, name, NULL};
    tn_visited visited = each_occurrence(workspace, document, found->symbol, add_edit, &r);
    if (visited == TN_VISITED_CUT_OFF)
        r.reason = "the open folders hold too many files to look for the name in all of them";
    *reason = r.reason;
    if (visited == TN_VISITED_ALL)
        return json_pack("{s:o}", "changes", r.changes);
    json_decref(r.changes);
    return NULL;
}
