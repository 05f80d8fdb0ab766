/* An SVG text made smaller for a page, in place: coordinates of paths cut to hundredths of a point, and what is the
 * default anyway left out of styles, but for the mitre limit, which the element around is to set to cairo's 10. */
#ifndef TARTAN_DRAW_SVG_PAGE_H
#define TARTAN_DRAW_SVG_PAGE_H

#include <stddef.h>

/* Returns the new length; the text then ends with a zero byte. `text` has room for size + 1 bytes. */
size_t tn_svg_shorten(char *text, size_t size);

#endif
