/* Inside of the reader of Parquet: what it holds of a file. */
#ifndef TARTAN_DRIVER_PARQUET_READER_H
#define TARTAN_DRIVER_PARQUET_READER_H

#include "driver/parquet/encoding.h"
#include "driver/parquet/page.h"
#include "driver/parquet/parquet.h"
#include "runtime/plan/text/field_columns.h"
#include "runtime/plan/text/reader.h"

/* Inside of the reader of Parquet: what it holds of a file. */

#define TN_NO_CODE UINT16_MAX /* a text of a dictionary that is no value of the field */

/* A column as the schema of the file says. */
typedef struct tn_leaf {
    bool known;    /* the file has it */
    bool nested;   /* it has several columns in it */
    size_t number; /* among the columns */
    int64_t type, type_length, scale;
    unsigned max_repetition, max_definition;
    unsigned list_definition; /* from this level on, a list has an element */
} tn_leaf;

/* Where a column's pages of a row group are. */
typedef struct tn_read_chunk {
    uint64_t begin, end; /* in the file */
    int64_t codec;
} tn_read_chunk;

/* A value that was read: by its place in the dictionary, or as text or number. */
typedef struct tn_read_value {
    uint32_t place; /* UINT32_MAX: as it is */
    tn_thrift_string text;
    int64_t number;
} tn_read_value;

/* A column that is read, page by page. */
typedef struct tn_read_column {
    tn_leaf leaf;
    uint32_t field; /* whose values it has; UINT32_MAX: of none */
    tn_read_chunk chunk;
    uint64_t at;      /* in the file: the next page */
    tn_buffer window; /* bytes of the file from window_at on */
    uint64_t window_at;

    tn_buffer page; /* the page in hand, not compressed */
    uint64_t left;  /* places in it that are not read */
    int64_t encoding;
    tn_runs repetition, definition, places;
    tn_deltas deltas;
    tn_thrift_in plain;

    tn_buffer dictionary;    /* the dictionary's page */
    tn_thrift_string *words; /* its texts or numbers */
    uint16_t *codes;         /* the field's values that these are */
    size_t word_count, word_room, code_room;

    bool peeked, ended; /* the levels of the next place are known; there is none */
    unsigned next_repetition, next_definition;
} tn_read_column;

typedef struct tn_parquet_reading {
    uint64_t file_size;
    uint8_t *footer;
    size_t footer_size;
    tn_thrift_in about_groups; /* in it */
    size_t leaves;             /* columns of the file */
    tn_read_column *columns;   /* those of the fields, then rank, then plan */
    uint32_t column_count;
    bool by_lines;                          /* plans are read from the column `plan` */
    uint64_t group_count, group, group_end; /* in the file; the next to be read; one past the last */
    uint64_t *group_rows;                   /* [groups] */
    tn_read_chunk *chunks;                  /* [groups][columns] */
    bool begun;                             /* a group is in hand */
    uint64_t rows_left;                     /* of it */
    uint8_t *values;                        /* [trays][fields] of the plan in hand */
    size_t values_room;
    tn_page_unpacker unpacker;
} tn_parquet_reading;

static inline tn_parquet_reading *tn_reading_of(const tn_plan_reader *reader)
{
    return reader->parquet_state;
}

static inline tn_read_column *tn_rank_column(const tn_parquet_reading *r)
{
    return &r->columns[r->column_count - 2];
}

static inline tn_read_column *tn_line_column(const tn_parquet_reading *r)
{
    return &r->columns[r->column_count - 1];
}

/* E0604: the file is not what it should be; E1711: it has something that is not read here. Both return TN_INVALID. */
tn_status tn_parquet_damaged(const tn_plan_reader *reader, const char *what, tn_error *error);

/* Reads the footer: fills columns[].leaf; then the groups, and the chunks of those columns that are still known
 * (footer.c). */
tn_status tn_footer_read(tn_plan_reader *reader, tn_error *error);
tn_status tn_footer_groups(tn_plan_reader *reader, tn_error *error);

/* Reads bytes of the file: all of them, or it is damaged. */
tn_status tn_parquet_bytes(const tn_plan_reader *reader, uint64_t at, void *bytes, size_t size, tn_error *error);

/* ---- columns */

/* ---- the calls of parquet.h */

tn_status tn_parquet_reader_open(tn_plan_reader *reader, tn_error *error);
tn_status tn_parquet_reader_next(tn_plan_reader *reader, bool *found, tn_error *error);
void tn_parquet_reader_close(tn_plan_reader *reader);
tn_plan_part tn_parquet_reader_groups(const tn_plan_reader *reader);
uint64_t tn_parquet_reader_count(const tn_plan_reader *reader, tn_plan_part groups);
void tn_parquet_reader_restrict(tn_plan_reader *reader, tn_plan_part groups);

#endif
