/* Translates parameter files of PonyGE2. */
#include "driver/ponyge/ponyge.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "driver/open/open.h"
#include "runtime/base/file.h"
#include "runtime/grammar/analysis.h"

/* How a parameter becomes a setting. */
typedef enum manner {
    NUMBER,  /* as it is */
    FILE_OF, /* a path, quoted */
    TEXT,    /* quoted */
    WORD,    /* the operator's word, by the list */
    ELITES,  /* a number, or a hundredth of the population */
    DEPTHS,  /* with MIN_INIT_TREE_DEPTH, or what the grammar makes of that */
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
static const choice errors[] = {{"rmse", "rmse"},
                                {"mse", "mse"},
                                {"mae", "mae"},
                                {"Rsquared", "r2"},
                                {"f1_score", "f1"},
                                {"inverse_f1_score", "f1"},
                                {0}};
static const choice points[] = {{"True", "used"}, {"False", "anywhere"}, {0}};
static const choice copies[] = {{"True", "again"}, {"False", "kept"}, {0}};

/* What holds where a parameter is not there is what PonyGE2's algorithm/parameters.py says (revision f3371717); NULL:
 * nothing is written then. */
typedef struct row {
    const char *name;
    manner manner;
    const char *setting, *standard;
    const char *none; /* what `None` means, where that is not the default */
    const choice *choices;
    const char *number; /* the parameter whose value stands behind the word */
    const char *folder;
} row;

#define NO_LIMIT "1000000" /* of codons: the highest number that the setting takes */
#define DEPTH_MOST 10000   /* likewise of `depth` */

static const row rows[] = {
    {"GRAMMAR_FILE", FILE_OF, "grammar", .standard = "supervised_learning/Vladislavleva4.bnf", .folder = "grammars"},
    {"DATASET_TRAIN", FILE_OF, "fit", .standard = "Vladislavleva4/Train.txt", .folder = "datasets"},
    {"DATASET_TEST", FILE_OF, "test", .folder = "datasets"},
    {"TARGET", TEXT, "match", .standard = "ponyge_rocks"},
    {"ERROR_METRIC", WORD, "error", .standard = "rmse", .choices = errors},
    {"POPULATION_SIZE", NUMBER, "population", .standard = "500"},
    {"GENERATIONS", NUMBER, "generations", .standard = "50"},
    {"RANDOM_SEED", NUMBER, .setting = "seed"},
    {"ELITE_SIZE", ELITES, .setting = "elites"},
    {"CODON_SIZE", NUMBER, "codon-limit", .standard = "100000"},
    {"INIT_GENOME_LENGTH", NUMBER, "codons", .standard = "200"},
    {"MAX_GENOME_LENGTH", NUMBER, "max-codons", .standard = NO_LIMIT},
    {"MAX_TREE_DEPTH", NUMBER, "max-depth", .standard = "90", .none = "0"},
    {"MAX_WRAPS", NUMBER, "wraps", .standard = "0"},
    {"INITIALISATION", WORD, "initialise", .standard = "PI_grow", .choices = initialisations},
    {"MAX_INIT_TREE_DEPTH", DEPTHS, "depth", .standard = "10"},
    {"CROSSOVER", WORD, "crossover", .standard = "variable_onepoint", .choices = crossovers,
     .number = "CROSSOVER_PROBABILITY"},
    {"MUTATION", WORD, "mutation", .standard = "int_flip_per_codon", .choices = mutations},
    {"SELECTION", WORD, "selection", .standard = "tournament", .choices = selections},
    {"REPLACEMENT", WORD, "replacement", .standard = "generational", .choices = replacements},
    {"WITHIN_USED", WORD, "points", .standard = "True", .choices = points},
    {"MUTATE_DUPLICATES", WORD, "copies", .standard = "False", .choices = copies},
    {"MIN_INIT_TREE_DEPTH", .manner = PART},
    {"CROSSOVER_PROBABILITY", PART, .standard = "0.75"},
    {"MUTATION_PROBABILITY", .manner = PART},
    {"MUTATION_EVENTS", PART, .standard = "1"},
    {"TOURNAMENT_SIZE", PART, .standard = "2"},
    {"SELECTION_PROPORTION", PART, .standard = "0.5"},
    {"FITNESS_FUNCTION", PART, .standard = "supervised_learning.regression"},
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
    uint32_t ramp; /* where ramped depths begin, once that is known; or 0 */
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

static const row *row_of(const char *name)
{
    for (size_t i = 0; i < ROWS; i++)
        if (strcmp(rows[i].name, name) == 0)
            return &rows[i];
    return NULL;
}

/* A value without the comment behind it, and without quotes around it. PonyGE2 has Python evaluate values: what is no
 * Python, as a text that begins without a quote, is taken as it is, its # included. */
static char *read_value(const char *name, char *text)
{
    const row *r = row_of(name);
    char *value = trimmed(text), *end = strchr("'\"", value[0]) && value[0] ? strchr(value + 1, value[0]) : NULL;
    if (end) {
        *end = '\0';
        return value + 1;
    }
    if (!r || r->manner != TEXT)
        value[strcspn(value, "#")] = '\0';
    return trimmed(value);
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
        char *name = trimmed(line), *colon = strchr(name, ':');
        if (!*name || *name == '#')
            continue;
        if (!colon)
            return wrong(t, number, E_EVOLUTION_SETTING,
                         "parameters are written `POPULATION_SIZE: 500`, one a line; a study needs no --ponyge",
                         "`%.60s` is no parameter of PonyGE2", name);
        if (t->count == PARAMETERS_MAX)
            return wrong(t, number, E_EVOLUTION_SETTING, "leave some out", "there are more than %u parameters",
                         PARAMETERS_MAX);
        *colon = '\0';
        name = trimmed(name);
        t->items[t->count++] = (parameter){name, read_value(name, colon + 1), number};
    }
    return TN_OK;
}

/* The last of those with that name, or NULL. */
static const parameter *find(const translation *t, const char *name)
{
    const parameter *found = NULL;
    for (size_t i = 0; i < t->count; i++)
        if (strcmp(t->items[i].name, name) == 0)
            found = &t->items[i];
    return found;
}

static bool says_nothing(const parameter *p)
{
    return !p || !p->value[0] || strcmp(p->value, "None") == 0;
}

static size_t line_of(const translation *t, const row *r)
{
    const parameter *p = find(t, r->name);
    return p ? p->line : 1;
}

/* What the file says, or the default; NULL: nothing. */
static const char *value_of(const translation *t, const row *r)
{
    const parameter *p = find(t, r->name);
    if (!says_nothing(p))
        return p->value;
    return p && r->none ? r->none : r->standard;
}

static const char *value_named(const translation *t, const char *name)
{
    return value_of(t, row_of(name));
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
 * path from the folder of the parameters. NULL where none is, or out of memory. */
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
    for (size_t i = 0; i < 3; i++)
        free(tries[i]);
    return found;
}

/* A file that is named and not there is the study's error; of a default, the parameters lack the name. */
static tn_status write_file(translation *t, const row *r, const char *value)
{
    char *path = find_file(t, r->folder, value);
    if (!path && says_nothing(find(t, r->name)))
        return wrong(t, 1, E_EVOLUTION_VALUE,
                     "data to fit (DATASET_TRAIN), or a text to match (FITNESS_FUNCTION: string_match and TARGET), are "
                     "read, and a grammar (GRAMMAR_FILE)",
                     "the parameters have no %s, and the file that PonyGE2 then takes, %s, is not here", r->name,
                     value);
    fprintf(t->study, "  %s ", r->setting);
    write_quoted(t->study, path ? path : value);
    fputc('\n', t->study);
    free(path);
    return TN_OK;
}

/* NULL where there is no counterpart. */
static const char *our_word(const row *r, const char *value)
{
    const char *dot = strrchr(value, '.'), *word = dot ? dot + 1 : value;
    const choice *c = r->choices;
    while (c->theirs && strcasecmp(c->theirs, word) != 0)
        c++;
    return c->ours;
}

static bool chose(const translation *t, const char *name, const char *ours)
{
    const row *r = row_of(name);
    const char *word = our_word(r, value_of(t, r));
    return word && strcmp(word, ours) == 0;
}

/* The number behind an operator's word, or NULL: then the operator's own holds, which is PonyGE2's, too. */
static const char *number_behind(const translation *t, const row *r, const char *word)
{
    const char *name = r->number;
    if (strcmp(r->setting, "selection") == 0)
        name = strcmp(word, "truncation") == 0 ? "SELECTION_PROPORTION" : "TOURNAMENT_SIZE";
    if (strcmp(r->setting, "mutation") == 0)
        name = strcmp(word, "codons") == 0   ? "MUTATION_PROBABILITY"
               : strcmp(word, "genome") == 0 ? "MUTATION_EVENTS"
                                             : NULL;
    return name ? value_named(t, name) : NULL;
}

static tn_status write_word(translation *t, const row *r, const char *value)
{
    const char *word = our_word(r, value);
    if (!word)
        return wrong(t, line_of(t, r), E_EVOLUTION_VALUE,
                     "leave the line out, or write a study: docs/evolution.md lists all settings",
                     "`%.80s` has no counterpart here", value);
    const char *number = number_behind(t, r, word);
    fprintf(t->study, "  %s %s%s%s\n", r->setting, word, number && is_number(number) ? " " : "",
            number && is_number(number) ? number : "");
    return TN_OK;
}

static tn_status check_number(translation *t, const row *r, const char *value)
{
    return is_number(value)
               ? TN_OK
               : wrong(t, line_of(t, r), E_EVOLUTION_VALUE, "write a number, as 500", "`%.60s` is no number", value);
}

static tn_status write_number(translation *t, const row *r, const char *value)
{
    tn_status status = check_number(t, r, value);
    if (status == TN_OK)
        fprintf(t->study, "  %s %s\n", r->setting, value);
    return status;
}

/* One in a hundred, rounded as Python rounds, and at least one; steady-state replacement has none. */
static tn_status write_elites(translation *t, const row *r, const char *value)
{
    if (value)
        return write_number(t, r, value);
    double population = atof(value_named(t, "POPULATION_SIZE"));
    if (!chose(t, "REPLACEMENT", "steady-state"))
        fprintf(t->study, "  %s %.0f\n", r->setting, fmax(nearbyint(population / 100), 1));
    return TN_OK;
}

/* The largest depth of any derivation; DEPTH_MOST: there is no limit. */
static uint32_t deepest(const translation *t)
{
    double limit = atof(value_named(t, "MAX_TREE_DEPTH"));
    return limit >= 1 && limit < DEPTH_MOST ? (uint32_t)limit : DEPTH_MOST;
}

/* Does the ramp of first depths begin where the grammar has enough derivations? */
static bool ramps(const translation *t)
{
    return (chose(t, "INITIALISATION", "pi-grow") || chose(t, "INITIALISATION", "ramped")) &&
           says_nothing(find(t, "MIN_INIT_TREE_DEPTH"));
}

/* Ramps begin above MIN_INIT_TREE_DEPTH. `uniform_tree` does not look at it, nor at MAX_INIT_TREE_DEPTH, and subtree
 * mutation does not either. */
static tn_status write_depths(translation *t, const row *r, const char *value)
{
    tn_status status = check_number(t, r, value);
    const char *least = value_named(t, "MIN_INIT_TREE_DEPTH");
    uint32_t high = (uint32_t)fmin(atof(value), DEPTH_MOST), low = t->ramp ? t->ramp : 1;
    if (least && is_number(least))
        low = (uint32_t)fmin(atof(least), DEPTH_MOST) + 1;
    if (chose(t, "INITIALISATION", "grow"))
        fprintf(t->study, "  %s 1..%u\n", r->setting, deepest(t));
    else if (!chose(t, "INITIALISATION", "random"))
        fprintf(t->study, "  %s %u..%u\n", r->setting, low < high ? low : high, high);
    if (chose(t, "MUTATION", "subtree"))
        fprintf(t->study, "  tree-depth %u\n", deepest(t));
    return status;
}

/* The fitness functions that are problems of ours. */
static bool is_function(const char *goal, const char *const *names)
{
    while (*names && strcmp(*names, goal) != 0)
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
static const char *const classifying[] = {"supervised_learning.classification", "classification", NULL};

/* Is the row about the other problem? */
static bool is_idle(const translation *t, const row *r)
{
    bool matches = is_function(value_named(t, "FITNESS_FUNCTION"), matching);
    bool fits = r->choices == errors || (r->folder && strcmp(r->folder, "datasets") == 0);
    return matches ? fits : r->manner == TEXT;
}

static tn_status write_parameter(translation *t, const row *r)
{
    const char *value = value_of(t, r);
    if (r->choices == errors && says_nothing(find(t, r->name)) &&
        is_function(value_named(t, "FITNESS_FUNCTION"), classifying))
        value = "f1_score";
    if (r->manner == PART || (!value && r->manner != ELITES) || is_idle(t, r))
        return TN_OK;
    switch (r->manner) {
    case NUMBER:
        return write_number(t, r, value);
    case FILE_OF:
        return write_file(t, r, value);
    case TEXT:
        fprintf(t->study, "  %s ", r->setting);
        write_quoted(t->study, value);
        fputc('\n', t->study);
        return TN_OK;
    case WORD:
        return write_word(t, r, value);
    case ELITES:
        return write_elites(t, r, value);
    case DEPTHS:
        return write_depths(t, r, value);
    case PART:
        break;
    }
    return TN_OK;
}

static tn_status check_goal(translation *t)
{
    const row *r = row_of("FITNESS_FUNCTION");
    const char *goal = value_of(t, r);
    if (is_function(goal, matching) || is_function(goal, fitting))
        return TN_OK;
    return wrong(t, line_of(t, r), E_EVOLUTION_VALUE,
                 "data to fit (DATASET_TRAIN) and a text to match (TARGET) are read",
                 "the fitness function `%.80s` is a Python program, which is not run here", goal);
}

/* Those without a row, and those of the other problem. */
static void list_ignored(translation *t)
{
    for (size_t i = 0; i < t->count; i++) {
        const row *r = row_of(t->items[i].name);
        if (!r || (is_idle(t, r) && !says_nothing(&t->items[i])))
            ignore(t, t->items[i].name);
    }
}

/* The study, which the caller frees. */
static tn_status write_study(translation *t, char **study)
{
    size_t size;
    tn_status status = TN_OK;
    *study = NULL;
    t->study = open_memstream(study, &size);
    if (!t->study)
        return tn_fail_memory(t->error);
    fputs("evolution {\n", t->study);
    for (size_t i = 0; i < ROWS && status == TN_OK; i++)
        status = write_parameter(t, &rows[i]);
    fputs("}\n", t->study);
    return fclose(t->study) == 0 ? status : tn_fail_memory(t->error);
}

/* ---- where ramped depths begin */

/* The least depth that more derivations have than individuals are made for it, so that few of these are alike: PonyGE2
 * counts as many depths as there are from the least one on, or as many as there are pairs of individuals. */
static tn_status find_ramp(const tn_grammar *grammar, uint32_t population, uint32_t most, uint32_t least,
                           uint32_t *ramp, tn_error *error)
{
    uint32_t size = population + population % 2, depths = most + 2 > least ? most + 2 - least : 1;
    uint32_t each = size / (size / 2 < depths ? size / 2 : depths);
    mpz_t up_to, before;
    mpz_inits(up_to, before, NULL);
    tn_status status = TN_OK;
    *ramp = 0;
    for (uint32_t depth = least; depth <= most && status == TN_OK && !*ramp; depth++) {
        bool by_codons;
        status = tn_count_derivations(grammar, depth, &by_codons, up_to, error);
        mpz_sub(before, up_to, before);
        if (status == TN_LIMIT || mpz_cmp_ui(before, each) > 0)
            *ramp = depth;
        mpz_set(before, up_to);
    }
    mpz_clears(up_to, before, NULL);
    *ramp = *ramp ? *ramp : least;
    return status == TN_LIMIT ? TN_OK : status;
}

/* Of the grammar that the study names. Where it has errors nothing is found: they are said when it is compiled. */
static tn_status find_ramp_of(translation *t, const char *study)
{
    char *name = NULL;
    tn_opened opened;
    tn_grammar *grammar = NULL;
    tn_analysis analysis = {0};
    if (asprintf(&name, "%s.study", t->path) < 0)
        return tn_fail_memory(t->error);
    tn_status status = TN_OK;
    if (tn_open_bytes(name, (const uint8_t *)study, strlen(study), false, &opened) == TN_OK) {
        status = tn_grammar_new(opened.module, 0, &grammar, t->error);
        if (status == TN_OK)
            status = tn_analyse(grammar, &analysis, t->error);
        if (status == TN_OK && grammar->dialect == TN_DIALECT_GE)
            status = find_ramp(grammar, (uint32_t)atof(value_named(t, "POPULATION_SIZE")),
                               (uint32_t)atof(value_named(t, "MAX_INIT_TREE_DEPTH")), analysis.rule_depth[0], &t->ramp,
                               t->error);
    }
    tn_analysis_clear(&analysis);
    tn_grammar_free(grammar);
    tn_close(&opened);
    free(name);
    return status;
}

static tn_status translate(translation *t, char **study)
{
    tn_status status = read_parameters(t);
    if (status == TN_OK)
        status = check_goal(t);
    if (status == TN_OK)
        status = write_study(t, study);
    if (status == TN_OK && ramps(t)) {
        status = find_ramp_of(t, *study);
        free(*study);
        *study = NULL;
        if (status == TN_OK)
            status = write_study(t, study);
    }
    if (status == TN_OK)
        list_ignored(t);
    return status;
}

tn_status tn_ponyge_study(const char *path, const char *text, size_t size, char **study, char **ignored,
                          tn_error *error)
{
    size_t ignored_size;
    translation *t = calloc(1, sizeof *t);
    *study = *ignored = NULL;
    if (!t)
        return tn_fail_memory(error);
    t->path = path;
    t->error = error;
    t->copy = strndup(text, size);
    t->ignored = open_memstream(ignored, &ignored_size);
    tn_status status = t->copy && t->ignored ? translate(t, study) : tn_fail_memory(error);
    bool written = t->ignored && fclose(t->ignored) == 0;
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
