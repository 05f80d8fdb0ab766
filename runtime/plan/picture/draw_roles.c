/* What a schema's roles mean for drawing it. */
#include "runtime/plan/picture/draw_parts.h"

/* Can a band be absent, going by the roles and depths of its values? */
static bool may_be_absent(const tn_schema *schema, uint32_t field)
{
    for (uint32_t v = schema->value_start[field]; v < schema->value_start[field + 1]; v++)
        if (schema->values[v].role == TN_FILL_ABSENT || schema->values[v].length == 0)
            return true;
    return false;
}

static void take_choice(tn_draw_roles *roles, uint32_t field, tn_field_role role)
{
    uint32_t *taken = role == TN_ROLE_TEXT ? &roles->text : role == TN_ROLE_TONE ? &roles->tone : &roles->hatch;
    if (roles->schema->fields[field].kind == TN_FIELD_CHOICE && *taken == TN_NO_FIELD)
        *taken = field;
}

/* What a tray is for: the first field of three names or more that has no role, or else the first of two. */
static uint32_t main_choice(const tn_schema *schema)
{
    uint32_t found = TN_NO_FIELD;
    for (uint32_t f = 0; f < schema->field_count; f++) {
        if (schema->fields[f].kind != TN_FIELD_CHOICE || schema->fields[f].role != TN_ROLE_NONE)
            continue;
        if (schema->fields[f].value_count >= 3)
            return f;
        found = found == TN_NO_FIELD ? f : found;
    }
    return found;
}

static void take_role(tn_draw_roles *roles, uint32_t field)
{
    const tn_field_record *record = &roles->schema->fields[field];
    switch ((tn_field_role)record->role) {
    case TN_ROLE_LENGTH:
        if (record->kind == TN_FIELD_LENGTH && roles->length == TN_NO_FIELD)
            roles->length = field;
        break;
    case TN_ROLE_LEVEL:
        if (roles->level == TN_NO_FIELD)
            roles->level = field;
        break;
    case TN_ROLE_PUBLIC_END:
        if (record->kind == TN_FIELD_FLAG && roles->public_end == TN_NO_FIELD)
            roles->public_end = field;
        break;
    case TN_ROLE_GREAT_HALL:
        if (record->kind == TN_FIELD_FLAG && roles->great_hall == TN_NO_FIELD)
            roles->great_hall = field;
        break;
    case TN_ROLE_BAND:
        if (record->kind == TN_FIELD_ZONE && roles->band_count < TN_BANDS_MAX)
            roles->bands[roles->band_count++] = field;
        break;
    case TN_ROLE_TEXT:
    case TN_ROLE_TONE:
    case TN_ROLE_HATCH:
        take_choice(roles, field, (tn_field_role)record->role);
        break;
    case TN_ROLE_NONE:
    case TN_FIELD_ROLE_COUNT:
        break;
    }
}

void tn_draw_roles_find(const tn_schema *schema, tn_draw_roles *roles)
{
    *roles = (tn_draw_roles){schema,
                             .length = TN_NO_FIELD,
                             .level = TN_NO_FIELD,
                             .public_end = TN_NO_FIELD,
                             .great_hall = TN_NO_FIELD,
                             .text = TN_NO_FIELD,
                             .tone = TN_NO_FIELD,
                             .hatch = TN_NO_FIELD};
    for (uint32_t field = 0; field < schema->field_count; field++)
        take_role(roles, field);
    if (roles->text == TN_NO_FIELD)
        roles->text = roles->tone == TN_NO_FIELD ? main_choice(schema) : roles->tone;
    if (roles->tone == TN_NO_FIELD)
        roles->tone = roles->text;
    roles->to_scale = roles->length != TN_NO_FIELD && roles->band_count > 0;
    while (roles->spine < roles->band_count && may_be_absent(schema, roles->bands[roles->spine]))
        roles->spine++;
    if (roles->spine == roles->band_count)
        roles->spine = 0;
    uint32_t length = roles->length != TN_NO_FIELD ? roles->length : tn_schema_length_field(schema);
    if (length != TN_NO_FIELD)
        roles->style = tn_length_style_of(tn_text(schema->module, schema->values[schema->value_start[length]].name));
}

bool tn_draw_written(const tn_draw_roles *roles, uint32_t field)
{
    if (field == roles->length || field == roles->level || field == roles->public_end || field == roles->great_hall)
        return false;
    for (uint32_t b = 0; b < roles->band_count; b++)
        if (roles->bands[b] == field)
            return false;
    return true;
}

void tn_draw_length(const tn_draw_roles *roles, int64_t nanometres, char *text, size_t size)
{
    tn_length_write_style(nanometres, roles->style, text, size);
}
