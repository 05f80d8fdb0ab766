/* tartan-mpi: commands that many processes do together, started by mpirun. */
#include <limits.h>
#include <mpi.h>
#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "cli/commands.h"
#include "cli/common/job.h"
#include "cli/common/program.h"
#include "runtime/ranks/ranks.h"

/* ---- ranks by MPI
 *
 * The counter is a number in rank 0's memory, which the others add to by one-sided operations; all else is gathered.
 *
 * MPI is called by one thread at a time. Waiting sleeps: if there are more ranks than processors, those that wait
 * leave them to those that work. Each sleep is a small part of the wait before it, so that little time is lost between
 * the end of a wait and its being seen, whether the wait was short or long. */

#define COUNTERS 3         /* that of this restart, of the one before, and of the next, which is set to 0 meanwhile */
#define SHORT 60           /* bytes that ranks tell each other at once; for more they tell the sizes first */
#define EAGER 50000L       /* nanoseconds of waiting without sleep: about as long as the shortest sleep takes */
#define SLEEP_LEAST 10000L /* nanoseconds */
#define SLEEP_MOST 1000000L
#define SLEEP_PART 16 /* of the wait so far */
#define ATTEND_EVERY 2000000L

/* What a rank tells, where that is short; or how much it is. */
typedef struct told {
    int32_t size; /* -1: more than can be told */
    uint8_t bytes[SHORT];
} told;

typedef struct joined {
    tn_ranks ranks;
    char host[MPI_MAX_PROCESSOR_NAME + 1];
    MPI_Win window;
    uint64_t restarts;
    told *told;          /* [ranks] */
    int *sizes, *begins; /* [ranks] */
    pthread_mutex_t lock;
    pthread_t attendant;
    bool attended;
    atomic_bool leaving;
} joined;

static void sleep_for(long nanoseconds)
{
    nanosleep(&(struct timespec){.tv_nsec = nanoseconds}, NULL);
}

/* ---- the counter */

static uint64_t take(void *context, uint64_t amount)
{
    joined *j = context;
    uint64_t from = 0;
    pthread_mutex_lock(&j->lock);
    MPI_Fetch_and_op(&amount, &from, MPI_UINT64_T, 0, (MPI_Aint)(j->restarts % COUNTERS), MPI_SUM, j->window);
    MPI_Win_flush(0, j->window);
    pthread_mutex_unlock(&j->lock);
    return from;
}

/* The next counter is another one, which nobody uses yet: whoever is behind is at most one restart behind, since all
 * gather between two of them. */
static void restart(void *context)
{
    joined *j = context;
    const uint64_t zero = 0;
    j->restarts++;
    if (j->ranks.rank != 0)
        return;
    pthread_mutex_lock(&j->lock);
    MPI_Accumulate(&zero, 1, MPI_UINT64_T, 0, (MPI_Aint)((j->restarts + 1) % COUNTERS), 1, MPI_UINT64_T, MPI_REPLACE,
                   j->window);
    MPI_Win_flush(0, j->window);
    pthread_mutex_unlock(&j->lock);
}

/* Rank 0 at work answers the others: some networks need the target of a one-sided operation to call MPI. */
static void *attend(void *context)
{
    joined *j = context;
    while (!j->leaving) {
        int there;
        pthread_mutex_lock(&j->lock);
        MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, MPI_STATUS_IGNORE);
        pthread_mutex_unlock(&j->lock);
        sleep_for(ATTEND_EVERY);
    }
    return NULL;
}

/* ---- gathering */

static long nanoseconds_since(const struct timespec *start)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (now.tv_sec - start->tv_sec) * 1000000000L + now.tv_nsec - start->tv_nsec;
}

static bool is_done(joined *j, MPI_Request *request)
{
    int done;
    pthread_mutex_lock(&j->lock);
    MPI_Test(request, &done, MPI_STATUS_IGNORE);
    pthread_mutex_unlock(&j->lock);
    return done;
}

static void wait_for(joined *j, MPI_Request *request)
{
    struct timespec start;
    clock_gettime(CLOCK_MONOTONIC, &start);
    while (!is_done(j, request)) {
        long waited = nanoseconds_since(&start), pause = waited / SLEEP_PART;
        if (waited < EAGER)
            sched_yield();
        else
            sleep_for(pause < SLEEP_LEAST ? SLEEP_LEAST : pause < SLEEP_MOST ? pause : SLEEP_MOST);
    }
}

/* A rank that cannot take part ends all. */
static _Noreturn void give_up(const joined *j, const char *why)
{
    fprintf(stderr, "error: rank %u on %s: %s; begin the job again to go on\n", j->ranks.rank, j->host, why);
    MPI_Abort(MPI_COMM_WORLD, 4);
    abort();
}

/* What is short, and how much there is of what is not. Is all of it short? */
static bool gather_short(joined *j, const void *bytes, size_t size, tn_gathered *all)
{
    MPI_Request request;
    told mine = {.size = size > INT_MAX ? -1 : (int32_t)size};
    if (size > 0 && size <= SHORT)
        memcpy(mine.bytes, bytes, size);
    pthread_mutex_lock(&j->lock);
    MPI_Iallgather(&mine, sizeof mine, MPI_BYTE, j->told, sizeof mine, MPI_BYTE, MPI_COMM_WORLD, &request);
    pthread_mutex_unlock(&j->lock);
    wait_for(j, &request);
    size_t sum = 0;
    bool is_short = true;
    for (unsigned r = 0; r < j->ranks.count; r++) {
        all->begins[r] = sum;
        j->sizes[r] = j->told[r].size;
        if (j->sizes[r] < 0 || sum + (size_t)j->sizes[r] > INT_MAX)
            give_up(j, "ranks tell each other more than 2 GB at once");
        j->begins[r] = (int)sum;
        sum += (size_t)j->sizes[r];
        is_short &= j->sizes[r] <= SHORT;
    }
    all->begins[j->ranks.count] = sum;
    return is_short;
}

static void gather(void *context, const void *bytes, size_t size, tn_gathered *all)
{
    joined *j = context;
    MPI_Request request;
    all->begins = calloc((size_t)j->ranks.count + 1, sizeof *all->begins);
    if (!all->begins)
        give_up(j, "out of memory");
    bool is_short = gather_short(j, bytes, size, all);
    all->bytes = malloc(all->begins[j->ranks.count] + 1);
    if (!all->bytes)
        give_up(j, "out of memory");
    for (unsigned r = 0; is_short && r < j->ranks.count; r++)
        memcpy(all->bytes + all->begins[r], j->told[r].bytes, (size_t)j->sizes[r]);
    if (is_short)
        return;
    pthread_mutex_lock(&j->lock);
    MPI_Iallgatherv(bytes, (int)size, MPI_BYTE, all->bytes, j->sizes, j->begins, MPI_BYTE, MPI_COMM_WORLD, &request);
    pthread_mutex_unlock(&j->lock);
    wait_for(j, &request);
}

/* ---- joining and leaving */

/* More ranks on a machine than it lets them use processors are spare: where two share one, each finds what the other
 * left of the caches. The processors are those that any of these ranks may use, since a launcher may bind each to its
 * own. */
static bool is_spare(void)
{
    MPI_Comm here;
    cpu_set_t mine, all;
    int place;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
    MPI_Comm_rank(here, &place);
    CPU_ZERO(&mine);
    bool known = sched_getaffinity(0, sizeof mine, &mine) == 0;
    MPI_Allreduce(&mine, &all, sizeof mine, MPI_BYTE, MPI_BOR, here);
    MPI_Comm_free(&here);
    return known && place >= CPU_COUNT(&all) && CPU_COUNT(&all) > 0;
}

static void make_counters(joined *j)
{
    uint64_t *counters;
    MPI_Aint room = j->ranks.rank == 0 ? COUNTERS * sizeof *counters : 0;
    MPI_Win_allocate(room, sizeof *counters, MPI_INFO_NULL, MPI_COMM_WORLD, &counters, &j->window);
    if (j->ranks.rank == 0) {
        MPI_Win_lock(MPI_LOCK_EXCLUSIVE, 0, 0, j->window);
        memset(counters, 0, COUNTERS * sizeof *counters);
        MPI_Win_unlock(0, j->window);
    }
    MPI_Barrier(MPI_COMM_WORLD);
    MPI_Win_lock_all(0, j->window);
}

/* Joins the other processes of the job. NULL where MPI cannot be used; it says why itself. Leave by mpi_leave. */
static const tn_ranks *mpi_join(void)
{
    int level, rank, count, length;
    if (MPI_Init_thread(NULL, NULL, MPI_THREAD_SERIALIZED, &level) != MPI_SUCCESS)
        return NULL;
    joined *j = calloc(1, sizeof *j);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &count);
    if (j) {
        j->told = calloc((size_t)count, sizeof *j->told);
        j->sizes = calloc((size_t)count, sizeof *j->sizes);
        j->begins = calloc((size_t)count, sizeof *j->begins);
    }
    if (level < MPI_THREAD_SERIALIZED || !j || !j->told || !j->sizes || !j->begins) {
        fprintf(stderr, "error: rank %d: %s\n", rank,
                level < MPI_THREAD_SERIALIZED ? "this MPI does not let several threads call it" : "out of memory");
        MPI_Abort(MPI_COMM_WORLD, 4);
        return NULL;
    }
    MPI_Get_processor_name(j->host, &length);
    j->ranks = (tn_ranks){.context = j,
                          .rank = (unsigned)rank,
                          .count = (unsigned)count,
                          .host = j->host,
                          .take = take,
                          .restart = restart,
                          .gather = gather};
    j->ranks.spare = is_spare();
    pthread_mutex_init(&j->lock, NULL);
    make_counters(j);
    j->attended = rank == 0 && count > 1 && pthread_create(&j->attendant, NULL, attend, j) == 0;
    return &j->ranks;
}

/* Together: leaves the job. NULL is fine. */
static void mpi_leave(const tn_ranks *ranks)
{
    if (!ranks)
        return;
    joined *j = ranks->context;
    j->leaving = true;
    if (j->attended)
        pthread_join(j->attendant, NULL);
    MPI_Win_unlock_all(j->window);
    MPI_Win_free(&j->window);
    MPI_Finalize();
    pthread_mutex_destroy(&j->lock);
    free(j->told);
    free(j->sizes);
    free(j->begins);
    free(j);
}

/* ---- the program */

static const char usage[] =
    "tartan-mpi: commands of tartan that many processes do together\n\n"
    "Usage:\n"
    "  mpirun -n N tartan-mpi shards run SET [options]\n"
    "  mpirun -n N tartan-mpi evolve STUDY.study [options]\n"
    "  tartan-mpi --help\n"
    "  tartan-mpi --version\n\n"
    "Options are those of `tartan shards run` and `tartan evolve`: `tartan help shards` lists them.\n"
    "--threads is the number of threads of each process, and 1 where it is not given.\n"
    "The results have the same bytes as those of tartan, with any number of processes.\n";

/* The command that the words name, where it is one of ours. */
static const tn_command *find_command(int count, char **words, tn_error *error)
{
    bool shards = strcmp(words[0], "shards") == 0, runs = count > 1 && strcmp(words[1], "run") == 0;
    if (strcmp(words[0], "evolve") == 0 || (shards && runs))
        return tn_command_find(&tn_all_commands, words[0]);
    tn_fail(error, TN_INVALID, E_USAGE, "tartan-mpi does not know `%.60s%s%.60s`", words[0],
            shards && count > 1 ? " " : "", shards && count > 1 ? words[1] : "");
    tn_error_help(error, tn_command_find(&tn_all_commands, words[0])
                             ? "it does `shards run` and `evolve`; `tartan` does the rest"
                             : "it does `shards run` and `evolve`");
    return NULL;
}

/* Do all ranks run the same program, with the same words? */
static tn_status same_program(const tn_ranks *ranks, int count, char **words, tn_error *error)
{
    char *line = NULL;
    size_t size;
    FILE *out = open_memstream(&line, &size);
    for (int i = 0; out && i < count; i++)
        fprintf(out, "%s%s", i ? " " : "", words[i]);
    if (out)
        fclose(out);
    tn_status status = tn_ranks_agree(ranks, line ? TN_OK : tn_fail_memory(error), error);
    if (status == TN_OK)
        status = tn_ranks_same(ranks, "the version of Tartan", TARTAN_VERSION, error);
    if (status == TN_OK)
        status = tn_ranks_same(ranks, "the command", line, error);
    free(line);
    return status;
}

static int run(const tn_ranks *ranks, int count, char **words)
{
    const tn_settings settings = {.diagnostics = tn_options_diagnostics(count, words), .ranks = ranks};
    tn_error error;
    const tn_command *command = NULL;
    if (same_program(ranks, count, words, &error) == TN_OK)
        command = find_command(count, words, &error);
    return command ? tn_program_run(&tn_all_commands, command, count - 1, words + 1, ranks)
                   : tn_program_refuse(&settings, &error);
}

int main(int argc, char **argv)
{
    tn_program_begin();
    if (argc < 2) {
        fputs(usage, stderr);
        return TN_EXIT_USAGE;
    }
    bool help = strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0 || strcmp(argv[1], "help") == 0;
    if (help || strcmp(argv[1], "--version") == 0) {
        fputs(help ? usage : "tartan-mpi " TARTAN_VERSION "\n", stdout);
        return tn_program_printed();
    }
    const tn_ranks *ranks = mpi_join();
    int exit_code = ranks ? run(ranks, argc - 1, argv + 1) : TN_EXIT_INTERNAL;
    mpi_leave(ranks);
    return exit_code;
}
