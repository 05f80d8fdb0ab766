/* The table of words of .plan, and how it is searched. */
#include "compiler/plan/syntax/words.h"

#include <string.h>
#include <strings.h>

const tn_plan_word tn_plan_words[] = {
#define WORD(TEXT, TOKEN, READ, PLACES, USE, SENTENCE) {TEXT, SENTENCE, PLACES, READ, USE},
#include "compiler/plan/syntax/words.def"
};
const size_t tn_plan_word_count = sizeof tn_plan_words / sizeof *tn_plan_words;

const tn_plan_word *tn_plan_word_find(const char *text, size_t size, uint64_t places, uint32_t uses)
{
    for (size_t i = 0; i < tn_plan_word_count; i++) {
        const tn_plan_word *word = &tn_plan_words[i];
        if ((word->places & places) && (word->use & uses) && strlen(word->text) == size &&
            strncasecmp(word->text, text, size) == 0)
            return word;
    }
    return NULL;
}

size_t tn_plan_words_list(uint64_t places, uint32_t uses, const char **texts, size_t capacity)
{
    size_t count = 0;
    for (size_t i = 0; i < tn_plan_word_count && count < capacity; i++)
        if ((tn_plan_words[i].places & places) && (tn_plan_words[i].use & uses))
            texts[count++] = tn_plan_words[i].text;
    return count;
}
