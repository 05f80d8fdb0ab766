/* The command line: each command is a row of data (tn_command) with a table of its options, from which parsing,
 * `--help`, the manual pages and the shells' completion all come.
 *
 * Parsing writes into the command's settings at the offset that the option's row names. Texts are borrowed from argv.
 */
#ifndef TARTAN_CLI_COMMON_OPTIONS_H
#define TARTAN_CLI_COMMON_OPTIONS_H

#include <stdio.h>

#include "runtime/base/formats.h"

typedef struct tn_option_list {
    const char **items;
    size_t count;
} tn_option_list;

typedef struct tn_option_number {
    bool given;
    uint64_t value;
} tn_option_number;

typedef struct tn_option_real {
    bool given;
    double value;
} tn_option_real;

typedef struct tn_option_range {
    bool given;
    uint64_t low, high;
} tn_option_range;

/* What a row writes into the settings. */
typedef enum tn_option_kind {
    TN_OPTION_FLAG,   /* bool */
    TN_OPTION_TEXT,   /* const char * */
    TN_OPTION_LIST,   /* tn_option_list; may be repeated */
    TN_OPTION_NUMBER, /* tn_option_number, from `low` to `high` */
    TN_OPTION_RANGE,  /* tn_option_range, written a..b or a, from `low` to `high` */
    TN_OPTION_RANK,   /* const char *: decimal digits, as many as one likes */
    TN_OPTION_CHOICE, /* int: index of the word among `choices` */
    TN_OPTION_MAYBE,  /* int: 0 not given; otherwise one more than the index of the word, which may be left out for the
                         first */
    TN_OPTION_REAL,   /* tn_option_real */
    TN_OPTION_WISH, /* tn_option_list: adds the option's name and its word, so that several options keep their order */
} tn_option_kind;

typedef struct tn_option {
    const char *name;     /* without the dashes */
    char letter;          /* of the short form, or 0 */
    const char *argument; /* what help calls the argument; NULL for a flag */
    const char *help;
    tn_option_kind kind;
    size_t offset;       /* in the command's settings */
    const char *choices; /* "text|json" */
    uint64_t low, high;  /* bounds; high 0: none */
    /* Of a file that is written, in which formats: its name is checked, and where its ending promises one, that is what
     * --format or --json say. 0: none of these. */
    tn_file_formats writes;
} tn_option;

/* What every command is told. A command's own options are a struct that begins with this one, declared in the command's
 * file, so that a pointer to this one points to that one too. Options that several commands share are structs which
 * those embed. All is zero where it was not given. */
typedef struct tn_settings {
    const struct tn_command *command; /* whose they are; NULL before that is known */
    tn_option_list operands;
    bool help;
    int diagnostics; /* 0 text, 1 json */
    bool werror;
    tn_option_list params;         /* values of params, NAME=VALUE each */
    const char *ldraw;             /* a folder; NULL: the usual one */
    tn_option_number memory_limit; /* megabytes */
    const struct tn_ranks *ranks;  /* the processes that do the command together; NULL: this one alone */
} tn_settings;

typedef struct tn_command {
    const char *name;
    const char *summary;     /* one line, no full stop */
    const char *usage;       /* the words after "tartan NAME", one form a line */
    const char *description; /* paragraphs; wrapped by help */
    const char *example;     /* lines, commands start with "$ " */
    const tn_option *options;
    size_t option_count;
    size_t settings_size; /* of the command's struct, which begins with tn_settings */
    const char *ask_less; /* what to do where memory does not suffice: "take fewer steps"; NULL: nothing is known */
    const char *operands; /* what an operand is called in errors */
    size_t operands_min, operands_max;
    bool serves; /* others, for as long as they like: it has nothing to lose, and a signal ends it at once */
    int (*run)(const struct tn_command *command, const tn_settings *settings);
} tn_command;

/* All commands, in the order that help lists them. */
extern const tn_command *const tn_commands[];
extern const size_t tn_commands_count;

/* The command named so, or NULL. */
const tn_command *tn_command_find(const char *name);

/* What the command's option --output was given; NULL where it was not, or the command has no such option. */
const char *tn_settings_output(const tn_settings *settings);

/* Options that every command has; parsing and help add them to the command's own. */
extern const tn_option tn_common_options[];
extern const size_t tn_common_option_count;

/* Was the option given? A choice that is its first word counts as not given. */
bool tn_option_given(const tn_option *option, const tn_settings *settings);

/* A command's options, its own first, then those. */
size_t tn_option_total(const tn_command *command);
const tn_option *tn_option_at(const tn_command *command, size_t i);

/* The command's settings, all zero; NULL where out of memory. Free them. */
tn_settings *tn_settings_new(const tn_command *command);
void tn_settings_free(const tn_command *command, tn_settings *settings);

/* Reads the words after the command's name. TN_INVALID (E0904) says what is wrong and what was probably meant; what was
 * read before stays in the settings. */
tn_status tn_options_parse(const tn_command *command, int count, char **words, tn_settings *settings, tn_error *error);

/* What --diagnostics says among the words, 0 where it does not: for what is wrong with the command line itself. */
int tn_options_diagnostics(int count, char *const *words);

/* Reads a number or a range as the options do; false where the text is not one. */
bool tn_number_read(const char *text, uint64_t *value);

#endif
