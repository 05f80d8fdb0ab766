/* Laying out .kit files: a statement a line; one that is too long goes on where its next part begins. */
#include "compiler/common/format_tokens.h"
#include "compiler/kit/kit.h"

enum { BODY = 2, CONTINUED = 6 }; /* indents */

/* A minus that stands before what it turns round, not between two. */
static bool is_sign(const tn_format *format, size_t i)
{
    if (!tn_format_is(format, i, "-") || i == 0)
        return false;
    tn_token_kind before = format->tokens[i - 1].kind;
    return before == TN_TOKEN_WORD || (before == TN_TOKEN_SIGN && !tn_format_is(format, i - 1, ")"));
}

/* box( and count(. */
static bool is_call(const tn_format *format, size_t i)
{
    return tn_format_is(format, i, "(") &&
           (format->tokens[i - 1].kind == TN_TOKEN_NAME || tn_format_is(format, i - 1, "count"));
}

/* Does the brace at i, or the one that ends there, hold statements and not parts? */
static bool is_block(const tn_format *format, size_t i)
{
    size_t open = tn_format_is(format, i, "}") ? format->tokens[i].match : i;
    while (open > 0 && !tn_format_is(format, open - 1, ";") && !tn_format_is(format, open - 1, "}"))
        open--;
    return tn_format_is(format, open, "part") || tn_format_is(format, open, "model") ||
           tn_format_is(format, open, "test");
}

/* Behind the brace that opens a list of parts, or before the one that closes it. */
static bool is_brace(const tn_format *format, size_t i)
{
    return (tn_format_is(format, i, "}") && !is_block(format, i)) ||
           (tn_format_is(format, i - 1, "{") && !is_block(format, i - 1));
}

static size_t gap_before(const tn_format *format, size_t i)
{
    bool tight = tn_format_is(format, i, ")") || tn_format_is(format, i, ",") || tn_format_is(format, i, ";") ||
                 tn_format_is(format, i - 1, "(") || is_sign(format, i - 1) || tn_format_is(format, i, "..") ||
                 tn_format_is(format, i - 1, "..") || is_call(format, i) || is_brace(format, i) ||
                 (tn_format_is(format, i, "]") || tn_format_is(format, i - 1, "["));
    return tight ? 0 : 1;
}

/* Is token i inside of brackets that begin in its statement? */
static bool is_inside(const tn_format *format, size_t i)
{
    int depth = 0;
    while (i > 0 && !tn_format_is(format, i - 1, ";") && depth <= 0) {
        i--;
        bool block = tn_format_is(format, i, "{") && is_block(format, i);
        depth += !block && (tn_format_is(format, i, "(") || tn_format_is(format, i, "{"));
        depth -= tn_format_is(format, i, ")") || tn_format_is(format, i, "}");
        if (block)
            return false;
    }
    return depth > 0;
}

/* Where a statement that is too long goes on in the next line. */
static bool at_part(const tn_format *format, size_t i)
{
    static const char *const words[] = {"|", "and", "or", "by", NULL};
    bool part = tn_format_is_any(format, i, words) || (i > 0 && tn_format_is(format, i - 1, ","));
    return part && !is_inside(format, i);
}

static bool ends_statement(const tn_format *format, size_t i)
{
    return tn_format_is(format, i, ";") ||
           ((tn_format_is(format, i, "{") || tn_format_is(format, i, "}")) && is_block(format, i));
}

/* One past the token that ends the statement: `;`, the brace that opens a block, or what is before one that closes it.
 */
static size_t statement_end(const tn_format *format, size_t first)
{
    size_t i = first;
    while (i < format->count && !ends_statement(format, i))
        i++;
    return i < format->count && (!tn_format_is(format, i, "}") || i == first) ? i + 1 : i;
}

static void put_statement(tn_format *format, size_t first, size_t last, size_t indent)
{
    for (size_t begin = first, end; begin < last; begin = end) {
        for (end = begin + 1; end < last && !at_part(format, end);)
            end++;
        if (begin > first && format->layout.column + 1 + tn_format_width(format, begin, end) > TN_FORMAT_WIDTH)
            tn_layout_line(&format->layout, indent + CONTINUED);
        tn_layout_spaces(&format->layout, format->layout.fresh ? 0 : gap_before(format, begin));
        tn_format_flat(format, begin, end);
    }
}

void tn_format_kit(tn_format *format)
{
    size_t indent = 0;
    bool opened = false, closed = false;
    format->gap_before = gap_before;
    for (size_t first = 0, last; first < format->count; first = last) {
        last = statement_end(format, first);
        bool closes = tn_format_is(format, first, "}"), opens = tn_format_is(format, last - 1, "{");
        if (opened || closes)
            format->tokens[first].blank = false; /* none inside the braces */
        tn_format_gap(format, first,
                      closes && format->tokens[first].comment_count ? BODY
                      : closes                                      ? 0
                                                                    : indent,
                      first > 0 && !closes && (closed || (opens && indent == 0)));
        indent = closes ? 0 : indent;
        tn_layout_line(&format->layout, indent);
        put_statement(format, first, last, indent);
        opened = opens;
        closed = closes;
        indent = opens ? BODY : indent;
    }
    tn_format_gap(format, format->count, 0, false);
}
