/* Words the syntax errors of .plan files. */
#include "compiler/plan/syntax/syntax_error.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "compiler/plan/syntax/slip.h"
#include "runtime/base/nearest.h"

typedef struct tn_expected {
    const char *const *tokens;
    size_t count;
    bool said[96]; /* covered by a phrase */
} tn_expected;

static bool expects(const tn_expected *e, const char *token)
{
    for (size_t i = 0; i < e->count; i++)
        if (strcmp(e->tokens[i], token) == 0)
            return true;
    return false;
}

enum { GROUP_MAX = 32 };

/* Groups of tokens that one phrase names: a group is used where its first two tokens are both expected, and then covers
 * all of its tokens. */
static const struct {
    const char *phrase;
    const char *tokens[GROUP_MAX];
} groups[] = {
    {"a rule expression",
     {"`tray`",  "`neighbour`",      "`any`",      "a name",     "`not`",       "`symmetric`", "`quantity`", "`sum`",
      "`many`",  "`occurrences`",    "`optional`", "`distance`", "`beginning`", "`end`",       "`(`",        "`trays`",
      "an area", "a decimal number", "`matches`",  "`some`",     "`every`",     "`plan`",      "a number",   "a length",
      "`-`",     "`cell`",           "`room`",     "`section`",  "`touch`",     "`apart`"}},
    {"an operator such as `and`, `or` or `>`",
     {"`and`", "`+`", "`or`", "`implies`", "`in`", "`*`", "`/`", "`-`", "`<`", "`<=`", "`=`", "`!=`", "`>=`", "`>`"}},
    {"`+`, `-`, `*` or `/`", {"`+`", "`*`", "`/`", "`-`"}},
    {"a condition such as `n > 1`",
     {"`-`", "`(`", "`not`", "a number", "a name", "a length", "an area", "a decimal number"}},
    {"a variable or a number", {"`-`", "a name", "a number", "a length", "an area", "a decimal number"}},
    {"a number", {"`-`", "a number", "a length", "an area", "a decimal number"}},
    {"`flag` or a value", {"`flag`", "`...`", "a length", "a name", "a number"}},
    {"a value",
     {"a length", "a name", "a number", "an area", "a decimal number", "`in`", "`(`", "`not`", "`<`", "`<=`", "`=`",
      "`!=`", "`>=`", "`>`"}},
    {"a comparison such as `>`", {"`<`", "`<=`", "`=`", "`!=`", "`>=`", "`>`"}},
    {"the next `rule`, `schema`, `library`, `form`, `test` or `use`",
     {"`rule`", "`schema`", "`library`", "`form`", "`test`", "`use`", "`measure`", "`let`", "an expression",
      "an open plan", "the end of the file"}},
    {"a line of a form (`storey`, `section`, `function`, `face`, `tile` ...)",
     {"`storey`", "`spine`", "`wall`", "`partition`", "`deck`", "`roof`", "`section`", "`forbid`", "`void`", "`no`",
      "`function`", "`opening`", "`face`", "`tile`"}},
    {"a length or 0", {"a length", "a number"}},
    {"`trays`, `total`, `require`, `prune` or `allow`", {"`trays`", "`prune`", "`total`", "`require`", "`allow`"}},
    {"`match`, `reject`, `keep`, `drop` or `todo`", {"`todo`", "`match`", "`keep`", "`reject`", "`drop`", "`value`"}},
    {"`match`, `reject`, `keep` or `drop`", {"`match`", "`keep`", "`reject`", "`drop`"}},
    {"a field (`name = values`)", {"a field", "`forbid`", "`zone`", "`number`"}},
};

static void add_phrase(char *text, size_t size, const char *phrase, size_t *said)
{
    size_t length = strlen(text);
    snprintf(text + length, size - length, "%s%s", *said ? "; " : "", phrase);
    (*said)++;
}

static size_t say_groups(tn_expected *e, char *text, size_t size)
{
    size_t said = 0;
    for (size_t g = 0; g < sizeof groups / sizeof *groups; g++) {
        const char *const *tokens = groups[g].tokens;
        bool open = false;
        for (size_t i = 0; i < e->count; i++)
            open |= !e->said[i] && strcmp(e->tokens[i], tokens[0]) == 0;
        if (!open || !expects(e, tokens[1]))
            continue;
        for (size_t t = 0; t < GROUP_MAX && tokens[t]; t++)
            for (size_t i = 0; i < e->count; i++)
                e->said[i] |= strcmp(e->tokens[i], tokens[t]) == 0;
        add_phrase(text, size, groups[g].phrase, &said);
    }
    return said;
}

/* What could have stood here, in words; empty where that would be no help. Texts are optional nearly everywhere: they
 * are named only where nothing else is. Single tokens come first. */
static void say_expected(const char *const *tokens, size_t count, char *text, size_t size)
{
    enum { SINGLES_MAX = 7 };
    tn_expected e = {.tokens = tokens, .count = count < 96 ? count : 96};
    char groups_text[400] = "";
    size_t group_count = say_groups(&e, groups_text, sizeof groups_text), said = 0;
    text[0] = '\0';
    for (size_t i = 0; i < e.count; i++)
        if (!e.said[i] && (e.count == 1 || strcmp(tokens[i], "a text in quotes") != 0))
            add_phrase(text, size, tokens[i], &said);
    if (said > SINGLES_MAX) {
        said = 0;
        text[0] = '\0';
    }
    if (group_count > 0)
        add_phrase(text, size, groups_text, &said);
}

/* "a; b; c" -> "a, b or c" */
static void join(const char *list, char *text, size_t size)
{
    text[0] = '\0';
    while (*list) {
        size_t length = strcspn(list, ";");
        const char *rest = list + length + (list[length] ? 2 : 0);
        size_t used = strlen(text);
        snprintf(text + used, size - used, "%s%.*s", used == 0 ? "" : *rest ? ", " : " or ", (int)length, list);
        list = rest;
    }
}

static bool is_word(const char *token)
{
    return token[0] == '`' && token[1] >= 'a' && token[1] <= 'z';
}

static bool starts_expression(const char *found)
{
    static const char *const words[] = {"`tray`",        "`neighbour`", "`any`",     "`not`",
                                        "`symmetric`",   "`quantity`",  "`sum`",     "`many`",
                                        "`occurrences`", "`optional`",  "`distance`"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(found, words[i]) == 0)
            return true;
    return false;
}

static bool is_arithmetic(const char *found)
{
    return found[0] == '`' && strchr("+*/", found[1]) && found[2] == '`';
}

/* Does the token before the one at hand stand directly for `token`? */
static bool comes_after(const tn_parse *parse, const char *word)
{
    tn_span span = parse->span_before;
    size_t size = strlen(word);
    return span.end - span.begin == size && memcmp(parse->text + span.begin, word, size) == 0;
}

static bool comes_after_number(const tn_parse *parse)
{
    tn_span span = parse->span_before;
    return span.end > span.begin && parse->text[span.begin] >= '0' && parse->text[span.begin] <= '9';
}

/* Is what stands at hand `measure` or `let`, and `=` comes next? */
static bool followed_by_equals(const tn_parse *parse)
{
    tn_span span = parse->last_span;
    size_t size = span.end - span.begin, at = span.end;
    const char *word = parse->text + span.begin;
    if (!(size == 7 && memcmp(word, "measure", 7) == 0) && !(size == 3 && memcmp(word, "let", 3) == 0))
        return false;
    while (at < parse->size && parse->text[at] == ' ')
        at++;
    return at < parse->size && parse->text[at] == '=';
}

/* Does the `(` before the token at hand follow a name of the author's? */
static bool opens_call(const tn_parse *parse)
{
    static const char *const words[] = {"tray",     "neighbour", "neighbor", "quantity", "occurrences", "sum",
                                        "distance", "many",      "optional", "every",    "matches",     "not"};
    uint32_t end = parse->span_before.begin, begin = end;
    while (begin > 0 && (isalnum((unsigned char)parse->text[begin - 1]) || parse->text[begin - 1] == '-'))
        begin--;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strlen(words[i]) == end - begin && memcmp(words[i], parse->text + begin, end - begin) == 0)
            return false;
    return end > begin;
}

/* Does a digit come directly after the token at hand? */
static bool digit_follows(const tn_parse *parse)
{
    return parse->last_span.end < parse->size && isdigit((unsigned char)parse->text[parse->last_span.end]);
}

/* What was likely meant by a mark that other notations have there, or that stands in a wrong place. */
static const char *mark_fix(const tn_parse *parse, const char *found, const tn_expected *e)
{
    if (strcmp(found, "`..`") == 0 && expects(e, "`...`"))
        return "any number of trays is written with three dots: `...`";
    if (strcmp(found, "`|`") == 0 && parse->mode == TN_LEX_SCHEMA && expects(e, "`)`"))
        return "the depths of a fill are separated by commas: `dense(2m, 3m)`";
    if (strcmp(found, "`:`") == 0 && parse->mode == TN_LEX_TRAY)
        return "leave it out: a value follows its field after a blank";
    if (strcmp(found, "`|`") == 0 && parse->mode == TN_LEX_TRAY)
        return "values that a tray may have are joined by `or`: `tray(dense or light)`";
    if (strcmp(found, "`|`") == 0 && expects(e, "`or`"))
        return "alternatives are joined by `or`: `tray(a or b)` for the values of a tray, `a or b` for rules";
    if (strcmp(found, "`[`") == 0 && parse->mode == TN_LEX_PATTERN)
        return "an open plan on the command line has no brackets: `dense | ? | ...`";
    if (strcmp(found, "`[`") == 0 && expects(e, "`{`"))
        return "cases stand in braces: `test NAME { match [...] }`";
    if (strcmp(found, "`[`") == 0 && parse->mode != TN_LEX_TRAY && expects(e, "`(`") && !expects(e, "`tray`"))
        return "what follows the word stands in parentheses: `tray(...)`";
    if (strcmp(found, "`[`") == 0 && expects(e, "`tray`"))
        return "rules are joined by `and` or `or`; an open plan is written `plan [a | ? | b]`";
    if (strcmp(found, "`{`") == 0 && expects(e, "`tray`"))
        return "numbers in a row are written `quantity(a) in 2..4`, others `quantity(a) = 2 or quantity(a) = 5`";
    if (strcmp(found, "`{`") == 0 && expects(e, "a number"))
        return "numbers in a row are written `n in 2..4`, others `n = 2 or n = 5`";
    if (is_arithmetic(found) && expects(e, "`>`") && !expects(e, "`*`"))
        return "a condition compares with one number; sums are compared outside: `sum(width) > 2m + 1m`";
    if (strcmp(found, "`,`") == 0 && comes_after_number(parse) && expects(e, "`*`") && digit_follows(parse))
        return "a number is written without marks between its digits: `1200`";
    if (strcmp(found, "`)`") == 0 && comes_after(parse, "(") && expects(e, "`tray`"))
        return opens_call(parse) ? "a rule without parameters is named alone, without parentheses"
                                 : "something is missing before this";
    if (strcmp(found, "`)`") == 0 && expects(e, "`in`") && expects(e, "`mod`"))
        return "a condition compares: `n > 1`, `n = 2 or n = 5`, `n in 2..4`, `n mod 3 = 1`";
    if ((strcmp(found, "`>`") == 0 || strcmp(found, "`<`") == 0) && expects(e, "`-`"))
        return "what is compared stands on both sides: `n > 1`, `quantity(a) > 1 and quantity(a) < 4`";
    if (strcmp(found, "`-`") == 0 && expects(e, "`=`") && !expects(e, "`and`"))
        return "a name does not end with `-`";
    return NULL;
}

/* The same of words of the language. */
static const char *word_fix(const tn_parse *parse, const char *found, const tn_expected *e)
{
    if (strcmp(found, "`of`") == 0 && expects(e, "`*`"))
        return "a share is written `30% * trays`";
    if (strcmp(found, "`to`") == 0 && !expects(e, "`..`"))
        return "a distance is written `distance(from ..., to ..., by quantity(..., n >= 2))`";
    if (expects(e, "`and`") && (strcmp(found, "`neighbour`") == 0 || strcmp(found, "`many`") == 0))
        return "this word comes before what it is about: `neighbour(a, b)`; rules are joined by `and` or `or`";
    if (expects(e, "a number") && !expects(e, "`tray`") && comes_after(parse, "trays"))
        return "how many trays a plan has is written `trays 4..6`";
    if (e->count == 1 && expects(e, "`(`"))
        return "what this word is about stands in parentheses after it";
    if (expects(e, "`of`") || (strcmp(found, "`tray`") == 0 && expects(e, "`not`") && !expects(e, "`tray`")))
        return "which trays are added up is said after `of`: `sum(width of tray(a))`";
    if (expects(e, "`where`"))
        return "which trays a case is for is said by `where`: `number beds = 4 where tray(a) | 0`";
    if (e->count == 1 && expects(e, "`tray`"))
        return "a tray that is left out is written `forbid tray(...)`";
    if (parse->mode == TN_LEX_SCHEMA && strcmp(found, "a decimal number") == 0)
        return "a length has a unit: `3.6m`, `12'`";
    if (parse->mode == TN_LEX_SCHEMA && strcmp(found, "a text in quotes") == 0 && expects(e, "`flag`"))
        return "a value is a name; a text for people comes after it: `one-bed \"one bed\"`";
    if ((strcmp(found, "`require`") == 0 || strcmp(found, "`prune`") == 0) && expects(e, "`tray`"))
        return "`and` joins rules; a clause follows the one before without a word between";
    if (expects(e, "`*`") && expects(e, "`rule`") && !expects(e, "`and`"))
        return "a measure is made of sums: `1200 * sum(width) / 1m + 15000 * quantity(tray(a))`";
    if (strcmp(found, "a text in quotes") == 0 && parse->mode == TN_LEX_TRAY)
        return "values stand without quotes";
    if (strcmp(found, "a name") == 0 && comes_after_number(parse) && expects(e, "`*`"))
        return "no word follows a number; a unit follows directly: `30m`";
    return NULL;
}

/* A likely fix, from what was found and what could have stood there; NULL where none is known. */
static const char *likely_fix(const tn_parse *parse, const char *found, const tn_expected *e)
{
    if (parse->mode == TN_LEX_TRAY && strcmp(found, "`and`") == 0)
        return "inside tray(...) the items are separated by commas: all of them must be met";
    if (parse->mode == TN_LEX_TRAY && (strcmp(found, "`[`") == 0 || strcmp(found, "`{`") == 0))
        return "close tray(...) with `)` first";
    if (parse->mode == TN_LEX_LITERAL && strcmp(found, "`,`") == 0)
        return "inside a plan, values are separated by blanks and trays by `|`: [4' | 12' double]";
    if (parse->mode == TN_LEX_LITERAL || expects(e, "`]`"))
        return "a plan is written [4' | 12' double], and closed with `]`";
    if (parse->mode == TN_LEX_SCHEMA && expects(e, "`|`"))
        return "alternatives are separated by `|`, and a field starts with `NAME =`";
    if (parse->mode == TN_LEX_SCHEMA && expects(e, "a field"))
        return "a field is written `width = 4' | 8'`, `public = flag` or `zone machine = dense(4') | empty`, a "
               "forbidden tray "
               "`forbid tray(...)`";
    if (expects(e, "`)`") && expects(e, "`,`") && starts_expression(found))
        return "a `,` is missing before this, or `and` or `or`";
    if (strcmp(found, "`)`") == 0 && expects(e, "`and`") && !expects(e, "`)`") && !expects(e, "`,`"))
        return "no `(` is open that this could close: leave it out";
    if (expects(e, "`)`") && (strcmp(found, "the end of the file") == 0 || (is_word(found) && !expects(e, "a name"))))
        return "close the `(` before this";
    if (expects(e, "`[`"))
        return "a plan stands in brackets: [4' | 8' double]";
    if (strcmp(found, "a text in quotes") == 0)
        return "a text comes directly after the name that it describes";
    if (is_word(found) && expects(e, "a name") && !expects(e, "`tray`"))
        return "this is a word of the language; a name of yours has to be another word";
    if (expects(e, "`from`") && expects(e, "`using`"))
        return "a library is written `library NAME using SCHEMA { ... }`";
    if (strcmp(found, "`{`") == 0 && expects(e, "`=`"))
        return "a rule is written `rule NAME = ...`, without braces";
    if (strcmp(found, "`=`") == 0 && expects(e, "`{`"))
        return "write `{` instead of `=`, and `}` after the last line";
    if (expects(e, "`=`") && expects(e, "`using`"))
        return "a rule is written `rule NAME = ...`; a text that describes it comes after the name";
    if (strcmp(found, "`)`") == 0 && expects(e, "`,`") && expects(e, "`and`"))
        return "`every(a, b)` has two parts: each tray that is a is b too";
    if (strcmp(found, "a number") == 0 && expects(e, "a text in quotes"))
        return "a text stands in double quotes";
    if (expects(e, "`from`"))
        return "a distance is written `distance(from ..., to ..., by quantity(..., n >= 2))`";
    if (expects(e, "`in`") && expects(e, "`mod`"))
        return "a condition compares: `n > 1`, `n in 2..4`, `n mod 3 = 1`";
    if (expects(e, "`match`") && expects(e, "`keep`"))
        return "a case is written `match [4' | 8']`";
    if (expects(e, "`prune`") && expects(e, "`require`"))
        return "a library says `trays 4..9`, `total width 10m..20m`, `require RULE`, `prune RULE` or `allow W001`; "
               "what a "
               "tray is stands in rules, in `tray(...)`";
    if (expects(e, "`rule`") && strcmp(found, "a name") == 0 && followed_by_equals(parse))
        return "a name has to follow this word: `measure NAME = ...`, `let NAME = ...`";
    if (expects(e, "`rule`") && expects(e, "`and`"))
        return "rule expressions are joined by `and` or `or`; the next rule starts with `rule`";
    if (expects(e, "`rule`"))
        return "a rule is written `rule NAME = ...`";
    if (strcmp(found, "`)`") == 0 || strcmp(found, "the end of the file") == 0)
        return "something is missing before this";
    return NULL;
}

/* ---- words that the language does not have */

static void advise_slip(tn_parse *parse, tn_diagnostic *d, const tn_slip *slip)
{
    tn_help(parse->diagnostics, d, "%s", slip->help);
    if (slip->instead)
        tn_replace_with(parse->diagnostics, d, "%s", slip->instead);
}

static const tn_slip *find_slip(const tn_parse *parse, tn_slip_place place, tn_span span)
{
    return tn_slip_find(place, parse->text + span.begin, span.end - span.begin);
}

/* What the word at `span` was likely meant to be, by what could stand there. */
static const tn_slip *slip_here(const tn_parse *parse, tn_span span, const tn_expected *e)
{
    if (expects(e, "`..`") && find_slip(parse, TN_SLIP_RANGE, span))
        return find_slip(parse, TN_SLIP_RANGE, span);
    if (expects(e, "`prune`") && find_slip(parse, TN_SLIP_LIBRARY, span))
        return find_slip(parse, TN_SLIP_LIBRARY, span);
    if (expects(e, "`match`"))
        return find_slip(parse, TN_SLIP_TEST, span);
    if (expects(e, "`schema`") && find_slip(parse, TN_SLIP_ITEM, span))
        return find_slip(parse, TN_SLIP_ITEM, span);
    bool rule = parse->mode == TN_LEX_TOP && (expects(e, "`and`") || expects(e, "`tray`"));
    return rule ? find_slip(parse, TN_SLIP_RULE, span) : NULL;
}

/* The word among these that what stands at `span` is nearest to, or NULL. */
static const char *nearest(const tn_parse *parse, tn_span span, const char *const *words, size_t count)
{
    char word[40];
    if (span.end <= span.begin || span.end - span.begin >= sizeof word)
        return NULL;
    snprintf(word, sizeof word, "%.*s", (int)(span.end - span.begin), parse->text + span.begin);
    return tn_nearest(word, words, count);
}

/* The word of the language that a misspelled one is nearest to, among those that could stand here. */
static bool nearest_word(const tn_parse *parse, tn_span span, const tn_expected *e, char *meant, size_t size)
{
    char texts[96][24];
    const char *words[96];
    size_t count = 0;
    for (size_t i = 0; i < e->count; i++) {
        if (!is_word(e->tokens[i]))
            continue;
        snprintf(texts[count], sizeof texts[count], "%.*s", (int)strcspn(e->tokens[i] + 1, "`"), e->tokens[i] + 1);
        words[count] = texts[count];
        count++;
    }
    const char *near = nearest(parse, span, words, count);
    bool same =
        near && strlen(near) == span.end - span.begin && memcmp(near, parse->text + span.begin, strlen(near)) == 0;
    snprintf(meant, size, "%s", near ? near : "");
    return near && !same;
}

/* A misspelled word of the language is a name to the parser, which then stumbles over what follows: `trai(4')`. */
static bool report_misspelled(tn_parse *parse, const tn_syntax_found *found, const tn_expected *e)
{
    static const char *const words[] = {"not",      "symmetric",   "tray",     "neighbour", "many", "optional",
                                        "quantity", "occurrences", "distance", "sum",       "of"};
    enum { WORDS = sizeof words / sizeof *words, PREFIXES = 2, CALLS = 10 };
    const tn_slip *slip = expects(e, "`and`") ? find_slip(parse, TN_SLIP_RULE, found->after) : NULL;
    bool expression = expects(e, "`and`"), call = expression && strcmp(found->name, "`(`") == 0;
    const char *near = NULL;
    if (found->after.end == found->after.begin || (parse->mode != TN_LEX_TOP && parse->mode != TN_LEX_TRAY_SUM))
        return false;
    if (slip)
        near = NULL;
    else if (call)
        near = nearest(parse, found->after, words, CALLS);
    else if (expects(e, "`of`"))
        near = nearest(parse, found->after, words + CALLS, WORDS - CALLS);
    else if (expression || expects(e, "`in`"))
        near = nearest(parse, found->after, words, PREFIXES);
    if (!near && !call && !slip)
        return false;
    int size = (int)(found->after.end - found->after.begin);
    tn_diagnostic *d = tn_report(parse->diagnostics, E_UNEXPECTED, found->after,
                                 slip   ? "`%.*s` cannot stand here"
                                 : call ? "the language has no `%.*s(...)`"
                                        : "`%.*s` is not a word of the language",
                                 size, parse->text + found->after.begin);
    if (slip)
        advise_slip(parse, d, slip);
    else if (near)
        tn_suggest(parse->diagnostics, d, "%s", near);
    else
        tn_help(parse->diagnostics, d,
                "a rule is named without parentheses; `(` follows `tray`, `neighbour`, `many`, `optional`, `quantity`, "
                "`occurrences`, `sum` and `distance`");
    return true;
}

/* Two names beside each other where one can stand: `four bed`. */
static bool report_two_words(tn_parse *parse, const tn_syntax_found *found, const tn_expected *e)
{
    tn_span first = found->after, second = found->span;
    if (first.end == first.begin || strcmp(found->name, "a name") != 0 || slip_here(parse, second, e))
        return false;
    if (parse->mode == TN_LEX_TOP ? !expects(e, "`and`") : parse->mode != TN_LEX_SCHEMA || !expects(e, "`|`"))
        return false;
    char meant[40];
    if (nearest_word(parse, second, e, meant, sizeof meant))
        return false;
    const char *text = parse->text;
    int first_size = (int)(first.end - first.begin), second_size = (int)(second.end - second.begin);
    tn_diagnostic *d = tn_report(parse->diagnostics, E_UNEXPECTED, tn_span_join(first, second),
                                 "two names stand beside each other: `%.*s` and `%.*s`", first_size, text + first.begin,
                                 second_size, text + second.begin);
    tn_help(parse->diagnostics, d, "%sa name of several words is joined by `-`: `%.*s-%.*s`%s",
            parse->mode == TN_LEX_SCHEMA ? "alternatives are separated by `|`; " : "", first_size, text + first.begin,
            second_size, text + second.begin,
            parse->mode == TN_LEX_SCHEMA
                ? ""
                : "; what a tray is stands in `tray(...)`, and rules are joined by `and` or `or`");
    return true;
}

void tn_syntax_error(tn_parse *parse, const tn_syntax_found *found, const char *const *expected, size_t count)
{
    tn_span span = found->span;
    if (parse->quiet_now || (parse->virtual_brace && span.begin == span.end))
        return; /* what led to this was reported */
    tn_expected e = {.tokens = expected, .count = count < 96 ? count : 96};
    if (report_misspelled(parse, found, &e) || report_two_words(parse, found, &e))
        return;
    char list[800], words[800], here[120];
    say_expected(expected, count, list, sizeof list);
    join(list, words, sizeof words);
    size_t size = span.end > span.begin ? span.end - span.begin : 0;
    if (size == 0 || size > 40 || strcmp(found->name, "a text in quotes") == 0)
        snprintf(here, sizeof here, "%s", found->name);
    else
        snprintf(here, sizeof here, "`%.*s`", (int)size, parse->text + span.begin);
    tn_diagnostic *d = words[0]
                           ? tn_report(parse->diagnostics, E_UNEXPECTED, span, "expected %s, but found %s", words, here)
                           : tn_report(parse->diagnostics, E_UNEXPECTED, span, "%s is not expected here", here);
    char meant[40];
    const char *help = mark_fix(parse, found->name, &e);
    if (!help)
        help = word_fix(parse, found->name, &e);
    if (!help)
        help = likely_fix(parse, found->name, &e);
    bool misspelled = strcmp(found->name, "a name") == 0 || (is_word(found->name) && size > 3);
    const tn_slip *slip = slip_here(parse, span, &e);
    if (slip)
        advise_slip(parse, d, slip);
    else if (misspelled && nearest_word(parse, span, &e, meant, sizeof meant))
        tn_suggest(parse->diagnostics, d, "%s", meant);
    else
        tn_help(parse->diagnostics, d, "%s", help ? help : "write what is expected, or leave this out");
}
