/* What is measured of a solid, by the names that designs use; the definitions are in docs/solid-language.md. */
#ifndef TARTAN_SOLID_MEASURED_H
#define TARTAN_SOLID_MEASURED_H

/* name, and what it takes to know it: BOXES (the mapping), CELLS (what clipping leaves), UNION (the boundary of all
 * cells) or PLAN (cells, seen along an axis) */
#define TN_SOLID_MEASURES(X)                                                                                           \
    X(WIDTH, "width", CELLS)                                                                                           \
    X(HEIGHT, "height", CELLS)                                                                                         \
    X(DEPTH, "depth", CELLS)                                                                                           \
    X(VOLUME, "volume", CELLS)                                                                                         \
    X(MASS, "mass", CELLS)                                                                                             \
    X(AREA, "area", UNION)                                                                                             \
    X(CENTRE_X, "centre-x", CELLS)                                                                                     \
    X(CENTRE_Y, "centre-y", CELLS)                                                                                     \
    X(CENTRE_Z, "centre-z", CELLS)                                                                                     \
    X(INERTIA_X, "inertia-x", CELLS)                                                                                   \
    X(INERTIA_Y, "inertia-y", CELLS)                                                                                   \
    X(INERTIA_Z, "inertia-z", CELLS)                                                                                   \
    X(PARTS, "parts", UNION)                                                                                           \
    X(WEAKEST, "weakest", UNION)                                                                                       \
    X(STABLE, "stable", CELLS)                                                                                         \
    X(FOOTPRINT, "footprint", CELLS)                                                                                   \
    X(SUPPORT, "support", PLAN)                                                                                        \
    X(OVERHANG, "overhang", UNION)                                                                                     \
    X(SHADOW_X, "shadow-x", PLAN)                                                                                      \
    X(SHADOW_Y, "shadow-y", PLAN)                                                                                      \
    X(SHADOW_Z, "shadow-z", PLAN)                                                                                      \
    X(SQUASHED, "squashed", BOXES)                                                                                     \
    X(GHOSTS, "ghosts", CELLS)                                                                                         \
    X(VOIDS, "voids", BOXES)                                                                                           \
    X(INWARD, "inward", CELLS)                                                                                         \
    X(BOXES, "boxes", BOXES)

typedef enum tn_solid_measured {
#define X(NAME, WORD, NEEDS) TN_SOLID_##NAME##_MEASURED,
    TN_SOLID_MEASURES(X)
#undef X
        TN_SOLID_MEASURED_COUNT
} tn_solid_measured;

/* As designs write them. */
extern const char *const tn_solid_measured_names[TN_SOLID_MEASURED_COUNT];

#endif
