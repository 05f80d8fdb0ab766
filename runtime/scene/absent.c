/* Pictures of faces in space in a build without the part `draw`: there are none. */
#include "runtime/base/part.h"
#include "runtime/scene/apng.h"
#include "runtime/scene/draw_mesh.h"
#include "runtime/scene/draw_meshes.h"

tn_status tn_sight_new(size_t faces, size_t corners, bool groups, tn_sight *sight, tn_error *error)
{
    (void)faces, (void)corners, (void)groups;
    *sight = (tn_sight){0};
    return tn_part_absent(TN_WITH_DRAW, "drawing a surface", error);
}

tn_status tn_sight_of_mesh(const tn_mesh *mesh, tn_sight *sight, tn_error *error)
{
    (void)mesh;
    return tn_sight_new(0, 0, false, sight, error);
}

void tn_sight_clear(tn_sight *sight)
{
    (void)sight; /* always empty */
}

tn_status tn_view_take(tn_sight *sight, const tn_camera *camera, tn_view **view, tn_error *error)
{
    (void)sight, (void)camera;
    *view = NULL;
    return tn_part_absent(TN_WITH_DRAW, "drawing a surface", error);
}

void tn_view_free(tn_view *view)
{
    (void)view; /* always NULL */
}

uint32_t tn_view_by_depth(const tn_view *view)
{
    (void)view;
    return 0;
}

tn_status tn_views_draw(tn_view *const *views, size_t count, const tn_view_options *options, tn_picture *to,
                        tn_error *error)
{
    (void)views, (void)count, (void)options, (void)to;
    return tn_part_absent(TN_WITH_DRAW, "drawing a surface", error);
}

tn_status tn_mesh_draw(const tn_mesh *mesh, const tn_mesh_picture *picture, tn_picture *to, tn_error *error)
{
    (void)mesh, (void)picture, (void)to;
    return tn_part_absent(TN_WITH_DRAW, "drawing a mesh", error);
}

tn_status tn_meshes_draw(const tn_mesh *const *meshes, size_t count, const tn_meshes_picture *picture, tn_picture *to,
                         tn_error *error)
{
    (void)meshes, (void)count, (void)picture, (void)to;
    return tn_part_absent(TN_WITH_DRAW, "drawing a mesh", error);
}

tn_status tn_apng_write(const tn_picture *frames, size_t count, unsigned delay, FILE *out, tn_error *error)
{
    (void)frames, (void)count, (void)delay, (void)out;
    return tn_part_absent(TN_WITH_DRAW, "drawing a surface", error);
}
