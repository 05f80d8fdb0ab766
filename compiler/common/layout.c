/* Writes tokens as lines of a given width, with their comments. */
#include "compiler/common/layout.h"

#include <string.h>

enum {
    REMARK_GAP = 2,     /* blanks before a comment at a line's end */
    REMARK_COLUMN = 80, /* comments are not lined up farther to the right than this */
};

size_t tn_text_width(const char *text, size_t size)
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
    layout->column += tn_text_width(text, size);
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

void tn_layout_feed(tn_layout *layout, size_t count)
{
    for (size_t i = 0; i < count; i++)
        append(layout, "\n", 1);
    layout->line += count;
    layout->blank |= count > 0;
}

void tn_layout_blank(tn_layout *layout)
{
    if (!layout->blank)
        tn_layout_feed(layout, 1);
}

void tn_layout_remark(tn_layout *layout, const char *text, size_t size)
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
