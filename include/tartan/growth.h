/* Surfaces that grow.
 *
 * A module of a .hemls file holds a rewrite system; that of a growth study (.study) also how it is to be grown. A
 * tartan_growth is the surface: it begins as the seed, and every step enlarges it, moves it by its surroundings,
 * rewrites its edges and joins their branches. Lengths are model units, angles degrees, z is up. */
#ifndef TARTAN_GROWTH_H
#define TARTAN_GROWTH_H

#include "mesh.h"
#include "module.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- surroundings */

typedef enum tartan_force_kind { TARTAN_ATTRACTOR, TARTAN_REPELLER, TARTAN_GRAVITY } tartan_force_kind;

/* A force displaces each vertex in each step by strength / distance^exponent, towards `at` or away from it; gravity
 * displaces all by `at` itself. */
typedef struct tartan_force {
    tartan_force_kind kind;
    double at[3];
    double strength, exponent; /* not of gravity */
} tartan_force;

typedef enum tartan_boundary_kind { TARTAN_PLANE, TARTAN_BOX, TARTAN_SPHERE, TARTAN_SOLID } tartan_boundary_kind;

/* What becomes of a vertex that meets a boundary: it goes on along it, it stays there, or it passes and is counted
 * (tartan_measures.soft_boundary_nodes). */
typedef enum tartan_boundary_mode { TARTAN_SLIDE, TARTAN_STOP, TARTAN_SOFT } tartan_boundary_mode;

typedef struct tartan_boundary {
    tartan_boundary_kind kind;
    tartan_boundary_mode mode;
    bool inside;             /* the surface is to stay inside; otherwise outside. Not of planes */
    double a[3];             /* plane: a point; box: the low corner; sphere: the centre */
    double b[3];             /* plane: the normal, to the side that is allowed; box: the high corner */
    double radius;           /* sphere */
    const tartan_mesh *mesh; /* solid: a closed mesh, which is copied */
} tartan_boundary;

/* ---- growing */

typedef struct tartan_growth tartan_growth;

typedef struct tartan_growth_options {
    size_t size;
    uint32_t steps;       /* as many as the study says: for the caller's own use */
    double scale[3];      /* factor of each step, by axis; above 0 */
    double start[3];      /* centre of the seed */
    double start_length;  /* side of the seed; above 0 */
    double branch_angle;  /* by how much branches that join may miss pointing at each other; negative: the rules' own */
    double branch_length; /* how far apart they may be, in sides of the seed as it has grown by now; negative: any */
    bool fixed_centre;    /* scale about the start rather than about the mean of the vertices */
    bool fixed_perimeter; /* vertices of the outline stay */
    bool facing;          /* branches join only where each points towards the other */
    bool mirror;          /* '+' turns right, as in files of Genr8 */
    bool explain;         /* count why branches did not join (tartan_growth_counts) */
    bool bare;            /* without the study's own forces and boundaries */
    uint64_t seed;        /* of weighted rules */
    uint64_t edge_limit;  /* 0: 2^30 */
    uint32_t threads;           /* 0: one a processor */
    const tartan_force *forces; /* besides the study's own */
    size_t force_count;
    const tartan_boundary *boundaries; /* likewise */
    size_t boundary_count;
    const char *folder;            /* where the study's meshes lie; NULL: where it lay when it was compiled */
    tartan_mesh_reader *read_mesh; /* reads the study's meshes: tartan_mesh_read, or a function of yours */
} tartan_growth_options;
TARTAN_SIZED(tartan_growth_options)

/* Fills the options with what the module says, and with the defaults where it says nothing: scale 1.5, a seed of side 1
 * about the origin, 4 steps, seed 1. Forces and boundaries of a study are not listed: tartan_growth_new adds them. */
TARTAN_API tartan_status tartan_growth_options_of(const tartan_module *module, tartan_growth_options *options,
                                                  tartan_error *error);

/* The seed, ready to grow. Options that tartan_growth_options_of has not filled must all be set; NULL: as the module
 * says. TARTAN_INVALID: the module has no rewrite system, an option is out of its range, or the study names a mesh and
 * read_mesh is NULL; TARTAN_IO: a mesh of the study cannot be read. The growth borrows the module. */
TARTAN_API tartan_status tartan_growth_new(const tartan_module *module, const tartan_growth_options *options,
                                           tartan_growth **growth, tartan_error *error);
TARTAN_API void tartan_growth_free(tartan_growth *growth);

/* Grows to `steps` steps from the seed on; fewer than it has are TARTAN_INVALID. The watch (may be NULL) is told the
 * steps. TARTAN_LIMIT: too many edges, too much memory, or a place too far away. After TARTAN_STOPPED, TARTAN_LIMIT and
 * TARTAN_MEMORY the surface is that of the last complete step (tartan_growth_steps): the next call that asks about it
 * grows it again up to there. */
TARTAN_API tartan_status tartan_growth_grow(tartan_growth *growth, uint32_t steps, const tartan_watch *watch,
                                            tartan_error *error);
TARTAN_API uint32_t tartan_growth_steps(const tartan_growth *growth);

/* Did the last step leave everything as it was, so that no later one changes anything? */
TARTAN_API bool tartan_growth_at_rest(const tartan_growth *growth);

/* The seed again, with the same options. */
TARTAN_API tartan_status tartan_growth_restart(tartan_growth *growth, tartan_error *error);

/* ---- looking at it */

typedef struct tartan_mesh_options {
    size_t size;
    bool groups; /* a face belongs to the label and age of its lowest edge, a line to its own */
    bool lines;  /* the edges of the rules too */
    bool layers; /* lines are grouped by their label alone; faces are not */
} tartan_mesh_options;
TARTAN_SIZED(tartan_mesh_options)

/* The surface as a mesh: vertices in order of creation. `options` may be NULL. */
TARTAN_API tartan_status tartan_growth_mesh(tartan_growth *growth, const tartan_mesh_options *options,
                                            tartan_mesh **mesh, tartan_error *error);

typedef struct tartan_measures {
    size_t size;
    uint32_t step;
    uint64_t vertices, edges, faces;
    double low[3], high[3];     /* the box around it */
    double extent;              /* in x plus in y: the fitness term `size` */
    double smoothness;          /* sum over edges of the difference in z: larger is rougher */
    double soft_boundary_nodes; /* vertices on the wrong side of a soft boundary */
    double subdivisions;        /* vertices / edges */
    double symmetry;            /* 1: as many vertices on either side of their mean, in x and y */
    double undulation;          /* extent in z */
    bool has_fitness;           /* the study has goals */
    double fitness;             /* how far it is from them in all; lower is better, not finite where it has no value */
    uint32_t crossed_faces;     /* whose outline crosses itself */
    uint32_t inverted_faces;    /* turned over onto their neighbours */
} tartan_measures;
TARTAN_SIZED(tartan_measures)

/* What the surface measures as it stands. */
TARTAN_API tartan_status tartan_growth_measure(tartan_growth *growth, tartan_measures *measures, tartan_error *error);

/* Edges by label and age, and faces by their number of sides; no zeros, ascending. */
typedef struct tartan_age_count {
    uint32_t label; /* N of EdgeN */
    int32_t age;
    uint64_t count;
} tartan_age_count;

typedef struct tartan_side_count {
    uint32_t sides;
    uint64_t count;
} tartan_side_count;

typedef struct tartan_statistics tartan_statistics;

/* Counts of edges by label and age, and of faces by their sides. */
TARTAN_API tartan_status tartan_growth_statistics(tartan_growth *growth, tartan_statistics **statistics,
                                                  tartan_error *error);
TARTAN_API void tartan_statistics_free(tartan_statistics *statistics);
TARTAN_API const tartan_age_count *tartan_statistics_ages(const tartan_statistics *statistics, size_t *count);
TARTAN_API const tartan_side_count *tartan_statistics_sides(const tartan_statistics *statistics, size_t *count);

/* The values of the study's named fitness expressions, in its order; false past the end. A value that does not exist (a
 * division by zero) is not finite. */
TARTAN_API bool tartan_statistics_expression(const tartan_statistics *statistics, size_t i, const char **name,
                                             double *value);

/* What the last step did. Why branches did not join is counted where options.explain says so, each branch once, under
 * the furthest that any partner came. */
typedef struct tartan_growth_counts {
    size_t size;
    uint64_t replaced, joined;
    uint64_t kept_chains; /* which would have left a face of fewer than three edges */
    uint64_t along;       /* leave along the path, or straight out of the surface */
    uint64_t outside;     /* point out of the surface */
    uint64_t no_label;    /* no branch of their label in their region */
    uint64_t no_angle;    /* none that points against them within the angle */
    uint64_t not_facing;  /* none in front of them */
    uint64_t too_far;     /* none near enough */
    uint64_t adjacent;    /* only at a vertex that an edge leads to already */
    uint64_t taken;       /* only ones that joined others, or that a join cut off */
} tartan_growth_counts;
TARTAN_SIZED(tartan_growth_counts)

/* What the last step did. */
TARTAN_API tartan_status tartan_growth_last_counts(tartan_growth *growth, tartan_growth_counts *counts,
                                                   tartan_error *error);

#ifdef __cplusplus
}
#endif

#endif
