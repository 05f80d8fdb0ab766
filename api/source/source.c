/* The C interface to rule files with their source: opening them, and working on them. */
#include "api/source/source.h"

#include <stdlib.h>
#include <string.h>

void tartan_source_free(tartan_source *source)
{
    if (!source)
        return;
    tn_close(&source->opened);
    free(source->path);
    free(source);
}

tartan_status tartan_source_open(const char *path, const char *text, size_t size, const tartan_compile_options *options,
                                 tartan_source **source, tartan_error *error)
{
    if (!path || !source)
        return tn_api_missing(error, path ? "room for the source" : "path");
    tartan_source *made = calloc(1, sizeof *made);
    if (!made || !(made->path = strdup(path))) {
        free(made);
        return tn_api_memory(error);
    }
    tartan_status status = text ? tn_api_open(made->path, text, size, options, NULL, &made->opened, error)
                                : tn_api_open_file(made->path, options, &made->opened, error);
    if (status != TARTAN_OK) {
        tartan_source_free(made);
        return status;
    }
    made->module =
        (tartan_module){made->opened.module, made->opened.compilation.module, made->opened.compilation.module_size};
    *source = made;
    return TARTAN_OK;
}

const tartan_module *tartan_source_module(const tartan_source *source)
{
    return &source->module;
}

tartan_status tn_api_source_begin(tartan_source *source, const tartan_watch *given, tn_api_work *work,
                                  tartan_error *error)
{
    if (!source)
        return tn_api_missing(error, "source");
    tartan_status status = tn_api_watch(given, &work->watch, error);
    if (status != TARTAN_OK)
        return status;
    tn_compilation *compilation = &source->opened.compilation;
    work->source = source;
    work->kept = compilation->diagnostics;
    tn_diagnostics_init(&compilation->diagnostics, &compilation->sources);
    source->opened.module->watch = &work->watch;
    return TARTAN_OK;
}

tartan_status tn_api_source_end(tn_api_work *work, tn_status status, tartan_error *error)
{
    tn_diagnostics *list = &work->source->opened.compilation.diagnostics;
    work->source->opened.module->watch = NULL;
    tartan_status result = status == TN_OK ? TARTAN_OK : tn_api_first_error(list, status, &work->watch, error);
    tn_diagnostics_clear(list);
    *list = work->kept;
    return result;
}
