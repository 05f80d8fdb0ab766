/* Laying out .solid files: a statement a line; one that is too long goes on where its next part begins. */
#include "compiler/common/format_statements.h"
#include "compiler/solid/solid.h"

static bool is_ratio(const tn_format *format, size_t i)
{
    return i >= 2 && tn_format_is(format, i, "/") && tn_format_is(format, i - 2, "unit");
}

static size_t gap_before(const tn_format *format, size_t i)
{
    bool tight = tn_format_is(format, i, ")") || tn_format_is(format, i, ",") || tn_format_is(format, i, ";") ||
                 tn_format_is(format, i - 1, "(") || tn_format_is_minus_sign(format, i - 1) ||
                 tn_format_is(format, i, "..") || tn_format_is(format, i - 1, "..") || is_ratio(format, i) ||
                 is_ratio(format, i - 1) ||
                 (tn_format_is(format, i, "(") && format->tokens[i - 1].kind == TN_TOKEN_NAME);
    return tight ? 0 : 1;
}

/* Where a statement that is too long goes on in the next line. */
static bool at_part(const tn_format *format, size_t i)
{
    static const char *const words[] = {"at", "size", "from", "clip", "rigid", "target", "weight", "and", "or", NULL};
    return tn_format_is_any(format, i, words) || (i > 0 && tn_format_is(format, i - 1, ","));
}

static bool ends_statement(const tn_format *format, size_t i)
{
    static const char *const ends[] = {";", "{", "}", NULL};
    return tn_format_is_any(format, i, ends);
}

void tn_format_solid(tn_format *format)
{
    tn_format_statements(format, &(tn_statement_format){gap_before, at_part, ends_statement});
}
