/* Designs of a file: choosing one, what there is to say about them, their requirements, and how boxes were squashed.
 * `most`: the most boxes of a design, images counted; 0: the default (runtime/solid/measure.h). */
#ifndef TARTAN_DRIVER_SOLID_SOLID_H
#define TARTAN_DRIVER_SOLID_SOLID_H

#include <stdio.h>

#include "driver/open/open.h"
#include "runtime/scene/view.h"
#include "runtime/solid/measure.h"

/* The design of this name, or the file's only one where that is NULL. What is wrong is reported (E1513). */
tn_status tn_solid_choose(tn_opened *opened, const char *name, uint32_t *solid);

/* Warns of what a person who placed boxes may not have meant: W161 to W165, and E1512 where nothing is left. */
tn_status tn_solid_report(tn_opened *opened, uint32_t most);

typedef struct tn_solid_tally {
    size_t passed, failed; /* requirements */
} tn_solid_tally;

/* Measures the file's own designs and holds them to their requirements; those that fail are reported (E1514) with what
 * was found. TN_INVALID if one failed. `measured` is called with each design and the `count` measures that it asks for.
 */
typedef tn_status tn_solid_measured_take(void *context, const char *design, size_t count, const char *const *names,
                                         const double *values, tn_error *error);
tn_status tn_solid_tests_run(tn_opened *opened, uint32_t most, tn_solid_measured_take *measured, void *context,
                             tn_solid_tally *tally);

/* What a box is called in the place of an image: "leg'xz"; a box without a name is called by its number. */
typedef struct tn_box_words {
    char text[TN_NAME_MAX + 16];
} tn_box_words;

tn_box_words tn_box_named(const tn_module *module, uint32_t solid, uint32_t box, uint32_t image);

/* A squash in a line: "leg  by top  high y  7.4 -> 7". */
typedef struct tn_squash_words {
    char text[2 * sizeof(tn_box_words) + 80];
} tn_squash_words;

tn_squash_words tn_squash_told(const tn_module *module, uint32_t solid, const tn_squash *squash);

/* y is up in designs, and z in meshes and pictures: (x, y, z) becomes (x, -z, y). */
void tn_solid_turn_up(tn_mesh *mesh);

/* Takes a view of what is built: each box and its images in one colour. */
tn_status tn_built_view(const tn_built *built, const tn_camera *camera, tn_view **view, tn_error *error);

/* What is drawn of a design. */
typedef enum tn_solid_views {
    TN_SOLID_VIEW,     /* the design as it is built */
    TN_SOLID_EXPLODED, /* its boxes moved apart */
    TN_SOLID_BEFORE,   /* its boxes as they are written, beside what is built */
    TN_SOLID_SHEET,    /* plan, elevations and a view */
    TN_SOLID_HISTORY,  /* each step of squashing, in order */
} tn_solid_views;

typedef struct tn_solid_drawing {
    tn_solid_views views;
    tn_camera camera;
    const char *title;     /* NULL: the design's name and text */
    uint32_t columns, dpi; /* 0: as it suits; the default */
    uint32_t most;
} tn_solid_drawing;

/* Draws a design; what is wrong with it is reported. */
tn_status tn_solid_draw(tn_opened *opened, uint32_t solid, const tn_solid_drawing *drawing, tn_picture *to);

/* Reports an error about a design at its name. Returns the error's status. */
tn_status tn_solid_fail(tn_opened *opened, uint32_t solid, const tn_error *error);

#endif
