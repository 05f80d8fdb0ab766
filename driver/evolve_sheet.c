#include "driver/evolve_sheet.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "runtime/draw/canvas.h"
#include "runtime/draw/type.h"

/* In points. */
#define CELL_WIDTH 200.0
#define CELL_HEIGHT 130.0
#define MARGIN 24.0
#define INSET 8.0

static void draw_cell(cairo_t *t, double x, double y, size_t number, const tn_individual *member)
{
    char text[96];
    cairo_set_source_rgb(t, 0.8, 0.8, 0.8);
    cairo_set_line_width(t, 0.6);
    cairo_rectangle(t, x, y, CELL_WIDTH - INSET, CELL_HEIGHT - INSET);
    cairo_stroke(t);
    cairo_set_source_rgb(t, 0.1, 0.2, 0.5);
    tn_type_face(t, 14, true);
    snprintf(text, sizeof text, "%zu", number);
    tn_type_line(t, x + INSET, y + 18, TN_ALIGN_LEFT, text);
    cairo_set_source_rgb(t, 0.4, 0.4, 0.4);
    tn_type_face(t, 7, false);
    if (member->score.state == TN_SCORED)
        snprintf(text, sizeof text, "individual %" PRIu64 ", score %.5g", member->id, member->score.objectives[0]);
    else
        snprintf(text, sizeof text, "individual %" PRIu64 ", no score", member->id);
    tn_type_line(t, x + CELL_WIDTH - 2 * INSET, y + 18, TN_ALIGN_RIGHT, text);
    cairo_set_source_rgb(t, 0, 0, 0);
    tn_type_face(t, 8, false);
    const char *sentence =
        member->sentence && member->sentence[0] ? member->sentence : tn_map_reason_text(member->reason);
    tn_type_paragraph(t, x + INSET, y + 34, CELL_WIDTH - 3 * INSET, 10, 9, sentence);
}

/* Surfaces are drawn as they are, in the members' order; those without a score come last and are not drawn. */
static tn_status draw_surfaces(tn_run *run, const char *path, tn_error *error)
{
    size_t count, scored = 0;
    const tn_individual *const *members = tn_evolution_members(run->evolution, &count);
    const char **sentences = calloc(count + 1, sizeof *sentences);
    char title[80];
    if (!sentences)
        return tn_fail_memory(error);
    while (scored < count && members[scored]->score.state == TN_SCORED) {
        sentences[scored] = members[scored]->sentence;
        scored++;
    }
    snprintf(title, sizeof title, "generation %u: 1 to %zu, row by row", run->generations ? run->generations - 1 : 0,
             scored);
    tn_status status = tn_grower_draw(run->job->grower, sentences, scored, title, path, error);
    free(sentences);
    return status;
}

tn_status tn_run_sheet(tn_run *run, char *path, size_t size, tn_error *error)
{
    size_t count;
    const tn_individual *const *members = tn_evolution_members(run->evolution, &count);
    size_t columns = (size_t)ceil(sqrt((double)count * CELL_HEIGHT / CELL_WIDTH));
    columns = columns ? columns : 1;
    size_t rows = (count + columns - 1) / columns;
    tn_canvas_options options = {.width = 2 * MARGIN + (double)columns * CELL_WIDTH,
                                 .height = 2 * MARGIN + (double)rows * CELL_HEIGHT,
                                 .title = run->job->grammar->name};
    tn_canvas *canvas = NULL;
    snprintf(path, size, "%s/sheet-%04u.svg", run->dir, run->generations ? run->generations - 1 : 0);
    if (run->job->grower)
        return draw_surfaces(run, path, error);
    tn_status status = tn_canvas_new(path, TN_CANVAS_SVG, &options, &canvas, error);
    if (status == TN_OK) {
        for (size_t i = 0; i < count; i++)
            draw_cell(tn_canvas_context(canvas), MARGIN + (double)(i % columns) * CELL_WIDTH,
                      MARGIN + (double)(i / columns) * CELL_HEIGHT, i + 1, members[i]);
        status = tn_canvas_commit(canvas, error);
    }
    tn_canvas_free(canvas);
    return status;
}
