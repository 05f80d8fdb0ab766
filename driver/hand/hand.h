/* What a person decides of a population, as text: the parents, and the individuals inserted, edited and taken out. */
#ifndef TARTAN_DRIVER_HAND_HAND_H
#define TARTAN_DRIVER_HAND_HAND_H

#include "runtime/genome/breeding/evolve.h"

/* Parents that a person names, as text: "3 7*2 #41@0.4". A number is a place on the sheet, from 1; with # it is the id
 * of anybody who was ever born; *2 counts twice; @0.4 gives the children less of it. Free the list with
 * tn_choices_clear. */

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

/* What a person does to a run by hand, as its events say it: sentences inserted, individuals edited, and taken out.
 *
 *   insert  "in place of 41: 12 7 104"  a genome becomes a member in the place of another
 *           "in the worst place: 12 7"  of the worst, where that is not known yet
 *           "where there is room: 12"
 *   edit    "in place of 41: 12 7 104"  the same, where the other is what it was made from
 *   remove  "41"
 */

bool tn_by_hand(const char *kind);

/* What sentences of a run are. */
typedef struct tn_by_hand_language {
    const tn_grammar *grammar; /* NULL: the run has none */
    const tn_evolution_settings *settings;
    bool rewrites; /* they are rewrite systems */
} tn_by_hand_language;

/* The genome of a sentence that a person wrote. Rewrite systems may be laid out as files are, with comments, and their
 * rules may stand behind their angles. TN_INVALID (E1222) with line 1 and the column of the sentence in one line, which
 * is *sentence then and whenever it is not NULL; the caller frees it. TN_INVALID (E1232) where there is no grammar. */
tn_status tn_by_hand_genome(const tn_by_hand_language *language, const char *text, size_t size, tn_genome *genome,
                            char **sentence, tn_error *error);

/* The text of an event. `out`: an id, or TN_NO_PARENT for the worst place. The caller frees it; NULL: out of memory. */
char *tn_by_hand_text(uint64_t out, const tn_genome *genome);

/* Does it. *said: what is to be stored, with the place that was found; the caller frees it. */
tn_status tn_by_hand_do(tn_evolution *evolution, const char *kind, const char *text, char **said, tn_error *error);

#endif
