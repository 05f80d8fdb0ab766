/* The tables of words: those of the language, and those that other notations have, and English. */
#include "compiler/plan/syntax/slip.h"

#include <string.h>
#include <strings.h>

#include "compiler/plan/syntax/words.h"

static const tn_vocabulary_word rows[] = {
#define WORD(TEXT, TOKEN, READ, PLACES, USE, SENTENCE) {TEXT, SENTENCE, PLACES, USE, READ},
#include "compiler/plan/syntax/words.def"
};

const tn_vocabulary tn_plan_words = {rows, sizeof rows / sizeof *rows, NULL, 0, false};

static const tn_slip slips[] = {
    {TN_SLIP_RULE, "xor|either", "one of two, and not both, is written `(a or b) and not (a and b)`", NULL},
    {TN_SLIP_RULE, "if|then|when|whenever|requires|needs|demands", "if a matches, b has to match: write `a implies b`",
     NULL},
    {TN_SLIP_RULE, "else|otherwise", "write both cases: `(a implies b) and (not a implies c)`", NULL},
    {TN_SLIP_RULE, "count|number|howmany|amount",
     "`quantity(a)` counts the trays that are a, `occurrences(a)` the places where a rule matches", NULL},
    {TN_SLIP_RULE, "exactly|just", "an exact number is written `quantity(a) = 2`", NULL},
    {TN_SLIP_RULE, "atleast|at-least|atmost|at-most|least|most|minimum|maximum|more|fewer|less|up|over|under",
     "numbers of trays are compared: `quantity(a) >= 2`, `quantity(a) <= 2`, `quantity(a) in 2..4`", NULL},
    {TN_SLIP_RULE, "longest|shortest|greatest|smallest|largest|widest|narrowest|tallest|deepest|biggest",
     "the greatest number of some trays is written `max(FIELD of a)`, the longest gap `max(gap from a to b)`", NULL},
    {TN_SLIP_RULE, "at",
     "numbers of trays are compared, `quantity(a) >= 2`; what is far is `a at least 2 from every b`; a plan's first "
     "trays are written `neighbour(beginning, a)`",
     NULL},
    {TN_SLIP_RULE, "between", "what lies between two is written `quantity(a) in 2..4`, `sum(FIELD) in 20m..30m`", NULL},
    {TN_SLIP_RULE, "every|all|each|only|always|forall|for",
     "`every(a, b)`: each tray that is a is b too; `every(any, a)`: all trays are a; `every a beside b`: each stands "
     "so",
     NULL},
    {TN_SLIP_RULE, "none|no|never|without", "none is written `quantity(a) = 0`, or `not a`", NULL},
    {TN_SLIP_RULE, "exists|has|contains|contain|includes|there",
     "write the rule alone: it matches a plan that has such trays anywhere", NULL},
    {TN_SLIP_RULE, "next|nextto|next-to|beside|adjacent|adjacent-to|adjoining|touching|touches",
     "a next to b is written `a beside b`; in this order `neighbour(a, b)`", NULL},
    {TN_SLIP_RULE, "near|close|nearby|far|within",
     "how near or far b is from a is written `a within 2 of b`, `a at least 2 from every b`", NULL},
    {TN_SLIP_RULE, "before|after|followed|follows|precedes",
     "trays are named from left to right: `neighbour(a, b)`, with others between `neighbour(a, ..., b)`; what lies "
     "before one is counted in `a where quantity(b before) > 0`",
     NULL},
    {TN_SLIP_RULE, "first|start|starts|begin|begins", "the plan's first trays are written `neighbour(beginning, a)`",
     NULL},
    {TN_SLIP_RULE, "last|ends|finish", "the plan's last trays are written `neighbour(a, end)`", NULL},
    {TN_SLIP_RULE, "isolated|alone|lone",
     "a tray with none of its kind beside it is written `a at least 1 from every a`", NULL},
    {TN_SLIP_RULE, "repeat|repeated|several|sequence|row",
     "some in a row are written `repeat(a, 2..4)`, any number of them `neighbour(many(a))`", NULL},
    {TN_SLIP_RULE, "area|floor-area|floorarea",
     "areas of cells of a house are added up by `sum(area of cell(...))`; trays have none", NULL},
    {TN_SLIP_RULE, "length|width|total", "lengths are added up by `sum(FIELD)`: `sum(FIELD) <= 24m`", NULL},
    {TN_SLIP_RULE, "average|mean|avg|median", "a mean is a quotient: `sum(FIELD) / trays >= 3m`", NULL},
    {TN_SLIP_RULE, "min|max",
     "what it is of stands in parentheses: `max(FIELD of a)`, `min(gap from a to b)`; `max(x, y)` of two numbers of "
     "a tray stands inside `sum(...)`",
     NULL},
    {TN_SLIP_RULE, "true", "what matches every plan is not needed as a rule: leave it out", NULL},
    {TN_SLIP_RULE, "is|equals|equal|same", "numbers are compared by `=`; what a tray is stands in `tray(...)`", NULL},
    {TN_SLIP_RULE, "mirror|reversed|either-way", "in either order is written `symmetric a`", "symmetric"},
    {TN_SLIP_RULE, "adjacency|adj|pair", "trays side by side are written `neighbour(a, b)`", "neighbour"},
    {TN_SLIP_RULE, "maybe|perhaps|opt", "a tray that may be left out is written `optional(a)`", "optional"},
    {TN_SLIP_RULE, "room|cell",
     "expressions are joined by `and` or `or`, clauses of a library by `,`; what a tray is stands in `tray(...)`",
     NULL},
    {TN_SLIP_RULE, "bay", "what a tray is stands in `tray(...)`", NULL},
    {TN_SLIP_TRAY, "no|non|without|except|un", "the opposite of a value is written `not`", "not"},
    {TN_SLIP_TRAY, "is|has|with|be|equals|of", "a value follows its field directly: `FIELD VALUE`", ""},
    {TN_SLIP_TRAY, "tray|neighbour|quantity|many|any",
     "in `tray(...)` stand the values of one tray; rules are joined outside: `tray(a) or tray(b)`", NULL},
    {TN_SLIP_LIBRARY, "exclude|reject|drop|remove|forbid|forbids|without|avoid|discard|never|ban",
     "plans that match a rule are left out by `prune`", "prune"},
    {TN_SLIP_LIBRARY, "include|keep|must|need|needs|want|only|ensure|assert|requires|accept",
     "plans that do not match a rule are left out by `require`", "require"},
    {TN_SLIP_LIBRARY, "prefers|preferred|should|ideally|wish|wishes|favour|favours|favor|favors",
     "what is wished, and leaves no plan out, is written `prefer a worth 2`", "prefer"},
    {TN_SLIP_LIBRARY, "likely|unlikely|probability|chance|frequency|often",
     "how likely trays are among samples is written `weight tray(a) 3`", "weight"},
    {TN_SLIP_LIBRARY, "width|length|sum",
     "how many trays a plan has is written `trays 4..9`, the sum of a field's lengths `total FIELD 10m..20m`", NULL},
    {TN_SLIP_LIBRARY, "max|min|maximum|minimum|most|least",
     "a field's lengths are bounded by `total FIELD 10m..20m`, the trays by `trays 4..9`, sums by `require sum(...) <= "
     "20m`",
     NULL},
    {TN_SLIP_LIBRARY, "storeys|stories|storey|floors|levels",
     "how many storeys a house has is asked of its options: `require option(ZONE storeys 2)` in a library of houses",
     NULL},
    {TN_SLIP_LIBRARY, "size|count|number|rooms|bays", "how many trays a plan has is written `trays 4..9`", NULL},
    {TN_SLIP_TEST, "pass|passes|accept|ok|yes|true|good|valid|hold|holds",
     "a plan that the rule matches is written `match`", "match"},
    {TN_SLIP_TEST, "fail|fails|deny|no|false|bad|invalid|not",
     "a plan that the rule does not match is written `reject`", "reject"},
    {TN_SLIP_ITEM, "def|define|function|fn|pattern|predicate", "a rule is written `rule NAME = ...`", "rule"},
    {TN_SLIP_ITEM, "const|constant|set|var|val|alias",
     "a name for a constant or for values is written `let NAME = ...`", "let"},
    {TN_SLIP_ITEM, "import|include|load|from", "another file is used by `use \"name\"`", "use"},
    {TN_SLIP_ITEM, "number|field|zone|flag", "numbers, fields and zones stand in the braces of a schema", NULL},
    {TN_SLIP_ITEM, "type|struct|tray|room|class", "the fields of a tray are written `schema NAME { ... }`", NULL},
    {TN_SLIP_RANGE, "to|until|till|through|thru", "a range is written with two dots: `2..4`", ".."},
};

static bool among(const char *words, const char *word, size_t size)
{
    while (*words) {
        size_t length = strcspn(words, "|");
        if (length == size && strncasecmp(words, word, size) == 0)
            return true;
        words += length + (words[length] == '|');
    }
    return false;
}

const tn_slip *tn_slip_find(tn_slip_place place, const char *word, size_t size)
{
    for (size_t i = 0; i < sizeof slips / sizeof *slips; i++)
        if (slips[i].place == place && among(slips[i].words, word, size))
            return &slips[i];
    return NULL;
}
