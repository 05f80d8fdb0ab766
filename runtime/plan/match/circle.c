/* Reads circles of functions, and solves their equations. */
#include "runtime/plan/match/circle.h"

#include <stdlib.h>
#include <string.h>

static uint32_t circle_number(const tn_circle *circle, uint32_t function)
{
    uint32_t i = 0;
    while (i < circle->count && circle->members[i] != function)
        i++;
    return i;
}

void tn_circle_clear(tn_circle *circle)
{
    for (uint32_t i = 0; i < circle->count; i++) {
        if (circle->codes)
            tn_postfix_clear(&circle->codes[i]);
        if (circle->sides)
            tn_linear_clear(&circle->sides[i]);
        if (circle->empties)
            tn_dfa_free(circle->empties[i]);
    }
    while (circle->depth > 0)
        tn_linear_clear(&circle->stack[--circle->depth]);
    free(circle->members);
    free(circle->codes);
    free(circle->sides);
    free(circle->empties);
    free(circle->stack);
    *circle = (tn_circle){0};
}

tn_status tn_circle_read(const tn_module *module, uint32_t function, tn_circle *circle, tn_error *error)
{
    size_t functions = module->FUNCTION_count;
    *circle = (tn_circle){.linear = true};
    circle->members = calloc(functions + 1, sizeof *circle->members);
    circle->codes = calloc(functions + 1, sizeof *circle->codes);
    if (!circle->members || !circle->codes)
        return tn_fail_memory(error);
    circle->members[circle->count++] = function;
    for (uint32_t i = 0; i < circle->count; i++) {
        tn_postfix *code = &circle->codes[i];
        tn_status status = tn_postfix_read(module, circle->members[i], false, code, error);
        if (status != TN_OK)
            return status;
        for (size_t n = 0; n < code->count; n++) {
            uint32_t callee = (uint32_t)code->nodes[n].code.first;
            if (code->nodes[n].code.opcode == TN_OP_AGAIN && circle_number(circle, callee) == circle->count)
                circle->members[circle->count++] = callee;
        }
        circle->room = code->count > circle->room ? code->count : circle->room;
    }
    circle->sides = calloc(circle->count, sizeof *circle->sides);
    circle->empties = calloc(circle->count, sizeof *circle->empties);
    circle->stack = calloc(circle->room + 1, sizeof *circle->stack);
    return circle->sides && circle->empties && circle->stack ? TN_OK : tn_fail_memory(error);
}

/* ---- linear equations */

static tn_status replace(tn_status status, tn_dfa **place, tn_dfa *made)
{
    if (status == TN_OK) {
        tn_dfa_free(*place);
        *place = made;
    }
    return status;
}

static tn_status join_rest(const tn_marked *marked, tn_linear *side, tn_dfa *with, tn_dfa_operation operation,
                           tn_error *error)
{
    tn_dfa *made = NULL;
    if (!side->rest && operation == TN_DFA_OR)
        side->rest = tn_dfa_share(with);
    if (!side->rest || side->rest == with)
        return TN_OK;
    tn_status status = tn_dfa_product(side->rest, with, operation, "rule", marked->bounds, &made, error);
    return replace(status, &side->rest, made);
}

/* The lower of the two topmost becomes both in their order; of one of them all is known, or the equation is not linear.
 */
static tn_status add_chain(const tn_circle_means *means, tn_circle *circle, tn_error *error)
{
    tn_linear *lower = &circle->stack[circle->depth - 2], *upper = lower + 1;
    tn_linear *before = means->reversed ? upper : lower, *behind = means->reversed ? lower : upper;
    bool left = tn_linear_has_unknowns(before), right = tn_linear_has_unknowns(behind);
    circle->left |= left;
    circle->right |= right;
    circle->linear &= !(circle->left && circle->right);
    tn_linear *kept = left ? before : behind, *other = left ? behind : before;
    tn_status status = TN_OK;
    if (circle->linear && other->rest)
        status = tn_linear_chain(means->marked, kept, other->rest, !left, error);
    else if (circle->linear) { /* nothing is there to stand beside */
        tn_linear_clear(kept);
        status = tn_linear_make(means->marked, circle->count, TN_NO_STATE, kept, error);
    }
    tn_linear result = *kept;
    *kept = (tn_linear){0};
    tn_linear_clear(other);
    *lower = result;
    circle->depth--;
    return status;
}

/* An instruction whose operands have no unknowns. */
static tn_status add_known(const tn_circle_means *means, tn_circle *circle, const tn_postfix_node *node, uint8_t pops,
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
            status = tn_dfa_constant(means->marked->letters, false, &in[i], error);
    }
    if (status == TN_OK)
        status = means->make(means->context, node, in, &made, error);
    for (uint8_t i = 0; i < pops; i++)
        tn_dfa_free(in[i]);
    if (status != TN_OK)
        return status;
    tn_linear *result = &circle->stack[circle->depth];
    status = tn_linear_make(means->marked, circle->count, TN_NO_STATE, result, error);
    result->rest = made;
    circle->depth++;
    return status;
}

static tn_status add_node(const tn_circle_means *means, tn_circle *circle, const tn_postfix_node *node, tn_error *error)
{
    uint8_t pops = tn_code_effect((uint8_t)node->code.opcode).pops;
    tn_linear *top = &circle->stack[circle->depth];
    bool unknown = false;
    for (uint8_t i = 1; i <= pops; i++)
        unknown |= tn_linear_has_unknowns(top - i);
    if (node->code.opcode == TN_OP_AGAIN && !means->left_out(means->context, node->offset)) {
        uint32_t number = circle_number(circle, (uint32_t)node->code.first);
        circle->depth++;
        tn_status status = tn_linear_make(means->marked, circle->count, number, top, error);
        if (status == TN_OK && circle->empties[number])
            top->rest = tn_dfa_share(circle->empties[number]);
        return status;
    }
    if (!unknown)
        return add_known(means, circle, node, pops, error);
    tn_status status = TN_OK;
    switch (means->left_out(means->context, node->offset) ? TN_OP_RETURN : node->code.opcode) {
    case TN_OP_OR:
        status = tn_linear_or(means->marked, top - 2, top - 1, error);
        tn_linear_clear(top - 1);
        circle->depth--;
        return status;
    case TN_OP_CHAIN:
        return add_chain(means, circle, error);
    case TN_OP_NONEMPTY: /* the unknowns are without empty stretches */
        return join_rest(means->marked, top - 1, means->marked->nonempty, TN_DFA_AND, error);
    case TN_OP_OPTIONAL:
        return join_rest(means->marked, top - 1, means->marked->empty, TN_DFA_OR, error);
    default:
        circle->linear = false;
        return TN_OK;
    }
}

/* The right-hand side of each equation; stops where one is not linear. */
static tn_status find_sides(const tn_circle_means *means, tn_circle *circle, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && circle->linear && i < circle->count; i++) {
        const tn_postfix *code = &circle->codes[i];
        for (size_t n = 0; status == TN_OK && circle->linear && n < code->count; n++) {
            status = add_node(means, circle, &code->nodes[n], error);
            if (status != TN_OK && error)
                error->code_offset = code->nodes[n].offset;
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
static tn_status find_empties(const tn_circle_means *means, tn_circle *circle, bool *more, tn_error *error)
{
    tn_status status = TN_OK;
    *more = false;
    for (uint32_t i = 0; status == TN_OK && i < circle->count; i++) {
        tn_dfa *empty = NULL, **known = &circle->empties[i];
        if (!circle->sides[i].rest)
            continue;
        status = tn_dfa_product(circle->sides[i].rest, means->marked->empty, TN_DFA_AND, "rule", means->marked->bounds,
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

/* By elimination, if every unknown stands at the same end of what it stands in. */
static tn_status solve(const tn_circle_means *means, tn_circle *circle, tn_dfa **out, tn_error *error)
{
    bool more = true;
    tn_status status = TN_OK;
    while (status == TN_OK && circle->linear && more) {
        status = find_sides(means, circle, error);
        if (status == TN_OK && circle->linear)
            status = find_empties(means, circle, &more, error);
    }
    if (status != TN_OK || !circle->linear)
        return status;
    status = tn_linear_solve(means->marked, circle->sides, circle->count, circle->left, out, error);
    for (uint32_t i = 0; status == TN_OK && i < circle->count; i++) {
        tn_linear all = {.rest = out[i]};
        if (circle->empties[i])
            status = join_rest(means->marked, &all, circle->empties[i], TN_DFA_OR, error);
        out[i] = all.rest;
    }
    return status;
}

/* ---- round by round */

/* Stretches of at most so many trays. */
static tn_status short_stretches(const tn_marked *marked, uint32_t longest, tn_dfa **out, tn_error *error)
{
    uint8_t *holds = malloc((size_t)longest + 2);
    if (!holds)
        return tn_fail_memory(error);
    memset(holds, 1, (size_t)longest + 1);
    holds[longest + 1] = 0;
    tn_periodic_set set = {.threshold = longest + UINT64_C(1), .period = 1, .holds = holds};
    tn_status status = tn_marked_count(marked, marked->single, TN_TALLY_SINGLES, &set, NULL, out, error);
    free(holds);
    return status;
}

/* The relations so far. */
typedef struct tn_circle_round {
    const tn_circle_means *means;
    const tn_circle *circle;
    tn_dfa **known;
} tn_circle_round;

static tn_status make_by_known(void *context, const tn_postfix_node *node, tn_dfa *const *in, tn_dfa **out,
                               tn_error *error)
{
    const tn_circle_round *round = context;
    const tn_circle_means *means = round->means;
    if (node->code.opcode != TN_OP_AGAIN || means->left_out(means->context, node->offset))
        return means->make(means->context, node, in, out, error);
    *out = tn_dfa_share(round->known[circle_number(round->circle, (uint32_t)node->code.first)]);
    return TN_OK;
}

/* Each function once, by what the others are so far. */
static tn_status go_round(tn_circle_round *round, const tn_dfa *within, bool *changed, tn_error *error)
{
    tn_status status = TN_OK;
    *changed = false;
    for (uint32_t i = 0; status == TN_OK && i < round->circle->count; i++) {
        tn_dfa *all = NULL, *made = NULL, **known = &round->known[i];
        status = tn_postfix_fold(&round->circle->codes[i], make_by_known, round, &all, error);
        if (status == TN_OK)
            status = tn_dfa_product(all, within, TN_DFA_AND, "rule", round->means->marked->bounds, &made, error);
        tn_dfa_free(all);
        *changed |= status == TN_OK && !tn_dfa_equal(*known, made);
        status = replace(status, known, made);
    }
    return status;
}

static tn_status unroll(const tn_circle_means *means, tn_circle *circle, tn_dfa **out, tn_error *error)
{
    if (means->max_trays == 0) {
        tn_fail(error, TN_LIMIT, E_TOO_MANY_STATES,
                "a rule that uses itself in the middle has no automaton for plans of every length");
        tn_error_help(error, "it is interpreted, or made for the lengths of a library that uses it");
        if (error)
            error->code_offset = means->module->FUNCTION_records[circle->members[0]].code_begin;
        return TN_LIMIT;
    }
    tn_dfa *within = NULL;
    tn_circle_round round = {means, circle, out};
    tn_status status = short_stretches(means->marked, means->max_trays, &within, error);
    for (uint32_t i = 0; status == TN_OK && i < circle->count; i++)
        status = tn_dfa_constant(means->marked->letters, false, &out[i], error);
    /* A tray more at the latest once each function has had its turn. Automata that may be wrong of longer plans need
     * not become the same again. */
    uint64_t rounds = means->marked->bounds->longest ? (means->max_trays + UINT64_C(1)) * circle->count : UINT64_MAX;
    bool changed = true;
    for (uint64_t n = 0; status == TN_OK && changed && n < rounds; n++)
        status = go_round(&round, within, &changed, error);
    tn_dfa_free(within);
    return status;
}

tn_status tn_circle_lower(tn_circle *circle, const tn_circle_means *means, tn_dfa **out, tn_error *error)
{
    for (uint32_t i = 0; i < circle->count; i++)
        out[i] = NULL;
    tn_status status = solve(means, circle, out, error);
    if (status == TN_OK && !circle->linear)
        status = unroll(means, circle, out, error);
    for (uint32_t i = 0; status != TN_OK && i < circle->count; i++) {
        tn_dfa_free(out[i]);
        out[i] = NULL;
    }
    return status;
}
