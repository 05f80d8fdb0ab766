/* The parts of `tartan grow`. */
#ifndef TARTAN_CLI_GROWTH_GROW_H
#define TARTAN_CLI_GROWTH_GROW_H

#include "cli/common/job.h"
#include "driver/mesh/mesh_file.h"
#include "runtime/growth/picture/draw.h"
#include "runtime/growth/stats.h"
#include "runtime/growth/study.h"

/* --engine, in the order of its choices. */
typedef enum tn_grow_engine { TN_GROW_TEMPLATES, TN_GROW_VM } tn_grow_engine;

#define TN_GROW_FORMATS "auto|obj|ply|stl|off|om|glb|dxf|svg|png|pdf"

/* What a study can say too, as the words of its statements. */
typedef struct tn_grow_statements {
    const char *steps, *scale, *start, *start_length, *seed, *branch_angle, *branch_length, *edge_limit, *sun,
        *distance_to;
    bool fixed_centre, fixed_perimeter, facing, mirror;
    tn_option_list attractors, repellers, gravity, boundaries, fitness;
} tn_grow_statements;

typedef struct tn_grow_settings {
    tn_settings common;
    tn_grow_statements said;
    const char *output, *until, *title, *overlay;
    int format;       /* of the words of TN_GROW_FORMATS */
    int engine;       /* a tn_grow_engine */
    int stats;        /* 0 not asked for, 1 table, 2 json */
    int up;           /* 0 z, 1 y */
    int surroundings; /* of a picture: 0 where there are any, 1 yes, 2 no */
    bool explain, each_step, sheet, triangulate, groups, lines, normals;
    tn_option_number subdivide, smooth, decimate, threads;
    tn_option_real azimuth, elevation;
    tn_option_number width, columns, dpi, turn; /* of a picture */
} tn_grow_settings;

/* Those of the job, which is one of `tartan grow`. */
static inline const tn_grow_settings *tn_grow_settings_of(const tn_job *job)
{
    return (const tn_grow_settings *)job->settings;
}

/* Opens the file that grows: with options that a study could say, a study made of them, which uses the file. False
 * where that failed. */
bool tn_grow_open(tn_job *job);

/* What -o and --format ask for; false (reported) where they do not agree. */
bool tn_grow_format_of(tn_job *job, tn_file_format *format);

/* Writes the growth as it stands: a mesh or a picture. */
void tn_grow_write(tn_job *job, const tn_growth *growth, const tn_study *study, tn_file_format format,
                   const char *path);

/* Draws all views on one sheet. */
void tn_grow_sheet(tn_job *job, const tn_growth *growth, const tn_study *study, tn_view *const *views, size_t count,
                   tn_file_format format);
/* Draws what was gathered of several steps. */
void tn_grow_overlay(tn_job *job, const tn_growth *growth, const tn_study *study, tn_sight *sight,
                     tn_file_format format);
/* Draws the surface from all around: into a folder, or (TN_FILE_PNG) as one picture that moves. */
void tn_grow_turn(tn_job *job, const tn_growth *growth, const tn_study *study, tn_file_format format);
tn_camera tn_grow_camera(const tn_grow_settings *settings);

/* Are surroundings drawn? Where it is not said: if there are any. */
bool tn_grow_surrounded(const tn_grow_settings *settings, const tn_study *study);

/* Writes the statistics of all steps to standard output. */
void tn_grow_stats(tn_job *job, const tn_growth_system *system, const tn_study *study, const tn_stats *stats,
                   size_t count);

/* Says why the branches of a step did not join. */
void tn_grow_explain(FILE *out, uint32_t step, const tn_growth_counts *counts);

#endif
