/* Keeps names and what they stand for in a hash table. */
#include "compiler/common/names.h"

#include <string.h>
#include <xxhash.h>

#include "runtime/module/module.h"

/* The place of a text: its entry, or the free entry where it belongs. At least one entry is free. */
static tn_name_entry *find(tn_name_entry *entries, size_t capacity, const char *text)
{
    size_t at = (size_t)XXH3_64bits(text, strlen(text)) & (capacity - 1);
    while (entries[at].text && strcmp(entries[at].text, text) != 0)
        at = (at + 1) & (capacity - 1);
    return &entries[at];
}

void *tn_names_get(const tn_names *names, const char *text)
{
    return names->capacity > 0 ? find(names->entries, names->capacity, text)->value : NULL;
}

static int grow(tn_names *names)
{
    size_t capacity = names->capacity > 0 ? names->capacity * 2 : 32;
    tn_name_entry *entries = TN_NEW_ARRAY(names->arena, tn_name_entry, capacity);
    if (!entries)
        return 0;
    for (size_t i = 0; i < names->capacity; i++)
        if (names->entries[i].text)
            *find(entries, capacity, names->entries[i].text) = names->entries[i];
    names->entries = entries;
    names->capacity = capacity;
    return 1;
}

void tn_names_put(tn_names *names, const char *text, void *value)
{
    if (names->count + 1 > names->capacity / 2 && !grow(names))
        return;
    tn_name_entry *entry = find(names->entries, names->capacity, text);
    names->count += entry->text == NULL;
    *entry = (tn_name_entry){text, value};
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
