/* Reads the code of functions in the order in which they are met, and writes the numbers of that order for those of the
 * module. */
#include "runtime/plan/match/code_hash.h"

#include <stdlib.h>
#include <string.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "runtime/automata/numbering.h"
#include "runtime/module/code.h"

typedef struct reading {
    const tn_module *module;
    XXH3_state_t hash;
    tn_numbering met; /* functions */
    tn_key functions; /* the same, in order */
    uint32_t schema;  /* of the one that is read */
    bool failed;
} reading;

static void add_number(reading *r, uint64_t number)
{
    uint8_t bytes[8];
    for (int i = 0; i < 8; i++)
        bytes[i] = (uint8_t)(number >> (8 * i));
    XXH3_128bits_update(&r->hash, bytes, sizeof bytes);
}

static void add_text(reading *r, tn_string text)
{
    const char *bytes = tn_text(r->module, text);
    add_number(r, strlen(bytes));
    XXH3_128bits_update(&r->hash, bytes, strlen(bytes));
}

static void add_function(reading *r, uint32_t function)
{
    uint32_t before = r->met.count, number = tn_number(&r->met, function);
    r->failed = r->failed || number == UINT32_MAX || (number == before && !tn_key_push(&r->functions, function));
    add_number(r, number);
}

static void add_spec(reading *r, uint32_t spec)
{
    const tn_module *module = r->module;
    const tn_spec_record *record = &module->SPEC_records[spec];
    const tn_schema_record *schema = &module->SCHEMA_records[record->schema];
    uint32_t values = 0;
    for (uint32_t i = 0; i < schema->field_count; i++)
        values += module->FIELD_records[schema->field_first + i].value_count;
    for (uint32_t i = 0; i < (values + 63) / 64; i++)
        add_number(r, module->MASK_records[record->mask_first + i].bits);
}

static void add_sum(reading *r, uint32_t index)
{
    const tn_sum_record *sum = &r->module->SUM_records[index];
    add_number(r, sum->power);
    add_text(r, sum->constant);
    add_number(r, sum->term_count);
    for (uint32_t i = 0; i < sum->term_count; i++) {
        const tn_term_record *term = &r->module->TERM_records[sum->term_first + i];
        add_number(r, term->kind);
        add_text(r, term->factor);
        add_function(r, term->part);
        add_number(r, term->tally != TN_NO_RECORD);
        if (term->tally != TN_NO_RECORD)
            add_function(r, term->tally);
    }
}

static void add_operand(reading *r, const tn_slot *slot, int64_t value)
{
    bool index = slot->kind == TN_SLOT_INDEX;
    if (slot->kind == TN_SLOT_STRING)
        add_text(r, (tn_string)value);
    else if (index && slot->section == TN_SECTION_SPEC)
        add_spec(r, (uint32_t)value);
    else if (index && slot->section == TN_SECTION_SUM)
        add_sum(r, (uint32_t)value);
    else if (index && slot->section == TN_SECTION_FUNCTION)
        add_function(r, (uint32_t)value);
    else if (index && slot->section == TN_SECTION_FIELD)
        add_number(r, (uint64_t)value - r->module->SCHEMA_records[r->schema].field_first);
    else
        add_number(r, (uint64_t)value);
}

static void add_code(reading *r, uint32_t function)
{
    const tn_function_record *record = &r->module->FUNCTION_records[function];
    if (record->kind != TN_FUNCTION_CONDITION)
        r->schema = record->schema;
    add_number(r, record->kind);
    add_number(r, record->code_end - record->code_begin);
    for (uint32_t at = record->code_begin; at < record->code_end;) {
        tn_instruction code = tn_code_read(r->module->code, at);
        const tn_slot *slots = tn_operand_slots[tn_code_operands((uint8_t)code.opcode)];
        add_number(r, (uint64_t)code.opcode);
        add_operand(r, &slots[0], code.first);
        add_operand(r, &slots[1], code.second);
        at += code.length;
    }
}

tn_status tn_code_hash(const tn_module *module, uint32_t function, uint64_t hash[2], tn_error *error)
{
    reading r = {.module = module};
    XXH3_128bits_reset(&r.hash);
    add_function(&r, function);
    for (size_t i = 0; i < r.functions.size && !r.failed; i++)
        add_code(&r, r.functions.data[i]);
    XXH128_hash_t found = XXH3_128bits_digest(&r.hash);
    hash[0] = found.low64;
    hash[1] = found.high64;
    tn_numbering_clear(&r.met);
    free(r.functions.data);
    return r.failed ? tn_fail_memory(error) : TN_OK;
}
