/* The words of .kit (words.def). */
#ifndef TARTAN_COMPILER_KIT_WORDS_H
#define TARTAN_COMPILER_KIT_WORDS_H

#include "compiler/common/words.h"

/* Sets of the places of the table: TN_KIT_AT(RULE) | TN_KIT_AT(SPACE). */
enum tn_kit_place {
#define PLACE(ID, BLOCK, HEADS, WHERE) TN_KIT_PLACE_##ID,
#include "compiler/kit/words.def"
    TN_KIT_PLACE_COUNT
};
_Static_assert(TN_KIT_PLACE_COUNT < 64, "a set of places has a bit for each");
#define TN_KIT_AT(ID) (UINT64_C(1) << TN_KIT_PLACE_##ID)

extern const tn_vocabulary tn_kit_words;

#endif
