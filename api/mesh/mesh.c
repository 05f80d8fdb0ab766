/* The C interface to meshes as files, and to what is done to them: smoothing, subdividing, decimating. */
#include <stdlib.h>
#include <string.h>

#include "api/geometry/mesh.h"
#include "runtime/base/array.h"
#include "runtime/base/watch.h"
#include "runtime/geometry/write.h"
#include "runtime/mesh/openmesh.h"

tartan_status tartan_mesh_read(const char *path, tartan_mesh **mesh, tartan_error *error)
{
    tn_mesh made;
    tn_error found;
    if (!path)
        return tn_api_missing(error, "path");
    return tn_openmesh_read(path, &made, &found) == TN_OK ? tn_api_mesh(&made, mesh, error)
                                                          : tn_api_fail(&found, error);
}

static tartan_status done(tn_status status, const tn_error *found, tartan_error *error)
{
    return status == TN_OK ? TARTAN_OK : tn_api_fail(found, error);
}

tartan_status tartan_mesh_smooth(tartan_mesh *mesh, uint32_t rounds, tartan_error *error)
{
    tn_error found;
    return mesh ? done(tn_openmesh_smooth(&mesh->mesh, rounds, &found), &found, error) : tn_api_missing(error, "mesh");
}

tartan_status tartan_mesh_subdivide(tartan_mesh *mesh, uint32_t rounds, tartan_error *error)
{
    tn_error found;
    return mesh ? done(tn_openmesh_subdivide(&mesh->mesh, rounds, &found), &found, error)
                : tn_api_missing(error, "mesh");
}

tartan_status tartan_mesh_decimate(tartan_mesh *mesh, size_t faces, tartan_error *error)
{
    tn_error found;
    return mesh ? done(tn_openmesh_decimate(&mesh->mesh, faces, &found), &found, error) : tn_api_missing(error, "mesh");
}

/* ---- writing */

typedef tn_status writer(const tn_mesh *mesh, const tn_mesh_style *style, FILE *out, tn_error *error);

/* A file in memory that takes no more once its watch says so. */
typedef struct memory {
    char *bytes;
    size_t size, capacity;
    bool full; /* out of memory */
    tn_watch *watch;
} memory;

static ssize_t take(void *cookie, const char *bytes, size_t size)
{
    memory *m = cookie;
    tn_watch_tell(m->watch, (double)m->size, 0);
    if (tn_watch_stopped(m->watch))
        return 0;
    if (!tn_array_reserve(&m->bytes, &m->capacity, m->size, size, 1)) {
        m->full = true;
        return 0;
    }
    memcpy(m->bytes + m->size, bytes, size);
    m->size += size;
    return (ssize_t)size;
}

static tn_status write_to_memory(const tn_mesh *mesh, const tn_mesh_style *style, writer *write, tn_watch *watch,
                                 unsigned char **bytes, size_t *size, tn_error *error)
{
    memory m = {.watch = watch};
    FILE *out = fopencookie(&m, "w", (cookie_io_functions_t){.write = take});
    if (!out)
        return tn_fail_memory(error);
    tn_status status = write(mesh, style, out, error);
    bool failed = ferror(out) != 0;
    failed |= fclose(out) != 0;
    if (status == TN_OK && failed)
        status = m.full || !tn_watch_stopped(watch) ? tn_fail_memory(error) : tn_fail_stopped(watch, error);
    if (status == TN_OK) {
        *bytes = (unsigned char *)m.bytes;
        *size = m.size;
    } else {
        free(m.bytes);
    }
    return status;
}

/* GLB and STL hold triangles only. */
static tn_status write_triangles(const tn_mesh *mesh, const tn_mesh_style *style, bool glb, tn_watch *watch,
                                 unsigned char **bytes, size_t *size, tn_error *error)
{
    tn_mesh cut;
    tn_status status = tn_mesh_copy(mesh, &cut, error);
    if (status == TN_OK)
        status = tn_mesh_triangulate(&cut, error);
    if (status == TN_OK)
        status = glb ? write_to_memory(&cut, style, tn_mesh_write_glb, watch, bytes, size, error)
                     : tn_openmesh_write(&cut, TN_FILE_STL, style->y_up, bytes, size, error);
    tn_mesh_clear(&cut);
    return status;
}

static tn_status write_mesh(const tn_mesh *mesh, tartan_mesh_format format, const tn_mesh_style *style, tn_watch *watch,
                            unsigned char **bytes, size_t *size, tn_error *error)
{
    if (tn_watch_stopped(watch))
        return tn_fail_stopped(watch, error);
    switch (format) {
    case TARTAN_OBJ:
        return write_to_memory(mesh, style, tn_mesh_write_obj, watch, bytes, size, error);
    case TARTAN_PLY:
        return write_to_memory(mesh, style, tn_mesh_write_ply, watch, bytes, size, error);
    case TARTAN_DXF:
        return write_to_memory(mesh, style, tn_mesh_write_dxf, watch, bytes, size, error);
    case TARTAN_GLB:
    case TARTAN_STL:
        return write_triangles(mesh, style, format == TARTAN_GLB, watch, bytes, size, error);
    case TARTAN_OFF:
        return tn_openmesh_write(mesh, TN_FILE_OFF, style->y_up, bytes, size, error);
    case TARTAN_OM:
        return tn_openmesh_write(mesh, TN_FILE_OM, style->y_up, bytes, size, error);
    }
    return tn_fail(error, TN_INVALID, TN_CODE_NONE, "there is no mesh format %d", (int)format);
}

tartan_status tartan_mesh_write(const tartan_mesh *mesh, tartan_mesh_format format, const tartan_mesh_style *given,
                                const tartan_watch *waiting, void **bytes, size_t *size, tartan_error *error)
{
    tartan_mesh_style style;
    tn_watch watch;
    unsigned char *made;
    size_t made_size;
    tn_error found;
    if (!mesh || !bytes || !size)
        return tn_api_missing(error, mesh ? "room for the file" : "mesh");
    tartan_status status = TN_API_TAKE(tartan_mesh_style, &style, given, error);
    if (status == TARTAN_OK)
        status = tn_api_watch(waiting, &watch, error);
    if (status != TARTAN_OK)
        return status;
    if (format == TARTAN_DXF && !mesh->mesh.lines)
        return tn_api_refuse(error, TARTAN_INVALID, "a DXF holds lines, and the mesh has none");
    const tn_mesh_style own = {.notes = &style.note,
                               .note_count = style.note != NULL,
                               .normals = style.normals,
                               .y_up = style.y_up,
                               .unit = mesh->unit};
    if (write_mesh(&mesh->mesh, format, &own, &watch, &made, &made_size, &found) != TN_OK)
        return tn_api_fail(&found, error);
    *bytes = made;
    *size = made_size;
    return TARTAN_OK;
}
