/* Plans, the rules that match them, and libraries of them.
 *
 * A plan is a row of trays; a tray is a number from 0 to tartan_schema_tray_count - 1, in schema order, so that a plan
 * is an array of uint32_t. Text forms of plans are converted with tartan_plan_read and tartan_plan_write. Counts and
 * ranks can have any number of digits: they are decimal texts here. */
#ifndef TARTAN_PLAN_H
#define TARTAN_PLAN_H

#include "module.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- plans and their schema */

typedef struct tartan_schema tartan_schema;

/* Its name, and how many different trays it has. */
TARTAN_API const char *tartan_schema_name(const tartan_schema *schema);
TARTAN_API uint32_t tartan_schema_tray_count(const tartan_schema *schema);

typedef enum tartan_field_kind {
    TARTAN_FIELD_LENGTH, /* values are lengths */
    TARTAN_FIELD_CHOICE, /* values are names */
    TARTAN_FIELD_FLAG,   /* two values: unset, then set */
    TARTAN_FIELD_ZONE    /* values are fills with a depth, or none */
} tartan_field_kind;

/* A field of its trays. Texts are the schema's. */
typedef struct tartan_field {
    size_t size;
    const char *name, *doc; /* doc: "" if its author says nothing of it */
    tartan_field_kind kind;
    size_t value_count;
} tartan_field;
TARTAN_SIZED(tartan_field)

/* A value that a field may have. */
typedef struct tartan_value {
    size_t size;
    const char *name;     /* a length's spelling, a name, of a flag that is unset "-" */
    const char *spelling; /* as plan lines have it: "dense:4'" */
    const char *doc;
    int64_t length; /* nanometres; of a zone its depth; 0 of others */
} tartan_value;
TARTAN_SIZED(tartan_value)

/* Its fields, in file order: how many, and the i-th; and the i-th value of a field, both from 0. */
TARTAN_API size_t tartan_schema_field_count(const tartan_schema *schema);
TARTAN_API tartan_status tartan_schema_field(const tartan_schema *schema, size_t i, tartan_field *field,
                                             tartan_error *error);
TARTAN_API tartan_status tartan_schema_value(const tartan_schema *schema, size_t field, size_t i, tartan_value *value,
                                             tartan_error *error);

/* Which of its values each tray has in a field: fills tartan_schema_tray_count numbers, tray by tray. */
TARTAN_API tartan_status tartan_schema_trays(const tartan_schema *schema, size_t field, uint32_t *values,
                                             tartan_error *error);

/* Reads a plan line (`12' double public - dense:4' open:12' empty | ...`; size bytes, no newline; blank is the plan of
 * no trays) into `trays`, which has room for `capacity`; a plan with more trays than that is TARTAN_LIMIT, and one that
 * cannot be read TARTAN_INVALID, with error.column. */
TARTAN_API tartan_status tartan_plan_read(const tartan_schema *schema, const char *line, size_t size, uint32_t *trays,
                                          size_t capacity, size_t *length, tartan_error *error);

/* Writes a plan line, without a newline, to a new text. Tray numbers out of range are TARTAN_INVALID. */
TARTAN_API tartan_status tartan_plan_write(const tartan_schema *schema, const uint32_t *trays, size_t length,
                                           char **line, tartan_error *error);

/* ---- matching */

typedef struct tartan_rules tartan_rules;

/* Makes rules ready for matching: those named, or with count 0 (`names` may then be NULL) every rule of the compiled
 * file itself, without those that it imports; `watch` may be NULL. All must be of one schema. A name that the module
 * does not have, or a module without rules, is TARTAN_INVALID. A rule that takes more than 20,000 states is
 * interpreted: it decides the same, some thousand times slower, and only plans of up to 4,096 trays (longer ones are
 * TARTAN_LIMIT). */
TARTAN_API tartan_status tartan_rules_new(const tartan_module *module, const char *const *names, size_t count,
                                          const tartan_watch *watch, tartan_rules **rules, tartan_error *error);
TARTAN_API void tartan_rules_free(tartan_rules *rules);
TARTAN_API size_t tartan_rules_count(const tartan_rules *rules);
TARTAN_API const char *tartan_rules_name(const tartan_rules *rules, size_t i); /* NULL past the end */
TARTAN_API const tartan_schema *tartan_rules_schema(const tartan_rules *rules);

/* How many uint64_t words the bits of one plan take: a bit a rule, the i-th rule's being bit i % 64 of word i / 64. */
TARTAN_API size_t tartan_rules_words(const tartan_rules *rules);

typedef struct tartan_matcher tartan_matcher;

/* What matches plans one by one, by rules that are ready; each thread has its own. */
TARTAN_API tartan_status tartan_matcher_new(const tartan_rules *rules, tartan_matcher **matcher, tartan_error *error);
TARTAN_API void tartan_matcher_free(tartan_matcher *matcher);

/* Which rules match one plan: sets tartan_rules_words words. A plan of no trays may be NULL. Tray numbers out of range
 * are TARTAN_INVALID. */
TARTAN_API tartan_status tartan_match(tartan_matcher *matcher, const uint32_t *trays, size_t length, uint64_t *bits,
                                      tartan_error *error);

/* Which rules match each of many plans. `trays` holds them one after another, the i-th ending before trays[ends[i]];
 * `bits` takes tartan_rules_words words a plan. Works in `threads` threads (0: one a processor), which changes nothing
 * but the time; where the system gives fewer, in those. `watch` (may be NULL) is told how many plans are matched. Where
 * it fails, the error is that of the first plan that is wrong, and the bits of the others may be set or not. */
TARTAN_API tartan_status tartan_match_all(const tartan_rules *rules, const uint32_t *trays, const size_t *ends,
                                          size_t count, unsigned threads, uint64_t *bits, const tartan_watch *watch,
                                          tartan_error *error);

/* Does any of the rules match? Sets matches[i] to 1 or 0; otherwise as tartan_match_all, and faster. */
TARTAN_API tartan_status tartan_match_any(const tartan_rules *rules, const uint32_t *trays, const size_t *ends,
                                          size_t count, unsigned threads, uint8_t *matches, const tartan_watch *watch,
                                          tartan_error *error);

/* ---- libraries */

typedef struct tartan_library tartan_library;

typedef struct tartan_library_options {
    size_t size;
    const char *name;              /* NULL: the only library of the compiled file itself */
    uint32_t max_states;           /* of any automaton; 0: 20,000 for a clause, 1,000,000 for all together */
    bool all_generated;            /* leaves pruning out: the plans are all that are generated */
    uint32_t trays_min, trays_max; /* these lengths instead of the library's own, where trays_max is not 0 */
} tartan_library_options;
TARTAN_SIZED(tartan_library_options)

/* Opens a library of the module; `options` and `watch` may be NULL. No such library, or several where none is named, is
 * TARTAN_INVALID. Too many states are TARTAN_LIMIT; max_states is what error.help then means by --max-states. Memory
 * grows with the states, and the time of opening may grow faster. */
TARTAN_API tartan_status tartan_library_open(const tartan_module *module, const tartan_library_options *options,
                                             const tartan_watch *watch, tartan_library **library, tartan_error *error);
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

/* Its clauses, in file order. What one does: how many plans it keeps out (a requirement, of all plans of legal trays; a
 * prune, of those generated), and how many of these no other clause keeps out, in decimal. TARTAN_LIMIT where that
 * takes too many states; for a prune of a library without pruning, TARTAN_INVALID. */
TARTAN_API size_t tartan_library_clause_count(const tartan_library *library);
TARTAN_API const char *tartan_library_clause_name(const tartan_library *library, size_t i); /* NULL past the end */
TARTAN_API bool tartan_library_clause_prunes(const tartan_library *library, size_t i);      /* false: it requires */
TARTAN_API tartan_status tartan_library_clause_effect(const tartan_library *library, size_t i, char **out, char **only,
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
 * same plans everywhere. If the library has weights they are left out here: the request `sample` (tartan_ask) draws by
 * them. Where the library has fewer, all of them. Memory grows with their number. */
TARTAN_API tartan_status tartan_library_sample(const tartan_library *library, uint64_t seed, uint32_t length,
                                               size_t count, tartan_plans **plans, tartan_error *error);

/* Steps to the next plan, which stays valid until the next step; false at the end. */
TARTAN_API bool tartan_plans_next(tartan_plans *plans, const uint32_t **trays, size_t *length);

/* Takes up to `most` plans at once: their trays one after another into `trays`, which has room for `capacity`, and into
 * ends[i] where the i-th ends there, as tartan_match_all takes them. Returns how many these are: 0 at the end, and if
 * the room is less than tartan_library_max_trays; fewer than `most` may be taken before the end, if the room is small.
 */
TARTAN_API size_t tartan_plans_take(tartan_plans *plans, size_t most, uint32_t *trays, size_t capacity, size_t *ends);
TARTAN_API void tartan_plans_free(tartan_plans *plans);

#ifdef __cplusplus
}
#endif

#endif
