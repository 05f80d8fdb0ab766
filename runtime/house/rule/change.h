/* What may be changed about a house: each other value of one choice with which its library still keeps it.
 *
 * All other choices stay as they are where they still can. A change of the section or of a function can take away what
 * is in a face, or a tile: then the first that fits takes its place. New cells get the first function that they may
 * have.
 */
#ifndef TARTAN_HOUSE_CHANGE_H
#define TARTAN_HOUSE_CHANGE_H

#include "runtime/house/rule/asked.h"

typedef enum tn_change_kind { TN_CHANGE_SECTION, TN_CHANGE_FUNCTION, TN_CHANGE_FACE, TN_CHANGE_TILE } tn_change_kind;

/* of: a choice of the form, a cell, a face, a cell. from, to: values of the choice, functions, kinds, tiles that fit.
 */
typedef struct tn_house_change {
    tn_change_kind kind;
    uint32_t of;
    size_t from, to;
} tn_house_change;

/* Shown each change, and the house that it makes, which is gone afterwards. */
typedef tn_status tn_change_seen(void *context, const tn_house_change *change, const tn_house *changed,
                                 tn_error *error);

/* In the order of a house line. cell: only what is about this cell (TN_NO_CELL: all). library: NULL shows all changes,
 * whatever clauses say, and asks nothing of the rules. */
tn_status tn_house_changes(const tn_house *house, tn_house_rules *rules, const tn_house_library_record *library,
                           uint32_t cell, tn_change_seen *seen, void *context, tn_error *error);

#endif
