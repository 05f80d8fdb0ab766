/* tartan breed: evolution by a person's eye. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "cli/genome/evolution_session.h"
#include "cli/genome/prompt.h"
#include "driver/hand/choice.h"
#include "driver/sheet/sheet_page.h"
#include "driver/sheet/sheet_picture.h"

/* Reads a line of choices and says what is wrong with it. */
static bool read_choice(const char *line, size_t members, tn_choices *choices)
{
    char wrong[40];
    tn_error error;
    tn_status status = tn_choices_read(line, choices, wrong, &error);
    for (size_t i = 0; status == TN_OK && i < choices->count; i++)
        if (!choices->items[i].by_id && choices->items[i].number >= members) {
            snprintf(wrong, sizeof wrong, "%" PRIu64, choices->items[i].number + 1);
            status = TN_INVALID;
        }
    if (status != TN_OK)
        printf("`%s` is not a choice: write numbers from 1 to %zu, as 3 7 12; 3*2 counts twice, 3@0.4 gives less of it "
               "(0 to 1), "
               "and #41 is the individual with that id\n",
               wrong, members);
    return status == TN_OK;
}

typedef enum answer { PARENTS, CHANGED, NOTHING_MORE } answer;

/* Asks until there is an answer. */
static answer ask(tn_evolving *e, size_t members, tn_choices *c)
{
    char *line = NULL;
    size_t capacity = 0;
    answer given = NOTHING_MORE;
    for (bool answered = false; !answered;) {
        printf("parents? (numbers; set, insert, edit or out; an empty line ends) ");
        fflush(stdout);
        tn_interrupt_asking(true);
        bool read = !tn_interrupted() && getline(&line, &capacity, stdin) >= 0;
        tn_interrupt_asking(false);
        if (!read || tn_interrupted()) {
            putchar('\n');
            break;
        }
        tn_prompt_answer done = tn_prompt_do(e, line);
        bool command = done != TN_PROMPT_NOT_A_COMMAND;
        answered = command ? done == TN_PROMPT_DONE : read_choice(line, members, c);
        given = command ? CHANGED : c->count > 0 ? PARENTS : NOTHING_MORE;
    }
    free(line);
    return given;
}

static void breed(tn_evolving *e, tn_job *job)
{
    tn_error error;
    tn_choices c = {0};
    bool begins = e->run.generations == 0;
    tn_status status = begins ? tn_run_step(&e->run, NULL, 0, &error) : TN_OK;
    if (begins && status == TN_OK) {
        tn_evolving_warn(e);
        tn_job_show(job);
    }
    while (status == TN_OK && !tn_interrupted()) {
        size_t members;
        char sheet[TN_SHEET_NAME_SIZE];
        bool page;
        tn_evolution_members(e->run.evolution, &members);
        status = tn_run_sheet(&e->run, NULL, sheet, &error);
        if (status != TN_OK)
            break;
        status = tn_sheet_page(&e->run, NULL, &page, &error);
        if (status != TN_OK)
            break;
        printf("generation %u: %s/%s", e->run.generations - 1, e->run.dir, sheet);
        if (page)
            printf(", %s/%s", e->run.dir, TN_SHEET_PAGE);
        putchar('\n');
        answer given = e->run.generations > e->generations ? NOTHING_MORE : ask(e, members, &c);
        if (given == NOTHING_MORE)
            break;
        if (given == CHANGED) /* the same members, as they are now, on the sheet again */
            continue;
        status = tn_run_step(&e->run, c.items, c.count, &error);
        if (status == TN_INVALID && error.code == E_NO_INDIVIDUAL) { /* an id that nobody has: asked again */
            puts(error.message);
            status = TN_OK;
        }
    }
    tn_choices_clear(&c);
    if (status == TN_OK)
        status = tn_run_results(&e->run, NULL, &error);
    if (status != TN_OK) {
        tn_job_fail(job, &error);
        return;
    }
    printf("results are in %s; --resume goes on from here\n", e->run.dir);
    if (tn_interrupted())
        job->exit_code = TN_EXIT_INTERRUPTED;
}

static int run(const tn_command *command, const tn_settings *settings)
{
    (void)command;
    tn_study_job study;
    if (tn_study_job_open(&study, (const tn_session_settings *)settings)) {
        tn_evolving evolving = {.session = &study.job.session, .asked = &study.asked, .remembers = true};
        if (tn_job_answered(&study.job, tn_evolving_begin(&evolving))) {
            tn_job_show(&study.job);
            breed(&evolving, &study.job);
        }
        tn_evolving_clear(&evolving);
    }
    return tn_study_job_end(&study);
}

#define SETTINGS tn_session_settings
static const tn_option options[] = {
    OPTIONS_RUN("how many generations to breed at most, instead of the study's number")};

const tn_command tn_command_breed = {
    .name = "breed",
    .summary = "breed sentences, fields or designs, choosing the parents yourself",
    .usage = "STUDY.study [-o DIR] [--resume]",
    .description =
        "Like evolve, but you choose the parents of each generation: a sheet shows every individual with its "
        "number, and you type the numbers of those that are to have children. 3*2 counts twice as much as 3, and #41 "
        "is the individual with the id 41, of any generation. `set gravity 0 0 -0.2`, `set mutation codons 0.05` "
        "or `set population 30` changes the run from here on, as --set does. `insert FILE` puts a sentence of your own "
        "into the generation, in the place of the worst; `edit 3` opens the third in your editor (`edit 3 FILE` takes "
        "what a file says) and puts it back; `out 3` takes it out. Fields and designs can be weighed: 3@0.4 gives the "
        "children less "
        "of 3. Your "
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
