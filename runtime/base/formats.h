/* What the ending of a file's name promises, and which endings a command writes: a column of its table of options. */
#ifndef TARTAN_BASE_FORMATS_H
#define TARTAN_BASE_FORMATS_H

#include <stdbool.h>
#include <stdint.h>

#include "runtime/base/error.h"

typedef enum tn_file_format {
#define FORMAT(NAME, WORD, ENDINGS, CONTENT, HOLDS) TN_FILE_##NAME,
#include "runtime/base/formats.def"
#undef FORMAT
    TN_FILE_FORMATS,
    TN_FILE_OTHER = TN_FILE_FORMATS /* an ending that promises nothing, or none */
} tn_file_format;

/* A set of formats. */
typedef uint64_t tn_file_formats;
#define TN_WRITES(NAME) (UINT64_C(1) << TN_FILE_##NAME)
#define TN_WRITES_PICTURES (TN_WRITES(SVG) | TN_WRITES(PNG) | TN_WRITES(PDF))
#define TN_WRITES_TEXT (UINT64_C(1) << 62) /* where the ending promises nothing */
#define TN_WRITES_FOLDER (UINT64_C(1) << 61)
#define TN_WRITES_STANDARD                                                                                             \
    (UINT64_C(1) << 60)                     /* "-" is standard output; so it is where text or another name is well     \
                                             */
#define TN_WRITES_ASKED (UINT64_C(1) << 63) /* another name is well, too: an option says what it is of */
#define TN_OF_PLANS_ALONE (UINT64_C(1) << 59)
#define TN_WRITES_DXF_OF_PLANS (TN_WRITES(DXF) | TN_OF_PLANS_ALONE) /* DXF, but not of all else that is drawn */

tn_file_format tn_file_format_of(const char *path);

/* What --format calls it; "" where nothing does. */
const char *tn_file_format_word(tn_file_format format);

/* Is what such files hold text, in UTF-8? */
bool tn_file_format_is_text(tn_file_format format);

/* The format of that word, if it is one of a set; otherwise TN_INVALID (E0904), with the words that there are. */
tn_status tn_file_format_named(const char *word, tn_file_formats among, tn_file_format *format, tn_error *error);

/* Is the path one of what is written so? Otherwise TN_INVALID (E0904), with the endings that
 * are. what: is written, "a list of plans". */
tn_status tn_file_ending_check(const char *what, const char *path, tn_file_formats writes, tn_error *error);

#endif
