/* Sections that nothing tells apart: with them, a plan has as many houses. Internal to runtime/house/count.
 *
 * How many houses a section has depends on how many storeys its zones have, on the roofs of zones that may be lower
 * than others, which openings may have before them, and on what code asks of its choices, but for what `forbid` asks.
 * Other roofs and claddings that nobody asks for are multiplied.
 */
#ifndef TARTAN_HOUSE_COUNT_SECTION_H
#define TARTAN_HOUSE_COUNT_SECTION_H

#include "runtime/house/house.h"

enum { TN_SECTION_QUESTIONS_MAX = 64 };

typedef struct tn_section_key {
    uint64_t answers;
    uint32_t shapes[TN_CHOICES_MAX]; /* of storeys, and of roofs what openings can tell of them */
} tn_section_key;

typedef struct tn_sections {
    int64_t questions[TN_SECTION_QUESTIONS_MAX]; /* operands of CHOSEN */
    size_t question_count;
    bool apart; /* there are more: each section is by itself */
} tn_sections;

/* Finds the questions of a form and its rules. TN_MEMORY. */
tn_status tn_sections_begin(const tn_house_form *form, tn_sections *sections, tn_error *error);
tn_section_key tn_sections_key(const tn_sections *sections, const tn_house *house); /* only its section is looked at */

#endif
