/* Sets of combinations of choices, one choice from each field, as decision diagrams: trays are such combinations.
 *
 * A set is a number that stands for a node: a field, and for each of its values the set of what may follow. Equal sets
 * have one number, and a field that does not matter has no node. So the work is about how entangled the fields are, not
 * about how many combinations there are.
 *
 * Fields come in their order, the first decides first. What does not fit into the limit of nodes, or into memory, makes
 * TN_CHOICE_LOST, and so does all that is made of it: it is enough to look at the end.
 *
 * The owner frees a tn_choice_diagram with tn_choices_free; it is used by one thread. */
#ifndef TARTAN_CHOICES_CHOICES_H
#define TARTAN_CHOICES_CHOICES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef uint32_t tn_choice_set;
enum { TN_CHOICE_NONE = 0, TN_CHOICE_ALL = 1 }; /* no combination, and all of them */
#define TN_CHOICE_LOST UINT32_MAX
enum { TN_CHOICE_VALUES_MAX = 256 }; /* of a field */

/* Of a diagram: words of its nodes and pairs that were joined, so at most some 200 MB. */
#define TN_CHOICES_ROOM (UINT32_C(1) << 23)

typedef struct tn_choice_diagram tn_choice_diagram;

/* counts: how many values each field has, at least one. NULL: out of memory. */
tn_choice_diagram *tn_choices_new(const uint32_t *counts, uint32_t fields, uint32_t room);
void tn_choices_free(tn_choice_diagram *choices);

uint32_t tn_choices_fields(const tn_choice_diagram *choices);
uint32_t tn_choices_values(const tn_choice_diagram *choices, uint32_t field);

/* Is it for want of room, and not of memory, that sets were lost? */
bool tn_choices_full(const tn_choice_diagram *choices);

/* What may follow a value of a field in a set that begins with this field, or a later one. */
tn_choice_set tn_choices_follow(const tn_choice_diagram *choices, tn_choice_set set, uint32_t field, uint32_t value);

/* Each field has one of the values whose bits are set; the fields' bits follow one another. */
tn_choice_set tn_choices_box(tn_choice_diagram *choices, const uint64_t *mask);

/* A set by what may follow each value of a field: sets of later fields alone. */
tn_choice_set tn_choices_node(tn_choice_diagram *choices, uint32_t field, const tn_choice_set *follow);

tn_choice_set tn_choices_not(tn_choice_diagram *choices, tn_choice_set set);
tn_choice_set tn_choices_and(tn_choice_diagram *choices, tn_choice_set a, tn_choice_set b);
tn_choice_set tn_choices_or(tn_choice_diagram *choices, tn_choice_set a, tn_choice_set b);

/* What is in any of the sets, joined two by two. The array is used up. */
tn_choice_set tn_choices_any_of(tn_choice_diagram *choices, tn_choice_set *sets, size_t count);

/* How many combinations there are; UINT64_MAX: that or more. The set is not lost. false: out of memory. */
bool tn_choices_count(tn_choice_diagram *choices, tn_choice_set set, uint64_t *count);

/* The first combination, a value of each field; false: there is none. */
bool tn_choices_first(const tn_choice_diagram *choices, tn_choice_set set, uint8_t *values);

/* All combinations in order, until the function returns false. */
typedef bool tn_choice_visit(void *context, const uint8_t *values);
bool tn_choices_each(const tn_choice_diagram *choices, tn_choice_set set, tn_choice_visit *visit, void *context);

/* The set as boxes that share no combination, each as the mask of one: until the function returns false. Also false
 * where out of memory, before the first. */
typedef bool tn_choice_box_visit(void *context, const uint64_t *mask);
bool tn_choices_boxes(const tn_choice_diagram *choices, tn_choice_set set, tn_choice_box_visit *visit, void *context);

#endif
