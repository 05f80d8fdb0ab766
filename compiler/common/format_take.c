/* From the lexer's tokens to the formatter's. */
#include <string.h>

#include "compiler/common/format_tokens.h"

/* Line ends between two places. */
static size_t lines_between(const tn_source *source, size_t begin, size_t end)
{
    size_t lines = 0;
    for (size_t i = begin; i < end; i++)
        lines += source->text[i] == '\n' || (source->text[i] == '\r' && source->text[i + 1] != '\n');
    return lines;
}

static size_t without_blanks(const char *text, size_t size)
{
    while (size > 0 && strchr(" \t\f\v", text[size - 1]))
        size--;
    return size;
}

const char *tn_format_small_letters(tn_arena *arena, const char *text, size_t size)
{
    char *copy = tn_arena_copy(arena, text, size);
    for (size_t i = 0; copy && i < size; i++)
        if (copy[i] >= 'A' && copy[i] <= 'Z')
            copy[i] = (char)(copy[i] - 'A' + 'a');
    return copy;
}

static bool is_measure(tn_token_kind kind)
{
    return kind == TN_TOKEN_NUMBER || kind == TN_TOKEN_LENGTH;
}

/* `4'` and `6"` on two lines are two lengths, on one line they are one. */
static bool would_merge(const tn_format_token *before, tn_token_kind kind, size_t lines)
{
    return lines > 0 && is_measure(before->kind) && kind == TN_TOKEN_LENGTH;
}

typedef struct taker {
    tn_format *format;
    tn_arena *arena;
    const tn_source *source;
    tn_format_spell *spell;
    tn_format_comment *comments; /* room for the next */
    size_t end;                  /* of the token before */
} taker;

/* A comment on the line of the token before belongs to that one, another to the token to come. */
static void take_comment(taker *t, const tn_token *from, size_t lines)
{
    tn_format_token *token = &t->format->tokens[t->format->count];
    const char *text = t->source->text + from->span.begin;
    tn_format_comment comment = {text, without_blanks(text, from->span.end - from->span.begin), lines > 1};
    if (t->format->count > 0 && lines == 0 && !token->comment_count && !token[-1].remark.text) {
        token[-1].remark = comment;
        return;
    }
    *t->comments = comment;
    token->comments = token->comment_count++ ? token->comments : t->comments;
    t->comments++;
}

/* One blank or line end for several. */
static const char *join_blanks(tn_arena *arena, const char *text, size_t size)
{
    char *joined = TN_NEW_ARRAY(arena, char, size + 1);
    size_t used = 0;
    for (size_t i = 0; joined && i < size; i++) {
        bool blank = strchr(" \t\r\n\f\v", text[i]) != NULL, after = used > 0 && strchr(" \n", joined[used - 1]);
        if (!blank)
            joined[used++] = text[i];
        else if (!after)
            joined[used++] = text[i] == '\n' ? '\n' : ' ';
        else if (text[i] == '\n')
            joined[used - 1] = '\n';
    }
    return joined;
}

static void take_token(taker *t, const tn_token *from, size_t lines)
{
    tn_format *format = t->format;
    tn_format_token *token = &format->tokens[format->count];
    token->kind = from->kind;
    token->text = t->source->text + from->span.begin;
    token->size = from->span.end - from->span.begin;
    if (token->kind == TN_TOKEN_WORD || token->kind == TN_TOKEN_HOUSE) {
        token->text = (token->kind == TN_TOKEN_WORD ? t->spell : join_blanks)(t->arena, token->text, token->size);
        token->size = token->text ? strlen(token->text) : 0;
    }
    token->offset = from->span.begin;
    token->width = tn_text_width(token->text, token->size);
    token->blank = lines > 1;
    if (token->kind == TN_TOKEN_SIGN && *token->text == ',' && format->count > 0 &&
        !token->comment_count) { /* `a # why , b`: after the comma */
        token->remark = token[-1].remark;
        token[-1].remark.text = NULL;
    }
    token->breaks = format->count > 0 && would_merge(&token[-1], token->kind, lines);
    format->count++;
}

void tn_format_take(tn_format *format, tn_arena *arena, const tn_source *source, const tn_tokens *tokens,
                    tn_format_spell *spell)
{
    format->tokens = TN_NEW_ARRAY(arena, tn_format_token, tokens->count + 1);
    taker t = {.format = format, .arena = arena, .source = source, .spell = spell};
    t.comments = TN_NEW_ARRAY(arena, tn_format_comment, tokens->count + 1);
    if (!format->tokens || !t.comments)
        return;
    for (size_t i = 0; i < tokens->count; i++) {
        const tn_token *token = &tokens->items[i];
        if (token->kind == TN_TOKEN_LINE) {
            size_t ends = lines_between(source, token->span.begin, token->span.end);
            format->tokens[format->count].line_ends += ends ? ends : 1;
            continue;
        }
        size_t lines = lines_between(source, t.end, token->span.begin);
        t.end = token->span.end;
        if (token->kind == TN_TOKEN_COMMENT)
            take_comment(&t, token, lines);
        else
            take_token(&t, token, lines);
    }
    format->tokens[format->count].text = "";
    format->tokens[format->count].kind = TN_TOKEN_SIGN;
}

bool tn_format_match_brackets(tn_format *format, size_t *place)
{
    static const char *const opening[] = {"(", "[", "{", NULL}, *const closing[] = {")", "]", "}", NULL};
    size_t stack[TN_FORMAT_BRACKETS_MAX], depth = 0;
    for (size_t i = 0; i < format->count; i++) {
        if (tn_format_is_any(format, i, opening)) {
            *place = i;
            if (depth == TN_FORMAT_BRACKETS_MAX)
                return false;
            stack[depth++] = i;
        } else if (depth > 0 && tn_format_is_any(format, i, closing)) {
            format->tokens[i].match = stack[--depth];
            format->tokens[stack[depth]].match = i;
        }
    }
    return true;
}
