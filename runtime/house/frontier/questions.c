/* Finds what is asked of houses: decisions on cells, rooms, meetings, walks. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/parts.h"

tn_status tn_strip_limit(const tn_strip *strip, const char *clause, const char *what, tn_error *error)
{
    (void)strip;
    if (clause)
        tn_fail(error, TN_LIMIT, E_STRIP, "`%.60s` %s: the houses of all plans together cannot be counted", clause,
                what);
    else
        tn_fail(error, TN_LIMIT, E_STRIP, "%s: the houses of all plans together cannot be counted", what);
    tn_error_help(error, "ask about one plan (--plan PLAN or '#P'), or name a house by #P:V");
    return TN_LIMIT;
}

static tn_status add_decision(tn_strip *strip, uint32_t function, tn_error *error)
{
    tn_strip_questions *q = &strip->questions;
    for (size_t i = 0; i < q->decision_count; i++)
        if (q->decisions[i] == function)
            return TN_OK;
    if (!tn_array_reserve(&q->decisions, &q->decision_room, q->decision_count, 1, sizeof *q->decisions))
        return tn_fail_memory(error);
    q->decisions[q->decision_count++] = function;
    return TN_OK;
}

static size_t decision_of(const tn_strip *strip, uint32_t function)
{
    size_t i = 0;
    while (strip->questions.decisions[i] != function)
        i++;
    return i;
}

static tn_status add_meeting(tn_strip *strip, uint32_t index, tn_error *error)
{
    const tn_meeting_record *m = &strip->form->module->MEETING_records[index];
    tn_status status = add_decision(strip, m->first, error);
    if (status == TN_OK)
        status = add_decision(strip, m->second, error);
    return status == TN_OK && m->through != TN_NO_RECORD ? add_decision(strip, m->through, error) : status;
}

/* ---- what clauses ask */

typedef struct tn_asking {
    tn_strip *strip;
    tn_strip_clause *clause;
    const char *name;
} tn_asking;

static uint32_t find(const uint32_t *items, uint32_t count, uint32_t item)
{
    uint32_t i = 0;
    while (i < count && items[i] != item)
        i++;
    return i;
}

static tn_status find_or_add(const tn_asking *a, uint32_t *items, uint32_t *count, uint32_t most, uint32_t item,
                             uint32_t *at, tn_error *error)
{
    *at = find(items, *count, item);
    if (*at == *count && *count == most)
        return tn_strip_limit(a->strip, a->name, "asks for more than can be told apart at once", error);
    items[*at] = item;
    *count += *at == *count;
    return TN_OK;
}

static tn_status add_ratio(const tn_asking *a, int64_t ratio, tn_strip_room *room, tn_error *error)
{
    tn_strip_questions *q = &a->strip->questions;
    uint32_t at = 0;
    while (at < q->ratio_count && q->ratios[at] != ratio)
        at++;
    if (at == TN_STRIP_RATIOS_MAX)
        return tn_strip_limit(a->strip, a->name, "asks for more ratios of glass than can be told apart at once", error);
    q->ratios[at] = ratio;
    q->ratio_count += at == q->ratio_count;
    room->ratios |= 1u << at;
    return TN_OK;
}

/* One instruction about a room. */
static tn_status add_room_part(const tn_asking *a, const tn_instruction *op, tn_strip_room *room, tn_error *error)
{
    tn_strip_questions *q = &a->strip->questions;
    uint32_t at;
    tn_status status;
    tn_int128 most = (tn_int128)op->second * 1000000 + 1;
    switch (op->opcode) {
    case TN_OP_ALL_CELLS:
        status = find_or_add(a, q->all, &q->all_count, 64, (uint32_t)op->first, &at, error);
        room->all |= status == TN_OK ? UINT64_C(1) << at : 0;
        return status == TN_OK ? add_decision(a->strip, (uint32_t)op->first, error) : status;
    case TN_OP_HAS_FACE:
        status = find_or_add(a, q->kinds, &q->kind_count, TN_STRIP_KINDS_MAX, (uint32_t)op->first, &at, error);
        room->kinds |= status == TN_OK ? UINT64_C(1) << at : 0;
        return status;
    case TN_OP_ROOM_AREA:
        room->area = true;
        q->area_most = most > q->area_most ? most : q->area_most;
        return TN_OK;
    case TN_OP_ROOM_CELLS:
        room->cells = true;
        q->cells_most = op->second + 1 > q->cells_most ? (uint32_t)(op->second + 1) : q->cells_most;
        return TN_OK;
    case TN_OP_ROOM_GLAZING:
        return add_ratio(a, op->second, room, error);
    case TN_OP_EVERY:
    case TN_OP_ALL_OF:
    case TN_OP_ONE_OF:
    case TN_OP_NONE_OF:
    case TN_OP_DECIDE:
        return TN_OK;
    default:
        return tn_strip_limit(a->strip, a->name, "asks for more than the cells, the faces and the area of rooms",
                              error);
    }
}

static tn_status add_room(const tn_asking *a, uint32_t function, uint32_t *at, tn_error *error)
{
    tn_strip_questions *q = &a->strip->questions;
    const tn_module *module = a->strip->form->module;
    for (*at = 0; *at < q->room_count; ++*at)
        if (q->rooms[*at].function == function)
            return TN_OK;
    if (q->room_count == TN_STRIP_QUESTIONS_MAX)
        return tn_strip_limit(a->strip, a->name, "is about more kinds of rooms than can be told apart at once", error);
    tn_strip_room *room = &q->rooms[q->room_count++];
    *room = (tn_strip_room){.function = function};
    tn_status status = TN_OK;
    for (uint32_t c = module->FUNCTION_records[function].code_begin;
         status == TN_OK && c < module->FUNCTION_records[function].code_end;) {
        tn_instruction op = tn_code_read(module->code, c);
        status = add_room_part(a, &op, room, error);
        c += op.length;
    }
    return status;
}

static tn_strip_atom *find_atom(const tn_strip_clause *clause, const tn_instruction *op)
{
    for (size_t i = 0; i < clause->atom_count; i++)
        if (clause->atoms[i].op.opcode == op->opcode && clause->atoms[i].op.first == op->first &&
            clause->atoms[i].op.second == op->second)
            return &clause->atoms[i];
    return NULL;
}

static tn_status add_atom(const tn_asking *a, const tn_instruction *op, uint32_t of, uint32_t radix, tn_error *error)
{
    tn_strip_clause *clause = a->clause;
    if (find_atom(clause, op))
        return TN_OK;
    if (!tn_array_reserve_from(&clause->atoms, &clause->atom_room, 4, clause->atom_count, 1, sizeof *clause->atoms))
        return tn_fail_memory(error);
    clause->atoms[clause->atom_count++] = (tn_strip_atom){.op = *op, .of = of, .radix = radix};
    if ((uint64_t)clause->radix * radix > TN_STRIP_LETTERS_MAX)
        return tn_strip_limit(a->strip, a->name, "asks for too much at once", error);
    clause->radix *= radix;
    return TN_OK;
}

/* The question that the atom asks is placed from now on. */
static tn_status place_atom(const tn_asking *a, tn_strip_atom *atom, tn_error *error)
{
    tn_strip_questions *q = &a->strip->questions;
    atom->placed = true;
    if (atom->op.opcode != TN_OP_APART)
        return find_or_add(a, q->placed_rooms, &q->placed_count, TN_STRIP_PLACED_MAX, atom->of, &atom->place, error);
    q->placed_walks |= 1u << atom->of;
    return TN_OK;
}

/* Where in the row a room or a walk is, takes more to follow than whether there is one, or how many rooms there are. */
static bool is_placed(tn_opcode opcode, tn_relation_use use)
{
    return opcode == TN_OP_ROOMS ? use != TN_USE_WHOLE
                                 : use != TN_USE_SOMEWHERE && (opcode == TN_OP_SOME_ROOM || opcode == TN_OP_APART);
}

static tn_status see(void *context, const tn_instruction *op, tn_relation_use use, tn_error *error)
{
    const tn_asking *a = context;
    tn_strip_questions *q = &a->strip->questions;
    uint32_t of = 0, radix = 1, first = (uint32_t)op->first;
    bool late = op->opcode == TN_OP_APART;
    if (tn_code_compares_house(op->opcode)) /* the automaton has no other question about such a number */
        return use == TN_USE_WHOLE ? add_atom(a, op, tn_strip_compared(a->strip, first), TN_STRIP_TRUTHS, error)
                                   : tn_strip_limit(a->strip, a->name,
                                                    "compares a number of the whole house within a part of it", error);
    tn_status status = TN_OK;
    switch (op->opcode) {
    case TN_OP_SOME_ROOM:
    case TN_OP_ROOMS:
        radix = op->opcode == TN_OP_ROOMS ? TN_STRIP_CELLS_MAX + 1 : 2;
        status = add_room(a, first, &of, error);
        break;
    case TN_OP_MEETS:
    case TN_OP_APART:
        radix = 2;
        status = late ? find_or_add(a, q->walks, &q->walk_count, TN_STRIP_MEETINGS_MAX, first, &of, error)
                      : find_or_add(a, q->meetings, &q->meeting_count, 64, first, &of, error);
        if (status == TN_OK)
            status = add_meeting(a->strip, first, error);
        break;
    default:
        break;
    }
    if (status == TN_OK)
        status = add_atom(a, op, of, radix, error);
    return status == TN_OK && is_placed(op->opcode, use) ? place_atom(a, find_atom(a->clause, op), error) : status;
}

/* The rooms that a number counts. */
static tn_status ask_weights(tn_strip *strip, uint32_t number, tn_error *error)
{
    const tn_house_weights *w = strip->added->of[number];
    tn_asking asking = {strip, NULL, tn_text(strip->form->module, w->of.name)};
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < w->count; i++)
        if (w->terms[i].kind == TN_HOUSE_ROOMS)
            status = add_room(&asking, w->terms[i].part, &strip->weighed_rooms[number][i], error);
    return status;
}

static tn_strip_walk parts_of(const tn_strip *strip, uint32_t meeting)
{
    const tn_meeting_record *m = &strip->form->module->MEETING_records[meeting];
    bool any = m->through == TN_NO_RECORD;
    return (tn_strip_walk){decision_of(strip, m->first), decision_of(strip, m->second),
                           any ? 0 : decision_of(strip, m->through), any};
}

/* The places of the decisions that rooms, meetings and walks ask for. */
static void place_decisions(tn_strip *strip)
{
    tn_strip_questions *q = &strip->questions;
    for (uint32_t i = 0; i < q->all_count; i++)
        q->all_decisions[i] = decision_of(strip, q->all[i]);
    for (uint32_t m = 0; m < q->meeting_count; m++)
        q->meeting_parts[m] = parts_of(strip, q->meetings[m]);
    for (uint32_t w = 0; w < q->walk_count; w++)
        q->walk_parts[w] = parts_of(strip, q->walks[w]);
}

tn_status tn_strip_ask(tn_strip *strip, tn_error *error)
{
    const tn_module *module = strip->form->module;
    tn_status status = TN_OK;
    for (uint32_t i = 0; status == TN_OK && i < strip->clause_count; i++) {
        tn_strip_clause *clause = &strip->clauses[i];
        const tn_house_clause_record *record = &module->HOUSE_CLAUSE_records[strip->library->clause_first + i];
        tn_asking asking = {strip, clause, tn_text(module, record->name)};
        status = tn_rule_uses(module, clause->holds, see, &asking, error);
    }
    for (uint32_t k = 0; status == TN_OK && k < strip->added->count; k++)
        status = ask_weights(strip, k, error);
    if (status == TN_OK)
        place_decisions(strip);
    strip->answer_words = strip->questions.decision_count / 64 + 1;
    return status;
}
