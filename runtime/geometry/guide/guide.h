/* What explains a picture of a form beside the form itself: places, arrows, lines and outlines in space, with short
 * texts. An engine lists them; runtime/scene draws them, and pages of other kinds can. */
#ifndef TARTAN_GEOMETRY_GUIDE_GUIDE_H
#define TARTAN_GEOMETRY_GUIDE_GUIDE_H

#include "runtime/base/error.h"
#include "runtime/geometry/vector.h"

typedef enum tn_guide_kind {
    TN_GUIDE_ATTRACTOR, /* one point */
    TN_GUIDE_REPELLER,  /* one point */
    TN_GUIDE_ARROW,     /* from its first point to its second */
    TN_GUIDE_LINE,      /* an open line */
    TN_GUIDE_AREA,      /* a flat polygon; those of one `whole` that follow each other are filled as one shape */
    TN_GUIDE_KIND_COUNT
} tn_guide_kind;

/* What it is about, for its colour. */
typedef enum tn_guide_subject { TN_GUIDE_FORCE, TN_GUIDE_BOUNDARY, TN_GUIDE_GROUND } tn_guide_subject;

typedef struct tn_guide {
    tn_guide_kind kind;
    tn_guide_subject subject;
    bool dashed;           /* a line of what may be passed */
    uint32_t whole;        /* of areas: which shape they belong to */
    uint32_t first, count; /* points */
    const char *name;      /* written beside it, with its value; or NULL. Not owned */
    double value;
} tn_guide;

/* Owns its arrays. Zero it to begin with; clear it in any case. */
typedef struct tn_guides {
    double (*points)[3];
    size_t point_count, point_capacity;
    tn_guide *items;
    size_t count, capacity;
} tn_guides;

/* Adds `guide` with these points; `first` and `count` are set here. False: out of memory. */
bool tn_guides_add(tn_guides *guides, tn_guide guide, const tn_vector *points, size_t count);
void tn_guides_clear(tn_guides *guides);

#endif
