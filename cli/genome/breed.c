/* tartan breed: evolution by a person's eye. */
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "ask/session/questions.h"
#include "ask/session/session.h"
#include "cli/common/interrupt.h"
#include "cli/common/options.h"
#include "cli/genome/evolve.h"
#include "driver/breed/evolve.h"
#include "runtime/base/array.h"
#include "runtime/base/file.h"
#include "runtime/base/utf8.h"

/* The first of the words that say what an action does. */
enum { TN_PROMPT_BREED, TN_PROMPT_SET, TN_PROMPT_INSERT, TN_PROMPT_EDIT, TN_PROMPT_OUT };

typedef struct tn_prompt {
    const char *dir;          /* the run's folder, in which sentences are edited; borrowed */
    tn_breed_action *actions; /* what was done; owned */
    char **texts;             /* of each; owned */
    size_t count;
    char *sentence, *edited; /* owned: of the action that was read last; the file that the editor had, or NULL */
} tn_prompt;

typedef enum prompt_answer {
    TN_PROMPT_ACTION,  /* it says what is to be done */
    TN_PROMPT_NOTHING, /* the line is empty */
    TN_PROMPT_REFUSED  /* what is wrong has been said */
} prompt_answer;

/* What a person types while breeding: the numbers of parents, `set NAME VALUE`, `insert FILE`, `out N`, `edit N` and
 * `edit N FILE`. N is a place on the sheet, or with # an id. Each line is read into an action of the question breed. */

/* ---- what is wrong */

/* Shows where a sentence cannot be derived. */
static void show_place(const char *sentence, size_t at)
{
    enum { BEFORE = 50, SHOWN = 76 };
    size_t size = strlen(sentence), begin = at > BEFORE ? at - BEFORE : 0;
    tn_write_clean(stdout, sentence + begin, size - begin < SHOWN ? size - begin : SHOWN);
    printf("\n%*s\n", (int)(at - begin) + 1, "^");
}

/* Says on standard output what is wrong, with its place in a sentence. */
static void prompt_say(const tn_diagnostic *d)
{
    if (d->input_text && d->input_column > 0)
        show_place(d->input_text, d->input_column - 1);
    puts(d->message);
    if (d->help)
        puts(d->help);
}

/* ---- sentences */

/* The sentence that a file has; false, and said, if it cannot be read. */
static bool read_sentence(tn_prompt *prompt, const char *path)
{
    uint8_t *bytes;
    size_t size;
    tn_error error;
    if (tn_file_read(path, TN_SENTENCE_FILE_MAX, &bytes, &size, &error) != TN_OK) {
        puts(error.message);
        if (error.help[0])
            puts(error.help);
        return false;
    }
    for (size_t i = 0; i < size; i++) /* a zero byte is in no sentence, and no end of one */
        bytes[i] = bytes[i] ? bytes[i] : '?';
    free(prompt->sentence);
    prompt->sentence = (char *)bytes;
    return true;
}

/* Lets the person's editor change a file; false, and said, where it ended otherwise than well. */
static bool let_edit(const char *path)
{
    const char *editor = getenv("VISUAL");
    if (!editor || !*editor)
        editor = getenv("EDITOR");
    if (!editor || !*editor) {
        puts("there is no editor: set EDITOR, or write `edit N FILE` with a file that you have edited");
        return false;
    }
    pid_t child = fork();
    if (child == 0) { /* the variable may hold options, which the shell parts */
        setenv("TARTAN_EDITED", path, 1);
        char *command = NULL;
        if (asprintf(&command, "%s \"$TARTAN_EDITED\"", editor) >= 0)
            execl("/bin/sh", "sh", "-c", command, (char *)NULL);
        _exit(127);
    }
    int state = 0;
    while (child > 0 && waitpid(child, &state, 0) < 0 && errno == EINTR)
        ;
    bool well = child > 0 && WIFEXITED(state) && WEXITSTATUS(state) == 0;
    if (!well)
        printf("the editor (%s) did not end well: nothing is changed\n", editor);
    return well;
}

/* A sentence is edited with its statements on lines of their own. */
static bool write_lines(const char *path, const char *sentence)
{
    FILE *out = fopen(path, "w");
    if (!out)
        return false;
    for (const char *at = sentence; *at;) {
        const char *end = strstr(at, " ; ");
        size_t size = end ? (size_t)(end - at) : strlen(at);
        fprintf(out, "%.*s\n", (int)size, at);
        at = end ? end + 3 : at + size;
    }
    return fclose(out) == 0;
}

/* The member at a place ("3") or with an id ("#41"), or NULL. */
static const tn_bred_member *member_of(const tn_bred *bred, const char *word)
{
    uint64_t number;
    bool by_id = word[0] == '#', read = tn_number_read(word + by_id, &number);
    for (size_t i = 0; read && i < bred->members.count; i++)
        if ((by_id ? bred->members.items[i].told.individual : i + 1) == number)
            return &bred->members.items[i];
    return NULL;
}

/* Lets the person edit a member's sentence; false, and said, if that failed. */
static bool edit_member(tn_prompt *prompt, const tn_bred *bred, const tn_bred_member *member)
{
    const char *sentence = member->told.sentence;
    char *path = NULL;
    if (asprintf(&path, "%s/edited-%" PRIu64 ".%s", prompt->dir, member->told.individual, bred->extension) < 0)
        return false;
    bool surfaces = strcmp(bred->extension, "hemls") == 0;
    FILE *plain = surfaces ? NULL : fopen(path, "w");
    bool written =
        surfaces ? write_lines(path, sentence) : plain && fprintf(plain, "%s\n", sentence) > 0 && fclose(plain) == 0;
    if (!written) {
        printf("cannot write %.200s\n", path);
        free(path);
        return false;
    }
    prompt->edited = path;
    return let_edit(path) && read_sentence(prompt, path);
}

/* ---- lines */

static bool read_insert(tn_prompt *prompt, const tn_bred *bred, char *file, tn_breed_action *action)
{
    (void)bred;
    action->file = file;
    return read_sentence(prompt, file);
}

static bool read_out(tn_prompt *prompt, const tn_bred *bred, char *word, tn_breed_action *action)
{
    (void)prompt, (void)bred;
    action->member = word;
    return true;
}

static bool read_set(tn_prompt *prompt, const tn_bred *bred, char *change, tn_breed_action *action)
{
    (void)prompt, (void)bred;
    action->change = change;
    return true;
}

/* "N" or "N FILE". Whoever is no member is refused by the question. */
static bool read_edit(tn_prompt *prompt, const tn_bred *bred, char *words, tn_breed_action *action)
{
    char *file = words + strcspn(words, " ");
    if (*file)
        *file++ = '\0';
    file += strspn(file, " ");
    action->member = words;
    action->file = *file ? file : NULL;
    const tn_bred_member *member = member_of(bred, words);
    if (!member)
        return true;
    return *file ? read_sentence(prompt, file) : edit_member(prompt, bred, member);
}

/* Reads a line, whose end is cut off: the action borrows from it and from the prompt. bred: the generation that it is
 * about. */
static prompt_answer prompt_read(tn_prompt *prompt, const tn_bred *bred, char *line, tn_breed_action *action)
{
    static const struct {
        const char *name;
        unsigned does;
        bool (*read)(tn_prompt *prompt, const tn_bred *bred, char *rest, tn_breed_action *action);
    } commands[] = {{"set ", TN_PROMPT_SET, read_set},
                    {"insert ", TN_PROMPT_INSERT, read_insert},
                    {"out ", TN_PROMPT_OUT, read_out},
                    {"edit ", TN_PROMPT_EDIT, read_edit}};
    *action = (tn_breed_action){.does = TN_PROMPT_BREED, .parents = line};
    line[strcspn(line, "\r\n")] = '\0';
    for (size_t end = strlen(line); end && line[end - 1] == ' ';)
        line[--end] = '\0';
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
        size_t size = strlen(commands[i].name);
        if (strncmp(line, commands[i].name, size) != 0)
            continue;
        *action = (tn_breed_action){.does = commands[i].does};
        bool read = commands[i].read(prompt, bred, line + size + strspn(line + size, " "), action);
        action->sentence = prompt->sentence;
        return read ? TN_PROMPT_ACTION : TN_PROMPT_REFUSED;
    }
    return line[strspn(line, " ,\t")] ? TN_PROMPT_ACTION : TN_PROMPT_NOTHING;
}

/* Ends what was read: what was edited is kept unless it is done. */
static void prompt_end(tn_prompt *prompt, bool done)
{
    if (prompt->edited && done)
        unlink(prompt->edited);
    else if (prompt->edited)
        printf("what you wrote is in %.200s\n", prompt->edited);
    free(prompt->sentence);
    free(prompt->edited);
    prompt->sentence = prompt->edited = NULL;
}

/* ---- actions */

static size_t size_of(const char *text)
{
    return text ? strlen(text) + 1 : 0;
}

/* The text at *at, which goes on behind it. */
static const char *put(const char *text, char **at)
{
    char *copy = *at;
    if (!text)
        return NULL;
    *at = stpcpy(copy, text) + 1;
    return copy;
}

/* The texts of one lie one behind another. */
static bool copy_action(const tn_breed_action *action, tn_breed_action *copy, char **texts)
{
    *texts = malloc(size_of(action->parents) + size_of(action->change) + size_of(action->sentence) +
                    size_of(action->file) + size_of(action->member) + 1);
    char *at = *texts;
    if (!at)
        return false;
    *copy = (tn_breed_action){.does = action->does,
                              .parents = put(action->parents, &at),
                              .change = put(action->change, &at),
                              .sentence = put(action->sentence, &at),
                              .file = put(action->file, &at),
                              .member = put(action->member, &at)};
    return true;
}

/* Copies the action behind those of the request; takes it back. false: out of memory. */
static bool prompt_add(tn_prompt *prompt, const tn_breed_action *action, tn_breed_request *request)
{
    size_t count = prompt->count;
    if (!tn_array_resize(&prompt->actions, count + 1, sizeof *prompt->actions) ||
        !tn_array_resize(&prompt->texts, count + 1, sizeof *prompt->texts) ||
        !copy_action(action, &prompt->actions[count], &prompt->texts[count]))
        return false;
    prompt->count++;
    request->actions.items = prompt->actions;
    request->actions.count = prompt->count;
    return true;
}

static void prompt_take_back(tn_prompt *prompt, tn_breed_request *request)
{
    free(prompt->texts[--prompt->count]);
    request->actions.count = prompt->count;
}

static void prompt_clear(tn_prompt *prompt)
{
    for (size_t i = 0; i < prompt->count; i++)
        free(prompt->texts[i]);
    free(prompt->texts);
    free(prompt->actions);
    free(prompt->sentence);
    free(prompt->edited);
    *prompt = (tn_prompt){0};
}

/* ---- the command */

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
        prompt_say(&list->items[i]);
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
    if (!prompt_add(&b->prompt, action, &b->request)) {
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
        prompt_take_back(&b->prompt, &b->request);
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
        prompt_answer typed = prompt_read(&b->prompt, told(b), line, &action);
        more = typed != TN_PROMPT_NOTHING;
        if (typed == TN_PROMPT_ACTION) {
            *failed = !act(b, &action, &done);
            more = !*failed;
        }
        prompt_end(&b->prompt, done);
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
        prompt_clear(&b.prompt);
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
