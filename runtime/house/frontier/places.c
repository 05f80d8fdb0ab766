/* Follows where in the row rooms began, for the questions that ask where they are.
 *
 * That a room is what a question asks for is known when it ends. Until then its beginning has a slot: the clauses are
 * told of each tray which slot begins with it, which go on, and which end with a room that is so (spans.c). Rooms that
 * began with one tray share their slot. Rooms that meet were one from the start: the older beginning is theirs, and so
 * it has to be known which of two that can meet is older, but not by how much. Only rooms of one function can meet. */
#include <string.h>

#include "runtime/house/frontier/placed.h"

/* Ages that are greater than all others: of rooms that began with the tray before the plane, and behind it. What is
 * known of a room does not tell the second from rooms that no question is open of. */
#define FRESH (UINT32_MAX - 1)
#define NOT_YET UINT32_MAX

void tn_strip_place_new(const tn_strip *strip, tn_strip_place *place)
{
    place->age = NOT_YET;
    memset(place->slots, 0, strip->questions.placed_count * sizeof *place->slots);
}

void tn_strip_place_load(const tn_strip *strip, const uint32_t *words, tn_strip_place *place)
{
    place->age = words[0] == NOT_YET ? FRESH : words[0];
    memcpy(place->slots, words + 1, strip->questions.placed_count * sizeof *place->slots);
}

void tn_strip_place_join(const tn_strip *strip, tn_strip_place *to, const tn_strip_place *from)
{
    if (from->age >= to->age)
        return;
    to->age = from->age;
    memcpy(to->slots, from->slots, strip->questions.placed_count * sizeof *to->slots);
}

void tn_strip_place_end(const tn_strip *strip, const tn_strip_place *place, uint64_t truth, uint32_t *seen)
{
    const tn_strip_questions *q = &strip->questions;
    for (uint32_t p = 0; p < q->placed_count; p++, seen += SEEN_WORDS) {
        if (!(truth >> q->placed_rooms[p] & 1))
            continue;
        uint32_t *slot = place->age == FRESH ? NULL : &seen[SEEN_SLOTS + place->slots[p] - 1];
        if (slot)
            *slot = *slot >= SLOT_ENDS ? *slot + 1 : SLOT_ENDS;
        else
            seen[SEEN_FIRST]++;
    }
}

/* ---- rooms that go on */

static uint32_t free_slot(uint32_t held)
{
    uint32_t slot = 0;
    while (held >> slot & 1)
        slot++;
    return slot;
}

/* Of one question: which slots go on, and which begins. */
static void give_slots(const tn_strip *strip, const tn_strip_going *rooms, uint32_t count, uint32_t placed,
                       uint32_t held, uint32_t *seen)
{
    uint32_t question = strip->questions.placed_rooms[placed], slot = free_slot(held);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t age = rooms[i].place->age, *own = &rooms[i].place->slots[placed];
        if (!(rooms[i].open >> question & 1) || age == NOT_YET)
            *own = 0;
        else if (age == FRESH)
            *own = slot + 1;
        if (*own > TN_STRIP_SLOTS_MAX)
            seen[SEEN_FIRST] = SEEN_TOO_MANY;
        else if (*own > 0 && age == FRESH)
            seen[SEEN_SLOTS + slot] = SLOT_BEGINS;
        else if (*own > 0 && seen[SEEN_SLOTS + *own - 1] == SLOT_OFF)
            seen[SEEN_SLOTS + *own - 1] = SLOT_ON;
    }
}

static bool is_open(const tn_strip *strip, const tn_strip_going *room)
{
    uint64_t asked = 0;
    for (uint32_t p = 0; p < strip->questions.placed_count; p++)
        asked |= UINT64_C(1) << strip->questions.placed_rooms[p];
    return (room->open & asked) != 0;
}

/* How many beginnings before that of the room are told apart. ages: of all rooms. */
static uint32_t rank_of(const tn_strip_going *rooms, const uint32_t *ages, uint32_t count, uint32_t room)
{
    uint32_t rank = 0;
    for (uint32_t i = 0; i < count; i++) {
        bool first = rooms[i].function == rooms[room].function && ages[i] < ages[room];
        for (uint32_t k = 0; first && k < i; k++)
            first = rooms[k].function != rooms[i].function || ages[k] != ages[i];
        rank += first;
    }
    return rank;
}

void tn_strip_places_go_on(const tn_strip *strip, const tn_strip_going *rooms, uint32_t count, const uint32_t *held,
                           uint32_t *seen)
{
    uint32_t ages[TN_STRIP_CELLS_MAX];
    for (uint32_t p = 0; p < strip->questions.placed_count; p++)
        give_slots(strip, rooms, count, p, held[p], seen + (size_t)SEEN_WORDS * p);
    for (uint32_t i = 0; i < count; i++)
        ages[i] = is_open(strip, &rooms[i]) ? rooms[i].place->age : NOT_YET;
    for (uint32_t i = 0; i < count; i++)
        rooms[i].place->age = ages[i] == NOT_YET ? NOT_YET : rank_of(rooms, ages, count, i);
}
