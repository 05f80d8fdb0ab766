/* The lines of a drawing of a house: the edges that are seen, each with the weight that its meaning has on paper.
 *
 * Coordinates are nanometres in the plane of the drawing, u to the right and v upwards. The caller owns the lines.
 */
#ifndef TARTAN_HOUSE_MODEL_LINES_H
#define TARTAN_HOUSE_MODEL_LINES_H

#include "runtime/geometry/mesh.h"
#include "runtime/geometry/render.h"

/* What lines mean, the heaviest first: edges of what is cut; edges that are seen; what is thin, and what is said about
 * the drawing; hatches. */
typedef enum tn_line_weight {
    TN_STROKE_CUT,
    TN_STROKE_SEEN,
    TN_STROKE_THIN,
    TN_STROKE_HATCH,
    TN_STROKE_WEIGHTS
} tn_line_weight;

/* How wide they are on paper, in hundredths of a millimetre: of the series of ISO 128. */
extern const int tn_line_weight_widths[TN_STROKE_WEIGHTS];

/* at: the ends. group: of the mesh; of two that meet, that of the heavier line. cut: it lies in the plane of the cut.
 */
typedef struct tn_drawn_line {
    double at[2][2];
    tn_line_weight weight;
    uint32_t group;
    bool cut;
} tn_drawn_line;

/* How heavy the edges of a group are. */
typedef struct tn_line_weights {
    const void *context;
    tn_line_weight (*of)(const void *context, uint32_t group, bool cut);
} tn_line_weights;

/* The edges of a mesh that are seen. cut: is the mesh cut by a plane across the camera's direction, in which what is
 * nearest lies? The caller frees *lines, also after a failure. TN_MEMORY. */
tn_status tn_house_lines(const tn_mesh *mesh, const tn_camera *camera, bool cut, const tn_line_weights *weights,
                         tn_drawn_line **lines, size_t *count, tn_error *error);

/* Makes one line of those of one weight that lie in one line and touch or overlap; grouped: only of one group and cut
 * alike, as each kind of part has a layer of its own. TN_MEMORY. */
tn_status tn_lines_merge(tn_drawn_line *lines, size_t *count, bool grouped, tn_error *error);

#endif
