/* The rules that a question is about: those that it names, or those that the file itself holds; and what they say of
 * houses. */
#ifndef TARTAN_ASK_PLAN_MATCH_H
#define TARTAN_ASK_PLAN_MATCH_H

#include "ask/session/session.h"
#include "driver/house/judge.h"

typedef struct tn_chosen_rules {
    uint32_t *indices; /* RULE records, in file order or as asked for */
    size_t count;      /* at least one */
    uint32_t schema;   /* which all of them are about */
} tn_chosen_rules;

/* TN_INVALID if there are none, or if they are about different trays, which is said. `otherwise` says what to do if the
 * file has no rules of its own. Clear them in any case. */
tn_status tn_session_rules(tn_session *session, const tn_texts *asked, const char *otherwise, tn_chosen_rules *chosen);
void tn_chosen_rules_clear(tn_chosen_rules *chosen);

/* ---- rules about houses */

/* A rule that houses are matched by: about them, or about their plans. */
typedef struct tn_house_matching_rule {
    const char *name;
    uint32_t holds;
} tn_house_matching_rule;

typedef struct tn_house_matching {
    tn_session *session;
    tn_house_matching_rule *rules;
    size_t count;
    uint32_t form;
    size_t max_length;
    tn_house_judge judge;
} tn_house_matching;

/* Do these rules (none: those of the file itself) ask for houses, so that houses are what is matched? */
bool tn_session_matches_houses(const tn_session *session, const tn_texts *rules);

/* Chooses them and makes them ready. What is wrong is said. Close it in any case. */
tn_status tn_house_matching_open(tn_session *session, const tn_texts *rules, size_t max_length,
                                 tn_house_matching *matching);
void tn_house_matching_close(tn_house_matching *matching);

/* What each rule says of the house of a line: holds[rule]. */
tn_status tn_house_match(tn_house_matching *matching, const char *line, bool *holds, tn_error *error);

#endif
