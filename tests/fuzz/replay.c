/* Runs a fuzz target on files: replay FOLDER|FILE... Folders are read one level deep; at least one file must be found.
 */
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

#include "runtime/base/file.h"
#include "tests/fuzz/fuzz.h"

static size_t replayed;

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

int main(int argc, char **argv)
{
    for (int i = 1; i < argc; i++)
        replay(argv[i]);
    printf("%zu inputs\n", replayed);
    return replayed == 0;
}
