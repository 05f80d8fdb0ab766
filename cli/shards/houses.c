/* Shard sets of houses, as tables: made, written, put together. */
#include "cli/shards/shards.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "cli/common/progress.h"
#include "cli/plan/house_tables.h"
#include "driver/house/judge.h"
#include "driver/shards/gather.h"
#include "driver/shards/record.h"
#include "runtime/base/file.h"
#include "runtime/house/house.h"

bool tn_shards_of_houses(const tn_job *job, const char *library)
{
    return library && tn_house_library_find(job->opened.module, library) != TN_NO_RECORD;
}

/* ---- the library */

static bool open_library(tn_job *job, const tn_house_settings *settings, tn_numbered *n)
{
    tn_error error;
    tn_progress progress;
    if (!tn_job_answered(job, tn_numbered_open(n, &job->session, settings)))
        return false;
    if (tn_numbered_walks(n)) {
        tn_help(tn_job_diagnostics(job),
                tn_job_usage(job, "clauses of `%s` ask for walks, and houses that are tried have no ranks to divide",
                             settings->library),
                "`tartan enumerate --columns` writes them at once");
        return false;
    }
    tn_progress_watch(&progress, "houses counted", tn_interrupt_waiting());
    tn_status status = tn_numbered_all(n, &error);
    tn_progress_unwatch(&progress, tn_interrupt_waiting());
    if (status != TN_OK)
        tn_job_fail(job, &error);
    return status == TN_OK;
}

bool tn_shards_ready_houses(tn_job *job, tn_shards_open *open)
{
    const tn_shard_set *set = &open->set;
    const tn_house_settings settings = {
        .library = set->library, .max_length = set->options.max_length, .plans = set->options};
    if (!open_library(job, &settings, &open->houses))
        return false;
    tn_provenance_describe_houses(&job->opened, open->houses.plans, set->library, set->rules_path, set->command,
                                  &open->described);
    return true;
}

/* ---- new */

static const char *foreign_option(const tn_new_set *what)
{
    return what->compress                   ? "compress"
           : what->sampled                  ? "sample"
           : what->written->plan_lines      ? "plan-lines"
           : what->written->row_group.given ? "row-group"
                                            : NULL;
}

static bool fits(tn_job *job, const tn_new_set *what)
{
    const char *foreign = foreign_option(what);
    tn_plan_format format = (tn_plan_format)what->written->format;
    if (foreign)
        tn_help(tn_job_diagnostics(job), tn_job_usage(job, "--%s is about shards of plans, not of houses", foreign),
                "leave it out");
    else if (format != TN_FORMAT_AUTO && format != TN_FORMAT_CSV && format != TN_FORMAT_PARQUET)
        tn_help(tn_job_diagnostics(job), tn_job_usage(job, "shards of houses are tables, of CSV or Parquet"),
                "write --format csv, the default, or --format parquet");
    else
        return true;
    return false;
}

static void make_set(tn_job *job, const tn_new_set *what, const tn_numbered *n)
{
    mpz_t all;
    mpz_init(all);
    tn_houses_count(n->all, TN_ALL_LENGTHS, all);
    const tn_new_set_of of = {.task = TN_TASK_HOUSES,
                              .format = TN_FORMAT_CSV,
                              .things = "houses",
                              .library = what->plans->library,
                              .plans = n->plans,
                              .schema = n->schema,
                              .all = all};
    tn_new_set_make(job, what, &of);
    mpz_clear(all);
}

void tn_shards_new_houses(tn_job *job, const tn_new_set *what)
{
    tn_numbered n = {0};
    const tn_library_asked asked = tn_job_asked(what->plans);
    const tn_house_settings settings = tn_asked_houses(&asked);
    if (fits(job, what)) {
        if (open_library(job, &settings, &n))
            make_set(job, what, &n);
        tn_numbered_close(&n);
    }
}

/* ---- run */

typedef struct writing {
    tn_house_tables_file *file;
    tn_shard_between *between;
    void *of;
    uint64_t written;
} writing;

static tn_status write_one(void *context, const tn_house *house, const mpz_t rank, tn_error *error)
{
    writing *w = context;
    tn_status status = tn_house_tables_write(w->file, house, rank, error);
    w->written += status == TN_OK;
    return status == TN_OK ? w->between(w->of, error) : status;
}

tn_status tn_shards_write_houses(void *context, const char *path, const mpz_t from, const mpz_t to, uint64_t before,
                                 tn_shard_between *between, void *of, uint64_t *written, tn_error *error)
{
    tn_shards_open *open = context;
    tn_house_tables_file file = {.named = true, .written = before};
    writing w = {.file = &file, .between = between, .of = of};
    tn_error later;
    tn_status status =
        tn_house_tables_open(&file, &open->houses, path, open->set.format, &open->described.metadata, error);
    if (status == TN_OK)
        status = tn_numbered_between(&open->houses, from, to, write_one, &w, error);
    tn_status closed = tn_house_tables_close(&file, status == TN_OK, &later);
    if (status == TN_OK && closed != TN_OK)
        *error = later;
    *written = w.written;
    return status == TN_OK ? closed : status;
}

/* ---- cat, merge: of sets in CSV */

typedef struct rows {
    const tn_shards_open *open;
    tn_house_tables_file *to;
    tn_house_table table;
    const tn_house_column *columns;
    size_t count;
    const char **cells; /* [count], of the line at hand */
} rows;

static tn_status wrong(const rows *r, uint32_t shard, tn_error *error)
{
    return tn_shard_wrong(&r->open->set, shard, error, "has a row of %s that cannot be read",
                          tn_house_table_name(r->table));
}

/* The next field of a line, which is cut out of it; *more: another one follows. NULL: it is none. */
static char *take_field(char **at, bool *more)
{
    char *begin = *at, *to = begin, *from = begin;
    bool quoted = *from == '"';
    if (!quoted) {
        from = to = begin + strcspn(begin, ",\r");
    } else {
        for (from++; *from && (*from != '"' || from[1] == '"'); *to++ = *from++)
            from += *from == '"';
        if (*from++ != '"')
            return NULL;
    }
    *more = *from == ',';
    if (!*more && strcmp(from, "\r\n") != 0)
        return NULL;
    *at = from + 1;
    *to = '\0';
    return begin;
}

/* Where a table has no value, and where a text has no letters, nothing stands: rooms behind faces are left out, and
 * numbers, but no text of a house or of a room. */
static const char *cell_of(const rows *r, size_t column, const char *text)
{
    bool empty = !*text && (r->table == TN_TABLE_FACES || r->columns[column].kind != TN_COLUMN_TEXT);
    return empty ? NULL : text;
}

static bool take_cells(rows *r, char *line)
{
    bool more = true;
    for (size_t i = 0; i < r->count; i++) {
        const char *text = more ? take_field(&line, &more) : NULL;
        if (!text)
            return false;
        r->cells[i] = cell_of(r, i, text);
    }
    return !more;
}

static tn_status copy_lines(rows *r, uint32_t shard, FILE *in, tn_error *error)
{
    char *line = NULL;
    size_t room = 0, seen = 0;
    tn_status status = TN_OK;
    while (status == TN_OK && getline(&line, &room, in) > 0) {
        if (!take_cells(r, line))
            status = wrong(r, shard, error);
        else if (seen > 0) /* behind the head */
            status = tn_house_tables_row(r->to, r->table, r->cells, error);
        seen++;
        if (status == TN_OK && tn_watch_stopped_at(tn_interrupt_waiting(), seen))
            status = tn_fail_stopped(tn_interrupt_waiting(), error);
    }
    free(line);
    return status == TN_OK && seen == 0 ? wrong(r, shard, error) : status;
}

static tn_status copy_shard(rows *r, uint32_t shard, tn_error *error)
{
    char *path = tn_shard_file_path(&r->open->set, shard, r->table);
    FILE *in = path ? tn_file_stream(path) : NULL;
    tn_status status = in     ? copy_lines(r, shard, in, error)
                       : path ? tn_cannot_read(path, errno, error)
                              : tn_fail_memory(error);
    if (in && status == TN_OK && ferror(in))
        status = tn_cannot_read(path, errno, error);
    if (in)
        fclose(in);
    free(path);
    return status;
}

static tn_status copy_table(const tn_shards_open *open, tn_house_table table, tn_house_tables_file *to, tn_error *error)
{
    rows r = {.open = open, .to = to, .table = table};
    r.columns = tn_house_table_columns(to->tables, table, &r.count);
    r.cells = calloc(r.count + 1, sizeof *r.cells);
    tn_status status = r.cells ? TN_OK : tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i < open->set.count; i++)
        status = copy_shard(&r, i, error);
    free(r.cells);
    return status;
}

/* Before anything is written. */
static tn_status check_all(const tn_shards_open *open, tn_error *error)
{
    tn_status status = tn_shards_complete(&open->set, error);
    for (uint32_t i = 0; status == TN_OK && i < open->set.count; i++)
        status = tn_shard_same_as_record(&open->set, i, error);
    return status;
}

static tn_status gather(tn_shards_open *open, const char *output, tn_plan_format format, tn_error *error)
{
    tn_house_tables_file file = {.csv_safe = false};
    tn_error later;
    tn_status status = check_all(open, error);
    if (status != TN_OK)
        return status;
    status = tn_house_tables_open(&file, &open->houses, output, format, &open->described.metadata, error);
    for (int i = 0; status == TN_OK && i < TN_HOUSE_TABLES; i++)
        status = copy_table(open, (tn_house_table)i, &file, error);
    tn_status closed = tn_house_tables_close(&file, status == TN_OK, &later);
    if (status == TN_OK && closed != TN_OK)
        *error = later;
    return status == TN_OK ? closed : status;
}

void tn_shards_gather_houses(tn_job *job, tn_shards_open *open, const char *output, tn_plan_format format)
{
    tn_error error;
    if (open->set.format != TN_FORMAT_CSV)
        tn_help(tn_job_diagnostics(job), tn_job_usage(job, "tables in Parquet are read where they are, and not copied"),
                "DuckDB takes %.100s/shards/*/*.houses.parquet as one table; sets of --format csv are put together",
                open->set.folder);
    else if (gather(open, output ? output : "-", format, &error) != TN_OK)
        tn_job_fail(job, &error);
}
