/* Words that authors write where the language has others, and what to write instead. */
#ifndef TARTAN_COMPILER_PLAN_SYNTAX_SLIP_H
#define TARTAN_COMPILER_PLAN_SYNTAX_SLIP_H

#include <stdbool.h>
#include <stddef.h>

/* Where a word stands that the language does not have. */
typedef enum tn_slip_place {
    TN_SLIP_RULE,
    TN_SLIP_TRAY,
    TN_SLIP_LIBRARY,
    TN_SLIP_TEST,
    TN_SLIP_ITEM,
    TN_SLIP_RANGE
} tn_slip_place;

typedef struct tn_slip {
    tn_slip_place place;
    const char *words;   /* "near|close": in small letters */
    const char *help;    /* what to write */
    const char *instead; /* what to put in the word's place, where that alone mends it; or NULL */
} tn_slip;

/* What the word was likely meant to be there; NULL where it is none of these. */
const tn_slip *tn_slip_find(tn_slip_place place, const char *word, size_t size);

#endif
