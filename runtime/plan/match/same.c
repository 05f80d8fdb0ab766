/* Compares the code of functions of two modules. */
#include "runtime/plan/match/same.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/automata/numbering.h"
#include "runtime/module/code.h"

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
    bool same = x->schema == y->schema && x->power == y->power && x->term_count == y->term_count &&
                same_text(c, x->constant, y->constant);
    for (uint32_t i = 0; same && i < x->term_count; i++)
        same = same_term(c, &c->a->TERM_records[x->term_first + i], &c->b->TERM_records[y->term_first + i]);
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
