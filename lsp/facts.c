/* Keeps what was found about rules and libraries, for hover and warnings. */
#include "lsp/facts.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/array.h"
#include "runtime/number/rational.h"
#include "runtime/plan/library/library.h"
#include "runtime/plan/match/parts.h"
#include "runtime/plan/measure/amount.h"
#include "runtime/plan/measure/moments.h"
#include "runtime/plan/measure/named.h"

enum {
    STATES_MAX = 50000, /* larger libraries are not counted */
    TABLE_MAX = 64 << 20,
    ITEMS_MAX = 100000,
    LENGTHS_MAX = 24, /* numbers of trays that are told apart */
    MEASURES_MAX = 10000,
    NAMES_SHOWN = 8, /* of the rules that one lies so to; the others are counted */
};

/* ---- measures */

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
    if (fact.library && fact.measure && text && facts->count < MEASURES_MAX &&
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

/* Adds every measure of the library's trays; one that passes a limit is left out. */
static void add_measures(tn_measure_facts *facts, const tn_module *module, const tn_library *library, uint32_t index)
{
    for (uint32_t i = TN_NO_RECORD; tn_named_measure_next(module, &module->LIBRARY_records[index], &i);)
        measure_library(facts, module, library, index, i);
}

static void clear_measures(tn_measure_facts *facts)
{
    for (size_t i = 0; i < facts->count; i++) {
        free(facts->items[i].library);
        free(facts->items[i].measure);
        free(facts->items[i].text);
    }
    free(facts->items);
    *facts = (tn_measure_facts){0};
}

/* Those of a measure over each library, or of a library by each measure, as items of a Markdown list. */
static void write_measures(const tn_measure_facts *facts, const tn_symbol *symbol, FILE *out)
{
    bool of_measure = symbol->kind == TN_SYMBOL_MEASURE;
    for (size_t i = 0; i < facts->count; i++) {
        const tn_measure_fact *fact = &facts->items[i];
        if (strcmp(of_measure ? fact->measure : fact->library, symbol->name) == 0)
            fprintf(out, "\n- %s`%s`: %s", of_measure ? "over " : "", of_measure ? fact->library : fact->measure,
                    fact->text);
    }
}

/* ---- counts */

/* rule: NULL where it is the library that is counted. */
static void add_count(tn_facts *facts, const char *library, const char *rule, bool requires, bool is_rule,
                      const mpz_t out, const mpz_t only)
{
    if (facts->count == ITEMS_MAX ||
        !tn_array_reserve(&facts->counts, &facts->capacity, facts->count, 1, sizeof *facts->counts))
        return;
    tn_rule_count *item = &facts->counts[facts->count++];
    *item = (tn_rule_count){
        strdup(library), rule ? strdup(rule) : NULL, mpz_get_str(NULL, 10, out), mpz_get_str(NULL, 10, only), requires,
        is_rule};
}

static bool is_rule(const tn_module *module, const tn_clause_record *clause)
{
    uint32_t rule = tn_function_rule(module, clause->holds);
    return rule != UINT32_MAX &&
           strcmp(tn_text(module, module->RULE_records[rule].name), tn_text(module, clause->name)) == 0;
}

static void count_library(tn_facts *facts, const tn_module *module, const tn_library *library, uint32_t index)
{
    const tn_library_record *record = &module->LIBRARY_records[index];
    const char *name = tn_text(module, record->name);
    tn_error error;
    mpz_t out, only;
    mpz_inits(out, only, NULL);
    if (tn_library_generated(library, TN_ALL_LENGTHS, out, &error) == TN_OK) {
        tn_library_kept(library, TN_ALL_LENGTHS, only);
        add_count(facts, name, NULL, false, false, out, only);
    }
    for (uint32_t i = 0; i < record->clause_count; i++) {
        const tn_clause_record *clause = &module->CLAUSE_records[record->clause_first + i];
        uint32_t states;
        if (tn_library_effect(library, i, out, only, &states, &error) == TN_OK)
            add_count(facts, name, tn_text(module, clause->name), clause->kind != TN_CLAUSE_PRUNE,
                      is_rule(module, clause), out, only);
    }
    mpz_clears(out, only, NULL);
}

/* "its distribution": how many of its plans have how many trays. */
static void share_lengths(tn_facts *facts, const tn_library *library, const char *name)
{
    uint32_t low = tn_library_min(library), high = tn_library_max(library);
    mpz_t all, some;
    mpq_t share;
    mpz_inits(all, some, NULL);
    mpq_init(share);
    tn_library_kept(library, TN_ALL_LENGTHS, all);
    for (uint32_t n = low; mpz_sgn(all) > 0 && n <= high && low < high && high - low < LENGTHS_MAX; n++) {
        tn_library_kept(library, n, some);
        mpq_set_num(share, some);
        mpq_set_den(share, all);
        mpq_canonicalize(share);
        if (!tn_array_reserve(&facts->lengths, &facts->length_capacity, facts->length_count, 1, sizeof *facts->lengths))
            break;
        facts->lengths[facts->length_count++] = (tn_length_count){strdup(name), n, mpq_get_d(share)};
    }
    mpq_clear(share);
    mpz_clears(all, some, NULL);
}

static void describe_library(tn_facts *facts, const tn_module *module, const tn_library *library, uint32_t index)
{
    count_library(facts, module, library, index);
    share_lengths(facts, library, tn_text(module, module->LIBRARY_records[index].name));
    add_measures(&facts->measures, module, library, index);
}

static void count_module(tn_facts *facts, const tn_module *module, tn_plan_memory *memory)
{
    for (size_t i = 0; i < module->LIBRARY_count; i++) {
        const tn_library_record *record = &module->LIBRARY_records[i];
        tn_library_options options = {.max_states = STATES_MAX, .max_table = TABLE_MAX, .memory = memory};
        tn_schema *schema = NULL;
        tn_library *library = NULL;
        tn_error error;
        if (tn_schema_new(module, record->schema, 0, &schema, &error) == TN_OK &&
            tn_library_new(schema, (uint32_t)i, &options, &library, &error) == TN_OK)
            describe_library(facts, module, library, (uint32_t)i);
        tn_library_free(library);
        tn_schema_free(schema);
    }
}

/* ---- relations */

static bool take_matrix(tn_rule_matrix *matrix, const tn_module *module, const tn_plan_analysis *analysis)
{
    size_t count = tn_plan_analysis_rule_count(analysis);
    matrix->names = calloc(count + 1, sizeof *matrix->names);
    matrix->relations = malloc(tn_size_of(count, count) + 1);
    if (!matrix->names || !matrix->relations)
        return false;
    matrix->count = count;
    for (size_t i = 0; i < count; i++) {
        matrix->names[i] = strdup(tn_text(module, module->RULE_records[tn_plan_analysis_rule(analysis, i)].name));
        if (!matrix->names[i])
            return false;
        for (size_t j = 0; j < count; j++)
            matrix->relations[i * count + j] = (uint8_t)tn_plan_analysis_relation(analysis, i, j);
    }
    return true;
}

tn_facts *tn_facts_new(const tn_module *module, const tn_plan_analyses *analyses, tn_plan_memory *memory)
{
    tn_facts *facts = calloc(1, sizeof *facts);
    if (!facts)
        return NULL;
    facts->matrices = calloc(analyses->count + 1, sizeof *facts->matrices);
    bool good = facts->matrices != NULL;
    for (size_t i = 0; good && i < analyses->count; i++)
        good = take_matrix(&facts->matrices[facts->matrix_count++], module, analyses->items[i]);
    if (good) {
        count_module(facts, module, memory);
        tn_place_facts_add(&facts->places, module);
        return facts;
    }
    tn_facts_free(facts);
    return NULL;
}

void tn_facts_free(tn_facts *facts)
{
    if (!facts)
        return;
    for (size_t i = 0; i < facts->count; i++) {
        free(facts->counts[i].library);
        free(facts->counts[i].rule);
        free(facts->counts[i].out);
        free(facts->counts[i].only);
    }
    for (size_t i = 0; i < facts->matrix_count; i++) {
        for (size_t k = 0; k < facts->matrices[i].count; k++)
            free(facts->matrices[i].names[k]);
        free(facts->matrices[i].names);
        free(facts->matrices[i].relations);
    }
    for (size_t i = 0; i < facts->length_count; i++)
        free(facts->lengths[i].library);
    clear_measures(&facts->measures);
    tn_place_facts_clear(&facts->places);
    free(facts->lengths);
    free(facts->matrices);
    free(facts->counts);
    free(facts);
}

/* ---- in words */

void tn_facts_grouped(FILE *out, const char *digits)
{
    size_t size = strlen(digits);
    for (size_t i = 0; i < size; i++) {
        if (i > 0 && (size - i) % 3 == 0)
            fputc(',', out);
        fputc(digits[i], out);
    }
}

/* of_library: it is the library that is asked about. */
static void write_count(FILE *out, const tn_rule_count *item, bool of_library)
{
    fprintf(out, "\n- ");
    if (item->rule && of_library)
        fprintf(out, item->requires ? "`%s` keeps out " : "`%s` prunes ", item->rule);
    else if (item->rule && item->requires)
        fprintf(out, "required in `%s`: keeps out ", item->library);
    else if (item->rule)
        fprintf(out, "prunes ");
    tn_facts_grouped(out, item->out);
    if (!item->rule)
        fprintf(out, " plans generated, ");
    else if (item->requires)
        fprintf(out, " plans of its lengths, ");
    else
        fprintf(out, " plans of `%s`, ", item->library);
    tn_facts_grouped(out, item->only);
    fprintf(out, item->rule ? " of them alone" : " kept");
}

/* A clause that has no name of its author's (a total, `require@12`) is told with its library: nothing else can be
 * asked about. */
static bool is_asked(const tn_rule_count *item, const tn_symbol *symbol)
{
    if (!item->library || !item->out || !item->only)
        return false;
    if (symbol->kind != TN_SYMBOL_LIBRARY)
        return item->rule && strcmp(item->rule, symbol->name) == 0 && item->is_rule == (symbol->kind == TN_SYMBOL_RULE);
    return strcmp(item->library, symbol->name) == 0 &&
           (!item->rule || strcmp(item->rule, "total") == 0 || strchr(item->rule, '@'));
}

static void write_counts(FILE *out, const tn_facts *facts, const tn_symbol *symbol)
{
    for (size_t i = 0; i < facts->count; i++)
        if (is_asked(&facts->counts[i], symbol))
            write_count(out, &facts->counts[i], symbol->kind == TN_SYMBOL_LIBRARY);
}

static void write_lengths(FILE *out, const tn_facts *facts, const tn_symbol *symbol)
{
    bool any = false;
    for (size_t i = 0; i < facts->length_count; i++) {
        const tn_length_count *item = &facts->lengths[i];
        if (!item->library || strcmp(item->library, symbol->name) != 0)
            continue;
        fprintf(out, any ? ", %u: %.3g %%" : "\n- by trays: %u: %.3g %%", item->length, 100 * item->share);
        any = true;
    }
}

static void write_relation(FILE *out, const tn_rule_matrix *matrix, size_t rule, tn_rule_relation relation,
                           const char *words)
{
    size_t found = 0;
    for (size_t i = 0; i < matrix->count; i++) {
        if (i == rule || matrix->relations[rule * matrix->count + i] != relation)
            continue;
        if (found < NAMES_SHOWN)
            fprintf(out, "%s`%s`", found ? ", " : words, matrix->names[i]);
        found++;
    }
    if (found > NAMES_SHOWN)
        fprintf(out, " and %zu more", found - NAMES_SHOWN);
}

static void write_relations(FILE *out, const tn_rule_matrix *matrix, const tn_symbol *symbol)
{
    for (size_t i = 0; i < matrix->count; i++) {
        if (strcmp(matrix->names[i], symbol->name) != 0)
            continue;
        write_relation(out, matrix, i, TN_RULES_EQUAL, "\n- matches the same plans as ");
        write_relation(out, matrix, i, TN_RULES_CONTAINS, "\n- subsumes (matches all that they match): ");
        write_relation(out, matrix, i, TN_RULES_INSIDE, "\n- subsumed by ");
        write_relation(out, matrix, i, TN_RULES_APART, "\n- has no plan in common with ");
    }
}

char *tn_facts_text(const tn_facts *facts, const tn_symbol *symbol)
{
    char *text = NULL;
    size_t size = 0;
    bool rule = symbol->kind == TN_SYMBOL_RULE || symbol->kind == TN_SYMBOL_CLAUSE,
         library = symbol->kind == TN_SYMBOL_LIBRARY, measure = symbol->kind == TN_SYMBOL_MEASURE;
    FILE *out = facts ? open_memstream(&text, &size) : NULL;
    if (!out)
        return NULL;
    if (rule || library)
        write_counts(out, facts, symbol);
    if (library)
        write_lengths(out, facts, symbol);
    if (library || measure)
        write_measures(&facts->measures, symbol, out);
    for (size_t i = 0; i < facts->matrix_count && symbol->kind == TN_SYMBOL_RULE; i++)
        write_relations(out, &facts->matrices[i], symbol);
    tn_place_facts_write(&facts->places, symbol, out);
    fclose(out);
    if (size > 0)
        return text;
    free(text);
    return NULL;
}
