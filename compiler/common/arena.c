/* Allocates memory that is freed all at once. */
#include "compiler/common/arena.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Blocks grow geometrically, so that a large compilation makes few of them and a small one stays small. Under
 * AddressSanitizer every allocation is a block of its own: overruns are then seen. */
#if defined(__SANITIZE_ADDRESS__)
#define TN_BLOCK_MIN ((size_t)0)
#define TN_BLOCK_MAX ((size_t)0)
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define TN_BLOCK_MIN ((size_t)0)
#define TN_BLOCK_MAX ((size_t)0)
#endif
#endif
#ifndef TN_BLOCK_MIN
#define TN_BLOCK_MIN ((size_t)16 << 10)
#define TN_BLOCK_MAX ((size_t)1 << 20)
#endif

static const size_t block_max = TN_BLOCK_MAX;

typedef struct tn_block {
    struct tn_block *next;
    size_t size, used;
    _Alignas(max_align_t) unsigned char bytes[];
} tn_block;

struct tn_arena {
    tn_block *blocks;
    size_t block_size; /* of the next block */
    int failed;
};

tn_arena *tn_arena_new(void)
{
    tn_arena *arena = calloc(1, sizeof *arena);
    if (arena)
        arena->block_size = TN_BLOCK_MIN;
    return arena;
}

void tn_arena_free(tn_arena *arena)
{
    if (!arena)
        return;
    for (tn_block *block = arena->blocks, *next; block; block = next) {
        next = block->next;
        free(block);
    }
    free(arena);
}

static void *fail(tn_arena *arena)
{
    arena->failed = 1;
    return NULL;
}

static tn_block *add_block(tn_arena *arena, size_t size)
{
    tn_block *block = calloc(1, sizeof *block + size);
    if (!block)
        return NULL;
    block->size = size;
    block->next = arena->blocks;
    arena->blocks = block;
    return block;
}

void *tn_arena_alloc(tn_arena *arena, size_t size)
{
    size_t unit = _Alignof(max_align_t);
    if (size > PTRDIFF_MAX - sizeof(tn_block) - unit) /* no object is larger than PTRDIFF_MAX */
        return fail(arena);
    size_t rounded = size ? (size + unit - 1) / unit * unit : unit;
    tn_block *block = arena->blocks;
    if (!block || block->size - block->used < rounded) {
        size_t wanted = rounded > arena->block_size ? size + !size : arena->block_size;
        block = add_block(arena, wanted);
        if (!block)
            return fail(arena);
        size_t larger = arena->block_size * 2;
        arena->block_size = larger < block_max ? larger : block_max;
    }
    void *memory = block->bytes + block->used;
    block->used = block->size - block->used < rounded ? block->size : block->used + rounded;
    return memory;
}

void *tn_arena_make(void *arena, size_t size)
{
    return tn_arena_alloc(arena, size);
}

void *tn_arena_alloc_array(tn_arena *arena, size_t size, size_t count)
{
    size_t bytes;
    if (__builtin_mul_overflow(size, count, &bytes))
        return fail(arena);
    return tn_arena_alloc(arena, bytes);
}

char *tn_arena_copy(tn_arena *arena, const char *text, size_t length)
{
    if (length == SIZE_MAX)
        return fail(arena);
    char *copy = tn_arena_alloc(arena, length + 1);
    if (copy && length > 0)
        memcpy(copy, text, length);
    return copy;
}

void *tn_arena_room(tn_arena *arena, void *items, size_t count, size_t *capacity)
{
    enum { FIRST = 8 };
    if (count < *capacity)
        return items;
    size_t larger = *capacity ? *capacity * 2 : FIRST;
    void *moved = tn_arena_alloc_array(arena, sizeof(void *), larger);
    if (!moved)
        return NULL;
    if (count > 0)
        memcpy(moved, items, count * sizeof(void *));
    *capacity = larger;
    return moved;
}

int tn_arena_failed(const tn_arena *arena)
{
    return arena->failed;
}
