/* Does what a person types while breeding: changes of the run, and individuals inserted, edited and taken out. */
#include "cli/genome/prompt.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "runtime/base/file.h"
#include "runtime/base/utf8.h"

static void say(const tn_error *error)
{
    puts(error->message);
    if (error->help[0])
        puts(error->help);
}

static tn_prompt_answer answer_of(tn_status status, const tn_error *error)
{
    if (status != TN_OK)
        say(error);
    return status == TN_OK ? TN_PROMPT_DONE : TN_PROMPT_REFUSED;
}

/* ---- individuals */

/* The member at a place ("3") or with an id ("#41"); NULL, and said, where there is none. */
static const tn_individual *member_of(const tn_evolving *e, const char *word)
{
    size_t count;
    uint64_t number;
    const tn_individual *const *members = tn_evolution_members(e->run.evolution, &count);
    bool by_id = word[0] == '#', read = tn_number_read(word + by_id, &number);
    for (size_t i = 0; read && i < count; i++)
        if (by_id ? members[i]->id == number : i + 1 == number)
            return members[i];
    printf("`%.40s` is nobody here: write a number from 1 to %zu, or # and the id of one on the sheet\n", word, count);
    return NULL;
}

/* Shows where a sentence cannot be derived. */
static void show_place(const char *sentence, const tn_error *error)
{
    enum { BEFORE = 50, SHOWN = 76 };
    size_t at = error->column - 1, size = strlen(sentence), begin = at > BEFORE ? at - BEFORE : 0;
    tn_write_clean(stdout, sentence + begin, size - begin < SHOWN ? size - begin : SHOWN);
    printf("\n%*s\n", (int)(at - begin) + 1, "^");
}

/* Inserts a sentence in the place of `member`, or of the worst (NULL). */
static tn_prompt_answer insert_text(tn_evolving *e, const tn_individual *member, const char *text, size_t size)
{
    tn_genome genome = {0};
    tn_error error = {0};
    char *sentence, *event = NULL;
    uint64_t out = member ? member->id : TN_NO_PARENT;
    tn_by_hand_language language = tn_evolution_job_language(&e->job);
    tn_status status = tn_by_hand_genome(&language, text, size, &genome, &sentence, &error);
    if (status != TN_OK && sentence && error.line && error.column <= strlen(sentence))
        show_place(sentence, &error);
    if (status == TN_OK && !(event = tn_by_hand_text(out, &genome)))
        status = tn_fail_memory(&error);
    if (status == TN_OK)
        status = tn_run_by_hand(&e->run, member ? "edit" : "insert", event, &error);
    free(event);
    free(sentence);
    tn_genome_clear(&genome);
    return answer_of(status, &error);
}

static tn_prompt_answer insert_file(tn_evolving *e, const tn_individual *member, const char *path)
{
    uint8_t *bytes;
    size_t size;
    tn_error error;
    if (tn_file_read(path, TN_SENTENCE_FILE_MAX, &bytes, &size, &error) != TN_OK)
        return answer_of(TN_INVALID, &error);
    tn_prompt_answer answer = insert_text(e, member, (const char *)bytes, size);
    free(bytes);
    return answer;
}

/* ---- editing */

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

static tn_prompt_answer edit_member(tn_evolving *e, const tn_individual *member)
{
    char *path = NULL;
    if (asprintf(&path, "%s/edited-%" PRIu64 ".%s", e->run.dir, member->id, e->job.extension) < 0)
        return TN_PROMPT_REFUSED;
    tn_prompt_answer answer = TN_PROMPT_REFUSED;
    bool surfaces = strcmp(e->job.extension, "hemls") == 0;
    FILE *plain = surfaces ? NULL : fopen(path, "w");
    bool written = surfaces ? write_lines(path, member->sentence)
                            : plain && fprintf(plain, "%s\n", member->sentence) > 0 && fclose(plain) == 0;
    if (!written)
        printf("cannot write %.200s\n", path);
    else if (let_edit(path))
        answer = insert_file(e, member, path);
    if (written && answer == TN_PROMPT_REFUSED)
        printf("what you wrote is in %.200s\n", path);
    else
        unlink(path);
    free(path);
    return answer;
}

/* "N" or "N FILE" */
static tn_prompt_answer edit(tn_evolving *e, char *words)
{
    char *file = words + strcspn(words, " ");
    if (*file)
        *file++ = '\0';
    file += strspn(file, " ");
    const tn_individual *member = member_of(e, words);
    if (!member)
        return TN_PROMPT_REFUSED;
    return *file ? insert_file(e, member, file) : edit_member(e, member);
}

static tn_prompt_answer take_out(tn_evolving *e, char *word)
{
    char id[24];
    tn_error error;
    const tn_individual *member = member_of(e, word);
    if (!member)
        return TN_PROMPT_REFUSED;
    snprintf(id, sizeof id, "%" PRIu64, member->id);
    return answer_of(tn_run_by_hand(&e->run, "remove", id, &error), &error);
}

static tn_prompt_answer insert(tn_evolving *e, char *path)
{
    return insert_file(e, NULL, path);
}

static tn_prompt_answer set(tn_evolving *e, char *change)
{
    tn_error error;
    return answer_of(tn_run_set(&e->run, change, &error), &error);
}

tn_prompt_answer tn_prompt_do(tn_evolving *session, char *line)
{
    static const struct {
        const char *name;
        tn_prompt_answer (*does)(tn_evolving *session, char *rest);
    } commands[] = {{"set ", set}, {"insert ", insert}, {"out ", take_out}, {"edit ", edit}};
    line[strcspn(line, "\r\n")] = '\0';
    for (size_t end = strlen(line); end && line[end - 1] == ' ';)
        line[--end] = '\0';
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
        size_t size = strlen(commands[i].name);
        if (strncmp(line, commands[i].name, size) == 0)
            return commands[i].does(session, line + size + strspn(line + size, " "));
    }
    return TN_PROMPT_NOT_A_COMMAND;
}
