/* Pictures of faces in space: shaded, hidden faces removed (hidden.h), edges drawn, several views side by side.
 *
 * An engine lists the faces of what it has made (tn_display_list), takes a view of them, and draws views on a sheet.
 */
#ifndef TARTAN_SCENE_VIEW_H
#define TARTAN_SCENE_VIEW_H

#include "runtime/base/picture.h"
#include "runtime/base/watch.h"
#include "runtime/geometry/guide/guide.h"
#include "runtime/geometry/mesh.h"
#include "runtime/geometry/render.h"

#define TN_DRAWN_FACES_MAX 2000000u

/* What an edge is drawn as: the colour of its label, dark, or not at all. */
#define TN_EDGE_NONE UINT16_MAX
#define TN_EDGE_DARK (UINT16_MAX - 1)

/* What is looked at, z up. The arrays belong to the caller. Limits and messages are about `what`: "a picture of the
 * form". */
typedef struct tn_display_list {
    double (*points)[3]; /* [corner]; taking a view changes them */
    uint32_t *first;     /* [face_count + 1] each face's first corner; faces have three or more */
    uint16_t *edges;     /* [corner] label of the edge that starts there, or TN_EDGE_... */
    uint32_t *groups;    /* [face] whose colour it is filled with; NULL: all are cream */
    bool closed; /* faces are those of solids, counter-clockwise seen from outside: what looks away is not drawn */
    uint32_t face_count;
    uint32_t step;          /* written below each of several views where they have no labels */
    int threads;            /* 0: as many as there are processors */
    struct tn_watch *watch; /* or NULL */
    tn_guides guides;       /* drawn with it; owned */
    bool turns;             /* views from all around, at one elevation, shall have one scale and one middle */
} tn_display_list;

/* Room for so many; TN_MEMORY. Clear it in any case. E0820 for more than TN_DRAWN_FACES_MAX faces. */
tn_status tn_display_list_new(size_t faces, size_t corners, bool groups, tn_display_list *display, tn_error *error);
void tn_display_list_clear(tn_display_list *display);

/* The faces of a mesh, in the colours of its groups if it has any. Of triangles, the edges are drawn at which it bends
 * or two groups meet; of other faces, all edges. */
tn_status tn_display_list_of_mesh(const tn_mesh *mesh, tn_display_list *display, tn_error *error);

/* One view: what is drawn may be thrown away afterwards. */
typedef struct tn_view tn_view;

tn_status tn_view_take(tn_display_list *display, const tn_camera *camera, tn_view **view, tn_error *error);
void tn_view_free(tn_view *view);

/* How many faces pass through one another too often to be cut (hidden.h): they are drawn by their depth, which is only
 * nearly right. */
uint32_t tn_view_by_depth(const tn_view *view);

/* Names of labels, or of groups: what is not seen is not listed. */
typedef struct tn_legend {
    const char *(*name)(const void *names, uint32_t number);
    const void *names;
    uint32_t count;
    bool groups; /* names are those of groups, otherwise of labels of edges */
} tn_legend;

typedef struct tn_view_options {
    const char *title;         /* or NULL */
    const char *caption;       /* a line at the foot: how it was made; or NULL */
    uint32_t columns;          /* of a sheet; 0: about as many as rows */
    const char *const *labels; /* below each view; NULL: its step, if there are several */
    uint32_t dpi;
    bool scaled;      /* each view fills its cell, and a bar below it says how long a length of the model is there */
    bool fades;       /* lines fade where faces are small */
    tn_legend legend; /* count 0: none */
    const double (*palette)[3]; /* colours of groups, in sRGB; NULL: those of tn_group_colour */
} tn_view_options;

/* Paints a view on a canvas: model units times `scale` are points, and the eye's origin lies at (x, y). palette:
 * colours of groups, in sRGB; NULL: as in tn_views_draw. line: how thick edges are, in points; 0: none is drawn. */
typedef struct tn_view_place {
    double x, y, scale, line;
    double ambient; /* 0 to 1: this share of the light comes from all around */
    const double (*palette)[3];
    double fade; /* 0 to 1: how far colours of edges are from their own towards that of paper */
} tn_view_place;

struct tn_canvas;
void tn_view_paint(const struct tn_canvas *canvas, const tn_view *view, const tn_view_place *place);

/* Draws views side by side, all to one scale unless they are `scaled`. */
tn_status tn_views_draw(tn_view *const *views, size_t count, const tn_view_options *options, tn_picture *to,
                        tn_error *error);

#endif
