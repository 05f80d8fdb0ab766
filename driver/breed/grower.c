/* Scores bred rewrite systems by the surfaces that they grow. */
#include "driver/breed/grower.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "driver/breed/change.h"
#include "driver/breed/goals.h"
#include "driver/breed/inputs.h"
#include "runtime/growth/environment/environment.h"
#include "runtime/growth/growth.h"
#include "runtime/growth/picture/draw.h"
#include "runtime/growth/soundness.h"
#include "runtime/growth/study.h"
#include "runtime/growth/surface.h"
#include "runtime/mesh/openmesh.h"
#include "runtime/number/run.h"

struct tn_grower {
    char *path;       /* of the study */
    tn_opened opened; /* of the study */
    tn_study study;
    bool separately, may_want_nothing;
    tn_form_listener listener;
    uint32_t goals[TN_FITNESS_TERM_COUNT + TN_EXPRESSIONS_MAX]; /* that are wanted: terms, then named expressions */
    size_t goal_count;
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
    free(g->path);
    tn_study_clear(&g->study);
    tn_close(&g->opened);
    free(g);
}

static tn_status open_study(tn_grower *g, const char *path, tn_error *error)
{
    if (tn_open(path, false, &g->opened) != TN_OK) {
        return tn_fail(error, TN_INVALID, E_GROWTH_STUDY, "the growth study %.100s cannot be used: %.300s", path,
                       tn_first_error(&g->opened));
    }
    tn_status status = tn_study_read(g->opened.module, path, &tn_openmesh_reader, &g->study, error);
    for (uint32_t goal = 0; status == TN_OK && goal < TN_FITNESS_TERM_COUNT + g->study.goal.named_count; goal++)
        if (goal >= TN_FITNESS_TERM_COUNT || g->study.goal.wanted[goal])
            g->goals[g->goal_count++] = goal;
    if (status == TN_OK && g->separately && g->goal_count > TN_OBJECTIVES_MAX) {
        status = tn_fail(error, TN_LIMIT, E_GROWTH_STUDY,
                         "the growth study %.200s has %zu goals; `selection nsga2` takes at most %u", path,
                         g->goal_count, TN_OBJECTIVES_MAX);
        tn_error_help(error, "put some together in one expression, or choose by the sum: `selection tournament 3`");
    }
    if (status == TN_OK && g->goal_count == 0 && !g->may_want_nothing) {
        status = tn_fail(error, TN_INVALID, E_GROWTH_STUDY, "the growth study %.200s has no goals for a surface", path);
        tn_error_help(error, "add lines such as `fitness undulation target 2 weight 1`");
    }
    g->study.options.threads = 1;
    if (g->study.options.edge_limit == 0)
        g->study.options.edge_limit = TN_GROWER_EDGES;
    return status;
}

tn_status tn_grower_new(const char *study, bool separately, bool may_want_nothing, unsigned threads, tn_grower **grower,
                        tn_error *error)
{
    tn_grower *g = calloc(1, sizeof *g);
    *grower = g;
    if (!g)
        return tn_fail_memory(error);
    g->separately = separately;
    g->may_want_nothing = may_want_nothing;
    g->threads = threads;
    g->growths = calloc(threads, sizeof(tn_growth *));
    g->path = strdup(study);
    tn_status status = g->growths && g->path ? open_study(g, study, error) : tn_fail_memory(error);
    if (status != TN_OK) {
        tn_grower_free(g);
        *grower = NULL;
    }
    return status;
}

void tn_grower_tell(tn_grower *grower, tn_form_listener listener)
{
    grower->listener = listener;
}

bool tn_grower_wants(const tn_grower *grower)
{
    return grower->goal_count || grower->study.goal.required_count;
}

const char *tn_grower_open_mesh(const tn_grower *g)
{
    uint32_t i = tn_study_open_boundary(&g->study, 0);
    return i < g->opened.module->BOUNDARY_count ? tn_text(g->opened.module, g->opened.module->BOUNDARY_records[i].mesh)
                                                : NULL;
}

tn_status tn_grower_inputs(const tn_grower *g, char **inputs, tn_error *error)
{
    tn_status status = tn_inputs_add_sources(inputs, "grow", g->opened.module, UINT32_MAX, error);
    uint64_t meshes = tn_study_meshes_hash(&g->study), version = TN_GROWTH_VERSION;
    if (status == TN_OK)
        status = tn_inputs_add(inputs, "grow", "how surfaces grow", &version, sizeof version, error);
    if (status == TN_OK && meshes)
        status = tn_inputs_add(inputs, "grow", "its boundary meshes", &meshes, sizeof meshes, error);
    if (status != TN_OK || !g->study.target)
        return status;
    uint64_t target = tn_boundary_mesh_hash(g->study.target, 0);
    return tn_inputs_add(inputs, "grow", "its target mesh", &target, sizeof target, error);
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
    tn_status status =
        tn_open_text(TN_NOTATION(hemls), &(tn_input){.text = sentence, .size = size, .name = "the sentence"},
                     &(tn_compile_options){0}, &r->opened);
    if (status != TN_OK)
        return tn_open_error(&r->opened, status, error);
    status = tn_growth_system_read(r->opened.module, &r->system, error);
    if (status == TN_OK)
        status = *growth ? tn_growth_renew(*growth, r->system, &study->environment, &study->options, error)
                         : tn_growth_new(r->system, &study->environment, &study->options, growth, error);
    for (uint32_t step = 0; status == TN_OK && step < study->steps && !tn_growth_at_rest(*growth); step++)
        status = tn_growth_step(*growth, error);
    return status;
}

static const char *name_of(const tn_grower *g, uint32_t goal)
{
    return goal < TN_FITNESS_TERM_COUNT ? tn_names_MEASURED[goal]
                                        : g->study.goal.named[goal - TN_FITNESS_TERM_COUNT].name;
}

/* An expression may have no value for a surface: a division by its undulation, where it is flat. */
static void score_goals(const tn_grower *g, const tn_fitness *fitness, tn_score *score, char message[200])
{
    double side = g->study.options.start_length, lacking = tn_fitness_lacking(fitness, &g->study.goal),
           total = g->study.goal.requirement_weight * lacking;
    if (!isfinite(lacking)) {
        score->state = TN_SCORE_FAILED;
        snprintf(message, 200, "a requirement has no value for this surface");
        return;
    }
    for (size_t i = 0; i < g->goal_count; i++) {
        double part = tn_fitness_part(fitness, &g->study.goal, g->goals[i], side);
        if (!isfinite(part)) {
            score->state = TN_SCORE_FAILED;
            snprintf(message, 200, "the fitness term `%.100s` has no value for this surface", name_of(g, g->goals[i]));
            return;
        }
        total += part;
        if (g->separately)
            score->objectives[i] = part;
    }
    if (g->separately)
        score->violation = lacking;
    else
        score->objectives[0] = total;
}

static tn_status tell(const tn_grower *g, unsigned thread, const tn_fitness *fitness, tn_error *error)
{
    double values[TN_MEASURED_COUNT];
    tn_mesh mesh = {0};
    if (!g->listener.hear)
        return TN_OK;
    tn_fitness_terms(fitness, values);
    for (unsigned i = TN_MEASURED_WIDTH; i < TN_MEASURED_COUNT; i++)
        values[i] = g->study.goal.asked >> i & 1 ? values[i] : NAN;
    tn_status status = tn_surface_mesh(g->growths[thread], &(tn_surface_options){0}, &mesh, error);
    if (status == TN_OK)
        status = tn_form_listener_tell(&g->listener, thread,
                                       &(tn_form_facts){&mesh, tn_names_MEASURED, values, TN_MEASURED_COUNT}, error);
    tn_mesh_clear(&mesh);
    return status;
}

/* Grows a sentence and measures what the study speaks of. */
static tn_status measure(const tn_grower *g, const char *sentence, size_t size, tn_growth **growth, tn_fitness *fitness,
                         tn_error *error)
{
    rules compiled;
    tn_status status = grow(g, sentence, size, &compiled, growth, error);
    if (status == TN_OK) {
        *fitness = tn_fitness_measure(*growth);
        status = tn_soundness_measure(*growth, &g->study.measuring, g->study.goal.asked, fitness, error);
    }
    rules_clear(&compiled);
    return status;
}

static tn_status score_growth(void *context, unsigned thread, const char *sentence, size_t size, tn_score *score,
                              char message[200], tn_error *error)
{
    const tn_grower *g = context;
    tn_error own = {0};
    tn_fitness fitness;
    tn_status status = measure(g, sentence, size, &g->growths[thread], &fitness, &own);
    if (status == TN_OK)
        score_goals(g, &fitness, score, message);
    if (status == TN_OK && score->state == TN_SCORED)
        status = tell(g, thread, &fitness, &own);
    return status == TN_OK ? TN_OK : tn_score_refuse(status, &own, score, message, error);
}

static bool find_goal(const tn_grower *g, const char *name, uint32_t *goal)
{
    for (size_t i = 0; i < g->goal_count; i++) {
        *goal = g->goals[i];
        if (strcasecmp(name_of(g, *goal), name) == 0)
            return true;
    }
    return false;
}

bool tn_wish_read(const char *text, double *target, double *weight)
{
    while (text[strspn(text, " ")]) {
        char what[16];
        double value;
        int read;
        if (sscanf(text, "%15s %lf%n", what, &value, &read) != 2 || !(fabs(value) <= TN_COORDINATE_MAX))
            return false;
        if (strcasecmp(what, "target") == 0)
            *target = value;
        else if (strcasecmp(what, "weight") == 0 && value >= 0)
            *weight = value;
        else
            return false;
        text += read;
    }
    return true;
}

/* "undulation target 3", "size weight 2", "size target 3 weight 2" */
static tn_status adjust(void *context, const char *change, tn_error *error)
{
    tn_grower *g = context;
    if (tn_change_surrounds(change))
        return tn_change_surroundings(change, g->path, g->opened.module, &g->study, error);
    char name[TN_NAME_MAX + 1];
    size_t length = strcspn(change, " ");
    uint32_t goal = 0;
    tn_fitness_goal *wants = &g->study.goal;
    snprintf(name, sizeof name, "%.*s", (int)(length < sizeof name ? length : 0), change);
    bool found = find_goal(g, name, &goal), is_term = goal < TN_FITNESS_TERM_COUNT;
    tn_named_goal *named = found && !is_term ? &wants->named[goal - TN_FITNESS_TERM_COUNT] : NULL;
    double target = !found    ? 0
                    : is_term ? wants->target[goal]
                              : named->target,
           weight = !found    ? 0
                    : is_term ? wants->weight[goal]
                              : named->weight;
    if (g->goal_count == 0) {
        tn_fail(error, TN_INVALID, E_EVOLUTION_VALUE, "`%.100s` changes nothing that this run has", change);
        tn_error_help(error, "the growth study has no goals; what surfaces grow in can be changed");
        return TN_INVALID;
    }
    if (!found || !change[length] || !tn_wish_read(change + length, &target, &weight)) {
        tn_fail(error, TN_INVALID, E_EVOLUTION_VALUE, "`%.100s` changes nothing that this run has", change);
        tn_error_help(error, "name a term that is a goal of the growth study, as \"%.60s target 3 weight 2\"",
                      name_of(g, g->goals[0]));
        return TN_INVALID;
    }
    *(is_term ? &wants->target[goal] : &named->target) = target;
    *(is_term ? &wants->weight[goal] : &named->weight) = weight;
    return TN_OK;
}

tn_evaluator tn_grower_evaluator(tn_grower *grower)
{
    return (tn_evaluator){.context = grower,
                          .objectives = grower->separately && grower->goal_count ? grower->goal_count : 1,
                          .evaluate = score_growth,
                          .adjust = adjust};
}

const char *tn_grower_objective(const void *grower, size_t i)
{
    const tn_grower *g = grower;
    return name_of(g, g->goals[i]);
}

tn_status tn_grower_unmet(const void *grower, const char *sentence, char **text, tn_error *error)
{
    const tn_grower *g = grower;
    const tn_module *module = g->opened.module;
    double values[TN_MEASURED_COUNT];
    tn_growth *growth = NULL;
    tn_fitness fitness;
    size_t size;
    *text = NULL;
    tn_status status = measure(g, sentence, strlen(sentence), &growth, &fitness, error);
    FILE *out = status == TN_OK ? open_memstream(text, &size) : NULL;
    if (out) {
        tn_fitness_terms(&fitness, values);
        const tn_unmet_found found = {module, tn_names_MEASURED, TN_MEASURED_COUNT, values};
        for (size_t i = 0; i < module->GROWTH_REQUIREMENT_count; i++) {
            const tn_growth_requirement_record *r = &module->GROWTH_REQUIREMENT_records[i];
            tn_unmet_write(out, &found, &(tn_unmet_requirement){r->violation, r->file, r->begin, r->end});
        }
    }
    if (status == TN_OK && (!out || fclose(out) != 0))
        status = tn_fail_memory(error);
    tn_growth_free(growth);
    return status;
}

/* ---- pictures */

tn_status tn_grower_draw(const void *grower, const char *const *sentences, const char *const *labels, size_t count,
                         const char *title, tn_picture *to, tn_error *error)
{
    const tn_grower *g = grower;
    tn_canvas_format format;
    tn_view **views = calloc(count + 1, sizeof *views);
    tn_camera camera = tn_camera_default();
    tn_growth *growth = NULL;
    size_t drawn = 0;
    bool surrounded = g->study.environment.force_count > 0 || g->study.environment.boundary_count > 0;
    if (count > 1)
        camera.width = 200;
    tn_status status = views ? tn_picture_format(to, &format, error) : tn_fail_memory(error);
    for (size_t i = 0; i < count && status == TN_OK; i++) {
        rules compiled;
        status = grow(g, sentences[i], strlen(sentences[i]), &compiled, &growth, error);
        if (status == TN_OK)
            status = tn_growth_view(growth, &camera, surrounded, &views[drawn++], error);
        rules_clear(&compiled);
    }
    tn_view_options options = {.title = title, .labels = labels, .fades = true};
    if (status == TN_OK && drawn)
        status = tn_views_draw(views, drawn, &options, to, error);
    for (size_t i = 0; views && i < drawn; i++)
        tn_view_free(views[i]);
    tn_growth_free(growth);
    free(views);
    return status;
}

/* ---- meshes */

static tn_status surround(const tn_grower *g, const tn_mesh *mesh, tn_guides *guides, tn_error *error)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < 3 * mesh->vertex_count; i++) {
        low[i % 3] = fmin(low[i % 3], mesh->positions[i]);
        high[i % 3] = fmax(high[i % 3], mesh->positions[i]);
    }
    return tn_surroundings_guides(&g->study.environment, low, high, guides, error);
}

tn_status tn_grower_mesh(const void *grower, const char *sentence, tn_mesh *mesh, tn_guides *guides, tn_error *error)
{
    const tn_grower *g = grower;
    tn_growth *growth = NULL;
    rules compiled;
    *mesh = (tn_mesh){0};
    tn_status status = grow(g, sentence, strlen(sentence), &compiled, &growth, error);
    if (status == TN_OK)
        status = tn_surface_mesh(growth, &(tn_surface_options){.lines = true}, mesh, error);
    if (status == TN_OK)
        status = surround(g, mesh, guides, error);
    tn_growth_free(growth);
    rules_clear(&compiled);
    return status;
}
