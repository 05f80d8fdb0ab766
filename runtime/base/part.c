/* What is said where a part is asked for that the build left out. */
#include "runtime/base/part.h"

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
