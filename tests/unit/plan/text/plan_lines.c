/* Plan lines read from a file by stretches, as threads do, against the reader that goes through it once. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "runtime/plan/text/stream.h"
#include "tests/support/test_rule.h"

#define EVENTS_MAX 64
#define LINE_MAX_BYTES 60

/* Lines of all kinds: good, bad, empty, comments, too long, with both kinds of ends; the last has none. */
static const char text[] = "\xEF\xBB\xBF# a comment\r\n\r\n8' single - empty\r\n"
                           "  # another\n8' single - empty | 4' single - empty\n\n\n8' singel - empty\n"
                           "8' single - empty                                              too long\n"
                           "12' double public dense:8'\n#\n8' single - empty |\r\n"
                           "############################################################### this too, and longer "
                           "than the stretches\n"
                           "8' single - empty | 12' double public dense:8'\n\r\n4' single - empty";

typedef struct fixture {
    tn_module *module;
    tn_schema *schema;
    char path[64];
} fixture;

/* What came of a line. */
typedef struct event {
    uint64_t line;
    int code; /* 0: a plan */
    size_t column, trays, text_size;
} event;

typedef struct events {
    event items[EVENTS_MAX];
    size_t count;
} events;

static const tn_reader_options options = {.format = TN_FORMAT_LINES, .max_line = LINE_MAX_BYTES};

static int open_fixture(void **state)
{
    fixture *f = calloc(1, sizeof *f);
    tn_builder *builder = tn_builder_new();
    test_schema_add(builder, &test_schema_house);
    f->module = test_module(builder);
    f->schema = test_schema_open(f->module, 0);
    strcpy(f->path, "/tmp/tartan-lines-XXXXXX");
    *state = f;
    int file = mkstemp(f->path);
    bool written = write(file, text, sizeof text - 1) == sizeof text - 1;
    return close(file) == 0 && written ? 0 : -1;
}

static int close_fixture(void **state)
{
    fixture *f = *state;
    int failed = unlink(f->path);
    tn_schema_free(f->schema);
    tn_module_free(f->module);
    free(f);
    return failed;
}

static void add(events *list, uint64_t line, tn_status status, const tn_plan *plan, const tn_error *error,
                size_t text_size)
{
    assert_true(list->count < EVENTS_MAX);
    list->items[list->count++] = status == TN_OK ? (event){line, 0, 0, plan->length, text_size}
                                                 : (event){line, error->code, error->column, 0, text_size};
}

static void read_through(tn_plan_reader *reader, events *list)
{
    for (;;) {
        tn_error error;
        const tn_plan *plan;
        tn_status status = tn_plan_reader_next(reader, &plan, &error);
        if (status == TN_OK && !plan)
            return;
        size_t size;
        (void)tn_plan_reader_text(reader, &size);
        add(list, tn_plan_reader_line(reader), status, plan, &error, size);
    }
}

/* Reads what was shared, `total` bytes, by stretches of `size`. */
static void read_stretches(const tn_plan_reader *reader, uint64_t total, size_t size, events *list)
{
    tn_plan_lines *lines;
    tn_error error;
    uint64_t before = 0, count;
    test_ok(tn_plan_lines_new(reader, &lines, &error), &error);
    for (uint64_t begin = 0; begin < total; begin += size, before += count) {
        test_ok(tn_plan_lines_read(lines, reader, begin, size, &count, &error), &error);
        for (;;) {
            const tn_plan *plan;
            tn_status status = tn_plan_lines_next(lines, &plan, &error);
            if (status == TN_OK && !plan)
                break;
            if (status != TN_OK)
                assert_int_equal(error.line, tn_plan_lines_line(lines));
            size_t bytes;
            (void)tn_plan_lines_text(lines, &bytes);
            add(list, before + tn_plan_lines_line(lines), status, plan, &error, bytes);
        }
        assert_int_equal(tn_plan_lines_line(lines), count);
    }
    tn_plan_lines_free(lines);
}

static tn_plan_reader *open_reader(const fixture *f, const char *path)
{
    tn_plan_reader *reader = NULL;
    tn_error error;
    test_ok(tn_plan_reader_open(f->schema, path, &options, &reader, &error), &error);
    return reader;
}

static void expect_same(const events *a, const events *b)
{
    assert_int_equal(a->count, b->count);
    for (size_t i = 0; i < a->count; i++) {
        assert_int_equal(a->items[i].line, b->items[i].line);
        assert_int_equal(a->items[i].code, b->items[i].code);
        assert_int_equal(a->items[i].column, b->items[i].column);
        assert_int_equal(a->items[i].trays, b->items[i].trays);
        assert_int_equal(a->items[i].text_size, b->items[i].text_size);
    }
}

static void test_stretches(void **state)
{
    const fixture *f = *state;
    events whole = {.count = 0};
    tn_plan_reader *reader = open_reader(f, f->path);
    read_through(reader, &whole);
    tn_plan_reader_free(reader);
    assert_int_equal(whole.count, 13);
    for (size_t size = 1; size < sizeof text + 5; size++) {
        events apart = {.count = 0};
        reader = open_reader(f, f->path);
        uint64_t total = tn_plan_reader_share(reader);
        assert_int_equal(total, sizeof text - 1 - 3); /* without the mark at its beginning */
        const tn_plan *plan;
        assert_int_equal(tn_plan_reader_next(reader, &plan, NULL), TN_OK);
        assert_null(plan);
        read_stretches(reader, total, size, &apart);
        expect_same(&whole, &apart);
        tn_plan_reader_free(reader);
    }
}

/* Standard input from the middle of a file on; its place is then the end, as if it had been read. */
static void test_standard_input(void **state)
{
    const fixture *f = *state;
    events apart = {.count = 0};
    int kept = dup(STDIN_FILENO);
    assert_non_null(freopen(f->path, "rb", stdin));
    off_t middle = strstr(text, "8' singel") - text;
    assert_int_equal(lseek(STDIN_FILENO, middle, SEEK_SET), middle);
    tn_plan_reader *reader = open_reader(f, "-");
    uint64_t total = tn_plan_reader_share(reader);
    assert_int_equal(total, sizeof text - 1 - (size_t)middle);
    assert_int_equal(lseek(STDIN_FILENO, 0, SEEK_CUR), sizeof text - 1);
    read_stretches(reader, total, 16, &apart);
    assert_int_equal(apart.items[0].line, 1);
    assert_int_equal(apart.items[0].code, 602);
    tn_plan_reader_free(reader);
    assert_int_equal(dup2(kept, STDIN_FILENO), STDIN_FILENO);
    close(kept);
}

/* What is appended once reading has begun is not read; where the file becomes shorter it ends. */
static void test_changing_file(void **state)
{
    const fixture *f = *state;
    char path[80];
    snprintf(path, sizeof path, "%s.changing", f->path);
    FILE *file = fopen(path, "wb");
    fputs("8' single - empty\n4' single - empty\n", file);
    fflush(file);
    tn_plan_reader *reader = open_reader(f, path);
    uint64_t total = tn_plan_reader_share(reader);
    fputs("8' single - empty\n", file);
    fflush(file);
    for (int shorter = 0; shorter < 2; shorter++) {
        events apart = {.count = 0};
        if (shorter)
            assert_int_equal(ftruncate(fileno(file), 10), 0);
        read_stretches(reader, total, 5, &apart);
        assert_int_equal(apart.count, 2 - shorter);
        assert_int_equal(apart.items[0].code, shorter ? 601 : 0);
    }
    tn_plan_reader_free(reader);
    fclose(file);
    unlink(path);
}

/* A pipe is not shared, nor is what is no text, nor what is empty. */
static void test_not_shared(void **state)
{
    const fixture *f = *state;
    char path[80];
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    assert_int_equal(write(ends[1], "4' single - empty\n", 18), 18);
    close(ends[1]);
    snprintf(path, sizeof path, "/proc/self/fd/%d", ends[0]);
    tn_plan_reader *reader = open_reader(f, path);
    assert_int_equal(tn_plan_reader_share(reader), 0);
    events rest = {.count = 0};
    read_through(reader, &rest);
    assert_int_equal(rest.count, 1);
    tn_plan_reader_free(reader);
    close(ends[0]);
    reader = open_reader(f, "/dev/null");
    assert_int_equal(tn_plan_reader_share(reader), 0);
    tn_plan_reader_free(reader);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_stretches),
        cmocka_unit_test(test_standard_input),
        cmocka_unit_test(test_changing_file),
        cmocka_unit_test(test_not_shared),
    };
    return cmocka_run_group_tests(tests, open_fixture, close_fixture);
}
