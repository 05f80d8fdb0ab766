/* Meshes a design of boxes: as one surface, or box by box. */
#include <stdlib.h>

#include "cli/mesh/mesh.h"
#include "driver/solid/solid.h"
#include "runtime/geometry/union/union.h"

/* y is up in designs, and z in files: (x, y, z) becomes (x, -z, y). */
static void turn_up(tn_mesh *mesh)
{
    for (size_t v = 0; v < mesh->vertex_count; v++) {
        double *p = mesh->positions + 3 * v, y = p[1];
        p[1] = -p[2];
        p[2] = y;
    }
}

static tn_status name_groups(const tn_job *job, uint32_t solid, const tn_built *built, tn_mesh *mesh, tn_error *error)
{
    uint32_t n = built->built.box_count;
    mesh->group_names = calloc(built->cell_count + 1, sizeof *mesh->group_names);
    if (!mesh->group_names)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < built->cell_count; i++) {
        tn_box_words words = tn_box_named(job->opened.module, solid, i % n, tn_design_image(&built->built, i / n));
        snprintf(mesh->group_names[i], sizeof mesh->group_names[i], "%.23s", words.text);
    }
    return TN_OK;
}

/* The union without groups, or each cell by itself with its name. */
static tn_status make_mesh(const tn_job *job, uint32_t solid, const tn_built *built, bool cells, tn_union *u,
                           tn_error *error)
{
    if (!cells) {
        tn_status status = tn_union_make(built->cells, built->cell_count, u, error);
        free(u->mesh.face_group);
        u->mesh.face_group = NULL;
        u->mesh.group_count = 0;
        return status;
    }
    *u = (tn_union){0};
    tn_status status = tn_union_cells(built->cells, built->cell_count, &u->mesh, error);
    return status == TN_OK ? name_groups(job, solid, built, &u->mesh, error) : status;
}

static void write_stats(tn_job *job, const tn_built *built, const tn_union *u)
{
    double values[TN_SOLID_MEASURED_COUNT] = {0};
    uint64_t asked = UINT64_C(1) << TN_SOLID_AREA_MEASURED | UINT64_C(1) << TN_SOLID_PARTS_MEASURED;
    tn_error error;
    tn_output output;
    if (tn_built_measure(built, asked, values, &error) != TN_OK) {
        tn_job_fail(job, &error);
        return;
    }
    if (!tn_job_output(job, NULL, &output))
        return;
    double volume = values[TN_SOLID_VOLUME_MEASURED], area = values[TN_SOLID_AREA_MEASURED],
           parts = values[TN_SOLID_PARTS_MEASURED];
    if (tn_mesh_settings_of(job)->stats == 2)
        fprintf(output.stream,
                "{\"vertices\":%zu,\"faces\":%zu,\"doubled\":%zu,\"boxes\":%zu,\"parts\":%.0f,\"volume\":%.17g,"
                "\"area\":%.17g}\n",
                u->mesh.vertex_count, u->mesh.face_count, u->doubled, built->cell_count, parts, volume, area);
    else
        fprintf(output.stream,
                "vertices  %zu\nfaces     %zu\ndoubled   %zu\nboxes     %zu\nparts     %.0f\nvolume    %.10g\narea     "
                " %.10g\n",
                u->mesh.vertex_count, u->mesh.face_count, u->doubled, built->cell_count, parts, volume, area);
    tn_job_commit(job, &output);
}

void tn_job_mesh_solid(tn_job *job, tn_out_format format)
{
    const tn_mesh_settings *settings = tn_mesh_settings_of(job);
    tn_built built = {0};
    tn_union u = {0};
    tn_error error;
    uint32_t solid;
    tn_status status = tn_solid_choose(&job->opened, settings->solid, &solid);
    tn_job_status(job, status);
    if (status != TN_OK)
        return;
    status = tn_built_make(job->opened.module, solid, &built, &error);
    if (status == TN_OK)
        status = make_mesh(job, solid, &built, settings->cells || format == TN_OUT_SCAD, &u, &error);
    if (status != TN_OK)
        tn_job_status(job, tn_solid_fail(&job->opened, solid, &error));
    if (status == TN_OK && (settings->stats || !settings->output))
        write_stats(job, &built, &u);
    if (status == TN_OK && settings->output) {
        char note[240];
        tn_mesh_note(job, job->opened.module->SOLID_records[solid].name, note, sizeof note);
        turn_up(&u.mesh);
        tn_mesh_write(job, &u.mesh, &(tn_mesh_file){.format = format, .note = note});
    }
    tn_union_clear(&u);
    tn_built_clear(&built);
}
