/* What was probably meant: marks of other notations, words in the wrong place, what is missing. */
#include "compiler/plan/syntax/syntax_fix.h"

#include <ctype.h>
#include <string.h>

#include "compiler/common/compilation.h"
#include "compiler/plan/syntax/words.h"

bool tn_expects(const tn_expected *e, const char *token)
{
    for (size_t i = 0; i < e->count; i++)
        if (strcmp(e->tokens[i], token) == 0)
            return true;
    return false;
}

bool tn_is_keyword(const char *token)
{
    return token[0] == '`' && token[1] >= 'a' && token[1] <= 'z';
}

bool tn_token_is_word(const char *token, uint64_t places, uint32_t uses)
{
    return tn_is_keyword(token) &&
           tn_vocabulary_find(&tn_plan_words, token + 1, strcspn(token + 1, "`"), places, uses) != NULL;
}

bool tn_starts_expression(const char *found)
{
    return tn_token_is_word(found, TN_AT(RULE), TN_AS_STARTS);
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

static bool stands_here(const tn_parse *parse, const char *word)
{
    tn_span span = parse->last_span;
    size_t size = strlen(word);
    return span.end - span.begin == size && memcmp(parse->text + span.begin, word, size) == 0;
}

/* Is what stands at hand in the parentheses of `min(...)` or `max(...)`, with none inside them? */
static bool in_extreme(const tn_parse *parse)
{
    size_t at = parse->last_span.begin;
    while (at > 0 && !strchr("()\n", parse->text[at - 1]))
        at--;
    const char *word = at >= 4 && parse->text[at - 1] == '(' ? parse->text + at - 4 : "";
    return strncmp(word, "min(", 4) == 0 || strncmp(word, "max(", 4) == 0;
}

/* Is what stands at hand in the parentheses behind this word? They begin in the same line. */
static bool in_call(const tn_parse *parse, const char *word)
{
    size_t at = parse->last_span.begin, size = strlen(word), closed = 0;
    for (; at > 0 && parse->text[at - 1] != '\n'; at--) {
        closed += parse->text[at - 1] == ')';
        if (parse->text[at - 1] == '(' && closed-- == 0)
            break;
    }
    return at > size && parse->text[at - 1] == '(' && memcmp(parse->text + at - 1 - size, word, size) == 0;
}

static bool comes_after_number(const tn_parse *parse)
{
    tn_span span = parse->span_before;
    return span.end > span.begin && parse->text[span.begin] >= '0' && parse->text[span.begin] <= '9';
}

/* Does the line begin with this word? */
static bool on_line_of(const tn_parse *parse, const char *word)
{
    size_t begin = parse->span_before.begin, size = strlen(word);
    while (begin > 0 && parse->text[begin - 1] != '\n')
        begin--;
    begin += strspn(parse->text + begin, " \t");
    return strncmp(parse->text + begin, word, size) == 0 && isspace((unsigned char)parse->text[begin + size]);
}

/* Is what stands at hand a word like `measure`, which is one only before a name, and `=` comes next? */
static bool followed_by_equals(const tn_parse *parse)
{
    tn_span span = parse->last_span;
    size_t at = span.end;
    const tn_vocabulary_word *word = tn_vocabulary_find(&tn_plan_words, parse->text + span.begin, span.end - span.begin,
                                                        TN_AT(ITEM), TN_AS_KEYWORDS);
    if (!word || !(word->read & TN_READ_LATER))
        return false;
    while (at < parse->size && parse->text[at] == ' ')
        at++;
    return at < parse->size && parse->text[at] == '=';
}

/* Does the `(` before the token at hand follow a name of the author's? */
static bool opens_call(const tn_parse *parse)
{
    uint32_t end = parse->span_before.begin, begin = end;
    while (begin > 0 && (isalnum((unsigned char)parse->text[begin - 1]) || parse->text[begin - 1] == '-'))
        begin--;
    return end > begin && !tn_vocabulary_find(&tn_plan_words, parse->text + begin, end - begin,
                                              TN_AT(RULE) | TN_AT(CONDITION), TN_AS_KEYWORDS);
}

/* Does a name of the author's come after the token at hand? */
static bool name_follows(const tn_parse *parse)
{
    size_t at = parse->last_span.end, size = 0;
    at += strspn(parse->text + at, " \t");
    while (isalnum((unsigned char)parse->text[at + size]) || parse->text[at + size] == '-')
        size++;
    return size > 0 &&
           !tn_vocabulary_find(&tn_plan_words, parse->text + at, size, TN_AT(ITEM) | TN_AT(HEAD), TN_AS_KEYWORDS);
}

/* Does a digit come directly after the token at hand? */
static bool digit_follows(const tn_parse *parse)
{
    return parse->last_span.end < parse->size && isdigit((unsigned char)parse->text[parse->last_span.end]);
}

/* Is this the first word of the line of the token at hand? */
static bool line_begins(const tn_parse *parse, const char *word)
{
    size_t begin = parse->last_span.begin, size = strlen(word);
    while (begin > 0 && parse->text[begin - 1] != '\n')
        begin--;
    begin += strspn(parse->text + begin, " \t");
    return strncmp(parse->text + begin, word, size) == 0 && !isalnum((unsigned char)parse->text[begin + size]);
}

/* Does the word stand before the token at hand, on its line? */
static bool line_has(const tn_parse *parse, const char *word)
{
    size_t end = parse->last_span.begin, size = strlen(word);
    for (size_t at = end; at >= size + 1 && parse->text[at - 1] != '\n'; at--)
        if (strncmp(parse->text + at - size, word, size) == 0 && isspace((unsigned char)parse->text[at - size - 1]) &&
            isspace((unsigned char)parse->text[at]))
            return true;
    return false;
}

/* Does the token at hand stand in a clause of bounds, behind this word: `trays 1..`, `total width <=`? */
static bool in_clause(const tn_parse *parse, const char *word)
{
    size_t size = strlen(word), at = parse->last_span.begin, words = 0;
    while (at > 0 && words < 3) {
        while (at > 0 && (isspace((unsigned char)parse->text[at - 1]) || strchr("<>=.", parse->text[at - 1])))
            at--;
        size_t end = at;
        while (at > 0 && (isalnum((unsigned char)parse->text[at - 1]) || parse->text[at - 1] == '-'))
            at--;
        if (end == at)
            return false;
        if (end - at == size && strncmp(parse->text + at, word, size) == 0)
            return words > 0 || end < parse->last_span.begin;
        words++;
    }
    return false;
}

static bool stands_compass(const tn_parse *parse)
{
    static const char *const points[] = {"north", "south", "east", "west"};
    bool here = false;
    for (size_t i = 0; i < sizeof points / sizeof *points; i++)
        here |= stands_here(parse, points[i]);
    return here;
}

/* Does the word before the token at hand come after this one? */
static bool comes_after_next(const tn_parse *parse, const char *word)
{
    size_t end = parse->span_before.begin, size = strlen(word);
    while (end > 0 && isspace((unsigned char)parse->text[end - 1]))
        end--;
    return end > size && memcmp(parse->text + end - size, word, size) == 0 &&
           isspace((unsigned char)parse->text[end - size - 1]);
}

/* Lines of forms that are neither of these. */
static const char *form_fix(const tn_parse *parse, const char *found, const tn_expected *e)
{
    bool named_floor = strcmp(found, "a name") == 0 && line_begins(parse, "floor");
    if (named_floor || (tn_expects(e, "`storey`") && stands_here(parse, "level")))
        return "a storey and its height are written `storey ground 3m`";
    if (tn_expects(e, "`storey`") && stands_here(parse, "room"))
        return "what cells are for is written `function living at cell(body)`";
    if (strcmp(found, "a length") == 0 && comes_after_next(parse, "spine"))
        return "a zone follows `spine`: `spine body`";
    if (strcmp(found, "`..`") == 0 && (line_begins(parse, "option") || line_begins(parse, "section")))
        return "each number of storeys is written, with `|` between: `option body storeys = 1 | 2`";
    if (strcmp(found, "`|`") == 0 && line_begins(parse, "against"))
        return "kinds of faces are joined by `or` here: `against wall or window`";
    if (line_begins(parse, "function") && (stands_here(parse, "min") || stands_here(parse, "area")))
        return "how large a room is, a library asks: `require room(bedroom, area >= 9m2)`, or `prune room(bedroom, "
               "area "
               "< 9m2)`";
    return NULL;
}

/* Lines `face` of forms: one relation, one side, kinds by bars. */
static const char *face_fix(const tn_parse *parse, const char *found, const tn_expected *e)
{
    bool joined = strcmp(found, "`or`") == 0 || strcmp(found, "`and`") == 0 || strcmp(found, "`,`") == 0;
    if (joined && tn_expects(e, "`|`"))
        return "kinds that a face may have are separated by `|`: `= door | wall`";
    if (joined && e->count == 1 && tn_expects(e, "`=`"))
        return "a line is about one side, or without a side about all of them: write a line for each";
    if (tn_expects(e, "`front`") && stands_compass(parse))
        return "a side is `front`, `back`, `left` or `right` of the plan, and no point of the compass";
    if (tn_expects(e, "`under`") && stands_here(parse, "above"))
        return "the lower cell comes first: `face cell(stair) under cell(stair) = stair`";
    if (tn_expects(e, "`front`") && tn_expects(e, "`=`"))
        return "what is outside is written `face cell(any) outside front = window | wall`; the side may be left out";
    return NULL;
}

/* Heads of libraries of houses: one library of plans, one form. */
static const char *library_fix(const tn_parse *parse, const char *found, const tn_expected *e)
{
    static const char *const joints[] = {"`in`", "`,`", "`or`", "`and`", "`|`", "a name"};
    bool more = false;
    for (size_t i = 0; i < sizeof joints / sizeof *joints; i++)
        more |= strcmp(found, joints[i]) == 0;
    if (!more || !tn_expects(e, "`{`") || !line_begins(parse, "library"))
        return NULL;
    if (e->count == 1 && line_has(parse, "onto"))
        return "a projected library is one of plans: houses are those of another one, `library NAME from PROJECTED in "
               "FORM { ... }`";
    if (e->count == 1)
        return "a library has one form: for the other write another `library NAME from PLANS in FORM { ... }`";
    if (tn_expects(e, "`in`") && strcmp(found, "a name") != 0)
        return "a library is made from one other: write a library for each";
    return NULL;
}

/* Is the parenthesis in which the token at hand stands that of this word? */
static bool stands_in(const tn_parse *parse, const char *word)
{
    size_t at = parse->last_span.begin, size = strlen(word), closed = 0;
    while (at-- > 0 && parse->text[at] != '{' && parse->text[at] != '}') {
        closed += parse->text[at] == ')';
        if (parse->text[at] == '(' && closed-- == 0)
            return at >= size && memcmp(parse->text + at - size, word, size) == 0;
    }
    return false;
}

/* Questions about cells of houses that have two parts. */
static const char *pair_fix(const tn_parse *parse, const tn_expected *e)
{
    if (stands_in(parse, "apart") && tn_expects(e, "`from`"))
        return "a walk is asked for by `apart(cell(...), from cell(...), by door or open)`";
    if (stands_in(parse, "touch"))
        return "two cells that meet are asked for by `touch(cell(...), cell(...) by door or open)`";
    return NULL;
}

/* What was likely meant in forms and in what asks for houses. */
static const char *house_fix(const tn_parse *parse, const char *found, const tn_expected *e)
{
    const char *fix = line_begins(parse, "face") ? face_fix(parse, found, e) : NULL;
    if (!fix && parse->in_form)
        fix = form_fix(parse, found, e);
    if (fix)
        return fix;
    if (tn_expects(e, "`cell`") && !tn_expects(e, "`tray`") && strcmp(found, "a name") == 0)
        return "cells are asked for by `cell(...)`: `cell(kitchen)`, `cell(body, ground)`";
    if ((fix = pair_fix(parse, e)))
        return fix;
    if (strcmp(found, "`cell`") == 0 && line_begins(parse, "forbid"))
        return "`forbid option(...)` is about choices of the form; cells that are not there are said by `no "
               "cell(...)`";
    if ((fix = library_fix(parse, found, e)))
        return fix;
    if (tn_expects(e, "`from`") && tn_expects(e, "`using`") && strcmp(found, "`in`") == 0)
        return "a library of houses is written `library NAME from PLANS in FORM { ... }`";
    if (strcmp(found, "`of`") == 0 && comes_after(parse, "area"))
        return "areas of cells are added up by `sum(area of cell(...), a > 400sf)`; rooms are asked for by "
               "`room(kitchen, area < 90sf)`";
    if (e->count <= 2 && tn_expects(e, "`of`") && line_begins(parse, "form"))
        return "a form is written `form NAME of SCHEMA { ... }`";
    if (e->count == 1 && tn_expects(e, "`:`"))
        return "numbers in the parentheses of a roof are a slope, how far it rises for how far: `gable(9:12)`; a "
               "length "
               "has a unit: `vault(4')`";
    return NULL;
}

/* Of weights and preferences: their numbers, and what stands beside them. */
static const char *leaning_fix(const tn_parse *parse, const char *found, const tn_expected *e)
{
    bool prefers = tn_expects(e, "`worth`"), number = comes_after_number(parse);
    if (!parse->clause || !tn_expects(e, "`prune`"))
        return NULL;
    if (prefers && (strcmp(found, "a number") == 0 || strcmp(found, "a decimal number") == 0))
        return "what a preference is worth stands behind `worth`: `prefer a worth 3`";
    if (strcmp(found, "`worth`") == 0)
        return "what a preference is worth stands behind it, once, and before its name: `prefer a worth 3 as NAME`";
    if (strcmp(found, "`/`") == 0 || (!prefers && strcmp(found, "`*`") == 0))
        return "it is one number, such as 3 or 0.25";
    if (number && prefers && tn_starts_expression(found))
        return "the number stands behind what is preferred: `prefer a worth 3`";
    if (number && tn_starts_expression(found))
        return "the number stands behind what trays are: `weight tray(a) 7`";
    if (!prefers && !tn_expects(e, "`as`") && strcmp(found, "`,`") == 0)
        return "each weight is a clause of its own: `weight tray(a) 7`, and in the next line `weight tray(b) 2`";
    if (!prefers && !tn_expects(e, "`as`") && (strcmp(found, "`as`") == 0 || strcmp(found, "a text in quotes") == 0))
        return "a weight has no name or text of its own: name the rule instead, `rule fit = ...`, then `weight fit 7`";
    return NULL;
}

/* Of numbers: what is compared, and ranges. */
static const char *number_fix(const tn_parse *parse, const char *found, const tn_expected *e)
{
    bool name = strcmp(found, "a name") == 0 && tn_expects(e, "a number");
    if (name && in_clause(parse, "trays"))
        return "a bound is a number here; with a name for it write `require trays <= NAME`";
    if (in_clause(parse, "total") &&
        ((name && !tn_expects(e, "`prune`")) || (strcmp(found, "`..`") == 0 && !tn_expects(e, "`..`"))))
        return "a bound is a number or a length here; with a name for it write `require sum(FIELD) <= NAME`";
    bool compares = strchr("<>=!", found[1]) != NULL && found[0] == '`';
    if (compares && tn_expects(e, "`tray`") && (comes_after(parse, "and") || comes_after(parse, "or")))
        return "what is compared stands on both sides: `sum(FIELD) >= 10m and sum(FIELD) <= 20m`, or `sum(FIELD) in "
               "10m..20m`";
    if (strcmp(found, "`..`") == 0 && parse->mode == TN_LEX_TOP && tn_expects(e, "`and`") && comes_after_number(parse))
        return "a range follows `in`: `quantity(a) in 1..2`";
    if (line_begins(parse, "total") && strcmp(found, "`and`") == 0 && tn_expects(e, "`..`"))
        return "a range is written with two dots: `total FIELD 10m..20m`";
    if (line_begins(parse, "total") && strcmp(found, "a name") == 0 && tn_expects(e, "`prune`") &&
        !tn_expects(e, "`..`"))
        return "the field stands before its bounds: `total FIELD 10m..20m`";
    return NULL;
}

/* What was likely meant by a mark that other notations have there, or that stands in a wrong place. */
static const char *mark_fix(const tn_parse *parse, const char *found, const tn_expected *e)
{
    const char *number = number_fix(parse, found, e);
    if (number)
        return number;
    if (strcmp(found, "`(`") == 0 && tn_expects(e, "`and`") &&
        (comes_after(parse, "beginning") || comes_after(parse, "end")))
        return "what begins or ends a plan stands beside it: `neighbour(beginning, a)`, `neighbour(a, end)`";
    if (strcmp(found, "`,`") == 0 && tn_expects(e, "`and`") && tn_expects(e, "`rule`"))
        return "trays side by side are written `neighbour(a, b)`; rules are joined by `and` or `or`";
    if (strcmp(found, "`..`") == 0 && tn_expects(e, "`...`"))
        return "any number of trays is written with three dots: `...`";
    if (strcmp(found, "`|`") == 0 && parse->mode == TN_LEX_SCHEMA && tn_expects(e, "`)`"))
        return "the depths of a fill are separated by commas: `FILL(2m, 3m)`";
    if (strcmp(found, "`:`") == 0 && parse->mode == TN_LEX_TRAY)
        return "leave it out: a value follows its field after a blank";
    bool tray = parse->mode == TN_LEX_TRAY;
    if (tray && strcmp(found, "`,`") == 0 && in_extreme(parse))
        return "the smaller and the greater of two numbers of a tray are had by a `number` of the schema: "
               "`number least = min(a, b)`";
    if (tray && (strcmp(found, "`|`") == 0 || strcmp(found, "`{`") == 0 ||
                 (strcmp(found, "`,`") == 0 && tn_expects(e, "`or`") && !tn_expects(e, "`,`"))))
        return "values that a tray may have are joined by `or`: `tray(a or b)`, `tray(not (a or b))`";
    if (strcmp(found, "`|`") == 0 && tn_expects(e, "`or`"))
        return "alternatives are joined by `or`: `tray(a or b)` for the values of a tray, `a or b` for rules";
    if (strcmp(found, "`...`") == 0 && parse->mode == TN_LEX_PATTERN && tn_expects(e, "`|`"))
        return "`...` stands for trays, between bars; values of a tray that are left open are not written";
    if (strcmp(found, "`?`") == 0 && parse->mode == TN_LEX_PATTERN && tn_expects(e, "`|`"))
        return "`?` stands for a whole tray, between bars: `a | ? | b`";
    if (strcmp(found, "`...`") == 0 && parse->mode == TN_LEX_PATTERN)
        return "trays are separated by a bar: `a | ... | b`";
    if (strcmp(found, "`[`") == 0 && parse->mode == TN_LEX_PATTERN)
        return "brackets stand around the whole plan: `[a | ? | ...]`";
    if (strcmp(found, "`[`") == 0 && tn_expects(e, "`{`"))
        return "cases stand in braces: `test NAME { match [...] }`";
    if (strcmp(found, "`[`") == 0 && parse->mode != TN_LEX_TRAY && tn_expects(e, "`(`") && !tn_expects(e, "`tray`"))
        return "what follows the word stands in parentheses: `tray(...)`";
    if (strcmp(found, "`[`") == 0 && tn_expects(e, "`tray`"))
        return "rules are joined by `and` or `or`; an open plan is written `plan [a | ? | b]`";
    if (strcmp(found, "`{`") == 0 && tn_expects(e, "`tray`"))
        return "numbers in a row are written `quantity(a) in 2..4`, others `quantity(a) = 2 or quantity(a) = 5`";
    if (strcmp(found, "`{`") == 0 && tn_expects(e, "a number"))
        return "numbers in a row are written `n in 2..4`, others `n = 2 or n = 5`";
    if (strcmp(found, "`*`") == 0 && tn_expects(e, "`...`"))
        return "any number of trays is written `...`";
    if ((is_arithmetic(found) || strcmp(found, "`-`") == 0) && tn_expects(e, "`>`") && !tn_expects(e, "`*`"))
        return "a condition compares with one number; sums are compared outside: `sum(FIELD) > 2m + 1m`";
    if (strcmp(found, "`,`") == 0 && tn_expects(e, "`and`") && tn_expects(e, "`>`") && !tn_expects(e, "`implies`"))
        return "conditions are joined by `and`: `n > 2 and n < 4`";
    if (strcmp(found, "`,`") == 0 && tn_expects(e, "`implies`") && tn_expects(e, "`)`") && !tn_expects(e, "`,`"))
        return "one rule stands in these parentheses; rules are joined by `and` or `or`, trays in a row by "
               "`neighbour(a, a, a)`";
    if (strcmp(found, "`,`") == 0 && comes_after_number(parse) && tn_expects(e, "`*`") && digit_follows(parse))
        return "a number is written without marks between its digits: `1200`";
    if (strcmp(found, "`)`") == 0 && comes_after(parse, "(") && tn_expects(e, "`tray`"))
        return opens_call(parse) ? "a rule without parameters is named alone, without parentheses"
                                 : "something is missing before this";
    if (strcmp(found, "`)`") == 0 && tn_expects(e, "`in`") && tn_expects(e, "`mod`") && !tn_expects(e, "`+`"))
        return "a condition compares: `n > 1`, `n = 2 or n = 5`, `n in 2..4`, `n mod 3 = 1`";
    if ((strcmp(found, "`>`") == 0 || strcmp(found, "`<`") == 0) && tn_expects(e, "`-`"))
        return "what is compared stands on both sides: `n > 1`, `quantity(a) > 1 and quantity(a) < 4`";
    if (strcmp(found, "`-`") == 0 && tn_expects(e, "`=`") && !tn_expects(e, "`and`"))
        return "a name does not end with `-`";
    return NULL;
}

/* The same in `max(...)` and `min(...)`; NULL elsewhere. */
static const char *extreme_fix(const tn_parse *parse, const char *found)
{
    if (!parse->in_extreme)
        return NULL;
    return strcmp(found, "`,`") == 0
               ? "of two numbers of a tray it stands inside `sum(...)`: `sum(max(FIELD, 2m))`; alone it is `max(FIELD "
                 "of a)`"
               : "`max(...)` and `min(...)` choose among trays, `max(FIELD of tray(a))`, or gaps, `max(gap from a to "
                 "b)`";
}

/* The same of words of the language. */
static const char *word_fix(const tn_parse *parse, const char *found, const tn_expected *e)
{
    if (strcmp(found, "`as`") == 0 && tn_expects(e, "`require`"))
        return "only `prune` gives its clauses names; name the rule instead: `rule fit = ...`, then `require fit`";
    if (strcmp(found, "`of`") == 0 && comes_after(parse, "within"))
        return "how near has to be said: `a within 2 of b`, `a within 12m of b`";
    if (strcmp(found, "`of`") == 0 && tn_expects(e, "`*`"))
        return "a share is written `30% * trays`";
    if (strcmp(found, "`to`") == 0 && !tn_expects(e, "`..`"))
        return "a distance is written `distance(from ..., to ..., by quantity(..., n >= 2))`";
    if (strcmp(found, "`trays`") == 0 && comes_after_number(parse) && tn_expects(e, "`)`"))
        return "a tray of any kind is written `any`, two of them `any, any`, any number of them `...`";
    if (tn_expects(e, "`and`") && strcmp(found, "`tray`") == 0 && !tn_expects(e, "`,`"))
        return "trays side by side are written `neighbour(tray(...), tray(...))`; rules are joined by `and` or `or`";
    if (tn_expects(e, "`and`") && (strcmp(found, "`neighbour`") == 0 || strcmp(found, "`many`") == 0))
        return "this word comes before what it is about: `neighbour(a, b)`; rules are joined by `and` or `or`";
    if (tn_expects(e, "a number") && !tn_expects(e, "`tray`") && comes_after(parse, "trays"))
        return "how many trays a plan has is written `trays 4..6`";
    if (e->count == 1 && tn_expects(e, "`(`"))
        return "what this word is about stands in parentheses after it";
    if (tn_expects(e, "`)`") && tn_token_is_word(found, TN_AT(ITEM), TN_AS_KEYWORDS))
        return "close the `(` before this";
    if ((tn_expects(e, "`of`") && !tn_expects(e, "`{`")) ||
        (strcmp(found, "`tray`") == 0 && tn_expects(e, "`not`") && !tn_expects(e, "`tray`")))
        return parse->in_extreme ? extreme_fix(parse, found)
                                 : "which trays are added up is said after `of`: `sum(FIELD of tray(a))`";
    if (tn_expects(e, "`where`") && parse->in_number && !stands_here(parse, "only"))
        return "which trays a case is for is said by `where`: `number beds = 4 where tray(a) | 0`";
    if (e->count == 1 && tn_expects(e, "`every`"))
        return "what is far is so from each: `a at least 2 from every b`";
    if (e->count == 1 && tn_expects(e, "`tray`"))
        return "a tray that is left out is written `forbid tray(...)`";
    if (parse->mode == TN_LEX_SCHEMA && strcmp(found, "a decimal number") == 0)
        return "a length has a unit: `3.6m`, `12'`";
    if (parse->mode == TN_LEX_SCHEMA && strcmp(found, "a text in quotes") == 0 && tn_expects(e, "`flag`"))
        return "a value is a name; a text for people comes after it: `one-bed \"one bed\"`";
    if ((strcmp(found, "`require`") == 0 || strcmp(found, "`prune`") == 0) && tn_expects(e, "`tray`"))
        return "`and` joins rules; a clause follows the one before without a word between";
    if (tn_expects(e, "`*`") && tn_expects(e, "`rule`") && !tn_expects(e, "`and`"))
        return "a measure is made of sums: `1200 * sum(FIELD) / 1m + 15000 * quantity(tray(a))`";
    if (strcmp(found, "a text in quotes") == 0 && parse->mode == TN_LEX_TRAY)
        return "values stand without quotes";
    if (strcmp(found, "a name") == 0 && comes_after_number(parse) && tn_expects(e, "`*`") &&
        !stands_here(parse, "only"))
        return "no word follows a number; a unit follows directly: `30m`";
    return NULL;
}

/* The same among the fields of a schema. */
static const char *schema_fix(const tn_parse *parse, const char *found, const tn_expected *e)
{
    if (tn_expects(e, "`flag`") &&
        (strcmp(found, "`[`") == 0 || strcmp(found, "`{`") == 0 || strcmp(found, "`(`") == 0))
        return "the values stand one after the other, with `|` between: `a | b | c`";
    if (strcmp(found, "`where`") == 0 && tn_expects(e, "`|`") && !parse->in_number)
        return "a number of a tray begins with the word `number`: `number NAME = 12 where tray(a) | 8`";
    if (comes_after(parse, "|") && tn_expects(e, "`...`"))
        return "a value is missing after the `|` before this";
    if (strcmp(found, "a length") == 0 && tn_expects(e, "`(`"))
        return "the depths of a fill stand in parentheses: `FILL(2m, 3m)`";
    if (strcmp(found, "`..`") == 0 && tn_expects(e, "`|`"))
        return "each value is written: `4m | 6m | 8m`";
    if (stands_here(parse, "only"))
        return "what all trays are is said by `only tray(...)`, with `and`, `or`, `not` between several";
    if (stands_here(parse, "tray") && !tn_expects(e, "`tray`"))
        return "each tray that is left out has a `forbid` of its own: `forbid tray(...)`";
    return NULL;
}

/* Does the token at hand come after a word that starts an item, and that a name of the author's has to follow? */
static bool comes_after_heading(const tn_parse *parse)
{
    tn_span span = parse->span_before;
    return tn_vocabulary_find(&tn_plan_words, parse->text + span.begin, span.end - span.begin, TN_AT(ITEM),
                              TN_AS_HEAD) != NULL;
}

/* A likely fix, from what was found and what could have stood there; NULL where none is known. */
static const char *likely_fix(const tn_parse *parse, const char *found, const tn_expected *e)
{
    if (parse->mode == TN_LEX_TRAY && strcmp(found, "`and`") == 0)
        return "items in parentheses are separated by commas: all of them must be met";
    if (parse->mode == TN_LEX_TRAY && (strcmp(found, "`[`") == 0 || strcmp(found, "`{`") == 0))
        return "close the parenthesis with `)` first";
    if (parse->mode == TN_LEX_LITERAL && strcmp(found, "`,`") == 0)
        return "inside a plan, values are separated by blanks and trays by `|`: `[a b | c]`";
    if (parse->mode == TN_LEX_LITERAL || tn_expects(e, "`]`"))
        return "a plan is written `[a b | c]`: the values of a tray, and `|` between trays";
    const char *schema = parse->mode == TN_LEX_SCHEMA ? schema_fix(parse, found, e) : NULL;
    if (schema)
        return schema;
    if (parse->mode == TN_LEX_SCHEMA && tn_expects(e, "`|`"))
        return "alternatives are separated by `|`, and a field starts with `NAME =`";
    if (parse->mode == TN_LEX_SCHEMA && strcmp(found, "`,`") == 0 && on_line_of(parse, "forbid"))
        return "each tray that is left out has its own `forbid`: `forbid tray(a) forbid tray(b)`";
    if (parse->mode == TN_LEX_SCHEMA && tn_expects(e, "a field"))
        return "a field is written `NAME = a | b`, `NAME = 4m | 6m`, `NAME = flag` or `zone NAME = FILL(2m) | FILL`, "
               "a forbidden tray `forbid tray(...)`";
    if ((tn_expects(e, "`)`") || tn_expects(e, "`prune`")) && tn_expects(e, "`,`") && tn_starts_expression(found))
        return "a `,` is missing before this, or `and` or `or`";
    if (strcmp(found, "`)`") == 0 && parse->in_extreme && tn_expects(e, "`to`"))
        return "a gap leads from one thing to another: `max(gap from a to b)`";
    if (strcmp(found, "`)`") == 0 && tn_expects(e, "`and`") && !tn_expects(e, "`)`") && !tn_expects(e, "`,`"))
        return "no `(` is open that this could close: leave it out";
    if (tn_expects(e, "`)`") &&
        (strcmp(found, "the end of the file") == 0 || (tn_is_keyword(found) && !tn_expects(e, "a name"))))
        return "close the `(` before this";
    if (tn_expects(e, "`[`"))
        return "a plan stands in brackets: `[a b | c]`";
    if (strcmp(found, "a text in quotes") == 0 && tn_expects(e, "`as`") && tn_expects(e, "`and`"))
        return "a clause that is pruned has a text behind its name: `prune a as NAME \"text\"`";
    if (strcmp(found, "a text in quotes") == 0)
        return "a text comes directly after the name that it describes";
    if (tn_is_keyword(found) && tn_expects(e, "a name") && !tn_expects(e, "`tray`"))
        return "this is a word of the language; a name of yours has to be another word";
    if (strcmp(found, "`=`") == 0 && tn_expects(e, "`from`") && tn_expects(e, "`using`") && name_follows(parse))
        return "a library that is made from another is written `library NAME from OTHER { prune RULE }`";
    if (tn_expects(e, "`from`") && tn_expects(e, "`using`"))
        return "a library is written `library NAME using SCHEMA { ... }`";
    if (e->count == 1 && tn_expects(e, "a name") && comes_after(parse, "with"))
        return "the values of params stand behind `with`: `test NAME with lot = 9m { ... }`";
    if (e->count == 1 && tn_expects(e, "`=`") && line_begins(parse, "test"))
        return "the value of a param stands behind `=`: `test NAME with lot = 9m { ... }`";
    if (strcmp(found, "`{`") == 0 && tn_expects(e, "`=`"))
        return "a rule is written `rule NAME = ...`, without braces";
    if (strcmp(found, "`=`") == 0 && tn_expects(e, "`{`"))
        return "write `{` instead of `=`, and `}` after the last line";
    if (tn_expects(e, "`=`") && tn_expects(e, "`using`"))
        return "a rule is written `rule NAME = ...`; a text that describes it comes after the name";
    bool ends_early = strcmp(found, "`)`") == 0 && tn_expects(e, "`,`") && tn_expects(e, "`and`");
    if (ends_early && in_call(parse, "walk"))
        return "say where it leads: `walk(cell(a), to outside)`, `walk(cell(a), to cell(b))`";
    if (ends_early && in_call(parse, "apart"))
        return "say what it is apart from: `apart(cell(a), from cell(b))`";
    if (ends_early)
        return "`every(a, b)` has two parts: each tray that is a is b too";
    if (strcmp(found, "a number") == 0 && tn_expects(e, "a text in quotes"))
        return "a text stands in double quotes";
    if (tn_expects(e, "`from`") && tn_expects(e, "`{`") && strcmp(found, "`in`") == 0)
        return "a library of houses is `library NAME from PLANS in FORM { ... }`";
    if (tn_expects(e, "`from`") && parse->schema_head)
        return "a schema is written `schema NAME { ... }`; one that is made from another, `schema NAME from OLDER { "
               "... }`";
    if (e->count == 1 && tn_expects(e, "a name") && comes_after_heading(parse))
        return "a name of yours follows this word: `rule NAME = ...`, `library NAME { ... }`, `test NAME { ... }`";
    if (e->count == 1 && tn_expects(e, "a text in quotes") && comes_after(parse, "use"))
        return "the name of a file stands in quotes: `use \"NAME\"`";
    if (e->count == 2 && tn_expects(e, "`)`") && tn_expects(e, "`,`") && strcmp(found, "a name") == 0)
        return "names are separated by commas";
    if (tn_expects(e, "`from`") || (e->count == 1 && (tn_expects(e, "`to`") || tn_expects(e, "`by`"))))
        return "a distance is written `distance(from ..., to ..., by quantity(..., n >= 2))`";
    if (tn_expects(e, "`in`") && tn_expects(e, "`mod`") && !tn_expects(e, "`+`"))
        return "a condition compares: `n > 1`, `n in 2..4`, `n mod 3 = 1`";
    if (tn_expects(e, "`match`") && tn_expects(e, "`keep`"))
        return "a case is written `match [a b | c]`";
    if (tn_expects(e, "`prune`") && tn_expects(e, "`and`") && tn_starts_expression(found))
        return "expressions are joined by `and` or `or`, clauses of a library by `,`; what a tray is stands in "
               "`tray(...)`";
    if (tn_expects(e, "`prune`") && tn_expects(e, "`require`"))
        return "a library says `trays 4..9`, `total FIELD 10m..20m`, `generate RULE`, `require RULE`, `prune RULE`, "
               "`prefer RULE`, "
               "`weight tray(...) 3` or `allow W001`; what a tray is stands in rules, in `tray(...)`";
    if (tn_expects(e, "`rule`") && strcmp(found, "a name") == 0 && followed_by_equals(parse))
        return "a name has to follow this word: `measure NAME = ...`, `let NAME = ...`";
    if (tn_expects(e, "`rule`") && tn_expects(e, "`and`"))
        return "rule expressions are joined by `and` or `or`; the next rule starts with `rule`";
    if (tn_expects(e, "`rule`"))
        return "a rule is written `rule NAME = ...`";
    if (strcmp(found, "`)`") == 0 || strcmp(found, "`}`") == 0 || strcmp(found, "the end of the file") == 0)
        return "something is missing before this";
    return NULL;
}

/* Values of params, and of what has none. */
static const char *param_fix(const tn_parse *parse, const char *found)
{
    if (strcmp(found, "`{`") == 0 && line_begins(parse, "test") && comes_after(parse, "="))
        return "the value of a param stands behind `=`: `test NAME with lot = 9m { ... }`";
    if (strcmp(parse->diagnostics->sources->files[parse->file].path, TN_SETTING_SOURCE) == 0)
        return "a param is given a value by its name, `=` and the value: `lot=12m`, `side=right`";
    if (parse->mode == TN_LEX_TOP && line_begins(parse, "param"))
        return "a param is written `param NAME = 12m`, `param NAME = 12m in 9m..20m` or `param NAME = left | right`";
    return NULL;
}

const char *tn_syntax_fix(const tn_parse *parse, const char *found, const tn_expected *e)
{
    const char *fix = param_fix(parse, found);
    if (!fix)
        fix = house_fix(parse, found, e);
    if (!fix)
        fix = leaning_fix(parse, found, e);
    if (!fix)
        fix = mark_fix(parse, found, e);
    if (!fix)
        fix = word_fix(parse, found, e);
    return fix ? fix : likely_fix(parse, found, e);
}
