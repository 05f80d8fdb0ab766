/* Laying out .solid files: a statement a line; one that is too long goes on where its next part begins. */
#include "compiler/common/format_tokens.h"
#include "compiler/solid/solid.h"

enum { BODY = 2, CONTINUED = 6 }; /* indents */

/* A minus that stands before what it turns round, not between two. */
static bool is_sign(const tn_format *format, size_t i)
{
    if (!tn_format_is(format, i, "-") || i == 0)
        return false;
    tn_token_kind before = format->tokens[i - 1].kind;
    return before == TN_TOKEN_WORD || (before == TN_TOKEN_SIGN && !tn_format_is(format, i - 1, ")"));
}

static bool is_ratio(const tn_format *format, size_t i)
{
    return i >= 2 && tn_format_is(format, i, "/") && tn_format_is(format, i - 2, "unit");
}

static size_t gap_before(const tn_format *format, size_t i)
{
    bool tight = tn_format_is(format, i, ")") || tn_format_is(format, i, ",") || tn_format_is(format, i, ";") ||
                 tn_format_is(format, i - 1, "(") || is_sign(format, i - 1) || tn_format_is(format, i, "..") ||
                 tn_format_is(format, i - 1, "..") || is_ratio(format, i) || is_ratio(format, i - 1) ||
                 (tn_format_is(format, i, "(") && format->tokens[i - 1].kind == TN_TOKEN_NAME);
    return tight ? 0 : 1;
}

/* Where a statement that is too long goes on in the next line. */
static bool at_part(const tn_format *format, size_t i)
{
    static const char *const words[] = {"at", "size", "from", "clip", "rigid", "target", "weight", "and", "or", NULL};
    return tn_format_is_any(format, i, words) || (i > 0 && tn_format_is(format, i - 1, ","));
}

/* One past the token that ends the statement: `;`, `{`, or what is before a `}`. */
static size_t statement_end(const tn_format *format, size_t first)
{
    static const char *const ends[] = {";", "{", "}", NULL};
    size_t i = first;
    while (i < format->count && !tn_format_is_any(format, i, ends))
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

void tn_format_solid(tn_format *format)
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
