#include "studio/server/file_requests.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/utf8.h"

enum { INVALID_PARAMS = -32602, REQUEST_FAILED = -32803, INTERNAL_ERROR = -32603 };

/* ---- answers */

static json_t *answer(const json_t *message, json_t *result)
{
    const json_t *id = json_object_get(message, "id");
    if (id && result)
        return json_pack("{s:s,s:O,s:o}", "jsonrpc", "2.0", "id", id, "result", result);
    json_decref(result);
    return id ? json_pack("{s:s,s:O,s:{s:i,s:s}}", "jsonrpc", "2.0", "id", id, "error", "code", INTERNAL_ERROR,
                          "message", "out of memory")
              : NULL;
}

/* Takes over `data`. */
static json_t *refuse(const json_t *message, int code, const char *why, json_t *data)
{
    const json_t *id = json_object_get(message, "id");
    if (id && data)
        return json_pack("{s:s,s:O,s:{s:i,s:s,s:o}}", "jsonrpc", "2.0", "id", id, "error", "code", code, "message", why,
                         "data", data);
    json_decref(data);
    return NULL;
}

static json_t *fail(const json_t *message, const tn_error *error)
{
    char code[16] = "";
    if (error->code != TN_CODE_NONE)
        snprintf(code, sizeof code, "E%04d", error->code);
    json_t *data = json_pack("{s:s}", "code", code);
    if (data && error->help[0])
        json_object_set_new(data, "help", json_string(error->help));
    return refuse(message, REQUEST_FAILED, error->message, data);
}

static json_t *misused(const json_t *message, const char *why)
{
    return refuse(message, INVALID_PARAMS, why, json_object());
}

static json_t *hash_or_null(const tn_file_hash *hash)
{
    return hash->text[0] ? json_string(hash->text) : json_null();
}

/* ---- what is asked for */

/* A name that a page may use; NULL, and the refusal, if there is none. */
static const char *name_of(const json_t *message, const json_t *params, json_t **refusal)
{
    tn_error error;
    const char *name = json_string_value(json_object_get(params, "path"));
    if (!name)
        *refusal = misused(message, "`path` is missing");
    else if (tn_studio_name_check(name, &error) == TN_OK)
        return name;
    else
        *refusal = fail(message, &error);
    return NULL;
}

/* The hash last seen, none if there is null. False: it is neither. */
static bool read_hash(const json_t *params, tn_file_hash *hash)
{
    const json_t *said = json_object_get(params, "hash");
    const char *text = json_string_value(said);
    *hash = (tn_file_hash){""};
    if (text && strlen(text) == sizeof hash->text - 1)
        memcpy(hash->text, text, sizeof hash->text);
    return json_is_null(said) || hash->text[0];
}

/* ---- the requests */

typedef json_t *request(tn_file_requests *requests, const json_t *message, const json_t *params);

static json_t *list_of(const tn_studio_files *list)
{
    json_t *files = json_array();
    for (size_t i = 0; files && i < list->count; i++) {
        const tn_studio_file *file = &list->files[i];
        json_t *row =
            json_pack("{s:s,s:I,s:s}", "path", file->name, "size", (json_int_t)file->size, "notation", file->notation);
        if (json_array_append_new(files, row) != 0) {
            json_decref(files);
            return NULL;
        }
    }
    return files;
}

static json_t *say_files(tn_file_requests *requests, const json_t *message, const json_t *params)
{
    (void)params;
    tn_studio_files list;
    tn_error error;
    json_t *answered;
    if (tn_studio_folder_list(requests->folder, &list, &error) != TN_OK) {
        answered = fail(message, &error);
    } else {
        json_t *result = json_pack("{s:s,s:b,s:s?,s:o,s:b}", "folder", tn_studio_folder_path(requests->folder),
                                   "readOnly", tn_studio_folder_read_only(requests->folder), "open", requests->open,
                                   "files", list_of(&list), "cut", list.cut);
        answered = answer(message, result);
    }
    tn_studio_files_clear(&list);
    return answered;
}

static json_t *read_file(tn_file_requests *requests, const json_t *message, const json_t *params)
{
    json_t *answered;
    uint8_t *bytes;
    size_t size;
    tn_error error;
    const char *name = name_of(message, params, &answered);
    if (!name)
        return answered;
    if (tn_studio_folder_read(requests->folder, name, TN_TEXT_MAX, &bytes, &size, &error) != TN_OK)
        return fail(message, &error);
    if (!tn_is_utf8((const char *)bytes, size) || memchr(bytes, '\0', size)) {
        tn_fail(&error, TN_INVALID, E_INVALID_UTF8, "%.300s is not UTF-8 text", name);
        answered = fail(message, &error);
    } else {
        tn_file_hash hash = tn_hash_of_bytes(bytes, size);
        answered = answer(
            message, json_pack("{s:s,s:s%,s:s}", "path", name, "text", (const char *)bytes, size, "hash", hash.text));
    }
    free(bytes);
    return answered;
}

/* The window's own change is no news to it. */
static void note_written(tn_file_requests *requests, const char *name, const tn_file_hash *hash)
{
    for (size_t i = 0; i < requests->watched_count; i++) {
        tn_watched_file *file = &requests->watched[i];
        if (strcmp(file->name, name) == 0) {
            file->hash = *hash;
            file->stamp = tn_studio_folder_stamp(requests->folder, name);
        }
    }
}

static json_t *write_file(tn_file_requests *requests, const json_t *message, const json_t *params)
{
    json_t *answered;
    tn_file_hash seen, now;
    tn_error error;
    bool conflict;
    const char *name = name_of(message, params, &answered);
    const json_t *text = json_object_get(params, "text");
    if (!name)
        return answered;
    if (!json_is_string(text))
        return misused(message, "`text` is missing");
    if (!read_hash(params, &seen))
        return misused(message, "`hash` is to be the one last seen, or null for a new file");
    if (tn_studio_folder_write(requests->folder, name, json_string_value(text), json_string_length(text), &seen, &now,
                               &conflict, &error) != TN_OK)
        return fail(message, &error);
    if (conflict)
        return refuse(message, REQUEST_FAILED, "the file is not as it was last seen",
                      json_pack("{s:s,s:o}", "code", "conflict", "hash", hash_or_null(&now)));
    note_written(requests, name, &now);
    return answer(message, json_pack("{s:s,s:s}", "path", name, "hash", now.text));
}

static void forget_watched(tn_file_requests *requests)
{
    for (size_t i = 0; i < requests->watched_count; i++)
        free(requests->watched[i].name);
    requests->watched_count = 0;
}

/* The refusal, if it cannot be watched. */
static json_t *watch_file(tn_file_requests *requests, const json_t *message, const json_t *said)
{
    json_t *refusal;
    tn_watched_file file = {0};
    const char *name = name_of(message, said, &refusal);
    if (!name)
        return refusal;
    if (!read_hash(said, &file.hash))
        return misused(message, "`hash` is to be that of the text that is shown, or null");
    file.name = strdup(name);
    file.stamp.file = UINT64_MAX; /* no file's: it is compared at the next look */
    if (file.name)
        requests->watched[requests->watched_count++] = file;
    return NULL;
}

static json_t *watch(tn_file_requests *requests, const json_t *message, const json_t *params)
{
    const json_t *paths = json_object_get(params, "paths"), *said;
    size_t i;
    if (!json_is_array(paths) || json_array_size(paths) > TN_WATCHED_MAX)
        return misused(message, "`paths` is to be a list of at most 256 files");
    forget_watched(requests);
    json_array_foreach(paths, i, said)
    {
        json_t *refusal = watch_file(requests, message, said);
        if (refusal)
            return refusal;
    }
    return answer(message, json_null());
}

static const struct {
    const char *method;
    request *request;
} methods[] = {
    {"tartan/files", say_files},
    {"tartan/read", read_file},
    {"tartan/write", write_file},
    {"tartan/watch", watch},
};

static request *find(const char *method)
{
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++)
        if (strcmp(methods[i].method, method) == 0)
            return methods[i].request;
    return NULL;
}

bool tn_file_requests_takes(const char *method)
{
    return find(method) != NULL;
}

json_t *tn_file_requests_answer(tn_file_requests *requests, const json_t *message)
{
    request *found = find(json_string_value(json_object_get(message, "method")));
    return found(requests, message, json_object_get(message, "params"));
}

void tn_file_requests_clear(tn_file_requests *requests)
{
    forget_watched(requests);
}

/* ---- what others change */

static json_t *say_changed(const char *name, const tn_file_hash *hash)
{
    return json_pack("{s:s,s:s,s:{s:s,s:o}}", "jsonrpc", "2.0", "method", "tartan/changed", "params", "path", name,
                     "hash", hash_or_null(hash));
}

json_t *tn_file_requests_changed(tn_file_requests *requests, size_t *next)
{
    while (*next < requests->watched_count) {
        tn_watched_file *file = &requests->watched[(*next)++];
        tn_file_stamp stamp = tn_studio_folder_stamp(requests->folder, file->name);
        if (memcmp(&stamp, &file->stamp, sizeof stamp) == 0)
            continue;
        tn_file_hash hash = tn_studio_folder_hash(requests->folder, file->name);
        bool same = strcmp(hash.text, file->hash.text) == 0;
        file->stamp = stamp;
        file->hash = hash;
        if (!same)
            return say_changed(file->name, &hash);
    }
    return NULL;
}

json_t *tn_file_requests_tell(const tn_file_requests *requests, const char *name)
{
    for (size_t i = 0; i < requests->watched_count; i++)
        if (strcmp(requests->watched[i].name, name) == 0)
            return NULL;
    tn_file_hash hash = tn_studio_folder_hash(requests->folder, name);
    return say_changed(name, &hash);
}
