/* Plan libraries in SQLite (docs/plan-files.md): what tn_plan_reader_open and tn_plan_writer_open are given, so that
 * they read and write them. */
#ifndef TARTAN_PLAN_STORE_SQLITE_H
#define TARTAN_PLAN_STORE_SQLITE_H

#include "runtime/plan/text/stream.h"

/* NULL in a build without the part `store`. */
const tn_plan_database *tn_plan_sqlite(void);

#endif
