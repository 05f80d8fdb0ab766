/* Text on its way to a reader: decoding, display columns, and what must not reach a terminal. Internal to the
 * compiler's diagnostics. */
#ifndef TARTAN_BASE_UTF8_H
#define TARTAN_BASE_UTF8_H

#include <stdio.h>

#include "runtime/base/error.h"

#define TN_REPLACEMENT 0xFFFDu

/* Reads one character; *size is its bytes (at least 1). Broken UTF-8 is one byte and TN_REPLACEMENT. */
uint32_t tn_utf8_read(const char *text, size_t left, size_t *size);

/* Code units that the text takes in UTF-16; a byte that is no UTF-8 counts as one. */
size_t tn_utf16_units(const char *text, size_t size);

/* Is the text UTF-8, without surrogates or overlong forms? Zero bytes are allowed. */
bool tn_is_utf8(const char *text, size_t size);

/* Copies as many whole characters as there is room for, and a zero byte. */
void tn_utf8_copy(const char *text, size_t room, char *to);

/* Columns that a character takes on a terminal: 0 for combining marks, 2 for wide East Asian characters and pictures.
 */
unsigned tn_character_width(uint32_t character);

/* Must it be shown as an escape? Control characters would change the terminal's state, direction overrides the
 * order of what is read. */
bool tn_character_hidden(uint32_t character);

/* What a hidden character is shown as: "\x1b" or "\u202e". */
void tn_character_escape(uint32_t character, char text[8]);

/* Writes text for people: hidden characters as escapes, broken UTF-8 as TN_REPLACEMENT. The first makes blanks of line
 * ends and tabs, for text within a line; the second leaves them. */
void tn_write_clean(FILE *out, const char *text, size_t size);
void tn_write_shown(FILE *out, const char *text, size_t size);

#endif
