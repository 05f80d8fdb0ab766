/* A model on its way from the rules into an answer. Internal to the question `place`. */
#ifndef TARTAN_ASK_PLACE_PLACING_H
#define TARTAN_ASK_PLACE_PLACING_H

#include "ask/session/made.h"
#include "driver/place/asked.h"
#include "runtime/place/steps.h"
#include "runtime/place/write.h"

/* What a model can be written as. */
#define TN_PLACED_FILES                                                                                                \
    (TN_WRITES_PICTURES | TN_WRITES(LDR) | TN_WRITES(MPD) | TN_WRITES(CSV) | TN_WRITES(OBJ) | TN_WRITES(PLY) |         \
     TN_WRITES(STL) | TN_WRITES(OFF) | TN_WRITES(OM) | TN_WRITES(GLB) | TN_WRITES(3MF) | TN_WRITES(DXF))

typedef struct tn_model_placing {
    tn_session *session;
    const tn_place_request *request;
    tn_placed *placed; /* the answer */
    tn_place_rules rules;
    uint32_t chosen; /* model of a kit */
    tn_place_fitness fitness;
    tn_placed_model model;
    tn_placed_steps steps;
    bool has_steps;  /* they were asked for, and the parts are in their order */
    tn_watch *watch; /* NULL once it has stopped a search whose best is kept */
    tn_making trace;
} tn_model_placing;

/* The one of two statuses that weighs more. */
static inline tn_status tn_graver(tn_status a, tn_status b)
{
    return a > b ? a : b;
}

/* Reads what is said of steps; false if it is neither part nor layer nor a number of parts. */
bool tn_placing_read_steps(const char *text, tn_steps_wish *wish);

/* Finds the steps in which what was placed is built, if they are asked for: its parts are in their order then. Warns of
 * parts that cannot be put in. What fails is said. */
tn_status tn_placing_find_steps(tn_model_placing *p);

/* Puts the parts by their kinds and all files that were asked for into the answer. What fails is said; the other files
 * are made. */
tn_status tn_placing_write(tn_model_placing *p);

/* Writes a line about an event to the trace. */
void tn_placing_trace(const tn_model_placing *p, const tn_place_event *event);

#endif
