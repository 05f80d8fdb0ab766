/* STEP text (ISO 10303-21): numbered instances, one a line. Internal to runtime/house/export.
 *
 * A tn_stepfile owns its text; free it with tn_stepfile_clear.
 */
#ifndef TARTAN_HOUSE_STEP_H
#define TARTAN_HOUSE_STEP_H

#include "runtime/house/model/model.h"

typedef struct tn_stepfile {
    tn_buffer text;
    unsigned last;    /* number of the last instance */
    char seed[48];    /* of identifiers: a hash of the house, as text */
    unsigned context; /* the instances that all shapes share */
    unsigned z, x, origin, axes;
} tn_stepfile;

/* Adds an instance, `NAME(...)` without its number; returns that. */
unsigned tn_stepfile_add(tn_stepfile *step, const char *format, ...) __attribute__((format(printf, 2, 3)));
void tn_stepfile_clear(tn_stepfile *step);

/* A length in millimetres, exactly for whole nanometres. */
typedef struct tn_stepfile_number {
    char text[40];
} tn_stepfile_number;
tn_stepfile_number tn_stepfile_mm(double nanometres);

/* An identifier of 22 letters, by the part's name. */
typedef struct tn_stepfile_id {
    char text[23];
} tn_stepfile_id;
tn_stepfile_id tn_stepfile_guid(const tn_stepfile *step, const char *kind, unsigned number);

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

/* A placement at a point, its axes those of `within`. */
unsigned tn_stepfile_placement(tn_stepfile *step, unsigned within, double x, double y, double z);

/* One whose x axis is turned about z, by so many right angles (0 to 3) counter-clockwise. */
unsigned tn_stepfile_turned(tn_stepfile *step, unsigned within, double x, double y, double z, int turns);

/* The shape of a part: a box of that size, from the origin of its placement. */
unsigned tn_stepfile_box(tn_stepfile *step, double wide, double deep, double high);

/* The extruded solid of a box between corners. */
unsigned tn_stepfile_solid(tn_stepfile *step, const double low[3], const double high[3]);

/* A shape of extruded solids. */
unsigned tn_stepfile_shape(tn_stepfile *step, const char *solids);

/* The solid of faces that is upright over a convex polygon, counter-clockwise seen from above, of at most
 * TN_FACET_CORNERS corners. */
unsigned tn_stepfile_prism(tn_stepfile *step, const tn_block_corner *corners, size_t count);

/* A shape of such solids. */
unsigned tn_stepfile_faceted(tn_stepfile *step, const char *solids);

#endif
