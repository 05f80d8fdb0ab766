/* Finds a genome for a sentence. */
#include "runtime/genome/mapping/invert.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/genome/mapping/chart.h"

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

static tn_status split(tn_chart *c, tn_error *error)
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
            (tn_chart_token){(uint32_t)begin, (uint32_t)(at - begin), edge_of(c->sentence + begin, at - begin)};
    }
    return TN_OK;
}

/* A genome can only bring in edge types in their order: Edge0 and Edge1 are there, then Edge2, and so on. */
static tn_status check_edges(const tn_chart *c, tn_error *error)
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

static tn_status not_derivable(const tn_chart *c, tn_error *error)
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
    tn_chart *chart;
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
    tn_chart *c = w->chart;
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
static uint32_t write_step(writer *w, const tn_chart_item *from, const tn_chart_item *to)
{
    const tn_chart *c = w->chart;
    uint32_t word = c->grammar->words[from->at], argument = TN_WORD_ARGUMENT(word);
    switch (TN_WORD_OP(word)) {
    case TN_WORD_RULE:
        return to->child;
    case TN_WORD_EDGE:
        put_codon(w, c->tokens[from->end].edge);
        break;
    case TN_WORD_SAME:
        if (tn_chart_letter(from->letters, argument) == TN_CHART_UNBOUND)
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
        const tn_chart_item *items = w->chart->items;
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

static tn_status check_depth(const tn_chart *c, uint32_t value, const tn_invert_options *options, tn_error *error)
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
    tn_chart chart = {.grammar = grammar, .sentence = sentence, .size = size};
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
        status = tn_chart_parse(&chart, &result, error);
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
    tn_chart_clear(&chart);
    return status;
}
