/* tartan breed: evolution by a person's eye. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ask/session/questions.h"
#include "cli/common/interrupt.h"
#include "cli/genome/evolution_session.h"
#include "cli/genome/prompt.h"

/* What has been typed so far, which is what the question asks for. */
typedef struct by_eye {
    tn_study_job *study;
    tn_prompt prompt;
    tn_breed_request request;
    tn_reply answer; /* the newest generation */
} by_eye;

static const tn_bred *told(const by_eye *b)
{
    return TN_REPLY(bred, &b->answer);
}

/* Says what is wrong with what was typed, which is asked again, and takes that back from what is said in the end. */
static void refuse(tn_job *job, const tn_diagnostics *kept)
{
    tn_diagnostics *list = tn_job_diagnostics(job);
    for (size_t i = 0; i < list->count; i++)
        tn_prompt_say(&list->items[i]);
    tn_diagnostics_clear(list);
    *list = *kept;
}

static tn_code code_of(tn_job *job)
{
    const tn_diagnostics *list = tn_job_diagnostics(job);
    return list->count ? list->items[list->count - 1].code : TN_CODE_NONE;
}

/* The next generation, or the one that there is as it was changed; false: it could not be bred, which ends the command.
 * *done: the generation is to be shown. */
static bool act(by_eye *b, const tn_breed_action *action, bool *done)
{
    tn_job *job = &b->study->job;
    tn_diagnostics *list = tn_job_diagnostics(job);
    const tn_diagnostics kept = *list;
    tn_reply answer;
    if (!tn_prompt_add(&b->prompt, action, &b->request)) {
        tn_job_status(job, TN_MEMORY);
        return false;
    }
    tn_diagnostics_init(list, kept.sources);
    tn_status status = tn_ask_breed(&job->session, &b->request, &answer);
    tn_code code = code_of(job);
    bool breeds = action->does == TN_PROMPT_BREED, nobody = breeds && code == E_NO_INDIVIDUAL;
    *done = status == TN_OK || nobody;
    if (status != TN_OK && breeds && !nobody && code != E_USAGE) {
        tn_reply_clear(&answer);
        tn_job_answered(job, status);
        return false;
    }
    if (status == TN_OK) {
        tn_diagnostics_clear(list);
        *list = kept;
        tn_reply_clear(&b->answer);
        b->answer = answer;
    } else {
        refuse(job, &kept);
        tn_prompt_take_back(&b->prompt, &b->request);
        tn_reply_clear(&answer);
    }
    return true;
}

/* Reads a line and does what it says, until something is done; false: there is no more. *failed: the command is. */
static bool ask(by_eye *b, bool *failed)
{
    char *line = NULL;
    size_t capacity = 0;
    bool done = false, more = true;
    while (!done && more) {
        tn_breed_action action;
        printf("parents? (numbers; set, insert, edit or out; an empty line ends) ");
        fflush(stdout);
        tn_interrupt_asking(true);
        bool read = !tn_interrupted() && getline(&line, &capacity, stdin) >= 0;
        tn_interrupt_asking(false);
        if (!read || tn_interrupted()) {
            putchar('\n');
            break;
        }
        tn_prompt_answer typed = tn_prompt_read(&b->prompt, told(b), line, &action);
        more = typed != TN_PROMPT_NOTHING;
        if (typed == TN_PROMPT_ACTION) {
            *failed = !act(b, &action, &done);
            more = !*failed;
        }
        tn_prompt_end(&b->prompt, done);
    }
    free(line);
    return done;
}

static void show(const tn_bred *bred)
{
    printf("generation %" PRIu64 ": %s/%s", bred->generation, bred->run, bred->sheet);
    if (bred->has_page)
        printf(", %s/%s", bred->run, bred->page);
    putchar('\n');
}

static void breed(by_eye *b)
{
    tn_job *job = &b->study->job;
    bool failed = false;
    tn_reply answer;
    if (!tn_job_answered(job, tn_ask_breed(&job->session, &b->request, &b->answer)))
        return;
    tn_job_show(job);
    if (!tn_interrupted()) {
        do
            show(told(b));
        while (told(b)->more && ask(b, &failed) && !tn_interrupted());
    }
    b->request.results = true;
    if (failed || !tn_job_answered(job, tn_ask_breed(&job->session, &b->request, &answer)))
        return;
    tn_reply_clear(&answer);
    printf("results are in %s; --resume goes on from here\n", b->study->asked.run);
    if (tn_interrupted())
        job->exit_code = TN_EXIT_INTERRUPTED;
}

static int run(const tn_command *command, const tn_settings *settings)
{
    (void)command;
    tn_study_job study;
    if (tn_study_job_open(&study, (const tn_session_settings *)settings)) {
        by_eye b = {.study = &study, .prompt.dir = study.asked.run, .request.asked = study.asked};
        breed(&b);
        tn_reply_clear(&b.answer);
        tn_prompt_clear(&b.prompt);
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
