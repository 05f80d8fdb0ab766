/* What taking a view leaves for drawing it. Internal to runtime/scene. */
#ifndef TARTAN_SCENE_SEEN_H
#define TARTAN_SCENE_SEEN_H

#include "runtime/draw/paint.h"
#include "runtime/scene/view.h"

#define TN_NO_GROUP UINT32_MAX

/* An edge between two faces that are filled together: it has neither a line nor a seam. */
#define TN_EDGE_JOINED (UINT16_MAX - 2)

/* Where no line ends at the end of a seam. */
#define TN_MEETS_NOTHING (-2.0f)

/* An angle whose cosine is more than this is sharp: lines are mended there. */
#define TN_SHARP 0.7f

/* A face, or a piece of one: what is needed to paint it. */
typedef struct tn_seen_face {
    uint32_t first, size; /* corners */
    uint32_t group;       /* or TN_NO_GROUP */
    float light;          /* 0 dark .. 1 */
    uint64_t plane;       /* faces of one number lie in one plane */
    bool joined;          /* it is filled together with the one before it */
} tn_seen_face;

/* A line that ends at a corner, into which the filling there reaches. */
typedef struct tn_mend {
    uint32_t corner;
    uint16_t edge;
    float along[2], length; /* where the line goes from there, and how far */
    float tangent;          /* of the angle to the filling, which is at its left where that is positive */
} tn_mend;

struct tn_view {
    tn_seen_face *faces; /* the farthest first */
    size_t face_count;
    float (*points)[2]; /* [corner] in the picture's plane, y up */
    uint16_t *edges; /* [corner] of the edge that starts there: as in tn_display_list; TN_EDGE_NONE if a face was cut */
    float *sharpest; /* [2 * corner] of the seam that starts there, at its ends: the cosine of the sharpest angle
                        between    it and a line, or TN_MEETS_NOTHING; NULL: there are no seams */
    tn_mend *mends;  /* by corner; NULL: there are none */
    size_t mend_count;
    double low[2], high[2];
    double extent[2]; /* of the form alone: guides and views from all around make the frame larger */
    double width;
    uint32_t step;
    uint32_t by_depth;
    tn_guides guides; /* as the eye sees them: to the right, up, towards it */
};

/* The colour of a face without a palette. Faces of groups are paler than lines of their colour, so that edges stand
 * out. */
void tn_view_face_colour(tn_paint *paint, const tn_seen_face *face);

/* Joins faces that can be filled together; changes their order. */
tn_status tn_view_join(tn_view *view, tn_error *error);

/* Finds where lines end at seams and bare corners, once faces are joined. depths: [corner] towards the eye, in model
 * units. */
tn_status tn_view_find_meets(tn_view *view, const float *depths, tn_error *error);

#endif
