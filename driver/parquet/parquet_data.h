/* Inside of driver/parquet: the calls of parquet.h. */
#ifndef TARTAN_DRIVER_PARQUET_PARQUET_DATA_H
#define TARTAN_DRIVER_PARQUET_PARQUET_DATA_H

#include "driver/parquet/parquet.h"

tn_status tn_parquet_reader_open(tn_plan_reader *reader, tn_error *error);
tn_status tn_parquet_reader_next(tn_plan_reader *reader, bool *found, tn_error *error);
void tn_parquet_reader_close(tn_plan_reader *reader);
tn_plan_part tn_parquet_reader_groups(const tn_plan_reader *reader);
uint64_t tn_parquet_reader_count(const tn_plan_reader *reader, tn_plan_part groups);
void tn_parquet_reader_restrict(tn_plan_reader *reader, tn_plan_part groups);

tn_status tn_parquet_writer_open(tn_plan_writer *writer, const tn_writer_options *options, tn_error *error);
tn_status tn_parquet_writer_write(tn_plan_writer *writer, const mpz_t rank, const tn_tray *trays, size_t length,
                                  tn_error *error);
tn_status tn_parquet_writer_close(tn_plan_writer *writer, tn_error *error);
void tn_parquet_writer_free(tn_plan_writer *writer);

#endif
