/* Converts editors' places (UTF-16) to bytes, and back. */
#include "compiler/common/text_lines.h"

#include <stdlib.h>

static bool ends_line(const char *text, size_t size, size_t i)
{
    return text[i] == '\n' || (text[i] == '\r' && (i + 1 == size || text[i + 1] != '\n'));
}

bool tn_lines_make(tn_lines *lines, const char *text, size_t size)
{
    size_t count = 1;
    for (size_t i = 0; i < size; i++)
        count += ends_line(text, size, i);
    *lines = (tn_lines){text, size, malloc(count * sizeof *lines->starts), 1};
    if (!lines->starts)
        return false;
    lines->starts[0] = 0;
    for (size_t i = 0; i < size; i++)
        if (ends_line(text, size, i))
            lines->starts[lines->count++] = i + 1;
    return true;
}

void tn_lines_clear(tn_lines *lines)
{
    free(lines->starts);
    *lines = (tn_lines){0};
}

/* Bytes of the character at the start of a text, and its UTF-16 units. What is not UTF-8 counts as one of each. */
static size_t character_at(const char *text, size_t size, size_t *units)
{
    unsigned char first = (unsigned char)*text;
    size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : first >= 0xC0 ? 2 : 1;
    *units = bytes == 4 ? 2 : 1;
    if (bytes <= size)
        return bytes;
    *units = 1;
    return 1;
}

static size_t line_end(const tn_lines *lines, size_t line)
{
    size_t end = line + 1 < lines->count ? lines->starts[line + 1] : lines->size;
    while (end > lines->starts[line] && (lines->text[end - 1] == '\n' || lines->text[end - 1] == '\r'))
        end--;
    return end;
}

size_t tn_lines_offset(const tn_lines *lines, size_t line, size_t character)
{
    if (line >= lines->count)
        return lines->size;
    size_t at = lines->starts[line], end = line_end(lines, line), units;
    while (at < end && character > 0) {
        size_t bytes = character_at(lines->text + at, end - at, &units);
        if (units > character)
            break;
        at += bytes;
        character -= units;
    }
    return at;
}

void tn_lines_place(const tn_lines *lines, size_t offset, size_t *line, size_t *character)
{
    size_t low = 0, high = lines->count, units;
    if (offset > lines->size)
        offset = lines->size;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if (lines->starts[middle] <= offset)
            low = middle;
        else
            high = middle;
    }
    *line = low;
    *character = 0;
    for (size_t at = lines->starts[low]; at < offset; *character += units)
        at += character_at(lines->text + at, lines->size - at, &units);
}
