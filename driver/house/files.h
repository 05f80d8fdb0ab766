/* A house as files: its line, tables, models and drawings. */
#ifndef TARTAN_DRIVER_HOUSE_FILES_H
#define TARTAN_DRIVER_HOUSE_FILES_H

#include <stdio.h>

#include "runtime/base/formats.h"
#include "runtime/base/picture.h"
#include "runtime/base/watch.h"
#include "runtime/house/model/views.h"
#include "runtime/house/picture/draw.h"

/* In the order in which a folder of all has them. */
typedef enum tn_house_file {
    TN_HOUSE_AS_LINE,
    TN_HOUSE_AS_JSON,  /* everything, in nanometres */
    TN_HOUSE_AS_CSV,   /* the rooms with their areas */
    TN_HOUSE_AS_PARTS, /* what it is made of, and what that costs; CSV, too */
    TN_HOUSE_AS_OBJ,
    TN_HOUSE_AS_MTL, /* the materials that .obj cites */
    TN_HOUSE_AS_PLY,
    TN_HOUSE_AS_GLB,
    TN_HOUSE_AS_IFC,
    TN_HOUSE_AS_DXF,
    TN_HOUSE_AS_SVG,
    TN_HOUSE_AS_PDF,
    TN_HOUSE_AS_PNG,
    TN_HOUSE_FILES
} tn_house_file;

/* What such a file's name ends in, ".parts.csv" for example; NULL of a line. */
const char *tn_house_file_ending(tn_house_file kind);

/* By the ending of a name; TN_HOUSE_FILES if it says nothing. */
tn_house_file tn_house_file_of(const char *path);

/* What files of that kind hold. */
tn_file_format tn_house_file_format(tn_house_file kind);

/* Is it a drawing to scale, of views? */
bool tn_house_file_draws(tn_house_file kind);

/* A house and what its files say besides. All is borrowed. */
typedef struct tn_house_filed {
    const tn_house *house;
    const tn_solids *solids;
    const char *line;  /* the house's; NULL: not known yet */
    const char *title; /* of sheets and of models; NULL: what the form says of itself */
    const char *mtl;   /* of .obj: the file that has its materials; NULL: house.mtl */
    tn_views views;
    tn_drawing_says says; /* of drawings; of the building model the project, the date (tn_house_time_stamp) and north */
    const char *author;   /* of the building model; or NULL */
    const double *latitude, *longitude;
    uint32_t scale, dpi; /* of drawings, 1:scale; 0: as it suits, 150 */
    tn_profile profile;  /* of drawings: by whose custom they are drawn */
    tn_watch *watch;     /* or NULL */
} tn_house_filed;

/* The time stamp of a building model, by ISO 8601, of such a date, with or without the time of day; false: it is none. */
#define TN_TIME_STAMP_TEXT 20
bool tn_house_time_stamp(const char *date, char stamp[TN_TIME_STAMP_TEXT]);

/* Writes it to the stream. TN_INVALID (E0904) for wrong views; what fails with the stream, ferror() tells. */
tn_status tn_house_file_write(const tn_house_filed *filed, tn_house_file kind, FILE *out, tn_error *error);

#endif
