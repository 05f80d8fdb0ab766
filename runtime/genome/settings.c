/* Checks and writes the settings of an evolution by their table. */
#include "runtime/genome/settings.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "runtime/base/buffer.h"
#include "runtime/base/utf8.h"
#include "runtime/module/engine.h"
#include "runtime/module/lister.h"
#include "runtime/module/verify.h"

const tn_setting_row tn_setting_rows[TN_SETTING_COUNT] = {
#define SETTING(ID, NUMBER, NAME, KIND, FIRST, SECOND, LOW, HIGH, CHOICES, USE)                                        \
    [TN_SET_##ID] = {NAME, TN_SETTING_##KIND, FIRST, SECOND, LOW, HIGH, CHOICES, TN_USE_##USE},
#include "runtime/genome/settings.def"
};

tn_setting tn_setting_named(const char *text, size_t size)
{
    for (tn_setting setting = 0; setting < TN_SETTING_COUNT; setting++) {
        const char *name = tn_setting_rows[setting].name;
        if (name && strlen(name) == size && strncasecmp(name, text, size) == 0)
            return setting;
    }
    return TN_SETTING_COUNT;
}

void tn_evolution_study_default(tn_evolution_study *study)
{
    *study = (tn_evolution_study){0};
    for (size_t i = 0; i < TN_SETTING_COUNT; i++) {
        const tn_setting_row *row = &tn_setting_rows[i];
        bool chooses = row->kind == TN_SETTING_CHOICE || row->kind == TN_SETTING_CHOICE_REAL;
        study->of[i].choice = chooses ? (uint32_t)row->first : 0;
        study->of[i].first = chooses ? 0 : row->first;
        study->of[i].second = row->second;
    }
}

tn_setting_use tn_evolution_study_use(const tn_evolution_study *study)
{
    return study->of[TN_SET_DESIGN].written   ? TN_USE_BOXES
           : study->of[TN_SET_PARENT].written ? TN_USE_TREES
                                              : TN_USE_CODONS;
}

bool tn_evolution_study_add(tn_evolution_study *study, tn_setting setting, const tn_setting_value *value)
{
    if (study->each_count == TN_EACH_MAX)
        return false;
    if (study->of[setting].written == 0)
        study->of[setting] = *value;
    study->each[study->each_count++] = (tn_setting_each){setting, *value};
    return true;
}

/* ---- choices */

uint32_t tn_setting_choice(const tn_setting_row *row, const char *word)
{
    size_t length = strlen(word);
    uint32_t index = 0;
    for (const char *at = row->choices; *at; index++) {
        size_t size = strcspn(at, "|");
        if (size == length && strncasecmp(at, word, size) == 0)
            return index;
        at += size + (at[size] == '|');
    }
    return UINT32_MAX;
}

uint32_t tn_setting_choice_count(const tn_setting_row *row)
{
    uint32_t count = row->choices[0] != '\0';
    for (const char *at = row->choices; *at; at++)
        count += *at == '|';
    return count;
}

void tn_setting_choice_name(const tn_setting_row *row, uint32_t choice, char name[32])
{
    const char *at = row->choices;
    for (; choice > 0; choice--)
        at += strcspn(at, "|") + 1;
    size_t size = strcspn(at, "|");
    size = size < 31 ? size : 31;
    memcpy(name, at, size);
    name[size] = '\0';
}

/* ---- whole numbers of 64 bits */

#define EXACT_BITS 53 /* whole numbers of so many bits are exact as doubles */

void tn_setting_put_whole64(tn_setting_value *value, uint64_t whole)
{
    value->first = (double)(whole & ((UINT64_C(1) << EXACT_BITS) - 1));
    value->second = (double)(whole >> EXACT_BITS);
}

uint64_t tn_setting_whole64(const tn_setting_value *value)
{
    return ((uint64_t)value->second << EXACT_BITS) + (uint64_t)value->first;
}

/* Modules of before there were 64 bits have 2^53 too, as its low part. */
static bool is_whole64(const tn_setting_value *value)
{
    double low = (double)(UINT64_C(1) << EXACT_BITS), high = (double)(UINT64_C(1) << (64 - EXACT_BITS));
    return value->first >= 0 && (value->first < low || (value->first == low && value->second == 0)) &&
           value->first == floor(value->first) && value->second >= 0 && value->second < high &&
           value->second == floor(value->second);
}

/* ---- writing */

static void write_quoted(FILE *out, const char *text)
{
    fputc('"', out);
    for (; *text; text++) {
        size_t size = strcspn(text, "\"\\");
        tn_write_clean(out, text, size);
        text += size;
        if (!*text)
            break;
        fputc('\\', out);
        fputc(*text, out);
    }
    fputc('"', out);
}

static void write_number(FILE *out, double number)
{
    char text[TN_NUMBER_TEXT_SIZE];
    fputs(tn_number_text(number, text), out);
}

void tn_setting_write(FILE *out, tn_setting setting, const tn_setting_value *value)
{
    const tn_setting_row *row = &tn_setting_rows[setting];
    char word[32];
    fprintf(out, "%s ", row->name);
    switch (row->kind) {
    case TN_SETTING_WHOLE:
    case TN_SETTING_REAL:
        write_number(out, value->first);
        return;
    case TN_SETTING_SEED:
        fprintf(out, "%" PRIu64, tn_setting_whole64(value));
        return;
    case TN_SETTING_PAIR:
    case TN_SETTING_SPAN:
        write_number(out, value->first);
        fputs("..", out);
        write_number(out, value->second);
        return;
    case TN_SETTING_EVERY:
        write_number(out, value->first);
        fputs(" every ", out);
        write_number(out, value->second);
        return;
    case TN_SETTING_TEXT:
        write_quoted(out, value->text ? value->text : "");
        return;
    case TN_SETTING_EACH:
        write_quoted(out, value->text ? value->text : "");
        if (setting == TN_SET_FITNESS) {
            fputs(" target ", out);
            write_number(out, value->first);
        }
        fputs(" weight ", out);
        write_number(out, value->second);
        return;
    case TN_SETTING_CHOICE:
    case TN_SETTING_CHOICE_REAL:
        tn_setting_choice_name(row, value->choice, word);
        fputs(word, out);
        if (value->written == 2) {
            fputc(' ', out);
            write_number(out, value->second);
        }
        return;
    }
}

/* ---- what is right */

static bool within(const tn_setting_row *row, double number)
{
    return number >= row->low && number <= row->high;
}

static bool whole_within(const tn_setting_row *row, double number)
{
    return within(row, number) && number == floor(number);
}

bool tn_setting_fits(tn_setting setting, const tn_setting_value *value)
{
    const tn_setting_row *row = &tn_setting_rows[setting];
    bool one = value->written == 1;
    switch (row->kind) {
    case TN_SETTING_WHOLE:
        return one && whole_within(row, value->first);
    case TN_SETTING_REAL:
        return one && within(row, value->first);
    case TN_SETTING_SEED:
        return one && is_whole64(value);
    case TN_SETTING_PAIR:
        return one && whole_within(row, value->first) && whole_within(row, value->second) &&
               value->first <= value->second;
    case TN_SETTING_EVERY:
        return one && whole_within(row, value->first) && whole_within(row, value->second);
    case TN_SETTING_SPAN:
        return one && within(row, value->first) && within(row, value->second) && value->first <= value->second;
    case TN_SETTING_TEXT:
        return one && value->text && value->text[0];
    case TN_SETTING_EACH:
        return one && value->text && value->text[0] && within(row, value->second) &&
               fabs(value->first) <= TN_COORDINATE_MAX && (setting == TN_SET_FITNESS || value->first == 0);
    case TN_SETTING_CHOICE:
        return one && value->choice < tn_setting_choice_count(row);
    case TN_SETTING_CHOICE_REAL:
        return (one || (value->written == 2 && within(row, value->second))) &&
               value->choice < tn_setting_choice_count(row);
    }
    return false;
}

typedef struct findings {
    const tn_evolution_study *study;
    tn_setting_fault *faults;
    size_t count;
} findings;

static void find(findings *f, tn_setting setting, tn_setting other, const char *message, const char *help)
{
    if (f->count < TN_SETTING_FAULTS_MAX)
        f->faults[f->count++] = (tn_setting_fault){setting, other, message, help};
}

static bool chose(const findings *f, tn_setting setting, const char *word)
{
    return f->study->of[setting].choice == tn_setting_choice(&tn_setting_rows[setting], word);
}

static bool chooses_by_cases(const findings *f)
{
    return chose(f, TN_SET_SELECTION, "lexicase") || chose(f, TN_SET_SELECTION, "epsilon-lexicase");
}

static bool is_written(const findings *f, tn_setting setting)
{
    return f->study->of[setting].written > 0;
}

/* A program scores what has no other problem, or forms, whose own goals stand beside it. */
static void find_program(findings *f, tn_setting problem)
{
    static const tn_setting own[] = {TN_SET_PROGRAM_TIMEOUT, TN_SET_PROGRAM_VALUES};
    bool alone = problem == TN_SET_MATCH || problem == TN_SET_FIT || problem == TN_SET_KEEP || problem == TN_SET_DROP;
    uint32_t programs = 0;
    for (uint32_t i = 0; i < f->study->each_count; i++)
        programs += f->study->each[i].setting == TN_SET_PROGRAM;
    if (programs > 1)
        find(f, TN_SET_PROGRAM, TN_SETTING_COUNT, "a study has one program that scores",
             "have one of them call the other, and answer with several numbers: `program-values 2`");
    if (programs && alone)
        find(f, TN_SET_PROGRAM, problem, "a study has one problem, and this is another", "leave one of them out");
    for (size_t i = 0; i < sizeof own / sizeof *own; i++)
        if (is_written(f, own[i]) && !programs)
            find(f, own[i], TN_SETTING_COUNT, "this is about a program that scores",
                 "name it, as `fitness program \"./score.sh\"`, or leave this out");
}

/* One of match, fit, grow, build, place, and keep with drop. */
static void find_problem(findings *f)
{
    static const tn_setting starts[] = {TN_SET_MATCH, TN_SET_FIT,  TN_SET_GROW, TN_SET_BUILD,
                                        TN_SET_PLACE, TN_SET_KEEP, TN_SET_DROP};
    tn_setting first = TN_SETTING_COUNT;
    for (size_t i = 0; i < sizeof starts / sizeof *starts; i++) {
        if (!is_written(f, starts[i]))
            continue;
        bool pair = starts[i] == TN_SET_DROP && first == TN_SET_KEEP;
        if (first != TN_SETTING_COUNT && !pair)
            find(f, starts[i], first, "a study has one problem, and this is another", "leave one of them out");
        first = first == TN_SETTING_COUNT ? starts[i] : first;
    }
    find_program(f, first);
    if (first == TN_SETTING_COUNT && tn_evolution_study_use(f->study) == TN_USE_CODONS &&
        !is_written(f, TN_SET_PROGRAM))
        find(f, TN_SETTING_COUNT, TN_SETTING_COUNT, "the study does not say what to evolve towards",
             "write one of `match \"TEXT\"`, `fit \"DATA.csv\"`, `grow \"GROWTH.study\"`, `build \"GOALS.solid\"`, "
             "`place \"KIT.kit\"`, `fitness program \"./PROGRAM\"`, or `keep \"PLANS\"` with `drop \"PLANS\"`");
    if (is_written(f, TN_SET_KEEP) != is_written(f, TN_SET_DROP))
        find(f, is_written(f, TN_SET_KEEP) ? TN_SET_KEEP : TN_SET_DROP, TN_SETTING_COUNT,
             "a rule is learned from plans of both kinds", "write both `keep \"PLANS\"` and `drop \"PLANS\"`");
}

/* What is about data that are fitted, and how errors are measured. */
static void find_fitting(findings *f)
{
    static const tn_setting fitting[] = {TN_SET_TEST, TN_SET_ERROR, TN_SET_SCALING};
    bool fits = is_written(f, TN_SET_FIT);
    bool lexicase = chooses_by_cases(f);
    bool classes =
        chose(f, TN_SET_ERROR, "log-loss") || chose(f, TN_SET_ERROR, "accuracy") || chose(f, TN_SET_ERROR, "f1");
    for (size_t i = 0; i < sizeof fitting / sizeof *fitting; i++)
        if (is_written(f, fitting[i]) && !fits)
            find(f, fitting[i], TN_SETTING_COUNT, "this is about data that are fitted",
                 "name the data, as `fit \"DATA.csv\"`, or leave it out");
    if (classes && chose(f, TN_SET_SCALING, "linear"))
        find(f, TN_SET_SCALING, TN_SET_ERROR, "values that mean classes are not scaled", "leave `scaling` out");
    if (lexicase && !fits && !is_written(f, TN_SET_PROGRAM))
        find(f, TN_SET_SELECTION, TN_SETTING_COUNT,
             "this selection looks at errors one by one: in each line of data, or those that a program answers with",
             "name the data, as `fit \"DATA.csv\"`, or the program, as `fitness program \"./score.sh\"`, or write "
             "`selection tournament 3`");
    if (lexicase && chose(f, TN_SET_REPLACEMENT, "steady-state"))
        find(f, TN_SET_REPLACEMENT, TN_SET_SELECTION, "this selection looks at a whole generation",
             "leave `replacement` out");
    if (lexicase && f->study->of[TN_SET_SELECTION].written == 2)
        find(f, TN_SET_SELECTION, TN_SETTING_COUNT, "this selection takes no number", "leave the number out");
}

/* What is about other genomes than those that the study breeds: codons are the case where nothing else is said. */
static void find_strangers(findings *f)
{
    tn_setting_use use = tn_evolution_study_use(f->study);
    tn_setting breeds = use == TN_USE_BOXES ? TN_SET_DESIGN : use == TN_USE_TREES ? TN_SET_PARENT : TN_SET_GRAMMAR;
    bool named = is_written(f, breeds);
    for (tn_setting i = 0; i < TN_SETTING_COUNT && f->count < TN_SETTING_FAULTS_MAX; i++) {
        if (!is_written(f, i) || (tn_setting_rows[i].use & use))
            continue;
        bool codons = tn_setting_rows[i].use == TN_USE_CODONS;
        find(f, i, named ? breeds : TN_SETTING_COUNT,
             codons                                   ? "this is about genomes that a grammar maps"
             : tn_setting_rows[i].use == TN_USE_TREES ? "this is about fields, which are bred from parents"
             : tn_setting_rows[i].use == TN_USE_BOXES ? "this is about designs of boxes"
                                                      : "this is about fields and designs of boxes",
             codons ? "leave it out; docs/evolution.md says which settings fields and designs have"
             : named && use != TN_USE_CODONS          ? "a study breeds the one or the other: leave one of them out"
             : tn_setting_rows[i].use == TN_USE_BOXES ? "name the design that is bred, as `design \"table.solid\"`"
                                                      : "name a parent, as `parent \"sphere\"`");
    }
}

/* All that there is to select by is one number of a program. */
static bool has_one_answer(const findings *f)
{
    return is_written(f, TN_SET_PROGRAM) && tn_evolution_study_use(f->study) == TN_USE_CODONS &&
           !is_written(f, TN_SET_GROW) && !is_written(f, TN_SET_BUILD) && !is_written(f, TN_SET_PLACE) &&
           f->study->of[TN_SET_PROGRAM_VALUES].first == 1;
}

static void find_selection(findings *f)
{
    const tn_setting_value *selection = &f->study->of[TN_SET_SELECTION];
    bool nsga2 = chose(f, TN_SET_SELECTION, "nsga2");
    if ((nsga2 || chooses_by_cases(f)) && has_one_answer(f))
        find(f, TN_SET_SELECTION, TN_SET_PROGRAM,
             nsga2 ? "`selection nsga2` weighs several objectives, and the program answers with one number"
                   : "lexicase selection looks at several errors, and the program answers with one number",
             "write `selection tournament 3`, or how many numbers it answers with, as `program-values 2`");
    static const tn_setting single[] = {TN_SET_MATCH, TN_SET_FIT};
    for (size_t i = 0; nsga2 && i < sizeof single / sizeof *single; i++)
        if (is_written(f, single[i]))
            find(f, TN_SET_SELECTION, single[i],
                 "`selection nsga2` weighs several objectives, and this problem has one",
                 "write `selection tournament 3`");
    if (nsga2 && chose(f, TN_SET_REPLACEMENT, "steady-state"))
        find(f, TN_SET_REPLACEMENT, TN_SET_SELECTION,
             "`selection nsga2` chooses among parents and children together, which replaces them too",
             "leave `replacement` out");
    if (selection->written == 2 && chose(f, TN_SET_SELECTION, "truncation") &&
        !(selection->second > 0 && selection->second <= 1))
        find(f, TN_SET_SELECTION, TN_SETTING_COUNT, "`selection truncation` takes the share of the best",
             "write a number above 0 and not above 1, as 0.5");
    if (selection->written == 2 && chose(f, TN_SET_SELECTION, "roulette"))
        find(f, TN_SET_SELECTION, TN_SETTING_COUNT, "`selection roulette` takes no number", "leave the number out");
    bool drawn = nsga2 || chose(f, TN_SET_SELECTION, "tournament");
    if (selection->written == 2 && drawn && !(selection->second >= 1 && selection->second == floor(selection->second)))
        find(f, TN_SET_SELECTION, TN_SETTING_COUNT, "this selection takes how many are drawn for a tournament",
             "write a whole number of at least 1, as 3");
}

static void find_islands(findings *f)
{
    const tn_setting_value *of = f->study->of;
    double islands = of[TN_SET_ISLANDS].first, population = of[TN_SET_POPULATION].first;
    tn_setting other = is_written(f, TN_SET_POPULATION) ? TN_SET_POPULATION : TN_SETTING_COUNT;
    if (islands == 1) {
        if (is_written(f, TN_SET_MIGRATE))
            find(f, TN_SET_MIGRATE, TN_SETTING_COUNT, "there are no islands to move between",
                 "add a line such as `islands 4`");
        return;
    }
    if (chooses_by_cases(f))
        find(f, TN_SET_ISLANDS, TN_SET_SELECTION, "lexicase selection chooses among the whole population",
             "leave `islands` out, or write `selection tournament 3`");
    double size = floor(population / islands);
    if (size * islands != population || size < 2) {
        find(f, TN_SET_ISLANDS, other, "the population does not make equal islands of at least two individuals",
             "make the population a multiple of the islands");
        return;
    }
    if (of[TN_SET_ELITES].first >= size)
        find(f, is_written(f, TN_SET_ELITES) ? TN_SET_ELITES : TN_SET_ISLANDS, TN_SETTING_COUNT,
             "there are as many elites as individuals on an island", "an elite or two are usual");
    if (of[TN_SET_MIGRATE].first >= size)
        find(f, is_written(f, TN_SET_MIGRATE) ? TN_SET_MIGRATE : TN_SET_ISLANDS, TN_SETTING_COUNT,
             "as many individuals move as live on an island", "one or two in every ten generations are usual");
}

size_t tn_evolution_study_faults(const tn_evolution_study *study, tn_setting_fault faults[TN_SETTING_FAULTS_MAX])
{
    findings f = {study, faults, 0};
    const tn_setting_value *of = study->of;
    find_strangers(&f);
    if (!is_written(&f, TN_SET_GRAMMAR) && tn_evolution_study_use(study) == TN_USE_CODONS)
        find(&f, TN_SETTING_COUNT, TN_SETTING_COUNT, "the study does not say which grammar genomes are mapped through",
             "add a line such as `grammar \"words\"`");
    find_problem(&f);
    find_selection(&f);
    find_fitting(&f);
    find_islands(&f);
    if (of[TN_SET_ELITES].first >= of[TN_SET_POPULATION].first) {
        tn_setting blamed = is_written(&f, TN_SET_ELITES) ? TN_SET_ELITES : TN_SET_POPULATION;
        find(&f, blamed,
             blamed == TN_SET_ELITES && is_written(&f, TN_SET_POPULATION) ? TN_SET_POPULATION : TN_SETTING_COUNT,
             "there are as many elites as individuals", "an elite or two are usual");
    }
    if (!chose(&f, TN_SET_MUTATION, "genome") && of[TN_SET_MUTATION].second > 1)
        find(&f, TN_SET_MUTATION, TN_SETTING_COUNT, "this mutation takes a probability", "write a number from 0 to 1");
    return f.count;
}

bool tn_evolution_study_of(const tn_module *module, tn_evolution_study *study)
{
    tn_evolution_study_default(study);
    for (size_t i = 0; i < module->SETTING_count; i++) {
        const tn_setting_record *r = &module->SETTING_records[i];
        const tn_setting_value value = {
            r->written, r->choice, r->first, r->second, r->text ? tn_text(module, r->text) : NULL,
            r->file,    r->begin,  r->end};
        if (tn_setting_rows[r->setting].kind == TN_SETTING_EACH)
            tn_evolution_study_add(study, (tn_setting)r->setting, &value);
        else
            study->of[r->setting] = value;
    }
    return module->SETTING_count > 0;
}

/* ==== verifies and lists the settings of an evolution */

static tn_status check_setting(const tn_checker *checker, size_t index)
{
    const tn_setting_record *records = checker->module->SETTING_records, *record = &records[index];
    bool repeats = record->setting < TN_SETTING_COUNT && tn_setting_rows[record->setting].kind == TN_SETTING_EACH &&
                   index > 0 && records[index - 1].setting == record->setting;
    bool ascends = index == 0 || records[index - 1].setting < record->setting || repeats;
    tn_setting_value value = {.written = record->written,
                              .choice = record->choice,
                              .first = record->first,
                              .second = record->second,
                              .text = tn_text(checker->module, record->text)};
    bool known = record->setting < TN_SETTING_COUNT && tn_setting_rows[record->setting].name;
    if (!known || !ascends || !tn_setting_fits((tn_setting)record->setting, &value))
        return tn_refuse(checker, "setting %zu is unknown, out of order or out of range", index);
    return TN_OK;
}

/* Settings are of their row's kind and range, each there once, and nothing between them is what a study would be
 * refused for; there is one grammar. */
static tn_status verify(const tn_checker *checker)
{
    const tn_module *module = checker->module;
    for (size_t i = 0; i < module->SETTING_count; i++) {
        tn_status status = check_setting(checker, i);
        if (status != TN_OK)
            return status;
    }
    if (module->SETTING_count == 0)
        return TN_OK;
    if (module->SETTING_count > TN_SETTING_COUNT + TN_EACH_MAX)
        return tn_refuse(checker, "an evolution has more settings than there are");
    tn_evolution_study study;
    tn_setting_fault faults[TN_SETTING_FAULTS_MAX];
    tn_evolution_study_of(module, &study);
    if (tn_evolution_study_faults(&study, faults) > 0)
        return tn_refuse(checker, "%s", faults[0].message);
    if (tn_evolution_study_use(&study) != TN_USE_CODONS)
        return module->GRAMMAR_count == 0 ? TN_OK : tn_refuse(checker, "an evolution of forms has no grammar");
    if (module->GRAMMAR_count != 1)
        return tn_refuse(checker, "an evolution needs one grammar, not %zu", module->GRAMMAR_count);
    if (module->GRAMMAR_records[0].dialect == TN_DIALECT_PLACE)
        return tn_refuse(checker, "an evolution needs a grammar that genomes are mapped through");
    const tn_setting_value *mapping = &study.of[TN_SET_MAPPING];
    bool independent = module->GRAMMAR_records[0].flags & TN_POSITION_INDEPENDENT;
    if (mapping->written && independent != (mapping->choice == 1))
        return tn_refuse(checker, "an evolution maps genomes otherwise than its grammar");
    return TN_OK;
}

static void list(tn_lister *lister)
{
    tn_evolution_study study;
    if (!tn_evolution_study_of(lister->module, &study))
        return;
    fputs("\nevolution\n", lister->out);
    for (tn_setting i = 0; i < TN_SETTING_COUNT; i++) {
        if (study.of[i].written == 0 || tn_setting_rows[i].kind == TN_SETTING_EACH)
            continue;
        fputs("  ", lister->out);
        tn_setting_write(lister->out, i, &study.of[i]);
        fputc('\n', lister->out);
    }
    for (uint32_t i = 0; i < study.each_count; i++) {
        fputs("  ", lister->out);
        tn_setting_write(lister->out, study.each[i].setting, &study.each[i].value);
        fputc('\n', lister->out);
    }
}

static const tn_section sections[] = {TN_SECTION_SETTING, TN_SECTION_STRINGS};

extern const tn_engine tn_engine_genome;
const tn_engine tn_engine_genome = {.name = "genome", .sections = sections, .verify = verify, .list = list};
