/* Finds what texts name below a folder that is served. */
#include "driver/open/served.h"

#include <stdlib.h>
#include <string.h>

#include "compiler/common/compilation.h"
#include "driver/open/missing.h"
#include "driver/open/stdlib.h"
#include "runtime/geometry/boundary_mesh.h"

void tn_served_begin(tn_served_files *files, const tn_served *served, tn_overlay *overlay, void *context)
{
    files->served = served;
    tn_kept_begin(&files->kept, overlay, context);
}

void tn_served_clear(tn_served_files *files)
{
    tn_kept_clear(&files->kept);
}

/* ---- paths */

/* Takes the last part off a path that ends with "/": "/a/b/" to "/a/". False at the folder itself. */
static bool leave(char *path, size_t *size)
{
    if (*size <= 1)
        return false;
    (*size)--;
    while (path[*size - 1] != '/')
        (*size)--;
    return true;
}

/* Adds a relative path to that of a folder, which has room for it. False if it leads out of what is served. */
static bool follow(char *to, size_t size, const char *path)
{
    while (*path) {
        size_t length = strcspn(path, "/");
        bool last = path[length] == '\0';
        if (length == 2 && memcmp(path, "..", 2) == 0) {
            if (!leave(to, &size))
                return false;
        } else if (length > 0 && !(length == 1 && *path == '.')) {
            memcpy(to + size, path, length);
            size += length;
            if (!last)
                to[size++] = '/';
        }
        path += length + !last;
    }
    to[size] = '\0';
    return true;
}

static tn_status refuse(const tn_request *request, const char *why, tn_error *error)
{
    tn_fail(error, TN_INVALID, E_IMPORT_NOT_FOUND, "`%.300s` %s", request->path, why);
    tn_error_help(error, "only files of the folder that is open here are read: name them from this file on");
    return TN_INVALID;
}

/* Where what is named lies; the caller frees it. */
static tn_status find_place(const tn_request *request, char **place, tn_error *error)
{
    const char *user = request->user, *slash = strrchr(user, '/');
    size_t folder = user[0] == '/' && slash ? (size_t)(slash - user) + 1 : 0;
    *place = NULL;
    if (request->path[0] == '/')
        return refuse(request, "is the path of a file somewhere on this machine", error);
    char *made = malloc(folder + strlen(request->path) + 2);
    if (!made)
        return tn_fail_memory(error);
    memcpy(made, folder ? user : "/", folder ? folder : 1);
    if (!follow(made, folder ? folder : 1, request->path)) {
        free(made);
        return refuse(request, "leads out of the folder", error);
    }
    *place = made;
    return TN_OK;
}

/* ---- reading */

/* The key is the path. */
static tn_status read_text(void *context, tn_kept_text *file, tn_error *error)
{
    const tn_served_files *files = context;
    if (tn_kept_overlaid(&files->kept, file->key, file))
        return TN_OK;
    if (!files->served->read)
        return tn_fail(error, TN_IO, E_CANNOT_READ, "there is no file %.300s", file->key + 1);
    tn_status status = files->served->read(files->served->context, file->key, &file->bytes, &file->size, error);
    file->text = (const char *)file->bytes;
    return status;
}

static tn_status find_file(tn_served_files *files, const tn_request *request, const tn_kept_text **found,
                           tn_error *error)
{
    char *place;
    tn_status status = find_place(request, &place, error);
    return status == TN_OK ? tn_kept_get(&files->kept, place, read_text, files, found, error) : status;
}

/* ---- what texts use */

static tn_status find_used(void *context, const tn_request *request, tn_input *found, char *meant, tn_error *error)
{
    const tn_kept_text *file;
    (void)meant;
    if (tn_path_is_bare(request->path)) {
        tn_fail(error, TN_INVALID, E_IMPORT_NOT_FOUND, "the standard library has no `%.400s`", request->path);
        tn_error_help(error, "for a file of yours write its extension too: `use \"%.200s%s\"`", request->path,
                      request->extension);
        return TN_INVALID;
    }
    tn_status status = find_file(context, request, &file, error);
    if (status == TN_OK)
        *found = (tn_input){.text = file->text, .size = file->size, .name = file->key};
    return status;
}

tn_status tn_served_find(void *context, const tn_request *request, tn_input *found, char *meant, tn_error *error)
{
    tn_stdlib_resolver own = {{find_used, context}};
    const tn_resolver all = tn_stdlib_resolver_of(&own);
    return all.resolve(all.context, request, found, meant, error);
}

tn_resolver tn_served_resolver(tn_served_files *files)
{
    return (tn_resolver){tn_served_find, files};
}

/* ---- what lies beside them */

static tn_status read_bytes(void *context, const tn_request *request, uint8_t **bytes, size_t *size, tn_error *error)
{
    const tn_kept_text *file;
    if (strcmp(request->extension, TN_LDRAW_LIBRARY) == 0)
        return tn_fail(error, TN_IO, E_CANNOT_READ, "the LDraw library, which has %.120s, is not read here",
                       request->path);
    tn_status status = find_file(context, request, &file, error);
    if (status != TN_OK)
        return status;
    *size = file->size;
    *bytes = malloc(file->size + 1);
    if (!*bytes)
        return tn_fail_memory(error);
    memcpy(*bytes, file->text, file->size);
    (*bytes)[file->size] = '\0';
    return TN_OK;
}

static tn_status refuse_mesh(void *context, const char *path, tn_mesh *mesh, tn_error *error)
{
    (void)context, (void)mesh;
    tn_fail(error, TN_INVALID, E_CANNOT_READ, "the mesh %.300s is not read here", path);
    tn_error_help(error, "the command `tartan` reads meshes from files");
    return TN_INVALID;
}

const tn_mesh_reader tn_no_meshes = {refuse_mesh, NULL};

static tn_status refuse_attached_mesh(void *context, const tn_request *request, tn_mesh *mesh, tn_error *error)
{
    return refuse_mesh(context, request->path, mesh, error);
}

tn_attachments tn_served_attachments(tn_served_files *files)
{
    return (tn_attachments){.bytes = read_bytes, .mesh = refuse_attached_mesh, .context = files};
}
