/* Lays out statements that end with `;` and stand in blocks. */
#include "compiler/common/format_statements.h"

enum { BODY = 2, CONTINUED = 6 }; /* indents */

bool tn_format_is_minus_sign(const tn_format *format, size_t i)
{
    if (!tn_format_is(format, i, "-") || i == 0)
        return false;
    tn_token_kind before = format->tokens[i - 1].kind;
    return before == TN_TOKEN_WORD || (before == TN_TOKEN_SIGN && !tn_format_is(format, i - 1, ")"));
}

/* One past the token that ends the statement: `;`, the brace that opens a block, or what is before one that closes it.
 */
static size_t statement_end(const tn_format *format, const tn_statement_format *how, size_t first)
{
    size_t i = first;
    while (i < format->count && !how->ends(format, i))
        i++;
    return i < format->count && (!tn_format_is(format, i, "}") || i == first) ? i + 1 : i;
}

static void put_statement(tn_format *format, const tn_statement_format *how, size_t first, size_t last, size_t indent)
{
    for (size_t begin = first, end; begin < last; begin = end) {
        for (end = begin + 1; end < last && !how->at_part(format, end);)
            end++;
        if (begin > first && format->layout.column + 1 + tn_format_width(format, begin, end) > TN_FORMAT_WIDTH)
            tn_layout_line(&format->layout, indent + CONTINUED);
        tn_layout_spaces(&format->layout, format->layout.fresh ? 0 : how->gap_before(format, begin));
        tn_format_flat(format, begin, end);
    }
}

void tn_format_statements(tn_format *format, const tn_statement_format *how)
{
    size_t indent = 0;
    bool opened = false, closed = false;
    format->gap_before = how->gap_before;
    for (size_t first = 0, last; first < format->count; first = last) {
        last = statement_end(format, how, first);
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
        put_statement(format, how, first, last, indent);
        opened = opens;
        closed = closes;
        indent = opens ? BODY : indent;
    }
    tn_format_gap(format, format->count, 0, false);
}
