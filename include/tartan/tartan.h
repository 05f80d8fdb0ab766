/* Tartan's C interface: compile rule files, load modules, match plans, open plan libraries.
 *
 * Two libraries have this interface. libtartan has all of it. libtartan-runtime has everything but "Compiling": it
 * loads modules
 * (.tnb) that `tartan build` or libtartan made. Link one of the two, by pkg-config (tartan, tartan-runtime) or CMake
 * (find_package(tartan): tartan::tartan, tartan::tartan-runtime).
 *
 * Terms. A plan is a row of trays; a tray is a number from 0 to tartan_schema_tray_count - 1, in schema order, so that
 * a plan is an array of uint32_t. Text forms of plans are converted with tartan_plan_read and tartan_plan_write. Counts
 * and ranks can have any number of digits: they are decimal texts here.
 *
 * Ownership. What a function hands out through a `**` argument is the caller's, to be freed with the _free function of
 * its type (texts: tartan_text_free); where it fails, it leaves that as it was. What it returns as a pointer to const
 * is borrowed from the object asked, and so are matchers from their rules, plans from their library, and rules and
 * libraries from their module: free them in this order, the module last.
 *
 * Threads. Modules, schemas, rules and libraries do not change once made and may be used by many threads at once; a
 * tartan_matcher and a tartan_plans belong to one at a time.
 *
 * Errors. A function that can fail returns a tartan_status and describes the failure in the tartan_error given, which
 * may be NULL. Nothing here prints, exits or aborts. Pointers must not be NULL unless a comment says that they may.
 */
#ifndef TARTAN_TARTAN_H
#define TARTAN_TARTAN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define TARTAN_VERSION_MAJOR 0
#define TARTAN_VERSION_MINOR 1
#define TARTAN_VERSION_PATCH 0
#define TARTAN_VERSION "0.1.0"

#if defined(__GNUC__)
#define TARTAN_API __attribute__((visibility("default")))
#else
#define TARTAN_API
#endif

/* The version of the library that runs, as TARTAN_VERSION is that of the header. */
TARTAN_API const char *tartan_version(void);

/* ---- errors */

typedef enum tartan_status {
    TARTAN_OK = 0,
    TARTAN_INVALID,  /* the rules or the input are wrong */
    TARTAN_IO,       /* a file could not be read or written */
    TARTAN_LIMIT,    /* an explicit limit was reached */
    TARTAN_MEMORY,   /* an allocation failed */
    TARTAN_INTERNAL, /* a mistake of Tartan's own */
} tartan_status;

typedef struct tartan_error {
    tartan_status status;
    uint32_t code;     /* number of the diagnostic: 601 for E0601; 0 where it has none */
    uint32_t column;   /* byte of the plan line given that it is about, from 1; 0 where it is about none */
    char message[480]; /* one sentence */
    char help[320];    /* a likely fix, or empty; an option that it names is one of the command's, `tartan` */
} tartan_error;

/* ---- modules */

typedef struct tartan_module tartan_module;

/* Loads a module from memory (copied) or from a file ("-" is standard input). A damaged one, or one of another format
 * version, is TARTAN_INVALID; one of more than 256 MiB, 1,000,000 records in a section or a stack of 4,096 in a
 * function TARTAN_LIMIT. Any bytes may be given: what does not verify never runs. */
TARTAN_API tartan_status tartan_module_load(const void *bytes, size_t size, tartan_module **module,
                                            tartan_error *error);
TARTAN_API tartan_status tartan_module_load_file(const char *path, tartan_module **module, tartan_error *error);
TARTAN_API void tartan_module_free(tartan_module *module); /* NULL is fine, as for every _free */

/* The module as it is on disk; write these bytes to a file to keep it. Borrowed. */
TARTAN_API const void *tartan_module_bytes(const tartan_module *module, size_t *size);

/* Its rules and libraries, in file order, those of imported files first. Texts are borrowed; past the end, NULL. */
TARTAN_API size_t tartan_module_rule_count(const tartan_module *module);
TARTAN_API const char *tartan_module_rule_name(const tartan_module *module, size_t i);
TARTAN_API const char *tartan_module_rule_doc(const tartan_module *module, size_t i); /* "" where it has none */
TARTAN_API size_t tartan_module_library_count(const tartan_module *module);
TARTAN_API const char *tartan_module_library_name(const tartan_module *module, size_t i);
TARTAN_API const char *tartan_module_library_doc(const tartan_module *module, size_t i);

/* ---- plans and their schema */

typedef struct tartan_schema tartan_schema;

TARTAN_API const char *tartan_schema_name(const tartan_schema *schema);
TARTAN_API uint32_t tartan_schema_tray_count(const tartan_schema *schema);

/* Reads a plan line (`12' double public - dense:4' open:12' empty | ...`; size bytes, no newline; blank is the plan of
 * no trays) into `trays`, which has room for `capacity`; a plan with more trays than that is TARTAN_LIMIT, and one that
 * cannot be read TARTAN_INVALID, with error.column. */
TARTAN_API tartan_status tartan_plan_read(const tartan_schema *schema, const char *line, size_t size, uint32_t *trays,
                                          size_t capacity, size_t *length, tartan_error *error);

/* Writes a plan line, without a newline, to a new text. Tray numbers out of range are TARTAN_INVALID. */
TARTAN_API tartan_status tartan_plan_write(const tartan_schema *schema, const uint32_t *trays, size_t length,
                                           char **line, tartan_error *error);

TARTAN_API void tartan_text_free(char *text);

/* ---- matching */

typedef struct tartan_rules tartan_rules;

/* Makes rules ready for matching: those named, or with count 0 (`names` may then be NULL) every rule of the compiled
 * file itself, without those that it imports. All must be of one schema. A name that the module does not have, or a
 * module without rules, is TARTAN_INVALID. A rule that takes more than 20,000 states is interpreted: it decides the
 * same, some thousand times slower, and only plans of up to 4,096 trays (longer ones are TARTAN_LIMIT). */
TARTAN_API tartan_status tartan_rules_new(const tartan_module *module, const char *const *names, size_t count,
                                          tartan_rules **rules, tartan_error *error);
TARTAN_API void tartan_rules_free(tartan_rules *rules);
TARTAN_API size_t tartan_rules_count(const tartan_rules *rules);
TARTAN_API const char *tartan_rules_name(const tartan_rules *rules, size_t i); /* NULL past the end */
TARTAN_API const tartan_schema *tartan_rules_schema(const tartan_rules *rules);

/* How many uint64_t words the bits of one plan take: a bit a rule, the i-th rule's being bit i % 64 of word i / 64. */
TARTAN_API size_t tartan_rules_words(const tartan_rules *rules);

typedef struct tartan_matcher tartan_matcher;

TARTAN_API tartan_status tartan_matcher_new(const tartan_rules *rules, tartan_matcher **matcher, tartan_error *error);
TARTAN_API void tartan_matcher_free(tartan_matcher *matcher);

/* Which rules match one plan: sets tartan_rules_words words. A plan of no trays may be NULL. Tray numbers out of range
 * are TARTAN_INVALID. */
TARTAN_API tartan_status tartan_match(tartan_matcher *matcher, const uint32_t *trays, size_t length, uint64_t *bits,
                                      tartan_error *error);

/* At most so many threads are used, whatever is asked for. */
#define TARTAN_THREADS_MAX 256

/* Which rules match each of many plans. `trays` holds them one after another, the i-th ending before trays[ends[i]];
 * `bits` takes tartan_rules_words words a plan. Works in `threads` threads (0: one a processor), which changes nothing
 * but the time; where the system gives fewer, in those. Where it fails, the error is that of the first plan that is
 * wrong, and the bits of the others may be set or not. */
TARTAN_API tartan_status tartan_match_all(const tartan_rules *rules, const uint32_t *trays, const size_t *ends,
                                          size_t count, unsigned threads, uint64_t *bits, tartan_error *error);

/* Does any of the rules match? Sets matches[i] to 1 or 0; otherwise as tartan_match_all, and faster. */
TARTAN_API tartan_status tartan_match_any(const tartan_rules *rules, const uint32_t *trays, const size_t *ends,
                                          size_t count, unsigned threads, uint8_t *matches, tartan_error *error);

/* ---- libraries */

typedef struct tartan_library tartan_library;

/* Opens a library of the module; name NULL takes the only one of the compiled file itself. No such library, or several
 * where none is named, is TARTAN_INVALID. A library of which a clause
 * passes the limit of 20,000 states, or all together 1,000,000, is TARTAN_LIMIT; tartan_library_open_within sets both
 * limits to `max_states` (0: those), which is what error.help means by --max-states. Memory grows with the states, and
 * the time of opening may grow faster. */
TARTAN_API tartan_status tartan_library_open(const tartan_module *module, const char *name, tartan_library **library,
                                             tartan_error *error);
TARTAN_API tartan_status tartan_library_open_within(const tartan_module *module, const char *name, uint32_t max_states,
                                                    tartan_library **library, tartan_error *error);
TARTAN_API void tartan_library_free(tartan_library *library);
TARTAN_API const tartan_schema *tartan_library_schema(const tartan_library *library);
TARTAN_API uint32_t tartan_library_max_trays(const tartan_library *library); /* of its longest plan */
TARTAN_API uint32_t tartan_library_min_trays(const tartan_library *library);

/* A hash of what the library means, not of how it is written: 32 hexadecimal digits and a zero byte. */
TARTAN_API void tartan_library_hash(const tartan_library *library, char hex[33]);

/* Length for "plans of any length". */
#define TARTAN_ANY_LENGTH UINT32_MAX

/* How many plans it keeps, of one length (in trays) or of any, in decimal. */
TARTAN_API tartan_status tartan_library_count(const tartan_library *library, uint32_t length, char **count,
                                              tartan_error *error);

/* A plan's rank (from 0; by length, then tray by tray). A plan that is not in the library is TARTAN_INVALID. */
TARTAN_API tartan_status tartan_library_rank(const tartan_library *library, const uint32_t *trays, size_t length,
                                             char **rank, tartan_error *error);

/* The plan of a rank: `trays` has room for tartan_library_max_trays. A rank past the end, or what is no decimal number,
 * is TARTAN_INVALID. */
TARTAN_API tartan_status tartan_library_unrank(const tartan_library *library, const char *rank, uint32_t *trays,
                                               size_t *length, tartan_error *error);

/* Plans of a library, one after another. */
typedef struct tartan_plans tartan_plans;

/* The plans of the ranks from `from` (NULL: the first) up to but without `to` (NULL: to the end), in rank order. Ranks
 * past the end are none. Memory does not grow with their number. */
TARTAN_API tartan_status tartan_library_plans(const tartan_library *library, const char *from, const char *to,
                                              tartan_plans **plans, tartan_error *error);

/* `count` different plans drawn uniformly from those of one length or of any, in rank order: the same seed gives the
 * same plans everywhere. Where the library has fewer, all of them. Memory grows with their number. */
TARTAN_API tartan_status tartan_library_sample(const tartan_library *library, uint64_t seed, uint32_t length,
                                               size_t count, tartan_plans **plans, tartan_error *error);

/* Steps to the next plan, which stays valid until the next step; false at the end. */
TARTAN_API bool tartan_plans_next(tartan_plans *plans, const uint32_t **trays, size_t *length);
TARTAN_API void tartan_plans_free(tartan_plans *plans);

/* ---- compiling (libtartan only) */

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

/* Called for each diagnostic in file order; what it points to is valid during the call. */
typedef void tartan_report(void *context, const tartan_diagnostic *diagnostic);

/* Compiles a rule file, or a rule file's text of `size` bytes that diagnostics call `path`. `use "name"` is looked for
 * in the folders of the environment's TARTAN_PATH, then in the installed stdlib. Everything there is to say goes to
 * `report` (may be NULL); where that includes an error the result is TARTAN_INVALID (or TARTAN_IO, TARTAN_LIMIT,
 * TARTAN_MEMORY) and `error` holds the first error. What is a module already is TARTAN_INVALID. A `path` of "-" is
 * standard input; one without an extension may name a file of the stdlib (`lahave`). */
TARTAN_API tartan_status tartan_compile_file(const char *path, tartan_report *report, void *context,
                                             tartan_module **module, tartan_error *error);
TARTAN_API tartan_status tartan_compile_text(const char *path, const char *text, size_t size, tartan_report *report,
                                             void *context, tartan_module **module, tartan_error *error);

#ifdef __cplusplus
}
#endif

#endif
