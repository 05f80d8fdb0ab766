/* STEP text (ISO 10303-21): numbered instances, one a line. Internal to runtime/house/export.
 *
 * A tn_stepfile owns its text; free it with tn_stepfile_clear.
 */
#ifndef TARTAN_HOUSE_STEP_H
#define TARTAN_HOUSE_STEP_H

#include "runtime/house/model/model.h"

/* The identifiers that are taken: hashes, in open addressing. */
typedef struct tn_stepfile_ids {
    uint64_t *taken; /* 0: free */
    size_t count, room;
} tn_stepfile_ids;

typedef struct tn_stepfile {
    tn_buffer text;
    unsigned last; /* number of the last instance */
    bool feet;     /* lengths, areas and volumes are in feet, otherwise in millimetres, square and cubic metres */
    uint64_t seed; /* of identifiers: a hash of what the project is called */
    tn_stepfile_ids ids;
    unsigned context, axes_context, plan_context; /* of bodies, axes and outlines */
    unsigned z, down, along[4], origin, axes;     /* what shapes share; along: x, turned by so many right angles */
    unsigned style;                               /* of the solids that are written; 0: none */
} tn_stepfile;

/* Adds an instance, `NAME(...)` without its number; returns that. */
unsigned tn_stepfile_add(tn_stepfile *step, const char *format, ...) __attribute__((format(printf, 2, 3)));
void tn_stepfile_clear(tn_stepfile *step);

/* Numbers in the units of the file. Lengths are given in nanometres: those in millimetres are exact for whole ones,
 * those in feet rounded to a billionth of a millimetre. Areas and volumes are given in metres. */
typedef struct tn_stepfile_number {
    char text[40];
} tn_stepfile_number;
tn_stepfile_number tn_stepfile_length(const tn_stepfile *step, double nanometres);
tn_stepfile_number tn_stepfile_area(const tn_stepfile *step, double square_metres);
tn_stepfile_number tn_stepfile_volume(const tn_stepfile *step, double cubic_metres);
tn_stepfile_number tn_stepfile_real(double number, int digits);

/* An identifier of 22 letters for what a key says within the project. Keys that were used before get the next number:
 * the first, second and so on of what is called so. */
typedef struct tn_stepfile_id {
    char text[23];
} tn_stepfile_id;
tn_stepfile_id tn_stepfile_guid(tn_stepfile *step, const char *key, ...) __attribute__((format(printf, 2, 3)));

/* A label as STEP writes it between quotes: in ASCII, others of Unicode's characters by their numbers; as many whole
 * characters as there is room for, 100 at least. */
typedef struct tn_stepfile_name {
    char text[1224];
} tn_stepfile_name;
tn_stepfile_name tn_stepfile_text(const char *text);

/* Appends a text of any length, written so. */
bool tn_stepfile_put_text(tn_buffer *to, const char *text);

/* A list `(#1,#2)` that grows. */
typedef struct tn_stepfile_list {
    tn_buffer text;
    unsigned count;
} tn_stepfile_list;
void tn_stepfile_list_add(tn_stepfile_list *list, unsigned instance);
const char *tn_stepfile_list_text(tn_stepfile_list *list); /* closes it; NULL where out of memory or empty */
void tn_stepfile_list_clear(tn_stepfile_list *list);

/* A placement at a point, its axes those of `within`; 0: of the world. */
unsigned tn_stepfile_placement(tn_stepfile *step, unsigned within, double x, double y, double z);

/* One whose x axis is turned about z, by so many right angles (0 to 3) counter-clockwise. */
unsigned tn_stepfile_turned(tn_stepfile *step, unsigned within, double x, double y, double z, int turns);

/* The extruded solid of a box between corners. */
unsigned tn_stepfile_solid(tn_stepfile *step, const double low[3], const double high[3]);

/* What a profile is from a level up: so high. */
unsigned tn_stepfile_extruded(tn_stepfile *step, unsigned profile, double from, double high);

/* A closed line, by its corners; back: from the last to the first. */
unsigned tn_stepfile_ring(tn_stepfile *step, const double (*corners)[2], size_t count, bool back);

/* The solid of faces that is upright over a convex polygon, counter-clockwise seen from above, of at most
 * TN_FACET_CORNERS corners. */
unsigned tn_stepfile_prism(tn_stepfile *step, const tn_block_corner *corners, size_t count);

/* A line through points of a plane, x and y of each. */
unsigned tn_stepfile_curve(tn_stepfile *step, const double (*points)[2], size_t count);

/* What a product looks like: a representation of the kinds of solids (SweptSolid, Tessellation). */
unsigned tn_stepfile_body(tn_stepfile *step, const char *kind, const char *solids);

/* The shape of a product: of its representations. */
unsigned tn_stepfile_shape(tn_stepfile *step, unsigned body, unsigned other);

#endif
