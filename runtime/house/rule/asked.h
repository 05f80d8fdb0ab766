/* Rules on one house: the interpreter of rules (runtime/plan/match/vm.h) over the house's cells, rooms and faces.
 *
 * A tn_house_rules belongs to one thread and borrows the form. It keeps its memory from house to house.
 */
#ifndef TARTAN_HOUSE_RULE_ASKED_H
#define TARTAN_HOUSE_RULE_ASKED_H

#include "runtime/house/house_names.h"
#include "runtime/house/measure/measure.h"

typedef struct tn_house_rules tn_house_rules;

/* max_length: of a plan, in trays (0: TN_VM_LENGTH_DEFAULT). */
tn_status tn_house_rules_new(const tn_house_form *form, size_t max_length, tn_house_rules **rules, tn_error *error);
void tn_house_rules_free(tn_house_rules *rules);

/* From the next house on, what the instructions at these code offsets make is empty, for coverage (borrowed). */
void tn_house_rules_disable(tn_house_rules *rules, const uint32_t *offsets, size_t count);

/* Starts on a house whose functions and faces are known (borrowed); forgets what was found for the one before. */
tn_status tn_house_rules_start(tn_house_rules *rules, const tn_house *house, tn_error *error);

/* Do two cells that are so, in any order, share the face, and has it one of the kinds? */
bool tn_face_meets(const tn_house *house, const tn_meeting_record *meeting, const tn_face *face);

/* Is the kind one of those that are asked for? */
bool tn_meeting_has(const tn_module *module, const tn_meeting_record *meeting, uint32_t kind);

/* Can one walk from a cell to one beside it through such a face? */
bool tn_walk_goes_through(const tn_house_form *form, const tn_meeting_record *walk, uint32_t kind);

/* Can one walk through the face, by `apart`? Never into a void; up and down by stairs alone. */
bool tn_house_is_step(const tn_house *house, const tn_meeting_record *walk, const tn_face *face);

/* H on the whole house, for a function of kind HOLDS. */
tn_status tn_house_rules_hold(tn_house_rules *rules, uint32_t function, bool *holds, tn_error *error);

/* What a number of a house is worth: so much; nothing, as some cell has no walk; or less or more than all numbers, as
 * there is no cell whose walk would be the longest, or the shortest. */
typedef enum tn_worth { TN_HAS_WORTH, TN_NO_WORTH, TN_BELOW_ALL, TN_ABOVE_ALL } tn_worth;

/* The value of a measure on the house, in nanometres to its power, without what it adds up of costs. cost: what it has
 * of these, in parts of the house's cost. Both are initialised. */
tn_status tn_house_rules_measure(tn_house_rules *rules, tn_house_measured measure, mpq_t value, mpq_t cost,
                                 tn_worth *worth, tn_error *error);

/* The number that a HOUSE_SUM record compares with 0, with its constant, in nanometres to its power; *costs: is what
 * the house costs part of it? `value` is initialised. */
tn_status tn_house_rules_sum(tn_house_rules *rules, uint32_t sum, mpq_t value, tn_worth *worth, bool *costs,
                             tn_error *error);

/* What the house costs, unrounded, into `cost`, which is initialised. TN_INVALID (E1649) where that depends on tiles
 * that its line leaves out. */
tn_status tn_house_rules_cost(tn_house_rules *rules, mpq_t cost, tn_error *error);

/* What the house costs, where the caller knows it: it is not worked out then. Good until the next house. */
void tn_house_rules_price(tn_house_rules *rules, const mpq_t cost);

/* Does clause `clause` (of the library) keep the house out? */
tn_status tn_house_rules_drop(tn_house_rules *rules, const tn_house_library_record *library, uint32_t clause,
                              bool *drops, tn_error *error);

/* Is the house kept by all clauses? */
tn_status tn_house_rules_keep(tn_house_rules *rules, const tn_house_library_record *library, bool *kept,
                              tn_error *error);

#endif
