/* Decision diagrams whose terminals are labels, and which count what is below each node. */
#include "runtime/choices/labelling.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

enum { VALUES_MAX = TN_CHOICE_VALUES_MAX, WORD_BITS = 64 };

/* ---- making nodes */

static tn_status new_labelling(const uint32_t *values, uint32_t fields, tn_labelling **out)
{
    tn_labelling *made = calloc(1, sizeof *made);
    if (made && !(made->values = malloc((fields + 1u) * sizeof *made->values))) {
        free(made);
        made = NULL;
    }
    *out = made;
    if (!made)
        return TN_MEMORY;
    memcpy(made->values, values, fields * sizeof *values);
    made->fields = fields;
    made->root = TN_UNLABELLED;
    return TN_OK;
}

void tn_labelling_free(tn_labelling *labelling)
{
    if (!labelling)
        return;
    free(labelling->values);
    tn_interner_clear(&labelling->nodes);
    free(labelling->below_first);
    free(labelling->below);
    free(labelling->sizes);
    free(labelling->first);
    free(labelling);
}

/* *node: of a field by what follows its values; TN_UNLABELLED where nothing does. */
static tn_status add_node(tn_labelling *made, uint32_t field, const uint32_t *follow, uint32_t *node)
{
    uint32_t words[VALUES_MAX + 1];
    bool any = false;
    words[0] = field;
    for (uint32_t v = 0; v < made->values[field]; v++) {
        words[v + 1] = follow[v];
        any = any || follow[v] != TN_UNLABELLED;
    }
    *node = TN_UNLABELLED;
    if (!any)
        return TN_OK;
    if (made->nodes.words_used > TN_LABELLING_ROOM)
        return TN_LIMIT;
    *node = tn_intern(&made->nodes, words, made->values[field] + 1u);
    return *node == UINT32_MAX ? TN_MEMORY : TN_OK;
}

/* Hands on what is made, or frees it. */
static tn_status give(tn_labelling *made, tn_status status, tn_labelling **out)
{
    if (status != TN_OK)
        tn_labelling_free(made);
    *out = status == TN_OK ? made : NULL;
    return status;
}

tn_status tn_labelling_of_box(const uint32_t *values, uint32_t fields, const uint64_t *mask, tn_labelling **out)
{
    tn_labelling *made;
    tn_status status = new_labelling(values, fields, &made);
    uint32_t bit = 0, inside = 1, outside = 0;
    for (uint32_t f = 0; f < fields; f++)
        bit += values[f];
    for (uint32_t f = fields; status == TN_OK && f-- > 0;) {
        uint32_t in[VALUES_MAX], out_of[VALUES_MAX];
        bit -= values[f];
        for (uint32_t v = 0; v < values[f]; v++) {
            bool set = mask[(bit + v) / WORD_BITS] >> ((bit + v) % WORD_BITS) & 1;
            in[v] = set ? inside : outside;
            out_of[v] = outside;
        }
        status = add_node(made, f, out_of, &outside);
        if (status == TN_OK)
            status = add_node(made, f, in, &inside);
    }
    if (status == TN_OK) {
        made->root = inside;
        made->labels = 2;
    }
    return give(made, status, out);
}

tn_status tn_labelling_of_field(const uint32_t *values, uint32_t fields, uint32_t field, const uint32_t *labels,
                                tn_labelling **out)
{
    tn_labelling *made;
    tn_status status = new_labelling(values, fields, &made);
    uint32_t below[VALUES_MAX], follow[VALUES_MAX];
    if (status != TN_OK)
        return give(made, status, out);
    for (uint32_t v = 0; v < values[field]; v++) {
        below[v] = labels[v];
        made->labels = made->labels > labels[v] ? made->labels : labels[v] + 1;
    }
    for (uint32_t f = fields; status == TN_OK && f-- > field + 1;)
        for (uint32_t v = 0; status == TN_OK && v < values[field]; v++) {
            for (uint32_t u = 0; u < values[f]; u++)
                follow[u] = below[v];
            status = add_node(made, f, follow, &below[v]);
        }
    if (status == TN_OK)
        status = add_node(made, field, below, &made->root);
    for (uint32_t f = field; status == TN_OK && f-- > 0;) {
        for (uint32_t u = 0; u < values[f]; u++)
            follow[u] = made->root;
        status = add_node(made, f, follow, &made->root);
    }
    return give(made, status, out);
}

/* ---- counting what is below */

/* Room to add up the labels below a node. */
typedef struct adding {
    uint64_t *counts; /* [labels]: 0 but for those that were met */
    uint32_t *met;    /* [labels] */
    uint32_t met_count;
} adding;

static void add_label(adding *a, uint32_t label, uint64_t count)
{
    if (a->counts[label] == 0)
        a->met[a->met_count++] = label;
    a->counts[label] += count; /* below 2^32 each, of at most 256 nodes */
}

static void add_below(const tn_labelling *l, adding *a, uint32_t node)
{
    size_t size;
    const uint32_t *words = tn_interned(&l->nodes, node, &size);
    for (size_t i = 1; i < size; i++) {
        if (words[i] == TN_UNLABELLED)
            continue;
        if (words[0] + 1 == l->fields) {
            add_label(a, words[i], 1);
            continue;
        }
        for (size_t k = l->below_first[words[i]]; k < l->below_first[words[i] + 1]; k++)
            add_label(a, l->below[k].label, l->below[k].count);
    }
}

static tn_status note_below(tn_labelling *l, adding *a, uint32_t node, size_t *capacity)
{
    uint64_t size = 0;
    size_t used = l->below_first[node];
    a->met_count = 0;
    add_below(l, a, node);
    if (used + a->met_count > TN_LABELLING_ROOM)
        return TN_LIMIT;
    if (!tn_array_reserve(&l->below, capacity, used, a->met_count, sizeof *l->below))
        return TN_MEMORY;
    qsort(a->met, a->met_count, sizeof *a->met, tn_words_compare);
    for (uint32_t i = 0; i < a->met_count; i++) {
        uint64_t *count = &a->counts[a->met[i]];
        size += *count;
        l->below[used++] = (tn_label_count){a->met[i], (uint32_t)*count};
        *count = 0;
    }
    l->below_first[node + 1] = used;
    l->sizes[node] = (uint32_t)size;
    return size <= TN_LABELLED_MAX ? TN_OK : TN_LIMIT;
}

static uint32_t size_below(const tn_labelling *l, uint32_t field, uint32_t follow)
{
    if (follow == TN_UNLABELLED)
        return 0;
    return field + 1 == l->fields ? 1 : l->sizes[follow];
}

/* Finds the first number of each label: where a node is met again, its labels have one. */
static void note_first(tn_labelling *l, uint8_t *met, uint32_t field, uint32_t node, uint32_t number)
{
    const uint32_t *follow = tn_labelling_follow(l, node);
    met[node] = 1;
    for (uint32_t v = 0; v < l->values[field]; v++) {
        uint32_t below = follow[v];
        if (below == TN_UNLABELLED)
            continue;
        if (field + 1 < l->fields && !met[below])
            note_first(l, met, field + 1, below, number);
        else if (field + 1 == l->fields && l->first[below] == TN_UNLABELLED)
            l->first[below] = number;
        number += size_below(l, field, below);
    }
}

/* Makes all that is found again by nodes. */
static tn_status finish(tn_labelling *l)
{
    size_t nodes = l->nodes.count, labels = l->labels, capacity = 0;
    adding a = {calloc(labels + 1, sizeof *a.counts), malloc((labels + 1) * sizeof *a.met), 0};
    uint8_t *met = calloc(nodes + 1, sizeof *met);
    l->below_first = calloc(nodes + 1, sizeof *l->below_first);
    l->sizes = calloc(nodes + 1, sizeof *l->sizes);
    l->first = malloc((labels + 1) * sizeof *l->first);
    tn_status status = a.counts && a.met && met && l->below_first && l->sizes && l->first ? TN_OK : TN_MEMORY;
    for (uint32_t n = 0; status == TN_OK && n < nodes; n++)
        status = note_below(l, &a, n, &capacity);
    if (status == TN_OK) {
        l->count = l->root == TN_UNLABELLED ? 0 : l->sizes[l->root];
        memset(l->first, 0xff, (labels + 1) * sizeof *l->first);
        if (l->count > 0)
            note_first(l, met, 0, l->root, 0);
    }
    free(a.counts);
    free(a.met);
    free(met);
    return status;
}

/* ---- of a set */

/* What nodes were made of, and the nodes. */
typedef struct making {
    const tn_choice_diagram *choices;
    const tn_labelling *a, *b;
    const uint32_t *kinds;
    tn_labelling *made;
    tn_numbering sources; /* two numbers: a field and a set, or two nodes */
    uint32_t *nodes;      /* [sources] */
    size_t capacity;
    tn_numbering labels; /* two labels */
} making;

static tn_status remember(making *m, uint64_t source, uint32_t node)
{
    if (!tn_array_reserve(&m->nodes, &m->capacity, m->sources.count, 1, sizeof *m->nodes))
        return TN_MEMORY;
    uint32_t number = tn_number(&m->sources, source);
    if (number == UINT32_MAX)
        return TN_MEMORY;
    m->nodes[number] = node;
    return m->sources.count > TN_LABELLING_ROOM ? TN_LIMIT : TN_OK;
}

static bool is_known(const making *m, uint64_t source, uint32_t *node)
{
    uint32_t number = tn_number_find(&m->sources, source);
    if (number != UINT32_MAX)
        *node = m->nodes[number];
    return number != UINT32_MAX;
}

/* Recursion here and below is as deep as there are fields. */
static tn_status node_of_set(making *m, uint32_t field, tn_choice_set set, uint32_t *node)
{
    *node = TN_UNLABELLED;
    uint64_t source = (uint64_t)field << 32 | set;
    if (set == TN_CHOICE_NONE || is_known(m, source, node))
        return TN_OK;
    if (field == m->made->fields) {
        *node = 0;
        return TN_OK;
    }
    uint32_t follow[VALUES_MAX];
    tn_status status = TN_OK;
    for (uint32_t v = 0; status == TN_OK && v < m->made->values[field]; v++)
        status = node_of_set(m, field + 1, tn_choices_follow(m->choices, set, field, v), &follow[v]);
    if (status == TN_OK)
        status = add_node(m->made, field, follow, node);
    return status == TN_OK ? remember(m, source, *node) : status;
}

static tn_status end_making(making *m, tn_status status, tn_labelling **out)
{
    tn_numbering_clear(&m->sources);
    tn_numbering_clear(&m->labels);
    free(m->nodes);
    if (status == TN_OK)
        status = finish(m->made);
    return give(m->made, status, out);
}

tn_status tn_labelling_of_set(const tn_choice_diagram *choices, tn_choice_set set, tn_labelling **out)
{
    uint32_t values[VALUES_MAX], fields = tn_choices_fields(choices);
    making m = {.choices = choices};
    *out = NULL;
    if (fields > VALUES_MAX)
        return TN_LIMIT;
    for (uint32_t f = 0; f < fields; f++)
        values[f] = tn_choices_values(choices, f);
    tn_status status = new_labelling(values, fields, &m.made);
    if (status == TN_OK)
        status = node_of_set(&m, 0, set, &m.made->root);
    if (status == TN_OK)
        m.made->labels = m.made->root != TN_UNLABELLED;
    return end_making(&m, status, out);
}

/* ---- joining */

/* The label of two that follow the last field's value. */
static tn_status join_labels(making *m, uint32_t a, uint32_t b, uint32_t *label)
{
    uint32_t kind = m->kinds ? m->kinds[b] : b;
    *label = tn_number(&m->labels, (uint64_t)a << 32 | kind);
    return *label == UINT32_MAX ? TN_MEMORY : TN_OK;
}

static tn_status join_nodes(making *m, uint32_t field, uint32_t a, uint32_t b, uint32_t *node)
{
    *node = TN_UNLABELLED;
    if (a == TN_UNLABELLED || b == TN_UNLABELLED)
        return TN_OK;
    if (field == m->made->fields)
        return join_labels(m, a, b, node);
    uint64_t source = (uint64_t)a << 32 | b;
    if (is_known(m, source, node))
        return TN_OK;
    uint32_t follow[VALUES_MAX];
    tn_status status = TN_OK;
    for (uint32_t v = 0; status == TN_OK && v < m->made->values[field]; v++)
        status = join_nodes(m, field + 1, tn_labelling_follow(m->a, a)[v], tn_labelling_follow(m->b, b)[v], &follow[v]);
    if (status == TN_OK)
        status = add_node(m->made, field, follow, node);
    return status == TN_OK ? remember(m, source, *node) : status;
}

tn_status tn_labelling_join(const tn_labelling *a, const tn_labelling *b, const uint32_t *kinds, tn_labelling **out)
{
    making m = {.a = a, .b = b, .kinds = kinds};
    tn_status status = new_labelling(a->values, a->fields, &m.made);
    if (status == TN_OK)
        status = join_nodes(&m, 0, a->root, b->root, &m.made->root);
    if (status == TN_OK)
        m.made->labels = m.labels.count;
    return end_making(&m, status, out);
}

/* ---- looking up */

uint32_t tn_labelling_at(const tn_labelling *l, uint32_t number, uint8_t *values)
{
    uint32_t node = l->root;
    for (uint32_t f = 0; f < l->fields; f++) {
        const uint32_t *follow = tn_labelling_follow(l, node);
        uint32_t v = 0, size;
        while ((size = size_below(l, f, follow[v])) <= number) {
            number -= size;
            v++;
        }
        if (values)
            values[f] = (uint8_t)v;
        node = follow[v];
    }
    return node;
}

uint32_t tn_labelling_number(const tn_labelling *l, const uint8_t *values)
{
    uint32_t node = l->root, number = 0;
    for (uint32_t f = 0; f < l->fields && node != TN_UNLABELLED; f++) {
        const uint32_t *follow = tn_labelling_follow(l, node);
        for (uint32_t v = 0; v < values[f]; v++)
            number += size_below(l, f, follow[v]);
        node = follow[values[f]];
    }
    return node == TN_UNLABELLED ? TN_UNLABELLED : number;
}

/* The labels below what follows a value. */
static const tn_label_count *counts_below(const tn_labelling *l, uint32_t field, uint32_t follow, tn_label_count *one,
                                          size_t *count)
{
    if (field + 1 == l->fields) {
        *one = (tn_label_count){follow, 1};
        *count = 1;
        return one;
    }
    *count = l->below_first[follow + 1] - l->below_first[follow];
    return l->below + l->below_first[follow];
}

uint32_t tn_labelling_find(const tn_labelling *l, tn_labelling_pass *pass, void *context)
{
    uint32_t node = l->root, number = 0;
    for (uint32_t f = 0; f < l->fields && node != TN_UNLABELLED; f++) {
        const uint32_t *follow = tn_labelling_follow(l, node);
        uint32_t v = 0;
        for (; v < l->values[f]; v++) {
            tn_label_count one;
            size_t count;
            if (follow[v] == TN_UNLABELLED)
                continue;
            const tn_label_count *counts = counts_below(l, f, follow[v], &one, &count);
            if (!pass(context, counts, count))
                break;
            number += size_below(l, f, follow[v]);
        }
        if (v == l->values[f]) /* all of a stretch are passed that was not passed as a whole, or all there are */
            return number;
        node = follow[v];
    }
    return number;
}

typedef struct adding_before {
    uint32_t left; /* combinations still to add */
    tn_labelling_add *add;
    void *context;
} adding_before;

static bool pass_before(void *context, const tn_label_count *counts, size_t count)
{
    adding_before *a = context;
    uint64_t size = 0;
    for (size_t i = 0; i < count; i++)
        size += counts[i].count;
    if (size > a->left)
        return false;
    a->left -= (uint32_t)size;
    a->add(a->context, counts, count);
    return true;
}

void tn_labelling_before(const tn_labelling *l, uint32_t number, tn_labelling_add *add, void *context)
{
    adding_before a = {number, add, context};
    tn_labelling_find(l, pass_before, &a);
}

typedef struct seeking {
    const tn_labelling *labelling;
    tn_labelling_wanted *wanted;
    void *context;
    uint32_t from;
} seeking;

static bool any_wanted(const seeking *s, uint32_t field, uint32_t follow)
{
    tn_label_count one;
    size_t count;
    const tn_label_count *counts = counts_below(s->labelling, field, follow, &one, &count);
    for (size_t i = 0; i < count; i++)
        if (s->wanted(s->context, counts[i].label))
            return true;
    return false;
}

/* The first wanted number below a node whose first number this is, or TN_UNLABELLED. */
static uint32_t seek(const seeking *s, uint32_t field, uint32_t node, uint32_t number)
{
    const tn_labelling *l = s->labelling;
    if (field == l->fields)
        return number;
    const uint32_t *follow = tn_labelling_follow(l, node);
    for (uint32_t v = 0; v < l->values[field]; v++) {
        uint32_t size = size_below(l, field, follow[v]);
        if (size > 0 && number + (size - 1) >= s->from && any_wanted(s, field, follow[v])) {
            uint32_t found = seek(s, field + 1, follow[v], number);
            if (found != TN_UNLABELLED)
                return found;
        }
        number += size;
    }
    return TN_UNLABELLED;
}

uint32_t tn_labelling_next(const tn_labelling *l, uint32_t from, tn_labelling_wanted *wanted, void *context)
{
    seeking s = {l, wanted, context, from};
    uint32_t found = l->root == TN_UNLABELLED ? TN_UNLABELLED : seek(&s, 0, l->root, 0);
    return found == TN_UNLABELLED ? l->count : found;
}
