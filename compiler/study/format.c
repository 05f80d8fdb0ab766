/* Laying out .study files: a statement a line, and of an `evolution` block a setting a line. Statements of one kind on
 * neighbouring lines are lined up, their numbers at the point. */
#include <string.h>

#include "compiler/common/layout.h"
#include "compiler/study/study.h"

enum {
    BODY = 2,      /* indents */
    CONTINUED = 4, /* what goes on in the next line */
    CELLS_MAX = 32 /* tokens of a statement that are lined up */
};

/* A minus that stands before what it turns round, not between two. */
static bool is_sign(const tn_format *format, size_t i)
{
    static const char *const words[] = {"and", "or", "not", "in", NULL};
    return tn_format_is(format, i, "-") && i > 0 && !tn_format_is(format, i - 1, ")") &&
           (format->tokens[i - 1].kind == TN_TOKEN_SIGN || tn_format_is_any(format, i - 1, words));
}

static bool is_operator(const tn_format *format, size_t i)
{
    static const char *const signs[] = {"+", "-", "*", "/", "<", "<=", ">=", ">", "!=", NULL};
    return tn_format_is_any(format, i, signs);
}

static size_t gap_before(const tn_format *format, size_t i)
{
    bool tight = tn_format_is(format, i, ")") || tn_format_is(format, i, ",") || tn_format_is(format, i - 1, "(") ||
                 is_sign(format, i - 1) || tn_format_is(format, i, "..") || tn_format_is(format, i - 1, "..") ||
                 (tn_format_is(format, i, "(") && format->tokens[i - 1].kind == TN_TOKEN_NAME);
    return tight ? 0 : 1;
}

static bool starts_block(const tn_format *format, size_t i)
{
    return i + 1 < format->count && tn_format_is(format, i, "evolution") && tn_format_is(format, i + 1, "{");
}

static bool starts_statement(const tn_format *format, size_t i)
{
    const tn_format_token *token = &format->tokens[i];
    return (token->kind == TN_TOKEN_WORD && tn_study_heads(token->text, token->size)) || starts_block(format, i);
}

/* Where a statement that is too long is broken: before words, and before what calculates. */
static bool at_part(const tn_format *format, size_t i)
{
    return format->tokens[i].kind == TN_TOKEN_WORD || (is_operator(format, i) && !is_sign(format, i));
}

static size_t statement_end(const tn_format *format, size_t first)
{
    size_t i = first + 1;
    while (i < format->count && !starts_statement(format, i))
        i++;
    return i;
}

/* ---- statements that are lined up */

/* A column of the table that a run of statements is: words start in one column, numbers have their points in one. */
typedef struct cell {
    size_t before, after; /* of the point; of a word all is after */
} cell;

static cell cell_of(const tn_format_token *token)
{
    size_t point = token->kind == TN_TOKEN_NUMBER ? 0 : token->size;
    while (point < token->size && !strchr(".eE", token->text[point]))
        point++;
    return token->kind == TN_TOKEN_NUMBER ? (cell){point, token->size - point} : (cell){0, token->width};
}

static bool is_force(const tn_format *format, size_t i)
{
    return tn_format_is(format, i, "attractor") || tn_format_is(format, i, "repeller");
}

/* Can these two stand in one column? */
static bool alike_cells(const tn_format *format, size_t i, size_t j, bool head)
{
    const tn_format_token *a = &format->tokens[i], *b = &format->tokens[j];
    if (a->kind != b->kind || a->kind == TN_TOKEN_SIGN)
        return false;
    if (a->kind != TN_TOKEN_WORD || (head && is_force(format, i) && is_force(format, j)))
        return true;
    return a->size == b->size && memcmp(a->text, b->text, a->size) == 0;
}

static bool alike(const tn_format *format, size_t first, size_t last, size_t other, size_t other_last)
{
    size_t cells = last - first < other_last - other ? last - first : other_last - other;
    bool same = last - first <= CELLS_MAX && other_last - other <= CELLS_MAX;
    for (size_t k = 0; same && k < cells; k++)
        same = alike_cells(format, first + k, other + k, k == 0);
    for (size_t i = first + 1; same && i < last; i++)
        same = !format->tokens[i].comment_count && !format->tokens[i - 1].remark.text && !format->tokens[i].breaks;
    return same;
}

/* The end of the run of statements that starts at `first`; *ends: the ends of the statements. */
static size_t run_end(const tn_format *format, size_t first, size_t *columns)
{
    size_t widest = first, widest_end = statement_end(format, first), last = widest_end;
    while (last < format->count && !format->tokens[last].blank && !format->tokens[last].comment_count) {
        size_t end = statement_end(format, last);
        if (starts_block(format, last) || !alike(format, last, end, widest, widest_end) ||
            !alike(format, widest, widest_end, last, end))
            break;
        if (end - last > widest_end - widest) {
            widest = last;
            widest_end = end;
        }
        last = end;
    }
    *columns = widest_end - widest;
    return last;
}

static void put_row(tn_format *format, size_t first, size_t last, const cell *cells)
{
    size_t column = 0;
    for (size_t i = first; i < last; i++) {
        cell own = cell_of(&format->tokens[i]), room = cells[i - first];
        tn_format_put(format, i, column + room.before - own.before - format->layout.column);
        column += room.before + room.after + 1;
    }
}

/* The run as a table. False if it does not fit, or is of one statement. */
static bool put_table(tn_format *format, size_t first, size_t last, size_t columns)
{
    cell cells[CELLS_MAX] = {0};
    size_t width = 0;
    if (columns > CELLS_MAX || statement_end(format, first) == last)
        return false;
    for (size_t begin = first, end; begin < last; begin = end) {
        end = statement_end(format, begin);
        for (size_t i = begin; i < end; i++) {
            cell own = cell_of(&format->tokens[i]), *room = &cells[i - begin];
            room->before = own.before > room->before ? own.before : room->before;
            room->after = own.after > room->after ? own.after : room->after;
        }
    }
    for (size_t k = 0; k < columns; k++)
        width += cells[k].before + cells[k].after + 1;
    if (width > TN_FORMAT_WIDTH + 1)
        return false;
    for (size_t begin = first, end; begin < last; begin = end) {
        end = statement_end(format, begin);
        tn_layout_line(&format->layout, 0);
        put_row(format, begin, end, cells);
    }
    return true;
}

/* ---- one by one */

static void put_statement(tn_format *format, size_t first, size_t last)
{
    tn_layout_line(&format->layout, 0);
    tn_format_put(format, first, 0);
    format->layout.indent = CONTINUED; /* of the lines to come */
    for (size_t begin = first + 1, end; begin < last; begin = end) {
        for (end = begin + 1; end < last && !at_part(format, end);)
            end++;
        if (format->layout.column + 1 + tn_format_width(format, begin, end) > TN_FORMAT_WIDTH && at_part(format, begin))
            tn_layout_line(&format->layout, CONTINUED);
        tn_layout_spaces(&format->layout, format->layout.fresh ? 0 : gap_before(format, begin));
        tn_format_flat(format, begin, end);
    }
}

static void put_run(tn_format *format, size_t first, size_t last, size_t columns)
{
    if (put_table(format, first, last, columns))
        return;
    for (size_t begin = first, end; begin < last; begin = end) {
        end = statement_end(format, begin);
        put_statement(format, begin, end);
    }
}

/* ---- blocks */

static size_t block_end(const tn_format *format, size_t first)
{
    while (first < format->count && !tn_format_is(format, first, "}"))
        first++;
    return first < format->count ? first + 1 : first;
}

static void put_block(tn_format *format, size_t first, size_t last)
{
    size_t open = first + 1, close = last - 1;
    tn_format_flat(format, first, open + 1);
    for (size_t i = open + 1; i < close; i++) {
        if (i > open + 1 && !format->tokens[i].line_ends) {
            tn_format_put(format, i, 1);
            continue;
        }
        if (i == open + 1)
            format->tokens[i].blank = false; /* none after the opening brace */
        tn_format_gap(format, i, BODY, false);
        tn_format_put(format, i, 0);
    }
    format->tokens[close].blank = false;
    tn_format_gap(format, close, format->tokens[close].comment_count ? BODY : 0, false);
    tn_layout_line(&format->layout, 0);
    tn_format_put(format, close, 0);
}

/* Around a block, which is read alone, a text may lack its closing quote: its line ends there. */
static void find_breaks(tn_format *format)
{
    for (size_t i = 0; i + 1 < format->count; i++) {
        const tn_format_token *token = &format->tokens[i];
        bool open = token->kind == TN_TOKEN_STRING && (token->size < 2 || token->text[token->size - 1] != '"');
        format->tokens[i + 1].breaks = open;
    }
}

void tn_format_study(tn_format *format)
{
    bool after_block = false;
    format->gap_before = gap_before;
    find_breaks(format);
    for (size_t first = 0, last, columns; first < format->count; first = last) {
        bool block = starts_block(format, first);
        tn_format_gap(format, first, 0, first > 0 && (block || after_block));
        if (block) {
            last = block_end(format, first);
            put_block(format, first, last);
        } else {
            last = run_end(format, first, &columns);
            put_run(format, first, last, columns);
        }
        after_block = block;
    }
    tn_format_gap(format, format->count, 0, false);
}
