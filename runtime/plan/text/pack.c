/* Packs trays into bytes. */
#include "runtime/plan/text/pack.h"

#include <stdlib.h>
#include <string.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "runtime/base/array.h"
#include "runtime/base/bytes.h"

unsigned tn_pack_tray_bytes(const tn_schema *schema)
{
    unsigned bytes = 1;
    while (bytes < 4 && schema->tray_count > UINT32_C(1) << (8 * bytes))
        bytes++;
    return bytes;
}

static void add_number(XXH3_state_t *hash, uint64_t number)
{
    uint8_t bytes[8];
    tn_put_u64(bytes, number);
    XXH3_64bits_update(hash, bytes, sizeof bytes);
}

static void add_text(XXH3_state_t *hash, const tn_module *module, tn_string string)
{
    const char *text = tn_text(module, string);
    XXH3_64bits_update(hash, text, strlen(text) + 1); /* with its zero byte, so that texts cannot run together */
}

uint64_t tn_pack_schema_hash(const tn_schema *schema)
{
    XXH3_state_t state, *hash = &state;
    XXH3_64bits_reset(hash);
    add_number(hash, schema->field_count);
    for (uint32_t f = 0; f < schema->field_count; f++) {
        add_text(hash, schema->module, schema->fields[f].name);
        add_number(hash, schema->fields[f].kind);
        add_number(hash, schema->fields[f].value_count);
    }
    for (uint32_t v = 0; v < schema->value_count; v++) {
        add_text(hash, schema->module, schema->values[v].name);
        add_number(hash, (uint64_t)schema->values[v].length);
    }
    if (schema->legal) { /* equal trays, equal nodes */
        for (size_t i = 0; i < schema->legal->nodes.words_used; i++)
            add_number(hash, schema->legal->nodes.words[i]);
        return XXH3_64bits_digest(hash);
    }
    XXH3_64bits_update(hash, schema->tray_values, (size_t)schema->tray_count * schema->field_count);
    return XXH3_64bits_digest(hash);
}

bool tn_pack_trays(const tn_schema *schema, const tn_tray *trays, size_t length, tn_buffer *out)
{
    unsigned tray_bytes = tn_pack_tray_bytes(schema);
    for (size_t k = 0; k < length; k++) {
        char bytes[4];
        for (unsigned i = 0; i < tray_bytes; i++)
            bytes[i] = (char)(trays[k] >> (8 * i) & 0xff);
        if (!tn_buffer_append(out, bytes, tray_bytes))
            return false;
    }
    return true;
}

bool tn_unpack_trays(const tn_schema *schema, const uint8_t *bytes, size_t length, tn_tray *trays)
{
    unsigned tray_bytes = tn_pack_tray_bytes(schema);
    for (size_t k = 0; k < length; k++) {
        tn_tray tray = 0;
        for (unsigned i = 0; i < tray_bytes; i++)
            tray |= (tn_tray)*bytes++ << (8 * i);
        if (tray >= schema->tray_count)
            return false;
        trays[k] = tray;
    }
    return true;
}

bool tn_plan_reserve(tn_plan *plan, size_t length)
{
    return tn_array_reserve_from(&plan->trays, &plan->capacity, 8, 0, length, sizeof *plan->trays);
}
