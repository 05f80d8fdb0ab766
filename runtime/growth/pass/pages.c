/* Keeps arrays that are used again from step to step. */
#include "runtime/growth/pass/pages.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

#if defined(__linux__) && !defined(TN_PAGES_ON_HEAP)
#include <sys/mman.h>
#include <unistd.h>

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

/* Whole huge pages, and small ones for a short rest: counts are often a little more than a power of two, and clearing a
 * huge page for that little takes longer than what is done there. */
static size_t capacity_for(size_t size)
{
    size_t rest = size % HUGE_PAGE, small = (size_t)sysconf(_SC_PAGESIZE);
    size_t unit = rest > HUGE_PAGE / 2 ? HUGE_PAGE : small;
    return size - rest + (rest + unit - 1) / unit * unit;
}

/* A larger mapping that holds what there was: its huge pages are taken over; the rest, or what was on the heap, is
 * copied, so that it is in a huge page now. */
static void *enlarge(const tn_pages *pages, size_t capacity)
{
    char *data = map_aligned(capacity), *old = pages->data;
    if (!data)
        return NULL;
    size_t whole = pages->capacity > SMALL ? pages->capacity / HUGE_PAGE * HUGE_PAGE : 0;
    if (whole && mremap(old, whole, capacity, MREMAP_MAYMOVE | MREMAP_FIXED, data) == MAP_FAILED) {
        munmap(data, capacity);
        return NULL;
    }
    if (pages->capacity > whole)
        memcpy(data + whole, old + whole, pages->capacity - whole);
    if (pages->capacity <= SMALL)
        free(old);
    else if (pages->capacity > whole)
        munmap(old + whole, pages->capacity - whole);
    return data;
}

/* Makes it larger than the heap serves. */
static bool reserve_large(tn_pages *pages, size_t size)
{
    size_t capacity = capacity_for(size);
    void *data = enlarge(pages, capacity);
    if (!data)
        return false;
    *pages = (tn_pages){data, capacity};
    return true;
}

static void release_large(tn_pages *pages)
{
    munmap(pages->data, pages->capacity);
}

#else
#define SMALL SIZE_MAX

static bool reserve_large(tn_pages *pages, size_t size)
{
    (void)pages, (void)size;
    return false;
}

static void release_large(tn_pages *pages)
{
    (void)pages;
}
#endif

bool tn_pages_reserve(tn_pages *pages, uint64_t size)
{
    if (size <= pages->capacity && pages->data)
        return true;
    if (size > SIZE_MAX / 2)
        return false;
    if (size > SMALL)
        return reserve_large(pages, (size_t)size);
    if (!tn_array_resize(&pages->data, (size_t)size, 1))
        return false;
    pages->capacity = (size_t)size;
    return true;
}

void tn_pages_release(tn_pages *pages)
{
    if (pages->capacity > SMALL)
        release_large(pages);
    else
        free(pages->data);
    *pages = (tn_pages){0};
}
