/* Pictures in memory: SVG, PNG or PDF, and of plans DXF, the same bytes for the same input: of SVG and DXF on every
 * machine, of the others for one version of cairo and one set of fonts. A build without the part `draw` has SVG and DXF
 * alone (TARTAN_INVALID, E0907). */
#ifndef TARTAN_DRAW_H
#define TARTAN_DRAW_H

#include "analysis.h"
#include "genome.h"
#include "growth.h"
#include "measure.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum tartan_picture_format {
    TARTAN_SVG,
    TARTAN_PNG,
    TARTAN_PDF,
    TARTAN_DRAWN_DXF /* of plans alone: a drawing to scale, with layers, for drawing programs */
} tartan_picture_format;

typedef struct tartan_plans_drawing {
    size_t size;
    const char *title;           /* NULL: the schema's name */
    const char *doc;             /* a line or two below it, or NULL */
    const char *const *captions; /* what stands under each plan, its rank for example; or NULL */
    const char *paper;           /* "a3", "arch-c", "letter"; NULL: the smallest that holds all */
    uint32_t scale;              /* 1:scale; 0: the largest usual one that fits */
    uint32_t columns;            /* plans in a row; 0: as many as fit */
    uint32_t dpi;                /* of a PNG; 0: 150 */
    const char *profile;         /* by which the layers of a DXF are named: "iso" or "us"; NULL: by the measures */
} tartan_plans_drawing;
TARTAN_SIZED(tartan_plans_drawing)

/* Draws plans: `trays` holds them one after another, the i-th ending before trays[ends[i]]. At most 5,000, and a PNG of
 * at most 100 million pixels (TARTAN_LIMIT). A profile is refused if the picture is no DXF (TARTAN_INVALID). `drawing`
 * and `watch` may be NULL. */
TARTAN_API tartan_status tartan_plans_draw(const tartan_schema *schema, const uint32_t *trays, const size_t *ends,
                                           size_t count, tartan_picture_format format,
                                           const tartan_plans_drawing *drawing, const tartan_watch *watch, void **bytes,
                                           size_t *size, tartan_error *error);

/* Draws the rules one below the other, in the manner of the LaHave paper. `watch` may be NULL. */
TARTAN_API tartan_status tartan_rules_draw(const tartan_rules *rules, tartan_picture_format format,
                                           const tartan_watch *watch, void **bytes, size_t *size, tartan_error *error);

/* Of surfaces that grow, and of meshes. */
typedef struct tartan_growth_drawing {
    size_t size;
    const char *title;   /* or NULL */
    const char *caption; /* a line at the foot, or NULL */
    double azimuth;      /* of the camera: degrees about z from the x axis on; with `camera` */
    double elevation;    /* degrees above the ground; with `camera` */
    bool camera;         /* false: from -60 and 30 */
    double width;        /* points; 0: 480 */
    uint32_t dpi;        /* of a PNG; 0: 150 */
} tartan_growth_drawing;
TARTAN_SIZED(tartan_growth_drawing)

/* Draws a surface as it stands: shaded, what is hidden left out. At most 2 million faces (TARTAN_LIMIT). `drawing` and
 * `watch` may be NULL. */
TARTAN_API tartan_status tartan_growth_draw(tartan_growth *growth, tartan_picture_format format,
                                            const tartan_growth_drawing *drawing, const tartan_watch *watch,
                                            void **bytes, size_t *size, tartan_error *error);

/* Draws a mesh, shaded, what is hidden left out; of one that is not closed both sides are seen. At most 300,000
 * triangles, but for a PNG (TARTAN_LIMIT). `drawing` and `watch` may be NULL. */
TARTAN_API tartan_status tartan_mesh_draw(const tartan_mesh *mesh, tartan_picture_format format,
                                          const tartan_growth_drawing *drawing, const tartan_watch *watch, void **bytes,
                                          size_t *size, tartan_error *error);

/* Draws the derivation of the mapper's last tartan_map, which was to keep it; at most 4,000 nodes (TARTAN_LIMIT).
 * `watch` may be NULL. */
TARTAN_API tartan_status tartan_derivation_draw(tartan_mapper *mapper, tartan_picture_format format,
                                                const tartan_watch *watch, void **bytes, size_t *size,
                                                tartan_error *error);

#ifdef __cplusplus
}
#endif

#endif
