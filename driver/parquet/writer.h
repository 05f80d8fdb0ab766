/* Inside of the writer of Parquet: what it holds of a file. */
#ifndef TARTAN_DRIVER_PARQUET_WRITER_H
#define TARTAN_DRIVER_PARQUET_WRITER_H

#include "driver/parquet/encoding.h"
#include "driver/parquet/page.h"
#include "driver/parquet/parquet.h"
#include "runtime/plan/text/field_columns.h"
#include "runtime/plan/text/writer.h"

/* A column of numbers of which few differ: their dictionary, and the numbers of a page as places in it. A column with
 * more than 65,536 different numbers in a row group has those of its later pages as they are. */

typedef struct tn_numbers {
    unsigned bytes;   /* of a number: 4 or 8 */
    uint16_t *places; /* in the dictionary, of the page's numbers, while it has room */
    tn_buffer plain;  /* the page's numbers as they are, where it has none */
    size_t count;     /* of the page */
    int64_t *dictionary;
    size_t known, known_room;
    uint32_t *slots; /* by hash: 1 + place in the dictionary, or 0 */
    size_t slot_count;
    bool full;           /* a number had no room there: from now on none is looked up */
    bool mixed;          /* some page of the row group has numbers as they are */
    int64_t least, most; /* of the row group */
} tn_numbers;

/* Room for pages of so many numbers. TN_MEMORY. Free it in any case. */
tn_status tn_numbers_new(tn_numbers *numbers, unsigned bytes, size_t page, tn_error *error);
void tn_numbers_free(tn_numbers *numbers);

/* False where out of memory. */
bool tn_numbers_add(tn_numbers *numbers, int64_t value);

/* Appends the page's numbers to `body`, and begins another. How they are encoded. */
enum tn_parquet_encoding tn_numbers_page(tn_numbers *numbers, tn_buffer *body);

/* Begins a row group. */
void tn_numbers_clear(tn_numbers *numbers);

/* Inside of the writer of Parquet: what it holds of a file. */

enum { TN_PARQUET_COLUMNS_MAX = TN_FIELDS_MAX + 5 };

/* A column's pages of the row group in hand. */
typedef struct tn_chunk {
    tn_buffer pages;
    uint64_t values, loose; /* values, and bytes of pages before compression */
} tn_chunk;

typedef struct tn_parquet_writing {
    const tn_schema *schema;
    uint64_t offset;                /* bytes of the file that are written */
    uint64_t plans, groups;         /* in the file */
    uint64_t group_most, in_group;  /* plans of a row group: at most, and in the one in hand */
    uint64_t empty_in_group;        /* of these, without trays */
    tn_buffer about_groups;         /* what the footer says of the row groups that are written */
    tn_buffer created_by, metadata; /* of the footer; metadata: in Thrift */

    /* The page in hand, of all columns. */
    size_t in_page, trays;    /* plans, trays */
    uint8_t *tray_numbers;    /* [tray]: tray_bytes each, the lowest first; their fields' values would take more */
    size_t tray_room;         /* bytes */
    unsigned tray_bytes;      /* what the largest number takes: 1 to 4 */
    uint8_t *goes_on, *holds; /* a bit a place of the lists: it is of the plan before; it is a tray */
    size_t places, places_room;
    bool some_empty;                  /* a plan without trays is among them */
    tn_delta_writer ranks;            /* where they fit */
    tn_buffer wide_ranks;             /* otherwise: rank_bytes each, the highest first */
    unsigned rank_bytes, rank_digits; /* 0: ranks fit in 64 bits */
    tn_numbers length, total;
    tn_buffer lines; /* each behind its size */
    size_t line_count;
    tn_buffer rank_texts; /* the same of the page in hand */
    bool has_total, has_lines;
    bool has_rank_texts; /* ranks have more digits than decimal numbers of other programs */

    /* The row group in hand. */
    tn_chunk chunks[TN_PARQUET_COLUMNS_MAX];
    uint8_t seen[TN_FIELDS_MAX][TN_FIELD_VALUES_MAX]; /* which values of a field */
    tn_buffer least_rank, most_rank, this_rank;       /* as the statistics write them; the one of the plan in hand */
    bool descends;                                    /* they do not all ascend */

    tn_buffer body; /* of the page that is written */
    tn_page_packer packer;
} tn_parquet_writing;

/* The columns' numbers. */
static inline unsigned tn_first_field_column(const tn_parquet_writing *w)
{
    return w->has_total ? 3 : 2;
}

static inline unsigned tn_column_count(const tn_parquet_writing *w)
{
    return tn_first_field_column(w) + w->schema->field_count + w->has_lines + w->has_rank_texts;
}

/* Behind the fields: lines, then texts of ranks. */
static inline unsigned tn_lines_column(const tn_parquet_writing *w)
{
    return tn_first_field_column(w) + w->schema->field_count;
}

static inline unsigned tn_rank_texts_column(const tn_parquet_writing *w)
{
    return tn_lines_column(w) + w->has_lines;
}

/* What the footer says of a column of a row group (footer.c). */
typedef struct tn_chunk_place {
    uint64_t dictionary, data; /* offsets of the first pages in the file; dictionary 0: none */
    uint64_t end;
    uint64_t loose;
} tn_chunk_place;

/* Appends what the footer says of the row group. */
void tn_footer_group(tn_parquet_writing *w, const tn_chunk_place *places);

/* Keeps what the footer is to say of how the file was made. False where out of memory. */
bool tn_footer_metadata(tn_parquet_writing *w, const tn_plan_writer *writer, const tn_plan_metadata *metadata);

/* Appends the footer, with its size and the magic. */
void tn_footer_write(const tn_parquet_writing *w, tn_buffer *out);

/* ---- the calls of parquet.h */

tn_status tn_parquet_writer_open(tn_plan_writer *writer, const tn_writer_options *options, tn_error *error);
tn_status tn_parquet_writer_write(tn_plan_writer *writer, const mpz_t rank, const tn_tray *trays, size_t length,
                                  tn_error *error);
tn_status tn_parquet_writer_close(tn_plan_writer *writer, tn_error *error);
void tn_parquet_writer_free(tn_plan_writer *writer);

#endif
