/* The C interface to placing parts. */
#include <stdio.h>
#include <stdlib.h>

#include "api/base/api.h"
#include "runtime/place/measure.h"
#include "runtime/place/search/search.h"
#include "runtime/place/write.h"

struct tartan_placement {
    tn_place_rules rules;
    tn_placed_model model;
    tn_placed_steps steps;
    bool has_steps; /* the kit's model says in which it is built */
    bool complete;  /* it can be handed out */
    uint32_t seed;
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

/* The rules of the grammar, or of one model of a kit. */
static tn_status make_rules(const tn_module *module, const char *model, tn_place_rules *rules, tn_error *error)
{
    uint32_t chosen;
    if (module->KIT_count == 0 && !tn_module_has_places(module))
        return tn_fail(error, TN_INVALID, E_NOT_PLACING,
                       "the module has no connection grammar and no kit: nothing is placed");
    if (module->KIT_count == 0 && model)
        return tn_fail(error, TN_INVALID, E_PLACE_NO_MODEL, "a model is named, and the module has no kit");
    if (module->KIT_count == 0)
        return tn_place_rules_make(module, rules, error);
    tn_status status = tn_kit_model_find(module, model, &chosen, error);
    return status == TN_OK ? tn_place_rules_of_model(module, chosen, rules, error) : status;
}

/* Does what was placed meet what its model requires? The first condition that does not hold is the error. */
static tn_status check_conditions(tartan_placement *p, tn_error *error)
{
    const tn_module *module = p->rules.module;
    const tn_kit_condition_record *unmet = NULL;
    tn_placed_measures measured;
    tn_kit_tally tally = {0};
    uint32_t next = 0;
    bool required;
    tn_status status = tn_kit_measure_required(&p->rules, &p->model, &p->watch, &required, &measured, error);
    if (status == TN_OK && required)
        unmet = tn_kit_next_unmet(module, p->rules.space, &measured, false, &next, &tally);
    if (unmet)
        status = tn_kit_fail_condition(module, unmet, p->rules.space, &measured, true, error);
    tn_placed_measures_clear(&measured);
    return status;
}

static tn_status find_steps(tartan_placement *p, tn_error *error)
{
    tn_steps_wish wish;
    p->has_steps = tn_kit_model_steps(p->rules.space, &wish);
    return p->has_steps ? tn_placed_steps_make(p->rules.module, &wish, &p->watch, &p->model, &p->steps, error) : TN_OK;
}

/* A search that ends early leaves the best model that it has looked at. */
static bool is_best_so_far(const tartan_placement *p, tn_status status)
{
    return p->model.counts.looked_at > 0 && p->model.count > 0 && (status == TN_LIMIT || status == TN_STOPPED);
}

static tartan_status place(const tartan_module *module, const tartan_place_options *options, tartan_placement *p,
                           tartan_error *error)
{
    tn_place_options own = {.seed = options->seed,
                            .part_limit = options->part_limit,
                            .step_limit = options->step_limit,
                            .frame_limit = options->frame_limit,
                            .lookahead_limit = options->lookahead_limit,
                            .search_limit = options->search_limit,
                            .threads = options->threads,
                            .watch = &p->watch};
    tn_place_fault fault;
    tn_error found, ended;
    p->seed = options->seed;
    tn_status status = make_rules(module->module, options->model, &p->rules, &found);
    if (status == TN_OK)
        status = tn_place_run(&p->rules, &own, &p->model, &fault, &found);
    bool cut_short = is_best_so_far(p, status);
    if (cut_short) {
        ended = found;
        p->watch = (tn_watch){0}; /* it has been heard */
        status = TN_OK;
    }
    if (status == TN_OK)
        status = check_conditions(p, &found);
    if (status == TN_OK)
        status = find_steps(p, &found);
    tartan_status result = status == TN_OK ? list(p, error) : tn_api_fail(cut_short ? &ended : &found, error);
    p->complete = result == TARTAN_OK;
    return p->complete && cut_short ? tn_api_fail(&ended, error) : result;
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
    if (made->complete)
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
    tn_placed_steps_clear(&placement->steps);
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
                                   .bounds = c->bounds,
                                   .looked_at = c->looked_at,
                                   .proved = c->proved};
    return TN_API_GIVE(tartan_placement_counts, counts, &own, error);
}

/* ---- as text */

static tn_status write_ldraw(const tartan_placement *placement, FILE *out, tn_error *error)
{
    (void)error;
    if (placement->rules.space)
        tn_place_write_header(&placement->rules, placement->seed, out);
    tn_place_write_ldraw(placement->rules.module, &placement->model, placement->has_steps ? &placement->steps : NULL,
                         out);
    return TN_OK;
}

static tn_status write_list(const tartan_placement *placement, FILE *out, tn_error *error)
{
    return tn_place_write_list(placement->rules.module, &placement->model, out, error);
}

static tartan_status write_text(const tartan_placement *placement,
                                tn_status (*write)(const tartan_placement *, FILE *, tn_error *), char **text,
                                size_t *size, tartan_error *error)
{
    char *made = NULL;
    size_t made_size = 0;
    tn_error found;
    if (!placement || !text || !size)
        return tn_api_missing(error, placement ? "room for the text" : "placement");
    FILE *out = open_memstream(&made, &made_size);
    if (!out)
        return tn_api_memory(error);
    tn_status status = write(placement, out, &found);
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
    return write_text(placement, write_list, text, size, error);
}
