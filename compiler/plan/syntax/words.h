/* The words of .plan (words.def): where each may stand, and what it is there. */
#ifndef TARTAN_COMPILER_PLAN_SYNTAX_WORDS_H
#define TARTAN_COMPILER_PLAN_SYNTAX_WORDS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Where the lexer takes a text for the word. In rules (and heads of items, libraries and tests) some are words only
 * under a condition, so that files which have them as names stay what they are. */
typedef enum tn_word_read {
    TN_READ_RULES = 1 << 0,
    TN_READ_OPENING = 1 << 1, /* in rules, where `(` follows */
    TN_READ_WALK = 1 << 2,    /* in rules, after a comma, where a word or `(` follows */
    TN_READ_LATER = 1 << 3,   /* in rules, where no file of an earlier version could have a name (grammar/plan.l) */
    TN_READ_SUM = 1 << 4,     /* in `sum(...)`, up to `of` or a comma */
    TN_READ_SCHEMA = 1 << 5,
    TN_READ_TRAY = 1 << 6, /* in specifiers, `tray(...)` and the like, and in open plans */
    TN_READ_PLAN = 1 << 7, /* in the plans of tests */
    TN_READ_FORM = 1 << 8
} tn_word_read;

enum { TN_READ_TOP = TN_READ_RULES | TN_READ_OPENING | TN_READ_WALK | TN_READ_LATER };

/* Where words stand: sets of the places of the table, as TN_AT(RULE) | TN_AT(CLAUSE). */
enum tn_plan_place {
#define PLACE(ID, READ, WHERE) TN_PLACE_##ID,
#include "compiler/plan/syntax/words.def"
    TN_PLAN_PLACE_COUNT
};
_Static_assert(TN_PLAN_PLACE_COUNT < 64, "a set of places has a bit for each");
#define TN_AT(ID) (UINT64_C(1) << TN_PLACE_##ID)
#define TN_ANYWHERE UINT64_MAX
#define TN_AT_CASES (TN_AT(CASE_OF_RULE) | TN_AT(CASE_OF_LIBRARY) | TN_AT(CASE_OF_MEASURE))

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
    TN_AS_STARTS = TN_AS_CALL | TN_AS_PREFIX | TN_AS_OPERAND | TN_AS_MARK, /* of those in rules: what starts a part */
    TN_AS_NAMES = TN_AS_NAMED | TN_AS_VALUE,
    TN_AS_KEYWORDS = TN_AS_HEAD | TN_AS_CALL | TN_AS_PREFIX | TN_AS_INFIX | TN_AS_OPERAND | TN_AS_MARK | TN_AS_SPELLING
};

typedef struct tn_plan_word {
    const char *text, *sentence;
    uint64_t places;
    uint32_t read, use; /* of tn_word_read (several), tn_word_use (one) */
} tn_plan_word;

extern const tn_plan_word tn_plan_words[];
extern const size_t tn_plan_word_count;

/* The row of the word that is `text`, in capitals or not, stands in one of the places and is one of the uses there; the
 * first of several. NULL where there is none. */
const tn_plan_word *tn_plan_word_find(const char *text, size_t size, uint64_t places, uint32_t uses);

/* Lists the words that stand in one of the places and are one of the uses there, in the order of the table: at most
 * `capacity`. How many these are. */
size_t tn_plan_words_list(uint64_t places, uint32_t uses, const char **texts, size_t capacity);

#endif
