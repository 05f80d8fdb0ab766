/* The trays of one schema in terms of another. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/plan/library/diff.h"
#include "runtime/plan/text/text.h"

static const char *field_name(const tn_schema *schema, uint32_t field)
{
    return tn_text(schema->module, schema->fields[field].name);
}

static tn_status differ(tn_error *error, const char *what)
{
    tn_fail(error, TN_INVALID, E_OTHER_TRAYS, "the two libraries are not of the same trays: %s", what);
    tn_error_help(error, "compare libraries of one schema");
    return TN_INVALID;
}

/* Lengths are the same where they are equal, whatever their spelling. */
static bool same_value(const tn_schema *from, uint32_t field, const tn_value_record *value, const tn_schema *to,
                       const tn_value_record *other)
{
    if (from->fields[field].kind == TN_FIELD_LENGTH)
        return value->length == other->length;
    if (from->fields[field].kind == TN_FIELD_ZONE)
        return value->length == other->length &&
               strcmp(tn_text(from->module, value->name), tn_text(to->module, other->name)) == 0;
    return from->fields[field].kind == TN_FIELD_FLAG ||
           strcmp(tn_text(from->module, value->name), tn_text(to->module, other->name)) == 0;
}

/* A field's values as indices in the other field; `values` has room for them. */
static tn_status map_values(const tn_schema *from, uint32_t field, const tn_schema *to, uint32_t other, uint8_t *values,
                            tn_error *error)
{
    uint32_t count = from->fields[field].value_count, others = to->fields[other].value_count;
    for (uint32_t v = 0; v < count; v++) {
        const tn_value_record *value = &from->values[from->value_start[field] + v];
        uint32_t o = from->fields[field].kind == TN_FIELD_FLAG ? v : 0;
        while (o < others && !same_value(from, field, value, to, &to->values[to->value_start[other] + o]))
            o++;
        if (o == others) {
            char what[300];
            snprintf(what, sizeof what, "only one has the value `%.80s` of `%.80s`",
                     tn_text(from->module, value->spelling), field_name(from, field));
            return differ(error, what);
        }
        values[v] = (uint8_t)o;
    }
    return TN_OK;
}

void tn_field_map_clear(tn_field_map *map)
{
    free(map->fields);
    free(map->values);
    *map = (tn_field_map){0};
}

tn_status tn_field_map_make(const tn_schema *from, const tn_schema *to, tn_field_map *map, tn_error *error)
{
    *map = (tn_field_map){calloc((size_t)from->field_count + 1, sizeof *map->fields),
                          calloc((size_t)from->value_count + 1, 1)};
    if (!map->fields || !map->values)
        return tn_fail_memory(error);
    for (uint32_t f = 0; f < from->field_count; f++) {
        char what[300];
        uint32_t field = map->fields[f] = tn_schema_field(to, field_name(from, f));
        if (field == UINT32_MAX || from->fields[f].kind != to->fields[field].kind) {
            snprintf(what, sizeof what, "only one has a field `%.80s`%s", field_name(from, f),
                     field == UINT32_MAX ? "" : " of this kind");
            return differ(error, what);
        }
        tn_status status = map_values(from, f, to, field, map->values + from->value_start[f], error);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

static tn_status forbidden(const tn_schema *schema, tn_tray tray, tn_error *error)
{
    tn_buffer line = {0};
    char what[400];
    bool ok = tn_plan_write_line(schema, &tray, 1, &line);
    snprintf(what, sizeof what, "only one allows the tray %.300s", ok && line.data ? line.data : "");
    free(line.data);
    return ok ? differ(error, what) : tn_fail_memory(error);
}

static tn_status map_trays(const tn_schema *from, const tn_schema *to, const tn_field_map *fields, tn_tray *map,
                           tn_error *error)
{
    uint8_t *mapped = calloc((size_t)to->field_count + 1, 1);
    if (!mapped)
        return tn_fail_memory(error);
    tn_status status = TN_OK;
    for (tn_tray t = 0; status == TN_OK && t < from->tray_count; t++) {
        for (uint32_t f = 0; f < from->field_count; f++)
            mapped[fields->fields[f]] = fields->values[from->value_start[f] + tn_tray_value(from, t, f)];
        map[t] = tn_schema_tray(to, mapped);
        if (map[t] == TN_NO_TRAY)
            status = forbidden(from, t, error);
    }
    free(mapped);
    return status;
}

static tn_status map_one_way(const tn_schema *from, const tn_schema *to, tn_tray *map, tn_error *error)
{
    tn_field_map fields;
    tn_status status = tn_field_map_make(from, to, &fields, error);
    if (status == TN_OK && from->field_count == to->field_count)
        status = map_trays(from, to, &fields, map, error);
    tn_field_map_clear(&fields);
    return status;
}

/* ---- trays that are not listed */

bool tn_same_trays(const tn_schema *a, const tn_schema *b)
{
    if (a->tray_count != b->tray_count || a->field_count != b->field_count || !a->legal != !b->legal)
        return false;
    if (!a->legal)
        return memcmp(a->tray_values, b->tray_values, (size_t)a->tray_count * a->field_count) == 0;
    const tn_interner *one = &a->legal->nodes, *other = &b->legal->nodes; /* equal trays, equal nodes */
    return one->words_used == other->words_used &&
           memcmp(one->words, other->words, one->words_used * sizeof *one->words) == 0;
}

/* Are the fields and values of both in one order? *same: they are. TN_INVALID where one has others. */
static tn_status compare_order(const tn_schema *from, const tn_schema *to, bool *same, tn_error *error)
{
    tn_field_map map;
    tn_status status = tn_field_map_make(from, to, &map, error);
    for (uint32_t f = 0; status == TN_OK && f < from->field_count; f++) {
        *same = *same && map.fields[f] == f;
        for (uint32_t v = 0; v < from->fields[f].value_count; v++)
            *same = *same && map.values[from->value_start[f] + v] == v;
    }
    tn_field_map_clear(&map);
    return status;
}

/* Only trays of the same numbers are compared. */
static tn_status check_unlisted(const tn_schema *from, const tn_schema *to, tn_error *error)
{
    bool same = true;
    tn_status status = compare_order(from, to, &same, error);
    if (status == TN_OK)
        status = compare_order(to, from, &same, error);
    if (status != TN_OK)
        return status;
    if (!same)
        return tn_schema_listed(from->legal ? from : to, "comparing libraries whose fields have another order goes",
                                error);
    return tn_same_trays(from, to) ? TN_OK : differ(error, "only one allows some of the trays");
}

tn_status tn_tray_map(const tn_schema *from, const tn_schema *to, tn_tray **out, tn_error *error)
{
    *out = NULL;
    if (from->legal || to->legal)
        return check_unlisted(from, to, error);
    tn_tray *map = calloc((size_t)from->tray_count + 1, sizeof *map);
    tn_tray *back = calloc((size_t)to->tray_count + 1, sizeof *back);
    tn_status status = map && back ? map_one_way(from, to, map, error) : tn_fail_memory(error);
    if (status == TN_OK) /* what only the other one has */
        status = map_one_way(to, from, back, error);
    free(back);
    if (status != TN_OK) {
        free(map);
        return status;
    }
    *out = map;
    return TN_OK;
}
