/* place: a model of a kit, or of a connection grammar. */
#include "ask/place/place.h"

#include <ctype.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ask/session/made.h"
#include "ask/session/questions.h"
#include "driver/mesh/mesh_file.h"
#include "driver/place/asked.h"
#include "driver/place/kit.h"
#include "runtime/base/array.h"
#include "runtime/place/search/search.h"
#include "runtime/place/steps.h"
#include "runtime/place/write.h"

/* ---- by kind */

static tn_status set_kind(const tn_module *module, const tn_part_count *count, tn_placed_kind *kind, tn_error *error)
{
    bool of_kit = module->KIT_count > 0;
    const tn_kit_part_record *part = of_kit ? tn_kit_part_named(module, count->name) : NULL;
    kind->part = strdup(count->name);
    kind->colour = count->colour;
    kind->number = count->count;
    kind->has_name = kind->has_mass = kind->has_price = of_kit;
    kind->name = part ? tn_text(module, part->title) : "";
    kind->mass = part ? part->mass * (double)count->count : 0;
    kind->price = part ? part->price * (double)count->count : 0;
    return kind->part ? TN_OK : tn_fail_memory(error);
}

tn_status tn_parts_by_kind(const tn_module *module, const tn_placed_model *model, tn_list *kinds, tn_error *error)
{
    tn_part_count *counts;
    size_t count;
    tn_status status = tn_place_count_parts(model, &counts, &count, error);
    if (status != TN_OK)
        return status;
    status = tn_message_list(&tn_message_placed_kind, count, kinds, error);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        status = set_kind(module, &counts[i], (tn_placed_kind *)kinds->items + i, error);
    free(counts);
    return status;
}

/* ---- pictures */

tn_status tn_parts_draw(const tn_parts_picture *p, tn_file_format format, FILE *out, tn_error *error)
{
    tn_picture picture = tn_picture_asked(format);
    tn_status status = p->steps ? tn_placed_draw_steps(p->module, p->model, p->measures, p->steps, &picture, error)
                                : tn_placed_draw(p->module, p->model, p->measures, p->marked, NULL, &picture, error);
    if (status == TN_OK)
        fwrite(picture.element, 1, picture.size, out); /* failing shows when the file is closed */
    free(picture.element);
    return status;
}

/* ---- meshes */

/* Writes its closed surface, in millimetres and in the parts' colours. */
static tn_status parts_write_mesh(tn_opened *opened, const tn_placed_model *model, tn_file_format format, FILE *out,
                                  tn_error *error)
{
    unsigned char(*palette)[3] = NULL;
    tn_mesh mesh = {0};
    tn_status status = tn_placed_mesh(opened->module, model, &mesh, &palette, error);
    const tn_mesh_style style = {.unit = TN_MESH_UNIT_MM, .colours = (const unsigned char(*)[3])palette};
    if (status == TN_OK)
        status = tn_mesh_change(opened, &(tn_mesh_changes){0}, format, &mesh, error);
    if (status == TN_OK)
        status = tn_mesh_file_write(&mesh, format, &style, out, error);
    tn_mesh_clear(&mesh);
    free(palette);
    return status;
}

/* ---- place */

/* What a model can be written as. */
#define TN_PLACED_FILES                                                                                                \
    (TN_WRITES_PICTURES | TN_WRITES(LDR) | TN_WRITES(MPD) | TN_WRITES(CSV) | TN_WRITES(OBJ) | TN_WRITES(PLY) |         \
     TN_WRITES(STL) | TN_WRITES(OFF) | TN_WRITES(OM) | TN_WRITES(GLB) | TN_WRITES(3MF) | TN_WRITES(DXF))

typedef struct tn_model_placing {
    tn_session *session;
    const tn_place_request *request;
    tn_placed *placed; /* the answer */
    tn_place_rules rules;
    uint32_t chosen; /* model of a kit */
    tn_place_fitness fitness;
    tn_placed_model model;
    tn_placed_steps steps;
    bool has_steps;  /* they were asked for, and the parts are in their order */
    tn_watch *watch; /* NULL once it has stopped a search whose best is kept */
    tn_making trace;
} tn_model_placing;

/* The one of two statuses that weighs more. */
static inline tn_status tn_graver(tn_status a, tn_status b)
{
    return a > b ? a : b;
}

/* ---- what is made of a placed model */

/* Pictures and meshes show the parts of a kit. */
static tn_status has_shapes(const tn_model_placing *p, tn_error *error)
{
    if (p->rules.space)
        return TN_OK;
    tn_fail(error, TN_INVALID, E_PLACE_NO_SHAPE, "a connection grammar does not say what its parts look like");
    tn_error_help(error, "write an .ldr file, and draw it by `tartan inspect FILE.ldr --kit bricks -o FILE.svg`");
    return TN_INVALID;
}

/* ---- steps */

/* Reads what is said of steps; false if it is neither part nor layer nor a number of parts. */
static bool placing_read_steps(const char *text, tn_steps_wish *wish)
{
    char *end;
    *wish = (tn_steps_wish){.layers = strcmp(text, "layer") == 0, .parts = 1};
    if (wish->layers || strcmp(text, "part") == 0)
        return true;
    unsigned long long count = strtoull(text, &end, 10);
    wish->parts = tn_as_size(count);
    return isdigit((unsigned char)*text) && !*end && count >= 1 && count <= TN_STEP_PARTS_MAX;
}

/* What the request says, or the model; without either, sub-files and sheets are of layers. False if none are asked for.
 */
static bool choose_steps(const tn_model_placing *p, tn_steps_wish *wish)
{
    const tn_place_request *r = p->request;
    bool needed = r->sheet;
    for (size_t i = 0; i < r->formats.count; i++)
        needed |= strcmp(r->formats.items[i], "mpd") == 0;
    bool said = tn_kit_model_steps(p->rules.space, wish);
    return r->steps ? placing_read_steps(r->steps, wish) : needed || said;
}

static void warn_of_steps(const tn_model_placing *p)
{
    tn_diagnostics *list = &p->session->opened->compilation.diagnostics;
    const tn_kit_model_record *model = p->rules.space;
    const tn_span span = {model->file, model->begin, model->end};
    size_t hanging = p->steps.hanging, loose = p->steps.loose;
    if (hanging > 0)
        tn_help(list,
                tn_report(list, W_PLACE_STEPS, span, "%zu part%s cannot be put in from above when %s turn comes",
                          hanging, hanging == 1 ? "" : "s", hanging == 1 ? "its" : "their"),
                "something stands above: build that piece apart, or upside down");
    if (loose > 0)
        tn_help(list,
                tn_report(list, W_PLACE_STEPS, span, "%zu part%s joined to nothing that stands when %s turn comes",
                          loose, loose == 1 ? " is" : "s are", loose == 1 ? "its" : "their"),
                "pieces float: `require floating = 0;`");
}

/* Finds the steps in which what was placed is built, if they are asked for: its parts are in their order then. Warns of
 * parts that cannot be put in. What fails is said. */
static tn_status placing_find_steps(tn_model_placing *p)
{
    tn_error error;
    tn_steps_wish wish;
    bool by_name = p->request->steps || p->request->sheet;
    if (!choose_steps(p, &wish) || (!p->rules.space && !by_name))
        return TN_OK;
    tn_status status = has_shapes(p, &error);
    if (status == TN_OK)
        status = tn_placed_steps_make(p->rules.module, &wish, p->watch, &p->model, &p->steps, &error);
    p->has_steps = status == TN_OK;
    if (status != TN_OK)
        return tn_session_fail(p->session, &error);
    warn_of_steps(p);
    return TN_OK;
}

/* ---- files */

static tn_status draw(const tn_model_placing *p, tn_file_format format, FILE *out, tn_error *error)
{
    tn_placed_measures measures;
    tn_status status = tn_placed_measure(p->rules.module, NULL, &p->model, p->watch, &measures, error);
    const tn_parts_picture picture = {.module = p->rules.module,
                                      .model = &p->model,
                                      .measures = &measures,
                                      .steps = p->request->sheet ? &p->steps : NULL};
    if (status == TN_OK)
        status = tn_parts_draw(&picture, format, out, error);
    tn_placed_measures_clear(&measures);
    return status;
}

static void write_model(const tn_model_placing *p, bool subfiles, FILE *out)
{
    const tn_module *module = p->rules.module;
    const char *name = tn_place_model_name(&p->rules);
    if (subfiles)
        fprintf(out, "0 FILE %s.ldr\n", name);
    if (p->request->header || p->rules.space)
        tn_place_write_header(&p->rules, (uint32_t)p->request->seed, out);
    if (subfiles)
        tn_place_write_mpd(module, &p->model, &p->steps, name, out);
    else
        tn_place_write_ldraw(module, &p->model, p->has_steps ? &p->steps : NULL, out);
}

static tn_status write_as(const tn_model_placing *p, tn_file_format format, FILE *out, tn_error *error)
{
    if (format == TN_FILE_CSV)
        return tn_place_write_list(p->rules.module, &p->model, out, error);
    tn_status status = format == TN_FILE_LDR ? TN_OK : has_shapes(p, error);
    if (status != TN_OK)
        return status;
    if (TN_WRITES_PICTURES >> format & 1)
        return draw(p, format, out, error);
    if (format != TN_FILE_LDR && format != TN_FILE_MPD)
        return parts_write_mesh(p->session->opened, &p->model, format, out, error);
    write_model(p, format == TN_FILE_MPD, out);
    return TN_OK;
}

static tn_status make_file(tn_model_placing *p, const char *word, tn_error *error)
{
    tn_file_format format;
    tn_making making;
    tn_made_file *file = TN_ADD(made_file, p->placed->files, error);
    tn_status status = file ? tn_file_format_named(word, TN_PLACED_FILES, &format, error) : TN_MEMORY;
    if (status == TN_OK)
        status = tn_making_begin(&making, p->session, format, NULL, file, error);
    if (status == TN_OK)
        status = tn_making_end(&making, write_as(p, format, making.stream, error), error);
    return status;
}

static tn_status make_program(tn_model_placing *p, tn_error *error)
{
    tn_making making;
    p->placed->has_program = true;
    tn_status status = tn_making_begin(&making, p->session, TN_FILE_OTHER, NULL, &p->placed->program, error);
    if (status != TN_OK)
        return status;
    tn_place_write_program(&p->model, &p->rules, making.stream);
    return tn_making_end(&making, TN_OK, error);
}

/* Says what failed, if something did. */
static tn_status say(const tn_model_placing *p, tn_status status, const tn_error *error)
{
    return status == TN_OK ? TN_OK : tn_session_fail(p->session, error);
}

/* Puts the parts by their kinds and all files that were asked for into the answer. What fails is said; the other files
 * are made. */
static tn_status placing_write(tn_model_placing *p)
{
    const tn_place_request *r = p->request;
    tn_error error;
    tn_status worst =
        say(p, tn_parts_by_kind(p->rules.module, &p->model, (tn_list *)&p->placed->parts, &error), &error);
    for (size_t i = 0; i < r->formats.count; i++)
        worst = tn_graver(worst, say(p, make_file(p, r->formats.items[i], &error), &error));
    if (r->program)
        worst = tn_graver(worst, say(p, make_program(p, &error), &error));
    return worst;
}

/* ---- says line by line what became of each alternative while a model was placed */

static void write_place(const tn_model_placing *p, tn_span span, FILE *out)
{
    tn_place place = tn_sources_place(&p->session->opened->compilation.sources, span);
    fprintf(out, "%s:%zu", place.path, place.line);
}

static void write_step(const tn_model_placing *p, uint32_t step, FILE *out)
{
    size_t length;
    const char *text = tn_step_text(&p->rules, &p->rules.steps[step], &length);
    fprintf(out, "'%.*s' of ", (int)length, text);
    write_place(p, tn_place_step_span(&p->rules, step), out);
}

static void write_refusal(const tn_model_placing *p, const tn_place_event *event, FILE *out)
{
    const tn_place_obstacle *o = &event->obstacle;
    fputs("does not fit: ", out);
    write_step(p, event->step, out);
    if (!o->known) {
        fputs(" has nothing to touch", out);
    } else if (!o->has_step) {
        fprintf(out, " meets %s at %d %d %d", p->rules.space ? "the end of the space" : "a bound", o->cell[0],
                o->cell[1], o->cell[2]);
    } else {
        fprintf(out, " meets, at %d %d %d, what ", o->cell[0], o->cell[1], o->cell[2]);
        write_step(p, o->step, out);
        fprintf(out, " filled after %u part%s", o->parts, o->parts == 1 ? "" : "s");
    }
}

/* Writes a line about an event to the trace. */
static void placing_trace(const tn_model_placing *p, const tn_place_event *event)
{
    static const char *const words[] = {"", "is taken", "is drawn", "is taken although it does not fit"};
    const tn_place_rules *rules = &p->rules;
    const tn_frame *frame = event->frame;
    FILE *out = p->trace.stream;
    fprintf(out, "%zu part%s", event->parts, event->parts == 1 ? "" : "s");
    if (frame)
        fprintf(out, ", at %d %d %d heading %u", frame->at[0], frame->at[1], frame->at[2], frame->heading);
    fprintf(out, ": %s of ", rules->symbols[tn_place_symbol_of(rules, event->alternative)].name);
    write_place(p, tn_place_alternative_span(rules, event->alternative), out);
    fputc(' ', out);
    if (event->outcome == TN_PLACE_REFUSED)
        write_refusal(p, event, out);
    else if (rules->space && rules->alternatives[event->alternative].count == 0)
        fputs("is left open", out);
    else
        fputs(words[event->outcome], out);
    fputc('\n', out);
}

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
    if (r->steps && !placing_read_steps(r->steps, &wish))
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
    placing_trace(context, event);
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
    tn_status status = placing_find_steps(p);
    if (status != TN_OK)
        return status;
    p->placed->ended = ended;
    return placing_write(p);
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
