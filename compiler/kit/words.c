/* The table of words of .kit. */
#include "compiler/kit/words.h"

static const tn_vocabulary_word words[] = {
#define WORD(TEXT, TOKEN, PLACES, USE, SENTENCE) {TEXT, SENTENCE, PLACES, USE, 0},
#include "compiler/kit/words.def"
};

static const tn_vocabulary_place places[] = {
#define PLACE(ID, BLOCK, HEADS, WHERE) {BLOCK, HEADS},
#include "compiler/kit/words.def"
};

const tn_vocabulary tn_kit_words = {words, sizeof words / sizeof *words, places, sizeof places / sizeof *places};
