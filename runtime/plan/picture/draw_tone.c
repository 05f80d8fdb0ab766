/* Tones and hatches: what tells the values of a tray apart at a glance. */
#include <math.h>
#include <string.h>

#include "runtime/draw/type.h"
#include "runtime/plan/picture/draw_parts.h"

/* ---- what a schema's roles mean for drawing it */

/* Can a band be absent, going by the roles and depths of its values? */
static bool may_be_absent(const tn_schema *schema, uint32_t field)
{
    for (uint32_t v = schema->value_start[field]; v < schema->value_start[field + 1]; v++)
        if (schema->values[v].role == TN_FILL_ABSENT || schema->values[v].length == 0)
            return true;
    return false;
}

static void take_choice(tn_draw_roles *roles, uint32_t field, tn_field_role role)
{
    uint32_t *taken = role == TN_ROLE_TEXT ? &roles->text : role == TN_ROLE_TONE ? &roles->tone : &roles->hatch;
    if (roles->schema->fields[field].kind == TN_FIELD_CHOICE && *taken == TN_NO_FIELD)
        *taken = field;
}

/* What a tray is for: the first field of three names or more that has no role, or else the first of two. */
static uint32_t main_choice(const tn_schema *schema)
{
    uint32_t found = TN_NO_FIELD;
    for (uint32_t f = 0; f < schema->field_count; f++) {
        if (schema->fields[f].kind != TN_FIELD_CHOICE || schema->fields[f].role != TN_ROLE_NONE)
            continue;
        if (schema->fields[f].value_count >= 3)
            return f;
        found = found == TN_NO_FIELD ? f : found;
    }
    return found;
}

static void take_role(tn_draw_roles *roles, uint32_t field)
{
    const tn_field_record *record = &roles->schema->fields[field];
    switch ((tn_field_role)record->role) {
    case TN_ROLE_LENGTH:
        if (record->kind == TN_FIELD_LENGTH && roles->length == TN_NO_FIELD)
            roles->length = field;
        break;
    case TN_ROLE_LEVEL:
        if (roles->level == TN_NO_FIELD)
            roles->level = field;
        break;
    case TN_ROLE_PUBLIC_END:
        if (record->kind == TN_FIELD_FLAG && roles->public_end == TN_NO_FIELD)
            roles->public_end = field;
        break;
    case TN_ROLE_GREAT_HALL:
        if (record->kind == TN_FIELD_FLAG && roles->great_hall == TN_NO_FIELD)
            roles->great_hall = field;
        break;
    case TN_ROLE_BAND:
        if (record->kind == TN_FIELD_ZONE && roles->band_count < TN_BANDS_MAX)
            roles->bands[roles->band_count++] = field;
        break;
    case TN_ROLE_TEXT:
    case TN_ROLE_TONE:
    case TN_ROLE_HATCH:
        take_choice(roles, field, (tn_field_role)record->role);
        break;
    case TN_ROLE_NONE:
    case TN_FIELD_ROLE_COUNT:
        break;
    }
}

void tn_draw_roles_find(const tn_schema *schema, tn_draw_roles *roles)
{
    *roles = (tn_draw_roles){schema,
                             .length = TN_NO_FIELD,
                             .level = TN_NO_FIELD,
                             .public_end = TN_NO_FIELD,
                             .great_hall = TN_NO_FIELD,
                             .text = TN_NO_FIELD,
                             .tone = TN_NO_FIELD,
                             .hatch = TN_NO_FIELD};
    for (uint32_t field = 0; field < schema->field_count; field++)
        take_role(roles, field);
    if (roles->text == TN_NO_FIELD)
        roles->text = roles->tone == TN_NO_FIELD ? main_choice(schema) : roles->tone;
    if (roles->tone == TN_NO_FIELD)
        roles->tone = roles->text;
    roles->to_scale = roles->length != TN_NO_FIELD && roles->band_count > 0;
    while (roles->spine < roles->band_count && may_be_absent(schema, roles->bands[roles->spine]))
        roles->spine++;
    if (roles->spine == roles->band_count)
        roles->spine = 0;
    uint32_t length = roles->length != TN_NO_FIELD ? roles->length : tn_schema_length_field(schema);
    if (length != TN_NO_FIELD)
        roles->style = tn_length_style_of(tn_text(schema->module, schema->values[schema->value_start[length]].name));
}

bool tn_draw_written(const tn_draw_roles *roles, uint32_t field)
{
    if (field == roles->length || field == roles->level || field == roles->public_end || field == roles->great_hall)
        return false;
    for (uint32_t b = 0; b < roles->band_count; b++)
        if (roles->bands[b] == field)
            return false;
    return true;
}

void tn_draw_length(const tn_draw_roles *roles, int64_t nanometres, char *text, size_t size)
{
    tn_length_write_style(nanometres, roles->style, text, size);
}

#define DENSE 1.5  /* how much wider than a material's lines those of solid fills are */
#define COARSE 2.8 /* light ones */

/* Of what has no pattern: it is left plain. */
#define PLAIN TN_HATCH_COUNT

/* The hatches of neighbours meet. */
static void hatch(tn_paint *paint, tn_hatch how, double size, double x, double y, double width, double height)
{
    if (how == PLAIN)
        return;
    tn_paint_rectangle(paint, x, y, width, height);
    tn_paint_layer(paint, TN_LAYER_AREA_HATCH);
    tn_paint_weight(paint, TN_WEIGHT_HATCH);
    tn_paint_hatch(paint, how, how == TN_HATCH_TILES ? size / 2 : size);
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

void tn_draw_fill(tn_paint *paint, const tn_draw_roles *roles, uint32_t value, double x, double y, double width,
                  double height)
{
    static const tn_hatch solids[] = {TN_HATCH_DIAGONAL, TN_HATCH_CROSSED, TN_HATCH_FALLING,
                                      TN_HATCH_UPRIGHT,  TN_HATCH_LEVEL,   TN_HATCH_TILES},
                          voids[] = {PLAIN, TN_HATCH_DOTTED, TN_HATCH_LEVEL, TN_HATCH_UPRIGHT},
                          others[] = {
                              PLAIN,         TN_HATCH_DOTTED, TN_HATCH_DIAGONAL, TN_HATCH_FALLING, TN_HATCH_UPRIGHT,
                              TN_HATCH_LEVEL};
    tn_fill_role role = (tn_fill_role)roles->schema->values[value].role;
    unsigned before = names_before(roles, value);
    if (role == TN_FILL_SOLID)
        hatch(paint, solids[before % (sizeof solids / sizeof *solids)], DENSE, x, y, width, height);
    else if (role == TN_FILL_VOID)
        hatch(paint, voids[before % (sizeof voids / sizeof *voids)], COARSE, x, y, width, height);
    else
        hatch(paint, others[before % (sizeof others / sizeof *others)], COARSE, x, y, width, height);
    tn_paint_rectangle(paint, x, y, width, height);
    tn_paint_layer(paint, TN_LAYER_AREA);
    tn_paint_weight(paint, role == TN_FILL_SOLID ? TN_WEIGHT_THIN : TN_WEIGHT_HATCH);
    tn_paint_stroke(paint);
}

/* The first value of a choice is plain, the others are hatched. */
static tn_hatch choice_hatch(uint32_t number)
{
    static const tn_hatch hatches[] = {PLAIN,          TN_HATCH_DIAGONAL, TN_HATCH_FALLING, TN_HATCH_CROSSED,
                                       TN_HATCH_LEVEL, TN_HATCH_UPRIGHT,  TN_HATCH_TILES,   TN_HATCH_DOTTED};
    return hatches[number % (sizeof hatches / sizeof *hatches)];
}

/* Pale, so that black lettering is read on all; past the last they begin anew, hatched. */
void tn_draw_tone(tn_paint *paint, const tn_draw_roles *roles, uint32_t value, double x, double y, double width,
                  double height)
{
    static const double tones[][3] = {{0.99, 0.90, 0.70}, {0.74, 0.87, 0.95}, {0.80, 0.91, 0.73}, {0.97, 0.80, 0.76},
                                      {0.86, 0.81, 0.93}, {0.90, 0.90, 0.88}, {0.72, 0.91, 0.87}, {0.96, 0.86, 0.93},
                                      {0.90, 0.83, 0.72}, {0.93, 0.95, 0.65}};
    const uint32_t count = sizeof tones / sizeof *tones;
    if (roles->tone == TN_NO_FIELD)
        return;
    const double *tone = tones[value % count];
    tn_paint_layer(paint, TN_LAYER_AREA_HATCH);
    tn_paint_colour(paint, tone[0], tone[1], tone[2]);
    tn_paint_rectangle(paint, x, y, width, height);
    tn_paint_fill(paint);
    tn_paint_colour(paint, 0.45, 0.45, 0.45);
    hatch(paint, choice_hatch(value / count), COARSE, x, y, width, height);
    tn_paint_colour(paint, 0, 0, 0);
}

void tn_draw_hatch(tn_paint *paint, const tn_draw_roles *roles, uint32_t value, double x, double y, double width,
                   double height)
{
    if (roles->hatch == TN_NO_FIELD)
        return;
    tn_paint_colour(paint, 0.6, 0.6, 0.6);
    hatch(paint, choice_hatch(value), COARSE, x, y, width, height);
    tn_paint_colour(paint, 0, 0, 0);
}

/* How a text is set in a rectangle: smaller rather than cut off, upright where that is the only way that it fits. */
typedef struct inside {
    double size, across;
    bool upright;
} inside;

static const double INSIDE_APART = 2;

static inside set_inside(tn_paint *paint, const char *text, double size, double width, double height)
{
    tn_paint_face(paint, size, true);
    double needs = tn_type_width(paint, text) + INSIDE_APART;
    if (needs > width && needs > height) {
        size = fmax(TN_INSIDE_LEAST, 0.99 * size * (fmax(width, height) - INSIDE_APART) / (needs - INSIDE_APART));
        tn_paint_face(paint, size, true);
        needs = tn_type_width(paint, text) + INSIDE_APART;
    }
    bool upright = needs > width && needs <= height && width >= size;
    return (inside){size, fmin(needs + INSIDE_APART, upright ? height : width), upright};
}

void tn_draw_inside_room(tn_paint *paint, const char *text, double size, double *width, double *height)
{
    inside set = set_inside(paint, text, size, *width, *height);
    *width = set.upright ? set.size * 1.2 : set.across;
    *height = set.upright ? set.across : set.size * 1.2;
}

void tn_draw_inside(tn_paint *paint, const char *text, double size, bool hatched, double x, double y, double width,
                    double height)
{
    inside set = set_inside(paint, text, size, width, height);
    tn_paint_save(paint);
    tn_paint_layer(paint, TN_LAYER_ROOM);
    tn_paint_translate(paint, x + width / 2, y + height / 2);
    if (set.upright)
        tn_paint_rotate(paint, -3.14159265358979323846 / 2);
    if (hatched) {
        tn_paint_rectangle(paint, -set.across / 2, -set.size * 0.6, set.across, set.size * 1.2);
        tn_paint_translucent(paint, 1, 1, 1, 0.8);
        tn_paint_fill(paint);
        tn_paint_colour(paint, 0, 0, 0);
    }
    tn_type_fit(paint, 0, set.size * 0.36, TN_ALIGN_CENTRE, set.upright ? height : width - INSIDE_APART, text);
    tn_paint_restore(paint);
}
