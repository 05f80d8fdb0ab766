/* Compares the code of functions: of two modules, or by a hash. */
#include "runtime/plan/match/same.h"

#include <stdlib.h>
#include <string.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "runtime/automata/numbering.h"
#include "runtime/module/code.h"

/* ---- a hash: reads functions in the order in which they are met, and writes the numbers of that order */

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
    add_number(r, 0); /* the power says how a sum is shown, and not what it is */
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

/* A library that is projected: what its plans are, without their lengths. */
static void add_library(reading *r, uint32_t index)
{
    const tn_library_record *library = &r->module->LIBRARY_records[index];
    add_number(r, library->schema);
    add_number(r, library->clause_count);
    for (uint32_t i = 0; i < library->clause_count; i++) {
        const tn_clause_record *clause = &r->module->CLAUSE_records[library->clause_first + i];
        add_number(r, clause->kind == TN_CLAUSE_PRUNE);
        add_function(r, clause->holds);
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
    else if (index && slot->section == TN_SECTION_LIBRARY)
        add_library(r, (uint32_t)value);
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

/* Pairs of functions that are to be the same: each is compared once. */
typedef struct comparer {
    const tn_module *a, *b;
    tn_numbering pairs; /* met, compared or not */
    tn_key pending;     /* two numbers a pair */
    bool different, failed;
} comparer;

static void add_pair(comparer *c, uint32_t f, uint32_t g)
{
    uint64_t key = (uint64_t)f << 32 | g;
    if (tn_number_find(&c->pairs, key) != UINT32_MAX)
        return;
    c->failed = c->failed || tn_number(&c->pairs, key) == UINT32_MAX || !tn_key_push(&c->pending, f) ||
                !tn_key_push(&c->pending, g);
}

static bool same_text(const comparer *c, tn_string a, tn_string b)
{
    return strcmp(tn_text(c->a, a), tn_text(c->b, b)) == 0;
}

static uint32_t mask_words(const tn_module *module, uint32_t schema)
{
    const tn_schema_record *record = &module->SCHEMA_records[schema];
    uint32_t values = 0;
    for (uint32_t i = 0; i < record->field_count; i++)
        values += module->FIELD_records[record->field_first + i].value_count;
    return (values + 63) / 64;
}

static bool same_spec(const comparer *c, uint32_t a, uint32_t b)
{
    uint32_t schema = c->a->SPEC_records[a].schema;
    if (schema != c->b->SPEC_records[b].schema)
        return false;
    for (uint32_t i = mask_words(c->a, schema); i-- > 0;)
        if (c->a->MASK_records[c->a->SPEC_records[a].mask_first + i].bits !=
            c->b->MASK_records[c->b->SPEC_records[b].mask_first + i].bits)
            return false;
    return true;
}

static bool same_term(comparer *c, const tn_term_record *a, const tn_term_record *b)
{
    bool tallies = a->tally != TN_NO_RECORD;
    if (a->kind != b->kind || tallies != (b->tally != TN_NO_RECORD) || !same_text(c, a->factor, b->factor))
        return false;
    add_pair(c, a->part, b->part);
    if (tallies)
        add_pair(c, a->tally, b->tally);
    return true;
}

static bool same_sum(comparer *c, uint32_t a, uint32_t b)
{
    const tn_sum_record *x = &c->a->SUM_records[a], *y = &c->b->SUM_records[b];
    bool same = x->schema == y->schema && x->term_count == y->term_count &&
                same_text(c, x->constant, y->constant);
    for (uint32_t i = 0; same && i < x->term_count; i++)
        same = same_term(c, &c->a->TERM_records[x->term_first + i], &c->b->TERM_records[y->term_first + i]);
    return same;
}

/* Libraries that are projected: the same clauses, in the same order. */
static bool same_library(comparer *c, uint32_t a, uint32_t b)
{
    const tn_library_record *x = &c->a->LIBRARY_records[a], *y = &c->b->LIBRARY_records[b];
    bool same = x->schema == y->schema && x->clause_count == y->clause_count;
    for (uint32_t i = 0; same && i < x->clause_count; i++) {
        const tn_clause_record *clause = &c->a->CLAUSE_records[x->clause_first + i];
        const tn_clause_record *other = &c->b->CLAUSE_records[y->clause_first + i];
        same = (clause->kind == TN_CLAUSE_PRUNE) == (other->kind == TN_CLAUSE_PRUNE);
        add_pair(c, clause->holds, other->holds);
    }
    return same;
}

static bool same_operand(comparer *c, const tn_slot *slot, int64_t a, int64_t b)
{
    if (slot->kind == TN_SLOT_STRING)
        return same_text(c, (tn_string)a, (tn_string)b);
    if (slot->kind != TN_SLOT_INDEX)
        return a == b;
    switch (slot->section) {
    case TN_SECTION_SPEC:
        return same_spec(c, (uint32_t)a, (uint32_t)b);
    case TN_SECTION_SUM:
        return same_sum(c, (uint32_t)a, (uint32_t)b);
    case TN_SECTION_FUNCTION:
        add_pair(c, (uint32_t)a, (uint32_t)b);
        return true;
    case TN_SECTION_LIBRARY:
        return same_library(c, (uint32_t)a, (uint32_t)b);
    default:
        return a == b;
    }
}

static bool same_code(comparer *c, const tn_function_record *f, const tn_function_record *g)
{
    bool same = f->kind == g->kind && f->code_end - f->code_begin == g->code_end - g->code_begin;
    for (uint32_t at = 0, length; same && at < f->code_end - f->code_begin; at += length) {
        tn_instruction a = tn_code_read(c->a->code, f->code_begin + at);
        tn_instruction b = tn_code_read(c->b->code, g->code_begin + at);
        const tn_slot *slots = tn_operand_slots[tn_code_operands((uint8_t)a.opcode)];
        length = a.length;
        same = a.opcode == b.opcode && same_operand(c, &slots[0], a.first, b.first) &&
               same_operand(c, &slots[1], a.second, b.second);
    }
    return same;
}

tn_status tn_functions_same(const tn_module *module, uint32_t function, const tn_module *other_module, uint32_t other,
                            bool *same, tn_error *error)
{
    comparer c = {.a = module, .b = other_module};
    add_pair(&c, function, other);
    while (c.pending.size > 0 && !c.different && !c.failed) {
        uint32_t g = c.pending.data[--c.pending.size], f = c.pending.data[--c.pending.size];
        c.different = !same_code(&c, &module->FUNCTION_records[f], &other_module->FUNCTION_records[g]);
    }
    tn_numbering_clear(&c.pairs);
    free(c.pending.data);
    *same = !c.different;
    return c.failed ? tn_fail_memory(error) : TN_OK;
}
