/* Plan libraries in SQLite in a build without the part `store`: whoever opens one is told so by runtime/plan/text. */
#include "runtime/plan/store/sqlite.h"

const tn_plan_database *tn_plan_sqlite(void)
{
    return NULL;
}
