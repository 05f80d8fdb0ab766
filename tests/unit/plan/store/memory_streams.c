/* Out of memory in schemas, the reference engine and streams of plans: each of our allocations fails once, and then all
 * from there on. What fails must say so and leave nothing behind (the sanitized build would see it). */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "driver/parquet/parquet.h"
#include "runtime/plan/match/vm.h"
#include "runtime/plan/store/sqlite.h"
#include "runtime/plan/text/stream.h"
#include "tests/support/failing_memory.h"
#include "tests/support/test_rule.h"

typedef struct context {
    tn_module *module;
    tn_schema *schema;
    uint32_t rules;
    tn_plan_format format;
    char path[64];
} context;

typedef tn_status operation(const context *c, tn_error *error);

/* SQLite recovers from some failures by itself, so that success is allowed. */
static void expect_robust(operation *operate, const context *c)
{
    size_t failures = 0;
    for (int all_after = 0; all_after < 2; all_after++) {
        for (size_t number = 0;; number++) {
            tn_error error = {0};
            fail_allocation(number, all_after);
            tn_status status = operate(c, &error);
            bool reached = stop_failing() > number;
            if (!reached) {
                test_ok(status, &error);
                break;
            }
            if (status == TN_OK)
                continue;
            if (status != TN_MEMORY || error.code != E_OUT_OF_MEMORY)
                fail_msg("allocation %zu, format %d: %s", number, (int)c->format, error.message);
            failures++;
        }
    }
    assert_true(failures > 2);
}

static tn_status open_schema(const context *c, tn_error *error)
{
    tn_schema *schema = NULL;
    tn_status status = tn_schema_new(c->module, 0, 0, &schema, error);
    tn_schema_free(schema);
    return status;
}

static tn_status match(const context *c, tn_error *error)
{
    tn_plan_vm *vm = NULL;
    const tn_tray trays[100] = {1, 2, 3};
    tn_status status = tn_plan_vm_new(c->schema, 0, &vm, error);
    for (size_t length = 0; status == TN_OK && length <= 100; length += 50) {
        status = tn_plan_vm_plan(vm, trays, length, error);
        for (uint32_t r = 0; status == TN_OK && r < c->rules; r++) {
            bool holds;
            status = tn_plan_vm_holds(vm, c->module->RULE_records[r].holds, &holds, error);
        }
    }
    tn_plan_vm_free(vm);
    return status;
}

static tn_status write_plans(const context *c, tn_error *error)
{
    tn_plan_writer *writer = NULL;
    tn_writer_options options = {.format = c->format,
                                 .metadata = {.library = "houses", .command = "all"},
                                 .batch = 5,
                                 .row_group = 5,
                                 .plan_lines = true,
                                 .sqlite = tn_plan_sqlite(),
                                 .parquet = tn_plan_parquet_calls()};
    mpz_t rank;
    mpz_init(rank);
    tn_status status = tn_plan_writer_open(c->schema, c->path, &options, &writer, error);
    for (uint32_t n = 0; status == TN_OK && n < 12; n++) {
        const tn_tray trays[20] = {n, 1, 2, 3};
        mpz_set_ui(rank, n);
        status = tn_plan_writer_write(writer, rank, trays, n, error);
    }
    if (status == TN_OK)
        status = tn_plan_writer_close(writer, error);
    tn_plan_writer_free(writer);
    mpz_clear(rank);
    return status;
}

/* Rows that are houses: with texts beside the plan, and members of JSON. */
static tn_status write_rows(const context *c, tn_error *error)
{
    static const tn_row_columns columns = {
        .what = "houses", .table = "houses", .names = {"plan_rank", "variant", "house"}, .count = 3};
    tn_plan_writer *writer = NULL;
    tn_writer_options options = {.format = c->format,
                                 .rows = &columns,
                                 .metadata = {.library = "houses", .command = "all"},
                                 .batch = 5,
                                 .sqlite = tn_plan_sqlite()};
    mpz_t rank;
    mpz_init(rank);
    tn_status status = tn_plan_writer_open(c->schema, c->path, &options, &writer, error);
    for (uint32_t n = 0; status == TN_OK && n < 20; n++) {
        const tn_tray trays[20] = {n, 1, 2, 3};
        const tn_plan_row row = {trays, n, {"3", "17", "a plan ; \"shed\", then ; -"}, ",\"section\":{}"};
        mpz_set_ui(rank, n);
        status = tn_plan_writer_write_row(writer, rank, &row, error);
    }
    if (status == TN_OK)
        status = tn_plan_writer_close(writer, error);
    tn_plan_writer_free(writer);
    mpz_clear(rank);
    return status;
}

static tn_status read_plans(const context *c, tn_error *error)
{
    tn_plan_reader *reader = NULL;
    const tn_reader_options options = {.sqlite = tn_plan_sqlite(), .parquet = tn_plan_parquet_calls()};
    tn_status status = tn_plan_reader_open(c->schema, c->path, &options, &reader, error);
    const tn_plan *plan = NULL;
    size_t plans = 0;
    while (status == TN_OK && (status = tn_plan_reader_next(reader, &plan, error)) == TN_OK && plan)
        plans++;
    if (status == TN_OK)
        assert_int_equal(plans, 12);
    tn_plan_reader_free(reader);
    return status;
}

/* The same, as threads read a file side by side; other formats are not read so. */
static tn_status read_stretches(const context *c, tn_error *error)
{
    tn_plan_reader *reader = NULL;
    tn_plan_lines *lines = NULL;
    const tn_reader_options options = {.sqlite = tn_plan_sqlite(), .parquet = tn_plan_parquet_calls()};
    tn_status status = tn_plan_reader_open(c->schema, c->path, &options, &reader, error);
    if (status == TN_OK)
        status = tn_plan_lines_new(reader, &lines, error);
    uint64_t total = status == TN_OK ? tn_plan_reader_share(reader) : 0, count;
    for (uint64_t begin = 0; status == TN_OK && begin < total; begin += 100) {
        const tn_plan *plan;
        status = tn_plan_lines_read(lines, reader, begin, 100, &count, error);
        while (status == TN_OK && (status = tn_plan_lines_next(lines, &plan, error)) == TN_OK && plan)
            count--;
        if (status == TN_OK)
            assert_int_equal(count, 0);
    }
    tn_plan_lines_free(lines);
    tn_plan_reader_free(reader);
    return status;
}

/* Texts with escapes and doubled quotes take memory that others do not. */
static tn_status read_escapes(const context *c, tn_error *error)
{
    static const char json[] =
        "{\"r\\u0061nk\":\"1\",\"rank\":\"12\",\"trays\":[{\"w\\u0069dth\":\"96\\\"\",\"machine\":"
        "{\"fill\":\"d\\u0065nse\",\"depth\":\"48\\\"\"}}]}";
    tn_plan plan = {0};
    tn_status status = tn_plan_parse_json(c->schema, json, sizeof json - 1, 10, &plan, error);
    free(plan.trays);
    return status;
}

static void test_out_of_memory(void **state)
{
    (void)state;
    test_random random = {.seed = 4};
    tn_builder *builder = tn_builder_new();
    test_schema_add(builder, &test_schema_house);
    context c = {.rules = 5};
    for (uint32_t r = 0; r < c.rules; r++) {
        char name[16];
        snprintf(name, sizeof name, "r%u", (unsigned)r);
        test_rule *rule = test_rule_random(&random, &test_schema_house, 3, true);
        test_rule_add(builder, name, rule);
        test_rule_free(rule);
    }
    c.module = test_module(builder);
    c.schema = test_schema_open(c.module, 0);
    expect_robust(open_schema, &c);
    expect_robust(match, &c);
    expect_robust(read_escapes, &c);
    strcpy(c.path, "/tmp/tartan-memory-XXXXXX");
    int file = mkstemp(c.path);
    assert_true(file >= 0);
    close(file);
    for (int format = TN_FORMAT_LINES; format < TN_FORMAT_COUNT; format++) {
        c.format = (tn_plan_format)format;
        remove(c.path);
        expect_robust(write_plans, &c);
        expect_robust(read_plans, &c);
        expect_robust(read_stretches, &c);
    }
    static const tn_plan_format formats[] = {TN_FORMAT_LINES, TN_FORMAT_JSON, TN_FORMAT_CSV, TN_FORMAT_SQLITE};
    for (size_t f = 0; f < sizeof formats / sizeof *formats; f++) {
        c.format = formats[f];
        remove(c.path);
        expect_robust(write_rows, &c);
    }
    remove(c.path);
    tn_schema_free(c.schema);
    tn_module_free(c.module);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_out_of_memory)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
