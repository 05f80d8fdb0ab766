/* What the files of the C interface share: modules behind their opaque name, errors turned into its own, structs that
 * callers own, and whoever waits.
 *
 * A tartan_module owns its bytes. Every other object of the interface borrows it. */
#ifndef TARTAN_API_BASE_API_H
#define TARTAN_API_BASE_API_H

#include "include/tartan/tartan.h"
#include "runtime/module/module.h"

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

tartan_status tn_api_memory(tartan_error *error);

/* TARTAN_INVALID: what must be there is NULL. */
tartan_status tn_api_missing(tartan_error *error, const char *what);

/* TARTAN_INVALID for a name that none of the `count` names is: "the module has no rule `x`", and the nearest as help.
 * Takes over `names` (malloc; NULL where out of memory). */
tartan_status tn_api_unknown(tartan_error *error, const char *what, const char *name, const char **names, size_t count);

/* A caller's options (NULL: none) into a struct of ours, of `room` bytes: zeros where there are none. TARTAN_INVALID
 * where its size is not set, or what we do not know is. */
tartan_status tn_api_take(void *own, size_t room, const void *given, const char *what, tartan_error *error);

/* Results into a caller's struct; its size stays. */
tartan_status tn_api_give(void *given, const void *own, size_t room, const char *what, tartan_error *error);

#define TN_API_TAKE(TYPE, OWN, GIVEN, ERROR) tn_api_take((OWN), sizeof(TYPE), (GIVEN), #TYPE, (ERROR))
#define TN_API_GIVE(TYPE, GIVEN, OWN, ERROR) tn_api_give((GIVEN), (OWN), sizeof(TYPE), #TYPE, (ERROR))

/* Begins a watch for the caller's (may be NULL), on this thread. */
tartan_status tn_api_watch(const tartan_watch *given, tn_watch *watch, tartan_error *error);

#endif
