/* `use`: gets and parses a text and all that it uses, each once.
 *
 * What a path means is the resolver's business (resolver.h), and what parsing means the notation's: import.c is the
 * same for all. Texts that use each other in a circle are an error that names the chain; a text that two others use is
 * parsed once.
 *
 * The units live in the arena; their texts in the diagnostics' sources.
 */
#ifndef TARTAN_COMPILER_COMMON_IMPORT_H
#define TARTAN_COMPILER_COMMON_IMPORT_H

#include "compiler/common/compilation.h"

/* One `use` of a file, as parsed. */
typedef struct tn_use {
    const char *path;
    tn_span span;          /* of the path in its file */
    const char *extension; /* of what is used; NULL: that of the notation */
    struct tn_unit *unit;  /* set by importing: what it led to; NULL where that could not be had */
} tn_use;

typedef struct tn_unit {
    uint32_t file; /* in the sources */
    const char
        *extension;       /* ".plan": of the notation, where it is the text that was to be compiled; else of its name */
    const char *identity; /* the same text has one, whatever way leads to it */
    const char *recorded; /* the path that the module records: the same wherever the standard library is installed */
    void *tree;           /* what the notation's parser made of it */
    const tn_use *uses;   /* what it uses, and what that led to */
    size_t use_count;
    bool loading;    /* its uses are being followed */
    bool incomplete; /* something that it uses, directly or not, could not be had */
    uint64_t *reach; /* bit set over units: itself and what it uses, directly or not */
} tn_unit;

/* Parses a unit: sets its tree, and gives its uses in an array of the arena. False where out of memory. */
typedef bool tn_parse_unit(tn_arena *arena, tn_diagnostics *diagnostics, tn_unit *unit, tn_use **uses,
                           size_t *use_count);

typedef struct tn_imports {
    tn_unit **units; /* what a file uses comes before it; the named file is the last */
    size_t count;
} tn_imports;

/* Follows all uses from source 0, the text that is compiled. A path without an extension asks for `extension`, where
 * its `use` does not say which. Errors are in the diagnostics (E0101, E0102, E0831, the resolver's). TN_MEMORY, else
 * TN_OK.
 */
tn_status tn_import_all(tn_compilation *compilation, const tn_compile_options *options, const char *extension,
                        tn_parse_unit *parse, tn_imports *imports);

/* The end of a path from the last point of its last part on: ".plan"; empty where there is none. */
const char *tn_path_extension(const char *path);

/* The last part of a path without its extension, `length` bytes of the path; never longer than a name may be. */
const char *tn_path_stem(const char *path, size_t *length);

/* Can `from` see what `to` defines? Indices of units. */
static inline bool tn_import_reaches(const tn_imports *imports, size_t from, size_t to)
{
    return imports->units[from]->reach[to / 64] >> (to % 64) & 1;
}

#endif
