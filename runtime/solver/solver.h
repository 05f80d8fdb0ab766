/* The satisfiability of clauses, by conflict-driven clause learning (Marques-Silva and Sakallah: GRASP, 1996), as an
 * incremental solver answers it: clauses may be added between questions, and a question may assume literals (Eén and
 * Sörensson: Temporal induction by incremental SAT solving, 2003).
 *
 * A variable is a number from 1, a literal is one or its negative. The work is done by CaDiCaL (part `search`), whose
 * functions are listed here so that the part is looked for once. Answers depend on what was asked alone, never on time.
 *
 * The owner frees a tn_solver; it is used by one thread. */
#ifndef TARTAN_SOLVER_SOLVER_H
#define TARTAN_SOLVER_SOLVER_H

#include "runtime/base/error.h"

typedef struct tn_solver tn_solver;

typedef enum tn_solver_answer {
    TN_SOLVER_YES,      /* all clauses and assumptions can be true at once: `value` */
    TN_SOLVER_NO,       /* they cannot: `failed` */
    TN_SOLVER_UNDECIDED /* that took more than it might */
} tn_solver_answer;

/* What an answer may take. */
typedef struct tn_solver_limits {
    uint64_t conflicts;           /* the most that may happen on the way */
    bool (*stops)(void *context); /* asked now and then whether to give up; or NULL */
    void *context;
} tn_solver_limits;

typedef struct tn_solver_calls {
    tn_status (*make)(tn_solver **solver, tn_error *error);
    void (*free)(tn_solver *solver);

    /* Adds a clause: at least one of the literals is true. */
    tn_status (*clause)(tn_solver *solver, const int *literals, size_t count, tn_error *error);

    /* Where the literal's variable has to be guessed, it is guessed so from now on. */
    tn_status (*prefer)(tn_solver *solver, int literal, tn_error *error);

    /* Can all clauses be true, with all of the assumed literals? */
    tn_status (*solve)(tn_solver *solver, const int *assumed, size_t count, const tn_solver_limits *limits,
                       tn_solver_answer *answer, tn_error *error);

    /* After YES: is the literal true? A variable that no clause has is false. */
    bool (*value)(tn_solver *solver, int literal);

    /* After NO: was the assumed literal used to show that? */
    bool (*failed)(tn_solver *solver, int assumed);
} tn_solver_calls;

/* NULL: there is no solver (E0907). */
const tn_solver_calls *tn_solver_cadical(tn_error *error);

#endif
