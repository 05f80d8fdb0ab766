#include "driver/grower.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "driver/open.h"
#include "runtime/map/draw.h"
#include "runtime/map/study.h"

struct tn_grower {
    tn_opened opened; /* of the study */
    tn_study study;
    bool separately;
    tn_fitness_term terms[TN_FITNESS_TERM_COUNT]; /* that are wanted */
    size_t term_count;
    tn_growth **growths; /* by thread: each grows one surface after another in the same memory; NULL before the first */
    unsigned threads;
};

void tn_grower_free(tn_grower *g)
{
    if (!g)
        return;
    for (unsigned t = 0; g->growths && t < g->threads; t++)
        tn_growth_free(g->growths[t]);
    free(g->growths);
    tn_study_clear(&g->study);
    tn_close(&g->opened);
    free(g);
}

static const char *first_error(const tn_opened *opened)
{
    const tn_diagnostics *list = &opened->compilation.diagnostics;
    for (size_t i = 0; i < list->count; i++)
        if (list->items[i].severity == TN_ERROR)
            return list->items[i].message;
    return "it does not compile";
}

static tn_status open_study(tn_grower *g, const char *path, tn_error *error)
{
    if (tn_open(path, false, &g->opened) != TN_OK) {
        return tn_fail(error, TN_INVALID, 1245, "the growth study %.100s cannot be used: %.300s", path,
                       first_error(&g->opened));
    }
    tn_status status = tn_study_read(g->opened.module, path, &g->study, error);
    for (tn_fitness_term term = 0; term < TN_FITNESS_TERM_COUNT; term++)
        if (g->study.goal.wanted[term])
            g->terms[g->term_count++] = term;
    if (status == TN_OK && g->term_count == 0) {
        status = tn_fail(error, TN_INVALID, 1245, "the growth study %.200s wants nothing of a surface", path);
        tn_error_help(error, "add lines such as `fitness undulation target 2 weight 1`");
    }
    g->study.options.threads = 1;
    if (g->study.options.edge_limit == 0)
        g->study.options.edge_limit = TN_GROWER_EDGES;
    return status;
}

tn_status tn_grower_new(const char *study, bool separately, unsigned threads, tn_grower **grower, tn_error *error)
{
    tn_grower *g = calloc(1, sizeof *g);
    *grower = g;
    if (!g)
        return tn_fail_memory(error);
    g->separately = separately;
    g->threads = threads;
    g->growths = calloc(threads, sizeof(tn_growth *));
    tn_status status = g->growths ? open_study(g, study, error) : tn_fail_memory(error);
    if (status != TN_OK) {
        tn_grower_free(g);
        *grower = NULL;
    }
    return status;
}

/* ---- one growth */

/* A sentence compiled. */
typedef struct rules {
    tn_opened opened;
    tn_growth_system *system;
} rules;

static void rules_clear(rules *r)
{
    tn_growth_system_free(r->system);
    tn_close(&r->opened);
}

/* Compiles a sentence and grows its surface; *growth, where there is one, is used again. */
static tn_status grow(const tn_grower *g, const char *sentence, size_t size, rules *r, tn_growth **growth,
                      tn_error *error)
{
    const tn_study *study = &g->study;
    *r = (rules){0};
    tn_status status = tn_open_bytes("evolved.hemls", (const uint8_t *)sentence, size, false, &r->opened);
    if (status != TN_OK)
        return tn_fail(error, TN_INVALID, 0, "%.400s", first_error(&r->opened));
    status = tn_growth_system_read(r->opened.module, &r->system, error);
    if (status == TN_OK)
        status = *growth ? tn_growth_renew(*growth, r->system, &study->environment, &study->options, error)
                         : tn_growth_new(r->system, &study->environment, &study->options, growth, error);
    for (uint32_t step = 0; status == TN_OK && step < study->steps && !tn_growth_at_rest(*growth); step++)
        status = tn_growth_step(*growth, error);
    return status;
}

static void score_terms(const tn_grower *g, const tn_fitness *fitness, tn_score *score)
{
    double side = g->study.options.start_length;
    if (!g->separately) {
        score->objectives[0] = tn_fitness_total(fitness, &g->study.goal, side);
        return;
    }
    for (size_t i = 0; i < g->term_count; i++) {
        tn_fitness_goal one = g->study.goal;
        for (tn_fitness_term term = 0; term < TN_FITNESS_TERM_COUNT; term++)
            one.wanted[term] = term == g->terms[i];
        score->objectives[i] = tn_fitness_total(fitness, &one, side);
    }
}

static tn_status score_growth(void *context, unsigned thread, const char *sentence, size_t size, tn_score *score,
                              char message[200], tn_error *error)
{
    const tn_grower *g = context;
    tn_error own = {0};
    rules compiled;
    tn_status status = grow(g, sentence, size, &compiled, &g->growths[thread], &own);
    if (status == TN_OK) {
        tn_fitness fitness = tn_fitness_measure(g->growths[thread]);
        score_terms(g, &fitness, score);
    }
    rules_clear(&compiled);
    if (status == TN_MEMORY || status == TN_INTERNAL) {
        *error = own;
        return status;
    }
    if (status != TN_OK) {
        score->state = status == TN_LIMIT ? TN_SCORE_LIMIT : TN_SCORE_FAILED;
        snprintf(message, 200, "%.199s", own.message);
    }
    return TN_OK;
}

/* "undulation target 3", "size weight 2", "size target 3 weight 2" */
static tn_status adjust(void *context, const char *change, tn_error *error)
{
    tn_grower *g = context;
    char name[40];
    int read = 0;
    const char *at = change;
    tn_fitness_goal goal = g->study.goal;
    tn_fitness_term term = 0;
    bool well = sscanf(at, "%39s%n", name, &read) == 1;
    while (well && term < TN_FITNESS_TERM_COUNT && strcmp(tn_fitness_term_name(term), name) != 0)
        term++;
    well = well && term < TN_FITNESS_TERM_COUNT && goal.wanted[term];
    for (unsigned parts = 0; well && *(at += read); parts++) {
        char what[16];
        double value;
        if (at[strspn(at, " ")] == '\0')
            break;
        well = sscanf(at, "%15s %lf%n", what, &value, &read) == 2 && isfinite(value);
        if (well && strcmp(what, "target") == 0)
            goal.target[term] = value;
        else if (well && strcmp(what, "weight") == 0 && value >= 0)
            goal.weight[term] = value;
        else
            well = false;
    }
    if (!well) {
        tn_fail(error, TN_INVALID, 1232, "`%.100s` changes nothing that this run has", change);
        tn_error_help(error, "name a term that the growth study wants, as \"undulation target 3 weight 2\"");
        return TN_INVALID;
    }
    g->study.goal = goal;
    return TN_OK;
}

tn_evaluator tn_grower_evaluator(tn_grower *grower)
{
    return (tn_evaluator){grower, grower->separately ? grower->term_count : 1, score_growth, adjust};
}

/* ---- pictures */

tn_status tn_grower_draw(const tn_grower *g, const char *const *sentences, size_t count, const char *title,
                         const char *path, tn_error *error)
{
    tn_canvas_format format;
    tn_view **views = calloc(count + 1, sizeof *views);
    tn_camera camera = tn_camera_default();
    tn_growth *growth = NULL;
    size_t drawn = 0;
    if (count > 1)
        camera.width = 200;
    tn_status status = views ? tn_canvas_format_of(path, &format, error) : tn_fail_memory(error);
    for (size_t i = 0; i < count && status == TN_OK; i++) {
        rules compiled;
        if (grow(g, sentences[i], strlen(sentences[i]), &compiled, &growth, NULL) == TN_OK)
            status = tn_view_take(growth, &camera, &views[drawn++], error);
        rules_clear(&compiled);
    }
    tn_view_options options = {.title = title, .numbered = count > 1};
    if (status == TN_OK && drawn)
        status = tn_views_draw(views, drawn, &options, path, format, error);
    for (size_t i = 0; views && i < drawn; i++)
        tn_view_free(views[i]);
    tn_growth_free(growth);
    free(views);
    return status;
}
