/* The C interface to meshing implicit surfaces. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/geometry/mesh.h"
#include "runtime/field/contour.h"
#include "runtime/field/field.h"

enum { SAMPLES_LEAST = 2, SAMPLES_MOST = 8192 };

/* What is meshed, and the meshes that it measures distances from. */
typedef struct surface {
    tn_module module; /* the caller's, with his watch */
    tn_watch watch;
    tn_field_meshes meshes;
    tn_field field;
} surface;

static tartan_status find(const tn_module *module, const char *name, uint32_t *index, tartan_error *error)
{
    if (module->SURFACE_count == 0)
        return tn_api_refuse(error, TARTAN_INVALID, "the module has no surface");
    *index = (uint32_t)module->SURFACE_count - 1;
    if (!name)
        return TARTAN_OK;
    for (*index = 0; *index < module->SURFACE_count; ++*index)
        if (strcmp(tn_text(module, module->SURFACE_records[*index].name), name) == 0)
            return TARTAN_OK;
    const char **names = calloc(module->SURFACE_count, sizeof *names);
    for (size_t i = 0; names && i < module->SURFACE_count; i++)
        names[i] = tn_text(module, module->SURFACE_records[i].name);
    return tn_api_unknown(error, "surface", name, names, module->SURFACE_count);
}

/* A path in the folder that the file's meshes lie in. */
static char *path_in(const tn_module *module, const char *folder)
{
    char *path = NULL;
    const char *compiled = module->SOURCE_count ? tn_text(module, module->SOURCE_records[0].path) : "";
    int size = folder ? asprintf(&path, "%s/field", folder) : asprintf(&path, "%s", compiled);
    return size < 0 ? NULL : path;
}

static tn_status read(surface *s, uint32_t index, tartan_field_options *options, tn_error *error)
{
    tn_mesh_reader reader = tn_api_mesh_reader(&options->read_mesh);
    char *path = path_in(&s->module, options->folder);
    tn_status status =
        path ? tn_field_meshes_read(&s->module, &reader, path, &s->meshes, error) : tn_fail_memory(error);
    free(path);
    return status == TN_OK ? tn_field_read(&s->module, index, s->meshes.items, &s->field, error) : status;
}

static tartan_status begin(const tartan_module *module, const tartan_field_options *given, const tartan_watch *watch,
                           tartan_field_options *options, surface *s, uint32_t *index, tartan_error *error)
{
    if (!module)
        return tn_api_missing(error, "module");
    tartan_status status = TN_API_TAKE(tartan_field_options, options, given, error);
    if (status == TARTAN_OK && options->samples &&
        (options->samples < SAMPLES_LEAST || options->samples > SAMPLES_MOST))
        status = tn_api_refuse(error, TARTAN_INVALID, "a grid has %d to %d samples on its longest side, not %u",
                               SAMPLES_LEAST, SAMPLES_MOST, (unsigned)options->samples);
    if (status == TARTAN_OK)
        status = find(module->module, options->surface, index, error);
    if (status == TARTAN_OK)
        status = tn_api_watch(watch, &s->watch, error);
    s->module = *module->module;
    s->module.watch = &s->watch;
    return status;
}

static tartan_field_findings findings_of(const tn_contour *c)
{
    tartan_field_findings f = tartan_field_findings_init();
    f.inside = c->inside;
    f.outside = c->outside;
    f.cut = c->cut;
    f.no_values = c->no_values;
    f.jumps = c->jumps;
    memcpy(f.no_value, c->no_value, sizeof f.no_value);
    memcpy(f.jump, c->jump, sizeof f.jump);
    f.spacing = c->spacing;
    f.sharp = c->sharp;
    return f;
}

static tartan_status make(surface *s, const tartan_field_options *options, tartan_mesh **mesh,
                          tartan_field_findings *findings, tartan_error *error)
{
    tn_contour_options own = {.threads = options->threads > TARTAN_THREADS_MAX ? TARTAN_THREADS_MAX : options->threads,
                              .open = options->open,
                              .jumps_open = options->jumps_open,
                              .sharp = options->sharp,
                              .samples = options->sample_limit,
                              .triangles = options->triangle_limit};
    tn_field_grid grid = tn_field_grid_of(&s->field, options->samples);
    tn_contour contour;
    tn_error found;
    tartan_status status =
        tn_contour_new(&s->field, &grid, &own, &contour, &found) == TN_OK ? TARTAN_OK : tn_api_fail(&found, error);
    tartan_field_findings made = findings_of(&contour);
    if (status == TARTAN_OK && findings)
        status = TN_API_GIVE(tartan_field_findings, findings, &made, error);
    if (status == TARTAN_OK) {
        status = tn_api_mesh(&contour.mesh, mesh, error);
        contour.mesh = (tn_mesh){0};
    }
    if (status == TARTAN_OK)
        (*mesh)->unit = (tn_mesh_unit)s->field.record->unit;
    tn_contour_clear(&contour);
    return status;
}

tartan_status tartan_field_mesh(const tartan_module *module, const tartan_field_options *given,
                                const tartan_watch *watch, tartan_mesh **mesh, tartan_field_findings *findings,
                                tartan_error *error)
{
    tartan_field_options options;
    surface s = {0};
    uint32_t index = 0;
    tn_error found;
    if (!mesh)
        return tn_api_missing(error, "room for the mesh");
    tartan_status status = begin(module, given, watch, &options, &s, &index, error);
    if (status == TARTAN_OK && read(&s, index, &options, &found) != TN_OK)
        status = tn_api_fail(&found, error);
    if (status == TARTAN_OK)
        status = make(&s, &options, mesh, findings, error);
    tn_field_clear(&s.field);
    tn_field_meshes_clear(&s.meshes);
    return status;
}
