/* The words of a notation: where each may stand, what it is there, and what it says. A notation's table is a file
 * words.def of its folder. */
#ifndef TARTAN_COMPILER_COMMON_WORDS_H
#define TARTAN_COMPILER_COMMON_WORDS_H

#include "compiler/common/token.h"

/* What a word is where it stands. */
typedef enum tn_word_use {
    TN_AS_HEAD = 1 << 0,     /* a name of the author's follows */
    TN_AS_CALL = 1 << 1,     /* what it is about follows in parentheses */
    TN_AS_PREFIX = 1 << 2,   /* what it is about follows without them */
    TN_AS_INFIX = 1 << 3,    /* stands between two */
    TN_AS_OPERAND = 1 << 4,  /* stands alone */
    TN_AS_MARK = 1 << 5,     /* says what follows is for, or that something is so */
    TN_AS_SPELLING = 1 << 6, /* a call that is usually spelled otherwise */
    TN_AS_NAMED = 1 << 7,    /* a name to the lexer, and coloured as a word */
    TN_AS_VALUE = 1 << 8     /* a name to the lexer that is a name of the author's elsewhere */
} tn_word_use;

enum {
    TN_AS_NAMES = TN_AS_NAMED | TN_AS_VALUE,
    TN_AS_KEYWORDS = TN_AS_HEAD | TN_AS_CALL | TN_AS_PREFIX | TN_AS_INFIX | TN_AS_OPERAND | TN_AS_MARK | TN_AS_SPELLING
};

typedef struct tn_vocabulary_word {
    const char *text, *sentence;
    uint64_t places; /* a bit for each of the notation's */
    uint32_t use;    /* one of tn_word_use */
    uint32_t read;   /* how its lexer reads it, where that depends on the place; else 0 */
} tn_vocabulary_word;

#define TN_ANYWHERE UINT64_MAX

/* A place of a notation of statements: which block it is in, by the word before the block's brace ("": none), and the
 * words that begin its statement, with blanks between ("": it is where one begins; "*": any; "a name": one of the
 * author's). */
typedef struct tn_vocabulary_place {
    const char *block, *heads;
} tn_vocabulary_place;

typedef struct tn_vocabulary {
    const tn_vocabulary_word *words;
    size_t count;
    const tn_vocabulary_place *places; /* NULL: the notation has another way to tell them */
    size_t place_count;
    bool heads_begin; /* nothing ends a statement: the next one begins with a word that stands where one begins */
} tn_vocabulary;

/* The row of the word that is `text`, in capitals or not, stands in one of the places and is one of the uses there; the
 * first of several. NULL if there is none. */
const tn_vocabulary_word *tn_vocabulary_find(const tn_vocabulary *words, const char *text, size_t size, uint64_t places,
                                             uint32_t uses);

/* Lists the words that stand in one of the places and are one of the uses there, in the order of the table: at most
 * `capacity`. How many these are. */
size_t tn_vocabulary_list(const tn_vocabulary *words, uint64_t places, uint32_t uses, const char **texts,
                          size_t capacity);

/* Does a brace behind this word open a block, in a notation of statements? */
bool tn_vocabulary_head_block(const tn_vocabulary *words, const char *text, size_t size);

/* The places where what comes behind these tokens of the text stands, in a notation of statements. */
uint64_t tn_vocabulary_places(const tn_vocabulary *words, const char *text, const tn_token *tokens, size_t count);

#endif
