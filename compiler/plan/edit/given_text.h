/* Texts that somebody gives to be put into a rule: what each has to be, told before it is put there. */
#ifndef TARTAN_COMPILER_PLAN_EDIT_GIVEN_TEXT_H
#define TARTAN_COMPILER_PLAN_EDIT_GIVEN_TEXT_H

#include "compiler/plan/edit/rule_tree.h"

#define TN_WHY_MAX 400u
#define TN_GIVEN_TEXT_MAX 100000u /* bytes */

typedef enum tn_given_kind {
    TN_GIVEN_PART,      /* of a rule: `tray(great)` */
    TN_GIVEN_ITEM,      /* of a tray: `machine dense 4'` */
    TN_GIVEN_CONDITION, /* on a number: `n > 1` */
    TN_GIVEN_NAME,      /* of a new rule */
} tn_given_kind;

/* Is the text that? Otherwise `why` says what is wrong with it. *binds, of a part: how tightly it holds together.
 * TN_MEMORY, TN_LIMIT. */
tn_status tn_given_text_check(tn_given_kind kind, const char *text, tn_binding *binds, char why[TN_WHY_MAX],
                              tn_error *error);

#endif
