#include "runtime/map/pages.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#define HUGE_PAGE ((size_t)2 << 20)
#define SMALL ((size_t)256 << 10) /* up to here the heap serves as well */

static size_t rounded(size_t size)
{
    size_t unit = size >= HUGE_PAGE ? HUGE_PAGE : (size_t)4096;
    return (size + unit - 1) & ~(unit - 1);
}

/* From the heap to a mapping of its own: too small for what it held to matter much. */
static void *map_fresh(const tn_pages *pages, size_t capacity)
{
    void *data = mmap(NULL, capacity, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (data == MAP_FAILED)
        return NULL;
    if (pages->data)
        memcpy(data, pages->data, pages->capacity);
    free(pages->data);
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
    size_t capacity = rounded(size);
    void *data;
    if (pages->capacity <= SMALL) {
        data = map_fresh(pages, capacity);
    } else {
        data = mremap(pages->data, pages->capacity, capacity, MREMAP_MAYMOVE);
        if (data == MAP_FAILED)
            data = NULL;
    }
    if (!data)
        return false;
    if (capacity >= HUGE_PAGE)
        madvise(data, capacity, MADV_HUGEPAGE); /* advice only: without huge pages it is merely slower */
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
