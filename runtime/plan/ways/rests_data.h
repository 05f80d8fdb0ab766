/* What rests are made of, for the files that implement rests.h. */
#ifndef TARTAN_PLAN_WAYS_RESTS_DATA_H
#define TARTAN_PLAN_WAYS_RESTS_DATA_H

#include "runtime/automata/numbering.h"
#include "runtime/automata/operand.h"
#include "runtime/plan/ways/rests.h"

#define NEVER (UINT32_C(1) << 30) /* trays: there is no such stretch */

/* What stands on a stack, as words: what it is, and four numbers. All but TIED take a tray at least. */
typedef enum symbol_kind {
    SYMBOL_NODE,  /* node, side */
    SYMBOL_MORE,  /* neighbour, side, k: some of its parts from the k-th on, as they are read */
    SYMBOL_TIMES, /* repeat, side, k: more stretches after k */
    SYMBOL_HAVE,  /* rule, side, goal, start: the rule is there from the goal's first tray on, and is not all of it */
    SYMBOL_FACT,  /* fact, state: letters are to come */
    SYMBOL_PAIR,  /* two stacks for the same stretch */
    SYMBOL_TIED,  /* the plan ends here */
} symbol_kind;

enum { SYMBOL_WORDS = 5 };

typedef struct symbol {
    symbol_kind kind;
    uint32_t of, side, k, start; /* of a pair: the first two are the stacks; of a fact: fact and state */
} symbol;

/* A fact on one side, read over marked words. */
typedef struct fact {
    tn_dfa *dfa;
    tn_operand of;
    uint32_t *least; /* [states]: letters to read, one or more, until the stretch may end; NEVER */
    uint32_t ahead;  /* its place in what is known ahead; UINT32_MAX: what lies before does not matter */
} fact;

/* A way to the left end of a rule that uses itself there. */
typedef struct corner {
    uint32_t rule;         /* of the same circle, or TN_NOT_DERIVED: */
    uint32_t node;         /* what else stands there */
    uint32_t first, count; /* symbols of the rest of the rule, in `behind` */
    bool start;            /* only from the plan's beginning on */
} corner;

/* A rule on one side. */
typedef struct side_of_rule {
    uint32_t group; /* of rules that use each other at their left ends; 0: none */
    corner *corners;
    uint32_t count;
    size_t room;
} side_of_rule;

/* What a symbol begins with: symbols for the stack, the first of which is a fact or a pair. */
typedef struct opened {
    bool made;
    tn_rest_list list; /* of prefixes */
} opened;

/* Stacks with what else the trays to come have to be. */
typedef struct config {
    uint32_t stack, duty;
    mpz_t ways;
} config;

typedef struct configs {
    config *items;
    size_t count, room;
} configs;

struct tn_rests {
    const tn_derivation *derivation; /* or NULL: */
    const tn_projected *projected;   /* rests are its states, and nothing is known ahead */
    uint32_t longest;
    bool tied;         /* something is at the plan's beginning or end */
    uint32_t *fact_of; /* [nodes][TN_SIDES] */
    fact *facts;
    uint32_t fact_count, ahead_count;
    size_t fact_room;
    uint32_t *least;     /* [nodes]: trays */
    side_of_rule *rules; /* [rules][TN_SIDES] */
    uint32_t *behind;    /* symbols of corners */
    size_t behind_count, behind_room;

    tn_interner symbols, prefixes, stacks, duties, aheads, rests; /* stack 0 and duty 0 are empty */
    uint32_t *stack_least;                                        /* [stacks.count] */
    size_t stack_least_room;
    tn_interner asked; /* symbol, ahead, start */
    opened **opened;
    uint32_t opened_count;
    size_t opened_room;
    tn_interner steps; /* rest, letter, ahead */
    tn_rest_list **read;
    uint32_t read_count;
    size_t read_room;
    tn_rest_list begin;
    unsigned deep;
};

/* ---- rests.c: numbers of things */
tn_status tn_rests_number(tn_rests *rests, tn_interner *interner, const uint32_t *words, size_t count, uint32_t *number,
                          tn_error *error);
tn_status tn_rests_symbol(tn_rests *rests, symbol made, uint32_t *number, tn_error *error);
symbol tn_rests_symbol_of(const tn_rests *rests, uint32_t number);
tn_status tn_rests_push(tn_rests *rests, uint32_t symbol, uint32_t stack, uint32_t *out, tn_error *error);

/* ---- rests_facts.c */
tn_status tn_rests_facts(tn_rests *rests, tn_lowering *lowering, tn_error *error); /* also the least trays of nodes */

/* ---- rests_corners.c */
tn_status tn_rests_corners(tn_rests *rests, tn_error *error);
/* The k-th part of a neighbour, or more, as they are read. */
uint32_t tn_rests_part(const tn_rests *rests, uint32_t neighbour, uint32_t side, uint32_t k);
bool tn_rests_may_end(const tn_rests *rests, uint32_t neighbour, uint32_t side,
                      uint32_t k); /* all from k on: optional */

static inline bool tn_tied_start(const tn_derived *node, uint32_t side)
{
    return side == TN_SIDE_WRITTEN ? node->beginning : node->end;
}

static inline bool tn_tied_end(const tn_derived *node, uint32_t side)
{
    return side == TN_SIDE_WRITTEN ? node->end : node->beginning;
}

/* ---- rests_open.c: what a symbol begins with; start: at the plan's beginning */
tn_status tn_rests_open(tn_rests *rests, symbol of, uint32_t ahead, bool start, const tn_rest_list **list,
                        tn_error *error);

#endif
