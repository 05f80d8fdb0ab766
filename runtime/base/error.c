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
