/* A label for each of some combinations of choices, as a decision diagram with many terminals (MTMDD; Srinivasan, Kam,
 * Malik, Brayton 1990).
 *
 * The combinations that have a label are numbered in their order, the first field most significant; how many there are
 * does not matter, only how entangled the fields are. A node is of one field and has for each of its values the node
 * of the next field, or a label if it is the last field's. It knows how often each label stands below it, so that
 * combinations and numbers are found from one another in one way down.
 *
 * Labels are numbered by their first combinations. Equal labellings have equal nodes in equal order.
 *
 * Immutable once made, and then shared between threads; the owner frees it with tn_labelling_free. What makes one
 * returns TN_LIMIT where it has more nodes or combinations than there is room for, or TN_MEMORY. */
#ifndef TARTAN_CHOICES_LABELLING_H
#define TARTAN_CHOICES_LABELLING_H

#include "runtime/automata/numbering.h"
#include "runtime/base/error.h"
#include "runtime/choices/choices.h"

#define TN_UNLABELLED UINT32_MAX
#define TN_LABELLED_MAX (TN_UNLABELLED - 1) /* combinations that have a label */

/* Of a labelling: words of its nodes, and labels below each of them, so at most some 200 MB. */
#define TN_LABELLING_ROOM (UINT32_C(1) << 23)

/* How many combinations of some have a label. */
typedef struct tn_label_count {
    uint32_t label, count;
} tn_label_count;

typedef struct tn_labelling {
    uint32_t fields;
    uint32_t *values;      /* [fields]: how many values a field has */
    tn_interner nodes;     /* a node is its field and what follows each value; what follows comes before it */
    uint32_t root;         /* TN_UNLABELLED: no combination has a label */
    uint32_t labels;       /* 0 to labels - 1 */
    uint32_t count;        /* combinations that have one */
    size_t *below_first;   /* [nodes + 1] */
    tn_label_count *below; /* of node n: [below_first[n], below_first[n + 1]), the labels below it, ascending */
    uint32_t *sizes;       /* [nodes]: combinations below it */
    uint32_t *first;       /* [labels]: the number of a label's first combination */
} tn_labelling;

/* What follows each value of a node's field. */
static inline const uint32_t *tn_labelling_follow(const tn_labelling *labelling, uint32_t node)
{
    size_t size;
    return tn_interned(&labelling->nodes, node, &size) + 1;
}

/* How many combinations have a label. */
static inline uint32_t tn_labelling_size(const tn_labelling *labelling, uint32_t label)
{
    return labelling->below[labelling->below_first[labelling->root] + label].count;
}

/* The combinations of a set, which is not lost, have the label 0. */
tn_status tn_labelling_of_set(const tn_choice_diagram *choices, tn_choice_set set, tn_labelling **out);

/* Of all combinations of so many values: the label 1 where each field has a value whose bit is set in the mask (as of
 * tn_choices_box), else 0. Its labels are not in order, and it is there to be joined with. */
tn_status tn_labelling_of_box(const uint32_t *values, uint32_t fields, const uint64_t *mask, tn_labelling **out);

/* The same: combinations have the labels that the values of one field have. */
tn_status tn_labelling_of_field(const uint32_t *values, uint32_t fields, uint32_t field, const uint32_t *labels,
                                tn_labelling **out);

/* A label for each two that a combination has in `a` and `b`. kinds, or NULL: of each label of b, as which label it
 * is taken. */
tn_status tn_labelling_join(const tn_labelling *a, const tn_labelling *b, const uint32_t *kinds, tn_labelling **out);

void tn_labelling_free(tn_labelling *labelling);

/* The combination of a number below the count: its label, and its values in `values` unless that is NULL. */
uint32_t tn_labelling_at(const tn_labelling *labelling, uint32_t number, uint8_t *values);

/* The number of a combination, or TN_UNLABELLED if it has no label. */
uint32_t tn_labelling_number(const tn_labelling *labelling, const uint8_t *values);

/* Finds a number: stretches of combinations that follow one another are offered by how many of each label are among
 * them. One that is not passed over is offered again in parts. The number is that of the first that is not passed; if
 * all are, the count. */
typedef bool tn_labelling_pass(void *context, const tn_label_count *counts, size_t count);
uint32_t tn_labelling_find(const tn_labelling *labelling, tn_labelling_pass *pass, void *context);

/* Adds up the combinations whose numbers are lower than a number, in such stretches. */
typedef void tn_labelling_add(void *context, const tn_label_count *counts, size_t count);
void tn_labelling_before(const tn_labelling *labelling, uint32_t number, tn_labelling_add *add, void *context);

/* The first number from `from` on that has a label that is wanted; if none has, the count. */
typedef bool tn_labelling_wanted(void *context, uint32_t label);
uint32_t tn_labelling_next(const tn_labelling *labelling, uint32_t from, tn_labelling_wanted *wanted, void *context);

#endif
