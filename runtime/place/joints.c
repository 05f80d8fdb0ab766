/* Finds joints by sorting all connectors by their place, then pieces by merging, and cuts by a walk in depth. */
#include "runtime/place/joints.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "runtime/base/array.h"

/* A connector of a placed part. */
typedef struct socket {
    int32_t at[3];
    uint32_t axis, beside, type, part; /* beside: where what is beside its axis points */
    size_t number;                     /* in the list of all: sorting is the same everywhere */
} socket;

/* ---- parts */

const tn_kit_part_record *tn_kit_part_named(const tn_module *module, const char *name)
{
    for (uint32_t i = 0; i < module->KIT_PART_count; i++)
        if (strcmp(tn_text(module, module->KIT_PART_records[i].name), name) == 0)
            return &module->KIT_PART_records[i];
    return NULL;
}

const tn_kit_part_record *tn_kit_part_meant(const tn_module *module, const char *name)
{
    const tn_kit_part_record *found = tn_kit_part_named(module, name);
    for (uint32_t i = 0; i < module->KIT_PART_count && !found; i++)
        if (strcasecmp(tn_text(module, module->KIT_PART_records[i].name), name) == 0)
            found = &module->KIT_PART_records[i];
    return found;
}

tn_cell_box tn_part_box_at(const tn_part_box_record *box, const tn_frame *frame)
{
    tn_step step = {.kind = TN_STEP_BLOCK,
                    .a = {(int32_t)box->low_x, (int32_t)box->low_y, (int32_t)box->low_z},
                    .b = {(int32_t)box->high_x, (int32_t)box->high_y, (int32_t)box->high_z}};
    return tn_frame_box(frame, &step);
}

static const char *name_of(const tn_module *module, const tn_kit_part_record *record)
{
    return tn_text(module, record->name);
}

/* A part of the kit by its name, as it is sorted: of equal names the first. */
typedef struct named_part {
    const char *name;
    const tn_kit_part_record *record;
} named_part;

static int by_name(const void *a, const void *b)
{
    const named_part *one = a, *other = b;
    int order = strcmp(one->name, other->name);
    return order != 0 ? order : (one->record > other->record) - (one->record < other->record);
}

static const tn_kit_part_record *find_name(const named_part *sorted, size_t count, const char *name)
{
    size_t low = 0, high = count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (strcmp(sorted[middle].name, name) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low < count && strcmp(sorted[low].name, name) == 0 ? sorted[low].record : NULL;
}

/* Parts of one kind mostly follow one another, and have one text for their name. */
static tn_status find_kinds(const tn_module *module, const tn_placed_model *model, tn_placed_joints *joints,
                            tn_error *error)
{
    size_t count = module->KIT_PART_count;
    named_part *sorted = malloc((count + 1) * sizeof *sorted);
    if (!sorted)
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++)
        sorted[i] = (named_part){name_of(module, &module->KIT_PART_records[i]), &module->KIT_PART_records[i]};
    qsort(sorted, count, sizeof *sorted, by_name);
    for (size_t i = 0; i < model->count; i++) {
        const char *name = model->parts[i].name;
        bool known = i > 0 && model->parts[i - 1].name == name;
        joints->kinds[i] = known ? joints->kinds[i - 1] : find_name(sorted, count, name);
        joints->unknown += !joints->kinds[i];
    }
    free(sorted);
    return TN_OK;
}

/* ---- connectors */

static void list_sockets(const tn_module *module, const tn_placed_model *model, const tn_placed_joints *joints,
                         socket *sockets)
{
    size_t number = 0;
    for (size_t i = 0; i < model->count; i++) {
        const tn_kit_part_record *kind = joints->kinds[i];
        const tn_frame *frame = &model->parts[i].frame;
        for (uint32_t c = 0; kind && c < kind->connector_count; c++) {
            const tn_part_connector_record *from = &module->PART_CONNECTOR_records[kind->connector_first + c];
            socket *to = sockets++;
            const int32_t at[3] = {(int32_t)from->x, (int32_t)from->y, (int32_t)from->z};
            *to = (socket){.axis = tn_axis_turn((tn_axis)from->axis, frame->heading),
                           .beside = tn_axis_turn(tn_axis_beside((tn_axis)from->axis), frame->heading),
                           .type = from->type,
                           .part = (uint32_t)i,
                           .number = number++};
            tn_turn_place(frame->heading, at, to->at);
            for (int k = 0; k < 3; k++)
                to->at[k] += frame->at[k];
        }
    }
}

static int by_place(const void *a, const void *b)
{
    const socket *one = a, *other = b;
    for (int k = 0; k < 3; k++)
        if (one->at[k] != other->at[k])
            return one->at[k] < other->at[k] ? -1 : 1;
    if (one->part != other->part)
        return one->part < other->part ? -1 : 1;
    return one->axis != other->axis ? (one->axis < other->axis ? -1 : 1)
                                    : (one->number > other->number) - (one->number < other->number);
}

bool tn_connectors_turn(const tn_module *module, uint32_t a, uint32_t b, tn_axis beside_a, tn_axis beside_b)
{
    const tn_connector_type_record *types = module->CONNECTOR_TYPE_records;
    return tn_turns_fit(beside_a, beside_b, types[a].turns < types[b].turns ? types[a].turns : types[b].turns);
}

uint32_t tn_connector_turns(const tn_module *module, uint32_t type)
{
    const tn_connector_type_record *types = module->CONNECTOR_TYPE_records;
    uint32_t turns = types[type].turns;
    for (uint32_t i = 0; i < module->CONNECTOR_TYPE_count; i++)
        if ((types[i].joins == type || types[type].joins == i) && types[i].turns < turns)
            turns = types[i].turns;
    return turns;
}

static bool joins(const tn_module *module, const socket *a, const socket *b)
{
    const tn_connector_type_record *types = module->CONNECTOR_TYPE_records;
    return a->part != b->part && a->axis == tn_axis_opposite((tn_axis)b->axis) &&
           (types[a->type].joins == b->type || types[b->type].joins == a->type) &&
           tn_connectors_turn(module, a->type, b->type, (tn_axis)a->beside, (tn_axis)b->beside);
}

static tn_status add_link(tn_placed_joints *joints, size_t *capacity, const socket *a, const socket *b, tn_error *error)
{
    if (!tn_array_reserve(&joints->links, capacity, joints->link_count, 1, sizeof *joints->links))
        return tn_fail_memory(error);
    tn_placed_joint link = {a->part, b->part};
    if (link.a > link.b)
        link = (tn_placed_joint){b->part, a->part};
    joints->links[joints->link_count++] = link;
    joints->joint_count++;
    return TN_OK;
}

/* Pairs of the connectors at one place: few, unless parts overlap. A connector joins one other at most. */
static tn_status join_group(const tn_module *module, tn_placed_joints *joints, size_t *capacity, socket *group,
                            size_t count, tn_error *error)
{
    for (size_t i = 0; i < count; i++) {
        size_t j = i + 1;
        while (j < count &&
               !(group[i].type != UINT32_MAX && group[j].type != UINT32_MAX && joins(module, &group[i], &group[j])))
            j++;
        if (j == count) {
            joints->open_count += group[i].type != UINT32_MAX;
            continue;
        }
        tn_status status = add_link(joints, capacity, &group[i], &group[j], error);
        if (status != TN_OK)
            return status;
        group[j].type = UINT32_MAX; /* taken */
    }
    return TN_OK;
}

static int by_parts(const void *a, const void *b)
{
    const tn_placed_joint *one = a, *other = b;
    return one->a != other->a ? (one->a < other->a ? -1 : 1) : (one->b > other->b) - (one->b < other->b);
}

static void merge_links(tn_placed_joints *joints)
{
    size_t kept = 0;
    if (joints->link_count == 0)
        return;
    qsort(joints->links, joints->link_count, sizeof *joints->links, by_parts);
    for (size_t i = 1; i < joints->link_count; i++)
        if (by_parts(&joints->links[kept], &joints->links[i]) != 0)
            joints->links[++kept] = joints->links[i];
    joints->link_count = kept + 1;
}

static tn_status find_links(const tn_module *module, const tn_placed_model *model, tn_placed_joints *joints,
                            tn_error *error)
{
    size_t count = 0, capacity = 0;
    for (size_t i = 0; i < model->count; i++)
        count += joints->kinds[i] ? joints->kinds[i]->connector_count : 0;
    socket *sockets = calloc(count + 1, sizeof *sockets);
    if (!sockets)
        return tn_fail_memory(error);
    list_sockets(module, model, joints, sockets);
    qsort(sockets, count, sizeof *sockets, by_place);
    tn_status status = TN_OK;
    for (size_t first = 0, last; first < count && status == TN_OK; first = last) {
        for (last = first + 1; last < count && memcmp(sockets[first].at, sockets[last].at, sizeof sockets->at) == 0;)
            last++;
        status = join_group(module, joints, &capacity, &sockets[first], last - first, error);
    }
    free(sockets);
    merge_links(joints);
    return status;
}

/* ---- pieces */

static uint32_t root_of(uint32_t *component, uint32_t part)
{
    while (component[part] != part)
        part = component[part] = component[component[part]];
    return part;
}

static void find_components(tn_placed_joints *joints)
{
    for (uint32_t i = 0; i < joints->count; i++)
        joints->component[i] = i;
    for (size_t i = 0; i < joints->link_count; i++) {
        uint32_t a = root_of(joints->component, joints->links[i].a), b = root_of(joints->component, joints->links[i].b);
        joints->component[a < b ? b : a] = a < b ? a : b;
    }
    for (uint32_t i = 0; i < joints->count; i++) {
        joints->component[i] = root_of(joints->component, i);
        joints->component_count += joints->component[i] == i;
    }
}

/* ---- cuts (articulation points; Hopcroft and Tarjan, Algorithm 447, 1973), without recursion */

typedef struct walk {
    uint32_t *first, *next_part; /* neighbours of part p: next_part[first[p]] to next_part[first[p + 1]] */
    uint32_t *order, *low, *parent, *at;
} walk;

static void list_neighbours(const tn_placed_joints *joints, walk *w)
{
    for (size_t i = 0; i < joints->link_count; i++) {
        w->first[joints->links[i].a + 1]++;
        w->first[joints->links[i].b + 1]++;
    }
    for (size_t i = 0; i < joints->count; i++) {
        w->first[i + 1] += w->first[i];
        w->at[i] = w->first[i];
    }
    for (size_t i = 0; i < joints->link_count; i++) {
        w->next_part[w->at[joints->links[i].a]++] = joints->links[i].b;
        w->next_part[w->at[joints->links[i].b]++] = joints->links[i].a;
    }
    memcpy(w->at, w->first, joints->count * sizeof *w->at);
}

/* Goes back from a part to the one that led to it. */
static void go_back(tn_placed_joints *joints, const walk *w, uint32_t part, uint32_t root, uint32_t *root_children)
{
    uint32_t before = w->parent[part];
    if (w->low[part] < w->low[before])
        w->low[before] = w->low[part];
    if (before == root)
        ++*root_children;
    else if (w->low[part] >= w->order[before])
        joints->cut[before] = true;
}

static void walk_from(tn_placed_joints *joints, const walk *w, uint32_t root, uint32_t *clock)
{
    uint32_t part = root, children = 0;
    w->order[root] = w->low[root] = ++*clock;
    w->parent[root] = root;
    for (;;) {
        if (w->at[part] == w->first[part + 1]) {
            if (part == root)
                break;
            go_back(joints, w, part, root, &children);
            part = w->parent[part];
            continue;
        }
        uint32_t next = w->next_part[w->at[part]++];
        if (!w->order[next]) {
            w->order[next] = w->low[next] = ++*clock;
            w->parent[next] = part;
            part = next;
        } else if (next != w->parent[part] && w->order[next] < w->low[part]) {
            w->low[part] = w->order[next];
        }
    }
    joints->cut[root] = children > 1;
}

static tn_status find_cuts(tn_placed_joints *joints, tn_error *error)
{
    size_t n = joints->count;
    uint32_t clock = 0;
    uint32_t *memory = calloc(5 * n + 2 + 2 * joints->link_count, sizeof *memory);
    if (!memory)
        return tn_fail_memory(error);
    walk w = {.first = memory,
              .order = memory + n + 1,
              .low = memory + 2 * n + 1,
              .parent = memory + 3 * n + 1,
              .at = memory + 4 * n + 1,
              .next_part = memory + 5 * n + 1};
    list_neighbours(joints, &w);
    for (uint32_t i = 0; i < n; i++)
        if (!w.order[i])
            walk_from(joints, &w, i, &clock);
    for (uint32_t i = 0; i < n; i++)
        joints->cut_count += joints->cut[i];
    free(memory);
    return TN_OK;
}

tn_status tn_placed_joints_find(const tn_module *module, const tn_placed_model *model, tn_watch *watch,
                                tn_placed_joints *joints, tn_error *error)
{
    *joints = (tn_placed_joints){.count = model->count};
    joints->kinds = calloc(model->count + 1, sizeof *joints->kinds);
    joints->component = calloc(model->count + 1, sizeof *joints->component);
    joints->cut = calloc(model->count + 1, sizeof *joints->cut);
    if (!joints->kinds || !joints->component || !joints->cut)
        return tn_fail_memory(error);
    tn_status status = find_kinds(module, model, joints, error);
    if (status == TN_OK)
        status = tn_watch_check(watch, error);
    if (status == TN_OK)
        status = find_links(module, model, joints, error);
    if (status != TN_OK)
        return status;
    find_components(joints);
    return find_cuts(joints, error);
}

void tn_placed_joints_clear(tn_placed_joints *joints)
{
    free(joints->kinds);
    free(joints->links);
    free(joints->component);
    free(joints->cut);
    *joints = (tn_placed_joints){0};
}
