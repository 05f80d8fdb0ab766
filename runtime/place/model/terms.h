/* What conditions of kits speak of: what is measured of a model that was placed, and the coordinates of its space.
 * docs/kit-language.md has the definitions. */
#ifndef TARTAN_PLACE_MODEL_TERMS_H
#define TARTAN_PLACE_MODEL_TERMS_H

#include "runtime/module/values.h"

#define TN_PLACED_TERMS(X)                                                                                             \
    X(ELEMENTS, "elements")                                                                                            \
    X(COLOURS, "colours")                                                                                              \
    X(CELLS, "cells")                                                                                                  \
    X(FILL, "fill")                                                                                                    \
    X(JOINTS, "joints")                                                                                                \
    X(COMPONENTS, "components")                                                                                        \
    X(CUTS, "cuts")                                                                                                    \
    X(FLOATING, "floating")                                                                                            \
    X(OPEN, "open")                                                                                                    \
    X(OVERLAPS, "overlaps")                                                                                            \
    X(WIDTH, "width")                                                                                                  \
    X(DEPTH, "depth")                                                                                                  \
    X(HEIGHT, "height")                                                                                                \
    X(MASS, "mass")                                                                                                    \
    X(PRICE, "price")                                                                                                  \
    X(BALANCE, "balance")

/* Behind these come x, y and z of a space, how often each counted part is there, and whether a cell is one of a mask's.
 */
typedef enum tn_placed_term {
#define X(NAME, WORD) TN_PLACED_##NAME,
    TN_PLACED_TERMS(X)
#undef X
        TN_PLACED_X,
    TN_PLACED_Y,
    TN_PLACED_Z,
    TN_PLACED_COUNTED,
    TN_PLACED_MASK = TN_PLACED_COUNTED + TN_KIT_COUNTED_MAX,
    TN_PLACED_TERM_COUNT = TN_PLACED_MASK + TN_KIT_MASKS_MAX
} tn_placed_term;

extern const char *const tn_placed_terms[TN_PLACED_TERM_COUNT];

#endif
