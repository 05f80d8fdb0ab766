#include "runtime/map/pages.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#define HUGE_PAGE ((size_t)2 << 20)
#define SMALL ((size_t)512 << 10) /* up to here the heap serves as well */

/* A mapping that begins where a huge page does, untouched: what is first touched in small pages stays in them. */
static void *map_aligned(size_t capacity)
{
    char *data = mmap(NULL, capacity + HUGE_PAGE, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (data == MAP_FAILED)
        return NULL;
    size_t before = (HUGE_PAGE - (uintptr_t)data % HUGE_PAGE) % HUGE_PAGE;
    if (before)
        munmap(data, before);
    if (before < HUGE_PAGE)
        munmap(data + before + capacity, HUGE_PAGE - before);
    madvise(data + before, capacity, MADV_HUGEPAGE); /* advice only: without huge pages it is merely slower */
    return data + before;
}

/* A larger mapping that holds what there was: copied from the heap, where it was too small for that to matter; its
 * pages taken over otherwise. */
static void *enlarge(const tn_pages *pages, size_t capacity)
{
    void *data = map_aligned(capacity);
    if (!data)
        return NULL;
    if (pages->capacity > SMALL) {
        if (mremap(pages->data, pages->capacity, capacity, MREMAP_MAYMOVE | MREMAP_FIXED, data) == MAP_FAILED) {
            munmap(data, capacity);
            return NULL;
        }
    } else if (pages->data) {
        memcpy(data, pages->data, pages->capacity);
        free(pages->data);
    }
    return data;
}

bool tn_pages_reserve(tn_pages *pages, size_t size)
{
    if (size <= pages->capacity && pages->data)
        return true;
    if (size > SIZE_MAX / 2)
        return false;
    if (size <= SMALL) {
        void *data = realloc(pages->data, size ? size : 1);
        if (!data)
            return false;
        *pages = (tn_pages){data, size};
        return true;
    }
    size_t capacity = (size + HUGE_PAGE - 1) & ~(HUGE_PAGE - 1);
    void *data = enlarge(pages, capacity);
    if (!data)
        return false;
    *pages = (tn_pages){data, capacity};
    return true;
}

void tn_pages_release(tn_pages *pages)
{
    if (pages->capacity > SMALL)
        munmap(pages->data, pages->capacity);
    else
        free(pages->data);
    *pages = (tn_pages){0};
}
