/* What the files of the C interface share: the types behind its opaque names, and errors turned into its own. */
#ifndef TARTAN_API_RUNTIME_API_H
#define TARTAN_API_RUNTIME_API_H

#include "include/tartan/tartan.h"
#include "runtime/plan/schema/schema.h"

struct tartan_module {
    tn_module *module;
    uint8_t *bytes; /* what it was loaded from */
    size_t size;
};

/* A loaded module under its public type, with the bytes (malloc) that it came from. Takes over both in any case. */
tartan_status tn_api_module(tn_module *loaded, uint8_t *bytes, size_t size, tartan_module **module,
                            tartan_error *error);

/* Copies what the library found into the caller's error (may be NULL); returns the status. */
tartan_status tn_api_fail(const tn_error *found, tartan_error *error);

/* The same from a message of the interface's own. */
tartan_status tn_api_refuse(tartan_error *error, tartan_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* TARTAN_INVALID for a name that none of the `count` names is: "the module has no rule `x`", and the nearest as help.
 * Takes over `names` (malloc; NULL where out of memory). */
tartan_status tn_api_unknown(tartan_error *error, const char *what, const char *name, const char **names, size_t count);

/* Are these tray numbers of the schema? TN_INVALID where not. */
tn_status tn_api_trays(const tn_schema *schema, const uint32_t *trays, size_t length, tn_error *error);

/* tartan_schema is tn_schema under its public name. */
static inline const tn_schema *tn_api_schema(const tartan_schema *schema)
{
    return (const tn_schema *)(const void *)schema;
}

static inline const tartan_schema *tn_api_public_schema(const tn_schema *schema)
{
    return (const tartan_schema *)(const void *)schema;
}

#endif
