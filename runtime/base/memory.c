/* Reads how much memory is free and used: /proc/meminfo, /proc/self/statm, and the files of control groups. WebAssembly
 * has one memory, which grows up to a bound that it was linked with. */
#include "runtime/base/memory.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#ifdef __EMSCRIPTEN__
#include <emscripten/heap.h>

/* Up to the end of what was ever allocated: what is free below that may be in pieces. */
uint64_t tn_memory_used(void)
{
    return (uintptr_t)sbrk(0);
}

uint64_t tn_memory_available(const char *root)
{
    (void)root;
    return (uint64_t)emscripten_get_heap_max() - tn_memory_used();
}

bool tn_memory_can_have(uint64_t bytes)
{
    return bytes <= tn_memory_available("");
}

#else
#include <sys/mman.h>
#include <sys/resource.h>

enum { PATH_ROOM = 4096, LINE_ROOM = 4352 };

static uint64_t smaller(uint64_t a, uint64_t b)
{
    return a < b ? a : b;
}

static uint64_t less(uint64_t whole, uint64_t part)
{
    return whole > part ? whole - part : 0;
}

/* ---- files of a number, and of names with numbers */

/* The number that follows `name` at the start of a line; an empty name: that the file begins with. False if there is
 * none, as in a limit that is "max". */
static bool read_number(const char *path, const char *name, uint64_t *number)
{
    char line[LINE_ROOM];
    bool found = false;
    size_t length = strlen(name);
    FILE *in = fopen(path, "re");
    while (in && !found && fgets(line, sizeof line, in))
        found = strncmp(line, name, length) == 0 && sscanf(line + length, "%" SCNu64, number) == 1;
    if (in)
        fclose(in);
    return found;
}

/* ---- control groups */

/* What the files of a version are called, below the folder of a group. */
typedef struct group_files {
    const char *mount; /* where groups are, below the root */
    const char *limit, *usage;
    const char *cache; /* in memory.stat: what the system takes back by itself */
} group_files;

static const group_files version_1 = {"/sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.usage_in_bytes",
                                      "total_inactive_file "},
                         version_2 = {"/sys/fs/cgroup", "memory.max", "memory.current", "inactive_file "};

/* What the limit of the group in a folder leaves. */
static uint64_t left_in_folder(const group_files *files, const char *folder)
{
    char path[PATH_ROOM + 64];
    uint64_t limit, usage, cache = 0;
    snprintf(path, sizeof path, "%s/%s", folder, files->limit);
    if (!read_number(path, "", &limit))
        return TN_MEMORY_UNKNOWN;
    snprintf(path, sizeof path, "%s/%s", folder, files->usage);
    if (!read_number(path, "", &usage))
        return TN_MEMORY_UNKNOWN;
    snprintf(path, sizeof path, "%s/memory.stat", folder);
    read_number(path, files->cache, &cache);
    return less(limit, less(usage, cache));
}

/* What the limits of a group and of those around it leave. In a container the group's own folder may lie elsewhere:
 * then the mount is the group. */
static uint64_t left_in_group(const char *root, const group_files *files, const char *group)
{
    char folder[PATH_ROOM];
    size_t mount = (size_t)snprintf(folder, sizeof folder, "%s%s", root, files->mount);
    int length = snprintf(folder, sizeof folder, "%s%s%s", root, files->mount, group);
    if (length < 0 || (size_t)length >= sizeof folder)
        return TN_MEMORY_UNKNOWN;
    uint64_t left = TN_MEMORY_UNKNOWN;
    for (;;) {
        left = smaller(left, left_in_folder(files, folder));
        char *end = strrchr(folder + mount, '/');
        if (!end)
            return left;
        *end = '\0';
    }
}

/* Lines are NUMBER:CONTROLLERS:GROUP; version 2 has one line, "0::GROUP". */
static uint64_t left_in_groups(const char *root)
{
    char path[PATH_ROOM], line[LINE_ROOM];
    uint64_t left = TN_MEMORY_UNKNOWN;
    snprintf(path, sizeof path, "%s/proc/self/cgroup", root);
    FILE *in = fopen(path, "re");
    while (in && fgets(line, sizeof line, in)) {
        char *controllers = strchr(line, ':'), *group = controllers ? strchr(controllers + 1, ':') : NULL;
        if (!group)
            continue;
        *group++ = '\0';
        group[strcspn(group, "\n")] = '\0';
        if (!controllers[1])
            left = smaller(left, left_in_group(root, &version_2, group));
        else if (strstr(controllers, "memory"))
            left = smaller(left, left_in_group(root, &version_1, group));
    }
    if (in)
        fclose(in);
    return left;
}

/* ---- the process */

/* Pages: all that it has mapped, what of that is in memory, what of that is shared with a file or a process, and what
 * it can write. */
static bool read_pages(uint64_t *mapped, uint64_t *resident, uint64_t *shared, uint64_t *data)
{
    FILE *in = fopen("/proc/self/statm", "re");
    bool read =
        in && fscanf(in, "%" SCNu64 "%" SCNu64 "%" SCNu64 "%*u%*u%" SCNu64, mapped, resident, shared, data) == 4;
    if (in)
        fclose(in);
    return read;
}

static uint64_t page_size(void)
{
    long size = sysconf(_SC_PAGESIZE);
    return size > 0 ? (uint64_t)size : 4096;
}

uint64_t tn_memory_used(void)
{
    uint64_t mapped, resident, shared, data;
    return read_pages(&mapped, &resident, &shared, &data) ? less(resident, shared) * page_size() : 0;
}

static uint64_t left_of_limit(int kind, uint64_t pages)
{
    struct rlimit limit;
    if (getrlimit(kind, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return TN_MEMORY_UNKNOWN;
    return less(limit.rlim_cur, pages * page_size());
}

static uint64_t left_of_limits(void)
{
    uint64_t mapped, resident, shared, data;
    if (!read_pages(&mapped, &resident, &shared, &data))
        return TN_MEMORY_UNKNOWN;
    return smaller(left_of_limit(RLIMIT_AS, mapped), left_of_limit(RLIMIT_DATA, data));
}

uint64_t tn_memory_available(const char *root)
{
    char path[PATH_ROOM];
    uint64_t kilobytes, free_now = TN_MEMORY_UNKNOWN;
    snprintf(path, sizeof path, "%s/proc/meminfo", root);
    if (read_number(path, "MemAvailable:", &kilobytes))
        free_now = kilobytes << 10;
    return smaller(smaller(free_now, left_in_groups(root)), left_of_limits());
}

bool tn_memory_can_have(uint64_t bytes)
{
    if (bytes == 0)
        return true;
    if (bytes > PTRDIFF_MAX)
        return false;
    void *piece = mmap(NULL, (size_t)bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (piece == MAP_FAILED)
        return false;
    munmap(piece, (size_t)bytes);
    return true;
}

#endif

void tn_memory_write(uint64_t bytes, char text[32])
{
    if (bytes < UINT64_C(10) << 30)
        snprintf(text, 32, "%" PRIu64 " MB", (bytes >> 20) + (bytes % (1 << 20) > 0));
    else
        snprintf(text, 32, "%" PRIu64 " GB", bytes >> 30);
}
