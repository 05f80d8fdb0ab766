/* The resolver of the commands: what a `use` means where texts are files.
 *
 * A path with a folder or an extension is relative to the file that uses it. A bare name is looked for in the standard
 * library's folders. What was found is kept, so that a run which compiles thousands of texts finds and reads each file
 * once; who wants to see changes on the disk begins anew.
 */
#ifndef TARTAN_DRIVER_OPEN_FILES_H
#define TARTAN_DRIVER_OPEN_FILES_H

#include <pthread.h>

#include "compiler/common/compilation.h"
#include "driver/open/stdlib.h"
#include "runtime/base/error.h"

/* Texts that were found for whoever compiles, each found and read once, by the thread that asks first.
 *
 * A text is kept under a key, which says what was asked for. How it is found is the caller's: in folders (files.h), or
 * below the folder that is served (served.h). */

/* Texts that stand in for files, by their paths: what an editor has not saved yet. False where the file counts. */
typedef bool tn_overlay(void *context, const char *path, const char **text, size_t *size);

typedef struct tn_kept_text {
    struct tn_kept_text *next;
    char *key;
    char *path;     /* where it is; NULL: the key says it */
    char *identity; /* of all names of a file one, or NULL */
    uint8_t *bytes; /* what `text` is; NULL where the overlay has it */
    const char *text;
    size_t size;
} tn_kept_text;

typedef struct tn_kept_texts {
    tn_overlay *overlay; /* or NULL */
    void *overlay_context;
    pthread_mutex_t lock;
    tn_kept_text *first; /* owned, with all that they have */
} tn_kept_texts;

void tn_kept_begin(tn_kept_texts *kept, tn_overlay *overlay, void *context);
void tn_kept_clear(tn_kept_texts *kept);

/* Finds and reads what the key of `text` stands for: fills the rest of it, which is freed again if that fails. */
typedef tn_status tn_find_text(void *context, tn_kept_text *text, tn_error *error);

/* The text of that key, which is taken over; found by `find` if it is not there yet. It stays until the texts are
 * cleared. */
tn_status tn_kept_get(tn_kept_texts *kept, char *key, tn_find_text *find, void *context, const tn_kept_text **text,
                      tn_error *error);

/* Has the overlay a text for that path? It becomes the text's. */
bool tn_kept_overlaid(const tn_kept_texts *kept, const char *path, tn_kept_text *text);

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
