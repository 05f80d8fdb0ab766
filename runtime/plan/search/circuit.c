/* Gates, each once, and their clauses. */
#include "runtime/plan/search/circuit.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/automata/numbering.h"
#include "runtime/base/array.h"

/* The first word of a node's key; its operands follow. */
enum { NODE_CONSTANT, NODE_INPUT, NODE_ALL, NODE_CHOICE };

struct tn_circuit {
    const tn_solver_calls *calls;
    tn_solver *solver;
    tn_interner nodes;
    uint32_t inputs;
    uint32_t max_nodes, most; /* so many more at a time, so many now */
    uint8_t *told;            /* [told_capacity]: has the solver the clauses of the node? */
    size_t told_capacity;
    tn_key key, pending; /* of a node to be made; nodes whose clauses are to be told */
    int *clause;
    size_t clause_capacity;
    tn_status status;
    tn_error error;
};

tn_status tn_circuit_new(uint32_t max_nodes, tn_circuit **out, tn_error *error)
{
    tn_circuit *circuit = calloc(1, sizeof *circuit);
    if (!circuit)
        return tn_fail_memory(error);
    circuit->max_nodes = circuit->most = max_nodes < INT_MAX / 2 ? max_nodes : INT_MAX / 2;
    circuit->calls = tn_solver_cadical(error);
    tn_status status = circuit->calls ? circuit->calls->make(&circuit->solver, error) : TN_INVALID;
    if (status == TN_OK && tn_intern(&circuit->nodes, &(uint32_t){NODE_CONSTANT}, 1) != 0)
        status = tn_fail_memory(error);
    if (status != TN_OK) {
        tn_circuit_free(circuit);
        return status;
    }
    *out = circuit;
    return TN_OK;
}

void tn_circuit_free(tn_circuit *circuit)
{
    if (!circuit)
        return;
    if (circuit->solver)
        circuit->calls->free(circuit->solver);
    tn_interner_clear(&circuit->nodes);
    free(circuit->told);
    free(circuit->key.data);
    free(circuit->pending.data);
    free(circuit->clause);
    free(circuit);
}

tn_status tn_circuit_status(const tn_circuit *circuit, tn_error *error)
{
    if (circuit->status != TN_OK && error)
        *error = circuit->error;
    return circuit->status;
}

void tn_circuit_go_on(tn_circuit *circuit)
{
    if (circuit->status != TN_LIMIT)
        return;
    circuit->status = TN_OK;
    circuit->most = circuit->nodes.count < INT_MAX / 2 - circuit->max_nodes ? circuit->nodes.count + circuit->max_nodes
                                                                            : INT_MAX / 2;
}

static void fail_memory(tn_circuit *circuit)
{
    if (circuit->status == TN_OK)
        circuit->status = tn_fail_memory(&circuit->error);
}

/* ---- making gates */

/* The node of the circuit's key. */
static tn_signal make_node(tn_circuit *circuit)
{
    if (circuit->status != TN_OK)
        return TN_SIGNAL_FALSE;
    uint32_t node = tn_intern(&circuit->nodes, circuit->key.data, circuit->key.size);
    if (node == UINT32_MAX) {
        fail_memory(circuit);
        return TN_SIGNAL_FALSE;
    }
    if (node < circuit->most)
        return 2 * node;
    circuit->status = tn_fail(&circuit->error, TN_LIMIT, E_SEARCH_TOO_LARGE,
                              "what is searched passes the limit of %u gates for a rule", circuit->max_nodes);
    tn_error_help(&circuit->error, "give fewer trays with --trays, or raise the limit with --max-gates");
    return TN_SIGNAL_FALSE;
}

static void begin_key(tn_circuit *circuit, uint32_t kind)
{
    circuit->key.size = 0;
    if (!tn_key_push(&circuit->key, kind))
        fail_memory(circuit);
}

static void push_key(tn_circuit *circuit, uint32_t word)
{
    if (!tn_key_push(&circuit->key, word))
        fail_memory(circuit);
}

tn_signal tn_circuit_input(tn_circuit *circuit)
{
    begin_key(circuit, NODE_INPUT);
    push_key(circuit, circuit->inputs++);
    return make_node(circuit);
}

tn_signal tn_circuit_all(tn_circuit *circuit, tn_signal *gates, size_t count)
{
    if (count > 1)
        qsort(gates, count, sizeof *gates, tn_words_compare);
    begin_key(circuit, NODE_ALL);
    tn_signal last = TN_SIGNAL_TRUE;
    for (size_t i = 0; i < count; i++) {
        if (gates[i] == TN_SIGNAL_FALSE || (i > 0 && gates[i] == (gates[i - 1] | 1) && gates[i] != gates[i - 1]))
            return TN_SIGNAL_FALSE;
        if (gates[i] == TN_SIGNAL_TRUE || gates[i] == last)
            continue;
        last = gates[i];
        push_key(circuit, last);
    }
    return circuit->key.size > 2 ? make_node(circuit) : last;
}

tn_signal tn_circuit_any(tn_circuit *circuit, tn_signal *gates, size_t count)
{
    for (size_t i = 0; i < count; i++)
        gates[i] = tn_signal_not(gates[i]);
    return tn_signal_not(tn_circuit_all(circuit, gates, count));
}

tn_signal tn_circuit_and(tn_circuit *circuit, tn_signal a, tn_signal b)
{
    return tn_circuit_all(circuit, (tn_signal[]){a, b}, 2);
}

tn_signal tn_circuit_or(tn_circuit *circuit, tn_signal a, tn_signal b)
{
    return tn_circuit_any(circuit, (tn_signal[]){a, b}, 2);
}

tn_signal tn_circuit_choose(tn_circuit *circuit, tn_signal condition, tn_signal a, tn_signal b)
{
    if (condition & 1) {
        tn_signal other = a;
        condition = tn_signal_not(condition);
        a = b;
        b = other;
    }
    if (a == b || condition == TN_SIGNAL_FALSE)
        return b;
    if (a == TN_SIGNAL_FALSE || a == condition + 1)
        return tn_circuit_and(circuit, tn_signal_not(condition), b);
    if (a == TN_SIGNAL_TRUE || a == condition)
        return tn_circuit_or(circuit, condition, b);
    if (b == TN_SIGNAL_FALSE || b == condition)
        return tn_circuit_and(circuit, condition, a);
    if (b == TN_SIGNAL_TRUE || b == condition + 1)
        return tn_circuit_or(circuit, tn_signal_not(condition), a);
    begin_key(circuit, NODE_CHOICE);
    push_key(circuit, condition);
    push_key(circuit, a);
    push_key(circuit, b);
    return make_node(circuit);
}

/* ---- telling the solver */

/* Variable 1 is the constant: node n is variable n + 1. */
static int literal(tn_signal gate)
{
    int variable = (int)(gate / 2) + 1;
    return gate & 1 ? -variable : variable;
}

static void tell(tn_circuit *circuit, const int *literals, size_t count)
{
    if (circuit->status == TN_OK)
        circuit->status = circuit->calls->clause(circuit->solver, literals, count, &circuit->error);
}

static int *clause_room(tn_circuit *circuit, size_t count)
{
    if (!tn_array_reserve(&circuit->clause, &circuit->clause_capacity, 0, count, sizeof *circuit->clause)) {
        fail_memory(circuit);
        return NULL;
    }
    return circuit->clause;
}

/* `self` is true if all operands are, and else false. */
static void tell_all(tn_circuit *circuit, int self, const uint32_t *operands, size_t count)
{
    int *clause = clause_room(circuit, count + 1);
    if (!clause)
        return;
    for (size_t i = 0; i < count; i++) {
        tell(circuit, (int[]){-self, literal(operands[i])}, 2);
        clause[i] = -literal(operands[i]);
    }
    clause[count] = self;
    tell(circuit, clause, count + 1);
}

/* The last two follow from the others, and are told because they decide at once. */
static void tell_choice(tn_circuit *circuit, int self, int condition, int a, int b)
{
    tell(circuit, (int[]){-condition, -a, self}, 3);
    tell(circuit, (int[]){-condition, a, -self}, 3);
    tell(circuit, (int[]){condition, -b, self}, 3);
    tell(circuit, (int[]){condition, b, -self}, 3);
    tell(circuit, (int[]){-a, -b, self}, 3);
    tell(circuit, (int[]){a, b, -self}, 3);
}

static void tell_node(tn_circuit *circuit, uint32_t node)
{
    size_t size;
    const uint32_t *key = tn_interned(&circuit->nodes, node, &size);
    int self = literal(2 * node);
    if (key[0] == NODE_CONSTANT)
        tell(circuit, &(int){-self}, 1);
    else if (key[0] == NODE_ALL)
        tell_all(circuit, self, key + 1, size - 1);
    else if (key[0] == NODE_CHOICE)
        tell_choice(circuit, self, literal(key[1]), literal(key[2]), literal(key[3]));
    for (size_t i = 1; key[0] >= NODE_ALL && i < size; i++)
        if (!circuit->told[key[i] / 2] && !tn_key_push(&circuit->pending, key[i] / 2))
            fail_memory(circuit);
}

/* Tells the clauses of a gate and of all that it is made of. */
static int told(tn_circuit *circuit, tn_signal gate)
{
    size_t before = circuit->told_capacity;
    if (!tn_array_reserve(&circuit->told, &circuit->told_capacity, 0, circuit->nodes.count, 1)) {
        fail_memory(circuit);
        return literal(TN_SIGNAL_FALSE);
    }
    memset(circuit->told + before, 0, circuit->told_capacity - before);
    if (!tn_key_push(&circuit->pending, gate / 2))
        fail_memory(circuit);
    while (circuit->status == TN_OK && circuit->pending.size > 0) {
        uint32_t node = circuit->pending.data[--circuit->pending.size];
        if (circuit->told[node])
            continue;
        circuit->told[node] = 1;
        tell_node(circuit, node);
    }
    return literal(gate);
}

void tn_circuit_assert_any(tn_circuit *circuit, const tn_signal *gates, size_t count)
{
    int *literals = malloc((count + 1) * sizeof *literals);
    if (!literals) {
        fail_memory(circuit);
        return;
    }
    for (size_t i = 0; i < count; i++)
        literals[i] = told(circuit, gates[i]);
    tell(circuit, literals, count);
    free(literals);
}

/* Of what is all of some gates, each is asserted; of what is any of some, a clause of these: fewer variables. */
void tn_circuit_assert(tn_circuit *circuit, tn_signal gate)
{
    size_t size;
    const uint32_t *key = tn_interned(&circuit->nodes, gate / 2, &size);
    tn_signal *operands = key[0] == NODE_ALL ? malloc(size * sizeof *operands) : NULL;
    if (!operands) {
        tn_circuit_assert_any(circuit, &gate, 1);
        return;
    }
    for (size_t i = 1; i < size; i++)
        operands[i - 1] = gate & 1 ? tn_signal_not(key[i]) : key[i];
    for (size_t i = 0; !(gate & 1) && i < size - 1; i++)
        tn_circuit_assert_any(circuit, &operands[i], 1);
    if (gate & 1)
        tn_circuit_assert_any(circuit, operands, size - 1);
    free(operands);
}

void tn_circuit_prefer(tn_circuit *circuit, tn_signal gate)
{
    if (gate / 2 != 0 && circuit->status == TN_OK)
        circuit->status = circuit->calls->prefer(circuit->solver, told(circuit, gate), &circuit->error);
}

static bool stops(void *watch)
{
    return tn_watch_stopped(watch);
}

tn_status tn_circuit_solve(tn_circuit *circuit, const tn_signal *assumed, size_t count, uint64_t conflicts,
                           tn_watch *watch, tn_solver_answer *answer, tn_error *error)
{
    int *literals = malloc((count + 1) * sizeof *literals);
    if (!literals)
        return tn_fail_memory(error);
    for (size_t i = 0; i < count; i++)
        literals[i] = told(circuit, assumed[i]);
    tn_status status = tn_circuit_status(circuit, error);
    if (status == TN_OK)
        status = circuit->calls->solve(circuit->solver, literals, count, &(tn_solver_limits){conflicts, stops, watch},
                                       answer, error);
    free(literals);
    return status == TN_OK && *answer == TN_SOLVER_UNDECIDED ? tn_watch_check(watch, error) : status;
}

bool tn_circuit_value(tn_circuit *circuit, tn_signal gate)
{
    return circuit->calls->value(circuit->solver, literal(gate));
}

bool tn_circuit_failed(tn_circuit *circuit, tn_signal assumed)
{
    return circuit->calls->failed(circuit->solver, literal(assumed));
}
