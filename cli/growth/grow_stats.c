/* Prints the statistics of `tartan grow`. */
#include <inttypes.h>
#include <math.h>

#include "cli/growth/grow.h"
#include "runtime/base/bytes.h"
#include "runtime/base/json.h"

static void write_fitness(tn_json *json, const tn_fitness_goal *goal, const tn_fitness *fitness)
{
    tn_json_object(json, "fitness");
    for (int t = 0; t < TN_FITNESS_TERM_COUNT; t++)
        tn_json_number(json, tn_fitness_term_name((tn_measured)t), tn_fitness_value(fitness, (tn_measured)t));
    for (uint32_t i = 0; i < goal->named_count; i++)
        tn_json_number(json, goal->named[i].name, tn_named_value(&goal->named[i], fitness));
    tn_json_object_end(json);
}

static void write_measures(tn_json *json, const tn_fitness *fitness)
{
    tn_json_object(json, "measures");
    for (int i = TN_MEASURED_WIDTH; i < TN_MEASURED_COUNT; i++) {
        double value = fitness->further[i - TN_MEASURED_WIDTH];
        if (isfinite(value)) /* no distance without a target */
            tn_json_number(json, tn_names_MEASURED[i], value);
    }
    tn_json_object_end(json);
}

static void write_edges(tn_json *json, const tn_growth_system *system, const tn_stats *stats)
{
    char name[40];
    tn_json_object(json, "labels");
    for (uint32_t i = 0; i < system->label_count; i++) {
        snprintf(name, sizeof name, "Edge%u", system->labels[i].number);
        if (stats->labels[i])
            tn_json_count(json, name, stats->labels[i]);
    }
    tn_json_object_end(json);
    tn_json_object(json, "ages");
    for (size_t i = 0; i < stats->age_count; i++) {
        snprintf(name, sizeof name, "Edge%u_%d", system->labels[stats->ages[i].label].number, stats->ages[i].age);
        tn_json_count(json, name, stats->ages[i].count);
    }
    tn_json_object_end(json);
}

static void write_sides(tn_json *json, const tn_stats *stats)
{
    char sides[16];
    tn_json_object(json, "face_sides");
    for (size_t i = 0; i < stats->side_count; i++) {
        snprintf(sides, sizeof sides, "%u", stats->sides[i].sides);
        tn_json_count(json, sides, stats->sides[i].count);
    }
    tn_json_object_end(json);
}

static void write_json(tn_json *json, const tn_growth_system *system, const tn_study *study, const tn_stats *stats)
{
    tn_json_object(json, NULL);
    tn_json_count(json, "step", stats->step);
    tn_json_count(json, "V", stats->vertices);
    tn_json_count(json, "E", stats->edges);
    tn_json_count(json, "F", stats->faces);
    write_edges(json, system, stats);
    write_sides(json, stats);
    write_fitness(json, &study->goal, &stats->fitness);
    write_measures(json, &stats->fitness);
    if (study->goal.required_count)
        tn_json_number(json, "lacking", tn_fitness_lacking(&stats->fitness, &study->goal));
    tn_json_object_end(json);
}

/* A list with a line for each step. */
static void write_list(FILE *out, const tn_growth_system *system, const tn_study *study, const tn_stats *stats,
                       size_t count)
{
    tn_json json = tn_json_file(out, TN_JSON_SPACED);
    json.layout.lines = 1;
    tn_json_list(&json, NULL);
    for (size_t i = 0; i < count; i++)
        write_json(&json, system, study, &stats[i]);
    tn_json_list_end(&json);
    tn_json_end_line(&json);
}

static void write_table(FILE *out, const tn_growth_system *system, const tn_study *study, const tn_stats *stats,
                        size_t count)
{
    fprintf(out, "%5s %10s %10s %10s  %9s %9s %9s %8s %8s  edges\n", "step", "vertices", "edges", "faces", "size",
            "rough", "undul.", "V/E", "symm.");
    for (size_t i = 0; i < count; i++) {
        const tn_stats *s = &stats[i];
        fprintf(out, "%5u %10" PRIu64 " %10" PRIu64 " %10" PRIu64 "  %9.4g %9.4g %9.4g %8.4g %8.4g ", s->step,
                s->vertices, s->edges, s->faces, s->fitness.size, s->fitness.smoothness, s->fitness.undulation,
                s->fitness.subdivisions, s->fitness.symmetry);
        for (uint32_t l = 0; l < system->label_count; l++)
            if (s->labels[l])
                fprintf(out, " %s %" PRIu64, system->labels[l].name, s->labels[l]);
        if (s->fitness.soft_boundary_nodes > 0)
            fprintf(out, ", %.0f past soft boundaries", s->fitness.soft_boundary_nodes);
        for (uint32_t n = 0; n < study->goal.named_count; n++)
            fprintf(out, ", %s %.6g", study->goal.named[n].name,
                    tn_without_sign(tn_named_value(&study->goal.named[n], &s->fitness)));
        if (study->goal.required_count)
            fprintf(out, ", %.6g from what is required",
                    tn_without_sign(tn_fitness_lacking(&s->fitness, &study->goal)));
        if (study->has_goal)
            fprintf(out, ", fitness %.6g",
                    tn_without_sign(tn_fitness_total(&s->fitness, &study->goal, study->options.start_length)));
        fputc('\n', out);
    }
}

void tn_grow_stats(tn_job *job, const tn_growth_system *system, const tn_study *study, const tn_stats *stats,
                   size_t count)
{
    tn_output output;
    if (!tn_job_output(job, NULL, &output))
        return;
    (tn_grow_settings_of(job)->stats == 2 ? write_list : write_table)(output.stream, system, study, stats, count);
    tn_job_commit(job, &output);
}

void tn_grow_explain(FILE *out, uint32_t step, const tn_growth_counts *counts)
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
    fprintf(out, "step %u: %" PRIu64 " edges replaced, %" PRIu64 " pairs of branches joined\n", step, counts->rewrites,
            counts->joins);
    if (counts->refused)
        fprintf(out, "  %" PRIu64 " chains were kept, since a face would have fewer than three edges\n",
                counts->refused);
    for (int i = 0; i < TN_JOIN_FAILURE_COUNT; i++)
        if (counts->failures[i])
            fprintf(out, "  %" PRIu64 " branches %s\n", counts->failures[i], reasons[i]);
}
