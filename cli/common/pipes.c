/* Names the pipes that a command waits for. */
#include "cli/common/pipes.h"

#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/common/interrupt.h"
#include "runtime/base/utf8.h"

enum { PATIENCE_MS = 1000, PART_MS = 50 };

/* Does anything come within the second? It is not read here: the command reads the pipe by an end of its own. Keep our
 * end open: closing the last reader loses what was written. */
static bool comes(const char *path)
{
    int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    struct pollfd waited = {.fd = file, .events = POLLIN};
    bool came = file < 0;
    for (int waiting = 0; !came && waiting < PATIENCE_MS && !tn_interrupted(); waiting += PART_MS)
        came = poll(&waited, 1, PART_MS) > 0;
    return came;
}

void tn_pipes_announce(const tn_settings *settings)
{
    for (size_t i = 0; isatty(STDERR_FILENO) && i < settings->operands.count; i++) {
        const char *path = settings->operands.items[i];
        struct stat known;
        if (stat(path, &known) != 0 || !S_ISFIFO(known.st_mode) || comes(path) || tn_interrupted())
            continue;
        fputs("note: waiting for somebody to write to the pipe ", stderr);
        tn_write_clean(stderr, path, strlen(path));
        fputc('\n', stderr);
    }
}
