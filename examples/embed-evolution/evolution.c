/* A program of its own that breeds sentences of a grammar by a fitness of its own: sums of numbers are to come near a
 * target, with as few letters as that takes. The run is saved in the middle and goes on from there, which changes
 * nothing.
 *
 *   cc evolution.c $(pkg-config --cflags --libs tartan) -o evolution
 *   ./evolution sums.bnf 137
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <tartan/tartan.h>

enum { GENERATIONS = 30 };

/* "12+7+100" */
static double value_of(const char *text)
{
    double sum = 0, number = 0;
    for (; *text; text++) {
        number = *text == '+' ? 0 : 10 * number + (*text - '0');
        if (text[1] == '+' || !text[1])
            sum += number;
    }
    return sum;
}

/* The fitness: lower is better. Sentences come many at a time, on several threads at once. */
static tartan_status score(void *context, unsigned thread, const tartan_sentence *sentences, size_t count,
                           tartan_score *scores, tartan_error *error)
{
    const double *target = context;
    (void)thread, (void)error;
    for (size_t i = 0; i < count; i++)
        scores[i].objectives[0] = fabs(value_of(sentences[i].text) - *target) + 0.001 * (double)sentences[i].size;
    return TARTAN_OK;
}

static void show_best(const tartan_evolution *evolution)
{
    tartan_individual best = tartan_individual_init();
    tartan_generation now = tartan_generation_init();
    tartan_evolution_member(evolution, 0, &best, NULL);
    tartan_evolution_generation(evolution, &now, NULL);
    printf("generation %2u, %4u different: %.3f  %s\n", (unsigned)now.number, (unsigned)now.distinct,
           best.objectives[0], best.sentence);
}

/* Generations, up to so many in all, or until the best is near enough. */
static tartan_status breed(tartan_evolution *evolution, uint32_t generations, tartan_error *error)
{
    tartan_status status = TARTAN_OK;
    while (status == TARTAN_OK && tartan_evolution_done(evolution) < generations) {
        status = tartan_evolution_step(evolution, NULL, error);
        if (status == TARTAN_OK && tartan_evolution_done(evolution) % 5 == 0)
            show_best(evolution);
    }
    return status;
}

static tartan_status run(const tartan_module *module, double target, tartan_error *error)
{
    tartan_evolution_options options = tartan_evolution_options_init();
    tartan_evolution *first = NULL, *second = NULL;
    void *state = NULL;
    size_t size = 0;
    options.population = 200;
    options.seed = 7;
    options.batch = 16;
    options.evaluate = score;
    options.context = &target;
    tartan_status status = tartan_evolution_new(module, &options, &first, error);
    if (status == TARTAN_OK)
        status = breed(first, GENERATIONS / 2, error);
    if (status == TARTAN_OK)
        status = tartan_evolution_save(first, &state, &size, error);
    tartan_evolution_free(first);

    /* Another day, another process: the bytes could lie in a file in between. */
    if (status == TARTAN_OK) {
        printf("saved: %zu bytes\n", size);
        status = tartan_evolution_restore(module, &options, state, size, &second, error);
    }
    if (status == TARTAN_OK)
        status = breed(second, GENERATIONS, error);
    tartan_evolution_free(second);
    tartan_bytes_free(state);
    return status;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: %s GRAMMAR.bnf TARGET\n", argv[0]);
        return 2;
    }
    tartan_error error;
    tartan_module *module = NULL;
    tartan_status status = tartan_compile_file(argv[1], NULL, &module, &error);
    if (status == TARTAN_OK)
        status = run(module, atof(argv[2]), &error);
    if (status != TARTAN_OK)
        fprintf(stderr, "%s: %s\n", argv[0], error.message);
    tartan_module_free(module);
    return status != TARTAN_OK;
}
