/* Reads plans from Parquet: from a list column for each field, or from a column of plan lines. */
#include "driver/parquet/reader.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/bytes.h"
#include "runtime/plan/text/pack.h"

static tn_status parquet_unknown(const tn_plan_reader *reader, const char *help, tn_error *error, const char *format,
                                 ...) __attribute__((format(printf, 4, 5)));

/* ---- reads the pages of a column */

#define WINDOW ((size_t)1 << 18)    /* bytes of the file that are read at a time */
#define HEAD_FIRST ((size_t)1 << 9) /* bytes of a head that are looked at; where it is longer, HEAD_MOST */
#define HEAD_MOST ((size_t)1 << 20)
#define PAGE_MOST (INT64_C(1) << 28) /* bytes of a page */

/* ---- bytes */

/* Makes `size` bytes from column->at on stand in the window. They are within the chunk. */
static tn_status look(tn_plan_reader *reader, tn_read_column *column, size_t size, const uint8_t **bytes,
                      tn_error *error)
{
    tn_buffer *window = &column->window;
    uint64_t behind = column->at - column->window_at, left = column->chunk.end - column->at;
    if (window->size == 0 || behind > window->size || window->size - behind < size) {
        size_t wanted = size > WINDOW ? size : WINDOW;
        wanted = wanted < left ? wanted : (size_t)left;
        window->size = 0;
        if (!tn_buffer_reserve(window, wanted))
            return tn_fail_memory(error);
        tn_status status = tn_parquet_bytes(reader, column->at, window->data, wanted, error);
        if (status != TN_OK)
            return status;
        window->size = wanted;
        column->window_at = column->at;
        behind = 0;
    }
    *bytes = (const uint8_t *)window->data + behind;
    return TN_OK;
}

/* Reads the head of the next page, and passes over it. */
static tn_status read_head(tn_plan_reader *reader, tn_read_column *column, tn_page_head *head, tn_error *error)
{
    uint64_t left = column->chunk.end - column->at;
    const uint8_t *bytes = NULL;
    for (size_t most = HEAD_FIRST; most <= HEAD_MOST; most *= HEAD_MOST / HEAD_FIRST) {
        size_t size = left < most ? (size_t)left : most;
        tn_status status = look(reader, column, size, &bytes, error);
        if (status != TN_OK)
            return status;
        tn_thrift_in in = {bytes, bytes + size, false};
        if (!tn_page_head_read(&in, head))
            continue;
        column->at += (uint64_t)(in.at - bytes);
        if ((uint64_t)head->packed > column->chunk.end - column->at)
            return tn_parquet_damaged(reader, "a page is larger than what holds it", error);
        if (head->size > PAGE_MOST || head->packed > PAGE_MOST)
            return parquet_unknown(reader, "write it again in smaller row groups", error,
                                   "a page takes more than %lld MiB", (long long)(PAGE_MOST >> 20));
        return TN_OK;
    }
    return tn_parquet_damaged(reader, "a page does not begin as one does", error);
}

/* Reads the page's bytes into `out`, and undoes their compression: `head->size` of them. The levels of a page of the
 * second version are before what is compressed. */
static tn_status read_body(tn_plan_reader *reader, tn_read_column *column, const tn_page_head *head, tn_buffer *out,
                           tn_error *error)
{
    const uint8_t *bytes = NULL;
    size_t size = (size_t)head->size, packed = (size_t)head->packed;
    bool second = head->page == TN_PAGE_DATA_V2;
    uint64_t levels = second ? (uint64_t)head->levels[0] + (uint64_t)head->levels[1] : 0;
    out->size = 0;
    if (levels > size || levels > packed)
        return tn_parquet_damaged(reader, "a page's levels are larger than the page", error);
    tn_status status = look(reader, column, packed, &bytes, error);
    if (status == TN_OK && !tn_buffer_reserve(out, size))
        status = tn_fail_memory(error);
    if (status != TN_OK)
        return status;
    bool compressed = column->chunk.codec == TN_CODEC_ZSTD && head->packs;
    memcpy(out->data, bytes, (size_t)levels);
    uint8_t *rest = (uint8_t *)out->data + levels;
    bool whole = compressed ? tn_page_unpack(&tn_reading_of(reader)->unpacker, bytes + levels, packed - (size_t)levels,
                                             rest, size - (size_t)levels)
                            : size == packed;
    if (!whole)
        return tn_parquet_damaged(reader, "what is compressed in a page is not as large as it says", error);
    if (!compressed)
        memcpy(rest, bytes + levels, size - (size_t)levels);
    out->size = size;
    column->at += packed;
    return TN_OK;
}

/* ---- dictionaries */

/* The values of the dictionary's page, one behind another. */
static tn_status split_dictionary(tn_plan_reader *reader, tn_read_column *column, size_t count, tn_error *error)
{
    const uint8_t *bytes = (const uint8_t *)column->dictionary.data, *end = bytes + column->dictionary.size;
    bool text = column->leaf.type == TN_PARQUET_TEXT;
    size_t fixed = column->leaf.type == TN_PARQUET_INT32   ? 4
                   : column->leaf.type == TN_PARQUET_INT64 ? 8
                                                           : (size_t)column->leaf.type_length;
    size_t least = text ? 4 : fixed;
    if (count > column->dictionary.size / least)
        return tn_parquet_damaged(reader, "a dictionary is cut off", error);
    if (!tn_array_reserve(&column->words, &column->word_room, 0, count, sizeof *column->words))
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++) {
        if ((size_t)(end - bytes) < least)
            return tn_parquet_damaged(reader, "a dictionary is cut off", error);
        size_t size = text ? tn_get_u32(bytes) : fixed;
        bytes += text ? 4 : 0;
        if (size > (size_t)(end - bytes))
            return tn_parquet_damaged(reader, "a dictionary is cut off", error);
        column->words[i] = (tn_thrift_string){bytes, size};
        bytes += size;
    }
    column->word_count = count;
    return TN_OK;
}

/* Which values of the field the dictionary's texts are. */
static tn_status find_codes(tn_plan_reader *reader, tn_read_column *column, tn_error *error)
{
    if (!tn_array_reserve(&column->codes, &column->code_room, 0, column->word_count, sizeof *column->codes))
        return tn_fail_memory(error);
    for (size_t i = 0; i < column->word_count; i++) {
        const tn_word word = {.text = (const char *)column->words[i].bytes, .size = column->words[i].size};
        uint32_t value = tn_value_find(reader->schema, column->field, &word);
        column->codes[i] = value == TN_NO_VALUE ? TN_NO_CODE : (uint16_t)value;
    }
    return TN_OK;
}

static tn_status read_dictionary(tn_plan_reader *reader, tn_read_column *column, const tn_page_head *head,
                                 tn_error *error)
{
    if (column->word_count > 0)
        return tn_parquet_damaged(reader, "a column has two dictionaries", error);
    tn_status status = read_body(reader, column, head, &column->dictionary, error);
    if (status == TN_OK)
        status = split_dictionary(reader, column, (size_t)head->values, error);
    return status == TN_OK && column->field != UINT32_MAX ? find_codes(reader, column, error) : status;
}

/* ---- pages of values */

static unsigned bits_for(unsigned most)
{
    return most ? 32 - (unsigned)__builtin_clz(most) : 0;
}

/* Begins levels, and takes them from *bytes: so many bytes, or (-1) what stands before them. */
static bool begin_levels(tn_runs *runs, unsigned most, int64_t size, tn_thrift_in *bytes)
{
    size_t left = (size_t)(bytes->end - bytes->at);
    if (most == 0 && size < 0)
        return true;
    if (size < 0) {
        if (left < 4)
            return false;
        size = tn_get_u32(bytes->at);
        bytes->at += 4;
        left -= 4;
    }
    if ((uint64_t)size > left)
        return false;
    tn_runs_begin(runs, bits_for(most), bytes->at, (size_t)size);
    bytes->at += size;
    return true;
}

static const char *encoding_name(int64_t encoding)
{
    static const char *const names[] = {
        "PLAIN",          "GROUP_VAR_INT",       "PLAIN_DICTIONARY",        "RLE",
        "BIT_PACKED",     "DELTA_BINARY_PACKED", "DELTA_LENGTH_BYTE_ARRAY", "DELTA_BYTE_ARRAY",
        "RLE_DICTIONARY", "BYTE_STREAM_SPLIT"};
    return encoding >= 0 && encoding < (int64_t)(sizeof names / sizeof *names) ? names[encoding] : "unknown";
}

static tn_status begin_values(tn_plan_reader *reader, tn_read_column *column, const tn_thrift_in *rest, tn_error *error)
{
    size_t size = (size_t)(rest->end - rest->at);
    bool integer = column->leaf.type == TN_PARQUET_INT32 || column->leaf.type == TN_PARQUET_INT64;
    column->plain = *rest;
    switch (column->encoding) {
    case TN_ENCODING_PLAIN:
        return TN_OK;
    case TN_ENCODING_PLAIN_DICTIONARY:
    case TN_ENCODING_RLE_DICTIONARY:
        if (size == 0) /* a page of no values */
            tn_runs_begin(&column->places, 0, rest->at, 0);
        else if (*rest->at > 32)
            return tn_parquet_damaged(reader, "the places in a dictionary have more than 32 bits", error);
        else
            tn_runs_begin(&column->places, *rest->at, rest->at + 1, size - 1);
        return TN_OK;
    case TN_ENCODING_DELTA:
        if (integer && tn_deltas_begin(&column->deltas, rest->at, size))
            return TN_OK;
        if (integer)
            return tn_parquet_damaged(reader, "the differences of a page do not begin as they should", error);
        break;
    default:
        break;
    }
    return parquet_unknown(reader, "write it again with dictionaries, or with PLAIN values", error,
                           "a column is encoded as %s", encoding_name(column->encoding));
}

static tn_status begin_page(tn_plan_reader *reader, tn_read_column *column, const tn_page_head *head, tn_error *error)
{
    tn_status status = read_body(reader, column, head, &column->page, error);
    if (status != TN_OK)
        return status;
    const uint8_t *bytes = (const uint8_t *)column->page.data;
    tn_thrift_in rest = {bytes, bytes + column->page.size, false};
    bool second = head->page == TN_PAGE_DATA_V2;
    if (!begin_levels(&column->repetition, column->leaf.max_repetition, second ? head->levels[0] : -1, &rest) ||
        !begin_levels(&column->definition, column->leaf.max_definition, second ? head->levels[1] : -1, &rest))
        return tn_parquet_damaged(reader, "the levels of a page are cut off", error);
    column->encoding = head->encoding;
    column->left = (uint64_t)head->values;
    return begin_values(reader, column, &rest, error);
}

/* The next page of values: its levels and values are ready. (column_page.c) `ended` is set where there is none. */
static tn_status column_page(tn_plan_reader *reader, tn_read_column *column, tn_error *error)
{
    tn_page_head head;
    column->ended = column->at >= column->chunk.end;
    if (column->ended)
        return TN_OK;
    tn_status status = read_head(reader, column, &head, error);
    if (status != TN_OK)
        return status;
    if (head.has_values && head.page == TN_PAGE_DICTIONARY)
        return read_dictionary(reader, column, &head, error);
    if (head.has_values && (head.page == TN_PAGE_DATA || head.page == TN_PAGE_DATA_V2))
        return begin_page(reader, column, &head, error);
    column->at += (uint64_t)head.packed; /* a page that says nothing of values */
    return TN_OK;
}

/* Begins a row group's pages. */
static void column_begin(tn_read_column *column, const tn_read_chunk *chunk)
{
    column->chunk = *chunk;
    column->at = chunk->begin;
    column->window.size = 0;
    column->left = 0;
    column->word_count = 0;
    column->peeked = column->ended = false;
}

static void column_free(tn_read_column *column)
{
    free(column->window.data);
    free(column->page.data);
    free(column->dictionary.data);
    free(column->words);
    free(column->codes);
}

/* A level, of which there are none where it can only be 0. */
static bool read_level(tn_runs *runs, unsigned most, unsigned *level)
{
    uint32_t read = 0;
    if (most > 0 && !tn_runs_next(runs, &read))
        return false;
    *level = read;
    return read <= most;
}

/* Makes next_repetition and next_definition those of the next place, or `ended` true. */
static tn_status column_peek(tn_plan_reader *reader, tn_read_column *column, tn_error *error)
{
    while (!column->peeked && !column->ended) {
        if (column->left == 0) {
            tn_status status = column_page(reader, column, error);
            if (status != TN_OK)
                return status;
            continue;
        }
        if (!read_level(&column->repetition, column->leaf.max_repetition, &column->next_repetition) ||
            !read_level(&column->definition, column->leaf.max_definition, &column->next_definition))
            return tn_parquet_damaged(reader, "a page has too few levels", error);
        column->left--;
        column->peeked = true;
    }
    return TN_OK;
}

/* ---- values */

static size_t plain_size(const tn_read_column *column)
{
    return column->leaf.type == TN_PARQUET_INT32   ? 4
           : column->leaf.type == TN_PARQUET_INT64 ? 8
                                                   : (size_t)column->leaf.type_length;
}

/* A value as it is: a text behind its size, or so many bytes. */
static bool take_plain(const tn_read_column *column, tn_thrift_in *in, tn_thrift_string *text)
{
    size_t left = (size_t)(in->end - in->at), size = plain_size(column);
    if (column->leaf.type == TN_PARQUET_TEXT) {
        if (left < 4)
            return false;
        size = tn_get_u32(in->at);
        in->at += 4;
        left -= 4;
    }
    if (size > left)
        return false;
    *text = (tn_thrift_string){in->at, size};
    in->at += size;
    return true;
}

static bool take_value(tn_read_column *column, tn_read_value *value)
{
    *value = (tn_read_value){.place = UINT32_MAX};
    switch (column->encoding) {
    case TN_ENCODING_PLAIN:
        return take_plain(column, &column->plain, &value->text);
    case TN_ENCODING_DELTA:
        return tn_deltas_next(&column->deltas, &value->number);
    default:
        if (!tn_runs_next(&column->places, &value->place) || value->place >= column->word_count)
            return false;
        value->text = column->words[value->place];
        return true;
    }
}

/* Takes the place, and where it holds a value (its definition is the most), that. */
static tn_status column_take(tn_plan_reader *reader, tn_read_column *column, tn_read_value *value, tn_error *error)
{
    column->peeked = false;
    if (column->next_definition < column->leaf.max_definition)
        return TN_OK;
    if (!take_value(column, value))
        return tn_parquet_damaged(reader, "a page has too few values, or one that its dictionary does not have", error);
    return TN_OK;
}

/* ---- reads plans from Parquet */

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

static tn_status parquet_unknown(const tn_plan_reader *reader, const char *help, tn_error *error, const char *format,
                                 ...)
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
    return parquet_unknown(reader, text, error, "the column `%.60s` is of another kind", name);
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
            return parquet_unknown(reader, "write it again compressed by zstd; in DuckDB: COPY ... (COMPRESSION zstd)",
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
        column_free(&r->columns[c]);
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
    tn_status status = column_peek(reader, column, error);
    if (status == TN_OK && column->ended)
        return tn_parquet_damaged(reader, "a column has too few values", error);
    *filled = status == TN_OK && column->next_definition == column->leaf.max_definition;
    return status == TN_OK ? column_take(reader, column, value, error) : status;
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
        tn_status status = column_peek(reader, column, error);
        if (status != TN_OK)
            return status;
        if (first && (column->ended || column->next_repetition > 0))
            return tn_parquet_damaged(reader, "a column has too few lists", error);
        if (!first && (column->ended || column->next_repetition == 0))
            return TN_OK;
        unsigned definition = column->next_definition;
        status = column_take(reader, column, &value, error);
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
        tn_status status = column->leaf.known ? column_peek(reader, column, error) : TN_OK;
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
            column_begin(&r->columns[c], &r->chunks[r->group * r->column_count + c]);
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
