/* The words of .plan (words.def): where each may stand, and what it is there. */
#ifndef TARTAN_COMPILER_PLAN_SYNTAX_WORDS_H
#define TARTAN_COMPILER_PLAN_SYNTAX_WORDS_H

#include "compiler/common/words.h"

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
    TN_READ_FORM = 1 << 8,
    TN_READ_LIMIT = 1 << 9 /* behind `only` and `forbid` of a schema */
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
#define TN_AT_CASES (TN_AT(CASE_OF_RULE) | TN_AT(CASE_OF_LIBRARY) | TN_AT(CASE_OF_MEASURE))

enum {
    TN_AS_STARTS = TN_AS_CALL | TN_AS_PREFIX | TN_AS_OPERAND | TN_AS_MARK, /* of those in rules: what starts a part */
};

extern const tn_vocabulary tn_plan_words;

#endif
