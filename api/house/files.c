/* The C interface to a house as a mesh, and as files in memory. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "api/geometry/mesh.h"
#include "api/house/house.h"
#include "driver/house/files.h"
#include "runtime/house/export/export.h"

tartan_status tartan_house_mesh(const tartan_house *house, const tartan_watch *watch, tartan_mesh **mesh,
                                tartan_error *error)
{
    tn_mesh made = {0};
    tn_solids solids = {0};
    tn_error found;
    if (!house || !mesh)
        return tn_api_missing(error, house ? "room for the mesh" : "house");
    tartan_status status = tn_api_houses_begin(house->library, watch, error);
    if (status != TARTAN_OK)
        return status;
    tn_status built = tn_watch_check(&house->library->watch, &found);
    if (built == TN_OK)
        built = tn_house_solids(&house->house, &solids, &found);
    if (built == TN_OK)
        built = tn_house_mesh(&house->house, &solids, &made, &found);
    tn_solids_clear(&solids);
    status = tn_api_houses_end(house->library, built, &found, error);
    if (status != TARTAN_OK) {
        tn_mesh_clear(&made);
        return status;
    }
    status = tn_api_mesh(&made, mesh, error);
    if (status == TARTAN_OK)
        (*mesh)->unit = TN_MESH_UNIT_M;
    return status;
}

/* ---- files */

static const tn_house_file kinds[] = {[TARTAN_HOUSE_JSON] = TN_HOUSE_AS_JSON,   [TARTAN_HOUSE_ROOMS] = TN_HOUSE_AS_CSV,
                                      [TARTAN_HOUSE_PARTS] = TN_HOUSE_AS_PARTS, [TARTAN_HOUSE_OBJ] = TN_HOUSE_AS_OBJ,
                                      [TARTAN_HOUSE_PLY] = TN_HOUSE_AS_PLY,     [TARTAN_HOUSE_GLB] = TN_HOUSE_AS_GLB,
                                      [TARTAN_HOUSE_IFC] = TN_HOUSE_AS_IFC,     [TARTAN_HOUSE_DXF] = TN_HOUSE_AS_DXF,
                                      [TARTAN_HOUSE_SVG] = TN_HOUSE_AS_SVG,     [TARTAN_HOUSE_PNG] = TN_HOUSE_AS_PNG,
                                      [TARTAN_HOUSE_PDF] = TN_HOUSE_AS_PDF,     [TARTAN_HOUSE_MTL] = TN_HOUSE_AS_MTL};

static tn_status write_stream(const tn_house_filed *filed, tn_house_file kind, void **bytes, size_t *size,
                              tn_error *error)
{
    char *written = NULL;
    size_t count = 0;
    FILE *out = open_memstream(&written, &count);
    if (!out)
        return tn_fail_memory(error);
    tn_status status = tn_house_file_write(filed, kind, out, error);
    if (fclose(out) != 0 && status == TN_OK)
        status = tn_fail_memory(error);
    if (status == TN_OK) {
        *bytes = written;
        *size = count;
    } else {
        free(written);
    }
    return status;
}

static tn_status write_file(const tartan_house *house, tartan_house_format format, const tartan_house_drawing *drawing,
                            void **bytes, size_t *size, tn_error *error)
{
    tn_solids solids = {0};
    const tn_house_filed filed = {.house = &house->house,
                                  .solids = &solids,
                                  .title = drawing->title,
                                  .mtl = drawing->mtl,
                                  .views = {.items = drawing->views,
                                            .count = drawing->view_count,
                                            .cut = drawing->cut,
                                            .bare = drawing->bare,
                                            .azimuth = drawing->camera ? &drawing->azimuth : NULL,
                                            .elevation = drawing->camera ? &drawing->elevation : NULL},
                                  .scale = drawing->scale,
                                  .dpi = drawing->dpi,
                                  .watch = &house->library->watch};
    tn_status status = tn_watch_check(filed.watch, error);
    if (status == TN_OK)
        status = tn_house_solids(&house->house, &solids, error);
    if (status == TN_OK)
        status = write_stream(&filed, kinds[format], bytes, size, error);
    tn_solids_clear(&solids);
    return status;
}

static tartan_status check_drawing(const tartan_house_drawing *drawing, tartan_error *error)
{
    for (size_t i = 0; i < drawing->view_count; i++)
        if (!drawing->views || !drawing->views[i])
            return tn_api_missing(error, "view");
    if (drawing->camera && !(isfinite(drawing->azimuth) && isfinite(drawing->elevation)))
        return tn_api_refuse(error, TARTAN_INVALID, "the camera's angles are not finite");
    return TARTAN_OK;
}

tartan_status tartan_house_file(const tartan_house *house, tartan_house_format format,
                                const tartan_house_drawing *drawing, const tartan_watch *watch, void **bytes,
                                size_t *size, tartan_error *error)
{
    tn_error found;
    if (!house || !bytes || !size)
        return tn_api_missing(error, house ? "room for the file" : "house");
    if ((unsigned)format > TARTAN_HOUSE_MTL)
        return tn_api_refuse(error, TARTAN_INVALID, "there is no format of houses %d", (int)format);
    tartan_house_drawing wanted;
    tartan_status status = TN_API_TAKE(tartan_house_drawing, &wanted, drawing, error);
    if (status == TARTAN_OK)
        status = check_drawing(&wanted, error);
    if (status == TARTAN_OK)
        status = tn_api_houses_begin(house->library, watch, error);
    if (status != TARTAN_OK)
        return status;
    void *made = NULL;
    size_t made_size = 0;
    tn_status written = write_file(house, format, &wanted, &made, &made_size, &found);
    status = tn_api_houses_end(house->library, written, &found, error);
    if (status != TARTAN_OK)
        return status;
    *bytes = made;
    *size = made_size;
    return TARTAN_OK;
}
