/* A compilation: what it is told, and all that it makes. compile.h does it. */
#ifndef TARTAN_COMPILER_COMMON_COMPILATION_H
#define TARTAN_COMPILER_COMMON_COMPILATION_H

#include <stdint.h>

#include "compiler/common/arena.h"
#include "compiler/common/diagnostic.h"
#include "runtime/base/error.h"
#include "runtime/base/length.h"
#include "runtime/base/watch.h"

/* Where the compiler gets its texts from: its caller. The compiler itself opens no file.
 *
 * Whoever compiles a text hands it over as a tn_input, and with it a tn_resolver, which is asked for each `use`. It may
 * look in folders (driver/open/files.h), in an editor's buffers, in an archive or in a table. */

/* A text to be compiled. Borrowed, all of it. */
typedef struct tn_input {
    const char *text;
    size_t size;
    const char *name;     /* what diagnostics call it */
    const char *identity; /* the same for the same text, whatever name leads to it; NULL: `name` */
    const char *recorded; /* what a module calls it; NULL: `name` */
} tn_input;

/* One `use`. */
typedef struct tn_request {
    const char *path;      /* as its author wrote it */
    const char *extension; /* of the notation that is asked for, ".plan": for paths that name none */
    const char *user;      /* the name of the text that it is written in */
} tn_request;

#define TN_MEANT_SIZE 320u

/* Finds what a `use` asks for. TN_OK: *found is filled, and stays valid until the compilation has ended. TN_MEMORY ends
 * the compilation. Any other status becomes an error at the `use`, with the code, message and help of `error`; `meant`,
 * TN_MEANT_SIZE bytes that start as an empty text, may then be given the path that was probably meant, which editors
 * offer to put in its place.
 *
 * Called by several threads at once where these compile with the same resolver. */
typedef tn_status tn_resolve(void *context, const tn_request *request, tn_input *found, char *meant, tn_error *error);

typedef struct tn_resolver {
    tn_resolve *resolve; /* NULL: there is nothing that can be used */
    void *context;
} tn_resolver;

struct tn_mesh; /* runtime/geometry/mesh.h */

/* Files that a text names without using them as texts: meshes, pictures, models made elsewhere. The request's path is
 * relative to the text that names it. A failure becomes an error at the name, with the message and help of `error`;
 * TN_MEMORY ends the compilation. Functions that are NULL: no file can be had. */
typedef struct tn_attachments {
    tn_status (*bytes)(void *context, const tn_request *request, uint8_t **bytes, size_t *size, tn_error *error);
    tn_status (*mesh)(void *context, const tn_request *request, struct tn_mesh *mesh, tn_error *error); /* to clear */
    void *context;
} tn_attachments;

/* How many plans of a library have which values of some measures together: what a schema of a library is made of. The
 * compiler never runs a rule, so its caller counts, on a module of what the text says without such schemas. */
typedef struct tn_census_row {
    const char **values; /* [columns]: "p/q", in nanometres to the measure's power */
    const char **texts;  /* [columns]: the same as a word that people read: "12.5m2", "1/3" */
    const char *plans;   /* how many plans: a decimal number above 0 */
} tn_census_row;

typedef struct tn_census {
    tn_census_row *rows; /* no two alike; ascending by the first column, then by the next */
    size_t count;
    size_t columns;
    const int *powers;     /* [columns]: of a length */
    tn_length_style style; /* how the library's schema writes lengths */
} tn_census;

/* What has to be counted. */
typedef struct tn_census_request {
    const uint8_t *module;
    size_t module_size;
    const char *library;
    const char *const *measures; /* by which; of the library's schema */
    size_t measure_count;
    size_t most_values; /* that a measure may have */
    bool brief;         /* an editor waits: little work, or none */
    tn_watch *watch;    /* or NULL */
} tn_census_request;

/* Who counts. TN_OK: the census is filled, in the arena. Any other status is said, with the code, message and help of
 * `error`, where the schema names the library, or the measure *column if that is one of them; TN_MEMORY and TN_STOPPED
 * end the compilation. */
typedef struct tn_census_taker {
    tn_status (*take)(void *context, const tn_census_request *request, tn_arena *arena, tn_census *census,
                      size_t *column, tn_error *error); /* NULL: nobody */
    void *context;
} tn_census_taker;

/* What a command line asks beyond what a .plan file says. */
typedef struct tn_questions {
    const char *library;       /* the library that is asked about; NULL: the only one */
    const char *const *wheres; /* expressions: further requirements, called where@1 and so on */
    size_t where_count;
    const char *schema;       /* of the next two */
    const char *pattern;      /* an open plan, or NULL: its trays become functions of the module */
    const char *plan;         /* a plan in brackets, as tests have it; or NULL */
    const char *plan_name;    /* what messages call these two */
    const char *const *parts; /* of a kit, or NULL: the text is a list of conditions, which may count these parts */
    size_t part_count;
} tn_questions;

/* What the source of a param's value is called, also in modules; its text is NAME=VALUE. */
#define TN_SETTING_SOURCE "--set"

/* Values of params, NAME=VALUE each. */
typedef struct tn_param_values {
    const char *const *items;
    size_t count;
} tn_param_values;

struct tn_imports;

typedef struct tn_compile_options {
    tn_resolver resolver; /* of what is used */
    tn_census_taker census;
    tn_attachments attachments;
    bool warnings_are_errors;
    const tn_questions *questions; /* of a .plan file, or about parts; or NULL */
    tn_param_values params;        /* of a .plan file */
    size_t test; /* of a .plan file: the params have the values that its test of this number, from 1, says; 0: none */
    /* Further texts of the same compilation, in their order, where the notation puts several into one (tn_front.joins).
     */
    const tn_input *more;
    size_t more_count;
    tn_watch *watch; /* or NULL: compiling is given up (TN_STOPPED) between two texts once this says so */
    bool partial;    /* the text may be only a part of what it belongs to: an editor looks at one */
    /* Of a .plan file: changes the syntax trees after they are read and before they are checked, which shows what the
     * file would mean if it were written otherwise; or NULL. What it adds to them lives in the arena. */
    void (*change)(void *context, tn_arena *arena, const struct tn_imports *imports);
    void *change_context;
} tn_compile_options;

typedef struct tn_compilation {
    const struct tn_notation *notation;
    tn_sources sources;
    tn_diagnostics diagnostics;
    tn_arena *arena;
    const tn_input *input;                 /* while it is compiled; NULL afterwards */
    const struct tn_number_ranges *ranges; /* of its numbers (diagnostic.h) */
    struct tn_program *program;            /* checked; NULL if there were errors */
    /* for editors, of a .plan file, and also where there were errors: the files with their syntax trees (import.h), and
     * what became of them (check.h) */
    const struct tn_imports *imports;
    const struct tn_checked *checked;
    const struct tn_checked_fields *fields; /* of a .field file without errors, for breeding (compiler/field/field.h) */
    uint8_t *module;                        /* bytes of the module, owned; NULL if there were errors */
    size_t module_size;
} tn_compilation;

/* Begins to compile the input: a file of sources, an arena. Clear it with tn_compilation_clear in any case. */
tn_status tn_compilation_start(tn_compilation *compilation, const struct tn_notation *notation, const tn_input *input,
                               tn_error *error);
void tn_compilation_clear(tn_compilation *compilation);

/* How a text asks for a file of the LDraw library that the user has: by a request with this extension, whose path is
 * the file's name there (tn_attachments.bytes). TN_IO, E0901, if there is none. */

#define TN_LDRAW_LIBRARY ".dat"

#endif
