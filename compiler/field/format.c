/* Laying out .field files: a statement a line; a long expression goes on in the next lines, indented. */
#include "compiler/field/field.h"

enum { CONTINUED = 4 /* indent of what goes on in the next line */ };

static bool starts_statement(const tn_format *format, size_t i)
{
    const tn_format_token *token = &format->tokens[i];
    return token->kind == TN_TOKEN_WORD && tn_field_heads(token->text, token->size);
}

/* A minus that stands before what it turns round, not between two. */
static bool is_sign(const tn_format *format, size_t i)
{
    static const char *const before[] = {"(", ",", "=", "+", "-", "*", "/", "%", NULL};
    return tn_format_is(format, i, "-") && (i == 0 || tn_format_is_any(format, i - 1, before));
}

/* Products are written close, so that sums stand out. */
static size_t gap_before(const tn_format *format, size_t i)
{
    static const char *const close[] = {")", ",", "..", "*", "/", NULL}, *const open[] = {"(", "..", "*", "/", NULL};
    bool call = tn_format_is(format, i, "(") && format->tokens[i - 1].kind == TN_TOKEN_NAME;
    bool tight = tn_format_is_any(format, i, close) || tn_format_is_any(format, i - 1, open) || is_sign(format, i - 1);
    return call || tight ? 0 : 1;
}

static bool is_sum(const tn_format *format, size_t i)
{
    return tn_format_is(format, i, "+") || (tn_format_is(format, i, "-") && !is_sign(format, i));
}

/* Where the next part of an expression begins: at sums and differences outside of parentheses, or (`inner`) at any and
 * before an argument that is no number. */
static size_t part_end(const tn_format *format, size_t i, size_t last, bool inner)
{
    int depth = 0;
    for (depth += tn_format_is(format, i, "(") - tn_format_is(format, i, ")"), i++; i < last; i++) {
        if (is_sum(format, i) && (inner || depth == 0))
            return i;
        if (inner && tn_format_is(format, i - 1, ",") && format->tokens[i].kind != TN_TOKEN_NUMBER)
            return i;
        depth += tn_format_is(format, i, "(") - tn_format_is(format, i, ")");
    }
    return last;
}

/* Puts tokens [first, last) in as few lines as they take. */
static void put_parts(tn_format *format, size_t first, size_t last, bool inner)
{
    for (size_t begin = first, end; begin < last; begin = end) {
        end = part_end(format, begin, last, inner);
        size_t gap = format->layout.fresh ? 0 : gap_before(format, begin), width = tn_format_width(format, begin, end);
        if (!format->layout.fresh && format->layout.column + gap + width > TN_FORMAT_WIDTH) {
            tn_layout_line(&format->layout, CONTINUED);
            gap = 0;
        }
        if (!inner && CONTINUED + width > TN_FORMAT_WIDTH) {
            put_parts(format, begin, end, true);
            continue;
        }
        tn_layout_spaces(&format->layout, gap);
        tn_format_flat(format, begin, end);
    }
}

/* On one line where it fits; else what is behind `=` goes on in lines of its own. */
static void put_statement(tn_format *format, size_t first, size_t last)
{
    tn_layout_line(&format->layout, 0);
    if (tn_format_width(format, first, last) <= TN_FORMAT_WIDTH) {
        tn_format_flat(format, first, last);
        return;
    }
    size_t body = first;
    while (body < last && !tn_format_is(format, body, "="))
        body++;
    body = body < last ? body + 1 : first;
    if (body > first) {
        tn_format_flat(format, first, body);
        tn_layout_line(&format->layout, CONTINUED);
    }
    format->layout.indent = body > first ? CONTINUED : 0;
    put_parts(format, body, last, false);
}

void tn_format_field(tn_format *format)
{
    format->gap_before = gap_before;
    for (size_t first = 0, last; first < format->count; first = last) {
        for (last = first + 1; last < format->count && !starts_statement(format, last);)
            last++;
        tn_format_gap(format, first, 0, false);
        put_statement(format, first, last);
    }
    tn_format_gap(format, format->count, 0, false);
}
