#include "driver/sift.h"

#include <stdlib.h>
#include <string.h>

/* A batch ends at so many plans or so many trays, whichever comes first. */
enum { BATCH_PLANS = 65536, BATCH_TRAYS = 1 << 22 };

/* Steps of automata (a tray, a rule) below which waking the other threads takes longer than doing without them. */
#define STEPS_WORTH_THREADS 4000000u

typedef struct sift {
    tn_plan_reader *reader;
    const tn_rules *rules;
    const tn_sift_calls *calls;
    size_t words; /* of result bits a plan */
    tn_matcher **matchers;
    int threads;
    bool interprets; /* some rule has no automaton: then every plan is work enough */
    tn_tray *trays;  /* of all plans of the batch, one after another */
    size_t tray_count, tray_room;
    size_t *starts; /* of plan i in trays; one past the last too */
    uint64_t *lines, *bits;
    tn_status *statuses;
    size_t count;
    bool at_end, stopped;
} sift;

static tn_status sift_new(sift *s, tn_error *error)
{
    s->words = (tn_rules_count(s->rules) + 63) / 64;
    s->starts = calloc(BATCH_PLANS + 1, sizeof *s->starts);
    s->lines = malloc(sizeof *s->lines * BATCH_PLANS);
    s->bits = calloc(BATCH_PLANS * s->words + 1, sizeof *s->bits);
    s->statuses = calloc(BATCH_PLANS, sizeof *s->statuses);
    s->matchers = calloc((size_t)s->threads, sizeof *s->matchers);
    if (!s->starts || !s->lines || !s->bits || !s->statuses || !s->matchers)
        return tn_fail_memory(error);
    for (size_t i = 0; i < tn_rules_count(s->rules); i++)
        s->interprets |= tn_rules_states(s->rules, i) == 0;
    tn_status status = TN_OK;
    for (int i = 0; status == TN_OK && i < s->threads; i++)
        status = tn_matcher_new(s->rules, &s->matchers[i], error);
    return status;
}

static void sift_free(sift *s)
{
    for (int i = 0; s->matchers && i < s->threads; i++)
        tn_matcher_free(s->matchers[i]);
    free(s->matchers);
    free(s->trays);
    free(s->starts);
    free(s->lines);
    free(s->bits);
    free(s->statuses);
}

static bool append(sift *s, const tn_plan *plan)
{
    if (s->tray_room - s->tray_count < plan->length || !s->trays) {
        size_t room = (s->tray_count + plan->length + 1024) * 2;
        tn_tray *trays = realloc(s->trays, sizeof *trays * room);
        if (!trays)
            return false;
        s->trays = trays;
        s->tray_room = room;
    }
    if (plan->length)
        memcpy(s->trays + s->tray_count, plan->trays, sizeof *s->trays * plan->length);
    s->tray_count += plan->length;
    s->lines[s->count] = tn_plan_reader_line(s->reader);
    s->starts[++s->count] = s->tray_count;
    return true;
}

/* Matches plans [first, last); statuses says of each what came of it. */
static void match_share(sift *s, size_t first, size_t last, tn_matcher *matcher, tn_error *error)
{
    while (first < last) {
        tn_plan_array plans = {s->trays, s->starts[first], s->starts + first + 1, last - first};
        size_t done;
        tn_status status = tn_match_all(matcher, &plans, s->bits + first * s->words, &done, error);
        for (size_t i = 0; i < done; i++)
            s->statuses[first + i] = TN_OK;
        first += done;
        if (status != TN_OK)
            s->statuses[first++] = status;
    }
}

/* Matches the batch, each thread its share of it, and hands it on. */
static void flush(sift *s)
{
    bool together = s->interprets || s->tray_count * tn_rules_count(s->rules) >= STEPS_WORTH_THREADS;
    int threads = together && s->count > 1 ? s->threads : 1;
    size_t share = (s->count + (size_t)threads - 1) / (size_t)threads;
#pragma omp parallel for num_threads(threads) schedule(static, 1) if (threads > 1)
    for (int t = 0; t < threads; t++) {
        size_t first = share * (size_t)t, last = first + share;
        if (first < s->count)
            match_share(s, first, last < s->count ? last : s->count, s->matchers[t], NULL);
    }
    for (size_t i = 0; i < s->count && !s->stopped; i++) {
        tn_error error;
        if (s->statuses[i] == TN_OK) {
            tn_sifted plan = {s->trays + s->starts[i], s->starts[i + 1] - s->starts[i], s->lines[i],
                              s->bits + i * s->words};
            s->stopped = !s->calls->plan(s->calls->context, &plan);
            continue;
        }
        match_share(s, i, i + 1, s->matchers[0], &error); /* again, for its reason */
        tn_error_place(&error, s->lines[i], 0, 0);
        s->stopped = !s->calls->bad(s->calls->context, &error, NULL, 0);
    }
    s->count = s->tray_count = 0;
}

/* Can the reader go on after this? */
static bool is_about_one_plan(const tn_error *error)
{
    return error->line > 0 && (error->status == TN_INVALID || error->status == TN_LIMIT);
}

/* Fills a batch. A bad plan ends it, so that everything before it is handed on before it is complained about. */
static tn_status fill(sift *s, tn_error *error, bool *bad)
{
    *bad = false;
    while (s->count < BATCH_PLANS && s->tray_count < BATCH_TRAYS) {
        const tn_plan *plan;
        tn_status status = tn_plan_reader_next(s->reader, &plan, error);
        if (status != TN_OK) {
            *bad = is_about_one_plan(error);
            return *bad ? TN_OK : status;
        }
        if (!plan) {
            s->at_end = true;
            return TN_OK;
        }
        if (!append(s, plan))
            return tn_fail_memory(error);
    }
    return TN_OK;
}

static tn_status run(sift *s, tn_error *error)
{
    while (!s->at_end && !s->stopped) {
        bool bad;
        tn_status status = fill(s, error, &bad);
        flush(s);
        if (status != TN_OK)
            return status;
        if (bad && !s->stopped) {
            size_t size = 0;
            const char *text = tn_plan_reader_text(s->reader, &size);
            s->stopped = !s->calls->bad(s->calls->context, error, text, size);
        }
    }
    return TN_OK;
}

tn_status tn_sift(tn_plan_reader *reader, const tn_rules *rules, int threads, const tn_sift_calls *calls,
                  tn_error *error)
{
    sift s = {.reader = reader, .rules = rules, .calls = calls, .threads = threads};
    tn_status status = sift_new(&s, error);
    if (status == TN_OK)
        status = run(&s, error);
    sift_free(&s);
    return status;
}
