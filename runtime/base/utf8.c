/* Checks UTF-8, measures its width, and escapes what must not reach a terminal. */
#include "runtime/base/utf8.h"

#include <string.h>

uint32_t tn_utf8_read(const char *text, size_t left, size_t *size)
{
    const unsigned char *bytes = (const unsigned char *)text;
    unsigned char lead = bytes[0];
    *size = 1;
    if (lead < 0x80)
        return lead;
    size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (lead < 0xC2 || lead > 0xF4 || length > left)
        return TN_REPLACEMENT;
    uint32_t character = lead & (0x7Fu >> length);
    for (size_t i = 1; i < length; i++) {
        if ((bytes[i] & 0xC0) != 0x80)
            return TN_REPLACEMENT;
        character = character << 6 | (bytes[i] & 0x3Fu);
    }
    static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    if (character < least[length] || character > 0x10FFFF || (character >= 0xD800 && character <= 0xDFFF))
        return TN_REPLACEMENT;
    *size = length;
    return character;
}

size_t tn_utf16_units(const char *text, size_t size)
{
    size_t units = 0, step;
    for (size_t i = 0; i < size; i += step)
        units += tn_utf8_read(text + i, size - i, &step) >= 0x10000 ? 2 : 1;
    return units;
}

void tn_utf8_copy(const char *text, size_t room, char *to)
{
    size_t left = strlen(text), used = 0, size;
    for (; used < left; used += size) {
        tn_utf8_read(text + used, left - used, &size);
        if (used + size >= room)
            break;
    }
    memcpy(to, text, used);
    to[used] = '\0';
}

/* Are the next eight bytes all of ASCII? Most of most texts is. */
static bool is_plain(const char *text)
{
    uint64_t bytes;
    memcpy(&bytes, text, sizeof bytes);
    return (bytes & 0x8080808080808080u) == 0;
}

bool tn_is_utf8(const char *text, size_t size)
{
    for (size_t i = 0, step; i < size; i += step) {
        step = 8;
        if (size - i >= step && is_plain(text + i))
            continue;
        if (tn_utf8_read(text + i, size - i, &step) == TN_REPLACEMENT && step == 1)
            return false;
    }
    return true;
}

typedef struct tn_range {
    uint32_t first, last;
} tn_range;

static bool in_ranges(const tn_range *ranges, size_t count, uint32_t character)
{
    for (size_t i = 0; i < count; i++)
        if (character >= ranges[i].first && character <= ranges[i].last)
            return true;
    return false;
}

/* The large blocks of Unicode's EastAsianWidth.txt that are wide (W and F), and of its combining marks: enough for a
 * caret to stand under its word. */
static const tn_range wide[] = {
    {0x1100, 0x115F}, {0x2E80, 0x303E},   {0x3041, 0x33FF},   {0x3400, 0x4DBF},   {0x4E00, 0x9FFF},
    {0xA000, 0xA4CF}, {0xAC00, 0xD7A3},   {0xF900, 0xFAFF},   {0xFE30, 0xFE6F},   {0xFF00, 0xFF60},
    {0xFFE0, 0xFFE6}, {0x1F300, 0x1F64F}, {0x1F680, 0x1F6FF}, {0x1F900, 0x1F9FF}, {0x20000, 0x3FFFD},
};

static const tn_range combining[] = {
    {0x0300, 0x036F}, {0x1AB0, 0x1AFF}, {0x1DC0, 0x1DFF}, {0x200B, 0x200D},
    {0x20D0, 0x20FF}, {0xFE00, 0xFE0F}, {0xFE20, 0xFE2F}, {0xFEFF, 0xFEFF},
};

static const tn_range hidden[] = {
    {0x00, 0x1F}, {0x7F, 0x9F}, {0x200E, 0x200F}, {0x2028, 0x202E}, {0x2066, 0x2069},
};

#define COUNT(array) (sizeof(array) / sizeof *(array))

unsigned tn_character_width(uint32_t character)
{
    if (character < 0x0300)
        return 1;
    if (in_ranges(combining, COUNT(combining), character))
        return 0;
    return in_ranges(wide, COUNT(wide), character) ? 2 : 1;
}

bool tn_character_hidden(uint32_t character)
{
    return in_ranges(hidden, COUNT(hidden), character);
}

void tn_character_escape(uint32_t character, char text[8])
{
    snprintf(text, 8, character < 0x80 ? "\\x%02x" : "\\u%04x", character & 0xFFFF);
}

static void write_character(FILE *out, uint32_t character, const char *bytes, size_t size)
{
    char escape[8];
    if (character == TN_REPLACEMENT) {
        fputs("\xEF\xBF\xBD", out);
    } else if (tn_character_hidden(character)) {
        tn_character_escape(character, escape);
        fputs(escape, out);
    } else {
        fwrite(bytes, 1, size, out);
    }
}

void tn_write_clean(FILE *out, const char *text, size_t size)
{
    for (size_t i = 0, step; i < size; i += step) {
        uint32_t character = tn_utf8_read(text + i, size - i, &step);
        if (character == '\t' || character == '\n' || character == '\r')
            fputc(' ', out);
        else
            write_character(out, character, text + i, step);
    }
}

void tn_write_shown(FILE *out, const char *text, size_t size)
{
    for (size_t i = 0, step; i < size; i += step) {
        uint32_t character = tn_utf8_read(text + i, size - i, &step);
        if (character == '\t' || character == '\n')
            fputc((char)character, out);
        else
            write_character(out, character, text + i, step);
    }
}
