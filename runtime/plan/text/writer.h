/* Inside of tn_plan_writer. */
#ifndef TARTAN_PLAN_TEXT_WRITER_H
#define TARTAN_PLAN_TEXT_WRITER_H

#include "runtime/base/file.h"
#include "runtime/base/length.h"
#include "runtime/plan/text/compression.h"
#include "runtime/plan/text/database.h"
#include "runtime/plan/text/parquet.h"

/* "TART": marks a SQLite file as a plan library (PRAGMA application_id). */
#define TN_LIBRARY_APPLICATION_ID 0x54415254

/* A member of the metadata that every library file carries. */
typedef struct tn_metadata_item {
    const char *key;
    const char *value;
} tn_metadata_item;

#define TN_METADATA_ITEMS 10

/* Plans that go into a SQLite library by one statement. */
#define TN_WAITING_MAX 16

/* One of them: where its texts are in `text` and its trays in `packed`. */
typedef struct tn_waiting_plan {
    uint64_t number;
    size_t length; /* trays */
    int64_t total; /* nanometres */
    size_t rank, text, text_end;
    size_t row_end[TN_ROW_TEXTS_MAX]; /* the row's texts follow, each to its end */
    size_t packed, packed_end;
} tn_waiting_plan;

struct tn_plan_writer {
    const tn_schema *schema;
    tn_plan_format format;
    char *path;
    tn_output output; /* of every format but SQLite */
    const tn_plan_compression *compression;
    void *compressing;     /* its state; NULL: what is written is not compressed */
    uint32_t length_field; /* the one that `total` adds, or UINT32_MAX */
    tn_length_style total_style;
    bool columns, csv_safe;
    const tn_row_columns *rows; /* NULL: rows are plans */
    tn_buffer text;             /* of the plans that are not written yet */
    tn_buffer tray_texts;       /* " | " and the tray, tray after tray; empty where trays are too many to keep */
    size_t *tray_text_end;      /* [trays]: where in tray_texts each ends */
    tn_buffer packed;

    const tn_plan_parquet *parquet; /* where it is Parquet that is written */
    void *parquet_state;

    const tn_plan_database *sqlite; /* where it is SQLite that is written */
    struct sqlite3 *database;
    struct sqlite3_stmt *insert_one, *insert_waiting; /* one plan, TN_WAITING_MAX of them */
    struct sqlite3_stmt *insert_tray;                 /* or NULL */
    tn_waiting_plan waiting[TN_WAITING_MAX];
    size_t waiting_count;
    uint32_t batch, in_batch;
    bool replaces;    /* SQLite: a library that is there, which stays until the first batch ends */
    bool had_library; /* SQLite: one was there, and was not gone on with */
    uint64_t number;  /* of the plan written last */
    uint64_t resumed;
    tn_buffer last_rank; /* of the plan that a resumed library ends with */
};

/* Fills the items, in the order in which they are written; `room` holds what they are made of. A value may be NULL. */
typedef struct tn_metadata_room {
    char schema_hash[24], tray_bytes[8];
} tn_metadata_room;
void tn_writer_metadata(const tn_plan_writer *writer, const tn_plan_metadata *metadata, tn_metadata_room *room,
                        tn_metadata_item items[TN_METADATA_ITEMS]);

/* How many texts a row has besides its plan. */
static inline size_t tn_writer_texts(const tn_plan_writer *writer)
{
    return writer->rows ? writer->rows->count : 0;
}

/* Appends the plan line; false where out of memory. The same as tn_plan_write_line, from the trays' texts. */
bool tn_writer_line(const tn_plan_writer *writer, const tn_tray *trays, size_t length, tn_buffer *out);

/* The plan's lengths added up, in nanometres. */
int64_t tn_writer_total(const tn_plan_writer *writer, const tn_tray *trays, size_t length);

/* Appends a CSV field: in quotes where it holds a comma, a quote or a line break (RFC 4180); safe: with a mark before
 * what a spreadsheet would compute. A zero byte follows the text. */
bool tn_writer_csv_field(tn_buffer *out, const char *text, size_t size, bool safe);

#endif
