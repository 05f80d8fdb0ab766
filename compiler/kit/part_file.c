/* Parts from the files of an LDraw library: their studs and tubes become connectors of the kit, and their box its
 * cells.
 *
 * A file is looked for beside the kit, and then in the library. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "compiler/common/ldraw_library.h"
#include "compiler/kit/kit.h"

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

void tn_kit_read_part(tn_kit *kit, const tn_kit_node *node, tn_part_file *file)
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

/* A connector at a place; each once. False where it was complained of. */
static bool add_joint(tn_kit *kit, tn_kit_part *part, const char *name, tn_axis axis, const double at[3])
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
        if (has_room(file, at, along) && !add_joint(kit, part, "tube", stud->axis, at))
            return false;
    }
    return true;
}

void tn_kit_take_part_file(tn_kit *kit, tn_kit_part *part, const tn_part_file *file, bool body)
{
    bool right = true, tubes = false;
    if (body)
        take_body(kit, part, file);
    for (size_t i = 0; i < file->stud_count && right; i++) {
        const tn_part_stud *stud = &file->studs[i];
        tubes |= stud->kind != TN_PART_STUD;
        right = stud->kind == TN_PART_STUD ? add_joint(kit, part, "stud", stud->axis, stud->at)
                                           : take_tube(kit, part, file, stud);
    }
    const double under[3] = {(file->low[0] + file->high[0]) / 2, file->high[1], (file->low[2] + file->high[2]) / 2};
    bool small = file->high[0] - file->low[0] < 3 * half_stud && file->high[2] - file->low[2] < 3 * half_stud;
    if (right && !tubes && small && has_room(file, under, 1))
        add_joint(kit, part, "tube", TN_AXIS_DOWN, under);
}
