/* Streams of plans: reading them from files of any of the formats of docs/plan-files.md, and writing them.
 *
 * Both sides use constant memory, whatever the number of plans. A reader or a writer belongs to one thread; it borrows
 * the schema (and a writer the texts of its metadata only while it is opened).
 */
#ifndef TARTAN_PLAN_TEXT_STREAM_H
#define TARTAN_PLAN_TEXT_STREAM_H

#include <gmp.h>

#include "runtime/plan/text/text.h"

typedef enum tn_plan_format {
    TN_FORMAT_AUTO,    /* reading: found out from the first bytes; writing: plan lines */
    TN_FORMAT_LINES,   /* plan lines */
    TN_FORMAT_JSON,    /* JSON lines */
    TN_FORMAT_CSV,     /* a header, then a row a plan */
    TN_FORMAT_BIN,     /* packed trays */
    TN_FORMAT_SQLITE,  /* a plan library */
    TN_FORMAT_PARQUET, /* a column a field, for programs that ask questions about very many plans */
    TN_FORMAT_COUNT
} tn_plan_format;

/* ---- reading */

typedef struct tn_plan_reader tn_plan_reader;

/* What reads and writes SQLite: tn_plan_sqlite of runtime/plan/store/sqlite.h. NULL: nothing does, and asking for it is
 * E0907. */
typedef struct tn_plan_database tn_plan_database;

/* What reads and writes Parquet: tn_plan_parquet_calls of driver/parquet/parquet.h. NULL: nothing does. */
typedef struct tn_plan_parquet tn_plan_parquet;

/* What compresses files of plans and reads them again: tn_plan_zstd of driver/zstd/zstd.h. NULL: nothing does. */
typedef struct tn_plan_compression tn_plan_compression;

typedef struct tn_reader_options {
    tn_plan_format format;
    size_t max_length; /* trays of a plan; 0: 4,096. E0805 past it */
    size_t max_line;   /* bytes of a line; 0: 1 MiB. E0605 past it */
    const tn_plan_database *sqlite;
    const tn_plan_parquet *parquet;
    const tn_plan_compression *compression; /* of files that begin as it makes them */
} tn_reader_options;

/* Opens a file ("-": standard input, not for SQLite). `options` may be NULL. E0901 where it cannot be read, E0604 where
 * it is none of the formats or made with another schema. Free with tn_plan_reader_free. */
tn_status tn_plan_reader_open(const tn_schema *schema, const char *path, const tn_reader_options *options,
                              tn_plan_reader **reader, tn_error *error);
void tn_plan_reader_free(tn_plan_reader *reader);

/* The next plan, valid until the next call; *plan is NULL at the end. Where one plan is bad (TN_INVALID, or TN_LIMIT
 * with E0605 or E0805) the error has its line and column, and the caller may go on: the next call reads the next plan.
 * After any other failure the reader is at its end. */
tn_status tn_plan_reader_next(tn_plan_reader *reader, const tn_plan **plan, tn_error *error);

/* The line of the plan read last, from 1 (its number in the file, where the format has no lines). */
uint64_t tn_plan_reader_line(const tn_plan_reader *reader);

/* That line as it was written, without its end; NULL where the format has no lines. Valid until the next call. */
const char *tn_plan_reader_text(const tn_plan_reader *reader, size_t *size);

/* The rank that the file gives the plan read last; false where it gives none. */
bool tn_plan_reader_rank(const tn_plan_reader *reader, mpz_t rank);

/* ---- reading a part of a file */

/* Of plan lines, JSON lines and packed plans: bytes [begin, end) of the file. Of Parquet: row groups. */
typedef struct tn_plan_part {
    uint64_t begin, end;
} tn_plan_part;

/* The format that was given, or found. */
tn_plan_format tn_plan_reader_format(const tn_plan_reader *reader);

/* All that the file has to be divided. False where it can only be read as a whole: CSV, SQLite, what is compressed as a
 * whole, and what is no regular file; `whole` is then one indivisible part, [0, 1). */
bool tn_plan_reader_whole(const tn_plan_reader *reader, tn_plan_part *whole);

/* The first place from `near` on, at most the part's end, where the file can be divided: where a line, a packed plan or
 * a row group begins. The part begins at such a place; packed plans are stepped over from there on, which reads them.
 * What was to be read next is lost: restrict the reader before reading. TN_IO; TN_INVALID (E0604) where packed plans
 * are damaged. */
tn_status tn_plan_reader_cut(tn_plan_reader *reader, const tn_plan_part *part, uint64_t near, uint64_t *cut,
                             tn_error *error);

/* How many lines, or packed plans or plans in row groups, a part has. Reads it; what was to be read next is lost. */
tn_status tn_plan_reader_count(tn_plan_reader *reader, const tn_plan_part *part, uint64_t *count, tn_error *error);

/* Reads only the part from here on, whose lines or plans are numbered from 1. To be called before a plan is read. */
tn_status tn_plan_reader_restrict(tn_plan_reader *reader, const tn_plan_part *part, tn_error *error);

/* ---- reading by several threads */

/* Lines of a file of plan lines or JSON lines, of which each thread has its own. What they hold is either taken from
 * the reader, by one thread at a time, or read from the file itself, by all of them side by side. */
typedef struct tn_plan_lines tn_plan_lines;
tn_status tn_plan_lines_new(const tn_plan_reader *reader, tn_plan_lines **lines, tn_error *error);
void tn_plan_lines_free(tn_plan_lines *lines);

/* Takes the next whole lines, about `bytes` of them, in place of those that `lines` holds. *taken is false where there
 * are none to take so: another format, a very long line, the end. tn_plan_reader_next goes on from there. */
tn_status tn_plan_lines_take(tn_plan_lines *lines, tn_plan_reader *reader, size_t bytes, bool *taken, tn_error *error);

/* Gives up what is left of a regular file to tn_plan_lines_read: the bytes that this is, as long as the file is now
 * (what is appended later is not read; where it becomes shorter, it ends there). The reader is then at its end. 0, and
 * nothing given up, where nothing is left or the input cannot be read so: another format, a pipe. */
uint64_t tn_plan_reader_share(tn_plan_reader *reader);

/* Reads the lines that begin in bytes (begin, begin + size] of what was shared, and with the first bytes (begin 0) the
 * first line, in place of those that `lines` holds. So stretches that follow one another have each line once, with
 * lines longer than a stretch in the one where they begin. *count: of lines. Memory: `size` and the longest line. */
tn_status tn_plan_lines_read(tn_plan_lines *lines, const tn_plan_reader *reader, uint64_t begin, size_t size,
                             uint64_t *count, tn_error *error);

/* The next plan of the lines held, as tn_plan_reader_next gives it; `error` must not be NULL. Lines are numbered as in
 * the file where they were taken, and from 1 where they were read. */
tn_status tn_plan_lines_next(tn_plan_lines *lines, const tn_plan **plan, tn_error *error);
uint64_t tn_plan_lines_line(const tn_plan_lines *lines);
const char *tn_plan_lines_text(const tn_plan_lines *lines, size_t *size);

/* ---- writing */

typedef struct tn_plan_writer tn_plan_writer;

/* What a library file says of how it was made. NULL texts are left out. */
typedef struct tn_plan_metadata {
    const char *library;      /* its name */
    const char *library_hash; /* tn_library_hash */
    const char *rules_hash;   /* of the rule files' texts, hexadecimal */
    const char *rules_path;
    const char *version; /* the compiler's */
    const char *command; /* what was asked for: "enumerate --from 10", "sample 100 --seed 3" */
    const char *params;  /* the values that the rules' params were given: "lot=9m, side=right" */
} tn_plan_metadata;

/* What a row says besides its plan, where it is more than a plan (a house): texts, in columns after those of the plan.
 * The last is the line that stands in files of lines. Packed files and Parquet do not hold such rows, nor do columns.
 */
#define TN_ROW_TEXTS_MAX 4
typedef struct tn_row_columns {
    const char *what;  /* the rows, in messages */
    const char *table; /* of a database */
    bool before;       /* in files of lines the last text stands before the plan line, a tab between them */
    const char *names[TN_ROW_TEXTS_MAX];
    size_t count;
} tn_row_columns;

typedef struct tn_writer_options {
    tn_plan_format format;
    const tn_row_columns *rows; /* NULL: rows are plans */
    tn_plan_metadata metadata;
    bool columns;   /* CSV: a row a tray, and a column a field; SQLite: also a table `trays` of such rows */
    bool csv_safe;  /* a plan in CSV that begins with = + - or @ gets a ' before it: spreadsheets compute such cells */
    bool resume;    /* go on with the SQLite library at the path, if there is one */
    uint32_t batch; /* plans a transaction; 0: 100,000 */
    uint32_t row_group; /* Parquet: plans of a row group; 0: 1,000,000 */
    bool plan_lines;    /* Parquet: also a column of plan lines */
    mpz_srcptr ranks;   /* Parquet: all ranks are below. NULL: they fit in 63 bits */
    const tn_plan_database *sqlite;
    const tn_plan_parquet *parquet;
    const tn_plan_compression *compression; /* of what is written; not for SQLite or Parquet. NULL: none */
    const struct tn_seen_bytes *written;    /* sees what is written; not for SQLite. Or NULL */
} tn_writer_options;

/* Has the file stayed as it was since it was opened? Otherwise TN_IO (E0901): what was read may be a mix. Readers ask
 * that themselves where the input ends; whoever shares a reader's file asks when all is read. */
tn_status tn_plan_reader_unchanged(const tn_plan_reader *reader, tn_error *error);

/* Opens a file to write plans to ("-": standard output, not for SQLite). A SQLite library that is there is replaced, or
 * with `resume` gone on with: E0606 where it was made from other rules or by another command. A file that is there and
 * is no library is refused (E0902). */
tn_status tn_plan_writer_open(const tn_schema *schema, const char *path, const tn_writer_options *options,
                              tn_plan_writer **writer, tn_error *error);

/* Plans that a resumed library holds already, and the rank of the last of them; 0 where it is new. */
uint64_t tn_plan_writer_resumed(const tn_plan_writer *writer, mpz_t last_rank);

/* Can what it writes be gone on with later? SQLite libraries can, once they are there. */
bool tn_plan_writer_resumes(const tn_plan_writer *writer);

/* Is the SQLite library that was there before still there? It is replaced when the first batch ends. */
bool tn_plan_writer_replaces(const tn_plan_writer *writer);

/* Appends a plan. Ranks must ascend. */
tn_status tn_plan_writer_write(tn_plan_writer *writer, const mpz_t rank, const tn_tray *trays, size_t length,
                               tn_error *error);

/* Appends a row: a plan, and a text for each of the options' columns. members: what JSON has besides, as a writer of
 * JSON wrote it; or NULL. */
typedef struct tn_plan_row {
    const tn_tray *trays;
    size_t length;
    const char *texts[TN_ROW_TEXTS_MAX];
    const char *members;
} tn_plan_row;
tn_status tn_plan_writer_write_row(tn_plan_writer *writer, const mpz_t rank, const tn_plan_row *row, tn_error *error);

/* Is what it writes a text, or packed, plan after plan? Then plans may also be made on several threads, and put in
 * their order. */
bool tn_plan_writer_is_text(const tn_plan_writer *writer);

/* Appends a plan to a text, as it is in the file; `room` is memory for it. By any thread. false: out of memory. */
bool tn_plan_writer_text(const tn_plan_writer *writer, const mpz_t rank, const tn_tray *trays, size_t length,
                         tn_buffer *text, tn_buffer *room);

/* Appends such a text to the file. */
tn_status tn_plan_writer_put(tn_plan_writer *writer, const tn_buffer *text, tn_error *error);

/* Appends the plans of another file that was written in the same format, with the same schema and options, byte by
 * byte; what such a file begins with is left out. Not for SQLite and Parquet, nor from or to compressed files.
 * TN_INVALID (E0604) where it does not begin so. */
tn_status tn_plan_writer_append(tn_plan_writer *writer, const char *path, tn_error *error);

/* Finishes the file, which is then in place and whole. The writer may only be freed after, whatever the result. A
 * closed pipe is TN_IO with E0903. */
tn_status tn_plan_writer_close(tn_plan_writer *writer, tn_error *error);

/* Frees the writer. Where it was not closed, a SQLite library keeps its whole batches, to be resumed; any other file is
 * given up. */
void tn_plan_writer_free(tn_plan_writer *writer);

#endif
