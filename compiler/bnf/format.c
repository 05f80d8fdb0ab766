/* Laying out .bnf files. A rule stands on one line where it fits. Otherwise its alternatives stand one below the other,
 * after bars that are lined up, or fill the lines where each is a single item.
 *
 * In the dialect ge, what is inside an alternative is part of the sentence: white space too, and line ends. Only what
 * is around alternatives is laid out, and the blanks after a line end, which do not count.
 */
#include <string.h>

#include "compiler/bnf/ast.h"
#include "compiler/common/layout.h"

/* ==== which dialect a grammar is probably in that does not say so */

/* Words between white space, outside of comments and quotes: where one of them is a brace or bracket alone, the file
 * may be in the dialect genr8, and where `Edge` is another, it is. */
typedef struct survey {
    const char *text;
    size_t size, at;
    uint32_t begin, end; /* of the first brace */
    bool braces, edges, directive;
} survey;

static bool is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v';
}

static void skip_line(survey *s)
{
    while (s->at < s->size && s->text[s->at] != '\n')
        s->at++;
}

/* Where the quoted text that begins here ends; behind the quote alone, where it has no other on its line. */
static size_t quoted_end(const survey *s, bool escapes)
{
    size_t end = s->at + 1;
    while (end < s->size && s->text[end] != '\n' && s->text[end] != s->text[s->at])
        end += escapes && s->text[end] == '\\' && end + 1 < s->size && s->text[end + 1] != '\n' ? 2 : 1;
    return end < s->size && s->text[end] == s->text[s->at] ? end + 1 : s->at + 1;
}

/* As the lexer: with `\"` for a quote where that makes it longer. */
static void skip_quoted(survey *s)
{
    size_t plain = quoted_end(s, false), escaped = quoted_end(s, true);
    s->at = escaped > plain ? escaped : plain;
}

static void judge_word(survey *s, size_t begin)
{
    const char *word = s->text + begin;
    size_t size = s->at - begin;
    bool brace = size == 1 && strchr("{}[]", *word);
    if (brace && !s->braces) {
        s->begin = (uint32_t)begin;
        s->end = (uint32_t)s->at;
    }
    s->braces |= brace;
    s->edges |= (size == 4 || (size == 5 && word[4] >= 'X' && word[4] <= 'Z')) && memcmp(word, "Edge", 4) == 0;
    s->directive |= size == 8 && memcmp(word, "%dialect", 8) == 0;
}

static void look_through(survey *s)
{
    while (s->at < s->size) {
        size_t begin = s->at;
        while (s->at < s->size && !is_space(s->text[s->at]) && !strchr("#'\"", s->text[s->at]))
            s->at++;
        bool touches = s->at < s->size && (s->text[s->at] == '\'' || s->text[s->at] == '"');
        if (s->at > begin && !touches)
            judge_word(s, begin);
        if (s->at == s->size)
            return;
        if (s->text[s->at] == '#')
            skip_line(s);
        else if (touches)
            skip_quoted(s);
        else
            s->at++;
    }
}

void tn_bnf_guess_dialect(tn_bnf_reader *reader, const char *text, size_t size)
{
    survey s = {.text = text, .size = size};
    look_through(&s);
    if (s.directive || !s.braces)
        return;
    reader->genr8 = s.edges;
    reader->ast.dialect = s.edges ? TN_DIALECT_GENR8 : TN_DIALECT_GE;
    tn_diagnostic *diagnostic =
        tn_report(reader->diagnostics, W_GRAMMAR_DIALECT, (tn_span){reader->file, s.begin, s.end},
                  "the file does not say its dialect, and is read as %s",
                  s.edges ? "genr8, in which braces and brackets are groups: it writes Edge"
                          : "ge, in which braces and brackets are text");
    tn_help(reader->diagnostics, diagnostic,
            s.edges ? "begin the file with `%%dialect genr8`, or with `%%dialect ge` if they are text"
                    : "begin the file with `%%dialect ge`, or with `%%dialect genr8` if they repeat and make optional");
}

/* ---- compares two grammars, so that a file that was laid out anew is known to say the same */

static bool same_text(tn_bnf_text one, tn_bnf_text other)
{
    return one.length == other.length && (one.length == 0 || memcmp(one.text, other.text, one.length) == 0);
}

/* As deep as groups nest. */
static bool same_items(tn_bnf_items one, tn_bnf_items other)
{
    const tn_bnf_item *a = one.first, *b = other.first;
    for (; a && b; a = a->next, b = b->next)
        if (a->kind != b->kind || a->letter != b->letter || !same_text(a->text, b->text) ||
            !same_items(a->body, b->body))
            return false;
    return !a && !b;
}

static bool same_rule(const tn_bnf_rule *one, const tn_bnf_rule *other)
{
    const tn_bnf_alternative *a = one->alternatives.first, *b = other->alternatives.first;
    if (!same_text(one->name, other->name) || one->broken != other->broken)
        return false;
    for (; a && b; a = a->next, b = b->next)
        if (!same_items(a->items, b->items))
            return false;
    return !a && !b;
}

static bool same_settings(const tn_bnf_file *one, const tn_bnf_file *other)
{
    return one->dialect == other->dialect && one->says_dialect == other->says_dialect && one->repair == other->repair &&
           one->says_repair == other->says_repair && one->skip_single == other->skip_single &&
           one->says_max_depth == other->says_max_depth && one->max_depth == other->max_depth &&
           one->says_wraps == other->says_wraps && one->wraps == other->wraps;
}

/* What is wrong with terminals is no business of the formatter's. */
static bool make_terminals(tn_bnf_reader *reader)
{
    tn_diagnostics scratch;
    tn_bnf_grammar grammar = {.reader = reader};
    tn_diagnostics_init(&scratch, reader->diagnostics->sources);
    reader->diagnostics = &scratch;
    bool made = tn_bnf_collect_rules(&grammar);
    if (made)
        tn_bnf_make_terminals(&grammar);
    tn_diagnostics_clear(&scratch);
    return made && !tn_arena_failed(reader->arena);
}

bool tn_format_bnf_same(tn_bnf_reader *one, tn_bnf_reader *other)
{
    if (!make_terminals(one) || !make_terminals(other) || !same_settings(&one->ast, &other->ast))
        return false;
    const tn_bnf_rule *a = one->ast.first, *b = other->ast.first;
    for (; a && b; a = a->next, b = b->next)
        if (!same_rule(a, b))
            return false;
    return !a && !b;
}

enum {
    BAR_GAP = 2,      /* columns from a bar to the alternative after it */
    GROUP_INDENT = 2, /* of what goes on in a group in the next line */
};

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\f' || c == '\v';
}

/* ---- ge: without the white space around alternatives */

/* Cuts the blanks at one end of a text; false if nothing is left. */
static bool cut(const tn_source *source, tn_token *token, bool at_begin)
{
    tn_span *span = &token->span;
    while (span->begin < span->end && is_blank(source->text[at_begin ? span->begin : span->end - 1])) {
        if (at_begin)
            span->begin++;
        else
            span->end--;
    }
    return span->begin < span->end;
}

/* Texts next to an end of an alternative lose their blanks there, seen from the front or from the back. */
static void trim(const tn_source *source, tn_tokens *tokens, bool from_front)
{
    bool at_end = true;
    for (size_t k = 0; k < tokens->count; k++) {
        tn_token *token = &tokens->items[from_front ? k : tokens->count - 1 - k];
        if (token->kind == TN_TOKEN_SIGN || token->kind == TN_TOKEN_COMMENT || token->kind == TN_TOKEN_NAME)
            at_end = true;
        else if (token->kind != TN_TOKEN_LINE && at_end)
            at_end = token->kind == TN_TOKEN_TEXT && !cut(source, token, from_front);
    }
}

void tn_format_bnf_trim(const tn_source *source, tn_tokens *tokens)
{
    size_t count = 0;
    trim(source, tokens, true);
    trim(source, tokens, false);
    for (size_t i = 0; i < tokens->count; i++)
        if (tokens->items[i].span.begin < tokens->items[i].span.end)
            tokens->items[count++] = tokens->items[i];
    tokens->count = count;
}

const char *tn_format_bnf_directive(tn_arena *arena, const char *text, size_t size)
{
    char *copy = tn_arena_copy(arena, text, size);
    size_t used = 0;
    for (size_t i = 0; copy && i < size; i++)
        if (!is_blank(text[i]) || (used > 0 && copy[used - 1] != ' '))
            copy[used++] = is_blank(text[i]) ? ' ' : text[i];
    while (copy && used > 0 && copy[used - 1] == ' ')
        used--;
    if (copy)
        copy[used] = '\0';
    return copy;
}

/* ---- rules */

static size_t gap_in_text(const tn_format *format, size_t i)
{
    return format->tokens[i].kind == TN_TOKEN_SIGN || format->tokens[i - 1].kind == TN_TOKEN_SIGN ? 1 : 0;
}

static size_t gap_of_tokens(const tn_format *format, size_t i)
{
    (void)format;
    (void)i;
    return 1;
}

static bool is_bar(const tn_format *format, size_t i)
{
    return tn_format_is(format, i, "|");
}

static bool opens(const tn_format *format, size_t i)
{
    return tn_format_is(format, i, "{") || tn_format_is(format, i, "[");
}

static bool starts_rule(const tn_format *format, size_t i)
{
    return i + 1 < format->count && format->tokens[i].kind == TN_TOKEN_NAME && tn_format_is(format, i + 1, "::=");
}

/* In ge, a comment ends an alternative. */
static bool is_after_comment(const tn_format *format, size_t i)
{
    return format->tokens[i].comment_count || format->tokens[i - 1].remark.text;
}

/* The end of the alternative that starts at `first`: at a bar, or after a comment. */
static size_t alternative_end(const tn_format *format, size_t first, size_t last)
{
    bool sentence = format->gap_before == gap_in_text;
    size_t i = first;
    while (i < last && !is_bar(format, i) && !(sentence && i > first && is_after_comment(format, i)))
        i++;
    return i;
}

/* Comments after a bar go before it, since bars start lines. False if there is none to move. */
static bool settle_comments(tn_format *format, size_t bar, size_t last)
{
    tn_format_token *token = &format->tokens[bar];
    bool remark = token->remark.text && !token->comment_count && !token[-1].remark.text;
    if (remark) {
        token[-1].remark = token->remark;
        token->remark.text = NULL;
    }
    bool comments = bar + 1 < last && token[1].comment_count && !token->comment_count && !token->remark.text;
    if (comments) {
        token->comments = token[1].comments;
        token->comment_count = token[1].comment_count;
        token[1].comment_count = 0;
    }
    return remark || comments;
}

/* Bars may follow each other: a comment goes before as many as it can. */
static void settle_all_comments(tn_format *format, size_t first, size_t last)
{
    for (size_t i = first; i < last; i++)
        for (size_t bar = i; bar >= first && is_bar(format, bar) && settle_comments(format, bar, last);)
            bar--;
}

/* Where the tokens before and after have to stay on lines of their own: line ends of the sentence; and `<a>` before
 * `::=`, which on one line would start a rule. */
static void find_breaks(tn_format *format, size_t first, size_t last)
{
    bool sentence = format->gap_before == gap_in_text;
    for (size_t begin = first, end; begin < last; begin = end + (end < last && is_bar(format, end))) {
        end = alternative_end(format, begin, last);
        for (size_t i = begin + 1; i < end; i++) {
            tn_format_token *token = &format->tokens[i];
            bool head = token->size >= 3 && memcmp(token->text, "::=", 3) == 0 && token[-1].text[0] == '<';
            token->breaks = sentence ? token->line_ends : head;
        }
    }
}

static size_t unit_end(const tn_format *format, size_t i)
{
    return opens(format, i) ? format->tokens[i].match + 1 : i + 1;
}

/* Puts tokens in as few lines as they take; a group stays together where it fits on a line. As deep as groups nest. */
static void put_tokens(tn_format *format, size_t first, size_t last, size_t indent)
{
    tn_layout *layout = &format->layout;
    for (size_t i = first, end; i < last; i = end) {
        end = unit_end(format, i);
        size_t width = tn_format_width(format, i, end), gap = i > first || !layout->fresh;
        if (i > first && layout->column + gap + width > TN_FORMAT_WIDTH)
            tn_layout_line(layout, indent);
        if (end == i + 1 || layout->column + gap + width <= TN_FORMAT_WIDTH) {
            tn_layout_spaces(layout, !layout->fresh && i > first);
            tn_format_flat(format, i, end);
            continue;
        }
        tn_format_put(format, i, i > first);
        tn_layout_spaces(layout, 1);
        put_tokens(format, i + 1, end - 1, indent + GROUP_INDENT);
        tn_format_put(format, end - 1, 1);
    }
}

static void put_alternative(tn_format *format, size_t first, size_t last, size_t column)
{
    format->layout.indent = column; /* of the lines to come */
    if (format->gap_before == gap_in_text)
        tn_format_flat(format, first, last);
    else
        put_tokens(format, first, last, column);
}

/* Is each alternative one item, and nothing said about any? */
static bool is_list(const tn_format *format, size_t first, size_t last)
{
    for (size_t i = first; i < last; i++)
        if ((i > first && is_after_comment(format, i)) || format->tokens[i].comment_count ||
            (i > first && !is_bar(format, i) && !is_bar(format, i - 1)))
            return false;
    return !format->tokens[first - 1].remark.text;
}

/* A bar, and the alternative after it. */
static size_t put_barred(tn_format *format, size_t bar, size_t last, size_t column)
{
    size_t end = alternative_end(format, bar + 1, last);
    tn_format_put(format, bar, 0);
    if (end > bar + 1) {
        tn_layout_spaces(&format->layout, 1);
        put_alternative(format, bar + 1, end, column);
    }
    return end;
}

static void put_alternatives(tn_format *format, size_t first, size_t last, size_t column)
{
    tn_layout *layout = &format->layout;
    bool list = is_list(format, first, last);
    for (size_t i = first, end; i < last; i = end) {
        if (!is_bar(format, i)) {
            if (i > first || layout->remarked)
                tn_layout_line(layout, column);
            else
                tn_layout_spaces(layout, 1);
            end = alternative_end(format, i, last);
            put_alternative(format, i, end, column);
            continue;
        }
        end = alternative_end(format, i + 1, last);
        if (list && layout->column + 1 + tn_format_width(format, i, end) <= TN_FORMAT_WIDTH)
            tn_layout_spaces(layout, 1);
        else
            tn_layout_line(layout, column - BAR_GAP);
        put_barred(format, i, last, column);
    }
}

static void put_rule(tn_format *format, size_t first, size_t last)
{
    size_t column = format->tokens[first].width + sizeof "::= ", body = first + 2;
    settle_all_comments(format, body, last);
    find_breaks(format, body, last);
    if (tn_format_width(format, first, last) <= TN_FORMAT_WIDTH) {
        tn_format_flat(format, first, last);
        return;
    }
    tn_format_flat(format, first, body);
    if (body < last)
        put_alternatives(format, body, last, column);
}

void tn_format_bnf(tn_format *format)
{
    bool prelude = false; /* what is before is no rule */
    const tn_bnf_reader *reader = format->tree;
    format->gap_before = reader->genr8 ? gap_of_tokens : gap_in_text; /* as it was read */
    for (size_t first = 0, last; first < format->count; first = last) {
        bool rule = starts_rule(format, first);
        for (last = first + 1; rule && last < format->count && !starts_rule(format, last);)
            last++;
        tn_format_gap(format, first, 0, rule && prelude);
        if (rule)
            put_rule(format, first, last);
        else
            tn_format_put(format, first, 0);
        prelude = !rule;
    }
    tn_format_gap(format, format->count, 0, false);
}
