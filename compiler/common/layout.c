/* Lays out tokens in the ways that several notations share: as lines of a given width, with their comments. */
#include "compiler/common/layout.h"

#include <string.h>
#include <strings.h>

/* ==== writes tokens as lines of a given width, with their comments */

enum {
    REMARK_GAP = 2,     /* blanks before a comment at a line's end */
    REMARK_COLUMN = 80, /* comments are not lined up farther to the right than this */
};

/* Characters in a UTF-8 text. */
static size_t text_width(const char *text, size_t size)
{
    size_t width = 0;
    for (size_t i = 0; i < size; i++)
        width += ((unsigned char)text[i] & 0xC0) != 0x80;
    return width;
}

void tn_layout_start(tn_layout *layout, tn_arena *arena)
{
    *layout = (tn_layout){.arena = arena, .line = 1, .fresh = true, .blank = true};
}

static void append(tn_layout *layout, const char *text, size_t size)
{
    if (size > layout->capacity - layout->size) {
        size_t capacity = 2 * (layout->size + size) + 1024;
        char *grown = tn_arena_alloc(layout->arena, capacity);
        if (!grown)
            return;
        if (layout->size)
            memcpy(grown, layout->text, layout->size);
        layout->text = grown;
        layout->capacity = capacity;
    }
    if (size)
        memcpy(layout->text + layout->size, text, size);
    layout->size += size;
}

static void append_spaces(tn_layout *layout, size_t count)
{
    static const char spaces[] = "                                ";
    for (; count >= sizeof spaces; count -= sizeof spaces - 1)
        append(layout, spaces, sizeof spaces - 1);
    append(layout, spaces, count);
}

void tn_layout_put(tn_layout *layout, const char *text, size_t size)
{
    if (size == 0)
        return;
    if (layout->fresh)
        append_spaces(layout, layout->indent);
    append_spaces(layout, layout->gap);
    layout->gap = 0;
    layout->fresh = false;
    append(layout, text, size);
    layout->column += text_width(text, size);
}

void tn_layout_spaces(tn_layout *layout, size_t count)
{
    layout->gap += count;
    layout->column += count;
}

void tn_layout_line(tn_layout *layout, size_t indent)
{
    if (!layout->fresh) {
        append(layout, "\n", 1);
        layout->line++;
        layout->blank = false;
    }
    layout->indent = layout->column = indent;
    layout->fresh = true;
    layout->remarked = false;
    layout->gap = 0;
}

/* Leaves so many lines empty before the next, where empty lines mean something. */
static void layout_feed(tn_layout *layout, size_t count)
{
    for (size_t i = 0; i < count; i++)
        append(layout, "\n", 1);
    layout->line += count;
    layout->blank |= count > 0;
}

/* Leaves one line empty before the next, but not at the start. The cursor is on a fresh line. */
static void layout_blank(tn_layout *layout)
{
    if (!layout->blank)
        layout_feed(layout, 1);
}

/* Ends the line with a comment. */
static void layout_remark(tn_layout *layout, const char *text, size_t size)
{
    if (layout->remark_count == layout->remark_capacity) {
        size_t capacity = layout->remark_capacity ? 2 * layout->remark_capacity : 32;
        tn_remark *grown = TN_NEW_ARRAY(layout->arena, tn_remark, capacity);
        if (!grown)
            return;
        if (layout->remark_count)
            memcpy(grown, layout->remarks, layout->remark_count * sizeof *grown);
        layout->remarks = grown;
        layout->remark_capacity = capacity;
    }
    layout->remarks[layout->remark_count++] = (tn_remark){layout->size, layout->line, layout->column, text, size};
    layout->remarked = true;
}

/* The column at which the comments from `first` on stand whose lines follow one another; *last: after the last. */
static size_t remark_column(const tn_layout *layout, size_t first, size_t *last)
{
    const tn_remark *remarks = layout->remarks;
    size_t column = remarks[first].column, i = first + 1;
    for (; i < layout->remark_count && remarks[i].line == remarks[i - 1].line + 1; i++)
        column = remarks[i].column > column ? remarks[i].column : column;
    *last = i;
    return column + REMARK_GAP <= REMARK_COLUMN ? column + REMARK_GAP : 0;
}

char *tn_layout_finish(tn_layout *layout, size_t *size)
{
    tn_layout done;
    size_t used = 0;
    tn_layout_line(layout, 0);
    tn_layout_start(&done, layout->arena);
    for (size_t first = 0, last; first < layout->remark_count; first = last) {
        size_t column = remark_column(layout, first, &last);
        for (size_t i = first; i < last; i++) {
            const tn_remark *remark = &layout->remarks[i];
            append(&done, layout->text + used, remark->offset - used);
            append_spaces(&done, column ? column - remark->column : REMARK_GAP);
            append(&done, remark->text, remark->size);
            used = remark->offset;
        }
    }
    append(&done, layout->text ? layout->text + used : "", layout->size - used);
    append(&done, "", 1);
    *size = done.size - 1;
    return tn_arena_failed(layout->arena) ? NULL : done.text;
}

/* ==== lays out tokens in the ways that several notations share */

/* ---- lays out statements that end with `;` and stand in blocks */

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

/* ---- from the lexer's tokens to the formatter's */

/* Line ends between two places. */
static size_t lines_between(const tn_source *source, size_t begin, size_t end)
{
    size_t lines = 0;
    for (size_t i = begin; i < end; i++)
        lines += source->text[i] == '\n' || (source->text[i] == '\r' && source->text[i + 1] != '\n');
    return lines;
}

static size_t without_blanks(const char *text, size_t size)
{
    while (size > 0 && strchr(" \t\f\v", text[size - 1]))
        size--;
    return size;
}

const char *tn_format_small_letters(tn_arena *arena, const char *text, size_t size)
{
    char *copy = tn_arena_copy(arena, text, size);
    for (size_t i = 0; copy && i < size; i++)
        if (copy[i] >= 'A' && copy[i] <= 'Z')
            copy[i] = (char)(copy[i] - 'A' + 'a');
    return copy;
}

static bool is_measure(tn_token_kind kind)
{
    return kind == TN_TOKEN_NUMBER || kind == TN_TOKEN_LENGTH;
}

/* `4'` and `6"` on two lines are two lengths, on one line they are one. */
static bool would_merge(const tn_format_token *before, tn_token_kind kind, size_t lines)
{
    return lines > 0 && is_measure(before->kind) && kind == TN_TOKEN_LENGTH;
}

typedef struct taker {
    tn_format *format;
    tn_arena *arena;
    const tn_source *source;
    tn_format_spell *spell;
    tn_format_comment *comments; /* room for the next */
    size_t end;                  /* of the token before */
} taker;

/* A comment on the line of the token before belongs to that one, another to the token to come. */
static void take_comment(taker *t, const tn_token *from, size_t lines)
{
    tn_format_token *token = &t->format->tokens[t->format->count];
    const char *text = t->source->text + from->span.begin;
    tn_format_comment comment = {text, without_blanks(text, from->span.end - from->span.begin), lines > 1};
    if (t->format->count > 0 && lines == 0 && !token->comment_count && !token[-1].remark.text) {
        token[-1].remark = comment;
        return;
    }
    *t->comments = comment;
    token->comments = token->comment_count++ ? token->comments : t->comments;
    t->comments++;
}

/* One blank or line end for several. */
static const char *join_blanks(tn_arena *arena, const char *text, size_t size)
{
    char *joined = TN_NEW_ARRAY(arena, char, size + 1);
    size_t used = 0;
    for (size_t i = 0; joined && i < size; i++) {
        bool blank = strchr(" \t\r\n\f\v", text[i]) != NULL, after = used > 0 && strchr(" \n", joined[used - 1]);
        if (!blank)
            joined[used++] = text[i];
        else if (!after)
            joined[used++] = text[i] == '\n' ? '\n' : ' ';
        else if (text[i] == '\n')
            joined[used - 1] = '\n';
    }
    return joined;
}

static void take_token(taker *t, const tn_token *from, size_t lines)
{
    tn_format *format = t->format;
    tn_format_token *token = &format->tokens[format->count];
    token->kind = from->kind;
    token->text = t->source->text + from->span.begin;
    token->size = from->span.end - from->span.begin;
    if (token->kind == TN_TOKEN_WORD || token->kind == TN_TOKEN_HOUSE) {
        token->text = (token->kind == TN_TOKEN_WORD ? t->spell : join_blanks)(t->arena, token->text, token->size);
        token->size = token->text ? strlen(token->text) : 0;
    }
    token->offset = from->span.begin;
    token->width = text_width(token->text, token->size);
    token->blank = lines > 1;
    if (token->kind == TN_TOKEN_SIGN && *token->text == ',' && format->count > 0 &&
        !token->comment_count) { /* `a # why , b`: after the comma */
        token->remark = token[-1].remark;
        token[-1].remark.text = NULL;
    }
    token->breaks = format->count > 0 && would_merge(&token[-1], token->kind, lines);
    format->count++;
}

void tn_format_take(tn_format *format, tn_arena *arena, const tn_source *source, const tn_tokens *tokens,
                    tn_format_spell *spell)
{
    format->tokens = TN_NEW_ARRAY(arena, tn_format_token, tokens->count + 1);
    taker t = {.format = format, .arena = arena, .source = source, .spell = spell};
    t.comments = TN_NEW_ARRAY(arena, tn_format_comment, tokens->count + 1);
    if (!format->tokens || !t.comments)
        return;
    for (size_t i = 0; i < tokens->count; i++) {
        const tn_token *token = &tokens->items[i];
        if (token->kind == TN_TOKEN_LINE) {
            size_t ends = lines_between(source, token->span.begin, token->span.end);
            format->tokens[format->count].line_ends += ends ? ends : 1;
            continue;
        }
        size_t lines = lines_between(source, t.end, token->span.begin);
        t.end = token->span.end;
        if (token->kind == TN_TOKEN_COMMENT)
            take_comment(&t, token, lines);
        else
            take_token(&t, token, lines);
    }
    format->tokens[format->count].text = "";
    format->tokens[format->count].kind = TN_TOKEN_SIGN;
}

bool tn_format_match_brackets(tn_format *format, size_t *place)
{
    static const char *const opening[] = {"(", "[", "{", NULL}, *const closing[] = {")", "]", "}", NULL};
    size_t stack[TN_FORMAT_BRACKETS_MAX], depth = 0;
    for (size_t i = 0; i < format->count; i++) {
        if (tn_format_is_any(format, i, opening)) {
            *place = i;
            if (depth == TN_FORMAT_BRACKETS_MAX)
                return false;
            stack[depth++] = i;
        } else if (depth > 0 && tn_format_is_any(format, i, closing)) {
            format->tokens[i].match = stack[--depth];
            format->tokens[stack[depth]].match = i;
        }
    }
    return true;
}

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
        layout_feed(layout, token->breaks - 1);
    for (size_t k = 0; k < token->comment_count; k++) {
        tn_layout_put(layout, token->comments[k].text, token->comments[k].size);
        tn_layout_line(layout, layout->indent);
    }
    if (!layout->fresh)
        tn_layout_spaces(layout, gap);
    token->line = layout->line;
    put_lines(layout, token->text, token->size);
    if (token->remark.text)
        layout_remark(layout, token->remark.text, token->remark.size);
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
        layout_blank(layout);
    for (size_t k = 0; k < token->comment_count; k++) {
        if (token->comments[k].blank)
            layout_blank(layout);
        tn_layout_line(layout, indent);
        tn_layout_put(layout, token->comments[k].text, token->comments[k].size);
        tn_layout_line(layout, indent);
    }
    if (token->blank || (blank && !token->comment_count))
        layout_blank(layout);
    tn_layout_line(layout, indent);
    token->comment_count = 0; /* they are there now */
}
