/* The footer of a file in Parquet: its columns, where their pages are, and how the file was made. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "driver/parquet/reader.h"
#include "driver/parquet/writer.h"
#include "runtime/base/array.h"
#include "runtime/base/bytes.h"
#include "runtime/base/file.h"

/* ---- reading */

#define FOOTER_MOST ((size_t)1 << 28) /* bytes */
enum { NESTING_MOST = 16 };           /* groups within groups */

tn_status tn_parquet_bytes(const tn_plan_reader *reader, uint64_t at, void *bytes, size_t size, tn_error *error)
{
    for (char *out = bytes; size > 0;) {
        ssize_t count = pread(reader->file, out, size, (off_t)at);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            return tn_cannot_read(reader->path, errno, error);
        if (count == 0)
            return tn_parquet_damaged(reader, "the file ends too soon", error);
        out += count;
        at += (uint64_t)count;
        size -= (size_t)count;
    }
    return TN_OK;
}

/* ---- the schema: a tree, node by node, each with the number of its children */

typedef struct node {
    int64_t type, type_length, repetition, children, scale;
    tn_thrift_string name;
    bool has_type;
} node;

typedef struct walk {
    tn_plan_reader *reader;
    tn_thrift_in in;
    size_t nodes;  /* left in the list */
    size_t leaves; /* seen */
} walk;

static void read_node(tn_thrift_in *in, node *read)
{
    tn_thrift_field field = {0};
    *read = (node){.name = {(const uint8_t *)"", 0}};
    while (tn_thrift_next(in, &field)) {
        int64_t *number = field.number == 1   ? &read->type
                          : field.number == 2 ? &read->type_length
                          : field.number == 3 ? &read->repetition
                          : field.number == 5 ? &read->children
                          : field.number == 7 ? &read->scale
                                              : NULL;
        if (number)
            *number = tn_thrift_read_number(in, field.type);
        else if (field.number == 4)
            read->name = tn_thrift_read_bytes(in, field.type);
        else
            tn_thrift_skip(in, field.type);
        read->has_type = read->has_type || field.number == 1;
    }
}

static bool is_named(const node *read, const char *name)
{
    return strlen(name) == read->name.size && memcmp(name, read->name.bytes, read->name.size) == 0;
}

/* The column that is read and called so; NULL: none. */
static tn_read_column *find_column(tn_plan_reader *reader, const node *read)
{
    tn_parquet_reading *r = tn_reading_of(reader);
    char name[TN_COLUMN_NAME_SIZE];
    if (is_named(read, "rank"))
        return tn_rank_column(r);
    if (is_named(read, "plan"))
        return tn_line_column(r);
    for (uint32_t f = 0; f < reader->schema->field_count; f++) {
        tn_field_column(reader->schema, f, TN_COLUMNS_PARQUET, name);
        if (is_named(read, name))
            return &r->columns[f];
    }
    return NULL;
}

static void add_leaf(const node *read, tn_leaf levels, size_t number, tn_read_column *column)
{
    if (!column)
        return;
    bool nested = column->leaf.known;
    column->leaf = levels;
    column->leaf.known = true;
    column->leaf.nested = nested;
    column->leaf.number = number;
    column->leaf.type = read->type;
    column->leaf.type_length = read->type_length;
    column->leaf.scale = read->scale;
}

/* Passes over a node and all within. False where it cannot be. */
static bool walk_node(walk *w, unsigned depth, tn_leaf levels, tn_read_column *column)
{
    node read;
    if (w->nodes == 0 || depth > NESTING_MOST)
        return false;
    w->nodes--;
    read_node(&w->in, &read);
    levels.max_definition += read.repetition != TN_PARQUET_REQUIRED;
    levels.max_repetition += read.repetition == TN_PARQUET_REPEATED;
    if (read.repetition == TN_PARQUET_REPEATED)
        levels.list_definition = levels.max_definition;
    if (depth == 1)
        column = find_column(w->reader, &read);
    if (w->in.bad || read.children < 0 || read.repetition < 0 || read.repetition > 2)
        return false;
    if (read.children == 0 && read.has_type)
        add_leaf(&read, levels, w->leaves++, column);
    for (int64_t i = 0; i < read.children; i++)
        if (!walk_node(w, depth + 1, levels, column))
            return false;
    return true;
}

/* The root, and the columns within. */
static bool read_schema(tn_plan_reader *reader, tn_thrift_in in, size_t *leaves)
{
    node root;
    walk w = {.reader = reader, .in = in};
    w.nodes = tn_thrift_read_list(&w.in, TN_THRIFT_LIST, TN_THRIFT_STRUCT);
    if (w.nodes == 0)
        return false;
    w.nodes--;
    read_node(&w.in, &root);
    for (int64_t i = 0; i < root.children; i++)
        if (w.in.bad || !walk_node(&w, 1, (tn_leaf){0}, NULL))
            return false;
    *leaves = w.leaves;
    return !w.in.bad && w.nodes == 0;
}

/* ---- row groups */

typedef struct chunk_said {
    int64_t codec, size, data, dictionary;
    bool has_dictionary, elsewhere;
} chunk_said;

static void read_chunk_metadata(tn_thrift_in *in, chunk_said *said)
{
    tn_thrift_field field = {0};
    while (tn_thrift_next(in, &field)) {
        int64_t *number = field.number == 4    ? &said->codec
                          : field.number == 7  ? &said->size
                          : field.number == 9  ? &said->data
                          : field.number == 11 ? &said->dictionary
                                               : NULL;
        if (number)
            *number = tn_thrift_read_number(in, field.type);
        else
            tn_thrift_skip(in, field.type);
        said->has_dictionary = said->has_dictionary || field.number == 11;
    }
}

static void read_chunk(tn_thrift_in *in, chunk_said *said)
{
    tn_thrift_field field = {0};
    *said = (chunk_said){.data = -1, .size = -1};
    while (tn_thrift_next(in, &field)) {
        if (field.number == 3 && field.type == TN_THRIFT_STRUCT)
            read_chunk_metadata(in, said);
        else
            tn_thrift_skip(in, field.type);
        said->elsewhere = said->elsewhere || field.number == 1; /* in another file */
    }
}

/* Is it within the file, before the footer? */
static bool place_chunk(const tn_parquet_reading *r, const chunk_said *said, tn_read_chunk *chunk)
{
    int64_t begin =
        said->has_dictionary && said->dictionary > 0 && said->dictionary < said->data ? said->dictionary : said->data;
    uint64_t end = r->file_size - TN_PARQUET_TAIL - r->footer_size;
    *chunk = (tn_read_chunk){(uint64_t)begin, (uint64_t)begin + (uint64_t)said->size, said->codec};
    return !said->elsewhere && begin >= 4 && said->size >= 0 && (uint64_t)begin <= end &&
           (uint64_t)said->size <= end - (uint64_t)begin;
}

/* The chunks of a group's columns, of which there are `leaves`. */
static bool read_chunks(const tn_parquet_reading *r, tn_thrift_in *in, enum tn_thrift_type type, size_t leaves,
                        tn_read_chunk *chunks)
{
    size_t count = tn_thrift_read_list(in, type, TN_THRIFT_STRUCT);
    if (count != leaves)
        return false;
    for (size_t i = 0; i < count && !in->bad; i++) {
        chunk_said said;
        read_chunk(in, &said);
        for (uint32_t c = 0; c < r->column_count; c++) {
            const tn_leaf *leaf = &r->columns[c].leaf;
            if (leaf->known && leaf->number == i && !place_chunk(r, &said, &chunks[c]))
                return false;
        }
    }
    return !in->bad;
}

static bool read_group(tn_parquet_reading *r, tn_thrift_in *in, size_t leaves, size_t group)
{
    tn_thrift_field field = {0};
    int64_t rows = -1;
    bool whole = false;
    while (tn_thrift_next(in, &field)) {
        if (field.number == 1)
            whole = read_chunks(r, in, field.type, leaves, r->chunks + group * r->column_count);
        else if (field.number == 3)
            rows = tn_thrift_read_number(in, field.type);
        else
            tn_thrift_skip(in, field.type);
        if (field.number == 1 && !whole)
            return false;
    }
    r->group_rows[group] = (uint64_t)rows;
    return whole && rows >= 0 && !in->bad;
}

tn_status tn_footer_groups(tn_plan_reader *reader, tn_error *error)
{
    tn_parquet_reading *r = tn_reading_of(reader);
    tn_thrift_in in = r->about_groups;
    size_t count = tn_thrift_read_list(&in, TN_THRIFT_LIST, TN_THRIFT_STRUCT);
    if (in.bad || count > (size_t)(in.end - in.at) / (r->leaves + 1))
        return tn_parquet_damaged(reader, "what it says of its row groups is wrong", error);
    r->group_count = count;
    r->group_rows = calloc(count + 1, sizeof *r->group_rows);
    r->chunks = calloc(tn_size_of(count + 1, r->column_count), sizeof *r->chunks);
    if (!r->group_rows || !r->chunks)
        return tn_fail_memory(error);
    bool whole = !in.bad;
    for (size_t g = 0; whole && g < count; g++)
        whole = read_group(r, &in, r->leaves, g);
    return whole ? TN_OK : tn_parquet_damaged(reader, "what it says of its row groups is wrong", error);
}

/* ---- the footer */

/* Reads the end of the file, and the footer that it is about. */
static tn_status load_footer(tn_plan_reader *reader, tn_error *error)
{
    tn_parquet_reading *r = tn_reading_of(reader);
    struct stat known;
    uint8_t tail[TN_PARQUET_TAIL];
    if (fstat(reader->file, &known) != 0 || !S_ISREG(known.st_mode)) {
        tn_fail(error, TN_INVALID, E_PLAN_FILE, "%.200s: Parquet is read from its end, which a pipe does not have",
                reader->path);
        tn_error_help(error, "write it to a file, and name that");
        return TN_INVALID;
    }
    r->file_size = (uint64_t)known.st_size;
    if (r->file_size < TN_PARQUET_TAIL + 4)
        return tn_parquet_damaged(reader, "the file ends too soon", error);
    tn_status status = tn_parquet_bytes(reader, r->file_size - sizeof tail, tail, sizeof tail, error);
    if (status != TN_OK)
        return status;
    r->footer_size = tn_get_u32(tail);
    if (memcmp(tail + 4, TN_PARQUET_MAGIC, 4) != 0)
        return tn_parquet_damaged(reader, "it does not end as such a file does", error);
    if (r->footer_size > r->file_size - TN_PARQUET_TAIL - 4 || r->footer_size > FOOTER_MOST)
        return tn_parquet_damaged(reader, "its footer is larger than it can be", error);
    r->footer = malloc(r->footer_size + 1);
    if (!r->footer)
        return tn_fail_memory(error);
    return tn_parquet_bytes(reader, r->file_size - sizeof tail - r->footer_size, r->footer, r->footer_size, error);
}

tn_status tn_footer_read(tn_plan_reader *reader, tn_error *error)
{
    tn_parquet_reading *r = tn_reading_of(reader);
    tn_status status = load_footer(reader, error);
    if (status != TN_OK)
        return status;
    tn_thrift_in in = {r->footer, r->footer + r->footer_size, false}, schema = {.bad = true};
    r->about_groups = schema;
    tn_thrift_field field = {0};
    while (tn_thrift_next(&in, &field)) {
        if (field.number == 2 && field.type == TN_THRIFT_LIST)
            schema = in;
        if (field.number == 4 && field.type == TN_THRIFT_LIST)
            r->about_groups = in;
        tn_thrift_skip(&in, field.type);
    }
    bool whole = !in.bad && !schema.bad && !r->about_groups.bad && read_schema(reader, schema, &r->leaves);
    return whole ? TN_OK : tn_parquet_damaged(reader, "what it says of its columns is wrong", error);
}

/* ---- writing */

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
    if (w->has_rank_texts)
        write_text(t, "rank_text");
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
    else if (w->has_rank_texts && column == tn_rank_texts_column(w))
        strcpy(name, "rank_text");
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
