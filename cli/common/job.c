/* Runs the parts that commands share: opening files, messages, output, exit codes. */
#include "cli/common/job.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "ask/session/questions.h"
#include "cli/common/interrupt.h"
#include "runtime/base/array.h"
#include "runtime/base/watch.h"
#include "runtime/ranks/ranks.h"

/* ---- --watch: a command is run again whenever a file that it has read changes */

typedef struct tn_file_seen {
    char *path;
    bool there;
    ino_t number;
    off_t size;
    struct timespec changed;
} tn_file_seen;

static tn_file_seen look(const char *path)
{
    struct stat known;
    if (stat(path, &known) != 0)
        return (tn_file_seen){0};
    return (tn_file_seen){.there = true, .number = known.st_ino, .size = known.st_size, .changed = known.st_mtim};
}

static int compare_times(struct timespec a, struct timespec b)
{
    if (a.tv_sec != b.tv_sec)
        return a.tv_sec < b.tv_sec ? -1 : 1;
    return a.tv_nsec < b.tv_nsec ? -1 : a.tv_nsec > b.tv_nsec;
}

static bool same(const tn_file_seen *a, const tn_file_seen *b)
{
    return a->there == b->there && a->number == b->number && a->size == b->size &&
           compare_times(a->changed, b->changed) == 0;
}

static void files_read_clear(tn_files_read *read)
{
    for (size_t i = 0; i < read->count; i++)
        free(read->files[i].path);
    free(read->files);
    *read = (tn_files_read){0};
}

/* Does nothing where it is there already, is no file, or memory is out. */
static void files_read_add(tn_files_read *read, const char *path)
{
    for (size_t i = 0; i < read->count; i++)
        if (strcmp(read->files[i].path, path) == 0)
            return;
    tn_file_seen seen = look(path);
    if (!seen.there)
        return;
    if (!tn_array_reserve(&read->files, &read->capacity, read->count, 1, sizeof *read->files))
        return;
    seen.path = strdup(path);
    if (seen.path)
        read->files[read->count++] = seen;
}

/* One that is away for a moment, while another is put in its place, has not changed yet. */
static const char *changed(const tn_files_read *read)
{
    for (size_t i = 0; i < read->count; i++) {
        tn_file_seen now = look(read->files[i].path);
        if (now.there && !same(&now, &read->files[i]))
            return read->files[i].path;
    }
    return NULL;
}

/* Changed since the run began? What it has read may be of two files then. */
static const char *changed_since(const tn_files_read *read, struct timespec begin)
{
    for (size_t i = 0; i < read->count; i++)
        if (compare_times(read->files[i].changed, begin) >= 0)
            return read->files[i].path;
    return NULL;
}

static void say_watching(const tn_settings *settings, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void say_watching(const tn_settings *settings, const char *format, ...)
{
    char text[400];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    tn_job job;
    tn_job_begin(&job, settings);
    tn_job_note(&job, "%s", text);
    tn_job_end(&job);
}

/* The file that changed; NULL: interrupted. */
static const char *wait_for_change(const tn_files_read *read)
{
    const struct timespec pause = {0, 200 * 1000 * 1000};
    const char *path = NULL;
    while (!path && !tn_interrupted()) {
        nanosleep(&pause, NULL);
        path = changed(read);
    }
    return tn_interrupted() ? NULL : path;
}

/* Of standard input there is nothing to watch. */
static int refuse_standard_input(const tn_settings *settings)
{
    tn_job job;
    tn_job_begin(&job, settings);
    tn_job_usage(&job, "--watch is about files, and standard input is none");
    return tn_job_end(&job);
}

int tn_watch_files(const tn_settings *settings, int (*once)(const tn_settings *settings, tn_files_read *read))
{
    tn_files_read read = {0};
    for (size_t i = 0; i < settings->operands.count; i++)
        if (strcmp(settings->operands.items[i], "-") == 0)
            return refuse_standard_input(settings);
    for (;;) {
        struct timespec begin;
        clock_gettime(CLOCK_REALTIME, &begin);
        double start = tn_seconds();
        int exit_code = once(settings, &read);
        double seconds = tn_seconds() - start;
        fflush(stdout);
        for (size_t i = 0; i < settings->operands.count; i++)
            files_read_add(&read, settings->operands.items[i]);
        const char *path = changed_since(&read, begin);
        if (!path && !tn_interrupted() && read.count > 0) {
            say_watching(settings, "%.2f s; waiting for a change of %zu file%s; Ctrl-C ends", seconds, read.count,
                         read.count == 1 ? "" : "s");
            path = wait_for_change(&read);
        }
        if (!path) {
            tn_interrupt_answered();
            files_read_clear(&read);
            return exit_code;
        }
        say_watching(settings, "%.300s has changed", path);
        files_read_clear(&read);
    }
}

/* ---- files that a question makes */

static tn_status path_in_folder(tn_made_outputs *o, const char *name, tn_error *error)
{
    const char *folder = o->paths[0];
    const char *between = folder[strlen(folder) - 1] == '/' ? "" : "/";
    tn_status status = o->next == 0 ? tn_folder_make(folder, error) : TN_OK;
    if (status == TN_OK && asprintf(&o->in_folder, "%s%s%s", folder, between, name ? name : "index.html") < 0) {
        o->in_folder = NULL;
        status = tn_fail_memory(error);
    }
    return status;
}

static tn_status opens(void *context, const char *name, FILE **stream, tn_error *error)
{
    tn_made_outputs *o = context;
    if (!o->folder && o->next == o->count)
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "there are more files than names for them");
    const char *made = o->folders ? o->folders[o->next] : NULL;
    tn_status status = o->folder ? path_in_folder(o, name, error) : made ? tn_folder_make(made, error) : TN_OK;
    if (status == TN_OK)
        status = tn_output_open(o->folder ? o->in_folder : o->paths[o->next], &o->output, error);
    *stream = status == TN_OK ? o->output.stream : NULL;
    o->next++;
    return status;
}

static tn_status closes(void *context, bool whole, tn_error *error)
{
    tn_made_outputs *o = context;
    tn_status status = TN_OK;
    if (whole) {
        status = tn_output_commit(&o->output, error);
        if (status != TN_OK && error->code == E_CLOSED_PIPE) { /* which ends quietly */
            tn_job_fail(o->job, error);
            status = TN_OK;
        }
    } else {
        tn_output_discard(&o->output);
    }
    free(o->in_folder);
    o->in_folder = NULL;
    return status;
}

void tn_job_files(tn_job *job, tn_made_outputs *outputs, const char *const *paths, size_t count, bool folder)
{
    *outputs = (tn_made_outputs){.job = job, .paths = paths, .count = count, .folder = folder};
    outputs->taker = (tn_file_taker){opens, closes, outputs};
    job->session.files = &outputs->taker;
}

void tn_job_files_end(tn_made_outputs *outputs)
{
    free(outputs->in_folder);
    outputs->job->session.files = NULL;
}

unsigned tn_picture_choice(const char *path)
{
    tn_file_format format = path ? tn_file_format_of(path) : TN_FILE_SVG;
    return format == TN_FILE_PNG ? 1 : format == TN_FILE_PDF ? 2 : format == TN_FILE_DXF ? 3 : 0;
}

unsigned tn_answer_picture_choice(const char *path)
{
    return tn_job_draws(path) ? 1 + tn_picture_choice(path) : 0;
}

void tn_job_draw(tn_job *job, const tn_draw_request *request, const char *path)
{
    tn_made_outputs outputs;
    tn_reply answer;
    tn_job_files(job, &outputs, &path, 1, false);
    tn_job_answered(job, tn_ask_draw(&job->session, request, &answer));
    tn_job_files_end(&outputs);
    tn_reply_clear(&answer);
}

/* ---- a job */

/* The exit code for a status. */
static int tn_exit_code(tn_status status)
{
    switch (status) {
    case TN_OK:
        return TN_EXIT_DONE;
    case TN_INVALID:
        return TN_EXIT_INVALID;
    case TN_IO:
        return TN_EXIT_IO;
    case TN_LIMIT:
    case TN_MEMORY:
        return TN_EXIT_LIMIT;
    case TN_STOPPED:
        return TN_EXIT_INTERRUPTED;
    case TN_INTERNAL:
        break;
    }
    return TN_EXIT_INTERNAL;
}

static void worsen(tn_job *job, int exit_code)
{
    if (exit_code == TN_EXIT_INTERRUPTED && tn_memory_guard_full())
        exit_code = TN_EXIT_LIMIT; /* nobody asked for the end */
    if (exit_code > job->exit_code)
        job->exit_code = exit_code;
}

static void show_work(void *context, const char *work)
{
    tn_job *job = context;
    tn_job_show(job);
    tn_progress_watch(&job->progress, work, tn_interrupt_waiting());
}

static void end_work(void *context)
{
    tn_job *job = context;
    tn_progress_unwatch(&job->progress, tn_interrupt_waiting());
}

static void show_said(void *context)
{
    tn_job_show(context);
}

void tn_job_begin(tn_job *job, const tn_settings *settings)
{
    *job = (tn_job){.settings = settings};
    job->session = (tn_session){.opened = &job->opened, .listener = {show_work, end_work, job, show_said}};
    tn_diagnostics_init(&job->opened.compilation.diagnostics, &job->opened.compilation.sources);
}

static tn_param_values params_of(const tn_job *job)
{
    return (tn_param_values){job->settings->params.items, job->settings->params.count};
}

bool tn_job_open(tn_job *job, const char *path)
{
    return tn_job_open_asking(job, path, NULL);
}

bool tn_job_open_asking(tn_job *job, const char *path, const tn_questions *questions)
{
    if (job->opened.module && job->opened.path == path)
        return true;
    worsen(job, tn_exit_code(tn_open_asking(path, job->settings->werror, questions, params_of(job), &job->opened)));
    if (job->opened.module)
        job->opened.module->watch = tn_interrupt_waiting();
    return job->opened.module != NULL;
}

bool tn_job_open_joined(tn_job *job, const char *const *paths, size_t count)
{
    worsen(job, tn_exit_code(tn_open_joined(paths, count, job->settings->werror, params_of(job), &job->opened)));
    if (job->opened.module)
        job->opened.module->watch = tn_interrupt_waiting();
    return job->opened.module != NULL;
}

void tn_job_status(tn_job *job, tn_status status)
{
    worsen(job, tn_exit_code(status));
    job->stopped |= status == TN_STOPPED;
}

/* Is what was said last that the question makes no sense? */
static bool makes_no_sense(const tn_diagnostics *list)
{
    tn_code code = list->count > 0 ? list->items[list->count - 1].code : TN_CODE_NONE;
    return code == E_USAGE || code == E_PART_ABSENT;
}

bool tn_job_answered(tn_job *job, tn_status status)
{
    if (status == TN_INVALID && makes_no_sense(tn_job_diagnostics(job)))
        worsen(job, TN_EXIT_USAGE);
    else
        tn_job_status(job, status);
    return status == TN_OK;
}

void tn_job_write_json(const tn_reply *answer, FILE *out)
{
    tn_json json = tn_json_file(out, tn_reply_layout(answer));
    tn_message_write(answer->message, answer->value, NULL, &json);
    tn_json_end_line(&json);
}

tn_diagnostics *tn_job_diagnostics(tn_job *job)
{
    return &job->opened.compilation.diagnostics;
}

void tn_job_fail(tn_job *job, const tn_error *error)
{
    if (error->code == E_CLOSED_PIPE) {
        job->reader_gone = true;
        return;
    }
    if (error->status == TN_STOPPED) {
        tn_job_status(job, TN_STOPPED);
        return;
    }
    tn_finding_error(&job->opened, error);
    bool cannot_be_asked = error->code == E_USAGE || error->code == E_PART_ABSENT;
    worsen(job, cannot_be_asked ? TN_EXIT_USAGE : tn_exit_code(error->status));
}

tn_diagnostic *tn_job_usage(tn_job *job, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    tn_diagnostic *d = tn_report_bare_list(tn_job_diagnostics(job), TN_ERROR, E_USAGE, format, args);
    va_end(args);
    worsen(job, TN_EXIT_USAGE);
    return d;
}

void tn_job_note(tn_job *job, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    tn_report_bare_list(tn_job_diagnostics(job), TN_NOTE, TN_CODE_NONE, format, args);
    va_end(args);
}

void tn_job_interrupted(tn_job *job, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    tn_report_bare_list(tn_job_diagnostics(job), TN_NOTE, TN_CODE_NONE, format, args);
    va_end(args);
    tn_job_status(job, TN_STOPPED);
    job->said = true;
}

static void say_what_was_passed(tn_job *job)
{
    tn_error error;
    tn_memory_guard_describe(job->settings->command, &error);
    tn_finding_error(&job->opened, &error);
    worsen(job, TN_EXIT_LIMIT);
}

/* Where no command said it itself. */
static void say_what_is_missing(tn_job *job)
{
    const char *output = tn_settings_output(job->settings);
    job->stopped |= tn_job_diagnostics(job)->stopped;
    if (job->stopped && tn_memory_guard_full())
        say_what_was_passed(job);
    bool nothing_to_lose = tn_memory_guard_full() && !(output && strcmp(output, "-") != 0);
    if (!job->stopped || job->said || nothing_to_lose)
        return;
    if (output && strcmp(output, "-") != 0)
        tn_job_interrupted(job, "interrupted; %.400s is not written", output);
    else
        tn_job_interrupted(job, "interrupted before the end");
}

static bool wants_colour(void)
{
    const char *no_colour = getenv("NO_COLOR"), *terminal = getenv("TERM");
    return isatty(STDERR_FILENO) && !(no_colour && *no_colour) && !(terminal && strcmp(terminal, "dumb") == 0);
}

/* Whole in one write, so that the words of processes that share an error output do not mix. */
static void say(const char *words, size_t size)
{
    fflush(stderr);
    for (ssize_t wrote = 0; size > 0 && (wrote >= 0 || errno == EINTR); words += wrote > 0 ? wrote : 0) {
        wrote = write(STDERR_FILENO, words, size);
        size -= wrote > 0 ? (size_t)wrote : 0;
    }
}

/* With several ranks, what each has to say is kept for the end: then the first says what it has not said itself. */
static void keep_words(tn_job *job, const char *words)
{
    char *both = NULL;
    if (asprintf(&both, "%s%s", job->words ? job->words : "", words) >= 0) {
        free(job->words);
        job->words = both;
    }
}

static void tell(tn_job *job, tn_diagnostics *list, const tn_show_options *options)
{
    char *words = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&words, &size);
    if (out) {
        tn_diagnostics_show(list, options, out);
        fclose(out);
    }
    if (tn_ranks_lead(job->settings->ranks))
        words ? say(words, size) : tn_diagnostics_show(list, options, stderr);
    if (words && tn_ranks_several(job->settings->ranks))
        keep_words(job, words);
    free(words);
}

static void show(tn_job *job)
{
    tn_diagnostics *list = tn_job_diagnostics(job);
    tn_show_options options = {.json = job->settings->diagnostics == 1,
                               .colour = wants_colour() && !tn_ranks_several(job->settings->ranks)};
    tn_diagnostics_sort(list);
    job->errors += list->error_count;
    job->warnings += list->warning_count;
    job->stopped |= list->stopped;
    if (job->listener)
        job->listener->listen(job->listener, list);
    if (list->count || list->failed || options.json)
        tell(job, list, &options);
    if (list->failed)
        worsen(job, TN_EXIT_LIMIT);
    tn_diagnostics_clear(list);
    tn_diagnostics_init(list, &job->opened.compilation.sources);
}

void tn_job_show(tn_job *job)
{
    if (job->settings->diagnostics == 0)
        show(job);
}

static void close_file(tn_job *job)
{
    const tn_sources *sources = &job->opened.compilation.sources;
    for (size_t i = 0; job->read && i < sources->count; i++)
        files_read_add(job->read, sources->files[i].path);
    tn_session_forget(&job->session);
    tn_close(&job->opened);
}

void tn_job_next(tn_job *job)
{
    show(job);
    close_file(job);
    tn_diagnostics_init(tn_job_diagnostics(job), &job->opened.compilation.sources);
}

bool tn_job_reopen(tn_job *job, const char *path)
{
    tn_job_next(job);
    return tn_job_open(job, path);
}

/* ---- several ranks */

bool tn_job_agree(const tn_job *job, bool well)
{
    return !tn_ranks_any(job->settings->ranks, !well);
}

/* Was it said by a rank before, perhaps with more behind it? */
static bool is_said(const tn_gathered *all, unsigned rank)
{
    const char *text = (const char *)all->bytes + all->begins[rank];
    for (unsigned r = 0; r < rank; r++)
        if (strstr((const char *)all->bytes + all->begins[r] + sizeof(int), text + sizeof(int)))
            return true;
    return text[sizeof(int)] == '\0';
}

/* Each rank tells its exit code and what it has to say; the gravest code is that of all. */
static void end_together(tn_job *job, const char *words)
{
    const tn_ranks *ranks = job->settings->ranks;
    tn_gathered all;
    char *mine = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&mine, &size);
    if (out) {
        fwrite(&job->exit_code, sizeof job->exit_code, 1, out);
        fputs(words, out);
        fputc('\0', out);
        fclose(out);
    }
    ranks->gather(ranks->context, mine, size, &all);
    for (unsigned r = 0; r < ranks->count; r++) {
        int code = TN_EXIT_LIMIT; /* of one without memory to say it */
        bool told = all.begins[r + 1] - all.begins[r] > sizeof code;
        if (told)
            memcpy(&code, all.bytes + all.begins[r], sizeof code);
        worsen(job, code);
        if (ranks->rank == 0 && r > 0 && told && !is_said(&all, r))
            fprintf(stderr, "rank %u:\n%s", r, (const char *)all.bytes + all.begins[r] + sizeof code);
    }
    tn_gathered_clear(&all);
    free(mine);
}

int tn_job_end(tn_job *job)
{
    say_what_is_missing(job);
    show(job);
    close_file(job);
    if (job->errors || (job->warnings && job->settings->werror))
        worsen(job, TN_EXIT_INVALID);
    if (tn_ranks_several(job->settings->ranks))
        end_together(job, job->words ? job->words : "");
    free(job->words);
    return job->exit_code;
}

bool tn_job_draws(const char *path)
{
    return path && TN_WRITES_PICTURES >> tn_file_format_of(path) & 1;
}

bool tn_job_writes(tn_job *job, const char *what, const char *path, tn_file_formats writes)
{
    char command[80];
    tn_error error;
    snprintf(command, sizeof command, "the output of `tartan %.40s`", job->settings->command->name);
    if (!path || tn_file_ending_check(what ? what : command, path, writes, &error) == TN_OK)
        return true;
    tn_job_fail(job, &error);
    return false;
}

bool tn_job_takes_text(tn_job *job, const char *path)
{
    if (!tn_job_draws(path))
        return true;
    tn_diagnostic *d = tn_job_usage(job, "%.200s is the name of a picture, and this output is text", path);
    tn_help(tn_job_diagnostics(job), d, "end its name otherwise; plans and rules are drawn by `tartan draw`");
    return false;
}

bool tn_job_output(tn_job *job, const char *path, tn_output *output)
{
    if (!tn_job_takes_text(job, path))
        return false;
    tn_error error;
    if (tn_output_open(path ? path : "-", output, &error) == TN_OK)
        return true;
    tn_job_fail(job, &error);
    return false;
}

void tn_job_commit(tn_job *job, tn_output *output)
{
    tn_error error;
    if (tn_output_commit(output, &error) != TN_OK)
        tn_job_fail(job, &error);
}

void tn_job_close(tn_job *job, tn_output *output, bool complete)
{
    if (complete || !output->replaces)
        tn_job_commit(job, output);
    else
        tn_output_discard(output);
}
