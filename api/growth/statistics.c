/* The C interface to counts over a grown surface, and to the values of a study's expressions. */
#include <stdlib.h>
#include <string.h>

#include "api/growth/growth.h"
#include "runtime/growth/soundness.h"

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
