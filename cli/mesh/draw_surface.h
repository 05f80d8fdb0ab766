/* A picture of a surface of the file that a command has open. */
#ifndef TARTAN_CLI_MESH_DRAW_SURFACE_H
#define TARTAN_CLI_MESH_DRAW_SURFACE_H

#include "cli/common/job.h"
#include "runtime/scene/draw_mesh.h"

/* What is drawn. */
typedef struct tn_drawn_surface {
    const char *name; /* NULL: the last of the file */
    uint32_t grid;    /* samples, 0: what the file says */
    bool sharp;       /* with sharp edges */
    bool open;        /* it ends at the box */
} tn_drawn_surface;

/* Meshes the surface and draws it as `picture` says: without a title, by its own text, and with a line at its foot.
 * What fails is reported. */
void tn_job_draw_surface(tn_job *job, const tn_drawn_surface *surface, const tn_mesh_picture *picture,
                         const char *output);

#endif
