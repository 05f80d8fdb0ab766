/* The command line: each command is a row of data (tn_command) with a table of its options, from which parsing,
 * `--help`, the manual pages and the shells' completion all come.
 *
 * Parsing writes into the command's settings at the offset that the option's row names. Texts are borrowed from argv.
 */
#ifndef TARTAN_CLI_COMMON_OPTIONS_H
#define TARTAN_CLI_COMMON_OPTIONS_H

#include <stddef.h>
#include <stdio.h>

#include "runtime/base/formats.h"

/* How a command ends. */
enum {
    TN_EXIT_DONE = 0,
    TN_EXIT_INVALID = 1,
    TN_EXIT_USAGE = 2,
    TN_EXIT_IO = 3,
    TN_EXIT_LIMIT = 4,
    TN_EXIT_INTERNAL = 70,
    TN_EXIT_INTERRUPTED = 130, /* as shells report SIGINT */
};

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

/* The commands of a program, in the order that help lists them. */
typedef struct tn_commands {
    const tn_command *const *items;
    size_t count;
} tn_commands;

/* The command named so, or NULL. */
const tn_command *tn_command_find(const tn_commands *commands, const char *name);

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

/* Reads the words after the command's name, which is one of `commands`. TN_INVALID (E0904) says what is wrong and what
 * was probably meant; what was read before stays in the settings. */
tn_status tn_options_parse(const tn_commands *commands, const tn_command *command, int count, char **words,
                           tn_settings *settings, tn_error *error);

/* What --diagnostics says among the words, 0 where it does not: for what is wrong with the command line itself. */
int tn_options_diagnostics(int count, char *const *words);

/* Reads a number or a range as the options do; false where the text is not one. */
bool tn_number_read(const char *text, uint64_t *value);

/* Rows of option tables: the constructors of a row, and the rows that several commands share, so that each is spelt and
 * explained in one place. Arguments: name, letter of the short form (or 0), name of the argument, field, help.
 *
 * The file of a command defines SETTINGS, its struct of options, before its table. A field that is not of the type that
 * the option's kind writes is a warning. Shared rows name the fields that commands have in common: `common`, `output`,
 * and those of the groups. */

#define OPTION_COUNT(OPTIONS) (sizeof(OPTIONS) / sizeof *(OPTIONS))

/* The offset of a field of that type: the compiler warns of comparing pointers of two types. */
#define OPTION_OFFSET(FIELD, TYPE) (offsetof(SETTINGS, FIELD) + 0 * sizeof(&((SETTINGS *)0)->FIELD == (TYPE *)0))

#define OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, TYPE, KIND, HELP)                                                    \
    .name = NAME, .letter = LETTER, .argument = ARGUMENT, .offset = OPTION_OFFSET(FIELD, TYPE), .kind = KIND,          \
    .help = HELP
#define FLAG(NAME, LETTER, FIELD, HELP)                                                                                \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, NULL, FIELD, bool, TN_OPTION_FLAG, HELP)                                              \
    }
#define TEXT(NAME, LETTER, ARGUMENT, FIELD, HELP)                                                                      \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, const char *, TN_OPTION_TEXT, HELP)                                  \
    }
#define LIST(NAME, LETTER, ARGUMENT, FIELD, HELP)                                                                      \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, tn_option_list, TN_OPTION_LIST, HELP)                                \
    }
#define RANK(NAME, LETTER, ARGUMENT, FIELD, HELP)                                                                      \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, const char *, TN_OPTION_RANK, HELP)                                  \
    }
#define NUMBER(NAME, LETTER, ARGUMENT, FIELD, LOW, HIGH, HELP)                                                         \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, tn_option_number, TN_OPTION_NUMBER, HELP), .low = LOW, .high = HIGH  \
    }
#define RANGE(NAME, LETTER, ARGUMENT, FIELD, LOW, HIGH, HELP)                                                          \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, tn_option_range, TN_OPTION_RANGE, HELP), .low = LOW, .high = HIGH    \
    }
#define CHOICE(NAME, LETTER, ARGUMENT, FIELD, CHOICES, HELP)                                                           \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, int, TN_OPTION_CHOICE, HELP), .choices = CHOICES                     \
    }
#define MAYBE(NAME, LETTER, ARGUMENT, FIELD, CHOICES, HELP)                                                            \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, int, TN_OPTION_MAYBE, HELP), .choices = CHOICES                      \
    }
#define REAL(NAME, LETTER, ARGUMENT, FIELD, HELP)                                                                      \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, tn_option_real, TN_OPTION_REAL, HELP)                                \
    }

/* The file that a command writes, in formats of the set WRITES (formats.h); several files; other files. */
#define OUTPUT(FIELD, WRITES, HELP) WRITTEN("output", 'o', "FILE", FIELD, WRITES, HELP)
#define OUTPUTS(FIELD, WRITES, HELP)                                                                                   \
    {                                                                                                                  \
        OPTION_ROW("output", 'o', "FILE", FIELD, tn_option_list, TN_OPTION_LIST, HELP), .writes = WRITES               \
    }
#define WRITTEN(NAME, LETTER, ARGUMENT, FIELD, WRITES, HELP)                                                           \
    {                                                                                                                  \
        OPTION_ROW(NAME, LETTER, ARGUMENT, FIELD, const char *, TN_OPTION_TEXT, HELP), .writes = WRITES                \
    }

/* FIELD keeps the names and words of all such options of the command, in their order. */
#define WISH(NAME, FIELD, HELP)                                                                                        \
    {                                                                                                                  \
        OPTION_ROW(NAME, 0, "MEASURE", FIELD, tn_option_list, TN_OPTION_WISH, HELP)                                    \
    }

#define OPTION_WERROR FLAG("werror", 0, common.werror, "treat warnings as errors")
#define OPTION_SET                                                                                                     \
    LIST("set", 0, "NAME=VALUE", common.params,                                                                        \
         "give the param NAME of the .plan file another value than its default, for this run; may be repeated")
#define OPTION_LDRAW                                                                                                   \
    TEXT("ldraw", 0, "DIR", common.ldraw,                                                                              \
         "the LDraw library of which kits take parts (default: the folder that LDRAWDIR names, or /usr/share/ldraw)")
#define OPTION_OUTPUT(WRITES) OPTION_OUTPUT_BY(WRITES, "")
/* AS: what the endings mean, as "; .json is JSON". */
#define OPTION_OUTPUT_BY(WRITES, AS)                                                                                   \
    OUTPUT(output, WRITES, "write to FILE (beside it, then renamed over it)" AS "; - is standard output")
#define OPTION_OUTPUT_OR_PICTURE                                                                                       \
    OUTPUT(output, TN_WRITES_TEXT | TN_WRITES(JSON) | TN_WRITES_PICTURES,                                              \
           "write to FILE (beside it, then renamed over it); - is standard output; .svg, .png and .pdf make a "        \
           "picture, .json is JSON")

/* The field: where the command keeps it. */
#define OPTION_MAX_BOXES(FIELD)                                                                                        \
    NUMBER("max-boxes", 0, "N", FIELD, 1, 100000000, "the most boxes of a design, with their images (default 100000)")
#define OPTION_THREADS(FIELD)                                                                                          \
    NUMBER("threads", 0, "N", FIELD, 1, 1024,                                                                          \
           "how many threads work (default: all processors); changes nothing but the time")

#endif
