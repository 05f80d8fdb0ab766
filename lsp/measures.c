/* Finds and writes what measures come to. */
#include "lsp/measures.h"

#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/number/rational.h"
#include "runtime/plan/measure/amount.h"
#include "runtime/plan/measure/moments.h"
#include "runtime/plan/measure/named.h"

enum { FACTS_MAX = 10000 };

static bool write_mean(tn_amount_unit unit, const tn_measure_moments *m, tn_buffer *text)
{
    mpq_t number;
    tn_buffer root = {0};
    mpq_init(number);
    mpq_set(number, m->mean);
    tn_amount_convert(unit, number);
    bool ok = tn_amount_write_about(unit, number, text) && tn_buffer_printf(text, " on average (standard deviation ") &&
              tn_amount_write_root(unit, m->variance, &root) && tn_decimal_read(root.data, strlen(root.data), number) &&
              tn_amount_write_about(unit, number, text) && tn_buffer_printf(text, ")");
    free(root.data);
    mpq_clear(number);
    return ok;
}

static bool write_moments(tn_amount_unit unit, const tn_measure_moments *m, tn_buffer *text)
{
    if (mpz_sgn(m->plans) == 0)
        return tn_buffer_printf(text, "no plan has a value");
    return tn_amount_write(unit, m->least, text) && tn_buffer_printf(text, " to ") &&
           tn_amount_write(unit, m->most, text) && tn_buffer_printf(text, ", ") && write_mean(unit, m, text);
}

static void add_fact(tn_measure_facts *facts, const char *library, const char *measure, char *text)
{
    tn_measure_fact fact = {strdup(library), strdup(measure), text};
    if (fact.library && fact.measure && text && facts->count < FACTS_MAX &&
        tn_array_reserve(&facts->items, &facts->capacity, facts->count, 1, sizeof *facts->items)) {
        facts->items[facts->count++] = fact;
        return;
    }
    free(fact.library);
    free(fact.measure);
    free(text);
}

static void measure_library(tn_measure_facts *facts, const tn_module *module, const tn_library *library, uint32_t index,
                            uint32_t measure)
{
    const tn_library_record *record = &module->LIBRARY_records[index];
    tn_amount_unit unit = tn_amount_unit_of(tn_library_schema(library), tn_named_measure_power(module, measure));
    tn_weighed *weighed = NULL;
    tn_measure_moments moments;
    tn_buffer text = {0};
    tn_error error;
    tn_measure_moments_init(&moments);
    if (tn_weighed_new(library, &measure, 1, &weighed, &error) == TN_OK &&
        tn_measure_moments_find(&moments, weighed, &error) == TN_OK && write_moments(unit, &moments, &text))
        add_fact(facts, tn_text(module, record->name), tn_named_measure(module, measure), text.data);
    else
        free(text.data);
    tn_measure_moments_clear(&moments);
    tn_weighed_free(weighed);
}

void tn_measure_facts_add(tn_measure_facts *facts, const tn_module *module, const tn_library *library, uint32_t index)
{
    for (uint32_t i = TN_NO_RECORD; tn_named_measure_next(module, &module->LIBRARY_records[index], &i);)
        measure_library(facts, module, library, index, i);
}

void tn_measure_facts_clear(tn_measure_facts *facts)
{
    for (size_t i = 0; i < facts->count; i++) {
        free(facts->items[i].library);
        free(facts->items[i].measure);
        free(facts->items[i].text);
    }
    free(facts->items);
    *facts = (tn_measure_facts){0};
}

void tn_measure_facts_write(const tn_measure_facts *facts, const tn_symbol *symbol, FILE *out)
{
    bool of_measure = symbol->kind == TN_SYMBOL_MEASURE;
    for (size_t i = 0; i < facts->count; i++) {
        const tn_measure_fact *fact = &facts->items[i];
        if (strcmp(of_measure ? fact->measure : fact->library, symbol->name) == 0)
            fprintf(out, "\n- %s`%s`: %s", of_measure ? "over " : "", of_measure ? fact->library : fact->measure,
                    fact->text);
    }
}
