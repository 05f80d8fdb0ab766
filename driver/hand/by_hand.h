/* What a person does to a run by hand, as its events say it: sentences inserted, individuals edited, and taken out.
 *
 *   insert  "in place of 41: 12 7 104"  a genome becomes a member in the place of another
 *           "in the worst place: 12 7"  of the worst, where that is not known yet
 *           "where there is room: 12"
 *   edit    "in place of 41: 12 7 104"  the same, where the other is what it was made from
 *   remove  "41"
 */
#ifndef TARTAN_DRIVER_HAND_BY_HAND_H
#define TARTAN_DRIVER_HAND_BY_HAND_H

#include "runtime/genome/breeding/evolve.h"

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
