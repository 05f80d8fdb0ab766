/* What the settings of an evolution block mean. Every setting is a row of one table. */
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "compiler/evolution.h"

typedef enum kind {
    WHOLE,       /* a whole number from low to high */
    REAL,        /* a number from low to high */
    PAIR,        /* a whole number, or a range of them */
    TEXT,        /* in quotes */
    CHOICE,      /* a word of a list */
    CHOICE_REAL, /* and perhaps a number after it */
} kind;

typedef struct setting_row {
    const char *name;
    kind kind;
    size_t offset, second; /* in tn_evolution_study; of the number after a word, or the range's end */
    size_t says;           /* of a bool that tells whether it was given, or 0 */
    double low, high;
    const char *choices; /* "a|b|c" */
} setting_row;

#define AT(FIELD) offsetof(tn_evolution_study, FIELD)
#define LARGE 9007199254740992.0 /* 2^53: whole numbers are exact up to there */

static const setting_row rows[] = {
    {"grammar", TEXT, AT(grammar), 0, 0, 0, 0, NULL},
    {"match", TEXT, AT(match), 0, 0, 0, 0, NULL},
    {"fit", TEXT, AT(fit), 0, 0, 0, 0, NULL},
    {"grow", TEXT, AT(grow), 0, 0, 0, 0, NULL},
    {"keep", TEXT, AT(keep), 0, 0, 0, 0, NULL},
    {"drop", TEXT, AT(drop), 0, 0, 0, 0, NULL},
    {"schema", TEXT, AT(schema), 0, 0, 0, 0, NULL},
    {"seed", WHOLE, AT(seed), 0, 0, 0, LARGE, NULL},
    {"population", WHOLE, AT(population), 0, 0, 2, 1000000, NULL},
    {"generations", WHOLE, AT(generations), 0, 0, 0, 1000000, NULL},
    {"initialise", CHOICE, AT(initialise), 0, 0, 0, 0, "random|ramped|grow|pi-grow"},
    {"codons", WHOLE, AT(codons), 0, 0, 1, 1000000, NULL},
    {"codon-limit", WHOLE, AT(codon_limit), 0, 0, 1, LARGE, NULL},
    {"max-codons", WHOLE, AT(max_codons), 0, 0, 1, 1000000, NULL},
    {"depth", PAIR, AT(depth_low), AT(depth_high), 0, 1, 10000, NULL},
    {"tail", REAL, AT(tail), 0, 0, 0, 100, NULL},
    {"seeds", TEXT, AT(seeds), 0, 0, 0, 0, NULL},
    {"selection", CHOICE_REAL, AT(selection), AT(selection_value), AT(says_selection_value), 0, 1000000,
     "tournament|truncation|roulette|nsga2"},
    {"crossover", CHOICE_REAL, AT(crossover), AT(crossover_rate), 0, 0, 1,
     "one-point|fixed-one-point|two-point|fixed-two-point|subtree"},
    {"mutation", CHOICE_REAL, AT(mutation), AT(mutation_rate), 0, 0, 1000000, "codons|genome|subtree"},
    {"points", CHOICE, AT(points), 0, 0, 0, 0, "used|anywhere"},
    {"elites", WHOLE, AT(elites), 0, 0, 0, 1000000, NULL},
    {"replacement", CHOICE, AT(replacement), 0, 0, 0, 0, "generational|steady-state"},
    {"max-depth", WHOLE, AT(max_depth), 0, AT(says_max_depth), 0, 1000000, NULL},
    {"tree-depth", WHOLE, AT(tree_depth), 0, AT(says_tree_depth), 1, 10000, NULL},
    {"wraps", WHOLE, AT(wraps), 0, AT(says_wraps), 0, 1000000, NULL},
    {"max-steps", WHOLE, AT(max_steps), 0, 0, 1, LARGE, NULL},
    {"stop", REAL, AT(stop), 0, AT(says_stop), 0, LARGE, NULL},
    {"length-weight", REAL, AT(length_weight), 0, 0, 0, 1000, NULL},
};

#define ROW_COUNT (sizeof rows / sizeof *rows)

typedef struct check {
    const tn_evolution_reader *reader;
    tn_evolution_study *study;
    const tn_evolution_setting *seen[ROW_COUNT];
} check;

static void *place(check *c, size_t offset)
{
    return (char *)c->study + offset;
}

static void bad_value(check *c, const setting_row *row, tn_span span)
{
    tn_diagnostics *list = c->reader->diagnostics;
    tn_diagnostic *diagnostic = tn_report(list, E_EVOLUTION_VALUE, span, "`%s` wants another value", row->name);
    switch (row->kind) {
    case WHOLE:
        tn_help(list, diagnostic, "write a whole number from %.0f to %.0f", row->low, row->high);
        break;
    case REAL:
        tn_help(list, diagnostic, "write a number from %g to %g", row->low, row->high);
        break;
    case PAIR:
        tn_help(list, diagnostic, "write a whole number or a range of them, as 2..8");
        break;
    case TEXT:
        tn_help(list, diagnostic, "write a text in quotes");
        break;
    case CHOICE:
        tn_help(list, diagnostic, "write one of %s", row->choices);
        break;
    case CHOICE_REAL:
        tn_help(list, diagnostic, "write one of %s, and perhaps a number from %g to %g", row->choices, row->low,
                row->high);
        break;
    }
}

/* The word of the list that the value is, or NULL. */
static const char *find_choice(check *c, const char *choices, const char *word)
{
    size_t length = strlen(word);
    for (const char *at = choices; *at;) {
        size_t size = strcspn(at, "|");
        if (size == length && memcmp(at, word, size) == 0)
            return tn_arena_copy(c->reader->arena, word, length);
        at += size + (at[size] == '|');
    }
    return NULL;
}

static bool read_real(const setting_row *row, const tn_evolution_value *value, double *number)
{
    if (value->kind != TN_EVOLUTION_NUMBER)
        return false;
    *number = strtod(value->text, NULL);
    return *number >= row->low && *number <= row->high;
}

static bool read_whole(const setting_row *row, const char *text, uint64_t *number)
{
    if (strlen(text) > 16 || strchr(text, '.') || text[0] == '-')
        return false;
    *number = strtoull(text, NULL, 10);
    return (double)*number >= row->low && (double)*number <= row->high;
}

static bool read_pair(check *c, const setting_row *row, const tn_evolution_value *value)
{
    uint64_t *low = place(c, row->offset), *high = place(c, row->second);
    if (value->kind == TN_EVOLUTION_NUMBER && read_whole(row, value->text, low)) {
        *high = *low;
        return true;
    }
    const char *dots = value->kind == TN_EVOLUTION_RANGE ? strstr(value->text, "..") : NULL;
    char *first = dots ? tn_arena_copy(c->reader->arena, value->text, (size_t)(dots - value->text)) : NULL;
    return first && read_whole(row, first, low) && read_whole(row, dots + 2, high) && *low <= *high;
}

static bool read_choice(check *c, const setting_row *row, const tn_evolution_value *value)
{
    const char *word = value->kind == TN_EVOLUTION_WORD ? find_choice(c, row->choices, value->text) : NULL;
    if (word)
        *(const char **)place(c, row->offset) = word;
    return word != NULL;
}

static void take(check *c, const setting_row *row, const tn_evolution_setting *setting)
{
    const tn_evolution_value *value = setting->values, *second = value ? value->next : NULL;
    const tn_evolution_value *extra = row->kind == CHOICE_REAL ? (second ? second->next : NULL) : second;
    bool well = value && !extra;
    if (well) {
        switch (row->kind) {
        case WHOLE:
            well = value->kind == TN_EVOLUTION_NUMBER && read_whole(row, value->text, place(c, row->offset));
            break;
        case REAL:
            well = read_real(row, value, place(c, row->offset));
            break;
        case PAIR:
            well = read_pair(c, row, value);
            break;
        case TEXT:
            well = value->kind == TN_EVOLUTION_STRING;
            if (well)
                *(const char **)place(c, row->offset) = value->text;
            break;
        case CHOICE:
            well = read_choice(c, row, value);
            break;
        case CHOICE_REAL:
            well = read_choice(c, row, value) && (!second || read_real(row, second, place(c, row->second)));
            break;
        }
    }
    if (!well)
        bad_value(c, row, extra ? extra->span : value ? value->span : setting->span);
    else if (row->says)
        *(bool *)place(c, row->says) = row->kind != CHOICE_REAL || second;
}

static void unknown(check *c, const tn_evolution_setting *setting)
{
    const char *names[ROW_COUNT];
    for (size_t i = 0; i < ROW_COUNT; i++)
        names[i] = rows[i].name;
    tn_diagnostics *list = c->reader->diagnostics;
    tn_diagnostic *diagnostic =
        tn_report(list, E_EVOLUTION_SETTING, setting->span, "there is no setting `%.60s`", setting->name);
    const char *near = tn_nearest(setting->name, names, ROW_COUNT);
    if (near)
        tn_help(list, diagnostic, "did you mean `%s`?", near);
    else
        tn_help(list, diagnostic, "docs/evolution.md lists all settings");
}

static void check_setting(check *c, const tn_evolution_setting *setting)
{
    for (size_t i = 0; i < ROW_COUNT; i++) {
        if (strcmp(rows[i].name, setting->name) != 0)
            continue;
        if (c->seen[i]) {
            tn_diagnostic *diagnostic = tn_report(c->reader->diagnostics, E_EVOLUTION_SETTING, setting->span,
                                                  "`%s` is there twice", setting->name);
            tn_note(c->reader->diagnostics, diagnostic, &c->seen[i]->span, "the first is here");
        }
        c->seen[i] = setting;
        take(c, &rows[i], setting);
        return;
    }
    unknown(c, setting);
}

/* ---- the whole */

static void whole_error(check *c, const char *message, const char *help)
{
    tn_diagnostic *diagnostic = tn_report(c->reader->diagnostics, E_EVOLUTION_VALUE, c->reader->block, "%s", message);
    tn_help(c->reader->diagnostics, diagnostic, "%s", help);
}

static void check_whole(check *c)
{
    tn_evolution_study *s = c->study;
    int problems = (s->match != NULL) + (s->fit != NULL) + (s->grow != NULL) + (s->keep || s->drop);
    if (!s->grammar)
        whole_error(c, "the study does not say which grammar genomes are mapped through",
                    "add a line such as `grammar \"words\"`");
    if (problems != 1)
        whole_error(c, problems ? "the study has more than one problem" : "the study does not say what is wanted",
                    "write one of `match \"TEXT\"`, `fit \"DATA.csv\"`, `grow \"GROWTH.study\"`, or `keep \"PLANS\"` "
                    "with `drop \"PLANS\"`");
    if ((s->keep != NULL) != (s->drop != NULL))
        whole_error(c, "a rule is learned from plans of both kinds",
                    "write both `keep \"PLANS\"` and `drop \"PLANS\"`");
    s->problem = s->match ? TN_EVOLVE_MATCH : s->fit ? TN_EVOLVE_FIT : s->grow ? TN_EVOLVE_GROW : TN_EVOLVE_LEARN;
    if (s->elites >= s->population)
        whole_error(c, "there are as many elites as individuals", "an elite or two are usual");
    bool nsga2 = strcmp(s->selection, "nsga2") == 0;
    if (nsga2 && s->problem != TN_EVOLVE_LEARN && s->problem != TN_EVOLVE_GROW)
        whole_error(c, "`selection nsga2` weighs several objectives, and this problem has one",
                    "write `selection tournament 3`");
    if (nsga2 && strcmp(s->replacement, "generational") != 0)
        whole_error(c, "`selection nsga2` chooses among parents and children together", "leave `replacement` out");
    bool truncation = strcmp(s->selection, "truncation") == 0;
    if (truncation && s->says_selection_value && !(s->selection_value > 0 && s->selection_value <= 1))
        whole_error(c, "`selection truncation` takes the share of the best",
                    "write a number above 0 and not above 1, as 0.5");
    if (strcmp(s->mutation, "genome") != 0 && s->mutation_rate > 1)
        whole_error(c, "this mutation takes a probability", "write a number from 0 to 1");
}

bool tn_evolution_check(const tn_evolution_reader *reader, tn_evolution_study *study)
{
    size_t errors = reader->diagnostics->error_count;
    check c = {.reader = reader, .study = study};
    *study = (tn_evolution_study){
        .population = 500,
        .generations = 50,
        .initialise = "ramped",
        .codons = 200,
        .codon_limit = 100000,
        .max_codons = 5000,
        .depth_low = 2,
        .depth_high = 10,
        .tail = 0.5,
        .selection = "tournament",
        .crossover = "one-point",
        .crossover_rate = 0.75,
        .mutation = "codons",
        .mutation_rate = -1,
        .points = "used",
        .elites = 1,
        .replacement = "generational",
        .length_weight = 0.001,
        .schema = "lahave",
        .span = reader->block,
    };
    for (const tn_evolution_setting *setting = reader->first; setting; setting = setting->next)
        check_setting(&c, setting);
    check_whole(&c);
    return reader->diagnostics->error_count == errors;
}
