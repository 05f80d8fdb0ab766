/* Translates parameter files of PonyGE2. */
#include "driver/ponyge/ponyge.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "runtime/base/file.h"

/* How a parameter becomes a setting. */
typedef enum manner {
    NUMBER,  /* as it is */
    FILE_OF, /* a path, quoted */
    TEXT,    /* quoted */
    WORD,    /* the operator's word, by the list */
    PART     /* read where another parameter is */
} manner;

/* One is chosen by the last part of its name: "operators.crossover.subtree" is "subtree". */
typedef struct choice {
    const char *theirs, *ours;
} choice;

static const choice initialisations[] = {
    {"PI_grow", "pi-grow"}, {"rhh", "ramped"}, {"uniform_tree", "grow"}, {"uniform_genome", "random"}, {0}};
static const choice crossovers[] = {{"variable_onepoint", "one-point"},
                                    {"fixed_onepoint", "fixed-one-point"},
                                    {"variable_twopoint", "two-point"},
                                    {"fixed_twopoint", "fixed-two-point"},
                                    {"subtree", "subtree"},
                                    {0}};
static const choice mutations[] = {
    {"int_flip_per_codon", "codons"}, {"int_flip_per_ind", "genome"}, {"subtree", "subtree"}, {0}};
static const choice selections[] = {
    {"tournament", "tournament"}, {"truncation", "truncation"}, {"nsga2_selection", "nsga2"}, {0}};
static const choice replacements[] = {
    {"generational", "generational"}, {"steady_state", "steady-state"}, {"nsga2_replacement", "generational"}, {0}};
static const choice errors[] = {
    {"rmse", "rmse"}, {"mse", "mse"}, {"mae", "mae"}, {"Rsquared", "r2"}, {"inverse_f1_score", "f1"}, {0}};
static const choice points[] = {{"True", "used"}, {"False", "anywhere"}, {0}};

/* `number` is the parameter whose value stands behind the word. */
static const struct {
    const char *name;
    manner manner;
    const char *setting;
    const choice *choices;
    const char *number, *folder;
} rows[] = {
    {"GRAMMAR_FILE", FILE_OF, "grammar", NULL, NULL, "grammars"},
    {"DATASET_TRAIN", FILE_OF, "fit", NULL, NULL, "datasets"},
    {"DATASET_TEST", FILE_OF, "test", NULL, NULL, "datasets"},
    {"TARGET", TEXT, "match", NULL, NULL, NULL},
    {"ERROR_METRIC", WORD, "error", errors, NULL, NULL},
    {"POPULATION_SIZE", NUMBER, "population", NULL, NULL, NULL},
    {"GENERATIONS", NUMBER, "generations", NULL, NULL, NULL},
    {"RANDOM_SEED", NUMBER, "seed", NULL, NULL, NULL},
    {"ELITE_SIZE", NUMBER, "elites", NULL, NULL, NULL},
    {"CODON_SIZE", NUMBER, "codon-limit", NULL, NULL, NULL},
    {"INIT_GENOME_LENGTH", NUMBER, "codons", NULL, NULL, NULL},
    {"MAX_GENOME_LENGTH", NUMBER, "max-codons", NULL, NULL, NULL},
    {"MAX_TREE_DEPTH", NUMBER, "max-depth", NULL, NULL, NULL},
    {"MAX_WRAPS", NUMBER, "wraps", NULL, NULL, NULL},
    {"INITIALISATION", WORD, "initialise", initialisations, NULL, NULL},
    {"CROSSOVER", WORD, "crossover", crossovers, "CROSSOVER_PROBABILITY", NULL},
    {"MUTATION", WORD, "mutation", mutations, NULL, NULL},
    {"SELECTION", WORD, "selection", selections, "", NULL},
    {"REPLACEMENT", WORD, "replacement", replacements, NULL, NULL},
    {"WITHIN_USED", WORD, "points", points, NULL, NULL},
    {"MAX_INIT_TREE_DEPTH", PART, NULL, NULL, NULL, NULL},
    {"MIN_INIT_TREE_DEPTH", PART, NULL, NULL, NULL, NULL},
    {"CROSSOVER_PROBABILITY", PART, NULL, NULL, NULL, NULL},
    {"MUTATION_PROBABILITY", PART, NULL, NULL, NULL, NULL},
    {"MUTATION_EVENTS", PART, NULL, NULL, NULL, NULL},
    {"TOURNAMENT_SIZE", PART, NULL, NULL, NULL, NULL},
    {"SELECTION_PROPORTION", PART, NULL, NULL, NULL, NULL},
    {"FITNESS_FUNCTION", PART, NULL, NULL, NULL, NULL},
};

#define ROWS (sizeof rows / sizeof *rows)

typedef struct parameter {
    char *name, *value; /* in the copy of the text */
    size_t line;
} parameter;

#define PARAMETERS_MAX 500u

typedef struct translation {
    const char *path;
    char *copy;
    parameter items[PARAMETERS_MAX];
    size_t count;
    FILE *study, *ignored;
    bool any_ignored;
    tn_error *error;
} translation;

__attribute__((format(printf, 5, 6))) static tn_status wrong(translation *t, size_t line, tn_code code,
                                                             const char *help, const char *what, ...)
{
    char message[200];
    va_list arguments;
    va_start(arguments, what);
    vsnprintf(message, sizeof message, what, arguments);
    va_end(arguments);
    tn_fail(t->error, TN_INVALID, code, "%s", message);
    tn_error_place(t->error, line, 1, 1);
    tn_error_help(t->error, "%s", help);
    return TN_INVALID;
}

static char *trimmed(char *text)
{
    while (isspace((unsigned char)*text))
        text++;
    for (char *end = text + strlen(text); end > text && isspace((unsigned char)end[-1]);)
        *--end = '\0';
    return text;
}

/* `NAME: value` on each line; `#` begins a comment. */
static tn_status read_parameters(translation *t)
{
    size_t number = 0;
    for (char *line = t->copy, *next; line; line = next) {
        next = strchr(line, '\n');
        if (next)
            *next++ = '\0';
        number++;
        line[strcspn(line, "#")] = '\0';
        char *name = trimmed(line), *colon = strchr(name, ':');
        if (!*name)
            continue;
        if (!colon)
            return wrong(t, number, E_EVOLUTION_SETTING,
                         "parameters are written `POPULATION_SIZE: 500`, one a line; a study needs no --ponyge",
                         "`%.60s` is no parameter of PonyGE2", name);
        if (t->count == PARAMETERS_MAX)
            return wrong(t, number, E_EVOLUTION_SETTING, "leave some out", "there are more than %u parameters",
                         PARAMETERS_MAX);
        *colon = '\0';
        t->items[t->count++] = (parameter){trimmed(name), trimmed(colon + 1), number};
    }
    return TN_OK;
}

static const parameter *find(const translation *t, const char *name)
{
    const parameter *found = NULL;
    for (size_t i = 0; i < t->count; i++)
        if (strcmp(t->items[i].name, name) == 0)
            found = &t->items[i];
    return found && found->value[0] && strcmp(found->value, "None") != 0 ? found : NULL;
}

static void ignore(translation *t, const char *name)
{
    fprintf(t->ignored, "%s%s", t->any_ignored ? ", " : "", name);
    t->any_ignored = true;
}

/* ---- values */

static bool is_number(const char *text)
{
    char *end;
    strtod(text, &end);
    return end > text && !*end && strspn(text, "0123456789.eE+-") == strlen(text);
}

static void write_quoted(FILE *out, const char *text)
{
    fputc('"', out);
    for (; *text; text++) {
        if (*text == '"' || *text == '\\')
            fputc('\\', out);
        fputc(*text, out);
    }
    fputc('"', out);
}

/* The file beside the parameters, in the folder beside theirs, or in that within theirs: the first that is there, as a
 * path from the folder of the parameters. NULL where out of memory. */
static char *find_file(const translation *t, const char *folder, const char *value)
{
    char *tries[3] = {strdup(value), NULL, NULL}, *found = NULL;
    if (asprintf(&tries[1], "../%s/%s", folder, value) < 0)
        tries[1] = NULL;
    if (asprintf(&tries[2], "%s/%s", folder, value) < 0)
        tries[2] = NULL;
    for (size_t i = 0; i < 3 && !found; i++) {
        char *whole = tries[i] ? tn_file_beside(t->path, tries[i]) : NULL;
        if (whole && access(whole, R_OK) == 0)
            found = strdup(tries[i]);
        free(whole);
    }
    if (!found && tries[0])
        found = strdup(tries[0]);
    for (size_t i = 0; i < 3; i++)
        free(tries[i]);
    return found;
}

static tn_status write_file(translation *t, const parameter *p, const char *setting, const char *folder)
{
    char *path = find_file(t, folder, p->value);
    if (!path)
        return tn_fail_memory(t->error);
    fprintf(t->study, "  %s ", setting);
    write_quoted(t->study, path);
    fputc('\n', t->study);
    free(path);
    return TN_OK;
}

static tn_status write_word(translation *t, const parameter *p, size_t row)
{
    const char *dot = strrchr(p->value, '.'), *word = dot ? dot + 1 : p->value;
    const choice *c = rows[row].choices;
    while (c->theirs && strcasecmp(c->theirs, word) != 0)
        c++;
    if (!c->theirs)
        return wrong(t, p->line, E_EVOLUTION_VALUE,
                     "leave the line out, or write a study: docs/evolution.md lists all settings",
                     "`%.80s` has no counterpart here", p->value);
    fprintf(t->study, "  %s %s", rows[row].setting, c->ours);
    const char *name = rows[row].number;
    if (name && !*name)
        name = strcmp(c->ours, "truncation") == 0 ? "SELECTION_PROPORTION" : "TOURNAMENT_SIZE";
    if (strcmp(rows[row].name, "MUTATION") == 0)
        name = strcmp(c->ours, "codons") == 0   ? "MUTATION_PROBABILITY"
               : strcmp(c->ours, "genome") == 0 ? "MUTATION_EVENTS"
                                                : NULL;
    const parameter *number = name ? find(t, name) : NULL;
    if (number && is_number(number->value))
        fprintf(t->study, " %s", number->value);
    fputc('\n', t->study);
    return TN_OK;
}

/* The fitness functions that are problems of ours. Without one, what the parameters name says which it is. */
static bool is_function(const parameter *goal, const char *const *names)
{
    while (*names && strcmp(*names, goal->value) != 0)
        names++;
    return *names != NULL;
}

static const char *const matching[] = {"string_match", NULL};
static const char *const fitting[] = {"supervised_learning.regression",
                                      "supervised_learning.classification",
                                      "supervised_learning.supervised_learning",
                                      "regression",
                                      "classification",
                                      NULL};

static bool matches_text(const translation *t)
{
    const parameter *goal = find(t, "FITNESS_FUNCTION");
    return goal ? is_function(goal, matching) : find(t, "TARGET") && !find(t, "DATASET_TRAIN");
}

static tn_status write_parameter(translation *t, size_t row)
{
    const parameter *p = find(t, rows[row].name);
    if (!p)
        return TN_OK;
    bool matches = matches_text(t);
    switch (rows[row].manner) {
    case NUMBER:
        if (!is_number(p->value))
            return wrong(t, p->line, E_EVOLUTION_VALUE, "write a number, as 500", "`%.60s` is no number", p->value);
        fprintf(t->study, "  %s %s\n", rows[row].setting, p->value);
        return TN_OK;
    case FILE_OF:
        if (matches && strcmp(rows[row].folder, "datasets") == 0) {
            ignore(t, p->name);
            return TN_OK;
        }
        return write_file(t, p, rows[row].setting, rows[row].folder);
    case TEXT:
        if (!matches) {
            ignore(t, p->name);
            return TN_OK;
        }
        fprintf(t->study, "  %s ", rows[row].setting);
        write_quoted(t->study, p->value);
        fputc('\n', t->study);
        return TN_OK;
    case WORD:
        if (rows[row].choices == errors && matches) {
            ignore(t, p->name);
            return TN_OK;
        }
        return write_word(t, p, row);
    case PART:
        return TN_OK;
    }
    return TN_OK;
}

static void write_depth(translation *t)
{
    const parameter *low = find(t, "MIN_INIT_TREE_DEPTH"), *high = find(t, "MAX_INIT_TREE_DEPTH");
    if (high && is_number(high->value))
        fprintf(t->study, "  depth %s..%s\n",
                low && is_number(low->value) ? low->value
                : atoi(high->value) > 1      ? "2"
                                             : "1",
                high->value);
}

static tn_status check_goal(translation *t)
{
    static const char help[] = "data to fit (DATASET_TRAIN) and a text to match (TARGET) are read";
    const parameter *goal = find(t, "FITNESS_FUNCTION");
    if (goal && !is_function(goal, matching) && !is_function(goal, fitting))
        return wrong(t, goal->line, E_EVOLUTION_VALUE, help,
                     "the fitness function `%.80s` is a Python program, which is not run here", goal->value);
    if (find(t, matches_text(t) ? "TARGET" : "DATASET_TRAIN"))
        return TN_OK;
    return wrong(t, goal ? goal->line : 1, E_EVOLUTION_VALUE, help, "the parameters do not say what to evolve towards");
}

static void list_ignored(translation *t)
{
    for (size_t i = 0; i < t->count; i++) {
        size_t row = 0;
        while (row < ROWS && strcmp(rows[row].name, t->items[i].name) != 0)
            row++;
        if (row == ROWS)
            ignore(t, t->items[i].name);
    }
}

static tn_status translate(translation *t)
{
    tn_status status = read_parameters(t);
    if (status == TN_OK)
        status = check_goal(t);
    fputs("evolution {\n", t->study);
    for (size_t row = 0; row < ROWS && status == TN_OK; row++)
        status = write_parameter(t, row);
    write_depth(t);
    fputs("}\n", t->study);
    list_ignored(t);
    return status;
}

tn_status tn_ponyge_study(const char *path, const char *text, size_t size, char **study, char **ignored,
                          tn_error *error)
{
    size_t study_size, ignored_size;
    translation *t = calloc(1, sizeof *t);
    *study = *ignored = NULL;
    if (!t)
        return tn_fail_memory(error);
    t->path = path;
    t->error = error;
    t->copy = strndup(text, size);
    t->study = open_memstream(study, &study_size);
    t->ignored = open_memstream(ignored, &ignored_size);
    tn_status status = t->copy && t->study && t->ignored ? translate(t) : tn_fail_memory(error);
    bool written = t->study && fclose(t->study) == 0;
    written &= t->ignored && fclose(t->ignored) == 0;
    free(t->copy);
    free(t);
    if (status == TN_OK && !written)
        status = tn_fail_memory(error);
    if (status != TN_OK) {
        free(*study);
        free(*ignored);
        *study = *ignored = NULL;
    }
    return status;
}
