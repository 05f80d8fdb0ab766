/* The chart of an Earley parser over a grammar's words: which stretches of a sentence each production can write.
 * Internal to inverting. */
#ifndef TARTAN_GENOME_MAPPING_CHART_H
#define TARTAN_GENOME_MAPPING_CHART_H

#include "runtime/genome/mapping/invert.h"

#define TN_CHART_NONE UINT32_MAX
#define TN_CHART_UNBOUND 0x1FFFFFu /* of an edge variable; edge numbers are below */
#define TN_CHART_LETTER_BITS 21u

/* One position of the sentence that a terminal starts at: a byte in ge, a token in genr8. */
typedef struct tn_chart_token {
    uint32_t begin, length; /* in the sentence */
    uint32_t edge;          /* its number, or TN_CHART_NONE */
} tn_chart_token;

/* A production written from `begin` up to its word `at`, which stands at `end`. */
typedef struct tn_chart_item {
    uint32_t at, begin, end;
    uint32_t value;   /* how much depth it needs, the least found */
    uint64_t letters; /* numbers of its edge variables, TN_CHART_LETTER_BITS each */
    uint32_t before;  /* the item that it came from, or TN_CHART_NONE */
    uint32_t child;   /* the finished item of the rule in between, or TN_CHART_NONE */
    uint32_t link;    /* next in the list of items that wait for the same rule at the same place */
    bool queued;
} tn_chart_item;

/* A rule that can write the sentence from `begin` to `end`. */
typedef struct tn_chart_finished {
    uint32_t rule, begin, end;
    uint32_t value;
    uint32_t item; /* which does */
    uint32_t link; /* next of the same rule and begin */
} tn_chart_finished;

/* A rule wanted at a place: who waits for it, and how it was finished. */
typedef struct tn_chart_goal {
    uint32_t rule, begin;
    uint32_t waiting, finished;
} tn_chart_goal;

typedef struct tn_chart_table {
    uint32_t *slots;
    size_t size, used;
} tn_chart_table;

typedef struct tn_chart {
    const tn_grammar *grammar;
    const char *sentence;
    size_t size;
    tn_chart_token *tokens; /* genr8; in ge, bytes stand for themselves */
    uint32_t length;        /* positions */
    uint32_t *loop_of;      /* by word: of an AGAIN, its REPEAT */
    tn_chart_item *items;
    size_t item_count, item_capacity, max_items;
    uint64_t steps; /* items added, or met again */
    tn_chart_finished *finished;
    size_t finished_count, finished_capacity;
    tn_chart_goal *goals;
    size_t goal_count, goal_capacity;
    tn_chart_table item_table, finished_table, goal_table;
    uint32_t *queue;
    size_t queue_begin, queue_end, queue_capacity;
    /* the furthest place reached, and what would have gone on from there */
    uint32_t furthest;
    uint32_t expected[8]; /* words */
    size_t expected_count;
    bool out_of_memory, too_many;
    tn_watch *watch; /* or NULL */
} tn_chart;

/* An ambiguous grammar meets its items again and again, in the worst case with the cube of the sentence's length: that
 * is bounded by this many steps an item that is allowed, ten times what sentences without much ambiguity take. */
#define TN_CHART_STEPS 32u

/* Parses; the finished record of the start symbol over the whole sentence in *result, TN_CHART_NONE where there is
 * none. */
tn_status tn_chart_parse(tn_chart *chart, uint32_t *result, tn_error *error);
void tn_chart_clear(tn_chart *chart);

static inline uint32_t tn_chart_letter(uint64_t letters, uint32_t letter)
{
    return (uint32_t)(letters >> (letter * TN_CHART_LETTER_BITS)) & TN_CHART_UNBOUND;
}

#endif
