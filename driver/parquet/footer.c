/* The footer of a file of plans in Parquet: its columns, where their pages are, and how the file was made. */
#include <stdlib.h>
#include <string.h>

#include "driver/parquet/writing.h"
#include "runtime/base/bytes.h"

#define PROGRAM "tartan " /* what a version may begin with */

/* ---- columns */

/* The logical type that has nothing more to be said of it. */
static void plain_logical(tn_thrift_out *t, int member)
{
    tn_thrift_begin(t, 10);
    tn_thrift_begin(t, member);
    tn_thrift_end(t);
    tn_thrift_end(t);
}

static void write_root(tn_thrift_out *t, unsigned children)
{
    tn_thrift_element(t);
    tn_thrift_text(t, 4, "plans");
    tn_thrift_number(t, 5, TN_THRIFT_I32, children);
    tn_thrift_end(t);
}

static void write_number(tn_thrift_out *t, const char *name, enum tn_parquet_type type)
{
    tn_thrift_element(t);
    tn_thrift_number(t, 1, TN_THRIFT_I32, type);
    tn_thrift_number(t, 3, TN_THRIFT_I32, TN_PARQUET_REQUIRED);
    tn_thrift_text(t, 4, name);
    tn_thrift_end(t);
}

static void write_wide_rank(tn_thrift_out *t, unsigned bytes, unsigned digits)
{
    tn_thrift_element(t);
    tn_thrift_number(t, 1, TN_THRIFT_I32, TN_PARQUET_FIXED);
    tn_thrift_number(t, 2, TN_THRIFT_I32, bytes);
    tn_thrift_number(t, 3, TN_THRIFT_I32, TN_PARQUET_REQUIRED);
    tn_thrift_text(t, 4, "rank");
    tn_thrift_number(t, 6, TN_THRIFT_I32, TN_CONVERTED_DECIMAL);
    tn_thrift_number(t, 7, TN_THRIFT_I32, 0);
    tn_thrift_number(t, 8, TN_THRIFT_I32, digits);
    tn_thrift_begin(t, 10);
    tn_thrift_begin(t, TN_LOGICAL_DECIMAL);
    tn_thrift_number(t, 1, TN_THRIFT_I32, 0);
    tn_thrift_number(t, 2, TN_THRIFT_I32, digits);
    tn_thrift_end(t);
    tn_thrift_end(t);
    tn_thrift_end(t);
}

static void write_text(tn_thrift_out *t, const char *name)
{
    tn_thrift_element(t);
    tn_thrift_number(t, 1, TN_THRIFT_I32, TN_PARQUET_TEXT);
    tn_thrift_number(t, 3, TN_THRIFT_I32, TN_PARQUET_REQUIRED);
    tn_thrift_text(t, 4, name);
    tn_thrift_number(t, 6, TN_THRIFT_I32, TN_CONVERTED_UTF8);
    plain_logical(t, TN_LOGICAL_STRING);
    tn_thrift_end(t);
}

/* A list of texts: a group of the list's name, in it a repeated group `list`, in that `element`. */
static void write_list(tn_thrift_out *t, const char *name)
{
    tn_thrift_element(t);
    tn_thrift_number(t, 3, TN_THRIFT_I32, TN_PARQUET_REQUIRED);
    tn_thrift_text(t, 4, name);
    tn_thrift_number(t, 5, TN_THRIFT_I32, 1);
    tn_thrift_number(t, 6, TN_THRIFT_I32, TN_CONVERTED_LIST);
    plain_logical(t, TN_LOGICAL_LIST);
    tn_thrift_end(t);
    tn_thrift_element(t);
    tn_thrift_number(t, 3, TN_THRIFT_I32, TN_PARQUET_REPEATED);
    tn_thrift_text(t, 4, "list");
    tn_thrift_number(t, 5, TN_THRIFT_I32, 1);
    tn_thrift_end(t);
    write_text(t, "element");
}

static void write_columns(const tn_parquet_writing *w, tn_thrift_out *t)
{
    unsigned columns = tn_column_count(w);
    tn_thrift_list(t, 2, TN_THRIFT_STRUCT, 1 + columns + 2 * w->schema->field_count);
    write_root(t, columns);
    if (w->rank_bytes > 0)
        write_wide_rank(t, w->rank_bytes, w->rank_digits);
    else
        write_number(t, "rank", TN_PARQUET_INT64);
    write_number(t, "length", TN_PARQUET_INT32);
    if (w->has_total)
        write_number(t, "total", TN_PARQUET_INT64);
    for (uint32_t f = 0; f < w->schema->field_count; f++) {
        char name[TN_COLUMN_NAME_SIZE];
        tn_field_column(w->schema, f, TN_COLUMNS_PARQUET, name);
        write_list(t, name);
    }
    if (w->has_lines)
        write_text(t, "plan");
}

/* ---- statistics */

typedef struct extremes {
    uint8_t room[16];
    const void *least, *most;
    size_t least_size, most_size;
} extremes;

static extremes number_extremes(const tn_numbers *numbers, extremes *e)
{
    tn_put_u64(e->room, (uint64_t)numbers->least);
    tn_put_u64(e->room + 8, (uint64_t)numbers->most);
    return (extremes){.least = e->room, .most = e->room + 8, .least_size = numbers->bytes, .most_size = numbers->bytes};
}

/* The first and the last of the field's texts that occur, byte by byte. */
static extremes text_extremes(const tn_parquet_writing *w, uint32_t field)
{
    const tn_schema *schema = w->schema;
    const char *least = NULL, *most = NULL;
    for (uint32_t v = schema->value_start[field]; v < schema->value_start[field + 1]; v++) {
        const char *text = tn_text(schema->module, schema->values[v].spelling);
        if (!w->seen[field][v - schema->value_start[field]])
            continue;
        least = least && strcmp(least, text) <= 0 ? least : text;
        most = most && strcmp(most, text) >= 0 ? most : text;
    }
    return (extremes){
        .least = least, .most = most, .least_size = least ? strlen(least) : 0, .most_size = most ? strlen(most) : 0};
}

static extremes find_extremes(const tn_parquet_writing *w, unsigned column, extremes *room)
{
    unsigned first = tn_first_field_column(w);
    if (column == 0)
        return (extremes){.least = w->least_rank.data,
                          .most = w->most_rank.data,
                          .least_size = w->least_rank.size,
                          .most_size = w->most_rank.size};
    if (column < first)
        return number_extremes(column == 1 ? &w->length : &w->total, room);
    return column - first < w->schema->field_count ? text_extremes(w, column - first) : (extremes){.least = NULL};
}

/* Places that hold no value: in a list, plans without trays. */
static int64_t places_without_value(const tn_parquet_writing *w, unsigned column)
{
    unsigned first = tn_first_field_column(w);
    return column >= first && column - first < w->schema->field_count ? (int64_t)w->empty_in_group : 0;
}

static void write_statistics(const tn_parquet_writing *w, unsigned column, tn_thrift_out *t)
{
    extremes room, found = find_extremes(w, column, &room);
    if (!found.least)
        return;
    tn_thrift_begin(t, 12);
    tn_thrift_number(t, 3, TN_THRIFT_I64, places_without_value(w, column));
    tn_thrift_bytes(t, 5, found.most, found.most_size);
    tn_thrift_bytes(t, 6, found.least, found.least_size);
    tn_thrift_end(t);
}

/* ---- row groups */

static void write_path(const tn_parquet_writing *w, unsigned column, tn_thrift_out *t)
{
    unsigned first = tn_first_field_column(w);
    char name[TN_COLUMN_NAME_SIZE] = "plan";
    bool is_list = column >= first && column - first < w->schema->field_count;
    if (is_list)
        tn_field_column(w->schema, column - first, TN_COLUMNS_PARQUET, name);
    else if (column < first)
        strcpy(name, column == 0 ? "rank" : column == 1 ? "length" : "total");
    tn_thrift_list(t, 3, TN_THRIFT_BINARY, is_list ? 3 : 1);
    tn_thrift_element_text(t, name);
    if (is_list) {
        tn_thrift_element_text(t, "list");
        tn_thrift_element_text(t, "element");
    }
}

static void write_encodings(const tn_parquet_writing *w, unsigned column, bool dictionary, tn_thrift_out *t)
{
    bool delta = column == 0 && w->rank_bytes == 0;
    tn_thrift_list(t, 2, TN_THRIFT_I32, dictionary ? 3 : 2);
    tn_thrift_element_number(t, TN_ENCODING_RLE);
    tn_thrift_element_number(t, delta ? TN_ENCODING_DELTA : TN_ENCODING_PLAIN);
    if (dictionary)
        tn_thrift_element_number(t, TN_ENCODING_RLE_DICTIONARY);
}

static enum tn_parquet_type type_of(const tn_parquet_writing *w, unsigned column)
{
    if (column == 0)
        return w->rank_bytes > 0 ? TN_PARQUET_FIXED : TN_PARQUET_INT64;
    return column == 1 ? TN_PARQUET_INT32 : column == 2 && w->has_total ? TN_PARQUET_INT64 : TN_PARQUET_TEXT;
}

static void write_chunk(const tn_parquet_writing *w, unsigned column, const tn_chunk_place *place, tn_thrift_out *t)
{
    uint64_t begin = place->dictionary ? place->dictionary : place->data;
    tn_thrift_element(t);
    tn_thrift_number(t, 2, TN_THRIFT_I64, 0);
    tn_thrift_begin(t, 3);
    tn_thrift_number(t, 1, TN_THRIFT_I32, type_of(w, column));
    write_encodings(w, column, place->dictionary > 0, t);
    write_path(w, column, t);
    tn_thrift_number(t, 4, TN_THRIFT_I32, TN_CODEC_ZSTD);
    tn_thrift_number(t, 5, TN_THRIFT_I64, (int64_t)w->chunks[column].values);
    tn_thrift_number(t, 6, TN_THRIFT_I64, (int64_t)place->loose);
    tn_thrift_number(t, 7, TN_THRIFT_I64, (int64_t)(place->end - begin));
    tn_thrift_number(t, 9, TN_THRIFT_I64, (int64_t)place->data);
    if (place->dictionary)
        tn_thrift_number(t, 11, TN_THRIFT_I64, (int64_t)place->dictionary);
    write_statistics(w, column, t);
    tn_thrift_end(t);
    tn_thrift_end(t);
}

/* The plans are in the order of their ranks. */
static void write_order(tn_thrift_out *t)
{
    tn_thrift_list(t, 4, TN_THRIFT_STRUCT, 1);
    tn_thrift_element(t);
    tn_thrift_number(t, 1, TN_THRIFT_I32, 0);
    tn_thrift_flag(t, 2, false);
    tn_thrift_flag(t, 3, false);
    tn_thrift_end(t);
}

void tn_footer_group(tn_parquet_writing *w, const tn_chunk_place *places)
{
    tn_thrift_out t = tn_thrift_to(&w->about_groups);
    unsigned columns = tn_column_count(w);
    uint64_t loose = 0, begin = places[0].dictionary ? places[0].dictionary : places[0].data;
    tn_thrift_list(&t, 1, TN_THRIFT_STRUCT, columns);
    for (unsigned c = 0; c < columns; c++) {
        write_chunk(w, c, &places[c], &t);
        loose += places[c].loose;
    }
    tn_thrift_number(&t, 2, TN_THRIFT_I64, (int64_t)loose);
    tn_thrift_number(&t, 3, TN_THRIFT_I64, (int64_t)w->in_group);
    if (!w->descends)
        write_order(&t);
    tn_thrift_number(&t, 5, TN_THRIFT_I64, (int64_t)begin);
    tn_thrift_number(&t, 6, TN_THRIFT_I64, (int64_t)(places[columns - 1].end - begin));
    tn_thrift_end(&t);
}

/* ---- how it was made */

static void write_metadata(const tn_metadata_item *items, tn_thrift_out *t)
{
    size_t count = 0;
    for (size_t i = 0; i < TN_METADATA_ITEMS; i++)
        count += items[i].value != NULL;
    tn_thrift_list(t, 5, TN_THRIFT_STRUCT, count);
    for (size_t i = 0; i < TN_METADATA_ITEMS; i++) {
        if (!items[i].value)
            continue;
        tn_thrift_element(t);
        tn_thrift_text(t, 1, items[i].key);
        tn_thrift_text(t, 2, items[i].value);
        tn_thrift_end(t);
    }
}

bool tn_footer_metadata(tn_parquet_writing *w, const tn_plan_writer *writer, const tn_plan_metadata *metadata)
{
    tn_metadata_room room;
    tn_metadata_item items[TN_METADATA_ITEMS];
    tn_writer_metadata(writer, metadata, &room, items);
    tn_thrift_out t = tn_thrift_to(&w->metadata);
    t.last[0] = 4; /* the row groups come before it */
    write_metadata(items, &t);
    const char *version = metadata->version ? metadata->version : "unknown";
    version += strncmp(version, PROGRAM, strlen(PROGRAM)) == 0 ? strlen(PROGRAM) : 0;
    tn_buffer_printf(&w->created_by, PROGRAM "version %s", version);
    return !w->metadata.failed && !w->created_by.failed;
}

/* That least and most are in the order of the columns' types. */
static void write_orders(const tn_parquet_writing *w, tn_thrift_out *t)
{
    unsigned columns = tn_column_count(w);
    tn_thrift_list(t, 7, TN_THRIFT_STRUCT, columns);
    for (unsigned c = 0; c < columns; c++) {
        tn_thrift_element(t);
        tn_thrift_begin(t, 1);
        tn_thrift_end(t);
        tn_thrift_end(t);
    }
}

void tn_footer_write(const tn_parquet_writing *w, tn_buffer *out)
{
    uint8_t size[4];
    size_t begin = out->size;
    tn_thrift_out t = tn_thrift_to(out);
    tn_thrift_number(&t, 1, TN_THRIFT_I32, 2);
    write_columns(w, &t);
    tn_thrift_number(&t, 3, TN_THRIFT_I64, (int64_t)w->plans);
    tn_thrift_list(&t, 4, TN_THRIFT_STRUCT, (size_t)w->groups);
    if (w->about_groups.size > 0)
        tn_buffer_append(out, w->about_groups.data, w->about_groups.size);
    tn_buffer_append(out, w->metadata.data, w->metadata.size);
    t.last[0] = 5;
    tn_thrift_text(&t, 6, w->created_by.data);
    write_orders(w, &t);
    tn_thrift_end(&t);
    tn_put_u32(size, (uint32_t)(out->size - begin));
    tn_buffer_append(out, (const char *)size, sizeof size);
    tn_buffer_append(out, TN_PARQUET_MAGIC, 4);
}
