/* Claims shards, writes them, and waits for those that others write. */
#include "driver/shards/run.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <jansson.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "driver/plan/provenance.h"
#include "driver/shards/hash.h"
#include "driver/shards/inputs.h"
#include "driver/shards/record.h"
#include "runtime/base/crew.h"
#include "runtime/base/file.h"
#include "runtime/base/integers.h"
#include "runtime/base/json.h"
#include "runtime/base/watch.h"

/* ---- claims */

#define TOUCHES 8         /* times that a claim is touched before it would be stale */
#define WRITTEN_WITHIN 5. /* seconds after which a claim that says nothing is of a worker killed while it made it */

/* ---- this process */

static void read_boot(char *boot, size_t size)
{
    int file = open("/proc/sys/kernel/random/boot_id", O_RDONLY | O_CLOEXEC);
    ssize_t got = file < 0 ? 0 : read(file, boot, size - 1);
    boot[got > 0 ? got : 0] = '\0';
    boot[strcspn(boot, "\n")] = '\0';
    if (file >= 0)
        close(file);
}

tn_claimant tn_claimant_self(void)
{
    tn_claimant me = {.process = getpid()};
    if (gethostname(me.host, sizeof me.host - 1) != 0)
        me.host[0] = '\0';
    read_boot(me.boot, sizeof me.boot);
    ssize_t got = readlink("/proc/self/ns/pid", me.space, sizeof me.space - 1);
    me.space[got > 0 ? got : 0] = '\0';
    return me;
}

/* What a claim says. */
static void describe_claim(const tn_claimant *self, tn_buffer *text)
{
    char since[sizeof self->since] = "";
    time_t now = time(NULL);
    struct tm parts;
    if (gmtime_r(&now, &parts))
        strftime(since, sizeof since, "%Y-%m-%dT%H:%M:%SZ", &parts);
    tn_json json = tn_json_text(text, TN_JSON_SPACED);
    tn_json_object(&json, NULL);
    tn_json_string(&json, "host", self->host);
    tn_json_string(&json, "boot", self->boot);
    tn_json_string(&json, "space", self->space);
    tn_json_whole(&json, "process", self->process);
    tn_json_string(&json, "since", since);
    tn_json_object_end(&json);
}

/* ---- whose claim is it? */

static void copy_text(const json_t *json, const char *key, char *text, size_t size)
{
    const char *value = json_string_value(json_object_get(json, key));
    snprintf(text, size, "%s", value ? value : "");
}

/* A new file in a folder, of which nothing is left when it is closed: without a name, where the file system has that.
 */
static int open_passing(const char *folder)
{
    char path[4096];
    int file = open(folder, O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    if (file >= 0 || snprintf(path, sizeof path, "%s/.tartan-%ld.tmp", folder, (long)getpid()) >= (int)sizeof path)
        return file;
    file = open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file >= 0)
        unlink(path);
    return file;
}

/* What the file system would call now: the time that it gives to a file which is made now. */
static bool file_system_time(const char *beside, struct timespec *now)
{
    char folder[4096];
    struct stat known;
    int length = (int)(strrchr(beside, '/') ? strrchr(beside, '/') - beside : 0);
    snprintf(folder, sizeof folder, "%.*s", length ? length : 1, length ? beside : ".");
    int file = open_passing(folder);
    if (file < 0)
        return clock_gettime(CLOCK_REALTIME, now) == 0;
    bool done = fstat(file, &known) == 0;
    close(file);
    *now = known.st_mtim;
    return done;
}

static double seconds_of(struct timespec time)
{
    return (double)time.tv_sec + (double)time.tv_nsec * 1e-9;
}

bool tn_claim_read(const char *path, tn_claimant *claimant)
{
    struct stat known;
    struct timespec now;
    *claimant = (tn_claimant){0};
    if (lstat(path, &known) != 0)
        return false;
    bool regular = S_ISREG(known.st_mode);                         /* what is none, such as a pipe, says nothing */
    json_t *json = regular ? json_load_file(path, 0, NULL) : NULL; /* NULL where it is being written */
    copy_text(json, "host", claimant->host, sizeof claimant->host);
    copy_text(json, "boot", claimant->boot, sizeof claimant->boot);
    copy_text(json, "space", claimant->space, sizeof claimant->space);
    copy_text(json, "since", claimant->since, sizeof claimant->since);
    claimant->process = json_integer_value(json_object_get(json, "process"));
    json_decref(json);
    if (file_system_time(path, &now))
        claimant->age = seconds_of(now) - seconds_of(known.st_mtim);
    return true;
}

/* Has its process ended? Only known of processes that this one can see. A claim of this very process is left from an
 * earlier one with its number: it does each shard once at a time. */
static bool is_gone(const tn_claimant *claimant, const tn_claimant *self)
{
    bool visible = claimant->process > 0 && claimant->boot[0] && strcmp(claimant->boot, self->boot) == 0 &&
                   strcmp(claimant->space, self->space) == 0;
    if (!visible)
        return false;
    return claimant->process == self->process || (kill((pid_t)claimant->process, 0) != 0 && errno == ESRCH);
}

/* ---- taking and giving up */

/* Makes the claim's file. False where that cannot be; errno says why. */
static bool make(const char *path, const tn_claimant *self, tn_claim *claim)
{
    tn_buffer text = {0};
    describe_claim(self, &text);
    char *own = strdup(path);
    bool made = own && !text.failed;
    int file = made ? open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666) : -1;
    bool written = file >= 0 && write(file, text.data, text.size) == (ssize_t)text.size;
    int reason = made ? errno : ENOMEM;
    if (file >= 0)
        close(file);
    if (file >= 0 && !written)
        unlink(path);
    free(text.data);
    claim->path = written ? own : NULL;
    claim->touched = tn_seconds();
    if (!written)
        free(own);
    errno = reason;
    return written;
}

/* Nothing is lost where a claim is taken over whose worker lives: two write the same shard. */
static bool may_be_taken(const tn_claimant *other, const tn_claimant *self, double stale)
{
    double silent = fabs(other->age);
    return silent > stale || is_gone(other, self) || (other->process == 0 && silent > WRITTEN_WITHIN);
}

tn_status tn_claim_take(const char *path, const tn_claimant *self, double stale, tn_claim *claim, bool *taken,
                        tn_error *error)
{
    tn_claimant other;
    *claim = (tn_claim){0};
    *taken = make(path, self, claim);
    if (*taken)
        return TN_OK;
    if (errno != EEXIST)
        return tn_cannot_write(path, errno, error);
    if (!tn_claim_read(path, &other) || !may_be_taken(&other, self, stale))
        return TN_OK; /* given up just now, or held */
    if (unlink(path) != 0 && errno != ENOENT)
        return tn_cannot_write(path, errno, error);
    *taken = make(path, self, claim);
    return *taken || errno == EEXIST ? TN_OK : tn_cannot_write(path, errno, error);
}

/* Says that the worker is still there, where it was last said long enough ago. */
static void claim_touch(tn_claim *claim, double stale)
{
    double now = tn_seconds();
    if (!claim->path || now - claim->touched < stale / TOUCHES)
        return;
    utimensat(AT_FDCWD, claim->path, NULL, 0); /* where it was taken over, that does no harm */
    claim->touched = now;
}

void tn_claim_release(tn_claim *claim)
{
    if (claim->path)
        unlink(claim->path);
    free(claim->path);
    *claim = (tn_claim){0};
}

/* ---- running */

/* Which shard, and what is looked at meanwhile. */
typedef struct shard_writing_now {
    uint32_t shard;
    tn_claim *claim; /* touched */
    double stale;
    tn_watch *watch;              /* TN_STOPPED by it */
    const tn_seen_bytes *written; /* sees its bytes */
} shard_writing_now;

/* ---- one shard of answers */

typedef struct answer_writing {
    const tn_shard_set *set;
    const tn_answering *answering;
    const shard_writing_now *now;
    tn_shard_read *read;
    FILE *out;
    tn_status status; /* why it ended early */
    tn_error *error;
} answer_writing;

static bool describe(const void *context, const tn_sifted *plan, tn_buffer texts[TN_RELAY_TEXTS])
{
    const answer_writing *a = context;
    return a->answering->plan(a->answering->context, plan, texts);
}

static bool write_texts(void *context, uint64_t plans, const tn_buffer texts[TN_RELAY_TEXTS])
{
    (void)plans;
    answer_writing *a = context;
    bool written = texts[0].size == 0 || fwrite(texts[0].data, 1, texts[0].size, a->out) == texts[0].size;
    claim_touch(a->now->claim, a->now->stale);
    if (written)
        a->status = tn_watch_check(a->now->watch, a->error);
    return written && a->status == TN_OK;
}

/* The failure, with the file and the line in it. */
static void refuse_plan(answer_writing *a, const tn_error *complaint)
{
    const tn_shard_input *input = &a->set->inputs.items[a->set->inputs.pieces[a->now->shard].input];
    uint64_t before;
    a->status = tn_shard_lines_before(a->set, a->answering->schema, a->now->shard, &before, a->error);
    if (a->status != TN_OK)
        return;
    a->status = tn_fail(a->error, complaint->status, complaint->code, "%.200s:%" PRIu64 ":%u: %.240s", input->path,
                        before + complaint->line, complaint->column, complaint->message);
    if (complaint->help[0])
        tn_error_help(a->error, "%s", complaint->help);
}

static bool complain(void *context, const tn_error *complaint, const char *text, size_t size)
{
    (void)text, (void)size;
    answer_writing *a = context;
    if (!a->set->inputs.skips)
        refuse_plan(a, complaint);
    else if (a->read->unread++ < TN_COMPLAINTS_KEPT)
        a->read->complaints[a->read->unread - 1] = *complaint;
    return a->set->inputs.skips;
}

static tn_status sift_piece(answer_writing *a, tn_plan_reader *reader, tn_error *error)
{
    const tn_sift_calls calls = {.context = a,
                                 .numbered = a->answering->numbered,
                                 .any = a->answering->any,
                                 .plan = describe,
                                 .write = write_texts,
                                 .bad = complain,
                                 .lines = &a->read->lines};
    tn_status status = tn_sift(reader, a->answering->rules, 1, &calls, error);
    return status == TN_OK ? a->status : status;
}

/* What is said of the plans of a piece of a file; fills `read`, which is zero. A plan that cannot be read is what the
 * failure is about, with its line in the whole file, unless the set skips such plans. TN_IO; E1733 as of
 * tn_shard_input_open. */
static tn_status shard_answer(const tn_shard_set *set, const tn_answering *answering, const shard_writing_now *now,
                              tn_shard_read *read, tn_error *error)
{
    tn_plan_reader *reader = NULL;
    tn_output output = {0};
    char *path = tn_shard_path(set, now->shard, "");
    tn_status status =
        path ? tn_shard_input_open(set, answering->schema, now->shard, &reader, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_output_open_seen(path, now->written, &output, error);
    if (status == TN_OK) {
        answer_writing a = {set, answering, now, read, output.stream, TN_OK, error};
        status = sift_piece(&a, reader, error);
        if (status == TN_OK)
            status = tn_output_commit(&output, error);
        else
            tn_output_discard(&output);
    }
    tn_plan_reader_free(reader);
    free(path);
    return status;
}

#define LOOK_EVERY 4096u /* plans between looks at the clock and for interruptions */

static char *words_of(const tn_shard_set *set, uint32_t shard)
{
    if (set->task == TN_TASK_SAMPLE)
        return strdup(set->command);
    char *from = mpz_get_str(NULL, 10, set->bounds[shard]), *to = mpz_get_str(NULL, 10, set->bounds[shard + 1]);
    const tn_enumerated asked = {.from = from,
                                 .to = to,
                                 .trays_given = set->options.override_trays,
                                 .trays_min = set->options.trays_min,
                                 .trays_max = set->options.trays_max};
    char *words = from && to ? tn_enumerated_words(&asked) : NULL;
    free(from);
    free(to);
    return words;
}

static tn_status write_sampled(const tn_shard_set *set, const tn_ready_library *ready, mpz_srcptr ranks,
                               const shard_writing_now *now, tn_plan_writer *writer, tn_error *error)
{
    mpz_t *sampled;
    size_t count;
    tn_tray *trays = malloc(((size_t)tn_library_max(ready->library) + 1) * sizeof *trays);
    tn_status status = tn_shard_sampled(set, ranks, now->shard, &sampled, &count, now->watch, error);
    if (status == TN_OK && !trays)
        status = tn_fail_memory(error);
    for (size_t i = 0; status == TN_OK && i < count; i++) {
        uint32_t length;
        status = tn_library_unrank(ready->library, sampled[i], trays, &length)
                     ? tn_plan_writer_write(writer, sampled[i], trays, length, error)
                     : tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "a sampled rank is not in the library");
        if (status == TN_OK && (i + 1) % LOOK_EVERY == 0) {
            claim_touch(now->claim, now->stale);
            status = tn_watch_check(now->watch, error);
        }
    }
    tn_integers_free(sampled, count);
    free(trays);
    return status;
}

static tn_status write_plans(const tn_shard_set *set, const tn_ready_library *ready, const shard_writing_now *now,
                             tn_plan_writer *writer, tn_error *error)
{
    uint32_t shard = now->shard;
    tn_cursor *cursor;
    const tn_tray *trays;
    uint32_t length;
    size_t seen = 0;
    tn_status status = tn_cursor_new(ready->library, set->bounds[shard], set->bounds[shard + 1], &cursor, error);
    if (status != TN_OK)
        return status;
    mpz_t rank;
    mpz_init_set(rank, set->bounds[shard]);
    while (status == TN_OK && tn_cursor_next(cursor, &trays, &length)) {
        status = tn_plan_writer_write(writer, rank, trays, length, error);
        mpz_add_ui(rank, rank, 1);
        if (status == TN_OK && ++seen % LOOK_EVERY == 0) {
            claim_touch(now->claim, now->stale);
            status = tn_watch_check(now->watch, error);
        }
    }
    mpz_clear(rank);
    tn_cursor_free(cursor);
    return status;
}

/* Plans of the library. `ranks`: how many it has. */
static tn_status shard_enumerate(const tn_shard_set *set, const tn_ready_library *ready,
                                 const tn_plan_metadata *metadata, mpz_srcptr ranks, const shard_writing_now *now,
                                 tn_error *error)
{
    char *path = tn_shard_path(set, now->shard, ""), *words = words_of(set, now->shard);
    tn_plan_writer *writer = NULL;
    tn_writer_options options = tn_shard_writing(set, metadata, ranks);
    options.metadata.command = words;
    options.written = now->written;
    tn_status status =
        path && words ? tn_plan_writer_open(ready->schema, path, &options, &writer, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = set->task == TN_TASK_SAMPLE ? write_sampled(set, ready, ranks, now, writer, error)
                                             : write_plans(set, ready, now, writer, error);
    if (status == TN_OK)
        status = tn_plan_writer_close(writer, error);
    tn_plan_writer_free(writer);
    free(path);
    free(words);
    return status;
}

/* ---- one shard of houses */

static tn_status look_around(void *context, tn_error *error)
{
    const shard_writing_now *now = context;
    claim_touch(now->claim, now->stale);
    return tn_watch_check(now->watch, error);
}

/* How many houses of the set stand before those of the shard. */
static tn_status count_before(const tn_shard_set *set, uint32_t shard, uint64_t *before, tn_error *error)
{
    mpz_t houses;
    mpz_init(houses);
    mpz_sub(houses, set->bounds[shard + 1], set->bounds[0]);
    bool fits = mpz_sizeinbase(houses, 2) < 64;
    mpz_sub(houses, set->bounds[shard], set->bounds[0]);
    *before = fits ? mpz_get_ui(houses) : 0;
    mpz_clear(houses);
    return fits ? TN_OK : tn_fail(error, TN_LIMIT, E_SHARD_TOO_MANY, "more houses than the rows of tables can count");
}

static tn_status shard_houses(const tn_shard_set *set, const tn_shard_houses *houses, shard_writing_now *now,
                              tn_shard_record *record, tn_error *error)
{
    uint64_t before, written = 0;
    mpz_t wanted;
    char *path = tn_shard_stem(set, now->shard);
    tn_status status = path ? count_before(set, now->shard, &before, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = houses->write(houses->context, path, set->bounds[now->shard], set->bounds[now->shard + 1], before,
                               look_around, now, &written, error);
    mpz_init(wanted);
    tn_shard_plans(set, now->shard, wanted);
    if (status == TN_OK && mpz_cmp_ui(wanted, written) != 0)
        status = tn_fail(error, TN_INVALID, E_SHARD_MODULE,
                         "%.200s/" TN_MANIFEST_NAME " has ranks of houses that the library does not", set->folder);
    mpz_clear(wanted);
    free(path);
    return status == TN_OK ? tn_shard_record_files(set, now->shard, record, error) : status;
}

/* ---- a share of the shards */

#define WAIT_FIRST 0.05 /* seconds until it is looked again whether others are done */
#define WAIT_MOST 2.0   /* and at most */

/* Why a thread could not go on. */
typedef struct failure {
    uint32_t shard;
    tn_status status; /* TN_OK: it could */
    tn_error error;
} failure;

typedef struct running {
    const tn_shards_job *job;
    const tn_provenance *provenance;
    mpz_t ranks;      /* how many the library has */
    tn_claimant self; /* this process */
    double start;
    bool *done;        /* [shards]: known to be there; each is written by the thread that has the shard */
    failure *failures; /* [threads] */
    atomic_uint next;  /* the first shard that no thread has looked at in this pass, where there is one rank */
    atomic_uint written;
    _Atomic uint64_t unread; /* plans */
    atomic_uint held;        /* by others, in this pass */
    atomic_bool failed;      /* no further shard is begun here */
    atomic_bool out_of_time, ended;
    _Atomic double longest; /* seconds that a shard took */
} running;

/* ---- one shard */

/* The file of a shard, whose bytes `written` sees; `read` is filled for answers. */
static tn_status write_file(const running *run, uint32_t shard, tn_claim *claim, const tn_seen_bytes *written,
                            tn_shard_read *read, tn_error *error)
{
    const tn_shards_job *job = run->job;
    const shard_writing_now now = {shard, claim, job->stale, job->watch, written};
    return tn_shard_set_answers(job->set)
               ? shard_answer(job->set, job->answering, &now, read, error)
               : shard_enumerate(job->set, job->ready, &run->provenance->metadata, run->ranks, &now, error);
}

static tn_status write_houses(running *run, uint32_t shard, tn_claim *claim, tn_error *error)
{
    const tn_shards_job *job = run->job;
    shard_writing_now now = {shard, claim, job->stale, job->watch, NULL};
    tn_shard_record record = {0};
    tn_status status = shard_houses(job->set, job->houses, &now, &record, error);
    return status == TN_OK ? tn_shard_record_write(job->set, shard, &record, NULL, error) : status;
}

/* A shard, and its record. It is hashed while it is written, so that it need not be read again. */
static tn_status write_shard(running *run, uint32_t shard, tn_claim *claim, tn_error *error)
{
    if (tn_shard_set_houses(run->job->set))
        return write_houses(run, shard, claim, error);
    bool answers = tn_shard_set_answers(run->job->set);
    tn_shard_read *read = answers ? calloc(1, sizeof *read) : NULL;
    tn_hashing *hashing = tn_hashing_new();
    tn_shard_record record = {0};
    tn_status status = hashing && (read || !answers) ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK) {
        const tn_seen_bytes written = tn_hashing_seen(hashing);
        status = write_file(run, shard, claim, &written, read, error);
        tn_hashing_end(hashing, record.files[0].hash, &record.files[0].bytes);
    }
    if (status == TN_OK)
        status = tn_shard_record_write(run->job->set, shard, &record, read, error);
    if (status == TN_OK && read)
        run->unread += read->unread;
    tn_hashing_free(hashing);
    free(read);
    return status;
}

/* Is nothing there but a file, which a shard and its record replace? What a link leads to may belong to another set. */
static tn_status check_place(const tn_shard_set *set, uint32_t shard, uint32_t file, const char *ending,
                             tn_error *error)
{
    struct stat known;
    char *path = file > 0 ? tn_shard_file_path(set, shard, file) : tn_shard_path(set, shard, ending);
    tn_status status = path ? TN_OK : tn_fail_memory(error);
    if (path && lstat(path, &known) == 0 && !S_ISREG(known.st_mode))
        status = tn_shard_wrong(set, shard, error, "cannot be written: %s is there, and is no regular file",
                                *ending ? "a " TN_SHARD_RECORD : "something");
    free(path);
    return status;
}

/* A shard that is claimed. One that is there without its record is written again: its worker was killed between the
 * two, or it came from elsewhere. */
static tn_status finish_shard(running *run, uint32_t shard, tn_claim *claim, tn_error *error)
{
    double begun = tn_seconds();
    if (tn_shard_recorded(run->job->set, shard)) /* by another, while it was being claimed */
        return tn_shard_done(run->job->set, shard, error);
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < tn_shard_files(run->job->set); i++)
        status = check_place(run->job->set, shard, i, "", error);
    if (status == TN_OK)
        status = check_place(run->job->set, shard, 0, TN_SHARD_RECORD, error);
    if (status == TN_OK)
        status = write_shard(run, shard, claim, error);
    if (status == TN_OK) {
        run->written++;
        run->longest = fmax(run->longest, tn_seconds() - begun);
    }
    return status;
}

static tn_status do_shard(running *run, uint32_t shard, tn_error *error)
{
    const tn_shards_job *job = run->job;
    if (run->done[shard - job->begin])
        return TN_OK;
    char *path = tn_shard_path(job->set, shard, TN_SHARD_CLAIM);
    tn_claim claim = {0};
    bool recorded = tn_shard_recorded(job->set, shard), taken = recorded;
    tn_status status = path ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK && recorded)
        status = tn_shard_done(job->set, shard, error);
    else if (status == TN_OK)
        status = tn_claim_take(path, &run->self, job->stale, &claim, &taken, error);
    if (status == TN_OK && recorded)
        unlink(path); /* left by a worker that was killed behind its last step */
    else if (status == TN_OK && taken)
        status = finish_shard(run, shard, &claim, error);
    run->done[shard - job->begin] = status == TN_OK && taken;
    run->held += !taken;
    tn_claim_release(&claim);
    free(path);
    return status;
}

/* ---- all of them */

/* May another shard be begun? It is not where it would likely end too late. */
static bool goes_on(running *run)
{
    double used = tn_seconds() - run->start, allowed = run->job->seconds;
    if (allowed > 0 && used + run->longest > allowed)
        run->out_of_time = true;
    if (run->job->last && atomic_load(run->job->last))
        run->ended = true;
    return !run->failed && !run->out_of_time && !run->ended;
}

/* The next shard that nobody has taken in this pass, counted from the first that is asked for. */
static uint64_t take(running *run)
{
    const tn_ranks *ranks = run->job->ranks;
    return tn_ranks_several(ranks) ? ranks->take(ranks->context, 1) : run->next++;
}

/* One thread's part of a pass over the shards. */
static tn_status work(void *context, unsigned thread, size_t item, tn_error *error)
{
    (void)thread, (void)error;
    running *run = context;
    failure *mine = &run->failures[item];
    uint32_t count = run->job->end - run->job->begin;
    *mine = (failure){.status = TN_OK};
    while (mine->status == TN_OK && goes_on(run)) {
        uint64_t taken = take(run);
        if (taken >= count)
            break;
        mine->shard = (uint32_t)taken;
        mine->status = tn_watch_check(run->job->watch, &mine->error);
        if (mine->status == TN_OK)
            mine->status = do_shard(run, run->job->begin + mine->shard, &mine->error);
        tn_watch_tell(run->job->watch, (double)taken + 1, count);
    }
    if (run->ended && tn_ranks_several(run->job->ranks))
        run->job->ranks->take(run->job->ranks->context, count); /* the others begin none either */
    if (mine->status != TN_OK)
        run->failed = true;
    return TN_OK;
}

/* The failure of the first shard that has one, whichever thread came to its end first: shards are taken in order, and
 * what is taken is tried, so this is the same in every run. */
static tn_status first_failure(const running *run, unsigned threads, tn_error *error)
{
    const failure *first = NULL;
    for (const failure *f = run->failures; f < run->failures + threads; f++)
        if (f->status != TN_OK && (!first || f->shard < first->shard))
            first = f;
    if (first && error)
        *error = first->error;
    return first ? first->status : TN_OK;
}

static tn_status wait_a_little(const running *run, double *seconds, tn_error *error)
{
    double until = tn_seconds() + *seconds;
    tn_status status = TN_OK;
    while (status == TN_OK && tn_seconds() < until) {
        nanosleep(&(struct timespec){.tv_nsec = 20000000}, NULL);
        status = tn_watch_check(run->job->watch, error);
    }
    *seconds = fmin(2 * *seconds, WAIT_MOST);
    return status;
}

/* What ranks tell each other behind a pass. */
typedef struct passed {
    uint32_t held, written;
    uint64_t unread;
    bool failed, out_of_time, ended;
} passed;

/* Together: how the pass went for all of them. Where a rank came to its end by `last` or its time, all do. */
static passed all_passed(const running *run)
{
    const tn_ranks *ranks = run->job->ranks;
    passed sum = {run->held, run->written, run->unread, run->failed, run->out_of_time, run->ended}, one;
    if (!tn_ranks_several(ranks))
        return sum;
    tn_gathered all;
    ranks->gather(ranks->context, &sum, sizeof sum, &all);
    sum = (passed){0};
    for (unsigned r = 0; r < ranks->count; r++) {
        memcpy(&one, all.bytes + all.begins[r], sizeof one);
        sum.held += one.held;
        sum.written += one.written;
        sum.unread += one.unread;
        sum.failed |= one.failed;
        sum.out_of_time |= one.out_of_time;
        sum.ended |= one.ended;
    }
    tn_gathered_clear(&all);
    return sum;
}

static tn_status pass(running *run, tn_crew *crew, passed *now, tn_error *error)
{
    const tn_ranks *ranks = run->job->ranks;
    run->next = 0;
    run->held = 0;
    if (tn_ranks_several(ranks))
        ranks->restart(ranks->context);
    tn_status status = tn_crew_run(crew, tn_crew_threads(crew), 1, work, run, error);
    if (status == TN_OK)
        status = first_failure(run, tn_crew_threads(crew), error);
    *now = all_passed(run);
    return status;
}

/* Passes until no shard is held by others, together. */
static tn_status run_all(running *run, tn_crew *crew, passed *now, tn_error *error)
{
    double seconds = WAIT_FIRST;
    tn_status status = pass(run, crew, now, error);
    while (now->held > 0 && !now->failed && !now->out_of_time && !now->ended) {
        status = wait_a_little(run, &seconds, error);
        run->failed |= status != TN_OK;
        tn_error later;
        tn_status again = pass(run, crew, now, &later);
        if (status == TN_OK && again != TN_OK)
            *error = later;
        status = status == TN_OK ? again : status;
    }
    return tn_ranks_agree(run->job->ranks, status, error);
}

static bool is_done(const tn_shard_set *set, uint32_t shard)
{
    return tn_shard_recorded(set, shard) && tn_shard_done(set, shard, NULL) == TN_OK;
}

static uint32_t count_left(const running *run)
{
    uint32_t left = 0;
    for (uint32_t i = 0; i < run->job->end - run->job->begin; i++)
        left += !run->done[i] && !is_done(run->job->set, run->job->begin + i);
    return left;
}

/* Does rank 0 see what the others wrote? They come to an end without failure only where all shards are there. */
static tn_status see_all(const running *run, const passed *now, uint32_t left, tn_error *error)
{
    const tn_shards_job *job = run->job;
    if (!tn_ranks_several(job->ranks) || left == 0 || now->out_of_time || now->ended)
        return TN_OK;
    tn_fail(error, TN_IO, E_RANKS_APART, "rank 0 on %.60s does not see %u shards of %.200s that other ranks wrote",
            job->ranks->host, left, job->set->folder);
    tn_error_help(error, "keep the set in a folder that all machines share");
    return TN_IO;
}

tn_status tn_shards_run(const tn_shards_job *job, tn_shards_done *done, tn_error *error)
{
    uint32_t count = job->end - job->begin;
    passed now = {0};
    tn_provenance provenance;
    bool answers = tn_shard_set_answers(job->set) || tn_shard_set_houses(job->set);
    if (!answers)
        tn_provenance_describe(job->opened, job->ready, job->set->rules_path, NULL, &provenance);
    running run = {.job = job,
                   .provenance = &provenance,
                   .self = tn_claimant_self(),
                   .start = tn_seconds(),
                   .done = calloc(count + 1, sizeof *run.done)};
    mpz_init(run.ranks);
    if (!answers)
        tn_library_kept(job->ready->library, TN_ALL_LENGTHS, run.ranks);
    tn_crew *crew = tn_crew_new(job->threads, NULL);
    run.failures = crew ? calloc(tn_crew_threads(crew), sizeof *run.failures) : NULL;
    tn_status status = tn_ranks_agree(job->ranks, run.done && run.failures ? TN_OK : tn_fail_memory(error), error);
    if (status == TN_OK)
        status = run_all(&run, crew, &now, error);
    *done = (tn_shards_done){
        .written = now.written, .unread = now.unread, .out_of_time = now.out_of_time, .ended = now.ended};
    if (run.done && tn_ranks_lead(job->ranks)) {
        done->left = count_left(&run);
        if (status == TN_OK)
            status = see_all(&run, &now, done->left, error);
    }
    tn_crew_free(crew);
    mpz_clear(run.ranks);
    free(run.failures);
    free(run.done);
    return tn_ranks_agree(job->ranks, status, error);
}
