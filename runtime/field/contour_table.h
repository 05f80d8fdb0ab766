/* How the surface runs through a cell of the grid, by which of its corners are inside.
 *
 * Corner k of a cell lies at x = k & 1, y = k >> 1 & 1, z = k >> 2; bit k of a mask says that it is inside.
 */
#ifndef TARTAN_FIELD_CONTOUR_TABLE_H
#define TARTAN_FIELD_CONTOUR_TABLE_H

#include <stdint.h>

#define TN_CELL_TRIANGLES 5u /* at most */

/* The two corners of each edge, the lower first. */
extern const uint8_t tn_contour_edges[12][2];

extern const uint8_t tn_contour_table[256][1 + 3 * TN_CELL_TRIANGLES];

#endif
