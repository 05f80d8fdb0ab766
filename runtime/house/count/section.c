/* Finds what can be told of a section. */
#include "runtime/house/count/section.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/house/form/form.h"
#include "runtime/house/rule/stages.h"
#include "runtime/house/solids.h"

static void add_question(tn_sections *sections, int64_t question)
{
    for (size_t i = 0; i < sections->question_count; i++)
        if (sections->questions[i] == question)
            return;
    if (sections->question_count == TN_SECTION_QUESTIONS_MAX)
        sections->apart = true;
    else
        sections->questions[sections->question_count++] = question;
}

static void add_questions(const tn_module *module, uint32_t function, tn_sections *sections)
{
    const tn_function_record *f = &module->FUNCTION_records[function];
    if (tn_function_kinds[f->kind].code != TN_CODE_HOUSE)
        return;
    for (uint32_t at = f->code_begin; at < f->code_end;) {
        tn_instruction op = tn_code_read(module->code, at);
        if (op.opcode == TN_OP_CHOSEN)
            add_question(sections, op.first);
        at += op.length;
    }
}

/* What only `forbid` asks: sections that stand all answer it alike. */
static void mark_forbids(const tn_house_form *form, bool *forbids, bool *named)
{
    const tn_module *module = form->module;
    for (uint32_t i = 0; i < form->kinds_end[TN_CELL_FORBID]; i++)
        (i < form->kinds_end[TN_CELL_NO] ? named : forbids)[tn_form_rule(form, i)->decides] = true;
    for (uint32_t f = 0; f < module->FUNCTION_count; f++) {
        const tn_function_record *function = &module->FUNCTION_records[f];
        tn_code_kind code = tn_function_kinds[function->kind].code;
        for (uint32_t at = function->code_begin;
             (code == TN_CODE_RULE || code == TN_CODE_HOUSE) && at < function->code_end;) {
            tn_instruction op = tn_code_read(module->code, at);
            tn_mark_operands(module, &op, named);
            at += op.length;
        }
    }
}

tn_status tn_sections_begin(const tn_house_form *form, tn_sections *sections, tn_error *error)
{
    const tn_module *module = form->module;
    bool *forbids = calloc(2 * module->FUNCTION_count + 1, sizeof *forbids), *named = forbids + module->FUNCTION_count;
    *sections = (tn_sections){0};
    if (!forbids)
        return tn_fail_memory(error);
    mark_forbids(form, forbids, named);
    for (uint32_t f = 0; f < module->FUNCTION_count; f++)
        if (!forbids[f] || named[f])
            add_questions(module, f, sections);
    free(forbids);
    return TN_OK;
}

static uint32_t storeys_of(const tn_house *house, uint32_t zone)
{
    const tn_shape_record *shape = tn_house_shape(house, zone, TN_CHOICE_STOREYS);
    return shape ? shape->storeys : house->form->record->storey_count;
}

/* Can the roof of a zone stand before an opening of a higher storey? */
static bool may_be_lower(const tn_house *house, uint32_t zone)
{
    const tn_house_form *form = house->form;
    uint32_t most = 0;
    for (uint32_t z = 0; z < form->zone_count; z++) {
        uint32_t storeys = storeys_of(house, form->zones[z]);
        most = storeys > most ? storeys : most;
    }
    return storeys_of(house, zone) < most;
}

static int64_t longest(const tn_schema *schema, uint32_t field)
{
    int64_t most = 0;
    for (uint32_t v = schema->value_start[field]; v < schema->value_start[field + 1]; v++)
        most = schema->values[v].length > most ? schema->values[v].length : most;
    return most;
}

/* How many sills that an outside face may have, from a storey upwards, are below a height of top / bottom. */
static uint32_t sills_below(const tn_house_form *form, uint32_t storey, tn_int128 top, tn_int128 bottom)
{
    uint32_t below = 0;
    for (uint32_t i = 0; i < form->record->face_count; i++) {
        const tn_face_line_record *line = &form->module->FACE_LINE_records[form->record->face_first + i];
        for (uint32_t k = 0; line->relation == TN_FACE_OUTSIDE && k < line->kind_count; k++) {
            uint32_t kind = form->module->HOUSE_ITEM_records[line->kind_first + k].number;
            const tn_opening_record *opening = tn_form_opening(form, kind);
            bool has_sill = opening || kind == TN_FACE_OPEN; /* an open side has its floor for one */
            for (uint32_t s = storey; has_sill && s < form->record->storey_count; s++)
                below += ((tn_int128)form->level[s] + (opening ? opening->sill : 0)) * bottom < top;
        }
    }
    return below;
}

/* What openings can tell of the roof of a zone that is lower than others: where no sill is between its lowest and its
 * highest point, only how many sills are below it; otherwise the shape itself. */
static uint32_t roof_seen(const tn_house *house, uint32_t zone, uint32_t shape)
{
    const tn_house_form *form = house->form;
    uint32_t storeys = storeys_of(house, zone);
    tn_cell cell = {.zone = zone, .storey = storeys - 1};
    cell.at = (tn_rectangle){0, longest(form->schema, form->width), 0, longest(form->schema, zone)};
    tn_slopes slopes = tn_roof_slopes(house, &cell); /* of the largest cell: no other is higher */
    int64_t base = form->level[storeys] + form->record->roof;
    tn_fraction top = tn_slopes_highest(&slopes, tn_cell_grown(house, &cell), base);
    uint32_t below = sills_below(form, storeys, base, 1);
    bool alike = below == sills_below(form, storeys, top.top, top.bottom);
    return alike ? UINT32_MAX - below : shape;
}

/* What can matter of a choice to what fits into faces. */
static uint32_t shape_seen(const tn_house *house, uint32_t i)
{
    const tn_choice_record *choice = tn_form_choice(house->form, i);
    uint32_t zone = choice->zone - house->form->schema->record->field_first;
    if (choice->kind == TN_CHOICE_STOREYS)
        return house->shapes[i];
    if (choice->kind != TN_CHOICE_ROOF)
        return 0;
    if (house->form->kinds_end[TN_CELL_NO] > house->form->kinds_end[TN_CELL_NO - 1])
        return house->shapes[i]; /* the zone may end below its storeys */
    return may_be_lower(house, zone) ? roof_seen(house, zone, house->shapes[i]) : 0;
}

tn_section_key tn_sections_key(const tn_sections *sections, const tn_house *house)
{
    tn_section_key key;
    memset(&key, 0, sizeof key);
    for (uint32_t i = 0; i < house->form->record->choice_count; i++)
        key.shapes[i] = sections->apart ? house->shapes[i] : shape_seen(house, i);
    for (size_t i = 0; i < sections->question_count; i++)
        key.answers |= (uint64_t)tn_house_chosen(house, sections->questions[i]) << i;
    return key;
}
