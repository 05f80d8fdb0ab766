/* What `tartan house` writes: files of a house, by the ends of their names. */
#ifndef TARTAN_CLI_HOUSE_FILES_H
#define TARTAN_CLI_HOUSE_FILES_H

#include "cli/common/job.h"
#include "runtime/house/model/aspect.h"

/* What the options say of drawings and files. */
typedef struct tn_house_outputs {
    tn_option_list files; /* paths; a folder stands for a file of every format in it */
    tn_option_list views;
    const char *title, *cut;
    int furnish; /* 1: no */
    tn_option_number scale, dpi;
    tn_option_real azimuth, elevation;
    const char *name; /* what the house is called, for titles and notes; NULL: by its line */
} tn_house_outputs;

/* Do the names of all files say a format, and is one a drawing where options ask for that? Otherwise wrong usage is
 * recorded. */
bool tn_house_files_known(tn_job *job, const tn_house_outputs *outputs);

/* Writes them; with none, the line of the house. */
void tn_house_files_write(tn_job *job, const tn_house *house, const tn_house_outputs *outputs);

/* ---- views.c */

/* The drawings that --view and the other options ask for; all that make a sheet where nothing is said. `aspects` has
 * room for TN_HOUSE_VIEWS_MAX. 0 where an option is wrong, which is recorded. */
#define TN_HOUSE_VIEWS_MAX 128u
size_t tn_house_views(tn_job *job, const tn_house *house, const tn_house_outputs *outputs, tn_aspect *aspects);

#endif
