/* Changes of a rule's text, which are made together: each is worked out on the text as it was. */
#ifndef TARTAN_COMPILER_PLAN_EDIT_TEXT_CHANGES_H
#define TARTAN_COMPILER_PLAN_EDIT_TEXT_CHANGES_H

#include "compiler/plan/edit/rule_tree.h"
#include "runtime/base/buffer.h"

enum { TN_TEXT_CHANGES_MAX = 8 };

/* Bytes [begin, end) become `insert`. */
typedef struct tn_text_change {
    uint32_t begin, end;
    char *insert;        /* owned by the list */
    tn_text_stretch put; /* of it: what somebody puts there, which is asked about afterwards; or empty */
} tn_text_change;

/* Starts as zeros. Changes do not overlap; those at one place are made in the order in which they were added. */
typedef struct tn_text_changes {
    tn_text_change items[TN_TEXT_CHANGES_MAX];
    size_t count;
    tn_text_stretch moved; /* what is taken away there has been put elsewhere, with its comments */
    bool failed;           /* there was no memory for one */
} tn_text_changes;

/* Adds one, whose text is copied. */
void tn_text_change_add(tn_text_changes *changes, tn_text_stretch replaced, const char *insert, tn_text_stretch put);
void tn_text_changes_clear(tn_text_changes *changes);

/* Makes the changes. Comments of what is taken away move before the rule. *text is the caller's to free(). */
tn_status tn_text_changes_make(const tn_text_changes *changes, const tn_rule_tree *tree, tn_buffer *text,
                               tn_error *error);

/* Where what stood at a stretch is in the changed text, with what was put at either end of it. */
tn_text_stretch tn_text_changes_map(const tn_text_changes *changes, const tn_rule_tree *tree, tn_text_stretch stretch);

/* Where a stretch that no change touches is, without what was put at either end of it. */
tn_text_stretch tn_text_changes_shift(const tn_text_changes *changes, const tn_rule_tree *tree,
                                      tn_text_stretch stretch);

/* Where what somebody put there is; false if no change has such. */
bool tn_text_changes_put(const tn_text_changes *changes, const tn_rule_tree *tree, tn_text_stretch *put);

#endif
