/* Divides files of plans, and reads only a part of one. */
#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "runtime/base/file.h"
#include "runtime/plan/text/reader.h"

enum { LOOK_BYTES = 16 << 10 }; /* read at a time to find the end of a line */

/* Of text and packed plans, the bytes behind those that are used by now. */
static bool rest_of_file(const tn_plan_reader *reader, tn_plan_part *rest)
{
    off_t at = lseek(reader->file, 0, SEEK_CUR);
    size_t unused = reader->end - reader->begin;
    if (!reader->opened.regular || at < (off_t)unused)
        return false;
    *rest = (tn_plan_part){(uint64_t)at - unused, (uint64_t)reader->opened.size};
    if (rest->end < rest->begin)
        rest->end = rest->begin;
    return true;
}

bool tn_plan_reader_whole(const tn_plan_reader *reader, tn_plan_part *whole)
{
    *whole = (tn_plan_part){0, 1};
    if (reader->decompressing)
        return false;
    switch (reader->format) {
    case TN_FORMAT_LINES:
    case TN_FORMAT_JSON:
    case TN_FORMAT_BIN:
        return rest_of_file(reader, whole);
    case TN_FORMAT_PARQUET:
        *whole = reader->parquet->groups(reader);
        return true;
    default:
        return false;
    }
}

tn_status tn_plan_reader_restrict(tn_plan_reader *reader, const tn_plan_part *part, tn_error *error)
{
    if (reader->format == TN_FORMAT_PARQUET) {
        reader->parquet->restrict_to(reader, *part);
        return TN_OK;
    }
    if (lseek(reader->file, (off_t)part->begin, SEEK_SET) < 0)
        return tn_cannot_read(reader->path, errno, error);
    reader->begin = reader->end = 0;
    reader->left = part->end - part->begin;
    reader->input_ended = reader->at_end = false;
    return TN_OK;
}

tn_plan_format tn_plan_reader_format(const tn_plan_reader *reader)
{
    return reader->format;
}

/* ---- places to divide a file at */

/* Behind the first end of a line from `at` on. */
static tn_status find_line(const tn_plan_reader *reader, uint64_t at, uint64_t end, uint64_t *cut, tn_error *error)
{
    char bytes[LOOK_BYTES];
    while (at < end) {
        ssize_t got = pread(reader->file, bytes, sizeof bytes, (off_t)at);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            return tn_cannot_read(reader->path, errno, error);
        if (got == 0)
            break;
        const char *newline = memchr(bytes, '\n', (size_t)got);
        if (newline) {
            *cut = at + (uint64_t)(newline - bytes) + 1;
            return TN_OK;
        }
        at += (uint64_t)got;
    }
    *cut = end;
    return TN_OK;
}

/* Steps over packed plans from the part's beginning on, until one begins at `near` or behind. */
static tn_status step_to(tn_plan_reader *reader, const tn_plan_part *part, uint64_t near, uint64_t *at, uint64_t *plans,
                         tn_error *error)
{
    tn_status status = tn_plan_reader_restrict(reader, part, error);
    *at = part->begin;
    for (*plans = 0; status == TN_OK && *at < near; ++*plans) {
        status = tn_reader_bin_step(reader, error);
        *at = part->end - reader->left - (reader->end - reader->begin);
    }
    return status;
}

tn_status tn_plan_reader_cut(tn_plan_reader *reader, const tn_plan_part *part, uint64_t near, uint64_t *cut,
                             tn_error *error)
{
    *cut = near <= part->begin ? part->begin : near < part->end ? near : part->end;
    if (*cut != near || near == part->begin || near == part->end || reader->format == TN_FORMAT_PARQUET)
        return TN_OK;
    uint64_t plans;
    if (reader->format == TN_FORMAT_BIN)
        return step_to(reader, part, near, cut, &plans, error);
    return find_line(reader, near - 1, part->end, cut, error);
}

/* ---- counting */

static tn_status count_lines(tn_plan_reader *reader, const tn_plan_part *part, uint64_t *count, tn_error *error)
{
    bool found = true;
    tn_status status = tn_plan_reader_restrict(reader, part, error);
    uint64_t before = reader->line;
    while (status == TN_OK && found) {
        status = tn_reader_line(reader, &found, error);
        if (status == TN_LIMIT)
            status = TN_OK; /* a line that is too long is one too */
    }
    *count = reader->line - before;
    reader->line = before;
    return status;
}

tn_status tn_plan_reader_count(tn_plan_reader *reader, const tn_plan_part *part, uint64_t *count, tn_error *error)
{
    *count = 0;
    if (reader->format == TN_FORMAT_PARQUET) {
        *count = reader->parquet->count(reader, *part);
        return TN_OK;
    }
    uint64_t at;
    return reader->format == TN_FORMAT_BIN ? step_to(reader, part, part->end, &at, count, error)
                                           : count_lines(reader, part, count, error);
}
