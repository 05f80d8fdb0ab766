/* The rules that a question is about: those that it names, or those that the file itself holds. */
#ifndef TARTAN_ASK_CHOSEN_RULES_H
#define TARTAN_ASK_CHOSEN_RULES_H

#include "ask/session/session.h"

typedef struct tn_chosen_rules {
    uint32_t *indices; /* RULE records, in file order or as asked for */
    size_t count;      /* at least one */
    uint32_t schema;   /* which all of them are about */
} tn_chosen_rules;

/* TN_INVALID if there are none, or if they are about different trays, which is said. `otherwise` says what to do if the
 * file has no rules of its own. Clear them in any case. */
tn_status tn_session_rules(tn_session *session, const tn_texts *asked, const char *otherwise, tn_chosen_rules *chosen);
void tn_chosen_rules_clear(tn_chosen_rules *chosen);

#endif
