/* The standard library: the folders that it may be in, its files by name, and their texts as they were built in. */
#ifndef TARTAN_DRIVER_OPEN_STDLIB_H
#define TARTAN_DRIVER_OPEN_STDLIB_H

#include "compiler/common/compilation.h"
#include "runtime/base/error.h"

/* Where `use "name"` looks: the folders of $TARTAN_PATH (separated by colons), `stdlib` beside the executable (the
 * build tree), `../share/tartan/stdlib` from it (an installed tree, wherever it was moved), and the configured prefix.
 */

typedef struct tn_stdlib_dirs {
    char **dirs;
    size_t count;
} tn_stdlib_dirs;

/* Clear in any case. */
tn_status tn_stdlib_dirs_find(tn_stdlib_dirs *found, tn_error *error);
void tn_stdlib_dirs_clear(tn_stdlib_dirs *found);

/* A rule file of the standard library, named as `use` names it: without folder and extension. */

typedef struct tn_stdlib_file {
    char *path;     /* where it is; NULL where there is none */
    char *recorded; /* "<stdlib>/NAME.EXTENSION", the same wherever the standard library is installed */
} tn_stdlib_file;

/* Is it a name that can mean such a file: no folder, no extension, and no file of its own? */
bool tn_stdlib_may_mean(const char *name);

/* Looks for the name in the standard library's folders, with the extension of each notation. Clear in any case. */
tn_status tn_stdlib_find(const char *name, tn_stdlib_file *found, tn_error *error);
void tn_stdlib_file_clear(tn_stdlib_file *file);

/* Adds to the error that the file at `path` cannot be read which name of the standard library was likely meant, if
 * there is one. */
void tn_stdlib_suggest(const char *path, tn_error *error);

/* The files of the standard library as they were when this was built, for programs that have no folder of it. */

typedef struct tn_stdlib_text {
    const char *recorded; /* what a module calls it: "<stdlib>/shapes.field" */
    const char *name;     /* "shapes.field" */
    const char *text;     /* a zero byte follows it */
    size_t size;
} tn_stdlib_text;

/* In the order of their names. */
extern const tn_stdlib_text tn_stdlib_texts[];
extern const size_t tn_stdlib_text_count;

/* The file of that name, with its extension; NULL if there is none. */
const tn_stdlib_text *tn_stdlib_text_named(const char *name);

/* A resolver that finds bare names (`use "shapes"`) in these texts, and asks the other one for all else. */
typedef struct tn_stdlib_resolver {
    tn_resolver rest;
} tn_stdlib_resolver;

/* `own` stays the caller's, until compiling has ended. */
tn_resolver tn_stdlib_resolver_of(tn_stdlib_resolver *own);

/* Is it a name of the standard library: without folder and extension? */
bool tn_path_is_bare(const char *path);

#endif
