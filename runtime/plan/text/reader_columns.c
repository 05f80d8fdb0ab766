/* CSV with a row a tray: a column `tray` counts a plan's trays from 1, and each field of the schema has a column of its
 * name. A plan is the rows from one with tray 1 to the next; a row with tray 0 is the plan without trays. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/nearest.h"
#include "runtime/plan/text/csv.h"
#include "runtime/plan/text/field_columns.h"

/* By the name of its column; or else by its own, as other programs call it. */
static uint32_t field_named(const tn_plan_reader *reader, const tn_csv_field *name)
{
    const tn_schema *schema = reader->schema;
    char column[TN_COLUMN_NAME_SIZE];
    for (uint32_t f = 0; f < schema->field_count; f++) {
        tn_field_column(schema, f, TN_COLUMNS_CSV, column);
        if (tn_csv_named(name, column))
            return f;
    }
    for (uint32_t f = 0; f < schema->field_count; f++)
        if (tn_csv_named(name, tn_text(schema->module, schema->fields[f].name)))
            return f;
    return UINT32_MAX;
}

static size_t count_commas(const char *line, size_t size)
{
    size_t count = 0;
    for (size_t i = 0; i < size; i++)
        count += line[i] == ',';
    return count;
}

/* `rank` and `tray` come before fields that are called so too. */
static bool read_columns(tn_plan_reader *reader, const char *line, size_t size)
{
    size_t at = 0;
    bool any = false;
    reader->tray_column = reader->rank_column = SIZE_MAX;
    for (reader->column_count = 0; at < size; reader->column_count++) {
        tn_csv_field name;
        if (!tn_csv_take(line, size, &at, &name))
            return false;
        uint32_t *field = &reader->column_fields[reader->column_count];
        *field = UINT32_MAX;
        if (tn_csv_named(&name, "rank") && reader->rank_column == SIZE_MAX)
            reader->rank_column = reader->column_count;
        else if (tn_csv_named(&name, "tray") && reader->tray_column == SIZE_MAX)
            reader->tray_column = reader->column_count;
        else
            *field = field_named(reader, &name);
        any |= *field != UINT32_MAX;
    }
    return any && reader->tray_column != SIZE_MAX;
}

static bool has_column(const tn_plan_reader *reader, uint32_t field)
{
    for (size_t i = 0; i < reader->column_count; i++)
        if (reader->column_fields[i] == field)
            return true;
    return false;
}

/* A column that is none of ours but is called much like a field without one: taking it for one more column would give
 * every tray the field's first value. */
static tn_status refuse_misspelled(tn_plan_reader *reader, const char *line, size_t size, tn_error *error)
{
    const tn_schema *schema = reader->schema;
    const char *missing[TN_FIELDS_MAX];
    size_t count = 0, at = 0;
    for (uint32_t f = 0; f < schema->field_count; f++)
        if (!has_column(reader, f))
            missing[count++] = tn_text(schema->module, schema->fields[f].name);
    for (size_t column = 0; count > 0 && at < size; column++) {
        tn_csv_field name;
        char text[TN_WORD_SHOWN];
        tn_csv_take(line, size, &at, &name);
        bool ours = column == reader->rank_column || column == reader->tray_column ||
                    reader->column_fields[column] != UINT32_MAX;
        if (ours || name.size >= sizeof text)
            continue;
        tn_word_show(&(tn_word){.text = name.text, .size = name.size}, text);
        const char *near = tn_nearest(text, missing, count);
        if (!near)
            continue;
        tn_fail(error, TN_INVALID, E_PLAN_FILE, "%s: there is no field `%s` for the column of that name", reader->path,
                text);
        tn_error_help(error, "did you mean %s?", near);
        return TN_INVALID;
    }
    return TN_OK;
}

tn_status tn_columns_header(tn_plan_reader *reader, const char *line, size_t size, bool *is_header, tn_error *error)
{
    reader->column_fields = calloc(count_commas(line, size) + 1, sizeof *reader->column_fields);
    if (!reader->column_fields)
        return tn_fail_memory(error);
    *is_header = read_columns(reader, line, size);
    if (!*is_header) {
        free(reader->column_fields);
        reader->column_fields = NULL;
        return TN_OK;
    }
    return refuse_misspelled(reader, line, size, error);
}

static tn_status read_value(tn_plan_reader *reader, uint32_t field, tn_csv_field *written, uint8_t *values,
                            tn_error *error)
{
    const size_t column = written->column, extent = written->size;
    if (written->doubled && !tn_csv_unquote(reader, written))
        return tn_fail_memory(error);
    size_t mark = tn_csv_mark(written);
    const tn_word word = {
        .text = written->text + mark, .size = written->size - mark, .column = column, .extent = extent};
    if (word.size == 0)
        return TN_OK; /* an empty cell: the first value */
    uint32_t value = tn_value_find(reader->schema, field, &word);
    if (value == TN_NO_VALUE)
        return tn_value_unknown(reader->schema, field, &word, error);
    values[field] = (uint8_t)value;
    return TN_OK;
}

/* The number of the tray, or a number that no tray has where the cell holds none. */
static uint64_t read_place(const tn_csv_field *cell)
{
    uint64_t place = 0;
    for (size_t i = 0; i < cell->size; i++) {
        if (cell->text[i] < '0' || cell->text[i] > '9' || place > UINT32_MAX)
            return UINT64_MAX;
        place = 10 * place + (uint64_t)(cell->text[i] - '0');
    }
    return cell->size ? place : UINT64_MAX;
}

/* What a row says: which tray of its plan, its rank if it is the first, and its values. */
typedef struct row {
    uint64_t place;
    tn_csv_field rank;
    size_t place_at;
} row;

static tn_status read_row(tn_plan_reader *reader, row *read, uint8_t *values, tn_error *error)
{
    size_t at = 0, column = 0;
    tn_status status = TN_OK;
    *read = (row){.place = UINT64_MAX};
    memset(values, 0, reader->schema->field_count);
    for (; at < reader->text_size; column++) {
        tn_csv_field cell;
        size_t begin = at;
        if (!tn_csv_take(reader->text, reader->text_size, &at, &cell))
            return tn_csv_bad_record(reader, at, "the record has a quote that does not belong",
                                     "a field with quotes in it stands in quotes, with each quote in it doubled",
                                     error);
        uint32_t field = column < reader->column_count ? reader->column_fields[column] : UINT32_MAX;
        if (column == reader->tray_column) {
            read->place = read_place(&cell);
            read->place_at = begin;
        } else if (column == reader->rank_column) {
            read->rank = cell;
        } else if (field != UINT32_MAX && status == TN_OK) { /* a wrong value is said where its place is known */
            status = read_value(reader, field, &cell, values, error);
        }
    }
    return status;
}

static tn_status add_tray(tn_plan_reader *reader, const uint8_t *values, tn_error *error)
{
    const tn_word place = {.text = reader->text, .size = reader->text_size, .column = 1, .extent = reader->text_size};
    tn_tray tray;
    tn_status status = tn_value_tray(reader->schema, values, &place, &tray, error);
    return status == TN_OK ? tn_scanner_add(&reader->plan, tray, reader->max_length, &place, error) : status;
}

static bool begins_plan(const row *read)
{
    return read->place == 0 || read->place == 1;
}

/* Takes a row back: the next call reads it again. Nothing has been read since. */
static void give_back(tn_plan_reader *reader)
{
    reader->begin = (size_t)(reader->text - reader->data);
    reader->line--;
}

static tn_status wrong_place(tn_plan_reader *reader, const row *read, tn_error *error)
{
    tn_csv_bad_record(reader, read->place_at, "this is not the number of the plan's next tray",
                      "the trays of a plan are numbered 1, 2, 3, ... in rows that follow one another", error);
    return TN_INVALID;
}

/* The next row that is not blank, with its values; *more is false at the end. */
static tn_status next_row(tn_plan_reader *reader, bool *more, row *read, uint8_t *values, tn_error *error)
{
    do {
        tn_status status = tn_reader_line(reader, more, error);
        if (status != TN_OK || !*more)
            return status;
    } while (reader->text_size == 0);
    return read_row(reader, read, values, error);
}

tn_status tn_columns_next(tn_plan_reader *reader, bool *found, tn_error *error)
{
    uint8_t values[TN_FIELDS_MAX];
    bool more = true;
    *found = false;
    reader->plan.length = 0;
    for (;;) {
        row read = {.place = UINT64_MAX};
        tn_status status = next_row(reader, &more, &read, values, error);
        if (!more && status == TN_OK)
            break;
        bool begins = begins_plan(&read);
        if (status == TN_OK || (error->code != E_PLAN_LINE_TOO_LONG && status == TN_INVALID)) {
            if (*found && begins) { /* also where it is wrong: the plan before is whole */
                give_back(reader);
                break;
            }
            if (reader->skipping && !begins)
                continue;
            reader->skipping = false;
        }
        if (status == TN_OK && (begins ? *found : !*found || read.place != reader->plan.length + 1))
            status = wrong_place(reader, &read, error);
        if (status == TN_OK && begins &&
            !tn_buffer_append(&reader->rank, read.rank.text ? read.rank.text : "", read.rank.size))
            status = tn_fail_memory(error);
        if (status == TN_OK && read.place > 0)
            status = add_tray(reader, values, error);
        reader->skipping = status != TN_OK;
        if (status != TN_OK)
            return status;
        *found = true;
        if (read.place == 0)
            break;
    }
    reader->text = NULL;
    reader->text_size = 0;
    return TN_OK;
}
