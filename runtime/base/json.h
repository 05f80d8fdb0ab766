/* The one writer of JSON: to a file or to a text.
 *
 * What is begun is ended by the caller, in order; commas, quotes and line ends are the writer's. Each function writes
 * one value: with `key`, a member of the object that is open, without one (NULL) an item of the list or the whole
 * document. The writer owns nothing, and borrows the file or the text. It never fails by itself: ask ferror() of the
 * file, or `failed` of the text, when all is written.
 *
 * Strings are valid JSON whatever their bytes are. Control characters, line ends and tabs are escapes, and so are the
 * characters that tn_character_hidden() names (U+2028, directions), which come back as they were. Each byte that is
 * not of UTF-8 is shown as U+FFFD. `</` is `<\/`, so that JSON may stand in a page.
 *
 * Numbers are as short as they can be and read back as the same double; what is no number (infinite, NaN) is null. */
#ifndef TARTAN_BASE_JSON_H
#define TARTAN_BASE_JSON_H

#include <gmp.h>
#include <stdint.h>
#include <stdio.h>

#include "runtime/base/buffer.h"

/* {"a":1,"b":[2,3]}; `spaced`, {"a": 1, "b": [2, 3]}. Objects and lists within fewer than `lines` others have an item
 * on each line, `indent` blanks further in than the brackets. */
typedef struct tn_json_layout {
    bool spaced;
    uint8_t lines;
    uint8_t indent;
} tn_json_layout;

#define TN_JSON_TIGHT ((tn_json_layout){.spaced = false})
#define TN_JSON_SPACED ((tn_json_layout){.spaced = true})
#define TN_JSON_LINES ((tn_json_layout){.spaced = true, .lines = UINT8_MAX, .indent = 2})

typedef struct tn_json {
    FILE *file;            /* one of these two */
    tn_buffer *text;       /* is where it goes */
    tn_json_layout layout; /* may be changed between two items: those that follow are written so */
    unsigned depth;        /* of the object or list that is open */
    bool filled;           /* it has an item, which a comma follows */
} tn_json;

tn_json tn_json_file(FILE *file, tn_json_layout layout);
tn_json tn_json_text(tn_buffer *text, tn_json_layout layout);

void tn_json_object(tn_json *json, const char *key);
void tn_json_object_end(tn_json *json);
void tn_json_list(tn_json *json, const char *key);
void tn_json_list_end(tn_json *json);

void tn_json_string(tn_json *json, const char *key, const char *value);             /* NULL is null */
void tn_json_bytes(tn_json *json, const char *key, const char *value, size_t size); /* a string of so many bytes */
void tn_json_base64(tn_json *json, const char *key, const uint8_t *bytes, size_t size); /* any bytes (RFC 4648) */
void tn_json_bool(tn_json *json, const char *key, bool value);
void tn_json_null(tn_json *json, const char *key);
void tn_json_whole(tn_json *json, const char *key, int64_t value);
void tn_json_count(tn_json *json, const char *key, uint64_t value);
void tn_json_number(tn_json *json, const char *key, double value);
void tn_json_rounded(tn_json *json, const char *key, double value, int digits); /* significant ones, 1 to 17 */
void tn_json_numbers(tn_json *json, const char *key, const double *values, size_t count); /* a list */

/* A string of digits: readers of JSON round numbers past 2^53. */
void tn_json_digits(tn_json *json, const char *key, mpz_srcptr value);

/* A place in a source, as members of the object that is open: file, line and column, and where it ends. Lines and
 * columns begin at 1 and columns count bytes; null is what is not known (NULL, 0). */
typedef struct tn_json_place {
    const char *file;
    size_t line, column;
    size_t end_line, end_column;
} tn_json_place;

void tn_json_place_begin(tn_json *json, const tn_json_place *place); /* file, line, column */
void tn_json_place_whole(tn_json *json, const tn_json_place *place); /* and end_line, end_column */

/* Items or members that another writer wrote into a text: one of the same layout, whose depth was set to this one's
 * before. */
void tn_json_written(tn_json *json, const char *text, size_t size);

/* One value that was written so; NULL is null. */
void tn_json_written_value(tn_json *json, const char *key, const char *text);

/* Lines of JSON: ends the document's line, and the next one may begin. */
void tn_json_end_line(tn_json *json);

#endif
