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

/* What a building model says besides the house. name: what the house is called. seed: what identifiers are made of,
 * besides the part's place in the house, so that a part keeps its own in the next version of the house. north: as
 * drawings have it, degrees clockwise from the back of the house. What may be NULL is left out then. */
typedef struct tn_ifc_said {
    const char *name, *project, *seed;
    const char *date, *author;                   /* or NULL; date: by ISO 8601, with the time of day */
    const double *north, *latitude, *longitude; /* or NULL; degrees */
} tn_ifc_said;

/* IFC4 as STEP text, in millimetres, or in feet if the form is: storeys, spaces (rooms), walls with openings, doors and
 * windows that fill these, posts as columns, decks as slabs, a roof, stairs and furniture, with types, properties,
 * materials and quantities. The same house has the same bytes. TN_MEMORY. */
tn_status tn_house_write_ifc(const tn_house *house, const tn_solids *solids, const tn_ifc_said *said, FILE *out,
                             tn_error *error);

#endif
