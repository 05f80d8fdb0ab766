/* Finds a genome for a sentence. */
#include "runtime/genome/mapping/invert.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/hash_table.h"
#include "runtime/base/random.h"

#define TN_CHART_NONE UINT32_MAX
#define TN_CHART_UNBOUND 0x1FFFFFu /* of an edge variable; edge numbers are below */
#define TN_CHART_LETTER_BITS 21u

/* One position of the sentence that a terminal starts at: a byte in ge, a token in genr8. */
typedef struct chart_token {
    uint32_t begin, length; /* in the sentence */
    uint32_t edge;          /* its number, or TN_CHART_NONE */
} chart_token;

/* A production written from `begin` up to its word `at`, which stands at `end`. */
typedef struct chart_item {
    uint32_t at, begin, end;
    uint32_t value;   /* how much depth it needs, the least found */
    uint64_t letters; /* numbers of its edge variables, TN_CHART_LETTER_BITS each */
    uint32_t before;  /* the item that it came from, or TN_CHART_NONE */
    uint32_t child;   /* the finished item of the rule in between, or TN_CHART_NONE */
    uint32_t link;    /* next in the list of items that wait for the same rule at the same place */
    bool queued;
} chart_item;

/* A rule that can write the sentence from `begin` to `end`. */
typedef struct chart_finished {
    uint32_t rule, begin, end;
    uint32_t value;
    uint32_t item; /* which does */
    uint32_t link; /* next of the same rule and begin */
} chart_finished;

/* A rule wanted at a place: who waits for it, and how it was finished. */
typedef struct chart_goal {
    uint32_t rule, begin;
    uint32_t waiting, finished;
} chart_goal;

typedef struct parse_chart {
    const tn_grammar *grammar;
    const char *sentence;
    size_t size;
    chart_token *tokens; /* genr8; in ge, bytes stand for themselves */
    uint32_t length;     /* positions */
    uint32_t *loop_of;   /* by word: of an AGAIN, its REPEAT */
    chart_item *items;
    size_t item_count, item_capacity, max_items;
    uint64_t steps; /* items added, or met again */
    chart_finished *finished;
    size_t finished_count, finished_capacity;
    chart_goal *goals;
    size_t goal_count, goal_capacity;
    tn_hash_table item_index, finished_index, goal_index;
    uint32_t *queue;
    size_t queue_begin, queue_end, queue_capacity;
    /* the furthest place reached, and what would have gone on from there */
    uint32_t furthest;
    uint32_t expected[8]; /* words */
    size_t expected_count;
    bool out_of_memory, too_many;
    tn_watch *watch; /* or NULL */
} parse_chart;

/* An ambiguous grammar meets its items again and again, in the worst case with the cube of the sentence's length: that
 * is bounded by this many steps an item that is allowed, ten times what sentences without much ambiguity take. */
#define TN_CHART_STEPS 32u

static inline uint32_t chart_letter(uint64_t letters, uint32_t letter)
{
    return (uint32_t)(letters >> (letter * TN_CHART_LETTER_BITS)) & TN_CHART_UNBOUND;
}

/* ==== parses a sentence by Earley's method, for inverting */

enum { ITEMS_BETWEEN_LOOKS = 256 }; /* at the watch */

static void chart_clear(parse_chart *c)
{
    free(c->tokens);
    free(c->loop_of);
    free(c->items);
    free(c->finished);
    free(c->goals);
    tn_hash_clear(&c->item_index);
    tn_hash_clear(&c->finished_index);
    tn_hash_clear(&c->goal_index);
    free(c->queue);
    *c = (parse_chart){0};
}

static bool grow(parse_chart *c, void *items, size_t *capacity, size_t count, size_t size)
{
    bool fine = tn_array_reserve(items, capacity, count, 1, size);
    c->out_of_memory |= !fine;
    return fine;
}

/* ---- what is looked for in the chart */

static uint64_t key_hash(uint32_t a, uint32_t b, uint32_t d, uint64_t letters)
{
    return tn_mix64(tn_mix64((uint64_t)a << 32 | b) ^ d ^ letters << 32 ^ letters >> 32);
}

typedef struct wanted_item {
    const parse_chart *chart;
    const chart_item *item;
} wanted_item;

static bool is_item(const void *context, uint32_t number)
{
    const wanted_item *w = context;
    const chart_item *there = &w->chart->items[number];
    return there->at == w->item->at && there->begin == w->item->begin && there->end == w->item->end &&
           there->letters == w->item->letters;
}

typedef struct wanted_finished {
    const parse_chart *chart;
    const chart_finished *finished;
} wanted_finished;

static bool is_finished(const void *context, uint32_t number)
{
    const wanted_finished *w = context;
    const chart_finished *there = &w->chart->finished[number];
    return there->rule == w->finished->rule && there->begin == w->finished->begin && there->end == w->finished->end;
}

typedef struct wanted_goal {
    const parse_chart *chart;
    uint32_t rule, begin;
} wanted_goal;

static bool is_goal(const void *context, uint32_t number)
{
    const wanted_goal *w = context;
    return w->chart->goals[number].rule == w->rule && w->chart->goals[number].begin == w->begin;
}

/* The number of what is looked for, or the next one. False if out of memory. */
static bool enter(parse_chart *c, tn_hash_table *table, uint64_t hash, tn_hash_same *is, const void *wanted,
                  uint32_t *number)
{
    c->out_of_memory |= tn_hash_enter(table, hash, is, wanted, number, NULL) != TN_OK;
    return !c->out_of_memory;
}

/* ---- items */

static void enqueue(parse_chart *c, uint32_t item)
{
    if (c->items[item].queued)
        return;
    if (c->queue_end == c->queue_capacity && c->queue_begin > c->queue_capacity / 2) {
        memmove(c->queue, c->queue + c->queue_begin, (c->queue_end - c->queue_begin) * sizeof *c->queue);
        c->queue_end -= c->queue_begin;
        c->queue_begin = 0;
    }
    if (!grow(c, &c->queue, &c->queue_capacity, c->queue_end, sizeof *c->queue))
        return;
    c->items[item].queued = true;
    c->queue[c->queue_end++] = item;
}

/* Adds an item, or improves the one that is there. */
static void add_item(parse_chart *c, chart_item item)
{
    if (c->out_of_memory || c->too_many)
        return;
    if (++c->steps / TN_CHART_STEPS > c->max_items) {
        c->too_many = true;
        return;
    }
    wanted_item wanted = {c, &item};
    uint32_t number = (uint32_t)c->item_count;
    if (!enter(c, &c->item_index, key_hash(item.at, item.begin, item.end, item.letters), is_item, &wanted, &number))
        return;
    if (number < c->item_count) {
        chart_item *there = &c->items[number];
        if (item.value < there->value) {
            there->value = item.value;
            there->before = item.before;
            there->child = item.child;
            enqueue(c, number);
        }
        return;
    }
    if (c->item_count == c->max_items) {
        c->too_many = true;
        return;
    }
    if (!grow(c, &c->items, &c->item_capacity, c->item_count, sizeof *c->items))
        return;
    item.link = TN_CHART_NONE;
    item.queued = false;
    c->items[c->item_count++] = item;
    enqueue(c, number);
}

/* The item after `index`, over a word that wrote the sentence up to `end`. */
static void advance(parse_chart *c, uint32_t index, uint32_t at, uint32_t end, uint64_t letters)
{
    chart_item item = c->items[index];
    item.before = index;
    item.child = TN_CHART_NONE;
    item.at = at;
    item.end = end;
    item.letters = letters;
    add_item(c, item);
}

/* ---- depth */

/* What a parent needs on account of a child: a level more; 0 stands for no need at all (genr8). */
static uint32_t child_need(uint32_t value)
{
    return value ? value + 1 : 0;
}

/* ge: levels taken, terminals counted. genr8: how far below the depth limit it must start, which only holds for a
 * production with non-terminals whose rule has others without (from the limit on only those are chosen). */
static uint32_t finished_value(const parse_chart *c, const chart_item *item, uint32_t production)
{
    const tn_production *p = &c->grammar->productions[production];
    if (c->grammar->dialect == TN_DIALECT_GE) {
        uint32_t own = p->symbols ? 2 : 1;
        return item->value > own ? item->value : own;
    }
    bool limited = p->children && c->grammar->rules[p->rule].closed_count;
    return limited && item->value < 1 ? 1 : item->value;
}

static void advance_over(parse_chart *c, uint32_t index, const chart_finished *f)
{
    chart_item item = c->items[index];
    uint32_t need = child_need(f->value);
    item.before = index;
    item.child = (uint32_t)(f - c->finished);
    item.at++;
    item.end = f->end;
    item.value = item.value > need ? item.value : need;
    add_item(c, item);
}

/* ---- terminals */

/* Where the terminal ends if it stands at `end`, or TN_CHART_NONE. */
static uint32_t scan(const parse_chart *c, uint32_t terminal, uint32_t end)
{
    const tn_terminal *t = &c->grammar->terminals[terminal];
    const char *text = c->grammar->texts + t->offset;
    if (c->grammar->dialect == TN_DIALECT_GE)
        return t->length <= c->size - end && memcmp(c->sentence + end, text, t->length) == 0 ? end + t->length
                                                                                             : TN_CHART_NONE;
    if (end == c->length || c->tokens[end].length != t->length)
        return TN_CHART_NONE;
    return memcmp(c->sentence + c->tokens[end].begin, text, t->length) == 0 ? end + 1 : TN_CHART_NONE;
}

static void expect(parse_chart *c, uint32_t word, uint32_t end)
{
    if (end < c->furthest)
        return;
    if (end > c->furthest) {
        c->furthest = end;
        c->expected_count = 0;
    }
    for (size_t i = 0; i < c->expected_count; i++)
        if (c->expected[i] == word)
            return;
    if (c->expected_count < sizeof c->expected / sizeof *c->expected)
        c->expected[c->expected_count++] = word;
}

/* ---- rules */

static chart_goal *goal_for(parse_chart *c, uint32_t rule, uint32_t begin, bool *is_new)
{
    wanted_goal wanted = {c, rule, begin};
    uint32_t number = (uint32_t)c->goal_count;
    *is_new = false;
    if (!grow(c, &c->goals, &c->goal_capacity, c->goal_count, sizeof *c->goals) ||
        !enter(c, &c->goal_index, key_hash(rule, begin, 0, 0), is_goal, &wanted, &number))
        return NULL;
    *is_new = number == c->goal_count;
    if (*is_new)
        c->goals[c->goal_count++] = (chart_goal){rule, begin, TN_CHART_NONE, TN_CHART_NONE};
    return &c->goals[number];
}

/* Starts every production of a rule; those whose first terminal does not stand there are left out at once. */
static void predict(parse_chart *c, uint32_t rule, uint32_t begin)
{
    const tn_rule *r = &c->grammar->rules[rule];
    for (uint32_t p = r->first; p < r->first + r->count && !c->too_many && !c->out_of_memory; p++) {
        uint32_t at = c->grammar->productions[p].words, word = c->grammar->words[at];
        if (TN_WORD_OP(word) == TN_WORD_TERMINAL && scan(c, TN_WORD_ARGUMENT(word), begin) == TN_CHART_NONE) {
            expect(c, word, begin);
            continue;
        }
        add_item(c, (chart_item){.at = at,
                                 .begin = begin,
                                 .end = begin,
                                 .letters = UINT64_MAX >> 1,
                                 .before = TN_CHART_NONE,
                                 .child = TN_CHART_NONE});
    }
}

static void want_rule(parse_chart *c, uint32_t index, uint32_t rule)
{
    bool is_new;
    uint32_t end = c->items[index].end;
    chart_goal *goal = goal_for(c, rule, end, &is_new);
    if (!goal)
        return;
    size_t goal_index = (size_t)(goal - c->goals);
    if (c->items[index].link == TN_CHART_NONE) {
        c->items[index].link = goal->waiting == TN_CHART_NONE ? index : goal->waiting; /* the last links to itself */
        goal->waiting = index;
    }
    if (is_new)
        predict(c, rule, end);
    for (uint32_t f = c->goals[goal_index].finished; f != TN_CHART_NONE; f = c->finished[f].link) {
        advance_over(c, index, &c->finished[f]);
        if (c->too_many || c->out_of_memory)
            return;
    }
}

static uint32_t production_at(const tn_grammar *g, uint32_t word)
{
    uint32_t low = 0, high = (uint32_t)g->production_count;
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (g->productions[middle].words <= word)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* Records that a rule is finished; false if it was, and not worse. */
static bool finish(parse_chart *c, chart_finished f, uint32_t *index)
{
    bool is_new;
    wanted_finished wanted = {c, &f};
    *index = (uint32_t)c->finished_count;
    if (!grow(c, &c->finished, &c->finished_capacity, c->finished_count, sizeof *c->finished) ||
        !enter(c, &c->finished_index, key_hash(f.rule, f.begin, f.end, 0), is_finished, &wanted, index))
        return false;
    if (*index < c->finished_count) {
        chart_finished *there = &c->finished[*index];
        if (f.value >= there->value)
            return false;
        there->value = f.value;
        there->item = f.item;
        return true;
    }
    f.link = TN_CHART_NONE;
    c->finished[c->finished_count++] = f;
    chart_goal *goal = goal_for(c, f.rule, f.begin, &is_new);
    if (!goal)
        return false;
    c->finished[*index].link = goal->finished;
    goal->finished = *index;
    return true;
}

static void complete(parse_chart *c, uint32_t index)
{
    const chart_item *item = &c->items[index];
    uint32_t production = production_at(c->grammar, item->at), done;
    chart_finished f = {.rule = c->grammar->productions[production].rule,
                        .begin = item->begin,
                        .end = item->end,
                        .value = finished_value(c, item, production),
                        .item = index};
    if (!finish(c, f, &done))
        return;
    bool is_new;
    const chart_goal *goal = goal_for(c, f.rule, f.begin, &is_new);
    for (uint32_t w = goal ? goal->waiting : TN_CHART_NONE; w != TN_CHART_NONE && !c->too_many && !c->out_of_memory;) {
        uint32_t next = c->items[w].link;
        advance_over(c, w, &c->finished[done]);
        if (next == w)
            break;
        w = next;
    }
}

/* ---- the loop */

static void process(parse_chart *c, uint32_t index)
{
    const chart_item item = c->items[index];
    uint32_t word = c->grammar->words[item.at], argument = TN_WORD_ARGUMENT(word), end;
    switch (TN_WORD_OP(word)) {
    case TN_WORD_TERMINAL:
        end = scan(c, argument, item.end);
        if (end != TN_CHART_NONE)
            advance(c, index, item.at + 1, end, item.letters);
        else
            expect(c, word, item.end);
        break;
    case TN_WORD_RULE:
        want_rule(c, index, argument);
        break;
    case TN_WORD_EDGE:
        if (item.end < c->length && c->tokens[item.end].edge != TN_CHART_NONE)
            advance(c, index, item.at + 1, item.end + 1, item.letters);
        else
            expect(c, word, item.end);
        break;
    case TN_WORD_SAME: {
        uint32_t bound = chart_letter(item.letters, argument);
        uint32_t edge = item.end < c->length ? c->tokens[item.end].edge : TN_CHART_NONE;
        if (edge == TN_CHART_NONE || (bound != TN_CHART_UNBOUND && bound != edge)) {
            expect(c, word, item.end);
            break;
        }
        uint64_t mask = (uint64_t)TN_CHART_UNBOUND << (argument * TN_CHART_LETTER_BITS);
        uint64_t letters = (item.letters & ~mask) | (uint64_t)edge << (argument * TN_CHART_LETTER_BITS);
        advance(c, index, item.at + 1, item.end + 1, letters);
        break;
    }
    case TN_WORD_REPEAT:
    case TN_WORD_MAYBE:
        advance(c, index, item.at + 1 + argument, item.end, item.letters);
        advance(c, index, item.at + 1, item.end, item.letters);
        break;
    case TN_WORD_AGAIN:
        advance(c, index, item.at + 1, item.end, item.letters);
        advance(c, index, c->loop_of[item.at] + 1, item.end, item.letters);
        break;
    case TN_WORD_DONE:
        complete(c, index);
        break;
    }
}

static bool find_loops(parse_chart *c)
{
    const tn_grammar *g = c->grammar;
    c->loop_of = calloc(g->word_count + 1, sizeof *c->loop_of);
    if (!c->loop_of)
        return false;
    for (uint32_t at = 0; at < g->word_count; at++)
        if (TN_WORD_OP(g->words[at]) == TN_WORD_REPEAT)
            c->loop_of[at + TN_WORD_ARGUMENT(g->words[at])] = at;
    return true;
}

/* Parses; the finished record of the start symbol over the whole sentence in *result, TN_CHART_NONE if there is
 * none. */
static tn_status chart_parse(parse_chart *c, uint32_t *result, tn_error *error)
{
    *result = TN_CHART_NONE;
    if (!find_loops(c))
        return tn_fail_memory(error);
    bool is_new;
    if (goal_for(c, 0, 0, &is_new))
        predict(c, 0, 0);
    while (c->queue_begin < c->queue_end && !c->out_of_memory && !c->too_many) {
        uint32_t index = c->queue[c->queue_begin++];
        c->items[index].queued = false;
        process(c, index);
        if (c->queue_begin % ITEMS_BETWEEN_LOOKS > 0)
            continue;
        tn_watch_tell(c->watch, c->furthest, c->length);
        if (tn_watch_stopped(c->watch))
            return tn_fail_stopped(c->watch, error);
    }
    if (c->out_of_memory)
        return tn_fail_memory(error);
    if (c->too_many) {
        if (c->item_count == c->max_items)
            tn_fail(error, TN_LIMIT, E_INVERT_LIMIT,
                    "deriving the sentence takes more than %zu parser states, the limit", c->max_items);
        else
            tn_fail(error, TN_LIMIT, E_INVERT_LIMIT,
                    "the grammar derives the sentence in very many ways: it takes more than %llu steps, the limit",
                    (unsigned long long)c->max_items * TN_CHART_STEPS);
        tn_error_help(error, "raise it with --max-items, or take a shorter sentence");
        return TN_LIMIT;
    }
    for (uint32_t f = c->goals[0].finished; f != TN_CHART_NONE; f = c->finished[f].link)
        if (c->finished[f].end == c->length)
            *result = f;
    return TN_OK;
}

#define FIRST_IDS 2u

/* ---- the sentence */

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/* The number of `Edge12`, or TN_CHART_NONE. */
static uint32_t edge_of(const char *text, size_t length)
{
    if (length < 5 || memcmp(text, "Edge", 4) != 0 || (text[4] == '0' && length > 5))
        return TN_CHART_NONE;
    uint32_t value = 0;
    for (size_t i = 4; i < length; i++) {
        if (text[i] < '0' || text[i] > '9')
            return TN_CHART_NONE;
        value = value * 10 + (uint32_t)(text[i] - '0');
        if (value >= TN_CHART_UNBOUND)
            return TN_CHART_NONE;
    }
    return value;
}

static tn_status split(parse_chart *c, tn_error *error)
{
    size_t capacity = c->size / 2 + 1;
    c->tokens = calloc(capacity, sizeof *c->tokens);
    if (!c->tokens)
        return tn_fail_memory(error);
    for (size_t at = 0; at < c->size;) {
        size_t begin = at;
        if (is_blank(c->sentence[at])) {
            at++;
            continue;
        }
        while (at < c->size && !is_blank(c->sentence[at]))
            at++;
        c->tokens[c->length++] =
            (chart_token){(uint32_t)begin, (uint32_t)(at - begin), edge_of(c->sentence + begin, at - begin)};
    }
    return TN_OK;
}

/* A genome can only bring in edge types in their order: Edge0 and Edge1 are there, then Edge2, and so on. */
static tn_status check_edges(const parse_chart *c, tn_error *error)
{
    uint32_t known = FIRST_IDS;
    for (uint32_t i = 0; i < c->length; i++) {
        uint32_t edge = c->tokens[i].edge;
        if (edge == TN_CHART_NONE)
            continue;
        if (edge > known) {
            tn_fail(error, TN_INVALID, E_NOT_DERIVABLE,
                    "no genome gives this sentence: Edge%u stands before there was an Edge%u", edge, known);
            tn_error_help(
                error,
                "edge types come in order; number the sentence's edges by their first use, from Edge0 and Edge1 on");
            tn_error_place(error, 0, c->tokens[i].begin + 1, c->tokens[i].begin + c->tokens[i].length + 1);
            return TN_INVALID;
        }
        known += edge == known;
    }
    return TN_OK;
}

/* ---- why not */

static void name_word(const tn_grammar *g, uint32_t word, char *out, size_t size)
{
    uint32_t argument = TN_WORD_ARGUMENT(word);
    if (TN_WORD_OP(word) == TN_WORD_TERMINAL) {
        const tn_terminal *t = &g->terminals[argument];
        const char *text = g->texts + t->offset;
        if (t->length == 1 && text[0] == '\n')
            snprintf(out, size, "a line end");
        else
            snprintf(out, size, "`%.*s`", t->length > 24 ? 24 : (int)t->length, text);
    } else if (TN_WORD_OP(word) == TN_WORD_SAME) {
        snprintf(out, size, "Edge%c", (char)('X' + argument));
    } else {
        snprintf(out, size, "Edge");
    }
}

static tn_status not_derivable(const parse_chart *c, tn_error *error)
{
    bool ge = c->grammar->dialect == TN_DIALECT_GE;
    uint32_t at = c->furthest;
    bool past = at >= c->length;
    size_t begin = past ? c->size : ge ? at : c->tokens[at].begin;
    size_t length = past ? 0 : ge ? 1 : c->tokens[at].length;
    char expected[240] = "";
    for (size_t i = 0; i < c->expected_count; i++) {
        size_t used = strlen(expected);
        if (used + 40 > sizeof expected)
            break;
        if (i)
            memcpy(expected + used, ", ", 3);
        name_word(c->grammar, c->expected[i], expected + strlen(expected), sizeof expected - strlen(expected));
    }
    if (past)
        tn_fail(error, TN_INVALID, E_NOT_DERIVABLE, "the sentence cannot be derived: it ends too soon");
    else
        tn_fail(error, TN_INVALID, E_NOT_DERIVABLE, "the sentence cannot be derived: `%.*s` does not fit here",
                length > 40 ? 40 : (int)length, c->sentence + begin);
    if (c->expected_count)
        tn_error_help(error, "it goes as far as this; %s could follow", expected);
    else if (!past)
        tn_error_help(error, "the sentence could end here");
    tn_error_place(error, 0, begin + 1, begin + length + 1);
    return TN_INVALID;
}

/* ---- the genome, by walking the derivation from left to right */

/* A production being written out: its items from the first to the last, in `steps`. */
typedef struct instance {
    size_t first, next, end;
    uint32_t depth;
} instance;

typedef struct writer {
    parse_chart *chart;
    const tn_invert_options *options;
    tn_genome *genome;
    uint32_t *steps; /* items */
    size_t step_count, step_capacity;
    instance *open;
    size_t open_count, open_capacity;
    uint32_t *rounds; /* of the loops being written */
    size_t round_count, round_capacity;
    bool failed;
} writer;

static bool room(writer *w, void *items, size_t *capacity, size_t count, size_t size)
{
    bool fine = tn_array_reserve(items, capacity, count, 1, size);
    w->failed |= !fine;
    return fine;
}

static void put_codon(writer *w, uint64_t codon)
{
    if (tn_genome_reserve(w->genome, w->genome->count + 1))
        w->genome->codons[w->genome->count++] = codon;
    else
        w->failed = true;
}

/* The codon that makes the rule choose that production at that depth. */
static void put_choice(writer *w, uint32_t production, uint32_t depth)
{
    const tn_grammar *g = w->chart->grammar;
    const tn_rule *rule = &g->rules[g->productions[production].rule];
    if (w->options->position_independent)
        put_codon(w, 0);
    if (g->dialect == TN_DIALECT_GE) {
        if (rule->count > 1 || !g->skip_single)
            put_codon(w, production - rule->first);
        return;
    }
    if (!w->options->max_depth || depth < w->options->max_depth || !rule->closed_count) {
        put_codon(w, production - rule->first);
        return;
    }
    for (uint32_t i = 0; i < rule->closed_count; i++)
        if (g->closed[rule->closed_first + i] == production)
            put_codon(w, i);
}

static void open_instance(writer *w, uint32_t finished, uint32_t depth)
{
    parse_chart *c = w->chart;
    uint32_t item = c->finished[finished].item, first = item;
    size_t begin = w->step_count;
    for (uint32_t i = item; i != TN_CHART_NONE; i = c->items[i].before) {
        if (!room(w, &w->steps, &w->step_capacity, w->step_count, sizeof *w->steps))
            return;
        w->steps[w->step_count++] = first = i;
    }
    for (size_t i = begin, j = w->step_count - 1; i < j; i++, j--) {
        uint32_t swap = w->steps[i];
        w->steps[i] = w->steps[j];
        w->steps[j] = swap;
    }
    if (!room(w, &w->open, &w->open_capacity, w->open_count, sizeof *w->open))
        return;
    w->open[w->open_count++] = (instance){begin, begin, w->step_count, depth};
    uint32_t production = 0;
    const tn_grammar *g = c->grammar;
    const tn_rule *rule = &g->rules[c->finished[finished].rule];
    for (uint32_t p = rule->first; p < rule->first + rule->count; p++)
        if (g->productions[p].words <= c->items[first].at)
            production = p;
    put_choice(w, production, depth);
}

static void put_loop(writer *w, bool starts, bool goes_on)
{
    if (starts) {
        if (!room(w, &w->rounds, &w->round_capacity, w->round_count, sizeof *w->rounds))
            return;
        w->rounds[w->round_count++] = 0;
    }
    uint32_t *rounds = &w->rounds[w->round_count - 1];
    put_codon(w, goes_on ? (uint64_t)*rounds + 1 : 0);
    *rounds += goes_on;
    w->round_count -= !goes_on;
}

/* Writes what leads from one item to the next; returns the finished rule in between, or TN_CHART_NONE. */
static uint32_t write_step(writer *w, const chart_item *from, const chart_item *to)
{
    const parse_chart *c = w->chart;
    uint32_t word = c->grammar->words[from->at], argument = TN_WORD_ARGUMENT(word);
    switch (TN_WORD_OP(word)) {
    case TN_WORD_RULE:
        return to->child;
    case TN_WORD_EDGE:
        put_codon(w, c->tokens[from->end].edge);
        break;
    case TN_WORD_SAME:
        if (chart_letter(from->letters, argument) == TN_CHART_UNBOUND)
            put_codon(w, c->tokens[from->end].edge);
        break;
    case TN_WORD_REPEAT:
        put_loop(w, true, to->at == from->at + 1);
        break;
    case TN_WORD_AGAIN:
        put_loop(w, false, to->at != from->at + 1);
        break;
    case TN_WORD_MAYBE:
        put_codon(w, argument > 0 && to->at == from->at + 1);
        break;
    case TN_WORD_TERMINAL:
    case TN_WORD_DONE:
        break;
    }
    return TN_CHART_NONE;
}

static void write_genome(writer *w, uint32_t finished)
{
    open_instance(w, finished, 1);
    while (w->open_count && !w->failed) {
        instance *top = &w->open[w->open_count - 1];
        if (top->next + 1 == top->end) {
            w->step_count = top->first;
            w->open_count--;
            continue;
        }
        const chart_item *items = w->chart->items;
        uint32_t child = write_step(w, &items[w->steps[top->next]], &items[w->steps[top->next + 1]]);
        uint32_t depth = top->depth + 1;
        top->next++;
        if (child != TN_CHART_NONE)
            open_instance(w, child, depth);
    }
    free(w->steps);
    free(w->open);
    free(w->rounds);
}

/* ---- all */

static tn_status check_depth(const parse_chart *c, uint32_t value, const tn_invert_options *options, tn_error *error)
{
    bool ge = c->grammar->dialect == TN_DIALECT_GE;
    uint32_t needed = ge ? value : value ? value + 1 : 0;
    if (!options->max_depth || needed <= options->max_depth)
        return TN_OK;
    tn_fail(error, TN_INVALID, E_NOT_DERIVABLE,
            "no genome gives this sentence within a depth of %u: its shallowest derivation needs %u",
            options->max_depth, needed);
    tn_error_help(error, "raise it with --max-depth %u", needed);
    return TN_INVALID;
}

tn_status tn_invert(const tn_grammar *grammar, const char *sentence, size_t size, const tn_invert_options *options,
                    tn_genome *genome, tn_error *error)
{
    genome->count = 0;
    if (size > UINT32_MAX / 2)
        return tn_fail(error, TN_LIMIT, E_INVERT_LIMIT, "the sentence is longer than %u bytes, the limit",
                       UINT32_MAX / 2);
    parse_chart chart = {.grammar = grammar, .sentence = sentence, .size = size};
    chart.watch = options->watch;
    chart.max_items = options->max_items ? options->max_items : TN_INVERT_ITEMS;
    tn_status status = TN_OK;
    if (grammar->dialect == TN_DIALECT_GE) {
        chart.length = (uint32_t)size;
    } else {
        status = split(&chart, error);
        if (status == TN_OK)
            status = check_edges(&chart, error);
    }
    uint32_t result = TN_CHART_NONE;
    if (status == TN_OK)
        status = chart_parse(&chart, &result, error);
    if (status == TN_OK && result == TN_CHART_NONE)
        status = not_derivable(&chart, error);
    if (status == TN_OK)
        status = check_depth(&chart, chart.finished[result].value, options, error);
    if (status == TN_OK) {
        writer w = {.chart = &chart, .options = options, .genome = genome};
        write_genome(&w, result);
        if (w.failed)
            status = tn_fail_memory(error);
    }
    chart_clear(&chart);
    return status;
}
