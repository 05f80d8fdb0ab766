/* The C interface to pictures, which are made in memory. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "api/genome/genome.h"
#include "api/geometry/mesh.h"
#include "api/growth/growth.h"
#include "api/plan/plan.h"
#include "runtime/genome/picture/tree_draw.h"
#include "runtime/geometry/edges.h"
#include "runtime/growth/picture/draw.h"
#include "runtime/plan/picture/draw.h"
#include "runtime/plan/picture/draw_rule.h"
#include "runtime/scene/draw_mesh.h"

/* Where a picture of this format goes. */
static tartan_status begin(tartan_picture_format format, uint32_t dpi, const tartan_watch *given, tn_watch *watch,
                           tn_picture *to, void **bytes, const size_t *size, tartan_error *error)
{
    if (!bytes || !size)
        return tn_api_missing(error, "room for the picture");
    if ((unsigned)format > TARTAN_DRAWN_DXF)
        return tn_api_refuse(error, TARTAN_INVALID, "there is no picture format %d", (int)format);
    *to = (tn_picture){.format = (tn_canvas_format)((int)format + TN_CANVAS_SVG), .dpi = dpi, .watch = watch};
    return tn_api_watch(given, watch, error);
}

/* The same, of what no drawing program reads. */
static tartan_status begin_shown(tartan_picture_format format, uint32_t dpi, const tartan_watch *given, tn_watch *watch,
                                 tn_picture *to, void **bytes, const size_t *size, tartan_error *error)
{
    if (format == TARTAN_DRAWN_DXF)
        return tn_api_refuse(error, TARTAN_INVALID, "a DXF is made of plans; this is drawn as SVG, PNG or PDF");
    return begin(format, dpi, given, watch, to, bytes, size, error);
}

static tartan_status finish(tn_status status, const tn_error *found, const tn_picture *to, void **bytes, size_t *size,
                            tartan_error *error)
{
    if (status != TN_OK)
        return tn_api_fail(found, error);
    *bytes = to->element;
    *size = to->size;
    return TARTAN_OK;
}

/* ---- plans */

static tartan_status gather(const tn_schema *schema, const uint32_t *trays, const size_t *ends, size_t count,
                            const tartan_plans_drawing *drawing, tn_drawn_plan **plans, tartan_error *error)
{
    tn_error found;
    if (count && (!ends || (ends[count - 1] && !trays)))
        return tn_api_missing(error, "array of plans");
    tn_drawn_plan *made = calloc(count + 1, sizeof *made);
    if (!made)
        return tn_api_memory(error);
    for (size_t i = 0; i < count; i++) {
        size_t begin = i ? ends[i - 1] : 0;
        if (ends[i] < begin || tn_api_trays(schema, trays + begin, ends[i] - begin, &found) != TN_OK) {
            free(made);
            return ends[i] < begin ? tn_api_refuse(error, TARTAN_INVALID, "plan %zu ends before it begins", i + 1)
                                   : tn_api_fail(&found, error);
        }
        made[i] = (tn_drawn_plan){.trays = trays + begin,
                                  .length = ends[i] - begin,
                                  .number = drawing->captions ? drawing->captions[i] : NULL};
    }
    *plans = made;
    return TARTAN_OK;
}

static tartan_status take_profile(const char *name, tn_picture *to, tartan_error *error)
{
    static const char *const names[] = {[TN_PROFILE_ISO] = "iso", [TN_PROFILE_US] = "us"};
    if (!name)
        return TARTAN_OK;
    if (to->format != TN_CANVAS_DXF)
        return tn_api_refuse(error, TARTAN_INVALID, "a profile names the layers of a DXF, and the picture is none");
    for (int i = TN_PROFILE_ISO; i <= TN_PROFILE_US; i++)
        if (strcmp(name, names[i]) == 0)
            to->profile = (tn_profile)i;
    return to->profile != TN_PROFILE_BY_MEASURES
               ? TARTAN_OK
               : tn_api_refuse(error, TARTAN_INVALID, "profiles are iso and us, not `%.60s`", name);
}

tartan_status tartan_plans_draw(const tartan_schema *schema, const uint32_t *trays, const size_t *ends, size_t count,
                                tartan_picture_format format, const tartan_plans_drawing *given,
                                const tartan_watch *waiting, void **bytes, size_t *size, tartan_error *error)
{
    tartan_plans_drawing drawing;
    tn_drawn_plan *plans = NULL;
    tn_watch watch;
    tn_picture to;
    tn_error found;
    if (!schema)
        return tn_api_missing(error, "schema");
    tartan_status status = TN_API_TAKE(tartan_plans_drawing, &drawing, given, error);
    if (status == TARTAN_OK)
        status = begin(format, drawing.dpi, waiting, &watch, &to, bytes, size, error);
    if (status == TARTAN_OK)
        status = take_profile(drawing.profile, &to, error);
    if (status == TARTAN_OK)
        status = gather(tn_api_schema(schema), trays, ends, count, &drawing, &plans, error);
    if (status != TARTAN_OK)
        return status;
    const tn_draw_options options = {.title = drawing.title,
                                     .doc = drawing.doc,
                                     .number_name = "plan",
                                     .paper = drawing.paper,
                                     .scale = drawing.scale,
                                     .columns = drawing.columns,
                                     .dpi = drawing.dpi};
    tn_status drawn = tn_plans_draw(tn_api_schema(schema), plans, count, &options, &to, &found);
    free(plans);
    return finish(drawn, &found, &to, bytes, size, error);
}

/* ---- rules */

tartan_status tartan_rules_draw(const tartan_rules *rules, tartan_picture_format format, const tartan_watch *waiting,
                                void **bytes, size_t *size, tartan_error *error)
{
    tn_watch watch;
    tn_picture to;
    tn_error found;
    if (!rules)
        return tn_api_missing(error, "rules");
    tartan_status status = begin_shown(format, 0, waiting, &watch, &to, bytes, size, error);
    if (status != TARTAN_OK)
        return status;
    size_t count = tartan_rules_count(rules);
    const tn_schema *schema = tn_api_rules_schema(rules);
    tn_drawn_rule *drawn = calloc(count + 1, sizeof *drawn);
    if (!drawn)
        return tn_api_memory(error);
    for (size_t i = 0; i < count; i++)
        drawn[i] = tn_drawn_rule_of(schema->module, tn_api_rules_record(rules, i));
    tn_status made = tn_rules_draw(schema, drawn, count, &to, &found);
    free(drawn);
    return finish(made, &found, &to, bytes, size, error);
}

/* ---- surfaces */

static tartan_status camera_of(const tartan_growth_drawing *drawing, tn_camera *camera, tartan_error *error)
{
    *camera = tn_camera_default();
    if (drawing->camera) {
        camera->azimuth = drawing->azimuth;
        camera->elevation = drawing->elevation;
    }
    if (drawing->width > 0)
        camera->width = drawing->width;
    bool good =
        isfinite(camera->azimuth) && fabs(camera->elevation) <= 90 && drawing->width >= 0 && drawing->width <= 100000;
    return good ? TARTAN_OK
                : tn_api_refuse(error, TARTAN_INVALID,
                                "a camera's elevation lies between -90 and 90, and a width is up to 100,000 points");
}

/* A picture of something in space: how it is drawn, from where, and where it goes. */
typedef struct space_picture {
    tartan_growth_drawing drawing;
    tn_camera camera;
    tn_watch watch;
    tn_picture to; /* which borrows the watch */
} space_picture;

static tartan_status begin_in_space(tartan_picture_format format, const tartan_growth_drawing *given,
                                    const tartan_watch *waiting, space_picture *p, void **bytes, const size_t *size,
                                    tartan_error *error)
{
    tartan_status status = TN_API_TAKE(tartan_growth_drawing, &p->drawing, given, error);
    if (status == TARTAN_OK)
        status = begin_shown(format, p->drawing.dpi, waiting, &p->watch, &p->to, bytes, size, error);
    return status == TARTAN_OK ? camera_of(&p->drawing, &p->camera, error) : status;
}

tartan_status tartan_growth_draw(tartan_growth *growth, tartan_picture_format format,
                                 const tartan_growth_drawing *given, const tartan_watch *waiting, void **bytes,
                                 size_t *size, tartan_error *error)
{
    space_picture p;
    tn_view *view = NULL;
    tn_error found;
    tartan_status status = begin_in_space(format, given, waiting, &p, bytes, size, error);
    if (status == TARTAN_OK)
        status = tn_api_growth_mend(growth, error);
    if (status != TARTAN_OK)
        return status;
    const tn_view_options options = {.title = p.drawing.title ? p.drawing.title : growth->study.title,
                                     .caption = p.drawing.caption,
                                     .dpi = p.drawing.dpi,
                                     .legend = tn_growth_legend(growth->system)};
    tn_growth_watch(growth->growth, &p.watch);
    tn_status drawn = tn_growth_view(growth->growth, &p.camera, false, &view, &found);
    tn_growth_watch(growth->growth, NULL);
    if (drawn == TN_OK) {
        drawn = tn_views_draw(&view, 1, &options, &p.to, &found);
        tn_view_free(view);
    }
    return finish(drawn, &found, &p.to, bytes, size, error);
}

/* ---- meshes */

/* Has each edge of the triangles a second one? */
static tn_status api_mesh_closed(const tn_mesh *mesh, bool *closed, tn_error *error)
{
    uint32_t *twins = tn_mesh_twins(mesh);
    if (!twins)
        return tn_fail_memory(error);
    *closed = true;
    for (size_t corner = 0; *closed && corner < 3 * mesh->face_count; corner++)
        *closed = twins[corner] != TN_NO_TWIN;
    free(twins);
    return TN_OK;
}

static tn_status api_mesh_draw(const tn_mesh *mesh, tn_mesh_picture *picture, tn_picture *to, tn_error *error)
{
    tn_mesh triangles = {0};
    double *normals = NULL;
    bool closed = false;
    tn_status status = tn_mesh_copy(mesh, &triangles, error);
    triangles.watch = picture->watch;
    if (status == TN_OK)
        status = tn_mesh_triangulate(&triangles, error);
    if (status == TN_OK)
        status = tn_mesh_normals(&triangles, &normals, error);
    if (status == TN_OK)
        status = api_mesh_closed(&triangles, &closed, error);
    picture->normals = normals;
    picture->open = !closed;
    if (status == TN_OK)
        status = tn_mesh_draw(&triangles, picture, to, error);
    free(normals);
    tn_mesh_clear(&triangles);
    return status;
}

tartan_status tartan_mesh_draw(const tartan_mesh *mesh, tartan_picture_format format,
                               const tartan_growth_drawing *given, const tartan_watch *waiting, void **bytes,
                               size_t *size, tartan_error *error)
{
    space_picture p;
    tn_error found;
    if (!mesh)
        return tn_api_missing(error, "mesh");
    tartan_status status = begin_in_space(format, given, waiting, &p, bytes, size, error);
    if (status != TARTAN_OK)
        return status;
    tn_mesh_picture picture = {.camera = p.camera,
                               .title = p.drawing.title,
                               .caption = p.drawing.caption,
                               .dpi = p.drawing.dpi,
                               .watch = &p.watch};
    return finish(api_mesh_draw(&mesh->mesh, &picture, &p.to, &found), &found, &p.to, bytes, size, error);
}

/* ---- derivations */

tartan_status tartan_derivation_draw(tartan_mapper *mapper, tartan_picture_format format, const tartan_watch *waiting,
                                     void **bytes, size_t *size, tartan_error *error)
{
    tn_watch watch;
    tn_picture to;
    tn_tree tree;
    tn_error found;
    tartan_status status = tn_api_derivation(mapper, error);
    if (status == TARTAN_OK)
        status = begin_shown(format, 0, waiting, &watch, &to, bytes, size, error);
    if (status != TARTAN_OK)
        return status;
    tn_status drawn = tn_tree_make(mapper->last.events, mapper->last.event_count, &tree, &found);
    if (drawn == TN_OK)
        drawn = tn_tree_draw(mapper->grammar, mapper->last.events, &tree, &to, &found);
    tn_tree_clear(&tree);
    return finish(drawn, &found, &to, bytes, size, error);
}
