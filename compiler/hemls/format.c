/* Laying out .hemls files: a line a line; the successors of a rule one below the other, their arrows lined up. */
#include "compiler/hemls/hemls.h"

static size_t gap_before(const tn_format *format, size_t i)
{
    bool negative = format->tokens[i].kind == TN_TOKEN_NUMBER && tn_format_is(format, i - 1, "-");
    return negative ? 0 : 1;
}

static bool is_arrow(const tn_format *format, size_t i)
{
    return tn_format_is(format, i, "->") || tn_format_is(format, i, "\xe2\x86\x92");
}

static void put_line(tn_format *format, size_t first, size_t last)
{
    tn_layout *layout = &format->layout;
    size_t arrow = 0; /* column of the first; none is at 0 */
    for (size_t i = first; i < last; i++) {
        if (is_arrow(format, i) && arrow)
            tn_layout_line(layout, arrow);
        tn_format_put(format, i, i > first ? gap_before(format, i) : 0);
        if (is_arrow(format, i) && !arrow)
            arrow = layout->column - format->tokens[i].width;
    }
}

void tn_format_hemls(tn_format *format)
{
    format->gap_before = gap_before;
    for (size_t first = 0, last; first < format->count; first = last) {
        for (last = first + 1; last < format->count && !format->tokens[last].line_ends;)
            last++;
        tn_format_gap(format, first, 0, false);
        put_line(format, first, last);
    }
    tn_format_gap(format, format->count, 0, false);
}
