/* The layered walk: what questions about the words of an automaton share.
 *
 * Read letter by letter, an automaton is a graph in layers. A node is a state after so many letters, and an edge leads
 * from a node of one layer to a node of the next. The walk starts in state 0 of the first layer. Layers may also be of
 * states with so many letters to come, the most first: then the walk starts in a layer for each length.
 *
 * A question gives an algebra, in most cases a semiring: what `one` is, how an element is extended by an edge, and how
 * two are added. Forwards, the element of a node is the sum over the edges that lead there, each the element at its
 * source extended by the edge. Backwards, it is the sum over the edges from there, each the element at its target
 * extended by the edge.
 *
 *     question                       element            one             an edge extends it by    sum
 *     how many words                 a number           1               its symbols, times       +
 *     how many words of each value   a polynomial       x^0             symbols x^gain, times    +
 *     the moments of a value         n, sum, squares    1, 0, 0         symbols, and a shift     +
 *     the least value                a value            0               its gain, plus           the least
 *     the front of several values    values             0               its gains, plus          those that none
 * betters
 *
 * For example, the words of a and b without two b side by side: state 1 is behind a b, state 0 is not, and both accept.
 * Forwards the layers are {0: 1}, {0: 1, 1: 1} and {0: 2, 1: 1}, which makes 1, 2 and 3 words. Backwards from two
 * letters they are {0: 1, 1: 1}, {0: 2, 1: 1} and {0: 3}.
 *
 * A node has a place in its layer, in the order in which states are met. The functions are inlined into the file that
 * asks: with constant tables of functions a count in machine words costs what a loop written for it does.
 *
 * The tn_layers of a walk owns its elements. Zero it to begin with, and clear it also after a failure.
 */
#ifndef TARTAN_AUTOMATA_WALK_H
#define TARTAN_AUTOMATA_WALK_H

#include "runtime/automata/dfa.h"
#include "runtime/automata/numbering.h"
#include "runtime/base/array.h"

/* What the graph shows an edge to: the state that it leads to, and what the algebra extends by (any type). */
typedef tn_status tn_walk_seen(void *walk, uint32_t state, const void *label, tn_error *error);

typedef struct tn_walk_graph {
    bool (*starts)(void *context, uint32_t layer); /* does the walk start in state 0 of the layer? */
    tn_status (*edges)(void *context, uint32_t layer, uint32_t state, tn_walk_seen *seen, void *walk, tn_error *error);
} tn_walk_graph;

/* `starts` of a walk that starts in the first layer alone. */
static inline bool tn_walk_starts_first(void *context, uint32_t layer)
{
    (void)context;
    return layer == 0;
}

typedef struct tn_walk_edge {
    uint32_t layer;    /* of its source */
    uint32_t from, to; /* places in that layer and the next */
    const void *label;
} tn_walk_edge;

/* How elements are made and added up. They are moved in memory as bytes. */
typedef void tn_walk_zero(const void *context, void *element); /* initialises it */
typedef tn_status tn_walk_add(void *context, void *sum, const void *element, const tn_walk_edge *edge, tn_error *error);

typedef struct tn_walk_algebra {
    tn_walk_zero *zero;
    void (*clear)(void *element); /* NULL: there is nothing to free */

    /* += one: forwards in a state that the walk starts in; backwards in each node, if words end there. */
    tn_status (*one)(void *context, uint32_t layer, uint32_t state, void *element, tn_error *error);

    /* sum += element, extended by the edge. */
    tn_walk_add *add;

    /* All has been added to the element of a node. Forwards: those of the layer before are there still. NULL: nothing
     * to do. */
    tn_status (*settle)(void *context, uint32_t layer, uint32_t state, void *element, tn_error *error);

    tn_walk_seen *forward, *backward; /* add along an edge */
} tn_walk_algebra;

/* Defines an algebra of functions of this file, which compilers then inline. */
#define TN_WALK_ALGEBRA(name, zero, clear, one, add, settle)                                                           \
    static inline tn_status name##_forward(void *walk_step, uint32_t state, const void *label, tn_error *error)        \
    {                                                                                                                  \
        return tn_walk_go_forward(walk_step, state, label, zero, add, error);                                          \
    }                                                                                                                  \
    static inline tn_status name##_backward(void *walk_step, uint32_t state, const void *label, tn_error *error)       \
    {                                                                                                                  \
        return tn_walk_go_backward(walk_step, state, label, add, error);                                               \
    }                                                                                                                  \
    static const tn_walk_algebra name = {zero, clear, one, add, settle, name##_forward, name##_backward}

typedef struct tn_walk_layer {
    uint32_t *states; /* [count], in the order in which they are met */
    uint32_t count;
    uint32_t start; /* the place in which the walk starts, or TN_NO_STATE */
    size_t room;
    char *forward, *backward; /* [count]: elements, if there was such a walk */
} tn_walk_layer;

typedef struct tn_layers {
    uint32_t last;                      /* layers 0..last */
    bool kept;                          /* all layers are kept; otherwise two at a time */
    size_t forward_size, backward_size; /* of an element, in bytes */
    tn_walk_layer *layers;              /* [last + 1], or [2] */
    const tn_walk_layer *looked;        /* whose places are known; NULL: none's */
    uint32_t *place;                    /* [place_room]: of a state in that layer; of others TN_NO_STATE */
    size_t place_room;
} tn_layers;

/* Room for the layers. */
tn_status tn_walk_begin(tn_layers *walk, uint32_t last, bool kept, tn_error *error);

/* Frees all; the algebras of the elements, or NULL. */
void tn_walk_clear(tn_layers *walk, const tn_walk_algebra *forward, const tn_walk_algebra *backward);

/* Makes room for a new state of a layer. False: out of memory. */
bool tn_walk_reserve(tn_layers *walk, tn_walk_layer *layer, uint32_t state);

/* Makes all states below `count` nodes of a layer that has none yet; each state's place is its number. */
tn_status tn_walk_fill(tn_layers *walk, uint32_t layer, uint32_t count, tn_error *error);

/* Makes the states' places known of this layer; NULL: of none. */
void tn_walk_look(tn_layers *walk, const tn_walk_layer *layer);

static inline tn_walk_layer *tn_walk_at(const tn_layers *walk, uint32_t layer)
{
    return &walk->layers[walk->kept ? layer : layer & 1];
}

/* The elements of a node. */
static inline void *tn_walk_forward_of(const tn_layers *walk, uint32_t layer, uint32_t place)
{
    return tn_walk_at(walk, layer)->forward + place * walk->forward_size;
}

static inline void *tn_walk_backward_of(const tn_layers *walk, uint32_t layer, uint32_t place)
{
    return tn_walk_at(walk, layer)->backward + place * walk->backward_size;
}

/* A state's place in the layer whose places are known, or TN_NO_STATE. */
static inline uint32_t tn_walk_place(const tn_layers *walk, uint32_t state)
{
    return state < walk->place_room ? walk->place[state] : TN_NO_STATE;
}

/* The node whose edges are shown. */
typedef struct tn_walk_step {
    tn_layers *walk;
    void *context; /* of the algebra */
    size_t size;   /* of an element */
    const tn_walk_layer *here;
    tn_walk_layer *next;
    uint32_t layer, from;
} tn_walk_step;

/* ---- forwards */

/* The state's place in the layer whose places are known, old or new; TN_NO_STATE: out of memory. zero: NULL if nodes
 * get no elements. */
static inline uint32_t tn_walk_meet(tn_layers *walk, tn_walk_layer *layer, uint32_t state, tn_walk_zero *zero,
                                    const void *context, size_t size)
{
    uint32_t place = tn_walk_place(walk, state);
    if (place != TN_NO_STATE)
        return place;
    if ((layer->count == layer->room || state >= walk->place_room) && !tn_walk_reserve(walk, layer, state))
        return TN_NO_STATE;
    place = layer->count++;
    layer->states[place] = state;
    walk->place[state] = place;
    if (zero)
        zero(context, layer->forward + place * size);
    return place;
}

static inline tn_status tn_walk_go_forward(const tn_walk_step *step, uint32_t state, const void *label,
                                           tn_walk_zero *zero, tn_walk_add *add, tn_error *error)
{
    size_t size = step->size;
    uint32_t to = tn_walk_meet(step->walk, step->next, state, zero, step->context, size);
    if (to == TN_NO_STATE)
        return tn_fail_memory(error);
    tn_walk_edge edge = {step->layer, step->from, to, label};
    return add(step->context, step->next->forward + to * size, step->here->forward + step->from * size, &edge, error);
}

/* Meets the state, and that is all. */
static inline tn_status tn_walk_find(void *walk, uint32_t state, const void *label, tn_error *error)
{
    const tn_walk_step *step = walk;
    (void)label;
    return tn_walk_meet(step->walk, step->next, state, NULL, NULL, 0) == TN_NO_STATE ? tn_fail_memory(error) : TN_OK;
}

/* Starts in the layer, if the walk does so there, and settles its elements. */
static inline tn_status tn_walk_settle(tn_layers *walk, uint32_t layer, const tn_walk_graph *graph, void *graph_context,
                                       const tn_walk_algebra *algebra, void *context, size_t size, tn_error *error)
{
    tn_walk_layer *here = tn_walk_at(walk, layer);
    tn_status status = TN_OK;
    here->start = TN_NO_STATE;
    if (graph->starts(graph_context, layer)) {
        here->start = tn_walk_meet(walk, here, 0, algebra ? algebra->zero : NULL, context, size);
        if (here->start == TN_NO_STATE)
            return tn_fail_memory(error);
        if (algebra)
            status = algebra->one(context, layer, 0, here->forward + here->start * size, error);
    }
    for (uint32_t i = 0; algebra && algebra->settle && status == TN_OK && i < here->count; i++)
        status = algebra->settle(context, layer, here->states[i], here->forward + i * size, error);
    return status;
}

/* Makes a layer's room that of the next one. */
static inline void tn_walk_empty(tn_layers *walk, tn_walk_layer *layer, const tn_walk_algebra *algebra, size_t size)
{
    for (uint32_t i = 0; algebra && algebra->clear && i < layer->count; i++)
        algebra->clear(layer->forward + i * size);
    layer->count = 0;
    tn_walk_look(walk, layer);
}

/* Meets all nodes and gives them elements of so many bytes; algebra NULL: they get none. */
static inline tn_status tn_walk_forward(tn_layers *walk, const tn_walk_graph *graph, void *graph_context,
                                        const tn_walk_algebra *algebra, void *context, size_t size, tn_error *error)
{
    tn_status status = TN_OK;
    walk->forward_size = size;
    for (uint32_t n = 0; status == TN_OK; n++) {
        tn_walk_layer *here = tn_walk_at(walk, n), *next = tn_walk_at(walk, n + (n < walk->last));
        status = tn_walk_settle(walk, n, graph, graph_context, algebra, context, size, error);
        if (n == walk->last)
            break;
        tn_walk_empty(walk, next, algebra, size);
        for (uint32_t i = 0; status == TN_OK && i < here->count; i++) {
            tn_walk_step step = {walk, context, size, here, next, n, i};
            status = graph->edges(graph_context, n, here->states[i], algebra ? algebra->forward : tn_walk_find, &step,
                                  error);
        }
    }
    return status;
}

/* ---- backwards, over layers that are kept */

static inline tn_status tn_walk_go_backward(const tn_walk_step *step, uint32_t state, const void *label,
                                            tn_walk_add *add, tn_error *error)
{
    size_t size = step->size;
    tn_walk_edge edge = {step->layer, step->from, tn_walk_place(step->walk, state), label};
    return add(step->context, step->here->backward + edge.from * size, step->next->backward + edge.to * size, &edge,
               error);
}

/* Gives the nodes elements of so many bytes. */
static inline tn_status tn_walk_backward(tn_layers *walk, const tn_walk_graph *graph, void *graph_context,
                                         const tn_walk_algebra *algebra, void *context, size_t size, tn_error *error)
{
    tn_status status = TN_OK;
    walk->backward_size = size;
    for (uint32_t n = walk->last + 1; status == TN_OK && n-- > 0;) {
        tn_walk_layer *here = tn_walk_at(walk, n), *next = tn_walk_at(walk, n + (n < walk->last));
        here->backward = tn_array_new((uint64_t)here->count + 1, size);
        if (!here->backward)
            return tn_fail_memory(error);
        for (uint32_t i = 0; i < here->count; i++)
            algebra->zero(context, here->backward + i * size);
        if (n < walk->last)
            tn_walk_look(walk, next);
        for (uint32_t i = 0; status == TN_OK && i < here->count; i++) {
            void *element = here->backward + i * size;
            tn_walk_step step = {walk, context, size, here, next, n, i};
            status = algebra->one(context, n, here->states[i], element, error);
            if (status == TN_OK && n < walk->last)
                status = graph->edges(graph_context, n, here->states[i], algebra->backward, &step, error);
            if (status == TN_OK && algebra->settle)
                status = algebra->settle(context, n, here->states[i], element, error);
        }
    }
    return status;
}

/* ---- along a path */

/* Shows an edge of a walk whose layers are kept. */
typedef tn_status tn_walk_take(void *context, const tn_walk_edge *edge, tn_error *error);

typedef struct tn_walk_way {
    const tn_layers *walk;
    tn_walk_take *take;
    void *context;
    uint32_t layer, from;
} tn_walk_way;

static inline tn_status tn_walk_go_on(void *walk, uint32_t state, const void *label, tn_error *error)
{
    const tn_walk_way *way = walk;
    tn_walk_edge edge = {way->layer, way->from, tn_walk_place(way->walk, state), label};
    return way->take(way->context, &edge, error);
}

/* Shows the edges from one node of a layer that is not the last. */
static inline tn_status tn_walk_from(tn_layers *walk, const tn_walk_graph *graph, void *graph_context, uint32_t layer,
                                     uint32_t place, tn_walk_take *take, void *context, tn_error *error)
{
    tn_walk_way way = {walk, take, context, layer, place};
    tn_walk_look(walk, tn_walk_at(walk, layer + 1));
    return graph->edges(graph_context, layer, tn_walk_at(walk, layer)->states[place], tn_walk_go_on, &way, error);
}

/* ---- whole layers of keys
 *
 * Nodes can also be keys of 64 bits, which the graph numbers: a key's number in its layer is its place. Such a graph
 * shows the edges from all nodes of a layer at once, in any order: many nodes can then share the work of finding what
 * leads on from them. Words end in any layer, by edges of their own.
 */
typedef struct tn_key_walk tn_key_walk;

typedef struct tn_key_graph {
    tn_numbering *(*nodes)(void *context, uint32_t layer);
    tn_status (*edges)(void *context, uint32_t layer, tn_key_walk *walk, tn_error *error); /* tn_key_walk_edge */
    tn_status (*ends)(void *context, uint32_t layer, tn_key_walk *walk, tn_error *error);  /* tn_key_walk_end */
} tn_key_graph;

/* What is asked. Of the algebra: zero, clear, add and settle; and what an edge to the end adds: forwards to the answer,
 * from the element at its source; backwards to that element. NULL: ends are not shown. */
typedef struct tn_key_question {
    const tn_walk_algebra *algebra;
    tn_status (*end)(void *context, void *element, const tn_walk_edge *edge, tn_error *error);
    void *context;
    size_t size; /* of an element, in bytes; 0: edges are shown to `add`, and nodes have no elements */
} tn_key_question;

struct tn_key_walk {
    const tn_key_graph *graph;
    void *graph_context;
    uint32_t last;    /* layers 0..last */
    bool keeps;       /* elements of all layers are kept while it goes forwards */
    char **forward;   /* [last + 1]: the elements of each layer, if there are any; owned until it is cleared */
    char **backward;  /* the same; a question may take them, and leaves NULL */
    size_t *counts;   /* [last + 1]: how many elements `forward` has */
    size_t next_room; /* of those of the layer that is being met */
    bool backwards;   /* the direction in which it goes */
    uint32_t layer;   /* at hand */
    tn_key_question asked;
};

/* Room for the layers; the first has a node with this key. Clear it also after a failure. */
tn_status tn_key_walk_begin(tn_key_walk *walk, uint64_t key, tn_error *error);

/* Frees all; the algebras of elements that are still there, or NULL. If there are both, they are of one size. */
void tn_key_walk_clear(tn_key_walk *walk, const tn_walk_algebra *forward, const tn_walk_algebra *backward);

/* Meets all nodes. The element of the first is one (algebra->one; NULL: as zero makes it). */
tn_status tn_key_walk_forward(tn_key_walk *walk, const tn_key_question *question, tn_error *error);

/* Over the nodes that are met already. */
tn_status tn_key_walk_backward(tn_key_walk *walk, const tn_key_question *question, tn_error *error);

/* What graphs show: an edge from a place to a key of the next layer, or to its place; to the end of a word. */
tn_status tn_key_walk_edge(tn_key_walk *walk, uint32_t from, uint64_t key, const void *label, tn_error *error);
tn_status tn_key_walk_edge_to(tn_key_walk *walk, uint32_t from, uint32_t to, const void *label, tn_error *error);
tn_status tn_key_walk_end(tn_key_walk *walk, uint32_t from, const void *label, tn_error *error);

static inline void *tn_key_walk_forward_of(const tn_key_walk *walk, uint32_t layer, uint32_t place, size_t size)
{
    return walk->forward[layer] + place * size;
}

#endif
