/* The C interface to growing surfaces. */
#include "api/growth/growth.h"

#include <stdlib.h>
#include <string.h>

#include "api/growth/options.h"
#include "runtime/growth/faults.h"
#include "runtime/growth/growth.h"
#include "runtime/growth/soundness.h"

static tartan_status make(const tartan_module *module, const tartan_growth_options *options, tartan_growth *growth,
                          tartan_error *error)
{
    tn_error found;
    tartan_status status = tn_api_growth_study(module, options, &growth->study, error);
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
