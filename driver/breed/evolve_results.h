/* Where the files of a run go: into its folder, or to whoever takes them. */
#ifndef TARTAN_DRIVER_BREED_EVOLVE_RESULTS_H
#define TARTAN_DRIVER_BREED_EVOLVE_RESULTS_H

#include <stdio.h>

#include "runtime/base/file.h"
#include "runtime/base/picture.h"

/* Whoever takes them, one after another. */
typedef struct tn_run_files {
    /* Gives the stream that the next file is written to. name: as it would have in the folder, "best/1.txt". */
    tn_status (*opens)(void *context, const char *name, FILE **stream, tn_error *error);
    /* Ends it after that status, which it returns unless ending it fails. */
    tn_status (*closes)(void *context, tn_status status, tn_error *error);
    void *context;
} tn_run_files;

/* A file on its way. */
typedef struct tn_run_file {
    const tn_run_files *files;
    FILE *stream; /* write here */
    tn_output output;
} tn_run_file;

/* Begins a file; files: NULL for the folder `dir`. End it if, and only if, that went well: the status so far is
 * returned unless ending it fails, and a file of which it is none goes to no folder. */
tn_status tn_run_file_begin(const char *dir, const tn_run_files *files, const char *name, tn_run_file *file,
                            tn_error *error);
tn_status tn_run_file_end(tn_run_file *file, tn_status status, tn_error *error);

/* A picture on its way. */
typedef struct tn_run_picture {
    const tn_run_files *files;
    const char *name; /* borrowed */
    char *path;       /* in the folder; owned */
    tn_picture to;    /* draw it here */
} tn_run_picture;

/* The same of a picture: its name says of which format. End it in any case. */
tn_status tn_run_picture_begin(const char *dir, const tn_run_files *files, const char *name, tn_run_picture *picture,
                               tn_error *error);
tn_status tn_run_picture_end(tn_run_picture *picture, tn_status status, tn_error *error);

#endif
