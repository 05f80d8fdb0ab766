/* What is free, by made-up machines: meminfo alone, groups of both versions with limits of their own and around them,
 * a group whose folder lies elsewhere; and what a watch makes of a limit. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "runtime/base/memory.h"
#include "runtime/base/watch.h"

#define MB (UINT64_C(1) << 20)

static char root[64];

/* Writes a file of the machine, and the folders that it lies in. */
static void put(const char *path, const char *text)
{
    char full[512];
    snprintf(full, sizeof full, "%s%s", root, path);
    for (char *slash = full + strlen(root) + 1; (slash = strchr(slash, '/')); *slash++ = '/') {
        *slash = '\0';
        mkdir(full, 0777);
    }
    FILE *out = fopen(full, "w");
    assert_non_null(out);
    fputs(text, out);
    assert_int_equal(fclose(out), 0);
}

static int begin(void **state)
{
    (void)state;
    snprintf(root, sizeof root, "/tmp/tartan-memory-XXXXXX");
    if (!mkdtemp(root))
        return 1;
    put("/proc/meminfo", "MemTotal:        8192000 kB\nMemFree:  1024 kB\nMemAvailable:    4096000 kB\n");
    return 0;
}

static int end(void **state)
{
    (void)state;
    char command[128];
    snprintf(command, sizeof command, "rm -rf %s", root);
    return system(command);
}

static void machine_alone(void **state)
{
    (void)state;
    assert_int_equal(tn_memory_available(root), UINT64_C(4096000) << 10);
    put("/proc/self/cgroup", "0::/\n");
    put("/sys/fs/cgroup/memory.max", "max\n");
    put("/sys/fs/cgroup/memory.current", "1000\n");
    assert_int_equal(tn_memory_available(root), UINT64_C(4096000) << 10);
}

static void nothing_is_said(void **state)
{
    (void)state;
    assert_int_equal(tn_memory_available("/nowhere"), TN_MEMORY_UNKNOWN);
}

/* The group leaves 300 MB and what is cached of files, the one around it 200 MB. */
static void groups_of_version_2(void **state)
{
    (void)state;
    put("/proc/self/cgroup", "0::/job/step\n");
    put("/sys/fs/cgroup/job/step/memory.max", "419430400\n");
    put("/sys/fs/cgroup/job/step/memory.current", "157286400\n");
    put("/sys/fs/cgroup/job/step/memory.stat", "anon 100\ninactive_anon 5\ninactive_file 52428800\n");
    assert_int_equal(tn_memory_available(root), 300 * MB);
    put("/sys/fs/cgroup/job/memory.max", "1073741824\n");
    put("/sys/fs/cgroup/job/memory.current", "864026624\n");
    assert_int_equal(tn_memory_available(root), 200 * MB);
    put("/sys/fs/cgroup/job/memory.current", "2000000000\n");
    assert_int_equal(tn_memory_available(root), 0);
}

static void groups_of_version_1(void **state)
{
    (void)state;
    put("/proc/self/cgroup", "5:cpu,cpuacct:/a\n4:memory:/box/42\n0::/\n");
    put("/sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
    put("/sys/fs/cgroup/memory/memory.usage_in_bytes", "1000\n");
    assert_int_equal(tn_memory_available(root), UINT64_C(4096000) << 10);
    put("/sys/fs/cgroup/memory/box/42/memory.limit_in_bytes", "104857600\n");
    put("/sys/fs/cgroup/memory/box/42/memory.usage_in_bytes", "73400320\n");
    put("/sys/fs/cgroup/memory/box/42/memory.stat", "inactive_file 1\ntotal_inactive_file 20971520\n");
    assert_int_equal(tn_memory_available(root), 50 * MB);
}

/* In a container the folder of the group may not be there: its limit is at the mount. */
static void groups_at_the_mount(void **state)
{
    (void)state;
    put("/proc/self/cgroup", "4:memory:/docker/0123456789\n");
    put("/sys/fs/cgroup/memory/memory.limit_in_bytes", "209715200\n");
    put("/sys/fs/cgroup/memory/memory.usage_in_bytes", "104857600\n");
    assert_int_equal(tn_memory_available(root), 100 * MB);
}

static void what_is_used_is_measured(void **state)
{
    (void)state;
    size_t size = 64 * MB;
    uint64_t before = tn_memory_used();
    char *piece = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    assert_true(piece != MAP_FAILED);
    for (size_t i = 0; i < size; i += 4096)
        piece[i] = 1;
    assert_true(tn_memory_used() >= before + 60 * MB);
    munmap(piece, size);
    assert_true(tn_memory_used() < before + 32 * MB);
}

static void a_watch_has_room(void **state)
{
    (void)state;
    tn_error error;
    tn_watch watch = {.memory_limit = tn_memory_used() + 64 * MB};
    assert_int_equal(tn_watch_room(&watch, 32 * MB, "this", &error), TN_OK);
    assert_int_equal(tn_watch_room(&watch, 96 * MB, "this", &error), TN_LIMIT);
    assert_int_equal(error.code, E_MEMORY_LIMIT);
    assert_non_null(strstr(error.message, "this would need about 96 MB more memory"));
    assert_non_null(strstr(error.help, "--memory-limit"));
    assert_int_equal(tn_watch_room(NULL, UINT64_MAX, "this", &error), TN_MEMORY);
    tn_watch_measure(&watch);
    assert_int_equal(tn_watch_check(&watch, &error), TN_OK);
    watch.memory_limit = 1;
    tn_watch_measure(&watch);
    assert_int_equal(tn_watch_check(&watch, &error), TN_STOPPED);
    assert_int_equal(error.code, E_MEMORY_LIMIT);
}

/* By the thread that made it, whoever waits for it. */
static void a_watch_measures_when_asked(void **state)
{
    (void)state;
    tn_watch watch;
    tn_watch_begin(&watch, NULL, NULL);
    assert_false(tn_watch_stopped(&watch));
    watch.memory_limit = 1;
    assert_true(tn_watch_stopped(&watch));
    assert_true(watch.full);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(machine_alone, begin, end),
        cmocka_unit_test(nothing_is_said),
        cmocka_unit_test_setup_teardown(groups_of_version_2, begin, end),
        cmocka_unit_test_setup_teardown(groups_of_version_1, begin, end),
        cmocka_unit_test_setup_teardown(groups_at_the_mount, begin, end),
        cmocka_unit_test(what_is_used_is_measured),
        cmocka_unit_test(a_watch_has_room),
        cmocka_unit_test(a_watch_measures_when_asked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
