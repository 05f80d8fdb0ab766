/* Verifies and lists the schemas of a module and the tray specifiers over them. */
#include "runtime/plan/schema/list.h"

#include <string.h>

#include "runtime/module/engine.h"
#include "runtime/module/lister.h"
#include "runtime/module/verify.h"

/* ---- verifying */

/* Do two values of a field mean the same, however they are spelled? */
static bool same_value(const tn_module *module, uint32_t kind, const tn_value_record *a, const tn_value_record *b)
{
    bool by_length = kind == TN_FIELD_LENGTH || kind == TN_FIELD_ZONE;
    if (by_length && a->length != b->length)
        return false;
    return kind == TN_FIELD_LENGTH || strcmp(tn_text(module, a->name), tn_text(module, b->name)) == 0;
}

/* Each value once. There are at most TN_VALUES_MAX, so comparing each two is little work. */
static tn_status check_values(const tn_checker *checker, const tn_field_record *field, const tn_value_record *values)
{
    for (uint32_t i = 1; i < field->value_count; i++)
        for (uint32_t k = 0; k < i; k++)
            if (same_value(checker->module, field->kind, &values[i], &values[k]))
                return tn_refuse(checker, "two values of a field are the same");
    return TN_OK;
}

static tn_status check_field(const tn_checker *checker, uint32_t index)
{
    const tn_module *module = checker->module;
    const tn_field_record *field = &module->FIELD_records[index];
    if (field->kind == TN_FIELD_FLAG && field->value_count != 2)
        return tn_refuse(checker, "field %u is a flag with %u values instead of 2", index, field->value_count);
    const tn_value_record *values = &module->VALUE_records[field->value_first];
    tn_status status = check_values(checker, field, values);
    if (status != TN_OK)
        return status;
    return tn_check_different(checker, &values->spelling, sizeof *values, field->value_count,
                              "two values of a field are spelled alike");
}

/* Is the field what the older one is, with its values in their order, and perhaps more? */
static bool has_values(const tn_module *module, const tn_field_record *field, const tn_field_record *older)
{
    bool same = field->kind == older->kind && field->value_count >= older->value_count &&
                strcmp(tn_text(module, field->name), tn_text(module, older->name)) == 0;
    for (uint32_t v = 0; same && v < older->value_count; v++)
        same = same_value(module, field->kind, &module->VALUE_records[field->value_first + v],
                          &module->VALUE_records[older->value_first + v]);
    return same;
}

static tn_status check_older(const tn_checker *checker, const tn_schema_record *schema, uint32_t index)
{
    const tn_module *module = checker->module;
    if (schema->from == TN_NO_RECORD)
        return TN_OK;
    const tn_schema_record *older = &module->SCHEMA_records[schema->from];
    bool has = older->field_count <= schema->field_count;
    for (uint32_t i = 0; has && i < older->field_count; i++)
        has = has_values(module, &module->FIELD_records[schema->field_first + i],
                         &module->FIELD_records[older->field_first + i]);
    return has ? TN_OK : tn_refuse(checker, "schema %u lacks a field or value of the schema it is made from", index);
}

/* A decimal number above 0, as it is written once. */
static bool is_count(const char *text)
{
    return text[0] != '0' && text[strspn(text, "0123456789")] == '\0';
}

/* Of a library, or made from one that is: its trays stand for plans. */
static tn_status check_tray_plans(const tn_checker *checker, const tn_schema_record *schema, uint32_t index)
{
    const tn_module *module = checker->module;
    if ((schema->of == TN_NO_RECORD) != (schema->tray_plans_count == 0))
        return tn_refuse(checker, "schema %u does not say for how many plans its trays stand, or of which library",
                         index);
    for (uint32_t i = 0; i < schema->tray_plans_count; i++) {
        const tn_tray_plans_record *record = &module->TRAY_PLANS_records[schema->tray_plans_first + i];
        if (module->SPEC_records[record->spec].schema != index)
            return tn_refuse(checker, "schema %u says for how many plans trays of another schema stand", index);
        if (!is_count(tn_text(module, record->plans)))
            return tn_refuse(checker, "the trays of a schema stand for a number of plans that is none");
    }
    return TN_OK;
}

static tn_status check_schema(const tn_checker *checker, uint32_t index)
{
    const tn_module *module = checker->module;
    const tn_schema_record *schema = &module->SCHEMA_records[index];
    const tn_field_record *fields = &module->FIELD_records[schema->field_first];
    for (uint32_t i = 0; i < schema->field_count; i++) {
        tn_status status = check_field(checker, schema->field_first + i);
        if (status != TN_OK)
            return status;
    }
    for (uint32_t i = 0; i < schema->forbid_count; i++)
        if (module->SPEC_records[schema->forbid_first + i].schema != index)
            return tn_refuse(checker, "schema %u forbids a tray of another schema", index);
    tn_status status = check_older(checker, schema, index);
    if (status == TN_OK)
        status = check_tray_plans(checker, schema, index);
    if (status != TN_OK)
        return status;
    return tn_check_different(checker, &fields->name, sizeof *fields, schema->field_count,
                              "two fields of a schema have the same name");
}

/* The schema's values; its fields' values follow one another. */
static uint32_t schema_values(const tn_module *module, uint32_t schema)
{
    const tn_schema_record *record = &module->SCHEMA_records[schema];
    const tn_field_record *first = &module->FIELD_records[record->field_first];
    const tn_field_record *last = first + record->field_count - 1;
    return last->value_first + last->value_count - first->value_first;
}

static tn_status check_specs(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    for (size_t i = 0; i < module->SPEC_count; i++) {
        const tn_spec_record *spec = &module->SPEC_records[i];
        uint32_t values = schema_values(module, spec->schema), words = (values + 63) / 64;
        if (words > module->MASK_count - spec->mask_first)
            return tn_refuse(checker, "specifier %zu has bits that are not there", i);
        uint64_t last = (uint64_t)module->MASK_records[spec->mask_first + words - 1].bits;
        if (values % 64 != 0 && last >> (values % 64) != 0)
            return tn_refuse(checker, "specifier %zu has a bit beyond the schema's last value", i);
    }
    return TN_OK;
}

/* A flag has two values; values of a field differ in what they mean and in how they are spelled, fields of a schema and
 * schemas in their names; forbidden trays and
 * specifiers are of the schema, with no bit beyond its last value. */
static tn_status verify(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    for (uint32_t i = 0; i < module->SCHEMA_count; i++) {
        tn_status status = check_schema(checker, i);
        if (status != TN_OK)
            return status;
    }
    tn_status status = tn_check_different(checker, &module->SCHEMA_records->name, sizeof *module->SCHEMA_records,
                                          module->SCHEMA_count, "two schemas have the same name");
    return status == TN_OK ? check_specs(checker) : status;
}

/* ---- listing specifiers */

/* A line under construction that is cut where it grows too long. */
typedef struct tn_phrase {
    char text[TN_TEXT_SHOWN + 1];
    size_t size;
    bool cut;
} tn_phrase;

static void say(tn_phrase *phrase, const char *text)
{
    if (phrase->cut)
        return;
    size_t size = strlen(text);
    if (size > TN_TEXT_SHOWN - 3 - phrase->size) {
        phrase->cut = true;
        text = "...";
        size = 3;
    }
    memcpy(phrase->text + phrase->size, text, size + 1);
    phrase->size += size;
}

static bool has_bit(const tn_module *module, const tn_spec_record *spec, uint32_t bit)
{
    uint64_t word = (uint64_t)module->MASK_records[spec->mask_first + bit / 64].bits;
    return word >> (bit % 64) & 1;
}

/* "width 4'|8'": the values of one field that the specifier allows; nothing where it allows all. */
static void describe_field(const tn_module *module, const tn_spec_record *spec, const tn_field_record *field,
                           uint32_t first_bit, tn_phrase *phrase)
{
    uint32_t allowed = 0;
    for (uint32_t i = 0; i < field->value_count; i++)
        allowed += has_bit(module, spec, first_bit + i);
    if (allowed == field->value_count)
        return;
    say(phrase, phrase->size ? ", " : "");
    say(phrase, tn_text(module, field->name));
    say(phrase, allowed ? " " : " none");
    const char *between = "";
    for (uint32_t i = 0; i < field->value_count && !phrase->cut; i++) {
        if (!has_bit(module, spec, first_bit + i))
            continue;
        say(phrase, between);
        say(phrase, tn_text(module, module->VALUE_records[field->value_first + i].spelling));
        between = "|";
    }
}

static void describe_spec(const tn_module *module, uint32_t index, tn_phrase *phrase)
{
    const tn_spec_record *spec = &module->SPEC_records[index];
    const tn_schema_record *schema = &module->SCHEMA_records[spec->schema];
    uint32_t first_value = module->FIELD_records[schema->field_first].value_first;
    for (uint32_t i = 0; i < schema->field_count && !phrase->cut; i++) {
        const tn_field_record *field = &module->FIELD_records[schema->field_first + i];
        describe_field(module, spec, field, field->value_first - first_value, phrase);
    }
    if (phrase->size == 0)
        say(phrase, "any tray");
}

void tn_list_spec(tn_lister *lister, uint32_t index)
{
    tn_phrase phrase = {0};
    describe_spec(lister->module, index, &phrase);
    tn_list_text(lister, phrase.text);
}

/* ---- listing tables */

static void list_value(tn_lister *lister, tn_field_kind kind, const tn_value_record *value)
{
    static const char *const roles[] = {"", ", solid", ", void", ", absent"};
    fputs("      ", lister->out);
    tn_list_name(lister, value->spelling);
    if (kind == TN_FIELD_ZONE) {
        fputs("  fill ", lister->out);
        tn_list_name(lister, value->name);
        fprintf(lister->out, ", %lld nm%s", (long long)value->length, roles[value->role]);
    } else if (kind == TN_FIELD_LENGTH) {
        fprintf(lister->out, "  %lld nm", (long long)value->length);
    }
    tn_list_doc(lister, value->doc);
    fputc('\n', lister->out);
}

static void list_field(tn_lister *lister, uint32_t index)
{
    static const char *const kinds[] = {"length", "choice", "flag", "zone"};
    static const char *const roles[] = {"",
                                        ", role length",
                                        ", role level",
                                        ", role public-end",
                                        ", role great-hall",
                                        ", role band",
                                        ", role text",
                                        ", role tone",
                                        ", role hatch"};
    const tn_field_record *field = &lister->module->FIELD_records[index];
    fprintf(lister->out, "  field %u  ", index);
    tn_list_name(lister, field->name);
    fprintf(lister->out, ": %s%s", kinds[field->kind], roles[field->role]);
    if (*tn_text(lister->module, field->said_by)) {
        fputs(", said by ", lister->out);
        tn_list_name(lister, field->said_by);
    }
    tn_list_doc(lister, field->doc);
    fputc('\n', lister->out);
    for (uint32_t i = 0; i < field->value_count; i++)
        list_value(lister, (tn_field_kind)field->kind, &lister->module->VALUE_records[field->value_first + i]);
}

static void list_schema(tn_lister *lister, uint32_t index)
{
    const tn_schema_record *schema = &lister->module->SCHEMA_records[index];
    fprintf(lister->out, "\nschema %u  ", index);
    tn_list_name(lister, schema->name);
    if (schema->from != TN_NO_RECORD)
        fprintf(lister->out, " from schema %u", schema->from);
    if (schema->of != TN_NO_RECORD)
        fprintf(lister->out, " of library %u", schema->of);
    tn_list_doc(lister, schema->doc);
    tn_list_place(lister, schema->file, schema->begin);
    for (uint32_t i = 0; i < schema->field_count; i++)
        list_field(lister, schema->field_first + i);
    for (uint32_t i = 0; i < schema->forbid_count; i++)
        fprintf(lister->out, "  forbids specifier %u\n", schema->forbid_first + i);
    for (uint32_t i = 0; i < schema->tray_plans_count; i++) {
        const tn_tray_plans_record *record = &lister->module->TRAY_PLANS_records[schema->tray_plans_first + i];
        fprintf(lister->out, "  specifier %u stands for %s plans\n", record->spec,
                tn_text(lister->module, record->plans));
    }
}

static void list_specs(tn_lister *lister)
{
    if (lister->module->SPEC_count > 0)
        fputs("\nspecifiers\n", lister->out);
    for (uint32_t i = 0; i < lister->module->SPEC_count; i++) {
        fprintf(lister->out, "  %u  ", i);
        tn_list_spec(lister, i);
        fputc('\n', lister->out);
    }
}

static void list(tn_lister *lister)
{
    for (uint32_t i = 0; i < lister->module->SCHEMA_count; i++)
        list_schema(lister, i);
    list_specs(lister);
}

static const tn_section sections[] = {TN_SECTION_SCHEMA, TN_SECTION_FIELD,      TN_SECTION_VALUE,  TN_SECTION_SPEC,
                                      TN_SECTION_MASK,   TN_SECTION_TRAY_PLANS, TN_SECTION_STRINGS};

extern const tn_engine tn_engine_schema;
const tn_engine tn_engine_schema = {.name = "schema", .sections = sections, .verify = verify, .list = list};
