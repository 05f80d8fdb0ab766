/* Reads from a module how a surface is to be grown. */
#include "runtime/growth/study.h"

#include <stdlib.h>

#include "runtime/number/run.h"

void tn_study_clear(tn_study *study)
{
    for (uint32_t i = 0; study->meshes && i < study->environment.boundary_count; i++)
        tn_boundary_mesh_free(study->meshes[i]);
    free(study->meshes);
    tn_boundary_mesh_free(study->target);
    free(study->forces);
    free(study->boundaries);
    free(study->goal.named);
    free(study->goal.required);
    *study = (tn_study){0};
}

uint64_t tn_study_meshes_hash(const tn_study *study)
{
    uint64_t hash = 0;
    for (uint32_t i = 0; study->meshes && i < study->environment.boundary_count; i++)
        if (study->meshes[i])
            hash = tn_boundary_mesh_hash(study->meshes[i], hash);
    return hash;
}

uint32_t tn_study_open_boundary(const tn_study *study, uint32_t from)
{
    uint32_t i = from, count = study->environment.boundary_count;
    while (i < count && !(study->boundaries[i].mesh && study->boundaries[i].inside &&
                          !tn_boundary_mesh_is_solid(study->boundaries[i].mesh)))
        i++;
    return i;
}

static void read_settings(const tn_study_record *record, tn_study *study)
{
    tn_growth_options *o = &study->options;
    study->steps = record->steps;
    o->scale[0] = record->scale_x;
    o->scale[1] = record->scale_y;
    o->scale[2] = record->scale_z;
    o->start[0] = record->start_x;
    o->start[1] = record->start_y;
    o->start[2] = record->start_z;
    o->start_length = record->start_length;
    o->branch_angle = record->branch_angle;
    o->branch_length = record->branch_length;
    o->seed = (uint64_t)record->seed;
    o->edge_limit = (uint64_t)record->edge_limit;
    o->fixed_centre = record->flags & TN_STUDY_FIXED_CENTRE;
    o->fixed_perimeter = record->flags & TN_STUDY_FIXED_PERIMETER;
    o->facing = record->flags & TN_STUDY_FACING;
    o->mirror = record->flags & TN_STUDY_MIRROR;
    study->goal.raw = record->flags & TN_STUDY_RAW_FITNESS;
    study->goal.requirement_weight = record->flags & TN_STUDY_SHARES ? TN_REQUIREMENT_WEIGHT : 1;
}

/* Beside what was opened, or where the study lay when it was compiled. */
static tn_status find_mesh(const tn_module *module, const tn_mesh_reader *reader, const char *opened, const char *name,
                           const char *what, tn_boundary_mesh **result, tn_error *error)
{
    uint32_t source = module->STUDY_count ? module->STUDY_records[0].file : 0;
    const char *study = source < module->SOURCE_count ? tn_text(module, module->SOURCE_records[source].path) : opened;
    return tn_boundary_mesh_find(reader, opened, study, name, what, "study", result, error);
}

static tn_status read_boundary(const tn_module *module, const tn_mesh_reader *reader, const char *path, uint32_t index,
                               tn_study *study, tn_error *error)
{
    const tn_boundary_record *record = &module->BOUNDARY_records[index];
    tn_boundary *boundary = &study->boundaries[index];
    *boundary = (tn_boundary){.kind = record->kind,
                              .mode = record->mode,
                              .inside = record->inside != 0,
                              .a = {record->a_x, record->a_y, record->a_z},
                              .b = {record->b_x, record->b_y, record->b_z},
                              .radius = record->radius};
    if (record->kind != TN_BOUNDARY_MESH || !reader)
        return TN_OK;
    tn_status status =
        find_mesh(module, reader, path, tn_text(module, record->mesh), "boundary", &study->meshes[index], error);
    boundary->mesh = study->meshes[index];
    return status;
}

static tn_status read_measuring(const tn_module *module, const tn_mesh_reader *reader, const char *path,
                                tn_study *study, tn_error *error)
{
    tn_status status = TN_OK;
    study->measuring.sun = (tn_vector){0, 0, 1};
    for (size_t i = 0; i < module->MEASURING_count && status == TN_OK; i++) {
        const tn_measuring_record *m = &module->MEASURING_records[i];
        if (m->kind == TN_MEASURING_SUN)
            study->measuring.sun = (tn_vector){m->x, m->y, m->z};
        else if (reader)
            status = find_mesh(module, reader, path, tn_text(module, m->mesh), "target", &study->target, error);
    }
    study->measuring.target = study->target;
    return status;
}

static void read_requirements(const tn_module *module, tn_fitness_goal *goal)
{
    for (size_t i = 0; i < module->GROWTH_REQUIREMENT_count; i++) {
        uint32_t function = module->GROWTH_REQUIREMENT_records[i].violation;
        goal->required[goal->required_count++] =
            (tn_named_goal){"", module->code, module->FUNCTION_records[function].code_begin, 0, 1};
        goal->asked |= tn_number_asked(module, function);
    }
}

static tn_status read_goals(const tn_module *module, tn_study *study, tn_error *error)
{
    tn_fitness_goal *goal = &study->goal;
    goal->named = calloc(module->GOAL_count + 1, sizeof *goal->named);
    goal->required = calloc(module->GROWTH_REQUIREMENT_count + 1, sizeof *goal->required);
    if (!goal->named || !goal->required)
        return tn_fail_memory(error);
    read_requirements(module, goal);
    study->has_goal = module->GOAL_count > 0;
    for (size_t i = 0; i < module->GOAL_count; i++) {
        const tn_goal_record *record = &module->GOAL_records[i];
        if (record->term == TN_FITNESS_TERM_COUNT) {
            goal->named[goal->named_count++] =
                (tn_named_goal){tn_text(module, record->name), module->code,
                                module->FUNCTION_records[record->function].code_begin, record->target, record->weight};
            goal->asked |= tn_number_asked(module, record->function);
            continue;
        }
        study->goal.wanted[record->term] = true;
        study->goal.target[record->term] = record->target;
        study->goal.weight[record->term] = record->weight;
    }
    return TN_OK;
}

tn_status tn_study_read(const tn_module *module, const char *path, const tn_mesh_reader *reader, tn_study *study,
                        tn_error *error)
{
    *study =
        (tn_study){.title = "", .steps = 4, .options = tn_growth_options_default()}; /* Genr8's own number of steps */
    if (module->STUDY_count) {
        read_settings(&module->STUDY_records[0], study);
        study->title = tn_text(module, module->STUDY_records[0].name);
    }
    study->forces = calloc(module->FORCE_count + 1, sizeof *study->forces);
    study->boundaries = calloc(module->BOUNDARY_count + 1, sizeof *study->boundaries);
    study->meshes = calloc(module->BOUNDARY_count + 1, sizeof *study->meshes);
    if (!study->forces || !study->boundaries || !study->meshes)
        return tn_fail_memory(error);
    for (size_t i = 0; i < module->FORCE_count; i++) {
        const tn_force_record *f = &module->FORCE_records[i];
        study->forces[i] = (tn_force){f->kind, {f->x, f->y, f->z}, f->strength, f->exponent};
    }
    study->environment = (tn_environment){study->forces, (uint32_t)module->FORCE_count, study->boundaries,
                                          (uint32_t)module->BOUNDARY_count};
    tn_status status = read_goals(module, study, error);
    for (uint32_t i = 0; i < module->BOUNDARY_count && status == TN_OK; i++)
        status = read_boundary(module, reader, path, i, study, error);
    if (status == TN_OK)
        status = read_measuring(module, reader, path, study, error);
    return status;
}
