/* Applies the replacements that diagnostics suggest. */
#include "cli/source/fix.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/common/interrupt.h"
#include "cli/common/line_diff.h"

/* A replacement may uncover another mistake; more rounds than this mean that two of them undo each other. */
enum { ROUNDS_MAX = 20 };

typedef struct fixed_text {
    char *text; /* zero-ended; owned */
    size_t size, fixes;
} fixed_text;

/* The next replacement at or after `from` in the file itself (source 0), as sorted diagnostics have them. */
static const tn_diagnostic *next_fix(const tn_diagnostics *list, size_t from)
{
    const tn_diagnostic *first = NULL;
    for (size_t i = 0; i < list->count; i++) {
        const tn_diagnostic *item = &list->items[i];
        bool own = item->replacement && item->has_span && item->span.file == 0 && item->span.begin >= from;
        if (own && (!first || item->span.begin < first->span.begin))
            first = item;
    }
    return first;
}

/* Puts all replacements in place that do not overlap. False where out of memory. */
static bool apply(const tn_diagnostics *list, const fixed_text *old, fixed_text *made)
{
    *made = (fixed_text){.fixes = old->fixes};
    FILE *out = open_memstream(&made->text, &made->size);
    if (!out)
        return false;
    size_t at = 0;
    for (const tn_diagnostic *fix; (fix = next_fix(list, at)) != NULL;) {
        fwrite(old->text + at, 1, fix->span.begin - at, out);
        fputs(fix->replacement, out);
        at = fix->span.end > fix->span.begin ? fix->span.end : fix->span.begin + 1; /* one insertion at a place */
        if (fix->span.end == fix->span.begin && fix->span.begin < old->size)
            fputc(old->text[fix->span.begin], out);
        made->fixes++;
    }
    if (at < old->size)
        fwrite(old->text + at, 1, old->size - at, out);
    bool failed = ferror(out) != 0;
    if (fclose(out) == 0 && !failed)
        return true;
    free(made->text);
    made->text = NULL;
    return false;
}

/* One round: compiles the text, and applies what is suggested. *more: something was. */
static tn_status improve(const char *path, fixed_text *fixed, bool *more, tn_error *error)
{
    tn_opened opened = {0};
    fixed_text made;
    tn_diagnostics_init(&opened.compilation.diagnostics, &opened.compilation.sources);
    tn_open_bytes(path, (const uint8_t *)fixed->text, fixed->size, false, &opened);
    tn_diagnostics_sort(&opened.compilation.diagnostics);
    bool good = apply(&opened.compilation.diagnostics, fixed, &made);
    tn_close(&opened);
    if (!good)
        return tn_fail_memory(error);
    *more = made.fixes > fixed->fixes;
    free(fixed->text);
    *fixed = made;
    return TN_OK;
}

static tn_status fix_all(const char *path, fixed_text *fixed, tn_error *error)
{
    bool more = true;
    tn_status status = TN_OK;
    for (int round = 0; status == TN_OK && more && round < ROUNDS_MAX; round++)
        status = improve(path, fixed, &more, error);
    return status;
}

/* Asks a person. Only y and yes are yes. */
static bool asks_yes(const char *path)
{
    char *line = NULL;
    size_t capacity = 0;
    fprintf(stderr, "Write %s? [y/N] ", path);
    tn_interrupt_asking(true);
    bool read = !tn_interrupted() && getline(&line, &capacity, stdin) >= 0;
    tn_interrupt_asking(false);
    bool yes = read && !tn_interrupted() && (strcmp(line, "y\n") == 0 || strcmp(line, "yes\n") == 0);
    if (!read)
        fputc('\n', stderr);
    free(line);
    return yes;
}

/* Is the file on the disk still what was read? An editor may have saved it while a person thought. */
static bool still_same(tn_job *job, const char *path, const char *text, size_t size)
{
    uint8_t *bytes = NULL;
    size_t now = 0;
    tn_error error;
    if (tn_file_read(path, TN_SOURCE_BYTES_MAX, &bytes, &now, &error) != TN_OK) {
        tn_job_fail(job, &error);
        return false;
    }
    bool same = now == size && memcmp(bytes, text, size) == 0;
    free(bytes);
    if (same)
        return true;
    tn_fail(&error, TN_IO, E_CANNOT_WRITE, "%.300s has changed meanwhile; nothing is written", path);
    tn_job_fail(job, &error);
    return false;
}

/* What was read is compared last, when all but the renaming is done: an edit in between would be lost. */
static void write_file(tn_job *job, const char *path, const char *text, size_t size, const fixed_text *fixed)
{
    tn_output output;
    tn_error error;
    if (!tn_job_output(job, path, &output))
        return;
    fwrite(fixed->text, 1, fixed->size, output.stream);
    fflush(output.stream);
    if (!still_same(job, path, text, size)) {
        tn_output_discard(&output);
        return;
    }
    if (tn_output_commit(&output, &error) != TN_OK) {
        tn_job_fail(job, &error);
        return;
    }
    tn_job_note(job, "%.300s: %zu place%s replaced", path, fixed->fixes, fixed->fixes == 1 ? "" : "s");
}

static bool show_difference(tn_job *job, const char *path, const char *before, const char *after)
{
    tn_output output;
    if (!tn_job_output(job, NULL, &output))
        return false;
    bool good = tn_line_diff(path, "fixed", before, after, output.stream);
    tn_job_commit(job, &output);
    fflush(stdout);
    if (good)
        return !job->reader_gone;
    tn_error error;
    tn_fail_memory(&error);
    tn_job_fail(job, &error);
    return false;
}

static bool deliver(tn_job *job, const char *path, const char *text, size_t size, const fixed_text *fixed, bool yes)
{
    if (strcmp(text, fixed->text) == 0) {
        tn_job_note(job, "%.300s: no diagnostic suggests a replacement", path);
        return true;
    }
    if (!show_difference(job, path, text, fixed->text))
        return false;
    bool person = isatty(STDIN_FILENO) && isatty(STDERR_FILENO);
    if (yes || (person && asks_yes(path)))
        write_file(job, path, text, size, fixed);
    else if (person)
        tn_job_note(job, "%.300s stays as it is", path);
    else
        tn_job_note(job, "%.300s stays as it is: --yes writes it", path);
    return job->exit_code <= TN_EXIT_INVALID && !tn_interrupted();
}

/* The file is read several times and written, which a pipe or a device cannot be. What is not there is said by reading.
 */
static tn_status expect_file(const char *path, tn_error *error)
{
    struct stat found;
    if (stat(path, &found) != 0 || S_ISREG(found.st_mode) || S_ISDIR(found.st_mode))
        return TN_OK;
    tn_fail(error, TN_IO, E_CANNOT_WRITE, "cannot write %.300s: it is a pipe or a device, not a file", path);
    tn_error_help(error, "--fix reads a file and writes it again: name one");
    return TN_IO;
}

bool tn_fix_file(tn_job *job, const char *path, bool yes)
{
    uint8_t *bytes = NULL;
    size_t size = 0;
    tn_error error;
    if (expect_file(path, &error) != TN_OK || tn_file_read(path, TN_SOURCE_BYTES_MAX, &bytes, &size, &error) != TN_OK) {
        tn_job_fail(job, &error);
        return false;
    }
    fixed_text fixed = {.text = strndup((const char *)bytes, size), .size = size};
    tn_status status = TN_OK;
    if (!fixed.text)
        status = tn_fail_memory(&error);
    else if (strlen(fixed.text) == size) /* else it is no text, which opening says */
        status = fix_all(path, &fixed, &error);
    bool going = status == TN_OK && deliver(job, path, (const char *)bytes, size, &fixed, yes);
    if (status != TN_OK)
        tn_job_fail(job, &error);
    free(fixed.text);
    free(bytes);
    return going;
}
