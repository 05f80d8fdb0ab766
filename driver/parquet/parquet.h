/* Files of plans in Parquet (docs/plan-files.md), for programs that ask questions about very many plans: what
 * tn_plan_reader_open and tn_plan_writer_open are given, so that they read and write them. */
#ifndef TARTAN_DRIVER_PARQUET_PARQUET_H
#define TARTAN_DRIVER_PARQUET_PARQUET_H

#include "runtime/plan/text/parquet.h"

const tn_plan_parquet *tn_plan_parquet_calls(void);

#endif
