/* Writes weights. */
#include "ask/plan/weights.h"

#include <stdlib.h>

#include "runtime/plan/measure/amount.h"

char *tn_weight_text(const mpq_t weight)
{
    tn_buffer text = {0};
    if (tn_amount_write((tn_amount_unit){0}, weight, &text) && tn_buffer_append(&text, "", 1))
        return text.data;
    free(text.data);
    return NULL;
}

bool tn_weights_say(const tn_ready_library *ready, tn_buffer *text)
{
    enum { SAID = 4 };
    const tn_module *module = ready->schema->module;
    const tn_library_record *record = ready->record;
    mpq_t factor;
    mpq_init(factor);
    bool ok = true;
    for (uint32_t i = 0; ok && i < record->weight_count && i < SAID; i++) {
        const tn_weight_record *weight = &module->WEIGHT_records[record->weight_first + i];
        mpq_set_str(factor, tn_text(module, weight->factor), 10);
        char *number = tn_weight_text(factor);
        ok = number && tn_buffer_printf(text, "%s`%s` %s", i ? ", " : "", tn_text(module, weight->name), number);
        free(number);
    }
    mpq_clear(factor);
    if (ok && record->weight_count > SAID)
        ok = tn_buffer_printf(text, " and %u more", record->weight_count - SAID);
    return ok;
}
