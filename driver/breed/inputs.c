/* Hashes what a run's scores depend on, and finds what has changed. */
#include "driver/breed/inputs.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <xxhash.h>

#include "runtime/base/file.h"

static const char *last_part(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static tn_status add_line(char **inputs, const char *kind, const char *name, uint64_t hash, tn_error *error)
{
    char *longer = NULL;
    if (asprintf(&longer, "%s%016" PRIx64 " %s %s\n", *inputs ? *inputs : "", hash, kind, last_part(name)) < 0)
        return tn_fail_memory(error);
    free(*inputs);
    *inputs = longer;
    return TN_OK;
}

tn_status tn_inputs_add(char **inputs, const char *kind, const char *name, const void *bytes, size_t size,
                        tn_error *error)
{
    return add_line(inputs, kind, name, XXH3_64bits(bytes, size), error);
}

static tn_status hash_file(FILE *in, const char *path, uint64_t *hash, tn_error *error)
{
    static const size_t room = 1 << 16;
    char *bytes = malloc(room);
    XXH3_state_t *state = XXH3_createState();
    tn_status status = bytes && state ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK)
        XXH3_64bits_reset(state);
    for (size_t got; status == TN_OK && (got = fread(bytes, 1, room, in)) > 0;)
        XXH3_64bits_update(state, bytes, got);
    if (status == TN_OK && ferror(in))
        status = tn_cannot_read(path, errno, error);
    if (status == TN_OK)
        *hash = XXH3_64bits_digest(state);
    XXH3_freeState(state);
    free(bytes);
    return status;
}

tn_status tn_inputs_add_file(char **inputs, const char *kind, const char *path, tn_error *error)
{
    struct stat known;
    uint64_t hash = 0;
    if (stat(path, &known) == 0 && !S_ISREG(known.st_mode))
        return TN_OK;
    FILE *in = fopen(path, "rbe");
    if (!in)
        return tn_cannot_read(path, errno, error);
    tn_status status = hash_file(in, path, &hash, error);
    fclose(in);
    return status == TN_OK ? add_line(inputs, kind, path, hash, error) : status;
}

tn_status tn_inputs_add_sources(char **inputs, const char *kind, const tn_module *module, uint32_t skipped,
                                tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < module->SOURCE_count && status == TN_OK; i++) {
        const tn_source_record *source = &module->SOURCE_records[i];
        const char *text = tn_text(module, source->text);
        if (i != skipped)
            status = tn_inputs_add(inputs, kind, tn_text(module, source->path), text, strlen(text), error);
    }
    return status;
}

/* Is this line, of so many bytes, among those of the text? */
static bool has_line(const char *text, const char *line, size_t size)
{
    for (const char *at = text; *at; at += strcspn(at, "\n") + 1)
        if (strncmp(at, line, size + 1) == 0)
            return true;
    return false;
}

static bool find_missing(const char *lines, const char *text, char *name, size_t room)
{
    for (const char *line = lines; *line; line += strcspn(line, "\n") + 1) {
        size_t size = strcspn(line, "\n"), hash = strcspn(line, " ") + 1;
        if (has_line(text, line, size))
            continue;
        snprintf(name, room, "%.*s", (int)(size - hash), line + hash);
        return true;
    }
    return false;
}

void tn_inputs_difference(const char *before, const char *now, char *name, size_t size)
{
    name[0] = '\0';
    if (!find_missing(now, before, name, size))
        find_missing(before, now, name, size);
}
