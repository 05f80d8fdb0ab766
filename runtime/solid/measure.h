/* A design as it is built, and what is measured of that.
 *
 * tn_built_make makes one; tn_built_clear frees it in any case. Cells are listed image by image: cell
 * i is of box i % box_count, in image tn_design_image(i / box_count).
 */
#ifndef TARTAN_SOLID_MEASURE_H
#define TARTAN_SOLID_MEASURE_H

#include "runtime/solid/design.h"
#include "runtime/solid/measured.h"

typedef struct tn_built {
    tn_design written, built; /* before correction and after */
    tn_history history;
    tn_cut_box *cells; /* owned */
    size_t cell_count;
} tn_built;

#define TN_SOLID_BOXES_DEFAULT 100000u

/* Of a SOLID record of a module. E_SOLID_EMPTY where nothing is left; TN_LIMIT for more boxes, images counted, than
 * `most`, where 0 stands for the default. */
tn_status tn_built_make(const tn_module *module, uint32_t solid, uint32_t most, tn_built *built, tn_error *error);
void tn_built_clear(tn_built *built);

/* The same of a design that is at hand, of which it keeps a copy; nothing is noted of how boxes were squashed. */
tn_status tn_built_make_of(const tn_design *written, tn_built *built, tn_error *error);

/* The measures that the mask names (1 << tn_solid_measured); others stay as they were. */
tn_status tn_built_measure(const tn_built *built, uint64_t mask, double values[TN_SOLID_MEASURED_COUNT],
                           tn_error *error);

/* Which other cells' boxes the middle of each cell's clipped face lies against: the first of them, or UINT32_MAX. */
tn_status tn_built_inward(const tn_built *built, uint32_t **others, tn_error *error);

#endif
