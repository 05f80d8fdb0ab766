/* Parses a sentence by Earley's method, for inverting. */
#include "runtime/genome/mapping/chart.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/base/random.h"

enum { ITEMS_BETWEEN_LOOKS = 256 }; /* at the watch */

void tn_chart_clear(tn_chart *c)
{
    free(c->tokens);
    free(c->loop_of);
    free(c->items);
    free(c->finished);
    free(c->goals);
    free(c->item_table.slots);
    free(c->finished_table.slots);
    free(c->goal_table.slots);
    free(c->queue);
    *c = (tn_chart){0};
}

static bool grow(tn_chart *c, void *items, size_t *capacity, size_t count, size_t size)
{
    bool fine = tn_array_reserve(items, capacity, count, 1, size);
    c->out_of_memory |= !fine;
    return fine;
}

/* ---- hash tables of indices: the caller compares and hashes */

static bool table_grow(tn_chart *c, tn_chart_table *table, uint64_t (*hash)(const tn_chart *, uint32_t))
{
    if (table->used * 2 < table->size)
        return true;
    size_t size = table->size ? table->size * 2 : 1024;
    uint32_t *slots = malloc(size * sizeof *slots);
    if (!slots) {
        c->out_of_memory = true;
        return false;
    }
    memset(slots, 0xFF, size * sizeof *slots);
    for (size_t i = 0; i < table->size; i++) {
        if (table->slots[i] == TN_CHART_NONE)
            continue;
        size_t place = (size_t)hash(c, table->slots[i]) & (size - 1);
        while (slots[place] != TN_CHART_NONE)
            place = (place + 1) & (size - 1);
        slots[place] = table->slots[i];
    }
    free(table->slots);
    table->slots = slots;
    table->size = size;
    return true;
}

static uint64_t key_hash(uint32_t a, uint32_t b, uint32_t d, uint64_t letters)
{
    return tn_mix64(tn_mix64((uint64_t)a << 32 | b) ^ d ^ letters << 32 ^ letters >> 32);
}

static uint64_t item_hash(const tn_chart *c, uint32_t i)
{
    return key_hash(c->items[i].at, c->items[i].begin, c->items[i].end, c->items[i].letters);
}

static uint64_t finished_hash(const tn_chart *c, uint32_t i)
{
    return key_hash(c->finished[i].rule, c->finished[i].begin, c->finished[i].end, 0);
}

static uint64_t goal_hash(const tn_chart *c, uint32_t i)
{
    return key_hash(c->goals[i].rule, c->goals[i].begin, 0, 0);
}

/* ---- items */

static void enqueue(tn_chart *c, uint32_t item)
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
static void add_item(tn_chart *c, tn_chart_item item)
{
    if (c->out_of_memory || c->too_many || !table_grow(c, &c->item_table, item_hash))
        return;
    if (++c->steps / TN_CHART_STEPS > c->max_items) {
        c->too_many = true;
        return;
    }
    tn_chart_table *table = &c->item_table;
    size_t place = (size_t)key_hash(item.at, item.begin, item.end, item.letters) & (table->size - 1);
    for (; table->slots[place] != TN_CHART_NONE; place = (place + 1) & (table->size - 1)) {
        tn_chart_item *there = &c->items[table->slots[place]];
        if (there->at != item.at || there->begin != item.begin || there->end != item.end ||
            there->letters != item.letters)
            continue;
        if (item.value < there->value) {
            there->value = item.value;
            there->before = item.before;
            there->child = item.child;
            enqueue(c, table->slots[place]);
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
    c->items[c->item_count] = item;
    table->slots[place] = (uint32_t)c->item_count;
    table->used++;
    enqueue(c, (uint32_t)c->item_count++);
}

/* The item after `index`, over a word that wrote the sentence up to `end`. */
static void advance(tn_chart *c, uint32_t index, uint32_t at, uint32_t end, uint64_t letters)
{
    tn_chart_item item = c->items[index];
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
static uint32_t finished_value(const tn_chart *c, const tn_chart_item *item, uint32_t production)
{
    const tn_production *p = &c->grammar->productions[production];
    if (c->grammar->dialect == TN_DIALECT_GE) {
        uint32_t own = p->symbols ? 2 : 1;
        return item->value > own ? item->value : own;
    }
    bool limited = p->children && c->grammar->rules[p->rule].closed_count;
    return limited && item->value < 1 ? 1 : item->value;
}

static void advance_over(tn_chart *c, uint32_t index, const tn_chart_finished *f)
{
    tn_chart_item item = c->items[index];
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
static uint32_t scan(const tn_chart *c, uint32_t terminal, uint32_t end)
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

static void expect(tn_chart *c, uint32_t word, uint32_t end)
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

static tn_chart_goal *goal_for(tn_chart *c, uint32_t rule, uint32_t begin, bool *is_new)
{
    *is_new = false;
    if (!table_grow(c, &c->goal_table, goal_hash))
        return NULL;
    tn_chart_table *table = &c->goal_table;
    size_t place = (size_t)key_hash(rule, begin, 0, 0) & (table->size - 1);
    for (; table->slots[place] != TN_CHART_NONE; place = (place + 1) & (table->size - 1)) {
        tn_chart_goal *goal = &c->goals[table->slots[place]];
        if (goal->rule == rule && goal->begin == begin)
            return goal;
    }
    if (!grow(c, &c->goals, &c->goal_capacity, c->goal_count, sizeof *c->goals))
        return NULL;
    *is_new = true;
    table->slots[place] = (uint32_t)c->goal_count;
    table->used++;
    c->goals[c->goal_count] = (tn_chart_goal){rule, begin, TN_CHART_NONE, TN_CHART_NONE};
    return &c->goals[c->goal_count++];
}

/* Starts every production of a rule; those whose first terminal does not stand there are left out at once. */
static void predict(tn_chart *c, uint32_t rule, uint32_t begin)
{
    const tn_rule *r = &c->grammar->rules[rule];
    for (uint32_t p = r->first; p < r->first + r->count && !c->too_many && !c->out_of_memory; p++) {
        uint32_t at = c->grammar->productions[p].words, word = c->grammar->words[at];
        if (TN_WORD_OP(word) == TN_WORD_TERMINAL && scan(c, TN_WORD_ARGUMENT(word), begin) == TN_CHART_NONE) {
            expect(c, word, begin);
            continue;
        }
        add_item(c, (tn_chart_item){.at = at,
                                    .begin = begin,
                                    .end = begin,
                                    .letters = UINT64_MAX >> 1,
                                    .before = TN_CHART_NONE,
                                    .child = TN_CHART_NONE});
    }
}

static void want_rule(tn_chart *c, uint32_t index, uint32_t rule)
{
    bool is_new;
    uint32_t end = c->items[index].end;
    tn_chart_goal *goal = goal_for(c, rule, end, &is_new);
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

/* Records that a rule is finished; false where it was, and not worse. */
static bool finish(tn_chart *c, tn_chart_finished f, uint32_t *index)
{
    bool is_new;
    if (!table_grow(c, &c->finished_table, finished_hash))
        return false;
    tn_chart_table *table = &c->finished_table;
    size_t place = (size_t)key_hash(f.rule, f.begin, f.end, 0) & (table->size - 1);
    for (; table->slots[place] != TN_CHART_NONE; place = (place + 1) & (table->size - 1)) {
        tn_chart_finished *there = &c->finished[table->slots[place]];
        if (there->rule != f.rule || there->begin != f.begin || there->end != f.end)
            continue;
        if (f.value >= there->value)
            return false;
        there->value = f.value;
        there->item = f.item;
        *index = table->slots[place];
        return true;
    }
    tn_chart_goal *goal = goal_for(c, f.rule, f.begin, &is_new);
    if (!goal || !grow(c, &c->finished, &c->finished_capacity, c->finished_count, sizeof *c->finished))
        return false;
    f.link = goal->finished;
    *index = (uint32_t)c->finished_count++;
    goal->finished = *index;
    c->finished[*index] = f;
    table->slots[place] = *index;
    table->used++;
    return true;
}

static void complete(tn_chart *c, uint32_t index)
{
    const tn_chart_item *item = &c->items[index];
    uint32_t production = production_at(c->grammar, item->at), done;
    tn_chart_finished f = {.rule = c->grammar->productions[production].rule,
                           .begin = item->begin,
                           .end = item->end,
                           .value = finished_value(c, item, production),
                           .item = index};
    if (!finish(c, f, &done))
        return;
    bool is_new;
    const tn_chart_goal *goal = goal_for(c, f.rule, f.begin, &is_new);
    for (uint32_t w = goal ? goal->waiting : TN_CHART_NONE; w != TN_CHART_NONE && !c->too_many && !c->out_of_memory;) {
        uint32_t next = c->items[w].link;
        advance_over(c, w, &c->finished[done]);
        if (next == w)
            break;
        w = next;
    }
}

/* ---- the loop */

static void process(tn_chart *c, uint32_t index)
{
    const tn_chart_item item = c->items[index];
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
        uint32_t bound = tn_chart_letter(item.letters, argument);
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

static bool find_loops(tn_chart *c)
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

tn_status tn_chart_parse(tn_chart *c, uint32_t *result, tn_error *error)
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
