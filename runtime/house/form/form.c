/* Makes a form ready: its zones from back to front, and the heights of its storeys. */
#include "runtime/house/form/form.h"

#include <string.h>

void tn_form_ready(const tn_module *module, uint32_t index, const tn_schema *schema, tn_house_form *form)
{
    const tn_form_record *record = &module->FORM_records[index];
    *form = (tn_house_form){.module = module, .record = record, .schema = schema};
    form->spine = record->spine - schema->record->field_first;
    form->width = tn_schema_length_field(schema);
    for (uint32_t f = 0; f < schema->field_count; f++)
        if (schema->fields[f].kind == TN_FIELD_ZONE)
            form->zones[form->zone_count++] = f;
    uint32_t rule = 0;
    for (uint32_t kind = 0; kind < TN_CELL_RULE_KIND_COUNT; kind++) {
        while (rule < record->rule_count && tn_form_rule(form, rule)->kind == kind)
            rule++;
        form->kinds_end[kind] = rule;
    }
    for (uint32_t i = 0; i < record->storey_count; i++)
        form->level[i + 1] = form->level[i] + module->STOREY_records[record->storey_first + i].height;
}

const char *tn_form_kind_text(const tn_house_form *form, uint32_t kind)
{
    static const char *const words[] = {"wall", "party", "open", "floor", "stair"};
    const tn_opening_record *declared = tn_form_declared(form, kind);
    return declared ? tn_text(form->module, declared->name) : words[kind];
}
