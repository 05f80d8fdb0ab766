#include "lsp/counts.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/plan/library.h"

enum {
    STATES_MAX = 50000, /* bounds how long counting can take; larger libraries are not counted */
    THREAD_STACK = 4 << 20,
    ITEMS_MAX = 100000,
};

static void add(tn_counts *counts, const char *library, const char *rule, const mpz_t prunes, const mpz_t only)
{
    if (counts->count == counts->capacity) {
        size_t capacity = counts->capacity ? 2 * counts->capacity : 32;
        tn_rule_count *grown = capacity <= ITEMS_MAX ? realloc(counts->items, capacity * sizeof *grown) : NULL;
        if (!grown)
            return;
        counts->items = grown;
        counts->capacity = capacity;
    }
    tn_rule_count item = {strdup(library), rule ? strdup(rule) : NULL, mpz_get_str(NULL, 10, prunes),
                          mpz_get_str(NULL, 10, only)};
    if (item.library && item.prunes && item.only)
        counts->items[counts->count++] = item;
}

static void count_library(tn_counts *counts, const tn_module *module, const tn_library *library, const char *name)
{
    tn_error error;
    mpz_t prunes, only;
    mpz_inits(prunes, only, NULL);
    if (tn_library_generated(library, TN_ALL_LENGTHS, prunes, &error) == TN_OK) {
        tn_library_kept(library, TN_ALL_LENGTHS, only);
        add(counts, name, NULL, prunes, only);
    }
    for (size_t i = 0; i < tn_library_prune_count(library); i++) {
        uint32_t clause, states;
        if (tn_library_prune(library, i, &clause, prunes, only, &states, &error) == TN_OK)
            add(counts, name, tn_text(module, module->CLAUSE_records[clause].name), prunes, only);
    }
    mpz_clears(prunes, only, NULL);
}

static void count_module(tn_counts *counts, const tn_module *module)
{
    for (size_t i = 0; i < module->LIBRARY_count; i++) {
        const tn_library_record *record = &module->LIBRARY_records[i];
        tn_library_options options = {.max_states = STATES_MAX};
        tn_schema *schema = NULL;
        tn_library *library = NULL;
        tn_error error;
        if (tn_schema_new(module, record->schema, 0, &schema, &error) == TN_OK &&
            tn_library_new(schema, (uint32_t)i, &options, &library, &error) == TN_OK)
            count_library(counts, module, library, tn_text(module, record->name));
        tn_library_free(library);
        tn_schema_free(schema);
    }
}

static void *run(void *context)
{
    tn_counts *counts = context;
    tn_module *module = NULL;
    tn_error error;
    if (tn_module_load(counts->module, counts->module_size, NULL, &module, &error) == TN_OK)
        count_module(counts, module);
    tn_module_free(module);
    pthread_mutex_lock(&counts->lock);
    counts->done = true;
    pthread_mutex_unlock(&counts->lock);
    return NULL;
}

tn_counts *tn_counts_start(const uint8_t *module, size_t size)
{
    tn_counts *counts = calloc(1, sizeof *counts);
    if (!counts)
        return NULL;
    counts->module = malloc(size);
    counts->module_size = size;
    pthread_mutex_init(&counts->lock, NULL);
    if (counts->module) {
        memcpy(counts->module, module, size);
        pthread_attr_t attributes;
        pthread_attr_init(&attributes);
        pthread_attr_setstacksize(&attributes, THREAD_STACK);
        bool started = pthread_create(&counts->thread, &attributes, run, counts) == 0;
        pthread_attr_destroy(&attributes);
        if (started)
            return counts;
    }
    pthread_mutex_destroy(&counts->lock);
    free(counts->module);
    free(counts);
    return NULL;
}

void tn_counts_free(tn_counts *counts)
{
    if (!counts)
        return;
    pthread_join(counts->thread, NULL);
    pthread_mutex_destroy(&counts->lock);
    for (size_t i = 0; i < counts->count; i++) {
        free(counts->items[i].library);
        free(counts->items[i].rule);
        free(counts->items[i].prunes);
        free(counts->items[i].only);
    }
    free(counts->items);
    free(counts->module);
    free(counts);
}

bool tn_counts_done(tn_counts *counts)
{
    pthread_mutex_lock(&counts->lock);
    bool done = counts->done;
    pthread_mutex_unlock(&counts->lock);
    return done;
}

bool tn_counts_are_of(const tn_counts *counts, const uint8_t *module, size_t size)
{
    return counts->module_size == size && memcmp(counts->module, module, size) == 0;
}

/* "1,234,567" */
static void write_grouped(FILE *out, const char *digits)
{
    size_t size = strlen(digits);
    for (size_t i = 0; i < size; i++) {
        if (i > 0 && (size - i) % 3 == 0)
            fputc(',', out);
        fputc(digits[i], out);
    }
}

static void write_item(FILE *out, const tn_rule_count *item)
{
    fprintf(out, "\n- ");
    if (item->rule)
        fprintf(out, "prunes ");
    write_grouped(out, item->prunes);
    fprintf(out, item->rule ? " plans of `%s`, " : " plans generated, ", item->library);
    write_grouped(out, item->only);
    fprintf(out, item->rule ? " of them alone" : " kept");
}

char *tn_counts_text(tn_counts *counts, const tn_symbol *symbol)
{
    bool rule = symbol->kind == TN_SYMBOL_RULE || symbol->kind == TN_SYMBOL_CLAUSE;
    if (!counts || !tn_counts_done(counts) || (!rule && symbol->kind != TN_SYMBOL_LIBRARY))
        return NULL;
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    for (size_t i = 0; i < counts->count; i++) {
        const tn_rule_count *item = &counts->items[i];
        const char *name = rule ? item->rule : item->rule ? NULL : item->library;
        if (name && strcmp(name, symbol->name) == 0)
            write_item(out, item);
    }
    fclose(out);
    if (size == 0) {
        free(text);
        return NULL;
    }
    return text;
}
