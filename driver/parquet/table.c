/* Writes tables in Parquet: row group by row group, a page for each column. */
#include "driver/parquet/table.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "driver/parquet/encoding.h"
#include "runtime/base/bytes.h"
#include "runtime/base/file.h"

enum { GROUP_ROWS = 16384, UTF8 = 0 };

/* The values of the row group in hand. */
typedef struct column {
    tn_buffer values;
    uint8_t *there; /* a bit a row: it has a value */
} column;

/* Where a column of a row group is in the file. */
typedef struct chunk {
    uint64_t begin, end, loose;
} chunk;

struct tn_parquet_table {
    FILE *out;
    const char *path;
    const tn_parquet_column *columns;
    size_t count;
    const char *const (*metadata)[2];
    size_t metadata_count;
    column *of;
    size_t in_group;
    uint64_t rows, groups, offset;
    tn_buffer about_groups; /* what the footer says of them, in Thrift */
    tn_buffer body, page;
    tn_page_packer packer;
};

static tn_status write_out(tn_parquet_table *t, const tn_buffer *bytes, tn_error *error)
{
    t->offset += bytes->size;
    if (bytes->size == 0 || fwrite(bytes->data, 1, bytes->size, t->out) == bytes->size)
        return TN_OK;
    return tn_cannot_write(t->path, errno, error);
}

tn_status tn_parquet_table_begin(FILE *out, const char *path, const tn_parquet_column *columns, size_t count,
                                 const char *const (*metadata)[2], size_t metadata_count, tn_parquet_table **table,
                                 tn_error *error)
{
    tn_parquet_table *t = calloc(1, sizeof *t);
    *table = t;
    if (!t)
        return tn_fail_memory(error);
    *t = (tn_parquet_table){.out = out,
                            .path = path,
                            .columns = columns,
                            .count = count,
                            .metadata = metadata,
                            .metadata_count = metadata_count,
                            .of = calloc(count + 1, sizeof *t->of)};
    tn_status status = t->of ? tn_page_packer_new(&t->packer, error) : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < count; i++)
        if (!(t->of[i].there = calloc(GROUP_ROWS / 8, 1)))
            status = tn_fail_memory(error);
    if (status == TN_OK && !tn_buffer_append(&t->body, TN_PARQUET_MAGIC, 4))
        status = tn_fail_memory(error);
    return status == TN_OK ? write_out(t, &t->body, error) : status;
}

void tn_parquet_table_free(tn_parquet_table *t)
{
    if (!t)
        return;
    for (size_t i = 0; t->of && i < t->count; i++) {
        free(t->of[i].values.data);
        free(t->of[i].there);
    }
    free(t->of);
    free(t->about_groups.data);
    free(t->body.data);
    free(t->page.data);
    tn_page_packer_free(&t->packer);
    free(t);
}

/* ---- row groups */

/* Which rows have a value, behind the size of that; then the values. */
static bool make_body(tn_parquet_table *t, const column *of)
{
    t->body.size = 0;
    tn_buffer_append(&t->body, "\0\0\0", 4);
    tn_bits_write(&t->body, of->there, t->in_group);
    if (!t->body.failed)
        tn_put_u32((uint8_t *)t->body.data, (uint32_t)(t->body.size - 4));
    tn_buffer_append(&t->body, of->values.data, of->values.size);
    return !t->body.failed;
}

static tn_status write_column(tn_parquet_table *t, size_t number, chunk *made, tn_error *error)
{
    const tn_page_kind kind = {TN_PAGE_DATA, TN_ENCODING_PLAIN, t->in_group};
    *made = (chunk){.begin = t->offset};
    t->page.size = 0;
    if (!make_body(t, &t->of[number]) || !tn_page_write(&t->packer, kind, &t->body, &t->page, &made->loose))
        return tn_fail_memory(error);
    tn_status status = write_out(t, &t->page, error);
    made->end = t->offset;
    return status;
}

static void describe_column(const tn_parquet_table *t, size_t number, const chunk *made, tn_thrift_out *to)
{
    tn_thrift_element(to);
    tn_thrift_number(to, 2, TN_THRIFT_I64, (int64_t)made->begin);
    tn_thrift_begin(to, 3);
    tn_thrift_number(to, 1, TN_THRIFT_I32, t->columns[number].type);
    tn_thrift_list(to, 2, TN_THRIFT_I32, 2);
    tn_thrift_element_number(to, TN_ENCODING_PLAIN);
    tn_thrift_element_number(to, TN_ENCODING_RLE);
    tn_thrift_list(to, 3, TN_THRIFT_BINARY, 1);
    tn_thrift_element_text(to, t->columns[number].name);
    tn_thrift_number(to, 4, TN_THRIFT_I32, TN_CODEC_ZSTD);
    tn_thrift_number(to, 5, TN_THRIFT_I64, (int64_t)t->in_group);
    tn_thrift_number(to, 6, TN_THRIFT_I64, (int64_t)made->loose);
    tn_thrift_number(to, 7, TN_THRIFT_I64, (int64_t)(made->end - made->begin));
    tn_thrift_number(to, 9, TN_THRIFT_I64, (int64_t)made->begin);
    tn_thrift_end(to);
    tn_thrift_end(to);
}

static void describe_group(tn_parquet_table *t, const chunk *chunks)
{
    tn_thrift_out to = tn_thrift_to(&t->about_groups);
    uint64_t loose = 0;
    tn_thrift_list(&to, 1, TN_THRIFT_STRUCT, t->count);
    for (size_t i = 0; i < t->count; i++) {
        describe_column(t, i, &chunks[i], &to);
        loose += chunks[i].loose;
    }
    tn_thrift_number(&to, 2, TN_THRIFT_I64, (int64_t)loose);
    tn_thrift_number(&to, 3, TN_THRIFT_I64, (int64_t)t->in_group);
    tn_thrift_end(&to);
}

static tn_status end_group(tn_parquet_table *t, tn_error *error)
{
    if (t->in_group == 0)
        return TN_OK;
    chunk *chunks = calloc(t->count + 1, sizeof *chunks);
    tn_status status = chunks ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < t->count; i++)
        status = write_column(t, i, &chunks[i], error);
    if (status == TN_OK)
        describe_group(t, chunks);
    free(chunks);
    for (size_t i = 0; i < t->count; i++) {
        t->of[i].values.size = 0;
        memset(t->of[i].there, 0, GROUP_ROWS / 8);
    }
    t->in_group = 0;
    t->groups++;
    return status == TN_OK && t->about_groups.failed ? tn_fail_memory(error) : status;
}

/* ---- rows */

static bool add_value(tn_buffer *values, enum tn_parquet_type type, const char *text)
{
    uint8_t bytes[8];
    size_t size = strlen(text);
    double real = type == TN_PARQUET_DOUBLE ? strtod(text, NULL) : 0;
    uint64_t bits;
    memcpy(&bits, &real, sizeof bits);
    if (type == TN_PARQUET_TEXT)
        tn_put_u32(bytes, (uint32_t)size);
    else
        tn_put_u64(bytes, type == TN_PARQUET_DOUBLE ? bits : (uint64_t)strtoll(text, NULL, 10));
    if (type != TN_PARQUET_TEXT)
        return tn_buffer_append(values, (const char *)bytes, 8);
    return tn_buffer_append(values, (const char *)bytes, 4) && tn_buffer_append(values, text, size);
}

tn_status tn_parquet_table_add(tn_parquet_table *t, const char *const *cells, tn_error *error)
{
    for (size_t i = 0; i < t->count; i++) {
        if (!cells[i])
            continue;
        t->of[i].there[t->in_group / 8] |= (uint8_t)(1u << t->in_group % 8);
        if (!add_value(&t->of[i].values, t->columns[i].type, cells[i]))
            return tn_fail_memory(error);
    }
    t->rows++;
    return ++t->in_group == GROUP_ROWS ? end_group(t, error) : TN_OK;
}

/* ---- the footer */

static void describe_columns(const tn_parquet_table *t, tn_thrift_out *to)
{
    tn_thrift_list(to, 2, TN_THRIFT_STRUCT, t->count + 1);
    tn_thrift_element(to);
    tn_thrift_text(to, 4, "table");
    tn_thrift_number(to, 5, TN_THRIFT_I32, (int64_t)t->count);
    tn_thrift_end(to);
    for (size_t i = 0; i < t->count; i++) {
        tn_thrift_element(to);
        tn_thrift_number(to, 1, TN_THRIFT_I32, t->columns[i].type);
        tn_thrift_number(to, 3, TN_THRIFT_I32, TN_PARQUET_OPTIONAL);
        tn_thrift_text(to, 4, t->columns[i].name);
        if (t->columns[i].type == TN_PARQUET_TEXT)
            tn_thrift_number(to, 6, TN_THRIFT_I32, UTF8);
        tn_thrift_end(to);
    }
}

static void describe_metadata(const tn_parquet_table *t, tn_thrift_out *to)
{
    size_t count = 0;
    for (size_t i = 0; i < t->metadata_count; i++)
        count += t->metadata[i][1] != NULL;
    tn_thrift_list(to, 5, TN_THRIFT_STRUCT, count);
    for (size_t i = 0; i < t->metadata_count; i++) {
        if (!t->metadata[i][1])
            continue;
        tn_thrift_element(to);
        tn_thrift_text(to, 1, t->metadata[i][0]);
        tn_thrift_text(to, 2, t->metadata[i][1]);
        tn_thrift_end(to);
    }
}

tn_status tn_parquet_table_end(tn_parquet_table *t, tn_error *error)
{
    tn_status status = end_group(t, error);
    if (status != TN_OK)
        return status;
    uint8_t size[4];
    tn_thrift_out to = tn_thrift_to(&t->body);
    t->body.size = 0;
    tn_thrift_number(&to, 1, TN_THRIFT_I32, 1);
    describe_columns(t, &to);
    tn_thrift_number(&to, 3, TN_THRIFT_I64, (int64_t)t->rows);
    tn_thrift_list(&to, 4, TN_THRIFT_STRUCT, (size_t)t->groups); /* each is in memory */
    tn_buffer_append(&t->body, t->about_groups.data ? t->about_groups.data : "", t->about_groups.size);
    describe_metadata(t, &to);
    tn_thrift_text(&to, 6, "tartan");
    tn_thrift_end(&to);
    tn_put_u32(size, (uint32_t)t->body.size);
    tn_buffer_append(&t->body, (const char *)size, 4);
    tn_buffer_append(&t->body, TN_PARQUET_MAGIC, 4);
    return t->body.failed ? tn_fail_memory(error) : write_out(t, &t->body, error);
}
