/* Answers what rules ask of a house: which stretches of its trays its cells, rooms, faces and walks make true. */
#include "runtime/house/rule/asked.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/house.h"
#include "runtime/house/rule/asked_data.h"
#include "runtime/plan/match/condition.h"
#include "runtime/plan/match/relation.h"

static void add(uint64_t *relation, size_t words, size_t begin, size_t end)
{
    tn_relation_row_set(relation + begin * words, end);
}

/* ---- cells and sections */

static void some_cell(const tn_house *house, uint32_t function, uint64_t *relation, size_t words)
{
    for (size_t i = 0; i < house->cell_count; i++)
        if (tn_house_decide(house, function, &house->cells[i]))
            add(relation, words, house->cells[i].tray, house->cells[i].tray + 1u);
}

static void section_is(const tn_house *house, uint32_t function, uint64_t *relation, size_t words)
{
    bool so = tn_house_decide(house, function, NULL);
    for (size_t i = 0; so && i < house->length; i++)
        for (size_t j = i + 1; j <= house->length; j++)
            add(relation, words, i, j);
}

bool tn_meeting_has(const tn_module *module, const tn_meeting_record *meeting, uint32_t kind)
{
    for (uint32_t i = 0; i < meeting->kind_count; i++)
        if (module->HOUSE_ITEM_records[meeting->kind_first + i].number == kind)
            return true;
    return meeting->kind_count == 0;
}

bool tn_face_meets(const tn_house *house, const tn_meeting_record *meeting, const tn_face *face)
{
    if (face->second == TN_NO_CELL || !tn_meeting_has(house->form->module, meeting, face->kind))
        return false;
    const tn_cell *a = &house->cells[face->first], *b = &house->cells[face->second];
    return (tn_house_decide(house, meeting->first, a) && tn_house_decide(house, meeting->second, b)) ||
           (tn_house_decide(house, meeting->first, b) && tn_house_decide(house, meeting->second, a));
}

static void meets(const tn_house *house, const tn_meeting_record *meeting, uint64_t *relation, size_t words)
{
    for (size_t i = 0; i < house->face_count; i++) {
        if (!tn_face_meets(house, meeting, &house->faces[i]))
            continue;
        uint32_t a = house->cells[house->faces[i].first].tray, b = house->cells[house->faces[i].second].tray;
        add(relation, words, a < b ? a : b, (a > b ? a : b) + 1u);
    }
}

/* ---- walks */

bool tn_walk_goes_through(const tn_house_form *form, const tn_meeting_record *walk, uint32_t kind)
{
    const tn_opening_record *opening = tn_form_opening(form, kind);
    return tn_meeting_has(form->module, walk, kind) &&
           (kind == TN_FACE_OPEN || (opening && opening->flags & TN_PASSAGE));
}

bool tn_house_is_step(const tn_house *house, const tn_meeting_record *walk, const tn_face *face)
{
    if (face->second == TN_NO_CELL || house->cells[face->first].open || house->cells[face->second].open)
        return false;
    if (face->relation != TN_FACE_UNDER)
        return tn_walk_goes_through(house->form, walk, face->kind);
    return tn_meeting_has(house->form->module, walk, face->kind) &&
           (face->kind == TN_FACE_STAIR || tn_form_flight(house->form, face->kind));
}

bool tn_cell_apart(tn_house_rules *rules, const tn_meeting_record *walk, uint32_t from)
{
    const tn_house *house = rules->house;
    size_t count = 0;
    if (tn_house_decide(house, walk->second, &house->cells[from]))
        return false;
    memset(rules->seen, 0, house->cell_count);
    rules->seen[from] = true;
    rules->todo[count++] = from;
    while (count > 0) {
        uint32_t at = rules->todo[--count];
        for (size_t i = 0; i < house->face_count; i++) {
            const tn_face *face = &house->faces[i];
            uint32_t next = face->first == at ? face->second : face->second == at ? face->first : TN_NO_CELL;
            if (next == TN_NO_CELL || rules->seen[next] || !tn_house_is_step(house, walk, face))
                continue;
            rules->seen[next] = true;
            if (tn_house_decide(house, walk->second, &house->cells[next]))
                return false;
            if (walk->through == TN_NO_RECORD || tn_house_decide(house, walk->through, &house->cells[next]))
                rules->todo[count++] = next;
        }
    }
    return true;
}

/* Of a cell: no walk is known from it to a goal; one is; one is, and walks from beside it can go on through it. */
enum { IS_APART, IS_NEAR, LEADS_ON };

/* Spreads from cells that lead on to those beside them. False: nothing changed. */
static bool spread(tn_house_rules *rules, const tn_meeting_record *walk)
{
    const tn_house *house = rules->house;
    bool changed = false;
    for (size_t i = 0; i < house->face_count; i++) {
        const tn_face *face = &house->faces[i];
        if (face->second == TN_NO_CELL)
            continue;
        uint8_t *a = &rules->near[face->first], *b = &rules->near[face->second];
        bool onward = *a == LEADS_ON && *b == IS_APART, back = *b == LEADS_ON && *a == IS_APART;
        if ((!onward && !back) || !tn_house_is_step(house, walk, face))
            continue;
        uint32_t to = onward ? face->second : face->first;
        bool through = walk->through == TN_NO_RECORD || tn_house_decide(house, walk->through, &house->cells[to]);
        rules->near[to] = through ? LEADS_ON : IS_NEAR;
        changed = true;
    }
    return changed;
}

/* All sources at once: from the goals backwards, as one can walk through a face both ways. */
static void apart(tn_house_rules *rules, const tn_meeting_record *walk, uint64_t *relation, size_t words)
{
    const tn_house *house = rules->house;
    for (uint32_t i = 0; i < house->cell_count; i++)
        rules->near[i] = tn_house_decide(house, walk->second, &house->cells[i]) ? LEADS_ON : IS_APART;
    while (spread(rules, walk))
        ;
    for (uint32_t i = 0; i < house->cell_count; i++) {
        const tn_cell *cell = &house->cells[i];
        if (!cell->open && rules->near[i] == IS_APART && tn_house_decide(house, walk->first, cell))
            add(relation, words, cell->tray, cell->tray + 1u);
    }
}

/* ---- rooms */

static void some_room(const tn_house_rules *rules, uint32_t function, uint64_t *relation, size_t words)
{
    for (size_t r = 0; r < rules->room_count; r++)
        if (tn_room_decide(rules, function, &rules->rooms[r]))
            add(relation, words, rules->rooms[r].begin, rules->rooms[r].end);
}

/* ---- what is counted */

/* Puts every stretch [begin, j) into the relation for which the condition holds of rules->sums[j] - sums[begin]. */
static void add_counted(const tn_house_rules *rules, uint32_t condition, size_t begin, uint64_t *relation, size_t words)
{
    for (size_t j = begin; j <= rules->house->length; j++)
        if (tn_condition_holds(rules->house->form->module, condition, rules->sums[j] - rules->sums[begin]))
            add(relation, words, begin, j);
}

static void count_cells(tn_house_rules *rules, const tn_instruction *op, uint64_t *relation, size_t words)
{
    const tn_house *house = rules->house;
    memset(rules->sums, 0, (house->length + 1) * sizeof *rules->sums);
    for (size_t i = 0; i < house->cell_count; i++)
        rules->sums[house->cells[i].tray + 1u] += tn_house_decide(house, (uint32_t)op->first, &house->cells[i]);
    for (size_t j = 0; j < house->length; j++)
        rules->sums[j + 1] += rules->sums[j];
    for (size_t i = 0; i <= house->length; i++)
        add_counted(rules, (uint32_t)op->second, i, relation, words);
}

/* Rooms that lie within [begin, j): each counts from its end on, for every beginning that is not after its own. */
static void count_rooms(tn_house_rules *rules, const tn_instruction *op, uint64_t *relation, size_t words)
{
    size_t length = rules->house->length;
    for (size_t i = 0; i <= length; i++) {
        memset(rules->sums, 0, (length + 1) * sizeof *rules->sums);
        for (size_t r = 0; r < rules->room_count; r++)
            if (rules->rooms[r].begin >= i)
                rules->sums[rules->rooms[r].end] += tn_room_decide(rules, (uint32_t)op->first, &rules->rooms[r]);
        for (size_t j = i; j < length; j++)
            rules->sums[j + 1] += rules->sums[j];
        add_counted(rules, (uint32_t)op->second, i, relation, words);
    }
}

/* In halves of a square micrometre; what is no whole one is the odd number between its neighbours. */
static int64_t halves(tn_int128 square_nanometres)
{
    enum { SQUARE_MICROMETRE = 1000000 };
    tn_int128 twice = square_nanometres / SQUARE_MICROMETRE * 2 + (square_nanometres % SQUARE_MICROMETRE != 0);
    return twice > INT64_MAX ? INT64_MAX : (int64_t)twice;
}

static tn_int128 area_of_tray(const tn_house *house, uint32_t function, size_t tray)
{
    tn_int128 area = 0;
    for (uint32_t i = house->tray_first[tray]; i < house->tray_first[tray + 1]; i++)
        if (!house->cells[i].open && tn_house_decide(house, function, &house->cells[i]))
            area += tn_cell_area(&house->cells[i]);
    return area;
}

static void add_areas(const tn_house_rules *rules, const tn_instruction *op, uint64_t *relation, size_t words)
{
    const tn_house *house = rules->house;
    for (size_t i = 0; i <= house->length; i++) {
        tn_int128 area = 0;
        for (size_t j = i; j <= house->length; j++) {
            if (tn_condition_holds(house->form->module, (uint32_t)op->second, halves(area)))
                add(relation, words, i, j);
            if (j < house->length)
                area += area_of_tray(house, (uint32_t)op->first, j);
        }
    }
}

/* ---- the whole */

static tn_status compare(tn_house_rules *rules, const tn_instruction *op, uint64_t *relation, size_t words,
                         tn_error *error)
{
    bool so = false;
    tn_status status = tn_house_compare(rules, op, &so, error);
    if (status == TN_OK && so)
        add(relation, words, 0, rules->house->length);
    return status;
}

static tn_status answer(void *context, const tn_instruction *op, uint64_t *relation, size_t words, tn_error *error)
{
    tn_house_rules *rules = context;
    const tn_house *house = rules->house;
    uint32_t first = (uint32_t)op->first;
    bool of_rooms = op->opcode == TN_OP_SOME_ROOM || op->opcode == TN_OP_ROOMS;
    tn_status status = of_rooms ? tn_rooms_gather(rules, error) : TN_OK;
    if (status != TN_OK)
        return status;
    switch (op->opcode) {
    case TN_OP_SOME_CELL:
        some_cell(house, first, relation, words);
        break;
    case TN_OP_SECTION_IS:
        section_is(house, first, relation, words);
        break;
    case TN_OP_SOME_ROOM:
        some_room(rules, first, relation, words);
        break;
    case TN_OP_MEETS:
        meets(house, &house->form->module->MEETING_records[first], relation, words);
        break;
    case TN_OP_APART:
        apart(rules, &house->form->module->MEETING_records[first], relation, words);
        break;
    case TN_OP_CELLS:
        count_cells(rules, op, relation, words);
        break;
    case TN_OP_ROOMS:
        count_rooms(rules, op, relation, words);
        break;
    case TN_OP_AREAS:
        add_areas(rules, op, relation, words);
        break;
    default:
        return compare(rules, op, relation, words, error);
    }
    return TN_OK;
}

tn_status tn_house_rules_new(const tn_house_form *form, size_t max_length, tn_house_rules **out, tn_error *error)
{
    tn_house_rules *rules = *out = calloc(1, sizeof *rules);
    if (!rules)
        return tn_fail_memory(error);
    rules->max_length = max_length;
    mpq_init(rules->cost);
    tn_status status = tn_plan_vm_new(form->schema, max_length, &rules->vm, error);
    if (status != TN_OK) {
        tn_house_rules_free(rules);
        *out = NULL;
    }
    return status;
}

void tn_house_rules_free(tn_house_rules *rules)
{
    if (!rules)
        return;
    tn_plan_vm_free(rules->vm);
    tn_plan_vm_free(rules->sums_vm);
    mpq_clear(rules->cost);
    free(rules->seen);
    free(rules->near);
    free(rules->todo);
    free(rules->sums);
    free(rules->rooms);
    free(rules->room_of);
    tn_walks_clear(&rules->walks);
    tn_walk_floors_clear(&rules->floors);
    free(rules);
}

void tn_house_rules_disable(tn_house_rules *rules, const uint32_t *offsets, size_t count)
{
    tn_plan_vm_disable(rules->vm, offsets, count);
}

static tn_status make_room(tn_house_rules *rules, const tn_house *house, tn_error *error)
{
    size_t needed = house->cell_count > house->length ? house->cell_count : house->length;
    if (rules->sums && needed < rules->capacity)
        return TN_OK;
    size_t capacity = 2 * needed + 32;
    rules->capacity = 0;
    if (!tn_array_resize((void **)&rules->seen, capacity, sizeof *rules->seen) ||
        !tn_array_resize((void **)&rules->near, capacity, sizeof *rules->near) ||
        !tn_array_resize((void **)&rules->todo, capacity, sizeof *rules->todo) ||
        !tn_array_resize((void **)&rules->rooms, capacity, sizeof *rules->rooms) ||
        !tn_array_resize((void **)&rules->sums, capacity, sizeof *rules->sums))
        return tn_fail_memory(error);
    rules->capacity = capacity;
    return TN_OK;
}

tn_status tn_house_rules_start(tn_house_rules *rules, const tn_house *house, tn_error *error)
{
    rules->house = house;
    tn_status status = make_room(rules, house, error);
    rules->gathered = rules->summed = rules->priced = rules->walked = false;
    if (status == TN_OK)
        status = tn_plan_vm_plan(rules->vm, house->trays, house->length, error);
    if (status == TN_OK)
        tn_plan_vm_house(rules->vm, answer, rules);
    return status;
}

tn_status tn_house_rules_hold(tn_house_rules *rules, uint32_t function, bool *holds, tn_error *error)
{
    return tn_plan_vm_holds(rules->vm, function, holds, error);
}

tn_status tn_house_rules_drop(tn_house_rules *rules, const tn_house_library_record *library, uint32_t clause,
                              bool *drops, tn_error *error)
{
    const tn_house_clause_record *record =
        &rules->house->form->module->HOUSE_CLAUSE_records[library->clause_first + clause];
    tn_status status = tn_house_rules_hold(rules, record->holds, drops, error);
    *drops = *drops == (record->kind == TN_CLAUSE_PRUNE);
    return status;
}

tn_status tn_house_rules_keep(tn_house_rules *rules, const tn_house_library_record *library, bool *kept,
                              tn_error *error)
{
    tn_status status = TN_OK;
    bool drops = false;
    for (uint32_t i = 0; status == TN_OK && !drops && i < library->clause_count; i++)
        status = tn_house_rules_drop(rules, library, i, &drops, error);
    *kept = !drops;
    return status;
}
