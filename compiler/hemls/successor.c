/* Turns a successor's symbols into moves of the turtle, and puts what the turtle finds wrong with them into words at
 * their places. The turtle itself is the runtime's (runtime/growth/model/system.h): what it accepts here, the verifier
 * accepts in the module. */
#include <stdarg.h>
#include <stdio.h>

#include "compiler/hemls/hemls.h"
#include "runtime/growth/model/system.h"

/* A turn to the right is one to the left by a negative angle. */
static tn_instruction turn_of(char sign, double angle)
{
    tn_opcode axis = sign == '+' || sign == '-' ? TN_OP_TURN : sign == '&' || sign == '^' ? TN_OP_PITCH : TN_OP_ROLL;
    bool back = sign == '-' || sign == '^' || sign == '/';
    return (tn_instruction){.opcode = axis, .first = (int64_t)tn_bits_of(back ? -angle : angle)};
}

tn_instruction tn_hemls_move(const tn_hemls_symbol *symbol, double angle)
{
    switch (symbol->kind) {
    case TN_HEMLS_EDGE:
        return (tn_instruction){.opcode = TN_OP_DRAW, .second = symbol->age};
    case TN_HEMLS_TURN:
        return turn_of(symbol->sign, angle);
    case TN_HEMLS_TILDE:
        return (tn_instruction){.opcode = TN_OP_FLIP};
    case TN_HEMLS_OPEN:
        return (tn_instruction){.opcode = TN_OP_OPEN};
    case TN_HEMLS_CLOSE:
        return (tn_instruction){.opcode = TN_OP_CLOSE};
    default:
        return (tn_instruction){.opcode = TN_OP_PASS}; /* no move */
    }
}

/* ---- what is wrong */

typedef struct successor {
    tn_diagnostics *diagnostics;
    const tn_hemls_symbols *symbols;
    tn_span span;
} successor;

/* Is the innermost bracket closed by something behind this symbol? */
static bool is_closed(const tn_hemls_symbol *symbol)
{
    uint32_t depth = 1;
    for (symbol = symbol->next; symbol && depth > 0; symbol = symbol->next)
        depth += (symbol->kind == TN_HEMLS_OPEN) - (symbol->kind == TN_HEMLS_CLOSE);
    return depth == 0;
}

/* The innermost `[` that is open before `end` (NULL: at the end). */
static const tn_hemls_symbol *innermost(const successor *s, const tn_hemls_symbol *end)
{
    uint32_t depth = 0, level = 0;
    const tn_hemls_symbol *open = NULL;
    for (const tn_hemls_symbol *at = s->symbols->first; at != end; at = at->next)
        level += (uint32_t)(at->kind == TN_HEMLS_OPEN) - (uint32_t)(at->kind == TN_HEMLS_CLOSE);
    for (const tn_hemls_symbol *at = s->symbols->first; at != end; at = at->next) {
        depth += (uint32_t)(at->kind == TN_HEMLS_OPEN) - (uint32_t)(at->kind == TN_HEMLS_CLOSE);
        if (at->kind == TN_HEMLS_OPEN && depth == level)
            open = at;
    }
    return open;
}

/* The `~` of this number, counted from 1. */
static const tn_hemls_symbol *tilde(const successor *s, uint32_t number)
{
    const tn_hemls_symbol *at = s->symbols->first;
    for (; at; at = at->next)
        if (at->kind == TN_HEMLS_TILDE && --number == 0)
            break;
    return at;
}

static void complain_of_open_bracket(const successor *s, const tn_hemls_symbol *open)
{
    tn_diagnostic *d = tn_report(s->diagnostics, E_BRACKETS, open->span, "this `[` is never closed");
    tn_help(s->diagnostics, d, "close the branch with `]` after its edge, as in `[ + A ]`");
}

static void complain_of_full_branch(const successor *s, const tn_hemls_symbol *symbol)
{
    const tn_hemls_symbol *open = innermost(s, symbol);
    if (symbol->kind == TN_HEMLS_OPEN) {
        tn_diagnostic *d = tn_report(s->diagnostics, E_BRANCH_OF_SEVERAL, symbol->span,
                                     "a branch draws one edge only, and this bracket has drawn it");
        tn_help(s->diagnostics, d, "close the bracket before the next branch opens");
    } else if (!is_closed(symbol)) { /* its end was forgotten behind its edge */
        complain_of_open_bracket(s, open);
    } else {
        tn_diagnostic *d = tn_report(s->diagnostics, E_BRANCH_OF_SEVERAL, symbol->span, "a branch draws one edge only");
        tn_note(s->diagnostics, d, &open->span, "the bracket that it stands in");
        tn_help(s->diagnostics, d, "give each branch its own bracket, as in `[ [ + %s ] - %s ]`", symbol->name,
                symbol->name);
    }
}

static void complain_of_close(const successor *s, const tn_hemls_symbol *symbol, unsigned wrong, uint32_t flip)
{
    if (wrong & TN_TURTLE_UNOPENED) {
        tn_diagnostic *d = tn_report(s->diagnostics, E_BRACKETS, symbol->span, "this `]` closes nothing");
        tn_help(s->diagnostics, d, "leave it out, or open the branch with `[`");
    }
    if (wrong & TN_TURTLE_EMPTY) {
        tn_span span = tn_span_join(innermost(s, symbol)->span, symbol->span);
        tn_diagnostic *d = tn_report(s->diagnostics, E_EMPTY_BRANCH, span, "this branch draws no edge");
        tn_help(s->diagnostics, d, "a branch turns and draws one edge, as in `[ + A ]`; leave an empty one out");
    }
    if (wrong & TN_TURTLE_UNFLIPPED) {
        tn_diagnostic *d = tn_report(s->diagnostics, E_DANGLING_TILDE, tilde(s, flip)->span,
                                     "no edge follows this `~` in its bracket");
        tn_help(s->diagnostics, d, "`~` turns round the next edge that is drawn; leave it out or move it");
    }
}

static void complain_of_crowd(const successor *s, const tn_hemls_symbol *symbol)
{
    bool bracket = symbol->kind == TN_HEMLS_OPEN;
    tn_diagnostic *d = tn_report(s->diagnostics, E_TOO_MANY, bracket ? symbol->span : s->span,
                                 "this successor has more %s than the limit of %u", bracket ? "brackets" : "edges",
                                 TN_TEMPLATE_ITEMS_MAX);
    tn_help(s->diagnostics, d,
            bracket ? "one pair of brackets is enough for a branch: `[ + A ]`" : "spread it over several rules");
}

static void complain_of_symbol(const successor *s, const tn_hemls_symbol *symbol)
{
    tn_diagnostic *d = tn_report(s->diagnostics, E_MISPLACED_SYMBOL, symbol->span,
                                 "`%c` does not belong in a successor", symbol->kind == TN_HEMLS_LESS ? '<' : '>');
    tn_help(s->diagnostics, d, "contexts stand before `->`; a condition on the age is written `If i < 3`");
}

static void complain_of_move(const successor *s, const tn_hemls_symbol *symbol, unsigned wrong, uint32_t flip)
{
    if (wrong & TN_TURTLE_CROWDED)
        complain_of_crowd(s, symbol);
    else if (wrong & TN_TURTLE_FULL)
        complain_of_full_branch(s, symbol);
    else if (wrong & TN_TURTLE_NO_MOVE)
        complain_of_symbol(s, symbol);
    else
        complain_of_close(s, symbol, wrong, flip);
}

/* The turns that would bring the turtle back where one kind of turn is out of balance, for a suggestion. */
static const char *missing_turn(const tn_hemls_symbols *symbols, int *count)
{
    static const char signs[] = "+-&^\\/";
    int balance[3] = {0, 0, 0}, depth = 0;
    for (const tn_hemls_symbol *s = symbols->first; s; s = s->next) {
        depth += s->kind == TN_HEMLS_OPEN ? 1 : s->kind == TN_HEMLS_CLOSE ? -1 : 0;
        for (int i = 0; i < 6 && s->kind == TN_HEMLS_TURN && depth == 0; i++)
            if (s->sign == signs[i])
                balance[i / 2] += i % 2 ? -1 : 1;
    }
    static const char *const undo[] = {"-", "+", "^", "&", "/", "\\"};
    for (int i = 0; i < 3; i++) {
        if (balance[i] != 0) {
            *count = balance[i] > 0 ? balance[i] : -balance[i];
            return undo[2 * i + (balance[i] < 0)];
        }
    }
    return NULL;
}

static void complain_of_direction(const successor *s)
{
    int count = 0;
    const char *turn = missing_turn(s->symbols, &count);
    tn_diagnostic *d = tn_report(s->diagnostics, E_TURTLE_ASTRAY, s->span,
                                 "the turtle does not end in the direction that it started in");
    if (turn)
        tn_help(s->diagnostics, d, "every turn has to be undone: add %d `%s` at the end", count, turn);
    else
        tn_help(s->diagnostics, d, "undo turns in the opposite order: `+ & A ^ -`, not `+ & A - ^`");
}

static void complain_of_end(const successor *s, unsigned wrong, uint32_t flip)
{
    if (wrong & TN_TURTLE_UNCLOSED)
        complain_of_open_bracket(s, innermost(s, NULL));
    if (wrong & TN_TURTLE_UNFLIPPED) {
        tn_diagnostic *d =
            tn_report(s->diagnostics, E_DANGLING_TILDE, tilde(s, flip)->span, "no edge follows this `~`");
        tn_help(s->diagnostics, d, "`~` turns round the next edge that is drawn; leave it out or move it");
    }
    if (wrong & TN_TURTLE_NO_PATH) {
        tn_diagnostic *d =
            tn_report(s->diagnostics, E_NO_PATH, s->span, "this successor draws no edge outside its branches");
        tn_help(s->diagnostics, d, "what replaces an edge has to lead from its start to its end: `A -> A [ + B ] A`");
    }
    if (wrong & TN_TURTLE_ASTRAY)
        complain_of_direction(s);
}

/* ---- checking */

/* How many brackets are open at once, at most. */
static uint32_t deepest(const tn_hemls_symbols *symbols)
{
    uint32_t depth = 0, most = 0;
    for (const tn_hemls_symbol *s = symbols->first; s; s = s->next) {
        if (s->kind == TN_HEMLS_OPEN && ++depth > most)
            most = depth;
        else if (s->kind == TN_HEMLS_CLOSE && depth > 0)
            depth--;
    }
    return most;
}

bool tn_hemls_check_successor(tn_arena *arena, tn_diagnostics *diagnostics, double angle, tn_checked_successor *checked)
{
    successor s = {diagnostics, checked->symbols, checked->span};
    tn_turtle turtle;
    checked->depth = deepest(checked->symbols);
    tn_turtle_level *levels = TN_NEW_ARRAY(arena, tn_turtle_level, checked->depth + 1);
    if (!levels)
        return false;
    tn_turtle_start(&turtle, levels);
    for (const tn_hemls_symbol *symbol = checked->symbols->first; symbol; symbol = symbol->next) {
        tn_instruction move = tn_hemls_move(symbol, angle);
        uint32_t flip = turtle.flip;
        unsigned wrong = tn_turtle_move(&turtle, &move);
        if (wrong) {
            complain_of_move(&s, symbol, wrong, flip);
            return false;
        }
    }
    unsigned wrong = tn_turtle_move(&turtle, &(tn_instruction){.opcode = TN_OP_LAND});
    complain_of_end(&s, wrong, turtle.flip);
    return wrong == 0;
}
