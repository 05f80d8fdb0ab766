/* Implicit surfaces: the meshes of what is inside a surface of a .field file. */
#ifndef TARTAN_FIELD_H
#define TARTAN_FIELD_H

#include "mesh.h"
#include "module.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct tartan_field_options {
    size_t size;
    const char *surface;           /* NULL: the last of the file */
    uint32_t samples;              /* on the longest side of the box, 2 to 8,192; 0: what the file says, or 50 */
    bool open;                     /* end the mesh at the box instead of closing it there */
    bool jumps_open;               /* where the field jumps, leave the mesh open instead of making a wall */
    uint64_t sample_limit;         /* 0: 2,000,000,000 */
    uint64_t triangle_limit;       /* 0: 100,000,000 */
    uint32_t threads;              /* 0: one a processor */
    const char *folder;            /* where the file's meshes lie; NULL: where it lay when it was compiled */
    tartan_mesh_reader *read_mesh; /* reads these meshes: tartan_mesh_read, or a function of yours */
    bool sharp;                    /* sharp edges and corners, by points on no edge of the grid: triangles may cross */
} tartan_field_options;
TARTAN_SIZED(tartan_field_options)

/* Sides of the box, as bits. */
enum {
    TARTAN_LOW_X = 1,
    TARTAN_HIGH_X = 2,
    TARTAN_LOW_Y = 4,
    TARTAN_HIGH_Y = 8,
    TARTAN_LOW_Z = 16,
    TARTAN_HIGH_Z = 32,
};

/* What was found on the way. */
typedef struct tartan_field_findings {
    size_t size;
    bool inside, outside;        /* is any sample inside, once the box has closed the form, and was any outside? */
    uint32_t cut;                /* which sides of the box cut what is inside */
    uint64_t no_values;          /* samples where the field has no value: they are outside */
    uint64_t jumps;              /* vertices where the field jumps over 0 */
    double no_value[3], jump[3]; /* the first of each */
    double spacing;              /* the largest distance between two samples that are neighbours */
    uint64_t sharp;              /* points added for sharp edges: the last vertices of the mesh */
} tartan_field_findings;
TARTAN_SIZED(tartan_field_findings)

/* Meshes a surface: closed, of triangles, counter-clockwise seen from outside, the same at any number of threads.
 * `options`, `watch` and `findings` may be NULL. TARTAN_INVALID: there is no such surface, or the file names a mesh and
 * read_mesh is NULL; TARTAN_IO: such a mesh cannot be read; TARTAN_LIMIT: too many samples or triangles. */
TARTAN_API tartan_status tartan_field_mesh(const tartan_module *module, const tartan_field_options *options,
                                           const tartan_watch *watch, tartan_mesh **mesh,
                                           tartan_field_findings *findings, tartan_error *error);

#ifdef __cplusplus
}
#endif

#endif
