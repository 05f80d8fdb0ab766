/* Files: reading with a limit; writing that replaces the target whole or not at all. */
#include <dirent.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "runtime/base/file.h"

typedef struct folder {
    char path[64];
    char file[96]; /* a name in it */
} folder;

static int make_folder(void **state)
{
    folder *f = calloc(1, sizeof *f);
    strcpy(f->path, "/tmp/tartan-test-XXXXXX");
    if (!f || !mkdtemp(f->path))
        return -1;
    snprintf(f->file, sizeof f->file, "%s/target", f->path);
    *state = f;
    return 0;
}

static size_t entries(const folder *f)
{
    size_t count = 0;
    DIR *directory = opendir(f->path);
    while (readdir(directory))
        count++;
    closedir(directory);
    return count - 2;
}

static int remove_folder(void **state)
{
    folder *f = *state;
    char command[128];
    snprintf(command, sizeof command, "rm -rf '%s'", f->path);
    int result = system(command);
    free(f);
    return result;
}

static void write_text(const char *path, const char *text)
{
    tn_output output;
    tn_error error;
    assert_int_equal(tn_output_open(path, &output, &error), TN_OK);
    fputs(text, output.stream);
    assert_int_equal(tn_output_commit(&output, &error), TN_OK);
    tn_output_discard(&output); /* harmless */
}

static void expect_text(const char *path, const char *wanted)
{
    uint8_t *bytes;
    size_t size;
    assert_int_equal(tn_file_read(path, 1 << 20, &bytes, &size, NULL), TN_OK);
    assert_int_equal(size, strlen(wanted));
    assert_string_equal((char *)bytes, wanted); /* a zero byte follows */
    free(bytes);
}

static void test_write_and_read(void **state)
{
    folder *f = *state;
    write_text(f->file, "first");
    expect_text(f->file, "first");
    write_text(f->file, "");
    expect_text(f->file, "");
    write_text(f->file, "second");
    expect_text(f->file, "second");
    assert_int_equal(entries(f), 1); /* no temporary file stays */
}

static void test_target_stays_until_commit(void **state)
{
    folder *f = *state;
    write_text(f->file, "old");
    tn_output output;
    assert_int_equal(tn_output_open(f->file, &output, NULL), TN_OK);
    fputs("new", output.stream);
    fflush(output.stream);
    expect_text(f->file, "old");
    tn_output_discard(&output);
    expect_text(f->file, "old");
    assert_int_equal(entries(f), 1);
}

static void test_two_at_once(void **state)
{
    folder *f = *state;
    tn_output first, second;
    assert_int_equal(tn_output_open(f->file, &first, NULL), TN_OK);
    assert_int_equal(tn_output_open(f->file, &second, NULL), TN_OK);
    fputs("first", first.stream);
    fputs("second", second.stream);
    assert_int_equal(tn_output_commit(&second, NULL), TN_OK);
    expect_text(f->file, "second");
    assert_int_equal(tn_output_commit(&first, NULL), TN_OK);
    expect_text(f->file, "first");
    assert_int_equal(entries(f), 1);
}

static void test_modes_and_links_are_kept(void **state)
{
    folder *f = *state;
    char link[96];
    struct stat known;
    write_text(f->file, "old");
    assert_int_equal(chmod(f->file, 0640), 0);
    snprintf(link, sizeof link, "%s/link", f->path);
    assert_int_equal(symlink("target", link), 0);
    write_text(link, "new");
    expect_text(f->file, "new");
    assert_int_equal(lstat(link, &known), 0);
    assert_true(S_ISLNK(known.st_mode));
    assert_int_equal(stat(f->file, &known), 0);
    assert_int_equal(known.st_mode & 0777, 0640);
}

static void write_much(tn_output *output)
{
    for (int i = 0; i < 1000000; i++)
        fputc('x', output->stream);
}

static void test_full_disk(void **state)
{
    (void)state;
    tn_output output;
    tn_error error;
    assert_int_equal(tn_output_open("/dev/full", &output, &error), TN_OK);
    fputs("something", output.stream);
    assert_int_equal(tn_output_commit(&output, &error), TN_IO);
    assert_int_equal(error.code, 902);
    assert_string_equal(error.message, "cannot write /dev/full: the disk is full");
    /* the same where writing failed long before the end */
    assert_int_equal(tn_output_open("/dev/full", &output, &error), TN_OK);
    write_much(&output);
    assert_int_equal(tn_output_commit(&output, &error), TN_IO);
    assert_string_equal(error.message, "cannot write /dev/full: the disk is full");
}

static void test_devices_are_written_to(void **state)
{
    (void)state;
    write_text("/dev/null", "gone");
    struct stat known;
    assert_int_equal(stat("/dev/null", &known), 0);
    assert_true(S_ISCHR(known.st_mode));
}

static void test_closed_pipe(void **state)
{
    folder *f = *state;
    int ends[2];
    char path[64];
    tn_output output;
    tn_error error;
    (void)f;
    assert_int_equal(pipe(ends), 0);
    snprintf(path, sizeof path, "/proc/self/fd/%d", ends[1]);
    assert_int_equal(tn_output_open(path, &output, &error), TN_OK);
    close(ends[0]);
    fputs("nobody reads", output.stream);
    assert_int_equal(tn_output_commit(&output, &error), TN_IO);
    assert_int_equal(error.code, 903);
    close(ends[1]);
    assert_int_equal(pipe(ends), 0);
    snprintf(path, sizeof path, "/proc/self/fd/%d", ends[1]);
    assert_int_equal(tn_output_open(path, &output, &error), TN_OK);
    close(ends[0]);
    write_much(&output);
    assert_true(ferror(output.stream));
    assert_int_equal(tn_output_commit(&output, &error), TN_IO);
    assert_int_equal(error.code, 903);
    close(ends[1]);
}

static void test_unwritable(void **state)
{
    folder *f = *state;
    tn_output output;
    tn_error error;
    char path[128];
    snprintf(path, sizeof path, "%s/no/such/folder", f->path);
    assert_int_equal(tn_output_open(path, &output, &error), TN_IO);
    assert_int_equal(error.code, 902);
    assert_non_null(strstr(error.message, "its folder is not there"));
    assert_int_equal(tn_output_open(f->path, &output, &error), TN_IO); /* a folder */
    assert_int_equal(error.code, 902);
}

static void test_unreadable(void **state)
{
    folder *f = *state;
    uint8_t *bytes;
    size_t size;
    tn_error error;
    assert_int_equal(tn_file_read(f->file, 100, &bytes, &size, &error), TN_IO);
    assert_int_equal(error.code, 901);
    assert_null(bytes);
    assert_int_equal(tn_file_read(f->path, 100, &bytes, &size, &error), TN_IO);
    assert_non_null(strstr(error.message, "it is a folder"));
}

static void test_limit(void **state)
{
    folder *f = *state;
    uint8_t *bytes;
    size_t size;
    tn_error error;
    write_text(f->file, "12345");
    assert_int_equal(tn_file_read(f->file, 5, &bytes, &size, &error), TN_OK);
    free(bytes);
    assert_int_equal(tn_file_read(f->file, 4, &bytes, &size, &error), TN_LIMIT);
    assert_int_equal(error.code, 804);
    assert_int_equal(tn_file_read("/dev/zero", 1 << 20, &bytes, &size, &error), TN_LIMIT); /* endless */
}

static void test_longest_name(void **state)
{
    folder *f = *state;
    char path[64 + 256];
    size_t size = (size_t)snprintf(path, sizeof path, "%s/", f->path);
    memset(path + size, 'n', 255); /* as long as a name can be */
    path[size + 255] = '\0';
    write_text(path, "text");
    expect_text(path, "text");
}

/* Sizes around those at which the memory grows. */
static void test_large_files(void **state)
{
    folder *f = *state;
    static const size_t sizes[] = {65534, 65535, 65536, 131071, 131072, 1000003};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        tn_output output;
        assert_int_equal(tn_output_open(f->file, &output, NULL), TN_OK);
        for (size_t k = 0; k < sizes[i]; k++)
            fputc((int)(k % 251), output.stream);
        assert_int_equal(tn_output_commit(&output, NULL), TN_OK);
        uint8_t *bytes;
        size_t size;
        assert_int_equal(tn_file_read(f->file, 1 << 20, &bytes, &size, NULL), TN_OK);
        assert_int_equal(size, sizes[i]);
        for (size_t k = 0; k < size; k++)
            assert_int_equal(bytes[k], k % 251);
        assert_int_equal(bytes[size], 0);
        free(bytes);
    }
}

/* ---- what is written is seen */

static void collect(void *context, const void *bytes, size_t size)
{
    fwrite(bytes, 1, size, context);
}

static void test_seen_while_written(void **state)
{
    const folder *f = *state;
    char *seen = NULL;
    uint8_t *read = NULL;
    size_t seen_size = 0, read_size = 0;
    tn_error error;
    tn_output output;
    FILE *copy = open_memstream(&seen, &seen_size);
    const tn_seen_bytes what = {collect, copy};
    assert_int_equal(tn_output_open_seen(f->file, &what, &output, &error), TN_OK);
    for (unsigned i = 0; i < 30000; i++)
        fprintf(output.stream, "line %u\n", i);
    assert_int_equal(tn_output_commit(&output, &error), TN_OK);
    fclose(copy);
    assert_int_equal(tn_file_read(f->file, 1 << 20, &read, &read_size, &error), TN_OK);
    assert_int_equal(read_size, seen_size);
    assert_memory_equal(read, seen, seen_size);
    free(seen);
    free(read);
    assert_int_equal(entries(f), 1);
}

/* What was not written was not seen: here the disk is full. */
static void test_not_seen_where_not_written(void **state)
{
    (void)state;
    size_t count = 0;
    char *seen = NULL;
    tn_error error;
    tn_output output;
    FILE *copy = open_memstream(&seen, &count);
    const tn_seen_bytes what = {collect, copy};
    assert_int_equal(tn_output_open_seen("/dev/full", &what, &output, &error), TN_OK);
    fputs("text", output.stream);
    assert_int_equal(tn_output_commit(&output, &error), TN_IO);
    assert_string_equal(error.message, "cannot write /dev/full: the disk is full");
    fclose(copy);
    assert_int_equal(count, 0);
    free(seen);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, make_folder, remove_folder)

int main(void)
{
    signal(SIGPIPE, SIG_IGN);
    const struct CMUnitTest tests[] = {
        TEST(test_write_and_read),     TEST(test_target_stays_until_commit),
        TEST(test_two_at_once),        TEST(test_modes_and_links_are_kept),
        TEST(test_full_disk),          TEST(test_devices_are_written_to),
        TEST(test_closed_pipe),        TEST(test_unwritable),
        TEST(test_unreadable),         TEST(test_limit),
        TEST(test_longest_name),       TEST(test_large_files),
        TEST(test_seen_while_written), TEST(test_not_seen_where_not_written),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
