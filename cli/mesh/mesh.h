/* What `tartan mesh` shows. */
#ifndef TARTAN_CLI_MESH_MESH_H
#define TARTAN_CLI_MESH_MESH_H

#include "ask/form/mesh.h"
#include "cli/common/job.h"

/* What a mesh measures, as a table. */
void tn_mesh_table(const tn_measured_mesh *measured, FILE *out);

/* Writes the field, its gradient and whether it is inside for each line of a file, or (-) of standard input. */
void tn_mesh_write_points(tn_job *job, const tn_mesh_request *request, const char *path);

#endif
