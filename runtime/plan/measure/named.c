/* Finds measures of libraries. */
#include "runtime/plan/measure/named.h"

#include <string.h>

#include "runtime/plan/schema/sum.h"

const char *tn_named_measure(const tn_module *module, uint32_t measure)
{
    return measure == TN_PREFERENCE ? TN_PREFERENCE_NAME : tn_text(module, module->MEASURE_records[measure].name);
}

const char *tn_named_measure_doc(const tn_module *module, uint32_t measure)
{
    return measure == TN_PREFERENCE ? "" : tn_text(module, module->MEASURE_records[measure].doc);
}

uint32_t tn_named_measure_sum(const tn_module *module, const tn_library_record *library, uint32_t measure)
{
    return measure == TN_PREFERENCE ? tn_preferred_sum(module, library) : module->MEASURE_records[measure].sum;
}

uint32_t tn_named_measure_over(const tn_module *module, uint32_t measure)
{
    return measure == TN_PREFERENCE ? TN_NO_RECORD : module->MEASURE_records[measure].over;
}

int tn_named_measure_power(const tn_module *module, uint32_t measure)
{
    uint32_t over = tn_named_measure_over(module, measure);
    if (measure == TN_PREFERENCE)
        return 0;
    int power = (int)module->SUM_records[module->MEASURE_records[measure].sum].power;
    return over == TN_NO_RECORD ? power : power - (int)module->SUM_records[over].power;
}

bool tn_named_measure_partial(const tn_module *module, uint32_t measure)
{
    if (measure == TN_PREFERENCE)
        return false;
    const tn_sum_record *sum = &module->SUM_records[module->MEASURE_records[measure].sum];
    bool partial = module->MEASURE_records[measure].over != TN_NO_RECORD;
    for (uint32_t i = 0; i < sum->term_count; i++) {
        uint32_t kind = module->TERM_records[sum->term_first + i].kind;
        partial |= kind == TN_SUM_NEEDED || tn_term_is_gap(kind);
    }
    return partial;
}

uint32_t tn_named_measure_find(const tn_module *module, const tn_library_record *library, const char *name)
{
    uint32_t measure = TN_NO_RECORD;
    while (tn_named_measure_next(module, library, &measure))
        if (strcmp(tn_named_measure(module, measure), name) == 0)
            return measure;
    return TN_NO_RECORD;
}

bool tn_named_measure_next(const tn_module *module, const tn_library_record *library, uint32_t *measure)
{
    if (*measure == TN_PREFERENCE)
        return false;
    for (uint32_t i = *measure == TN_NO_RECORD ? 0 : *measure + 1; i < module->MEASURE_count; i++)
        if (module->MEASURE_records[i].schema == library->schema) {
            *measure = i;
            return true;
        }
    *measure = TN_PREFERENCE;
    return library->preference_count > 0;
}
