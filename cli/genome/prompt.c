/* Reads what a person types while breeding: parents, changes of the run, and individuals inserted, edited and taken
 * out.
 */
#include "cli/genome/prompt.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/common/options.h"
#include "driver/breed/evolve.h"
#include "runtime/base/array.h"
#include "runtime/base/file.h"
#include "runtime/base/utf8.h"

/* ---- what is wrong */

/* Shows where a sentence cannot be derived. */
static void show_place(const char *sentence, size_t at)
{
    enum { BEFORE = 50, SHOWN = 76 };
    size_t size = strlen(sentence), begin = at > BEFORE ? at - BEFORE : 0;
    tn_write_clean(stdout, sentence + begin, size - begin < SHOWN ? size - begin : SHOWN);
    printf("\n%*s\n", (int)(at - begin) + 1, "^");
}

void tn_prompt_say(const tn_diagnostic *d)
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

tn_prompt_answer tn_prompt_read(tn_prompt *prompt, const tn_bred *bred, char *line, tn_breed_action *action)
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

void tn_prompt_end(tn_prompt *prompt, bool done)
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

bool tn_prompt_add(tn_prompt *prompt, const tn_breed_action *action, tn_breed_request *request)
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

void tn_prompt_take_back(tn_prompt *prompt, tn_breed_request *request)
{
    free(prompt->texts[--prompt->count]);
    request->actions.count = prompt->count;
}

void tn_prompt_clear(tn_prompt *prompt)
{
    for (size_t i = 0; i < prompt->count; i++)
        free(prompt->texts[i]);
    free(prompt->texts);
    free(prompt->actions);
    free(prompt->sentence);
    free(prompt->edited);
    *prompt = (tn_prompt){0};
}
