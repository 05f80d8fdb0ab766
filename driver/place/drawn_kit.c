/* Writes models as kits: one alternative that places all parts, from one that stands unturned. */
#include <ctype.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "driver/open/missing.h"
#include "driver/place/drawn.h"
#include "driver/place/kit.h"
#include "runtime/base/file.h"
#include "runtime/place/measure.h"
#include "runtime/place/write.h"

enum { PARTS_MAX = 10000 };

typedef struct drawing_kit {
    const tn_module *module;
    tn_placed_model model; /* a copy, turned; of parts that the kit has */
    const tn_kit_part_record **kinds;
    size_t first; /* the part from which the others are placed */
    FILE *out;
    tn_drawn_changes *changes;
    tn_error *error;
} drawing_kit;

/* ---- which parts */

static tn_status take_parts(drawing_kit *d, const tn_placed_model *model)
{
    d->model.parts = calloc(model->count + 1, sizeof *d->model.parts);
    d->kinds = calloc(model->count + 1, sizeof *d->kinds);
    if (!d->model.parts || !d->kinds)
        return tn_fail_memory(d->error);
    for (size_t i = 0; i < model->count; i++) {
        const tn_kit_part_record *kind = tn_kit_part_named(d->module, model->parts[i].name);
        if (!kind && d->changes->left_out++ == 0)
            snprintf(d->changes->first, sizeof d->changes->first, "%s", model->parts[i].name);
        d->changes->tilted += kind && model->parts[i].frame.heading >= TN_UPRIGHT_TURNS;
        if (!kind || model->parts[i].frame.heading >= TN_UPRIGHT_TURNS)
            continue;
        d->kinds[d->model.count] = kind;
        d->model.parts[d->model.count++] = model->parts[i];
    }
    if (d->model.count > PARTS_MAX)
        return tn_fail(d->error, TN_LIMIT, E_PLACE_LIMIT, "the model has more than %d parts, the most of one rule",
                       PARTS_MAX);
    if (d->model.count > 0)
        return TN_OK;
    if (d->changes->tilted) {
        tn_fail(d->error, TN_INVALID, E_DRAWN, "all parts of the model that the kit has lie on their side");
        tn_error_help(d->error, "an alternative of a rule turns parts about the vertical alone");
        return TN_INVALID;
    }
    tn_fail(d->error, TN_INVALID, E_PLACE_NOTHING, "the kit has none of the model's parts");
    tn_error_help(d->error, "name the kit that has them: `--kit bricks`");
    return TN_INVALID;
}

static tn_status check_overlaps(drawing_kit *d)
{
    tn_placed_measures measures;
    size_t i = 0;
    tn_status status = tn_placed_measure(d->module, NULL, &d->model, NULL, &measures, d->error);
    while (status == TN_OK && i < d->model.count && !measures.overlaps[i])
        i++;
    if (status == TN_OK && i < d->model.count) {
        status = tn_fail(d->error, TN_INVALID, E_DRAWN, "parts of the model overlap, the first a %.60s",
                         d->model.parts[i].name);
        tn_error_help(d->error, "`tartan inspect` with -o FILE.svg shows them in red; a kit places no part in another");
    }
    tn_placed_measures_clear(&measures);
    return status;
}

static bool has_connectors(const drawing_kit *d, size_t part)
{
    return d->kinds[part]->connector_count > 0;
}

/* A part that can be the first of an alternative: it has connectors, and stands unturned; where none does, all parts
 * are turned about the vertical. */
static tn_status choose_first(drawing_kit *d)
{
    size_t any = d->model.count;
    for (d->first = 0; d->first < d->model.count; d->first++) {
        if (!has_connectors(d, d->first))
            continue;
        if (d->model.parts[d->first].frame.heading == 0)
            return TN_OK;
        any = any < d->model.count ? any : d->first;
    }
    if (any == d->model.count) {
        tn_fail(d->error, TN_INVALID, E_DRAWN, "no part of the model has a connector, and a rule begins at one");
        tn_error_help(d->error, "export the model with --pcfg, which needs none");
        return TN_INVALID;
    }
    d->first = any;
    d->changes->turns = 4 - d->model.parts[any].frame.heading;
    for (size_t i = 0; i < d->model.count; i++) {
        tn_frame *frame = &d->model.parts[i].frame, from = *frame;
        tn_turn_place(d->changes->turns, from.at, frame->at);
        frame->heading = tn_turn_after(d->changes->turns, from.heading);
    }
    return TN_OK;
}

/* ---- writing */

static void write_vector(const drawing_kit *d, const int32_t at[3])
{
    const tn_frame upwards = {.at = {at[0], -at[1], at[2]}};
    fputc('(', d->out);
    tn_place_write_at(d->module, &upwards, ", ", d->out);
    fputc(')', d->out);
}

/* Names that are no number, or number and letters, stand in quotes. */
static void write_name(const char *name, FILE *out)
{
    bool plain = isdigit((unsigned char)*name);
    for (const char *c = name; *c; c++)
        plain &= isdigit((unsigned char)*c) || (islower((unsigned char)*c) && !c[1]);
    fprintf(out, plain ? "%s" : "\"%s\"", name);
}

static void write_part(const drawing_kit *d, size_t i)
{
    const tn_placed_part *part = &d->model.parts[i];
    const int32_t *from = d->model.parts[d->first].frame.at, *at = part->frame.at;
    write_name(part->name, d->out);
    fprintf(d->out, " in %" PRId32 " stop", part->frame.colour);
    if (i == d->first)
        return;
    fputs(" at ", d->out);
    write_vector(d, (int32_t[3]){at[0] - from[0], at[1] - from[1], at[2] - from[2]});
    if (part->frame.heading)
        fprintf(d->out, " turn %" PRIu32, part->frame.heading);
}

static void write_rule(const drawing_kit *d, const char *connector)
{
    fprintf(d->out, "rule drawn at %s = {\n  ", connector);
    write_part(d, d->first);
    for (size_t i = 0; i < d->model.count; i++) {
        if (i == d->first)
            continue;
        fputs(",\n  ", d->out);
        write_part(d, i);
    }
    fputs("\n};\n", d->out);
}

/* Around all parts: twice the middle is a whole number of cells. */
static void write_space(const drawing_kit *d)
{
    tn_cell_box all = {{INT32_MAX, INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN, INT32_MIN}};
    for (size_t i = 0; i < d->model.count; i++) {
        for (uint32_t b = 0; b < d->kinds[i]->box_count; b++) {
            tn_cell_box box =
                tn_part_box_at(&d->module->PART_BOX_records[d->kinds[i]->box_first + b], &d->model.parts[i].frame);
            tn_cell_box_widen(&all, &box);
        }
    }
    const tn_kit_record *kit = &d->module->KIT_records[0];
    const int64_t unit[3] = {kit->unit_x, kit->unit_y, kit->unit_z};
    double size[3], middle[3];
    for (int k = 0; k < 3; k++) {
        size[k] = (double)((int64_t)all.high[k] - all.low[k]) * (double)unit[k] / 1e6;
        middle[k] = (double)((int64_t)all.high[k] + all.low[k]) * (double)unit[k] / 2e6;
    }
    fprintf(d->out, "  inside box(%.12g, %.12g, %.12g) at (%.12g, %.12g, %.12g);\n", size[0], size[1], size[2],
            middle[0], 0.0 - (double)all.high[1] * (double)unit[1] / 1e6, middle[2]);
}

static void write_model(const drawing_kit *d, const char *connector, const tn_part_connector_record *joined)
{
    static const char *const facing[TN_AXIS_COUNT] = {
        [TN_AXIS_UP] = "down",    [TN_AXIS_DOWN] = "up",    [TN_AXIS_LEFT] = "right",
        [TN_AXIS_RIGHT] = "left", [TN_AXIS_FRONT] = "back", [TN_AXIS_BACK] = "front"};
    const int32_t *from = d->model.parts[d->first].frame.at;
    fputs("\nmodel drawn {\n", d->out);
    write_space(d);
    fprintf(d->out, "  start %s %s at ", connector, facing[joined->axis]);
    write_vector(
        d, (int32_t[3]){from[0] + (int32_t)joined->x, from[1] + (int32_t)joined->y, from[2] + (int32_t)joined->z});
    fputs(" by drawn;\n}\n", d->out);
}

static void write_kit(const drawing_kit *d, const char *use)
{
    const tn_module *m = d->module;
    const tn_part_connector_record *joined = &m->PART_CONNECTOR_records[d->kinds[d->first]->connector_first];
    const char *connector = tn_text(m, m->CONNECTOR_TYPE_records[m->CONNECTOR_TYPE_records[joined->type].joins].name);
    fputs("# A model that was drawn. Where `stop` is a rule, as in `with wall`, that rule goes on at the part's open "
          "connectors.\n",
          d->out);
    fprintf(d->out, "use \"%s\";\n\n", use);
    write_rule(d, connector);
    write_model(d, connector, joined);
}

/* ---- what it places */

/* Are these the parts, the first of the alternative before the others? */
static bool are_placed(const drawing_kit *d, const tn_placed_model *placed)
{
    bool same = placed->count == d->model.count;
    for (size_t i = 0; i < placed->count && same; i++) {
        size_t from = i == 0 ? d->first : i <= d->first ? i - 1 : i;
        const tn_placed_part *one = &placed->parts[i], *other = &d->model.parts[from];
        same = memcmp(one->frame.at, other->frame.at, sizeof one->frame.at) == 0 &&
               one->frame.heading == other->frame.heading && one->frame.colour == other->frame.colour &&
               strcmp(one->name, other->name) == 0;
    }
    return same;
}

static tn_status check_text(const drawing_kit *d, const char *text, const char *path, const tn_text_opener *opener)
{
    const tn_place_options options = {.threads = 1};
    tn_placed_model placed = {0};
    tn_place_rules rules;
    tn_opened opened;
    tn_status status = opener ? opener->open(opener->context, path, text, strlen(text), NULL, &opened)
                              : tn_open_bytes(path, (const uint8_t *)text, strlen(text), false, &opened);
    if (status == TN_OK) {
        status = tn_place_rules_of_model(opened.module, 0, &rules, d->error);
        if (status == TN_OK)
            status = tn_place_model(&opened, &rules, &options, &placed);
        tn_place_rules_clear(&rules);
    }
    bool same = status == TN_OK && are_placed(d, &placed);
    if (!same && status != TN_MEMORY)
        status = tn_fail(d->error, TN_INVALID, E_DRAWN, "the kit does not place the model again: %.300s",
                         status == TN_OK ? "parts stand elsewhere" : tn_first_error(&opened));
    tn_placed_model_clear(&placed);
    tn_close(&opened);
    return status == TN_MEMORY ? tn_fail_memory(d->error) : status;
}

static tn_status make_text(drawing_kit *d, const char *use, char **text)
{
    size_t size;
    d->out = open_memstream(text, &size);
    if (!d->out)
        return tn_fail_memory(d->error);
    write_kit(d, use);
    bool failed = ferror(d->out);
    return fclose(d->out) == 0 && !failed ? TN_OK : tn_fail_memory(d->error);
}

tn_status tn_drawn_kit(const tn_module *module, const tn_placed_model *model, const char *use, const char *path,
                       const tn_text_opener *opener, char **text, tn_drawn_changes *changes, tn_error *error)
{
    drawing_kit d = {.module = module, .changes = changes, .error = error};
    *changes = (tn_drawn_changes){0};
    *text = NULL;
    tn_status status = take_parts(&d, model);
    if (status == TN_OK)
        status = check_overlaps(&d);
    if (status == TN_OK)
        status = choose_first(&d);
    if (status == TN_OK)
        status = make_text(&d, use, text);
    if (status == TN_OK)
        status = check_text(&d, *text, path, opener);
    tn_placed_model_clear(&d.model);
    free(d.kinds);
    return status;
}

/* ---- reading */

/* context: where the path of the text is. */
static tn_status find_beside(void *context, const char *name, uint8_t **bytes, size_t *size, tn_error *error)
{
    const char *const *text = context;
    char *path = tn_path_beside(*text, name, "");
    if (!path)
        return tn_fail_memory(error);
    tn_status status = tn_path_exists(path) ? tn_file_read(path, TN_DRAWN_BYTES, bytes, size, error) : TN_OK;
    free(path);
    return status;
}

/* Parts that the kit has are called as there. The file's parts of one kind share the text of their name. */
static void name_parts(const tn_module *module, tn_placed_model *model)
{
    const char *before = NULL, *called = NULL;
    for (size_t i = 0; i < model->count; i++) {
        const char *name = model->parts[i].name;
        if (name != before) {
            const tn_kit_part_record *kind = tn_kit_part_meant(module, name);
            called = kind ? tn_text(module, kind->name) : name;
        }
        before = name;
        model->parts[i].name = called;
    }
}

tn_status tn_drawn_read_text(const char *text, size_t size, const char *name, const char *beside,
                             const tn_module *module, tn_ldraw *ldraw, tn_error *error)
{
    const tn_ldraw_files files = {find_beside, &beside};
    double unit[3];
    tn_place_unit(module, unit);
    tn_status status = tn_ldraw_read(text, size, unit, tn_place_turns(module), beside ? &files : NULL, ldraw, error);
    if (status == TN_INVALID) {
        tn_error found = *error;
        tn_fail(error, status, E_LDRAW_LINE, "%.200s, %s", name, found.message);
        tn_error_help(error, "a part is written `1 COLOUR X Y Z A B C D E F G H I NAME.dat`");
    }
    if (status == TN_OK)
        name_parts(module, &ldraw->model);
    if (status == TN_OK && ldraw->model.count == 0 && ldraw->tilted + ldraw->beside == 0) {
        tn_fail(error, TN_INVALID, E_PLACE_NOTHING, "%.200s has no parts", name);
        tn_error_help(error, "a model is an LDraw file, .ldr or .mpd");
        return TN_INVALID;
    }
    return status;
}

tn_status tn_drawn_read(const char *path, const tn_module *module, tn_ldraw *ldraw, tn_error *error)
{
    uint8_t *bytes;
    size_t size;
    *ldraw = (tn_ldraw){0};
    tn_status status = tn_file_read(path, TN_DRAWN_BYTES, &bytes, &size, error);
    if (status != TN_OK)
        return status;
    status = tn_drawn_read_text((const char *)bytes, size, path, path, module, ldraw, error);
    free(bytes);
    return status;
}
