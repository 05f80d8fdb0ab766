/* What a tn_unrolled is made of: for the files that implement unroll.h. */
#ifndef TARTAN_PLAN_SEARCH_UNROLL_DATA_H
#define TARTAN_PLAN_SEARCH_UNROLL_DATA_H

#include "runtime/plan/match/postfix.h"
#include "runtime/plan/search/unroll.h"

/* A relation: a gate for each stretch, row by row; or, of the whole plan alone, one. */
typedef struct tn_symbolic {
    tn_signal *cells;
    bool plain; /* the one of [0, N) */
} tn_symbolic;

/* A function that is being worked out. */
typedef struct unroll_frame {
    uint32_t memo; /* where its relation goes */
    tn_postfix code;
    size_t at; /* the node to do next */
    bool reversed;
} unroll_frame;

/* Of a circle of functions, each is worked out again until nothing new is found. */
typedef struct unroll_circle {
    size_t first, count; /* of its functions, in the list of members */
    size_t next;
    size_t frame; /* its place among the frames */
    bool reversed, changed;
} unroll_circle;

/* What the trays of each place count, of one function of trays. */
typedef struct unroll_counts {
    const int64_t *of_tray; /* whose they are: a term's, or `lengths` */
    int64_t *lengths;       /* of a field (owned), or NULL */
    uint32_t field;
    tn_tray_counts counts;
    tn_signal *gates; /* [places][counts.count] */
} unroll_counts;

struct tn_unrolled {
    tn_circuit *circuit;
    const tn_letters *letters;
    const tn_schema *schema;
    const tn_module *module;
    uint32_t length;
    size_t *row;        /* [length + 1]: where a row begins, less its number: cell [i, j) is row[i] + j */
    size_t cells;       /* of a relation */
    uint64_t room;      /* cells that there may still be */
    tn_symbolic *memos; /* [FUNCTION records][4]: plain, reversed */
    unroll_frame *frames;
    size_t frame_count, frame_capacity;
    tn_symbolic *stack;
    size_t depth, stack_capacity;
    unroll_circle *circles;
    size_t circle_count, circle_capacity;
    uint32_t *members;
    size_t member_count, member_capacity;
    tn_sum **sums; /* [SUM records] */
    unroll_counts *counts;
    size_t count_count, count_capacity;
    tn_adder adder;
    tn_signal *gates;         /* [cells or more]: room for one operation */
    uint8_t *truths;          /* [length + 1] */
    tn_adder_choice *choices; /* room for the counts of one place */
    size_t choice_capacity;
};

static inline tn_signal tn_symbolic_at(const tn_unrolled *u, const tn_symbolic *relation, uint32_t i, uint32_t j)
{
    return relation->cells[relation->plain ? 0 : u->row[i] + j];
}

/* A relation of no stretches, or of the whole plan. */
tn_status tn_symbolic_new(tn_unrolled *u, bool plain, tn_symbolic *relation, tn_error *error);
void tn_symbolic_free(tn_unrolled *u, tn_symbolic *relation);

/* An operation on relations: any instruction but CALL, MIRROR, AGAIN, IMAGE and comparisons (unroll_operations.c). */
tn_status tn_unroll_operate(tn_unrolled *u, const tn_postfix_node *node, bool reversed, const tn_symbolic *in,
                            tn_symbolic *out, tn_error *error);

/* QUANTITY, SUM, OCCURRENCES and comparisons (unroll_sums.c). The relations that a comparison's terms count are
 * memoised. */
tn_status tn_unroll_count(tn_unrolled *u, const tn_instruction *op, bool reversed, const tn_symbolic *in,
                          tn_symbolic *out, tn_error *error);
tn_status tn_unroll_compare(tn_unrolled *u, const tn_instruction *op, const tn_sum *sum, bool reversed,
                            tn_symbolic *out, tn_error *error);
/* As tn_unrolled_value: the relations that the sum's terms count are memoised. */
tn_status tn_unroll_values(tn_unrolled *u, const tn_sum *sum, tn_adder *adder, tn_signal *has, tn_error *error);
void tn_unroll_clear_sums(tn_unrolled *u);

/* The sum made ready, now or before. */
tn_status tn_unroll_summed(tn_unrolled *u, uint32_t index, const tn_sum **sum, tn_error *error);

/* Where the relation of a function is kept. */
static inline uint32_t tn_unroll_memo(uint32_t function, bool plain, bool reversed)
{
    return 4 * function + 2 * plain + reversed;
}

/* The relation of a function on all stretches, which is known. */
static inline const tn_symbolic *tn_unroll_known(const tn_unrolled *u, uint32_t function, bool reversed)
{
    return &u->memos[tn_unroll_memo(function, false, reversed)];
}

#endif
