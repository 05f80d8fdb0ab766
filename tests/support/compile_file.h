/* Compiling texts and files where the standard library is in folders that the test names. */
#ifndef TARTAN_TESTS_COMPILE_FILE_H
#define TARTAN_TESTS_COMPILE_FILE_H

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "compiler/compile.h"
#include "driver/open/census.h"
#include "driver/open/files.h"
#include "driver/open/open.h"
#include "runtime/base/file.h"

typedef struct library_folders {
    const char *const *stdlib_dirs;
    size_t stdlib_dir_count;
    tn_param_values params;
} library_folders;

/* As tn_compile_text; the path says the notation, and where what is used lies. */
static inline tn_status compile_text(const char *path, const char *text, size_t size, const library_folders *folders,
                                     tn_compilation *compilation)
{
    char identity[PATH_MAX];
    tn_stdlib_dirs dirs = {(char **)(uintptr_t)folders->stdlib_dirs, folders->stdlib_dir_count};
    tn_files files;
    tn_files_begin(&files, &dirs);
    tn_compile_options options = {.resolver = tn_files_resolver(&files),
                                  .census = tn_plan_census,
                                  .attachments = tn_file_attachments,
                                  .params = folders->params};
    tn_input input = {.text = text, .size = size, .name = path, .identity = realpath(path, identity)};
    tn_status status = tn_compile_text(tn_notation_or_first(path, text, size), &input, &options, compilation);
    tn_files_clear(&files);
    return status;
}

/* The same of a file. TN_IO where it cannot be read. */
static inline tn_status compile_file(const char *path, const library_folders *folders, tn_compilation *compilation)
{
    uint8_t *bytes;
    size_t size;
    *compilation = (tn_compilation){0};
    if (tn_file_read(path, SIZE_MAX, &bytes, &size, NULL) != TN_OK)
        return TN_IO;
    tn_status status = compile_text(path, (const char *)bytes, size, folders, compilation);
    free(bytes);
    return status;
}

#endif
