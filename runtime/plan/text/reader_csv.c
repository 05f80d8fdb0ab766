/* CSV as RFC 4180 has it: a header that names the columns, fields in quotes where they need to be, quotes in them
 * doubled. A plan holds no line breaks, so a record is a line. */
#include <string.h>

#include "runtime/plan/text/csv.h"

bool tn_csv_take(const char *line, size_t size, size_t *at, tn_csv_field *field)
{
    *field = (tn_csv_field){.text = line + *at, .column = *at + 1};
    if (*at < size && line[*at] == '"') {
        size_t begin = ++*at;
        for (; *at < size; ++*at) {
            if (line[*at] != '"')
                continue;
            if (*at + 1 >= size || line[*at + 1] != '"')
                break;
            field->doubled = true;
            ++*at;
        }
        *field = (tn_csv_field){line + begin, *at - begin, begin + 1, field->doubled};
        if (*at >= size)
            return false;
        ++*at;
    } else {
        const char *comma = *at < size ? memchr(line + *at, ',', size - *at) : NULL;
        field->size = (comma ? (size_t)(comma - line) : size) - *at;
        *at += field->size;
    }
    if (*at < size && line[*at] != ',')
        return false;
    *at += *at < size;
    return true;
}

bool tn_csv_named(const tn_csv_field *field, const char *name)
{
    return !field->doubled && field->size == strlen(name) && memcmp(field->text, name, field->size) == 0;
}

/* Sets the columns from a header; false where it is none. */
static bool read_header(tn_plan_reader *reader, const char *line, size_t size)
{
    reader->plan_column = reader->rank_column = SIZE_MAX;
    size_t at = 0, columns = 0;
    while (at < size) {
        tn_csv_field field;
        if (!tn_csv_take(line, size, &at, &field))
            return false;
        if (tn_csv_named(&field, "plan") && reader->plan_column == SIZE_MAX)
            reader->plan_column = columns;
        if (tn_csv_named(&field, "rank") && reader->rank_column == SIZE_MAX)
            reader->rank_column = columns;
        columns++;
    }
    return reader->plan_column != SIZE_MAX && (columns > 1 || reader->format == TN_FORMAT_CSV);
}

tn_status tn_reader_csv_open(tn_plan_reader *reader, bool *is_csv, tn_error *error)
{
    *is_csv = false;
    const char *newline = NULL;
    size_t size = 0;
    while (!newline && size <= reader->max_line && !reader->input_ended) {
        tn_status status = tn_reader_fill(reader, size + 1, error);
        if (status != TN_OK)
            return status;
        size = reader->end - reader->begin;
        newline = size > 0 ? memchr(reader->data + reader->begin, '\n', size) : NULL;
    }
    if (size == 0 && (size = reader->end - reader->begin) > 0)
        newline = memchr(reader->data + reader->begin, '\n', size);
    if (size == 0)
        return TN_OK;
    const char *line = reader->data + reader->begin;
    size_t length = newline ? (size_t)(newline - line) : size;
    size_t bare = length > 0 && line[length - 1] == '\r' ? length - 1 : length;
    *is_csv = read_header(reader, line, bare);
    if (!*is_csv) {
        tn_status status = tn_columns_header(reader, line, bare, is_csv, error);
        if (status != TN_OK)
            return status;
    }
    if (*is_csv) {
        reader->begin += length + (newline ? 1 : 0);
        reader->line = 1;
    }
    return TN_OK;
}

bool tn_csv_unquote(tn_plan_reader *reader, tn_csv_field *field)
{
    reader->quoted.size = 0;
    for (size_t i = 0; i < field->size; i++) {
        if (!tn_buffer_append(&reader->quoted, &field->text[i], 1))
            return false;
        i += field->text[i] == '"';
    }
    field->text = reader->quoted.data ? reader->quoted.data : "";
    field->size = reader->quoted.size;
    return true;
}

/* The column of the line where the field's byte `index` (from 0, of its text without doubled quotes) is. */
static size_t column_in_line(const tn_csv_field *written, size_t index)
{
    size_t at = 0;
    for (; index > 0 && at < written->size; index--)
        at += written->doubled && written->text[at] == '"' ? 2 : 1;
    return written->column + at;
}

size_t tn_csv_mark(const tn_csv_field *field)
{
    return field->size > 1 && field->text[0] == '\'' && strchr("=+-@", field->text[1]);
}

static tn_status parse_plan(tn_plan_reader *reader, const tn_csv_field *written, tn_error *error)
{
    tn_csv_field field = *written;
    if (field.doubled && !tn_csv_unquote(reader, &field))
        return tn_fail_memory(error);
    size_t mark = tn_csv_mark(&field);
    tn_status status = tn_plan_scan_line(reader->scanner, field.text + mark, field.size - mark, reader->max_length,
                                         &reader->plan, error);
    if (status != TN_OK && error->column > 0)
        tn_error_place(error, reader->line, column_in_line(written, mark + error->column - 1),
                       column_in_line(written, mark + error->column_end - 1));
    return status;
}

tn_status tn_csv_bad_record(tn_plan_reader *reader, size_t at, const char *message, const char *help, tn_error *error)
{
    tn_fail(error, TN_INVALID, E_PLAN_SYNTAX, "%s", message);
    tn_error_help(error, "%s", help);
    tn_error_place(error, reader->line, at + 1, at + 2);
    return TN_INVALID;
}

tn_status tn_reader_csv_next(tn_plan_reader *reader, bool *found, tn_error *error)
{
    if (reader->column_fields)
        return tn_columns_next(reader, found, error);
    do {
        tn_status status = tn_reader_line(reader, found, error);
        if (status != TN_OK || !*found)
            return status;
    } while (reader->text_size == 0);
    tn_csv_field plan = {.text = NULL};
    size_t at = 0;
    for (size_t column = 0; at < reader->text_size || column == 0; column++) {
        tn_csv_field field;
        if (!tn_csv_take(reader->text, reader->text_size, &at, &field))
            return tn_csv_bad_record(reader, at, "the record has a quote that does not belong",
                                     "a field with quotes in it stands in quotes, with each quote in it doubled",
                                     error);
        if (column == reader->plan_column)
            plan = field;
        if (column == reader->rank_column && !tn_buffer_append(&reader->rank, field.text, field.size))
            return tn_fail_memory(error);
    }
    size_t size = reader->text_size;
    if (!plan.text && reader->text[size - 1] == ',')
        plan =
            (tn_csv_field){.text = reader->text + size, .column = size + 1}; /* an empty last field: the empty plan */
    return plan.text ? parse_plan(reader, &plan, error)
                     : tn_csv_bad_record(reader, size, "the record ends before the column named plan",
                                         "a record has a field for each column that the header names", error);
}
