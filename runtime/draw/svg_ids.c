/* Numbers the ids of an SVG afresh, so that the same picture has the same bytes. */
#include "runtime/draw/svg_ids.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"

/* An id as it was: a stretch of the text. Its index is its new number. */
typedef struct id_name {
    const char *text;
    size_t size;
} id_name;

typedef struct renumbering {
    id_name *names;
    size_t count, capacity;
    size_t *slots; /* hash table of index + 1; its size is a power of two at least twice the capacity */
    size_t slot_count;
    char *out;
    size_t size, room;
} renumbering;

/* Where an id is defined or referred to in what cairo writes. */
static const char *const before_id[] = {"id=\"", "url(#", "href=\"#"};

static size_t hash_of(const char *text, size_t size)
{
    uint64_t hash = UINT64_C(14695981039346656037); /* FNV-1a */
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ (unsigned char)text[i]) * UINT64_C(1099511628211);
    return (size_t)hash;
}

static size_t *slot_of(const renumbering *r, const char *text, size_t size)
{
    for (size_t i = hash_of(text, size);; i++) {
        size_t *slot = &r->slots[i & (r->slot_count - 1)];
        if (!*slot || (r->names[*slot - 1].size == size && memcmp(r->names[*slot - 1].text, text, size) == 0))
            return slot;
    }
}

static bool grow_names(renumbering *r)
{
    size_t capacity = tn_array_larger(r->capacity, 0, 64); /* a power of two */
    if (!tn_array_resize(&r->names, capacity, sizeof *r->names))
        return false;
    size_t *slots = calloc(capacity * 2, sizeof *slots);
    if (!slots)
        return false;
    free(r->slots);
    r->slots = slots;
    r->slot_count = capacity * 2;
    r->capacity = capacity;
    for (size_t i = 0; i < r->count; i++)
        *slot_of(r, r->names[i].text, r->names[i].size) = i + 1;
    return true;
}

static bool number_of(renumbering *r, const char *text, size_t size, size_t *number)
{
    if (r->count == r->capacity && !grow_names(r))
        return false;
    size_t *slot = slot_of(r, text, size);
    if (!*slot) {
        r->names[r->count] = (id_name){text, size};
        *slot = ++r->count;
    }
    *number = *slot - 1;
    return true;
}

static bool append(renumbering *r, const char *text, size_t size)
{
    if (!tn_array_reserve(&r->out, &r->room, r->size, size + 1, 1))
        return false;
    memcpy(r->out + r->size, text, size);
    r->size += size;
    r->out[r->size] = '\0';
    return true;
}

/* The length of what stands before an id at `at`, or 0. */
static size_t prefix_at(const char *at, size_t left)
{
    for (size_t i = 0; i < sizeof before_id / sizeof *before_id; i++) {
        if (*at != *before_id[i])
            continue;
        size_t length = strlen(before_id[i]);
        if (left > length && memcmp(at, before_id[i], length) == 0)
            return length;
    }
    return 0;
}

static bool renumber(renumbering *r, const char *text, size_t size, const char *new_prefix)
{
    size_t copied = 0;
    for (size_t i = 0; i < size; i++) {
        size_t prefix = prefix_at(text + i, size - i);
        if (!prefix)
            continue;
        size_t begin = i + prefix, end = begin;
        while (end < size && text[end] != '"' && text[end] != ')')
            end++;
        size_t number;
        char name[64];
        if (!number_of(r, text + begin, end - begin, &number))
            return false;
        int length = snprintf(name, sizeof name, "%.32s%zu", new_prefix, number);
        if (!append(r, text + copied, begin - copied) || !append(r, name, (size_t)length))
            return false;
        copied = end;
        i = end;
    }
    return append(r, text + copied, size - copied);
}

tn_status tn_svg_renumber(const char *text, size_t size, const char *prefix, char **renumbered, size_t *renumbered_size,
                          tn_error *error)
{
    renumbering r = {0};
    bool done = renumber(&r, text, size, prefix);
    free(r.names);
    free(r.slots);
    if (!done) {
        free(r.out);
        return tn_fail_memory(error);
    }
    *renumbered = r.out;
    *renumbered_size = r.size;
    return TN_OK;
}
