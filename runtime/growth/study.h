/* How a module says that its rewrite system is to be grown: options, surroundings, goals. Where the module has no study
 * (a .hemls file), the defaults. */
#ifndef TARTAN_GROWTH_STUDY_H
#define TARTAN_GROWTH_STUDY_H

#include "runtime/geometry/boundary_mesh.h"
#include "runtime/geometry/mesh.h"
#include "runtime/growth/growth.h"
#include "runtime/growth/soundness.h"
#include "runtime/module/module.h"

typedef struct tn_study {
    const char *title; /* borrowed from the module; "" where it has none */
    uint32_t steps;
    tn_growth_options options;
    tn_environment environment;
    tn_fitness_goal goal;
    bool has_goal;
    tn_force *forces;
    tn_boundary *boundaries;
    tn_boundary_mesh **meshes; /* [boundary], NULL for other shapes */
    tn_measuring measuring;
    tn_boundary_mesh *target; /* what `distance-to` names, or NULL */
} tn_study;

/* Reads it, and the boundary meshes from their files by `reader` (tn_openmesh_reader of runtime/mesh); NULL: without
 * them, where only settings are asked for. A mesh's path
 * starts at the folder of `path`, the study or module that was opened; where there is none, at the folder in which the
 * study lay when it was compiled. Clear it in any case.
 */
tn_status tn_study_read(const tn_module *module, const char *path, const tn_mesh_reader *reader, tn_study *study,
                        tn_error *error);
void tn_study_clear(tn_study *study);

/* The first boundary from `from` on with a mesh that a surface is to stay inside of, and which has no inside, since it
 * is open or has edges of more than two faces; how many boundaries there are where there is none. */
uint32_t tn_study_open_boundary(const tn_study *study, uint32_t from);

/* Of the shapes of its boundary meshes; 0 if it has none. */
uint64_t tn_study_meshes_hash(const tn_study *study);

#endif
