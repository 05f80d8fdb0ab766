/* The documents that an editor has open, and what compiling each has found out. Owns all of it. */
#ifndef TARTAN_LSP_WORKSPACE_H
#define TARTAN_LSP_WORKSPACE_H

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>

#include "compiler/common/source.h"
#include "compiler/compile.h"
#include "driver/open/served.h"
#include "lsp/index.h"
#include "runtime/plan/library/memory.h"

/* ---- the rule files of the folders that an editor has open */

typedef struct tn_rule_files {
    char **paths; /* real ones, in no order; a file may be there twice */
    size_t count, capacity;
    size_t entries; /* of folders, looked at so far */
    bool cut_off;   /* there is more than is looked at */
    bool failed;    /* out of memory */
} tn_rule_files;

#define TN_FOLDER_DEPTH_MAX 16u
#define TN_FOLDER_ENTRIES_MAX 20000u /* some 20 ms */

/* Adds the .plan files of a folder, and of the folders in it to the depth given (0: of it alone). Hidden ones and
 * node_modules are passed over, links to folders are not followed. A folder that cannot be read has none. */
void tn_rule_files_find(tn_rule_files *files, const char *folder, unsigned depth);
void tn_rule_files_clear(tn_rule_files *files);

/* ---- places of the language server protocol as JSON (compiler/common/text_lines.h) */

/* {"line", "character"} of a byte; {"start", "end"} of a stretch. */
json_t *tn_lines_position(const tn_lines *lines, size_t offset);
json_t *tn_lines_range(const tn_lines *lines, size_t begin, size_t end);

/* Reads a position; false where it is none. */
bool tn_lines_read(const tn_lines *lines, const json_t *position, size_t *offset);

/* ---- what one text means, with all that it uses */

typedef struct tn_file_analysis {
    tn_compilation compilation;
    tn_lines *lines;  /* of each source, made when needed */
    tn_index index;   /* of a .plan file */
    tn_tokens tokens; /* of the text itself */
} tn_file_analysis;

/* Where what a text uses comes from. What `overlay` gives stands in for files. */
typedef struct tn_analysis_texts {
    const tn_served *served;      /* NULL: files, and the standard library in these folders */
    const tn_stdlib_dirs *stdlib; /* not looked at if `served` is there */
    tn_overlay *overlay;
    void *context;
} tn_analysis_texts;

/* Compiles a text; `path` is where it is or would be, a real one (or one of what is served) that ends as files of its
 * notation do. The texts are not asked for afterwards. NULL where out of memory. */
tn_file_analysis *tn_analysis_new(const char *path, const char *text, size_t size, const tn_analysis_texts *texts);
void tn_analysis_free(tn_file_analysis *analysis);

/* The lines of a source; NULL where out of memory. */
const tn_lines *tn_analysis_lines(tn_file_analysis *analysis, uint32_t file);

/* {"start", "end"}, or null. */
json_t *tn_analysis_range(tn_file_analysis *analysis, tn_span span);

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

/* The open text of that path, a tn_overlay (driver/open/files.h) of the workspace. */
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
char *tn_path_uri(const char *path);

#endif
