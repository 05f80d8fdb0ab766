/* What the benchmarks share: clocks, ending with a reason, loading a module. */
#ifndef TARTAN_BENCH_BENCH_H
#define TARTAN_BENCH_BENCH_H

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "runtime/base/file.h"
#include "runtime/load.h"
#include "runtime/module/module.h"

static inline double seconds(clockid_t clock)
{
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

static inline void stop(const char *what)
{
    fprintf(stderr, "%s: %s\n", program_invocation_short_name, what);
    exit(1);
}

/* The module of a file, which the caller frees; stops where there is none. */
static inline tn_module *load_module(const char *path)
{
    uint8_t *bytes;
    size_t size;
    tn_module *module;
    tn_error error;
    if (tn_file_read(path, tn_module_limits_default().bytes, &bytes, &size, &error) != TN_OK ||
        tn_module_load(bytes, size, NULL, &module, &error) != TN_OK)
        stop(error.message);
    free(bytes);
    return module;
}

#endif
