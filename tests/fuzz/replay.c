/* Runs a fuzz target on files: replay [-changed=N] [-share=K] [-memory=MEGABYTES] [-keep=FILE] FOLDER|FILE... Folders
 * are read one level deep; at least one file must be found. A target that changes its inputs itself is also run on N
 * changed ones for each file: share K of them, which depend on N and K alone, and no two shares have the same. With
 * -memory the process may not have more of it (which sanitizers do not bear). With -keep each changed input is written
 * to FILE before it is run, so that one that ends the process is there. */
#include <dirent.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "runtime/base/file.h"
#include "tests/fuzz/fuzz.h"

static size_t replayed;

static unsigned changed_count, share, megabytes;
static const char *kept; /* where the input is written that is run */

/* A target that has one. */
__attribute__((weak)) size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed);

static void keep(const uint8_t *bytes, size_t size)
{
    FILE *out = kept ? fopen(kept, "wb") : NULL;
    if (out && (fwrite(bytes, 1, size, out) != size) + fclose(out) == 0)
        return;
    if (kept) {
        perror(kept);
        exit(1);
    }
}

/* Every fourth is made of the file, the others of the one before. */
static void replay_changed(const uint8_t *bytes, size_t size)
{
    size_t room = size * 2 + 4096, now = size;
    uint8_t *changed = malloc(room);
    for (unsigned i = 0; changed && i < changed_count; i++) {
        if (i % 4 == 0) {
            memcpy(changed, bytes, size);
            now = size;
        }
        now = LLVMFuzzerCustomMutator(changed, now, room, share * changed_count + i);
        keep(changed, now);
        LLVMFuzzerTestOneInput(changed, now);
    }
    free(changed);
}

static void replay_file(const char *path)
{
    uint8_t *bytes;
    size_t size;
    tn_error error;
    if (tn_file_read(path, 1u << 24, &bytes, &size, &error) != TN_OK) {
        fprintf(stderr, "%s\n", error.message);
        exit(1);
    }
    /* a copy of exactly that size: reading past the end is then found by the sanitizer */
    uint8_t *exact = malloc(size ? size : 1);
    if (!exact)
        exit(1);
    for (size_t i = 0; i < size; i++)
        exact[i] = bytes[i];
    LLVMFuzzerTestOneInput(exact, size);
    if (LLVMFuzzerCustomMutator)
        replay_changed(exact, size);
    free(exact);
    free(bytes);
    replayed++;
}

static void replay(const char *path)
{
    DIR *folder = opendir(path);
    if (!folder) {
        struct stat status;
        if (stat(path, &status) == 0)
            replay_file(path);
        return;
    }
    for (struct dirent *entry; (entry = readdir(folder));) {
        char file[4096];
        struct stat status;
        snprintf(file, sizeof file, "%s/%s", path, entry->d_name);
        if (entry->d_name[0] != '.' && stat(file, &status) == 0 && S_ISREG(status.st_mode))
            replay_file(file);
    }
    closedir(folder);
}

static void limit_memory(void)
{
    const struct rlimit limit = {(rlim_t)megabytes << 20, (rlim_t)megabytes << 20};
    if (megabytes > 0 && setrlimit(RLIMIT_AS, &limit) != 0) {
        perror("-memory");
        exit(1);
    }
}

static bool is_option(const char *word)
{
    if (strncmp(word, "-keep=", 6) == 0)
        kept = word + 6;
    return sscanf(word, "-changed=%u", &changed_count) == 1 || sscanf(word, "-share=%u", &share) == 1 ||
           sscanf(word, "-memory=%u", &megabytes) == 1 || kept == word + 6;
}

int main(int argc, char **argv)
{
    for (int i = 1; i < argc; i++)
        if (is_option(argv[i]))
            argv[i] = NULL;
    limit_memory();
    for (int i = 1; i < argc; i++)
        if (argv[i])
            replay(argv[i]);
    printf("%zu inputs", replayed);
    if (LLVMFuzzerCustomMutator)
        printf(", %zu made of them", replayed * changed_count);
    printf("\n");
    return replayed == 0;
}
