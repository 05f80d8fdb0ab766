/* Words that are called otherwise now: `option` was `section`, `floor` was `deck`. The lexer reads both; files are laid
 * out with the newer ones. */
#include <string.h>
#include <strings.h>

#include "compiler/plan/format_clauses.h"
#include "compiler/plan/syntax/words.h"

static const struct {
    const char *older, *newer;
} renamed[] = {{"section", "option"}, {"deck", "floor"}};

enum { RENAMED = sizeof renamed / sizeof *renamed, OPTION = 0, FLOOR };

typedef struct renewal {
    const char *source;
    const tn_tokens *tokens;
    bool own_option; /* a rule with parameters is called `option`: so calls of the older word stay */
    bool own_floor;  /* a layer, an opening or an item is called `floor`: so the part of materials stays `deck` */
    bool done[RENAMED];
    char *text; /* as long as it can become */
    size_t size, taken;
} renewal;

static bool is(const renewal *r, size_t i, tn_token_kind kind, const char *text)
{
    if (i >= r->tokens->count || r->tokens->items[i].kind != kind)
        return false;
    tn_span span = r->tokens->items[i].span;
    return strlen(text) == span.end - span.begin &&
           (kind == TN_TOKEN_WORD ? strncasecmp : strncmp)(r->source + span.begin, text, strlen(text)) == 0;
}

/* Does the name at token i belong to a part that materials may be for? */
static bool names_part(const renewal *r, size_t i)
{
    tn_token_kind next = i + 1 < r->tokens->count ? r->tokens->items[i + 1].kind : TN_TOKEN_SIGN;
    bool layer = is(r, i - 1, TN_TOKEN_SIGN, "{") || is(r, i - 1, TN_TOKEN_SIGN, ",");
    return is(r, i - 1, TN_TOKEN_WORD, "item") || is(r, i - 1, TN_TOKEN_WORD, "opening") ||
           is(r, i - 1, TN_TOKEN_WORD, "flight") || is(r, i - 1, TN_TOKEN_WORD, "beam") ||
           (layer && (next == TN_TOKEN_LENGTH || next == TN_TOKEN_NUMBER));
}

static void find_own(renewal *r)
{
    for (size_t i = 1; i < r->tokens->count; i++) {
        r->own_option |= is(r, i - 1, TN_TOKEN_WORD, "rule") && is(r, i, TN_TOKEN_NAME, renamed[OPTION].newer) &&
                         is(r, i + 1, TN_TOKEN_SIGN, "(");
        r->own_floor |= is(r, i, TN_TOKEN_NAME, renamed[FLOOR].newer) && names_part(r, i);
    }
}

/* Which of the words token i is, in its older spelling; RENAMED: none, or one that stays. `part`: materials are for
 * it. */
static size_t older_at(const renewal *r, size_t i, bool part)
{
    if (is(r, i, TN_TOKEN_WORD, renamed[OPTION].older))
        return r->own_option && is(r, i + 1, TN_TOKEN_SIGN, "(") ? RENAMED : OPTION;
    if (is(r, i, TN_TOKEN_WORD, renamed[FLOOR].older))
        return FLOOR;
    return part && !r->own_floor && is(r, i, TN_TOKEN_NAME, renamed[FLOOR].older) ? FLOOR : RENAMED;
}

static void put(renewal *r, const char *text, size_t size)
{
    memcpy(r->text + r->size, text, size);
    r->size += size;
}

/* Copies up to token i, and the newer word for it. */
static void renew(renewal *r, size_t i, size_t word)
{
    tn_span span = r->tokens->items[i].span;
    put(r, r->source + r->taken, span.begin - r->taken);
    put(r, renamed[word].newer, strlen(renamed[word].newer));
    r->taken = span.end;
    r->done[word] = true;
}

const char *tn_format_newer_words(tn_arena *arena, const tn_source *source, const tn_tokens *tokens, const char **said)
{
    static const char *const texts[2][2] = {
        {NULL, "`floor` is written for `deck`"},
        {"`option` is written for `section`", "`option` is written for `section`, and `floor` for `deck`"}};
    renewal r = {.source = source->text, .tokens = tokens};
    r.text = TN_NEW_ARRAY(arena, char, source->size + tokens->count + 1); /* a newer word has at most one letter more */
    if (!r.text)
        return NULL;
    find_own(&r);
    bool material = false, part = false;
    for (size_t i = 0; i < tokens->count; i++) {
        if (tokens->items[i].kind == TN_TOKEN_WORD) {
            part = material && is(&r, i, TN_TOKEN_WORD, "for");
            material = is(&r, i, TN_TOKEN_WORD, "material") || is(&r, i, TN_TOKEN_WORD, "classification") ||
                       (material && !part);
        }
        size_t word = older_at(&r, i, part);
        if (word < RENAMED)
            renew(&r, i, word);
    }
    put(&r, r.source + r.taken, source->size - r.taken);
    r.text[r.size] = '\0';
    *said = texts[r.done[OPTION]][r.done[FLOOR]];
    return *said ? r.text : NULL;
}
