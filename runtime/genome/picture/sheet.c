/* Sentences side by side, each in a cell with its number and its score. */
#include "runtime/genome/picture/sheet.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "runtime/draw/canvas.h"
#include "runtime/draw/type.h"

/* In points. */
#define CELL_WIDTH 200.0
#define MARGIN 24.0
#define INSET 8.0
#define HEAD 24.0 /* of a cell: its number and score */
#define LEADING 10.0
#define LINES_MAX 18u
#define LETTERS 30u /* about as many as a line holds */

/* The lines of a sentence that hold something, each as often as it is broken. */
static unsigned count_lines(const char *sentence)
{
    unsigned lines = 0;
    for (const char *at = sentence; at && *at && lines < LINES_MAX;) {
        size_t size = strcspn(at, "\n");
        lines += (unsigned)((size + LETTERS - 1) / LETTERS);
        at += size + (at[size] == '\n');
    }
    return lines < 1 ? 1 : lines < LINES_MAX ? lines : LINES_MAX;
}

static void draw_sentence(tn_paint *paint, double x, double y, const char *sentence, unsigned room)
{
    char line[512];
    tn_paint_face(paint, 8, false);
    for (const char *at = sentence; *at && room > 0;) {
        size_t size = strcspn(at, "\n"), kept = size < sizeof line ? size : sizeof line - 1;
        snprintf(line, sizeof line, "%.*s", (int)kept, at);
        unsigned used = tn_type_paragraph(paint, x, y, CELL_WIDTH - 3 * INSET, LEADING, room, line);
        y += used * LEADING;
        room -= used;
        at += size + (at[size] == '\n');
    }
}

static void draw_cell(tn_paint *paint, double x, double y, double height, size_t number, const tn_individual *member)
{
    char text[96];
    const char *missing = member->reason != TN_MAPPING_VALID ? tn_mapping_reason_text(member->reason)
                          : !member->sentence_size           ? "no text"
                                                             : NULL;
    tn_paint_colour(paint, 0.8, 0.8, 0.8);
    tn_paint_line_width(paint, 0.6);
    tn_paint_rectangle(paint, x, y, CELL_WIDTH - INSET, height - INSET);
    tn_paint_stroke(paint);
    tn_paint_colour(paint, 0.1, 0.2, 0.5);
    tn_paint_face(paint, 14, true);
    snprintf(text, sizeof text, "%zu", number);
    tn_type_line(paint, x + INSET, y + 18, TN_ALIGN_LEFT, text);
    tn_paint_colour(paint, 0.4, 0.4, 0.4);
    tn_paint_face(paint, 7, false);
    if (member->score.state == TN_SCORED)
        snprintf(text, sizeof text, "individual %" PRIu64 ", score %.5g", member->id, member->score.objectives[0]);
    else
        snprintf(text, sizeof text, "individual %" PRIu64 ", no score", member->id);
    tn_type_line(paint, x + CELL_WIDTH - 2 * INSET, y + 18, TN_ALIGN_RIGHT, text);
    if (!missing)
        tn_paint_colour(paint, 0, 0, 0);
    draw_sentence(paint, x + INSET, y + HEAD + LEADING, missing ? missing : member->sentence,
                  (unsigned)((height - INSET - HEAD - INSET) / LEADING));
}

tn_status tn_sentences_draw(const tn_individual *const *members, size_t count, const char *title, tn_picture *to,
                            tn_error *error)
{
    unsigned lines = 1;
    for (size_t i = 0; i < count; i++) {
        unsigned own = count_lines(members[i]->sentence);
        lines = own > lines ? own : lines;
    }
    double height = HEAD + (lines + 1) * LEADING + INSET;
    size_t columns = (size_t)ceil(sqrt((double)count * height / CELL_WIDTH));
    columns = columns < 3 ? 3 : columns;
    size_t rows = (count + columns - 1) / columns;
    tn_canvas_options options = {.width = 2 * MARGIN + (double)columns * CELL_WIDTH,
                                 .height = 2 * MARGIN + (double)rows * height,
                                 .title = title};
    tn_canvas *canvas = NULL;
    tn_status status = tn_canvas_open(to, &options, &canvas, error);
    if (status == TN_OK) {
        for (size_t i = 0; i < count; i++)
            draw_cell(tn_canvas_paint(canvas), MARGIN + (double)(i % columns) * CELL_WIDTH,
                      MARGIN + (double)(i / columns) * height, height, i + 1, members[i]);
        status = tn_canvas_commit(canvas, error);
    }
    tn_canvas_free(canvas);
    return status;
}
