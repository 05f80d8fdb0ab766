/* What one text means, with all that it uses: compiled, and indexed for questions. Owns all of it. */
#ifndef TARTAN_LSP_ANALYSIS_H
#define TARTAN_LSP_ANALYSIS_H

#include <jansson.h>

#include "compiler/compile.h"
#include "driver/open/served.h"
#include "lsp/index.h"
#include "lsp/lines.h"

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

#endif
