/* Laying out .plan files: items, schemas, libraries and tests. What is aligned is aligned within a run: entries on
 * neighbouring lines, with no empty line or comment between them. */
#include <string.h>

#include "compiler/plan/format_clauses.h"
#include "compiler/plan/syntax/words.h"

enum {
    BODY = 2,         /* indents */
    CONTINUED = 4,    /* what goes on in the next line */
    NAME_COLUMN = 24, /* names of fields are not lined up farther to the right than this */
    DOC_GAP = 2,      /* blanks between a test case and its text */
};

static bool is_word(const tn_format *format, size_t i, uint64_t places, uint32_t uses)
{
    return tn_format_is_word(format, i, &tn_plan_words, places, uses);
}

/* Does a bracket stand directly at the word before it? */
static bool takes_bracket(const tn_format *format, size_t i)
{
    return format->tokens[i].kind == TN_TOKEN_NAME || is_word(format, i, TN_ANYWHERE, TN_AS_CALL | TN_AS_SPELLING);
}

/* Does the token stand in the brackets of a plan? */
static bool is_in_plan(const tn_format *format, size_t i)
{
    static const char *const ends[] = {"]", "(", ")", "{", "}", "=", NULL};
    while (i-- > 0)
        if (tn_format_is(format, i, "[") || tn_format_is_any(format, i, ends))
            return tn_format_is(format, i, "[");
    return false;
}

/* Is the token a minus that belongs to what follows, not one between two numbers, nor what a tray does not have? */
static bool is_sign(const tn_format *format, size_t i)
{
    if (!tn_format_is(format, i, "-") || i == 0)
        return tn_format_is(format, i, "-");
    if (is_in_plan(format, i))
        return false;
    tn_token_kind before = format->tokens[i - 1].kind;
    return before != TN_TOKEN_NAME && before != TN_TOKEN_NUMBER && before != TN_TOKEN_LENGTH &&
           !tn_format_is(format, i - 1, ")") && !is_word(format, i - 1, TN_AT(RULE), TN_AS_OPERAND);
}

/* The blanks between token i and the one before it. */
static size_t gap_before(const tn_format *format, size_t i)
{
    static const char *const tight_before[] = {")", "]", ",", "..", ":", NULL};
    static const char *const tight_after[] = {"(", "[", "..", ":", NULL};
    if (tn_format_is_any(format, i, tight_before) || tn_format_is_any(format, i - 1, tight_after) ||
        is_sign(format, i - 1))
        return 0;
    return tn_format_is(format, i, "(") && takes_bracket(format, i - 1) ? 0 : 1;
}

/* What comes behind an expression or a name: a text, or a word such as `as`. */
static bool at_part(const tn_format *format, size_t i)
{
    return format->tokens[i].kind == TN_TOKEN_STRING ||
           is_word(format, i, TN_AT(HEAD) | TN_AT(CLAUSE_END), TN_AS_HEAD | TN_AS_MARK);
}

typedef void put_run(tn_format *format, const size_t *starts, size_t count);

/* `frontage = measure front` names one. */
static bool starts_item(const tn_format *format, size_t i)
{
    return is_word(format, i, TN_AT(ITEM), TN_AS_KEYWORDS) && !(i > 0 && tn_format_is(format, i - 1, "="));
}

static bool starts_field(const tn_format *format, size_t i)
{
    bool headed = i > 0 && is_word(format, i - 1, TN_AT(SCHEMA), TN_AS_HEAD);
    return (format->tokens[i].kind == TN_TOKEN_FIELD && !headed) || is_word(format, i, TN_AT(SCHEMA), TN_AS_KEYWORDS);
}

/* `trays` counts trays in sums, too: the clause is the one before a number. */
static bool starts_clause(const tn_format *format, size_t i)
{
    return is_word(format, i, TN_AT(CLAUSE), TN_AS_KEYWORDS) &&
           (!is_word(format, i, TN_AT(RULE), TN_AS_OPERAND) || format->tokens[i + 1].kind == TN_TOKEN_NUMBER);
}

/* A line of a form; `option(` is a part of one. */
static bool starts_part(const tn_format *format, size_t i)
{
    return is_word(format, i, TN_AT(FORM), TN_AS_KEYWORDS) &&
           !(is_word(format, i, TN_AT(OPTIONS), TN_AS_CALL | TN_AS_SPELLING) && tn_format_is(format, i + 1, "("));
}

static bool starts_tile_part(const tn_format *format, size_t i)
{
    return is_word(format, i, TN_AT(TILE), TN_AS_KEYWORDS);
}

static bool at_part_break(const tn_format *format, size_t i)
{
    return tn_format_is(format, i, "=") || tn_format_is(format, i, "|") ||
           is_word(format, i, TN_AT(FUNCTION) | TN_AT(CELLS) | TN_AT(OPTIONS), TN_AS_INFIX);
}

static bool is_expectation(const tn_format *format, size_t i)
{
    return is_word(format, i, TN_AT_CASES, TN_AS_KEYWORDS);
}

/* The first of the words before a plan. */
static bool starts_case(const tn_format *format, size_t i)
{
    return is_expectation(format, i) && !(i > 0 && is_expectation(format, i - 1));
}

static size_t next_start(const tn_format *format, size_t first, size_t last, tn_format_split *starts)
{
    size_t i = first + 1;
    while (i < last && !starts(format, i))
        i++;
    return i;
}

static size_t find(const tn_format *format, size_t first, size_t last, const char *sign)
{
    while (first < last && !tn_format_is(format, first, sign))
        first++;
    return first;
}

static bool at_comma(const tn_format *format, size_t i)
{
    return tn_format_is(format, i, ",");
}

static bool at_bar(const tn_format *format, size_t i)
{
    return tn_format_is(format, i, "|");
}

/* ---- fields of a schema */

/* The name's column and width: `zone wall` is five columns in. */
static size_t field_name(const tn_format *format, size_t first)
{
    return is_word(format, first, TN_AT(SCHEMA), TN_AS_HEAD) ? first + 1 : first;
}

static void put_limit(tn_format *format, size_t first, size_t last)
{
    tn_format_put(format, first, 0);
    tn_layout_spaces(&format->layout, 1);
    tn_format_expression(format, first + 1, last, 0);
}

static void put_field(tn_format *format, size_t first, size_t last, size_t name_width)
{
    size_t name = field_name(format, first), equal = find(format, first, last, "=");
    tn_format_flat(format, first, name + 1);
    if (format->tokens[name].width < name_width)
        tn_layout_spaces(&format->layout, name_width - format->tokens[name].width);
    tn_layout_spaces(&format->layout, 1);
    if (format->layout.column + tn_format_width(format, name + 1, last) <= TN_FORMAT_WIDTH) {
        tn_format_flat(format, name + 1, last);
        return;
    }
    tn_format_fill(format, name + 1, equal + 1, at_part, false, BODY + CONTINUED, 0);
    if (equal > name + 1)
        tn_layout_line(&format->layout, BODY + CONTINUED);
    else
        tn_layout_spaces(&format->layout, 1);
    tn_format_fill(format, equal + 1, last, at_bar, false, BODY + CONTINUED, 0);
}

static void put_fields(tn_format *format, const size_t *starts, size_t count)
{
    size_t widest[2] = {0, 0}; /* among fields, among zones */
    for (size_t i = 0; i < count; i++) {
        size_t name = field_name(format, starts[i]), width = format->tokens[name].width;
        if (format->tokens[name].kind == TN_TOKEN_FIELD && width <= NAME_COLUMN && width > widest[name > starts[i]])
            widest[name > starts[i]] = width;
    }
    for (size_t i = 0; i < count; i++) {
        tn_layout_line(&format->layout, BODY);
        if (tn_format_is(format, starts[i], "forbid") || tn_format_is(format, starts[i], "only"))
            put_limit(format, starts[i], starts[i + 1]);
        else
            put_field(format, starts[i], starts[i + 1], widest[field_name(format, starts[i]) > starts[i]]);
    }
}

/* ---- clauses of a library */

static void put_clauses(tn_format *format, const size_t *starts, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        tn_layout_line(&format->layout, BODY);
        tn_format_put(format, starts[i], 0);
        tn_layout_spaces(&format->layout, 1);
        tn_format_fill(format, starts[i] + 1, starts[i + 1], at_comma, true, BODY + CONTINUED, 0);
    }
}

/* ---- lines of a form */

static bool starts_line(const tn_format *format, size_t i)
{
    return tn_format_is(format, i, "line");
}

/* A line of a tile; those of an item's symbol, in braces, stand on lines of their own. */
static void put_tile_part(tn_format *format, size_t first, size_t last)
{
    size_t open = find(format, first, last, "{"), close = last - 1;
    if (open == last) {
        tn_format_fill(format, first, last, at_comma, true, 2 * BODY + CONTINUED, 0);
        return;
    }
    tn_format_fill(format, first, open + 1, at_comma, true, 2 * BODY + CONTINUED, 0);
    for (size_t i = open + 1, next; i < close; i = next) {
        next = next_start(format, i, close, starts_line);
        format->tokens[i].blank &= i > open + 1; /* none after the opening brace */
        tn_format_gap(format, i, 3 * BODY, false);
        tn_layout_line(&format->layout, 3 * BODY);
        tn_format_fill(format, i, next, at_comma, true, 3 * BODY + CONTINUED, 0);
    }
    format->tokens[close].blank = false;
    tn_format_gap(format, close, 3 * BODY, false);
    tn_layout_line(&format->layout, 2 * BODY);
    tn_format_put(format, close, 0);
}

static void put_tile(tn_format *format, size_t first, size_t last)
{
    size_t open = find(format, first, last, "{"), close = last - 1;
    tn_format_fill(format, first, open + 1, at_part, false, BODY + CONTINUED, 0);
    for (size_t i = open + 1, next; i < close; i = next) {
        next = next_start(format, i, close, starts_tile_part);
        format->tokens[i].blank &= i > open + 1; /* none after the opening brace */
        tn_format_gap(format, i, 2 * BODY, false);
        tn_layout_line(&format->layout, 2 * BODY);
        put_tile_part(format, i, next);
    }
    format->tokens[close].blank = false;
    tn_format_gap(format, close, 2 * BODY, false);
    tn_layout_line(&format->layout, BODY);
    tn_format_put(format, close, 0);
}

/* A line that says how thick something is, with layers in braces: on one line if there is room, or a line each. */
static void put_layers(tn_format *format, size_t first, size_t last)
{
    size_t open = find(format, first, last, "{"), close = last - 1, comments = format->tokens[first].comment_count;
    format->tokens[first].comment_count = 0; /* those before the line do not count */
    bool fits = BODY + tn_format_width(format, first, last) <= TN_FORMAT_WIDTH;
    format->tokens[first].comment_count = comments;
    if (fits) {
        tn_format_flat(format, first, last);
        return;
    }
    tn_format_flat(format, first, open + 1);
    for (size_t i = open + 1, next; i < close; i = next) {
        next = find(format, i, close, ",");
        next += next < close;
        format->tokens[i].blank = false;
        tn_format_gap(format, i, 2 * BODY, false);
        tn_layout_line(&format->layout, 2 * BODY);
        tn_format_flat(format, i, next);
    }
    format->tokens[close].blank = false;
    tn_format_gap(format, close, 2 * BODY, false);
    tn_layout_line(&format->layout, BODY);
    tn_format_put(format, close, 0);
}

static void put_parts(tn_format *format, const size_t *starts, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        tn_layout_line(&format->layout, BODY);
        if (tn_format_is(format, starts[i], "tile"))
            put_tile(format, starts[i], starts[i + 1]);
        else if (find(format, starts[i], starts[i + 1], "{") < starts[i + 1])
            put_layers(format, starts[i], starts[i + 1]);
        else if (tn_format_is(format, starts[i], "classification"))
            tn_format_fill(format, starts[i], starts[i + 1], at_comma, true, BODY + CONTINUED, 0);
        else
            tn_format_fill(format, starts[i], starts[i + 1], at_part_break, false, BODY + CONTINUED, 0);
    }
}

/* ---- cases of a test */

/* Where the text starts that ends a case; `last` where none does. */
static size_t case_doc(const tn_format *format, size_t first, size_t last)
{
    return last > first + 1 && format->tokens[last - 1].kind == TN_TOKEN_STRING ? last - 1 : last;
}

static size_t longest_word(const tn_format *format, const size_t *starts, size_t count)
{
    size_t longest = 0;
    for (size_t i = 0; i < count; i++)
        longest = format->tokens[starts[i]].width > longest ? format->tokens[starts[i]].width : longest;
    return longest;
}

/* The column at which the texts of a run of cases stand: after the longest case that leaves room for its own. */
static size_t doc_column(const tn_format *format, const size_t *starts, size_t count, size_t plan_column)
{
    size_t column = 0;
    for (size_t i = 0; i < count; i++) {
        size_t doc = case_doc(format, starts[i], starts[i + 1]);
        size_t end = plan_column + tn_format_width(format, starts[i] + 1, doc) + DOC_GAP;
        size_t width = tn_format_width(format, doc, starts[i + 1]);
        if (doc < starts[i + 1] && end + width <= TN_FORMAT_WIDTH && end > column)
            column = end;
    }
    return column;
}

static void put_case(tn_format *format, size_t first, size_t last, size_t plan_column, size_t column)
{
    tn_layout *layout = &format->layout;
    size_t doc = case_doc(format, first, last), width = tn_format_width(format, doc, last);
    tn_layout_line(layout, BODY);
    tn_format_put(format, first, 0);
    tn_layout_spaces(layout, plan_column - layout->column);
    size_t line = layout->line;
    tn_format_expression(format, first + 1, doc, 0);
    if (doc == last)
        return;
    if (layout->line > line)
        tn_layout_line(layout, plan_column);
    else if (layout->column + DOC_GAP <= column && column + width <= TN_FORMAT_WIDTH)
        tn_layout_spaces(layout, column - layout->column);
    else if (layout->column + DOC_GAP + width <= TN_FORMAT_WIDTH)
        tn_layout_spaces(layout, DOC_GAP);
    else
        tn_layout_line(layout, plan_column);
    tn_format_put(format, doc, 0);
}

static void put_cases(tn_format *format, const size_t *starts, size_t count)
{
    size_t plan_column = BODY + longest_word(format, starts, count) + 1;
    size_t column = doc_column(format, starts, count, plan_column);
    for (size_t i = 0; i < count; i++)
        put_case(format, starts[i], starts[i + 1], plan_column, column);
}

/* ---- items */

/* What is between the braces, run by run. */
static void put_body(tn_format *format, size_t open, size_t close, tn_format_split *begins, put_run *put)
{
    size_t *starts = TN_NEW_ARRAY(format->layout.arena, size_t, close - open + 1);
    if (!starts)
        return;
    for (size_t i = open + 1; i < close;) {
        size_t count = 0;
        do {
            starts[count++] = i;
            i = next_start(format, i, close, begins);
        } while (i < close && !format->tokens[i].blank && !format->tokens[i].comment_count);
        starts[count] = i;
        if (starts[0] == open + 1)
            format->tokens[starts[0]].blank = false; /* none after the opening brace */
        tn_format_gap(format, starts[0], BODY, false);
        put(format, starts, count);
    }
    if (format->tokens[close].comment_count) {
        format->tokens[close].blank = false;
        tn_format_gap(format, close, BODY, false);
    }
}

static void put_block(tn_format *format, size_t first, size_t last, tn_format_split *begins, put_run *put)
{
    size_t open = find(format, first, last, "{"), close = last - 1;
    tn_format_fill(format, first, open + 1, at_part, false, CONTINUED, 0);
    bool empty = close == open + 1 && !format->tokens[close].comment_count && !format->tokens[open].remark.text;
    if (empty) {
        tn_format_put(format, close, 0);
        return;
    }
    put_body(format, open, close, begins, put);
    tn_layout_line(&format->layout, 0);
    tn_format_put(format, close, 0);
}

/* A rule without a text stands on one line where it fits. */
static bool is_short_rule(const tn_format *format, size_t first, size_t last)
{
    size_t equal = find(format, first, last, "=");
    for (size_t i = first; i < equal; i++)
        if (format->tokens[i].kind == TN_TOKEN_STRING)
            return false;
    size_t comments = format->tokens[first].comment_count;
    format->tokens[first].comment_count = 0; /* those before the rule do not count */
    bool fits = tn_format_width(format, first, last) <= TN_FORMAT_WIDTH;
    format->tokens[first].comment_count = comments;
    return fits;
}

static void put_rule(tn_format *format, size_t first, size_t last)
{
    size_t equal = find(format, first, last, "=");
    tn_format_fill(format, first, equal + 1, at_part, false, CONTINUED, 0);
    tn_layout_line(&format->layout, BODY);
    tn_format_expression(format, equal + 1, last, 0);
}

static void put_item(tn_format *format, size_t first, size_t last, bool one_line)
{
    if (one_line)
        tn_format_flat(format, first, last);
    else if (tn_format_is(format, first, "schema"))
        put_block(format, first, last, starts_field, put_fields);
    else if (tn_format_is(format, first, "library"))
        put_block(format, first, last, starts_clause, put_clauses);
    else if (tn_format_is(format, first, "form"))
        put_block(format, first, last, starts_part, put_parts);
    else if (tn_format_is(format, first, "test"))
        put_block(format, first, last, starts_case, put_cases);
    else if (tn_format_is(format, first, "rule") || tn_format_is(format, first, "measure") ||
             tn_format_is(format, first, "param"))
        put_rule(format, first, last);
    else
        tn_format_expression(format, first, last, 0);
}

void tn_format_plan(tn_format *format)
{
    bool tall = false; /* the item before takes several lines */
    format->gap_before = gap_before;
    format->at_part = at_part;
    for (size_t first = 0, last; first < format->count; first = last) {
        last = next_start(format, first, format->count, starts_item);
        bool one_line = tn_format_is(format, first, "use") ||
                        ((tn_format_is(format, first, "rule") || tn_format_is(format, first, "measure") ||
                          tn_format_is(format, first, "let") || tn_format_is(format, first, "param")) &&
                         is_short_rule(format, first, last));
        tn_format_gap(format, first, 0, first > 0 && (tall || !one_line));
        put_item(format, first, last, one_line);
        tall = !one_line;
    }
    tn_format_gap(format, format->count, 0, false);
}
