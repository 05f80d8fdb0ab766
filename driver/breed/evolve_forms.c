/* Puts a run of fields or of designs of boxes together from a study: what is bred, how it is varied, and goals. */
#include "driver/breed/evolve_forms.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/file.h"

static tn_tree_variation tree_variation(const tn_evolution_study *s)
{
    return (tn_tree_variation){.order = (tn_pick_order)s->of[TN_SET_CHOICE].choice,
                               .maxprob = s->of[TN_SET_MAXPROB].first,
                               .mutation_rate = s->of[TN_SET_MUTATION_RATE].first,
                               .shares = {s->of[TN_SET_SWAP_NODES].first, s->of[TN_SET_SWAP_SUBTREES].first,
                                          s->of[TN_SET_DESTROY].first, s->of[TN_SET_NUDGE].first},
                               .max_nodes = (uint32_t)s->of[TN_SET_MAX_NODES].first};
}

/* The parents as text: from the run, or else from their files. */
static tn_status parents_text(tn_evolution_job *job, const char *path, const char *stored, tn_error *error)
{
    if (stored) {
        job->seeds_text = strdup(stored);
        return job->seeds_text ? TN_OK : tn_fail_memory(error);
    }
    job->blamed = TN_SET_PARENT;
    tn_status status =
        tn_field_parents_read(&job->study, path, &job->seeds_text, &job->inputs, &job->blamed_each, error);
    if (status != TN_OK && job->blamed_each == UINT32_MAX)
        job->blamed = TN_SET_BOX;
    return status;
}

static tn_status take_parents(tn_evolution_job *job, const char *path, const char *stored, tn_error *error)
{
    tn_status status = parents_text(job, path, stored, error);
    if (status == TN_OK)
        status = tn_field_parents_of(job->seeds_text, &job->parents, error);
    if (status != TN_OK)
        return status;
    tn_tree_breeding *breeding = tn_field_parents_breeding(job->parents);
    if (breeding->parent_count > job->settings.population) {
        job->blamed = TN_SET_POPULATION;
        tn_fail(error, TN_INVALID, E_EVOLUTION_VALUE, "there are more parents than individuals");
        tn_error_help(error, "make the population at least %zu", breeding->parent_count);
        return TN_INVALID;
    }
    breeding->how = tree_variation(&job->study);
    job->kind = tn_tree_kind(breeding);
    job->settings.kind = &job->kind;
    job->settings.seeds = breeding->parents;
    job->settings.seed_count = breeding->parent_count;
    return TN_OK;
}

static tn_status make_fields(tn_evolution_job *job, const char *path, bool draws_open, tn_error *error)
{
    bool separately = job->settings.select.selection == TN_SELECT_NSGA2;
    uint32_t each = UINT32_MAX;
    tn_status status = tn_field_scorer_new(&job->study, path, separately, &job->fields, &job->inputs, &each, error);
    job->blamed_each = each;
    job->blamed = each < job->study.each_count ? job->study.each[each].setting : TN_SETTING_COUNT;
    if (status != TN_OK)
        return status;
    job->forms = (tn_bred_forms){
        job->fields, "surface", ".png", tn_field_scorer_draw, tn_field_scorer_objective, tn_field_scorer_mesh, NULL};
    if (draws_open)
        tn_field_scorer_draw_open(job->fields);
    job->evaluator = tn_field_scorer_evaluator(job->fields);
    job->scored = job->study.of[TN_SET_FITNESS].written || job->study.of[TN_SET_LIKENESS].written ||
                  job->study.of[TN_SET_PROGRAM].written;
    return TN_OK;
}

/* ---- designs of boxes */

tn_bred_forms tn_bred_designs(const tn_design_scorer *designs)
{
    return (tn_bred_forms){designs,
                           "form",
                           ".svg",
                           tn_design_scorer_draw,
                           tn_design_scorer_objective,
                           tn_design_scorer_mesh,
                           tn_design_scorer_unmet};
}

static tn_status take_skeleton(tn_evolution_job *job, const char *path, const char *stored, tn_error *error)
{
    size_t seeds;
    tn_status status = TN_OK;
    job->blamed = TN_SET_DESIGN;
    job->seeds_text = stored ? strdup(stored) : NULL;
    if (stored && !job->seeds_text)
        return tn_fail_memory(error);
    if (!stored)
        status = tn_skeleton_read(&job->study, path, &job->seeds_text, &job->inputs, error);
    if (status == TN_OK)
        status = tn_skeleton_of(job->seeds_text, &job->study, &job->skeleton, &job->blamed, error);
    if (status != TN_OK)
        return status;
    job->kind = tn_box_kind(tn_skeleton_breeding(job->skeleton));
    job->settings.kind = &job->kind;
    job->settings.seeds = tn_skeleton_seed(job->skeleton, &seeds);
    job->settings.seed_count = seeds;
    return TN_OK;
}

static tn_status make_boxes(tn_evolution_job *job, const char *path, tn_error *error)
{
    bool separately = job->settings.select.selection == TN_SELECT_NSGA2;
    char *design = tn_file_beside(path, job->study.of[TN_SET_DESIGN].text);
    tn_status status =
        design ? tn_design_scorer_new(design, separately, true, &job->designs, error) : tn_fail_memory(error);
    free(design);
    if (status == TN_OK) {
        job->blamed = TN_SET_FITNESS;
        status = tn_design_scorer_add(job->designs, &job->study, &job->blamed_each, error);
    }
    if (status == TN_OK)
        status = tn_design_scorer_take_genes(job->designs, tn_skeleton_breeding(job->skeleton), error);
    if (status != TN_OK)
        return status;
    job->forms = tn_bred_designs(job->designs);
    job->evaluator = tn_design_scorer_evaluator(job->designs);
    job->scored = tn_design_scorer_wants(job->designs) || job->study.of[TN_SET_PROGRAM].written;
    return TN_OK;
}

tn_status tn_evolution_forms(tn_evolution_job *job, const char *path, const tn_evolution_job_options *options,
                             tn_error *error)
{
    bool fields = tn_evolution_study_use(&job->study) == TN_USE_TREES;
    job->extension = fields ? "field" : "solid";
    tn_status status = fields ? take_parents(job, path, options->stored_seeds, error)
                              : take_skeleton(job, path, options->stored_seeds, error);
    if (status == TN_OK && !options->only_replay)
        return fields ? make_fields(job, path, options->draws_open, error) : make_boxes(job, path, error);
    job->evaluator = (tn_evaluator){.objectives = (size_t)options->objectives,
                                    .evaluate = tn_never_evaluate,
                                    .cases = tn_evolution_held_cases(job)};
    return status;
}
