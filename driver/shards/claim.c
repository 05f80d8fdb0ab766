/* Claims shards for this process. */
#include "driver/shards/claim.h"

#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "runtime/base/file.h"
#include "runtime/base/json.h"
#include "runtime/base/watch.h"

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
static void describe(const tn_claimant *self, tn_buffer *text)
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
    describe(self, &text);
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

void tn_claim_touch(tn_claim *claim, double stale)
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
