/* Reads the footer of a file in Parquet: which columns it has, and where their pages are. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "driver/parquet/reading.h"
#include "runtime/base/array.h"
#include "runtime/base/bytes.h"
#include "runtime/base/file.h"

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
