/* What is made of a placed model: its parts by kind, and files; and the steps in which it is built. */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "ask/place/parts.h"
#include "ask/place/placing.h"
#include "runtime/base/array.h"

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

bool tn_placing_read_steps(const char *text, tn_steps_wish *wish)
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
    return r->steps ? tn_placing_read_steps(r->steps, wish) : needed || said;
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

tn_status tn_placing_find_steps(tn_model_placing *p)
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
        return tn_parts_write_mesh(p->session->opened, &p->model, format, out, error);
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

tn_status tn_placing_write(tn_model_placing *p)
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
