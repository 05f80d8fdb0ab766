/* Writes a checked kit: its parts as records, its rules as a connection grammar, one symbol for each rule at each
 * connector and one for what an alternative places. What no model reaches is left out of the grammar. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compiler/common/import.h"
#include "compiler/kit/kit.h"

/* A symbol of the grammar, whose productions are written when its turn comes. */
typedef struct symbol {
    const tn_kit_model *model; /* the start of a model, */
    const tn_kit_rule *rule;   /* or a rule */
    const tn_kit_type *type;   /* at a connector, */
    const tn_kit_node *places; /* or one of its alternatives */
    tn_kit_side side;
} symbol;

typedef struct emitting {
    tn_kit *kit;
    tn_builder *builder;
    tn_names vectors, known; /* by their text: a number above their index */
    symbol *symbols;
    size_t count, capacity;
    tn_formula formula;
    tn_error *error;
    tn_status status;
} emitting;

static uint32_t vector(emitting *e, const int32_t at[3])
{
    char text[64];
    int length = snprintf(text, sizeof text, "%d,%d,%d", at[0], at[1], at[2]);
    const void *known = tn_names_get(&e->vectors, text);
    if (known)
        return (uint32_t)((uintptr_t)known - 1);
    uint32_t index = tn_builder_add_VECTOR(e->builder, &(tn_vector_record){at[0], at[1], at[2]});
    const char *name = tn_arena_copy(e->kit->arena, text, (size_t)length);
    if (name)
        tn_names_put(&e->vectors, name, (void *)((uintptr_t)index + 1));
    return index;
}

static void add_place(emitting *e, tn_span span)
{
    tn_builder_add_SOURCE_MAP(e->builder,
                              &(tn_source_map_record){tn_builder_offset(e->builder), span.file, span.begin, span.end});
}

static void step(emitting *e, tn_span span, tn_opcode opcode, int64_t first, int64_t second)
{
    add_place(e, span);
    tn_builder_emit(e->builder, opcode, first, second);
}

static void move(emitting *e, tn_span span, const int32_t at[3], uint32_t turns)
{
    if (at[0] || at[1] || at[2])
        step(e, span, TN_OP_MOVE, vector(e, at), 0);
    if (turns)
        step(e, span, TN_OP_HEADING, turns, 0);
}

/* ---- symbols */

/* The index of a symbol, in the order in which they are asked for. */
static uint32_t want(emitting *e, symbol wanted)
{
    char key[120];
    int length = snprintf(key, sizeof key, "%p %p %p %p %d", (const void *)wanted.model, (const void *)wanted.rule,
                          (const void *)wanted.type, (const void *)wanted.places, wanted.side);
    const void *known = tn_names_get(&e->known, key);
    if (known)
        return (uint32_t)((uintptr_t)known - 1);
    if (e->count == e->capacity) {
        size_t capacity = e->capacity ? 2 * e->capacity : 64;
        symbol *symbols = TN_NEW_ARRAY(e->kit->arena, symbol, capacity);
        if (!symbols)
            return 0;
        if (e->count)
            memcpy(symbols, e->symbols, e->count * sizeof *symbols);
        e->symbols = symbols;
        e->capacity = capacity;
    }
    const char *name = tn_arena_copy(e->kit->arena, key, (size_t)length);
    if (name)
        tn_names_put(&e->known, name, (void *)((uintptr_t)e->count + 1));
    e->symbols[e->count] = wanted;
    return (uint32_t)e->count++;
}

static tn_string name_of(emitting *e, const symbol *s)
{
    static const char *const sides[] = {" up", " down", " aside"};
    char text[400];
    if (s->model)
        snprintf(text, sizeof text, "%.200s", s->model->node->name.text);
    else if (s->type)
        snprintf(text, sizeof text, "%.100s at %.100s%s", s->rule->node->name.text, s->type->node->name.text,
                 e->kit->turns == TN_TURNS ? "" : sides[s->side]);
    else
        snprintf(text, sizeof text, "%.100s: %.100s%s", s->rule->node->name.text, s->places->inner.first->name.text,
                 s->places->inner.first->next ? " ..." : "");
    return tn_builder_string(e->builder, text);
}

/* ---- steps */

static const tn_kit_part *part_of(const emitting *e, const tn_kit_node *placed)
{
    return tn_names_get(&e->kit->parts, placed->name.text);
}

/* The rule that goes on at a connector of a part, the first that takes it; NULL: none. */
static const tn_kit_rule *next_rule(const emitting *e, const tn_kit_rule *rule, const tn_kit_node *placed,
                                    const tn_kit_type *type)
{
    if (placed->stops)
        return NULL;
    if (!placed->outer.first)
        return tn_kit_rule_takes(rule, type) ? rule : NULL;
    for (const tn_kit_node *named = placed->outer.first; named; named = named->next) {
        const tn_kit_rule *next = tn_names_get(&e->kit->rules, named->name.text);
        if (tn_kit_rule_takes(next, type))
            return next;
    }
    return NULL;
}

/* What is done of each part of an alternative: room is taken for all before the first is placed. */
typedef void part_steps(emitting *e, const tn_kit_rule *rule, const tn_kit_node *placed);

static void put_boxes(emitting *e, const tn_kit_rule *rule, const tn_kit_node *placed)
{
    const tn_kit_part *part = part_of(e, placed);
    (void)rule;
    for (uint32_t i = 0; i < part->box_count; i++) {
        uint32_t low = vector(e, part->boxes[i].low), high = vector(e, part->boxes[i].high);
        step(e, placed->span, TN_OP_BLOCK, low, high);
    }
}

static void put_part(emitting *e, const tn_kit_rule *rule, const tn_kit_node *placed)
{
    tn_string name = tn_builder_string(e->builder, placed->name.text);
    int64_t colour;
    (void)rule;
    if (!tn_kit_given(&placed->count[0])) {
        step(e, placed->span, TN_OP_PART, name, 0);
        return;
    }
    tn_kit_whole(e->kit, &placed->count[0], 0, TN_PLACE_COLOUR_MAX, "a colour", &colour);
    step(e, placed->span, TN_OP_PUSH, 0, 0);
    step(e, placed->span, TN_OP_COLOUR, colour, 0);
    step(e, placed->span, TN_OP_PART, name, 0);
    step(e, placed->span, TN_OP_POP, 0, 0);
}

static void put_joints(emitting *e, const tn_kit_rule *rule, const tn_kit_node *placed)
{
    const tn_kit_part *part = part_of(e, placed);
    for (uint32_t i = 0; i < part->joint_count; i++) {
        const tn_kit_joint *joint = &part->joints[i];
        const tn_kit_rule *next = next_rule(e, rule, placed, joint->type);
        if (!next)
            continue;
        uint32_t index =
            want(e, (symbol){.rule = next, .type = joint->type, .side = tn_kit_side_of(e->kit, joint->axis)});
        step(e, placed->span, TN_OP_PUSH, 0, 0);
        move(e, placed->span, joint->at, tn_kit_bearing(e->kit, joint->axis));
        step(e, placed->span, TN_OP_DERIVE, index, 0);
        step(e, placed->span, TN_OP_POP, 0, 0);
    }
}

static void put_parts(emitting *e, const symbol *s, part_steps *steps)
{
    for (const tn_kit_node *placed = s->places->inner.first; placed; placed = placed->next) {
        int32_t at[3];
        uint32_t turns;
        bool moved = placed != s->places->inner.first;
        tn_kit_offset(e->kit, placed, at, &turns);
        if (moved) {
            step(e, placed->span, TN_OP_PUSH, 0, 0);
            move(e, placed->span, at, turns);
        }
        steps(e, s->rule, placed);
        if (moved)
            step(e, placed->span, TN_OP_POP, 0, 0);
    }
}

/* ---- productions */

static tn_production_record begin(const emitting *e, tn_span span)
{
    return (tn_production_record){
        .code_begin = tn_builder_offset(e->builder), .file = span.file, .begin = span.begin, .end = span.end};
}

static void end(emitting *e, tn_production_record production, tn_span span)
{
    step(e, span, TN_OP_PLACED, 0, 0);
    production.code_end = tn_builder_offset(e->builder);
    tn_builder_add_PRODUCTION(e->builder, &production);
}

static void emit_places(emitting *e, const symbol *s, const tn_kit_node *places, uint32_t member)
{
    tn_span span = places->span;
    uint32_t count = 0;
    tn_production_record production = begin(e, span);
    if (!places->inner.first) { /* {}: nothing, which always fits */
        end(e, production, span);
        return;
    }
    tn_kit_placement *all = tn_kit_placements(e->kit, places, s->type, s->side, &count);
    uint32_t body = count ? want(e, (symbol){.rule = s->rule, .places = places}) : 0;
    for (uint32_t i = 0; all && i < count; i++) {
        production = begin(e, span);
        production.member = member;
        production.weight = member ? tn_kit_number(e->kit, &places->count[0]) : 0;
        step(e, span, TN_OP_PUSH, 0, 0);
        move(e, span, all[i].move, all[i].turns);
        step(e, span, TN_OP_DERIVE, body, 0);
        step(e, span, TN_OP_POP, 0, 0);
        end(e, production, span);
    }
}

/* The alternatives of a rule at a connector; the last is to leave it open. */
static void emit_rule(emitting *e, const symbol *s)
{
    const tn_kit_node *rule = s->rule->node;
    for (const tn_kit_node *one = rule->inner.first; one; one = one->next) {
        uint32_t member = one->inner.first != one->inner.last;
        if (one->kind == TN_KIT_PLACES)
            emit_places(e, s, one, 0);
        for (const tn_kit_node *drawn = one->inner.first; one->kind == TN_KIT_DRAWN && drawn; drawn = drawn->next)
            emit_places(e, s, drawn, member ? member++ : 0);
    }
    end(e, begin(e, rule->name.span), rule->name.span);
}

static void emit_body(emitting *e, const symbol *s)
{
    tn_production_record production = begin(e, s->places->span);
    put_parts(e, s, put_boxes);
    put_parts(e, s, put_part);
    put_parts(e, s, put_joints);
    end(e, production, s->places->span);
}

/* The parts of a file, each where it is: room is taken for all before anything grows. */
static void stand_parts(emitting *e, const tn_kit_node *node, const tn_kit_rule *rule, bool joints)
{
    const tn_kit_parts *parts = tn_kit_parts_of_file(e->kit, node);
    for (const tn_kit_stands *one = parts ? parts->first : NULL; one; one = one->next) {
        const tn_kit_node placed = {.kind = TN_KIT_PLACED, .span = node->span, .name = one->part->node->name};
        step(e, node->span, TN_OP_PUSH, 0, 0);
        if (!joints)
            step(e, node->span, TN_OP_COLOUR, one->colour, 0);
        move(e, node->span, one->at, one->heading);
        if (joints) {
            put_joints(e, rule, &placed);
        } else {
            put_boxes(e, rule, &placed);
            put_part(e, rule, &placed);
        }
        step(e, node->span, TN_OP_POP, 0, 0);
    }
}

static void emit_standing(emitting *e, const tn_kit_node *node)
{
    const tn_kit_rule *rule = tn_names_get(&e->kit->rules, node->other.text);
    stand_parts(e, node, rule, false);
    stand_parts(e, node, rule, true);
}

static void emit_start(emitting *e, const tn_kit_model *model)
{
    tn_production_record production = begin(e, model->node->span);
    step(e, model->node->name.span, TN_OP_COLOUR, model->colour, 0);
    for (const tn_kit_node *node = model->node->inner.first; node; node = node->next) {
        tn_axis axis = TN_AXIS_UP;
        int32_t at[3];
        uint32_t turns;
        if (node->kind == TN_KIT_STANDS)
            emit_standing(e, node);
        if (node->kind != TN_KIT_START)
            continue;
        if (node->doc.text)
            tn_kit_axis(e->kit, &node->doc, &axis);
        for (int k = 0; k < 3; k++) {
            int64_t value;
            tn_kit_measure(e->kit, &node->at.at[k], &value);
            tn_kit_cells(e->kit, node->span, k == 1 ? -value : value, k, 1, "the model starts at", &at[k]);
        }
        uint32_t index = want(e, (symbol){.rule = tn_names_get(&e->kit->rules, node->other.text),
                                          .type = tn_names_get(&e->kit->types, node->name.text),
                                          .side = tn_kit_side_of(e->kit, axis)});
        step(e, node->span, TN_OP_PUSH, 0, 0);
        tn_kit_start_turn(e->kit, node, &turns);
        if (axis == TN_AXIS_DOWN && e->kit->turns == TN_TURNS)
            turns = (4 - turns) % 4; /* `turn` is about the vertical, and this one's bearing stands on its head */
        move(e, node->span, at, tn_turn_after(tn_kit_bearing(e->kit, axis), turns));
        step(e, node->span, TN_OP_DERIVE, index, 0);
        step(e, node->span, TN_OP_POP, 0, 0);
    }
    end(e, production, model->node->span);
}

/* Symbols that the productions ask for are written behind them, until none is left. */
static void emit_symbols(emitting *e)
{
    for (size_t i = 0; i < e->count && !tn_arena_failed(e->kit->arena); i++) {
        symbol s = e->symbols[i]; /* the array may move */
        tn_span span = s.model ? s.model->node->span : s.places ? s.places->span : s.rule->node->span;
        tn_nonterminal_record record = {.name = name_of(e, &s),
                                        .production_first =
                                            (uint32_t)tn_builder_count(e->builder, TN_SECTION_PRODUCTION),
                                        .file = span.file,
                                        .begin = span.begin,
                                        .end = span.end};
        if (s.model)
            emit_start(e, s.model);
        else if (s.type)
            emit_rule(e, &s);
        else
            emit_body(e, &s);
        record.production_count =
            (uint32_t)tn_builder_count(e->builder, TN_SECTION_PRODUCTION) - record.production_first;
        tn_builder_add_NONTERMINAL(e->builder, &record);
    }
}

/* ---- records */

static uint32_t emit_function(emitting *e, const tn_expression *expression)
{
    if (e->status == TN_OK)
        e->status = tn_expression_code(expression, &e->formula, e->error);
    return e->status == TN_OK ? tn_formula_emit(e->builder, TN_FUNCTION_KIT, NULL, &e->formula) : 0;
}

static uint32_t emit_violation(emitting *e, const tn_expression *expression)
{
    if (e->status == TN_OK)
        e->status = tn_expression_violation(expression, false, &e->formula, e->error);
    return e->status == TN_OK ? tn_formula_emit(e->builder, TN_FUNCTION_KIT, NULL, &e->formula) : 0;
}

static void emit_stock(emitting *e, const tn_kit_node *stocks)
{
    for (const tn_kit_node *stocked = stocks ? stocks->inner.first : NULL; stocked; stocked = stocked->next) {
        const tn_kit_part *part = tn_names_get(&e->kit->parts, stocked->name.text);
        int64_t most;
        tn_kit_whole(e->kit, &stocked->count[0], 0, UINT32_MAX, "a stock", &most);
        tn_builder_add_KIT_STOCK(e->builder, &(tn_kit_stock_record){part->index, (uint32_t)most});
    }
}

static void emit_conditions(emitting *e, const tn_kit_node *node, uint32_t flags)
{
    for (const tn_kit_node *condition = node->inner.first; condition; condition = condition->next) {
        tn_span at = condition->span;
        uint32_t holds = emit_function(e, condition->expression);
        uint32_t violation = flags ? TN_NO_RECORD : emit_violation(e, condition->expression);
        tn_builder_add_KIT_CONDITION(e->builder,
                                     &(tn_kit_condition_record){holds, flags, at.file, at.begin, at.end, violation});
    }
}

/* The outermost cells whose middle may be inside: their sides are upwards in y, those of cells downwards. */
static void set_bounds(const tn_kit *kit, const tn_kit_region *region, tn_kit_model_record *record)
{
    int64_t low[3], high[3];
    for (int k = 0; k < 3; k++) {
        double unit = (double)kit->unit[k] / 1e6;
        low[k] = (int64_t)((k == 1 ? -region->high[k] : region->low[k]) / unit) - 1;
        high[k] = (int64_t)((k == 1 ? -region->low[k] : region->high[k]) / unit) + 1;
        high[k] = high[k] < low[k] ? low[k] : high[k];
    }
    record->low_x = low[0];
    record->low_y = low[1];
    record->low_z = low[2];
    record->high_x = high[0];
    record->high_y = high[1];
    record->high_z = high[2];
}

static void emit_model(emitting *e, const tn_kit_model *model, uint32_t start, const tn_kit_file *file)
{
    const tn_kit_node *node = model->node;
    tn_kit_model_record record = {.name = tn_builder_string(e->builder, node->name.text),
                                  .doc = tn_builder_string(e->builder, node->doc.text),
                                  .start = start,
                                  .space = emit_function(e, model->region.inside),
                                  .condition_first = (uint32_t)tn_builder_count(e->builder, TN_SECTION_KIT_CONDITION),
                                  .file = node->span.file,
                                  .begin = node->span.begin,
                                  .end = node->span.end,
                                  .search = model->search,
                                  .search_amount = (uint32_t)model->amount,
                                  .objective = TN_NO_RECORD,
                                  .symmetry = model->symmetry,
                                  .steps = model->steps,
                                  .step_parts = (uint32_t)model->step_parts,
                                  .stock_first = (uint32_t)tn_builder_count(e->builder, TN_SECTION_KIT_STOCK)};
    for (const tn_kit_node *line = node->inner.first; line; line = line->next)
        if (line->kind == TN_KIT_REQUIRES)
            emit_conditions(e, line, 0);
    for (const tn_kit_node *test = file->first; test; test = test->next)
        if (test->kind == TN_KIT_TEST && strcmp(test->name.text, node->name.text) == 0)
            emit_conditions(e, test, TN_CONDITION_TEST);
    record.condition_count = (uint32_t)tn_builder_count(e->builder, TN_SECTION_KIT_CONDITION) - record.condition_first;
    if (model->objective) {
        record.objective = emit_function(e, model->objective->inner.first->expression);
        record.flags = model->objective->kind == TN_KIT_MAXIMIZES ? TN_KIT_MAXIMIZE : 0;
    }
    record.flags |= model->breadth ? TN_KIT_BREADTH : 0;
    emit_stock(e, model->stocks);
    record.stock_count = (uint32_t)tn_builder_count(e->builder, TN_SECTION_KIT_STOCK) - record.stock_first;
    set_bounds(e->kit, &model->region, &record);
    tn_builder_add_KIT_MODEL(e->builder, &record);
}

static void emit_part(emitting *e, const tn_kit_part *part)
{
    tn_builder *b = e->builder;
    const tn_kit_node *node = part->node;
    tn_kit_part_record record = {.name = tn_builder_string(b, node->name.text),
                                 .title = tn_builder_string(b, node->doc.text),
                                 .mass = part->mass,
                                 .price = part->price,
                                 .box_first = (uint32_t)tn_builder_count(b, TN_SECTION_PART_BOX),
                                 .box_count = part->box_count,
                                 .connector_first = (uint32_t)tn_builder_count(b, TN_SECTION_PART_CONNECTOR),
                                 .connector_count = part->joint_count,
                                 .slope_first = (uint32_t)tn_builder_count(b, TN_SECTION_PART_SLOPE),
                                 .slope_count = part->slope_count,
                                 .file = node->span.file,
                                 .begin = node->span.begin,
                                 .end = node->span.end};
    for (uint32_t i = 0; i < part->box_count; i++) {
        const tn_kit_box *box = &part->boxes[i];
        tn_builder_add_PART_BOX(
            b, &(tn_part_box_record){box->low[0], box->low[1], box->low[2], box->high[0], box->high[1], box->high[2]});
    }
    for (uint32_t i = 0; i < part->slope_count; i++) {
        const tn_kit_slope *slope = &part->slopes[i];
        const tn_kit_box *box = &slope->whole;
        tn_builder_add_PART_SLOPE(b,
                                  &(tn_part_slope_record){box->low[0], box->low[1], box->low[2], box->high[0],
                                                          box->high[1], box->high[2], slope->sides[0], slope->sides[1],
                                                          record.box_first + slope->first, slope->count});
    }
    for (uint32_t i = 0; i < part->joint_count; i++) {
        const tn_kit_joint *joint = &part->joints[i];
        tn_builder_add_PART_CONNECTOR(
            b, &(tn_part_connector_record){joint->type->index, joint->axis, joint->at[0], joint->at[1], joint->at[2]});
    }
    tn_builder_add_KIT_PART(b, &record);
}

static void emit_voxels(emitting *e, const tn_kit_voxels *voxels)
{
    tn_builder_add_KIT_MASK(e->builder,
                            &(tn_kit_mask_record){voxels->low[0], voxels->low[1], voxels->low[2], voxels->size[0],
                                                  voxels->size[1], voxels->size[2],
                                                  (uint32_t)tn_builder_count(e->builder, TN_SECTION_MASK_WORD),
                                                  (uint32_t)voxels->words});
    for (size_t i = 0; i < voxels->words; i++)
        tn_builder_add_MASK_WORD(e->builder, &(tn_mask_word_record){voxels->bits[i]});
}

static void emit_records(emitting *e, tn_kit_record record)
{
    tn_builder *b = e->builder;
    for (const tn_kit_type *type = e->kit->type_list.first; type; type = type->next) {
        tn_span at = type->node->span;
        tn_builder_add_CONNECTOR_TYPE(b, &(tn_connector_type_record){tn_builder_string(b, type->node->name.text),
                                                                     type->joins->index, type->turns, at.file, at.begin,
                                                                     at.end});
    }
    for (const tn_kit_part *part = e->kit->part_list.first; part; part = part->next)
        emit_part(e, part);
    for (const tn_kit_voxels *voxels = e->kit->voxels_list.first; voxels; voxels = voxels->next)
        if (!voxels->wrong && voxels->index < e->kit->voxels_placed)
            emit_voxels(e, voxels);
    for (uint32_t i = 0; i < e->kit->counted_count; i++)
        tn_builder_add_COUNTED(b, &(tn_counted_record){tn_builder_string(b, e->kit->counted[i])});
    record.type_count = (uint32_t)tn_builder_count(b, TN_SECTION_CONNECTOR_TYPE);
    record.part_count = (uint32_t)tn_builder_count(b, TN_SECTION_KIT_PART);
    record.model_count = (uint32_t)tn_builder_count(b, TN_SECTION_KIT_MODEL);
    record.counted_count = e->kit->counted_count;
    tn_builder_add_KIT(b, &record);
}

static void emit_grammar(emitting *e, const tn_kit_record *kit)
{
    tn_builder_add_GRAMMAR(e->builder, &(tn_grammar_record){.name = kit->name,
                                                            .dialect = TN_DIALECT_PLACE,
                                                            .repair = TN_REPAIR_OFF,
                                                            .rule_count = (uint32_t)e->count,
                                                            .rewrite_rule = TN_NO_RECORD,
                                                            .predecessor = TN_NO_RECORD,
                                                            .successor = TN_NO_RECORD,
                                                            .file = kit->file,
                                                            .begin = kit->begin,
                                                            .end = kit->end});
}

/* The code of functions comes before that of productions. */
tn_status tn_emit_kit(tn_builder *builder, tn_kit *kit, const tn_kit_file *file, const char *name, size_t length,
                      tn_error *error)
{
    emitting e = {.kit = kit,
                  .builder = builder,
                  .vectors = {.arena = kit->arena},
                  .known = {.arena = kit->arena},
                  .error = error,
                  .status = TN_OK};
    tn_span at = kit->unit_node ? kit->unit_node->span : (tn_span){0};
    tn_kit_record record = {.name = tn_builder_string_n(builder, name, length),
                            .unit_x = kit->unit_node ? kit->unit[0] : 1,
                            .unit_y = kit->unit_node ? kit->unit[1] : 1,
                            .unit_z = kit->unit_node ? kit->unit[2] : 1,
                            .turns = kit->turns,
                            .file = at.file,
                            .begin = at.begin,
                            .end = at.end};
    for (const tn_kit_model *model = kit->model_list.first; model; model = model->next)
        emit_model(&e, model, want(&e, (symbol){.model = model}), file);
    emit_symbols(&e);
    emit_records(&e, record);
    if (e.count > 0)
        emit_grammar(&e, &record);
    tn_formula_clear(&e.formula);
    return tn_arena_failed(kit->arena) ? tn_fail_memory(error) : e.status;
}

tn_status tn_emit_kit_conditions(tn_builder *builder, tn_kit *kit, const tn_kit_node *conditions, tn_error *error)
{
    emitting e = {.kit = kit, .builder = builder, .error = error, .status = TN_OK};
    tn_span at = conditions->span;
    for (const tn_kit_node *one = conditions->inner.first; one; one = one->next) {
        add_place(&e, one->span);
        emit_function(&e, one->expression);
    }
    emit_records(&e, (tn_kit_record){.name = tn_builder_string(builder, "conditions"),
                                     .unit_x = 1,
                                     .unit_y = 1,
                                     .unit_z = 1,
                                     .turns = TN_UPRIGHT_TURNS,
                                     .file = at.file,
                                     .begin = at.begin,
                                     .end = at.end});
    tn_formula_clear(&e.formula);
    return tn_arena_failed(kit->arena) ? tn_fail_memory(error) : e.status;
}
