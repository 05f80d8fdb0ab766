/* Answers of clauses that ask for functions, kept by what they can tell apart. Internal to runtime/house/variant.
 *
 * A clause sees the function of a cell only through decisions on cells (functions of kind CELL). Functions of one cell
 * on which all its decisions agree are one class; the answer is kept for each combination of classes, so that a clause
 * is run once for each of these and not once for each house. Where there are more than TN_MEMO_ANSWERS_MAX combinations
 * it is run each time.
 */
#ifndef TARTAN_HOUSE_MEMO_H
#define TARTAN_HOUSE_MEMO_H

#include "runtime/house/variant/parts.h"
#include "runtime/module/code.h"

#define TN_MEMO_ANSWERS_MAX ((size_t)1 << 20)

/* Marks the functions that an instruction names. */
void tn_mark_operands(const tn_module *module, const tn_instruction *op, bool *reached);

/* Finds what the library's clauses ask, once for all houses. Free the memos in any case. */
tn_status tn_memos_begin(tn_house_variants *v, tn_error *error);

/* Makes the memos of all clauses that are asked with the functions, empty, for the wheels of the house at hand. */
tn_status tn_memos_make(tn_house_variants *v, tn_error *error);
void tn_memos_free(tn_house_variants *v);

/* Where the clause's answer to the functions at hand is kept; NULL where it is not. 0: it is not known yet. */
uint8_t *tn_memo_answer(const tn_house_variants *v, uint32_t clause);
enum { TN_MEMO_UNKNOWN, TN_MEMO_KEEPS, TN_MEMO_DROPS };

/* The wheels of functions from here on are none that the clause looks at: turning them does not change the answer. */
size_t tn_memo_end(const tn_house_variants *v, uint32_t clause);

#endif
