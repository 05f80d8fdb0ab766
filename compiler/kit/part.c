/* What a part of a kit is: boxes of cells, some with a corner cut off, and connectors at corners of cells; as the kit
 * says, or a file of an LDraw library. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "compiler/common/compilation.h"
#include "compiler/common/diagnostic.h"
#include "compiler/kit/kit.h"

/* ==== boxes of parts of which a corner is cut off: the cells that are left, in steps */

/* Makes the box shorter by so many cells on the side where the axis points. */
static void shorten(tn_kit_box *box, tn_axis axis, int32_t by)
{
    int k = tn_axis_coordinate(axis);
    if (tn_axis_falls(axis))
        box->low[k] += by;
    else
        box->high[k] -= by;
}

static int32_t length_along(const tn_kit_box *box, tn_axis axis)
{
    int k = tn_axis_coordinate(axis);
    return box->high[k] - box->low[k];
}

/* How many cells are lost of the row at a distance from the face across `row`: those of which half or more is beyond
 * the cut, which goes from corner to corner. */
static int32_t lost(int64_t along, int64_t rows, int64_t row)
{
    int64_t count = (2 * rows - 2 * row - 1) * along; /* how far the cut is, in half cells, times the rows */
    return (int32_t)((count + rows) / (2 * rows));
}

/* The cells of a slope as boxes, row by row along the shorter side that is cut; equal rows are one box. */
static void add_steps(tn_kit_part *part, const tn_kit_box *whole, tn_axis row_axis, tn_axis lost_axis)
{
    int32_t rows = length_along(whole, row_axis), along = length_along(whole, lost_axis), before = -1;
    for (int32_t row = rows - 1; row >= 0; row--) {
        int32_t gone = lost(along, rows, row);
        if (gone == before) {
            shorten(&part->boxes[part->box_count - 1], row_axis, -1);
            continue;
        }
        if (gone == along)
            return;
        tn_kit_box *box = &part->boxes[part->box_count++];
        *box = *whole;
        shorten(box, row_axis, row);
        shorten(box, tn_axis_opposite(row_axis), rows - 1 - row);
        shorten(box, lost_axis, gone);
        before = gone;
    }
}

static bool check(tn_kit *kit, const tn_kit_node *node, const tn_kit_slope *slope, int32_t rows, int32_t along)
{
    tn_diagnostic *d;
    if (tn_axis_coordinate(slope->sides[0]) == tn_axis_coordinate(slope->sides[1])) {
        d = tn_report(kit->diagnostics, E_KIT_SLOPE, node->other.span, "`%s` and `%s` have no corner between them",
                      node->name.text, node->other.text);
        tn_help(kit->diagnostics, d, "a slope lies between sides that meet: `slope up front`");
        return false;
    }
    if (rows > TN_KIT_SLOPE_STEPS_MAX) {
        d = tn_report(kit->diagnostics, E_KIT_SLOPE, node->span,
                      "this slope has %d steps of cells, and %d are the most", rows, TN_KIT_SLOPE_STEPS_MAX);
        tn_help(kit->diagnostics, d, "use a kit with larger cells, or a smaller slope");
        return false;
    }
    if (along == 1 && rows == 1) {
        d = tn_report(kit->diagnostics, E_KIT_SLOPE, node->span, "this slope fills no cell");
        tn_help(kit->diagnostics, d, "of a single cell only half is left: use a kit with smaller cells, or `fill`");
        return false;
    }
    return true;
}

static bool is_slope(tn_kit *kit, const tn_kit_text *word)
{
    if (strcasecmp(word->text, "slope") == 0)
        return true;
    tn_diagnostic *d =
        tn_report(kit->diagnostics, E_KIT_SLOPE, word->span, "`%.100s` is nothing that a part has", word->text);
    tn_help(kit->diagnostics, d, "boxes are `fill 20 x 24 x 20;` and slopes `slope up front 20 x 24 x 20;`");
    return false;
}

/* Adds what is left of a box of which its `fill` cuts a corner off, and the slope; or says why not (E1343). */
static void kit_add_slope(tn_kit *kit, tn_kit_part *part, const tn_kit_node *node, const tn_kit_box *whole)
{
    if (!is_slope(kit, &node->doc))
        return;
    tn_kit_slope slope = {.whole = *whole, .first = part->box_count};
    bool right = tn_kit_axis(kit, &node->name, &slope.sides[0]) && tn_kit_axis(kit, &node->other, &slope.sides[1]);
    if (!right)
        return;
    int32_t sizes[2] = {length_along(whole, slope.sides[0]), length_along(whole, slope.sides[1])};
    int rows = sizes[0] < sizes[1] ? 0 : 1;
    if (!check(kit, node, &slope, sizes[rows], sizes[!rows]))
        return;
    add_steps(part, whole, slope.sides[rows], slope.sides[!rows]);
    slope.count = part->box_count - slope.first;
    part->slopes[part->slope_count++] = slope;
}

/* ==== parts from the files of an LDraw library: their studs and tubes become connectors of the kit, and their box its
 * cells. A file is looked for beside the kit, and then in the library */

/* Where sub-files are looked for. */
typedef struct shelves {
    const tn_kit *kit;
    const tn_kit_node *node;
} shelves;

static const double near_cell = 0.1, half_stud = 10;

/* In the folder of the file that the kit names, and in the library. */
static tn_status read_file(void *context, const char *name, uint8_t **bytes, size_t *size, tn_error *error)
{
    const shelves *s = context;
    const tn_attachments *files = s->kit->attachments;
    const char *own = s->node->other.text, *slash = strrchr(own, '/');
    const char *user = s->kit->diagnostics->sources->files[s->node->span.file].path;
    char *path;
    tn_error missing;
    if (!files->bytes)
        return tn_fail(error, TN_INVALID, TN_CODE_NONE, "no files can be read here");
    if (asprintf(&path, "%.*s%s", slash ? (int)(slash + 1 - own) : 0, own, name) < 0)
        return tn_fail_memory(error);
    const tn_request request = {path, "", user};
    tn_status status = files->bytes(files->context, &request, bytes, size, &missing);
    free(path);
    if (status == TN_IO && missing.code == E_CANNOT_READ)
        return files->bytes(files->context, &(tn_request){name, TN_LDRAW_LIBRARY, user}, bytes, size, error);
    if (status != TN_OK)
        *error = missing;
    return status;
}

static void failed(tn_kit *kit, const tn_kit_node *node, tn_status status, const tn_error *error)
{
    if (status == TN_MEMORY) {
        kit->out_of_memory = true;
        return;
    }
    kit->damaged = true; /* what it joins nobody knows */
    tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_FILE, node->other.span, "`%.100s` cannot be a part: %.300s",
                                 node->other.text, error->message);
    tn_help(kit->diagnostics, d, "%s",
            error->help[0] ? error->help
                           : "name a part file of an LDraw library, or tell the part by `fill` and its connectors");
}

/* Parts of an LDraw library: reads the file that a part names, and takes its studs, tubes and, where
 * `body`, its size. */
static void kit_read_part(tn_kit *kit, const tn_kit_node *node, tn_part_file *file)
{
    static const char *const words[] = {"from", "ldraw"};
    const tn_kit_node *word = node->outer.first;
    const char *slash = strrchr(node->other.text, '/');
    tn_error error = {0};
    for (int i = 0; word && i < 2; i++, word = word->next) {
        if (strcasecmp(word->name.text, words[i]) == 0)
            continue;
        tn_diagnostic *d =
            tn_report(kit->diagnostics, E_KIT_FILE, word->span, "`%.100s` is not expected here", word->name.text);
        tn_help(kit->diagnostics, d, "a part is from an LDraw library: `part 3001 from ldraw \"3001.dat\";`");
        return;
    }
    const tn_part_library library = {read_file, &(shelves){kit, node}};
    tn_status status = tn_part_file_read(&library, slash ? slash + 1 : node->other.text, file, &error);
    if (status == TN_OK && !(file->low[0] <= file->high[0]))
        status = tn_fail(&error, TN_INVALID, TN_CODE_NONE, "nothing is drawn in it");
    if (status != TN_OK)
        failed(kit, node, status, &error);
}

/* ---- what the file has, in cells */

static bool to_cell(const tn_kit *kit, double at, int axis, int32_t *cell)
{
    double value = at / ((double)kit->unit[axis] / 1e6), whole = floor(value + 0.5);
    if (!(fabs(value - whole) <= near_cell) || fabs(whole) > TN_PLACE_SIZE_MAX)
        return false;
    *cell = (int32_t)whole;
    return true;
}

static void take_body(tn_kit *kit, tn_kit_part *part, const tn_part_file *file)
{
    static const char *const axes[] = {"x", "y", "z"};
    tn_kit_box *box = &part->boxes[0];
    for (int k = 0; k < 3; k++) {
        if (to_cell(kit, file->low[k], k, &box->low[k]) && to_cell(kit, file->high[k], k, &box->high[k]) &&
            box->low[k] < box->high[k])
            continue;
        tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_FILE, part->node->other.span,
                                     "`%.100s` goes from %.6g to %.6g LDU along %s, which are no whole cells",
                                     part->node->other.text, file->low[k], file->high[k], axes[k]);
        tn_note(kit->diagnostics, d, &kit->unit_node->span, "the cells are told here");
        tn_help(kit->diagnostics, d, "say which room it takes: `part 3001 from ldraw \"3001.dat\" { fill ...; }`");
        return;
    }
    part->box_count = 1;
}

static tn_kit_type *type_named(tn_kit *kit, const tn_kit_part *part, const char *name)
{
    tn_kit_type *type = tn_names_get(&kit->types, name);
    if (type)
        return type;
    tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_FILE, part->node->other.span,
                                 "`%.100s` has a %s, and the kit has no such connector", part->node->other.text, name);
    tn_help(kit->diagnostics, d,
            "tell it: `connector stud joins tube turns 4;` and `connector tube joins stud turns 4;`");
    return NULL;
}

/* A connector at a place; each once. False if it was complained of. */
static bool add_joint_of_file(tn_kit *kit, tn_kit_part *part, const char *name, tn_axis axis, const double at[3])
{
    tn_kit_joint joint = {.type = type_named(kit, part, name), .axis = axis};
    if (!joint.type)
        return false;
    for (int k = 0; k < 3; k++) {
        if (to_cell(kit, at[k], k, &joint.at[k]))
            continue;
        tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_FILE, part->node->other.span,
                                     "`%.100s` has a %s at (%.6g, %.6g, %.6g), which is no corner of cells",
                                     part->node->other.text, name, at[0], 0 - at[1], at[2]);
        tn_note(kit->diagnostics, d, &kit->unit_node->span, "the cells are told here");
        tn_help(kit->diagnostics, d, "use a kit with smaller cells, or tell the part by `fill` and its connectors");
        return false;
    }
    for (uint32_t i = 0; i < part->joint_count; i++)
        if (part->joints[i].type == joint.type && part->joints[i].axis == axis &&
            memcmp(part->joints[i].at, joint.at, sizeof joint.at) == 0)
            return true;
    part->joints[part->joint_count++] = joint;
    return true;
}

/* Is a stud about this place, seen along an axis, all within the part? */
static bool has_room(const tn_part_file *file, const double at[3], int along)
{
    for (int k = 0; k < 3; k++)
        if (k != along &&
            (at[k] - half_stud < file->low[k] - near_cell || at[k] + half_stud > file->high[k] + near_cell))
            return false;
    return true;
}

/* A tube is round four studs; a pin is between two, along the longer side. */
static bool take_tube(tn_kit *kit, tn_kit_part *part, const tn_part_file *file, const tn_part_stud *stud)
{
    static const int8_t around[4][2] = {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
    static const int8_t beside[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    const int8_t(*steps)[2] = stud->kind == TN_PART_TUBE ? around : beside;
    int along = stud->axis <= TN_AXIS_DOWN ? 1 : stud->axis <= TN_AXIS_RIGHT ? 0 : 2;
    int across[2] = {along == 0 ? 1 : 0, along == 2 ? 1 : 2};
    for (int i = 0; i < 4; i++) {
        double at[3] = {stud->at[0], stud->at[1], stud->at[2]};
        at[across[0]] += steps[i][0] * half_stud;
        at[across[1]] += steps[i][1] * half_stud;
        if (has_room(file, at, along) && !add_joint_of_file(kit, part, "tube", stud->axis, at))
            return false;
    }
    return true;
}

static void kit_take_part_file(tn_kit *kit, tn_kit_part *part, const tn_part_file *file, bool body)
{
    bool right = true, tubes = false;
    if (body)
        take_body(kit, part, file);
    for (size_t i = 0; i < file->stud_count && right; i++) {
        const tn_part_stud *stud = &file->studs[i];
        tubes |= stud->kind != TN_PART_STUD;
        right = stud->kind == TN_PART_STUD ? add_joint_of_file(kit, part, "stud", stud->axis, stud->at)
                                           : take_tube(kit, part, file, stud);
    }
    const double under[3] = {(file->low[0] + file->high[0]) / 2, file->high[1], (file->low[2] + file->high[2]) / 2};
    bool small = file->high[0] - file->low[0] < 3 * half_stud && file->high[2] - file->low[2] < 3 * half_stud;
    if (right && !tubes && small && has_room(file, under, 1))
        add_joint_of_file(kit, part, "tube", TN_AXIS_DOWN, under);
}

/* ==== what a part of a kit is: boxes of cells, and connectors at corners of cells */

static const char *const axes[TN_AXIS_COUNT] = {"up", "down", "left", "right", "front", "back"};

bool tn_kit_axis(tn_kit *kit, const tn_kit_text *word, tn_axis *axis)
{
    for (size_t i = 0; i < TN_AXIS_COUNT; i++) {
        if (strcasecmp(axes[i], word->text) == 0) {
            *axis = (tn_axis)i;
            return true;
        }
    }
    char list[80];
    tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_UNKNOWN, word->span, "`%.100s` is no direction", word->text);
    const char *near = tn_nearest(word->text, axes, TN_AXIS_COUNT);
    tn_word_list(axes, TN_AXIS_COUNT, list, sizeof list);
    if (near)
        tn_suggest(kit->diagnostics, d, "%s", near);
    else
        tn_help(kit->diagnostics, d, "directions are %s", list);
    return false;
}

/* Cell coordinates have their y downwards. */
static bool place_of(tn_kit *kit, const tn_kit_vector *at, int64_t place[3])
{
    bool right = true;
    for (int k = 0; k < 3; k++) {
        place[k] = 0;
        if (at->given)
            right &= tn_kit_measure(kit, &at->at[k], &place[k]);
    }
    place[1] = -place[1];
    return right;
}

/* A box is centred across, and hangs down from its place. */
static bool read_box(tn_kit *kit, const tn_kit_node *node, tn_kit_box *box)
{
    int64_t at[3], size[3];
    bool right = place_of(kit, &node->at, at);
    for (int k = 0; k < 3; k++)
        right &= tn_kit_measure(kit, &node->size[k], &size[k]);
    for (int k = 0; k < 3 && right; k++) {
        tn_span span = node->size[k].span;
        int64_t low = k == 1 ? 2 * at[k] : 2 * at[k] - size[k];
        if (size[k] <= 0) {
            tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_LENGTH, span, "a box without extent fills nothing");
            tn_help(kit->diagnostics, d, "sizes are above 0: `fill 4 studs x 1 brick x 2 studs;`");
            right = false;
        } else {
            right = tn_kit_cells(kit, span, low, k, 2, "a face of the box lies at", &box->low[k]) &&
                    tn_kit_cells(kit, span, low + 2 * size[k], k, 2, "a face of the box lies at", &box->high[k]);
        }
    }
    return right;
}

static void add_box(tn_kit *kit, tn_kit_part *part, const tn_kit_node *node, uint32_t fill)
{
    tn_kit_box box = {.fill = fill};
    if (!read_box(kit, node, &box))
        return;
    if (node->name.text)
        kit_add_slope(kit, part, node, &box);
    else
        part->boxes[part->box_count++] = box;
}

/* Which way along x and z the rows of a grid go: across the connector's axis. */
static void grid_axes(tn_axis axis, int across[2])
{
    bool aside = axis > TN_AXIS_DOWN, along_x = axis == TN_AXIS_LEFT || axis == TN_AXIS_RIGHT;
    across[0] = along_x ? 2 : 0;
    across[1] = aside ? 1 : 2;
}

static void add_joint(tn_kit *kit, tn_kit_part *part, const tn_kit_node *node, tn_kit_type *type, tn_axis axis,
                      const int64_t doubled[3])
{
    tn_kit_joint *joint = &part->joints[part->joint_count];
    joint->type = type;
    joint->axis = axis;
    for (int k = 0; k < 3; k++)
        if (!tn_kit_cells(kit, node->span, doubled[k], k, 2, "a connector lies at", &joint->at[k]))
            return;
    part->joint_count++;
}

static bool read_grid(tn_kit *kit, const tn_kit_node *node, const tn_kit_type *type, int64_t count[2])
{
    count[0] = count[1] = 1;
    for (int i = 0; i < 2 && tn_kit_given(&node->count[i]); i++)
        if (!tn_kit_whole(kit, &node->count[i], 1, TN_KIT_GRID_MAX, "a side of a grid", &count[i]))
            return false;
    if (count[0] * count[1] == 1 || type->every > 0)
        return true;
    tn_diagnostic *d =
        tn_report(kit->diagnostics, E_KIT_PART, node->span, "it is not said how far apart these connectors are");
    tn_note(kit->diagnostics, d, &type->node->span, "the connector is declared here");
    tn_help(kit->diagnostics, d, "add `every` to the connector: `connector %s joins %s every 20;`",
            type->node->name.text, type->node->other.text);
    return false;
}

static tn_kit_type *type_of(tn_kit *kit, const tn_kit_text *name)
{
    tn_kit_type *type = tn_names_get(&kit->types, name->text);
    size_t size = strlen(name->text);
    if (!type && size > 1 && name->text[size - 1] == 's') {
        const char *singular = tn_arena_copy(kit->arena, name->text, size - 1);
        type = singular ? tn_names_get(&kit->types, singular) : NULL;
    }
    if (type)
        return type;
    tn_kit_unknown(kit, &kit->types, "connector", name->span, name->text,
                   "a connector is told before parts have it: `connector stud joins tube;`");
    return NULL;
}

static void add_joints(tn_kit *kit, tn_kit_part *part, const tn_kit_node *node)
{
    int64_t at[3], count[2];
    int across[2];
    tn_axis axis;
    tn_kit_type *type = type_of(kit, &node->name);
    bool right = tn_kit_axis(kit, &node->other, &axis);
    if (!type || !right || !read_grid(kit, node, type, count) || !place_of(kit, &node->at, at))
        return;
    grid_axes(axis, across);
    /* Where the first of those above joins the first of those below, parts lie half over one another. */
    int64_t way = axis == TN_AXIS_DOWN || axis == TN_AXIS_LEFT || axis == TN_AXIS_FRONT ? -1 : 1;
    for (int64_t j = 0; j < count[1]; j++) {
        for (int64_t i = 0; i < count[0]; i++) {
            size_t errors = kit->diagnostics->error_count;
            int64_t doubled[3] = {2 * at[0], 2 * at[1], 2 * at[2]};
            doubled[across[0]] += way * (2 * i - count[0] + 1) * type->every;
            doubled[across[1]] += way * (2 * j - count[1] + 1) * type->every;
            add_joint(kit, part, node, type, axis, doubled);
            if (kit->diagnostics->error_count > errors)
                return;
        }
    }
}

/* How many connectors a part has at most. */
static size_t most_joints(const tn_kit *kit, const tn_kit_part *part)
{
    size_t count = 0;
    for (const tn_kit_node *node = part->node->inner.first; node; node = node->next) {
        double rows = node->kind == TN_KIT_HAS, columns = 1;
        if (rows > 0 && tn_kit_given(&node->count[0])) {
            rows = tn_kit_number(kit, &node->count[0]);
            columns = tn_kit_number(kit, &node->count[1]);
        }
        count += rows <= TN_KIT_GRID_MAX && columns <= TN_KIT_GRID_MAX ? (size_t)(rows * columns) : 0;
    }
    return count;
}

static bool overlap(const tn_kit_box *a, const tn_kit_box *b)
{
    bool over = true;
    for (int k = 0; k < 3; k++)
        over &= a->low[k] < b->high[k] && b->low[k] < a->high[k];
    return over;
}

static void check_boxes(tn_kit *kit, const tn_kit_part *part)
{
    const char *name = part->node->name.text;
    if (part->box_count == 0) {
        tn_diagnostic *d =
            tn_report(kit->diagnostics, E_KIT_PART, part->node->name.span, "part %.100s fills nothing", name);
        tn_help(kit->diagnostics, d, "say what room it takes: `fill 4 studs x 1 brick x 2 studs;`");
    }
    for (uint32_t i = 0; i < part->box_count; i++) {
        for (uint32_t j = 0; j < i; j++) {
            if (!overlap(&part->boxes[i], &part->boxes[j]))
                continue;
            tn_diagnostic *d =
                tn_report(kit->diagnostics, E_KIT_PART, part->node->name.span, "boxes %u and %u of part %.100s overlap",
                          part->boxes[j].fill, part->boxes[i].fill, name);
            tn_help(kit->diagnostics, d, "boxes of a part lie side by side");
            return;
        }
    }
}

/* A mass or a price, as large as a module holds. */
static double read_amount(tn_kit *kit, const tn_kit_node *node)
{
    double amount = tn_kit_number(kit, &node->count[0]);
    tn_range_note(kit->diagnostics, node->count[0].span, 0, TN_COORDINATE_MAX);
    if (amount <= TN_COORDINATE_MAX)
        return amount;
    tn_diagnostic *d = tn_report(kit->diagnostics, E_KIT_NUMBER, node->count[0].span, "this %s is too large",
                                 node->kind == TN_KIT_MASS ? "mass" : "price");
    tn_help(kit->diagnostics, d, "write a number up to %.0f", TN_COORDINATE_MAX);
    return 0;
}

void tn_kit_check_part(tn_kit *kit, tn_kit_part *part)
{
    tn_part_file from = {.stud_count = 0};
    size_t boxes = 0, slopes = 0, errors = kit->diagnostics->error_count;
    uint32_t fill = 0;
    if (part->node->other.text)
        kit_read_part(kit, part->node, &from);
    for (const tn_kit_node *node = part->node->inner.first; node; node = node->next) {
        boxes += node->kind == TN_KIT_FILL;
        slopes += node->kind == TN_KIT_FILL && node->name.text;
    }
    part->boxes = TN_NEW_ARRAY(kit->arena, tn_kit_box, boxes + slopes * TN_KIT_SLOPE_STEPS_MAX + 1);
    part->slopes = TN_NEW_ARRAY(kit->arena, tn_kit_slope, slopes + 1);
    part->joints = TN_NEW_ARRAY(kit->arena, tn_kit_joint, most_joints(kit, part) + 4 * from.stud_count + 2);
    if (part->boxes && part->joints && part->slopes && part->node->other.text &&
        kit->diagnostics->error_count == errors)
        kit_take_part_file(kit, part, &from, boxes == 0);
    tn_part_file_clear(&from);
    if (!part->boxes || !part->joints || !part->slopes)
        return;
    for (const tn_kit_node *node = part->node->inner.first; node; node = node->next) {
        if (node->kind == TN_KIT_FILL)
            add_box(kit, part, node, ++fill);
        else if (node->kind == TN_KIT_HAS)
            add_joints(kit, part, node);
        else
            *(node->kind == TN_KIT_MASS ? &part->mass : &part->price) = read_amount(kit, node);
    }
    part->wrong = kit->diagnostics->error_count > errors;
    if (!part->wrong && !kit->damaged)
        check_boxes(kit, part);
}
