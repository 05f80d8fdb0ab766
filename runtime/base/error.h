/* Status codes and the error value that every fallible library function fills.
 *
 * The library never prints, exits or aborts. A function that can fail returns a
 * tn_status and, where it failed, describes the failure in the tn_error that the
 * caller passed (which may be NULL). A tn_error owns nothing: copy it freely.
 */
#ifndef TARTAN_BASE_ERROR_H
#define TARTAN_BASE_ERROR_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What diagnostics are called in code: E_... and W_..., one for each row of codes.def. */

/* The value is the number: E0301 is 301, W012 is 10012. */
typedef enum tn_code {
    TN_CODE_NONE = 0, /* a note that stands alone, as "rule r falls back to the VM" */
#define ERROR(NUMBER, NAME, SUMMARY) E_##NAME = NUMBER,
#define WARNING(NUMBER, NAME, SUMMARY) W_##NAME = 10000 + NUMBER,
#include "runtime/base/codes.def"
#undef ERROR
#undef WARNING
} tn_code;

typedef enum tn_status {
    TN_OK = 0,
    TN_INVALID,  /* the rules or the input are wrong */
    TN_IO,       /* a file could not be read or written */
    TN_LIMIT,    /* an explicit limit was reached */
    TN_MEMORY,   /* an allocation failed */
    TN_INTERNAL, /* a broken invariant of ours */
    TN_STOPPED,  /* whoever asked for it does not want it any more */
} tn_status;

#define TN_NO_OFFSET UINT32_MAX

typedef struct tn_error {
    tn_status status;
    tn_code code;         /* of the diagnostic; TN_CODE_NONE if it has none */
    uint32_t code_offset; /* byte of the code section that it is about, or TN_NO_OFFSET */
    uint64_t line;        /* place in an input text, from 1; 0 if there is none */
    uint32_t column;      /* first byte of the place in its line, from 1 */
    uint32_t column_end;  /* one past its last byte */
    char message[480];    /* one sentence without a final full stop */
    char help[320];       /* a likely fix, or empty */
} tn_error;

/* Fills `error` (where not NULL) and returns `status`. `code` as in tn_error. */
tn_status tn_fail(tn_error *error, tn_status status, tn_code code, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* TN_MEMORY with its standard sentence. */
tn_status tn_fail_memory(tn_error *error);

/* Adds a likely fix to an error already filled. */
void tn_error_help(tn_error *error, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Adds a place in an input text to an error already filled. */
void tn_error_place(tn_error *error, uint64_t line, size_t column, size_t column_end);

#endif
