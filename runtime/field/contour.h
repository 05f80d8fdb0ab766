/* Meshes the boundary of what is inside a field: a closed mesh of triangles (docs/field-language.md says how it is
 * defined, sample by sample).
 *
 * Which engine, how many threads and whether blocks are skipped changes no bit of it.
 */
#ifndef TARTAN_FIELD_CONTOUR_H
#define TARTAN_FIELD_CONTOUR_H

#include "runtime/field/field.h"
#include "runtime/geometry/mesh.h"

typedef struct tn_contour_options {
    unsigned threads;   /* 0: all processors */
    bool interpret;     /* the plain interpreter, at every sample */
    bool every_sample;  /* skip no blocks: for tests */
    bool open;          /* the mesh ends at the box */
    bool jumps_open;    /* leave out triangles that touch a jump */
    bool sharp;         /* sharp edges and corners: points are added, and triangles may cross */
    bool between;       /* look for parts of the form that lie between samples */
    bool survey;        /* no mesh: only what the samples say, and whether it would pass a limit */
    uint64_t samples;   /* the most, 0: TN_SAMPLES_MAX */
    uint64_t triangles; /* the most, 0: TN_TRIANGLES_MAX */
} tn_contour_options;

#define TN_SAMPLES_MAX 2000000000u
#define TN_TRIANGLES_MAX 100000000u

typedef struct tn_contour {
    tn_mesh mesh;                /* owned; z up */
    uint64_t jumps;              /* vertices where the field jumps over 0 */
    uint64_t moved;              /* vertices kept away from a sample */
    uint64_t sharp;              /* points added for sharp edges: the last vertices of the mesh */
    uint64_t no_values;          /* samples without a value */
    double jump[3], no_value[3]; /* the first of each */
    unsigned cut;                /* sides of the box that cut it: bit 2 * axis + (1 where high) */
    bool inside;                 /* is any sample, once the box is closed? */
    bool outside;                /* was any before? */
    uint64_t missed;             /* `between`: cells with something inside but no such sample in or next to them */
    double missed_at[3];         /* inside, in the first of these */
    bool empty;                  /* `between`: it is proven that nothing is inside */
    double spacing;              /* the largest */
    double seconds[3];           /* that signs, vertices and triangles took */
} tn_contour;

/* Clear the contour in any case. TN_LIMIT (E1414, E1415) if it passes a limit; TN_MEMORY; with `between`, TN_INVALID
 * (E1417) where there is a form, but no sample of it. */
tn_status tn_contour_new(const tn_field *field, const tn_field_grid *grid, const tn_contour_options *options,
                         tn_contour *contour, tn_error *error);
void tn_contour_clear(tn_contour *contour);

#endif
