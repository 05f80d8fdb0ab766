/* What a tn_plan_vm is made of, for the files that implement vm.h. */
#ifndef TARTAN_PLAN_MATCH_VM_DATA_H
#define TARTAN_PLAN_MATCH_VM_DATA_H

#include "runtime/plan/match/vm.h"
#include "runtime/plan/schema/classes.h"
#include "runtime/plan/schema/sum.h"

#define TN_VM_ROWS 4 /* of bits, that an operation needs beside its relations */

/* A function that is being evaluated, on the plan or (reversed) on the plan turned round. */
typedef struct vm_frame {
    uint32_t function;
    uint32_t offset; /* of the instruction to run next */
    bool reversed;
} vm_frame;

/* Where a function's relation lies among those found, if that was for this plan. Of a function in a circle that is gone
 * round, it is what is known of it so far. */
typedef struct vm_memo {
    uint32_t generation;
    uint32_t slot;
} vm_memo;

/* A circle of functions that is being gone round until nothing new is found: what they say of one another only grows,
 * so that this is the least solution, and in round n it is right for stretches of up to n trays. */
typedef struct vm_circle {
    size_t first, count; /* of its functions, in the vm's list */
    size_t next;         /* which of them is being evaluated */
    size_t frame;        /* its place among the frames */
    bool reversed, changed;
} vm_circle;

typedef struct vm_image vm_image; /* of an IMAGE (vm_image.c) */

/* Relations one after another, each of the vm's relation_size words. */
typedef struct vm_relations {
    uint64_t *words;
    size_t capacity; /* words */
    size_t count;    /* relations */
} vm_relations;

struct tn_plan_vm {
    const tn_schema *schema;
    const tn_module *module;
    size_t max_length;
    uint64_t memory_limit, memory; /* bytes */
    uint64_t work_limit, work;     /* words; what is left of the limit */

    tn_plan_vm_ask *ask; /* about the house on the plan, or NULL */
    void *house;
    const uint32_t *disabled; /* offsets of instructions whose relations are empty */
    size_t disabled_count;

    tn_tray *trays;
    size_t length;
    size_t words;         /* of a row */
    size_t relation_size; /* words of a relation */
    tn_sum **summed;      /* [SUM records], NULL where not met yet */
    uint32_t generation;  /* of the plan; a memo of another one is void */
    vm_memo *memos;       /* [function][reversed] */
    vm_relations found;   /* relations of functions */
    vm_relations stack;   /* operands of all frames */
    vm_frame *frames;
    size_t frame_count, frame_capacity;
    vm_circle *circles; /* those being gone round, from the outside in */
    size_t circle_count, circle_capacity;
    uint32_t *members; /* their functions */
    size_t member_count, member_capacity;

    vm_image **images; /* those met so far */
    size_t image_count, image_capacity;
    uint64_t tries_limit, tries; /* newer plans for one call; what is left of the limit */

    /* Room for a plan of `room` trays and one operation on it, all in one block. */
    size_t room;
    void *room_block;
    size_t room_bytes;
    uint64_t *rows;  /* TN_VM_ROWS rows */
    size_t *places;  /* [N + 1] */
    int64_t *sums;   /* [N + 1] */
    uint8_t *truths; /* [N + 1] */
};

/* Whether any of the relations that a sum's terms count is still to be found: then *function is one (vm_sum.c). */
bool tn_plan_vm_sum_needs(const tn_plan_vm *vm, const tn_sum *sum, bool reversed, uint32_t *function);

/* BELOW, ZERO, ABOVE, MULTIPLE: writes the relation of the stretches on which the sum compares so. */
void tn_plan_vm_compare(tn_plan_vm *vm, const tn_instruction *op, const tn_sum *sum, uint64_t *relation, bool reversed);

/* The sum made ready, now or before. */
tn_status tn_plan_vm_summed(tn_plan_vm *vm, uint32_t index, const tn_sum **sum, tn_error *error);

/* The relation of a function that has been found for this plan (or its reverse), or NULL. */
const uint64_t *tn_plan_vm_found(const tn_plan_vm *vm, uint32_t function, bool reversed);

/* IMAGE, on the plan or (reversed) on the plan turned round: is there a newer plan above it? E0808 past the tries. */
tn_status tn_plan_vm_image(tn_plan_vm *vm, const tn_instruction *op, bool reversed, bool *found, tn_error *error);
void tn_plan_vm_free_images(tn_plan_vm *vm);

/* Runs an operation on the relations from `top` on, the last of the stack: any instruction but CALL, MIRROR and RETURN
 * (vm_operations.c). */
void tn_plan_vm_operate(tn_plan_vm *vm, const tn_instruction *op, uint64_t *top, bool reversed);

#endif
