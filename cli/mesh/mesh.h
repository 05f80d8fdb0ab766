/* The parts of `tartan mesh`: surfaces of fields, and designs of boxes. */
#ifndef TARTAN_CLI_MESH_MESH_H
#define TARTAN_CLI_MESH_MESH_H

#include "ask/form/form.h"
#include "cli/common/job.h"
#include "cli/common/mesh_output.h"
#include "driver/field/field.h"
#include "runtime/geometry/measure.h"

typedef struct tn_mesh_settings {
    tn_settings common;
    const char *output, *surface, *solid, *points;
    int format; /* of --format's words */
    int engine; /* 0 tape, 1 vm */
    int stats;  /* 0 not asked for, 1 table, 2 json */
    int up;     /* 0 z, 1 y */
    int jumps;  /* 0 closed, 1 open */
    bool open, normals, cells, exact, bounds, thickness, sharp, times;
    tn_out_changes changes;
    tn_option_number grid, max_samples, max_triangles, max_boxes, threads;
} tn_mesh_settings;

/* Those of the job, which is one of `tartan mesh`. */
static inline const tn_mesh_settings *tn_mesh_settings_of(const tn_job *job)
{
    return (const tn_mesh_settings *)job->settings;
}

/* What a mesh's file says beside the mesh. */
typedef struct tn_mesh_file {
    tn_out_format format;
    const char *note; /* how it was made */
    tn_mesh_unit unit;
    const tn_field *field; /* whose gradient gives the normals, or NULL */
    double spacing;        /* of its grid */
} tn_mesh_file;

/* Writes a mesh to -o. */
void tn_mesh_write(tn_job *job, tn_mesh *mesh, const tn_mesh_file *file);

/* Meshes a design of boxes of the file that is open, and reports what fails. */
void tn_job_mesh_solid(tn_job *job, tn_out_format format);

/* What there is to say of a mesh. */
typedef struct tn_mesh_stats {
    const char *what, *name; /* "surface" or "solid", and what it is called */
    const char *unit;        /* or "" */
    const tn_mesh *mesh;
    const tn_mesh_measures *measures;
    bool closed; /* otherwise it has no volume */
    struct {
        const char *key;
        uint64_t count;
        bool json_only;
    } counts[5]; /* what only surfaces, or only designs of boxes, have */
    size_t count_count;
    const double *proven;    /* two numbers that the volume of the form itself lies between, or NULL */
    const double *seconds;   /* that samples, vertices and triangles took, or NULL */
    const double *thickness; /* the least, and that of which a hundredth of the surface is thinner; or NULL */
} tn_mesh_stats;

/* Writes it to a stream: a table, or JSON. */
void tn_mesh_stats_write(FILE *out, bool json, const tn_mesh_stats *stats);

/* Does --points: f, its gradient and whether it is inside, for each line of a file. */
void tn_mesh_points(tn_job *job, const tn_open_field *open);

#endif
