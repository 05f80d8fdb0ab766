/* Memory of one compilation: allocate at will, free all at once. Everything that the compiler makes of a source
 * (AST, checked program) lives in one arena. */
#ifndef TARTAN_COMPILER_COMMON_ARENA_H
#define TARTAN_COMPILER_COMMON_ARENA_H

#include <stddef.h>

typedef struct tn_arena tn_arena;

tn_arena *tn_arena_new(void); /* NULL if out of memory */
void tn_arena_free(tn_arena *arena);

/* Zeroed memory, aligned for any type; NULL if out of memory, which is remembered. */
void *tn_arena_alloc(tn_arena *arena, size_t size);
void *tn_arena_alloc_array(tn_arena *arena, size_t size, size_t count); /* count items of that size */
char *tn_arena_copy(tn_arena *arena, const char *text, size_t length);  /* with a zero byte after it */

/* tn_arena_alloc, for a hash table (runtime/base/hash_table.h). */
void *tn_arena_make(void *arena, size_t size);

/* Room for one more item behind the `count` of an array of pointers in the arena: the array, moved where it was full,
 * or NULL if out of memory. */
void *tn_arena_room(tn_arena *arena, void *items, size_t count, size_t *capacity);

/* Did any allocation fail? */
int tn_arena_failed(const tn_arena *arena);

#define TN_NEW(arena, type) ((type *)tn_arena_alloc((arena), sizeof(type)))
#define TN_NEW_ARRAY(arena, type, count) ((type *)tn_arena_alloc_array((arena), sizeof(type), (count)))

/* Puts a node (NULL: nothing) behind the last of a list: something with `first` and `last`, whose nodes have `next`. */
#define TN_CHAIN(list, node)                                                                                           \
    do {                                                                                                               \
        if (!(node))                                                                                                   \
            break;                                                                                                     \
        if ((list)->last)                                                                                              \
            (list)->last->next = (node);                                                                               \
        else                                                                                                           \
            (list)->first = (node);                                                                                    \
        (list)->last = (node);                                                                                         \
    } while (0)

#endif
