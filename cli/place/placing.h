/* A run of `tartan place`: its settings, and what it writes. Internal to place.c and output.c. */
#ifndef TARTAN_CLI_PLACE_PLACING_H
#define TARTAN_CLI_PLACE_PLACING_H

#include "cli/common/option_rows.h"
#include "cli/place/place.h"
#include "driver/place/asked.h"

typedef struct place_settings {
    tn_settings common;
    tn_option_list outputs;
    const char *program, *model, *steps, *fitness;
    tn_option_number seed, part_limit, step_limit, frame_limit, lookahead_limit, search_limit, threads;
    int stats, engine;
    bool trace, header, keep_partial, sheet;
} place_settings;

typedef enum out_format { OUT_LDRAW, OUT_SUBFILES, OUT_LIST, OUT_PICTURE, OUT_MESH } out_format;

typedef struct placing {
    tn_job *job;
    const place_settings *settings;
    tn_place_rules rules;
    tn_placed_model model;
    uint32_t chosen; /* model of a kit */
    tn_placed_steps steps;
    tn_place_fitness fitness;
    bool has_steps;  /* they were asked for, and the parts are in their order */
    tn_watch *watch; /* NULL once an interrupt was answered */
} placing;

/* By the ending of its name. */
out_format tn_place_format(const char *path);

/* Reads what --steps says; false where that is neither part nor layer nor a number of parts. */
bool tn_place_read_steps(const char *text, tn_steps_wish *wish);

/* Finds the steps in which what was placed is built, where they are asked for: its parts are in their order then. Warns
 * of parts that cannot be put in. False where that failed, which is told. */
bool tn_place_find_steps(placing *p);

/* Everything that was asked for. */
void tn_place_write_all(placing *p);

#endif
