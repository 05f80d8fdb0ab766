/* A surface of a file that is open, and what there is to say of its contour. */
#ifndef TARTAN_DRIVER_FIELD_FIELD_H
#define TARTAN_DRIVER_FIELD_FIELD_H

#include "driver/open/open.h"
#include "runtime/field/contour.h"
#include "runtime/field/field.h"

/* Close it in any case. */
typedef struct tn_open_field {
    tn_field_meshes meshes;
    tn_field field;
} tn_open_field;

/* The surface of this name, or (NULL) the last of the file. */
tn_status tn_open_field_of(const tn_opened *opened, const char *name, tn_open_field *open, tn_error *error);
void tn_open_field_close(tn_open_field *open);

/* Adds a warning that has no place in the file. */
void tn_field_warn(tn_opened *opened, tn_code code, const char *help, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Warns where nothing or everything is inside, where the box cuts the form, of samples without value, and of
 * jumps; `jumps` says what is there. */
void tn_field_warn_of_contour(tn_opened *opened, const tn_contour *contour, const char *jumps);

#endif
