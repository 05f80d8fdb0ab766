/* Makes an SVG smaller, for an HTML page. */
#include "runtime/draw/svg_page.h"

#include <stdbool.h>
#include <string.h>

enum { DECIMALS = 2 };

/* Declarations that say what is so without them, as cairo writes them. */
static const char *const needless[] = {
    "stroke-linecap:butt;", "stroke-linejoin:miter;", "stroke-opacity:1;",
    "fill-opacity:1;",      "fill-rule:nonzero;",     "stroke-miterlimit:10;",
};

static bool starts(const char *text, size_t left, const char *word)
{
    size_t length = strlen(word);
    return left >= length && memcmp(text, word, length) == 0;
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* How many bytes at `text`, within a style, are needless. */
static size_t needless_at(const char *text, size_t left)
{
    for (size_t i = 0; i < sizeof needless / sizeof *needless; i++)
        if (starts(text, left, needless[i]))
            return strlen(needless[i]);
    return 0;
}

/* How many bytes of the digits after a point, at `text`, to leave out; *kept: those before them that stay. */
static size_t decimals_at(const char *text, size_t left, size_t *kept)
{
    size_t count = 0;
    while (count < left && is_digit(text[count]))
        count++;
    *kept = count < DECIMALS ? count : DECIMALS;
    return count - *kept;
}

size_t tn_svg_shorten(char *text, size_t size)
{
    static const char path[] = " d=\"", style[] = " style=\"";
    bool in_path = false, in_style = false;
    size_t used = 0;
    for (size_t i = 0; i < size;) {
        size_t left = size - i, skipped = in_style ? needless_at(text + i, left) : 0, kept;
        if (skipped) {
            i += skipped;
            continue;
        }
        if (starts(text + i, left, path) || starts(text + i, left, style)) {
            in_path = text[i + 1] == 'd';
            in_style = !in_path;
            size_t length = strlen(in_path ? path : style);
            memmove(text + used, text + i, length);
            used += length;
            i += length;
            continue;
        }
        if (text[i] == '"')
            in_path = in_style = false;
        if (in_path && text[i] == '.') {
            skipped = decimals_at(text + i + 1, left - 1, &kept);
            memmove(text + used, text + i, kept + 1);
            used += kept + 1;
            i += kept + 1 + skipped;
            continue;
        }
        text[used++] = text[i++];
    }
    text[used] = '\0';
    return used;
}
