/* The settings of an evolution block as values: what a study says, what a module's SETTING records hold, and what an
 * engine is started with. settings.def is the table of them.
 */
#ifndef TARTAN_GENOME_SETTINGS_H
#define TARTAN_GENOME_SETTINGS_H

#include <stdio.h>

#include "runtime/module/module.h"

/* As many bytes as the highest number and one. */
union tn_settings_bytes {
#define SETTING(ID, NUMBER, NAME, KIND, FIRST, SECOND, LOW, HIGH, CHOICES, USE) char of_##ID[(NUMBER) + 1];
#include "runtime/genome/settings.def"
};

typedef enum tn_setting {
#define SETTING(ID, NUMBER, NAME, KIND, FIRST, SECOND, LOW, HIGH, CHOICES, USE) TN_SET_##ID = (NUMBER),
#include "runtime/genome/settings.def"
    TN_SETTING_COUNT = sizeof(union tn_settings_bytes)
} tn_setting;

typedef enum tn_setting_kind {
    TN_SETTING_WHOLE,
    TN_SETTING_REAL,
    TN_SETTING_SEED,
    TN_SETTING_PAIR,
    TN_SETTING_TEXT,
    TN_SETTING_CHOICE,
    TN_SETTING_CHOICE_REAL,
    TN_SETTING_SPAN,
    TN_SETTING_EACH,
    TN_SETTING_EVERY
} tn_setting_kind;

/* Which genomes a setting is about; and, of a study, which it breeds: one of the first three. */
typedef enum tn_setting_use {
    TN_USE_CODONS = 1,
    TN_USE_TREES = 2,
    TN_USE_BOXES = 4,
    TN_USE_FORMS = TN_USE_TREES | TN_USE_BOXES,
    TN_USE_ANY = TN_USE_CODONS | TN_USE_FORMS
} tn_setting_use;

typedef struct tn_setting_row {
    const char *name; /* NULL for a number that is no setting's */
    tn_setting_kind kind;
    double first, second; /* defaults */
    double low, high;
    const char *choices; /* "a|b|c" */
    tn_setting_use use;
} tn_setting_row;

extern const tn_setting_row tn_setting_rows[TN_SETTING_COUNT];

typedef struct tn_setting_value {
    uint32_t written; /* how many values were: 0 if the default stands; a number after a word counts */
    uint32_t choice;
    double first, second; /* a number, the ends of a range; second: the number after a word */
    const char *text;     /* or NULL; borrowed */
    uint32_t file, begin, end;
} tn_setting_value;

#define TN_EACH_MAX 64u /* settings that may be there more than once, in all */

typedef struct tn_setting_each {
    tn_setting setting;
    tn_setting_value value;
} tn_setting_each;

/* One of each, the defaults where nothing is written. What may be there more than once is listed behind it, in the
 * order in which it is written; its first is also the one of its setting. */
typedef struct tn_evolution_study {
    tn_setting_value of[TN_SETTING_COUNT];
    tn_setting_each each[TN_EACH_MAX];
    uint32_t each_count;
} tn_evolution_study;

/* Which genomes a study breeds. */
tn_setting_use tn_evolution_study_use(const tn_evolution_study *study);

/* Adds one of those that may be there more than once; false if there are too many. */
bool tn_evolution_study_add(tn_evolution_study *study, tn_setting setting, const tn_setting_value *value);

void tn_evolution_study_default(tn_evolution_study *study);

/* The setting that a text of `size` bytes names, case aside; TN_SETTING_COUNT if it is none. */
tn_setting tn_setting_named(const char *text, size_t size);

/* Is this value one that the setting's row allows? */
bool tn_setting_fits(tn_setting setting, const tn_setting_value *value);

/* The index of a word among a row's choices, case aside; UINT32_MAX if it is none. */
uint32_t tn_setting_choice(const tn_setting_row *row, const char *word);
uint32_t tn_setting_choice_count(const tn_setting_row *row);

/* A whole number of 64 bits as the value of a setting of kind SEED, and back. */
void tn_setting_put_whole64(tn_setting_value *value, uint64_t whole);
uint64_t tn_setting_whole64(const tn_setting_value *value);

/* Copies the name of a choice into `name`, of 32 bytes. */
void tn_setting_choice_name(const tn_setting_row *row, uint32_t choice, char name[32]);

/* Writes a setting as a study writes it, "crossover subtree 0.8". What would upset a terminal is cleaned. */
void tn_setting_write(FILE *out, tn_setting setting, const tn_setting_value *value);

/* What is wrong between settings that are each right. */
typedef struct tn_setting_fault {
    tn_setting setting; /* that is to blame; TN_SETTING_COUNT: something is missing */
    tn_setting other;   /* that it does not go with, or TN_SETTING_COUNT */
    const char *message, *help;
} tn_setting_fault;

#define TN_SETTING_FAULTS_MAX 16u

/* Fills `faults` and returns how many there are. */
size_t tn_evolution_study_faults(const tn_evolution_study *study, tn_setting_fault faults[TN_SETTING_FAULTS_MAX]);

/* The study that a verified module holds; its texts are the module's. False if it holds none. */
bool tn_evolution_study_of(const tn_module *module, tn_evolution_study *study);

#endif
