/* Verifies and lists the rules and libraries of a module, and the code of rules and conditions. */
#include <stdlib.h>

#include "runtime/module/code.h"
#include "runtime/module/engine.h"
#include "runtime/module/lister.h"
#include "runtime/module/verify.h"
#include "runtime/plan/match/condition.h"
#include "runtime/plan/schema/list.h"
#include "runtime/plan/schema/projection.h"
#include "runtime/plan/schema/sum.h"

/* ---- verifying tables */

static bool is_function(const tn_module *module, uint32_t function, tn_function_kind kind, uint32_t schema)
{
    const tn_function_record *record = &module->FUNCTION_records[function];
    bool fits = kind == TN_FUNCTION_WHOLE ? tn_function_is_whole(record) : record->kind == kind;
    return fits && record->schema == schema;
}

static tn_status check_rules(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    for (size_t i = 0; i < module->RULE_count; i++) {
        const tn_rule_record *rule = &module->RULE_records[i];
        if (!is_function(module, rule->whole, TN_FUNCTION_WHOLE, rule->schema) ||
            !is_function(module, rule->holds, TN_FUNCTION_HOLDS, rule->schema))
            return tn_refuse(checker, "rule %zu names a function of another kind or schema", i);
    }
    return tn_check_different(checker, &module->RULE_records->name, sizeof *module->RULE_records, module->RULE_count,
                              "two rules have the same name");
}

static tn_status check_libraries(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    for (size_t i = 0; i < module->LIBRARY_count; i++) {
        const tn_library_record *library = &module->LIBRARY_records[i];
        if (library->trays_min > library->trays_max)
            return tn_refuse(checker, "library %zu has fewer trays at most than at least", i);
        for (uint32_t k = 0; k < library->clause_count; k++) {
            uint32_t clause = library->clause_first + k;
            if (!is_function(module, module->CLAUSE_records[clause].holds, TN_FUNCTION_HOLDS, library->schema))
                return tn_refuse(checker, "clause %u names a function of another kind or schema", clause);
        }
    }
    return tn_check_different(checker, &module->LIBRARY_records->name, sizeof *module->LIBRARY_records,
                              module->LIBRARY_count, "two libraries have the same name");
}

/* Rules, libraries and clauses name functions of the right kind and schema; no two rules or libraries have one name. */
static tn_status verify(const tn_checker *checker)
{
    tn_status status = check_rules(checker);
    return status == TN_OK ? check_libraries(checker) : status;
}

/* ---- verifying code */

static const tn_function_record *function_of(const tn_checker *checker)
{
    return &checker->module->FUNCTION_records[checker->record];
}

static tn_status verify_function(const tn_checker *checker, uint32_t index)
{
    const tn_function_record *function = &checker->module->FUNCTION_records[index];
    if (function->kind != TN_FUNCTION_CONDITION && function->schema >= checker->module->SCHEMA_count)
        return tn_refuse(checker, "there is no schema %u", function->schema);
    return TN_OK;
}

static tn_status check_spec(const tn_checker *checker, const tn_instruction *instruction)
{
    if (checker->module->SPEC_records[instruction->first].schema != function_of(checker)->schema)
        return tn_refuse(checker, "specifier %u is of another schema", (unsigned)instruction->first);
    return TN_OK;
}

static tn_status check_call(const tn_checker *checker, const tn_instruction *instruction)
{
    uint32_t callee = (uint32_t)instruction->first;
    if (callee >= checker->record)
        return tn_refuse(checker, "calls function %u, which is not a lower one", callee);
    const tn_function_record *function = &checker->module->FUNCTION_records[callee];
    if (tn_function_kinds[function->kind].code != TN_CODE_RULE)
        return tn_refuse(checker, "calls function %u, which is not part of a rule", callee);
    if (function->schema != function_of(checker)->schema)
        return tn_refuse(checker, "calls function %u, which is of another schema", callee);
    tn_instruction image;
    if (tn_function_is_image(checker->module, callee, &image))
        return tn_refuse(checker, "calls function %u, which asks for plans of another library", callee);
    return TN_OK;
}

/* A circle is closed: no other function calls into it in this way. */
static tn_status check_circle(const tn_checker *checker, const tn_instruction *instruction)
{
    uint32_t callee = (uint32_t)instruction->first;
    const tn_function_record *function = &checker->module->FUNCTION_records[callee];
    if (function_of(checker)->kind != TN_FUNCTION_CIRCLE || function->kind != TN_FUNCTION_CIRCLE)
        return tn_refuse(checker, "takes function %u again, and is not in a circle with it", callee);
    if (function->schema != function_of(checker)->schema)
        return tn_refuse(checker, "takes function %u again, which is of another schema", callee);
    return TN_OK;
}

static tn_status check_condition_kind(const tn_checker *checker, int64_t condition)
{
    if (checker->module->FUNCTION_records[condition].kind != TN_FUNCTION_CONDITION)
        return tn_refuse(checker, "function %u is no condition", (unsigned)condition);
    return TN_OK;
}

static tn_status check_condition(const tn_checker *checker, const tn_instruction *instruction)
{
    return check_condition_kind(checker, instruction->first);
}

static tn_status check_sum(const tn_checker *checker, const tn_instruction *instruction)
{
    uint32_t field = (uint32_t)instruction->first;
    const tn_schema_record *schema = &checker->module->SCHEMA_records[function_of(checker)->schema];
    if (field < schema->field_first || field - schema->field_first >= schema->field_count)
        return tn_refuse(checker, "field %u is not of the function's schema", field);
    uint32_t kind = checker->module->FIELD_records[field].kind;
    if (kind != TN_FIELD_LENGTH && kind != TN_FIELD_ZONE)
        return tn_refuse(checker, "field %u has no lengths", field);
    return check_condition_kind(checker, instruction->second);
}

static tn_status check_field(const tn_checker *checker, const tn_instruction *instruction)
{
    uint32_t field = (uint32_t)instruction->first;
    const tn_schema_record *schema = &checker->module->SCHEMA_records[function_of(checker)->schema];
    if (field < schema->field_first || field - schema->field_first >= schema->field_count)
        return tn_refuse(checker, "field %u is not of the function's schema", field);
    return TN_OK;
}

static tn_status check_numbers(const tn_checker *checker, const tn_instruction *instruction)
{
    if (instruction->opcode == TN_OP_REMAINDER && (instruction->first <= 0 || instruction->second < 0))
        return tn_refuse(checker, "a remainder needs a divisor above 0 and a rest not below 0");
    bool times = instruction->opcode == TN_OP_REPEATED;
    if (times &&
        (instruction->first < 1 || instruction->first > TN_REPEATED_MAX || instruction->second > TN_REPEATED_MAX ||
         (instruction->second != 0 && instruction->second < instruction->first)))
        return tn_refuse(checker, "a stretch is cut into 1 to %u others", TN_REPEATED_MAX);
    return TN_OK;
}

/* ---- verifying IMAGE: libraries lie above one another, and none above itself */

/* Is the schema that one, or made from it, perhaps by way of others? Schemas are made from earlier ones. */
static bool is_made_from(const tn_module *module, uint32_t schema, uint32_t older)
{
    while (schema != older && schema != TN_NO_RECORD)
        schema = module->SCHEMA_records[schema].from;
    return schema == older;
}

/* It is the whole of a function of kind HOLDS, and its schemas belong together. */
static tn_status check_image(const tn_checker *checker, const tn_instruction *instruction)
{
    const tn_module *module = checker->module;
    const tn_function_record *function = &module->FUNCTION_records[checker->record];
    const tn_library_record *library = &module->LIBRARY_records[instruction->first];
    uint32_t base = (uint32_t)instruction->second;
    if (function->kind != TN_FUNCTION_HOLDS || function->code_end - function->code_begin != instruction->length + 1)
        return tn_refuse(checker, "asks for plans of library %u beside other things", (unsigned)instruction->first);
    if (!is_made_from(module, function->schema, base) || !is_made_from(module, library->schema, base))
        return tn_refuse(checker, "schema %u is none that those of library %u and of the function are made from",
                         (unsigned)base, (unsigned)instruction->first);
    return TN_OK;
}

/* What is known of each library and function while functions are gone through from the lowest up. */
typedef struct heights {
    uint32_t *highest; /* [libraries]: one past the highest function of their clauses */
    uint8_t *library;  /* [libraries]: how many libraries lie above one another from it on, itself one; 0: not known */
    uint8_t *function; /* [functions]: likewise; 0: no IMAGE */
} heights;

static uint8_t height_of(const tn_module *module, const heights *h, uint32_t index)
{
    const tn_library_record *library = &module->LIBRARY_records[index];
    uint8_t most = 0;
    for (uint32_t i = 0; i < library->clause_count && h->library[index] == 0; i++) {
        uint8_t height = h->function[module->CLAUSE_records[library->clause_first + i].holds];
        most = height > most ? height : most;
    }
    if (h->library[index] == 0)
        h->library[index] = most + 1;
    return h->library[index];
}

static tn_status check_heights(const tn_checker *checker, const heights *h)
{
    const tn_module *module = checker->module;
    for (uint32_t l = 0; l < module->LIBRARY_count; l++) {
        const tn_library_record *library = &module->LIBRARY_records[l];
        for (uint32_t i = 0; i < library->clause_count; i++) {
            uint32_t holds = module->CLAUSE_records[library->clause_first + i].holds;
            h->highest[l] = holds >= h->highest[l] ? holds + 1 : h->highest[l];
        }
    }
    for (uint32_t f = 0; f < module->FUNCTION_count; f++) {
        tn_instruction image;
        if (module->FUNCTION_records[f].kind != TN_FUNCTION_HOLDS || !tn_function_is_image(module, f, &image))
            continue;
        uint32_t library = (uint32_t)image.first;
        if (h->highest[library] > f)
            return tn_refuse(checker, "function %u asks library %u, which has functions that are not lower", f,
                             library);
        h->function[f] = height_of(module, h, library);
        if (h->function[f] > TN_PROJECTIONS_MAX)
            return tn_refuse(checker, "more than %u libraries lie above one another", TN_PROJECTIONS_MAX);
    }
    return TN_OK;
}

static bool is_image(const tn_module *module, uint32_t function)
{
    tn_instruction image;
    return function != TN_NO_RECORD && module->FUNCTION_records[function].kind == TN_FUNCTION_HOLDS &&
           tn_function_is_image(module, function, &image);
}

/* Sums count in no such function, and houses are asked none. Rules do not call one, which is checked where they call.
 */
static tn_status check_uses(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    for (size_t i = 0; i < module->TERM_count; i++)
        if (is_image(module, module->TERM_records[i].part))
            return tn_refuse(checker, "term %zu asks for plans of another library", i);
    for (size_t i = 0; i < module->HOUSE_CLAUSE_count; i++)
        if (is_image(module, module->HOUSE_CLAUSE_records[i].holds))
            return tn_refuse(checker, "house clause %zu asks for plans of another library", i);
    for (size_t i = 0; i < module->HOUSE_RULE_count; i++)
        if (is_image(module, module->HOUSE_RULE_records[i].holds))
            return tn_refuse(checker, "house rule %zu asks for plans of another library", i);
    return TN_OK;
}

/* All of them, once all code has been found right: at most TN_PROJECTIONS_MAX libraries lie above one another, each of
 * whose functions are lower ones; and nothing but clauses names the functions. */
static tn_status verify_images(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    heights h = {.highest = calloc(module->LIBRARY_count + 1, sizeof *h.highest),
                 .library = calloc(module->LIBRARY_count + 1, 1),
                 .function = calloc(module->FUNCTION_count + 1, 1)};
    bool ok = h.highest && h.library && h.function;
    tn_status status = ok ? check_heights(checker, &h) : tn_fail_memory(checker->error);
    if (status == TN_OK)
        status = check_uses(checker);
    free(h.highest);
    free(h.library);
    free(h.function);
    return status;
}

/* ---- listing */

static void list_rule(tn_lister *lister, size_t index)
{
    const tn_rule_record *rule = &lister->module->RULE_records[index];
    fprintf(lister->out, "  %zu  ", index);
    tn_list_name(lister, rule->name);
    tn_list_doc(lister, rule->doc);
    fprintf(lister->out, ": whole function %u, holds function %u%s", rule->whole, rule->holds,
            rule->flags & TN_IMPORTED ? ", imported" : "");
    tn_list_place(lister, rule->file, rule->begin);
}

static void list_rules(tn_lister *lister)
{
    if (lister->module->RULE_count > 0)
        fputs("\nrules\n", lister->out);
    for (size_t i = 0; i < lister->module->RULE_count; i++)
        list_rule(lister, i);
}

static void list_library(tn_lister *lister, size_t index)
{
    const tn_library_record *library = &lister->module->LIBRARY_records[index];
    fprintf(lister->out, "\nlibrary %zu  ", index);
    tn_list_name(lister, library->name);
    tn_list_doc(lister, library->doc);
    fputs(" using ", lister->out);
    tn_list_name(lister, lister->module->SCHEMA_records[library->schema].name);
    fprintf(lister->out, ": %u..%u trays%s", library->trays_min, library->trays_max,
            library->flags & TN_IMPORTED ? ", imported" : "");
    tn_list_place(lister, library->file, library->begin);
    for (uint32_t i = 0; i < library->clause_count; i++) {
        const tn_clause_record *clause = &lister->module->CLAUSE_records[library->clause_first + i];
        fprintf(lister->out, "  %s ", tn_names_CLAUSE_KIND[clause->kind]);
        tn_list_name(lister, clause->name);
        tn_list_doc(lister, clause->doc);
        fprintf(lister->out, ": function %u", clause->holds);
        tn_list_place(lister, clause->file, clause->begin);
    }
    for (uint32_t i = 0; i < library->preference_count; i++) {
        const tn_preference_record *preference = &lister->module->PREFERENCE_records[library->preference_first + i];
        fputs("  prefer ", lister->out);
        tn_list_name(lister, preference->name);
        tn_list_doc(lister, preference->doc);
        tn_list_place(lister, preference->file, preference->begin);
    }
    if (library->preference_count > 0) {
        fputs("  preference: ", lister->out);
        tn_list_sum(lister, tn_preferred_sum(lister->module, library));
        fputc('\n', lister->out);
    }
    for (uint32_t i = 0; i < library->weight_count; i++) {
        const tn_weight_record *weight = &lister->module->WEIGHT_records[library->weight_first + i];
        fputs("  weight ", lister->out);
        tn_list_name(lister, weight->name);
        fprintf(lister->out, " %s: ", tn_text(lister->module, weight->factor));
        tn_list_sum(lister, weight->sum);
        tn_list_place(lister, weight->file, weight->begin);
    }
}

static void list(tn_lister *lister)
{
    list_rules(lister);
    for (size_t i = 0; i < lister->module->LIBRARY_count; i++)
        list_library(lister, i);
}

static bool list_record(tn_lister *lister, tn_section section, uint32_t index)
{
    if (section == TN_SECTION_RULE)
        list_rule(lister, index);
    return section == TN_SECTION_RULE;
}

static void list_spec(tn_lister *lister, const tn_instruction *instruction)
{
    fprintf(lister->out, "spec %u  ", (unsigned)instruction->first);
    tn_list_spec(lister, (uint32_t)instruction->first);
}

static void list_field(tn_lister *lister, const tn_instruction *instruction)
{
    fprintf(lister->out, "field %u  ", (unsigned)instruction->first);
    tn_list_name(lister, lister->module->FIELD_records[instruction->first].name);
}

static void list_image(tn_lister *lister, const tn_instruction *instruction)
{
    fputs("library ", lister->out);
    tn_list_name(lister, lister->module->LIBRARY_records[instruction->first].name);
    fputs(" onto ", lister->out);
    tn_list_name(lister, lister->module->SCHEMA_records[instruction->second].name);
}

static void list_function(tn_lister *lister, uint32_t function)
{
    if (lister->module->FUNCTION_records[function].kind != TN_FUNCTION_CONDITION)
        return;
    char text[TN_CONDITION_TEXT_MAX];
    tn_condition_text(lister->module, function, text);
    fprintf(lister->out, " %s", text);
}

static void list_heading(tn_lister *lister, uint32_t function)
{
    const tn_function_record *record = &lister->module->FUNCTION_records[function];
    if (record->kind == TN_FUNCTION_CONDITION)
        return;
    fputs(" of ", lister->out);
    tn_list_name(lister, lister->module->SCHEMA_records[record->schema].name);
}

static const tn_section sections[] = {TN_SECTION_RULE, TN_SECTION_LIBRARY, TN_SECTION_CLAUSE, TN_SECTION_STRINGS};

static const tn_operand_rules operands[] = {
    {TN_OPERANDS_SPEC, check_spec, list_spec}, {TN_OPERANDS_FUNC, check_call, NULL},
    {TN_OPERANDS_COND, check_condition, NULL}, {TN_OPERANDS_FIELD_COND, check_sum, NULL},
    {TN_OPERANDS_INT2, check_numbers, NULL},   {TN_OPERANDS_FIELD, check_field, list_field},
    {TN_OPERANDS_CIRCLE, check_circle, NULL},  {TN_OPERANDS_LIBRARY, check_image, list_image},
};

extern const tn_engine tn_engine_match;
const tn_engine tn_engine_match = {.name = "match",
                                   .sections = sections,
                                   .codes = 1u << TN_CODE_RULE | 1u << TN_CODE_CONDITION,
                                   .operands = operands,
                                   .operand_count = sizeof operands / sizeof *operands,
                                   .verify = verify,
                                   .verify_function = verify_function,
                                   .verify_after = verify_images,
                                   .list = list,
                                   .list_record = list_record,
                                   .list_function = list_function,
                                   .list_heading = list_heading};
