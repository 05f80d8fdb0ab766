/* Verifies the forms of a module: what standing a house relies on beyond the bounds of each field. */
#include <stdlib.h>

#include "runtime/house/form/form.h"
#include "runtime/module/code.h"
#include "runtime/module/engine.h"
#include "runtime/module/lister.h"
#include "runtime/module/verify.h"
#include "runtime/number/rational.h"
#include "runtime/plan/schema/list.h"
#include "runtime/plan/schema/sum.h"

static const tn_function_record *function_of(const tn_checker *checker, uint32_t index)
{
    return &checker->module->FUNCTION_records[index];
}

static bool decides(const tn_checker *checker, uint32_t function, tn_function_kind kind, uint32_t schema)
{
    const tn_function_record *record = function_of(checker, function);
    return record->kind == kind && record->schema == schema;
}

/* Is the field a zone of the schema? */
static bool is_zone(const tn_checker *checker, uint32_t field, uint32_t schema)
{
    const tn_schema_record *record = &checker->module->SCHEMA_records[schema];
    return field >= record->field_first && field - record->field_first < record->field_count &&
           checker->module->FIELD_records[field].kind == TN_FIELD_ZONE;
}

static tn_status check_choice(const tn_checker *checker, const tn_form_record *form, uint32_t index)
{
    const tn_choice_record *choice = &checker->module->CHOICE_records[index];
    if (choice->kind != TN_CHOICE_PLAIN && !is_zone(checker, choice->zone, form->schema))
        return tn_refuse(checker, "choice %u is about no zone of its form's schema", index);
    for (uint32_t i = 0; i < choice->shape_count; i++) {
        const tn_shape_record *shape = &checker->module->SHAPE_records[choice->shape_first + i];
        bool slope = shape->roof >= TN_ROOF_SHED_BACK && shape->roof != TN_ROOF_VAULT;
        if (choice->kind == TN_CHOICE_STOREYS && (shape->storeys < 1 || shape->storeys > form->storey_count))
            return tn_refuse(checker, "choice %u has a number of storeys that its form has not", index);
        if (choice->kind == TN_CHOICE_ROOF &&
            (shape->roof == TN_ROOF_NONE || (slope && (shape->rise == 0 || shape->run == 0))))
            return tn_refuse(checker, "choice %u has a roof without a shape", index);
        if (shape->flags & TN_ROOF_ACROSS && shape->roof != TN_ROOF_GABLE && shape->roof != TN_ROOF_VAULT)
            return tn_refuse(checker, "choice %u has a roof across that has no ridge", index);
    }
    return TN_OK;
}

static tn_status check_rules(const tn_checker *checker, const tn_form_record *form)
{
    const tn_cell_rule_record *rules = checker->module->CELL_RULE_records + form->rule_first;
    for (uint32_t i = 0; i < form->rule_count; i++) {
        tn_function_kind kind = rules[i].kind == TN_CELL_FORBID ? TN_FUNCTION_SECTION : TN_FUNCTION_CELL;
        if (!decides(checker, rules[i].decides, kind, form->schema))
            return tn_refuse(checker, "line %u of cells names a function of another kind or schema",
                             form->rule_first + i);
        if (rules[i].way % 2 || (rules[i].way > 0 && form->way == 0))
            return tn_refuse(checker, "line %u of cells has a way whose half is not whole, or that its form has not",
                             form->rule_first + i);
        if (rules[i].flags != 0 && rules[i].kind != TN_CELL_FUNCTION)
            return tn_refuse(checker, "line %u of cells is outdoor and no function", form->rule_first + i);
        if (i > 0 && rules[i].kind < rules[i - 1].kind)
            return tn_refuse(checker, "line %u of cells is out of order", form->rule_first + i);
    }
    return TN_OK;
}

static tn_status check_items(const tn_checker *checker, uint32_t first, uint32_t count, uint32_t end)
{
    for (uint32_t i = 0; i < count; i++)
        if (checker->module->HOUSE_ITEM_records[first + i].number >= end)
            return tn_refuse(checker, "item %u of a form is beyond what the form has", first + i);
    return TN_OK;
}

static bool is_flight(const tn_checker *checker, const tn_form_record *form, uint32_t kind)
{
    return kind >= TN_FACE_KIND_COUNT && kind - TN_FACE_KIND_COUNT < form->opening_count &&
           checker->module->OPENING_records[form->opening_first + kind - TN_FACE_KIND_COUNT].turn != TN_TURN_NONE;
}

/* Steps of a flight rise and go somewhere. Sides that an opening is near are ends of the walls that they are about. */
static tn_status check_openings(const tn_checker *checker, const tn_form_record *form)
{
    for (uint32_t i = 0; i < form->opening_count; i++) {
        const tn_opening_record *opening = &checker->module->OPENING_records[form->opening_first + i];
        bool spiral = opening->turn == TN_TURN_SPIRAL,
             corners = opening->turn == TN_TURN_HALF || opening->turn == TN_TURN_QUARTER;
        if (opening->winders > 0 && (opening->winders < 2 || !corners))
            return tn_refuse(checker, "flight %u has wedges that it cannot have", form->opening_first + i);
        if ((opening->winders > 0 || spiral) && form->way == 0)
            return tn_refuse(checker, "flight %u has wedges in a form without ways", form->opening_first + i);
        if (opening->turn != TN_TURN_NONE &&
            (opening->rise_least < 1 || opening->rise_most < 1 || (opening->going < 1 && !spiral)))
            return tn_refuse(checker, "flight %u has steps without a rise or a going", form->opening_first + i);
        if (opening->near_x == TN_HOUSE_BACK || opening->near_x == TN_HOUSE_FRONT || opening->near_y > TN_HOUSE_FRONT)
            return tn_refuse(checker, "opening %u is near no end of its walls", form->opening_first + i);
    }
    return TN_OK;
}

/* A choice has each of its kinds once, so that no two houses are the same. */
static tn_status check_different_kinds(const tn_checker *checker, const tn_face_line_record *face, uint32_t kinds)
{
    bool *seen = calloc((size_t)kinds + 1, sizeof *seen), again = false;
    if (!seen)
        return tn_fail_memory(checker->error);
    for (uint32_t i = 0; i < face->kind_count; i++) {
        uint32_t kind = checker->module->HOUSE_ITEM_records[face->kind_first + i].number;
        again = again || seen[kind];
        seen[kind] = true;
    }
    free(seen);
    return again ? tn_refuse(checker, "a line of faces has a kind twice") : TN_OK;
}

static tn_status check_face(const tn_checker *checker, const tn_form_record *form, uint32_t index)
{
    const tn_face_line_record *face = &checker->module->FACE_LINE_records[index];
    bool outside = face->relation == TN_FACE_OUTSIDE;
    if (!decides(checker, face->first, TN_FUNCTION_CELL, form->schema) || outside != (face->second == TN_NO_RECORD) ||
        (!outside && !decides(checker, face->second, TN_FUNCTION_CELL, form->schema)))
        return tn_refuse(checker, "line %u of faces names a function of another kind or schema", index);
    for (uint32_t i = 0; i < face->kind_count; i++) {
        uint32_t kind = checker->module->HOUSE_ITEM_records[face->kind_first + i].number;
        bool vertical = kind == TN_FACE_FLOOR || kind == TN_FACE_STAIR || is_flight(checker, form, kind);
        if (kind != TN_FACE_OPEN && vertical != (face->relation == TN_FACE_UNDER))
            return tn_refuse(checker, "line %u of faces has a kind that cannot be there", index);
    }
    uint32_t kinds = TN_FACE_KIND_COUNT + form->opening_count;
    tn_status status = check_items(checker, face->kind_first, face->kind_count, kinds);
    return status == TN_OK ? check_different_kinds(checker, face, kinds) : status;
}

static tn_status check_tile(const tn_checker *checker, const tn_form_record *form, uint32_t index)
{
    const tn_tile_record *tile = &checker->module->TILE_records[index];
    tn_status status = check_items(checker, tile->purpose_first, tile->purpose_count, form->rule_count);
    return status == TN_OK ? check_items(checker, tile->against_first, tile->against_count,
                                         TN_FACE_KIND_COUNT + form->opening_count)
                           : status;
}

/* How many numbers of parts there are. The boxes of a form's tiles follow one another; an item is named by the first of
 * its name among them. Guards have the number behind all of them; then come beams. */
static uint32_t count_parts(const tn_module *module, const tn_form_record *form)
{
    uint32_t boxes = 0;
    for (uint32_t i = 0; i < form->tile_count; i++)
        boxes += module->TILE_records[form->tile_first + i].box_count;
    return TN_OF_COUNT + form->layer_count + form->opening_count + boxes + 1 + form->beam_count;
}

static tn_status check_material(const tn_checker *checker, const tn_form_record *form, uint32_t index)
{
    const tn_module *module = checker->module;
    const tn_material_record *material = &module->MATERIAL_records[index];
    if (material->where != TN_NO_RECORD && !decides(checker, material->where, TN_FUNCTION_SECTION, form->schema))
        return tn_refuse(checker, "material %u names a function of another kind or schema", index);
    return check_items(checker, material->part_first, material->part_count, count_parts(module, form));
}

/* Layers are parts of elements, and no elements. */
static bool may_be_classified(const tn_module *module, const tn_form_record *form, uint32_t part)
{
    uint32_t parts = count_parts(module, form);
    if (part >= parts)
        return part - parts < form->rule_count &&
               module->CELL_RULE_records[form->rule_first + part - parts].kind == TN_CELL_FUNCTION;
    return part < TN_OF_COUNT || part - TN_OF_COUNT >= form->layer_count;
}

static tn_status check_classification(const tn_checker *checker, const tn_form_record *form, uint32_t index)
{
    const tn_module *module = checker->module;
    const tn_classification_record *classification = &module->CLASSIFICATION_records[index];
    const tn_class_record *classes = &module->CLASS_records[classification->class_first];
    for (uint32_t i = 0; i < classification->class_count; i++) {
        if (!may_be_classified(module, form, classes[i].part))
            return tn_refuse(checker, "classification %u has a code for what cannot have one", index);
        if (i > 0 && classes[i].part <= classes[i - 1].part)
            return tn_refuse(checker, "classification %u has a code out of order", index);
    }
    return TN_OK;
}

/* They stand by what they are layers of, and fill it. */
static tn_status check_layers(const tn_checker *checker, const tn_form_record *form)
{
    const tn_layer_record *layers = &checker->module->LAYER_records[form->layer_first];
    int64_t thick[TN_LAYERED_COUNT] = {0};
    for (uint32_t i = 0; i < form->layer_count; i++) {
        if (i > 0 && layers[i].of < layers[i - 1].of)
            return tn_refuse(checker, "layer %u is out of order", form->layer_first + i);
        thick[layers[i].of] += layers[i].thick;
    }
    for (uint32_t of = 0; of < TN_LAYERED_COUNT; of++)
        if (thick[of] > 0 && thick[of] != tn_layered_thick(form, (tn_layered)of))
            return tn_refuse(checker, "layers of a %s are not as thick as it is", tn_names_LAYERED[of]);
    return TN_OK;
}

/* They lie in the planes of walls, as thick as these at most, and take all of the thickness of a partition. */
static tn_status check_beams(const tn_checker *checker, const tn_form_record *form)
{
    for (uint32_t i = 0; i < form->beam_count; i++) {
        const tn_beam_record *beam = &checker->module->BEAM_records[form->beam_first + i];
        bool fits = beam->wide % 2 == 0 && beam->wide >= form->partition && beam->wide <= form->wall;
        for (uint32_t k = 0; k + 1 < form->storey_count; k++)
            fits = fits &&
                   beam->high < checker->module->STOREY_records[form->storey_first + k].height - form->deck;
        if (!fits)
            return tn_refuse(checker, "beam %u fits in no wall", form->beam_first + i);
    }
    return TN_OK;
}

/* ---- rules and libraries of houses */

static tn_status check_rules_of_houses(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    for (uint32_t i = 0; i < module->HOUSE_RULE_count; i++) {
        const tn_house_rule_record *rule = &module->HOUSE_RULE_records[i];
        uint32_t schema = module->FORM_records[rule->form].schema;
        if (!decides(checker, rule->whole, TN_FUNCTION_WHOLE, schema) ||
            !decides(checker, rule->holds, TN_FUNCTION_HOLDS, schema))
            return tn_refuse(checker, "rule %u about houses names a function of another kind or schema", i);
    }
    return tn_check_different(checker, &module->HOUSE_RULE_records->name, sizeof *module->HOUSE_RULE_records,
                              module->HOUSE_RULE_count, "two rules about houses have the same name");
}

static tn_status check_libraries_of_houses(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    for (uint32_t i = 0; i < module->HOUSE_LIBRARY_count; i++) {
        const tn_house_library_record *library = &module->HOUSE_LIBRARY_records[i];
        uint32_t schema = module->FORM_records[library->form].schema;
        if (module->LIBRARY_records[library->plans].schema != schema)
            return tn_refuse(checker, "library %u of houses has plans of another schema than its form's", i);
        for (uint32_t k = 0; k < library->clause_count; k++)
            if (!decides(checker, module->HOUSE_CLAUSE_records[library->clause_first + k].holds, TN_FUNCTION_HOLDS,
                         schema))
                return tn_refuse(checker, "clause %u of houses names a function of another kind or schema",
                                 library->clause_first + k);
    }
    return tn_check_different(checker, &module->HOUSE_LIBRARY_records->name, sizeof *module->HOUSE_LIBRARY_records,
                              module->HOUSE_LIBRARY_count, "two libraries of houses have the same name");
}

/* ---- measures of houses */

static bool is_factor(const tn_module *module, tn_string text)
{
    mpq_t number;
    mpq_init(number);
    bool good = tn_rational_read(tn_text(module, text), number) && mpq_sgn(number) != 0;
    mpq_clear(number);
    return good;
}

/* Do all its functions decide on cells of the schema? */
static bool decides_on_cells(const tn_checker *checker, const tn_meeting_record *meeting, uint32_t schema)
{
    const uint32_t functions[] = {meeting->first, meeting->second, meeting->through};
    bool good = true;
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        good = good &&
               (functions[i] == TN_NO_RECORD || decides(checker, functions[i], TN_FUNCTION_CELL, schema));
    return good;
}

/* Walks are over floors: the form says how wide a person is. */
static tn_status check_house_term(const tn_checker *checker, const tn_form_record *form, uint32_t index)
{
    const tn_house_term_record *term = &checker->module->HOUSE_TERM_records[index];
    tn_function_kind kind = term->kind == TN_HOUSE_ROOMS ? TN_FUNCTION_ROOM : TN_FUNCTION_CELL;
    bool walk = tn_house_term_walks(term->kind), cost = term->kind == TN_HOUSE_COST;
    if (!is_factor(checker->module, term->factor))
        return tn_refuse(checker, "term %u of houses has no factor, or 0", index);
    if ((cost || walk) != (term->part == TN_NO_RECORD) || walk != (term->walk != TN_NO_RECORD))
        return tn_refuse(checker, "term %u of houses does not say what it adds up", index);
    if (tn_house_term_of_floors(term->kind) && form->way <= 0)
        return tn_refuse(checker, "term %u of houses is of walks, and the form does not ask for ways", index);
    if (term->part != TN_NO_RECORD && !decides(checker, term->part, kind, form->schema))
        return tn_refuse(checker, "term %u of houses names a function of another kind or schema", index);
    if (walk && !decides_on_cells(checker, &checker->module->MEETING_records[term->walk], form->schema))
        return tn_refuse(checker, "the walk of term %u of houses is not between cells", index);
    return TN_OK;
}

/* Terms of a number of the houses of a form, whose plan's part is the sum. */
static tn_status check_added(const tn_checker *checker, uint32_t form, uint32_t sum, uint32_t first, uint32_t count)
{
    const tn_module *module = checker->module;
    uint32_t schema = module->FORM_records[form].schema;
    tn_status status = TN_OK;
    if (module->SUM_records[sum].schema != schema)
        return tn_refuse(checker, "sum %u is not of the schema of form %u, whose houses it is about", sum, form);
    const tn_sum_record *of_plan = &module->SUM_records[sum];
    for (uint32_t i = 0; i < of_plan->term_count; i++) {
        uint32_t kind = module->TERM_records[of_plan->term_first + i].kind;
        if (kind == TN_SUM_NEEDED || tn_term_is_gap(kind))
            return tn_refuse(checker, "sum %u of houses may have no value", sum);
    }
    for (uint32_t i = 0; status == TN_OK && i < count; i++)
        status = check_house_term(checker, &module->FORM_records[form], first + i);
    return status;
}

static tn_status check_measures_of_houses(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < module->HOUSE_MEASURE_count; i++) {
        const tn_house_measure_record *r = &module->HOUSE_MEASURE_records[i];
        status = check_added(checker, r->form, r->sum, r->term_first, r->term_count);
    }
    for (uint32_t i = 0; status == TN_OK && i < module->HOUSE_SUM_count; i++) {
        const tn_house_sum_record *r = &module->HOUSE_SUM_records[i];
        status = check_added(checker, r->form, r->sum, r->term_first, r->term_count);
    }
    return status == TN_OK ? tn_check_different(checker, &module->HOUSE_MEASURE_records->name,
                                                sizeof *module->HOUSE_MEASURE_records, module->HOUSE_MEASURE_count,
                                                "two measures of houses have the same name")
                           : status;
}

static bool has_length(const tn_checker *checker, uint32_t schema)
{
    const tn_schema_record *record = &checker->module->SCHEMA_records[schema];
    for (uint32_t i = 0; i < record->field_count; i++)
        if (checker->module->FIELD_records[record->field_first + i].kind == TN_FIELD_LENGTH)
            return true;
    return false;
}

static tn_status check_form(const tn_checker *checker, uint32_t index)
{
    const tn_module *module = checker->module;
    const tn_form_record *form = &module->FORM_records[index];
    tn_status status = TN_OK;
    if (!is_zone(checker, form->spine, form->schema) || !has_length(checker, form->schema))
        return tn_refuse(checker, "form %u has a spine that is not a zone, or trays without a length", index);
    if (form->wall % 2 || form->partition % 2)
        return tn_refuse(checker, "form %u has walls whose halves are not whole", index);
    if (form->way % 2 || (form->way > 0 && form->headroom < 1))
        return tn_refuse(checker, "form %u has ways whose halves are not whole, or without headroom", index);
    if (form->guard > 0 && form->way == 0)
        return tn_refuse(checker, "form %u has guards without ways", index);
    for (uint32_t i = 0; i < form->storey_count; i++)
        if (module->STOREY_records[form->storey_first + i].height <= form->deck)
            return tn_refuse(checker, "storey %u is not higher than its floor is thick", form->storey_first + i);
    for (uint32_t i = 0; status == TN_OK && i < form->choice_count; i++)
        status = check_choice(checker, form, form->choice_first + i);
    if (status == TN_OK)
        status = check_layers(checker, form);
    if (status == TN_OK)
        status = check_beams(checker, form);
    if (status == TN_OK)
        status = check_rules(checker, form);
    if (status == TN_OK)
        status = check_openings(checker, form);
    for (uint32_t i = 0; status == TN_OK && i < form->face_count; i++)
        status = check_face(checker, form, form->face_first + i);
    for (uint32_t i = 0; status == TN_OK && i < form->tile_count; i++)
        status = check_tile(checker, form, form->tile_first + i);
    for (uint32_t i = 0; status == TN_OK && i < form->material_count; i++)
        status = check_material(checker, form, form->material_first + i);
    for (uint32_t i = 0; status == TN_OK && i < form->classification_count; i++)
        status = check_classification(checker, form, form->classification_first + i);
    return status;
}

static tn_status verify(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    for (uint32_t i = 0; i < module->FORM_count; i++) {
        tn_status status = check_form(checker, i);
        if (status != TN_OK)
            return status;
    }
    tn_status status = check_rules_of_houses(checker);
    if (status == TN_OK)
        status = check_libraries_of_houses(checker);
    if (status == TN_OK)
        status = check_measures_of_houses(checker);
    return status == TN_OK ? tn_check_different(checker, &module->FORM_records->name, sizeof *module->FORM_records,
                                                module->FORM_count, "two forms have the same name")
                           : status;
}

static tn_status verify_function(const tn_checker *checker, uint32_t function)
{
    if (function_of(checker, function)->stack_max > TN_DECISION_STACK_MAX)
        return tn_refuse(checker, "a decision's stack passes %u", TN_DECISION_STACK_MAX);
    if (function_of(checker, function)->schema >= checker->module->SCHEMA_count)
        return tn_refuse(checker, "there is no schema %u", function_of(checker, function)->schema);
    return TN_OK;
}

static tn_status check_area(const tn_checker *checker, const tn_instruction *instruction)
{
    if (instruction->first < 0 || instruction->first >= TN_AREA_TEST_COUNT || instruction->second < 0)
        return tn_refuse(checker, "an area is compared in no known way");
    return TN_OK;
}

static tn_status check_ratio(const tn_checker *checker, const tn_instruction *instruction)
{
    int64_t of = instruction->second >> 32, to = instruction->second & UINT32_MAX;
    if (instruction->first < 0 || instruction->first >= TN_AREA_TEST_COUNT || of < 0 || of > TN_RATIO_MAX || to < 1 ||
        to > TN_RATIO_MAX)
        return tn_refuse(checker, "a glazing is compared in no known way");
    return TN_OK;
}

/* A lower function of the kind that the opcode asks for, and of the caller's schema. */
static tn_status check_decision(const tn_checker *checker, const tn_instruction *instruction)
{
    bool room = instruction->opcode == TN_OP_SOME_ROOM || instruction->opcode == TN_OP_ROOMS;
    tn_function_kind kind = instruction->opcode == TN_OP_SECTION_IS ? TN_FUNCTION_SECTION
                            : room                                  ? TN_FUNCTION_ROOM
                                                                    : TN_FUNCTION_CELL;
    uint32_t callee = (uint32_t)instruction->first;
    if (callee >= checker->record || !decides(checker, callee, kind, function_of(checker, checker->record)->schema))
        return tn_refuse(checker, "function %u does not decide on what is asked there", callee);
    return TN_OK;
}

static tn_status check_counted(const tn_checker *checker, const tn_instruction *instruction)
{
    if (function_of(checker, (uint32_t)instruction->second)->kind != TN_FUNCTION_CONDITION)
        return tn_refuse(checker, "function %u is no condition", (unsigned)instruction->second);
    return check_decision(checker, instruction);
}

/* Are its functions before the one that is checked? */
static bool is_lower(const tn_checker *checker, const tn_meeting_record *meeting)
{
    return meeting->first < checker->record &&
           (meeting->second == TN_NO_RECORD || meeting->second < checker->record) &&
           (meeting->through == TN_NO_RECORD || meeting->through < checker->record);
}

static tn_status check_meeting(const tn_checker *checker, const tn_instruction *instruction)
{
    const tn_meeting_record *meeting = &checker->module->MEETING_records[instruction->first];
    uint32_t schema = function_of(checker, checker->record)->schema;
    if (meeting->second == TN_NO_RECORD)
        return tn_refuse(checker, "meeting %u is of one kind of cells", (unsigned)instruction->first);
    if (!is_lower(checker, meeting) || !decides_on_cells(checker, meeting, schema))
        return tn_refuse(checker, "meeting %u asks a function that does not decide on cells",
                         (unsigned)instruction->first);
    return TN_OK;
}

/* What is compared is of the caller's schema, without `matches`; its functions are lower than the caller. */
static tn_status check_house_summed(const tn_checker *checker, const tn_instruction *instruction)
{
    const tn_module *module = checker->module;
    const tn_house_sum_record *compared = &module->HOUSE_SUM_records[instruction->first];
    const tn_sum_record *sum = &module->SUM_records[compared->sum];
    if (module->FORM_records[compared->form].schema != function_of(checker, checker->record)->schema)
        return tn_refuse(checker, "sum %u of houses is of another schema", (unsigned)instruction->first);
    bool lower = true;
    for (uint32_t i = 0; i < sum->term_count; i++) {
        const tn_term_record *term = &module->TERM_records[sum->term_first + i];
        lower = lower && term->part < checker->record && !tn_term_of_whole(term->kind) &&
                tn_term_region(term->kind) == TN_REGION_STRETCH;
    }
    for (uint32_t i = 0; i < compared->term_count; i++) {
        const tn_house_term_record *term = &module->HOUSE_TERM_records[compared->term_first + i];
        lower = lower && (term->part == TN_NO_RECORD || term->part < checker->record) &&
                (term->walk == TN_NO_RECORD || is_lower(checker, &module->MEETING_records[term->walk]));
    }
    return lower ? TN_OK
                 : tn_refuse(checker, "sum %u of houses has `matches`, or a function that is not a lower one",
                             (unsigned)instruction->first);
}

static void list_walk(tn_lister *lister, const tn_meeting_record *walk)
{
    fprintf(lister->out, " from function %u", walk->first);
    if (walk->second == TN_NO_RECORD)
        fputs(" to the outside", lister->out);
    else
        fprintf(lister->out, " to function %u", walk->second);
    if (walk->through != TN_NO_RECORD)
        fprintf(lister->out, " through function %u", walk->through);
}

static void list_house_summed(tn_lister *lister, const tn_instruction *instruction)
{
    static const char *const kinds[] = {"cells", "areas", "rooms", "cost", "longest walk", "shortest walk", "exits"};
    const tn_module *module = lister->module;
    const tn_house_sum_record *compared = &module->HOUSE_SUM_records[instruction->first];
    fprintf(lister->out, "house sum %u: ", (unsigned)instruction->first);
    tn_list_sum(lister, compared->sum);
    for (uint32_t i = 0; i < compared->term_count; i++) {
        const tn_house_term_record *term = &module->HOUSE_TERM_records[compared->term_first + i];
        fprintf(lister->out, " + %s %s", tn_text(module, term->factor), kinds[term->kind]);
        if (term->part != TN_NO_RECORD)
            fprintf(lister->out, " of function %u", term->part);
        if (term->walk != TN_NO_RECORD)
            list_walk(lister, &module->MEETING_records[term->walk]);
    }
}

static void list_area(tn_lister *lister, const tn_instruction *instruction)
{
    static const char *const signs[] = {"<", "<=", "=", "!=", ">=", ">"};
    fprintf(lister->out, "area %s %lld", signs[instruction->first], (long long)instruction->second);
}

static void list_ratio(tn_lister *lister, const tn_instruction *instruction)
{
    static const char *const signs[] = {"<", "<=", "=", "!=", ">=", ">"};
    fprintf(lister->out, "glazing %s %lld:%lld", signs[instruction->first], (long long)(instruction->second >> 32),
            (long long)(instruction->second & UINT32_MAX));
}

/* ---- rules and libraries of plans do not ask for houses */

static bool sum_asks(const tn_module *module, const tn_sum_record *sum, const bool *asking)
{
    for (uint32_t i = 0; i < sum->term_count; i++)
        if (asking[module->TERM_records[sum->term_first + i].part])
            return true;
    return false;
}

static bool code_asks(const tn_module *module, const tn_function_record *function, const bool *asking)
{
    for (uint32_t at = function->code_begin; at < function->code_end;) {
        tn_instruction instruction = tn_code_read(module->code, at);
        tn_operands operands = tn_code_operands((uint8_t)instruction.opcode);
        if (tn_code_asks_house(instruction.opcode) || (operands == TN_OPERANDS_FUNC && asking[instruction.first]) ||
            (operands == TN_OPERANDS_SUMMED && sum_asks(module, &module->SUM_records[instruction.first], asking)))
            return true;
        at += instruction.length;
    }
    return false;
}

/* Calls go to lower functions, so that one pass finds all that ask by way of others. */
static tn_status verify_after(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    bool *asking = calloc(module->FUNCTION_count + 1, sizeof *asking);
    tn_status status = asking ? TN_OK : tn_fail_memory(checker->error);
    for (size_t i = 0; asking && i < module->FUNCTION_count; i++)
        asking[i] = tn_function_kinds[module->FUNCTION_records[i].kind].code == TN_CODE_RULE &&
                    code_asks(module, &module->FUNCTION_records[i], asking);
    for (uint32_t i = 0; status == TN_OK && i < module->RULE_count; i++)
        if (asking[module->RULE_records[i].whole] || asking[module->RULE_records[i].holds])
            status = tn_refuse(checker, "rule %u is about plans and asks for houses", i);
    for (uint32_t i = 0; status == TN_OK && i < module->CLAUSE_count; i++)
        if (asking[module->CLAUSE_records[i].holds])
            status = tn_refuse(checker, "clause %u is about plans and asks for houses", i);
    for (uint32_t i = 0; status == TN_OK && i < module->MEASURE_count; i++)
        if (sum_asks(module, &module->SUM_records[module->MEASURE_records[i].sum], asking))
            status = tn_refuse(checker, "measure %u is about plans and asks for houses", i);
    for (uint32_t i = 0; status == TN_OK && i < module->HOUSE_MEASURE_count; i++)
        if (sum_asks(module, &module->SUM_records[module->HOUSE_MEASURE_records[i].sum], asking))
            status = tn_refuse(checker, "the plan's part of measure %u of houses asks for houses", i);
    for (uint32_t i = 0; status == TN_OK && i < module->HOUSE_SUM_count; i++)
        if (sum_asks(module, &module->SUM_records[module->HOUSE_SUM_records[i].sum], asking))
            status = tn_refuse(checker, "the plan's part of sum %u of houses asks for houses", i);
    free(asking);
    return status;
}

static const tn_section sections[] = {
    TN_SECTION_FORM,          TN_SECTION_STOREY,     TN_SECTION_CHOICE,     TN_SECTION_SHAPE,
    TN_SECTION_CELL_RULE,     TN_SECTION_OPENING,    TN_SECTION_FACE_LINE,  TN_SECTION_TILE,
    TN_SECTION_TILE_BOX,      TN_SECTION_SYMBOL_LINE,   TN_SECTION_HOUSE_ITEM, TN_SECTION_HOUSE_RULE, TN_SECTION_HOUSE_LIBRARY,
    TN_SECTION_HOUSE_CLAUSE,  TN_SECTION_MEETING,    TN_SECTION_MATERIAL,   TN_SECTION_LAYER,
    TN_SECTION_BEAM,          TN_SECTION_CLASSIFICATION, TN_SECTION_CLASS,
    TN_SECTION_HOUSE_MEASURE, TN_SECTION_HOUSE_TERM, TN_SECTION_HOUSE_SUM,  TN_SECTION_STRINGS};

static const tn_operand_rules operands[] = {
    {TN_OPERANDS_AREA, check_area, list_area},    {TN_OPERANDS_RATIO, check_ratio, list_ratio},
    {TN_OPERANDS_DECISION, check_decision, NULL}, {TN_OPERANDS_DECISION_COND, check_counted, NULL},
    {TN_OPERANDS_MEETING, check_meeting, NULL},   {TN_OPERANDS_HOUSE_SUMMED, check_house_summed, list_house_summed}};

extern const tn_engine tn_engine_house;
const tn_engine tn_engine_house = {.name = "house",
                                   .sections = sections,
                                   .codes = 1u << TN_CODE_HOUSE,
                                   .operands = operands,
                                   .operand_count = sizeof operands / sizeof *operands,
                                   .verify = verify,
                                   .verify_function = verify_function,
                                   .verify_after = verify_after};
