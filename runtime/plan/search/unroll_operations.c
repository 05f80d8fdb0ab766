/* The instructions of the plan language on relations of gates. */
#include "runtime/plan/search/unroll_data.h"

#include <stdlib.h>

static tn_signal at(const tn_unrolled *u, const tn_symbolic *relation, uint32_t i, uint32_t j)
{
    return tn_symbolic_at(u, relation, i, j);
}

static tn_signal *cell(const tn_unrolled *u, const tn_symbolic *relation, uint32_t i, uint32_t j)
{
    return &relation->cells[u->row[i] + j];
}

/* The last row that is wanted, and in it the first column. */
static uint32_t last_row(const tn_unrolled *u, const tn_symbolic *out)
{
    return out->plain ? 0 : u->length;
}

static uint32_t first_column(const tn_unrolled *u, const tn_symbolic *out, uint32_t i)
{
    return out->plain ? u->length : i;
}

static void put(const tn_unrolled *u, const tn_symbolic *out, uint32_t i, uint32_t j, tn_signal gate)
{
    out->cells[out->plain ? 0 : u->row[i] + j] = gate;
}

static uint32_t place_of(const tn_unrolled *u, bool reversed, uint32_t k)
{
    return reversed ? u->length - 1 - k : k;
}

/* ---- trays */

static void run_tray(tn_unrolled *u, uint32_t spec, bool reversed, const tn_symbolic *out)
{
    for (uint32_t k = 0; k < u->length; k++)
        if (!out->plain || u->length == 1)
            put(u, out, k, k + 1, tn_letters_meet(u->letters, place_of(u, reversed, k), spec));
}

/* Stretches whose ends are alike, and what is between them is mirrored. */
static void run_mirrored(tn_unrolled *u, uint32_t field, bool reversed, const tn_symbolic *out)
{
    uint32_t n = u->length;
    field -= (uint32_t)u->schema->record->field_first;
    if (out->plain) {
        size_t count = 0;
        for (uint32_t i = 0; i < n / 2; i++)
            u->gates[count++] = tn_letters_alike(u->letters, i, n - 1 - i, field);
        out->cells[0] = tn_circuit_all(u->circuit, u->gates, count);
        return;
    }
    for (uint32_t i = n + 1; i-- > 0;)
        for (uint32_t j = i; j <= n; j++) {
            tn_signal ends = TN_SIGNAL_TRUE;
            if (j > i + 1)
                ends = tn_circuit_and(
                    u->circuit, at(u, out, i + 1, j - 1),
                    tn_letters_alike(u->letters, place_of(u, reversed, i), place_of(u, reversed, j - 1), field));
            put(u, out, i, j, ends);
        }
}

/* ---- and, or, not, and what takes stretches away */

static tn_signal join(tn_unrolled *u, tn_opcode opcode, tn_signal a, tn_signal b)
{
    return opcode == TN_OP_OR ? tn_circuit_or(u->circuit, a, b) : tn_circuit_and(u->circuit, a, b);
}

static tn_signal keep_cell(tn_unrolled *u, tn_opcode opcode, const tn_symbolic *in, uint32_t i, uint32_t j)
{
    tn_signal gate = at(u, &in[0], i, j);
    switch (opcode) {
    case TN_OP_AND:
    case TN_OP_OR:
        return join(u, opcode, gate, at(u, &in[1], i, j));
    case TN_OP_WHERE:
        return i < j ? tn_circuit_and(u->circuit, gate, at(u, &in[1], i, j)) : TN_SIGNAL_FALSE;
    case TN_OP_NOT:
        return tn_signal_not(gate);
    case TN_OP_NONEMPTY:
        return i < j ? gate : TN_SIGNAL_FALSE;
    case TN_OP_OPTIONAL:
        return i < j ? gate : TN_SIGNAL_TRUE;
    case TN_OP_BEGINNING:
        return i == 0 ? gate : TN_SIGNAL_FALSE;
    case TN_OP_END:
        return j == u->length ? gate : TN_SIGNAL_FALSE;
    default: /* ONCE */
        return gate;
    }
}

static void run_cells(tn_unrolled *u, tn_opcode opcode, const tn_symbolic *in, const tn_symbolic *out)
{
    for (uint32_t i = 0; i <= last_row(u, out); i++)
        for (uint32_t j = first_column(u, out, i); j <= u->length; j++)
            put(u, out, i, j, keep_cell(u, opcode, in, i, j));
}

/* ---- stretches within stretches, and one after another */

static void run_somewhere(tn_unrolled *u, const tn_symbolic *in, const tn_symbolic *out)
{
    uint32_t n = u->length;
    if (out->plain) {
        size_t count = 0;
        for (uint32_t i = 0; i < n; i++)
            for (uint32_t j = i + 1; j <= n; j++)
                u->gates[count++] = at(u, in, i, j);
        out->cells[0] = tn_circuit_any(u->circuit, u->gates, count);
        return;
    }
    for (uint32_t i = n; i-- > 0;)
        for (uint32_t j = i + 1; j <= n; j++) {
            tn_signal some[3] = {at(u, in, i, j), j > i + 1 ? at(u, out, i, j - 1) : TN_SIGNAL_FALSE,
                                 j > i + 1 ? at(u, out, i + 1, j) : TN_SIGNAL_FALSE};
            put(u, out, i, j, tn_circuit_any(u->circuit, some, 3));
        }
}

static void run_many(tn_unrolled *u, const tn_symbolic *in, const tn_symbolic *out)
{
    uint32_t n = u->length;
    if (out->plain) {
        for (uint32_t k = 0; k < n; k++)
            u->gates[k] = at(u, in, k, k + 1);
        out->cells[0] = n > 0 ? tn_circuit_all(u->circuit, u->gates, n) : TN_SIGNAL_FALSE;
        return;
    }
    for (uint32_t i = n; i-- > 0;)
        for (uint32_t j = i + 1; j <= n; j++)
            put(u, out, i, j,
                j == i + 1 ? at(u, in, i, j) : tn_circuit_and(u->circuit, at(u, in, i, i + 1), at(u, out, i + 1, j)));
}

/* Of row i of `lower`, where stretches can end; how many such places. */
static uint32_t list_cuts(const tn_unrolled *u, const tn_symbolic *lower, uint32_t i, uint32_t *cuts)
{
    uint32_t count = 0;
    for (uint32_t c = i; c <= u->length; c++)
        if (at(u, lower, i, c) != TN_SIGNAL_FALSE)
            cuts[count++] = c;
    return count;
}

/* out := stretches cut in two, one part in each relation. `out` may be `lower`. */
static tn_status chain(tn_unrolled *u, const tn_symbolic *lower, const tn_symbolic *upper, const tn_symbolic *out,
                       tn_error *error)
{
    uint32_t *cuts = malloc(((size_t)u->length + 1) * sizeof *cuts);
    tn_signal *row = malloc(((size_t)u->length + 1) * sizeof *row);
    for (uint32_t i = 0; cuts && row && i <= last_row(u, out); i++) {
        uint32_t count = list_cuts(u, lower, i, cuts);
        for (uint32_t j = first_column(u, out, i); j <= u->length; j++) {
            size_t some = 0;
            for (uint32_t c = 0; c < count && cuts[c] <= j; c++) {
                tn_signal rest = at(u, upper, cuts[c], j);
                if (rest != TN_SIGNAL_FALSE)
                    u->gates[some++] = tn_circuit_and(u->circuit, at(u, lower, i, cuts[c]), rest);
            }
            row[j] = tn_circuit_any(u->circuit, u->gates, some);
        }
        for (uint32_t j = first_column(u, out, i); j <= u->length; j++)
            put(u, out, i, j, row[j]);
    }
    bool made = cuts && row;
    free(cuts);
    free(row);
    return made ? TN_OK : tn_fail_memory(error);
}

/* relation := what any number of its stretches make, one after another; none of them, too. */
static void star(tn_unrolled *u, const tn_symbolic *relation)
{
    for (uint32_t i = u->length + 1; i-- > 0;) {
        for (uint32_t j = u->length; j > i; j--) {
            size_t some = 0;
            for (uint32_t e = i + 1; e <= j; e++)
                u->gates[some++] =
                    tn_circuit_and(u->circuit, at(u, relation, i, e), e < j ? at(u, relation, e, j) : TN_SIGNAL_TRUE);
            u->gates[u->length + j] = tn_circuit_any(u->circuit, u->gates, some); /* row i is still read */
        }
        for (uint32_t j = i + 1; j <= u->length; j++)
            *cell(u, relation, i, j) = u->gates[u->length + j];
        *cell(u, relation, i, i) = TN_SIGNAL_TRUE;
    }
}

/* As many stretches as it needs, and then as many as it may have. */
static tn_status chain_times(tn_unrolled *u, const tn_symbolic *sofar, const tn_symbolic *each, uint64_t least,
                             uint64_t most, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint64_t n = 1; status == TN_OK && n < least; n++)
        status = chain(u, sofar, each, sofar, error);
    bool any = most == 0 || most >= u->length;
    if (any)
        star(u, each);
    for (uint32_t i = 0; !any && i <= u->length; i++)
        *cell(u, each, i, i) = TN_SIGNAL_TRUE;
    for (uint64_t n = any ? 0 : least; status == TN_OK && n < (any ? 1 : most); n++)
        status = chain(u, sofar, each, sofar, error);
    return status;
}

static tn_status run_repeated(tn_unrolled *u, const tn_instruction *op, const tn_symbolic *in, const tn_symbolic *out,
                              tn_error *error)
{
    tn_symbolic sofar = {0}, each = {0};
    if ((uint64_t)op->first > u->length)
        return TN_OK;
    tn_status status = tn_symbolic_new(u, false, &sofar, error);
    if (status == TN_OK)
        status = tn_symbolic_new(u, false, &each, error);
    for (uint32_t i = 0; status == TN_OK && i <= u->length; i++)
        for (uint32_t j = i + 1; j <= u->length; j++)
            *cell(u, &sofar, i, j) = *cell(u, &each, i, j) = at(u, in, i, j);
    if (status == TN_OK)
        status = chain_times(u, &sofar, &each, (uint64_t)op->first, (uint64_t)op->second, error);
    for (uint32_t i = 0; status == TN_OK && i <= last_row(u, out); i++)
        for (uint32_t j = first_column(u, out, i); j <= u->length; j++)
            put(u, out, i, j, at(u, &sofar, i, j));
    tn_symbolic_free(u, &sofar);
    tn_symbolic_free(u, &each);
    return status;
}

/* ---- gaps: DISTANCE, NEAR and FAR */

/* Of each place (length + 1 of them): does a destination begin there, or end; are the gaps to all that begin at it or
 * behind it in the separator; is the gap to some that ends at it or before it not. */
typedef struct symbolic_gaps {
    tn_signal *begins, *ends, *right_fine, *left_bad;
} symbolic_gaps;

static tn_signal in_separator(const tn_unrolled *u, const tn_symbolic *separator, bool opposite, uint32_t i, uint32_t j)
{
    tn_signal gate = at(u, separator, i, j);
    return opposite ? tn_signal_not(gate) : gate;
}

static void find_edges(tn_unrolled *u, const tn_symbolic *destination, const symbolic_gaps *gaps)
{
    for (uint32_t p = 0; p <= u->length; p++) {
        size_t some = 0;
        for (uint32_t b = p + 1; b <= u->length; b++)
            u->gates[some++] = at(u, destination, p, b);
        gaps->begins[p] = tn_circuit_any(u->circuit, u->gates, some);
        some = 0;
        for (uint32_t a = 0; a < p; a++)
            u->gates[some++] = at(u, destination, a, p);
        gaps->ends[p] = tn_circuit_any(u->circuit, u->gates, some);
    }
}

/* opposite: of what is not in the separator. */
static void find_gaps(tn_unrolled *u, const tn_symbolic *destination, const tn_symbolic *separator, bool opposite,
                      const symbolic_gaps *gaps)
{
    find_edges(u, destination, gaps);
    for (uint32_t p = 0; p <= u->length; p++) {
        size_t some = 0;
        for (uint32_t a = p; a <= u->length; a++)
            u->gates[some++] =
                tn_circuit_and(u->circuit, gaps->begins[a], tn_signal_not(in_separator(u, separator, opposite, p, a)));
        gaps->right_fine[p] = tn_signal_not(tn_circuit_any(u->circuit, u->gates, some));
        some = 0;
        for (uint32_t b = 0; b <= p; b++)
            u->gates[some++] =
                tn_circuit_and(u->circuit, gaps->ends[b], tn_signal_not(in_separator(u, separator, opposite, b, p)));
        gaps->left_bad[p] = tn_circuit_any(u->circuit, u->gates, some);
    }
}

/* Does a destination share a tray with [i, j)? `before`: that of [i, j - 1). */
static tn_signal overlaps(tn_unrolled *u, const tn_symbolic *destination, uint32_t j, tn_signal before)
{
    size_t some = 0;
    for (uint32_t b = j; b <= u->length; b++)
        u->gates[some++] = at(u, destination, j - 1, b);
    u->gates[some++] = before;
    return tn_circuit_any(u->circuit, u->gates, some);
}

/* Those that begin before i and reach into it. */
static tn_signal reaches(tn_unrolled *u, const tn_symbolic *destination, uint32_t i)
{
    size_t some = 0;
    for (uint32_t a = 0; a < i; a++)
        for (uint32_t b = i + 1; b <= u->length; b++)
            u->gates[some++] = at(u, destination, a, b);
    return tn_circuit_any(u->circuit, u->gates, some);
}

static tn_signal near_or_far(tn_unrolled *u, tn_opcode opcode, const symbolic_gaps *gaps, uint32_t i, uint32_t j)
{
    if (opcode == TN_OP_NEAR)
        return tn_circuit_or(u->circuit, gaps->left_bad[i], tn_signal_not(gaps->right_fine[j]));
    return tn_circuit_and(u->circuit, tn_signal_not(gaps->left_bad[i]), gaps->right_fine[j]);
}

static void keep_sources(tn_unrolled *u, tn_opcode opcode, const tn_symbolic *in, const symbolic_gaps *gaps,
                         const tn_symbolic *out)
{
    for (uint32_t i = 0; i < u->length && i <= last_row(u, out); i++) {
        tn_signal overlap = opcode == TN_OP_DISTANCE ? reaches(u, &in[1], i) : TN_SIGNAL_FALSE;
        for (uint32_t j = i + 1; j <= u->length; j++) {
            tn_signal fits[3] = {at(u, &in[0], i, j), near_or_far(u, opcode, gaps, i, j), TN_SIGNAL_TRUE};
            if (opcode == TN_OP_DISTANCE) {
                overlap = overlaps(u, &in[1], j, overlap);
                fits[2] = tn_circuit_or(u->circuit, tn_signal_not(overlap), at(u, &in[2], i, i));
            }
            if (!out->plain || j == u->length)
                put(u, out, i, j, tn_circuit_all(u->circuit, fits, 3));
        }
    }
}

static tn_status run_gaps(tn_unrolled *u, tn_opcode opcode, const tn_symbolic *in, const tn_symbolic *out,
                          tn_error *error)
{
    size_t places = (size_t)u->length + 1;
    tn_signal *room = malloc(4 * places * sizeof *room);
    if (!room)
        return tn_fail_memory(error);
    const symbolic_gaps gaps = {room, room + places, room + 2 * places, room + 3 * places};
    find_gaps(u, &in[1], &in[2], opcode == TN_OP_NEAR, &gaps);
    keep_sources(u, opcode, in, &gaps, out);
    free(room);
    return TN_OK;
}

/* ---- any of them */

tn_status tn_unroll_operate(tn_unrolled *u, const tn_postfix_node *node, bool reversed, const tn_symbolic *in,
                            tn_symbolic *out, tn_error *error)
{
    const tn_instruction *op = &node->code;
    switch (op->opcode) {
    case TN_OP_TRAY:
        run_tray(u, (uint32_t)op->first, reversed, out);
        return TN_OK;
    case TN_OP_MIRRORED:
        run_mirrored(u, (uint32_t)op->first, reversed, out);
        return TN_OK;
    case TN_OP_SOMEWHERE:
        run_somewhere(u, in, out);
        return TN_OK;
    case TN_OP_MANY:
        run_many(u, in, out);
        return TN_OK;
    case TN_OP_CHAIN:
        return chain(u, &in[0], &in[1], out, error);
    case TN_OP_REPEATED:
        return run_repeated(u, op, in, out, error);
    case TN_OP_DISTANCE:
    case TN_OP_NEAR:
    case TN_OP_FAR:
        return run_gaps(u, op->opcode, in, out, error);
    case TN_OP_QUANTITY:
    case TN_OP_SUM:
    case TN_OP_OCCURRENCES:
        return tn_unroll_count(u, op, reversed, in, out, error);
    default:
        run_cells(u, op->opcode, in, out);
        return TN_OK;
    }
}
