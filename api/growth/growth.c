/* The C interface to growing surfaces. */
#include "api/growth/growth.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/growth/faults.h"
#include "runtime/growth/growth.h"
#include "runtime/growth/soundness.h"
#include "runtime/growth/surface.h"

/* ---- how a surface grows: options and surroundings, from a module and from the caller */

/* How a surface of the C interface grows. */

_Static_assert((int)TARTAN_GRAVITY == (int)TN_GRAVITY && (int)TARTAN_SOLID == (int)TN_BOUNDARY_MESH &&
                   (int)TARTAN_SOFT == (int)TN_SOFT,
               "forces and boundaries are the same numbers");

/* What the module says, without surroundings. */
static void fill_options(const tn_study *study, tartan_growth_options *options)
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
    fill_options(&study, &own);
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

/* What the module says, with the caller's options in its place (NULL: none) and his surroundings besides. Clear the
 * study in any case. */
static tartan_status api_growth_study(const tartan_module *module, const tartan_growth_options *given, tn_study *study,
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

/* ---- counts over a grown surface, and the values of a study's expressions */

typedef struct named_value {
    const char *name; /* the module's */
    double value;
} named_value;

struct tartan_statistics {
    tartan_age_count *ages;
    size_t age_count;
    tartan_side_count *sides;
    size_t side_count;
    named_value *values;
    size_t value_count;
};

void tartan_statistics_free(tartan_statistics *statistics)
{
    if (!statistics)
        return;
    free(statistics->ages);
    free(statistics->sides);
    free(statistics->values);
    free(statistics);
}

static bool fill(const tartan_growth *growth, const tn_stats *stats, tartan_statistics *s)
{
    const tn_fitness_goal *goal = &growth->study.goal;
    s->ages = calloc(stats->age_count + 1, sizeof *s->ages);
    s->sides = calloc(stats->side_count + 1, sizeof *s->sides);
    s->values = calloc(goal->named_count + 1, sizeof *s->values);
    if (!s->ages || !s->sides || !s->values)
        return false;
    s->age_count = stats->age_count;
    for (size_t i = 0; i < s->age_count; i++)
        s->ages[i] = (tartan_age_count){growth->system->labels[stats->ages[i].label].number, stats->ages[i].age,
                                        stats->ages[i].count};
    s->side_count = stats->side_count;
    for (size_t i = 0; i < s->side_count; i++)
        s->sides[i] = (tartan_side_count){stats->sides[i].sides, stats->sides[i].count};
    s->value_count = goal->named_count;
    for (size_t i = 0; i < s->value_count; i++)
        s->values[i] = (named_value){goal->named[i].name, tn_named_value(&goal->named[i], &stats->fitness)};
    return true;
}

tartan_status tartan_growth_statistics(tartan_growth *growth, tartan_statistics **statistics, tartan_error *error)
{
    tn_stats stats = {0};
    tn_error found;
    tartan_status status = tn_api_growth_mend(growth, error);
    if (status != TARTAN_OK)
        return status;
    tartan_statistics *made = calloc(1, sizeof *made);
    tn_status measured = made ? tn_stats_measure(growth->growth, &stats, &found) : tn_fail_memory(&found);
    if (measured == TN_OK)
        measured = tn_soundness_measure(growth->growth, &growth->study.measuring, growth->study.goal.asked,
                                        &stats.fitness, &found);
    if (measured == TN_OK && !fill(growth, &stats, made))
        measured = tn_fail_memory(&found);
    tn_stats_clear(&stats);
    if (measured != TN_OK) {
        tartan_statistics_free(made);
        return tn_api_fail(&found, error);
    }
    *statistics = made;
    return TARTAN_OK;
}

const tartan_age_count *tartan_statistics_ages(const tartan_statistics *statistics, size_t *count)
{
    *count = statistics->age_count;
    return statistics->ages;
}

const tartan_side_count *tartan_statistics_sides(const tartan_statistics *statistics, size_t *count)
{
    *count = statistics->side_count;
    return statistics->sides;
}

bool tartan_statistics_expression(const tartan_statistics *statistics, size_t i, const char **name, double *value)
{
    if (i >= statistics->value_count)
        return false;
    *name = statistics->values[i].name;
    *value = statistics->values[i].value;
    return true;
}

/* ---- a growing surface */

static tartan_status make(const tartan_module *module, const tartan_growth_options *options, tartan_growth *growth,
                          tartan_error *error)
{
    tn_error found;
    tartan_status status = api_growth_study(module, options, &growth->study, error);
    if (status != TARTAN_OK)
        return status;
    tn_status made = tn_growth_system_read(module->module, &growth->system, &found);
    if (made == TN_OK)
        made =
            tn_growth_new(growth->system, &growth->study.environment, &growth->study.options, &growth->growth, &found);
    return made == TN_OK ? TARTAN_OK : tn_api_fail(&found, error);
}

tartan_status tartan_growth_new(const tartan_module *module, const tartan_growth_options *options,
                                tartan_growth **growth, tartan_error *error)
{
    tartan_growth *made = calloc(1, sizeof *made);
    if (!made)
        return tn_api_memory(error);
    tartan_status status = make(module, options, made, error);
    if (status == TARTAN_OK)
        *growth = made;
    else
        tartan_growth_free(made);
    return status;
}

void tartan_growth_free(tartan_growth *growth)
{
    if (!growth)
        return;
    tn_growth_free(growth->growth);
    tn_growth_system_free(growth->system);
    tn_study_clear(&growth->study);
    free(growth);
}

/* ---- growing */

/* Back to the seed and to so many steps, watched or not. */
static tn_status regrow(tartan_growth *growth, uint32_t steps, tn_error *error)
{
    growth->broken = true;
    tn_status status = tn_growth_regrow(growth->growth, steps, error);
    if (status == TN_OK) {
        growth->broken = false;
        growth->steps = steps;
    }
    return status;
}

tartan_status tn_api_growth_mend(tartan_growth *growth, tartan_error *error)
{
    tn_error found;
    if (!growth)
        return tn_api_missing(error, "growth");
    if (!growth->broken || regrow(growth, growth->steps, &found) == TN_OK)
        return TARTAN_OK;
    return tn_api_fail(&found, error);
}

static tn_status step_to(tartan_growth *growth, uint32_t steps, tn_watch *watch, tn_error *error)
{
    tn_status status = growth->broken ? regrow(growth, growth->steps, error) : TN_OK;
    while (status == TN_OK && growth->steps < steps) {
        tn_watch_tell(watch, growth->steps, steps);
        status = tn_watch_check(watch, error);
        if (status != TN_OK)
            return status; /* nothing has happened to the map */
        status = tn_growth_step(growth->growth, error);
        growth->broken = status != TN_OK;
        growth->steps += status == TN_OK;
    }
    tn_watch_tell(watch, growth->steps, steps);
    return status;
}

tartan_status tartan_growth_grow(tartan_growth *growth, uint32_t steps, const tartan_watch *given, tartan_error *error)
{
    tn_watch watch;
    tn_error found;
    if (!growth)
        return tn_api_missing(error, "growth");
    if (steps < growth->steps)
        return tn_api_refuse(error, TARTAN_INVALID, "the surface has grown %u steps already", (unsigned)growth->steps);
    tartan_status status = tn_api_watch(given, &watch, error);
    if (status != TARTAN_OK)
        return status;
    tn_growth_watch(growth->growth, &watch);
    tn_status grown = step_to(growth, steps, &watch, &found);
    tn_growth_watch(growth->growth, NULL);
    return grown == TN_OK ? TARTAN_OK : tn_api_fail(&found, error);
}

tartan_status tartan_growth_restart(tartan_growth *growth, tartan_error *error)
{
    tn_error found;
    if (!growth)
        return tn_api_missing(error, "growth");
    return regrow(growth, 0, &found) == TN_OK ? TARTAN_OK : tn_api_fail(&found, error);
}

uint32_t tartan_growth_steps(const tartan_growth *growth)
{
    return growth->steps;
}

bool tartan_growth_at_rest(const tartan_growth *growth)
{
    return !growth->broken && tn_growth_at_rest(growth->growth);
}

/* ---- looking at it */

tartan_status tartan_growth_mesh(tartan_growth *growth, const tartan_mesh_options *given, tartan_mesh **mesh,
                                 tartan_error *error)
{
    tartan_mesh_options options;
    tn_mesh made;
    tn_error found;
    tartan_status status = TN_API_TAKE(tartan_mesh_options, &options, given, error);
    if (status == TARTAN_OK)
        status = tn_api_growth_mend(growth, error);
    if (status != TARTAN_OK)
        return status;
    const tn_surface_options own = {.groups = options.groups, .lines = options.lines, .layers = options.layers};
    if (tn_surface_mesh(growth->growth, &own, &made, &found) == TN_OK)
        return tn_api_mesh(&made, mesh, error);
    tn_mesh_clear(&made);
    return tn_api_fail(&found, error);
}

tartan_status tartan_growth_measure(tartan_growth *growth, tartan_measures *measures, tartan_error *error)
{
    tn_stats stats = {0};
    tn_faults faults;
    tn_error found;
    tartan_status status = tn_api_growth_mend(growth, error);
    if (status != TARTAN_OK)
        return status;
    tn_status measured = tn_stats_measure(growth->growth, &stats, &found);
    if (measured == TN_OK)
        measured = tn_soundness_measure(growth->growth, &growth->study.measuring, growth->study.goal.asked,
                                        &stats.fitness, &found);
    if (measured == TN_OK)
        measured = tn_faults_find(growth->growth, &faults, &found);
    if (measured != TN_OK) {
        tn_stats_clear(&stats);
        return tn_api_fail(&found, error);
    }
    const tn_fitness *f = &stats.fitness;
    const tn_study *study = &growth->study;
    tartan_measures own = {.step = stats.step,
                           .vertices = stats.vertices,
                           .edges = stats.edges,
                           .faces = stats.faces,
                           .low = {stats.low[0], stats.low[1], stats.low[2]},
                           .high = {stats.high[0], stats.high[1], stats.high[2]},
                           .extent = f->size,
                           .smoothness = f->smoothness,
                           .soft_boundary_nodes = f->soft_boundary_nodes,
                           .subdivisions = f->subdivisions,
                           .symmetry = f->symmetry,
                           .undulation = f->undulation,
                           .has_fitness = study->has_goal,
                           .crossed_faces = faults.crossed.count,
                           .inverted_faces = faults.inverted.count};
    if (study->has_goal)
        own.fitness = tn_fitness_total(f, &study->goal, study->options.start_length);
    tn_stats_clear(&stats);
    return TN_API_GIVE(tartan_measures, measures, &own, error);
}

tartan_status tartan_growth_last_counts(tartan_growth *growth, tartan_growth_counts *counts, tartan_error *error)
{
    tartan_status status = tn_api_growth_mend(growth, error);
    if (status != TARTAN_OK)
        return status;
    tn_growth_counts last = tn_growth_last_counts(growth->growth);
    tartan_growth_counts own = {.replaced = last.rewrites,
                                .joined = last.joins,
                                .kept_chains = last.refused,
                                .along = last.failures[TN_FAIL_SIDE],
                                .outside = last.failures[TN_FAIL_OUTER],
                                .no_label = last.failures[TN_FAIL_LABEL],
                                .no_angle = last.failures[TN_FAIL_ANGLE],
                                .not_facing = last.failures[TN_FAIL_FACING],
                                .too_far = last.failures[TN_FAIL_DISTANCE],
                                .adjacent = last.failures[TN_FAIL_ADJACENT],
                                .taken = last.failures[TN_FAIL_TAKEN]};
    return TN_API_GIVE(tartan_growth_counts, counts, &own, error);
}
