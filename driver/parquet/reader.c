/* Reads plans from Parquet: from a list column for each field, or from a column of plan lines. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "driver/parquet/parquet_data.h"
#include "driver/parquet/reading.h"
#include "runtime/base/array.h"
#include "runtime/base/bytes.h"
#include "runtime/plan/text/pack.h"

#define TRAYS_PASSED ((uint64_t)1 << 20) /* trays past the limit: a plan that has more is damage */
#define RANK_BYTES_MOST 4096

/* ---- what is wrong */

tn_status tn_parquet_damaged(const tn_plan_reader *reader, const char *what, tn_error *error)
{
    bool opening = reader->line == 0;
    tn_fail(error, TN_INVALID, E_PLAN_FILE, "%s%sthe Parquet file is damaged: %s", opening ? reader->path : "",
            opening ? ": " : "", what);
    tn_error_help(error, "make the file again from its library, or get another copy of it");
    return TN_INVALID;
}

tn_status tn_parquet_unknown(const tn_plan_reader *reader, const char *help, tn_error *error, const char *format, ...)
{
    char text[200];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    bool opening = reader->line == 0;
    tn_fail(error, TN_INVALID, E_PARQUET_UNKNOWN, "%s%s%s, and Tartan does not read that", opening ? reader->path : "",
            opening ? ": " : "", text);
    tn_error_help(error, "%s", help);
    return TN_INVALID;
}

/* ---- opening */

static tn_status refuse_columns(const tn_plan_reader *reader, const char *missing, tn_error *error)
{
    char fields[200];
    tn_fail(error, TN_INVALID, E_PLAN_FILE, "%.200s: there is no column for the field `%.60s`", reader->path, missing);
    tn_error_help(error, "plans are a list column for each field (%s), or a column `plan` of plan lines",
                  tn_value_fields(reader->schema, fields, sizeof fields));
    return TN_INVALID;
}

static tn_status refuse_type(const tn_plan_reader *reader, const char *name, const char *wanted, tn_error *error)
{
    char text[120];
    snprintf(text, sizeof text, "a column of that name has to be %s", wanted);
    return tn_parquet_unknown(reader, text, error, "the column `%.60s` is of another kind", name);
}

/* Are the columns of the fields there, or else the one of plan lines? */
static tn_status choose_columns(tn_plan_reader *reader, tn_error *error)
{
    tn_parquet_reading *r = tn_reading_of(reader);
    const tn_read_column *lines = tn_line_column(r);
    char name[TN_COLUMN_NAME_SIZE];
    for (uint32_t f = 0; f < reader->schema->field_count; f++) {
        const tn_leaf *leaf = &r->columns[f].leaf;
        tn_field_column(reader->schema, f, TN_COLUMNS_PARQUET, name);
        if (!leaf->known && lines->leaf.known)
            r->by_lines = true;
        else if (!leaf->known)
            return refuse_columns(reader, name, error);
        else if (leaf->nested || leaf->type != TN_PARQUET_TEXT || leaf->max_repetition != 1)
            return refuse_type(reader, name, "a list of texts", error);
    }
    if (r->by_lines && (lines->leaf.nested || lines->leaf.type != TN_PARQUET_TEXT || lines->leaf.max_repetition != 0))
        return refuse_type(reader, "plan", "text", error);
    return TN_OK;
}

/* A column of ranks that holds no whole numbers is passed over, and so is the column of lines where it is not needed:
 * they are then not known. */
static void drop_columns(tn_parquet_reading *r)
{
    tn_leaf *rank = &tn_rank_column(r)->leaf;
    bool fixed = rank->type == TN_PARQUET_FIXED && rank->type_length > 0 && rank->type_length <= RANK_BYTES_MOST;
    bool whole = (rank->type == TN_PARQUET_INT32 || rank->type == TN_PARQUET_INT64 || fixed) && rank->scale == 0;
    rank->known = rank->known && whole && !rank->nested && rank->max_repetition == 0;
    if (!r->by_lines)
        tn_line_column(r)->leaf.known = false;
    for (uint32_t c = 0; r->by_lines && c + 2 < r->column_count; c++)
        r->columns[c].leaf.known = false;
}

static const char *codec_name(int64_t codec)
{
    static const char *const names[] = {"nothing", "snappy", "gzip", "lzo", "brotli", "lz4", "zstd", "lz4"};
    return codec >= 0 && codec < (int64_t)(sizeof names / sizeof *names) ? names[codec] : "an unknown way";
}

static tn_status check_codecs(tn_plan_reader *reader, tn_error *error)
{
    const tn_parquet_reading *r = tn_reading_of(reader);
    for (uint64_t i = 0; i < r->group_count * r->column_count; i++) {
        int64_t codec = r->chunks[i].codec;
        if (r->columns[i % r->column_count].leaf.known && codec != TN_CODEC_NONE && codec != TN_CODEC_ZSTD)
            return tn_parquet_unknown(reader,
                                      "write it again compressed by zstd; in DuckDB: COPY ... (COMPRESSION zstd)",
                                      error, "it is compressed by %s", codec_name(codec));
    }
    return TN_OK;
}

tn_status tn_parquet_reader_open(tn_plan_reader *reader, tn_error *error)
{
    uint32_t fields = reader->schema->field_count;
    tn_parquet_reading *r = calloc(1, sizeof *r);
    if (!r)
        return tn_fail_memory(error);
    reader->parquet_state = r;
    r->column_count = fields + 2;
    r->columns = calloc(r->column_count, sizeof *r->columns);
    if (!r->columns)
        return tn_fail_memory(error);
    for (uint32_t c = 0; c < r->column_count; c++)
        r->columns[c].field = c < fields ? c : UINT32_MAX;
    tn_status status = tn_page_unpacker_new(&r->unpacker, error);
    if (status == TN_OK)
        status = tn_footer_read(reader, error);
    if (status == TN_OK)
        status = choose_columns(reader, error);
    if (status != TN_OK)
        return status;
    drop_columns(r);
    status = tn_footer_groups(reader, error);
    r->group_end = r->group_count;
    return status == TN_OK ? check_codecs(reader, error) : status;
}

void tn_parquet_reader_close(tn_plan_reader *reader)
{
    tn_parquet_reading *r = tn_reading_of(reader);
    if (!r)
        return;
    for (uint32_t c = 0; r->columns && c < r->column_count; c++)
        tn_column_free(&r->columns[c]);
    tn_page_unpacker_free(&r->unpacker);
    free(r->columns);
    free(r->footer);
    free(r->group_rows);
    free(r->chunks);
    free(r->values);
    free(r);
    reader->parquet_state = NULL;
}

/* ---- values */

/* The next value of a column that has one a plan. `filled` is false where it is missing. */
static tn_status take_one(tn_plan_reader *reader, tn_read_column *column, tn_read_value *value, bool *filled,
                          tn_error *error)
{
    tn_status status = tn_column_peek(reader, column, error);
    if (status == TN_OK && column->ended)
        return tn_parquet_damaged(reader, "a column has too few values", error);
    *filled = status == TN_OK && column->next_definition == column->leaf.max_definition;
    return status == TN_OK ? tn_column_take(reader, column, value, error) : status;
}

static bool write_wide(tn_buffer *out, tn_thrift_string bytes)
{
    mpz_t rank;
    if (bytes.bytes[0] & 0x80)
        return true; /* below 0: no rank */
    mpz_init(rank);
    mpz_import(rank, bytes.size, 1, 1, 1, 0, bytes.bytes);
    char *digits = mpz_get_str(NULL, 10, rank);
    bool done = digits && tn_buffer_append(out, digits, strlen(digits));
    free(digits);
    mpz_clear(rank);
    return done;
}

static tn_status read_rank(tn_plan_reader *reader, tn_read_column *column, tn_error *error)
{
    tn_read_value value;
    bool filled;
    char digits[24];
    tn_status status = take_one(reader, column, &value, &filled, error);
    if (status != TN_OK || !filled)
        return status;
    if (column->leaf.type == TN_PARQUET_FIXED)
        return write_wide(&reader->rank, value.text) ? TN_OK : tn_fail_memory(error);
    int64_t number = column->encoding == TN_ENCODING_DELTA   ? value.number
                     : column->leaf.type == TN_PARQUET_INT32 ? (int32_t)tn_get_u32(value.text.bytes)
                                                             : tn_get_i64(value.text.bytes);
    int size = number >= 0 ? snprintf(digits, sizeof digits, "%" PRId64, number) : 0;
    return tn_buffer_append(&reader->rank, digits, (size_t)size) ? TN_OK : tn_fail_memory(error);
}

/* ---- lists */

/* What is wrong with a plan, of which all columns are read nevertheless, so that the next one can be. */
typedef struct wrong {
    tn_status status;
    tn_error error;
} wrong;

static void keep_wrong(wrong *w, tn_status status, const tn_error *error)
{
    if (w->status == TN_OK) {
        w->status = status;
        w->error = *error;
    }
}

/* The value of the field that a text writes; TN_NO_CODE, and that kept, where it is none. */
static uint16_t find_code(const tn_plan_reader *reader, const tn_read_column *column, const tn_read_value *value,
                          wrong *w)
{
    const tn_word word = {
        .text = (const char *)value->text.bytes, .size = value->text.size, .column = 1, .extent = value->text.size};
    uint16_t code = TN_NO_CODE;
    tn_error error;
    if (value->place != UINT32_MAX) {
        code = column->codes[value->place];
    } else {
        uint32_t found = tn_value_find(reader->schema, column->field, &word);
        code = found == TN_NO_VALUE ? TN_NO_CODE : (uint16_t)found;
    }
    if (code == TN_NO_CODE)
        keep_wrong(w, tn_value_unknown(reader->schema, column->field, &word, &error), &error);
    return code;
}

static void keep_missing(const tn_plan_reader *reader, uint32_t field, wrong *w)
{
    tn_error error;
    tn_fail(&error, TN_INVALID, E_PLAN_SYNTAX, "a tray has no value for the field `%.100s`",
            tn_text(reader->schema->module, reader->schema->fields[field].name));
    tn_error_help(&error, "each list of a plan holds a value for each of its trays");
    keep_wrong(w, TN_INVALID, &error);
}

static bool make_room(tn_parquet_reading *r, size_t trays, uint32_t fields)
{
    return tn_array_reserve(&r->values, &r->values_room, 0, tn_size_of(trays, fields), 1);
}

/* Reads a field's list of the plan: its values into r->values, its size into *length. */
static tn_status read_list(tn_plan_reader *reader, tn_read_column *column, uint64_t *length, wrong *w, tn_error *error)
{
    tn_parquet_reading *r = tn_reading_of(reader);
    uint32_t fields = reader->schema->field_count;
    *length = 0;
    for (bool first = true;; first = false) {
        tn_read_value value;
        tn_status status = tn_column_peek(reader, column, error);
        if (status != TN_OK)
            return status;
        if (first && (column->ended || column->next_repetition > 0))
            return tn_parquet_damaged(reader, "a column has too few lists", error);
        if (!first && (column->ended || column->next_repetition == 0))
            return TN_OK;
        unsigned definition = column->next_definition;
        status = tn_column_take(reader, column, &value, error);
        if (status != TN_OK)
            return status;
        if (definition < column->leaf.list_definition)
            continue; /* a list without elements */
        uint64_t k = (*length)++;
        if (k >= reader->max_length + TRAYS_PASSED)
            return tn_parquet_damaged(reader, "a plan has more than a million trays", error);
        if (definition < column->leaf.max_definition)
            keep_missing(reader, column->field, w);
        if (k >= reader->max_length || definition < column->leaf.max_definition)
            continue;
        if (!make_room(r, (size_t)k + 1, fields))
            return tn_fail_memory(error);
        uint16_t code = find_code(reader, column, &value, w);
        r->values[k * fields + column->field] = (uint8_t)code;
    }
}

static tn_status refuse_lengths(const tn_plan_reader *reader, uint32_t field, uint64_t length, uint64_t first,
                                tn_error *error)
{
    const tn_schema *schema = reader->schema;
    tn_fail(error, TN_INVALID, E_PLAN_SYNTAX,
            "the list of `%.80s` has %" PRIu64 " values, and that of `%.80s` %" PRIu64,
            tn_text(schema->module, schema->fields[0].name), first, tn_text(schema->module, schema->fields[field].name),
            length);
    tn_error_help(error, "each list of a plan holds a value for each of its trays");
    return TN_INVALID;
}

static tn_status make_plan(tn_plan_reader *reader, size_t length, tn_error *error)
{
    static const tn_word place = {.text = "", .column = 1};
    tn_parquet_reading *r = tn_reading_of(reader);
    tn_status status = tn_plan_reserve(&reader->plan, length) ? TN_OK : tn_fail_memory(error);
    for (size_t k = 0; status == TN_OK && k < length; k++)
        status = tn_value_tray(reader->schema, r->values + k * reader->schema->field_count, &place,
                               &reader->plan.trays[k], error);
    reader->plan.length = length;
    return status;
}

static tn_status read_lists(tn_plan_reader *reader, tn_error *error)
{
    tn_parquet_reading *r = tn_reading_of(reader);
    wrong w = {.status = TN_OK};
    uint64_t first = 0, length;
    for (uint32_t f = 0; f < reader->schema->field_count; f++) {
        tn_error differs;
        tn_status status = read_list(reader, &r->columns[f], &length, &w, error);
        if (status != TN_OK)
            return status;
        first = f == 0 ? length : first;
        if (length != first)
            keep_wrong(&w, refuse_lengths(reader, f, length, first, &differs), &differs);
    }
    if (first > reader->max_length)
        return tn_reader_too_long(reader, first, error);
    if (w.status == TN_OK)
        return make_plan(reader, (size_t)first, error);
    *error = w.error;
    return w.status;
}

/* ---- plan lines */

static tn_status read_line(tn_plan_reader *reader, tn_error *error)
{
    tn_read_value value = {.place = 0};
    bool filled;
    tn_status status = take_one(reader, tn_line_column(tn_reading_of(reader)), &value, &filled, error);
    if (status != TN_OK)
        return status;
    if (!filled)
        return tn_fail(error, TN_INVALID, E_PLAN_SYNTAX, "the column `plan` holds no text here");
    if (value.text.size > reader->max_line)
        return tn_reader_line_too_long(reader->max_line, reader->line, error);
    reader->text = (const char *)value.text.bytes;
    reader->text_size = value.text.size;
    return tn_plan_scan_line(reader->scanner, reader->text, value.text.size, reader->max_length, &reader->plan, error);
}

/* ---- row groups */

tn_plan_part tn_parquet_reader_groups(const tn_plan_reader *reader)
{
    return (tn_plan_part){0, tn_reading_of(reader)->group_count};
}

uint64_t tn_parquet_reader_count(const tn_plan_reader *reader, tn_plan_part groups)
{
    uint64_t count = 0;
    for (uint64_t g = groups.begin; g < groups.end; g++)
        count += tn_reading_of(reader)->group_rows[g];
    return count;
}

void tn_parquet_reader_restrict(tn_plan_reader *reader, tn_plan_part groups)
{
    tn_reading_of(reader)->group = groups.begin;
    tn_reading_of(reader)->group_end = groups.end;
}

static tn_status end_group(tn_plan_reader *reader, tn_error *error)
{
    tn_parquet_reading *r = tn_reading_of(reader);
    for (uint32_t c = 0; c < r->column_count; c++) {
        tn_read_column *column = &r->columns[c];
        tn_status status = column->leaf.known ? tn_column_peek(reader, column, error) : TN_OK;
        if (status != TN_OK)
            return status;
        if (column->leaf.known && !column->ended)
            return tn_parquet_damaged(reader, "a column has more values than its row group has plans", error);
    }
    return TN_OK;
}

/* Begins the next group that has plans; *more is false behind the last. */
static tn_status next_group(tn_plan_reader *reader, bool *more, tn_error *error)
{
    tn_parquet_reading *r = tn_reading_of(reader);
    while (r->rows_left == 0 && (r->begun || r->group < r->group_end)) {
        tn_status status = r->begun ? end_group(reader, error) : TN_OK;
        r->begun = false;
        if (status != TN_OK)
            return status;
        if (r->group == r->group_end)
            break;
        r->begun = true;
        r->rows_left = r->group_rows[r->group];
        for (uint32_t c = 0; c < r->column_count; c++)
            tn_column_begin(&r->columns[c], &r->chunks[r->group * r->column_count + c]);
        r->group++;
    }
    *more = r->rows_left > 0;
    return *more ? TN_OK : tn_plan_reader_unchanged(reader, error);
}

tn_status tn_parquet_reader_next(tn_plan_reader *reader, bool *found, tn_error *error)
{
    tn_parquet_reading *r = tn_reading_of(reader);
    tn_status status = next_group(reader, found, error);
    reader->line += status != TN_OK || *found; /* what is wrong between two groups is said of the plan behind */
    if (status != TN_OK || !*found)
        return status;
    r->rows_left--;
    if (tn_rank_column(r)->leaf.known)
        status = read_rank(reader, tn_rank_column(r), error);
    if (status == TN_OK)
        status = r->by_lines ? read_line(reader, error) : read_lists(reader, error);
    return status;
}
