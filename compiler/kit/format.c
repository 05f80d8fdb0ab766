/* Laying out .kit files: a statement a line; one that is too long goes on where its next part begins. */
#include "compiler/common/format_statements.h"
#include "compiler/kit/kit.h"

/* box( and count(. */
static bool is_call(const tn_format *format, size_t i)
{
    return tn_format_is(format, i, "(") && (format->tokens[i - 1].kind == TN_TOKEN_NAME ||
                                            tn_format_is_word(format, i - 1, &tn_kit_words, TN_ANYWHERE, TN_AS_CALL));
}

/* Does the brace at i, or the one that ends there, hold statements and not parts? */
static bool is_block(const tn_format *format, size_t i)
{
    size_t open = tn_format_is(format, i, "}") ? format->tokens[i].match : i;
    while (open > 0 && !tn_format_is(format, open - 1, ";") && !tn_format_is(format, open - 1, "}"))
        open--;
    return tn_vocabulary_head_block(&tn_kit_words, format->tokens[open].text, format->tokens[open].size);
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

/* The bracket that begins in the statement of token i and holds it, or i where there is none. */
static size_t bracket_around(const tn_format *format, size_t i)
{
    int depth = 0;
    for (size_t k = i; k > 0 && !tn_format_is(format, k - 1, ";"); k--) {
        bool opens = tn_format_is(format, k - 1, "(") || tn_format_is(format, k - 1, "{");
        if (tn_format_is(format, k - 1, "{") && is_block(format, k - 1))
            return i;
        depth += opens;
        depth -= tn_format_is(format, k - 1, ")") || tn_format_is(format, k - 1, "}");
        if (depth > 0)
            return k - 1;
    }
    return i;
}

/* Where a statement that is too long goes on in the next line. */
static bool at_part(const tn_format *format, size_t i)
{
    bool behind_comma = i > 0 && tn_format_is(format, i - 1, ",");
    size_t around = bracket_around(format, i);
    if (around != i)
        return behind_comma && tn_format_is(format, around, "{"); /* a list of parts */
    return behind_comma || tn_format_is(format, i, "|") || tn_format_is(format, i, "by") ||
           tn_format_is_word(format, i, &tn_kit_words, TN_KIT_AT(SPACE), TN_AS_INFIX);
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
