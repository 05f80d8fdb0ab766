/* Finds the engine that a section, a kind of code or a kind of operands belongs to. */
#include "runtime/module/engine.h"

const tn_engine *tn_engine_of_section(const tn_engines *engines, tn_section section)
{
    for (size_t i = 0; i < engines->count; i++)
        for (const tn_section *own = engines->items[i]->sections; own && *own != TN_SECTION_STRINGS; own++)
            if (*own == section)
                return engines->items[i];
    return NULL;
}

const tn_engine *tn_engine_of_code(const tn_engines *engines, tn_code_kind code)
{
    for (size_t i = 0; i < engines->count; i++)
        if (engines->items[i]->codes >> code & 1)
            return engines->items[i];
    return NULL;
}

const tn_engine *tn_engine_of_terms(const tn_engines *engines, tn_function_kind kind)
{
    for (size_t i = 0; i < engines->count; i++)
        if (engines->items[i]->terms && engines->items[i]->term_kind == kind)
            return engines->items[i];
    return NULL;
}

void tn_engines_operands(const tn_engines *engines, const tn_operand_rules *rules[TN_OPERANDS_COUNT])
{
    for (size_t i = 0; i < TN_OPERANDS_COUNT; i++)
        rules[i] = NULL;
    for (size_t i = 0; i < engines->count; i++)
        for (size_t k = 0; k < engines->items[i]->operand_count; k++)
            rules[engines->items[i]->operands[k].kind] = &engines->items[i]->operands[k];
}
