/* Shard sets without memory: each allocation of an operation fails once, and then once together with all after it. The
 * operation says so, leaves nothing half there, and works again. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "driver/shards/gather.h"
#include "driver/shards/manifest.h"
#include "driver/shards/run.h"
#include "tests/support/failing_memory.h"

#define RULES TARTAN_SOURCE_DIR "/tests/cli/files/sheds.plan"

typedef struct trial {
    char folder[40];
    tn_opened opened;
    tn_ready_library ready;
    tn_shard_set set;
    tn_buffer text; /* of its manifest */
    char *output;
} trial;

typedef tn_status operation(trial *t, tn_error *error);

static void expect_robust(operation *operate, void (*again)(trial *t), trial *t)
{
    for (int all_after = 0; all_after < 2; all_after++) {
        for (size_t number = 0;; number++) {
            tn_error error;
            fail_allocation(number, all_after);
            tn_status status = operate(t, &error);
            bool reached = stop_failing() > number;
            if (reached && status != TN_OK) {
                assert_int_equal(status, TN_MEMORY);
                assert_int_equal(error.code, 801);
            } else {
                assert_int_equal(status, TN_OK); /* what failed was not needed: a claim's words, a buffer of stdio */
            }
            again(t);
            if (!reached) {
                assert_true(number > 0); /* it allocates, or the test tests nothing */
                break;
            }
        }
    }
}

/* ---- operations */

static tn_status divide(trial *t, tn_error *error)
{
    tn_shard_set set = {0};
    (void)t;
    mpz_t from, to; /* small numbers: GMP ends the program where it has no memory for large ones */
    mpz_init(from);
    mpz_init_set_ui(to, 1000);
    tn_status status = tn_shard_set_divide(&set, from, to, 7, 0, error);
    tn_shard_set_clear(&set);
    mpz_clears(from, to, NULL);
    return status;
}

static tn_status write_manifest(trial *t, tn_error *error)
{
    char hash[33];
    tn_buffer text = {0};
    bool written = tn_manifest_write(&t->set, &text, hash);
    free(text.data);
    return written ? TN_OK : tn_fail_memory(error);
}

static tn_status read_set(trial *t, tn_error *error)
{
    tn_shard_set set;
    tn_status status = tn_shard_set_read(t->folder, &set, error);
    tn_shard_set_clear(&set);
    return status;
}

static tn_status write_set(trial *t, tn_error *error)
{
    tn_shards_done done;
    const tn_shards_job job = {
        .set = &t->set, .opened = &t->opened, .ready = &t->ready, .end = t->set.count, .threads = 1, .stale = 60};
    return tn_shards_run(&job, &done, error);
}

static tn_status gather(trial *t, tn_error *error)
{
    const tn_gathering gathering = {
        .set = &t->set, .opened = &t->opened, .ready = &t->ready, .output = t->output, .format = t->set.format};
    return tn_shards_gather(&gathering, error);
}

/* ---- between them */

static void nothing(trial *t)
{
    (void)t;
}

static void remove_shards(trial *t)
{
    for (uint32_t i = 0; i < t->set.count; i++) {
        char *path = tn_shard_path(&t->set, i, "");
        unlink(path);
        free(path);
    }
}

/* What was written is whole; then all of it goes. */
static void check_and_remove(trial *t)
{
    tn_error error;
    assert_int_equal(tn_shards_no_strangers(&t->set, &error), TN_OK);
    for (uint32_t i = 0; i < t->set.count; i++) {
        char *path = tn_shard_path(&t->set, i, "");
        if (access(path, F_OK) == 0)
            assert_int_equal(tn_shard_check(&t->set, &t->ready, i, NULL, &error), TN_OK);
        free(path);
        const char *const endings[] = {".record", ".claim"};
        for (size_t e = 0; e < 2; e++) {
            path = tn_shard_path(&t->set, i, endings[e]);
            assert_true(e == 0 || access(path, F_OK) != 0);
            unlink(path);
            free(path);
        }
    }
    remove_shards(t);
}

static void test_all(void **state)
{
    (void)state;
    tn_error error;
    trial t = {.folder = "/tmp/tartan-memory-XXXXXX"};
    char command[80];
    mpz_t from, to;
    assert_non_null(mkdtemp(t.folder));
    assert_int_equal(tn_open(RULES, false, &t.opened), TN_OK);
    tn_library_options options = {.override_trays = true, .trays_max = 4, .threads = 1};
    assert_int_equal(tn_library_ready(&t.opened, "any-sheds", &options, &t.ready), TN_OK);
    t.set = (tn_shard_set){.folder = strdup(t.folder),
                           .library = strdup("any-sheds"),
                           .rules_path = strdup("sheds.plan"),
                           .command = strdup("enumerate"),
                           .format = TN_FORMAT_BIN,
                           .compressed = true,
                           .options = {.override_trays = true, .trays_max = 4}};
    memset(t.set.library_hash, '0', 32);
    memset(t.set.schema_hash, '0', 16);
    mpz_init(from);
    mpz_init_set_ui(to, 300);
    assert_int_equal(tn_shard_set_divide(&t.set, from, to, 2, 0, &error), TN_OK);
    assert_int_equal(tn_shard_set_create(&t.set, t.opened.compilation.module, t.opened.compilation.module_size, &error),
                     TN_OK);
    assert_true(asprintf(&t.output, "%s/whole", t.folder) > 0);
    expect_robust(divide, nothing, &t);
    expect_robust(write_manifest, nothing, &t);
    expect_robust(read_set, nothing, &t);
    expect_robust(write_set, check_and_remove, &t);
    assert_int_equal(write_set(&t, &error), TN_OK);
    expect_robust(gather, nothing, &t);
    tn_library_close(&t.ready);
    tn_close(&t.opened);
    tn_shard_set_clear(&t.set);
    free(t.output);
    mpz_clears(from, to, NULL);
    snprintf(command, sizeof command, "rm -rf '%s'", t.folder);
    assert_int_equal(system(command), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_all)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
