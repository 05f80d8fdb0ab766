/* Each thread takes a chunk of the input, reads and matches it, and hands it on when its turn has come: taking and
 * handing on are one thread's at a time, in the order of the input, and everything between is done side by side. Lines
 * of text are taken unread, so that reading them is side by side too; other formats are read while they are taken. */
#include "driver/sift.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

/* A batch ends at so many plans or so many trays, whichever comes first. */
enum { BATCH_PLANS = 8192, BATCH_TRAYS = 1 << 20 };

/* What a thread takes at a time: of text, enough that taking turns costs nothing beside reading it; where plans are
 * interpreted, each is so much work that a few are enough. */
enum { CHUNK_BYTES = 256 << 10, CHUNK_BYTES_INTERPRETED = 8 << 10, BATCH_INTERPRETED = 64 };

typedef struct sift {
    tn_plan_reader *reader;
    const tn_rules *rules;
    const tn_sift_calls *calls;
    size_t words;     /* of result bits a plan */
    bool interpreted; /* some rule has no automaton */

    pthread_mutex_t taking; /* holds the reader, taken, at_end */
    uint64_t taken;         /* chunks */
    bool at_end;

    pthread_mutex_t turning; /* holds turn, stopped, status, error */
    pthread_cond_t turned;
    uint64_t turn; /* the chunk to be handed on next */
    bool stopped;
    tn_status status;
    tn_error *error;
} sift;

typedef struct worker {
    sift *s;
    pthread_t thread;
    tn_matcher *matcher;
    tn_plan_lines *lines;
    uint64_t chunk; /* its number */
    bool text;      /* the chunk is lines, not yet read */
    bool has_turn;
    tn_tray *trays; /* of all plans of the batch, one after another */
    size_t tray_count, tray_room;
    size_t *starts; /* of plan i in trays; one past the last too */
    uint64_t *numbers, *bits;
    tn_status *statuses;
    size_t count, batch; /* plans in the batch, and at most */
    tn_status status;    /* TN_OK, or why the batch ended before the end of the chunk */
    tn_error error;
    tn_buffer bad; /* the text of the plan that is to blame, where it was not among lines taken */
} worker;

static void worker_clear(worker *w)
{
    tn_matcher_free(w->matcher);
    tn_plan_lines_free(w->lines);
    free(w->trays);
    free(w->starts);
    free(w->numbers);
    free(w->bits);
    free(w->statuses);
    free(w->bad.data);
}

static tn_status worker_start(worker *w, sift *s, tn_error *error)
{
    *w = (worker){.s = s, .batch = s->interpreted ? BATCH_INTERPRETED : BATCH_PLANS};
    w->starts = calloc(w->batch + 1, sizeof *w->starts);
    w->numbers = malloc(w->batch * sizeof *w->numbers);
    w->bits = calloc(w->batch * s->words + 1, sizeof *w->bits);
    w->statuses = calloc(w->batch, sizeof *w->statuses);
    if (!w->starts || !w->numbers || !w->bits || !w->statuses)
        return tn_fail_memory(error);
    tn_status status = tn_matcher_new(s->rules, &w->matcher, error);
    return status == TN_OK ? tn_plan_lines_new(s->reader, &w->lines, error) : status;
}

/* ---- reading */

static bool append(worker *w, const tn_plan *plan, uint64_t number)
{
    if (w->tray_room - w->tray_count < plan->length || !w->trays) {
        size_t room = (w->tray_count + plan->length + 1024) * 2;
        tn_tray *trays = realloc(w->trays, sizeof *trays * room);
        if (!trays)
            return false;
        w->trays = trays;
        w->tray_room = room;
    }
    if (plan->length)
        memcpy(w->trays + w->tray_count, plan->trays, sizeof *w->trays * plan->length);
    w->tray_count += plan->length;
    w->numbers[w->count] = number;
    w->starts[++w->count] = w->tray_count;
    return true;
}

/* Fills the batch. A bad plan ends it, so that everything before it is handed on before it is complained about. *more:
 * something may follow in this chunk. */
static void read_batch(worker *w, bool *more)
{
    tn_plan_reader *reader = w->s->reader;
    w->count = w->tray_count = 0;
    w->status = TN_OK;
    *more = true;
    while (w->count < w->batch && w->tray_count < BATCH_TRAYS) {
        const tn_plan *plan;
        w->status =
            w->text ? tn_plan_lines_next(w->lines, &plan, &w->error) : tn_plan_reader_next(reader, &plan, &w->error);
        if (w->status != TN_OK)
            return;
        *more = plan != NULL;
        if (!plan)
            return;
        if (!append(w, plan, w->text ? tn_plan_lines_line(w->lines) : tn_plan_reader_line(reader))) {
            w->status = tn_fail_memory(&w->error);
            return;
        }
    }
}

/* Can reading go on after this? */
static bool is_about_one_plan(const tn_error *error)
{
    return error->line > 0 && (error->status == TN_INVALID || error->status == TN_LIMIT);
}

/* Keeps the text that a batch ended at: another thread may have the reader by the time it is shown. */
static void keep_bad_text(worker *w)
{
    size_t size;
    const char *text = tn_plan_reader_text(w->s->reader, &size);
    w->bad.size = 0;
    if (text && !tn_buffer_append(&w->bad, text, size))
        w->status = tn_fail_memory(&w->error);
}

/* Takes the next chunk; false where there is none. */
static bool take(worker *w)
{
    sift *s = w->s;
    bool more = true;
    pthread_mutex_lock(&s->taking);
    bool taken = !s->at_end;
    if (taken) {
        size_t bytes = s->interpreted ? CHUNK_BYTES_INTERPRETED : CHUNK_BYTES;
        w->chunk = s->taken++;
        w->count = 0;
        w->status = tn_plan_lines_take(w->lines, s->reader, bytes, &w->text, &w->error);
        if (w->status == TN_OK && !w->text)
            read_batch(w, &more);
        if (w->status != TN_OK)
            keep_bad_text(w);
        s->at_end = !more || (w->status != TN_OK && !is_about_one_plan(&w->error));
    }
    pthread_mutex_unlock(&s->taking);
    return taken;
}

/* ---- matching */

/* Matches plans [first, last) of the batch; statuses says of each what came of it. */
static void match(worker *w, size_t first, size_t last, tn_error *error)
{
    while (first < last) {
        tn_plan_array plans = {w->trays, w->starts[first], w->starts + first + 1, last - first};
        size_t done;
        tn_status status = tn_match_all(w->matcher, &plans, w->bits + first * w->s->words, &done, error);
        for (size_t i = 0; i < done; i++)
            w->statuses[first + i] = TN_OK;
        first += done;
        if (status != TN_OK)
            w->statuses[first++] = status;
    }
}

/* ---- handing on */

static void wait_for_turn(worker *w)
{
    sift *s = w->s;
    pthread_mutex_lock(&s->turning);
    while (s->turn != w->chunk)
        pthread_cond_wait(&s->turned, &s->turning);
    pthread_mutex_unlock(&s->turning);
    w->has_turn = true;
}

/* Ends the turn. */
static void pass_on(worker *w)
{
    sift *s = w->s;
    pthread_mutex_lock(&s->turning);
    s->turn++;
    bool stopped = s->stopped;
    pthread_cond_broadcast(&s->turned);
    pthread_mutex_unlock(&s->turning);
    w->has_turn = false;
    if (!stopped)
        return;
    pthread_mutex_lock(&s->taking);
    s->at_end = true;
    pthread_mutex_unlock(&s->taking);
}

/* What the batch ended with: a bad plan, or what ends it all. */
static void hand_on_error(worker *w)
{
    sift *s = w->s;
    if (!is_about_one_plan(&w->error)) {
        s->status = w->status;
        if (s->error)
            *s->error = w->error;
        s->stopped = true;
        return;
    }
    size_t size = w->bad.size;
    const char *text = w->text ? tn_plan_lines_text(w->lines, &size) : size > 0 ? w->bad.data : NULL;
    s->stopped = !s->calls->bad(s->calls->context, &w->error, text, size);
}

static void hand_on(worker *w)
{
    sift *s = w->s;
    if (!w->has_turn)
        wait_for_turn(w);
    for (size_t i = 0; i < w->count && !s->stopped; i++) {
        if (w->statuses[i] == TN_OK) {
            tn_sifted plan = {w->trays + w->starts[i], w->starts[i + 1] - w->starts[i], w->numbers[i],
                              w->bits + i * s->words};
            s->stopped = !s->calls->plan(s->calls->context, &plan);
            continue;
        }
        tn_error error;
        match(w, i, i + 1, &error); /* again, for its reason */
        tn_error_place(&error, w->numbers[i], 0, 0);
        s->stopped = !s->calls->bad(s->calls->context, &error, NULL, 0);
    }
    if (w->status != TN_OK && !s->stopped)
        hand_on_error(w);
}

/* A chunk that was taken, to its end. */
static void finish_chunk(worker *w)
{
    bool more = w->text && w->status == TN_OK;
    do {
        if (w->text)
            read_batch(w, &more);
        match(w, 0, w->count, NULL);
        hand_on(w);
    } while (more && w->text && !w->s->stopped);
    pass_on(w);
}

static void *work(void *context)
{
    worker *w = context;
    while (take(w))
        finish_chunk(w);
    return NULL;
}

/* The other threads are started once there is a second chunk to take. */
static void run(sift *s, worker *workers, size_t count)
{
    size_t started = 1;
    bool taken = take(&workers[0]), more = !s->at_end;
    for (; taken && more && started < count; started++)
        if (pthread_create(&workers[started].thread, NULL, work, &workers[started]) != 0)
            break;
    if (taken)
        finish_chunk(&workers[0]);
    work(&workers[0]);
    for (size_t i = 1; i < started; i++)
        pthread_join(workers[i].thread, NULL);
}

tn_status tn_sift(tn_plan_reader *reader, const tn_rules *rules, int threads, const tn_sift_calls *calls,
                  tn_error *error)
{
    sift s = {.reader = reader,
              .rules = rules,
              .calls = calls,
              .words = (tn_rules_count(rules) + 63) / 64,
              .taking = PTHREAD_MUTEX_INITIALIZER,
              .turning = PTHREAD_MUTEX_INITIALIZER,
              .turned = PTHREAD_COND_INITIALIZER,
              .error = error};
    for (size_t i = 0; i < tn_rules_count(rules); i++)
        s.interpreted |= tn_rules_states(rules, i) == 0;
    size_t count = (size_t)threads, made = 0;
    worker *workers = calloc(count, sizeof *workers);
    tn_status status = workers ? TN_OK : tn_fail_memory(error);
    while (status == TN_OK && made < count)
        status = worker_start(&workers[made++], &s, error);
    if (status == TN_OK) {
        run(&s, workers, count);
        status = s.status;
    }
    for (size_t i = 0; i < made; i++)
        worker_clear(&workers[i]);
    free(workers);
    pthread_cond_destroy(&s.turned);
    pthread_mutex_destroy(&s.turning);
    pthread_mutex_destroy(&s.taking);
    return status;
}
