/* Finds and reads the files that texts use, each once. */
#include "driver/open/files.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "compiler/common/source.h"
#include "compiler/notation.h"
#include "driver/open/missing.h"
#include "runtime/base/file.h"

/* A file that was found. */
typedef struct tn_file {
    struct tn_file *next;
    char *asked;    /* what was asked for: a path from the folder of the user, or as a module records the library's */
    char *path;     /* where it is */
    char *identity; /* its real path */
    uint8_t *bytes; /* NULL where the overlay has the text */
    const char *text;
    size_t size;
    bool is_stdlib;
} tn_file;

void tn_files_begin(tn_files *files, const tn_stdlib_dirs *dirs)
{
    *files = (tn_files){.dirs = dirs, .lock = PTHREAD_MUTEX_INITIALIZER};
}

static void free_file(tn_file *file)
{
    free(file->asked);
    free(file->path);
    free(file->identity);
    free(file->bytes);
    free(file);
}

void tn_files_clear(tn_files *files)
{
    for (tn_file *file = files->found, *next; file; file = next) {
        next = file->next;
        free_file(file);
    }
    files->found = NULL;
    pthread_mutex_destroy(&files->lock);
}

char *tn_file_identity(const char *path)
{
    char *real = realpath(path, NULL);
    return real ? real : strdup(path);
}

/* ---- where it is */

/* Looks in the standard library's folders; file->path stays NULL where none has it. */
static tn_status find_in_library(const tn_files *files, const tn_request *request, tn_file *file, tn_error *error)
{
    for (size_t i = 0; i < files->dirs->count; i++) {
        file->path = tn_path_join(files->dirs->dirs[i], request->path, request->extension);
        if (!file->path)
            return tn_fail_memory(error);
        if (tn_path_exists(file->path))
            return TN_OK;
        free(file->path);
        file->path = NULL;
    }
    return TN_OK;
}

static tn_status find(const tn_files *files, const tn_request *request, tn_file *file, tn_error *error)
{
    if (file->is_stdlib)
        return find_in_library(files, request, file, error);
    if (!tn_path_exists(file->asked))
        return TN_OK;
    file->path = strdup(file->asked);
    return file->path ? TN_OK : tn_fail_memory(error);
}

static tn_status read_text(const tn_files *files, tn_file *file, tn_error *error)
{
    file->identity = tn_file_identity(file->path);
    if (!file->identity)
        return tn_fail_memory(error);
    if (files->overlay && files->overlay(files->overlay_context, file->identity, &file->text, &file->size))
        return TN_OK;
    tn_status status = tn_file_read(file->path, TN_SOURCE_BYTES_MAX, &file->bytes, &file->size, error);
    file->text = (const char *)file->bytes;
    return status;
}

tn_status tn_refuse_python_grammar(const char *path, tn_error *error)
{
    const char *dot = strrchr(path, '.');
    if (!dot || strcmp(dot, ".pybnf") != 0)
        return TN_OK;
    tn_fail(error, TN_INVALID, E_OTHER_GRAMMAR,
            "%.200s is a grammar of Python programs, whose blocks `{:` and `:}` only PonyGE2 turns into indented lines",
            path);
    tn_error_help(error, "a grammar without such blocks is read once its name ends in .bnf");
    return TN_INVALID;
}

/* A file is a rule file by its name, of whatever notation: of any other not even a line is quoted. */
static tn_status check_name(const tn_file *file, const tn_request *request, tn_error *error)
{
    struct stat known;
    bool folder = stat(file->path, &known) == 0 && S_ISDIR(known.st_mode); /* reading says that */
    if (file->is_stdlib || folder || tn_notation_of(file->path, "", 0))
        return TN_OK;
    if (tn_refuse_python_grammar(file->path, error) != TN_OK)
        return TN_INVALID;
    tn_fail(error, TN_INVALID, E_IMPORT_NOT_FOUND, "cannot use %.300s: it is not a rule file", file->path);
    tn_error_help(error, "a file that can be used here has a name that ends in %s", request->extension);
    return TN_INVALID;
}

/* Finds and reads what `asked` names, which becomes the file's. */
static tn_status get(tn_files *files, const tn_request *request, char *asked, char *meant, tn_error *error)
{
    tn_file *file = calloc(1, sizeof *file);
    if (!file) {
        free(asked);
        return tn_fail_memory(error);
    }
    file->asked = asked;
    file->is_stdlib = tn_path_is_bare(request->path);
    tn_status status = find(files, request, file, error);
    if (status == TN_OK && file->path)
        status = check_name(file, request, error);
    if (status == TN_OK)
        status = file->path ? read_text(files, file, error) : tn_missing(files->dirs, request, meant, error);
    if (status != TN_OK) {
        free_file(file);
        return status;
    }
    file->next = files->found;
    files->found = file;
    return TN_OK;
}

static const tn_file *known(const tn_files *files, const char *asked)
{
    const tn_file *file = files->found;
    while (file && strcmp(file->asked, asked) != 0)
        file = file->next;
    return file;
}

static tn_status resolve(void *context, const tn_request *request, tn_input *input, char *meant, tn_error *error)
{
    tn_files *files = context;
    bool bare = tn_path_is_bare(request->path);
    char *asked = bare ? tn_path_join("<stdlib>", request->path, request->extension)
                       : tn_path_beside(request->user, request->path, "");
    if (!asked)
        return tn_fail_memory(error);
    pthread_mutex_lock(&files->lock);
    const tn_file *file = known(files, asked);
    tn_status status = TN_OK;
    if (file) {
        free(asked);
    } else {
        status = get(files, request, asked, meant, error);
        file = files->found;
    }
    pthread_mutex_unlock(&files->lock);
    if (status == TN_OK)
        *input =
            (tn_input){file->text, file->size, file->path, file->identity, file->is_stdlib ? file->asked : file->path};
    return status;
}

tn_resolver tn_files_resolver(tn_files *files)
{
    return (tn_resolver){resolve, files};
}
