/* Values and trays as words of an input text: finding them, and saying what is wrong with a word that is none. */
#ifndef TARTAN_PLAN_SCHEMA_VALUE_H
#define TARTAN_PLAN_SCHEMA_VALUE_H

#include "runtime/plan/schema/schema.h"

/* A stretch of a line; `column` of its first byte, from 1; `extent`: the bytes it takes there (with quotes and
 * escapes). */
typedef struct tn_word {
    const char *text;
    size_t size;
    size_t column;
    size_t extent;
} tn_word;

#define TN_NO_VALUE UINT32_MAX
#define TN_WORD_SHOWN 48

/* The word as it may be shown in a message: cut where it is long, what cannot be printed as `?`. */
const char *tn_word_show(const tn_word *word, char shown[TN_WORD_SHOWN]);

/* Puts the word's place into an error that is filled already; returns TN_INVALID. */
tn_status tn_word_refuse(const tn_word *word, tn_error *error);

/* The value of a field (index within it) that the word writes, or TN_NO_VALUE: the schema's own spelling, an equal
 * length in another unit, a zone's fill with an equal depth, or a fill alone (its first depth). */
uint32_t tn_value_find(const tn_schema *schema, uint32_t field, const tn_word *word);

/* The same for a zone whose fill and depth stand apart; depth may be NULL. */
uint32_t tn_value_find_zone(const tn_schema *schema, uint32_t field, const tn_word *fill, const tn_word *depth);

/* E0602: the word is no value of the field; says which are, and what was likely meant. */
tn_status tn_value_unknown(const tn_schema *schema, uint32_t field, const tn_word *word, tn_error *error);

/* The tray with these values (one per field); E0603 where it is forbidden, with the text of the `forbid`. */
tn_status tn_value_tray(const tn_schema *schema, const uint8_t *values, const tn_word *place, tn_tray *tray,
                        tn_error *error);

/* The names of the schema's fields, separated by blanks, as far as they fit. */
const char *tn_value_fields(const tn_schema *schema, char *text, size_t size);

#endif
