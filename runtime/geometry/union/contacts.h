/* How cells touch: pairs that share area. Their boxes do not overlap, so they share it on faces of boxes only.
 *
 * Faces are at the same place where they round to the same step of the union (union.h). A tn_contacts owns its array;
 * clear it in any case. */
#ifndef TARTAN_GEOMETRY_CONTACTS_H
#define TARTAN_GEOMETRY_CONTACTS_H

#include "runtime/base/error.h"
#include "runtime/geometry/union/cut_box.h"

typedef struct tn_contact {
    uint32_t a, b; /* cells; a < b */
    double area;
} tn_contact;

typedef struct tn_contacts {
    tn_contact *items;
    size_t count, capacity;
} tn_contacts;

/* Less area than this share of the squared diagonal of all cells is no contact. */
#define TN_CONTACT_LEAST 1e-12

/* Each pair once, in no order that means anything. `least`: the share of area that is a contact, TN_CONTACT_LEAST; with
 * 0 faces that touch along a line may be among them, as rounding has it. */
tn_status tn_contacts_find(const tn_cut_box *cells, size_t count, double least, tn_contacts *contacts, tn_error *error);
void tn_contacts_clear(tn_contacts *contacts);

#endif
