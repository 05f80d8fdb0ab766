/* The files of the page, which are built into the program (tools/embed-page): no path that a browser names is opened.
 */
#ifndef TARTAN_STUDIO_SERVER_PAGE_FILES_H
#define TARTAN_STUDIO_SERVER_PAGE_FILES_H

#include <stddef.h>

typedef struct tn_page_file {
    const char *path; /* "/app.js"; that of index.html is "/" */
    const char *type;
    const unsigned char *bytes, *packed; /* packed by gzip; NULL if that is hardly smaller */
    size_t size, packed_size;
} tn_page_file;

extern const tn_page_file tn_page_files[];
extern const size_t tn_page_file_count;

#endif
