/* Each thread takes a chunk of the input, reads and matches it, writes down what is to be said of its plans, and leaves
 * that to be handed on in order. Lines of a regular file are read from it by all threads side by side; of a
 * pipe they are taken unread, by one thread at a time; other formats are read while they are taken. */
#include "driver/plan/sift.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

static bool relay_stopped(tn_relay *relay);

/* ---- what several threads write, put into order */

struct tn_relay_slot {
    tn_buffer texts[TN_RELAY_TEXTS];
    uint64_t items;
    bool finished;
    bool is_counted;
    uint64_t lines;  /* in the chunk */
    uint64_t before; /* and before it, once it and those before it are counted */
};

tn_status tn_relay_start(tn_relay *relay, size_t room, size_t waiting_max, tn_relay_write *write, void *context,
                         tn_error *error)
{
    *relay = (tn_relay){.write = write, .context = context, .room = room, .waiting_max = waiting_max};
    pthread_mutex_init(&relay->lock, NULL);
    pthread_cond_init(&relay->moved, NULL);
    relay->slots = calloc(room, sizeof *relay->slots);
    return relay->slots ? TN_OK : tn_fail_memory(error);
}

void tn_relay_clear(tn_relay *relay)
{
    free(relay->slots);
    pthread_cond_destroy(&relay->moved);
    pthread_mutex_destroy(&relay->lock);
}

static tn_relay_slot *slot_of(const tn_relay *relay, uint64_t chunk)
{
    return &relay->slots[chunk % relay->room];
}

bool tn_relay_admit(tn_relay *relay, uint64_t chunk)
{
    pthread_mutex_lock(&relay->lock);
    while (!relay->stopped && chunk != relay->turn &&
           (chunk - relay->turn >= relay->room || relay->waiting >= relay->waiting_max))
        pthread_cond_wait(&relay->moved, &relay->lock);
    bool admitted = !relay->stopped;
    pthread_mutex_unlock(&relay->lock);
    return admitted;
}

void tn_relay_count(tn_relay *relay, uint64_t chunk, uint64_t lines)
{
    pthread_mutex_lock(&relay->lock);
    slot_of(relay, chunk)->lines = lines;
    slot_of(relay, chunk)->is_counted = true;
    for (tn_relay_slot *slot; (slot = slot_of(relay, relay->counted))->is_counted; relay->counted++) {
        slot->is_counted = false;
        slot->before = relay->lines;
        relay->lines += slot->lines;
    }
    pthread_cond_broadcast(&relay->moved);
    pthread_mutex_unlock(&relay->lock);
}

uint64_t tn_relay_lines_before(tn_relay *relay, uint64_t chunk)
{
    pthread_mutex_lock(&relay->lock);
    while (relay->counted <= chunk)
        pthread_cond_wait(&relay->moved, &relay->lock);
    uint64_t before = slot_of(relay, chunk)->before;
    pthread_mutex_unlock(&relay->lock);
    return before;
}

void tn_relay_wait(tn_relay *relay, uint64_t chunk)
{
    pthread_mutex_lock(&relay->lock);
    while (relay->turn != chunk)
        pthread_cond_wait(&relay->moved, &relay->lock);
    pthread_mutex_unlock(&relay->lock);
}

void tn_relay_now(tn_relay *relay, uint64_t items, tn_buffer texts[TN_RELAY_TEXTS])
{
    if (!relay_stopped(relay) && !relay->write(relay->context, items, texts))
        tn_relay_stop(relay);
    for (size_t t = 0; t < TN_RELAY_TEXTS; t++)
        texts[t].size = 0;
}

void tn_relay_stop(tn_relay *relay)
{
    pthread_mutex_lock(&relay->lock);
    relay->stopped = true;
    pthread_cond_broadcast(&relay->moved);
    pthread_mutex_unlock(&relay->lock);
}

static bool relay_stopped(tn_relay *relay)
{
    pthread_mutex_lock(&relay->lock);
    bool stopped = relay->stopped;
    pthread_mutex_unlock(&relay->lock);
    return stopped;
}

/* Bytes of the texts of a chunk. */
static size_t size_of(const tn_relay_slot *slot)
{
    size_t size = 0;
    for (size_t t = 0; t < TN_RELAY_TEXTS; t++)
        size += slot->texts[t].size;
    return size;
}

/* Another has the turn: leaves the texts to it. */
static void leave(tn_relay *relay, tn_relay_slot *slot, uint64_t items, tn_buffer texts[TN_RELAY_TEXTS])
{
    slot->items = items;
    for (size_t t = 0; t < TN_RELAY_TEXTS; t++) {
        slot->texts[t] = texts[t];
        texts[t] = (tn_buffer){0};
    }
    slot->finished = true;
    relay->waiting += size_of(slot);
}

static void next_turn(tn_relay *relay)
{
    relay->turn++;
    pthread_cond_broadcast(&relay->moved);
}

/* Hands on the chunk whose turn it is, which is finished. The lock is held before and after. */
static void hand_on(tn_relay *relay, tn_relay_slot *slot)
{
    size_t size = size_of(slot);
    pthread_mutex_unlock(&relay->lock);
    tn_relay_now(relay, slot->items, slot->texts);
    for (size_t t = 0; t < TN_RELAY_TEXTS; t++)
        free(slot->texts[t].data);
    pthread_mutex_lock(&relay->lock);
    slot->finished = false;
    relay->waiting -= size;
    next_turn(relay);
}

void tn_relay_pass(tn_relay *relay, uint64_t chunk, uint64_t items, tn_buffer texts[TN_RELAY_TEXTS])
{
    pthread_mutex_lock(&relay->lock);
    if (relay->turn != chunk) {
        leave(relay, slot_of(relay, chunk), items, texts);
        pthread_mutex_unlock(&relay->lock);
        return;
    }
    pthread_mutex_unlock(&relay->lock);
    tn_relay_now(relay, items, texts);
    pthread_mutex_lock(&relay->lock);
    next_turn(relay);
    for (tn_relay_slot *slot; (slot = slot_of(relay, relay->turn))->finished;)
        hand_on(relay, slot);
    pthread_mutex_unlock(&relay->lock);
}

/* ---- sifting */

/* A batch ends at so many plans or so many trays, whichever comes first. */
enum { BATCH_PLANS = 8192, BATCH_TRAYS = 1 << 20 };

/* What a thread takes at a time: of text, enough that taking turns costs nothing beside reading it, and little enough
 * to stay in its cache; where plans are interpreted, each is so much work that a few are enough. */
enum { CHUNK_BYTES = 256 << 10, CHUNK_BYTES_INTERPRETED = 8 << 10, BATCH_INTERPRETED = 64 };

/* For each thread: chunks under way (a thread that the system stops for some milliseconds holds nobody up), bytes of
 * their texts that wait to be written, and a chunk's own text at most, before it is written in its turn. */
enum { CHUNKS_AHEAD = 32, WAITING_BYTES = 4 << 20, TEXT_BYTES = 1 << 20 };

typedef struct sift {
    tn_plan_reader *reader;
    const tn_rules *rules;
    const tn_sift_calls *calls;
    size_t words;       /* of result bits a plan */
    size_t chunk_bytes; /* of text */
    size_t batch;       /* plans at most */
    uint64_t shared;    /* bytes of the file that all threads read; 0: they take from the reader */
    tn_relay relay;

    pthread_mutex_t taking; /* holds the reader, taken, at_end */
    uint64_t taken;         /* chunks */
    bool at_end;

    tn_status status; /* these two are written by the thread whose turn it is */
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
    uint64_t before; /* lines of the file before those of the chunk, once they are needed and where it does not know */
    tn_tray *trays;  /* of all plans of the batch, one after another */
    size_t tray_count, tray_room;
    size_t *starts; /* of plan i in trays; one past the last too */
    uint64_t *numbers, *bits;
    uint8_t *some; /* of plans: does any rule match? NULL where that is not what is asked for */
    tn_status *statuses;
    size_t count;     /* plans in the batch */
    tn_status status; /* TN_OK, or why the batch ended before the end of the chunk */
    tn_error error;
    tn_buffer bad; /* the text of the plan that is to blame, where it was not among lines taken */
    tn_buffer texts[TN_RELAY_TEXTS];
    uint64_t told; /* plans that the texts are about */
} worker;

static void worker_clear(worker *w)
{
    tn_matcher_free(w->matcher);
    tn_plan_lines_free(w->lines);
    free(w->trays);
    free(w->starts);
    free(w->numbers);
    free(w->bits);
    free(w->some);
    free(w->statuses);
    free(w->bad.data);
    for (size_t t = 0; t < TN_RELAY_TEXTS; t++)
        free(w->texts[t].data);
}

static tn_status worker_start(worker *w, sift *s, tn_error *error)
{
    *w = (worker){.s = s};
    w->starts = calloc(s->batch + 1, sizeof *w->starts);
    w->numbers = malloc(s->batch * sizeof *w->numbers);
    w->bits = calloc(s->batch * s->words + 1, sizeof *w->bits);
    w->statuses = calloc(s->batch, sizeof *w->statuses);
    w->some = s->calls->any ? malloc(s->batch) : NULL;
    if (!w->starts || !w->numbers || !w->bits || !w->statuses || (s->calls->any && !w->some))
        return tn_fail_memory(error);
    tn_status status = tn_matcher_new(s->rules, &w->matcher, error);
    return status == TN_OK ? tn_plan_lines_new(s->reader, &w->lines, error) : status;
}

/* ---- reading */

static bool append(worker *w, const tn_plan *plan, uint64_t number)
{
    if (!tn_array_reserve_from(&w->trays, &w->tray_room, 2048, w->tray_count, plan->length + 1, sizeof *w->trays))
        return false;
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
    while (w->count < w->s->batch && w->tray_count < BATCH_TRAYS) {
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

/* Takes what comes next from the reader; false where that was the last of it. */
static bool take_from_reader(worker *w)
{
    sift *s = w->s;
    bool more = true;
    w->status = tn_plan_lines_take(w->lines, s->reader, s->chunk_bytes, &w->text, &w->error);
    if (w->status == TN_OK && !w->text)
        read_batch(w, &more);
    if (w->status != TN_OK)
        keep_bad_text(w);
    return more && (w->status == TN_OK || is_about_one_plan(&w->error));
}

/* Reads the chunk that was taken, where threads do that themselves. */
static void read_shared(worker *w)
{
    sift *s = w->s;
    uint64_t count;
    w->text = true;
    w->status = tn_plan_lines_read(w->lines, s->reader, w->chunk * s->chunk_bytes, s->chunk_bytes, &count, &w->error);
    tn_relay_count(&s->relay, w->chunk, count);
}

/* Takes the next chunk; false where there is none. */
static bool take(worker *w)
{
    sift *s = w->s;
    pthread_mutex_lock(&s->taking);
    bool taken = !s->at_end && tn_relay_admit(&s->relay, s->taken);
    if (taken) {
        w->chunk = s->taken++;
        w->count = 0;
        w->before = 0;
        s->at_end = s->shared ? s->taken * s->chunk_bytes >= s->shared : !take_from_reader(w);
    }
    pthread_mutex_unlock(&s->taking);
    if (taken && s->shared)
        read_shared(w);
    return taken;
}

/* ---- matching */

/* Matches plans from the first on; *done: how many. */
static tn_status match_some(worker *w, const tn_plan_array *plans, size_t first, size_t *done, tn_error *error)
{
    if (!w->some)
        return tn_match_all(w->matcher, plans, w->bits + first * w->s->words, done, error);
    tn_status status = tn_match_any(w->matcher, plans, w->some, done, error);
    for (size_t i = 0; i < *done; i++)
        w->bits[first + i] = w->some[i];
    return status;
}

/* Matches plans [first, last) of the batch; statuses says of each what came of it. */
static void match(worker *w, size_t first, size_t last, tn_error *error)
{
    while (first < last) {
        tn_plan_array plans = {w->trays, w->starts[first], w->starts + first + 1, last - first};
        size_t done;
        tn_status status = match_some(w, &plans, first, &done, error);
        for (size_t i = 0; i < done; i++)
            w->statuses[first + i] = TN_OK;
        first += done;
        if (status != TN_OK)
            w->statuses[first++] = status;
    }
}

/* ---- handing on */

static void find_lines_before(worker *w)
{
    if (w->s->shared)
        w->before = tn_relay_lines_before(&w->s->relay, w->chunk);
}

/* From here on, what the thread says is said at once. */
static void take_turn(worker *w)
{
    if (!w->has_turn)
        tn_relay_wait(&w->s->relay, w->chunk);
    w->has_turn = true;
    tn_relay_now(&w->s->relay, w->told, w->texts);
    w->told = 0;
}

/* Ends it all. */
static void give_up(worker *w, tn_status status, const tn_error *error)
{
    sift *s = w->s;
    take_turn(w);
    if (relay_stopped(&s->relay))
        return;
    s->status = status;
    if (s->error)
        *s->error = *error;
    tn_relay_stop(&s->relay);
}

/* A plan that is not for matching is complained about in its turn. */
static void complain(worker *w, const tn_error *error, const char *text, size_t size)
{
    tn_relay *relay = &w->s->relay;
    take_turn(w);
    if (!relay_stopped(relay) && !w->s->calls->bad(w->s->calls->context, error, text, size))
        tn_relay_stop(relay);
}

/* What the batch ended with: a bad plan, or what ends it all. */
static void report_end(worker *w)
{
    if (!is_about_one_plan(&w->error)) {
        give_up(w, w->status, &w->error);
        return;
    }
    size_t size = w->bad.size;
    const char *text = w->text ? tn_plan_lines_text(w->lines, &size) : size > 0 ? w->bad.data : NULL;
    find_lines_before(w);
    w->error.line += w->before;
    complain(w, &w->error, text, size);
}

static void report_plan(worker *w, size_t i)
{
    const tn_sift_calls *calls = w->s->calls;
    tn_sifted plan = {w->trays + w->starts[i], w->starts[i + 1] - w->starts[i], w->numbers[i] + w->before,
                      w->bits + i * w->s->words};
    tn_error error;
    w->told++;
    if (!calls->plan(calls->context, &plan, w->texts))
        give_up(w, tn_fail_memory(&error), &error);
    else if (w->texts[0].size + w->texts[1].size > TEXT_BYTES)
        take_turn(w);
}

static void report_unmatched(worker *w, size_t i)
{
    tn_error error;
    match(w, i, i + 1, &error); /* again, for its reason */
    if (w->statuses[i] == TN_OK) {
        report_plan(w, i); /* memory was short, and now is not */
        return;
    }
    find_lines_before(w);
    tn_error_place(&error, w->numbers[i] + w->before, 0, 0);
    complain(w, &error, NULL, 0);
}

/* Says what there is to say of the batch; false where no more is wanted. */
static bool report(worker *w)
{
    sift *s = w->s;
    bool stopped = false;
    if (s->calls->numbered)
        find_lines_before(w);
    for (size_t i = 0; i < w->count && !stopped; i++) {
        if (w->statuses[i] == TN_OK)
            report_plan(w, i);
        else
            report_unmatched(w, i);
        stopped = w->has_turn && relay_stopped(&s->relay);
    }
    if (w->status != TN_OK && !stopped)
        report_end(w);
    return !w->has_turn || !relay_stopped(&s->relay);
}

/* A chunk that was taken, to its end. */
static void finish_chunk(worker *w)
{
    bool more = w->text && w->status == TN_OK;
    do {
        if (more)
            read_batch(w, &more);
        match(w, 0, w->count, NULL);
    } while (report(w) && more);
    tn_relay_pass(&w->s->relay, w->chunk, w->told, w->texts);
    w->told = 0;
    w->has_turn = false;
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

static tn_status start_and_run(sift *s, worker *workers, size_t count, tn_error *error)
{
    size_t made = 0;
    tn_status status = tn_relay_start(&s->relay, count * CHUNKS_AHEAD, count * WAITING_BYTES, s->calls->write,
                                      s->calls->context, error);
    while (status == TN_OK && made < count)
        status = worker_start(&workers[made++], s, error);
    if (status == TN_OK) {
        run(s, workers, count);
        status = s->status;
        if (status == TN_OK)
            status = tn_plan_reader_unchanged(s->reader, error);
        if (s->calls->lines)
            *s->calls->lines = s->shared ? s->relay.lines : tn_plan_reader_line(s->reader);
    }
    for (size_t i = 0; i < made; i++)
        worker_clear(&workers[i]);
    tn_relay_clear(&s->relay);
    return status;
}

tn_status tn_sift(tn_plan_reader *reader, const tn_rules *rules, int threads, const tn_sift_calls *calls,
                  tn_error *error)
{
    bool interpreted = false; /* some rule has no automaton */
    for (size_t i = 0; i < tn_rules_count(rules); i++)
        interpreted |= tn_rules_states(rules, i) == 0;
    sift s = {.reader = reader,
              .rules = rules,
              .calls = calls,
              .words = calls->any ? 1 : (tn_rules_count(rules) + 63) / 64,
              .chunk_bytes = interpreted ? CHUNK_BYTES_INTERPRETED : CHUNK_BYTES,
              .batch = interpreted ? BATCH_INTERPRETED : BATCH_PLANS,
              .shared = tn_plan_reader_share(reader),
              .taking = PTHREAD_MUTEX_INITIALIZER,
              .error = error};
    size_t count = (size_t)threads;
    worker *workers = calloc(count, sizeof *workers);
    tn_status status = workers ? start_and_run(&s, workers, count, error) : tn_fail_memory(error);
    free(workers);
    pthread_mutex_destroy(&s.taking);
    return status;
}
