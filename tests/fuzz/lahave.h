/* The LaHave schema, compiled from the stdlib when it is first asked for. */
#ifndef TARTAN_TESTS_FUZZ_LAHAVE_H
#define TARTAN_TESTS_FUZZ_LAHAVE_H

#include <stdio.h>
#include <stdlib.h>

#include "runtime/load.h"
#include "runtime/plan/schema/schema.h"
#include "tests/support/compile_file.h"

static void stop(const char *why)
{
    fprintf(stderr, "%s\n", why);
    abort();
}

static const tn_schema *lahave(void)
{
    static tn_schema *schema;
    static tn_compilation compilation;
    static tn_module *module;
    tn_error error;
    if (schema)
        return schema;
    if (compile_file(TARTAN_SOURCE_DIR "/stdlib/lahave.plan", &(library_folders){0}, &compilation) != TN_OK ||
        tn_module_load(compilation.module, compilation.module_size, NULL, &module, &error) != TN_OK ||
        tn_schema_new(module, 0, 0, &schema, &error) != TN_OK)
        stop("stdlib/lahave.plan does not compile");
    return schema;
}

#endif
