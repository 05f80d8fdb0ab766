/* The front end of grammars on any text: it ends, says what is wrong, and what it accepts loads, is analysed, maps, and
 * inverts what it maps. The first byte chooses the genome. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "runtime/base/random.h"
#include "runtime/genome/mapping/invert.h"
#include "runtime/genome/mapping/tree.h"
#include "runtime/grammar/analysis.h"
#include "runtime/load.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/compile_file.h"

enum { CODONS = 40, STEPS = 4000, ITEMS = 20000, LONGEST = 120 };

static void fail(const char *what)
{
    fprintf(stderr, "%s\n", what);
    abort();
}

static void write_all(const tn_grammar *grammar, const tn_mapping *mapping)
{
    char *text = NULL;
    size_t size;
    tn_tree tree;
    FILE *out = open_memstream(&text, &size);
    if (out && tn_tree_make(mapping->events, mapping->event_count, &tree, NULL) == TN_OK) {
        tn_trace_write(grammar, mapping->events, mapping->event_count, out);
        tn_tree_write_text(grammar, mapping->events, &tree, out);
        tn_tree_write_json(grammar, mapping->events, &tree, out);
        tn_tree_clear(&tree);
    }
    if (out)
        fclose(out);
    free(text);
}

static void invert(const tn_grammar *grammar, tn_mapper *mapper, const tn_mapping_options *options,
                   const char *sentence, size_t size)
{
    tn_genome genome = {0};
    tn_error error;
    tn_invert_options inverting = {
        .max_depth = options->max_depth, .position_independent = options->position_independent, .max_items = ITEMS};
    tn_status status = tn_invert(grammar, sentence, size, &inverting, &genome, &error);
    if (status == TN_INVALID)
        fail("a mapped sentence is not derivable");
    if (status == TN_OK) {
        tn_mapping again;
        tn_mapping_options once = *options;
        once.wraps = 0;
        once.repair = TN_REPAIR_OFF;
        once.max_steps = 0;
        if (tn_mapper_derive(mapper, genome.codons, genome.count, &once, &again, NULL) != TN_OK || !again.valid ||
            again.phenotype_size != size || memcmp(again.phenotype, sentence, size) != 0)
            fail("a genome found for a sentence maps to another");
    }
    tn_genome_clear(&genome);
}

static void map(const tn_grammar *grammar, uint64_t seed)
{
    tn_mapper *mapper = tn_mapper_new(grammar);
    tn_mapping_options options = tn_mapping_options_of(grammar);
    uint64_t codons[CODONS];
    options.max_steps = STEPS;
    for (uint64_t i = 0; i < CODONS; i++)
        codons[i] = tn_random64(seed, 0, i);
    for (int recorded = 0; recorded < 2 && mapper; recorded++) {
        tn_mapping mapping;
        options.record = recorded;
        if (tn_mapper_derive(mapper, codons, CODONS, &options, &mapping, NULL) != TN_OK)
            break;
        if (recorded)
            write_all(grammar, &mapping);
        /* blanks inside a genr8 terminal cannot be: its sentence parts at them */
        if (!recorded && mapping.has_phenotype && mapping.phenotype_size <= LONGEST) {
            char *sentence = strndup(mapping.phenotype, mapping.phenotype_size);
            size_t size = mapping.phenotype_size;
            if (sentence)
                invert(grammar, mapper, &options, sentence, size);
            free(sentence);
        }
    }
    tn_mapper_free(mapper);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    uint64_t seed = size ? data[0] : 0;
    library_folders options = {0};
    tn_compilation compilation;
    tn_status status = compile_text("fuzz.bnf", (const char *)data, size, &options, &compilation);
    if (status == TN_OK) {
        tn_module *module;
        tn_grammar *grammar;
        tn_analysis analysis;
        if (tn_module_load(compilation.module, compilation.module_size, NULL, &module, NULL) != TN_OK)
            fail("refused");
        if (tn_grammar_new(module, 0, &grammar, NULL) == TN_OK) {
            if (tn_analyse(grammar, &analysis, NULL) == TN_OK && analysis.rule_depth[0] == TN_DEPTH_ENDLESS)
                fail("the start symbol never ends");
            tn_analysis_clear(&analysis);
            map(grammar, seed);
            tn_grammar_free(grammar);
        }
        tn_module_free(module);
    } else if (compilation.diagnostics.error_count == 0) {
        fail("failed without an error");
    }
    tn_compilation_clear(&compilation);
    return 0;
}
