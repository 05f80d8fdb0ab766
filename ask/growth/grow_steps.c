/* The steps of a surface as rows of an answer: what each measures, and why branches did not join. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include "ask/growth/grow.h"
#include "runtime/base/array.h"
#include "runtime/growth/soundness.h"

static tn_status add_count(tn_list *to, uint64_t value, tn_error *error, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

static tn_status add_count(tn_list *to, uint64_t value, tn_error *error, const char *format, ...)
{
    tn_named_count *added = tn_message_add(&tn_message_named_count, to, error);
    if (!added)
        return TN_MEMORY;
    va_list args;
    va_start(args, format);
    added->value = value;
    if (vasprintf(&added->name, format, args) < 0)
        added->name = NULL;
    va_end(args);
    return added->name ? TN_OK : tn_fail_memory(error);
}

static tn_status add_real(tn_list *to, const char *name, double value, tn_error *error)
{
    tn_named_real *added = tn_message_add(&tn_message_named_real, to, error);
    if (!added)
        return TN_MEMORY;
    *added = (tn_named_real){name, value};
    return TN_OK;
}

static tn_status set_edges(const tn_growth_system *system, const tn_stats *stats, tn_grown_step *to, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < system->label_count && status == TN_OK; i++)
        if (stats->labels[i])
            status = add_count((tn_list *)&to->labels, stats->labels[i], error, "Edge%u",
                               (unsigned)system->labels[i].number);
    for (size_t i = 0; i < stats->age_count && status == TN_OK; i++)
        status = add_count((tn_list *)&to->ages, stats->ages[i].count, error, "Edge%u_%d",
                           (unsigned)system->labels[stats->ages[i].label].number, (int)stats->ages[i].age);
    for (size_t i = 0; i < stats->side_count && status == TN_OK; i++)
        status =
            add_count((tn_list *)&to->face_sides, stats->sides[i].count, error, "%u", (unsigned)stats->sides[i].sides);
    return status;
}

static tn_status set_fitness(const tn_fitness_goal *goal, const tn_fitness *fitness, tn_grown_step *to, tn_error *error)
{
    tn_list *list = (tn_list *)&to->fitness;
    tn_status status = TN_OK;
    for (int t = 0; t < TN_FITNESS_TERM_COUNT && status == TN_OK; t++)
        status = add_real(list, tn_fitness_term_name((tn_measured)t), tn_fitness_value(fitness, (tn_measured)t), error);
    for (uint32_t i = 0; i < goal->named_count && status == TN_OK; i++)
        status = add_real(list, goal->named[i].name, tn_named_value(&goal->named[i], fitness), error);
    to->has_lacking = goal->required_count > 0;
    to->lacking = to->has_lacking ? tn_fitness_lacking(fitness, goal) : 0;
    return status;
}

static tn_status set_measures(const tn_fitness *fitness, tn_grown_step *to, tn_error *error)
{
    tn_status status = TN_OK;
    to->has_measures = true;
    for (int i = TN_MEASURED_WIDTH; i < TN_MEASURED_COUNT && status == TN_OK; i++) {
        double value = fitness->further[i - TN_MEASURED_WIDTH];
        if (isfinite(value)) /* no distance without a target */
            status = add_real((tn_list *)&to->measures, tn_names_MEASURED[i], value, error);
    }
    return status;
}

static tn_status add_row(tn_growing *g, const tn_stats *stats, bool all, tn_error *error)
{
    tn_grown_step *row = TN_ADD(grown_step, g->grown->stats.steps, error);
    if (!row)
        return TN_MEMORY;
    row->step = stats->step;
    row->V = stats->vertices;
    row->E = stats->edges;
    row->F
    = stats->faces;
    tn_status status = set_edges(g->shown->system, stats, row, error);
    if (status == TN_OK)
        status = set_fitness(&g->shown->study.goal, &stats->fitness, row, error);
    return status == TN_OK && all ? set_measures(&stats->fitness, row, error) : status;
}

tn_status tn_grown_measure(tn_growing *g, tn_error *error)
{
    tn_grown_shown *shown = g->shown;
    bool all = g->request->measures == 0;
    if (!tn_array_reserve_from(&shown->stats, &shown->room, 16, shown->count, 1, sizeof *shown->stats))
        return tn_fail_memory(error);
    tn_stats *stats = &shown->stats[shown->count++];
    tn_status status = tn_stats_measure(g->growth, stats, error);
    if (status == TN_OK)
        status = tn_soundness_measure(g->growth, &shown->study.measuring, all ? UINT64_MAX : shown->study.goal.asked,
                                      &stats->fitness, error);
    return status == TN_OK ? add_row(g, stats, all, error) : status;
}

/* ---- why branches did not join */

tn_status tn_grown_explain(tn_growing *g, tn_error *error)
{
    static const char *const reasons[TN_JOIN_FAILURE_COUNT] = {
        "leave along the path or straight out of the surface",
        "point out of the surface",
        "find no branch of their label in their region",
        "find none that points against them within BranchAngle",
        "find none in front of them",
        "find none near enough",
        "find one only at a vertex that an edge leads to already",
        "find only ones that joined others, or that a join cut off",
    };
    const tn_growth_counts counts = tn_growth_last_counts(g->growth);
    tn_grown_joins *row = TN_ADD(grown_joins, g->grown->joins, error);
    if (!row)
        return TN_MEMORY;
    row->step = tn_growth_steps(g->growth);
    row->replaced = counts.rewrites;
    row->joined = counts.joins;
    row->kept = counts.refused;
    for (int i = 0; i < TN_JOIN_FAILURE_COUNT; i++) {
        if (counts.failures[i] == 0)
            continue;
        tn_unjoined_branches *some = TN_ADD(unjoined_branches, row->unjoined, error);
        if (!some)
            return TN_MEMORY;
        *some = (tn_unjoined_branches){counts.failures[i], reasons[i]};
    }
    return TN_OK;
}
