/* Verifies and lists sums, their terms, measures, weights and preferences, and the code that says what a tray counts.
 */
#include <stdlib.h>
#include <string.h>

#include "runtime/module/code.h"
#include "runtime/module/engine.h"
#include "runtime/module/lister.h"
#include "runtime/module/verify.h"
#include "runtime/number/rational.h"
#include "runtime/plan/schema/list.h"
#include "runtime/plan/schema/sum.h"

static bool is_rational(const tn_module *module, tn_string text)
{
    mpq_t number;
    mpq_init(number);
    bool good = tn_rational_read(tn_text(module, text), number);
    mpq_clear(number);
    return good;
}

static bool is_of(const tn_module *module, uint32_t function, tn_function_kind kind, uint32_t schema)
{
    const tn_function_record *record = &module->FUNCTION_records[function];
    bool fits = kind == TN_FUNCTION_WHOLE ? tn_function_is_whole(record) : record->kind == kind;
    return fits && record->schema == schema;
}

/* Is the function one specifier, of which a tray decides alone? */
static bool is_specifier(const tn_module *module, uint32_t function)
{
    uint32_t offset = module->FUNCTION_records[function].code_begin;
    tn_instruction tray = tn_code_read(module->code, offset);
    return tray.opcode == TN_OP_TRAY && tn_code_read(module->code, offset + tray.length).opcode == TN_OP_RETURN;
}

static tn_status check_term(const tn_checker *checker, uint32_t schema, uint32_t index)
{
    const tn_module *module = checker->module;
    const tn_term_record *term = &module->TERM_records[index];
    if (!is_rational(module, term->factor) || strcmp(tn_text(module, term->factor), "0") == 0)
        return tn_refuse(checker, "term %u has no factor, or 0", index);
    bool gap = tn_term_is_gap(term->kind);
    tn_function_kind wanted =
        term->kind == TN_SUM_MATCHES || term->kind == TN_SUM_NEEDED ? TN_FUNCTION_HOLDS : TN_FUNCTION_WHOLE;
    if (!is_of(module, term->part, wanted, schema))
        return tn_refuse(checker, "term %u names a function of another kind or schema", index);
    if (gap != (term->other != TN_NO_RECORD) || (gap && !is_of(module, term->other, TN_FUNCTION_WHOLE, schema)))
        return tn_refuse(checker, "term %u leads to a function of another kind or schema", index);
    if (term->kind == TN_SUM_PRESENT && !is_specifier(module, term->part))
        return tn_refuse(checker, "term %u asks for more than a tray of its own", index);
    if (term->tally != TN_NO_RECORD && ((tn_term_counts(term->kind) != TN_SUM_SINGLES && !gap) ||
                                        !is_of(module, term->tally, TN_FUNCTION_TALLY, schema)))
        return tn_refuse(checker, "term %u has a tally of another kind or schema", index);
    return TN_OK;
}

static tn_status check_sums(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    for (size_t i = 0; i < module->SUM_count; i++) {
        const tn_sum_record *sum = &module->SUM_records[i];
        if (!is_rational(module, sum->constant))
            return tn_refuse(checker, "sum %zu has no constant", i);
        for (uint32_t t = 0; t < sum->term_count; t++) {
            tn_status status = check_term(checker, sum->schema, sum->term_first + t);
            if (status != TN_OK)
                return status;
        }
    }
    return TN_OK;
}

/* Puts the names of the measures into the order of their schemas. ends[s]: where those of schema s end. */
static void order_names(const tn_module *module, tn_string *names, size_t *ends)
{
    for (size_t i = 0; i < module->MEASURE_count; i++)
        ends[module->MEASURE_records[i].schema + 1]++;
    for (size_t s = 0; s < module->SCHEMA_count; s++)
        ends[s + 1] += ends[s];
    for (size_t i = 0; i < module->MEASURE_count; i++)
        names[ends[module->MEASURE_records[i].schema]++] = module->MEASURE_records[i].name;
}

/* Measures of one schema differ in their names. */
static tn_status check_measure_names(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    if (module->MEASURE_count == 0)
        return TN_OK;
    tn_string *names = calloc(module->MEASURE_count, sizeof *names);
    size_t *ends = calloc(module->SCHEMA_count + 1, sizeof *ends);
    tn_status status = names && ends ? TN_OK : tn_fail_memory(checker->error);
    if (status == TN_OK)
        order_names(module, names, ends);
    for (size_t s = 0, begin = 0; status == TN_OK && s < module->SCHEMA_count; begin = ends[s++])
        status = tn_check_different(checker, names + begin, sizeof *names, ends[s] - begin,
                                    "two measures of a schema have the same name");
    free(ends);
    free(names);
    return status;
}

/* A sum of plans of the schema, which nothing lies before or behind. what, i: whose it is. */
static tn_status check_sum_of_plans(const tn_checker *checker, const char *what, size_t i, uint32_t schema,
                                    uint32_t index)
{
    const tn_module *module = checker->module;
    const tn_sum_record *sum = &module->SUM_records[index];
    if (sum->schema != schema)
        return tn_refuse(checker, "%s %zu names a sum of another schema", what, i);
    for (uint32_t t = 0; t < sum->term_count; t++)
        if (tn_term_region(module->TERM_records[sum->term_first + t].kind) != TN_REGION_STRETCH)
            return tn_refuse(checker, "%s %zu counts what lies around a stretch", what, i);
    return TN_OK;
}

static tn_status check_measure(const tn_checker *checker, size_t i)
{
    const tn_measure_record *measure = &checker->module->MEASURE_records[i];
    tn_status status = check_sum_of_plans(checker, "measure", i, measure->schema, measure->sum);
    return status == TN_OK && measure->over != TN_NO_RECORD
               ? check_sum_of_plans(checker, "measure", i, measure->schema, measure->over)
               : status;
}

/* The schema that a field is of: their fields follow one another. */
static const tn_schema_record *schema_of_field(const tn_module *module, uint32_t field)
{
    size_t low = 0, high = module->SCHEMA_count;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (module->SCHEMA_records[middle].field_first <= field)
            low = middle;
        else
            high = middle;
    }
    return &module->SCHEMA_records[low];
}

/* What a field is of a plan is a sum over plans of the library that its schema is of. */
static tn_status check_said(const tn_checker *checker, size_t i)
{
    const tn_module *module = checker->module;
    const tn_said_record *said = &module->SAID_records[i];
    uint32_t of = schema_of_field(module, said->field)->of;
    if (of == TN_NO_RECORD)
        return tn_refuse(checker, "field %u says something of plans, and its schema is of no library", said->field);
    uint32_t schema = module->LIBRARY_records[of].schema;
    tn_status status = check_sum_of_plans(checker, "said field", i, schema, said->sum);
    return status == TN_OK && said->over != TN_NO_RECORD
               ? check_sum_of_plans(checker, "said field", i, schema, said->over)
               : status;
}

/* A weight counts single trays of plans of the library's schema; its factor is above 0. */
static tn_status check_weight(const tn_checker *checker, uint32_t index, uint32_t schema)
{
    const tn_module *module = checker->module;
    const tn_weight_record *weight = &module->WEIGHT_records[index];
    const tn_sum_record *sum = &module->SUM_records[weight->sum];
    const tn_term_record *term = sum->term_count == 1 ? &module->TERM_records[sum->term_first] : NULL;
    bool counts = term && term->kind == TN_SUM_SINGLES && term->tally == TN_NO_RECORD &&
                  strcmp(tn_text(module, term->factor), "1") == 0 && strcmp(tn_text(module, sum->constant), "0") == 0;
    mpq_t factor;
    mpq_init(factor);
    bool above = tn_rational_read(tn_text(module, weight->factor), factor) && mpq_sgn(factor) > 0;
    mpq_clear(factor);
    if (sum->schema != schema || !counts)
        return tn_refuse(checker, "weight %u has a sum of another kind or schema", index);
    return above ? TN_OK : tn_refuse(checker, "weight %u is not above 0", index);
}

/* The preferences of a library have one sum, with a term above 0 for each. */
static tn_status check_preferred(const tn_checker *checker, size_t index)
{
    const tn_module *module = checker->module;
    const tn_library_record *library = &module->LIBRARY_records[index];
    if (library->preference_count == 0)
        return TN_OK;
    const tn_sum_record *sum = &module->SUM_records[tn_preferred_sum(module, library)];
    bool good = sum->schema == library->schema && sum->power == 0 && sum->term_count == library->preference_count;
    for (uint32_t i = 0; good && i < sum->term_count; i++) {
        const tn_term_record *term = &module->TERM_records[sum->term_first + i];
        good = term->kind == TN_SUM_MATCHES && tn_text(module, term->factor)[0] != '-' &&
               &module->SUM_records[module->PREFERENCE_records[library->preference_first + i].sum] == sum;
    }
    return good ? TN_OK : tn_refuse(checker, "the preferences of library %zu have another sum", index);
}

static tn_status check_leanings(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    tn_status status = TN_OK;
    for (size_t l = 0; l < module->LIBRARY_count; l++) {
        const tn_library_record *library = &module->LIBRARY_records[l];
        for (uint32_t i = 0; status == TN_OK && i < library->weight_count; i++)
            status = check_weight(checker, library->weight_first + i, library->schema);
        if (status == TN_OK)
            status = check_preferred(checker, l);
        if (status != TN_OK)
            return status;
    }
    return status;
}

static tn_status verify(const tn_checker *checker)
{
    tn_status status = check_sums(checker);
    if (status == TN_OK)
        status = check_leanings(checker);
    for (size_t i = 0; status == TN_OK && i < checker->module->MEASURE_count; i++)
        status = check_measure(checker, i);
    for (size_t i = 0; status == TN_OK && i < checker->module->SAID_count; i++)
        status = check_said(checker, i);
    return status == TN_OK ? check_measure_names(checker) : status;
}

static const tn_function_record *function_of(const tn_checker *checker)
{
    return &checker->module->FUNCTION_records[checker->record];
}

static tn_status verify_function(const tn_checker *checker, uint32_t index)
{
    const tn_function_record *function = &checker->module->FUNCTION_records[index];
    if (function->schema >= checker->module->SCHEMA_count)
        return tn_refuse(checker, "there is no schema %u", function->schema);
    if (function->stack_max > TN_TALLY_STACK_MAX)
        return tn_refuse(checker, "a tally's stack passes %u", TN_TALLY_STACK_MAX);
    return TN_OK;
}

/* What is compared speaks of a stretch, and of functions that are checked already. */
static tn_status check_summed(const tn_checker *checker, const tn_instruction *instruction)
{
    const tn_module *module = checker->module;
    const tn_sum_record *sum = &module->SUM_records[instruction->first];
    if (sum->schema != function_of(checker)->schema)
        return tn_refuse(checker, "sum %u is of another schema", (unsigned)instruction->first);
    for (uint32_t i = 0; i < sum->term_count; i++) {
        const tn_term_record *term = &module->TERM_records[sum->term_first + i];
        if (tn_term_of_whole(term->kind))
            return tn_refuse(checker, "sum %u is compared, and speaks of the whole plan", (unsigned)instruction->first);
        if (term->part >= checker->record)
            return tn_refuse(checker, "sum %u has function %u, which is not a lower one", (unsigned)instruction->first,
                             term->part);
    }
    return TN_OK;
}

static tn_status check_summed_by(const tn_checker *checker, const tn_instruction *instruction)
{
    return instruction->second > 0 ? check_summed(checker, instruction)
                                   : tn_refuse(checker, "a sum is divided by a number that is not above 0");
}

static tn_status check_rational(const tn_checker *checker, const tn_instruction *instruction)
{
    return is_rational(checker->module, (tn_string)instruction->first)
               ? TN_OK
               : tn_refuse(checker, "a number of a sum is not a fraction of whole numbers");
}

static tn_status check_extent(const tn_checker *checker, const tn_instruction *instruction)
{
    uint32_t field = (uint32_t)instruction->first;
    const tn_schema_record *schema = &checker->module->SCHEMA_records[function_of(checker)->schema];
    if (field < schema->field_first || field - schema->field_first >= schema->field_count)
        return tn_refuse(checker, "field %u is not of the function's schema", field);
    uint32_t kind = checker->module->FIELD_records[field].kind;
    if (kind != TN_FIELD_LENGTH && kind != TN_FIELD_ZONE)
        return tn_refuse(checker, "field %u has no lengths", field);
    return TN_OK;
}

/* ---- listing */

void tn_list_sum(tn_lister *lister, uint32_t index)
{
    const tn_module *module = lister->module;
    const tn_sum_record *sum = &module->SUM_records[index];
    fprintf(lister->out, "sum %u: %s", index, tn_text(module, sum->constant));
    for (uint32_t i = 0; i < sum->term_count; i++) {
        const tn_term_record *term = &module->TERM_records[sum->term_first + i];
        fprintf(lister->out, " + %s %s of function %u", tn_text(module, term->factor), tn_names_SUM_KIND[term->kind],
                term->part);
        if (term->other != TN_NO_RECORD)
            fprintf(lister->out, " to function %u", term->other);
        if (term->tally != TN_NO_RECORD)
            fprintf(lister->out, " by function %u", term->tally);
    }
}

static void list_summed(tn_lister *lister, const tn_instruction *instruction)
{
    tn_list_sum(lister, (uint32_t)instruction->first);
}

static void list_summed_by(tn_lister *lister, const tn_instruction *instruction)
{
    fprintf(lister->out, "by %lld  ", (long long)instruction->second);
    tn_list_sum(lister, (uint32_t)instruction->first);
}

static void list_rational(tn_lister *lister, const tn_instruction *instruction)
{
    fputs(tn_text(lister->module, (tn_string)instruction->first), lister->out);
}

static void list_extent(tn_lister *lister, const tn_instruction *instruction)
{
    fprintf(lister->out, "field %u  ", (unsigned)instruction->first);
    tn_list_name(lister, lister->module->FIELD_records[instruction->first].name);
}

static void list_said(tn_lister *lister)
{
    const tn_module *module = lister->module;
    if (module->SAID_count > 0)
        fputs("\nwhat fields say of plans\n", lister->out);
    for (size_t i = 0; i < module->SAID_count; i++) {
        const tn_said_record *said = &module->SAID_records[i];
        fprintf(lister->out, "  field %u  ", said->field);
        tn_list_name(lister, module->FIELD_records[said->field].name);
        fputs(": ", lister->out);
        tn_list_sum(lister, said->sum);
        if (said->over != TN_NO_RECORD) {
            fputs(" over ", lister->out);
            tn_list_sum(lister, said->over);
        }
        fputc('\n', lister->out);
    }
}

static void list(tn_lister *lister)
{
    const tn_module *module = lister->module;
    list_said(lister);
    if (module->MEASURE_count > 0)
        fputs("\nmeasures\n", lister->out);
    for (size_t i = 0; i < module->MEASURE_count; i++) {
        const tn_measure_record *measure = &module->MEASURE_records[i];
        fprintf(lister->out, "  %zu  ", i);
        tn_list_name(lister, measure->name);
        tn_list_doc(lister, measure->doc);
        fputs(": ", lister->out);
        tn_list_sum(lister, measure->sum);
        if (measure->over != TN_NO_RECORD) {
            fputs(" over ", lister->out);
            tn_list_sum(lister, measure->over);
        }
        tn_list_place(lister, measure->file, measure->begin);
    }
}

static void list_heading(tn_lister *lister, uint32_t function)
{
    fputs(" of ", lister->out);
    tn_list_name(lister, lister->module->SCHEMA_records[lister->module->FUNCTION_records[function].schema].name);
}

static const tn_section sections[] = {TN_SECTION_SUM,        TN_SECTION_TERM, TN_SECTION_MEASURE, TN_SECTION_WEIGHT,
                                      TN_SECTION_PREFERENCE, TN_SECTION_SAID, TN_SECTION_STRINGS};

static const tn_operand_rules operands[] = {
    {TN_OPERANDS_SUMMED, check_summed, list_summed},
    {TN_OPERANDS_SUMMED_BY, check_summed_by, list_summed_by},
    {TN_OPERANDS_RATIONAL, check_rational, list_rational},
    {TN_OPERANDS_EXTENT, check_extent, list_extent},
};

extern const tn_engine tn_engine_sum;
const tn_engine tn_engine_sum = {.name = "sum",
                                 .sections = sections,
                                 .codes = 1u << TN_CODE_TALLY,
                                 .operands = operands,
                                 .operand_count = sizeof operands / sizeof *operands,
                                 .verify = verify,
                                 .verify_function = verify_function,
                                 .list = list,
                                 .list_heading = list_heading};
