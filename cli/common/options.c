/* Reads a command line by a table of options. */
#include "cli/common/options.h"

#include <stdlib.h>
#include <string.h>

#include "compiler/common/diagnostic.h"

#define SETTINGS tn_settings
const tn_option tn_common_options[] = {
    CHOICE("diagnostics", 0, "FORM", diagnostics, "text|json",
           "how errors and warnings are written on standard error: text (default) or json"),
    NUMBER("memory-limit", 0, "MB", memory_limit, 1, 1u << 24,
           "the most memory that the command may take, in megabytes (default: half of what is free)"),
    FLAG("help", 'h', help, "show this help"),
};
const size_t tn_common_option_count = OPTION_COUNT(tn_common_options);

const tn_command *tn_command_find(const tn_commands *commands, const char *name)
{
    for (size_t i = 0; i < commands->count; i++)
        if (strcmp(commands->items[i]->name, name) == 0)
            return commands->items[i];
    return NULL;
}

/* One parse under way. */
typedef struct parse {
    const tn_commands *commands;
    const tn_command *command;
    int count;
    char **words;
    int next; /* the word after the one being read */
    tn_settings *settings;
    tn_error *error;
} parse;

size_t tn_option_total(const tn_command *command)
{
    return command->option_count + tn_common_option_count;
}

const tn_option *tn_option_at(const tn_command *command, size_t i)
{
    return i < command->option_count ? &command->options[i] : &tn_common_options[i - command->option_count];
}

static const tn_option *find_long(const tn_command *command, const char *name, size_t length)
{
    for (size_t i = 0; i < tn_option_total(command); i++) {
        const tn_option *option = tn_option_at(command, i);
        if (strlen(option->name) == length && strncmp(option->name, name, length) == 0)
            return option;
    }
    return NULL;
}

static const tn_option *find_letter(const tn_command *command, char letter)
{
    for (size_t i = 0; i < tn_option_total(command); i++)
        if (tn_option_at(command, i)->letter == letter)
            return tn_option_at(command, i);
    return NULL;
}

static tn_status see_help(parse *p, tn_status status)
{
    if (!p->error->help[0])
        tn_error_help(p->error, "`tartan help %s` lists what it takes", p->command->name);
    return status;
}

/* Names the commands that have the option: three at most. */
static void help_other_commands(parse *p, const char *word)
{
    enum { SHOWN = 3 };
    char list[160] = "";
    size_t used = 0, found = 0;
    for (size_t i = 0; i < p->commands->count; i++) {
        const tn_command *command = p->commands->items[i];
        if (!find_long(command, word, strlen(word)) || found++ >= SHOWN)
            continue;
        used += (size_t)snprintf(list + used, sizeof list - used, "%s`tartan %.30s`", used ? ", " : "", command->name);
    }
    if (found > 0)
        tn_error_help(p->error, "%s%s %s it; `tartan help %s` lists what this command takes", list,
                      found > SHOWN ? " and others" : "", found > 1 ? "have" : "has", p->command->name);
}

/* Some expect an option for how many, where a command has an operand. */
static void help_number(parse *p, const char *name)
{
    static const char *const words[] = {"n", "count", "number", "size"};
    bool taken = strncmp(p->command->usage, "FILE N", strlen("FILE N")) == 0 ||
                 strncmp(p->command->usage, "FILE [N]", strlen("FILE [N]")) == 0;
    if (!taken)
        return;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(name, words[i]) == 0)
            tn_error_help(p->error, "write how many without an option: `tartan %s FILE N`", p->command->name);
}

/* What others call an option, if the command has it. */
static const char *by_other_name(const char *const *names, size_t count, const char *word)
{
    static const char *const others[][2] = {{"min", "least"},      {"minimum", "least"}, {"minimise", "least"},
                                            {"minimize", "least"}, {"max", "most"},      {"maximum", "most"},
                                            {"maximise", "most"},  {"maximize", "most"}};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        for (size_t k = 0; k < count; k++)
            if (strcmp(others[i][0], word) == 0 && strcmp(others[i][1], names[k]) == 0)
                return names[k];
    return NULL;
}

static tn_status unknown_option(parse *p, const char *name, size_t length)
{
    tn_status status = tn_fail(p->error, TN_INVALID, E_USAGE, "`tartan %s` has no option --%.*s", p->command->name,
                               (int)(length < 80 ? length : 80), name);
    const char *names[64];
    size_t count = 0;
    for (size_t i = 0; i < tn_option_total(p->command) && count < 64; i++)
        names[count++] = tn_option_at(p->command, i)->name;
    char word[81];
    snprintf(word, sizeof word, "%.*s", (int)(length < 80 ? length : 80), name);
    const char *other = by_other_name(names, count, word), *near = other ? other : tn_nearest(word, names, count);
    for (size_t i = 0; i < count && !near && length > 0; i++) /* shortened: --lib */
        near = strncmp(names[i], word, length) == 0 ? names[i] : NULL;
    help_number(p, word);
    if (near && !p->error->help[0])
        tn_error_help(p->error, "did you mean --%s?", near);
    else if (length > 0 && !p->error->help[0])
        help_other_commands(p, word);
    return see_help(p, status);
}

static tn_status unknown_letter(parse *p, const char *letters)
{
    tn_status status =
        tn_fail(p->error, TN_INVALID, E_USAGE, "`tartan %s` has no option -%.60s", p->command->name, letters);
    if (letters[0] >= '0' && letters[0] <= '9')
        tn_error_help(p->error, "numbers here are 0 or more; an operand that begins with - goes after --");
    if (letters[0] == 'n')
        help_number(p, "n");
    return see_help(p, status);
}

static void *place_of(tn_settings *settings, const tn_option *option)
{
    return (char *)settings + option->offset;
}

bool tn_number_read(const char *text, uint64_t *value)
{
    if (!*text || strspn(text, "0123456789") != strlen(text) || strlen(text) > 20)
        return false;
    uint64_t sum = 0;
    for (; *text; text++) {
        uint64_t digit = (uint64_t)(*text - '0');
        if (__builtin_mul_overflow(sum, 10u, &sum) || __builtin_add_overflow(sum, digit, &sum))
            return false;
    }
    *value = sum;
    return true;
}

static uint64_t most(const tn_option *option)
{
    return option->high ? option->high : UINT64_MAX;
}

static bool within(const tn_option *option, uint64_t value)
{
    return value >= option->low && value <= most(option);
}

static tn_status bad_number(parse *p, const tn_option *option, const char *text, const char *what)
{
    return tn_fail(p->error, TN_INVALID, E_USAGE, "--%s takes %s from %llu to %llu, not `%.60s`", option->name, what,
                   (unsigned long long)option->low, (unsigned long long)most(option), text);
}

static tn_status set_number(parse *p, const tn_option *option, const char *text)
{
    tn_option_number *number = place_of(p->settings, option);
    if (!tn_number_read(text, &number->value) || !within(option, number->value))
        return bad_number(p, option, text, "a number");
    number->given = true;
    return TN_OK;
}

/* `2-4`, `2:4`, `2,4`: is it two numbers with something else between? */
static tn_status bad_range(parse *p, const tn_option *option, const char *text)
{
    size_t first = strspn(text, "0123456789"), between = strcspn(text + first, "0123456789");
    size_t last = strspn(text + first + between, "0123456789");
    tn_status status = bad_number(p, option, text, "a range a..b");
    if (first > 0 && between > 0 && last > 0 && text[first + between + last] == '\0')
        tn_error_help(p->error, "a range is written with two dots: --%s %.*s..%.40s", option->name, (int)first, text,
                      text + first + between);
    return status;
}

static tn_status set_range(parse *p, const tn_option *option, const char *text)
{
    tn_option_range *range = place_of(p->settings, option);
    char low[32];
    const char *dots = strstr(text, "..");
    size_t length = dots ? (size_t)(dots - text) : strlen(text);
    snprintf(low, sizeof low, "%.*s", (int)(length < sizeof low ? length : sizeof low - 1), text);
    if (length >= sizeof low || !tn_number_read(low, &range->low) || !within(option, range->low) ||
        !tn_number_read(dots ? dots + 2 : low, &range->high) || !within(option, range->high))
        return bad_range(p, option, text);
    if (range->low > range->high) {
        tn_status status = tn_fail(p->error, TN_INVALID, E_USAGE, "the range --%s %.60s is empty", option->name, text);
        tn_error_help(p->error, "write the smaller number first: %llu..%llu", (unsigned long long)range->high,
                      (unsigned long long)range->low);
        return status;
    }
    range->given = true;
    return TN_OK;
}

static tn_status set_rank(parse *p, const tn_option *option, const char *text)
{
    if (!*text || strspn(text, "0123456789") != strlen(text))
        return tn_fail(p->error, TN_INVALID, E_USAGE, "--%s takes a rank, a whole number from 0, not `%.60s`",
                       option->name, text);
    *(const char **)place_of(p->settings, option) = text;
    return TN_OK;
}

/* Does the word `text` stand at `choice` in a list "a|b|c"? Returns the index, or -1. */
static int choice_index(const char *choices, const char *text)
{
    size_t length = strlen(text);
    int index = 0;
    for (const char *at = choices; at; index++) {
        const char *bar = strchr(at, '|');
        size_t size = bar ? (size_t)(bar - at) : strlen(at);
        if (size == length && strncmp(at, text, length) == 0)
            return index;
        at = bar ? bar + 1 : NULL;
    }
    return -1;
}

static tn_status set_choice(parse *p, const tn_option *option, const char *text)
{
    int index = choice_index(option->choices, text);
    if (index < 0) {
        char list[160] = "";
        size_t used = 0;
        for (const char *c = option->choices; *c && used + 8 < sizeof list; c++)
            used += (size_t)snprintf(list + used, sizeof list - used, *c == '|' ? ", " : "%c", *c);
        return tn_fail(p->error, TN_INVALID, E_USAGE, "--%s takes one of %s, not `%.60s`", option->name, list, text);
    }
    *(int *)place_of(p->settings, option) = index;
    return TN_OK;
}

static tn_status set_maybe(parse *p, const tn_option *option, const char *text)
{
    tn_status status = text ? set_choice(p, option, text) : TN_OK;
    *(int *)place_of(p->settings, option) += 1;
    return status;
}

static tn_status set_real(parse *p, const tn_option *option, const char *text)
{
    tn_option_real *real = place_of(p->settings, option);
    char *end;
    real->value = strtod(text, &end);
    if (end == text || *end || !(real->value > -1e9 && real->value < 1e9))
        return tn_fail(p->error, TN_INVALID, E_USAGE, "--%s takes a number, not `%.60s`", option->name, text);
    real->given = true;
    return TN_OK;
}

static tn_status given_twice(parse *p, const tn_option *option, const char *first, const char *second)
{
    tn_status status =
        tn_fail(p->error, TN_INVALID, E_USAGE, "--%s is given twice: `%.60s` and `%.60s`", option->name, first, second);
    tn_error_help(p->error, "`tartan %s` takes one; run it once for each", p->command->name);
    return status;
}

/* A file's name, and any other text but that: empty ones are what a variable of a script without a value gives. */
static tn_status set_text(parse *p, const tn_option *option, const char *text)
{
    const char **place = place_of(p->settings, option);
    static const char *const names[] = {"FILE", "FOLDER", "DIR", "NAME", "HOW"};
    for (size_t i = 0; i < OPTION_COUNT(names) && !*text; i++)
        if (strcmp(option->argument, names[i]) == 0)
            return tn_fail(p->error, TN_INVALID, E_USAGE, "--%s needs its argument %s, which is empty here",
                           option->name, option->argument);
    if (*place && strcmp(*place, text) != 0)
        return given_twice(p, option, *place, text);
    *place = text;
    return TN_OK;
}

/* Lists have room for every word of the command line, and for the name of an option before it. */
static tn_status list_add(parse *p, tn_option_list *list, const char *text)
{
    if (!list->items)
        list->items = malloc(sizeof *list->items * 2 * (size_t)(p->count + 1));
    if (!list->items)
        return tn_fail_memory(p->error);
    list->items[list->count++] = text;
    return TN_OK;
}

static tn_status set_option(parse *p, const tn_option *option, const char *text)
{
    switch (option->kind) {
    case TN_OPTION_FLAG:
        *(bool *)place_of(p->settings, option) = true;
        return TN_OK;
    case TN_OPTION_TEXT:
        return set_text(p, option, text);
    case TN_OPTION_LIST:
        return list_add(p, place_of(p->settings, option), text);
    case TN_OPTION_WISH: {
        tn_option_list *list = place_of(p->settings, option);
        tn_status status = list_add(p, list, option->name);
        return status == TN_OK ? list_add(p, list, text) : status;
    }
    case TN_OPTION_NUMBER:
        return set_number(p, option, text);
    case TN_OPTION_RANGE:
        return set_range(p, option, text);
    case TN_OPTION_RANK:
        return set_rank(p, option, text);
    case TN_OPTION_CHOICE:
        return set_choice(p, option, text);
    case TN_OPTION_MAYBE:
        return set_maybe(p, option, text);
    case TN_OPTION_REAL:
        return set_real(p, option, text);
    }
    return tn_fail(p->error, TN_INTERNAL, TN_CODE_NONE, "option --%s has a kind that is not known", option->name);
}

/* Is this word one of the command's options: "-o", "--output" or "--output=FILE"? */
static bool is_option(const tn_command *command, const char *word)
{
    if (word[0] != '-' || !word[1])
        return false;
    return word[1] == '-' ? find_long(command, word + 2, strcspn(word + 2, "=")) != NULL
                          : !word[2] && find_letter(command, word[1]);
}

static tn_status lacks_argument(parse *p, const tn_option *option, const char *next)
{
    tn_status status =
        tn_fail(p->error, TN_INVALID, E_USAGE, "--%s needs its argument %s%s%.60s%s", option->name, option->argument,
                next ? ", but the option " : "", next ? next : "", next ? " follows" : "");
    tn_error_help(p->error, "--%s %s: %s", option->name, option->argument, option->help);
    return status;
}

/* The option's argument: `inline_text` if there was one, otherwise the next word. */
static tn_status set_from_words(parse *p, const tn_option *option, const char *inline_text)
{
    if (!option->argument && inline_text)
        return tn_fail(p->error, TN_INVALID, E_USAGE, "--%s takes no argument", option->name);
    bool may_lack = option->kind == TN_OPTION_MAYBE;
    if (may_lack && !inline_text) { /* the next word only where it is one of the choices */
        if (p->next < p->count && choice_index(option->choices, p->words[p->next]) >= 0)
            inline_text = p->words[p->next++];
    } else if (option->argument && !inline_text) {
        const char *next = p->next < p->count ? p->words[p->next] : NULL;
        if (!next || is_option(p->command, next))
            return lacks_argument(p, option, next);
        inline_text = p->words[p->next++];
    }
    return set_option(p, option, inline_text);
}

static tn_status read_long(parse *p, const char *word)
{
    const char *equals = strchr(word, '=');
    size_t length = equals ? (size_t)(equals - word) : strlen(word);
    const tn_option *option = find_long(p->command, word, length);
    if (!option)
        return unknown_option(p, word, length);
    return see_help(p, set_from_words(p, option, equals ? equals + 1 : NULL));
}

/* "-o FILE", "-oFILE", and flags in a cluster. */
static tn_status read_letters(parse *p, const char *letters)
{
    for (; *letters; letters++) {
        const tn_option *option = find_letter(p->command, *letters);
        if (!option)
            return unknown_letter(p, letters);
        if (option->argument)
            return see_help(p, set_from_words(p, option, letters[1] ? letters + 1 : NULL));
        tn_status status = set_from_words(p, option, NULL);
        if (status != TN_OK)
            return status;
    }
    return TN_OK;
}

/* All forms of the command: "tartan check FILE..., or tartan check FILE --relations". */
static void help_usage(parse *p)
{
    char forms[sizeof p->error->help] = "";
    size_t used = 0;
    for (const char *at = p->command->usage; *at && used < sizeof forms;) {
        int size = (int)strcspn(at, "\n");
        used += (size_t)snprintf(forms + used, sizeof forms - used, "%startan %s %.*s", used ? ", or " : "",
                                 p->command->name, size, at);
        at += size + (at[size] == '\n');
    }
    tn_error_help(p->error, "%s", forms);
}

static tn_status check_operands(parse *p)
{
    size_t count = p->settings->operands.count;
    if (count < p->command->operands_min) {
        tn_status status =
            tn_fail(p->error, TN_INVALID, E_USAGE, "`tartan %s` needs %s", p->command->name, p->command->operands);
        help_usage(p);
        return status;
    }
    if (count > p->command->operands_max) {
        tn_status status =
            tn_fail(p->error, TN_INVALID, E_USAGE, "`tartan %s` takes %s; `%.60s` is one too many", p->command->name,
                    p->command->operands, p->settings->operands.items[p->command->operands_max]);
        return see_help(p, status);
    }
    return TN_OK;
}

/* ---- names of files */

static tn_status disagrees(parse *p, const char *word, const char *path)
{
    tn_status status =
        tn_fail(p->error, TN_INVALID, E_USAGE, "--format %s is not what %.200s is the name of", word, path);
    tn_error_help(p->error, "leave out --format, or give the name another ending");
    return status;
}

/* The word of a choice that was made, as in the command's table. */
static const char *chosen_word(const tn_option *option, int index, char *word, size_t size)
{
    const char *at = option->choices;
    for (; index > 0; index--)
        at = strchr(at, '|') + 1;
    snprintf(word, size, "%.*s", (int)strcspn(at, "|"), at);
    return word;
}

/* What the ending promises is written, where the command has a choice of formats; one that says otherwise is wrong. */
static tn_status take_format(parse *p, const char *path, tn_file_format format)
{
    char chosen[32];
    const char *word = tn_file_format_word(format);
    const tn_option *json = find_long(p->command, "json", strlen("json")),
                    *choice = find_long(p->command, "format", strlen("format"));
    if (json && json->kind == TN_OPTION_FLAG && format == TN_FILE_JSON)
        *(bool *)place_of(p->settings, json) = true;
    if (!choice || format == TN_FILE_OTHER || choice->kind != TN_OPTION_CHOICE)
        return TN_OK;
    int *index = place_of(p->settings, choice), of_ending = choice_index(choice->choices, word);
    if (*index == 0 && of_ending > 0)
        *index = of_ending;
    if (*index == 0 || *index == of_ending)
        return TN_OK;
    return disagrees(p, chosen_word(choice, *index, chosen, sizeof chosen), path);
}

static tn_status check_file(parse *p, const tn_option *option, const char *path)
{
    char what[80];
    const tn_option *choice = find_long(p->command, "format", strlen("format"));
    bool said = choice && tn_option_given(choice, p->settings);
    snprintf(what, sizeof what, "the output of `tartan %.40s`", p->command->name);
    tn_status status = tn_file_ending_check(what, path, option->writes | (said ? TN_WRITES_ASKED : 0), p->error);
    return status == TN_OK && strcmp(path, "-") != 0 ? take_format(p, path, tn_file_format_of(path)) : status;
}

/* The files that are to be written. */
static tn_status check_files(parse *p)
{
    tn_status status = TN_OK;
    for (size_t i = 0; status == TN_OK && i < p->command->option_count; i++) {
        const tn_option *option = &p->command->options[i];
        if (!option->writes || !tn_option_given(option, p->settings))
            continue;
        if (option->kind == TN_OPTION_TEXT) {
            status = check_file(p, option, *(const char **)place_of(p->settings, option));
            continue;
        }
        const tn_option_list *list = place_of(p->settings, option);
        for (size_t k = 0; status == TN_OK && k < list->count; k++)
            status = check_file(p, option, list->items[k]);
    }
    return status;
}

tn_status tn_options_parse(const tn_commands *commands, const tn_command *command, int count, char **words,
                           tn_settings *settings, tn_error *error)
{
    parse p = {commands, command, count, words, 0, settings, error};
    bool options = true;
    *error = (tn_error){.code_offset = TN_NO_OFFSET};
    while (p.next < count) {
        const char *word = words[p.next++];
        tn_status status;
        if (options && strcmp(word, "--") == 0) {
            options = false;
            continue;
        }
        if (options && strncmp(word, "--", 2) == 0)
            status = read_long(&p, word + 2);
        else if (options && word[0] == '-' && word[1] &&
                 word[1] != ' ') /* "- 4'" is a plan that starts with an unset flag */
            status = read_letters(&p, word + 1);
        else
            status = list_add(&p, &settings->operands, word);
        if (status != TN_OK)
            return status;
    }
    if (settings->help)
        return TN_OK;
    tn_status status = check_operands(&p);
    return status == TN_OK ? check_files(&p) : status;
}

int tn_options_diagnostics(int count, char *const *words)
{
    static const char name[] = "--diagnostics";
    const tn_option *option = &tn_common_options[0];
    int found = 0;
    for (int i = 0; i < count && strcmp(words[i], "--") != 0; i++) {
        const char *rest = strncmp(words[i], name, sizeof name - 1) == 0 ? words[i] + sizeof name - 1 : "?";
        const char *value = *rest == '=' ? rest + 1 : !*rest && i + 1 < count ? words[i + 1] : "";
        int index = choice_index(option->choices, value);
        found = index < 0 ? found : index;
    }
    return found;
}

tn_settings *tn_settings_new(const tn_command *command)
{
    tn_settings *settings = calloc(1, command->settings_size);
    if (settings)
        settings->command = command;
    return settings;
}

void tn_settings_free(const tn_command *command, tn_settings *settings)
{
    if (!settings)
        return;
    free(settings->operands.items);
    for (size_t i = 0; i < command->option_count; i++) {
        const tn_option *option = &command->options[i];
        if (option->kind == TN_OPTION_LIST || option->kind == TN_OPTION_WISH) {
            tn_option_list *list = place_of(settings, option);
            free(list->items);
            *list = (tn_option_list){0}; /* several options may add to one list */
        }
    }
    free(settings);
}

bool tn_option_given(const tn_option *option, const tn_settings *settings)
{
    const void *field = (const char *)settings + option->offset;
    switch (option->kind) {
    case TN_OPTION_FLAG:
        return *(const bool *)field;
    case TN_OPTION_TEXT:
    case TN_OPTION_RANK:
        return *(const char *const *)field != NULL;
    case TN_OPTION_LIST:
    case TN_OPTION_WISH:
        return ((const tn_option_list *)field)->count > 0;
    case TN_OPTION_NUMBER:
        return ((const tn_option_number *)field)->given;
    case TN_OPTION_RANGE:
        return ((const tn_option_range *)field)->given;
    case TN_OPTION_REAL:
        return ((const tn_option_real *)field)->given;
    case TN_OPTION_CHOICE:
    case TN_OPTION_MAYBE:
        return *(const int *)field != 0;
    }
    return false;
}

const char *tn_settings_output(const tn_settings *settings)
{
    const tn_command *command = settings->command;
    const char *output = NULL;
    for (size_t i = 0; command && i < command->option_count; i++) {
        const tn_option *option = &command->options[i];
        if (option->kind == TN_OPTION_TEXT && strcmp(option->name, "output") == 0)
            memcpy(&output, (const char *)settings + option->offset, sizeof output);
    }
    return output;
}
