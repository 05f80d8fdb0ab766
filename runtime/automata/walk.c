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

/* ---- whole layers of keys */

tn_status tn_key_walk_begin(tn_key_walk *walk, uint64_t key, tn_error *error)
{
    size_t layers = (size_t)walk->last + 1;
    walk->forward = calloc(layers, sizeof *walk->forward);
    walk->backward = calloc(layers, sizeof *walk->backward);
    walk->counts = calloc(layers, sizeof *walk->counts);
    bool ok = walk->forward && walk->backward && walk->counts &&
              tn_number(walk->graph->nodes(walk->graph_context, 0), key) != UINT32_MAX;
    return ok ? TN_OK : tn_fail_memory(error);
}

static void drop_forward(tn_key_walk *walk, uint32_t layer, const tn_walk_algebra *algebra, size_t size)
{
    clear_elements(walk->forward[layer], (uint32_t)walk->counts[layer], size, algebra);
    walk->forward[layer] = NULL;
    walk->counts[layer] = 0;
}

void tn_key_walk_clear(tn_key_walk *walk, const tn_walk_algebra *forward, const tn_walk_algebra *backward)
{
    size_t size = walk->asked.size;
    bool made = walk->forward && walk->backward && walk->counts;
    for (uint32_t n = 0; made && n <= walk->last; n++) {
        drop_forward(walk, n, forward, size);
        clear_elements(walk->backward[n], walk->backward[n] ? walk->graph->nodes(walk->graph_context, n)->count : 0,
                       size, backward);
    }
    free(walk->forward);
    free(walk->backward);
    free(walk->counts);
    walk->forward = walk->backward = NULL;
    walk->counts = NULL;
}

/* Elements up to this place of the layer. False: out of memory. */
static bool make_elements(tn_key_walk *walk, uint32_t layer, uint32_t place)
{
    const tn_key_question *asked = &walk->asked;
    size_t *count = &walk->counts[layer];
    if (asked->size == 0 || place < *count)
        return true;
    if (!tn_array_reserve(&walk->forward[layer], &walk->next_room, *count, place + 1 - *count, asked->size))
        return false;
    for (; *count <= place; ++*count)
        asked->algebra->zero(asked->context, walk->forward[layer] + *count * asked->size);
    return true;
}

static void *element_of(const tn_key_walk *walk, char *const *elements, uint32_t layer, uint32_t place)
{
    return walk->asked.size > 0 ? elements[layer] + place * walk->asked.size : NULL;
}

tn_status tn_key_walk_edge_to(tn_key_walk *walk, uint32_t from, uint32_t to, const void *label, tn_error *error)
{
    const tn_key_question *asked = &walk->asked;
    const tn_walk_edge edge = {walk->layer, from, to, label};
    if (walk->backwards)
        return asked->algebra->add(asked->context, element_of(walk, walk->backward, edge.layer, from),
                                   element_of(walk, walk->backward, edge.layer + 1, to), &edge, error);
    if (!make_elements(walk, edge.layer + 1, to))
        return tn_fail_memory(error);
    return asked->algebra->add(asked->context, element_of(walk, walk->forward, edge.layer + 1, to),
                               element_of(walk, walk->forward, edge.layer, from), &edge, error);
}

tn_status tn_key_walk_edge(tn_key_walk *walk, uint32_t from, uint64_t key, const void *label, tn_error *error)
{
    tn_numbering *next = walk->graph->nodes(walk->graph_context, walk->layer + 1);
    uint32_t to = walk->backwards ? tn_number_find(next, key) : tn_number(next, key);
    return to != UINT32_MAX  ? tn_key_walk_edge_to(walk, from, to, label, error)
           : walk->backwards ? TN_OK
                             : tn_fail_memory(error);
}

tn_status tn_key_walk_end(tn_key_walk *walk, uint32_t from, const void *label, tn_error *error)
{
    const tn_key_question *asked = &walk->asked;
    const tn_walk_edge edge = {walk->layer, from, TN_NO_STATE, label};
    char *const *elements = walk->backwards ? walk->backward : walk->forward;
    return asked->end(asked->context, element_of(walk, elements, edge.layer, from), &edge, error);
}

static tn_status show_layer(tn_key_walk *walk, tn_error *error)
{
    tn_status status = TN_OK;
    if (walk->asked.end)
        status = walk->graph->ends(walk->graph_context, walk->layer, walk, error);
    if (status == TN_OK && walk->layer < walk->last)
        status = walk->graph->edges(walk->graph_context, walk->layer, walk, error);
    return status;
}

static tn_status settle(const tn_key_walk *walk, char *const *elements, uint32_t count, tn_error *error)
{
    const tn_key_question *asked = &walk->asked;
    tn_status status = TN_OK;
    for (uint32_t i = 0; asked->algebra->settle && status == TN_OK && i < count; i++)
        status =
            asked->algebra->settle(asked->context, walk->layer, i, element_of(walk, elements, walk->layer, i), error);
    return status;
}

tn_status tn_key_walk_forward(tn_key_walk *walk, const tn_key_question *question, tn_error *error)
{
    const tn_walk_algebra *algebra = question->algebra;
    walk->asked = *question;
    walk->backwards = false;
    walk->next_room = 0;
    if (!make_elements(walk, 0, 0))
        return tn_fail_memory(error);
    tn_status status = algebra->one ? algebra->one(question->context, 0, 0, walk->forward[0], error) : TN_OK;
    for (walk->layer = 0; status == TN_OK && walk->layer <= walk->last; walk->layer++) {
        walk->next_room = 0;
        status = settle(walk, walk->forward, (uint32_t)walk->counts[walk->layer], error);
        if (status == TN_OK)
            status = show_layer(walk, error);
        if (status == TN_OK && !walk->keeps)
            drop_forward(walk, walk->layer, algebra, question->size);
    }
    return status;
}

tn_status tn_key_walk_backward(tn_key_walk *walk, const tn_key_question *question, tn_error *error)
{
    tn_status status = TN_OK;
    walk->asked = *question;
    walk->backwards = true;
    for (walk->layer = walk->last + 1; status == TN_OK && walk->layer-- > 0;) {
        uint32_t count = walk->graph->nodes(walk->graph_context, walk->layer)->count;
        char *elements = walk->backward[walk->layer] = tn_array_new((uint64_t)count + 1, question->size);
        if (!elements)
            return tn_fail_memory(error);
        for (uint32_t i = 0; i < count; i++)
            question->algebra->zero(question->context, elements + i * question->size);
        status = show_layer(walk, error);
        if (status == TN_OK)
            status = settle(walk, walk->backward, count, error);
    }
    return status;
}
