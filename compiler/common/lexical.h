/* What the lexers of all notations share: text that is not text, numbers, lengths, strings. */
#ifndef TARTAN_COMPILER_COMMON_LEXICAL_H
#define TARTAN_COMPILER_COMMON_LEXICAL_H

#include <stddef.h>

#include "compiler/common/arena.h"
#include "compiler/common/diagnostic.h"

/* What flex cannot get from the system it exits for: each lexer gets the few bytes of its state from a pool that is
 * there already, and scans a text that lies in memory. */
typedef struct tn_lexer_pool {
    size_t used;
    _Alignas(max_align_t) unsigned char bytes[1024];
} tn_lexer_pool;

/* NULL if the pool is used up. */
void *tn_lexer_pool_take(tn_lexer_pool *pool, size_t size);

/* The allocator of a lexer whose extra data have a `pool`. Growing is only for buffers, which hold all of the text. */
#define TN_LEXER_MEMORY(PREFIX)                                                                                        \
    void *PREFIX##alloc(yy_size_t size, yyscan_t scanner)                                                              \
    {                                                                                                                  \
        return tn_lexer_pool_take(&PREFIX##get_extra(scanner)->pool, size);                                            \
    }                                                                                                                  \
    void *PREFIX##realloc(void *memory, yy_size_t size, yyscan_t scanner)                                              \
    {                                                                                                                  \
        (void)memory;                                                                                                  \
        return PREFIX##alloc(size, scanner);                                                                           \
    }                                                                                                                  \
    void PREFIX##free(void *memory, yyscan_t scanner)                                                                  \
    {                                                                                                                  \
        (void)memory;                                                                                                  \
        (void)scanner;                                                                                                 \
    }

/* Is the source UTF-8 text without zero bytes? Where it is not, reports the first wrong byte (E0004). */
bool tn_text_check(tn_diagnostics *diagnostics, uint32_t file);

/* Bytes of the byte order mark that the text starts with: 3 or 0. */
size_t tn_text_mark(const char *text, size_t size);

/* The value of decimal digits; false (and INT64_MAX) if it does not fit. */
bool tn_integer_read(const char *digits, size_t size, int64_t *value);

/* The value of a text that is decimal digits and nothing else; false if it is not, or does not fit. */
bool tn_whole_read(const char *text, size_t size, uint64_t *value);

/* Reads a length that `span` covers the start of; returns its bytes (0: none). A length that cannot be held is reported
 * and *broken set, so that nothing else is said about it. */
size_t tn_length_lex(tn_diagnostics *diagnostics, const char *text, size_t size, tn_span span, int64_t *nanometres,
                     bool *broken);

/* What a string says: `text` without its quotes, \" and \\ undone. NULL if out of memory. */
char *tn_string_lex(tn_arena *arena, const char *text, size_t size);

/* Reports a character, or a sign of other languages, that no token starts with (E0003). */
void tn_stray_report(tn_diagnostics *diagnostics, tn_span span);

/* Bytes of the UTF-8 character at the start of a text that tn_text_check has passed. */
size_t tn_character_size(const char *text, size_t size);

/* The value of what a lexer has found to be a decimal number, "-12.5e3", whatever the locale says; infinite where it is
 * too large. */
double tn_decimal_value(const char *text, size_t size);

#endif
