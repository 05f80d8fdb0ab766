/* Compiling rule files (.plan, .hemls, .study, .bnf, .pcfg, .field), and laying them out. Only libtartan has this;
 * libtartan-runtime loads modules. */
#ifndef TARTAN_COMPILE_H
#define TARTAN_COMPILE_H

#include "module.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum tartan_severity { TARTAN_NOTE, TARTAN_WARNING, TARTAN_ERROR } tartan_severity;

typedef struct tartan_diagnostic {
    tartan_severity severity;
    const char *code; /* "E0301", or "" */
    const char *message;
    const char *help;    /* a likely fix, or NULL */
    const char *path;    /* the file it is about, or NULL where it is about none */
    size_t line, column; /* of its begin, from 1; columns count bytes; 0 without a file */
    size_t end_line, end_column;
} tartan_diagnostic;

/* Called for each diagnostic in file order, on the thread that compiles, after compiling; what it points to is valid
 * during the call. */
typedef void tartan_report(void *context, const tartan_diagnostic *diagnostic);

/* A `use` that is asked for. */
typedef struct tartan_use {
    const char *path;      /* as its author wrote it */
    const char *extension; /* of the notation that is asked for, ".plan": for paths that name none */
    const char *user;      /* the name of the text that it is written in */
} tartan_use;

/* A text that was found. */
typedef struct tartan_text {
    const char *text; /* the caller's, to stay there until compiling has ended */
    size_t size;
    const char *name; /* what diagnostics call it, the same for the same text; likewise. NULL: as it was asked for */
} tartan_text;

/* Finds what a `use` asks for, on the thread that compiles. Any status but TARTAN_OK is an error at the `use`, with the
 * message and help of `error` (never NULL); TARTAN_MEMORY ends the compilation. */
typedef tartan_status tartan_resolve(void *context, const tartan_use *use, tartan_text *found, tartan_error *error);

typedef struct tartan_compile_options {
    size_t size;
    tartan_report *report; /* may be NULL */
    void *report_context;
    const char *const *folders; /* where `use "name"`, without slash and extension, is looked for, in this order; none:
                                   among the texts of tartan_stdlib_text */
    size_t folder_count;
    tartan_resolve *resolve; /* where all that is used comes from, and no file is opened; NULL: files, and `folders` */
    void *resolve_context;
    bool warnings_are_errors;
    const tartan_watch *watch; /* or NULL: asked at each text that is compiled; TARTAN_STOPPED once it says so */
    const char *const *params; /* of a .plan file: values for its params instead of their defaults, as `tartan --set`
                                  takes them, "lot=12m" each; what is wrong with one is an error of the compilation, in
                                  a text called "--set". For other notations there must be none */
    size_t param_count;
} tartan_compile_options;
TARTAN_SIZED(tartan_compile_options)

/* Compiles a rule file, or a rule file's text of `size` bytes that diagnostics call `path` (its extension says the
 * notation, and its folder is where `use "file.plan"` begins). `options` may be NULL; without folders and
 * `resolve`, the standard library is that of tartan_stdlib_text. Everything there is to say goes to `report`; where
 * that includes an error the result is TARTAN_INVALID (or TARTAN_IO, TARTAN_LIMIT, TARTAN_MEMORY) and `error` holds the
 * first error. What is a module already is TARTAN_INVALID. A `path` of "-" is standard input. */
TARTAN_API tartan_status tartan_compile_file(const char *path, const tartan_compile_options *options,
                                             tartan_module **module, tartan_error *error);
TARTAN_API tartan_status tartan_compile_text(const char *path, const char *text, size_t size,
                                             const tartan_compile_options *options, tartan_module **module,
                                             tartan_error *error);

/* The same of a .plan file, with further requirements of one of its libraries (NULL: its only one), each an expression
 * as its clauses have them: what `tartan --where` asks. They are clauses `where@1` and so on of the module. text NULL:
 * the file at `path`. */
TARTAN_API tartan_status tartan_compile_where(const char *path, const char *text, size_t size,
                                              const tartan_compile_options *options, const char *library,
                                              const char *const *wheres, size_t count, tartan_module **module,
                                              tartan_error *error);

/* The standard library, as it was when this library was built: how many files it has, and what the one at an index,
 * from 0, is called, with its extension ("shapes.field"); NULL past the last. */
TARTAN_API size_t tartan_stdlib_count(void);
TARTAN_API const char *tartan_stdlib_name(size_t index);

/* The text of the file of that name, of *size bytes (size may be NULL), with a zero byte behind it; NULL if there is
 * none. It stays. For `resolve`, and to show it. */
TARTAN_API const char *tartan_stdlib_text(const char *name, size_t *size);

/* Lays a rule file's text out the one way that `tartan fmt` does, with its comments; `path` says the notation. What is
 * said goes to `report` (may be NULL). A text with errors of syntax is TARTAN_INVALID. Free the text with
 * tartan_text_free. */
TARTAN_API tartan_status tartan_format_text(const char *path, const char *text, size_t size, tartan_report *report,
                                            void *report_context, char **formatted, size_t *formatted_size,
                                            tartan_error *error);

#ifdef __cplusplus
}
#endif

#endif
