/* place: a model of a kit, or of a connection grammar. */
#include "ask/place/place.h"

#include <stdio.h>

#include "ask/place/placing.h"
#include "ask/session/questions.h"
#include "driver/place/kit.h"
#include "runtime/place/search/search.h"

/* ---- what makes no sense */

static tn_status check_formats(tn_session *session, const tn_place_request *r)
{
    bool ldraw = false, picture = false;
    tn_error error;
    for (size_t i = 0; i < r->formats.count; i++) {
        tn_file_format format;
        if (tn_file_format_named(r->formats.items[i], TN_PLACED_FILES, &format, &error) != TN_OK)
            return tn_session_fail(session, &error);
        ldraw |= format == TN_FILE_LDR;
        picture |= (TN_WRITES_PICTURES >> format & 1) != 0;
    }
    if (r->header && !ldraw)
        return tn_session_refuse(session, NULL, "--header is of an .ldr file: name one with -o");
    if (r->sheet && !picture)
        return tn_session_refuse(session, NULL, "--sheet is of a picture: name one with -o");
    return TN_OK;
}

tn_status tn_place_check(tn_session *session, const tn_place_request *r)
{
    tn_steps_wish wish;
    if (r->steps && !tn_placing_read_steps(r->steps, &wish))
        return tn_session_refuse(session,
                                 "write `--steps part`, `--steps layer`, or how many parts a step has: `--steps 5`",
                                 "--steps cannot be %.100s", r->steps);
    if (r->fitness && r->trace)
        return tn_session_refuse(session, NULL,
                                 "--trace shows what does not fit, and --fitness chooses by value: leave one out");
    return check_formats(session, r);
}

/* The statement by which a model is placed in another way than by deriving it. */
static const char *search_reason(const tn_kit_model_record *model)
{
    return model->search != TN_SEARCH_GREEDY     ? "search"
           : model->symmetry != TN_SYMMETRY_NONE ? "symmetry"
           : model->stock_count > 0              ? "stock"
                                                 : "order breadth";
}

/* A search looks at many models: what one derivation did is not asked for. */
static tn_status check_search(const tn_model_placing *p)
{
    const tn_place_request *r = p->request;
    const char *option = r->trace ? "--trace" : r->program ? "--program" : r->engine ? "--engine" : NULL;
    bool search = tn_place_needs_search(&p->rules);
    if (search && option) {
        char help[80];
        const char *reason = search_reason(p->rules.space);
        snprintf(help, sizeof help, "leave `%s` out of the model to see it", reason);
        return tn_session_refuse(p->session, help,
                                 "%s is of models that are derived from the start on, and this one has `%s`", option,
                                 reason);
    }
    if (!search && (r->has_search_limit || r->has_threads))
        return tn_session_refuse(p->session, NULL, "--%s is of a search, and the model has none",
                                 r->has_search_limit ? "search-limit" : "threads");
    return TN_OK;
}

/* ---- the rules */

static tn_status holds_nothing(tn_session *session, tn_status status, tn_error *error)
{
    tn_fail(error, status, E_NOT_PLACING, "%.200s holds nothing to place", session->opened->path);
    tn_error_help(error, "%s",
                  tn_opened_help(session->opened, "connection grammars are .pcfg files, kits .kit files").text);
    return tn_session_fail(session, error);
}

/* Those of the grammar, or of one model of a kit. */
static tn_status make_rules(tn_model_placing *p)
{
    tn_opened *opened = p->session->opened;
    tn_error error;
    bool kit = opened->module->KIT_count > 0;
    if (!kit && p->request->model)
        return tn_session_refuse(p->session, NULL, "--model is about a kit, and %.200s is none", opened->path);
    tn_status status = kit ? tn_kit_choose(opened, p->request->model, &p->chosen) : TN_OK;
    if (status != TN_OK)
        return status;
    status = kit ? tn_place_rules_of_model(opened->module, p->chosen, &p->rules, &error)
                 : tn_place_rules_make(opened->module, &p->rules, &error);
    return status == TN_OK ? TN_OK : holds_nothing(p->session, status, &error);
}

static tn_status make_fitness(tn_model_placing *p)
{
    if (!p->request->fitness)
        return TN_OK;
    if (p->rules.space)
        return tn_session_refuse(p->session,
                                 "what is better of two models of a kit, the model says: `minimize elements;`",
                                 "--fitness is of connection grammars");
    tn_status status = tn_place_fitness_make(&p->rules, p->request->fitness, &p->fitness);
    if (status != TN_OK)
        tn_kit_ask_failed(p->session->opened, &p->fitness.asked);
    return status;
}

/* ---- the run */

static void report(void *context, const tn_place_event *event)
{
    tn_placing_trace(context, event);
}

static double value_of(void *context, const tn_placed_model *model, const char *const *ahead, size_t ahead_count)
{
    return tn_place_fitness_value(&((tn_model_placing *)context)->fitness, model, ahead, ahead_count);
}

static tn_status place(tn_model_placing *p)
{
    const tn_place_request *r = p->request;
    const tn_place_options options = {.seed = (uint32_t)r->seed,
                                      .part_limit = r->part_limit,
                                      .step_limit = r->step_limit,
                                      .frame_limit = r->frame_limit,
                                      .lookahead_limit = r->lookahead_limit,
                                      .search_limit = r->search_limit,
                                      .threads = (unsigned)r->threads,
                                      .keep_steps = r->program,
                                      .keep_filled = r->trace,
                                      .interpret = r->engine == 1,
                                      .value = r->fitness ? value_of : NULL,
                                      .watch = p->watch,
                                      .report = r->trace ? report : NULL,
                                      .context = p};
    tn_session_begins(p->session, "parts placed");
    tn_status status = tn_place_model(p->session->opened, &p->rules, &options, &p->model);
    tn_session_ends(p->session);
    return status;
}

/* The trace is whole also if the run could not go on. */
static tn_status place_traced(tn_model_placing *p)
{
    tn_error error;
    p->placed->has_trace = true;
    tn_status status = tn_making_begin(&p->trace, p->session, TN_FILE_OTHER, NULL, &p->placed->trace, &error);
    if (status != TN_OK)
        return tn_session_fail(p->session, &error);
    tn_status placed = place(p);
    status = tn_making_end(&p->trace, TN_OK, &error);
    return tn_graver(placed, status == TN_OK ? TN_OK : tn_session_fail(p->session, &error));
}

static void tell_figures(const tn_place_counts *c, tn_placing_figures *f)
{
    bool search = c->looked_at > 0;
    *f = (tn_placing_figures){.elements = c->parts,
                              .terminals = c->steps,
                              .expansions = c->expansions,
                              .random = c->draws,
                              .tries = c->tries,
                              .fallbacks = c->fallbacks,
                              .cells = c->cells,
                              .bounds = c->bounds,
                              .models = c->looked_at,
                              .proved = c->proved};
    f->has_models = f->has_proved = search;
    f->has_terminals = f->has_expansions = f->has_random = f->has_tries = f->has_fallbacks = f->has_cells =
        f->has_bounds = !search;
}

/* Does what was placed meet what its model requires? */
static tn_status check_conditions(tn_model_placing *p)
{
    tn_placed_measures measured;
    tn_error error;
    tn_kit_tally tally = {0};
    bool required;
    tn_status status = tn_kit_measure_required(&p->rules, &p->model, p->watch, &required, &measured, &error);
    if (status != TN_OK)
        tn_session_fail(p->session, &error);
    else if (required)
        status = tn_kit_conditions(p->session->opened, p->chosen, &measured, false, true, &tally);
    tn_placed_measures_clear(&measured);
    return status;
}

static tn_status give(tn_model_placing *p, const char *ended)
{
    tn_status status = tn_placing_find_steps(p);
    if (status != TN_OK)
        return status;
    p->placed->ended = ended;
    return tn_placing_write(p);
}

/* The best that a search has found by then is a model like any other. */
static tn_status run(tn_model_placing *p, const tn_reply *answer)
{
    tn_session *session = p->session;
    tn_status status = p->request->trace ? place_traced(p) : place(p), unmet = TN_OK;
    bool best = p->model.counts.looked_at > 0 && p->model.count > 0 && (status == TN_LIMIT || status == TN_STOPPED);
    bool stands = status == TN_OK || best;
    p->placed->status = status;
    tell_figures(&p->model.counts, &p->placed->figures);
    if (status == TN_STOPPED && best)
        p->watch = NULL;
    if (stands && session->so_far)
        session->so_far(session->so_far_context, answer);
    if (stands)
        unmet = check_conditions(p);
    p->placed->status = tn_graver(status, unmet);
    tn_status last = stands ? unmet : status;
    if (last == TN_OK || (p->request->keep_partial && last != TN_MEMORY && p->model.count > 0))
        return give(p, !stands                ? "partial"
                       : unmet != TN_OK       ? "unmet"
                       : status == TN_LIMIT   ? "limit"
                       : status == TN_STOPPED ? "stopped"
                                              : "whole");
    if (p->model.count > 0)
        tn_session_note(session, "%zu part%s placed before; nothing was written", p->model.count,
                        p->model.count == 1 ? " was" : "s were");
    return (tn_status)p->placed->status;
}

tn_status tn_ask_place(tn_session *session, const tn_place_request *request, tn_reply *answer)
{
    tn_model_placing p = {.session = session, .request = request, .watch = session->opened->module->watch};
    tn_error error;
    *answer = (tn_reply){0};
    tn_status status = tn_place_check(session, request);
    if (status != TN_OK)
        return status;
    status = make_rules(&p);
    if (status == TN_OK)
        status = check_search(&p);
    if (status == TN_OK)
        status = make_fitness(&p);
    if (status == TN_OK) {
        status = tn_reply_new(&tn_message_placed, answer, &error);
        p.placed = answer->value;
        status = status == TN_OK ? run(&p, answer) : tn_session_fail(session, &error);
    }
    tn_placed_steps_clear(&p.steps);
    tn_placed_model_clear(&p.model);
    tn_place_fitness_clear(&p.fitness);
    tn_place_rules_clear(&p.rules);
    return status;
}
