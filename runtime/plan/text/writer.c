/* Writes plans in each format. */
#include "runtime/plan/text/writer.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/bytes.h"
#include "runtime/base/error.h"
#include "runtime/base/file.h"
#include "runtime/base/part.h"
#include "runtime/plan/text/field_columns.h"
#include "runtime/plan/text/pack.h"

#define BATCH_DEFAULT 100000u
#define COPIED ((size_t)1 << 18) /* bytes at a time */
#define HELD ((size_t)1 << 16)   /* bytes of plans that are written to a file at once */

void tn_writer_metadata(const tn_plan_writer *writer, const tn_plan_metadata *metadata, tn_metadata_room *room,
                        tn_metadata_item items[TN_METADATA_ITEMS])
{
    const tn_schema *schema = writer->schema;
    snprintf(room->schema_hash, sizeof room->schema_hash, "%016llx", (unsigned long long)tn_pack_schema_hash(schema));
    snprintf(room->tray_bytes, sizeof room->tray_bytes, "%u", tn_pack_tray_bytes(schema));
    const tn_metadata_item all[TN_METADATA_ITEMS] = {
        {"library", metadata->library},
        {"library_hash", metadata->library_hash},
        {"schema", tn_text(schema->module, schema->record->name)},
        {"schema_hash", room->schema_hash},
        {"tray_bytes", room->tray_bytes},
        {"command", metadata->command},
        {"params", metadata->params},
        {"rules_path", metadata->rules_path},
        {"rules_hash", metadata->rules_hash},
        {"version", metadata->version},
    };
    memcpy(items, all, sizeof all);
}

int64_t tn_writer_total(const tn_plan_writer *writer, const tn_tray *trays, size_t length)
{
    int64_t total = 0;
    for (size_t k = 0; k < length; k++) {
        int64_t value = tn_tray_value_record(writer->schema, trays[k], writer->length_field)->length;
        if (__builtin_add_overflow(total, value, &total))
            return INT64_MAX;
    }
    return total;
}

/* ---- the texts of trays: a plan line put together from them takes a copy a tray instead of one a value */

#define TRAY_TEXTS_MAX 65536u

static bool make_tray_texts(tn_plan_writer *writer)
{
    uint32_t count = writer->schema->tray_count;
    if (count > TRAY_TEXTS_MAX || writer->format == TN_FORMAT_JSON || writer->format == TN_FORMAT_BIN)
        return true; /* they have no plan lines */
    writer->tray_text_end = malloc((count + 1) * sizeof *writer->tray_text_end);
    for (tn_tray tray = 0; writer->tray_text_end && tray < count; tray++) {
        if (!tn_buffer_append(&writer->tray_texts, " | ", 3) ||
            !tn_plan_write_line(writer->schema, &tray, 1, &writer->tray_texts))
            return false;
        writer->tray_text_end[tray] = writer->tray_texts.size;
    }
    return writer->tray_text_end != NULL;
}

bool tn_writer_line(const tn_plan_writer *writer, const tn_tray *trays, size_t length, tn_buffer *out)
{
    if (!writer->tray_texts.data)
        return tn_plan_write_line(writer->schema, trays, length, out);
    bool done = true;
    for (size_t k = 0; done && k < length; k++) {
        size_t begin = (trays[k] ? writer->tray_text_end[trays[k] - 1] : 0) + (k > 0 ? 0 : 3);
        done = tn_buffer_append(out, writer->tray_texts.data + begin, writer->tray_text_end[trays[k]] - begin);
    }
    return done;
}

/* ---- what a file starts with */

static bool append_text(tn_buffer *out, const char *text)
{
    return tn_buffer_append(out, text, strlen(text));
}

bool tn_writer_csv_field(tn_buffer *out, const char *text, size_t size, bool safe)
{
    const char *mark = safe && size > 0 && strchr("=+-@", text[0]) ? "'" : "";
    if (strcspn(text, ",\"\r\n") == size)
        return append_text(out, mark) && tn_buffer_append(out, text, size);
    bool done = append_text(out, "\"") && append_text(out, mark);
    for (size_t i = 0; done && i < size; i++)
        done = (text[i] != '"' || append_text(out, "\"")) && tn_buffer_append(out, &text[i], 1);
    return done && append_text(out, "\"");
}

static bool append_cell(const tn_plan_writer *writer, tn_buffer *out, const char *text)
{
    return append_text(out, ",") && tn_writer_csv_field(out, text, strlen(text), writer->csv_safe);
}

static bool columns_header(tn_plan_writer *writer)
{
    const tn_schema *schema = writer->schema;
    bool done = append_text(&writer->text, "rank,tray");
    for (uint32_t f = 0; done && f < schema->field_count; f++) {
        char name[TN_COLUMN_NAME_SIZE];
        tn_field_column(schema, f, TN_COLUMNS_CSV, name);
        done = append_cell(writer, &writer->text, name);
    }
    return done && append_text(&writer->text, "\n");
}

/* A row a tray; for the plan without trays one that says so. */
static bool append_columns(const tn_plan_writer *writer, const char *rank, const tn_plan_row *row, tn_buffer *out)
{
    const tn_schema *schema = writer->schema;
    const tn_tray *trays = row->trays;
    size_t length = row->length;
    bool done = length > 0 || tn_buffer_printf(out, "%s,0", rank);
    for (uint32_t f = 0; done && length == 0 && f < schema->field_count; f++)
        done = append_text(out, ",");
    for (size_t i = 0; done && i < length; i++) {
        done = tn_buffer_printf(out, "%s%s,%zu", i ? "\n" : "", rank, i + 1);
        for (uint32_t f = 0; done && f < schema->field_count; f++)
            done =
                append_cell(writer, out, tn_text(schema->module, tn_tray_value_record(schema, trays[i], f)->spelling));
    }
    return done && append_text(out, "\n");
}

static bool csv_header(tn_plan_writer *writer)
{
    if (writer->columns)
        return columns_header(writer);
    bool done =
        append_text(&writer->text, writer->length_field == UINT32_MAX ? "rank,length,plan" : "rank,length,total,plan");
    for (size_t i = 0; done && i < tn_writer_texts(writer); i++)
        done = append_cell(writer, &writer->text, writer->rows->names[i]);
    return done && append_text(&writer->text, "\n");
}

/* The header of packed plans, and the metadata as lines `key=value`. */
static bool bin_header(tn_plan_writer *writer, const tn_plan_metadata *metadata)
{
    tn_metadata_room room;
    tn_metadata_item items[TN_METADATA_ITEMS];
    tn_writer_metadata(writer, metadata, &room, items);
    tn_buffer *lines = &writer->packed;
    bool done = true;
    lines->size = 0;
    for (size_t i = 0; i < TN_METADATA_ITEMS; i++)
        done = done && (!items[i].value || tn_buffer_printf(lines, "%s=%s\n", items[i].key, items[i].value));
    uint8_t header[TN_PACK_HEADER];
    memcpy(header, TN_PACK_MAGIC, 8);
    tn_put_u32(header + 8, TN_PACK_VERSION);
    tn_put_u32(header + 12, tn_pack_tray_bytes(writer->schema));
    tn_put_u64(header + 16, tn_pack_schema_hash(writer->schema));
    tn_put_u64(header + 24, lines->size);
    return done && tn_buffer_append(&writer->text, (const char *)header, sizeof header) &&
           tn_buffer_append(&writer->text, lines->data, lines->size);
}

static tn_status write_bytes(tn_plan_writer *writer, const char *bytes, size_t size, tn_error *error)
{
    FILE *out = writer->output.stream;
    if (size == 0 || (writer->compressing ? writer->compression->write(writer->compressing, bytes, size, false, out)
                                          : fwrite(bytes, 1, size, out) == size))
        return TN_OK;
    const char *shown = strcmp(writer->path, "-") == 0 ? "standard output" : writer->path;
    return tn_cannot_write(shown, errno, error);
}

static tn_status flush_text(tn_plan_writer *writer, tn_error *error)
{
    size_t size = writer->text.size;
    writer->text.size = 0;
    return write_bytes(writer, writer->text.data, size, error);
}

/* A file gets plans many at a time; others, such as a pipe, each at once. */
static tn_status flush_much(tn_plan_writer *writer, tn_error *error)
{
    return writer->output.replaces && writer->text.size < HELD ? TN_OK : flush_text(writer, error);
}

static tn_status open_file(tn_plan_writer *writer, const tn_writer_options *options, tn_error *error)
{
    if (options->resume) {
        tn_fail(error, TN_INVALID, E_USAGE, "%s: only an interrupted SQLite library can be continued", writer->path);
        tn_error_help(error, "write to a file that ends in .sqlite");
        return TN_INVALID;
    }
    tn_status status = tn_output_open_seen(writer->path, options->written, &writer->output, error);
    if (status == TN_OK && options->compression && writer->format != TN_FORMAT_PARQUET)
        status = options->compression->begin_writing(&writer->compressing, error);
    if (status != TN_OK)
        return status;
    if (writer->output.replaces)
        setvbuf(writer->output.stream, NULL, _IONBF, 0); /* much is written at once: see flush_much */
    bool done = true;
    if (writer->format == TN_FORMAT_CSV)
        done = csv_header(writer);
    if (writer->format == TN_FORMAT_BIN)
        done = bin_header(writer, &options->metadata);
    if (writer->format == TN_FORMAT_PARQUET)
        return writer->parquet->open_writer(writer, options, error);
    return done ? flush_much(writer, error) : tn_fail_memory(error);
}

static tn_status open_writer(tn_plan_writer *writer, const char *path, const tn_writer_options *options,
                             tn_error *error)
{
    writer->path = strdup(path);
    if (!writer->path)
        return tn_fail_memory(error);
    if (writer->format == TN_FORMAT_AUTO)
        writer->format = TN_FORMAT_LINES;
    if (writer->columns && writer->format != TN_FORMAT_CSV && writer->format != TN_FORMAT_SQLITE) {
        tn_fail(error, TN_INVALID, E_USAGE, "columns are for CSV and databases");
        tn_error_help(error, "--format csv, or write to a file that ends in .sqlite");
        return TN_INVALID;
    }
    if (writer->rows && (writer->columns || writer->format == TN_FORMAT_BIN || writer->format == TN_FORMAT_PARQUET)) {
        tn_fail(error, TN_INVALID, E_USAGE, "%s are not written packed, in Parquet, or tray by tray",
                writer->rows->what);
        tn_error_help(error, "--format lines, json, csv or sqlite, without --columns");
        return TN_INVALID;
    }
    if (writer->format == TN_FORMAT_PARQUET && !writer->parquet)
        return tn_fail(error, TN_INVALID, E_USAGE, "this program does not write Parquet");
    if (!make_tray_texts(writer))
        return tn_fail_memory(error);
    if (writer->format != TN_FORMAT_SQLITE)
        return open_file(writer, options, error);
    return writer->sqlite ? writer->sqlite->open_writer(writer, options, error)
                          : tn_part_absent(TN_WITH_STORE, "writing a SQLite library", error);
}

tn_status tn_plan_writer_open(const tn_schema *schema, const char *path, const tn_writer_options *options,
                              tn_plan_writer **out, tn_error *error)
{
    *out = NULL;
    tn_plan_writer *writer = calloc(1, sizeof *writer);
    if (!writer)
        return tn_fail_memory(error);
    writer->schema = schema;
    writer->format = options->format;
    writer->rows = options->rows;
    writer->compression = options->compression;
    writer->columns = options->columns;
    writer->csv_safe = options->csv_safe;
    writer->sqlite = options->sqlite;
    writer->parquet = options->parquet;
    writer->length_field = tn_schema_length_field(schema);
    if (writer->length_field != UINT32_MAX)
        writer->total_style = tn_length_style_of(
            tn_text(schema->module, schema->values[schema->value_start[writer->length_field]].spelling));
    writer->batch = options->batch > 0 ? options->batch : BATCH_DEFAULT;
    tn_status status = open_writer(writer, path, options, error);
    if (status != TN_OK) {
        tn_plan_writer_free(writer);
        return status;
    }
    *out = writer;
    return TN_OK;
}

/* ---- plans */

static bool append_csv(const tn_plan_writer *writer, const char *rank, const tn_plan_row *row, tn_buffer *out,
                       tn_buffer *line)
{
    line->size = 0;
    if (!tn_buffer_printf(out, "%s,%zu,", rank, row->length))
        return false;
    if (writer->length_field != UINT32_MAX) {
        char total[48];
        tn_length_write_style(tn_writer_total(writer, row->trays, row->length), writer->total_style, total,
                              sizeof total);
        if (!tn_writer_csv_field(out, total, strlen(total), false) || !append_text(out, ","))
            return false;
    }
    bool done = tn_writer_line(writer, row->trays, row->length, line) &&
                (line->size == 0 || tn_writer_csv_field(out, line->data, line->size, writer->csv_safe));
    for (size_t i = 0; done && i < tn_writer_texts(writer); i++)
        done = append_cell(writer, out, row->texts[i]);
    return done && append_text(out, "\n");
}

static bool append_packed(const tn_plan_writer *writer, const tn_tray *trays, size_t length, tn_buffer *out)
{
    size_t rest = length;
    do {
        char byte = (char)((rest & 0x7f) | (rest > 0x7f ? 0x80 : 0));
        if (!tn_buffer_append(out, &byte, 1))
            return false;
        rest >>= 7;
    } while (rest > 0);
    return tn_pack_trays(writer->schema, trays, length, out);
}

static bool append_json(const tn_plan_writer *writer, const char *rank, const tn_plan_row *row, tn_buffer *out)
{
    tn_json json = tn_json_text(out, TN_JSON_TIGHT);
    tn_json_object(&json, NULL);
    if (rank)
        tn_json_string(&json, "rank", rank);
    for (size_t i = 0; i < tn_writer_texts(writer); i++)
        if (row->texts[i])
            tn_json_string(&json, writer->rows->names[i], row->texts[i]);
    tn_plan_write_trays(writer->schema, row->trays, row->length, &json);
    if (row->members)
        tn_json_written(&json, row->members, strlen(row->members));
    tn_json_object_end(&json);
    tn_json_end_line(&json);
    return !out->failed;
}

static bool append_line(const tn_plan_writer *writer, const tn_plan_row *row, tn_buffer *out)
{
    size_t texts = tn_writer_texts(writer);
    bool before = texts && writer->rows->before, ok = true;
    if (texts)
        ok = append_text(out, row->texts[texts - 1]) && (!before || append_text(out, "\t"));
    if (ok && (!texts || before))
        ok = tn_writer_line(writer, row->trays, row->length, out);
    return ok && append_text(out, "\n");
}

/* As it is in a text; `room` is memory for it. */
static bool append_row(const tn_plan_writer *writer, const char *rank, const tn_plan_row *row, tn_buffer *out,
                       tn_buffer *room)
{
    switch (writer->format) {
    case TN_FORMAT_CSV:
        return writer->columns ? append_columns(writer, rank, row, out) : append_csv(writer, rank, row, out, room);
    case TN_FORMAT_JSON:
        return append_json(writer, rank, row, out);
    case TN_FORMAT_BIN:
        return append_packed(writer, row->trays, row->length, out);
    default:
        return append_line(writer, row, out);
    }
}

static tn_status write_ranked(tn_plan_writer *writer, const char *rank, const tn_plan_row *row, tn_error *error)
{
    if (writer->format == TN_FORMAT_SQLITE)
        return writer->sqlite->write(writer, rank, row, error);
    return append_row(writer, rank, row, &writer->text, &writer->packed) ? flush_much(writer, error)
                                                                         : tn_fail_memory(error);
}

/* Do its files say ranks? */
static bool says_ranks(const tn_plan_writer *writer)
{
    return writer->format != TN_FORMAT_LINES && writer->format != TN_FORMAT_BIN;
}

bool tn_plan_writer_is_text(const tn_plan_writer *writer)
{
    return writer->format != TN_FORMAT_SQLITE && writer->format != TN_FORMAT_PARQUET && !writer->rows;
}

bool tn_plan_writer_text(const tn_plan_writer *writer, const mpz_t rank, const tn_tray *trays, size_t length,
                         tn_buffer *text, tn_buffer *room)
{
    const tn_plan_row row = {.trays = trays, .length = length};
    char digits[128], *large = NULL;
    if (!says_ranks(writer))
        return append_row(writer, NULL, &row, text, room);
    if (mpz_sizeinbase(rank, 10) + 2 > sizeof digits && !(large = mpz_get_str(NULL, 10, rank)))
        return false;
    bool done = append_row(writer, large ? large : mpz_get_str(digits, 10, rank), &row, text, room);
    free(large);
    return done;
}

tn_status tn_plan_writer_put(tn_plan_writer *writer, const tn_buffer *text, tn_error *error)
{
    tn_status status = flush_text(writer, error);
    return status == TN_OK ? write_bytes(writer, text->data, text->size, error) : status;
}

tn_status tn_plan_writer_write_row(tn_plan_writer *writer, const mpz_t rank, const tn_plan_row *row, tn_error *error)
{
    char room[128];
    if (!says_ranks(writer) || !rank)
        return write_ranked(writer, NULL, row, error);
    if (writer->format == TN_FORMAT_PARQUET)
        return writer->parquet->write(writer, rank, row->trays, row->length, error);
    if (mpz_sizeinbase(rank, 10) + 2 <= sizeof room)
        return write_ranked(writer, mpz_get_str(room, 10, rank), row, error);
    char *digits = mpz_get_str(NULL, 10, rank);
    tn_status status = digits ? write_ranked(writer, digits, row, error) : tn_fail_memory(error);
    free(digits);
    return status;
}

tn_status tn_plan_writer_write(tn_plan_writer *writer, const mpz_t rank, const tn_tray *trays, size_t length,
                               tn_error *error)
{
    return tn_plan_writer_write_row(writer, rank, &(tn_plan_row){.trays = trays, .length = length}, error);
}

bool tn_plan_writer_resumes(const tn_plan_writer *writer)
{
    return writer->format == TN_FORMAT_SQLITE && !writer->replaces;
}

bool tn_plan_writer_replaces(const tn_plan_writer *writer)
{
    return writer->replaces;
}

uint64_t tn_plan_writer_resumed(const tn_plan_writer *writer, mpz_t last_rank)
{
    if (writer->resumed > 0)
        mpz_set_str(last_rank, writer->last_rank.data, 10);
    return writer->resumed;
}

/* ---- the plans of another file */

/* Reads past what a file of the format begins with; false where it does not begin so. */
static bool skip_beginning(const tn_plan_writer *writer, FILE *file)
{
    uint8_t header[TN_PACK_HEADER];
    int byte = 0;
    if (writer->format == TN_FORMAT_BIN)
        return fread(header, 1, sizeof header, file) == sizeof header && memcmp(header, TN_PACK_MAGIC, 8) == 0 &&
               tn_get_u64(header + 24) <= INT64_MAX && fseeko(file, (off_t)tn_get_u64(header + 24), SEEK_CUR) == 0;
    while (writer->format == TN_FORMAT_CSV && byte != '\n' && byte != EOF)
        byte = getc(file);
    return byte != EOF;
}

static tn_status copy_file(tn_plan_writer *writer, FILE *file, const char *path, tn_error *error)
{
    if (!skip_beginning(writer, file))
        return tn_fail(error, TN_INVALID, E_PLAN_FILE, "%.300s does not begin as such a file does", path);
    tn_buffer *text = &writer->text;
    tn_status status = flush_text(writer, error);
    if (status == TN_OK && !tn_buffer_reserve(text, COPIED))
        status = tn_fail_memory(error);
    while (status == TN_OK && (text->size = fread(text->data, 1, COPIED, file)) > 0)
        status = flush_text(writer, error);
    return status == TN_OK && ferror(file) ? tn_cannot_read(path, errno, error) : status;
}

tn_status tn_plan_writer_append(tn_plan_writer *writer, const char *path, tn_error *error)
{
    FILE *file = tn_file_stream(path);
    if (!file)
        return tn_cannot_read(path, errno, error);
    tn_status status = copy_file(writer, file, path, error);
    fclose(file);
    return status;
}

/* ---- the end */

tn_status tn_plan_writer_close(tn_plan_writer *writer, tn_error *error)
{
    if (writer->format == TN_FORMAT_SQLITE)
        return writer->sqlite->close_writer(writer, error);
    tn_status status =
        writer->format == TN_FORMAT_PARQUET ? writer->parquet->close_writer(writer, error) : flush_text(writer, error);
    if (status == TN_OK && writer->compressing &&
        !writer->compression->write(writer->compressing, NULL, 0, true, writer->output.stream))
        status = tn_cannot_write(writer->path, errno, error);
    return status == TN_OK ? tn_output_commit(&writer->output, error) : status;
}

void tn_plan_writer_free(tn_plan_writer *writer)
{
    if (!writer)
        return;
    if (writer->compressing)
        writer->compression->end_writing(writer->compressing);
    if (writer->output.stream)
        tn_output_discard(&writer->output);
    if (writer->sqlite)
        writer->sqlite->free_writer(writer);
    if (writer->parquet)
        writer->parquet->free_writer(writer);
    free(writer->text.data);
    free(writer->packed.data);
    free(writer->last_rank.data);
    free(writer->tray_texts.data);
    free(writer->tray_text_end);
    free(writer->path);
    free(writer);
}
