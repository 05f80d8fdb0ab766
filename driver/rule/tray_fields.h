/* What trays of a rule's text say of the fields of their schema, and what a click on a sign makes of it. */
#ifndef TARTAN_DRIVER_RULE_TRAY_FIELDS_H
#define TARTAN_DRIVER_RULE_TRAY_FIELDS_H

#include "compiler/plan/edit/rule_edit.h"
#include "runtime/plan/schema/schema.h"

/* The field that an item of a tray is about, or UINT32_MAX: a number of the tray, or a word that is not its schema's.
 */
uint32_t tn_item_field(const tn_schema *schema, const tn_ast_item *item);

/* Does the item begin with `not`? */
bool tn_item_denies(const tn_ast_item *item);

/* An item that asks for a value of a field, as its author would write it: "great", "machine dense 4'". whole_fill: of a
 * zone, whatever the depth. malloc; NULL: out of memory. */
char *tn_item_text(const tn_schema *schema, uint32_t field, uint32_t value, bool whole_fill);

/* The specifier that the tray at a place of a file became; UINT32_MAX if it became several, or none: words that a
 * quantifier binds say what it is. */
uint32_t tn_tray_spec(const tn_module *module, uint32_t file, tn_text_stretch place);

/* The same for one field of a schema: words for other fields may stand for several values, and the tray may become
 * others for schemas that are made from this one. */
uint32_t tn_tray_field_spec(const tn_schema *schema, uint32_t field, uint32_t file, tn_text_stretch place);

typedef enum tn_tray_sign { TN_SIGN_VALUE, TN_SIGN_DEPTH } tn_tray_sign;

/* A click on a sign of a tray: its next value, from any over each to any again; of a zone its next fill, or,
 * TN_SIGN_DEPTH, the next depth of its fill. *edit becomes the edit that does so, whose text, *text, is the caller's to
 * free(). TN_OK also if there is none, which `why` says. TN_MEMORY. */
tn_status tn_tray_step(const tn_schema *schema, const tn_rule_tree *tree, uint32_t part, uint32_t spec, uint32_t field,
                       tn_tray_sign sign, tn_rule_edit *edit, char **text, char why[TN_WHY_MAX], tn_error *error);

#endif
