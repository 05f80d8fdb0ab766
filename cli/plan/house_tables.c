/* Writes houses that a question finds as tables: files of CSV or Parquet beside one another, or tables of a database.
 */
#include "cli/plan/house_tables.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "ask/house/numbered.h"
#include "runtime/base/part.h"
#include "runtime/house/house.h"
#include "runtime/plan/store/sqlite.h"
#include "runtime/plan/text/writer.h"

/* ---- files */

/* "lots.csv" of rooms: "lots.rooms.csv". */
static bool make_path(const char *path, tn_house_table table, bool named, const char *ending, char **made)
{
    tn_buffer text = {0};
    size_t size = strlen(path), cut = strlen(ending);
    cut = size > cut && strcasecmp(path + size - cut, ending) == 0 ? cut : 0;
    bool good = tn_buffer_append(&text, path, size - cut);
    if (good && (named || table != TN_TABLE_HOUSES))
        good = tn_buffer_printf(&text, ".%s", tn_house_table_name(table));
    good = good && tn_buffer_append(&text, path + size - cut, cut) && tn_buffer_append(&text, "", 1);
    *made = text.data;
    return good;
}

static tn_status write_line(tn_house_tables_file *f, tn_house_table table, tn_error *error)
{
    fwrite(f->line.data, 1, f->line.size, f->outputs[table].stream);
    return ferror(f->outputs[table].stream) ? tn_cannot_write(f->outputs[table].path, 0, error) : TN_OK;
}

static tn_status write_cells(tn_house_tables_file *f, tn_house_table table, const char *const *cells, tn_error *error)
{
    size_t count;
    bool good = true;
    tn_house_table_columns(f->tables, table, &count);
    f->line.size = 0;
    for (size_t i = 0; good && i < count; i++)
        good = tn_buffer_append(&f->line, ",", i > 0) &&
               (!cells[i] || tn_writer_csv_field(&f->line, cells[i], strlen(cells[i]), f->csv_safe));
    good = good && tn_buffer_append(&f->line, "\r\n", 2);
    return good ? write_line(f, table, error) : tn_fail_memory(error);
}

static tn_status write_head(tn_house_tables_file *f, tn_house_table table, tn_error *error)
{
    size_t count;
    const tn_house_column *columns = tn_house_table_columns(f->tables, table, &count);
    const char **names = malloc((count + 1) * sizeof *names);
    if (!names)
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++)
        names[i] = columns[i].name;
    tn_status status = write_cells(f, table, names, error);
    free(names);
    return status;
}

static tn_status begin_parquet(tn_house_tables_file *f, tn_house_table table, tn_error *error)
{
    static const enum tn_parquet_type types[] = {
        [TN_COLUMN_TEXT] = TN_PARQUET_TEXT, [TN_COLUMN_WHOLE] = TN_PARQUET_INT64, [TN_COLUMN_REAL] = TN_PARQUET_DOUBLE};
    size_t count;
    const tn_house_column *columns = tn_house_table_columns(f->tables, table, &count);
    tn_parquet_column *made = malloc((count + 1) * sizeof *made);
    if (!made)
        return tn_fail_memory(error);
    f->columns[table] = made;
    for (size_t i = 0; i < count; i++)
        made[i] = (tn_parquet_column){columns[i].name, types[columns[i].kind]};
    return tn_parquet_table_begin(f->outputs[table].stream, f->paths[table], made, count,
                                  (const char *const(*)[2])f->metadata, TN_TABLES_METADATA, &f->packed[table], error);
}

static tn_status open_file(tn_house_tables_file *f, tn_house_table table, const char *path, tn_error *error)
{
    if (!make_path(path, table, f->named, f->parquet ? ".parquet" : ".csv", &f->paths[table]))
        return tn_fail_memory(error);
    tn_status status = tn_output_open(f->paths[table], &f->outputs[table], error);
    f->open[table] = status == TN_OK;
    if (status != TN_OK)
        return status;
    return f->parquet ? begin_parquet(f, table, error) : write_head(f, table, error);
}

static tn_status open_files(tn_house_tables_file *f, const char *path, tn_error *error)
{
    bool standard = !path || strcmp(path, "-") == 0;
    tn_status status = TN_OK;
    for (int i = 0; status == TN_OK && i < (standard ? 1 : TN_HOUSE_TABLES); i++)
        status = open_file(f, (tn_house_table)i, standard ? "-" : path, error);
    return status;
}

/* ---- a database */

static bool make_table(const tn_house_tables_file *f, tn_house_table table, tn_stored_table *made)
{
    static const char *const types[] = {
        [TN_COLUMN_TEXT] = "TEXT", [TN_COLUMN_WHOLE] = "INTEGER", [TN_COLUMN_REAL] = "REAL"};
    const tn_house_column *columns = tn_house_table_columns(f->tables, table, &made->count);
    tn_stored_column *stored = malloc((made->count + 1) * sizeof *stored);
    for (size_t i = 0; stored && i < made->count; i++)
        stored[i] = (tn_stored_column){columns[i].name, types[columns[i].kind]};
    made->name = tn_house_table_name(table);
    made->columns = stored;
    return stored != NULL;
}

static tn_status open_database(tn_house_tables_file *f, const char *path, tn_error *error)
{
    tn_stored_table tables[TN_HOUSE_TABLES] = {{0}};
    tn_status status = TN_OK;
    f->database = tn_plan_sqlite();
    if (!f->database)
        status = tn_part_absent(TN_WITH_STORE, "writing a SQLite library", error);
    for (int i = 0; status == TN_OK && i < TN_HOUSE_TABLES; i++)
        if (!make_table(f, (tn_house_table)i, &tables[i]))
            status = tn_fail_memory(error);
    if (status == TN_OK)
        status = f->database->open_tables(path ? path : "-", tables, TN_HOUSE_TABLES,
                                          (const char *const(*)[2])f->metadata, TN_TABLES_METADATA, &f->file, error);
    for (int i = 0; i < TN_HOUSE_TABLES; i++)
        free((void *)(uintptr_t)tables[i].columns);
    return status;
}

/* ---- both */

tn_status tn_house_tables_row(void *file, tn_house_table table, const char *const *cells, tn_error *error)
{
    tn_house_tables_file *f = file;
    if (f->database)
        return f->database->add_row(f->file, table, cells, error);
    if (!f->open[table])
        return TN_OK;
    return f->parquet ? tn_parquet_table_add(f->packed[table], cells, error) : write_cells(f, table, cells, error);
}

static void take_metadata(tn_house_tables_file *f, const tn_plan_metadata *metadata)
{
    const char *const items[TN_TABLES_METADATA][2] = {
        {"library", metadata->library},       {"library_hash", metadata->library_hash},
        {"rules_hash", metadata->rules_hash}, {"rules_path", metadata->rules_path},
        {"version", metadata->version},       {"command", metadata->command},
        {"params", metadata->params}};
    memcpy(f->metadata, items, sizeof items);
}

tn_status tn_house_tables_open(tn_house_tables_file *f, const tn_numbered *houses, const char *path,
                               tn_plan_format format, const tn_plan_metadata *metadata, tn_error *error)
{
    f->houses = houses;
    f->parquet = format == TN_FORMAT_PARQUET;
    take_metadata(f, metadata);
    tn_status status = tn_house_tables_new(&houses->form, tn_library_max(houses->plans), &f->tables, error);
    if (status != TN_OK)
        return status;
    return format == TN_FORMAT_SQLITE ? open_database(f, path, error) : open_files(f, path, error);
}

tn_status tn_house_tables_write(tn_house_tables_file *f, const tn_house *house, mpz_srcptr rank, tn_error *error)
{
    mpz_t plan;
    mpz_init(plan);
    bool kept = tn_library_rank(f->houses->plans, house->trays, (uint32_t)house->length, plan);
    tn_status status =
        tn_house_tables_add(f->tables, house, ++f->written, rank, kept ? plan : NULL, tn_house_tables_row, f, error);
    mpz_clear(plan);
    return status;
}

tn_status tn_house_tables_close(tn_house_tables_file *f, bool complete, tn_error *error)
{
    tn_status status = TN_OK;
    for (int i = 0; i < TN_HOUSE_TABLES; i++)
        if (f->packed[i] && complete && status == TN_OK)
            status = tn_parquet_table_end(f->packed[i], error);
    for (int i = 0; i < TN_HOUSE_TABLES; i++) {
        bool good = complete && status == TN_OK;
        if (f->open[i] && (good || !f->outputs[i].replaces)) {
            tn_status written =
                tn_output_commit(&f->outputs[i], status == TN_OK ? error : NULL); /* the first is said */
            status = status == TN_OK ? written : status;
        } else if (f->open[i]) {
            tn_output_discard(&f->outputs[i]);
        }
        tn_parquet_table_free(f->packed[i]);
        free(f->columns[i]);
        free(f->paths[i]);
    }
    if (f->file && complete && status == TN_OK)
        status = f->database->close_tables(f->file, error);
    if (f->database)
        f->database->free_tables(f->file);
    tn_house_tables_free(f->tables);
    free(f->line.data);
    *f = (tn_house_tables_file){0};
    return status;
}
