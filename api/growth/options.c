/* The C interface to how a surface grows: options and surroundings, from a module and from the caller. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/growth/options.h"
#include "runtime/base/array.h"

_Static_assert((int)TARTAN_GRAVITY == (int)TN_GRAVITY && (int)TARTAN_SOLID == (int)TN_BOUNDARY_MESH &&
                   (int)TARTAN_SOFT == (int)TN_SOFT,
               "forces and boundaries are the same numbers");

/* What the module says, without surroundings. */
static void fill(const tn_study *study, tartan_growth_options *options)
{
    const tn_growth_options *o = &study->options;
    options->steps = study->steps;
    memcpy(options->scale, o->scale, sizeof options->scale);
    memcpy(options->start, o->start, sizeof options->start);
    options->start_length = o->start_length;
    options->branch_angle = o->branch_angle;
    options->branch_length = o->branch_length;
    options->fixed_centre = o->fixed_centre;
    options->fixed_perimeter = o->fixed_perimeter;
    options->facing = o->facing;
    options->mirror = o->mirror;
    options->seed = o->seed;
    options->edge_limit = o->edge_limit;
}

/* A path in the folder that the study's meshes lie in; the caller frees it. */
static char *study_path(const tn_module *module, const char *folder)
{
    char *path = NULL;
    uint32_t file = module->STUDY_count ? module->STUDY_records[0].file : 0;
    const char *compiled = file < module->SOURCE_count ? tn_text(module, module->SOURCE_records[file].path) : "";
    int size = folder ? asprintf(&path, "%s/study", folder) : asprintf(&path, "%s", compiled);
    return size < 0 ? NULL : path;
}

/* reader NULL: without the meshes. */
static tartan_status read_study(const tartan_module *module, const char *folder, const tn_mesh_reader *reader,
                                tn_study *study, tartan_error *error)
{
    if (!module)
        return tn_api_missing(error, "module");
    if (module->module->GROWTH_count == 0)
        return tn_api_refuse(error, TARTAN_INVALID, "the module has no rewrite system: nothing grows");
    char *path = study_path(module->module, folder);
    if (!path)
        return tn_api_memory(error);
    tn_error found;
    tn_status status = tn_study_read(module->module, path, reader, study, &found);
    free(path);
    if (status == TN_OK)
        return TARTAN_OK;
    tn_study_clear(study);
    return tn_api_fail(&found, error);
}

tartan_status tartan_growth_options_of(const tartan_module *module, tartan_growth_options *options, tartan_error *error)
{
    tartan_growth_options own;
    tn_study study;
    if (!options)
        return tn_api_missing(error, "options");
    tartan_status status = TN_API_TAKE(tartan_growth_options, &own, options, error);
    if (status == TARTAN_OK)
        status = read_study(module, own.folder, NULL, &study, error);
    if (status != TARTAN_OK)
        return status;
    fill(&study, &own);
    tn_study_clear(&study);
    return TN_API_GIVE(tartan_growth_options, options, &own, error);
}

/* ---- surroundings */

static bool are_finite(const double *values, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!(fabs(values[i]) <= TN_COORDINATE_MAX))
            return false;
    return true;
}

static tartan_status add_force(const tartan_force *given, tn_study *study, tartan_error *error)
{
    if ((unsigned)given->kind >= TN_FORCE_KIND_COUNT || !are_finite(given->at, 3) || !are_finite(&given->strength, 1) ||
        !are_finite(&given->exponent, 1))
        return tn_api_refuse(error, TARTAN_INVALID, "a force is of no kind, or has a number that is not finite");
    study->forces[study->environment.force_count++] =
        (tn_force){given->kind, {given->at[0], given->at[1], given->at[2]}, given->strength, given->exponent};
    return TARTAN_OK;
}

static tartan_status make_solid(const tartan_mesh *given, tn_boundary_mesh **solid, tartan_error *error)
{
    tn_mesh copy;
    tn_error found;
    if (!given)
        return tn_api_missing(error, "mesh of a boundary");
    tn_status status = tn_mesh_copy(&given->mesh, &copy, &found);
    if (status == TN_OK)
        status = tn_mesh_triangulate(&copy, &found);
    if (status == TN_OK)
        status = tn_boundary_mesh_new(copy.positions, copy.vertex_count, copy.corners, copy.face_count, solid, &found);
    tn_mesh_clear(&copy);
    return status == TN_OK ? TARTAN_OK : tn_api_fail(&found, error);
}

/* A plane's normal is a unit vector for the engine. */
static bool fit_shape(tn_boundary *b)
{
    double length = sqrt(b->b[0] * b->b[0] + b->b[1] * b->b[1] + b->b[2] * b->b[2]);
    switch (b->kind) {
    case TN_BOUNDARY_PLANE:
        for (int k = 0; k < 3 && length > 0; k++)
            b->b[k] /= length;
        return length > 0;
    case TN_BOUNDARY_BOX:
        return b->a[0] < b->b[0] && b->a[1] < b->b[1] && b->a[2] < b->b[2];
    case TN_BOUNDARY_SPHERE:
        return b->radius > 0;
    default:
        return true;
    }
}

static tartan_status add_boundary(const tartan_boundary *given, tn_study *study, tartan_error *error)
{
    uint32_t index = study->environment.boundary_count;
    tn_boundary made = {.kind = given->kind,
                        .mode = given->mode,
                        .inside = given->inside,
                        .a = {given->a[0], given->a[1], given->a[2]},
                        .b = {given->b[0], given->b[1], given->b[2]},
                        .radius = given->radius};
    if (made.kind >= TN_BOUNDARY_KIND_COUNT || made.mode >= TN_BOUNDARY_MODE_COUNT || !are_finite(made.a, 3) ||
        !are_finite(made.b, 3) || !are_finite(&made.radius, 1) || !fit_shape(&made))
        return tn_api_refuse(error, TARTAN_INVALID,
                             "boundary %u is of no kind, or encloses nothing, or has a number that is not finite",
                             index + 1);
    if (made.kind == TN_BOUNDARY_MESH) {
        tartan_status status = make_solid(given->mesh, &study->meshes[index], error);
        if (status != TARTAN_OK)
            return status;
        made.mesh = study->meshes[index];
    }
    study->boundaries[index] = made;
    study->environment.boundary_count++;
    return TARTAN_OK;
}

/* Room for so many more of each. */
static bool make_room(tn_study *study, size_t forces, size_t boundaries)
{
    tn_environment *e = &study->environment;
    bool fine = tn_array_resize(&study->forces, e->force_count + forces, sizeof *study->forces) &&
                tn_array_resize(&study->boundaries, e->boundary_count + boundaries, sizeof *study->boundaries) &&
                tn_array_resize(&study->meshes, e->boundary_count + boundaries, sizeof *study->meshes);
    if (fine)
        memset(study->meshes + e->boundary_count, 0, boundaries * sizeof *study->meshes);
    e->forces = study->forces;
    e->boundaries = study->boundaries;
    return fine;
}

static void leave_out(tn_study *study)
{
    for (uint32_t i = 0; i < study->environment.boundary_count; i++) {
        tn_boundary_mesh_free(study->meshes[i]);
        study->meshes[i] = NULL;
    }
    study->environment.force_count = study->environment.boundary_count = 0;
}

static tartan_status surround(const tartan_growth_options *options, tn_study *study, tartan_error *error)
{
    if ((options->force_count && !options->forces) || (options->boundary_count && !options->boundaries))
        return tn_api_missing(error, "array of forces or boundaries");
    if (options->force_count > TN_SURROUNDINGS_MAX || options->boundary_count > TN_SURROUNDINGS_MAX)
        return tn_api_refuse(error, TARTAN_LIMIT, "there are more than %u forces or boundaries", TN_SURROUNDINGS_MAX);
    if (options->bare)
        leave_out(study);
    if (!make_room(study, options->force_count, options->boundary_count))
        return tn_api_memory(error);
    tartan_status status = TARTAN_OK;
    for (size_t i = 0; i < options->force_count && status == TARTAN_OK; i++)
        status = add_force(&options->forces[i], study, error);
    for (size_t i = 0; i < options->boundary_count && status == TARTAN_OK; i++)
        status = add_boundary(&options->boundaries[i], study, error);
    return status;
}

static void set(const tartan_growth_options *options, tn_growth_options *o)
{
    memcpy(o->scale, options->scale, sizeof o->scale);
    memcpy(o->start, options->start, sizeof o->start);
    o->start_length = options->start_length;
    o->branch_angle = options->branch_angle;
    o->branch_length = options->branch_length;
    o->fixed_centre = options->fixed_centre;
    o->fixed_perimeter = options->fixed_perimeter;
    o->facing = options->facing;
    o->mirror = options->mirror;
    o->explain = options->explain;
    o->seed = options->seed;
    o->edge_limit = options->edge_limit;
    o->threads = (int)(options->threads > TARTAN_THREADS_MAX ? TARTAN_THREADS_MAX : options->threads);
}

tartan_status tn_api_growth_study(const tartan_module *module, const tartan_growth_options *given, tn_study *study,
                                  tartan_error *error)
{
    tartan_growth_options options;
    *study = (tn_study){0};
    tartan_status status = TN_API_TAKE(tartan_growth_options, &options, given, error);
    tn_mesh_reader reader = tn_api_mesh_reader(&options.read_mesh);
    if (status == TARTAN_OK)
        status = read_study(module, options.folder, &reader, study, error);
    if (status != TARTAN_OK || !given)
        return status;
    set(&options, &study->options);
    return surround(&options, study, error);
}
