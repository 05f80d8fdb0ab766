/* A rule of a text as the boxes of its picture, whose numbers are those of the tree's parts. */
#ifndef TARTAN_DRIVER_RULE_TREE_BOXES_H
#define TARTAN_DRIVER_RULE_TREE_BOXES_H

#include "compiler/plan/edit/rule_tree.h"
#include "runtime/plan/picture/rule_boxes.h"

/* Makes the boxes of a rule that the module was compiled of, from file number `file` of its sources. What the paper has
 * looks as tn_rule_boxes_read makes it of the module; calls, quantifiers, `every`, `implies` are frames around their
 * parts. TN_MEMORY. Clear the boxes in any case. */
tn_status tn_tree_boxes(const tn_rule_tree *tree, const tn_module *module, uint32_t file, tn_rule_boxes *boxes,
                        tn_error *error);

#endif
