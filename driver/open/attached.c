/* Reads what lies beside a rule file. */
#include "driver/open/attached.h"

#include <stdlib.h>

#include "driver/open/missing.h"
#include "driver/open/suggest_file.h"
#include "runtime/base/file.h"
#include "runtime/mesh/openmesh.h"

enum { BYTES_MAX = 1 << 30 };

/* Where the file is; the caller frees it. */
static tn_status find(const tn_request *request, char **path, tn_error *error)
{
    *path = tn_path_beside(request->user, request->path, "");
    if (!*path)
        return tn_fail_memory(error);
    if (tn_path_exists(*path))
        return TN_OK;
    tn_fail(error, TN_IO, E_CANNOT_READ, "there is no file %.300s", *path);
    if (!tn_suggest_file(*path, error))
        tn_error_help(error, "a path starts at the folder of the file that names it");
    return TN_IO;
}

static tn_status read_bytes(void *context, const tn_request *request, uint8_t **bytes, size_t *size, tn_error *error)
{
    char *path;
    (void)context;
    tn_status status = find(request, &path, error);
    if (status == TN_OK)
        status = tn_file_read(path, BYTES_MAX, bytes, size, error);
    free(path);
    return status;
}

static tn_status read_mesh(void *context, const tn_request *request, tn_mesh *mesh, tn_error *error)
{
    char *path;
    (void)context;
    tn_status status = find(request, &path, error);
    if (status == TN_OK)
        status = tn_openmesh_read(path, mesh, error);
    free(path);
    return status;
}

const tn_attachments tn_file_attachments = {.bytes = read_bytes, .mesh = read_mesh};
