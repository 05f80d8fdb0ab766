/* Meshes a design of boxes: as one surface, or box by box. */
#include <stdlib.h>

#include "cli/mesh/mesh.h"
#include "driver/solid/solid.h"
#include "runtime/geometry/union/union.h"

static const char *name_of(const tn_job *job, uint32_t solid, const tn_built *built, uint32_t cell, bool image,
                           tn_box_words *words)
{
    uint32_t n = built->built.box_count;
    *words = tn_box_named(job->opened.module, solid, cell % n, image ? tn_design_image(&built->built, cell / n) : 0);
    return words->text;
}

/* Names groups, of which there are `count`; `images`: those of images say so. */
static tn_status name_groups(const tn_job *job, uint32_t solid, const tn_built *built, bool images, uint32_t count,
                             tn_mesh *mesh, tn_error *error)
{
    tn_box_words words;
    mesh->group_count = count;
    mesh->group_names = calloc(count + 1, sizeof *mesh->group_names);
    if (!mesh->group_names)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < count; i++)
        snprintf(mesh->group_names[i], sizeof mesh->group_names[i], "%.23s",
                 name_of(job, solid, built, i, images, &words));
    return TN_OK;
}

/* The union: with a group for each box and its images where the format has layers, else without groups. */
static tn_status make_union(const tn_job *job, uint32_t solid, const tn_built *built, bool layers, tn_union *u,
                            tn_error *error)
{
    tn_status status = tn_union_make(built->cells, built->cell_count, u, error);
    if (status != TN_OK)
        return status;
    for (size_t f = 0; f < u->mesh.face_count && layers; f++)
        u->mesh.face_group[f] %= built->built.box_count;
    if (layers)
        return name_groups(job, solid, built, false, built->built.box_count, &u->mesh, error);
    free(u->mesh.face_group);
    u->mesh.face_group = NULL;
    u->mesh.group_count = 0;
    return TN_OK;
}

/* Each cell by itself, with its name. */
static tn_status make_cells(const tn_job *job, uint32_t solid, const tn_built *built, tn_union *u, tn_error *error)
{
    *u = (tn_union){0};
    tn_status status = tn_union_cells(built->cells, built->cell_count, &u->mesh, error);
    return status == TN_OK ? name_groups(job, solid, built, true, (uint32_t)built->cell_count, &u->mesh, error)
                           : status;
}

static void write_stats(tn_job *job, uint32_t solid, const tn_built *built, const tn_union *u)
{
    double values[TN_SOLID_MEASURED_COUNT] = {0};
    tn_mesh_measures measures;
    tn_error error;
    tn_output output;
    tn_status status = tn_mesh_measure(&u->mesh, 0, &measures, &error);
    if (status == TN_OK)
        status = tn_built_measure(built, UINT64_C(1) << TN_SOLID_PARTS_MEASURED, values, &error);
    if (status != TN_OK)
        tn_job_fail(job, &error);
    if (status != TN_OK || !tn_job_output(job, NULL, &output))
        return;
    measures.parts = (uint32_t)values[TN_SOLID_PARTS_MEASURED]; /* a hollow has a surface of its own, but is no part */
    tn_mesh_stats stats = {.what = "solid",
                           .name = tn_text(job->opened.module, job->opened.module->SOLID_records[solid].name),
                           .unit = "",
                           .mesh = &u->mesh,
                           .measures = &measures,
                           .closed = true,
                           .counts = {{"boxes", built->cell_count, false}, {"doubled", u->doubled, false}},
                           .count_count = 2};
    tn_mesh_stats_write(output.stream, tn_mesh_settings_of(job)->stats == 2, &stats);
    tn_job_commit(job, &output);
}

/* STL tells vertices by their places: those that share one are moved apart, unless --exact leaves them. */
static tn_status pull_apart(tn_job *job, tn_mesh *mesh, tn_error *error)
{
    size_t moved;
    tn_status status = tn_mesh_pull_apart(mesh, 1e-5, &moved, error);
    if (status == TN_OK && moved)
        tn_job_note(job,
                    "%zu vertices that share a place moved into their own boxes by 0.00001 of the diagonal; --exact "
                    "leaves them",
                    moved);
    return status;
}

static tn_status write_mesh(tn_job *job, uint32_t solid, tn_mesh *mesh, tn_out_format format, tn_error *error)
{
    char note[TN_FORM_NOTE_SIZE];
    tn_status status = TN_OK;
    if (format == TN_OUT_STL && !tn_mesh_settings_of(job)->exact)
        status = pull_apart(job, mesh, error);
    if (status != TN_OK)
        return status;
    tn_form_note(&job->opened, job->opened.module->SOLID_records[solid].name, note);
    tn_solid_turn_up(mesh);
    tn_mesh_write(job, mesh,
                  &(tn_mesh_file){.format = format,
                                  .note = note,
                                  .unit = (tn_mesh_unit)job->opened.module->SOLID_records[solid].model});
    return TN_OK;
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
    status = tn_built_make(job->opened.module, solid, (uint32_t)settings->max_boxes.value, &built, &error);
    if (status == TN_OK)
        status = settings->cells || format == TN_OUT_SCAD
                     ? make_cells(job, solid, &built, &u, &error)
                     : make_union(job, solid, &built, format == TN_OUT_DXF, &u, &error);
    if (status == TN_OK)
        status = tn_out_rework(job, &settings->changes, format, &u.mesh, &error);
    if (status == TN_OK && (settings->stats || !settings->output))
        write_stats(job, solid, &built, &u);
    if (status == TN_OK && settings->output)
        status = write_mesh(job, solid, &u.mesh, format, &error);
    if (status != TN_OK)
        tn_job_status(job, tn_solid_fail(&job->opened, solid, &error));
    tn_union_clear(&u);
    tn_built_clear(&built);
}
