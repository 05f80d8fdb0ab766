/* Reads files of plans: finds out their format and buffers their input. */
#include "runtime/plan/text/reader.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "runtime/base/array.h"
#include "runtime/base/error.h"
#include "runtime/base/file.h"
#include "runtime/base/part.h"
#include "runtime/plan/text/pack.h"

#define INPUT_BYTES (size_t)(256u << 10) /* read at a time */
#define LENGTH_DEFAULT 4096u
#define LINE_DEFAULT (1u << 20)
#define PARQUET_MAGIC "PAR1"
#define SQLITE_MAGIC "SQLite format 3" /* with its zero byte, the first 16 bytes of a database */

/* ---- input */

/* Room for `wanted` bytes from `begin` on. */
static bool make_room(tn_plan_reader *reader, size_t wanted)
{
    if (reader->begin > 0) {
        memmove(reader->data, reader->data + reader->begin, reader->end - reader->begin);
        reader->end -= reader->begin;
        reader->begin = 0;
    }
    return tn_array_reserve_from(&reader->data, &reader->capacity, INPUT_BYTES, 0, wanted, 1);
}

tn_status tn_plan_reader_unchanged(const tn_plan_reader *reader, tn_error *error)
{
    return tn_file_state_same(&reader->opened, reader->file, reader->path, error);
}

/* Reads some bytes behind those that are there; *count is 0 at the end. */
static tn_status read_some(tn_plan_reader *reader, size_t *count, tn_error *error)
{
    char *end = reader->data + reader->end;
    size_t room = reader->capacity - reader->end;
    if (room > reader->left)
        room = (size_t)reader->left;
    if (reader->decompressing)
        return reader->compression->read(reader->decompressing, reader->file, reader->path, end, room, count, error);
    ssize_t got;
    do
        got = read(reader->file, end, room);
    while (got < 0 && errno == EINTR);
    *count = got > 0 ? (size_t)got : 0;
    if (reader->left != UINT64_MAX)
        reader->left -= *count;
    return got < 0 ? tn_cannot_read(reader->path, errno, error) : TN_OK;
}

tn_status tn_reader_fill(tn_plan_reader *reader, size_t wanted, tn_error *error)
{
    if (reader->end - reader->begin >= wanted || reader->input_ended)
        return TN_OK;
    if (!make_room(reader, wanted))
        return tn_fail_memory(error);
    while (reader->end < wanted && !reader->input_ended) {
        size_t count = 0;
        tn_status status = read_some(reader, &count, error);
        if (status != TN_OK)
            return status;
        reader->input_ended = count == 0;
        reader->end += count;
    }
    return reader->input_ended ? tn_plan_reader_unchanged(reader, error) : TN_OK;
}

/* Drops input up to and with the next end of line. */
static tn_status skip_line(tn_plan_reader *reader, tn_error *error)
{
    for (;;) {
        const char *rest = reader->data + reader->begin;
        const char *newline = memchr(rest, '\n', reader->end - reader->begin);
        if (newline) {
            reader->begin += (size_t)(newline - rest) + 1;
            return TN_OK;
        }
        reader->begin = reader->end = 0;
        if (reader->input_ended)
            return TN_OK;
        tn_status status = tn_reader_fill(reader, 1, error);
        if (status != TN_OK)
            return status;
    }
}

tn_status tn_reader_line_too_long(size_t max_line, uint64_t line, tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_PLAN_LINE_TOO_LONG, "the line is longer than the limit of %zu bytes", max_line);
    tn_error_help(error, "write one plan a line");
    tn_error_place(error, line, 1, 1);
    return TN_LIMIT;
}

tn_status tn_reader_line(tn_plan_reader *reader, bool *found, tn_error *error)
{
    size_t searched = 0;
    reader->line++;
    for (;;) {
        size_t size = reader->end - reader->begin;
        const char *newline =
            size > searched ? memchr(reader->data + reader->begin + searched, '\n', size - searched) : NULL;
        size_t length = newline ? (size_t)(newline - (reader->data + reader->begin)) : size;
        if (length > reader->max_line) {
            tn_status status = skip_line(reader, error);
            return status == TN_OK ? tn_reader_line_too_long(reader->max_line, reader->line, error) : status;
        }
        if (newline || reader->input_ended) {
            *found = newline || length > 0;
            reader->line -= !*found;
            reader->text = reader->data + reader->begin;
            reader->text_size = length > 0 && reader->text[length - 1] == '\r' ? length - 1 : length;
            reader->begin += length + (newline ? 1 : 0);
            return TN_OK;
        }
        searched = size;
        tn_status status = tn_reader_fill(reader, size + 1, error);
        if (status != TN_OK)
            return status;
    }
}

/* ---- plan lines and JSON lines */

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

char tn_reader_first(const char *text, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        if (!is_blank(text[i]))
            return text[i];
    }
    return '\0';
}

/* JSON where the first line that says something starts with a brace. Only what is read already is looked at. */
static tn_plan_format find_text_format(const tn_plan_reader *reader)
{
    const char *text = reader->data + reader->begin, *end = reader->data + reader->end;
    while (text < end) {
        const char *newline = memchr(text, '\n', (size_t)(end - text));
        const char *stop = newline ? newline : end;
        char first = tn_reader_first(text, (size_t)(stop - text));
        if (first && first != '#')
            return first == '{' ? TN_FORMAT_JSON : TN_FORMAT_LINES;
        text = newline ? newline + 1 : end;
    }
    return TN_FORMAT_LINES;
}

static tn_status next_text(tn_plan_reader *reader, bool *found, tn_error *error)
{
    bool json = reader->format == TN_FORMAT_JSON;
    for (;;) {
        tn_status status = tn_reader_line(reader, found, error);
        if (status != TN_OK || !*found)
            return status;
        char first = tn_reader_first(reader->text, reader->text_size);
        if (first == '#' || (json && !first))
            continue;
        if (!json)
            return tn_plan_scan_line(reader->scanner, reader->text, reader->text_size, reader->max_length,
                                     &reader->plan, error);
        status = tn_plan_scan_json(reader->scanner, reader->text, reader->text_size, reader->max_length, &reader->plan,
                                   error);
        const tn_buffer *rank = &reader->scanner->rank;
        if (status == TN_OK && !tn_buffer_append(&reader->rank, rank->data ? rank->data : "", rank->size))
            status = tn_fail_memory(error);
        return status;
    }
}

/* ---- opening */

static tn_status refuse_text(const tn_plan_reader *reader, const char *message, const char *help, tn_error *error)
{
    tn_fail(error, TN_INVALID, E_PLAN_FILE, "%s: %s", reader->path, message);
    tn_error_help(error, "%s", help);
    return TN_INVALID;
}

/* Plan lines, JSON lines or CSV; what looks like none of them is refused. */
static tn_status open_text(tn_plan_reader *reader, tn_error *error)
{
    static const char bom[] = "\xEF\xBB\xBF";
    size_t size = reader->end - reader->begin;
    if (size >= 3 && memcmp(reader->data + reader->begin, bom, 3) == 0)
        reader->begin += 3;
    if (size > 0 && memchr(reader->data + reader->begin, '\0', reader->end - reader->begin))
        return refuse_text(reader, "is neither text nor a file of packed plans",
                           "plans are read as plan lines, JSON lines, CSV, packed, or from SQLite or Parquet", error);
    if (reader->format == TN_FORMAT_AUTO || reader->format == TN_FORMAT_CSV) {
        bool is_csv;
        tn_status status = tn_reader_csv_open(reader, &is_csv, error);
        if (status != TN_OK)
            return status;
        if (is_csv)
            reader->format = TN_FORMAT_CSV;
        else if (reader->format == TN_FORMAT_CSV)
            return refuse_text(reader, "has no CSV header with a column named plan, or tray",
                               "the first line names the columns: rank,length,plan for a row a plan, or tray and the "
                               "schema's fields for a row a tray",
                               error);
    }
    if (reader->format == TN_FORMAT_AUTO)
        reader->format = find_text_format(reader);
    return TN_OK;
}

static tn_status open_sqlite(tn_plan_reader *reader, tn_error *error)
{
    return reader->sqlite ? reader->sqlite->open_reader(reader, error)
                          : tn_part_absent(TN_WITH_STORE, "reading a SQLite library", error);
}

static tn_status open_parquet(tn_plan_reader *reader, tn_error *error)
{
    if (reader->decompressing)
        return refuse_text(reader, "is Parquet, and compressed once more",
                           "uncompress it: Parquet is read from its end, and its pages are compressed already", error);
    return reader->parquet ? reader->parquet->open_reader(reader, error)
                           : refuse_text(reader, "is Parquet, which this program does not read",
                                         "write the plans as plan lines, or packed", error);
}

/* Reads the first bytes; of a compressed file, those of what was compressed. */
static tn_status begin_input(tn_plan_reader *reader, tn_error *error)
{
    tn_status status = tn_reader_fill(reader, TN_PACK_HEADER, error);
    if (status != TN_OK || !reader->compression || !reader->compression->knows(reader->data, reader->end))
        return status;
    status = reader->compression->begin_reading(reader->data, reader->end, &reader->decompressing, error);
    reader->end = 0;
    reader->input_ended = false;
    return status == TN_OK ? tn_reader_fill(reader, TN_PACK_HEADER, error) : status;
}

/* What the first bytes say that no plans are: what a person gives by mistake. NULL: none of these. */
static const char *foreign(const char *data, size_t size)
{
    static const struct {
        const char *begins, *is;
    } table[] = {
        {"%PDF", "is a PDF"},
        {"\x89PNG", "is a picture (PNG)"},
        {"ISO-10303-21", "is a building model (IFC)"},
        {"glTF", "is a mesh (GLB)"},
        {"PK\x03\x04", "is a zip archive, or a spreadsheet"},
        {"<svg", "is a picture (SVG)"},
        {"<?xml", "is XML"},
        {"<!DOCTYPE", "is a page (HTML)"},
        {"<html", "is a page (HTML)"},
    };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        if (size >= strlen(table[i].begins) && memcmp(data, table[i].begins, strlen(table[i].begins)) == 0)
            return table[i].is;
    size_t at = 0; /* DXF: a zero and SECTION, a line each */
    while (at < size && data[at] == ' ')
        at++;
    bool zero = at + 1 < size && data[at] == '0' && (data[at + 1] == '\r' || data[at + 1] == '\n');
    for (at++; zero && at < size && (data[at] == '\r' || data[at] == '\n'); at++)
        continue;
    return zero && size - at >= 7 && memcmp(data + at, "SECTION", 7) == 0 ? "is a drawing (DXF)" : NULL;
}

/* Finds the format from the first bytes, where it is not given. */
static tn_status open_format(tn_plan_reader *reader, tn_error *error)
{
    tn_status status = begin_input(reader, error);
    if (status != TN_OK)
        return status;
    size_t size = reader->end - reader->begin;
    bool sqlite = size >= sizeof SQLITE_MAGIC && memcmp(reader->data, SQLITE_MAGIC, sizeof SQLITE_MAGIC) == 0;
    bool bin = size >= strlen(TN_PACK_MAGIC) && memcmp(reader->data, TN_PACK_MAGIC, strlen(TN_PACK_MAGIC)) == 0;
    bool parquet = size >= strlen(PARQUET_MAGIC) && memcmp(reader->data, PARQUET_MAGIC, strlen(PARQUET_MAGIC)) == 0;
    const char *other = reader->format == TN_FORMAT_AUTO ? foreign((const char *)reader->data, size) : NULL;
    if (other)
        return refuse_text(reader, other,
                           "plans are read as plan lines, JSON, CSV, packed, from SQLite and from Parquet", error);
    if (reader->format == TN_FORMAT_AUTO && (sqlite || bin || parquet))
        reader->format = sqlite ? TN_FORMAT_SQLITE : bin ? TN_FORMAT_BIN : TN_FORMAT_PARQUET;
    if (reader->format == TN_FORMAT_SQLITE && !sqlite)
        return refuse_text(reader, "is no SQLite library", "leave the format out, and it is found", error);
    if (reader->format == TN_FORMAT_BIN && !bin)
        return refuse_text(reader, "is not a file of packed plans", "leave the format out, and it is found", error);
    if (reader->format == TN_FORMAT_PARQUET && !parquet)
        return refuse_text(reader, "is no Parquet file", "leave the format out, and it is found", error);
    if (reader->format == TN_FORMAT_SQLITE)
        return open_sqlite(reader, error);
    if (reader->format == TN_FORMAT_PARQUET)
        return open_parquet(reader, error);
    return reader->format == TN_FORMAT_BIN ? tn_reader_bin_open(reader, error) : open_text(reader, error);
}

static tn_status open_reader(tn_plan_reader *reader, const char *path, tn_error *error)
{
    reader->path = strdup(strcmp(path, "-") == 0 ? "standard input" : path);
    if (!reader->path)
        return tn_fail_memory(error);
    tn_status status = tn_plan_scanner_new(reader->schema, &reader->scanner, error);
    if (status != TN_OK)
        return status;
    reader->file = strcmp(path, "-") == 0 ? STDIN_FILENO : tn_file_open(path);
    if (reader->file < 0)
        return tn_cannot_read(reader->path, errno, error);
    reader->opened = tn_file_state_of(reader->file);
    return open_format(reader, error);
}

tn_status tn_plan_reader_open(const tn_schema *schema, const char *path, const tn_reader_options *options,
                              tn_plan_reader **out, tn_error *error)
{
    *out = NULL;
    tn_plan_reader *reader = calloc(1, sizeof *reader);
    if (!reader)
        return tn_fail_memory(error);
    tn_reader_options given = options ? *options : (tn_reader_options){.format = TN_FORMAT_AUTO};
    reader->schema = schema;
    reader->file = -1;
    reader->left = UINT64_MAX;
    reader->format = given.format;
    reader->sqlite = given.sqlite;
    reader->parquet = given.parquet;
    reader->compression = given.compression;
    reader->max_length = given.max_length > 0 ? given.max_length : LENGTH_DEFAULT;
    reader->max_line = given.max_line > 0 ? given.max_line : LINE_DEFAULT;
    tn_status status = open_reader(reader, path, error);
    if (status != TN_OK) {
        tn_plan_reader_free(reader);
        return status;
    }
    *out = reader;
    return TN_OK;
}

void tn_plan_reader_free(tn_plan_reader *reader)
{
    if (!reader)
        return;
    if (reader->sqlite)
        reader->sqlite->close_reader(reader);
    if (reader->parquet)
        reader->parquet->close_reader(reader);
    if (reader->decompressing)
        reader->compression->end_reading(reader->decompressing);
    if (reader->file > STDIN_FILENO)
        close(reader->file);
    tn_plan_scanner_free(reader->scanner);
    free(reader->plan.trays);
    free(reader->rank.data);
    free(reader->quoted.data);
    free(reader->column_fields);
    free(reader->data);
    free(reader->path);
    free(reader);
}

/* ---- reading */

tn_status tn_reader_too_long(const tn_plan_reader *reader, uint64_t length, tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_PLAN_TOO_LONG, "the plan has %llu trays, more than the limit of %zu",
            (unsigned long long)length, reader->max_length);
    tn_error_help(error, "--max-length raises the limit");
    return TN_LIMIT;
}

static tn_status next_plan(tn_plan_reader *reader, bool *found, tn_error *error)
{
    switch (reader->format) {
    case TN_FORMAT_CSV:
        return tn_reader_csv_next(reader, found, error);
    case TN_FORMAT_BIN:
        return tn_reader_bin_next(reader, found, error);
    case TN_FORMAT_SQLITE:
        return reader->sqlite->next(reader, found, error);
    case TN_FORMAT_PARQUET:
        return reader->parquet->next(reader, found, error);
    default:
        return next_text(reader, found, error);
    }
}

tn_status tn_plan_reader_next(tn_plan_reader *reader, const tn_plan **plan, tn_error *error)
{
    *plan = NULL;
    if (reader->at_end)
        return TN_OK;
    tn_error scratch;
    tn_error *filled = error ? error : &scratch;
    bool found = false;
    reader->rank.size = 0;
    reader->text = NULL;
    reader->text_size = 0;
    tn_status status = next_plan(reader, &found, filled);
    if (status == TN_OK) {
        reader->at_end = !found;
        *plan = found ? &reader->plan : NULL;
        return TN_OK;
    }
    filled->line = reader->line;
    if (filled->column == 0)
        filled->column = filled->column_end = 1;
    bool one_plan = filled->code != E_PLAN_FILE && filled->code != E_PARQUET_UNKNOWN &&
                    (status == TN_INVALID || filled->code == E_PLAN_LINE_TOO_LONG || filled->code == E_PLAN_TOO_LONG);
    reader->at_end = !one_plan;
    return status;
}

uint64_t tn_plan_reader_line(const tn_plan_reader *reader)
{
    return reader->line;
}

const char *tn_plan_reader_text(const tn_plan_reader *reader, size_t *size)
{
    *size = reader->text_size;
    return reader->text;
}

bool tn_plan_reader_rank(const tn_plan_reader *reader, mpz_t rank)
{
    const tn_buffer *digits = &reader->rank;
    if (digits->size == 0 || strspn(digits->data, "0123456789") != digits->size)
        return false;
    return mpz_set_str(rank, digits->data, 10) == 0;
}
