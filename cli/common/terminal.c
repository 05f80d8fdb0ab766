/* Puts a filter between what is written to standard output and a terminal. */
#include "cli/common/terminal.h"

#include <stdio.h>

#ifdef __GLIBC__ /* the one C library that we know of in which `stdout` can be another stream */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "runtime/base/utf8.h"

/* The first bytes of a character whose others are in the next write. */
typedef struct half_character {
    char bytes[4];
    size_t size;
} half_character;

static half_character half;

static bool write_all(const char *text, size_t size)
{
    while (size > 0) {
        ssize_t written = write(STDOUT_FILENO, text, size);
        if (written < 0)
            return false;
        text += written;
        size -= (size_t)written;
    }
    return true;
}

/* How many bytes at the end of a text begin a character that is not whole. */
static size_t unfinished(const char *text, size_t size)
{
    for (size_t back = 1; back <= 3 && back <= size; back++) {
        unsigned char byte = (unsigned char)text[size - back];
        if ((byte & 0xC0) == 0x80)
            continue;
        size_t wanted = byte >= 0xF0 ? 4 : byte >= 0xE0 ? 3 : byte >= 0xC0 ? 2 : 1;
        return wanted > back ? back : 0;
    }
    return 0;
}

static ssize_t write_shown(void *cookie, const char *bytes, size_t size)
{
    (void)cookie;
    char *shown = NULL;
    size_t shown_size = 0;
    FILE *out = open_memstream(&shown, &shown_size);
    if (!out)
        return 0;
    char first[8];
    size_t begin = half.size, used = 0;
    memcpy(first, half.bytes, begin);
    while (begin > 0 && used < size && begin + used < 4 && ((unsigned char)bytes[used] & 0xC0) == 0x80) {
        first[begin + used] = bytes[used];
        used++;
    }
    tn_write_shown(out, first, begin + used);
    half.size = unfinished(bytes + used, size - used);
    memcpy(half.bytes, bytes + size - half.size, half.size);
    tn_write_shown(out, bytes + used, size - used - half.size);
    bool written = fclose(out) == 0 && write_all(shown, shown_size);
    free(shown);
    return written ? (ssize_t)size : 0;
}

void tn_terminal_guard(void)
{
    if (!isatty(STDOUT_FILENO))
        return;
    FILE *guarded = fopencookie(NULL, "w", (cookie_io_functions_t){.write = write_shown});
    if (!guarded)
        return;
    setvbuf(guarded, NULL, _IOLBF, 0);
    stdout = guarded;
}
#else
void tn_terminal_guard(void)
{
}
#endif
