/* Emits forms: the code that decides on cells and sections, and the records. */
#include "compiler/plan/check/form.h"
#include "compiler/plan/emit/emit.h"

static tn_string text(tn_emit *emit, const tn_ast_word *word)
{
    return tn_builder_string(emit->builder, word ? word->text : NULL);
}

#define PLACE(SPAN) .file = (SPAN).file, .begin = (SPAN).begin, .end = (SPAN).end

/* ---- code */

/* What an instruction's index is in the module. */
static int64_t index_of(const tn_checked_form *form, const tn_decision_step *step)
{
    switch (step->opcode) {
    case TN_OP_IN_TRAY:
        return step->spec->index;
    case TN_OP_IN_ZONE:
        return (int64_t)form->schema->field_first + step->index;
    case TN_OP_IN_STOREY:
        return (int64_t)form->storey_first + step->index;
    case TN_OP_IS_FOR:
        return (int64_t)form->rule_first + step->index;
    case TN_OP_CHOSEN:
        return (int64_t)form->shape_first + step->index;
    default:
        return step->index;
    }
}

uint32_t tn_emit_decision(tn_emit *emit, const tn_checked_form *form, tn_decision *decision, const char *name,
                          tn_function_kind kind)
{
    for (size_t i = 0; i < decision->count; i++) {
        tn_decision_step *step = &decision->steps[i];
        if (step->spec)
            tn_emit_spec(emit, step->spec);
        if (step->cells)
            step->index = tn_emit_decision(emit, form, step->cells, "cells", TN_FUNCTION_CELL);
    }
    tn_emit_begin(emit, form->schema->index);
    for (size_t i = 0; i < decision->count; i++)
        tn_emit_op(emit, decision->steps[i].span, decision->steps[i].opcode, index_of(form, &decision->steps[i]),
                   decision->steps[i].area);
    tn_emit_op(emit, decision->span, TN_OP_DECIDE, 0, 0);
    return tn_emit_end(emit, name, kind);
}

/* ---- records */

static void emit_storeys(tn_emit *emit, const tn_checked_form *form)
{
    for (uint32_t i = 0; i < form->storey_count; i++) {
        const tn_checked_storey *storey = &form->storeys[i];
        tn_builder_add_STOREY(emit->builder, &(tn_storey_record){.name = text(emit, storey->ast->name),
                                                                 .doc = text(emit, storey->ast->doc),
                                                                 .height = storey->height,
                                                                 PLACE(storey->ast->node.span)});
    }
}

static void emit_choices(tn_emit *emit, const tn_checked_form *form)
{
    for (uint32_t i = 0; i < form->choice_count; i++) {
        const tn_checked_choice *choice = &form->choices[i];
        for (uint32_t s = 0; s < choice->shape_count; s++) {
            tn_shape_record record = choice->shapes[s].record;
            tn_span span = choice->shapes[s].ast->node.span;
            record.name = text(emit, choice->shapes[s].ast->word);
            record.spelling = tn_builder_string(emit->builder, choice->shapes[s].spelling);
            record.file = span.file;
            record.begin = span.begin;
            record.end = span.end;
            tn_builder_add_SHAPE(emit->builder, &record);
        }
        tn_builder_add_CHOICE(emit->builder, &(tn_choice_record){.name = tn_builder_string(emit->builder, choice->name),
                                                                 .kind = choice->kind,
                                                                 .zone = choice->zone == TN_NONE
                                                                             ? TN_NO_RECORD
                                                                             : form->schema->field_first + choice->zone,
                                                                 .shape_first = form->shape_first + choice->shape_first,
                                                                 .shape_count = choice->shape_count,
                                                                 PLACE(choice->ast->node.span)});
    }
}

static void emit_rules(tn_emit *emit, tn_checked_form *form)
{
    static const char *const words[] = {"function", "void", "no", "forbid"};
    for (uint32_t i = 0; i < form->rule_count; i++) {
        tn_checked_cell_rule *rule = &form->rules[i];
        const char *name = rule->ast->name ? rule->ast->name->text : words[rule->kind];
        uint32_t decides = tn_emit_decision(emit, form, &rule->decision, name,
                                            rule->kind == TN_CELL_FORBID ? TN_FUNCTION_SECTION : TN_FUNCTION_CELL);
        tn_builder_add_CELL_RULE(emit->builder,
                                 &(tn_cell_rule_record){.name = text(emit, rule->ast->name),
                                                        .doc = text(emit, rule->ast->doc),
                                                        .kind = rule->kind,
                                                        .decides = decides,
                                                        .way = i < form->function_count ? form->ways[i].length : 0,
                                                        .flags = rule->ast->outdoor ? TN_OUTDOOR : 0,
                                                        PLACE(rule->ast->node.span)});
    }
}

/* Where an opening begins; nothing is said of it: in the middle. */
static tn_house_side side_of(const tn_ast_opening_part *near)
{
    return near ? (tn_house_side)near->side->value : TN_HOUSE_ANY_SIDE;
}

static int64_t length_of(const tn_ast_opening_part *near)
{
    return near ? near->length->value : 0;
}

static void emit_openings(tn_emit *emit, const tn_checked_form *form)
{
    for (uint32_t i = 0; i < form->opening_count; i++) {
        const tn_checked_opening *opening = &form->openings[i];
        tn_builder_add_OPENING(
            emit->builder,
            &(tn_opening_record){.name = text(emit, opening->ast->name),
                                 .doc = text(emit, opening->ast->doc),
                                 .wide = opening->wide,
                                 .high = opening->high,
                                 .sill = opening->sill,
                                 .clear = opening->clear,
                                 .rise_least = opening->rise_least,
                                 .rise_most = opening->rise_most,
                                 .going = opening->going,
                                 .turn = opening->turn,
                                 .winders = opening->winders,
                                 .flags = (opening->passage ? TN_PASSAGE : 0) | (opening->glazed ? TN_GLAZED : 0) |
                                          (opening->leafless ? TN_LEAFLESS : 0) | (opening->sliding ? TN_SLIDING : 0),
                                 .near_x = side_of(opening->near_x),
                                 .at_x = length_of(opening->near_x),
                                 .near_y = side_of(opening->near_y),
                                 .at_y = length_of(opening->near_y),
                                 PLACE(opening->ast->node.span)});
    }
}

uint32_t tn_emit_items(tn_emit *emit, const uint32_t *numbers, uint32_t count)
{
    uint32_t first = (uint32_t)tn_builder_count(emit->builder, TN_SECTION_HOUSE_ITEM);
    for (uint32_t i = 0; i < count; i++)
        tn_builder_add_HOUSE_ITEM(emit->builder, &(tn_house_item_record){numbers[i]});
    return first;
}

static void emit_faces(tn_emit *emit, const tn_checked_form *form)
{
    for (uint32_t i = 0; i < form->face_count; i++) {
        tn_checked_face *face = &form->faces[i];
        bool outside = face->ast->relation == TN_FACE_OUTSIDE;
        uint32_t first = tn_emit_decision(emit, form, &face->first, "face", TN_FUNCTION_CELL);
        uint32_t second =
            outside ? TN_NO_RECORD : tn_emit_decision(emit, form, &face->second, "face", TN_FUNCTION_CELL);
        tn_builder_add_FACE_LINE(
            emit->builder,
            &(tn_face_line_record){.relation = face->ast->relation,
                                   .side = face->ast->detail ? (uint32_t)face->ast->detail->value : TN_HOUSE_ANY_SIDE,
                                   .first = first,
                                   .second = second,
                                   .kind_first = tn_emit_items(emit, face->kinds, face->kind_count),
                                   .kind_count = face->kind_count,
                                   PLACE(face->ast->node.span)});
    }
}

static void emit_tiles(tn_emit *emit, const tn_checked_form *form)
{
    for (uint32_t i = 0; i < form->tile_count; i++) {
        const tn_checked_tile *tile = &form->tiles[i];
        uint32_t box_first = (uint32_t)tn_builder_count(emit->builder, TN_SECTION_TILE_BOX);
        for (uint32_t b = 0; b < tile->box_count; b++) {
            tn_tile_box_record box = tile->boxes[b];
            tn_span span = tile->box_ast[b]->node.span;
            box.name = text(emit, tile->box_ast[b]->name);
            box.doc = text(emit, tile->box_ast[b]->doc);
            box.file = span.file;
            box.begin = span.begin;
            box.end = span.end;
            const tn_symbol_line_record *lines = tile->lines + box.line_first;
            box.line_first = (uint32_t)tn_builder_count(emit->builder, TN_SECTION_SYMBOL_LINE);
            for (uint32_t k = 0; k < box.line_count; k++)
                tn_builder_add_SYMBOL_LINE(emit->builder, &lines[k]);
            tn_builder_add_TILE_BOX(emit->builder, &box);
        }
        tn_builder_add_TILE(emit->builder,
                            &(tn_tile_record){.name = text(emit, tile->ast->name),
                                              .doc = text(emit, tile->ast->doc),
                                              .purpose_first = tn_emit_items(emit, tile->purposes, tile->purpose_count),
                                              .purpose_count = tile->purpose_count,
                                              .against_first = tn_emit_items(emit, tile->against, tile->against_count),
                                              .against_count = tile->against_count,
                                              .wide_least = tile->wide[0],
                                              .wide_most = tile->wide[1],
                                              .deep_least = tile->deep[0],
                                              .deep_most = tile->deep[1],
                                              .box_first = box_first,
                                              .box_count = tile->box_count,
                                              PLACE(tile->ast->node.span)});
    }
}

static void emit_materials(tn_emit *emit, tn_checked_form *form)
{
    for (uint32_t i = 0; i < form->material_count; i++) {
        tn_checked_material *material = &form->materials[i];
        uint32_t where = material->has_where
                             ? tn_emit_decision(emit, form, &material->where, "material", TN_FUNCTION_SECTION)
                             : TN_NO_RECORD;
        tn_builder_add_MATERIAL(emit->builder, &(tn_material_record){.name = text(emit, material->ast->name),
                                                                     .colour = material->colour,
                                                                     .price = material->price,
                                                                     .unit = material->unit,
                                                                     .where = where,
                                                                     .part_first = tn_emit_items(emit, material->parts,
                                                                                                 material->part_count),
                                                                     .part_count = material->part_count,
                                                                     PLACE(material->ast->node.span)});
    }
}

static void emit_layers(tn_emit *emit, const tn_checked_form *form)
{
    for (uint32_t i = 0; i < form->layer_count; i++) {
        const tn_checked_layer *layer = &form->layers[i];
        tn_builder_add_LAYER(emit->builder, &(tn_layer_record){.name = text(emit, layer->ast->name),
                                                               .of = layer->of,
                                                               .thick = layer->thick,
                                                               PLACE(layer->ast->node.span)});
    }
}

static void emit_beams(tn_emit *emit, const tn_checked_form *form)
{
    for (uint32_t i = 0; i < form->beam_count; i++) {
        const tn_checked_beam *beam = &form->beams[i];
        tn_builder_add_BEAM(emit->builder, &(tn_beam_record){.name = text(emit, beam->ast->name),
                                                             .doc = text(emit, beam->ast->doc),
                                                             .wide = beam->wide,
                                                             .high = beam->high,
                                                             .span = beam->span,
                                                             PLACE(beam->ast->node.span)});
    }
}

static void emit_classifications(tn_emit *emit, const tn_checked_form *form)
{
    for (uint32_t i = 0; i < form->classification_count; i++) {
        const tn_checked_classification *classification = &form->classifications[i];
        uint32_t first = (uint32_t)tn_builder_count(emit->builder, TN_SECTION_CLASS);
        for (uint32_t c = 0; c < classification->class_count; c++) {
            const tn_ast_class *ast = classification->classes[c].ast;
            tn_builder_add_CLASS(emit->builder, &(tn_class_record){.part = classification->classes[c].part,
                                                                   .code = text(emit, ast->code),
                                                                   .title = text(emit, ast->title),
                                                                   PLACE(ast->node.span)});
        }
        tn_builder_add_CLASSIFICATION(emit->builder,
                                      &(tn_classification_record){.name = text(emit, classification->ast->doc),
                                                                  .class_first = first,
                                                                  .class_count = classification->class_count,
                                                                  PLACE(classification->ast->node.span)});
    }
}

static void emit_form(tn_emit *emit, tn_checked_form *form)
{
    uint32_t counts[] = {(uint32_t)tn_builder_count(emit->builder, TN_SECTION_STOREY),
                         (uint32_t)tn_builder_count(emit->builder, TN_SECTION_CHOICE),
                         (uint32_t)tn_builder_count(emit->builder, TN_SECTION_CELL_RULE),
                         (uint32_t)tn_builder_count(emit->builder, TN_SECTION_OPENING),
                         (uint32_t)tn_builder_count(emit->builder, TN_SECTION_FACE_LINE),
                         (uint32_t)tn_builder_count(emit->builder, TN_SECTION_TILE),
                         (uint32_t)tn_builder_count(emit->builder, TN_SECTION_MATERIAL),
                         (uint32_t)tn_builder_count(emit->builder, TN_SECTION_LAYER),
                         (uint32_t)tn_builder_count(emit->builder, TN_SECTION_BEAM),
                         (uint32_t)tn_builder_count(emit->builder, TN_SECTION_CLASSIFICATION)};
    form->storey_first = counts[0];
    form->rule_first = counts[2];
    form->shape_first = (uint32_t)tn_builder_count(emit->builder, TN_SECTION_SHAPE);
    form->index = (uint32_t)tn_builder_count(emit->builder, TN_SECTION_FORM);
    bool imported = form->unit + 1 != emit->imports->count;
    emit_storeys(emit, form);
    emit_choices(emit, form);
    emit_rules(emit, form);
    emit_openings(emit, form);
    emit_faces(emit, form);
    emit_tiles(emit, form);
    emit_materials(emit, form);
    emit_layers(emit, form);
    emit_beams(emit, form);
    emit_classifications(emit, form);
    tn_builder_add_FORM(emit->builder, &(tn_form_record){.name = tn_builder_string(emit->builder, form->name),
                                                         .doc = text(emit, form->ast->doc),
                                                         .schema = form->schema->index,
                                                         .spine = form->schema->field_first + form->spine,
                                                         .wall = form->thickness[0],
                                                         .partition = form->thickness[1],
                                                         .deck = form->thickness[2],
                                                         .roof = form->thickness[3],
                                                         .storey_first = counts[0],
                                                         .storey_count = form->storey_count,
                                                         .choice_first = counts[1],
                                                         .choice_count = form->choice_count,
                                                         .rule_first = counts[2],
                                                         .rule_count = form->rule_count,
                                                         .opening_first = counts[3],
                                                         .opening_count = form->opening_count,
                                                         .face_first = counts[4],
                                                         .face_count = form->face_count,
                                                         .tile_first = counts[5],
                                                         .tile_count = form->tile_count,
                                                         .material_first = counts[6],
                                                         .material_count = form->material_count,
                                                         .flags = imported ? TN_IMPORTED : 0,
                                                         .way = form->way,
                                                         .headroom = form->headroom,
                                                         .layer_first = counts[7],
                                                         .layer_count = form->layer_count,
                                                         .guard = form->guard,
                                                         .beam_first = counts[8],
                                                         .beam_count = form->beam_count,
                                                         .classification_first = counts[9],
                                                         .classification_count = form->classification_count,
                                                         PLACE(form->ast->top.node.span)});
}

void tn_emit_forms(tn_emit *emit)
{
    for (size_t i = 0; i < emit->checked->form_count; i++)
        emit_form(emit, emit->checked->forms[i]);
}
