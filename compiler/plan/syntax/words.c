/* The table of words of .plan. */
#include "compiler/plan/syntax/words.h"

static const tn_vocabulary_word words[] = {
#define WORD(TEXT, TOKEN, READ, PLACES, USE, SENTENCE) {TEXT, SENTENCE, PLACES, USE, READ},
#include "compiler/plan/syntax/words.def"
};

const tn_vocabulary tn_plan_words = {words, sizeof words / sizeof *words, NULL, 0};
