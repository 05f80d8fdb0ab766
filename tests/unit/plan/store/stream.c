#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>
#include <sqlite3.h>

#include "driver/parquet/parquet.h"
#include "runtime/plan/store/sqlite.h"
#include "runtime/plan/text/reader.h"
#include "runtime/plan/text/stream.h"
#include "tests/support/test_rule.h"

#define PLANS 1000u

typedef struct fixture {
    tn_module *module;
    tn_schema *schema, *other; /* house; paper */
    char folder[64];
} fixture;

static int open_fixture(void **state)
{
    fixture *f = calloc(1, sizeof *f);
    tn_builder *builder = tn_builder_new();
    test_schema_add(builder, &test_schema_house);
    test_schema_add(builder, &test_schema_paper);
    f->module = test_module(builder);
    f->schema = test_schema_open(f->module, 0);
    f->other = test_schema_open(f->module, 1);
    strcpy(f->folder, "/tmp/tartan-stream-XXXXXX");
    *state = f;
    return mkdtemp(f->folder) ? 0 : -1;
}

static int close_fixture(void **state)
{
    fixture *f = *state;
    char command[128];
    snprintf(command, sizeof command, "rm -rf %s", f->folder);
    int failed = system(command);
    tn_schema_free(f->schema);
    tn_schema_free(f->other);
    tn_module_free(f->module);
    free(f);
    return failed;
}

static void path_of(const fixture *f, const char *name, char path[128])
{
    snprintf(path, 128, "%s/%s", f->folder, name);
}

static void write_text(const char *path, const char *text, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

/* Plan `n` of a made-up library; its rank is past 64 bits. */
static uint32_t plan_of(const tn_schema *schema, uint32_t n, tn_tray trays[8], mpz_t rank)
{
    mpz_set_str(rank, "100000000000000000000", 10);
    mpz_add_ui(rank, rank, n);
    test_random random = {.seed = n};
    uint32_t length = n % 8;
    for (uint32_t k = 0; k < length; k++)
        trays[k] = test_random_below(&random, schema->tray_count);
    return length;
}

static const tn_writer_options sqlite_options = {.format = TN_FORMAT_SQLITE,
                                                 .metadata = {.library = "houses",
                                                              .library_hash = "0123456789abcdef0123456789abcdef",
                                                              .version = "1.2.3",
                                                              .command = "enumerate"},
                                                 .batch = 100};

static tn_status open_reader(const tn_schema *schema, const char *path, const tn_reader_options *given,
                             tn_plan_reader **reader, tn_error *error)
{
    tn_reader_options options = given ? *given : (tn_reader_options){0};
    options.sqlite = tn_plan_sqlite();
    options.parquet = tn_plan_parquet_calls();
    return tn_plan_reader_open(schema, path, &options, reader, error);
}

static tn_status open_writer(const tn_schema *schema, const char *path, const tn_writer_options *given,
                             tn_plan_writer **writer, tn_error *error)
{
    tn_writer_options options = *given;
    mpz_t ranks;
    mpz_init_set_str(ranks, "200000000000000000000", 10);
    options.sqlite = tn_plan_sqlite();
    options.parquet = tn_plan_parquet_calls();
    options.ranks = ranks;
    tn_status status = tn_plan_writer_open(schema, path, &options, writer, error);
    mpz_clear(ranks);
    return status;
}

static void write_plans(const tn_schema *schema, const char *path, const tn_writer_options *options, uint32_t count)
{
    tn_plan_writer *writer = NULL;
    tn_error error;
    mpz_t rank;
    mpz_init(rank);
    test_ok(open_writer(schema, path, options, &writer, &error), &error);
    for (uint32_t n = 0; n < count; n++) {
        tn_tray trays[8];
        uint32_t length = plan_of(schema, n, trays, rank);
        test_ok(tn_plan_writer_write(writer, rank, trays, length, &error), &error);
    }
    test_ok(tn_plan_writer_close(writer, &error), &error);
    tn_plan_writer_free(writer);
    mpz_clear(rank);
}

/* Reads back what write_plans wrote; `ranked`: the format holds ranks. */
static void expect_plans(const tn_schema *schema, const char *path, tn_plan_format format, bool ranked, uint32_t count)
{
    tn_plan_reader *reader = NULL;
    tn_error error;
    mpz_t rank, found;
    mpz_inits(rank, found, NULL);
    test_ok(open_reader(schema, path, NULL, &reader, &error), &error);
    assert_int_equal(reader->format, format);
    for (uint32_t n = 0; n < count; n++) {
        tn_tray trays[8];
        const tn_plan *plan;
        uint32_t length = plan_of(schema, n, trays, rank);
        test_ok(tn_plan_reader_next(reader, &plan, &error), &error);
        assert_non_null(plan);
        assert_int_equal(plan->length, length);
        if (length > 0)
            assert_memory_equal(plan->trays, trays, length * sizeof *trays);
        assert_int_equal(tn_plan_reader_rank(reader, found), ranked);
        if (ranked)
            assert_int_equal(mpz_cmp(rank, found), 0);
        assert_int_equal(tn_plan_reader_line(reader), n + (format == TN_FORMAT_CSV ? 2 : 1));
    }
    const tn_plan *plan;
    for (int again = 0; again < 2; again++) {
        test_ok(tn_plan_reader_next(reader, &plan, &error), &error);
        assert_null(plan);
    }
    tn_plan_reader_free(reader);
    mpz_clears(rank, found, NULL);
}

static void test_round_trip(void **state)
{
    fixture *f = *state;
    for (int format = TN_FORMAT_LINES; format < TN_FORMAT_COUNT; format++) {
        char path[128];
        static const char *const names[TN_FORMAT_COUNT] = {"auto", "lines", "json", "csv", "bin", "sqlite", "parquet"};
        path_of(f, names[format], path);
        tn_writer_options options = sqlite_options;
        options.format = (tn_plan_format)format;
        for (int twice = 0; twice < 2; twice++) { /* the second time over the first file */
            write_plans(f->schema, path, &options, PLANS);
            expect_plans(f->schema, path, options.format, format != TN_FORMAT_LINES && format != TN_FORMAT_BIN, PLANS);
        }
        write_plans(f->schema, path, &options, 0);
        if (format != TN_FORMAT_JSON) /* a file with nothing in it does not say what it is */
            expect_plans(f->schema, path, options.format, false, 0);
    }
}

/* ---- text as others may write it */

typedef struct expected {
    uint64_t line;
    uint32_t code; /* 0: a plan of `value` trays; else an error whose first column is `value` */
    uint32_t value;
} expected;

static void expect_stream(const fixture *f, const char *text, size_t size, const tn_reader_options *options,
                          tn_plan_format format, const expected *wanted, size_t count)
{
    char path[128];
    path_of(f, "text", path);
    write_text(path, text, size);
    tn_plan_reader *reader = NULL;
    tn_error error;
    const tn_plan *plan;
    test_ok(open_reader(f->schema, path, options, &reader, &error), &error);
    assert_int_equal(reader->format, format);
    for (size_t i = 0; i < count; i++) {
        tn_status status = tn_plan_reader_next(reader, &plan, &error);
        assert_int_equal(tn_plan_reader_line(reader), wanted[i].line);
        if (wanted[i].code == TN_CODE_NONE) {
            test_ok(status, &error);
            assert_non_null(plan);
            assert_int_equal(plan->length, wanted[i].value);
            continue;
        }
        assert_null(plan);
        assert_int_not_equal(status, TN_OK);
        assert_int_equal(error.code, wanted[i].code);
        assert_int_equal(error.line, wanted[i].line);
        assert_int_equal(error.column, wanted[i].value);
    }
    test_ok(tn_plan_reader_next(reader, &plan, &error), &error);
    assert_null(plan);
    tn_plan_reader_free(reader);
}

#define EXPECT(f, text, options, format, ...)                                                                          \
    do {                                                                                                               \
        const expected wanted[] = {__VA_ARGS__};                                                                       \
        expect_stream(f, text, sizeof(text) - 1, options, format, wanted, sizeof wanted / sizeof *wanted);             \
    } while (0)

static void test_lines(void **state)
{
    fixture *f = *state;
    EXPECT(f, "\xEF\xBB\xBF# a comment\r\n\r\n8' single - empty\r\n  # another\n8' single - empty | 4' single - empty",
           NULL, TN_FORMAT_LINES, {2, 0, 0}, {3, 0, 1}, {5, 0, 2});
    EXPECT(f, "8' single - empty\n5' single - empty\n8' singel - empty\n\n8' single - dense\n", NULL, TN_FORMAT_LINES,
           {1, 0, 1}, {2, 602, 1}, {3, 602, 4}, {4, 0, 0}, {5, 0, 1});
    EXPECT(f, "8' single - empty\n8' single - empty | 4' single - empty\n\n", (&(tn_reader_options){.max_length = 1}),
           TN_FORMAT_LINES, {1, 0, 1}, {2, 805, 21}, {3, 0, 0});
    EXPECT(f, "8' single - empty\n8' single - empty                      \n\n", (&(tn_reader_options){.max_line = 20}),
           TN_FORMAT_LINES, {1, 0, 1}, {2, 605, 1}, {3, 0, 0});
}

static void test_json(void **state)
{
    fixture *f = *state;
    EXPECT(f, "\n# made by hand\n{\"trays\":[{}]}\n\n{\"trays\":[]}\n{\"trays\":[{\"width\":5}]}\n8' single - empty\n",
           NULL, TN_FORMAT_JSON, {3, 0, 1}, {5, 0, 0}, {6, 601, 20}, {7, 601, 1});
}

static void test_csv(void **state)
{
    fixture *f = *state;
    EXPECT(f,
           "rank,plan,note\r\n0,8' single - empty,\"a \"\"note\"\", with a comma\"\r\n1,\"96\"\" single - empty | "
           "96\"\" singel - "
           "empty\",\r\n2,,\n\n3\n4,\"8' single - empty\"x,\n5,8' single - empty\n",
           NULL, TN_FORMAT_CSV, {2, 0, 1}, {3, 602, 31}, {4, 0, 0}, {6, 601, 2}, {7, 601, 22}, {8, 0, 1});
    EXPECT(f, "plan\n8' single - empty\n", (&(tn_reader_options){.format = TN_FORMAT_CSV}), TN_FORMAT_CSV, {2, 0, 1});
    EXPECT(f, "rank,plan\n7,", NULL, TN_FORMAT_CSV, {2, 0, 0});
    /* Without a column named plan it is no CSV of ours. */
    EXPECT(f, "rank,plans\n", NULL, TN_FORMAT_LINES, {1, 602, 1});
}

static void test_long_file(void **state)
{
    fixture *f = *state;
    char path[128];
    path_of(f, "long", path);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    for (int n = 0; n < 60000; n++)
        fprintf(file, n % 1000 == 999 ? "8' singel - empty\n" : "8' single - empty | 12' double public dense:8'\n");
    fclose(file);
    tn_plan_reader *reader = NULL;
    tn_error error;
    const tn_plan *plan;
    int bad = 0, good = 0;
    test_ok(open_reader(f->schema, path, NULL, &reader, &error), &error);
    for (;;) {
        tn_status status = tn_plan_reader_next(reader, &plan, &error);
        if (status == TN_OK && !plan)
            break;
        bad += status != TN_OK;
        good += status == TN_OK;
        size_t size;
        const char *text = tn_plan_reader_text(reader, &size);
        assert_int_equal(size, status == TN_OK ? 46 : 17);
        assert_memory_equal(text, "8' sing", 7);
    }
    assert_int_equal(bad, 60);
    assert_int_equal(good, 60000 - 60);
    tn_plan_reader_free(reader);
}

/* ---- what cannot be read */

static void refuse(const fixture *f, const tn_schema *schema, const char *name, tn_plan_format format, uint32_t code)
{
    char path[128];
    path_of(f, name, path);
    tn_plan_reader *reader = NULL;
    tn_error error;
    assert_int_not_equal(open_reader(schema, path, &(tn_reader_options){.format = format}, &reader, &error), TN_OK);
    assert_null(reader);
    assert_int_equal(error.code, code);
}

static void test_refusals(void **state)
{
    fixture *f = *state;
    char path[128];
    refuse(f, f->schema, "missing", TN_FORMAT_AUTO, 901);
    refuse(f, f->schema, ".", TN_FORMAT_AUTO, 901);
    path_of(f, "junk", path);
    write_text(path, "\x7f\x45\x4c\x46\0\0\0", 7);
    refuse(f, f->schema, "junk", TN_FORMAT_AUTO, 604);
    write_text(path, "8' single - empty\n", 18);
    refuse(f, f->schema, "junk", TN_FORMAT_CSV, 604);
    refuse(f, f->schema, "junk", TN_FORMAT_BIN, 604);
    refuse(f, f->schema, "junk", TN_FORMAT_SQLITE, 604);
    write_text(path, "SQLite format 3\0 and then no database at all", 44);
    refuse(f, f->schema, "junk", TN_FORMAT_AUTO, 604);
    path_of(f, "bin", path);
    tn_writer_options options = sqlite_options;
    options.format = TN_FORMAT_BIN;
    write_plans(f->schema, path, &options, 10);
    refuse(f, f->other, "bin", TN_FORMAT_AUTO, 604);
}

/* Every truncation of a packed file reads some plans and then ends or fails; no changed byte does harm. */
static void test_damaged_bin(void **state)
{
    fixture *f = *state;
    char path[128];
    path_of(f, "bin", path);
    tn_writer_options options = sqlite_options;
    options.format = TN_FORMAT_BIN;
    write_plans(f->schema, path, &options, 20);
    char bytes[1024];
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    path_of(f, "damaged", path);
    for (size_t n = 0; n < 2 * size; n++) {
        char changed[1024];
        memcpy(changed, bytes, size);
        if (n >= size)
            changed[n - size] ^= (char)(1 << (n % 8));
        write_text(path, changed, n < size ? n : size);
        tn_plan_reader *reader = NULL;
        tn_error error;
        const tn_plan *plan = NULL;
        size_t plans = 0;
        if (open_reader(f->schema, path, NULL, &reader, &error) == TN_OK) {
            tn_status status;
            do {
                status = tn_plan_reader_next(reader, &plan, &error);
                plans += plan != NULL;
            } while (plan || (status != TN_OK && plans < 100));
        }
        assert_true(plans <= 100 && (n >= size || plans < 20));
        tn_plan_reader_free(reader);
    }
}

/* ---- libraries */

/* A library of another schema with the same words is read by its plan lines. */
static void test_library_of_another_schema(void **state)
{
    fixture *f = *state;
    char path[128];
    path_of(f, "other.sqlite", path);
    write_plans(f->schema, path, &sqlite_options, 50);
    sqlite3 *database;
    assert_int_equal(sqlite3_open(path, &database), SQLITE_OK);
    assert_int_equal(sqlite3_exec(database,
                                  "UPDATE metadata SET value = 'another' WHERE key = 'schema_hash';"
                                  "UPDATE plans SET packed = x'ffffff'",
                                  NULL, NULL, NULL),
                     SQLITE_OK);
    sqlite3_close(database);
    expect_plans(f->schema, path, TN_FORMAT_SQLITE, true, 50);
}

static long long ask(const char *path, const char *sql)
{
    sqlite3 *database;
    sqlite3_stmt *row;
    assert_int_equal(sqlite3_open(path, &database), SQLITE_OK);
    assert_int_equal(sqlite3_prepare_v2(database, sql, -1, &row, NULL), SQLITE_OK);
    assert_int_equal(sqlite3_step(row), SQLITE_ROW);
    long long answer = sqlite3_column_int64(row, 0);
    sqlite3_finalize(row);
    sqlite3_close(database);
    return answer;
}

static void test_library_tables(void **state)
{
    fixture *f = *state;
    char path[128];
    path_of(f, "tables.sqlite", path);
    write_plans(f->schema, path, &sqlite_options, PLANS);
    assert_int_equal(ask(path, "SELECT count(*) FROM plans"), PLANS);
    assert_int_equal(ask(path, "SELECT count(DISTINCT rank) FROM plans"), PLANS);
    assert_int_equal(ask(path, "SELECT sum(length(packed)) = sum(length) FROM plans"), 1);
    assert_int_equal(ask(path, "SELECT min(width_total) FROM plans WHERE length = 1") % (4 * TN_FOOT_NM), 0);
    assert_int_equal(ask(path, "SELECT rank = '100000000000000000007' FROM plans WHERE number = 8"), 1);
    assert_int_equal(ask(path, "SELECT value = 'houses' FROM metadata WHERE key = 'library'"), 1);
    assert_int_equal(ask(path, "SELECT value FROM metadata WHERE key = 'complete'"), 1);
    assert_int_equal(ask(path, "SELECT count(*) FROM metadata"), 8);
}

/* Goes on with a library from the plan after its last one, up to `count` plans in all. */
static uint64_t go_on(const fixture *f, const char *path, uint32_t count, bool die)
{
    tn_writer_options options = sqlite_options;
    options.resume = true;
    tn_plan_writer *writer = NULL;
    tn_error error;
    mpz_t rank, last;
    mpz_inits(rank, last, NULL);
    test_ok(open_writer(f->schema, path, &options, &writer, &error), &error);
    uint64_t resumed = tn_plan_writer_resumed(writer, last);
    for (uint32_t n = 0; n < count; n++) {
        tn_tray trays[8];
        uint32_t length = plan_of(f->schema, n, trays, rank);
        if (resumed == 0 || mpz_cmp(rank, last) > 0)
            test_ok(tn_plan_writer_write(writer, rank, trays, length, &error), &error);
    }
    if (die)
        raise(SIGKILL);
    test_ok(tn_plan_writer_close(writer, &error), &error);
    tn_plan_writer_free(writer);
    mpz_clears(rank, last, NULL);
    return resumed;
}

static void test_killed_and_resumed(void **state)
{
    fixture *f = *state;
    char path[128];
    path_of(f, "killed.sqlite", path);
    for (uint32_t n = 0; n < 5; n++) { /* killed with 0, 150, 300, 450, 600 plans written, in batches of 100 */
        pid_t child = fork();
        assert_true(child >= 0);
        if (child == 0) {
            go_on(f, path, 150 * n, true);
            _exit(1);
        }
        int status;
        assert_int_equal(waitpid(child, &status, 0), child);
        assert_true(WIFSIGNALED(status));
        assert_int_equal(ask(path, "SELECT count(*) FROM plans"), 150 * n / 100 * 100);
        assert_int_equal(ask(path, "SELECT value FROM metadata WHERE key = 'complete'"), 0);
    }
    assert_int_equal(go_on(f, path, PLANS, false), 600);
    expect_plans(f->schema, path, TN_FORMAT_SQLITE, true, PLANS);
    assert_int_equal(go_on(f, path, PLANS, false), PLANS); /* nothing is left to do */
    expect_plans(f->schema, path, TN_FORMAT_SQLITE, true, PLANS);
    assert_int_equal(ask(path, "SELECT value FROM metadata WHERE key = 'complete'"), 1);
}

/* A library that is there stays until a batch of the new one, here of 100 plans, is there. */
static void test_replaced_with_the_first_batch(void **state)
{
    fixture *f = *state;
    char path[128];
    tn_error error;
    mpz_t rank;
    mpz_init(rank);
    path_of(f, "replaced.sqlite", path);
    for (uint32_t written = 0; written <= 150; written += 50) {
        tn_plan_writer *writer = NULL;
        write_plans(f->schema, path, &sqlite_options, 7);
        test_ok(open_writer(f->schema, path, &sqlite_options, &writer, &error), &error);
        for (uint32_t n = 0; n < written; n++) {
            tn_tray trays[8];
            uint32_t length = plan_of(f->schema, n, trays, rank);
            test_ok(tn_plan_writer_write(writer, rank, trays, length, &error), &error);
        }
        assert_int_equal(tn_plan_writer_replaces(writer), written < 100);
        assert_int_equal(tn_plan_writer_resumes(writer), written >= 100);
        tn_plan_writer_free(writer); /* given up */
        assert_int_equal(ask(path, "SELECT count(*) FROM plans"), written < 100 ? 7 : 100);
        assert_int_equal(ask(path, "SELECT value FROM metadata WHERE key = 'complete'"), written < 100);
    }
    write_plans(f->schema, path, &sqlite_options, 5);
    assert_int_equal(ask(path, "SELECT count(*) FROM plans"), 5);
    mpz_clear(rank);
}

static void refuse_writer(const fixture *f, const tn_schema *schema, const char *name, const tn_writer_options *options,
                          uint32_t code)
{
    char path[128];
    path_of(f, name, path);
    tn_plan_writer *writer = NULL;
    tn_error error;
    assert_int_not_equal(open_writer(schema, path, options, &writer, &error), TN_OK);
    assert_null(writer);
    assert_int_equal(error.code, code);
}

static void test_refused_writers(void **state)
{
    fixture *f = *state;
    char path[128];
    path_of(f, "library.sqlite", path);
    write_plans(f->schema, path, &sqlite_options, 10);
    tn_writer_options options = sqlite_options;
    options.resume = true;
    options.metadata.library_hash = "another";
    refuse_writer(f, f->schema, "library.sqlite", &options, 606);
    options.metadata = sqlite_options.metadata;
    options.metadata.command = "enumerate --limit 10";
    refuse_writer(f, f->schema, "library.sqlite", &options, 606);
    options.metadata = sqlite_options.metadata;
    refuse_writer(f, f->other, "library.sqlite", &options, 606);
    expect_plans(f->schema, path, TN_FORMAT_SQLITE, true, 10); /* none of them changed it */

    options.format = TN_FORMAT_CSV;
    refuse_writer(f, f->schema, "new.csv", &options, 904);
    refuse_writer(f, f->schema, "no/such/folder.sqlite", &sqlite_options, 902);
    options = (tn_writer_options){.format = TN_FORMAT_LINES};
    refuse_writer(f, f->schema, "no/such/folder", &options, 902);

    /* A file that is no library of ours is left alone. */
    path_of(f, "mine.sqlite", path);
    write_text(path, "my dissertation", 15);
    refuse_writer(f, f->schema, "mine.sqlite", &sqlite_options, 902);
    path_of(f, "theirs.sqlite", path);
    sqlite3 *database;
    assert_int_equal(sqlite3_open(path, &database), SQLITE_OK);
    assert_int_equal(sqlite3_exec(database, "CREATE TABLE plans (x)", NULL, NULL, NULL), SQLITE_OK);
    sqlite3_close(database);
    refuse_writer(f, f->schema, "theirs.sqlite", &sqlite_options, 902);
    refuse(f, f->schema, "theirs.sqlite", TN_FORMAT_AUTO, 604);
}

/* A file that is not closed is given up: its target stays as it was. */
static void test_given_up(void **state)
{
    fixture *f = *state;
    char path[128];
    path_of(f, "given-up", path);
    tn_writer_options options = {.format = TN_FORMAT_LINES};
    write_plans(f->schema, path, &options, 3);
    tn_plan_writer *writer = NULL;
    tn_error error;
    mpz_t rank;
    mpz_init(rank);
    test_ok(open_writer(f->schema, path, &options, &writer, &error), &error);
    const tn_tray trays[] = {1, 2};
    test_ok(tn_plan_writer_write(writer, rank, trays, 2, &error), &error);
    tn_plan_writer_free(writer);
    mpz_clear(rank);
    expect_plans(f->schema, path, TN_FORMAT_LINES, false, 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trip),
        cmocka_unit_test(test_lines),
        cmocka_unit_test(test_json),
        cmocka_unit_test(test_csv),
        cmocka_unit_test(test_long_file),
        cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_damaged_bin),
        cmocka_unit_test(test_library_of_another_schema),
        cmocka_unit_test(test_library_tables),
        cmocka_unit_test(test_killed_and_resumed),
        cmocka_unit_test(test_replaced_with_the_first_batch),
        cmocka_unit_test(test_refused_writers),
        cmocka_unit_test(test_given_up),
    };
    return cmocka_run_group_tests(tests, open_fixture, close_fixture);
}
