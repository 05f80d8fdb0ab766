/* Files of plans that are compressed by zstd: what tn_plan_reader_open and tn_plan_writer_open are given for them. */
#ifndef TARTAN_DRIVER_ZSTD_ZSTD_H
#define TARTAN_DRIVER_ZSTD_ZSTD_H

#include "runtime/plan/text/compression.h"

const tn_plan_compression *tn_plan_zstd(void);

#endif
