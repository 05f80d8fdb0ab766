/* Tones and hatches: what tells the values of a tray apart at a glance. */
#include <math.h>
#include <string.h>

#include "runtime/draw/type.h"
#include "runtime/plan/picture/draw_parts.h"

#define HATCH_SPACING 2.8
#define COARSE 1.9 /* how much wider light hatches are */
#define DOT 0.7

typedef enum hatching { PLAIN, RISING, FALLING, CROSSED, LEVEL, UPRIGHT, GRID, DOTTED, HATCHINGS } hatching;

/* Lines at 45 degrees, x + y = a multiple of the spacing, so that the hatches of neighbours meet. */
static void rising(cairo_t *context, double spacing, double x, double y, double width, double height)
{
    for (double sum = ceil((x + y) / spacing) * spacing; sum < x + y + width + height; sum += spacing) {
        double from = fmax(x, sum - y - height), to = fmin(x + width, sum - y);
        if (to - from < 0.01)
            continue;
        cairo_move_to(context, from, sum - from);
        cairo_line_to(context, to, sum - to);
    }
}

/* The same mirrored: x - y = a multiple of the spacing. */
static void falling(cairo_t *context, double spacing, double x, double y, double width, double height)
{
    for (double lead = ceil((x - y - height) / spacing) * spacing; lead < x + width - y; lead += spacing) {
        double from = fmax(x, lead + y), to = fmin(x + width, lead + y + height);
        if (to - from < 0.01)
            continue;
        cairo_move_to(context, from, from - lead);
        cairo_line_to(context, to, to - lead);
    }
}

static void level(cairo_t *context, double spacing, double x, double y, double width, double height)
{
    for (double at = ceil((y + 0.01) / spacing) * spacing; at < y + height; at += spacing) {
        cairo_move_to(context, x, at);
        cairo_line_to(context, x + width, at);
    }
}

static void upright(cairo_t *context, double spacing, double x, double y, double width, double height)
{
    for (double at = ceil((x + 0.01) / spacing) * spacing; at < x + width; at += spacing) {
        cairo_move_to(context, at, y);
        cairo_line_to(context, at, y + height);
    }
}

/* Dashed lines, which take a hundredth of the bytes of so many points. */
static void dotted(cairo_t *context, double spacing, double x, double y, double width, double height)
{
    const double dashes[] = {DOT, spacing - DOT};
    cairo_save(context);
    cairo_set_dash(context, dashes, 2, x - floor(x / spacing) * spacing);
    level(context, spacing, x, y, width, height);
    cairo_set_line_width(context, DOT);
    cairo_stroke(context);
    cairo_restore(context);
}

static void hatch(cairo_t *context, hatching how, double spacing, double x, double y, double width, double height)
{
    if (how == RISING || how == CROSSED)
        rising(context, spacing, x, y, width, height);
    if (how == FALLING || how == CROSSED)
        falling(context, spacing, x, y, width, height);
    if (how == LEVEL || how == GRID)
        level(context, spacing, x, y, width, height);
    if (how == UPRIGHT || how == GRID)
        upright(context, spacing, x, y, width, height);
    cairo_set_line_width(context, TN_LINE_HAIR + 0.08);
    cairo_stroke(context);
    if (how == DOTTED)
        dotted(context, spacing, x, y, width, height);
}

/* How many fills of that role, but of other names, the bands have before this one. */
static unsigned names_before(const tn_draw_roles *roles, uint32_t value)
{
    const tn_schema *schema = roles->schema;
    const char *names[TN_BANDS_MAX];
    unsigned count = 0;
    for (uint32_t b = 0; b < roles->band_count; b++) {
        uint32_t field = roles->bands[b];
        for (uint32_t v = schema->value_start[field]; v < schema->value_start[field + 1]; v++) {
            const char *name = tn_text(schema->module, schema->values[v].name);
            unsigned known = 0;
            if (schema->values[v].role != schema->values[value].role || count == TN_BANDS_MAX)
                continue;
            while (known < count && strcmp(names[known], name) != 0)
                known++;
            if (strcmp(name, tn_text(schema->module, schema->values[value].name)) == 0)
                return known;
            if (known == count)
                names[count++] = name;
        }
    }
    return 0;
}

void tn_draw_fill(cairo_t *context, const tn_draw_roles *roles, uint32_t value, double x, double y, double width,
                  double height)
{
    static const hatching solids[] = {RISING, CROSSED, FALLING, UPRIGHT, LEVEL, GRID},
                          voids[] = {PLAIN, DOTTED, LEVEL, UPRIGHT},
                          others[] = {PLAIN, DOTTED, RISING, FALLING, UPRIGHT, LEVEL};
    tn_fill_role role = (tn_fill_role)roles->schema->values[value].role;
    unsigned before = names_before(roles, value);
    if (role == TN_FILL_SOLID)
        hatch(context, solids[before % (sizeof solids / sizeof *solids)], HATCH_SPACING, x, y, width, height);
    else if (role == TN_FILL_VOID)
        hatch(context, voids[before % (sizeof voids / sizeof *voids)], HATCH_SPACING * COARSE, x, y, width, height);
    else
        hatch(context, others[before % (sizeof others / sizeof *others)], HATCH_SPACING * COARSE, x, y, width, height);
    cairo_rectangle(context, x, y, width, height);
    cairo_set_line_width(context, role == TN_FILL_SOLID ? TN_LINE_EDGE : TN_LINE_HAIR);
    cairo_stroke(context);
}

/* Pale, so that black lettering is read on all; past the last they begin anew, hatched. */
void tn_draw_tone(cairo_t *context, const tn_draw_roles *roles, uint32_t value, double x, double y, double width,
                  double height)
{
    static const double tones[][3] = {{0.99, 0.90, 0.70}, {0.74, 0.87, 0.95}, {0.80, 0.91, 0.73}, {0.97, 0.80, 0.76},
                                      {0.86, 0.81, 0.93}, {0.90, 0.90, 0.88}, {0.72, 0.91, 0.87}, {0.96, 0.86, 0.93},
                                      {0.90, 0.83, 0.72}, {0.93, 0.95, 0.65}};
    const uint32_t count = sizeof tones / sizeof *tones;
    if (roles->tone == TN_NO_FIELD)
        return;
    const double *tone = tones[value % count];
    cairo_set_source_rgb(context, tone[0], tone[1], tone[2]);
    cairo_rectangle(context, x, y, width, height);
    cairo_fill(context);
    cairo_set_source_rgb(context, 0.45, 0.45, 0.45);
    hatch(context, (hatching)(value / count % HATCHINGS), HATCH_SPACING * COARSE, x, y, width, height);
    cairo_set_source_rgb(context, 0, 0, 0);
}

void tn_draw_hatch(cairo_t *context, const tn_draw_roles *roles, uint32_t value, double x, double y, double width,
                   double height)
{
    if (roles->hatch == TN_NO_FIELD)
        return;
    cairo_set_source_rgb(context, 0.6, 0.6, 0.6);
    hatch(context, (hatching)(value % HATCHINGS), HATCH_SPACING * COARSE, x, y, width, height);
    cairo_set_source_rgb(context, 0, 0, 0);
}

void tn_draw_inside(cairo_t *context, const char *text, double size, bool hatched, double x, double y, double width,
                    double height)
{
    const double apart = 2;
    tn_type_face(context, size, true);
    double needs = tn_type_width(context, text) + apart;
    if (needs > width && needs > height) { /* smaller rather than cut off */
        size = fmax(TN_INSIDE_LEAST, 0.99 * size * (fmax(width, height) - apart) / (needs - apart));
        tn_type_face(context, size, true);
        needs = tn_type_width(context, text) + apart;
    }
    bool upright = needs > width && needs <= height && width >= size;
    double across = fmin(needs + apart, upright ? height : width);
    cairo_save(context);
    cairo_translate(context, x + width / 2, y + height / 2);
    if (upright)
        cairo_rotate(context, -3.14159265358979323846 / 2);
    if (hatched) {
        cairo_rectangle(context, -across / 2, -size * 0.6, across, size * 1.2);
        cairo_set_source_rgba(context, 1, 1, 1, 0.8);
        cairo_fill(context);
        cairo_set_source_rgb(context, 0, 0, 0);
    }
    tn_type_fit(context, 0, size * 0.36, TN_ALIGN_CENTRE, upright ? height : width - apart, text);
    cairo_restore(context);
}
