/* What `tartan place` writes: models, lists, pictures and meshes; and the steps in which a model is built. */
#include <ctype.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "cli/place/placing.h"
#include "driver/mesh/mesh_file.h"
#include "driver/place/shape.h"
#include "runtime/base/formats.h"

out_format tn_place_format(const char *path)
{
    tn_file_format format = tn_file_format_of(path);
    if (strcmp(path, "-") == 0 || format == TN_FILE_LDR)
        return OUT_LDRAW;
    if (format == TN_FILE_CSV)
        return OUT_LIST;
    if (format == TN_FILE_MPD)
        return OUT_SUBFILES;
    return TN_WRITES_PICTURES >> format & 1 ? OUT_PICTURE : OUT_MESH;
}

/* Pictures and meshes show the parts of a kit. */
static bool has_shapes(placing *p)
{
    tn_error error;
    if (p->rules.space)
        return true;
    tn_fail(&error, TN_INVALID, E_PLACE_NO_SHAPE, "a connection grammar does not say what its parts look like");
    tn_error_help(&error, "write an .ldr file, and draw it by `tartan inspect FILE.ldr --kit bricks -o FILE.svg`");
    tn_job_fail(p->job, &error);
    return false;
}

/* ---- steps */

bool tn_place_read_steps(const char *text, tn_steps_wish *wish)
{
    char *end;
    *wish = (tn_steps_wish){.layers = strcmp(text, "layer") == 0, .parts = 1};
    if (wish->layers || strcmp(text, "part") == 0)
        return true;
    unsigned long long count = strtoull(text, &end, 10);
    wish->parts = (size_t)count;
    return isdigit((unsigned char)*text) && !*end && count >= 1 && count <= TN_STEP_PARTS_MAX;
}

/* What --steps says, or the model; without either, sub-files and sheets are of layers. False where none are asked for.
 */
static bool choose_steps(placing *p, tn_steps_wish *wish)
{
    const char *asked = p->settings->steps;
    bool needed = p->settings->sheet;
    for (size_t i = 0; i < p->settings->outputs.count; i++)
        needed |= tn_place_format(p->settings->outputs.items[i]) == OUT_SUBFILES;
    bool said = tn_kit_model_steps(p->rules.space, wish);
    return asked ? tn_place_read_steps(asked, wish) : needed || said;
}

static void warn_of_steps(placing *p)
{
    tn_diagnostics *list = tn_job_diagnostics(p->job);
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

bool tn_place_find_steps(placing *p)
{
    tn_error error;
    tn_steps_wish wish;
    bool by_hand = p->settings->steps != NULL || p->settings->sheet;
    if (!choose_steps(p, &wish))
        return true;
    if (!p->rules.space)
        return !by_hand || has_shapes(p);
    tn_status status = tn_placed_steps_make(p->rules.module, &wish, p->watch, &p->model, &p->steps, &error);
    p->has_steps = status == TN_OK;
    if (status == TN_OK)
        warn_of_steps(p);
    else
        tn_job_fail(p->job, &error);
    return status == TN_OK;
}

/* ---- files */

static void write_picture(placing *p, const char *path)
{
    tn_placed_measures measures;
    tn_picture picture = {.path = path};
    tn_error error;
    if (!has_shapes(p))
        return;
    tn_status status = tn_placed_measure(p->rules.module, NULL, &p->model, p->watch, &measures, &error);
    if (status == TN_OK && p->settings->sheet)
        status = tn_placed_draw_steps(p->rules.module, &p->model, &measures, &p->steps, &picture, &error);
    else if (status == TN_OK)
        status = tn_placed_draw(p->rules.module, &p->model, &measures, NULL, NULL, &picture, &error);
    if (status != TN_OK)
        tn_job_fail(p->job, &error);
    tn_placed_measures_clear(&measures);
}

static void write_mesh(placing *p, const char *path)
{
    static const tn_mesh_changes none = {.triangulate = false};
    tn_file_format format = tn_file_format_of(path);
    unsigned char(*palette)[3] = NULL;
    tn_mesh mesh = {0};
    tn_output output;
    tn_error error;
    if (!has_shapes(p) || !tn_job_output(p->job, path, &output))
        return;
    tn_status status = tn_placed_mesh(p->rules.module, &p->model, &mesh, &palette, &error);
    if (status == TN_OK)
        status = tn_mesh_change(&p->job->opened, &none, format, &mesh, &error);
    const tn_mesh_style style = {.unit = TN_MESH_UNIT_MM, .colours = (const unsigned char(*)[3])palette};
    if (status == TN_OK)
        status = tn_mesh_file_write(&mesh, format, &style, output.stream, &error);
    if (status != TN_OK)
        tn_job_fail(p->job, &error);
    tn_job_close(p->job, &output, status == TN_OK);
    tn_mesh_clear(&mesh);
    free(palette);
}

static void write_model(const placing *p, out_format format, FILE *out)
{
    if (format == OUT_SUBFILES)
        fprintf(out, "0 FILE %s.ldr\n", tn_place_model_name(&p->rules));
    if (p->settings->header || p->rules.space)
        tn_place_write_header(&p->rules, (uint32_t)p->settings->seed.value, out);
    if (format == OUT_SUBFILES)
        tn_place_write_mpd(p->rules.module, &p->model, &p->steps, tn_place_model_name(&p->rules), out);
    else
        tn_place_write_ldraw(p->rules.module, &p->model, p->has_steps ? &p->steps : NULL, out);
}

static void write_output(placing *p, const char *path)
{
    tn_output output;
    tn_error error;
    tn_status status = TN_OK;
    out_format format = tn_place_format(path);
    if (format == OUT_PICTURE || format == OUT_MESH) {
        (format == OUT_PICTURE ? write_picture : write_mesh)(p, path);
        return;
    }
    if ((format == OUT_SUBFILES && !has_shapes(p)) || !tn_job_output(p->job, path, &output))
        return;
    if (format == OUT_LIST)
        status = tn_place_write_list(p->rules.module, &p->model, output.stream, &error);
    else
        write_model(p, format, output.stream);
    if (status != TN_OK)
        tn_job_fail(p->job, &error);
    tn_job_close(p->job, &output, status == TN_OK);
}

static void write_program(placing *p)
{
    tn_output output;
    if (!tn_job_output(p->job, p->settings->program, &output))
        return;
    tn_place_write_program(&p->model, &p->rules, output.stream);
    tn_job_commit(p->job, &output);
}

static void print_summary(placing *p)
{
    tn_output output;
    tn_error error;
    tn_status status = TN_OK;
    if (!tn_job_output(p->job, NULL, &output))
        return;
    if (p->settings->stats)
        tn_place_stats(&p->model, p->settings->stats == 2, output.stream);
    else
        status = tn_place_summary(&p->model, output.stream, &error);
    if (status != TN_OK)
        tn_job_fail(p->job, &error);
    tn_job_close(p->job, &output, status == TN_OK);
}

void tn_place_write_all(placing *p)
{
    const place_settings *s = p->settings;
    for (size_t i = 0; i < s->outputs.count; i++)
        write_output(p, s->outputs.items[i]);
    if (s->program)
        write_program(p);
    if (s->stats || (s->outputs.count == 0 && !s->program && !s->trace))
        print_summary(p);
}
