/* What `tartan draw` is told, and its sheets of plans and rules. */
#ifndef TARTAN_CLI_DRAW_DRAW_H
#define TARTAN_CLI_DRAW_DRAW_H

#include "cli/plan/plan_input.h"

typedef struct tn_draw_settings {
    tn_settings common;
    tn_plan_settings plans;
    tn_input_settings input;
    const char *output, *title, *paper;
    tn_option_list rules;
    tn_option_list wanted; /* wishes of --best */
    bool mirror, diverse;
    tn_option_number best, sample, seed, length, per_length, scale, columns, dpi, max_plans;
    /* of forms */
    const char *solid, *surface;
    bool sheet, before, exploded, sharp, open;
    tn_option_real azimuth, elevation;
    tn_option_number width, max_boxes, grid;
} tn_draw_settings;

/* The most plans that are drawn from a library. */
#define TN_DRAW_SAMPLE_MAX 50000000u

/* The most plans of one sheet. */
size_t tn_draw_max_plans(const tn_draw_settings *settings);

/* Each draws what the job's settings say, and reports what is wrong. */
void tn_job_draw_library(tn_job *job);                /* its best plans, or a sample */
void tn_job_draw_file(tn_job *job, const char *path); /* "-" is standard input */
void tn_job_draw_rules(tn_job *job);

#endif
