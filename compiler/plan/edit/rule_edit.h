/* Edits of a rule as a picture has them: boxes dropped on parts, parts dragged to others, items of trays set. Each is a
 * change of the text, so that comments and layout stay, and undoing it gives the old bytes.
 *
 * What is made parses, and is the rule that the same edit of the tree alone would make: parentheses are put where the
 * place needs them. Whether the rule makes sense is the checker's to say. */
#ifndef TARTAN_COMPILER_PLAN_EDIT_RULE_EDIT_H
#define TARTAN_COMPILER_PLAN_EDIT_RULE_EDIT_H

#include "compiler/plan/edit/given_text.h"

typedef enum tn_rule_operation {
    TN_RULE_SET,       /* item `item` of the tray becomes `text` */
    TN_RULE_CLEAR,     /* item `item` of the tray goes; a tray of no items is `any` */
    TN_RULE_ADD,       /* `text` is one more item of the tray, or of `any`: it becomes item `item` */
    TN_RULE_WRAP,      /* a box `by` around the part */
    TN_RULE_UNWRAP,    /* the box goes, its part `at` stays */
    TN_RULE_JOIN,      /* `by` and the part stand beside `with` */
    TN_RULE_INSERT,    /* `with` becomes part `at`: of a row one more, of what has places that one */
    TN_RULE_REMOVE,    /* the part goes; a place that needs one has `any` */
    TN_RULE_CONDITION, /* of what is counted */
    TN_RULE_TEXT,      /* the part becomes `text` */
    TN_RULE_OPERATIONS
} tn_rule_operation;

/* One edit. `with` is `text`, or, if `from` is a part of the rule, this part: it is moved. */
typedef struct tn_rule_edit {
    tn_rule_operation operation;
    uint32_t part;
    uint32_t item; /* past the last: behind it */
    uint32_t at;   /* TN_NO_RULE_PART: the last, or behind it */
    uint32_t from; /* TN_NO_RULE_PART: `text` */
    const char *text;
    const char *by; /* wrap: not, symmetric, many, quantity ...; join: and, or */
    bool before;    /* join: `with` comes first */
} tn_rule_edit;

/* What an edit makes. */
typedef struct tn_rule_edited {
    char why[TN_WHY_MAX];    /* it cannot be made, and nothing else is said: why; or empty */
    tn_text_stretch changed; /* bytes of the old text that become `insert` */
    char *insert;
    char *text; /* the changed text */
    size_t size;
    uint32_t part; /* of the changed rule, what the edit was about */
} tn_rule_edited;

/* Makes the edit of a rule of a text. TN_OK also if it cannot be made, which `why` says; TN_MEMORY, TN_LIMIT. Clear in
 * any case. */
tn_status tn_rule_edit_make(const char *text, size_t size, const char *rule, const tn_rule_edit *edit,
                            tn_rule_edited *made, tn_error *error);

/* Adds `rule NAME = any` behind the item of the file that the byte is in; behind a rule that names its schema, about
 * the same trays. */
tn_status tn_rule_new_make(const char *text, size_t size, const char *name, size_t offset, tn_rule_edited *made,
                           tn_error *error);

void tn_rule_edited_clear(tn_rule_edited *made);

/* The boxes that `wrap` knows, in the order in which they are offered; NULL ends them. */
extern const char *const tn_rule_wraps[];

#endif
