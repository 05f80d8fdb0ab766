/* Makes a search ready, runs it, and gives the model that it found. */
#include "runtime/place/search/search.h"

#include <stdlib.h>

#include "runtime/place/search/run.h"

tn_status tn_place_search_keep(tn_place_search_run *run, const tn_standing *plan, const tn_model_score *score)
{
    if (run->has_best && tn_score_compare(score, &run->best_score) >= 0)
        return TN_OK;
    run->has_best = true;
    run->best_score = *score;
    return tn_standing_copy(&run->best, plan, run->error);
}

tn_status tn_place_search_check(tn_place_search_run *run, uint64_t looked_at, double done, double total)
{
    run->looked_at = looked_at;
    tn_watch_tell(run->options->watch, done, total);
    if (looked_at > run->model_limit) {
        tn_fail(run->error, TN_LIMIT, E_PLACE_LIMIT, "the search passes the limit of %llu models looked at",
                (unsigned long long)run->model_limit);
        tn_error_help(run->error, "raise the limit with --search-limit, or ask for a smaller search");
        return TN_LIMIT;
    }
    return tn_watch_check(run->options->watch, run->error);
}

/* The first choice that fits, at every connector. */
static tn_status search_greedy(tn_place_search_run *run)
{
    tn_model_score score;
    tn_status status = tn_world_start(&run->worlds[0], run->error);
    if (status == TN_OK)
        status = tn_world_grow(&run->worlds[0], run->error);
    if (status == TN_OK)
        status = tn_score_world(&run->scorers[0], &run->worlds[0], NULL, &score, run->error);
    run->looked_at = 1;
    return status == TN_OK ? tn_place_search_keep(run, &run->worlds[0].plan, &score) : status;
}

static tn_status make_worlds(tn_place_search_run *run)
{
    unsigned threads = tn_crew_threads(run->crew);
    tn_watch *watch = run->options->watch;
    tn_space *space;
    uint64_t inside = 0;
    run->worlds = calloc(threads, sizeof *run->worlds);
    run->scorers = calloc(threads, sizeof *run->scorers);
    if (!run->worlds || !run->scorers)
        return tn_fail_memory(run->error);
    tn_status status = tn_space_new(run->choices->rules, &space, run->error);
    if (status == TN_OK)
        status = tn_space_count(space, watch, &inside, run->error);
    tn_space_free(space);
    for (unsigned i = 0; i < threads && status == TN_OK; i++) {
        status = tn_world_make(run->choices, run->options, &run->worlds[i], run->error);
        if (status == TN_OK)
            status = tn_scorer_make(run->choices, inside, watch, &run->scorers[i], run->error);
    }
    return status;
}

static void clear(tn_place_search_run *run)
{
    for (unsigned i = 0; run->crew && i < tn_crew_threads(run->crew); i++) {
        if (run->worlds)
            tn_world_clear(&run->worlds[i]);
        if (run->scorers)
            tn_scorer_clear(&run->scorers[i]);
    }
    free(run->worlds);
    free(run->scorers);
    tn_standing_clear(&run->best);
    tn_crew_free(run->crew);
}

/* Symmetry has to find images of all parts that are placed. */
static tn_status check_images(const tn_site_choices *choices, tn_error *error)
{
    uint32_t symmetry = choices->rules->space->symmetry;
    for (size_t i = 0; i < choices->part_count && symmetry >= TN_SYMMETRY_MIRROR_X; i++) {
        const tn_kind_of_part *kind = &choices->kinds[choices->parts[i].kind];
        if (kind->mirrored[symmetry == TN_SYMMETRY_MIRROR_Z] < TN_TURNS)
            continue;
        tn_fail(error, TN_INVALID, E_KIT_SEARCH, "part %.100s is not its own mirror image, however it is turned",
                tn_text(choices->rules->module, kind->record->name));
        tn_error_help(error, "leave it out of the model's rules, or ask for `symmetry turn 2`");
        return TN_INVALID;
    }
    return TN_OK;
}

static void take_stock(const tn_site_choices *choices)
{
    const tn_module *module = choices->rules->module;
    const tn_kit_model_record *model = choices->rules->space;
    for (uint32_t i = 0; i < model->stock_count; i++) {
        const tn_kit_stock_record *stock = &module->KIT_STOCK_records[model->stock_first + i];
        choices->kinds[stock->part].most = stock->most;
    }
}

static tn_status run_search(tn_place_search_run *run)
{
    static tn_status (*const searches[TN_SEARCH_COUNT])(tn_place_search_run *) = {
        [TN_SEARCH_BEAM] = tn_place_search_beam,
        [TN_SEARCH_ANNEAL] = tn_place_search_anneal,
        [TN_SEARCH_EXACT] = tn_place_search_exact,
    };
    run->crew = tn_crew_new(run->options->threads, run->options->watch);
    tn_status status = run->crew ? make_worlds(run) : tn_fail_memory(run->error);
    if (status == TN_OK)
        status = search_greedy(run); /* there is always something to show */
    if (status != TN_OK || !searches[run->model->search])
        return status;
    tn_standing none = {0};
    status = tn_world_load(&run->worlds[0], &none, run->error);
    return status == TN_OK ? searches[run->model->search](run) : status;
}

tn_status tn_place_search(const tn_place_rules *rules, const tn_place_options *options, tn_placed_model *model,
                          tn_error *error)
{
    tn_site_choices choices;
    tn_error ignored;
    *model = (tn_placed_model){0};
    tn_status status = tn_site_choices_make(rules, &choices, error);
    if (status == TN_OK)
        status = check_images(&choices, error);
    if (status == TN_OK) {
        tn_place_search_run run = {.choices = &choices,
                                   .model = rules->space,
                                   .options = options,
                                   .model_limit = options->search_limit ? options->search_limit : 10000000,
                                   .error = error};
        take_stock(&choices);
        status = run_search(&run);
        tn_status made = status;
        if (run.has_best && (status == TN_OK || status == TN_LIMIT || status == TN_STOPPED))
            made = tn_standing_model(&choices, &run.best, model, status == TN_OK ? error : &ignored);
        status = status == TN_OK ? made : status;
        model->counts = (tn_place_counts){.parts = model->count, .looked_at = run.looked_at, .proved = run.proved};
        clear(&run);
    }
    tn_site_choices_clear(&choices);
    return status;
}

/* ---- with and without a search */

static tn_status fail_nothing(const tn_place_rules *rules, tn_error *error)
{
    tn_fail(error, TN_INVALID, E_PLACE_NOTHING, "%s comes to its end without placing a part",
            rules->space ? "the model" : "the grammar");
    tn_error_help(error, "%s%s",
                  rules->space ? "a part needs room inside of the space where the model starts"
                               : "a part is placed by 'Place(3001)'",
                  tn_place_needs_search(rules) ? "" : "; --trace shows which alternatives did not fit");
    return TN_INVALID;
}

tn_status tn_place_run(const tn_place_rules *rules, const tn_place_options *options, tn_placed_model *model,
                       tn_place_fault *fault, tn_error *error)
{
    *fault = (tn_place_fault){0};
    tn_status status = tn_place_needs_search(rules) ? tn_place_search(rules, options, model, error)
                                                    : tn_place_derive(rules, options, model, fault, error);
    return status == TN_OK && model->count == 0 ? fail_nothing(rules, error) : status;
}
