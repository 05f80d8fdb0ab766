/* The table `trays` of a plan library in SQLite, for questions in SQL: a row a tray, a column a field.
 *
 * A length or zone has a second column, its millimetres. A column whose name is taken already (SQLite takes capital and
 * small letters for the same) has _2, _3, ... behind it.
 */
#include <string.h>
#include <strings.h>

#include "runtime/plan/store/sqlite_data.h"

enum { COLUMNS_MAX = 2 + 2 * TN_FIELDS_MAX, NAME_SIZE = TN_NAME_MAX + 16 };

typedef struct tn_tray_columns {
    char names[COLUMNS_MAX][NAME_SIZE];
    const char *types[COLUMNS_MAX];
    size_t count;
} tn_tray_columns;

static bool is_taken(const tn_tray_columns *columns, const char *name)
{
    for (size_t i = 0; i < columns->count; i++)
        if (strcasecmp(columns->names[i], name) == 0)
            return true;
    return false;
}

static void add_column(tn_tray_columns *columns, const char *name, const char *ending, const char *type)
{
    char *made = columns->names[columns->count];
    snprintf(made, NAME_SIZE, "%s%s", name, ending);
    for (unsigned n = 2; is_taken(columns, made); n++)
        snprintf(made, NAME_SIZE, "%s%s_%u", name, ending, n);
    columns->types[columns->count++] = type;
}

static bool is_measured(const tn_field_record *field)
{
    return field->kind == TN_FIELD_LENGTH || field->kind == TN_FIELD_ZONE;
}

static void find_columns(const tn_schema *schema, tn_tray_columns *columns)
{
    columns->count = 0;
    add_column(columns, "number", "", "INTEGER");
    add_column(columns, "tray", "", "INTEGER");
    for (uint32_t f = 0; f < schema->field_count; f++) {
        const char *name = tn_text(schema->module, schema->fields[f].name);
        add_column(columns, name, "", schema->fields[f].kind == TN_FIELD_FLAG ? "INTEGER" : "TEXT");
        if (is_measured(&schema->fields[f]))
            add_column(columns, name, "_mm", "REAL");
    }
}

tn_status tn_trays_create(tn_plan_writer *writer, tn_error *error)
{
    tn_tray_columns columns;
    find_columns(writer->schema, &columns);
    sqlite3_str *sql = sqlite3_str_new(writer->database);
    sqlite3_str_appendall(sql, "CREATE TABLE trays (");
    for (size_t i = 0; i < columns.count; i++)
        sqlite3_str_appendf(sql, "\"%w\" %s NOT NULL, ", columns.names[i], columns.types[i]);
    sqlite3_str_appendall(sql, "PRIMARY KEY (number, tray)) WITHOUT ROWID");
    return tn_writer_sqlite_run(writer, sqlite3_str_finish(sql), error);
}

tn_status tn_trays_prepare(tn_plan_writer *writer, tn_error *error)
{
    tn_tray_columns columns;
    find_columns(writer->schema, &columns);
    sqlite3_str *sql = sqlite3_str_new(writer->database);
    sqlite3_str_appendall(sql, "INSERT INTO trays VALUES (?");
    for (size_t i = 1; i < columns.count; i++)
        sqlite3_str_appendall(sql, ",?");
    sqlite3_str_appendall(sql, ")");
    char *text = sqlite3_str_finish(sql);
    if (!text)
        return tn_fail_memory(error);
    int code = sqlite3_prepare_v2(writer->database, text, -1, &writer->insert_tray, NULL);
    sqlite3_free(text);
    return code == SQLITE_OK ? TN_OK : tn_writer_sqlite_failed(writer, error);
}

static void bind_tray(const tn_plan_writer *writer, tn_tray tray)
{
    const tn_schema *schema = writer->schema;
    sqlite3_stmt *insert = writer->insert_tray;
    int column = 2;
    for (uint32_t f = 0; f < schema->field_count; f++) {
        const tn_value_record *value = tn_tray_value_record(schema, tray, f);
        if (schema->fields[f].kind == TN_FIELD_FLAG)
            sqlite3_bind_int(insert, ++column, tn_tray_value(schema, tray, f) != 0);
        else
            sqlite3_bind_text(insert, ++column, tn_text(schema->module, value->name), -1, SQLITE_STATIC);
        if (is_measured(&schema->fields[f]))
            sqlite3_bind_double(insert, ++column, (double)value->length / 1e6); /* nanometres */
    }
}

bool tn_trays_insert(tn_plan_writer *writer, const tn_tray *trays, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        sqlite3_bind_int64(writer->insert_tray, 1, (sqlite3_int64)writer->number);
        sqlite3_bind_int64(writer->insert_tray, 2, (sqlite3_int64)i + 1);
        bind_tray(writer, trays[i]);
        int code = sqlite3_step(writer->insert_tray);
        sqlite3_reset(writer->insert_tray);
        if (code != SQLITE_DONE)
            return false;
    }
    return true;
}

/* One for each column that a question may begin with. */
tn_status tn_trays_index(tn_plan_writer *writer, tn_error *error)
{
    tn_tray_columns columns;
    find_columns(writer->schema, &columns);
    tn_status status = TN_OK;
    for (size_t i = 2; status == TN_OK && i < columns.count; i++)
        status = tn_writer_sqlite_run(writer,
                                      sqlite3_mprintf("CREATE INDEX IF NOT EXISTS \"trays_%w\" ON trays (\"%w\")",
                                                      columns.names[i], columns.names[i]),
                                      error);
    return status;
}
