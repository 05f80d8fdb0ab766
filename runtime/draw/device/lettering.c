/* Measures lettering by the advances of DejaVu Sans. */
#include "runtime/draw/device/lettering.h"

#include <stdint.h>
#include <string.h>

#include "runtime/base/utf8.h"

#define EM 2048.0 /* units of the table in a font's size */

enum { REGULAR, BOLD, FACES, MISSING = 1229 }; /* MISSING: the box of a character that the font lacks */

typedef struct block {
    uint32_t first, last, row;
} block;

static const uint16_t heights[FACES] = {
#define TN_FONT_HEIGHT(REGULAR, BOLD) REGULAR, BOLD
#define TN_FONT_BLOCK(FIRST, LAST, ROW)
#define TN_ADVANCE(REGULAR, BOLD)
#include "runtime/draw/device/dejavu_sans.def"
#undef TN_FONT_HEIGHT
#undef TN_FONT_BLOCK
#undef TN_ADVANCE
};

static const block blocks[] = {
#define TN_FONT_HEIGHT(REGULAR, BOLD)
#define TN_FONT_BLOCK(FIRST, LAST, ROW) {FIRST, LAST, ROW},
#define TN_ADVANCE(REGULAR, BOLD)
#include "runtime/draw/device/dejavu_sans.def"
#undef TN_FONT_HEIGHT
#undef TN_FONT_BLOCK
#undef TN_ADVANCE
};

static const uint16_t advances[][FACES] = {
#define TN_FONT_HEIGHT(REGULAR, BOLD)
#define TN_FONT_BLOCK(FIRST, LAST, ROW)
#define TN_ADVANCE(REGULAR, BOLD) {REGULAR, BOLD},
#include "runtime/draw/device/dejavu_sans.def"
#undef TN_FONT_HEIGHT
#undef TN_FONT_BLOCK
#undef TN_ADVANCE
};

/* What the table lacks comes from another font: wide characters are as wide as high there. */
static unsigned advance(uint32_t character, unsigned face)
{
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks && character >= blocks[i].first; i++)
        if (character <= blocks[i].last)
            return advances[blocks[i].row + character - blocks[i].first][face];
    unsigned columns = tn_character_width(character);
    return columns == 2 ? (unsigned)EM : columns * MISSING;
}

double tn_lettering_width(const char *text, bool bold)
{
    double width = 0;
    size_t left = strlen(text);
    for (size_t size; left > 0; text += size, left -= size)
        width += advance(tn_utf8_read(text, left, &size), bold ? BOLD : REGULAR);
    return width / EM;
}

double tn_lettering_height(bool bold)
{
    return heights[bold ? BOLD : REGULAR] / EM;
}
