/* Decides on cells and sections by running their code, and from that what may be in a cell or a face. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/ways.h"
#include "runtime/module/code.h"

/* ---- code */

bool tn_area_compares(tn_int128 area, int64_t test, int64_t square_micrometres)
{
    tn_int128 other = (tn_int128)square_micrometres * 1000000;
    switch ((tn_area_test)test) {
    case TN_AREA_LESS:
        return area < other;
    case TN_AREA_AT_MOST:
        return area <= other;
    case TN_AREA_EQUAL:
        return area == other;
    case TN_AREA_UNEQUAL:
        return area != other;
    case TN_AREA_AT_LEAST:
        return area >= other;
    case TN_AREA_GREATER:
    case TN_AREA_TEST_COUNT:
        break;
    }
    return area > other;
}

/* Is the section's value of some choice this SHAPE record? */
bool tn_house_chosen(const tn_house *house, int64_t shape)
{
    const tn_house_form *form = house->form;
    for (uint32_t i = 0; i < form->record->choice_count; i++)
        if ((int64_t)tn_form_choice(form, i)->shape_first + house->shapes[i] == shape)
            return true;
    return false;
}

typedef struct tn_asked_cell {
    const tn_house *house;
    const tn_cell *cell; /* NULL: the section alone */
} tn_asked_cell;

/* What asks for a cell is false of a section, and what asks for a room is false of a cell. */
static bool ask_cell(const void *context, const tn_instruction *instruction)
{
    const tn_asked_cell *asked = context;
    const tn_house *house = asked->house;
    const tn_cell *cell = asked->cell;
    const tn_house_form *form = house->form;
    if (instruction->opcode == TN_OP_EVERY)
        return true;
    if (instruction->opcode == TN_OP_CHOSEN)
        return tn_house_chosen(house, instruction->first);
    if (!cell)
        return false;
    switch (instruction->opcode) {
    case TN_OP_IN_TRAY:
        return tn_spec_meets(form->schema, (uint32_t)instruction->first, house->trays[cell->tray]);
    case TN_OP_IN_ZONE:
        return form->schema->record->field_first + (int64_t)cell->zone == instruction->first;
    case TN_OP_IN_STOREY:
        return form->record->storey_first + (int64_t)cell->storey == instruction->first;
    case TN_OP_IS_FOR:
        return cell->function != TN_NO_FUNCTION &&
               form->record->rule_first + (int64_t)cell->function == instruction->first;
    case TN_OP_IS_VOID:
        return cell->open;
    case TN_OP_HAS_AREA:
        return tn_area_compares(tn_cell_area(cell), instruction->first, instruction->second);
    default:
        return false;
    }
}

bool tn_decision_run(const tn_module *module, uint32_t function, tn_decision_ask *ask, const void *context)
{
    bool stack[TN_DECISION_STACK_MAX];
    size_t depth = 0;
    uint32_t at = module->FUNCTION_records[function].code_begin;
    for (;;) {
        switch (module->code[at++]) { /* these have no operands */
        case TN_OP_ALL_OF:
            depth--;
            stack[depth - 1] = stack[depth - 1] && stack[depth];
            break;
        case TN_OP_ONE_OF:
            depth--;
            stack[depth - 1] = stack[depth - 1] || stack[depth];
            break;
        case TN_OP_NONE_OF:
            stack[depth - 1] = !stack[depth - 1];
            break;
        case TN_OP_DECIDE:
            return stack[depth - 1];
        default: {
            tn_instruction instruction = tn_code_read(module->code, --at);
            at += instruction.length;
            stack[depth++] = ask(context, &instruction);
        }
        }
    }
}

/* Where the answer is kept; NULL where it is not. */
static uint8_t *known_answer(const tn_house *house, uint32_t function, const tn_cell *cell)
{
    const tn_house_known *known = house->known;
    if (!known || !cell || known->place[function] == TN_NO_RECORD)
        return NULL;
    size_t of = cell->function == TN_NO_FUNCTION ? known->functions : cell->function;
    if (known->alone[function])
        return &known->of_function[of * known->alones + known->place[function]];
    size_t at = (size_t)((uintptr_t)cell - (uintptr_t)house->cells) / sizeof *cell;
    if (at >= house->cell_count)
        return NULL; /* a cell that is none of the house's */
    return &known->answers[(at * (known->functions + 1) + of) * known->decisions + known->place[function]];
}

bool tn_house_decide(const tn_house *house, uint32_t function, const tn_cell *cell)
{
    enum { UNKNOWN, NO, YES };
    tn_asked_cell asked = {house, cell};
    uint8_t *answer = known_answer(house, function, cell);
    if (answer && *answer != UNKNOWN)
        return *answer == YES;
    bool decided = tn_decision_run(house->form->module, function, ask_cell, &asked);
    if (answer)
        *answer = decided ? YES : NO;
    return decided;
}

/* Does the decision ask for nothing but the cell's function? */
static bool asks_function_alone(const tn_module *module, uint32_t function)
{
    bool alone = true;
    for (uint32_t at = module->FUNCTION_records[function].code_begin; alone;) {
        tn_instruction instruction = tn_code_read(module->code, at);
        at += instruction.length;
        switch (instruction.opcode) {
        case TN_OP_DECIDE:
            return true;
        case TN_OP_ALL_OF:
        case TN_OP_ONE_OF:
        case TN_OP_NONE_OF:
        case TN_OP_EVERY:
        case TN_OP_IS_FOR:
            break;
        default:
            alone = false;
        }
    }
    return false;
}

tn_status tn_house_known_begin(const tn_house_form *form, tn_house_known *known, tn_error *error)
{
    const tn_module *module = form->module;
    *known = (tn_house_known){.functions = tn_form_functions(form)};
    known->place = malloc((module->FUNCTION_count + 1) * sizeof *known->place);
    known->alone = calloc(module->FUNCTION_count + 1, sizeof *known->alone);
    if (!known->place || !known->alone)
        return tn_fail_memory(error);
    for (uint32_t f = 0; f < module->FUNCTION_count; f++) {
        known->place[f] = TN_NO_RECORD;
        if (module->FUNCTION_records[f].kind != TN_FUNCTION_CELL)
            continue;
        known->alone[f] = asks_function_alone(module, f);
        known->place[f] = (uint32_t)(known->alone[f] ? known->alones++ : known->decisions++);
    }
    known->of_function = calloc(tn_size_of(known->functions + 1, known->alones) + 1, sizeof *known->of_function);
    return known->of_function ? TN_OK : tn_fail_memory(error);
}

void tn_house_known_clear(tn_house_known *known)
{
    free(known->place);
    free(known->alone);
    free(known->answers);
    free(known->of_function);
    *known = (tn_house_known){0};
}

tn_status tn_house_known_use(tn_house_known *known, tn_house *house, tn_error *error)
{
    size_t of_cell = (known->functions + 1) * known->decisions;
    house->known = NULL;
    if (of_cell > 0 && house->cell_count > TN_KNOWN_ANSWERS_MAX / of_cell)
        return TN_OK;
    if (!tn_array_reserve(&known->answers, &known->room, 0, house->cell_count * of_cell + 1, sizeof *known->answers))
        return tn_fail_memory(error);
    memset(known->answers, 0, house->cell_count * of_cell);
    house->known = known;
    return TN_OK;
}

bool tn_house_section_stands(const tn_house *house)
{
    const tn_house_form *form = house->form;
    for (uint32_t i = form->kinds_end[TN_CELL_NO]; i < form->kinds_end[TN_CELL_FORBID]; i++)
        if (tn_house_decide(house, tn_form_rule(form, i)->decides, NULL))
            return false;
    return true;
}

bool tn_cell_may(const tn_house *house, const tn_cell *cell, uint32_t function)
{
    return !cell->open && tn_house_decide(house, tn_form_rule(house->form, function)->decides, cell);
}

/* ---- cells in the open */

bool tn_cell_is_outdoor(const tn_house *house, uint32_t cell)
{
    if (!house->form->has_outdoor)
        return false;
    while (cell > 0 && house->cells[cell].open) /* the cell below comes before */
        cell--;
    uint32_t function = house->cells[cell].function;
    return function != TN_NO_FUNCTION && tn_form_is_outdoor(house->form, function);
}

bool tn_face_is_outer(const tn_house *house, const tn_face *face)
{
    return face->relation == TN_FACE_OUTSIDE ||
           (face->relation == TN_FACE_BESIDE &&
            (tn_cell_is_outdoor(house, face->first) || tn_cell_is_outdoor(house, face->second)));
}

uint32_t tn_face_sheltered(const tn_house *house, const tn_face *face)
{
    if (face->relation == TN_FACE_OUTSIDE)
        return face->first;
    if (face->relation == TN_FACE_UNDER)
        return TN_NO_CELL;
    bool first = tn_cell_is_outdoor(house, face->first), second = tn_cell_is_outdoor(house, face->second);
    return first == second ? TN_NO_CELL : first ? face->second : face->first;
}

/* ---- faces */

static int64_t wide_of(const tn_face *face)
{
    int64_t x = face->at.x1 - face->at.x0, y = face->at.y1 - face->at.y0;
    return x > y ? x : y;
}

/* Does a lower roof stand above the sill of the opening, somewhere along it? NULL: of an open side, which is as wide as
 * the face. Heights above the lowest floor; *top is set if there is a lower roof. */
static bool lower_roof_covers(const tn_house *house, const tn_face *face, const tn_opening_record *opening,
                              int64_t *sill, tn_fraction *top)
{
    *sill = house->form->level[face->storey] + (opening ? opening->sill : 0);
    return tn_face_roofed(house, face, opening, top) && top->top > *sill * top->bottom;
}

/* Is the face as wide and high as the opening needs: with half a wall at either side, and a deck above? */
static bool has_room(const tn_house *house, const tn_face *face, const tn_opening_record *opening)
{
    return tn_opening_needs(house->form, opening, face->at.y0 == face->at.y1) <= wide_of(face) &&
           opening->sill + opening->high <= tn_form_clear(house->form, face->storey);
}

/* Does the kind fit into the face? An opening has room there, and no lower roof stands above its sill. Nor does one
 * stand above the floor where a side is open. */
static bool fits(const tn_house *house, const tn_face *face, uint32_t kind)
{
    const tn_opening_record *opening = tn_form_opening(house->form, kind), *flight = tn_form_flight(house->form, kind);
    if (flight)
        return tn_flight_fits(house, face, flight);
    if (!opening && (kind != TN_FACE_OPEN || face->relation != TN_FACE_OUTSIDE))
        return true;
    tn_fraction top;
    int64_t sill;
    return (!opening || has_room(house, face, opening)) && !lower_roof_covers(house, face, opening, &sill, &top);
}

/* Are all the faces of such a relation and side the line's, whatever their cells are? */
static inline bool is_placed(const tn_face_line_record *line, const tn_face *face)
{
    bool along = face->side == TN_HOUSE_LEFT || face->side == TN_HOUSE_RIGHT;
    switch (face->relation) {
    case TN_FACE_BESIDE:
        return line->relation == TN_FACE_BESIDE || line->relation == (along ? TN_FACE_ALONG : TN_FACE_ACROSS);
    case TN_FACE_OUTSIDE:
        return line->relation == TN_FACE_OUTSIDE &&
               (line->side == TN_HOUSE_ANY_SIDE || line->side == (uint32_t)face->side);
    default:
        return line->relation == (uint32_t)face->relation;
    }
}

static bool has_cells(const tn_house *house, const tn_face_line_record *line, const tn_face *face)
{
    const tn_cell *first = &house->cells[face->first];
    if (face->relation == TN_FACE_OUTSIDE)
        return tn_house_decide(house, line->first, first);
    const tn_cell *second = &house->cells[face->second];
    if (tn_house_decide(house, line->first, first) && tn_house_decide(house, line->second, second))
        return true;
    bool either = line->relation == TN_FACE_BESIDE || line->relation == TN_FACE_ACROSS;
    return either && tn_house_decide(house, line->first, second) && tn_house_decide(house, line->second, first);
}

/* Is a form's line of faces about the face? All functions are given. */
static bool line_is_about(const tn_house *house, const tn_face_line_record *line, const tn_face *face)
{
    return is_placed(line, face) && has_cells(house, line, face);
}

/* Is a line outside about the face, which is an outside face of this cell beside one in the open? */
static bool line_is_outside(const tn_house *house, const tn_face_line_record *line, const tn_face *face, uint32_t cell)
{
    return line->relation == TN_FACE_OUTSIDE &&
           (line->side == TN_HOUSE_ANY_SIDE || line->side == (uint32_t)tn_face_side(face, cell)) &&
           tn_house_decide(house, line->first, &house->cells[cell]);
}

/* The first line from `from` on that is asked of the face; TN_NO_RECORD behind the last. Of a face beside a cell in the
 * open, those are the lines that name both of its cells; then, if the other is not in the open, those outside of that
 * one, as numbers from face_count on. */
static uint32_t next_line(const tn_house *house, const tn_face *face, uint32_t from)
{
    const tn_house_form *form = house->form;
    const tn_face_line_record *lines = &form->module->FACE_LINE_records[form->record->face_first];
    uint32_t count = form->record->face_count;
    bool open = face->relation == TN_FACE_BESIDE && tn_face_is_outer(house, face);
    for (uint32_t i = from; i < count; i++)
        if (line_is_about(house, &lines[i], face) && (!open || tn_form_names_both(form, &lines[i])))
            return i;
    uint32_t cell = open ? tn_face_sheltered(house, face) : TN_NO_CELL;
    for (uint32_t i = from > count ? from - count : 0; cell != TN_NO_CELL && i < count; i++)
        if (line_is_outside(house, &lines[i], face, cell))
            return count + i;
    return TN_NO_RECORD;
}

/* What is in a face of which no line says anything. */
static uint32_t kind_without_line(const tn_house *house, const tn_face *face)
{
    if (face->relation == TN_FACE_UNDER)
        return TN_FACE_FLOOR;
    bool open = tn_face_is_outer(house, face) && tn_face_sheltered(house, face) == TN_NO_CELL;
    return open ? TN_FACE_OPEN : TN_FACE_WALL;
}

/* A void is always open to what is below it. */
size_t tn_face_decided(const tn_house *house, const tn_face *face, uint32_t kinds[TN_FACE_KINDS_MAX], uint32_t *decides)
{
    const tn_house_form *form = house->form;
    size_t count = 0;
    *decides = TN_NO_RECORD;
    if (face->relation == TN_FACE_UNDER && house->cells[face->second].open) {
        kinds[0] = TN_FACE_OPEN;
        return 1;
    }
    uint32_t lines = form->record->face_count;
    for (uint32_t at = next_line(house, face, 0); count == 0 && at != TN_NO_RECORD;
         at = next_line(house, face, at + 1)) {
        uint32_t i = at < lines ? at : at - lines;
        const tn_face_line_record *line = &form->module->FACE_LINE_records[form->record->face_first + i];
        for (uint32_t k = 0; k < line->kind_count && count < TN_FACE_KINDS_MAX; k++) {
            uint32_t kind = form->module->HOUSE_ITEM_records[line->kind_first + k].number;
            if (fits(house, face, kind))
                kinds[count++] = kind;
        }
        if (count > 0)
            *decides = i;
    }
    if (count == 0)
        kinds[count++] = kind_without_line(house, face);
    return count;
}

uint32_t tn_face_leaf(const tn_house *house, const tn_face *face)
{
    const tn_opening_record *opening = tn_form_opening(house->form, face->kind);
    uint32_t kinds[TN_FACE_KINDS_MAX], number;
    if (!opening || !(opening->flags & TN_PASSAGE) || opening->flags & (TN_LEAFLESS | TN_SLIDING))
        return TN_NO_CELL;
    if (face->relation == TN_FACE_OUTSIDE)
        return face->first;
    tn_face_decided(house, face, kinds, &number);
    if (number == TN_NO_RECORD)
        return face->first;
    const tn_face_line_record *line = &house->form->module->FACE_LINE_records[house->form->record->face_first + number];
    if (line->relation == TN_FACE_OUTSIDE)
        return tn_face_sheltered(house, face);
    bool as_written = tn_house_decide(house, line->first, &house->cells[face->first]) &&
                      tn_house_decide(house, line->second, &house->cells[face->second]);
    return as_written ? face->first : face->second;
}

size_t tn_face_options(const tn_house *house, const tn_face *face, uint32_t kinds[TN_FACE_KINDS_MAX])
{
    uint32_t line;
    return tn_face_decided(house, face, kinds, &line);
}

int64_t tn_face_thickness(const tn_house *house, const tn_face *face)
{
    if (face->relation == TN_FACE_UNDER || face->kind == TN_FACE_OPEN)
        return 0;
    bool thick = face->kind == TN_FACE_PARTY || tn_face_is_outer(house, face);
    return thick ? house->form->record->wall : house->form->record->partition;
}

/* ---- which openings a lower roof keeps out of a face, and by how much */

static bool is_behind(const tn_house *house, const tn_face *face, uint32_t kind, tn_behind_roof *behind)
{
    const tn_opening_record *opening = tn_form_opening(house->form, kind);
    if (opening ? !has_room(house, face, opening) : kind != TN_FACE_OPEN)
        return false;
    behind->kind = kind;
    return lower_roof_covers(house, face, opening, &behind->sill, &behind->top);
}

bool tn_face_behind_roof(const tn_house *house, const tn_face *face, uint32_t kind, tn_behind_roof *behind)
{
    const tn_house_form *form = house->form;
    uint32_t kinds[TN_FACE_KINDS_MAX], last;
    tn_face_decided(house, face, kinds, &last);
    if (face->relation != TN_FACE_OUTSIDE)
        return false;
    for (uint32_t i = 0; i < form->record->face_count && (last == TN_NO_RECORD || i <= last); i++) {
        const tn_face_line_record *line = &form->module->FACE_LINE_records[form->record->face_first + i];
        for (uint32_t k = 0; line_is_about(house, line, face) && k < line->kind_count; k++) {
            uint32_t other = form->module->HOUSE_ITEM_records[line->kind_first + k].number;
            if ((kind == TN_NO_RECORD || kind == other) && is_behind(house, face, other, behind))
                return true;
        }
    }
    return false;
}

tn_length_style tn_house_length_style(const tn_house *house)
{
    const tn_schema *schema = house->form->schema;
    return tn_length_style_of(tn_text(schema->module, schema->values[schema->value_start[house->form->width]].name));
}

void tn_behind_roof_text(const tn_house *house, const tn_behind_roof *behind, char *text, size_t size)
{
    tn_length_style style = tn_house_length_style(house);
    tn_int128 step = style == TN_STYLE_FEET ? TN_INCH_NM / 64 : 1000000, part = step * behind->top.bottom;
    char sill[64], top[64];
    tn_length_write_style(behind->sill, style, sill, sizeof sill);
    tn_length_write_style((int64_t)((behind->top.top + part - 1) / part * step), style, top, sizeof top);
    snprintf(text, size, "its %s is %s above the lowest floor, and the roof there reaches %s",
             behind->kind == TN_FACE_OPEN ? "floor" : "sill", sill, top);
}
