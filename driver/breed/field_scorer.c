/* Scores bred fields: compiles a sentence, meshes its surface, and measures that. */
#include "driver/breed/field_scorer.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "driver/breed/goals.h"
#include "driver/breed/inputs.h"
#include "driver/open/open.h"
#include "runtime/base/crew.h"
#include "runtime/base/file.h"
#include "runtime/field/contour.h"
#include "runtime/field/field.h"
#include "runtime/geometry/boundary_mesh.h"
#include "runtime/geometry/measure.h"
#include "runtime/mesh/openmesh.h"
#include "runtime/scene/draw_mesh.h"

typedef struct tn_target tn_target;

/* ---- counts how much of a field's inside is inside a mesh too */

struct tn_target {
    tn_boundary_mesh *mesh;
    pthread_mutex_t lock;
    tn_field_grid grid; /* that the samples are of */
    uint8_t *inside;    /* [sample]; NULL before the first field */
};

static void target_free(tn_target *t)
{
    if (!t)
        return;
    tn_boundary_mesh_free(t->mesh);
    pthread_mutex_destroy(&t->lock);
    free(t->inside);
    free(t);
}

/* Reads a closed mesh. TN_INVALID (E1248) where it is not closed or cannot be read. */
static tn_status target_read(const char *path, tn_target **target, tn_error *error)
{
    tn_target *t = calloc(1, sizeof *t);
    tn_error why = {0};
    *target = NULL;
    if (!t)
        return tn_fail_memory(error);
    pthread_mutex_init(&t->lock, NULL);
    tn_status status = tn_boundary_mesh_find(&tn_openmesh_reader, "", "", path, "target", "study", &t->mesh, &why);
    if (status == TN_OK && !tn_boundary_mesh_is_solid(t->mesh))
        status = tn_fail(&why, TN_INVALID, E_FIELD_GOAL, "it has edges without two faces, and so no inside");
    if (status == TN_OK) {
        *target = t;
        return TN_OK;
    }
    target_free(t);
    if (status == TN_MEMORY)
        return tn_fail_memory(error);
    tn_fail(error, status, E_FIELD_GOAL, "forms cannot be likened to %.200s: %.250s", path, why.message);
    tn_error_help(error, "name a closed mesh, as `tartan mesh` writes them");
    return status;
}

static size_t sample_count(const tn_field_grid *grid)
{
    return (size_t)grid->count[0] * grid->count[1] * grid->count[2];
}

/* Once: all fields of a run have one grid. */
static tn_status sample_target(tn_target *t, const tn_field_grid *grid, tn_error *error)
{
    uint8_t *inside = malloc(sample_count(grid));
    size_t at = 0;
    if (!inside)
        return tn_fail_memory(error);
    for (uint32_t z = 0; z < grid->count[2]; z++)
        for (uint32_t y = 0; y < grid->count[1]; y++)
            for (uint32_t x = 0; x < grid->count[0]; x++) {
                tn_vector place = {tn_field_sample(grid, 0, x), tn_field_sample(grid, 1, y),
                                   tn_field_sample(grid, 2, z)};
                inside[at++] = tn_boundary_mesh_distance(t->mesh, place, NULL) < 0;
            }
    t->grid = *grid;
    t->inside = inside;
    return TN_OK;
}

/* Counts the samples of a row along x: those in both, and those in either. */
static void count_row(const tn_target *t, tn_field_runner *runner, const uint32_t at[2], size_t *both, size_t *either)
{
    const tn_field_grid *grid = &t->grid;
    const uint8_t *inside = t->inside + ((size_t)at[1] * grid->count[1] + at[0]) * grid->count[0];
    double *const *rows = runner->rows.coordinates;
    for (uint32_t begin = 0; begin < grid->count[0]; begin += TN_ROW) {
        uint32_t size = grid->count[0] - begin < TN_ROW ? grid->count[0] - begin : TN_ROW;
        for (uint32_t i = 0; i < TN_ROW; i++) {
            rows[0][i] = tn_field_sample(grid, 0, begin + (i < size ? i : size - 1));
            rows[1][i] = tn_field_sample(grid, 1, at[0]);
            rows[2][i] = tn_field_sample(grid, 2, at[1]);
        }
        tn_field_prepare(runner);
        const double *values = tn_field_run(runner);
        for (uint32_t i = 0; i < size; i++) {
            bool in = values[i] < 0;
            *both += in && inside[begin + i];
            *either += in || inside[begin + i];
        }
    }
}

/* The volume that the field and the target share, as a share of the volume of both together: 1 where they are the
 * same. Both are counted at the samples of the field's grid. May be called by several threads, of fields with one grid.
 */
static tn_status target_likeness(tn_target *t, const tn_field *field, double *likeness, tn_error *error)
{
    tn_field_grid grid = tn_field_grid_of(field, 0);
    tn_field_runner runner = {0};
    size_t both = 0, either = 0;
    pthread_mutex_lock(&t->lock);
    tn_status status = t->inside ? TN_OK : sample_target(t, &grid, error);
    pthread_mutex_unlock(&t->lock);
    if (status == TN_OK)
        status = tn_field_runner_new(field, &field->samples, false, &runner, error);
    uint32_t at[2];
    for (at[1] = 0; status == TN_OK && at[1] < grid.count[2]; at[1]++)
        for (at[0] = 0; at[0] < grid.count[1]; at[0]++)
            count_row(t, &runner, at, &both, &either);
    tn_field_runner_clear(&runner);
    *likeness = status == TN_OK && either ? (double)both / (double)either : 0;
    return status;
}

/* What goals can speak of. */
typedef enum measure {
    VOLUME,
    AREA,
    PARTS,
    WIDTH,
    DEPTH,
    HEIGHT,
    EULER,
    CENTRE_X,
    CENTRE_Y,
    CENTRE_Z,
    TRIANGLES,
    JUMPS,
    CUT,
    MEASURE_COUNT
} measure;

static const char *const measure_names[MEASURE_COUNT] = {"volume",    "area",  "parts",    "width",    "depth",
                                                         "height",    "euler", "centre-x", "centre-y", "centre-z",
                                                         "triangles", "jumps", "cut"};

struct tn_field_scorer {
    tn_goals goals;
    tn_target *targets[TN_OBJECTIVES_MAX]; /* of likeness */
    double weights[TN_OBJECTIVES_MAX];
    size_t target_count;
    bool separately;
    bool draws_open; /* pictures show surfaces that end at the box */
    tn_form_listener listener;
};

void tn_field_scorer_free(tn_field_scorer *s)
{
    if (!s)
        return;
    tn_goals_clear(&s->goals);
    for (size_t i = 0; i < s->target_count; i++)
        target_free(s->targets[i]);
    free(s);
}

/* ---- goals */

static tn_status read_targets(tn_field_scorer *s, const tn_evolution_study *study, const char *path, char **inputs,
                              uint32_t *blamed, tn_error *error)
{
    tn_status status = TN_OK;
    for (uint32_t i = 0; i < study->each_count && status == TN_OK; i++) {
        if (study->each[i].setting != TN_SET_LIKENESS)
            continue;
        *blamed = i;
        if (s->target_count == TN_OBJECTIVES_MAX)
            return tn_fail(error, TN_INVALID, E_FIELD_GOAL, "a study has at most %u lines `likeness`",
                           TN_OBJECTIVES_MAX);
        char *mesh = tn_file_beside(path, study->each[i].value.text);
        status = mesh ? target_read(mesh, &s->targets[s->target_count], error) : tn_fail_memory(error);
        if (status == TN_OK)
            s->weights[s->target_count++] = study->each[i].value.second;
        if (status == TN_OK)
            status = tn_inputs_add_file(inputs, "likeness", mesh, error);
        free(mesh);
    }
    return status;
}

tn_status tn_field_scorer_new(const tn_evolution_study *study, const char *path, bool separately,
                              tn_field_scorer **scorer, char **inputs, uint32_t *blamed, tn_error *error)
{
    tn_field_scorer *s = calloc(1, sizeof *s);
    *scorer = s;
    if (!s)
        return tn_fail_memory(error);
    tn_status status = tn_goals_read(study, measure_names, MEASURE_COUNT, &s->goals, blamed, error);
    if (status == TN_OK)
        status = read_targets(s, study, path, inputs, blamed, error);
    size_t count = s->goals.count + s->target_count;
    s->separately = separately && count > 1;
    if (status == TN_OK && s->separately && count > TN_OBJECTIVES_MAX) {
        status = tn_fail(error, TN_INVALID, E_FIELD_GOAL, "`selection nsga2` weighs at most %u goals, and here are %zu",
                         TN_OBJECTIVES_MAX, count);
        tn_error_help(error, "put some together in one expression, or choose by the sum: `selection tournament 3`");
    }
    if (status == TN_OK)
        return TN_OK;
    tn_field_scorer_free(s);
    *scorer = NULL;
    return status;
}

void tn_field_scorer_tell(tn_field_scorer *scorer, tn_form_listener listener)
{
    scorer->listener = listener;
}

void tn_field_scorer_draw_open(tn_field_scorer *scorer)
{
    scorer->draws_open = true;
}

bool tn_field_scorer_wants(const tn_field_scorer *scorer)
{
    return scorer->goals.count + scorer->target_count > 0;
}

/* ---- one surface */

typedef struct form {
    tn_opened opened;
    tn_field field;
    tn_contour contour;
} form;

static void form_clear(form *f)
{
    tn_contour_clear(&f->contour);
    tn_field_clear(&f->field);
    tn_close(&f->opened);
}

/* What a form is made for. */
typedef enum purpose { TO_LOOK, TO_SCORE, TO_DRAW, TO_DRAW_OPEN } purpose;

/* Compiles a sentence and meshes its surface (TO_LOOK: only looks whether there is one; to draw: with sharp edges).
 * Clear the form in any case. */
static tn_status make_form(const char *sentence, size_t size, purpose what, form *f, tn_error *error)
{
    *f = (form){0};
    tn_status status =
        tn_open_text(TN_NOTATION(field), &(tn_input){.text = sentence, .size = size, .name = "the sentence"},
                     &(tn_compile_options){0}, &f->opened);
    if (status != TN_OK)
        return tn_open_error(&f->opened, status, error);
    status = tn_field_read(f->opened.module, 0, NULL, &f->field, error);
    if (status != TN_OK)
        return status;
    tn_field_grid grid = tn_field_grid_of(&f->field, 0);
    bool draws = what >= TO_DRAW;
    tn_contour_options options = {.threads = 1,
                                  .survey = what == TO_LOOK,
                                  .sharp = draws,
                                  .open = what == TO_DRAW_OPEN,
                                  .triangles = draws ? 3 * TN_BRED_TRIANGLES : TN_BRED_TRIANGLES};
    status = tn_contour_new(&f->field, &grid, &options, &f->contour, error);
    if (status != TN_OK)
        return status;
    if (!f->contour.inside)
        return tn_fail(error, TN_INVALID, TN_CODE_NONE, "nothing of the box is inside");
    if (!f->contour.outside)
        return tn_fail(error, TN_INVALID, TN_CODE_NONE, "all of the box is inside");
    return TN_OK;
}

static void take_measures(const tn_contour *contour, const tn_mesh_measures *m, double values[MEASURE_COUNT])
{
    values[VOLUME] = m->volume;
    values[AREA] = m->area;
    values[PARTS] = m->parts;
    values[WIDTH] = m->high[0] - m->low[0];
    values[DEPTH] = m->high[1] - m->low[1];
    values[HEIGHT] = m->high[2] - m->low[2];
    values[EULER] = (double)m->euler;
    values[CENTRE_X] = m->centroid[0];
    values[CENTRE_Y] = m->centroid[1];
    values[CENTRE_Z] = m->centroid[2];
    values[TRIANGLES] = (double)contour->mesh.face_count;
    values[JUMPS] = (double)contour->jumps;
    values[CUT] = __builtin_popcount(contour->cut);
}

static void add_part(const tn_field_scorer *s, size_t i, double part, tn_score *score)
{
    score->objectives[s->separately ? i : 0] += part;
}

static tn_status score_form(const tn_field_scorer *s, unsigned thread, const form *f, tn_score *score,
                            char message[200], tn_error *error)
{
    tn_mesh_measures measures;
    double values[MEASURE_COUNT], total = 0;
    size_t i = 0;
    tn_status status = tn_mesh_measure(&f->contour.mesh, 0, &measures, error);
    if (status != TN_OK)
        return status;
    take_measures(&f->contour, &measures, values);
    for (; i < s->goals.count; i++)
        add_part(s, i, tn_goal_part(&s->goals.items[i], values), score);
    for (size_t k = 0; k < s->target_count && status == TN_OK; k++) {
        double likeness = 0;
        status = target_likeness(s->targets[k], &f->field, &likeness, error);
        add_part(s, i++, s->weights[k] * (1 - likeness), score);
    }
    for (size_t k = 0; k < TN_OBJECTIVES_MAX; k++)
        total += score->objectives[k];
    if (!isfinite(total)) {
        score->state = TN_SCORE_FAILED;
        snprintf(message, 200, "a goal has no value for this surface");
    }
    if (status == TN_OK && score->state == TN_SCORED)
        status = tn_form_listener_tell(&s->listener, thread,
                                       &(tn_form_facts){&f->contour.mesh, measure_names, values, MEASURE_COUNT}, error);
    return status;
}

static tn_status score(void *context, unsigned thread, const char *sentence, size_t size, tn_score *score,
                       char message[200], tn_error *error)
{
    const tn_field_scorer *s = context;
    bool survey = !tn_field_scorer_wants(s) && !s->listener.hear; /* bred by hand: without a surface it is not shown */
    form f;
    tn_error own = {0};
    tn_status status = make_form(sentence, size, survey ? TO_LOOK : TO_SCORE, &f, &own);
    if (status == TN_OK && !survey)
        status = score_form(s, thread, &f, score, message, &own);
    form_clear(&f);
    return status == TN_OK ? TN_OK : tn_score_refuse(status, &own, score, message, error);
}

/* "volume target 3 weight 2" */
static tn_status adjust(void *context, const char *change, tn_error *error)
{
    tn_field_scorer *s = context;
    if (tn_goals_adjust(&s->goals, change))
        return TN_OK;
    tn_fail(error, TN_INVALID, E_EVOLUTION_VALUE, "`%.100s` changes nothing that this run has", change);
    if (s->goals.count)
        tn_error_help(error, "name a goal as the study writes it: \"%.60s target 3 weight 2\"", s->goals.items[0].text);
    else
        tn_error_help(error, "the study has no lines `fitness`");
    return TN_INVALID;
}

tn_evaluator tn_field_scorer_evaluator(tn_field_scorer *s)
{
    return (tn_evaluator){.context = s,
                          .objectives = s->separately ? s->goals.count + s->target_count : 1,
                          .evaluate = score,
                          .adjust = adjust};
}

const char *tn_field_scorer_objective(const void *scorer, size_t i)
{
    const tn_field_scorer *s = scorer;
    return i < s->goals.count ? s->goals.items[i].text : "likeness";
}

/* ---- pictures */

static purpose drawing(const tn_field_scorer *s)
{
    return s->draws_open ? TO_DRAW_OPEN : TO_DRAW;
}

typedef struct forms {
    const tn_field_scorer *scorer;
    const char *const *sentences;
    form *items;
    double **normals;
} forms;

static tn_status make_one(void *context, unsigned thread, size_t item, tn_error *error)
{
    (void)thread;
    forms *f = context;
    form *made = &f->items[item];
    tn_status status = make_form(f->sentences[item], strlen(f->sentences[item]), drawing(f->scorer), made, error);
    if (status != TN_OK)
        return status;
    return tn_field_normals(&made->field, &made->contour.mesh, made->contour.spacing, &f->normals[item], error);
}

tn_status tn_field_scorer_draw(const void *scorer, const char *const *sentences, const char *const *labels,
                               size_t count, const char *title, tn_picture *to, tn_error *error)
{
    const tn_field_scorer *s = scorer;
    forms f = {s, sentences, calloc(count + 1, sizeof *f.items), calloc(count + 1, sizeof *f.normals)};
    const tn_mesh **meshes = calloc(count + 1, sizeof *meshes);
    tn_crew *crew = tn_crew_new(0, NULL);
    tn_status status = f.items && f.normals && meshes && crew ? TN_OK : tn_fail_memory(error);
    if (status == TN_OK)
        status = tn_crew_run(crew, count, 1, make_one, &f, error);
    for (size_t i = 0; i < count && status == TN_OK; i++)
        meshes[i] = &f.items[i].contour.mesh;
    const tn_meshes_picture picture = {.title = title, .labels = labels, .normals = f.normals, .open = s->draws_open};
    if (status == TN_OK)
        status = tn_meshes_draw(meshes, count, &picture, to, error);
    for (size_t i = 0; f.items && i < count; i++)
        form_clear(&f.items[i]);
    if (crew)
        tn_crew_free(crew);
    for (size_t i = 0; f.normals && i < count; i++)
        free(f.normals[i]);
    free(f.items);
    free(f.normals);
    free(meshes);
    return status;
}

tn_status tn_field_scorer_mesh(const void *scorer, const char *sentence, tn_mesh *mesh, tn_guides *guides,
                               tn_error *error)
{
    form f;
    (void)guides;
    *mesh = (tn_mesh){0};
    tn_status status = make_form(sentence, strlen(sentence), drawing(scorer), &f, error);
    if (status == TN_OK)
        status = tn_mesh_copy(&f.contour.mesh, mesh, error);
    form_clear(&f);
    return status;
}
