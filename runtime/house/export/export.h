/* Houses for other programs: meshes and building models (IFC). */
#ifndef TARTAN_HOUSE_EXPORT_H
#define TARTAN_HOUSE_EXPORT_H

#include <stdio.h>

#include "runtime/geometry/mesh_model.h"
#include "runtime/house/model/aspect.h"
#include "runtime/house/model/model.h"

/* The boundary of the house, closed and two-manifold, in triangles; metres, z up. Its groups are the kinds of parts
 * (tn_solid_kind), then the materials of the form; a face of a part that has a material is in that one's. Clear it in
 * any case. TN_MEMORY. */
tn_status tn_house_mesh(const tn_house *house, const tn_solids *solids, tn_mesh *mesh, tn_error *error);

/* Red, green and blue of each group. */
#define TN_HOUSE_GROUPS_MAX (TN_SOLID_COUNT + TN_MATERIALS_MAX)
void tn_house_mesh_colours(const tn_house_form *form, unsigned char colours[TN_HOUSE_GROUPS_MAX][3]);

/* The blocks of a house, with these groups. Clear them in any case. TN_MEMORY. */
tn_status tn_house_blocks(const tn_house *house, const tn_solids *solids, tn_blocks *blocks, tn_error *error);

/* The same mesh as a tree of parts: below the house its storeys and its roof; below a storey what belongs to it (decks,
 * posts, and what stands between two rooms) and its rooms, "0.01-kitchen"; below a room its walls, each of its windows
 * and doors and what stands in it. Panes, and leaves that are glazed, are glass, which is seen through.
 * If the house's line is given, facts are said: of the house the line, areas in square metres and, if materials have prices, costs; of a room its function,
 * number and areas. Clear both in any case. TN_MEMORY. */
tn_status tn_house_model(const tn_house *house, const tn_solids *solids, const char *name, const char *line,
                         tn_mesh *mesh, tn_mesh_model *model, tn_error *error);

/* What a building model says besides the house. name: what the house is called. seed: what identifiers are made of,
 * besides the part's place in the house, so that a part keeps its own in the next version of the house. north: as
 * drawings have it, degrees clockwise from the back of the house. What may be NULL is left out then. */
typedef struct tn_ifc_said {
    const char *name, *project, *seed;
    const char *date, *author;                  /* or NULL; date: by ISO 8601, with the time of day */
    const double *north, *latitude, *longitude; /* or NULL; degrees */
} tn_ifc_said;

/* IFC4 as STEP text, in millimetres, or in feet if the form is: storeys, spaces (rooms), walls with openings, doors and
 * windows that fill these, posts as columns, decks as slabs, a roof, stairs and furniture, with types, properties,
 * materials and quantities. The same house has the same bytes. TN_MEMORY. */
tn_status tn_house_write_ifc(const tn_house *house, const tn_solids *solids, const tn_ifc_said *said, FILE *out,
                             tn_error *error);

#endif
