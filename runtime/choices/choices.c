/* Decision diagrams over fields of several values, kept so that equal ones are one. */
#include "runtime/choices/choices.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/automata/numbering.h"
#include "runtime/base/array.h"

enum { VALUES_MAX = TN_CHOICE_VALUES_MAX, WORD_BITS = 64 };

struct tn_choice_diagram {
    uint32_t fields, room;
    uint32_t *counts;  /* [fields] */
    uint32_t *starts;  /* [fields + 1]: of its bits in a mask */
    tn_interner nodes; /* of set s: s - 2; a node is its field, then what follows each value */
    tn_numbering joined;
    tn_choice_set *joins; /* [joined]: the pair's `and` */
    size_t join_capacity;
    tn_choice_set *opposites; /* [nodes]; 0: not made yet */
    size_t opposite_capacity;
    uint64_t *sizes; /* [nodes]: how many combinations of its field and those after it; 0: not counted yet */
    size_t size_capacity;
    bool full;
};

tn_choice_diagram *tn_choices_new(const uint32_t *counts, uint32_t fields, uint32_t room)
{
    tn_choice_diagram *choices = calloc(1, sizeof *choices);
    if (!choices)
        return NULL;
    choices->fields = fields;
    choices->room = room;
    choices->counts = malloc((fields + 1u) * sizeof *choices->counts);
    choices->starts = malloc((fields + 1u) * sizeof *choices->starts);
    if (!choices->counts || !choices->starts) {
        tn_choices_free(choices);
        return NULL;
    }
    uint32_t start = 0;
    for (uint32_t f = 0; f < fields; f++) {
        choices->counts[f] = counts[f];
        choices->starts[f] = start;
        start += counts[f];
    }
    choices->starts[fields] = start;
    return choices;
}

void tn_choices_free(tn_choice_diagram *choices)
{
    if (!choices)
        return;
    free(choices->counts);
    free(choices->starts);
    tn_interner_clear(&choices->nodes);
    tn_numbering_clear(&choices->joined);
    free(choices->joins);
    free(choices->opposites);
    free(choices->sizes);
    free(choices);
}

uint32_t tn_choices_fields(const tn_choice_diagram *choices)
{
    return choices->fields;
}

uint32_t tn_choices_values(const tn_choice_diagram *choices, uint32_t field)
{
    return choices->counts[field];
}

bool tn_choices_full(const tn_choice_diagram *choices)
{
    return choices->full;
}

/* Is another piece of work so large that no set is made any more? */
static bool overfull(tn_choice_diagram *choices)
{
    choices->full = choices->full || choices->nodes.words_used > choices->room || choices->joined.count > choices->room;
    return choices->full;
}

/* The field of a set, and what follows each of its values. */
static const uint32_t *node_of(const tn_choice_diagram *choices, tn_choice_set set, uint32_t *field)
{
    size_t size;
    const uint32_t *words = tn_interned(&choices->nodes, set - 2, &size);
    *field = words[0];
    return words + 1;
}

/* Of the sets NONE and ALL: one past the last field. */
static uint32_t field_of(const tn_choice_diagram *choices, tn_choice_set set)
{
    uint32_t field = choices->fields;
    if (set > TN_CHOICE_ALL)
        node_of(choices, set, &field);
    return field;
}

/* Of a set that begins later, it is the set itself. */
tn_choice_set tn_choices_follow(const tn_choice_diagram *choices, tn_choice_set set, uint32_t field, uint32_t value)
{
    uint32_t own = choices->fields;
    const uint32_t *follow = set > TN_CHOICE_ALL ? node_of(choices, set, &own) : NULL;
    return own == field ? follow[value] : set;
}

tn_choice_set tn_choices_node(tn_choice_diagram *choices, uint32_t field, const tn_choice_set *follow)
{
    uint32_t words[VALUES_MAX + 1], count = choices->counts[field];
    bool same = true;
    words[0] = field;
    for (uint32_t v = 0; v < count; v++) {
        if (follow[v] == TN_CHOICE_LOST)
            return TN_CHOICE_LOST;
        words[v + 1] = follow[v];
        same = same && follow[v] == follow[0];
    }
    if (same)
        return follow[0];
    if (overfull(choices))
        return TN_CHOICE_LOST;
    uint32_t node = tn_intern(&choices->nodes, words, count + 1u);
    return node == UINT32_MAX ? TN_CHOICE_LOST : node + 2;
}

static bool has_bit(const uint64_t *mask, uint32_t bit)
{
    return mask[bit / WORD_BITS] >> (bit % WORD_BITS) & 1;
}

tn_choice_set tn_choices_box(tn_choice_diagram *choices, const uint64_t *mask)
{
    tn_choice_set made = TN_CHOICE_ALL;
    for (uint32_t f = choices->fields; f-- > 0;) {
        tn_choice_set follow[VALUES_MAX];
        for (uint32_t v = 0; v < choices->counts[f]; v++)
            follow[v] = has_bit(mask, choices->starts[f] + v) ? made : TN_CHOICE_NONE;
        made = tn_choices_node(choices, f, follow);
    }
    return made;
}

/* ---- opposites, and what is in both */

/* Remembers that two sets are each other's opposites. */
static bool note_opposites(tn_choice_diagram *choices, tn_choice_set a, tn_choice_set b)
{
    size_t needed = choices->nodes.count, before = choices->opposite_capacity;
    if (needed > before) {
        size_t capacity = tn_array_larger(before, needed, TN_ARRAY_FIRST);
        if (!tn_array_resize(&choices->opposites, capacity, sizeof *choices->opposites))
            return false;
        memset(choices->opposites + before, 0, (capacity - before) * sizeof *choices->opposites);
        choices->opposite_capacity = capacity;
    }
    choices->opposites[a - 2] = b;
    choices->opposites[b - 2] = a;
    return true;
}

/* Recursion here and below is as deep as there are fields. */
tn_choice_set tn_choices_not(tn_choice_diagram *choices, tn_choice_set set)
{
    if (set == TN_CHOICE_LOST || set <= TN_CHOICE_ALL)
        return set == TN_CHOICE_LOST ? set : TN_CHOICE_ALL - set;
    if (set - 2 < choices->opposite_capacity && choices->opposites[set - 2])
        return choices->opposites[set - 2];
    tn_choice_set follow[VALUES_MAX];
    uint32_t field;
    node_of(choices, set, &field);
    for (uint32_t v = 0; v < choices->counts[field]; v++) /* making one moves the nodes */
        follow[v] = tn_choices_not(choices, tn_choices_follow(choices, set, field, v));
    tn_choice_set made = tn_choices_node(choices, field, follow);
    return made == TN_CHOICE_LOST || !note_opposites(choices, set, made) ? TN_CHOICE_LOST : made;
}

static tn_choice_set keep_join(tn_choice_diagram *choices, uint64_t pair, tn_choice_set made)
{
    size_t count = choices->joined.count; /* first the room, so that every pair that is known has its join */
    if (made == TN_CHOICE_LOST ||
        !tn_array_reserve(&choices->joins, &choices->join_capacity, count, 1, sizeof *choices->joins))
        return TN_CHOICE_LOST;
    uint32_t number = tn_number(&choices->joined, pair);
    if (number == UINT32_MAX)
        return TN_CHOICE_LOST;
    choices->joins[number] = made;
    return made;
}

tn_choice_set tn_choices_and(tn_choice_diagram *choices, tn_choice_set a, tn_choice_set b)
{
    if (a == TN_CHOICE_LOST || b == TN_CHOICE_LOST)
        return TN_CHOICE_LOST;
    if (a == TN_CHOICE_NONE || b == TN_CHOICE_NONE)
        return TN_CHOICE_NONE;
    if (a == TN_CHOICE_ALL || a == b)
        return b;
    if (b == TN_CHOICE_ALL)
        return a;
    uint64_t pair = a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
    uint32_t known = tn_number_find(&choices->joined, pair);
    if (known != UINT32_MAX)
        return choices->joins[known];
    if (overfull(choices))
        return TN_CHOICE_LOST;
    tn_choice_set follow[VALUES_MAX];
    uint32_t one = field_of(choices, a), other = field_of(choices, b), field = one < other ? one : other;
    for (uint32_t v = 0; v < choices->counts[field]; v++)
        follow[v] =
            tn_choices_and(choices, tn_choices_follow(choices, a, field, v), tn_choices_follow(choices, b, field, v));
    return keep_join(choices, pair, tn_choices_node(choices, field, follow));
}

tn_choice_set tn_choices_or(tn_choice_diagram *choices, tn_choice_set a, tn_choice_set b)
{
    return tn_choices_not(choices, tn_choices_and(choices, tn_choices_not(choices, a), tn_choices_not(choices, b)));
}

tn_choice_set tn_choices_any_of(tn_choice_diagram *choices, tn_choice_set *sets, size_t count)
{
    while (count > 1) {
        for (size_t i = 0; i < count / 2; i++)
            sets[i] = tn_choices_or(choices, sets[2 * i], sets[2 * i + 1]);
        if (count % 2)
            sets[count / 2] = sets[count - 1];
        count = (count + 1) / 2;
    }
    return count ? sets[0] : TN_CHOICE_NONE;
}

/* ---- counting and listing */

static uint64_t times(uint64_t a, uint64_t b)
{
    uint64_t product;
    return __builtin_mul_overflow(a, b, &product) ? UINT64_MAX : product;
}

static uint64_t plus(uint64_t a, uint64_t b)
{
    return a > UINT64_MAX - b ? UINT64_MAX : a + b;
}

/* Of the fields from `from` on. */
static uint64_t count_from(tn_choice_diagram *choices, tn_choice_set set, uint32_t from)
{
    uint32_t field = field_of(choices, set);
    uint64_t size = set <= TN_CHOICE_ALL ? set : choices->sizes[set - 2];
    if (size == 0 && set > TN_CHOICE_ALL) {
        for (uint32_t v = 0; v < choices->counts[field]; v++)
            size = plus(size, count_from(choices, tn_choices_follow(choices, set, field, v), field + 1));
        choices->sizes[set - 2] = size;
    }
    while (field-- > from)
        size = times(size, choices->counts[field]);
    return size;
}

bool tn_choices_count(tn_choice_diagram *choices, tn_choice_set set, uint64_t *count)
{
    size_t needed = choices->nodes.count, before = choices->size_capacity;
    if (needed > before) {
        if (!tn_array_resize(&choices->sizes, needed, sizeof *choices->sizes))
            return false;
        memset(choices->sizes + before, 0, (needed - before) * sizeof *choices->sizes);
        choices->size_capacity = needed;
    }
    *count = count_from(choices, set, 0);
    return true;
}

bool tn_choices_first(const tn_choice_diagram *choices, tn_choice_set set, uint8_t *values)
{
    if (set == TN_CHOICE_NONE)
        return false;
    memset(values, 0, choices->fields);
    while (set > TN_CHOICE_ALL) {
        uint32_t field;
        const uint32_t *follow = node_of(choices, set, &field);
        while (follow[values[field]] == TN_CHOICE_NONE)
            values[field]++;
        set = follow[values[field]];
    }
    return true;
}

typedef struct listing {
    const tn_choice_diagram *choices;
    uint8_t *values;
    tn_choice_visit *visit;
    void *context;
} listing;

static bool list_from(const listing *l, tn_choice_set set, uint32_t field)
{
    if (set == TN_CHOICE_NONE)
        return true;
    if (field == l->choices->fields)
        return l->visit(l->context, l->values);
    for (uint32_t v = 0; v < l->choices->counts[field]; v++) {
        l->values[field] = (uint8_t)v;
        if (!list_from(l, tn_choices_follow(l->choices, set, field, v), field + 1))
            return false;
    }
    return true;
}

bool tn_choices_each(const tn_choice_diagram *choices, tn_choice_set set, tn_choice_visit *visit, void *context)
{
    uint8_t values[VALUES_MAX];
    listing l = {choices, values, visit, context};
    return choices->fields <= VALUES_MAX && list_from(&l, set, 0);
}

typedef struct boxing {
    const tn_choice_diagram *choices;
    uint64_t *mask;
    tn_choice_box_visit *visit;
    void *context;
} boxing;

static void set_bits(const boxing *b, uint32_t field, bool on)
{
    for (uint32_t bit = b->choices->starts[field]; bit < b->choices->starts[field + 1]; bit++)
        if (on)
            b->mask[bit / WORD_BITS] |= UINT64_C(1) << (bit % WORD_BITS);
        else
            b->mask[bit / WORD_BITS] &= ~(UINT64_C(1) << (bit % WORD_BITS));
}

/* The values of a field that the same follows are one box's. */
static bool box_from(const boxing *b, tn_choice_set set)
{
    if (set <= TN_CHOICE_ALL)
        return set == TN_CHOICE_NONE || b->visit(b->context, b->mask);
    uint32_t own = field_of(b->choices, set), start = b->choices->starts[own];
    for (uint32_t v = 0; v < b->choices->counts[own]; v++) {
        tn_choice_set follow = tn_choices_follow(b->choices, set, own, v);
        bool before = follow == TN_CHOICE_NONE;
        for (uint32_t u = 0; u < v && !before; u++)
            before = tn_choices_follow(b->choices, set, own, u) == follow;
        if (before)
            continue;
        set_bits(b, own, false);
        for (uint32_t u = v; u < b->choices->counts[own]; u++)
            if (tn_choices_follow(b->choices, set, own, u) == follow)
                b->mask[(start + u) / WORD_BITS] |= UINT64_C(1) << ((start + u) % WORD_BITS);
        bool goes_on = box_from(b, follow);
        set_bits(b, own, true);
        if (!goes_on)
            return false;
    }
    return true;
}

bool tn_choices_boxes(const tn_choice_diagram *choices, tn_choice_set set, tn_choice_box_visit *visit, void *context)
{
    size_t words = choices->starts[choices->fields] / WORD_BITS + 1;
    uint64_t *mask = calloc(words, sizeof *mask);
    boxing b = {choices, mask, visit, context};
    for (uint32_t f = 0; mask && f < choices->fields; f++)
        set_bits(&b, f, true);
    bool whole = mask && box_from(&b, set);
    free(mask);
    return whole;
}
