/* Parents that a person names, as text: "3 7*2 #41@0.4". A number is a place on the sheet, from 1; with # it is the id
 * of anybody who was ever born; *2 counts twice; @0.4 gives the children less of it. Free the list with
 * tn_choices_clear. */
#ifndef TARTAN_DRIVER_HAND_CHOICE_H
#define TARTAN_DRIVER_HAND_CHOICE_H

#include "runtime/genome/breeding/evolve.h"

#define TN_CHOICE_TURNS_MAX 100u /* how often one word may count */

typedef struct tn_choices {
    tn_chosen *items; /* owned; who counts twice is there twice */
    size_t count, capacity;
} tn_choices;

/* Reads a line into a list, which is emptied first. TN_INVALID where a word is no choice: `wrong` then holds it. */
tn_status tn_choices_read(const char *line, tn_choices *choices, char wrong[40], tn_error *error);
void tn_choices_clear(tn_choices *choices);

/* The text that reads back as the list, who counts twice written twice. The caller frees it; NULL where out of memory.
 */
char *tn_choices_text(const tn_chosen *items, size_t count);

/* Does the text name anybody by an id? */
bool tn_choices_have_ids(const char *text);

#endif
