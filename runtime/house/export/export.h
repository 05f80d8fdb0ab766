/* Houses for other programs: meshes and building models (IFC). */
#ifndef TARTAN_HOUSE_EXPORT_H
#define TARTAN_HOUSE_EXPORT_H

#include <stdio.h>

#include "runtime/geometry/mesh.h"
#include "runtime/house/model/aspect.h"

/* The boundary of the house, closed and two-manifold, in triangles; metres, z up. Its groups are the kinds of parts
 * (tn_solid_kind), then the materials of the form; a face of a part that has a material is in that one's. Clear it in
 * any case. TN_MEMORY. */
tn_status tn_house_mesh(const tn_house *house, const tn_solids *solids, tn_mesh *mesh, tn_error *error);

/* Red, green and blue of each group. */
#define TN_HOUSE_GROUPS_MAX (TN_SOLID_COUNT + TN_MATERIALS_MAX)
void tn_house_mesh_colours(const tn_house_form *form, unsigned char colours[TN_HOUSE_GROUPS_MAX][3]);

/* IFC4 as STEP text, in millimetres: storeys, spaces (rooms), walls with openings, doors and windows that fill these,
 * posts as columns, decks as slabs, roofs, stairs and furniture, with materials and quantities. `name` is the house's.
 * Identifiers are hashes of the name, the house's line and the part, so that the same house has the same bytes.
 * TN_MEMORY. */
tn_status tn_house_write_ifc(const tn_house *house, const tn_solids *solids, const char *name, FILE *out,
                             tn_error *error);

#endif
