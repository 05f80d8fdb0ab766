/* Plan libraries in SQLite by the part `store`, which is loaded when the first one is opened. If it cannot be,
 * runtime/plan/text says why. */
#include "runtime/base/part.h"
#include "runtime/plan/store/sqlite.h"

const tn_plan_database *tn_plan_sqlite(void)
{
    __typeof__(tn_plan_sqlite) *find =
        (__typeof__(find))tn_part_find(TN_WITH_STORE, "tn_plan_sqlite", "a library in SQLite", NULL);
    return find ? find() : NULL;
}
