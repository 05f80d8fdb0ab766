/* From a checked study to the records of a module. */
#include <math.h>
#include <string.h>

#include "compiler/common/emit_sources.h"
#include "compiler/study/study.h"

static double number_or(const tn_checked_study *study, tn_study_kind kind, double otherwise)
{
    return study->settings[kind] ? study->settings[kind]->number.value : otherwise;
}

static double part_or(const tn_study_item *item, tn_study_part_kind kind, double otherwise)
{
    for (const tn_study_part *part = item->parts; part; part = part->next)
        if (part->kind == kind)
            return part->value;
    return otherwise;
}

static void emit_settings(tn_builder *builder, const tn_checked_study *study)
{
    static const struct {
        tn_study_kind kind;
        uint32_t flag;
    } flags[] = {{TN_STUDY_SETS_FIXED_CENTRE, TN_STUDY_FIXED_CENTRE},
                 {TN_STUDY_SETS_FIXED_PERIMETER, TN_STUDY_FIXED_PERIMETER},
                 {TN_STUDY_SETS_FACING, TN_STUDY_FACING},
                 {TN_STUDY_SETS_MIRROR, TN_STUDY_MIRROR},
                 {TN_STUDY_SETS_RAW, TN_STUDY_RAW_FITNESS}};
    const tn_study_item *scale = study->settings[TN_STUDY_SCALE], *start = study->settings[TN_STUDY_START],
                        *title = study->settings[TN_STUDY_TITLE], *seed = study->settings[TN_STUDY_SEED];
    tn_study_record record = {.name = tn_builder_string(builder, title ? title->text : NULL),
                              .steps = (uint32_t)number_or(study, TN_STUDY_STEPS, 4),
                              .scale_x = scale ? scale->a.x : 1.5,
                              .scale_y = scale ? scale->a.y : 1.5,
                              .scale_z = scale ? scale->a.z : 1.5,
                              .start_x = start ? start->a.x : 0,
                              .start_y = start ? start->a.y : 0,
                              .start_z = start ? start->a.z : 0,
                              .start_length = number_or(study, TN_STUDY_START_LENGTH, 1),
                              .branch_angle = number_or(study, TN_STUDY_BRANCH_ANGLE, -1),
                              .branch_length = number_or(study, TN_STUDY_BRANCH_LENGTH, -1),
                              .seed = seed ? (int64_t)seed->number.whole : 1,
                              .edge_limit = (int64_t)number_or(study, TN_STUDY_EDGE_LIMIT, 0),
                              .file = study->span.file,
                              .begin = study->span.begin,
                              .end = study->span.end};
    for (size_t i = 0; i < sizeof flags / sizeof *flags; i++)
        if (study->settings[flags[i].kind])
            record.flags |= flags[i].flag;
    if (study->requirement_count > 0)
        record.flags |= TN_STUDY_SHARES;
    tn_builder_add_STUDY(builder, &record);
}

static void emit_force(tn_builder *builder, const tn_study_item *item)
{
    tn_builder_add_FORCE(builder,
                         &(tn_force_record){item->which, item->a.x, item->a.y, item->a.z,
                                            part_or(item, TN_PART_STRENGTH, 1), part_or(item, TN_PART_EXPONENT, 2),
                                            item->span.file, item->span.begin, item->span.end});
}

static void emit_boundary(tn_builder *builder, tn_arena *arena, const tn_sources *sources, const tn_study_item *item,
                          uint32_t root)
{
    tn_boundary_record record = {.kind = item->which,
                                 .mode = (uint32_t)part_or(item, TN_PART_MODE, TN_SLIDE),
                                 .inside = part_or(item, TN_PART_SIDE, 0) > 0,
                                 .a_x = item->a.x,
                                 .a_y = item->a.y,
                                 .a_z = item->a.z,
                                 .file = item->span.file,
                                 .begin = item->span.begin,
                                 .end = item->span.end};
    if (item->which == TN_BOUNDARY_SPHERE) {
        record.radius = item->b.x;
    } else if (item->which == TN_BOUNDARY_MESH) {
        record.mesh = tn_builder_string(builder, tn_emit_path(arena, sources, item->span.file, item->text, root));
    } else {
        double scale = 1;
        if (item->which == TN_BOUNDARY_PLANE)
            scale = 1 / sqrt(item->b.x * item->b.x + item->b.y * item->b.y + item->b.z * item->b.z);
        record.b_x = item->b.x * scale;
        record.b_y = item->b.y * scale;
        record.b_z = item->b.z * scale;
    }
    tn_builder_add_BOUNDARY(builder, &record);
}

static void emit_measuring(tn_builder *builder, tn_arena *arena, const tn_sources *sources,
                           const tn_checked_study *study)
{
    const tn_study_item *sun = study->settings[TN_STUDY_SUN], *target = study->settings[TN_STUDY_DISTANCE_TO];
    if (sun)
        tn_builder_add_MEASURING(builder, &(tn_measuring_record){TN_MEASURING_SUN, sun->a.x, sun->a.y, sun->a.z, 0,
                                                                 sun->span.file, sun->span.begin, sun->span.end});
    if (target) {
        const char *path = tn_emit_path(arena, sources, target->span.file, target->text, study->span.file);
        tn_builder_add_MEASURING(builder,
                                 &(tn_measuring_record){TN_MEASURING_MESH, 0, 0, 0, tn_builder_string(builder, path),
                                                        target->span.file, target->span.begin, target->span.end});
    }
}

static tn_status emit_goal(tn_builder *builder, tn_formula *formula, const tn_study_item *goal, tn_error *error)
{
    uint32_t term = tn_study_term(goal->text);
    bool plain = !goal->expression && term < TN_FITNESS_TERM_COUNT;
    tn_goal_record record = {.term = plain ? term : TN_FITNESS_TERM_COUNT,
                             .target = part_or(goal, TN_PART_TARGET, 0),
                             .weight = part_or(goal, TN_PART_WEIGHT, 1),
                             .file = goal->span.file,
                             .begin = goal->span.begin,
                             .end = goal->span.end};
    if (!plain) {
        tn_expression measured = {.op = TN_OP_TERM, .term = term};
        tn_status status = tn_expression_code(goal->expression ? goal->expression : &measured, formula, error);
        if (status != TN_OK)
            return status;
        record.name = tn_builder_string(builder, goal->text);
        record.function = tn_formula_emit(builder, TN_FUNCTION_MEASURE, goal->text, formula);
    }
    tn_builder_add_GOAL(builder, &record);
    return TN_OK;
}

static tn_status emit_requirement(tn_builder *builder, tn_formula *formula, const tn_study_item *requirement,
                                  tn_error *error)
{
    tn_status status = tn_expression_violation(requirement->expression, true, formula, error);
    if (status != TN_OK)
        return status;
    uint32_t violation = tn_formula_emit(builder, TN_FUNCTION_MEASURE, NULL, formula);
    tn_builder_add_GROWTH_REQUIREMENT(builder,
                                      &(tn_growth_requirement_record){violation, requirement->span.file,
                                                                      requirement->span.begin, requirement->span.end});
    return TN_OK;
}

tn_status tn_emit_study(tn_builder *builder, tn_arena *arena, const tn_sources *sources, const tn_checked_study *study,
                        tn_error *error)
{
    tn_formula formula = {0};
    tn_status status = TN_OK;
    emit_settings(builder, study);
    for (uint32_t i = 0; i < study->force_count; i++)
        emit_force(builder, study->forces[i]);
    for (uint32_t i = 0; i < study->boundary_count; i++)
        emit_boundary(builder, arena, sources, study->boundaries[i], study->span.file);
    emit_measuring(builder, arena, sources, study);
    for (uint32_t i = 0; i < study->goal_count && status == TN_OK; i++)
        status = emit_goal(builder, &formula, study->goals[i], error);
    for (uint32_t i = 0; i < study->requirement_count && status == TN_OK; i++)
        status = emit_requirement(builder, &formula, study->requirements[i], error);
    tn_formula_clear(&formula);
    return status;
}
