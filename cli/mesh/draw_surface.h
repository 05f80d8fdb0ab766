/* A picture of a surface of the file that a command has open. */
#ifndef TARTAN_CLI_MESH_DRAW_SURFACE_H
#define TARTAN_CLI_MESH_DRAW_SURFACE_H

#include "cli/common/job.h"

/* Options of `tartan draw` that are about surfaces. */
typedef struct tn_surface_settings {
    const char *surface;
    tn_option_number grid, width;
    tn_option_real azimuth, elevation;
} tn_surface_settings;

/* Does a field lie open, and not plan rules? */
bool tn_job_has_surface(const tn_job *job);

/* Meshes the surface, and draws it; what fails is reported. title: or NULL, for the surface's name. */
void tn_job_draw_surface(tn_job *job, const tn_surface_settings *settings, const char *title, uint32_t dpi,
                         unsigned threads, const char *output);

#define OPTIONS_SURFACE                                                                                                \
    TEXT("surface", 0, "NAME", surface.surface, "of fields: which surface (default: the last)"),                       \
        NUMBER("grid", 'n', "N", surface.grid, 2, 8192,                                                                \
               "of fields: samples on the longest side of the box (default: what the file says, or 50)"),              \
        REAL("azimuth", 0, "DEGREES", surface.azimuth, "of fields: where it is seen from, about z (default -60)"),     \
        REAL("elevation", 0, "DEGREES", surface.elevation,                                                             \
             "of fields: how high from: 90 is straight above (default 30)"),                                           \
        NUMBER("width", 0, "POINTS", surface.width, 50, 5000, "of fields: width of the picture (default 480)")

#endif
