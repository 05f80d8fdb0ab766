/* Designs of clipped boxes, and the mapping from what is written to what is built (Bentley, chapter 4.3; what that
 * leaves open is settled in docs/solid-language.md).
 *
 * A design holds the boxes as written; images in planes of symmetry are implied. tn_design_read makes one of a module,
 * tn_design_clear frees it.
 */
#ifndef TARTAN_SOLID_DESIGN_H
#define TARTAN_SOLID_DESIGN_H

#include "runtime/base/error.h"
#include "runtime/geometry/union/cut_box.h"
#include "runtime/module/module.h"
#include "runtime/solid/exact.h"

typedef struct tn_solid_box {
    double low[3], high[3];
    double normal[3], distance; /* of the plane: n.(p - centre) <= distance is kept */
    bool rigid, clipped, void_; /* void_: nothing is left of it */
} tn_solid_box;

typedef struct tn_design {
    tn_solid_box *boxes; /* owned */
    uint32_t box_count;
    uint32_t flags;    /* TN_SOLID_SYMMETRY_X and so on */
    tn_face_unit unit; /* of its faces as written */
} tn_design;

/* A box that another squashed: the face across `axis` went from `before` to `after`. */
typedef struct tn_squash {
    uint32_t box, by;
    uint8_t image; /* of the other: bits of the axes it is mirrored across */
    uint8_t axis;
    bool high;  /* the high face; else the low one */
    bool whole; /* nothing was left */
    double before, after;
} tn_squash;

typedef struct tn_history {
    tn_squash *items; /* owned */
    size_t count, capacity;
} tn_history;

/* The design that the SOLID record says. */
tn_status tn_design_read(const tn_module *module, uint32_t solid, tn_design *design, tn_error *error);
tn_status tn_design_copy(const tn_design *design, tn_design *copy, tn_error *error);
void tn_design_clear(tn_design *design);
void tn_history_clear(tn_history *history);

/* Squashes overlapping boxes, in the chapter's order: each with those before it, then, for each plane of symmetry, with
 * their images. All of it is decided by the numbers as they were written (exact.h), not by the doubles. What happens is
 * added to the history, unless that is NULL. Afterwards no two overlap. */
tn_status tn_design_correct(tn_design *design, tn_history *history, tn_error *error);

/* Images of each box, itself among them: 1, 2, 4 or 8. */
uint32_t tn_design_images(const tn_design *design);

/* The mask of axes of the image of that number; images are listed as planes of symmetry are applied. */
uint32_t tn_design_image(const tn_design *design, uint32_t number);

/* What is left of a box when it is clipped, in its image. */
void tn_design_cell(const tn_design *design, uint32_t box, uint32_t image, tn_cut_box *cell);

/* Boxes of designs that are bred: what a list of genes means, as `genes (...)` of the language does. */

/* The box of nine genes in steps, in a design of these flags (TN_SOLID_FLAT, with its depth; TN_SOLID_NOCLIP). */
void tn_box_of_genes(const double genes[TN_BOX_GENES], uint32_t flags, double depth, tn_solid_box *box);

#endif
