/* From checked designs to the records of a module. A design that is made from another holds all boxes of both. */
#include <stdio.h>
#include <string.h>

#include "compiler/solid/solid.h"

typedef struct emitting {
    tn_builder *builder;
    const tn_sources *sources;
    tn_formula formula;
    tn_error *error;
    tn_status status;
} emitting;

static uint32_t emit_function(emitting *e, const char *name, const tn_expression *expression, bool violation)
{
    if (e->status == TN_OK)
        e->status = violation ? tn_expression_violation(expression, true, &e->formula, e->error)
                              : tn_expression_code(expression, &e->formula, e->error);
    return e->status == TN_OK ? tn_formula_emit(e->builder, TN_FUNCTION_SOLID_MEASURE, name, &e->formula) : 0;
}

static void emit_box(emitting *e, const tn_checked_box *box)
{
    tn_box_record record = box->record;
    record.name = tn_builder_string(e->builder, box->item->name.text);
    record.doc = tn_builder_string(e->builder, box->item->doc.text);
    tn_builder_add_BOX(e->builder, &record);
}

static void emit_item(emitting *e, const tn_solid_item *item)
{
    for (const tn_solid_entry *entry = item->entries.first; entry; entry = entry->next) {
        tn_span at = entry->span;
        if (item->kind == TN_SOLID_ASKS) {
            uint32_t function = emit_function(e, NULL, entry->expression, false);
            size_t size = strnlen(entry->words, TN_NAME_MAX);
            tn_solid_measure_record record = {tn_builder_string_n(e->builder, entry->words, size), function, at.file,
                                              at.begin, at.end};
            tn_builder_add_SOLID_MEASURE(e->builder, &record);
        } else if (item->kind == TN_SOLID_REQUIRES) {
            uint32_t holds = emit_function(e, NULL, entry->expression, false);
            uint32_t violation = emit_function(e, NULL, entry->expression, true);
            tn_builder_add_REQUIREMENT(e->builder,
                                       &(tn_requirement_record){holds, violation, at.file, at.begin, at.end});
        }
    }
}

double tn_solid_goal_number(const tn_sources *sources, const tn_solid_item *item, int which, double otherwise)
{
    if (item->given[which].end == item->given[which].begin)
        return otherwise;
    const tn_solid_number *number = &item->number[which];
    const char *text = sources->files[number->digits.file].text + number->digits.begin;
    double value = tn_decimal_value(text, number->digits.end - number->digits.begin);
    return number->negative ? -value : value;
}

static void emit_goal(emitting *e, const tn_solid_item *item)
{
    tn_solid_goal_record record = {.name = tn_builder_string(e->builder, item->name.text),
                                   .function =
                                       emit_function(e, item->name.text, item->entries.first->expression, false),
                                   .target = tn_solid_goal_number(e->sources, item, 0, 0),
                                   .weight = tn_solid_goal_number(e->sources, item, 1, 1),
                                   .file = item->span.file,
                                   .begin = item->span.begin,
                                   .end = item->span.end};
    tn_builder_add_SOLID_GOAL(e->builder, &record);
}

/* What it is made from comes first. Depth is bounded by how many designs there are, each of which names one above it.
 */
static void emit_boxes(emitting *e, const tn_checked_solid *solid)
{
    if (solid->base && !solid->anew)
        emit_boxes(e, solid->base);
    for (const tn_checked_box *box = solid->first; box; box = box->next)
        emit_box(e, box);
}

static void emit_conditions(emitting *e, const tn_checked_solid *solid)
{
    if (solid->base)
        emit_conditions(e, solid->base);
    for (const tn_solid_item *item = solid->design->first; item; item = item->next) {
        if (item->kind == TN_SOLID_AIMS)
            emit_goal(e, item);
        else if (item->kind == TN_SOLID_ASKS || item->kind == TN_SOLID_REQUIRES)
            emit_item(e, item);
    }
}

static void emit_design(emitting *e, const tn_checked_solid *solid)
{
    tn_builder *b = e->builder;
    const tn_solid_design *design = solid->design;
    tn_solid_record record = {.name = tn_builder_string(b, design->name.text),
                              .doc = tn_builder_string(b, design->doc.text),
                              .flags = solid->flags | (solid->imported ? TN_SOLID_IMPORTED : 0),
                              .model = solid->model,
                              .depth = solid->depth,
                              .unit_top = solid->unit.top,
                              .unit_bottom = solid->unit.bottom,
                              .box_first = (uint32_t)tn_builder_count(b, TN_SECTION_BOX),
                              .asked_first = (uint32_t)tn_builder_count(b, TN_SECTION_SOLID_MEASURE),
                              .requirement_first = (uint32_t)tn_builder_count(b, TN_SECTION_REQUIREMENT),
                              .goal_first = (uint32_t)tn_builder_count(b, TN_SECTION_SOLID_GOAL),
                              .file = design->span.file,
                              .begin = design->span.begin,
                              .end = design->span.end};
    emit_boxes(e, solid);
    emit_conditions(e, solid);
    record.box_count = (uint32_t)tn_builder_count(b, TN_SECTION_BOX) - record.box_first;
    record.asked_count = (uint32_t)tn_builder_count(b, TN_SECTION_SOLID_MEASURE) - record.asked_first;
    record.requirement_count = (uint32_t)tn_builder_count(b, TN_SECTION_REQUIREMENT) - record.requirement_first;
    record.goal_count = (uint32_t)tn_builder_count(b, TN_SECTION_SOLID_GOAL) - record.goal_first;
    tn_builder_add_SOLID(b, &record);
}

tn_status tn_emit_solids(tn_builder *builder, const tn_sources *sources, const tn_checked_solids *solids,
                         tn_error *error)
{
    emitting e = {.builder = builder, .sources = sources, .error = error, .status = TN_OK};
    for (const tn_checked_solid *solid = solids->first; solid && e.status == TN_OK; solid = solid->next)
        emit_design(&e, solid);
    tn_formula_clear(&e.formula);
    return e.status;
}
