/* Words the syntax errors of .plan files. */
#include "compiler/plan/syntax/syntax_error.h"

#include <ctype.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "compiler/plan/syntax/slip.h"
#include "compiler/plan/syntax/syntax_fix.h"
#include "compiler/plan/syntax/words.h"
#include "runtime/base/nearest.h"

/* ---- finds the first word of a line, and how lines that begin with it are written */

static const struct {
    const char *word, *feet, *metric; /* metric: NULL where it is the same */
} examples[] = {
    {"storey", "storey ground 9'", "storey ground 2.7m"},
    {"spine", "spine body", NULL},
    {"wall", "wall 8\"", "wall 200mm"},
    {"partition", "partition 4\"", "partition 100mm"},
    {"deck", "floor 10\"", "floor 250mm"},
    {"floor", "floor 10\"", "floor 250mm"},
    {"roof", "roof 8\"", "roof 200mm"},
    {"option", "option body roof = flat | gable(9:12)", NULL},
    {"section", "option body roof = flat | gable(9:12)", NULL},
    {"void", "void cell(body, loft)", NULL},
    {"no", "no cell(body, loft)", NULL},
    {"function", "function kitchen at cell(body, ground)", NULL},
    {"opening", "opening door wide 2'8\" high 6'8\" passage", "opening door wide 800mm high 2m passage"},
    {"way", "way 2'8\"", "way 800mm"},
    {"headroom", "headroom 6'8\"", "headroom 2m"},
    {"guard", "guard 3'", "guard 1m"},
    {"allow", "allow W204", NULL},
    {"flight", "flight stairs wide 3' rise 6\"..7 3/4\" going 10\"",
     "flight stairs wide 900mm rise 150mm..195mm going 250mm"},
    {"beam", "beam girder wide 6\" high 10\" span 16'", "beam girder wide 150mm high 250mm span 5m"},
    {"face", "face cell(kitchen) beside cell(hall) = open | door", NULL},
    {"tile", "tile bed for bedroom { against wall  item bed left 2'..7', back 0..6'8\" }",
     "tile bed for bedroom { against wall  item bed left 600mm..2.1m, back 0..2m }"},
    {"against", "against wall or window", NULL},
    {"keep", "keep side left 0..2', back 0..6'8\"", "keep side left 0..600mm, back 0..2m"},
    {"item", "item bed left 2'..7', back 0..6'8\", up 0..2'", "item bed left 600mm..2.1m, back 0..2m, up 0..600mm"},
    {"material", "material brick \"#a05040\" price 12 per sf for wall",
     "material brick \"#a05040\" price 120 per m2 for wall"},
    {"classification", "classification \"Uniclass 2015\" for wall \"EF_25_10\", roof \"EF_30_10\"", NULL},
    {"rule", "rule wide = tray(width > 8')", "rule wide = tray(width > 2.4m)"},
    {"library", "library rows using shed { trays 2..4 }", NULL},
    {"test", "test corner { match [8' | 4'] }", "test corner { match [2.4m | 1.2m] }"},
    {"schema", "schema shed { width = 4' | 8' }", "schema shed { width = 1.2m | 2.4m }"},
    {"trays", "trays 2..4", NULL},
    {"require", "require quantity(tray(8'), n >= 1)", NULL},
    {"prune", "prune tray(4') as narrow", "prune tray(1.2m) as narrow"},
    {"measure", "measure cost = 1200 * quantity(any)", NULL},
};

/* The unit that a length is spelt in which begins at a digit: 'f' for feet and inches, 'm' for metric ones, or 0. */
static char unit_of(const char *at)
{
    at += strspn(at, "0123456789.");
    if (*at == '\'' || *at == '"')
        return 'f';
    at += *at == 'c' || (*at == 'm' && at[1] == 'm');
    return *at == 'm' && !isalnum((unsigned char)at[1]) ? 'm' : 0;
}

/* Is the first length of the text metric? */
static bool is_metric(const char *text)
{
    char unit = 0, before = 0;
    for (const char *at = text; *at && !unit; before = *at++) {
        if (isdigit((unsigned char)*at) && !isalnum((unsigned char)before) && before != '.')
            unit = unit_of(at);
    }
    return unit == 'm';
}

/* An example of the line that the byte `at` of a text is on, by the line's first word; NULL where the word begins
 * lines of several kinds, or of none. Its lengths are metric where the first one of the text is. A string that lives as
 * long as the program. */
static const char *syntax_example(const char *text, size_t at)
{
    size_t begin = at;
    while (begin > 0 && text[begin - 1] != '\n' && text[begin - 1] != '\r')
        begin--;
    while (text[begin] == ' ' || text[begin] == '\t')
        begin++;
    size_t size = 0;
    while (isalpha((unsigned char)text[begin + size]))
        size++;
    for (size_t i = 0; i < sizeof examples / sizeof *examples; i++)
        if (begin + size <= at && strlen(examples[i].word) == size &&
            strncasecmp(text + begin, examples[i].word, size) == 0)
            return examples[i].metric && is_metric(text) ? examples[i].metric : examples[i].feet;
    return NULL;
}

enum { SIGNS_MAX = 16 };

/* Groups of tokens that one phrase names: a group is used where both its signals are expected, the first of them not
 * yet named, and then covers the words that stand in these places and are one of these uses there, and its signs. */
static const struct {
    const char *phrase, *signals[2];
    uint64_t places;
    uint32_t uses;
    const char *signs[SIGNS_MAX]; /* tokens that are no words */
} groups[] = {
    {"a rule expression",
     {"`tray`", "`neighbour`"},
     TN_AT(RULE),
     TN_AS_STARTS,
     {"a name", "`(`", "an area", "a decimal number", "a number", "a length", "`-`"}},
    {"an operator such as `and`, `or` or `>`",
     {"`and`", "`+`"},
     TN_AT(RULE),
     TN_AS_INFIX,
     {"`+`", "`*`", "`/`", "`-`", "`<`", "`<=`", "`=`", "`!=`", "`>=`", "`>`"}},
    {"`+`, `-`, `*` or `/`", {"`+`", "`*`"}, 0, 0, {"`+`", "`*`", "`/`", "`-`"}},
    {"a condition such as `n > 1`",
     {"`-`", "`(`"},
     TN_AT(CONDITION),
     TN_AS_PREFIX,
     {"`-`", "`(`", "a number", "a name", "a length", "an area", "a decimal number"}},
    {"a variable or a number",
     {"`-`", "a name"},
     0,
     0,
     {"`-`", "a name", "a number", "a length", "an area", "a decimal number"}},
    {"a number", {"`-`", "a number"}, 0, 0, {"`-`", "a number", "a length", "an area", "a decimal number"}},
    {"`flag` or a value",
     {"`flag`", "`...`"},
     0,
     0,
     {"`flag`", "`...`", "a length", "a name", "a number", "`measure` of plans", "`rule` of plans"}},
    {"a value",
     {"a length", "a name"},
     TN_AT(TRAY),
     TN_AS_PREFIX,
     {"a length", "a name", "a number", "an area", "a decimal number", "`in`", "`(`", "`<`", "`<=`", "`=`", "`!=`",
      "`>=`", "`>`", "`-` for what is absent", "`:` before a depth"}},
    {"a comparison such as `>`", {"`<`", "`<=`"}, 0, 0, {"`<`", "`<=`", "`=`", "`!=`", "`>=`", "`>`"}},
    {"the next `rule`, `schema`, `library`, `form`, `test` or `use`",
     {"`rule`", "`schema`"},
     TN_AT(ITEM),
     TN_AS_KEYWORDS,
     {"an expression", "an open plan", "a plan", "the value of a param", "the end of the file"}},
    {"a line of a form (`storey`, `option`, `function`, `face`, `tile` ...)",
     {"`storey`", "`spine`"},
     TN_AT(FORM),
     TN_AS_KEYWORDS,
     {NULL}},
    {"a length or 0", {"a length", "a number"}, 0, 0, {"a length", "a number"}},
    {"a clause (`trays`, `total`, `require`, `prune` ...)",
     {"`trays`", "`prune`"},
     TN_AT(CLAUSE),
     TN_AS_KEYWORDS,
     {NULL}},
    {"`match`, `reject`, `keep`, `drop` or `todo`", {"`todo`", "`match`"}, TN_AT_CASES, TN_AS_KEYWORDS, {NULL}},
    {"`match`, `reject`, `keep` or `drop`", {"`match`", "`keep`"}, TN_AT_CASES, TN_AS_KEYWORDS, {NULL}},
    {"a field (`name = values`)", {"a field", "`forbid`"}, TN_AT(SCHEMA), TN_AS_KEYWORDS, {"a field"}},
};

static void add_phrase(char *text, size_t size, const char *phrase, size_t *said)
{
    size_t length = strlen(text);
    snprintf(text + length, size - length, "%s%s", *said ? "; " : "", phrase);
    (*said)++;
}

static bool covers(size_t group, const char *token)
{
    const char *const *signs = groups[group].signs;
    for (size_t i = 0; i < SIGNS_MAX && signs[i]; i++)
        if (strcmp(token, signs[i]) == 0)
            return true;
    return tn_token_is_word(token, groups[group].places, groups[group].uses);
}

static size_t say_groups(tn_expected *e, char *text, size_t size)
{
    size_t said = 0;
    for (size_t g = 0; g < sizeof groups / sizeof *groups; g++) {
        bool open = false;
        for (size_t i = 0; i < e->count; i++)
            open |= !e->said[i] && strcmp(e->tokens[i], groups[g].signals[0]) == 0;
        if (!open || !tn_expects(e, groups[g].signals[1]))
            continue;
        for (size_t i = 0; i < e->count; i++)
            e->said[i] |= covers(g, e->tokens[i]);
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
    if (tn_expects(e, "`..`") && find_slip(parse, TN_SLIP_RANGE, span))
        return find_slip(parse, TN_SLIP_RANGE, span);
    if (tn_expects(e, "`prune`") && find_slip(parse, TN_SLIP_LIBRARY, span))
        return find_slip(parse, TN_SLIP_LIBRARY, span);
    if (tn_expects(e, "`match`"))
        return find_slip(parse, TN_SLIP_TEST, span);
    if (tn_expects(e, "`schema`") && find_slip(parse, TN_SLIP_ITEM, span))
        return find_slip(parse, TN_SLIP_ITEM, span);
    bool rule = parse->mode == TN_LEX_TOP && (tn_expects(e, "`and`") || tn_expects(e, "`tray`"));
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

/* The same among the words that stand in one of these places and are one of these uses there. */
static const char *nearest_of(const tn_parse *parse, tn_span span, uint64_t places, uint32_t uses)
{
    enum { WORDS_MAX = 96 };
    const char *words[WORDS_MAX];
    return nearest(parse, span, words, tn_vocabulary_list(&tn_plan_words, places, uses, words, WORDS_MAX));
}

/* The word of the language that a misspelled one is nearest to, among those that could stand here. */
static bool nearest_word(const tn_parse *parse, tn_span span, const tn_expected *e, char *meant, size_t size)
{
    char texts[96][24];
    const char *words[96];
    size_t count = 0;
    for (size_t i = 0; i < e->count; i++) {
        if (!tn_is_keyword(e->tokens[i]))
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

/* What a name was likely meant to be, by what it stands before. */
static const char *meant_before(const tn_parse *parse, const tn_syntax_found *found, const tn_expected *e)
{
    bool expression = tn_expects(e, "`and`"), call = strcmp(found->name, "`(`") == 0;
    if (expression && call)
        return nearest_of(parse, found->after, TN_AT(RULE), TN_AS_PREFIX | TN_AS_CALL);
    if (call)
        return nearest_of(parse, found->after, TN_AT(TALLY), TN_AS_CALL);
    if (expression && strcmp(found->name, "`[`") == 0)
        return nearest_of(parse, found->after, TN_AT(RULE), TN_AS_MARK);
    if (tn_expects(e, "`of`") && !tn_expects(e, "`{`"))
        return nearest_of(parse, found->after, TN_AT(TALLY), TN_AS_INFIX);
    return expression || tn_expects(e, "`in`") ? nearest_of(parse, found->after, TN_AT(RULE), TN_AS_PREFIX) : NULL;
}

/* A misspelled word of the language is a name to the parser, which then stumbles over what follows: `trai(4')`. */
static bool report_misspelled(tn_parse *parse, const tn_syntax_found *found, const tn_expected *e)
{
    bool sums = parse->mode == TN_LEX_TRAY_SUM || (parse->mode == TN_LEX_SCHEMA && parse->in_number);
    bool opens =
        parse->mode == TN_LEX_LITERAL && strcmp(found->name, "`[`") == 0; /* the bracket has changed the mode */
    if (found->after.end == found->after.begin || (parse->mode != TN_LEX_TOP && !sums && !opens))
        return false;
    const tn_slip *slip = tn_expects(e, "`and`") ? find_slip(parse, TN_SLIP_RULE, found->after) : NULL;
    const char *near = slip ? NULL : meant_before(parse, found, e);
    bool call = strcmp(found->name, "`(`") == 0 && (near || tn_expects(e, "`and`"));
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
                "a rule is named without parentheses; `(` follows words such as `tray`, `neighbour` and `sum`");
    return true;
}

/* The word before the parenthesis in which a byte stands; empty where there is none. */
static tn_span called(const tn_parse *parse, tn_span place)
{
    size_t at = place.begin, closed = 0;
    while (at-- > 0 && parse->text[at] != '{' && parse->text[at] != '}') {
        closed += parse->text[at] == ')';
        if (parse->text[at] == '(' && closed-- == 0) {
            size_t begin = at;
            while (begin > 0 && (isalnum((unsigned char)parse->text[begin - 1]) || parse->text[begin - 1] == '-'))
                begin--;
            return (tn_span){place.file, (uint32_t)begin, (uint32_t)at};
        }
    }
    return (tn_span){place.file, place.begin, place.begin};
}

/* Does the file have a rule of that name? */
static bool declares_rule(const tn_parse *parse, tn_span name)
{
    size_t size = name.end - name.begin;
    for (const char *at = strstr(parse->text, "rule"); at; at = strstr(at + 1, "rule")) {
        const char *word = at + strlen("rule");
        word += strspn(word, " \t");
        if (strncmp(word, parse->text + name.begin, size) == 0 && !isalnum((unsigned char)word[size]) &&
            word[size] != '-')
            return true;
    }
    return false;
}

/* `romo(hall, by door)`, `optino(body roof flat)`, `maxx(beds of any)`: what stands in the parentheses can stand in
 * none of a rule's. */
static bool report_misspelled_call(tn_parse *parse, const tn_syntax_found *found)
{
    bool values = found->after.end > found->after.begin &&
                  (strcmp(found->name, "a name") == 0 || strcmp(found->name, "a length") == 0 ||
                   strcmp(found->name, "`of`") == 0);
    if (parse->mode != TN_LEX_TOP ||
        (!values && !tn_token_is_word(found->name, TN_AT(DISTANCE) | TN_AT(MEETING), TN_AS_MARK)))
        return false;
    tn_span word = called(parse, found->span);
    if (tn_vocabulary_find(&tn_plan_words, parse->text + word.begin, word.end - word.begin, TN_ANYWHERE,
                           TN_AS_KEYWORDS) ||
        declares_rule(parse, word))
        return false;
    const char *near = nearest_of(parse, word, TN_AT(RULE), TN_AS_CALL);
    if (!near)
        return false;
    tn_diagnostic *d = tn_report(parse->diagnostics, E_UNEXPECTED, word, "the language has no `%.*s(...)`",
                                 (int)(word.end - word.begin), parse->text + word.begin);
    tn_suggest(parse->diagnostics, d, "%s", near);
    return true;
}

/* `max(gapp from a to b)`: no number of a tray has a name after a name. */
static bool report_misspelled_gap(tn_parse *parse, const tn_syntax_found *found)
{
    static const char from[] = "from";
    tn_span second = found->after;
    if (!parse->in_extreme || strcmp(found->name, "a name") != 0 || second.end - second.begin != strlen(from) ||
        strncasecmp(parse->text + second.begin, from, strlen(from)) != 0)
        return false;
    size_t end = second.begin, begin;
    while (end > 0 && isspace((unsigned char)parse->text[end - 1]))
        end--;
    for (begin = end; begin > 0 && isalpha((unsigned char)parse->text[begin - 1]);)
        begin--;
    tn_span word = {second.file, (uint32_t)begin, (uint32_t)end};
    const char *near = nearest_of(parse, word, TN_AT(TALLY), TN_AS_MARK);
    if (!near)
        return false;
    tn_diagnostic *d = tn_report(parse->diagnostics, E_UNEXPECTED, word, "`%.*s` is not a word of the language",
                                 (int)(end - begin), parse->text + begin);
    tn_suggest(parse->diagnostics, d, "%s", near);
    return true;
}

static bool is_quantifier(const tn_parse *parse, tn_span word)
{
    const char *text = parse->text + word.begin;
    size_t size = word.end - word.begin;
    return parse->mode == TN_LEX_TOP &&
           ((size == 4 && strncasecmp(text, "some", 4) == 0) || (size == 5 && strncasecmp(text, "every", 5) == 0));
}

/* `soem v in FIELD (...)`; is it that, with two names beside each other? */
static bool report_misspelled_quantifier(tn_parse *parse, tn_span first, tn_span second)
{
    const char *rest = parse->text + second.end + strspn(parse->text + second.end, " \t");
    const char *near = nearest_of(parse, first, TN_AT(RULE), TN_AS_MARK);
    if (!near || strncasecmp(rest, "in", 2) != 0 || isalnum((unsigned char)rest[2]))
        return false;
    tn_diagnostic *d = tn_report(parse->diagnostics, E_UNEXPECTED, first, "`%.*s` is not a word of the language",
                                 (int)(first.end - first.begin), parse->text + first.begin);
    tn_suggest(parse->diagnostics, d, "%s", near);
    return true;
}

/* `some v (...)`: without its field. */
static bool report_quantifier(tn_parse *parse, tn_span span)
{
    tn_diagnostic *d = tn_report(parse->diagnostics, E_UNEXPECTED, span, "of which field these are values is not said");
    tn_help(parse->diagnostics, d,
            "values of a field are gone through by `some v in FIELD (...)`, `every v in FIELD (...)`");
    return true;
}

/* `prune narrow wide`: two rules without the comma between them. */
static bool report_missing_comma(tn_parse *parse, tn_span first, tn_span second, const tn_expected *e)
{
    if (!tn_expects(e, "`,`") || !declares_rule(parse, first) || !declares_rule(parse, second))
        return false;
    const char *text = parse->text;
    tn_span whole = tn_span_join(first, second);
    tn_diagnostic *d = tn_report(parse->diagnostics, E_UNEXPECTED, whole, "a comma is missing between two rules");
    tn_advise(parse->diagnostics, d, "%.*s, %.*s", (int)(first.end - first.begin), text + first.begin,
              (int)(second.end - second.begin), text + second.begin);
    return true;
}

/* Is it a word that can stand in the head of an item? */
static bool is_head_word(const tn_parse *parse, tn_span word)
{
    return tn_vocabulary_find(&tn_plan_words, parse->text + word.begin, word.end - word.begin,
                              TN_AT(ITEM) | TN_AT(HEAD), TN_AS_KEYWORDS) != NULL;
}

/* Does what the item is come behind the word? */
static bool heads_body(const tn_parse *parse, tn_span word)
{
    size_t next = word.end + strspn(parse->text + word.end, " \t\r\n");
    return parse->text[next] != '\0' && strchr("{=(\"", parse->text[next]);
}

/* `rule no rest = ...`, `library small halls { ... }`: the name of an item in two words. */
static bool report_parted_name(tn_parse *parse, const tn_syntax_found *found, const tn_expected *e)
{
    tn_span first = found->after, second = found->span;
    bool heads = tn_expects(e, "`{`") || (tn_expects(e, "`=`") && tn_expects(e, "`using`"));
    char meant[40];
    if (parse->mode != TN_LEX_TOP || first.end == first.begin || strcmp(found->name, "a name") != 0 || !heads ||
        is_head_word(parse, first) || !heads_body(parse, second) || slip_here(parse, second, e) ||
        nearest_word(parse, second, e, meant, sizeof meant))
        return false;
    int first_size = (int)(first.end - first.begin), second_size = (int)(second.end - second.begin);
    const char *text = parse->text;
    tn_diagnostic *d = tn_report(parse->diagnostics, E_UNEXPECTED, tn_span_join(first, second),
                                 "a name is one word, and these are two: `%.*s` and `%.*s`", first_size,
                                 text + first.begin, second_size, text + second.begin);
    tn_advise(parse->diagnostics, d, "%.*s-%.*s", first_size, text + first.begin, second_size, text + second.begin);
    return true;
}

/* `frontage = measuer front` in a schema of a library; `frontage = measure front` in another. */
static bool report_said(tn_parse *parse, tn_span first, tn_span second)
{
    const char *near = parse->mode == TN_LEX_SCHEMA ? nearest_of(parse, first, TN_AT(FIELD), TN_AS_HEAD) : NULL;
    bool same = near && strlen(near) == first.end - first.begin &&
                strncasecmp(near, parse->text + first.begin, strlen(near)) == 0;
    if (!near || same == parse->of_library)
        return false;
    tn_diagnostic *d = same ? tn_report(parse->diagnostics, E_UNEXPECTED, tn_span_join(first, second),
                                        "what a %s says is a field of a schema of a library alone", near)
                            : tn_report(parse->diagnostics, E_UNEXPECTED, first, "`%.*s` is not a word of the language",
                                        (int)(first.end - first.begin), parse->text + first.begin);
    if (same)
        tn_help(parse->diagnostics, d, "such a schema is written `schema NAME of LIBRARY { ... }`");
    else
        tn_suggest(parse->diagnostics, d, "%s", near);
    return true;
}

/* Two names beside each other where one can stand: `four bed`. */
static bool report_two_words(tn_parse *parse, const tn_syntax_found *found, const tn_expected *e)
{
    tn_span first = found->after, second = found->span;
    bool only = parse->mode == TN_LEX_SCHEMA && second.end - second.begin == 4 &&
                memcmp(parse->text + second.begin, "only", 4) == 0;
    if (first.end == first.begin || strcmp(found->name, "a name") != 0 || only || slip_here(parse, second, e))
        return false;
    if (is_quantifier(parse, first))
        return report_quantifier(parse, tn_span_join(first, second));
    if (parse->mode == TN_LEX_TOP && report_misspelled_quantifier(parse, first, second))
        return true;
    if (parse->mode == TN_LEX_TOP ? !tn_expects(e, "`and`") : parse->mode != TN_LEX_SCHEMA || !tn_expects(e, "`|`"))
        return false;
    char meant[40];
    if (report_said(parse, first, second))
        return true;
    if (nearest_word(parse, second, e, meant, sizeof meant))
        return false;
    if (report_missing_comma(parse, first, second, e))
        return true;
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

/* `9 m`: a unit that does not follow its number directly. */
static bool report_parted_unit(tn_parse *parse, const tn_syntax_found *found)
{
    static const struct {
        const char *unit, *written;
    } units[] = {{"m", "m"},    {"cm", "cm"},   {"mm", "mm"},     {"ft", "'"},     {"feet", "'"},
                 {"foot", "'"}, {"inch", "\""}, {"inches", "\""}, {"metres", "m"}, {"meters", "m"}};
    const char *text = parse->text;
    tn_span number = parse->span_before, unit = found->span;
    size_t digits = strspn(text + number.begin, "0123456789."), size = unit.end - unit.begin;
    size_t blanks = strspn(text + number.end, " \t");
    if (number.end == number.begin || digits != number.end - number.begin || blanks == 0 ||
        number.end + blanks != unit.begin)
        return false;
    for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
        if (strlen(units[i].unit) != size || strncasecmp(units[i].unit, text + unit.begin, size) != 0)
            continue;
        tn_diagnostic *d = tn_report(parse->diagnostics, E_UNEXPECTED, tn_span_join(number, unit),
                                     "a unit follows its number without a blank");
        tn_advise(parse->diagnostics, d, "%.*s%s", (int)digits, text + number.begin, units[i].written);
        return true;
    }
    return false;
}

/* `rule 2-cafes`: a name that begins with a digit. */
static bool report_digit_name(tn_parse *parse, const tn_syntax_found *found, const tn_expected *e)
{
    static const char *const words[] = {"no",    "one",   "two",  "three", "four",   "five",  "six",
                                        "seven", "eight", "nine", "ten",   "eleven", "twelve"};
    const char *text = parse->text + found->span.begin, *rest = text + strspn(text, "0123456789");
    size_t size = strcspn(text, " \t\r\n=(){}[],;\"");
    if (strcmp(found->name, "a number") != 0 || e->count > 2 || !tn_expects(e, "a name") || rest == text + size ||
        (*rest != '-' && !isalpha((unsigned char)*rest)))
        return false;
    const tn_span whole = {found->span.file, found->span.begin, found->span.begin + (uint32_t)size};
    tn_diagnostic *d = tn_report(parse->diagnostics, E_UNEXPECTED, whole, "a name begins with a letter");
    const char *name = rest + (*rest == '-');
    int left = (int)(text + size - name);
    const char *digits = text + strspn(text, "0"), *last = text + strspn(text, "0123456789");
    unsigned long number = last - digits < 3 ? strtoul(text, NULL, 10) : sizeof words;
    if (number < sizeof words / sizeof *words)
        tn_advise(parse->diagnostics, d, "%s-%.*s", words[number], left, name);
    else
        tn_advise(parse->diagnostics, d, "%.*s-%.*s", left, name, (int)(last - digits), digits);
    return true;
}

/* `118,50`: the comma of a number whose decimals stand after one; `1,500`: one of thousands. */
static bool report_decimal_comma(tn_parse *parse, const tn_syntax_found *found, const tn_expected *e)
{
    tn_span whole = parse->span_before;
    const char *rest = parse->text + found->span.end;
    int digits = (int)strspn(rest, "0123456789"), size = (int)(whole.end - whole.begin);
    if (strcmp(found->name, "`,`") != 0 || !tn_expects(e, "`per`") || digits == 0 || whole.end != found->span.begin)
        return false;
    tn_span span = {whole.file, whole.begin, found->span.end + (uint32_t)digits};
    const char *text = parse->text + whole.begin;
    tn_diagnostic *d =
        tn_report(parse->diagnostics, E_UNEXPECTED, span, "`%.*s,%.*s` is no price", size, text, digits, rest);
    bool thousands = digits == 3 && size <= 3 && !memchr(text, '.', (size_t)size);
    tn_help(parse->diagnostics, d,
            thousands ? "thousands are not parted: `%.*s%s%.*s`" : "decimals stand after a point: `%.*s%s%.*s`", size,
            text, thousands ? "" : ".", digits, rest);
    tn_replace_with(parse->diagnostics, d, "%.*s%s%.*s", size, text, thousands ? "" : ".", digits, rest);
    return true;
}

/* `material brick #a05040 ...`: the sign begins a comment, so the parser stumbles over a line further down. */
static bool report_colour(tn_parse *parse, const tn_expected *e)
{
    enum { DIGITS_LEAST = 3, DIGITS_MOST = 8 };
    size_t begin = parse->span_before.end;
    begin += strspn(parse->text + begin, " \t");
    size_t digits = parse->text[begin] == '#' ? strspn(parse->text + begin + 1, "0123456789abcdefABCDEF") : 0;
    if (!parse->in_form || e->count != 1 || !tn_expects(e, "a text in quotes") || digits < DIGITS_LEAST ||
        digits > DIGITS_MOST || isalnum((unsigned char)parse->text[begin + 1 + digits]))
        return false;
    tn_span span = {parse->span_before.file, (uint32_t)begin, (uint32_t)(begin + 1 + digits)};
    int size = (int)(1 + digits);
    tn_diagnostic *d =
        tn_report(parse->diagnostics, E_UNEXPECTED, span, "expected a text in quotes, and `#` begins a comment here");
    tn_help(parse->diagnostics, d, "a colour is written in quotes: `\"%.*s\"`", size, parse->text + begin);
    tn_replace_with(parse->diagnostics, d, "\"%.*s\"", size, parse->text + begin);
    return true;
}

/* `keep [#3:12]`: as above. */
static bool report_rank(tn_parse *parse, const tn_expected *e)
{
    size_t begin = parse->span_before.end;
    begin += strspn(parse->text + begin, " \t");
    if (!tn_expects(e, "a house") || parse->text[begin] != '#' || !isdigit((unsigned char)parse->text[begin + 1]))
        return false;
    size_t size = 1 + strspn(parse->text + begin + 1, "0123456789:");
    tn_span span = {parse->span_before.file, (uint32_t)begin, (uint32_t)(begin + size)};
    tn_diagnostic *d =
        tn_report(parse->diagnostics, E_UNEXPECTED, span, "expected a plan or a house, and `#` begins a comment here");
    tn_help(parse->diagnostics, d, "write the line that `tartan unrank FILE '%.*s'` prints", (int)size,
            parse->text + begin);
    return true;
}

/* `wide 8sf`: an area where a length of a form stands; the length with the same number is shown. */
static bool advise_length(tn_parse *parse, tn_diagnostic *d, const tn_syntax_found *found, const tn_expected *e)
{
    const char *text = parse->text + found->span.begin;
    if (!parse->in_form || strcmp(found->name, "an area") != 0 || !tn_expects(e, "a length") || e->count > 2)
        return false;
    int digits = (int)strspn(text, "0123456789.");
    bool metric = found->span.end > found->span.begin && memchr(text, 'm', found->span.end - found->span.begin);
    tn_help(parse->diagnostics, d, "a length stands here, such as `%.*s%s`", digits, text, metric ? "m" : "'");
    return true;
}

/* How the line that is wrong is written: where the next line began too early, the one before it. */
static const char *example_of(const tn_parse *parse, tn_span span)
{
    const char *example = syntax_example(parse->text, span.begin);
    return example ? example : syntax_example(parse->text, parse->span_before.end);
}

/* The last `(` before a byte that is not closed, where it is on a line before that and the byte's own line begins as
 * one of the language's does. Texts in quotes and comments are not told apart: their parentheses are mostly closed. */
static bool find_unclosed(const tn_parse *parse, tn_span span, tn_span *open)
{
    size_t closed = 0, at = span.begin;
    bool line = false;
    if (!syntax_example(parse->text, at))
        return false;
    while (at-- > 0) {
        char c = parse->text[at];
        line |= c == '\n';
        if (c == '{' || c == '}')
            return false;
        closed += c == ')';
        if (c == '(' && closed-- == 0)
            break;
    }
    *open = (tn_span){span.file, (uint32_t)at, (uint32_t)at + 1};
    return line && at != SIZE_MAX;
}

/* By what is known of the place, or else by how such a line is written. */
static void advise_otherwise(tn_parse *parse, tn_diagnostic *d, tn_span span, const tn_expected *e, const char *help)
{
    const char *example = example_of(parse, span);
    tn_span open;
    if (tn_expects(e, "`)`") && find_unclosed(parse, span, &open)) {
        tn_note(parse->diagnostics, d, &open, "this `(` is not closed");
        tn_help(parse->diagnostics, d, "write the `)` that is missing");
    } else if (help)
        tn_help(parse->diagnostics, d, "%s", help);
    else if (tn_expects(e, "`neighbour`"))
        tn_help(parse->diagnostics, d,
                "here stands `any`, `tray(...)`, `neighbour(...)` or another rule expression, or the name of a rule");
    else if (example)
        tn_help(parse->diagnostics, d, "such a line is written `%s`", example);
    else
        tn_help(parse->diagnostics, d, "write what is expected, or leave this out");
}

void tn_syntax_error(tn_parse *parse, const tn_syntax_found *found, const char *const *expected, size_t count)
{
    tn_span span = found->span;
    if (parse->quiet_now || (parse->virtual_brace && span.begin == span.end))
        return; /* what led to this was reported */
    tn_expected e = {.tokens = expected, .count = count < 96 ? count : 96};
    if (report_misspelled_call(parse, found) || report_misspelled(parse, found, &e) ||
        report_misspelled_gap(parse, found) || report_parted_unit(parse, found) ||
        report_digit_name(parse, found, &e) || report_parted_name(parse, found, &e) ||
        report_two_words(parse, found, &e) || report_decimal_comma(parse, found, &e) || report_colour(parse, &e) ||
        report_rank(parse, &e))
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
    const char *help = tn_syntax_fix(parse, found->name, &e);
    /* `tray(` is not `trays`, and a room is no roof */
    bool called = (tn_starts_expression(found->name) && parse->text[span.end] == '(') ||
                  (parse->in_form && size == 4 && memcmp(parse->text + span.begin, "room", 4) == 0);
    bool misspelled = strcmp(found->name, "a name") == 0 || (tn_is_keyword(found->name) && size > 3 && !called);
    const tn_slip *slip = tn_starts_expression(found->name) ? NULL : slip_here(parse, span, &e);
    if (slip)
        advise_slip(parse, d, slip);
    else if (misspelled && nearest_word(parse, span, &e, meant, sizeof meant))
        tn_suggest(parse->diagnostics, d, "%s", meant);
    else if (!advise_length(parse, d, found, &e))
        advise_otherwise(parse, d, span, &e, help);
}
