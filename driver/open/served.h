/* The files of one folder, as whoever serves them to others reads them: a program that shows rules in a browser, a page
 * that holds its files itself. No other file is opened.
 *
 * A path begins with "/", which is the folder: "/cabins.plan". What a text names is relative to the text; `..` ends at
 * the folder. Bare names are those of the standard library that is built in. */
#ifndef TARTAN_DRIVER_OPEN_SERVED_H
#define TARTAN_DRIVER_OPEN_SERVED_H

#include "driver/open/files.h"

typedef struct tn_served {
    /* Reads a file; a zero byte follows its bytes, which whoever asks frees. TN_IO if it is not there or may not be
     * read. Called by several threads. NULL: there is no file but the texts that stand in for one. */
    tn_status (*read)(void *context, const char *path, uint8_t **bytes, size_t *size, tn_error *error);
    /* Names the rule files of the folder; *paths and each of them are freed by whoever asks. *cut_off: there are more
     * than are looked at. NULL: none. Likewise called by several threads. */
    tn_status (*list)(void *context, char ***paths, size_t *count, bool *cut_off, tn_error *error);
    void *context;
} tn_served;

/* What was found for the texts that are compiled, each read once. */
typedef struct tn_served_files {
    const tn_served *served; /* borrowed */
    tn_kept_texts kept;
} tn_served_files;

void tn_served_begin(tn_served_files *files, const tn_served *served, tn_overlay *overlay, void *context);
void tn_served_clear(tn_served_files *files);

/* Finds what a text uses or names. The text and its name stay until the files are cleared. Several threads may ask. As
 * a tn_resolve (compiler/common/compilation.h), `context` the files; tn_served_resolver makes it one. */
tn_status tn_served_find(void *context, const tn_request *request, tn_input *found, char *meant, tn_error *error);
tn_resolver tn_served_resolver(tn_served_files *files);

/* What lies beside the texts: pictures, models. Meshes are not read. */
tn_attachments tn_served_attachments(tn_served_files *files);

/* Reads no mesh, and says so. */
extern const struct tn_mesh_reader tn_no_meshes;

#endif
