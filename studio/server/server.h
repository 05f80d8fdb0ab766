/* The server: the page's files and a socket for each window, on a port of 127.0.0.1 and ::1, for whoever knows the
 * token (gate.h). One thread runs it; windows have threads of their own. */
#ifndef TARTAN_STUDIO_SERVER_SERVER_H
#define TARTAN_STUDIO_SERVER_SERVER_H

#include <stddef.h>

#include "studio/server/folder.h"

/* The files of the page, which are built into the program (tools/embed-page): no path that a browser names is opened.
 */

typedef struct tn_page_file {
    const char *path; /* "/app.js"; that of index.html is "/" */
    const char *type;
    const unsigned char *bytes, *packed; /* packed by gzip; NULL if that is hardly smaller */
    size_t size, packed_size;
} tn_page_file;

extern const tn_page_file tn_page_files[];
extern const size_t tn_page_file_count;

typedef struct tn_server_options {
    tn_studio_folder *folder; /* borrowed, as the next */
    const char *open;         /* a file below it to begin with, or NULL */
    unsigned port;            /* 0: a free one */
    uint64_t memory_limit;    /* of the process, for each question; 0: none */
} tn_server_options;

typedef struct tn_server tn_server;

/* Opens the port. TN_IO (E0909) if it is taken or may not be had, TN_MEMORY, TN_INTERNAL. */
tn_status tn_server_new(const tn_server_options *options, tn_server **server, tn_error *error);

/* Where it is: with the token, for people; and good for one page, for a command line. */
const char *tn_server_address(const tn_server *server);
const char *tn_server_address_once(const tn_server *server);

/* Serves until tn_server_end. */
void tn_server_run(tn_server *server);

/* Lets it end, from any thread. */
void tn_server_end(tn_server *server);

/* Closes all windows, and frees it. False: some are still at work and have to be left behind, with the server and the
 * folder. */
bool tn_server_free(tn_server *server);

#endif
