/* What a part of a kit is: boxes of cells, and connectors at corners of cells. */
#include <string.h>
#include <strings.h>

#include "compiler/common/number_ranges.h"
#include "compiler/kit/kit.h"

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
        tn_kit_add_slope(kit, part, node, &box);
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
        tn_kit_read_part(kit, part->node, &from);
    for (const tn_kit_node *node = part->node->inner.first; node; node = node->next) {
        boxes += node->kind == TN_KIT_FILL;
        slopes += node->kind == TN_KIT_FILL && node->name.text;
    }
    part->boxes = TN_NEW_ARRAY(kit->arena, tn_kit_box, boxes + slopes * TN_KIT_SLOPE_STEPS_MAX + 1);
    part->slopes = TN_NEW_ARRAY(kit->arena, tn_kit_slope, slopes + 1);
    part->joints = TN_NEW_ARRAY(kit->arena, tn_kit_joint, most_joints(kit, part) + 4 * from.stud_count + 2);
    if (part->boxes && part->joints && part->slopes && part->node->other.text &&
        kit->diagnostics->error_count == errors)
        tn_kit_take_part_file(kit, part, &from, boxes == 0);
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
