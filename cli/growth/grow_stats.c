/* Prints the statistics of `tartan grow`. */
#include <inttypes.h>
#include <math.h>

#include "cli/growth/grow.h"

/* Expressions by their names; what has no value is null. */
static void write_json_named(FILE *out, const tn_fitness_goal *goal, const tn_fitness *fitness)
{
    for (uint32_t i = 0; i < goal->named_count; i++) {
        double value = tn_named_value(&goal->named[i], fitness);
        fprintf(out, isfinite(value) ? ", \"%s\": %.17g" : ", \"%s\": null", goal->named[i].name, value);
    }
}

static void write_json_lacking(FILE *out, const tn_fitness_goal *goal, const tn_fitness *fitness)
{
    double lacking = tn_fitness_lacking(fitness, goal);
    if (goal->required_count)
        fprintf(out, isfinite(lacking) ? ", \"lacking\": %.17g" : ", \"lacking\": null", lacking);
}

static void write_json(FILE *out, const tn_growth_system *system, const tn_study *study, const tn_stats *stats)
{
    const char *comma = "";
    fprintf(out, "{\"step\": %u, \"V\": %" PRIu64 ", \"E\": %" PRIu64 ", \"F\": %" PRIu64 ", \"labels\": {",
            stats->step, stats->vertices, stats->edges, stats->faces);
    for (uint32_t i = 0; i < system->label_count; i++) {
        if (!stats->labels[i])
            continue;
        fprintf(out, "%s\"Edge%u\": %" PRIu64, comma, system->labels[i].number, stats->labels[i]);
        comma = ", ";
    }
    fputs("}, \"ages\": {", out);
    for (size_t i = 0; i < stats->age_count; i++)
        fprintf(out, "%s\"Edge%u_%d\": %" PRIu64, i ? ", " : "", system->labels[stats->ages[i].label].number,
                stats->ages[i].age, stats->ages[i].count);
    fputs("}, \"face_sides\": {", out);
    for (size_t i = 0; i < stats->side_count; i++)
        fprintf(out, "%s\"%u\": %" PRIu64, i ? ", " : "", stats->sides[i].sides, stats->sides[i].count);
    fputs("}, \"fitness\": {", out);
    for (int t = 0; t < TN_FITNESS_TERM_COUNT; t++) {
        double value = tn_fitness_value(&stats->fitness, (tn_measured)t);
        fprintf(out, "%s\"%s\": %.17g", t ? ", " : "", tn_fitness_term_name((tn_measured)t), value);
    }
    write_json_named(out, &study->goal, &stats->fitness);
    fputs("}, \"measures\": {", out);
    for (int i = TN_MEASURED_WIDTH; i < TN_MEASURED_COUNT; i++)
        if (isfinite(stats->fitness.further[i - TN_MEASURED_WIDTH])) /* no distance without a target */
            fprintf(out, "%s\"%s\": %.17g", i > TN_MEASURED_WIDTH ? ", " : "", tn_names_MEASURED[i],
                    stats->fitness.further[i - TN_MEASURED_WIDTH]);
    fputc('}', out);
    write_json_lacking(out, &study->goal, &stats->fitness);
    fputc('}', out);
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
            fprintf(out, ", %s %.6g", study->goal.named[n].name, tn_named_value(&study->goal.named[n], &s->fitness));
        if (study->goal.required_count)
            fprintf(out, ", %.6g from what is required", tn_fitness_lacking(&s->fitness, &study->goal));
        if (study->has_goal)
            fprintf(out, ", fitness %.6g", tn_fitness_total(&s->fitness, &study->goal, study->options.start_length));
        fputc('\n', out);
    }
}

void tn_grow_stats(tn_job *job, const tn_growth_system *system, const tn_study *study, const tn_stats *stats,
                   size_t count)
{
    tn_output output;
    if (!tn_job_output(job, NULL, &output))
        return;
    if (tn_grow_settings_of(job)->stats == 2) {
        for (size_t i = 0; i < count; i++) {
            fputs(i ? ",\n" : "[", output.stream);
            write_json(output.stream, system, study, &stats[i]);
        }
        fputs("]\n", output.stream);
    } else {
        write_table(output.stream, system, study, stats, count);
    }
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
