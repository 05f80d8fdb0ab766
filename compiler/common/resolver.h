/* Where the compiler gets its texts from: its caller. The compiler itself opens no file.
 *
 * Whoever compiles a text hands it over as a tn_input, and with it a tn_resolver, which is asked for each `use`. It may
 * look in folders (driver/open/files.h), in an editor's buffers, in an archive or in a table.
 */
#ifndef TARTAN_COMPILER_COMMON_RESOLVER_H
#define TARTAN_COMPILER_COMMON_RESOLVER_H

#include <stdint.h>

#include "runtime/base/error.h"

/* A text to be compiled. Borrowed, all of it. */
typedef struct tn_input {
    const char *text;
    size_t size;
    const char *name;     /* what diagnostics call it */
    const char *identity; /* the same for the same text, whatever name leads to it; NULL: `name` */
    const char *recorded; /* what a module calls it; NULL: `name` */
} tn_input;

/* One `use`. */
typedef struct tn_request {
    const char *path;      /* as its author wrote it */
    const char *extension; /* of the notation that is asked for, ".plan": for paths that name none */
    const char *user;      /* the name of the text that it is written in */
} tn_request;

#define TN_MEANT_SIZE 320u

/* Finds what a `use` asks for. TN_OK: *found is filled, and stays valid until the compilation has ended. TN_MEMORY ends
 * the compilation. Any other status becomes an error at the `use`, with the code, message and help of `error`; `meant`,
 * TN_MEANT_SIZE bytes that start as an empty text, may then be given the path that was probably meant, which editors
 * offer to put in its place.
 *
 * Called by several threads at once where these compile with the same resolver. */
typedef tn_status tn_resolve(void *context, const tn_request *request, tn_input *found, char *meant, tn_error *error);

typedef struct tn_resolver {
    tn_resolve *resolve; /* NULL: there is nothing that can be used */
    void *context;
} tn_resolver;

struct tn_mesh; /* runtime/geometry/mesh.h */

/* Files that a text names without using them as texts: meshes, pictures, models made elsewhere. The request's path is
 * relative to the text that names it. A failure becomes an error at the name, with the message and help of `error`;
 * TN_MEMORY ends the compilation. Functions that are NULL: no file can be had. */
typedef struct tn_attachments {
    tn_status (*bytes)(void *context, const tn_request *request, uint8_t **bytes, size_t *size, tn_error *error);
    tn_status (*mesh)(void *context, const tn_request *request, struct tn_mesh *mesh, tn_error *error); /* to clear */
    void *context;
} tn_attachments;

#endif
