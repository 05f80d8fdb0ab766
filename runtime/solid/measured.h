/* What is measured of a solid, by the names that designs use; the definitions are in docs/solid-language.md. */
#ifndef TARTAN_SOLID_MEASURED_H
#define TARTAN_SOLID_MEASURED_H

/* name, the number that modules hold (given as those of values.def), word, and what it takes to know it: BOXES (the
 * mapping), CELLS (what clipping leaves), UNION (the boundary of all cells) or PLAN (cells, seen along an axis) */
#define TN_SOLID_MEASURES(X)                                                                                           \
    X(WIDTH, 0, "width", CELLS)                                                                                        \
    X(HEIGHT, 1, "height", CELLS)                                                                                      \
    X(DEPTH, 2, "depth", CELLS)                                                                                        \
    X(VOLUME, 3, "volume", CELLS)                                                                                      \
    X(MASS, 4, "mass", CELLS)                                                                                          \
    X(AREA, 5, "area", UNION)                                                                                          \
    X(CENTRE_X, 6, "centre-x", CELLS)                                                                                  \
    X(CENTRE_Y, 7, "centre-y", CELLS)                                                                                  \
    X(CENTRE_Z, 8, "centre-z", CELLS)                                                                                  \
    X(INERTIA_X, 9, "inertia-x", CELLS)                                                                                \
    X(INERTIA_Y, 10, "inertia-y", CELLS)                                                                               \
    X(INERTIA_Z, 11, "inertia-z", CELLS)                                                                               \
    X(PARTS, 12, "parts", UNION)                                                                                       \
    X(WEAKEST, 13, "weakest", UNION)                                                                                   \
    X(STABLE, 14, "stable", CELLS)                                                                                     \
    X(FOOTPRINT, 15, "footprint", CELLS)                                                                               \
    X(SUPPORT, 16, "support", PLAN)                                                                                    \
    X(OVERHANG, 17, "overhang", UNION)                                                                                 \
    X(SHADOW_X, 18, "shadow-x", PLAN)                                                                                  \
    X(SHADOW_Y, 19, "shadow-y", PLAN)                                                                                  \
    X(SHADOW_Z, 20, "shadow-z", PLAN)                                                                                  \
    X(SQUASHED, 21, "squashed", BOXES)                                                                                 \
    X(GHOSTS, 22, "ghosts", CELLS)                                                                                     \
    X(VOIDS, 23, "voids", BOXES)                                                                                       \
    X(INWARD, 24, "inward", CELLS)                                                                                     \
    X(BOXES, 25, "boxes", BOXES)

/* As many bytes as the highest number and one. */
union tn_solid_measured_bytes {
#define X(NAME, NUMBER, WORD, NEEDS) char of_##NAME[(NUMBER) + 1];
    TN_SOLID_MEASURES(X)
#undef X
};

typedef enum tn_solid_measured {
#define X(NAME, NUMBER, WORD, NEEDS) TN_SOLID_##NAME##_MEASURED = (NUMBER),
    TN_SOLID_MEASURES(X)
#undef X
        TN_SOLID_MEASURED_COUNT = sizeof(union tn_solid_measured_bytes)
} tn_solid_measured;

#define X(NAME, NUMBER, WORD, NEEDS) +1
_Static_assert((0 TN_SOLID_MEASURES(X)) == TN_SOLID_MEASURED_COUNT, "the numbers leave none out");
#undef X

/* As designs write them. */
extern const char *const tn_solid_measured_names[TN_SOLID_MEASURED_COUNT];

#endif
