/* Scores bred designs of boxes: compiles a sentence, builds its design, and measures what the goals speak of. */
#include "driver/breed/builder.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "driver/breed/goals.h"
#include "driver/breed/inputs.h"
#include "driver/solid/solid.h"
#include "runtime/geometry/union/union.h"
#include "runtime/number/run.h"
#include "runtime/solid/design.h"

#define BATCH 32u /* designs that a thread scores at once */

typedef struct wish {
    const char *name; /* of the module */
    uint32_t function;
    double target, weight;
} wish;

struct tn_design_scorer {
    tn_opened opened; /* of the goals */
    const tn_solid_record *record;
    wish *wishes; /* owned */
    size_t wish_count;
    tn_goals more;  /* of the study */
    uint64_t asked; /* measures that goals and requirements speak of */
    bool separately, may_want_nothing;
    tn_form_listener listener;
    const tn_box_breeding *breeding; /* of genomes that are lists of boxes, or NULL */
    tn_design skeleton;              /* the rigid boxes, then */
};

void tn_design_scorer_free(tn_design_scorer *s)
{
    if (!s)
        return;
    free(s->wishes);
    tn_goals_clear(&s->more);
    tn_design_clear(&s->skeleton);
    tn_close(&s->opened);
    free(s);
}

/* ---- goals */

static tn_status refuse(tn_error *error, const char *goals, const char *why, const char *help)
{
    tn_fail(error, TN_INVALID, E_DESIGN_GOALS, "the design %.200s cannot be used to score others: %.300s", goals, why);
    if (help)
        tn_error_help(error, "%s", help);
    return TN_INVALID;
}

static tn_status take_goals(tn_design_scorer *s, tn_error *error)
{
    const tn_module *module = s->opened.module;
    s->wishes = calloc(s->record->goal_count + 1u, sizeof *s->wishes);
    if (!s->wishes)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < s->record->goal_count; i++) {
        const tn_solid_goal_record *goal = &module->SOLID_GOAL_records[s->record->goal_first + i];
        s->wishes[s->wish_count++] = (wish){tn_text(module, goal->name), goal->function, goal->target, goal->weight};
        s->asked |= tn_number_asked(module, goal->function);
    }
    for (uint32_t i = 0; i < s->record->requirement_count; i++)
        s->asked |= tn_number_asked(module, module->REQUIREMENT_records[s->record->requirement_first + i].violation);
    return TN_OK;
}

static tn_status open_goals(tn_design_scorer *s, const char *goals, tn_error *error)
{
    uint32_t solid;
    if (tn_open(goals, false, &s->opened) != TN_OK)
        return refuse(error, goals, tn_first_error(&s->opened), NULL);
    if (tn_solid_choose(&s->opened, NULL, &solid) != TN_OK)
        return refuse(error, goals, "it has no design, or more than one",
                      "write a file with one design, and its `fitness` lines");
    s->record = &s->opened.module->SOLID_records[solid];
    if (s->record->goal_count == 0 && !s->may_want_nothing)
        return refuse(error, goals, "it wants nothing", "add lines such as `fitness lightness = mass target 0;`");
    if (s->separately && s->record->goal_count > TN_OBJECTIVES_MAX)
        return refuse(error, goals, "it has more goals than `selection nsga2` weighs, which is 8",
                      "put some together in one expression, or choose by the sum: `selection tournament 3`");
    return take_goals(s, error);
}

tn_status tn_design_scorer_new(const char *goals, bool separately, bool may_want_nothing, tn_design_scorer **scorer,
                               tn_error *error)
{
    tn_design_scorer *s = calloc(1, sizeof *s);
    *scorer = NULL;
    if (!s)
        return tn_fail_memory(error);
    s->separately = separately;
    s->may_want_nothing = may_want_nothing;
    tn_status status = open_goals(s, goals, error);
    if (status == TN_OK)
        *scorer = s;
    else
        tn_design_scorer_free(s);
    return status;
}

tn_status tn_design_scorer_add(tn_design_scorer *s, const tn_evolution_study *study, uint32_t *blamed, tn_error *error)
{
    tn_status status = tn_goals_read(study, tn_solid_measured_names, TN_SOLID_MEASURED_COUNT, &s->more, blamed, error);
    if (status != TN_OK)
        return status;
    size_t count = s->wish_count + s->more.count;
    s->asked |= tn_goals_ask(&s->more);
    s->separately = s->separately && count > 1;
    if (!s->separately || count <= TN_OBJECTIVES_MAX)
        return TN_OK;
    tn_fail(error, TN_INVALID, E_FIELD_GOAL, "`selection nsga2` weighs at most %u goals, and here are %zu",
            TN_OBJECTIVES_MAX, count);
    tn_error_help(error, "put some together in one expression, or choose by the sum: `selection tournament 3`");
    return TN_INVALID;
}

tn_status tn_design_scorer_take_genes(tn_design_scorer *s, const tn_box_breeding *breeding, tn_error *error)
{
    uint32_t rigid = 0;
    tn_status status =
        tn_design_read(s->opened.module, (uint32_t)(s->record - s->opened.module->SOLID_records), &s->skeleton, error);
    for (uint32_t i = 0; status == TN_OK && i < s->skeleton.box_count; i++)
        if (s->skeleton.boxes[i].rigid)
            s->skeleton.boxes[rigid++] = s->skeleton.boxes[i];
    s->skeleton.box_count = rigid;
    s->skeleton.unit = (tn_face_unit){0}; /* genes are decimals, and a bred design has no `unit` (skeleton.c) */
    s->breeding = breeding;
    return status;
}

void tn_design_scorer_tell(tn_design_scorer *scorer, tn_form_listener listener)
{
    scorer->listener = listener;
}

bool tn_design_scorer_wants(const tn_design_scorer *s)
{
    return s->wish_count || s->more.count || s->record->requirement_count;
}

tn_status tn_design_scorer_inputs(const tn_design_scorer *s, char **inputs, tn_error *error)
{
    return tn_inputs_add_sources(inputs, "build", s->opened.module, UINT32_MAX, error);
}

/* ---- one design */

/* Compiles a sentence and builds its design. Close and clear both in any case. */
static tn_status build(const char *sentence, size_t size, tn_opened *opened, tn_built *built, tn_error *error)
{
    uint32_t solid;
    *built = (tn_built){0};
    tn_status status =
        tn_open_text(TN_NOTATION(solid), &(tn_input){.text = sentence, .size = size, .name = "the sentence"},
                     &(tn_compile_options){0}, opened);
    if (status == TN_OK)
        status = tn_solid_choose(opened, NULL, &solid);
    if (status != TN_OK)
        return tn_open_error(opened, status, error);
    return tn_built_make(opened->module, solid, TN_BRED_BOXES, built, error);
}

static double value_of(const tn_design_scorer *s, uint32_t function, const double *values)
{
    const tn_module *module = s->opened.module;
    return tn_number_run(module->code, module->FUNCTION_records[function].code_begin, values);
}

/* How far the requirements are from holding, together; not finite where one has no value. */
static double lacking(const tn_design_scorer *s, const double *values)
{
    const tn_module *module = s->opened.module;
    double sum = 0;
    for (uint32_t i = 0; i < s->record->requirement_count; i++)
        sum += value_of(s, module->REQUIREMENT_records[s->record->requirement_first + i].violation, values);
    return sum;
}

/* Distances are shares of their targets, as those of grown surfaces are. */
static void score_goals(const tn_design_scorer *s, const double *values, tn_score *score, char message[200])
{
    double lacks = lacking(s, values), total = TN_REQUIREMENT_WEIGHT * lacks;
    for (size_t i = 0; i < s->wish_count; i++) {
        const wish *w = &s->wishes[i];
        double part = tn_goal_share(value_of(s, w->function, values), w->target, w->weight);
        total += part;
        if (s->separately)
            score->objectives[i] = part;
    }
    for (size_t i = 0; i < s->more.count; i++) {
        double part = tn_goal_part(&s->more.items[i], values);
        total += part;
        if (s->separately)
            score->objectives[s->wish_count + i] = part;
    }
    if (s->separately)
        score->violation = lacks;
    else
        score->objectives[0] = total;
    if (isfinite(total))
        return;
    score->state = TN_SCORE_FAILED;
    snprintf(message, 200, "a goal or requirement has no value for this design");
}

/* z is up in meshes. */
static tn_status tell(const tn_design_scorer *s, unsigned thread, const tn_built *built, double *values,
                      tn_error *error)
{
    tn_mesh mesh = {0};
    if (!s->listener.hear)
        return TN_OK;
    for (unsigned i = 0; i < TN_SOLID_MEASURED_COUNT; i++)
        values[i] = s->asked >> i & 1 ? values[i] : NAN;
    tn_status status = tn_union_cells(built->cells, built->cell_count, &mesh, error);
    if (status == TN_OK) {
        tn_solid_turn_up(&mesh);
        status = tn_form_listener_tell(
            &s->listener, thread, &(tn_form_facts){&mesh, tn_solid_measured_names, values, TN_SOLID_MEASURED_COUNT},
            error);
    }
    tn_mesh_clear(&mesh);
    return status;
}

/* Measures what is built, and scores it. */
static tn_status score_built(const tn_design_scorer *s, unsigned thread, const tn_built *built, tn_score *score,
                             char message[200], tn_error *error)
{
    double values[TN_SOLID_MEASURED_COUNT] = {0};
    tn_status status = tn_built_measure(built, s->asked, values, error);
    if (status == TN_OK)
        score_goals(s, values, score, message);
    return status == TN_OK && score->state == TN_SCORED ? tell(s, thread, built, values, error) : status;
}

static tn_status score_design(void *context, unsigned thread, const char *sentence, size_t size, tn_score *score,
                              char message[200], tn_error *error)
{
    const tn_design_scorer *s = context;
    tn_error own = {0};
    tn_opened opened = {0};
    tn_built built;
    tn_status status = build(sentence, size, &opened, &built, &own);
    if (status == TN_OK)
        status = score_built(s, thread, &built, score, message, &own);
    tn_built_clear(&built);
    tn_close(&opened);
    return status == TN_OK ? TN_OK : tn_score_refuse(status, &own, score, message, error);
}

/* ---- genes */

/* Builds the design of a genome: the rigid boxes, then its own. */
static tn_status build_genes(const tn_design_scorer *s, const tn_genome *genome, tn_design *written, tn_built *built,
                             tn_error *error)
{
    uint32_t rigid = s->skeleton.box_count, own = (uint32_t)(genome->count / TN_BOX_GENES);
    tn_design counted = {.flags = s->skeleton.flags};
    if ((uint64_t)(rigid + own) * tn_design_images(&counted) > TN_BRED_BOXES)
        return tn_fail(error, TN_LIMIT, TN_CODE_NONE, "it has more than %u boxes, images counted", TN_BRED_BOXES);
    *written = (tn_design){.box_count = rigid + own, .flags = s->skeleton.flags};
    written->boxes = malloc((rigid + own + 1u) * sizeof *written->boxes);
    if (!written->boxes)
        return tn_fail_memory(error);
    if (rigid)
        memcpy(written->boxes, s->skeleton.boxes, rigid * sizeof *written->boxes);
    for (uint32_t i = 0; i < own; i++) {
        double genes[TN_BOX_GENES];
        memcpy(genes, genome->codons + i * TN_BOX_GENES, sizeof genes);
        tn_box_of_genes(genes, s->breeding->flags, s->breeding->depth, &written->boxes[rigid + i]);
    }
    return tn_built_make_of(written, built, error);
}

static tn_status score_genes(const tn_design_scorer *s, unsigned thread, tn_individual *individual, tn_error *error)
{
    tn_design written = {0};
    tn_built built = {0};
    tn_error own = {0};
    tn_status status = build_genes(s, &individual->genome, &written, &built, &own);
    if (status == TN_OK)
        status = score_built(s, thread, &built, &individual->score, individual->message, &own);
    tn_built_clear(&built);
    tn_design_clear(&written);
    return status == TN_OK ? TN_OK : tn_score_refuse(status, &own, &individual->score, individual->message, error);
}

static tn_status score_many(void *context, unsigned thread, struct tn_individual *const *individuals, size_t count,
                            tn_error *error)
{
    tn_status status = TN_OK;
    for (size_t i = 0; i < count && status == TN_OK; i++)
        status = score_genes(context, thread, individuals[i], error);
    return status;
}

/* "lightness target 3 weight 2" */
static tn_status adjust(void *context, const char *change, tn_error *error)
{
    tn_design_scorer *s = context;
    size_t length = strcspn(change, " ");
    for (size_t i = 0; i < s->wish_count; i++) {
        wish *w = &s->wishes[i];
        double target = w->target, weight = w->weight;
        if (strncasecmp(w->name, change, length) != 0 || w->name[length] || !change[length] ||
            !tn_wish_read(change + length, &target, &weight))
            continue;
        w->target = target;
        w->weight = weight;
        return TN_OK;
    }
    if (tn_goals_adjust(&s->more, change))
        return TN_OK;
    tn_fail(error, TN_INVALID, E_EVOLUTION_VALUE, "`%.100s` changes nothing that this run has", change);
    tn_error_help(error, "name a goal of the design, as \"%.60s target 3 weight 2\"",
                  s->wish_count ? s->wishes[0].name : "volume");
    return TN_INVALID;
}

tn_evaluator tn_design_scorer_evaluator(tn_design_scorer *s)
{
    return (tn_evaluator){.context = s,
                          .objectives = s->separately ? s->wish_count + s->more.count : 1,
                          .evaluate = score_design,
                          .adjust = adjust,
                          .evaluate_many = s->breeding ? score_many : NULL,
                          .batch = BATCH};
}

const char *tn_design_scorer_objective(const void *scorer, size_t i)
{
    const tn_design_scorer *s = scorer;
    return i < s->wish_count ? s->wishes[i].name : s->more.items[i - s->wish_count].text;
}

tn_status tn_design_scorer_unmet(const void *scorer, const char *sentence, char **text, tn_error *error)
{
    const tn_design_scorer *s = scorer;
    const tn_module *module = s->opened.module;
    double values[TN_SOLID_MEASURED_COUNT] = {0};
    tn_opened opened = {0};
    tn_built built;
    size_t size;
    *text = NULL;
    tn_status status = build(sentence, strlen(sentence), &opened, &built, error);
    if (status == TN_OK)
        status = tn_built_measure(&built, s->asked, values, error);
    FILE *out = status == TN_OK ? open_memstream(text, &size) : NULL;
    const tn_unmet_found found = {module, tn_solid_measured_names, TN_SOLID_MEASURED_COUNT, values};
    for (uint32_t i = 0; out && i < s->record->requirement_count; i++) {
        const tn_requirement_record *r = &module->REQUIREMENT_records[s->record->requirement_first + i];
        tn_unmet_write(out, &found, &(tn_unmet_requirement){r->violation, r->file, r->begin, r->end});
    }
    if (status == TN_OK && (!out || fclose(out) != 0))
        status = tn_fail_memory(error);
    tn_built_clear(&built);
    tn_close(&opened);
    return status;
}

/* ---- pictures */

tn_status tn_design_scorer_draw(const void *scorer, const char *const *sentences, const char *const *labels,
                                size_t count, const char *title, tn_picture *to, tn_error *error)
{
    (void)scorer;
    tn_view **views = calloc(count + 1, sizeof *views);
    tn_camera camera = tn_camera_default();
    size_t drawn = 0;
    if (count > 1)
        camera.width = 200;
    tn_status status = views ? TN_OK : tn_fail_memory(error);
    for (size_t i = 0; i < count && status == TN_OK; i++) {
        tn_opened opened = {0};
        tn_built built;
        status = build(sentences[i], strlen(sentences[i]), &opened, &built, error);
        if (status == TN_OK)
            status = tn_built_view(&built, &camera, &views[drawn++], error);
        tn_built_clear(&built);
        tn_close(&opened);
    }
    const tn_view_options options = {.title = title, .labels = labels};
    if (status == TN_OK && drawn)
        status = tn_views_draw(views, drawn, &options, to, error);
    for (size_t i = 0; views && i < drawn; i++)
        tn_view_free(views[i]);
    free(views);
    return status;
}

tn_status tn_design_scorer_mesh(const void *scorer, const char *sentence, tn_mesh *mesh, tn_guides *guides,
                                tn_error *error)
{
    tn_opened opened = {0};
    tn_built built;
    tn_union u = {0};
    (void)scorer, (void)guides;
    *mesh = (tn_mesh){0};
    tn_status status = build(sentence, strlen(sentence), &opened, &built, error);
    if (status == TN_OK)
        status = tn_union_make(built.cells, built.cell_count, &u, error);
    if (status == TN_OK)
        status = tn_mesh_copy(&u.mesh, mesh, error);
    if (status == TN_OK)
        tn_solid_turn_up(mesh);
    tn_union_clear(&u);
    tn_built_clear(&built);
    tn_close(&opened);
    return status;
}
