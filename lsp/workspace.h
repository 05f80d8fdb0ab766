/* The documents that an editor has open, and what compiling each has found out. Owns all of it. */
#ifndef TARTAN_LSP_WORKSPACE_H
#define TARTAN_LSP_WORKSPACE_H

#include "lsp/analysis.h"
#include "runtime/plan/library/memory.h"

typedef struct tn_document {
    struct tn_document *next;
    char *uri, *path; /* path: the real one where there is such a file; ends as files of the notation do */
    char *text;
    size_t size;
    json_int_t version;
    bool dirty;                 /* its diagnostics are to be sent */
    bool due;                   /* its rules are to be looked at in the background */
    tn_file_analysis *analysis; /* NULL: to be made */
    struct tn_facts *facts;     /* of the last text that compiled and was at rest; or NULL */
} tn_document;

typedef struct tn_workspace {
    tn_document *documents;
    const tn_served *served; /* whose files the others are; NULL: those of the file system */
    char **roots;            /* the folders that the editor has open */
    size_t root_count;
    tn_stdlib_dirs stdlib;
    tn_plan_memory *memory; /* what was found out about libraries before; NULL where out of memory */
} tn_workspace;

/* `served` (borrowed) may be NULL: then files are those of the file system. */
tn_status tn_workspace_open(const tn_served *served, tn_workspace *workspace, tn_error *error);
void tn_workspace_clear(tn_workspace *workspace);

tn_document *tn_workspace_find(const tn_workspace *workspace, const char *uri);

/* Adds a folder that the editor has open, by its URI. False where out of memory. */
bool tn_workspace_add_root(tn_workspace *workspace, const char *uri);

/* Adds or replaces a document, takes one out. `language`: what the editor calls its notation, for texts whose name does
 * not say. False where out of memory. */
bool tn_workspace_put(tn_workspace *workspace, const char *uri, const char *language, const char *text,
                      json_int_t version);
void tn_workspace_remove(tn_workspace *workspace, const char *uri);

/* The open text of that path, a tn_overlay (driver/open/kept_texts.h) of the workspace. */
bool tn_workspace_text(void *workspace, const char *real_path, const char **text, size_t *size);

/* Applies the changes of a didChange notification. False where they make no sense (then nothing of the rest is applied)
 * or out of memory. */
bool tn_workspace_change(tn_workspace *workspace, tn_document *document, const json_t *changes, json_int_t version);

/* A file that is not open has another text now, is new or gone. */
void tn_workspace_file_changed(tn_workspace *workspace, const char *uri);

/* The analysis of the text as it is now; NULL where out of memory. Valid until the next change of any document. */
tn_file_analysis *tn_workspace_analyse(tn_workspace *workspace, tn_document *document);

/* {"uri", "range"} of a place, or null. The document's own URI is as the editor wrote it. */
json_t *tn_analysis_location(const tn_document *document, tn_span span);

/* The URI of a source of the document's analysis; the caller frees it. NULL where out of memory. */
char *tn_document_source_uri(const tn_document *document, uint32_t file);

/* Is the source in the standard library? */
bool tn_workspace_is_stdlib(const tn_workspace *workspace, const char *path);

/* A path from a `file:` URI, and back; other URIs stay as they are, and a text of the built-in standard library is at
 * `stdlib:/NAME`. The caller frees them. */
char *tn_uri_path(const char *uri);
char *tn_path_uri(const char *path);

#endif
