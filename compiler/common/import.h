/* `use`: finds, reads and parses a file and all that it uses, each once.
 *
 * A path with a slash or an extension is relative to the file that uses it. A bare name is looked for in the standard
 * library's folders. Files that use each other in a circle are an error that names the chain; a file that two others
 * use is read once. What parsing means is the notation's business: import.c is the same for all.
 *
 * The files live in the arena; their texts in the diagnostics' sources.
 */
#ifndef TARTAN_COMPILER_COMMON_IMPORT_H
#define TARTAN_COMPILER_COMMON_IMPORT_H

#include "compiler/common/arena.h"
#include "compiler/common/diagnostic.h"

/* One `use` of a file, as parsed. */
typedef struct tn_use {
    const char *path;
    tn_span span;          /* of the path in its file */
    const char *extension; /* of what is used; NULL: that of the notation */
    struct tn_unit *unit;  /* set by importing: what it led to; NULL where that could not be read */
} tn_use;

/* Parses source `file`: gives its syntax tree, and its uses in an array of the arena. False where out of memory. */
typedef bool tn_parse_unit(tn_arena *arena, tn_diagnostics *diagnostics, uint32_t file, void **unit, tn_use **uses,
                           size_t *use_count);

typedef struct tn_unit {
    uint32_t file;        /* in the sources */
    const char *identity; /* the file's real path: the same file has one, whatever way leads to it */
    const char *recorded; /* the path that the module records: the same wherever the standard library is installed */
    void *tree;           /* what the notation's parser made of it */
    bool loading;         /* its uses are being followed */
    bool incomplete;      /* something that it uses, directly or not, could not be read */
    uint64_t *reach;      /* bit set over units: itself and what it uses, directly or not */
} tn_unit;

typedef struct tn_imports {
    tn_unit **units; /* what a file uses comes before it; the named file is the last */
    size_t count;
} tn_imports;

/* Follows all uses from source `main_file`, which has been added to the sources. Errors are in the diagnostics (E0101,
 * E0102, E0831, E0901). TN_MEMORY, else TN_OK. */
tn_status tn_import_all(tn_arena *arena, tn_diagnostics *diagnostics, const char *const *stdlib_dirs,
                        size_t stdlib_dir_count, const char *extension, tn_parse_unit *parse, uint32_t main_file,
                        tn_imports *imports);

/* Can `from` see what `to` defines? Indices of units. */
static inline bool tn_import_reaches(const tn_imports *imports, size_t from, size_t to)
{
    return imports->units[from]->reach[to / 64] >> (to % 64) & 1;
}

#endif
