/* Keeps marks of drawings; draws dimensions and levels. */
#include "runtime/house/model/marks.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/utf8.h"
#include "runtime/house/solids.h"

void tn_marks_clear(tn_marks *marks)
{
    free(marks->items);
    *marks = (tn_marks){0};
}

static void add(tn_marks *marks, tn_mark mark)
{
    if (!tn_array_reserve_from(&marks->items, &marks->room, 64, marks->count, 1, sizeof *marks->items))
        marks->failed = true;
    else
        marks->items[marks->count++] = mark;
}

void tn_marks_line(tn_marks *marks, tn_mark_layer layer, double u0, double v0, double u1, double v1)
{
    add(marks, (tn_mark){TN_MARK_LINE, layer, u0, v0, u1, v1, .high = 0});
}

void tn_marks_arc(tn_marks *marks, tn_mark_layer layer, double u0, double v0, double u1, double v1)
{
    add(marks, (tn_mark){TN_MARK_ARC, layer, u0, v0, u1, v1, .high = 0});
}

void tn_marks_text(tn_marks *marks, tn_mark_layer layer, double u, double v, double high, bool upright,
                   const char *text)
{
    tn_mark mark = {TN_MARK_TEXT, layer, u, v, u, v, high, upright, ""};
    tn_utf8_copy(text, sizeof mark.text, mark.text);
    add(marks, mark);
}

double tn_mark_width(const char *text)
{
    unsigned columns = 0;
    for (size_t left = strlen(text), size; left > 0; text += size, left -= size)
        columns += tn_character_width(tn_utf8_read(text, left, &size));
    return 0.62 * columns; /* letters and digits of a sans serif, on the mean, with a little room */
}

void tn_marks_dimension(tn_marks *marks, const tn_house *house, double from, double to, double at, bool upright,
                        double lettering)
{
    char text[64];
    double tick = lettering * 0.4, middle = (from + to) / 2, room = to - from;
    tn_length_write_style((int64_t)(room + 0.5), tn_house_length_style(house), text, sizeof text);
    if (upright) {
        tn_marks_line(marks, TN_MARK_DIMENSION, at, from, at, to);
        tn_marks_line(marks, TN_MARK_DIMENSION, at - tick, from - tick, at + tick, from + tick);
        tn_marks_line(marks, TN_MARK_DIMENSION, at - tick, to - tick, at + tick, to + tick);
    } else {
        tn_marks_line(marks, TN_MARK_DIMENSION, from, at, to, at);
        tn_marks_line(marks, TN_MARK_DIMENSION, from - tick, at - tick, from + tick, at + tick);
        tn_marks_line(marks, TN_MARK_DIMENSION, to - tick, at - tick, to + tick, at + tick);
    }
    double high = lettering, wide = tn_mark_width(text) * lettering;
    if (wide > room)
        high *= room / wide;
    if (high < 0.4 * lettering)
        return; /* nobody could read it */
    tn_marks_text(marks, TN_MARK_DIMENSION, upright ? at - 0.8 * lettering : middle,
                  upright ? middle : at + 0.8 * lettering, high, upright, text);
}

/* ---- levels */

/* Heights of roofs are fractions: they are written to the nearest 1/8" or millimetre, as one would build them. */
static int64_t rounded(const tn_house *house, double v)
{
    int64_t step = tn_house_length_style(house) == TN_STYLE_FEET ? TN_INCH_NM / 8 : 1000000;
    return (int64_t)(v / (double)step + 0.5) * step;
}

/* A height, and what is written of it. */
typedef struct tn_level {
    double v;
    int64_t said;
    const char *name;
} tn_level;

static void put_level(tn_marks *marks, const tn_house *house, double u, double lettering, const tn_level *level)
{
    char text[sizeof marks->items->text], name[31], length[64];
    tn_length_write_style(level->said, tn_house_length_style(house), length, sizeof length);
    tn_utf8_copy(level->name, sizeof name, name);
    snprintf(text, sizeof text, "%s%s%.15s", name, name[0] ? " " : "", length);
    double wide = tn_mark_width(text) * lettering;
    tn_marks_line(marks, TN_MARK_DIMENSION, u - wide - lettering, level->v, u, level->v);
    tn_marks_text(marks, TN_MARK_DIMENSION, u - lettering - wide / 2, level->v + 0.7 * lettering, lettering, false,
                  text);
}

tn_status tn_marks_levels(const tn_house *house, const double low[2], const double high[2], double lettering,
                          tn_marks *marks, tn_error *error)
{
    const tn_house_form *form = house->form;
    double ground = -(double)form->record->deck, u = low[0] - lettering, beyond = 3 * lettering;
    tn_marks_line(marks, TN_MARK_GROUND, low[0] - beyond, ground, high[0] + beyond, ground);
    double last = -1e30;
    for (uint32_t k = 0; k <= form->record->storey_count; k++) {
        bool top = k == form->record->storey_count;
        tn_level level = {
            (double)form->level[k], form->level[k],
            top ? "" : tn_text(form->module, form->module->STOREY_records[form->record->storey_first + k].name)};
        if (level.v > high[1] || level.v - last < 1.6 * lettering)
            continue;
        put_level(marks, house, u, lettering, &level);
        last = level.v;
    }
    if (high[1] - last >= 1.6 * lettering)
        put_level(marks, house, u, lettering, &(tn_level){high[1], rounded(house, high[1]), "top"});
    return marks->failed ? tn_fail_memory(error) : TN_OK;
}
