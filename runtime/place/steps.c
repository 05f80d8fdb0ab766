/* Finds the order of building: of the parts that join what stands, the lowest comes next. */
#include "runtime/place/steps.h"

#include <stdlib.h>
#include <string.h>

typedef struct building {
    const tn_module *module;
    const tn_placed_model *model;
    const tn_placed_joints *joints;
    int32_t *bottom;                    /* [part]: of its lowest cell, downwards */
    uint32_t *first_neighbour, *others; /* what part p joins: others[first_neighbour[p]] to first_neighbour[p + 1] */
    uint32_t *heap, *order, *by_height;
    size_t heap_count, order_count;
    bool *known; /* [part]: it is in the heap, or stands */
    tn_cells *cells;
    int32_t top; /* of all cells */
} building;

/* Lower parts are built first; of equals the one that was placed first. */
static bool comes_first(const building *b, uint32_t one, uint32_t other)
{
    return b->bottom[one] != b->bottom[other] ? b->bottom[one] > b->bottom[other] : one < other;
}

/* ---- what comes next: a heap */

static void push(building *b, uint32_t part)
{
    size_t at = b->heap_count++;
    b->known[part] = true;
    for (; at > 0 && comes_first(b, part, b->heap[(at - 1) / 2]); at = (at - 1) / 2)
        b->heap[at] = b->heap[(at - 1) / 2];
    b->heap[at] = part;
}

static uint32_t pop(building *b)
{
    uint32_t best = b->heap[0], last = b->heap[--b->heap_count];
    size_t at = 0;
    for (size_t next = 1; next < b->heap_count; next = 2 * at + 1) {
        if (next + 1 < b->heap_count && comes_first(b, b->heap[next + 1], b->heap[next]))
            next++;
        if (comes_first(b, last, b->heap[next]))
            break;
        b->heap[at] = b->heap[next];
        at = next;
    }
    if (b->heap_count > 0)
        b->heap[at] = last;
    return best;
}

/* ---- making ready */

static void find_bottoms(building *b)
{
    b->top = INT32_MAX;
    for (size_t i = 0; i < b->model->count; i++) {
        const tn_kit_part_record *kind = b->joints->kinds[i];
        b->bottom[i] = kind && kind->box_count ? INT32_MIN : b->model->parts[i].frame.at[1];
        for (uint32_t k = 0; kind && k < kind->box_count; k++) {
            tn_cell_box box =
                tn_part_box_at(&b->module->PART_BOX_records[kind->box_first + k], &b->model->parts[i].frame);
            b->bottom[i] = box.high[1] > b->bottom[i] ? box.high[1] : b->bottom[i];
            b->top = box.low[1] < b->top ? box.low[1] : b->top;
        }
    }
}

static void list_neighbours(building *b)
{
    size_t n = b->model->count;
    for (size_t i = 0; i < b->joints->link_count; i++) {
        b->first_neighbour[b->joints->links[i].a + 2]++;
        b->first_neighbour[b->joints->links[i].b + 2]++;
    }
    for (size_t i = 2; i <= n + 1; i++)
        b->first_neighbour[i] += b->first_neighbour[i - 1];
    for (size_t i = 0; i < b->joints->link_count; i++) { /* entry p + 1 moves on to where entry p + 2 began */
        b->others[b->first_neighbour[b->joints->links[i].a + 1]++] = b->joints->links[i].b;
        b->others[b->first_neighbour[b->joints->links[i].b + 1]++] = b->joints->links[i].a;
    }
}

typedef struct height {
    int32_t bottom;
    uint32_t part;
} height;

static int by_height(const void *a, const void *b)
{
    const height *one = a, *other = b;
    if (one->bottom != other->bottom)
        return one->bottom > other->bottom ? -1 : 1;
    return (one->part > other->part) - (one->part < other->part);
}

static bool sort_by_height(building *b)
{
    size_t n = b->model->count;
    height *heights = calloc(n + 1, sizeof *heights);
    if (!heights)
        return false;
    for (uint32_t i = 0; i < n; i++)
        heights[i] = (height){b->bottom[i], i};
    qsort(heights, n, sizeof *heights, by_height);
    for (size_t i = 0; i < n; i++)
        b->by_height[i] = heights[i].part;
    free(heights);
    return true;
}

/* ---- building */

/* Is something in the way that stands above a box of the part? */
static bool is_covered(building *b, uint32_t part)
{
    const tn_kit_part_record *kind = b->joints->kinds[part];
    for (uint32_t k = 0; kind && k < kind->box_count; k++) {
        tn_cell_box box =
            tn_part_box_at(&b->module->PART_BOX_records[kind->box_first + k], &b->model->parts[part].frame);
        box.high[1] = box.low[1];
        box.low[1] = b->top;
        if (tn_cells_any(b->cells, &box))
            return true;
    }
    return false;
}

static tn_status stand(building *b, uint32_t part, tn_error *error)
{
    const tn_kit_part_record *kind = b->joints->kinds[part];
    tn_status status = TN_OK;
    b->order[b->order_count++] = part;
    for (uint32_t k = 0; kind && k < kind->box_count && status == TN_OK; k++) {
        tn_cell_box box =
            tn_part_box_at(&b->module->PART_BOX_records[kind->box_first + k], &b->model->parts[part].frame);
        status = tn_cells_fill(b->cells, &box, error);
    }
    for (uint32_t i = b->first_neighbour[part]; i < b->first_neighbour[part + 1]; i++)
        if (!b->known[b->others[i]])
            push(b, b->others[i]);
    return status;
}

/* What stands on the ground begins; where nothing joins what stands any more, the lowest part of another piece. */
static tn_status find_order(building *b, tn_placed_steps *steps, tn_error *error)
{
    size_t n = b->model->count, next = 0;
    tn_status status = TN_OK;
    for (size_t i = 0; i < n && b->bottom[b->by_height[i]] == b->bottom[b->by_height[0]]; i++)
        push(b, b->by_height[i]);
    while (b->order_count < n && status == TN_OK) {
        if (b->heap_count == 0) {
            while (b->known[b->by_height[next]])
                next++;
            push(b, b->by_height[next]);
            steps->loose++;
        }
        uint32_t part = pop(b);
        steps->hanging += is_covered(b, part);
        status = stand(b, part, error);
    }
    return status;
}

static tn_status divide(const building *b, const tn_steps_wish *wish, tn_placed_steps *steps, tn_error *error)
{
    size_t begin = 0, n = b->order_count;
    steps->ends = calloc(n + 1, sizeof *steps->ends);
    if (!steps->ends)
        return tn_fail_memory(error);
    for (size_t i = 1; i <= n; i++) {
        bool ends =
            i == n || (wish->layers ? b->bottom[b->order[i]] != b->bottom[b->order[begin]] : i - begin == wish->parts);
        if (!ends)
            continue;
        steps->ends[steps->count++] = i;
        begin = i;
    }
    return TN_OK;
}

static tn_status put_in_order(const building *b, tn_placed_model *model, tn_error *error)
{
    tn_placed_part *parts = calloc(model->count + 1, sizeof *parts);
    if (!parts)
        return tn_fail_memory(error);
    for (size_t i = 0; i < model->count; i++)
        parts[i] = model->parts[b->order[i]];
    free(model->parts);
    model->parts = parts;
    model->capacity = model->count + 1;
    return TN_OK;
}

bool tn_kit_model_steps(const tn_kit_model_record *model, tn_steps_wish *wish)
{
    *wish = (tn_steps_wish){.layers = !model || model->steps != TN_STEPS_PARTS,
                            .parts = model && model->step_parts ? model->step_parts : 1};
    return model && model->steps != TN_STEPS_PLACED;
}

static tn_status make_steps(const tn_module *module, const tn_placed_joints *joints, const tn_steps_wish *wish,
                            tn_watch *watch, tn_placed_model *model, tn_placed_steps *steps, tn_error *error)
{
    size_t n = model->count, links = joints->link_count;
    uint32_t *memory = calloc(4 * n + 2 + 2 * links + 1, sizeof *memory);
    building b = {.module = module, .model = model, .joints = joints, .cells = tn_cells_new(watch)};
    b.bottom = calloc(n + 1, sizeof *b.bottom);
    b.known = calloc(n + 1, sizeof *b.known);
    tn_status status = memory && b.bottom && b.known && b.cells ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK) {
        b.heap = memory;
        b.order = memory + n;
        b.by_height = memory + 2 * n;
        b.first_neighbour = memory + 3 * n;
        b.others = memory + 4 * n + 2;
        find_bottoms(&b);
        list_neighbours(&b);
        status = sort_by_height(&b) ? find_order(&b, steps, error) : tn_fail_memory(error);
    }
    if (status == TN_OK)
        status = divide(&b, wish, steps, error);
    if (status == TN_OK)
        status = put_in_order(&b, model, error);
    tn_cells_free(b.cells);
    free(b.bottom);
    free(b.known);
    free(memory);
    return status;
}

tn_status tn_placed_steps_make(const tn_module *module, const tn_steps_wish *wish, tn_watch *watch,
                               tn_placed_model *model, tn_placed_steps *steps, tn_error *error)
{
    tn_placed_joints joints;
    *steps = (tn_placed_steps){0};
    tn_status status = tn_placed_joints_find(module, model, watch, &joints, error);
    if (status == TN_OK)
        status = make_steps(module, &joints, wish, watch, model, steps, error);
    tn_placed_joints_clear(&joints);
    return status;
}

void tn_placed_steps_clear(tn_placed_steps *steps)
{
    free(steps->ends);
    *steps = (tn_placed_steps){0};
}
