/* The layers of a walk. */
#include "runtime/automata/walk.h"

#include <string.h>

tn_status tn_walk_begin(tn_layers *walk, uint32_t last, bool kept, tn_error *error)
{
    *walk = (tn_layers){.last = last, .kept = kept};
    walk->layers = calloc(kept ? (size_t)last + 1 : 2, sizeof *walk->layers);
    walk->looked = walk->layers;
    return walk->layers ? TN_OK : tn_fail_memory(error);
}

static void clear_elements(char *elements, uint32_t count, size_t size, const tn_walk_algebra *algebra)
{
    for (uint32_t i = 0; elements && algebra && algebra->clear && i < count; i++)
        algebra->clear(elements + i * size);
    free(elements);
}

void tn_walk_clear(tn_layers *walk, const tn_walk_algebra *forward, const tn_walk_algebra *backward)
{
    size_t layers = walk->kept ? (size_t)walk->last + 1 : 2;
    for (size_t n = 0; walk->layers && n < layers; n++) {
        tn_walk_layer *layer = &walk->layers[n];
        clear_elements(layer->forward, layer->count, walk->forward_size, forward);
        clear_elements(layer->backward, layer->count, walk->backward_size, backward);
        free(layer->states);
    }
    free(walk->layers);
    free(walk->place);
    *walk = (tn_layers){0};
}

static bool reserve_place(tn_layers *walk, uint32_t state)
{
    size_t before = walk->place_room;
    if (state < before)
        return true;
    if (!tn_array_grow(&walk->place, &walk->place_room, TN_ARRAY_FIRST, state, 1, sizeof *walk->place))
        return false;
    memset(walk->place + before, 0xff, (walk->place_room - before) * sizeof *walk->place);
    return true;
}

bool tn_walk_reserve(tn_layers *walk, tn_walk_layer *layer, uint32_t state)
{
    if (!reserve_place(walk, state))
        return false;
    if (layer->count < layer->room)
        return true;
    size_t room = tn_array_larger(layer->room, 0, 16);
    if (!tn_array_resize(&layer->states, room, sizeof *layer->states) ||
        (walk->forward_size && !tn_array_resize(&layer->forward, room, walk->forward_size)))
        return false;
    layer->room = room;
    return true;
}

tn_status tn_walk_fill(tn_layers *walk, uint32_t number, uint32_t count, tn_error *error)
{
    tn_walk_layer *layer = tn_walk_at(walk, number);
    layer->start = count > 0 ? 0 : TN_NO_STATE;
    layer->states = tn_array_new((uint64_t)count + 1, sizeof *layer->states);
    if (!layer->states || (count > 0 && !reserve_place(walk, count - 1)))
        return tn_fail_memory(error);
    for (uint32_t s = 0; s < count; s++)
        layer->states[s] = s;
    layer->count = count;
    walk->looked = NULL;
    return TN_OK;
}

void tn_walk_look(tn_layers *walk, const tn_walk_layer *layer)
{
    if (layer == walk->looked)
        return;
    for (uint32_t i = 0; walk->looked && i < walk->looked->count; i++)
        walk->place[walk->looked->states[i]] = TN_NO_STATE;
    for (uint32_t i = 0; layer && i < layer->count; i++)
        walk->place[layer->states[i]] = i;
    walk->looked = layer;
}
