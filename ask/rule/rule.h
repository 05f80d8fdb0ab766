/* What the questions about a rule's picture share: the rule of the file's own text, with its schema. */
#ifndef TARTAN_ASK_RULE_RULE_H
#define TARTAN_ASK_RULE_RULE_H

#include "ask/session/session.h"
#include "compiler/plan/edit/rule_tree.h"
#include "runtime/plan/schema/schema.h"

/* A rule that is asked about. */
typedef struct tn_asked_rule {
    tn_rule_text text;
    tn_rule_tree tree;
    tn_schema *schema;   /* of its trays */
    uint32_t rule;       /* its RULE record; TN_NO_RECORD: a rule with parameters, or one about houses */
    tn_sources *sources; /* the session's: the text is the first */
} tn_asked_rule;

/* Reads the text of the file, as far as it is a rule file of plans; fails otherwise, which is said. Clear in any case.
 */
tn_status tn_asked_rule_read(tn_session *session, tn_asked_rule *asked);

/* Reads the rule of this name, or, if that is NULL, the one at a place, in UTF-16 units from the text's beginning. */
tn_status tn_asked_rule_find(tn_session *session, const char *name, uint64_t at, tn_asked_rule *asked);
void tn_asked_rule_clear(tn_asked_rule *asked);

/* The byte at a place in UTF-16 units from the text's beginning. */
size_t tn_text_byte(const tn_rule_text *text, uint64_t utf16);

#endif
