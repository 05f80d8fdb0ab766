/* Diagnostics: every error, warning and note that a compilation finds, collected, sorted and shown at once.
 *
 *   file:line:col: error[E0123]: message
 *     12 | the source line
 *        |     ^^^^^^ label
 *     note: file:line:col: where the other definition is
 *     help: a likely fix
 *
 * Codes are the rows of codes.def. The list owns its texts; it borrows the sources.
 */
#ifndef TARTAN_COMPILER_COMMON_DIAGNOSTIC_H
#define TARTAN_COMPILER_COMMON_DIAGNOSTIC_H

#include <stdio.h>

#include "compiler/common/arena.h"
#include "compiler/common/source.h"
#include "runtime/base/error.h"
#include "runtime/base/nearest.h"

typedef enum tn_severity { TN_NOTE, TN_WARNING, TN_ERROR } tn_severity;

typedef struct tn_diagnostic_note {
    bool has_span;
    tn_span span;
    char *text;
} tn_diagnostic_note;

typedef struct tn_diagnostic {
    tn_severity severity;
    tn_code code;
    bool has_span;
    tn_span span;
    char *message;
    tn_diagnostic_note *notes;
    size_t note_count;
    bool limit;        /* it says what was not found out since that passes a limit */
    char *help;        /* or NULL */
    char *replacement; /* a text that, put in the span's place, applies the help; or NULL */
    /* a place in an input that is not a source (a plan file): path and line as text; line 0 if it has none */
    char *input_path;
    uint64_t input_line;
    uint32_t input_column, input_column_end;
    char *input_text; /* that line */
    size_t order;     /* in which it was added */
} tn_diagnostic;

typedef struct tn_diagnostics {
    tn_sources *sources; /* borrowed */
    tn_diagnostic *items;
    size_t count, capacity;
    size_t error_count, warning_count;
    size_t error_limit; /* further errors (and further warnings) are counted but not kept; 0: 100 */
    size_t dropped;     /* past the limit */
    bool failed;        /* out of memory while collecting */
    bool stopped;       /* work ended because nobody wanted it any more: nobody's mistake, and not listed */
    struct tn_number_ranges *ranges; /* what checking found of numbers is noted there; NULL: nowhere */
    tn_diagnostic scratch;           /* what is past the limit goes here and is forgotten */
} tn_diagnostics;

void tn_diagnostics_init(tn_diagnostics *list, tn_sources *sources);
void tn_diagnostics_clear(tn_diagnostics *list);

/* Adds one and returns it for notes and help to be added to, valid until the next is added. Severity comes from the
 * code. Never NULL: past the limit (or out of memory) a scratch item is returned and forgotten. */
tn_diagnostic *tn_report(tn_diagnostics *list, tn_code code, tn_span span, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* One without a place in a source. `severity` TN_NOTE with TN_CODE_NONE is a plain note. */
tn_diagnostic *tn_report_bare(tn_diagnostics *list, tn_severity severity, uint32_t code, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* The same with the arguments as a list. */
tn_diagnostic *tn_report_bare_list(tn_diagnostics *list, tn_severity severity, uint32_t code, const char *format,
                                   va_list args) __attribute__((format(printf, 4, 0)));

/* From an error of the runtime: message, help and code. Where it has a place, input_path names the input that it is in
 * and input_text is the line (input_size bytes, without its line end); both may be NULL. */
tn_diagnostic *tn_report_error(tn_diagnostics *list, const tn_error *error, const char *input_path,
                               const char *input_text, size_t input_size);

void tn_note(tn_diagnostics *list, tn_diagnostic *diagnostic, const tn_span *span, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
void tn_help(tn_diagnostics *list, tn_diagnostic *diagnostic, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* What to put in the span's place to follow the help: for editors. */
void tn_replace_with(tn_diagnostics *list, tn_diagnostic *diagnostic, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Help and replacement in one: "did you mean `...`?" and "write `...`". */
void tn_suggest(tn_diagnostics *list, tn_diagnostic *diagnostic, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void tn_advise(tn_diagnostics *list, tn_diagnostic *diagnostic, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Moves what `from` holds to the end of another list, whose sources have those of `from` from number `first_file` on.
 */
void tn_diagnostics_move(tn_diagnostics *from, tn_diagnostics *to, uint32_t first_file);

/* Forgets all but the errors. */
void tn_diagnostics_keep_errors(tn_diagnostics *list);

/* Orders by file, place, code; drops exact repeats. Items without a place come last, in the order they were added. */
void tn_diagnostics_sort(tn_diagnostics *list);

/* "error", "warning" or "note". */
const char *tn_severity_text(tn_severity severity);

/* "E0301" or "W012" (buffer of 8). */
void tn_code_name(uint32_t code, char name[8]);

typedef struct tn_show_options {
    bool json; /* one JSON array of objects */
    bool colour;
} tn_show_options;

/* Writes all of them (library code does not choose the stream). JSON objects:
 * {"severity","code","message","file","line",
 * "column","end_line","end_column","notes":[{"message","file","line","column"}],"help","replacement"}; what an item
 * does not have is null. Bytes that are no UTF-8 are shown as U+FFFD (runtime/base/json.h). */
void tn_diagnostics_show(tn_diagnostics *list, const tn_show_options *options, FILE *out);

/* Such an array of one that has no place, where there is no list: for a command that is ended from without. help may
 * be NULL. */
void tn_diagnostics_show_alone(tn_severity severity, tn_code code, const char *message, const char *help, FILE *out);

/* Between what the numbers of a text may lie, as checking found it out: for whoever shows them as sliders.
 *
 * Where a check holds a number to a least or a most, it notes them with the diagnostics of its compilation. The notes
 * live in the compilation's arena. */

typedef struct tn_number_range {
    tn_span span;             /* of the number, with or without its sign */
    const char *least, *most; /* as they would be written; NULL: there is none */
    struct tn_number_range *next;
} tn_number_range;

typedef struct tn_number_ranges {
    tn_arena *arena;
    tn_number_range *first, *last;
    size_t count;
} tn_number_ranges;

/* Notes the least and the most; -INFINITY and INFINITY are none. Does nothing if nobody gathers them; out of memory is
 * the arena's to remember. */
void tn_range_note(tn_diagnostics *diagnostics, tn_span span, double least, double most);

/* The same of whole numbers of 64 bits, from 0 on. */
void tn_range_note_whole64(tn_diagnostics *diagnostics, tn_span span);

#endif
