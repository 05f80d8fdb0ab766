/* Laying out .kit files: a statement a line; one that is too long goes on where its next part begins. */
#include "compiler/common/format_statements.h"
#include "compiler/kit/kit.h"

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
                 tn_format_is(format, i - 1, "(") || tn_format_is_minus_sign(format, i - 1) ||
                 tn_format_is(format, i, "..") || tn_format_is(format, i - 1, "..") || is_call(format, i) ||
                 is_brace(format, i) || (tn_format_is(format, i, "]") || tn_format_is(format, i - 1, "["));
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

void tn_format_kit(tn_format *format)
{
    tn_format_statements(format, &(tn_statement_format){gap_before, at_part, ends_statement});
}
