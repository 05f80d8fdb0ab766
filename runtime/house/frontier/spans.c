/* What is seen of rooms and walks in the row, as letters, and the relations that these make.
 *
 * Rooms: one that is so spans trays i..j-1 if it lies in tray i alone, or if a slot begins with tray i, goes on, and
 * ends with tray j-1. Walks: a tray has a source that is apart if that is known at its right side, or if the slot to
 * which its sources go, or one with which that becomes one, says so later. The automata of clauses follow this from
 * letter to letter, so that they decide on a room where it begins once they know how it ends. */
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/house/frontier/placed.h"
#include "runtime/plan/automata/explore.h"
#include "runtime/plan/match/condition.h"

#define PLACED_LETTERS 4096u /* of a clause, as long as it can do with fewer slots */

/* ---- letters */

static bool is_walk(const tn_strip_atom *atom)
{
    return atom->op.opcode == TN_OP_APART;
}

/* How many values the word has. WALK_ON is none of those of a tray's own sources: the words above it come down. */
static uint32_t word_radix(const tn_strip_atom *atom, uint32_t word)
{
    if (is_walk(atom))
        return word == SEEN_FIRST ? WALK_ON + atom->slots : WALK_TO + word - SEEN_SLOTS;
    return word == SEEN_FIRST ? atom->most + 1 : SLOT_ENDS + atom->most;
}

static uint32_t from_seen(const tn_strip_atom *atom, uint32_t word, uint32_t seen)
{
    uint32_t last = word_radix(atom, word) - 1;
    if (is_walk(atom))
        return word == SEEN_FIRST && seen >= WALK_TO ? seen - 1 : seen;
    return seen > last ? last : seen; /* rooms: no more are told apart */
}

uint32_t tn_strip_span_value(const tn_strip_atom *atom, const uint32_t *seen)
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
static bool unfold(const tn_strip_atom *atom, uint32_t value, uint32_t seen[SEEN_WORDS])
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

static uint64_t radix_of(const tn_strip_atom *atom)
{
    uint64_t radix = 1;
    for (uint32_t word = 0; word < SEEN_SLOTS + atom->slots && radix <= UINT32_MAX; word++)
        radix *= word_radix(atom, word);
    return radix;
}

/* Of the clause, up to where it is too much. */
static uint64_t clause_radix(tn_strip_clause *clause)
{
    uint64_t radix = 1;
    for (size_t i = 0; i < clause->atom_count && radix <= TN_STRIP_LETTERS_MAX; i++) {
        tn_strip_atom *atom = &clause->atoms[i];
        uint64_t own = atom->placed ? radix_of(atom) : atom->radix;
        atom->radix = own > UINT32_MAX ? UINT32_MAX : (uint32_t)own;
        radix *= own;
    }
    return radix;
}

/* The placed atom with the most slots, if it can do with fewer. */
static tn_strip_atom *widest(tn_strip_clause *clause)
{
    tn_strip_atom *found = NULL;
    for (size_t i = 0; i < clause->atom_count; i++) {
        tn_strip_atom *atom = &clause->atoms[i];
        if (atom->placed && atom->slots > 1 && (!found || atom->slots > found->slots))
            found = atom;
    }
    return found;
}

static void find_radix(tn_strip_clause *clause)
{
    uint64_t radix = clause_radix(clause);
    clause->radix = radix > UINT32_MAX ? UINT32_MAX : (uint32_t)radix;
}

bool tn_strip_fewer_slots(tn_strip_clause *clause)
{
    tn_strip_atom *atom = widest(clause);
    if (!atom)
        return false;
    atom->slots--;
    find_radix(clause);
    return true;
}

void tn_strip_fit_slots(const tn_strip *strip, tn_strip_clause *clause, const uint32_t at_once[TN_STRIP_PLACED_MAX])
{
    uint32_t trays = strip->trays_most > 0 ? strip->trays_most - 1 : 0; /* nothing goes on behind the last */
    for (size_t i = 0; i < clause->atom_count; i++) {
        tn_strip_atom *atom = &clause->atoms[i];
        uint32_t rooms = is_walk(atom) ? TN_STRIP_SLOTS_MAX : at_once[atom->place];
        if (!atom->placed)
            continue;
        atom->slots = rooms < trays ? rooms : trays;
        atom->slots = atom->slots < TN_STRIP_SLOTS_MAX ? atom->slots : TN_STRIP_SLOTS_MAX;
        atom->most = atom->op.opcode == TN_OP_ROOMS && rooms > 0 ? rooms : 1;
    }
    find_radix(clause);
    uint64_t letters = clause->bases.count > 0 ? clause->bases.count : 1;
    while (clause->radix * letters > PLACED_LETTERS && tn_strip_fewer_slots(clause))
        continue;
}

/* ---- relations, made by going through their states */

enum { PHASE };                          /* of the words of a state */
enum { BEFORE, WITHIN, AFTER, NOWHERE }; /* the first marker, between both, after the second; not in the relation */

typedef struct tn_span_relation {
    const tn_strip_atom *atom;
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
enum { MAY_END = 1u << TN_STRIP_SLOTS_MAX }; /* below that, slots that may be the room's */

static uint32_t slots_that(const uint32_t *seen, uint32_t say)
{
    uint32_t slots = 0;
    for (uint32_t s = 0; s < TN_STRIP_SLOTS_MAX; s++)
        slots |= (uint32_t)(seen[SEEN_SLOTS + s] == say) << s;
    return slots;
}

static uint32_t read_room(const uint32_t *seen, uint32_t read)
{
    uint32_t begin = slots_that(seen, SLOT_BEGINS), on = slots_that(seen, SLOT_ON), end = 0;
    if (read == NOTHING_READ)
        return (seen[SEEN_FIRST] > 0 ? MAY_END : 0) | begin;
    for (uint32_t s = 0; s < TN_STRIP_SLOTS_MAX; s++)
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

/* ---- ROOMS: {phase, number, a word for each slot: 1 where it began in the stretch} */

static uint32_t add_up(const tn_periodic_set *set, uint32_t number, uint32_t more)
{
    uint64_t sum = (uint64_t)number + more;
    return (uint32_t)(sum < set->threshold ? sum : set->threshold + (sum - set->threshold) % set->period);
}

static bool step_rooms(void *context, const uint32_t *key, size_t size, uint32_t column, tn_key *next)
{
    const tn_span_relation *r = context;
    uint32_t seen[SEEN_WORDS], slots[TN_STRIP_SLOTS_MAX];
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
static tn_status find_counts(const tn_module *module, const tn_strip_atom *atom, const tn_marked *marked,
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

tn_status tn_strip_relate_spans(const tn_strip *strip, const tn_strip_atom *atom, const tn_marked *marked,
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
        status = find_counts(strip->form->module, atom, marked, &set, &holds, error);
    if (status == TN_OK)
        status = explore(&r, marked, out, error);
    tn_join_clear(&join);
    free(holds);
    free(told);
    return status;
}
