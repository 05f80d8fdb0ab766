/* What conditions of kits speak of: what is measured of a model that was placed, and the coordinates of its space.
 * docs/kit-language.md has the definitions. */
#ifndef TARTAN_PLACE_MODEL_TERMS_H
#define TARTAN_PLACE_MODEL_TERMS_H

#include "runtime/module/values.h"

/* A name, the number that modules hold (given as those of values.def), and a word. */
#define TN_PLACED_TERMS(X)                                                                                             \
    X(ELEMENTS, 0, "elements")                                                                                         \
    X(COLOURS, 1, "colours")                                                                                           \
    X(CELLS, 2, "cells")                                                                                               \
    X(FILL, 3, "fill")                                                                                                 \
    X(JOINTS, 4, "joints")                                                                                             \
    X(COMPONENTS, 5, "components")                                                                                     \
    X(CUTS, 6, "cuts")                                                                                                 \
    X(FLOATING, 7, "floating")                                                                                         \
    X(OPEN, 8, "open")                                                                                                 \
    X(OVERLAPS, 9, "overlaps")                                                                                         \
    X(WIDTH, 10, "width")                                                                                              \
    X(DEPTH, 11, "depth")                                                                                              \
    X(HEIGHT, 12, "height")                                                                                            \
    X(MASS, 13, "mass")                                                                                                \
    X(PRICE, 14, "price")                                                                                              \
    X(BALANCE, 15, "balance")

/* Behind these come x, y and z of a space, how often each counted part is there, and whether a cell is one of a mask's.
 */
typedef enum tn_placed_term {
#define X(NAME, NUMBER, WORD) TN_PLACED_##NAME = (NUMBER),
    TN_PLACED_TERMS(X)
#undef X
        TN_PLACED_X = 16,
    TN_PLACED_Y = 17,
    TN_PLACED_Z = 18,
    TN_PLACED_COUNTED = 19,
    TN_PLACED_MASK = 51,
    TN_PLACED_TERM_COUNT = TN_PLACED_MASK + TN_KIT_MASKS_MAX
} tn_placed_term;

_Static_assert(TN_PLACED_COUNTED + TN_KIT_COUNTED_MAX <= TN_PLACED_MASK, "counted parts come before masks");

extern const char *const tn_placed_terms[TN_PLACED_TERM_COUNT];

#endif
