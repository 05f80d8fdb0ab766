#include "runtime/base/part.h"

#define SOME_PART (TARTAN_WITH_DRAW || TARTAN_WITH_MESH || TARTAN_WITH_STORE || TARTAN_WITH_SEARCH)
#if SOME_PART
#include <assert.h>
#include <dlfcn.h>
#endif
#include <string.h>

#define FILE_OF(name) "libtartan-" name ".so." TARTAN_SOVERSION

static const struct {
    bool built;                                                     /* does this build have it? */
    const char *name, *file, *option, *library, *headers, *package; /* the last two: Debian's packages */
} parts[] = {
    [TN_WITH_DRAW] = {TARTAN_WITH_DRAW, "draw", FILE_OF("draw"), "TARTAN_WITH_DRAW", "cairo", "libcairo2-dev",
                      "libcairo2"},
    [TN_WITH_MESH] = {TARTAN_WITH_MESH, "mesh", FILE_OF("mesh"), "TARTAN_WITH_MESH", "OpenMesh", "libopenmesh-dev",
                      "libopenmesh1"},
    [TN_WITH_STORE] = {TARTAN_WITH_STORE, "store", FILE_OF("store"), "TARTAN_WITH_STORE", "SQLite", "libsqlite3-dev",
                       "libsqlite3-0"},
    [TN_WITH_SEARCH] = {TARTAN_WITH_SEARCH, "search", FILE_OF("search"), "TARTAN_WITH_SEARCH", "CaDiCaL",
                        "libcadical-dev", "which libtartan-search holds"},
};

const char *tn_part_version(void)
{
    return TARTAN_VERSION;
}

static tn_status left_out(tn_optional_part part, const char *wanted, tn_error *error)
{
    tn_status status = tn_fail(error, TN_INVALID, E_PART_ABSENT,
                               "this tartan was built without the part `%s`, which %s needs", parts[part].name, wanted);
    tn_error_help(error, "build it with -D%s=ON, which needs %s (%s)", parts[part].option, parts[part].library,
                  parts[part].headers);
    return status;
}

#if SOME_PART
static tn_status not_loaded(tn_optional_part part, const char *wanted, const char *why, tn_error *error)
{
    tn_status status = tn_fail(error, TN_INVALID, E_PART_ABSENT, "the part `%s`, which %s needs, cannot be loaded: %s",
                               parts[part].name, wanted, why);
    tn_error_help(error, "install the libraries of Tartan beside the program, and %s (%s)", parts[part].library,
                  parts[part].package);
    return status;
}

/* A function's address: POSIX lets it be an object's, too, ISO C does not. */
static tn_part_function *symbol(void *library, const char *name)
{
    void *found = dlsym(library, name);
    tn_part_function *function;
    static_assert(sizeof function == sizeof found, "a function's address is as large as an object's");
    memcpy(&function, &found, sizeof function);
    return function;
}

/* Libraries and program call one another by functions that change from version to version. */
static bool is_of_this_version(void *library)
{
    typedef const char *version_function(void);
    version_function *version = (version_function *)symbol(library, "tn_part_version");
    return version && strcmp(version(), tn_part_version()) == 0;
}

tn_part_function *tn_part_find(tn_optional_part part, const char *function, const char *wanted, tn_error *error)
{
    if (!parts[part].built) {
        left_out(part, wanted, error);
        return NULL;
    }
    /* Loaded already, this only finds it. */
    void *library = dlopen(parts[part].file, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (!library) {
        not_loaded(part, wanted, dlerror(), error);
        return NULL;
    }
    tn_part_function *found = is_of_this_version(library) ? symbol(library, function) : NULL;
    if (!found)
        not_loaded(part, wanted, "it is of another version of Tartan", error);
    dlclose(library); /* which unloads nothing: RTLD_NODELETE */
    return found;
}
#else
tn_part_function *tn_part_find(tn_optional_part part, const char *function, const char *wanted, tn_error *error)
{
    (void)function;
    left_out(part, wanted, error);
    return NULL;
}
#endif

tn_status tn_part_absent(tn_optional_part part, const char *wanted, tn_error *error)
{
    /* If the part is of this build, this says why it cannot be loaded. */
    if (tn_part_find(part, "tn_part_version", wanted, error))
        return left_out(part, wanted, error);
    return TN_INVALID;
}
