/* The parts of `tartan grow`. */
#ifndef TARTAN_CLI_GROWTH_GROW_H
#define TARTAN_CLI_GROWTH_GROW_H

#include "cli/common/job.h"
#include "runtime/growth/picture/draw.h"
#include "runtime/growth/stats.h"
#include "runtime/growth/study.h"

/* What -o writes; the order of --format's words. */
/* --engine, in the order of its choices. */
typedef enum tn_grow_engine { TN_GROW_TEMPLATES, TN_GROW_VM } tn_grow_engine;

typedef enum tn_grow_format {
    TN_GROW_NONE,
    TN_GROW_OBJ,
    TN_GROW_PLY,
    TN_GROW_STL,
    TN_GROW_OFF,
    TN_GROW_OM,
    TN_GROW_GLB,
    TN_GROW_DXF,
    TN_GROW_SVG,
    TN_GROW_PNG,
    TN_GROW_PDF,
    TN_GROW_FORMAT_COUNT
} tn_grow_format;

#define TN_GROW_FORMATS "auto|obj|ply|stl|off|om|glb|dxf|svg|png|pdf"

/* Opens the file that grows: with options that a study could say, a study made of them, which uses the file. False
 * where that failed. */
bool tn_grow_open(tn_job *job);

/* What -o and --format ask for; false (reported) where they do not agree. */
bool tn_grow_format_of(tn_job *job, tn_grow_format *format);

/* Writes the growth as it stands: a mesh or a picture. */
void tn_grow_write(tn_job *job, const tn_growth *growth, const tn_study *study, tn_grow_format format,
                   const char *path);

/* Draws all views on one sheet. */
void tn_grow_sheet(tn_job *job, const tn_growth *growth, const tn_study *study, tn_view *const *views, size_t count,
                   tn_grow_format format);
tn_camera tn_grow_camera(const tn_settings *settings);

/* Writes the statistics of all steps to standard output. */
void tn_grow_stats(tn_job *job, const tn_growth_system *system, const tn_study *study, const tn_stats *stats,
                   size_t count);

/* Says why the branches of a step did not join. */
void tn_grow_explain(FILE *out, uint32_t step, const tn_growth_counts *counts);

#endif
