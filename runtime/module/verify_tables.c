/* The tables: strings, places, schemas, specifiers, and what rules and libraries name. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/length.h"
#include "runtime/base/utf8.h"
#include "runtime/module/verify.h"

typedef struct tn_checker {
    const tn_module *module;
    tn_error *error;
    uint32_t *sizes;     /* bytes of each source's text */
    const char **sorted; /* room for the names of one set */
} tn_checker;

__attribute__((format(printf, 2, 3))) static tn_status refuse(const tn_checker *checker, const char *format, ...)
{
    char what[200];
    va_list args;
    va_start(args, format);
    vsnprintf(what, sizeof what, format, args);
    va_end(args);
    return tn_fail(checker->error, TN_INVALID, E_REFUSED_MODULE, "the module is refused: %s", what);
}

/* Is [first, first + count) the stretch that follows `*end` in a section of `total` records? Moves *end on. */
static bool follows(uint32_t first, uint32_t count, size_t total, size_t *end)
{
    if (first != *end || count > total - *end)
        return false;
    *end += count;
    return true;
}

/* ---- strings */

/* A string begins where another ends: no string is the tail of another. */
static bool is_string(const tn_module *module, tn_string string)
{
    return string < module->strings_size && (string == 0 || module->strings[string - 1] == '\0');
}

/* The first record of a section that has a string that is none or a number that is not finite, or the number of
 * records. */
#define FITS_STR(value) is_string(module, (value))
#define FITS_U32(value) true
#define FITS_I64(value) true
#define FITS_F64(value) isfinite(value)
#define F(KIND, FIELD) &&FITS_##KIND(record->FIELD)
#define SECTION(NAME, NUMBER, TYPE, FIELDS)                                                                            \
    static size_t bad_string_##NAME(const tn_module *module)                                                           \
    {                                                                                                                  \
        for (size_t i = 0; i < module->NAME##_count; i++) {                                                            \
            const TYPE *record = &module->NAME##_records[i];                                                           \
            if (!(record FIELDS))                                                                                      \
                return i;                                                                                              \
        }                                                                                                              \
        return module->NAME##_count;                                                                                   \
    }
#include "runtime/module/records.def"
#undef SECTION
#undef F

static tn_status check_strings(tn_checker *checker)
{
    const tn_module *module = checker->module;
    if (module->strings_size == 0 || module->strings[0] != '\0' || module->strings[module->strings_size - 1] != '\0')
        return refuse(checker, "its strings do not begin and end with a zero byte");
    if (!tn_is_utf8(module->strings, module->strings_size))
        return refuse(checker, "its strings are not UTF-8 text");
#define SECTION(NAME, NUMBER, TYPE, FIELDS)                                                                            \
    if (bad_string_##NAME(module) < module->NAME##_count)                                                              \
        return refuse(checker, "record %zu of " #NAME " has a string that is none, or a number that is not finite",    \
                      bad_string_##NAME(module));
#include "runtime/module/records.def"
#undef SECTION
    return TN_OK;
}

/* Names are looked up, compared and shown: they are neither empty nor endless. */
static bool is_text(const tn_module *module, tn_string text, size_t limit)
{
    return text != 0 && strnlen(tn_text(module, text), limit + 1) <= limit;
}

static bool is_name(const tn_module *module, tn_string name)
{
    return is_text(module, name, TN_NAME_MAX);
}

static bool is_spelling(const tn_module *module, tn_string spelling)
{
    return is_text(module, spelling, TN_SPELLING_MAX);
}

static int compare_names(const void *left, const void *right)
{
    const char *const *a = left, *const *b = right;
    return strcmp(*a, *b);
}

/* Are the first `count` names in checker->sorted different from one another? */
static bool all_different(tn_checker *checker, size_t count)
{
    qsort(checker->sorted, count, sizeof *checker->sorted, compare_names);
    for (size_t i = 1; i < count; i++)
        if (strcmp(checker->sorted[i - 1], checker->sorted[i]) == 0)
            return false;
    return true;
}

/* ---- sources and places */

/* Measures the texts; together they are no longer than a file may be (a text that many records share could otherwise
 * be measured without end). */
static tn_status check_sources(tn_checker *checker, const tn_module_limits *limits)
{
    const tn_module *module = checker->module;
    size_t left = limits->bytes < UINT32_MAX ? limits->bytes : UINT32_MAX;
    for (size_t i = 0; i < module->SOURCE_count; i++) {
        size_t size = strnlen(tn_text(module, module->SOURCE_records[i].text), left + 1);
        if (size > left)
            return tn_fail(checker->error, TN_LIMIT, E_MODULE_TOO_LARGE,
                           "the module's sources together pass the limit of %zu bytes", limits->bytes);
        left -= size;
        checker->sizes[i] = (uint32_t)size;
    }
    return TN_OK;
}

static bool is_place(const tn_checker *checker, uint32_t file, uint32_t begin, uint32_t end)
{
    return file < checker->module->SOURCE_count && begin <= end && end <= checker->sizes[file];
}

static tn_status check_places(const tn_checker *checker)
{
    const tn_module *module = checker->module;
#define CHECK_PLACES(NAME)                                                                                             \
    for (size_t i = 0; i < module->NAME##_count; i++)                                                                  \
        if (!is_place(checker, module->NAME##_records[i].file, module->NAME##_records[i].begin,                        \
                      module->NAME##_records[i].end))                                                                  \
            return refuse(checker, "record %zu of " #NAME " names a place outside its source", i);
    CHECK_PLACES(SCHEMA)
    CHECK_PLACES(SPEC)
    CHECK_PLACES(RULE)
    CHECK_PLACES(LIBRARY)
    CHECK_PLACES(CLAUSE)
    CHECK_PLACES(GROWTH)
    CHECK_PLACES(REWRITE_RULE)
    CHECK_PLACES(TEMPLATE)
    CHECK_PLACES(STUDY)
    CHECK_PLACES(FORCE)
    CHECK_PLACES(BOUNDARY)
    CHECK_PLACES(GOAL)
    CHECK_PLACES(MAP)
    CHECK_PLACES(GRAMMAR)
    CHECK_PLACES(NONTERMINAL)
    CHECK_PLACES(PRODUCTION)
    CHECK_PLACES(SETTING)
#undef CHECK_PLACES
    return TN_OK;
}

/* ---- schemas */

static tn_status check_value(tn_checker *checker, size_t index)
{
    const tn_module *module = checker->module;
    const tn_value_record *value = &module->VALUE_records[index];
    if (!is_name(module, value->name))
        return refuse(checker, "value %zu has no name of 1 to %u bytes", index, TN_NAME_MAX);
    if (!is_spelling(module, value->spelling))
        return refuse(checker, "value %zu has no spelling of 1 to %u bytes", index, TN_SPELLING_MAX);
    if (value->measure != 0 && !is_name(module, value->measure))
        return refuse(checker, "value %zu has a measure of more than %u bytes", index, TN_NAME_MAX);
    if (value->role >= TN_FILL_ROLE_COUNT)
        return refuse(checker, "value %zu has an unknown role", index);
    if (value->length < 0 || value->length > TN_LENGTH_MAX)
        return refuse(checker, "value %zu has a length out of range", index);
    return TN_OK;
}

static tn_status check_field(tn_checker *checker, size_t index, size_t *value_end)
{
    const tn_module *module = checker->module;
    const tn_field_record *field = &module->FIELD_records[index];
    if (!is_name(module, field->name))
        return refuse(checker, "field %zu has no name of 1 to %u bytes", index, TN_NAME_MAX);
    if (field->kind >= TN_FIELD_KIND_COUNT || field->role >= TN_FIELD_ROLE_COUNT)
        return refuse(checker, "field %zu has an unknown kind or role", index);
    if (field->value_count == 0 || field->value_count > TN_VALUES_MAX)
        return refuse(checker, "field %zu has %u values; 1 to %u are possible", index, field->value_count,
                      TN_VALUES_MAX);
    if (field->kind == TN_FIELD_FLAG && field->value_count != 2)
        return refuse(checker, "field %zu is a flag with %u values instead of 2", index, field->value_count);
    if (!follows(field->value_first, field->value_count, module->VALUE_count, value_end))
        return refuse(checker, "the values of field %zu do not follow those of the field before", index);
    for (uint32_t i = 0; i < field->value_count; i++) {
        tn_status status = check_value(checker, field->value_first + i);
        if (status != TN_OK)
            return status;
        checker->sorted[i] = tn_text(module, module->VALUE_records[field->value_first + i].spelling);
    }
    if (!all_different(checker, field->value_count))
        return refuse(checker, "two values of field %zu are spelled alike", index);
    return TN_OK;
}

static tn_status check_schema(tn_checker *checker, size_t index, size_t *field_end, size_t *value_end)
{
    const tn_module *module = checker->module;
    const tn_schema_record *schema = &module->SCHEMA_records[index];
    if (!is_name(module, schema->name))
        return refuse(checker, "schema %zu has no name of 1 to %u bytes", index, TN_NAME_MAX);
    if (schema->field_count == 0 || schema->field_count > TN_FIELDS_MAX)
        return refuse(checker, "schema %zu has %u fields; 1 to %u are possible", index, schema->field_count,
                      TN_FIELDS_MAX);
    if (!follows(schema->field_first, schema->field_count, module->FIELD_count, field_end))
        return refuse(checker, "the fields of schema %zu do not follow those of the schema before", index);
    for (uint32_t i = 0; i < schema->field_count; i++) {
        tn_status status = check_field(checker, schema->field_first + i, value_end);
        if (status != TN_OK)
            return status;
    }
    for (uint32_t i = 0; i < schema->field_count; i++)
        checker->sorted[i] = tn_text(module, module->FIELD_records[schema->field_first + i].name);
    if (!all_different(checker, schema->field_count))
        return refuse(checker, "two fields of schema %zu have the same name", index);
    if (schema->forbid_first > module->SPEC_count || schema->forbid_count > module->SPEC_count - schema->forbid_first)
        return refuse(checker, "schema %zu forbids trays that are not there", index);
    for (uint32_t i = 0; i < schema->forbid_count; i++)
        if (module->SPEC_records[schema->forbid_first + i].schema != index)
            return refuse(checker, "schema %zu forbids a tray of another schema", index);
    return TN_OK;
}

static tn_status check_schemas(tn_checker *checker)
{
    const tn_module *module = checker->module;
    size_t field_end = 0, value_end = 0;
    for (size_t i = 0; i < module->SCHEMA_count; i++) {
        tn_status status = check_schema(checker, i, &field_end, &value_end);
        if (status != TN_OK)
            return status;
    }
    if (field_end != module->FIELD_count || value_end != module->VALUE_count)
        return refuse(checker, "it has fields or values that belong to no schema");
    for (size_t i = 0; i < module->SCHEMA_count; i++)
        checker->sorted[i] = tn_text(module, module->SCHEMA_records[i].name);
    if (!all_different(checker, module->SCHEMA_count))
        return refuse(checker, "two schemas have the same name");
    return TN_OK;
}

/* ---- specifiers */

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
        if (spec->schema >= module->SCHEMA_count)
            return refuse(checker, "specifier %zu is of schema %u, which is not there", i, spec->schema);
        uint32_t values = schema_values(module, spec->schema), words = (values + 63) / 64;
        if (spec->mask_first > module->MASK_count || words > module->MASK_count - spec->mask_first)
            return refuse(checker, "specifier %zu has bits that are not there", i);
        uint64_t last = (uint64_t)module->MASK_records[spec->mask_first + words - 1].bits;
        if (values % 64 != 0 && last >> (values % 64) != 0)
            return refuse(checker, "specifier %zu has a bit beyond the schema's last value", i);
    }
    return TN_OK;
}

/* ---- what rules and libraries name (the functions' own schemas and kinds are checked with the code) */

static bool is_function(const tn_module *module, uint32_t function, tn_function_kind kind, uint32_t schema)
{
    return function < module->FUNCTION_count && module->FUNCTION_records[function].kind == kind &&
           module->FUNCTION_records[function].schema == schema && schema < module->SCHEMA_count;
}

static tn_status check_functions(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    for (size_t i = 0; i < module->FUNCTION_count; i++)
        if (module->FUNCTION_records[i].name != 0 && !is_name(module, module->FUNCTION_records[i].name))
            return refuse(checker, "function %zu has a name of more than %u bytes", i, TN_NAME_MAX);
    return TN_OK;
}

static tn_status check_rules(tn_checker *checker)
{
    const tn_module *module = checker->module;
    for (size_t i = 0; i < module->RULE_count; i++) {
        const tn_rule_record *rule = &module->RULE_records[i];
        if (!is_name(module, rule->name))
            return refuse(checker, "rule %zu has no name of 1 to %u bytes", i, TN_NAME_MAX);
        if (!is_function(module, rule->whole, TN_FUNCTION_WHOLE, rule->schema) ||
            !is_function(module, rule->holds, TN_FUNCTION_HOLDS, rule->schema))
            return refuse(checker, "rule %zu names a function of another kind or schema", i);
        if ((rule->flags & ~TN_IMPORTED) != 0)
            return refuse(checker, "rule %zu has unknown flags", i);
        checker->sorted[i] = tn_text(module, rule->name);
    }
    return all_different(checker, module->RULE_count) ? TN_OK : refuse(checker, "two rules have the same name");
}

static tn_status check_clauses(const tn_checker *checker, const tn_library_record *library)
{
    const tn_module *module = checker->module;
    for (uint32_t i = 0; i < library->clause_count; i++) {
        uint32_t index = library->clause_first + i;
        const tn_clause_record *clause = &module->CLAUSE_records[index];
        if (!is_spelling(module, clause->name))
            return refuse(checker, "clause %u has no name of 1 to %u bytes", index, TN_SPELLING_MAX);
        if (clause->kind >= TN_CLAUSE_KIND_COUNT)
            return refuse(checker, "clause %u is of an unknown kind", index);
        if (!is_function(module, clause->holds, TN_FUNCTION_HOLDS, library->schema))
            return refuse(checker, "clause %u names a function of another kind or schema", index);
    }
    return TN_OK;
}

static tn_status check_libraries(tn_checker *checker)
{
    const tn_module *module = checker->module;
    size_t clause_end = 0;
    for (size_t i = 0; i < module->LIBRARY_count; i++) {
        const tn_library_record *library = &module->LIBRARY_records[i];
        if (!is_name(module, library->name))
            return refuse(checker, "library %zu has no name of 1 to %u bytes", i, TN_NAME_MAX);
        if (library->schema >= module->SCHEMA_count)
            return refuse(checker, "library %zu is of schema %u, which is not there", i, library->schema);
        if (library->trays_min > library->trays_max)
            return refuse(checker, "library %zu has fewer trays at most than at least", i);
        if ((library->flags & ~TN_IMPORTED) != 0)
            return refuse(checker, "library %zu has unknown flags", i);
        if (!follows(library->clause_first, library->clause_count, module->CLAUSE_count, &clause_end))
            return refuse(checker, "the clauses of library %zu do not follow those of the library before", i);
        tn_status status = check_clauses(checker, library);
        if (status != TN_OK)
            return status;
        checker->sorted[i] = tn_text(module, library->name);
    }
    if (clause_end != module->CLAUSE_count)
        return refuse(checker, "it has clauses that belong to no library");
    return all_different(checker, module->LIBRARY_count) ? TN_OK : refuse(checker, "two libraries have the same name");
}

/* ---- all of them */

static tn_status check_all(tn_checker *checker, const tn_module_limits *limits)
{
    tn_status status = check_strings(checker);
    if (status == TN_OK)
        status = check_sources(checker, limits);
    if (status == TN_OK)
        status = check_places(checker);
    if (status == TN_OK)
        status = check_schemas(checker);
    if (status == TN_OK)
        status = check_specs(checker);
    if (status == TN_OK)
        status = check_functions(checker);
    if (status == TN_OK)
        status = check_rules(checker);
    if (status == TN_OK)
        status = check_libraries(checker);
    if (status == TN_OK && checker->module->PRODUCER_count > 1)
        status = refuse(checker, "it has more than one producer");
    return status;
}

static size_t largest(size_t a, size_t b)
{
    return a > b ? a : b;
}

tn_status tn_verify_tables(const tn_module *module, const tn_module_limits *limits, tn_error *error)
{
    size_t names = largest(largest(module->SCHEMA_count, module->RULE_count), module->LIBRARY_count);
    names = largest(names, largest(TN_VALUES_MAX, TN_FIELDS_MAX));
    tn_checker checker = {.module = module, .error = error};
    checker.sizes = calloc(module->SOURCE_count + 1, sizeof *checker.sizes);
    checker.sorted = calloc(names, sizeof *checker.sorted);
    tn_status status = checker.sizes && checker.sorted ? check_all(&checker, limits) : tn_fail_memory(error);
    free(checker.sizes);
    free(checker.sorted);
    return status;
}
