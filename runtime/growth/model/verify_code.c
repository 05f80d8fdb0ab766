/* Checks the code of a rewrite system, whose instructions and operands have been checked one by one before: what the
 * turtle says of seed and successors, the order of each guard's tests, and that rules, groups and functions fit. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "runtime/growth/model/turtle.h"
#include "runtime/growth/model/verify.h"

/* Reads a function's code. */
typedef struct cursor {
    const tn_module *module;
    tn_error *error;
    uint32_t function, offset;
    tn_instruction here; /* the instruction at the offset */
} cursor;

static cursor begin(const tn_module *module, uint32_t function, tn_error *error)
{
    uint32_t offset = module->FUNCTION_records[function].code_begin;
    return (cursor){module, error, function, offset, tn_code_read(module->code, offset)};
}

/* To the next instruction; not past the last, which LAND or PASS is. */
static void advance(cursor *at)
{
    at->offset += at->here.length;
    at->here = tn_code_read(at->module->code, at->offset);
}

__attribute__((format(printf, 2, 3))) static tn_status refuse(const cursor *at, const char *format, ...)
{
    char what[160];
    va_list args;
    va_start(args, format);
    vsnprintf(what, sizeof what, format, args);
    va_end(args);
    tn_fail(at->error, TN_INVALID, E_REFUSED_MODULE, "the module is refused: function %u, code offset %u: %s",
            at->function, at->offset, what);
    if (at->error)
        at->error->code_offset = at->offset;
    return TN_INVALID;
}

/* ---- the turtle */

static const char *fault_text(unsigned fault)
{
    return fault & TN_TURTLE_FULL        ? "the branch has drawn its edge already"
           : fault & TN_TURTLE_UNOPENED  ? "there is no branch to end"
           : fault & TN_TURTLE_EMPTY     ? "the branch draws no edge"
           : fault & TN_TURTLE_UNFLIPPED ? "no edge follows a FLIP"
           : fault & TN_TURTLE_UNCLOSED  ? "the path ends within a branch"
           : fault & TN_TURTLE_NO_PATH   ? "there is no edge outside the branches"
           : fault & TN_TURTLE_ASTRAY    ? "the turtle does not end in the direction in which it started"
           : fault & TN_TURTLE_CROWDED   ? "a successor has more edges, branches or brackets than the limit"
                                         : "this is not a move of the turtle";
}

static tn_status check_successor(const tn_module *module, uint32_t function, tn_turtle_level *levels, tn_error *error)
{
    cursor at = begin(module, function, error);
    tn_turtle turtle;
    tn_turtle_start(&turtle, levels);
    for (;; advance(&at)) {
        unsigned fault = tn_turtle_move(&turtle, &at.here);
        if (fault)
            return refuse(&at, "%s", fault_text(fault));
        if (at.here.opcode == TN_OP_LAND)
            return TN_OK;
    }
}

/* A seed is a regular polygon: edges, and which of them run the other way. */
static tn_status check_seed(const tn_module *module, uint32_t function, tn_error *error)
{
    cursor at = begin(module, function, error);
    uint32_t edges = 0;
    bool flipped = false;
    for (; at.here.opcode != TN_OP_LAND; advance(&at)) {
        if (at.here.opcode != TN_OP_DRAW && at.here.opcode != TN_OP_FLIP)
            return refuse(&at, "a seed only draws edges and flips them");
        if (at.here.opcode == TN_OP_DRAW && at.here.second != TN_AGE_ZERO)
            return refuse(&at, "an edge of a seed is new");
        flipped = at.here.opcode == TN_OP_FLIP && !flipped;
        edges += at.here.opcode == TN_OP_DRAW;
    }
    if (flipped)
        return refuse(&at, "%s", fault_text(TN_TURTLE_UNFLIPPED));
    if (edges < 3 || edges > TN_AXIOM_MAX)
        return refuse(&at, "the seed has %u edges; 3 to %u are possible", edges, TN_AXIOM_MAX);
    return TN_OK;
}

/* ---- guards */

static bool is_comparison(tn_opcode opcode)
{
    return opcode == TN_OP_YOUNGER || opcode == TN_OP_OLDER || opcode == TN_OP_AGED;
}

static double number_of(const cursor *at)
{
    return tn_double_of((uint64_t)at->here.first);
}

static tn_status check_predecessor(cursor *at)
{
    uint32_t labels = 0;
    for (; at->here.opcode == TN_OP_LABEL; advance(at))
        labels++;
    if (labels == 0 || labels > TN_CHAIN_MAX)
        return refuse(at, "a predecessor has %u edges; 1 to %u are possible", labels, TN_CHAIN_MAX);
    if (labels > 1 && (at->here.opcode == TN_OP_BEHIND || at->here.opcode == TN_OP_AHEAD))
        return refuse(at, "a chain of edges has a context");
    if (at->here.opcode == TN_OP_BEHIND)
        advance(at);
    if (at->here.opcode == TN_OP_AHEAD)
        advance(at);
    return TN_OK;
}

/* A test, and the successor where it holds. */
static tn_status check_choice(cursor *at)
{
    if (!(fabs(number_of(at)) <= TN_COORDINATE_MAX) || (at->here.opcode == TN_OP_WEIGHT && number_of(at) < 0))
        return refuse(at, "an age or a weight is out of range");
    advance(at);
    if (at->here.opcode != TN_OP_REPLACE)
        return refuse(at, "no successor follows the test of an age or a weight");
    advance(at);
    return TN_OK;
}

static tn_status check_choices(cursor *at)
{
    bool by_chance = at->here.opcode == TN_OP_CHANCE;
    uint32_t choices = 0;
    if (by_chance) {
        if (!(number_of(at) >= 0))
            return refuse(at, "the total of the weights is below 0");
        advance(at);
    }
    for (; by_chance ? at->here.opcode == TN_OP_WEIGHT : is_comparison(at->here.opcode); choices++) {
        tn_status status = check_choice(at);
        if (status != TN_OK)
            return status;
    }
    bool has_last = at->here.opcode == TN_OP_REPLACE;
    if (has_last)
        advance(at);
    if (by_chance ? !has_last || choices == 0 : choices + has_last == 0)
        return refuse(at, "the guard has too few successors");
    return at->here.opcode == TN_OP_PASS ? TN_OK : refuse(at, "this does not stand here in a guard");
}

static tn_status check_guard(const tn_module *module, uint32_t function, tn_error *error)
{
    cursor at = begin(module, function, error);
    tn_status status = check_predecessor(&at);
    return status == TN_OK ? check_choices(&at) : status;
}

/* Do two guards start with the same labels? */
static bool same_predecessor(const tn_module *module, uint32_t one, uint32_t other)
{
    cursor a = begin(module, one, NULL), b = begin(module, other, NULL);
    for (; a.here.opcode == TN_OP_LABEL && b.here.opcode == TN_OP_LABEL; advance(&a), advance(&b))
        if (a.here.first != b.here.first)
            return false;
    return a.here.opcode != TN_OP_LABEL && b.here.opcode != TN_OP_LABEL;
}

/* Each label is rewritten by one group: there is no second predecessor of that label alone. */
static tn_status check_groups(const tn_module *module, tn_error *error)
{
    tn_status status = TN_OK;
    uint8_t *seen = calloc(module->EDGE_LABEL_count, 1);
    if (!seen)
        return tn_fail_memory(error);
    for (size_t g = 0; g < module->REWRITE_GROUP_count && status == TN_OK; g++) {
        const tn_rewrite_group_record *group = &module->REWRITE_GROUP_records[g];
        cursor at = begin(module, module->REWRITE_RULE_records[group->rule_first].guard, error);
        uint32_t label = (uint32_t)at.here.first;
        advance(&at);
        if (at.here.opcode == TN_OP_LABEL)
            continue;
        if (seen[label])
            status = refuse(&at, "two groups rewrite label %u", label);
        seen[label] = 1;
    }
    free(seen);
    return status;
}

/* ---- all of it */

static bool is_function(const tn_module *module, uint32_t function, tn_function_kind kind)
{
    return function < module->FUNCTION_count && module->FUNCTION_records[function].kind == kind;
}

static tn_status check_references(const tn_module *module, tn_error *error)
{
    if (!is_function(module, module->GROWTH_records[0].seed, TN_FUNCTION_SEED))
        return tn_fail(error, TN_INVALID, E_REFUSED_MODULE, "the module is refused: its rewrite system has no seed");
    for (size_t i = 0; i < module->REWRITE_RULE_count; i++) {
        const tn_rewrite_rule_record *rule = &module->REWRITE_RULE_records[i];
        if (!is_function(module, rule->guard, TN_FUNCTION_GUARD) || (i > 0 && rule->guard <= rule[-1].guard))
            return tn_fail(error, TN_INVALID, E_REFUSED_MODULE,
                           "the module is refused: rewrite rule %zu has no guard behind that of the rule before", i);
    }
    for (size_t g = 0; g < module->REWRITE_GROUP_count; g++) {
        const tn_rewrite_group_record *group = &module->REWRITE_GROUP_records[g];
        const tn_rewrite_rule_record *rules = &module->REWRITE_RULE_records[group->rule_first];
        for (uint32_t r = 1; r < group->rule_count; r++)
            if (!same_predecessor(module, rules[0].guard, rules[r].guard))
                return tn_fail(error, TN_INVALID, E_REFUSED_MODULE,
                               "the module is refused: the rules of group %zu have different predecessors", g);
    }
    return TN_OK;
}

static tn_status check_functions(const tn_module *module, tn_turtle_level *levels, tn_error *error)
{
    tn_status status = TN_OK;
    size_t seeds = 0, successors = 0;
    for (uint32_t f = 0; f < module->FUNCTION_count && status == TN_OK; f++) {
        uint32_t kind = module->FUNCTION_records[f].kind;
        seeds += kind == TN_FUNCTION_SEED;
        successors += kind == TN_FUNCTION_SUCCESSOR;
        if (kind == TN_FUNCTION_SEED)
            status = check_seed(module, f, error);
        else if (kind == TN_FUNCTION_SUCCESSOR)
            status = check_successor(module, f, levels, error);
        else if (kind == TN_FUNCTION_GUARD)
            status = check_guard(module, f, error);
    }
    if (status == TN_OK && (seeds != 1 || successors > TN_TEMPLATES_MAX))
        return tn_fail(error, TN_INVALID, E_REFUSED_MODULE,
                       "the module is refused: it has %zu seeds and %zu successors; 1 seed and up to %u are possible",
                       seeds, successors, TN_TEMPLATES_MAX);
    return status;
}

tn_status tn_growth_verify_whole(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    tn_error *error = checker->error;
    size_t parts = 0, most = 0;
    for (size_t f = 0; f < module->FUNCTION_count; f++) {
        const tn_function_record *function = &module->FUNCTION_records[f];
        parts += function->kind == TN_FUNCTION_SEED || function->kind == TN_FUNCTION_SUCCESSOR ||
                 function->kind == TN_FUNCTION_GUARD;
        if (function->kind == TN_FUNCTION_SUCCESSOR && function->stack_max > most)
            most = function->stack_max;
    }
    if (module->GROWTH_count == 0)
        return parts == 0 ? TN_OK
                          : tn_fail(error, TN_INVALID, E_REFUSED_MODULE,
                                    "the module is refused: it has code of a rewrite system that it does not have");
    tn_turtle_level *levels = malloc((most + 1) * sizeof *levels);
    if (!levels)
        return tn_fail_memory(error);
    tn_status status = check_functions(module, levels, error);
    free(levels);
    if (status == TN_OK)
        status = check_references(module, error);
    return status == TN_OK ? check_groups(module, error) : status;
}
