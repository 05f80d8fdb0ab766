/* The calls by which plans in Parquet are read and written. */
#include "driver/parquet/parquet.h"

#include "driver/parquet/reader.h"
#include "driver/parquet/writer.h"

const tn_plan_parquet *tn_plan_parquet_calls(void)
{
    static const tn_plan_parquet calls = {
        .open_reader = tn_parquet_reader_open,
        .next = tn_parquet_reader_next,
        .close_reader = tn_parquet_reader_close,
        .groups = tn_parquet_reader_groups,
        .count = tn_parquet_reader_count,
        .restrict_to = tn_parquet_reader_restrict,
        .open_writer = tn_parquet_writer_open,
        .write = tn_parquet_writer_write,
        .close_writer = tn_parquet_writer_close,
        .free_writer = tn_parquet_writer_free,
    };
    return &calls;
}
