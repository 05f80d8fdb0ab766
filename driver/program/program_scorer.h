/* Scores from outside: what is bred is scored by its problem, if it has one, and then by a program (docs/evolution.md
 * says what it reads and writes). */
#ifndef TARTAN_DRIVER_PROGRAM_PROGRAM_SCORER_H
#define TARTAN_DRIVER_PROGRAM_PROGRAM_SCORER_H

#include "driver/place/placer.h"
#include "driver/program/external.h"
#include "runtime/genome/breeding/evolve.h"
#include "runtime/geometry/mesh.h"

/* Told of forms while they are there: what scores sentences builds a form, measures it and forgets it. */

typedef struct tn_form_facts {
    const tn_mesh *mesh;
    const char *const *names; /* [count] of measures */
    const double *values;     /* [count]; not a number: it was not measured */
    size_t count;
} tn_form_facts;

/* Zeros: nobody listens. */
typedef struct tn_form_listener {
    void *context;
    tn_status (*hear)(void *context, unsigned thread, const tn_form_facts *facts, tn_error *error);
} tn_form_listener;

static inline tn_status tn_form_listener_tell(const tn_form_listener *listener, unsigned thread,
                                              const tn_form_facts *facts, tn_error *error)
{
    return listener->hear ? listener->hear(listener->context, thread, facts, error) : TN_OK;
}

typedef struct tn_program_scorer tn_program_scorer;

/* Cases of a program whose answers have so many numbers: these, and the problem's score. */
#define TN_PROGRAM_CASES(VALUES) ((VALUES) + 1)

/* What messages about individuals begin with where the program gave them no score. */
#define TN_PROGRAM_SAYS "the program "

typedef struct tn_program_scoring {
    tn_external_options program;
    double weight;
    bool separately;     /* each number is an objective behind those of the problem; else their sum is added to its
                            score */
    bool by_cases;       /* each number is also an error in a case of its own, and so is the problem's score */
    uint32_t population; /* of the run */
} tn_program_scoring;

tn_status tn_program_scorer_new(const tn_program_scoring *options, tn_program_scorer **scorer, tn_error *error);
void tn_program_scorer_free(tn_program_scorer *scorer);

/* What the scorers of forms are to tell; while the scorer lives. */
tn_form_listener tn_program_scorer_listener(tn_program_scorer *scorer);

/* The same for kits: told of models. */
tn_status tn_program_scorer_hear_model(void *scorer, unsigned thread, const tn_placed_facts *facts, tn_error *error);

/* The problem that scores before the program does; without this, there is none. It `wants` nothing where all that it
 * can score has the same score. TN_INVALID (E1232) where there are too many objectives. */
tn_status tn_program_scorer_follow(tn_program_scorer *scorer, const tn_evaluator *problem, bool wants, tn_error *error);

/* Individuals are scored together. `evaluate`, for those that were scored before, only says again why they failed. */
tn_evaluator tn_program_scorer_evaluator(tn_program_scorer *scorer);

/* Which of its objectives, from 0 on, is this objective of the run? SIZE_MAX: one of the problem's. */
size_t tn_program_scorer_number(const tn_program_scorer *scorer, size_t objective);

const tn_external *tn_program_scorer_program(const tn_program_scorer *scorer);

#endif
