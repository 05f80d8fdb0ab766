/* Shard sets: dividing ranks, manifests that are read as they were written and refused when a byte differs, claims,
 * records, and sets that several ranks write. */
#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "driver/shards/gather.h"
#include "driver/shards/hash.h"
#include "driver/shards/manifest.h"
#include "driver/shards/record.h"
#include "driver/shards/run.h"
#include "runtime/base/file.h"
#include "tests/support/test_ranks.h"

#define RULES TARTAN_SOURCE_DIR "/tests/cli/files/sheds.plan"
#define PLANS 1365u /* of any-sheds with at most five trays */

/* ---- a folder for each test */

/* In memory where that can be: each shard is flushed to the disk four times. */
static int make_folder(void **state)
{
    char path[40];
    bool memory = access("/dev/shm", W_OK) == 0;
    snprintf(path, sizeof path, "%s/tartan-shards-XXXXXX", memory ? "/dev/shm" : "/tmp");
    *state = mkdtemp(path) ? strdup(path) : NULL;
    return *state ? 0 : -1;
}

static int remove_folder(void **state)
{
    char command[80];
    snprintf(command, sizeof command, "rm -rf '%s'", (char *)*state);
    int status = system(command);
    free(*state);
    return status;
}

static char *in_folder(void **state, const char *name)
{
    char *path;
    assert_true(asprintf(&path, "%s/%s", (char *)*state, name) > 0);
    return path;
}

/* ---- dividing */

static void divide(uint64_t from, uint64_t to, uint64_t shards, uint64_t plans, tn_shard_set *set, tn_status wanted)
{
    mpz_t a, b;
    tn_error error;
    mpz_init_set_ui(a, from);
    mpz_init_set_ui(b, to);
    *set = (tn_shard_set){0};
    assert_int_equal(tn_shard_set_divide(set, a, b, shards, plans, &error), wanted);
    if (wanted == TN_LIMIT)
        assert_int_equal(error.code, E_SHARD_TOO_MANY);
    mpz_clears(a, b, NULL);
}

static void test_divide(void **state)
{
    (void)state;
    tn_shard_set set;
    for (uint64_t plans = 0; plans < 40; plans++) {
        for (uint64_t shards = 1; shards < 50; shards++) {
            divide(7, 7 + plans, shards, 0, &set, TN_OK);
            assert_int_equal(set.count, plans == 0 ? 1 : plans < shards ? plans : shards);
            assert_int_equal(mpz_get_ui(set.bounds[0]), 7);
            assert_int_equal(mpz_get_ui(set.bounds[set.count]), 7 + plans);
            for (uint32_t i = 0; i < set.count; i++) {
                uint64_t size = mpz_get_ui(set.bounds[i + 1]) - mpz_get_ui(set.bounds[i]);
                assert_true(size == plans / set.count || size == plans / set.count + 1);
            }
            tn_shard_set_clear(&set);
            divide(7, 7 + plans, 0, shards, &set, TN_OK);
            assert_int_equal(set.count, plans == 0 ? 1 : (plans + shards - 1) / shards);
            for (uint32_t i = 0; plans && i < set.count; i++)
                assert_int_equal(mpz_get_ui(set.bounds[i]), 7 + i * shards);
            assert_int_equal(mpz_get_ui(set.bounds[set.count]), 7 + plans);
            tn_shard_set_clear(&set);
        }
    }
    divide(0, 100001, 0, 1, &set, TN_LIMIT);
    tn_shard_set_clear(&set);
    divide(0, 5, 1000000000, 0, &set, TN_LIMIT);
    tn_shard_set_clear(&set);
}

/* ---- manifests */

static tn_shard_set example(void)
{
    tn_shard_set set = {.folder = strdup("set"),
                        .version = strdup("1.2.3"),
                        .library = strdup("a \"name\" with \\ and \n"),
                        .rules_path = strdup("rules/ä.plan"),
                        .command = strdup("enumerate --trays 0..5"),
                        .format = TN_FORMAT_BIN,
                        .compressed = true,
                        .options = {.override_trays = true, .trays_max = 5, .max_states = 77},
                        .count = 2};
    memset(set.module_hash, 'a', 32);
    memset(set.library_hash, '0', 32);
    memset(set.schema_hash, '7', 16);
    set.bounds = calloc(3, sizeof *set.bounds);
    mpz_init_set_str(set.bounds[0], "1000000000000000000000000000000", 10);
    mpz_init_set_str(set.bounds[1], "1000000000000000000000000000007", 10);
    mpz_init_set_str(set.bounds[2], "2000000000000000000000000000000", 10);
    return set;
}

static tn_status read_text(const char *text, size_t size, tn_shard_set *set)
{
    tn_error error;
    *set = (tn_shard_set){.folder = strdup("set")};
    tn_status status = tn_manifest_read(text, size, set, &error);
    if (status == TN_INVALID)
        assert_true(error.code == E_SHARD_MANIFEST || error.code == E_SHARD_VERSION);
    return status;
}

static void test_manifest(void **state)
{
    (void)state;
    tn_shard_set set = example(), again;
    tn_buffer text = {0}, second = {0};
    char hash[33];
    assert_true(tn_manifest_write(&set, &text, hash));
    assert_int_equal(read_text(text.data, text.size, &again), TN_OK);
    assert_string_equal(again.hash, hash);
    assert_string_equal(again.library, set.library);
    assert_string_equal(again.rules_path, set.rules_path);
    assert_true(again.compressed && again.options.override_trays);
    assert_int_equal(again.options.max_states, 77);
    assert_int_equal(mpz_cmp(again.bounds[1], set.bounds[1]), 0);
    assert_true(tn_manifest_write(&again, &second, hash));
    assert_int_equal(text.size, second.size);
    assert_memory_equal(text.data, second.data, text.size);
    tn_shard_set_clear(&again);
    for (size_t i = 0; i < text.size; i++) { /* one byte that differs, and a text that ends there */
        text.data[i] ^= 1;
        assert_int_equal(read_text(text.data, text.size, &again), TN_INVALID);
        tn_shard_set_clear(&again);
        text.data[i] ^= 1;
        assert_int_equal(read_text(text.data, i, &again), TN_INVALID);
        tn_shard_set_clear(&again);
    }
    tn_shard_set_clear(&set);
    free(text.data);
    free(second.data);
}

static void test_hash(void **state)
{
    char *path = in_folder(state, "file"), hex[33], other[33];
    uint8_t bytes[200000];
    uint64_t size;
    tn_error error;
    for (size_t i = 0; i < sizeof bytes; i++)
        bytes[i] = (uint8_t)(i * 31 % 251);
    FILE *out = fopen(path, "wb");
    assert_int_equal(fwrite(bytes, 1, sizeof bytes, out), sizeof bytes);
    fclose(out);
    tn_hash_bytes(bytes, sizeof bytes, hex);
    assert_int_equal(tn_hash_file(path, other, &size, &error), TN_OK);
    assert_string_equal(hex, other);
    assert_int_equal(size, sizeof bytes);
    assert_int_equal(tn_hash_file("/nowhere", other, &size, &error), TN_IO);
    free(path);
}

/* ---- claims */

static void test_claims(void **state)
{
    char *path = in_folder(state, "claim");
    tn_claim claim, second;
    tn_claimant who;
    const tn_claimant self = tn_claimant_self();
    tn_error error;
    bool taken;
    assert_false(tn_claim_read(path, &who));
    assert_int_equal(tn_claim_take(path, &self, 60, &claim, &taken, &error), TN_OK);
    assert_true(taken);
    assert_true(tn_claim_read(path, &who));
    assert_int_equal(who.process, getpid());
    tn_claim_release(&claim);
    assert_false(tn_claim_read(path, &who));
    FILE *out = fopen(path, "w"); /* of another machine */
    fputs("{\"host\": \"elsewhere\", \"boot\": \"b\", \"space\": \"s\", \"process\": 17}", out);
    fclose(out);
    assert_int_equal(tn_claim_take(path, &self, 60, &second, &taken, &error), TN_OK);
    assert_false(taken);
    struct timespec hour_ago[2];
    clock_gettime(CLOCK_REALTIME, &hour_ago[0]);
    hour_ago[0].tv_sec -= 3600;
    hour_ago[1] = hour_ago[0];
    utimensat(AT_FDCWD, path, hour_ago, 0);
    assert_int_equal(tn_claim_take(path, &self, 60, &second, &taken, &error), TN_OK); /* stale */
    assert_true(taken);
    tn_claim_release(&second);
    assert_int_equal(tn_claim_take("/nowhere/claim", &self, 60, &second, &taken, &error), TN_IO);
    assert_false(taken);
    free(path);
}

/* ---- sets that are written */

typedef struct written {
    tn_opened opened;
    tn_ready_library ready;
    tn_shard_set set;
    tn_shards_done done[8];
    tn_status status[8];
    tn_error error[8];
    uint32_t begin, end;
} written;

static void make_set(written *w, const char *folder, uint64_t shards, tn_plan_format format)
{
    tn_error error;
    mpz_t from, to;
    *w = (written){0};
    assert_int_equal(tn_open(RULES, false, &w->opened), TN_OK);
    tn_library_options options = {.override_trays = true, .trays_max = 5, .threads = 1};
    assert_int_equal(tn_library_ready(&w->opened, "any-sheds", &options, &w->ready), TN_OK);
    w->set = (tn_shard_set){.folder = strdup(folder),
                            .library = strdup("any-sheds"),
                            .rules_path = strdup("sheds.plan"),
                            .command = strdup("enumerate --trays 0..5"),
                            .format = format,
                            .options = options};
    w->set.options.threads = 0;
    memset(w->set.library_hash, '0', 32);
    memset(w->set.schema_hash, '0', 16);
    mpz_init(from);
    mpz_init_set_ui(to, PLANS);
    assert_int_equal(tn_shard_set_divide(&w->set, from, to, shards, 0, &error), TN_OK);
    const tn_compilation *c = &w->opened.compilation;
    assert_int_equal(tn_shard_set_create(&w->set, c->module, c->module_size, &error), TN_OK);
    assert_int_equal(tn_shard_set_create(&w->set, c->module, c->module_size, &error), TN_INVALID);
    assert_int_equal(error.code, E_SHARD_SET_THERE);
    w->end = w->set.count;
    mpz_clears(from, to, NULL);
}

static void clear(written *w)
{
    tn_library_close(&w->ready);
    tn_close(&w->opened);
    tn_shard_set_clear(&w->set);
}

static void write_set(const tn_ranks *ranks, void *context)
{
    written *w = context;
    unsigned r = ranks->rank;
    const tn_shards_job job = {.set = &w->set,
                               .opened = &w->opened,
                               .ready = &w->ready,
                               .begin = w->begin,
                               .end = w->end,
                               .threads = 1 + r % 2,
                               .stale = 60,
                               .ranks = ranks};
    w->status[r] = tn_shards_run(&job, &w->done[r], &w->error[r]);
}

static void check_all(const written *w)
{
    tn_error error;
    for (uint32_t i = 0; i < w->set.count; i++)
        assert_int_equal(tn_shard_check(&w->set, &w->ready, i, NULL, &error), TN_OK);
    assert_int_equal(tn_shards_complete(&w->set, &error), TN_OK);
    assert_int_equal(tn_shards_no_strangers(&w->set, &error), TN_OK);
}

static void test_ranks(void **state)
{
    for (unsigned ranks = 1; ranks <= 4; ranks++) {
        written w;
        char name[20], *folder;
        snprintf(name, sizeof name, "set%u", ranks);
        folder = in_folder(state, name);
        make_set(&w, folder, 40, ranks % 2 ? TN_FORMAT_BIN : TN_FORMAT_LINES);
        test_ranks_run(ranks, write_set, &w);
        for (unsigned r = 0; r < ranks; r++) {
            assert_int_equal(w.status[r], TN_OK);
            assert_int_equal(w.done[r].written, 40);
        }
        assert_int_equal(w.done[0].left, 0);
        check_all(&w);
        test_ranks_run(ranks, write_set, &w); /* again: nothing to do */
        assert_int_equal(w.done[0].written, 0);
        clear(&w);
        free(folder);
    }
}

/* A shard that cannot be written: the others are, and all ranks say which it was. */
static void test_failure(void **state)
{
    written w;
    tn_error error;
    char *folder = in_folder(state, "set"), *claim, *inner;
    make_set(&w, folder, 1200, TN_FORMAT_BIN); /* in two folders, one of which goes away */
    inner = in_folder(state, "set/shards/001");
    assert_int_equal(rmdir(inner), 0);
    test_ranks_run(3, write_set, &w);
    for (unsigned r = 0; r < 3; r++) {
        assert_int_equal(w.status[r], TN_IO);
        assert_string_equal(w.error[r].message, w.error[0].message);
    }
    assert_int_equal(w.done[0].written, 1000);
    assert_int_equal(w.done[0].left, 200);
    assert_int_equal(tn_shards_complete(&w.set, &error), TN_INVALID);
    assert_int_equal(error.code, E_SHARD_MISSING);
    claim = tn_shard_path(&w.set, 3, TN_SHARD_CLAIM);
    assert_int_not_equal(access(claim, F_OK), 0);
    clear(&w);
    free(claim);
    free(inner);
    free(folder);
}

/* A shard or a record that was changed is found; a shard whose record is missing is written again. */
static void test_damage(void **state)
{
    written w;
    tn_error error;
    tn_shard_record record;
    char *folder = in_folder(state, "set");
    make_set(&w, folder, 3, TN_FORMAT_LINES);
    test_ranks_run(1, write_set, &w);
    char *shard = tn_shard_path(&w.set, 1, ""), *beside = tn_shard_path(&w.set, 1, TN_SHARD_RECORD);
    FILE *out = fopen(shard, "r+");
    fputc('#', out);
    fclose(out);
    assert_int_equal(tn_shard_check(&w.set, &w.ready, 1, NULL, &error), TN_INVALID);
    assert_int_equal(error.code, E_SHARD_WRONG);
    unlink(shard);
    assert_int_equal(tn_shards_complete(&w.set, &error), TN_INVALID);
    test_ranks_run(2, write_set, &w);
    assert_int_equal(w.done[0].written, 1);
    unlink(beside);
    test_ranks_run(2, write_set, &w);
    assert_int_equal(w.done[0].written, 1); /* what nothing says to be of this set */
    assert_int_equal(tn_shard_record_read(&w.set, 1, &record, &error), TN_OK);
    truncate(beside, 10);
    assert_int_equal(tn_shard_record_read(&w.set, 1, &record, &error), TN_INVALID);
    assert_int_equal(error.code, E_SHARD_WRONG);
    clear(&w);
    free(shard);
    free(beside);
    free(folder);
}

/* Two sets with one module: what is put together is what one program writes. */
static void test_gather(void **state)
{
    char *folders[] = {in_folder(state, "one"), in_folder(state, "many")};
    char *files[] = {in_folder(state, "a"), in_folder(state, "b")}, hex[2][33];
    tn_error error;
    for (size_t i = 0; i < 2; i++) {
        written w;
        uint64_t size;
        make_set(&w, folders[i], i == 0 ? 1 : 33, TN_FORMAT_BIN);
        test_ranks_run(2, write_set, &w);
        const tn_gathering gathering = {
            .set = &w.set, .opened = &w.opened, .ready = &w.ready, .output = files[i], .format = TN_FORMAT_BIN};
        assert_int_equal(tn_shards_gather(&gathering, &error), TN_OK);
        assert_int_equal(tn_hash_file(files[i], hex[i], &size, &error), TN_OK);
        clear(&w);
    }
    assert_string_equal(hex[0], hex[1]);
    for (size_t i = 0; i < 2; i++) {
        free(folders[i]);
        free(files[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_divide),
                                       cmocka_unit_test(test_manifest),
                                       cmocka_unit_test_setup_teardown(test_hash, make_folder, remove_folder),
                                       cmocka_unit_test_setup_teardown(test_claims, make_folder, remove_folder),
                                       cmocka_unit_test_setup_teardown(test_ranks, make_folder, remove_folder),
                                       cmocka_unit_test_setup_teardown(test_failure, make_folder, remove_folder),
                                       cmocka_unit_test_setup_teardown(test_damage, make_folder, remove_folder),
                                       cmocka_unit_test_setup_teardown(test_gather, make_folder, remove_folder)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
