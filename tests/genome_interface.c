/* Maps, inverts and breeds through the C interface, and reads runs, as a program outside would. What it prints,
 * tests/cli/genome_interface.sh holds to what the commands write.
 *
 *   genome_interface STDLIB map GRAMMAR          genomes of standard input, one a line, as `tartan map` prints them
 *   genome_interface STDLIB invert GRAMMAR TEXT  as `tartan map --invert`
 *   genome_interface STDLIB breed STUDY TARGET GENERATIONS
 *                                                breeds towards a text, as `match` does: the lines of stats.csv, as far as
 *                                                the interface has them, and the best sentence
 *   genome_interface STDLIB run DATABASE         the same lines of a run that is stored, and its texts
 *
 * Where something fails, it prints the number of the diagnostic, and ends with 1. */
#include "include/tartan/tartan.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static tartan_status compile(const char *path, const char *stdlib, tartan_module **module, tartan_error *error)
{
    const char *folders[] = {stdlib};
    tartan_compile_options options = tartan_compile_options_init();
    options.folders = folders;
    options.folder_count = 1;
    return tartan_compile_file(path, &options, module, error);
}

static tartan_status open_grammar(const char *path, const char *stdlib, tartan_grammar **grammar, tartan_error *error)
{
    tartan_module *module = NULL;
    tartan_status status = compile(path, stdlib, &module, error);
    if (status == TARTAN_OK)
        status = tartan_grammar_new(module, grammar, error);
    tartan_module_free(module);
    return status;
}

/* ---- mapping */

static size_t read_codons(char *line, uint64_t *codons, size_t most)
{
    size_t count = 0;
    for (char *word = strtok(line, " \n"); word && count < most; word = strtok(NULL, " \n"))
        codons[count++] = strtoull(word, NULL, 10);
    return count;
}

static tartan_status map_line(tartan_mapper *mapper, char *line, size_t number, tartan_error *error)
{
    uint64_t codons[1000];
    size_t count = read_codons(line, codons, sizeof codons / sizeof *codons);
    tartan_mapping m = tartan_mapping_init();
    tartan_status status = tartan_map(mapper, codons, count, NULL, &m, error);
    if (status != TARTAN_OK)
        return status;
    bool written = m.valid || m.reason == TARTAN_MAP_REPAIR_OUT_OF_CODONS || m.reason == TARTAN_MAP_REPAIR_TOO_LONG;
    printf("# genome %zu: ", number);
    if (written)
        printf("%" PRIu64 " codons, %" PRIu64 " wraps, %" PRIu64 " nodes, depth %" PRIu32, m.used, m.wraps, m.nodes,
               m.depth);
    if (!m.valid)
        printf("%snot valid: %s", written ? "; " : "", m.reason_text);
    putchar('\n');
    if (written)
        printf("%s\n", m.sentence);
    return TARTAN_OK;
}

static tartan_status map_all(const char *path, const char *stdlib, tartan_error *error)
{
    static char line[20000];
    tartan_grammar *grammar = NULL;
    tartan_mapper *mapper = NULL;
    tartan_status status = open_grammar(path, stdlib, &grammar, error);
    if (status == TARTAN_OK)
        status = tartan_mapper_new(grammar, &mapper, error);
    for (size_t number = 1; status == TARTAN_OK && fgets(line, sizeof line, stdin); number++)
        status = map_line(mapper, line, number, error);
    tartan_mapper_free(mapper);
    tartan_grammar_free(grammar);
    return status;
}

static tartan_status invert(const char *path, const char *stdlib, const char *text, tartan_error *error)
{
    tartan_grammar *grammar = NULL;
    tartan_map_options options = tartan_map_options_init();
    uint64_t *codons = NULL;
    size_t count = 0;
    tartan_status status = open_grammar(path, stdlib, &grammar, error);
    if (status == TARTAN_OK)
        status = tartan_map_options_of(grammar, &options, error);
    if (status == TARTAN_OK)
        status = tartan_invert(grammar, text, strlen(text), options.max_depth, NULL, &codons, &count, error);
    for (size_t i = 0; status == TARTAN_OK && i < count; i++)
        printf("%s%" PRIu64, i ? " " : "", codons[i]);
    if (status == TARTAN_OK)
        putchar('\n');
    tartan_bytes_free(codons);
    tartan_grammar_free(grammar);
    return status;
}

/* ---- breeding */

/* A point for each place of the longer text; less 1 where the letters are the same, less 1/(1+d) where they are d
 * apart (docs/evolution.md, `match`). */
static tartan_status match(void *context, unsigned thread, const tartan_sentence *sentences, size_t count,
                           tartan_score *scores, tartan_error *error)
{
    const char *target = context;
    size_t length = strlen(target);
    (void)thread, (void)error;
    for (size_t s = 0; s < count; s++) {
        double cost = (double)(sentences[s].size > length ? sentences[s].size : length);
        for (size_t i = 0; i < length && i < sentences[s].size; i++)
            cost -= 1.0 / (1 + abs((unsigned char)target[i] - (unsigned char)sentences[s].text[i]));
        scores[s].objectives[0] = cost;
    }
    return TARTAN_OK;
}

static void print_generation(const tartan_generation *g)
{
    printf("%" PRIu32 ",%.17g,%.17g,%" PRIu32 ",%" PRIu32 ",%" PRIu32 ",%" PRIu32 ",%" PRIu32 ",%" PRIu64 ",%" PRIu64
           ",%.6g,%.6g\n",
           g->number, g->best[0], g->mean, g->scored, g->no_sentence, g->failed, g->limited, g->distinct,
           g->evaluations, g->births, g->mean_codons, g->mean_depth);
}

static tartan_status breed_one(tartan_evolution *evolution, tartan_error *error)
{
    tartan_generation g = tartan_generation_init();
    tartan_status status = tartan_evolution_step(evolution, NULL, error);
    if (status == TARTAN_OK)
        status = tartan_evolution_generation(evolution, &g, error);
    if (status == TARTAN_OK)
        print_generation(&g);
    return status;
}

static tartan_status breed(const char *path, const char *stdlib, char *target, unsigned long generations,
                           tartan_error *error)
{
    tartan_module *module = NULL;
    tartan_evolution *evolution = NULL;
    tartan_evolution_options options = tartan_evolution_options_init();
    tartan_individual best = tartan_individual_init();
    tartan_status status = compile(path, stdlib, &module, error);
    if (status == TARTAN_OK)
        status = tartan_evolution_options_of(module, &options, error);
    options.evaluate = match;
    options.context = target;
    if (status == TARTAN_OK)
        status = tartan_evolution_new(module, &options, &evolution, error);
    for (unsigned long i = 0; status == TARTAN_OK && i <= generations; i++)
        status = breed_one(evolution, error);
    if (status == TARTAN_OK)
        status = tartan_evolution_member(evolution, 0, &best, error);
    if (status == TARTAN_OK)
        printf("%" PRIu64 " %s%s", best.id, best.sentence,
               best.sentence_size && best.sentence[best.sentence_size - 1] == '\n' ? "" : "\n");
    tartan_evolution_free(evolution);
    tartan_module_free(module);
    return status;
}

/* ---- stored runs */

static tartan_status print_texts(tartan_run *run, tartan_error *error)
{
    static const char *const names[] = {"study_path", "study", "grammar_path", "grammar", "seed", "objectives"};
    tartan_status status = TARTAN_OK;
    for (size_t i = 0; i < sizeof names / sizeof *names && status == TARTAN_OK; i++) {
        char *text = NULL;
        status = tartan_run_text(run, names[i], &text, error);
        if (status == TARTAN_OK)
            printf("%s: %s\n", names[i], text ? text : "");
        tartan_text_free(text);
    }
    return status;
}

static tartan_status print_run(const char *path, tartan_error *error)
{
    tartan_run *run = NULL;
    tartan_status status = tartan_run_open(path, &run, error);
    for (size_t i = 0; status == TARTAN_OK && i < tartan_run_generations(run); i++) {
        tartan_generation g = tartan_generation_init();
        status = tartan_run_generation(run, i, &g, error);
        if (status == TARTAN_OK)
            print_generation(&g);
    }
    for (size_t i = 0; status == TARTAN_OK && i < tartan_run_event_count(run); i++) {
        tartan_run_event event = tartan_run_event_init();
        status = tartan_run_event_at(run, i, &event, error);
        if (status == TARTAN_OK)
            printf("%" PRIu32 "|%s|%s\n", event.generation, event.kind, event.text);
    }
    if (status == TARTAN_OK)
        status = print_texts(run, error);
    tartan_run_free(run);
    return status;
}

int main(int argc, char **argv)
{
    tartan_error error = {0};
    tartan_status status;
    if (argc == 4 && strcmp(argv[2], "map") == 0) {
        status = map_all(argv[3], argv[1], &error);
    } else if (argc == 5 && strcmp(argv[2], "invert") == 0) {
        status = invert(argv[3], argv[1], argv[4], &error);
    } else if (argc == 6 && strcmp(argv[2], "breed") == 0) {
        status = breed(argv[3], argv[1], argv[4], strtoul(argv[5], NULL, 10), &error);
    } else if (argc == 4 && strcmp(argv[2], "run") == 0) {
        status = print_run(argv[3], &error);
    } else {
        fputs("usage: genome_interface STDLIB map|invert|breed|run FILE ...\n", stderr);
        return 2;
    }
    if (status != TARTAN_OK)
        printf("E%04" PRIu32 "\n", error.code);
    return status == TARTAN_OK ? 0 : 1;
}
