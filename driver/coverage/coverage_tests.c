/* Writes test cases that tell the changes which no test does. */
#include <stdlib.h>
#include <string.h>

#include "driver/coverage/coverage.h"
#include "driver/open/again.h"

const char *tn_covered_subject_name(const tn_covered *covered, const tn_covered_part *part)
{
    const tn_module *module = covered->opened->module;
    return part->telling.of_library ? tn_text(module, covered->library->name)
                                    : tn_text(module, module->RULE_records[part->telling.rule].name);
}

/* ---- plans as tests have them: what is not written takes its first value */

/* Is a word a value of one field alone, and no field? */
static bool is_clear(const tn_schema *schema, const char *name)
{
    size_t owners = 0;
    for (uint32_t f = 0; f < schema->field_count; f++) {
        bool named = schema->fields[f].kind == TN_FIELD_CHOICE || schema->fields[f].kind == TN_FIELD_ZONE, has = false;
        for (uint32_t v = schema->value_start[f]; named && v < schema->value_start[f + 1]; v++)
            has = has || strcmp(tn_text(schema->module, schema->values[v].name), name) == 0;
        owners += has;
    }
    return owners == 1 && tn_schema_field(schema, name) == UINT32_MAX;
}

static bool write_value(const tn_schema *schema, uint32_t field, const tn_value_record *value, tn_buffer *out)
{
    const tn_module *module = schema->module;
    const char *name = tn_text(module, value->name), *of = tn_text(module, schema->fields[field].name);
    const char *depth = tn_text(module, value->measure);
    switch (schema->fields[field].kind) {
    case TN_FIELD_FLAG:
        return tn_buffer_printf(out, "%s", of);
    case TN_FIELD_LENGTH:
        return field == tn_schema_length_field(schema) ? tn_buffer_printf(out, "%s", name)
                                                       : tn_buffer_printf(out, "%s %s", of, name);
    case TN_FIELD_ZONE:
        return tn_buffer_printf(out, "%s %s%s%s", of, name, *depth ? " " : "", depth);
    default:
        return is_clear(schema, name) ? tn_buffer_printf(out, "%s", name) : tn_buffer_printf(out, "%s %s", of, name);
    }
}

/* The length in any case, so that no tray is empty, or else the first field that can be written. */
static bool is_written(const tn_schema *schema, uint32_t field, uint32_t value)
{
    uint32_t length = tn_schema_length_field(schema);
    if (value > 0 || field == length)
        return true;
    return length == UINT32_MAX && field == 0;
}

static bool write_tray(const tn_schema *schema, tn_tray tray, tn_buffer *out)
{
    bool ok = true, first = true;
    for (uint32_t f = 0; ok && f < schema->field_count; f++) {
        uint32_t value = tn_tray_value(schema, tray, f);
        if (!is_written(schema, f, value))
            continue;
        ok = (first || tn_buffer_printf(out, " "));
        if (ok && value == 0 && schema->fields[f].kind == TN_FIELD_FLAG)
            ok = tn_buffer_printf(out, "not ");
        ok = ok && write_value(schema, f, tn_tray_value_record(schema, tray, f), out);
        first = false;
    }
    return ok;
}

bool tn_covered_case(const tn_covered *covered, const tn_covered_part *part, tn_buffer *out)
{
    const tn_telling *telling = &part->telling;
    const char *expected = telling->of_library ? (telling->now ? "keep" : "drop") : telling->now ? "match" : "reject";
    bool ok = tn_buffer_printf(out, "%s [", expected);
    for (size_t i = 0; ok && i < telling->length; i++)
        ok = (i == 0 || tn_buffer_printf(out, " | ")) && write_tray(covered->schema, telling->trays[i], out);
    return ok && tn_buffer_printf(out, "]") && (!telling->by || tn_buffer_printf(out, " by %s", telling->by));
}

/* ---- blocks */

static bool is_told(const tn_covered *covered, size_t i)
{
    return covered->parts[i].telling.found && covered->parts[i].telling.same_as == i;
}

static bool same_subject(const tn_covered *covered, size_t a, size_t b)
{
    const tn_telling *x = &covered->parts[a].telling, *y = &covered->parts[b].telling;
    return x->of_library == y->of_library && (x->of_library || x->rule == y->rule);
}

/* "# 12:5: `8'` of `tray(8')` changed to `12'`" for each change that the plan tells. */
static bool write_reasons(const tn_covered *covered, size_t told, tn_buffer *out)
{
    bool ok = true;
    for (size_t i = told; ok && i < covered->count; i++) {
        const tn_covered_part *part = &covered->parts[i];
        if (!part->telling.found || part->telling.same_as != told)
            continue;
        tn_place place = tn_covered_place(covered, part->place);
        ok = tn_buffer_printf(out, "  # %zu:%zu: `%s`%s%s%s ", place.line, place.column, part->text,
                              part->around ? " of `" : "", part->around ? part->around : "", part->around ? "`" : "") &&
             tn_covered_change(part, out) && tn_buffer_printf(out, "\n");
    }
    return ok;
}

static bool is_first(const tn_covered *covered, size_t i)
{
    for (size_t k = 0; k < i; k++)
        if (is_told(covered, k) && same_subject(covered, k, i))
            return false;
    return true;
}

/* The values of params with which the rules decide so: " with lot = 9m, side = right". */
static bool write_params(const tn_covered *covered, tn_buffer *out)
{
    tn_param_values params;
    bool ok = tn_opened_params(covered->opened, &params) == TN_OK;
    for (size_t i = 0; ok && i < params.count; i++) {
        const char *text = params.items[i], *equal = strchr(text, '=');
        ok = equal && tn_buffer_printf(out, "%s%.*s = %s", i == 0 ? " with " : ", ", (int)(equal - text), text,
                                       equal + 1 + strspn(equal + 1, " "));
    }
    free((void *)(uintptr_t)params.items);
    return ok;
}

static bool write_block(const tn_covered *covered, size_t first, tn_buffer *out)
{
    bool ok = tn_buffer_printf(out, "\ntest %s", tn_covered_subject_name(covered, &covered->parts[first])) &&
              write_params(covered, out) && tn_buffer_printf(out, " {\n");
    for (size_t i = first; ok && i < covered->count; i++)
        if (is_told(covered, i) && same_subject(covered, first, i))
            ok = write_reasons(covered, i, out) && tn_buffer_printf(out, "  ") &&
                 tn_covered_case(covered, &covered->parts[i], out) && tn_buffer_printf(out, "\n");
    return ok && tn_buffer_printf(out, "}\n");
}

bool tn_covered_tests(const tn_covered *covered, tn_buffer *out)
{
    size_t told = 0, untold = 0;
    bool ok = true;
    for (size_t i = 0; i < covered->count; i++) {
        told += is_told(covered, i);
        untold += !covered->parts[i].of_houses && !covered->parts[i].telling.found &&
                  (covered->parts[i].fate == TN_FATE_SURVIVES || covered->parts[i].fate == TN_FATE_UNKNOWN);
    }
    if (told == 0 && untold == 0)
        return tn_buffer_printf(out,
                                "# Every change of the rules that decides some plan otherwise makes a test fail.\n");
    if (told > 0)
        ok = tn_buffer_printf(out,
                              "# What the rules decide now. No test tells them from rules with the changes that are "
                              "named.\n# Keep a case if it is right; if it is wrong, mend the rule.\n");
    for (size_t i = 0; ok && i < covered->count; i++)
        if (is_told(covered, i) && is_first(covered, i))
            ok = write_block(covered, i, out);
    if (ok && untold > 0)
        ok = tn_buffer_printf(out, "# For %zu more changes no plan was found within the limits.\n", untold);
    return ok;
}
