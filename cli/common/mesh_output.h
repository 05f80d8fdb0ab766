/* Mesh files as commands write them, by the options that grow and mesh share. */
#ifndef TARTAN_CLI_COMMON_MESH_OUTPUT_H
#define TARTAN_CLI_COMMON_MESH_OUTPUT_H

#include "cli/common/job.h"
#include "runtime/geometry/write.h"

/* What -o writes; the order of the words of `tartan grow --format`, which knows those up to PDF. */
typedef enum tn_out_format {
    TN_OUT_NONE,
    TN_OUT_OBJ,
    TN_OUT_PLY,
    TN_OUT_STL,
    TN_OUT_OFF,
    TN_OUT_OM,
    TN_OUT_GLB,
    TN_OUT_DXF,
    TN_OUT_SVG,
    TN_OUT_PNG,
    TN_OUT_PDF,
    TN_OUT_SCAD,
    TN_OUT_3MF,
    TN_OUT_FORMAT_COUNT
} tn_out_format;

/* The format that a file's name ends in; TN_OUT_NONE where it says nothing. */
tn_out_format tn_out_format_of(const char *path);

/* --subdivide, --smooth, --decimate, --triangulate. */
typedef struct tn_out_changes {
    tn_option_number subdivide, smooth, decimate;
    bool triangulate;
} tn_out_changes;

/* Does these in this order, and what the format needs; TN_OUT_NONE needs nothing. Says so where more triangles are left
 * than were asked for. */
tn_status tn_out_rework(tn_job *job, const tn_out_changes *changes, tn_out_format format, tn_mesh *mesh,
                        tn_error *error);

tn_status tn_out_mesh(const tn_mesh *mesh, tn_out_format format, const tn_mesh_style *style, FILE *out,
                      tn_error *error);

#endif
