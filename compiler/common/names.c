/* Keeps names and what they stand for, in a hash table. */
#include "compiler/common/names.h"

#include <string.h>
#include <xxhash.h>

#include "runtime/module/module.h"

typedef struct wanted_name {
    const tn_name_entry *entries;
    const char *text;
} wanted_name;

static bool is_wanted(const void *context, uint32_t number)
{
    const wanted_name *w = context;
    return strcmp(w->entries[number].text, w->text) == 0;
}

static uint64_t hash_of(const char *text)
{
    return XXH3_64bits(text, strlen(text));
}

void *tn_names_get(const tn_names *names, const char *text)
{
    wanted_name wanted = {names->entries, text};
    uint32_t number = tn_hash_find(&names->index, hash_of(text), is_wanted, &wanted);
    return number == TN_HASH_NONE ? NULL : names->entries[number].value;
}

static bool grow(tn_names *names)
{
    size_t capacity = names->capacity > 0 ? names->capacity * 2 : 16;
    tn_name_entry *entries = TN_NEW_ARRAY(names->arena, tn_name_entry, capacity);
    if (!entries)
        return false;
    if (names->count)
        memcpy(entries, names->entries, names->count * sizeof *entries);
    names->entries = entries;
    names->capacity = capacity;
    return true;
}

void tn_names_put(tn_names *names, const char *text, void *value)
{
    if (names->count == names->capacity && !grow(names))
        return;
    uint32_t number = (uint32_t)names->count;
    wanted_name wanted = {names->entries, text};
    names->index.make = tn_arena_make;
    names->index.from = names->arena;
    if (tn_hash_enter(&names->index, hash_of(text), is_wanted, &wanted, &number, NULL) != TN_OK)
        return;
    names->count += number == names->count;
    names->entries[number] = (tn_name_entry){text, value};
}

bool tn_name_fits(tn_diagnostics *diagnostics, const char *name, tn_span span)
{
    if (strlen(name) <= TN_NAME_MAX)
        return true;
    tn_diagnostic *d =
        tn_report(diagnostics, E_NAME_TOO_LONG, span, "this name is longer than the limit of %u bytes", TN_NAME_MAX);
    tn_help(diagnostics, d, "choose a shorter name; what it means can stand in a text after it");
    return false;
}
