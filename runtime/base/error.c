/* Fills in errors. */
#include "runtime/base/error.h"

#include <stdio.h>

tn_status tn_fail(tn_error *error, tn_status status, tn_code code, const char *format, ...)
{
    if (!error)
        return status;
    *error = (tn_error){.status = status, .code = code, .code_offset = TN_NO_OFFSET};
    va_list args;
    va_start(args, format);
    vsnprintf(error->message, sizeof error->message, format, args);
    va_end(args);
    return status;
}

tn_status tn_fail_memory(tn_error *error)
{
    return tn_fail(error, TN_MEMORY, E_OUT_OF_MEMORY, "out of memory");
}

void tn_error_help(tn_error *error, const char *format, ...)
{
    if (!error)
        return;
    va_list args;
    va_start(args, format);
    vsnprintf(error->help, sizeof error->help, format, args);
    va_end(args);
}

void tn_error_place(tn_error *error, uint64_t line, size_t column, size_t column_end)
{
    if (!error)
        return;
    error->line = line;
    error->column = (uint32_t)column;
    error->column_end = (uint32_t)column_end;
}

/* ---- what is said where a part is asked for that the build left out */

tn_status tn_part_absent(tn_optional_part part, const char *wanted, tn_error *error)
{
    static const struct {
        const char *name, *option, *package;
    } parts[] = {
        [TN_WITH_DRAW] = {"draw", "TARTAN_WITH_DRAW", "cairo (libcairo2-dev)"},
        [TN_WITH_MESH] = {"mesh", "TARTAN_WITH_MESH", "OpenMesh (libopenmesh-dev)"},
        [TN_WITH_STORE] = {"store", "TARTAN_WITH_STORE", "SQLite (libsqlite3-dev)"},
    };
    tn_status status = tn_fail(error, TN_INVALID, E_PART_ABSENT,
                               "this tartan was built without the part `%s`, which %s needs", parts[part].name, wanted);
    tn_error_help(error, "build it with -D%s=ON, which needs %s", parts[part].option, parts[part].package);
    return status;
}
