/* Reads what lies beside a rule file. */
#include "driver/open/attached.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compiler/common/compilation.h"
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

/* ---- the LDraw library */

/* Reads FOLDER/INNER/NAME; TN_OK with *there false where there is no such file. */
static tn_status read_there(const char *folder, const char *inner, const char *name, uint8_t **bytes, size_t *size,
                            bool *there, tn_error *error)
{
    char *path;
    *there = false;
    if (asprintf(&path, "%s/%s/%s", folder, inner, name) < 0)
        return tn_fail_memory(error);
    tn_status status = TN_OK;
    if (tn_path_exists(path)) {
        *there = true;
        status = tn_file_read(path, BYTES_MAX, bytes, size, error);
    }
    free(path);
    return status;
}

/* The nearest name among the library's parts, where there is a library. */
static void suggest_part(const char *folder, const char *name, tn_error *error)
{
    char *path;
    if (asprintf(&path, "%s/parts/%s", folder, name) < 0)
        return;
    if (tn_suggest_file(path, error)) {
        const char *near = strrchr(error->help, '/');
        if (near) {
            char named[256];
            snprintf(named, sizeof named, "%s", near + 1);
            tn_error_help(error, "did you mean `%s", named);
        }
    }
    free(path);
}

static tn_status read_part(const char *name, uint8_t **bytes, size_t *size, tn_error *error)
{
    static const char *const inner[] = {"parts", "p", "PARTS", "P"};
    const char *own = getenv("LDRAWDIR"), *folder = own && *own ? own : "/usr/share/ldraw";
    tn_status status = TN_OK;
    bool there = false;
    for (size_t i = 0; i < sizeof inner / sizeof *inner && status == TN_OK && !there; i++)
        status = read_there(folder, inner[i], name, bytes, size, &there, error);
    if (status != TN_OK || there)
        return status;
    tn_fail(error, TN_IO, E_CANNOT_READ, "there is no %.120s in the LDraw library %.200s", name, folder);
    tn_error_help(
        error,
        "name the folder of the library, which has the folders parts and p, by --ldraw or by the variable LDRAWDIR");
    suggest_part(folder, name, error);
    return TN_IO;
}

/* ---- what a kit names */

static tn_status read_bytes(void *context, const tn_request *request, uint8_t **bytes, size_t *size, tn_error *error)
{
    char *path;
    (void)context;
    if (strcmp(request->extension, TN_LDRAW_LIBRARY) == 0)
        return read_part(request->path, bytes, size, error);
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
