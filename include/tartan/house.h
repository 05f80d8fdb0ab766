/* Libraries of houses: counted, numbered, drawn at random, the best of them and what else one could be; and houses as
 * meshes and files in memory. Only libtartan has this; what is not here can be asked as JSON (ask.h).
 *
 * Trays of plans are numbers, as in plan.h. Counts, ranks and numbers can have any number of digits: they are texts.
 * A house borrows its library; the library, its houses and lists of houses belong to one thread at a time together.
 * Functions that take a watch may take long; it may be NULL. */
#ifndef TARTAN_HOUSE_H
#define TARTAN_HOUSE_H

#include "measure.h"
#include "mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- libraries */

typedef struct tartan_house_library tartan_house_library;

typedef struct tartan_house_library_options {
    size_t size;
    const char *name;    /* NULL: the only library of houses of the compiled file itself */
    uint32_t max_states; /* of any automaton, and of counting houses; 0: 20,000 for a clause, 1,000,000 for all clauses
                            together, 3,000,000 for houses */
    uint64_t max_houses; /* if walks are asked for: the most houses that are looked at one by one; 0: 100,000 on one
                            plan, 5,000 that are drawn of all */
} tartan_house_library_options;
TARTAN_SIZED(tartan_house_library_options)

/* Opens a library of houses of the module (`library NAME from PLANS in FORM`), with the library of its plans. No such
 * library, or several where none is named, is TARTAN_INVALID; too many states are TARTAN_LIMIT. `options` may be NULL.
 */
TARTAN_API tartan_status tartan_house_library_open(const tartan_module *module,
                                                   const tartan_house_library_options *options,
                                                   const tartan_watch *watch, tartan_house_library **library,
                                                   tartan_error *error);
TARTAN_API void tartan_house_library_free(tartan_house_library *library);

/* Its name, and the schema of its plans. */
TARTAN_API const char *tartan_house_library_name(const tartan_house_library *library);
TARTAN_API const tartan_schema *tartan_house_library_schema(const tartan_house_library *library);

/* The plan that is asked about, one of the library's; where a function takes NULL for it, all plans are meant. */
typedef struct tartan_on_plan {
    const uint32_t *trays;
    size_t length;
} tartan_on_plan;

/* How many houses it keeps on one plan, or on all plans of a length (in trays; TARTAN_ANY_LENGTH: of any), in decimal.
 * TARTAN_LIMIT where that takes too much. */
TARTAN_API tartan_status tartan_house_library_count(tartan_house_library *library, uint32_t length,
                                                    const tartan_watch *watch, char **count, tartan_error *error);
TARTAN_API tartan_status tartan_house_library_count_on(tartan_house_library *library, const tartan_on_plan *plan,
                                                       const tartan_watch *watch, char **count, tartan_error *error);

/* The unit of a measure of its houses or plans: "m", "ft2", or "" for plain numbers; NULL where it has none of that
 * name. */
TARTAN_API const char *tartan_house_library_unit(tartan_house_library *library, const char *measure);

/* ---- houses */

typedef struct tartan_house tartan_house;

/* Reads a house line (`plan ; options ; functions ; faces ; tiles`; size bytes, no newline): any house of the library's
 * form, also one that the library does not keep. If values are left out (`_`, or a part that is `-` or missing), it is
 * the first house of the library that has what is typed. What is none is TARTAN_INVALID, with error.column. */
TARTAN_API tartan_status tartan_house_read(tartan_house_library *library, const char *line, size_t size,
                                           tartan_house **house, tartan_error *error);
TARTAN_API void tartan_house_free(tartan_house *house);

/* Writes its line, without a newline, to a new text. */
TARTAN_API tartan_status tartan_house_write(const tartan_house *house, char **line, tartan_error *error);

/* Its plan. */
TARTAN_API const uint32_t *tartan_house_plan(const tartan_house *house, size_t *length);

/* The house of a number: "R", its rank among all houses of the library (from 0: by the ranks of their plans, then by
 * their places on them), or "P:V", the rank of its plan and its place among the houses on that plan. A # may stand
 * before either. What names no house is TARTAN_INVALID. */
TARTAN_API tartan_status tartan_house_unrank(tartan_house_library *library, const char *number,
                                             const tartan_watch *watch, tartan_house **house, tartan_error *error);

/* Its rank among all houses, in decimal, and its number "P:V", which takes less time. One that the library does not
 * keep is TARTAN_INVALID. */
TARTAN_API tartan_status tartan_house_rank(const tartan_house *house, const tartan_watch *watch, char **rank,
                                           tartan_error *error);
TARTAN_API tartan_status tartan_house_number(const tartan_house *house, const tartan_watch *watch, char **number,
                                             tartan_error *error);

/* ---- several houses */

typedef struct tartan_houses tartan_houses;

/* The most houses that a list can be asked for. */
#define TARTAN_HOUSES_MAX 1000000

/* `count` different houses drawn uniformly, in the order of their ranks: the same seed gives the same houses
 * everywhere. Where there are fewer, all of them. */
TARTAN_API tartan_status tartan_house_sample(tartan_house_library *library, const tartan_on_plan *plan, uint64_t seed,
                                             size_t count, const tartan_watch *watch, tartan_houses **houses,
                                             tartan_error *error);

/* The `count` best: by the first wish, then by the next, then by rank. One to three wishes, of measures of houses or of
 * their plans. */
TARTAN_API tartan_status tartan_house_best(tartan_house_library *library, const tartan_on_plan *plan,
                                           const tartan_wish *wishes, size_t wish_count, size_t count,
                                           const tartan_watch *watch, tartan_houses **houses, tartan_error *error);

/* What else the house could be: each other value of one choice with which the library still keeps it, in the order of a
 * house line. cell: "2.body.ground" (trays from 1), to change only what is about this cell; NULL: anything. The library
 * has to keep the house. */
TARTAN_API tartan_status tartan_house_variants(const tartan_house *house, const char *cell, const tartan_watch *watch,
                                               tartan_houses **houses, tartan_error *error);

/* The houses of a list. */
TARTAN_API void tartan_houses_free(tartan_houses *houses);
TARTAN_API size_t tartan_houses_count(const tartan_houses *houses);
TARTAN_API const tartan_house *tartan_houses_house(const tartan_houses *houses, size_t i); /* NULL past the end */

/* Of the best: the value that a house has by a wish, counted from 0: "p/q" or "p", in the measure's unit. NULL past the
 * end, and of other lists. */
TARTAN_API const char *tartan_houses_value(const tartan_houses *houses, size_t i, size_t wish);

typedef enum tartan_change_kind {
    TARTAN_CHANGE_SECTION,  /* of the whole house */
    TARTAN_CHANGE_FUNCTION, /* of a cell */
    TARTAN_CHANGE_FACE,     /* what is in a face */
    TARTAN_CHANGE_TILE      /* in a cell */
} tartan_change_kind;

typedef struct tartan_house_change {
    tartan_change_kind kind;
    const char *where;     /* the choice, the cell, or the face: "2.body.ground, back" */
    const char *from, *to; /* its values */
} tartan_house_change;

/* Of variants: what was changed. NULL past the end, and of other lists. */
TARTAN_API const tartan_house_change *tartan_houses_change(const tartan_houses *houses, size_t i);

/* ---- a house as a mesh, and as files */

/* The boundary of all that it is built of, closed and two-manifold, in triangles: metres, z up. Its groups are kinds of
 * parts ("outside", "deck", "roof", ...), then the materials of the form: a part that has one is in that group. */
TARTAN_API tartan_status tartan_house_mesh(const tartan_house *house, const tartan_watch *watch, tartan_mesh **mesh,
                                           tartan_error *error);

typedef enum tartan_house_format {
    TARTAN_HOUSE_JSON,  /* cells, faces, rooms, solids, parts and costs */
    TARTAN_HOUSE_ROOMS, /* rooms as CSV */
    TARTAN_HOUSE_PARTS, /* parts as CSV: number, area, volume, costs */
    TARTAN_HOUSE_OBJ,   /* the mesh, with names by storey, room and part */
    TARTAN_HOUSE_PLY,
    TARTAN_HOUSE_GLB,
    TARTAN_HOUSE_IFC, /* IFC4: a building with its storeys, rooms and parts */
    TARTAN_HOUSE_DXF, /* drawings */
    TARTAN_HOUSE_SVG,
    TARTAN_HOUSE_PNG,
    TARTAN_HOUSE_PDF,
    TARTAN_HOUSE_MTL /* the materials of the OBJ */
} tartan_house_format;

/* What is drawn, and how. */
typedef struct tartan_house_drawing {
    size_t size;
    const char *title;         /* also of IFC and GLB; NULL: what the form says of itself */
    const char *const *views;  /* plan:STOREY, section:x=LENGTH, section:y=LENGTH, elevation:SIDE, axonometric, sheet */
    size_t view_count;         /* 0: a sheet, which has all that one draws of a house */
    const char *cut;           /* the storey above which the axonometric view is lifted off; or NULL */
    bool bare;                 /* without what stands in the rooms */
    bool camera;               /* false: from 60 and 30 */
    double azimuth, elevation; /* of the axonometric view: degrees about z, and above the ground; with `camera` */
    uint32_t scale;            /* of pictures, 1:scale; 0: the largest usual one at which everything fits on paper */
    uint32_t dpi;              /* of a PNG; 0: 150 */
    const char *mtl;           /* of an OBJ: the name of the file that has its materials; NULL: house.mtl */
} tartan_house_drawing;
TARTAN_SIZED(tartan_house_drawing)

/* The house as a file of that format, in memory: the bytes that `tartan house` writes. Formats that are no drawings use
 * nothing of `drawing` but the title; it may be NULL. A text of a view that is wrong is TARTAN_INVALID. PNG and PDF
 * need the part `draw`. */
TARTAN_API tartan_status tartan_house_file(const tartan_house *house, tartan_house_format format,
                                           const tartan_house_drawing *drawing, const tartan_watch *watch, void **bytes,
                                           size_t *size, tartan_error *error);

#ifdef __cplusplus
}
#endif

#endif
