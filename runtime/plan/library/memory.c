/* Keeps answers by a hash of what they depend on: a table with open addressing. */
#include "runtime/plan/library/memory.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#define XXH_STATIC_LINKING_ONLY /* for a state that needs no allocation */
#include <xxhash.h>

#define BYTES_DEFAULT ((size_t)16 << 20)
#define SLOTS_FIRST 64u

typedef struct tn_kept_answer {
    tn_memory_key key;
    void *answer; /* NULL: the slot is free */
    size_t size;
} tn_kept_answer;

struct tn_plan_memory {
    pthread_mutex_t lock;
    tn_kept_answer *slots;
    size_t slot_count; /* a power of two */
    size_t count, bytes, most;
    size_t found, looked;
};

/* ---- keys */

tn_memory_key tn_memory_key_make(const uint64_t *subject, size_t subject_count, const tn_memory_part *parts,
                                 size_t count)
{
    XXH3_state_t state;
    XXH3_INITSTATE(&state);
    XXH3_128bits_reset(&state);
    XXH3_128bits_update(&state, subject, subject_count * sizeof *subject);
    for (size_t i = 0; i < count; i++) {
        const tn_dfa *dfa = parts[i].dfa;
        uint32_t head[4] = {parts[i].role, dfa->letters, dfa->columns, dfa->states};
        XXH3_128bits_update(&state, head, sizeof head);
        XXH3_128bits_update(&state, dfa->column, dfa->letters * sizeof *dfa->column);
        XXH3_128bits_update(&state, dfa->delta, (size_t)dfa->states * dfa->columns * sizeof *dfa->delta);
        XXH3_128bits_update(&state, dfa->accept, dfa->states);
    }
    XXH128_hash_t hash = XXH3_128bits_digest(&state);
    return (tn_memory_key){hash.low64, hash.high64};
}

/* ---- answers */

tn_plan_memory *tn_plan_memory_new(size_t bytes)
{
    tn_plan_memory *memory = calloc(1, sizeof *memory);
    if (!memory || pthread_mutex_init(&memory->lock, NULL) != 0) {
        free(memory);
        return NULL;
    }
    memory->most = bytes ? bytes : BYTES_DEFAULT;
    return memory;
}

static void forget_all(tn_plan_memory *memory)
{
    for (size_t i = 0; i < memory->slot_count; i++)
        free(memory->slots[i].answer);
    free(memory->slots);
    memory->slots = NULL;
    memory->slot_count = memory->count = memory->bytes = 0;
}

void tn_plan_memory_free(tn_plan_memory *memory)
{
    if (!memory)
        return;
    forget_all(memory);
    pthread_mutex_destroy(&memory->lock);
    free(memory);
}

/* The slot that has the key, or the free one where it belongs. There is a free one. */
static tn_kept_answer *slot_of(tn_kept_answer *slots, size_t slot_count, tn_memory_key key)
{
    size_t at = (size_t)key.low & (slot_count - 1);
    while (slots[at].answer && (slots[at].key.low != key.low || slots[at].key.high != key.high))
        at = (at + 1) & (slot_count - 1);
    return &slots[at];
}

/* Sees to it that at most half of the slots are taken when there is one answer more. */
static bool make_room(tn_plan_memory *memory)
{
    if (2 * (memory->count + 1) <= memory->slot_count)
        return true;
    size_t more = memory->slot_count ? 2 * memory->slot_count : SLOTS_FIRST;
    tn_kept_answer *slots = calloc(more, sizeof *slots);
    if (!slots)
        return false;
    for (size_t i = 0; i < memory->slot_count; i++)
        if (memory->slots[i].answer)
            *slot_of(slots, more, memory->slots[i].key) = memory->slots[i];
    free(memory->slots);
    memory->slots = slots;
    memory->slot_count = more;
    return true;
}

bool tn_plan_memory_find(tn_plan_memory *memory, tn_memory_key key, void *answer, size_t size)
{
    bool found = false;
    pthread_mutex_lock(&memory->lock);
    if (memory->slot_count) {
        const tn_kept_answer *slot = slot_of(memory->slots, memory->slot_count, key);
        found = slot->answer && slot->size == size;
        if (found && size)
            memcpy(answer, slot->answer, size);
    }
    memory->looked++;
    memory->found += found;
    pthread_mutex_unlock(&memory->lock);
    return found;
}

void tn_plan_memory_keep(tn_plan_memory *memory, tn_memory_key key, const void *answer, size_t size)
{
    size_t bytes = size + sizeof(tn_kept_answer) * 2;
    void *copy = bytes <= memory->most ? malloc(size + 1) : NULL;
    if (!copy)
        return;
    memcpy(copy, answer, size);
    pthread_mutex_lock(&memory->lock);
    if (memory->bytes + bytes > memory->most)
        forget_all(memory);
    bool room = make_room(memory);
    tn_kept_answer *slot = room ? slot_of(memory->slots, memory->slot_count, key) : NULL;
    if (slot && !slot->answer) {
        *slot = (tn_kept_answer){key, copy, size};
        memory->count++;
        memory->bytes += bytes;
        copy = NULL;
    }
    pthread_mutex_unlock(&memory->lock);
    free(copy);
}

void tn_plan_memory_looks(tn_plan_memory *memory, size_t *found, size_t *looked)
{
    pthread_mutex_lock(&memory->lock);
    *found = memory->found;
    *looked = memory->looked;
    pthread_mutex_unlock(&memory->lock);
}
