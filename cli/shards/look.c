/* tartan shards status, check: what is there of a set, and whether it is what it should be. */
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "cli/common/progress.h"
#include "cli/shards/shards.h"
#include "driver/open/digits.h"
#include "driver/shards/gather.h"
#include "driver/shards/inputs.h"
#include "driver/shards/record.h"
#include "driver/shards/run.h"
#include "runtime/base/crew.h"
#include "runtime/base/file.h"
#include "runtime/base/utf8.h"

#define SHOWN_MOST 10u       /* claims, and wrong shards */
#define COMPLAINTS_MOST 100u /* about plans that could not be read */

/* Shards of `wrong` were said to be so, as many as are shown. */
static void say_more_wrong(tn_job *job, uint32_t wrong)
{
    if (wrong > SHOWN_MOST)
        tn_job_note(job, "%u more shard%s wrong", wrong - SHOWN_MOST, wrong - SHOWN_MOST == 1 ? " is" : "s are");
}

/* ---- status */

typedef struct counted {
    uint32_t there, wrong, claimed, stale;
    mpz_t plans;
    uint64_t bytes, unread;
    double stale_after;
} counted;

static void show_claim(const tn_shard_set *set, uint32_t shard, const tn_claimant *by, bool stale, FILE *out)
{
    fprintf(out, "  %s: ", tn_shard_name_of(set, shard).text);
    if (by->process == 0) { /* killed while it made the claim, or just making it */
        fprintf(out, "a worker that has not said who it is");
    } else {
        tn_write_clean(out, by->host, strlen(by->host));
        fprintf(out, " (process %lld) since ", (long long)by->process);
        tn_write_clean(out, by->since, strlen(by->since));
    }
    fprintf(out, ", touched %.0f s ago%s\n", fmax(by->age, 0), stale ? ": stale" : "");
}

/* A shard that is there with its record: what it holds, plans or answers. */
static void count_held(tn_job *job, const tn_shard_set *set, uint32_t shard, counted *c)
{
    tn_shard_record record;
    tn_error error;
    mpz_t plans;
    tn_status status = tn_shard_done(set, shard, &error);
    if (status == TN_OK)
        status = tn_shard_record_read(set, shard, &record, &error);
    if (status != TN_OK) {
        if (c->wrong++ < SHOWN_MOST)
            tn_job_fail(job, &error);
        return;
    }
    c->there++;
    for (uint32_t i = 0; i < tn_shard_files(set); i++)
        c->bytes += record.files[i].bytes;
    c->unread += record.unread;
    if (tn_shard_set_answers(set))
        return;
    mpz_init(plans);
    tn_shard_plans(set, shard, plans);
    mpz_add(c->plans, c->plans, plans);
    mpz_clear(plans);
}

static void count_shard(tn_job *job, const tn_shard_set *set, uint32_t shard, counted *c, tn_buffer *claims)
{
    tn_claimant by;
    char *claim = tn_shard_path(set, shard, TN_SHARD_CLAIM);
    if (tn_shard_recorded(set, shard)) {
        count_held(job, set, shard, c);
    } else if (claim && tn_claim_read(claim, &by)) {
        bool stale = fabs(by.age) > c->stale_after;
        c->claimed++;
        c->stale += stale;
        if (c->claimed <= SHOWN_MOST)
            tn_buffer_append(claims, (const char *)&(uint32_t){shard}, sizeof shard);
    }
    free(claim);
}

static void show_claims(const tn_shard_set *set, const counted *c, const tn_buffer *claims, FILE *out)
{
    for (size_t at = 0; at < claims->size; at += sizeof(uint32_t)) {
        uint32_t shard;
        tn_claimant by;
        memcpy(&shard, claims->data + at, sizeof shard);
        char *path = tn_shard_path(set, shard, TN_SHARD_CLAIM);
        if (path && tn_claim_read(path, &by))
            show_claim(set, shard, &by, fabs(by.age) > c->stale_after, out);
        free(path);
    }
    if (c->claimed > SHOWN_MOST)
        fprintf(out, "  and %u more\n", c->claimed - SHOWN_MOST);
}

static void show_number(const char *before, const mpz_t number, const char *behind, FILE *out)
{
    char *digits = tn_digits(number, true);
    fprintf(out, "%s%s%s", before, digits ? digits : "?", behind);
    free(digits);
}

static void show_status(const tn_shard_set *set, const counted *c, const tn_buffer *claims, FILE *out)
{
    mpz_t number;
    mpz_init(number);
    fprintf(out, "shards  %u of %u\n", c->there, set->count);
    if (!tn_shard_set_answers(set)) {
        tn_shard_set_plans(set, number);
        show_number(tn_shard_set_houses(set) ? "houses  " : "plans   ", c->plans, " of ", out);
        show_number("", number, "\n", out);
    }
    mpz_set_ui(number, c->bytes);
    show_number("bytes   ", number, "\n", out);
    fprintf(out, "claimed %u%s\n", c->claimed, c->stale ? ", some by workers that are gone" : "");
    show_claims(set, c, claims, out);
    mpz_clear(number);
}

/* ---- plans that could not be read */

static void show_complaint(const char *path, const tn_error *complaint, uint64_t before, FILE *out)
{
    fprintf(out, "  ");
    tn_write_clean(out, path, strlen(path));
    fprintf(out, ":%" PRIu64 ":%u: ", before + complaint->line, complaint->column);
    tn_write_clean(out, complaint->message, strlen(complaint->message));
    fprintf(out, "\n");
}

/* Those of a shard; *shown: of all shards so far. */
static tn_status show_shard_unread(const tn_shards_open *open, uint32_t shard, uint64_t *shown, FILE *out,
                                   tn_error *error)
{
    const tn_shard_set *set = &open->set;
    uint64_t before;
    tn_shard_read *read = calloc(1, sizeof *read);
    tn_status status = read ? tn_shard_read_of(set, shard, read, error) : tn_fail_memory(error);
    if (status == TN_OK && read->unread > 0) {
        status = tn_shard_lines_before(set, open->answering.schema, shard, &before, error);
        for (size_t i = 0; status == TN_OK && i < read->unread && i < TN_COMPLAINTS_KEPT && *shown < COMPLAINTS_MOST;
             i++, ++*shown)
            show_complaint(set->inputs.items[set->inputs.pieces[shard].input].path, &read->complaints[i], before, out);
    }
    free(read);
    return status;
}

/* The lines are those of the whole files, which the module is needed to count where shards are missing. */
static void show_unread(tn_job *job, tn_shards_open *open, const counted *c, FILE *out)
{
    uint64_t shown = 0;
    tn_error error;
    tn_status status = TN_OK;
    if (c->unread == 0 || !tn_shards_open_rules(job, open))
        return;
    fprintf(out, "unread  %" PRIu64 "\n", c->unread);
    for (uint32_t i = 0; status == TN_OK && shown < COMPLAINTS_MOST && i < open->set.count; i++)
        if (tn_shard_recorded(&open->set, i) && tn_shard_done(&open->set, i, NULL) == TN_OK)
            status = show_shard_unread(open, i, &shown, out, &error);
    if (status != TN_OK)
        tn_job_fail(job, &error);
    else if (shown < c->unread)
        fprintf(out, "  and %" PRIu64 " more\n", c->unread - shown);
}

void tn_shards_status(tn_job *job, tn_shards_open *open)
{
    counted c = {0};
    tn_buffer claims = {0};
    tn_output output;
    const char *path = tn_shards_settings_of(job)->written.output;
    if (!tn_shards_stale(job, &c.stale_after) || !tn_job_writes(job, "the state of a set", path, TN_WRITES_TEXT) ||
        !tn_job_output(job, path, &output))
        return;
    mpz_init(c.plans);
    for (uint32_t i = 0; i < open->set.count; i++)
        count_shard(job, &open->set, i, &c, &claims);
    say_more_wrong(job, c.wrong);
    show_status(&open->set, &c, &claims, output.stream);
    show_unread(job, open, &c, output.stream);
    tn_job_commit(job, &output);
    mpz_clear(c.plans);
    free(claims.data);
}

/* ---- check */

typedef struct checking {
    const tn_shards_open *open;
    tn_watch *watch;
    bool *wrong; /* [shards] */
} checking;

static tn_status check_one(void *context, unsigned thread, size_t item, tn_error *error)
{
    (void)thread;
    checking *c = context;
    uint32_t shard = (uint32_t)item;
    if (!tn_shard_exists(&c->open->set, shard))
        return TN_OK; /* said for all together */
    tn_status status = tn_shard_check(&c->open->set, &c->open->ready, shard, c->watch, error);
    c->wrong[item] = status != TN_OK;
    return status == TN_STOPPED ? status : TN_OK;
}

/* Says what is wrong with the shards that were found to be: each is looked at once more, in their order. */
static void report_wrong(tn_job *job, const checking *c)
{
    uint32_t said = 0;
    for (uint32_t i = 0; i < c->open->set.count; i++) {
        tn_error error;
        if (!c->wrong[i] || said++ >= SHOWN_MOST)
            continue;
        if (tn_shard_check(&c->open->set, &c->open->ready, i, c->watch, &error) != TN_OK)
            tn_job_fail(job, &error);
    }
    say_more_wrong(job, said);
}

static tn_status check_all(tn_job *job, checking *c, tn_error *error)
{
    tn_progress progress;
    tn_crew *crew = tn_crew_new(tn_job_threads(&tn_shards_settings_of(job)->plans), c->watch);
    c->wrong = calloc(c->open->set.count, sizeof *c->wrong);
    tn_progress_watch(&progress, "shards checked", c->watch);
    tn_status status =
        crew && c->wrong ? tn_crew_run(crew, c->open->set.count, 1, check_one, c, error) : tn_fail_memory(error);
    tn_progress_unwatch(&progress, c->watch);
    tn_crew_free(crew);
    return status;
}

static void tell(tn_job *job, const tn_shard_set *set)
{
    mpz_t plans;
    tn_output output;
    const char *path = tn_shards_settings_of(job)->written.output;
    if (!tn_job_writes(job, "the state of a set", path, TN_WRITES_TEXT) || !tn_job_output(job, path, &output))
        return;
    mpz_init(plans);
    fprintf(output.stream, "all %u shards are there and whole", set->count);
    if (!tn_shard_set_answers(set)) {
        tn_shard_set_plans(set, plans);
        show_number(": ", plans, tn_shard_set_houses(set) ? " houses" : " plans", output.stream);
    }
    fprintf(output.stream, "\n");
    mpz_clear(plans);
    tn_job_commit(job, &output);
}

void tn_shards_check_set(tn_job *job, tn_shards_open *open)
{
    checking c = {.open = open, .watch = tn_interrupt_waiting()};
    tn_error error;
    tn_status status = check_all(job, &c, &error);
    if (status == TN_OK) {
        report_wrong(job, &c);
        if (tn_shards_complete(&open->set, &error) != TN_OK)
            tn_job_fail(job, &error);
        if (tn_shards_no_strangers(&open->set, &error) != TN_OK)
            tn_job_fail(job, &error);
    } else {
        tn_job_fail(job, &error);
    }
    if (job->exit_code == TN_EXIT_DONE)
        tell(job, &open->set);
    free(c.wrong);
}
