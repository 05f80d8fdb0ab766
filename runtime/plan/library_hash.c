/* The hash of what a library means: the schema as plans are written in it, the minimal automaton of the kept plans with
 * its columns by trays, and the lengths. Columns are in the order of their first trays and states breadth first, so
 * neither the wording nor the order of the rules shows. All numbers go in little-endian. */
#include <stdlib.h>
#include <string.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "runtime/plan/library_data.h"

static void add_number(XXH3_state_t *hash, uint64_t number)
{
    uint8_t bytes[8];
    for (int i = 0; i < 8; i++)
        bytes[i] = (uint8_t)(number >> (8 * i));
    XXH3_128bits_update(hash, bytes, sizeof bytes);
}

static void add_text(XXH3_state_t *hash, const tn_module *module, tn_string text)
{
    const char *bytes = tn_text(module, text);
    add_number(hash, strlen(bytes));
    XXH3_128bits_update(hash, bytes, strlen(bytes));
}

static void add_schema(XXH3_state_t *hash, const tn_schema *schema)
{
    add_number(hash, schema->field_count);
    for (uint32_t f = 0; f < schema->field_count; f++) {
        add_text(hash, schema->module, schema->fields[f].name);
        add_number(hash, schema->fields[f].kind);
        add_number(hash, schema->fields[f].value_count);
        for (uint32_t v = schema->value_start[f]; v < schema->value_start[f + 1]; v++) {
            add_text(hash, schema->module, schema->values[v].spelling);
            add_number(hash, (uint64_t)schema->values[v].length);
        }
    }
    add_number(hash, schema->tray_count);
    XXH3_128bits_update(hash, schema->tray_values, (size_t)schema->tray_count * schema->field_count);
}

static void add_automaton(XXH3_state_t *hash, const tn_library *library)
{
    const tn_dfa *kept = library->kept;
    add_number(hash, kept->states);
    add_number(hash, kept->columns);
    for (tn_tray t = 0; t < library->schema->tray_count; t++)
        add_number(hash, library->tray_column[t]);
    for (size_t i = 0; i < (size_t)kept->states * kept->columns; i++)
        add_number(hash, kept->delta[i]);
    XXH3_128bits_update(hash, kept->accept, kept->states);
}

void tn_library_hash(const tn_library *library, char hex[33])
{
    XXH3_state_t hash;
    XXH3_128bits_reset(&hash);
    add_schema(&hash, library->schema);
    add_automaton(&hash, library);
    add_number(&hash, library->min);
    add_number(&hash, library->max);
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(&hash));
    for (int i = 0; i < 16; i++) {
        hex[2 * i] = "0123456789abcdef"[canonical.digest[i] >> 4];
        hex[2 * i + 1] = "0123456789abcdef"[canonical.digest[i] & 15];
    }
    hex[32] = 0;
}
