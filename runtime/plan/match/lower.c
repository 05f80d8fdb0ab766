/* Lowers rule functions to automata. */
#include "runtime/plan/match/lower.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/automata/equations.h"
#include "runtime/automata/marked.h"
#include "runtime/automata/numbering.h"
#include "runtime/module/code.h"
#include "runtime/plan/match/summing.h"
#include "runtime/plan/match/tray_relations.h"

/* The forms in which a function may be needed: of the plan as a whole (PLAIN: over the classes), or as a relation (over
 * marked words); each as it is written or with the plan reversed. */
typedef enum tn_form { FORM_PLAIN = 1, FORM_REVERSED = 2, FORM_COUNT = 4 } tn_form;

typedef struct tn_lowered {
    tn_dfa *dfa;     /* NULL: not yet, or failed */
    tn_error *error; /* why it failed; NULL otherwise */
} tn_lowered;

/* All rules of a lowering together may take this many times the work of one. */
#define RULES_WORK 8

struct tn_lowering {
    const tn_module *module;
    const tn_classes *classes;
    tn_bounds bounds;
    tn_marked marked;
    uint32_t max_trays;       /* of the plans that the automata are asked about; 0: not known */
    uint8_t *local;           /* [FUNCTION records]: tn_summing_is_local's */
    tn_sum **sums;            /* [SUM records], NULL where not met yet */
    uint64_t spent;           /* work on the rules before */
    const uint32_t *disabled; /* code offsets of instructions that give nothing */
    size_t disabled_count;
    tn_lowering_ask *ask; /* about houses, or NULL */
    void *house;
    tn_lowered *lowered; /* [functions][FORM_COUNT] */
};

/* An instruction of a function, and in which form its result is wanted. */
typedef struct tn_node {
    tn_instruction code;
    uint32_t offset;
    bool plain;
} tn_node;

typedef struct tn_term {
    tn_node *nodes; /* in code order, without the final RETURN */
    size_t count;
    tn_dfa **stack;
    size_t depth;
} tn_term;

tn_status tn_lowering_new(const tn_classes *classes, uint32_t max_states, tn_lowering **out, tn_error *error)
{
    tn_lowering *lowering = calloc(1, sizeof *lowering);
    if (!lowering)
        return tn_fail_memory(error);
    lowering->module = classes->schema->module;
    lowering->classes = classes;
    lowering->bounds = tn_bounds_make(max_states ? max_states : TN_STATES_DEFAULT);
    lowering->bounds.watch = lowering->module->watch;
    lowering->lowered = calloc(lowering->module->FUNCTION_count * FORM_COUNT + 1, sizeof *lowering->lowered);
    lowering->local = calloc(lowering->module->FUNCTION_count + 1, 1);
    tn_status status = lowering->lowered && lowering->local
                           ? tn_marked_make(&lowering->marked, classes->count, &lowering->bounds, error)
                           : tn_fail_memory(error);
    if (status != TN_OK) {
        tn_lowering_free(lowering);
        return status;
    }
    *out = lowering;
    return TN_OK;
}

void tn_lowering_free(tn_lowering *lowering)
{
    if (!lowering)
        return;
    for (size_t i = 0; lowering->lowered && i < lowering->module->FUNCTION_count * FORM_COUNT; i++) {
        tn_dfa_free(lowering->lowered[i].dfa);
        free(lowering->lowered[i].error);
    }
    for (size_t i = 0; lowering->sums && i < lowering->module->SUM_count; i++)
        tn_sum_free(lowering->sums[i]);
    free(lowering->sums);
    free(lowering->local);
    free(lowering->lowered);
    tn_marked_clear(&lowering->marked);
    free(lowering);
}

void tn_lowering_within(tn_lowering *lowering, uint32_t max_trays)
{
    lowering->max_trays = max_trays > 0 ? max_trays : 1; /* 0 says that it is not known */
}

void tn_lowering_disable(tn_lowering *lowering, const uint32_t *offsets, size_t count)
{
    lowering->disabled = offsets;
    lowering->disabled_count = count;
}

void tn_lowering_house(tn_lowering *lowering, tn_lowering_ask *ask, void *house)
{
    lowering->ask = ask;
    lowering->house = house;
}

static bool is_disabled(const tn_lowering *lowering, uint32_t offset)
{
    for (size_t i = 0; i < lowering->disabled_count; i++)
        if (lowering->disabled[i] == offset)
            return true;
    return false;
}

/* ---- reading a function */

/* At the plan's level AND, OR and NOT are about the plan, so their operands are wanted plain too. Code is in postfix
 * order: the operands of a node are found from its end backwards. `start` of a node is where its own code begins. */
static void mark_plain(tn_term *term, const size_t *start, bool plain)
{
    if (term->count == 0)
        return;
    term->nodes[term->count - 1].plain = plain;
    for (size_t i = term->count; i-- > 0;) {
        tn_opcode opcode = term->nodes[i].code.opcode;
        if (!term->nodes[i].plain || (opcode != TN_OP_AND && opcode != TN_OP_OR && opcode != TN_OP_NOT))
            continue;
        term->nodes[i - 1].plain = true;
        if (opcode != TN_OP_NOT)
            term->nodes[start[i - 1] - 1].plain = true;
    }
}

/* Where each node's code begins, from the stack's effects. */
static bool find_starts(const tn_term *term, size_t *start)
{
    size_t *open = malloc((term->count + 1) * sizeof *open);
    if (!open)
        return false;
    size_t depth = 0;
    for (size_t i = 0; i < term->count; i++) {
        tn_opcode_effect effect = tn_code_effect((uint8_t)term->nodes[i].code.opcode);
        size_t first = i;
        for (uint8_t p = 0; p < effect.pops; p++)
            first = open[--depth];
        start[i] = first;
        open[depth++] = first;
    }
    free(open);
    return true;
}

static void term_clear(tn_term *term)
{
    while (term->depth > 0)
        tn_dfa_free(term->stack[--term->depth]);
    free(term->stack);
    free(term->nodes);
    *term = (tn_term){0};
}

/* Code that leaves one relation on the stack; `deepest` are on it at most. */
static tn_status term_read_code(const tn_module *module, uint32_t begin, uint32_t end, uint32_t deepest, bool plain,
                                tn_term *term, tn_error *error)
{
    size_t bytes = end - begin;
    *term = (tn_term){0};
    term->nodes = calloc(bytes + 1, sizeof *term->nodes);
    term->stack = calloc((size_t)deepest + 1, sizeof *term->stack);
    size_t *start = malloc((bytes + 1) * sizeof *start);
    bool ok = term->nodes && term->stack && start;
    for (uint32_t offset = begin; ok && offset < end;) {
        tn_instruction code = tn_code_read(module->code, offset);
        if (code.opcode == TN_OP_RETURN)
            break;
        term->nodes[term->count++] = (tn_node){.code = code, .offset = offset};
        offset += code.length;
    }
    ok = ok && find_starts(term, start);
    if (ok)
        mark_plain(term, start, plain);
    free(start);
    if (ok)
        return TN_OK;
    term_clear(term);
    return tn_fail_memory(error);
}

static tn_status term_read(const tn_module *module, uint32_t function, bool plain, tn_term *term, tn_error *error)
{
    const tn_function_record *record = &module->FUNCTION_records[function];
    return term_read_code(module, record->code_begin, record->code_end, record->stack_max, plain, term, error);
}

/* ---- lowering instructions */

/* The functions called, in the form in which the caller wants them. */
static tn_lowered *called(const tn_lowering *lowering, const tn_node *node, uint32_t form, uint32_t *wanted)
{
    uint32_t other = (form & FORM_REVERSED) ^ (node->code.opcode == TN_OP_MIRROR ? FORM_REVERSED : 0);
    *wanted = (uint32_t)node->code.first * FORM_COUNT + (other | (node->plain ? FORM_PLAIN : 0));
    return &lowering->lowered[*wanted];
}

static tn_status lower_boolean(tn_lowering *lowering, const tn_node *node, tn_dfa *const *in, tn_dfa **out,
                               tn_error *error)
{
    switch (node->code.opcode) {
    case TN_OP_AND:
        return tn_dfa_product(in[0], in[1], TN_DFA_AND, "and", &lowering->bounds, out, error);
    case TN_OP_OR:
        return tn_dfa_product(in[0], in[1], TN_DFA_OR, "or", &lowering->bounds, out, error);
    default:
        return node->plain ? tn_dfa_complement(in[0], out, error) : tn_marked_not(&lowering->marked, in[0], out, error);
    }
}

static tn_status lower_where(const tn_marked *marked, tn_dfa *const *in, tn_dfa **out, tn_error *error)
{
    tn_dfa *both = NULL;
    tn_status status = tn_dfa_product(in[0], in[1], TN_DFA_AND, "where", marked->bounds, &both, error);
    if (status == TN_OK)
        status = tn_dfa_product(both, marked->nonempty, TN_DFA_AND, "where", marked->bounds, out, error);
    tn_dfa_free(both);
    return status;
}

/* The relation of an instruction whose operands are relations. */
static tn_status lower_relation(const tn_lowering *lowering, const tn_node *node, bool reversed, tn_dfa *const *in,
                                tn_dfa **out, tn_error *error)
{
    const tn_marked *marked = &lowering->marked;
    const tn_classes *classes = lowering->classes;
    uint32_t first = (uint32_t)node->code.first, second = (uint32_t)node->code.second;
    switch (node->code.opcode) {
    case TN_OP_TRAY:
        return tn_relate_tray(marked, classes, first, out, error);
    case TN_OP_SOMEWHERE:
        return tn_marked_somewhere(marked, in[0], out, error);
    case TN_OP_ONCE:
        *out = tn_dfa_share(in[0]);
        return TN_OK;
    case TN_OP_NONEMPTY:
        return tn_dfa_product(in[0], marked->nonempty, TN_DFA_AND, "rule", marked->bounds, out, error);
    case TN_OP_OPTIONAL:
        return tn_dfa_product(in[0], marked->empty, TN_DFA_OR, "optional", marked->bounds, out, error);
    case TN_OP_CHAIN:
        return tn_marked_chain(marked, in[reversed], in[!reversed], out, error);
    case TN_OP_BEGINNING:
    case TN_OP_END: {
        const tn_dfa *place = (node->code.opcode == TN_OP_BEGINNING) != reversed ? marked->beginning : marked->end;
        return tn_dfa_product(in[0], place, TN_DFA_AND, "neighbour", marked->bounds, out, error);
    }
    case TN_OP_MANY:
        return tn_marked_many(marked, in[0], out, error);
    case TN_OP_REPEATED:
        return tn_marked_repeat(marked, in[0], first, second, out, error);
    case TN_OP_QUANTITY:
        return tn_relate_count(marked, classes, in[0], TN_TALLY_SINGLES, first, TN_NO_FIELD, out, error);
    case TN_OP_SUM:
        first -= classes->schema->record->field_first;
        return tn_relate_count(marked, classes, in[0], TN_TALLY_SINGLES, second, first, out, error);
    case TN_OP_OCCURRENCES:
        return tn_relate_count(marked, classes, in[0], reversed ? TN_TALLY_ENDS : TN_TALLY_STARTS, first, TN_NO_FIELD,
                               out, error);
    case TN_OP_DISTANCE:
        return tn_marked_distance(marked, in[0], in[1], in[2], reversed, out, error);
    case TN_OP_WHERE:
        return lower_where(marked, in, out, error);
    case TN_OP_MIRRORED:
        return tn_relate_mirrored(marked, classes, first - classes->schema->record->field_first, lowering->max_trays,
                                  out, error);
    case TN_OP_NEAR:
        return tn_marked_near(marked, in[0], in[1], in[2], out, error);
    case TN_OP_FAR:
        return tn_marked_far(marked, in[0], in[1], in[2], out, error);
    default:
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "an instruction that makes no relation");
    }
}

static tn_status summed(tn_lowering *lowering, uint32_t index, const tn_sum **sum, tn_error *error)
{
    if (!lowering->sums && !(lowering->sums = calloc(lowering->module->SUM_count + 1, sizeof(tn_sum *))))
        return tn_fail_memory(error);
    tn_status status =
        lowering->sums[index] ? TN_OK : tn_sum_new(lowering->classes->schema, index, &lowering->sums[index], error);
    if (status == TN_OK)
        *sum = lowering->sums[index];
    return status;
}

/* Is the term's automaton needed, or does each tray decide alone? */
static bool needs_part(const tn_lowering *lowering, const tn_term_record *term)
{
    return tn_term_counts(term->kind) == TN_SUM_STARTS ||
           !tn_summing_is_local(lowering->module, term->part, lowering->local);
}

static uint32_t part_wanted(const tn_term_record *term, uint32_t form)
{
    return term->part * FORM_COUNT + (form & FORM_REVERSED);
}

/* BELOW, ZERO, ABOVE, MULTIPLE: the parts are lowered. */
static tn_status lower_comparison(tn_lowering *lowering, const tn_node *node, uint32_t form, tn_dfa **out,
                                  tn_error *error)
{
    const tn_sum *sum = NULL;
    tn_status status = summed(lowering, (uint32_t)node->code.first, &sum, error);
    if (status != TN_OK)
        return status;
    tn_dfa **parts = calloc((size_t)sum->count + 1, sizeof(tn_dfa *));
    if (!parts)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < sum->count; i++) {
        const tn_term_record *term = &lowering->module->TERM_records[sum->record->term_first + i];
        if (needs_part(lowering, term))
            parts[i] = lowering->lowered[part_wanted(term, form)].dfa;
    }
    status = tn_relate_sum(&lowering->marked, lowering->classes, sum, parts, form & FORM_REVERSED, &node->code,
                           lowering->max_trays, out, error);
    free(parts);
    return status;
}

static tn_status lower_house(const tn_lowering *lowering, const tn_node *node, bool reversed, tn_dfa **out,
                             tn_error *error)
{
    if (!lowering->ask)
        return tn_fail(error, TN_INVALID, E_NOT_A_HOUSE, "a rule about houses was asked about a plan alone");
    return lowering->ask(lowering->house, &lowering->marked, &node->code, reversed, out, error);
}

static tn_status lower_node(tn_lowering *lowering, const tn_node *node, uint32_t form, tn_dfa *const *in, tn_dfa **out,
                            tn_error *error)
{
    uint32_t wanted;
    if (is_disabled(lowering, node->offset))
        return tn_dfa_constant(lowering->classes->count + !node->plain, false, out, error);
    switch (node->code.opcode) {
    case TN_OP_CALL:
    case TN_OP_MIRROR:
    case TN_OP_AGAIN:
        *out = tn_dfa_share(called(lowering, node, form, &wanted)->dfa);
        return TN_OK;
    case TN_OP_AND:
    case TN_OP_OR:
    case TN_OP_NOT:
        return lower_boolean(lowering, node, in, out, error);
    case TN_OP_SOMEWHERE:
        if (node->plain)
            return tn_marked_anywhere(&lowering->marked, in[0], out, error);
        break;
    default:
        break;
    }
    tn_dfa *relation = NULL;
    bool reversed = form & FORM_REVERSED;
    tn_status status = tn_code_compares(node->code.opcode) ? lower_comparison(lowering, node, form, &relation, error)
                       : tn_code_asks_house(node->code.opcode)
                           ? lower_house(lowering, node, reversed, &relation, error)
                           : lower_relation(lowering, node, reversed, in, &relation, error);
    if (status != TN_OK || !node->plain) {
        *out = relation;
        return status;
    }
    status = tn_marked_whole(&lowering->marked, relation, out, error);
    tn_dfa_free(relation);
    return status;
}

/* Lowers a function whose callees are lowered. */
static tn_status lower_term(tn_lowering *lowering, tn_term *term, uint32_t form, tn_dfa **out, tn_error *error)
{
    for (size_t i = 0; i < term->count; i++) {
        const tn_node *node = &term->nodes[i];
        uint8_t pops = tn_code_effect((uint8_t)node->code.opcode).pops;
        tn_dfa **in = term->stack + (term->depth - pops);
        tn_dfa *result = NULL;
        tn_status status = lower_node(lowering, node, form, in, &result, error);
        if (status != TN_OK) {
            if (error)
                error->code_offset = node->offset;
            return status;
        }
        for (; pops > 0; pops--)
            tn_dfa_free(term->stack[--term->depth]);
        term->stack[term->depth++] = result;
    }
    *out = term->stack[--term->depth];
    return TN_OK;
}

/* ---- circles of functions */

typedef struct tn_circle {
    uint32_t *members; /* functions; owned */
    uint32_t count, form;
    tn_term *terms;   /* [count]: their code */
    tn_linear *sides; /* [count]: of the equations */
    tn_dfa **empties; /* [count]: the empty stretches of each relation, or NULL */
    bool left, right; /* does an unknown stand before something, behind something? */
    bool linear;      /* and nowhere else? */
    tn_linear *stack; /* of the function at hand */
    size_t depth, room;
} tn_circle;

static uint32_t circle_number(const tn_circle *circle, uint32_t function)
{
    uint32_t i = 0;
    while (i < circle->count && circle->members[i] != function)
        i++;
    return i;
}

static void circle_clear(tn_circle *circle)
{
    for (uint32_t i = 0; i < circle->count; i++) {
        if (circle->terms)
            term_clear(&circle->terms[i]);
        if (circle->sides)
            tn_linear_clear(&circle->sides[i]);
        if (circle->empties)
            tn_dfa_free(circle->empties[i]);
    }
    while (circle->depth > 0)
        tn_linear_clear(&circle->stack[--circle->depth]);
    free(circle->members);
    free(circle->terms);
    free(circle->sides);
    free(circle->empties);
    free(circle->stack);
    *circle = (tn_circle){0};
}

/* Reads a function, and those that its circle leads to. */
static tn_status circle_read(const tn_lowering *lowering, uint32_t function, uint32_t form, tn_circle *circle,
                             tn_error *error)
{
    size_t functions = lowering->module->FUNCTION_count;
    *circle = (tn_circle){.form = form, .linear = true};
    circle->members = calloc(functions + 1, sizeof *circle->members);
    circle->terms = calloc(functions + 1, sizeof *circle->terms);
    if (!circle->members || !circle->terms)
        return tn_fail_memory(error);
    circle->members[circle->count++] = function;
    for (uint32_t i = 0; i < circle->count; i++) {
        tn_term *term = &circle->terms[i];
        tn_status status = term_read(lowering->module, circle->members[i], false, term, error);
        if (status != TN_OK)
            return status;
        for (size_t n = 0; n < term->count; n++) {
            uint32_t callee = (uint32_t)term->nodes[n].code.first;
            if (term->nodes[n].code.opcode == TN_OP_AGAIN && circle_number(circle, callee) == circle->count)
                circle->members[circle->count++] = callee;
        }
        circle->room = term->count > circle->room ? term->count : circle->room;
    }
    circle->sides = calloc(circle->count, sizeof *circle->sides);
    circle->empties = calloc(circle->count, sizeof *circle->empties);
    circle->stack = calloc(circle->room + 1, sizeof *circle->stack);
    return circle->sides && circle->empties && circle->stack ? TN_OK : tn_fail_memory(error);
}

static tn_status replace(tn_status status, tn_dfa **place, tn_dfa *made)
{
    if (status == TN_OK) {
        tn_dfa_free(*place);
        *place = made;
    }
    return status;
}

static tn_status join_rest(tn_lowering *lowering, tn_linear *side, tn_dfa *with, tn_dfa_operation operation,
                           tn_error *error)
{
    tn_dfa *made = NULL;
    if (!side->rest && operation == TN_DFA_OR)
        side->rest = tn_dfa_share(with);
    if (!side->rest || side->rest == with)
        return TN_OK;
    tn_status status = tn_dfa_product(side->rest, with, operation, "rule", &lowering->bounds, &made, error);
    return replace(status, &side->rest, made);
}

/* The lower of the two topmost becomes both in their order; of one of them all is known, or the equation is not linear.
 */
static tn_status circle_chain(tn_lowering *lowering, tn_circle *circle, tn_error *error)
{
    bool reversed = circle->form & FORM_REVERSED;
    tn_linear *lower = &circle->stack[circle->depth - 2], *upper = lower + 1;
    tn_linear *before = reversed ? upper : lower, *behind = reversed ? lower : upper;
    bool left = tn_linear_has_unknowns(before), right = tn_linear_has_unknowns(behind);
    circle->left |= left;
    circle->right |= right;
    circle->linear &= !(circle->left && circle->right);
    tn_linear *kept = left ? before : behind, *other = left ? behind : before;
    tn_status status = TN_OK;
    if (circle->linear && other->rest)
        status = tn_linear_chain(&lowering->marked, kept, other->rest, !left, error);
    else if (circle->linear) { /* nothing is there to stand beside */
        tn_linear_clear(kept);
        status = tn_linear_make(&lowering->marked, circle->count, TN_NO_STATE, kept, error);
    }
    tn_linear result = *kept;
    *kept = (tn_linear){0};
    tn_linear_clear(other);
    *lower = result;
    circle->depth--;
    return status;
}

/* An instruction whose operands have no unknowns. */
static tn_status circle_known(tn_lowering *lowering, tn_circle *circle, const tn_node *node, uint8_t pops,
                              tn_error *error)
{
    tn_dfa *in[TN_OPERANDS_MAX] = {0}, *made = NULL;
    tn_status status = TN_OK;
    for (uint8_t i = pops; i-- > 0;) {
        tn_linear *operand = &circle->stack[--circle->depth];
        in[i] = operand->rest;
        operand->rest = NULL;
        tn_linear_clear(operand);
        if (!in[i] && status == TN_OK)
            status = tn_dfa_constant(lowering->marked.letters, false, &in[i], error);
    }
    if (status == TN_OK)
        status = lower_node(lowering, node, circle->form, in, &made, error);
    for (uint8_t i = 0; i < pops; i++)
        tn_dfa_free(in[i]);
    if (status != TN_OK)
        return status;
    tn_linear *result = &circle->stack[circle->depth];
    status = tn_linear_make(&lowering->marked, circle->count, TN_NO_STATE, result, error);
    result->rest = made;
    circle->depth++;
    return status;
}

static tn_status circle_node(tn_lowering *lowering, tn_circle *circle, const tn_node *node, tn_error *error)
{
    uint8_t pops = tn_code_effect((uint8_t)node->code.opcode).pops;
    tn_linear *top = &circle->stack[circle->depth];
    bool unknown = false;
    for (uint8_t i = 1; i <= pops; i++)
        unknown |= tn_linear_has_unknowns(top - i);
    if (node->code.opcode == TN_OP_AGAIN && !is_disabled(lowering, node->offset)) {
        uint32_t number = circle_number(circle, (uint32_t)node->code.first);
        circle->depth++;
        tn_status status = tn_linear_make(&lowering->marked, circle->count, number, top, error);
        if (status == TN_OK && circle->empties[number])
            top->rest = tn_dfa_share(circle->empties[number]);
        return status;
    }
    if (!unknown)
        return circle_known(lowering, circle, node, pops, error);
    tn_status status = TN_OK;
    switch (is_disabled(lowering, node->offset) ? TN_OP_RETURN : node->code.opcode) {
    case TN_OP_OR:
        status = tn_linear_or(&lowering->marked, top - 2, top - 1, error);
        tn_linear_clear(top - 1);
        circle->depth--;
        return status;
    case TN_OP_CHAIN:
        return circle_chain(lowering, circle, error);
    case TN_OP_NONEMPTY: /* the unknowns are without empty stretches */
        return join_rest(lowering, top - 1, lowering->marked.nonempty, TN_DFA_AND, error);
    case TN_OP_OPTIONAL:
        return join_rest(lowering, top - 1, lowering->marked.empty, TN_DFA_OR, error);
    default:
        circle->linear = false;
        return TN_OK;
    }
}

/* The right-hand side of each equation; stops where one is not linear. */
static tn_status circle_sides(tn_lowering *lowering, tn_circle *circle, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && circle->linear && i < circle->count; i++) {
        const tn_term *term = &circle->terms[i];
        for (size_t n = 0; status == TN_OK && circle->linear && n < term->count; n++) {
            status = circle_node(lowering, circle, &term->nodes[n], error);
            if (status != TN_OK && error)
                error->code_offset = term->nodes[n].offset;
        }
        if (status != TN_OK || !circle->linear)
            break;
        tn_linear_clear(&circle->sides[i]);
        circle->sides[i] = circle->stack[--circle->depth];
    }
    return status;
}

static bool is_nothing(const tn_dfa *dfa)
{
    return dfa->states == 1 && !dfa->accept[0];
}

/* *more: a relation has empty stretches that were not known of. */
static tn_status circle_empties(tn_lowering *lowering, tn_circle *circle, bool *more, tn_error *error)
{
    tn_status status = TN_OK;
    *more = false;
    for (uint32_t i = 0; status == TN_OK && i < circle->count; i++) {
        tn_dfa *empty = NULL, **known = &circle->empties[i];
        if (!circle->sides[i].rest)
            continue;
        status = tn_dfa_product(circle->sides[i].rest, lowering->marked.empty, TN_DFA_AND, "rule", &lowering->bounds,
                                &empty, error);
        bool news = status == TN_OK && (*known ? !tn_dfa_equal(*known, empty) : !is_nothing(empty));
        *more |= news;
        if (news)
            replace(TN_OK, known, empty);
        else
            tn_dfa_free(empty);
    }
    return status;
}

static tn_lowered *circle_lowered(const tn_lowering *lowering, const tn_circle *circle, uint32_t i)
{
    return &lowering->lowered[circle->members[i] * FORM_COUNT + circle->form];
}

/* By elimination, where every unknown stands at the same end of what it stands in. */
static tn_status circle_solve(tn_lowering *lowering, tn_circle *circle, tn_error *error)
{
    bool more = true;
    tn_status status = TN_OK;
    while (status == TN_OK && circle->linear && more) {
        status = circle_sides(lowering, circle, error);
        if (status == TN_OK && circle->linear)
            status = circle_empties(lowering, circle, &more, error);
    }
    if (status != TN_OK || !circle->linear)
        return status;
    tn_dfa **found = calloc(circle->count, sizeof(tn_dfa *));
    if (!found)
        return tn_fail_memory(error);
    status = tn_linear_solve(&lowering->marked, circle->sides, circle->count, circle->left, found, error);
    for (uint32_t i = 0; i < circle->count; i++) {
        tn_linear all = {.rest = found[i]};
        if (status == TN_OK && circle->empties[i])
            status = join_rest(lowering, &all, circle->empties[i], TN_DFA_OR, error);
        if (status == TN_OK)
            circle_lowered(lowering, circle, i)->dfa = all.rest;
        else
            tn_dfa_free(all.rest);
    }
    free(found);
    return status;
}

/* Stretches of at most so many trays. */
static tn_status lower_short(tn_lowering *lowering, uint32_t longest, tn_dfa **out, tn_error *error)
{
    uint8_t *holds = malloc((size_t)longest + 2);
    if (!holds)
        return tn_fail_memory(error);
    memset(holds, 1, (size_t)longest + 1);
    holds[longest + 1] = 0;
    tn_periodic_set set = {.threshold = longest + UINT64_C(1), .period = 1, .holds = holds};
    tn_status status =
        tn_marked_count(&lowering->marked, lowering->marked.single, TN_TALLY_SINGLES, &set, NULL, out, error);
    free(holds);
    return status;
}

/* Each function once, by what the others are so far. */
static tn_status circle_round(tn_lowering *lowering, tn_circle *circle, const tn_dfa *within, bool *changed,
                              tn_error *error)
{
    tn_status status = TN_OK;
    *changed = false;
    for (uint32_t i = 0; status == TN_OK && i < circle->count; i++) {
        tn_dfa *all = NULL, *made = NULL, **known = &circle_lowered(lowering, circle, i)->dfa;
        status = lower_term(lowering, &circle->terms[i], circle->form, &all, error);
        if (status == TN_OK)
            status = tn_dfa_product(all, within, TN_DFA_AND, "rule", &lowering->bounds, &made, error);
        tn_dfa_free(all);
        *changed |= status == TN_OK && !tn_dfa_equal(*known, made);
        status = replace(status, known, made);
    }
    return status;
}

/* Round by round, for stretches as long as the plans that are asked about: in round n all of up to n trays are right.
 */
static tn_status circle_unroll(tn_lowering *lowering, tn_circle *circle, tn_error *error)
{
    if (lowering->max_trays == 0) {
        tn_fail(error, TN_LIMIT, E_TOO_MANY_STATES,
                "a rule that uses itself in the middle has no automaton for plans of every length");
        tn_error_help(error, "it is interpreted, or made for the lengths of a library that uses it");
        if (error)
            error->code_offset = lowering->module->FUNCTION_records[circle->members[0]].code_begin;
        return TN_LIMIT;
    }
    tn_dfa *within = NULL;
    tn_status status = lower_short(lowering, lowering->max_trays, &within, error);
    for (uint32_t i = 0; status == TN_OK && i < circle->count; i++)
        status = tn_dfa_constant(lowering->marked.letters, false, &circle_lowered(lowering, circle, i)->dfa, error);
    bool changed = true;
    while (status == TN_OK && changed)
        status = circle_round(lowering, circle, within, &changed, error);
    tn_dfa_free(within);
    return status;
}

static tn_status keep_failure(tn_lowered *lowered, const tn_error *error);

/* Lowers a circle whose callees outside of it are lowered; a failure is kept for all of its functions. */
static tn_status lower_circle(tn_lowering *lowering, tn_circle *circle, tn_error *error)
{
    tn_status status = circle_solve(lowering, circle, error);
    if (status == TN_OK && !circle->linear)
        status = circle_unroll(lowering, circle, error);
    for (uint32_t i = 0; status != TN_OK && i < circle->count; i++) {
        tn_lowered *lowered = circle_lowered(lowering, circle, i);
        tn_dfa_free(lowered->dfa);
        lowered->dfa = NULL;
        if (i > 0)
            keep_failure(lowered, error);
    }
    return status;
}

/* ---- functions: callees first, on a stack of our own */

static tn_status push_callee(const tn_lowering *lowering, uint32_t wanted, tn_key *pending, tn_error *error)
{
    const tn_lowered *callee = &lowering->lowered[wanted];
    if (callee->error) {
        if (error)
            *error = *callee->error;
        return callee->error->status;
    }
    return callee->dfa || tn_key_push(pending, wanted) ? TN_OK : tn_fail_memory(error);
}

static tn_status push_parts(const tn_lowering *lowering, const tn_node *node, uint32_t form, tn_key *pending,
                            tn_error *error)
{
    const tn_sum_record *sum = &lowering->module->SUM_records[node->code.first];
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < sum->term_count; i++) {
        const tn_term_record *term = &lowering->module->TERM_records[sum->term_first + i];
        if (needs_part(lowering, term))
            status = push_callee(lowering, part_wanted(term, form), pending, error);
    }
    return status;
}

/* Pushes the callees that are not lowered yet. A callee that failed is reported. */
static tn_status push_callees(tn_lowering *lowering, const tn_term *term, uint32_t form, tn_key *pending,
                              tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < term->count; i++) {
        const tn_node *node = &term->nodes[i];
        uint32_t wanted;
        if (tn_code_compares(node->code.opcode)) {
            status = push_parts(lowering, node, form, pending, error);
        } else if (node->code.opcode == TN_OP_CALL || node->code.opcode == TN_OP_MIRROR) {
            called(lowering, node, form, &wanted);
            status = push_callee(lowering, wanted, pending, error);
        }
    }
    return status;
}

/* Keeps a failure for the other callers, since it would only be found again. */
static tn_status keep_failure(tn_lowered *lowered, const tn_error *error)
{
    lowered->error = malloc(sizeof *lowered->error);
    if (lowered->error)
        *lowered->error = *error;
    return error->status;
}

/* A function that calls lower ones only, or pushes those that are not lowered yet. */
static tn_status lower_function(tn_lowering *lowering, uint32_t wanted, tn_key *pending, tn_error *error)
{
    uint32_t form = wanted % FORM_COUNT;
    size_t before = pending->size;
    tn_term term;
    tn_status status = term_read(lowering->module, wanted / FORM_COUNT, form & FORM_PLAIN, &term, error);
    if (status != TN_OK)
        return status;
    status = push_callees(lowering, &term, form, pending, error);
    if (status == TN_OK && pending->size == before)
        status = lower_term(lowering, &term, form, &lowering->lowered[wanted].dfa, error);
    term_clear(&term);
    return status;
}

/* All functions of a circle, or pushes what they call outside of it. Of the plan as a whole: what its relation says. */
static tn_status lower_in_circle(tn_lowering *lowering, uint32_t wanted, tn_key *pending, tn_error *error)
{
    uint32_t form = wanted % FORM_COUNT, relation = wanted & ~(uint32_t)FORM_PLAIN;
    size_t before = pending->size;
    tn_circle circle;
    if (form & FORM_PLAIN) {
        tn_status status = push_callee(lowering, relation, pending, error);
        return status != TN_OK || pending->size > before
                   ? status
                   : tn_marked_whole(&lowering->marked, lowering->lowered[relation].dfa, &lowering->lowered[wanted].dfa,
                                     error);
    }
    tn_status status = circle_read(lowering, wanted / FORM_COUNT, form, &circle, error);
    for (uint32_t i = 0; status == TN_OK && i < circle.count; i++)
        status = push_callees(lowering, &circle.terms[i], form, pending, error);
    if (status == TN_OK && pending->size == before)
        status = lower_circle(lowering, &circle, error);
    circle_clear(&circle);
    return status;
}

/* Lowers the last pending function, or pushes what it needs first. */
static tn_status lower_pending(tn_lowering *lowering, tn_key *pending, tn_error *error)
{
    uint32_t wanted = pending->data[pending->size - 1];
    tn_lowered *lowered = &lowering->lowered[wanted];
    bool circle = lowering->module->FUNCTION_records[wanted / FORM_COUNT].kind == TN_FUNCTION_CIRCLE;
    tn_error failure = {0};
    tn_status status = TN_OK;
    if (!lowered->dfa)
        status = (circle ? lower_in_circle : lower_function)(lowering, wanted, pending, &failure);
    if (lowered->dfa)
        pending->size--;
    if (status == TN_OK)
        return TN_OK;
    if (error)
        *error = failure;
    return keep_failure(lowered, &failure);
}

static tn_status too_much_work(const tn_lowering *lowering, uint32_t function, tn_error *error)
{
    tn_fail(error, TN_LIMIT, E_TOO_MANY_STATES,
            "the automata of these rules take more than %llu steps to build together",
            (unsigned long long)lowering->bounds.max_work * RULES_WORK);
    tn_error_help(error, "split the rules over several files");
    if (error)
        error->code_offset = lowering->module->FUNCTION_records[function].code_begin;
    return TN_LIMIT;
}

/* Counts the work that was done before; each question has its own. */
static tn_status begin_work(tn_lowering *lowering, uint32_t function, tn_error *error)
{
    lowering->spent += lowering->bounds.work;
    lowering->bounds.work = 0;
    return lowering->spent > lowering->bounds.max_work * RULES_WORK ? too_much_work(lowering, function, error) : TN_OK;
}

static tn_status lower_form(tn_lowering *lowering, uint32_t function, uint32_t form, tn_dfa **out, tn_error *error)
{
    uint32_t wanted = function * FORM_COUNT + form;
    tn_lowered *lowered = &lowering->lowered[wanted];
    if (lowered->error) {
        if (error)
            *error = *lowered->error;
        return lowered->error->status;
    }
    tn_key pending = {0};
    tn_status status = begin_work(lowering, function, error);
    if (status == TN_OK && !tn_key_push(&pending, wanted))
        status = tn_fail_memory(error);
    while (status == TN_OK && pending.size > 0)
        status = lower_pending(lowering, &pending, error);
    free(pending.data);
    if (status != TN_OK)
        return status;
    *out = tn_dfa_share(lowered->dfa);
    return TN_OK;
}

tn_status tn_lower(tn_lowering *lowering, uint32_t function, tn_dfa **out, tn_error *error)
{
    return lower_form(lowering, function, FORM_PLAIN, out, error);
}

tn_status tn_lower_marked(tn_lowering *lowering, uint32_t function, tn_dfa **out, tn_error *error)
{
    return lower_form(lowering, function, 0, out, error);
}

tn_status tn_lower_reversed(tn_lowering *lowering, uint32_t function, tn_dfa **out, tn_error *error)
{
    return lower_form(lowering, function, FORM_PLAIN | FORM_REVERSED, out, error);
}

/* Lowers the nodes before the one at `offset`, and hands out what that one would take. */
static tn_status lower_until(tn_lowering *lowering, tn_term *term, uint32_t form, uint32_t offset, tn_dfa **parts,
                             size_t *count, tn_error *error)
{
    size_t at = 0;
    while (at < term->count && term->nodes[at].offset != offset)
        at++;
    if (at == term->count || (at > 0 && term->nodes[at - 1].plain)) /* at the plan's level operands are no relations */
        return tn_fail(error, TN_INTERNAL, TN_CODE_NONE, "an instruction that makes no relation");
    uint8_t pops = tn_code_effect((uint8_t)term->nodes[at].code.opcode).pops;
    term->count = at;
    tn_dfa *last = NULL;
    tn_status status = at > 0 ? lower_term(lowering, term, form, &last, error) : TN_OK;
    if (status != TN_OK)
        return status;
    for (size_t i = pops; i-- > 0; last = NULL)
        parts[i] = last ? last : term->stack[--term->depth];
    tn_dfa_free(last);
    *count = pops;
    return TN_OK;
}

tn_status tn_lower_operands(tn_lowering *lowering, uint32_t function, uint32_t offset, tn_dfa **parts, size_t *count,
                            tn_error *error)
{
    /* Where the whole function has been lowered, all that its instructions call has been too. */
    tn_function_kind kind = (tn_function_kind)lowering->module->FUNCTION_records[function].kind;
    uint32_t form = kind == TN_FUNCTION_HOLDS ? FORM_PLAIN : 0;
    tn_dfa *whole = NULL;
    *count = 0;
    tn_status status = lower_form(lowering, function, form, &whole, error);
    tn_dfa_free(whole);
    if (status != TN_OK)
        return status;
    tn_term term;
    status = term_read(lowering->module, function, form, &term, error);
    if (status != TN_OK)
        return status;
    status = lower_until(lowering, &term, form, offset, parts, count, error);
    term_clear(&term);
    return status;
}

tn_status tn_lower_term(tn_lowering *lowering, uint32_t function, uint32_t code_begin, uint32_t code_end, bool reversed,
                        tn_dfa **out, tn_error *error)
{
    uint32_t form = reversed ? FORM_REVERSED : 0;
    tn_key pending = {0};
    tn_term term = {0};
    tn_status status = begin_work(lowering, function, error);
    if (status == TN_OK)
        status = term_read_code(lowering->module, code_begin, code_end,
                                lowering->module->FUNCTION_records[function].stack_max, false, &term, error);
    if (status == TN_OK)
        status = push_callees(lowering, &term, form, &pending, error);
    while (status == TN_OK && pending.size > 0)
        status = lower_pending(lowering, &pending, error);
    if (status == TN_OK)
        status = lower_term(lowering, &term, form, out, error);
    term_clear(&term);
    free(pending.data);
    return status;
}

const tn_marked *tn_lowering_marked(const tn_lowering *lowering)
{
    return &lowering->marked;
}

const tn_classes *tn_lowering_classes(const tn_lowering *lowering)
{
    return lowering->classes;
}
