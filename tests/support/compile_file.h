/* Compiling a file that is known to be there. */
#ifndef TARTAN_TESTS_COMPILE_FILE_H
#define TARTAN_TESTS_COMPILE_FILE_H

#include <stdlib.h>

#include "compiler/compile.h"
#include "runtime/base/file.h"

/* As tn_compile_text. TN_IO where the file cannot be read. */
static inline tn_status compile_file(const char *path, const tn_compile_options *options, tn_compilation *compilation)
{
    uint8_t *bytes;
    size_t size;
    *compilation = (tn_compilation){0};
    if (tn_file_read(path, SIZE_MAX, &bytes, &size, NULL) != TN_OK)
        return TN_IO;
    tn_status status = tn_compile_text(path, (const char *)bytes, size, options, compilation);
    free(bytes);
    return status;
}

#endif
