/* tartan breed: evolution by a person's eye. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "cli/genome/evolution_session.h"
#include "driver/breed/evolve_sheet.h"
#include "runtime/base/array.h"

#define TURNS_MAX 100u /* how often one individual may be chosen at once: N*100 */

typedef struct choice {
    uint32_t *places;
    size_t count, capacity;
} choice;

static bool add(choice *c, uint64_t place, uint64_t times)
{
    for (uint64_t i = 0; i < times; i++) {
        if (!tn_array_reserve(&c->places, &c->capacity, c->count, 1, sizeof *c->places))
            return false;
        c->places[c->count++] = (uint32_t)(place - 1);
    }
    return true;
}

/* Reads "3 7*2 12": places from 1, each perhaps with how much it counts. */
static bool read_choice(char *line, size_t members, choice *c)
{
    c->count = 0;
    for (char *word = strtok(line, " ,\t\r\n"); word; word = strtok(NULL, " ,\t\r\n")) {
        char *end, *rest;
        uint64_t place = strtoull(word, &end, 10), times = 1;
        if (*end == '*') {
            times = strtoull(end + 1, &rest, 10);
            end = rest;
        }
        if (end == word || *end || place < 1 || place > members || times < 1 || times > TURNS_MAX) {
            printf("`%s` is no choice: write numbers from 1 to %zu, as 3 7 12, or 3*2 to let one count twice\n", word,
                   members);
            return false;
        }
        if (!add(c, place, times))
            return false;
    }
    return true;
}

/* Asks until there is an answer; false at its end. */
static bool ask(size_t members, choice *c)
{
    char *line = NULL;
    size_t capacity = 0;
    bool answered = false;
    while (!answered) {
        printf("parents? (numbers; an empty line ends) ");
        fflush(stdout);
        tn_interrupt_asking(true);
        bool read = !tn_interrupted() && getline(&line, &capacity, stdin) >= 0;
        tn_interrupt_asking(false);
        if (!read || tn_interrupted()) {
            putchar('\n');
            break;
        }
        answered = read_choice(line, members, c);
    }
    free(line);
    return answered && c->count > 0;
}

static void breed(tn_evolution_session *e)
{
    tn_error error;
    choice c = {0};
    tn_status status = e->run.generations ? TN_OK : tn_run_step(&e->run, NULL, 0, &error);
    while (status == TN_OK && !tn_interrupted()) {
        size_t members;
        char sheet[512];
        tn_evolution_members(e->run.evolution, &members);
        status = tn_run_sheet(&e->run, sheet, sizeof sheet, &error);
        if (status != TN_OK)
            break;
        printf("generation %u: %s\n", e->run.generations - 1, sheet);
        if (e->run.generations > e->generations || !ask(members, &c))
            break;
        status = tn_run_step(&e->run, c.places, c.count, &error);
    }
    free(c.places);
    if (status == TN_OK)
        status = tn_run_results(&e->run, &error);
    if (status != TN_OK) {
        tn_job_fail(e->command, &error);
        return;
    }
    printf("results are in %s; --resume goes on from here\n", e->run.dir);
    if (tn_interrupted())
        e->command->exit_code = TN_EXIT_INTERRUPTED;
}

static int run(const tn_command *command, const tn_settings *settings)
{
    (void)command;
    return tn_evolution_session_run((const tn_session_settings *)settings, breed);
}

#define SETTINGS tn_session_settings
static const tn_option options[] = {
    OPTIONS_RUN("how many generations to breed at most, instead of the study's number")};

const tn_command tn_command_breed = {
    .name = "breed",
    .summary = "breed sentences, choosing the parents yourself",
    .usage = "STUDY.study [-o DIR] [--resume]",
    .description =
        "Like evolve, but you choose the parents of each generation: a sheet shows every individual with its "
        "number, and you type the numbers of those that are to have children. 3*2 counts twice as much as 3. Your "
        "choices are stored with the run, so it can be replayed and continued. A population of 12 to 24 suits a "
        "sheet.",
    .example = "$ tartan breed garden.study -o garden.run",
    .options = options,
    .option_count = OPTION_COUNT(options),
    .settings_size = sizeof(SETTINGS),
    .ask_less = "make the population smaller",
    .operands = "one STUDY.study",
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
