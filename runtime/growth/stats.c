/* Measures a grown surface: counts and fitness terms. */
#include "runtime/growth/stats.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/hash_table.h"
#include "runtime/number/run.h"

void tn_stats_clear(tn_stats *stats)
{
    free(stats->labels);
    free(stats->ages);
    free(stats->sides);
    *stats = (tn_stats){0};
}

/* ---- counts of few different values among many */

typedef struct value_count {
    uint32_t key;
    uint64_t count;
} value_count;

typedef struct counter {
    value_count *items;
    size_t used, capacity;
    tn_hash_table index;
} counter;

static void clear_counter(counter *table)
{
    free(table->items);
    tn_hash_clear(&table->index);
}

typedef struct wanted_value {
    const value_count *items;
    uint32_t key;
} wanted_value;

static bool is_wanted(const void *context, uint32_t number)
{
    const wanted_value *w = context;
    return w->items[number].key == w->key;
}

static bool count_one(counter *table, uint32_t key)
{
    if (!tn_array_reserve(&table->items, &table->capacity, table->used, 1, sizeof *table->items))
        return false;
    uint32_t number = (uint32_t)table->used;
    wanted_value wanted = {table->items, key};
    if (tn_hash_enter(&table->index, (uint64_t)key * 0x9e3779b97f4a7c15u >> 32, is_wanted, &wanted, &number, NULL) !=
        TN_OK)
        return false;
    if (number == table->used)
        table->items[table->used++] = (value_count){key, 0};
    table->items[number].count++;
    return true;
}

/* ---- histograms */

static int compare_ages(const void *a, const void *b)
{
    const tn_age_count *x = a, *y = b;
    if (x->label != y->label)
        return x->label < y->label ? -1 : 1;
    return x->age < y->age ? -1 : x->age > y->age;
}

static int compare_sides(const void *a, const void *b)
{
    const tn_size_count *x = a, *y = b;
    return x->sides < y->sides ? -1 : x->sides > y->sides;
}

static tn_status count_ages(const tn_growth *growth, tn_stats *stats, tn_error *error)
{
    const tn_map *map = tn_growth_map(growth);
    counter table = {0};
    bool fine = true;
    for (uint32_t e = 0; e < map->edge_count && fine; e++)
        fine = count_one(&table, map->states[e] & ~TN_STATE_FRESH);
    stats->labels = calloc(tn_growth_rules(growth)->label_count, sizeof *stats->labels);
    stats->ages = malloc((table.used ? table.used : 1) * sizeof *stats->ages);
    if (!fine || !stats->labels || !stats->ages) {
        clear_counter(&table);
        return tn_fail_memory(error);
    }
    for (size_t i = 0; i < table.used; i++) {
        uint32_t key = table.items[i].key, label = tn_state_label(key);
        stats->labels[label] += table.items[i].count;
        stats->ages[stats->age_count++] = (tn_age_count){label, tn_state_age(key), table.items[i].count};
    }
    qsort(stats->ages, stats->age_count, sizeof *stats->ages, compare_ages);
    clear_counter(&table);
    return TN_OK;
}

static tn_status count_sides(const tn_map *map, tn_stats *stats, tn_error *error)
{
    counter table = {0};
    bool fine = true;
    for (uint32_t f = TN_OUTER_FACE + 1; f < map->face_count && fine; f++)
        fine = count_one(&table, tn_face_size(map, f));
    stats->sides = malloc((table.used ? table.used : 1) * sizeof *stats->sides);
    if (!fine || !stats->sides) {
        clear_counter(&table);
        return tn_fail_memory(error);
    }
    for (size_t i = 0; i < table.used; i++)
        stats->sides[stats->side_count++] = (tn_size_count){table.items[i].key, table.items[i].count};
    qsort(stats->sides, stats->side_count, sizeof *stats->sides, compare_sides);
    clear_counter(&table);
    return TN_OK;
}

/* ---- fitness */

/* The least and greatest coordinates, and the sums of all. */
typedef struct extent {
    double low[3], high[3], sum[3];
} extent;

static extent measure_extent(const tn_map *map)
{
    extent e = {.low = {INFINITY, INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY, -INFINITY}};
    for (uint32_t v = 0; v < map->vertex_count; v++) {
        for (int k = 0; k < 3; k++) {
            double p = map->positions[3 * (size_t)v + (size_t)k];
            e.low[k] = p < e.low[k] ? p : e.low[k];
            e.high[k] = p > e.high[k] ? p : e.high[k];
            e.sum[k] += p;
        }
    }
    return e;
}

/* Each edge once: the dart that runs along it. */
static double smoothness(const tn_map *map)
{
    double sum = 0;
    for (uint32_t f = 0; f < map->face_count; f++) {
        uint32_t first = map->face_first[f], size = tn_face_size(map, f);
        for (uint32_t i = 0; i < size; i++) {
            if (map->side[first + i] & 1)
                continue;
            uint32_t from = map->origin[first + i], to = map->origin[first + (i + 1 == size ? 0 : i + 1)];
            sum += fabs(map->positions[3 * (size_t)from + 2] - map->positions[3 * (size_t)to + 2]);
        }
    }
    return sum;
}

/* The smaller over the larger number of vertices below and above the middle in one coordinate; those on it do not
 * count. */
static double balance(const tn_map *map, int k, double middle, double slack)
{
    uint64_t below = 0, above = 0;
    for (uint32_t v = 0; v < map->vertex_count; v++) {
        double p = map->positions[3 * (size_t)v + (size_t)k];
        below += p < middle - slack;
        above += p > middle + slack;
    }
    uint64_t most = below > above ? below : above, least = below > above ? above : below;
    return most ? (double)least / (double)most : 1;
}

static uint64_t count_trespassers(const tn_map *map, const tn_environment *environment)
{
    uint64_t count = 0;
    for (uint32_t v = 0; tn_environment_has_soft(environment) && v < map->vertex_count; v++)
        count += tn_environment_trespasses(environment, tn_vector_at(map->positions + 3 * (size_t)v));
    return count;
}

static tn_fitness measure_fitness(const tn_growth *growth, const extent *e)
{
    const tn_map *map = tn_growth_map(growth);
    double size = (e->high[0] - e->low[0]) + (e->high[1] - e->low[1]), slack = 1e-9 * fmax(1, size);
    return (tn_fitness){.size = size,
                        .smoothness = smoothness(map),
                        .soft_boundary_nodes = (double)count_trespassers(map, tn_growth_surroundings(growth)),
                        .subdivisions = (double)map->vertex_count / map->edge_count,
                        .symmetry = 0.5 * (balance(map, 1, e->sum[1] / map->vertex_count, slack) +
                                           balance(map, 0, e->sum[0] / map->vertex_count, slack)),
                        .undulation = e->high[2] - e->low[2],
                        .vertices = map->vertex_count,
                        .edges = map->edge_count,
                        .faces = map->face_count - 1};
}

tn_fitness tn_fitness_measure(const tn_growth *growth)
{
    extent e = measure_extent(tn_growth_map(growth));
    return measure_fitness(growth, &e);
}

tn_status tn_stats_measure(const tn_growth *growth, tn_stats *stats, tn_error *error)
{
    const tn_map *map = tn_growth_map(growth);
    *stats = (tn_stats){.step = tn_growth_steps(growth),
                        .vertices = map->vertex_count,
                        .edges = map->edge_count,
                        .faces = map->face_count - 1};
    tn_status status = count_ages(growth, stats, error);
    if (status == TN_OK)
        status = count_sides(map, stats, error);
    if (status != TN_OK)
        return status;
    extent e = measure_extent(map);
    memcpy(stats->low, e.low, sizeof e.low);
    memcpy(stats->high, e.high, sizeof e.high);
    stats->fitness = measure_fitness(growth, &e);
    return TN_OK;
}

double tn_fitness_value(const tn_fitness *fitness, tn_measured term)
{
    switch (term) {
    case TN_TERM_SIZE:
        return fitness->size;
    case TN_TERM_SMOOTHNESS:
        return fitness->smoothness;
    case TN_TERM_SOFT_BOUNDARY:
        return fitness->soft_boundary_nodes;
    case TN_TERM_SUBDIVISIONS:
        return fitness->subdivisions;
    case TN_TERM_SYMMETRY:
        return fitness->symmetry;
    default:
        return fitness->undulation;
    }
}

const char *tn_fitness_term_name(tn_measured term)
{
    static const char *const names[] = {"size",         "smoothness", "soft_boundary_nodes",
                                        "subdivisions", "symmetry",   "undulation"};
    return names[term];
}

void tn_fitness_terms(const tn_fitness *fitness, double terms[TN_MEASURED_COUNT])
{
    for (uint32_t i = 0; i < TN_FITNESS_TERM_COUNT; i++)
        terms[i] = tn_fitness_value(fitness, (tn_measured)i);
    terms[TN_MEASURED_VERTICES] = fitness->vertices;
    terms[TN_MEASURED_EDGES] = fitness->edges;
    terms[TN_MEASURED_FACES] = fitness->faces;
    memcpy(terms + TN_MEASURED_WIDTH, fitness->further, sizeof fitness->further);
}

double tn_named_value(const tn_named_goal *goal, const tn_fitness *fitness)
{
    double terms[TN_MEASURED_COUNT];
    tn_fitness_terms(fitness, terms);
    return tn_number_run(goal->code, goal->offset, terms);
}

double tn_fitness_lacking(const tn_fitness *fitness, const tn_fitness_goal *goals)
{
    double sum = 0;
    for (uint32_t i = 0; i < goals->required_count; i++)
        sum += tn_named_value(&goals->required[i], fitness);
    return sum;
}

double tn_fitness_part(const tn_fitness *fitness, const tn_fitness_goal *goals, uint32_t goal, double start_length)
{
    bool is_term = goal < TN_FITNESS_TERM_COUNT;
    const tn_named_goal *named = is_term ? NULL : &goals->named[goal - TN_FITNESS_TERM_COUNT];
    if (is_term && !goals->wanted[goal])
        return 0;
    double value = is_term ? tn_fitness_value(fitness, (tn_measured)goal) : tn_named_value(named, fitness);
    double target = is_term ? goals->target[goal] : named->target,
           weight = is_term ? goals->weight[goal] : named->weight;
    double unit = fmax(fabs(target), goal == TN_TERM_SIZE ? start_length : 1);
    return weight * (goals->raw ? value : fabs(value - target) / unit);
}

double tn_fitness_total(const tn_fitness *fitness, const tn_fitness_goal *goals, double start_length)
{
    double total = goals->requirement_weight * tn_fitness_lacking(fitness, goals);
    for (uint32_t goal = 0; goal < TN_FITNESS_TERM_COUNT + goals->named_count; goal++)
        total += tn_fitness_part(fitness, goals, goal, start_length);
    return total;
}
