/* A library's automaton joined with what measures remember, and what a sum asks of the whole plan. */
#include "runtime/plan/measure/weighed.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/plan/library/library_data.h"
#include "runtime/plan/match/lower.h"
#include "runtime/plan/match/summing.h"
#include "runtime/plan/measure/named.h"
#include "runtime/plan/schema/sum.h"

#define TN_GAPS_MAX 1000u /* different lengths of gaps: more are E0802 */

typedef struct tn_weighed_asked {
    tn_dfa *dfa;
    int64_t each; /* steps of a plan that it accepts */
    bool needed;  /* of one that it does not accept the sum has no value */
} tn_weighed_asked;

typedef struct tn_weighed_whole {
    tn_weighed_asked *items;
    size_t count, room;
} tn_weighed_whole;

/* ---- what a sum asks of the whole plan, as automata */

static tn_status add(tn_weighed_whole *whole, tn_dfa *dfa, int64_t each, bool needed, tn_error *error)
{
    if (!tn_array_reserve(&whole->items, &whole->room, whole->count, 1, sizeof *whole->items)) {
        tn_dfa_free(dfa);
        return tn_fail_memory(error);
    }
    whole->items[whole->count++] = (tn_weighed_asked){.dfa = dfa, .each = each, .needed = needed};
    return TN_OK;
}

/* ---- gaps */

/* A gap's term made ready. Lengths are in parts: what all trays' lengths are whole times of. */
typedef struct gaps {
    const tn_marked *marked;
    const tn_sum_term *term;
    tn_dfa *source, *destination;
    uint64_t *counts; /* [classes]: parts of a tray */
    int64_t part;     /* steps */
    uint64_t *length; /* [count]: that gaps can have, ascending */
    size_t count;
} gaps;

static uint64_t divisor(uint64_t a, uint64_t b)
{
    while (b > 0) {
        uint64_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

/* The parts of each class's trays. */
static tn_status find_counts(gaps *g, const tn_classes *classes, tn_error *error)
{
    uint64_t common = 0;
    bool negative = false;
    g->counts = calloc((size_t)classes->count + 1, sizeof *g->counts);
    if (!g->counts)
        return tn_fail_memory(error);
    for (uint32_t c = 0; c < classes->count; c++) {
        int64_t steps = tn_term_steps(g->term, classes->representative[c]);
        negative |= steps < 0;
        g->counts[c] = (uint64_t)llabs(steps);
        common = divisor(common, g->counts[c]);
    }
    common = common ? common : 1;
    for (uint32_t c = 0; c < classes->count; c++)
        g->counts[c] /= common;
    g->part = negative ? -(int64_t)common : (int64_t)common;
    return TN_OK;
}

static tn_status too_many_automata(tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_TOO_MANY_STATES, "gaps can have more than %u different lengths", TN_GAPS_MAX);
    tn_error_help(error, "give fewer trays with --trays, or measure gaps in trays or by a field of rounder lengths");
    return TN_LIMIT;
}

static int compare_lengths(const void *left, const void *right)
{
    uint64_t a = *(const uint64_t *)left, b = *(const uint64_t *)right;
    return (a > b) - (a < b);
}

/* Keeps different lengths only, ascending. */
static size_t unite(uint64_t *length, size_t count)
{
    size_t kept = 0;
    qsort(length, count, sizeof *length, compare_lengths);
    for (size_t i = 0; i < count; i++)
        if (kept == 0 || length[kept - 1] != length[i])
            length[kept++] = length[i];
    return kept;
}

/* The lengths that up to so many trays can have together. */
static tn_status find_lengths(gaps *g, uint32_t classes, uint32_t trays, tn_error *error)
{
    uint64_t *one = malloc(((size_t)classes + 1) * sizeof *one), *more = NULL;
    g->length = calloc(TN_GAPS_MAX + 1, sizeof *g->length);
    if (one) {
        memcpy(one, g->counts, classes * sizeof *one);
        classes = (uint32_t)unite(one, classes);
        more = malloc((size_t)TN_GAPS_MAX * (classes + 1) * sizeof *more);
    }
    tn_status status = more && g->length ? TN_OK : tn_fail_memory(error);
    g->count = 1; /* nothing between */
    for (uint32_t n = 0; status == TN_OK && n < trays; n++) {
        size_t size = g->count;
        memcpy(more, g->length, size * sizeof *more);
        for (size_t i = 0; i < g->count; i++)
            for (uint32_t c = 0; c < classes; c++)
                more[size++] = g->length[i] + one[c];
        size = unite(more, size);
        if (size > TN_GAPS_MAX)
            status = too_many_automata(error);
        else if (size == g->count)
            break;
        else
            memcpy(g->length, more, (g->count = size) * sizeof *more);
    }
    free(one);
    free(more);
    return status;
}

/* The stretches that are longer than so many parts, or at most as long. */
static tn_status between(const gaps *g, uint64_t length, bool longer, tn_dfa **out, tn_error *error)
{
    uint8_t *holds = tn_array_new(length + 2, 1);
    if (!holds)
        return tn_fail_memory(error);
    memset(holds, !longer, (size_t)length + 1);
    holds[length + 1] = longer;
    const tn_periodic_set set = {.threshold = length + 1, .period = 1, .holds = holds};
    tn_status status = tn_marked_count(g->marked, g->marked->single, TN_TALLY_SINGLES, &set, g->counts, out, error);
    free(holds);
    return status;
}

/* The plans with a stretch that is so far from every destination. Longest: every one of them is farther. Shortest: some
 * is at most as far. gap NULL: whatever lies between; then, of the longest, stretches without any destination. */
static tn_status with_gap(const gaps *g, const tn_dfa *gap, bool every, tn_dfa **out, tn_error *error)
{
    tn_dfa *stretches = NULL, *none = NULL;
    tn_status status = TN_OK;
    if (!gap)
        status = every ? tn_marked_not(g->marked, g->marked->all, &none, error) : TN_OK;
    if (status == TN_OK)
        status = (every ? tn_marked_far : tn_marked_near)(g->marked, g->source, g->destination,
                                                          gap    ? gap
                                                          : none ? none
                                                                 : g->marked->all,
                                                          &stretches, error);
    if (status == TN_OK)
        status = tn_marked_anywhere(g->marked, stretches, out, error);
    tn_dfa_free(none);
    tn_dfa_free(stretches);
    return status;
}

static tn_status add_opposite(tn_weighed_whole *whole, tn_dfa *dfa, int64_t each, bool needed, tn_error *error)
{
    tn_dfa *opposite = NULL;
    tn_status status = tn_dfa_complement(dfa, &opposite, error);
    tn_dfa_free(dfa);
    return status == TN_OK ? add(whole, opposite, each, needed, error) : status;
}

/* There is a gap, and none of the longest leads nowhere. */
static tn_status add_needed(tn_weighed_whole *whole, const gaps *g, bool longest, tn_error *error)
{
    tn_dfa *dfa = NULL;
    tn_status status = with_gap(g, NULL, false, &dfa, error);
    if (status == TN_OK)
        status = add(whole, dfa, 0, true, error);
    if (status != TN_OK || !longest)
        return status;
    status = with_gap(g, NULL, true, &dfa, error);
    return status == TN_OK ? add_opposite(whole, dfa, 0, true, error) : status;
}

/* For each length but the greatest: what the next one is more, of plans whose gap is longer. */
static tn_status add_lengths(tn_weighed_whole *whole, const gaps *g, bool longest, tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i + 1 < g->count; i++) {
        int64_t each = (int64_t)(g->length[i + 1] - g->length[i]) * g->part;
        tn_dfa *gap = NULL, *dfa = NULL;
        status = between(g, g->length[i], longest, &gap, error);
        if (status == TN_OK)
            status = with_gap(g, gap, longest, &dfa, error);
        tn_dfa_free(gap);
        if (status == TN_OK)
            status = (longest ? add : add_opposite)(whole, dfa, each, false, error);
    }
    return status;
}

static tn_status ask_gap(tn_weighed_whole *whole, tn_lowering *lowering, const tn_sum_term *term, uint32_t max_trays,
                         tn_error *error)
{
    gaps g = {.marked = tn_lowering_marked(lowering), .term = term};
    const tn_classes *classes = tn_lowering_classes(lowering);
    bool longest = term->kind == TN_SUM_LONGEST_GAP;
    tn_status status = tn_lower_marked(lowering, term->part, &g.source, error);
    if (status == TN_OK)
        status = tn_lower_marked(lowering, term->other, &g.destination, error);
    if (status == TN_OK)
        status = find_counts(&g, classes, error);
    if (status == TN_OK)
        status = find_lengths(&g, classes->count, max_trays > 2 ? max_trays - 2 : 0, error);
    if (status == TN_OK)
        status = add_needed(whole, &g, longest, error);
    if (status == TN_OK)
        status = add_lengths(whole, &g, longest, error);
    tn_dfa_free(g.source);
    tn_dfa_free(g.destination);
    free(g.counts);
    free(g.length);
    return status;
}

/* Adds what term i of the sum asks (tn_term_of_whole). max_trays: of the plans. */
static tn_status weighed_ask_whole(tn_weighed_whole *whole, tn_lowering *lowering, const tn_sum *sum, uint32_t i,
                                   uint32_t max_trays, tn_error *error)
{
    const tn_sum_term *term = &sum->terms[i];
    if (tn_term_is_gap(term->kind))
        return ask_gap(whole, lowering, term, max_trays, error);
    tn_dfa *dfa = NULL;
    tn_status status = tn_lower(lowering, term->part, &dfa, error);
    bool needed = term->kind == TN_SUM_NEEDED;
    return status == TN_OK ? add(whole, dfa, needed ? 0 : term->each, needed, error) : status;
}

static void whole_clear(tn_weighed_whole *whole)
{
    for (size_t i = 0; i < whole->count; i++)
        tn_dfa_free(whole->items[i].dfa);
    free(whole->items);
    *whole = (tn_weighed_whole){0};
}

enum { STATES_MAX = 4000000 };

/* What a measure remembers, and where a tray of each class leads from there. */
typedef struct memory {
    uint32_t *next; /* [classes]: another memory; UINT32_MAX: not asked yet. NULL: none was asked */
    int64_t *gain;  /* [classes] */
    int64_t rest;   /* what is added where the plan ends */
    bool valued;    /* has a plan that ends here a value? */
} memory;

/* A sum: its machine, and the automata of what is asked of the whole plan. A memory's key: the states of these, then
 * the words of its machine. */
typedef struct weight {
    const char *name;
    tn_sum *sum;
    tn_dfa **parts;         /* [sum->count]: of places that single trays do not decide */
    tn_weighed_whole whole; /* what is asked of the whole plan */
    tn_summing summing;
    tn_interner keys;
    memory *memories;
    size_t memory_room, memory_count;
} weight;

/* What is known of a state. Its key: the library's state and each measure's memory. */
typedef struct node {
    tn_weighed_edge *edges; /* NULL: not found yet */
    size_t count;
    int64_t rest[TN_WEIGHED_MAX];
    bool valued;
} node;

struct tn_weighed {
    const tn_library *library;
    uint32_t measures;
    bool over[TN_WEIGHED_MAX]; /* [measures]: is it a quotient: of two sums? */
    uint32_t count;            /* of sums */
    weight weights[TN_WEIGHED_MAX];
    tn_classes *classes; /* of what the measures tell apart */
    tn_lowering *lowering;
    uint32_t *letter_of; /* [trays]; NULL where trays are not listed: */
    tn_kinds kinds;      /* letters as kinds */
    uint32_t letters;
    tn_tray *first; /* [letters] */
    uint64_t *size; /* [letters]: trays */
    tn_interner states;
    node *nodes;
    size_t node_capacity;
    uint32_t node_count;
    tn_key key, next, part;
    tn_weighed_edge *found; /* [letters]: room for the edges of a state */
    uint8_t *live;          /* [states of the library]: does a kept plan follow? 0: not asked yet, 1: no, 2: yes */
};

/* ---- making */

static tn_status lower_parts(tn_weighed *w, weight *m, uint8_t *local, tn_error *error)
{
    const tn_module *module = w->library->schema->module;
    m->parts = calloc((size_t)m->sum->count + 1, sizeof(tn_dfa *));
    if (!m->parts)
        return tn_fail_memory(error);
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < m->sum->count; i++) {
        const tn_sum_term *term = &m->sum->terms[i];
        if (tn_term_of_whole(term->kind))
            status = weighed_ask_whole(&m->whole, w->lowering, m->sum, i, w->library->max, error);
        else if (term->kind == TN_SUM_STARTS || !tn_summing_is_local(module, term->part, local))
            status = tn_lower_marked(w->lowering, term->part, &m->parts[i], error);
    }
    return status;
}

static tn_status make_summing(tn_weighed *w, weight *m, tn_error *error)
{
    return tn_summing_make(&m->summing, m->sum, tn_lowering_marked(w->lowering), w->classes, m->parts, false, error);
}

static tn_status make_weights(tn_weighed *w, const uint32_t *sums, tn_error *error)
{
    const tn_schema *schema = w->library->schema;
    tn_status status = tn_classes_with_sums(schema, NULL, 0, sums, w->count, &w->classes, error);
    if (status == TN_OK)
        status = tn_lowering_new(w->classes, w->library->max_states, &w->lowering, error);
    if (status == TN_OK)
        tn_lowering_within(w->lowering, w->library->max);
    uint8_t *local = calloc(schema->module->FUNCTION_count + 1, 1);
    if (!local)
        status = status == TN_OK ? tn_fail_memory(error) : status;
    for (uint32_t k = 0; status == TN_OK && k < w->count; k++) {
        status = tn_sum_new(schema, sums[k], &w->weights[k].sum, error);
        if (status == TN_OK)
            status = lower_parts(w, &w->weights[k], local, error);
        if (status == TN_OK)
            status = make_summing(w, &w->weights[k], error);
    }
    free(local);
    return status;
}

/* Letters: distinct pairs of the library's column and the measures' class. */
static tn_status list_letters(tn_weighed *w, tn_error *error)
{
    uint32_t trays = w->library->schema->tray_count;
    tn_numbering pairs = {0};
    w->letter_of = calloc((size_t)trays + 1, sizeof *w->letter_of);
    bool ok = w->letter_of != NULL;
    for (tn_tray t = 0; ok && t < trays; t++) {
        w->letter_of[t] = tn_number(&pairs, (uint64_t)w->library->tray_column[t] << 32 | w->classes->of_tray[t]);
        ok = w->letter_of[t] != UINT32_MAX;
    }
    w->letters = pairs.count;
    tn_numbering_clear(&pairs);
    return ok ? TN_OK : tn_fail_memory(error);
}

/* The same where trays are not listed. */
static tn_status split_letters(tn_weighed *w, tn_error *error)
{
    w->kinds.schema = w->library->schema;
    tn_status status =
        tn_kinds_by_kinds(&w->kinds, tn_kinds_of(&w->library->classes->kinds), w->library->kept->column, error);
    if (status == TN_OK)
        status = tn_kinds_by_kinds(&w->kinds, tn_kinds_of(&w->classes->kinds), NULL, error);
    if (status == TN_OK)
        w->letters = w->kinds.made->labels;
    return status;
}

static void note_letters(tn_weighed *w)
{
    const tn_labelling *made = w->kinds.made;
    for (tn_tray t = w->letter_of ? w->library->schema->tray_count : 0; t-- > 0;) {
        w->first[w->letter_of[t]] = t;
        w->size[w->letter_of[t]]++;
    }
    for (uint32_t l = 0; made && l < w->letters; l++) {
        w->first[l] = made->first[l];
        w->size[l] = tn_labelling_size(made, l);
    }
}

static tn_status make_letters(tn_weighed *w, tn_error *error)
{
    tn_status status = (w->library->schema->legal ? split_letters : list_letters)(w, error);
    if (status != TN_OK)
        return status;
    w->first = calloc((size_t)w->letters + 1, sizeof *w->first);
    w->size = calloc((size_t)w->letters + 1, sizeof *w->size);
    w->found = calloc((size_t)w->letters + 1, sizeof *w->found);
    if (!w->first || !w->size || !w->found)
        return tn_fail_memory(error);
    note_letters(w);
    return TN_OK;
}

/* ---- states */

static tn_status too_many(tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_TOO_MANY_STATES, "the library with its measures passes the limit of %d states",
            STATES_MAX);
    tn_error_help(error, "give fewer trays with --trays, or measure fewer `matches` and `occurrences`");
    return TN_LIMIT;
}

/* The number of a state; w->next is its key. */
static tn_status intern(tn_weighed *w, uint32_t *state, tn_error *error)
{
    uint32_t before = w->states.count;
    *state = tn_intern(&w->states, w->next.data, w->next.size);
    if (*state == UINT32_MAX)
        return tn_fail_memory(error);
    if (*state < before)
        return TN_OK;
    if (*state >= STATES_MAX)
        return too_many(error);
    if (!tn_array_reserve_from(&w->nodes, &w->node_capacity, 64, *state, 1, sizeof *w->nodes))
        return tn_fail_memory(error);
    w->nodes[*state] = (node){0};
    w->node_count = *state + 1;
    w->nodes[*state].valued = true;
    for (uint32_t k = 0; k < w->count; k++) {
        const memory *m = &w->weights[k].memories[w->next.data[1 + k]];
        w->nodes[*state].rest[k] = m->rest;
        w->nodes[*state].valued &= m->valued;
    }
    return TN_OK;
}

/* What a measure adds where the plan ends with this key of a memory, and whether it has a value. */
static bool end_memory(weight *m, const uint32_t *words, size_t size, tn_key *room, memory *end)
{
    int64_t gain;
    end->valued = true;
    for (size_t i = 0; i < m->whole.count; i++) {
        const tn_weighed_asked *asked = &m->whole.items[i];
        bool yes = asked->dfa->accept[words[i]];
        end->rest += yes ? asked->each : 0;
        end->valued &= yes || !asked->needed;
    }
    room->size = 0;
    if (!tn_summing_step(&m->summing, words + m->whole.count, size - m->whole.count, m->summing.marker, room, &gain))
        return false;
    end->rest += gain + tn_summing_rest(&m->summing, room->data, room->size);
    return true;
}

/* The number of a memory; w->next is its key. */
static tn_status remember(tn_weighed *w, weight *m, uint32_t *number, tn_error *error)
{
    uint32_t before = m->keys.count;
    *number = tn_intern(&m->keys, w->next.data, w->next.size);
    if (*number == UINT32_MAX)
        return tn_fail_memory(error);
    if (*number < before)
        return TN_OK;
    if (*number >= STATES_MAX)
        return too_many(error);
    memory made = {0};
    if (!tn_array_reserve_from(&m->memories, &m->memory_room, 16, *number, 1, sizeof *m->memories) ||
        !end_memory(m, w->next.data, w->next.size, &w->part, &made))
        return tn_fail_memory(error);
    m->memories[*number] = made;
    m->memory_count = (size_t)*number + 1;
    return TN_OK;
}

/* What a measure remembers at the beginning: its marker read. */
static tn_status start_measure(tn_weighed *w, weight *m, uint32_t *number, tn_error *error)
{
    int64_t gain;
    bool ok = true;
    w->next.size = w->part.size = 0;
    for (size_t i = 0; ok && i < m->whole.count; i++)
        ok = tn_key_push(&w->next, 0);
    ok = ok && tn_summing_start(&m->summing, &w->part) &&
         tn_summing_step(&m->summing, w->part.data, w->part.size, m->summing.marker, &w->next, &gain);
    return ok ? remember(w, m, number, error) : tn_fail_memory(error);
}

/* Where a tray of the class leads a memory, which has room for it. */
static tn_status find_next(tn_weighed *w, weight *m, uint32_t number, uint32_t class, tn_error *error)
{
    size_t size;
    const uint32_t *key = tn_interned(&m->keys, number, &size);
    int64_t gain;
    uint32_t to;
    if (!tn_key_copy(&w->key, key, size))
        return tn_fail_memory(error);
    const uint32_t *words = w->key.data, *end = words + size;
    bool ok = true;
    w->next.size = 0;
    for (size_t i = 0; ok && i < m->whole.count; i++)
        ok = tn_key_push(&w->next, tn_dfa_read(m->whole.items[i].dfa, *words++, class));
    ok = ok &&
         tn_summing_step(&m->summing, words, (size_t)(end - words), m->summing.join.column[class], &w->next, &gain);
    tn_status status = ok ? remember(w, m, &to, error) : tn_fail_memory(error);
    if (status != TN_OK)
        return status;
    m->memories[number].next[class] = to;
    m->memories[number].gain[class] = gain;
    return TN_OK;
}

static tn_status step_measure(tn_weighed *w, weight *m, uint32_t class, uint32_t *number, int64_t *gain,
                              tn_error *error)
{
    uint32_t classes = w->classes->count;
    memory *from = &m->memories[*number];
    if (!from->next) {
        from->next = malloc(classes * sizeof *from->next);
        from->gain = malloc(classes * sizeof *from->gain);
        if (!from->next || !from->gain)
            return tn_fail_memory(error);
        memset(from->next, 0xff, classes * sizeof *from->next);
    }
    if (from->next[class] == UINT32_MAX) {
        tn_status status = find_next(w, m, *number, class, error);
        if (status != TN_OK)
            return status;
        from = &m->memories[*number];
    }
    *gain = from->gain[class];
    *number = from->next[class];
    return TN_OK;
}

static tn_status make_start(tn_weighed *w, tn_error *error)
{
    uint32_t state, numbers[TN_WEIGHED_MAX];
    tn_status status = TN_OK;
    for (uint32_t k = 0; status == TN_OK && k < w->count; k++)
        status = start_measure(w, &w->weights[k], &numbers[k], error);
    if (status != TN_OK)
        return status;
    w->next.size = 0;
    bool ok = tn_key_push(&w->next, 0);
    for (uint32_t k = 0; ok && k < w->count; k++)
        ok = tn_key_push(&w->next, numbers[k]);
    return ok ? intern(w, &state, error) : tn_fail_memory(error);
}

static tn_status too_many_sums(tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_TOO_MANY, "these measures are of more than %d sums: a quotient is of two",
            TN_WEIGHED_MAX);
    tn_error_help(error, "ask for fewer measures at a time");
    return TN_LIMIT;
}

tn_status tn_weighed_new(const tn_library *library, const uint32_t *measures, uint32_t count, tn_weighed **out,
                         tn_error *error)
{
    const tn_module *module = library->schema->module;
    uint32_t sums[TN_WEIGHED_MAX], total = 0;
    const char *names[TN_WEIGHED_MAX];
    bool over[TN_WEIGHED_MAX] = {0};
    for (uint32_t k = 0; k < count; k++) {
        uint32_t divisor = tn_named_measure_over(module, measures[k]);
        over[k] = divisor != TN_NO_RECORD;
        if (total + 1 + over[k] > TN_WEIGHED_MAX)
            return too_many_sums(error);
        names[total] = tn_named_measure(module, measures[k]);
        sums[total++] = tn_named_measure_sum(module, library->record, measures[k]);
        if (!over[k])
            continue;
        names[total] = names[total - 1];
        sums[total++] = divisor;
    }
    tn_status status = tn_weighed_of_sums(library, sums, names, total, out, error);
    if (status != TN_OK)
        return status;
    (*out)->measures = count;
    memcpy((*out)->over, over, sizeof over);
    return TN_OK;
}

tn_status tn_weighed_of_sums(const tn_library *library, const uint32_t *sums, const char *const *names, uint32_t count,
                             tn_weighed **out, tn_error *error)
{
    tn_weighed *w = calloc(1, sizeof *w);
    if (!w)
        return tn_fail_memory(error);
    w->library = library;
    w->count = w->measures = count;
    for (uint32_t k = 0; k < count; k++)
        w->weights[k].name = names[k];
    w->live = calloc((size_t)library->kept->states + 1, 1);
    tn_status status = w->live ? make_weights(w, sums, error) : tn_fail_memory(error);
    if (status == TN_OK)
        status = make_letters(w, error);
    if (status == TN_OK)
        status = make_start(w, error);
    if (status != TN_OK) {
        tn_weighed_free(w);
        return status;
    }
    *out = w;
    return TN_OK;
}

void tn_weighed_free(tn_weighed *w)
{
    if (!w)
        return;
    for (uint32_t k = 0; k < w->count; k++) {
        weight *m = &w->weights[k];
        for (uint32_t i = 0; m->parts && i < m->sum->count; i++)
            tn_dfa_free(m->parts[i]);
        free(m->parts);
        whole_clear(&m->whole);
        for (size_t i = 0; i < m->memory_count; i++) {
            free(m->memories[i].next);
            free(m->memories[i].gain);
        }
        free(m->memories);
        tn_interner_clear(&m->keys);
        tn_summing_clear(&m->summing);
        tn_sum_free(m->sum);
    }
    for (uint32_t s = 0; s < w->node_count; s++) /* a state that failed has none */
        free(w->nodes[s].edges);
    free(w->nodes);
    tn_interner_clear(&w->states);
    tn_lowering_free(w->lowering);
    tn_classes_free(w->classes);
    free(w->letter_of);
    tn_labelling_free(w->kinds.made);
    free(w->first);
    free(w->size);
    free(w->key.data);
    free(w->next.data);
    free(w->part.data);
    free(w->found);
    free(w->live);
    free(w);
}

/* ---- asking */

const tn_library *tn_weighed_library(const tn_weighed *w)
{
    return w->library;
}

uint32_t tn_weighed_count(const tn_weighed *w)
{
    return w->count;
}

const char *tn_weighed_name(const tn_weighed *w, uint32_t measure)
{
    return w->weights[measure].name;
}

mpq_srcptr tn_weighed_unit(const tn_weighed *w, uint32_t measure)
{
    return w->weights[measure].sum->unit;
}

int64_t tn_weighed_start(const tn_weighed *w, uint32_t measure)
{
    return w->weights[measure].sum->constant;
}

uint32_t tn_weighed_measures(const tn_weighed *w)
{
    return w->measures;
}

uint32_t tn_weighed_sum(const tn_weighed *w, uint32_t measure, bool *over)
{
    uint32_t first = 0;
    for (uint32_t k = 0; k < measure; k++)
        first += 1 + w->over[k];
    *over = w->over[measure];
    return first;
}

int tn_weighed_power(const tn_weighed *w, uint32_t measure)
{
    bool over;
    uint32_t sum = tn_weighed_sum(w, measure, &over);
    int power = (int)w->weights[sum].sum->record->power;
    return over ? power - (int)w->weights[sum + 1].sum->record->power : power;
}

void tn_weighed_value(const tn_weighed *w, uint32_t measure, const int64_t *values, mpq_t value)
{
    bool over;
    uint32_t sum = tn_weighed_sum(w, measure, &over);
    mpq_set_si(value, values[sum], 1);
    mpq_mul(value, value, w->weights[sum].sum->unit);
    if (!over)
        return;
    mpq_t divisor;
    mpq_init(divisor);
    mpq_set_si(divisor, values[sum + 1], 1);
    mpq_mul(divisor, divisor, w->weights[sum + 1].sum->unit);
    mpq_div(value, value, divisor);
    mpq_clear(divisor);
}

bool tn_weighed_valued(const tn_weighed *w, uint32_t state)
{
    return w->nodes[state].valued;
}

int64_t tn_weighed_rest(const tn_weighed *w, uint32_t state, uint32_t measure)
{
    return w->nodes[state].rest[measure];
}

uint32_t tn_weighed_letter(const tn_weighed *w, tn_tray tray)
{
    return w->letter_of ? w->letter_of[tray] : tn_kind_of_tray(&w->kinds, tray);
}

static bool is_letter(void *context, uint32_t letter)
{
    return letter == *(const uint32_t *)context;
}

tn_tray tn_weighed_next_tray(const tn_weighed *w, tn_tray tray)
{
    uint32_t trays = w->library->schema->tray_count, letter = tn_weighed_letter(w, tray);
    if (!w->letter_of)
        return tn_labelling_next(w->kinds.made, tray + 1, is_letter, &letter);
    do
        tray++;
    while (tray < trays && w->letter_of[tray] != letter);
    return tray;
}

tn_tray tn_weighed_first_tray(const tn_weighed *w, uint32_t letter)
{
    return w->first[letter];
}

uint32_t tn_weighed_letters(const tn_weighed *w)
{
    return w->letters;
}

static uint32_t library_state(const tn_weighed *w, uint32_t state)
{
    size_t size;
    return tn_interned(&w->states, state, &size)[0];
}

bool tn_weighed_alive(const tn_weighed *w, uint32_t left, uint32_t state)
{
    return tn_library_alive(w->library, left, library_state(w, state));
}

/* Does any kept plan follow the library's state? */
static bool is_live(tn_weighed *w, uint32_t state)
{
    if (w->live[state] == 0) {
        w->live[state] = 1;
        for (uint32_t left = 0; w->live[state] == 1 && left <= w->library->max; left++)
            w->live[state] += tn_library_alive(w->library, left, state);
    }
    return w->live[state] == 2;
}

tn_status tn_weighed_step(tn_weighed *w, uint32_t state, uint32_t letter, uint32_t *target, int64_t *gain,
                          tn_error *error)
{
    size_t size;
    tn_tray tray = w->first[letter];
    const uint32_t *key = tn_interned(&w->states, state, &size);
    uint32_t numbers[TN_WEIGHED_MAX], to = tn_library_step(w->library, key[0], tray);
    *target = UINT32_MAX;
    memset(gain, 0, TN_WEIGHED_MAX * sizeof *gain);
    if (!is_live(w, to))
        return TN_OK;
    memcpy(numbers, key + 1, (size - 1) * sizeof *numbers);
    tn_status status = TN_OK;
    for (uint32_t k = 0; status == TN_OK && k < w->count; k++)
        status = step_measure(w, &w->weights[k], tn_class_of(w->classes, tray), &numbers[k], &gain[k], error);
    if (status != TN_OK)
        return status;
    w->next.size = 0;
    bool ok = tn_key_push(&w->next, to);
    for (uint32_t k = 0; ok && k < w->count; k++)
        ok = tn_key_push(&w->next, numbers[k]);
    return ok ? intern(w, target, error) : tn_fail_memory(error);
}

static int compare_edges(const void *left, const void *right)
{
    const tn_weighed_edge *a = left, *b = right;
    if (a->target != b->target)
        return a->target < b->target ? -1 : 1;
    for (uint32_t k = 0; k < TN_WEIGHED_MAX; k++)
        if (a->gain[k] != b->gain[k])
            return a->gain[k] < b->gain[k] ? -1 : 1;
    return (a->first > b->first) - (a->first < b->first);
}

static bool alike(const tn_weighed_edge *a, const tn_weighed_edge *b)
{
    return a->target == b->target && memcmp(a->gain, b->gain, sizeof a->gain) == 0;
}

tn_status tn_weighed_check(const tn_weighed *w, tn_error *error)
{
    return tn_watch_check(w->library->schema->module->watch, error);
}

/* The edges of a state into w->found, which has room for them; returns how many. */
static tn_status find_edges(tn_weighed *w, uint32_t state, size_t *count, tn_error *error)
{
    size_t size = 0;
    *count = 0;
    for (uint32_t l = 0; l < w->letters; l++) {
        tn_weighed_edge edge = {.first = w->first[l], .letter = l, .trays = w->size[l]};
        tn_status status = tn_weighed_step(w, state, l, &edge.target, edge.gain, error);
        if (status != TN_OK)
            return status;
        if (edge.target != UINT32_MAX)
            w->found[size++] = edge;
    }
    qsort(w->found, size, sizeof *w->found, compare_edges);
    for (size_t i = 0; i < size; i++) {
        if (*count > 0 && alike(&w->found[*count - 1], &w->found[i]))
            w->found[*count - 1].trays += w->found[i].trays;
        else
            w->found[(*count)++] = w->found[i];
    }
    return TN_OK;
}

tn_status tn_weighed_edges(tn_weighed *w, uint32_t state, const tn_weighed_edge **edges, size_t *count, tn_error *error)
{
    tn_status going = tn_weighed_check(w, error);
    if (going != TN_OK)
        return going;
    if (!w->nodes[state].edges) {
        size_t found;
        tn_status status = find_edges(w, state, &found, error);
        if (status != TN_OK)
            return status;
        tn_weighed_edge *kept = malloc((found + 1) * sizeof *kept);
        if (!kept)
            return tn_fail_memory(error);
        memcpy(kept, w->found, found * sizeof *kept);
        w->nodes[state].edges = kept;
        w->nodes[state].count = found;
    }
    *edges = w->nodes[state].edges;
    *count = w->nodes[state].count;
    return TN_OK;
}
