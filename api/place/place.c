/* The C interface to placing parts. */
#include <stdio.h>
#include <stdlib.h>

#include "api/base/api.h"
#include "runtime/place/write.h"

struct tartan_placement {
    tn_place_rules rules;
    tn_placed_model model;
    tartan_placed_part *parts;
    tn_watch watch;
};

/* The parts as the interface has them. */
static tartan_status list(tartan_placement *p, tartan_error *error)
{
    p->parts = malloc((p->model.count + 1) * sizeof *p->parts);
    if (!p->parts)
        return tn_api_memory(error);
    for (size_t i = 0; i < p->model.count; i++) {
        const tn_placed_part *part = &p->model.parts[i];
        p->parts[i] = (tartan_placed_part){.at = {part->frame.at[0], part->frame.at[1], part->frame.at[2]},
                                           .heading = part->frame.heading,
                                           .colour = part->frame.colour,
                                           .name = part->name};
    }
    return TARTAN_OK;
}

static tartan_status place(const tartan_module *module, const tartan_place_options *options, tartan_placement *p,
                           tartan_error *error)
{
    tn_place_options own = {.seed = options->seed,
                            .part_limit = options->part_limit,
                            .step_limit = options->step_limit,
                            .frame_limit = options->frame_limit,
                            .lookahead_limit = options->lookahead_limit,
                            .watch = &p->watch};
    tn_place_fault fault;
    tn_error found;
    tn_status status = tn_place_rules_make(module->module, &p->rules, &found);
    if (status == TN_INVALID)
        return tn_api_refuse(error, TARTAN_INVALID, "the module has no connection grammar: nothing is placed");
    if (status == TN_OK)
        status = tn_place_derive(&p->rules, &own, &p->model, &fault, &found);
    if (status != TN_OK)
        return tn_api_fail(&found, error);
    return p->model.count ? list(p, error) : tn_api_refuse(error, TARTAN_INVALID, "the grammar places no part");
}

tartan_status tartan_place(const tartan_module *module, const tartan_place_options *given, const tartan_watch *watch,
                           tartan_placement **placement, tartan_error *error)
{
    tartan_place_options options;
    if (!module || !placement)
        return tn_api_missing(error, module ? "room for the placement" : "module");
    tartan_status status = TN_API_TAKE(tartan_place_options, &options, given, error);
    if (status != TARTAN_OK)
        return status;
    tartan_placement *made = calloc(1, sizeof *made);
    if (!made)
        return tn_api_memory(error);
    status = tn_api_watch(watch, &made->watch, error);
    if (status == TARTAN_OK)
        status = place(module, &options, made, error);
    if (status == TARTAN_OK)
        *placement = made;
    else
        tartan_placement_free(made);
    return status;
}

void tartan_placement_free(tartan_placement *placement)
{
    if (!placement)
        return;
    free(placement->parts);
    tn_placed_model_clear(&placement->model);
    tn_place_rules_clear(&placement->rules);
    free(placement);
}

const tartan_placed_part *tartan_placement_parts(const tartan_placement *placement, size_t *count)
{
    *count = placement->model.count;
    return placement->parts;
}

tartan_status tartan_placement_count(const tartan_placement *placement, tartan_placement_counts *counts,
                                     tartan_error *error)
{
    if (!placement)
        return tn_api_missing(error, "placement");
    const tn_place_counts *c = &placement->model.counts;
    tartan_placement_counts own = {.size = sizeof own,
                                   .parts = c->parts,
                                   .steps = c->steps,
                                   .expansions = c->expansions,
                                   .draws = c->draws,
                                   .tries = c->tries,
                                   .fallbacks = c->fallbacks,
                                   .cells = c->cells,
                                   .bounds = c->bounds};
    return TN_API_GIVE(tartan_placement_counts, counts, &own, error);
}

/* ---- as text */

static tn_status write_ldraw(const tn_module *module, const tn_placed_model *model, FILE *out, tn_error *error)
{
    (void)error;
    tn_place_write_ldraw(module, model, NULL, out);
    return TN_OK;
}

static tartan_status write_text(const tartan_placement *placement,
                                tn_status (*write)(const tn_module *, const tn_placed_model *, FILE *, tn_error *),
                                char **text, size_t *size, tartan_error *error)
{
    char *made = NULL;
    size_t made_size = 0;
    tn_error found;
    if (!placement || !text || !size)
        return tn_api_missing(error, placement ? "room for the text" : "placement");
    FILE *out = open_memstream(&made, &made_size);
    if (!out)
        return tn_api_memory(error);
    tn_status status = write(placement->rules.module, &placement->model, out, &found);
    bool failed = ferror(out) != 0;
    failed |= fclose(out) != 0;
    if (status == TN_OK && failed)
        status = tn_fail_memory(&found);
    if (status != TN_OK) {
        free(made);
        return tn_api_fail(&found, error);
    }
    *text = made;
    *size = made_size;
    return TARTAN_OK;
}

tartan_status tartan_placement_ldraw(const tartan_placement *placement, char **text, size_t *size, tartan_error *error)
{
    return write_text(placement, write_ldraw, text, size, error);
}

tartan_status tartan_placement_list(const tartan_placement *placement, char **text, size_t *size, tartan_error *error)
{
    return write_text(placement, tn_place_write_list, text, size, error);
}
