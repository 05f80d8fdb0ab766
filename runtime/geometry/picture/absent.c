/* Pictures of meshes in a build without the part `draw`: there are none. */
#include "runtime/base/part.h"
#include "runtime/geometry/picture/draw_mesh.h"

tn_status tn_mesh_draw(const tn_mesh *mesh, const tn_mesh_picture *picture, tn_picture *to, tn_error *error)
{
    (void)mesh, (void)picture, (void)to;
    return tn_part_absent(TN_WITH_DRAW, "drawing a mesh", error);
}
