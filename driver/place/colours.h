/* The colours of LDraw's numbers. */
#ifndef TARTAN_DRIVER_PLACE_COLOURS_H
#define TARTAN_DRIVER_PLACE_COLOURS_H

#include <stdint.h>

/* In sRGB, 0 to 1; a colour that is not known is a light grey. */
void tn_ldraw_colour(int32_t number, double rgb[3]);

#endif
