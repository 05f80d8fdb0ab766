#include "compiler/common/import.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "compiler/common/limits.h"
#include "runtime/base/file.h"
#include "runtime/base/nearest.h"

enum { REACH_WORDS = (TN_FILES_MAX + 63) / 64 };

typedef struct tn_importer {
    tn_arena *arena;
    tn_diagnostics *diagnostics;
    const char *const *stdlib_dirs;
    size_t stdlib_dir_count;
    const char *notation;  /* extension of the notation's files */
    const char *extension; /* of what is being followed */
    tn_parse_unit *parse;
    tn_unit *all[TN_FILES_MAX];   /* in the order they were met */
    tn_unit *chain[TN_FILES_MAX]; /* whose uses are being followed, outermost first */
    size_t all_count, chain_count;
    tn_imports *imports;
} tn_importer;

static const char *join(tn_importer *importer, const char *folder, size_t folder_size, const char *name,
                        const char *extension)
{
    size_t size = folder_size + strlen(name) + strlen(extension) + 2;
    char *path = tn_arena_alloc(importer->arena, size);
    if (path)
        snprintf(path, size, "%.*s%s%s%s", (int)folder_size, folder,
                 folder_size > 0 && folder[folder_size - 1] != '/' ? "/" : "", name, extension);
    return path;
}

/* The file's real path; the path itself where the file system knows of no such file (a text in memory). */
static const char *identify(tn_importer *importer, const char *path)
{
    char *real = realpath(path, NULL);
    const char *identity = tn_arena_copy(importer->arena, real ? real : path, strlen(real ? real : path));
    free(real);
    return identity;
}

static bool is_bare(const char *path)
{
    return path[0] != '\0' && !strchr(path, '/') && !strchr(path, '.');
}

/* Is there something to read? What it is (a folder, a file that may not be read) reading will say. */
static bool exists(const char *path)
{
    return access(path, F_OK) == 0;
}

/* A path relative to the folder of the file that uses it. */
static const char *beside(tn_importer *importer, const char *user, const char *path, const char *extension)
{
    const char *slash = path[0] == '/' ? NULL : strrchr(user, '/');
    return join(importer, user, slash ? (size_t)(slash - user) + 1 : 0, path, extension);
}

/* The path that a `use` means, whether it is in the standard library; NULL where there is no such file. */
static const char *find(tn_importer *importer, const char *user, const char *path, bool *is_stdlib)
{
    *is_stdlib = is_bare(path);
    if (!*is_stdlib) {
        const char *found = beside(importer, user, path, "");
        return found && exists(found) ? found : NULL;
    }
    for (size_t i = 0; i < importer->stdlib_dir_count; i++) {
        const char *found =
            join(importer, importer->stdlib_dirs[i], strlen(importer->stdlib_dirs[i]), path, importer->extension);
        if (found && exists(found))
            return found;
    }
    return NULL;
}

/* ---- what is wrong */

static int compare_texts(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* The file names in a folder that end in the extension, sorted; without the extension where `bare`. */
static size_t list_folder(tn_importer *importer, const char *folder, bool bare, const char **names, size_t room)
{
    DIR *directory = opendir(folder);
    size_t count = 0, extension_size = strlen(importer->extension);
    for (struct dirent *entry; directory && count < room && (entry = readdir(directory));) {
        size_t size = strlen(entry->d_name);
        if (size <= extension_size || strcmp(entry->d_name + size - extension_size, importer->extension) != 0)
            continue;
        names[count] = tn_arena_copy(importer->arena, entry->d_name, bare ? size - extension_size : size);
        count += names[count] != NULL;
    }
    if (directory)
        closedir(directory);
    qsort(names, count, sizeof *names, compare_texts);
    return count;
}

static void suggest_path(tn_importer *importer, tn_diagnostic *d, const tn_use *use, const char *near)
{
    const char *last = strrchr(use->path, '/');
    int folder = last ? (int)(last - use->path) + 1 : 0;
    tn_help(importer->diagnostics, d, "did you mean `%.*s%s`?", folder, use->path, near);
    tn_replace_with(importer->diagnostics, d, "\"%.*s%s\"", folder, use->path, near);
}

static void report_missing(tn_importer *importer, const tn_use *use, const char *user)
{
    enum { ROOM = 512 };
    const char *names[ROOM];
    size_t count = 0;
    bool bare = is_bare(use->path);
    tn_diagnostic *d =
        bare ? tn_report(importer->diagnostics, E_IMPORT_NOT_FOUND, use->span, "the standard library has no `%s`",
                         use->path)
             : tn_report(importer->diagnostics, E_IMPORT_NOT_FOUND, use->span, "there is no file `%s`", use->path);
    if (bare) {
        for (size_t i = 0; i < importer->stdlib_dir_count; i++)
            count += list_folder(importer, importer->stdlib_dirs[i], true, names + count, ROOM - count);
    } else {
        const char *path = beside(importer, user, use->path, "");
        const char *slash = path ? strrchr(path, '/') : NULL;
        const char *folder = join(importer, slash ? path : ".", slash ? (size_t)(slash - path) + 1 : 1, "", "");
        count = folder ? list_folder(importer, folder, false, names, ROOM) : 0;
    }
    const char *last = strrchr(use->path, '/');
    const char *near = tn_nearest(last ? last + 1 : use->path, names, count);
    const char *neighbour = bare ? beside(importer, user, use->path, importer->extension) : NULL;
    if (neighbour && exists(neighbour))
        tn_help(importer->diagnostics, d, "for the file beside this one write `use \"%s%s\"`", use->path,
                importer->extension);
    else if (near)
        suggest_path(importer, d, use, near);
    else if (bare)
        tn_help(importer->diagnostics, d, "for a file of yours write its extension too: `use \"%s%s\"`", use->path,
                importer->extension);
    else
        tn_help(importer->diagnostics, d, "the path starts at the folder of the file that names it");
}

static void report_cycle(tn_importer *importer, const tn_use *use, const tn_unit *again)
{
    const tn_source *files = importer->diagnostics->sources->files;
    char text[400];
    size_t start = 0, used = 0;
    while (importer->chain[start] != again)
        start++;
    for (size_t i = start; i < importer->chain_count && used < sizeof text; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "%s uses ", files[importer->chain[i]->file].path);
    tn_diagnostic *d =
        tn_report(importer->diagnostics, E_IMPORT_CYCLE, use->span, "files use each other in a circle: %.*s%s",
                  (int)(used < sizeof text ? used : sizeof text - 1), text, files[again->file].path);
    tn_help(importer->diagnostics, d, "%s",
            start + 1 == importer->chain_count ? "a file need not use itself: leave this out"
                                               : "put what they share into a file of its own, which uses neither");
}

/* ---- following */

static tn_status load(tn_importer *importer, uint32_t file, const char *identity, const char *recorded,
                      tn_unit **result);

/* From what stands in for the file, or from the disk. */
static tn_status read_source(tn_sources *sources, const char *path, const char *identity, uint32_t *file,
                             tn_error *error)
{
    const char *text;
    uint8_t *bytes;
    size_t size;
    if (sources->overlay && sources->overlay(sources->overlay_context, identity, &text, &size))
        return tn_sources_add(sources, path, text, size, file, error);
    tn_status status = tn_file_read(path, TN_SOURCE_BYTES_MAX, &bytes, &size, error);
    if (status != TN_OK)
        return status;
    status = tn_sources_add(sources, path, (const char *)bytes, size, file, error);
    free(bytes);
    return status;
}

/* Reads a file that is used into the sources; *unit stays NULL where that fails. */
static tn_status read_unit(tn_importer *importer, const tn_use *use, const char *path, const char *identity,
                           bool is_stdlib, tn_unit **unit)
{
    tn_error error;
    uint32_t file;
    if (importer->all_count == TN_FILES_MAX) {
        tn_diagnostic *d = tn_report(importer->diagnostics, E_TOO_MANY, use->span,
                                     "this is one file more than the limit of %u files", TN_FILES_MAX);
        tn_help(importer->diagnostics, d, "put the rules into fewer files");
        return TN_OK;
    }
    tn_status status = read_source(importer->diagnostics->sources, path, identity, &file, &error);
    if (status == TN_MEMORY)
        return status;
    if (status != TN_OK) {
        tn_diagnostic *d = tn_report(importer->diagnostics, (tn_code)error.code, use->span, "%s", error.message);
        tn_help(importer->diagnostics, d, "%s", error.help[0] ? error.help : "see that it is a file that may be read");
        return TN_OK;
    }
    const char *recorded = path;
    if (is_stdlib)
        recorded = join(importer, "<stdlib>", 8, use->path, importer->extension);
    return load(importer, file, identity, recorded, unit);
}

static tn_unit *known(const tn_importer *importer, const char *identity)
{
    for (size_t i = 0; i < importer->all_count; i++)
        if (strcmp(importer->all[i]->identity, identity) == 0)
            return importer->all[i];
    return NULL;
}

/* Follows one `use` of a unit. */
static tn_status follow(tn_importer *importer, tn_unit *unit, tn_use *use)
{
    const char *user = importer->diagnostics->sources->files[unit->file].path;
    bool is_stdlib;
    importer->extension = use->extension ? use->extension : importer->notation;
    const char *path = find(importer, user, use->path, &is_stdlib);
    if (!path) {
        report_missing(importer, use, user);
        unit->incomplete = true;
        return TN_OK;
    }
    const char *identity = identify(importer, path);
    if (!identity)
        return TN_MEMORY;
    tn_unit *used = known(importer, identity);
    if (used && used->loading) {
        report_cycle(importer, use, used);
        unit->incomplete = true;
        return TN_OK;
    }
    tn_status status = used ? TN_OK : read_unit(importer, use, path, identity, is_stdlib, &used);
    if (status != TN_OK)
        return status;
    use->unit = used;
    unit->incomplete |= !used || used->incomplete;
    for (size_t i = 0; used && i < REACH_WORDS; i++)
        unit->reach[i] |= used->reach[i];
    return TN_OK;
}

/* Parses a source and follows its uses. Recursion is as deep as files nest, at most TN_FILES_MAX. */
static tn_status load(tn_importer *importer, uint32_t file, const char *identity, const char *recorded,
                      tn_unit **result)
{
    tn_unit *unit = TN_NEW(importer->arena, tn_unit);
    uint64_t *reach = TN_NEW_ARRAY(importer->arena, uint64_t, REACH_WORDS);
    if (!unit || !reach || !recorded)
        return TN_MEMORY;
    *unit = (tn_unit){.file = file, .identity = identity, .recorded = recorded, .loading = true, .reach = reach};
    importer->all[importer->all_count++] = unit;
    importer->chain[importer->chain_count++] = unit;
    tn_use *uses = NULL;
    size_t use_count = 0;
    if (!importer->parse(importer->arena, importer->diagnostics, file, &unit->tree, &uses, &use_count))
        return TN_MEMORY;
    for (size_t i = 0; i < use_count; i++) {
        tn_status status = follow(importer, unit, &uses[i]);
        if (status != TN_OK)
            return status;
    }
    size_t index = importer->imports->count++;
    importer->imports->units[index] = unit;
    unit->reach[index / 64] |= UINT64_C(1) << (index % 64);
    unit->loading = false;
    importer->chain_count--;
    *result = unit;
    return TN_OK;
}

tn_status tn_import_all(tn_arena *arena, tn_diagnostics *diagnostics, const char *const *stdlib_dirs,
                        size_t stdlib_dir_count, const char *extension, tn_parse_unit *parse, uint32_t main_file,
                        tn_imports *imports)
{
    tn_importer *state = TN_NEW(arena, tn_importer);
    imports->units = TN_NEW_ARRAY(arena, tn_unit *, TN_FILES_MAX);
    imports->count = 0;
    if (!state || !imports->units)
        return TN_MEMORY;
    *state = (tn_importer){.arena = arena,
                           .diagnostics = diagnostics,
                           .stdlib_dirs = stdlib_dirs,
                           .stdlib_dir_count = stdlib_dir_count,
                           .notation = extension,
                           .extension = extension,
                           .parse = parse,
                           .imports = imports};
    const char *path = diagnostics->sources->files[main_file].path;
    const char *identity = identify(state, path);
    const char *recorded = tn_arena_copy(arena, path, strlen(path));
    tn_unit *unit = NULL;
    if (!identity || !recorded)
        return TN_MEMORY;
    return load(state, main_file, identity, recorded, &unit);
}
