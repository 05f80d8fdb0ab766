/* Makes the syntax tree of grammars (.bnf). */
#include "compiler/bnf/ast.h"

#include <stdlib.h>
#include <string.h>

tn_bnf_item *tn_bnf_item_new(tn_bnf_reader *reader, tn_bnf_kind kind, tn_span span, tn_bnf_text text)
{
    tn_bnf_item *item = TN_NEW(reader->arena, tn_bnf_item);
    if (!item)
        return NULL;
    if (kind == TN_BNF_QUOTED)
        text = (tn_bnf_text){text.text + 1, text.length - 2};
    if (kind == TN_BNF_EDGE_SAME)
        item->letter = (uint32_t)(text.text[4] - 'X');
    item->kind = kind;
    item->span = span;
    item->text = text;
    return item;
}

const char tn_bnf_token_help[] =
    "in the genr8 dialect all tokens are separated by blanks; quote what is to be text: 'x'";

tn_bnf_item *tn_bnf_lone_quote(tn_bnf_reader *reader, tn_span span, tn_bnf_text text)
{
    char quote = text.text[0], other = quote == '"' ? '\'' : '"';
    tn_diagnostic *diagnostic =
        tn_report(reader->diagnostics, E_UNTERMINATED_STRING, span, "this quote has no partner on its line");
    tn_help(reader->diagnostics, diagnostic,
            "to write the sign itself, put it between quotes of the other kind: %c%c%c", other, quote, other);
    return tn_bnf_item_new(reader, TN_BNF_PLAIN, span, text);
}

void tn_bnf_open_quote(tn_bnf_reader *reader, tn_span span)
{
    tn_diagnostic *diagnostic =
        tn_report(reader->diagnostics, E_GRAMMAR_TOKEN, span, "a quote is not closed before the next blank");
    tn_help(reader->diagnostics, diagnostic, "%s", tn_bnf_token_help);
}

tn_bnf_item *tn_bnf_group_new(tn_bnf_reader *reader, tn_bnf_kind kind, tn_span span, tn_bnf_items body)
{
    tn_bnf_item *item = tn_bnf_item_new(reader, kind, span, (tn_bnf_text){0});
    if (!item)
        return NULL;
    item->body = body;
    for (const tn_bnf_item *inner = body.first; inner; inner = inner->next)
        if (inner->groups > item->groups)
            item->groups = inner->groups;
    if (++item->groups == TN_GROUP_DEPTH + 1) { /* once for each nest, not again for what is around it */
        reader->failed = true;
        tn_diagnostic *diagnostic = tn_report(reader->diagnostics, E_GRAMMAR_GROUP, span,
                                              "groups nest more than %u deep, which is the limit", TN_GROUP_DEPTH);
        tn_help(reader->diagnostics, diagnostic, "give the inner groups a rule of their own");
    }
    return item;
}

tn_bnf_items tn_bnf_append(tn_bnf_items items, tn_bnf_item *item)
{
    TN_CHAIN(&items, item);
    return items;
}

tn_bnf_alternative *tn_bnf_alternative_new(tn_bnf_reader *reader, tn_span span, tn_bnf_items items)
{
    tn_bnf_alternative *alternative = TN_NEW(reader->arena, tn_bnf_alternative);
    if (!alternative)
        return NULL;
    alternative->span = span;
    alternative->items = items;
    return alternative;
}

tn_bnf_alternatives tn_bnf_first(tn_bnf_alternative *alternative)
{
    return (tn_bnf_alternatives){alternative, alternative, alternative ? 1 : 0};
}

tn_bnf_alternatives tn_bnf_next(tn_bnf_alternatives list, tn_bnf_alternative *alternative, bool after_comment)
{
    if (!list.last)
        return tn_bnf_first(alternative);
    if (!alternative)
        return list;
    list.last->beside_comment |= after_comment;
    alternative->beside_comment = after_comment;
    TN_CHAIN(&list, alternative);
    list.count++;
    return list;
}

/* ---- tokens */

void tn_bnf_note_head(tn_bnf_reader *reader, tn_span span, const char *text)
{
    uint32_t name = span.begin + (uint32_t)(strchr(text, '>') - text) + 1;
    tn_token_add(reader->tokens, TN_TOKEN_NAME, (tn_span){span.file, span.begin, name});
    tn_token_add(reader->tokens, TN_TOKEN_SIGN, (tn_span){span.file, span.end - 3, span.end});
}

/* What is passed over is one token a line, with the blanks in it. */
void tn_bnf_note_stray(tn_bnf_reader *reader, tn_span span, const char *text)
{
    tn_tokens *tokens = reader->tokens;
    tn_token *last = tokens && tokens->count ? &tokens->items[tokens->count - 1] : NULL;
    bool goes_on = last && last->kind == TN_TOKEN_STRAY;
    for (uint32_t at = goes_on ? last->span.end : span.begin; at < span.begin; at++)
        goes_on &= text[(ptrdiff_t)at - span.begin] != '\n' && text[(ptrdiff_t)at - span.begin] != '\r';
    if (goes_on)
        last->span.end = span.end;
    else
        tn_token_add(tokens, TN_TOKEN_STRAY, span);
}

/* A directive is a line, which a comment may end. */
void tn_bnf_note_directive(tn_bnf_reader *reader, tn_span span, const char *text)
{
    uint32_t comment = span.begin + (uint32_t)strcspn(text, "#"), end = comment;
    while (strchr(" \t", text[end - 1 - span.begin]))
        end--;
    tn_token_add(reader->tokens, TN_TOKEN_WORD, (tn_span){span.file, span.begin, end});
    tn_token_add(reader->tokens, TN_TOKEN_COMMENT, (tn_span){span.file, comment, span.end});
}

/* ---- rules */

static tn_bnf_rule *rule_new(tn_bnf_reader *reader, tn_span head_span, tn_bnf_text head)
{
    tn_bnf_rule *rule = TN_NEW(reader->arena, tn_bnf_rule);
    if (!rule)
        return NULL;
    size_t length = (size_t)((const char *)memchr(head.text, '>', head.length) - head.text) + 1;
    rule->name = (tn_bnf_text){head.text, length};
    rule->name_span = (tn_span){head_span.file, head_span.begin, head_span.begin + (uint32_t)length};
    rule->span = head_span;
    tn_bnf_file *file = &reader->ast;
    TN_CHAIN(file, rule);
    file->rule_count++;
    return rule;
}

void tn_bnf_rule_new(tn_bnf_reader *reader, tn_span head_span, tn_bnf_text head, tn_span span, tn_bnf_alternatives list)
{
    tn_bnf_rule *rule = rule_new(reader, head_span, head);
    if (!rule)
        return;
    rule->alternatives = list;
    rule->span = tn_span_join(head_span, span);
}

void tn_bnf_rule_broken(tn_bnf_reader *reader, tn_span head_span, tn_bnf_text head)
{
    tn_bnf_rule *rule = rule_new(reader, head_span, head);
    if (rule)
        rule->broken = true;
}

void tn_bnf_stray(tn_bnf_reader *reader, tn_span span)
{
    if (reader->prelude_reported)
        return;
    reader->prelude_reported = true;
    tn_diagnostic *diagnostic =
        tn_report(reader->diagnostics, W_GRAMMAR_PRELUDE, span, "text before the first rule is not read");
    tn_help(reader->diagnostics, diagnostic, "a rule is written `<name> ::= one | other`; a comment starts with #");
}

/* Rules are free text, so that only groups can break the syntax. */
void tn_bnf_unexpected(tn_bnf_reader *reader, tn_span span, const char *token)
{
    tn_diagnostics *list = reader->diagnostics;
    if (strcmp(token, "}") == 0 || strcmp(token, "]") == 0) {
        tn_diagnostic *diagnostic = tn_report(list, E_GRAMMAR_GROUP, span, "this `%s` closes nothing", token);
        tn_help(list, diagnostic, "as a sign of the sentence it is written '%s'", token);
    } else if (strcmp(token, "|") == 0) {
        tn_diagnostic *diagnostic = tn_report(list, E_GRAMMAR_GROUP, span, "a group cannot hold alternatives");
        tn_help(list, diagnostic, "give them a rule of their own: { <name> } and <name> ::= one | other");
    } else if (strcmp(token, "a rule's name and ::=") == 0 || strcmp(token, "the end of the file") == 0) {
        tn_report(list, E_GRAMMAR_GROUP, span, "a { or [ of the rule before is not closed");
    } else {
        tn_report(list, E_GRAMMAR_SYNTAX, span, "%s does not belong here", token);
    }
}

void tn_bnf_memory_exhausted(tn_bnf_reader *reader, tn_span span, const char *message)
{
    (void)message;
    reader->failed = true;
    tn_report(reader->diagnostics, E_GRAMMAR_TOO_LARGE, span, "groups nest too deep to be read (limit %u)",
              TN_GROUP_DEPTH);
}

/* ---- directives */

typedef struct words {
    tn_bnf_text items[3];
    size_t count;
} words;

static words split(const char *line, size_t length)
{
    words found = {0};
    size_t at = 0;
    while (at < length && found.count < 3) {
        while (at < length && (line[at] == ' ' || line[at] == '\t'))
            at++;
        size_t begin = at;
        while (at < length && line[at] != ' ' && line[at] != '\t' && line[at] != '#')
            at++;
        if (at > begin)
            found.items[found.count++] = (tn_bnf_text){line + begin, at - begin};
        if (at < length && line[at] == '#')
            break;
    }
    return found;
}

static bool is(tn_bnf_text text, const char *word)
{
    return text.length == strlen(word) && memcmp(text.text, word, text.length) == 0;
}

bool tn_bnf_says_genr8(const char *line, size_t length)
{
    words said = split(line, length);
    return said.count == 2 && is(said.items[0], "%dialect") && is(said.items[1], "genr8");
}

static bool number(tn_bnf_text text, uint32_t *value)
{
    uint64_t total = 0;
    for (size_t i = 0; i < text.length; i++) {
        if (text.text[i] < '0' || text.text[i] > '9')
            return false;
        total = total * 10 + (uint64_t)(text.text[i] - '0');
        if (total > UINT32_MAX)
            return false;
    }
    *value = (uint32_t)total;
    return text.length > 0;
}

/* Index of the word among `choices`, or -1. */
static int choice(tn_bnf_text text, const char *const *choices, int count)
{
    for (int i = 0; i < count; i++)
        if (is(text, choices[i]))
            return i;
    return -1;
}

static void bad_value(tn_bnf_reader *reader, tn_span span, const char *directive, const char *expected)
{
    tn_diagnostic *diagnostic =
        tn_report(reader->diagnostics, E_GRAMMAR_DIRECTIVE, span, "%s cannot have this value", directive);
    tn_help(reader->diagnostics, diagnostic, "write %s %s", directive, expected);
}

enum { DIRECTIVES = 9, DATA_FIRST = 5, MAPPING = 8 };
static const char *const directives[DIRECTIVES] = {"%dialect",        "%single-choice",   "%repair",
                                                   "%max-depth",      "%wraps",           "%dataset-vars",
                                                   "%dataset-inputs", "%dataset-outputs", "%mapping"};
const char *const tn_bnf_data_directives[TN_BNF_DATA] = {"%dataset-vars", "%dataset-inputs", "%dataset-outputs"};

static void note_data(tn_bnf_reader *reader, tn_span span, int which, tn_bnf_text value)
{
    uint32_t said;
    if (!number(value, &said) || said == 0)
        bad_value(reader, span, directives[which], "a whole number above 0");
    else
        reader->ast.data[which - DATA_FIRST] = said;
}

static void note_mapping(tn_bnf_reader *reader, tn_span span, tn_bnf_text value)
{
    int chosen = choice(value, (const char *const[]){"leftmost", "position-independent"}, 2);
    if (chosen < 0)
        bad_value(reader, span, directives[MAPPING], "leftmost or position-independent");
    reader->ast.position_independent = chosen == 1;
    reader->ast.mapping_span = span;
}

bool tn_bnf_names_directive(tn_bnf_text line)
{
    words said = split(line.text, line.length);
    return said.count > 0 && choice(said.items[0], directives, DIRECTIVES) >= 0;
}

void tn_bnf_directive(tn_bnf_reader *reader, tn_span span, tn_bnf_text line)
{
    static const char *const dialects[] = {"ge", "genr8"}, *const singles[] = {"consume", "skip"},
                             *const repairs[] = {"genome", "identity", "off"};
    tn_bnf_file *ast = &reader->ast;
    words said = split(line.text, line.length);
    tn_bnf_text value = said.count == 2 ? said.items[1] : (tn_bnf_text){"", 0};
    int chosen;
    switch (choice(said.items[0], directives, DIRECTIVES)) {
    case 0:
        chosen = choice(value, dialects, 2);
        if (chosen < 0)
            bad_value(reader, span, directives[0], "ge or genr8");
        else if (ast->says_dialect)
            tn_report(reader->diagnostics, E_GRAMMAR_DIRECTIVE, span, "the dialect is said twice");
        else
            ast->dialect = (tn_dialect)chosen;
        ast->says_dialect = true;
        break;
    case 1:
        chosen = choice(value, singles, 2);
        if (chosen < 0)
            bad_value(reader, span, directives[1], "consume or skip");
        ast->skip_single = chosen == 1;
        if (ast->skip_single && reader->genr8)
            tn_report(reader->diagnostics, E_GRAMMAR_DIRECTIVE, span,
                      "in the genr8 dialect every non-terminal reads a gene");
        break;
    case 2:
        chosen = choice(value, repairs, 3);
        if (chosen < 0)
            bad_value(reader, span, directives[2], "genome, identity or off");
        else
            ast->repair = (tn_repair)chosen;
        ast->says_repair = true;
        ast->repair_span = span;
        break;
    case 3:
        if (!number(value, &ast->max_depth))
            bad_value(reader, span, directives[3], "a whole number, 0 for no limit");
        ast->says_max_depth = true;
        break;
    case 4:
        if (!number(value, &ast->wraps))
            bad_value(reader, span, directives[4], "a whole number");
        ast->says_wraps = true;
        break;
    case DATA_FIRST:
    case DATA_FIRST + 1:
    case DATA_FIRST + 2:
        note_data(reader, span, choice(said.items[0], directives, DIRECTIVES), value);
        break;
    case MAPPING:
        note_mapping(reader, span, value);
        break;
    default: {
        tn_diagnostic *diagnostic =
            tn_report(reader->diagnostics, E_GRAMMAR_DIRECTIVE, span, "there is no such directive");
        char *word = tn_arena_copy(reader->arena, said.items[0].text, said.count ? said.items[0].length : 0);
        const char *near = word ? tn_nearest(word, directives, DIRECTIVES) : NULL;
        if (near)
            tn_help(reader->diagnostics, diagnostic, "did you mean %s?", near);
        else
            tn_help(reader->diagnostics, diagnostic,
                    "there are %%dialect, %%mapping, %%single-choice, %%repair, %%max-depth, %%wraps, %%dataset-vars, "
                    "%%dataset-inputs and %%dataset-outputs");
        break;
    }
    }
}
