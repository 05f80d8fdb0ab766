/* The resolver of the commands: what a `use` means where texts are files.
 *
 * A path with a folder or an extension is relative to the file that uses it. A bare name is looked for in the standard
 * library's folders. What was found is kept, so that a run which compiles thousands of texts finds and reads each file
 * once; who wants to see changes on the disk begins anew.
 */
#ifndef TARTAN_DRIVER_OPEN_FILES_H
#define TARTAN_DRIVER_OPEN_FILES_H

#include "compiler/common/compilation.h"
#include "driver/open/kept_texts.h"
#include "driver/open/stdlib_dirs.h"

typedef struct tn_files {
    const tn_stdlib_dirs *dirs; /* borrowed */
    tn_kept_texts kept;         /* since it was begun; its overlay goes by real paths */
} tn_files;

/* The folders stay the caller's, and there until the end. Clear it in any case. */
void tn_files_begin(tn_files *files, const tn_stdlib_dirs *dirs);
void tn_files_clear(tn_files *files);

/* May be used by several threads at once. What it gives is valid until the files are cleared. */
tn_resolver tn_files_resolver(tn_files *files);

/* The file's real path, or a copy of the path itself where the file system knows of no such file. The caller frees it;
 * NULL where out of memory. */
char *tn_file_identity(const char *path);

/* Grammars whose sentences are Python programs (.pybnf), with their own marks of blocks, look like ours and are not:
 * TN_INVALID (E1263). */
tn_status tn_refuse_python_grammar(const char *path, tn_error *error);

#endif
