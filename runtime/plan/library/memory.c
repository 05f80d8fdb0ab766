/* Keeps answers by a hash of what they depend on. */
#include "runtime/plan/library/memory.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#define XXH_STATIC_LINKING_ONLY /* for a state that needs no allocation */
#include <xxhash.h>

#include "runtime/base/array.h"
#include "runtime/base/hash_table.h"

#define BYTES_DEFAULT ((size_t)16 << 20)

typedef struct tn_kept_answer {
    tn_memory_key key;
    void *answer;
    size_t size;
} tn_kept_answer;

struct tn_plan_memory {
    pthread_mutex_t lock;
    tn_kept_answer *kept;
    size_t count, capacity, bytes, most;
    tn_hash_table index;
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
    for (size_t i = 0; i < memory->count; i++)
        free(memory->kept[i].answer);
    free(memory->kept);
    tn_hash_clear(&memory->index);
    memory->kept = NULL;
    memory->count = memory->capacity = memory->bytes = 0;
}

void tn_plan_memory_free(tn_plan_memory *memory)
{
    if (!memory)
        return;
    forget_all(memory);
    pthread_mutex_destroy(&memory->lock);
    free(memory);
}

typedef struct wanted_answer {
    const tn_plan_memory *memory;
    tn_memory_key key;
} wanted_answer;

static bool is_wanted(const void *context, uint32_t number)
{
    const wanted_answer *w = context;
    const tn_memory_key *key = &w->memory->kept[number].key;
    return key->low == w->key.low && key->high == w->key.high;
}

bool tn_plan_memory_find(tn_plan_memory *memory, tn_memory_key key, void *answer, size_t size)
{
    bool found = false;
    pthread_mutex_lock(&memory->lock);
    wanted_answer wanted = {memory, key};
    uint32_t number = tn_hash_find(&memory->index, key.low, is_wanted, &wanted);
    found = number != TN_HASH_NONE && memory->kept[number].size == size;
    if (found && size)
        memcpy(answer, memory->kept[number].answer, size);
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
    wanted_answer wanted = {memory, key};
    uint32_t number = (uint32_t)memory->count;
    if (tn_array_reserve(&memory->kept, &memory->capacity, memory->count, 1, sizeof *memory->kept) &&
        tn_hash_enter(&memory->index, key.low, is_wanted, &wanted, &number, NULL) == TN_OK && number == memory->count) {
        memory->kept[memory->count++] = (tn_kept_answer){key, copy, size};
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
