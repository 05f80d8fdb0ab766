/* Writes the plans or houses that a question finds. */
#include "cli/plan/found_rows.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "ask/house/numbered.h"
#include "cli/common/interrupt.h"
#include "driver/parquet/parquet.h"
#include "driver/plan/provenance.h"
#include "runtime/house/house.h"
#include "runtime/plan/library/listing.h"
#include "runtime/plan/store/sqlite.h"

/* ---- writes rows in the format that the options ask for */

/* Opens the output that --output and --format ask for. False where that failed. */
static bool job_row_writer(tn_job *job, const tn_written_settings *settings, const tn_row_source *source,
                           tn_plan_writer **writer)
{
    char what[64];
    snprintf(what, sizeof what, "a list of %s", source->rows ? source->rows->what : "plans");
    if (!tn_job_writes(job, what, settings->output,
                       source->rows ? TN_WRITES_ROWS & ~(TN_WRITES(BIN) | TN_WRITES(PARQUET)) : TN_WRITES_ROWS))
        return false;
    if (settings->csv_safe && settings->format != TN_FORMAT_CSV) {
        tn_job_usage(job, "--csv-safe is about --format csv");
        return false;
    }
    if ((settings->plan_lines || settings->row_group.given) && settings->format != TN_FORMAT_PARQUET) {
        tn_help(tn_job_diagnostics(job), tn_job_usage(job, "--plan-lines and --row-group are about Parquet"),
                "write to a file that ends in .parquet, or give --format parquet");
        return false;
    }
    tn_writer_options options = {
        .format = (tn_plan_format)settings->format,
        .rows = source->rows,
        .metadata = *source->metadata,
        .columns = settings->columns,
        .csv_safe = settings->csv_safe,
        .resume = settings->resume,
        .row_group = (uint32_t)settings->row_group.value,
        .plan_lines = settings->plan_lines,
        .ranks = source->ranks,
        .sqlite = tn_plan_sqlite(),
        .parquet = tn_plan_parquet_calls(),
    };
    tn_error error;
    tn_status status =
        tn_plan_writer_open(source->schema, settings->output ? settings->output : "-", &options, writer, &error);
    if (status != TN_OK)
        tn_job_fail(job, &error);
    return status == TN_OK;
}

/* Finishes the file, unless the job has failed: then it is given up (a database keeps its whole batches). Frees the
 * writer. */
static void tn_job_rows_close(tn_job *job, tn_plan_writer *writer)
{
    tn_error error;
    if (job->exit_code == TN_EXIT_DONE && !job->reader_gone && tn_plan_writer_close(writer, &error) != TN_OK)
        tn_job_fail(job, &error);
    tn_plan_writer_free(writer);
}

/* ---- writes the plans or houses that a question finds */

#define PART "interrupted; %.400s holds only the first plans of the sample"

/* How often plans look at the clock. */
enum { LOOK_EVERY = 4096 };

/* ---- opened */

/* What has no ranks is written as lines, JSON or packed; `why` says of what. */
static bool says_no_ranks(const tn_found_rows *rows, const char *why)
{
    tn_plan_format format = (tn_plan_format)rows->settings->format;
    if (format != TN_FORMAT_CSV && format != TN_FORMAT_SQLITE && format != TN_FORMAT_PARQUET)
        return true;
    tn_help(tn_job_diagnostics(rows->job),
            tn_job_usage(rows->job, "%s, and their ranks, which this format has, are not known", why),
            rows->of.houses ? "write lines or JSON, or tables (--columns)" : "write lines or JSON");
    return false;
}

static bool open_plans(tn_found_rows *rows)
{
    static const tn_row_columns ways = {
        .what = "plans with their ways", .table = "plans", .before = true, .names = {"ways"}, .count = 1};
    static const tn_row_columns stands = {.what = "rows of plans", .table = "rows", .names = {"row"}, .count = 1};
    const tn_ready_library *ready = rows->of.plans;
    const tn_written_settings *settings = rows->settings;
    char command[400];
    tn_provenance described;
    mpz_t ranks;
    snprintf(command, sizeof command, "%s%s%s%s%s", rows->made, settings->columns ? " --columns" : "",
             rows->of.ways ? " --ways" : "", rows->of.rows ? " --plans" : "", rows->of.weight ? " (by weight)" : "");
    tn_provenance_describe(&rows->job->opened, ready, rows->job->settings->operands.items[0], command, &described);
    if (rows->of.unranked && !says_no_ranks(rows, "these plans are found by search"))
        return false;
    mpz_init(ranks);
    bool counted = rows->of.rows || ready->library;
    if (rows->of.rows)
        mpz_set(ranks, rows->of.rows);
    else if (ready->library)
        tn_library_kept(ready->library, TN_ALL_LENGTHS, ranks);
    const tn_row_source source = {.schema = ready->schema,
                                  .metadata = &described.metadata,
                                  .rows = rows->of.rows   ? &stands
                                          : rows->of.ways ? &ways
                                                          : NULL,
                                  .ranks = counted ? ranks : NULL};
    bool opened = job_row_writer(rows->job, settings, &source, &rows->writer);
    mpz_clear(ranks);
    return opened;
}

/* As tables: of CSV, Parquet or a database, from the first to the last. */
static bool open_tables(tn_found_rows *rows, const tn_plan_metadata *metadata)
{
    const tn_written_settings *settings = rows->settings;
    tn_plan_format format = (tn_plan_format)settings->format;
    if (format != TN_FORMAT_SQLITE && format != TN_FORMAT_CSV && format != TN_FORMAT_PARQUET)
        tn_help(tn_job_diagnostics(rows->job),
                tn_job_usage(rows->job, "tables of houses are CSV, Parquet or a database"),
                "write to a file that ends in .csv, .parquet or .sqlite, or leave out --columns");
    else if (settings->resume)
        tn_help(tn_job_diagnostics(rows->job), tn_job_usage(rows->job, "tables of houses are written at once"),
                "leave out --resume or --columns");
    else if (settings->plan_lines || settings->row_group.given)
        tn_help(tn_job_diagnostics(rows->job),
                tn_job_usage(rows->job, "--plan-lines and --row-group are about plans in Parquet"), "leave them out");
    else
        rows->in_tables = true;
    if (!rows->in_tables || (format != TN_FORMAT_SQLITE && !tn_job_takes_text(rows->job, settings->output)))
        return false;
    tn_error error;
    rows->tables.csv_safe = settings->csv_safe;
    if (tn_house_tables_open(&rows->tables, rows->of.houses, settings->output, format, metadata, &error) == TN_OK)
        return true;
    tn_job_fail(rows->job, &error);
    return false;
}

static bool open_houses(tn_found_rows *rows)
{
    static const tn_row_columns columns = {
        .what = "houses", .table = "houses", .names = {"plan_rank", "variant", "house"}, .count = 3};
    const tn_numbered *n = rows->of.houses;
    tn_provenance *described = &rows->described;
    tn_provenance_describe_houses(&rows->job->opened, n->plans, tn_text(n->form.module, n->record->name),
                                  rows->job->settings->operands.items[0], rows->made, described);
    if (rows->settings->columns)
        return open_tables(rows, &described->metadata);
    if (rows->of.unranked && !says_no_ranks(rows, "these houses are tried, as clauses ask for walks"))
        return false;
    const tn_row_source source = {.schema = n->schema, .metadata = &described->metadata, .rows = &columns};
    return job_row_writer(rows->job, rows->settings, &source, &rows->writer);
}

static const char *things(const tn_found_rows *rows)
{
    return rows->of.houses ? "houses" : rows->of.rows ? "rows of plans" : "plans";
}

/* Goes on after what a database has. */
static void resume(tn_found_rows *rows, tn_found_of *of)
{
    mpz_t last;
    mpz_init(last);
    rows->written = of->before = tn_plan_writer_resumed(rows->writer, last);
    if (rows->written > 0) {
        mpz_add_ui(of->from, last, 1);
        mpz_set(rows->next, of->from);
        tn_job_note(rows->job, "%" PRIu64 " %s are there already; going on after them", rows->written, things(rows));
        tn_job_show(rows->job);
    }
    mpz_clear(last);
}

/* ---- progress: plans or houses, if there is a limit of them, else ranks */

static double ranks_from_first(const tn_found_rows *rows, const mpz_t rank)
{
    mpz_t ranks;
    mpz_init(ranks);
    mpz_sub(ranks, rank, rows->first);
    double count = mpz_get_d(ranks);
    mpz_clear(ranks);
    return count;
}

static double done(const tn_found_rows *rows)
{
    return rows->most.given || rows->of.houses ? (double)rows->written : ranks_from_first(rows, rows->next);
}

static void begin_progress(tn_found_rows *rows)
{
    const char *output = rows->settings->output;
    bool to_stdout = !output || strcmp(output, "-") == 0, limited = rows->most.given;
    double ranks = rows->of.to ? ranks_from_first(rows, rows->of.to) : 0, most = (double)rows->most.value;
    bool enough = !rows->all_ranks || !rows->of.to || most < ranks; /* as far as can be known */
    const char *what = rows->all_ranks || limited || rows->of.houses ? things(rows) : "ranks";
    double total = limited && enough ? most : rows->of.houses ? 0 : ranks;
    tn_progress_begin(&rows->progress, what, done(rows), total);
    rows->progress.shows = rows->progress.shows && !(to_stdout && isatty(STDOUT_FILENO)); /* not between the rows */
}

/* ---- taken all together */

static bool append_plan(void *context, const mpz_t rank, const tn_tray *trays, uint32_t length, tn_buffer *text,
                        tn_buffer *room)
{
    const tn_found_rows *rows = context;
    return tn_plan_writer_text(rows->writer, rank, trays, length, text, room);
}

static tn_status put_plans(void *context, const tn_buffer *text, uint64_t plans, tn_error *error)
{
    tn_found_rows *rows = context;
    tn_status status = tn_plan_writer_put(rows->writer, text, error);
    if (status != TN_OK) {
        rows->put_failed = true;
        return status;
    }
    mpz_add_ui(rows->next, rows->next, (unsigned long)plans);
    rows->written += plans;
    if (rows->enumerates)
        tn_progress_update(&rows->progress, done(rows));
    return TN_OK;
}

static tn_status lists(void *context, const tn_library *library, mpz_srcptr from, mpz_srcptr to, unsigned threads,
                       bool *ended, tn_error *error)
{
    tn_found_rows *rows = context;
    const tn_plan_listing listing = {.library = library,
                                     .from = from,
                                     .to = to,
                                     .threads = threads,
                                     .watch = rows->job->opened.module->watch,
                                     .append = append_plan,
                                     .put = put_plans,
                                     .context = rows};
    tn_status status = tn_library_list(&listing, error);
    if (status == TN_OK || !rows->put_failed)
        return status;
    tn_job_fail(rows->job, error);
    *ended = true;
    return TN_STOPPED;
}

/* ---- taken */

static bool begins(void *context, tn_found_of *of)
{
    tn_found_rows *rows = context;
    rows->of = *of;
    tn_job_show(rows->job);
    if (!(of->houses ? open_houses(rows) : open_plans(rows)))
        return false;
    if (of->from) {
        mpz_set(rows->first, of->from);
        mpz_set(rows->next, of->from);
    }
    if (of->from && rows->writer)
        resume(rows, of);
    if (!of->houses && !of->rows && of->plans->library && tn_plan_writer_is_text(rows->writer))
        rows->taker.lists = lists;
    if (rows->sample && rows->writer && tn_plan_writer_resumes(rows->writer))
        tn_interrupt_last_words(PART, rows->settings->output);
    if (rows->enumerates)
        begin_progress(rows);
    return true;
}

/* The texts of the row are those of the columns above. */
static tn_status write_house_row(tn_found_rows *rows, const tn_found_one *found, const char *plan_rank,
                                 const char *variant, tn_error *error)
{
    bool as_json = rows->settings->format == TN_FORMAT_JSON;
    rows->line.size = rows->members.size = 0;
    tn_status status = tn_house_write(found->house, &rows->line, error);
    tn_json members = tn_json_text(&rows->members, TN_JSON_TIGHT);
    if (status == TN_OK && as_json)
        status = tn_house_write_members(found->house, &members, error);
    if (status == TN_OK && rows->members.failed)
        status = tn_fail_memory(error);
    if (status != TN_OK)
        return status;
    const tn_plan_row row = {.trays = found->trays,
                             .length = found->length,
                             .texts = {plan_rank, variant, rows->line.data},
                             .members = rows->members.data};
    return tn_plan_writer_write_row(rows->writer, found->rank, &row, error);
}

static tn_status write_house(tn_found_rows *rows, const tn_found_one *found, tn_error *error)
{
    mpz_t plan;
    mpz_init(plan);
    bool kept = tn_library_rank(rows->of.houses->plans, found->trays, found->length, plan);
    char *plan_rank = mpz_get_str(NULL, 10, plan);
    char *number = found->variant ? mpz_get_str(NULL, 10, found->variant) : NULL;
    tn_status status = TN_OK;
    if (!kept)
        status = tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a house stands on a plan that is not in the library");
    else if (!plan_rank || (found->variant && !number))
        status = tn_fail_memory(error);
    else
        status = write_house_row(rows, found, plan_rank, number, error);
    free(plan_rank);
    free(number);
    mpz_clear(plan);
    return status;
}

static tn_status write_plan(tn_found_rows *rows, const tn_found_one *found, tn_error *error)
{
    if (found->row) {
        const tn_plan_row row = {
            .trays = found->trays, .length = found->length, .texts = {found->row}, .members = found->plans};
        return tn_plan_writer_write_row(rows->writer, found->rank, &row, error);
    }
    if (!found->ways)
        return tn_plan_writer_write(rows->writer, found->rank, found->trays, found->length, error);
    char *ways = mpz_get_str(NULL, 10, found->ways);
    if (!ways)
        return tn_fail_memory(error);
    const tn_plan_row row = {.trays = found->trays, .length = found->length, .texts = {ways}};
    tn_status status = tn_plan_writer_write_row(rows->writer, found->rank, &row, error);
    free(ways);
    return status;
}

static bool takes(void *context, const tn_found_one *found)
{
    tn_found_rows *rows = context;
    tn_error error;
    tn_status status = rows->in_tables ? tn_house_tables_write(&rows->tables, found->house, found->rank, &error)
                                       : (found->house ? write_house : write_plan)(rows, found, &error);
    if (status != TN_OK) {
        tn_job_fail(rows->job, &error);
        return false;
    }
    if (found->rank)
        mpz_add_ui(rows->next, found->rank, 1);
    rows->written++;
    if (rows->enumerates && (found->house || rows->written % LOOK_EVERY == 0))
        tn_progress_update(&rows->progress, done(rows));
    return true;
}

void tn_found_rows_begin(tn_found_rows *rows, tn_job *job, const tn_written_settings *settings, const char *made)
{
    *rows = (tn_found_rows){
        .job = job, .settings = settings, .made = made, .taker = {.begins = begins, .takes = takes, .context = rows}};
    mpz_inits(rows->first, rows->next, NULL);
    job->session.taker = &rows->taker;
}

/* ---- ended */

static void close_writer(tn_found_rows *rows)
{
    if (rows->writer)
        tn_job_rows_close(rows->job, rows->writer);
    rows->writer = NULL;
    tn_error error;
    if (rows->in_tables &&
        tn_house_tables_close(&rows->tables, rows->job->exit_code == TN_EXIT_DONE, &error) != TN_OK)
        tn_job_fail(rows->job, &error);
    rows->in_tables = false;
}

/* Keeps what was written: whole batches of a database, every row of anything else, and says how to go on. A database
 * that was to be replaced is as it was, which is said at the end. */
static void interrupt(tn_found_rows *rows)
{
    if (tn_plan_writer_replaces(rows->writer))
        return;
    if (tn_plan_writer_resumes(rows->writer) && rows->sample) {
        tn_job_interrupted(rows->job, PART, rows->settings->output);
    } else if (rows->enumerates && tn_plan_writer_resumes(rows->writer)) {
        tn_interrupt_answered();
        tn_job_interrupted(rows->job,
                           "interrupted; a database keeps its whole batches, and --resume goes on after them");
    } else if (rows->enumerates) {
        tn_interrupt_answered();
        close_writer(rows);
        char *rank = mpz_get_str(NULL, 10, rows->next);
        tn_job_interrupted(rows->job, "interrupted; %" PRIu64 " %s are written, and --from %s goes on after them",
                           rows->written, things(rows), rank ? rank : "?");
        free(rank);
    }
}

void tn_found_rows_end(tn_found_rows *rows, tn_status status)
{
    if (rows->enumerates && (rows->writer || rows->in_tables))
        tn_progress_end(&rows->progress);
    if (status == TN_STOPPED && rows->writer)
        interrupt(rows);
    tn_job_answered(rows->job, status);
    close_writer(rows);
    rows->job->session.taker = NULL;
    free(rows->line.data);
    free(rows->members.data);
    mpz_clears(rows->first, rows->next, NULL);
}
