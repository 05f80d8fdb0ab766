/* Which dialect a grammar is probably in that does not say so. */
#include <string.h>

#include "compiler/bnf/ast.h"

/* Words between white space, outside of comments and quotes: where one of them is a brace or bracket alone, the file
 * may be in the dialect genr8, and where `Edge` is another, it is. */
typedef struct survey {
    const char *text;
    size_t size, at;
    uint32_t begin, end; /* of the first brace */
    bool braces, edges, directive;
} survey;

static bool is_blank(char c)
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
        while (s->at < s->size && !is_blank(s->text[s->at]) && !strchr("#'\"", s->text[s->at]))
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
