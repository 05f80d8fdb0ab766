/* `use`: gets and parses a text and all that it uses, each once.
 *
 * What a path means is the resolver's business (compilation.h), and what parsing means the notation's: import.c is the
 * same for all. Texts that use each other in a circle are an error that names the chain; a text that two others use is
 * parsed once.
 *
 * The units live in the arena; their texts in the diagnostics' sources.
 */
#ifndef TARTAN_COMPILER_COMMON_IMPORT_H
#define TARTAN_COMPILER_COMMON_IMPORT_H

#include "compiler/common/compilation.h"
#include "runtime/module/builder.h"

/* One `use` of a file, as parsed. */
typedef struct tn_use {
    const char *path;
    tn_span span;          /* of the path in its file */
    const char *extension; /* of what is used; NULL: that of the notation */
    struct tn_unit *unit;  /* set by importing: what it led to; NULL if that could not be had */
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

/* Parses a unit: sets its tree, and gives its uses in an array of the arena. False if out of memory. */
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

/* The texts that a module was made of, and what made it, as records of the module. */

/* A builder with the compilation's sources, for a front end to add the rest; NULL if out of memory. */
tn_builder *tn_compilation_begin(const tn_compilation *compilation, const tn_imports *imports, tn_error *error);

/* Makes it the compilation's module where the rest was added well (status), and frees it. Returns what became of it. */
tn_status tn_compilation_finish(tn_compilation *compilation, tn_builder *builder, tn_status status, tn_error *error);

/* Adds a SOURCE record for every source, under the path that importing recorded for it, and the PRODUCER record. */
void tn_emit_sources(tn_builder *builder, const tn_imports *imports, const tn_sources *sources);

/* A path that a file names starts at that file's folder. The module holds it from the folder of the whole, file `root`,
 * on, so that both can be moved together; a file that is used lies below that folder's name or is told from the root.
 * In the arena, which remembers where memory ran out. */
const char *tn_emit_path(tn_arena *arena, const tn_sources *sources, uint32_t file, const char *path, uint32_t root);

#endif
