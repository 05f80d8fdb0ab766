/* Reads a command's options and runs it. */
#include "cli/common/program.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/common/help.h"
#include "cli/common/interrupt.h"
#include "cli/common/job.h"
#include "cli/common/options.h"
#include "runtime/base/utf8.h"

/* ---- names the pipes that a command waits for */

/* Named pipes among a command's operands: opening one waits for whoever writes to it, without a word. */

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

/* For a person at a terminal: waits a second for something to come from each pipe, and says so where nothing does.
 * Nothing is read. */
static void pipes_announce(const tn_settings *settings)
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

/* ---- puts a filter between what is written to standard output and a terminal */

/* Standard output on a terminal: what came from a file does not get to tell the terminal what to do.
 *
 * Files keep their bytes. On a terminal, control characters (but for line ends and tabs), those of C1 and the ones that
 * turn the direction of text are written as escapes, \x1b and \u202e, whatever the command and the format. That is so
 * with GNU's C library; others do not let a program replace its standard output, and nothing is changed there. */

#ifdef __GLIBC__ /* the one C library that we know of in which `stdout` can be another stream */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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

/* To be called once, before anything is written. */
static void terminal_guard(void)
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

/* To be called once, before anything is written. */
static void terminal_guard(void)
{
}
#endif

/* ---- reads a command's options and runs it */

int tn_program_printed(void)
{
    const tn_settings settings = {0};
    tn_job job;
    tn_output output;
    tn_job_begin(&job, &settings);
    if (tn_job_output(&job, NULL, &output))
        tn_job_commit(&job, &output);
    return tn_job_end(&job);
}

int tn_program_refuse(const tn_settings *settings, const tn_error *error)
{
    tn_job job;
    tn_job_begin(&job, settings);
    tn_job_fail(&job, error);
    return tn_job_end(&job);
}

static void watch(const tn_command *command, const tn_settings *settings)
{
    tn_memory_guard_start(command, settings);
    if (command->serves)
        return;
    tn_interrupt_watch(settings->diagnostics == 1);
    const char *output = tn_settings_output(settings);
    if (output && strcmp(output, "-") != 0)
        tn_interrupt_last_words("interrupted; %.400s is not written", output);
    else
        tn_interrupt_last_words("interrupted before the end");
}

/* The library is asked for by its variable, wherever a kit is read. */
static tn_status use_library(const tn_settings *settings, tn_error *error)
{
    struct stat found;
    if (!settings->ldraw)
        return TN_OK;
    if (stat(settings->ldraw, &found) != 0 || !S_ISDIR(found.st_mode)) {
        tn_fail(error, TN_IO, E_CANNOT_READ, "there is no folder %.300s", settings->ldraw);
        tn_error_help(error, "--ldraw is the folder of an LDraw library, which has the folders parts and p");
        return TN_IO;
    }
    return setenv("LDRAWDIR", settings->ldraw, true) == 0 ? TN_OK : tn_fail_memory(error);
}

int tn_program_run(const tn_commands *commands, const tn_command *command, int count, char **words,
                   const tn_ranks *ranks)
{
    tn_settings *settings = tn_settings_new(command);
    if (settings)
        settings->ranks = ranks;
    tn_error error;
    int exit_code;
    tn_status status =
        settings ? tn_options_parse(commands, command, count, words, settings, &error) : tn_fail_memory(&error);
    if (status != TN_OK) {
        const tn_settings common = {.diagnostics = tn_options_diagnostics(count, words), .ranks = ranks};
        exit_code = tn_program_refuse(&common, &error);
    } else if (settings->help) {
        if (tn_ranks_lead(ranks))
            tn_help_command(command, stdout);
        exit_code = tn_program_printed();
    } else if (use_library(settings, &error) != TN_OK) {
        exit_code = tn_program_refuse(settings, &error);
    } else {
        watch(command, settings);
        pipes_announce(settings);
        exit_code = command->run(command, settings);
    }
    tn_settings_free(command, settings);
    return exit_code;
}

/* Standard input, output and error, where they are closed, are not to be the next files that are opened: they become
 * ones that reading and writing fails on. */
static void keep_standard_descriptors(void)
{
    for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++)
        if (fcntl(fd, F_GETFD) < 0 && open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0)
            return;
}

void tn_program_begin(void)
{
    keep_standard_descriptors();
    terminal_guard();
    signal(SIGPIPE, SIG_IGN); /* a closed pipe shows as EPIPE, which commands end on quietly */
    signal(SIGXFSZ, SIG_IGN); /* a file beyond `ulimit -f` shows as EFBIG, an error like that of a full disk */
}
