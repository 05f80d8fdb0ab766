/* Height maps from PNG pictures. */
#ifndef TARTAN_PLACE_PICTURE_HEIGHTS_PNG_H
#define TARTAN_PLACE_PICTURE_HEIGHTS_PNG_H

#include <string.h>

#include "runtime/place/heights.h"

/* Does a file begin as a PNG picture does? */
static inline bool tn_is_png(const uint8_t *bytes, size_t size)
{
    return size >= 4 && memcmp(bytes, "\x89PNG", 4) == 0;
}

/* Reads a PNG picture: heights are luminances (of sRGB, ITU-R BT.709), and what is transparent is black; a grey picture
 * has the heights of the same one as PGM. TN_INVALID with what is wrong (no code), TN_LIMIT if it has more than
 * 32,767 pixels along a side or 16,777,216 in all, TN_MEMORY; in a build without the part `draw` TN_INVALID (E0907). */
tn_status tn_heights_read_png(const uint8_t *bytes, size_t size, tn_heights *heights, tn_error *error);

#endif
