/* Searches tables of words, and finds the places of a notation of statements. */
#include "compiler/common/words.h"

#include <string.h>
#include <strings.h>

const tn_vocabulary_word *tn_vocabulary_find(const tn_vocabulary *words, const char *text, size_t size, uint64_t places,
                                             uint32_t uses)
{
    for (size_t i = 0; i < words->count; i++) {
        const tn_vocabulary_word *word = &words->words[i];
        if ((word->places & places) && (word->use & uses) && strlen(word->text) == size &&
            strncasecmp(word->text, text, size) == 0)
            return word;
    }
    return NULL;
}

size_t tn_vocabulary_list(const tn_vocabulary *words, uint64_t places, uint32_t uses, const char **texts,
                          size_t capacity)
{
    size_t count = 0;
    for (size_t i = 0; i < words->count && count < capacity; i++)
        if ((words->words[i].places & places) && (words->words[i].use & uses))
            texts[count++] = words->words[i].text;
    return count;
}

/* ---- places */

static bool is(const char *text, tn_span span, const char *word)
{
    return span.end - span.begin == strlen(word) && strncasecmp(text + span.begin, word, strlen(word)) == 0;
}

/* Is the word one of these, which have blanks between? */
static bool is_one_of(const char *text, tn_span span, const char *words)
{
    for (size_t size; *words; words += size + (words[size] == ' ')) {
        size = strcspn(words, " ");
        if (span.end - span.begin == size && strncasecmp(text + span.begin, words, size) == 0)
            return true;
    }
    return false;
}

bool tn_vocabulary_head_block(const tn_vocabulary *words, const char *text, size_t size)
{
    for (size_t i = 0; i < words->place_count; i++)
        if (words->places[i].block[0] && is(text, (tn_span){0, 0, (uint32_t)size}, words->places[i].block))
            return true;
    return false;
}

/* Does the word begin a statement, wherever it stands? */
static bool is_head(const tn_vocabulary *words, const char *text, const tn_token *token)
{
    tn_span word = token->span;
    uint64_t starts = 0;
    for (size_t i = 0; i < words->place_count; i++)
        if (words->places[i].heads[0] == '\0')
            starts |= UINT64_C(1) << i;
    return token->kind == TN_TOKEN_WORD && tn_vocabulary_find(words, text + word.begin, word.end - word.begin, starts,
                                                              TN_AS_KEYWORDS | TN_AS_NAMED) != NULL;
}

/* May the statement with this head end behind the token? Behind the head alone where that stands alone. */
static bool may_end(const tn_vocabulary *words, const char *text, tn_span head, const tn_token *token)
{
    if (token->span.begin == head.begin)
        return tn_vocabulary_find(words, text + head.begin, head.end - head.begin, TN_ANYWHERE, TN_AS_OPERAND) != NULL;
    return token->kind != TN_TOKEN_SIGN || is(text, token->span, ")");
}

/* Is the place one of the statement with this head? */
static bool is_headed(const tn_vocabulary_place *place, const char *text, tn_span head, bool named)
{
    if (strcmp(place->heads, "a name") == 0)
        return named;
    return place->heads[0] == '*' || is_one_of(text, head, place->heads);
}

uint64_t tn_vocabulary_places(const tn_vocabulary *words, const char *text, const tn_token *tokens, size_t count)
{
    const tn_span none = {0};
    tn_span block = none, head = none; /* empty: in no block; at the start of a statement */
    bool named = false;                /* is the head a name? */
    for (size_t i = 0; i < count; i++) {
        tn_span token = tokens[i].span;
        bool ends = is(text, token, ";") || tokens[i].kind == TN_TOKEN_LINE, opens = is(text, token, "{"),
             closes = is(text, token, "}");
        if (tokens[i].kind == TN_TOKEN_COMMENT)
            continue;
        if (opens && head.end > head.begin && block.end == block.begin &&
            tn_vocabulary_head_block(words, text + head.begin, head.end - head.begin)) {
            block = head;
            head = none;
        } else if (closes && block.end > block.begin) {
            block = head = none;
        } else if (ends) {
            head = none;
        } else if (head.end == head.begin || (words->heads_begin && is_head(words, text, &tokens[i]))) {
            head = token;
            named = tokens[i].kind == TN_TOKEN_NAME;
        }
    }
    bool inside = head.end > head.begin;
    bool begins = !inside || (words->heads_begin && count > 0 && may_end(words, text, head, &tokens[count - 1]));
    uint64_t places = 0;
    for (size_t i = 0; i < words->place_count; i++) {
        const tn_vocabulary_place *place = &words->places[i];
        bool here = place->block[0] ? is(text, block, place->block) : block.end == block.begin;
        if (here && (place->heads[0] == '\0' ? begins : inside && is_headed(place, text, head, named)))
            places |= UINT64_C(1) << i;
    }
    return places;
}
