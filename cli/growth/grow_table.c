/* Shows the steps of `tartan grow`: what each measures as a table, and why branches did not join. */
#include <inttypes.h>

#include "cli/growth/grow.h"
#include "runtime/base/bytes.h"

void tn_grow_table(const tn_grown_shown *steps, FILE *out)
{
    const tn_growth_system *system = steps->system;
    const tn_study *study = &steps->study;
    fprintf(out, "%5s %10s %10s %10s  %9s %9s %9s %8s %8s  edges\n", "step", "vertices", "edges", "faces", "size",
            "rough", "undul.", "V/E", "symm.");
    for (size_t i = 0; i < steps->count; i++) {
        const tn_stats *s = &steps->stats[i];
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

void tn_grow_explain(const tn_grown_joins *joins, FILE *out)
{
    fprintf(out, "step %" PRIu64 ": %" PRIu64 " edges replaced, %" PRIu64 " pairs of branches joined\n", joins->step,
            joins->replaced, joins->joined);
    if (joins->kept)
        fprintf(out, "  %" PRIu64 " chains were kept, since a face would have fewer than three edges\n", joins->kept);
    for (size_t i = 0; i < joins->unjoined.count; i++)
        fprintf(out, "  %" PRIu64 " branches %s\n", joins->unjoined.items[i].branches, joins->unjoined.items[i].reason);
}
