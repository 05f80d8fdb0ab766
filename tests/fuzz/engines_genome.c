/* Grammars and studies of evolution from anywhere: analysed, mapped, mapped back, and bred. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "driver/breed/evolve.h"
#include "runtime/genome/mapping/invert.h"
#include "runtime/genome/mapping/tree.h"
#include "runtime/genome/picture/tree_draw.h"
#include "runtime/grammar/analysis.h"
#include "tests/fuzz/engines.h"

enum {
    GRAMMARS = 4,
    CODONS = 24,
    GENOMES = 4,
    STEPS = 1000,
    SENTENCE = 200,
    ITEMS = 20000,
    DEPTH = 6,
    POPULATION = 12,
    GENERATIONS = 2
};

/* ---- grammars */

static void analyse(const tn_grammar *grammar)
{
    tn_analysis analysis;
    bool by_codons;
    mpz_t total;
    mpz_init(total);
    if (tn_analyse(grammar, &analysis, NULL) == TN_OK)
        tn_count_derivations(grammar, DEPTH, &by_codons, total, NULL);
    tn_analysis_clear(&analysis);
    mpz_clear(total);
}

static void show(const tn_grammar *grammar, const tn_mapping *mapping, bool draws)
{
    tn_tree tree;
    tn_picture picture = {0};
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return;
    tn_trace_write(grammar, mapping->events, mapping->event_count, out);
    if (tn_tree_make(mapping->events, mapping->event_count, &tree, NULL) == TN_OK) {
        tn_tree_write_text(grammar, mapping->events, &tree, out);
        tn_tree_write_json(grammar, mapping->events, &tree, out);
        if (draws)
            tn_tree_draw(grammar, mapping->events, &tree, &picture, NULL);
        fuzz_drawn(&picture);
    }
    tn_tree_clear(&tree);
    fclose(out);
    free(text);
}

/* A genome for the sentence maps to the sentence. */
static void invert(const tn_grammar *grammar, const tn_mapping_options *options, const char *sentence, size_t size)
{
    tn_invert_options inverting = {
        .max_depth = options->max_depth, .position_independent = options->position_independent, .max_items = ITEMS};
    tn_genome genome = {0};
    tn_mapping again;
    tn_mapper *mapper = tn_mapper_new(grammar);
    if (mapper && tn_invert(grammar, sentence, size, &inverting, &genome, NULL) == TN_OK &&
        tn_mapper_derive(mapper, genome.codons, genome.count, options, &again, NULL) == TN_OK && again.has_phenotype &&
        grammar->dialect == TN_DIALECT_GE &&
        (again.phenotype_size != size || memcmp(again.phenotype, sentence, size) != 0))
        fuzz_broken("a genome for a sentence maps to another");
    tn_genome_clear(&genome);
    tn_mapper_free(mapper);
}

static void map(const tn_module *module, const tn_grammar *grammar)
{
    tn_mapping_options options = tn_mapping_options_of(grammar);
    options.max_steps = STEPS;
    options.record = true;
    tn_mapper *mapper = tn_mapper_new(grammar);
    for (uint64_t g = 0; mapper && g < GENOMES; g++) {
        uint64_t codons[CODONS];
        tn_mapping mapping;
        for (uint64_t i = 0; i < CODONS; i++)
            codons[i] = tn_random64(module->hash, g, i) % (g % 2 ? 256 : 5);
        tn_status status = tn_mapper_derive(mapper, codons, CODONS, &options, &mapping, NULL);
        if (status == TN_INVALID)
            fuzz_broken("a genome is refused");
        if (status != TN_OK)
            continue;
        show(grammar, &mapping, g == 0 && fuzz_draws(module));
        if (mapping.has_phenotype && mapping.phenotype_size < SENTENCE)
            invert(grammar, &options, mapping.phenotype, mapping.phenotype_size);
    }
    tn_mapper_free(mapper);
}

void fuzz_grammar(const tn_module *module)
{
    for (size_t i = 0; i < module->GRAMMAR_count && i < GRAMMARS; i++) {
        tn_grammar *grammar;
        if (tn_grammar_new(module, i, &grammar, NULL) != TN_OK)
            continue;
        analyse(grammar);
        map(module, grammar);
        tn_grammar_free(grammar);
    }
}

/* ---- evolution */

static void breed(const tn_grammar *grammar, tn_evolution_settings *settings, const tn_evaluator *evaluator)
{
    tn_evolution *evolution;
    settings->threads = 1;
    settings->mapping.max_steps = STEPS;
    if (tn_evolution_new(grammar, settings, evaluator, &evolution, NULL) != TN_OK)
        return;
    for (int i = 0; i <= GENERATIONS; i++)
        if (tn_evolution_step(evolution, NULL) != TN_OK)
            break;
    tn_evolution_free(evolution);
}

/* Small: nobody waits for a large population here. */
static bool is_modest(const tn_evolution_settings *settings)
{
    return settings->population <= 10 * POPULATION && settings->codons <= 1000 && settings->vary.max_codons <= 100000 &&
           settings->depth_high <= 30 && settings->tail < 10;
}

/* Studies that name files of this machine are left alone, but for primitives on a coarse grid. */
static bool names_files(const tn_evolution_study *study)
{
    for (uint32_t i = 0; i < study->each_count; i++)
        if (study->each[i].setting == TN_SET_LIKENESS ||
            (study->each[i].setting == TN_SET_PARENT && strpbrk(study->each[i].value.text, "./")))
            return true;
    if (study->each_count && study->of[TN_SET_GRID].first > 12)
        return true;
    for (tn_setting i = 0; i < TN_SETTING_COUNT; i++)
        if (tn_setting_rows[i].kind == TN_SETTING_TEXT && i != TN_SET_MATCH && i != TN_SET_BOX && study->of[i].written)
            return true;
    return false;
}

static void breed_study(const tn_module *module, const tn_evolution_study *study)
{
    tn_evolution_job job;
    tn_evolution_job_options options = {.threads = 1};
    if (names_files(study))
        return;
    if (tn_evolution_job_make(study, "fuzz.study", module, &options, &job, NULL) == TN_OK && is_modest(&job.settings))
        breed(job.grammar, &job.settings, &job.evaluator);
    tn_evolution_job_clear(&job);
}

static void breed_grammar(const tn_module *module)
{
    tn_evolution_settings settings = tn_evolution_settings_default();
    tn_grammar *grammar;
    tn_problem *problem;
    settings.seed = module->hash;
    settings.population = POPULATION;
    settings.initialisation = (tn_initialisation)(module->hash / 8 % TN_INITIALISE_COUNT);
    settings.depth_low = 2;
    settings.depth_high = DEPTH;
    if (tn_problem_match("x", &problem, NULL) != TN_OK)
        return;
    if (tn_grammar_new(module, 0, &grammar, NULL) == TN_OK) {
        tn_evaluator evaluator = tn_problem_evaluator(problem);
        settings.mapping = tn_mapping_options_of(grammar);
        breed(grammar, &settings, &evaluator);
        tn_grammar_free(grammar);
    }
    tn_problem_free(problem);
}

/* What a verified module sets is something that a study could say. */
void fuzz_genome(const tn_module *module)
{
    tn_evolution_study study;
    tn_setting_fault faults[TN_SETTING_FAULTS_MAX];
    bool has_study = tn_evolution_study_of(module, &study);
    if (has_study && tn_evolution_study_faults(&study, faults) > 0)
        fuzz_broken("a study that contradicts itself is loaded");
    if (has_study)
        breed_study(module, &study);
    else if (module->GRAMMAR_count > 0)
        breed_grammar(module);
}
