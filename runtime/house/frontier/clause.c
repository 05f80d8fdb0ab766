/* Makes an automaton of each clause, over letters that say what a tray and its house are to the clause.
 *
 * A letter is a base, which a slice has by itself, and a value for what is known only at the slice's right side: cells
 * that meet across it, rooms that end there, walks that turn out to lead nowhere; where in the row these are, is read
 * from several letters (below). */
#include <stdlib.h>
#include <string.h>

#include "runtime/automata/explore.h"
#include "runtime/base/array.h"
#include "runtime/house/frontier/frontier.h"
#include "runtime/house/frontier/states.h"
#include "runtime/plan/match/condition.h"
#include "runtime/plan/match/tray_relations.h"

#define AREA_STEPS_MAX UINT64_C(1000000) /* of the sum of all areas */

tn_status tn_frontier_clauses_new(tn_frontier *frontier, tn_error *error)
{
    const tn_module *module = frontier->form->module;
    tn_status status = TN_OK;
    frontier->clauses = calloc((size_t)frontier->library->clause_count + 1, sizeof *frontier->clauses);
    if (!frontier->clauses)
        return tn_fail_memory(error);
    for (uint32_t i = 0; status == TN_OK && i < frontier->library->clause_count; i++) {
        const tn_house_clause_record *record = &module->HOUSE_CLAUSE_records[frontier->library->clause_first + i];
        tn_frontier_clause *clause = &frontier->clauses[frontier->clause_count++];
        bool without = frontier->without && i >= frontier->without->first;
        *clause = (tn_frontier_clause){.holds = record->holds,
                                       .prunes = record->kind == TN_CLAUSE_PRUNE,
                                       .without = without,
                                       .differs = without && frontier->without->differs,
                                       .radix = 1};
        status = tn_classes_new(frontier->form->schema, &clause->holds, 1, &clause->classes, error);
    }
    return status;
}

void tn_frontier_clauses_free(tn_frontier *frontier)
{
    for (uint32_t i = 0; i < frontier->clause_count; i++) {
        tn_classes_free(frontier->clauses[i].classes);
        tn_interner_clear(&frontier->clauses[i].bases);
        tn_frontier_completions_free(frontier, &frontier->clauses[i]);
        tn_dfa_free(frontier->clauses[i].dfa);
        free(frontier->clauses[i].atoms);
    }
    free(frontier->clauses);
}

/* ---- bases */

static uint32_t count_cells(const tn_house *house, uint32_t function)
{
    uint32_t count = 0;
    for (size_t i = 0; i < house->cell_count; i++)
        count += tn_house_decide(house, function, &house->cells[i]);
    return count;
}

static uint32_t sum_areas(tn_frontier *frontier, const tn_house *house, uint32_t function)
{
    tn_int128 area = 0;
    for (size_t i = 0; i < house->cell_count; i++)
        if (!house->cells[i].open && tn_house_decide(house, function, &house->cells[i]))
            area += tn_cell_area(&house->cells[i]);
    return tn_frontier_number_area(frontier, area);
}

static bool meets_inside(const tn_frontier *frontier, const tn_house *house, uint32_t meeting)
{
    for (size_t i = 0; i < house->face_count; i++)
        if (tn_frontier_meets(frontier, house, &house->faces[i], meeting))
            return true;
    return false;
}

static uint32_t word_of(tn_frontier *frontier, const tn_frontier_atom *atom, const tn_house *house)
{
    switch (atom->op.opcode) {
    case TN_OP_SOME_CELL:
        return count_cells(house, (uint32_t)atom->op.first) > 0;
    case TN_OP_CELLS:
        return count_cells(house, (uint32_t)atom->op.first);
    case TN_OP_AREAS:
        return sum_areas(frontier, house, (uint32_t)atom->op.first);
    case TN_OP_MEETS:
        return meets_inside(frontier, house, atom->of);
    case TN_OP_SECTION_IS:
        return tn_house_decide(house, (uint32_t)atom->op.first, NULL);
    default:
        return 0;
    }
}

tn_status tn_frontier_base(tn_frontier *frontier, tn_frontier_clause *clause, const tn_house *house, uint32_t *base,
                           tn_error *error)
{
    tn_key *key = &frontier->key;
    key->size = 0;
    bool ok = tn_key_push(key, clause->classes->of_tray[house->trays[0]]);
    for (size_t i = 0; ok && i < clause->atom_count; i++) {
        uint32_t word = word_of(frontier, &clause->atoms[i], house);
        ok = word != UINT32_MAX && tn_key_push(key, word);
    }
    *base = ok ? tn_intern(&clause->bases, key->data, key->size) : UINT32_MAX;
    return *base != UINT32_MAX ? TN_OK : tn_fail_memory(error);
}

/* ---- relations of the instructions */

typedef struct tn_frontier_lowering {
    tn_frontier *frontier;
    const tn_frontier_clause *clause;
    const char *name;
} tn_frontier_lowering;

static size_t find_atom(const tn_frontier_clause *clause, const tn_instruction *op)
{
    size_t i = 0;
    while (clause->atoms[i].op.opcode != op->opcode || clause->atoms[i].op.first != op->first ||
           clause->atoms[i].op.second != op->second)
        i++;
    return i;
}

/* What the letter's base says of the atom. */
static uint32_t base_of(const tn_frontier_clause *clause, uint32_t letter, size_t atom)
{
    size_t size;
    return tn_interned(&clause->bases, letter / clause->radix, &size)[1 + atom];
}

/* What its value says. */
static uint32_t value_of(const tn_frontier_clause *clause, uint32_t letter, size_t atom)
{
    uint32_t value = letter % clause->radix;
    for (size_t i = 0; i < atom; i++)
        value /= clause->atoms[i].radix;
    return value % clause->atoms[atom].radix;
}

typedef enum tn_letter_part { PART_BASE, PART_VALUE } tn_letter_part;

/* Stretches of one tray whose letter's part is not 0. */
static tn_status relate_letter(const tn_frontier_lowering *l, const tn_marked *marked, size_t atom, tn_letter_part part,
                               tn_dfa **out, tn_error *error)
{
    uint32_t letters = marked->letters - 1;
    uint8_t *chosen = malloc((size_t)letters + 1);
    if (!chosen)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < letters; i++)
        chosen[i] = (part == PART_BASE ? base_of(l->clause, i, atom) : value_of(l->clause, i, atom)) != 0;
    tn_status status = tn_marked_letter(marked, chosen, out, error);
    free(chosen);
    return status;
}

/* In one tray, or in two: then the left one's letter says so. */
static tn_status relate_meeting(const tn_frontier_lowering *l, const tn_marked *marked, size_t atom, tn_dfa **out,
                                tn_error *error)
{
    tn_dfa *inside = NULL, *left = NULL, *across = NULL;
    tn_status status = relate_letter(l, marked, atom, PART_BASE, &inside, error);
    if (status == TN_OK)
        status = relate_letter(l, marked, atom, PART_VALUE, &left, error);
    if (status == TN_OK)
        status = tn_marked_chain(marked, left, marked->single, &across, error);
    if (status == TN_OK)
        status = tn_dfa_product(inside, across, TN_DFA_OR, "touch", marked->bounds, out, error);
    tn_dfa_free(inside);
    tn_dfa_free(left);
    tn_dfa_free(across);
    return status;
}

static tn_status relate_section(const tn_frontier_lowering *l, const tn_marked *marked, size_t atom, tn_dfa **out,
                                tn_error *error)
{
    bool so = l->clause->bases.count > 0 && base_of(l->clause, 0, atom) != 0; /* of every letter */
    if (!so)
        return tn_dfa_constant(marked->letters, false, out, error);
    *out = tn_dfa_share(marked->nonempty);
    return TN_OK;
}

/* ---- counting */

static tn_int128 common_unit(const tn_frontier_lowering *l, uint32_t letters, size_t atom)
{
    tn_int128 unit = 0;
    for (uint32_t i = 0; i < letters; i++) {
        tn_int128 a = tn_frontier_area(l->frontier, base_of(l->clause, i, atom));
        while (a != 0) {
            tn_int128 rest = unit % a;
            unit = a;
            a = rest;
        }
    }
    return unit > 0 ? unit : 1;
}

/* In halves of a square micrometre; what is no whole one is the odd number between its neighbours (opcodes.def). */
static int64_t halves(tn_int128 area)
{
    enum { SQUARE_MICROMETRE = 1000000 };
    tn_int128 twice = area / SQUARE_MICROMETRE * 2 + (area % SQUARE_MICROMETRE != 0);
    return twice > INT64_MAX ? INT64_MAX : (int64_t)twice;
}

/* Which sums of areas, in units, meet the condition: up to the last at which it changes. The caller frees *holds. */
static tn_status sums_that_hold(const tn_frontier_lowering *l, uint32_t condition, tn_int128 unit, uint64_t most,
                                tn_periodic_set *set, uint8_t **holds, tn_error *error)
{
    if (most > AREA_STEPS_MAX)
        return tn_frontier_limit(l->frontier, l->name, "adds areas that have no large common measure", error);
    *holds = malloc((size_t)most + 2);
    if (!*holds)
        return tn_fail_memory(error);
    for (uint64_t n = 0; n <= most; n++)
        (*holds)[n] = tn_condition_holds(l->frontier->form->module, condition, halves((tn_int128)n * unit));
    set->threshold = most;
    while (set->threshold > 0 && (*holds)[set->threshold - 1] == (*holds)[most])
        set->threshold--;
    set->period = 1;
    set->holds = *holds;
    return TN_OK;
}

static tn_status relate_areas(const tn_frontier_lowering *l, const tn_marked *marked, size_t atom, tn_dfa **out,
                              tn_error *error)
{
    uint32_t letters = marked->letters - 1;
    uint64_t *counts = malloc(((size_t)letters + 1) * sizeof *counts), most = 0;
    uint8_t *holds = NULL;
    tn_periodic_set set;
    if (!counts)
        return tn_fail_memory(error);
    tn_int128 unit = common_unit(l, letters, atom);
    for (uint32_t i = 0; i < letters; i++) {
        counts[i] = (uint64_t)(tn_frontier_area(l->frontier, base_of(l->clause, i, atom)) / unit);
        most = counts[i] > most ? counts[i] : most;
    }
    most = most > AREA_STEPS_MAX ? most : most * l->frontier->trays_most;
    tn_status status = sums_that_hold(l, (uint32_t)l->clause->atoms[atom].op.second, unit, most, &set, &holds, error);
    if (status == TN_OK)
        status = tn_marked_count(marked, marked->single, TN_TALLY_SINGLES, &set, counts, out, error);
    free(counts);
    free(holds);
    return status;
}

static tn_status relate_count(const tn_frontier_lowering *l, const tn_marked *marked, size_t atom, tn_letter_part part,
                              tn_dfa **out, tn_error *error)
{
    uint32_t letters = marked->letters - 1;
    uint64_t *counts = malloc(((size_t)letters + 1) * sizeof *counts);
    if (!counts)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < letters; i++)
        counts[i] = part == PART_BASE ? base_of(l->clause, i, atom) : value_of(l->clause, i, atom);
    tn_status status = tn_relate_numbers(marked, l->frontier->form->module, marked->single,
                                         (uint32_t)l->clause->atoms[atom].op.second, counts, out, error);
    free(counts);
    return status;
}

/* The last letter says it of the whole row: its value is the sum of all values. */
static tn_status relate_comparison(const tn_frontier_lowering *l, const tn_marked *marked, size_t atom, tn_dfa **out,
                                   tn_error *error)
{
    uint8_t holds[TN_FRONTIER_TRUTHS] = {[TRUTH_YES] = true};
    uint32_t letters = marked->letters - 1;
    uint64_t *counts = malloc(((size_t)letters + 1) * sizeof *counts);
    bool empty = false;
    tn_status status = counts ? tn_frontier_empty_meets(l->frontier, &l->clause->atoms[atom].op, &empty, error)
                              : tn_fail_memory(error);
    holds[TRUTH_LATER] = empty; /* there is no letter */
    const tn_periodic_set set = {.threshold = TRUTH_NO, .period = 1, .holds = holds};
    for (uint32_t i = 0; counts && i < letters; i++)
        counts[i] = value_of(l->clause, i, atom);
    if (status == TN_OK)
        status = tn_marked_count(marked, marked->single, TN_TALLY_SINGLES, &set, counts, out, error);
    free(counts);
    return status;
}

static tn_status relate_spans(const tn_frontier_lowering *l, const tn_marked *marked, size_t atom, tn_dfa **out,
                              tn_error *error)
{
    uint32_t letters = marked->letters - 1, *values = malloc(((size_t)letters + 1) * sizeof *values);
    if (!values)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < letters; i++)
        values[i] = value_of(l->clause, i, atom);
    tn_status status = tn_frontier_relate_spans(l->frontier, &l->clause->atoms[atom], marked, values, out, error);
    free(values);
    return status;
}

/* A house in a mirror has the same stretches, from the other side; letters are read as the house stands, and so a
 * relation is the same for both. */
static tn_status relate(void *context, const tn_marked *marked, const tn_instruction *op, bool reversed, tn_dfa **out,
                        tn_error *error)
{
    const tn_frontier_lowering *l = context;
    size_t atom = find_atom(l->clause, op);
    (void)reversed;
    if (l->clause->atoms[atom].placed)
        return relate_spans(l, marked, atom, out, error);
    switch (op->opcode) {
    case TN_OP_SOME_CELL:
        return relate_letter(l, marked, atom, PART_BASE, out, error);
    case TN_OP_SOME_ROOM:
    case TN_OP_APART:
        return relate_letter(l, marked, atom, PART_VALUE, out, error);
    case TN_OP_MEETS:
        return relate_meeting(l, marked, atom, out, error);
    case TN_OP_SECTION_IS:
        return relate_section(l, marked, atom, out, error);
    case TN_OP_CELLS:
        return relate_count(l, marked, atom, PART_BASE, out, error);
    case TN_OP_ROOMS:
        return relate_count(l, marked, atom, PART_VALUE, out, error);
    case TN_OP_AREAS:
        return relate_areas(l, marked, atom, out, error);
    default:
        return relate_comparison(l, marked, atom, out, error);
    }
}

/* ---- the automata */

/* Letters as classes: each looks like a tray of its class. */
static tn_status make_letters(const tn_frontier_clause *clause, uint32_t letters, tn_classes *classes, tn_error *error)
{
    size_t size;
    *classes = (tn_classes){.schema = clause->classes->schema, .count = letters};
    classes->representative = malloc(((size_t)letters + 1) * sizeof *classes->representative);
    if (!classes->representative)
        return tn_fail_memory(error);
    for (uint32_t i = 0; i < letters; i++)
        classes->representative[i] =
            clause->classes->representative[tn_interned(&clause->bases, i / clause->radix, &size)[0]];
    return TN_OK;
}

/* What the clause says of a house, as the rules are or without a part of them. */
static tn_status lower_holds(const tn_frontier_lowering *context, const tn_classes *classes, bool without, tn_dfa **out,
                             tn_error *error)
{
    const tn_frontier *frontier = context->frontier;
    tn_lowering *lowering = NULL;
    tn_status status = tn_lowering_new(classes, 0, &lowering, error);
    if (status == TN_OK) {
        tn_lowering_within(lowering, frontier->trays_most);
        tn_lowering_house(lowering, relate, (void *)(uintptr_t)context);
        if (without)
            tn_lowering_disable(lowering, frontier->without->offsets, frontier->without->count);
        status = tn_lower(lowering, context->clause->holds, out, error);
    }
    tn_lowering_free(lowering);
    return status;
}

/* The houses of which it says otherwise without the part. */
static tn_status lower_difference(const tn_frontier_lowering *context, const tn_classes *classes, tn_dfa **out,
                                  tn_error *error)
{
    tn_bounds bounds = tn_bounds_make(TN_STATES_DEFAULT);
    tn_dfa *with = NULL, *without = NULL, *lost = NULL, *gained = NULL;
    tn_status status = lower_holds(context, classes, false, &with, error);
    bounds.watch = context->frontier->watch;
    if (status == TN_OK)
        status = lower_holds(context, classes, true, &without, error);
    if (status == TN_OK)
        status = tn_dfa_product(with, without, TN_DFA_MINUS, "the difference", &bounds, &lost, error);
    if (status == TN_OK)
        status = tn_dfa_product(without, with, TN_DFA_MINUS, "the difference", &bounds, &gained, error);
    if (status == TN_OK)
        status = tn_dfa_product(lost, gained, TN_DFA_OR, "the difference", &bounds, out, error);
    tn_dfa_free(with);
    tn_dfa_free(without);
    tn_dfa_free(lost);
    tn_dfa_free(gained);
    return status;
}

static tn_status lower_clause(tn_frontier *frontier, tn_frontier_clause *clause, const char *name, tn_error *error)
{
    const tn_frontier_lowering context = {frontier, clause, name};
    uint64_t letters = (uint64_t)clause->bases.count * clause->radix;
    tn_classes classes = {0};
    tn_dfa *dfa = NULL;
    if (letters > TN_FRONTIER_LETTERS_MAX)
        return tn_frontier_limit(frontier, name, "tells too many trays with their houses apart", error);
    tn_status status = make_letters(clause, (uint32_t)letters, &classes, error);
    if (status == TN_OK)
        status = clause->differs ? lower_difference(&context, &classes, &dfa, error)
                                 : lower_holds(&context, &classes, clause->without, &dfa, error);
    if (status == TN_OK && clause->prunes && !clause->differs)
        status = tn_dfa_complement(dfa, &clause->dfa, error);
    else if (status == TN_OK)
        clause->dfa = tn_dfa_share(dfa);
    tn_dfa_free(dfa);
    free(classes.representative);
    return status;
}

/* With one slot each, if the automaton with more of them is too large. */
static tn_status lower_in_limits(tn_frontier *frontier, tn_frontier_clause *clause, const char *name, tn_error *error)
{
    tn_error own;
    error = error ? error : &own;
    tn_status status = lower_clause(frontier, clause, name, error);
    if (status == TN_LIMIT && error->code == E_TOO_MANY_STATES && tn_frontier_fewer_slots(clause)) {
        *error = (tn_error){0};
        while (tn_frontier_fewer_slots(clause))
            continue;
        status = lower_clause(frontier, clause, name, error);
    }
    return status == TN_LIMIT && error->code == E_TOO_MANY_STATES
               ? tn_frontier_limit(frontier, name, "takes more states than the limit", error)
               : status;
}

tn_status tn_frontier_lower(tn_frontier *frontier, tn_error *error)
{
    const tn_module *module = frontier->form->module;
    uint32_t at_once[TN_FRONTIER_PLACED_MAX];
    tn_status status = TN_OK;
    tn_frontier_rooms_at_once(frontier, at_once);
    for (uint32_t i = 0; status == TN_OK && i < frontier->clause_count; i++) {
        const tn_house_clause_record *record = &module->HOUSE_CLAUSE_records[frontier->library->clause_first + i];
        tn_frontier_fit_slots(frontier, &frontier->clauses[i], at_once);
        status = lower_in_limits(frontier, &frontier->clauses[i], tn_text(module, record->name), error);
    }
    return status == TN_OK ? tn_frontier_find_completions(frontier, error) : status;
}

/* ==== where in the row rooms and walks are
 *
 * What is seen of rooms and walks in the row, as letters, and the relations that these make.
 *
 * Rooms: one that is so spans trays i..j-1 if it lies in tray i alone, or if a slot begins with tray i, goes on, and
 * ends with tray j-1. Walks: a tray has a source that is apart if that is known at its right side, or if the slot to
 * which its sources go, or one with which that becomes one, says so later. The automata of clauses follow this from
 * letter to letter, so that they decide on a room where it begins once they know how it ends. */

#define PLACED_LETTERS 4096u /* of a clause, as long as it can do with fewer slots */

/* ---- letters */

static bool is_walk(const tn_frontier_atom *atom)
{
    return atom->op.opcode == TN_OP_APART;
}

/* How many values the word has. WALK_ON is none of those of a tray's own sources: the words above it come down. */
static uint32_t word_radix(const tn_frontier_atom *atom, uint32_t word)
{
    if (is_walk(atom))
        return word == SEEN_FIRST ? WALK_ON + atom->slots : WALK_TO + word - SEEN_SLOTS;
    return word == SEEN_FIRST ? atom->most + 1 : SLOT_ENDS + atom->most;
}

static uint32_t from_seen(const tn_frontier_atom *atom, uint32_t word, uint32_t seen)
{
    uint32_t last = word_radix(atom, word) - 1;
    if (is_walk(atom))
        return word == SEEN_FIRST && seen >= WALK_TO ? seen - 1 : seen;
    return seen > last ? last : seen; /* rooms: no more are told apart */
}

uint32_t tn_frontier_span_value(const tn_frontier_atom *atom, const uint32_t *seen)
{
    uint32_t value = 0;
    if (seen[SEEN_FIRST] == SEEN_TOO_MANY)
        return UINT32_MAX;
    for (uint32_t word = SEEN_SLOTS + atom->slots; word < SEEN_WORDS; word++)
        if (seen[word] != 0)
            return UINT32_MAX;
    for (uint32_t word = SEEN_SLOTS + atom->slots; word-- > 0;) {
        uint32_t digit = from_seen(atom, word, seen[word]), radix = word_radix(atom, word);
        if (digit >= radix)
            return UINT32_MAX;
        value = value * radix + digit;
    }
    return value;
}

/* Is there such a letter at all? One slot at most begins with a tray. Others stand for a tray where nothing is. */
static bool unfold(const tn_frontier_atom *atom, uint32_t value, uint32_t seen[SEEN_WORDS])
{
    uint32_t begin = 0;
    memset(seen, 0, SEEN_WORDS * sizeof *seen);
    for (uint32_t word = 0; word < SEEN_SLOTS + atom->slots; word++) {
        uint32_t radix = word_radix(atom, word);
        seen[word] = value % radix;
        value /= radix;
        if (is_walk(atom) && word == SEEN_FIRST && seen[word] >= WALK_ON)
            seen[word]++;
        begin += !is_walk(atom) && word >= SEEN_SLOTS && seen[word] == SLOT_BEGINS;
    }
    if (begin > 1)
        memset(seen, 0, SEEN_WORDS * sizeof *seen);
    return begin <= 1;
}

static uint64_t radix_of(const tn_frontier_atom *atom)
{
    uint64_t radix = 1;
    for (uint32_t word = 0; word < SEEN_SLOTS + atom->slots && radix <= UINT32_MAX; word++)
        radix *= word_radix(atom, word);
    return radix;
}

/* Of the clause, as far as these are not too many. */
static uint64_t clause_radix(tn_frontier_clause *clause)
{
    uint64_t radix = 1;
    for (size_t i = 0; i < clause->atom_count && radix <= TN_FRONTIER_LETTERS_MAX; i++) {
        tn_frontier_atom *atom = &clause->atoms[i];
        uint64_t own = atom->placed ? radix_of(atom) : atom->radix;
        atom->radix = own > UINT32_MAX ? UINT32_MAX : (uint32_t)own;
        radix *= own;
    }
    return radix;
}

/* The placed atom with the most slots, if it can do with fewer. */
static tn_frontier_atom *widest(tn_frontier_clause *clause)
{
    tn_frontier_atom *found = NULL;
    for (size_t i = 0; i < clause->atom_count; i++) {
        tn_frontier_atom *atom = &clause->atoms[i];
        if (atom->placed && atom->slots > 1 && (!found || atom->slots > found->slots))
            found = atom;
    }
    return found;
}

static void find_radix(tn_frontier_clause *clause)
{
    uint64_t radix = clause_radix(clause);
    clause->radix = radix > UINT32_MAX ? UINT32_MAX : (uint32_t)radix;
}

bool tn_frontier_fewer_slots(tn_frontier_clause *clause)
{
    tn_frontier_atom *atom = widest(clause);
    if (!atom)
        return false;
    atom->slots--;
    find_radix(clause);
    return true;
}

void tn_frontier_fit_slots(const tn_frontier *frontier, tn_frontier_clause *clause,
                           const uint32_t at_once[TN_FRONTIER_PLACED_MAX])
{
    uint32_t trays = frontier->trays_most > 0 ? frontier->trays_most - 1 : 0; /* nothing goes on behind the last */
    for (size_t i = 0; i < clause->atom_count; i++) {
        tn_frontier_atom *atom = &clause->atoms[i];
        uint32_t rooms = is_walk(atom) ? TN_FRONTIER_SLOTS_MAX : at_once[atom->place];
        if (!atom->placed)
            continue;
        atom->slots = rooms < trays ? rooms : trays;
        atom->slots = atom->slots < TN_FRONTIER_SLOTS_MAX ? atom->slots : TN_FRONTIER_SLOTS_MAX;
        atom->most = atom->op.opcode == TN_OP_ROOMS && rooms > 0 ? rooms : 1;
    }
    find_radix(clause);
    uint64_t letters = clause->bases.count > 0 ? clause->bases.count : 1;
    while (clause->radix * letters > PLACED_LETTERS && tn_frontier_fewer_slots(clause))
        continue;
}

/* ---- relations, made by going through their states */

enum { PHASE };                          /* of the words of a state */
enum { BEFORE, WITHIN, AFTER, NOWHERE }; /* the first marker, between both, after the second; not in the relation */

typedef struct tn_span_relation {
    const tn_frontier_atom *atom;
    const uint32_t *values;
    const tn_join *join;
    const tn_periodic_set *counts; /* of ROOMS */
} tn_span_relation;

static bool go(tn_key *next, uint32_t phase, uint32_t word)
{
    return tn_key_push(next, phase) && tn_key_push(next, word);
}

/* What the column's letter says. False: it is the marker. */
static bool read_column(const tn_span_relation *r, uint32_t column, uint32_t seen[SEEN_WORDS])
{
    uint32_t letter = r->join->letter[column];
    if (letter + 1 == r->join->letters)
        return false;
    unfold(r->atom, r->values[letter], seen);
    return true;
}

/* ---- SOME_ROOM: {phase, what is read of the stretch} */

#define NOTHING_READ UINT32_MAX
enum { MAY_END = 1u << TN_FRONTIER_SLOTS_MAX }; /* below that, slots that may be the room's */

static uint32_t slots_that(const uint32_t *seen, uint32_t say)
{
    uint32_t slots = 0;
    for (uint32_t s = 0; s < TN_FRONTIER_SLOTS_MAX; s++)
        slots |= (uint32_t)(seen[SEEN_SLOTS + s] == say) << s;
    return slots;
}

static uint32_t read_room(const uint32_t *seen, uint32_t read)
{
    uint32_t begin = slots_that(seen, SLOT_BEGINS), on = slots_that(seen, SLOT_ON), end = 0;
    if (read == NOTHING_READ)
        return (seen[SEEN_FIRST] > 0 ? MAY_END : 0) | begin;
    for (uint32_t s = 0; s < TN_FRONTIER_SLOTS_MAX; s++)
        end |= (uint32_t)(seen[SEEN_SLOTS + s] >= SLOT_ENDS) << s;
    return (read & end ? MAY_END : 0) | (read & (on | end));
}

static bool step_room(void *context, const uint32_t *key, size_t size, uint32_t column, tn_key *next)
{
    const tn_span_relation *r = context;
    uint32_t seen[SEEN_WORDS];
    (void)size;
    if (!read_column(r, column, seen)) {
        bool ends = key[1] != NOTHING_READ && key[1] & MAY_END;
        return key[PHASE] == BEFORE           ? go(next, WITHIN, NOTHING_READ)
               : key[PHASE] == WITHIN && ends ? go(next, AFTER, 0)
                                              : go(next, NOWHERE, 0);
    }
    if (key[PHASE] != WITHIN)
        return go(next, key[PHASE], 0);
    uint32_t read = read_room(seen, key[1]);
    return read != 0 ? go(next, WITHIN, read) : go(next, NOWHERE, 0);
}

/* ---- ROOMS: {phase, number, a word for each slot: 1 if it began in the stretch} */

static uint32_t add_up(const tn_periodic_set *set, uint32_t number, uint32_t more)
{
    uint64_t sum = (uint64_t)number + more;
    return (uint32_t)(sum < set->threshold ? sum : set->threshold + (sum - set->threshold) % set->period);
}

static bool step_rooms(void *context, const uint32_t *key, size_t size, uint32_t column, tn_key *next)
{
    const tn_span_relation *r = context;
    uint32_t seen[SEEN_WORDS], slots[TN_FRONTIER_SLOTS_MAX];
    if (!read_column(r, column, seen)) {
        if (key[PHASE] == BEFORE) {
            bool ok = go(next, WITHIN, 0);
            for (uint32_t s = 0; ok && s < r->atom->slots; s++)
                ok = tn_key_push(next, 0);
            return ok;
        }
        bool holds = key[PHASE] == WITHIN && r->counts->holds[key[1]];
        return go(next, holds ? AFTER : NOWHERE, 0);
    }
    if (key[PHASE] != WITHIN)
        return tn_key_copy(next, key, size);
    uint32_t number = add_up(r->counts, key[1], seen[SEEN_FIRST]);
    for (uint32_t s = 0; s < r->atom->slots; s++) {
        uint32_t say = seen[SEEN_SLOTS + s];
        slots[s] = say == SLOT_BEGINS ? 1 : say == SLOT_OFF ? 0 : key[2 + s];
        if (slots[s] > 0 && say >= SLOT_ENDS)
            number = add_up(r->counts, number, say - SLOT_ENDS + 1);
    }
    bool ok = go(next, WITHIN, number);
    for (uint32_t s = 0; ok && s < r->atom->slots; s++)
        ok = tn_key_push(next, slots[s]);
    return ok;
}

/* ---- APART: {phase, what becomes of the tray's sources}: APART_YET, or FIRST_SLOT and their slot */

enum { APART_YET, FIRST_SLOT };

static bool walk_on(const uint32_t *seen, const uint32_t *key, tn_key *next)
{
    bool unread = key[PHASE] == WITHIN && key[1] == NOTHING_READ;
    if (key[PHASE] == WITHIN && !unread) /* a second tray */
        return go(next, NOWHERE, 0);
    if (!unread && (key[PHASE] != AFTER || key[1] == APART_YET))
        return go(next, key[PHASE], key[1]);
    uint32_t own = unread ? seen[SEEN_FIRST] : seen[SEEN_SLOTS + key[1] - FIRST_SLOT];
    return own == WALK_NONE    ? go(next, NOWHERE, 0)
           : own == WALK_APART ? go(next, key[PHASE], APART_YET)
           : own == WALK_ON    ? go(next, key[PHASE], key[1])
                               : go(next, key[PHASE], FIRST_SLOT + own - WALK_TO);
}

static bool step_walk(void *context, const uint32_t *key, size_t size, uint32_t column, tn_key *next)
{
    const tn_span_relation *r = context;
    uint32_t seen[SEEN_WORDS];
    (void)size;
    if (read_column(r, column, seen))
        return walk_on(seen, key, next);
    return key[PHASE] == BEFORE                             ? go(next, WITHIN, NOTHING_READ)
           : key[PHASE] == WITHIN && key[1] != NOTHING_READ ? go(next, AFTER, key[1])
                                                            : go(next, NOWHERE, 0);
}

/* ---- the whole */

static bool accepts(void *context, const uint32_t *key, size_t size)
{
    const tn_span_relation *r = context;
    (void)size;
    return key[PHASE] == AFTER && (!is_walk(r->atom) || key[1] == APART_YET);
}

static tn_status explore(tn_span_relation *r, const tn_marked *marked, tn_dfa **out, tn_error *error)
{
    tn_opcode opcode = r->atom->op.opcode;
    const tn_construction construction = {.what = opcode == TN_OP_APART ? "walk in the row" : "room in the row",
                                          .join = r->join,
                                          .context = r,
                                          .step = opcode == TN_OP_APART   ? step_walk
                                                  : opcode == TN_OP_ROOMS ? step_rooms
                                                                          : step_room,
                                          .accepts = accepts};
    uint32_t start[] = {BEFORE, 0};
    return tn_explore(&construction, &(tn_key){.data = start, .size = 2}, NULL, marked->bounds, out, error);
}

/* The caller frees *holds. */
static tn_status find_counts(const tn_module *module, const tn_frontier_atom *atom, const tn_marked *marked,
                             tn_periodic_set *set, uint8_t **holds, tn_error *error)
{
    uint32_t condition = (uint32_t)atom->op.second;
    uint64_t limit = (uint64_t)marked->bounds->max_states * 4 + 64;
    tn_status status = tn_condition_period(module, condition, 1, limit, &set->threshold, &set->period, error);
    if (status != TN_OK)
        return status;
    *holds = tn_array_new(set->threshold + set->period, 1);
    if (!*holds)
        return tn_fail_memory(error);
    for (uint64_t n = 0; n < set->threshold + set->period; n++)
        (*holds)[n] = tn_condition_holds(module, condition, (int64_t)n);
    set->holds = *holds;
    return TN_OK;
}

tn_status tn_frontier_relate_spans(const tn_frontier *frontier, const tn_frontier_atom *atom, const tn_marked *marked,
                                   const uint32_t *values, tn_dfa **out, tn_error *error)
{
    uint32_t *told = calloc((size_t)marked->letters, sizeof *told), seen[SEEN_WORDS];
    uint8_t *holds = NULL;
    tn_periodic_set set = {0};
    tn_join join = {0};
    tn_span_relation r = {.atom = atom, .values = values, .join = &join, .counts = &set};
    tn_status status = told ? TN_OK : tn_fail_memory(error);
    for (uint32_t l = 0; told && l + 1 < marked->letters; l++)
        told[l] = unfold(atom, values[l], seen) ? values[l] : 0;
    if (status == TN_OK)
        status = tn_join_make(&join, NULL, 0, marked->letters, told, true, error);
    if (status == TN_OK && atom->op.opcode == TN_OP_ROOMS)
        status = find_counts(frontier->form->module, atom, marked, &set, &holds, error);
    if (status == TN_OK)
        status = explore(&r, marked, out, error);
    tn_join_clear(&join);
    free(holds);
    free(told);
    return status;
}
