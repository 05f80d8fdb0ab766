/* Lays out tokens in the ways that several notations share. */
#include "compiler/common/format_tokens.h"

#include <string.h>
#include <strings.h>

enum {
    HANGING_COLUMN = 56, /* brackets that open farther to the right are laid out from a new line on */
    HANGING_INDENT = 2,
};

bool tn_format_is(const tn_format *format, size_t i, const char *text)
{
    const tn_format_token *token = &format->tokens[i];
    return (token->kind == TN_TOKEN_WORD || token->kind == TN_TOKEN_SIGN) && strlen(text) == token->size &&
           strncasecmp(token->text, text, token->size) == 0;
}

bool tn_format_is_any(const tn_format *format, size_t i, const char *const *texts)
{
    for (; *texts; texts++)
        if (tn_format_is(format, i, *texts))
            return true;
    return false;
}

bool tn_format_is_word(const tn_format *format, size_t i, const tn_vocabulary *words, uint64_t places, uint32_t uses)
{
    const tn_format_token *token = &format->tokens[i];
    return token->kind == TN_TOKEN_WORD &&
           tn_vocabulary_find(words, token->text, token->size, places, uses & TN_AS_KEYWORDS) != NULL;
}

static bool opens(const tn_format *format, size_t i)
{
    return tn_format_is(format, i, "(") || tn_format_is(format, i, "[");
}

size_t tn_format_width(const tn_format *format, size_t first, size_t last)
{
    size_t width = 0;
    for (size_t i = first; i < last; i++) {
        const tn_format_token *token = &format->tokens[i];
        if (width > TN_FORMAT_WIDTH || token->comment_count || (token->remark.text && i + 1 < last) ||
            (token->breaks && i > first))
            return TN_FORMAT_TOO_WIDE;
        width += token->width + (i > first ? format->gap_before(format, i) : 0);
    }
    return width;
}

static bool fits(const tn_format *format, size_t first, size_t last, size_t gap, size_t tail)
{
    return format->layout.column + gap + tn_format_width(format, first, last) + tail <= TN_FORMAT_WIDTH;
}

/* The lines of a house line stand below one another. */
static void put_lines(tn_layout *layout, const char *text, size_t size)
{
    size_t column = layout->column;
    for (const char *end; (end = memchr(text, '\n', size)); size -= (size_t)(end + 1 - text), text = end + 1) {
        tn_layout_put(layout, text, (size_t)(end - text));
        tn_layout_line(layout, column);
    }
    tn_layout_put(layout, text, size);
}

void tn_format_put(tn_format *format, size_t i, size_t gap)
{
    tn_layout *layout = &format->layout;
    tn_format_token *token = &format->tokens[i];
    if (layout->remarked || token->comment_count || token->breaks)
        tn_layout_line(layout, layout->indent);
    if (token->breaks > 1)
        tn_layout_feed(layout, token->breaks - 1);
    for (size_t k = 0; k < token->comment_count; k++) {
        tn_layout_put(layout, token->comments[k].text, token->comments[k].size);
        tn_layout_line(layout, layout->indent);
    }
    if (!layout->fresh)
        tn_layout_spaces(layout, gap);
    token->line = layout->line;
    put_lines(layout, token->text, token->size);
    if (token->remark.text)
        tn_layout_remark(layout, token->remark.text, token->remark.size);
}

void tn_format_flat(tn_format *format, size_t first, size_t last)
{
    for (size_t i = first; i < last; i++)
        tn_format_put(format, i, i > first ? format->gap_before(format, i) : 0);
}

/* ---- splitting */

static bool at_or(const tn_format *format, size_t i)
{
    return tn_format_is(format, i, "or");
}

static bool at_and(const tn_format *format, size_t i)
{
    return tn_format_is(format, i, "and");
}

/* A plus or a minus between two numbers: a sign has no blank after it. */
static bool at_term(const tn_format *format, size_t i)
{
    bool minus = tn_format_is(format, i, "-") && i + 1 < format->count && format->gap_before(format, i + 1) > 0;
    return tn_format_is(format, i, "+") || minus;
}

static bool at_comma(const tn_format *format, size_t i)
{
    return tn_format_is(format, i, ",");
}

static bool at_bar(const tn_format *format, size_t i)
{
    return tn_format_is(format, i, "|");
}

/* The token after i on the same level of brackets. */
static size_t over(const tn_format *format, size_t i)
{
    return opens(format, i) ? format->tokens[i].match + 1 : i + 1;
}

/* Is there a place to split, after the first token? */
static bool can_split(const tn_format *format, size_t first, size_t last, tn_format_split *splits)
{
    for (size_t i = over(format, first); i < last; i = over(format, i))
        if (splits(format, i))
            return true;
    return false;
}

/* The end of the part that starts at `first`. */
static size_t part_end(const tn_format *format, size_t first, size_t last, tn_format_split *splits, bool after)
{
    size_t i = over(format, first);
    if (after && splits(format, first))
        return first + 1;
    for (; i < last; i = over(format, i))
        if (splits(format, i))
            return after ? i + 1 : i;
    return last;
}

/* A part that starts with the operator that it was split at. */
static void put_part(tn_format *format, size_t first, size_t last, bool leads, size_t tail)
{
    if (leads && last > first + 1 && !opens(format, first)) {
        tn_format_put(format, first, 0);
        tn_layout_spaces(&format->layout, 1);
        first++;
    }
    tn_format_expression(format, first, last, tail);
}

/* Without the comma that ends it, which must stay on the line of what is before it. */
static void put_with_comma(tn_format *format, size_t first, size_t last, size_t tail)
{
    bool comma = last > first + 1 && at_comma(format, last - 1);
    tn_format_expression(format, first, comma ? last - 1 : last, comma ? tail + 1 : tail);
    if (comma)
        tn_format_put(format, last - 1, 0);
}

void tn_format_fill(tn_format *format, size_t first, size_t last, tn_format_split *splits, bool after, size_t indent,
                    size_t tail)
{
    tn_layout *layout = &format->layout;
    bool tall = false; /* the part before takes several lines */
    for (size_t begin = first, end; begin < last; begin = end) {
        end = part_end(format, begin, last, splits, after);
        size_t rest = end == last ? tail : 0;
        size_t gap = begin > first ? format->gap_before(format, begin) : 0;
        if (begin > first && (tall || layout->remarked || !fits(format, begin, end, gap, rest)))
            tn_layout_line(layout, indent);
        else
            tn_layout_spaces(layout, layout->fresh ? 0 : gap);
        size_t line = layout->line;
        if (after)
            put_with_comma(format, begin, end, rest);
        else
            put_part(format, begin, end, begin > first, rest);
        tall = layout->line > line;
    }
}

/* ---- brackets */

/* One part a line. `from`, `to` and `by` of a distance are as wide as one another. */
static void put_list(tn_format *format, size_t first, size_t last, size_t indent, size_t tail)
{
    static const char *const short_words[] = {"to", "by", NULL};
    for (size_t begin = first, end; begin < last; begin = end) {
        end = part_end(format, begin, last, at_comma, true);
        if (begin > first)
            tn_layout_line(&format->layout, indent);
        if (begin > first && tn_format_is(format, first, "from") && tn_format_is_any(format, begin, short_words)) {
            tn_format_put(format, begin, 0);
            tn_layout_spaces(&format->layout, 3);
            begin++;
        }
        put_with_comma(format, begin, end, end == last ? tail : 0);
    }
}

/* Brackets that do not fit on the line. */
static void put_brackets(tn_format *format, size_t open, size_t tail)
{
    tn_layout *layout = &format->layout;
    size_t close = format->tokens[open].match;
    size_t indent = layout->indent + HANGING_INDENT;
    bool literal = tn_format_is(format, open, "[");
    tn_format_put(format, open, 0);
    if (layout->column <= HANGING_COLUMN)
        indent = layout->column;
    else if (!literal)
        tn_layout_line(layout, indent);
    if (literal)
        tn_format_fill(format, open + 1, close, at_bar, false, layout->column - 1, tail + 1);
    else if (open > 0 && (tn_format_is(format, open - 1, "tray") || format->tokens[open - 1].kind == TN_TOKEN_NAME))
        tn_format_fill(format, open + 1, close, at_comma, true, indent, tail + 1);
    else if (can_split(format, open + 1, close, at_comma))
        put_list(format, open + 1, close, indent, tail + 1);
    else if (close > open + 1)
        tn_format_expression(format, open + 1, close, tail + 1);
    tn_format_put(format, close, 0);
}

/* Tokens without an operator between them: the brackets among them are what can be broken. */
static void put_sequence(tn_format *format, size_t first, size_t last, size_t tail)
{
    for (size_t i = first; i < last; i++) {
        size_t gap = i > first ? format->gap_before(format, i) : 0;
        if (!opens(format, i)) {
            tn_format_put(format, i, gap);
            continue;
        }
        size_t end = format->tokens[i].match + 1;
        size_t rest = end == last ? tail : 0;
        if (fits(format, i, end, gap, rest)) {
            tn_layout_spaces(&format->layout, format->layout.fresh ? 0 : gap);
            tn_format_flat(format, i, end);
        } else {
            tn_layout_spaces(&format->layout, format->layout.fresh ? 0 : gap);
            put_brackets(format, i, rest);
        }
        i = end - 1;
    }
}

void tn_format_expression(tn_format *format, size_t first, size_t last, size_t tail)
{
    size_t column = format->layout.column;
    if (first == last)
        return;
    if (fits(format, first, last, 0, tail))
        tn_format_flat(format, first, last);
    else if (can_split(format, first, last, format->at_part))
        tn_format_fill(format, first, last, format->at_part, false, column + HANGING_INDENT, tail);
    else if (can_split(format, first, last, at_or))
        tn_format_fill(format, first, last, at_or, false, column, tail);
    else if (can_split(format, first, last, at_and))
        tn_format_fill(format, first, last, at_and, false, column, tail);
    else if (can_split(format, first, last, at_term))
        tn_format_fill(format, first, last, at_term, false, column, tail);
    else
        put_sequence(format, first, last, tail);
}

void tn_format_gap(tn_format *format, size_t i, size_t indent, bool blank)
{
    tn_layout *layout = &format->layout;
    tn_format_token *token = &format->tokens[i];
    for (size_t k = 0; k < token->comment_count; k++)
        blank &= !token->comments[k].blank;
    tn_layout_line(layout, indent);
    if (blank && token->comment_count && !token->blank)
        tn_layout_blank(layout);
    for (size_t k = 0; k < token->comment_count; k++) {
        if (token->comments[k].blank)
            tn_layout_blank(layout);
        tn_layout_line(layout, indent);
        tn_layout_put(layout, token->comments[k].text, token->comments[k].size);
        tn_layout_line(layout, indent);
    }
    if (token->blank || (blank && !token->comment_count))
        tn_layout_blank(layout);
    tn_layout_line(layout, indent);
    token->comment_count = 0; /* they are there now */
}
