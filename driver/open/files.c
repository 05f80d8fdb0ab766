/* Finds and reads the files that texts use, each once. */
#include "driver/open/files.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "compiler/common/source.h"
#include "compiler/compile.h"
#include "driver/open/missing.h"
#include "runtime/base/file.h"

/* ---- texts, each found once */

void tn_kept_begin(tn_kept_texts *kept, tn_overlay *overlay, void *context)
{
    *kept = (tn_kept_texts){.overlay = overlay, .overlay_context = context, .lock = PTHREAD_MUTEX_INITIALIZER};
}

static void free_text(tn_kept_text *text)
{
    free(text->key);
    free(text->path);
    free(text->identity);
    free(text->bytes);
    free(text);
}

void tn_kept_clear(tn_kept_texts *kept)
{
    for (tn_kept_text *text = kept->first, *next; text; text = next) {
        next = text->next;
        free_text(text);
    }
    kept->first = NULL;
    pthread_mutex_destroy(&kept->lock);
}

bool tn_kept_overlaid(const tn_kept_texts *kept, const char *path, tn_kept_text *text)
{
    return kept->overlay && kept->overlay(kept->overlay_context, path, &text->text, &text->size);
}

static tn_status add(tn_kept_texts *kept, char *key, tn_find_text *find, void *context, tn_error *error)
{
    tn_kept_text *text = calloc(1, sizeof *text);
    if (!text) {
        free(key);
        return tn_fail_memory(error);
    }
    text->key = key;
    tn_status status = find(context, text, error);
    if (status != TN_OK) {
        free_text(text);
        return status;
    }
    text->next = kept->first;
    kept->first = text;
    return TN_OK;
}

static const tn_kept_text *known(const tn_kept_texts *kept, const char *key)
{
    const tn_kept_text *text = kept->first;
    while (text && strcmp(text->key, key) != 0)
        text = text->next;
    return text;
}

tn_status tn_kept_get(tn_kept_texts *kept, char *key, tn_find_text *find, void *context, const tn_kept_text **text,
                      tn_error *error)
{
    tn_status status = TN_OK;
    pthread_mutex_lock(&kept->lock);
    *text = known(kept, key);
    if (*text) {
        free(key);
    } else {
        status = add(kept, key, find, context, error);
        *text = kept->first;
    }
    pthread_mutex_unlock(&kept->lock);
    return status;
}

/* ---- finds and reads the files that texts use, each once */

void tn_files_begin(tn_files *files, const tn_stdlib_dirs *dirs)
{
    *files = (tn_files){.dirs = dirs};
    tn_kept_begin(&files->kept, NULL, NULL);
}

void tn_files_clear(tn_files *files)
{
    tn_kept_clear(&files->kept);
}

char *tn_file_identity(const char *path)
{
    char *real = realpath(path, NULL);
    return real ? real : strdup(path);
}

/* ---- where it is */

/* What is looked for, and who is told what was probably meant. */
typedef struct search {
    const tn_files *files;
    const tn_request *request;
    bool is_stdlib;
    char *meant;
} search;

/* Looks in the standard library's folders; the path stays NULL where none has it. */
static tn_status find_in_library(const search *s, tn_kept_text *file, tn_error *error)
{
    const tn_stdlib_dirs *dirs = s->files->dirs;
    for (size_t i = 0; i < dirs->count; i++) {
        file->path = tn_path_join(dirs->dirs[i], s->request->path, s->request->extension);
        if (!file->path)
            return tn_fail_memory(error);
        if (tn_path_exists(file->path))
            return TN_OK;
        free(file->path);
        file->path = NULL;
    }
    return TN_OK;
}

static tn_status find(const search *s, tn_kept_text *file, tn_error *error)
{
    if (s->is_stdlib)
        return find_in_library(s, file, error);
    if (!tn_path_exists(file->key))
        return TN_OK;
    file->path = strdup(file->key);
    return file->path ? TN_OK : tn_fail_memory(error);
}

static tn_status read_text(const search *s, tn_kept_text *file, tn_error *error)
{
    file->identity = tn_file_identity(file->path);
    if (!file->identity)
        return tn_fail_memory(error);
    if (tn_kept_overlaid(&s->files->kept, file->identity, file))
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
static tn_status check_name(const search *s, const tn_kept_text *file, tn_error *error)
{
    struct stat known;
    bool folder = stat(file->path, &known) == 0 && S_ISDIR(known.st_mode); /* reading says that */
    if (s->is_stdlib || folder || tn_notation_of(file->path, "", 0))
        return TN_OK;
    if (tn_refuse_python_grammar(file->path, error) != TN_OK)
        return TN_INVALID;
    tn_fail(error, TN_INVALID, E_IMPORT_NOT_FOUND, "cannot use %.300s: it is not a rule file", file->path);
    tn_error_help(error, "a file that can be used here has a name that ends in %s", s->request->extension);
    return TN_INVALID;
}

static tn_status get(void *context, tn_kept_text *file, tn_error *error)
{
    const search *s = context;
    tn_status status = find(s, file, error);
    if (status == TN_OK && !file->path)
        return tn_missing(s->files->dirs, s->request, s->meant, error);
    if (status == TN_OK)
        status = check_name(s, file, error);
    return status == TN_OK ? read_text(s, file, error) : status;
}

/* The key is what is asked for: a path from the folder of the user, or as a module records the library's. */
static tn_status resolve(void *context, const tn_request *request, tn_input *input, char *meant, tn_error *error)
{
    tn_files *files = context;
    search s = {files, request, tn_path_is_bare(request->path), meant};
    char *asked = s.is_stdlib ? tn_path_join("<stdlib>", request->path, request->extension)
                              : tn_path_beside(request->user, request->path, "");
    const tn_kept_text *file;
    if (!asked)
        return tn_fail_memory(error);
    tn_status status = tn_kept_get(&files->kept, asked, get, &s, &file, error);
    if (status == TN_OK)
        *input = (tn_input){file->text, file->size, file->path, file->identity, s.is_stdlib ? file->key : file->path};
    return status;
}

tn_resolver tn_files_resolver(tn_files *files)
{
    return (tn_resolver){resolve, files};
}
